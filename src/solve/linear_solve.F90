#include "gfb_petsc.h"
!> One linear solve with a symmetric positive definite matrix.
module gfb_linear_solve
  use petscksp
  use gfb_errors, only: error_type, fail, status_machine
  implicit none (type)
  private
  public :: solve_definite

contains

  !> Solves by Cholesky factorization.
  !>
  !> Fails when the matrix is not positive definite: the structure can move without force.
  subroutine solve_definite(matrix, force, prefix, solution, error)
    Mat, intent(in) :: matrix
    Vec, intent(in) :: force
    character(len=*), intent(in) :: prefix !! of PETSc's options
    Vec, intent(in) :: solution
    type(error_type), allocatable, intent(out) :: error

    KSP :: solver
    PC :: factors
    KSPConvergedReason :: reason
    PetscErrorCode :: ierr

    PetscCallA(MatSetOption(matrix, MAT_SPD, PETSC_TRUE, ierr))
    PetscCallA(KSPCreate(PETSC_COMM_WORLD, solver, ierr))
    PetscCallA(KSPSetOptionsPrefix(solver, prefix, ierr))
    PetscCallA(KSPSetOperators(solver, matrix, matrix, ierr))
    PetscCallA(KSPSetType(solver, KSPPREONLY, ierr))
    PetscCallA(KSPGetPC(solver, factors, ierr))
    PetscCallA(PCSetType(factors, PCCHOLESKY, ierr))
    PetscCallA(PCFactorSetMatSolverType(factors, MATSOLVERMUMPS, ierr))
    PetscCallA(KSPSetFromOptions(solver, ierr))
    PetscCallA(KSPSolve(solver, force, solution, ierr))
    PetscCallA(KSPGetConvergedReason(solver, reason, ierr))
    if (GFB_REASON(reason) < 0) then
      call fail(error, 'the structure is not held: it can move without force', status_machine)
    end if
    PetscCallA(KSPDestroy(solver, ierr))
  end subroutine solve_definite
end module gfb_linear_solve
