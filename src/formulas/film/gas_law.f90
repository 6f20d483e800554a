!> What the gas of a film is: density, viscosity, mean free path, turbulence.
!>
!> The temperature is even. The film's equation wants the density \( \rho(p) \) only up to a factor;
!> here it is \( r = p_a \rho/\rho_a \) [Pa], which is p for an ideal gas, so that what is then
!> printed as p h stays p h.
!>
!> A table with a smooth curve through it that never overshoots: monotone piecewise cubics.
!>
!> Source: [FritschButland1984] (the PCHIP of SLATEC and SciPy). Value and slope are continuous, the
!> curvature jumps at the points.
!>
!> The equation of state of Peng and Robinson, at one temperature.
!>
!> $$ p = \frac{R T c}{1 - b c} - \frac{a c^2}{1 + 2 b c - b^2 c^2} $$
!>
!> with the amount c in a volume. Source: [PengRobinson1976]. Above the critical temperature p rises
!> with c, so that each pressure has one c. Below, a vapour is meant, up to its saturation pressure.
module gfb_gas_law
  use gfb_kinds, only: wp
  implicit none (type, external)
  private
  public :: monotone_table, table_at, peng_robinson, saturate, amount_at, pressure_at, gas_state, &
            gas_density, sutherland_viscosity

  !> Points and slopes.
  type, public :: monotone_table_type
    real(wp), allocatable :: place(:) !! rising
    real(wp), allocatable :: value(:) !! there
    real(wp), allocatable :: slope(:) !! there
  end type monotone_table_type

  real(wp), parameter, public :: gas_constant = 8.314462618_wp !! R [J/(mol K)]
  real(wp), parameter, public :: sutherland_temperature = 110.4_wp !! of air [K]

  !> How the viscosity follows the temperature: not, as that of air, as a power of it.
  integer, parameter, public :: viscosity_constant = 1, viscosity_sutherland = 2, &
                                viscosity_power = 3

  !> A fluid at a temperature.
  type, public :: peng_robinson_type
    real(wp) :: energy = 0.0_wp     !! R T [J/mol]
    real(wp) :: attraction = 0.0_wp !! a [Pa m6/mol2]
    real(wp) :: covolume = 0.0_wp   !! b [m3/mol]
    real(wp) :: saturation = huge(1.0_wp) !! pressure at which it condenses; huge: never [Pa]
    real(wp) :: saturated = 0.0_wp        !! the vapour's amount there [mol/m3]
  end type peng_robinson_type

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

  !> What a temperature that is not the law's makes of the gas: it stands beside each of these.
  type, public :: gas_factors_type
    real(wp) :: density = 1.0_wp        !! of r [1]
    real(wp) :: viscosity = 1.0_wp      !! [1]
    real(wp) :: mean_free_path = 1.0_wp !! [1]
  end type gas_factors_type

  !> Density and viscosity at a pressure, with two derivatives by it.
  type, public :: gas_state_type
    real(wp) :: r, r_p, r_pp    !! p_a rho/rho_a [Pa], [1], [1/Pa]
    real(wp) :: mu, mu_p, mu_pp !! [Pa s], [s], [s/Pa]
  end type gas_state_type

contains

  !> The curve through points.
  pure function monotone_table(place, value) result(table)
    real(wp), intent(in) :: place(:) !! rising, two at least [any unit]
    real(wp), intent(in) :: value(:) !! there [any unit]
    type(monotone_table_type) :: table
    real(wp), dimension(size(place) - 1) :: length, rise
    integer :: i, n

    n = size(place)
    table%place = place
    table%value = value
    length = place(2:) - place(:n - 1)
    rise = (value(2:) - value(:n - 1))/length
    allocate (table%slope(n), source=rise(1))
    if (n == 2) return
    do i = 2, n - 1
      table%slope(i) = inner_slope(length(i - 1), length(i), rise(i - 1), rise(i))
    end do
    table%slope(1) = end_slope(length(1), length(2), rise(1), rise(2))
    table%slope(n) = end_slope(length(n - 1), length(n - 2), rise(n - 1), rise(n - 2))
  end function monotone_table

  !> Slope between two intervals: their harmonic mean, none at an extremum.
  elemental real(wp) function inner_slope(before, after, rise_before, rise_after) result(slope)
    real(wp), intent(in) :: before, after           !! lengths of the intervals
    real(wp), intent(in) :: rise_before, rise_after !! their mean slopes

    slope = 0.0_wp
    if (rise_before*rise_after <= 0.0_wp) return
    slope = 3.0_wp*(before + after)/((2.0_wp*after + before)/rise_before &
                                     + (after + 2.0_wp*before)/rise_after)
  end function inner_slope

  !> Slope at an end: that of a parabola through three points, as far as it stays monotone.
  elemental real(wp) function end_slope(length, next, rise, next_rise) result(slope)
    real(wp), intent(in) :: length, next    !! of the last interval and the one beside it
    real(wp), intent(in) :: rise, next_rise !! their mean slopes

    slope = ((2.0_wp*length + next)*rise - length*next_rise)/(length + next)
    if (slope*rise <= 0.0_wp) then
      slope = 0.0_wp
    else if (rise*next_rise <= 0.0_wp .and. abs(slope) > 3.0_wp*abs(rise)) then
      slope = 3.0_wp*rise
    end if
  end function end_slope

  !> Value and two derivatives.
  !>
  !> Beyond the ends, where only iterates come, it goes on with the slope there, and stays positive
  !> where the end is.
  pure subroutine table_at(table, place, value, slope, curvature)
    type(monotone_table_type), intent(in) :: table !! points and slopes
    real(wp), intent(in) :: place  !! [as the table]
    real(wp), intent(out) :: value !! [as the table]
    real(wp), intent(out) :: slope !! derivative [as the table]
    real(wp), intent(out) :: curvature !! second derivative [as the table]
    real(wp) :: t, jump, first, second !! in the interval; its rise less those of the end slopes
    integer :: i, last, middle

    i = 1
    last = size(table%place)
    if (place < table%place(1)) then
      call extend(table%value(1), table%slope(1), place - table%place(1), value, slope, curvature)
      return
    else if (place > table%place(last)) then
      call extend(table%value(last), table%slope(last), place - table%place(last), value, slope, &
                  curvature)
      return
    end if
    do while (last - i > 1)
      middle = (i + last)/2
      if (place >= table%place(middle)) then
        i = middle
      else
        last = middle
      end if
    end do
    associate (length => table%place(i + 1) - table%place(i))
      t = (place - table%place(i))/length
      jump = table%value(i + 1) - table%value(i)
      first = table%slope(i)*length
      second = table%slope(i + 1)*length
      value = table%value(i) + t*(first + t*(3.0_wp*jump - 2.0_wp*first - second &
                                             + t*(first + second - 2.0_wp*jump)))
      slope = (first + t*(2.0_wp*(3.0_wp*jump - 2.0_wp*first - second) &
                          + 3.0_wp*t*(first + second - 2.0_wp*jump)))/length
      curvature = (2.0_wp*(3.0_wp*jump - 2.0_wp*first - second) &
                   + 6.0_wp*t*(first + second - 2.0_wp*jump))/length**2
    end associate
  end subroutine table_at

  !> A line from an end, or where that falls an exponential.
  elemental subroutine extend(end_value, end_slope, distance, value, slope, curvature)
    real(wp), intent(in) :: end_value, end_slope
    real(wp), intent(in) :: distance !! from the end
    real(wp), intent(out) :: value, slope, curvature

    if (end_slope*distance*end_value >= 0.0_wp) then
      value = end_value + end_slope*distance
      slope = end_slope
      curvature = 0.0_wp
    else
      value = end_value*exp(end_slope*distance/end_value)
      slope = value*end_slope/end_value
      curvature = slope*end_slope/end_value
    end if
  end subroutine extend

  !> Constants of a fluid.
  elemental function peng_robinson(temperature, critical_temperature, critical_pressure, &
                                   acentric_factor) result(fluid)
    real(wp), intent(in) :: temperature          !! T [K]
    real(wp), intent(in) :: critical_temperature !! T_c [K]
    real(wp), intent(in) :: critical_pressure    !! p_c [Pa]
    real(wp), intent(in) :: acentric_factor      !! omega [1]
    type(peng_robinson_type) :: fluid
    real(wp) :: kappa, alpha

    kappa = 0.37464_wp + (1.54226_wp - 0.26992_wp*acentric_factor)*acentric_factor
    alpha = (1.0_wp + kappa*(1.0_wp - sqrt(temperature/critical_temperature)))**2
    fluid%energy = gas_constant*temperature
    fluid%attraction = 0.45724_wp*(gas_constant*critical_temperature)**2/critical_pressure*alpha
    fluid%covolume = 0.07780_wp*gas_constant*critical_temperature/critical_pressure
  end function peng_robinson

  !> Finds where a vapour condenses, if it does at its temperature: vapour and liquid have the same
  !> fugacity there.
  pure subroutine saturate(fluid)
    type(peng_robinson_type), intent(inout) :: fluid !! gets its saturation
    integer, parameter :: points = 20000, halvings = 100
    real(wp) :: vapour, liquid !! amounts where the fluid becomes unstable [mol/m3]
    real(wp) :: low, high, middle, pressure, slope, curvature
    integer :: i

    vapour = 0.0_wp
    liquid = 0.0_wp
    do i = 1, points - 1
      middle = real(i, wp)/(real(points, wp)*fluid%covolume)
      call pressure_at(fluid, middle, pressure, slope, curvature)
      if (slope > 0.0_wp) cycle
      if (.not. vapour > 0.0_wp) vapour = middle
      liquid = middle
    end do
    if (.not. vapour > 0.0_wp) return
    call pressure_at(fluid, vapour, high, slope, curvature)
    call pressure_at(fluid, liquid, low, slope, curvature)
    low = max(low, 0.0_wp)
    do i = 1, halvings
      middle = 0.5_wp*(low + high)
      if (fugacity(fluid, root(fluid, middle, liquid, 1.0_wp/fluid%covolume)) > &
          fugacity(fluid, root(fluid, middle, 0.0_wp, vapour))) then
        low = middle
      else
        high = middle
      end if
    end do
    fluid%saturation = low
    fluid%saturated = root(fluid, low, 0.0_wp, vapour)
  end subroutine saturate

  !> The amount at a pressure on a branch where the pressure rises.
  pure real(wp) function root(fluid, pressure, least, most) result(amount)
    type(peng_robinson_type), intent(in) :: fluid
    real(wp), intent(in) :: pressure    !! [Pa]
    real(wp), intent(in) :: least, most !! amounts on the branch [mol/m3]
    integer, parameter :: halvings = 100
    real(wp) :: low, high, here, slope, curvature
    integer :: i

    low = least
    high = most
    do i = 1, halvings
      amount = 0.5_wp*(low + high)
      call pressure_at(fluid, amount, here, slope, curvature)
      if (here < pressure) then
        low = amount
      else
        high = amount
      end if
    end do
  end function root

  !> Logarithm of the fugacity, over a pressure that does not matter [1].
  elemental real(wp) function fugacity(fluid, amount) result(logarithm)
    type(peng_robinson_type), intent(in) :: fluid
    real(wp), intent(in) :: amount !! c [mol/m3]
    real(wp), parameter :: root_two = sqrt(2.0_wp)
    real(wp) :: pressure, slope, curvature, x

    call pressure_at(fluid, amount, pressure, slope, curvature)
    x = fluid%covolume*amount
    logarithm = pressure/(amount*fluid%energy) + log(amount) - log(1.0_wp - x) &
      - fluid%attraction/(2.0_wp*root_two*fluid%covolume*fluid%energy) &
      *log((1.0_wp + (1.0_wp + root_two)*x)/(1.0_wp + (1.0_wp - root_two)*x))
  end function fugacity

  !> Pressure and two derivatives by the amount.
  elemental subroutine pressure_at(fluid, amount, pressure, slope, curvature)
    type(peng_robinson_type), intent(in) :: fluid !! at its temperature
    real(wp), intent(in) :: amount     !! c, below 1/b [mol/m3]
    real(wp), intent(out) :: pressure  !! p [Pa]
    real(wp), intent(out) :: slope     !! dp/dc [J/mol]
    real(wp), intent(out) :: curvature !! its derivative [J m3/mol2]
    real(wp) :: x, free, denominator

    associate (c => amount, a => fluid%attraction, b => fluid%covolume)
      x = b*c
      free = 1.0_wp - x
      denominator = 1.0_wp + x*(2.0_wp - x)
      pressure = c*(fluid%energy/free - a*c/denominator)
      slope = fluid%energy/free**2 - 2.0_wp*a*c*(1.0_wp + x)/denominator**2
      curvature = 2.0_wp*b*fluid%energy/free**3 &
        - 2.0_wp*a*((1.0_wp + 2.0_wp*x)*denominator - 4.0_wp*x*(1.0_wp + x)*free)/denominator**3
    end associate
  end subroutine pressure_at

  !> The amount in a volume at a pressure, and two derivatives by it. Newton's method in bounds.
  !>
  !> Beyond saturation, where only iterates and a vapour that would condense come, it goes on with
  !> the slope there.
  elemental subroutine amount_at(fluid, pressure, amount, slope, curvature)
    type(peng_robinson_type), intent(in) :: fluid !! at its temperature
    real(wp), intent(in) :: pressure   !! p, positive [Pa]
    real(wp), intent(out) :: amount    !! c [mol/m3]
    real(wp), intent(out) :: slope     !! dc/dp [mol/J]
    real(wp), intent(out) :: curvature !! its derivative [mol/(J Pa)]
    integer, parameter :: most_iterations = 200
    real(wp), parameter :: start = 0.5_wp !! at most, over the densest [1]
    real(wp) :: least, most, here, rate, bend, next
    integer :: i

    least = 0.0_wp
    most = 1.0_wp/fluid%covolume
    if (pressure >= fluid%saturation) then
      call pressure_at(fluid, fluid%saturated, here, rate, bend)
      slope = 1.0_wp/rate
      curvature = 0.0_wp
      amount = fluid%saturated + slope*(pressure - fluid%saturation)
      return
    end if
    if (fluid%saturated > 0.0_wp) most = fluid%saturated
    amount = min(pressure/fluid%energy, start*most)
    do i = 1, most_iterations
      call pressure_at(fluid, amount, here, rate, bend)
      if (here < pressure) then
        least = amount
      else
        most = amount
      end if
      next = amount
      if (rate > 0.0_wp) next = amount - (here - pressure)/rate
      if (.not. (rate > 0.0_wp .and. next > least .and. next < most)) then
        next = merge(amount, 0.5_wp*(least + most), abs(here - pressure) <= spacing(pressure))
      end if
      if (abs(next - amount) <= 2.0_wp*spacing(amount)) exit
      amount = next
    end do
    call pressure_at(fluid, amount, here, rate, bend)
    slope = 1.0_wp/rate
    curvature = -bend*slope**3
  end subroutine amount_at

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
    viscosity = 1.458e-6_wp*temperature**1.5_wp/(temperature + sutherland_temperature)
  end function sutherland_viscosity
end module gfb_gas_law
