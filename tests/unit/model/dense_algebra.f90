!> Dense matrices as the tests of condensation compare with: LAPACK, no PETSc.
module dense_algebra
  use gfb_kinds, only: wp
  implicit none (type, external)
  private
  public :: dense_schur, dense_solution, spread_out, random_definite

  interface
    subroutine dposv(uplo, n, nrhs, a, lda, b, ldb, info)
      import :: wp
      implicit none (type, external)
      character, intent(in) :: uplo
      integer, intent(in) :: n, nrhs, lda, ldb
      real(wp), intent(inout) :: a(lda, *), b(ldb, *)
      integer, intent(out) :: info
    end subroutine dposv
  end interface

contains

  !> The inverse of a positive definite matrix times some columns.
  function dense_solution(matrix, columns) result(solution)
    real(wp), intent(in) :: matrix(:, :), columns(:, :)
    real(wp) :: solution(size(columns, 1), size(columns, 2))
    real(wp), allocatable :: factor(:, :)
    integer :: info

    factor = matrix
    solution = columns
    call dposv('L', size(matrix, 1), size(columns, 2), factor, max(1, size(matrix, 1)), solution, &
               max(1, size(matrix, 1)), info)
    if (info /= 0) error stop 'dense_algebra: the matrix is not positive definite'
  end function dense_solution

  !> Schur complement onto the kept unknowns.
  function dense_schur(matrix, kept) result(schur)
    real(wp), intent(in) :: matrix(:, :)
    logical, intent(in) :: kept(:)
    real(wp) :: schur(count(kept), count(kept))
    integer, allocatable :: b(:), i(:)
    integer :: k

    b = pack([(k, k=1, size(kept))], kept)
    i = pack([(k, k=1, size(kept))], .not. kept)
    schur = matrix(b, b)
    if (size(i) > 0) schur = schur - matmul(matrix(b, i), dense_solution(matrix(i, i), matrix(i, &
      b)))
  end function dense_schur

  !> A number between 0 and 1 that looks random and is the same on every rank and in every run.
  elemental function spread_out(number) result(value)
    integer, intent(in) :: number
    real(wp) :: value
    value = modulo(43758.5453_wp*sin(12.9898_wp*real(number, wp)), 1.0_wp)
  end function spread_out

  !> A sparse positive definite matrix without any order; a tenth of it is not zero.
  function random_definite(n, seed) result(matrix)
    integer, intent(in) :: n, seed
    real(wp) :: matrix(n, n)
    real(wp) :: value
    integer :: i, j

    matrix = 0.0_wp
    do j = 1, n
      do i = j + 1, n
        if (spread_out(seed + i + n*j) > 0.1_wp) cycle
        value = 2.0_wp*spread_out(seed + 1000000 + i + n*j) - 1.0_wp
        matrix(i, j) = value
        matrix(j, i) = value
      end do
    end do
    do i = 1, n
      matrix(i, i) = sum(abs(matrix(:, i))) + 0.1_wp + spread_out(seed + 2000000 + i)
    end do
  end function random_definite
end module dense_algebra
