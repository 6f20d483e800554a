#include "gfb_petsc.h"
!> How firmly the top foil's free edge rests at an answer.
module gfb_edge_stiffness
  use petscvec
  use gfb_kinds, only: wp
  use gfb_petsc_session, only: any_rank
  use gfb_bearing_system, only: bearing_system_type
  use gfb_bearing_directions, only: edge_direction
  use gfb_newton, only: newton_type, solve_with_factors
  implicit none (type)
  private
  public :: find_edge_stiffness

  real(wp), parameter :: probe = 1.0e-3_wp !! force on the edge, over the size of a force; the answer is linear in it [1]

contains

  !> Force that lifts the free edge over its mean displacement, with film, foils and shaft following: \( 1/(e^T J^{-1} e) \).
  !> Below zero the edge moves on by itself.
  subroutine find_edge_stiffness(bearing, newton, known, stiffness)
    type(bearing_system_type), intent(inout) :: bearing !! at an answer, and at the same one after
    type(newton_type), intent(in) :: newton !! with the factors of `find_determinant_sign`
    logical, intent(out) :: known !! there is a free edge, and it moves
    real(wp), intent(out) :: stiffness !! of the edge [N/m]
    Vec :: without, with, edge
    real(wp) :: pull, pull_before, lift
    logical :: valid
    PetscErrorCode :: ierr

    stiffness = 0.0_wp
    known = any_rank(size(bearing%pad(1)%edge%unknown) > 0)
    if (.not. known) return
    PetscCallA(VecDuplicate(bearing%state, without, ierr))
    PetscCallA(VecDuplicate(bearing%state, with, ierr))
    PetscCallA(VecDuplicate(bearing%state, edge, ierr))
    pull = probe*bearing%force_scale()
    call bearing%evaluate(bearing%state, without, valid)
    pull_before = bearing%point%edge_pull
    bearing%point%edge_pull = pull_before + pull
    call bearing%evaluate(bearing%state, with, valid)
    bearing%point%edge_pull = pull_before
    PetscCallA(VecAXPY(without, -1.0_wp, with, ierr))
    call solve_with_factors(newton, without, with)
    call edge_direction(bearing, edge)
    PetscCallA(VecDot(edge, with, lift, ierr))
    lift = lift*bearing%pad(1)%film%clearance
    known = abs(lift) > 0.0_wp
    if (known) stiffness = pull/lift
    PetscCallA(VecDestroy(without, ierr))
    PetscCallA(VecDestroy(with, ierr))
    PetscCallA(VecDestroy(edge, ierr))
  end subroutine find_edge_stiffness
end module gfb_edge_stiffness
