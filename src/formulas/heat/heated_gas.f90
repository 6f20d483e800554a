!> A gas that carries heat: what its law does not say, and how temperatures change its viscosity.
module gfb_heated_gas
  use gfb_kinds, only: wp
  use gfb_gas_law, only: gas_law_type, viscosity_sutherland, viscosity_power, &
                         sutherland_temperature
  implicit none (type, external)
  private
  public :: relative_viscosity, mean_over_gap

  !> What the energy equation wants of the gas, beside its law at the reference temperature.
  type, public :: heated_gas_type
    type(gas_law_type) :: law            !! at the reference temperature
    real(wp) :: reference = 0.0_wp       !! T_r, where the law holds [K]
    real(wp) :: density = 0.0_wp         !! of mass over r, 1/(R_g T_r) [kg/(Pa m3)]
    real(wp) :: specific_heat = 0.0_wp   !! c_p [J/(kg K)]
    real(wp) :: prandtl = 0.0_wp         !! Pr [1]
    integer :: viscosity = viscosity_sutherland !! how it follows the temperature
    real(wp) :: exponent = 0.0_wp        !! n of the power law [1]
  end type heated_gas_type

contains

  !> Viscosity over that at the reference temperature, \( \nu(T) \), with two derivatives by it.
  pure function relative_viscosity(gas, temperature) result(ratio)
    type(heated_gas_type), intent(in) :: gas !! its law and reference
    real(wp), intent(in) :: temperature !! T [K]
    real(wp) :: ratio(3)                !! [1], [1/K], [1/K2]
    real(wp) :: rate, bend

    ratio = [1.0_wp, 0.0_wp, 0.0_wp]
    associate (t => temperature, r => gas%reference, s => sutherland_temperature)
      select case (gas%viscosity)
      case (viscosity_sutherland)
        ratio(1) = (t/r)*sqrt(t/r)*(r + s)/(t + s)
        rate = 1.5_wp/t - 1.0_wp/(t + s)
        bend = -1.5_wp/t**2 + 1.0_wp/(t + s)**2
      case (viscosity_power)
        ratio(1) = (t/r)**gas%exponent
        rate = gas%exponent/t
        bend = -gas%exponent/t**2
      case default
        return
      end select
      ratio(2) = ratio(1)*rate
      ratio(3) = ratio(1)*(rate**2 + bend)
    end associate
  end function relative_viscosity

  !> Mean temperature over the gap, \( T - (T_s - T_f)/6 \) [K].
  elemental real(wp) function mean_over_gap(gas, foil, shaft) result(mean)
    real(wp), intent(in) :: gas         !! T, at which the gas carries its heat [K]
    real(wp), intent(in) :: foil, shaft !! T_f, T_s [K]
    mean = gas + (foil - shaft)/6.0_wp
  end function mean_over_gap
end module gfb_heated_gas
