!> Dense linear equations of beams and shafts, by LAPACK.
module gfb_linear_solve
  use gfb_kinds, only: wp
  implicit none (type, external)
  private
  public :: solve_positive, solve_general, factorize, solve_both_sides, determinant_logarithm

  interface
    !> LAPACK: symmetric positive definite equations.
    pure subroutine dposv(uplo, n, nrhs, a, lda, b, ldb, info)
      import :: wp
      implicit none (type, external)
      character(len=1), intent(in) :: uplo
      integer, intent(in) :: n, nrhs, lda, ldb
      real(wp), intent(inout) :: a(lda, n), b(ldb, nrhs)
      integer, intent(out) :: info
    end subroutine dposv

    !> LAPACK: general equations.
    pure subroutine dgesv(n, nrhs, a, lda, ipiv, b, ldb, info)
      import :: wp
      implicit none (type, external)
      integer, intent(in) :: n, nrhs, lda, ldb
      real(wp), intent(inout) :: a(lda, n), b(ldb, nrhs)
      integer, intent(out) :: ipiv(n), info
    end subroutine dgesv

    !> LAPACK: factors of a general matrix.
    pure subroutine dgetrf(m, n, a, lda, ipiv, info)
      import :: wp
      implicit none (type, external)
      integer, intent(in) :: m, n, lda
      real(wp), intent(inout) :: a(lda, n)
      integer, intent(out) :: ipiv(n), info
    end subroutine dgetrf

    !> LAPACK: general equations with factors.
    pure subroutine dgetrs(trans, n, nrhs, a, lda, ipiv, b, ldb, info)
      import :: wp
      implicit none (type, external)
      character(len=1), intent(in) :: trans
      integer, intent(in) :: n, nrhs, lda, ldb
      real(wp), intent(in) :: a(lda, n)
      integer, intent(in) :: ipiv(n)
      real(wp), intent(inout) :: b(ldb, nrhs)
      integer, intent(out) :: info
    end subroutine dgetrs

    !> LAPACK: general complex equations.
    pure subroutine zgesv(n, nrhs, a, lda, ipiv, b, ldb, info)
      import :: wp
      implicit none (type, external)
      integer, intent(in) :: n, nrhs, lda, ldb
      complex(wp), intent(inout) :: a(lda, n), b(ldb, nrhs)
      integer, intent(out) :: ipiv(n), info
    end subroutine zgesv

    !> LAPACK: factors of a general complex matrix.
    pure subroutine zgetrf(m, n, a, lda, ipiv, info)
      import :: wp
      implicit none (type, external)
      integer, intent(in) :: m, n, lda
      complex(wp), intent(inout) :: a(lda, n)
      integer, intent(out) :: ipiv(n), info
    end subroutine zgetrf

    !> LAPACK: solution with these.
    pure subroutine zgetrs(trans, n, nrhs, a, lda, ipiv, b, ldb, info)
      import :: wp
      implicit none (type, external)
      character(len=1), intent(in) :: trans
      integer, intent(in) :: n, nrhs, lda, ldb, ipiv(n)
      complex(wp), intent(in) :: a(lda, n)
      complex(wp), intent(inout) :: b(ldb, nrhs)
      integer, intent(out) :: info
    end subroutine zgetrs
  end interface

  !> Factors of a matrix, for right sides that come one after the other.
  type, public :: dense_factors_type
    real(wp), allocatable, private :: factor(:, :)
    integer, allocatable, private :: pivots(:)
  contains
    procedure :: solution
  end type dense_factors_type

  !> Equations of any matrix, for one right side or several; complex for one.
  interface solve_general
    procedure :: solve_one, solve_several, solve_complex
  end interface solve_general

contains

  !> Solves equations whose matrix is symmetric and positive definite; `.false.` if it is not.
  pure subroutine solve_positive(matrix, right_sides, solved)
    real(wp), intent(in) :: matrix(:, :) !! (n, n), in any unit [SI]
    real(wp), intent(inout) :: right_sides(:, :) !! (n, m), in and out [SI]
    logical, intent(out) :: solved !! the matrix is regular
    real(wp) :: factor(max(1, size(matrix, 1)), size(matrix, 1)) ! the matrix, then its factor [SI]
    integer :: n, info

    n = size(matrix, 1)
    factor(1:n, :) = matrix
    call dposv('L', n, size(right_sides, 2), factor, max(1, n), right_sides, max(1, n), info)
    solved = info == 0
  end subroutine solve_positive

  !> Solves equations of any matrix for one right side; `.false.` if it is singular.
  pure subroutine solve_one(matrix, right_side, solved)
    real(wp), intent(in) :: matrix(:, :) !! (n, n), in any unit [SI]
    real(wp), intent(inout) :: right_side(:) !! (n): in the right side, out the solution [SI]
    logical, intent(out) :: solved !! the matrix is regular
    real(wp) :: column(size(matrix, 1), 1) ! the right side, then the solution [SI]

    column(:, 1) = right_side
    call solve_several(matrix, column, solved)
    right_side = column(:, 1)
  end subroutine solve_one

  !> The same for several right sides.
  pure subroutine solve_several(matrix, right_sides, solved)
    real(wp), intent(in) :: matrix(:, :) !! (n, n), in any unit [SI]
    real(wp), intent(inout) :: right_sides(:, :) !! (n, m), in and out [SI]
    logical, intent(out) :: solved !! the matrix is regular
    real(wp), allocatable :: factor(:, :)  ! the matrix, then its factors [SI]
    real(wp), allocatable :: columns(:, :) ! right sides, then solutions [SI]
    integer :: pivots(size(matrix, 1)), n, info

    n = size(matrix, 1)
    allocate (factor(max(1, n), n), columns(max(1, n), size(right_sides, 2)))
    factor(1:n, :) = matrix
    columns(1:n, :) = right_sides
    call dgesv(n, size(columns, 2), factor, max(1, n), pivots, columns, max(1, n), info)
    right_sides = columns(1:n, :)
    solved = info == 0
  end subroutine solve_several

  !> Factors of any matrix; `.false.` if it is singular.
  pure subroutine factorize(matrix, factors, regular)
    real(wp), intent(in) :: matrix(:, :) !! (n, n), in any unit [SI]
    type(dense_factors_type), intent(out) :: factors
    logical, intent(out) :: regular
    integer :: info

    factors%factor = matrix
    allocate (factors%pivots(size(matrix, 1)))
    call dgetrf(size(matrix, 1), size(matrix, 1), factors%factor, max(1, size(matrix, 1)), &
                factors%pivots, info)
    regular = info == 0
  end subroutine factorize

  !> The solution for one right side.
  pure function solution(self, right_side) result(column)
    class(dense_factors_type), intent(in) :: self !! of a regular matrix
    real(wp), intent(in) :: right_side(:) !! (n), in any unit [SI]
    real(wp) :: column(size(right_side))
    real(wp) :: columns(size(right_side), 1)
    integer :: info

    columns(:, 1) = right_side
    call dgetrs('N', size(right_side), 1, self%factor, max(1, size(right_side)), self%pivots, &
                columns, max(1, size(right_side)), info)
    column = columns(:, 1)
  end function solution

  !> Solves complex equations for one right side; `.false.` if the matrix is singular.
  pure subroutine solve_complex(matrix, right_side, solved)
    complex(wp), intent(in) :: matrix(:, :) !! (n, n), in any unit [SI]
    complex(wp), intent(inout) :: right_side(:) !! (n): in the right side, out the solution [SI]
    logical, intent(out) :: solved !! the matrix is regular
    complex(wp), allocatable :: factor(:, :), column(:, :)
    integer :: pivots(size(right_side)), n, info

    n = size(right_side)
    factor = matrix
    column = reshape(right_side, [n, 1])
    call zgesv(n, 1, factor, max(1, n), pivots, column, max(1, n), info)
    right_side = column(:, 1)
    solved = info == 0
  end subroutine solve_complex

  !> Solves complex equations, and those of the transposed matrix.
  pure subroutine solve_both_sides(matrix, right, left, solved)
    complex(wp), intent(in) :: matrix(:, :) !! (n, n), in any unit [SI]
    complex(wp), intent(inout) :: right(:)  !! (n): in the right side, out the solution [SI]
    complex(wp), intent(inout) :: left(:)   !! (n): the same of the transposed matrix [SI]
    logical, intent(out) :: solved !! the matrix is regular
    complex(wp), allocatable :: factor(:, :)
    integer :: pivots(size(right)), n, info

    n = size(right)
    factor = matrix
    call zgetrf(n, n, factor, max(1, n), pivots, info)
    solved = info == 0
    if (.not. solved) return
    call zgetrs('N', n, 1, factor, max(1, n), pivots, right, max(1, n), info)
    call zgetrs('T', n, 1, factor, max(1, n), pivots, left, max(1, n), info)
  end subroutine solve_both_sides

  !> Logarithm of a matrix's determinant, up to multiples of 2 pi i; of none that of next to none.
  pure complex(wp) function determinant_logarithm(matrix) result(logarithm)
    complex(wp), intent(in) :: matrix(:, :) !! (n, n), in any unit [SI]
    complex(wp), allocatable :: factor(:, :)
    integer :: pivots(size(matrix, 1)), i, n, info

    n = size(matrix, 1)
    factor = matrix
    call zgetrf(n, n, factor, max(1, n), pivots, info)
    logarithm = 0.0_wp
    do i = 1, n
      associate (pivot => factor(i, i)*merge(1.0_wp, -1.0_wp, pivots(i) == i))
        logarithm = logarithm + cmplx(log(max(tiny(1.0_wp), abs(pivot))), &
                                      atan2(aimag(pivot), real(pivot, wp)), wp)
      end associate
    end do
  end function determinant_logarithm
end module gfb_linear_solve
