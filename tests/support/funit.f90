!> The asserts, under pFUnit's names: a stand-in for the subset that the tests of this project use.
!>
!> Order is always (expected, found); give `tolerance` and `message` by keyword. Arrays may be
!> compared with an array of the same shape or with a scalar.
module funit
  use, intrinsic :: iso_fortran_env, only: int32, int64, real64
  use, intrinsic :: ieee_arithmetic, only: ieee_is_finite, ieee_is_nan
  use gfb_test_failures, only: SourceLocation, record_failure, test_failures
  use gfb_test_values, only: flat, compare
  implicit none (type, external)
  private
  public :: SourceLocation, anyExceptions, assertFail, assertTrue, assertFalse, assertEqual, &
            assertNotEqual, assertLessThan, assertLessThanOrEqual, assertGreaterThan, &
            assertGreaterThanOrEqual, assertRelativelyEqual, assertIsNaN, assertIsFinite

  !> Every element equal; reals within an absolute tolerance.
  interface assertEqual
    module procedure equal_int32, equal_int64, equal_real64, equal_string
  end interface assertEqual

  !> Two scalars that differ.
  interface assertNotEqual
    module procedure not_equal_int32, not_equal_int64, not_equal_real64
  end interface assertNotEqual

  !> Left below right.
  interface assertLessThan
    module procedure less_int32, less_int64, less_real64
  end interface assertLessThan

  !> Left not above right.
  interface assertLessThanOrEqual
    module procedure at_most_int32, at_most_int64, at_most_real64
  end interface assertLessThanOrEqual

  !> Left above right.
  interface assertGreaterThan
    module procedure greater_int32, greater_int64, greater_real64
  end interface assertGreaterThan

  !> Left not below right.
  interface assertGreaterThanOrEqual
    module procedure at_least_int32, at_least_int64, at_least_real64
  end interface assertGreaterThanOrEqual

contains

  !> Whether an assert of the running test failed on this rank.
  function anyExceptions() result(any_failed)
    logical :: any_failed
    any_failed = test_failures() > 0
  end function anyExceptions

  !> Fails.
  subroutine assertFail(message, location)
    character(len=*), intent(in) :: message !! why
    type(SourceLocation), intent(in), optional :: location

    call record_failure(message, location=location)
  end subroutine assertFail

  !> A condition that must be true.
  subroutine assertTrue(condition, message, location)
    logical, intent(in) :: condition
    character(len=*), intent(in), optional :: message
    type(SourceLocation), intent(in), optional :: location

    if (.not. condition) call record_failure('expected true, found false', message, location)
  end subroutine assertTrue

  !> A condition that must be false.
  subroutine assertFalse(condition, message, location)
    logical, intent(in) :: condition
    character(len=*), intent(in), optional :: message
    type(SourceLocation), intent(in), optional :: location

    if (condition) call record_failure('expected false, found true', message, location)
  end subroutine assertFalse

  !> A real that must not be a number.
  subroutine assertIsNaN(found, message, location)
    real(real64), intent(in) :: found
    character(len=*), intent(in), optional :: message
    type(SourceLocation), intent(in), optional :: location
    character(len=32) :: number

    if (ieee_is_nan(found)) return
    write (number, '(es25.16e3)') found
    call record_failure('expected NaN, found '//trim(adjustl(number)), message, location)
  end subroutine assertIsNaN

  !> A real that must be neither infinite nor NaN.
  subroutine assertIsFinite(found, message, location)
    real(real64), intent(in) :: found
    character(len=*), intent(in), optional :: message
    type(SourceLocation), intent(in), optional :: location
    character(len=32) :: number

    if (ieee_is_finite(found)) return
    write (number, '(es25.16e3)') found
    call record_failure('expected a finite number, found '//trim(adjustl(number)), message, &
                        location)
  end subroutine assertIsFinite

  !> Every element within `tolerance` times the size of the expected one.
  subroutine assertRelativelyEqual(expected, found, tolerance, message, location)
    real(real64), intent(in) :: expected(..), found(..)
    real(real64), intent(in), optional :: tolerance !! relative
    character(len=*), intent(in), optional :: message
    type(SourceLocation), intent(in), optional :: location

    call compare('relative', flat(expected), flat(found), tolerance, message, location)
  end subroutine assertRelativelyEqual

  subroutine equal_string(expected, found, message, location)
    character(len=*), intent(in) :: expected, found
    character(len=*), intent(in), optional :: message
    type(SourceLocation), intent(in), optional :: location

    ! Fortran's own comparison: trailing blanks do not count.
    if (expected == found) return
    call record_failure('expected "'//expected//'", found "'//found//'"', message, location)
  end subroutine equal_string

  subroutine equal_int32(expected, found, message, location)
    integer(int32), intent(in) :: expected(..), found(..)
    character(len=*), intent(in), optional :: message
    type(SourceLocation), intent(in), optional :: location

    call compare('==', flat(expected), flat(found), message=message, location=location)
  end subroutine equal_int32

  subroutine equal_int64(expected, found, message, location)
    integer(int64), intent(in) :: expected(..), found(..)
    character(len=*), intent(in), optional :: message
    type(SourceLocation), intent(in), optional :: location

    call compare('==', flat(expected), flat(found), message=message, location=location)
  end subroutine equal_int64

  subroutine equal_real64(expected, found, tolerance, message, location)
    real(real64), intent(in) :: expected(..), found(..)
    real(real64), intent(in), optional :: tolerance !! absolute
    character(len=*), intent(in), optional :: message
    type(SourceLocation), intent(in), optional :: location

    call compare('==', flat(expected), flat(found), tolerance, message, location)
  end subroutine equal_real64

  subroutine not_equal_int32(expected, found, message, location)
    integer(int32), intent(in) :: expected, found
    character(len=*), intent(in), optional :: message
    type(SourceLocation), intent(in), optional :: location

    call compare('/=', flat(expected), flat(found), message=message, location=location)
  end subroutine not_equal_int32

  subroutine not_equal_int64(expected, found, message, location)
    integer(int64), intent(in) :: expected, found
    character(len=*), intent(in), optional :: message
    type(SourceLocation), intent(in), optional :: location

    call compare('/=', flat(expected), flat(found), message=message, location=location)
  end subroutine not_equal_int64

  subroutine not_equal_real64(expected, found, message, location)
    real(real64), intent(in) :: expected, found
    character(len=*), intent(in), optional :: message
    type(SourceLocation), intent(in), optional :: location

    call compare('/=', flat(expected), flat(found), message=message, location=location)
  end subroutine not_equal_real64

  subroutine less_int32(left, right, message, location)
    integer(int32), intent(in) :: left(..), right(..)
    character(len=*), intent(in), optional :: message
    type(SourceLocation), intent(in), optional :: location

    call compare('<', flat(left), flat(right), message=message, location=location)
  end subroutine less_int32

  subroutine less_int64(left, right, message, location)
    integer(int64), intent(in) :: left(..), right(..)
    character(len=*), intent(in), optional :: message
    type(SourceLocation), intent(in), optional :: location

    call compare('<', flat(left), flat(right), message=message, location=location)
  end subroutine less_int64

  subroutine less_real64(left, right, message, location)
    real(real64), intent(in) :: left(..), right(..)
    character(len=*), intent(in), optional :: message
    type(SourceLocation), intent(in), optional :: location

    call compare('<', flat(left), flat(right), message=message, location=location)
  end subroutine less_real64

  subroutine at_most_int32(left, right, message, location)
    integer(int32), intent(in) :: left(..), right(..)
    character(len=*), intent(in), optional :: message
    type(SourceLocation), intent(in), optional :: location

    call compare('<=', flat(left), flat(right), message=message, location=location)
  end subroutine at_most_int32

  subroutine at_most_int64(left, right, message, location)
    integer(int64), intent(in) :: left(..), right(..)
    character(len=*), intent(in), optional :: message
    type(SourceLocation), intent(in), optional :: location

    call compare('<=', flat(left), flat(right), message=message, location=location)
  end subroutine at_most_int64

  subroutine at_most_real64(left, right, message, location)
    real(real64), intent(in) :: left(..), right(..)
    character(len=*), intent(in), optional :: message
    type(SourceLocation), intent(in), optional :: location

    call compare('<=', flat(left), flat(right), message=message, location=location)
  end subroutine at_most_real64

  subroutine greater_int32(left, right, message, location)
    integer(int32), intent(in) :: left(..), right(..)
    character(len=*), intent(in), optional :: message
    type(SourceLocation), intent(in), optional :: location

    call compare('>', flat(left), flat(right), message=message, location=location)
  end subroutine greater_int32

  subroutine greater_int64(left, right, message, location)
    integer(int64), intent(in) :: left(..), right(..)
    character(len=*), intent(in), optional :: message
    type(SourceLocation), intent(in), optional :: location

    call compare('>', flat(left), flat(right), message=message, location=location)
  end subroutine greater_int64

  subroutine greater_real64(left, right, message, location)
    real(real64), intent(in) :: left(..), right(..)
    character(len=*), intent(in), optional :: message
    type(SourceLocation), intent(in), optional :: location

    call compare('>', flat(left), flat(right), message=message, location=location)
  end subroutine greater_real64

  subroutine at_least_int32(left, right, message, location)
    integer(int32), intent(in) :: left(..), right(..)
    character(len=*), intent(in), optional :: message
    type(SourceLocation), intent(in), optional :: location

    call compare('>=', flat(left), flat(right), message=message, location=location)
  end subroutine at_least_int32

  subroutine at_least_int64(left, right, message, location)
    integer(int64), intent(in) :: left(..), right(..)
    character(len=*), intent(in), optional :: message
    type(SourceLocation), intent(in), optional :: location

    call compare('>=', flat(left), flat(right), message=message, location=location)
  end subroutine at_least_int64

  subroutine at_least_real64(left, right, message, location)
    real(real64), intent(in) :: left(..), right(..)
    character(len=*), intent(in), optional :: message
    type(SourceLocation), intent(in), optional :: location

    call compare('>=', flat(left), flat(right), message=message, location=location)
  end subroutine at_least_real64
end module funit
