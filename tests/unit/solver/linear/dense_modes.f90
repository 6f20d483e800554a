!> Eigenvalues of dense matrices as the tests of stability compare with: LAPACK, no PETSc.
module dense_modes
  use gfb_kinds, only: wp
  implicit none (type, external)
  private
  public :: damped_modes, inverse_of

  interface
    !> LAPACK: general equations.
    subroutine dgesv(n, nrhs, a, lda, ipiv, b, ldb, info)
      import :: wp
      implicit none (type, external)
      integer, intent(in) :: n, nrhs, lda, ldb
      real(wp), intent(inout) :: a(lda, n), b(ldb, nrhs)
      integer, intent(out) :: ipiv(n), info
    end subroutine dgesv

    !> LAPACK: eigenvalues of a general matrix.
    subroutine dgeev(jobvl, jobvr, n, a, lda, wr, wi, vl, ldvl, vr, ldvr, work, lwork, info)
      import :: wp
      implicit none (type, external)
      character, intent(in) :: jobvl, jobvr
      integer, intent(in) :: n, lda, ldvl, ldvr, lwork
      real(wp), intent(inout) :: a(lda, n)
      real(wp), intent(out) :: wr(n), wi(n), vl(ldvl, 1), vr(ldvr, 1), work(lwork)
      integer, intent(out) :: info
    end subroutine dgeev
  end interface

contains

  !> Finite eigenvalues of stiffness y = lambda damping y: those of the damped unknowns' stiffness,
  !> all others eliminated, over their damping.
  function damped_modes(stiffness, damping) result(lambda)
    real(wp), intent(in) :: stiffness(:, :) !! (n, n)
    real(wp), intent(in) :: damping(:)      !! (n), not negative
    complex(wp), allocatable :: lambda(:)
    real(wp), allocatable :: own(:, :), coupling(:, :), solution(:, :)
    integer, allocatable :: damped(:), rest(:)
    integer :: i

    damped = pack([(i, i=1, size(damping))], damping > 0.0_wp)
    rest = pack([(i, i=1, size(damping))], .not. damping > 0.0_wp)
    own = stiffness(damped, damped)
    if (size(rest) > 0) then
      coupling = stiffness(rest, damped)
      solution = solved(stiffness(rest, rest), coupling)
      own = own - matmul(stiffness(damped, rest), solution)
    end if
    do i = 1, size(damped)
      own(i, :) = own(i, :)/damping(damped(i))
    end do
    lambda = eigenvalues(own)
  end function damped_modes

  !> The inverse of a matrix.
  function inverse_of(matrix) result(inverse)
    real(wp), intent(in) :: matrix(:, :)
    real(wp) :: inverse(size(matrix, 1), size(matrix, 1))
    real(wp), allocatable :: unit(:, :)
    integer :: i

    allocate (unit(size(matrix, 1), size(matrix, 1)), source=0.0_wp)
    do i = 1, size(matrix, 1)
      unit(i, i) = 1.0_wp
    end do
    inverse = solved(matrix, unit)
  end function inverse_of

  !> The inverse of a matrix times some columns.
  function solved(matrix, columns) result(solution)
    real(wp), intent(in) :: matrix(:, :), columns(:, :)
    real(wp), allocatable :: solution(:, :), factor(:, :)
    integer :: pivot(size(matrix, 1)), info

    factor = matrix
    solution = columns
    call dgesv(size(matrix, 1), size(columns, 2), factor, size(matrix, 1), pivot, solution, &
               size(matrix, 1), info)
    if (info /= 0) error stop 'dense_modes: a singular matrix'
  end function solved

  !> Eigenvalues of a matrix.
  function eigenvalues(matrix) result(lambda)
    real(wp), intent(in) :: matrix(:, :)
    complex(wp) :: lambda(size(matrix, 1))
    real(wp), allocatable :: copy(:, :), work(:)
    real(wp) :: real_part(size(matrix, 1)), imaginary_part(size(matrix, 1)), left(1, 1), right(1, 1)
    integer :: info

    copy = matrix
    allocate (work(8*size(matrix, 1)))
    call dgeev('N', 'N', size(matrix, 1), copy, size(matrix, 1), real_part, imaginary_part, left, &
               1, right, 1, work, size(work), info)
    if (info /= 0) error stop 'dense_modes: no eigenvalues'
    lambda = cmplx(real_part, imaginary_part, wp)
  end function eigenvalues
end module dense_modes
