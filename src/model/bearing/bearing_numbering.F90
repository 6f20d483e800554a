#include "gfb_petsc.h"
!> Numbers and sizes of a bearing's unknowns: of each pad film and foil, fields and scalars of the blocks, the shaft.
module gfb_bearing_numbering
  use petscmat
  use gfb_petsc_kinds, only: pint
  use gfb_petsc_session, only: this_rank, rank_count
  use gfb_blocks, only: block_type, create_blocks
  use gfb_bearing, only: bearing_type, bearing_block_type, places_of
  implicit none (type)
  private
  public :: number_unknowns, scale_unknowns, create_numbers, number_by

contains

  !> Where each pad's film and foil, fields and scalars of blocks, and the shaft stand among all unknowns.
  subroutine number_unknowns(bearing)
    class(bearing_type), intent(inout) :: bearing !! pads and shaft, with its list of blocks
    type(block_type), allocatable :: part(:)
    integer :: i, b, k, pads

    pads = size(bearing%pad)
    allocate (part(2*pads + pads*count(bearing%block%fields > 0) + count(bearing%block%scalars > 0)))
    do i = 1, pads
      associate (pad => bearing%pad(i))
        part(2*i - 1) = block_type(pad%mesh%owned_unknowns, pad%mesh%first_unknown)
        part(2*i) = block_type(pad%foil%owned, pad%foil%global_unknown)
      end associate
    end do
    k = 2*pads
    do b = 1, size(bearing%block)
      if (bearing%block(b)%fields == 0) cycle
      associate (fields => bearing%block(b)%fields)
        do i = 1, pads
          associate (mesh => bearing%pad(i)%mesh)
            part(k + i) = block_type(fields*mesh%owned_unknowns, numbers_of_fields(mesh%first_unknown, fields))
          end associate
        end do
      end associate
      k = k + pads
    end do
    do b = 1, size(bearing%block)
      if (bearing%block(b)%scalars == 0) cycle
      k = k + 1
      associate (scalars => bearing%block(b)%scalars)
        part(k) = block_type(merge(scalars, 0, this_rank() == rank_count() - 1), [(i, i=1, scalars)])
      end associate
    end do
    call create_blocks(part, size(bearing%coordinate), bearing%blocks)
    bearing%unknowns = bearing%blocks%border%unknowns
    bearing%last_rank = bearing%blocks%border%last_rank
    bearing%first_shaft = bearing%blocks%first(size(part) + 1)
    bearing%first_scalar = bearing%first_shaft - sum(bearing%block%scalars)
    call place_block_unknowns(bearing)
  end subroutine number_unknowns

  !> Gives all blocks the places of their unknowns.
  pure subroutine place_block_unknowns(bearing)
    class(bearing_type), intent(inout) :: bearing !! numbered
    type(bearing_block_type) :: block
    integer :: b, k, pads, first_scalar

    pads = size(bearing%pad)
    k = 2*pads
    first_scalar = bearing%first_scalar
    do b = 1, size(bearing%block)
      block = bearing%block(b)
      block%first = bearing%blocks%first(k + 1:k + merge(pads, 0, block%fields > 0))
      k = k + size(block%first)
      block%first_scalar = first_scalar
      first_scalar = first_scalar + block%scalars
      bearing%block(b) = block
      if (associated(block%take_numbers)) call block%take_numbers(bearing, block)
    end do
  end subroutine place_block_unknowns

  !> Numbers of the unknowns of each node that stand side by side.
  pure function numbers_of_fields(number, fields) result(numbers)
    integer, intent(in) :: number(:) !! of the nodes, from 1
    integer, intent(in) :: fields !! at each
    integer :: numbers(fields*size(number)), i

    do i = 1, fields
      numbers(i::fields) = fields*number - fields + i
    end do
  end function numbers_of_fields

  !> Sizes of the unknowns.
  subroutine scale_unknowns(bearing)
    class(bearing_type), intent(inout) :: bearing !! pads and shaft
    integer :: i

    allocate (bearing%unknown_scale(bearing%local_size()))
    do i = 1, size(bearing%pad)
      associate (pad => bearing%pad(i))
        bearing%unknown_scale(pad%first + 1:pad%last) = pad%unknown_scale()
      end associate
    end do
    do i = 1, size(bearing%block)
      bearing%unknown_scale(places_of(bearing, bearing%block(i))) = bearing%block(i)%unknown_size
    end do
    bearing%unknown_scale(bearing%first_shaft + 1:) = bearing%clearance/bearing%levers()
  end subroutine scale_unknowns

  !> The numbers by which each pad fills the matrix: as if it were the only one.
  subroutine create_numbers(bearing)
    class(bearing_type), intent(inout) :: bearing !! numbered, with its list of blocks
    integer(pint), allocatable :: global(:)
    PetscErrorCode :: ierr
    integer :: i

    if (size(bearing%pad) == 1 .and. all(bearing%block%fields + bearing%block%scalars == 0)) return
    allocate (bearing%numbers(0:size(bearing%pad)))
    do i = 0, size(bearing%pad)
      global = bearing%blocks%global
      if (i > 0) global = [global(bearing%pad(i)%first + 1:bearing%pad(i)%last), &
                           global(bearing%first_scalar + 1:)]
      PetscCallA(ISLocalToGlobalMappingCreate(PETSC_COMM_WORLD, 1_pint, size(global, kind=pint), global, PETSC_COPY_VALUES, bearing%numbers(i), ierr))
    end do
  end subroutine create_numbers

  !> From now on a matrix is filled by the local numbers of a pad, behind them scalars' and the shaft's; 0: by the bearing's.
  subroutine number_by(bearing, i, matrix)
    class(bearing_type), intent(in) :: bearing !! pads and shaft
    integer, intent(in) :: i !! of the pad, or 0
    Mat, intent(in) :: matrix !! like the bearing's
    PetscErrorCode :: ierr

    if (.not. allocated(bearing%numbers)) return
    PetscCallA(MatSetLocalToGlobalMapping(matrix, bearing%numbers(i), bearing%numbers(i), ierr))
  end subroutine number_by
end module gfb_bearing_numbering
