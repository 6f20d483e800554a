!> Force, torque and friction of one film element.
module gfb_film_load
  use gfb_kinds, only: wp
  use gfb_film_geometry, only: film_geometry_type, film_shapes
  use gfb_film_flow, only: film_flow_type, flow_here
  use gfb_film_surface, only: shaft_coordinates
  implicit none (type, external)
  private
  public :: film_force_weights, film_force, film_friction, film_friction_rates

  integer, parameter, public :: film_forces = shaft_coordinates !! F_x, F_y, F_z, M_x, M_y
  !> F_x and F_y act on the sleeve, as the shaft's coordinates are the sleeve's; the others on the
  !> shaft.
  real(wp), parameter, public :: acts_on(film_forces) = [1.0_wp, 1.0_wp, -1.0_wp, -1.0_wp, -1.0_wp]

contains

  !> Weights of the nodal pressures in the film's force and torque.
  !>
  !> $$ F = \int (p - p_a) \begin{bmatrix} \cos\theta \\ \sin\theta \end{bmatrix} d\Omega, \quad
  !>    M = \int (p - p_a) z \begin{bmatrix} \sin\theta \\ -\cos\theta \end{bmatrix} d\Omega $$
  !>
  !> Source: [Gu2020] eqs. 14 and 16. The force acts on the sleeve, the torque on the shaft. They
  !> are the work conjugates of the shaft's coordinates: \( \int (p - p_a) b \, d\Omega \).
  pure subroutine film_force_weights(geometry, motion, weight)
    type(film_geometry_type), intent(in) :: geometry !! of the element
    real(wp), intent(in) :: motion(:, :)  !! (5, points) the shaft's, see `point_motions` [1], [m]
    real(wp), intent(out) :: weight(:, :) !! (5, nodes) of p - p_a [m2], [m3]
    real(wp) :: shapes(size(motion, 2), size(motion, 2))
    integer :: point

    shapes = film_shapes(size(motion, 2))
    weight = 0.0_wp
    do point = 1, size(geometry%area)
      associate (shape => shapes(:, point))
        weight = weight + geometry%area(point)*outer(acts_on*motion(:, point), shape)
      end associate
    end do
  end subroutine film_force_weights

  !> The element's share of force and torque where the pressure is above ambient only.
  pure function film_force(geometry, motion, overpressure) result(force)
    type(film_geometry_type), intent(in) :: geometry !! of the element
    real(wp), intent(in) :: motion(:, :)    !! (5, points) the shaft's, see `point_motions` [1], [m]
    real(wp), intent(in) :: overpressure(:) !! p - p_a at the nodes [Pa]
    real(wp) :: force(film_forces)          !! F_x, F_y, F_z [N], M_x, M_y [N m]
    real(wp) :: shapes(size(overpressure), size(overpressure))
    integer :: point

    shapes = film_shapes(size(overpressure))
    force = 0.0_wp
    do point = 1, size(geometry%area)
      associate (shape => shapes(:, point))
        force = force + geometry%area(point)*max(dot_product(shape, overpressure), 0.0_wp)* &
                (acts_on*motion(:, point))
      end associate
    end do
  end function film_force

  !> Drag of the film on the shaft's surface, Couette and pressure parts.
  !>
  !> $$ D = \int \Bigl( \frac{2 \mu U}{h} + \frac{h}{2} \frac{\partial p}{\partial x} \Bigr)
  !> \frac{r}{R} \, d\Omega $$
  !>
  !> It is the shear at \( y = h \) of the velocity between a resting surface and one that moves
  !> with \( 2 U \); positive against the motion. D R is the torque, so what acts at another radius
  !> than R counts by its stretch r/R.
  pure function film_friction(geometry, flow, pressure, gap, excess) result(drag)
    type(film_geometry_type), intent(in) :: geometry !! of the element
    type(film_flow_type), intent(in) :: flow         !! of the gas
    real(wp), intent(in) :: pressure(:) !! at the nodes [Pa]
    real(wp), intent(in) :: gap(:)      !! at the nodes [m]
    real(wp), intent(in) :: excess(:)   !! of the gap at the Gauss points over the nodes' [m]
    real(wp) :: drag                    !! [N]
    type(film_flow_type) :: here
    real(wp) :: h, shapes(size(gap), size(gap))
    integer :: point

    shapes = film_shapes(size(gap))
    drag = 0.0_wp
    ! Less one node's pressure, so that an even pressure has no gradient to the last digit.
    do point = 1, size(geometry%area)
      h = dot_product(shapes(:, point), gap) + excess(point)
      here = flow_here(flow, geometry%stretch(point))
      drag = drag + geometry%area(point)*geometry%stretch(point)* &
             (2.0_wp*here%viscosity*here%entraining_speed/h &
              + 0.5_wp*h*dot_product(geometry%gradient(1, :, point), pressure - pressure(1)))
    end do
  end function film_friction

  !> Derivatives of that drag.
  pure subroutine film_friction_rates(geometry, flow, pressure, gap, excess, by_pressure, by_gap)
    type(film_geometry_type), intent(in) :: geometry !! of the element
    type(film_flow_type), intent(in) :: flow         !! of the gas
    real(wp), intent(in) :: pressure(:) !! at the nodes [Pa]
    real(wp), intent(in) :: gap(:)      !! at the nodes [m]
    real(wp), intent(in) :: excess(:)   !! of the gap at the Gauss points over the nodes' [m]
    real(wp), intent(out) :: by_pressure(:), by_gap(:) !! one a node [N/Pa], [N/m]
    type(film_flow_type) :: here
    real(wp) :: h, shapes(size(gap), size(gap))
    integer :: point

    shapes = film_shapes(size(gap))
    by_pressure = 0.0_wp
    by_gap = 0.0_wp
    do point = 1, size(geometry%area)
      associate (shape => shapes(:, point), along => geometry%gradient(1, :, point), &
                 area => geometry%area(point)*geometry%stretch(point))
        here = flow_here(flow, geometry%stretch(point))
        h = dot_product(shape, gap) + excess(point)
        by_pressure = by_pressure + 0.5_wp*area*h*along
        by_gap = by_gap + area*(0.5_wp*dot_product(along, pressure - pressure(1)) &
                                - 2.0_wp*here%viscosity*here%entraining_speed/h**2)*shape
      end associate
    end do
  end subroutine film_friction_rates

  !> Outer product of two vectors.
  pure function outer(first, second) result(product)
    real(wp), intent(in) :: first(:), second(:)
    real(wp) :: product(size(first), size(second))
    integer :: i

    do i = 1, size(second)
      product(:, i) = first*second(i)
    end do
  end function outer
end module gfb_film_load
