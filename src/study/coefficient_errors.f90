!> Errors of stiffness and damping, entry by entry, from their values on nested meshes.
module gfb_coefficient_errors
  use gfb_kinds, only: wp
  use gfb_grid_convergence, only: convergence_type, estimate_errors
  use gfb_shaft_motion, only: shaft_coordinates
  implicit none (type, external)
  private
  public :: entry_errors, worst_error

  integer, parameter :: side = 2 !! of a block: displacements or rotations
  integer, parameter :: blocks = shaft_coordinates/side
  real(wp), parameter :: vanishing = 1.0e-9_wp !! a coupling block below that of its neighbours [1]

contains

  !> Error of every entry on the finest mesh.
  pure function entry_errors(value, formal_order) result(error)
    real(wp), intent(in) :: value(:, :) !! [SI] (entry, mesh), each mesh twice as fine as the last
    real(wp), intent(in) :: formal_order !! of the elements [1]
    real(wp), allocatable :: error(:) !! [SI] of the finest mesh
    type(convergence_type), allocatable :: estimate(:)

    estimate = entry_estimates(value, formal_order)
    error = estimate%error
  end function entry_errors

  !> What the meshes say of every entry; those of a block share one order.
  !>
  !> Blocks are those of 2 x 2 of each matrix: force over displacement, force over rotation, ...
  pure function entry_estimates(value, formal_order) result(estimate)
    real(wp), intent(in) :: value(:, :) !! [SI] (entry, mesh), 4 x 4 matrices behind each other
    real(wp), intent(in) :: formal_order !! of the elements [1]
    type(convergence_type), allocatable :: estimate(:)
    integer :: entry(side**2), i, j, k

    allocate (estimate(size(value, 1)))
    do k = 0, size(value, 1)/shaft_coordinates**2 - 1
      do j = 0, blocks - 1
        do i = 0, blocks - 1
          entry = (k*shaft_coordinates + side*j)*shaft_coordinates + side*i + &
                  [1, 2, shaft_coordinates + 1, shaft_coordinates + 2]
          estimate(entry) = estimate_errors(value(entry, :), formal_order)
        end do
      end do
    end do
  end function entry_estimates

  !> The largest error of an entry over the largest entry of its block, with that entry's order.
  pure function worst_error(value, formal_order) result(worst)
    real(wp), intent(in) :: value(:, :) !! [SI] (entry, mesh), 4 x 4 matrices behind each other
    real(wp), intent(in) :: formal_order !! of the elements [1]
    type(convergence_type) :: worst !! its value is 1, so that its error is relative
    type(convergence_type), allocatable :: estimate(:)
    real(wp), allocatable :: scale(:)
    integer :: i

    worst%value = 1.0_wp
    if (size(value, 2) < 2) return
    worst%error = 0.0_wp
    worst%trusted = .true.
    scale = block_sizes(value(:, size(value, 2)))
    estimate = entry_estimates(value, formal_order)
    do i = 1, size(scale)
      if (.not. scale(i) > 0.0_wp) cycle
      if (.not. estimate(i)%error/scale(i) > worst%error) cycle
      worst%error = estimate(i)%error/scale(i)
      worst%order = estimate(i)%order
      worst%trusted = estimate(i)%trusted
    end do
  end function worst_error

  !> Largest entry of the block that each entry belongs to; 0 where the block vanishes.
  pure function block_sizes(value) result(sizes)
    real(wp), intent(in) :: value(:) !! [SI] 4 x 4 matrices behind each other
    real(wp), allocatable :: sizes(:) !! [SI]
    real(wp), allocatable :: matrix(:, :, :)
    real(wp) :: largest(blocks, blocks)
    integer :: i, j, k, n

    n = size(value)/shaft_coordinates**2
    matrix = reshape(value, [shaft_coordinates, shaft_coordinates, n])
    do k = 1, n
      do j = 1, blocks
        do i = 1, blocks
          largest(i, j) = maxval(abs(matrix(side*i - 1:side*i, side*j - 1:side*j, k)))
        end do
      end do
      where (largest <= vanishing*sqrt(largest(1, 1)*largest(2, 2))) largest = 0.0_wp
      do j = 1, blocks
        do i = 1, blocks
          matrix(side*i - 1:side*i, side*j - 1:side*j, k) = largest(i, j)
        end do
      end do
    end do
    sizes = reshape(matrix, [size(value)])
  end function block_sizes
end module gfb_coefficient_errors
