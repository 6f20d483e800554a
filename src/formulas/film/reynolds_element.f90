!> Element of the steady, isothermal, ideal-gas film, with four nodes or nine.
!>
!> Pressure and foil deflection are bilinear, or biquadratic. The rigid gap is taken where it is, at
!> the Gauss points: the nodal gaps give the bilinear part, `excess` what the rigid gap has beyond
!> it. That halves the error of the force against a gap that is bilinear as a whole.
module gfb_reynolds_element
  use gfb_kinds, only: wp
  use gfb_film_geometry, only: film_geometry_type, film_shape, film_nodes, biquadratic_shape, &
                               biquadratic_nodes
  use gfb_film_flow, only: film_flow_type, flow_here
  use gfb_upwind_weight, only: cell_peclet, upwind_weight, upwind_weight_derivative
  implicit none (type, external)
  private
  public :: reynolds_residual, reynolds_jacobian

  !> Pressure, gap and their gradients at one Gauss point.
  type :: film_state_type
    real(wp) :: p, p_x, p_z !! pressure and its gradient [Pa], [Pa/m]
    real(wp) :: h, h_x, h_z !! gap and its gradient [m], [1]
  end type film_state_type

contains

  !> Residual of the compressible Reynolds equation on one element.
  !>
  !> $$ r_a = \int_{\Omega^e} \Bigl[ \nabla N_a \cdot \Bigl( \frac{p h^3}{12 \mu} \nabla p
  !>      - p h \mathbf{U} \Bigr) - N_a s + \frac{\alpha \ell}{2} \frac{\partial N_a}{\partial x} R
  !>      \Bigr] d\Omega, \quad
  !>    R = \nabla \cdot (p h \mathbf{U}) - \nabla \cdot \frac{p h^3}{12 \mu} \nabla p - s $$
  !>
  !> Source: [Gu2020] eq. 15, whose edge term is absent because the pressure is given on every edge;
  !> the last term (SUPG, streamline upwind Petrov-Galerkin, \( \alpha = \coth Pe - 1/Pe \)) only
  !> with `flow%upwind`. It is for bilinear elements: the second derivatives of the pressure in R
  !> vanish on parallelograms there, not so in biquadratic ones.
  pure subroutine reynolds_residual(geometry, flow, pressure, gap, excess, source, residual)
    type(film_geometry_type), intent(in) :: geometry !! the element at its points
    type(film_flow_type), intent(in) :: flow !! viscosity, speed and weighting of the film
    real(wp), contiguous, intent(in) :: pressure(:)  !! absolute pressure at the nodes [Pa]
    real(wp), contiguous, intent(in) :: gap(:)       !! film thickness at the nodes [m]
    real(wp), contiguous, intent(in) :: excess(:)    !! of the gap at the points over the nodes' [m]
    real(wp), contiguous, intent(in) :: source(:)    !! s, gas fed in (p h per time) [Pa m/s]
    real(wp), contiguous, intent(out) :: residual(:) !! one a node [Pa m3/s]

    if (size(residual) == film_nodes) then
      call sum_residual(film_nodes, film_shape, geometry%gradient, geometry%area, &
                        geometry%stream_length, geometry%stretch, flow, pressure, gap, excess, &
                        source, residual)
    else
      call sum_residual(biquadratic_nodes, biquadratic_shape, geometry%gradient, geometry%area, &
                        geometry%stream_length, geometry%stretch, flow, pressure, gap, excess, &
                        source, residual)
    end if
  end subroutine reynolds_residual

  !> The residual's sum over the Gauss points, of which there are as many as nodes.
  pure subroutine sum_residual(nodes, shapes, gradients, area, stream_length, stretch, flow, &
                               pressure, gap, excess, source, residual)
    integer, value :: nodes !! a value: the compiler makes a copy of the loops for each
    real(wp), intent(in) :: shapes(nodes, nodes)       !! shape functions (node, point) [1]
    real(wp), intent(in) :: gradients(2, nodes, nodes) !! their gradients (2, node, point) [1/m]
    real(wp), intent(in) :: area(nodes)                !! of the points [m2]
    real(wp), intent(in) :: stream_length(nodes)       !! distance of the nodes along x [m]
    real(wp), intent(in) :: stretch(nodes)             !! see `gfb_film_surface` [1]
    type(film_flow_type), intent(in) :: flow
    real(wp), intent(in) :: pressure(nodes), gap(nodes) !! at the nodes [Pa], [m]
    real(wp), intent(in) :: excess(nodes)               !! at the points [m]
    real(wp), intent(in) :: source(nodes)               !! at the nodes [Pa m/s]
    real(wp), intent(out) :: residual(nodes)            !! [Pa m3/s]

    type(film_flow_type) :: here
    type(film_state_type) :: state
    real(wp) :: mobility, flux_x, flux_z, fed
    integer :: point

    residual = 0.0_wp
    do point = 1, nodes
      associate (shape => shapes(:, point), gradient => gradients(:, :, point))
        state = film_state(shape, gradient, pressure, gap, excess(point))
        fed = dot_product(shape, source)
        mobility = state%p*state%h**3/(12.0_wp*flow%viscosity)
        flux_x = mobility*state%p_x - state%p*state%h*(stretch(point)*flow%entraining_speed)
        flux_z = mobility*state%p_z
        if (flow%upwind) then
          here = flow_here(flow, stretch(point))
          flux_x = flux_x + 0.5_wp*stream_length(point)* &
            upwind_weight(cell_peclet(here, stream_length(point), state%p, state%h))* &
            (strong_residual(here, state) - fed)
        end if
        residual = residual + area(point)* &
          (flux_x*gradient(1, :) + flux_z*gradient(2, :) - fed*shape)
      end associate
    end do
  end subroutine sum_residual

  !> Exact derivatives of `reynolds_residual` by the nodal pressures and gaps, and by the excess.
  pure subroutine reynolds_jacobian(geometry, flow, pressure, gap, excess, source, by_pressure, &
                                    by_gap, by_excess)
    type(film_geometry_type), intent(in) :: geometry !! the element at its points
    type(film_flow_type), intent(in) :: flow !! viscosity, speed and weighting of the film
    real(wp), contiguous, intent(in) :: pressure(:) !! absolute pressure at the nodes [Pa]
    real(wp), contiguous, intent(in) :: gap(:)      !! film thickness at the nodes [m]
    real(wp), contiguous, intent(in) :: excess(:)   !! of the gap at the points over the nodes' [m]
    real(wp), contiguous, intent(in) :: source(:)   !! s, gas fed in (p h per time) [Pa m/s]
    real(wp), contiguous, intent(out) :: by_pressure(:, :) !! (nodes, nodes) dr_a/dp_b [m3/s]
    real(wp), contiguous, intent(out) :: by_gap(:, :)      !! (nodes, nodes) dr_a/dh_b [Pa m2/s]
    real(wp), contiguous, intent(out) :: by_excess(:, :)   !! (nodes, points) [Pa m2/s]

    if (size(pressure) == film_nodes) then
      call sum_jacobian(film_nodes, film_shape, geometry%gradient, geometry%area, &
                        geometry%stream_length, geometry%stretch, flow, pressure, gap, excess, &
                        source, by_pressure, by_gap, by_excess)
    else
      call sum_jacobian(biquadratic_nodes, biquadratic_shape, geometry%gradient, geometry%area, &
                        geometry%stream_length, geometry%stretch, flow, pressure, gap, excess, &
                        source, by_pressure, by_gap, by_excess)
    end if
  end subroutine reynolds_jacobian

  !> The derivatives' sums over the Gauss points, of which there are as many as nodes.
  pure subroutine sum_jacobian(nodes, shapes, gradients, areas, stream_length, stretch, flow, &
                               pressure, gap, excess, source, by_pressure, by_gap, by_excess)
    integer, value :: nodes !! a value: the compiler makes a copy of the loops for each
    real(wp), intent(in) :: shapes(nodes, nodes)       !! shape functions (node, point) [1]
    real(wp), intent(in) :: gradients(2, nodes, nodes) !! their gradients (2, node, point) [1/m]
    real(wp), intent(in) :: areas(nodes)               !! of the points [m2]
    real(wp), intent(in) :: stream_length(nodes)       !! distance of the nodes along x [m]
    real(wp), intent(in) :: stretch(nodes)             !! see `gfb_film_surface` [1]
    type(film_flow_type), intent(in) :: flow
    real(wp), intent(in) :: pressure(nodes), gap(nodes) !! at the nodes [Pa], [m]
    real(wp), intent(in) :: excess(nodes)               !! at the points [m]
    real(wp), intent(in) :: source(nodes)               !! at the nodes [Pa m/s]
    real(wp), intent(out) :: by_pressure(nodes, nodes)  !! [m3/s]
    real(wp), intent(out) :: by_gap(nodes, nodes), by_excess(nodes, nodes)       !! [Pa m2/s]

    type(film_state_type) :: state
    real(wp), dimension(nodes) :: x_by_p, z_by_p, x_by_slope
    real(wp) :: mobility, speed, x_by_h, z_by_h
    integer :: point, b

    by_pressure = 0.0_wp
    by_gap = 0.0_wp
    do point = 1, nodes
      associate (shape => shapes(:, point), gradient => gradients(:, :, point), &
                 area => areas(point))
        speed = stretch(point)*flow%entraining_speed
        state = film_state(shape, gradient, pressure, gap, excess(point))
        mobility = state%p*state%h**3/(12.0_wp*flow%viscosity)
        x_by_p = shape*(mobility/state%p*state%p_x - state%h*speed) + mobility*gradient(1, :)
        z_by_p = shape*mobility/state%p*state%p_z + mobility*gradient(2, :)
        x_by_h = 3.0_wp*mobility/state%h*state%p_x - state%p*speed
        z_by_h = 3.0_wp*mobility/state%h*state%p_z
        x_by_slope = 0.0_wp
        if (flow%upwind) then
          call add_upwind_derivatives(flow_here(flow, stretch(point)), stream_length(point), &
                                      shape, gradient, state, dot_product(shape, source), &
                                      x_by_p, x_by_h, x_by_slope)
        end if
        by_excess(:, point) = area*(x_by_h*gradient(1, :) + z_by_h*gradient(2, :))
        do b = 1, nodes
          by_pressure(:, b) = by_pressure(:, b) &
            + area*(x_by_p(b)*gradient(1, :) + z_by_p(b)*gradient(2, :))
          by_gap(:, b) = by_gap(:, b) + shape(b)*by_excess(:, point) &
            + area*x_by_slope(b)*gradient(1, :)
        end do
      end associate
    end do
  end subroutine sum_jacobian

  !> Adds the derivatives of the upwind term's flux along x: by nodal pressures, by the gap at the
  !> point, and by the nodal gaps through the gap's slope.
  pure subroutine add_upwind_derivatives(flow, stream_length, shape, gradient, state, fed, &
                                         x_by_p, x_by_h, x_by_slope)
    type(film_flow_type), intent(in) :: flow
    real(wp), intent(in) :: stream_length  !! the element's length along x [m]
    real(wp), intent(in) :: shape(:)       !! shape functions [1]
    real(wp), intent(in) :: gradient(:, :) !! (2, nodes) their gradients [1/m]
    type(film_state_type), intent(in) :: state
    real(wp), intent(in) :: fed                !! source at the point [Pa m/s]
    real(wp), intent(inout) :: x_by_p(:)       !! flux along x by nodal pressure
    real(wp), intent(inout) :: x_by_h          !! flux along x by the gap
    real(wp), intent(inout) :: x_by_slope(:)   !! flux along x by nodal gap, slope alone

    real(wp), dimension(size(shape)) :: strong_by_p, along_p, along_h
    real(wp) :: peclet, weight, slope, strong, strong_by_h, slope_p, cross, twelfth

    peclet = cell_peclet(flow, stream_length, state%p, state%h)
    weight = 0.5_wp*stream_length*upwind_weight(peclet)
    slope = 0.5_wp*stream_length*upwind_weight_derivative(peclet)
    strong = strong_residual(flow, state) - fed
    slope_p = state%p_x**2 + state%p_z**2
    cross = state%h_x*state%p_x + state%h_z*state%p_z
    along_p = state%p_x*gradient(1, :) + state%p_z*gradient(2, :)
    along_h = state%h_x*gradient(1, :) + state%h_z*gradient(2, :)
    twelfth = 1.0_wp/(12.0_wp*flow%viscosity)
    strong_by_p = flow%entraining_speed*(state%h*gradient(1, :) + shape*state%h_x) &
      - twelfth*(2.0_wp*state%h**3*along_p &
                 + 3.0_wp*state%h**2*(shape*cross + state%p*along_h))
    strong_by_h = flow%entraining_speed*state%p_x &
      - twelfth*(3.0_wp*state%h**2*slope_p + 6.0_wp*state%p*state%h*cross)
    x_by_p = x_by_p + weight*strong_by_p - slope*strong*peclet/state%p*shape
    x_by_h = x_by_h + weight*strong_by_h - slope*strong*2.0_wp*peclet/state%h
    x_by_slope = x_by_slope + weight*(flow%entraining_speed*state%p*gradient(1, :) &
                                      - twelfth*3.0_wp*state%p*state%h**2*along_p)
  end subroutine add_upwind_derivatives

  !> Divergence form of the equation at a point, without source and second derivatives [Pa m/s].
  pure real(wp) function strong_residual(flow, state) result(strong)
    type(film_flow_type), intent(in) :: flow
    type(film_state_type), intent(in) :: state

    strong = flow%entraining_speed*(state%h*state%p_x + state%p*state%h_x) &
      - (state%h**3*(state%p_x**2 + state%p_z**2) + 3.0_wp*state%p*state%h**2* &
         (state%h_x*state%p_x + state%h_z*state%p_z))/(12.0_wp*flow%viscosity)
  end function strong_residual

  !> Pressure, gap and their gradients at a Gauss point.
  pure function film_state(shape, gradient, pressure, gap, excess) result(state)
    real(wp), intent(in) :: shape(:)       !! shape functions [1]
    real(wp), intent(in) :: gradient(:, :) !! (2, nodes) their gradients [1/m]
    real(wp), intent(in) :: pressure(:)    !! at the nodes [Pa]
    real(wp), intent(in) :: gap(:)         !! at the nodes [m]
    real(wp), intent(in) :: excess         !! of the gap over what its nodal values give [m]
    type(film_state_type) :: state

    state%p = dot_product(shape, pressure)
    state%h = dot_product(shape, gap) + excess
    ! Less one node's pressure: an even pressure has no gradient to the last digit.
    state%p_x = dot_product(gradient(1, :), pressure - pressure(1))
    state%p_z = dot_product(gradient(2, :), pressure - pressure(1))
    state%h_x = dot_product(gradient(1, :), gap)
    state%h_z = dot_product(gradient(2, :), gap)
  end function film_state
end module gfb_reynolds_element
