!> Texts of an HDF5 file: UTF-8 of variable length.
!>
!> What a client reads is a string of its language as it stands; of a fixed length only is what
!> another format lays down so (`Type` of VTKHDF).
module gfb_hdf5_text
  use, intrinsic :: iso_c_binding, only: c_loc, c_ptr, c_f_pointer, c_associated, c_char, &
                                         c_null_char, c_size_t
  use hdf5
  implicit none (type, external)
  private
  public :: text_kind, write_texts, read_text, write_text_attribute, write_fixed_attribute

  interface
    !> The C library's length of a text that a zero ends.
    pure function strlen(words) bind(c, name='strlen') result(length)
      import :: c_ptr, c_size_t
      implicit none (type, external)
      type(c_ptr), value :: words
      integer(c_size_t) :: length
    end function strlen
  end interface

contains

  !> HDF5's type of such a text; to be closed.
  subroutine text_kind(kind, status)
    integer(hid_t), intent(out) :: kind !! of the HDF5 library
    integer, intent(out) :: status !! of the HDF5 library

    call h5tcopy_f(H5T_STRING, kind, status)
    if (status == 0) call h5tset_cset_f(kind, H5T_CSET_UTF8_F, status)
  end subroutine text_kind

  !> Fills a dataset with texts.
  subroutine write_texts(dataset, kind, words, status)
    integer(hid_t), intent(in) :: dataset, kind !! of the HDF5 library
    character(len=*), intent(in) :: words(:) !! a text an entry
    integer, intent(out) :: status !! of the HDF5 library
    character(kind=c_char, len=len(words) + 1), target :: ended(size(words))
    type(c_ptr), target :: places(max(1, size(words)))
    integer :: i

    do i = 1, size(words)
      ended(i) = trim(words(i))//c_null_char
      places(i) = c_loc(ended(i) (1:1))
    end do
    call h5dwrite_f(dataset, kind, c_loc(places), status)
  end subroutine write_texts

  !> The text of a dataset of one entry; empty where it has none.
  subroutine read_text(dataset, words, status)
    integer(hid_t), intent(in) :: dataset !! of the HDF5 library
    character(len=:), allocatable, intent(out) :: words !! the text
    integer, intent(out) :: status !! of the HDF5 library
    character(kind=c_char), pointer :: letters(:)
    type(c_ptr), target :: place(1)
    type(c_ptr) :: address
    integer(hid_t) :: kind, space
    integer :: i, ignored

    words = ''
    call text_kind(kind, status)
    if (status /= 0) return
    address = c_loc(place)
    call h5dread_f(dataset, kind, address, status)
    if (status == 0 .and. c_associated(place(1))) then
      call c_f_pointer(place(1), letters, [strlen(place(1))])
      words = repeat(' ', size(letters))
      do i = 1, size(letters)
        words(i:i) = letters(i)
      end do
      call h5dget_space_f(dataset, space, ignored)
      call h5dvlen_reclaim_f(kind, space, H5P_DEFAULT_F, address, ignored)
      call h5sclose_f(space, ignored)
    end if
    call h5tclose_f(kind, ignored)
  end subroutine read_text

  !> Adds a text to what a group or dataset says of itself.
  subroutine write_text_attribute(object, name, words, failed)
    integer(hid_t), intent(in) :: object !! of the HDF5 library
    character(len=*), intent(in) :: name, words !! of the attribute; its text
    logical, intent(inout) :: failed !! becomes true where it cannot be added
    character(kind=c_char, len=len(words) + 1), target :: ended
    type(c_ptr), target :: place
    integer(hid_t) :: kind
    integer :: status

    ended = trim(words)//c_null_char
    place = c_loc(ended(1:1))
    call text_kind(kind, status)
    call write_attribute(object, name, kind, c_loc(place), failed)
    call h5tclose_f(kind, status)
  end subroutine write_text_attribute

  !> The same of fixed length, in ASCII.
  subroutine write_fixed_attribute(object, name, words, failed)
    integer(hid_t), intent(in) :: object !! of the HDF5 library
    character(len=*), intent(in) :: name, words !! of the attribute; its text, not empty
    logical, intent(inout) :: failed !! becomes true where it cannot be added
    character(kind=c_char, len=:), allocatable, target :: buffer
    integer(hid_t) :: kind
    integer :: status

    buffer = words
    call h5tcopy_f(H5T_FORTRAN_S1, kind, status)
    call h5tset_size_f(kind, int(len(buffer), size_t), status)
    call write_attribute(object, name, kind, c_loc(buffer(1:1)), failed)
    call h5tclose_f(kind, status)
  end subroutine write_fixed_attribute

  !> Adds an attribute of one entry.
  subroutine write_attribute(object, name, kind, buffer, failed)
    integer(hid_t), intent(in) :: object, kind
    character(len=*), intent(in) :: name
    type(c_ptr), intent(in) :: buffer
    logical, intent(inout) :: failed
    integer(hid_t) :: space, attribute
    integer :: status

    call h5screate_f(H5S_SCALAR_F, space, status)
    call h5acreate_f(object, name, kind, space, attribute, status)
    call h5awrite_f(attribute, kind, buffer, status)
    if (status /= 0) failed = .true.
    call h5aclose_f(attribute, status)
    call h5sclose_f(space, status)
  end subroutine write_attribute
end module gfb_hdf5_text
