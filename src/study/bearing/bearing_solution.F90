#include "gfb_petsc.h"
!> The answers of a bearing: the first one, from nothing or from a restart file, and those of its sweep.
module gfb_bearing_solution
  use petscsys
  use gfb_errors, only: error_type
  use gfb_scene, only: scene_type
  use gfb_model_case, only: coupling_partitioned, foil_rigid
  use gfb_operation_case, only: operation_case_type
  use gfb_sweep_case, only: operation_at
  use gfb_cost_events, only: enter_stage, leave_stage
  use gfb_scene_point, only: operating_point
  use gfb_mesh_plan, only: bearing_plan_type
  use gfb_bearing_builder, only: build_bearing
  use gfb_newton, only: newton_settings_type, create_newton
  use gfb_continuation, only: path_settings_type, path_report_type
  use gfb_cold_start, only: start_bearing, start_partitioned
  use gfb_partitioned, only: create_partitioned, destroy_partitioned
  use gfb_bearing_restart, only: recall_bearing
  use gfb_reasons, only: reason_type
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
    if (.not. reason%is_given()) call finish(sweep, next, reason, error)
    call leave_stage()
    call destroy_partitioned(sweep%sides)
  end subroutine solve_bearing

  !> What the solvers are told, and an empty record.
  subroutine set_up(scene, context, sweep)
    type(scene_type), intent(in) :: scene
    type(run_context_type), intent(in) :: context
    type(sweep_type), intent(inout) :: sweep

    sweep%scene = scene
    sweep%context = context
    associate (solver => scene%solver)
      sweep%path = path_settings_type(solver%maximum_load_steps, solver%smallest_load_step, solver%touch_down_gap)
      sweep%tolerances = newton_settings_type(solver%residual_tolerance, solver%step_tolerance, &
                                              solver%maximum_iterations)
    end associate
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
    type(operation_case_type) :: operation
    type(path_report_type) :: report

    associate (scene => sweep%scene, log => sweep%context%log)
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
    if (.not. report%converged) call sweep%explain(report, .false., reason)
    call sweep%begin(report%converged)
    if (report%converged) call sweep%keep_point(next - 1)
  end subroutine start

  !> The answer that a restart file holds.
  subroutine resume(plan, sweep, next, error)
    type(bearing_plan_type), intent(in) :: plan
    type(sweep_type), target, intent(inout) :: sweep
    integer, intent(out) :: next !! point of the sweep
    type(error_type), allocatable, intent(out) :: error

    associate (scene => sweep%scene, log => sweep%context%log)
      next = 0
      call build_bearing(scene, plan, sweep%bearing, error)
      if (allocated(error)) return
      call create_newton(sweep%newton, sweep%bearing, 'bearing_', sweep%tolerances, log)
      call recall_bearing(scene, sweep%context%restart, log, sweep%bearing, sweep%newton, sweep%record, next, error)
      if (.not. allocated(error) .and. sweep%partitioned) then
        call create_partitioned(sweep%bearing, sweep%tolerances, log, sweep%sides)
      end if
      next = next + 1
      if (scene%sweep%turn_folds) next = min(next, 2) ! answers along the branch are no points
    end associate
  end subroutine resume

  !> The rest of the sweep, point by point, or along its branch.
  subroutine finish(sweep, next, reason, error)
    type(sweep_type), target, intent(inout) :: sweep
    integer, intent(in) :: next !! point
    type(reason_type), intent(out) :: reason
    type(error_type), allocatable, intent(out) :: error

    if (.not. sweep%scene%sweep%present) return
    if (sweep%scene%sweep%turn_folds) then
      call take_walk(sweep, next, 1, reason)
      if (.not. reason%is_given()) call sweep_round_folds(sweep, reason, error)
    else
      call take_walk(sweep, next, size(sweep%scene%sweep%values), reason)
    end if
  end subroutine finish
end module gfb_bearing_solution
