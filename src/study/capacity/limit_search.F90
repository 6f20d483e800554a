#include "gfb_petsc.h"
!> The load, speed, tilt or supply at which film or asperities reach a limit: along the branch of equilibria from a given one, every trial
!> an equilibrium on that branch.
!>
!> At an answer \( x \) at the value \( v \) one solution by the factors at hand gives the branch's tangent,
!> \( x' = -f_x^{-1} f_v \). The reserve \( r \) falls along it by \( r' = r_x x' + r_v \): where \( r + r' \Delta v = 0 \) the limit
!> is tried next, from \( x + x' \Delta v \), which is Newton's method for the limit. No step more than doubles or halves a load, a
!> speed or a supply; once the limit lies between two answers, a step that would leave them is one of false position.
module gfb_limit_search
  use petscvec
  use gfb_kinds, only: wp
  use gfb_ending, only: path_reached, path_stopped, path_lost, ending_fold
  use gfb_quantity, only: quantity_type
  use gfb_text, only: text
  use gfb_scene, only: scene_type
  use gfb_operating_point, only: operating_point_type
  use gfb_bearing_system, only: bearing_system_type
  use gfb_run_log, only: run_log_type
  use gfb_signals, only: stop_agreed
  use gfb_newton, only: newton_type, has_factors, solve_with_factors
  use gfb_continuation, only: path_settings_type, path_report_type, follow_path
  use gfb_saved_state, only: saved_state_type
  use gfb_root_bracket, only: root_bracket_type
  use gfb_limit, only: limit_type, limit_of
  implicit none (type, external)
  private
  public :: find_limit, leave_limit

  integer, parameter :: most_steps = 30           !! before the limit is passed
  integer, parameter :: most_steps_back = 15      !! from beyond the limit: to a 33,000th of the load
  integer, parameter :: most_trials = 40          !! between two values on both sides
  real(wp), parameter :: tolerance = 1.0e-9_wp    !! of load, speed, tilt or supply, relative [1]
  real(wp), parameter :: settled = 1.0e-10_wp     !! reserve that needs no other trial [1]
  real(wp), parameter :: at_limit = 1.0e-6_wp     !! reserve that is none [1]
  real(wp), parameter :: shift = 1.0e-4_wp        !! of what is looked for, for derivatives, over the longest step [1]
  !> Newton's steps before they are bent at contacts that change: where crests open and close as the film thins, straight ones go
  !> to and fro among them, and steps of the path are cut for it.
  integer, parameter, public :: limit_straight_steps = 3

  !> Two values on both sides of the limit, the last answer on its near side, and how the branch goes on from the present one.
  type :: sides_type
    type(root_bracket_type) :: bracket !! the bearing is at its `high`
    type(saved_state_type) :: within    !! with reserve; not created where none was met
    Vec :: rate                         !! of the state at the bearing's answer, by what is looked for
    real(wp) :: slope = 0.0_wp          !! of the reserve along it; 0: not known [1/unit]
  end type sides_type

contains

  !> Leads the bearing from an equilibrium to the limit that the scene asks for, or to the end of the branch before it.
  !>
  !> Without an answer the bearing is at the last state that was reached.
  subroutine find_limit(scene, log, path, bearing, newton, found, at_fold, report)
    type(scene_type), intent(in) :: scene !! that asks for a limit
    type(run_log_type), intent(in) :: log !! where lines go
    type(path_settings_type), intent(in) :: path !! limits of paths
    type(bearing_system_type), target, intent(inout) :: bearing !! at an equilibrium
    type(newton_type), target, intent(inout) :: newton !! its solver
    type(quantity_type), allocatable, intent(out) :: found(:) !! what summary and history say of the limit
    logical, intent(out) :: at_fold !! the answer is a branch's end in a fold
    type(path_report_type), intent(out) :: report !! whether there is an answer
    type(limit_type) :: limit
    type(sides_type) :: sides
    type(path_settings_type) :: settings
    PetscErrorCode :: ierr
    logical :: passed

    limit = limit_of(scene, bearing%point)
    settings = path
    settings%straight_steps = limit_straight_steps
    PetscCallA(VecDuplicate(bearing%state, sides%rate, ierr))
    call pass_limit(limit, settings, bearing, newton, sides, passed, report)
    if (passed) call close_in(limit, settings, bearing, newton, sides, report)
    PetscCallA(VecDestroy(sides%rate, ierr))
    at_fold = report%ending%kind == ending_fold
    if (stop_agreed()) then
      report%ending = path_stopped() ! the caller knows why
    else if (passed .or. sides%within%created) then
      call conclude(limit, log, bearing, sides, found, at_fold, report)
    end if
    call sides%within%destroy()
  end subroutine find_limit

  !> From a limit back to the answer from which it was found, so that the next path begins where the bearing has its reserve.
  subroutine leave_limit(target, path, bearing, newton)
    type(operating_point_type), intent(in) :: target !! of that answer
    type(path_settings_type), intent(in) :: path !! limits of paths
    type(bearing_system_type), intent(inout) :: bearing !! at the limit; where no path leads back, at its last answer
    type(newton_type), intent(inout) :: newton !! its solver
    type(path_report_type) :: report
    call follow_path(bearing, newton, target, 1.0_wp, path, report)
  end subroutine leave_limit

  !> Goes on, or back, until the limit is met or lies between two answers, or the branch ends.
  subroutine pass_limit(limit, path, bearing, newton, sides, passed, report)
    type(limit_type), intent(in) :: limit
    type(path_settings_type), intent(in) :: path
    type(bearing_system_type), target, intent(inout) :: bearing
    type(newton_type), target, intent(inout) :: newton
    type(sides_type), intent(inout) :: sides
    logical, intent(out) :: passed
    type(path_report_type), intent(out) :: report !! why not
    type(path_settings_type) :: settings
    real(wp) :: value, left, next, first, aim
    logical :: starts_within, stops
    integer :: step

    value = limit%value_at(bearing%point)
    left = limit%reserve(bearing)
    first = left
    starts_within = first > 0.0_wp
    passed = .false.
    settings = path
    ! The path ends where the limit is passed, so that nothing is looked for beyond.
    if (limit%is_of_film() .and. starts_within) settings%touch_down_gap = limit%smallest_gap
    do step = 1, merge(most_steps, most_steps_back, starts_within)
      call newton%log%detail('limit: '//limit%words(bearing))
      if (.not. left < 0.0_wp) call sides%within%save(bearing)
      sides%bracket%low = value
      sides%bracket%at_low = left
      next = limit%next_value(value, limit%room(bearing, left))
      if (abs(next - value) <= 0.0_wp) exit ! there is no way farther back
      call find_rate(limit, bearing, newton, abs(next - value), left, sides)
      aim = limit%aimed_value(value, left, sides%slope)
      if ((aim - value)*(next - aim) > 0.0_wp) next = aim
      call follow_branch(limit, next, settings, bearing, newton, sides, report)
      value = limit%value_at(bearing%point)
      left = limit%reserve(bearing)
      if (.not. left < 0.0_wp) call sides%within%save(bearing)
      sides%bracket%high = value
      sides%bracket%at_high = left
      passed = left*first <= 0.0_wp .or. abs(left) <= settled .or. abs(value - sides%bracket%low) <= tolerance*abs(value)
      stops = stop_agreed()
      if (passed .or. stops) return
      if (.not. report%converged()) then
        if (.not. starts_within) call report%ending%add_words('beyond the limit at first, and on the way back ', '')
        return
      end if
    end do
    report%ending = path_lost('not met after '//text(most_steps)//' steps')
    if (.not. starts_within) report%ending = path_lost(limit%never_within(bearing))
  end subroutine pass_limit

  !> From both sides to the limit, where the tangent of the last answer has it or by false position; where no path leads back from
  !> the second side, from the last answer on the near side.
  subroutine close_in(limit, path, bearing, newton, sides, report)
    type(limit_type), intent(in) :: limit
    type(path_settings_type), intent(in) :: path
    type(bearing_system_type), target, intent(inout) :: bearing !! at the last trial on return
    type(newton_type), target, intent(inout) :: newton
    type(sides_type), intent(inout) :: sides
    type(path_report_type), intent(out) :: report !! of the last trial
    real(wp) :: trial, last, left, aim
    integer :: i

    report%ending = path_reached()
    do i = 1, most_trials
      if (abs(sides%bracket%at_high) <= settled) return
      if (stop_agreed()) return
      last = sides%bracket%high
      trial = sides%bracket%trial()
      left = limit%reserve(bearing)
      call find_rate(limit, bearing, newton, abs(trial - last), left, sides)
      aim = limit%aimed_value(last, left, sides%slope)
      if ((aim - last)*(sides%bracket%low - aim) > 0.0_wp) trial = aim
      call follow_branch(limit, trial, path, bearing, newton, sides, report)
      if (.not. report%converged() .and. sides%within%created) then
        call sides%within%restore(bearing)
        sides%slope = 0.0_wp
        call follow_branch(limit, trial, path, bearing, newton, sides, report)
      end if
      left = limit%reserve(bearing)
      if (.not. left < 0.0_wp) call sides%within%save(bearing)
      if (.not. report%converged()) return
      call newton%log%detail('limit: '//limit%words(bearing))
      if (abs(trial - last) <= tolerance*abs(trial)) return
      call sides%bracket%narrow(trial, left)
    end do
  end subroutine close_in

  !> The branch's tangent at the bearing's answer, and how the reserve falls along it, by differences of residual and reserve over a
  !> small part of a step. The factors are those of the last iteration before the answer: near enough for a start value.
  subroutine find_rate(limit, bearing, newton, step, left, sides)
    type(limit_type), intent(in) :: limit
    type(bearing_system_type), intent(inout) :: bearing
    type(newton_type), intent(in) :: newton
    real(wp), intent(in) :: step !! of what is looked for [its unit]
    real(wp), intent(in) :: left !! reserve at the answer [1]
    type(sides_type), intent(inout) :: sides
    type(operating_point_type) :: here
    real(wp) :: value, part
    logical :: valid
    Vec :: change, answer
    PetscErrorCode :: ierr

    sides%slope = 0.0_wp
    part = shift*step
    if (.not. (has_factors(newton) .and. part > 0.0_wp)) return
    PetscCallA(VecDuplicate(bearing%state, change, ierr))
    PetscCallA(VecDuplicate(bearing%state, answer, ierr))
    PetscCallA(VecCopy(bearing%state, answer, ierr))
    here = bearing%point
    value = limit%value_at(here)
    call bearing%evaluate_at(limit%point_with(here, value - part), answer, change, valid)
    if (valid) call bearing%evaluate_at(limit%point_with(here, value + part), answer, sides%rate, valid)
    if (valid) then
      PetscCallA(VecAXPBY(change, -0.5_wp/part, 0.5_wp/part, sides%rate, ierr))
      call solve_with_factors(newton, change, sides%rate)
      bearing%point = limit%point_with(here, value + part)
      PetscCallA(VecAXPY(bearing%state, part, sides%rate, ierr))
      if (bearing_is_open(bearing)) sides%slope = (limit%reserve(bearing) - left)/part
      PetscCallA(VecCopy(answer, bearing%state, ierr))
      bearing%point = here
    end if
    PetscCallA(VecDestroy(change, ierr))
    PetscCallA(VecDestroy(answer, ierr))
  end subroutine find_rate

  !> Whether the bearing's present state can be evaluated.
  logical function bearing_is_open(bearing) result(open)
    type(bearing_system_type), intent(in) :: bearing
    real(wp) :: unknown(bearing%local_size())

    call bearing%get_unknowns(unknown)
    open = bearing%is_open_at(unknown)
  end function bearing_is_open

  !> A path to another value, from the tangent where that is known.
  subroutine follow_branch(limit, next, path, bearing, newton, sides, report)
    type(limit_type), intent(in) :: limit
    real(wp), intent(in) :: next !! value [its unit]
    type(path_settings_type), intent(in) :: path
    type(bearing_system_type), target, intent(inout) :: bearing
    type(newton_type), target, intent(inout) :: newton
    type(sides_type), intent(inout) :: sides !! the tangent is used up
    type(path_report_type), intent(out) :: report
    type(operating_point_type) :: target
    character(len=:), allocatable :: course
    real(wp) :: value
    PetscErrorCode :: ierr

    value = limit%value_at(bearing%point)
    target = limit%point_with(bearing%point, next)
    course = limit%course(value, next)
    if (abs(sides%slope) > 0.0_wp) then
      PetscCallA(VecScale(sides%rate, next - value, ierr))
      call follow_path(bearing, newton, target, 1.0_wp, path, report, sides%rate, course)
    else
      call follow_path(bearing, newton, target, 1.0_wp, path, report, course=course)
    end if
    sides%slope = 0.0_wp
  end subroutine follow_branch

  !> Says what was found: the limit, or the last answer on its near side and why the limit is not met.
  subroutine conclude(limit, log, bearing, sides, found, at_fold, report)
    type(limit_type), intent(in) :: limit
    type(run_log_type), intent(in) :: log
    type(bearing_system_type), intent(inout) :: bearing !! at the answer on return
    type(sides_type), intent(in) :: sides
    type(quantity_type), allocatable, intent(out) :: found(:)
    logical, intent(out) :: at_fold !! it is a branch's end in a fold
    type(path_report_type), intent(inout) :: report !! in: of the last path; out: there is an answer
    character(len=:), allocatable :: ends
    real(wp) :: left
    logical :: reached

    left = limit%reserve(bearing)
    reached = abs(left) <= at_limit
    if (.not. reached .and. left < 0.0_wp) call sides%within%restore(bearing)
    found = limit%results(bearing%point, reached)
    if (reached) then
      call log%line(limit%words(bearing))
    else if (limit%needs_none(bearing%point)) then
      call log%line(limit%words(bearing)//': it keeps smallest_gap without any supply')
    else if (report%converged()) then
      call log%warning(limit%words(bearing)//', not at the limit: answers jump across it')
    else
      ends = limit%words(bearing)//', not at the limit: '//report%reason()
      if (report%has_cause()) then
        call log%line(ends)
      else
        call log%warning(ends//'; the branch may go on')
      end if
    end if
    at_fold = report%ending%kind == ending_fold .and. .not. reached
    report%ending = path_reached()
  end subroutine conclude
end module gfb_limit_search
