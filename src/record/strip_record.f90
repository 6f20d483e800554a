!> What is kept of a strip's load steps.
module gfb_strip_record
  use gfb_memory, only: memory_type
  use gfb_strip_answer, only: strip_answer_type, remember_answer
  use gfb_strip_companions, only: companions_type
  use gfb_case_file, only: history_row_type
  use gfb_row_memory, only: remember_rows
  use gfb_contact_record, only: contact_record_type
  implicit none (type, external)
  private
  public :: remember_run

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

  !> Packs or unpacks a run but for the contacts; one that is unpacked knows its number of bumps.
  pure subroutine remember_run(memory, run)
    type(memory_type), intent(inout) :: memory !! that packs or unpacks
    type(strip_run_type), intent(inout) :: run !! written where the memory unpacks

    call memory%part('history')
    call remember_rows(memory, run%history)
    call memory%part('full')
    call remember_answer(memory, run%full)
    call memory%part('last')
    call remember_answer(memory, run%last)
    call memory%visit('steps', run%steps)
  end subroutine remember_run
end module gfb_strip_record
