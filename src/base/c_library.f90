!> The few calls of the C library that Fortran lacks.
module gfb_c_library
  use, intrinsic :: iso_c_binding, only: c_char, c_int, c_long, c_null_char
  use gfb_kinds, only: wp
  implicit none (type, external)
  private
  public :: make_folder, remove_file, exit_with_status, peak_memory, host_name, text_of, is_terminal

  integer(c_int), parameter :: folder_mode = int(o'777', c_int) !! the user's umask takes its part
  integer, parameter :: usage_words = 18 !! length of struct rusage on 64-bit Unix [8 bytes]
  integer, parameter :: usage_peak = 5   !! where its largest resident size stands

  interface
    function c_mkdir(path, mode) result(status) bind(c, name='mkdir')
      import :: c_char, c_int
      implicit none (type, external)
      character(kind=c_char), intent(in) :: path(*)
      integer(c_int), value :: mode
      integer(c_int) :: status
    end function c_mkdir

    function c_remove(path) result(status) bind(c, name='unlink')
      import :: c_char, c_int
      implicit none (type, external)
      character(kind=c_char), intent(in) :: path(*)
      integer(c_int) :: status
    end function c_remove

    subroutine c_exit(status) bind(c, name='exit')
      import :: c_int
      implicit none (type, external)
      integer(c_int), value :: status
    end subroutine c_exit

    function c_getrusage(who, usage) result(status) bind(c, name='getrusage')
      import :: c_int, c_long
      implicit none (type, external)
      integer(c_int), value :: who
      integer(c_long), intent(out) :: usage(*)
      integer(c_int) :: status
    end function c_getrusage

    function c_gethostname(name, length) result(status) bind(c, name='gethostname')
      import :: c_char, c_int, c_long
      implicit none (type, external)
      character(kind=c_char), intent(out) :: name(*)
      integer(c_long), value :: length
      integer(c_int) :: status
    end function c_gethostname

    function c_isatty(unit) result(status) bind(c, name='isatty')
      import :: c_int
      implicit none (type, external)
      integer(c_int), value :: unit
      integer(c_int) :: status
    end function c_isatty
  end interface

contains

  !> Makes a folder and those above it; no failure where it exists already.
  subroutine make_folder(path)
    character(len=*), intent(in) :: path !! of the file or folder
    integer(c_int) :: ignored
    integer :: i

    do i = 2, len_trim(path)
      if (path(i:i) == '/') ignored = c_mkdir(path(:i - 1)//c_null_char, folder_mode)
    end do
    ignored = c_mkdir(trim(path)//c_null_char, folder_mode)
  end subroutine make_folder

  !> Removes a file, or a link in its place, if it exists.
  subroutine remove_file(path)
    character(len=*), intent(in) :: path !! of the file
    integer(c_int) :: ignored
    ignored = c_remove(trim(path)//c_null_char)
  end subroutine remove_file

  !> Ends the process with an exit status and without a word.
  subroutine exit_with_status(status)
    integer, intent(in) :: status !! exit status of the program
    call c_exit(int(status, c_int))
  end subroutine exit_with_status

  !> Whether what is written goes to a terminal. Under a launcher: no, as Open MPI gives
  !> ranks a pseudo-terminal wherever the output goes.
  function is_terminal(unit)
    integer, intent(in) :: unit !! of the system: 1 output, 2 errors
    logical :: is_terminal
    integer :: launched

    call get_environment_variable('PMIX_RANK', length=launched)
    is_terminal = c_isatty(int(unit, c_int)) == 1 .and. launched == 0
  end function is_terminal

  !> Largest memory this process has used [B].
  real(wp) function peak_memory() result(bytes)
    integer(c_long) :: usage(usage_words)

    usage = 0
    bytes = 0.0_wp
    if (c_getrusage(0_c_int, usage) == 0) bytes = 1024.0_wp*real(usage(usage_peak), wp)
  end function peak_memory

  !> Name of the machine this process runs on.
  function host_name() result(name)
    character(len=:), allocatable :: name
    character(kind=c_char) :: letters(256)

    letters = c_null_char
    name = ''
    if (c_gethostname(letters, 255_c_long) /= 0) return
    name = text_of(letters)
  end function host_name

  !> Letters of C as text, up to their null.
  pure function text_of(letters) result(words)
    character(kind=c_char), intent(in) :: letters(:) !! all of them, where there is no null
    character(len=:), allocatable :: words
    integer :: i

    words = ''
    do i = 1, size(letters)
      if (letters(i) == c_null_char) exit
      words = words//letters(i)
    end do
  end function text_of
end module gfb_c_library
