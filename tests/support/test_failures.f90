!> What failed, and where: the state behind the asserts.
!>
!> pFUnit's calls carry no handle, so the count and the name of the running test are the only
!> module variables of the project.
module gfb_test_failures
  use, intrinsic :: iso_fortran_env, only: output_unit
  implicit none (type, external)
  private
  public :: SourceLocation, record_failure, begin_test, test_failures

  !> A line of a test file.
  type :: SourceLocation
    character(len=128) :: file = '' !! name without folder
    integer :: line = 0             !! counted from 1
  end type SourceLocation

  integer :: failures = 0           !! failed asserts of the running test on this rank
  character(len=200) :: running_test = '' !! its name, with the rank where there are several

contains

  !> Forgets the failures of the test before.
  subroutine begin_test(name)
    character(len=*), intent(in) :: name !! shown with every failure

    failures = 0
    running_test = name
  end subroutine begin_test

  !> How many asserts failed since the test began, on this rank.
  function test_failures() result(count)
    integer :: count
    count = failures
  end function test_failures

  !> Counts a failure and shows it at once, to be seen even if another rank then waits for ever.
  subroutine record_failure(words, message, location)
    character(len=*), intent(in) :: words                    !! expected, found, difference
    character(len=*), intent(in), optional :: message        !! the test's own words
    type(SourceLocation), intent(in), optional :: location   !! of the assert
    character(len=:), allocatable :: lines
    character(len=12) :: number

    failures = failures + 1
    lines = 'FAILED '//trim(running_test)//new_line('a')//'  '
    if (present(location)) then
      write (number, '(i0)') location%line
      lines = lines//trim(location%file)//':'//trim(number)//': '
    end if
    lines = lines//words
    if (present(message)) then
      if (len_trim(message) > 0) lines = lines//new_line('a')//'  '//trim(message)
    end if
    ! One write, so that the lines of two ranks do not mix.
    write (output_unit, '(a)') lines
    flush (output_unit)
  end subroutine record_failure
end module gfb_test_failures
