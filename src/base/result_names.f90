!> What the table of result names says of a name, and lists made from it.
module gfb_result_names
  use gfb_result_table, only: result_type, result_rows, study_words, own_unit, own_square, &
                              name_length
  use gfb_text, only: join, plain_text
  implicit none (type, external)
  private
  public :: find_result, result_unit, result_meaning, is_of, is_nodal, asked_names, &
            compared_names, results_text, result_words, row_names, quotient_unit

  character(len=*), parameter :: any_number = '<n>', any_key = '<key>', &
                                 any_quantity = '<quantity>'
  !> What stands for one of several words; the last one changes first.
  character(len=*), parameter :: markers(*) = [character(len=10) :: '<b>', '<a>', '<state>', &
                                               any_quantity]
  character(len=*), parameter :: next = new_line('a')

contains

  !> The row of a name, with the name's words in the place of its marks; `found%name` is empty where
  !> no row has the name.
  pure recursive subroutine find_result(name, found)
    character(len=*), intent(in) :: name     !! as it is written
    type(result_type), intent(out) :: found  !! its row
    character(len=name_length), allocatable :: names(:)
    integer :: row, i

    do row = 1, size(result_rows)
      if (.not. may_fit(trim(result_rows(row)%name), name)) cycle
      names = names_of_row(result_rows(row)%name)
      do i = 1, size(names)
        if (.not. fits(trim(names(i)), name)) cycle
        found = result_rows(row)
        found%name = names(i)
        found%meaning = filled(trim(found%meaning), result_rows(row)%name, i)
        if (index(result_rows(row)%name, any_quantity) > 0) then
          if (found%unit == own_unit) found%unit = unit_of_asked(i)
          if (found%unit == own_square) found%unit = bracketed(unit_of_asked(i))//'2'
        end if
        return
      end do
    end do
    found%name = ''
  end subroutine find_result

  !> Unit of a quantity that `&accuracy` may ask for.
  pure recursive function unit_of_asked(number) result(unit)
    integer, intent(in) :: number !! of its name among them
    character(len=:), allocatable :: unit
    character(len=name_length), allocatable :: names(:)
    type(result_type) :: found

    names = asked_names()
    call find_result(trim(names(number)), found)
    unit = trim(found%unit)
  end function unit_of_asked

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
  pure function is_of(name, study) result(is)
    character(len=*), intent(in) :: name !! of a result
    integer, intent(in) :: study         !! `bearing`, ...
    logical :: is
    type(result_type) :: found

    call find_result(name, found)
    is = found%name /= ''
    if (is) is = iand(found%studies, study) /= 0
  end function is_of

  !> Whether a result is the largest or smallest of values at nodes.
  pure function is_nodal(name) result(is)
    character(len=*), intent(in) :: name !! of a result
    logical :: is
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
    character(len=name_length), allocatable :: names(:)
    character(len=name_length), allocatable :: words(:), before(:)
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

  !> A text with the words that one of a row's names has in the place of its marks.
  pure recursive function filled(words, pattern, number) result(new)
    character(len=*), intent(in) :: words
    character(len=*), intent(in) :: pattern !! the row's name
    integer, intent(in) :: number !! of the name among those of the row, from 1
    character(len=:), allocatable :: new
    character(len=name_length), allocatable :: choices(:)
    integer :: i, left

    new = words
    if (index(pattern, '<') == 0) return
    left = number - 1
    do i = 1, size(markers)
      if (index(pattern, trim(markers(i))) == 0) cycle
      choices = marker_words(markers(i))
      new = replaced(new, trim(markers(i)), trim(choices(1 + modulo(left, size(choices)))))
      left = left/size(choices)
    end do
  end function filled

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

  !> Whether a name begins and ends as a row's name does before and behind its marks: told soon.
  pure function may_fit(pattern, name) result(may)
    character(len=*), intent(in) :: pattern !! a row's name
    character(len=*), intent(in) :: name
    logical :: may
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

  !> Whether a name is a row's, which may have a number or a key in the place of a mark.
  pure function fits(pattern, name) result(fit)
    character(len=*), intent(in) :: pattern !! a row's name
    character(len=*), intent(in) :: name
    logical :: fit

    if (index(pattern, any_number) > 0) then
      fit = fits_mark(pattern, any_number, '0123456789', name)
    else if (index(pattern, any_key) > 0) then
      fit = fits_mark(pattern, any_key, '0123456789_abcdefghijklmnopqrstuvwxyz', name)
    else
      fit = pattern == name
    end if
  end function fits

  !> Whether a name is a row's with some characters in the place of a mark.
  pure function fits_mark(pattern, mark, characters, name) result(fit)
    character(len=*), intent(in) :: pattern !! a row's name
    character(len=*), intent(in) :: mark, characters, name
    logical :: fit
    integer :: at, behind

    at = index(pattern, mark)
    behind = len(pattern) - at - len(mark) + 1
    fit = len(name) - behind >= at
    if (.not. fit) return
    fit = name(:at - 1) == pattern(:at - 1) .and. &
      name(len(name) - behind + 1:) == pattern(len(pattern) - behind + 1:) .and. &
      verify(name(at:len(name) - behind), characters) == 0
  end function fits_mark

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
    words = words//' | '//trim(rows(1)%unit)
    if (any(rows%unit /= rows(1)%unit)) then
      do i = 2, size(rows)
        words = words//', '//trim(rows(i)%unit)
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
end module gfb_result_names
