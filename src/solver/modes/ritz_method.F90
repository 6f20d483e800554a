#include "gfb_petsc.h"
!> Ritz's method over a few vectors: their products in the mass, the small eigenvalue problem, their sums.
!>
!> $$ A q = \omega^2 B q, \qquad \phi = \sum_i q_i v_i $$
module gfb_ritz_method
  use petscmat
  use gfb_kinds, only: wp
  implicit none (type)
  private
  public :: mass_products, solve_symmetric, combine

  interface
    !> LAPACK: eigenvalues and vectors of a symmetric matrix over a positive definite one.
    subroutine dsygv(itype, jobz, uplo, n, a, lda, b, ldb, w, work, lwork, info)
      import :: wp
      implicit none (type, external)
      integer, intent(in) :: itype, n, lda, ldb, lwork
      character(len=1), intent(in) :: jobz, uplo
      real(wp), intent(inout) :: a(lda, n), b(ldb, n)
      real(wp), intent(out) :: w(n), work(lwork)
      integer, intent(out) :: info
    end subroutine dsygv
  end interface

contains

  !> Products of vectors in the mass.
  function mass_products(shape, mass) result(modal_mass)
    Vec, intent(in) :: shape(:) !! n vectors
    Mat, intent(in) :: mass !! M
    real(wp) :: modal_mass(size(shape), size(shape))
    PetscScalar :: product
    Vec :: momentum
    PetscErrorCode :: ierr
    integer :: i, k

    PetscCallA(VecDuplicate(shape(1), momentum, ierr))
    do k = 1, size(shape)
      PetscCallA(MatMult(mass, shape(k), momentum, ierr))
      do i = 1, k
        PetscCallA(VecDot(shape(i), momentum, product, ierr))
        modal_mass(i, k) = product
        modal_mass(k, i) = product
      end do
    end do
    PetscCallA(VecDestroy(momentum, ierr))
  end function mass_products

  !> Eigenvalues, in rising order, and vectors of a symmetric matrix over a positive definite one.
  subroutine solve_symmetric(matrix, over, eigenvalue)
    !> (n, n) upper triangle is read, in any unit [SI]; out: the vectors, scaled to 1 over the other matrix
    real(wp), intent(inout) :: matrix(:, :)
    real(wp), intent(inout) :: over(:, :) !! (n, n), positive definite, in any unit [SI]; unchanged
    real(wp), intent(out) :: eigenvalue(:) !! (n), rising, in the unit of `matrix` over that of `over` [SI]
    real(wp) :: vectors(size(eigenvalue), size(eigenvalue)), below(size(eigenvalue), size(eigenvalue))
    real(wp) :: work(8*size(eigenvalue))
    integer :: info, n

    n = size(eigenvalue)
    vectors = matrix
    below = over
    call dsygv(1, 'V', 'U', n, vectors, n, below, n, eigenvalue, work, size(work), info)
    if (info /= 0) error stop 'modes that are not independent'
    matrix = vectors
  end subroutine solve_symmetric

  !> Sums of vectors.
  subroutine combine(weight, old, new)
    real(wp), intent(in) :: weight(:, :) !! (old, new) [1]
    Vec, intent(in) :: old(:) !! vectors that are summed
    Vec, intent(in) :: new(:)            !! others than the old
    PetscErrorCode :: ierr
    integer :: i, k

    do k = 1, size(new)
      PetscCallA(VecSet(new(k), 0.0_wp, ierr))
      do i = 1, size(old)
        PetscCallA(VecAXPY(new(k), weight(i, k), old(i), ierr))
      end do
    end do
  end subroutine combine
end module gfb_ritz_method
