#include "gfb_petsc.h"
!> The start of a bearing whose foil the shaft presses back: with less interference of assembly first.
!>
!> At rest there is no gap between an undeflected foil and a shaft that is larger than the bore in it,
!> and no film to begin with. With no interference there is; from the answer there the shaft grows in
!> steps to its size.
module gfb_interference_start
  use gfb_kinds, only: wp
  use gfb_text, only: text
  use gfb_work_bound, only: gives_up
  use gfb_bearing_system, only: bearing_system_type
  use gfb_newton, only: newton_report_type, solve_newton
  use gfb_continuation, only: path_report_type
  use gfb_start_problem, only: start_problem_type
  use gfb_kept_state, only: kept_state_type
  implicit none (type)
  private
  public :: press, set_interference

  real(wp), parameter :: first_step = 0.25_wp     !! of the interference, over all of it [1]
  real(wp), parameter :: smallest_step = 0.005_wp !! before it is given up [1]
  integer, parameter :: hasty_iterations = 20     !! of a step
  real(wp), parameter :: growth = 1.5_wp          !! of a step that succeeded [1]

contains

  !> From an answer without interference to that with all of it, at the same operating point; a step that fails is halved.
  subroutine press(problem, interference, report)
    type(start_problem_type), intent(inout) :: problem !! at an answer without interference
    real(wp), intent(in) :: interference !! asked for [m]
    type(path_report_type), intent(inout) :: report !! of success, which becomes one of failure where a step is too small
    type(newton_report_type) :: solved
    type(kept_state_type) :: last
    real(wp) :: step, gone, trial !! over all of the interference [1]
    integer :: allowed
    logical :: stopped

    gone = 0.0_wp
    step = first_step
    stopped = .false.
    call last%keep(problem%bearing)
    allowed = problem%newton%settings%maximum_iterations
    problem%newton%settings%maximum_iterations = min(hasty_iterations, allowed)
    do while (gone < 1.0_wp)
      trial = min(gone + step, 1.0_wp)
      call set_interference(problem%bearing, trial*interference)
      call problem%newton%log%detail('interference '//text(trial*interference, 4)//' m')
      call solve_newton(problem%newton, solved)
      if (solved%converged) then
        gone = trial
        step = growth*step
        call last%keep(problem%bearing)
      else
        call last%put_back(problem%bearing)
        call set_interference(problem%bearing, gone*interference)
        step = 0.5_wp*min(step, trial - gone)
        stopped = gives_up(problem%newton%settings%bound)
        if (step < smallest_step .or. stopped) exit
      end if
    end do
    problem%newton%settings%maximum_iterations = allowed
    call last%destroy()
    report%converged = gone >= 1.0_wp
    report%touched = problem%bearing%smallest_gap() < max(problem%settings%touch_down_gap, smallest_step*interference)
    if (report%converged .and. problem%bearing%floats) then
      report%touched = problem%bearing%smallest_gap() < problem%settings%touch_down_gap
      report%converged = .not. report%touched
    end if
    report%touched = report%touched .and. .not. (report%converged .or. stopped)
    if (report%converged) return
    if (report%touched) then
      report%reason = 'the shaft touches down where the interference is '//text(gone*interference, 4)//' m'
    else
      report%reason = 'no step leads beyond an interference of '//text(gone*interference, 4)//' m: '//solved%reason
    end if
  end subroutine press

  !> Takes an interference off the gap of all pads.
  subroutine set_interference(bearing, interference)
    type(bearing_system_type), intent(inout) :: bearing !! pads and shaft
    real(wp), intent(in) :: interference !! of the shaft [m]
    bearing%pad%film%interference = interference
  end subroutine set_interference
end module gfb_interference_start
