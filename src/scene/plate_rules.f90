!> What a plate on crest lines asks of the scene.
module gfb_plate_rules
  use gfb_kinds, only: wp
  use gfb_bearing_case, only: pad_angle, leading_edge_periodic
  use gfb_case_keys, only: case_keys_type
  use gfb_crest_lines, only: crests_on_pad
  use gfb_foil_cases, only: bump_foil_case_type, one_strip
  use gfb_model_case, only: foil_plate, needs_plate
  use gfb_scene, only: scene_type
  use gfb_text, only: text, join
  use gfb_units, only: degrees
  implicit none (type, external)
  private
  public :: check_plate

  character(len=*), parameter :: bumps = 'bump_foil', angles = 'crest_angles'
  real(wp), parameter :: rounding = 1.0e-9_wp !! of lengths that fit exactly, relative

contains

  !> Checks a scene with a plate, and that others have none of its parameters.
  subroutine check_plate(keys, scene)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(scene_type), intent(in) :: scene !! what the case file asks for
    character(len=*), parameter :: needed(*) = [character(len=14) :: 'thickness', &
      'youngs_modulus', 'poissons_ratio', 'half_length', 'pitch or bumps']
    logical :: missing(size(needed)), placed
    integer :: i

    call keys%refuse(bumps, angles, all(scene%model%foil /= [0, foil_plate]), needs_plate)
    if (scene%model%foil /= foil_plate) return
    missing = [(.not. (keys%meant(bumps, trim(needed(i))) .or. keys%meant(bumps, 'strip_'// &
                trim(needed(i)))), i=1, size(needed))]
    missing(5) = .not. (keys%meant(bumps, 'pitch') .or. keys%meant(bumps, 'bumps') .or. &
                        keys%meant(bumps, 'strip_pitch'))
    call keys%rule('model', 'foil', any(missing) .and. &
                   .not. keys%meant('model', 'crest_stiffness'), "'plate' needs "// &
                   'crest_stiffness, or what is missing in &bump_foil: '// &
                   join(pack(needed, missing), ', '))
    call keys%refuse('model', 'foundation_stiffness, foundation_exponent, '// &
                     'foundation_pressure', .true., "has no use with foil = 'plate': "// &
                     'crest_stiffness stands for it')
    placed = keys%meant(bumps, angles)
    call keys%rule('model', 'foil', missing(5) .and. .not. placed, "'plate' needs crests: "// &
                   'pitch or crest_angles in &bump_foil')
    call keys%rule(bumps, angles, placed .and. keys%meant(bumps, 'bumps'), 'cannot stand '// &
                   'beside bumps: give one of them')
    call keys%rule('bearing', 'leading_edge_condition', scene%bearing%leading_edge_condition == &
                   leading_edge_periodic, "must be 'slit' with foil = 'plate': a foil has edges")
    call check_lines(keys, scene)
  end subroutine check_plate

  !> Crests lie on the pad, one after the other.
  subroutine check_lines(keys, scene)
    type(case_keys_type), intent(inout) :: keys
    type(scene_type), intent(in) :: scene
    type(bump_foil_case_type) :: foil
    real(wp), allocatable :: angle(:)
    real(wp) :: radius, last
    integer :: n, strip

    associate (bearing => scene%bearing, given => scene%bump_foil)
      if (.not. min(bearing%radius, bearing%length) > 0.0_wp) return
      call keys%rule(bumps, 'cut_width', given%strips > 1 .and. real(given%strips - 1, wp)* &
                     given%cut_width >= bearing%length, 'leaves nothing of the strips: they '// &
                     'share '//text(bearing%length)//' m')
      call keys%rule('model', 'spring_pitch', scene%model%spring_pitch > bearing%length/ &
                     real(given%strips, wp), 'must be at most the length of a crest')
      n = size(given%crest_angles)
      call keys%rule(bumps, angles, any(given%crest_angles(2:) <= given%crest_angles(:n - 1)), &
                     'must rise from crest to crest')
      call keys%rule(bumps, angles, any(given%crest_angles > pad_angle(bearing)* &
                     (1.0_wp + rounding)), 'must lie on the pad, which ends at '// &
                     text(pad_angle(bearing)*degrees, 4)//' deg')
      if (n > 0) return
      if (.not. given%pitch%value > 0.0_wp) return
      do strip = 1, given%strips
        foil = one_strip(given, strip)
        radius = bearing%radius
        if (bearing%is_thrust()) radius = bearing%inner_radius + bearing%length* &
                                          (real(strip, wp) - 0.5_wp)/real(given%strips, wp)
        angle = crests_on_pad(bearing, foil, radius)
        if (size(angle) == 0) then
          call keys%complain(bumps, 'pitch', 'leaves no room for a bump on the pad')
          return
        end if
        last = angle(size(angle)) + foil%half_length%value/radius
        if (bearing%is_thrust() .and. last > pad_angle(bearing)*(1.0_wp + rounding)) then
          call keys%complain(bumps, 'bumps', text(foil%bumps)//' bumps of the pitch '// &
                             text(foil%pitch%value)//' m end at '//text(last*degrees, 4)// &
                             ' deg, past the edge of the pad at '// &
                             text(pad_angle(bearing)*degrees, 4)//' deg')
          return
        end if
      end do
    end associate
  end subroutine check_lines
end module gfb_plate_rules
