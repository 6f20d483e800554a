!> What a scene must have, and cannot have, where more is asked for than one answer: a sweep, a
!> branch, a limit, an accuracy, a sample, a run that can be resumed.
module gfb_study_rules
  use gfb_kinds, only: wp
  use gfb_accuracy_case, only: asked_name, of_vibrations
  use gfb_bump_foil_case, only: draw_gaps, largest_gap
  use gfb_case_keys, only: case_keys_type
  use gfb_model_case, only: needs_meshes, coupling_partitioned, meshes_foils
  use gfb_result_names, only: is_of
  use gfb_result_table, only: bearing, strip
  use gfb_scene, only: scene_type
  use gfb_scene_case, only: analysis_equilibrium, analysis_fixed_position, analysis_strip, &
                            analysis_load_capacity, analysis_lift_off, analysis_misalignment, &
                            analysis_words, is_bearing
  use gfb_sweep_case, only: sweep_load, sweep_speed, sweep_load_angle, sweep_tilt_x, &
                            sweep_eccentricity_x, sweep_eccentricity_y
  use gfb_text, only: text
  use gfb_top_foil_case, only: top_foil_trailing
  implicit none (type, external)
  private
  public :: check_sweep, check_friction_memory, check_edge_lift, check_turn_folds, &
            check_load_angles, check_restart, check_accuracy, check_capacity, check_sample, &
            sample_member, is_unloaded

contains

  !> Whether a load is given that is zero.
  pure function is_unloaded(scene) result(unloaded)
    type(scene_type), intent(in) :: scene !! what the case file asks for
    logical :: unloaded
    unloaded = scene%operation%load_given .and. .not. any(abs(scene%operation%load) > 0.0_wp)
  end function is_unloaded

  !> A sweep needs an analysis that fits to its parameter.
  subroutine check_sweep(keys, scene)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(scene_type), intent(in) :: scene !! what the case file asks for
    logical :: floats !! the shaft finds its place at each point

    associate (sweep => scene%sweep, analysis => scene%general%analysis)
      if (.not. sweep%present .or. analysis == 0) return
      floats = analysis == analysis_equilibrium .and. .not. sweep%hold_position
      call keys%rule('sweep', 'hold_position', sweep%hold_position .and. &
                     analysis /= analysis_equilibrium, "needs analysis = 'equilibrium': it "// &
                     'fixes the shaft at its equilibrium at &operation')
      select case (sweep%parameter)
      case (sweep_load, sweep_load_angle)
        call keys%rule('sweep', 'parameter', .not. floats, &
                       "needs analysis = 'equilibrium' without hold_position")
        call keys%rule('operation', 'load', floats .and. is_unloaded(scene), 'must not be zero '// &
                       'where it is swept: it gives '// &
                       merge('the direction', 'the magnitude', sweep%parameter == sweep_load))
      case (sweep_eccentricity_x, sweep_eccentricity_y)
        call keys%rule('sweep', 'parameter', analysis /= analysis_fixed_position, &
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

  !> Friction that remembers needs foils that rub.
  subroutine check_friction_memory(keys, scene)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(scene_type), intent(in) :: scene !! what the case file asks for
    character(len=*), parameter :: name = 'friction_memory'

    if (.not. scene%sweep%friction_memory .or. scene%model%foil == 0) return
    if (.not. meshes_foils(scene%model%foil)) then
      call keys%complain('sweep', name, needs_meshes//'nothing else rubs')
    else
      call keys%rule('sweep', name, .not. scene%contact%may_rub, 'needs friction_top or '// &
                     'friction_sleeve in &contact: without friction nothing is remembered')
    end if
  end subroutine check_friction_memory

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

  !> A branch is followed round its folds between two values, with all its points in equilibrium.
  subroutine check_turn_folds(keys, scene)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(scene_type), intent(in) :: scene !! what the case file asks for
    character(len=*), parameter :: name = 'turn_folds'

    associate (sweep => scene%sweep)
      if (.not. sweep%turn_folds) return
      call keys%rule('sweep', name, sweep%friction_memory, 'has no use beside friction_memory: '// &
                     'what slid must not depend on the path round a fold')
      call keys%rule('sweep', name, sweep%parameter == sweep_load_angle, 'has no use with '// &
                     "parameter = 'load_angle': between two angles the load goes straight, not "// &
                     'round')
      call keys%rule('sweep', name, scene%model%coupling == coupling_partitioned, &
                     "needs coupling = 'monolithic' in &model")
      if (.not. allocated(sweep%values)) return
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
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(scene_type), intent(in) :: scene !! what the case file asks for
    real(wp), parameter :: circle = 360.0_wp, farthest = 90.0_wp !! [deg]
    integer :: point

    associate (sweep => scene%sweep)
      if (sweep%parameter /= sweep_load_angle .or. .not. allocated(sweep%values)) return
      do point = 2, size(sweep%values)
        associate (turn => modulo(sweep%values(point) - sweep%values(point - 1), circle))
          call keys%rule('sweep', 'values', .not. min(turn, circle - turn) <= farthest, 'must '// &
                         'be within 90 degrees of the angle before: between them the load goes '// &
                         'straight', point)
        end associate
      end do
    end associate
  end subroutine check_load_angles

  !> A run can be resumed where it has steps.
  subroutine check_restart(keys, scene)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(scene_type), intent(in) :: scene !! what the case file asks for

    call keys%rule('output', 'restart_every', scene%output%restart_every /= 0 .and. &
                   all(scene%general%analysis /= [0, analysis_strip]) .and. .not. &
                   (scene%sweep%present .or. scene%transient%present), 'needs a &sweep, or '// &
                   "analysis = 'strip' or 'transient': nothing else has steps to resume from")
  end subroutine check_restart

  !> The number whose error is asked for must be one of the analysis, and of one answer.
  subroutine check_accuracy(keys, scene)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(scene_type), intent(in) :: scene !! what the case file asks for
    character(len=*), parameter :: group = 'accuracy', key = 'quantity'
    integer :: kind

    if (.not. scene%accuracy%present .or. scene%general%analysis == 0) return
    kind = merge(bearing, strip, is_bearing(scene%general%analysis))
    if (scene%accuracy%quantity > 0) then
      if (.not. is_of(asked_name(scene%accuracy), kind)) then
        call keys%complain(group, key, 'is no number of this analysis')
      else
        call keys%rule(group, key, .not. scene%dynamics%present .and. &
                       any(asked_name(scene%accuracy) == of_vibrations), &
                       "needs analysis = 'linear_dynamics'")
      end if
    end if
    call keys%rule(group, key, scene%sweep%present, 'needs a scene of one answer, without &sweep')
    call keys%rule(group, key, scene%output%restart_every > 0, 'is found on several meshes, '// &
                   'which no restart file resumes: restart_every must be 0')
  end subroutine check_accuracy

  !> Checks a scene that asks for a limit.
  subroutine check_capacity(keys, scene)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(scene_type), intent(in) :: scene !! what the case file asks for
    character(len=:), allocatable :: still

    call check_limit_name(keys, scene)
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

  !> The error of a limit can be asked for where the analysis looks for it.
  subroutine check_limit_name(keys, scene)
    type(case_keys_type), intent(inout) :: keys
    type(scene_type), intent(in) :: scene
    integer :: needed

    if (.not. scene%accuracy%present .or. scene%accuracy%quantity == 0) return
    select case (asked_name(scene%accuracy))
    case ('load_capacity')
      needed = analysis_load_capacity
    case ('lift_off_speed_rpm')
      needed = analysis_lift_off
    case ('misalignment_allowance')
      needed = analysis_misalignment
    case default
      return
    end select
    call keys%rule('accuracy', 'quantity', scene%capacity%question /= needed, &
                   "needs analysis = '"//trim(analysis_words(needed))//"'")
  end subroutine check_limit_name

  !> What a sample cannot have beside it.
  subroutine check_sample(keys, scene)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(scene_type), intent(in) :: scene !! what the case file asks for
    character(len=*), parameter :: group = 'sample', key = 'count'

    if (.not. scene%sample%present) return
    if (keys%meant('bump_foil', 'height_deviation')) then
      call check_heights(keys, scene)
    else
      call keys%complain(group, key, 'needs height_deviation in &bump_foil: without it all '// &
                         'members are the same')
    end if
    call keys%rule(group, key, scene%sweep%present, 'needs a scene of one answer, without &sweep')
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
                      real(foil%strips*scene%bearing%pads, wp)
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
      call draw_gaps(foil%random, foil%bumps, foil%strips*scene%bearing%pads, foil%crest_gap)
      member%name = scene%name//'.seed'//text(foil%random%seed)
    end associate
  end function sample_member
end module gfb_study_rules
