!> Characters outside ASCII in a case file: its text as UTF-8, and as it was meant where they stand
!> outside strings and comments.
!>
!> Word processors and web pages put typographic quotes, dashes and special blanks where plain ones
!> were typed. Each is complained about and then read as the plain one, so that nothing else is said
!> of it.
module gfb_foreign_characters
  implicit none (type, external)
  private
  public :: as_utf8, fold_foreign, foreign_words, is_spoilt

  !> A character that does not belong where it stands.
  type, public :: foreign_type
    integer :: place = 0 !! in the folded text; of one that is dropped, the character behind it
    integer :: line = 0  !! of the file
    integer :: code = 0  !! of Unicode
  end type foreign_type

  character(len=*), parameter :: spoilt = achar(26) !! stands for what means nothing in ASCII
  character(len=*), parameter :: line_ends = achar(10)//achar(13)
  integer, parameter :: last_ascii = 127
  integer, parameter :: first_wide = int(z'FF01') !! of those as wide as a Chinese one
  integer, parameter :: last_wide = int(z'FF5E')

contains

  !> A text in UTF-8: a byte that is none of it is taken for a character of Latin-1.
  pure subroutine as_utf8(words, changed, line, byte)
    character(len=*), intent(in) :: words !! the whole file
    character(len=:), allocatable, intent(out) :: changed !! its text
    integer, intent(out) :: line !! of the first such byte, 0 where there is none
    integer, intent(out) :: byte !! that first one
    integer :: at, n, lines, code, length

    allocate (character(len=2*len(words)) :: changed)
    line = 0
    byte = 0
    lines = 1
    n = 0
    at = 1
    do while (at <= len(words))
      if (words(at:at) == new_line('a')) lines = lines + 1
      call decode(words, at, code, length)
      if (length > 0) then
        changed(n + 1:n + length) = words(at:at + length - 1)
        n = n + length
      else
        code = iachar(words(at:at))
        if (line == 0) byte = code
        if (line == 0) line = lines
        changed(n + 1:n + 2) = achar(192 + code/64)//achar(128 + mod(code, 64))
        n = n + 2
      end if
      at = at + max(1, length)
    end do
    changed = changed(:n)
  end subroutine as_utf8

  !> A text in which characters outside ASCII are what they stand for, but for strings and comments.
  pure subroutine fold_foreign(words, folded, found)
    character(len=*), intent(in) :: words !! the whole file, in UTF-8
    character(len=:), allocatable, intent(out) :: folded !! on as many lines
    type(foreign_type), allocatable, intent(out) :: found(:) !! in their order
    character(len=1) :: quote   ! that ends the open string; blank: none is open
    character(len=:), allocatable :: plain
    logical :: comment, typographic ! in one; the open string began with such a quote
    integer :: at, n, line, code, length, marks

    allocate (character(len=len(words)) :: folded)
    allocate (found(count([(iachar(words(at:at)) > last_ascii, at=1, len(words))])))
    quote = ' '
    comment = .false.
    typographic = .false.
    line = 1
    n = 0
    marks = 0
    at = 1
    if (index(words, char(239)//char(187)//char(191)) == 1) then ! the mark of a file in UTF-8
      folded(:3) = words(:3)
      n = 3
      at = 4
    end if
    do while (at <= len(words))
      call decode(words, at, code, length)
      length = max(1, length)
      plain = words(at:at + length - 1)
      if (code > last_ascii .and. .not. comment) then
        if (quote == ' ' .or. (typographic .and. plain_character(code) == quote)) then
          plain = plain_character(code)
          marks = marks + 1
          found(marks) = foreign_type(n + 1, line, code)
          if (quote == ' ') typographic = .true.
        end if
      else if (code <= last_ascii .and. quote == ' ') then
        typographic = .false.
      end if
      folded(n + 1:n + len(plain)) = plain
      n = n + len(plain)
      at = at + length
      if (plain == new_line('a')) line = line + 1
      if (len(plain) /= 1) cycle
      call follow(plain, quote, comment)
    end do
    folded = folded(:n)
    found = found(:marks)
  end subroutine fold_foreign

  !> What a character begins or ends.
  pure subroutine follow(letter, quote, comment)
    character(len=1), intent(in) :: letter
    character(len=1), intent(inout) :: quote !! of the open string
    logical, intent(inout) :: comment !! one is open

    if (scan(letter, line_ends) == 1) then
      quote = ' '
      comment = .false.
    else if (comment) then
      return
    else if (quote /= ' ') then
      if (letter == quote) quote = ' '
    else if (scan(letter, '''"') == 1) then
      quote = letter
    else
      comment = scan(letter, '!#') == 1
    end if
  end subroutine follow

  !> The character of ASCII that one outside of it stands for; empty where it is invisible.
  pure function plain_character(code) result(plain)
    integer, intent(in) :: code !! of Unicode
    character(len=:), allocatable :: plain

    select case (code)
    case (first_wide:last_wide)
      plain = achar(code - first_wide + iachar('!'))
    case (int(z'A0'), int(z'1680'), int(z'2000'):int(z'200A'), int(z'202F'), int(z'205F'), &
          int(z'3000'))
      plain = ' '
    case (int(z'AD'), int(z'200B'):int(z'200F'), int(z'202A'):int(z'202E'), &
          int(z'2060'):int(z'206F'), int(z'FEFF'))
      plain = ''
    case (int(z'2010'):int(z'2015'), int(z'2212'))
      plain = '-'
    case (int(z'2018'):int(z'201B'), int(z'2039'):int(z'203A'))
      plain = ''''
    case (int(z'AB'), int(z'BB'), int(z'201C'):int(z'201F'))
      plain = '"'
    case default
      plain = spoilt
    end select
  end function plain_character

  !> What a character outside ASCII is, in words.
  pure function foreign_words(code) result(words)
    integer, intent(in) :: code !! of Unicode
    character(len=:), allocatable :: words
    character(len=8) :: number

    words = plain_character(code)
    if (code >= first_wide .and. code <= last_wide) then
      words = 'a full-width '//words
    else if (len(words) == 0) then
      words = 'an invisible one'
    else if (words == ' ') then
      words = 'a special blank'
    else if (words == '-') then
      words = 'a typographic minus or dash'
    else if (words /= spoilt) then
      words = 'a typographic quote'
    else
      words = 'a letter or sign'
    end if
    write (number, '(z0.4)') code
    words = words//' (U+'//trim(number)//')'
  end function foreign_words

  !> Whether words hold a character that means nothing in ASCII.
  pure logical function is_spoilt(words) result(truth)
    character(len=*), intent(in) :: words !! of a folded text
    truth = index(words, spoilt) > 0
  end function is_spoilt

  !> The character that begins at a byte; a byte that is no UTF-8 has length 0.
  pure subroutine decode(words, at, code, length)
    character(len=*), intent(in) :: words
    integer, intent(in) :: at !! number of the byte
    integer, intent(out) :: code   !! of Unicode
    integer, intent(out) :: length !! bytes
    integer, parameter :: least(4) = [0, 128, 2048, 65536] !! code of so many bytes
    integer :: i, byte

    code = iachar(words(at:at))
    length = 1
    if (code <= last_ascii) return
    length = 0
    if (code >= 192 .and. code < 224) length = 2
    if (code >= 224 .and. code < 240) length = 3
    if (code >= 240 .and. code < 245) length = 4
    if (length == 0 .or. at + length - 1 > len(words)) then
      length = 0
      return
    end if
    code = iand(code, 2**(7 - length) - 1)
    do i = at + 1, at + length - 1
      byte = iachar(words(i:i))
      if (byte < 128 .or. byte > 191) then
        length = 0
        return
      end if
      code = 64*code + byte - 128
    end do
    if (code < least(length) .or. code > int(z'10FFFF')) length = 0
    if (code >= int(z'D800') .and. code <= int(z'DFFF')) length = 0
  end subroutine decode
end module gfb_foreign_characters
