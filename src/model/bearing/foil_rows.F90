#include "gfb_petsc.h"
!> Rows that foils have in a bearing's matrix, and the coarse space of an iterative solver in its numbers.
module gfb_foil_rows
  use petscmat
  use gfb_kinds, only: wp
  use gfb_petsc_kinds, only: pint
  use gfb_matrix_rows, only: copy_row
  use gfb_blocks, only: blocks_type, block_type, create_blocks
  use gfb_foil_model, only: foil_model_type
  use gfb_pad, only: pad_type
  implicit none (type)
  private
  public :: add_of_foil, create_bearing_motions

contains

  !> Adds a matrix of a pad's foil, in its own numbers.
  subroutine add_of_foil(blocks, foil, pad, of_foil, factor, keeps_diagonal, matrix)
    type(blocks_type), intent(in) :: blocks !! of the bearing's unknowns
    class(foil_model_type), intent(in) :: foil !! of the pad
    integer, intent(in) :: pad !! its number
    Mat, intent(in) :: of_foil !! the same one for each pad
    real(wp), intent(in) :: factor(2) !! of the rows of top foil and bumps [1]
    logical, intent(in) :: keeps_diagonal !! also where it is zero
    Mat, intent(in) :: matrix !! like the bearing's
    PetscInt :: first, last, row, entries, number(maxval([0, foil%row_entries]))
    PetscInt, allocatable :: renumbered(:)
    PetscScalar :: value(size(number))
    PetscErrorCode :: ierr
    integer, allocatable :: kept(:)
    integer :: i

    associate (foil_block => 2*pad)
      PetscCallA(MatGetOwnershipRange(of_foil, first, last, ierr))
      do row = first, last - 1
        call copy_row(of_foil, row, entries, number, value)
        ! Membrane and bending of a condensed flat do not know each other either: exact zeros fill half of its block.
        kept = pack([(i, i=1, int(entries))], abs(value(:entries)) > 0.0_wp .or. (keeps_diagonal .and. number(:entries) == row))
        renumbered = [(int(blocks%global_number(foil_block, int(number(kept(i))) + 1), pint), i=1, size(kept))]
        PetscCallA(MatSetValues(matrix, 1_pint, [int(blocks%global_number(foil_block, int(row) + 1), pint)], size(kept, 1, pint), renumbered, merge(factor(1), factor(2), int(row - first) < foil%owned_top)*value(kept), ADD_VALUES, ierr))
      end do
    end associate
  end subroutine add_of_foil

  !> The coarse space of an iterative solver: foils move in patches, all else of a bearing on its own.
  subroutine create_bearing_motions(blocks, pads, matrix, motions, has)
    type(blocks_type), intent(in) :: blocks !! of the bearing's unknowns
    type(pad_type), intent(in) :: pads(:) !! equal ones
    Mat, intent(in) :: matrix !! the bearing's
    Mat, intent(out) :: motions !! (unknowns, motions)
    logical, intent(out) :: has !! there is one for such foils
    integer, parameter :: most = 64 !! entries of a row
    type(block_type) :: block(size(blocks%first) - 1)
    type(blocks_type) :: coarse
    Mat :: of_foil
    PetscInt :: first, last, before, row, entries, number(most), own_first, own_last
    PetscInt, allocatable :: room(:)
    PetscScalar :: value(most)
    PetscErrorCode :: ierr
    integer :: b, i

    call pads(1)%foil%create_coarse_motions(of_foil, has)
    if (.not. has) return
    PetscCallA(MatGetOwnershipRange(matrix, first, last, ierr))
    PetscCallA(MatGetOwnershipRange(of_foil, own_first, own_last, ierr))
    do b = 1, size(block)
      block(b)%owned = blocks%first_owned(b + 1) - blocks%first_owned(b)
      if (is_foil(b)) then
        PetscCallA(MatGetOwnershipRangeColumn(of_foil, before, row, ierr))
        block(b)%owned = int(row - before)
      end if
      allocate (block(b)%number(0))
    end do
    call create_blocks(block, blocks%border%scalars, coarse)
    PetscCallA(MatCreate(PETSC_COMM_WORLD, motions, ierr))
    PetscCallA(MatSetSizes(motions, last - first, int(coarse%border%owned, pint), PETSC_DETERMINE, PETSC_DETERMINE, ierr))
    PetscCallA(MatSetType(motions, MATAIJ, ierr))
    allocate (room(blocks%border%owned), source=1_pint)
    do b = 2, 2*size(pads), 2
      do row = own_first, own_last - 1
        call copy_row(of_foil, row, entries, number)
        room(blocks%first_owned(b) + row - own_first + 1) = entries
      end do
    end do
    PetscCallA(MatSeqAIJSetPreallocation(motions, 0_pint, room, ierr))
    PetscCallA(MatMPIAIJSetPreallocation(motions, 0_pint, room, 0_pint, room, ierr))
    PetscCallA(MatGetOwnershipRangeColumn(motions, before, row, ierr))
    do b = 1, size(blocks%first_owned)
      if (b <= size(block)) then
        if (is_foil(b)) cycle
      end if
      associate (begin => blocks%first_owned(b), shift => before + coarse%first_owned(b))
        do i = 1, merge(blocks%border%owned, blocks%first_owned(min(b + 1, size(blocks%first_owned))), b > size(block)) - begin
          PetscCallA(MatSetValue(motions, first + int(begin + i - 1, pint), shift + int(i - 1, pint), 1.0_wp, INSERT_VALUES, ierr))
        end do
      end associate
    end do
    do b = 2, 2*size(pads), 2
      do row = own_first, own_last - 1
        call copy_row(of_foil, row, entries, number, value)
        number(:entries) = [(int(coarse%global_number(b, int(number(i)) + 1), pint), i=1, int(entries))]
        PetscCallA(MatSetValues(motions, 1_pint, [first + int(blocks%first_owned(b), pint) + row - own_first], entries, number, value, INSERT_VALUES, ierr))
      end do
    end do
    PetscCallA(MatAssemblyBegin(motions, MAT_FINAL_ASSEMBLY, ierr))
    PetscCallA(MatAssemblyEnd(motions, MAT_FINAL_ASSEMBLY, ierr))
    PetscCallA(MatDestroy(of_foil, ierr))

  contains

    !> Whether a block is that of a pad's foil.
    pure logical function is_foil(number) result(is)
      integer, intent(in) :: number
      is = modulo(number, 2) == 0 .and. number <= 2*size(pads)
    end function is_foil
  end subroutine create_bearing_motions
end module gfb_foil_rows
