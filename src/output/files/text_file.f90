!> Small text files, written by one rank.
module gfb_text_file
  use, intrinsic :: iso_c_binding, only: c_int8_t
  use gfb_errors, only: error_type, fail, status_input, status_machine
  use gfb_file_set, only: unfinished_file_type, write_unfinished, publish, drop_unfinished, &
                          error_words
  implicit none (type, external)
  private
  public :: write_unfinished_text, write_text_file, try_folder

  integer, parameter :: name_too_long = 36 !! errno on Linux: the command line is wrong

contains

  !> Writes a text as a file of a set that is to become visible.
  !>
  !> Fails when the system refuses.
  subroutine write_unfinished_text(path, words, file, error)
    character(len=*), intent(in) :: path !! that the file is to get
    character(len=*), intent(in) :: words !! with its line ends
    type(unfinished_file_type), intent(out) :: file !! that was written
    type(error_type), allocatable, intent(out) :: error !! what went wrong, if anything did
    integer(c_int8_t), allocatable :: bytes(:)
    integer :: status

    bytes = transfer(words, bytes, len(words))
    call write_unfinished(path, bytes, .false., file, status)
    if (status /= 0) then
      call fail(error, path//': the file cannot be written: '//error_words(status), status_machine)
    end if
  end subroutine write_unfinished_text

  !> Writes a text as a file, whole or not at all.
  !>
  !> Fails when the system refuses.
  subroutine write_text_file(path, words, error)
    character(len=*), intent(in) :: path !! of the file
    character(len=*), intent(in) :: words !! with its line ends
    type(error_type), allocatable, intent(out) :: error !! what went wrong, if anything did
    type(unfinished_file_type) :: file(1)

    call write_unfinished_text(path, words, file(1), error)
    if (allocated(error)) return
    call publish(file, error)
    call drop_unfinished(file(1))
  end subroutine write_text_file

  !> Tries whether a file can be made in a folder.
  !>
  !> Fails where none can.
  subroutine try_folder(folder, error)
    character(len=*), intent(in) :: folder !! of the results
    type(error_type), allocatable, intent(out) :: error !! why none can
    type(unfinished_file_type) :: trial
    integer :: status

    call write_unfinished(folder//'/trial', [integer(c_int8_t) ::], .false., trial, status)
    call drop_unfinished(trial)
    if (status == 0) return
    call fail(error, folder//': results cannot be written to this folder: '//error_words(status), &
              merge(status_input, status_machine, status == name_too_long))
  end subroutine try_folder
end module gfb_text_file
