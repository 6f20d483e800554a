!> The text of a case file with another value of a key, every line where it was.
module gfb_changed_text
  use gfb_kinds, only: wp
  use gfb_complaints, only: complaints_type
  use gfb_namelist_file, only: namelist_file_type
  use gfb_namelist_scanner, only: scan_namelist
  use gfb_text, only: exact_text
  implicit none (type, external)
  private
  public :: changed_text

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
        changed = words(:first - 1)//exact_text(value)
        do k = first, last
          if (words(k:k) == new_line('a')) changed = changed//new_line('a')
        end do
        changed = changed//words(last + 1:)
        return
      end associate
    end do
    do i = 1, size(file%groups)
      if (file%group_name(i) /= group) cycle
      last = file%groups(i)%last
      changed = words(:last)//' '//key//' = '//exact_text(value)//words(last + 1:)
      return
    end do
    changed = words//new_line('a')//'&'//group//' '//key//' = '//exact_text(value)//' /'
  end function changed_text
end module gfb_changed_text
