!> Which element of a sheet each slave point projects into.
!>
!> A grid of cells over the two longest directions of the sheet lists the elements around each cell,
!> so that a point is projected on the few near it, not on all.
module gfb_master_search
  use gfb_kinds, only: wp
  use gfb_projection, only: project, projection_type, master_nodes, projection_degenerate, &
                            edge_tolerance
  implicit none (type, external)
  private
  public :: find_masters

  !> Cells over a sheet, and the elements that lie in or near each.
  type :: cell_grid_type
    integer :: axis(2) = [1, 2]            !! directions of the grid
    integer :: cells(2) = 1                !! along each
    real(wp) :: lowest(2) = 0.0_wp         !! where the grid begins [m]
    real(wp) :: width(2) = 0.0_wp          !! of a cell [m]
    integer, allocatable :: first(:)       !! (cells + 1) first entry of a cell in `element`
    integer, allocatable :: element(:)     !! rising within a cell
  end type cell_grid_type

contains

  !> Finds the element that each point projects into.
  !>
  !> Of several (a shared edge) the one with the lowest number is taken, so that the answer does not
  !> hang on round-off. Where a sheet bends, points over a convex edge project into neither side:
  !> with `slack` they get the element that they miss least. Elements that `project` finds
  !> degenerate have no points.
  pure subroutine find_masters(point, position, element_nodes, reach, master, coordinates, slack)
    real(wp), intent(in) :: point(:, :)        !! (3, points) [m]
    real(wp), intent(in) :: position(:, :)     !! (3, nodes) [m]
    integer, intent(in) :: element_nodes(:, :) !! (4, elements), nodes from 1
    real(wp), intent(in) :: reach              !! points further off the sheet have no master [m]
    integer, intent(out) :: master(:)          !! (points), 0: none
    real(wp), intent(out) :: coordinates(:, :) !! (2, points), in the master; 0: none [1]
    real(wp), intent(in), optional :: slack    !! by which coordinates may exceed one [1]
    type(cell_grid_type) :: grid
    real(wp) :: allowed
    integer :: p, cell

    master = 0
    coordinates = 0.0_wp
    if (size(element_nodes, 2) == 0) return
    allowed = edge_tolerance
    if (present(slack)) allowed = max(slack, allowed)
    grid = grid_over(position, element_nodes)
    call list_elements(grid, position, element_nodes, reach, allowed)
    do p = 1, size(master)
      cell = cell_of(grid, point(grid%axis, p))
      associate (near => grid%element(grid%first(cell):grid%first(cell + 1) - 1))
        call find_master(point(:, p), position, element_nodes, near, reach, allowed, master(p), &
                         coordinates(:, p))
      end associate
    end do
  end subroutine find_masters

  !> Finds the best of the elements near a point.
  pure subroutine find_master(point, position, element_nodes, near, reach, allowed, master, &
                              coordinates)
    real(wp), intent(in) :: point(3)           !! [m]
    real(wp), intent(in) :: position(:, :)     !! (3, nodes) [m]
    integer, intent(in) :: element_nodes(:, :) !! (4, elements)
    integer, intent(in) :: near(:)             !! elements, rising
    real(wp), intent(in) :: reach              !! [m]
    real(wp), intent(in) :: allowed            !! by which coordinates may exceed one [1]
    integer, intent(inout) :: master           !! as it was, if none is found
    real(wp), intent(inout) :: coordinates(2)  !! in the master
    type(projection_type) :: projection
    real(wp) :: corner(3, master_nodes), box(3, 2), excess, least
    integer :: i

    least = huge(1.0_wp)
    do i = 1, size(near)
      corner = position(:, element_nodes(:, near(i)))
      box = box_around(corner, reach, allowed)
      if (any(point < box(:, 1)) .or. any(point > box(:, 2))) cycle
      projection = project(corner, point)
      if (projection%status == projection_degenerate) cycle
      if (norm2(projection%away) > reach) cycle
      excess = max(maxval(abs(projection%coordinates)) - 1.0_wp, edge_tolerance)
      ! Round-off must not let a later element win.
      if (excess > allowed .or. excess > least - edge_tolerance) cycle
      least = excess
      master = near(i)
      coordinates = projection%coordinates
    end do
  end subroutine find_master

  !> A grid over the nodes of the elements, with cells of the elements' mean extent.
  pure function grid_over(position, element_nodes) result(grid)
    real(wp), intent(in) :: position(:, :)     !! (3, nodes) [m]
    integer, intent(in) :: element_nodes(:, :) !! (4, elements)
    type(cell_grid_type) :: grid
    real(wp) :: box(3, 2), lowest(3), highest(3), mean(3), extent(3), count(2)
    integer :: element

    lowest = huge(1.0_wp)
    highest = -huge(1.0_wp)
    mean = 0.0_wp
    do element = 1, size(element_nodes, 2)
      box = box_around(position(:, element_nodes(:, element)), 0.0_wp, 0.0_wp)
      lowest = min(lowest, box(:, 1))
      highest = max(highest, box(:, 2))
      mean = mean + (box(:, 2) - box(:, 1))/size(element_nodes, 2)
    end do
    extent = highest - lowest
    grid%axis = pack([1, 2, 3], [1, 2, 3] /= minloc(extent, 1))
    associate (axis => grid%axis)
      count = 1.0_wp
      where (mean(axis) > 0.0_wp) count = extent(axis)/mean(axis)
      ! A strip that runs askew through its box would fill few of many cells.
      count = count*min(1.0_wp, sqrt(2.0_wp*size(element_nodes, 2)/product(count)))
      grid%cells = max(1, nint(count))
      grid%lowest = lowest(axis)
      grid%width = extent(axis)/grid%cells
    end associate
  end function grid_over

  !> Lists the elements of each cell.
  pure subroutine list_elements(grid, position, element_nodes, reach, allowed)
    type(cell_grid_type), intent(inout) :: grid
    real(wp), intent(in) :: position(:, :)     !! (3, nodes) [m]
    integer, intent(in) :: element_nodes(:, :) !! (4, elements)
    real(wp), intent(in) :: reach              !! [m]
    real(wp), intent(in) :: allowed            !! by which coordinates may exceed one [1]
    integer :: next(product(grid%cells) + 1)
    integer :: low(2), high(2), pass, element, i, j, cell

    next = 0
    do pass = 1, 2
      do element = 1, size(element_nodes, 2)
        associate (box => box_around(position(:, element_nodes(:, element)), reach, allowed))
          low = place_of(grid, box(grid%axis, 1))
          high = place_of(grid, box(grid%axis, 2))
        end associate
        do j = low(2), high(2)
          do i = low(1), high(1)
            cell = number_of(grid, i, j)
            next(cell) = next(cell) + 1
            if (pass == 2) grid%element(next(cell) - 1) = element
          end do
        end do
      end do
      if (pass == 1) call start_cells(grid, next)
    end do
  end subroutine list_elements

  !> From the number of entries of each cell to the place of its first.
  pure subroutine start_cells(grid, next)
    type(cell_grid_type), intent(inout) :: grid
    integer, intent(inout) :: next(:) !! (cells + 1) in: entries of a cell; out: its first place
    integer :: cell

    allocate (grid%first(size(next)))
    grid%first(1) = 1
    do cell = 1, size(next) - 1
      grid%first(cell + 1) = grid%first(cell) + next(cell)
    end do
    next = grid%first
    allocate (grid%element(grid%first(size(next)) - 1))
  end subroutine start_cells

  !> Box in which all points lie that an element may be master of.
  pure function box_around(corner, reach, allowed) result(box)
    real(wp), intent(in) :: corner(3, master_nodes) !! [m]
    real(wp), intent(in) :: reach                   !! [m]
    real(wp), intent(in) :: allowed                 !! by which coordinates may exceed one [1]
    real(wp) :: box(3, 2)                           !! lowest and highest [m]
    real(wp) :: margin(3)

    box(:, 1) = minval(corner, 2)
    box(:, 2) = maxval(corner, 2)
    ! A coordinate beyond one by x moves the foot by at most x times the extent, in each direction.
    margin = reach + 2.0_wp*allowed*(1.0_wp + allowed)*(box(:, 2) - box(:, 1))
    box(:, 1) = box(:, 1) - margin
    box(:, 2) = box(:, 2) + margin
  end function box_around

  !> Number of the cell of a point.
  pure function cell_of(grid, point) result(cell)
    type(cell_grid_type), intent(in) :: grid
    real(wp), intent(in) :: point(2) !! along the grid's directions [m]
    integer :: cell
    integer :: place(2)

    place = place_of(grid, point)
    cell = number_of(grid, place(1), place(2))
  end function cell_of

  !> Number of a cell.
  pure function number_of(grid, i, j) result(cell)
    type(cell_grid_type), intent(in) :: grid
    integer, intent(in) :: i, j !! its place
    integer :: cell

    cell = i + (j - 1)*grid%cells(1)
  end function number_of

  !> Place of the cell of a point; beyond the grid the nearest.
  pure function place_of(grid, point) result(place)
    type(cell_grid_type), intent(in) :: grid
    real(wp), intent(in) :: point(2) !! along the grid's directions [m]
    integer :: place(2)
    real(wp) :: along(2)

    along = 0.0_wp
    where (grid%width > 0.0_wp) along = (point - grid%lowest)/grid%width
    ! Cut before it becomes an integer: a point may be anywhere.
    place = 1 + int(max(0.0_wp, min(along, grid%cells - 0.5_wp)))
  end function place_of
end module gfb_master_search
