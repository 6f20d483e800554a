#include "gfb_petsc.h"
!> A bearing and its shaft over time, by a Runge-Kutta method of order 4 (`gfb_runge_kutta`).
!>
!> Each stage is the march's difference over a past of its own: all that has one (`gfb_stage_memory`) is put where the stages before
!> lead it, and the equations of a step of time are solved with the factor 1/(a_ii step). So a stage costs what a step of second order
!> costs, and all stages of steps alike share their factors.
!>
!> Rates at the beginning of a step are those that the step before has left. Where there are none, at the first step, from a restart
!> file or behind a jump of what drives the shaft, a backward step of Euler finds them, so short that it leaves the state where it is.
!>
!> Friction carries its slip along at every stage that no later one lies before: a step of a twentieth of a turn would miss where
!> contacts turn back.
module gfb_stage_march
  use petscvec
  use gfb_kinds, only: wp
  use gfb_backward_difference, only: next_step, kept_times
  use gfb_runge_kutta, only: stages, diagonal, stage_weight, stage_time, error_weight, is_passed, interpolation_weights
  use gfb_film_load, only: film_forces
  use gfb_contact_set, only: contact_set_type
  use gfb_march_state, only: march_type, allowed_step, usual_step, largest_way
  use gfb_time_march, only: prepare_difference, keep_step, drive_at, place_of, look_at_pad, tolerance_of_step
  use gfb_stage_memory, only: read_memory, put_memory, place_entries
  use gfb_bearing_system, only: bearing_system_type
  use gfb_bearing_motion, only: end_step
  use gfb_newton, only: newton_type, newton_report_type, newton_settings_type, solve_nearby
  implicit none (type)
  private
  public :: take_step_by_stages

  real(wp), parameter :: rejected = 2.0_wp !! error over the largest one that is not accepted [1]
  integer, parameter :: most_trials = 12   !! of one step
  real(wp), parameter :: shortest = 1.0e-4_wp !! Euler's step over the usual one: its error is half of that of a rate [1]
  !> Error of the embedded method over that of the step, as it is assumed where equations are solved to a part of the latter. On springs
  !> and beams, with friction and without, 20 steps a turn take up to a quarter less iterations by it in five cases of five [1].
  real(wp), parameter :: error_over_own = 10.0_wp
  integer, parameter :: most_known = 6     !! stages before that the next one may be predicted from
  integer, parameter :: film_points = 3, foil_points = 2 !! of these: the nearest in time

contains

  !> One step; shorter where it does not converge or is too inaccurate. As `take_step` of `gfb_time_march`.
  subroutine take_step_by_stages(march, bearing, newton, report)
    type(march_type), intent(inout) :: march !! its past and its next step
    type(bearing_system_type), target, intent(inout) :: bearing !! at the newest state
    type(newton_type), target, intent(inout) :: newton !! its solver
    type(newton_report_type), intent(out) :: report !! of the last trial
    type(contact_set_type), allocatable :: contacts(:)
    real(wp), allocatable :: base(:), rate(:, :)
    real(wp) :: step, error, before(film_forces, kept_times), last_velocity(film_forces)
    Vec :: past
    PetscErrorCode :: ierr
    integer :: trial, i

    step = allowed_step(march)
    PetscCallA(VecDuplicate(bearing%state, past, ierr))
    PetscCallA(VecCopy(bearing%state, past, ierr))
    base = read_memory(march, bearing, past)
    before = march%place
    last_velocity = march%velocity(:, 1)
    if (bearing%is_meshed()) then
      allocate (contacts(size(bearing%pad)))
      do i = 1, size(contacts)
        contacts(i) = bearing%pad(i)%foil%contacts
      end do
    end if
    do trial = 1, most_trials
      call take_stages(march, bearing, newton, past, step, base, rate, report)
      if (report%converged) then
        march%error = step*largest_way(march, matmul(rate(place_entries(1):place_entries(2), :), error_weight))
        error = march%error/(march%settings%tolerance*bearing%clearance)
        if (march%settings%steps_per_turn > 0.0_wp .or. error < rejected) exit
        step = next_step(step, error)
      else
        step = 0.5_wp*step
      end if
      march%rejections = march%rejections + 1
      call go_back(march, bearing, past, base, contacts)
    end do
    if (report%converged .and. trial > most_trials) then
      report%converged = .false.
      report%reason = 'the error of a step stays too large'
    end if
    if (report%converged) then
      march%place(:, 2:) = before(:, :kept_times - 1)
      march%velocity(:, 2) = last_velocity
      call keep_step(march, step, bearing)
      if (bearing%is_meshed()) call bearing%commit()
      march%stages%rate = rate(:, stages)
      march%stages%ready = .true.
      march%next = next_step(step, error)
      if (march%settings%steps_per_turn > 0.0_wp) march%next = usual_step(march)
    else
      call drive_at(march, march%time, bearing)
    end if
    PetscCallA(VecDestroy(past, ierr))
  end subroutine take_step_by_stages

  !> All stages of a step.
  subroutine take_stages(march, bearing, newton, past, step, base, rate, report)
    type(march_type), intent(inout) :: march
    type(bearing_system_type), target, intent(inout) :: bearing
    type(newton_type), target, intent(inout) :: newton
    Vec, intent(in) :: past !! room for the state that a stage begins from
    real(wp), intent(in) :: step    !! [s]
    real(wp), intent(in) :: base(:) !! memory at the beginning
    real(wp), allocatable, intent(out) :: rate(:, :) !! (memory, stages) per second
    type(newton_report_type), intent(out) :: report !! of the last stage, with the iterations of all
    integer :: i, iterations

    allocate (rate(size(base), stages))
    iterations = 0
    if (.not. march%stages%ready .or. has_jumped(march)) then
      call find_first_rates(march, bearing, newton, past, step, base, report)
      if (.not. report%converged) return
      iterations = report%iterations
    end if
    rate(:, 1) = march%stages%rate
    do i = 2, stages
      call take_stage(march, bearing, newton, past, march%time + stage_time(i)*step, 1.0_wp/(diagonal*step), &
                      base + step*matmul(rate(:, :i - 1), stage_weight(i, :i - 1)), rate(:, i), report)
      iterations = iterations + report%iterations
      if (.not. report%converged) exit
      if (i == stages) exit
      if (bearing%is_meshed() .and. is_passed(i)) call bearing%commit()
    end do
    report%iterations = iterations
  end subroutine take_stages

  !> Whether what drives the shaft jumps at the present time.
  pure logical function has_jumped(march)
    type(march_type), intent(in) :: march
    real(wp), parameter :: nearly = 1.0e-6_wp !! over a step [1]
    has_jumped = march%drive%jumps(march%time - nearly*march%step) <= march%time + nearly*march%step
  end function has_jumped

  !> Rates at the present state, by the shortest step; the bearing is left where it was.
  subroutine find_first_rates(march, bearing, newton, past, step, base, report)
    type(march_type), intent(inout) :: march
    type(bearing_system_type), target, intent(inout) :: bearing
    type(newton_type), target, intent(inout) :: newton
    Vec, intent(in) :: past
    real(wp), intent(in) :: step    !! that follows [s]
    real(wp), intent(in) :: base(:)
    type(newton_report_type), intent(out) :: report
    real(wp) :: rate(size(base)), error

    error = march%error
    march%error = 0.0_wp ! to the last digits, for the difference is short
    march%stages%known = 0
    call take_stage(march, bearing, newton, past, march%time + shortest*step, 1.0_wp/(shortest*step), base, rate, report)
    march%error = error
    if (.not. report%converged) return
    march%stages%rate = rate
    march%stages%ready = .true.
    march%stages%known = 0
    call put_memory(base, march, bearing, past)
    call bearing%return_to(march%state(1))
  end subroutine find_first_rates

  !> One stage: a difference over the past that the stages before lead to.
  subroutine take_stage(march, bearing, newton, past, time, factor, from, rate, report)
    type(march_type), intent(inout) :: march
    type(bearing_system_type), target, intent(inout) :: bearing !! gets the state
    type(newton_type), target, intent(inout) :: newton
    Vec, intent(in) :: past
    real(wp), intent(in) :: time    !! of the stage [s]
    real(wp), intent(in) :: factor  !! a_0 [1/s]
    real(wp), intent(in) :: from(:) !! memory that it begins from
    real(wp), intent(out) :: rate(:) !! of the memory at its end, per second
    type(newton_report_type), intent(out) :: report
    type(newton_settings_type) :: settings
    real(wp) :: weight(0:2)
    integer :: i

    weight = factor*[1.0_wp, -1.0_wp, 0.0_wp]
    call put_memory(from, march, bearing, past)
    call prepare_difference(march, time, weight, past, past, bearing)
    call predict_stage(march, time, bearing)
    settings = newton%settings
    newton%settings%step_tolerance = tolerance_of_step(march, settings%step_tolerance, bearing%clearance/error_over_own)
    newton%settings%residual_tolerance = max(settings%residual_tolerance, newton%settings%step_tolerance)
    newton%settings%on_the_way = newton%settings%step_tolerance > settings%step_tolerance
    call solve_nearby(newton, report)
    newton%settings = settings
    if (.not. report%converged) return
    call end_step(bearing, weight, past, past)
    march%velocity(:, 1) = place_of(bearing)
    march%velocity(:, 1) = factor*(march%velocity(:, 1) - march%place(:, 1))
    march%place(:, 1) = place_of(bearing)
    call know_stage(march, time, bearing)
    do i = 1, size(bearing%pad)
      call look_at_pad(bearing, i, march%stages%unknown(:, 1), march%pad(i))
    end do
    rate = factor*(read_memory(march, bearing, bearing%state) - from)
  end subroutine take_stage

  !> All is as it was before the step.
  subroutine go_back(march, bearing, past, base, contacts)
    type(march_type), intent(inout) :: march
    type(bearing_system_type), intent(inout) :: bearing
    Vec, intent(in) :: past
    real(wp), intent(in) :: base(:)
    type(contact_set_type), allocatable, intent(in) :: contacts(:) !! of each pad, where there are any
    integer :: i

    call put_memory(base, march, bearing, past)
    do i = 1, merge(size(bearing%pad), 0, allocated(contacts))
      bearing%pad(i)%foil%contacts = contacts(i)
    end do
    call bearing%return_to(march%state(1))
    march%stages%known = 0
  end subroutine go_back

  !> The state of a stage becomes the newest that others are predicted from.
  subroutine know_stage(march, time, bearing)
    type(march_type), intent(inout) :: march
    real(wp), intent(in) :: time !! [s]
    type(bearing_system_type), intent(in) :: bearing !! at the stage
    integer :: i

    associate (past => march%stages)
      if (.not. allocated(past%time)) allocate (past%time(most_known), past%unknown(size(march%unknown, 1), most_known), source=0.0_wp)
      past%known = min(past%known + 1, most_known)
      do i = past%known, 2, -1
        past%time(i) = past%time(i - 1)
        past%unknown(:, i) = past%unknown(:, i - 1)
      end do
      past%time(1) = time
      call bearing%get_unknowns(past%unknown(:, 1))
    end associate
  end subroutine know_stage

  !> Begins Newton's method where the nearest stages in time lead: film and shaft on a parabola, foils on a line.
  subroutine predict_stage(march, time, bearing)
    type(march_type), intent(in) :: march
    real(wp), intent(in) :: time !! of the stage [s]
    type(bearing_system_type), intent(inout) :: bearing !! prepared for the stage; gets the state
    real(wp) :: ahead(size(march%unknown, 1))
    integer, allocatable :: near(:), line(:)
    logical :: open
    integer :: i

    if (march%stages%known == 0) return
    associate (past => march%stages)
      near = nearest_stages(past%time(:past%known), time, film_points)
      line = near(:min(foil_points, size(near)))
      ahead = matmul(past%unknown(:, near), interpolation_weights(time, past%time(near)))
      do i = 1, size(bearing%pad)
        associate (first => bearing%pad(i)%first + bearing%pad(i)%foil%first + 1, last => bearing%pad(i)%last)
          ahead(first:last) = matmul(past%unknown(first:last, line), interpolation_weights(time, past%time(line)))
        end associate
      end do
      open = bearing%is_open_at(ahead)
      if (.not. open) ahead = past%unknown(:, 1)
    end associate
    call bearing%set_unknowns(ahead)
  end subroutine predict_stage

  !> The stages nearest in time, the nearest first.
  pure function nearest_stages(at, time, most) result(number)
    real(wp), intent(in) :: at(:) !! [s]
    real(wp), intent(in) :: time  !! [s]
    integer, intent(in) :: most   !! of them
    integer, allocatable :: number(:)
    real(wp) :: away(size(at))
    integer :: i

    away = abs(at - time)
    allocate (number(min(most, size(at))))
    do i = 1, size(number)
      number(i) = minloc(away, 1)
      away(number(i)) = huge(1.0_wp)
    end do
  end function nearest_stages
end module gfb_stage_march
