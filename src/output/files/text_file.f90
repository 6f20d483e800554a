!> Small text files, written under a temporary name by one rank.
module gfb_text_file
  use gfb_errors, only: error_type, fail, status_machine
  use gfb_c_library, only: rename_file
  implicit none (type, external)
  private
  public :: write_text_file, folder_is_writable

  character(len=*), parameter :: unfinished = '.part' !! ending of a file that is being written
  !> a file that is written to see whether one can
  character(len=*), parameter :: trial = '.gfb-trial'

contains

  !> Writes a text as a file, whole or not at all.
  !>
  !> Fails when the system refuses.
  subroutine write_text_file(path, words, error)
    character(len=*), intent(in) :: path !! of the file, or of what is in it
    character(len=*), intent(in) :: words !! with its line ends
    type(error_type), allocatable, intent(out) :: error !! what went wrong, if anything did
    integer :: unit, status
    logical :: done

    open (newunit=unit, file=path//unfinished, access='stream', form='unformatted', &
          status='replace', action='write', iostat=status)
    done = status == 0
    if (done) then
      write (unit, iostat=status) words
      done = status == 0
      close (unit, iostat=status)
      done = done .and. status == 0
    end if
    if (.not. done) then
      call fail(error, path//': the file cannot be written', status_machine)
    else if (.not. rename_file(path//unfinished, path)) then
      call fail(error, path//': the file cannot be put in its place', status_machine)
    end if
  end subroutine write_text_file

  !> Whether a file can be made in a folder.
  function folder_is_writable(folder) result(writable)
    character(len=*), intent(in) :: folder !! of the results
    logical :: writable
    integer :: unit, status

    open (newunit=unit, file=folder//'/'//trial, status='replace', action='write', iostat=status)
    writable = status == 0
    if (.not. writable) return
    close (unit, status='delete', iostat=status)
    writable = status == 0
  end function folder_is_writable
end module gfb_text_file
