!> The log of a run: the only place that prints.
module gfb_run_log
  use, intrinsic :: iso_fortran_env, only: output_unit, error_unit
  implicit none (type, external)
  private
  public :: run_log_type

  !> Where the lines of a run go; silent on all ranks but one.
  type :: run_log_type
    logical :: active = .true.  !! this rank prints
    logical :: verbose = .true. !! iterations too, not only events
    integer :: unit = output_unit !! where to; what is no terminal takes the complaints too
  contains
    procedure :: line => run_log_line
    procedure :: detail => run_log_detail
    procedure :: heading => run_log_heading
    procedure :: warning => run_log_warning
    procedure :: complaint => run_log_complaint
  end type run_log_type

contains

  !> One event.
  subroutine run_log_line(self, words)
    class(run_log_type), intent(in) :: self !! the log
    character(len=*), intent(in) :: words !! the line

    if (self%active) call put(self%unit, words)
  end subroutine run_log_line

  !> Writes a line; a log that cannot be written does not end the run.
  subroutine put(unit, words)
    integer, intent(in) :: unit
    character(len=*), intent(in) :: words
    integer :: status

    write (unit, '(a)', iostat=status) words
    if (status == 0) flush (unit, iostat=status)
    if (status /= 0) return
  end subroutine put

  !> One line of a table of iterations.
  subroutine run_log_detail(self, words)
    class(run_log_type), intent(in) :: self !! the log
    character(len=*), intent(in) :: words !! the line

    if (self%verbose) call self%line('    '//words)
  end subroutine run_log_detail

  !> Begins a part of the log.
  subroutine run_log_heading(self, words)
    class(run_log_type), intent(in) :: self !! the log
    character(len=*), intent(in) :: words !! the line

    call self%line('')
    call self%line(words)
    call self%line(repeat('-', len(words)))
  end subroutine run_log_heading

  !> What the user should know although the run goes on.
  subroutine run_log_warning(self, words)
    class(run_log_type), intent(in) :: self !! the log
    character(len=*), intent(in) :: words !! the line

    call self%line('warning: '//words)
  end subroutine run_log_warning

  !> What ends the run, on the error stream.
  subroutine run_log_complaint(self, words)
    class(run_log_type), intent(in) :: self !! the log
    character(len=*), intent(in) :: words !! the line

    if (.not. self%active) return
    if (self%unit /= output_unit) then
      call self%line(words)
      return
    end if
    call put(error_unit, words)
  end subroutine run_log_complaint
end module gfb_run_log
