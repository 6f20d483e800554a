#include "gfb_petsc.h"
!> The start of a bearing whose free edge is fixed, first where it rests, then higher and higher.
!>
!> The film's suction may draw the free edge of the top foil off its bumps: an unstable motion that
!> hides what equilibria there are from Newton's method. With the edge fixed at a height the rest has
!> an answer, and the force that holds it there tells more: where it changes its sense from one height
!> to the next the edge stays between them by itself, and where it never does it stays nowhere.
module gfb_edge_start
  use gfb_kinds, only: wp
  use gfb_ending, only: path_lost, ending_fold
  use gfb_text, only: text
  use gfb_petsc_session, only: any_rank
  use gfb_operating_point, only: operating_point_type
  use gfb_bearing_system, only: bearing_system_type
  use gfb_continuation, only: path_settings_type, path_report_type, follow_path
  use gfb_bearing_directions, only: edge_force
  use gfb_start_position, only: guess_position
  use gfb_start_problem, only: start_problem_type, trial_settings, with_fixed_edges, with_same_edges, &
                               settings_with_fixed_edge, clearance_of
  use gfb_kept_state, only: kept_state_type
  use gfb_edge_heights, only: release_edges, release, release_pressed, lowest
  use gfb_contact_start, only: approach, try_soft_contacts, usual_contacts
  implicit none (type)
  private
  public :: try_free_edge

  real(wp), parameter :: first_step = 0.25_wp    !! of a path to the load [1]
  character(len=*), parameter :: held = ', with the free edge of the top foil fixed at its height at rest'
  real(wp), parameter :: shares(3) = [1.0_wp, 0.5_wp, 0.2_wp] !! of the load, under which contacts are released [1]

contains

  !> Fixes the edge where it rests while contacts are released, and seeks from there the height where it stays by
  !> itself: the equilibrium with a resting edge, where there is one, rather than those whose edge is lifted.
  !>
  !> Where it stays nowhere `ends` is true, the report says what was measured, and the state is left with the edge fixed
  !> where that took the least force. It is true as well where the load cannot be reached, and the report then has how
  !> that ended.
  subroutine try_free_edge(problem, report, ends)
    type(start_problem_type), intent(inout) :: problem !! what is to be solved
    type(path_report_type), intent(out) :: report !! how it ended
    logical, intent(out) :: ends !! there is no answer
    type(path_settings_type) :: settings
    type(operating_point_type) :: easier
    type(kept_state_type) :: fixed
    logical :: bends
    integer :: number

    ends = .false.
    settings = settings_with_fixed_edge(problem%settings)
    do number = 1, merge(size(shares), 1, problem%bearing%floats)
      easier = with_fixed_edges(problem)
      easier%load = shares(number)*problem%target%load
      call guess_position(problem%bearing, problem%scene, easier, usual_contacts%eccentricity)
      call approach(problem%bearing, problem%newton, easier, settings, usual_contacts, report)
      if (.not. report%shaft_fixed) exit
    end do
    if (report%shaft_fixed) return
    if (report%converged() .and. number > 1) report%ending = path_lost('')
    if (.not. report%converged()) then
      call fixed%keep(problem%bearing)
      call go_on_released(problem, report, ends)
      if (.not. (report%converged() .or. ends)) call go_on_fixed(problem, settings, fixed, report, ends)
      call fixed%destroy()
    end if
    if (report%converged() .and. any(problem%bearing%point%edge_hold > 0.0_wp)) then
      call release_edges(problem, report, ends)
      bends = edge_bends(problem%bearing)
      if (ends .and. bends) call try_with_bent_edge(problem, report, ends)
    end if
  end subroutine try_free_edge

  !> An edge that is drawn up where it is kept straight may yet rest with its middle lower than its ends: without any hold
  !> there is one more trial before it is refused.
  subroutine try_with_bent_edge(problem, report, ends)
    type(start_problem_type), intent(inout) :: problem
    type(path_report_type), intent(inout) :: report !! of a straight edge; replaced where there is an answer
    logical, intent(inout) :: ends
    type(path_report_type) :: bent
    logical :: bent_ends

    call problem%newton%log%detail('the free edge may bend')
    call try_soft_contacts(problem, usual_contacts, bent, bent_ends)
    if (bent%converged()) then
      report = bent
      ends = .false.
    else
      call problem%anchor%put_back(problem%bearing)
    end if
  end subroutine try_with_bent_edge

  !> Whether nodes of the edge move apart: those of shells do, those of a beam do not.
  function edge_bends(bearing) result(bends)
    type(bearing_system_type), intent(in) :: bearing
    logical :: bends
    bends = any_rank(bearing%pad(1)%edge%pairs() > 0)
  end function edge_bends

  !> Short of the target: releases the edge there, and follows the branch.
  subroutine go_on_released(problem, report, ends)
    type(start_problem_type), intent(inout) :: problem
    type(path_report_type), intent(inout) :: report
    logical, intent(out) :: ends !! the shaft touches down
    type(operating_point_type) :: free

    ends = .false.
    free = problem%bearing%point
    free%edge_hold = 0.0_wp
    free%edge_height = 0.0_wp
    call release(problem, free, problem%newton%settings, &
                 [lowest*clearance_of(problem%bearing), maxval(problem%bearing%point%edge_height)], report)
    if (.not. report%converged()) return
    call problem%anchor%keep(problem%bearing)
    call follow_path(problem%bearing, problem%newton, problem%target, first_step, trial_settings(problem%settings), report)
    ends = report%has_cause()
  end subroutine go_on_released

  !> The branch with the edge released does not lead to the target: goes on with the edge fixed, which cannot fold by it.
  subroutine go_on_fixed(problem, settings, fixed, report, ends)
    type(start_problem_type), intent(inout) :: problem
    type(path_settings_type), intent(in) :: settings !! of paths with the edge fixed
    type(kept_state_type), intent(in) :: fixed !! state with the edge fixed, short of the target
    type(path_report_type), intent(inout) :: report
    logical, intent(out) :: ends !! neither leads there
    type(path_report_type) :: released
    type(kept_state_type) :: last
    logical :: sunk

    released = report
    call last%keep(problem%bearing)
    call fixed%put_back(problem%bearing)
    call follow_path(problem%bearing, problem%newton, with_fixed_edges(problem), first_step, settings, report)
    if (size(problem%bearing%pad) > 1 .and. .not. report%converged()) then
      call fixed%put_back(problem%bearing)
      call release_pressed(problem)
      call follow_path(problem%bearing, problem%newton, with_same_edges(problem), first_step, &
                       trial_settings(problem%settings), report)
    end if
    ! Without a hold the edge lies lower, and the path may lead on; of several such edges were released before.
    sunk = edge_force(problem%bearing, 1) > 0.0_wp
    sunk = sunk .and. size(problem%bearing%pad) == 1
    ends = .not. report%converged() .and. (report%has_cause() .and. .not. sunk .or. released%ending%kind == ending_fold)
    if (ends .and. released%ending%kind == ending_fold) then
      report = released
      call last%put_back(problem%bearing)
    else if (ends) then
      call report%ending%add_words('', held)
    else if (.not. report%converged()) then
      call release_short_of_load(problem, report, ends)
    end if
    call last%destroy()
  end subroutine go_on_fixed

  !> No step leads to the target with the edge fixed: where it is fixed now, seeks the height where it stays by itself, and
  !> follows the branch from there.
  subroutine release_short_of_load(problem, report, ends)
    type(start_problem_type), intent(inout) :: problem
    type(path_report_type), intent(inout) :: report !! of the path with the edge fixed
    logical, intent(out) :: ends !! the edge stays nowhere, or the branch ends
    type(operating_point_type) :: target
    type(path_report_type) :: short
    type(kept_state_type) :: last
    real(wp) :: share

    target = problem%target
    problem%target = report%reached
    problem%target%edge_hold = 0.0_wp
    problem%target%edge_height = 0.0_wp
    call last%keep(problem%bearing)
    share = norm2(problem%target%load)/max(norm2(target%load), tiny(1.0_wp))
    call release_edges(problem, short, ends)
    problem%target = target
    if (short%converged()) then
      call problem%anchor%keep(problem%bearing)
      call follow_path(problem%bearing, problem%newton, target, first_step, trial_settings(problem%settings), report)
      ends = report%has_cause()
    else if (ends) then
      report = short
      call report%ending%add_words('', ', under '//text(100.0_wp*share, 3)//' % of the load; from there '// &
                                   'no step leads on with the edge fixed')
    else
      call last%put_back(problem%bearing)
      call report%ending%add_words('', held//', where the film presses it down')
    end if
    call last%destroy()
  end subroutine release_short_of_load
end module gfb_edge_start
