!> A log whose lines a test reads.
module captured_log
  use gfb_run_log, only: run_log_type
  implicit none (type, external)
  private
  public :: open_log, said_to

contains

  !> A log that writes to a file of its own.
  subroutine open_log(log)
    type(run_log_type), intent(out) :: log !! to be closed by `said_to`
    open (newunit=log%unit, status='scratch', action='readwrite')
  end subroutine open_log

  !> Everything that was said to a log, which ends.
  subroutine said_to(log, words)
    type(run_log_type), intent(in) :: log !! of `open_log`
    character(len=:), allocatable, intent(out) :: words !! its lines
    character(len=500) :: line
    integer :: status

    words = ''
    rewind (log%unit)
    do
      read (log%unit, '(a)', iostat=status) line
      if (status /= 0) exit
      words = words//trim(line)//new_line('a')
    end do
    close (log%unit)
  end subroutine said_to
end module captured_log
