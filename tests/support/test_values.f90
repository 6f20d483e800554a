!> Expected and found values of any rank as flat lists, and their comparison.
module gfb_test_values
  use, intrinsic :: iso_fortran_env, only: int32, int64, real64
  use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
  use, intrinsic :: ieee_exceptions, only: ieee_all, ieee_get_halting_mode, ieee_set_flag, &
                                           ieee_set_halting_mode
  use gfb_test_failures, only: SourceLocation, record_failure
  implicit none (type, external)
  private
  public :: values_type, flat, compare

  !> Numbers with their shape.
  type :: values_type
    logical :: is_real = .false.             !! `number` holds them, `whole` otherwise
    integer(int64), allocatable :: whole(:)  !! in array element order
    real(real64), allocatable :: number(:)   !! in array element order
    integer, allocatable :: extent(:)        !! shape; empty for a scalar
  end type values_type

  !> A scalar, vector or matrix as a list.
  interface flat
    module procedure flat_int32, flat_int64, flat_real64
  end interface flat

contains

  function flat_int32(array) result(values)
    integer(int32), intent(in) :: array(..)
    type(values_type) :: values

    allocate (values%extent, source=shape(array))
    allocate (values%whole(size(array)))
    select rank (array)
    rank (0)
      values%whole(:) = [int(array, int64)]
    rank (1)
      values%whole(:) = int(array, int64)
    rank (2)
      values%whole(:) = reshape(int(array, int64), [size(array)])
    rank default
      error stop 'asserts know scalars, vectors and matrices only'
    end select
  end function flat_int32

  function flat_int64(array) result(values)
    integer(int64), intent(in) :: array(..)
    type(values_type) :: values

    allocate (values%extent, source=shape(array))
    allocate (values%whole(size(array)))
    select rank (array)
    rank (0)
      values%whole(:) = [array]
    rank (1)
      values%whole(:) = array
    rank (2)
      values%whole(:) = reshape(array, [size(array)])
    rank default
      error stop 'asserts know scalars, vectors and matrices only'
    end select
  end function flat_int64

  function flat_real64(array) result(values)
    real(real64), intent(in) :: array(..)
    type(values_type) :: values

    values%is_real = .true.
    allocate (values%extent, source=shape(array))
    allocate (values%number(size(array)))
    select rank (array)
    rank (0)
      values%number(:) = [array]
    rank (1)
      values%number(:) = array
    rank (2)
      values%number(:) = reshape(array, [size(array)])
    rank default
      error stop 'asserts know scalars, vectors and matrices only'
    end select
  end function flat_real64

  !> Records a failure unless the relation holds for every element; a scalar stands for any shape.
  subroutine compare(relation, expected, found, tolerance, message, location)
    character(len=*), intent(in) :: relation             !! '==' '/=' '<' '<=' '>' '>=' 'relative'
    type(values_type), intent(in) :: expected            !! left of the relation
    type(values_type), intent(in) :: found               !! right of the relation
    real(real64), intent(in), optional :: tolerance      !! largest difference allowed, 0 if absent
    character(len=*), intent(in), optional :: message
    type(SourceLocation), intent(in), optional :: location
    logical :: halting(size(ieee_all))
    character(len=:), allocatable :: words
    real(real64) :: allowed

    allowed = 0.0_real64
    if (present(tolerance)) allowed = tolerance
    ! NaN and overflow must fail the test, not end the program.
    call ieee_get_halting_mode(ieee_all, halting)
    call ieee_set_halting_mode(ieee_all, .false.)
    call describe_violation(relation, expected, found, allowed, words)
    call ieee_set_flag(ieee_all, .false.)
    call ieee_set_halting_mode(ieee_all, halting)
    if (len(words) > 0) call record_failure(words, message, location)
  end subroutine compare

  !> The first element for which the relation does not hold, in words; empty if there is none.
  subroutine describe_violation(relation, expected, found, tolerance, words)
    character(len=*), intent(in) :: relation
    type(values_type), intent(in) :: expected, found
    real(real64), intent(in) :: tolerance
    character(len=:), allocatable, intent(out) :: words
    integer :: i, j, wrong, first, elements
    character(len=24) :: number

    words = ''
    if (.not. shapes_fit(expected, found)) then
      words = 'expected shape '//shape_text(expected)//', found shape '//shape_text(found)
      return
    end if
    wrong = 0
    first = 0
    elements = product(found%extent)
    do i = 1, elements
      j = merge(1, i, size(expected%extent) == 0)
      if (holds(relation, expected, j, found, i, tolerance)) cycle
      wrong = wrong + 1
      if (first == 0) first = i
    end do
    if (wrong == 0) return
    j = merge(1, first, size(expected%extent) == 0)
    words = relation_text(relation)//value_text(expected, j)//', found '// &
            value_text(found, first)//', difference '//difference_text(expected, j, found, first)
    if (relation == '==' .and. tolerance > 0.0_real64) then
      words = words//', tolerance '//real_text(tolerance)
    else if (relation == 'relative') then
      words = words//', relative tolerance '//real_text(tolerance)
    end if
    if (size(found%extent) > 0) then
      write (number, '(i0, a, i0)') wrong, ' of ', elements
      words = words//', at '//position_text(first, found%extent)//' ('//trim(number)//' wrong)'
    end if
  end subroutine describe_violation

  !> Whether the relation holds for one pair; never with NaN.
  function holds(relation, expected, i, found, j, tolerance) result(truth)
    character(len=*), intent(in) :: relation
    type(values_type), intent(in) :: expected, found
    integer, intent(in) :: i, j !! which element of each
    real(real64), intent(in) :: tolerance
    logical :: truth

    if (found%is_real) then
      truth = real_holds(relation, expected%number(i), found%number(j), tolerance)
    else
      truth = whole_holds(relation, expected%whole(i), found%whole(j))
    end if
  end function holds

  function real_holds(relation, expected, found, tolerance) result(truth)
    character(len=*), intent(in) :: relation
    real(real64), intent(in) :: expected, found
    real(real64), intent(in) :: tolerance
    logical :: truth
    logical :: same, finite

    same = expected <= found .and. expected >= found
    finite = ieee_is_finite(expected) .and. ieee_is_finite(found)
    select case (relation)
    case ('==')
      truth = same .or. (finite .and. abs(expected - found) <= tolerance)
    case ('relative')
      truth = same .or. (finite .and. abs(expected - found) <= tolerance*abs(expected))
    case ('/=')
      truth = expected < found .or. expected > found
    case ('<')
      truth = expected < found
    case ('<=')
      truth = expected <= found
    case ('>')
      truth = expected > found
    case ('>=')
      truth = expected >= found
    case default
      error stop 'unknown relation in an assert'
    end select
  end function real_holds

  function whole_holds(relation, expected, found) result(truth)
    character(len=*), intent(in) :: relation
    integer(int64), intent(in) :: expected, found
    logical :: truth

    select case (relation)
    case ('==')
      truth = expected == found
    case ('/=')
      truth = expected /= found
    case ('<')
      truth = expected < found
    case ('<=')
      truth = expected <= found
    case ('>')
      truth = expected > found
    case ('>=')
      truth = expected >= found
    case default
      error stop 'unknown relation in an assert'
    end select
  end function whole_holds

  function shapes_fit(expected, found) result(fit)
    type(values_type), intent(in) :: expected, found
    logical :: fit

    fit = size(expected%extent) == 0
    if (size(expected%extent) == size(found%extent)) fit = all(expected%extent == found%extent)
  end function shapes_fit

  !> The words before the left value.
  function relation_text(relation) result(words)
    character(len=*), intent(in) :: relation
    character(len=:), allocatable :: words

    select case (relation)
    case ('==', 'relative')
      words = 'expected '
    case ('/=')
      words = 'expected anything but '
    case default
      words = 'expected left '//relation//' right: left '
    end select
  end function relation_text

  function value_text(values, i) result(words)
    type(values_type), intent(in) :: values
    integer, intent(in) :: i
    character(len=:), allocatable :: words
    character(len=24) :: buffer

    if (values%is_real) then
      words = real_text(values%number(i))
    else
      write (buffer, '(i0)') values%whole(i)
      words = trim(buffer)
    end if
  end function value_text

  !> Found less expected.
  function difference_text(expected, i, found, j) result(words)
    type(values_type), intent(in) :: expected, found
    integer, intent(in) :: i, j
    character(len=:), allocatable :: words
    character(len=24) :: buffer

    if (found%is_real) then
      words = real_text(found%number(j) - expected%number(i))
    else
      write (buffer, '(i0)') found%whole(j) - expected%whole(i)
      words = trim(buffer)
    end if
  end function difference_text

  function real_text(number) result(words)
    real(real64), intent(in) :: number
    character(len=:), allocatable :: words
    character(len=32) :: buffer

    write (buffer, '(es25.16e3)') number
    words = trim(adjustl(buffer))
  end function real_text

  function shape_text(values) result(words)
    type(values_type), intent(in) :: values
    character(len=:), allocatable :: words
    character(len=48) :: buffer

    write (buffer, '(a, *(i0, :, ", "))') '[', values%extent
    words = trim(buffer)//']'
  end function shape_text

  !> Subscripts of an element, such as '(2, 1)'.
  function position_text(element, extent) result(words)
    integer, intent(in) :: element   !! in array element order
    integer, intent(in) :: extent(:) !! shape of the array
    character(len=:), allocatable :: words
    character(len=48) :: buffer
    integer :: subscript(size(extent)), rest, i

    rest = element - 1
    do i = 1, size(extent)
      subscript(i) = 1 + mod(rest, extent(i))
      rest = rest/extent(i)
    end do
    write (buffer, '(a, *(i0, :, ", "))') '(', subscript
    words = trim(buffer)//')'
  end function position_text
end module gfb_test_values
