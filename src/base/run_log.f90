!> The log of a run: the only place that prints.
module gfb_run_log
  use, intrinsic :: iso_fortran_env, only: output_unit, error_unit
  implicit none (type, external)
  private
  public :: run_log_type, run_listener_type

  !> Somebody who wants to hear how far a run is, such as a job that is made of many.
  type, abstract :: run_listener_type
  contains
    procedure(hear), deferred :: point_done !! a point of a sweep has its answer
    procedure(hear), deferred :: gave_up    !! there is no answer
  end type run_listener_type

  abstract interface
    !> Hears of an event; all ranks tell it.
    subroutine hear(self, words)
      import :: run_listener_type
      implicit none (type, external)
      class(run_listener_type), intent(inout) :: self
      character(len=*), intent(in) :: words !! the line
    end subroutine hear
  end interface

  !> Where the lines of a run go; silent on all ranks but one.
  type :: run_log_type
    logical :: active = .true.  !! this rank prints
    logical :: verbose = .true. !! iterations too, not only events
    integer :: unit = output_unit !! where to; what is no terminal takes the complaints too
    class(run_listener_type), pointer :: listener => null()
  contains
    procedure :: point_done => run_log_point_done
    procedure :: gave_up => run_log_gave_up
    procedure :: line => run_log_line
    procedure :: detail => run_log_detail
    procedure :: heading => run_log_heading
    procedure :: warning => run_log_warning
    procedure :: complaint => run_log_complaint
  end type run_log_type

contains

  !> One event.
  subroutine run_log_line(self, words)
    class(run_log_type), intent(in) :: self
    character(len=*), intent(in) :: words !! the line

    if (.not. self%active) return
    write (self%unit, '(a)') words
    flush (self%unit)
  end subroutine run_log_line

  !> A point of a sweep has its answer: for who listens.
  subroutine run_log_point_done(self, words)
    class(run_log_type), intent(in) :: self
    character(len=*), intent(in) :: words !! which point

    if (associated(self%listener)) call self%listener%point_done(words)
  end subroutine run_log_point_done

  !> There is no answer: a line, and for who listens.
  subroutine run_log_gave_up(self, words)
    class(run_log_type), intent(in) :: self
    character(len=*), intent(in) :: words !! what there is not, and why

    call self%line(words)
    if (associated(self%listener)) call self%listener%gave_up(words)
  end subroutine run_log_gave_up

  !> One line of a table of iterations.
  subroutine run_log_detail(self, words)
    class(run_log_type), intent(in) :: self
    character(len=*), intent(in) :: words !! the line

    if (self%verbose) call self%line('    '//words)
  end subroutine run_log_detail

  !> Begins a part of the log.
  subroutine run_log_heading(self, words)
    class(run_log_type), intent(in) :: self
    character(len=*), intent(in) :: words !! the line

    call self%line('')
    call self%line(words)
    call self%line(repeat('-', len(words)))
  end subroutine run_log_heading

  !> What the user should know although the run goes on.
  subroutine run_log_warning(self, words)
    class(run_log_type), intent(in) :: self
    character(len=*), intent(in) :: words !! the line

    call self%line('warning: '//words)
  end subroutine run_log_warning

  !> What ends the run, on the error stream.
  subroutine run_log_complaint(self, words)
    class(run_log_type), intent(in) :: self
    character(len=*), intent(in) :: words !! the line

    if (.not. self%active) return
    if (self%unit /= output_unit) then
      call self%line(words)
      return
    end if
    flush (output_unit)
    write (error_unit, '(a)') words
    flush (error_unit)
  end subroutine run_log_complaint
end module gfb_run_log
