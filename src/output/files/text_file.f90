!> Small text files, written by one rank.
module gfb_text_file
  use, intrinsic :: iso_c_binding, only: c_int8_t
  use gfb_errors, only: error_type, fail, status_input, status_machine
  use gfb_file_set, only: unfinished_file_type, write_unfinished, publish, drop_unfinished, &
                          error_words
  use gfb_archive, only: archive_type
  use gfb_quantity, only: quantity_type
  use gfb_result_names, only: result_meaning
  use gfb_case_file, only: history_row_type, write_quantities, write_history, visit_rows
  use gfb_result_file, only: result_file_type, open_result_file, close_result_file
  implicit none (type, external)
  private
  public :: write_unfinished_text, write_text_file, try_folder, write_table_file, visit_member

  integer, parameter :: name_too_long = 36 !! errno on Linux: the command line is wrong

  !> What a member of the table is, and how it ended.
  type, public :: table_member_type
    character(len=:), allocatable :: name   !! of its case file, without folder and ending
    character(len=:), allocatable :: reason !! why there is no answer; empty where there is one
    integer :: status = 0                   !! exit status that gfb would have had
    integer :: group = 0                    !! of ranks that computed it
    type(history_row_type) :: row           !! its summary
  end type table_member_type

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

  !> Writes the file under its temporary name.
  !>
  !> Fails when it cannot be written.
  subroutine write_table_file(path, communicator, provenance, summary, members, &
                              file, error)
    character(len=*), intent(in) :: path !! of the file, or of what is in it
    integer, intent(in) :: communicator !! MPI's, of one rank
    type(quantity_type), intent(in) :: provenance(:), summary(:) !! the answer
    type(table_member_type), intent(in) :: members(:) !! a row each
    type(result_file_type), intent(out) :: file !! the file being written
    type(error_type), allocatable, intent(out) :: error !! what went wrong, if anything did
    character(len=:), allocatable :: names(:), reasons(:)
    type(history_row_type) :: rows(size(members))
    integer :: i, length

    length = longest(members)
    allocate (character(len=length) :: names(size(members)), reasons(size(members)))
    do i = 1, size(members)
      names(i) = members(i)%name
      reasons(i) = members(i)%reason
      rows(i) = members(i)%row
    end do
    call open_result_file(path, communicator, .true., file, error)
    if (allocated(error)) return
    call write_quantities(file, '/provenance', provenance)
    call write_quantities(file, '/summary', summary)
    call write_history(file, rows)
    call file%put_words('/history/member', names, result_meaning('member'))
    call file%put_words('/history/reason', reasons, result_meaning('reason'))
    call close_result_file(file, error)
  end subroutine write_table_file

  !> Length of the longest word there is to write.
  pure integer function longest(members) result(length)
    type(table_member_type), intent(in) :: members(:)
    integer :: i

    length = 1
    do i = 1, size(members)
      length = max(length, len(members(i)%name), len(members(i)%reason))
    end do
  end function longest

  !> Saves or restores a member.
  pure subroutine visit_member(archive, member)
    type(archive_type), intent(inout) :: archive !! that saves or restores
    type(table_member_type), intent(inout) :: member !! written where the archive restores
    type(history_row_type), allocatable :: rows(:)

    call archive%visit('name', member%name)
    call archive%visit('reason', member%reason)
    call archive%visit('status', member%status)
    call archive%visit('group', member%group)
    allocate (rows(1))
    rows(1) = member%row
    call visit_rows(archive, rows)
    if (archive%saves) return
    call archive%require(size(rows) == 1, 'the row of a member')
    if (.not. archive%failed) member%row = rows(1)
  end subroutine visit_member
end module gfb_text_file
