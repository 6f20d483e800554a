#include "gfb_petsc.h"
!> A bearing with a given load or a given position, at one point or along a sweep.
module gfb_bearing_study
  use petscsys
  use gfb_errors, only: error_type, fail, status_machine
  use gfb_scene, only: scene_type
  use gfb_model_case, only: coupling_partitioned, foil_rigid, film_scheme_auto, film_order_bilinear
  use gfb_operation_case, only: operation_case_type
  use gfb_scene_reading, only: scene_at_value
  use gfb_sweep_case, only: operation_at, sweep_keys
  use gfb_cost_events, only: enter_stage, leave_stage
  use gfb_scene_point, only: operating_point
  use gfb_mesh_plan, only: bearing_plan_type
  use gfb_bearing_builder, only: build_bearing, build_opposite
  use gfb_changed_bearing, only: evaluate_changed
  use gfb_newton, only: newton_settings_type, create_newton, destroy_newton
  use gfb_continuation, only: path_settings_type, path_report_type
  use gfb_cold_start, only: start_bearing, restart_bearing, start_partitioned
  use gfb_partitioned, only: create_partitioned, destroy_partitioned
  use gfb_bearing_restart, only: restore_bearing
  use gfb_key_path, only: follow_keys
  use gfb_reasons, only: reason_type, reason_stopped
  use gfb_run_context, only: run_context_type
  use gfb_walk, only: take_walk
  use gfb_sweep, only: sweep_type
  use gfb_folds, only: sweep_round_folds
  use gfb_kinds, only: wp
  use gfb_quantity, only: quantity_type, add_quantity
  use gfb_run_log, only: run_log_type
  use gfb_c_library, only: peak_memory
  use gfb_petsc_session, only: wall_time, sum_over_ranks, rank_count
  use gfb_bearing_answer, only: bearing_answer
  use gfb_bearing_plan, only: plan_bearing
  use gfb_bearing_record, only: analysis_name
  use gfb_dynamics_record, only: coefficients_of
  use gfb_bearing_summary, only: cost_type, answer_quantities
  use gfb_study, only: study_type
  use gfb_motions, only: motion_type, moves
  use gfb_bearing_writing, only: record_arrays, write_coefficients, bearing_result_type, write_bearing
  implicit none (type)
  private

  !> The bearing, and what was found of it.
  type, extends(study_type), public :: bearing_study_type
    type(bearing_plan_type) :: plan
    type(sweep_type) :: sweep
    type(motion_type), allocatable :: motion !! of the shaft, where that is asked for
  contains
    procedure :: prepare => prepare_bearing
    procedure :: solve => solve_study
    procedure :: write => write_study
    procedure :: left_out => bearing_left_out
    procedure :: discard => discard_bearing
  end type bearing_study_type

contains

  !> Finds the first answer, and those of the sweep, each from its neighbour.
  !>
  !> Fails when the mesh cannot be cut or a restart file cannot be read.
  subroutine solve_bearing(scene, plan, context, sweep, reason, error)
    type(scene_type), intent(in) :: scene !! what is asked for
    type(bearing_plan_type), intent(in) :: plan !! of the bearing
    type(run_context_type), intent(in) :: context !! of the run
    type(sweep_type), target, intent(inout) :: sweep !! left at the last answer
    type(reason_type), intent(out) :: reason         !! why an answer is missing
    type(error_type), allocatable, intent(out) :: error !! why it failed
    integer :: next

    call set_up(scene, context, sweep)
    if (context%restart%goes_on) then
      call resume(plan, sweep, next, error)
    else
      call start(plan, sweep, next, reason, error)
    end if
    if (allocated(error)) return
    call enter_stage('sweep')
    if (.not. reason%is_given()) call finish(plan, sweep, next, reason, error)
    call leave_stage()
    call destroy_partitioned(sweep%sides)
    call sweep%last%destroy()
  end subroutine solve_bearing

  !> What the solvers are told, and an empty record.
  subroutine set_up(scene, context, sweep)
    type(scene_type), intent(in) :: scene
    type(run_context_type), intent(in) :: context
    type(sweep_type), target, intent(inout) :: sweep

    sweep%scene = scene
    sweep%context = context
    sweep%build%opposite => build_opposite
    sweep%build%changed => evaluate_changed
    associate (solver => scene%solver)
      sweep%path = path_settings_type(solver%maximum_load_steps, solver%smallest_load_step, solver%touch_down_gap)
      sweep%tolerances = newton_settings_type(solver%residual_tolerance, solver%step_tolerance, &
                                              solver%maximum_iterations)
    end associate
    sweep%tolerances%bound => sweep%bound
    sweep%partitioned = scene%model%coupling == coupling_partitioned .and. scene%model%foil /= foil_rigid
    allocate (sweep%record%history(0), sweep%record%judged(0))
  end subroutine set_up

  !> The first answer from nothing.
  subroutine start(plan, sweep, next, reason, error)
    type(bearing_plan_type), intent(in) :: plan
    type(sweep_type), target, intent(inout) :: sweep
    integer, intent(out) :: next !! point of the sweep
    type(reason_type), intent(out) :: reason
    type(error_type), allocatable, intent(out) :: error
    type(scene_type), allocatable :: scene
    type(operation_case_type) :: operation
    type(path_report_type) :: report

    call scene_of(sweep, 1, scene, error)
    if (allocated(error)) return
    call sweep%bound%begin(scene%solver%maximum_factorizations)
    associate (log => sweep%context%log)
      operation = scene%operation
      next = 1
      if (scene%sweep%present .and. .not. scene%sweep%hold_position) then
        operation = operation_at(scene%operation, scene%sweep, 1)
        next = 2
      end if
      if (sweep%partitioned) then
        call start_partitioned(scene, plan, operating_point(operation), sweep%tolerances, sweep%path, log, &
                               sweep%bearing, sweep%newton, sweep%sides, report, error)
      else
        call start_bearing(scene, plan, operating_point(operation), sweep%tolerances, sweep%path, log, &
                           sweep%bearing, sweep%newton, report, error)
      end if
    end associate
    if (allocated(error)) return
    call end_search(sweep, report)
    call sweep%approach_limit(report)
    if (.not. report%converged()) call sweep%explain(report, .false., reason)
    call sweep%begin(report%converged())
    if (report%converged()) call sweep%save_point(next - 1)
  end subroutine start

  !> The scene with the value of a point in it, where the sweep changes keys; else as it is.
  !>
  !> Fails where the value breaks a rule.
  subroutine scene_of(sweep, point, scene, error)
    type(sweep_type), intent(inout) :: sweep !! notes the value
    integer, intent(in) :: point !! of the sweep
    type(scene_type), allocatable, intent(out) :: scene
    type(error_type), allocatable, intent(out) :: error

    if (sweep%scene%sweep%parameter == sweep_keys) then
      allocate (scene)
      sweep%value = sweep%scene%sweep%values(point)
      call scene_at_value(sweep%scene, sweep%value, scene, error)
    else
      scene = sweep%scene
    end if
    sweep%here = scene
  end subroutine scene_of

  !> The answer that a restart file holds.
  subroutine resume(plan, sweep, next, error)
    type(bearing_plan_type), intent(in) :: plan
    type(sweep_type), target, intent(inout) :: sweep
    integer, intent(out) :: next !! point of the sweep
    type(error_type), allocatable, intent(out) :: error
    type(scene_type), allocatable :: scene
    type(bearing_plan_type) :: on_way

    next = sweep%context%restart%step
    call scene_of(sweep, next, scene, error)
    if (allocated(error)) return
    associate (log => sweep%context%log)
      on_way = plan
      on_way%bearing_distance = scene%rotor%distance_in_time ! the file was written on the way
      call build_bearing(scene, on_way, sweep%bearing, error)
      if (allocated(error)) return
      call create_newton(sweep%newton, sweep%bearing, 'bearing_', sweep%tolerances, log)
      call restore_bearing(scene, sweep%context%restart, log, sweep%bearing, sweep%newton, sweep%record, error)
      if (.not. allocated(error) .and. sweep%partitioned) then
        call create_partitioned(sweep%bearing, sweep%tolerances, log, sweep%sides)
      end if
      if (.not. allocated(error)) call sweep%last%save(sweep%bearing, sweep%newton)
      next = next + 1
      if (scene%sweep%turn_folds) next = min(next, 2) ! answers along the branch are no points
    end associate
  end subroutine resume

  !> The rest of the sweep, point by point, or along its branch.
  subroutine finish(plan, sweep, next, reason, error)
    type(bearing_plan_type), intent(in) :: plan
    type(sweep_type), target, intent(inout) :: sweep
    integer, intent(in) :: next !! point
    type(reason_type), intent(out) :: reason
    type(error_type), allocatable, intent(out) :: error

    if (.not. sweep%scene%sweep%present) return
    if (sweep%scene%sweep%turn_folds) then
      call take_walk(sweep, next, 1, reason)
      if (.not. reason%is_given()) call sweep_round_folds(sweep, reason, error)
    else if (sweep%scene%sweep%parameter == sweep_keys) then
      call walk_along_keys(plan, sweep, next, reason, error)
    else
      call walk_along_points(plan, sweep, next, reason, error)
    end if
  end subroutine finish

  !> The points of a sweep, each from its neighbour's answer; from nothing where the branch is lost on the way and nothing
  !> tells why.
  !>
  !> Fails where the mesh cannot be cut.
  subroutine walk_along_points(plan, sweep, first, reason, error)
    type(bearing_plan_type), intent(in) :: plan
    type(sweep_type), target, intent(inout) :: sweep
    integer, intent(in) :: first !! point
    type(reason_type), intent(out) :: reason
    type(error_type), allocatable, intent(out) :: error
    type(path_report_type) :: report
    integer :: next, point

    next = first
    do
      call take_walk(sweep, next, size(sweep%scene%sweep%values), reason)
      point = sweep%lost_at
      if (point == 0) exit
      sweep%lost_at = 0
      report = sweep%lost
      sweep%anew = .true.
      call start_anew(plan, sweep, point, report, error)
      if (allocated(error)) exit
      reason = reason_type()
      if (.not. report%converged()) then
        call sweep%stop_short(report, reason)
        if (reason%code == reason_stopped) call sweep%save_stopped(point - 1)
        exit
      end if
      call sweep%record_point(point)
      call sweep%save_point(point)
      next = point + 1
    end do
  end subroutine walk_along_points

  !> The points of a sweep over keys, each from its neighbour's answer; from nothing where no path leads there.
  !>
  !> Fails where the mesh cannot be cut.
  subroutine walk_along_keys(plan, sweep, first, reason, error)
    type(bearing_plan_type), intent(in) :: plan
    type(sweep_type), target, intent(inout) :: sweep
    integer, intent(in) :: first !! point
    type(reason_type), intent(out) :: reason
    type(error_type), allocatable, intent(out) :: error
    type(path_report_type) :: report
    type(scene_type), allocatable :: scene
    integer :: point

    do point = first, size(sweep%scene%sweep%values)
      call sweep%leave(operating_point(sweep%here%operation))
      call follow_keys(sweep%scene, scene_at_value, plan, sweep%value, sweep%scene%sweep%values(point), sweep%path, sweep%bearing, &
                       sweep%newton, report)
      sweep%anew = .not. (report%converged() .or. report%has_cause())
      if (sweep%anew) call start_anew(plan, sweep, point, report, error)
      if (allocated(error)) return
      if (report%converged()) call scene_of(sweep, point, scene, error)
      if (allocated(error)) return
      call sweep%approach_limit(report)
      if (.not. report%converged()) then
        call sweep%stop_short(report, reason)
        return
      end if
      call sweep%record_point(point)
      call sweep%save_point(point)
    end do
  end subroutine walk_along_keys

  !> A point of a sweep from nothing, where the path from its neighbour has ended.
  !>
  !> Fails where the mesh cannot be cut.
  subroutine start_anew(plan, sweep, point, report, error)
    type(bearing_plan_type), intent(in) :: plan
    type(sweep_type), target, intent(inout) :: sweep
    integer, intent(in) :: point
    type(path_report_type), intent(inout) :: report !! in: of the path; out: of the start
    type(error_type), allocatable, intent(out) :: error
    type(scene_type), allocatable :: scene

    call sweep%tell_end(point, report)
    call scene_of(sweep, point, scene, error)
    if (allocated(error)) return
    if (sweep%scene%sweep%parameter /= sweep_keys) scene%operation = operation_at(scene%operation, scene%sweep, point)
    call sweep%bound%begin(scene%solver%maximum_factorizations)
    call restart_bearing(scene, plan, operating_point(scene%operation), sweep%tolerances, sweep%path, &
                         sweep%context%log, sweep%bearing, sweep%newton, report, error)
    if (allocated(error)) return
    call end_search(sweep, report)
  end subroutine start_anew

  !> What follows a search from nothing is not bounded; one that gave up says so.
  subroutine end_search(sweep, report)
    type(sweep_type), intent(inout) :: sweep
    type(path_report_type), intent(inout) :: report !! of the search
    logical :: gave_up

    gave_up = sweep%bound%is_reached() .and. .not. report%converged()
    call sweep%bound%lift()
    if (.not. gave_up) return
    call sweep%context%log%line('the search from nothing gave up '//sweep%bound%words())
    if (.not. report%has_cause()) call report%ending%add_words('', ', '//sweep%bound%words())
  end subroutine end_search

  !> Plans the bearing.
  subroutine prepare_bearing(self, scene, log)
    class(bearing_study_type), intent(inout) :: self !! the study
    type(scene_type), intent(in) :: scene !! what is asked for
    type(run_log_type), intent(in) :: log !! where lines go

    call plan_bearing(scene, log, self%plan)
    self%memory = self%plan%memory
  end subroutine prepare_bearing

  !> Finds all answers.
  !>
  !> Fails when the mesh cannot be cut or a restart file cannot be read.
  subroutine solve_study(self, scene, context, error)
    class(bearing_study_type), target, intent(inout) :: self !! the study
    type(scene_type), intent(in) :: scene !! what is asked for
    type(run_context_type), intent(in) :: context !! of the run
    type(error_type), allocatable, intent(out) :: error !! why it failed

    call find_first(self, scene, context, error)
    if (allocated(error)) return
    self%converged = .not. self%reason%is_given()
    associate (dynamics => self%sweep%record%dynamics)
      if (allocated(dynamics%problem)) call fail(error, dynamics%problem, status_machine)
      if (allocated(error)) return
    end associate
    associate (bearing => self%sweep%bearing, newton => self%sweep%newton)
      self%unknowns = bearing%unknowns
      self%iterations = newton%iterations
      self%factorizations = newton%factorizations
      self%factorizations_finest = newton%factorizations - newton%factorizations_before
      self%found = answer_quantities(analysis_name(scene), self%converged, bearing_answer(bearing), &
                                     bearing%pad(1)%film%clearance, bearing%force_scale())
      if (self%converged .and. allocated(self%sweep%record%limit)) call add_quantity(self%found, self%sweep%record%limit)
    end associate
    associate (record => self%sweep%record)
      if (.not. self%converged .or. .not. allocated(record%dynamics%point)) return
      if (size(record%dynamics%point) /= 1) return
      self%coefficients = coefficients_of(record%dynamics%point(1))
      if (allocated(record%judged)) call add_quantity(self%found, record%judged)
    end associate
  end subroutine solve_study

  !> Finds the answer, or the answers of a sweep; with `&transient` or `&periodic` where the shaft begins, and its motion from there.
  !>
  !> Fails when the mesh cannot be cut or a restart file cannot be read.
  subroutine find_first(self, scene, context, error)
    class(bearing_study_type), target, intent(inout) :: self
    type(scene_type), intent(in) :: scene
    type(run_context_type), intent(in) :: context
    type(error_type), allocatable, intent(out) :: error
    type(scene_type), allocatable :: first

    first = scene
    if (scene%transient%present) first%operation%load = scene%transient%start_load
    call solve_bearing(first, self%plan, context, self%sweep, self%reason, error)
    if (allocated(error) .or. self%reason%is_given() .or. .not. moves(scene)) return
    allocate (self%motion)
    if (scene%transient%present .and. .not. context%restart%goes_on) call self%sweep%judge_begin()
    call self%motion%run(scene, context, self%sweep%bearing, self%sweep%newton, self%sweep%record, self%reason, error)
    if (.not. allocated(error)) call self%sweep%record%move_on(self%motion%results())
  end subroutine find_first

  !> Writes the result files.
  !>
  !> Fails when one cannot be written.
  subroutine write_study(self, scene, context, summary, error)
    class(bearing_study_type), target, intent(inout) :: self !! the study
    type(scene_type), intent(in) :: scene !! what is asked for
    type(run_context_type), intent(in) :: context !! of the run
    type(quantity_type), allocatable, intent(out) :: summary(:) !! what the summary says
    type(error_type), allocatable, intent(out) :: error !! why it failed
    type(bearing_result_type) :: result
    real(wp) :: memory(1)

    memory = sum_over_ranks([peak_memory()])
    result%converged = self%converged
    result%upwind = self%plan%upwind
    result%peclet = self%plan%peclet
    result%cells = self%plan%circumferential
    result%cost = cost_type(self%unknowns, self%iterations, self%factorizations, self%factorizations_finest, &
                            wall_time() - context%start_time, memory(1))
    result%ranks = rank_count()
    result%origin = context%origin()
    associate (record => self%sweep%record)
      if (allocated(self%coefficient_errors)) record%dynamics%point(1)%error = self%coefficient_errors
      result%contacts = record_arrays(scene, self%sweep%bearing, record, size(record%history))
      if (allocated(self%motion)) call self%motion%add_arrays(result%contacts)
      if (allocated(self%more)) call add_quantity(record%judged, self%more)
      call write_bearing(scene, context, self%sweep, result, summary, error)
      if (.not. allocated(error)) call write_coefficients(record, scene, context, error)
    end associate
  end subroutine write_study

  !> What the model leaves out, and why.
  function bearing_left_out(self, scene) result(words)
    class(bearing_study_type), intent(in) :: self !! the study
    type(scene_type), intent(in) :: scene !! what is asked for
    character(len=:), allocatable :: words

    words = ''
    if (self%plan%half) words = 'the other half of the width, which mirrors the one solved; '
    if (scene%model%film_order == film_order_bilinear .and. scene%model%film_scheme == film_scheme_auto .and. &
        .not. self%plan%upwind) then
      words = words//'upwinding (SUPG), which the mesh of the case does not need; '
    end if
  end function bearing_left_out

  !> Frees what the solvers hold.
  subroutine discard_bearing(self)
    class(bearing_study_type), intent(inout) :: self !! the study

    call destroy_newton(self%sweep%newton)
    call self%sweep%bearing%destroy()
  end subroutine discard_bearing
end module gfb_bearing_study
