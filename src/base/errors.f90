!> What the user can mend, as a value that is handed upwards.
!>
!> A procedure that can fail takes `error` as its last argument; its caller returns at once when it
!> is allocated. Only the main program prints it and ends the run with its status.
module gfb_errors
  implicit none (type, external)
  private
  public :: error_type, fail, add_context

  integer, parameter, public :: status_input = 1   !! the input is wrong
  integer, parameter, public :: status_machine = 3 !! a file or the machine failed

  !> A failure and what to say to the user.
  type :: error_type
    character(len=:), allocatable :: message !! one mistake a line
    integer :: status = status_input         !! exit status of the program
  end type error_type

contains

  !> Creates an error.
  pure subroutine fail(error, message, status)
    type(error_type), allocatable, intent(out) :: error !! what went wrong, if anything did
    character(len=*), intent(in) :: message       !! what is wrong, and the rule
    integer, intent(in), optional :: status       !! exit status, `status_input` if absent

    allocate (error)
    error%message = message
    if (present(status)) error%status = status
  end subroutine fail

  !> Puts the place where it happened before an error's message; nothing where there is no error.
  pure subroutine add_context(error, place)
    type(error_type), allocatable, intent(inout) :: error !! what went wrong, if anything did
    character(len=*), intent(in) :: place !! such as 'bump 3'
    if (allocated(error)) error%message = place//': '//error%message
  end subroutine add_context
end module gfb_errors
