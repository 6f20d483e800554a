!> Which elements of a list an entry of a namelist file gives: all from the first on, those from an
!> index on, or those of a section such as `(1:3)` or `(5:1:-2)`.
module gfb_namelist_sections
  use gfb_kinds, only: long
  use gfb_text, only: text
  implicit none (type, external)
  private
  public :: section_type, section_of

  integer, parameter, public :: bad_index = -1 !! of an entry whose index was complained about

  !> The elements.
  type :: section_type
    integer :: element = 0       !! index given with the key, 0 if none, or `bad_index`
    integer :: last = 0          !! of a section; 0: as far as its values go
    integer :: step = 1          !! from element to element
    logical :: ranges = .false.  !! a section was typed, not one index
  contains
    procedure :: place
    procedure :: size => section_size
    procedure :: holds
    procedure :: shown
  end type section_type

contains

  !> An index, or a section with its ends and its step, as typed between parentheses.
  pure function section_of(words) result(section)
    character(len=*), intent(in) :: words !! without the parentheses
    type(section_type) :: section !! with `bad_index` where the words are neither
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
    if (second <= len(words)) section%step = signed_number_of(words(second + 1:))
    if (section%element < 1 .or. section%step == 0) section = section_type(bad_index)
  end function section_of

  !> Element of the list that takes a value.
  elemental function place(self, value) result(element)
    class(section_type), intent(in) :: self !! the elements
    integer(long), intent(in) :: value !! its number among those of the entry
    integer(long) :: element
    integer(long), parameter :: far = 2_long**31 !! beyond every list, and no product overflows
    element = max(1, self%element) + (min(value, far) - 1)*self%step
  end function place

  !> How many elements there are where both ends are known, else none.
  pure function section_size(self) result(elements)
    class(section_type), intent(in) :: self !! the elements
    integer(long) :: elements

    elements = 0
    if (self%last > 0) elements = max(0_long, (int(self%last, long) - self%element + self%step)/ &
                                            self%step)
  end function section_size

  !> Whether there are so many elements.
  pure function holds(self, values)
    class(section_type), intent(in) :: self !! the elements
    integer(long), intent(in) :: values !! of the entry
    logical :: holds
    holds = self%last == 0 .or. self%size() == values
  end function holds

  !> The index or section behind a key; nothing where none was typed.
  pure function shown(self) result(words)
    class(section_type), intent(in) :: self !! the elements
    character(len=:), allocatable :: words

    words = ''
    if (self%element < 1) return
    words = text(self%element)
    if (self%ranges) words = words//':'
    if (self%last > 0) words = words//text(self%last)
    if (self%step /= 1) words = words//':'//text(self%step)
    words = '('//words//')'
  end function shown

  !> A number with blanks about it; 0 where it is none from 1 on, `huge` where it is too large.
  pure function number_of(words) result(number)
    character(len=*), intent(in) :: words
    integer :: number
    integer, parameter :: most = 9 !! digits that an integer holds
    character(len=:), allocatable :: plain

    number = 0
    plain = bare(words)
    if (plain == '' .or. verify(plain, '0123456789') > 0) return
    if (len(plain) > most) then
      number = huge(number)
    else
      read (plain, *) number
    end if
  end function number_of

  !> A number that may have a sign; 0 where it is none.
  pure function signed_number_of(words) result(number)
    character(len=*), intent(in) :: words
    integer :: number
    character(len=:), allocatable :: plain
    integer :: sign

    plain = bare(words)
    sign = 1
    if (index(plain, '-') == 1) sign = -1
    if (scan(plain, '+-') == 1) plain = plain(2:)
    number = sign*number_of(plain)
  end function signed_number_of

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
end module gfb_namelist_sections
