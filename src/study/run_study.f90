!> A study from its plan to its files: the same steps for every analysis.
module gfb_run_study
  use gfb_errors, only: error_type
  use gfb_quantity, only: quantity_type
  use gfb_scene, only: scene_type
  use gfb_cost_events, only: enter_stage, leave_stage
  use gfb_reasons, only: reason_stopped
  use gfb_restart, only: drop_restart
  use gfb_run_context, only: run_context_type
  use gfb_study, only: study_type
  implicit none (type, external)
  private
  public :: run_study

contains

  !> Plans, checks, solves, writes and discards; a restart file goes when its run has ended well.
  !>
  !> Fails where the scene cannot be computed, and when a file cannot be written.
  subroutine run_study(study, scene, context, summary, error)
    class(study_type), target, intent(inout) :: study !! which tells whether it has an answer
    type(scene_type), intent(in) :: scene !! that is asked for
    type(run_context_type), intent(in) :: context !! of the run
    type(quantity_type), allocatable, intent(out) :: summary(:) !! what was written of the answer
    type(error_type), allocatable, intent(out) :: error !! why it failed

    call study%prepare(scene, context%log)
    call study%check(scene, error)
    if (.not. allocated(error)) then
      if (study%heading /= '') call context%log%heading(trim(study%heading))
      call study%solve(scene, context, error)
    end if
    if (.not. allocated(error)) then
      call enter_stage('output')
      call study%write(scene, context, summary, error)
      call leave_stage()
    end if
    if (study%reason%code == reason_stopped) call context%log%tell(study%reason%words())
    if (study%converged .and. .not. allocated(error)) call drop_restart(context%restart)
    call study%discard()
  end subroutine run_study
end module gfb_run_study
