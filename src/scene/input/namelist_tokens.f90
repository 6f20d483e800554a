!> Characters of a namelist file to tokens.
module gfb_namelist_tokens
  use gfb_complaints, only: complaints_type, shown
  implicit none (type, external)
  private
  public :: token_type, find_tokens

  integer, parameter, public :: token_group = 1  !! `&name` or `$name`; its words are the name
  integer, parameter, public :: token_slash = 2  !! end of a group
  integer, parameter, public :: token_equals = 3
  integer, parameter, public :: token_comma = 4
  integer, parameter, public :: token_open = 5   !! parenthesis
  integer, parameter, public :: token_close = 6  !! parenthesis
  integer, parameter, public :: token_string = 7 !! its words are what stands between the quotes
  integer, parameter, public :: token_word = 8   !! everything else: key, number, logical

  !> A token: where it stands in the text.
  type :: token_type
    integer :: kind = 0
    integer :: first = 1 !! first character
    integer :: last = 0  !! last character
    integer :: line = 0  !! of the file, from 1
    logical :: is_open = .false. !! a string without its closing quote
  end type token_type

  character(len=*), parameter :: line_feed = achar(10), carriage_return = achar(13)
  character(len=*), parameter :: line_ends = line_feed//carriage_return
  character(len=*), parameter :: blanks = ' '//achar(9)//achar(11)//achar(12)//carriage_return
  character(len=*), parameter :: marks = '/=,()'  !! in the order of token_slash and its followers
  character(len=*), parameter :: word_ends = blanks//line_feed//marks//'&!''"'
  character(len=*), parameter :: byte_order_mark = char(239)//char(187)//char(191)

contains

  !> All tokens of a text; comments and blanks are dropped.
  pure subroutine find_tokens(words, tokens, complaints)
    character(len=*), intent(in) :: words                     !! the whole file, folded to ASCII
    type(token_type), allocatable, intent(out) :: tokens(:) !! names, signs and values of the line
    type(complaints_type), intent(inout) :: complaints !! the mistakes found so far
    integer :: at, line, n

    allocate (tokens(len(words)))
    n = 0
    line = 1
    at = 1
    if (index(words, byte_order_mark) == 1) at = 4
    do while (at <= len(words))
      associate (letter => words(at:at))
        if (letter == line_feed .or. old_line_end(words, at)) then
          line = line + 1
          at = at + 1
        else if (scan(letter, blanks) > 0) then
          at = at + 1
        else if (letter == '!') then
          at = end_of_line(words, at)
        else if (letter == '#') then
          call complaints%add(line, "a comment begins with '!', not with '#'")
          at = end_of_line(words, at)
        else if (words(at:min(at + 1, len(words))) == '//') then
          call complaints%add(line, "a comment begins with '!', not with '//'")
          at = end_of_line(words, at)
        else
          n = n + 1
          call take_token(words, at, line, tokens(n), complaints)
        end if
      end associate
    end do
    tokens = tokens(1:n)
  end subroutine find_tokens

  !> Takes the token that begins here and moves behind it.
  pure subroutine take_token(words, at, line, token, complaints)
    character(len=*), intent(in) :: words
    integer, intent(inout) :: at                 !! character, then the first behind the token
    integer, intent(in) :: line
    type(token_type), intent(out) :: token
    type(complaints_type), intent(inout) :: complaints
    integer :: mark

    token%line = line
    token%first = at
    mark = index(marks, words(at:at))
    if (mark > 0) then
      token%kind = token_slash + mark - 1
      token%last = at
      at = at + 1
    else if (scan(words(at:at), '&$') == 1) then
      token%kind = token_group
      token%first = at + 1
      token%last = end_of_word(words, at + 1)
      at = token%last + 1
    else if (words(at:at) == '''' .or. words(at:at) == '"') then
      call take_string(words, at, token, complaints)
    else
      token%kind = token_word
      token%last = end_of_word(words, at)
      at = token%last + 1
    end if
  end subroutine take_token

  !> Takes a string; it ends on its line, and a doubled quote inside stands for one.
  pure subroutine take_string(words, at, token, complaints)
    character(len=*), intent(in) :: words
    integer, intent(inout) :: at
    type(token_type), intent(inout) :: token
    type(complaints_type), intent(inout) :: complaints
    character(len=1) :: quote
    logical :: closed

    quote = words(at:at)
    closed = .false.
    token%kind = token_string
    token%first = at + 1
    at = at + 1
    ! The line's end is not sought ahead: a long line can hold very many strings.
    do while (at <= len(words))
      if (scan(words(at:at), line_ends) > 0) exit
      if (words(at:at) == quote) then
        closed = at == len(words)
        if (.not. closed) closed = words(at + 1:at + 1) /= quote
        if (closed) exit
        at = at + 1
      end if
      at = at + 1
    end do
    token%last = at - 1
    token%is_open = .not. closed
    if (closed) then
      at = at + 1
    else
      call complaints%add(token%line, 'a string without its closing quote: '//quote// &
                          shown(words(token%first:token%last)))
    end if
  end subroutine take_string

  !> Last character of the word that begins here.
  pure function end_of_word(words, first) result(last)
    character(len=*), intent(in) :: words
    integer, intent(in) :: first
    integer :: last

    last = first - 1
    do while (last < len(words))
      if (scan(words(last + 1:last + 1), word_ends) > 0) exit
      last = last + 1
    end do
  end function end_of_word

  !> The character that ends this line, or the one behind the text.
  pure function end_of_line(words, at) result(line_end)
    character(len=*), intent(in) :: words
    integer, intent(in) :: at
    integer :: line_end

    line_end = scan(words(at:), line_ends)
    line_end = merge(at + line_end - 1, len(words) + 1, line_end > 0)
  end function end_of_line

  !> Whether a carriage return stands alone here, and so ends a line.
  pure function old_line_end(words, at) result(alone)
    character(len=*), intent(in) :: words
    integer, intent(in) :: at
    logical :: alone

    alone = words(at:at) == carriage_return
    if (alone .and. at < len(words)) alone = words(at + 1:at + 1) /= line_feed
  end function old_line_end
end module gfb_namelist_tokens
