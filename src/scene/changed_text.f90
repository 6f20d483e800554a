!> Puts another value of a key into a case file's text.
module gfb_changed_text
  use gfb_kinds, only: wp
  use gfb_complaints, only: complaints_type
  use gfb_namelist_file, only: find_elements, is_entry_of, longest_list, namelist_file_type
  use gfb_namelist_scanner, only: scan_namelist
  use gfb_text, only: text, exact_text
  implicit none (type, external)
  private
  public :: changed_text, changed_list_text

contains

  !> A case file's text as if a real key of it had another value: the value, or values, are replaced
  !> where the key stands in the file, else the key is put behind its group's name, else the group
  !> behind the last line. Where parts of a list stand apart, the first becomes the value.
  pure function changed_text(words, group, key, value) result(changed)
    character(len=*), intent(in) :: words !! the whole file
    character(len=*), intent(in) :: group, key !! names in the case file, in lower case
    real(wp), intent(in) :: value !! [its unit] of the key
    character(len=:), allocatable :: changed
    type(namelist_file_type) :: file
    type(complaints_type) :: complaints ! of who reads the file
    integer :: copied, i, k
    logical :: found

    call scan_namelist(words, file, complaints)
    changed = ''
    copied = 0
    found = .false.
    do i = 1, size(file%entries)
      associate (entry => file%entries(i))
        if (.not. is_entry_of(file, i, group, key)) cycle
        if (entry%last_value < entry%first_value) cycle
        if (found) then
          changed = changed//file%words(copied + 1:entry%first - 1)
          k = entry%first
        else
          changed = before_values(file, i)//exact_text(value)
          k = file%values(entry%first_value)%first
        end if
        copied = file%values(entry%last_value)%last
        do k = k, copied
          if (file%words(k:k) == new_line('a')) changed = changed//new_line('a')
        end do
        if (found) call drop_comma(file%words, copied, changed)
        found = .true.
      end associate
    end do
    if (found) then
      changed = changed//file%words(copied + 1:)
    else
      changed = text_with(file, group, key//' = '//exact_text(value))
    end if
  end function changed_text

  !> Copies what stands before a comma, and leaves the comma out, where nothing else comes first.
  pure subroutine drop_comma(words, copied, changed)
    character(len=*), intent(in) :: words
    integer, intent(inout) :: copied !! characters of the words, or left out
    character(len=:), allocatable, intent(inout) :: changed
    integer :: blanks

    blanks = verify(words(copied + 1:)//'/', ' '//achar(9)//achar(13)//new_line('a')) - 1
    if (index(words(copied + 1 + blanks:), ',') /= 1) return
    changed = changed//words(copied + 1:copied + blanks)
    copied = copied + blanks + 1
  end subroutine drop_comma

  !> A case file's text as if one value of a list had another value. The list keeps its other
  !> values; one that stands for all is repeated, and a list that is absent is 0 but for the one
  !> value.
  function changed_list_text(words, group, key, element, length, value) result(changed)
    character(len=*), intent(in) :: words !! the whole file
    character(len=*), intent(in) :: group, key !! names in the case file, in lower case
    integer, intent(in) :: element !! of the list
    integer, intent(in) :: length !! of the list where one value may stand for all, 0 where none may
    real(wp), intent(in) :: value !! [its unit] of the element
    character(len=:), allocatable :: changed
    type(namelist_file_type) :: file
    type(complaints_type) :: complaints ! of who reads the file
    character(len=:), allocatable :: typed
    integer, allocatable :: owner(:)
    integer :: i

    call scan_namelist(words, file, complaints)
    call find_elements(file, group, key, longest_list, owner)
    if (size(owner) == 0) then
      changed = text_with(file, group, key//' = '//repeated(element - 1, '0.0')// &
                          exact_text(value)//following(length - element, '0.0'))
      return
    end if
    if (size(owner) == 1) then ! it stands for all, be it with an index
      i = findloc(file%entries%first_value, owner(1), 1, back=.true.)
      changed = before_values(file, i)
      owner = spread(owner(1), 1, max(length, 1))
    else
      changed = before(file, owner(element))
    end if
    i = owner(element)
    typed = file%value_text(i)
    associate (item => file%values(i))
      changed = changed//repeated(count(owner(:element - 1) == i), typed)//exact_text(value)// &
                following(count(owner(element + 1:) == i), typed)//file%words(item%last + 1:)
    end associate
  end function changed_list_text

  !> The text before a value and its repeat count.
  pure function before(file, value) result(words)
    type(namelist_file_type), intent(in) :: file !! the text, scanned
    integer, intent(in) :: value !! its number
    character(len=:), allocatable :: words

    associate (item => file%values(value))
      words = file%words(:item%first - 1)
      if (words(item%first - 1:) /= '*') return
      words = words(:verify(words(:item%first - 2), '0123456789', back=.true.))
    end associate
  end function before

  !> The text before the values of an entry, whose key has no index in it.
  pure function before_values(file, entry) result(words)
    type(namelist_file_type), intent(in) :: file !! the text, scanned
    integer, intent(in) :: entry !! with a value
    character(len=:), allocatable :: words

    associate (item => file%entries(entry))
      words = before(file, item%first_value)
      if (item%section%element /= 0) words = words(:item%last)//' '//words(item%equals:)
    end associate
  end function before_values

  !> So many equal values before another one.
  pure function repeated(times, value) result(words)
    integer, intent(in) :: times !! 0 or less: none
    character(len=*), intent(in) :: value
    character(len=:), allocatable :: words

    words = ''
    if (times > 0) words = text(times)//'*'//value//', '
  end function repeated

  !> So many equal values behind another one.
  pure function following(times, value) result(words)
    integer, intent(in) :: times !! 0 or less: none
    character(len=*), intent(in) :: value
    character(len=:), allocatable :: words

    words = ''
    if (times > 0) words = ', '//text(times)//'*'//value
  end function following

  !> A case file's text with a key more: behind its group's name, else in a group behind the last
  !> line.
  pure function text_with(file, group, key) result(changed)
    type(namelist_file_type), intent(in) :: file !! the text, scanned
    character(len=*), intent(in) :: group
    character(len=*), intent(in) :: key !! with its values
    character(len=:), allocatable :: changed
    integer :: i, last

    do i = 1, size(file%groups)
      if (file%group_name(i) /= group) cycle
      last = file%groups(i)%last
      changed = file%words(:last)//' '//key//file%words(last + 1:)
      return
    end do
    changed = file%words//new_line('a')//'&'//group//' '//key//' /'
  end function text_with
end module gfb_changed_text
