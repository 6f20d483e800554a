!> What is known of the derivative of a map over a period: Arnoldi's basis, its multipliers, and the step that closes an orbit.
!>
!> The map's derivative M is what M V = W says on an orthonormal basis V, and nothing outside of it.
module gfb_map_derivative
  use gfb_kinds, only: wp
  use gfb_linear_solve, only: solve_general
  use gfb_period_map, only: period_map_type, dots, length_of
  implicit none (type, external)
  private
  public :: add_column, learn_step, model_step, find_multipliers

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

  real(wp), parameter :: counted = 0.3_wp        !! multipliers of this size must be [1]
  integer, parameter, public :: conditions = 2

  !> What is known of the map's derivative: W = M V.
  type, public :: derivative_type
    real(wp), allocatable :: basis(:, :) !! V, (entries, columns), orthonormal [1]
    real(wp), allocatable :: image(:, :) !! W, (entries, columns) [1]
  end type derivative_type

  !> Floquet multipliers, the largest first.
  type, public :: floquet_type
    complex(wp), allocatable :: value(:)     !! [1]
    complex(wp), allocatable :: vector(:, :) !! (entries, values), of length 1 [1]
  end type floquet_type

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
    if (info /= 0) error stop 'gfb_shooting: LAPACK found no eigenvalues'
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

  !> Broyden's formula: the derivative that is nearest to the one before and maps the last step as it was.
  subroutine learn_step(map, step, change, derivative)
    class(period_map_type), intent(in) :: map
    real(wp), intent(in) :: step(:)   !! of the point
    real(wp), intent(in) :: change(:) !! of what it is mapped to
    type(derivative_type), intent(inout) :: derivative
    real(wp), parameter :: new = 1.0e-6_wp !! part of a step outside of the basis
    real(wp) :: outside(size(step)), length, all, missing(size(step))
    real(wp), allocatable :: share(:)
    integer :: i

    all = length_of(map, step)
    if (.not. all > 0.0_wp) return
    outside = step
    do i = 1, 2
      outside = outside - matmul(derivative%basis, dots(map, derivative%basis, outside))
    end do
    length = length_of(map, outside)
    if (length > new*all) call add_column(outside/length, 0.0_wp*outside, derivative)
    share = dots(map, derivative%basis, step)/all
    missing = change/all - matmul(derivative%image, share)
    do i = 1, size(share)
      derivative%image(:, i) = derivative%image(:, i) + missing*share(i)
    end do
  end subroutine learn_step

  !> One more direction and what it is mapped to.
  subroutine add_column(direction, image, derivative)
    real(wp), intent(in) :: direction(:), image(:)
    type(derivative_type), intent(inout) :: derivative
    real(wp), allocatable :: grown(:, :)
    integer :: many

    many = size(derivative%basis, 2)
    allocate (grown(size(direction), many + 1))
    grown(:, :many) = derivative%basis
    grown(:, many + 1) = direction
    call move_alloc(grown, derivative%basis)
    allocate (grown(size(direction), many + 1))
    grown(:, :many) = derivative%image
    grown(:, many + 1) = image
    call move_alloc(grown, derivative%image)
  end subroutine add_column

  !> The step that closes an orbit by what is known of the map:
  !>
  !> $$ \delta = f + W z + \delta_T + \delta_p, \quad z = V^T \delta, \quad c_i^T \delta = r_i $$
  subroutine model_step(map, derivative, open, row, rest, step)
    class(period_map_type), intent(in) :: map !! the map
    type(derivative_type), intent(in) :: derivative !! what is known of it
    real(wp), intent(in) :: open(:)   !! f, by which the orbit does not close [1]
    real(wp), intent(in) :: row(:, :) !! c, (entries, conditions) [1]
    real(wp), intent(in) :: rest(:)   !! r, what is missing of the conditions [1]
    real(wp), intent(out) :: step(:)  !! delta; huge where there is none [1]
    real(wp), allocatable :: matrix(:, :), right(:)
    integer :: many, i, last
    logical :: solved

    many = size(derivative%basis, 2)
    last = size(open)
    allocate (matrix(many + conditions, many + conditions), right(many + conditions))
    do i = 1, many
      matrix(:many, i) = -dots(map, derivative%basis, derivative%image(:, i))
      matrix(many + 1:, i) = dots(map, row, derivative%image(:, i))
      matrix(i, i) = matrix(i, i) + 1.0_wp
    end do
    matrix(:many, many + 1:) = -transpose(derivative%basis(last - 1:, :))
    matrix(many + 1:, many + 1:) = transpose(row(last - 1:, :))
    right(:many) = dots(map, derivative%basis, open)
    right(many + 1:) = rest - dots(map, row, open)
    call solve_general(matrix, right, solved)
    step = huge(1.0_wp)
    if (.not. solved) return
    step = open + matmul(derivative%image, right(:many))
    step(last - 1:) = right(many + 1:)
  end subroutine model_step

  !> Multipliers by Arnoldi's matrix, and the largest residual of those that count.
  subroutine find_multipliers(derivative, inner, length, floquet, beside)
    type(derivative_type), intent(in) :: derivative
    real(wp), intent(in) :: inner(:, :) !! V^T W
    real(wp), intent(in) :: length      !! of what leads out of the basis
    type(floquet_type), intent(inout) :: floquet
    real(wp), intent(out) :: beside
    complex(wp) :: value(size(inner, 1)), vector(size(inner, 1), size(inner, 1))
    integer :: many

    many = size(inner, 1)
    call find_eigenvalues(inner, value, vector)
    beside = maxval(length*abs(vector(many, :)), abs(value) > counted)
    if (.not. any(abs(value) > counted)) beside = length*abs(vector(many, 1))
    floquet%value = value
    floquet%vector = matmul(derivative%basis, vector)
  end subroutine find_multipliers
end module gfb_map_derivative
