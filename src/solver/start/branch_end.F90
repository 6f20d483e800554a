#include "gfb_petsc.h"
!> A branch of answers to an operating point, and where it ends short of that without a cause: what the film does beyond.
module gfb_branch_end
  use gfb_kinds, only: wp
  use gfb_text, only: text
  use gfb_work_bound, only: gives_up
  use gfb_scene, only: scene_type
  use gfb_operating_point, only: operating_point_type
  use gfb_bearing_system, only: bearing_system_type
  use gfb_bearing_directions, only: edge_lift, has_free_edge
  use gfb_newton, only: newton_type
  use gfb_continuation, only: path_settings_type, path_report_type, follow_path
  use gfb_start_problem, only: start_problem_type
  use gfb_kept_state, only: kept_state_type
  use gfb_edge_heights, only: ask_edges
  implicit none (type)
  private
  public :: follow_branch, ask_beyond, path_settings_type, path_report_type

  real(wp), parameter :: micrometres = 1.0e6_wp !! in a metre

contains

  !> Follows a branch; where no step leads on and nothing tells why, asks at the target. On return the state is the
  !> branch's last answer.
  subroutine follow_branch(scene, bearing, newton, target, settings, report)
    type(scene_type), target, intent(in) :: scene !! what is asked for
    type(bearing_system_type), target, intent(inout) :: bearing !! at an answer
    type(newton_type), target, intent(inout) :: newton !! its solver
    type(operating_point_type), intent(in) :: target !! where the branch is to lead
    type(path_settings_type), intent(in) :: settings !! limits of the path
    type(path_report_type), intent(out) :: report !! how far it led

    call follow_path(bearing, newton, target, 1.0_wp, settings, report)
    if (.not. report%converged) then
      call ask_beyond(scene, bearing, newton, target, 'at the value asked for', settings, report)
    end if
  end subroutine follow_branch

  !> Adds to the report of a path that ended without a cause what happens beyond its end: the free edge is fixed, the
  !> target reached with it, and the edge's force asked there. Where that leads to an answer near the branch's last one, the
  !> branch goes on with it, and the path has converged; the state stays the branch's last answer otherwise.
  subroutine ask_beyond(scene, bearing, newton, target, where, settings, report)
    type(scene_type), target, intent(in) :: scene !! what is asked for
    type(bearing_system_type), target, intent(inout) :: bearing !! in and out: at the branch's last answer
    type(newton_type), target, intent(inout) :: newton !! its solver
    type(operating_point_type), intent(in) :: target !! beyond the end
    character(len=*), intent(in) :: where !! the target in words: 'at ...'
    type(path_settings_type), intent(in) :: settings !! limits of paths
    type(path_report_type), intent(inout) :: report !! of the path that ended: goes on, or its reason becomes longer
    type(start_problem_type) :: problem
    type(path_report_type) :: beyond
    type(kept_state_type) :: last
    logical :: ends
    integer :: pad

    if (report%has_cause() .or. .not. bearing%floats .or. bearing%shaft_fixed) return
    if (.not. bearing%pad(1)%foil%has_contacts()) return
    if (.not. has_free_edge(bearing)) return
    if (gives_up(newton%settings%bound)) return
    call newton%log%detail('the branch is lost: its free edge is fixed, and asked '//where)
    call last%keep(bearing)
    problem%scene => scene
    problem%target = target
    problem%settings = settings
    problem%bearing => bearing
    problem%newton => newton
    call ask_edges(problem, beyond, ends)
    if (beyond%converged) then
      report%converged = last%change(bearing) <= settings%longest_leap
    end if
    report%drawn = ends
    if (report%converged) then
      report%reason = 'converged'
      report%reached = target
      report%fraction = 1.0_wp
    else if (ends) then
      report%reason = report%reason//'; '//where//' '//beyond%reason
    else if (beyond%converged) then
      report%reason = report%reason//'; '//where//' another equilibrium was found, with its free edge at '// &
        text(maxval([(edge_lift(bearing, pad), pad=1, size(bearing%pad))])*micrometres, 3)//' um: a branch of its own'
    end if
    if (.not. report%converged) call last%put_back(bearing)
    call last%destroy()
    call problem%anchor%destroy()
  end subroutine ask_beyond
end module gfb_branch_end
