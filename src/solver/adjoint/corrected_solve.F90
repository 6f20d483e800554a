#include "gfb_petsc.h"
!> Linear systems of an answer's tangent, by factors of a matrix that is close.
module gfb_corrected_solve
  use petscmat
  use gfb_kinds, only: wp
  use gfb_newton, only: newton_type, solve_with_factors, solve_transposed
  implicit none (type)
  private
  public :: solve_corrected

  !> residual, over the right side: where stiff contacts have most of that little is left to films [1]
  real(wp), parameter :: enough = 1.0e-14_wp
  integer, parameter :: most_corrections = 10   !! the factors may be those of a matrix close by

contains

  !> Solves a system, or the transposed one, with factors of a matrix that is close, and corrects the solution.
  subroutine solve_corrected(newton, tangent, right, solution, transposed, solved)
    type(newton_type), intent(in) :: newton !! with the factors of `find_determinant_sign`
    Mat, intent(in) :: tangent !! the matrix
    Vec, intent(in) :: right    !! scaled
    Vec, intent(in) :: solution !! scaled; is overwritten
    logical, intent(in) :: transposed !! the matrix is
    logical, intent(out) :: solved !! the solution meets the equations
    real(wp), parameter :: useful = 0.1_wp   ! share of the residual that a correction leaves
    real(wp), parameter :: accepted = 1.0e-8_wp ! residual over the right side
    Vec :: left, correction
    PetscReal :: whole, norm, before
    PetscErrorCode :: ierr
    integer :: i

    PetscCallA(VecDuplicate(right, left, ierr))
    PetscCallA(VecDuplicate(right, correction, ierr))
    PetscCallA(VecSet(solution, 0.0_wp, ierr))
    PetscCallA(VecCopy(right, left, ierr))
    PetscCallA(VecNorm(right, NORM_2, whole, ierr))
    norm = whole
    do i = 1, most_corrections
      before = norm
      if (before <= enough*whole) exit
      if (transposed) then
        call solve_transposed(newton, left, correction)
      else
        call solve_with_factors(newton, left, correction)
      end if
      PetscCallA(VecAXPY(solution, 1.0_wp, correction, ierr))
      if (transposed) then
        PetscCallA(MatMultTranspose(tangent, solution, left, ierr))
      else
        PetscCallA(MatMult(tangent, solution, left, ierr))
      end if
      PetscCallA(VecAYPX(left, -1.0_wp, right, ierr))
      PetscCallA(VecNorm(left, NORM_2, norm, ierr))
      if (.not. norm <= useful*before) exit
    end do
    solved = norm <= accepted*whole
    PetscCallA(VecDestroy(correction, ierr))
    PetscCallA(VecDestroy(left, ierr))
  end subroutine solve_corrected
end module gfb_corrected_solve
