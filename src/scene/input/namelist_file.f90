!> A namelist file as scanned: groups, keys and raw values with their lines.
module gfb_namelist_file
  use gfb_complaints, only: complaints_type, shown
  use gfb_foreign_characters, only: foreign_type, foreign_words
  use gfb_namelist_sections, only: section_type
  use gfb_namelist_values, only: value_string
  use gfb_text, only: lower_case, text
  implicit none (type, external)
  private
  public :: namelist_file_type, namelist_group_type, namelist_entry_type, namelist_value_type
  public :: complain_about_foreign

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
    procedure :: group_name
    procedure :: key_name
    procedure :: value_text
    procedure :: value_shown
    procedure :: values_shown
  end type namelist_file_type

contains

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
  pure function entry_at(file, place) result(entry)
    type(namelist_file_type), intent(in) :: file
    integer, intent(in) :: place
    integer :: entry
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
end module gfb_namelist_file
