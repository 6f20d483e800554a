!> The grid of a flat rectangle: stations along x, rows along z.
module gfb_strip_grid
  use gfb_kinds, only: wp
  use gfb_grid_file, only: grid_type, block_bounds
  implicit none (type, external)
  private
  public :: strip_grid

contains

  !> One rank's part of the rectangle; point (station, row) is number (station - 1)*rows + row.
  pure function strip_grid(position_x, position_z, rank, ranks) result(grid)
    real(wp), intent(in) :: position_x(:) !! of the stations [m]
    real(wp), intent(in) :: position_z(:) !! of the rows [m]
    integer, intent(in) :: rank, ranks    !! this one, from 0, and their number
    type(grid_type) :: grid
    integer :: rows, corner, first, last, i

    rows = size(position_z)
    grid%points = rows*size(position_x)
    grid%cells = (rows - 1)*(size(position_x) - 1)
    call block_bounds(grid%points, rank, ranks, first, last)
    allocate (grid%point(3, last - first + 1), source=0.0_wp)
    do i = first, last
      grid%point(1, i - first + 1) = position_x((i - 1)/rows + 1)
      grid%point(3, i - first + 1) = position_z(modulo(i - 1, rows) + 1)
    end do
    call block_bounds(grid%cells, rank, ranks, first, last)
    allocate (grid%cell(4, last - first + 1))
    do i = first, last
      corner = (i - 1)/(rows - 1)*rows + modulo(i - 1, rows - 1) + 1
      grid%cell(:, i - first + 1) = [corner, corner + rows, corner + rows + 1, corner + 1]
    end do
  end function strip_grid
end module gfb_strip_grid
