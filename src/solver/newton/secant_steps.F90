#include "gfb_petsc.h"
!> What the steps of Newton's method with kept factors teach of the matrix: Broyden's method.
!>
!> Two steps \( y_n, y_{n+1} \) in succession, \( x_{n+1} = x_n - y_n \), show how the residual has changed along the first
!> one. The least change of the inverse that agrees with it is a dyad,
!>
!> $$ H_{n+1} = \Bigl( I + \frac{y_{n+1} y_n^T}{y_n^T y_n} \Bigr) H_n, \quad
!>    y_{n+1} = \frac{z}{1 - y_n^T z/y_n^T y_n}, \quad z = H_n f_{n+1}, $$
!>
!> so that a pair of steps is all that is kept. What was learned serves the next equations, too, as long as the factors do.
!>
!> On several ranks a sum over all of them costs more than the products of a small system. So the products with the step as it
!> was found are summed at once, and those with its changes follow from products of the pairs.
!>
!> Source: [Kelley1995] section 7.3.
module gfb_secant_steps
  use petscvec
  use gfb_kinds, only: wp
  use gfb_petsc_session, only: rank_count
  implicit none (type)
  private
  public :: begin_secants, improve_step, expect_next, forget_secants, destroy_secants

  integer, parameter :: most_pairs = 24 !! that are kept
  real(wp), parameter :: least_divisor = 0.1_wp, most_divisor = 3.0_wp !! of a step; else nothing is learned from it [1]

  !> Pairs of steps, the oldest first.
  type, public :: secants_type
    logical :: used = .false.      !! the steps of the present solve are improved
    integer, private :: pairs = 0  !! so many are known
    logical, private :: created = .false.
    logical, private :: expects = .false. !! `last` was taken whole, and nothing else has changed
    integer, private :: order(most_pairs) = 0      !! which vectors are the pairs'
    real(wp), private :: square(most_pairs) = 0.0_wp !! y_n^T y_n [1]
    real(wp), private :: last_square = 0.0_wp
    logical, private :: at_once = .false. !! products are summed so
    real(wp), allocatable, private :: cross(:, :)   !! then: y_n^T y_{m+1}, m < n [1]
    real(wp), allocatable, private :: last_cross(:) !! of the step before
    type(tVec), private :: before(most_pairs), after(most_pairs) !! y_n, y_{n+1}, scaled
    type(tVec), private :: last    !! the step before, scaled
  end type secants_type

contains

  !> A solve begins, whose steps are improved or not; what was learned stays.
  subroutine begin_secants(secants, like, used)
    type(secants_type), intent(inout) :: secants !! pairs of steps
    Vec, intent(in) :: like !! a state
    logical, intent(in) :: used !! its steps are improved
    PetscErrorCode :: ierr
    integer :: i

    secants%used = used
    secants%expects = .false.
    if (.not. used .or. secants%created) return
    do i = 1, most_pairs
      PetscCallA(VecDuplicate(like, secants%before(i), ierr))
      PetscCallA(VecDuplicate(like, secants%after(i), ierr))
      secants%order(i) = i
    end do
    PetscCallA(VecDuplicate(like, secants%last, ierr))
    secants%created = .true.
    secants%at_once = rank_count() > 1
    allocate (secants%cross(most_pairs, most_pairs), secants%last_cross(most_pairs), source=0.0_wp)
  end subroutine begin_secants

  !> Improves a step that kept factors have found, and learns from it.
  subroutine improve_step(secants, y, ierr)
    type(secants_type), intent(inout) :: secants !! pairs of steps; gets one more
    Vec, intent(in) :: y !! the step, scaled; is changed
    PetscErrorCode, intent(out) :: ierr !! PETSc's error code, 0 for none
    PetscReal :: product, found(most_pairs + 1)
    real(wp) :: divisor, share(most_pairs)
    integer :: i, oldest

    ierr = 0
    if (secants%at_once) call sum_products(secants, y, secants%before, found, ierr)
    CHKERRQ(ierr)
    do i = 1, secants%pairs
      associate (pair => secants%order(i), earlier => secants%order(:i - 1))
        if (secants%at_once) then
          product = found(i) + dot_product(secants%cross(pair, earlier), share(:i - 1))
        else
          PetscCall(VecDot(secants%before(pair), y, product, ierr))
        end if
        share(i) = product/secants%square(pair)
        PetscCall(VecAXPY(y, share(i), secants%after(pair), ierr))
      end associate
    end do
    if (.not. secants%expects) return
    secants%expects = .false.
    if (secants%at_once) then
      associate (pairs => secants%pairs)
        product = found(pairs + 1) + dot_product(secants%last_cross(secants%order(:pairs)), share(:pairs))
      end associate
    else
      PetscCall(VecDot(secants%last, y, product, ierr))
    end if
    divisor = 1.0_wp - product/secants%last_square
    if (.not. (divisor > least_divisor .and. divisor < most_divisor)) return
    PetscCall(VecScale(y, 1.0_wp/divisor, ierr))
    if (secants%pairs == most_pairs) then
      oldest = secants%order(1)
      secants%order(:most_pairs - 1) = secants%order(2:)
      secants%order(most_pairs) = oldest
    else
      secants%pairs = secants%pairs + 1
    end if
    associate (pair => secants%order(secants%pairs))
      PetscCall(VecCopy(secants%last, secants%before(pair), ierr))
      PetscCall(VecCopy(y, secants%after(pair), ierr))
      secants%square(pair) = secants%last_square
      secants%cross(pair, :) = secants%last_cross
    end associate
  end subroutine improve_step

  !> Products of a step with one of each pair, the oldest first, and with the step before: one sum over the ranks.
  subroutine sum_products(secants, y, of_pairs, product, ierr)
    type(secants_type), intent(in) :: secants !! pairs of steps
    Vec, intent(in) :: y !! the step
    type(tVec), intent(in) :: of_pairs(:) !! `before` or `after`
    PetscReal, intent(out) :: product(:) !! one more than there are pairs
    PetscErrorCode, intent(out) :: ierr !! PETSc's error code, 0 for none
    integer :: i

    do i = 1, secants%pairs
      PetscCall(VecDotBegin(of_pairs(secants%order(i)), y, product(i), ierr))
    end do
    PetscCall(VecDotBegin(secants%last, y, product(secants%pairs + 1), ierr))
    do i = 1, secants%pairs
      PetscCall(VecDotEnd(of_pairs(secants%order(i)), y, product(i), ierr))
    end do
    PetscCall(VecDotEnd(secants%last, y, product(secants%pairs + 1), ierr))
  end subroutine sum_products

  !> A step was taken: where whole, the next one will say something of the matrix.
  subroutine expect_next(secants, y, whole, ierr)
    type(secants_type), intent(inout) :: secants !! keep the step
    Vec, intent(in) :: y !! it, scaled
    logical, intent(in) :: whole !! it was taken so, and contacts are where they are linearised
    PetscErrorCode, intent(out) :: ierr !! PETSc's error code, 0 for none
    PetscReal :: product, found(most_pairs + 1)

    ierr = 0
    secants%expects = .false.
    if (.not. whole) return
    PetscCall(VecCopy(y, secants%last, ierr))
    if (secants%at_once) then
      call sum_products(secants, y, secants%after, found, ierr)
      CHKERRQ(ierr)
      secants%last_cross(secants%order(:secants%pairs)) = found(:secants%pairs)
      product = found(secants%pairs + 1)
    else
      PetscCall(VecDot(y, y, product, ierr))
    end if
    secants%last_square = product
    secants%expects = product > 0.0_wp
  end subroutine expect_next

  !> Forgets all: there are new factors.
  subroutine forget_secants(secants)
    type(secants_type), intent(inout) :: secants !! pairs of steps
    secants%pairs = 0
    secants%expects = .false.
  end subroutine forget_secants

  !> Frees what PETSc holds; may be called twice.
  subroutine destroy_secants(secants)
    type(secants_type), intent(inout) :: secants !! pairs of steps
    PetscErrorCode :: ierr
    integer :: i

    if (.not. secants%created) return
    do i = 1, most_pairs
      PetscCallA(VecDestroy(secants%before(i), ierr))
      PetscCallA(VecDestroy(secants%after(i), ierr))
    end do
    PetscCallA(VecDestroy(secants%last, ierr))
    deallocate (secants%cross, secants%last_cross)
    secants%created = .false.
    call forget_secants(secants)
  end subroutine destroy_secants
end module gfb_secant_steps
