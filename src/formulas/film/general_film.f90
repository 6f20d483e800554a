!> Element of a film of any gas: with slip, a real gas, turbulence.
!>
!> Where the gas is plain, `gfb_reynolds_element` gives the same, faster.
!>
!> Drag of a film of any gas on the shaft: with slip, a real gas, turbulence.
!>
!> Where the gas is plain, `film_friction` of `gfb_film_load` gives the same, faster.
module gfb_general_film
  use gfb_kinds, only: wp
  use gfb_film_geometry, only: film_geometry_type, film_shapes
  use gfb_gas_law, only: gas_law_type, gas_factors_type, gas_state_type, gas_state
  use gfb_film_flow, only: film_flow_type, flow_here
  use gfb_upwind_weight, only: cell_peclet, upwind_weight, upwind_weight_derivative
  implicit none (type, external)
  private
  public :: film_flow_type, general_residual, general_jacobian, general_peclet, peclet_slopes, &
            general_friction, general_friction_rates, factors_at

  !> A function of pressure and gap with its first and second derivatives.
  type :: jet_type
    real(wp) :: f, p, h, pp, ph, hh
  end type jet_type

  !> Everything at a Gauss point.
  type :: point_type
    real(wp) :: p, p_x, p_z   !! pressure and its gradient [Pa], [Pa/m]
    real(wp) :: h, h_x, h_z   !! gap and its gradient [m], [1]
    type(gas_state_type) :: gas
    type(jet_type) :: along, across !! conductances G_x, G_z [Pa m3/(Pa s)]
  end type point_type

  ! Fits to [NgPan1965]: a and b of the factors 12/(12 + a Re^b) of the flow along and across the
  ! motion.
  real(wp), parameter :: along_factor(2) = [0.0136_wp, 0.90_wp]
  real(wp), parameter :: across_factor(2) = [0.0043_wp, 0.96_wp]

  !> a and b of the factor 1 + a Re^b of the shear in turbulent flow [Constantinescu1959].
  real(wp), parameter :: shear_factor(2) = [0.0012_wp, 0.94_wp]

contains

  !> Residual of the film's equation on one element.
  !>
  !> $$ r_a = \int_{\Omega^e} \Bigl[ \nabla N_a \cdot \bigl( G \nabla p - r h \mathbf{U} \bigr)
  !>      + \frac{\alpha \ell}{2} \frac{\partial N_a}{\partial x}
  !>      \bigl( \nabla \cdot (r h \mathbf{U}) - \nabla \cdot G \nabla p \bigr) \Bigr] d\Omega,
  !> $$
  !>
  !> $$ G = \frac{r h^3}{12 \mu} \Bigl( 1 + \frac{6 \lambda}{h} \Bigr) k(Re), \quad
  !>    \lambda = \lambda_a \frac{p_a}{p} $$
  !>
  !> with the density r of `gfb_gas_law`. Sources: [Burgdorfer1959] for slip, [NgPan1965] for the
  !> factors k. Weighting (SUPG) as in `gfb_reynolds_element`; without it temperatures may differ
  !> from point to point: with it their slopes would count, see `gfb_heated_film`.
  pure subroutine general_residual(geometry, flow, law, pressure, gap, excess, residual, factors)
    type(film_geometry_type), intent(in) :: geometry !! the element at its points
    type(film_flow_type), intent(in) :: flow !! speed and weighting of the film
    type(gas_law_type), intent(in) :: law    !! of the gas
    real(wp), intent(in) :: pressure(:)  !! absolute pressure at the nodes [Pa]
    real(wp), intent(in) :: gap(:)       !! film thickness at the nodes [m]
    real(wp), intent(in) :: excess(:)    !! of the gap at the points over the nodes' [m]
    real(wp), intent(out) :: residual(:) !! one a node [Pa m3/s]
    type(gas_factors_type), intent(in), optional :: factors(:) !! of other temperatures there
    real(wp) :: shapes(size(gap), size(gap)), flux_x, flux_z
    type(film_flow_type) :: local
    type(point_type) :: here
    type(jet_type) :: peclet
    integer :: i

    shapes = film_shapes(size(gap))
    residual = 0.0_wp
    do i = 1, size(gap)
      associate (gradient => geometry%gradient(:, :, i), length => geometry%stream_length(i))
        local = flow_here(flow, geometry%stretch(i))
        here = state_at(shapes(:, i), gradient, law, local, pressure, gap, excess(i), &
                        factors_at(i, factors))
        flux_x = here%along%f*here%p_x - here%gas%r*here%h*local%entraining_speed
        flux_z = here%across%f*here%p_z
        if (flow%upwind) then
          peclet = peclet_jet(here, local, length)
          flux_x = flux_x + 0.5_wp*length*upwind_weight(peclet%f)*strong_residual(here, local)
        end if
        residual = residual + geometry%area(i)*(flux_x*gradient(1, :) + flux_z*gradient(2, :))
      end associate
    end do
  end subroutine general_residual

  !> Exact derivatives of `general_residual` by the nodal pressures and gaps, and by the excess.
  pure subroutine general_jacobian(geometry, flow, law, pressure, gap, excess, by_pressure, &
                                   by_gap, by_excess, factors)
    type(film_geometry_type), intent(in) :: geometry !! the element at its points
    type(film_flow_type), intent(in) :: flow !! speed and weighting of the film
    type(gas_law_type), intent(in) :: law    !! of the gas
    real(wp), intent(in) :: pressure(:) !! absolute pressure at the nodes [Pa]
    real(wp), intent(in) :: gap(:)      !! film thickness at the nodes [m]
    real(wp), intent(in) :: excess(:)   !! of the gap at the points over the nodes' [m]
    real(wp), intent(out) :: by_pressure(:, :) !! (nodes, nodes) dr_a/dp_b [m3/s]
    real(wp), intent(out) :: by_gap(:, :)      !! (nodes, nodes) dr_a/dh_b [Pa m2/s]
    real(wp), intent(out) :: by_excess(:, :)   !! (nodes, points) [Pa m2/s]
    type(gas_factors_type), intent(in), optional :: factors(:) !! of other temperatures there
    real(wp) :: shapes(size(gap), size(gap)), x_by_h, z_by_h
    real(wp), dimension(size(gap)) :: x_by_p, z_by_p, x_by_slope
    type(film_flow_type) :: local
    type(point_type) :: here
    integer :: i, b

    shapes = film_shapes(size(gap))
    by_pressure = 0.0_wp
    by_gap = 0.0_wp
    do i = 1, size(gap)
      local = flow_here(flow, geometry%stretch(i))
      associate (shape => shapes(:, i), gradient => geometry%gradient(:, :, i), &
                 area => geometry%area(i), speed => local%entraining_speed)
        here = state_at(shape, gradient, law, local, pressure, gap, excess(i), &
                        factors_at(i, factors))
        x_by_p = shape*(here%along%p*here%p_x - here%gas%r_p*here%h*speed) &
          + here%along%f*gradient(1, :)
        z_by_p = shape*here%across%p*here%p_z + here%across%f*gradient(2, :)
        x_by_h = here%along%h*here%p_x - here%gas%r*speed
        z_by_h = here%across%h*here%p_z
        x_by_slope = 0.0_wp
        if (flow%upwind) then
          call add_upwind_derivatives(here, local, geometry%stream_length(i), shape, gradient, &
                                      x_by_p, x_by_h, x_by_slope)
        end if
        by_excess(:, i) = area*(x_by_h*gradient(1, :) + z_by_h*gradient(2, :))
        do b = 1, size(gap)
          by_pressure(:, b) = by_pressure(:, b) &
            + area*(x_by_p(b)*gradient(1, :) + z_by_p(b)*gradient(2, :))
          by_gap(:, b) = by_gap(:, b) + shape(b)*by_excess(:, i) &
            + area*x_by_slope(b)*gradient(1, :)
        end do
      end associate
    end do
  end subroutine general_jacobian

  !> Adds the derivatives of the upwind term's flux along x: by nodal pressures, by the gap at the
  !> point, and by the nodal gaps through the gap's slope.
  pure subroutine add_upwind_derivatives(here, flow, stream_length, shape, gradient, x_by_p, &
                                         x_by_h, x_by_slope)
    type(point_type), intent(in) :: here
    type(film_flow_type), intent(in) :: flow
    real(wp), intent(in) :: stream_length  !! the element's length along x [m]
    real(wp), intent(in) :: shape(:)       !! shape functions [1]
    real(wp), intent(in) :: gradient(:, :) !! (2, nodes) their gradients [1/m]
    real(wp), intent(inout) :: x_by_p(:)     !! flux along x by nodal pressure
    real(wp), intent(inout) :: x_by_h        !! flux along x by the gap
    real(wp), intent(inout) :: x_by_slope(:) !! flux along x by nodal gap, slope alone
    type(jet_type) :: peclet
    real(wp) :: weight, slope, strong, by_p, by_h

    peclet = peclet_jet(here, flow, stream_length)
    weight = 0.5_wp*stream_length*upwind_weight(peclet%f)
    slope = 0.5_wp*stream_length*upwind_weight_derivative(peclet%f)
    strong = strong_residual(here, flow)
    associate (x => here%along, z => here%across, gas => here%gas, speed => flow%entraining_speed)
      by_p = speed*(gas%r_pp*here%p_x*here%h + gas%r_p*here%h_x) &
        - (x%pp*here%p_x + x%ph*here%h_x)*here%p_x - (z%pp*here%p_z + z%ph*here%h_z)*here%p_z
      by_h = speed*gas%r_p*here%p_x &
        - (x%ph*here%p_x + x%hh*here%h_x)*here%p_x - (z%ph*here%p_z + z%hh*here%h_z)*here%p_z
      x_by_p = x_by_p + shape*(weight*by_p + slope*strong*peclet%p) &
        + weight*((speed*gas%r_p*here%h - 2.0_wp*x%p*here%p_x - x%h*here%h_x)*gradient(1, :) &
                  - (2.0_wp*z%p*here%p_z + z%h*here%h_z)*gradient(2, :))
      x_by_h = x_by_h + weight*by_h + slope*strong*peclet%h
      x_by_slope = x_by_slope + weight*((speed*gas%r - x%h*here%p_x)*gradient(1, :) &
                                        - z%h*here%p_z*gradient(2, :))
    end associate
  end subroutine add_upwind_derivatives

  !> Divergence form of the equation at a point, without second derivatives [Pa m/s].
  pure real(wp) function strong_residual(here, flow) result(strong)
    type(point_type), intent(in) :: here
    type(film_flow_type), intent(in) :: flow

    associate (x => here%along, z => here%across)
      strong = flow%entraining_speed*(here%gas%r_p*here%p_x*here%h + here%gas%r*here%h_x) &
        - (x%p*here%p_x + x%h*here%h_x)*here%p_x - (z%p*here%p_z + z%h*here%h_z)*here%p_z
    end associate
  end function strong_residual

  !> Cell Peclet number, entrained over diffused flow: that of `cell_peclet` where the gas is plain.
  !>
  !> $$ Pe = \frac{U h r' \ell}{2 G_x} $$
  pure function general_peclet(law, flow, stream_length, pressure, gap, factors) result(peclet)
    type(gas_law_type), intent(in) :: law    !! of the gas
    type(film_flow_type), intent(in) :: flow !! viscosity and speed of the film
    real(wp), intent(in) :: stream_length !! l, the element's length along x [m]
    real(wp), intent(in) :: pressure      !! p [Pa]
    real(wp), intent(in) :: gap           !! h [m]
    type(gas_factors_type), intent(in), optional :: factors !! of another temperature
    real(wp) :: peclet                    !! [1]
    real(wp) :: slopes(3)

    slopes = peclet_slopes(law, flow, stream_length, pressure, gap, factors)
    peclet = slopes(1)
  end function general_peclet

  !> That number and its derivatives by pressure and gap.
  pure function peclet_slopes(law, flow, stream_length, pressure, gap, factors) result(slopes)
    type(gas_law_type), intent(in) :: law    !! of the gas
    type(film_flow_type), intent(in) :: flow !! viscosity and speed of the film
    real(wp), intent(in) :: stream_length !! l, the element's length along x [m]
    real(wp), intent(in) :: pressure      !! p [Pa]
    real(wp), intent(in) :: gap           !! h [m]
    type(gas_factors_type), intent(in), optional :: factors !! of another temperature
    real(wp) :: slopes(3)                 !! [1], [1/Pa], [1/m]
    type(point_type) :: here
    type(jet_type) :: jet

    if (law%plain) then
      slopes(1) = cell_peclet(flow, stream_length, pressure, gap)
      slopes(2:) = -slopes(1)*[1.0_wp/pressure, 2.0_wp/gap]
      return
    end if
    here%p = pressure
    here%h = gap
    call put_gas(law, flow, here, factors)
    jet = peclet_jet(here, flow, stream_length)
    slopes = [jet%f, jet%p, jet%h]
  end function peclet_slopes

  !> Reynolds number of the film, \( Re = 2 \rho U h/\mu \).
  pure function reynolds_number(flow, law, gas, gap) result(number)
    type(film_flow_type), intent(in) :: flow !! whose surface moves with 2 U
    type(gas_law_type), intent(in) :: law !! of the gas
    type(gas_state_type), intent(in) :: gas !! its density and viscosity
    real(wp), intent(in) :: gap !! h [m]
    real(wp) :: number          !! [1]

    number = abs(2.0_wp*flow%entraining_speed)*law%ambient_density/law%ambient_pressure &
      *gas%r*gap/gas%mu
  end function reynolds_number

  !> Pressure, gap, gas and conductances at a Gauss point.
  pure function state_at(shape, gradient, law, flow, pressure, gap, excess, factors) result(here)
    real(wp), intent(in) :: shape(:)       !! shape functions [1]
    real(wp), intent(in) :: gradient(:, :) !! (2, nodes) their gradients [1/m]
    type(gas_law_type), intent(in) :: law
    type(film_flow_type), intent(in) :: flow
    real(wp), intent(in) :: pressure(:), gap(:) !! at the nodes [Pa], [m]
    real(wp), intent(in) :: excess              !! of the gap over what its nodal values give [m]
    type(gas_factors_type), intent(in) :: factors !! of another temperature
    type(point_type) :: here

    here%p = dot_product(shape, pressure)
    here%h = dot_product(shape, gap) + excess
    ! Less one node's pressure: an even pressure has no gradient to the last digit.
    here%p_x = dot_product(gradient(1, :), pressure - pressure(1))
    here%p_z = dot_product(gradient(2, :), pressure - pressure(1))
    here%h_x = dot_product(gradient(1, :), gap)
    here%h_z = dot_product(gradient(2, :), gap)
    call put_gas(law, flow, here, factors)
  end function state_at

  !> The gas and its conductances at a point's pressure and gap.
  pure subroutine put_gas(law, flow, here, factors)
    type(gas_law_type), intent(in) :: law
    type(film_flow_type), intent(in) :: flow
    type(point_type), intent(inout) :: here
    type(gas_factors_type), intent(in), optional :: factors !! of another temperature
    type(jet_type) :: open, fluid, number
    real(wp) :: slip

    here%gas = gas_state(law, here%p)
    slip = 6.0_wp*law%mean_free_path*law%ambient_pressure
    if (present(factors)) then
      here%gas = changed(here%gas, factors)
      slip = slip*factors%mean_free_path
    end if
    associate (gas => here%gas, p => here%p, h => here%h)
      open = jet_type(f=h**3 + slip*h**2/p, p=-slip*(h/p)**2, h=3.0_wp*h**2 + 2.0_wp*slip*h/p, &
                      pp=2.0_wp*slip*h**2/p**3, ph=-2.0_wp*slip*h/p**2, hh=6.0_wp*h + 2.0_wp*slip/p)
      ! r/(12 mu): from its product with mu.
      fluid = jet_type(gas%r/(12.0_wp*gas%mu), 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp)
      fluid%p = (gas%r_p/12.0_wp - fluid%f*gas%mu_p)/gas%mu
      fluid%pp = (gas%r_pp/12.0_wp - 2.0_wp*fluid%p*gas%mu_p - fluid%f*gas%mu_pp)/gas%mu
      here%along = product_of(fluid, open)
      here%across = here%along
      if (.not. law%turbulent) return
      ! The Reynolds number is in proportion to h r/mu.
      number = product_of(fluid, jet_type(h, 0.0_wp, 1.0_wp, 0.0_wp, 0.0_wp, 0.0_wp))
      number = scaled(number, 24.0_wp*abs(flow%entraining_speed)*law%ambient_density &
                      /law%ambient_pressure)
      if (.not. number%f > 0.0_wp) return
      here%along = product_of(here%along, turbulent_factor(number, along_factor))
      here%across = product_of(here%across, turbulent_factor(number, across_factor))
    end associate
  end subroutine put_gas

  !> The gas at another temperature.
  elemental type(gas_state_type) function changed(gas, factors) result(state)
    type(gas_state_type), intent(in) :: gas !! at that of its law
    type(gas_factors_type), intent(in) :: factors

    state%r = factors%density*gas%r
    state%r_p = factors%density*gas%r_p
    state%r_pp = factors%density*gas%r_pp
    state%mu = factors%viscosity*gas%mu
    state%mu_p = factors%viscosity*gas%mu_p
    state%mu_pp = factors%viscosity*gas%mu_pp
  end function changed

  !> What temperatures make of the gas at a point; nothing where there are none.
  pure type(gas_factors_type) function factors_at(point, factors) result(here)
    integer, intent(in) :: point
    type(gas_factors_type), intent(in), optional :: factors(:) !! at all points

    here = gas_factors_type()
    if (present(factors)) here = factors(point)
  end function factors_at

  !> The factor 12/(12 + a Re^b).
  pure function turbulent_factor(number, factor) result(k)
    type(jet_type), intent(in) :: number !! Re, positive
    real(wp), intent(in) :: factor(2)    !! a, b [1]
    type(jet_type) :: k
    real(wp) :: power, slope, curvature

    associate (a => factor(1), b => factor(2), re => number%f)
      power = a*re**b/12.0_wp
      k%f = 1.0_wp/(1.0_wp + power)
      slope = -k%f**2*power*b/re
      curvature = 2.0_wp*slope**2/k%f - k%f**2*power*b*(b - 1.0_wp)/re**2
    end associate
    k%p = slope*number%p
    k%h = slope*number%h
    k%pp = slope*number%pp + curvature*number%p**2
    k%ph = slope*number%ph + curvature*number%p*number%h
    k%hh = slope*number%hh + curvature*number%h**2
  end function turbulent_factor

  !> The cell Peclet number with its first derivatives; the second are not set.
  pure function peclet_jet(here, flow, stream_length) result(peclet)
    type(point_type), intent(in) :: here
    type(film_flow_type), intent(in) :: flow
    real(wp), intent(in) :: stream_length !! [m]
    type(jet_type) :: peclet
    real(wp) :: scale

    associate (gas => here%gas, x => here%along)
      scale = 0.5_wp*flow%entraining_speed*stream_length/x%f
      peclet = jet_type(scale*here%h*gas%r_p, scale*here%h*(gas%r_pp - gas%r_p*x%p/x%f), &
                        scale*gas%r_p*(1.0_wp - here%h*x%h/x%f), 0.0_wp, 0.0_wp, 0.0_wp)
    end associate
  end function peclet_jet

  !> Product of two functions.
  pure function product_of(first, second) result(both)
    type(jet_type), intent(in) :: first, second
    type(jet_type) :: both

    both%f = first%f*second%f
    both%p = first%p*second%f + first%f*second%p
    both%h = first%h*second%f + first%f*second%h
    both%pp = first%pp*second%f + 2.0_wp*first%p*second%p + first%f*second%pp
    both%ph = first%ph*second%f + first%p*second%h + first%h*second%p + first%f*second%ph
    both%hh = first%hh*second%f + 2.0_wp*first%h*second%h + first%f*second%hh
  end function product_of

  !> A function times a number.
  pure function scaled(jet, factor) result(product)
    type(jet_type), intent(in) :: jet
    real(wp), intent(in) :: factor
    type(jet_type) :: product

    product = jet_type(factor*jet%f, factor*jet%p, factor*jet%h, factor*jet%pp, factor*jet%ph, &
                       factor*jet%hh)
  end function scaled

  !> Drag of the film on the shaft's surface, Couette and pressure parts.
  !>
  !> $$ D = \int \Bigl( \frac{2 \mu U}{h + 2 \lambda} (1 + a Re^b)
  !>      + \frac{h}{2} \frac{\partial p}{\partial x} \Bigr) \frac{r}{R} \, d\Omega $$
  !>
  !> The factor with the Reynolds number only with turbulence.
  pure function general_friction(geometry, flow, law, pressure, gap, excess, factors) result(drag)
    type(film_geometry_type), intent(in) :: geometry !! of the element
    type(film_flow_type), intent(in) :: flow         !! speed of the film
    type(gas_law_type), intent(in) :: law !! of the gas
    real(wp), intent(in) :: pressure(:) !! at the nodes [Pa]
    real(wp), intent(in) :: gap(:)      !! at the nodes [m]
    real(wp), intent(in) :: excess(:)   !! of the gap at the Gauss points over the nodes' [m]
    type(gas_factors_type), intent(in), optional :: factors(:) !! of other temperatures there
    real(wp) :: drag                    !! [N]
    real(wp) :: shapes(size(gap), size(gap)), shear(3), h
    integer :: i

    shapes = film_shapes(size(gap))
    drag = 0.0_wp
    do i = 1, size(gap)
      h = dot_product(shapes(:, i), gap) + excess(i)
      shear = couette_shear(flow_here(flow, geometry%stretch(i)), law, &
                            dot_product(shapes(:, i), pressure), h, factors_at(i, factors))
      drag = drag + geometry%area(i)*geometry%stretch(i)* &
             (shear(1) + 0.5_wp*h*dot_product(geometry%gradient(1, :, i), pressure - pressure(1)))
    end do
  end function general_friction

  !> Derivatives of that drag.
  pure subroutine general_friction_rates(geometry, flow, law, pressure, gap, excess, by_pressure, &
                                         by_gap, factors)
    type(film_geometry_type), intent(in) :: geometry !! of the element
    type(film_flow_type), intent(in) :: flow         !! speed of the film
    type(gas_law_type), intent(in) :: law !! of the gas
    real(wp), intent(in) :: pressure(:) !! at the nodes [Pa]
    real(wp), intent(in) :: gap(:)      !! at the nodes [m]
    real(wp), intent(in) :: excess(:)   !! of the gap at the Gauss points over the nodes' [m]
    real(wp), intent(out) :: by_pressure(:), by_gap(:) !! one a node [N/Pa], [N/m]
    type(gas_factors_type), intent(in), optional :: factors(:) !! of other temperatures there
    real(wp) :: shapes(size(gap), size(gap)), shear(3), h
    integer :: i

    shapes = film_shapes(size(gap))
    by_pressure = 0.0_wp
    by_gap = 0.0_wp
    do i = 1, size(gap)
      associate (shape => shapes(:, i), along => geometry%gradient(1, :, i), &
                 area => geometry%area(i)*geometry%stretch(i))
        h = dot_product(shape, gap) + excess(i)
        shear = couette_shear(flow_here(flow, geometry%stretch(i)), law, &
                              dot_product(shape, pressure), h, factors_at(i, factors))
        by_pressure = by_pressure + area*(shear(2)*shape + 0.5_wp*h*along)
        by_gap = by_gap + area*(shear(3) + 0.5_wp*dot_product(along, pressure - pressure(1)))*shape
      end associate
    end do
  end subroutine general_friction_rates

  !> Shear stress of the entrained flow, and its derivatives by pressure and gap.
  !>
  !> $$ \tau = \frac{2 \mu U}{h + 2 \lambda_a p_a/p} (1 + a Re^b) $$
  pure function couette_shear(flow, law, pressure, gap, factors) result(shear)
    type(film_flow_type), intent(in) :: flow
    type(gas_law_type), intent(in) :: law
    real(wp), intent(in) :: pressure, gap !! [Pa], [m]
    type(gas_factors_type), intent(in) :: factors !! of another temperature
    real(wp) :: shear(3)                  !! [Pa], [1], [Pa/m]
    type(gas_state_type) :: gas
    real(wp) :: slip, laminar, added

    gas = changed(gas_state(law, pressure), factors)
    slip = 2.0_wp*law%mean_free_path*factors%mean_free_path*law%ambient_pressure/pressure
    laminar = 2.0_wp*gas%mu*flow%entraining_speed/(gap + slip)
    added = 0.0_wp
    if (law%turbulent) then
      added = laminar*shear_factor(1)*reynolds_number(flow, law, gas, gap)**shear_factor(2)
    end if
    associate (thicker => gas%mu_p/gas%mu, denser => gas%r_p/gas%r)
      shear(1) = laminar + added
      shear(2) = shear(1)*(thicker + slip/(pressure*(gap + slip))) &
        + added*shear_factor(2)*(denser - thicker)
      shear(3) = added*shear_factor(2)/gap - shear(1)/(gap + slip)
    end associate
  end function couette_shear
end module gfb_general_film
