#include "gfb_petsc.h"
!> Linear systems of an answer's tangent, by factors of a matrix that is close, or by iterations where the system has a coarse space for them.
!>
!> Iterations of the transposed system have levels of their own: the smoother and the coarse space of the matrix serve its transposed,
!> too.
module gfb_corrected_solve
  use petscksp
  use gfb_kinds, only: wp
  use gfb_nonlinear_system, only: nonlinear_system_type
  use gfb_linear_solver, only: use_multigrid
  use gfb_newton, only: newton_type, solve_with_factors, solve_transposed
  implicit none (type)
  private
  public :: solve_corrected

  !> residual, over the right side: where stiff contacts have most of that little is left to films [1]
  real(wp), parameter :: enough = 1.0e-14_wp
  integer, parameter :: most_corrections = 10   !! the factors may be those of a matrix close by
  character(len=*), parameter :: prefix = 'adjoint_'     !! of PETSc's options of iterations
  real(wp), parameter :: of_iterations = 1.0e-8_wp !! residual that a correction by iterations leaves, over the one before [1]

contains

  !> Solves a system, or the transposed one, with factors of a matrix that is close or by iterations, and corrects the solution.
  subroutine solve_corrected(newton, system, tangent, right, solution, transposed, solved)
    type(newton_type), intent(in) :: newton !! with the factors of `find_determinant_sign`, or none
    class(nonlinear_system_type), intent(in) :: system !! newton's, with a coarse space where it iterates
    Mat, intent(in) :: tangent !! the matrix
    Vec, intent(in) :: right    !! scaled
    Vec, intent(in) :: solution !! scaled; is overwritten
    logical, intent(in) :: transposed !! the matrix is
    logical, intent(out) :: solved !! the solution meets the equations
    real(wp), parameter :: useful = 0.1_wp   ! share of the residual that a correction leaves
    real(wp), parameter :: accepted = 1.0e-8_wp ! residual over the right side
    Vec :: left, correction
    KSP :: linear
    Mat :: matrix
    PetscReal :: whole, norm, before
    PetscErrorCode :: ierr
    integer :: i

    PetscCallA(VecDuplicate(right, left, ierr))
    PetscCallA(VecDuplicate(right, correction, ierr))
    PetscCallA(VecSet(solution, 0.0_wp, ierr))
    PetscCallA(VecCopy(right, left, ierr))
    PetscCallA(VecNorm(right, NORM_2, whole, ierr))
    norm = whole
    if (system%has_motions) call create_iterations(system%motions, tangent, transposed, matrix, linear)
    do i = 1, most_corrections
      before = norm
      if (before <= enough*whole) exit
      if (system%has_motions) then
        PetscCallA(KSPSolve(linear, left, correction, ierr))
      else if (transposed) then
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
    if (.not. system%has_motions) return
    PetscCallA(KSPDestroy(linear, ierr))
    if (transposed) then
      PetscCallA(MatDestroy(matrix, ierr))
    end if
  end subroutine solve_corrected

  !> Iterations for a matrix or its transposed.
  subroutine create_iterations(motions, tangent, transposed, matrix, linear)
    Mat, intent(in) :: motions !! their coarse space
    Mat, intent(in) :: tangent
    logical, intent(in) :: transposed
    Mat, intent(out) :: matrix !! the tangent itself, or a matrix of its own
    KSP, intent(out) :: linear
    PetscErrorCode :: ierr

    matrix = tangent
    if (transposed) then
      PetscCallA(MatTranspose(tangent, MAT_INITIAL_MATRIX, matrix, ierr))
    end if
    PetscCallA(KSPCreate(PETSC_COMM_WORLD, linear, ierr))
    PetscCallA(KSPSetOptionsPrefix(linear, prefix, ierr))
    PetscCallA(KSPSetOperators(linear, matrix, matrix, ierr))
    call use_multigrid(linear, prefix, .false., motions)
    PetscCallA(KSPSetTolerances(linear, of_iterations, 0.0_wp, PETSC_DEFAULT_REAL, PETSC_DEFAULT_INTEGER, ierr))
    PetscCallA(KSPSetFromOptions(linear, ierr))
  end subroutine create_iterations
end module gfb_corrected_solve
