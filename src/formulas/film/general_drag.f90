!> Drag of a film of any gas on the shaft: with slip, a real gas, turbulence.
!>
!> Where the gas is plain, `film_friction` of `gfb_film_load` gives the same, faster.
module gfb_general_drag
  use gfb_kinds, only: wp
  use gfb_film_geometry, only: film_geometry_type, film_shapes
  use gfb_film_flow, only: film_flow_type
  use gfb_gas_law, only: gas_law_type, gas_state_type, gas_state
  use gfb_general_film, only: reynolds_number
  implicit none (type, external)
  private
  public :: general_friction, general_friction_rates

  !> a and b of the factor 1 + a Re^b of the shear in turbulent flow [Constantinescu1959].
  real(wp), parameter :: shear_factor(2) = [0.0012_wp, 0.94_wp]

contains

  !> Drag of the film on the shaft's surface, Couette and pressure parts.
  !>
  !> $$ D = \int \Bigl( \frac{2 \mu U}{h + 2 \lambda} (1 + a Re^b)
  !>      + \frac{h}{2} \frac{\partial p}{\partial x} \Bigr) d\Omega $$
  !>
  !> The factor with the Reynolds number only with turbulence.
  pure function general_friction(geometry, flow, law, pressure, gap, excess) result(drag)
    type(film_geometry_type), intent(in) :: geometry !! of the element
    type(film_flow_type), intent(in) :: flow         !! speed of the film
    type(gas_law_type), intent(in) :: law !! of the gas
    real(wp), intent(in) :: pressure(:) !! at the nodes [Pa]
    real(wp), intent(in) :: gap(:)      !! at the nodes [m]
    real(wp), intent(in) :: excess(:)   !! of the gap at the Gauss points over the nodes' [m]
    real(wp) :: drag                    !! [N]
    real(wp) :: shapes(size(gap), size(gap)), shear(3), h
    integer :: i

    shapes = film_shapes(size(gap))
    drag = 0.0_wp
    do i = 1, size(gap)
      h = dot_product(shapes(:, i), gap) + excess(i)
      shear = couette_shear(flow, law, dot_product(shapes(:, i), pressure), h)
      drag = drag + geometry%area(i)* &
             (shear(1) + 0.5_wp*h*dot_product(geometry%gradient(1, :, i), pressure - pressure(1)))
    end do
  end function general_friction

  !> Derivatives of that drag.
  pure subroutine general_friction_rates(geometry, flow, law, pressure, gap, excess, by_pressure, &
                                         by_gap)
    type(film_geometry_type), intent(in) :: geometry !! of the element
    type(film_flow_type), intent(in) :: flow         !! speed of the film
    type(gas_law_type), intent(in) :: law !! of the gas
    real(wp), intent(in) :: pressure(:) !! at the nodes [Pa]
    real(wp), intent(in) :: gap(:)      !! at the nodes [m]
    real(wp), intent(in) :: excess(:)   !! of the gap at the Gauss points over the nodes' [m]
    real(wp), intent(out) :: by_pressure(:), by_gap(:) !! one a node [N/Pa], [N/m]
    real(wp) :: shapes(size(gap), size(gap)), shear(3), h
    integer :: i

    shapes = film_shapes(size(gap))
    by_pressure = 0.0_wp
    by_gap = 0.0_wp
    do i = 1, size(gap)
      associate (shape => shapes(:, i), along => geometry%gradient(1, :, i), &
                 area => geometry%area(i))
        h = dot_product(shape, gap) + excess(i)
        shear = couette_shear(flow, law, dot_product(shape, pressure), h)
        by_pressure = by_pressure + area*(shear(2)*shape + 0.5_wp*h*along)
        by_gap = by_gap + area*(shear(3) + 0.5_wp*dot_product(along, pressure - pressure(1)))*shape
      end associate
    end do
  end subroutine general_friction_rates

  !> Shear stress of the entrained flow, and its derivatives by pressure and gap.
  !>
  !> $$ \tau = \frac{2 \mu U}{h + 2 \lambda_a p_a/p} (1 + a Re^b) $$
  pure function couette_shear(flow, law, pressure, gap) result(shear)
    type(film_flow_type), intent(in) :: flow
    type(gas_law_type), intent(in) :: law
    real(wp), intent(in) :: pressure, gap !! [Pa], [m]
    real(wp) :: shear(3)                  !! [Pa], [1], [Pa/m]
    type(gas_state_type) :: gas
    real(wp) :: slip, laminar, added

    gas = gas_state(law, pressure)
    slip = 2.0_wp*law%mean_free_path*law%ambient_pressure/pressure
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
end module gfb_general_drag
