!> Files that become visible together, and the lock of the case whose they are.
!>
!> A file is written under a name of its own, which no link can stand under, and synced; `publish`
!> gives all files of a set their names, or none of them. One rank does this; `file_set.c` says how.
module gfb_file_set
  use, intrinsic :: iso_c_binding, only: c_char, c_null_char, c_int, c_int8_t, c_loc, c_ptr, &
                                         c_size_t
  use gfb_c_library, only: remove_file
  use gfb_errors, only: error_type, fail, status_machine
  use gfb_text, only: text
  implicit none (type, external)
  private
  public :: remove_unanswered, has_answer, write_unfinished, publish, drop_unfinished, &
            error_words, check_seal, lock_case, unlock_case

  character(len=*), parameter :: unanswered = '.unconverged'
  !> What is no surface; the summary, by which the others are known, is the last.
  character(len=*), parameter :: endings(*) = [character(len=9) :: &
                                               '.h5', '.csv', '.used.nml', '.summary']

  interface
    !> Removes the files of all surfaces, whatever their names, of the results that a stem names.
    subroutine c_remove_surfaces(stem) bind(c, name='gfb_remove_surfaces')
      import :: c_char
      implicit none (type, external)
      character(kind=c_char), intent(in) :: stem(*)
    end subroutine c_remove_surfaces
  end interface

  integer, parameter :: longest_name = 256 !! of a file on Linux, with the closing zero
  !> longest of the endings of a case's files
  character(len=*), parameter :: longest_ending = '.unconverged.bump_foil.steps.vtkhdf'

  !> A file that is written and not yet visible.
  type, public :: unfinished_file_type
    character(len=:), allocatable :: path          !! that it is to get
    !> that it has, in the same folder; not allocated: it was not written
    character(len=:), allocatable, private :: name
    integer(c_int), private :: descriptor = -1
  end type unfinished_file_type

  !> The lock of a case.
  type, public :: case_lock_type
    private
    character(len=:), allocatable :: name !! of the file; not allocated: there is none
    integer(c_int) :: descriptor = -1
  end type case_lock_type

  interface
    function c_write_unfinished(folder, bytes, length, sealed, name, room, file) result(status) &
      bind(c, name='gfb_write_unfinished')
      import :: c_char, c_int, c_ptr, c_size_t
      implicit none (type, external)
      character(kind=c_char), intent(in) :: folder(*)
      type(c_ptr), value :: bytes
      integer(c_size_t), value :: length, room
      integer(c_int), value :: sealed
      character(kind=c_char), intent(out) :: name(*)
      integer(c_int), intent(out) :: file
      integer(c_int) :: status
    end function c_write_unfinished

    subroutine c_drop_unfinished(folder, name, file) bind(c, name='gfb_drop_unfinished')
      import :: c_char, c_int
      implicit none (type, external)
      character(kind=c_char), intent(in) :: folder(*), name(*)
      integer(c_int), value :: file
    end subroutine c_drop_unfinished

    function c_publish(folder, count, names, length, culprit) result(status) &
      bind(c, name='gfb_publish')
      import :: c_char, c_int, c_size_t
      implicit none (type, external)
      character(kind=c_char), intent(in) :: folder(*), names(*)
      integer(c_int), value :: count
      integer(c_size_t), value :: length
      integer(c_int), intent(out) :: culprit
      integer(c_int) :: status
    end function c_publish

    subroutine c_clear_folder(folder, stem, left, name, room) bind(c, name='gfb_clear_folder')
      import :: c_char, c_int, c_size_t
      implicit none (type, external)
      character(kind=c_char), intent(in) :: folder(*), stem(*)
      integer(c_int), intent(out) :: left
      character(kind=c_char), intent(out) :: name(*)
      integer(c_size_t), value :: room
    end subroutine c_clear_folder

    function c_has_line(path, line) result(found) bind(c, name='gfb_has_line')
      import :: c_char, c_int
      implicit none (type, external)
      character(kind=c_char), intent(in) :: path(*), line(*)
      integer(c_int) :: found
    end function c_has_line

    function c_lock_case(name, file) result(status) bind(c, name='gfb_lock_case')
      import :: c_char, c_int
      implicit none (type, external)
      character(kind=c_char), intent(in) :: name(*)
      integer(c_int), intent(out) :: file
      integer(c_int) :: status
    end function c_lock_case

    function c_check_seal(path) result(status) bind(c, name='gfb_check_seal')
      import :: c_char, c_int
      implicit none (type, external)
      character(kind=c_char), intent(in) :: path(*)
      integer(c_int) :: status
    end function c_check_seal

    subroutine c_name_limits(folder, name, path) bind(c, name='gfb_name_limits')
      import :: c_char, c_int
      implicit none (type, external)
      character(kind=c_char), intent(in) :: folder(*)
      integer(c_int), intent(out) :: name, path
    end subroutine c_name_limits

    subroutine c_error_words(status, words, room) bind(c, name='gfb_error_words')
      import :: c_char, c_int, c_size_t
      implicit none (type, external)
      integer(c_int), value :: status
      character(kind=c_char), intent(out) :: words(*)
      integer(c_size_t), value :: room
    end subroutine c_error_words

    function c_close(file) result(status) bind(c, name='close')
      import :: c_int
      implicit none (type, external)
      integer(c_int), value :: file
      integer(c_int) :: status
    end function c_close
  end interface

contains

  !> Removes the state that an earlier run of a case without an answer has left: beside an answer it
  !> would be taken for it. The answer of a case that is itself called so stays.
  subroutine remove_unanswered(stem, removed)
    character(len=*), intent(in) :: stem !! folder and name of the case
    logical, intent(out) :: removed !! there was such a state
    integer :: i

    removed = says(stem//unanswered, 'converged = false')
    if (.not. removed) return
    call c_remove_surfaces(stem//unanswered//c_null_char)
    do i = 1, size(endings)
      call remove_file(stem//unanswered//trim(endings(i)))
    end do
  end subroutine remove_unanswered

  !> Whether an earlier run has left an answer of a case.
  logical function has_answer(stem) result(truth)
    character(len=*), intent(in) :: stem !! folder and name of the case
    truth = says(stem, 'converged = true')
  end function has_answer

  !> Whether a summary is there, as a plain file, and has a line.
  logical function says(stem, line) result(truth)
    character(len=*), intent(in) :: stem !! folder and name of the summary
    character(len=*), intent(in) :: line
    truth = c_has_line(stem//'.summary'//c_null_char, line//c_null_char) == 1
  end function says

  !> Writes a file that `publish` is to make visible.
  subroutine write_unfinished(path, bytes, sealed, file, status)
    character(len=*), intent(in) :: path !! that it is to get
    integer(c_int8_t), intent(in), target, contiguous :: bytes(:) !! all of them
    logical, intent(in) :: sealed !! a checksum follows the bytes
    type(unfinished_file_type), intent(out) :: file !! that was written
    integer, intent(out) :: status !! 0, or the system's error
    character(kind=c_char) :: name(longest_name)
    integer(c_int8_t), target :: nothing(1)
    type(c_ptr) :: address

    file%path = path
    nothing = 0
    address = c_loc(nothing)
    if (size(bytes) > 0) address = c_loc(bytes)
    status = int(c_write_unfinished(folder_of(path)//c_null_char, address, &
                                    size(bytes, kind=c_size_t), merge(1_c_int, 0_c_int, sealed), &
                                    name, size(name, kind=c_size_t), file%descriptor))
    if (status == 0) file%name = words_of(name)
  end subroutine write_unfinished

  !> Gives files of one folder their names, all of them or none; what stood there is replaced.
  !>
  !> Fails naming the file that could not be put in its place.
  subroutine publish(files, error)
    type(unfinished_file_type), intent(inout) :: files(:) !! all written
    type(error_type), allocatable, intent(out) :: error !! what went wrong, if anything did
    character(len=:), allocatable :: names
    integer(c_int) :: status, culprit, ignored
    integer :: i

    names = ''
    do i = 1, size(files)
      if (.not. allocated(files(i)%name)) then
        call fail(error, files(i)%path//': the file cannot be put in its place, it was not '// &
                  'written', status_machine)
        return
      end if
      names = names//files(i)%name//c_null_char//bare_name(files(i)%path)//c_null_char
    end do
    if (size(files) == 0) return
    status = c_publish(folder_of(files(1)%path)//c_null_char, size(files, kind=c_int), names, &
                       len(names, kind=c_size_t), culprit)
    if (status /= 0) then
      call fail(error, files(culprit + 1)%path//': the file cannot be put in its place: '// &
                error_words(int(status)), status_machine)
      return
    end if
    do i = 1, size(files)
      ignored = c_close(files(i)%descriptor)
      deallocate (files(i)%name)
    end do
  end subroutine publish

  !> Removes a file that was not made visible; may be called for one that was, or was never written.
  subroutine drop_unfinished(file)
    type(unfinished_file_type), intent(inout) :: file !! not used any more

    if (.not. allocated(file%name)) return
    call c_drop_unfinished(folder_of(file%path)//c_null_char, file%name//c_null_char, &
                           file%descriptor)
    deallocate (file%name)
  end subroutine drop_unfinished

  !> Compares a file with the checksum at its end: empty, or what is wrong.
  function check_seal(path) result(problem)
    character(len=*), intent(in) :: path !! of the file
    character(len=:), allocatable :: problem
    integer :: status

    status = int(c_check_seal(path//c_null_char))
    select case (status)
    case (0)
      problem = ''
    case (-1)
      problem = 'the file cannot be read: it is cut off, or not written by this version of gfb'
    case (-2)
      problem = 'the file is damaged: its contents do not fit its checksum'
    case default
      problem = 'the file cannot be read: '//error_words(status)
    end select
  end function check_seal

  !> Takes a case for this run, and clears what dead runs have left in the folder.
  !>
  !> Fails where another run has it, where the lock's place is taken, and where names of its files
  !> would be too long.
  subroutine lock_case(folder, name, lock, left, error)
    character(len=*), intent(in) :: folder !! where its files go
    character(len=*), intent(in) :: name !! of the case
    type(case_lock_type), intent(out) :: lock !! to be given back
    character(len=:), allocatable, intent(out) :: left !! what was not cleared, in words, or empty
    type(error_type), allocatable, intent(out) :: error !! what went wrong, if anything did
    integer :: status

    left = ''
    call check_lengths(folder, name, error)
    if (allocated(error)) return
    lock%name = folder//'/.gfb-lock-'//short_mark(name)
    status = int(c_lock_case(lock%name//c_null_char, lock%descriptor))
    if (status == 0) then
      left = lists_left(folder, name)
      return
    end if
    select case (status)
    case (-1)
      call fail(error, folder//'/'//name//': another run of this case writes its results here; '// &
                'wait for it, or give another folder with --output', status_machine)
    case (-2)
      call fail(error, lock%name//': no plain file stands in the place of the case''s lock; '// &
                'remove it, or give another folder with --output', status_machine)
    case default
      call fail(error, folder//': results cannot be written to this folder: '// &
                error_words(status), status_machine)
    end select
    deallocate (lock%name)
  end subroutine lock_case

  !> Whether names and paths of a case's files are short enough.
  !>
  !> Fails where they are not.
  subroutine check_lengths(folder, name, error)
    character(len=*), intent(in) :: folder, name !! where its files go; of the case
    type(error_type), allocatable, intent(out) :: error
    integer(c_int) :: longest_name, longest_path
    integer :: too_long

    call c_name_limits(folder//c_null_char, longest_name, longest_path)
    too_long = len(name//longest_ending) - int(longest_name)
    if (too_long > 0) then
      call fail(error, name//': the name of the case is too long by '//text(too_long)// &
                ' characters: its files are to be called '//name//longest_ending//' and the like')
      return
    end if
    too_long = len(folder//'/'//name//longest_ending) - int(longest_path)
    if (too_long > 0) then
      call fail(error, folder//': the path of the results is too long by '//text(too_long)// &
                ' characters, with names such as '//name//longest_ending)
    end if
  end subroutine check_lengths

  !> Clears what dead runs have left; says which lists of theirs, or of others, stay.
  function lists_left(folder, name) result(words)
    character(len=*), intent(in) :: folder, name !! where the case's files go; of the case
    character(len=:), allocatable :: words !! empty where none stays
    character(kind=c_char) :: first(longest_name)
    integer(c_int) :: left

    call c_clear_folder(folder//c_null_char, name//c_null_char, left, first, &
                        size(first, kind=c_size_t))
    words = ''
    if (left == 0) return
    words = folder//'/'//words_of(first)
    if (left > 1) words = words//' and '//text(int(left) - 1)//' more'
    words = words//': no list of files that a run of this case has left: not obeyed, stays '// &
      'as it is; where a run of another case was killed, its next run finishes it'
  end function lists_left

  !> Gives a case back.
  subroutine unlock_case(lock)
    type(case_lock_type), intent(inout) :: lock !! may be one that was never taken
    integer(c_int) :: ignored

    if (.not. allocated(lock%name)) return
    call remove_file(lock%name)
    ignored = c_close(lock%descriptor)
    deallocate (lock%name)
  end subroutine unlock_case

  !> What the system says of one of its errors.
  function error_words(status) result(words)
    integer, intent(in) :: status !! errno
    character(len=:), allocatable :: words
    character(kind=c_char) :: letters(200)

    call c_error_words(int(status, c_int), letters, size(letters, kind=c_size_t))
    words = words_of(letters)
  end function error_words

  !> Characters before the closing zero.
  pure function words_of(letters) result(words)
    character(kind=c_char), intent(in) :: letters(:)
    character(len=:), allocatable :: words
    integer :: length, i

    length = findloc(letters, c_null_char, 1) - 1
    allocate (character(len=length) :: words)
    do i = 1, length
      words(i:i) = letters(i)
    end do
  end function words_of

  !> Folder of a path.
  pure function folder_of(path) result(folder)
    character(len=*), intent(in) :: path
    character(len=:), allocatable :: folder
    integer :: slash

    slash = index(path, '/', back=.true.)
    folder = '.'
    if (slash > 0) folder = path(:slash)
  end function folder_of

  !> The rest of a path.
  pure function bare_name(path) result(name)
    character(len=*), intent(in) :: path
    character(len=:), allocatable :: name
    name = path(index(path, '/', back=.true.) + 1:)
  end function bare_name

  !> A short word for a name of any length (the hash FNV-1a).
  pure function short_mark(name) result(mark)
    character(len=*), intent(in) :: name
    character(len=8) :: mark
    integer, parameter :: long_kind = selected_int_kind(18)
    integer(long_kind) :: hash
    integer :: i

    hash = 2166136261_long_kind
    do i = 1, len(name)
      hash = ieor(hash, int(iachar(name(i:i)), long_kind))
      hash = iand(hash*16777619_long_kind, 4294967295_long_kind)
    end do
    write (mark, '(z8.8)') hash
  end function short_mark
end module gfb_file_set
