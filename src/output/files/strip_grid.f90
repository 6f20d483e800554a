!> The grid of flat rectangles, one behind the other: stations along x, rows along z.
module gfb_strip_grid
  use gfb_kinds, only: wp
  use gfb_grid, only: grid_type, block_bounds
  implicit none (type, external)
  private
  public :: strip_grid

contains

  !> One rank's part of the rectangles; point (station, row) is number (station - 1)*rows + row.
  pure function strip_grid(position_x, strips, position_z, rank, ranks) result(grid)
    real(wp), intent(in) :: position_x(:) !! of the stations, strip by strip [m]
    integer, intent(in) :: strips         !! rectangles that do not touch, of as many stations
    real(wp), intent(in) :: position_z(:) !! of the rows [m]
    integer, intent(in) :: rank, ranks    !! this one, from 0, and their number
    type(grid_type) :: grid
    integer :: rows, corner, column, columns, first, last, i

    rows = size(position_z)
    grid%points = rows*size(position_x)
    columns = size(position_x)/strips - 1 ! of one
    grid%cells = (rows - 1)*strips*columns
    call block_bounds(grid%points, rank, ranks, first, last)
    allocate (grid%point(3, last - first + 1), source=0.0_wp)
    do i = first, last
      grid%point(1, i - first + 1) = position_x((i - 1)/rows + 1)
      grid%point(3, i - first + 1) = position_z(modulo(i - 1, rows) + 1)
    end do
    call block_bounds(grid%cells, rank, ranks, first, last)
    allocate (grid%cell(4, last - first + 1))
    do i = first, last
      column = (i - 1)/(rows - 1)
      corner = (column + column/columns)*rows + modulo(i - 1, rows - 1) + 1
      grid%cell(:, i - first + 1) = [corner, corner + rows, corner + rows + 1, corner + 1]
    end do
  end function strip_grid
end module gfb_strip_grid
