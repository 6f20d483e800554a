!> Strips side by side with sizes of their own: shells can serve them, where their bumps fit.
module gfb_own_strip_rules
  use gfb_kinds, only: wp
  use gfb_bearing_case, only: pad_length
  use gfb_bump_foil_case, only: bump_foil_case_type, strips_differ, one_strip, bump_pitches, &
                                bump_half_lengths, bump_heights, bump_thicknesses
  use gfb_bump_list, only: complain_of_bumps
  use gfb_case_keys, only: case_keys_type
  use gfb_model_case, only: foil_beam, half_width_yes
  use gfb_scene, only: scene_type
  use gfb_scene_case, only: analysis_strip, is_bearing
  use gfb_shape_rules, only: thin, thin_in_bump, low_in_pad
  use gfb_strip_load_case, only: load_plates
  use gfb_strip_sizes, only: sizes_mirror
  use gfb_text, only: text
  implicit none (type, external)
  private
  public :: check_own_strips, strips_mirror

  character(len=*), parameter :: group = 'bump_foil'
  real(wp), parameter :: most_bumps = 1.0e6_wp !! with sizes of their own
  real(wp), parameter :: rounding = 1.0e-9_wp !! of lengths that fit exactly, relative

contains

  !> Complains about strips that the scene cannot have, all of them at once.
  subroutine check_own_strips(keys, scene)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(scene_type), intent(in) :: scene !! what the case file asks for

    associate (foil => scene%bump_foil)
      if (scene%model%half_width == half_width_yes) call check_mirrors(keys, scene)
      if (.not. strips_differ(foil)) return
      if (real(foil%bumps, wp)*real(foil%strips, wp) > most_bumps) then
        call keys%complain(group, 'bumps', text(foil%bumps)//' bumps on '//text(foil%strips)// &
                           ' strips with sizes of their own are more than '// &
                           text(nint(most_bumps)))
        return
      end if
      call check_bumps(keys, foil)
      if (scene%bearing%radius > 0.0_wp) then
        call check_flatness(keys, foil, scene%bearing%radius)
        call check_room(keys, foil, pad_length(scene%bearing))
      end if
      call check_models(keys, scene)
    end associate
  end subroutine check_own_strips

  !> Whether the strips mirror each other about the midplane; one does.
  pure function strips_mirror(scene) result(mirror)
    type(scene_type), intent(in) :: scene !! what the case file asks for
    logical :: mirror
    mirror = sizes_mirror(scene%bump_foil%strip) .and. .not. heights_differ(scene)
  end function strips_mirror

  !> Whether strips have random heights of their own; planar beams have one cross-section.
  pure function heights_differ(scene) result(differ)
    type(scene_type), intent(in) :: scene
    logical :: differ

    differ = scene%bump_foil%strips > 1 .and. scene%bump_foil%random%deviation > 0.0_wp
    if (is_bearing(scene%general%analysis)) differ = differ .and. scene%model%foil /= foil_beam
  end function heights_differ

  !> Complains about strips that half the width cannot have.
  subroutine check_mirrors(keys, scene)
    type(case_keys_type), intent(inout) :: keys
    type(scene_type), intent(in) :: scene
    character(len=*), parameter :: rule = 'needs strips that mirror each other about the midplane: '

    if (.not. sizes_mirror(scene%bump_foil%strip)) then
      call keys%complain('model', 'half_width', rule// &
                         'lists in &bump_foil that read the same from both ends')
    else if (heights_differ(scene)) then
      call keys%complain('model', 'half_width', rule//'with height_deviation each has heights '// &
                         'of its own')
    end if
  end subroutine check_mirrors

  !> What of the scene knows strips of one kind only.
  subroutine check_models(keys, scene)
    type(case_keys_type), intent(inout) :: keys
    type(scene_type), intent(in) :: scene

    associate (foil => scene%bump_foil)
      if (is_bearing(scene%general%analysis) .and. scene%model%foil == foil_beam) then
        if (allocated(foil%strip%pitch)) call refuse('strip_pitch')
        if (allocated(foil%strip%half_length)) call refuse('strip_half_length')
        if (allocated(foil%strip%height)) call refuse('strip_height')
        if (allocated(foil%strip%thickness)) call refuse('strip_thickness')
        if (allocated(foil%strip%offset)) call refuse('strip_offset')
      end if
      if (scene%general%analysis == analysis_strip .and. &
          scene%strip_load%kind /= load_plates .and. allocated(foil%strip%pitch)) then
        call keys%complain(group, 'strip_pitch', 'must be alike for all strips, or needs '// &
                           "kind = 'plates' in &strip_load: the force of a crest is shared evenly")
      end if
    end associate

  contains

    !> Complains about a key that planar beams cannot serve.
    subroutine refuse(key)
      character(len=*), intent(in) :: key
      call keys%complain(group, key, 'must be alike for all strips, or needs foil = '// &
                         "'shell' in &model: planar beams have one cross-section")
    end subroutine refuse
  end subroutine check_models

  !> Bumps of a strip that overlap, are more than half a circle, or are no thin shells.
  subroutine check_bumps(keys, foil)
    type(case_keys_type), intent(inout) :: keys
    type(bump_foil_case_type), intent(in) :: foil
    real(wp), dimension(foil%strips) :: height, highest, pitch, arc, thickness, thickest
    logical :: flats(foil%bumps, foil%strips)
    type(bump_foil_case_type) :: one
    integer :: strip, worst

    if (foil%bumps < 1) return
    do strip = 1, foil%strips
      one = one_strip(foil, strip)
      associate (half => bump_half_lengths(one), high => bump_heights(one), &
                 long => bump_pitches(one), thick => bump_thicknesses(one))
        worst = maxloc(high - half, 1)
        height(strip) = high(worst)
        highest(strip) = half(worst)
        worst = minloc(long - 2.0_wp*half, 1)
        pitch(strip) = long(worst)
        arc(strip) = 2.0_wp*half(worst)
        worst = maxloc(thick - thin_in_bump*half, 1)
        thickness(strip) = thick(worst)
        thickest(strip) = thin_in_bump*half(worst)
        flats(:, strip) = long > 2.0_wp*half*(1.0_wp + rounding)
      end associate
    end do
    call check('height', height > highest, height, 'must not exceed half_length: a bump is at '// &
               'most half a circle', 'half_length', highest)
    call check('pitch', pitch < arc*(1.0_wp - rounding), pitch, 'must be at least 2 '// &
               'half_length, or bumps overlap', '2 half_length', arc)
    call check('thickness', thickness >= thickest, thickness, 'must be less than half of '// &
               'half_length: a bump is a thin shell', 'half of half_length', thickest)
    if (any(pitch < arc*(1.0_wp - rounding))) return
    if (any(flats .neqv. spread(flats(:, 1), 2, foil%strips))) then
      call keys%complain(group, key_of(keys, 'pitch'), 'must leave flats on all strips, or on '// &
                         'none')
    end if

  contains

    !> Complains about the strips where a size is wrong; one that is not known is not.
    subroutine check(name, wrong, value, rule, other, limit)
      character(len=*), intent(in) :: name, rule, other
      logical, intent(in) :: wrong(:)
      real(wp), intent(in) :: value(:), limit(:) !! [m]

      call complain_of_bumps(keys, key_of(keys, name), &
                             wrong .and. value > 0.0_wp .and. limit > 0.0_wp, value, rule, &
                             other, limit, 'strip')
    end subroutine check
  end subroutine check_bumps

  !> Strips that are not low and thin against the bearing, on whose pad they are unrolled.
  subroutine check_flatness(keys, foil, radius)
    type(case_keys_type), intent(inout) :: keys
    type(bump_foil_case_type), intent(in) :: foil
    real(wp), intent(in) :: radius !! of the bearing [m]
    real(wp), dimension(foil%strips) :: height, thickness
    type(bump_foil_case_type) :: one
    integer :: strip

    do strip = 1, foil%strips
      one = one_strip(foil, strip)
      height(strip) = maxval(bump_heights(one))
      thickness(strip) = maxval(bump_thicknesses(one))
    end do
    call complain_of_bumps(keys, key_of(keys, 'thickness'), thickness >= thin*radius, thickness, &
                           'must be less than 1/20 of the radius: the foil is a thin shell, '// &
                           'unrolled', '1/20 of the radius', &
                           spread(thin*radius, 1, foil%strips), 'strip')
    call complain_of_bumps(keys, key_of(keys, 'height'), height >= low_in_pad*radius, height, &
                           'must be less than 1/4 of the radius: the strip is unrolled', &
                           '1/4 of the radius', spread(low_in_pad*radius, 1, foil%strips), 'strip')
  end subroutine check_flatness

  !> Strips that reach beyond the pad.
  subroutine check_room(keys, foil, length)
    type(case_keys_type), intent(inout) :: keys
    type(bump_foil_case_type), intent(in) :: foil
    real(wp), intent(in) :: length !! of the pad [m]
    real(wp) :: reach(foil%strips)
    type(bump_foil_case_type) :: one
    character(len=:), allocatable :: key
    integer :: strip

    do strip = 1, foil%strips
      one = one_strip(foil, strip)
      reach(strip) = one%offset + sum(bump_pitches(one))
    end do
    key = key_of(keys, 'pitch')
    if (keys%holds(group, 'strip_offset')) key = 'strip_offset'
    call complain_of_bumps(keys, key, reach > length*(1.0_wp + rounding), reach, 'a strip with '// &
                           'its offset must not be longer than the pad', 'the pad', &
                           spread(length, 1, foil%strips), 'strip')
  end subroutine check_room

  !> The key that gives a size: of strips, of bumps, or of all.
  function key_of(keys, name) result(key)
    type(case_keys_type), intent(in) :: keys
    character(len=*), intent(in) :: name !! of the single size
    character(len=:), allocatable :: key

    key = name
    if (keys%holds(group, 'bump_'//name)) key = 'bump_'//name
    if (keys%holds(group, 'strip_'//name)) key = 'strip_'//name
  end function key_of
end module gfb_own_strip_rules
