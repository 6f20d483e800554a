!> Reads HDF5 files back by HDF5's own C functions, apart from those that wrote them.
module hdf5_reader
  use, intrinsic :: iso_c_binding, only: c_char, c_double, c_int, c_int8_t, c_int64_t, c_loc, &
                                         c_null_char, c_ptr, c_f_pointer, c_size_t
  use gfb_kinds, only: wp, long
  implicit none (type, external)
  private
  public :: numbers_of, longs_of, text_of, attribute_of

  integer(c_int), parameter :: ascending = 1 !! H5T_DIR_ASCEND
  integer(c_int), parameter :: utf8 = 1      !! H5T_CSET_UTF8

  interface
    function h5f_open(name, flags, access) bind(c, name='H5Fopen') result(file)
      import :: c_char, c_int, c_int64_t
      implicit none (type, external)
      character(kind=c_char), intent(in) :: name(*)
      integer(c_int), value :: flags
      integer(c_int64_t), value :: access
      integer(c_int64_t) :: file
    end function h5f_open

    function h5f_close(file) bind(c, name='H5Fclose') result(status)
      import :: c_int, c_int64_t
      implicit none (type, external)
      integer(c_int64_t), value :: file
      integer(c_int) :: status
    end function h5f_close

    function h5d_open(file, name, access) bind(c, name='H5Dopen2') result(dataset)
      import :: c_char, c_int64_t
      implicit none (type, external)
      integer(c_int64_t), value :: file, access
      character(kind=c_char), intent(in) :: name(*)
      integer(c_int64_t) :: dataset
    end function h5d_open

    function h5d_close(dataset) bind(c, name='H5Dclose') result(status)
      import :: c_int, c_int64_t
      implicit none (type, external)
      integer(c_int64_t), value :: dataset
      integer(c_int) :: status
    end function h5d_close

    function h5d_read(dataset, kind, memory, space, transfer, buffer) bind(c, &
        name='H5Dread') result(status)
      import :: c_int, c_int64_t, c_ptr
      implicit none (type, external)
      integer(c_int64_t), value :: dataset, kind, memory, space, transfer
      type(c_ptr), value :: buffer
      integer(c_int) :: status
    end function h5d_read

    function h5d_type(dataset) bind(c, name='H5Dget_type') result(kind)
      import :: c_int64_t
      implicit none (type, external)
      integer(c_int64_t), value :: dataset
      integer(c_int64_t) :: kind
    end function h5d_type

    function h5t_native(kind, direction) bind(c, name='H5Tget_native_type') result(native)
      import :: c_int, c_int64_t
      implicit none (type, external)
      integer(c_int64_t), value :: kind
      integer(c_int), value :: direction
      integer(c_int64_t) :: native
    end function h5t_native

    function h5d_space(dataset) bind(c, name='H5Dget_space') result(space)
      import :: c_int64_t
      implicit none (type, external)
      integer(c_int64_t), value :: dataset
      integer(c_int64_t) :: space
    end function h5d_space

    function h5s_points(space) bind(c, name='H5Sget_simple_extent_npoints') result(points)
      import :: c_int64_t
      implicit none (type, external)
      integer(c_int64_t), value :: space
      integer(c_int64_t) :: points
    end function h5s_points

    function h5a_open(place, object, name, access, link) bind(c, &
        name='H5Aopen_by_name') result(attribute)
      import :: c_char, c_int64_t
      implicit none (type, external)
      integer(c_int64_t), value :: place, access, link
      character(kind=c_char), intent(in) :: object(*), name(*)
      integer(c_int64_t) :: attribute
    end function h5a_open

    function h5a_type(attribute) bind(c, name='H5Aget_type') result(kind)
      import :: c_int64_t
      implicit none (type, external)
      integer(c_int64_t), value :: attribute
      integer(c_int64_t) :: kind
    end function h5a_type

    function h5a_bytes(attribute) bind(c, name='H5Aget_storage_size') result(bytes)
      import :: c_int64_t
      implicit none (type, external)
      integer(c_int64_t), value :: attribute
      integer(c_int64_t) :: bytes
    end function h5a_bytes

    function h5a_read(attribute, kind, buffer) bind(c, name='H5Aread') result(status)
      import :: c_int, c_int64_t, c_ptr
      implicit none (type, external)
      integer(c_int64_t), value :: attribute, kind
      type(c_ptr), value :: buffer
      integer(c_int) :: status
    end function h5a_read

    function h5t_is_variable(kind) bind(c, name='H5Tis_variable_str') result(answer)
      import :: c_int, c_int64_t
      implicit none (type, external)
      integer(c_int64_t), value :: kind
      integer(c_int) :: answer
    end function h5t_is_variable

    function h5t_letters(kind) bind(c, name='H5Tget_cset') result(letters)
      import :: c_int, c_int64_t
      implicit none (type, external)
      integer(c_int64_t), value :: kind
      integer(c_int) :: letters
    end function h5t_letters

    pure function strlen(words) bind(c, name='strlen') result(length)
      import :: c_ptr, c_size_t
      implicit none (type, external)
      type(c_ptr), value :: words
      integer(c_size_t) :: length
    end function strlen

    function h5a_close(attribute) bind(c, name='H5Aclose') result(status)
      import :: c_int, c_int64_t
      implicit none (type, external)
      integer(c_int64_t), value :: attribute
      integer(c_int) :: status
    end function h5a_close
  end interface

contains

  !> Numbers of a dataset; none where it is not there.
  function numbers_of(path, name) result(numbers)
    character(len=*), intent(in) :: path !! of the file
    character(len=*), intent(in) :: name !! of the dataset
    real(wp), allocatable :: numbers(:)
    real(c_double), allocatable, target :: buffer(:)
    integer(c_int64_t) :: file, dataset
    integer(c_int) :: status

    allocate (numbers(0))
    file = h5f_open(path//c_null_char, 0_c_int, 0_c_int64_t)
    if (file < 0) return
    dataset = h5d_open(file, name//c_null_char, 0_c_int64_t)
    if (dataset >= 0) then
      allocate (buffer(h5s_points(h5d_space(dataset))))
      if (read_native(dataset, c_loc(buffer))) numbers = buffer
      status = h5d_close(dataset)
    end if
    status = h5f_close(file)
  end function numbers_of

  !> Whole numbers of a dataset, stored in one byte or in eight.
  function longs_of(path, name, bytes) result(numbers)
    character(len=*), intent(in) :: path !! of the file
    character(len=*), intent(in) :: name !! of the dataset
    integer, intent(in) :: bytes         !! of a stored number
    integer(long), allocatable :: numbers(:)
    integer(c_int64_t), allocatable, target :: wide(:)
    integer(c_int8_t), allocatable, target :: narrow(:)
    integer(c_int64_t) :: file, dataset
    integer(c_int) :: status

    allocate (numbers(0))
    file = h5f_open(path//c_null_char, 0_c_int, 0_c_int64_t)
    dataset = h5d_open(file, name//c_null_char, 0_c_int64_t)
    allocate (wide(h5s_points(h5d_space(dataset))))
    allocate (narrow(size(wide)))
    if (bytes == 1) then
      if (read_native(dataset, c_loc(narrow))) numbers = narrow
    else
      if (read_native(dataset, c_loc(wide))) numbers = wide
    end if
    status = h5d_close(dataset)
    status = h5f_close(file)
  end function longs_of

  !> Reads a dataset as this machine holds what is stored.
  function read_native(dataset, buffer) result(done)
    integer(c_int64_t), intent(in) :: dataset
    type(c_ptr), intent(in) :: buffer !! large enough
    logical :: done
    integer(c_int64_t) :: kind

    kind = h5t_native(h5d_type(dataset), ascending)
    done = h5d_read(dataset, kind, 0_c_int64_t, 0_c_int64_t, 0_c_int64_t, buffer) >= 0
  end function read_native

  !> Text of a dataset; a word of complaint where it is not UTF-8 of variable length.
  function text_of(path, name) result(words)
    character(len=*), intent(in) :: path !! of the file
    character(len=*), intent(in) :: name !! of the dataset
    character(len=:), allocatable :: words
    type(c_ptr), target :: place(1)
    integer(c_int64_t) :: file, dataset
    integer(c_int) :: status

    file = h5f_open(path//c_null_char, 0_c_int, 0_c_int64_t)
    dataset = h5d_open(file, name//c_null_char, 0_c_int64_t)
    words = 'not UTF-8 of variable length'
    if (is_variable(h5d_type(dataset))) then
      status = h5d_read(dataset, h5d_type(dataset), 0_c_int64_t, 0_c_int64_t, 0_c_int64_t, &
                        c_loc(place))
      words = letters_at(place(1))
    end if
    status = h5d_close(dataset)
    status = h5f_close(file)
  end function text_of

  !> Whether a type is text of variable length in UTF-8.
  function is_variable(kind) result(variable)
    integer(c_int64_t), intent(in) :: kind
    logical :: variable

    variable = h5t_is_variable(kind) > 0
    if (variable) variable = h5t_letters(kind) == utf8
  end function is_variable

  !> A text of C.
  function letters_at(place) result(words)
    type(c_ptr), intent(in) :: place
    character(len=:), allocatable :: words
    character(kind=c_char), pointer :: letters(:)
    integer :: i

    call c_f_pointer(place, letters, [strlen(place)])
    allocate (character(len=size(letters)) :: words)
    do i = 1, size(letters)
      words(i:i) = letters(i)
    end do
  end function letters_at

  !> A text attribute of a dataset or group; `Type` has a fixed length.
  function attribute_of(path, name, key) result(words)
    character(len=*), intent(in) :: path      !! of the file
    character(len=*), intent(in) :: name, key !! of dataset or group, and attribute
    character(len=:), allocatable :: words
    character(kind=c_char, len=:), allocatable, target :: buffer
    type(c_ptr), target :: place(1)
    integer(c_int64_t) :: file, attribute
    integer(c_int) :: status

    file = h5f_open(path//c_null_char, 0_c_int, 0_c_int64_t)
    attribute = h5a_open(file, name//c_null_char, key//c_null_char, 0_c_int64_t, 0_c_int64_t)
    if (is_variable(h5a_type(attribute))) then
      status = h5a_read(attribute, h5a_type(attribute), c_loc(place))
      words = letters_at(place(1))
    else
      allocate (character(len=h5a_bytes(attribute)) :: buffer)
      status = h5a_read(attribute, h5a_type(attribute), c_loc(buffer(1:1)))
      words = buffer
      if (key /= 'Type') words = 'not UTF-8 of variable length'
    end if
    status = h5a_close(attribute)
    status = h5f_close(file)
  end function attribute_of
end module hdf5_reader
