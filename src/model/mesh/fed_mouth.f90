!> The mouth of an orifice on a film's mesh: how its rim and its centre are shared among nodes, and
!> what the mesh lacks of the flow around it.
!>
!> Gas enters on the circle of the mouth. Around it \( p^2 \) is nearly a logarithm of the distance,
!> which elements as large as the mouth do not follow, and a source at a node would have no limit
!> at all. What the mean on the rim lacks for a unit source is found once a mesh, on a patch of
!> it: the discrete solution there, with the exact one on the patch's border, against the exact one
!> on the rim,
!>
!> $$ \beta = -\frac{\ln a}{2 \pi} - \sum_a w_a u_a, \quad
!>    \sum_b u_b \int \nabla N_a \cdot \nabla N_b \, d\Omega = w_a, \quad
!>    u = -\frac{\ln r}{2 \pi} \text{ on the border} $$
module gfb_fed_mouth
  use gfb_kinds, only: wp
  use gfb_units, only: pi, turn
  use gfb_errors, only: error_type
  use gfb_film_geometry, only: film_geometry_type, film_geometry, widen, film_shapes
  use gfb_film_mesh, only: film_mesh_type, find_interval
  use gfb_film_surface, only: film_surface_type
  use gfb_linear_solve, only: solve_positive
  implicit none (type, external)
  private
  public :: find_mouth, find_rim

  integer, parameter :: rim_points = 64 !! of the circle
  integer, parameter :: reach = 6       !! elements of a patch on each side of the mouth, at least
  integer, parameter :: most_reach = 10 !! the same at most, of bilinear elements
  real(wp), parameter :: wide = 3.0_wp  !! of a patch over the mouth's radius on each side [1]
  real(wp), parameter :: near = 1.0e-6_wp !! of an element: on a line of the mesh [1]

  !> A mouth on the whole mesh of a film.
  type, public :: mouth_type
    integer, allocatable :: node(:)          !! of the mesh, on elements that the rim crosses
    real(wp), allocatable :: weight(:)       !! of the rim's mean, adding up to one [1]
    integer, allocatable :: centre_node(:)   !! the same of the centre
    real(wp), allocatable :: centre_weight(:) !! [1]
    real(wp) :: lack = 0.0_wp !! beta [1]
    real(wp) :: part = 1.0_wp !! of its flow that enters the mesh: 1/2 on the middle of half a width
  end type mouth_type

contains

  !> A mouth of a radius around a place; on half the width with z of any sign.
  pure subroutine find_mouth(mesh, angle, along, radius, mouth)
    type(film_mesh_type), intent(in) :: mesh !! the film's mesh
    real(wp), intent(in) :: angle  !! theta of the centre [rad]
    real(wp), intent(in) :: along  !! s of the centre [m]
    real(wp), intent(in) :: radius !! of the mouth [m]
    type(mouth_type), intent(out) :: mouth !! found
    real(wp) :: place(2)
    real(wp), allocatable :: weight(:)
    integer, allocatable :: node(:)
    integer :: i

    allocate (mouth%node(0), mouth%weight(0))
    do i = 1, rim_points
      place = point_of_rim(mesh%surface, angle, along, radius, i)
      call find_shares(mesh, place(1), place(2), node, weight)
      call gather(node, weight/real(rim_points, wp), mouth%node, mouth%weight)
    end do
    allocate (mouth%centre_node(0), mouth%centre_weight(0))
    call find_shares(mesh, angle, along, node, weight)
    call gather(node, weight, mouth%centre_node, mouth%centre_weight)
    if (mesh%half .and. abs(along) < near*mesh%row_axial(2)) mouth%part = 0.5_wp
    call find_lack(mesh, angle, along, radius, mouth)
  end subroutine find_mouth

  !> The points of a rim: nodes of the elements around them, their first corners first, and their
  !> shape functions; all points count alike.
  pure subroutine find_rim(mesh, angle, along, radius, nodes, shapes)
    type(film_mesh_type), intent(in) :: mesh !! the film's mesh
    real(wp), intent(in) :: angle  !! theta of the centre [rad]
    real(wp), intent(in) :: along  !! s of the centre [m]
    real(wp), intent(in) :: radius !! of the mouth [m]
    integer, allocatable, intent(out) :: nodes(:, :)   !! (4 or 9, points) of the whole mesh
    real(wp), allocatable, intent(out) :: shapes(:, :) !! (4 or 9, points) [1]
    real(wp), allocatable :: weight(:)
    integer, allocatable :: node(:)
    real(wp) :: place(2)
    integer :: i

    allocate (nodes((mesh%order + 1)**2, rim_points), shapes((mesh%order + 1)**2, rim_points))
    do i = 1, rim_points
      place = point_of_rim(mesh%surface, angle, along, radius, i)
      call find_shares(mesh, place(1), place(2), node, weight)
      nodes(:, i) = node
      shapes(:, i) = weight
    end do
  end subroutine find_rim

  !> One of the points on a rim: theta, s.
  pure function point_of_rim(surface, angle, along, radius, i) result(place)
    type(film_surface_type), intent(in) :: surface
    real(wp), intent(in) :: angle, along, radius
    integer, intent(in) :: i !! from 1
    real(wp) :: place(2)
    place = on_rim(surface, angle, along, radius, &
                   turn*(real(i, wp) - 0.5_wp)/real(rim_points, wp))
  end function point_of_rim

  !> A point on the rim: theta, s. The surface is developed into a plane, where a circle is one.
  pure function on_rim(surface, angle, along, radius, turned) result(place)
    type(film_surface_type), intent(in) :: surface
    real(wp), intent(in) :: angle, along, radius
    real(wp), intent(in) :: turned !! around the centre [rad]
    real(wp) :: place(2), out, aside

    out = radius*cos(turned)
    aside = radius*sin(turned)
    if (abs(surface%sine) > 0.0_wp) then
      associate (ray => surface%radius_at(along)/surface%sine)
        place = [angle + atan2(aside, ray + out)/surface%sine, &
                 along + hypot(ray + out, aside) - ray]
      end associate
    else
      place = [angle + aside/surface%radius_at(along), along + out]
    end if
  end function on_rim

  !> Distance of two points on the developed surface [m].
  pure real(wp) function distance(surface, angle, along, other_angle, other_along)
    type(film_surface_type), intent(in) :: surface
    real(wp), intent(in) :: angle, along, other_angle, other_along
    real(wp) :: half, chord

    half = 0.5_wp*(other_angle - angle)
    chord = half
    if (abs(surface%sine) > 0.0_wp) chord = sin(half*surface%sine)/surface%sine
    distance = hypot(other_along - along, &
                     2.0_wp*chord*sqrt(surface%radius_at(along)*surface%radius_at(other_along)))
  end function distance

  !> Nodes of the element around a point, and their shape functions there.
  pure subroutine find_shares(mesh, angle, along, node, weight)
    type(film_mesh_type), intent(in) :: mesh
    real(wp), intent(in) :: angle, along
    integer, allocatable, intent(out) :: node(:) !! (4 or 9) of the whole mesh
    real(wp), allocatable, intent(out) :: weight(:)
    real(wp) :: share(2)
    real(wp), allocatable :: shape_along(:), shape_across(:)
    integer :: column, row, i, j

    call find_element(mesh, angle, along, column, row, share)
    shape_along = line_shapes(mesh%order, share(1))
    shape_across = line_shapes(mesh%order, share(2))
    allocate (node(0), weight(0))
    do i = 0, mesh%order
      do j = 0, mesh%order
        node = [node, node_at(mesh, column + i, row + j)]
        weight = [weight, shape_along(i + 1)*shape_across(j + 1)]
      end do
    end do
  end subroutine find_shares

  !> The element around a point by its first station and row, and where in it the point lies, 0
  !> to 1.
  pure subroutine find_element(mesh, angle, along, column, row, share)
    type(film_mesh_type), intent(in) :: mesh
    real(wp), intent(in) :: angle, along
    integer, intent(out) :: column, row
    real(wp), intent(out) :: share(2)
    real(wp), allocatable :: side(:)
    real(wp) :: here

    side = mesh%station_angle(1::mesh%order)
    here = angle
    if (mesh%periodic) then
      side = [side, side(1) + turn]
      here = side(1) + modulo(angle - side(1), turn)
    end if
    call find_interval(side, here, column, share(1))
    here = along
    if (mesh%half) here = abs(along)
    call find_interval(mesh%row_axial(1::mesh%order), here, row, share(2))
    column = mesh%order*(column - 1) + 1
    row = mesh%order*(row - 1) + 1
  end subroutine find_element

  !> Number of a node by station and row; stations may lie beyond the last one of a ring.
  pure integer function node_at(mesh, station, row) result(node)
    type(film_mesh_type), intent(in) :: mesh
    integer, intent(in) :: station, row
    node = modulo(station - 1, mesh%stations())*mesh%rows() + row
  end function node_at

  !> Shape functions of a line of two or three nodes.
  pure function line_shapes(order, share) result(shapes)
    integer, intent(in) :: order !! 1 or 2
    real(wp), intent(in) :: share !! from the first node, 0 to 1 [1]
    real(wp), allocatable :: shapes(:)

    associate (t => share, rest => 1.0_wp - share)
      if (order == 1) then
        shapes = [rest, t]
      else
        shapes = [rest*(rest - t), 4.0_wp*rest*t, t*(t - rest)]
      end if
    end associate
  end function line_shapes

  !> Adds weights to those of nodes that are known, or makes them known.
  pure subroutine gather(node, weight, known, total)
    integer, intent(in) :: node(:)
    real(wp), intent(in) :: weight(:)
    integer, allocatable, intent(inout) :: known(:)
    real(wp), allocatable, intent(inout) :: total(:)
    integer :: i, place

    do i = 1, size(node)
      if (.not. abs(weight(i)) > 0.0_wp) cycle
      place = findloc(known, node(i), 1)
      if (place == 0) then
        known = [known, node(i)]
        total = [total, weight(i)]
      else
        total(place) = total(place) + weight(i)
      end if
    end do
  end subroutine gather

  !> What the mean of a unit source on the rim lacks.
  pure subroutine find_lack(mesh, angle, along, radius, mouth)
    type(film_mesh_type), intent(in) :: mesh
    real(wp), intent(in) :: angle, along, radius
    type(mouth_type), intent(inout) :: mouth
    integer :: station(2), row(2), i, j, k, n
    logical :: solved
    real(wp), allocatable :: matrix(:, :), right(:, :), exact(:)
    integer, allocatable :: node(:), place(:)
    logical, allocatable :: border(:)
    real(wp) :: part

    call find_patch(mesh, angle, along, radius, station, row)
    n = (station(2) - station(1) + 1)*(row(2) - row(1) + 1)
    allocate (node(n), exact(n), border(n), place(n))
    k = 0
    do i = station(1), station(2)
      do j = row(1), row(2)
        k = k + 1
        node(k) = node_at(mesh, i, j)
        border(k) = i == station(1) .or. i == station(2) .or. j == row(2) .or. &
          (j == row(1) .and. .not. (mouth%part < 1.0_wp))
        exact(k) = 0.0_wp
        if (border(k)) then
          part = distance(mesh%surface, angle, along, angle_at(mesh, i), mesh%row_axial(j))
          exact(k) = -log(part/radius)/turn
        end if
      end do
    end do
    call assemble(mesh, station, row, matrix)
    allocate (right(n, 1))
    right(:, 1) = -matmul(matrix, exact)
    do k = 1, size(mouth%node)
      i = findloc(node, mouth%node(k), 1)
      if (i > 0) right(i, 1) = right(i, 1) + mouth%part*mouth%weight(k)
    end do
    place = pack([(k, k=1, n)],.not. border)
    matrix = matrix(place, place)
    right = right(place, :)
    call solve_positive(matrix, right, solved)
    mouth%lack = 0.0_wp
    if (.not. solved) return
    do k = 1, size(mouth%node)
      i = findloc(node(place), mouth%node(k), 1)
      if (i > 0) mouth%lack = mouth%lack - mouth%weight(k)*right(i, 1)
    end do
  end subroutine find_lack

  !> Stations and rows of a patch around a mouth; of half a width it ends at the middle.
  pure subroutine find_patch(mesh, angle, along, radius, station, row)
    type(film_mesh_type), intent(in) :: mesh
    real(wp), intent(in) :: angle, along, radius
    integer, intent(out) :: station(2), row(2) !! first and last; of a ring from any number on
    real(wp) :: share(2), reached
    integer :: column, line, i, first

    call find_element(mesh, angle, along, column, line, share)
    first = mesh%order*((mesh%stations() - 1)/mesh%order) + 1
    station = column + merge(mesh%order, 0, share(1) > 0.5_wp) ! from the nearest side on
    row = line + merge(mesh%order, 0, share(2) > 0.5_wp)
    do i = 1, max(reach, most_reach/mesh%order)
      associate (radius_here => mesh%surface%radius_at(along))
        reached = min(abs(angle - nearest_turn(angle_at(mesh, station(1)), angle)), &
                      abs(nearest_turn(angle_at(mesh, station(2)), angle) - angle))*radius_here
      end associate
      if (i > reach .and. reached > wide*radius) exit
      station = station + mesh%order*[-1, 1]
      if (mesh%periodic) then
        if (station(2) - station(1) > mesh%stations() - mesh%order) then
          station = station - mesh%order*[-1, 1]
          exit
        end if
      else
        station = [max(station(1), 1), min(station(2), first)]
      end if
    end do
    do i = 1, max(reach, most_reach/mesh%order)
      if (mesh%half) then ! below the middle is the mirror image
        reached = mesh%row_axial(row(2)) - abs(along)
        if (row(1) > 1) reached = min(reached, abs(along) - mesh%row_axial(row(1)))
      else
        reached = min(along - mesh%row_axial(row(1)), mesh%row_axial(row(2)) - along)
      end if
      if (i > reach .and. reached > wide*radius) exit
      row = [max(row(1) - mesh%order, 1), min(row(2) + mesh%order, mesh%rows())]
    end do
  end subroutine find_patch

  !> Angle of a station, which may lie beyond the last one of a ring or before its first.
  pure real(wp) function angle_at(mesh, station) result(angle)
    type(film_mesh_type), intent(in) :: mesh
    integer, intent(in) :: station
    integer :: inside

    inside = modulo(station - 1, mesh%stations()) + 1
    angle = mesh%station_angle(inside) + turn*real((station - inside)/mesh%stations(), wp)
  end function angle_at

  !> An angle with as many turns as make it nearest to another.
  pure real(wp) function nearest_turn(angle, other) result(nearest)
    real(wp), intent(in) :: angle, other !! [rad]
    nearest = other + modulo(angle - other + 0.5_wp*turn, turn) - 0.5_wp*turn
  end function nearest_turn

  !> Integrals of the products of the shape functions' gradients on a patch.
  pure subroutine assemble(mesh, station, row, matrix)
    type(film_mesh_type), intent(in) :: mesh
    integer, intent(in) :: station(2), row(2)
    real(wp), allocatable, intent(out) :: matrix(:, :)
    real(wp) :: position(2, (mesh%order + 1)**2), rows_of(size(position, 2))
    integer :: place(size(position, 2)), i, j, k, a, b, tall
    type(film_geometry_type) :: geometry
    type(error_type), allocatable :: error

    tall = row(2) - row(1) + 1
    associate (n => (station(2) - station(1) + 1)*tall)
      allocate (matrix(n, n), source=0.0_wp)
    end associate
    do i = station(1), station(2) - 1, mesh%order
      do j = row(1), row(2) - 1, mesh%order
        call nodes_of(mesh, station, row, [i, j], place, position)
        call film_geometry(position, geometry, error)
        if (allocated(error)) return
        rows_of = position(2, :)
        call widen(mesh%surface%stretch(matmul(rows_of, film_shapes(size(rows_of)))), geometry)
        do k = 1, size(geometry%area)
          do b = 1, size(place)
            do a = 1, size(place)
              matrix(place(a), place(b)) = matrix(place(a), place(b)) + geometry%area(k)* &
                dot_product(geometry%gradient(:, a, k), geometry%gradient(:, b, k))
            end do
          end do
        end do
      end do
    end do

  end subroutine assemble

  !> Nodes of an element of a patch, in the order of its shape functions.
  pure subroutine nodes_of(mesh, station, row, first, place, position)
    type(film_mesh_type), intent(in) :: mesh
    integer, intent(in) :: station(2), row(2) !! of the patch
    integer, intent(in) :: first(2) !! station and row where the element begins
    integer, intent(out) :: place(:) !! in the patch
    real(wp), intent(out) :: position(:, :) !! (2, nodes) [m]
    integer :: s, r, n

    n = 0
    do s = first(1), first(1) + mesh%order
      do r = first(2), first(2) + mesh%order
        n = n + 1
        place(n) = (s - station(1))*(row(2) - row(1) + 1) + r - row(1) + 1
        position(:, n) = [mesh%surface%radius*angle_at(mesh, s), mesh%row_axial(r)]
      end do
    end do
    if (mesh%order > 1) return
    place = place([1, 3, 4, 2]) ! counter-clockwise
    position = position(:, [1, 3, 4, 2])
  end subroutine nodes_of
end module gfb_fed_mouth
