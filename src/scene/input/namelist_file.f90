!> A namelist file as scanned: groups, keys and raw values with their lines, and which value of the
!> file fills which element of a key's list.
module gfb_namelist_file
  use gfb_kinds, only: long
  use gfb_complaints, only: complaints_type, shown
  use gfb_foreign_characters, only: foreign_type, foreign_words
  use gfb_moved_keys, only: home_of
  use gfb_namelist_values, only: repeat_count, value_string, value_number, value_word
  use gfb_text, only: text, lower_case
  implicit none (type, external)
  private
  public :: section_type, section_of, namelist_file_type, namelist_group_type, &
            namelist_entry_type, namelist_value_type, complain_about_foreign, find_elements, &
            is_entry_of, entry_at, moves_to, stands_in

  integer, parameter, public :: longest_list = 10000 !! values one key can have
  integer, parameter, public :: bad_index = -1 !! of an entry whose index was complained about

  !> Which elements of a list an entry gives: all from the first on, those from an index on, or
  !> those of a section such as `(1:3)` or `(5:1:-2)`.
  type :: section_type
    integer :: element = 0       !! index given with the key, 0 if none, or `bad_index`
    integer :: last = 0          !! of a section; 0: as far as its values go
    integer :: step = 1          !! from element to element
    logical :: ranges = .false.  !! a section was typed, not one index
  contains
    procedure, non_overridable :: place => section_place, size => section_size
    procedure, non_overridable :: holds => section_holds
    procedure, non_overridable :: shown => section_shown
  end type section_type

  !> A group as it stands in the file.
  type :: namelist_group_type
    integer :: first = 1, last = 0 !! its name in the text
    integer :: line = 0            !! of the file
  end type namelist_group_type

  !> A value as typed.
  type :: namelist_value_type
    integer :: kind = 0            !! `value_number`, `value_string`, ...
    integer :: first = 1, last = 0 !! in the text; of a string what stands between the quotes
    integer :: repeats = 1
    integer :: line = 0            !! of the file
    logical :: wrong = .false.     !! it was complained about
  end type namelist_value_type

  !> A key with its values.
  type :: namelist_entry_type
    integer :: group = 0           !! number of its group in the file
    integer :: first = 1, last = 0 !! the key in the text
    integer :: equals = 0          !! its equals sign in the text
    type(section_type) :: section  !! which elements of a list it gives
    integer :: line = 0            !! of the file
    integer :: first_value = 1, last_value = 0
    logical :: wrong = .false.     !! it was complained about, and so all its values
  end type namelist_entry_type

  !> A scanned file.
  type :: namelist_file_type
    character(len=:), allocatable :: words               !! the whole text, folded to ASCII
    type(namelist_group_type), allocatable :: groups(:)
    type(namelist_entry_type), allocatable :: entries(:)
    type(namelist_value_type), allocatable :: values(:)
    type(namelist_group_type), allocatable :: strays(:)  !! words outside groups, one a place
  contains
    procedure, non_overridable :: group_name, key_name, value_text, value_shown, values_shown
  end type namelist_file_type

contains

  !> An index, or a section with its ends and its step, as typed between parentheses.
  pure function section_of(words) result(section)
    character(len=*), intent(in) :: words !! without the parentheses
    type(section_type) :: section !! with `bad_index` where the words are neither
    character(len=:), allocatable :: step
    integer :: first, second

    first = index(words, ':')
    if (first == 0) then
      section%element = number_of(words)
      if (section%element < 1) section%element = bad_index
      return
    end if
    section%ranges = .true.
    section%element = 1
    second = first + index(words(first + 1:), ':')
    if (second == first) second = len(words) + 1
    if (bare(words(:first - 1)) /= '') section%element = number_of(words(:first - 1))
    if (bare(words(first + 1:second - 1)) /= '') then
      section%last = number_of(words(first + 1:second - 1))
      if (section%last < 1) section%element = bad_index
    end if
    if (second <= len(words)) then
      step = bare(words(second + 1:))
      section%step = number_of(step(1 + scan(step(:min(1, len(step))), '+-'):))
      if (index(step, '-') == 1) section%step = -section%step
    end if
    if (section%element < 1 .or. section%step == 0) section = section_type(bad_index)
  end function section_of

  !> Element of the list that takes a value.
  elemental function section_place(self, value) result(element)
    class(section_type), intent(in) :: self !! the elements
    integer(long), intent(in) :: value !! its number among those of the entry
    integer(long) :: element
    integer(long), parameter :: far = 2_long**31 !! beyond every list, and no product overflows
    element = max(1, self%element) + (min(value, far) - 1)*self%step
  end function section_place

  !> How many elements there are where both ends are known, else none.
  pure function section_size(self) result(elements)
    class(section_type), intent(in) :: self !! the elements
    integer(long) :: elements

    elements = 0
    if (self%last > 0) elements = max(0_long, (int(self%last, long) - self%element + self%step)/ &
                                            self%step)
  end function section_size

  !> Whether there are so many elements.
  pure logical function section_holds(self, values) result(holds)
    class(section_type), intent(in) :: self !! the elements
    integer(long), intent(in) :: values !! of the entry
    holds = self%last == 0 .or. self%size() == values
  end function section_holds

  !> The index or section behind a key; nothing where none was typed.
  pure function section_shown(self) result(words)
    class(section_type), intent(in) :: self !! the elements
    character(len=:), allocatable :: words

    words = ''
    if (self%element < 1) return
    words = text(self%element)
    if (self%ranges) words = words//':'
    if (self%last > 0) words = words//text(self%last)
    if (self%step /= 1) words = words//':'//text(self%step)
    words = '('//words//')'
  end function section_shown

  !> A number with blanks about it; 0 where it is none from 1 on, `huge` where it is too large.
  pure integer function number_of(words) result(number)
    character(len=*), intent(in) :: words
    number = max(0, repeat_count(bare(words)))
  end function number_of

  !> Words without the blanks before and behind them.
  pure function bare(words)
    character(len=*), intent(in) :: words
    character(len=:), allocatable :: bare
    character(len=*), parameter :: blanks = ' '//achar(9)//achar(10)//achar(12)//achar(13)
    integer :: first

    bare = ''
    first = verify(words, blanks)
    if (first > 0) bare = words(first:verify(words, blanks, back=.true.))
  end function bare

  !> Name of a group in lower case.
  pure function group_name(self, group) result(name)
    class(namelist_file_type), intent(in) :: self !! the scanned file
    integer, intent(in) :: group !! of the file
    character(len=:), allocatable :: name
    name = lower_case(self%words(self%groups(group)%first:self%groups(group)%last))
  end function group_name

  !> Key of an entry in lower case.
  pure function key_name(self, entry) result(name)
    class(namelist_file_type), intent(in) :: self !! the scanned file
    integer, intent(in) :: entry !! number of the key in the file
    character(len=:), allocatable :: name
    name = lower_case(self%words(self%entries(entry)%first:self%entries(entry)%last))
  end function key_name

  !> A value; of a string what stands between the quotes, doubled ones made single.
  pure function value_text(self, value) result(words)
    class(namelist_file_type), intent(in) :: self !! the scanned file
    integer, intent(in) :: value !! number of the value in the file
    character(len=:), allocatable :: words
    character(len=1) :: quote
    integer :: i, n

    associate (item => self%values(value))
      words = self%words(item%first:item%last)
      if (item%kind /= value_string) return
      quote = self%words(item%first - 1:item%first - 1)
      n = 0
      i = 1
      do while (i <= len(words))
        n = n + 1
        words(n:n) = words(i:i)
        if (words(i:i) == quote) i = i + 1
        i = i + 1
      end do
      words = words(1:n)
    end associate
  end function value_text

  !> A value as typed, fit for a complaint.
  pure function value_shown(self, value) result(words)
    class(namelist_file_type), intent(in) :: self !! the scanned file
    integer, intent(in) :: value !! number of the value in the file
    character(len=:), allocatable :: words
    words = values_shown(self, value, value)
  end function value_shown

  !> Neighbouring values as typed, fit for a complaint.
  pure function values_shown(self, first_value, last_value) result(words)
    class(namelist_file_type), intent(in) :: self !! the scanned file
    integer, intent(in) :: first_value, last_value !! their numbers in the file
    character(len=:), allocatable :: words
    integer :: first, last

    words = ''
    if (last_value < first_value) return
    first = self%values(first_value)%first
    last = self%values(last_value)%last
    if (self%values(first_value)%kind == value_string) first = first - 1
    if (self%values(last_value)%kind == value_string) then
      if (last < len(self%words)) then
        if (scan(self%words(last + 1:last + 1), '''"') == 1) last = last + 1
      end if
    end if
    words = shown(self%words(first:last))
  end function values_shown

  !> Complains about characters outside ASCII: once a key with its values, elsewhere once a line.
  pure subroutine complain_about_foreign(file, foreign, complaints)
    type(namelist_file_type), intent(in) :: file !! the case file, scanned
    type(foreign_type), intent(in) :: foreign(:) !! all of them
    type(complaints_type), intent(inout) :: complaints !! the mistakes found so far
    character(len=:), allocatable :: words
    integer :: i, n, entry

    i = 1
    do while (i <= size(foreign))
      entry = entry_at(file, foreign(i)%place)
      n = 1
      do while (i + n <= size(foreign))
        if (entry_at(file, foreign(i + n)%place) /= entry) exit
        if (entry == 0 .and. foreign(i + n)%line /= foreign(i)%line) exit
        n = n + 1
      end do
      words = 'a character outside ASCII, '//foreign_words(foreign(i)%code)
      if (n > 1) words = words//', and '//text(n - 1)//' more'
      words = words//': such belong into strings and comments only'
      if (entry > 0) then
        associate (item => file%entries(entry))
          words = '&'//shown(file%group_name(item%group))//': '//shown(file%key_name(entry))// &
                  ' = '//file%values_shown(item%first_value, item%last_value)//': '//words
        end associate
      end if
      call complaints%add(foreign(i)%line, words)
      i = i + n
    end do
  end subroutine complain_about_foreign

  !> The entry that a place of the text belongs to, from its key to behind its values; 0 where none.
  pure integer function entry_at(file, place) result(entry)
    type(namelist_file_type), intent(in) :: file
    integer, intent(in) :: place
    integer :: last, low, middle

    low = 0
    entry = size(file%entries)
    do while (low < entry) ! the last one that does not begin behind the place
      middle = (low + entry + 1)/2
      if (file%entries(middle)%first <= place) then
        low = middle
      else
        entry = middle - 1
      end if
    end do
    if (entry == 0) return
    associate (item => file%entries(entry))
      last = item%equals
      if (item%last_value >= item%first_value) then
        last = file%values(item%last_value)%last
        if (file%values(item%last_value)%kind == value_string) last = last + 1
      end if
      if (place > last + 1) entry = 0
    end associate
  end function entry_at

  !> Finds the values of a key, in entries with and without index.
  !>
  !> There are no elements where the key is absent, and where a mistake was complained about.
  subroutine find_elements(file, group, key, most, elements, given, complaints, wrong)
    type(namelist_file_type), intent(in) :: file !! the case file, scanned
    character(len=*), intent(in) :: group, key !! names in the case file
    integer, intent(in) :: most                      !! values at most; 0: one, without index
    integer, allocatable, intent(out) :: elements(:) !! number of each value in the file
    logical, intent(out), optional :: given          !! the key stands in the file
    type(complaints_type), intent(inout), optional :: complaints !! the mistakes found so far
    logical, intent(out), optional :: wrong !! the scanner has complained about it
    type(complaints_type) :: found
    integer, allocatable :: filled(:), owner(:)
    integer :: entry, mistakes, last
    logical :: is_wrong

    if (.not. stands_in(file, group, key)) then
      allocate (elements(0))
      if (present(given)) given = .false.
      if (present(wrong)) wrong = .false.
      return
    end if
    allocate (filled(max(1, most)), owner(max(1, most)), source=0)
    if (present(complaints)) found = complaints
    mistakes = found%count
    is_wrong = .false.
    do entry = 1, size(file%entries)
      if (.not. is_entry_of(file, entry, group, key)) cycle
      associate (item => file%entries(entry))
        is_wrong = is_wrong .or. item%wrong .or. &
                   any(file%values(item%first_value:item%last_value)%wrong)
      end associate
      call fill(file, entry, most, filled, owner, found)
      if (file%entries(entry)%wrong) mistakes = -1
    end do
    last = findloc(filled > 0, .true., dim=1, back=.true.)
    if (any(filled(:last) == 0) .and. found%count == mistakes) then
      call found%add(file%entries(owner(last))%line, '&'//group//': '//key//'('// &
                     text(findloc(filled, 0, dim=1))//') is not given, but '//key//'('// &
                     text(last)//') is')
    end if
    if (found%count /= mistakes) last = 0
    elements = filled(:last)
    if (present(given)) given = .true.
    if (present(wrong)) wrong = is_wrong
    if (present(complaints)) complaints = found
  end subroutine find_elements

  !> Whether an entry of the file belongs to a key.
  pure logical function is_entry_of(file, entry, group, key) result(belongs)
    type(namelist_file_type), intent(in) :: file !! the scanned file
    integer, intent(in) :: entry !! number of the key in the file
    character(len=*), intent(in) :: group, key !! names in the case file

    belongs = .false.
    associate (item => file%entries(entry))
      if (item%last - item%first + 1 /= len(key)) return
      if (file%key_name(entry) /= key) return
      belongs = home_of(file%group_name(item%group), key) == home_of(group, key)
    end associate
  end function is_entry_of

  !> The group that has the key of an entry now; empty where it stands there.
  pure function moves_to(file, entry) result(home)
    type(namelist_file_type), intent(in) :: file !! the scanned file
    integer, intent(in) :: entry !! number of the key in the file
    character(len=:), allocatable :: home
    character(len=:), allocatable :: group

    group = file%group_name(file%entries(entry)%group)
    home = home_of(group, file%key_name(entry))
    if (home == group) home = ''
  end function moves_to

  !> Whether a key stands in the file.
  pure logical function stands_in(file, group, key) result(stands)
    type(namelist_file_type), intent(in) :: file !! the scanned file
    character(len=*), intent(in) :: group, key !! names in the case file
    integer :: entry

    stands = .true.
    do entry = 1, size(file%entries)
      if (is_entry_of(file, entry, group, key)) return
    end do
    stands = .false.
  end function stands_in

  !> Fills the elements that one entry gives.
  subroutine fill(file, entry, most, filled, owner, complaints)
    type(namelist_file_type), intent(in) :: file
    integer, intent(in) :: entry, most
    integer, intent(inout) :: filled(:)  !! value of each element, 0 where none yet
    integer, intent(inout) :: owner(:)   !! entry that gave it
    type(complaints_type), intent(inout) :: complaints
    integer(long) :: n, first, last
    character(len=:), allocatable :: most_words
    integer :: value, repeat_number, element

    associate (item => file%entries(entry), section => file%entries(entry)%section)
      n = 0
      do value = item%first_value, item%last_value
        n = n + file%values(value)%repeats
      end do
      if (item%wrong .or. n == 0) return
      first = section%place(1_long)
      last = section%place(n)
      if (most == 0 .and. section%element > 0) then
        call complain('is a single value and takes no index')
      else if (.not. section%holds(n)) then
        call complain('the section has '//text(section%size())//' place(s) for '//text(n)// &
                      ' value(s)')
      else if (max(first, min(first, last)) > size(filled) .or. min(first, last) < 1) then
        call complain('the index must lie between 1 and '//text(most))
      else if (max(first, last) > size(filled)) then
        most_words = 'one value'
        if (size(filled) > 1) most_words = 'at most '//text(size(filled))//' values'
        call complain('takes '//most_words//', not '//text(max(first, last))// &
                      missing_equals(file, item%first_value + 1, item%last_value)// &
                      decimal_comma(file, item%first_value, item%last_value))
      else
        n = 0
        do value = item%first_value, item%last_value
          do repeat_number = 1, file%values(value)%repeats
            n = n + 1
            element = int(section%place(n))
            if (filled(element) > 0) then
              ! A group that stands there twice has been complained about.
              associate (earlier => file%entries(owner(element)))
                if (earlier%group == item%group .or. &
                    file%group_name(earlier%group) /= file%group_name(item%group)) then
                  call complain_twice(earlier)
                end if
              end associate
              return
            end if
            filled(element) = value
            owner(element) = entry
          end do
        end do
      end if
    end associate

  contains

    !> Complains about this entry.
    subroutine complain(rule)
      character(len=*), intent(in) :: rule
      associate (item => file%entries(entry))
        call complaints%add(item%line, '&'//file%group_name(item%group)//': '// &
                            file%key_name(entry)//item%section%shown()//' = '// &
                            file%values_shown(item%first_value, item%last_value)//': '//rule)
      end associate
    end subroutine complain

    !> Complains that an earlier entry gave this element, be it in a group that had the key before.
    subroutine complain_twice(earlier)
      type(namelist_entry_type), intent(in) :: earlier
      character(len=:), allocatable :: group

      group = ''
      if (earlier%group /= file%entries(entry)%group) then
        group = ' of &'//file%group_name(earlier%group)
      end if
      call complain('the key is given twice, first in line '//text(earlier%line)//group)
    end subroutine complain_twice
  end subroutine fill

  !> A hint where two values look like one number with a comma: digits, comma, digits.
  pure function decimal_comma(file, first, last) result(words)
    type(namelist_file_type), intent(in) :: file
    integer, intent(in) :: first, last
    character(len=:), allocatable :: words
    integer :: value

    words = ''
    do value = first, last - 1
      associate (whole => file%values(value), part => file%values(value + 1))
        if (whole%kind /= value_number .or. part%kind /= value_number) cycle
        if (part%first /= whole%last + 2) cycle ! a blank beside the comma, or a repeat count
        if (file%words(whole%last + 1:whole%last + 1) /= ',') cycle
        if (verify(file%value_text(value), '+-0123456789') > 0) cycle
        if (verify(file%words(part%first:part%first), '0123456789') > 0) cycle
        words = '; a number has a decimal point, no comma: '//file%value_shown(value)//'.'// &
                file%value_shown(value + 1)
      end associate
      return
    end do
  end function decimal_comma

  !> A hint where a word among values looks like a unit, or like a key.
  pure function missing_equals(file, first, last) result(words)
    type(namelist_file_type), intent(in) :: file
    integer, intent(in) :: first, last
    character(len=:), allocatable :: words
    character(len=*), parameter :: units(*) = [character(len=4) :: 'm', 'mm', 'cm', 'um', 'nm', &
                                               'in', 'Pa', 'kPa', 'MPa', 'GPa', 'bar', 'N', &
                                               'kN', 'rpm', 'krpm', 'rad', 'deg', 's', 'ms', &
                                               'kg', 'K', 'Hz']
    integer :: value

    words = ''
    do value = first, last
      if (file%values(value)%kind /= value_word) cycle
      if (any(file%value_text(value) == units)) then
        words = "; write the number alone, '"//file%value_shown(value)//"' is no part of it"
        return
      end if
      if (verify(file%value_text(value), 'abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_') &
          > 0) cycle
      words = "; is '=' missing after '"//file%value_shown(value)//"'?"
      return
    end do
  end function missing_equals
end module gfb_namelist_file
