!> Foils as they are built: gaps at crests need a model in which crests touch something, sizes bump
!> by bump one that has the bumps, foils that lie with a force at rest one in which they deflect;
!> strips side by side with sizes of their own need shells, and room for their bumps.
module gfb_foil_rules
  use gfb_kinds, only: wp
  use gfb_foil_cases, only: bump_foil_case_type, has_sizes, one_bump, strips_differ, &
                            fixed_edge_none, fixed_edge_trailing, has_flats, bumps_overlap, &
                            one_strip, sizes_mirror, complain_of_sizes, size_type
  use gfb_top_foil_case, only: initial_curvature
  use gfb_case_keys, only: case_keys_type
  use gfb_model_case, only: needs_meshes, coupling_partitioned, half_width_yes
  use gfb_scene, only: scene_type
  use gfb_text, only: text
  use gfb_bearing_case, only: bearing_case_type, pad_length, leading_edge_periodic
  use gfb_fixed_lines, only: fixed_line_corner
  use gfb_study_cases, only: part_strip, part_top_foil, part_flat, quantity_words, asked_name, &
                             quantities_of, of_top_foil, of_bump_foil
  use gfb_shape_rules, only: thin, thin_in_bump, low_in_pad
  use gfb_strip_load_case, only: load_plates, support_held
  implicit none (type, external)
  private
  public :: check_foils, strips_mirror

  character(len=*), parameter :: group = 'bump_foil'
  character(len=*), parameter :: monolithic = "needs coupling = 'monolithic' in &model: film"// &
                                 ' and foil in turns begin with a foil at rest without forces'
  real(wp), parameter :: steepest = 0.9_wp !! height of a bump of shells, over half its length [1]
  real(wp), parameter :: rise = 0.0704_wp !! of a foil that springs open, over kappa_0 R^2 [1]
  real(wp), parameter :: rounding = 1.0e-9_wp !! of lengths that fit exactly, relative
  real(wp), parameter :: most_bumps = 1.0e6_wp !! with sizes of their own

contains

  !> Checks the foils of a scene.
  subroutine check_foils(keys, scene)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(scene_type), intent(in) :: scene !! what the case file asks for

    call check_strip(keys, scene)
    call check_uses(keys, scene)
    call check_gaps(keys, scene)
    call check_bump_sizes(keys, scene)
    call check_steepness(keys, scene)
    call check_own_strips(keys, scene)
    call check_assembly(keys, scene)
    call check_stresses(keys, scene)
  end subroutine check_foils

  !> Stresses are those of foils with meshes.
  subroutine check_stresses(keys, scene)
    type(case_keys_type), intent(inout) :: keys
    type(scene_type), intent(in) :: scene
    character(len=:), allocatable :: name

    associate (derived => scene%sensitivity, foil => scene%model%foil)
      if (.not. scene%general%analysis%has_film .or. .not. foil%is_known()) return
      call refuse('sensitivity', derived%asks(of_top_foil), derived%asks(of_bump_foil))
      if (scene%accuracy%quantity == 0) return
      name = asked_name(scene%accuracy)
      call refuse('accuracy', any(pack(quantity_words, quantities_of(of_top_foil)) == name), &
                  any(pack(quantity_words, quantities_of(of_bump_foil)) == name))
    end associate

  contains

    !> Complains of what foils without such a mesh do not have.
    subroutine refuse(group, of_top, of_bumps)
      character(len=*), intent(in) :: group
      logical, intent(in) :: of_top, of_bumps !! stress is asked for
      call keys%rule(group, 'quantity', of_top .and. .not. scene%model%foil%has_top_foil, &
                     "names a stress of foils: needs foil = 'shell', 'beam' or 'plate' in &model")
      call keys%rule(group, 'quantity', of_bumps .and. .not. scene%model%foil%has_bumps, &
                     "names a stress of bumps: needs foil = 'shell' or 'beam' in &model")
    end subroutine refuse
  end subroutine check_stresses

  !> Whether the scene is a bearing whose foils are known, and have no meshes of their own.
  pure logical function lacks_bumps(scene) result(lacks)
    type(scene_type), intent(in) :: scene
    lacks = scene%general%analysis%has_film .and. scene%model%foil%is_known() .and. &
            .not. scene%model%foil%has_bumps
  end function lacks_bumps

  !> A bump foil that is meshed: its flats, its strips.
  subroutine check_strip(keys, scene)
    type(case_keys_type), intent(inout) :: keys
    type(scene_type), intent(in) :: scene
    integer :: edge !! bump at the fixed one
    logical :: whole !! the whole strip is meshed

    associate (foil => scene%bump_foil, part => scene%modes%part, &
               modes => scene%general%analysis%finds_modes)
      whole = scene%general%analysis%loads_strip .or. &
              (scene%general%analysis%has_film .and. scene%model%foil%has_bumps)
      if (.not. (whole .or. modes) .or. (modes .and. part == part_top_foil)) return
      whole = whole .or. part == part_strip
      ! A pitch that is shorter is complained about elsewhere.
      if (foil%half_length%value > 0.0_wp .and. &
          .not. (has_flats(foil) .or. bumps_overlap(foil))) then
        if (modes .and. part == part_flat) then
          call keys%complain('modes', 'part', 'there are no flats: pitch in &bump_foil is 2 '// &
                             'half_length')
        else
          call keys%rule(group, 'fixed_line', whole .and. foil%fixed_line > fixed_line_corner, &
                         'there are no flats: pitch is 2 half_length')
        end if
      end if
      if (whole .and. has_sizes(foil) .and. has_flats(foil) .and. &
          foil%fixed_line > fixed_line_corner .and. foil%bumps > 0) then
        edge = merge(foil%bumps, 1, foil%fixed_edge == fixed_edge_trailing)
        call keys%rule(group, 'fixed_line', .not. has_flats(one_bump(foil, edge)), 'the bump '// &
                       'at the fixed edge, '//text(edge)//', has no flat: its pitch is 2 '// &
                       'half_length')
      end if
      call keys%rule(group, 'strips', foil%strips > scene%mesh%axial_elements, &
                     'must not be more than axial_elements = '//text(scene%mesh%axial_elements)// &
                     ' in &mesh: each strip has its share of them')
    end associate
  end subroutine check_strip

  !> A bearing of shells or beams: its strip is fixed at an edge and as wide as it, its pad open.
  !> Plates are either forced or moved. The meshes of an estimated error refine each other only
  !> where each shares its elements out evenly among the strips.
  subroutine check_uses(keys, scene)
    type(case_keys_type), intent(inout) :: keys
    type(scene_type), intent(in) :: scene
    logical :: meshed, forced, moved, plates
    integer :: multiple

    associate (foil => scene%bump_foil, bearing => scene%bearing, &
               elements => scene%mesh%axial_elements)
      meshed = scene%general%analysis%has_film .and. scene%model%foil%has_bumps
      call keys%rule(group, 'fixed_edge', meshed .and. foil%fixed_edge == fixed_edge_none, &
                     "must be 'leading' or 'trailing' in a bearing")
      if (meshed) call keys%rule('bearing', 'leading_edge_condition', &
                                 bearing%leading_edge_condition == leading_edge_periodic, &
                                 "must be 'slit' with foil = '"//trim(scene%model%foil%word)// &
                                 "': a foil has edges")
      call keys%rule(group, 'width', meshed .and. min(bearing%length, foil%width) > 0.0_wp .and. &
                     abs(foil%width - bearing%length) > rounding*bearing%length, &
                     'must be the length of the bearing, '//text(bearing%length)//' m')
      plates = scene%general%analysis%loads_strip .and. scene%strip_load%kind == load_plates
      forced = keys%meant('strip_load', 'maximum_force')
      moved = keys%meant('strip_load', 'maximum_displacement')
      call keys%rule('strip_load', 'maximum_displacement', plates .and. forced .and. moved, &
                     'has no use beside maximum_force: plates are either forced or moved')
      call keys%rule('strip_load', 'kind', plates .and. .not. (forced .or. moved), &
                     'needs maximum_force or maximum_displacement')
      multiple = merge(4, 8, modulo(foil%strips, 2) == 0)*foil%strips
      call keys%rule(group, 'strips', foil%strips > 1 .and. scene%accuracy%present .and. &
                     modulo(elements, multiple) /= 0, 'needs axial_elements in &mesh that are '// &
                     'a multiple of '//text(multiple)//', not '//text(elements)// &
                     ', so that the meshes of &accuracy refine each other')
    end associate
  end subroutine check_uses

  !> Complains about gaps where no crest can close one, and at corners that touch nothing, are two
  !> bumps', or leave the strip in air.
  subroutine check_gaps(keys, scene)
    type(case_keys_type), intent(inout) :: keys
    type(scene_type), intent(in) :: scene
    character(len=*), parameter :: gaps = 'crest_gap, height_deviation'
    character(len=:), allocatable :: words

    associate (analysis => scene%general%analysis, foil => scene%bump_foil)
      call keys%refuse(group, gaps, lacks_bumps(scene), needs_meshes//'no other foil has crests')
      call keys%refuse(group, gaps, analysis%loads_strip .and. &
                       scene%strip_load%kind /= load_plates, "needs kind = 'plates' in "// &
                       '&strip_load: a force that is given acts on its crest wherever that is')
      call keys%refuse(group, gaps, analysis%finds_modes, 'needs a bearing or a strip '// &
                       'between plates: modes are those of foils that touch nothing')
      if (.not. allocated(foil%corner_gap)) return
      if (lacks_bumps(scene)) then
        words = needs_meshes//'no other foil has corners'
      else if (analysis%finds_modes) then
        words = 'needs a bearing or a strip under load: modes are those of foils that touch nothing'
      else if (analysis%loads_strip .and. scene%strip_load%support == support_held) then
        words = "needs support = 'contact' in &strip_load: corner lines that are held cannot move"
      else if (any(foil%pitch%each(foil%bumps) <= &
                   2.0_wp*foil%half_length%each(foil%bumps)*(1.0_wp + rounding)) .and. &
               maxval(foil%corner_gap) > minval(foil%corner_gap)) then
        words = 'needs flats at all bumps: without one two bumps share a corner line'
      else if (foil%fixed_edge == fixed_edge_none .and. minval(foil%corner_gap) > 0.0_wp) then
        words = 'must be 0 for a bump at least, or nothing holds a strip that is fixed nowhere'
      else if (foil%height%value > 0.0_wp .and. &
               .not. maxval(foil%corner_gap) < foil%height%value) then
        words = 'must be less than the height of the bumps, '//text(foil%height%value)//' m'
      else
        return
      end if
    end associate
    call keys%refuse(group, 'corner_gap', .true., words)
  end subroutine check_gaps

  !> Complains about sizes bump by bump where there is one bump, or none.
  subroutine check_bump_sizes(keys, scene)
    type(case_keys_type), intent(inout) :: keys
    type(scene_type), intent(in) :: scene
    character(len=*), parameter :: sizes = 'bump_pitch, bump_half_length, bump_height, '// &
                                   'bump_thickness'
    logical :: several, modes

    several = scene%bump_foil%strips > 1
    associate (part => scene%modes%part)
      modes = scene%general%analysis%finds_modes .and. part > 0
      call keys%rule(group, 'strips', several .and. lacks_bumps(scene) .and. .not. &
                     scene%model%foil%has_top_foil, needs_meshes// &
                     'no other foil but a plate has strips')
      call keys%rule(group, 'strips', several .and. modes, &
                     'must be 1 for modes: each strip has its own')
      call keys%rule('mesh', 'edge_refinement', several .and. &
                     scene%general%analysis%loads_strip .and. scene%mesh%edge_refinement > 1.0_wp, &
                     'must be 1 for strips side by side: each has equal rows')
      call keys%refuse(group, sizes, lacks_bumps(scene), needs_meshes//'no other foil has bumps')
      call keys%refuse(group, sizes, modes .and. all(part /= [part_strip, part_top_foil]), &
                       "needs part = 'strip' in &modes: the other parts are those of one bump")
    end associate
  end subroutine check_bump_sizes

  !> Complains about bumps of shells whose arcs stand nearly upright on the flats: a rotation about
  !> the one's director is none that the other's nodes have.
  subroutine check_steepness(keys, scene)
    type(case_keys_type), intent(inout) :: keys
    type(scene_type), intent(in) :: scene

    character(len=*), parameter :: rule = 'must not exceed 0.9 of half_length with shells: '// &
                                   'arcs would stand upright on the flats'

    associate (foil => scene%bump_foil)
      if (.not. scene%model%foil%has_shell_bumps .or. foil%bumps < 1 .or. foil%strips > 1) return
      associate (high => foil%height%each(foil%bumps), half => foil%half_length%each(foil%bumps))
        if (any(high > half) .or. .not. any(high > steepest*half)) return
        if (allocated(foil%height%by_bump) .or. allocated(foil%half_length%by_bump)) then
          call complain_of_sizes(keys, foil%height%bump_key(), high > steepest*half, high, rule, &
                                 'half_length', half, 'bump')
        else
          call keys%complain(group, 'height', rule//', and half_length is '//text(half(1))//' m')
        end if
      end associate
    end associate
  end subroutine check_steepness

  !> Complains about a foil that cannot deflect, and warns of one that rises by more than there
  !> is room for.
  subroutine check_assembly(keys, scene)
    type(case_keys_type), intent(inout) :: keys
    type(scene_type), intent(in) :: scene
    character(len=*), parameter :: key = 'assembly_interference'
    real(wp) :: height, clearance !! of a foil that springs open [m]
    logical :: bearing, partitioned

    clearance = scene%bearing%clearance
    bearing = scene%general%analysis%has_film
    partitioned = scene%model%coupling == coupling_partitioned
    if (scene%bearing%interference > 0.0_wp) then
      if (.not. bearing) then
        call keys%complain('bearing', key, 'needs a bearing with a film')
      else if (.not. scene%model%foil%deflects) then
        call keys%complain('bearing', key, 'needs a foil that deflects: '// &
                           "another one than 'rigid' in &model; a smaller clearance is the same")
      else if (partitioned) then
        call keys%complain('bearing', key, monolithic)
      else if (scene%model%has_local_springs()) then
        call keys%rule('bearing', key, clearance > 0.0_wp .and. &
                       scene%bearing%interference >= clearance, 'needs '// &
                       "foundation_pressure = 'axial_mean' in &model: under the local pressure "// &
                       'the sides, at ambient pressure, never deflect')
      end if
    end if
    if (.not. scene%top_foil%free_radius > 0.0_wp) return
    if (.not. bearing) then
      call keys%complain('top_foil', 'free_radius', &
                         'needs a bearing: no other top foil lies in a bore')
    else if (lacks_bumps(scene)) then
      call keys%complain('top_foil', 'free_radius', needs_meshes//'no other foil bends')
    else if (partitioned) then
      call keys%complain('top_foil', 'free_radius', monolithic)
    else if (scene%model%foil%is_known() .and. min(scene%bearing%radius, clearance) > 0.0_wp) then
      height = rise*abs(initial_curvature(scene%top_foil, scene%bearing%radius))* &
               scene%bearing%radius**2
      if (height >= clearance) call keys%warn('top_foil', 'free_radius', 'lets the foil rise '// &
                                              'over its bumps at rest by '//text(height, 3)// &
                                              ' m or more, and the clearance is '// &
                                              text(clearance)//' m')
    end if
  end subroutine check_assembly

  !> Complains about strips that the scene, or half its width, cannot have, all of them at once.
  subroutine check_own_strips(keys, scene)
    type(case_keys_type), intent(inout) :: keys
    type(scene_type), intent(in) :: scene
    character(len=*), parameter :: rule = 'needs strips that mirror each other about the midplane: '
    logical :: mirrors

    associate (foil => scene%bump_foil)
      if (scene%model%half_width == half_width_yes) then
        mirrors = sizes_mirror(foil)
        call keys%rule('model', 'half_width', .not. mirrors, rule//'lists in &bump_foil that '// &
                       'read the same from both ends')
        call keys%rule('model', 'half_width', mirrors .and. heights_differ(scene), rule// &
                       'with height_deviation each has heights of its own')
      end if
      if (.not. strips_differ(foil)) return
      if (real(foil%bumps, wp)*real(foil%strips, wp) > most_bumps) then
        call keys%complain(group, 'bumps', text(foil%bumps)//' bumps on '//text(foil%strips)// &
                           ' strips with sizes of their own are more than '// &
                           text(nint(most_bumps)))
        return
      end if
      call check_own_bumps(keys, foil)
      if (scene%bearing%radius > 0.0_wp) call check_room(keys, foil, scene%bearing)
      call check_models(keys, scene)
    end associate
  end subroutine check_own_strips

  !> Whether the strips mirror each other about the midplane; one does.
  pure logical function strips_mirror(scene) result(mirror)
    type(scene_type), intent(in) :: scene !! what the case file asks for
    mirror = sizes_mirror(scene%bump_foil) .and. .not. heights_differ(scene)
  end function strips_mirror

  !> Whether strips have random heights of their own; planar beams have one cross-section.
  pure logical function heights_differ(scene) result(differ)
    type(scene_type), intent(in) :: scene

    differ = scene%bump_foil%strips > 1 .and. scene%bump_foil%random%deviation > 0.0_wp
    if (scene%general%analysis%has_film) differ = differ .and. .not. scene%model%foil%is_planar
  end function heights_differ

  !> What of the scene knows strips of one kind only.
  subroutine check_models(keys, scene)
    type(case_keys_type), intent(inout) :: keys
    type(scene_type), intent(in) :: scene

    associate (foil => scene%bump_foil)
      if (scene%general%analysis%has_film .and. scene%model%foil%is_planar) then
        call alike(foil%pitch)
        call alike(foil%half_length)
        call alike(foil%height)
        call alike(foil%thickness)
        call alike(foil%offset)
      end if
      call keys%rule(group, 'strip_pitch', scene%general%analysis%loads_strip .and. &
                     scene%strip_load%kind /= load_plates .and. allocated(foil%pitch%by_strip), &
                     "must be alike for all strips, or needs kind = 'plates' in &strip_load: "// &
                     'the force of a crest is shared evenly')
    end associate

  contains

    !> Complains about a size that planar beams do not have strip by strip.
    subroutine alike(size)
      type(size_type), intent(in) :: size
      call keys%rule(group, 'strip_'//trim(size%name), allocated(size%by_strip), 'must be '// &
                     "alike for all strips, or needs foil = 'shell' in &model: planar beams "// &
                     'have one cross-section')
    end subroutine alike
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
      associate (half => one%half_length%each(one%bumps), high => one%height%each(one%bumps), &
                 long => one%pitch%each(one%bumps), thick => one%thickness%each(one%bumps))
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
    call check(foil%height, height > highest, height, 'must not exceed half_length: a bump is '// &
               'at most half a circle', 'half_length', highest)
    call check(foil%pitch, pitch < arc*(1.0_wp - rounding), pitch, 'must be at least 2 '// &
               'half_length, or bumps overlap', '2 half_length', arc)
    call check(foil%thickness, thickness >= thickest, thickness, 'must be less than half of '// &
               'half_length: a bump is a thin shell', 'half of half_length', thickest)
    if (any(pitch < arc*(1.0_wp - rounding))) return
    call keys%rule(group, foil%pitch%key_in(keys), any(flats .neqv. spread(flats(:, 1), 2, &
                   foil%strips)), 'must leave flats on all strips, or on none')

  contains

    !> Complains about the strips where a size is wrong; one that is not known is not.
    subroutine check(size, wrong, value, rule, other, limit)
      type(size_type), intent(in) :: size
      character(len=*), intent(in) :: rule, other
      logical, intent(in) :: wrong(:)
      real(wp), intent(in) :: value(:), limit(:) !! [m]

      call complain_of_sizes(keys, size%key_in(keys), &
                             wrong .and. value > 0.0_wp .and. limit > 0.0_wp, value, rule, &
                             other, limit, 'strip')
    end subroutine check
  end subroutine check_own_bumps

  !> Strips that are not low and thin against the bearing, on whose pad they are unrolled, or reach
  !> beyond it.
  subroutine check_room(keys, foil, bearing)
    type(case_keys_type), intent(inout) :: keys
    type(bump_foil_case_type), intent(in) :: foil
    type(bearing_case_type), intent(in) :: bearing
    real(wp), dimension(foil%strips) :: height, thickness, reach, radius, length
    type(bump_foil_case_type) :: one
    character(len=:), allocatable :: key
    integer :: strip

    radius = bearing%radius
    length = pad_length(bearing)
    do strip = 1, foil%strips
      one = one_strip(foil, strip)
      height(strip) = maxval(one%height%each(one%bumps))
      thickness(strip) = maxval(one%thickness%each(one%bumps))
      reach(strip) = one%offset%value + sum(one%pitch%each(one%bumps))
    end do
    call complain_of_sizes(keys, foil%thickness%key_in(keys), thickness >= thin*radius, thickness, &
                           'must be less than 1/20 of the radius: the foil is a thin shell, '// &
                           'unrolled', '1/20 of the radius', thin*radius, 'strip')
    call complain_of_sizes(keys, foil%height%key_in(keys), height >= low_in_pad*radius, height, &
                           'must be less than 1/4 of the radius: the strip is unrolled', &
                           '1/4 of the radius', low_in_pad*radius, 'strip')
    key = foil%pitch%key_in(keys)
    if (keys%holds(group, 'strip_offset')) key = 'strip_offset'
    call complain_of_sizes(keys, key, reach > length*(1.0_wp + rounding), reach, 'a strip with '// &
                           'its offset must not be longer than the pad', 'the pad', length, 'strip')
  end subroutine check_room
end module gfb_foil_rules
