!> What a thrust bearing asks of the scene.
module gfb_thrust_rules
  use gfb_kinds, only: wp
  use gfb_bearing_case, only: bearing_case_type, bore_case_type, pad_angle, pad_turn, strip_ends
  use gfb_bearing_row, only: needs_journal, needs_thrust
  use gfb_case_keys, only: case_keys_type
  use gfb_foil_cases, only: bump_foil_case_type, one_strip
  use gfb_gap_shape, only: gap_shape_item_type, height_of
  use gfb_gap_shapes, only: find_shapes
  use gfb_model_case, only: foundation_pressure_local
  use gfb_operation_case, only: operation_case_type
  use gfb_scene, only: scene_type
  use gfb_study_cases, only: quantity_words, of_journal, of_runner, derives_vibrations
  use gfb_sweep_case, only: operation_at, sweep_keys, sweep_axial_gap, &
                            sweep_axial_load, sweep_tilt_x, sweep_tilt_y, sweep_speed
  use gfb_text, only: text
  use gfb_units, only: degrees
  implicit none (type, external)
  private
  public :: check_thrust

contains

  !> Checks a scene with a thrust bearing, and that others have none of its parameters.
  subroutine check_thrust(keys, scene)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(scene_type), intent(in) :: scene !! what the case file asks for

    associate (sweep => scene%sweep, foil => scene%model%foil, &
               derived => scene%sensitivity)
      if (.not. scene%bearing%row%has_sectors) then
        call keys%rule('sweep', 'parameter', sweep%parameter == sweep_axial_gap .or. &
                       sweep%parameter == sweep_axial_load .and. &
                       .not. scene%bearing%row%moves_along, needs_thrust)
        call keys%rule('sensitivity', 'quantity', derived%asks(of_runner), &
                       'names a result of thrust bearings: '//needs_thrust)
        return
      end if
      call keys%rule('sweep', 'parameter', all(sweep%parameter /= [0, sweep_keys, sweep_speed, &
                     sweep_tilt_x, sweep_tilt_y, sweep_axial_load, sweep_axial_gap]), &
                     needs_journal//': axial_load and axial_gap stand for load and eccentricity')
      call keys%rule('sweep', 'parameter', sweep%parameter == sweep_axial_load .and. &
                     scene%general%analysis%holds, &
                     'needs axial_load in &operation: the gap is held')
      call keys%rule('sweep', 'parameter', sweep%parameter == sweep_axial_gap .and. &
                     .not. scene%general%analysis%holds, &
                     'needs a gap that is held: axial_gap in &operation without axial_load')
      call check_play(keys, scene)
      call keys%rule('sweep', 'parameter', scene%operation%moment_given .and. any( &
                     sweep%parameter == [sweep_tilt_x, sweep_tilt_y]), 'needs a tilt that is '// &
                     'held: no moment in &operation')
      call keys%rule('scene', 'analysis', scene%transient%present .or. scene%periodic%present, &
                     'cannot be that of a thrust bearing yet: its runner is '// &
                     'not followed over time')
      call keys%rule('model', 'foil', .not. foil%fits_sectors, "must be 'rigid', "// &
                     "'elastic_foundation', 'plate' or 'shell' with kind = 'thrust' in &bearing")
      call keys%rule('sensitivity', 'quantity', derived%asks(of_journal) .or. &
                     derives_vibrations(derived) .or. any(derived%quantity .and. &
                     quantity_words == 'axial_gap') .and. &
                     .not. scene%general%analysis%floats, 'names a result of '// &
                     'journal bearings, or axial_gap where it is held')
      call keys%rule('operation', 'axial_load', .not. bearing_wedges(scene) .and. &
                     keys%meant('operation', 'axial_load') .and. .not. &
                     (scene%shaft_contact%present .or. scene%feed%present .or. &
                      scene%grooves%present), 'cannot be carried '// &
                     'by flat pads under an aligned runner, whose film has no wedge: give '// &
                     '&ramp, &feed or &grooves')
      call keys%rule('bearing', 'leading_edge_condition', scene%bearing%is_ring() .and. &
                     scene%bearing%ramp_part > 0.0_wp, "must be 'slit' with &ramp: a full ring "// &
                     'has no leading edge')
      call check_ramp(keys, scene)
      call check_strips(keys, scene)
      call keys%refuse('bump_foil', 'strip_form', foil%is_known() .and. .not. &
                       foil%has_shell_bumps, "needs foil = 'shell' in &model: crests "// &
                       'of springs are rays')
      if (foil%has_shell_bumps) call check_bump_strips(keys, scene%bump_foil, scene%bearing)
      call check_rigid_gap(keys, scene)
    end associate
  end subroutine check_thrust

  !> Loads and gaps of a sweep fit the sides that there are; heat has one side.
  subroutine check_play(keys, scene)
    type(case_keys_type), intent(inout) :: keys
    type(scene_type), intent(in) :: scene
    integer :: point

    associate (sweep => scene%sweep, play => scene%bearing%play)
      do point = 1, size(sweep%values)
        call keys%rule('sweep', 'values', sweep%parameter == sweep_axial_load .and. .not. &
                       max(play, sweep%values(point)) > 0.0_wp, 'must be positive without '// &
                       'axial_play in &bearing', point)
        call keys%rule('sweep', 'values', sweep%parameter == sweep_axial_gap .and. &
                       play > 0.0_wp .and. sweep%values(point) >= play, 'must be less than '// &
                       'axial_play in &bearing, '//text(play)//' m', point)
      end do
      call keys%rule('bearing', 'axial_play', play > 0.0_wp .and. scene%thermal%present, &
                     'cannot stand beside &thermal yet: heat is known of one side')
    end associate
  end subroutine check_play

  !> Whether the film narrows along the motion somewhere: by a ramp, a profile, or a tilt.
  pure logical function bearing_wedges(scene) result(wedges)
    type(scene_type), intent(in) :: scene
    wedges = scene%bearing%ramp_part > 0.0_wp .or. scene%bore%present .or. &
      scene%operation%moment_given .or. &
      any(abs(scene%operation%tilt) > 0.0_wp) .or. any(scene%sweep%parameter == [sweep_tilt_x, &
      sweep_tilt_y]) .or. scene%operation%tilt_is_sought
  end function bearing_wedges

  !> Ramp and land are as long as elements of the film at the pad's edges, which may be narrower
  !> than the others: see `axial_rows`.
  subroutine check_ramp(keys, scene)
    type(case_keys_type), intent(inout) :: keys
    type(scene_type), intent(in) :: scene
    !> of an element, which a side on the end of the ramp leaves: less is out of proportion [1]
    real(wp), parameter :: shortest = 0.25_wp
    real(wp) :: edge, rate !! an element there, over the arc; of the refinement [1]

    associate (part => scene%bearing%ramp_part, elements => scene%mesh%circumferential_elements, &
               refinement => scene%mesh%edge_refinement)
      if (.not. part > 0.0_wp .or. part > 1.0_wp .or. elements < 2) return
      edge = 1.0_wp/real(elements, wp)
      if (refinement > 1.0_wp .and. .not. scene%model%foil%has_top_foil) then
        rate = acosh(sqrt(refinement))
        edge = 0.5_wp*(1.0_wp - tanh(rate*(1.0_wp - 2.0_wp*edge))/tanh(rate))
      end if
      call keys%rule('ramp', 'part', part < shortest*edge, 'makes a ramp of '// &
                     text(part/edge, 2)//' of an element of the film, too short to be '// &
                     'computed: an element at the edge covers '//text(edge, 2)//' of the arc')
      call keys%rule('ramp', 'part', part < 1.0_wp .and. 1.0_wp - part < shortest*edge, &
                     'leaves a land of '//text((1.0_wp - part)/edge, 2)//' of an element of '// &
                     'the film: 1 is a ramp without a land')
      if (part >= edge .or. part < shortest*edge) return
      call keys%warn('ramp', 'part', 'makes a ramp of '//text(part/edge, 2)//' of an element '// &
                     'of the film: give more circumferential_elements')
    end associate
  end subroutine check_ramp

  !> Strips side by side under local pressure: one more than cuts, which lie on the pad.
  subroutine check_strips(keys, scene)
    type(case_keys_type), intent(inout) :: keys
    type(scene_type), intent(in) :: scene
    character(len=*), parameter :: stiffness = 'strip_foundation_stiffness', cuts = 'cut_radii'

    associate (model => scene%model, bearing => scene%bearing)
      call keys%refuse('model', stiffness//', '//cuts, &
                       model%foil%is_known() .and. .not. model%foil%has_foundation, &
                       "needs foil = 'elastic_foundation'")
      call keys%rule('model', stiffness, size(model%strip_stiffness) /= 0 .and. &
                     size(model%strip_stiffness) /= size(model%cut_radii) + 1, 'must have one '// &
                     'value more than cut_radii: '//text(size(model%cut_radii) + 1)//', not '// &
                     text(size(model%strip_stiffness)))
      if (size(model%strip_stiffness) == 0) then
        call keys%rule('model', cuts, size(model%cut_radii) > 0, 'needs '//stiffness)
        return
      end if
      call keys%rule('model', stiffness, keys%meant('model', 'foundation_stiffness'), &
                     'cannot stand beside foundation_stiffness: give one of them')
      call keys%rule('model', stiffness, keys%meant('model', 'foundation_exponent'), &
                     'cannot stand beside foundation_exponent: each strip has one stiffness')
      call keys%rule('model', stiffness, model%foundation_pressure /= foundation_pressure_local, &
                     "needs foundation_pressure = 'local': a mean goes over all strips")
      call keys%rule('model', cuts, any(model%cut_radii <= bearing%inner_radius) .or. &
                     any(model%cut_radii >= bearing%radius), 'must lie between inner_radius '// &
                     'and outer_radius')
      associate (n => size(model%cut_radii))
        call keys%rule('model', cuts, any(model%cut_radii(2:) <= model%cut_radii(:n - 1)), &
                       'must rise from strip to strip')
      end associate
    end associate
  end subroutine check_strips

  !> Strips of shells end on the pad, each laid at its own mean radius; the first that does not is
  !> named.
  subroutine check_bump_strips(keys, foil, bearing)
    type(case_keys_type), intent(inout) :: keys
    type(bump_foil_case_type), intent(in) :: foil
    type(bearing_case_type), intent(in) :: bearing
    real(wp), parameter :: rounding = 1.0e-9_wp !! of lengths that fit exactly, relative
    type(bump_foil_case_type) :: one
    character(len=:), allocatable :: key
    real(wp) :: last, radius !! where a strip ends [rad], its mean radius [m]
    integer :: strip

    if (foil%bumps == 0 .or. .not. min(foil%pitch%value, bearing%length) > 0.0_wp) return
    if (real(foil%strips - 1, wp)*foil%cut_width >= bearing%length) return
    key = foil%pitch%key_in(keys)
    if (key == 'pitch' .and. .not. keys%holds('bump_foil', 'pitch')) key = 'bumps'
    if (keys%holds('bump_foil', 'strip_offset')) key = 'strip_offset'
    do strip = 1, foil%strips
      one = one_strip(foil, strip)
      radius = 0.5_wp*sum(strip_ends(bearing, foil%strips, foil%cut_width, strip))
      last = bearing%ramp_part*pad_angle(bearing) &
        + (one%offset%value + sum(one%pitch%each(one%bumps)))/radius
      if (last <= pad_angle(bearing)*(1.0_wp + rounding)) cycle
      call keys%complain('bump_foil', key, 'strip '//text(strip)//' of '//text(foil%strips)// &
                         ' ends at '//text(last*degrees, 4)//' deg, past the edge of the '// &
                         'pad at '//text(pad_angle(bearing)*degrees, 4)//' deg: it has '// &
                         text(one%bumps)//' bumps of the pitch '//text(one%pitch%value)// &
                         ' m at its mean radius '//text(radius)//' m, behind the ramp')
      return
    end do
  end subroutine check_bump_strips

  !> A rigid pad leaves the runner its gap everywhere.
  subroutine check_rigid_gap(keys, scene)
    type(case_keys_type), intent(inout) :: keys
    type(scene_type), intent(in) :: scene
    integer :: point

    associate (sweep => scene%sweep)
      if (scene%model%foil%deflects .or. .not. scene%bearing%length > 0.0_wp) return
      if (.not. scene%general%analysis%holds) return
      if (sweep%parameter == 0 .or. sweep%parameter == sweep_keys) then
        if (any(abs(scene%operation%tilt) > 0.0_wp)) call check_gap('operation', 'tilt', &
                                                                    scene%operation)
        return
      end if
      do point = 1, size(sweep%values)
        call check_gap('sweep', 'values', operation_at(scene%operation, sweep, point), point)
      end do
    end associate

  contains

    !> Complains about a position without a gap.
    subroutine check_gap(group, key, operation, point)
      character(len=*), intent(in) :: group, key
      type(operation_case_type), intent(in) :: operation
      integer, intent(in), optional :: point
      real(wp) :: gap, place(2) !! smallest one [m]; radius, angle [m], [rad]
      integer :: pad

      call find_smallest_gap(scene%bearing, scene%bore, operation, gap, pad, place)
      call keys%rule(group, key, .not. gap > 0.0_wp, 'leaves a gap of '//text(gap, 4)//' m on '// &
                     'pad '//text(pad)//', at radius '//text(place(1), 4)//' m and '// &
                     text(place(2)*degrees, 4)//' deg, which must be positive in a rigid bearing', &
                     point)
    end subroutine check_gap
  end subroutine check_rigid_gap

  !> Where the gap of rigid pads is smallest: at an inner or outer edge, since it is linear along
  !> the radius.
  pure subroutine find_smallest_gap(bearing, bore, operation, gap, pad, place)
    type(bearing_case_type), intent(in) :: bearing
    type(bore_case_type), intent(in) :: bore
    type(operation_case_type), intent(in) :: operation
    real(wp), intent(out) :: gap      !! [m]
    integer, intent(out) :: pad       !! number
    real(wp), intent(out) :: place(2) !! radius and angle [m], [rad]
    integer, parameter :: points = 500 !! of a pad
    type(gap_shape_item_type), allocatable :: shape(:), opposite(:)
    real(wp) :: radii(2), angle, leading, here, tilted
    integer :: number, i, side

    gap = huge(1.0_wp)
    pad = 1
    place = 0.0_wp
    radii = [bearing%inner_radius, bearing%radius]
    do number = 1, bearing%pads
      leading = bearing%leading_edge_angle + pad_turn(bearing, number)
      call find_shapes(bearing, bore, leading, 1.0_wp, shape)
      call find_shapes(bearing, bore, leading, -1.0_wp, opposite)
      do i = 0, points
        angle = leading + pad_angle(bearing)*real(i, wp)/real(points, wp)
        do side = 1, size(radii)
          tilted = radii(side)*(operation%tilt(2)*cos(angle) - operation%tilt(1)*sin(angle))
          here = operation%axial_gap + tilted
          if (bearing%play > 0.0_wp) then
            here = min(here - height_of(shape, angle, radii(side)), &
                       -here - height_of(opposite, angle, radii(side)))
          else
            here = here - height_of(shape, angle, radii(side))
          end if
          if (here >= gap) cycle
          gap = here
          pad = number
          place = [radii(side), angle]
        end do
      end do
    end do
  end subroutine find_smallest_gap
end module gfb_thrust_rules
