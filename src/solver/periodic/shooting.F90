#include "gfb_petsc.h"
!> Orbits that close after a period: Newton's method on \( G(x) - x \), and the Floquet multipliers.
!>
!> The film forgets most of a state within a turn, so the map's derivative M has few directions that count. Arnoldi's method
!> finds them from differences of the map: an orthonormal basis V with \( M V = W \). Outside of it M is taken as nothing, and
!> the steps taken since are learnt by Broyden's formula (Newton-Picard). The eigenvalues of \( V^T W \) are the multipliers.
!>
!> Period and parameter are entries of x like all others, and two linear equations close the system: a given value, a phase,
!> an arc length.
!>
!> Where a shaft begins to whirl as a parameter changes: the equilibrium's least damped mode, by the map of one turn.
!>
!> A mode of rate lambda has the multiplier exp(lambda T). The turns that it makes in T, of which the multiplier says nothing,
!> are known from the place one step ago, which is part of its vector.
module gfb_shooting
  use gfb_kinds, only: wp
  use gfb_units, only: pi
  use gfb_text, only: text
  use gfb_period_map, only: period_map_type, dots, length_of, period_of, speed_of, parameter_of
  use gfb_map_derivative, only: derivative_type, floquet_type, conditions, add_column, learn_step, model_step, find_multipliers
  implicit none (type)
  private
  public :: shoot, find_monodromy, find_onset, fixed_parameter

  real(wp), parameter :: closed = 1.0e-11_wp     !! an orbit, and its conditions [1]
  real(wp), parameter :: nearly = 1.0e-9_wp      !! the same along a branch, or where round-off ends it [1]
  real(wp), parameter :: round_off = 0.3_wp      !! of an opening, over that of the step before [1]
  real(wp), parameter :: difference = 2.0e-6_wp  !! of points whose maps are subtracted [1]
  real(wp), parameter :: settled = 1.0e-6_wp     !! residual of a multiplier that is found [1]
  real(wp), parameter :: longest = 0.5_wp        !! step of a point [1]
  integer, parameter :: least_basis = 6, most_basis = 24 !! columns of Arnoldi's method
  integer, parameter :: most_iterations = 20
  integer, parameter :: most_halvings = 4        !! of a step whose orbit does not get round

  !> The two equations that close the system: row(:, i) times x is value(i).
  type, public :: condition_type
    real(wp), allocatable :: row(:, :) !! (entries, conditions) [1]
    real(wp) :: value(conditions) = 0.0_wp !! [1]
  end type condition_type

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

  !> From a point near an orbit to the orbit; `.false.` where none is found.
  logical function shoot(map, condition, derivative, x, y, iterations) result(found)
    class(period_map_type), intent(inout) :: map !! the map
    type(condition_type), intent(in) :: condition !! that close the system
    type(derivative_type), intent(inout) :: derivative !! learns from each iteration
    real(wp), intent(inout) :: x(:) !! the point, then the orbit [1]
    real(wp), intent(out) :: y(:)   !! what it is mapped to [1]
    integer, intent(out) :: iterations !! periods marched
    real(wp) :: step(size(x)), before(size(x)), size_of_step, open, opened
    integer :: halvings

    found = .false.
    open = huge(open)
    step = 0.0_wp
    before = 0.0_wp
    halvings = 0
    do iterations = 1, most_iterations
      if (map%apply(x, y, .true.)) then
        if (iterations > 1) call learn_step(map, step, y - step_free(before, x, y), derivative)
        opened = open
        open = opening(map, condition, x, y)
        found = open < merge(nearly, closed, map%parameter > 0 .or. open > round_off*opened)
        if (found) return
        call model_step(map, derivative, y - x, condition%row, condition%value - dots(map, condition%row, x), step)
        size_of_step = length_of(map, step)
        if (.not. size_of_step < huge(1.0_wp)) return
        if (size_of_step > longest) step = step*longest/size_of_step
        before = y
        halvings = 0
      else
        halvings = halvings + 1
        if (iterations == 1 .or. halvings > most_halvings) return
        x = x - step
        step = 0.5_wp*step
      end if
      x = x + step
    end do
    map%problem = 'the orbit does not close in '//text(most_iterations)//' periods'
  end function shoot

  !> What the map of the step before was: its period and parameter do not count.
  pure function step_free(before, x, y) result(rest)
    real(wp), intent(in) :: before(:), x(:), y(:)
    real(wp) :: rest(size(before))

    rest = before
    rest(size(x) - 1:) = y(size(x) - 1:)
  end function step_free

  !> How far a point is from an orbit, and from its conditions.
  real(wp) function opening(map, condition, x, y) result(open)
    class(period_map_type), intent(in) :: map
    type(condition_type), intent(in) :: condition
    real(wp), intent(in) :: x(:), y(:)

    open = length_of(map, y - x)
    open = max(open, maxval(abs(condition%value - dots(map, condition%row, x))))
  end function opening

  !> The map's derivative at an orbit, from nothing, and its multipliers; `.false.` where the map fails beside it.
  logical function find_monodromy(map, x, y, derivative, floquet) result(done)
    class(period_map_type), intent(inout) :: map !! the map
    real(wp), intent(in) :: x(:) !! the orbit [1]
    real(wp), intent(in) :: y(:) !! what it is mapped to [1]
    type(derivative_type), intent(out) :: derivative !! from nothing
    type(floquet_type), intent(out) :: floquet !! of the orbit
    real(wp) :: direction(size(x)), image(size(x)), length, beside
    real(wp), allocatable :: inner(:, :), share(:)
    integer :: k, i, entry

    allocate (derivative%basis(size(x), 0), derivative%image(size(x), 0), inner(most_basis, most_basis))
    inner = 0.0_wp
    direction = 0.0_wp
    direction(size(x) - map%tail + 1:size(x) - 2) = map%start
    direction = direction/norm2(direction)
    do k = 1, most_basis
      done = image_of(map, x, y, direction, image)
      if (.not. done) return
      call add_column(direction, image, derivative)
      direction = image
      do i = 1, 2 ! once more for what rounding has left
        share = dots(map, derivative%basis, direction)
        inner(:k, k) = inner(:k, k) + share
        direction = direction - matmul(derivative%basis, share)
      end do
      length = length_of(map, direction)
      call find_multipliers(derivative, inner(:k, :k), length, floquet, beside)
      if (k >= least_basis .and. beside < settled .or. .not. length > difference) exit
      if (k == most_basis) exit
      inner(k + 1, k) = length
      direction = direction/length
    end do
    do entry = size(x) - 1, size(x)
      if (entry < size(x) .and. .not. map%free) cycle
      if (entry == size(x) .and. map%parameter == 0) cycle
      direction = 0.0_wp
      direction(entry) = 1.0_wp
      done = image_of(map, x, y, direction, image)
      if (.not. done) return
      call add_column(direction, image, derivative)
    end do
  end function find_monodromy

  !> What a direction is mapped to, by a difference of the map.
  logical function image_of(map, x, y, direction, image) result(done)
    class(period_map_type), intent(inout) :: map
    real(wp), intent(in) :: x(:), y(:), direction(:)
    real(wp), intent(out) :: image(:)

    done = map%apply(x + difference*direction, image, .false.)
    image = (image - y)/difference
    image(size(x) - 1:) = 0.0_wp
  end function image_of

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
  logical function find_onset(map, x, final_value, onset) result(found)
    class(period_map_type), intent(inout) :: map !! of one turn, not free
    real(wp), intent(in) :: x(:) !! equilibrium, to begin with [1]
    real(wp), intent(in) :: final_value !! of the parameter [its unit]
    type(whirl_type), intent(out) :: onset
    type(whirl_type) :: low, high, trial
    real(wp) :: way, share
    integer :: i

    found = look_at(map, x, parameter_of(map, x), low)
    if (.not. found) return
    way = (final_value - parameter_of(map, x))/stretches
    do i = 1, stretches
      found = look_at(map, low%x, parameter_of(map, low%x) + way, high)
      if (.not. found) return
      if ((low%growth > 0.0_wp) .neqv. (high%growth > 0.0_wp)) exit
      low = high
    end do
    found = i <= stretches
    map%problem = 'no onset of whirl on the way of the parameter'
    if (.not. found) return
    do i = 1, most_trials
      share = low%growth/(low%growth - high%growth)
      found = look_at(map, low%x, (1.0_wp - share)*parameter_of(map, low%x) &
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
    found = refine(map, (high%growth - low%growth)/(parameter_of(map, high%x) - parameter_of(map, low%x)), trial)
    onset = trial
  end function find_onset

  !> The onset again in steps of which whole ones are a period of the whirl: those of its limit cycles.
  logical function refine(map, slope, onset) result(found)
    class(period_map_type), intent(inout) :: map !! gets the steps of that period
    real(wp), intent(in) :: slope !! of the growth over the parameter
    type(whirl_type), intent(inout) :: onset
    integer, parameter :: times = 2
    type(whirl_type) :: trial
    real(wp) :: steps
    integer :: i, steps_of_turn

    steps_of_turn = map%steps
    found = .true.
    do i = 0, times
      steps = steps_of_turn*speed_of(map, onset%x)/onset%frequency
      map%stretch = steps/nint(steps)
      if (i == times) exit
      found = look_at(map, onset%x, parameter_of(map, onset%x) - merge(0.0_wp, onset%growth/slope, i == 0), trial)
      if (.not. found) return
      trial%slope = onset%slope
      onset = trial
    end do
    onset%x(size(onset%x)) = onset%x(size(onset%x)) - onset%growth/slope/map%parameter_scale
    map%steps = nint(steps)
  end function refine

  !> The equilibrium at a value of the parameter, and its least damped mode.
  logical function look_at(map, x, value, whirl) result(found)
    class(period_map_type), intent(inout) :: map
    real(wp), intent(in) :: x(:) !! an equilibrium near by
    real(wp), intent(in) :: value !! [its unit]
    type(whirl_type), intent(out) :: whirl
    type(derivative_type) :: derivative
    type(floquet_type) :: floquet
    type(condition_type) :: condition
    real(wp) :: y(size(x))
    integer :: periods

    whirl%x = x
    whirl%x(size(x)) = value/map%parameter_scale
    condition = fixed_parameter(whirl%x)
    allocate (derivative%basis(size(x), 0), derivative%image(size(x), 0))
    found = shoot(map, condition, derivative, whirl%x, y, periods)
    if (.not. found) return
    found = find_monodromy(map, whirl%x, y, derivative, floquet)
    if (.not. found) return
    call take_mode(map, floquet, whirl)
    found = whirl%frequency > 0.0_wp
    map%problem = 'the equilibrium has no mode that whirls'
  end function look_at

  !> The mode that grows most among those that whirl.
  subroutine take_mode(map, floquet, whirl)
    class(period_map_type), intent(in) :: map
    type(floquet_type), intent(in) :: floquet
    type(whirl_type), intent(inout) :: whirl
    complex(wp) :: now(size(map%scale)), before(size(map%scale))
    real(wp) :: period, speed, seen, frequency, growth, best
    integer :: i, shaft

    period = period_of(map, whirl%x)
    speed = speed_of(map, whirl%x)
    shaft = map%local
    best = -huge(best)
    do i = 1, size(floquet%value)
      if (abs(floquet%value(i)) < visible) cycle
      now = floquet%vector(shaft + 1:shaft + size(now), i)
      before = floquet%vector(shaft + size(now) + 1:shaft + 2*size(now), i)
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
end module gfb_shooting
