!> A sample whose members are divided among groups of ranks: one set of results.
!>
!> Every group takes the next member that is left; a member's answer does not depend on its group.
module gfb_divided_sample
  use gfb_archive, only: archive_type
  use gfb_bearing_summary, only: cost_type
  use gfb_c_library, only: peak_memory
  use gfb_errors, only: error_type
  use gfb_pool, only: pool_type, visit_task, group_log_path, end_log
  use gfb_kinds, only: wp
  use gfb_petsc_session, only: wall_time
  use gfb_quantity, only: quantity_type
  use gfb_reasons, only: status_unconverged
  use gfb_result_names, only: add_result
  use gfb_run_context, only: run_context_type
  use gfb_sample, only: sample_type, write_sample
  use gfb_scene, only: scene_type
  use gfb_text, only: text
  implicit none (type, external)
  private
  public :: run_divided_sample

  integer, parameter :: writer = 1 !! the group that writes

contains

  !> Computes the members side by side, and writes them as one run would.
  subroutine run_divided_sample(scene, study, context, pool, status)
    type(scene_type), intent(in) :: scene !! with `&sample`
    type(sample_type), intent(inout) :: study !! of this group, as it was created
    type(run_context_type), intent(in) :: context !! of the job; its log is the terminal
    type(pool_type), target, intent(inout) :: pool !! that is divided
    integer, intent(out) :: status !! exit status of the program
    type(run_context_type) :: own
    type(archive_type) :: mine
    type(error_type), allocatable :: error
    real(wp) :: total(4)
    integer :: number

    call pool%show(scene, context, &
                   ', logs '//group_log_path(context%folder, scene%name, 1)//', ...')
    call context%log%line(text(scene%sample%count)//' members, each group takes the next one')
    call context%log%line('')
    own = context
    call pool%begin_log(group_log_path(context%folder, scene%name, pool%group), own, error)
    if (.not. allocated(error)) call study%prepare(scene, own%log)
    if (.not. allocated(error)) call study%check(scene, error)
    status = 0
    if (allocated(error)) then
      status = error%status
      call own%log%complaint(error%message)
    end if
    status = pool%largest(status)
    if (status == 0) then
      pool%counted = scene%sample%count
      pool%total = scene%sample%count
      call pool%next_task(number)
      do while (number <= scene%sample%count)
        call study%solve_member(scene, own, number)
        call visit_task(mine, study%member, number)
        call pool%next_task(number)
      end do
      call pool%gather_tasks(mine, writer, study%member)
      ! Counts of a group are on each of its ranks.
      total = pool%total_of(merge(1.0_wp, 0.0_wp, [.true., pool%leads, pool%leads, pool%leads])* &
                           [peak_memory(), real(study%iterations, wp), &
                            real(study%factorizations, wp), real(study%factorizations_finest, wp)])
      study%unknowns = pool%largest(study%unknowns)
      if (pool%group == writer) call write_all(scene, context, pool, study, total, status)
      status = pool%largest(status)
    else if (pool%group == writer .and. allocated(error)) then
      call context%log%complaint(error%message)
    end if
    call end_log(own%log)
    call study%discard()
  end subroutine run_divided_sample

  !> Writes all members, and tells the terminal.
  subroutine write_all(scene, context, pool, study, total, status)
    type(scene_type), intent(in) :: scene
    type(run_context_type), intent(in) :: context
    type(pool_type), intent(in) :: pool
    type(sample_type), intent(inout) :: study
    real(wp), intent(in) :: total(4) !! memory [B], iterations, factorizations of all groups
    integer, intent(inout) :: status
    type(run_context_type) :: terminal
    type(quantity_type), allocatable :: origin(:), summary(:)
    type(error_type), allocatable :: error

    terminal = context
    terminal%log%active = pool%leads
    terminal%log%verbose = .false.
    call study%judge()
    if (.not. study%converged) status = status_unconverged
    origin = pool%origin(context)
    call add_result(origin, 'groups', pool%groups)
    call terminal%take_case(scene%name, error)
    if (.not. allocated(error)) then
      call write_sample(scene, terminal, study%member, origin, pool%ranks, &
                        cost_type(study%unknowns, nint(total(2)), nint(total(3)), nint(total(4)), &
                                  wall_time() - pool%begun, total(1)), summary, error)
    end if
    call terminal%give_back()
    if (.not. allocated(error)) return
    status = max(status, error%status)
    call terminal%log%complaint(error%message)
  end subroutine write_all
end module gfb_divided_sample
