#include "gfb_petsc.h"
!> Fields of an archive: in an order of their entries that does not depend on how many ranks there are.
module gfb_natural_order
  use petscvec
  use gfb_kinds, only: wp
  use gfb_archive, only: archive_type
  use gfb_division, only: block_ends
  use gfb_petsc_session, only: this_rank, rank_count, fetch_entries, any_rank, sum_over_ranks
  implicit none (type)
  private
  public :: visit_field, visit_vector

  real(wp), parameter :: summing = 1.0e-9_wp !! by how much a sum over other ranks may differ, relative

  !> What this rank owns, by numbers that some of which nothing may have.
  type, public :: natural_order_type
    integer, allocatable :: number(:) !! of each thing this rank owns, from 1
    integer :: total = 0              !! largest number on all ranks
  end type natural_order_type

contains

  !> Saves or restores a field, and how large it is as a whole; zeros where nothing has a number. All ranks ask.
  subroutine visit_field(archive, name, order, value)
    type(archive_type), intent(inout) :: archive !! that saves or restores
    character(len=*), intent(in) :: name !! of the field, of its own in the archive
    type(natural_order_type), intent(in) :: order !! of the things
    real(wp), intent(inout) :: value(:, :) !! (components, things this rank owns), written where the archive restores [SI]
    real(wp), allocatable :: block(:, :)
    real(wp) :: norm
    integer :: ends(2), i

    if (order%total == 0) return
    norm = 0.0_wp
    if (archive%saves) norm = norm_of(value)
    call archive%visit(name//' norm', norm)
    ends = block_ends(order%total, rank_count(), this_rank() + 1)
    if (archive%saves) then
      block = fetch_entries(order%total, order%number, value, [(i, i=ends(1), ends(2))])
    else
      allocate (block(size(value, 1), ends(2) - ends(1) + 1), source=0.0_wp)
    end if
    call archive%visit_block(name, order%total, ends(1) - 1, block)
    if (archive%saves) return
    call archive%require(.not. any_rank(archive%failed), "the field '"//name//"' on another rank")
    value = fetch_entries(order%total, [(i, i=ends(1), ends(2))], block, order%number)
    call archive%require(abs(norm_of(value) - norm) <= summing*norm, "the field '"//name//"' is not as large as it was")
  end subroutine visit_field

  !> Euclidean norm of the values of all ranks.
  real(wp) function norm_of(value) result(norm)
    real(wp), intent(in) :: value(:, :)
    real(wp) :: total(1)

    total = sum_over_ranks([sum(value**2)])
    norm = sqrt(total(1))
  end function norm_of

  !> The same of a vector of unknowns.
  subroutine visit_vector(archive, name, order, vector)
    type(archive_type), intent(inout) :: archive !! that saves or restores
    character(len=*), intent(in) :: name !! of the vector, of its own in the archive
    type(natural_order_type), intent(in) :: order !! of its unknowns
    Vec, intent(in) :: vector !! scaled unknowns of all ranks, filled where the archive restores
    real(wp), allocatable :: value(:, :)
    PetscScalar, pointer :: values(:)
    PetscErrorCode :: ierr

    PetscCallA(GFB_VecGetArrayRead(vector, values, ierr))
    value = reshape(values, [1, size(values)])
    PetscCallA(GFB_VecRestoreArrayRead(vector, values, ierr))
    call visit_field(archive, name, order, value)
    if (archive%saves) return
    PetscCallA(GFB_VecGetArray(vector, values, ierr))
    values = value(1, :)
    PetscCallA(GFB_VecRestoreArray(vector, values, ierr))
  end subroutine visit_vector
end module gfb_natural_order
