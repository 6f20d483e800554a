#include "gfb_petsc.h"
!> Starts from the answer of a smaller system: on a coarser mesh, or on half the width.
module gfb_smaller_start
  use gfb_kinds, only: wp
  use gfb_ending, only: path_lost
  use gfb_continuation, only: path_report_type, follow_path
  use gfb_start_problem, only: start_problem_type, trial_settings
  use gfb_start_position, only: solve_at
  use gfb_answer_transfer, only: transfer_answer
  use gfb_bearing_directions, only: edge_force
  implicit none (type)
  private
  public :: try_smaller_answer, try_smaller_end

  real(wp), parameter :: first_step = 0.25_wp !! of a path to the load [1]
  integer, parameter :: hasty_iterations = 16 !! where a mesh in between may help; 6 to 10 where none is needed

contains

  !> Newton's method at the target, from the smaller system's answer.
  subroutine try_smaller_answer(problem, report)
    type(start_problem_type), intent(inout) :: problem !! what is to be solved
    type(path_report_type), intent(out) :: report !! how it ended
    integer :: allowed

    call transfer_answer(problem%smaller, problem%bearing)
    allowed = problem%newton%settings%maximum_iterations
    if (problem%carried_only) problem%newton%settings%maximum_iterations = min(hasty_iterations, allowed)
    call solve_at(problem%bearing, problem%newton, problem%target, .false., problem%settings, report)
    problem%newton%settings%maximum_iterations = allowed
    problem%from_smaller = report%converged()
  end subroutine try_smaller_answer

  !> The smaller system's refusal is shown on this one from the state that it was shown from there: with the free edge
  !> fixed where that takes the least force, or else on the way to the load.
  subroutine try_smaller_end(problem, report, ends)
    type(start_problem_type), intent(inout) :: problem !! what is to be solved
    type(path_report_type), intent(out) :: report !! how it ended
    logical, intent(out) :: ends                  !! this system refuses the target, too
    integer :: pad

    call transfer_answer(problem%smaller, problem%bearing)
    call solve_at(problem%bearing, problem%newton, problem%smaller%point, .false., problem%settings, report)
    ends = report%converged()
    if (.not. ends) return
    call problem%anchor%keep(problem%bearing)
    if (any(problem%bearing%point%edge_hold > 0.0_wp)) then
      ends = any([(edge_force(problem%bearing, pad), pad=1, size(problem%bearing%pad))] < 0.0_wp)
      report%ending = path_lost(problem%refusal%reason())
      if (ends) report%ending = problem%refusal%ending
    else
      call follow_path(problem%bearing, problem%newton, problem%target, first_step, &
                       trial_settings(problem%settings), report)
      ends = report%has_cause()
    end if
  end subroutine try_smaller_end
end module gfb_smaller_start
