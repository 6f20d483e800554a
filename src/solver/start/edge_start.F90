#include "gfb_petsc.h"
!> The start of a bearing whose free edge is fixed at one height after the other.
!>
!> The film's suction may draw the free edge of the top foil off its bumps: an unstable motion that
!> hides what equilibria there are from Newton's method. With the edge fixed at a height the rest has
!> an answer, and the force that holds it tells more: where it changes its sense from one height to
!> the next there is an equilibrium between, and where it never does the edge stays nowhere.
module gfb_edge_start
  use gfb_kinds, only: wp
  use gfb_text, only: text
  use gfb_petsc_session, only: any_rank
  use gfb_operating_point, only: operating_point_type
  use gfb_bearing_system, only: bearing_system_type
  use gfb_bearing_directions, only: edge_lift, edge_room
  use gfb_newton, only: newton_type
  use gfb_continuation, only: path_settings_type, path_report_type
  use gfb_start_position, only: solve_at
  use gfb_start_problem, only: start_problem_type, soft_contacts_type
  use gfb_contact_start, only: try_soft_contacts, usual_contacts, shortest_trial
  implicit none (type)
  private
  public :: try_resting_edge, try_held_edge, has_free_edge

  real(wp), parameter :: lowest = -0.05_wp       !! height of the edge, over the clearance [1]
  real(wp), parameter :: next_height = 0.1_wp    !! above the one before, the same [1]
  integer, parameter :: near_heights = 6         !! from which on they lie twice as far apart
  real(wp), parameter :: near_shaft = 0.5_wp     !! room above the edge that ends the search, the same [1]
  real(wp), parameter :: hold_share = 100.0_wp   !! stiffness of the spring that fixes it, times clearance over a force [1]
  integer, parameter :: most_heights = 16
  integer, parameter :: most_steps = 10          !! of a path with the edge fixed
  integer, parameter :: most_failures = 2        !! one after the other, then it is given up
  integer, parameter :: patience = 2             !! times the iterations of a solve with the edge fixed
  real(wp), parameter :: small_step = 2.0e-3_wp  !! of the height, for the slope of the force; also near enough [1]
  integer, parameter :: most_trials = 6          !! to find where there is none
  real(wp), parameter :: least_fall = 0.5_wp     !! of the force from trial to trial, to continue
  integer, parameter :: hasty_iterations = 15    !! of a trial
  real(wp), parameter :: micrometres = 1.0e6_wp  !! in a metre

contains

  !> Whether the top foil has an edge that is fixed nowhere.
  function has_free_edge(bearing) result(has)
    type(bearing_system_type), intent(in) :: bearing !! a bearing with contacts
    logical :: has

    has = any_rank(size(bearing%pad(1)%edge%unknown) > 0)
  end function has_free_edge

  !> Fixes the edge where it rests while contacts are released, and then releases it: to the equilibrium with a resting
  !> edge, where there is one, rather than to those whose edge is lifted.
  recursive subroutine try_resting_edge(problem, soft, report, ends)
    type(start_problem_type), intent(inout) :: problem !! what is to be solved
    type(soft_contacts_type), intent(in) :: soft !! none: the usual ones
    type(path_report_type), intent(out) :: report !! how it ended
    logical, intent(out) :: ends !! never

    ends = .false.
    call hold_at(problem, 0.0_wp, report)
    report%touched = .false. ! with the edge fixed
    if (report%converged) then
      call solve_at(problem%bearing, problem%newton, problem%target, .false., problem%settings, report)
    end if
  end subroutine try_resting_edge

  !> Fixes the edge higher and higher, and releases it where it may stay.
  !>
  !> Where it stays nowhere `ends` is true, and the report says what was measured; the state is then of
  !> no use.
  recursive subroutine try_held_edge(problem, soft, report, ends)
    type(start_problem_type), intent(inout) :: problem !! what is to be solved
    type(soft_contacts_type), intent(in) :: soft !! none: the usual ones
    type(path_report_type), intent(out) :: report !! how it ended
    logical, intent(out) :: ends !! the edge is drawn up at all heights below the shaft: there is no answer
    real(wp) :: height, highest, least, room
    integer :: number, failures
    logical :: reached !! the shaft is near

    call problem%newton%log%line('the free edge of the top foil is fixed, higher and higher')
    least = huge(least)
    ends = .true.
    reached = .false.
    failures = 0
    highest = 0.0_wp
    room = huge(room)
    do number = 1, most_heights
      height = max(lowest, (number - 2 + max(0, number - near_heights))*next_height)*problem%bearing%pad(1)%film%clearance
      call hold_at(problem, height, report)
      if (report%converged) then
        failures = 0
        highest = height
        room = edge_room(problem%bearing)
        call problem%newton%log%line('  at '//text(height*micrometres, 4)//' um by '//text(edge_force(problem%bearing), 4)//' N')
        call release_edge(problem%target, problem%settings, problem%bearing, problem%newton, least, report)
        if (report%converged) return
        reached = room < near_shaft*problem%bearing%pad(1)%film%clearance
        if (reached) exit
      else
        call problem%newton%log%line('  at '//text(height*micrometres, 4)//' um: '//report%reason)
        failures = failures + 1
        ends = .false.
        if (failures >= most_failures) exit
      end if
    end do
    report%converged = .false.
    report%touched = .false.
    ends = ends .and. reached .and. least > 0.0_wp
    if (ends) report%reason = 'the film draws the free edge of the top foil to the shaft: fixed at '// &
      text(number)//' heights up to '//text(highest*micrometres, 3)//' um, '//text(room*micrometres, 2)// &
      ' um below the shaft, it has to be pressed down at each, by '//text(least, 2)//' N or more'
  end subroutine try_held_edge

  !> An answer with the edge fixed at a height.
  recursive subroutine hold_at(problem, height, report)
    type(start_problem_type), intent(in) :: problem
    real(wp), intent(in) :: height !! of the edge above its height at rest [m]
    type(path_report_type), intent(out) :: report
    type(start_problem_type) :: fixed
    integer :: allowed
    logical :: ends

    fixed = problem
    fixed%others_left = .false.
    fixed%settings%look_for_folds = .false.
    fixed%settings%smallest_step = shortest_trial
    fixed%settings%maximum_steps = min(problem%settings%maximum_steps, most_steps)
    fixed%target%edge_hold = hold_share*problem%bearing%force_scale()/problem%bearing%pad(1)%film%clearance
    fixed%target%edge_height = height
    associate (settings => problem%newton%settings)
      allowed = settings%maximum_iterations
      settings%maximum_iterations = patience*allowed
      call try_soft_contacts(fixed, usual_contacts, report, ends)
      settings%maximum_iterations = allowed
    end associate
  end subroutine hold_at

  !> Goes to the height near by where no force is needed, and releases the edge there.
  subroutine release_edge(target, settings, bearing, newton, least, report)
    type(operating_point_type), intent(in) :: target
    type(path_settings_type), intent(in) :: settings
    type(bearing_system_type), intent(inout) :: bearing
    type(newton_type), target, intent(inout) :: newton
    real(wp), intent(inout) :: least !! force that presses the edge down, of all heights so far [N]
    type(path_report_type), intent(out) :: report
    type(operating_point_type) :: fixed
    real(wp) :: force, force_before, step, rise
    integer :: trial, allowed

    allowed = newton%settings%maximum_iterations
    newton%settings%maximum_iterations = min(hasty_iterations, allowed)
    fixed = bearing%point
    force = edge_force(bearing)
    least = min(least, -force)
    step = small_step*bearing%pad(1)%film%clearance
    rise = 0.0_wp
    do trial = 1, most_trials
      force_before = force
      fixed%edge_height = fixed%edge_height + step
      rise = rise + step
      call solve_at(bearing, newton, fixed, .false., settings, report)
      if (.not. report%converged) exit
      force = edge_force(bearing)
      least = min(least, -force)
      call newton%log%detail('free edge fixed at '//text(fixed%edge_height*micrometres, 5)//' um by '//text(force, 4)//' N')
      report%converged = .false.
      if (trial > 1 .and. abs(force) > least_fall*abs(force_before)) exit
      step = step*force/(force_before - force)
      if (.not. abs(rise + step) <= next_height*bearing%pad(1)%film%clearance) exit ! there is none near by
      if (abs(step) <= small_step*bearing%pad(1)%film%clearance) then
        call solve_at(bearing, newton, target, .false., settings, report)
        if (report%converged) exit
      end if
    end do
    newton%settings%maximum_iterations = allowed
  end subroutine release_edge

  !> Force of the spring that fixes the edge, towards the shaft [N].
  function edge_force(bearing) result(force)
    type(bearing_system_type), intent(in) :: bearing
    real(wp) :: force
    force = bearing%point%edge_hold*(bearing%point%edge_height - edge_lift(bearing))
  end function edge_force
end module gfb_edge_start
