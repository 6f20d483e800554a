!> What a porous wall feeds into a film element.
!>
!> $$ r_a = -\int_{\Omega^e} w_a \, s(p) \, d\Omega, \quad
!>    w_a = N_a + \frac{\alpha \ell}{2} \frac{\partial N_a}{\partial x} $$
!>
!> with the source s of `gfb_feed_law`, and the weights of `gfb_squeeze_term`: with upwinding (SUPG)
!> the source is weighted as the rest of the strong residual.
module gfb_wall_film
  use gfb_kinds, only: wp
  use gfb_feed_law, only: porous_wall_type, wall_source
  use gfb_film_flow, only: film_flow_type, flow_here
  use gfb_film_geometry, only: film_geometry_type, film_shapes
  use gfb_gas_law, only: gas_law_type, gas_factors_type
  use gfb_general_film, only: peclet_slopes, factors_at
  use gfb_squeeze_term, only: squeeze_weights
  use gfb_upwind_weight, only: upwind_weight_derivative
  implicit none (type, external)
  private
  public :: wall_residual, wall_jacobian, wall_shares

contains

  !> What a wall adds to an element's residual.
  pure function wall_residual(geometry, flow, law, wall, pressure, gap, excess, factors) &
    result(residual)
    type(film_geometry_type), intent(in) :: geometry !! the element at its points
    type(film_flow_type), intent(in) :: flow !! viscosity, speed and weighting of the film
    type(gas_law_type), intent(in) :: law    !! of the gas
    type(porous_wall_type), intent(in) :: wall !! behind the element
    real(wp), intent(in) :: pressure(:) !! absolute pressure at the nodes [Pa]
    real(wp), intent(in) :: gap(:)      !! film thickness at the nodes [m]
    real(wp), intent(in) :: excess(:)   !! of the gap at the points over the nodes' [m]
    type(gas_factors_type), intent(in), optional :: factors(:) !! of other temperatures there
    real(wp) :: residual(size(pressure)) !! one a node [Pa m3/s]
    real(wp) :: weight(size(pressure), size(pressure)), source, rate
    real(wp) :: shapes(size(pressure), size(pressure))
    integer :: i

    shapes = film_shapes(size(pressure))
    weight = squeeze_weights(geometry, flow, law, pressure, gap, excess, factors)
    residual = 0.0_wp
    do i = 1, size(excess)
      call wall_source(wall, law, dot_product(shapes(:, i), pressure), source, rate)
      residual = residual - geometry%area(i)*source*weight(:, i)
    end do
  end function wall_residual

  !> Its exact derivatives by the nodal pressures and gaps, and by the excess, added to others.
  pure subroutine wall_jacobian(geometry, flow, law, wall, pressure, gap, excess, by_pressure, &
                                by_gap, by_excess, factors)
    type(film_geometry_type), intent(in) :: geometry !! the element at its points
    type(film_flow_type), intent(in) :: flow !! viscosity, speed and weighting of the film
    type(gas_law_type), intent(in) :: law    !! of the gas
    type(porous_wall_type), intent(in) :: wall !! behind the element
    real(wp), intent(in) :: pressure(:) !! absolute pressure at the nodes [Pa]
    real(wp), intent(in) :: gap(:)      !! film thickness at the nodes [m]
    real(wp), intent(in) :: excess(:)   !! of the gap at the points over the nodes' [m]
    real(wp), intent(inout) :: by_pressure(:, :) !! (nodes, nodes) dr_a/dp_b [m3/s]
    real(wp), intent(inout) :: by_gap(:, :)      !! (nodes, nodes) dr_a/dh_b [Pa m2/s]
    real(wp), intent(inout) :: by_excess(:, :)   !! (nodes, points) [Pa m2/s]
    type(gas_factors_type), intent(in), optional :: factors(:) !! of other temperatures there
    real(wp), dimension(size(pressure), size(pressure)) :: shapes, weight
    real(wp) :: source, rate, slopes(3), bend(size(pressure))
    integer :: i, b

    shapes = film_shapes(size(pressure))
    weight = squeeze_weights(geometry, flow, law, pressure, gap, excess, factors)
    do i = 1, size(excess)
      associate (shape => shapes(:, i), area => geometry%area(i), &
                 length => geometry%stream_length(i))
        call wall_source(wall, law, dot_product(shape, pressure), source, rate)
        do b = 1, size(shape)
          by_pressure(:, b) = by_pressure(:, b) - area*rate*shape(b)*weight(:, i)
        end do
        if (.not. flow%upwind) cycle
        slopes = peclet_slopes(law, flow_here(flow, geometry%stretch(i)), length, &
                               dot_product(shape, pressure), dot_product(shape, gap) + excess(i), &
                               factors_at(i, factors))
        bend = -area*source*0.5_wp*length*upwind_weight_derivative(slopes(1))* &
          geometry%gradient(1, :, i)
        by_excess(:, i) = by_excess(:, i) + slopes(3)*bend
        do b = 1, size(shape)
          by_pressure(:, b) = by_pressure(:, b) + slopes(2)*shape(b)*bend
          by_gap(:, b) = by_gap(:, b) + slopes(3)*shape(b)*bend
        end do
      end associate
    end do
  end subroutine wall_jacobian

  !> What a wall feeds into an element, by its nodes [Pa m3/s].
  pure function wall_shares(geometry, law, wall, pressure) result(share)
    type(film_geometry_type), intent(in) :: geometry !! the element at its points
    type(gas_law_type), intent(in) :: law      !! of the gas
    type(porous_wall_type), intent(in) :: wall !! behind it
    real(wp), intent(in) :: pressure(:) !! absolute pressure at the nodes [Pa]
    real(wp) :: share(size(pressure)) !! without upwinding's part, which adds up to nothing
    real(wp) :: source, rate, shapes(size(pressure), size(pressure))
    integer :: i

    shapes = film_shapes(size(pressure))
    share = 0.0_wp
    do i = 1, size(shapes, 2)
      call wall_source(wall, law, dot_product(shapes(:, i), pressure), source, rate)
      share = share + geometry%area(i)*source*shapes(:, i)
    end do
  end function wall_shares
end module gfb_wall_film
