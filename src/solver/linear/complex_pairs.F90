#include "gfb_petsc.h"
!> Complex matrices as real ones, for a PETSc of real numbers.
!>
!> \( (A + i B) x = b \) is solved as
!> \( \begin{bmatrix} A & -B \\ B & A \end{bmatrix} \begin{bmatrix} \Re x \\ \Im x \end{bmatrix} =
!> \begin{bmatrix} \Re b \\ \Im b \end{bmatrix} \)
!> with real and imaginary part of an unknown side by side: number 2 n and 2 n + 1 from 0. So the fill of
!> the factors is that of the graph of A.
module gfb_complex_pairs
  use petscmat
  use gfb_kinds, only: wp
  use gfb_petsc_kinds, only: pint
  use gfb_matrix_rows, only: copy_row, row_length
  use gfb_direct_solver, only: set_option_default
  implicit none (type)
  private
  public :: create_pairs, fill_pairs, order_pairs, keep_entries

contains

  !> A matrix with room for two rows and columns in the place of each one of another.
  subroutine create_pairs(pattern, columns, pairs)
    Mat, intent(in) :: pattern     !! A's, and B's
    integer, intent(in) :: columns !! that rows may hold, from the first; the rest but for the diagonal is left out
    Mat, intent(out) :: pairs      !! still empty
    PetscInt :: first, last, row, entries
    PetscInt, allocatable :: column(:), inside(:), outside(:)
    logical, allocatable :: mine(:), held(:)
    PetscErrorCode :: ierr

    PetscCallA(MatGetOwnershipRange(pattern, first, last, ierr))
    allocate (column(longest_row(pattern)), inside(2*(last - first)), outside(2*(last - first)))
    do row = first, last - 1
      call copy_row(pattern, row, entries, column)
      mine = column(:entries) >= first .and. column(:entries) < last
      held = column(:entries) < columns .or. column(:entries) == row
      inside(2*(row - first) + 1:2*(row - first) + 2) = int(2*count(mine .and. held), pint)
      outside(2*(row - first) + 1:2*(row - first) + 2) = int(2*count(.not. mine .and. held), pint)
    end do
    PetscCallA(MatCreate(PETSC_COMM_WORLD, pairs, ierr))
    PetscCallA(MatSetSizes(pairs, 2*(last - first), 2*(last - first), PETSC_DETERMINE, PETSC_DETERMINE, ierr))
    PetscCallA(MatSetType(pairs, MATAIJ, ierr))
    PetscCallA(MatSeqAIJSetPreallocation(pairs, 0_pint, inside, ierr))
    PetscCallA(MatMPIAIJSetPreallocation(pairs, 0_pint, inside, 0_pint, outside, ierr))
  end subroutine create_pairs

  !> Makes MUMPS order pairs as one, by nested dissection: a sixth fewer operations on shells than
  !> approximate minimum fill.
  subroutine order_pairs(prefix)
    character(len=*), intent(in) :: prefix !! of PETSc's options of the solver

    call set_option_default('-'//prefix//'mat_mumps_icntl_7', '5')
    call set_option_default('-'//prefix//'mat_mumps_icntl_15', '-2')
  end subroutine order_pairs

  !> Entries of the longest row of this rank.
  function longest_row(matrix) result(entries)
    Mat, intent(in) :: matrix
    PetscInt :: entries
    PetscInt :: first, last, row
    PetscErrorCode :: ierr

    entries = 0
    PetscCallA(MatGetOwnershipRange(matrix, first, last, ierr))
    do row = first, last - 1
      entries = max(entries, row_length(matrix, row))
    end do
  end function longest_row

  !> Fills it in; an unknown that is not kept has an equation of its own, that it is zero.
  subroutine fill_pairs(real_part, imaginary_part, kept, columns, pairs)
    Mat, intent(in) :: real_part, imaginary_part !! A and B, of the same pattern
    logical, intent(in) :: kept(:) !! one an unknown of this rank
    integer, intent(in) :: columns !! as when the matrix was created
    Mat, intent(in) :: pairs       !! overwritten
    PetscInt :: first, last, row, entries, filled, i
    PetscInt, allocatable :: column(:), pair(:)
    PetscScalar, allocatable :: re(:), im(:), block(:, :)
    PetscErrorCode :: ierr

    PetscCallA(MatGetOwnershipRange(real_part, first, last, ierr))
    entries = longest_row(real_part)
    allocate (column(entries), re(entries), im(entries), pair(2*entries), block(2*entries, 2))
    do row = first, last - 1
      call copy_row(imaginary_part, row, entries, column, im)
      call copy_row(real_part, row, entries, column, re)
      if (.not. kept(row - first + 1)) then
        im(:entries) = 0.0_wp
        re(:entries) = merge(1.0_wp, 0.0_wp, column(:entries) == row)
      end if
      filled = 0
      do i = 1, entries
        if (column(i) >= columns .and. column(i) /= row) cycle
        pair(filled + 1:filled + 2) = 2*column(i) + [0_pint, 1_pint]
        block(filled + 1:filled + 2, 1) = [re(i), -im(i)] ! a row of the matrix in each column
        block(filled + 1:filled + 2, 2) = [im(i), re(i)]
        filled = filled + 2_pint
      end do
      PetscCallA(MatSetValues(pairs, 1_pint, [2*row], filled, pair, block(:, 1), INSERT_VALUES, ierr))
      PetscCallA(MatSetValues(pairs, 1_pint, [2*row + 1], filled, pair, block(:, 2), INSERT_VALUES, ierr))
    end do
    PetscCallA(MatAssemblyBegin(pairs, MAT_FINAL_ASSEMBLY, ierr))
    PetscCallA(MatAssemblyEnd(pairs, MAT_FINAL_ASSEMBLY, ierr))
  end subroutine fill_pairs

  !> Takes out of a vector what is not kept.
  subroutine keep_entries(vector, kept)
    Vec, intent(in) :: vector !! on the left or right of the matrix before it was doubled
    logical, intent(in) :: kept(:) !! one an entry of this rank
    PetscScalar, pointer :: values(:)
    PetscErrorCode :: ierr

    PetscCallA(GFB_VecGetArray(vector, values, ierr))
    where (.not. kept) values = 0.0_wp
    PetscCallA(GFB_VecRestoreArray(vector, values, ierr))
  end subroutine keep_entries
end module gfb_complex_pairs
