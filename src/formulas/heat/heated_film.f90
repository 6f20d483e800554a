!> Element of a film whose gas carries heat: mass, energy, and the heat that flows into its walls.
!>
!> The unknown T is the temperature at which the gas carries its heat; the mean over the gap, which
!> sets the viscosity, is \( T_m = T - (T_s - T_f)/6 \).
!>
!> $$ \mathbf{m} = \frac{p}{R_g T} \Bigl( h U \mathbf{e}_x - \frac{h^3}{12 \mu} \nabla p \Bigr),
!>    \ \nabla \cdot \mathbf{m} = 0, \ c_p \mathbf{m} \cdot \nabla T = V \tau_s - q_s - q_f $$
!>
!> $$ q_s = \frac{k}{h} \Bigl( 8 T - \frac{19}{3} T_s - \frac{5}{3} T_f \Bigr) + m_1, \quad
!>    q_f = \frac{k}{h} \Bigl( 4 T - \frac{5}{3} T_s - \frac{7}{3} T_f \Bigr) - m_1, \quad
!>    m_1 = \frac{V}{6} \Bigl( h \frac{\partial p}{\partial x} - \frac{\mu V}{h} \Bigr) $$
!>
!> the zeroth and first moment of the energy equation across the gap. Viscosity and density follow
!> the temperature, the law of the gas holds at a reference temperature. Heat that conducts
!> straight from shaft to foil is exact so; 6 k/h at each wall would conduct three times too much.
!> An ideal gas needs no term of dissipation: \( c_p T \mathbf{m} = (c_p/R_g) p \mathbf{Q} \).
!>
!> A porous wall that feeds the film adds \( \dot m'' \) to the mass and
!> \( c_p \max(\dot m'', 0) (T_w - T) \) to the energy: gas enters with the wall's temperature, what
!> leaves has the film's.
module gfb_heated_film
  use gfb_kinds, only: wp
  use gfb_film_flow, only: film_flow_type, flow_here
  use gfb_upwind_weight, only: upwind_weight, upwind_weight_derivative
  use gfb_film_geometry, only: film_geometry_type, film_shapes, film_shape, biquadratic_shape, &
                               film_nodes, biquadratic_nodes, most_film_nodes
  use gfb_feed_law, only: porous_wall_type, wall_source
  use gfb_gas_law, only: gas_law_type, gas_factors_type, gas_state, gas_state_type
  use gfb_heated_gas, only: heated_gas_type, relative_viscosity, mean_over_gap
  implicit none (type, external)
  private
  public :: heated_residual, heated_jacobian, heated_shear, heated_shear_rates, gas_factors
  public :: heated_gas_type, relative_viscosity, mean_over_gap

  !> Variables of a point of a film, see `values_at`.
  integer, parameter :: variables = 14
  !> What flows there, see `point_numbers`: fluxes along x and z, into the gas, foil and shaft; what
  !> is fed in; what leans the weights of the energy.
  integer, parameter :: flux_along = 1, flux_across = 2, into_gas = 3, into_foil = 4, &
                        into_shaft = 5, fed_in = 6, lean_along = 7, lean_across = 8, flows = 8

  !> A number and its derivatives by the variables.
  type :: dual_type
    real(wp) :: v = 0.0_wp            !! its value
    real(wp) :: d(variables) = 0.0_wp !! derivatives
  end type dual_type

  interface operator(+)
    module procedure plus, real_plus
  end interface
  interface operator(-)
    module procedure minus
  end interface
  interface operator(*)
    module procedure times, times_real, real_times
  end interface
  interface operator(/)
    module procedure over, over_real, real_over
  end interface
  interface sqrt
    module procedure square_root
  end interface

  !> The gas at a point, of plain numbers or of numbers with derivatives.
  interface gas_here
    module procedure numbers_here, duals_here
  end interface

  !> What a wall feeds in, and what of it enters.
  interface fed_by
    module procedure fed_number, fed_dual
  end interface
  interface entering
    module procedure entering_number, entering_dual
  end interface

  !> Weight of what the motion carries.
  interface weight_of
    module procedure weight_of_number, weight_of_dual
  end interface

  !> Fields at the nodes of an element, in the order of the derivatives' blocks.
  integer, parameter, public :: field_pressure = 1, field_gap = 2, field_gas = 3, field_foil = 4, &
                                field_shaft = 5, heated_fields = 5
  !> Equations at its nodes: mass [Pa m3/s], energy of the gas, heat into foil and shaft [W].
  integer, parameter, public :: row_mass = 1, row_energy = 2, row_foil = 3, row_shaft = 4, &
                                heated_rows = 4

  !> What a wall beyond the film is: held at a temperature; one that follows from the heat that goes
  !> to a far place; or conducting along the axis.
  integer, parameter, public :: wall_given = 1, wall_conductance = 2, wall_fin = 3

  !> The fields at an element's nodes.
  type, public :: heated_state_type
    real(wp) :: field(most_film_nodes, heated_fields) = 0.0_wp !! [Pa], [m], [K], [K], [K]
    real(wp) :: excess(most_film_nodes) = 0.0_wp !! of the gap at the points over the nodes' [m]
    real(wp) :: part = 1.0_wp !! of a difference of temperature that the gas feels [1]
    type(porous_wall_type) :: wall !! that feeds the element
    logical :: leans = .false. !! weights of the energy lean against the flow, see `point_numbers`
  end type heated_state_type

contains

  !> Residuals of one element.
  !>
  !> The mass equation is that of `gfb_general_film`, and what it weights (SUPG) is carried by the
  !> energy equation too, which so closes to round-off.
  pure subroutine heated_residual(geometry, flow, gas, state, residual)
    type(film_geometry_type), intent(in) :: geometry !! the element at its points
    type(film_flow_type), intent(in) :: flow !! speed and weighting of the film
    type(heated_gas_type), intent(in) :: gas !! that carries the heat
    type(heated_state_type), intent(in) :: state !! at the nodes
    real(wp), intent(out) :: residual(:, :) !! (nodes, rows)

    if (size(residual, 1) == film_nodes) then
      call sum_residual(film_nodes, film_shape, geometry%gradient, geometry%area, &
                        geometry%stream_length, geometry%stretch, flow, gas, state, residual)
    else
      call sum_residual(biquadratic_nodes, biquadratic_shape, geometry%gradient, geometry%area, &
                        geometry%stream_length, geometry%stretch, flow, gas, state, residual)
    end if
  end subroutine heated_residual

  !> The residuals' sums over the Gauss points, of which there are as many as nodes.
  pure subroutine sum_residual(nodes, shapes, gradients, areas, stream_length, stretch, flow, gas, &
                               state, residual)
    integer, value :: nodes !! a value: the compiler makes a copy of the loops for each
    real(wp), intent(in) :: shapes(nodes, nodes)       !! shape functions (node, point) [1]
    real(wp), intent(in) :: gradients(2, nodes, nodes) !! their gradients (2, node, point) [1/m]
    real(wp), intent(in) :: areas(nodes)               !! of the points [m2]
    real(wp), intent(in) :: stream_length(nodes)       !! distance of the nodes along x [m]
    real(wp), intent(in) :: stretch(nodes)             !! see `gfb_film_surface` [1]
    type(film_flow_type), intent(in) :: flow
    type(heated_gas_type), intent(in) :: gas
    type(heated_state_type), intent(in) :: state
    real(wp), intent(out) :: residual(nodes, heated_rows)
    real(wp) :: flux_x, flux_z, fed, source, to_shaft, to_foil, shear, lean_x, lean_z
    integer :: i

    residual = 0.0_wp
    do i = 1, nodes
      call point_numbers(gas, flow_here(flow, stretch(i)), &
                         sizes_at(nodes, stream_length(i), gradients(:, :, i)), &
                         values_at(nodes, shapes(:, i), gradients(:, :, i), state, i), state, &
                         flux_x, flux_z, fed, source, to_shaft, to_foil, shear, lean_x, lean_z)
      associate (area => areas(i), shape => shapes(:, i), gradient => gradients(:, :, i))
        residual(:, row_mass) = residual(:, row_mass) &
          + area*(flux_x*gradient(1, :) + flux_z*gradient(2, :))
        if (state%wall%present) then
          residual(:, row_mass) = residual(:, row_mass) - area*fed*shape
        end if
        residual(:, row_energy) = residual(:, row_energy) + area*source*shape
        if (state%leans) then
          residual(:, row_energy) = residual(:, row_energy) &
            + area*(lean_x*gradient(1, :) + lean_z*gradient(2, :))
        end if
        residual(:, row_foil) = residual(:, row_foil) + area*to_foil*shape
        residual(:, row_shaft) = residual(:, row_shaft) + area*to_shaft*shape
      end associate
    end do
  end subroutine sum_residual

  !> Exact derivatives of `heated_residual` by the nodal fields, and by the excess of the gap.
  pure subroutine heated_jacobian(geometry, flow, gas, state, by_field, by_excess)
    type(film_geometry_type), intent(in) :: geometry !! the element at its points
    type(film_flow_type), intent(in) :: flow !! speed and weighting of the film
    type(heated_gas_type), intent(in) :: gas !! that carries the heat
    type(heated_state_type), intent(in) :: state !! at the nodes
    real(wp), intent(out) :: by_field(:, :, :, :) !! (nodes of the row, rows, nodes, fields)
    real(wp), intent(out) :: by_excess(:, :, :)   !! (nodes, rows, points)

    if (size(by_field, 1) == film_nodes) then
      call sum_jacobian(film_nodes, film_shape, geometry%gradient, geometry%area, &
                        geometry%stream_length, geometry%stretch, flow, gas, state, by_field, &
                        by_excess)
    else
      call sum_jacobian(biquadratic_nodes, biquadratic_shape, geometry%gradient, geometry%area, &
                        geometry%stream_length, geometry%stretch, flow, gas, state, by_field, &
                        by_excess)
    end if
  end subroutine heated_jacobian

  !> The derivatives' sums over the Gauss points, of which there are as many as nodes.
  pure subroutine sum_jacobian(nodes, shapes, gradients, areas, stream_length, stretch, flow, gas, &
                               state, by_field, by_excess)
    integer, value :: nodes !! a value: the compiler makes a copy of the loops for each
    real(wp), intent(in) :: shapes(nodes, nodes)       !! shape functions (node, point) [1]
    real(wp), intent(in) :: gradients(2, nodes, nodes) !! their gradients (2, node, point) [1/m]
    real(wp), intent(in) :: areas(nodes)               !! of the points [m2]
    real(wp), intent(in) :: stream_length(nodes)       !! distance of the nodes along x [m]
    real(wp), intent(in) :: stretch(nodes)             !! see `gfb_film_surface` [1]
    type(film_flow_type), intent(in) :: flow
    type(heated_gas_type), intent(in) :: gas
    type(heated_state_type), intent(in) :: state
    real(wp), intent(out) :: by_field(nodes, heated_rows, nodes, heated_fields)
    real(wp), intent(out) :: by_excess(nodes, heated_rows, nodes)
    real(wp) :: rate(variables, flows), by(flows)
    integer :: i, b, k

    by_field = 0.0_wp
    do i = 1, nodes
      call point_rates(gas, flow_here(flow, stretch(i)), &
                       sizes_at(nodes, stream_length(i), gradients(:, :, i)), &
                       values_at(nodes, shapes(:, i), gradients(:, :, i), state, i), state, rate)
      associate (area => areas(i), shape => shapes(:, i), gradient => gradients(:, :, i))
        by_excess(:, :, i) = 0.0_wp
        call add_rates(nodes, area*rate(4, :), shape, gradient, by_excess(:, :, i))
        do b = 1, nodes
          do k = 1, heated_fields - 1
            by = shape(b)*rate(3*k - 2, :) + gradient(1, b)*rate(3*k - 1, :) &
              + gradient(2, b)*rate(3*k, :)
            call add_rates(nodes, area*by, shape, gradient, by_field(:, :, b, k))
          end do
          by = shape(b)*rate(13, :) + gradient(2, b)*rate(14, :)
          call add_rates(nodes, area*by, shape, gradient, by_field(:, :, b, field_shaft))
        end do
      end associate
    end do
  end subroutine sum_jacobian

  !> Adds what a point's flows do in the equations of the nodes.
  pure subroutine add_rates(nodes, flow, shape, gradient, rows)
    integer, value :: nodes
    real(wp), intent(in) :: flow(flows), shape(nodes), gradient(2, nodes)
    real(wp), intent(inout) :: rows(nodes, heated_rows)

    rows(:, row_mass) = rows(:, row_mass) &
      + (flow(flux_along)*gradient(1, :) + flow(flux_across)*gradient(2, :)) - flow(fed_in)*shape
    rows(:, row_energy) = rows(:, row_energy) + flow(into_gas)*shape &
      + (flow(lean_along)*gradient(1, :) + flow(lean_across)*gradient(2, :))
    rows(:, row_foil) = rows(:, row_foil) + flow(into_foil)*shape
    rows(:, row_shaft) = rows(:, row_shaft) + flow(into_shaft)*shape
  end subroutine add_rates

  !> Power of the shaft's drag on one element, \( \int V \tau_s d\Omega \) [W].
  pure real(wp) function heated_shear(geometry, flow, gas, state, nodes) result(power)
    type(film_geometry_type), intent(in) :: geometry !! the element at its points
    type(film_flow_type), intent(in) :: flow !! speed and weighting of the film
    type(heated_gas_type), intent(in) :: gas !! that carries the heat
    type(heated_state_type), intent(in) :: state !! at the nodes
    integer, intent(in) :: nodes !! of the element
    real(wp) :: shapes(nodes, nodes)
    real(wp) :: flux_x, flux_z, fed, source, to_shaft, to_foil, shear, lean_x, lean_z
    integer :: i

    shapes = film_shapes(nodes)
    power = 0.0_wp
    do i = 1, nodes
      call point_numbers(gas, flow_here(flow, geometry%stretch(i)), &
                         sizes_at(nodes, geometry%stream_length(i), geometry%gradient(:, :, i)), &
                         values_at(nodes, shapes(:, i), geometry%gradient(:, :, i), state, i), &
                         state, flux_x, flux_z, fed, source, to_shaft, to_foil, shear, lean_x, &
                         lean_z)
      power = power + geometry%area(i)*shear
    end do
  end function heated_shear

  !> Exact derivatives of `heated_shear` by the nodal fields, and by the excess of the gap.
  pure subroutine heated_shear_rates(geometry, flow, gas, state, by_field, by_excess)
    type(film_geometry_type), intent(in) :: geometry !! the element at its points
    type(film_flow_type), intent(in) :: flow !! speed and weighting of the film
    type(heated_gas_type), intent(in) :: gas !! that carries the heat
    type(heated_state_type), intent(in) :: state !! at the nodes
    real(wp), intent(out) :: by_field(:, :) !! (nodes, fields) [W/Pa], [W/m], [W/K]
    real(wp), intent(out) :: by_excess(:)   !! (points) [W/m]
    real(wp) :: shapes(size(by_excess), size(by_excess)), at(variables)
    type(dual_type) :: flux_x, flux_z, fed, source, to_shaft, to_foil, shear, lean_x, lean_z
    integer :: i, k

    shapes = film_shapes(size(by_excess))
    by_field = 0.0_wp
    do i = 1, size(by_excess)
      associate (shape => shapes(:, i), gradient => geometry%gradient(:, :, i))
        at = values_at(size(shape), shape, gradient, state, i)
        call point_duals(gas, flow_here(flow, geometry%stretch(i)), &
                         sizes_at(size(shape), geometry%stream_length(i), gradient), &
                         variable(at, [(k, k=1, variables)]), state, flux_x, flux_z, fed, source, &
                         to_shaft, to_foil, shear, lean_x, lean_z)
        associate (rate => geometry%area(i)*shear%d)
          by_excess(i) = rate(4)
          do k = 1, heated_fields - 1
            by_field(:, k) = by_field(:, k) + rate(3*k - 2)*shape &
              + matmul(rate(3*k - 1:3*k), gradient)
          end do
          by_field(:, field_shaft) = by_field(:, field_shaft) + rate(13)*shape &
            + rate(14)*gradient(2, :)
        end associate
      end associate
    end do
  end subroutine heated_shear_rates

  !> Sizes of an element at a point: its length along x [m], and how steep its shape functions are
  !> together, \( g_x = \sum_a |\partial N_a/\partial x| \), \( g_z \) [1/m].
  pure function sizes_at(nodes, stream_length, gradient) result(sizes)
    integer, value :: nodes
    real(wp), intent(in) :: stream_length
    real(wp), intent(in) :: gradient(2, nodes)
    real(wp) :: sizes(3)
    sizes = [stream_length, sum(abs(gradient(1, :))), sum(abs(gradient(2, :)))]
  end function sizes_at

  !> The variables at a point: p, h, T, T_f with their slopes along x and z, T_s with that along z.
  pure function values_at(nodes, shape, gradient, state, point) result(at)
    integer, value :: nodes
    real(wp), intent(in) :: shape(nodes)       !! functions [1]
    real(wp), intent(in) :: gradient(2, nodes) !! theirs [1/m]
    type(heated_state_type), intent(in) :: state
    integer, intent(in) :: point
    real(wp) :: at(variables), change
    integer :: k, b

    at = 0.0_wp
    do b = 1, nodes
      do k = 1, heated_fields - 1
        ! Less one node's value: what is even has no gradient to the last digit.
        change = state%field(b, k) - state%field(1, k)
        at(3*k - 2) = at(3*k - 2) + shape(b)*state%field(b, k)
        at(3*k - 1) = at(3*k - 1) + gradient(1, b)*change
        at(3*k) = at(3*k) + gradient(2, b)*change
      end do
      at(13) = at(13) + shape(b)*state%field(b, field_shaft)
      at(14) = at(14) + gradient(2, b)*(state%field(b, field_shaft) - state%field(1, field_shaft))
    end do
    at(4) = at(4) + state%excess(point)
  end function values_at

  !> Derivatives of all flows at a point by its variables.
  !>
  !> Without the upwind term few variables matter, and few of these together: by hand that takes
  !> half of the time of numbers with derivatives.
  pure subroutine point_rates(gas, flow, sizes, at, state, rate)
    type(heated_gas_type), intent(in) :: gas
    type(film_flow_type), intent(in) :: flow
    real(wp), intent(in) :: sizes(3) !! see `sizes_at`
    real(wp), intent(in) :: at(variables)
    type(heated_state_type), intent(in) :: state !! of the element
    real(wp), intent(out) :: rate(variables, flows)
    type(dual_type) :: flux_x, flux_z, fed, source, to_shaft, to_foil, shear, lean_x, lean_z
    integer :: k

    if (.not. (flow%upwind .or. state%leans)) then
      call galerkin_rates(gas, flow%entraining_speed, at, state%part, rate)
      if (state%wall%present) call add_wall_rates(gas, state%wall, at, rate)
      return
    end if
    call point_duals(gas, flow, sizes, variable(at, [(k, k=1, variables)]), state, flux_x, &
                     flux_z, fed, source, to_shaft, to_foil, shear, lean_x, lean_z)
    rate(:, flux_along) = flux_x%d
    rate(:, flux_across) = flux_z%d
    rate(:, into_gas) = source%d
    rate(:, into_foil) = to_foil%d
    rate(:, into_shaft) = to_shaft%d
    rate(:, fed_in) = fed%d
    rate(:, lean_along) = lean_x%d
    rate(:, lean_across) = lean_z%d
  end subroutine point_rates

  !> Adds those of a wall.
  pure subroutine add_wall_rates(gas, wall, at, rate)
    type(heated_gas_type), intent(in) :: gas
    type(porous_wall_type), intent(in) :: wall
    real(wp), intent(in) :: at(variables)
    real(wp), intent(inout) :: rate(variables, flows)
    real(wp) :: fed, by_pressure

    call wall_source(wall, gas%law, at(1), fed, by_pressure)
    rate(1, fed_in) = by_pressure
    if (.not. fed > 0.0_wp) return
    associate (capacity => gas%density*gas%specific_heat)
      rate(1, into_gas) = rate(1, into_gas) - capacity*by_pressure*(wall%temperature - at(7))
      rate(7, into_gas) = rate(7, into_gas) + capacity*fed
    end associate
  end subroutine add_wall_rates

  !> These without the upwind term. `of_` stands before derivatives by p, h, T and \( T_m \).
  pure subroutine galerkin_rates(gas, speed, at, part, rate)
    type(heated_gas_type), intent(in) :: gas
    real(wp), intent(in) :: speed !! U [m/s]
    real(wp), intent(in) :: at(variables), part
    real(wp), intent(out) :: rate(variables, flows)
    integer, parameter :: by_h = 2
    type(gas_state_type) :: law
    real(wp) :: ratio(3), felt, viscosity, entrained, free, open, thick
    real(wp) :: conductance, exchange, capacity
    real(wp), dimension(4) :: of_viscosity, of_entrained, of_free, of_open, of_thick, &
                              of_conductance, of_carried, of_shear, of_moment, of_exchange

    associate (p => at(1), p_x => at(2), p_z => at(3), h => at(4), t => at(7), foil => at(10), &
               shaft => at(13))
      law = gas_state(gas%law, p)
      felt = (1.0_wp - part)*gas%reference + part*t
      ratio = relative_viscosity(gas, (1.0_wp - part)*gas%reference &
                                 + part*mean_over_gap(t, foil, shaft))
      associate (factor_rate => part*ratio(2)/ratio(1), felt_rate => part/felt)
        viscosity = law%mu*ratio(1)
        of_viscosity = [law%mu_p*ratio(1), 0.0_wp, 0.0_wp, viscosity*factor_rate]
        entrained = law%r*(gas%reference/felt)
        of_entrained = [law%r_p*(gas%reference/felt), 0.0_wp, -entrained*felt_rate, 0.0_wp]
        free = (gas%law%mean_free_path*gas%law%ambient_pressure)*ratio(1)*sqrt(felt/gas%reference)/p
        of_free = free*[-1.0_wp/p, 0.0_wp, 0.5_wp*felt_rate, factor_rate]
      end associate
      open = h + 6.0_wp*free
      of_open = 6.0_wp*of_free
      of_open(by_h) = 1.0_wp
      thick = h + 2.0_wp*free
      of_thick = 2.0_wp*of_free
      of_thick(by_h) = 1.0_wp
      conductance = entrained*h*h*open/(12.0_wp*viscosity)
      of_conductance = conductance*(of_entrained/entrained + of_open/open - of_viscosity/viscosity)
      of_conductance(by_h) = of_conductance(by_h) + 2.0_wp*conductance/h
      of_carried = (h*speed)*of_entrained
      of_carried(by_h) = speed*entrained
      of_shear = (2.0_wp*speed)**2/thick*(of_viscosity - viscosity/thick*of_thick)
      of_shear(by_h) = of_shear(by_h) + speed*p_x
      of_exchange = of_viscosity/h
      of_exchange(by_h) = -viscosity/h**2
      of_moment = -(2.0_wp/3.0_wp*speed**2)*of_exchange
      of_moment(by_h) = of_moment(by_h) + speed/3.0_wp*p_x
      exchange = viscosity*(gas%specific_heat/gas%prandtl)/h
      of_exchange = (gas%specific_heat/gas%prandtl)*of_exchange
      rate = 0.0_wp
      call put_rates(of_conductance*p_x - of_carried, rate(:, flux_along))
      rate(2, flux_along) = conductance
      call put_rates(of_conductance*p_z, rate(:, flux_across))
      rate(3, flux_across) = conductance
      call put_rates(of_exchange*(8.0_wp*t - (19.0_wp/3.0_wp)*shaft - (5.0_wp/3.0_wp)*foil) &
                     + of_moment, rate(:, into_shaft))
      rate([7, 10, 13], into_shaft) = rate([7, 10, 13], into_shaft) &
        + exchange*[8.0_wp, -5.0_wp/3.0_wp, -19.0_wp/3.0_wp]
      rate(2, into_shaft) = h*speed/3.0_wp
      call put_rates(of_exchange*(4.0_wp*t - (5.0_wp/3.0_wp)*shaft - (7.0_wp/3.0_wp)*foil) &
                     - of_moment, rate(:, into_foil))
      rate([7, 10, 13], into_foil) = rate([7, 10, 13], into_foil) &
        + exchange*[4.0_wp, -7.0_wp/3.0_wp, -5.0_wp/3.0_wp]
      rate(2, into_foil) = -h*speed/3.0_wp
      call put_rates(-of_shear, rate(:, into_gas))
      rate(2, into_gas) = -h*speed
      capacity = -gas%density*gas%specific_heat
      associate (t_x => at(8), t_z => at(9))
        rate(:, into_gas) = rate(:, into_gas) + rate(:, into_shaft) + rate(:, into_foil) &
          + capacity*(t_x*rate(:, flux_along) + t_z*rate(:, flux_across))
      end associate
      rate(8, into_gas) = capacity*(conductance*p_x - entrained*h*speed)
      rate(9, into_gas) = capacity*(conductance*p_z)
    end associate
  end subroutine galerkin_rates

  !> Derivatives by p, h, T and \( T_m \) as those by the variables of a point.
  pure subroutine put_rates(by, rate)
    real(wp), intent(in) :: by(4)
    real(wp), intent(inout) :: rate(variables)

    rate(1) = by(1)
    rate(4) = by(2)
    rate(7) = by(3) + by(4)
    rate(10) = by(4)/6.0_wp
    rate(13) = -by(4)/6.0_wp
  end subroutine put_rates

  !> Fluxes of mass along x and z as the residual has them [Pa m2/s], what is fed in [Pa m/s], heat
  !> that the gas takes less what it gets, heat into the walls, power of the drag [W/m2].
  !>
  !> Around orifices transport is more than what conducts to the walls, and a film that is weighted
  !> by its shape functions alone has temperatures that swing from node to node. There the energy,
  !> whose strong residual is the heat that the gas takes, is weighted (SUPG) by
  !> \( N_a + \tau c_p \mathbf{m} \cdot \nabla N_a \), with
  !> \( \tau^{-2} = c_p^2 (m_x^2 g_x^2 + m_z^2 g_z^2) + (12 k/h)^2 \) and g of `sizes_at`: the
  !> leaning parts of all nodes add up to nothing, and energy closes.
  pure subroutine point_numbers(gas, flow, sizes, at, state, flux_x, flux_z, fed, source, &
                                to_shaft, to_foil, shear, lean_x, lean_z)
    type(heated_gas_type), intent(in) :: gas
    type(film_flow_type), intent(in) :: flow
    real(wp), intent(in) :: sizes(3) !! see `sizes_at`
    real(wp), intent(in) :: at(variables)
    type(heated_state_type), intent(in) :: state !! of the element
    real(wp), intent(out) :: flux_x, flux_z, fed, source, to_shaft, to_foil, shear, lean_x, lean_z
    real(wp) :: r, r_p, mu, mu_p, factor, factor_t, mean, mean_x, mean_z, free, open
    real(wp) :: felt, felt_x, felt_z
    real(wp) :: conductance, x_slope, z_slope, viscosity, strong, moment, exchange, entrained
    real(wp) :: lag, along, across

    fed = 0.0_wp
    lean_x = 0.0_wp
    lean_z = 0.0_wp
    include 'heated_point.inc'
  end subroutine point_numbers

  !> The same with derivatives by the variables.
  pure subroutine point_duals(gas, flow, sizes, at, state, flux_x, flux_z, fed, source, to_shaft, &
                              to_foil, shear, lean_x, lean_z)
    type(heated_gas_type), intent(in) :: gas
    type(film_flow_type), intent(in) :: flow
    real(wp), intent(in) :: sizes(3) !! see `sizes_at`
    type(dual_type), intent(in) :: at(variables)
    type(heated_state_type), intent(in) :: state !! of the element
    type(dual_type), intent(out) :: flux_x, flux_z, fed, source, to_shaft, to_foil, shear
    type(dual_type), intent(out) :: lean_x, lean_z
    type(dual_type) :: r, r_p, mu, mu_p, factor, factor_t, mean, mean_x, mean_z, free, open
    type(dual_type) :: felt, felt_x, felt_z
    type(dual_type) :: conductance, x_slope, z_slope, viscosity, strong, moment, exchange, entrained
    type(dual_type) :: lag, along, across

    include 'heated_point.inc'
  end subroutine point_duals

  elemental real(wp) function fed_number(wall, law, pressure) result(fed)
    type(porous_wall_type), intent(in) :: wall
    type(gas_law_type), intent(in) :: law
    real(wp), intent(in) :: pressure
    real(wp) :: rate
    call wall_source(wall, law, pressure, fed, rate)
  end function fed_number

  elemental type(dual_type) function fed_dual(wall, law, pressure) result(fed)
    type(porous_wall_type), intent(in) :: wall
    type(gas_law_type), intent(in) :: law
    type(dual_type), intent(in) :: pressure
    real(wp) :: value, rate

    call wall_source(wall, law, pressure%v, value, rate)
    fed = dual_of(value, rate, pressure)
  end function fed_dual

  elemental real(wp) function entering_number(fed) result(inward)
    real(wp), intent(in) :: fed
    inward = max(fed, 0.0_wp)
  end function entering_number

  elemental type(dual_type) function entering_dual(fed) result(inward)
    type(dual_type), intent(in) :: fed
    if (fed%v > 0.0_wp) inward = fed
  end function entering_dual

  elemental real(wp) function weight_of_number(peclet) result(weight)
    real(wp), intent(in) :: peclet
    weight = upwind_weight(peclet)
  end function weight_of_number

  elemental type(dual_type) function weight_of_dual(peclet) result(weight)
    type(dual_type), intent(in) :: peclet
    weight = dual_of(upwind_weight(peclet%v), upwind_weight_derivative(peclet%v), peclet)
  end function weight_of_dual
  !> What temperatures make of the gas at points of an element, beside its law at the reference
  !> temperature: where heat stands still the film needs no more of it.
  pure function gas_factors(gas, state, nodes) result(factors)
    type(heated_gas_type), intent(in) :: gas !! its law and reference
    type(heated_state_type), intent(in) :: state !! temperatures at the nodes
    integer, intent(in) :: nodes !! of the element
    type(gas_factors_type) :: factors(nodes)
    real(wp) :: shapes(nodes, nodes), t, ratio(3)
    integer :: i

    shapes = film_shapes(nodes)
    do i = 1, nodes
      associate (at => matmul(shapes(:, i), state%field(:nodes, :)))
        t = at(field_gas)
        ratio = relative_viscosity(gas, mean_over_gap(t, at(field_foil), at(field_shaft)))
      end associate
      factors(i) = gas_factors_type(gas%reference/t, ratio(1), ratio(1)*sqrt(t/gas%reference))
    end do
  end function gas_factors

  !> At a pressure and a mean temperature: r at the reference temperature and its slope, viscosity
  !> there and its slope, both by the pressure; viscosity's factor and its slope by the temperature.
  pure subroutine numbers_here(gas, pressure, mean, r, r_p, mu, mu_p, factor, factor_t)
    type(heated_gas_type), intent(in) :: gas !! the gas
    real(wp), intent(in) :: pressure, mean !! p, T_m [Pa], [K]
    real(wp), intent(out) :: r, r_p, mu, mu_p, factor, factor_t
    type(gas_state_type) :: state
    real(wp) :: ratio(3)

    state = gas_state(gas%law, pressure)
    ratio = relative_viscosity(gas, mean)
    r = state%r
    r_p = state%r_p
    mu = state%mu
    mu_p = state%mu_p
    factor = ratio(1)
    factor_t = ratio(2)
  end subroutine numbers_here

  !> The same with derivatives.
  pure subroutine duals_here(gas, pressure, mean, r, r_p, mu, mu_p, factor, factor_t)
    type(heated_gas_type), intent(in) :: gas !! the gas
    type(dual_type), intent(in) :: pressure, mean !! p, T_m [Pa], [K]
    type(dual_type), intent(out) :: r, r_p, mu, mu_p, factor, factor_t
    type(gas_state_type) :: state
    real(wp) :: ratio(3)

    state = gas_state(gas%law, pressure%v)
    ratio = relative_viscosity(gas, mean%v)
    r = dual_of(state%r, state%r_p, pressure)
    r_p = dual_of(state%r_p, state%r_pp, pressure)
    mu = dual_of(state%mu, state%mu_p, pressure)
    mu_p = dual_of(state%mu_p, state%mu_pp, pressure)
    factor = dual_of(ratio(1), ratio(2), mean)
    factor_t = dual_of(ratio(2), ratio(3), mean)
  end subroutine duals_here
  !> A variable itself.
  elemental type(dual_type) function variable(value, number) result(c)
    real(wp), intent(in) :: value !! of it
    integer, intent(in) :: number !! which it is
    c%v = value
    c%d(number) = 1.0_wp
  end function variable

  !> A function of one number whose derivative is known.
  elemental type(dual_type) function dual_of(value, slope, a) result(c)
    real(wp), intent(in) :: value     !! of the function
    real(wp), intent(in) :: slope     !! by the number
    type(dual_type), intent(in) :: a  !! the number
    c = dual_type(value, slope*a%d)
  end function dual_of

  elemental type(dual_type) function plus(a, b) result(c)
    type(dual_type), intent(in) :: a, b
    c = dual_type(a%v + b%v, a%d + b%d)
  end function plus

  elemental type(dual_type) function real_plus(a, b) result(c)
    real(wp), intent(in) :: a
    type(dual_type), intent(in) :: b
    c = dual_type(a + b%v, b%d)
  end function real_plus

  elemental type(dual_type) function minus(a, b) result(c)
    type(dual_type), intent(in) :: a, b
    c = dual_type(a%v - b%v, a%d - b%d)
  end function minus

  elemental type(dual_type) function times(a, b) result(c)
    type(dual_type), intent(in) :: a, b
    c = dual_type(a%v*b%v, a%v*b%d + b%v*a%d)
  end function times

  elemental type(dual_type) function times_real(a, b) result(c)
    type(dual_type), intent(in) :: a
    real(wp), intent(in) :: b
    c = dual_type(a%v*b, b*a%d)
  end function times_real

  elemental type(dual_type) function real_times(a, b) result(c)
    real(wp), intent(in) :: a
    type(dual_type), intent(in) :: b
    c = dual_type(a*b%v, a*b%d)
  end function real_times

  elemental type(dual_type) function over(a, b) result(c)
    type(dual_type), intent(in) :: a, b
    c%v = a%v/b%v
    c%d = (a%d - c%v*b%d)/b%v
  end function over

  elemental type(dual_type) function over_real(a, b) result(c)
    type(dual_type), intent(in) :: a
    real(wp), intent(in) :: b
    c = dual_type(a%v/b, a%d/b)
  end function over_real

  elemental type(dual_type) function real_over(a, b) result(c)
    real(wp), intent(in) :: a
    type(dual_type), intent(in) :: b
    c%v = a/b%v
    c%d = -(c%v/b%v)*b%d
  end function real_over

  elemental type(dual_type) function square_root(a) result(c)
    type(dual_type), intent(in) :: a
    c%v = sqrt(a%v)
    c%d = a%d/(2.0_wp*c%v)
  end function square_root
end module gfb_heated_film
