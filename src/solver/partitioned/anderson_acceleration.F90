#include "gfb_petsc.h"
!> Anderson acceleration of a fixed-point iteration.
!>
!> Each loop takes a vector and asks for a change of it. The vectors of the last loops are combined so that
!> together they ask for the least change, measured in rows that the caller chooses; a share of what
!> is left is added. That is a secant method for several directions at once.
module gfb_anderson_acceleration
  use petscvec
  use gfb_kinds, only: wp
  use gfb_petsc_session, only: sum_over_ranks
  implicit none (type)
  private
  public :: create_anderson, accelerate, destroy_anderson

  integer, parameter :: depth = 15               !! loops that are combined
  real(wp), parameter :: damping = 0.7_wp        !! share of the change that is left that is added [1]
  real(wp), parameter :: independent = 1.0e-6_wp !! what is left of a loop that still counts [1]

  !> What the last loops took and asked for.
  type, public :: anderson_type
    integer, private :: loops = 0 !! since the beginning
    Vec, private :: iterate, change  !! of the last loop
    Vec, private :: step(depth)   !! from loop to loop, the newest first: of the vector,
    Vec, private :: turn(depth)   !! and of the change
    real(wp), allocatable, private :: asked(:)     !! change of the last loop, in the rows that are measured, in their unit
    real(wp), allocatable, private :: column(:, :) !! turns in them
  end type anderson_type

contains

  !> Room for the loops of a vector.
  subroutine create_anderson(vector, rows, anderson)
    Vec, intent(in) :: vector   !! of the kind that is iterated
    integer, intent(in) :: rows !! of this rank, in which changes are measured
    type(anderson_type), intent(out) :: anderson !! without a loop yet
    PetscErrorCode :: ierr
    integer :: i

    PetscCallA(VecDuplicate(vector, anderson%iterate, ierr))
    PetscCallA(VecDuplicate(vector, anderson%change, ierr))
    do i = 1, depth
      PetscCallA(VecDuplicate(vector, anderson%step(i), ierr))
      PetscCallA(VecDuplicate(vector, anderson%turn(i), ierr))
    end do
    allocate (anderson%asked(rows), source=0.0_wp)
    allocate (anderson%column(rows, depth), source=0.0_wp)
  end subroutine create_anderson

  !> From the vector of a loop to that of the next one.
  subroutine accelerate(anderson, first, iterate, change, asked)
    type(anderson_type), intent(inout) :: anderson !! remembers this loop
    logical, intent(in) :: first         !! loops before this one do not count
    Vec, intent(in) :: iterate           !! of this loop; that of the next one replaces it
    Vec, intent(in) :: change            !! that the loop asked for
    real(wp), intent(in) :: asked(:) !! (measured rows of this rank) the same change as it is measured, in its unit

    real(wp) :: share(depth)
    PetscErrorCode :: ierr
    integer :: i, kept

    if (first) anderson%loops = 0
    if (.not. first) call remember(anderson, iterate, change, asked)
    PetscCallA(VecCopy(iterate, anderson%iterate, ierr))
    PetscCallA(VecCopy(change, anderson%change, ierr))
    anderson%asked = asked
    kept = min(depth, anderson%loops)
    anderson%loops = anderson%loops + 1
    call least_change(anderson%column(:, :kept), asked, share(:kept))
    PetscCallA(VecAXPY(iterate, damping, change, ierr))
    do i = 1, kept
      PetscCallA(VecAXPY(iterate, -share(i), anderson%step(i), ierr))
      PetscCallA(VecAXPY(iterate, -share(i)*damping, anderson%turn(i), ierr))
    end do
  end subroutine accelerate

  !> Keeps what the last loop taught, instead of the oldest one.
  subroutine remember(anderson, iterate, change, asked)
    type(anderson_type), intent(inout) :: anderson
    Vec, intent(in) :: iterate, change
    real(wp), intent(in) :: asked(:)
    Vec :: step, turn
    PetscErrorCode :: ierr

    step = anderson%step(depth)
    turn = anderson%turn(depth)
    anderson%step(2:) = anderson%step(:depth - 1)
    anderson%turn(2:) = anderson%turn(:depth - 1)
    anderson%column(:, 2:) = anderson%column(:, :depth - 1)
    PetscCallA(VecWAXPY(step, -1.0_wp, anderson%iterate, iterate, ierr))
    PetscCallA(VecWAXPY(turn, -1.0_wp, anderson%change, change, ierr))
    anderson%step(1) = step
    anderson%turn(1) = turn
    anderson%column(:, 1) = asked - anderson%asked
  end subroutine remember

  !> Shares of columns that leave the least of a vector, by Gram and Schmidt; columns that say
  !> nothing new have none.
  subroutine least_change(column, vector, share)
    real(wp), intent(in) :: column(:, :), vector(:) !! this rank's rows
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
  real(wp) function product_of(a, b) result(total)
    real(wp), intent(in) :: a(:), b(:) !! this rank's rows
    real(wp) :: part(1)

    part = sum_over_ranks([dot_product(a, b)])
    total = part(1)
  end function product_of

  !> Frees what PETSc holds.
  subroutine destroy_anderson(anderson)
    type(anderson_type), intent(inout) :: anderson !! is freed
    PetscErrorCode :: ierr
    integer :: i

    PetscCallA(VecDestroy(anderson%iterate, ierr))
    PetscCallA(VecDestroy(anderson%change, ierr))
    do i = 1, depth
      PetscCallA(VecDestroy(anderson%step(i), ierr))
      PetscCallA(VecDestroy(anderson%turn(i), ierr))
    end do
  end subroutine destroy_anderson
end module gfb_anderson_acceleration
