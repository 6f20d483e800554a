!> The film's mesh: a rectangle of the unrolled pad, or all around; rows of film and foils.
module gfb_film_mesh
  use gfb_kinds, only: wp
  use gfb_units, only: turn
  use gfb_film_surface, only: film_surface_type, cylinder, ring
  implicit none (type, external)
  private
  public :: axial_rows, uniform_film_mesh, film_mesh_at, sector_film_mesh, cell_nodes, &
            gather_elements, row_weights, find_film_place, find_interval

  !> A film mesh by its stations along the shaft's motion and its rows across it.
  !>
  !> Node (station i, row j), both from 1, is number (i - 1)*rows + j. Between neighbouring stations
  !> and rows lies a cell. A bilinear element is a cell; a biquadratic one is two by two of them, so
  !> there are twice as many cells in each direction as elements then.
  type, public :: film_mesh_type
    type(film_surface_type) :: surface         !! that it lies on
    logical :: periodic = .false.              !! the last station's neighbour is the first
    logical :: half = .false.                  !! z >= 0 only, the other half is its mirror
    logical :: opposite = .false.              !! what is solved changes its sign there
    logical :: sealed = .false.                !! nothing flows through the first row
    integer :: repeats = 1                     !! equal pads of a ring for which this one stands
    integer :: order = 1                       !! of the film's elements: 1 bilinear, 2 biquadratic
    integer :: planned(2) = 0 !! elements along the motion and the whole width that it was made for
    real(wp), allocatable :: station_angle(:)  !! theta of the stations [rad]
    !> s of the rows: z, 0 at the midplane, of a cylinder [m]
    real(wp), allocatable :: row_axial(:)
    !> by which the stations of each row are turned, where they follow grooves; none: they are not
    !> [rad]
    real(wp), allocatable :: slant(:)
  contains
    procedure, non_overridable :: stations => film_stations
    procedure, non_overridable :: rows => film_rows
    procedure, non_overridable :: nodes => film_mesh_nodes
    procedure, non_overridable :: circumferential => film_circumferential
    procedure, non_overridable :: axial => film_axial
    procedure, non_overridable :: is_edge => film_is_edge
    procedure, non_overridable :: slant_at
  end type film_mesh_type

contains

  !> Rows along the axis, symmetric about z = 0 to the last digit, so that mirrored scenes give
  !> mirrored answers.
  !>
  !> z = W/2 tanh(a s)/tanh(a), s equally spaced from -1 to 1, cosh(a)^2 the refinement: elements
  !> become narrower towards both edges, and a doubled number of them divides each. Rows in the
  !> middle of elements lie there exactly.
  pure function axial_rows(width, elements, half, refinement, order) result(rows)
    real(wp), intent(in) :: width      !! whole width [m]
    integer, intent(in) :: elements    !! over the whole width
    logical, intent(in) :: half        !! z >= 0 only; elements is even then
    !> width of the elements in the middle over that at the edges; 1: equal ones [1]
    real(wp), intent(in) :: refinement
    integer, intent(in), optional :: order !! of the elements: 1 or 2; default: 1
    real(wp), allocatable :: rows(:) !! z, rising [m]
    integer :: i, along, step

    step = 1
    if (present(order)) step = order
    along = step*elements
    rows = [(0.5_wp*width*real(2*i - along, wp)/real(along, wp), i=merge(along/2, 0, half), along)]
    if (.not. refinement > 1.0_wp) return
    associate (rate => acosh(sqrt(refinement)))
      rows = 0.5_wp*width*(tanh(rate*(rows/(0.5_wp*width)))/tanh(rate))
    end associate
    do i = 2, size(rows) - 1, 2
      if (step == 2) rows(i) = 0.5_wp*(rows(i - 1) + rows(i + 1))
    end do
  end function axial_rows
  !> Mesh of elements of equal length over the pad.
  pure function uniform_film_mesh(radius, length, leading_edge_angle, pad_angle, circumferential, &
                                  axial, periodic, half, order, refinement) result(mesh)
    real(wp), intent(in) :: radius             !! of the bearing [m]
    real(wp), intent(in) :: length             !! whole width of the bearing [m]
    real(wp), intent(in) :: leading_edge_angle !! theta_0 [rad]
    real(wp), intent(in) :: pad_angle          !! from leading to trailing edge [rad]
    integer, intent(in) :: circumferential     !! elements along the motion
    integer, intent(in) :: axial               !! elements along the whole width
    logical, intent(in) :: periodic            !! a ring without edges
    logical, intent(in) :: half                !! mesh z >= 0 only; axial is even then
    integer, intent(in), optional :: order     !! of the elements; default: 1
    !> of the rows towards the edges, see axial_rows; default: 1 [1]
    real(wp), intent(in), optional :: refinement
    type(film_mesh_type) :: mesh
    real(wp) :: finer
    integer :: i, around

    mesh%surface = cylinder(radius)
    mesh%periodic = periodic
    mesh%half = half
    if (present(order)) mesh%order = order
    around = mesh%order*circumferential
    mesh%station_angle = [(leading_edge_angle + pad_angle*real(i, wp)/real(around, wp), &
                           i=0, merge(around - 1, around, periodic))]
    finer = 1.0_wp
    if (present(refinement)) finer = refinement
    mesh%row_axial = axial_rows(length, axial, half, finer, mesh%order)
  end function uniform_film_mesh

  !> Mesh of a pad with given sides of elements.
  pure function film_mesh_at(side_angle, radius, length, axial, half, order, &
                             refinement) result(mesh)
    real(wp), intent(in) :: side_angle(:) !! theta where elements meet, rising [rad]
    real(wp), intent(in) :: radius           !! of the bearing [m]
    real(wp), intent(in) :: length           !! whole width of the bearing [m]
    integer, intent(in) :: axial             !! elements along the whole width
    logical, intent(in) :: half              !! mesh z >= 0 only; axial is even then
    integer, intent(in), optional :: order   !! of the elements; default: 1
    !> of the rows towards the edges, see axial_rows; default: 1 [1]
    real(wp), intent(in), optional :: refinement
    type(film_mesh_type) :: mesh
    integer :: i

    mesh = uniform_film_mesh(radius, length, side_angle(1), 0.0_wp, size(side_angle) - 1, &
                             axial, .false., half, order, refinement)
    mesh%station_angle(1::mesh%order) = side_angle ! nodes where elements meet
    if (mesh%order == 1) return
    do i = 2, mesh%stations() - 1, 2 ! nodes in the middle of an element
      mesh%station_angle(i) = 0.5_wp*(mesh%station_angle(i - 1) + mesh%station_angle(i + 1))
    end do
  end function film_mesh_at

  !> Mesh of a sector: stations along the motion, rows from the inner to the outer radius; both
  !> graded towards the edges, with sides of elements where the gap has kinks and where strips meet.
  pure function sector_film_mesh(radii, leading_edge_angle, pad_angle, kink, cuts, &
                                 circumferential, radial, along, refinement, order, &
                                 periodic) result(mesh)
    real(wp), intent(in) :: radii(2)           !! inner and outer one [m]
    real(wp), intent(in) :: leading_edge_angle !! theta_0 [rad]
    real(wp), intent(in) :: pad_angle          !! from leading to trailing edge [rad]
    real(wp), intent(in) :: kink(:)            !! of the gap, from the leading edge, rising [rad]
    real(wp), intent(in) :: cuts(:)            !! radii where strips meet, rising [m]
    integer, intent(in) :: circumferential     !! elements along the motion
    integer, intent(in) :: radial              !! elements along the radius
    real(wp), intent(in) :: along, refinement  !! of stations and rows, see axial_rows [1]
    integer, intent(in) :: order               !! of the elements: 1 or 2
    logical, intent(in), optional :: periodic  !! a ring without edges; default: it has some
    type(film_mesh_type) :: mesh
    real(wp), allocatable :: angle(:), radius(:)

    mesh%surface = ring(radii(2))
    mesh%order = order
    radius = 0.5_wp*sum(radii) &
      + axial_rows(radii(2) - radii(1), radial, .false., refinement, order)
    radius([1, size(radius)]) = radii
    call put_sides_on(cuts, order, radius)
    angle = 0.5_wp*pad_angle + axial_rows(pad_angle, circumferential, .false., along, order)
    angle([1, size(angle)]) = [0.0_wp, pad_angle]
    call put_sides_on(kink, order, angle)
    mesh%row_axial = radius
    mesh%station_angle = leading_edge_angle + angle
    if (present(periodic)) mesh%periodic = periodic
    if (mesh%periodic) mesh%station_angle = mesh%station_angle(:size(angle) - 1)
  end function sector_film_mesh

  !> Puts the nearest side of an element on each place; what lies between is stretched. Places at an
  !> end, or without a side of their own, count no more.
  pure subroutine put_sides_on(wanted, order, place)
    real(wp), intent(in) :: wanted(:)   !! rising, in the unit of the others [SI]
    integer, intent(in) :: order        !! of the elements
    real(wp), intent(inout) :: place(:) !! of the nodes, rising [SI]
    real(wp) :: before
    integer :: i, fixed, side, last

    fixed = 1
    last = size(place)
    do i = 1, size(wanted)
      if (wanted(i) <= place(fixed) .or. wanted(i) >= place(last) .or. last - fixed < 2*order) cycle
      side = fixed + order*minloc(abs(place(fixed + order:last - order:order) - wanted(i)), 1)
      before = place(side)
      place(fixed:side) = place(fixed) + (place(fixed:side) - place(fixed))* &
                          ((wanted(i) - place(fixed))/(before - place(fixed)))
      place(side + 1:) = place(last) - (place(last) - place(side + 1:))* &
                         ((place(last) - wanted(i))/(place(last) - before))
      place(side) = wanted(i)
      fixed = side
    end do
  end subroutine put_sides_on

  !> Nodes of a cell, counter-clockwise in (x, z).
  pure function cell_nodes(column, row, stations, rows) result(nodes)
    integer, intent(in) :: column, row    !! of the cell, from 1
    integer, intent(in) :: stations, rows !! of the whole mesh; the last station's next is the first
    integer :: nodes(4), here, next

    here = (column - 1)*rows + row
    next = modulo(column, stations)*rows + row
    nodes = [here, next, next + 1, here + 1]
  end function cell_nodes

  !> Nodes of the elements that a part of the mesh's cells make up: counter-clockwise where they are
  !> bilinear, else station by station.
  pure function gather_elements(mesh, mesh_node, cells) result(element_nodes)
    type(film_mesh_type), intent(in) :: mesh !! the film's mesh
    integer, intent(in) :: mesh_node(:)     !! number in the whole mesh of each node of the part
    integer, intent(in) :: cells(:, :) !! (4, cells) nodes of the part
    integer, allocatable :: element_nodes(:, :) !! (4 or 9, elements) nodes of the part
    integer :: local_node(minval(mesh_node):maxval(mesh_node)), nodes(9)
    integer :: cell, station, row, i, j, found

    if (mesh%order == 1) then
      element_nodes = cells
      return
    end if
    local_node = 0
    local_node(mesh_node) = [(i, i=1, size(mesh_node))]
    allocate (element_nodes(size(nodes), size(cells, 2)/mesh%order**2))
    found = 0
    do cell = 1, size(cells, 2)
      associate (first => mesh_node(cells(1, cell)))
        station = (first - 1)/mesh%rows()
        row = modulo(first - 1, mesh%rows())
      end associate
      if (modulo(station, mesh%order) /= 0 .or. modulo(row, mesh%order) /= 0) cycle
      if (found == size(element_nodes, 2)) exit
      found = found + 1
      nodes = [((modulo(station + i, mesh%stations())*mesh%rows() + row + j + 1, j=0, mesh%order), &
                i=0, mesh%order)]
      if (any(nodes < lbound(local_node, 1) .or. nodes > ubound(local_node, 1))) exit
      element_nodes(:, found) = local_node(nodes)
      if (any(local_node(nodes) == 0)) exit
    end do
    if (cell <= size(cells, 2) .or. found < size(element_nodes, 2)) then
      error stop 'cells of a film element lie on several ranks'
    end if
  end function gather_elements

  !> Lengths of the axis that make up a field's integral along it: by the trapezoidal rule, or
  !> Simpson's.
  pure function row_weights(mesh) result(weight)
    type(film_mesh_type), intent(in) :: mesh !! the film's mesh
    real(wp) :: weight(size(mesh%row_axial)) !! of the rows [m]
    integer :: j

    weight = 0.0_wp
    do j = 1, mesh%axial(), mesh%order
      associate (length => mesh%row_axial(j + mesh%order) - mesh%row_axial(j))
        if (mesh%order == 1) then
          weight(j:j + 1) = weight(j:j + 1) + 0.5_wp*length
        else
          weight(j:j + 2) = weight(j:j + 2) + [1.0_wp, 4.0_wp, 1.0_wp]*length/6.0_wp
        end if
      end associate
    end do
  end function row_weights

  !> By which the stations are turned at a place across the motion, between rows in proportion
  !> [rad].
  pure real(wp) function slant_at(self, axial) result(slant)
    class(film_mesh_type), intent(in) :: self !! the film's mesh
    real(wp), intent(in) :: axial !! s on the meshed width [m]
    integer :: row
    real(wp) :: share

    slant = 0.0_wp
    if (.not. allocated(self%slant)) return
    call find_interval(self%row_axial, axial, row, share)
    slant = self%slant(row) + share*(self%slant(row + 1) - self%slant(row))
  end function slant_at

  !> The nodes around a point, and their bilinear shares of it.
  pure subroutine find_film_place(mesh, angle, axial, node, share)
    type(film_mesh_type), intent(in) :: mesh !! the film's mesh
    real(wp), intent(in) :: angle     !! theta on the pad [rad]
    real(wp), intent(in) :: axial     !! z on the meshed width [m]
    integer, intent(out) :: node(4)   !! of the whole mesh
    real(wp), intent(out) :: share(4) !! of the four nodes, adding up to one [1]
    real(wp) :: station, along, across
    integer :: i, j, here, next

    station = angle
    if (allocated(mesh%slant)) then ! those are rings
      station = mesh%station_angle(1) + modulo(angle - mesh%slant_at(axial) &
          - mesh%station_angle(1), turn)
    end if
    if (mesh%periodic) then
      call find_interval([mesh%station_angle, mesh%station_angle(1) + turn], station, i, along)
    else
      call find_interval(mesh%station_angle, station, i, along)
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
    real(wp), intent(in) :: bounds(:)    !! rising, two at least, in any unit [SI]
    real(wp), intent(in) :: number       !! in their unit [SI]
    integer, intent(out) :: interval     !! between its bound and the next
    real(wp), intent(out) :: share       !! 0 or 1 where the number lies outside all [1]
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
  pure integer function film_stations(self) result(stations)
    class(film_mesh_type), intent(in) :: self !! the film's mesh
    stations = size(self%station_angle)
  end function film_stations

  !> Rows along the axis.
  pure integer function film_rows(self) result(rows)
    class(film_mesh_type), intent(in) :: self !! the film's mesh
    rows = size(self%row_axial)
  end function film_rows

  !> Nodes of the mesh.
  pure integer function film_mesh_nodes(self) result(nodes)
    class(film_mesh_type), intent(in) :: self !! the film's mesh
    nodes = self%stations()*self%rows()
  end function film_mesh_nodes

  !> Cells along the shaft's motion.
  pure integer function film_circumferential(self) result(elements)
    class(film_mesh_type), intent(in) :: self !! the film's mesh
    elements = merge(self%stations(), self%stations() - 1, self%periodic)
  end function film_circumferential

  !> Cells along the axis of the part that is meshed.
  pure integer function film_axial(self) result(elements)
    class(film_mesh_type), intent(in) :: self !! the film's mesh
    elements = self%rows() - 1
  end function film_axial

  !> Whether the pressure of a node is ambient, [Gu2020] eq. 13.
  pure logical function film_is_edge(self, station, row) result(edge)
    class(film_mesh_type), intent(in) :: self !! the film's mesh
    integer, intent(in) :: station, row !! from 1

    edge = row == self%rows() .or. (row == 1 .and. .not. (self%half .or. self%sealed))
    if (.not. self%periodic) edge = edge .or. station == 1 .or. station == self%stations()
  end function film_is_edge
end module gfb_film_mesh
