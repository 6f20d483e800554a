!> The log of a group of ranks: a file of its own.
module gfb_group_log
  use gfb_errors, only: error_type, fail, status_machine
  use gfb_run_log, only: run_log_type
  use gfb_petsc_session, only: any_rank
  use gfb_job_groups, only: job_type
  implicit none (type, external)
  private
  public :: open_group_log, close_group_log

contains

  !> Begins a log; its events are told to the job.
  !>
  !> Fails when the file cannot be written; the log is silent then.
  subroutine open_group_log(path, verbose, job, log, error)
    character(len=*), intent(in) :: path
    logical, intent(in) :: verbose !! iterations too
    type(job_type), target, intent(in) :: job
    type(run_log_type), intent(out) :: log
    type(error_type), allocatable, intent(out) :: error
    integer :: status, unit

    log%active = job%leads
    log%verbose = verbose
    log%listener => job
    status = 0
    if (job%leads) then
      open (newunit=unit, file=path, action='write', status='replace', iostat=status)
      log%unit = unit
    end if
    if (any_rank(status /= 0)) then
      log = run_log_type(active=.false.)
      call fail(error, path//': the file cannot be written', status_machine)
    end if
  end subroutine open_group_log

  !> Ends a log.
  subroutine close_group_log(log)
    type(run_log_type), intent(in) :: log

    if (log%active) close (log%unit)
  end subroutine close_group_log
end module gfb_group_log
