!> What a summary says of how its run ended, and of the program: whoever finds the file later
!> knows by them whether to compute the case again.
module gfb_outcome
  use gfb_quantity, only: quantity_type, add_quantity, place_of
  use gfb_result_names, only: add_result
  use gfb_provenance, only: program_words
  use gfb_reasons, only: reason_type
  use gfb_text, only: one_line
  implicit none (type, external)
  private
  public :: add_outcome

contains

  !> Puts outcome and reason of a run without an answer behind `converged`, the program at the end.
  subroutine add_outcome(summary, converged, reason)
    type(quantity_type), allocatable, intent(inout) :: summary(:) !! of the run
    logical, intent(in) :: converged !! there is an answer
    type(reason_type), intent(in), optional :: reason !! why there is none
    type(quantity_type), allocatable :: list(:)
    integer :: place

    if (present(reason) .and. .not. converged) then
      place = place_of('converged', summary)
      call add_quantity(list, summary(:place))
      call add_result(list, 'outcome', reason%outcome())
      if (reason%words() /= '') call add_result(list, 'reason', one_line(reason%words()))
      call add_quantity(list, summary(place + 1:))
      call move_alloc(list, summary)
    end if
    call add_result(summary, 'program', program_words())
  end subroutine add_outcome
end module gfb_outcome
