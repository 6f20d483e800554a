!> The values of one key: which value of the file fills which element of a list.
module gfb_key_elements
  use gfb_kinds, only: long
  use gfb_complaints, only: complaints_type
  use gfb_namelist_file, only: namelist_file_type
  use gfb_namelist_values, only: value_number, value_word
  use gfb_text, only: text
  implicit none (type, external)
  private
  public :: find_elements, is_entry_of

contains

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
  pure function is_entry_of(file, entry, group, key) result(belongs)
    type(namelist_file_type), intent(in) :: file !! the scanned file
    integer, intent(in) :: entry !! number of the key in the file
    character(len=*), intent(in) :: group, key !! names in the case file
    logical :: belongs

    belongs = .false.
    associate (item => file%entries(entry))
      if (item%last - item%first + 1 /= len(key)) return
      if (file%key_name(entry) /= key) return
      belongs = file%group_name(item%group) == group
    end associate
  end function is_entry_of

  !> Whether a key stands in the file.
  pure function stands_in(file, group, key) result(stands)
    type(namelist_file_type), intent(in) :: file
    character(len=*), intent(in) :: group, key
    logical :: stands
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
    integer, intent(in) :: entry
    integer, intent(in) :: most
    integer, intent(inout) :: filled(:)  !! value of each element, 0 where none yet
    integer, intent(inout) :: owner(:)   !! entry that gave it
    type(complaints_type), intent(inout) :: complaints
    integer(long) :: n, first, last
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
        call complain('takes '//most_words(size(filled))//', not '//text(max(first, last))// &
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
              if (file%entries(owner(element))%group == item%group) call complain_twice(element)
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

    !> Complains that an earlier entry gave this element.
    subroutine complain_twice(element)
      integer, intent(in) :: element
      call complain('the key is given twice, first in line '// &
                    text(file%entries(owner(element))%line))
    end subroutine complain_twice
  end subroutine fill

  !> How many values a key takes.
  pure function most_words(most) result(words)
    integer, intent(in) :: most
    character(len=:), allocatable :: words

    words = 'one value'
    if (most > 1) words = 'at most '//text(most)//' values'
  end function most_words

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
end module gfb_key_elements
