!> Runs the tests of one program in turn, counts them, and ends the program with a status.
module gfb_test_run
  use, intrinsic :: iso_fortran_env, only: error_unit, output_unit
  use gfb_test_failures, only: begin_test, test_failures
  implicit none (type, external)
  private
  public :: test_run_type, plain_procedure, run_plain_test

  integer, parameter :: status_failed = 2 !! exit status when a test failed, as with pFUnit
  integer, parameter :: status_usage = 1  !! exit status when the command line is wrong

  abstract interface
    !> A test without arguments, or what runs before or after it.
    subroutine plain_procedure()
      implicit none (type, external)
    end subroutine plain_procedure
  end interface

  !> What is asked for, and the count so far.
  type :: test_run_type
    logical :: speaks = .true.               !! this rank prints
    logical :: verbose = .false.             !! every test, not only those that fail
    character(len=:), allocatable :: pattern !! run only tests whose name contains it
    integer :: tests = 0                     !! that ran
    integer :: failed = 0
    integer :: disabled = 0
  contains
    procedure :: read_command_line
    procedure :: is_wanted
    procedure :: announce
    procedure :: skip
    procedure :: count_result
    procedure :: close => close_run
    procedure :: tell_count
    procedure :: leave
  end type test_run_type

contains

  !> Takes `--verbose` and `--filter WORD`.
  subroutine read_command_line(self)
    class(test_run_type), intent(inout) :: self
    character(len=200) :: word
    integer :: i

    self%pattern = ''
    i = 0
    do while (i < command_argument_count())
      i = i + 1
      call get_command_argument(i, word)
      select case (word)
      case ('--verbose', '-v')
        self%verbose = .true.
      case ('--filter', '-f')
        i = i + 1
        call get_command_argument(i, word)
        self%pattern = trim(word)
      case default
        if (self%speaks) write (error_unit, '(2a)') 'usage: [--verbose] [--filter WORD], not ', &
          trim(word)
        stop status_usage, quiet=.true.
      end select
    end do
  end subroutine read_command_line

  !> Whether a test's name contains the word asked for.
  function is_wanted(self, name) result(wanted)
    class(test_run_type), intent(in) :: self
    character(len=*), intent(in) :: name
    logical :: wanted
    wanted = index(name, self%pattern) > 0
  end function is_wanted

  !> Names the test that starts, so that one that crashes or hangs is known.
  subroutine announce(self, name)
    class(test_run_type), intent(in) :: self
    character(len=*), intent(in) :: name

    if (.not. (self%speaks .and. self%verbose)) return
    write (output_unit, '(a)') 'begins   '//name
    flush (output_unit)
  end subroutine announce

  !> Notes a disabled test.
  subroutine skip(self, name)
    class(test_run_type), intent(inout) :: self
    character(len=*), intent(in) :: name

    self%disabled = self%disabled + 1
    if (self%speaks) write (output_unit, '(a)') 'disabled '//name
  end subroutine skip

  !> Notes how a test ended.
  subroutine count_result(self, name, passed)
    class(test_run_type), intent(inout) :: self
    character(len=*), intent(in) :: name
    logical, intent(in) :: passed !! on all ranks

    self%tests = self%tests + 1
    if (.not. passed) self%failed = self%failed + 1
    if (.not. self%speaks) return
    if (.not. passed) then
      write (output_unit, '(a)') 'failed   '//name
    else if (self%verbose) then
      write (output_unit, '(a)') 'ok       '//name
    end if
    flush (output_unit)
  end subroutine count_result

  !> Prints the count and ends the program; a run without any test is a failure too.
  subroutine close_run(self)
    class(test_run_type), intent(in) :: self
    call self%tell_count()
    call self%leave()
  end subroutine close_run

  !> Prints the count.
  subroutine tell_count(self)
    class(test_run_type), intent(in) :: self

    if (.not. self%speaks) return
    write (output_unit, '(3(i0, a))') self%tests, ' tests, ', self%failed, ' failed, ', &
      self%disabled, ' disabled'
    if (self%tests == 0) write (output_unit, '(a)') 'FAILED: no test was run'
    flush (output_unit)
  end subroutine tell_count

  !> Ends the program where a test failed, or none was run.
  subroutine leave(self)
    class(test_run_type), intent(in) :: self
    if (self%failed > 0 .or. self%tests == 0) stop status_failed, quiet=.true.
  end subroutine leave

  !> Runs one test without arguments; `after` runs even if the test failed.
  subroutine run_plain_test(run, name, test, before, after)
    class(test_run_type), intent(inout) :: run
    character(len=*), intent(in) :: name
    procedure(plain_procedure) :: test
    procedure(plain_procedure), optional :: before, after

    if (.not. run%is_wanted(name)) return
    call run%announce(name)
    call begin_test(name)
    if (present(before)) call before()
    if (test_failures() == 0) call test()
    if (present(after)) call after()
    call run%count_result(name, test_failures() == 0)
  end subroutine run_plain_test
end module gfb_test_run
