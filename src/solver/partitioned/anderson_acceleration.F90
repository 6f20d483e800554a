#include "gfb_petsc.h"
!> Anderson's mixing of the loops of a fixed-point iteration.
!>
!> Each loop holds a vector and asks for a change of it. What the last loops held is mixed so that
!> together they ask for the least change, measured in rows that the caller chooses; a share of what
!> is left is added. That is a secant method for several directions at once.
module gfb_anderson_acceleration
  use petscvec
  use gfb_kinds, only: wp
  use gfb_petsc_session, only: sum_over_ranks
  implicit none (type)
  private
  public :: create_mixing, mix_loops, destroy_mixing

  integer, parameter :: depth = 15               !! loops that are mixed
  real(wp), parameter :: damping = 0.7_wp        !! share of the change that is left that is added [1]
  real(wp), parameter :: independent = 1.0e-6_wp !! what is left of a loop that still counts [1]

  !> What the last loops held and asked for.
  type, public :: loop_mixing_type
    integer, private :: loops = 0 !! since the beginning
    Vec, private :: held, change  !! of the last loop
    Vec, private :: way(depth)    !! from loop to loop, the newest first: of what was held,
    Vec, private :: turn(depth)   !! and of the change
    real(wp), allocatable, private :: asked(:)     !! change of the last loop, in the rows that are measured
    real(wp), allocatable, private :: column(:, :) !! turns in them
  end type loop_mixing_type

contains

  !> Room for the loops of a vector.
  subroutine create_mixing(vector, rows, mixing)
    Vec, intent(in) :: vector   !! of the kind that is held
    integer, intent(in) :: rows !! of this rank, in which changes are measured
    type(loop_mixing_type), intent(out) :: mixing
    PetscErrorCode :: ierr
    integer :: i

    PetscCallA(VecDuplicate(vector, mixing%held, ierr))
    PetscCallA(VecDuplicate(vector, mixing%change, ierr))
    do i = 1, depth
      PetscCallA(VecDuplicate(vector, mixing%way(i), ierr))
      PetscCallA(VecDuplicate(vector, mixing%turn(i), ierr))
    end do
    allocate (mixing%asked(rows), source=0.0_wp)
    allocate (mixing%column(rows, depth), source=0.0_wp)
  end subroutine create_mixing

  !> From what a loop held to what the next one holds.
  subroutine mix_loops(mixing, first, held, change, asked)
    type(loop_mixing_type), intent(inout) :: mixing
    logical, intent(in) :: first         !! loops before this one do not count
    Vec, intent(in) :: held              !! is replaced
    Vec, intent(in) :: change            !! that the loop asked for
    real(wp), intent(in) :: asked(:)     !! the same in this rank's rows that are measured

    real(wp) :: share(depth)
    PetscErrorCode :: ierr
    integer :: i, kept

    if (first) mixing%loops = 0
    if (.not. first) call remember(mixing, held, change, asked)
    PetscCallA(VecCopy(held, mixing%held, ierr))
    PetscCallA(VecCopy(change, mixing%change, ierr))
    mixing%asked = asked
    kept = min(depth, mixing%loops)
    mixing%loops = mixing%loops + 1
    call least_change(mixing%column(:, :kept), asked, share(:kept))
    PetscCallA(VecAXPY(held, damping, change, ierr))
    do i = 1, kept
      PetscCallA(VecAXPY(held, -share(i), mixing%way(i), ierr))
      PetscCallA(VecAXPY(held, -share(i)*damping, mixing%turn(i), ierr))
    end do
  end subroutine mix_loops

  !> Keeps what the last loop taught, in place of the oldest one.
  subroutine remember(mixing, held, change, asked)
    type(loop_mixing_type), intent(inout) :: mixing
    Vec, intent(in) :: held, change
    real(wp), intent(in) :: asked(:)
    Vec :: way, turn
    PetscErrorCode :: ierr

    way = mixing%way(depth)
    turn = mixing%turn(depth)
    mixing%way(2:) = mixing%way(:depth - 1)
    mixing%turn(2:) = mixing%turn(:depth - 1)
    mixing%column(:, 2:) = mixing%column(:, :depth - 1)
    PetscCallA(VecWAXPY(way, -1.0_wp, mixing%held, held, ierr))
    PetscCallA(VecWAXPY(turn, -1.0_wp, mixing%change, change, ierr))
    mixing%way(1) = way
    mixing%turn(1) = turn
    mixing%column(:, 1) = asked - mixing%asked
  end subroutine remember

  !> Shares of columns that leave the least of a vector, by Gram and Schmidt; columns that say
  !> nothing new have none.
  subroutine least_change(column, vector, share)
    real(wp), intent(in) :: column(:, :) !! this rank's rows
    real(wp), intent(in) :: vector(:)    !! this rank's rows
    real(wp), intent(out) :: share(:)    !! one a column [1]

    real(wp) :: basis(size(column, 1), size(column, 2)), triangle(size(share), size(share))
    real(wp) :: whole, left
    logical :: used(size(share))
    integer :: i, j

    triangle = 0.0_wp
    basis = column
    do j = 1, size(share)
      whole = sqrt(product_of(basis(:, j), basis(:, j)))
      do i = 1, j - 1
        if (.not. used(i)) cycle
        triangle(i, j) = product_of(basis(:, i), basis(:, j))
        basis(:, j) = basis(:, j) - triangle(i, j)*basis(:, i)
      end do
      left = sqrt(product_of(basis(:, j), basis(:, j)))
      used(j) = left > independent*whole
      if (.not. used(j)) cycle
      triangle(j, j) = left
      basis(:, j) = basis(:, j)/left
    end do
    share = 0.0_wp
    do j = size(share), 1, -1
      if (.not. used(j)) cycle
      share(j) = (product_of(basis(:, j), vector) - &
                  dot_product(triangle(j, j + 1:), share(j + 1:)))/triangle(j, j)
    end do
  end subroutine least_change

  !> Scalar product over all ranks.
  function product_of(a, b) result(total)
    real(wp), intent(in) :: a(:), b(:) !! this rank's rows
    real(wp) :: total
    real(wp) :: part(1)

    part = sum_over_ranks([dot_product(a, b)])
    total = part(1)
  end function product_of

  !> Frees what PETSc holds.
  subroutine destroy_mixing(mixing)
    type(loop_mixing_type), intent(inout) :: mixing
    PetscErrorCode :: ierr
    integer :: i

    PetscCallA(VecDestroy(mixing%held, ierr))
    PetscCallA(VecDestroy(mixing%change, ierr))
    do i = 1, depth
      PetscCallA(VecDestroy(mixing%way(i), ierr))
      PetscCallA(VecDestroy(mixing%turn(i), ierr))
    end do
  end subroutine destroy_mixing
end module gfb_anderson_acceleration
