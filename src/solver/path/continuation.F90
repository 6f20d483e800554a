#include "gfb_petsc.h"
!> From one operating point to another in as few steps as Newton's method can take.
module gfb_continuation
  use petscvec
  use gfb_kinds, only: wp
  use gfb_text, only: text
  use gfb_work_bound, only: gives_up
  use gfb_petsc_session, only: any_rank
  use gfb_operating_point, only: operating_point_type, point_between
  use gfb_bearing_system, only: bearing_system_type
  use gfb_bearing_answer, only: bearing_answer_type, bearing_answer
  use gfb_fold_search, only: look_beyond, branch_lost, branch_goes_on, branch_folds
  use gfb_path_report, only: path_settings_type, path_report_type
  use gfb_newton, only: newton_type, newton_report_type, solve_newton
  implicit none (type)
  private
  public :: follow_path, path_settings_type, path_report_type

  integer, parameter :: hasty_iterations = 20        !! of a step that can be cut
  integer, parameter :: easy_iterations = 6          !! a step that took no more of them is doubled
  real(wp), parameter :: shortest_first = 0.01_wp    !! least step over the first one [1]
  integer, parameter :: closing_steps = 40           !! more, where the gap is closing
  integer, parameter :: most_rescues = 4             !! of a path on which no step leads on
  integer, parameter :: straight_before_leap = 3     !! Newton steps, before they are bent
  real(wp), parameter :: leaps(3) = [0.002_wp, 0.02_wp, 0.1_wp] !! of the path that is left [1]
  real(wp), parameter :: closing_gap = 0.01_wp       !! a gap this small ends paths, over the clearance [1]
  real(wp), parameter :: empty = 1.0e-3_wp           !! a pressure that is nothing, over the ambient one [1]
  real(wp), parameter :: micrometres = 1.0e6_wp      !! in a metre

contains

  !> Leads the bearing from a point where its state is the answer to another point.
  !>
  !> Each step starts from a straight line through the last two answers. A step that does not
  !> converge is halved and never accepted. On return the state is the last answer.
  subroutine follow_path(bearing, newton, target, first_step, settings, report)
    type(bearing_system_type), target, intent(inout) :: bearing !! pads and shaft
    type(newton_type), target, intent(inout) :: newton !! of the bearing
    type(operating_point_type), intent(in) :: target !! where the path leads
    real(wp), intent(in) :: first_step !! share of the path to try first [1]
    type(path_settings_type), intent(in) :: settings !! limits of the path
    type(path_report_type), intent(out) :: report !! how far it led

    type(operating_point_type) :: start
    type(newton_report_type) :: solved
    Vec :: here, before
    real(wp) :: step, smallest, at_before, trial
    integer :: most_steps, rescues
    logical :: goes_on, just_cut, spent, closing, gave_up
    PetscErrorCode :: ierr

    PetscCallA(VecDuplicate(bearing%state, here, ierr))
    PetscCallA(VecDuplicate(bearing%state, before, ierr))
    PetscCallA(VecCopy(bearing%state, here, ierr))
    start = bearing%point
    report%reached = start
    ! A path that is long against its beginning needs steps that are small against the path.
    smallest = min(settings%smallest_step, shortest_first*first_step)
    step = min(1.0_wp, max(first_step, smallest))
    at_before = -1.0_wp
    just_cut = .false.
    most_steps = settings%maximum_steps
    rescues = 0
    spent = .false.
    gave_up = .false.
    do while (report%fraction < 1.0_wp)
      if (report%steps + report%cuts >= most_steps) then
        ! A film that thins steadily gets its steps to touch down by.
        spent = most_steps > settings%maximum_steps
        if (.not. spent) spent = .not. is_closing(bearing)
        if (spent) then
          report%reason = 'more than '//text(most_steps)//' load steps'
          exit
        end if
        most_steps = most_steps + closing_steps
      end if
      trial = min(1.0_wp, report%fraction + step)
      call newton%log%is_at(text(100.0_wp*report%fraction, 2)//' % of the way', report%fraction)
      bearing%point = point_between(start, target, trial)
      call predict(bearing, here, before, report%fraction, at_before, trial)
      call try_step(newton, step >= 2.0_wp*smallest, settings, solved)
      if (.not. solved%converged) then
        report%cuts = report%cuts + 1
        just_cut = .true. ! what failed need not be tried again at once
        call newton%log%detail('cut: '//solved%reason)
        call bearing%return_to(here)
        report%reason = solved%reason
        gave_up = gives_up(newton%settings%bound)
        if (gave_up .or. (report%steps > 0 .and. report%cuts >= settings%most_cuts)) exit
        step = 0.5_wp*step
        if (step < smallest) then
          report%reason = 'no step, however short, leads on ('//solved%reason//')'
          if (.not. (settings%look_for_folds .and. bearing%floats)) exit
          ! A film without contacts that closes has told its end; beyond it there is only rounding.
          closing = is_closing(bearing)
          if (closing .and. .not. bearing%pad(1)%foil%has_contacts()) exit
          rescues = rescues + 1
          if (rescues > most_rescues) exit
          call find_end(bearing, newton, target, smallest, settings, here, before, at_before, report, goes_on)
          if (.not. goes_on) exit
          step = 4.0_wp*smallest
          if (too_thin(bearing, settings, report)) exit
        end if
        cycle
      end if
      PetscCallA(VecCopy(here, before, ierr))
      PetscCallA(VecCopy(bearing%state, here, ierr))
      at_before = report%fraction
      report%fraction = trial
      report%reached = bearing%point
      report%steps = report%steps + 1
      if (solved%iterations <= easy_iterations .and. .not. just_cut) step = 2.0_wp*step
      just_cut = .false.
      if (too_thin(bearing, settings, report)) exit
    end do
    report%converged = report%fraction >= 1.0_wp .and. .not. report%touched
    if (report%converged) report%reason = 'converged'
    bearing%point = report%reached
    if (.not. (report%converged .or. report%touched .or. gave_up)) call name_end(bearing, spent, report)
    PetscCallA(VecDestroy(here, ierr))
    PetscCallA(VecDestroy(before, ierr))
  end subroutine follow_path

  !> Whether the shaft has come too near, and what the report says then.
  function too_thin(bearing, settings, report) result(thin)
    type(bearing_system_type), intent(in) :: bearing
    type(path_settings_type), intent(in) :: settings
    type(path_report_type), intent(inout) :: report
    logical :: thin

    thin = bearing%smallest_gap() < settings%touch_down_gap
    if (.not. thin) return
    report%touched = .true.
    report%reason = 'the shaft touches down: the film is thinner than '//text(settings%touch_down_gap*micrometres, 3)//' um'
  end function too_thin

  !> Where no step leads on: goes to the very end of the branch, or past what hindered.
  subroutine find_end(bearing, newton, target, smallest, settings, here, before, at_before, report, goes_on)
    type(bearing_system_type), target, intent(inout) :: bearing
    type(newton_type), target, intent(inout) :: newton
    type(operating_point_type), intent(in) :: target
    real(wp), intent(in) :: smallest      !! step that did not lead on [1]
    type(path_settings_type), intent(in) :: settings
    Vec, intent(in) :: here, before       !! last two answers
    real(wp), intent(inout) :: at_before  !! where on the path; negative if there is none
    type(path_report_type), intent(inout) :: report
    logical, intent(out) :: goes_on
    real(wp) :: left, ahead
    integer :: outcome
    PetscErrorCode :: ierr

    bearing%point = report%reached ! not the one that was tried last
    left = 1.0_wp - report%fraction
    call look_beyond(bearing, newton, target, before, at_before >= 0.0_wp, min(1.0_wp, 2.0_wp*smallest/left), &
                     outcome, ahead)
    goes_on = outcome == branch_goes_on
    report%folded = outcome == branch_folds
    if (ahead > 0.0_wp) then
      PetscCallA(VecCopy(here, before, ierr))
      PetscCallA(VecCopy(bearing%state, here, ierr))
      at_before = report%fraction
      report%fraction = report%fraction + min(ahead, 1.0_wp - smallest)*left ! the target itself is still to be met
      report%reached = bearing%point
    end if
    if (outcome == branch_lost .and. bearing%pad(1)%foil%has_contacts()) then
      call leap(bearing, newton, target, settings%longest_leap, here, at_before, report, goes_on)
    end if
  end subroutine find_end

  !> Where the branch is lost: takes an answer a little farther on that is near enough, with Newton's steps bent at contacts
  !> that change.
  subroutine leap(bearing, newton, target, longest, here, at_before, report, lands)
    type(bearing_system_type), target, intent(inout) :: bearing
    type(newton_type), target, intent(inout) :: newton
    type(operating_point_type), intent(in) :: target
    real(wp), intent(in) :: longest       !! change of any scaled unknown [1]
    Vec, intent(in) :: here               !! last answer
    real(wp), intent(inout) :: at_before  !! where on the path; negative if there is none
    type(path_report_type), intent(inout) :: report
    logical, intent(out) :: lands
    type(operating_point_type) :: start
    type(newton_report_type) :: solved
    Vec :: change
    real(wp) :: share, farthest
    integer :: straight, trial
    PetscErrorCode :: ierr

    call newton%log%detail('the branch is lost: other answers near by are looked for')
    straight = newton%settings%straight_steps
    newton%settings%straight_steps = straight_before_leap
    start = bearing%point
    lands = .false.
    PetscCallA(VecDuplicate(here, change, ierr))
    do trial = 1, size(leaps)
      share = leaps(trial)
      bearing%point = point_between(start, target, share)
      call bearing%return_to(here)
      call solve_newton(newton, solved)
      PetscCallA(VecWAXPY(change, -1.0_wp, here, bearing%state, ierr))
      PetscCallA(VecNorm(change, NORM_INFINITY, farthest, ierr))
      lands = solved%converged .and. farthest <= longest
      if (lands) exit
    end do
    PetscCallA(VecDestroy(change, ierr))
    newton%settings%straight_steps = straight
    if (lands) then
      PetscCallA(VecCopy(bearing%state, here, ierr))
      at_before = -1.0_wp
      report%fraction = report%fraction + share*(1.0_wp - report%fraction)
      report%reached = bearing%point
    else
      call bearing%return_to(here)
      bearing%point = start
    end if
  end subroutine leap

  !> Newton's method, which gives up early where a shorter step can be tried: a step that
  !> converges does so soon.
  subroutine try_step(newton, may_be_cut, settings, solved)
    type(newton_type), target, intent(inout) :: newton
    logical, intent(in) :: may_be_cut
    type(path_settings_type), intent(in) :: settings
    type(newton_report_type), intent(out) :: solved
    integer :: allowed, straight

    straight = newton%settings%straight_steps
    newton%settings%straight_steps = min(straight, settings%straight_steps)
    allowed = newton%settings%maximum_iterations
    if (may_be_cut) newton%settings%maximum_iterations = min(allowed, hasty_iterations)
    call solve_newton(newton, solved)
    newton%settings%maximum_iterations = allowed
    newton%settings%straight_steps = straight
  end subroutine try_step

  !> Says so where a path ended because the gap closes, because its answers turn back, or because the film is emptied.
  subroutine name_end(bearing, spent, report)
    type(bearing_system_type), intent(in) :: bearing
    logical, intent(in) :: spent !! all steps are
    type(path_report_type), intent(inout) :: report
    type(bearing_answer_type) :: answer

    answer = bearing_answer(bearing)
    report%touched = is_closing(bearing) .and. .not. spent
    if (report%touched) then
      report%reason = 'the shaft touches down: the gap has closed to '//text(answer%minimum_gap*micrometres, 3)// &
        ' um, beyond that '//report%reason
    else if (report%folded) then
      report%reason = 'the branch of answers ends in a fold: beyond it the '//trim(merge('top foil', 'shaft   ', &
        bearing%pad(1)%foil%has_contacts()))//' moves on by itself'
    else if (answer%minimum_pressure < empty*bearing%pad(1)%film%ambient_pressure) then
      report%emptied = .true.
      report%reason = 'the film is emptied: its pressure falls to '//text(answer%minimum_pressure, 2)// &
        ' Pa behind a gap of '//text(answer%minimum_gap*micrometres, 3)//' um, on cells of a Peclet number up to '// &
        text(answer%maximum_peclet, 2)//'; a finer mesh may lead farther'
    end if
  end subroutine name_end

  !> Whether the gap is so small that the film thins fast from step to step.
  function is_closing(bearing) result(closing)
    type(bearing_system_type), intent(in) :: bearing
    logical :: closing
    closing = bearing%smallest_gap() < closing_gap*bearing%pad(1)%film%clearance
    if (closing) closing = .not. bearing%pad(1)%contact%present
  end function is_closing

  !> Start value of a step: the line through the last two answers, as far along it as can be
  !> evaluated.
  subroutine predict(bearing, here, before, at_here, at_before, trial)
    type(bearing_system_type), intent(inout) :: bearing
    Vec, intent(in) :: here, before         !! last two answers
    real(wp), intent(in) :: at_here, at_before !! where on the path; the latter negative if none
    real(wp), intent(in) :: trial           !! where the step ends

    integer, parameter :: attempts = 3
    Vec :: residual
    real(wp) :: stretch
    PetscErrorCode :: ierr
    integer :: attempt
    logical :: valid

    if (at_before < 0.0_wp) return
    PetscCallA(VecDuplicate(here, residual, ierr))
    stretch = (trial - at_here)/(at_here - at_before)
    do attempt = 1, attempts
      PetscCallA(VecCopy(here, bearing%state, ierr))
      PetscCallA(VecAXPBYPCZ(bearing%state, -stretch, stretch, 1.0_wp, before, here, ierr))
      call bearing%evaluate(bearing%state, residual, valid)
      if (.not. any_rank(.not. valid)) exit
      stretch = 0.5_wp*stretch
      PetscCallA(VecCopy(here, bearing%state, ierr))
    end do
    PetscCallA(VecDestroy(residual, ierr))
  end subroutine predict
end module gfb_continuation
