!> The text of a case file with another value of a key, every line where it was.
module gfb_changed_text
  use gfb_kinds, only: wp
  use gfb_case_reader, only: longest_list
  use gfb_complaints, only: complaints_type
  use gfb_key_elements, only: find_elements
  use gfb_namelist_file, only: namelist_file_type
  use gfb_namelist_scanner, only: scan_namelist
  use gfb_text, only: exact_text, text
  implicit none (type, external)
  private
  public :: changed_text, changed_list_text

contains

  !> A case file's text as if a real key of it had another value: the value, or values, are replaced
  !> where the key stands in the file, else the key is put behind its group's name, else the group
  !> behind the last line.
  pure function changed_text(words, group, key, value) result(changed)
    character(len=*), intent(in) :: words !! the whole file
    character(len=*), intent(in) :: group, key !! names in the case file, in lower case
    real(wp), intent(in) :: value !! [its unit] of the key
    character(len=:), allocatable :: changed
    type(namelist_file_type) :: file
    type(complaints_type) :: complaints ! of who reads the file
    integer :: first, last, i, k

    call scan_namelist(words, file, complaints)
    do i = 1, size(file%entries)
      associate (entry => file%entries(i))
        if (file%group_name(entry%group) /= group .or. file%key_name(i) /= key) cycle
        if (entry%last_value < entry%first_value) cycle
        first = file%values(entry%first_value)%first
        last = file%values(entry%last_value)%last
        changed = file%words(:first - 1)//exact_text(value)
        do k = first, last
          if (file%words(k:k) == new_line('a')) changed = changed//new_line('a')
        end do
        changed = changed//file%words(last + 1:)
        return
      end associate
    end do
    changed = text_with(file, group, key//' = '//exact_text(value))
  end function changed_text

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
    if (size(owner) == 1) owner = spread(owner(1), 1, max(length, 1))
    i = owner(element)
    typed = file%value_text(i)
    associate (item => file%values(i))
      changed = file%words(:item%first - 1)
      if (item%repeats > 1) then
        changed = changed(:verify(changed(:item%first - 2), '0123456789', back=.true.))
      end if
      changed = changed//repeated(count(owner(:element - 1) == i), typed)//exact_text(value)// &
                following(count(owner(element + 1:) == i), typed)//file%words(item%last + 1:)
    end associate
  end function changed_list_text

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
