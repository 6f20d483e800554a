!> Characters of a namelist file to tokens, and these to groups, keys and raw values.
!>
!> The scanner knows the syntax only. gfortran's own namelist read is not used: it gives no line
!> numbers, and lets unknown groups, keys given twice and NaN pass.
module gfb_namelist_scanner
  use gfb_complaints, only: complaints_type, shown
  use gfb_foreign_characters, only: foreign_type, fold_foreign, is_spoilt
  use gfb_namelist_file, only: namelist_file_type, namelist_group_type, namelist_entry_type, &
                               namelist_value_type, complain_about_foreign, section_type, &
                               section_of, bad_index
  use gfb_namelist_values, only: word_kind, repeat_count, has_kind, value_string, value_word
  use gfb_text, only: lower_case, text
  implicit none (type, external)
  private
  public :: scan_namelist

  integer, parameter :: token_group = 1  !! `&name` or `$name`; its words are the name
  integer, parameter :: token_slash = 2  !! end of a group
  integer, parameter :: token_equals = 3
  integer, parameter :: token_comma = 4
  integer, parameter :: token_open = 5   !! parenthesis
  integer, parameter :: token_close = 6  !! parenthesis
  integer, parameter :: token_string = 7 !! its words are what stands between the quotes
  integer, parameter :: token_word = 8   !! everything else: key, number, logical

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

  !> What the scanner knows between two tokens.
  type :: scanner_type
    type(namelist_file_type) :: file
    type(token_type), allocatable :: tokens(:)
    type(complaints_type) :: complaints !! the mistakes found so far
    integer :: n_groups = 0, n_entries = 0, n_values = 0, n_strays = 0
    logical :: in_group = .false.
    logical :: in_entry = .false.
    logical :: stray = .false.        !! a run of stray words has been complained about
    logical :: after_comma = .false.  !! a comma here would leave a value out
    logical :: reported = .false.     !! this entry has been complained about
  end type scanner_type

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
  pure integer function end_of_word(words, first) result(last)
    character(len=*), intent(in) :: words
    integer, intent(in) :: first

    last = first - 1
    do while (last < len(words))
      if (scan(words(last + 1:last + 1), word_ends) > 0) exit
      last = last + 1
    end do
  end function end_of_word

  !> The character that ends this line, or the one behind the text.
  pure integer function end_of_line(words, at) result(line_end)
    character(len=*), intent(in) :: words
    integer, intent(in) :: at

    line_end = scan(words(at:), line_ends)
    line_end = merge(at + line_end - 1, len(words) + 1, line_end > 0)
  end function end_of_line

  !> Whether a carriage return stands alone here, and so ends a line.
  pure logical function old_line_end(words, at) result(alone)
    character(len=*), intent(in) :: words
    integer, intent(in) :: at

    alone = words(at:at) == carriage_return
    if (alone .and. at < len(words)) alone = words(at + 1:at + 1) /= line_feed
  end function old_line_end

  !> Scans the text of a namelist file.
  pure subroutine scan_namelist(words, file, complaints)
    character(len=*), intent(in) :: words                !! the whole file
    type(namelist_file_type), intent(out) :: file !! the case file, scanned
    type(complaints_type), intent(inout) :: complaints !! the mistakes found so far
    type(scanner_type) :: scanner
    type(foreign_type), allocatable :: foreign(:)
    integer :: i, n

    call fold_foreign(words, scanner%file%words, foreign)
    scanner%complaints = complaints
    call find_tokens(scanner%file%words, scanner%tokens, scanner%complaints)
    n = size(scanner%tokens)
    allocate (scanner%file%groups(n), scanner%file%entries(n), scanner%file%values(n), &
              scanner%file%strays(n))
    i = 1
    do while (i <= n)
      call take(scanner, i)
      i = i + 1
    end do
    if (scanner%in_group) call complain_open_group(scanner, 'before the end of the file')
    call end_entry(scanner)
    complaints = scanner%complaints
    file%words = scanner%file%words
    file%groups = scanner%file%groups(:scanner%n_groups)
    file%entries = scanner%file%entries(:scanner%n_entries)
    file%values = scanner%file%values(:scanner%n_values)
    file%strays = scanner%file%strays(:scanner%n_strays)
    call complain_about_foreign(file, foreign, complaints)
  end subroutine scan_namelist

  !> Takes one token, or the several that make a key.
  pure subroutine take(self, i)
    type(scanner_type), intent(inout) :: self
    integer, intent(inout) :: i                          !! token; the last one taken
    logical :: closes

    associate (token => self%tokens(i))
      closes = token%kind == token_slash
      if (token%kind == token_group) closes = lower_case(token_words(self, i)) == 'end'
      if (token%kind == token_group .and. .not. closes) then
        call begin_group(self, i)
      else if (.not. self%in_group) then
        call take_stray(self, i)
      else if (divides(self, i)) then
        call complain(self, token%line, "'"//shown(token_words(self, i - 1)//'/'// &
                            token_words(self, i + 1))//"' is an expression: write its value")
        i = i + 1
      else if (closes) then
        call end_entry(self)
        self%in_group = .false.
        self%stray = .false.
      else if (key_length(self, i) > 0) then
        call begin_entry(self, i)
      else if (token%kind == token_comma) then
        call take_comma(self, i)
      else if (token%kind == token_word .or. token%kind == token_string) then
        call take_value(self, i)
      else if (self%in_entry .and. (token%kind == token_open .or. token%kind == token_close)) then
        call take_parenthesis(self, i)
      else
        call complain(self, token%line, "unexpected '"//token_words(self, i)//"'")
      end if
    end associate
  end subroutine take

  !> Whether a slash stands between two words of a value, which it would divide: no blank is next to
  !> it, and no key follows.
  pure function divides(self, i)
    type(scanner_type), intent(in) :: self
    integer, intent(in) :: i !! token
    logical :: divides

    divides = self%in_entry .and. self%tokens(i)%kind == token_slash .and. i > 1 .and. &
              i < size(self%tokens)
    if (.not. divides) return
    associate (before => self%tokens(i - 1), token => self%tokens(i), after => self%tokens(i + 1))
      divides = before%kind == token_word .and. before%last + 1 == token%first .and. &
                after%kind == token_word .and. token%last + 1 == after%first
    end associate
    if (divides) divides = key_length(self, i + 1) == 0
  end function divides

  !> Begins a group; one that is still open was not ended.
  pure subroutine begin_group(self, i)
    type(scanner_type), intent(inout) :: self
    integer, intent(in) :: i

    associate (token => self%tokens(i))
      if (self%in_group) then
        call complain_open_group(self, 'before &'//shown(token_words(self, i))//' in line '// &
                                 text(token%line))
      end if
      call end_entry(self)
      if (token%last < token%first) then
        call self%complaints%add(token%line, "a group's name must follow '"// &
                            self%file%words(token%first - 1:token%first - 1)//"' at once")
      end if
      self%n_groups = self%n_groups + 1
      self%file%groups(self%n_groups) = namelist_group_type(token%first, token%last, token%line)
      self%in_group = .true.
      self%stray = .false.
    end associate
  end subroutine begin_group

  !> Complains about a group without its end, where it begins.
  pure subroutine complain_open_group(self, where_seen)
    type(scanner_type), intent(inout) :: self
    character(len=*), intent(in) :: where_seen

    call self%complaints%add(self%file%groups(self%n_groups)%line, place(self)// &
                        "the group that begins here is not ended by '/' "//where_seen)
  end subroutine complain_open_group

  !> Complains about text outside a group, once for each run of it.
  pure subroutine take_stray(self, i)
    type(scanner_type), intent(inout) :: self
    integer, intent(in) :: i
    character(len=:), allocatable :: words

    if (self%stray) return
    self%stray = .true.
    associate (token => self%tokens(i))
      self%n_strays = self%n_strays + 1
      self%file%strays(self%n_strays) = namelist_group_type(token%first, token%last, token%line)
      if (is_spoilt(token_words(self, i))) return ! see the characters outside ASCII
      words = "text outside a group: '"//shown(token_words(self, i))//"'"
      if (token%kind == token_word) words = words//"; a group begins with '&' and its name, a "// &
                                            "comment with '!'"
      call self%complaints%add(token%line, words)
    end associate
  end subroutine take_stray

  !> Number of tokens that make a key with its equals sign, 0 where no key stands.
  pure integer function key_length(self, i) result(length)
    type(scanner_type), intent(in) :: self
    integer, intent(in) :: i
    integer :: j

    length = 0
    if (self%tokens(i)%kind /= token_word) return
    ! An index is a word between parentheses, a section has colons, perhaps with blanks about them.
    do j = i + 1, min(i + 8, size(self%tokens))
      select case (self%tokens(j)%kind)
      case (token_equals)
        length = j - i + 1
        return
      case (token_open, token_close, token_comma, token_word)
        if (self%tokens(i + 1)%kind /= token_open) return
      case default
        return
      end select
    end do
  end function key_length

  !> Begins a key's entry.
  pure subroutine begin_entry(self, i)
    type(scanner_type), intent(inout) :: self
    integer, intent(inout) :: i
    type(section_type) :: section
    integer :: length

    call end_entry(self)
    length = key_length(self, i)
    self%reported = .false.
    if (length > 2) then
      section%element = bad_index
      if (self%tokens(i + length - 2)%kind == token_close) then
        section = section_of(self%file%words(self%tokens(i + 1)%last + 1: &
                                             self%tokens(i + length - 2)%first - 1))
      end if
    end if
    associate (token => self%tokens(i))
      if (section%element == bad_index) then
        self%reported = .true.
        call complain(self, token%line, "the index of '"// &
                            shown(token_words(self, i))//"' must be one whole number from 1 on"// &
                            ', or a section such as 1:3')
      end if
      self%n_entries = self%n_entries + 1
      self%file%entries(self%n_entries) = namelist_entry_type( &
                                          self%n_groups, token%first, token%last, &
                                          self%tokens(i + length - 1)%first, section, &
                                          token%line, self%n_values + 1, self%n_values)
    end associate
    self%in_entry = .true.
    self%after_comma = .true.
    i = i + length - 1
  end subroutine begin_entry

  !> Ends a key's entry; one without a value is a mistake.
  pure subroutine end_entry(self)
    type(scanner_type), intent(inout) :: self

    if (self%in_entry) then
      associate (entry => self%file%entries(self%n_entries))
        if (self%reported) then
          entry%wrong = .true.
          self%file%values(entry%first_value:entry%last_value)%wrong = .true.
        else if (entry%last_value < entry%first_value) then
          call complain(self, entry%line, 'key '''// &
                              shown(self%file%key_name(self%n_entries))//''' has no value')
        end if
      end associate
    end if
    self%in_entry = .false.
    self%reported = .false.
  end subroutine end_entry

  !> Takes a comma; two of them, or one after the equals sign, leave a value out.
  pure subroutine take_comma(self, i)
    type(scanner_type), intent(inout) :: self
    integer, intent(in) :: i

    if (self%after_comma .and. .not. self%reported) then
      call complain(self, self%tokens(i)%line, 'a value is left out before a comma')
    end if
    self%after_comma = .true.
  end subroutine take_comma

  !> Takes a parenthesis among values, which are none of a language's tuples.
  pure subroutine take_parenthesis(self, i)
    type(scanner_type), intent(inout) :: self
    integer, intent(in) :: i
    character(len=:), allocatable :: key

    if (self%reported) return
    key = shown(self%file%key_name(self%n_entries))
    call complain(self, self%tokens(i)%line, key//": unexpected '"// &
                        token_words(self, i)//"'; values stand without parentheses: "//key// &
                        ' = 1.0, 2.0')
  end subroutine take_parenthesis

  !> Takes a value, with its repeat count where it has one.
  pure subroutine take_value(self, i)
    type(scanner_type), intent(inout) :: self
    integer, intent(inout) :: i
    type(namelist_value_type) :: value
    logical :: quoted !! a string begins right behind the repeat count
    integer :: star

    value = namelist_value_type(value_string, self%tokens(i)%first, self%tokens(i)%last, 1, &
                                self%tokens(i)%line, self%tokens(i)%is_open)
    if (self%tokens(i)%kind == token_word) then
      star = index(token_words(self, i), '*')
      if (star > 1) then
        value%repeats = repeat_count(self%file%words(value%first:value%first + star - 2))
      end if
      if (star > 1 .and. value%repeats >= 0) value%first = value%first + star
      value%kind = value_word
      if (value%first <= value%last) value%kind = word_kind(self%file%words(value%first:value%last))
      quoted = value%first > value%last .and. i < size(self%tokens)
      if (quoted) quoted = self%tokens(i + 1)%kind == token_string .and. &
                           self%tokens(i + 1)%first == self%tokens(i)%last + 2
      if (quoted) then
        i = i + 1
        value%kind = value_string
        value%first = self%tokens(i)%first
        value%last = self%tokens(i)%last
        value%wrong = self%tokens(i)%is_open
      else if (value%first > value%last) then
        call complain_about_value(self, i, 'a repeat count without a value')
        return
      end if
      if (value%repeats == 0) then
        call complain_about_value(self, i, 'a repeat count must not be zero')
        return
      end if
      if (value%kind == value_word .and. &
          has_kind(self%file%words(value%first:value%last)) .and. self%in_entry) then
        if (.not. self%reported) then
          call complain(self, value%line, shown(self%file%key_name(self%n_entries))// &
                              ' = '//shown(token_words(self, i))//': a namelist has no kinds '// &
                              "of numbers, and no digits divided by '_'")
        end if
        self%reported = .true.
        self%after_comma = .false.
        return
      end if
      value%repeats = max(value%repeats, 1)
    end if
    if (is_spoilt(self%file%words(value%first:value%last)) .and. value%kind /= value_string) then
      value%wrong = .true.
    end if
    if (.not. self%in_entry) then
      if (.not. (self%reported .or. value%wrong)) then
        call complain_about_value(self, i, 'a value without a key')
      end if
      return
    end if
    self%n_values = self%n_values + 1
    self%file%values(self%n_values) = value
    self%file%entries(self%n_entries)%last_value = self%n_values
    self%after_comma = .false.
  end subroutine take_value

  !> Complains about the value at a token.
  pure subroutine complain_about_value(self, i, rule)
    type(scanner_type), intent(inout) :: self
    integer, intent(in) :: i
    character(len=*), intent(in) :: rule

    call complain(self, self%tokens(i)%line, rule//': '//shown(token_words(self, i)))
    self%after_comma = .false.
  end subroutine complain_about_value

  !> Complains about what is being scanned in the open group.
  pure subroutine complain(self, line, words)
    type(scanner_type), intent(inout) :: self
    integer, intent(in) :: line !! of the file
    character(len=*), intent(in) :: words !! what is wrong

    call self%complaints%add(line, place(self)//words)
    self%reported = .true.
  end subroutine complain

  !> A token as typed.
  pure function token_words(self, i) result(words)
    type(scanner_type), intent(in) :: self
    integer, intent(in) :: i
    character(len=:), allocatable :: words
    words = self%file%words(self%tokens(i)%first:self%tokens(i)%last)
  end function token_words

  !> The open group as the beginning of a complaint.
  pure function place(self) result(words)
    type(scanner_type), intent(in) :: self
    character(len=:), allocatable :: words
    words = '&'//shown(self%file%group_name(self%n_groups))//': '
  end function place
end module gfb_namelist_scanner
