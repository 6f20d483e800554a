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
module gfb_heated_film
  use gfb_kinds, only: wp
  use gfb_film_flow, only: film_flow_type, flow_here
  use gfb_upwind_weight, only: upwind_weight, upwind_weight_derivative
  use gfb_film_geometry, only: film_geometry_type, film_shapes, most_film_nodes
  use gfb_gas_law, only: gas_law_type, gas_factors_type, gas_state, gas_state_type, &
                         viscosity_sutherland, viscosity_power, sutherland_temperature
  implicit none (type, external)
  private
  public :: heated_residual, heated_jacobian, heated_shear, heated_shear_rates, gas_factors
  public :: relative_viscosity, mean_over_gap

  !> Variables of a point of a film, see `values_at`.
  integer, parameter :: variables = 14

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


  !> What the energy equation wants of the gas, beside its law at the reference temperature.
  type, public :: heated_gas_type
    type(gas_law_type) :: law            !! at the reference temperature
    real(wp) :: reference = 0.0_wp       !! T_r, where the law holds [K]
    real(wp) :: density = 0.0_wp         !! of mass over r, 1/(R_g T_r) [kg/(Pa m3)]
    real(wp) :: specific_heat = 0.0_wp   !! c_p [J/(kg K)]
    real(wp) :: prandtl = 0.0_wp         !! Pr [1]
    integer :: viscosity = viscosity_sutherland !! how it follows the temperature
    real(wp) :: exponent = 0.0_wp        !! n of the power law [1]
  end type heated_gas_type

  !> The gas at a point, of plain numbers or of numbers with derivatives.
  interface gas_here
    module procedure numbers_here, duals_here
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
    real(wp) :: shapes(size(residual, 1), size(residual, 1)), at(variables)
    real(wp) :: flux_x, flux_z, source, to_shaft, to_foil, shear
    integer :: i, n

    n = size(residual, 1)
    shapes = film_shapes(n)
    residual = 0.0_wp
    do i = 1, n
      at = values_at(shapes(:, i), geometry%gradient(:, :, i), state, i)
      call point_numbers(gas, flow_here(flow, geometry%stretch(i)), geometry%stream_length(i), at, &
                         state%part, flux_x, flux_z, source, to_shaft, to_foil, shear)
      associate (area => geometry%area(i), shape => shapes(:, i), &
                 gradient => geometry%gradient(:, :, i))
        residual(:, row_mass) = residual(:, row_mass) &
          + area*(flux_x*gradient(1, :) + flux_z*gradient(2, :))
        residual(:, row_energy) = residual(:, row_energy) + area*source*shape
        residual(:, row_foil) = residual(:, row_foil) + area*to_foil*shape
        residual(:, row_shaft) = residual(:, row_shaft) + area*to_shaft*shape
      end associate
    end do
  end subroutine heated_residual

  !> Exact derivatives of `heated_residual` by the nodal fields, and by the excess of the gap.
  pure subroutine heated_jacobian(geometry, flow, gas, state, by_field, by_excess)
    type(film_geometry_type), intent(in) :: geometry !! the element at its points
    type(film_flow_type), intent(in) :: flow !! speed and weighting of the film
    type(heated_gas_type), intent(in) :: gas !! that carries the heat
    type(heated_state_type), intent(in) :: state !! at the nodes
    real(wp), intent(out) :: by_field(:, :, :, :) !! (nodes of the row, rows, nodes, fields)
    real(wp), intent(out) :: by_excess(:, :, :)   !! (nodes, rows, points)
    real(wp), dimension(size(by_field, 1), size(by_field, 1)) :: shapes
    real(wp) :: at(variables)
    type(dual_type) :: now(variables), flux_x, flux_z, source, to_shaft, to_foil, shear
    real(wp) :: row(size(by_field, 1), heated_rows, variables)
    integer :: i, b, k, n

    n = size(by_field, 1)
    shapes = film_shapes(n)
    by_field = 0.0_wp
    do i = 1, n
      at = values_at(shapes(:, i), geometry%gradient(:, :, i), state, i)
      now = variable(at, [(k, k=1, variables)])
      call point_duals(gas, flow_here(flow, geometry%stretch(i)), geometry%stream_length(i), now, &
                       state%part, flux_x, flux_z, source, to_shaft, to_foil, shear)
      associate (area => geometry%area(i), shape => shapes(:, i), &
                 gradient => geometry%gradient(:, :, i))
        do k = 1, variables
          row(:, row_mass, k) = area*(flux_x%d(k)*gradient(1, :) + flux_z%d(k)*gradient(2, :))
          row(:, row_energy, k) = area*source%d(k)*shape
          row(:, row_foil, k) = area*to_foil%d(k)*shape
          row(:, row_shaft, k) = area*to_shaft%d(k)*shape
        end do
        by_excess(:, :, i) = row(:, :, 4)
        do b = 1, n
          do k = 1, heated_fields - 1
            by_field(:, :, b, k) = by_field(:, :, b, k) + shape(b)*row(:, :, 3*k - 2) &
              + gradient(1, b)*row(:, :, 3*k - 1) + gradient(2, b)*row(:, :, 3*k)
          end do
          by_field(:, :, b, field_shaft) = by_field(:, :, b, field_shaft) + shape(b)*row(:, :, 13) &
            + gradient(2, b)*row(:, :, 14)
        end do
      end associate
    end do
  end subroutine heated_jacobian

  !> Power of the shaft's drag on one element, \( \int V \tau_s d\Omega \) [W].
  pure real(wp) function heated_shear(geometry, flow, gas, state, nodes) result(power)
    type(film_geometry_type), intent(in) :: geometry !! the element at its points
    type(film_flow_type), intent(in) :: flow !! speed and weighting of the film
    type(heated_gas_type), intent(in) :: gas !! that carries the heat
    type(heated_state_type), intent(in) :: state !! at the nodes
    integer, intent(in) :: nodes !! of the element
    real(wp) :: shapes(nodes, nodes), flux_x, flux_z, source, to_shaft, to_foil, shear
    integer :: i

    shapes = film_shapes(nodes)
    power = 0.0_wp
    do i = 1, nodes
      call point_numbers(gas, flow_here(flow, geometry%stretch(i)), geometry%stream_length(i), &
                         values_at(shapes(:, i), geometry%gradient(:, :, i), state, i), &
                         state%part, flux_x, flux_z, source, to_shaft, to_foil, shear)
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
    type(dual_type) :: flux_x, flux_z, source, to_shaft, to_foil, shear
    integer :: i, k

    shapes = film_shapes(size(by_excess))
    by_field = 0.0_wp
    do i = 1, size(by_excess)
      associate (shape => shapes(:, i), gradient => geometry%gradient(:, :, i))
        at = values_at(shape, gradient, state, i)
        call point_duals(gas, flow_here(flow, geometry%stretch(i)), geometry%stream_length(i), &
                         variable(at, [(k, k=1, variables)]), state%part, flux_x, flux_z, source, &
                         to_shaft, to_foil, shear)
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

  !> The variables at a point: p, h, T, T_f with their slopes along x and z, T_s with that along z.
  pure function values_at(shape, gradient, state, point) result(at)
    real(wp), intent(in) :: shape(:)       !! functions [1]
    real(wp), intent(in) :: gradient(:, :) !! (2, nodes) theirs [1/m]
    type(heated_state_type), intent(in) :: state
    integer, intent(in) :: point
    real(wp) :: at(variables), value(size(shape))
    integer :: k

    do k = 1, heated_fields - 1
      ! Less one node's value: what is even has no gradient to the last digit.
      value = state%field(:size(shape), k)
      at(3*k - 2) = dot_product(shape, value)
      at(3*k - 1:3*k) = matmul(gradient, value - value(1))
    end do
    at(4) = at(4) + state%excess(point)
    value = state%field(:size(shape), field_shaft)
    at(13) = dot_product(shape, value)
    at(14) = dot_product(gradient(2, :), value - value(1))
  end function values_at

  !> Fluxes of mass along x and z as the residual has them [Pa m2/s], heat that the gas takes less
  !> what it gets, heat into the walls, power of the drag [W/m2].
  pure subroutine point_numbers(gas, flow, length, at, part, flux_x, flux_z, source, to_shaft, &
                                to_foil, shear)
    type(heated_gas_type), intent(in) :: gas
    type(film_flow_type), intent(in) :: flow
    real(wp), intent(in) :: length !! of the element along x [m]
    real(wp), intent(in) :: at(variables), part
    real(wp), intent(out) :: flux_x, flux_z, source, to_shaft, to_foil, shear
    real(wp) :: r, r_p, mu, mu_p, factor, factor_t, mean, mean_x, mean_z, free, open
    real(wp) :: felt, felt_x, felt_z
    real(wp) :: conductance, x_slope, z_slope, viscosity, strong, moment, exchange, entrained

    include 'heated_point.inc'
  end subroutine point_numbers

  !> The same with derivatives by the variables.
  pure subroutine point_duals(gas, flow, length, at, part, flux_x, flux_z, source, to_shaft, &
                              to_foil, shear)
    type(heated_gas_type), intent(in) :: gas
    type(film_flow_type), intent(in) :: flow
    real(wp), intent(in) :: length !! of the element along x [m]
    type(dual_type), intent(in) :: at(variables)
    real(wp), intent(in) :: part
    type(dual_type), intent(out) :: flux_x, flux_z, source, to_shaft, to_foil, shear
    type(dual_type) :: r, r_p, mu, mu_p, factor, factor_t, mean, mean_x, mean_z, free, open
    type(dual_type) :: felt, felt_x, felt_z
    type(dual_type) :: conductance, x_slope, z_slope, viscosity, strong, moment, exchange, entrained

    include 'heated_point.inc'
  end subroutine point_duals

  elemental real(wp) function weight_of_number(peclet) result(weight)
    real(wp), intent(in) :: peclet
    weight = upwind_weight(peclet)
  end function weight_of_number

  elemental type(dual_type) function weight_of_dual(peclet) result(weight)
    type(dual_type), intent(in) :: peclet
    weight = dual_of(upwind_weight(peclet%v), upwind_weight_derivative(peclet%v), peclet)
  end function weight_of_dual
  !> Viscosity over that at the reference temperature, \( \nu(T) \), with two derivatives by it.
  pure function relative_viscosity(gas, temperature) result(ratio)
    type(heated_gas_type), intent(in) :: gas !! its law and reference
    real(wp), intent(in) :: temperature !! T [K]
    real(wp) :: ratio(3)                !! [1], [1/K], [1/K2]
    real(wp) :: rate, bend

    ratio = [1.0_wp, 0.0_wp, 0.0_wp]
    associate (t => temperature, r => gas%reference, s => sutherland_temperature)
      select case (gas%viscosity)
      case (viscosity_sutherland)
        ratio(1) = (t/r)*sqrt(t/r)*(r + s)/(t + s)
        rate = 1.5_wp/t - 1.0_wp/(t + s)
        bend = -1.5_wp/t**2 + 1.0_wp/(t + s)**2
      case (viscosity_power)
        ratio(1) = (t/r)**gas%exponent
        rate = gas%exponent/t
        bend = -gas%exponent/t**2
      case default
        return
      end select
      ratio(2) = ratio(1)*rate
      ratio(3) = ratio(1)*(rate**2 + bend)
    end associate
  end function relative_viscosity

  !> Mean temperature over the gap, \( T - (T_s - T_f)/6 \) [K].
  elemental real(wp) function mean_over_gap(gas, foil, shaft) result(mean)
    real(wp), intent(in) :: gas         !! T, at which the gas carries its heat [K]
    real(wp), intent(in) :: foil, shaft !! T_f, T_s [K]
    mean = gas + (foil - shaft)/6.0_wp
  end function mean_over_gap

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
