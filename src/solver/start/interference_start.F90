#include "gfb_petsc.h"
!> The start of a bearing whose foil the shaft presses back: with less interference of assembly first.
!>
!> At rest there is no gap between an undeflected foil and a shaft that is larger than the bore in it,
!> and no film to begin with. With no interference there is; from the answer there the shaft grows in
!> steps to its size.
module gfb_interference_start
  use gfb_kinds, only: wp
  use gfb_ending, only: path_reached, path_touches_at, path_lost
  use gfb_text, only: text
  use gfb_work_bound, only: gives_up
  use gfb_bearing_system, only: bearing_system_type
  use gfb_continuation, only: path_report_type
  use gfb_newton, only: newton_type, newton_report_type, solve_newton
  use gfb_stepper, only: path_problem_type, step_rules_type, follow_steps, steps_arrived, steps_given_up
  use gfb_start_problem, only: start_problem_type, first_step
  use gfb_saved_state, only: saved_state_type
  implicit none (type)
  private
  public :: close_interference, set_interference

  real(wp), parameter :: smallest_step = 0.005_wp !! before it is given up [1]
  integer, parameter :: max_iterations = 20       !! of a step
  real(wp), parameter :: growth = 1.5_wp          !! of a step that succeeded [1]

  !> A bearing whose shaft grows to its size; the parameter is the share of the interference.
  type, extends(path_problem_type) :: interference_path_type
    type(bearing_system_type), pointer :: bearing => null()
    type(newton_type), pointer :: newton => null() !! its solver
    real(wp) :: whole = 0.0_wp         !! interference [m]
    type(newton_report_type) :: solved !! of the last trial
    type(saved_state_type) :: saved     !! the last answer
  contains
    procedure :: try => try_interference
    procedure :: accept => accept_interference
    procedure :: restore => restore_interference
    procedure :: gives_up => search_gives_up
  end type interference_path_type

contains

  !> From an answer without interference to that with all of it, at the same operating point; a step that fails is halved.
  subroutine close_interference(problem, interference, report)
    type(start_problem_type), intent(inout) :: problem !! at an answer without interference
    real(wp), intent(in) :: interference !! asked for [m]
    type(path_report_type), intent(inout) :: report !! of success, which becomes one of failure where a step is too small
    type(interference_path_type) :: path
    real(wp) :: least !! gap [m]
    integer :: allowed, ending
    logical :: touched

    path%bearing => problem%bearing
    path%newton => problem%newton
    path%whole = interference
    call path%saved%save(problem%bearing)
    allowed = problem%newton%settings%maximum_iterations
    problem%newton%settings%maximum_iterations = min(max_iterations, allowed)
    call follow_steps(path, step_rules_type(first_step=first_step, smallest_step=smallest_step, growth=growth, &
                                            cuts_the_trial=.true.), ending)
    problem%newton%settings%maximum_iterations = allowed
    call path%saved%destroy()
    least = problem%settings%touch_down_gap
    if (ending /= steps_arrived) least = max(least, smallest_step*interference)
    touched = problem%bearing%smallest_gap() < least
    if (ending == steps_arrived .and. .not. (touched .and. problem%bearing%floats)) then
      report%ending = path_reached()
    else if (touched .and. ending /= steps_given_up) then
      report%ending = path_touches_at('where the interference is '//text(path%at*interference, 4)//' m')
    else
      report%ending = path_lost('no step leads beyond an interference of '//text(path%at*interference, 4)//' m: '//path%solved%reason)
    end if
  end subroutine close_interference

  !> A share of the interference: Newton's method from the last answer.
  subroutine try_interference(self, trial, may_be_cut, converged, iterations)
    class(interference_path_type), intent(inout) :: self !! the path
    real(wp), intent(in) :: trial     !! share [1]
    logical, intent(in) :: may_be_cut !! does not matter
    logical, intent(out) :: converged !! there is an answer
    integer, intent(out) :: iterations

    call set_interference(self%bearing, trial*self%whole)
    call self%newton%log%detail('interference '//text(trial*self%whole, 4)//' m')
    call solve_newton(self%newton, self%solved)
    converged = self%solved%converged
    iterations = self%solved%iterations
  end subroutine try_interference

  !> Saves an answer.
  subroutine accept_interference(self, trial)
    class(interference_path_type), intent(inout) :: self !! the path
    real(wp), intent(in) :: trial !! share [1]
    call self%saved%save(self%bearing)
  end subroutine accept_interference

  !> Goes back to the last answer.
  subroutine restore_interference(self)
    class(interference_path_type), intent(inout) :: self !! the path

    call self%saved%restore(self%bearing)
    call set_interference(self%bearing, self%at*self%whole)
  end subroutine restore_interference

  !> Whether all work that is allowed is done.
  logical function search_gives_up(self)
    class(interference_path_type), intent(inout) :: self !! the path
    search_gives_up = gives_up(self%newton%settings%bound)
  end function search_gives_up

  !> Takes an interference off the gap of all pads.
  subroutine set_interference(bearing, interference)
    type(bearing_system_type), intent(inout) :: bearing !! pads and shaft
    real(wp), intent(in) :: interference !! of the shaft [m]
    bearing%pad%film%interference = interference
  end subroutine set_interference
end module gfb_interference_start
