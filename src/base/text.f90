!> Numbers and words as text.
module gfb_text
  use gfb_kinds, only: wp, long
  implicit none (type, external)
  private
  public :: text, exact_text, engineering_text, lower_case, nearest_word, did_you_mean, join
  public :: plain_text, one_line

  integer, parameter :: longest_word = 60 !! a longer one is a misspelling of nothing

  !> A number as short text.
  interface text
    module procedure integer_text, long_text, real_text, logical_text
  end interface text

contains

  !> An integer without blanks.
  pure function integer_text(number) result(words)
    integer, intent(in) :: number
    character(len=:), allocatable :: words
    words = long_text(int(number, long))
  end function integer_text

  !> A long integer without blanks.
  pure function long_text(number) result(words)
    integer(long), intent(in) :: number
    character(len=:), allocatable :: words
    character(len=24) :: buffer

    write (buffer, '(i0)') number
    words = trim(buffer)
  end function long_text

  !> A real with as many significant digits as asked for, six if not said.
  pure function real_text(number, digits) result(words)
    real(wp), intent(in) :: number
    integer, intent(in), optional :: digits !! significant digits
    character(len=:), allocatable :: words
    character(len=40) :: buffer, form
    integer :: n, exponent_at, last

    n = 6
    if (present(digits)) n = digits
    if (.not. abs(number) > 0.0_wp) then
      words = '0'
      return
    end if
    if (abs(number) >= 1.0e-3_wp .and. abs(number) < 1.0e6_wp) then
      write (form, '(a, i0, a)') '(f0.', max(0, n - 1 - floor(log10(abs(number)))), ')'
      write (buffer, form) number
      if (buffer(1:1) == '.') buffer = '0'//buffer(1:len(buffer) - 1)
      if (buffer(1:2) == '-.') buffer = '-0'//buffer(2:len(buffer) - 1)
      last = len_trim(buffer)
      if (index(buffer, '.') > 0) last = last_digit(trim(buffer))
      words = buffer(1:last)
    else
      write (form, '(a, i0, a)') '(es40.', n - 1, 'e3)'
      write (buffer, form) number
      buffer = adjustl(buffer)
      exponent_at = scan(buffer, 'E')
      if (exponent_at == 0) then
        words = trim(buffer)
      else
        last = last_digit(buffer(1:exponent_at - 1))
        words = buffer(1:last)//'e'//short_exponent(trim(buffer(exponent_at + 1:)))
      end if
    end if
  end function real_text

  !> The shortest decimal that reads back as exactly this number.
  pure function exact_text(number) result(words)
    real(wp), intent(in) :: number !! in any unit [1]
    character(len=:), allocatable :: words
    real(wp) :: again
    integer :: digits, status

    ! Seventeen digits always do; the eighteenth is for a decade that log10 rounds up. Few digits of
    ! the largest numbers could be rounded up to one that overflows.
    do digits = merge(17, 1, abs(number) > 1.0e307_wp), 18
      words = real_text(number, digits)
      read (words, *, iostat=status) again
      if (status == 0) then
        if (transfer(again, 0_long) == transfer(number, 0_long)) exit
      end if
    end do
    if (scan(words, '.e') == 0) words = words//'.0'
  end function exact_text

  !> A value in an engineer's unit with four significant digits, such as '6.651 um'.
  pure function engineering_text(number, unit, scale) result(words)
    real(wp), intent(in) :: number           !! in SI
    character(len=*), intent(in) :: unit     !! of the text
    real(wp), intent(in) :: scale            !! text's number over SI number
    character(len=:), allocatable :: words
    words = real_text(number*scale, 4)//' '//unit
  end function engineering_text

  !> `true` or `false`, as a namelist reads them.
  pure function logical_text(truth) result(words)
    logical, intent(in) :: truth
    character(len=:), allocatable :: words
    words = merge('.true. ', '.false.', truth)
    words = trim(words)
  end function logical_text

  !> ASCII letters in lower case, all else as it was.
  pure function lower_case(words) result(lowered)
    character(len=*), intent(in) :: words !! in capitals or not
    character(len=len(words)) :: lowered
    integer :: i, code

    lowered = words
    do i = 1, len(words)
      code = iachar(words(i:i))
      if (code >= iachar('A') .and. code <= iachar('Z')) lowered(i:i) = achar(code + 32)
    end do
  end function lower_case

  !> Insertions, deletions, replacements and swaps of neighbours that turn one word into another.
  pure integer function edit_distance(first, second) result(distance)
    character(len=*), intent(in) :: first, second !! the words compared
    integer :: table(0:len(first), 0:len(second)), i, j, cost, swapped

    table(:, 0) = [(i, i=0, len(first))]
    table(0, :) = [(j, j=0, len(second))]
    do j = 1, len(second)
      do i = 1, len(first)
        cost = merge(0, 1, first(i:i) == second(j:j))
        table(i, j) = min(table(i - 1, j) + 1, table(i, j - 1) + 1, table(i - 1, j - 1) + cost)
        if (i > 1 .and. j > 1) then
          if (first(i:i) == second(j - 1:j - 1) .and. first(i - 1:i - 1) == second(j:j)) then
            swapped = table(max(0, i - 2), max(0, j - 2)) + 1
            table(i, j) = min(table(i, j), swapped)
          end if
        end if
      end do
    end do
    distance = table(len(first), len(second))
  end function edit_distance

  !> The word of a list that a misspelt or shortened one is nearest to; empty where none is near.
  pure function nearest_word(word, words) result(nearest)
    character(len=*), intent(in) :: word     !! as typed
    character(len=*), intent(in) :: words(:) !! the right ones, blank-padded
    character(len=:), allocatable :: nearest
    integer :: i, distance, least

    nearest = ''
    if (len_trim(word) > longest_word) return
    least = max(2, (len_trim(word) + 1)/2)
    do i = 1, size(words)
      distance = edit_distance(lower_case(trim(word)), trim(words(i)))
      if (len_trim(word) >= 3 .and. index(words(i), lower_case(trim(word))) == 1) then
        distance = min(distance, 1)
      end if
      if (distance < least) then
        least = distance
        nearest = trim(words(i))
      end if
    end do
  end function nearest_word

  !> `, did you mean WORD?`; empty where there is no word.
  pure function did_you_mean(word, quote) result(question)
    character(len=*), intent(in) :: word !! such as `nearest_word` finds, or several
    character(len=*), intent(in), optional :: quote !! on both sides of it
    character(len=:), allocatable :: question

    question = word
    if (present(quote) .and. word /= '') question = quote//word//quote
    if (word /= '') question = ', did you mean '//question//'?'
  end function did_you_mean

  !> Words with a separator between them.
  pure function join(words, separator) result(joined)
    character(len=*), intent(in) :: words(:)  !! blank-padded
    character(len=*), intent(in) :: separator !! between two of them
    character(len=:), allocatable :: joined
    integer :: i

    joined = ''
    do i = 1, size(words)
      if (i > 1) joined = joined//separator
      joined = joined//trim(words(i))
    end do
  end function join

  !> A text without Markdown's marks of code.
  pure function plain_text(marked) result(words)
    character(len=*), intent(in) :: marked !! with such marks
    character(len=:), allocatable :: words
    integer :: i

    words = ''
    do i = 1, len(marked)
      if (marked(i:i) /= '`') words = words//marked(i:i)
    end do
  end function plain_text

  !> A text without line ends.
  pure function one_line(words) result(flat)
    character(len=*), intent(in) :: words
    character(len=len(words)) :: flat
    integer :: i

    flat = words
    do i = 1, len(words)
      if (words(i:i) == new_line('a')) flat(i:i) = ' '
    end do
  end function one_line

  !> Where a decimal ends when trailing zeros, and a point left bare by them, are dropped.
  pure integer function last_digit(words) result(last)
    character(len=*), intent(in) :: words

    last = verify(words, '0', back=.true.)
    if (index(words, '.') == 0) last = len(words)
    if (words(last:last) == '.') last = last - 1
  end function last_digit

  !> An exponent without plus sign and leading zeros.
  pure function short_exponent(words) result(short)
    character(len=*), intent(in) :: words
    character(len=:), allocatable :: short
    integer :: power

    read (words, *) power
    short = integer_text(power)
  end function short_exponent
end module gfb_text
