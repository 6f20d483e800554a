!> The film's mesh: a rectangle of the unrolled pad, or a ring.
module gfb_film_mesh
  use gfb_kinds, only: wp
  implicit none (type, external)
  private
  public :: uniform_film_mesh, film_mesh_at, cell_nodes, find_film_place

  !> A film mesh by its stations along the shaft's motion and its rows along the axis.
  !>
  !> Node (station i, row j), both from 1, is number (i - 1)*rows + j.
  type, public :: film_mesh_type
    real(wp) :: radius = 0.0_wp                !! of the bearing [m]
    logical :: periodic = .false.              !! the last station's neighbour is the first
    logical :: half = .false.                  !! z >= 0 only, the other half is its mirror
    real(wp), allocatable :: station_angle(:)  !! theta of the stations [rad]
    real(wp), allocatable :: row_axial(:)      !! z of the rows, 0 at the midplane [m]
  contains
    procedure :: stations => film_stations
    procedure :: rows => film_rows
    procedure :: nodes => film_mesh_nodes
    procedure :: circumferential => film_circumferential
    procedure :: axial => film_axial
    procedure :: is_edge => film_is_edge
  end type film_mesh_type

contains

  !> Mesh of equal elements over the pad.
  pure function uniform_film_mesh(radius, length, leading_edge_angle, pad_angle, circumferential, &
                                  axial, periodic, half) result(mesh)
    real(wp), intent(in) :: radius             !! of the bearing [m]
    real(wp), intent(in) :: length             !! whole width of the bearing [m]
    real(wp), intent(in) :: leading_edge_angle !! theta_0 [rad]
    real(wp), intent(in) :: pad_angle          !! from leading to trailing edge [rad]
    integer, intent(in) :: circumferential     !! elements along the motion
    integer, intent(in) :: axial               !! elements along the whole width
    logical, intent(in) :: periodic            !! a ring without edges
    logical, intent(in) :: half                !! mesh z >= 0 only; axial is even then
    type(film_mesh_type) :: mesh
    integer :: i, stations, first

    mesh%radius = radius
    mesh%periodic = periodic
    mesh%half = half
    stations = merge(circumferential, circumferential + 1, periodic)
    mesh%station_angle = [(leading_edge_angle + pad_angle*real(i, wp)/real(circumferential, wp), &
                           i=0, stations - 1)]
    first = merge(axial/2, 0, half)
    ! Symmetric to the last digit about z = 0, so that mirrored scenes give mirrored answers.
    mesh%row_axial = [(0.5_wp*length*real(2*i - axial, wp)/real(axial, wp), i=first, axial)]
  end function uniform_film_mesh

  !> Mesh of a pad with given stations.
  pure function film_mesh_at(station_angle, radius, length, axial, half) result(mesh)
    real(wp), intent(in) :: station_angle(:) !! theta, rising [rad]
    real(wp), intent(in) :: radius           !! of the bearing [m]
    real(wp), intent(in) :: length           !! whole width of the bearing [m]
    integer, intent(in) :: axial             !! elements along the whole width
    logical, intent(in) :: half              !! mesh z >= 0 only; axial is even then
    type(film_mesh_type) :: mesh

    mesh = uniform_film_mesh(radius, length, station_angle(1), 0.0_wp, size(station_angle) - 1, &
                             axial, .false., half)
    mesh%station_angle = station_angle
  end function film_mesh_at

  !> Nodes of a cell, counter-clockwise in (x, z).
  pure function cell_nodes(column, row, stations, rows) result(nodes)
    integer, intent(in) :: column, row    !! of the cell, from 1
    integer, intent(in) :: stations, rows !! of the whole mesh; the last station's next is the first
    integer :: nodes(4)
    integer :: here, next

    here = (column - 1)*rows + row
    next = modulo(column, stations)*rows + row
    nodes = [here, next, next + 1, here + 1]
  end function cell_nodes

  !> The nodes around a place, and their bilinear shares of it.
  pure subroutine find_film_place(mesh, angle, axial, node, share)
    type(film_mesh_type), intent(in) :: mesh
    real(wp), intent(in) :: angle     !! theta on the pad [rad]
    real(wp), intent(in) :: axial     !! z on the meshed width [m]
    integer, intent(out) :: node(4)   !! of the whole mesh
    real(wp), intent(out) :: share(4) !! adding up to one
    real(wp), parameter :: turn = 2.0_wp*acos(-1.0_wp)
    real(wp) :: along, across
    integer :: i, j, here, next

    if (mesh%periodic) then
      call find_interval([mesh%station_angle, mesh%station_angle(1) + turn], angle, i, along)
    else
      call find_interval(mesh%station_angle, angle, i, along)
    end if
    call find_interval(mesh%row_axial, axial, j, across)
    here = (i - 1)*mesh%rows() + j
    next = modulo(i, mesh%stations())*mesh%rows() + j
    node = [here, here + 1, next, next + 1]
    share = [(1.0_wp - along)*(1.0_wp - across), (1.0_wp - along)*across, along*(1.0_wp - across), &
      along*across]
  end subroutine find_film_place

  !> Interval of rising numbers that holds one, and where in it the number lies, 0 to 1.
  pure subroutine find_interval(bounds, number, interval, share)
    real(wp), intent(in) :: bounds(:)
    real(wp), intent(in) :: number
    integer, intent(out) :: interval
    real(wp), intent(out) :: share
    integer :: last, middle

    interval = 1
    last = size(bounds)
    do while (last - interval > 1)
      middle = (interval + last)/2
      if (number >= bounds(middle)) then
        interval = middle
      else
        last = middle
      end if
    end do
    share = (number - bounds(interval))/(bounds(interval + 1) - bounds(interval))
    share = min(1.0_wp, max(0.0_wp, share))
  end subroutine find_interval

  !> Stations along the shaft's motion.
  pure function film_stations(self) result(stations)
    class(film_mesh_type), intent(in) :: self
    integer :: stations
    stations = size(self%station_angle)
  end function film_stations

  !> Rows along the axis.
  pure function film_rows(self) result(rows)
    class(film_mesh_type), intent(in) :: self
    integer :: rows
    rows = size(self%row_axial)
  end function film_rows

  !> Nodes of the mesh.
  pure function film_mesh_nodes(self) result(nodes)
    class(film_mesh_type), intent(in) :: self
    integer :: nodes
    nodes = self%stations()*self%rows()
  end function film_mesh_nodes

  !> Elements along the shaft's motion.
  pure function film_circumferential(self) result(elements)
    class(film_mesh_type), intent(in) :: self
    integer :: elements
    elements = merge(self%stations(), self%stations() - 1, self%periodic)
  end function film_circumferential

  !> Elements along the axis of the part that is meshed.
  pure function film_axial(self) result(elements)
    class(film_mesh_type), intent(in) :: self
    integer :: elements
    elements = self%rows() - 1
  end function film_axial

  !> Whether the pressure of a node is ambient, [Gu2020] eq. 13.
  pure function film_is_edge(self, station, row) result(edge)
    class(film_mesh_type), intent(in) :: self
    integer, intent(in) :: station, row !! from 1
    logical :: edge

    edge = row == self%rows() .or. (row == 1 .and. .not. self%half)
    if (.not. self%periodic) edge = edge .or. station == 1 .or. station == self%stations()
  end function film_is_edge
end module gfb_film_mesh
