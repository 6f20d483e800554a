!> What a scene must have, and cannot have, where more is asked for than one answer: a sweep, a
!> branch, a limit, an accuracy, a run that can be resumed.
module gfb_study_rules
  use gfb_kinds, only: wp
  use gfb_study_cases, only: asked_name, of_vibrations
  use gfb_top_foil_case, only: top_foil_trailing
  use gfb_case_keys, only: case_keys_type
  use gfb_model_case, only: needs_meshes, coupling_partitioned
  use gfb_result_names, only: is_of
  use gfb_result_table, only: bearing, strip
  use gfb_scene, only: scene_type
  use gfb_analysis_row, only: analysis_rows, limit_load, limit_speed, limit_supply, limit_tilt
  use gfb_sweep_case, only: sweep_load, sweep_speed, sweep_load_angle, sweep_tilt_x, &
                            sweep_eccentricity_x, sweep_eccentricity_y
  use gfb_text, only: text
  implicit none (type, external)
  private
  public :: check_sweep, check_edge_lift, check_accuracy, check_capacity, is_unloaded

  character(len=*), parameter, public :: one_answer = 'needs a scene of one answer, without &sweep'

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
      if (analysis%is_machine) then
        call check_machine_sweep(keys, scene)
        return
      end if
      call keys%rule('sweep', memory, sweep%friction_memory .and. foil%is_known() .and. &
                     .not. foil%has_bumps, needs_meshes//'nothing else rubs')
      call keys%rule('sweep', memory, sweep%friction_memory .and. foil%has_bumps .and. &
                     .not. scene%contact%may_rub, 'needs friction_top or friction_sleeve in '// &
                     '&contact: without friction nothing is remembered')
      if (sweep%turn_folds) call check_turn_folds(keys, scene)
      if (sweep%parameter == sweep_load_angle) call check_load_angles(keys, scene)
      if (.not. analysis%is_known()) return
      floats = analysis%floats .and. .not. sweep%hold_position
      call keys%rule('sweep', 'hold_position', sweep%hold_position .and. &
                     .not. analysis%floats, "needs analysis = 'equilibrium': it "// &
                     'fixes the shaft at its equilibrium at &operation')
      select case (sweep%parameter)
      case (sweep_load, sweep_load_angle)
        call keys%rule('sweep', parameter, .not. floats, &
                       "needs analysis = 'equilibrium' without hold_position")
        call keys%rule('operation', 'load', floats .and. is_unloaded(scene), 'must not be zero '// &
                       'where it is swept: it gives '// &
                       merge('the direction', 'the magnitude', sweep%parameter == sweep_load))
      case (sweep_eccentricity_x, sweep_eccentricity_y)
        call keys%rule('sweep', parameter, .not. analysis%holds, &
                       "needs analysis = 'fixed_position'")
      case (sweep_speed)
        if (floats .and. .not. (scene%shaft_contact%present .or. scene%feed%present)) then
          call check_zeros(keys, scene, 'must be positive: a film without speed carries no load')
        end if
      case default
        return ! a tilt fits to every analysis
      end select
    end associate
  end subroutine check_sweep

  !> A machine is swept over its speed.
  subroutine check_machine_sweep(keys, scene)
    type(case_keys_type), intent(inout) :: keys
    type(scene_type), intent(in) :: scene
    character(len=*), parameter :: beside = ' beside &shaft'

    associate (sweep => scene%sweep)
      call keys%rule('sweep', 'parameter', sweep%parameter /= sweep_speed .and. &
                     sweep%parameter > 0, "must be 'speed_rpm'"//beside)
      call keys%rule('sweep', 'hold_position', sweep%hold_position, 'has no use'//beside)
      call keys%rule('sweep', 'turn_folds', sweep%turn_folds, 'has no use'//beside)
      call keys%rule('sweep', 'friction_memory', sweep%friction_memory, 'has no use'//beside)
      if (sweep%parameter == sweep_speed) then
        call check_zeros(keys, scene, 'must be positive: a film without speed carries no load')
      end if
    end associate
  end subroutine check_machine_sweep

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

    if (.not. scene%general%analysis%is_known() .or. .not. scene%model%foil%is_known()) return
    if (.not. scene%general%analysis%floats) then
      problem = "needs analysis = 'equilibrium'"
    else if (.not. scene%model%foil%has_bumps) then
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
                     analysis%is_known() .and. .not. (analysis%loads_strip .or. &
                     scene%sweep%present .or. scene%transient%present), 'needs a &sweep, or '// &
                     "analysis = 'strip' or 'transient': nothing else has steps to resume from")
      if (.not. (scene%accuracy%present .and. analysis%is_known())) return
      kind = merge(bearing, strip, analysis%has_film)
      if (scene%accuracy%quantity > 0) then
        name = asked_name(scene%accuracy)
        needed = findloc(analysis_rows%limit_result == name, .true., 1)
        if (.not. is_of(name, kind)) then
          call keys%complain(group, key, 'is no number of this analysis')
        else
          call keys%rule(group, key, .not. scene%dynamics%present .and. &
                         any(name == of_vibrations), "needs analysis = 'linear_dynamics'")
        end if
        call keys%rule(group, key, all(needed /= [0, scene%general%asked%number]), &
                       "needs analysis = '"//trim(analysis_rows(max(1, needed))%word)//"'")
        call keys%rule(group, key, name == 'lift_off_speed_rpm' .and. &
                       scene%capacity%limit == limit_supply, "needs lift_off_by = 'speed' in "// &
                       '&capacity')
        call keys%rule(group, key, name == 'lift_off_supply_pressure' .and. &
                       scene%capacity%limit /= limit_supply, "needs analysis = 'lift_off', and "// &
                       "lift_off_by = 'supply_pressure' in &capacity")
      end if
      call keys%rule(group, key, scene%sweep%present, one_answer)
      call keys%rule(group, key, resumed > 0, 'is found on several meshes, which no restart '// &
                     'file resumes: restart_every must be 0')
    end associate
  end subroutine check_accuracy

  !> Checks a scene that asks for a limit, or gives the film wanted.
  subroutine check_capacity(keys, scene)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(scene_type), intent(in) :: scene !! what the case file asks for
    character(len=:), allocatable :: still

    associate (limit => scene%capacity%limit, smallest => scene%capacity%smallest_gap, &
               sweep => scene%sweep)
      call keys%rule('capacity', 'smallest_gap', limit /= limit_speed .and. &
                     smallest > 0.0_wp .and. smallest <= scene%solver%touch_down_gap, 'must be '// &
                     'more than touch_down_gap in &solver, '//text(scene%solver%touch_down_gap)// &
                     ' m, where paths end')
      call check_limits_kept(keys, scene)
      if (limit == 0) return
      call keys%rule('operation', 'load', limit /= limit_tilt .and. &
                     is_unloaded(scene), 'must not be zero: it gives the direction, and '// &
                     'asperities carry a part of it')
      call keys%rule('scene', 'analysis', limit == limit_speed .and. .not. &
                     scene%shaft_contact%present, &
                     "'lift_off' needs &shaft_contact: only asperities lift off")
      call keys%rule('capacity', 'lift_off_by', limit == limit_supply .and. &
                     .not. scene%feed%present, "needs &feed: 'supply_pressure' is that of the "// &
                     'gas that it feeds')
      call keys%rule('feed', 'supply_pressure', limit == limit_supply .and. scene%feed%present &
                     .and. scene%feed%supply_pressure <= scene%gas%ambient_pressure, 'must be '// &
                     'above the ambient pressure, '//text(scene%gas%ambient_pressure)//' Pa: '// &
                     'the search for the lowest one begins there')
      call keys%rule('model', 'coupling', scene%model%coupling == coupling_partitioned, &
                     "must be 'monolithic' where a limit is looked for: film and foil in turns "// &
                     'follow no path to it')
      ! A lift-off speed is looked for by doubling and halving, a load capacity is given over the
      ! speed; other rules see to a shaft without asperities, and to speeds below zero.
      if (all(limit /= [limit_tilt, limit_supply]) .and. scene%shaft_contact%present) then
        still = "must be positive with analysis = '"//trim(scene%general%asked%word)//"'"
        call keys%refuse('operation', 'speed_rpm', &
                         .not. abs(scene%operation%speed_rpm) > 0.0_wp, still)
        if (sweep%present .and. sweep%parameter == sweep_speed) call check_zeros(keys, scene, still)
      end if
      if (sweep%present) call check_swept_limit(keys, scene)
    end associate
  end subroutine check_capacity

  !> Checks the limits that an answer is measured against.
  subroutine check_limits_kept(keys, scene)
    type(case_keys_type), intent(inout) :: keys
    type(scene_type), intent(in) :: scene

    associate (hottest => scene%capacity%highest_temperature, thermal => scene%thermal)
      call keys%rule('capacity', 'highest_temperature', hottest > 0.0_wp .and. .not. &
                     thermal%present, 'needs &thermal: without it nothing gets warm')
      call keys%rule('capacity', 'highest_temperature', hottest > 0.0_wp .and. thermal%present &
                     .and. hottest <= thermal%ambient_temperature, 'must be more than '// &
                     'ambient_temperature in &thermal, '//text(thermal%ambient_temperature)//' K')
    end associate
    call keys%rule('capacity', 'largest_stress', scene%capacity%largest_stress > 0.0_wp .and. &
                   .not. scene%model%foil%has_top_foil, 'has no use with foil = '''// &
                   trim(scene%model%foil%word)//''': no stresses of it are known')
  end subroutine check_limits_kept

  !> A sweep cannot change what is looked for, nor ask for answers that are no limits.
  subroutine check_swept_limit(keys, scene)
    type(case_keys_type), intent(inout) :: keys
    type(scene_type), intent(in) :: scene
    logical :: same

    associate (sweep => scene%sweep)
      select case (scene%capacity%limit)
      case (limit_load)
        same = sweep%parameter == sweep_load
      case (limit_speed)
        if (sweep%parameter == sweep_load) then
          call check_zeros(keys, scene, 'must not be zero: asperities carry a part of the load')
        end if
        same = sweep%parameter == sweep_speed
        if (allocated(sweep%keys)) same = same .or. index(sweep%keys, 'operation%speed_rpm') > 0
      case (limit_supply)
        same = .false.
        if (allocated(sweep%keys)) same = index(sweep%keys, 'feed%supply_pressure') > 0
      case default
        same = sweep%parameter == sweep_tilt_x - 1 + scene%capacity%tilt_axis
      end select
      call keys%rule('sweep', 'parameter', same, "is what analysis = '"// &
                     trim(scene%general%asked%word)//"' looks for: sweep another one")
      call keys%rule('sweep', 'hold_position', sweep%hold_position, &
                     'must be .false. where a limit is looked for: the shaft floats')
      call keys%rule('sweep', 'turn_folds', sweep%turn_folds, &
                     'must be .false. where a limit is looked for: a fold ends its path')
      call keys%rule('sweep', 'friction_memory', sweep%friction_memory, 'must be .false. where '// &
                     'a limit is looked for: the points between are no load steps')
    end associate
  end subroutine check_swept_limit

end module gfb_study_rules
