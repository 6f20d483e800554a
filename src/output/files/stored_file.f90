!> An HDF5 file that all ranks read, each what it needs, once its checksum was found to fit.
module gfb_stored_file
  use, intrinsic :: iso_c_binding, only: c_loc, c_ptr
  use hdf5
  use mpi, only: MPI_CHARACTER, MPI_Bcast
  use gfb_kinds, only: wp
  use gfb_errors, only: error_type, fail, status_machine
  use gfb_archive, only: largest_stored
  use gfb_file_set, only: check_seal
  use gfb_hdf5_text, only: read_text
  implicit none (type, external)
  private
  public :: open_stored_file, close_stored_file

  !> An open file. What cannot be read from it leaves `failed` behind, and zeros; `lost` says which
  !> that was; of contents that lie in another file, or are more than this one can hold, `refused`.
  type, public :: stored_file_type
    character(len=:), allocatable :: path
    logical :: failed = .false. !! something could not be read on this rank
    character(len=:), allocatable :: lost    !! path of what could not be read first, or empty
    character(len=:), allocatable :: refused !! what was not read on purpose, and why, or empty
    integer(hid_t), private :: file = -1
  contains
    procedure :: has, words, scalar, count => whole_number, numbers, block => block_of_rank
    procedure :: find_shape
    procedure, private :: open_dataset, refuse, lose
  end type stored_file_type

contains

  !> Opens a file for reading.
  !>
  !> Fails on all ranks when it is no HDF5 file, and when it does not fit its checksum.
  subroutine open_stored_file(path, communicator, first_rank, file, error)
    character(len=*), intent(in) :: path !! of the file, or of what is in it
    integer, intent(in) :: communicator !! MPI's, of the ranks that read
    logical, intent(in) :: first_rank !! this rank is the first of them
    type(stored_file_type), intent(out) :: file !! the file being read
    type(error_type), allocatable, intent(out) :: error !! what went wrong, if anything did
    integer :: status

    file%path = path
    file%refused = ''
    file%lost = ''
    call compare_seal(path, communicator, first_rank, error)
    if (allocated(error)) return
    call h5open_f(status)
    call h5eset_auto_f(0, status)
    call h5fopen_f(path, H5F_ACC_RDONLY_F, file%file, status)
    if (status /= 0) then
      call fail(error, path//': the file cannot be read, or is no HDF5 file', status_machine)
    end if
  end subroutine open_stored_file

  !> Compares the file with its checksum, on one rank for all.
  !>
  !> Fails where they do not fit.
  subroutine compare_seal(path, communicator, first_rank, error)
    character(len=*), intent(in) :: path
    integer, intent(in) :: communicator
    logical, intent(in) :: first_rank
    type(error_type), allocatable, intent(out) :: error
    character(len=300) :: problem
    integer :: ignored

    problem = ''
    if (first_rank) problem = check_seal(path)
    call MPI_Bcast(problem, len(problem), MPI_CHARACTER, 0, communicator, ignored)
    if (problem /= '') call fail(error, path//': '//trim(problem), status_machine)
  end subroutine compare_seal

  !> Ends reading.
  subroutine close_stored_file(file)
    type(stored_file_type), intent(inout) :: file !! the file being read
    integer :: status
    call h5fclose_f(file%file, status)
  end subroutine close_stored_file

  !> Whether there is a dataset or group of this path, in a group that is there.
  logical function has(self, path) result(there)
    class(stored_file_type), intent(in) :: self !! the file
    character(len=*), intent(in) :: path !! of the file, or of what is in it
    integer :: status

    call h5lexists_f(self%file, path, there, status)
    there = there .and. status == 0
  end function has

  !> A text; empty where there is none.
  function words(self, path)
    class(stored_file_type), intent(inout) :: self !! the file
    character(len=*), intent(in) :: path !! of the file, or of what is in it
    character(len=:), allocatable :: words
    integer(hid_t) :: dataset
    integer :: status, ignored

    words = ''
    call self%open_dataset(path, .true., dataset, status)
    if (status /= 0) return
    call read_text(dataset, words, status)
    if (status /= 0) call self%lose(path)
    call h5dclose_f(dataset, ignored)
  end function words

  !> One number.
  real(wp) function scalar(self, path) result(number)
    class(stored_file_type), intent(inout) :: self !! the file
    character(len=*), intent(in) :: path !! of the file, or of what is in it
    real(wp), target :: value
    type(c_ptr) :: address
    integer(hid_t) :: dataset
    integer :: status, ignored

    number = 0.0_wp
    call self%open_dataset(path, .true., dataset, status)
    if (status /= 0) return
    address = c_loc(value)
    call h5dread_f(dataset, H5T_NATIVE_DOUBLE, address, status)
    if (status /= 0) then
      call self%lose(path)
    else if (.not. abs(value) <= largest_stored) then
      call self%refuse(path, 'no number of gfb''s')
    else
      number = value
    end if
    call h5dclose_f(dataset, ignored)
  end function scalar

  !> One whole number; 0 where it is none.
  integer function whole_number(self, path) result(number)
    class(stored_file_type), intent(inout) :: self !! the file
    character(len=*), intent(in) :: path !! of the file, or of what is in it
    real(wp) :: value

    number = 0
    value = self%scalar(path)
    if (abs(value) > real(huge(number), wp) .or. abs(value - anint(value)) > 0.0_wp) then
      call self%refuse(path, 'no whole number')
    else
      number = nint(value)
    end if
  end function whole_number

  !> A list of numbers, all of it on all ranks.
  function numbers(self, path) result(list)
    class(stored_file_type), intent(inout) :: self !! the file
    character(len=*), intent(in) :: path !! of the file, or of what is in it
    real(wp), allocatable :: list(:)
    integer :: components, entries

    call self%find_shape(path, components, entries)
    if (components > 1) call self%lose(path)
    list = reshape(self%block(path, 1, 0, entries), [entries])
  end function numbers

  !> Components and entries of a list, which has one, or of a field; no entries where it cannot be
  !> read.
  subroutine find_shape(self, path, components, entries)
    class(stored_file_type), intent(inout) :: self !! the file
    character(len=*), intent(in) :: path !! of the file, or of what is in it
    integer, intent(out) :: components, entries !! of an entry; of all ranks
    integer(hid_t) :: dataset, space
    integer(hsize_t) :: extent(2), most(2)
    integer :: status, rank

    components = 1
    entries = 0
    call self%open_dataset(path, .false., dataset, status)
    if (status /= 0) return
    extent = 1
    call h5dget_space_f(dataset, space, status)
    call h5sget_simple_extent_ndims_f(space, rank, status)
    if (status == 0) status = merge(0, -1, rank == 1 .or. rank == 2)
    if (status == 0) then
      call h5sget_simple_extent_dims_f(space, extent(3 - rank:), most(3 - rank:), status)
    end if
    if (status < 0) then ! the number of dimensions comes back as the status
      call self%lose(path)
    else if (any(extent > huge(entries))) then
      call self%refuse(path, 'more numbers than can be counted')
    else
      components = int(extent(1))
      entries = int(extent(2))
    end if
    call h5sclose_f(space, status)
    call h5dclose_f(dataset, status)
  end subroutine find_shape

  !> Consecutive entries of a field, for each rank its own; one component makes it a plain list.
  function block_of_rank(self, path, components, offset, entries) result(block)
    class(stored_file_type), intent(inout) :: self !! the file
    character(len=*), intent(in) :: path !! of the file, or of what is in it
    integer, intent(in) :: components !! of an entry
    integer, intent(in) :: offset  !! entries before this rank's
    integer, intent(in) :: entries !! of this rank
    real(wp) :: block(components, entries)

    real(wp), target :: buffer(max(1, components*entries))
    type(c_ptr) :: address
    integer(hsize_t) :: part(2), start(2)
    integer(hid_t) :: space, memory, dataset
    integer :: status, rank, ignored

    block = 0.0_wp
    rank = merge(1, 2, components == 1)
    part = [components, entries]
    start = [0, offset]
    if (rank == 1) then
      part(1) = entries
      start(1) = offset
    end if
    call self%open_dataset(path, .false., dataset, status)
    if (status /= 0) return
    call h5dget_space_f(dataset, space, status)
    if (.not. has_shape(space, rank, components)) then
      call self%lose(path)
      call h5sclose_f(space, ignored)
      call h5dclose_f(dataset, ignored)
      return
    end if
    call h5screate_simple_f(rank, max(part(:rank), 1_hsize_t), memory, status)
    if (entries > 0) then
      call h5sselect_hyperslab_f(space, H5S_SELECT_SET_F, start(:rank), part(:rank), status)
    else
      call h5sselect_none_f(space, status)
      call h5sselect_none_f(memory, status)
    end if
    address = c_loc(buffer)
    call h5dread_f(dataset, H5T_NATIVE_DOUBLE, address, status, memory, space)
    if (status == 0) block = reshape(buffer(:components*entries), [components, entries])
    if (status /= 0) call self%lose(path)
    call h5sclose_f(memory, ignored)
    call h5sclose_f(space, ignored)
    call h5dclose_f(dataset, ignored)
  end function block_of_rank

  !> Opens a dataset, to be closed, whose contents lie in this file; else leaves `failed` behind,
  !> and a status that is not 0.
  !>
  !> HDF5 follows a link into another file, and reads what another file holds, without a word.
  subroutine open_dataset(self, path, single, dataset, status)
    class(stored_file_type), intent(inout) :: self !! the file
    character(len=*), intent(in) :: path !! of the file, or of what is in it
    logical, intent(in) :: single !! it has one entry
    integer(hid_t), intent(out) :: dataset !! of the HDF5 library
    integer, intent(out) :: status !! 0, or something went wrong
    integer(hid_t) :: space, laid
    integer(hsize_t) :: entries, bytes
    integer :: ignored, others, layout
    character(len=:), allocatable :: home, there

    call h5dopen_f(self%file, path, dataset, status)
    if (status /= 0) then
      call self%lose(path)
      return
    end if
    call h5dget_create_plist_f(dataset, laid, status)
    call h5pget_external_count_f(laid, others, status)
    call h5pget_layout_f(laid, layout, status)
    call h5pclose_f(laid, ignored)
    call h5dget_space_f(dataset, space, status)
    call h5sget_simple_extent_npoints_f(space, entries, status)
    call h5sclose_f(space, ignored)
    call h5fget_filesize_f(self%file, bytes, status)
    home = name_of(self%file)
    there = name_of(dataset)
    if (status /= 0) then
      call self%lose(path)
    else if (others > 0 .or. layout == H5D_VIRTUAL_F .or. there /= home) then
      call self%refuse(path, 'its contents lie in another file, which is not read')
    else if (single .and. entries /= 1) then
      call self%refuse(path, 'not one entry')
    else if (entries > bytes) then
      call self%refuse(path, 'more entries than the file has bytes')
    else
      return
    end if
    status = 1
    call h5dclose_f(dataset, ignored)
  end subroutine open_dataset

  !> Notes what is not read on purpose: the first of several.
  subroutine refuse(self, path, why)
    class(stored_file_type), intent(inout) :: self !! the file
    character(len=*), intent(in) :: path, why !! of what is in the file; a sentence

    self%failed = .true.
    if (self%refused == '') self%refused = path//': '//why
  end subroutine refuse

  !> Notes what cannot be read: the first of several.
  subroutine lose(self, path)
    class(stored_file_type), intent(inout) :: self !! the file
    character(len=*), intent(in) :: path !! of what is in the file

    self%failed = .true.
    if (self%lost == '') self%lost = path
  end subroutine lose

  !> The file in which an object lies, as it was opened.
  function name_of(object) result(name)
    integer(hid_t), intent(in) :: object !! of the HDF5 library
    character(len=:), allocatable :: name
    character(len=1) :: short
    integer(size_t) :: length
    integer :: status

    call h5fget_name_f(object, short, length, status)
    allocate (character(len=max(1, int(length) + 1)) :: name)
    call h5fget_name_f(object, name, length, status)
    name = name(:int(length))
  end function name_of

  !> Whether a dataset is a list, or has so many components.
  logical function has_shape(space, rank, components) result(fits)
    integer(hid_t), intent(in) :: space
    integer, intent(in) :: rank, components !! that it should have
    integer(hsize_t) :: extent(2), most(2)
    integer :: status, found

    call h5sget_simple_extent_ndims_f(space, found, status)
    fits = status == 0 .and. found == rank
    if (.not. fits .or. rank == 1) return
    call h5sget_simple_extent_dims_f(space, extent, most, status)
    fits = extent(1) == components
  end function has_shape
end module gfb_stored_file
