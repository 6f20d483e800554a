!> What is kept of a strip's load steps.
module gfb_strip_record
  use gfb_archive, only: archive_type
  use gfb_strip_answer, only: strip_answer_type, visit_answer
  use gfb_strip_companions, only: companions_type
  use gfb_case_file, only: history_row_type, visit_rows
  use gfb_contact_record, only: contact_record_type
  implicit none (type, external)
  private
  public :: visit_run

  !> What a run gathers.
  type, public :: strip_run_type
    type(strip_answer_type) :: full, last !! at the largest load, and of the last step
    type(history_row_type), allocatable :: history(:)
    type(contact_record_type) :: contacts
    type(companions_type) :: companions
    integer :: steps = 0                  !! done
    logical :: converged = .true.
  end type strip_run_type

contains

  !> Saves or restores a run but for the contacts; one that is restored knows its number of bumps.
  pure subroutine visit_run(archive, run)
    type(archive_type), intent(inout) :: archive !! that saves or restores
    type(strip_run_type), intent(inout) :: run !! written where the archive restores

    call archive%part('history')
    call visit_rows(archive, run%history)
    call archive%part('full')
    call visit_answer(archive, run%full)
    call archive%part('last')
    call visit_answer(archive, run%last)
    call archive%visit('steps', run%steps)
  end subroutine visit_run
end module gfb_strip_record
