!> Results by their names: what the table says of them, lists made from it, and lists of values
!> whose unit and meaning come from it.
module gfb_result_names
  use gfb_result_table, only: result_type, result_rows, heats, study_words, own_unit, own_square, &
                              name_length, sweep
  use gfb_text, only: join, plain_text
  use gfb_kinds, only: wp
  use gfb_quantity, only: quantity_type, add_quantity, quantity_number, quantity_count, &
                          quantity_word, quantity_truth
  implicit none (type, external)
  private
  public :: find_result, result_unit, result_meaning, is_of, is_of_heat, is_nodal, asked_names, &
            compared_names, results_text, result_words, row_names, quotient_unit, add_result

  character(len=*), parameter :: any_number = '<n>', any_key = '<key>', &
                                 any_quantity = '<quantity>'
  !> What stands for one of several words; the last one changes first.
  character(len=*), parameter :: markers(*) = [character(len=10) :: '<b>', '<a>', '<state>', &
                                               any_quantity]
  character(len=*), parameter :: digits = '0123456789'
  character(len=*), parameter :: key_letters = digits//'_abcdefghijklmnopqrstuvwxyz'
  character(len=*), parameter :: next = new_line('a')

  !> Puts a result at the end of a list. A name that the table does not have, or has for values of
  !> another kind, is a mistake in the program, and stops it.
  interface add_result
    module procedure add_number, add_count, add_word, add_truth
  end interface add_result

contains

  !> The row of a name, with the name's words in the place of its marks; `found%name` is empty where
  !> no row has the name.
  pure recursive subroutine find_result(name, found)
    character(len=*), intent(in) :: name     !! as it is written
    type(result_type), intent(out) :: found  !! its row
    logical :: fits
    integer :: row

    do row = 1, size(result_rows)
      found = result_rows(row)
      if (.not. may_fit(trim(found%name), name)) cycle
      call fit(trim(result_rows(row)%name), name, found, fits)
      if (fits) return
    end do
    found%name = ''
  end subroutine find_result

  !> Whether a result is one of heat, of a bearing or of one of its pads.
  pure logical function is_of_heat(name) result(is)
    character(len=*), intent(in) :: name !! as it is written
    is = any(heats%name == name(:verify(name, digits//'_ ', back=.true.)))
  end function is_of_heat

  !> Whether a name is a row's, with a word, a number or a key in the place of each of its marks.
  !> The row gets the words, and a unit that is its quantity's.
  pure recursive subroutine fit(pattern, name, row, fits)
    character(len=*), intent(in) :: pattern !! the row's name, or what is left of it
    character(len=*), intent(in) :: name    !! the same of the name
    type(result_type), intent(inout) :: row
    logical, intent(out) :: fits
    type(result_type) :: quantity
    character(len=name_length), allocatable :: words(:)
    character(len=:), allocatable :: mark, word
    integer :: first, last, behind, i

    first = index(pattern, '<')
    last = index(pattern, '>')
    fits = first == 0 .and. pattern == name
    if (first == 0 .or. len(name) < first) return
    if (name(:first - 1) /= pattern(:first - 1)) return
    mark = pattern(first:last)
    if (mark == any_number .or. mark == any_key) then ! the last of a name's marks
      behind = len(name) - (len(pattern) - last)
      if (behind < first) return
      fits = name(behind + 1:) == pattern(last + 1:)
      if (fits .and. mark == any_number) fits = verify(name(first:behind), digits) == 0
      if (fits .and. mark == any_key) fits = verify(name(first:behind), key_letters) == 0
      return
    end if
    words = marker_words(mark)
    do i = 1, size(words)
      word = trim(words(i))
      if (index(name(first:), word) /= 1) cycle
      call fit(pattern(last + 1:), name(first + len(word):), row, fits)
      if (.not. fits) cycle
      row%name = replaced(trim(row%name), mark, word)
      row%meaning = replaced(trim(row%meaning), mark, word)
      if (mark /= any_quantity) return
      call find_result(word, quantity)
      if (row%unit == own_unit) row%unit = quantity%unit
      if (row%unit == own_square) row%unit = bracketed(trim(quantity%unit))//'2'
      return
    end do
  end subroutine fit

  !> A unit as a factor: in brackets where it is a product.
  pure function bracketed(unit) result(factor)
    character(len=*), intent(in) :: unit
    character(len=:), allocatable :: factor

    factor = unit
    if (scan(unit, ' /') > 0) factor = '('//unit//')'
  end function bracketed

  !> The unit of a derivative; '1' where the units are the same.
  pure function quotient_unit(unit, by) result(quotient)
    character(len=*), intent(in) :: unit !! of what is derived
    character(len=*), intent(in) :: by   !! unit of what it is derived by
    character(len=:), allocatable :: quotient

    quotient = '1'
    if (unit == by) return
    if (by == '1') then
      quotient = unit
    else
      quotient = bracketed(unit)//'/'//bracketed(by)
    end if
  end function quotient_unit

  !> Unit of a name in the table; stops where there is none.
  pure function result_unit(name) result(unit)
    character(len=*), intent(in) :: name !! of a result
    character(len=:), allocatable :: unit
    type(result_type) :: found

    call find_known(name, found)
    unit = trim(found%unit)
  end function result_unit

  !> Meaning of a name in the table, with a phrase in the place of its braces; without one what
  !> stands between them. Stops where the table has no such name, or no braces for the phrase.
  pure function result_meaning(name, phrase) result(meaning)
    character(len=*), intent(in) :: name             !! of a result
    character(len=*), intent(in), optional :: phrase !! of those that the table's module has
    character(len=:), allocatable :: meaning
    type(result_type) :: found

    call find_known(name, found)
    if (present(phrase) .and. index(found%meaning, '{') == 0) then
      error stop 'no place for a phrase in the meaning of '//name
    end if
    meaning = completed(trim(found%meaning), phrase)
  end function result_meaning

  !> A meaning with a phrase in the place of its braces, or with what stands between them.
  pure function completed(meaning, phrase) result(whole)
    character(len=*), intent(in) :: meaning
    character(len=*), intent(in), optional :: phrase
    character(len=:), allocatable :: whole
    integer :: first, last

    whole = meaning
    first = index(meaning, '{')
    last = index(meaning, '}')
    if (first == 0) return
    if (present(phrase)) then
      whole = meaning(:first - 1)//phrase//meaning(last + 1:)
    else
      whole = meaning(:first - 1)//meaning(first + 1:last - 1)//meaning(last + 1:)
    end if
  end function completed

  !> The row of a name that must be there.
  pure subroutine find_known(name, found)
    character(len=*), intent(in) :: name
    type(result_type), intent(out) :: found

    call find_result(name, found)
    if (found%name == '') error stop 'no name of a result: '//name
  end subroutine find_known

  !> Whether a name is a result of a study.
  pure logical function is_of(name, study) result(is)
    character(len=*), intent(in) :: name !! of a result
    integer, intent(in) :: study         !! `bearing`, ...
    type(result_type) :: found

    call find_result(name, found)
    is = found%name /= ''
    if (is) is = iand(found%studies, study) /= 0
  end function is_of

  !> Whether a result is the largest or smallest of values at nodes.
  pure logical function is_nodal(name) result(is)
    character(len=*), intent(in) :: name !! of a result
    type(result_type) :: found

    call find_result(name, found)
    is = found%name /= '' .and. found%nodal
  end function is_nodal

  !> Names that `&accuracy` may ask for, in the order of the table.
  pure recursive function asked_names() result(names)
    character(len=name_length), allocatable :: names(:)
    names = names_of(result_rows%asked)
  end function asked_names

  !> Names of the results that show whether two answers are the same.
  pure function compared_names() result(names)
    character(len=name_length), allocatable :: names(:)
    names = names_of(result_rows%compared)
  end function compared_names

  !> All names of some rows.
  pure recursive function names_of(wanted) result(names)
    logical, intent(in) :: wanted(:) !! rows of the table
    character(len=name_length), allocatable :: names(:)
    integer :: row

    allocate (names(0))
    do row = 1, size(result_rows)
      if (.not. wanted(row)) cycle
      names = [character(len=name_length) :: names, names_of_row(result_rows(row)%name)]
    end do
  end function names_of

  !> The names that a row stands for, but for numbers and keys.
  pure recursive function names_of_row(pattern) result(names)
    character(len=*), intent(in) :: pattern !! the row's name
    character(len=name_length), allocatable :: names(:), words(:), before(:)
    integer :: i, j, k

    names = [character(len=name_length) :: pattern]
    if (index(pattern, '<') == 0) return
    do i = 1, size(markers)
      if (index(pattern, trim(markers(i))) == 0) cycle
      words = marker_words(markers(i))
      before = names
      deallocate (names)
      allocate (names(size(before)*size(words)))
      do j = 1, size(words)
        do k = 1, size(before)
          names(k + (j - 1)*size(before)) = replaced(trim(before(k)), trim(markers(i)), &
                                                     trim(words(j)))
        end do
      end do
    end do
  end function names_of_row

  !> What a mark stands for.
  pure recursive function marker_words(marker) result(words)
    character(len=*), intent(in) :: marker
    character(len=name_length), allocatable :: words(:)

    select case (marker)
    case ('<a>', '<b>')
      words = [character(len=name_length) :: 'x', 'y']
    case ('<state>')
      words = [character(len=name_length) :: 'open', 'stick', 'slip']
    case default
      words = asked_names()
    end select
  end function marker_words

  !> Whether a name begins and ends as a row's name does before and behind its marks: cheap to test.
  pure logical function may_fit(pattern, name) result(may)
    character(len=*), intent(in) :: pattern !! a row's name
    character(len=*), intent(in) :: name
    integer :: first, behind

    first = index(pattern, '<')
    if (first == 0) then
      may = pattern == name
      return
    end if
    behind = len(pattern) - index(pattern, '>', back=.true.)
    may = len(name) >= first - 1 + behind
    if (may) may = name(:first - 1) == pattern(:first - 1) .and. &
      name(len(name) - behind + 1:) == pattern(len(pattern) - behind + 1:)
  end function may_fit

  !> A text with a word in every place of a mark.
  pure function replaced(words, marker, word) result(new)
    character(len=*), intent(in) :: words, marker, word
    character(len=:), allocatable :: new
    integer :: at

    new = words
    at = index(new, marker)
    do while (at > 0)
      new = new(:at - 1)//word//new(at + len(marker):)
      at = index(new, marker)
    end do
  end function replaced

  !> The table as `gfb --results` prints it, for the manual; rows that belong together share a line.
  pure function results_text() result(words)
    character(len=:), allocatable :: words
    integer :: row, last

    words = '| name | unit | of | meaning |'//next//'| --- | --- | --- | --- |'
    row = 1
    do while (row <= size(result_rows))
      last = row
      do while (last < size(result_rows))
        if (.not. result_rows(last + 1)%joins) exit
        last = last + 1
      end do
      words = words//next//line_of(result_rows(row:last))
      row = last + 1
    end do
  end function results_text

  !> What the table says of a result, for the terminal.
  pure function result_words(name) result(words)
    character(len=*), intent(in) :: name !! of a result
    character(len=:), allocatable :: words
    type(result_type) :: found

    call find_known(name, found)
    words = 'result '//name//next//'  meaning  '//plain_text(completed(trim(found%meaning)))//next
    if (found%manual /= '') words = words//'           '//plain_text(trim(found%manual))//next
    if (found%unit /= '' .and. found%unit /= '1') then
      words = words//'  unit     '//trim(found%unit)//next
    end if
    words = words//'  of       '//plain_text(studies_text(found%studies))//next
    if (found%varies) words = words//'  differs from run to run'//next
  end function result_words

  !> The names of all rows, but for errors and orders of quantities of `&accuracy`.
  pure function row_names() result(names)
    character(len=name_length), allocatable :: names(:)
    names = names_of(index(result_rows%name, any_quantity) == 0)
  end function row_names

  !> The unit of a row as the table shows it; of a truth in a summary the words that stand there.
  elemental function shown_unit(row) result(unit)
    type(result_type), intent(in) :: row
    character(len=len(row%unit)) :: unit

    unit = row%unit
    if (row%kind == quantity_truth .and. row%studies /= sweep) unit = 'true/false'
  end function shown_unit

  !> Rows as one line of the table.
  pure function line_of(rows) result(words)
    type(result_type), intent(in) :: rows(:)
    character(len=:), allocatable :: words
    integer :: i

    words = '| '
    do i = 1, size(rows)
      if (i > 1) words = words//', '
      words = words//'`'//shown_names(rows(i))//'`'
    end do
    words = words//' | '//trim(shown_unit(rows(1)))
    if (any(shown_unit(rows) /= shown_unit(rows(1)))) then
      do i = 2, size(rows)
        words = words//', '//trim(shown_unit(rows(i)))
      end do
    end if
    words = words//' | '//studies_text(rows(1)%studies)//' | '
    if (rows(1)%manual == '') then
      words = words//completed(trim(rows(1)%meaning))
    else
      words = words//trim(rows(1)%manual)
    end if
    if (rows(1)%varies) words = words//'; differs from run to run'
    words = words//' |'
  end function line_of

  !> The names of a row, with quotes between them; quantities of `&accuracy` are not listed.
  pure function shown_names(row) result(words)
    type(result_type), intent(in) :: row
    character(len=:), allocatable :: words

    words = trim(row%name)
    if (index(words, any_quantity) == 0) words = join(names_of_row(row%name), '`, `')
  end function shown_names

  !> What has a result, in words.
  pure function studies_text(studies) result(words)
    integer, intent(in) :: studies !! their bits
    character(len=:), allocatable :: words
    integer :: i

    words = ''
    do i = 1, size(study_words)
      if (.not. btest(studies, i - 1)) cycle
      if (words /= '') words = words//', '
      words = words//trim(study_words(i))
    end do
  end function studies_text

  !> A real number.
  pure subroutine add_number(list, name, number, phrase)
    type(quantity_type), allocatable, intent(inout) :: list(:)
    character(len=*), intent(in) :: name             !! in the table
    real(wp), intent(in) :: number                   !! in the table's unit
    character(len=*), intent(in), optional :: phrase !! for the braces of its meaning
    call add_value(list, name, quantity_number, number, '', phrase)
  end subroutine add_number

  !> A whole number.
  pure subroutine add_count(list, name, number, phrase)
    type(quantity_type), allocatable, intent(inout) :: list(:)
    character(len=*), intent(in) :: name             !! in the table
    integer, intent(in) :: number
    character(len=*), intent(in), optional :: phrase !! for the braces of its meaning
    call add_value(list, name, quantity_count, real(number, wp), '', phrase)
  end subroutine add_count

  !> A word.
  pure subroutine add_word(list, name, word, phrase)
    type(quantity_type), allocatable, intent(inout) :: list(:)
    character(len=*), intent(in) :: name             !! in the table
    character(len=*), intent(in) :: word
    character(len=*), intent(in), optional :: phrase !! for the braces of its meaning
    call add_value(list, name, quantity_word, 0.0_wp, word, phrase)
  end subroutine add_word

  !> Yes or no.
  pure subroutine add_truth(list, name, truth, phrase)
    type(quantity_type), allocatable, intent(inout) :: list(:)
    character(len=*), intent(in) :: name             !! in the table
    logical, intent(in) :: truth
    character(len=*), intent(in), optional :: phrase !! for the braces of its meaning
    call add_value(list, name, quantity_truth, merge(1.0_wp, 0.0_wp, truth), '', phrase)
  end subroutine add_truth

  !> A value, with unit and meaning from the table; stops where that has values of another kind.
  pure subroutine add_value(list, name, kind, number, word, phrase)
    type(quantity_type), allocatable, intent(inout) :: list(:)
    character(len=*), intent(in) :: name, word
    integer, intent(in) :: kind !! `quantity_number`, ...
    real(wp), intent(in) :: number
    character(len=*), intent(in), optional :: phrase
    type(result_type) :: row
    type(quantity_type) :: value

    call find_known(name, row)
    if (row%kind /= kind) error stop 'a value of another kind than the table says: '//name
    value%name = name
    value%unit = trim(row%unit)
    value%meaning = result_meaning(name, phrase)
    value%kind = kind
    value%number = number
    value%word = word
    call add_quantity(list, value)
  end subroutine add_value
end module gfb_result_names
