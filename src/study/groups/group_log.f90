!> The log of a group of ranks: a file of its own.
module gfb_group_log
  use gfb_errors, only: error_type, fail, status_machine
  use gfb_text, only: text
  use gfb_c_library, only: remove_file
  use gfb_run_log, only: run_log_type
  use gfb_run_context, only: run_context_type
  use gfb_petsc_session, only: any_rank
  use gfb_job_groups, only: job_type
  implicit none (type, external)
  private
  public :: group_log_path, open_group_log, close_group_log

contains

  !> File of a group's log.
  pure function group_log_path(folder, name, group) result(path)
    character(len=*), intent(in) :: folder !! where results go
    character(len=*), intent(in) :: name   !! of the scene
    integer, intent(in) :: group           !! from 1
    character(len=:), allocatable :: path
    path = folder//'/'//name//'.group'//text(group)//'.log'
  end function group_log_path

  !> Begins a group's log, with the job as listener.
  !>
  !> Fails when the file cannot be written; the log is silent then.
  subroutine open_group_log(path, job, context, error)
    character(len=*), intent(in) :: path !! of the file
    type(job_type), target, intent(in) :: job !! whose group it is
    type(run_context_type), intent(inout) :: context !! of the group; it stays as verbose
    type(error_type), allocatable, intent(out) :: error !! why it failed
    integer :: status, unit

    context%log%active = job%leads
    context%listener => job
    status = 0
    if (job%leads) then
      call remove_file(path) ! a link in its place is not followed
      open (newunit=unit, file=path, action='write', status='new', iostat=status)
      context%log%unit = unit
      context%log%colours = .false.
      context%log%terminal = .false.
      call context%log%remember()
    end if
    if (any_rank(status /= 0)) then
      context%log = run_log_type(active=.false.)
      call fail(error, path//': the file cannot be written', status_machine)
    end if
  end subroutine open_group_log

  !> Ends a log.
  subroutine close_group_log(log)
    type(run_log_type), intent(in) :: log !! as it was opened

    if (.not. log%active) return
    call log%repeat_warnings()
    close (log%unit)
  end subroutine close_group_log
end module gfb_group_log
