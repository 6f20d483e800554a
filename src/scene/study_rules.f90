!> What a scene must have, and cannot have, where more is asked for than one answer: a sweep, a
!> branch, a limit, an accuracy, a sample, a run that can be resumed. And what it makes of its
!> numbers without saying so: elements, steps, answers.
!>
!> Each of these counts is a real, which no product overflows, and keeps the limit of the counts
!> that are given, before anything of that size is made.
module gfb_study_rules
  use gfb_kinds, only: wp, long
  use gfb_units, only: pi
  use gfb_study_cases, only: asked_name, of_vibrations, part_strip
  use gfb_foil_cases, only: draw_gaps, largest_gap, top_foil_trailing
  use gfb_case_keys, only: case_keys_type
  use gfb_model_case, only: needs_meshes, coupling_partitioned, meshes_foils
  use gfb_result_names, only: is_of
  use gfb_result_table, only: bearing, strip
  use gfb_scene, only: scene_type
  use gfb_scene_case, only: analysis_equilibrium, analysis_fixed_position, analysis_strip, &
                            analysis_load_capacity, analysis_lift_off, analysis_misalignment, &
                            analysis_words, is_bearing, analysis_modes
  use gfb_sweep_case, only: sweep_load, sweep_speed, sweep_load_angle, sweep_tilt_x, &
                            sweep_eccentricity_x, sweep_eccentricity_y
  use gfb_text, only: text
  use gfb_bearing_case, only: pad_length
  use gfb_mesh_case, only: most_a_side
  use gfb_operation_case, only: angular_speed
  use gfb_motion_cases, only: motion_free, duration_of
  implicit none (type, external)
  private
  public :: check_sweep, check_edge_lift, check_accuracy, check_capacity, check_sample, &
            sample_member, is_unloaded, check_counts

  integer(long), parameter :: most_in_all = 50000000_long !! elements of a mesh, steps, answers
  integer(long), parameter :: most_stations = 1000000_long !! elements along a bump strip

  !> Elements each way.
  type :: elements_type
    real(wp) :: along = 0.0_wp  !! the pad [1]
    real(wp) :: across = 0.0_wp !! its width [1]
    real(wp) :: bump = 0.0_wp   !! of an arc with its flat [1]
  end type elements_type

  character(len=*), parameter :: one_answer = 'needs a scene of one answer, without &sweep'
  !> Results that are limits, and the analyses that look for them.
  character(len=*), parameter :: limit_names(*) = &
    [character(len=22) :: 'load_capacity', 'lift_off_speed_rpm', 'misalignment_allowance']
  integer, parameter :: limits(*) = &
    [analysis_load_capacity, analysis_lift_off, analysis_misalignment]

contains

  !> Whether a load is given that is zero.
  pure logical function is_unloaded(scene) result(unloaded)
    type(scene_type), intent(in) :: scene !! what the case file asks for
    unloaded = scene%operation%load_given .and. .not. any(abs(scene%operation%load) > 0.0_wp)
  end function is_unloaded

  !> A sweep fits to the analysis, and what it follows, or carries along, to the scene.
  subroutine check_sweep(keys, scene)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(scene_type), intent(in) :: scene !! what the case file asks for
    character(len=*), parameter :: memory = 'friction_memory', parameter = 'parameter'
    logical :: floats !! the shaft finds its place at each point

    associate (sweep => scene%sweep, analysis => scene%general%analysis, foil => scene%model%foil)
      if (.not. sweep%present) return
      call keys%rule('sweep', memory, sweep%friction_memory .and. foil /= 0 .and. &
                     .not. meshes_foils(foil), needs_meshes//'nothing else rubs')
      call keys%rule('sweep', memory, sweep%friction_memory .and. meshes_foils(foil) .and. &
                     .not. scene%contact%may_rub, 'needs friction_top or friction_sleeve in '// &
                     '&contact: without friction nothing is remembered')
      if (sweep%turn_folds) call check_turn_folds(keys, scene)
      if (sweep%parameter == sweep_load_angle) call check_load_angles(keys, scene)
      if (analysis == 0) return
      floats = analysis == analysis_equilibrium .and. .not. sweep%hold_position
      call keys%rule('sweep', 'hold_position', sweep%hold_position .and. &
                     analysis /= analysis_equilibrium, "needs analysis = 'equilibrium': it "// &
                     'fixes the shaft at its equilibrium at &operation')
      select case (sweep%parameter)
      case (sweep_load, sweep_load_angle)
        call keys%rule('sweep', parameter, .not. floats, &
                       "needs analysis = 'equilibrium' without hold_position")
        call keys%rule('operation', 'load', floats .and. is_unloaded(scene), 'must not be zero '// &
                       'where it is swept: it gives '// &
                       merge('the direction', 'the magnitude', sweep%parameter == sweep_load))
      case (sweep_eccentricity_x, sweep_eccentricity_y)
        call keys%rule('sweep', parameter, analysis /= analysis_fixed_position, &
                       "needs analysis = 'fixed_position'")
      case (sweep_speed)
        if (floats .and. .not. scene%shaft_contact%present) then
          call check_zeros(keys, scene, 'must be positive: a film without speed carries no load')
        end if
      case default
        return ! a tilt fits to every analysis
      end select
    end associate
  end subroutine check_sweep

  !> Complains about values of a sweep that are zero.
  subroutine check_zeros(keys, scene, rule)
    type(case_keys_type), intent(inout) :: keys
    type(scene_type), intent(in) :: scene
    character(len=*), intent(in) :: rule
    integer :: point

    do point = 1, size(scene%sweep%values)
      call keys%rule('sweep', 'values', .not. abs(scene%sweep%values(point)) > 0.0_wp, rule, point)
    end do
  end subroutine check_zeros

  !> A branch is followed round its folds between two values, with all its points in equilibrium.
  subroutine check_turn_folds(keys, scene)
    type(case_keys_type), intent(inout) :: keys
    type(scene_type), intent(in) :: scene
    character(len=*), parameter :: name = 'turn_folds'

    associate (sweep => scene%sweep)
      call keys%rule('sweep', name, sweep%friction_memory, 'has no use beside friction_memory: '// &
                     'what slid must not depend on the path round a fold')
      call keys%rule('sweep', name, sweep%parameter == sweep_load_angle, 'has no use with '// &
                     "parameter = 'load_angle': between two angles the load goes straight, not "// &
                     'round')
      call keys%rule('sweep', name, scene%model%coupling == coupling_partitioned, &
                     "needs coupling = 'monolithic' in &model")
      call keys%rule('sweep', name, size(sweep%values) == 1, &
                     'needs two values at least, the ends of the path')
      if (size(sweep%values) < 2) return
      associate (change => sweep%values(2:) - sweep%values(:size(sweep%values) - 1))
        call keys%rule('sweep', 'values', any(change*change(1) <= 0.0_wp), &
                       'must all rise or all fall with turn_folds')
      end associate
    end associate
  end subroutine check_turn_folds

  !> Between two angles the load goes straight, and must not come near zero.
  subroutine check_load_angles(keys, scene)
    type(case_keys_type), intent(inout) :: keys
    type(scene_type), intent(in) :: scene
    real(wp), parameter :: circle = 360.0_wp, farthest = 90.0_wp !! [deg]
    real(wp) :: turn !! from the angle before [deg]
    integer :: point

    do point = 2, size(scene%sweep%values)
      turn = modulo(scene%sweep%values(point) - scene%sweep%values(point - 1), circle)
      call keys%rule('sweep', 'values', .not. min(turn, circle - turn) <= farthest, 'must be '// &
                     'within 90 degrees of the angle before: between them the load goes '// &
                     'straight', point)
    end do
  end subroutine check_load_angles

  !> A branch can be asked for by the lift of an edge that is free to lift.
  subroutine check_edge_lift(keys, scene)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(scene_type), intent(in) :: scene !! what the case file asks for
    character(len=:), allocatable :: problem

    if (scene%general%analysis == 0 .or. scene%model%foil == 0) return
    if (scene%general%analysis /= analysis_equilibrium) then
      problem = "needs analysis = 'equilibrium'"
    else if (.not. meshes_foils(scene%model%foil)) then
      problem = needs_meshes//'no other foil has an edge that lifts'
    else if (scene%top_foil%fixed_edge /= top_foil_trailing) then
      problem = "needs fixed_edge = 'trailing' in &top_foil: a fixed edge does not lift"
    else if (scene%model%coupling == coupling_partitioned) then
      problem = "needs coupling = 'monolithic' in &model"
    else
      return
    end if
    call keys%rule('operation', 'leading_edge_lift', size(scene%operation%leading_edge_lift) > 0, &
                   problem)
    call keys%rule('operation', 'leading_edge_lift_edge', &
                   size(scene%operation%leading_edge_lift_edge) > 0, problem)
  end subroutine check_edge_lift

  !> A run can be resumed where it has steps. The number whose error is asked for must be one of the
  !> analysis, and of one answer.
  subroutine check_accuracy(keys, scene)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(scene_type), intent(in) :: scene !! what the case file asks for
    character(len=*), parameter :: group = 'accuracy', key = 'quantity'
    character(len=:), allocatable :: name
    integer :: kind, needed

    associate (analysis => scene%general%analysis, resumed => scene%output%restart_every)
      call keys%rule('output', 'restart_every', resumed /= 0 .and. &
                     all(analysis /= [0, analysis_strip]) .and. .not. &
                     (scene%sweep%present .or. scene%transient%present), 'needs a &sweep, or '// &
                     "analysis = 'strip' or 'transient': nothing else has steps to resume from")
      if (.not. scene%accuracy%present .or. analysis == 0) return
      kind = merge(bearing, strip, is_bearing(analysis))
      if (scene%accuracy%quantity > 0) then
        name = asked_name(scene%accuracy)
        needed = findloc(limit_names == name, .true., 1)
        if (needed > 0) needed = limits(needed)
        if (.not. is_of(name, kind)) then
          call keys%complain(group, key, 'is no number of this analysis')
        else
          call keys%rule(group, key, .not. scene%dynamics%present .and. &
                         any(name == of_vibrations), "needs analysis = 'linear_dynamics'")
        end if
        call keys%rule(group, key, all(needed /= [0, scene%capacity%question]), &
                       "needs analysis = '"//trim(analysis_words(max(1, needed)))//"'")
      end if
      call keys%rule(group, key, scene%sweep%present, one_answer)
      call keys%rule(group, key, resumed > 0, 'is found on several meshes, which no restart '// &
                     'file resumes: restart_every must be 0')
    end associate
  end subroutine check_accuracy

  !> Checks a scene that asks for a limit.
  subroutine check_capacity(keys, scene)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(scene_type), intent(in) :: scene !! what the case file asks for
    character(len=:), allocatable :: still

    associate (asked => scene%capacity%question, smallest => scene%capacity%smallest_gap, &
               sweep => scene%sweep)
      if (asked == 0) return
      call keys%rule('operation', 'load', asked /= analysis_misalignment .and. &
                     is_unloaded(scene), 'must not be zero: it gives the direction, and '// &
                     'asperities carry a part of it')
      call keys%rule('scene', 'analysis', asked == analysis_lift_off .and. .not. &
                     scene%shaft_contact%present, &
                     "'lift_off' needs &shaft_contact: only asperities lift off")
      call keys%rule('capacity', 'smallest_gap', asked /= analysis_lift_off .and. &
                     smallest > 0.0_wp .and. smallest <= scene%solver%touch_down_gap, 'must be '// &
                     'more than touch_down_gap in &solver, '//text(scene%solver%touch_down_gap)// &
                     ' m, where paths end')
      call keys%rule('model', 'coupling', scene%model%coupling == coupling_partitioned, &
                     "must be 'monolithic' where a limit is looked for: film and foil in turns "// &
                     'follow no path to it')
      ! A lift-off speed is looked for by doubling and halving, a load capacity is told over the
      ! speed; other rules see to a shaft without asperities, and to speeds below zero.
      if (asked /= analysis_misalignment .and. scene%shaft_contact%present) then
        still = "must be positive with analysis = '"//trim(analysis_words(asked))//"'"
        call keys%refuse('operation', 'speed_rpm', &
                         .not. abs(scene%operation%speed_rpm) > 0.0_wp, still)
        if (sweep%present .and. sweep%parameter == sweep_speed) call check_zeros(keys, scene, still)
      end if
      if (sweep%present) call check_swept_limit(keys, scene)
    end associate
  end subroutine check_capacity

  !> A sweep cannot change what is looked for, nor ask for answers that are no limits.
  subroutine check_swept_limit(keys, scene)
    type(case_keys_type), intent(inout) :: keys
    type(scene_type), intent(in) :: scene
    logical :: same

    associate (sweep => scene%sweep, asked => scene%capacity%question)
      select case (asked)
      case (analysis_load_capacity)
        same = sweep%parameter == sweep_load
      case (analysis_lift_off)
        if (sweep%parameter == sweep_load) then
          call check_zeros(keys, scene, 'must not be zero: asperities carry a part of the load')
        end if
        same = sweep%parameter == sweep_speed
        if (allocated(sweep%keys)) same = same .or. index(sweep%keys, 'operation%speed_rpm') > 0
      case default
        same = sweep%parameter == sweep_tilt_x - 1 + scene%capacity%tilt_axis
      end select
      call keys%rule('sweep', 'parameter', same, "is what analysis = '"// &
                     trim(analysis_words(asked))//"' looks for: sweep another one")
      call keys%rule('sweep', 'hold_position', sweep%hold_position, &
                     'must be .false. where a limit is looked for: the shaft floats')
      call keys%rule('sweep', 'turn_folds', sweep%turn_folds, &
                     'must be .false. where a limit is looked for: a fold ends its path')
      call keys%rule('sweep', 'friction_memory', sweep%friction_memory, 'must be .false. where '// &
                     'a limit is looked for: the points between are no load steps')
    end associate
  end subroutine check_swept_limit

  !> What a sample cannot have beside it.
  subroutine check_sample(keys, scene)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(scene_type), intent(in) :: scene !! what the case file asks for
    character(len=*), parameter :: group = 'sample', key = 'count'

    if (.not. scene%sample%present) return
    if (keys%meant('bump_foil', 'height_deviation')) then
      call check_heights(keys, scene)
    else
      call keys%rule(group, key, .not. keys%holds(group, 'parameters'), 'needs '// &
                     'height_deviation in &bump_foil, or parameters: without them all members '// &
                     'are the same')
    end if
    call keys%rule(group, key, scene%sweep%present, one_answer)
    call keys%rule(group, key, scene%accuracy%present, 'cannot stand beside &accuracy: one '// &
                   'member on one mesh has its error, then all have it on that mesh')
    call keys%rule(group, key, scene%output%restart_every > 0, 'is of many runs, which no '// &
                   'restart file resumes: restart_every must be 0')
  end subroutine check_sample

  !> Every member keeps the rule that the scene keeps: no gap as large as a bump.
  subroutine check_heights(keys, scene)
    type(case_keys_type), intent(inout) :: keys
    type(scene_type), intent(in) :: scene
    type(scene_type) :: member
    real(wp), parameter :: most_heights = 50.0e6_wp !! of all members
    real(wp) :: lowest, drawn_heights
    integer :: number

    associate (foil => scene%bump_foil)
      if (foil%bumps < 1 .or. .not. foil%height%value > 0.0_wp) return
      lowest = foil%height%smallest()
      if (.not. foil%random%deviation > 0.0_wp) return
      if (foil%random%seed > huge(0) - scene%sample%count) then
        call keys%complain('sample', 'count', 'leads to a seed that is too large')
        return
      end if
      drawn_heights = real(scene%sample%count, wp)*real(foil%bumps, wp)* &
                      real(foil%strips*scene%bearing%all_pads(), wp)
      if (drawn_heights > most_heights) then
        call keys%complain('sample', 'count', 'needs '//text(drawn_heights, 3)//' heights of '// &
                           'bumps, which must not be more than '//text(nint(most_heights)))
        return
      end if
      do number = 2, scene%sample%count
        member = sample_member(scene, number)
        associate (drawn => member%bump_foil)
          if (largest_gap(drawn%random, drawn%crest_gap) < lowest) cycle
          call keys%complain('sample', 'count', 'seed '//text(drawn%random%seed)//' leaves a '// &
                             'gap that is not less than the height of the bumps, '// &
                             text(lowest)//' m')
        end associate
        return
      end do
    end associate
  end subroutine check_heights

  !> A member: the scene with another seed.
  pure function sample_member(scene, number) result(member)
    type(scene_type), intent(in) :: scene !! with `&sample`
    integer, intent(in) :: number !! of the member, from 1
    type(scene_type) :: member

    member = scene
    member%sample%present = .false.
    associate (foil => member%bump_foil)
      foil%random%seed = scene%bump_foil%random%seed + number - 1
      if (foil%random%deviation > 0.0_wp) then
        call draw_gaps(foil%random, foil%bumps, foil%strips*scene%bearing%all_pads(), &
                       foil%crest_gap)
      end if
      member%name = scene%name//'.seed'//text(foil%random%seed)
    end associate
  end function sample_member

  !> Checks all counts that follow from others.
  subroutine check_counts(keys, scene)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(scene_type), intent(in) :: scene !! what the case file asks for
    type(elements_type) :: elements
    integer :: before

    before = keys%mistakes()
    elements = elements_of(scene)
    call check_film(keys, scene, elements)
    call check_bumps(keys, scene, elements)
    if (keys%mistakes() == before) call check_finest(keys, scene)
    call check_modes(keys, scene)
    call check_answers(keys, scene)
    call check_times(keys, scene)
    call check_periods(keys, scene)
  end subroutine check_counts

  !> Elements of film and top foil.
  subroutine check_film(keys, scene, elements)
    type(case_keys_type), intent(inout) :: keys
    type(scene_type), intent(in) :: scene
    type(elements_type), intent(in) :: elements
    real(wp) :: most !! along the pad; whole elements a pitch may be half as many again [1]

    most = max(real(most_a_side, wp), 1.5_wp*real(scene%mesh%circumferential_elements, wp))
    if (elements%along > most) then
      call keys%complain('bearing', 'radius', 'the pad has '//text(pad_length(scene%bearing), 6)// &
                         ' m, along which align_crests in &mesh makes about '// &
                         text(elements%along, 3)//' elements at a pitch of '// &
                         text(scene%bump_foil%pitch%value, 6)//' m: must be at most '// &
                         text(most_a_side))
    else if (elements%along*elements%across*films(scene) > real(most_in_all, wp)) then
      call keys%complain('mesh', 'axial_elements', text(nint(elements%along))//' x '// &
                         text(nint(elements%across))//' elements'//of_films(scene)// &
                         ' are more than '//text(most_in_all))
    end if
  end subroutine check_film

  !> Elements of a bump foil that is meshed.
  subroutine check_bumps(keys, scene, elements)
    type(case_keys_type), intent(inout) :: keys
    type(scene_type), intent(in) :: scene
    type(elements_type), intent(in) :: elements
    real(wp) :: bumps !! of all pads [1]

    if (.not. meshes_bumps(scene)) return
    bumps = real(scene%bump_foil%bumps, wp)*pads(scene)
    if (bumps*elements%bump*elements%across > real(most_in_all, wp)) then
      call keys%complain('bump_foil', 'bumps', text(scene%bump_foil%bumps)//' bumps of '// &
                         text(nint(elements%bump*elements%across, long))//' elements'// &
                         on_pads(scene)//' are more than '//text(most_in_all)//' elements')
    else if (scene%bump_foil%bumps*elements%bump > real(most_stations, wp)) then
      call keys%complain('bump_foil', 'bumps', text(scene%bump_foil%bumps)//' bumps of '// &
                         text(nint(elements%bump))//' elements are more than '// &
                         text(most_stations)//' along the strip')
    end if
  end subroutine check_bumps

  !> The finest mesh that an accuracy may take.
  subroutine check_finest(keys, scene)
    type(case_keys_type), intent(inout) :: keys
    type(scene_type), intent(in) :: scene
    type(elements_type) :: finest
    type(scene_type) :: fine
    real(wp) :: all

    if (.not. scene%accuracy%present) return
    fine = scene
    associate (mesh => fine%mesh, number => scene%accuracy%maximum_refinements)
      mesh%circumferential_elements = finer(mesh%circumferential_elements, 4, number)
      mesh%axial_elements = finer(mesh%axial_elements, 2, number)
      mesh%arc_elements = finer(mesh%arc_elements, 2, number)
      mesh%flat_elements = finer(mesh%flat_elements, 1, number)
    end associate
    finest = elements_of(fine)
    all = finest%along*finest%across*films(scene)
    if (meshes_bumps(scene)) then
      all = max(all, scene%bump_foil%bumps*finest%bump*finest%across*pads(scene))
    end if
    call must_fit(keys, 'accuracy', 'maximum_refinements', all, 'the finest mesh has about ', &
                  ' elements')
  end subroutine check_finest

  !> A number of elements after some refinements by two, of a mesh that is four times coarser.
  elemental integer function finer(elements, least, refinements) result(number)
    integer, intent(in) :: elements !! that `&mesh` says, at most 100,000
    integer, intent(in) :: least !! of the first mesh
    integer, intent(in) :: refinements !! at most 8
    number = max(least, (elements + 3)/4)*2**refinements
  end function finer

  !> Elements of a scene each way.
  pure function elements_of(scene) result(elements)
    type(scene_type), intent(in) :: scene
    type(elements_type) :: elements

    elements%along = real(scene%mesh%circumferential_elements, wp)
    elements%across = real(scene%mesh%axial_elements, wp)
    elements%bump = real(scene%mesh%arc_elements + scene%mesh%flat_elements, wp)
    ! The shares of strips are rounded up, one element at least, and a line lies in a cut.
    if (scene%bump_foil%strips > 1) then
      elements%across = elements%across + 3.0_wp*real(scene%bump_foil%strips, wp)
    end if
    if (scene%mesh%align_crests .and. scene%bump_foil%bumps > 0) then
      call align_with_crests(scene, elements%along)
    end if
  end function elements_of

  !> Elements along a pad where lines of nodes lie above the crests: whole ones a pitch, and as
  !> long ones before the first crest and behind the last.
  pure subroutine align_with_crests(scene, along)
    type(scene_type), intent(in) :: scene
    real(wp), intent(inout) :: along !! [1]
    real(wp) :: of_pitch, rest !! elements; pitches outside the crests [1]

    associate (length => pad_length(scene%bearing), pitch => scene%bump_foil%pitch%value, &
               bumps => real(scene%bump_foil%bumps, wp))
      if (.not. (length > 0.0_wp .and. pitch > 0.0_wp)) return
      of_pitch = max(1.0_wp, anint(along*pitch/length))
      rest = max(0.0_wp, length/pitch - (bumps - 1.0_wp))
      along = of_pitch*(bumps - 1.0_wp + rest)
    end associate
  end subroutine align_with_crests

  !> Films of linear elements with as many nodes: of all pads, and of both bearings where a rotor
  !> tilts on two over time [1].
  pure real(wp) function films(scene) result(number)
    type(scene_type), intent(in) :: scene
    number = pads(scene)*real(scene%model%film_order**2, wp)
  end function films

  !> Pads, of both bearings where a rotor tilts on two over time [1].
  pure real(wp) function pads(scene) result(number)
    type(scene_type), intent(in) :: scene

    number = real(scene%bearing%pads, wp)
    if (scene%rotor%distance_in_time > 0.0_wp) number = 2.0_wp*number
  end function pads

  !> Pads and order of films in words.
  pure function of_films(scene) result(words)
    type(scene_type), intent(in) :: scene
    character(len=:), allocatable :: words

    words = on_pads(scene)
    if (scene%model%film_order > 1) words = ' of '//text(scene%model%film_order**2)// &
                                            ' nodes each'//words
  end function of_films

  !> Pads in words, where they are several.
  pure function on_pads(scene) result(words)
    type(scene_type), intent(in) :: scene
    character(len=:), allocatable :: words

    words = ''
    if (pads(scene) > 1.5_wp) words = ' on '//text(nint(pads(scene)))//' pads'
  end function on_pads

  !> Whether the whole bump foil is meshed.
  pure logical function meshes_bumps(scene) result(meshes)
    type(scene_type), intent(in) :: scene

    associate (analysis => scene%general%analysis)
      meshes = analysis == analysis_strip .or. &
               (is_bearing(analysis) .and. meshes_foils(scene%model%foil)) .or. &
               (analysis == analysis_modes .and. scene%modes%part == part_strip)
    end associate
  end function meshes_bumps

  !> Modes inside pieces of the bumps: three a bump, arcs cut at the crest and the flat.
  subroutine check_modes(keys, scene)
    type(case_keys_type), intent(inout) :: keys
    type(scene_type), intent(in) :: scene
    real(wp) :: pieces !! [1]

    if (.not. meshes_bumps(scene)) return
    pieces = 3.0_wp*real(scene%bump_foil%bumps, wp)*real(scene%bump_foil%strips, wp)*pads(scene)
    call check('modes', 'substructure_modes', scene%modes%substructure_modes, &
               scene%general%analysis == analysis_modes)
    call check('foil_damping', 'foil_modes', scene%foil_damping%foil_modes, &
               scene%dynamics%present .or. scene%transient%present)

  contains

    !> Checks the modes of one key.
    subroutine check(group, key, modes, counts)
      character(len=*), intent(in) :: group, key !! names in the case file
      integer, intent(in) :: modes  !! of a piece
      logical, intent(in) :: counts !! the key has a use

      if (.not. counts .or. pieces*real(modes, wp) <= real(most_in_all, wp)) return
      call keys%complain(group, key, text(modes)//' modes in each of '//text(pieces, 3)// &
                         ' pieces of the bumps are more than '//text(most_in_all))
    end subroutine check
  end subroutine check_modes

  !> Answers of a linear response: points of a sweep, times frequencies, times amplitudes.
  subroutine check_answers(keys, scene)
    type(case_keys_type), intent(inout) :: keys
    type(scene_type), intent(in) :: scene
    real(wp) :: points, frequencies !! [1]

    if (.not. scene%dynamics%present) return
    frequencies = real(size(scene%dynamics%frequencies), wp)
    points = real(max(1, size(scene%dynamics%amplitudes)), wp)
    if (allocated(scene%sweep%values)) points = points*real(max(1, size(scene%sweep%values)), wp)
    if (points*frequencies <= real(most_in_all, wp)) return
    call keys%complain('dynamics', 'frequencies', text(nint(frequencies))//' frequencies at '// &
                       text(points, 3)//' points or amplitudes are more than '//text(most_in_all))
  end subroutine check_answers

  !> Steps of a shaft over time, and the fields that it stores.
  subroutine check_times(keys, scene)
    type(case_keys_type), intent(inout) :: keys
    type(scene_type), intent(in) :: scene
    real(wp), parameter :: fewest = 60.0_wp !! of a turn, where the error chooses them [1]
    real(wp) :: duration, fastest, steps
    character(len=:), allocatable :: key

    associate (transient => scene%transient, operation => scene%operation)
      if (.not. transient%present) return
      if (min(operation%speed_rpm, transient%final_speed_rpm) < 0.0_wp) return
      if (.not. transient%duration > 0.0_wp .and. &
          .not. max(operation%speed_rpm, transient%final_speed_rpm)*transient%turns > 0.0_wp) return
      duration = duration_of(transient, operation)
      if (.not. duration < huge(duration)) return ! see the rule of its end
      fastest = max(angular_speed(operation%speed_rpm), angular_speed(transient%final_speed_rpm), &
                    abs(transient%orbit_frequency))
      steps = max(1.0_wp, duration*fastest/(2.0_wp*pi))*fewest
      if (transient%steps_per_turn > 0.0_wp) steps = steps/fewest*transient%steps_per_turn
      key = 'turns'
      if (keys%meant('transient', 'duration')) key = 'duration'
      if (transient%steps_per_turn > 1.0e5_wp) key = 'steps_per_turn'
      call must_fit(keys, 'transient', key, steps, 'makes about ', ' steps of time')
      if (.not. transient%field_interval > 0.0_wp) return
      call must_fit(keys, 'transient', 'field_interval', (duration - transient%field_start)/ &
                    transient%field_interval, 'makes about ', ' times of stored fields')
    end associate
  end subroutine check_times

  !> Steps of time in a period, and in those before the first orbit.
  subroutine check_periods(keys, scene)
    type(case_keys_type), intent(inout) :: keys
    type(scene_type), intent(in) :: scene
    real(wp) :: steps !! [1]

    associate (periodic => scene%periodic)
      if (.not. periodic%present) return
      steps = real(periodic%steps_per_turn, wp)
      if (periodic%motion /= motion_free) steps = steps*real(periodic%period_turns, wp)
      call must_fit(keys, 'periodic', 'steps_per_turn', steps, 'makes ', ' steps of a period')
      if (steps > real(most_in_all, wp) .or. periodic%motion == motion_free) return
      call must_fit(keys, 'periodic', 'start_turns', steps*real(periodic%start_turns, wp), &
                    'makes ', ' steps of time before the first orbit')
    end associate
  end subroutine check_periods

  !> Complains about a number that is larger than the limit of all.
  subroutine must_fit(keys, group, key, number, makes, what)
    type(case_keys_type), intent(inout) :: keys
    character(len=*), intent(in) :: group, key !! names in the case file
    real(wp), intent(in) :: number !! [1]
    character(len=*), intent(in) :: makes, what !! words before and behind the number

    call keys%rule(group, key, number > real(most_in_all, wp), makes//text(number, 3)//what// &
                   ': must be at most '//text(most_in_all))
  end subroutine must_fit
end module gfb_study_rules
