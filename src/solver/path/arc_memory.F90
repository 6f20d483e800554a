#include "gfb_petsc.h"
!> What an arc remembers from step to step, beside its vectors.
module gfb_arc_memory
  use petscvec
  use gfb_memory, only: memory_type
  use gfb_arc, only: arc_type
  use gfb_newton, only: forget_factors
  implicit none (type)
  private
  public :: remember_arc, resume_arc

contains

  !> Packs or unpacks all but the vectors.
  subroutine remember_arc(memory, arc)
    type(memory_type), intent(inout) :: memory !! that packs or unpacks
    type(arc_type), intent(inout) :: arc !! written where the memory unpacks

    call memory%visit('lambda', arc%lambda)
    call memory%visit('lambda_before', arc%lambda_before)
    call memory%visit('lambda_earlier', arc%lambda_earlier)
    call memory%visit('heading', arc%heading)
    call memory%visit('step', arc%step)
    call memory%visit('last_length', arc%last_length)
    call memory%visit('earlier_step', arc%earlier_step)
    call memory%visit('step_limit', arc%step_limit)
    call memory%visit('orientation', arc%orientation)
    call memory%visit('retreats', arc%retreats)
    call memory%visit('steps', arc%steps)
    call memory%visit('turned', arc%turned)
    call memory%visit('newton_iterations', arc%newton%iterations)
    call memory%visit('factorizations', arc%newton%factorizations)
  end subroutine remember_arc

  !> Puts the bearing at an arc's last answer, when vectors and memory are those of an arc before.
  subroutine resume_arc(arc)
    type(arc_type), intent(inout) :: arc !! as its memory and vectors were read

    call arc%return_to()
    call forget_factors(arc%newton)
  end subroutine resume_arc
end module gfb_arc_memory
