!> Eigenvalues of a small dense matrix, by LAPACK.
module gfb_eigenvalues
  use gfb_kinds, only: wp
  implicit none (type, external)
  private
  public :: find_eigenvalues

  interface
    !> LAPACK: eigenvalues and eigenvectors of a general matrix.
    subroutine dgeev(jobvl, jobvr, n, a, lda, wr, wi, vl, ldvl, vr, ldvr, work, lwork, info)
      import :: wp
      implicit none (type, external)
      character(len=1), intent(in) :: jobvl, jobvr
      integer, intent(in) :: n, lda, ldvl, ldvr, lwork
      real(wp), intent(inout) :: a(lda, n)
      real(wp), intent(out) :: wr(n), wi(n), vl(ldvl, n), vr(ldvr, n), work(lwork)
      integer, intent(out) :: info
    end subroutine dgeev
  end interface

contains

  !> Eigenvalues by falling size, and their vectors of length 1.
  subroutine find_eigenvalues(matrix, value, vector)
    real(wp), intent(in) :: matrix(:, :)      !! (n, n) [1]
    complex(wp), intent(out) :: value(:)      !! (n) [1]
    complex(wp), intent(out) :: vector(:, :)  !! (n, n) a column a value [1]
    real(wp) :: copy(size(matrix, 1), size(matrix, 1)), right(size(matrix, 1), size(matrix, 1)), &
      left(1, size(matrix, 1))
    real(wp) :: real_part(size(matrix, 1)), imaginary_part(size(matrix, 1)), work(8*size(matrix, 1))
    complex(wp) :: found(size(matrix, 1)), column(size(matrix, 1), size(matrix, 1))
    logical :: left_over(size(matrix, 1))
    integer :: n, i, k, info

    n = size(matrix, 1)
    copy = matrix
    call dgeev('N', 'V', n, copy, n, real_part, imaginary_part, left, 1, right, n, work, &
      size(work), info)
    if (info /= 0) error stop 'gfb_eigenvalues: LAPACK found no eigenvalues'
    found = cmplx(real_part, imaginary_part, wp)
    i = 1
    do while (i <= n)
      column(:, i) = right(:, i)
      if (abs(imaginary_part(i)) > 0.0_wp .and. i < n) then ! a conjugate pair has two real columns
        column(:, i) = cmplx(right(:, i), right(:, i + 1), wp)
        column(:, i + 1) = conjg(column(:, i))
        i = i + 1
      end if
      i = i + 1
    end do
    left_over = .true.
    do k = 1, n
      i = maxloc(abs(found), 1, left_over)
      left_over(i) = .false.
      value(k) = found(i)
      vector(:, k) = column(:, i)
    end do
  end subroutine find_eigenvalues
end module gfb_eigenvalues
