!> `&capacity`: the limit up to which load, speed or tilt is asked for, and what a scene must have,
!> and cannot have, where one is.
module gfb_capacity_case
  use gfb_kinds, only: wp
  use gfb_accuracy_case, only: accuracy_case_type, asked_name
  use gfb_case_keys, only: case_keys_type
  use gfb_model_case, only: model_case_type, coupling_partitioned
  use gfb_operation_case, only: operation_case_type
  use gfb_scene_case, only: analysis_load_capacity, analysis_lift_off, analysis_misalignment, &
                            asks_limit, misplaced_group, analysis_words
  use gfb_solver_case, only: solver_case_type
  use gfb_sweep_case, only: sweep_case_type, sweep_load, sweep_speed, sweep_tilt_x
  use gfb_text, only: text
  use gfb_value_rules, only: positive, between
  implicit none (type, external)
  private
  public :: capacity_case_type, read_capacity_case, check_capacity

  character(len=*), parameter :: axis_words(*) = ['x', 'y']

  !> What is asked for.
  type :: capacity_case_type
    !> `analysis_load_capacity`, `analysis_lift_off` or `analysis_misalignment`; 0: nothing is
    integer :: question = 0
    real(wp) :: smallest_gap = 0.0_wp    !! that the film may have [m]
    real(wp) :: contact_part = 1.0e-2_wp !! of the load that asperities may carry [1]
    integer :: tilt_axis = 1             !! about which the shaft tilts: 1 x, 2 y
  contains
    procedure :: seeks_load
  end type capacity_case_type

contains

  !> Whether it is a load that is asked for.
  elemental logical function seeks_load(self)
    class(capacity_case_type), intent(in) :: self !! what is asked for
    seeks_load = self%question == analysis_load_capacity
  end function seeks_load

  !> Reads the group, which belongs to analyses that look for a limit.
  subroutine read_capacity_case(keys, capacity, analysis)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(capacity_case_type), intent(out) :: capacity !! what `&capacity` asks for
    integer, intent(in) :: analysis !! of the case file, 0 where it is not known
    logical :: by_gap

    by_gap = analysis == analysis_load_capacity .or. analysis == analysis_misalignment
    if (asks_limit(analysis)) capacity%question = analysis
    call keys%start_group('capacity', required=by_gap, optional=.not. by_gap, &
                          misplaced=misplaced_group(analysis, asks_limit(analysis)))
    call keys%real_key('smallest_gap', capacity%smallest_gap, 'm', &
                       'film thickness at which load or tilt has reached its limit', positive, &
                       required=by_gap, &
                       default="required for 'load_capacity' and 'misalignment_allowance'")
    call keys%real_key('contact_part', capacity%contact_part, '1', &
                       'part of the load that asperities carry at the lift-off speed', &
                       between(0.0_wp, 1.0_wp))
    call keys%choice_key('tilt_axis', capacity%tilt_axis, axis_words, &
                         'axis about which the sleeve tilts for the misalignment allowance')
    call keys%finish_group()
    if (capacity%question == 0) return
    if (analysis == analysis_lift_off) then
      if (keys%meant('capacity', 'smallest_gap')) then
        call keys%complain('capacity', 'smallest_gap', "has no use with analysis = 'lift_off': "// &
                           'that has its limit in contact_part')
      end if
    else if (keys%meant('capacity', 'contact_part')) then
      call keys%complain('capacity', 'contact_part', "needs analysis = 'lift_off'")
    end if
    if (keys%meant('capacity', 'tilt_axis') .and. analysis /= analysis_misalignment) then
      call keys%complain('capacity', 'tilt_axis', "needs analysis = 'misalignment_allowance'")
    end if
  end subroutine read_capacity_case

  !> Checks a scene that asks for a limit.
  subroutine check_capacity(keys, capacity, operation, model, solver, sweep, accuracy, touches)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(capacity_case_type), intent(in) :: capacity !! what `&capacity` asks for
    type(operation_case_type), intent(in) :: operation !! what `&operation` asks for
    type(model_case_type), intent(in) :: model !! what `&model` asks for
    type(solver_case_type), intent(in) :: solver !! what `&solver` asks for
    type(sweep_case_type), intent(in) :: sweep !! what `&sweep` asks for
    type(accuracy_case_type), intent(in) :: accuracy !! what `&accuracy` asks for
    logical, intent(in) :: touches !! the shaft has asperities

    call check_limit_name(keys, capacity, accuracy)
    if (capacity%question == 0) return
    if (operation%load_given .and. .not. any(abs(operation%load) > 0.0_wp) .and. &
        capacity%question /= analysis_misalignment) then
      call keys%complain('operation', 'load', 'must not be zero: it gives the direction, and '// &
                         'asperities carry a part of it')
    end if
    if (capacity%question == analysis_lift_off) then
      if (.not. touches) then
        call keys%complain('scene', 'analysis', "'lift_off' needs &shaft_contact: only "// &
                           'asperities lift off')
      end if
    else if (capacity%smallest_gap > 0.0_wp .and. &
             capacity%smallest_gap <= solver%touch_down_gap) then
      call keys%complain('capacity', 'smallest_gap', 'must be more than touch_down_gap in '// &
                         '&solver, '//text(solver%touch_down_gap)//' m, where paths end')
    end if
    if (model%coupling == coupling_partitioned) then
      call keys%complain('model', 'coupling', "must be 'monolithic' where a limit is "// &
                         'looked for: film and foil in turns follow no path to it')
    end if
    call check_speed(keys, capacity, operation, sweep, touches)
    call check_swept_limit(keys, capacity, sweep)
  end subroutine check_capacity

  !> A lift-off speed is looked for by doubling and halving, a load capacity is told over the speed;
  !> other rules see to a shaft without asperities, and to speeds below zero.
  subroutine check_speed(keys, capacity, operation, sweep, touches)
    type(case_keys_type), intent(inout) :: keys
    type(capacity_case_type), intent(in) :: capacity
    type(operation_case_type), intent(in) :: operation
    type(sweep_case_type), intent(in) :: sweep
    logical, intent(in) :: touches !! the shaft has asperities
    character(len=:), allocatable :: rule
    integer :: point

    if (capacity%question == analysis_misalignment .or. .not. touches) return
    rule = "must be positive with analysis = '"//trim(analysis_words(capacity%question))//"'"
    if (keys%meant('operation', 'speed_rpm') .and. .not. abs(operation%speed_rpm) > 0.0_wp) then
      call keys%complain('operation', 'speed_rpm', rule)
    end if
    if (.not. (sweep%present .and. sweep%parameter == sweep_speed)) return
    do point = 1, size(sweep%values)
      if (abs(sweep%values(point)) > 0.0_wp) cycle
      call keys%complain('sweep', 'values', rule, point)
    end do
  end subroutine check_speed

  !> A sweep cannot change what is looked for, nor ask for answers that are no limits.
  subroutine check_swept_limit(keys, capacity, sweep)
    type(case_keys_type), intent(inout) :: keys
    type(capacity_case_type), intent(in) :: capacity
    type(sweep_case_type), intent(in) :: sweep
    logical :: same
    integer :: point

    if (.not. sweep%present) return
    if (capacity%question == analysis_lift_off .and. sweep%parameter == sweep_load) then
      do point = 1, size(sweep%values)
        if (abs(sweep%values(point)) > 0.0_wp) cycle
        call keys%complain('sweep', 'values', 'must not be zero: asperities carry a part of '// &
                           'the load', point)
      end do
    end if
    select case (capacity%question)
    case (analysis_load_capacity)
      same = sweep%parameter == sweep_load
    case (analysis_lift_off)
      same = sweep%parameter == sweep_speed
      if (allocated(sweep%keys)) same = same .or. index(sweep%keys, 'operation%speed_rpm') > 0
    case default
      same = sweep%parameter == sweep_tilt_x - 1 + capacity%tilt_axis
    end select
    if (same) then
      call keys%complain('sweep', 'parameter', "is what analysis = '"// &
                         trim(analysis_words(capacity%question))//"' looks for: sweep another one")
    end if
    if (sweep%hold_position) then
      call keys%complain('sweep', 'hold_position', 'must be .false. where a limit is looked '// &
                         'for: the shaft floats')
    end if
    if (sweep%turn_folds) then
      call keys%complain('sweep', 'turn_folds', 'must be .false. where a limit is looked '// &
                         'for: a fold ends its path')
    end if
    if (sweep%friction_memory) then
      call keys%complain('sweep', 'friction_memory', 'must be .false. where a limit is looked '// &
                         'for: the points between are no load steps')
    end if
  end subroutine check_swept_limit

  !> The error of a limit can be asked for where the analysis looks for it.
  subroutine check_limit_name(keys, capacity, accuracy)
    type(case_keys_type), intent(inout) :: keys
    type(capacity_case_type), intent(in) :: capacity
    type(accuracy_case_type), intent(in) :: accuracy
    integer :: needed

    if (.not. accuracy%present .or. accuracy%quantity == 0) return
    select case (asked_name(accuracy))
    case ('load_capacity')
      needed = analysis_load_capacity
    case ('lift_off_speed_rpm')
      needed = analysis_lift_off
    case ('misalignment_allowance')
      needed = analysis_misalignment
    case default
      return
    end select
    if (capacity%question == needed) return
    call keys%complain('accuracy', 'quantity', "needs analysis = '"// &
                       trim(analysis_words(needed))//"'")
  end subroutine check_limit_name
end module gfb_capacity_case
