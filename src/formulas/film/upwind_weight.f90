!> How a film's elements weight what the motion carries.
module gfb_upwind_weight
  use gfb_kinds, only: wp
  use gfb_film_flow, only: film_flow_type
  implicit none (type, external)
  private
  public :: cell_peclet, upwind_weight, upwind_weight_derivative

  real(wp), parameter :: small_peclet = 0.02_wp !! below it the series of coth is exact to round-off
  real(wp), parameter :: large_peclet = 20.0_wp !! above it coth is one to round-off

contains

  !> Cell Peclet number, entrained over diffused flow.
  !>
  !> $$ Pe = \frac{U h \ell}{2 k}, \quad k = \frac{p h^3}{12 \mu} $$
  pure function cell_peclet(flow, stream_length, pressure, gap) result(peclet)
    type(film_flow_type), intent(in) :: flow !! viscosity and speed of the film
    real(wp), intent(in) :: stream_length !! l, the element's length along x [m]
    real(wp), intent(in) :: pressure      !! p [Pa]
    real(wp), intent(in) :: gap           !! h [m]
    real(wp) :: peclet                    !! [1]
    peclet = 6.0_wp*flow%viscosity*flow%entraining_speed*stream_length/(pressure*gap**2)
  end function cell_peclet

  !> The weight \( \coth Pe - 1/Pe \), which makes linear elements exact at the nodes in one
  !> dimension.
  elemental function upwind_weight(peclet) result(weight)
    real(wp), intent(in) :: peclet !! [1]
    real(wp) :: weight             !! [1]

    if (abs(peclet) < small_peclet) then
      weight = peclet/3.0_wp - peclet**3/45.0_wp + 2.0_wp*peclet**5/945.0_wp
    else if (abs(peclet) > large_peclet) then
      weight = sign(1.0_wp, peclet) - 1.0_wp/peclet
    else
      weight = 1.0_wp/tanh(peclet) - 1.0_wp/peclet
    end if
  end function upwind_weight

  !> Derivative of `upwind_weight`.
  elemental function upwind_weight_derivative(peclet) result(slope)
    real(wp), intent(in) :: peclet !! [1]
    real(wp) :: slope              !! [1]

    if (abs(peclet) < small_peclet) then
      slope = 1.0_wp/3.0_wp - peclet**2/15.0_wp + 2.0_wp*peclet**4/189.0_wp
    else if (abs(peclet) > large_peclet) then
      slope = 1.0_wp/peclet**2
    else
      slope = 1.0_wp/peclet**2 - 1.0_wp/sinh(peclet)**2
    end if
  end function upwind_weight_derivative
end module gfb_upwind_weight
