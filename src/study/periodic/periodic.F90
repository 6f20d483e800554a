#include "gfb_petsc.h"
!> Orbits of a shaft that close after a period, at one point or along a branch, and what is kept of them: a line an orbit,
!> the orbit itself, and its multipliers.
module gfb_periodic
  use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan, ieee_is_nan
  use gfb_kinds, only: wp
  use gfb_units, only: pi, micrometres
  use gfb_text, only: text
  use gfb_motion_cases, only: periodic_case_type, motion_free
  use gfb_period_map, only: period_map_type, parameter_of, moved_speed, moved_unbalance, moved_mass, period_of, speed_of, driven_at, &
                            dots, length_of, last_step
  use gfb_shooting, only: shoot, find_monodromy, condition_type, whirl_type, find_onset, fixed_parameter
  use gfb_map_derivative, only: floquet_type, model_step, derivative_type, conditions
  use gfb_quantity, only: quantity_type
  use gfb_result_names, only: add_result
  use gfb_signals, only: stop_agreed
  use gfb_case_file, only: case_array_type
  use gfb_reasons, only: reason_type, reason_no_answer, reason_not_reached
  use gfb_run_context, only: run_context_type
  use gfb_orbit_table, only: leading, in_period, in_ratio, in_gap, in_largest, orbit_type, orbit_table_type, words_of_place
  implicit none (type)
  private

  real(wp), parameter :: known = 2.0e-5_wp !! error of a multiplier: that of differences of the map [1]

  real(wp), parameter :: shortest = 1.0e-3_wp !! step of the branch over the longest one [1]
  integer, parameter :: easy = 7, hard = 11    !! iterations after which steps grow, or shrink

  !> The orbits, and where they stand.
  type, public :: periodic_type
    class(period_map_type), allocatable :: map
    type(orbit_table_type) :: table
    type(whirl_type) :: onset                 !! of free ones
    character(len=:), allocatable :: ending   !! why the branch ends before its end
    character(len=:), allocatable :: lacking  !! end of the branch that was asked for and is not reached; empty: it is
    character(len=:), allocatable :: loss     !! how the last orbit is unstable; empty: it is not
    real(wp), allocatable, private :: x(:)    !! the last orbit [1]
    real(wp), allocatable, private :: way(:)  !! where the branch goes from there, of length 1 [1]
    real(wp), allocatable, private :: bend(:) !! change of that over the length of the branch [1]
    type(derivative_type), private :: derivative !! of the map at it
    real(wp), private :: bounds(2) = 0.0_wp   !! of the parameter of a point: begin, end [1]
    real(wp), private :: first_extent = 0.0_wp !! of the first limit cycle [m]
    integer, private :: folds = 0
    logical, private :: subcritical = .false. !! limit cycles begin where the equilibrium is stable
  contains
    procedure :: run => run_periodic, results, add_arrays => add_periodic_arrays
    procedure, private :: begin_forced, begin_free, follow, keep_orbit, phase, turn_way
  end type periodic_type

contains

  !> The parameter at an orbit, in words.
  function value_words(map, x) result(words)
    class(period_map_type), intent(in) :: map !! the map
    real(wp), intent(in) :: x(:) !! the orbit's point [1]
    character(len=:), allocatable :: words
    real(wp) :: value

    value = parameter_of(map, x)
    select case (map%parameter)
    case (moved_speed)
      words = text(value*30.0_wp/pi, 7)//' rpm'
    case (moved_unbalance)
      words = 'unbalance '//text(value, 6)//' kg m'
    case (moved_mass)
      words = 'mass '//text(value, 6)//' kg'
    case default
      words = text(map%driven(moved_speed)*30.0_wp/pi, 7)//' rpm'
    end select
  end function value_words

  !> Another value of the parameter, in words.
  function words_at(map, x, parameter) result(words)
    class(period_map_type), intent(in) :: map !! the map
    real(wp), intent(in) :: x(:) !! any point [1]
    real(wp), intent(in) :: parameter !! as points have it [1]
    character(len=:), allocatable :: words
    words = value_words(map, [x(:size(x) - 1), parameter])
  end function words_at

  !> A step along the branch, not beyond the bounds of the parameter.
  function step_within(bounds, now, rate, step, at_bound) result(taken)
    real(wp), intent(in) :: bounds(2) !! of the parameter of a point [1]
    real(wp), intent(in) :: now, rate !! of the parameter: its value, and its change along the branch [1]
    real(wp), intent(in) :: step !! along the branch [1]
    logical, intent(out) :: at_bound !! the step ends there
    real(wp) :: taken, low, high

    low = minval(bounds)
    high = maxval(bounds)
    taken = step
    if (now + rate*step > high) taken = (high - now)/rate
    if (now + rate*step < low) taken = (low - now)/rate
    at_bound = now + rate*step > high .or. now + rate*step < low
  end function step_within

  !> Fills an orbit whose places are known, and says how it is unstable; empty where it is not.
  !>
  !> A free orbit always has a multiplier of 1, that of a shift along itself, and the onset of whirl two: those nearest to 1 are
  !> left out of the judgement.
  subroutine judge_orbit(map, x, gap, floquet, neutral, orbit, loss)
    class(period_map_type), intent(in) :: map !! the map
    real(wp), intent(in) :: x(:) !! the orbit's point [1]
    real(wp), intent(in) :: gap !! the smallest one of the orbit [m]
    type(floquet_type), intent(in) :: floquet !! its multipliers, none where they are not known
    integer, intent(in) :: neutral !! multipliers that are known to be 1
    type(orbit_type), intent(inout) :: orbit !! with its places
    character(len=:), allocatable, intent(out) :: loss !! of stability
    complex(wp) :: largest
    logical :: counts(size(floquet%value))
    real(wp) :: period, size_of, stable
    integer :: many, i

    period = period_of(map, x)
    counts = .true.
    do i = 1, neutral
      counts(minloc(abs(floquet%value - 1.0_wp), 1, counts)) = .false.
    end do
    size_of = ieee_value(size_of, ieee_quiet_nan)
    stable = size_of
    loss = ''
    if (size(floquet%value) > 0) then
      largest = floquet%value(maxloc(abs(floquet%value), 1, counts))
      size_of = abs(largest)
      if (size_of > 1.0_wp + known) loss = kind_of(largest)
      stable = merge(1.0_wp, 0.0_wp, loss == '')
    end if
    many = min(leading, size(floquet%value))
    orbit%multiplier(:many) = floquet%value(:many)
    orbit%value = [driven_at(map, x), period, 2.0_wp*pi/(period*speed_of(map, x)), gap, size_of, stable, real(map%periods, wp)]
  end subroutine judge_orbit

  !> How an orbit with a multiplier beyond 1 leaves.
  pure function kind_of(multiplier) result(words)
    complex(wp), intent(in) :: multiplier
    character(len=:), allocatable :: words

    if (abs(aimag(multiplier)) > 0.0_wp) then
      words = 'torus (Neimark-Sacker)'
    else if (real(multiplier) > 0.0_wp) then
      words = 'real multiplier above 1'
    else
      words = 'period doubling'
    end if
  end function kind_of

  !> An orbit in words.
  function words_of(orbit, place, clearance, loss) result(words)
    type(orbit_type), intent(in) :: orbit !! complete
    character(len=*), intent(in) :: place(:) !! where it is shown; empty: in the one bearing
    real(wp), intent(in) :: clearance !! C of that [m]
    character(len=*), intent(in) :: loss !! of its stability, or none
    character(len=:), allocatable :: words
    integer :: i

    words = 'orbit '
    do i = 1, size(place)
      if (i > 1) words = words//', '
      words = words//text(orbit%extent(2*i - 1)*micrometres, 4)//' x '//text(orbit%extent(2*i)*micrometres, 4)//' um'
      if (place(i) /= '') words = words//' at '//words_of_place(place(i))
    end do
    if (size(place) == 1) words = words//', over C '//text(orbit%extent(1)/clearance, 3)
    words = words//', frequency ratio '//text(orbit%value(in_ratio), 6)//', smallest film '// &
            text(orbit%value(in_gap)*micrometres, 4)//' um'
    if (.not. ieee_is_nan(orbit%value(in_largest))) words = words//', largest multiplier '//text(orbit%value(in_largest), 5)
    if (loss /= '') words = words//': unstable, '//loss
  end function words_of

  !> Finds the orbits, from an equilibrium on.
  subroutine run_periodic(self, periodic, context, map, bounds, reason)
    class(periodic_type), intent(inout) :: self !! gets them
    type(periodic_case_type), intent(in) :: periodic !! what is asked for
    type(run_context_type), intent(in) :: context !! of the run
    class(period_map_type), allocatable, intent(inout) :: map !! its bearings in equilibrium; becomes its own
    real(wp), intent(in) :: bounds(2) !! of the parameter of a point: begin, end [1]
    type(reason_type), intent(inout) :: reason !! why there is none
    real(wp), allocatable :: y(:)
    logical :: found

    call context%log%heading('orbits')
    self%ending = ''
    self%lacking = ''
    self%loss = ''
    call move_alloc(map, self%map)
    self%bounds = bounds
    self%table%place = self%map%place
    self%x = self%map%rest()
    if (periodic%motion == motion_free) then
      found = self%begin_free(periodic, context)
    else
      found = self%begin_forced(periodic, context)
    end if
    if (found .and. self%map%parameter > 0) call self%follow(periodic, context)
    call context%log%is_within('')
    if (stop_agreed()) then
      call reason%stopped(' after '//text(self%map%periods)//' periods')
    else if (.not. found) then
      reason%code = reason_no_answer
      reason%detail = 'no orbit: '//self%map%problem
      call context%log%tell(reason%words())
    else
      allocate (y(size(self%x)))
      found = self%map%apply(self%x, y, .true.) ! the bearing's state is of the orbit again
      if (self%lacking /= '') then
        reason%code = reason_not_reached
        reason%detail = 'not reached: '//self%lacking//': '//self%ending
        call context%log%tell(reason%words())
      else if (self%ending /= '') then
        call context%log%line(self%ending)
      end if
      if (self%map%parameter > 0) call context%log%line(text(size(self%table%orbit))//' orbits, '//text(self%folds)//' fold(s)')
      call context%log%line(text(self%map%periods)//' periods marched, each in '//text(self%map%steps)//' steps')
    end if
  end subroutine run_periodic

  !> The first forced orbit: some periods from rest, then Newton's method.
  logical function begin_forced(self, periodic, context) result(found)
    class(periodic_type), intent(inout) :: self
    type(periodic_case_type), intent(in) :: periodic
    type(run_context_type), intent(in) :: context
    type(floquet_type) :: floquet
    type(condition_type) :: condition
    real(wp) :: y(size(self%x)), none(size(self%x))
    integer :: i, iterations

    call context%log%is_within('the first orbit')
    condition = fixed_parameter(self%x)
    call self%map%release(self%x)
    found = .true.
    do i = 1, periodic%start_turns
      found = self%map%apply(self%x, y, .false.)
      if (.not. found) return
      self%x = y
    end do
    found = self%map%apply(self%x, y, .false.)
    if (found) found = find_monodromy(self%map, self%x, y, self%derivative, floquet)
    if (found) found = shoot(self%map, condition, self%derivative, self%x, y, iterations)
    if (found) found = self%keep_orbit(periodic, context, y, iterations)
    if (.not. found .or. self%map%parameter == 0) return
    none = 0.0_wp
    allocate (self%way(size(self%x)))
    call model_step(self%map, self%derivative, none, condition%row, [0.0_wp, self%bounds(2) - self%bounds(1)], self%way)
    self%way = self%way/length_of(self%map, self%way)
    self%bend = 0.0_wp*self%way
  end function begin_forced

  !> The first limit cycle: a small one along the mode at the onset of whirl.
  logical function begin_free(self, periodic, context) result(found)
    class(periodic_type), intent(inout) :: self
    type(periodic_case_type), intent(in) :: periodic
    type(run_context_type), intent(in) :: context
    type(floquet_type) :: floquet
    type(condition_type) :: condition
    real(wp) :: y(size(self%x))
    integer :: iterations

    call context%log%is_within('onset of whirl')
    found = find_onset(self%map, self%x, self%bounds(2)*self%map%parameter_scale, self%onset)
    if (.not. found) return
    self%x = self%onset%x
    call context%log%line('onset of whirl at '//value_words(self%map, self%x)//', frequency over the speed ' &
                          //text(self%onset%frequency/speed_of(self%map, self%x), 6))
    self%map%free = .true.
    self%map%period_scale = 2.0_wp*pi/self%onset%frequency
    self%x(size(self%x) - 1) = 1.0_wp
    found = self%map%apply(self%x, y, .true.)
    if (found) found = self%keep_orbit(periodic, context, y, 0)
    if (.not. found) return
    allocate (condition%row(size(self%x), conditions))
    condition%row(:, 1) = aimag(self%onset%mode)
    condition%row(:, 2) = real(self%onset%mode)
    self%way = real(self%onset%mode)/length_of(self%map, condition%row(:, 2))
    self%x = self%x + periodic%first_amplitude*real(self%onset%mode)
    condition%value = dots(self%map, condition%row, self%x)
    found = self%map%apply(self%x, y, .false.)
    if (found) found = find_monodromy(self%map, self%x, y, self%derivative, floquet)
    if (found) found = shoot(self%map, condition, self%derivative, self%x, y, iterations)
    if (found) found = self%keep_orbit(periodic, context, y, iterations)
    if (.not. found) return
    self%first_extent = size_of_orbit(self%table%orbit(2))
    self%subcritical = self%onset%slope*(self%x(size(self%x)) - self%onset%x(size(self%x))) < 0.0_wp
    self%bend = 0.0_wp*self%way
    call self%turn_way(0.0_wp)
  end function begin_free

  !> The direction of the branch at the last orbit, on from the one before.
  subroutine turn_way(self, taken)
    class(periodic_type), intent(inout) :: self
    real(wp), intent(in) :: taken !! length of the last step; 0: not known
    real(wp) :: row(size(self%x), conditions), next(size(self%x)), none(size(self%x))

    row(:, 1) = self%phase(self%x)
    row(:, 2) = self%way
    none = 0.0_wp
    call model_step(self%map, self%derivative, none, row, [0.0_wp, 1.0_wp], next)
    next = next/length_of(self%map, next)
    if (next(size(next))*self%way(size(next)) < 0.0_wp .and. size(self%table%orbit) > 2) self%folds = self%folds + 1
    if (taken > 0.0_wp) self%bend = (next - self%way)/taken
    self%way = next
  end subroutine turn_way

  !> What must not change from orbit to orbit: the period of a forced one; of a free one its shift along itself.
  function phase(self, x) result(row)
    class(periodic_type), intent(in) :: self
    real(wp), intent(in) :: x(:)
    real(wp) :: row(size(x))

    row = 0.0_wp
    if (.not. self%map%free) then
      row(size(x) - 1) = 1.0_wp
      return
    end if
    row = last_step(self%map, x)
    row = row/length_of(self%map, row)
  end function phase

  !> From orbit to orbit by arc length, until the parameter has come to one of its bounds.
  subroutine follow(self, periodic, context)
    class(periodic_type), intent(inout) :: self
    type(periodic_case_type), intent(in) :: periodic
    type(run_context_type), intent(in) :: context
    type(condition_type) :: condition
    type(derivative_type) :: learnt
    real(wp) :: x(size(self%x)), y(size(self%x)), step, taken
    integer :: iterations, last
    logical :: at_bound, found

    step = 0.3_wp*periodic%step
    last = size(x)
    allocate (condition%row(last, conditions))
    do while (size(self%table%orbit) < periodic%points)
      taken = step_within(self%bounds, self%x(last), self%way(last), step, at_bound)
      x = self%x + taken*self%way
      condition%row(:, 1) = self%phase(self%x)
      condition%row(:, 2) = self%way
      if (at_bound) condition%row(:, 2) = 0.0_wp
      if (at_bound) condition%row(last, 2) = 1.0_wp
      condition%value = dots(self%map, condition%row, x)
      if (.not. at_bound) x = x + 0.5_wp*taken**2*self%bend
      call context%log%is_within('orbit '//text(size(self%table%orbit) + 1)//', from '//value_words(self%map, self%x)//' on')
      learnt = self%derivative
      found = shoot(self%map, condition, learnt, x, y, iterations)
      if (stop_agreed()) return
      if (found) then
        self%ending = self%map%touches_down()
        if (self%ending /= '') then
          self%lacking = words_at(self%map, self%x, self%bounds(2))
          return
        end if
        found = is_near(self, x, taken)
      end if
      if (found) then
        call swap(self%x, x)
        found = self%keep_orbit(periodic, context, y, iterations)
        if (.not. found) call swap(self%x, x)
      end if
      if (found) then
        if (at_bound) return
        if (is_small(self)) then
          self%ending = 'the limit cycle has shrunk to an equilibrium'
          return
        end if
        call self%turn_way(taken)
        if (iterations <= easy) step = min(1.5_wp*step, periodic%step)
        if (iterations >= hard) step = 0.7_wp*step
      else
        step = 0.5_wp*taken
        if (step < shortest*periodic%step) then
          self%ending = 'no orbit was found beyond '//value_words(self%map, self%x)//': '//self%map%problem
          self%lacking = words_at(self%map, self%x, self%bounds(2))
          return
        end if
      end if
    end do
    self%ending = 'the branch has as many points as were asked for'
  end subroutine follow

  !> Whether an orbit that was found is that of the branch: near to where it was looked for.
  logical function is_near(self, x, taken) result(near)
    class(periodic_type), intent(inout) :: self
    real(wp), intent(in) :: x(:), taken
    real(wp) :: off(size(x))

    off = x - self%x - taken*self%way
    near = length_of(self%map, off) < max(taken, 1.0e-3_wp)
    if (.not. near) self%map%problem = 'the orbit found is on another branch'
  end function is_near

  !> Sum of an orbit's extents, of all places [m].
  real(wp) function size_of_orbit(orbit) result(all)
    type(orbit_type), intent(in) :: orbit
    integer :: i

    all = 0.0_wp
    do i = 1, size(orbit%place, 1)
      all = all + orbit%extent(i)
    end do
  end function size_of_orbit

  !> Whether a limit cycle is next to an equilibrium again.
  logical function is_small(self) result(small)
    class(periodic_type), intent(in) :: self
    real(wp), parameter :: share = 0.3_wp !! of the first one

    small = .false.
    if (.not. self%map%free) return
    small = size_of_orbit(self%table%orbit(size(self%table%orbit))) < share*self%first_extent
  end function is_small

  !> Learns the map at an orbit that was found, and keeps the orbit; `.false.` where the map fails beside it.
  logical function keep_orbit(self, periodic, context, y, iterations) result(done)
    class(periodic_type), intent(inout) :: self !! at the orbit
    type(periodic_case_type), intent(in) :: periodic !! what is asked for
    type(run_context_type), intent(in) :: context !! of the run
    real(wp), intent(in) :: y(:) !! what the orbit is mapped to [1]
    integer, intent(in) :: iterations !! that found it
    type(orbit_type) :: orbit
    type(floquet_type) :: floquet
    real(wp) :: gap
    integer :: neutral

    call move_alloc(self%map%orbit, orbit%place)
    gap = self%map%smallest_gap
    done = .true.
    if (any(self%map%film%rubs)) then ! differences of the map see one side of a contact's stick and slip alone
      allocate (floquet%value(0))
    else
      done = find_monodromy(self%map, self%x, y, self%derivative, floquet)
    end if
    if (.not. done) return
    neutral = 0
    if (self%map%free) neutral = merge(1, 2, allocated(self%table%orbit))
    call judge_orbit(self%map, self%x, gap, floquet, neutral, orbit, self%loss)
    if (neutral > 1) then ! Krylov's method cannot part a pair that is equal: by the map of a turn
      associate (rate => cmplx(self%onset%growth*orbit%value(1), self%onset%frequency, wp))
        orbit%multiplier(:2) = [exp(rate*orbit%value(in_period)), exp(conjg(rate)*orbit%value(in_period))]
      end associate
    end if
    call self%table%add(orbit)
    call context%log%judged(value_words(self%map, self%x)//': '//words_of(orbit, self%map%place, self%map%scale(1), self%loss)// &
                            ', '//text(iterations)//' iterations', self%loss == '')
  end function keep_orbit

  !> Exchanges two points.
  pure subroutine swap(one, other)
    real(wp), intent(inout) :: one(:), other(:)
    real(wp) :: copy(size(one))

    copy = one
    one = other
    other = copy
  end subroutine swap

  !> What the summary says of the last orbit, and of the branch.
  function results(self) result(found)
    class(periodic_type), intent(in) :: self !! the orbits
    type(quantity_type), allocatable :: found(:)
    integer :: i

    allocate (found(0))
    if (.not. allocated(self%table%orbit)) return
    associate (last => self%table%orbit(size(self%table%orbit)))
      call add_result(found, 'frequency_ratio', last%value(in_ratio))
      do i = 1, size(last%place, 1)
        call add_result(found, self%table%name_of('orbit_', i), last%extent(i))
      end do
      call add_result(found, 'minimum_gap_over_time', last%value(in_gap))
      if (.not. any(self%map%film%rubs)) call add_result(found, 'largest_multiplier', last%value(in_largest))
    end associate
    if (.not. any(self%map%film%rubs)) call add_result(found, 'orbit_stable', self%loss == '')
    if (self%loss /= '') call add_result(found, 'stability_loss', self%loss)
    if (self%map%free .and. self%map%parameter == moved_speed) then
      call add_result(found, 'onset_speed_rpm', parameter_of(self%map, self%onset%x)*30.0_wp/pi)
    else if (self%map%free) then
      call add_result(found, 'critical_mass', parameter_of(self%map, self%onset%x))
    end if
    if (self%map%free) call add_result(found, 'subcritical', self%subcritical)
    if (self%ending /= '') call add_result(found, 'ending', self%ending)
    if (self%lacking /= '') call add_result(found, 'not_reached', self%lacking)
  end function results

  !> Adds the table of orbits to what the result file gets.
  subroutine add_periodic_arrays(self, arrays)
    class(periodic_type), intent(in) :: self !! the orbits
    type(case_array_type), allocatable, intent(inout) :: arrays(:) !! get a dataset a name
    call self%table%add_arrays(arrays)
  end subroutine add_periodic_arrays
end module gfb_periodic
