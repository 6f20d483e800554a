!> Integrals of a gas over its pressure, as a flow through a resistance asks for them.
!>
!> $$ I_1 = \int r \, dp, \quad I_2 = \int \frac{r}{\mu} \, dp, \quad I_3 = \int \frac{dp}{r} $$
!>
!> with the density r of `gfb_gas_law`. Gauss and Legendre's rule with 16 points in each panel: a
!> table has one between two of its places, where it is smooth. Peng and Robinson's gas is
!> integrated over the logarithm of its amount, \( dp = p'(c) \, c \, d \ln c \), of which all is
!> a smooth function even where the density rises steeply with the pressure: carbon dioxide at 310 K
!> from 2 to 8 MPa to the last digits, from 0.1 to 20 MPa to 1e-6.
module gfb_gas_integrals
  use gfb_kinds, only: wp
  use gfb_gas_law, only: gas_law_type, gas_state_type, gas_state, amount_at, pressure_at, &
                         density_peng_robinson, density_table
  implicit none (type, external)
  private
  public :: gas_integrals

  integer, parameter, public :: of_density = 1   !! \( I_1 \) [Pa2]
  integer, parameter, public :: of_flow = 2      !! \( I_2 \), over the viscosity [Pa/s]
  integer, parameter, public :: of_volume = 3    !! \( I_3 \), of the inverse [1]
  integer, parameter, public :: integrals = 3

  integer, parameter :: half = 8 !! of the points of a panel
  real(wp), parameter :: place(half) = &
    [0.0950125098376375_wp, 0.2816035507792589_wp, 0.4580167776572274_wp, 0.6178762444026438_wp, &
    0.7554044083550030_wp, 0.8656312023878318_wp, 0.9445750230732326_wp, 0.9894009349916499_wp]
  real(wp), parameter :: weight(half) = &
    [0.1894506104550686_wp, 0.1826034150449236_wp, 0.1691565193950026_wp, 0.1495959888165768_wp, &
    0.1246289712555340_wp, 0.0951585116824926_wp, 0.0622535239386477_wp, 0.0271524594117540_wp]

contains

  !> The integrals from one pressure to another, which may be less.
  pure function gas_integrals(law, from, to) result(integral)
    type(gas_law_type), intent(in) :: law !! of the gas
    real(wp), intent(in) :: from, to      !! [Pa]
    real(wp) :: integral(integrals)
    real(wp) :: low, high
    integer :: i

    low = min(from, to)
    high = max(from, to)
    integral = 0.0_wp
    if (law%density == density_peng_robinson) then
      associate (saturation => law%fluid%saturation)
        if (low < saturation) integral = over_amounts(law, low, min(high, saturation))
        if (high > saturation) integral = integral + over_pressures(law, max(low, saturation), high)
      end associate
    else if (law%density == density_table) then
      associate (knot => law%density_curve%place)
        do i = 1, size(knot)
          if (knot(i) <= low .or. knot(i) >= high) cycle
          integral = integral + over_pressures(law, low, knot(i))
          low = knot(i)
        end do
      end associate
      integral = integral + over_pressures(law, low, high)
    else
      integral = over_pressures(law, low, high)
    end if
    if (to < from) integral = -integral
  end function gas_integrals

  !> Their parts between two pressures.
  pure function over_pressures(law, low, high) result(integral)
    type(gas_law_type), intent(in) :: law
    real(wp), intent(in) :: low, high !! [Pa]
    real(wp) :: integral(integrals)
    type(gas_state_type) :: gas
    integer :: i, k

    integral = 0.0_wp
    do i = 1, half
      do k = -1, 1, 2
        gas = gas_state(law, 0.5_wp*(low + high) + 0.5_wp*(high - low)*real(k, wp)*place(i))
        integral = integral &
          + 0.5_wp*(high - low)*weight(i)*[gas%r, gas%r/gas%mu, 1.0_wp/gas%r]
      end do
    end do
  end function over_pressures

  !> The same by the logarithm of the amount in a volume, of Peng and Robinson's gas up to its
  !> saturation.
  pure function over_amounts(law, low, high) result(integral)
    type(gas_law_type), intent(in) :: law
    real(wp), intent(in) :: low, high !! [Pa]
    real(wp) :: integral(integrals)
    real(wp) :: ends(2), amount, r, mu, pressure, slope, curvature
    real(wp), dimension(2) :: slopes, curvatures
    integer :: i, k

    call amount_at(law%fluid, [low, high], ends, slopes, curvatures)
    ends = log(ends)
    integral = 0.0_wp
    do i = 1, half
      do k = -1, 1, 2
        amount = exp(0.5_wp*sum(ends) + 0.5_wp*(ends(2) - ends(1))*real(k, wp)*place(i))
        call pressure_at(law%fluid, amount, pressure, slope, curvature)
        r = law%unit*amount
        mu = law%viscosity*(r/law%ambient_pressure)**law%viscosity_exponent
        integral = integral &
          + 0.5_wp*(ends(2) - ends(1))*weight(i)*slope*amount*[r, r/mu, 1.0_wp/r]
      end do
    end do
  end function over_amounts
end module gfb_gas_integrals
