#include "gfb_petsc.h"
!> How firmly the free edge of each pad's top foil rests at an answer.
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

  !> Force that lifts a pad's free edge over its mean displacement, with films, foils and shaft following:
  !> \( 1/(e^T J^{-1} e) \). Below zero the edge moves on by itself.
  subroutine find_edge_stiffness(bearing, newton, known, stiffness)
    type(bearing_system_type), intent(inout) :: bearing !! at an answer, and at the same one after
    type(newton_type), intent(in) :: newton !! with the factors of `find_determinant_sign`
    logical, allocatable, intent(out) :: known(:) !! each pad has a free edge, and it moves
    real(wp), allocatable, intent(out) :: stiffness(:) !! of each edge [N/m]
    Vec :: force, own, change, edge
    real(wp) :: lift
    PetscErrorCode :: ierr
    integer :: i

    allocate (stiffness(size(bearing%pad)), source=0.0_wp)
    known = [(any_rank(size(bearing%pad(i)%edge%unknown) > 0), i=1, size(bearing%pad))]
    if (.not. any(known)) return
    PetscCallA(VecDuplicate(bearing%state, force, ierr))
    PetscCallA(VecDuplicate(bearing%state, own, ierr))
    PetscCallA(VecDuplicate(bearing%state, change, ierr))
    PetscCallA(VecDuplicate(bearing%state, edge, ierr))
    call lifting_force(bearing, change, force)
    do i = 1, size(bearing%pad)
      call keep_pad(bearing, i, force, own)
      call solve_with_factors(newton, own, change)
      call edge_direction(bearing, edge, i)
      PetscCallA(VecDot(edge, change, lift, ierr))
      lift = lift*bearing%pad(1)%film%clearance
      known(i) = abs(lift) > 0.0_wp
      if (known(i)) stiffness(i) = probe*bearing%force_scale()/lift
    end do
    PetscCallA(VecDestroy(force, ierr))
    PetscCallA(VecDestroy(own, ierr))
    PetscCallA(VecDestroy(change, ierr))
    PetscCallA(VecDestroy(edge, ierr))
  end subroutine find_edge_stiffness

  !> How a force on the edges of all pads changes the equations.
  subroutine lifting_force(bearing, work, force)
    type(bearing_system_type), intent(inout) :: bearing !! is left as it is
    Vec, intent(in) :: work  !! is overwritten
    Vec, intent(in) :: force !! taken away from the residual, scaled
    real(wp) :: pull_before(size(bearing%point%edge_pull))
    logical :: valid
    PetscErrorCode :: ierr

    call bearing%evaluate(bearing%state, force, valid)
    pull_before = bearing%point%edge_pull
    bearing%point%edge_pull = pull_before + probe*bearing%force_scale()
    call bearing%evaluate(bearing%state, work, valid)
    bearing%point%edge_pull = pull_before
    PetscCallA(VecAXPY(force, -1.0_wp, work, ierr))
  end subroutine lifting_force

  !> What of a vector belongs to the equations of one pad.
  subroutine keep_pad(bearing, pad, vector, own)
    type(bearing_system_type), intent(in) :: bearing
    integer, intent(in) :: pad !! its number
    Vec, intent(in) :: vector, own
    PetscScalar, pointer :: values(:)
    PetscErrorCode :: ierr

    PetscCallA(VecCopy(vector, own, ierr))
    PetscCallA(GFB_VecGetArray(own, values, ierr))
    associate (before => bearing%blocks%first_owned(2*pad - 1), last => bearing%blocks%first_owned(2*pad + 1))
      values(:before) = 0.0_wp
      values(last + 1:) = 0.0_wp
    end associate
    PetscCallA(GFB_VecRestoreArray(own, values, ierr))
  end subroutine keep_pad
end module gfb_edge_stiffness
