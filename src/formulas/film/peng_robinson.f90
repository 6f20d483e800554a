!> The equation of state of Peng and Robinson, at one temperature.
!>
!> $$ p = \frac{R T c}{1 - b c} - \frac{a c^2}{1 + 2 b c - b^2 c^2} $$
!>
!> with the amount c in a volume. Source: [PengRobinson1976]. Above the critical temperature p rises
!> with c, so that each pressure has one c. Below, a vapour is meant, up to its saturation pressure.
module gfb_peng_robinson
  use gfb_kinds, only: wp
  implicit none (type, external)
  private
  public :: peng_robinson, saturate, amount_at, pressure_at

  real(wp), parameter, public :: gas_constant = 8.314462618_wp !! R [J/(mol K)]

  !> A fluid at a temperature.
  type, public :: peng_robinson_type
    real(wp) :: energy = 0.0_wp     !! R T [J/mol]
    real(wp) :: attraction = 0.0_wp !! a [Pa m6/mol2]
    real(wp) :: covolume = 0.0_wp   !! b [m3/mol]
    real(wp) :: saturation = huge(1.0_wp) !! pressure at which it condenses; huge: never [Pa]
    real(wp) :: saturated = 0.0_wp        !! the vapour's amount there [mol/m3]
  end type peng_robinson_type

contains

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
  pure function root(fluid, pressure, least, most) result(amount)
    type(peng_robinson_type), intent(in) :: fluid
    real(wp), intent(in) :: pressure    !! [Pa]
    real(wp), intent(in) :: least, most !! amounts on the branch [mol/m3]
    real(wp) :: amount
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
  elemental function fugacity(fluid, amount) result(logarithm)
    type(peng_robinson_type), intent(in) :: fluid
    real(wp), intent(in) :: amount !! c [mol/m3]
    real(wp) :: logarithm
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
end module gfb_peng_robinson
