!> Heat that a supply brings into a film, and what the film's temperatures make of a mouth.
!>
!> Gas that enters has the supply's temperature, gas that leaves through wall or hole the film's.
module gfb_heated_supply
  use gfb_kinds, only: wp
  use gfb_feed_law, only: wall_source
  use gfb_film_geometry, only: film_geometry_type, film_shapes
  use gfb_heated_film, only: heated_state_type, field_pressure, field_gas
  use gfb_heated_gas, only: heated_gas_type, relative_viscosity, mean_over_gap
  implicit none (type, external)
  private
  public :: supply_heat, wall_heat, flow_resistance

contains

  !> Heat that a flow of gas carries into the film over gas of a temperature that counts as none,
  !> and its derivatives by flow and temperature of the film.
  !>
  !> $$ Q = c_p \bigl( \max(\dot m, 0) (T_w - T_0) + \min(\dot m, 0) (T - T_0) \bigr) $$
  elemental subroutine supply_heat(gas, supply, none, flow, film, heat, by_flow, by_film)
    type(heated_gas_type), intent(in) :: gas !! the gas
    real(wp), intent(in) :: supply !! T_w, of the supply [K]
    real(wp), intent(in) :: none   !! T_0, at which gas carries no heat [K]
    real(wp), intent(in) :: flow   !! into the film, \( \dot m R_g T_r \) [Pa m3/s]
    real(wp), intent(in) :: film   !! T, of the film there [K]
    real(wp), intent(out) :: heat    !! Q [W]
    real(wp), intent(out) :: by_flow !! its derivative [W s/(Pa m3)]
    real(wp), intent(out) :: by_film !! its derivative [W/K]

    associate (capacity => gas%density*gas%specific_heat)
      by_flow = capacity*(merge(supply, film, flow > 0.0_wp) - none)
      by_film = capacity*min(flow, 0.0_wp)
    end associate
    heat = by_flow*flow
  end subroutine supply_heat

  !> The same of a porous wall behind an element, and the derivatives by its nodal fields.
  !>
  !> $$ Q = \int_{\Omega^e} c_p \bigl( \max(\dot m'', 0) (T_w - T_0)
  !>    + \min(\dot m'', 0) (T - T_0) \bigr) d\Omega $$
  pure subroutine wall_heat(geometry, gas, state, none, heat, by_pressure, by_gas)
    type(film_geometry_type), intent(in) :: geometry !! the element at its points
    type(heated_gas_type), intent(in) :: gas !! that carries the heat
    type(heated_state_type), intent(in) :: state !! at the nodes, with the wall
    real(wp), intent(in) :: none !! T_0, at which gas carries no heat [K]
    real(wp), intent(out) :: heat !! Q [W]
    real(wp), intent(out) :: by_pressure(:), by_gas(:) !! one a node [W/Pa], [W/K]
    real(wp) :: shapes(size(by_gas), size(by_gas)), source, rate, here, by_flow, by_film
    integer :: i, n

    n = size(by_gas)
    shapes = film_shapes(n)
    heat = 0.0_wp
    by_pressure = 0.0_wp
    by_gas = 0.0_wp
    if (.not. state%wall%present) return
    do i = 1, n
      associate (shape => shapes(:, i), area => geometry%area(i))
        call wall_source(state%wall, gas%law, dot_product(shape, state%field(:n, field_pressure)), &
                         source, rate)
        call supply_heat(gas, state%wall%temperature, none, source, &
                         dot_product(shape, state%field(:n, field_gas)), here, by_flow, by_film)
        heat = heat + area*here
        by_pressure = by_pressure + area*by_flow*rate*shape
        by_gas = by_gas + area*by_film*shape
      end associate
    end do
  end subroutine wall_heat

  !> How much harder a film lets gas pass at other temperatures than at the reference, and the
  !> derivatives by gas, top foil and shaft.
  !>
  !> $$ \phi = \frac{\mu(T_m)}{\mu_r} \frac{T}{T_r} $$
  pure function flow_resistance(gas, part, film, foil, shaft) result(resistance)
    type(heated_gas_type), intent(in) :: gas !! its law and reference
    real(wp), intent(in) :: part !! of a difference of temperature that the gas feels [1]
    real(wp), intent(in) :: film, foil, shaft !! T, T_f, T_s [K]
    real(wp) :: resistance(4) !! [1], [1/K], [1/K], [1/K]
    real(wp) :: ratio(3)

    associate (felt => (1.0_wp - part)*gas%reference + part*film, &
               mean => (1.0_wp - part)*gas%reference + part*mean_over_gap(film, foil, shaft))
      ratio = relative_viscosity(gas, mean)
      resistance(1) = ratio(1)*felt/gas%reference
      resistance(2) = part*(ratio(2)*felt + ratio(1))/gas%reference
      resistance(3) = part*ratio(2)*felt/(6.0_wp*gas%reference)
      resistance(4) = -resistance(3)
    end associate
  end function flow_resistance
end module gfb_heated_supply
