!> Force, torque and friction of one film element.
module gfb_film_load
  use gfb_kinds, only: wp
  use gfb_film_geometry, only: film_geometry_type, film_shapes
  use gfb_reynolds_element, only: film_flow_type
  implicit none (type, external)
  private
  public :: film_force_weights, film_force, film_friction

  integer, parameter, public :: film_forces = 4 !! F_x, F_y, M_x, M_y

contains

  !> Weights of the nodal pressures in the film's force and torque.
  !>
  !> $$ F = \int (p - p_a) \begin{bmatrix} \cos\theta \\ \sin\theta \end{bmatrix} d\Omega, \quad
  !>    M = \int (p - p_a) z \begin{bmatrix} \sin\theta \\ -\cos\theta \end{bmatrix} d\Omega $$
  !>
  !> Source: [Gu2020] eqs. 14 and 16. The force acts on the sleeve, the torque on the shaft.
  pure subroutine film_force_weights(geometry, angle, axial, weight)
    type(film_geometry_type), intent(in) :: geometry
    real(wp), intent(in) :: angle(:)      !! theta of the nodes [rad]
    real(wp), intent(in) :: axial(:)      !! z of the nodes [m]
    real(wp), intent(out) :: weight(:, :) !! (4, nodes) of p - p_a [m2], [m3]
    real(wp) :: shapes(size(angle), size(angle))
    integer :: point

    shapes = film_shapes(size(angle))
    weight = 0.0_wp
    do point = 1, size(geometry%area)
      associate (shape => shapes(:, point))
        weight = weight + geometry%area(point)* &
          outer(force_direction(dot_product(shape, angle), dot_product(shape, axial)), shape)
      end associate
    end do
  end subroutine film_force_weights

  !> The element's share of force and torque where the pressure is above ambient only.
  pure function film_force(geometry, angle, axial, overpressure) result(force)
    type(film_geometry_type), intent(in) :: geometry
    real(wp), intent(in) :: angle(:)        !! theta of the nodes [rad]
    real(wp), intent(in) :: axial(:)        !! z of the nodes [m]
    real(wp), intent(in) :: overpressure(:) !! p - p_a at the nodes [Pa]
    real(wp) :: force(film_forces)          !! F_x, F_y [N], M_x, M_y [N m]
    real(wp) :: shapes(size(angle), size(angle))
    integer :: point

    shapes = film_shapes(size(angle))
    force = 0.0_wp
    do point = 1, size(geometry%area)
      associate (shape => shapes(:, point))
        force = force + geometry%area(point)*max(dot_product(shape, overpressure), 0.0_wp)* &
          force_direction(dot_product(shape, angle), dot_product(shape, axial))
      end associate
    end do
  end function film_force

  !> Drag of the film on the shaft's surface, Couette and pressure parts.
  !>
  !> $$ D = \int \Bigl( \frac{2 \mu U}{h} + \frac{h}{2} \frac{\partial p}{\partial x} \Bigr)
  !> d\Omega $$
  !>
  !> It is the shear at \( y = h \) of the velocity between a resting surface and one that moves
  !> with \( 2 U \); positive against the motion.
  pure function film_friction(geometry, flow, pressure, gap, excess) result(drag)
    type(film_geometry_type), intent(in) :: geometry
    type(film_flow_type), intent(in) :: flow
    real(wp), intent(in) :: pressure(:) !! at the nodes [Pa]
    real(wp), intent(in) :: gap(:)      !! at the nodes [m]
    real(wp), intent(in) :: excess(:)   !! of the gap at the Gauss points over the nodes' [m]
    real(wp) :: drag                    !! [N]
    real(wp) :: h, shapes(size(gap), size(gap))
    integer :: point

    shapes = film_shapes(size(gap))
    drag = 0.0_wp
    ! Less one node's pressure, so that an even pressure has no gradient to the last digit.
    do point = 1, size(geometry%area)
      h = dot_product(shapes(:, point), gap) + excess(point)
      drag = drag + geometry%area(point)*(2.0_wp*flow%viscosity*flow%entraining_speed/h &
                                          + 0.5_wp*h*dot_product(geometry%gradient(1, :, point), &
                                          pressure - pressure(1)))
    end do
  end function film_friction

  !> Integrands of force and torque for unit pressure.
  pure function force_direction(angle, axial) result(direction)
    real(wp), intent(in) :: angle !! theta [rad]
    real(wp), intent(in) :: axial !! z [m]
    real(wp) :: direction(film_forces)

    direction = [cos(angle), sin(angle), axial*sin(angle), -axial*cos(angle)]
  end function force_direction

  !> Outer product of two vectors.
  pure function outer(first, second) result(product)
    real(wp), intent(in) :: first(:), second(:)
    real(wp) :: product(size(first), size(second))

    product = spread(first, 2, size(second))*spread(second, 1, size(first))
  end function outer
end module gfb_film_load
