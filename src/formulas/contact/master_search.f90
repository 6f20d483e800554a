!> Which element of a sheet each slave point projects into.
!>
!> A grid of cells over the two longest directions of the sheet lists the elements around each cell,
!> so that a point is projected on the few near it, not on all.
!>
!> Closest point of a bilinear four-node element.
!>
!> $$ \mathbf{r}(\xi, \eta) = \mathbf{c} + \mathbf{a} \xi + \mathbf{b} \eta + \mathbf{w} \xi \eta $$
!>
!> Nodes run counter-clockwise seen from the side that the normal points to, which is the slave's.
!> The area vector \( \mathbf{r}_{,\xi} \times \mathbf{r}_{,\eta} = \mathbf{a} \times \mathbf{b} +
!> \mathbf{a} \times \mathbf{w} \, \xi + \mathbf{w} \times \mathbf{b} \, \eta \) is linear: a
!> surface that faces in one direction at its corners does so in the whole element, and beyond
!> up to a line.
module gfb_master_search
  use gfb_kinds, only: wp
  implicit none (type, external)
  private
  public :: project, find_masters

  integer, parameter :: master_nodes = 4 !! nodes of an element

  integer, parameter, public :: projection_inside = 1
  integer, parameter, public :: projection_outside = 2    !! the foot lies beyond the element
  integer, parameter, public :: projection_degenerate = 3 !! no element, or no nearest point

  !> Coordinates that exceed one by less are inside: round-off of a point on an edge.
  real(wp), parameter :: edge_tolerance = 1.0e-9_wp

  !> Where a point projects to.
  type, public :: projection_type
    integer :: status = projection_degenerate
    real(wp) :: coordinates(2) = 0.0_wp      !! xi, eta of the foot [1]
    real(wp) :: shape(master_nodes) = 0.0_wp !! shape functions there [1]
    real(wp) :: foot(3) = 0.0_wp             !! r [m]
    real(wp) :: away(3) = 0.0_wp             !! R - r [m]
    real(wp) :: distance = 0.0_wp            !! (R - r) . n, positive on the normal's side [m]
    real(wp) :: tangent(3, 2) = 0.0_wp       !! unit vectors; right-handed with the normal [1]
    real(wp) :: normal(3) = 0.0_wp           !! unit vector [1]
  end type projection_type

  !> Coefficients of the element's surface.
  type :: surface_type
    real(wp) :: centre(3) !! c [m]
    real(wp) :: along(3)  !! a [m]
    real(wp) :: across(3) !! b [m]
    real(wp) :: twist(3)  !! w [m]
    real(wp) :: area(3)   !! area vector at the centre [m2]
    real(wp) :: size      !! the longer of a and b [m]
  end type surface_type

  real(wp), parameter :: node_xi(master_nodes) = [-1.0_wp, 1.0_wp, 1.0_wp, -1.0_wp]
  real(wp), parameter :: node_eta(master_nodes) = [-1.0_wp, -1.0_wp, 1.0_wp, 1.0_wp]

  integer, parameter :: most_steps = 50             !! five do on any sensible element
  integer, parameter :: most_halvings = 40          !! of one step
  !> Newton step at which the foot is found: near round-off, and the error is its square.
  real(wp), parameter :: step_tolerance = 1.0e-12_wp
  !> Area below which there is none, relative to the centre's or to that of a square.
  real(wp), parameter :: least_area = 1.0e-6_wp
  !> Determinant of the Hessian, relative to its diagonal, below which it is not positive.
  real(wp), parameter :: least_curvature = 1.0e-10_wp
  real(wp), parameter :: rounding = 4.0_wp*epsilon(1.0_wp) !! of a distance, relative

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

  !> Foot of a point on the surface of an element, [Gu2020] eq. 7.
  !>
  !> $$ (\mathbf{R} - \mathbf{r}) \cdot \mathbf{r}_{,\xi} = 0, \qquad
  !>    (\mathbf{R} - \mathbf{r}) \cdot \mathbf{r}_{,\eta} = 0 $$
  !>
  !> Newton-Raphson from the centre, so that the answer depends on positions alone.
  !> Outside: the foot lies on the surface's continuation; where that ends (it folds over beyond a
  !> distorted element) at its end. Degenerate: an element that is collapsed, concave or crossed, or
  !> clockwise seen from the side it should face; or a point in or beyond the centre of curvature.
  pure function project(corner, point, facing) result(projection)
    real(wp), intent(in) :: corner(3, master_nodes)  !! positions of the nodes [m]
    real(wp), intent(in) :: point(3)                 !! R [m]
    real(wp), intent(in), optional :: facing(3) !! the normal's side, about; any length [1]
    type(projection_type) :: projection
    type(surface_type) :: surface
    logical :: found
    integer :: nearest

    surface = surface_of(corner)
    if (.not. is_element(surface)) return
    if (present(facing)) then
      if (.not. dot_product(surface%area, facing) > 0.0_wp) return
    end if
    call find_foot(surface, point, projection%coordinates, found)
    if (.not. found .and. any(abs(projection%coordinates) > 1.0_wp)) then
      ! A wild element's fold can stop the path from the centre to a foot within.
      nearest = minloc(norm2(corner - spread(point, 2, master_nodes), 1), 1)
      projection%coordinates = [node_xi(nearest), node_eta(nearest)]
      call find_foot(surface, point, projection%coordinates, found)
    end if
    if (any(abs(projection%coordinates) > 1.0_wp + edge_tolerance)) then
      projection%status = projection_outside
    else if (found) then
      projection%status = projection_inside
    end if
    call add_frame(surface, point, projection)
  end function project

  !> Surface through four nodes.
  pure function surface_of(corner) result(surface)
    real(wp), intent(in) :: corner(3, master_nodes) !! [m]
    type(surface_type) :: surface

    surface%centre = 0.25_wp*sum(corner, 2)
    surface%along = 0.25_wp*matmul(corner, node_xi)
    surface%across = 0.25_wp*matmul(corner, node_eta)
    surface%twist = 0.25_wp*matmul(corner, node_xi*node_eta)
    surface%area = cross(surface%along, surface%across)
    surface%size = max(norm2(surface%along), norm2(surface%across))
  end function surface_of

  !> Whether a surface has an area that faces in the same direction in the whole element.
  pure logical function is_element(surface) result(yes)
    type(surface_type), intent(in) :: surface
    integer :: a

    yes = norm2(surface%area) > least_area*surface%size**2
    do a = 1, master_nodes
      if (.not. yes) return
      yes = relative_area(surface, [node_xi(a), node_eta(a)]) > least_area
    end do
  end function is_element

  !> Area at a place in the centre's direction, over the centre's.
  pure function relative_area(surface, place) result(ratio)
    type(surface_type), intent(in) :: surface
    real(wp), intent(in) :: place(2) !! xi, eta
    real(wp) :: ratio                !! [1]

    associate (area => surface%area)
      ratio = dot_product(area_at(surface, place), area)/dot_product(area, area)
    end associate
  end function relative_area

  !> Newton-Raphson on half the squared distance, with the exact Hessian where it is positive.
  !>
  !> A step is halved until it does not lead away, nor over the fold: on its far side a distorted
  !> surface passes through the same points once more.
  pure subroutine find_foot(surface, point, place, found)
    type(surface_type), intent(in) :: surface
    real(wp), intent(in) :: point(3)    !! [m]
    real(wp), intent(inout) :: place(2) !! xi, eta; in: start; out: foot, or as near as could be got
    logical, intent(out) :: found
    real(wp) :: step(2), trial(2), distance, noise, part, far
    logical :: positive
    integer :: i, halving

    found = .false.
    noise = rounding*(norm2(point - surface%centre) + surface%size)
    do i = 1, most_steps
      distance = norm2(away_at(surface, point, place))
      call newton_step(surface, point, place, step, positive)
      part = 1.0_wp
      do halving = 0, most_halvings
        if (halving == most_halvings) return
        trial = place + part*step
        if (relative_area(surface, trial) > 0.5_wp*least_area) then
          if (norm2(away_at(surface, point, trial)) <= distance + noise) exit
        end if
        part = 0.5_wp*part
      end do
      place = trial
      far = 1.0_wp + maxval(abs(place)) + distance/surface%size
      if (maxval(abs(step)) <= step_tolerance*far) then
        found = positive
        return
      end if
    end do
  end subroutine find_foot

  !> Step towards the foot; without the twist's term where the surface curves away with it.
  pure subroutine newton_step(surface, point, place, step, positive)
    type(surface_type), intent(in) :: surface
    real(wp), intent(in) :: point(3)  !! [m]
    real(wp), intent(in) :: place(2)  !! xi, eta
    real(wp), intent(out) :: step(2)  !! change of xi, eta
    logical, intent(out) :: positive  !! the exact Hessian is positive definite
    real(wp) :: slope(3, 2), away(3), hessian(2, 2)

    slope = slope_at(surface, place)
    away = away_at(surface, point, place)
    hessian = hessian_of(slope, surface%twist, away)
    positive = determinant(hessian) > least_curvature*hessian(1, 1)*hessian(2, 2)
    if (.not. positive) hessian = matmul(transpose(slope), slope)
    step = matmul(inverse(hessian), matmul(away, slope))
  end subroutine newton_step

  !> Second derivatives of half the squared distance.
  pure function hessian_of(slope, twist, away) result(hessian)
    real(wp), intent(in) :: slope(3, 2) !! of the surface along xi and eta [m]
    real(wp), intent(in) :: twist(3)    !! [m]
    real(wp), intent(in) :: away(3)     !! R - r [m]
    real(wp) :: hessian(2, 2)           !! [m2]

    hessian = matmul(transpose(slope), slope)
    hessian(1, 2) = hessian(1, 2) - dot_product(away, twist)
    hessian(2, 1) = hessian(1, 2)
  end function hessian_of

  !> Adds what belongs to the coordinates: shape functions, foot, distance, tangents and normal.
  pure subroutine add_frame(surface, point, projection)
    type(surface_type), intent(in) :: surface
    real(wp), intent(in) :: point(3) !! [m]
    type(projection_type), intent(inout) :: projection
    real(wp) :: slope(3, 2), area(3)

    associate (place => projection%coordinates, normal => projection%normal)
      projection%shape = 0.25_wp*(1.0_wp + node_xi*place(1))*(1.0_wp + node_eta*place(2))
      projection%away = away_at(surface, point, place)
      projection%foot = point - projection%away
      slope = slope_at(surface, place)
      area = area_at(surface, place)
      normal = area/norm2(area)
      projection%distance = dot_product(projection%away, normal)
      projection%tangent(:, 1) = slope(:, 1)/norm2(slope(:, 1))
      projection%tangent(:, 2) = cross(normal, projection%tangent(:, 1))
    end associate
  end subroutine add_frame

  !> R - r, relative to the centre: a small element far from the origin loses no digits.
  pure function away_at(surface, point, place) result(away)
    type(surface_type), intent(in) :: surface
    real(wp), intent(in) :: point(3) !! [m]
    real(wp), intent(in) :: place(2) !! xi, eta
    real(wp) :: away(3)              !! [m]

    away = (point - surface%centre) - (place(1)*surface%along + place(2)*surface%across &
           + place(1)*place(2)*surface%twist)
  end function away_at

  !> Derivatives of the position along xi and eta.
  pure function slope_at(surface, place) result(slope)
    type(surface_type), intent(in) :: surface
    real(wp), intent(in) :: place(2) !! xi, eta
    real(wp) :: slope(3, 2)          !! [m]

    slope(:, 1) = surface%along + place(2)*surface%twist
    slope(:, 2) = surface%across + place(1)*surface%twist
  end function slope_at

  !> Vector product of the two slopes.
  pure function area_at(surface, place) result(area)
    type(surface_type), intent(in) :: surface
    real(wp), intent(in) :: place(2) !! xi, eta
    real(wp) :: area(3)              !! [m2]
    real(wp) :: slope(3, 2)

    slope = slope_at(surface, place)
    area = cross(slope(:, 1), slope(:, 2))
  end function area_at

  !> Vector product.
  pure function cross(a, b) result(c)
    real(wp), intent(in) :: a(3), b(3)
    real(wp) :: c(3)
    c = [a(2)*b(3) - a(3)*b(2), a(3)*b(1) - a(1)*b(3), a(1)*b(2) - a(2)*b(1)]
  end function cross

  !> Determinant of a symmetric matrix.
  pure real(wp) function determinant(matrix) result(value)
    real(wp), intent(in) :: matrix(2, 2)
    value = matrix(1, 1)*matrix(2, 2) - matrix(1, 2)**2
  end function determinant

  !> Inverse of a symmetric matrix.
  pure function inverse(matrix) result(other)
    real(wp), intent(in) :: matrix(2, 2)
    real(wp) :: other(2, 2)

    other = reshape([matrix(2, 2), -matrix(1, 2), -matrix(1, 2), matrix(1, 1)], [2, 2]) &
      /determinant(matrix)
  end function inverse

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
    integer :: next(product(grid%cells) + 1), low(2), high(2), pass, element, i, j, cell

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
    real(wp), intent(in) :: corner(3, master_nodes), reach !! [m]
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
  pure integer function cell_of(grid, point) result(cell)
    type(cell_grid_type), intent(in) :: grid
    real(wp), intent(in) :: point(2) !! along the grid's directions [m]
    integer :: place(2)

    place = place_of(grid, point)
    cell = number_of(grid, place(1), place(2))
  end function cell_of

  !> Number of a cell.
  pure integer function number_of(grid, i, j) result(cell)
    type(cell_grid_type), intent(in) :: grid
    integer, intent(in) :: i, j !! its place
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
