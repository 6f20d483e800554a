#include "gfb_petsc.h"
!> The height at which the top foil's free edge stays by itself, from where it is fixed.
!>
!> The force that fixes the edge is followed from height to height. Where it changes its sense the edge needs none, and is
!> released; where it never does below the shaft the edge is drawn up everywhere, and stays nowhere.
module gfb_edge_heights
  use gfb_kinds, only: wp
  use gfb_petsc_session, only: any_rank
  use gfb_text, only: text
  use gfb_operating_point, only: operating_point_type
  use gfb_bearing_system, only: bearing_system_type
  use gfb_bearing_directions, only: edge_lift, edge_room, edge_force
  use gfb_newton, only: newton_type, newton_settings_type
  use gfb_continuation, only: path_settings_type, path_report_type, follow_path
  use gfb_start_position, only: solve_at
  use gfb_start_problem, only: start_problem_type, trial_settings
  use gfb_kept_state, only: kept_state_type
  implicit none (type)
  private
  public :: ask_edge, release_edge, release, with_fixed_edge, settings_with_fixed_edge, has_free_edge, clearance_of

  real(wp), parameter :: resting = 0.02_wp       !! highest edge that rests, over the clearance [1]
  real(wp), parameter :: hold_share = 100.0_wp   !! stiffness of the spring that fixes it, times clearance over a force [1]
  real(wp), parameter :: first_step = 0.25_wp    !! of a path with the edge fixed, to the target [1]
  character(len=*), parameter :: suction = 'the film draws the free edge of the top foil to the shaft'
  real(wp), parameter :: low_edge = -0.2_wp      !! height of an edge that lies on its bumps, over the clearance [1]
  real(wp), parameter, public :: lowest = -0.5_wp !! where the film still presses it down, the same [1]
  real(wp), parameter :: lower_step = 0.02_wp    !! of the edge on its way down there, the same [1]
  real(wp), parameter :: firm = 10.0_wp          !! times the largest force so far: the bumps push the edge back [1]
  real(wp), parameter :: next_height = 0.1_wp    !! from the one before, the same [1]
  integer, parameter :: near_heights = 6         !! from which on they lie twice as far apart
  real(wp), parameter :: near_shaft = 0.5_wp     !! room above the edge that ends the search, the same [1]
  real(wp), parameter :: least_room = 0.02_wp    !! room above it that ends it in any case, the same [1]
  integer, parameter :: long_rise = 4            !! of forces in succession, that shows enough where the shaft then touches down
  integer, parameter :: most_heights = 20
  integer, parameter :: few_straight = 3         !! Newton steps with the edge fixed, before they are bent
  real(wp), parameter :: rough_residual = 1.0e-4_wp, rough_step = 1.0e-3_wp !! tolerances of forces that fix the edge [1]
  integer, parameter :: more_straight = 8        !! of them when it is released
  real(wp), parameter :: same_height = 0.01_wp   !! difference that does not matter, over the clearance [1]
  integer, parameter :: hasty_iterations = 25    !! to release it
  integer, parameter :: most_trials = 16         !! to find where the edge needs no force
  real(wp), parameter :: least_fall = 0.5_wp     !! of the force from release to release [1]
  real(wp), parameter :: least_share = 0.02_wp   !! of the way between two heights, from either [1]
  real(wp), parameter :: micrometres = 1.0e6_wp  !! in a metre

contains

  !> Whether the top foil has an edge that is fixed nowhere.
  function has_free_edge(bearing) result(has)
    type(bearing_system_type), intent(in) :: bearing !! a bearing with contacts
    logical :: has

    has = any_rank(size(bearing%pad(1)%edge%unknown) > 0) .and. size(bearing%pad) == 1 ! each of several has its own
  end function has_free_edge

  !> The target with the edge fixed at its height at rest.
  function with_fixed_edge(problem) result(target)
    type(start_problem_type), intent(in) :: problem
    type(operating_point_type) :: target

    target = problem%target
    target%edge_hold = hold_share*problem%bearing%force_scale()/clearance_of(problem%bearing)
    target%edge_height = 0.0_wp
  end function with_fixed_edge

  !> Limits of a path along which the edge is fixed.
  pure function settings_with_fixed_edge(settings) result(fixed)
    type(path_settings_type), intent(in) :: settings
    type(path_settings_type) :: fixed

    fixed = trial_settings(settings)
    fixed%look_for_folds = .false.
  end function settings_with_fixed_edge

  !> From an answer short of the target: fixes the edge where it is, goes to the target with it, and seeks the height where
  !> it stays by itself.
  subroutine ask_edge(problem, report, ends)
    type(start_problem_type), intent(inout) :: problem !! what is to be solved, at an answer
    type(path_report_type), intent(out) :: report !! how it ended; converged: with the edge released
    logical, intent(out) :: ends !! the edge stays nowhere
    type(operating_point_type) :: fixed

    ends = .false.
    fixed = with_fixed_edge(problem)
    fixed%edge_height = edge_lift(problem%bearing)
    problem%bearing%point%edge_hold = fixed%edge_hold
    problem%bearing%point%edge_height = fixed%edge_height
    call follow_path(problem%bearing, problem%newton, fixed, first_step, settings_with_fixed_edge(problem%settings), report)
    if (report%converged) call release_edge(problem, report, ends)
  end subroutine ask_edge

  !> At the target: releases the edge where it stays by itself.
  subroutine release_edge(problem, report, ends)
    type(start_problem_type), intent(inout) :: problem
    type(path_report_type), intent(inout) :: report
    logical, intent(out) :: ends !! it stays nowhere
    real(wp) :: highest !! edge that is accepted, over the clearance [1]
    logical :: drawn_up

    ends = .false.
    report%converged = .false.
    ! It moves the way the film presses it.
    drawn_up = edge_force(problem%bearing) < 0.0_wp
    highest = merge(resting, 0.0_wp, drawn_up)
    call release(problem, problem%target, problem%newton%settings, &
                 [merge(low_edge, lowest, drawn_up), highest]*clearance_of(problem%bearing), report)
    if (.not. report%converged) call seek_height(problem, settings_with_fixed_edge(problem%settings), report, ends)
  end subroutine release_edge

  !> From where the edge is fixed at its height at rest, seeks the height where it needs no force, and releases it there:
  !> below, where it lies on its bumps, before above.
  subroutine seek_height(problem, path, report, ends)
    type(start_problem_type), intent(inout) :: problem !! what is to be solved, with an answer at a fixed edge
    type(path_settings_type), intent(in) :: path !! limits of paths with the edge fixed
    type(path_report_type), intent(inout) :: report !! how it ended
    logical, intent(out) :: ends !! it stays nowhere
    type(path_settings_type) :: settings
    type(newton_settings_type) :: wanted
    type(kept_state_type) :: at_rest
    logical :: drawn_up, lower

    settings = path
    settings%touch_down_gap = 0.0_wp
    wanted = problem%newton%settings
    call be_rough(problem%newton%settings)
    ends = .false.
    drawn_up = edge_force(problem%bearing) < 0.0_wp
    call at_rest%keep(problem%bearing)
    call seek_below(problem, settings, wanted, lower, report)
    if (drawn_up .and. .not. (lower .or. report%converged)) then
      call at_rest%put_back(problem%bearing)
      call seek_above(problem, settings, wanted, report, ends)
    end if
    call at_rest%destroy()
    problem%newton%settings = wanted
  end subroutine seek_height

  !> Lowers the edge to where the bumps push it back: there it needs no force, if it needed one that lifts it before.
  subroutine seek_below(problem, settings, wanted, lower, report)
    type(start_problem_type), intent(in) :: problem
    type(path_settings_type), intent(in) :: settings !! of paths with the edge fixed
    type(newton_settings_type), intent(in) :: wanted !! at the target
    logical, intent(out) :: lower !! at the lowest height it is still to be lifted
    type(path_report_type), intent(inout) :: report
    type(operating_point_type) :: next
    real(wp) :: force, force_before, height_before, largest

    lower = .false.
    associate (bearing => problem%bearing, clearance => clearance_of(problem%bearing))
      force = edge_force(bearing)
      largest = abs(force)
      call note_height(problem%newton, bearing, force)
      do
        height_before = bearing%point%edge_height
        force_before = force
        next = bearing%point
        next%edge_height = height_before - merge(2.0_wp, 1.0_wp, height_before < low_edge*clearance)*lower_step*clearance
        call follow_path(bearing, problem%newton, next, 1.0_wp, settings, report)
        force = edge_force(bearing)
        call note_height(problem%newton, bearing, force)
        if (force_before > 0.0_wp .and. .not. force > 0.0_wp) then
          call release_between(problem, settings, wanted, height_before, force_before, force, report)
          return
        end if
        if (.not. report%converged .or. force < -firm*largest .or. &
            bearing%point%edge_height < merge(lowest, low_edge, force > 0.0_wp)*clearance) exit
        largest = max(largest, force)
      end do
      lower = force > 0.0_wp
    end associate
    report%converged = .false.
    if (report%has_cause()) then
      report%reason = report%reason//', as the film presses the free edge of the top foil down'
    else
      report%reason = 'the edge of the top foil stays at no height below that at rest'
    end if
  end subroutine seek_below

  !> Raises the edge to where it needs no force; where there is none below the shaft, that is the end.
  subroutine seek_above(problem, settings, wanted, report, ends)
    type(start_problem_type), intent(inout) :: problem
    type(path_settings_type), intent(in) :: settings !! of paths with the edge fixed
    type(newton_settings_type), intent(in) :: wanted !! at the target
    type(path_report_type), intent(inout) :: report
    logical, intent(out) :: ends !! it stays nowhere
    type(kept_state_type) :: nearest !! where the edge needs the least force
    type(operating_point_type) :: next
    real(wp) :: force, force_before, height_before, highest, least, room, step
    character(len=:), allocatable :: heights
    integer :: number, rising !! rising: heights in succession, at each of which the edge is drawn up more

    ends = .false.
    associate (bearing => problem%bearing, newton => problem%newton, clearance => clearance_of(problem%bearing))
      force = edge_force(bearing)
      least = abs(force)
      call nearest%keep(bearing)
      room = edge_room(bearing)
      rising = 0
      do number = 1, most_heights
        step = merge(1.0_wp, 2.0_wp, number <= near_heights)*next_height*clearance
        height_before = bearing%point%edge_height
        force_before = force
        next = bearing%point
        next%edge_height = height_before + min(step, 0.5_wp*room)
        call follow_path(bearing, newton, next, 1.0_wp, settings, report)
        force = edge_force(bearing)
        room = edge_room(bearing)
        call note_height(newton, bearing, force)
        if (force > 0.0_wp) then
          call release_between(problem, settings, wanted, height_before, force_before, force, report)
          call nearest%destroy()
          return
        end if
        rising = merge(rising + 1, 0, force < force_before)
        if (abs(force) < least) then
          least = abs(force)
          call nearest%keep(bearing)
        end if
        if (.not. report%converged) exit
        ! Near the shaft it ends, unless the force still falls: it may vanish before the edge meets the shaft.
        if (room < near_shaft*clearance .and. (force <= force_before .or. room < least_room*clearance)) exit
      end do
      highest = bearing%point%edge_height
      heights = ': fixed at '//text(number + 1)//' heights up to '//text(highest*micrometres, 3)//' um, '// &
        text(room*micrometres, 2)//' um below the shaft, it has to be pressed down at each, by '//text(least, 2)//' N or more'
      ends = report%converged .and. room < near_shaft*clearance .or. report%touched .and. rising >= long_rise
      if (ends) then
        call nearest%put_back(bearing)
        call problem%anchor%keep(bearing)
        report%shaft_fixed = .false.
        report%touched = .false.
        report%drawn = .true.
        report%reason = suction//heights
      else
        if (highest > 0.0_wp) problem%suspicion = suction//', as far as it was followed'//heights//'; higher up '//report%reason
        report%reason = 'fixed at '//text(number + 1)//' heights the free edge of the top foil needs '// &
          text(least, 2)//' N or more; '//report%reason
      end if
      report%converged = .false.
      call nearest%destroy()
    end associate
  end subroutine seek_above

  !> Between two heights with forces of opposite senses: goes where there is none by false position, with the weights of
  !> the Illinois rule where contacts make the force bend, and releases the edge there.
  subroutine release_between(problem, settings, wanted, height_before, force_before, force_here, report)
    type(start_problem_type), intent(in) :: problem
    type(path_settings_type), intent(in) :: settings !! of paths with the edge fixed
    type(newton_settings_type), intent(in) :: wanted !! at the target
    real(wp), intent(in) :: height_before !! of the edge, on the other side [m]
    real(wp), intent(in) :: force_before, force_here !! that fix it there and here [N]
    type(path_report_type), intent(inout) :: report
    type(operating_point_type) :: next
    real(wp) :: height(2), force(2), force_next, tried, share
    integer :: trial, side, side_before

    height = [height_before, problem%bearing%point%edge_height]
    force = [force_before, force_here]
    tried = minval(abs(force))
    side_before = 0
    do trial = 1, most_trials
      next = problem%bearing%point
      share = force(1)/(force(1) - force(2))
      next%edge_height = height(1) + (height(2) - height(1))*max(least_share, min(1.0_wp - least_share, share))
      call follow_path(problem%bearing, problem%newton, next, 1.0_wp, settings, report)
      if (.not. report%converged) exit
      force_next = edge_force(problem%bearing)
      call note_height(problem%newton, problem%bearing, force_next)
      side = merge(1, 2, (force_next > 0.0_wp) .eqv. (force(1) > 0.0_wp))
      if (side == side_before) force(3 - side) = 0.5_wp*force(3 - side)
      side_before = side
      height(side) = next%edge_height
      force(side) = force_next
      report%converged = .false.
      if (abs(force_next) > least_fall*tried) cycle
      tried = abs(force_next)
      call release(problem, problem%target, wanted, height, report)
      if (report%converged) exit
    end do
  end subroutine release_between

  !> Releases the edge; where that does not succeed, or leads to an edge elsewhere, the state stays as it was.
  subroutine release(problem, free, wanted, between, report)
    type(start_problem_type), intent(in) :: problem !! what is to be solved, with an answer at a fixed edge
    type(operating_point_type), intent(in) :: free !! the point without a force on the edge
    type(newton_settings_type), intent(in) :: wanted !! when Newton's method stops there
    real(wp), intent(in) :: between(2) !! heights where the edge should stay [m]
    type(path_report_type), intent(inout) :: report !! how it ended
    type(newton_settings_type) :: rough
    type(kept_state_type) :: fixed
    real(wp) :: lift, slack

    rough = problem%newton%settings
    problem%newton%settings = wanted
    problem%newton%settings%straight_steps = more_straight
    problem%newton%settings%maximum_iterations = min(hasty_iterations, wanted%maximum_iterations)
    call fixed%keep(problem%bearing)
    call solve_at(problem%bearing, problem%newton, free, .false., problem%settings, report)
    if (report%converged) then
      lift = edge_lift(problem%bearing)
      slack = same_height*clearance_of(problem%bearing)
      report%converged = lift > minval(between) - slack .and. lift < maxval(between) + slack
      if (.not. report%converged) report%reason = 'the released edge moves to '//text(lift*micrometres, 4)//' um'
    end if
    if (.not. report%converged) call fixed%put_back(problem%bearing)
    call fixed%destroy()
    problem%newton%settings = rough
  end subroutine release

  !> What is enough where a force is looked at: contacts settle by bent steps.
  subroutine be_rough(settings)
    type(newton_settings_type), intent(inout) :: settings

    settings%straight_steps = few_straight
    settings%residual_tolerance = max(settings%residual_tolerance, rough_residual)
    settings%step_tolerance = max(settings%step_tolerance, rough_step)
  end subroutine be_rough

  !> Tells a height and its force.
  subroutine note_height(newton, bearing, force)
    type(newton_type), intent(in) :: newton
    type(bearing_system_type), intent(in) :: bearing
    real(wp), intent(in) :: force

    call newton%log%detail('free edge fixed at '//text(bearing%point%edge_height*micrometres, 4)//' um by '// &
                           text(force, 4)//' N')
  end subroutine note_height

  !> The bearing's clearance [m].
  pure function clearance_of(bearing) result(clearance)
    type(bearing_system_type), intent(in) :: bearing !! a bearing
    real(wp) :: clearance
    clearance = bearing%pad(1)%film%clearance
  end function clearance_of
end module gfb_edge_heights
