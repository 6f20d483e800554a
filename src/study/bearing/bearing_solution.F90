#include "gfb_petsc.h"
!> The answers of a bearing: the first one, from nothing or from a restart file, and those of its sweep.
module gfb_bearing_solution
  use petscsys
  use gfb_errors, only: error_type
  use gfb_scene, only: scene_type
  use gfb_model_case, only: coupling_partitioned, foil_rigid
  use gfb_operation_case, only: operation_case_type
  use gfb_scene_reading, only: scene_at_value
  use gfb_sweep_case, only: operation_at, sweep_keys
  use gfb_cost_events, only: enter_stage, leave_stage
  use gfb_scene_point, only: operating_point
  use gfb_mesh_plan, only: bearing_plan_type
  use gfb_bearing_builder, only: build_bearing, build_opposite
  use gfb_changed_bearing, only: evaluate_changed
  use gfb_newton, only: newton_settings_type, create_newton
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
  implicit none (type)
  private
  public :: solve_bearing

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
end module gfb_bearing_solution
