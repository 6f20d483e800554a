#include "gfb_petsc.h"
!> The load, speed or tilt at which film or asperities reach a limit: along the branch of equilibria from a given one until
!> the limit is passed, then by false position, every trial an equilibrium on that branch.
module gfb_limit_search
  use gfb_kinds, only: wp
  use gfb_quantity, only: quantity_type
  use gfb_run_log, only: run_log_type
  use gfb_signals, only: stop_agreed
  use gfb_text, only: text
  use gfb_scene, only: scene_type
  use gfb_operating_point, only: operating_point_type
  use gfb_bearing_system, only: bearing_system_type
  use gfb_newton, only: newton_type
  use gfb_continuation, only: path_settings_type, path_report_type, follow_path
  use gfb_kept_state, only: kept_state_type
  use gfb_root_bracket, only: root_bracket_type
  use gfb_limit, only: limit_type, limit_of
  implicit none (type, external)
  private
  public :: find_limit, leave_limit

  integer, parameter :: most_steps = 30           !! each doubles or halves what is looked for
  integer, parameter :: most_steps_back = 15      !! from beyond the limit: to a 33,000th of the load
  integer, parameter :: most_trials = 40          !! between two values on both sides
  real(wp), parameter :: tolerance = 1.0e-9_wp    !! of load, speed or tilt, relative [1]
  real(wp), parameter :: settled = 1.0e-10_wp     !! reserve that needs no other trial [1]
  real(wp), parameter :: a_little = 0.025_wp      !! of the step that failed, beyond the branch's end [1]
  integer, parameter :: most_resumed = 4          !! ends of a branch that goes on beyond
  real(wp), parameter :: at_limit = 1.0e-6_wp     !! reserve that is none [1]

  !> Two values on both sides of the limit, and the last answer on its near side.
  type :: sides_type
    type(root_bracket_type) :: bracket !! the bearing is at its `high`
    type(kept_state_type) :: within    !! with reserve; not created where none was met
  end type sides_type

  abstract interface
    !> Adds to a path's report what happens beyond its end: `ask_beyond` of gfb_branch_end.
    subroutine asks_beyond(scene, bearing, newton, target, where, settings, report)
      import :: scene_type, bearing_system_type, newton_type, operating_point_type, &
        path_settings_type, path_report_type
      implicit none (type, external)
      type(scene_type), target, intent(in) :: scene !! what is asked for
      type(bearing_system_type), target, intent(inout) :: bearing !! at the path's end
      type(newton_type), target, intent(inout) :: newton !! its solver
      type(operating_point_type), intent(in) :: target !! beyond the end
      character(len=*), intent(in) :: where !! that is, in words
      type(path_settings_type), intent(in) :: settings !! limits of paths
      type(path_report_type), intent(inout) :: report !! of the path
    end subroutine asks_beyond
  end interface

contains

  !> Leads the bearing from an equilibrium to the limit that the scene asks for, or to the end of the branch before it.
  !>
  !> Without an answer the bearing is at the last state that was reached.
  subroutine find_limit(scene, log, path, ask, bearing, newton, found, report)
    type(scene_type), intent(in) :: scene !! that asks for a limit
    type(run_log_type), intent(in) :: log !! where lines go
    type(path_settings_type), intent(in) :: path !! limits of paths
    procedure(asks_beyond) :: ask !! why a branch ends
    type(bearing_system_type), target, intent(inout) :: bearing !! at an equilibrium
    type(newton_type), target, intent(inout) :: newton !! its solver
    type(quantity_type), allocatable, intent(out) :: found(:) !! what summary and history say of the limit
    !> whether there is an answer; it is `folded` where that is a branch's end in a fold
    type(path_report_type), intent(out) :: report
    type(limit_type) :: limit
    type(sides_type) :: sides
    logical :: passed

    limit = limit_of(scene, bearing%point)
    call pass_limit(scene, limit, path, ask, bearing, newton, sides, passed, report)
    if (passed) call close_in(limit, path, bearing, newton, sides, report)
    if (stop_agreed()) then
      report%converged = .false. ! the caller knows why
    else if (passed .or. sides%within%created) then
      call conclude(limit, log, bearing, sides, found, report)
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

  !> Goes on, or back, until the limit lies between two answers, or the branch ends.
  subroutine pass_limit(scene, limit, path, ask, bearing, newton, sides, passed, report)
    type(scene_type), intent(in) :: scene
    type(limit_type), intent(in) :: limit
    type(path_settings_type), intent(in) :: path
    procedure(asks_beyond) :: ask
    type(bearing_system_type), target, intent(inout) :: bearing
    type(newton_type), target, intent(inout) :: newton
    type(sides_type), intent(inout) :: sides
    logical, intent(out) :: passed
    type(path_report_type), intent(out) :: report !! why not
    type(path_settings_type) :: settings
    type(operating_point_type) :: beyond
    real(wp) :: value, left, next, first
    logical :: starts_within, stops
    integer :: step, resumed

    value = limit%value_at(bearing%point)
    left = limit%reserve(bearing)
    first = left
    starts_within = first > 0.0_wp
    passed = .false.
    resumed = 0
    settings = path
    ! The path ends where the limit is passed, so that nothing is looked for beyond.
    if (limit%is_of_film() .and. starts_within) settings%touch_down_gap = limit%smallest_gap
    do step = 1, merge(most_steps, most_steps_back, starts_within)
      call newton%log%detail('limit: '//limit%words(bearing))
      if (.not. left < 0.0_wp) call sides%within%keep(bearing)
      sides%bracket%low = value
      sides%bracket%at_low = left
      next = limit%next_value(value, left)
      if (abs(next - value) <= 0.0_wp) exit ! there is no way farther back
      call follow_path(bearing, newton, limit%point_with(bearing%point, next), 1.0_wp, settings, report)
      call look()
      stops = stop_agreed()
      if (passed .or. stops) return
      if (.not. report%converged .and. starts_within .and. resumed < most_resumed) then
        resumed = resumed + 1
        beyond = limit%point_with(bearing%point, value + a_little*(next - value))
        call ask(scene, bearing, newton, beyond, 'a little beyond', path, report)
        if (report%converged) call look()
        if (passed) return
      end if
      if (.not. report%converged) then
        if (.not. starts_within) report%reason = 'beyond the limit at first, and on the way back '//report%reason
        return
      end if
    end do
    report%converged = .false.
    report%reason = 'not met after '//text(most_steps)//' steps, each of which doubled or halved what is looked for'
    if (.not. starts_within) report%reason = limit%never_within(bearing)

  contains

    !> At a new answer: on which side of the limit it lies.
    subroutine look()
      value = limit%value_at(bearing%point)
      left = limit%reserve(bearing)
      if (.not. left < 0.0_wp) call sides%within%keep(bearing)
      sides%bracket%high = value
      sides%bracket%at_high = left
      passed = left*first <= 0.0_wp
    end subroutine look
  end subroutine pass_limit

  !> False position between both sides, from the second one's answer.
  subroutine close_in(limit, path, bearing, newton, sides, report)
    type(limit_type), intent(in) :: limit
    type(path_settings_type), intent(in) :: path
    type(bearing_system_type), target, intent(inout) :: bearing !! at the last trial on return
    type(newton_type), target, intent(inout) :: newton
    type(sides_type), intent(inout) :: sides
    type(path_report_type), intent(out) :: report !! of the last trial
    real(wp) :: trial, last, left
    integer :: i

    report%converged = .true.
    do i = 1, most_trials
      if (abs(sides%bracket%at_high) <= settled) return
      if (stop_agreed()) return
      last = sides%bracket%high
      trial = sides%bracket%trial()
      call follow_path(bearing, newton, limit%point_with(bearing%point, trial), 1.0_wp, path, report)
      left = limit%reserve(bearing)
      if (.not. left < 0.0_wp) call sides%within%keep(bearing)
      if (.not. report%converged) return
      call newton%log%detail('limit: '//limit%words(bearing))
      if (abs(trial - last) <= tolerance*abs(trial)) return
      call sides%bracket%narrow(trial, left)
    end do
  end subroutine close_in

  !> Says what was found: the limit, or the last answer on its near side and why the limit is not met.
  subroutine conclude(limit, log, bearing, sides, found, report)
    type(limit_type), intent(in) :: limit
    type(run_log_type), intent(in) :: log
    type(bearing_system_type), intent(inout) :: bearing !! at the answer on return
    type(sides_type), intent(in) :: sides
    type(quantity_type), allocatable, intent(out) :: found(:)
    type(path_report_type), intent(inout) :: report !! in: of the last path; out: there is an answer
    character(len=:), allocatable :: ends
    real(wp) :: left
    logical :: reached

    left = limit%reserve(bearing)
    reached = abs(left) <= at_limit
    if (.not. reached .and. left < 0.0_wp) call sides%within%put_back(bearing)
    found = limit%results(bearing%point, reached)
    if (reached) then
      call log%line(limit%words(bearing))
    else if (report%converged) then
      call log%warning(limit%words(bearing)//', not at the limit: answers jump across it')
    else
      ends = limit%words(bearing)//', not at the limit: '//report%reason
      if (report%has_cause() .or. report%drawn) then
        call log%line(ends)
      else
        call log%warning(ends//'; the branch may go on')
      end if
    end if
    report%folded = report%folded .and. .not. reached
    report%converged = .true.
    report%reason = 'converged'
  end subroutine conclude
end module gfb_limit_search
