!> `&contact`: how the crests and corners of the bumps touch, and how they rub. `&shaft_contact`:
!> the rough shaft touches the foil, or sleeve, where the film is thin.
!>
!> The defaults of stiffness and stick length follow the scene, so that neither shows in its answer.
module gfb_contact_case
  use gfb_kinds, only: wp
  use gfb_case_keys, only: case_keys_type, from_to, positive, unless
  use gfb_analysis_row, only: analysis_row_type
  use gfb_foil_cases, only: bump_foil_case_type
  use gfb_solid_contact, only: solid_contact_type
  use gfb_contact_law, only: law_tanh_drag, law_coulomb
  use gfb_foil_row, only: foil_row_type
  use gfb_strip_load_case, only: strip_load_case_type, bump_stiffness, typical_deflection, &
                                 support_held
  use gfb_key_effect, only: acts_on_film, acts_on_contacts
  implicit none (type, external)
  private
  public :: read_shaft_contact_case, contact_case_type, read_contact_case

  real(wp), parameter :: usual_friction = 0.1_wp !! of asperities [1]

  !> against the slip, a vector; the default
  integer, parameter, public :: direction_tangent_plane = 1
  integer, parameter, public :: direction_motion = 2        !! along the shaft's motion alone

  integer, parameter, public :: motion_coulomb = 1    !! what sticks keeps its friction; the default
  integer, parameter, public :: motion_as_at_rest = 2 !! by `friction_law`

  !> mid-surfaces touch, as [Gu2020] has it; the default
  integer, parameter :: surface_mid = 1
  integer, parameter, public :: surface_face = 2 !! faces touch, half a thickness off

  character(len=*), parameter :: direction_words(*) = [character(len=13) :: 'tangent_plane', &
    'motion']
  character(len=*), parameter :: surface_words(*) = [character(len=4) :: 'mid', 'face']
  !> In the order of the laws' numbers in `gfb_contact_law`.
  character(len=*), parameter :: law_words(*) = [character(len=10) :: 'tanh_drag', 'tanh_reset', &
                                                 'coulomb']
  character(len=*), parameter :: motion_words(*) = [character(len=10) :: 'coulomb', 'as_at_rest']

  real(wp), parameter :: bumps_stiffness = 1.0e4_wp   !! contact's over that of a bump
  real(wp), parameter :: stick_part = 1.0_wp/5.0e3_wp !! of a strip's typical deflection
  real(wp), parameter :: stick_in_bearing = 1.0_wp/300.0_wp !! of the clearance
  real(wp), parameter :: most_friction = 10.0_wp
  real(wp), parameter :: lowest = 1.0e-60_wp, highest = 1.0e30_wp !! what a case file can hold

  !> The contacts.
  type :: contact_case_type
    logical :: present = .false.              !! the group stands in the file
    real(wp) :: normal_stiffness = 0.0_wp     !! per metre of line [N/m^(1 + exponent)]
    real(wp) :: exponent = 1.0_wp             !! of the penetration [1]
    real(wp) :: friction_top = 0.0_wp         !! crests on the top foil or the plate above [1]
    real(wp) :: friction_sleeve = 0.0_wp      !! corners on the sleeve [1]
    real(wp) :: stick_length = 0.0_wp         !! tangential displacement at which slip begins [m]
    logical :: may_rub = .false.              !! a coefficient is positive, or complained about
    integer :: friction_law = law_tanh_drag
    integer :: friction_law_in_motion = motion_coulomb
    integer :: friction_direction = direction_tangent_plane
    integer :: contact_surface = surface_mid
  contains
    procedure :: law_in_motion
  end type contact_case_type

contains

  !> Reads the group; without it nothing touches.
  subroutine read_shaft_contact_case(keys, contact, analysis)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(solid_contact_type), intent(out) :: contact !! what `&shaft_contact` asks for
    type(analysis_row_type), intent(in) :: analysis !! of the case file

    call keys%start_group('shaft_contact', optional=.true., present_in_file=contact%present, &
                          misplaced=analysis%refusal('shaft_contact'), acts_on=acts_on_film)
    call keys%idle(unless(contact%present, 'the file has no group &shaft_contact'))
    contact%friction = usual_friction
    call keys%real_key('roughness', contact%roughness, 'm', &
                       'roughness height s of shaft and foil together: asperities carry the '// &
                       'pressure p_0 exp(-h/s) where the film has the thickness h', &
                       positive, .true.)
    call keys%real_key('pressure', contact%pressure, 'Pa', &
                       'pressure p_0 of the asperities at zero film thickness', positive, .true.)
    call keys%real_key('friction', contact%friction, '1', &
                       'friction coefficient of the asperities', from_to(0.0_wp, most_friction))
  end subroutine read_shaft_contact_case

  !> The law of vibrations with an amplitude, and of motions in time.
  elemental integer function law_in_motion(self) result(law)
    class(contact_case_type), intent(in) :: self !! what `&contact` asks for
    law = merge(law_coulomb, self%friction_law, self%friction_law_in_motion == motion_coulomb)
  end function law_in_motion

  !> Reads the group; a strip that touches nothing need not have it.
  subroutine read_contact_case(keys, contact, load, foil, clearance, analysis, model)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(contact_case_type), intent(out) :: contact !! what `&contact` asks for
    type(strip_load_case_type), intent(in) :: load !! what `&strip_load` asks for
    type(bump_foil_case_type), intent(in) :: foil !! what `&bump_foil` asks for
    real(wp), intent(in) :: clearance !! of a bearing [m]
    type(analysis_row_type), intent(in) :: analysis !! of the case file
    type(foil_row_type), intent(in) :: model !! of the foils
    character(len=:), allocatable :: misplaced
    real(wp) :: deflection
    logical :: strip, bearing

    strip = analysis%loads_strip
    bearing = analysis%has_film .and. model%has_bumps
    misplaced = analysis%refusal('contact')
    if (analysis%has_film) misplaced = unless(.not. model%is_known() .or. model%has_bumps, &
                                                 "needs foil = 'shell' in &model, or 'beam'")
    deflection = merge(clearance, typical_deflection(load, foil), bearing)
    call keys%start_group('contact', optional=.not. (strip .or. bearing), &
                          present_in_file=contact%present, misplaced=misplaced, &
                          acts_on=acts_on_contacts)
    call keys%idle(model%needs_bumps())
    call keys%real_key('exponent', contact%exponent, '1', &
                       'exponent of the penetration in the normal force', from_to(1.0_wp, 3.0_wp))
    contact%normal_stiffness = default_stiffness(deflection, foil, contact%exponent)
    call scene_key('normal_stiffness', contact%normal_stiffness, 'N/m^(1+exponent)', &
                   'normal force per metre of contact line over penetration^exponent', &
                   "1e4 times a bump's, from Walowit-Anno")
    call friction_key('friction_top', contact%friction_top, &
                      'friction coefficient of the crests, on the top foil or the plate')
    call friction_key('friction_sleeve', contact%friction_sleeve, &
                      'friction coefficient of the corner lines, on the sleeve')
    call keys%rule('contact', 'friction_sleeve', contact%friction_sleeve > 0.0_wp .and. &
                   load%support == support_held .and. strip, "has no use with support = 'held' "// &
                   'in &strip_load: nothing presses on the sleeve')
    contact%stick_length = merge(stick_in_bearing, stick_part, bearing)*deflection
    if (model%has_bumps) call keys%idle(unless(contact%may_rub, 'there is no friction'))
    call scene_key('stick_length', contact%stick_length, 'm', &
                   'tangential displacement at which a contact goes from stick to slip', &
                   '1/5000 of the typical deflection; bearings: 1/300 of the clearance')
    call read_laws(keys, contact)

  contains

    !> A friction coefficient.
    subroutine friction_key(name, value, meaning)
      character(len=*), intent(in) :: name, meaning
      real(wp), intent(inout) :: value !! [1]
      call keys%real_key(name, value, '1', meaning, from_to(0.0_wp, most_friction))
      contact%may_rub = contact%may_rub .or. value > 0.0_wp .or. &
                        (keys%key%given .and. .not. keys%last_key_is_right())
    end subroutine friction_key

    !> A positive number that follows the scene where it is not given.
    subroutine scene_key(name, value, unit, meaning, default)
      character(len=*), intent(in) :: name, unit, meaning
      character(len=*), intent(in) :: default !! in words
      real(wp), intent(inout) :: value        !! the default on entry
      logical :: right, given

      right = value > lowest .and. value < highest
      if (.not. right) value = 0.0_wp ! the echo could not be read again
      call keys%real_key(name, value, unit, meaning, positive, default=default, given=given)
      ! A foil whose numbers are missing or wrong is complained about elsewhere.
      call keys%rule('contact', name, (strip .or. bearing) .and. &
                     bump_stiffness(foil) > 0.0_wp .and. deflection > 0.0_wp .and. &
                     .not. (right .or. given), 'must be given: its default for these bumps and '// &
                     trim(merge('this clearance', 'their load    ', bearing))//' is out of range')
    end subroutine scene_key
  end subroutine read_contact_case

  !> How contacts rub.
  subroutine read_laws(keys, contact)
    type(case_keys_type), intent(inout) :: keys
    type(contact_case_type), intent(inout) :: contact

    call keys%choice_key('friction_law', contact%friction_law, law_words, &
                         'smoothed law whose stick point is dragged along by the slip, the '// &
                         'same with a new start at each reversal, or elastic sticking up '// &
                         'to Coulomb''s limit')
    call keys%choice_key('friction_law_in_motion', contact%friction_law_in_motion, motion_words, &
                         'law of foils that move, over time and with vibration_amplitudes: '// &
                         'elastic sticking up to Coulomb''s limit, from the friction at rest '// &
                         'on, or friction_law')
    call keys%choice_key('friction_direction', contact%friction_direction, direction_words, &
                         'friction opposes the slip in the tangent plane, or acts along the '// &
                         "shaft's motion alone, as in planar models")
    call keys%choice_key('contact_surface', contact%contact_surface, surface_words, &
                         'forces act where the mid-surfaces are, or at the faces, half a '// &
                         'thickness off: rubbing turns the foils, and their turning rubs')
  end subroutine read_laws

  !> The stiffness with which a penetration of 1e-4 of the typical deflection carries what a bump
  !> carries at that deflection [N/m^(1 + exponent)]; 0 where it is not known.
  elemental real(wp) function default_stiffness(deflection, foil, exponent) result(stiffness)
    real(wp), intent(in) :: deflection !! typical one [m]
    type(bump_foil_case_type), intent(in) :: foil
    real(wp), intent(in) :: exponent  !! of the penetration [1]
    real(wp) :: penetration !! [m]

    stiffness = bumps_stiffness*bump_stiffness(foil)*foil%pitch%value
    penetration = deflection/bumps_stiffness
    if (.not. stiffness > 0.0_wp .or. .not. penetration > 0.0_wp) then
      stiffness = 0.0_wp
    else if (exponent > 1.0_wp) then
      stiffness = stiffness*penetration**(1.0_wp - exponent)
    end if
  end function default_stiffness
end module gfb_contact_case
