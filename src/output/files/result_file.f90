!> An HDF5 file to which all ranks add.
!>
!> The first rank builds it in memory, where no disk can be full, from what the ranks send, and
!> writes it with a checksum under a temporary name; it takes its own when it is whole. Every
!> dataset has a unit and a meaning.
module gfb_result_file
  use, intrinsic :: iso_c_binding, only: c_f_pointer, c_int8_t, c_ptr, c_loc, c_null_ptr
  use hdf5
  use mpi, only: MPI_BYTE, MPI_INTEGER, MPI_LOGICAL, MPI_LOR, MPI_Allreduce, MPI_Comm_size, &
                 MPI_Gather, MPI_Gatherv, MPI_Type_contiguous, MPI_Type_commit, MPI_Type_free, &
                 MPI_Bcast
  use gfb_kinds, only: long, wp
  use gfb_errors, only: error_type, fail, status_machine
  use gfb_machine_memory, only: look_for_room, room_to_write
  use gfb_file_set, only: unfinished_file_type, write_unfinished, publish, drop_unfinished, &
                          error_words
  use gfb_hdf5_text, only: text_kind, write_texts, write_text_attribute, write_fixed_attribute
  implicit none (type, external)
  private
  public :: gather_parts, open_result_file, close_result_file, drop_result_file, keep_result_file

  integer(hsize_t), parameter :: few = 1000_hsize_t !! numbers that stay in one piece
  !> 256 KiB of reals; HDF5 caches 1 MiB.
  integer(hsize_t), parameter :: chunk_numbers = 32768_hsize_t
  integer, parameter :: effort = 4 !! of deflate, 1 to 9: more takes longer and hardly saves

  integer(size_t), parameter :: growth = 1048576_size_t !! of a file in memory, at a time [B]

  !> An open file.
  type, public :: result_file_type
    character(len=:), allocatable :: path
    logical :: first_rank = .false. !! this rank builds and writes the file
    logical :: failed = .false.     !! something could not be added
    logical :: compressed = .true.  !! long datasets are; takes time that a restart file should not
    type(unfinished_file_type) :: written !! on the first rank, once it is closed
    integer, private :: communicator = 0  !! MPI's, of the ranks that add to it
    integer(hid_t), private :: file = -1
  contains
    procedure :: group => add_group
    procedure :: need_group, put_text, put_words, put_numbers, put_scalar, put_block, put_long_block
    procedure :: put_byte_block, mark_text, mark_longs
    procedure, private :: put_parts, put_texts, put_whole, describe
  end type result_file_type

contains

  !> The property list of a new dataset, to be closed; compressed where the library has the filters.
  subroutine choose_layout(extent, compressed, layout, status)
    integer(hsize_t), intent(in) :: extent(:) !! of the dataset, fastest index first
    logical, intent(in) :: compressed !! it may be
    integer(hid_t), intent(out) :: layout !! of the HDF5 library
    integer, intent(out) :: status !! 0, or HDF5's error
    integer(hsize_t) :: chunk(size(extent)), left
    logical :: has_filter
    integer :: i

    call h5pcreate_f(H5P_DATASET_CREATE_F, layout, status)
    if (status /= 0 .or. .not. compressed .or. product(extent) <= few) return
    call look_for(H5Z_FILTER_DEFLATE_F, has_filter)
    if (.not. has_filter) return
    left = chunk_numbers
    do i = 1, size(extent)
      chunk(i) = min(extent(i), left)
      left = max(1_hsize_t, left/chunk(i))
    end do
    call h5pset_chunk_f(layout, size(chunk), chunk, status)
    call look_for(H5Z_FILTER_SHUFFLE_F, has_filter)
    if (status == 0 .and. has_filter) call h5pset_shuffle_f(layout, status)
    if (status == 0) call h5pset_deflate_f(layout, effort, status)
  end subroutine choose_layout

  !> Whether the library can apply a filter.
  subroutine look_for(filter, has_filter)
    integer, intent(in) :: filter !! its number
    logical, intent(out) :: has_filter !! it can
    integer :: uses, status

    call h5zfilter_avail_f(filter, has_filter, status)
    has_filter = has_filter .and. status == 0
    if (.not. has_filter) return
    call h5zget_filter_info_f(filter, uses, status)
    has_filter = status == 0 .and. iand(uses, H5Z_FILTER_ENCODE_ENABLED_F) /= 0
  end subroutine look_for

  !> Puts consecutive entries of every rank where they stand among all; zeros where no rank has any.
  subroutine gather_parts(communicator, first_rank, bytes, buffer, entries, offset, total, all)
    integer, intent(in) :: communicator !! MPI's
    logical, intent(in) :: first_rank !! this is the rank that gets them
    integer, intent(in) :: bytes !! of an entry
    type(c_ptr), intent(in) :: buffer !! this rank's entries
    integer, intent(in) :: entries, offset, total !! here, before this rank's, in all
    !> on the first rank; next to nothing elsewhere
    integer(c_int8_t), allocatable, intent(out) :: all(:)
    integer(c_int8_t), pointer :: mine(:)
    integer, allocatable :: counts(:), places(:)
    integer :: ranks, one_entry, ignored

    call MPI_Comm_size(communicator, ranks, ignored)
    allocate (counts(ranks), places(ranks))
    call MPI_Gather([entries], 1, MPI_INTEGER, counts, 1, MPI_INTEGER, 0, communicator, ignored)
    call MPI_Gather([offset], 1, MPI_INTEGER, places, 1, MPI_INTEGER, 0, communicator, ignored)
    allocate (all(merge(max(1_long, int(total, long)*bytes), 1_long, first_rank)))
    all = 0_c_int8_t
    call c_f_pointer(buffer, mine, [max(1_long, int(entries, long)*bytes)])
    call MPI_Type_contiguous(bytes, MPI_BYTE, one_entry, ignored)
    call MPI_Type_commit(one_entry, ignored)
    call MPI_Gatherv(mine, entries, one_entry, all, counts, places, one_entry, 0, communicator, &
                     ignored)
    call MPI_Type_free(one_entry, ignored)
  end subroutine gather_parts

  !> Makes what is true on one rank true on all.
  subroutine share_truth(truth, communicator)
    logical, intent(inout) :: truth !! of this rank; on return of all
    integer, intent(in) :: communicator !! MPI's
    logical :: mine
    integer :: ignored

    mine = truth
    call MPI_Allreduce(mine, truth, 1, MPI_LOGICAL, MPI_LOR, communicator, ignored)
  end subroutine share_truth

  !> Begins a file in memory.
  subroutine open_result_file(path, communicator, first_rank, file, error)
    character(len=*), intent(in) :: path !! of the file, or of what is in it
    integer, intent(in) :: communicator !! MPI's, of the ranks that write
    logical, intent(in) :: first_rank !! this rank is the first of them
    type(result_file_type), intent(out) :: file !! the file being written
    type(error_type), allocatable, intent(out) :: error !! what went wrong, if anything did
    integer(hid_t) :: access
    integer :: status

    file%path = path
    file%first_rank = first_rank
    file%communicator = communicator
    if (.not. first_rank) return
    call look_for_room(room_to_write) ! without it HDF5 may crash, also below
    call h5open_f(status)
    call h5eset_auto_f(0, status)
    call h5pcreate_f(H5P_FILE_ACCESS_F, access, status)
    call h5pset_fapl_core_f(access, growth, .false., status)
    call h5fcreate_f(path, H5F_ACC_TRUNC_F, file%file, status, access_prp=access)
    if (status /= 0) call fail(error, path//': the file cannot be built in memory', status_machine)
    call h5pclose_f(access, status)
  end subroutine open_result_file

  !> Ends a file and writes it; it keeps its temporary name until `keep_result_file`.
  !>
  !> Fails on all ranks when anything in it could not be written.
  subroutine close_result_file(file, error)
    type(result_file_type), intent(inout) :: file !! the file being written
    type(error_type), allocatable, intent(out) :: error !! what went wrong, if anything did
    integer(c_int8_t), allocatable :: image(:)
    integer :: status, ignored

    status = 0
    if (file%first_rank) then
      call take_image(file, image)
      if (.not. file%failed) call write_unfinished(file%path, image, .true., file%written, status)
    end if
    call MPI_Bcast(status, 1, MPI_INTEGER, 0, file%communicator, ignored)
    call share_truth(file%failed, file%communicator)
    if (file%failed) then
      call fail(error, file%path//': the file cannot be built in memory', status_machine)
    else if (status /= 0) then
      call fail(error, file%path//': the file cannot be written: '//error_words(status), &
                status_machine)
    end if
  end subroutine close_result_file

  !> The bytes of the file in memory, which is freed.
  subroutine take_image(file, image)
    type(result_file_type), intent(inout) :: file
    integer(c_int8_t), allocatable, target, intent(out) :: image(:)
    type(c_ptr) :: address
    integer(size_t) :: length
    integer :: status

    call h5fflush_f(file%file, H5F_SCOPE_GLOBAL_F, status)
    file%failed = file%failed .or. status /= 0
    address = c_null_ptr ! asks for the length
    call h5fget_file_image_f(file%file, address, 0_size_t, status, length)
    if (status == 0) then
      allocate (image(length))
      address = c_loc(image)
      call h5fget_file_image_f(file%file, address, length, status)
    end if
    file%failed = file%failed .or. status /= 0
    call h5fclose_f(file%file, status)
    file%failed = file%failed .or. status /= 0
  end subroutine take_image

  !> Gives a closed file its own name; what stood there is replaced in one step.
  !>
  !> Fails when the system refuses.
  subroutine keep_result_file(file, error)
    type(result_file_type), intent(inout) :: file !! the file being written
    type(error_type), allocatable, intent(out) :: error !! what went wrong, if anything did
    type(unfinished_file_type) :: alone(1)

    if (.not. file%first_rank) return
    alone(1) = file%written
    call publish(alone, error)
    if (.not. allocated(error)) file%written = alone(1)
  end subroutine keep_result_file

  !> Removes a file that was not kept.
  subroutine drop_result_file(file)
    type(result_file_type), intent(inout) :: file !! the file being written
    call drop_unfinished(file%written)
  end subroutine drop_result_file

  !> Adds a group.
  subroutine add_group(self, path)
    class(result_file_type), intent(inout) :: self !! the file
    character(len=*), intent(in) :: path !! of the file, or of what is in it
    integer(hid_t) :: group
    integer :: status

    if (.not. self%first_rank) return
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

    if (.not. self%first_rank) return
    call h5lexists_f(self%file, path, there, status)
    if (.not. there) call self%group(path)
  end subroutine need_group

  !> Adds a text.
  subroutine put_text(self, path, words, meaning)
    class(result_file_type), intent(inout) :: self !! the file
    character(len=*), intent(in) :: path, words, meaning !! where it goes; the text; a sentence
    integer(hid_t) :: space
    integer :: status

    if (.not. self%first_rank) return
    call h5screate_f(H5S_SCALAR_F, space, status)
    call self%put_texts(path, [words], space, meaning)
  end subroutine put_text

  !> Adds a list of words that all ranks know.
  subroutine put_words(self, path, words, meaning)
    class(result_file_type), intent(inout) :: self !! the file
    character(len=*), intent(in) :: path !! of the file, or of what is in it
    character(len=*), intent(in) :: words(:) !! blank-padded
    character(len=*), intent(in) :: meaning !! a sentence
    integer(hid_t) :: space
    integer :: status

    if (.not. self%first_rank) return
    call h5screate_simple_f(1, [size(words, kind=hsize_t)], space, status)
    call self%put_texts(path, words, space, meaning)
  end subroutine put_words

  !> Adds texts in the shape of a space, which is closed; only the first rank may.
  subroutine put_texts(self, path, words, space, meaning)
    class(result_file_type), intent(inout) :: self !! the file
    character(len=*), intent(in) :: path, meaning !! of the texts; a sentence
    character(len=*), intent(in) :: words(:) !! blank-padded
    integer(hid_t), intent(in) :: space !! of the HDF5 library
    integer(hid_t) :: kind, dataset
    integer :: status

    call text_kind(kind, status)
    call h5dcreate_f(self%file, path, kind, space, dataset, status)
    if (status /= 0) self%failed = .true.
    call self%describe(dataset, '', meaning)
    if (size(words) > 0) call write_texts(dataset, kind, words, status)
    if (status /= 0) self%failed = .true.
    call h5dclose_f(dataset, status)
    call h5sclose_f(space, status)
    call h5tclose_f(kind, status)
  end subroutine put_texts

  !> Adds numbers that all ranks know.
  subroutine put_numbers(self, path, numbers, unit, meaning)
    class(result_file_type), intent(inout) :: self !! the file
    character(len=*), intent(in) :: path !! of the file, or of what is in it
    real(wp), intent(in) :: numbers(:) !! [SI] in `unit`
    character(len=*), intent(in) :: unit, meaning !! of the numbers (1: none); a sentence
    real(wp), target :: buffer(max(1, size(numbers)))

    if (.not. self%first_rank) return
    buffer(:size(numbers)) = numbers
    call self%put_whole(path, H5T_NATIVE_DOUBLE, c_loc(buffer), 1, size(numbers), unit, meaning)
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

    if (.not. self%first_rank) return
    call look_for_room(room_to_write)
    value = number
    call h5screate_f(H5S_SCALAR_F, space, status)
    call h5dcreate_f(self%file, path, H5T_NATIVE_DOUBLE, space, dataset, status)
    if (status /= 0) self%failed = .true.
    call self%describe(dataset, unit, meaning)
    call h5dwrite_f(dataset, H5T_NATIVE_DOUBLE, c_loc(value), status)
    if (status /= 0) self%failed = .true.
    call h5dclose_f(dataset, status)
    call h5sclose_f(space, status)
  end subroutine put_scalar

  !> Adds a field of which each rank has consecutive entries; one component makes it a plain list.
  subroutine put_block(self, path, block, offset, total, unit, meaning, shape)
    class(result_file_type), intent(inout) :: self !! the file
    character(len=*), intent(in) :: path !! of the file, or of what is in it
    real(wp), intent(in) :: block(:, :) !! (components, entries of this rank), in `unit` [SI]
    integer, intent(in) :: offset, total !! entries before this rank's; of all ranks
    character(len=*), intent(in) :: unit, meaning !! of the numbers (1: none); a sentence
    integer, intent(in), optional :: shape(:) !! of an entry that is no list, fastest index first
    real(wp), target :: buffer(max(1, size(block)))

    buffer(:size(block)) = reshape(block, [size(block)])
    call self%put_parts(path, H5T_NATIVE_DOUBLE, storage_size(buffer)/8, c_loc(buffer), &
                        size(block, 1), size(block, 2), offset, total, unit, meaning, shape)
  end subroutine put_block

  !> Adds 64-bit integers of which each rank has consecutive entries.
  subroutine put_long_block(self, path, block, offset, total, meaning, shape)
    class(result_file_type), intent(inout) :: self !! the file
    character(len=*), intent(in) :: path !! of the file, or of what is in it
    integer(long), intent(in) :: block(:) !! entries of this rank
    integer, intent(in) :: offset, total !! entries before this rank's; of all ranks
    character(len=*), intent(in) :: meaning !! a sentence
    integer, intent(in), optional :: shape(:) !! of an entry that is no list, fastest index first
    integer(long), target :: buffer(max(1, size(block)))
    integer(hid_t) :: kind

    buffer(:size(block)) = block
    kind = -1
    if (self%first_rank) kind = h5kind_to_type(long, H5_INTEGER_KIND)
    call self%put_parts(path, kind, storage_size(buffer)/8, c_loc(buffer), 1, size(block), offset, &
                        total, '1', meaning, shape)
  end subroutine put_long_block

  !> Adds unsigned bytes of which each rank has consecutive entries.
  subroutine put_byte_block(self, path, block, offset, total, meaning)
    class(result_file_type), intent(inout) :: self !! the file
    character(len=*), intent(in) :: path !! of the file, or of what is in it
    integer(c_int8_t), intent(in) :: block(:) !! entries of this rank
    integer, intent(in) :: offset, total !! entries before this rank's; of all ranks
    character(len=*), intent(in) :: meaning !! a sentence
    integer(c_int8_t), target :: buffer(max(1, size(block)))

    buffer(:size(block)) = block
    call self%put_parts(path, H5T_STD_U8LE, storage_size(buffer)/8, c_loc(buffer), 1, size(block), &
                        offset, total, '1', meaning)
  end subroutine put_byte_block

  !> Brings each rank's part of a dataset to the first rank, which adds it.
  subroutine put_parts(self, path, kind, item, buffer, components, entries, offset, total, unit, &
                       meaning, shape)
    class(result_file_type), intent(inout) :: self !! the file
    character(len=*), intent(in) :: path !! of the file, or of what is in it
    integer(hid_t), intent(in) :: kind !! of the numbers
    integer, intent(in) :: item !! bytes of a number
    type(c_ptr), intent(in) :: buffer !! this rank's entries
    !> of an entry; here, before, in all
    integer, intent(in) :: components, entries, offset, total
    character(len=*), intent(in) :: unit, meaning !! of the numbers (1: none); a sentence
    integer, intent(in), optional :: shape(:) !! of an entry that is no list, fastest index first
    integer(c_int8_t), allocatable, target :: all(:)

    call gather_parts(self%communicator, self%first_rank, components*item, buffer, entries, &
                      offset, total, all)
    if (.not. self%first_rank) return
    call self%put_whole(path, kind, c_loc(all), components, total, unit, meaning, shape)
  end subroutine put_parts

  !> Adds a dataset; only the first rank may.
  subroutine put_whole(self, path, kind, buffer, components, entries, unit, meaning, shape)
    class(result_file_type), intent(inout) :: self !! the file
    character(len=*), intent(in) :: path !! of the file, or of what is in it
    integer(hid_t), intent(in) :: kind !! of the numbers
    type(c_ptr), intent(in) :: buffer !! all entries
    integer, intent(in) :: components, entries !! of an entry; in all
    character(len=*), intent(in) :: unit, meaning !! of the numbers (1: none); a sentence
    integer, intent(in), optional :: shape(:) !! of an entry that is no list, fastest index first
    integer(hsize_t), allocatable :: extent(:)
    integer(hid_t) :: space, dataset, layout
    integer :: status

    extent = int([pack([components], [components /= 1]), entries], hsize_t)
    if (present(shape)) extent = int([shape, entries], hsize_t)
    call look_for_room(room_to_write)
    call h5screate_simple_f(size(extent), extent, space, status)
    call choose_layout(extent, self%compressed, layout, status)
    if (status /= 0) self%failed = .true.
    call h5dcreate_f(self%file, path, kind, space, dataset, status, dcpl_id=layout)
    if (status /= 0) self%failed = .true.
    call self%describe(dataset, unit, meaning)
    if (entries > 0) call h5dwrite_f(dataset, kind, buffer, status)
    if (status /= 0) self%failed = .true.
    call h5dclose_f(dataset, status)
    call h5pclose_f(layout, status)
    call h5sclose_f(space, status)
  end subroutine put_whole

  !> Unit and meaning of a dataset.
  subroutine describe(self, dataset, unit, meaning)
    class(result_file_type), intent(inout) :: self !! the file
    integer(hid_t), intent(in) :: dataset !! of the HDF5 library
    character(len=*), intent(in) :: unit, meaning !! of the numbers (1: none); a sentence

    call write_text_attribute(dataset, 'unit', unit, self%failed)
    call write_text_attribute(dataset, 'meaning', meaning, self%failed)
  end subroutine describe

  !> Adds a text attribute to a group, of fixed length as VTKHDF wants it.
  subroutine mark_text(self, group, name, words)
    class(result_file_type), intent(inout) :: self !! the file
    character(len=*), intent(in) :: group, name, words !! of the file; the attribute and its text
    integer(hid_t) :: object
    integer :: status

    if (.not. self%first_rank) return
    call h5gopen_f(self%file, group, object, status)
    call write_fixed_attribute(object, name, words, self%failed)
    call h5gclose_f(object, status)
  end subroutine mark_text

  !> Adds an attribute of integers to a group; a single one has no dimension.
  subroutine mark_longs(self, group, name, numbers)
    class(result_file_type), intent(inout) :: self !! the file
    character(len=*), intent(in) :: group, name !! of the file; of the attribute
    integer(long), intent(in) :: numbers(:) !! of the attribute
    integer(long), target :: buffer(size(numbers))
    integer(hid_t) :: object, kind, space, attribute
    integer :: status

    if (.not. self%first_rank) return
    buffer = numbers
    kind = h5kind_to_type(long, H5_INTEGER_KIND)
    call h5gopen_f(self%file, group, object, status)
    call h5screate_simple_f(merge(0, 1, size(numbers) == 1), [size(numbers, kind=hsize_t)], &
                            space, status)
    call h5acreate_f(object, name, kind, space, attribute, status)
    call h5awrite_f(attribute, kind, c_loc(buffer), status)
    if (status /= 0) self%failed = .true.
    call h5aclose_f(attribute, status)
    call h5sclose_f(space, status)
    call h5gclose_f(object, status)
  end subroutine mark_longs
end module gfb_result_file
