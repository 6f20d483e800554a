#include "gfb_petsc.h"
!> What rounding may leave of a residual.
!>
!> A computed sum \( \sum_j J_{ij} x_j \) is off by some \( \epsilon \sum_j |J_{ij}| |x_j| \). No state
!> has a residual that is known better; one whose residual is no larger solves equations whose
!> coefficients differ in their last digits alone, by the theorem of Oettli and Prager.
module gfb_backward_error
  use petscmat
  use gfb_kinds, only: wp
  use gfb_petsc_kinds, only: pint
  use gfb_matrix_rows, only: copy_row, row_length
  implicit none (type)
  private
  public :: backward_error

  !> Roundings of a row's sum that do not cancel each other, with those of the solution before it.
  real(wp), parameter :: roundings = 4.0_wp

contains

  !> The norm over all equations of what rounding may leave of the scaled residual [1].
  function backward_error(matrix, state) result(rounding)
    Mat, intent(in) :: matrix !! the derivative of the residual, scaled
    Vec, intent(in) :: state  !! scaled
    real(wp) :: rounding

    Mat :: magnitudes
    Vec :: sizes, sums
    PetscInt, allocatable :: column(:)
    PetscScalar, allocatable :: value(:)
    PetscInt :: first, last, row, entries
    PetscReal :: norm
    PetscErrorCode :: ierr

    PetscCallA(MatDuplicate(matrix, MAT_DO_NOT_COPY_VALUES, magnitudes, ierr))
    PetscCallA(MatGetOwnershipRange(matrix, first, last, ierr))
    do row = first, last - 1
      entries = row_length(matrix, row)
      allocate (column(entries), value(entries))
      call copy_row(matrix, row, entries, column, value)
      PetscCallA(MatSetValues(magnitudes, 1_pint, [row], entries, column, abs(value), INSERT_VALUES, ierr))
      deallocate (column, value)
    end do
    PetscCallA(MatAssemblyBegin(magnitudes, MAT_FINAL_ASSEMBLY, ierr))
    PetscCallA(MatAssemblyEnd(magnitudes, MAT_FINAL_ASSEMBLY, ierr))
    PetscCallA(VecDuplicate(state, sizes, ierr))
    PetscCallA(VecDuplicate(state, sums, ierr))
    PetscCallA(VecCopy(state, sizes, ierr))
    PetscCallA(VecAbs(sizes, ierr))
    PetscCallA(MatMult(magnitudes, sizes, sums, ierr))
    PetscCallA(VecNorm(sums, NORM_2, norm, ierr))
    rounding = roundings*0.5_wp*epsilon(1.0_wp)*norm
    PetscCallA(VecDestroy(sums, ierr))
    PetscCallA(VecDestroy(sizes, ierr))
    PetscCallA(MatDestroy(magnitudes, ierr))
  end function backward_error
end module gfb_backward_error
