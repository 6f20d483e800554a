!> What the gas of a film is: density, viscosity, mean free path, turbulence.
!>
!> The temperature is even. The film's equation wants the density \( \rho(p) \) only up to a factor;
!> here it is \( r = p_a \rho/\rho_a \) [Pa], which is p for an ideal gas, so that what is then
!> printed as p h stays p h.
module gfb_gas_law
  use gfb_kinds, only: wp
  use gfb_monotone_table, only: monotone_table_type, table_at
  use gfb_peng_robinson, only: peng_robinson_type, amount_at
  implicit none (type, external)
  private
  public :: gas_state, gas_density, sutherland_viscosity

  integer, parameter, public :: density_ideal = 1
  integer, parameter, public :: density_peng_robinson = 2
  integer, parameter, public :: density_table = 3

  !> A gas. One that is plain (ideal, of even viscosity, without slip, laminar) has its own, faster
  !> element: `gfb_reynolds_element`.
  type, public :: gas_law_type
    logical :: plain = .true.
    real(wp) :: ambient_pressure = 0.0_wp !! p_a [Pa]
    real(wp) :: viscosity = 0.0_wp        !! at ambient pressure [Pa s]
    real(wp) :: mean_free_path = 0.0_wp   !! lambda_a, at ambient pressure; 0: no slip [m]
    real(wp) :: ambient_density = 0.0_wp  !! rho_a; 0 where nothing needs it [kg/m3]
    integer :: density = density_ideal
    real(wp) :: unit = 1.0_wp             !! r over the density or amount [Pa m3/kg], [J/mol]
    type(peng_robinson_type) :: fluid
    type(monotone_table_type) :: density_curve   !! over the pressure [kg/m3]
    type(monotone_table_type) :: viscosity_curve !! the same [Pa s]
    logical :: has_viscosity_curve = .false.
    real(wp) :: viscosity_exponent = 0.0_wp !! viscosity in proportion to this power of density [1]
    logical :: turbulent = .false.        !! Ng and Pan's factors of the flow
  end type gas_law_type

  !> Density and viscosity at a pressure, with two derivatives by it.
  type, public :: gas_state_type
    real(wp) :: r, r_p, r_pp    !! p_a rho/rho_a [Pa], [1], [1/Pa]
    real(wp) :: mu, mu_p, mu_pp !! [Pa s], [s], [s/Pa]
  end type gas_state_type

contains

  !> Density times p_a/rho_a, and two derivatives.
  pure subroutine gas_density(law, pressure, r, r_p, r_pp)
    type(gas_law_type), intent(in) :: law !! of the gas
    real(wp), intent(in) :: pressure !! p [Pa]
    real(wp), intent(out) :: r    !! p_a rho/rho_a [Pa]
    real(wp), intent(out) :: r_p  !! its derivative [1]
    real(wp), intent(out) :: r_pp !! and the second [1/Pa]

    select case (law%density)
    case (density_peng_robinson)
      call amount_at(law%fluid, pressure, r, r_p, r_pp)
    case (density_table)
      call table_at(law%density_curve, pressure, r, r_p, r_pp)
    case default
      r = pressure
      r_p = 1.0_wp
      r_pp = 0.0_wp
      return
    end select
    r = law%unit*r
    r_p = law%unit*r_p
    r_pp = law%unit*r_pp
  end subroutine gas_density

  !> Density and viscosity.
  pure function gas_state(law, pressure) result(state)
    type(gas_law_type), intent(in) :: law !! of the gas
    real(wp), intent(in) :: pressure !! p [Pa]
    type(gas_state_type) :: state

    call gas_density(law, pressure, state%r, state%r_p, state%r_pp)
    state%mu = law%viscosity
    state%mu_p = 0.0_wp
    state%mu_pp = 0.0_wp
    if (law%has_viscosity_curve) then
      call table_at(law%viscosity_curve, pressure, state%mu, state%mu_p, state%mu_pp)
    else if (abs(law%viscosity_exponent) > 0.0_wp) then
      associate (n => law%viscosity_exponent, rate => state%r_p/state%r)
        state%mu = law%viscosity*(state%r/law%ambient_pressure)**n
        state%mu_p = n*state%mu*rate
        state%mu_pp = n*state%mu*(state%r_pp/state%r + (n - 1.0_wp)*rate**2)
      end associate
    end if
  end function gas_state

  !> Viscosity of air at a temperature.
  !>
  !> $$ \mu = \frac{1.458 \cdot 10^{-6} \, T^{3/2}}{T + 110.4} $$
  !>
  !> Source: U.S. Standard Atmosphere, 1976, eq. 51: Sutherland's law with air's constants.
  elemental function sutherland_viscosity(temperature) result(viscosity)
    real(wp), intent(in) :: temperature !! T [K]
    real(wp) :: viscosity               !! [Pa s]
    viscosity = 1.458e-6_wp*temperature**1.5_wp/(temperature + 110.4_wp)
  end function sutherland_viscosity
end module gfb_gas_law
