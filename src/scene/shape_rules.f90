!> Sizes of a scene against each other: films, foils and bumps are thin against the bearing, the
!> shaft stands inside it.
module gfb_shape_rules
  use gfb_kinds, only: wp
  use gfb_foil_cases, only: bump_foil_case_type, has_sizes, one_bump, strips_differ
  use gfb_case_keys, only: case_keys_type
  use gfb_motion_cases, only: follow_unbalance, rotor_case_type
  use gfb_scene, only: scene_type
  use gfb_sweep_case, only: sweep_tilt_x, sweep_tilt_y, sweep_eccentricity_x, &
                            sweep_eccentricity_y
  use gfb_text, only: text
  implicit none (type, external)
  private
  public :: check_shape

  real(wp), parameter, public :: thin = 0.05_wp          !! film or foil, over the radius [1]
  real(wp), parameter, public :: thin_in_bump = 0.5_wp  !! foil, over half a bump's chord [1]
  real(wp), parameter, public :: low_in_pad = 0.25_wp   !! bump, over the radius of the pad [1]
  character(len=*), parameter :: thin_film = ' of the radius: the film is thin and the pad unrolled'

contains

  !> Checks the sizes of a scene against each other; a size that is not known breaks no rule.
  subroutine check_shape(keys, scene)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(scene_type), intent(in) :: scene !! what the case file asks for

    associate (radius => scene%bearing%radius, clearance => scene%bearing%clearance)
      call must_be_less(keys, 'bearing', 'clearance', clearance, thin*radius, '1/20'//thin_film)
      call must_be_less(keys, 'top_foil', 'thickness', scene%top_foil%thickness, thin*radius, &
                        '1/20 of the radius: the foil is a thin shell, unrolled')
      call must_be_less(keys, 'shaft_contact', 'roughness', scene%shaft_contact%roughness, &
                        clearance, 'the clearance: beyond it there is no film')
      call check_bumps(keys, scene%bump_foil, radius)
    end associate
    call must_be_less(keys, 'strip_load', 'maximum_displacement', &
                      scene%strip_load%maximum_displacement, scene%bump_foil%height%value, &
                      'the height of the bumps')
    call check_position(keys, scene)
    call check_motion(keys, scene)
  end subroutine check_shape

  !> Bumps are low against the bearing, and their foil is thin against them; the first bump that is
  !> too thick is named.
  subroutine check_bumps(keys, foil, radius)
    type(case_keys_type), intent(inout) :: keys
    type(bump_foil_case_type), intent(in) :: foil
    real(wp), intent(in) :: radius !! of the bearing, 0 where there is none [m]
    character(len=*), parameter :: group = 'bump_foil'
    type(bump_foil_case_type) :: one
    character(len=:), allocatable :: of, key
    real(wp) :: thickness !! [m]
    integer :: bump, n

    if (strips_differ(foil)) return ! see the rules of strips with sizes of their own
    key = 'thickness'
    thickness = foil%thickness%value
    bump = 0
    if (foil%half_length%value > 0.0_wp) then
      n = merge(foil%bumps, 1, has_sizes(foil))
      key = foil%thickness%bump_key()
      thickness = maxval(foil%thickness%each(n))
      bump = findloc(foil%thickness%each(n) >= thin_in_bump*foil%half_length%each(n), .true., 1)
    end if
    if (bump > 0) then
      of = ''
      if (has_sizes(foil)) of = ' of bump '//text(bump)
      one = one_bump(foil, bump)
      call must_be_less(keys, group, key, one%thickness%value, &
                        thin_in_bump*one%half_length%value, 'half of half_length'//of// &
                        ': a bump is a thin shell')
    else
      call must_be_less(keys, group, key, thickness, thin*radius, &
                        '1/20 of the radius: the foil is a thin shell, unrolled')
    end if
    call must_be_less(keys, group, foil%height%bump_key(), foil%height%value, low_in_pad*radius, &
                      '1/4 of the radius: the strip is unrolled')
  end subroutine check_bumps

  !> The shaft and the free edge stay near the foil. A rigid pad has a stricter rule of its own.
  subroutine check_position(keys, scene)
    type(case_keys_type), intent(inout) :: keys
    type(scene_type), intent(in) :: scene
    real(wp) :: arm !! of a tilt: half the length [m]
    integer :: point

    arm = 0.5_wp*scene%bearing%length
    associate (radius => scene%bearing%radius, operation => scene%operation, sweep => scene%sweep)
      call lifts_must_be_less('leading_edge_lift', operation%leading_edge_lift)
      call lifts_must_be_less('leading_edge_lift_edge', operation%leading_edge_lift_edge)
      if (.not. scene%model%foil%deflects) return
      call must_be_less(keys, 'operation', 'eccentricity', norm2(operation%eccentricity), &
                        thin*radius, '1/20'//thin_film)
      call must_be_less(keys, 'operation', 'tilt', arm*norm2(operation%tilt), thin*radius, &
                        '1/20'//thin_film, of='at the ends of the bearing')
      if (.not. allocated(sweep%values)) return
      do point = 1, size(sweep%values)
        select case (sweep%parameter)
        case (sweep_eccentricity_x, sweep_eccentricity_y)
          call must_be_less(keys, 'sweep', 'values', abs(sweep%values(point)), thin*radius, &
                            '1/20'//thin_film, point)
        case (sweep_tilt_x, sweep_tilt_y)
          call must_be_less(keys, 'sweep', 'values', abs(arm*sweep%values(point)), thin*radius, &
                            '1/20'//thin_film, point, 'at the ends of the bearing')
        case default
          exit
        end select
      end do
    end associate

  contains

    !> Complains about lifts that are no thin film's.
    subroutine lifts_must_be_less(key, lift)
      character(len=*), intent(in) :: key
      real(wp), intent(in) :: lift(:) !! one, or of each pad [m]
      integer :: pad

      if (size(lift) == 1) then
        call must_be_less(keys, 'operation', key, lift(1), thin*scene%bearing%radius, &
                          '1/20'//thin_film)
        return
      end if
      do pad = 1, size(lift)
        call must_be_less(keys, 'operation', key, lift(pad), thin*scene%bearing%radius, &
                          '1/20'//thin_film, pad)
      end do
    end subroutine lifts_must_be_less
  end subroutine check_position

  !> A shaft that vibrates, or is led round an orbit, stays within the clearance, and so does the
  !> centre of mass of one with an unbalance, about which it turns when it is fast.
  subroutine check_motion(keys, scene)
    type(case_keys_type), intent(inout) :: keys
    type(scene_type), intent(in) :: scene
    real(wp) :: room !! left for an orbit [m]
    integer :: i

    associate (clearance => scene%bearing%clearance, mass => scene%rotor%mass)
      if (.not. clearance > 0.0_wp) return
      if (scene%dynamics%present) then
        do i = 1, size(scene%dynamics%amplitudes)
          call must_be_less(keys, 'dynamics', 'vibration_amplitudes', &
                            scene%dynamics%amplitudes(i), clearance, 'the clearance', i)
        end do
      end if
      if (scene%transient%present) then
        room = clearance
        if (.not. scene%model%foil%deflects) room = room - norm2(scene%operation%eccentricity)
        call must_be_less(keys, 'transient', 'orbit_radius', scene%transient%orbit_radius, room, &
                          'what the position leaves of the clearance')
        call check_unbalance('unbalance', 'unbalance', scene%unbalance%static, mass, clearance)
        call check_couple(scene%unbalance%couple, scene%rotor, clearance)
      end if
      if (.not. scene%periodic%present) return
      call check_unbalance('unbalance', 'unbalance', scene%unbalance%static, mass, clearance)
      if (scene%periodic%parameter == follow_unbalance) then
        call check_unbalance('periodic', 'final_value', scene%periodic%final_value, mass, clearance)
      end if
    end associate

  contains

    !> Complains about a centre of mass that lies outside the clearance.
    subroutine check_unbalance(group, key, unbalance, mass, clearance)
      character(len=*), intent(in) :: group, key !! names in the case file
      real(wp), intent(in) :: unbalance !! [kg m]
      real(wp), intent(in) :: mass      !! [kg]
      real(wp), intent(in) :: clearance !! [m]

      if (.not. mass > 0.0_wp .or. unbalance < clearance*mass) return
      call keys%complain(group, key, 'puts the centre of mass '//text(unbalance/mass)// &
                         ' m off the axis, with mass = '//text(mass)//' kg in &rotor; this '// &
                         'must be less than '//text(clearance)//' m, the clearance')
    end subroutine check_unbalance

    !> Complains about a principal axis that leaves the clearance at the bearings. It is tilted by
    !> the couple over the difference of both inertias, which is at most the transverse one.
    subroutine check_couple(couple, rotor, clearance)
      real(wp), intent(in) :: couple !! [kg m^2]
      type(rotor_case_type), intent(in) :: rotor
      real(wp), intent(in) :: clearance !! [m]
      real(wp) :: offset !! [m]

      if (.not. rotor%transverse_inertia > 0.0_wp) return
      offset = 0.5_wp*rotor%bearing_distance*couple/rotor%transverse_inertia
      if (offset < clearance) return
      call keys%complain('unbalance', 'couple_unbalance', 'puts the principal axis '// &
                         text(offset)//' m or more off the axis at the bearings; this must be '// &
                         'less than '//text(clearance)//' m, the clearance')
    end subroutine check_couple
  end subroutine check_motion

  !> Complains about a size that is not less than its limit; none where the limit is not known.
  subroutine must_be_less(keys, group, key, value, limit, what, point, of)
    type(case_keys_type), intent(inout) :: keys
    character(len=*), intent(in) :: group, key !! names in the case file
    real(wp), intent(in) :: value              !! the size, or what it makes [m]
    real(wp), intent(in) :: limit              !! 0 where it is not known [m]
    character(len=*), intent(in) :: what       !! the limit is, and why
    integer, intent(in), optional :: point     !! of a list
    character(len=*), intent(in), optional :: of !! where the value counts
    character(len=:), allocatable :: words

    if (.not. limit > 0.0_wp .or. value < limit) return
    words = 'must be less than '//text(limit)//' m'
    if (present(of)) words = 'moves the sleeve by '//text(value)//' m '//of//'; this '//words
    call keys%complain(group, key, words//', '//what, point)
  end subroutine must_be_less
end module gfb_shape_rules
