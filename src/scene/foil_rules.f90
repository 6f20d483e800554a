!> Foils as they are built: gaps at crests need a model in which crests touch something, sizes bump
!> by bump one that has the bumps, foils that lie with a force at rest one in which they give way;
!> strips side by side with sizes of their own need shells, and room for their bumps.
module gfb_foil_rules
  use gfb_kinds, only: wp
  use gfb_bearing_case, only: pad_length
  use gfb_bump_foil_case, only: bump_pitches, bump_half_lengths, bump_heights, fixed_edge_none, &
                                bump_foil_case_type, strips_differ, one_strip, bump_thicknesses
  use gfb_case_keys, only: case_keys_type
  use gfb_foil_sizes, only: complain_of_bumps, sizes_mirror
  use gfb_model_case, only: coupling_partitioned, foil_elastic_foundation, foil_rigid, foil_shell, &
                            foundation_pressure_local, meshes_foils, foil_beam, half_width_yes
  use gfb_modes_case, only: part_strip, part_top_foil
  use gfb_scene, only: scene_type
  use gfb_scene_case, only: analysis_modes, analysis_strip, is_bearing
  use gfb_shape_rules, only: thin, thin_in_bump, low_in_pad
  use gfb_strip_load_case, only: load_plates, support_held
  use gfb_text, only: text
  use gfb_top_foil_case, only: initial_curvature
  implicit none (type, external)
  private
  public :: check_crest_gaps, check_bump_sizes, check_assembly, check_own_strips, strips_mirror

  character(len=*), parameter :: group = 'bump_foil'
  character(len=*), parameter :: interference = 'assembly_interference'
  character(len=*), parameter :: monolithic = "needs coupling = 'monolithic' in &model: film"// &
                                 ' and foil in turns begin with a foil at rest without forces'
  real(wp), parameter :: steepest = 0.9_wp !! height of a bump of shells, over half its length [1]
  real(wp), parameter :: rise = 0.0704_wp !! of a foil that springs open, over kappa_0 R^2 [1]
  real(wp), parameter :: rounding = 1.0e-9_wp !! of lengths that fit exactly, relative
  real(wp), parameter :: most_bumps = 1.0e6_wp !! with sizes of their own

contains

  !> Complains about gaps where no crest can close one.
  subroutine check_crest_gaps(keys, scene)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(scene_type), intent(in) :: scene !! what the case file asks for
    character(len=*), parameter :: key(*) = [character(len=16) :: 'crest_gap', 'height_deviation']
    character(len=:), allocatable :: words

    words = ''
    associate (analysis => scene%general%analysis)
      if (is_bearing(analysis) .and. scene%model%foil > 0) then
        if (.not. meshes_foils(scene%model%foil)) then
          words = "needs foil = 'shell' in &model, or 'beam': no other foil has crests"
        end if
      else if (analysis == analysis_strip .and. scene%strip_load%kind /= load_plates) then
        words = "needs kind = 'plates' in &strip_load: a force that is given acts on its crest "// &
                'wherever that is'
      else if (analysis == analysis_modes) then
        words = 'needs a bearing or a strip between plates: modes are those of foils that '// &
                'touch nothing'
      end if
    end associate
    call complain_of(keys, key, words)
    call check_corner_gaps(keys, scene)
  end subroutine check_crest_gaps

  !> Complains about gaps at corners that touch nothing, are two bumps', or leave the strip in air.
  subroutine check_corner_gaps(keys, scene)
    type(case_keys_type), intent(inout) :: keys
    type(scene_type), intent(in) :: scene
    character(len=*), parameter :: key(*) = [character(len=10) :: 'corner_gap']
    character(len=:), allocatable :: words

    words = ''
    associate (analysis => scene%general%analysis, foil => scene%bump_foil)
      if (.not. allocated(foil%corner_gap)) return
      if (is_bearing(analysis) .and. scene%model%foil > 0 .and. &
          .not. meshes_foils(scene%model%foil)) then
        words = "needs foil = 'shell' in &model, or 'beam': no other foil has corners"
      else if (analysis == analysis_modes) then
        words = 'needs a bearing or a strip under load: modes are those of foils that touch nothing'
      else if (analysis == analysis_strip .and. scene%strip_load%support == support_held) then
        words = "needs support = 'contact' in &strip_load: corner lines that are held cannot move"
      else if (any(bump_pitches(foil) <= 2.0_wp*bump_half_lengths(foil)*(1.0_wp + rounding)) .and. &
               maxval(foil%corner_gap) > minval(foil%corner_gap)) then
        words = 'needs flats at all bumps: without one two bumps share a corner line'
      else if (foil%fixed_edge == fixed_edge_none .and. minval(foil%corner_gap) > 0.0_wp) then
        words = 'must be 0 for a bump at least, or nothing holds a strip that is fixed nowhere'
      else if (.not. maxval(foil%corner_gap) < foil%height .and. foil%height > 0.0_wp) then
        words = 'must be less than the height of the bumps, '//text(foil%height)//' m'
      end if
    end associate
    call complain_of(keys, key, words)
  end subroutine check_corner_gaps

  !> Complains about sizes bump by bump where there is one bump, or none.
  subroutine check_bump_sizes(keys, scene)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(scene_type), intent(in) :: scene !! what the case file asks for
    character(len=*), parameter :: key(*) = [character(len=16) :: 'bump_pitch', &
                                             'bump_half_length', 'bump_height', 'bump_thickness']
    character(len=:), allocatable :: words

    words = ''
    associate (analysis => scene%general%analysis, part => scene%modes%part)
      if (is_bearing(analysis) .and. scene%model%foil > 0) then
        if (.not. meshes_foils(scene%model%foil)) then
          words = "needs foil = 'shell' in &model, or 'beam': no other foil has bumps"
          if (scene%bump_foil%strips > 1) call keys%complain(group, 'strips', words)
        end if
      else if (analysis == analysis_modes .and. part > 0) then
        if (scene%bump_foil%strips > 1) then
          call keys%complain(group, 'strips', 'must be 1 for modes: each strip has its own')
        end if
        if (part /= part_strip .and. part /= part_top_foil) then
          words = "needs part = 'strip' in &modes: the other parts are those of one bump"
        end if
      else if (analysis == analysis_strip .and. scene%bump_foil%strips > 1 .and. &
               scene%mesh%edge_refinement > 1.0_wp) then
        call keys%complain('mesh', 'edge_refinement', 'must be 1 for strips side by side: each '// &
                           'has equal rows')
      end if
    end associate
    call complain_of(keys, key, words)
    call check_nested_strips(keys, scene)
    call check_steepness(keys, scene)
  end subroutine check_bump_sizes

  !> Complains about bumps of shells whose arcs stand nearly upright on the flats: a rotation about
  !> the one's director is none that the other's nodes have.
  subroutine check_steepness(keys, scene)
    type(case_keys_type), intent(inout) :: keys
    type(scene_type), intent(in) :: scene

    character(len=*), parameter :: rule = 'must not exceed 0.9 of half_length with shells: '// &
                                   'arcs would stand upright on the flats'

    associate (foil => scene%bump_foil)
      if (scene%model%foil /= foil_shell .or. foil%bumps < 1 .or. foil%strips > 1) return
      associate (high => bump_heights(foil), half => bump_half_lengths(foil))
        if (any(high > half) .or. .not. any(high > steepest*half)) return
        if (allocated(foil%bump_height)) then
          call complain_of_bumps(keys, 'bump_height', high > steepest*half, high, rule, &
                                 'half_length', half)
        else if (allocated(foil%bump_half_length)) then
          call complain_of_bumps(keys, 'height', high > steepest*half, high, rule, &
                                 'half_length', half)
        else
          call keys%complain(group, 'height', rule//', and half_length is '// &
                             text(half(1))//' m')
        end if
      end associate
    end associate
  end subroutine check_steepness

  !> Complains where the meshes of an estimated error would not refine each other: each must share
  !> its elements out evenly among the strips.
  subroutine check_nested_strips(keys, scene)
    type(case_keys_type), intent(inout) :: keys
    type(scene_type), intent(in) :: scene
    integer :: multiple

    if (scene%bump_foil%strips <= 1 .or. .not. scene%accuracy%present) return
    multiple = merge(4, 8, modulo(scene%bump_foil%strips, 2) == 0)*scene%bump_foil%strips
    if (modulo(scene%mesh%axial_elements, multiple) == 0) return
    call keys%complain(group, 'strips', 'needs axial_elements in &mesh that are a '// &
                       'multiple of '//text(multiple)//', not '// &
                       text(scene%mesh%axial_elements)//', so that the meshes of &accuracy '// &
                       'refine each other')
  end subroutine check_nested_strips

  !> Complains about keys of the bump foil that stand in the file; not where there are no words.
  subroutine complain_of(keys, key, words)
    type(case_keys_type), intent(inout) :: keys
    character(len=*), intent(in) :: key(:), words
    integer :: i

    if (words == '') return
    do i = 1, size(key)
      if (.not. keys%meant(group, trim(key(i)))) cycle
      call keys%complain(group, trim(key(i)), words)
    end do
  end subroutine complain_of

  !> Complains about a foil that cannot give way, and warns of one that rises by more than there
  !> is room for.
  subroutine check_assembly(keys, scene)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(scene_type), intent(in) :: scene !! what the case file asks for
    logical :: partitioned

    partitioned = scene%model%coupling == coupling_partitioned
    if (scene%bearing%interference > 0.0_wp) then
      if (.not. is_bearing(scene%general%analysis)) then
        call keys%complain('bearing', interference, 'needs a bearing with a film')
      else if (scene%model%foil == foil_rigid) then
        call keys%complain('bearing', interference, 'needs a foil that gives way: '// &
                           "another one than 'rigid' in &model; a smaller clearance is the same")
      else if (partitioned) then
        call keys%complain('bearing', interference, monolithic)
      else if (scene%model%foil == foil_elastic_foundation .and. &
               scene%model%foundation_pressure == foundation_pressure_local .and. &
               scene%bearing%clearance > 0.0_wp .and. &
               scene%bearing%interference >= scene%bearing%clearance) then
        call keys%complain('bearing', interference, 'needs foundation_pressure = '// &
                           "'axial_mean' in &model: under the local pressure the sides, at "// &
                           'ambient pressure, never give way')
      end if
    end if
    if (.not. scene%top_foil%free_radius > 0.0_wp) return
    if (.not. is_bearing(scene%general%analysis)) then
      call keys%complain('top_foil', 'free_radius', &
                         'needs a bearing: no other top foil lies in a bore')
    else if (scene%model%foil > 0 .and. .not. meshes_foils(scene%model%foil)) then
      call keys%complain('top_foil', 'free_radius', "needs foil = 'shell' in &model, or "// &
                         "'beam': no other foil bends")
    else if (partitioned) then
      call keys%complain('top_foil', 'free_radius', monolithic)
    else if (scene%model%foil > 0) then
      call warn_of_rise(keys, scene)
    end if
  end subroutine check_assembly

  !> Warns where the foil at rest rises over its bumps by more than the clearance.
  subroutine warn_of_rise(keys, scene)
    type(case_keys_type), intent(inout) :: keys
    type(scene_type), intent(in) :: scene
    real(wp) :: height !! [m]

    associate (bearing => scene%bearing)
      if (.not. (bearing%radius > 0.0_wp .and. bearing%clearance > 0.0_wp)) return
      height = rise*abs(initial_curvature(scene%top_foil, bearing%radius))*bearing%radius**2
      if (height < bearing%clearance) return
      call keys%warn('top_foil', 'free_radius', 'lets the foil rise over its bumps at '// &
                     'rest by '//text(height, 3)//' m or more, and the clearance is '// &
                     text(bearing%clearance)//' m')
    end associate
  end subroutine warn_of_rise

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
      call check_own_bumps(keys, foil)
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
  subroutine check_own_bumps(keys, foil)
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
  end subroutine check_own_bumps

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
end module gfb_foil_rules
