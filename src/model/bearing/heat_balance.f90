!> Whether the heat of a bearing can leave it, whatever its temperature.
!>
!> Gas and walls at one temperature T: what the film makes by its drag grows with the viscosity of
!> the gas, what the gas carries away shrinks with its density, and what goes through walls grows
!> with T. Where the first exceeds the others together at every T up to a bound there is no steady
!> state below that bound.
!>
!> $$ Q(T) = Q_a \frac{\mu(T)}{\mu_a}, \quad
!>    \Phi(T) = c_p \dot m_a \frac{T_a}{T} (T - T_a) + G_s (T - T_s) + G_f (T - T_b)
!>    + w c_p (T - T_c) $$
module gfb_heat_balance
  use gfb_kinds, only: wp
  use gfb_heated_film, only: relative_viscosity, wall_given, wall_fin
  use gfb_bearing_heat, only: film_heat_type
  implicit none (type, external)
  private
  public :: heat_let_out, find_surplus

  real(wp), parameter, public :: hottest = 2000.0_wp !! that is looked at [K]
  real(wp), parameter :: growth = 1.01_wp            !! of one temperature over the one before [1]

  !> What a film of gas at ambient temperature does.
  type, public :: film_work_type
    real(wp) :: drag = 0.0_wp  !! Q_a, heat that it makes at least [W]
    real(wp) :: power = 1.0_wp !! of the viscosity with which that grows [1]
    real(wp) :: flow = 0.0_wp  !! m_a, gas drawn in [kg/s]
    real(wp) :: area = 0.0_wp  !! of all pads [m2]
  end type film_work_type

contains

  !> What leaves a bearing at most at one temperature [W]; without a bound where a wall is held.
  pure real(wp) function heat_let_out(heat, film, temperature) result(out)
    type(film_heat_type), intent(in) :: heat !! of the bearing
    type(film_work_type), intent(in) :: film !! of all its pads
    real(wp), intent(in) :: temperature      !! T of gas and walls [K]
    real(wp) :: through ! bumps, from the foil to the sleeve, and from there on [W/K]

    out = huge(1.0_wp)
    if (heat%shaft%kind == wall_given .or. .not. heat%sheet) return
    out = heat%gas%specific_heat*film%flow*heat%ambient*(1.0_wp - heat%ambient/temperature)
    if (heat%shaft%kind == wall_fin) then
      out = out + dot_product(heat%end_conductance, temperature - heat%end_temperature)
    else
      out = out + heat%shaft%conductance*(temperature - heat%shaft%far)
    end if
    through = heat%bumps*film%area
    if (heat%sleeve%kind == wall_given) then
      out = out + through*(temperature - heat%sleeve%temperature)
    else if (through > 0.0_wp) then
      through = through*heat%sleeve%conductance/(through + heat%sleeve%conductance)
      out = out + through*(temperature - heat%sleeve%far)
    end if
    if (max(heat%channel, heat%channel_sleeve) > 0.0_wp) then
      out = out + heat%cooling*(temperature - heat%cooling_temperature)
    end if
  end function heat_let_out

  !> The temperature at which the least of the heat made is left over, and both there.
  pure subroutine find_surplus(heat, film, always, temperature, made, out)
    type(film_heat_type), intent(in) :: heat !! of the bearing
    type(film_work_type), intent(in) :: film !! of all its pads
    logical, intent(out) :: always       !! more is made than leaves at each up to `hottest`
    real(wp), intent(out) :: temperature     !! [K]
    real(wp), intent(out) :: made, out       !! there [W]
    real(wp) :: trial, viscosity(3), here(2)

    temperature = 0.0_wp
    made = 0.0_wp
    out = huge(1.0_wp)
    trial = growth*heat%ambient
    do while (trial < hottest)
      viscosity = relative_viscosity(heat%gas, trial)
      here = [film%drag*viscosity(1)**film%power, heat_let_out(heat, film, trial)]
      if (.not. temperature > 0.0_wp .or. here(1)*out < here(2)*made) then
        temperature = trial
        made = here(1)
        out = here(2)
      end if
      trial = growth*trial
    end do
    always = made > out
  end subroutine find_surplus
end module gfb_heat_balance
