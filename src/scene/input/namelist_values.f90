!> Raw values of a namelist file to numbers and logicals.
module gfb_namelist_values
  use gfb_kinds, only: wp, long
  use gfb_text, only: lower_case, text
  implicit none (type, external)
  private
  public :: word_kind, repeat_count, has_kind, read_real, read_integer, read_logical

  integer, parameter, public :: value_number = 1
  integer, parameter, public :: value_string = 2  !! between quotes
  integer, parameter, public :: value_logical = 3
  integer, parameter, public :: value_word = 4    !! neither of them

  character(len=*), parameter :: digits = '0123456789'
  character(len=*), parameter :: true_words(*) = [character(len=6) :: &
                                                  '.true.', 'true', 't', '.t.', '.true', '.t']
  character(len=*), parameter :: false_words(*) = [character(len=7) :: &
                                                   '.false.', 'false', 'f', '.f.', &
                                                   '.false', '.f']

  ! Every quantity in SI units lies far inside, and products of several of them do not overflow.
  integer, parameter :: highest_power = 30  !! of ten
  integer, parameter :: lowest_power = -60  !! of ten
  integer, parameter :: longest_number = 200 !! characters

contains

  !> Kind of a value without quotes.
  pure integer function word_kind(words) result(kind_of_word)
    character(len=*), intent(in) :: words !! a value as it was typed

    kind_of_word = value_word
    if (is_number(words)) kind_of_word = value_number
    if (len(words) > 7) return
    if (any(lower_case(words) == true_words)) kind_of_word = value_logical
    if (any(lower_case(words) == false_words)) kind_of_word = value_logical
  end function word_kind

  !> A count as typed; -1 where the words are none, `huge` where it is too large to hold.
  pure integer function repeat_count(words) result(number)
    character(len=*), intent(in) :: words !! a value as it was typed
    integer(long) :: wide
    integer :: i

    number = -1
    if (len(words) == 0 .or. verify(words, digits) > 0) return
    number = 0
    do i = 1, len(words)
      wide = 10_long*number + index(digits, words(i:i)) - 1
      number = int(min(wide, int(huge(number), long)))
      if (number == huge(number)) return
    end do
  end function repeat_count

  !> Whether words are a number, or a logical with its periods, with a kind behind it as in 1.0_8;
  !> so look digits that are divided as in 30_000.
  pure logical function has_kind(words) result(has)
    character(len=*), intent(in) :: words !! a value as it was typed
    integer :: bar

    bar = index(words, '_')
    has = bar > 1
    if (.not. has) return
    has = is_number(words(:bar - 1)) .or. &
          (words(1:1) == '.' .and. word_kind(words(:bar - 1)) == value_logical)
  end function has_kind

  !> Whether words are a number: sign, digits with a point, exponent with e or d.
  pure logical function is_number(words) result(truth)
    character(len=*), intent(in) :: words
    integer :: at, mantissa_end, point

    truth = .false.
    at = after_sign(words, 1)
    mantissa_end = scan(words, 'eEdD') - 1
    if (mantissa_end < 0) then
      mantissa_end = len(words)
    else
      if (.not. all_digits(words(after_sign(words, mantissa_end + 2):))) return
    end if
    if (mantissa_end < at) return
    associate (mantissa => words(at:mantissa_end))
      point = index(mantissa, '.')
      if (point == 0) then
        truth = all_digits(mantissa)
      else
        truth = all_digits(mantissa(:point - 1)//mantissa(point + 1:))
      end if
    end associate
  end function is_number

  !> Whether words are digits, at least one.
  pure logical function all_digits(words) result(truth)
    character(len=*), intent(in) :: words
    truth = len(words) > 0 .and. verify(words, digits) == 0
  end function all_digits

  !> The place behind a sign, where one stands.
  pure integer function after_sign(words, at) result(behind)
    character(len=*), intent(in) :: words
    integer, intent(in) :: at

    behind = at
    if (at > len(words)) return
    if (scan(words(at:at), '+-') == 1) behind = at + 1
  end function after_sign

  !> A real number; `problem` is empty where it could be read.
  pure subroutine read_real(words, number, problem)
    character(len=*), intent(in) :: words                 !! as typed
    real(wp), intent(out) :: number !! [its unit] that stands there
    character(len=:), allocatable, intent(out) :: problem !! the rule that is broken
    character(len=:), allocatable :: plain
    integer :: i, power, status

    number = 0.0_wp
    problem = ''
    if (.not. is_number(words)) then
      problem = 'must be a number'
      if (is_nan_or_inf(words)) problem = 'must be a finite number'
      return
    end if
    if (len(words) > longest_number) then
      problem = 'a number must not have more than '//text(longest_number)//' characters'
      return
    end if
    if (verify(mantissa_of(words), '+-.0') == 0) return
    power = decimal_power(words)
    ! Not left to the read: it would raise a floating point exception.
    if (power >= highest_power) then
      problem = 'must be smaller than 1e'//text(highest_power)//' in magnitude'
    else if (power < lowest_power) then
      problem = 'must be zero, or 1e'//text(lowest_power)//' or more in magnitude'
    else
      plain = words
      do i = 1, len(plain)
        if (scan(plain(i:i), 'dD') == 1) plain(i:i) = 'e'
      end do
      read (plain, *, iostat=status) number
      if (status /= 0) problem = 'must be a number'
    end if
  end subroutine read_real

  !> Power of ten of a number's first digit that is not zero.
  pure integer function decimal_power(words) result(power)
    character(len=*), intent(in) :: words
    character(len=:), allocatable :: mantissa
    integer :: point, first, at

    mantissa = mantissa_of(words)
    point = index(mantissa, '.')
    if (point == 0) point = len(mantissa) + 1
    first = verify(mantissa, '+-.0')
    power = merge(point - 1 - first, point - first, first < point)
    if (len(mantissa) == len(words)) return
    at = after_sign(words, len(mantissa) + 2)
    ! A larger exponent than this is out of range whatever the mantissa.
    if (words(at - 1:at - 1) == '-') then
      power = power - min(repeat_count(words(at:)), 10*longest_number)
    else
      power = power + min(repeat_count(words(at:)), 10*longest_number)
    end if
  end function decimal_power

  !> A number without its exponent.
  pure function mantissa_of(words) result(mantissa)
    character(len=*), intent(in) :: words
    character(len=:), allocatable :: mantissa
    integer :: last

    last = scan(words, 'eEdD') - 1
    if (last < 0) last = len(words)
    mantissa = words(1:last)
  end function mantissa_of

  !> Whether words are a spelling of NaN or infinity.
  pure logical function is_nan_or_inf(words) result(truth)
    character(len=*), intent(in) :: words
    character(len=:), allocatable :: bare

    truth = .false.
    if (len(words) > 20) return
    bare = lower_case(words(after_sign(words, 1):))
    bare = bare(verify(bare//'x', '.1#'):)
    truth = index(bare, 'nan') == 1 .or. index(bare, 'inf') == 1 .or. index(bare, 'qnan') == 1 &
            .or. index(bare, 'snan') == 1
  end function is_nan_or_inf

  !> A whole number; `problem` is empty where it could be read.
  pure subroutine read_integer(words, number, problem)
    character(len=*), intent(in) :: words                 !! as typed
    integer, intent(out) :: number !! that stands there
    character(len=:), allocatable, intent(out) :: problem !! the rule that is broken
    character(len=:), allocatable :: bare
    real(wp) :: as_real

    number = 0
    problem = ''
    bare = words(after_sign(words, 1):)
    if (all_digits(bare)) then
      number = repeat_count(bare)
      if (number == huge(number)) then
        number = 0
        problem = 'is too large for a whole number'
      end if
      if (words(1:1) == '-') number = -number
      return
    end if
    problem = 'must be a whole number'
    if (.not. is_number(words)) return
    block
      character(len=:), allocatable :: real_problem
      call read_real(words, as_real, real_problem)
      if (real_problem /= '' .or. abs(as_real) > 2.0e9_wp) return
    end block
    if (abs(as_real - anint(as_real)) > 0.0_wp) return
    problem = 'must be a whole number: write '//text(nint(as_real, long))
  end subroutine read_integer

  !> A logical; `problem` is empty where it could be read.
  pure subroutine read_logical(words, truth, problem)
    character(len=*), intent(in) :: words                 !! as typed
    logical, intent(out) :: truth !! that stands there
    character(len=:), allocatable, intent(out) :: problem !! the rule that is broken

    truth = .false.
    problem = ''
    if (word_kind(words) == value_logical) then
      truth = any(lower_case(words) == true_words)
    else
      problem = 'must be .true. or .false.'
    end if
  end subroutine read_logical
end module gfb_namelist_values
