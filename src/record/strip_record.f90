!> What is kept of a strip's load steps.
module gfb_strip_record
  use gfb_strip_answer, only: strip_answer_type
  use gfb_strip_companions, only: companions_type
  use gfb_case_file, only: history_row_type
  use gfb_contact_record, only: contact_record_type
  implicit none (type, external)
  private

  !> What a run gathers.
  type, public :: strip_run_type
    type(strip_answer_type) :: full, last !! at the largest load, and of the last step
    type(history_row_type), allocatable :: history(:)
    type(contact_record_type) :: contacts
    type(companions_type) :: companions
    integer :: steps = 0                  !! done
    logical :: converged = .true.
  end type strip_run_type
end module gfb_strip_record
