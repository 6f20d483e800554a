#include "gfb_petsc.h"
!> The list of cold starts: which are tried, and in what order.
module gfb_start_list
  use gfb_kinds, only: wp
  use gfb_text, only: text
  use gfb_work_bound, only: gives_up
  use gfb_bearing_system, only: bearing_system_type
  use gfb_operating_point, only: operating_point_type
  use gfb_continuation, only: path_report_type, follow_path
  use gfb_start_problem, only: start_problem_type, cold_start_type, soft_contacts_type, never, after, before, &
                               clearance_of
  use gfb_kept_state, only: kept_state_type
  use gfb_newton, only: find_determinant_sign
  use gfb_smaller_start, only: try_smaller_answer, try_smaller_position, try_smaller_refusal
  use gfb_rigid_start, only: try_from_rest, try_laid_down
  use gfb_contact_start, only: try_soft_contacts, usual_contacts
  use gfb_bearing_directions, only: has_free_edge, edge_lift
  use gfb_edge_heights, only: resting
  use gfb_edge_start, only: try_free_edge
  use gfb_interference_start, only: press, set_interference
  implicit none (type)
  private
  public :: cold_starts, try_starts, start_pressed

  integer, parameter :: most_iterations = 800 !! Newton's, after which no other start begins
  real(wp), parameter :: hardly_lifted = 0.1_wp !! edge of a pad that is no other branch, over the clearance [1]
  real(wp), parameter :: slow = 0.5_wp       !! speed of a slower shaft, over the one asked for [1]
  real(wp), parameter :: first_step = 0.25_wp !! from there, of the path to the speed asked for [1]

  type(soft_contacts_type), parameter :: near_the_foil = soft_contacts_type(before, 0.9_wp, 1.5_wp, 2.0_wp)

  !> The last state of the start that came nearest to an answer.
  type :: nearest_type
    logical :: known = .false.
    type(path_report_type) :: report
    type(kept_state_type) :: kept
  end type nearest_type

contains

  !> All starts, the cheapest and most successful first.
  function cold_starts() result(starts)
    type(cold_start_type), allocatable :: starts(:)

    starts = [ &
      cold_start_type("the smaller system's answer", has_smaller, try_smaller_answer), &
      cold_start_type("the smaller system's position, with the shaft fixed", floats_with_smaller, try_smaller_position), &
      cold_start_type("the end of the smaller system's search", is_refused, try_smaller_refusal), &
      cold_start_type('the fixed shaft from rest to speed', has_no_contacts, try_from_rest, counts=.true.), &
      cold_start_type('the shaft laid on its foil under the load', floats_on_film, try_laid_down, counts=.true.), &
      cold_start_type('soft contacts of several pads, released early under a load', floats_with_free_edges, &
                      try_several_edges, usual_contacts, .true.), &
      cold_start_type('the free edge fixed where it rests', floats_with_free_edge, try_free_edge), &
      cold_start_type('soft contacts, released early under a load', has_other_contacts, try_soft_contacts, &
                      usual_contacts, .true.), &
      cold_start_type('soft contacts, released after the shaft in growing steps', has_contacts, try_soft_contacts, &
                      soft_contacts_type(after, 0.5_wp, 1.5_wp, 2.0_wp), .true.), &
      cold_start_type('soft contacts, released before the shaft near the foil', floats_on_contacts, try_soft_contacts, &
                      near_the_foil, .true.), &
      cold_start_type('the free edge fixed where it rests, under a fixed shaft', fixed_with_free_edge, try_free_edge), &
      cold_start_type('half the speed first', can_be_slower, try_half_speed, counts=.true.)]
  end function cold_starts

  !> The list of starts; where there is interference, from a smaller system's answer with it, or else without it first.
  subroutine start_pressed(problem, report)
    type(start_problem_type), intent(inout) :: problem !! what is to be solved
    type(path_report_type), intent(out) :: report !! how it ended
    real(wp) :: interference

    interference = problem%scene%bearing%interference
    if (.not. interference > 0.0_wp .or. associated(problem%smaller)) then
      call try_starts(problem, report)
      if (.not. interference > 0.0_wp .or. report%converged .or. problem%refused .or. problem%carried_only) return
    end if
    problem%smaller => null()
    call problem%newton%log%detail('without interference of assembly:')
    call set_interference(problem%bearing, 0.0_wp)
    call try_starts(problem, report)
    if (report%converged) call press(problem, interference, report)
    call set_interference(problem%bearing, interference)
  end subroutine start_pressed

  !> Tries the starts that apply, one after the other, until one leads to the target.
  !>
  !> Without an answer the state is the one nearest to the target of those that count.
  recursive subroutine try_starts(problem, report)
    type(start_problem_type), intent(inout) :: problem !! what is to be solved
    type(path_report_type), intent(out) :: report !! how it ended
    type(cold_start_type), allocatable :: starts(:)
    type(nearest_type) :: nearest
    integer, allocatable :: list(:)
    logical :: ends, stopped
    integer :: i, spent_before

    starts = cold_starts()
    spent_before = problem%newton%iterations
    if (allocated(problem%suspicion)) deallocate (problem%suspicion)
    list = applying(starts, problem)
    problem%from_smaller = .false.
    problem%shown = .false.
    do i = 1, size(list)
      associate (start => starts(list(i)))
        problem%others_left = any(starts(list(i + 1:))%soft%release /= never)
        call problem%newton%log%stage('start: '//trim(start%name))
        call start%try(problem, start%soft, report, ends)
        stopped = gives_up(problem%newton%settings%bound)
        if (stopped .and. .not. report%converged) then
          ends = .false.
          call report%tell_nothing()
        end if
        if (start%counts) call keep_nearest(problem, report, nearest)
        problem%shown = ends .and. .not. (report%converged .or. start%counts)
        if (problem%shown) then
          nearest%report%reason = report%reason
          nearest%report%drawn = report%drawn
        end if
        if (report%converged .or. ends .or. stopped) exit
        if (i == size(list)) exit
        associate (next => starts(list(i + 1)))
          if (next%counts .and. problem%newton%iterations - spent_before > most_iterations) then
            call problem%newton%log%line('no answer from the start "'//trim(start%name)//'" ('//report%reason// &
              '); no other one after '//text(most_iterations)//' iterations')
            exit
          end if
          call problem%newton%log%line('no answer from the start "'//trim(start%name)//'" ('//report%reason// &
            '); the next: "'//trim(next%name)//'"')
        end associate
      end associate
    end do
    if (.not. report%converged .and. nearest%known) then
      report = nearest%report
      if (.not. (problem%shown .or. report%has_cause()) .and. allocated(problem%suspicion)) then
        report%reason = problem%suspicion
      else if (.not. (problem%shown .or. problem%on_the_way .or. report%has_cause()) .and. problem%bearing%floats) then
        if (i > 1) report%reason = 'none of '//text(min(i, size(list)))//' starts led there; from the nearest state they reached: '// &
          report%reason
      end if
      call nearest%kept%put_back(problem%bearing)
    end if
    call nearest%kept%destroy()
  end subroutine try_starts

  !> Numbers of the starts that apply to a problem; where the smaller system has none that leads to an answer, one
  !> shows the same on this one.
  function applying(starts, problem) result(list)
    type(cold_start_type), intent(in) :: starts(:)
    type(start_problem_type), intent(in) :: problem
    integer, allocatable :: list(:)
    integer :: i

    allocate (list(0))
    do i = 1, size(starts)
      if (.not. starts(i)%applies(problem)) cycle
      if (problem%carried_only .and. .not. associated(starts(i)%applies, has_smaller)) cycle
      list = [list, i]
      if (problem%on_the_way .or. (problem%refused .and. .not. associated(starts(i)%applies, is_refused))) exit
    end do
  end function applying

  !> Keeps a state if it is the nearest to the target so far: an equilibrium rather than a fixed
  !> position, at the speed asked for, and the load's.
  subroutine keep_nearest(problem, report, nearest)
    type(start_problem_type), intent(in) :: problem
    type(path_report_type), intent(in) :: report
    type(nearest_type), intent(inout) :: nearest

    if (nearest%known) then
      if (distance(report, problem%target) >= distance(nearest%report, problem%target)) return
    end if
    nearest%known = .true.
    nearest%report = report
    call nearest%kept%keep(problem%bearing)
    nearest%kept%shaft_fixed = report%shaft_fixed .and. problem%bearing%floats
  end subroutine keep_nearest

  !> Loads and speeds that are missing, fixed positions last [1].
  pure function distance(report, target)
    type(path_report_type), intent(in) :: report
    type(operating_point_type), intent(in) :: target
    real(wp) :: distance

    distance = norm2(report%reached%load - target%load)/max(norm2(target%load), tiny(1.0_wp)) + &
      abs(report%reached%speed - target%speed)/max(abs(target%speed), tiny(1.0_wp))
    if (report%shaft_fixed) distance = huge(1.0_wp)
  end function distance

  !> A slower shaft first, by all starts that apply to it, then faster.
  recursive subroutine try_half_speed(problem, soft, report, ends)
    type(start_problem_type), intent(inout) :: problem
    type(soft_contacts_type), intent(in) :: soft !! none
    type(path_report_type), intent(out) :: report
    logical, intent(out) :: ends
    type(start_problem_type) :: slower

    ends = .false.
    slower = problem
    slower%on_the_way = .true.
    slower%smaller => null()
    slower%anchor = kept_state_type()
    slower%target%speed = slow*problem%target%speed
    call try_starts(slower, report)
    call slower%anchor%destroy()
    if (report%converged) then
      call follow_path(problem%bearing, problem%newton, problem%target, first_step, problem%settings, report)
    else
      report%shaft_fixed = .true. ! not a state of this scene
    end if
  end subroutine try_half_speed

  !> Soft contacts of several pads. Where that leads to an edge that is lifted, or to the end of a branch, and not to an answer
  !> that looks stable with edges hardly off their bumps, there may be an equilibrium whose edges all rest: with the edges fixed while contacts are released, or from nearer to the foil.
  recursive subroutine try_several_edges(problem, soft, report, ends)
    type(start_problem_type), intent(inout) :: problem
    type(soft_contacts_type), intent(in) :: soft
    type(path_report_type), intent(out) :: report
    logical, intent(out) :: ends
    type(kept_state_type) :: first
    type(path_report_type) :: other
    logical :: other_ends, rest
    integer :: trial

    call try_soft_contacts(problem, soft, report, ends)
    rest = edges_rest(problem, report, resting)
    if (.not. rest) rest = edges_rest(problem, report, hardly_lifted)
    if (rest) rest = may_be_stable(problem)
    if (rest .or. problem%on_the_way .or. .not. (report%converged .or. ends)) return
    call first%keep(problem%bearing)
    do trial = 1, 2
      call problem%newton%log%detail('an equilibrium whose edges rest:')
      if (trial == 1) call try_free_edge(problem, soft_contacts_type(), other, other_ends)
      if (trial == 2) call try_soft_contacts(problem, near_the_foil, other, other_ends)
      rest = edges_rest(problem, other, resting)
      if (.not. (rest .or. other%converged .and. .not. report%converged)) cycle
      report = other
      ends = other_ends
      if (rest) exit
      call first%keep(problem%bearing)
    end do
    if (.not. rest) call first%put_back(problem%bearing)
    call first%destroy()
  end subroutine try_several_edges

  !> Whether an answer may be a stable one: the sign of its determinant speaks for it.
  function may_be_stable(problem) result(may_be)
    type(start_problem_type), intent(in) :: problem
    logical :: may_be
    integer :: sign_of_determinant

    call find_determinant_sign(problem%newton, sign_of_determinant)
    may_be = sign_of_determinant > 0
  end function may_be_stable

  !> Whether a start led to an answer at which no free edge is lifted.
  function edges_rest(problem, report, highest) result(rest)
    type(start_problem_type), intent(in) :: problem
    type(path_report_type), intent(in) :: report !! of the start
    real(wp), intent(in) :: highest !! edge that counts as resting, over the clearance [1]
    logical :: rest
    integer :: pad

    rest = report%converged
    do pad = 1, size(problem%bearing%pad)
      if (rest) rest = edge_lift(problem%bearing, pad) < highest*clearance_of(problem%bearing)
    end do
  end function edges_rest

  !> A coarser mesh, or half the width, has an answer.
  function has_smaller(problem) result(applies)
    type(start_problem_type), intent(in) :: problem
    logical :: applies
    applies = associated(problem%smaller) .and. .not. problem%refused
  end function has_smaller

  !> It was searched and has none.
  function is_refused(problem) result(applies)
    type(start_problem_type), intent(in) :: problem
    logical :: applies
    applies = associated(problem%smaller) .and. problem%refused .and. problem%bearing%floats
  end function is_refused

  !> It has, and the shaft finds its own position.
  function floats_with_smaller(problem) result(applies)
    type(start_problem_type), intent(in) :: problem
    logical :: applies
    applies = has_smaller(problem) .and. problem%bearing%floats
  end function floats_with_smaller

  !> The foil touches nothing but the film: it is rigid, or an elastic foundation.
  function has_no_contacts(problem) result(applies)
    type(start_problem_type), intent(in) :: problem
    logical :: applies
    applies = .not. has_contacts(problem)
  end function has_no_contacts

  !> It does, and the shaft finds its own position under a load.
  function floats_on_film(problem) result(applies)
    type(start_problem_type), intent(in) :: problem
    logical :: applies
    applies = has_no_contacts(problem) .and. problem%bearing%floats .and. norm2(problem%target%load) > 0.0_wp .and. &
      problem%target%speed > 0.0_wp
  end function floats_on_film

  !> Top foil, bumps and sleeve touch each other.
  function has_contacts(problem) result(applies)
    type(start_problem_type), intent(in) :: problem
    logical :: applies
    applies = problem%bearing%pad(1)%foil%has_contacts()
  end function has_contacts

  !> They do, and the shaft finds its own position.
  function floats_on_contacts(problem) result(applies)
    type(start_problem_type), intent(in) :: problem
    logical :: applies
    applies = has_contacts(problem) .and. problem%bearing%floats
  end function floats_on_contacts

  !> The top foil has an edge that nothing holds, and the shaft finds its own position.
  function floats_with_free_edge(problem) result(applies)
    type(start_problem_type), intent(in) :: problem
    logical :: applies
    applies = .false.
    if (floats_on_contacts(problem)) applies = has_free_edge(problem%bearing)
  end function floats_with_free_edge

  !> The top foils of several pads have such edges, few of which are ever drawn up.
  function floats_with_free_edges(problem) result(applies)
    type(start_problem_type), intent(in) :: problem
    logical :: applies
    applies = floats_with_free_edge(problem) .and. size(problem%bearing%pad) > 1
  end function floats_with_free_edges

  !> Top foil, bumps and sleeve touch each other, of one pad or with fixed edges.
  function has_other_contacts(problem) result(applies)
    type(start_problem_type), intent(in) :: problem
    logical :: applies
    applies = has_contacts(problem)
    if (applies) applies = .not. floats_with_free_edges(problem)
  end function has_other_contacts

  !> The top foil has an edge that nothing holds, and the shaft is fixed.
  function fixed_with_free_edge(problem) result(applies)
    type(start_problem_type), intent(in) :: problem
    logical :: applies
    applies = .false.
    if (problem%bearing%floats .or. problem%on_the_way) return
    if (has_contacts(problem)) applies = has_free_edge(problem%bearing)
  end function fixed_with_free_edge

  !> The shaft finds its own position on contacts, and has its full speed.
  function can_be_slower(problem) result(applies)
    type(start_problem_type), intent(in) :: problem
    logical :: applies
    applies = floats_on_contacts(problem) .and. .not. problem%on_the_way
  end function can_be_slower
end module gfb_start_list
