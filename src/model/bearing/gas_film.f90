!> One rank's part of the gas film: gather, kernel, scatter over its elements.
module gfb_gas_film
  use gfb_kinds, only: wp
  use gfb_units, only: pi
  use gfb_errors, only: error_type
  use gfb_film_geometry, only: film_geometry_type, film_geometry, widen, film_shapes, &
                               most_film_nodes
  use gfb_gap_part, only: gap_part_type, put_part, level_of, shift_of
  use gfb_gap_shape, only: gap_shape_type, kinks_between
  use gfb_film_surface, only: film_surface_type, shaft_coordinates, translations, entraining_speed
  use gfb_film_load, only: film_forces, film_force_weights
  use gfb_gas_law, only: gas_law_type, gas_factors_type
  use gfb_general_film, only: general_residual, general_jacobian
  use gfb_groove_film, only: groove_type, groove_residual, groove_jacobian, mean_depth
  use gfb_squeeze_term, only: stored_gas, storage_residual, storage_jacobian
  use gfb_film_flow, only: film_flow_type
  use gfb_feed_law, only: porous_wall_type, supply_at
  use gfb_wall_film, only: wall_residual, wall_jacobian
  use gfb_reynolds_element, only: reynolds_residual, reynolds_jacobian
  use gfb_heated_film, only: heated_gas_type, heated_state_type, heated_residual, heated_jacobian, &
                             gas_factors, heated_rows, heated_fields, row_mass, field_pressure, &
                             field_gap, field_gas, field_foil, field_shaft
  use gfb_film_mesh, only: film_mesh_type, gather_elements
  use gfb_operating_point, only: operating_point_type
  implicit none (type, external)
  private
  public :: create_gas_film, put_strips, freeze_film

  integer, parameter :: corners = 4 !! of a cell

  !> Fields that stay: temperatures of gas, top foil and shaft, and what they take off the gap.
  integer, parameter, public :: frozen_growth = 4, frozen_fields = frozen_growth

  !> Temperatures that stay as they are: heat is slow against what the shaft does.
  type, public :: frozen_heat_type
    type(heated_gas_type) :: gas
    real(wp), allocatable :: field(:, :) !! (nodes, fields), see `frozen_growth` [K], [m]
    real(wp) :: centrifugal = 0.0_wp   !! the same by the speed squared [m s2]
    type(gas_factors_type), allocatable :: factors(:, :) !! (points, elements)
  end type frozen_heat_type

  !> Film elements and nodes of this rank.
  type, public :: gas_film_type
    type(film_flow_type) :: flow          !! of a shaft at rest, see `flow_at`
    type(gas_law_type) :: law             !! of the gas
    type(porous_wall_type) :: wall        !! that feeds it
    type(film_surface_type) :: surface    !! that it lies on
    real(wp) :: clearance = 0.0_wp        !! C; of a ring the size of its gap [m]
    real(wp) :: ambient_pressure = 0.0_wp !! p_a [Pa]
    !> Two where half the width is meshed; of a pad that stands for all how many they are.
    real(wp) :: copies = 1.0_wp
    real(wp) :: cell(2) = 0.0_wp          !! size of the first cell along motion and axis [m]
    real(wp) :: width = 0.0_wp            !! that is meshed [m]
    integer, allocatable :: element_nodes(:, :)   !! (4 or 9, elements), local nodes
    integer, allocatable :: cell_nodes(:, :)      !! (4, cells), local nodes
    real(wp), allocatable :: shape(:, :)          !! (nodes, points) shape functions [1]
    real(wp), allocatable :: angle(:)             !! theta of the nodes [rad]
    real(wp), allocatable :: axial(:)             !! s of the nodes, z on a cylinder [m]
    real(wp), allocatable :: direction(:, :)      !! (2, nodes) cosine and sine of theta [1]
    logical, allocatable :: fixed(:)              !! nodes at ambient pressure
    type(film_geometry_type), allocatable :: geometry(:) !! of the elements
    real(wp), allocatable :: force_weight(:, :)   !! (5, nodes) this rank's share [m2], [m3]
    real(wp), allocatable :: part_torque_weight(:, :) !! (2, nodes) where those are 0 [m3]
    real(wp), allocatable :: motion(:, :)         !! (5, nodes) b, see `gfb_film_surface` [1], [m]
    real(wp), allocatable :: point_motion(:, :, :)  !! (5, points, elements) the same there [1], [m]
    real(wp), allocatable :: motion_excess(:, :, :) !! (5, points, elements) of them over the nodes'
    type(gap_part_type), allocatable :: part(:)   !! of the rigid gap
    real(wp) :: storage = 0.0_wp                  !! a_0 of a step of time, else unused [1/s]
    real(wp), allocatable :: past(:, :) !! (points, elements) rate of r h by earlier ones [Pa m/s]
    type(frozen_heat_type), allocatable :: frozen !! none: the gas has the temperature of its law
  contains
    procedure, non_overridable :: put, put_shape, interference
    procedure, non_overridable :: flow_at, wall_at, cell_flow, shadow, factors_of, element_gap
    procedure, non_overridable :: softness_of, has_grooves, groove_of, content_excess
    procedure, non_overridable :: gap => film_node_gap
    procedure, non_overridable :: excess => film_excess
    procedure, non_overridable :: is_open
    procedure, non_overridable :: add_residual => film_residual
    procedure, non_overridable :: add_flows => film_flows
    procedure, non_overridable :: element_jacobian => film_element_jacobian
    procedure, non_overridable :: add_shaft_column => film_shaft_column
    procedure, non_overridable :: force => film_node_force
    procedure, non_overridable :: stored => film_stored
  end type gas_film_type

contains

  !> The film over a part of its mesh.
  !>
  !> Fails when an element is folded over.
  subroutine create_gas_film(whole, mesh_node, cell_nodes, clearance, ambient_pressure, &
                             viscosity, upwind, film, error)
    type(film_mesh_type), intent(in) :: whole !! the film's mesh
    integer, intent(in) :: mesh_node(:)        !! number in the whole mesh of each local node
    integer, intent(in) :: cell_nodes(:, :)    !! (4, cells), local nodes
    real(wp), intent(in) :: clearance          !! C [m]
    real(wp), intent(in) :: ambient_pressure   !! p_a [Pa]
    real(wp), intent(in) :: viscosity          !! of the gas [Pa s]
    logical, intent(in) :: upwind              !! SUPG instead of Galerkin
    type(gas_film_type), intent(out) :: film !! this rank's share of it
    type(error_type), allocatable, intent(out) :: error !! why it failed
    integer :: i, station, row

    film%surface = whole%surface
    film%clearance = clearance
    film%ambient_pressure = ambient_pressure
    film%flow%viscosity = viscosity
    film%flow%upwind = upwind
    film%copies = merge(2.0_wp, 1.0_wp, whole%half)*real(whole%repeats, wp)
    film%cell(1) = whole%surface%radius*abs(whole%station_angle(2) - whole%station_angle(1))
    film%cell(2) = whole%row_axial(2) - whole%row_axial(1)
    film%width = whole%row_axial(whole%rows()) - whole%row_axial(1)
    film%cell_nodes = cell_nodes
    film%element_nodes = gather_elements(whole, mesh_node, cell_nodes)
    film%shape = film_shapes(size(film%element_nodes, 1))
    allocate (film%part(0))
    allocate (film%angle(size(mesh_node)), film%axial(size(mesh_node)))
    allocate (film%direction(2, size(mesh_node)))
    allocate (film%fixed(size(mesh_node)), film%motion(shaft_coordinates, size(mesh_node)))
    do i = 1, size(mesh_node)
      station = (mesh_node(i) - 1)/whole%rows() + 1
      row = mesh_node(i) - (station - 1)*whole%rows()
      film%angle(i) = whole%station_angle(station)
      if (allocated(whole%slant)) film%angle(i) = film%angle(i) + whole%slant(row)
      film%axial(i) = whole%row_axial(row)
      film%fixed(i) = whole%is_edge(station, row)
      film%direction(:, i) = [cos(film%angle(i)), sin(film%angle(i))]
      film%motion(:, i) = film%surface%motion(film%angle(i), film%axial(i))
    end do
    call measure_elements(film, error)
  end subroutine create_gas_film

  !> Geometry of the elements and the weights of their nodes' pressures in the forces.
  subroutine measure_elements(film, error)
    type(gas_film_type), intent(inout) :: film
    type(error_type), allocatable, intent(out) :: error

    real(wp) :: position(2, size(film%shape, 1)), weight(film_forces, size(film%shape, 1))
    real(wp) :: angle(size(film%shape, 1))
    integer :: element

    allocate (film%geometry(size(film%element_nodes, 2)))
    allocate (film%force_weight(film_forces, size(film%angle)), source=0.0_wp)
    allocate (film%point_motion(shaft_coordinates, size(film%shape, 2), &
                                size(film%element_nodes, 2)))
    allocate (film%motion_excess, mold=film%point_motion)
    do element = 1, size(film%element_nodes, 2)
      associate (nodes => film%element_nodes(:, element), &
                 motion => film%point_motion(:, :, element))
        angle = unwound_angles(film, element)
        position(1, :) = film%surface%radius*angle
        position(2, :) = film%axial(nodes)
        call film_geometry(position, film%geometry(element), error)
        if (allocated(error)) return
        call widen(film%surface%stretch(matmul(film%axial(nodes), film%shape)), &
                   film%geometry(element))
        motion = film%surface%point_motions(film%shape, angle, film%axial(nodes))
        film%motion_excess(:, :, element) = film%surface%motion_excess(film%shape, angle, &
                                                                       film%axial(nodes))
        call film_force_weights(film%geometry(element), motion, weight)
        film%force_weight(:, nodes) = film%force_weight(:, nodes) + film%copies*weight
      end associate
    end do
    film%part_torque_weight = film%force_weight(translations + 1:, :)
    ! The mirrored half, or the other pads, cancel it.
    if (film%copies > 1.0_wp) film%force_weight(translations + 1:, :) = 0.0_wp
  end subroutine measure_elements

  !> Puts a part of the rigid gap in the place of the one of its name, or behind all others.
  pure subroutine put(self, part)
    class(gas_film_type), intent(inout) :: self !! this rank's film
    type(gap_part_type), intent(in) :: part !! with a name
    call put_part(part, self%part)
  end subroutine put

  !> Takes a shape off the rigid gap; once more where the film has moved around.
  pure subroutine put_shape(self, name, shape)
    class(gas_film_type), intent(inout) :: self !! this rank's film
    character(len=*), intent(in) :: name !! of the part
    class(gap_shape_type), intent(in) :: shape !! what it takes off
    type(gap_part_type) :: part
    real(wp), allocatable :: kink(:), inside(:)
    integer :: element, i

    part%name = name
    part%height = [(shape%height(self%angle(i), self%axial(i)), i=1, size(self%angle))]
    part%excess = spread(0.0_wp*self%shape(1, :), 2, size(self%element_nodes, 2))
    kink = shape%rising_kinks()
    do element = 1, size(self%element_nodes, 2)
      associate (nodal => part%height(self%element_nodes(:, element)))
        inside = kinks_between(kink, ends_of(self, element))
        if (shape%on_sides .and. size(inside) == 0) cycle
        part%excess(:, element) = height_at_points(self, shape, inside, element) &
          - [(dot_product(self%shape(:, i), nodal), i=1, size(self%shape, 2))]
      end associate
    end do
    call self%put(part)
  end subroutine put_shape

  !> Where an element begins and ends along the motion [rad].
  pure function ends_of(film, element) result(ends)
    type(gas_film_type), intent(in) :: film
    integer, intent(in) :: element
    real(wp) :: ends(2), angle(size(film%shape, 1))

    angle = unwound_angles(film, element)
    ends = [minval(angle), maxval(angle)]
  end function ends_of

  !> Heights of a shape at the Gauss points of an element; of kinks inside it what they are in the
  !> mean.
  pure function height_at_points(film, shape, inside, element) result(height)
    type(gas_film_type), intent(in) :: film
    class(gap_shape_type), intent(in) :: shape
    real(wp), intent(in) :: inside(:) !! its kinks in the element, rising [rad]
    integer, intent(in) :: element
    real(wp), dimension(size(film%shape, 2)) :: height, angle, along !! [m], [rad], [m]
    integer :: i

    angle = matmul(unwound_angles(film, element), film%shape)
    along = matmul(film%axial(film%element_nodes(:, element)), film%shape)
    if (size(inside) > 0) then
      height = shape%in_element(ends_of(film, element), inside, &
                                nint(sqrt(real(size(angle), wp))) - 1, angle, along)
    else
      height = [(shape%height(angle(i), along(i)), i=1, size(height))]
    end if
  end function height_at_points

  !> Angles of an element's nodes; the element that closes a ring reaches beyond the last station.
  pure function unwound_angles(film, element) result(angle)
    type(gas_film_type), intent(in) :: film
    integer, intent(in) :: element
    real(wp) :: angle(size(film%shape, 1)) !! [rad]

    angle = film%angle(film%element_nodes(:, element))
    where (maxval(angle) - angle > pi) angle = angle + 2.0_wp*pi
  end function unwound_angles

  !> What parts take off the gap all around [m].
  pure real(wp) function interference(self)
    class(gas_film_type), intent(in) :: self !! this rank's film
    interference = -level_of(self%part, 0.0_wp)
  end function interference

  !> Gives springs side by side their own stiffness, that of elements: at a cut the deflection
  !> jumps.
  pure subroutine put_strips(cuts, stiffness, rate, film)
    real(wp), intent(in) :: cuts(:)      !! radii between strips, rising [m]
    real(wp), intent(in) :: stiffness(:) !! of the strips, from the inside [N/m3]
    real(wp), intent(in) :: rate(:)      !! of the nodes, deflection over pressure [m/Pa]
    type(gas_film_type), intent(inout) :: film !! this rank's film
    type(gap_part_type) :: part
    integer :: element

    part%name = 'strips'
    part%softness = spread(0.0_wp*film%shape(:, 1), 2, size(film%element_nodes, 2))
    do element = 1, size(film%element_nodes, 2)
      associate (nodes => film%element_nodes(:, element))
        associate (middle => sum(film%axial(nodes))/real(size(nodes), wp))
          part%softness(:, element) = 1.0_wp/stiffness(1 + count(cuts < middle)) - rate(nodes)
        end associate
      end associate
    end do
    call film%put(part)
  end subroutine put_strips

  !> Compliance of an element's springs over that of its nodes [m/Pa].
  pure function softness_of(self, element) result(softness)
    class(gas_film_type), intent(in) :: self !! this rank's film
    integer, intent(in) :: element !! of this rank
    real(wp) :: softness(size(self%shape, 1))
    integer :: i

    softness = 0.0_wp
    do i = 1, size(self%part)
      if (.not. allocated(self%part(i)%softness)) cycle
      softness = softness + self%part(i)%softness(:, element)
    end do
  end function softness_of

  !> Whether one of its parts has grooves.
  pure logical function has_grooves(self) result(has)
    class(gas_film_type), intent(in) :: self !! this rank's film
    integer :: i

    has = .false.
    do i = 1, size(self%part)
      has = has .or. allocated(self%part(i)%groove)
    end do
  end function has_grooves

  !> Grooves of an element; without a share where there are none.
  pure type(groove_type) function groove_of(self, element) result(groove)
    class(gas_film_type), intent(in) :: self !! this rank's film
    integer, intent(in) :: element !! of this rank
    integer :: i

    groove = groove_type()
    do i = 1, size(self%part)
      if (allocated(self%part(i)%groove)) groove = self%part(i)%groove(element)
    end do
  end function groove_of

  !> The excess with the mean depth of grooves: that of the room for the gas [m].
  pure function content_excess(self, element, point) result(excess)
    class(gas_film_type), intent(in) :: self !! this rank's film
    integer, intent(in) :: element !! of this rank
    type(operating_point_type), intent(in) :: point !! operating point
    real(wp) :: excess(most_film_nodes) !! the first ones are its points'
    excess = self%excess(element, point) + mean_depth(self%groove_of(element))
  end function content_excess

  !> Gap at an element's nodes, as it is inside it [m].
  pure function element_gap(self, element, pressure, gap) result(inside)
    class(gas_film_type), intent(in) :: self !! this rank's film
    integer, intent(in) :: element !! of this rank
    real(wp), intent(in) :: pressure(:) !! at the nodes of this rank [Pa]
    real(wp), intent(in) :: gap(:)      !! at the nodes of this rank [m]
    real(wp) :: inside(size(self%shape, 1))
    integer :: i

    associate (nodes => self%element_nodes(:, element))
      inside = gap(nodes)
      do i = 1, size(self%part)
        if (.not. allocated(self%part(i)%softness)) cycle
        inside = inside &
          + self%part(i)%softness(:, element)*(pressure(nodes) - self%ambient_pressure)
      end do
    end associate
  end function element_gap

  !> Gives the film temperatures that stay.
  pure subroutine freeze_film(film, frozen)
    type(gas_film_type), intent(inout) :: film !! this rank's film
    type(frozen_heat_type), intent(in) :: frozen !! its factors of the gas do not count
    type(heated_state_type) :: state
    type(gas_factors_type), allocatable :: factors(:, :)
    integer :: element, n

    n = size(film%shape, 1)
    allocate (factors(n, size(film%element_nodes, 2)))
    do element = 1, size(film%element_nodes, 2)
      associate (nodes => film%element_nodes(:, element))
        state%field(:n, field_gas:field_shaft) = frozen%field(nodes, :frozen_growth - 1)
      end associate
      factors(:, element) = gas_factors(frozen%gas, state, n)
    end do
    film%frozen = frozen_heat_type(frozen%gas, frozen%field, frozen%centrifugal, factors)
    call film%put(gap_part_type(name='growth', height=frozen%field(:, frozen_growth), &
                                by_speed=frozen%centrifugal))
    film%law = frozen%gas%law
    film%law%plain = .false.
  end subroutine freeze_film

  !> What temperatures that stay make of the gas at the points of an element.
  pure function factors_of(self, element) result(factors)
    class(gas_film_type), intent(in) :: self !! this rank's film
    integer, intent(in) :: element !! of this rank
    type(gas_factors_type) :: factors(size(self%shape, 2))

    factors = gas_factors_type()
    if (allocated(self%frozen)) factors = self%frozen%factors(:, element)
  end function factors_of

  !> Fields of an element whose temperatures stay, where their slopes count.
  pure type(heated_state_type) function frozen_state(film, element, pressure, gap, excess) &
    result(state)
    type(gas_film_type), intent(in) :: film
    integer, intent(in) :: element
    real(wp), intent(in) :: pressure(:), gap(:) !! at its nodes [Pa], [m]
    real(wp), intent(in) :: excess(:)           !! of the gap at its points [m]
    integer :: n

    n = size(pressure)
    associate (nodes => film%element_nodes(:, element))
      state%field(:n, field_pressure) = pressure
      state%field(:n, field_gap) = gap
      state%field(:n, field_gas:field_shaft) = film%frozen%field(nodes, :frozen_growth - 1)
      state%excess(:n) = excess
    end associate
  end function frozen_state

  !> An element's mass equations at temperatures that stay [Pa m3/s].
  pure function frozen_residual(film, flow, element, pressure, gap, excess) result(residual)
    type(gas_film_type), intent(in) :: film
    type(film_flow_type), intent(in) :: flow
    integer, intent(in) :: element
    real(wp), intent(in) :: pressure(:), gap(:) !! at its nodes [Pa], [m]
    real(wp), intent(in) :: excess(:)           !! of the gap at its points [m]
    real(wp) :: residual(size(pressure)), all_rows(size(pressure), heated_rows)

    call heated_residual(film%geometry(element), flow, film%frozen%gas, &
                         frozen_state(film, element, pressure, gap, excess), all_rows)
    residual = all_rows(:, row_mass)
  end function frozen_residual

  !> Their derivatives.
  pure subroutine frozen_jacobian(film, flow, element, pressure, gap, excess, by_pressure, by_gap, &
                                  by_excess)
    type(gas_film_type), intent(in) :: film
    type(film_flow_type), intent(in) :: flow
    integer, intent(in) :: element
    real(wp), intent(in) :: pressure(:), gap(:) !! at its nodes [Pa], [m]
    real(wp), intent(in) :: excess(:)           !! of the gap at its points [m]
    real(wp), intent(out) :: by_pressure(:, :), by_gap(:, :), by_excess(:, :) !! (nodes, nodes)
    real(wp) :: by_field(size(gap), heated_rows, size(gap), heated_fields)
    real(wp) :: every_excess(size(gap), heated_rows, size(gap))

    call heated_jacobian(film%geometry(element), flow, film%frozen%gas, &
                         frozen_state(film, element, pressure, gap, excess), by_field, every_excess)
    by_pressure = by_field(:, row_mass, :, field_pressure)
    by_gap = by_field(:, row_mass, :, field_gap)
    by_excess = every_excess(:, row_mass, :)
  end subroutine frozen_jacobian

  !> The gas as the shaft drags it at an operating point.
  pure function flow_at(self, point) result(flow)
    class(gas_film_type), intent(in) :: self !! this rank's film
    type(operating_point_type), intent(in) :: point !! whose speed counts
    type(film_flow_type) :: flow

    flow = self%flow
    flow%entraining_speed = entraining_speed(point%speed, self%surface%radius)
  end function flow_at

  !> The porous wall with as much of its supply as counts at an operating point.
  pure type(porous_wall_type) function wall_at(self, point) result(wall)
    class(gas_film_type), intent(in) :: self !! this rank's film
    type(operating_point_type), intent(in) :: point !! with the part of the supply

    wall = self%wall
    wall%supply_pressure = supply_at(wall%supply_pressure, self%ambient_pressure, point%supply)
  end function wall_at

  !> Flow through a cell, that of the pressure and that of the motion: the size of an equation.
  pure function cell_flow(self, point) result(size_of_flow)
    class(gas_film_type), intent(in) :: self !! this rank's film
    type(operating_point_type), intent(in) :: point !! whose speed counts
    real(wp) :: size_of_flow                        !! p h times a volume a time [Pa m3/s]
    type(film_flow_type) :: flow

    flow = self%flow_at(point)
    associate (along => self%cell(1), across => self%cell(2))
      size_of_flow = self%ambient_pressure**2*self%clearance**3/(12.0_wp*flow%viscosity)* &
        (along/across + across/along) &
        + abs(flow%entraining_speed)*self%ambient_pressure*self%clearance*across
    end associate
  end function cell_flow

  !> Ambient pressure on the surface over a radian, a journal's shadow: the size of a force [N].
  pure real(wp) function shadow(self) result(force)
    class(gas_film_type), intent(in) :: self !! this rank's film
    force = self%ambient_pressure*self%surface%radius*self%copies*self%width
  end function shadow

  !> Gap at the nodes: tilted shaft and deflected foil [m].
  pure function film_node_gap(self, point, deflection) result(gap)
    class(gas_film_type), intent(in) :: self !! this rank's film
    type(operating_point_type), intent(in) :: point !! operating point
    real(wp), intent(in) :: deflection(:) !! of the foil, away from the shaft [m]
    real(wp) :: gap(size(deflection)), eccentricity(2), clearance
    integer :: i

    eccentricity = shift_of(self%part, point%place(:2))
    clearance = self%surface%rest_gap(self%clearance)
    gap = deflection + self%surface%gap(self%direction(1, :), self%direction(2, :), self%axial, &
                                        level_of(self%part, clearance), &
                                        eccentricity(1), eccentricity(2), point%place(3), &
                                        point%place(4), point%place(5))
    do i = 1, size(self%part)
      associate (part => self%part(i))
        if (allocated(part%height)) gap = gap - part%height
        if (abs(part%by_speed) > 0.0_wp) gap = gap - part%by_speed*point%speed**2
      end associate
    end do
  end function film_node_gap

  !> What the rigid gap at an element's Gauss points has beyond what its nodal values give [m].
  pure function film_excess(self, element, point) result(excess)
    class(gas_film_type), intent(in) :: self !! this rank's film
    integer, intent(in) :: element !! of this rank
    type(operating_point_type), intent(in) :: point !! operating point
    real(wp) :: excess(most_film_nodes) !! the first ones are its points'
    real(wp) :: eccentricity(2)
    integer :: i

    excess = 0.0_wp
    eccentricity = shift_of(self%part, point%place(:2))
    do i = 1, size(self%shape, 2)
      associate (motion => self%motion_excess(:, i, element))
        excess(i) = dot_product(eccentricity, motion(1:2)) &
          + point%place(5)*motion(5) + point%place(4)*motion(4) + point%place(3)*motion(3)
      end associate
    end do
    do i = 1, size(self%part)
      if (.not. allocated(self%part(i)%excess)) cycle
      excess(:size(self%shape, 2)) = excess(:size(self%shape, 2)) - self%part(i)%excess(:, element)
    end do
  end function film_excess

  !> Whether gap and pressure are positive at this rank's nodes and Gauss points; not so for NaN.
  pure logical function is_open(self, pressure, gap, point) result(open)
    class(gas_film_type), intent(in) :: self !! this rank's film
    real(wp), intent(in) :: pressure(:) !! at the nodes [Pa]
    real(wp), intent(in) :: gap(:)      !! at the nodes [m]
    type(operating_point_type), intent(in) :: point !! operating point
    real(wp), dimension(most_film_nodes) :: here, excess
    integer :: element, i, n

    n = size(self%shape, 1)
    open = all(pressure > 0.0_wp) .and. all(gap > 0.0_wp)
    do element = 1, size(self%element_nodes, 2)
      if (.not. open) exit
      excess = self%excess(element, point)
      here(:n) = self%element_gap(element, pressure, gap)
      do i = 1, n
        open = open .and. dot_product(here(:n), self%shape(:, i)) + excess(i) > 0.0_wp
      end do
      if (n == corners) cycle ! bilinear pressure lies between its nodal values
      here(:n) = pressure(self%element_nodes(:, element))
      do i = 1, n
        open = open .and. dot_product(here(:n), self%shape(:, i)) > 0.0_wp
      end do
    end do
  end function is_open

  !> Adds the film's equations of this rank's elements; none at nodes of given pressure.
  pure subroutine film_residual(self, pressure, gap, point, residual)
    class(gas_film_type), intent(in) :: self !! this rank's film
    real(wp), intent(in) :: pressure(:)    !! at the nodes [Pa]
    real(wp), intent(in) :: gap(:)         !! at the nodes [m]
    type(operating_point_type), intent(in) :: point !! operating point
    real(wp), intent(inout) :: residual(:) !! at the nodes [Pa m3/s]

    call self%add_flows(pressure, gap, point, residual)
    where (self%fixed) residual(:size(self%fixed)) = 0.0_wp
  end subroutine film_residual

  !> Adds what this rank's elements take from the nodes: at those of given pressure, what flows in.
  pure subroutine film_flows(self, pressure, gap, point, flows)
    class(gas_film_type), intent(in) :: self !! this rank's film
    real(wp), intent(in) :: pressure(:) !! at the nodes [Pa]
    real(wp), intent(in) :: gap(:)      !! at the nodes [m]
    type(operating_point_type), intent(in) :: point !! operating point
    real(wp), intent(inout) :: flows(:) !! at the nodes [Pa m3/s]
    real(wp), parameter :: no_source(most_film_nodes) = 0.0_wp
    real(wp), dimension(most_film_nodes) :: p, h, excess, share
    type(film_flow_type) :: flow
    type(groove_type) :: groove
    integer :: element, n

    n = size(self%shape, 1)
    flow = self%flow_at(point)
    do element = 1, size(self%element_nodes, 2)
      associate (nodes => self%element_nodes(:, element), geometry => self%geometry(element))
        p(:n) = pressure(nodes)
        h(:n) = self%element_gap(element, pressure, gap)
        excess = self%excess(element, point)
        groove = self%groove_of(element)
        if (allocated(self%frozen) .and. flow%upwind) then
          share(:n) = frozen_residual(self, flow, element, p(:n), h(:n), excess(:n))
        else if (groove%share > 0.0_wp) then
          call groove_residual(geometry, flow, self%law, groove, p(:n), h(:n), excess(:n), &
                               share(:n))
        else if (self%law%plain) then
          call reynolds_residual(geometry, flow, p(:n), h(:n), excess(:n), no_source(:n), share(:n))
        else
          call general_residual(geometry, flow, self%law, p(:n), h(:n), excess(:n), share(:n), &
                                self%factors_of(element))
        end if
        if (self%wall%present) then
          share(:n) = share(:n) + wall_residual(geometry, flow, self%law, self%wall_at(point), &
                                                p(:n), h(:n), excess(:n), &
                                                self%factors_of(element))
        end if
        if (allocated(self%past)) then
          excess = self%content_excess(element, point)
          share(:n) = share(:n) + storage_residual(geometry, flow, self%law, p(:n), h(:n), &
                                                   excess(:n), self%storage, &
                                                   self%past(:, element), self%factors_of(element))
        end if
        flows(nodes) = flows(nodes) + share(:n)
      end associate
    end do
  end subroutine film_flows

  !> Derivatives of one element's equations by nodal pressures and deflections, and by some of the
  !> shaft's coordinates.
  pure subroutine film_element_jacobian(self, element, pressure, gap, point, coordinate, &
                                        by_pressure, by_gap, by_shaft)
    class(gas_film_type), intent(in) :: self !! this rank's film
    integer, intent(in) :: element !! of this rank
    real(wp), intent(in) :: pressure(:) !! at the nodes of this rank [Pa]
    real(wp), intent(in) :: gap(:)      !! at the nodes of this rank [m]
    type(operating_point_type), intent(in) :: point !! operating point
    integer, intent(in) :: coordinate(:) !! of the shaft, which are asked for
    real(wp), contiguous, intent(out) :: by_pressure(:, :) !! (nodes, nodes) [m3/s]
    real(wp), contiguous, intent(out) :: by_gap(:, :)      !! (nodes, nodes) [Pa m2/s]
    real(wp), intent(out) :: by_shaft(:, :) !! (nodes, coordinates) [Pa m2/s], [Pa m3/s]
    real(wp), parameter :: no_source(most_film_nodes) = 0.0_wp
    real(wp), dimension(most_film_nodes) :: p, h, excess
    real(wp) :: by_excess(size(self%shape, 1), size(self%shape, 2))
    type(groove_type) :: groove
    integer :: n, i, k

    n = size(self%shape, 1)
    associate (nodes => self%element_nodes(:, element))
      p(:n) = pressure(nodes)
      h(:n) = self%element_gap(element, pressure, gap)
      excess = self%excess(element, point)
      groove = self%groove_of(element)
      if (allocated(self%frozen) .and. self%flow%upwind) then
        call frozen_jacobian(self, self%flow_at(point), element, p(:n), h(:n), excess(:n), &
                             by_pressure, by_gap, by_excess)
      else if (groove%share > 0.0_wp) then
        call groove_jacobian(self%geometry(element), self%flow_at(point), self%law, groove, p(:n), &
                             h(:n), excess(:n), by_pressure, by_gap, by_excess)
      else if (self%law%plain) then
        call reynolds_jacobian(self%geometry(element), self%flow_at(point), p(:n), h(:n), &
                               excess(:n), no_source(:n), by_pressure, by_gap, by_excess)
      else
        call general_jacobian(self%geometry(element), self%flow_at(point), self%law, p(:n), &
                              h(:n), excess(:n), by_pressure, by_gap, by_excess, &
                              self%factors_of(element))
      end if
      if (self%wall%present) then
        call wall_jacobian(self%geometry(element), self%flow_at(point), self%law, &
                           self%wall_at(point), p(:n), h(:n), excess(:n), by_pressure, by_gap, &
                           by_excess, self%factors_of(element))
      end if
      if (allocated(self%past)) then
        excess = self%content_excess(element, point)
        call storage_jacobian(self%geometry(element), self%flow_at(point), self%law, p(:n), h(:n), &
                              excess(:n), self%storage, self%past(:, element), by_pressure, &
                              by_gap, by_excess, self%factors_of(element))
      end if
      by_shaft = 0.0_wp
      do i = 1, n
        do k = 1, size(coordinate)
          by_shaft(:, k) = by_shaft(:, k) + by_gap(:, i)*self%motion(coordinate(k), nodes(i)) &
            + by_excess(:, i)*self%motion_excess(coordinate(k), i, element)
        end do
      end do
    end associate
  end subroutine film_element_jacobian

  !> Adds the derivatives of the film's equations by one of the shaft's coordinates.
  pure subroutine film_shaft_column(self, pressure, gap, point, coordinate, column)
    class(gas_film_type), intent(in) :: self !! this rank's film
    real(wp), intent(in) :: pressure(:)  !! at the nodes [Pa]
    real(wp), intent(in) :: gap(:)       !! at the nodes [m]
    type(operating_point_type), intent(in) :: point !! operating point
    integer, intent(in) :: coordinate    !! see `shaft_coordinates`
    real(wp), intent(inout) :: column(:) !! at the nodes [Pa m2/s], [Pa m3/s]
    real(wp), dimension(size(self%shape, 1), size(self%shape, 1)) :: by_pressure, by_gap
    real(wp) :: by_shaft(size(self%shape, 1), 1)
    integer :: element

    do element = 1, size(self%element_nodes, 2)
      call self%element_jacobian(element, pressure, gap, point, [coordinate], by_pressure, by_gap, &
                                 by_shaft)
      associate (nodes => self%element_nodes(:, element))
        column(nodes) = column(nodes) + by_shaft(:, 1)
      end associate
    end do
    where (self%fixed) column(:size(self%fixed)) = 0.0_wp
  end subroutine film_shaft_column

  !> The gas over the Gauss points of this rank's elements, r h.
  pure function film_stored(self, pressure, gap, point) result(stored)
    class(gas_film_type), intent(in) :: self !! this rank's film
    real(wp), intent(in) :: pressure(:) !! at the nodes [Pa]
    real(wp), intent(in) :: gap(:)      !! at the nodes [m]
    type(operating_point_type), intent(in) :: point !! operating point
    !> (points, elements) [Pa m]
    real(wp) :: stored(size(self%shape, 2), size(self%element_nodes, 2))
    real(wp) :: excess(most_film_nodes)
    integer :: element

    do element = 1, size(self%element_nodes, 2)
      associate (nodes => self%element_nodes(:, element))
        excess = self%content_excess(element, point)
        stored(:, element) = stored_gas(self%law, pressure(nodes), &
                                        self%element_gap(element, pressure, gap), &
                                        excess(:size(self%shape, 2)), self%factors_of(element))
      end associate
    end do
  end function film_stored

  !> This rank's share of force and torque of the whole bearing [N], [N m].
  pure function film_node_force(self, pressure) result(force)
    class(gas_film_type), intent(in) :: self !! this rank's film
    real(wp), intent(in) :: pressure(:) !! at the nodes [Pa]
    real(wp) :: force(film_forces)
    force = matmul(self%force_weight, pressure - self%ambient_pressure)
  end function film_node_force
end module gfb_gas_film
