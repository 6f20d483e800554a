#include "gfb_petsc.h"
!> Where a shaft begins to whirl as a parameter changes: the equilibrium's least damped mode, by the map of one turn.
!>
!> A mode of rate lambda has the multiplier exp(lambda T). The turns that it makes in T, of which the multiplier says nothing,
!> are known from the place one step ago, which is part of its vector.
module gfb_whirl_onset
  use gfb_kinds, only: wp
  use gfb_shaft_drive, only: shaft_drive_type
  use gfb_bearing_system, only: bearing_system_type
  use gfb_newton, only: newton_type
  use gfb_period_map, only: period_map_type, period_of, drive_at, parameter_of, tail
  use gfb_shooting, only: shoot, learn_map, derivative_type, condition_type, floquet_type, conditions
  implicit none (type)
  private
  public :: find_onset, fixed_parameter

  real(wp), parameter :: pi = acos(-1.0_wp)
  real(wp), parameter :: visible = 0.02_wp  !! multiplier of a mode that is looked at [1]
  real(wp), parameter :: slow = 0.05_wp     !! whirl over the speed that is none [1]
  real(wp), parameter :: neutral = 1.0e-7_wp !! growth over the speed that is none [1]
  integer, parameter :: stretches = 8       !! in which a change of sign is looked for
  integer, parameter :: most_trials = 12    !! then

  !> An equilibrium and its least damped mode.
  type, public :: whirl_type
    real(wp), allocatable :: x(:)        !! the equilibrium [1]
    real(wp) :: growth = 0.0_wp          !! over the speed [1]
    real(wp) :: frequency = 0.0_wp       !! [rad/s]
    real(wp) :: slope = 0.0_wp           !! sign of the growth over the parameter
    complex(wp), allocatable :: mode(:)  !! as a point, its places of length 1 [1]
  end type whirl_type

contains

  !> The conditions that keep period and parameter as they are at a point.
  pure function fixed_parameter(x) result(condition)
    real(wp), intent(in) :: x(:) !! the point [1]
    type(condition_type) :: condition

    allocate (condition%row(size(x), conditions), source=0.0_wp)
    condition%row(size(x) - 1, 1) = 1.0_wp
    condition%row(size(x), 2) = 1.0_wp
    condition%value = x(size(x) - 1:)
  end function fixed_parameter

  !> The first value of the parameter, from that of a point on, at which the growth of its equilibrium changes its sign.
  function find_onset(map, bearing, newton, x, final_value, onset) result(found)
    type(period_map_type), intent(inout) :: map !! of one turn, not free
    type(bearing_system_type), target, intent(inout) :: bearing !! what is mapped
    type(newton_type), target, intent(inout) :: newton !! its solver
    real(wp), intent(in) :: x(:) !! equilibrium, to begin with [1]
    real(wp), intent(in) :: final_value !! of the parameter [its unit]
    type(whirl_type), intent(out) :: onset
    logical :: found
    type(whirl_type) :: low, high, trial
    real(wp) :: way, share
    integer :: i

    found = look_at(map, bearing, newton, x, parameter_of(map, x), low)
    if (.not. found) return
    way = (final_value - parameter_of(map, x))/stretches
    do i = 1, stretches
      found = look_at(map, bearing, newton, low%x, parameter_of(map, low%x) + way, high)
      if (.not. found) return
      if ((low%growth > 0.0_wp) .neqv. (high%growth > 0.0_wp)) exit
      low = high
    end do
    found = i <= stretches
    map%problem = 'no onset of whirl on the way of the parameter'
    if (.not. found) return
    do i = 1, most_trials
      share = low%growth/(low%growth - high%growth)
      found = look_at(map, bearing, newton, low%x, (1.0_wp - share)*parameter_of(map, low%x) &
                      + share*parameter_of(map, high%x), trial)
      if (.not. found) return
      trial%slope = sign(1.0_wp, (high%growth - low%growth)*(parameter_of(map, high%x) - parameter_of(map, low%x)))
      if (abs(trial%growth) < neutral) exit
      if ((trial%growth > 0.0_wp) .eqv. (low%growth > 0.0_wp)) then
        low = trial
      else
        high = trial
      end if
    end do
    found = refine(map, bearing, newton, (high%growth - low%growth)/(parameter_of(map, high%x) - parameter_of(map, low%x)), trial)
    onset = trial
  end function find_onset

  !> The onset again in steps of which whole ones are a period of the whirl: those of its limit cycles.
  function refine(map, bearing, newton, slope, onset) result(found)
    type(period_map_type), intent(inout) :: map !! gets the steps of that period
    type(bearing_system_type), target, intent(inout) :: bearing
    type(newton_type), target, intent(inout) :: newton
    real(wp), intent(in) :: slope !! of the growth over the parameter
    type(whirl_type), intent(inout) :: onset
    logical :: found
    integer, parameter :: times = 2
    type(shaft_drive_type) :: drive
    type(whirl_type) :: trial
    real(wp) :: steps
    integer :: i, steps_of_turn

    steps_of_turn = map%steps
    found = .true.
    do i = 0, times
      drive = drive_at(map, onset%x)
      steps = steps_of_turn*drive%speed/onset%frequency
      map%stretch = steps/nint(steps)
      if (i == times) exit
      found = look_at(map, bearing, newton, onset%x, parameter_of(map, onset%x) - merge(0.0_wp, onset%growth/slope, i == 0), trial)
      if (.not. found) return
      trial%slope = onset%slope
      onset = trial
    end do
    onset%x(size(onset%x)) = onset%x(size(onset%x)) - onset%growth/slope/map%parameter_scale
    map%steps = nint(steps)
  end function refine

  !> The equilibrium at a value of the parameter, and its least damped mode.
  function look_at(map, bearing, newton, x, value, whirl) result(found)
    type(period_map_type), intent(inout) :: map
    type(bearing_system_type), target, intent(inout) :: bearing
    type(newton_type), target, intent(inout) :: newton
    real(wp), intent(in) :: x(:) !! an equilibrium near by
    real(wp), intent(in) :: value !! [its unit]
    type(whirl_type), intent(out) :: whirl
    logical :: found
    type(derivative_type) :: derivative
    type(floquet_type) :: floquet
    type(condition_type) :: condition
    real(wp) :: y(size(x))
    integer :: periods

    whirl%x = x
    whirl%x(size(x)) = value/map%parameter_scale
    condition = fixed_parameter(whirl%x)
    allocate (derivative%basis(size(x), 0), derivative%image(size(x), 0))
    found = shoot(map, bearing, newton, condition, derivative, whirl%x, y, periods)
    if (.not. found) return
    found = learn_map(map, bearing, newton, whirl%x, y, derivative, floquet)
    if (.not. found) return
    call take_mode(map, floquet, whirl)
    found = whirl%frequency > 0.0_wp
    map%problem = 'the equilibrium has no mode that whirls'
  end function look_at

  !> The mode that grows most among those that whirl.
  subroutine take_mode(map, floquet, whirl)
    type(period_map_type), intent(in) :: map
    type(floquet_type), intent(in) :: floquet
    type(whirl_type), intent(inout) :: whirl
    type(shaft_drive_type) :: drive
    complex(wp) :: now(2), before(2)
    real(wp) :: period, speed, seen, frequency, growth, best
    integer :: i, shaft

    period = period_of(map, whirl%x)
    drive = drive_at(map, whirl%x)
    speed = drive%speed
    shaft = size(whirl%x) - tail
    best = -huge(best)
    do i = 1, size(floquet%value)
      if (abs(floquet%value(i)) < visible) cycle
      now = floquet%vector(shaft + 1:shaft + 2, i)
      before = floquet%vector(shaft + 3:shaft + 4, i)
      seen = atan2(aimag(dot_product(before, now)), real(dot_product(before, now)))*map%steps/period
      frequency = atan2(aimag(floquet%value(i)), real(floquet%value(i)))
      frequency = (frequency + 2.0_wp*pi*nint((seen*period - frequency)/(2.0_wp*pi)))/period
      growth = log(abs(floquet%value(i)))/period
      if (frequency < slow*speed .or. growth < best) cycle
      best = growth
      whirl%growth = growth/speed
      whirl%frequency = frequency
      whirl%mode = floquet%vector(:, i)/sqrt(sum(abs(now)**2))
    end do
  end subroutine take_mode
end module gfb_whirl_onset
