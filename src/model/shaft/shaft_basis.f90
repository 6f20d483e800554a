!> Few motions of a shaft that stand for all below a frequency: those of its journals, and the
!> lowest in which these rest [CraigBampton1968].
module gfb_shaft_basis
  use gfb_kinds, only: wp
  use gfb_linear_solve, only: solve_general
  use gfb_shaft, only: shaft_type
  implicit none (type, external)
  private
  public :: shaft_basis

  real(wp), parameter :: above = 3.0_wp !! frequencies that are kept, over the highest asked for [1]
  integer, parameter :: fewest = 4      !! modes that are kept

  interface
    !> LAPACK: eigenvalues of a symmetric pair.
    pure subroutine dsygv(itype, jobz, uplo, n, a, lda, b, ldb, w, work, lwork, info)
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

  !> Columns that span the motions of one plane.
  pure function shaft_basis(shaft, held, frequency) result(basis)
    type(shaft_type), intent(in) :: shaft
    integer, intent(in) :: held(:) !! the journals' motions in the plane
    real(wp), intent(in) :: frequency !! up to which motions are looked for [rad/s]
    real(wp), allocatable :: basis(:, :) !! (motion, column), the first ones those of the journals
    real(wp), allocatable :: follows(:, :), modes(:, :), mass(:, :), eigenvalue(:), work(:)
    integer, allocatable :: free(:)
    integer :: i, n, kept, info
    logical :: regular

    n = size(shaft%mass, 1)
    free = pack([(i, i=1, n)], [(all(held /= i), i=1, n)])
    follows = -shaft%stiffness(free, held)
    call solve_general(shaft%stiffness(free, free), follows, regular)
    if (.not. regular) follows = 0.0_wp
    modes = shaft%stiffness(free, free)
    mass = shaft%mass(free, free)
    allocate (eigenvalue(size(free)), work(8*size(free)))
    call dsygv(1, 'V', 'L', size(free), modes, size(free), mass, size(free), eigenvalue, work, &
               size(work), info)
    kept = 0
    if (info == 0) kept = min(size(free), max(fewest, count(eigenvalue < (above*frequency)**2)))
    allocate (basis(n, size(held) + kept), source=0.0_wp)
    do i = 1, size(held)
      basis(held(i), i) = 1.0_wp
    end do
    basis(free, :size(held)) = follows
    basis(free, size(held) + 1:) = modes(:, :kept)
  end function shaft_basis
end module gfb_shaft_basis
