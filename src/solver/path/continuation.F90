#include "gfb_petsc.h"
!> From one operating point to another in as few steps as Newton's method can take.
!>
!> Where a path stops, the branch is looked at beyond (`gfb_branch_beyond`).
module gfb_continuation
  use petscvec
  use gfb_kinds, only: wp
  use gfb_archive, only: archive_type
  use gfb_arc, only: arc_type
  use gfb_operating_point, only: operating_point_type, visit_point, point_between
  use gfb_petsc_session, only: any_rank
  use gfb_bearing_system, only: bearing_system_type
  use gfb_newton, only: newton_type, newton_report_type, solve_newton
  use gfb_ending, only: path_reached, path_touches, path_closes, path_folds, path_empties, path_lost, path_settings_type, &
       path_report_type, heat_trail_type, mover_with_heat
  use gfb_text, only: text
  use gfb_work_bound, only: gives_up
  use gfb_bearing_answer, only: bearing_answer_type, bearing_answer
  use gfb_stepper, only: path_problem_type, step_rules_type, follow_steps, steps_arrived, steps_too_far, steps_spent, &
       steps_given_up
  use gfb_branch_beyond, only: branch_lost, branch_continues, branch_folds, look_beyond
  implicit none (type)
  private
  public :: visit_fold_path, follow_path, path_settings_type, path_report_type

  !> The path along the branch. Keep it where it is.
  type, public :: fold_path_type
    type(arc_type) :: arc
    type(operating_point_type) :: first, last !! of the sweep
    real(wp), allocatable :: lambda(:)        !! of the sweep's values between them [1]
    integer :: kept = 1                       !! value whose answer was kept last
    real(wp) :: kept_heading = 1.0_wp         !! and in which sense it was passed
  end type fold_path_type

  integer, parameter :: easy_iterations = 6        !! after a step that took no more of them the next is longer

  real(wp), parameter :: shortest_first = 0.01_wp    !! least step over the first one [1]
  integer, parameter :: closing_steps = 40           !! more, where the gap is closing
  integer, parameter :: most_rescues = 4             !! of a path on which no step converges
  integer, parameter :: straight_before_leap = 3     !! Newton steps, before they are bent
  real(wp), parameter :: leaps(3) = [0.002_wp, 0.02_wp, 0.1_wp] !! of the path that is left [1]
  !> A trial short of a fold fails, too: where the branch turns no farther off than this, over the trial's step, it is one [1].
  real(wp), parameter :: short_of_fold = 2.0_wp
  real(wp), parameter, public :: closing_gap = 0.01_wp       !! a gap this small ends paths, over the clearance [1]
  real(wp), parameter :: empty = 1.0e-3_wp           !! a pressure that is nothing, over the ambient one [1]

  !> A bearing on its way to an operating point; the parameter is the share of the path.
  type, extends(path_problem_type) :: point_path_type
    type(bearing_system_type), pointer :: bearing => null()
    type(newton_type), pointer :: newton => null() !! its solver
    type(operating_point_type) :: start, reached, target !! first, last answer's and asked for
    type(path_settings_type) :: settings
    real(wp) :: smallest = 0.0_wp      !! step [1]
    real(wp) :: at_before = -1.0_wp    !! parameter of the answer before the last; negative if there is none
    integer :: most_steps = 0          !! that are allowed
    integer :: rescues = 0
    logical :: folds = .false.         !! the branch turns back
    logical :: stopped = .false.       !! the search has to end
    real(wp) :: failed = 2.0_wp        !! parameter of the last trial that failed
    type(heat_trail_type) :: heat      !! of the last answers
    character(len=:), allocatable :: why !! the last trial has failed
    character(len=:), allocatable :: course !! from where to where, in words; or empty
    logical :: tells = .true.          !! how far it is
    Vec :: here, before                !! last two answers
    logical :: knows_rate = .false.    !! `rate` is that at the answer `here`
    Vec :: rate                        !! of the state along the path, by its parameter
  contains
    procedure :: try => try_point, accept => accept_point, restore => restore_point, has_steps
    procedure :: gives_up => path_gives_up, rescue => rescue_path, is_too_far => too_thin
  end type point_path_type

contains

  !> Saves or restores all but the arc; the sweep knows its last point and its values.
  pure subroutine visit_fold_path(archive, branch)
    type(archive_type), intent(inout) :: archive !! that saves or restores
    type(fold_path_type), intent(inout) :: branch !! written where the archive restores

    call archive%part('first')
    call visit_point(archive, branch%first)
    call archive%visit('kept', branch%kept)
    call archive%visit('kept_heading', branch%kept_heading)
    if (.not. archive%saves) call archive%require(branch%kept >= 0 .and. branch%kept <= size(branch%lambda), 'the value kept last')
  end subroutine visit_fold_path

  !> Leads the bearing from a point where its state is the answer to another point.
  !>
  !> Each step starts from a straight line through the last two answers, the first one from the path's tangent where that is
  !> known. A step that does not converge is halved and never accepted. On return the state is the last answer.
  subroutine follow_path(bearing, newton, target, first_step, settings, report, rate, course)
    type(bearing_system_type), target, intent(inout) :: bearing !! pads and shaft
    type(newton_type), target, intent(inout) :: newton !! of the bearing
    type(operating_point_type), intent(in) :: target !! where the path leads
    real(wp), intent(in) :: first_step !! share of the path to try first [1]
    type(path_settings_type), intent(in) :: settings !! limits of the path
    type(path_report_type), intent(out) :: report !! how far it led
    Vec, intent(in), optional :: rate !! of the state where the path begins, by the share of the path
    character(len=*), intent(in), optional :: course !! from where to where it leads, for lines that say how far it is; empty: none do

    type(point_path_type) :: path
    real(wp) :: smallest
    integer :: ending
    PetscErrorCode :: ierr

    path%bearing => bearing
    path%newton => newton
    path%start = bearing%point
    path%reached = path%start
    path%target = target
    path%settings = settings
    path%most_steps = settings%maximum_steps
    PetscCallA(VecDuplicate(bearing%state, path%here, ierr))
    PetscCallA(VecDuplicate(bearing%state, path%before, ierr))
    PetscCallA(VecCopy(bearing%state, path%here, ierr))
    path%course = ''
    if (present(course)) path%course = course
    if (present(course)) path%tells = course /= ''
    path%knows_rate = present(rate)
    if (present(rate)) path%rate = rate
    ! A path that is long against its beginning needs steps that are small against the path.
    smallest = min(settings%smallest_step, shortest_first*first_step)
    if (settings%smallest_share > 0.0_wp) smallest = settings%smallest_step ! it is measured by its own way
    path%smallest = smallest
    call feel_heat(path, 0.0_wp)
    call follow_steps(path, step_rules_type(first_step=min(1.0_wp, max(first_step, smallest)), smallest_step=smallest, &
                                            smallest_share=settings%smallest_share, easy_iterations=easy_iterations, &
                                            grows_at_once=.false.), ending)
    report%reached = path%reached
    report%fraction = path%at
    report%steps = path%steps
    report%cuts = path%cuts
    bearing%point = path%reached
    select case (ending)
    case (steps_arrived)
      report%ending = path_reached()
    case (steps_too_far)
      report%ending = path_touches(settings%touch_down_gap)
    case (steps_given_up)
      report%ending = path_lost(path%why)
      if (.not. path%stopped) call name_end(path, .false., report)
    case default
      report%ending = path_lost(path%why)
      call name_end(path, ending == steps_spent, report)
    end select
    PetscCallA(VecDestroy(path%here, ierr))
    PetscCallA(VecDestroy(path%before, ierr))
  end subroutine follow_path

  !> An answer at a point of the path, from the line through the last two.
  subroutine try_point(self, trial, may_be_cut, converged, iterations)
    class(point_path_type), intent(inout) :: self !! the path
    real(wp), intent(in) :: trial     !! share of the path [1]
    logical, intent(in) :: may_be_cut !! half the step is still allowed
    logical, intent(out) :: converged !! there is an answer
    integer, intent(out) :: iterations
    type(newton_report_type) :: solved
    character(len=:), allocatable :: place

    if (self%tells) then
      place = text(100.0_wp*self%at, 2)//' % of the way'//self%course
      ! The first step may be all of a way, and take as long: it says how far it leads.
      if (.not. self%at > 0.0_wp) place = place//', step to '//text(100.0_wp*trial, 2)//' %'
      call self%newton%log%is_at(place, self%at)
    else
      call self%newton%log%is_at('')
    end if
    self%bearing%point = point_between(self%start, self%target, trial)
    call predict(self, trial)
    call try_step(self%newton, may_be_cut, self%settings, solved)
    converged = solved%converged
    iterations = solved%iterations
    self%why = solved%reason
    if (.not. converged) self%failed = trial
  end subroutine try_point

  !> Saves an answer.
  subroutine accept_point(self, trial)
    class(point_path_type), intent(inout) :: self !! the path
    real(wp), intent(in) :: trial !! share of the path [1]
    PetscErrorCode :: ierr

    PetscCallA(VecCopy(self%here, self%before, ierr))
    PetscCallA(VecCopy(self%bearing%state, self%here, ierr))
    self%at_before = self%at
    self%knows_rate = .false.
    self%reached = self%bearing%point
    call feel_heat(self, trial)
  end subroutine accept_point

  !> Keeps how hot the film of an answer is, as the gas feels it.
  subroutine feel_heat(path, at)
    type(point_path_type), intent(inout) :: path
    real(wp), intent(in) :: at !! parameter of the answer [1]
    real(wp) :: value
    integer :: k

    associate (bearing => path%bearing)
      do k = 1, size(bearing%block)
        if (.not. associated(bearing%block(k)%gauge)) cycle
        call bearing%block(k)%gauge(bearing, value)
        call path%heat%add(at, value)
      end do
    end associate
  end subroutine feel_heat

  !> Goes back to the last answer.
  subroutine restore_point(self)
    class(point_path_type), intent(inout) :: self !! the path

    call self%newton%log%detail('cut: '//self%why)
    call self%bearing%return_to(self%here)
  end subroutine restore_point

  !> Whether another step is allowed: a film that thins steadily gets its steps to touch down by.
  logical function has_steps(self)
    class(point_path_type), intent(inout) :: self !! the path

    has_steps = self%steps + self%cuts < self%most_steps
    if (has_steps) return
    has_steps = self%most_steps <= self%settings%maximum_steps
    if (has_steps) has_steps = is_closing(self%bearing)
    if (has_steps) then
      self%most_steps = self%most_steps + closing_steps
    else
      self%why = 'more than '//text(self%most_steps)//' load steps'
    end if
  end function has_steps

  !> Whether the search has to end, or steps have been cut too often.
  logical function path_gives_up(self)
    class(point_path_type), intent(inout) :: self !! the path

    self%stopped = gives_up(self%newton%settings%bound)
    path_gives_up = self%stopped .or. (self%steps > 0 .and. self%cuts >= self%settings%most_cuts)
  end function path_gives_up

  !> Where steps are too short: goes to the end of the branch, or past what hindered.
  subroutine rescue_path(self, step, continues)
    class(point_path_type), intent(inout) :: self !! the path
    real(wp), intent(inout) :: step !! share of the path [1]
    logical, intent(out) :: continues
    logical :: has_told

    self%why = 'no step converges, however short ('//self%why//')'
    continues = .false.
    if (.not. (self%settings%look_for_folds .and. self%bearing%floats)) return
    ! A film without contacts that closes or is emptied has shown its end; beyond it there is only rounding.
    has_told = is_closing(self%bearing)
    if (.not. has_told) has_told = is_emptied(self%bearing, bearing_answer(self%bearing))
    if (has_told .and. .not. self%bearing%has_contacts()) return
    self%rescues = self%rescues + 1
    if (self%rescues > most_rescues) return
    call find_end(self, continues)
    if (continues) step = 4.0_wp*self%smallest
  end subroutine rescue_path

  !> Whether the shaft has come too near.
  logical function too_thin(self)
    class(point_path_type), intent(inout) :: self !! the path
    too_thin = self%bearing%smallest_gap() < self%settings%touch_down_gap
  end function too_thin

  !> Where no step converges: goes to the very end of the branch, or past what hindered.
  subroutine find_end(path, continues)
    class(point_path_type), intent(inout) :: path
    logical, intent(out) :: continues
    real(wp) :: left, ahead
    integer :: outcome

    path%bearing%point = path%reached ! not the one that was tried last
    continues = .false.
    if (path%bearing%times_filled == 0) return ! no step has begun: nothing is known of what lies beyond
    left = 1.0_wp - path%at
    call look_beyond(path%bearing, path%newton, path%target, path%before, path%at_before >= 0.0_wp, &
                     min(1.0_wp, 2.0_wp*path%smallest/left), outcome, ahead)
    continues = outcome == branch_continues
    path%folds = outcome == branch_folds
    if (ahead > 0.0_wp) then
      call path%accept(path%at)
      path%at = path%at + min(ahead, 1.0_wp - path%smallest)*left ! the target itself is still to be met
    end if
    if (outcome == branch_lost .and. path%bearing%has_contacts()) call leap(path, continues)
  end subroutine find_end

  !> Where the branch is lost: takes an answer a little farther on that is near enough, with Newton's steps bent at contacts
  !> that change.
  subroutine leap(path, lands)
    class(point_path_type), intent(inout) :: path
    logical, intent(out) :: lands
    type(operating_point_type) :: start
    type(newton_report_type) :: solved
    Vec :: change
    real(wp) :: share, farthest
    integer :: straight, trial
    PetscErrorCode :: ierr

    associate (bearing => path%bearing, newton => path%newton, here => path%here)
      call newton%log%detail('the branch is lost: other answers near by are looked for')
      straight = newton%settings%straight_steps
      newton%settings%straight_steps = straight_before_leap
      start = bearing%point
      lands = .false.
      PetscCallA(VecDuplicate(here, change, ierr))
      do trial = 1, size(leaps)
        share = leaps(trial)
        bearing%point = point_between(start, path%target, share)
        call bearing%return_to(here)
        call solve_newton(newton, solved)
        PetscCallA(VecWAXPY(change, -1.0_wp, here, bearing%state, ierr))
        PetscCallA(VecNorm(change, NORM_INFINITY, farthest, ierr))
        lands = solved%converged .and. farthest <= path%settings%longest_leap
        if (lands) exit
      end do
      PetscCallA(VecDestroy(change, ierr))
      newton%settings%straight_steps = straight
      if (lands) then
        PetscCallA(VecCopy(bearing%state, here, ierr))
        path%at_before = -1.0_wp
        path%knows_rate = .false.
        path%at = path%at + share*(1.0_wp - path%at)
        path%reached = bearing%point
      else
        call bearing%return_to(here)
        bearing%point = start
      end if
    end associate
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
    if (may_be_cut .or. settings%smallest_share > 0.0_wp) newton%settings%maximum_iterations = min(allowed, settings%trial_iterations)
    call solve_newton(newton, solved)
    newton%settings%maximum_iterations = allowed
    newton%settings%straight_steps = straight
  end subroutine try_step

  !> Says so where a path ended because the gap closes, because its answers turn back, or because the film is emptied.
  subroutine name_end(path, spent, report)
    type(point_path_type), intent(in) :: path
    logical, intent(in) :: spent !! all steps are
    type(path_report_type), intent(inout) :: report
    type(bearing_answer_type) :: answer
    character(len=:), allocatable :: mover
    integer :: k

    mover = 'shaft'
    if (path%bearing%has_contacts()) mover = 'top foil'
    do k = 1, size(path%bearing%block)
      associate (block => path%bearing%block(k))
        if (block%mover /= '') mover = mover_with_heat(trim(block%mover), mover, path%settings%stands_cold, path%heat)
      end associate
    end do
    answer = bearing_answer(path%bearing)
    if (is_closing(path%bearing) .and. .not. spent) then
      report%ending = path_closes(answer%minimum_gap, report%ending)
    else if (path%folds .or. path%heat%turns(path%at + short_of_fold*(path%failed - path%at))) then
      report%ending = path_folds(mover)
    else if (is_emptied(path%bearing, answer)) then
      report%ending = path_empties(answer%minimum_pressure, answer%minimum_gap, answer%maximum_peclet)
    end if
  end subroutine name_end

  !> Whether the gap is so small that the film thins fast from step to step.
  logical function is_closing(bearing) result(closing)
    type(bearing_system_type), intent(in) :: bearing
    closing = bearing%smallest_gap() < closing_gap*bearing%clearance
    if (closing) closing = .not. bearing%asperities%present
  end function is_closing

  !> Whether the film's pressure has fallen to nothing somewhere.
  pure logical function is_emptied(bearing, answer) result(emptied)
    type(bearing_system_type), intent(in) :: bearing
    type(bearing_answer_type), intent(in) :: answer !! at its present state
    emptied = answer%minimum_pressure < empty*bearing%ambient_pressure
  end function is_emptied

  !> Start value of a step: the line through the last two answers, or the path's tangent, as far along it as can be evaluated.
  subroutine predict(path, trial)
    type(point_path_type), intent(inout) :: path
    real(wp), intent(in) :: trial !! where the step ends

    integer, parameter :: attempts = 3
    Vec :: residual
    real(wp) :: stretch
    PetscErrorCode :: ierr
    integer :: attempt
    logical :: valid

    if (path%at_before < 0.0_wp .and. .not. path%knows_rate) return
    associate (bearing => path%bearing, here => path%here)
      PetscCallA(VecDuplicate(here, residual, ierr))
      stretch = trial - path%at
      if (.not. path%knows_rate) stretch = stretch/(path%at - path%at_before)
      do attempt = 1, attempts
        PetscCallA(VecCopy(here, bearing%state, ierr))
        if (path%knows_rate) then
          PetscCallA(VecAXPY(bearing%state, stretch, path%rate, ierr))
        else
          PetscCallA(VecAXPBYPCZ(bearing%state, -stretch, stretch, 1.0_wp, path%before, here, ierr))
        end if
        call bearing%evaluate(bearing%state, residual, valid)
        if (.not. any_rank(.not. valid)) exit
        stretch = 0.5_wp*stretch
        PetscCallA(VecCopy(here, bearing%state, ierr))
      end do
      PetscCallA(VecDestroy(residual, ierr))
    end associate
  end subroutine predict
end module gfb_continuation
