!> An HDF5 file that all ranks write together.
!>
!> It is written under a temporary name and takes its own when it is whole. Every dataset has a unit
!> and a meaning.
module gfb_result_file
  use, intrinsic :: iso_c_binding, only: c_loc, c_ptr, c_int8_t, c_char
  use hdf5
  use gfb_kinds, only: wp, long
  use gfb_errors, only: error_type, fail, status_machine
  use gfb_c_library, only: rename_file, remove_file
  implicit none (type, external)
  private
  public :: open_result_file, close_result_file, drop_result_file, keep_result_file

  character(len=*), parameter :: unfinished = '.part' !! ending of a file that is being written
  integer, parameter :: no_parts(0) = [integer ::]    !! extents of an entry that is a number

  !> An open file.
  type, public :: result_file_type
    character(len=:), allocatable :: path
    logical :: first_rank = .false. !! this rank writes what all ranks know
    logical :: failed = .false.     !! something could not be written
    integer(hid_t), private :: file = -1
    integer(hid_t), private :: collective = -1
  contains
    procedure :: group => add_group
    procedure :: need_group
    procedure :: put_text
    procedure :: put_words
    procedure :: put_numbers
    procedure :: put_scalar
    procedure :: put_block
    procedure :: put_long_block
    procedure :: put_byte_block
    procedure :: mark_text
    procedure :: mark_longs
    procedure, private :: write_part
    procedure, private :: describe
  end type result_file_type

contains

  !> Begins a file, under a temporary name.
  !>
  !> Fails when it cannot be made.
  subroutine open_result_file(path, communicator, information, first_rank, file, error)
    character(len=*), intent(in) :: path !! of the file, or of what is in it
    integer, intent(in) :: communicator !! MPI's, of the ranks that write
    integer, intent(in) :: information  !! MPI's null information
    logical, intent(in) :: first_rank !! this rank leads
    type(result_file_type), intent(out) :: file !! the file being written
    type(error_type), allocatable, intent(out) :: error !! what went wrong, if anything did
    integer(hid_t) :: access
    integer :: status

    file%path = path
    file%first_rank = first_rank
    call h5open_f(status)
    call h5eset_auto_f(0, status)
    call h5pcreate_f(H5P_FILE_ACCESS_F, access, status)
    call h5pset_fapl_mpio_f(access, communicator, information, status)
    call h5fcreate_f(path//unfinished, H5F_ACC_TRUNC_F, file%file, status, access_prp=access)
    if (status /= 0) call fail(error, path//': the file cannot be written', status_machine)
    call h5pclose_f(access, status)
    call h5pcreate_f(H5P_DATASET_XFER_F, file%collective, status)
    call h5pset_dxpl_mpio_f(file%collective, H5FD_MPIO_COLLECTIVE_F, status)
  end subroutine open_result_file

  !> Ends a file, which keeps its temporary name until `keep_result_file`.
  !>
  !> Fails when anything in it could not be written.
  subroutine close_result_file(file, error)
    type(result_file_type), intent(inout) :: file !! the file being written
    type(error_type), allocatable, intent(out) :: error !! what went wrong, if anything did
    integer :: status

    call h5pclose_f(file%collective, status)
    call h5fclose_f(file%file, status)
    if (status /= 0) file%failed = .true.
    if (file%failed) then
      call fail(error, file%path//': writing failed (is the disk full?)', status_machine)
    end if
  end subroutine close_result_file

  !> Gives a closed file its own name; what stood there is replaced in one step.
  !>
  !> Fails when the system refuses.
  subroutine keep_result_file(file, error)
    type(result_file_type), intent(in) :: file !! the file being written
    type(error_type), allocatable, intent(out) :: error !! what went wrong, if anything did

    if (.not. file%first_rank) return
    if (.not. rename_file(file%path//unfinished, file%path)) then
      call fail(error, file%path//': the file cannot be put in its place', status_machine)
    end if
  end subroutine keep_result_file

  !> Removes a file that was not kept.
  subroutine drop_result_file(file)
    type(result_file_type), intent(in) :: file !! the file being written

    if (file%first_rank .and. allocated(file%path)) call remove_file(file%path//unfinished)
  end subroutine drop_result_file

  !> Adds a group.
  subroutine add_group(self, path)
    class(result_file_type), intent(inout) :: self !! the file
    character(len=*), intent(in) :: path !! of the file, or of what is in it
    integer(hid_t) :: group
    integer :: status

    call h5gcreate_f(self%file, path, group, status)
    if (status /= 0) self%failed = .true.
    call h5gclose_f(group, status)
  end subroutine add_group

  !> Adds a group unless it is there.
  subroutine need_group(self, path)
    class(result_file_type), intent(inout) :: self !! the file
    character(len=*), intent(in) :: path !! of the file, or of what is in it
    logical :: there
    integer :: status

    call h5lexists_f(self%file, path, there, status)
    if (.not. there) call self%group(path)
  end subroutine need_group

  !> Adds a text.
  subroutine put_text(self, path, words, meaning)
    class(result_file_type), intent(inout) :: self !! the file
    character(len=*), intent(in) :: path, words, meaning !! where it goes; the text; a sentence
    character(kind=c_char, len=:), allocatable, target :: buffer
    integer(hid_t) :: kind, space, dataset
    integer :: status

    buffer = words
    if (len(buffer) == 0) buffer = ' '
    call h5tcopy_f(H5T_FORTRAN_S1, kind, status)
    call h5tset_size_f(kind, int(len(buffer), size_t), status)
    call h5screate_f(H5S_SCALAR_F, space, status)
    call h5dcreate_f(self%file, path, kind, space, dataset, status)
    if (status /= 0) self%failed = .true.
    call self%describe(dataset, '', meaning)
    if (.not. self%first_rank) call h5sselect_none_f(space, status)
    call h5dwrite_f(dataset, kind, c_loc(buffer(1:1)), status, space, space, self%collective)
    if (status /= 0) self%failed = .true.
    call h5dclose_f(dataset, status)
    call h5sclose_f(space, status)
    call h5tclose_f(kind, status)
  end subroutine put_text

  !> Adds a list of words that all ranks know.
  subroutine put_words(self, path, words, meaning)
    class(result_file_type), intent(inout) :: self !! the file
    character(len=*), intent(in) :: path !! of the file, or of what is in it
    character(len=*), intent(in) :: words(:) !! blank-padded
    character(len=*), intent(in) :: meaning !! a sentence
    character(kind=c_char, len=len(words)), target :: buffer(max(1, size(words)))
    integer(hid_t) :: kind
    integer :: status

    buffer(:size(words)) = words
    call h5tcopy_f(H5T_FORTRAN_S1, kind, status)
    call h5tset_size_f(kind, int(max(1, len(words)), size_t), status)
    call self%write_part(path, kind, kind, c_loc(buffer), no_parts, &
                         merge(size(words), 0, self%first_rank), 0, size(words), '', meaning)
    call h5tclose_f(kind, status)
  end subroutine put_words

  !> Adds numbers that all ranks know.
  subroutine put_numbers(self, path, numbers, unit, meaning)
    class(result_file_type), intent(inout) :: self !! the file
    character(len=*), intent(in) :: path !! of the file, or of what is in it
    real(wp), intent(in) :: numbers(:) !! [SI] in `unit`
    character(len=*), intent(in) :: unit, meaning !! of the numbers (1: none); a sentence
    integer :: mine

    mine = merge(size(numbers), 0, self%first_rank)
    call self%put_block(path, reshape(numbers(:mine), [1, mine]), 0, size(numbers), unit, meaning)
  end subroutine put_numbers

  !> Adds one number that all ranks know, as a dataset without dimensions.
  subroutine put_scalar(self, path, number, unit, meaning)
    class(result_file_type), intent(inout) :: self !! the file
    character(len=*), intent(in) :: path !! of the file, or of what is in it
    real(wp), intent(in) :: number !! [SI] in `unit`
    character(len=*), intent(in) :: unit, meaning !! of the numbers (1: none); a sentence
    real(wp), target :: value
    integer(hid_t) :: space, dataset
    integer :: status

    value = number
    call h5screate_f(H5S_SCALAR_F, space, status)
    call h5dcreate_f(self%file, path, H5T_NATIVE_DOUBLE, space, dataset, status)
    if (status /= 0) self%failed = .true.
    call self%describe(dataset, unit, meaning)
    if (.not. self%first_rank) call h5sselect_none_f(space, status)
    call h5dwrite_f(dataset, H5T_NATIVE_DOUBLE, c_loc(value), status, space, space, self%collective)
    if (status /= 0) self%failed = .true.
    call h5dclose_f(dataset, status)
    call h5sclose_f(space, status)
  end subroutine put_scalar

  !> Adds a field of which each rank has consecutive entries; one component makes it a plain list,
  !> and components can be those of square matrices.
  subroutine put_block(self, path, block, offset, total, unit, meaning, order)
    class(result_file_type), intent(inout) :: self !! the file
    character(len=*), intent(in) :: path !! of the file, or of what is in it
    real(wp), intent(in) :: block(:, :) !! (components, entries of this rank), in `unit` [SI]
    integer, intent(in) :: offset       !! entries before this rank's
    integer, intent(in) :: total        !! entries of all ranks
    character(len=*), intent(in) :: unit, meaning !! of the numbers (1: none); a sentence
    integer, intent(in), optional :: order !! of the matrices; 0: none
    real(wp), target :: buffer(max(1, size(block)))
    integer, allocatable :: inner(:)

    buffer(:size(block)) = reshape(block, [size(block)])
    inner = pack([size(block, 1)], [size(block, 1) /= 1])
    if (present(order)) then
      if (order > 0) inner = [order, order]
    end if
    call self%write_part(path, H5T_NATIVE_DOUBLE, H5T_NATIVE_DOUBLE, c_loc(buffer), &
                         inner, size(block, 2), offset, total, unit, meaning)
  end subroutine put_block

  !> Adds 64-bit integers of which each rank has consecutive entries.
  subroutine put_long_block(self, path, block, offset, total, meaning)
    class(result_file_type), intent(inout) :: self !! the file
    character(len=*), intent(in) :: path !! of the file, or of what is in it
    integer(long), intent(in) :: block(:) !! entries of this rank
    integer, intent(in) :: offset         !! entries before this rank's
    integer, intent(in) :: total          !! entries of all ranks
    character(len=*), intent(in) :: meaning !! a sentence
    integer(long), target :: buffer(max(1, size(block)))
    integer(hid_t) :: kind

    buffer(:size(block)) = block
    kind = h5kind_to_type(long, H5_INTEGER_KIND)
    call self%write_part(path, kind, kind, c_loc(buffer), no_parts, size(block), offset, &
                         total, '1', meaning)
  end subroutine put_long_block

  !> Adds unsigned bytes of which each rank has consecutive entries.
  subroutine put_byte_block(self, path, block, offset, total, meaning)
    class(result_file_type), intent(inout) :: self !! the file
    character(len=*), intent(in) :: path !! of the file, or of what is in it
    integer(c_int8_t), intent(in) :: block(:) !! entries of this rank
    integer, intent(in) :: offset             !! entries before this rank's
    integer, intent(in) :: total              !! entries of all ranks
    character(len=*), intent(in) :: meaning !! a sentence
    integer(c_int8_t), target :: buffer(max(1, size(block)))

    buffer(:size(block)) = block
    call self%write_part(path, H5T_STD_U8LE, H5T_STD_U8LE, c_loc(buffer), no_parts, size(block), &
                         offset, total, '1', meaning)
  end subroutine put_byte_block

  !> Creates a dataset and writes each rank's part of it.
  subroutine write_part(self, path, stored, given, buffer, inner, entries, offset, total, &
                        unit, meaning)
    class(result_file_type), intent(inout) :: self !! the file
    character(len=*), intent(in) :: path !! of the file, or of what is in it
    integer(hid_t), intent(in) :: stored, given !! types in the file and in memory
    type(c_ptr), intent(in) :: buffer !! this rank's entries
    integer, intent(in) :: inner(:) !! extents of an entry; none: it is a number
    integer, intent(in) :: entries, offset, total !! here, before, in all
    character(len=*), intent(in) :: unit, meaning !! of the numbers (1: none); a sentence

    integer(hsize_t), dimension(size(inner) + 1) :: extent, part, start
    integer(hid_t) :: space, memory, dataset
    integer :: status, rank

    rank = size(extent)
    extent = [inner, total]
    part = [inner, entries]
    start = [0*inner, offset]
    call h5screate_simple_f(rank, extent, space, status)
    call h5dcreate_f(self%file, path, stored, space, dataset, status)
    if (status /= 0) self%failed = .true.
    call self%describe(dataset, unit, meaning)
    call h5screate_simple_f(rank, max(part, 1_hsize_t), memory, status)
    if (entries > 0) then
      call h5sselect_hyperslab_f(space, H5S_SELECT_SET_F, start, part, status)
    else
      call h5sselect_none_f(space, status)
      call h5sselect_none_f(memory, status)
    end if
    call h5dwrite_f(dataset, given, buffer, status, memory, space, self%collective)
    if (status /= 0) self%failed = .true.
    call h5sclose_f(memory, status)
    call h5dclose_f(dataset, status)
    call h5sclose_f(space, status)
  end subroutine write_part

  !> Unit and meaning of a dataset.
  subroutine describe(self, dataset, unit, meaning)
    class(result_file_type), intent(inout) :: self !! the file
    integer(hid_t), intent(in) :: dataset !! of the HDF5 library
    character(len=*), intent(in) :: unit, meaning !! of the numbers (1: none); a sentence

    call write_text_attribute(dataset, 'unit', unit, self%failed)
    call write_text_attribute(dataset, 'meaning', meaning, self%failed)
  end subroutine describe

  !> Adds a text attribute to a group.
  subroutine mark_text(self, group, name, words)
    class(result_file_type), intent(inout) :: self !! the file
    character(len=*), intent(in) :: group, name, words !! of the file; the attribute and its text
    integer(hid_t) :: object
    integer :: status

    call h5gopen_f(self%file, group, object, status)
    call write_text_attribute(object, name, words, self%failed)
    call h5gclose_f(object, status)
  end subroutine mark_text

  !> Adds an attribute of integers to a group.
  subroutine mark_longs(self, group, name, numbers)
    class(result_file_type), intent(inout) :: self !! the file
    character(len=*), intent(in) :: group, name !! of the file; of the attribute
    integer(long), intent(in) :: numbers(:) !! of the attribute
    integer(long), target :: buffer(size(numbers))
    integer(hid_t) :: object, kind, space, attribute
    integer :: status

    buffer = numbers
    kind = h5kind_to_type(long, H5_INTEGER_KIND)
    call h5gopen_f(self%file, group, object, status)
    call h5screate_simple_f(1, [int(size(numbers), hsize_t)], space, status)
    call h5acreate_f(object, name, kind, space, attribute, status)
    call h5awrite_f(attribute, kind, c_loc(buffer), status)
    if (status /= 0) self%failed = .true.
    call h5aclose_f(attribute, status)
    call h5sclose_f(space, status)
    call h5gclose_f(object, status)
  end subroutine mark_longs

  !> Writes a fixed-length text attribute.
  subroutine write_text_attribute(object, name, words, failed)
    integer(hid_t), intent(in) :: object
    character(len=*), intent(in) :: name, words
    logical, intent(inout) :: failed
    character(kind=c_char, len=:), allocatable, target :: buffer
    integer(hid_t) :: kind, space, attribute
    integer :: status

    buffer = words
    if (len(buffer) == 0) buffer = ' '
    call h5tcopy_f(H5T_FORTRAN_S1, kind, status)
    call h5tset_size_f(kind, int(len(buffer), size_t), status)
    call h5screate_f(H5S_SCALAR_F, space, status)
    call h5acreate_f(object, name, kind, space, attribute, status)
    call h5awrite_f(attribute, kind, c_loc(buffer(1:1)), status)
    if (status /= 0) failed = .true.
    call h5aclose_f(attribute, status)
    call h5sclose_f(space, status)
    call h5tclose_f(kind, status)
  end subroutine write_text_attribute
end module gfb_result_file
