!> The characters of a case file, read once.
module gfb_case_text
  use, intrinsic :: iso_c_binding, only: c_char, c_int, c_null_char, c_size_t
  use, intrinsic :: iso_fortran_env, only: iostat_end
  use gfb_kinds, only: long, wp
  use gfb_errors, only: error_type, fail, status_input
  use gfb_text, only: text
  implicit none (type, external)
  private
  public :: read_case_text, read_standard_input

  character(len=*), parameter :: end_mark = achar(26) !! Ctrl-Z, of a text's last line
  character(len=*), parameter :: printed = '&$! '//achar(9)//achar(10)//achar(13) !! what begins one
  integer(long), parameter :: longest = 1000000_long !! bytes; a case file has some thousand

  interface
    function gfb_is_no_file(path) result(answer) bind(c)
      import :: c_char, c_int
      implicit none (type, external)
      character(kind=c_char), intent(in) :: path(*)
      integer(c_int) :: answer
    end function gfb_is_no_file

    function c_read(unit, bytes, most) result(taken) bind(c, name='read')
      import :: c_char, c_int, c_size_t
      implicit none (type, external)
      integer(c_int), value :: unit
      character(kind=c_char), intent(out) :: bytes(*)
      integer(c_size_t), value :: most
      integer(c_size_t) :: taken
    end function c_read
  end interface

contains

  !> All bytes of a case file.
  !>
  !> Fails when it does not exist, is a folder, cannot be read, is empty, too long or binary.
  subroutine read_case_text(file, words, error)
    character(len=*), intent(in) :: file !! name of the case file
    character(len=:), allocatable, intent(out) :: words
    type(error_type), allocatable, intent(out) :: error !! what went wrong, if anything did
    character(len=:), allocatable :: problem

    words = ''
    call look_at_file(file, problem)
    if (problem == '') call read_bytes(file, words, problem)
    if (problem == '') call look_at_bytes(words, problem)
    if (problem /= '') call fail(error, trim(file)//': '//problem, status_input)
  end subroutine read_case_text

  !> All bytes of the standard input, up to its end.
  !>
  !> The problem is empty where it is a text.
  subroutine read_standard_input(words, problem)
    character(len=:), allocatable, intent(out) :: words !! that were read
    character(len=:), allocatable, intent(out) :: problem !! in words
    integer, parameter :: at_once = 4096 !! bytes
    character(kind=c_char) :: bytes(at_once)
    character(len=at_once) :: piece
    integer(c_size_t) :: taken

    words = ''
    problem = ''
    do
      taken = c_read(0_c_int, bytes, int(at_once, c_size_t))
      if (taken <= 0) exit
      piece = transfer(bytes, piece)
      words = words//piece(:taken)
      if (len(words) > longest) exit
    end do
    if (taken < 0) problem = 'the standard input cannot be read'
    if (problem == '' .and. words == '') problem = 'the standard input is empty'
    if (len(words) > longest) problem = 'the standard input has more than the limit of '// &
                                        megabytes(longest)
    if (problem == '') call look_at_bytes(words, problem)
  end subroutine read_standard_input

  !> Drops the mark with which some systems end a text, and says what makes it none.
  pure subroutine look_at_bytes(words, problem)
    character(len=:), allocatable, intent(inout) :: words !! all bytes
    character(len=:), allocatable, intent(out) :: problem !! empty where it is a text
    character(len=*), parameter :: white = ' '//achar(9)//achar(10)//achar(13)
    integer :: mark

    mark = index(words, end_mark)
    if (mark > 0) then
      if (verify(words(mark:), end_mark//white) == 0) words = words(:mark - 1)
    end if
    problem = ''
    if (words == '') problem = 'the case file is empty'
    if (is_wide(words)) problem = 'is UTF-16 or UTF-32, whose characters have several bytes '// &
                                  'each; save it as UTF-8'
    if (problem == '') problem = binary_problem(words)
  end subroutine look_at_bytes

  !> Whether a text is of characters of two or four bytes: its mark shows it, or a zero byte in its
  !> first character.
  pure logical function is_wide(words) result(wide)
    character(len=*), intent(in) :: words
    character(len=*), parameter :: little = char(255)//char(254), big = char(254)//char(255)

    wide = index(words, little) == 1 .or. index(words, big) == 1
    if (wide .or. len(words) < 4) return
    wide = scan(words(:2), achar(0)) > 0 .and. scan(words(:4), printed) > 0
  end function is_wide

  !> What keeps a file from being opened at all; a pipe would be waited for without end, and its
  !> size is zero.
  subroutine look_at_file(file, problem)
    character(len=*), intent(in) :: file
    character(len=:), allocatable, intent(out) :: problem
    integer(long) :: bytes
    logical :: there, folder

    problem = ''
    if (len_trim(file) == 0) then
      problem = 'the name of the case file is empty'
      return
    end if
    inquire (file=trim(file), exist=there)
    if (.not. there) then
      problem = 'the case file does not exist'
      return
    end if
    inquire (file=trim(file)//'/.', exist=folder)
    if (folder) then
      problem = 'is a folder, not a case file'
      return
    end if
    if (gfb_is_no_file(trim(file)//c_null_char) /= 0) then
      problem = 'is a pipe, a terminal or another device, not a case file; save its text as a file'
      return
    end if
    inquire (file=trim(file), size=bytes)
    if (bytes == 0) problem = 'the case file is empty'
    if (bytes > longest) problem = 'the case file has '//megabytes(bytes)// &
                                   ', more than the limit of '//megabytes(longest)
  end subroutine look_at_file

  !> Reads the file as a stream of characters.
  subroutine read_bytes(file, words, problem)
    character(len=*), intent(in) :: file
    character(len=:), allocatable, intent(out) :: words, problem
    character(len=200) :: message
    integer(long) :: bytes
    integer :: unit, status

    problem = ''
    words = ''
    message = ''
    open (newunit=unit, file=trim(file), access='stream', form='unformatted', action='read', &
          status='old', iostat=status, iomsg=message)
    if (status == 0) then
      inquire (unit=unit, size=bytes)
      bytes = max(0_long, min(bytes, longest))
      deallocate (words)
      allocate (character(len=bytes) :: words)
      read (unit, iostat=status, iomsg=message) words
      close (unit)
    end if
    if (status == iostat_end) message = 'it became shorter while it was read'
    if (status /= 0) problem = 'the case file cannot be read: '//trim(message)
  end subroutine read_bytes

  !> Says where a file holds characters that no text has.
  pure function binary_problem(words) result(problem)
    character(len=*), intent(in) :: words
    character(len=:), allocatable :: problem
    integer :: i, code, line

    problem = ''
    line = 1
    do i = 1, len(words)
      code = iachar(words(i:i))
      if (code == 10) line = line + 1
      if ((code < 32 .and. (code < 9 .or. code > 13)) .or. code == 127) then
        problem = 'is binary, not a text file: line '//text(line)// &
                  ' holds the control character '//text(code)
        return
      end if
    end do
  end function binary_problem

  !> A size in MB.
  pure function megabytes(bytes) result(words)
    integer(long), intent(in) :: bytes
    character(len=:), allocatable :: words
    words = text(real(bytes, wp)*1.0e-6_wp, 4)//' MB'
  end function megabytes
end module gfb_case_text
