!> A scene that is looked at and not computed.
module gfb_check_scene
  use gfb_kinds, only: wp
  use gfb_errors, only: error_type
  use gfb_run_log, only: run_log_type
  use gfb_petsc_session, only: rank_count
  use gfb_scene, only: scene_type
  use gfb_scene_case, only: is_bearing
  use gfb_mesh_plan, only: bearing_plan_type
  use gfb_bearing_plan, only: plan_bearing
  use gfb_foil_builder, only: foil_plan_type
  use gfb_foil_plan, only: plan_foil
  use gfb_memory_check, only: check_memory
  use gfb_partition_report, only: show_bearing_partition, show_strip_partition
  use gfb_provenance, only: version_text
  implicit none (type, external)
  private
  public :: check_scene

contains

  !> Says what a scene needs, and that it is in order; how it is shared out where that is asked for.
  !>
  !> Fails where the machine has too little memory, as the run would, and when METIS does.
  subroutine check_scene(scene, shares, log, error)
    type(scene_type), intent(in) :: scene !! what is asked for
    integer, intent(in) :: shares !! ranks whose shares to show; 0: those of the job; negative: none
    type(run_log_type), intent(in) :: log !! where lines go
    type(error_type), allocatable, intent(out) :: error !! why it failed
    type(bearing_plan_type) :: plan
    type(foil_plan_type) :: foil_plan
    real(wp) :: memory
    integer :: ranks

    call log%line(version_text())
    call log%line(scene%file//': '//scene%general%title)
    ranks = shares
    if (shares == 0) ranks = rank_count()
    if (is_bearing(scene%general%analysis)) then
      call plan_bearing(scene, log, plan)
      memory = plan%memory
    else
      call plan_foil(scene, log, foil_plan)
      memory = foil_plan%memory
    end if
    ! With &accuracy the run begins on a coarser mesh, and stops where the machine is full.
    if (.not. scene%accuracy%present) call check_memory(scene, memory, error)
    if (allocated(error)) return
    if (shares >= 0 .and. is_bearing(scene%general%analysis)) then
      call show_bearing_partition(scene, plan, ranks, log, error)
    else if (shares >= 0) then
      call show_strip_partition(scene, foil_plan, ranks, log, error)
    end if
    if (allocated(error)) return
    call log%line('')
    if (scene%warnings /= '') call log%tell(scene%warnings)
    call log%tell(scene%file//' is in order')
  end subroutine check_scene
end module gfb_check_scene
