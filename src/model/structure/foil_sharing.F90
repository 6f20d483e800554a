#include "gfb_petsc.h"
!> How the ranks share a foil: columns of elements, kinds of super-elements, and the seams between.
module gfb_foil_sharing
  use petscsys
  use gfb_kinds, only: wp
  use gfb_errors, only: error_type
  use gfb_petsc_session, only: this_rank
  use gfb_partition, only: division_type, divide, chain, no_chain
  implicit none (type)
  private
  public :: cut_columns, share_kinds, pass_on, lines_at_seams

contains

  !> Shares out the columns of a foil that nothing lies above; those of a piece stay together.
  !>
  !> Fails when METIS does.
  subroutine cut_columns(first, ranks, column_part, error)
    integer, intent(in) :: first(:) !! first column of every piece, and one beyond the last
    integer, intent(in) :: ranks !! number of ranks
    integer, allocatable, intent(out) :: column_part(:) !! rank, from 1, of every column
    type(error_type), allocatable, intent(out) :: error !! error, if METIS fails
    type(division_type) :: division
    integer :: i, pieces

    pieces = size(first) - 1
    call divide(no_chain(), chain(real(first, wp), real(first(2:) - first(:pieces), wp), .false.), ranks, division, error)
    if (allocated(error)) return
    allocate (column_part(first(pieces + 1) - 1))
    do i = 1, pieces
      column_part(first(i):first(i + 1) - 1) = division%bumps(i)
    end do
  end subroutine cut_columns

  !> Which rank has which kind of substructure, and which one condenses it: of those that have it the
  !> one with the least to condense.
  pure subroutine share_kinds(kind, part, ranks, has, maker)
    integer, intent(in) :: kind(:) !! of the substructures
    integer, intent(in) :: part(:) !! rank, from 1, of the substructures
    integer, intent(in) :: ranks !! number of ranks
    logical, allocatable, intent(out) :: has(:, :)  !! (ranks, kinds)
    integer, allocatable, intent(out) :: maker(:) !! (kinds) rank, from 1
    integer :: burden(ranks), i

    allocate (has(ranks, maxval([0, kind])), source=.false.)
    allocate (maker(size(has, 2)))
    do i = 1, size(kind)
      has(part(i), kind(i)) = .true.
    end do
    burden = 0
    do i = 1, size(maker)
      maker(i) = minloc(burden, 1, mask=has(:, i))
      burden(maker(i)) = burden(maker(i)) + 1
    end do
  end subroutine share_kinds

  !> Hands a kind's matrix from the rank that made it to the others that have the kind; kinds come in the
  !> same order on all ranks, so that nobody waits for ever.
  subroutine pass_on(has, maker, order, matrix)
    logical, intent(in) :: has(:)  !! (ranks)
    integer, intent(in) :: maker   !! rank, from 1
    integer, intent(in) :: order   !! of the matrix
    real(wp), allocatable, intent(inout) :: matrix(:, :) !! there on the rank that made it [SI]
    integer, parameter :: tag = 1
    integer :: rank, entries, status(MPI_STATUS_SIZE)
    PetscErrorCode :: ierr

    entries = order**2
    if (maker /= this_rank() + 1) then
      allocate (matrix(order, order))
      call MPI_Recv(matrix, entries, MPI_DOUBLE_PRECISION, maker - 1, tag, PETSC_COMM_WORLD, status, ierr)
      return
    end if
    do rank = 1, size(has)
      if (rank == maker .or. .not. has(rank)) cycle
      call MPI_Send(matrix, entries, MPI_DOUBLE_PRECISION, rank - 1, tag, PETSC_COMM_WORLD, ierr)
    end do
  end subroutine pass_on

  !> Which lines of nodes belong to a piece that ends where another rank begins.
  pure function lines_at_seams(column_part, ends) result(line)
    integer, intent(in) :: column_part(:) !! rank, from 1, of every column of elements
    integer, intent(in) :: ends(:, :)     !! (2, pieces) first and last station
    logical :: line(size(column_part) + 1)
    integer :: i

    line = .false.
    do i = 1, size(ends, 2)
      if (is_seam(ends(1, i)) .or. is_seam(ends(2, i))) line(ends(:, i)) = .true.
    end do

  contains

    !> Whether the columns before and behind a station are different ranks'.
    pure function is_seam(station) result(seam)
      integer, intent(in) :: station
      logical :: seam

      seam = .false.
      if (station == 1 .or. station > size(column_part)) return
      seam = column_part(station - 1) /= column_part(station)
    end function is_seam
  end function lines_at_seams
end module gfb_foil_sharing
