#include "gfb_petsc.h"
!> The start of a bearing whose free edge is fixed, first where it rests, then higher and higher.
!>
!> The film's suction may draw the free edge of the top foil off its bumps: an unstable motion that
!> hides what equilibria there are from Newton's method. With the edge fixed at a height the rest has
!> an answer, and the force that holds it there shows more: where it changes its sense from one height
!> to the next the edge stays between them by itself, and where it never does it stays nowhere.
!> Edges of several pads are released one after the other.
module gfb_edge_start
  use gfb_kinds, only: wp
  use gfb_units, only: micrometres
  use gfb_ending, only: path_is_drawn, path_lost, ending_touch_down
  use gfb_petsc_session, only: any_rank
  use gfb_text, only: text
  use gfb_operating_point, only: operating_point_type
  use gfb_bearing_system, only: bearing_system_type
  use gfb_bearing_directions, only: edge_lift, edge_room, edge_force, edge_words
  use gfb_newton, only: newton_settings_type
  use gfb_continuation, only: path_settings_type, path_report_type, follow_path
  use gfb_start_position, only: solve_at, guess_position
  use gfb_start_problem, only: start_problem_type, settings_with_fixed_edge, clearance_of, with_fixed_edges, shortest_trial
  use gfb_saved_state, only: saved_state_type
  use gfb_soft_contact_start, only: approach, try_soft_contacts, usual_contacts
  implicit none (type)
  private
  public :: try_free_edge

  !> Highest edge that rests, over the clearance: higher accepts edges that the film lifts, lower looks for others in vain. As
  !> much an edge is lowered by at a time, and room for as much above it is none [1].
  real(wp), parameter, public :: resting = 0.02_wp
  real(wp), parameter :: low_edge = -0.2_wp      !! height of an edge that lies on its bumps, over the clearance [1]
  real(wp), parameter :: lowest = -0.5_wp !! where the film still presses it down, the same [1]
  real(wp), parameter :: max_force_ratio = 10.0_wp !! times the largest force so far: the bumps push the edge back [1]
  !> From a height to the next, the same: longer steps miss an edge that stays between two, shorter ones are more of them [1]
  real(wp), parameter, public :: next_height = 0.1_wp
  integer, parameter :: near_heights = 6         !! from which on they lie twice as far apart
  real(wp), parameter :: near_shaft = 0.5_wp     !! room above the edge that ends the search, the same [1]
  integer, parameter :: long_rise = 4            !! of forces in succession, that shows enough where the shaft then touches down
  integer, parameter :: most_heights = 20
  integer, parameter :: few_straight = 3         !! Newton steps with the edge fixed, before they are bent
  real(wp), parameter :: rough_residual = 1.0e-4_wp, rough_step = 1.0e-3_wp !! tolerances of forces that fix the edge [1]
  integer, parameter :: more_straight = 8        !! of them when it is released
  real(wp), parameter, public :: same_height = 0.01_wp !! difference that does not matter, over the clearance [1]
  integer, parameter :: max_iterations = 25      !! to release it
  integer, parameter :: most_trials = 16         !! to find where the edge needs no force
  real(wp), parameter :: least_fall = 0.5_wp     !! of the force from release to release [1]

  real(wp), parameter :: shares(3) = [1.0_wp, 0.5_wp, 0.2_wp] !! of the load, under which contacts are released [1]

contains

  !> At the target: releases all edges that are fixed; those of several pads at once, or one after the other, first those
  !> that the film presses down.
  subroutine release_edges(problem, report, ends)
    type(start_problem_type), intent(inout) :: problem
    type(path_report_type), intent(inout) :: report
    logical, intent(out) :: ends !! one stays nowhere
    real(wp), allocatable :: force(:) ! that fixes each edge [N]
    integer, allocatable :: held(:)
    integer :: pad

    ends = .false.
    associate (bearing => problem%bearing)
      held = pack([(pad, pad=1, size(bearing%pad))], bearing%point%edge_hold(:size(bearing%pad)) > 0.0_wp)
      if (size(held) > 1) then
        call release(problem, problem%target, problem%newton%settings, [lowest, resting]*clearance_of(bearing), report)
        if (report%converged()) return
      end if
      force = [(edge_force(bearing, held(pad)), pad=1, size(held))]
      do while (size(held) > 0)
        pad = minloc(force, 1)
        call release_edge(problem, held(pad), report, ends)
        if (.not. report%converged()) exit
        held = [held(:pad - 1), held(pad + 1:)]
        force = [force(:pad - 1), force(pad + 1:)]
      end do
    end associate
  end subroutine release_edges

  !> The target with a pad's edge released, and the others as they are.
  pure function with_released_edge(problem, pad) result(free)
    type(start_problem_type), intent(in) :: problem
    integer, intent(in) :: pad !! its number
    type(operating_point_type) :: free

    free = problem%target
    free%edge_hold = problem%bearing%point%edge_hold
    free%edge_height = problem%bearing%point%edge_height
    free%edge_hold(pad) = 0.0_wp
    free%edge_height(pad) = 0.0_wp
  end function with_released_edge

  !> At the target: releases the edge of a pad where it stays by itself.
  subroutine release_edge(problem, pad, report, ends)
    type(start_problem_type), intent(inout) :: problem
    integer, intent(in) :: pad !! its number
    type(path_report_type), intent(inout) :: report
    logical, intent(out) :: ends !! it stays nowhere
    real(wp) :: highest !! edge that is accepted, over the clearance [1]
    logical :: drawn_up

    ends = .false.
    ! It moves the way the film presses it.
    drawn_up = edge_force(problem%bearing, pad) < 0.0_wp
    highest = merge(resting, 0.0_wp, drawn_up)
    call release(problem, with_released_edge(problem, pad), problem%newton%settings, &
                 [merge(low_edge, lowest, drawn_up), highest]*clearance_of(problem%bearing), report)
    if (.not. report%converged()) call seek_height(problem, pad, settings_with_fixed_edge(problem%settings), report, ends)
  end subroutine release_edge

  !> From where the edge is fixed at its height at rest, seeks the height where it needs no force, and releases it there:
  !> below, where it lies on its bumps, before above.
  subroutine seek_height(problem, pad, path, report, ends)
    type(start_problem_type), intent(inout) :: problem !! what is to be solved, with an answer at a fixed edge
    integer, intent(in) :: pad !! whose edge it is
    type(path_settings_type), intent(in) :: path !! limits of paths with the edge fixed
    type(path_report_type), intent(inout) :: report !! how it ended
    logical, intent(out) :: ends !! it stays nowhere
    type(path_settings_type) :: settings
    type(newton_settings_type) :: wanted
    type(saved_state_type) :: at_rest
    logical :: drawn_up, lower

    settings = path
    settings%touch_down_gap = 0.0_wp
    wanted = problem%newton%settings
    call be_rough(problem%newton%settings)
    ends = .false.
    drawn_up = edge_force(problem%bearing, pad) < 0.0_wp
    call at_rest%save(problem%bearing)
    call seek_below(problem, pad, settings, wanted, lower, report)
    if (drawn_up .and. .not. (lower .or. report%converged())) then
      call at_rest%restore(problem%bearing)
      call seek_above(problem, pad, settings, wanted, report, ends)
    end if
    call at_rest%destroy()
    problem%newton%settings = wanted
  end subroutine seek_height

  !> Lowers the edge to where the bumps push it back: there it needs no force, if it needed one that lifts it before.
  subroutine seek_below(problem, pad, settings, wanted, lower, report)
    type(start_problem_type), intent(in) :: problem
    integer, intent(in) :: pad !! whose edge it is
    type(path_settings_type), intent(in) :: settings !! of paths with the edge fixed
    type(newton_settings_type), intent(in) :: wanted !! at the target
    logical, intent(out) :: lower !! at the lowest height it is still to be lifted
    type(path_report_type), intent(inout) :: report
    real(wp) :: force, force_before, height_before, largest

    lower = .false.
    associate (bearing => problem%bearing, clearance => clearance_of(problem%bearing))
      force = edge_force(bearing, pad)
      largest = abs(force)
      call note_height(problem, pad, force)
      do
        height_before = bearing%point%edge_height(pad)
        force_before = force
        call move_edge(problem, pad, settings, height_before - merge(2.0_wp, 1.0_wp, height_before < low_edge*clearance)* &
                       resting*clearance, force, report)
        if (force_before > 0.0_wp .and. .not. force > 0.0_wp) then
          call release_between(problem, pad, settings, wanted, height_before, force_before, force, report)
          return
        end if
        if (.not. report%converged() .or. force < -max_force_ratio*largest .or. &
            bearing%point%edge_height(pad) < merge(lowest, low_edge, force > 0.0_wp)*clearance) exit
        largest = max(largest, force)
      end do
      lower = force > 0.0_wp
    end associate
    if (report%has_cause()) then
      call report%ending%add_words('', ', as the film presses '//edge_words(problem%bearing, pad)//' down')
    else
      report%ending = path_lost('the edge of the top foil stays at no height below that at rest')
    end if
  end subroutine seek_below

  !> Raises the edge to where it needs no force; where there is none below the shaft, that is the end.
  subroutine seek_above(problem, pad, settings, wanted, report, ends)
    type(start_problem_type), intent(inout) :: problem
    integer, intent(in) :: pad !! whose edge it is
    type(path_settings_type), intent(in) :: settings !! of paths with the edge fixed
    type(newton_settings_type), intent(in) :: wanted !! at the target
    type(path_report_type), intent(inout) :: report
    logical, intent(out) :: ends !! it stays nowhere
    type(saved_state_type) :: nearest !! where the edge needs the least force
    real(wp) :: force, force_before, height_before, least, room, step
    integer :: number, rising !! rising: heights in succession, at each of which the edge is drawn up more

    ends = .false.
    associate (bearing => problem%bearing, clearance => clearance_of(problem%bearing))
      force = edge_force(bearing, pad)
      least = abs(force)
      call nearest%save(bearing)
      room = edge_room(bearing, pad)
      rising = 0
      do number = 1, most_heights
        step = merge(1.0_wp, 2.0_wp, number <= near_heights)*next_height*clearance
        height_before = bearing%point%edge_height(pad)
        force_before = force
        call move_edge(problem, pad, settings, height_before + min(step, 0.5_wp*room), force, report)
        room = edge_room(bearing, pad)
        if (force > 0.0_wp) then
          call release_between(problem, pad, settings, wanted, height_before, force_before, force, report)
          call nearest%destroy()
          return
        end if
        rising = merge(rising + 1, 0, force < force_before)
        if (abs(force) < least) then
          least = abs(force)
          call nearest%save(bearing)
        end if
        if (.not. report%converged()) exit
        ! Near the shaft it ends, unless the force still falls: it may vanish before the edge meets the shaft.
        if (room < near_shaft*clearance .and. (force <= force_before .or. room < resting*clearance)) exit
      end do
      ends = report%converged() .and. room < near_shaft*clearance .or. report%ending%kind == ending_touch_down .and. rising >= long_rise
      if (ends) then
        report%ending = path_is_drawn(edge_words(bearing, pad), number + 1, bearing%point%edge_height(pad), room, least)
        call nearest%restore(bearing)
        call problem%anchor%save(bearing)
        report%shaft_fixed = .false.
      else
        if (report%converged()) report%ending = path_lost('it stays by itself at none of them')
        call report%ending%add_words('fixed at '//text(number + 1)//' heights '//edge_words(bearing, pad)//' needs '// &
                                     text(least, 2)//' N or more; ', '')
      end if
      call nearest%destroy()
    end associate
  end subroutine seek_above

  !> Between two heights with forces of opposite senses: goes where there is none by false position, with the weights of
  !> the Illinois rule where contacts make the force bend, and releases the edge there.
  subroutine release_between(problem, pad, settings, wanted, height_before, force_before, force_here, report)
    type(start_problem_type), intent(in) :: problem
    integer, intent(in) :: pad !! whose edge it is
    type(path_settings_type), intent(in) :: settings !! of paths with the edge fixed
    type(newton_settings_type), intent(in) :: wanted !! at the target
    real(wp), intent(in) :: height_before !! of the edge, on the other side [m]
    real(wp), intent(in) :: force_before, force_here !! that fix it there and here [N]
    type(path_report_type), intent(inout) :: report
    real(wp) :: height(2), height_next, force(2), force_next, tried, share
    integer :: trial, side, side_before

    height = [height_before, problem%bearing%point%edge_height(pad)]
    force = [force_before, force_here]
    tried = minval(abs(force))
    side_before = 0
    do trial = 1, most_trials
      share = force(1)/(force(1) - force(2))
      height_next = height(1) + (height(2) - height(1))*max(shortest_trial, min(1.0_wp - shortest_trial, share))
      call move_edge(problem, pad, settings, height_next, force_next, report)
      if (.not. report%converged()) exit
      side = merge(1, 2, (force_next > 0.0_wp) .eqv. (force(1) > 0.0_wp))
      if (side == side_before) force(3 - side) = 0.5_wp*force(3 - side)
      side_before = side
      height(side) = height_next
      force(side) = force_next
      report%ending = path_lost('no height between '//text(minval(height)*micrometres, 4)//' and '// &
                                text(maxval(height)*micrometres, 4)//' um at which '//edge_words(problem%bearing, pad)//' stays by itself')
      if (abs(force_next) > least_fall*tried) cycle
      tried = abs(force_next)
      call release(problem, with_released_edge(problem, pad), wanted, height, report)
      if (report%converged()) exit
    end do
  end subroutine release_between

  !> Releases edges; where that does not succeed, or leads to an edge elsewhere, the state stays as it was.
  subroutine release(problem, free, wanted, between, report)
    type(start_problem_type), intent(in) :: problem !! what is to be solved, with an answer at a fixed edge
    type(operating_point_type), intent(in) :: free !! the point without a force on them
    type(newton_settings_type), intent(in) :: wanted !! when Newton's method stops there
    real(wp), intent(in) :: between(2) !! heights where they should stay [m]
    type(path_report_type), intent(inout) :: report !! how it ended
    type(newton_settings_type) :: rough
    type(saved_state_type) :: fixed
    real(wp) :: lift, slack
    integer :: pad

    rough = problem%newton%settings
    problem%newton%settings = wanted
    problem%newton%settings%straight_steps = more_straight
    problem%newton%settings%maximum_iterations = min(max_iterations, wanted%maximum_iterations)
    call fixed%save(problem%bearing)
    call solve_at(problem%bearing, problem%newton, free, .false., problem%settings, report)
    if (report%converged()) then
      slack = same_height*clearance_of(problem%bearing)
      do pad = 1, size(problem%bearing%pad)
        if (.not. fixed%point%edge_hold(pad) > 0.0_wp .or. free%edge_hold(pad) > 0.0_wp) cycle
        lift = edge_lift(problem%bearing, pad)
        if (lift > minval(between) - slack .and. lift < maxval(between) + slack) cycle
        report%ending = path_lost('the released edge moves to '//text(lift*micrometres, 4)//' um')
        exit
      end do
    end if
    if (.not. report%converged()) call fixed%restore(problem%bearing)
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

  !> Fixes the edge at another height, and returns the force that it takes.
  subroutine move_edge(problem, pad, settings, height, force, report)
    type(start_problem_type), intent(in) :: problem
    integer, intent(in) :: pad !! whose edge it is
    type(path_settings_type), intent(in) :: settings !! of paths with the edge fixed
    real(wp), intent(in) :: height !! [m]
    real(wp), intent(out) :: force !! that fixes it where the path has ended [N]
    type(path_report_type), intent(out) :: report !! of the path there
    type(operating_point_type) :: next

    next = problem%bearing%point
    next%edge_height(pad) = height
    call follow_path(problem%bearing, problem%newton, next, 1.0_wp, settings, report)
    force = edge_force(problem%bearing, pad)
    call note_height(problem, pad, force)
  end subroutine move_edge

  !> Logs a height and its force.
  subroutine note_height(problem, pad, force)
    type(start_problem_type), intent(in) :: problem
    integer, intent(in) :: pad
    real(wp), intent(in) :: force

    call problem%newton%log%detail(edge_words(problem%bearing, pad)//': fixed at '// &
                                   text(problem%bearing%point%edge_height(pad)*micrometres, 4)//' um by '//text(force, 4)//' N')
  end subroutine note_height

  !> Fixes the edge where it rests while contacts are released, and seeks from there the height where it stays by
  !> itself: the equilibrium with a resting edge, where there is one, rather than those whose edge is lifted.
  !>
  !> Where it stays nowhere `ends` is true, the report says what was measured, and the state is left with the edge fixed
  !> where that took the least force.
  subroutine try_free_edge(problem, report, ends)
    type(start_problem_type), intent(inout) :: problem !! what is to be solved
    type(path_report_type), intent(out) :: report !! how it ended
    logical, intent(out) :: ends !! there is no answer
    type(path_settings_type) :: settings
    type(operating_point_type) :: easier
    integer :: number

    ends = .false.
    settings = settings_with_fixed_edge(problem%settings)
    do number = 1, merge(size(shares), 1, problem%bearing%floats)
      easier = with_fixed_edges(problem)
      easier%load(:2) = shares(number)*problem%target%load(:2)
      call guess_position(problem%bearing, problem%scene, easier, usual_contacts%eccentricity)
      call approach(problem%bearing, problem%newton, easier, settings, usual_contacts, report)
      if (.not. report%shaft_fixed) exit
    end do
    if (report%shaft_fixed) return
    if (report%converged() .and. number > 1) report%ending = path_lost('with the edge fixed the shaft floats under '// &
      text(100.0_wp*shares(number), 3)//' % of the load, not under all of it')
    if (report%converged() .and. any(problem%bearing%point%edge_hold > 0.0_wp)) then
      call release_edges(problem, report, ends)
      if (ends) call try_with_bent_edge(problem, report, ends)
    end if
  end subroutine try_free_edge

  !> An edge that is drawn up where it is kept straight may yet rest with its middle lower than its ends, where it can bend:
  !> without any hold there is one more trial before it is refused.
  subroutine try_with_bent_edge(problem, report, ends)
    type(start_problem_type), intent(inout) :: problem
    type(path_report_type), intent(inout) :: report !! of a straight edge; replaced where there is an answer
    logical, intent(inout) :: ends
    type(path_report_type) :: bent
    logical :: bent_ends

    if (.not. edge_bends(problem%bearing)) return
    call problem%newton%log%detail('the free edge may bend')
    call try_soft_contacts(problem, usual_contacts, bent, bent_ends)
    if (bent%converged()) then
      report = bent
      ends = .false.
    else
      call problem%anchor%restore(problem%bearing)
    end if
  end subroutine try_with_bent_edge

  !> Whether nodes of the edge move apart: those of shells do, those of a beam do not.
  logical function edge_bends(bearing) result(bends)
    type(bearing_system_type), intent(in) :: bearing
    bends = any_rank(bearing%pad(1)%edge%pairs() > 0)
  end function edge_bends
end module gfb_edge_start
