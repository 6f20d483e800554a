!> The gas that a film element holds, whose rate the steady Reynolds equation leaves out.
!>
!> In time the element's equation is \( r_a(p, h) + dq_a/dt = 0 \), with the residual \( r_a \) of
!> `gfb_reynolds_element` and
!>
!> $$ q_a = \int_{\Omega^e} w_a \, r h \, d\Omega, \quad
!>    w_a = N_a + \frac{\alpha \ell}{2} \frac{\partial N_a}{\partial x}, $$
!>
!> with the density r of `gfb_gas_law`, which is p where the gas is ideal;
!> the second part of \( w_a \) with upwinding (SUPG) only: it weights the rate as it weights the
!> rest of the strong residual, or both were not consistent. About a steady state the weights are
!> that state's, because the rate that their own change would weight is zero there.
!>
!> Over a step of time the rate is a difference of products, \( \frac{d}{dt}(r h) \approx
!> a_0 \, r h + \) what earlier products add (`gfb_backward_difference`): the gas is then kept to
!> round-off, because the weights of an element add up to one.
module gfb_squeeze_term
  use gfb_kinds, only: wp
  use gfb_film_geometry, only: film_geometry_type, film_shapes, film_shape, film_nodes, &
                               biquadratic_shape, biquadratic_nodes
  use gfb_gas_law, only: gas_law_type, gas_factors_type, gas_density
  use gfb_general_film, only: general_peclet, peclet_slopes, factors_at
  use gfb_film_flow, only: film_flow_type, flow_here
  use gfb_upwind_weight, only: upwind_weight, upwind_weight_derivative
  implicit none (type, external)
  private
  public :: squeeze_weights, squeeze_jacobian, stored_gas, storage_residual, storage_jacobian

contains

  !> The weights at the Gauss points of a steady state, of which there are as many as nodes.
  pure function squeeze_weights(geometry, flow, law, pressure, gap, excess, factors) result(weight)
    type(film_geometry_type), intent(in) :: geometry !! the element at its points
    type(film_flow_type), intent(in) :: flow !! viscosity, speed and weighting of the film
    type(gas_law_type), intent(in) :: law !! of the gas
    real(wp), intent(in) :: pressure(:) !! absolute pressure at the nodes [Pa]
    real(wp), intent(in) :: gap(:)      !! film thickness at the nodes [m]
    real(wp), intent(in) :: excess(:)   !! of the gap at the points over the nodes' [m]
    type(gas_factors_type), intent(in), optional :: factors(:) !! of other temperatures there
    real(wp) :: weight(size(pressure), size(pressure)) !! (nodes, points) [1]
    real(wp) :: shapes(size(pressure), size(pressure)), peclet
    integer :: point

    shapes = film_shapes(size(pressure))
    weight = shapes
    if (.not. flow%upwind) return
    do point = 1, size(excess)
      associate (shape => shapes(:, point), length => geometry%stream_length(point))
        peclet = general_peclet(law, flow_here(flow, geometry%stretch(point)), length, &
                                dot_product(shape, pressure), &
                                dot_product(shape, gap) + excess(point), factors_at(point, factors))
        weight(:, point) = shape &
          + 0.5_wp*length*upwind_weight(peclet)*geometry%gradient(1, :, point)
      end associate
    end do
  end function squeeze_weights

  !> Exact derivatives of the content q with given weights, by nodal pressures and gaps, and by the
  !> excess.
  pure subroutine squeeze_jacobian(geometry, law, weight, pressure, gap, excess, by_pressure, &
                                   by_gap, by_excess, factors)
    type(film_geometry_type), intent(in) :: geometry !! the element at its points
    type(gas_law_type), intent(in) :: law !! of the gas
    real(wp), intent(in) :: weight(:, :) !! (nodes, points), see `squeeze_weights` [1]
    real(wp), intent(in) :: pressure(:)  !! absolute pressure at the nodes [Pa]
    real(wp), intent(in) :: gap(:)       !! film thickness at the nodes [m]
    real(wp), intent(in) :: excess(:)    !! of the gap at the points over the nodes' [m]
    real(wp), intent(out) :: by_pressure(:, :) !! (nodes, nodes) dq_a/dp_b [m3]
    real(wp), intent(out) :: by_gap(:, :)      !! (nodes, nodes) dq_a/dh_b [Pa m2]
    real(wp), intent(out) :: by_excess(:, :)   !! (nodes, points) [Pa m2]
    type(gas_factors_type), intent(in), optional :: factors(:) !! of other temperatures there
    real(wp) :: shapes(size(pressure), size(pressure)), h, r, r_p
    integer :: point, b

    shapes = film_shapes(size(pressure))
    by_pressure = 0.0_wp
    by_gap = 0.0_wp
    do point = 1, size(excess)
      associate (shape => shapes(:, point), held => geometry%area(point)*weight(:, point))
        h = dot_product(shape, gap) + excess(point)
        call density_at(law, dot_product(shape, pressure), factors_at(point, factors), r, r_p)
        by_excess(:, point) = r*held
        do b = 1, size(shape)
          by_pressure(:, b) = by_pressure(:, b) + r_p*h*shape(b)*held
          by_gap(:, b) = by_gap(:, b) + shape(b)*by_excess(:, point)
        end do
      end associate
    end do
  end subroutine squeeze_jacobian

  !> The product r h at the Gauss points.
  pure function stored_gas(law, pressure, gap, excess, factors) result(stored)
    type(gas_law_type), intent(in) :: law !! of the gas
    real(wp), intent(in) :: pressure(:) !! absolute pressure at the nodes [Pa]
    real(wp), intent(in) :: gap(:)      !! film thickness at the nodes [m]
    real(wp), intent(in) :: excess(:)   !! of the gap at the points over the nodes' [m]
    type(gas_factors_type), intent(in), optional :: factors(:) !! of other temperatures there
    real(wp) :: stored(size(pressure))  !! (points) [Pa m]
    real(wp) :: shapes(size(pressure), size(pressure)), r, r_p
    integer :: point

    shapes = film_shapes(size(pressure))
    do point = 1, size(stored)
      associate (shape => shapes(:, point))
        call density_at(law, dot_product(shape, pressure), factors_at(point, factors), r, r_p)
        stored(point) = r*(dot_product(shape, gap) + excess(point))
      end associate
    end do
  end function stored_gas

  !> What a step of time adds to an element's residual.
  !>
  !> $$ r_a = \int_{\Omega^e} w_a \, (a_0 \, r h + s) \, d\Omega $$
  pure function storage_residual(geometry, flow, law, pressure, gap, excess, factor, past, &
                                 factors) result(residual)
    type(film_geometry_type), intent(in) :: geometry !! the element at its points
    type(film_flow_type), intent(in) :: flow !! viscosity, speed and weighting of the film
    type(gas_law_type), intent(in) :: law !! of the gas
    real(wp), contiguous, intent(in) :: pressure(:)  !! absolute pressure at the nodes [Pa]
    real(wp), contiguous, intent(in) :: gap(:)       !! film thickness at the nodes [m]
    real(wp), contiguous, intent(in) :: excess(:)    !! of the gap at the points over the nodes' [m]
    real(wp), intent(in) :: factor                   !! a_0 [1/s]
    real(wp), contiguous, intent(in) :: past(:) !! s, what earlier products add (points) [Pa m/s]
    type(gas_factors_type), intent(in), optional :: factors(:) !! of other temperatures
    real(wp) :: residual(size(pressure)) !! one a node [Pa m3/s]
    integer :: i

    if (size(pressure) == film_nodes) then
      call sum_storage(film_nodes, film_shape, geometry%gradient, geometry%area, &
                       geometry%stream_length, geometry%stretch, flow, law, pressure, gap, &
                       excess, factor, past, [(factors_at(i, factors), i=1, film_nodes)], residual)
    else
      call sum_storage(biquadratic_nodes, biquadratic_shape, geometry%gradient, geometry%area, &
                       geometry%stream_length, geometry%stretch, flow, law, pressure, gap, &
                       excess, factor, past, [(factors_at(i, factors), i=1, biquadratic_nodes)], &
                       residual)
    end if
  end function storage_residual

  !> Its sum over the Gauss points, of which there are as many as nodes.
  pure subroutine sum_storage(nodes, shapes, gradients, area, stream_length, stretch, flow, law, &
                              pressure, gap, excess, factor, past, factors, residual)
    integer, value :: nodes !! a value: the compiler makes a copy of the loops for each
    real(wp), intent(in) :: shapes(nodes, nodes)       !! shape functions (node, point) [1]
    real(wp), intent(in) :: gradients(2, nodes, nodes) !! their gradients (2, node, point) [1/m]
    real(wp), intent(in) :: area(nodes)                !! of the points [m2]
    real(wp), intent(in) :: stream_length(nodes)       !! distance of the nodes along x [m]
    real(wp), intent(in) :: stretch(nodes)             !! see `gfb_film_surface` [1]
    type(film_flow_type), intent(in) :: flow
    type(gas_law_type), intent(in) :: law
    real(wp), intent(in) :: pressure(nodes), gap(nodes) !! at the nodes [Pa], [m]
    real(wp), intent(in) :: excess(nodes)               !! at the points [m]
    real(wp), intent(in) :: factor                      !! a_0 [1/s]
    real(wp), intent(in) :: past(nodes)                 !! at the points [Pa m/s]
    type(gas_factors_type), intent(in) :: factors(nodes) !! of other temperatures there
    real(wp), intent(out) :: residual(nodes)            !! [Pa m3/s]
    real(wp) :: p, h, r, r_p, gain, lean
    integer :: point

    residual = 0.0_wp
    do point = 1, nodes
      associate (shape => shapes(:, point), length => stream_length(point))
        p = dot_product(shape, pressure)
        h = dot_product(shape, gap) + excess(point)
        call density_at(law, p, factors(point), r, r_p)
        gain = area(point)*(factor*r*h + past(point))
        residual = residual + gain*shape
        if (flow%upwind) then
          lean = 0.5_wp*length*upwind_weight( &
                 general_peclet(law, flow_here(flow, stretch(point)), length, p, h, factors(point)))
          residual = residual + gain*lean*gradients(1, :, point)
        end if
      end associate
    end do
  end subroutine sum_storage

  !> Adds the exact derivatives of `storage_residual` by the nodal pressures and gaps, and by the
  !> excess; the weights change with the state.
  pure subroutine storage_jacobian(geometry, flow, law, pressure, gap, excess, factor, past, &
                                   by_pressure, by_gap, by_excess, factors)
    type(film_geometry_type), intent(in) :: geometry !! the element at its points
    type(film_flow_type), intent(in) :: flow !! viscosity, speed and weighting of the film
    type(gas_law_type), intent(in) :: law !! of the gas
    real(wp), intent(in) :: pressure(:) !! absolute pressure at the nodes [Pa]
    real(wp), intent(in) :: gap(:)      !! film thickness at the nodes [m]
    real(wp), intent(in) :: excess(:)   !! of the gap at the points over the nodes' [m]
    real(wp), intent(in) :: factor      !! a_0 [1/s]
    real(wp), intent(in) :: past(:)     !! s, what earlier products add (points) [Pa m/s]
    real(wp), intent(inout) :: by_pressure(:, :) !! (nodes, nodes) dr_a/dp_b [m3/s]
    real(wp), intent(inout) :: by_gap(:, :)      !! (nodes, nodes) dr_a/dh_b [Pa m2/s]
    real(wp), intent(inout) :: by_excess(:, :)   !! (nodes, points) [Pa m2/s]
    type(gas_factors_type), intent(in), optional :: factors(:) !! of other temperatures there
    real(wp) :: weight(size(gap), size(gap)), shapes(size(gap), size(gap))
    real(wp), dimension(size(gap), size(gap)) :: more_by_p, more_by_h, more_by_e
    real(wp) :: rate(size(gap)), slope, peclet(3), turned(size(gap))
    integer :: point, b

    weight = squeeze_weights(geometry, flow, law, pressure, gap, excess, factors)
    call squeeze_jacobian(geometry, law, weight, pressure, gap, excess, more_by_p, more_by_h, &
                          more_by_e, factors)
    by_pressure = by_pressure + factor*more_by_p
    by_gap = by_gap + factor*more_by_h
    by_excess = by_excess + factor*more_by_e
    if (.not. flow%upwind) return
    shapes = film_shapes(size(gap))
    rate = factor*stored_gas(law, pressure, gap, excess, factors) + past
    do point = 1, size(gap)
      associate (shape => shapes(:, point), length => geometry%stream_length(point))
        peclet = peclet_slopes(law, flow_here(flow, geometry%stretch(point)), length, &
                               dot_product(shape, pressure), &
                               dot_product(shape, gap) + excess(point), factors_at(point, factors))
        slope = 0.5_wp*length*upwind_weight_derivative(peclet(1))*geometry%area(point)*rate(point)
        turned = slope*geometry%gradient(1, :, point)
        by_excess(:, point) = by_excess(:, point) + peclet(3)*turned
        do b = 1, size(gap)
          by_pressure(:, b) = by_pressure(:, b) + peclet(2)*shape(b)*turned
          by_gap(:, b) = by_gap(:, b) + peclet(3)*shape(b)*turned
        end do
      end associate
    end do
  end subroutine storage_jacobian

  !> The gas' density r and its slope, at a temperature of its own.
  pure subroutine density_at(law, pressure, factors, r, r_p)
    type(gas_law_type), intent(in) :: law
    real(wp), intent(in) :: pressure !! [Pa]
    type(gas_factors_type), intent(in) :: factors
    real(wp), intent(out) :: r, r_p !! [Pa], [1]
    real(wp) :: r_pp

    call gas_density(law, pressure, r, r_p, r_pp)
    r = factors%density*r
    r_p = factors%density*r_p
  end subroutine density_at
end module gfb_squeeze_term
