#include "gfb_petsc.h"
!> What the steps of Newton's method with kept factors teach of the matrix: Broyden's method.
!>
!> Two steps \( y_n, y_{n+1} \) in succession, \( x_{n+1} = x_n - y_n \), tell how the residual has changed along the first
!> one. The least change of the inverse that agrees with it is a dyad,
!>
!> $$ H_{n+1} = \Bigl( I + \frac{y_{n+1} y_n^T}{y_n^T y_n} \Bigr) H_n, \quad
!>    y_{n+1} = \frac{z}{1 - y_n^T z/y_n^T y_n}, \quad z = H_n f_{n+1}, $$
!>
!> so that a pair of steps is all that is kept. What was learned serves the next equations, too, as long as the factors do.
!>
!> Source: [Kelley1995] section 7.3.
module gfb_secant_steps
  use petscvec
  use gfb_kinds, only: wp
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
  end subroutine begin_secants

  !> Improves a step that kept factors have found, and learns from it.
  subroutine improve_step(secants, y, ierr)
    type(secants_type), intent(inout) :: secants !! pairs of steps; gets one more
    Vec, intent(in) :: y !! the step, scaled; is changed
    PetscErrorCode, intent(out) :: ierr !! PETSc's error code, 0 for none
    PetscReal :: product
    real(wp) :: divisor
    integer :: i, oldest

    ierr = 0
    do i = 1, secants%pairs
      associate (pair => secants%order(i))
        PetscCall(VecDot(secants%before(pair), y, product, ierr))
        PetscCall(VecAXPY(y, product/secants%square(pair), secants%after(pair), ierr))
      end associate
    end do
    if (.not. secants%expects) return
    secants%expects = .false.
    PetscCall(VecDot(secants%last, y, product, ierr))
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
    end associate
  end subroutine improve_step

  !> A step was taken: where whole, the next one will tell something of the matrix.
  subroutine expect_next(secants, y, whole, ierr)
    type(secants_type), intent(inout) :: secants !! keep the step
    Vec, intent(in) :: y !! it, scaled
    logical, intent(in) :: whole !! it was taken so, and contacts are where they are linearised
    PetscErrorCode, intent(out) :: ierr !! PETSc's error code, 0 for none
    PetscReal :: product

    ierr = 0
    secants%expects = .false.
    if (.not. whole) return
    PetscCall(VecDot(y, y, product, ierr))
    secants%last_square = product
    secants%expects = product > 0.0_wp
    PetscCall(VecCopy(y, secants%last, ierr))
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
    secants%created = .false.
    call forget_secants(secants)
  end subroutine destroy_secants
end module gfb_secant_steps
