#include "gfb_petsc.h"
!> Blocks of unknowns, films and foils of pads, and a few scalars: where each stands among all.
!>
!> A block has its own numbers, from 1, rank by rank. All together are numbered from 0: on each rank its
!> part of the first block, of the second, and so on; on the last rank the scalars come last. A rank's
!> local unknowns, its own and those of other ranks that it needs, stand in the same order.
module gfb_blocks
  use petscmat
  use gfb_petsc_kinds, only: pint
  use gfb_petsc_session, only: rank_count
  use gfb_border_rows, only: border_type, create_border
  implicit none (type)
  private
  public :: create_blocks

  !> One block on this rank.
  type, public :: block_type
    integer :: owned = 0              !! unknowns this rank owns
    integer, allocatable :: number(:) !! the block's own number, from 1, of each local unknown
  end type block_type

  !> All blocks and the scalars.
  type, public :: blocks_type
    type(border_type) :: border            !! of the scalars
    integer(pint), allocatable :: global(:) !! number, from 0, of each local unknown
    integer, allocatable :: first(:)       !! (blocks + 1) local unknowns before each block, before the scalars
    integer, allocatable :: first_owned(:) !! (blocks + 1) the same of those that this rank owns
    integer, allocatable, private :: block_end(:, :) !! (0:ranks, blocks) unknowns of the ranks so far
  contains
    procedure, non_overridable :: global_number, local_unknowns, create_matrix
  end type blocks_type

contains

  !> Numbers the unknowns.
  subroutine create_blocks(block, scalars, blocks)
    type(block_type), intent(in) :: block(:) !! in their order
    integer, intent(in) :: scalars           !! on all ranks together
    type(blocks_type), intent(out) :: blocks !! of unknowns
    integer, allocatable :: owned(:, :)
    integer :: ranks, b, i, rank
    PetscErrorCode :: ierr

    call create_border(sum(block%owned), scalars, blocks%border)
    ranks = rank_count()
    allocate (owned(size(block), ranks), blocks%block_end(0:ranks, size(block)))
    call MPI_Allgather(block%owned, size(block), MPI_INTEGER, owned, size(block), MPI_INTEGER, PETSC_COMM_WORLD, ierr)
    do b = 1, size(block)
      blocks%block_end(:, b) = [(sum(owned(b, :rank)), rank=0, ranks)]
    end do
    blocks%first = [(sum([(size(block(i)%number), i=1, b - 1)]), b=1, size(block) + 1)]
    blocks%first_owned = [(sum(block(:b - 1)%owned), b=1, size(block) + 1)]
    allocate (blocks%global(blocks%first(size(block) + 1) + scalars))
    do b = 1, size(block)
      do i = 1, size(block(b)%number)
        blocks%global(blocks%first(b) + i) = blocks%global_number(b, block(b)%number(i))
      end do
    end do
    do i = 1, scalars
      blocks%global(blocks%first(size(block) + 1) + i) = blocks%border%unknowns - scalars + i - 1
    end do
  end subroutine create_blocks

  !> Number, from 0, among all unknowns of a block's own one.
  pure integer function global_number(self, block, number) result(global)
    class(blocks_type), intent(in) :: self !! the blocks of unknowns
    integer, intent(in) :: block  !! from 1
    integer, intent(in) :: number !! the block's own, from 1
    integer :: owner

    owner = owner_of(self%block_end(:, block), number)
    global = sum(self%block_end(owner, :block - 1)) + sum(self%block_end(owner - 1, block + 1:)) + number - 1
  end function global_number

  !> The rank, from 1, in whose range a number lies, by halving.
  pure integer function owner_of(range_end, number) result(owner)
    integer, intent(in) :: range_end(0:)
    integer, intent(in) :: number !! from 1
    integer :: below, middle

    below = 0 ! its range ends before the number
    owner = size(range_end) - 1
    do while (owner - below > 1)
      middle = (below + owner)/2
      if (number > range_end(middle)) then
        below = middle
      else
        owner = middle
      end if
    end do
  end function owner_of

  !> Local unknowns of this rank, with the scalars.
  pure integer function local_unknowns(self) result(unknowns)
    class(blocks_type), intent(in) :: self !! the blocks of unknowns
    unknowns = size(self%global)
  end function local_unknowns

  !> A matrix that is filled by local numbers, with room for given entries and for the scalars.
  subroutine create_matrix(self, entries, matrix)
    class(blocks_type), intent(in) :: self !! the blocks of unknowns
    PetscInt, intent(in) :: entries(:) !! of each row that this rank owns, without the scalars, at most
    Mat, intent(out) :: matrix !! of all ranks, still empty
    ISLocalToGlobalMapping :: map
    PetscErrorCode :: ierr

    call self%border%create_matrix(entries, entries, matrix)
    PetscCallA(ISLocalToGlobalMappingCreate(PETSC_COMM_WORLD, 1_pint, int(size(self%global), pint), self%global, PETSC_COPY_VALUES, map, ierr))
    PetscCallA(MatSetLocalToGlobalMapping(matrix, map, map, ierr))
    PetscCallA(ISLocalToGlobalMappingDestroy(map, ierr))
  end subroutine create_matrix
end module gfb_blocks
