!> What a plate on crest lines asks of the scene.
module gfb_plate_rules
  use gfb_kinds, only: wp
  use gfb_bearing_case, only: pad_angle, leading_edge_periodic
  use gfb_case_keys, only: case_keys_type
  use gfb_crest_lines, only: crest_line_type, crest_lines
  use gfb_foil_cases, only: bump_foil_case_type, missing_of_bumps, one_strip
  use gfb_model_case, only: needs_plate
  use gfb_scene, only: scene_type
  use gfb_text, only: text
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
    character(len=:), allocatable :: missing
    logical :: pitched, placed

    call keys%refuse(bumps, angles, scene%model%foil%is_known() .and. .not. &
                     scene%model%foil%has_crest_springs, needs_plate)
    if (.not. scene%model%foil%has_crest_springs) return
    missing = missing_of_bumps(keys, .true., pitched)
    call keys%rule('model', 'foil', missing /= '' .and. &
                   .not. keys%meant('model', 'crest_stiffness'), "'plate' needs "// &
                   'crest_stiffness, or what is missing in &bump_foil: '//missing)
    call keys%refuse('model', 'foundation_stiffness, foundation_exponent, '// &
                     'foundation_pressure', .true., "has no use with foil = 'plate': "// &
                     'crest_stiffness stands for it')
    placed = keys%meant(bumps, angles)
    call keys%rule('model', 'foil', (.not. pitched) .and. .not. placed, "'plate' needs crests: "// &
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
    type(crest_line_type), allocatable :: lines(:)
    type(bump_foil_case_type) :: foil
    real(wp) :: last
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
      call warn_of_near_crests(keys, scene)
      if (n > 0) return
      if (.not. given%pitch%value > 0.0_wp) return
      do strip = 1, given%strips
        foil = one_strip(given, strip)
        lines = crest_lines(scene)
        lines = pack(lines, lines%strip == strip)
        n = size(lines)
        if (n == 0) then
          call keys%complain(bumps, 'pitch', 'leaves no room for a bump on the pad')
          return
        end if
        last = lines(n)%angle + foil%half_length%value/lines(n)%mean_radius
        if (bearing%row%has_sectors .and. last > pad_angle(bearing)*(1.0_wp + rounding)) then
          call keys%complain(bumps, 'bumps', text(foil%bumps)//' bumps of the pitch '// &
                             text(foil%pitch%value)//' m end at '//text(last*degrees, 4)// &
                             ' deg, past the edge of the pad at '// &
                             text(pad_angle(bearing)*degrees, 4)//' deg')
          return
        end if
      end do
    end associate
  end subroutine check_lines

  !> Warns of crests that stand nearer to each other than an element is long: one of them has no
  !> side of its own, or the elements there are out of proportion.
  subroutine warn_of_near_crests(keys, scene)
    type(case_keys_type), intent(inout) :: keys
    type(scene_type), intent(in) :: scene
    real(wp) :: element !! [rad]
    integer :: i

    if (scene%mesh%circumferential_elements < 1) return
    element = pad_angle(scene%bearing)/real(scene%mesh%circumferential_elements, wp)
    associate (crests => scene%bump_foil%crest_angles)
      do i = 2, size(crests)
        if (crests(i) <= crests(i - 1)) return
        if (crests(i) - crests(i - 1) >= element*(1.0_wp - rounding)) cycle
        call keys%warn(bumps, angles, 'puts a crest '// &
                       text((crests(i) - crests(i - 1))/element, 2)//' of an element behind '// &
                       'the one before it: give more circumferential_elements', i)
        return
      end do
    end associate
  end subroutine warn_of_near_crests
end module gfb_plate_rules
