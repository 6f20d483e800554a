#include "gfb_petsc.h"
!> A few scalars beside many unknowns: the shaft's position, a plate's displacement, a path's parameter.
!>
!> Their equations hold almost all unknowns, and almost all equations may hold them: they border the
!> matrix with full rows and columns. They stand behind all other unknowns, on the last rank.
module gfb_border_rows
  use petscmat
  use gfb_kinds, only: wp
  use gfb_petsc_kinds, only: pint
  use gfb_petsc_session, only: sum_over_ranks, this_rank, rank_count
  implicit none (type)
  private
  public :: create_border

  !> The scalars, and how many unknowns there are with them.
  type, public :: border_type
    integer :: scalars = 0         !! of them
    integer :: owned = 0           !! unknowns this rank owns, with the scalars on the last one
    integer :: unknowns = 0        !! on all ranks, with the scalars
    logical :: last_rank = .false. !! this rank owns the scalars and their equations
  contains
    procedure, non_overridable :: create_matrix, set_row, values, set_values, join, split
    procedure, non_overridable, private :: inner
  end type border_type

contains

  !> Counts the unknowns of a system with some scalars.
  subroutine create_border(owned, scalars, border)
    integer, intent(in) :: owned   !! this rank's unknowns without the scalars
    integer, intent(in) :: scalars !! on all ranks together
    type(border_type), intent(out) :: border !! of the scalars
    PetscErrorCode :: ierr

    border%scalars = scalars
    border%last_rank = this_rank() == rank_count() - 1
    border%owned = owned
    if (border%last_rank) border%owned = owned + scalars
    call MPI_Allreduce(border%owned, border%unknowns, 1, MPI_INTEGER, MPI_SUM, PETSC_COMM_WORLD, ierr)
  end subroutine create_border

  !> This rank's unknowns without the scalars.
  pure integer function inner(self) result(owned)
    class(border_type), intent(in) :: self !! the scalar unknowns
    owned = self%owned - merge(self%scalars, 0, self%last_rank)
  end function inner

  !> A matrix with room for given numbers of entries, and for the scalars' rows and columns.
  subroutine create_matrix(self, inside, outside, matrix)
    class(border_type), intent(in) :: self !! the scalar unknowns
    PetscInt, intent(in) :: inside(:)  !! entries of this rank's rows, without scalars, in its own columns
    PetscInt, intent(in) :: outside(:) !! and in other ranks' columns, at most
    Mat, intent(out) :: matrix !! of all ranks, still empty
    PetscInt :: own, others
    PetscInt, dimension(self%owned) :: room_inside, room_outside
    PetscErrorCode :: ierr

    own = self%owned
    others = self%unknowns - self%owned
    room_inside = own     ! of the scalars' rows
    room_outside = others
    room_inside(:self%inner()) = min(inside + int(self%scalars, pint), own)
    room_outside(:self%inner()) = min(outside + int(self%scalars, pint), others)
    PetscCallA(MatCreate(PETSC_COMM_WORLD, matrix, ierr))
    PetscCallA(MatSetSizes(matrix, own, own, PETSC_DETERMINE, PETSC_DETERMINE, ierr))
    PetscCallA(MatSetType(matrix, MATAIJ, ierr))
    PetscCallA(MatSeqAIJSetPreallocation(matrix, 0_pint, room_inside, ierr))
    PetscCallA(MatMPIAIJSetPreallocation(matrix, 0_pint, room_inside, 0_pint, room_outside, ierr))
  end subroutine create_matrix

  !> Writes a vector into the row of a scalar of a matrix, full of entries: every rank its own columns.
  subroutine set_row(self, scalar, vector, matrix)
    class(border_type), intent(in) :: self !! the scalar unknowns
    integer, intent(in) :: scalar !! from 1
    Vec, intent(in) :: vector     !! with the scalars
    Mat, intent(in) :: matrix     !! to be assembled by the caller
    PetscScalar, pointer :: entry(:)
    PetscInt :: first, last, row, i
    PetscErrorCode :: ierr

    row = self%unknowns - self%scalars + scalar - 1
    PetscCallA(VecGetOwnershipRange(vector, first, last, ierr))
    PetscCallA(GFB_VecGetArrayRead(vector, entry, ierr))
    PetscCallA(MatSetValues(matrix, 1_pint, [row], last - first, [(i, i=first, last - 1)], entry, INSERT_VALUES, ierr))
    PetscCallA(GFB_VecRestoreArrayRead(vector, entry, ierr))
  end subroutine set_row

  !> The scalars in a vector, on every rank.
  function values(self, vector) result(value)
    class(border_type), intent(in) :: self !! the scalar unknowns
    Vec, intent(in) :: vector !! of all ranks
    real(wp) :: value(self%scalars)
    PetscScalar, pointer :: all(:)
    PetscErrorCode :: ierr

    value = 0.0_wp
    PetscCallA(GFB_VecGetArrayRead(vector, all, ierr))
    if (self%last_rank) value = all(self%inner() + 1:self%owned)
    PetscCallA(GFB_VecRestoreArrayRead(vector, all, ierr))
    value = sum_over_ranks(value) ! the other ranks have none
  end function values

  !> Sets the scalars in a vector.
  subroutine set_values(self, value, vector)
    class(border_type), intent(in) :: self !! the scalar unknowns
    real(wp), intent(in) :: value(:) !! one a scalar, the same on every rank, scaled
    Vec, intent(in) :: vector !! of all ranks
    PetscScalar, pointer :: all(:)
    PetscErrorCode :: ierr

    PetscCallA(GFB_VecGetArray(vector, all, ierr))
    if (self%last_rank) all(self%inner() + 1:self%owned) = value
    PetscCallA(GFB_VecRestoreArray(vector, all, ierr))
  end subroutine set_values

  !> Puts a vector without the scalars and values of them together.
  subroutine join(self, part, value, whole)
    class(border_type), intent(in) :: self !! the scalar unknowns
    Vec, intent(in) :: part          !! without the scalars
    real(wp), intent(in) :: value(:) !! one a scalar, the same on every rank, scaled
    Vec, intent(in) :: whole         !! with them
    PetscScalar, pointer :: all(:), inside(:)
    PetscErrorCode :: ierr

    PetscCallA(GFB_VecGetArray(whole, all, ierr))
    PetscCallA(GFB_VecGetArrayRead(part, inside, ierr))
    all(:self%inner()) = inside(:self%inner())
    if (self%last_rank) all(self%inner() + 1:self%owned) = value
    PetscCallA(GFB_VecRestoreArrayRead(part, inside, ierr))
    PetscCallA(GFB_VecRestoreArray(whole, all, ierr))
  end subroutine join

  !> The part of a vector without the scalars.
  subroutine split(self, whole, part)
    class(border_type), intent(in) :: self !! the scalar unknowns
    Vec, intent(in) :: whole !! with the scalars
    Vec, intent(in) :: part  !! without them
    PetscScalar, pointer :: all(:), inside(:)
    PetscErrorCode :: ierr

    PetscCallA(GFB_VecGetArrayRead(whole, all, ierr))
    PetscCallA(GFB_VecGetArray(part, inside, ierr))
    inside(:self%inner()) = all(:self%inner())
    PetscCallA(GFB_VecRestoreArray(part, inside, ierr))
    PetscCallA(GFB_VecRestoreArrayRead(whole, all, ierr))
  end subroutine split
end module gfb_border_rows
