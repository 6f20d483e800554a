#include "gfb_petsc.h"
!> The cold starts: which are tried on a bearing, and in what order.
module gfb_start_list
  use gfb_kinds, only: wp
  use gfb_ending, only: path_stopped, ending_suction
  use gfb_text, only: text
  use gfb_work_bound, only: gives_up
  use gfb_operating_point, only: operating_point_type
  use gfb_continuation, only: path_report_type, follow_path
  use gfb_start_problem, only: start_problem_type, soft_contacts_type, after, before, &
                               clearance_of, trial_settings, usual_eccentricity
  use gfb_saved_state, only: saved_state_type
  use gfb_newton, only: find_determinant_sign
  use gfb_smaller_start, only: try_smaller_answer, try_smaller_end
  use gfb_film_surface, only: translations
  use gfb_contactless_start, only: try_from_rest, try_laid_down, try_from_gap
  use gfb_soft_contact_start, only: try_soft_contacts, usual_contacts
  use gfb_bearing_directions, only: has_free_edge, edge_lift
  use gfb_edge_start, only: resting, next_height, try_free_edge
  implicit none (type)
  private
  public :: starts_of, soft_starts_of, start_name, try_start, try_starts

  ! The coarsest meshes' answers of 78 members of `tools/bench population` that have one (30 foundations, 11 beams, 37 hot rigid ones and
  ! foundations): from_rest 67, edge_fixed 9, released_early 2. In docs/measured/population_refusals.md: laid_down is used by 6 answers of
  ! 400 foundations, 1 lost without it; lighter_load by 2 of 380 members, both lost without it.
  ! Of 120 beams, 40 each of the sets random, tilted and hot, 39 have answers: edge_fixed 28, released_early 5, several_pads 5, released_late 1,
  ! lighter_load none of 57 that try it. Without released_late, which 16 try, its answer comes from lighter_load at 513 instead of 327
  ! factorizations, and three refusals lose their name. Without several_pads its answers stay, but one is another equilibrium.
  ! near_foil leads to the one whose edges rest in 1 of 12 answers of 31 hot beams of three pads (seeds 20 and 21), and in
  ! tests/verification/pads.py; in --branches of 26 beams of one pad no soft start finds an equilibrium that pulled edges have not. A ring has
  ! from_gap alone.
  integer, parameter, public :: start_smaller_answer = 1
  integer, parameter, public :: start_smaller_end = 2
  integer, parameter, public :: start_from_rest = 3
  integer, parameter, public :: start_laid_down = 4
  integer, parameter, public :: start_several_pads = 5
  integer, parameter, public :: start_edge_fixed = 6
  integer, parameter, public :: start_released_early = 7
  integer, parameter, public :: start_released_late = 8
  integer, parameter, public :: start_lighter_load = 9
  integer, parameter, public :: start_near_foil = 10
  integer, parameter, public :: start_from_gap = 11
  character(len=*), parameter :: names(*) = [character(len=64) :: &
                                             "the smaller system's answer", &
                                             "the end of the smaller system's search", &
                                             "the fixed shaft from rest to speed", &
                                             "the shaft laid on its foil under the load", &
                                             "soft contacts of several pads, released early under a load", &
                                             "the free edge fixed where it rests", &
                                             "soft contacts, released early under a load", &
                                             "soft contacts, released after the shaft in growing steps", &
                                             "the free edge fixed where it rests, under a tenth of the load", &
                                             "soft contacts, released before the shaft near the foil", &
                                             "the runner held at a gap"]

  !> Newton's, after which no other start begins: more find a few more answers, and every refusal pays for them
  integer, parameter :: most_iterations = 800
  !> Load of the last start, over the one asked for: less finds more branches, and the way from there costs more steps [1]
  real(wp), parameter :: load_share = 0.1_wp

  type(soft_contacts_type), parameter :: late = soft_contacts_type(after, usual_eccentricity, 1.5_wp, 2.0_wp)
  type(soft_contacts_type), parameter :: near_the_foil = soft_contacts_type(before, 0.9_wp, 1.5_wp, 2.0_wp)

  !> The last state of the start that came nearest to an answer.
  type :: nearest_type
    logical :: known = .false.
    type(path_report_type) :: report
    type(saved_state_type) :: kept
  end type nearest_type

contains

  !> The starts that suit a problem, the cheapest and most successful first: each has won answers of docs/measured/population.md.
  !> Where a smaller system has no answer its end shows that on this one, too, and else one more start.
  function starts_of(problem) result(starts)
    type(start_problem_type), intent(in) :: problem !! bearing and target
    integer, allocatable :: starts(:)
    integer, allocatable :: first(:)
    logical :: free_edge

    allocate (first(0))
    if (associated(problem%smaller)) then
      if (.not. problem%refused) first = [start_smaller_answer]
      if (problem%refused .and. problem%bearing%floats) first = [start_smaller_end]
    end if
    associate (bearing => problem%bearing, target => problem%target)
      if (.not. problem%scene%bearing%row%moves_across) then
        starts = [start_from_gap]
      else if (.not. problem%scene%model%foil%has_bumps) then
        starts = [start_from_rest]
        if (bearing%floats .and. norm2(target%load(:2)) > 0.0_wp .and. target%speed > 0.0_wp) starts = [starts, start_laid_down]
      else
        free_edge = has_free_edge(bearing)
        starts = [start_released_early, start_released_late]
        if (free_edge .and. bearing%floats) starts = [start_edge_fixed, starts]
        if (free_edge .and. bearing%floats .and. size(bearing%pad) > 1) then
          starts = [start_several_pads, start_edge_fixed, start_released_late]
        end if
        if (free_edge .and. .not. bearing%floats) starts = [starts, start_edge_fixed]
      end if
    end associate
    if (problem%refused) starts = starts(:1)
    if (problem%carried_only) starts = starts(:0)
    starts = [first, starts]
  end function starts_of

  !> The starts with soft contacts that suit a problem: each may lead to an equilibrium of its own.
  function soft_starts_of(problem) result(starts)
    type(start_problem_type), intent(in) :: problem !! bearing and target
    integer, allocatable :: starts(:)

    starts = starts_of(problem)
    starts = pack(starts, starts == start_several_pads .or. starts == start_released_early .or. starts == start_released_late)
    if (problem%bearing%floats .and. size(starts) > 0) starts = [starts, start_near_foil]
  end function soft_starts_of

  !> A start as the log has it.
  pure function start_name(start) result(name)
    integer, intent(in) :: start !! of the list
    character(len=:), allocatable :: name
    name = trim(names(start))
  end function start_name

  !> Tries to bring the problem's bearing to its target.
  subroutine try_start(start, problem, report, ends)
    integer, intent(in) :: start !! of the list
    type(start_problem_type), intent(inout) :: problem !! bearing and target; the bearing is moved
    type(path_report_type), intent(out) :: report !! how far it led
    logical, intent(out) :: ends !! no other start can help: its report stands

    ends = .false.
    select case (start)
    case (start_smaller_answer)
      call try_smaller_answer(problem, report)
    case (start_smaller_end)
      call try_smaller_end(problem, report, ends)
    case (start_from_rest)
      call try_from_rest(problem, report)
    case (start_laid_down)
      call try_laid_down(problem, report)
    case (start_from_gap)
      call try_from_gap(problem, report)
    case (start_several_pads)
      call try_several_edges(problem, report, ends)
    case (start_edge_fixed)
      call try_free_edge(problem, report, ends)
    case (start_released_early)
      call try_soft_contacts(problem, usual_contacts, report, ends)
    case (start_released_late)
      call try_soft_contacts(problem, late, report, ends)
    case (start_near_foil)
      call try_soft_contacts(problem, near_the_foil, report, ends)
    case default
      error stop 'a start that is none'
    end select
  end subroutine try_start

  !> Tries the starts of the list, one after the other, until one leads to the target.
  !>
  !> Without an answer the state is where a start has shown that there is none, or else the one nearest to the target.
  subroutine try_starts(problem, report)
    type(start_problem_type), intent(inout) :: problem !! what is to be solved
    type(path_report_type), intent(out) :: report !! how it ended
    type(nearest_type) :: nearest
    integer, allocatable :: starts(:)
    logical :: ends, stopped
    integer :: i, spent_before, factors_before

    spent_before = problem%newton%iterations
    factors_before = problem%newton%factorizations
    starts = starts_of(problem)
    problem%from_smaller = .false.
    problem%no_room = .false.
    do i = 1, size(starts)
      call problem%newton%log%stage('start: '//start_name(starts(i)))
      problem%may_give_up = problem%bearing%floats .or. starts(i) /= start_released_late
      call try_start(starts(i), problem, report, ends)
      stopped = gives_up(problem%newton%settings%bound)
      if (stopped .and. .not. report%converged()) then
        ends = .false.
        report%ending = path_stopped()
      end if
      if (report%converged() .or. ends .or. problem%no_room) exit
      if (leaves_a_state(starts(i))) call keep_nearest(problem, report, nearest)
      if (stopped .or. i == size(starts)) exit
      if (problem%newton%iterations - spent_before > most_iterations) then
        call problem%newton%log%line('no answer from the start "'//start_name(starts(i))//'" ('//report%reason()// &
                                     '); no other one after '//text(most_iterations)//' iterations')
        exit
      end if
      call problem%newton%log%line('no answer from the start "'//start_name(starts(i))//'" ('//report%reason()// &
                                   '); the next: "'//start_name(starts(i + 1))//'"')
    end do
    if (.not. (report%converged() .or. ends .or. problem%no_room) .and. nearest%known) then
      report = nearest%report
      call nearest%kept%restore(problem%bearing)
    end if
    call nearest%kept%destroy()
    if (report%converged() .or. stopped .or. problem%no_room) return
    ! From the answer of a smaller system alone Newton's method may not even begin; a search may.
    if (problem%newton%iterations == spent_before .and. problem%newton%factorizations == factors_before .and. .not. &
        (problem%refused .or. problem%carried_only)) error stop 'a search for an equilibrium has solved nothing'
    ends = suits_lighter_load(problem, report)
    if (ends) call try_lighter_load(problem, report)
  end subroutine try_starts

  !> Whether a start under a lighter load may find another branch: not where the film draws the edge to the shaft, and not where a
  !> smaller system has been searched so.
  logical function suits_lighter_load(problem, report) result(suits)
    type(start_problem_type), intent(in) :: problem
    type(path_report_type), intent(in) :: report !! of the starts before

    suits = problem%bearing%floats .and. problem%scene%model%foil%has_bumps .and. .not. &
      (problem%refused .or. problem%carried_only .or. report%ending%kind == ending_suction) .and. &
      problem%scene%bearing%row%moves_across
    if (suits) suits = has_free_edge(problem%bearing)
  end function suits_lighter_load

  !> With the free edge fixed under a lighter load, and from there to the load: the branch on which the shaft came under the load
  !> may end where another goes on. What was known stands where that does not lead to an answer.
  subroutine try_lighter_load(problem, report)
    type(start_problem_type), intent(inout) :: problem
    type(path_report_type), intent(inout) :: report !! in: of the starts before; replaced by that of an answer
    type(start_problem_type), allocatable :: easier ! large
    type(path_report_type) :: light
    type(saved_state_type) :: refused
    logical :: ends

    call problem%newton%log%line('no answer from there ('//report%reason()//'); the last start:')
    call problem%newton%log%stage('start: '//start_name(start_lighter_load))
    call refused%save(problem%bearing)
    easier = problem
    easier%anchor = saved_state_type()
    easier%target%load(:2) = load_share*problem%target%load(:2)
    call try_free_edge(easier, light, ends)
    call easier%anchor%destroy()
    if (light%converged()) then
      call follow_path(problem%bearing, problem%newton, problem%target, load_share, trial_settings(problem%settings), light)
    end if
    if (light%converged()) then
      report = light
    else
      call refused%restore(problem%bearing)
    end if
    call refused%destroy()
  end subroutine try_lighter_load

  !> Whether a start that fails leaves a state without a fixed edge on this system.
  pure logical function leaves_a_state(start) result(leaves)
    integer, intent(in) :: start !! of the list
    leaves = all(start /= [start_smaller_answer, start_smaller_end, start_edge_fixed])
  end function leaves_a_state

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
    call nearest%kept%save(problem%bearing)
    nearest%kept%shaft_fixed = report%shaft_fixed .and. problem%bearing%floats
  end subroutine keep_nearest

  !> Loads and speeds that are missing, fixed positions last [1].
  pure function distance(report, target)
    type(path_report_type), intent(in) :: report
    type(operating_point_type), intent(in) :: target
    real(wp) :: distance

    distance = norm2(report%reached%load(:translations) - target%load(:translations))/ &
      max(norm2(target%load(:translations)), tiny(1.0_wp)) + &
      abs(report%reached%speed - target%speed)/max(abs(target%speed), tiny(1.0_wp))
    if (report%shaft_fixed) distance = huge(1.0_wp)
  end function distance

  !> Soft contacts of several pads. Where that leads to an edge that is lifted, or to the end of a branch, and not to an answer
  !> that looks stable with edges hardly off their bumps, there may be an equilibrium whose edges all rest: from nearer to the foil.
  subroutine try_several_edges(problem, report, ends)
    type(start_problem_type), intent(inout) :: problem
    type(path_report_type), intent(out) :: report
    logical, intent(out) :: ends
    type(saved_state_type) :: first
    type(path_report_type) :: other
    logical :: other_ends, rest

    call try_soft_contacts(problem, usual_contacts, report, ends)
    rest = edges_rest(problem, report, resting)
    if (.not. rest) rest = edges_rest(problem, report, next_height)
    if (rest) rest = may_be_stable(problem)
    if (rest .or. .not. (report%converged() .or. ends)) return
    call first%save(problem%bearing)
    call problem%newton%log%detail('an equilibrium whose edges rest:')
    call try_soft_contacts(problem, near_the_foil, other, other_ends)
    if (edges_rest(problem, other, resting) .or. other%converged() .and. .not. report%converged()) then
      report = other
      ends = other_ends
    else
      call first%restore(problem%bearing)
    end if
    call first%destroy()
  end subroutine try_several_edges

  !> Whether an answer may be a stable one: the sign of its determinant speaks for it.
  logical function may_be_stable(problem) result(may_be)
    type(start_problem_type), intent(in) :: problem
    integer :: sign_of_determinant

    call find_determinant_sign(problem%newton, sign_of_determinant)
    may_be = sign_of_determinant > 0
  end function may_be_stable

  !> Whether a start led to an answer at which no free edge is lifted.
  logical function edges_rest(problem, report, highest) result(rest)
    type(start_problem_type), intent(in) :: problem
    type(path_report_type), intent(in) :: report !! of the start
    real(wp), intent(in) :: highest !! edge that counts as resting, over the clearance [1]
    integer :: pad

    rest = report%converged()
    do pad = 1, size(problem%bearing%pad)
      if (rest) rest = edge_lift(problem%bearing, pad) < highest*clearance_of(problem%bearing)
    end do
  end function edges_rest
end module gfb_start_list
