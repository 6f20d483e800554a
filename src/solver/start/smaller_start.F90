#include "gfb_petsc.h"
!> Starts from the answer of a smaller system: on a coarser mesh, or on half the width.
module gfb_smaller_start
  use gfb_operating_point, only: operating_point_type
  use gfb_continuation, only: path_report_type
  use gfb_start_problem, only: start_problem_type, soft_contacts_type
  use gfb_start_position, only: release_shaft, solve_at
  use gfb_answer_transfer, only: transfer_answer
  implicit none (type)
  private
  public :: try_smaller_answer, try_smaller_position

contains

  !> Newton's method at the target, from the smaller system's answer.
  recursive subroutine try_smaller_answer(problem, soft, report, ends)
    type(start_problem_type), intent(inout) :: problem !! what is to be solved
    type(soft_contacts_type), intent(in) :: soft  !! none
    type(path_report_type), intent(out) :: report !! how it ended
    logical, intent(out) :: ends                  !! never

    ends = .false.
    call transfer_answer(problem%smaller, problem%bearing)
    call solve_at(problem%bearing, problem%newton, problem%target, .false., problem%settings, report)
    problem%from_smaller = report%converged
  end subroutine try_smaller_answer

  !> The shaft is fixed where the smaller system's is, and then released.
  recursive subroutine try_smaller_position(problem, soft, report, ends)
    type(start_problem_type), intent(inout) :: problem !! what is to be solved
    type(soft_contacts_type), intent(in) :: soft  !! none
    type(path_report_type), intent(out) :: report !! how it ended
    logical, intent(out) :: ends                  !! never
    type(operating_point_type) :: fixed

    ends = .false.
    call transfer_answer(problem%smaller, problem%bearing)
    fixed = problem%target
    fixed%eccentricity = problem%bearing%eccentricity()
    call solve_at(problem%bearing, problem%newton, fixed, .true., problem%settings, report)
    if (report%converged) call release_shaft(problem%bearing, problem%newton, problem%target, problem%settings, report)
    problem%from_smaller = report%converged
  end subroutine try_smaller_position
end module gfb_smaller_start
