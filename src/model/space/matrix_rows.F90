#include "gfb_petsc.h"
!> Rows of a sparse matrix as copies: how PETSc gives access to them differs between its versions.
module gfb_matrix_rows
  use petscmat
  use gfb_petsc_kinds, only: pint
  implicit none (type)
  private
  public :: copy_row, row_length

contains

  !> Columns and values of one of this rank's rows.
  subroutine copy_row(matrix, row, entries, column, value)
    Mat, intent(in) :: matrix !! of all ranks
    PetscInt, intent(in) :: row      !! from 0
    PetscInt, intent(out) :: entries !! of the row
    PetscInt, contiguous, target, intent(inout) :: column(:)             !! from 0, with room for all
    PetscScalar, contiguous, target, optional, intent(inout) :: value(:) !! as long

    PetscInt, pointer :: columns(:)
    PetscScalar, pointer :: values(:)
    PetscInt :: returned
    PetscErrorCode :: ierr

    ! Older versions fill these arrays, newer ones point to their own.
    columns => column
    if (present(value)) then
      values => value
      PetscCallA(MatGetRow(matrix, row, entries, columns, values, ierr))
      value(:entries) = values(:entries)
    else
      PetscCallA(MatGetRow(matrix, row, entries, columns, PETSC_NULL_SCALAR_POINTER, ierr))
    end if
    column(:entries) = columns(:entries)
    returned = entries ! giving a row back may change it
    if (present(value)) then
      PetscCallA(MatRestoreRow(matrix, row, returned, columns, values, ierr))
    else
      PetscCallA(MatRestoreRow(matrix, row, returned, columns, PETSC_NULL_SCALAR_POINTER, ierr))
    end if
  end subroutine copy_row

  !> Entries of one of this rank's rows.
  function row_length(matrix, row) result(entries)
    Mat, intent(in) :: matrix !! of all ranks
    PetscInt, intent(in) :: row !! from 0
    PetscInt :: entries
    PetscInt :: returned
    PetscErrorCode :: ierr

    PetscCallA(MatGetRow(matrix, row, entries, PETSC_NULL_INTEGER_POINTER, PETSC_NULL_SCALAR_POINTER, ierr))
    returned = entries
    PetscCallA(MatRestoreRow(matrix, row, returned, PETSC_NULL_INTEGER_POINTER, PETSC_NULL_SCALAR_POINTER, ierr))
  end function row_length
end module gfb_matrix_rows
