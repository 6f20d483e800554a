!> Gas that is fed into a film under pressure: through a porous wall, through orifices.
!>
!> Flows are in the film's own unit, pressure times volume a time: mass times \( R_g T_r \) where
!> the film's gas counts at the temperature \( T_r \), which is the supply's own where nothing else
!> is said of the film; of any gas \( p_a/\rho_a \). Index s is the supply's, p the pressure of the
!> film.
module gfb_feed_law
  use gfb_kinds, only: wp
  use gfb_units, only: pi
  use gfb_gas_integrals, only: gas_integrals, of_density, of_flow, integrals
  use gfb_gas_law, only: gas_law_type, gas_state_type, gas_state, density_ideal
  implicit none (type, external)
  private
  public :: supply_at, wall_source, orifice_flow, largest_orifice_flow, critical_ratio, rim_balance

  integer, parameter, public :: restriction_series = 1  !! hole and curtain, one behind the other
  integer, parameter, public :: restriction_curtain = 2 !! the gap around the mouth
  integer, parameter, public :: restriction_hole = 3    !! the hole itself

  real(wp), parameter :: laminar = 1.0e-3_wp !! eps of the flow without a difference of pressure [1]

  !> A porous wall behind the whole surface.
  type, public :: porous_wall_type
    logical :: present = .false.
    real(wp) :: supply_pressure = 0.0_wp !! p_s, absolute [Pa]
    real(wp) :: thickness = 0.0_wp       !! H, as the flow through it counts it [m]
    real(wp) :: resistance = 0.0_wp      !! A, viscosity over permeability [Pa s/m2]
    real(wp) :: inertia = 0.0_wp         !! B over Rg T_s [1/m over J/kg]
    real(wp) :: density = 1.0_wp         !! of its gas over that of the law, T_r/T_s [1]
    real(wp) :: temperature = 0.0_wp     !! T_s; only a film with heat asks for it [K]
  end type porous_wall_type

  !> Holes that are alike.
  type, public :: orifice_type
    integer :: restriction = restriction_series
    real(wp) :: supply_pressure = 0.0_wp !! p_s, absolute [Pa]
    real(wp) :: energy = 0.0_wp          !! Rg T_s [J/kg]
    real(wp) :: ratio = 1.4_wp           !! of the specific heats, gamma [1]
    real(wp) :: coefficient = 0.8_wp     !! of discharge, C_d [1]
    real(wp) :: diameter = 0.0_wp        !! d [m]
    real(wp) :: mouth = 0.0_wp           !! d_m, of what opens into the film [m]
    logical :: both_ways = .true.        !! gas may leave the film, too
    real(wp) :: density = 1.0_wp         !! T_r/T_s, see `porous_wall_type` [1]
  end type orifice_type

contains

  !> Pressure of a supply of which a part counts [Pa].
  elemental real(wp) function supply_at(supply, ambient, part) result(pressure)
    real(wp), intent(in) :: supply  !! p_s, absolute [Pa]
    real(wp), intent(in) :: ambient !! p_a [Pa]
    real(wp), intent(in) :: part    !! of what it has above that [1]

    pressure = supply
    if (abs(part - 1.0_wp) > 0.0_wp) pressure = ambient + part*(supply - ambient)
  end function supply_at

  !> What a porous wall feeds into the film over it, of an area, and its derivative by the pressure.
  !>
  !> $$ s = R_g T_r \dot m'' = \frac{2 y \, T_r/T_s}{A + \sqrt{A^2 + 4 B |y|/(R_g T_s)}}, \quad
  !>    y = \frac{p_s^2 - p^2}{2 H}, \quad A = \mu/\kappa $$
  !>
  !> Darcy's law for an ideal gas of one temperature, with Forchheimer's term for its inertia:
  !> \( -dp/dn = A u + B \rho u^2 \) through a wall that is thin beside its extent. Of any other gas
  !> \( R_g T_r \) is \( p_a/\rho_a \), and y and A are those of `real_drive`.
  elemental subroutine wall_source(wall, law, pressure, source, by_pressure)
    type(porous_wall_type), intent(in) :: wall !! behind the film
    type(gas_law_type), intent(in) :: law !! of the gas
    real(wp), intent(in) :: pressure     !! p of the film [Pa]
    real(wp), intent(out) :: source      !! s [Pa m/s]
    real(wp), intent(out) :: by_pressure !! its derivative [m/s]
    real(wp) :: drive, drive_rate, resistance, resistance_rate, root, rest

    if (law%density == density_ideal) then
      drive = (wall%supply_pressure - pressure)*(wall%supply_pressure + pressure)/ &
              (2.0_wp*wall%thickness)
      resistance = wall%resistance
    else
      call real_drive(wall, law, pressure, drive, drive_rate, resistance, resistance_rate)
    end if
    root = sqrt(resistance**2 + 4.0_wp*wall%inertia*abs(drive))
    rest = resistance + root
    source = wall%density*(2.0_wp*drive/rest)
    ! With B the derivative by y is 2/(A + root) - 2 |y| (2 B/root)/(A + root)^2, which is 1/root;
    ! that by A is -s/root.
    if (law%density == density_ideal) then
      by_pressure = -wall%density*pressure/(wall%thickness*root)
    else
      by_pressure = (wall%density*drive_rate - source*resistance_rate)/root
    end if
  end subroutine wall_source

  !> What drives a gas of any density through a wall, and the wall's resistance, with their
  !> derivatives by the pressure of the film.
  !>
  !> $$ y = \frac{1}{H} \int_p^{p_s} r \, dp, \quad
  !>    A = \frac{1}{\kappa} \int_p^{p_s} r \, dp \Big/ \int_p^{p_s} \frac{r}{\mu} \, dp $$
  !>
  !> so that Darcy's law alone, B = 0, gives \( s = \kappa/H \int r/\mu \, dp \) whatever the
  !> viscosity does on the way.
  elemental subroutine real_drive(wall, law, pressure, drive, drive_rate, resistance, &
                                  resistance_rate)
    type(porous_wall_type), intent(in) :: wall
    type(gas_law_type), intent(in) :: law
    real(wp), intent(in) :: pressure !! p of the film [Pa]
    real(wp), intent(out) :: drive, drive_rate           !! y [Pa2/m], [Pa/m]
    real(wp), intent(out) :: resistance, resistance_rate !! A [Pa s/m2], [s/m2]
    type(gas_state_type) :: gas
    real(wp) :: integral(integrals), unit

    integral = gas_integrals(law, pressure, wall%supply_pressure)
    gas = gas_state(law, pressure)
    unit = wall%resistance/law%viscosity ! 1/kappa, with the viscosity's change by temperature
    drive = integral(of_density)/wall%thickness
    drive_rate = -gas%r/wall%thickness
    resistance = unit*gas%mu
    resistance_rate = 0.0_wp
    if (.not. abs(integral(of_flow)) > 0.0_wp) return
    resistance = unit*integral(of_density)/integral(of_flow)
    resistance_rate = unit*gas%r*(integral(of_density)/gas%mu - integral(of_flow))/ &
                      integral(of_flow)**2
  end subroutine real_drive

  !> Flow through an orifice into its mouth, and its derivatives by pressure and gap there.
  !>
  !> $$ q = R_g T_r \dot m = \frac{T_r}{T_s} C_d A(h) p_s \sqrt{R_g T_s} \, \psi(p_d/p_s) $$
  !>
  !> with the area of the hole \( \pi d^2/4 \), of the curtain \( \pi d_m h \), or of both one
  !> behind the other, \( A_o A_c/\sqrt{A_o^2 + A_c^2} \), which has both as its limits.
  elemental subroutine orifice_flow(orifice, pressure, gap, flow, by_pressure, by_gap)
    type(orifice_type), intent(in) :: orifice !! the hole
    real(wp), intent(in) :: pressure !! p_d in its mouth [Pa]
    real(wp), intent(in) :: gap      !! h there [m]
    real(wp), intent(out) :: flow        !! q [Pa m3/s]
    real(wp), intent(out) :: by_pressure !! its derivative [m3/s]
    real(wp), intent(out) :: by_gap      !! its derivative [Pa m2/s]
    real(wp) :: hole, curtain, area, area_by_gap, psi, slope, size

    hole = 0.25_wp*pi*orifice%diameter**2
    curtain = pi*orifice%mouth*gap
    select case (orifice%restriction)
    case (restriction_hole)
      area = hole
      area_by_gap = 0.0_wp
    case (restriction_curtain)
      area = curtain
      area_by_gap = pi*orifice%mouth
    case default
      area = hole*curtain/hypot(hole, curtain)
      area_by_gap = pi*orifice%mouth*(hole/hypot(hole, curtain))**3
    end select
    call flow_factor(pressure/orifice%supply_pressure, orifice%ratio, psi, slope)
    if (.not. orifice%both_ways .and. psi < 0.0_wp) then
      psi = 0.0_wp
      slope = 0.0_wp
    end if
    size = orifice%coefficient*orifice%supply_pressure*sqrt(orifice%energy)*orifice%density
    flow = size*area*psi
    by_pressure = size*area*slope/orifice%supply_pressure
    by_gap = size*area_by_gap*psi
  end subroutine orifice_flow

  !> What an orifice lets through at most: choked, all its hole open; without one its curtain.
  elemental real(wp) function largest_orifice_flow(orifice, gap) result(flow)
    type(orifice_type), intent(in) :: orifice !! the hole
    real(wp), intent(in) :: gap !! the largest that is expected at its mouth [m]
    real(wp) :: by_pressure, by_gap
    call orifice_flow(orifice, 0.5_wp*critical_ratio(orifice%ratio)*orifice%supply_pressure, gap, &
                      flow, by_pressure, by_gap)
  end function largest_orifice_flow

  !> Ratio of pressures below which the flow is choked: it does not depend on them any more.
  !>
  !> $$ x_c = \Bigl( \frac{2}{\gamma + 1} \Bigr)^{\gamma/(\gamma - 1)} $$
  elemental real(wp) function critical_ratio(ratio) result(critical)
    real(wp), intent(in) :: ratio !! of the specific heats, gamma [1]
    critical = (2.0_wp/(ratio + 1.0_wp))**(ratio/(ratio - 1.0_wp))
  end function critical_ratio

  !> Isentropic flow factor over the ratio of the pressures behind and before a hole, and its slope.
  !>
  !> $$ \psi = \frac{D}{(D^2 + \epsilon^2)^{1/4}}, \quad D = \begin{cases}
  !>    \gamma (2/(\gamma + 1))^{(\gamma + 1)/(\gamma - 1)} & x \le x_c \\
  !>    \frac{2 \gamma}{\gamma - 1} (x^{2/\gamma} - x^{(\gamma + 1)/\gamma}) & x_c < x \le 1 \\
  !>    -x^2 D(1/x) & x > 1 \end{cases} $$
  !>
  !> Source: de Saint-Venant and Wantzel. Without a difference of pressure the slope of
  !> \( \sqrt{D} \) is infinite; the flow is laminar there, in truth, and \( \epsilon \) makes
  !> it so.
  elemental subroutine flow_factor(ratio, gamma, psi, slope)
    real(wp), intent(in) :: ratio  !! x [1]
    real(wp), intent(in) :: gamma  !! [1]
    real(wp), intent(out) :: psi   !! negative where gas flows back [1]
    real(wp), intent(out) :: slope !! its derivative [1]
    real(wp) :: square, by_ratio, rate

    if (ratio <= 1.0_wp) then
      call factor_square(ratio, gamma, square, by_ratio)
    else
      call factor_square(1.0_wp/ratio, gamma, square, rate)
      by_ratio = rate - 2.0_wp*ratio*square
      square = -ratio**2*square
    end if
    associate (sum => square**2 + laminar**2)
      psi = square/sum**0.25_wp
      slope = by_ratio*(0.5_wp*square**2 + laminar**2)/sum**1.25_wp
    end associate
  end subroutine flow_factor

  !> D of `flow_factor` up to a ratio of one.
  elemental subroutine factor_square(ratio, gamma, square, slope)
    real(wp), intent(in) :: ratio, gamma
    real(wp), intent(out) :: square, slope
    real(wp) :: factor

    if (ratio <= critical_ratio(gamma)) then
      square = gamma*(2.0_wp/(gamma + 1.0_wp))**((gamma + 1.0_wp)/(gamma - 1.0_wp))
      slope = 0.0_wp
      return
    end if
    factor = 2.0_wp*gamma/(gamma - 1.0_wp)
    square = factor*(ratio**(2.0_wp/gamma) - ratio**((gamma + 1.0_wp)/gamma))
    slope = factor*(2.0_wp*ratio**(2.0_wp/gamma - 1.0_wp) &
                    - (gamma + 1.0_wp)*ratio**(1.0_wp/gamma))/gamma
  end subroutine factor_square

  !> What a mouth whose rim the mesh of the film smears lacks: zero where its pressure fits the
  !> film's, and the derivatives.
  !>
  !> $$ r = p_d^2 - p_0^2 - \beta \frac{q}{k}, \quad k = \frac{h^3}{24 \mu} $$
  !>
  !> In a film of other temperatures \( \mu \) counts as \( \mu(T_m) \, T/T_r \), its density
  !> with it.
  !>
  !> Around a mouth \( p^2 \) is a logarithm, which no mesh follows: \( \beta \) is what the mean
  !> of a unit source on the rim lacks on this mesh, for an even gap.
  elemental subroutine rim_balance(lack, viscosity, pressure, mean, gap, flow, balance, &
                                   by_pressure, by_mean, by_gap, by_flow)
    real(wp), intent(in) :: lack      !! beta [1]
    real(wp), intent(in) :: viscosity !! mu [Pa s]
    real(wp), intent(in) :: pressure  !! p_d, in the mouth [Pa]
    real(wp), intent(in) :: mean      !! p_0, of the film on the rim [Pa]
    real(wp), intent(in) :: gap       !! h [m]
    real(wp), intent(in) :: flow      !! q into the film [Pa m3/s]
    real(wp), intent(out) :: balance  !! r [Pa2]
    real(wp), intent(out) :: by_pressure, by_mean !! the flow staying [Pa]
    real(wp), intent(out) :: by_gap   !! the same [Pa2/m]
    real(wp), intent(out) :: by_flow  !! [Pa s/m3]

    by_flow = -24.0_wp*lack*viscosity/gap**3
    balance = (pressure - mean)*(pressure + mean) + by_flow*flow
    by_pressure = 2.0_wp*pressure
    by_mean = -2.0_wp*mean
    by_gap = -3.0_wp*by_flow*flow/gap
  end subroutine rim_balance
end module gfb_feed_law
