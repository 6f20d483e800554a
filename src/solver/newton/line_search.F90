#include "gfb_petsc.h"
!> Newton's line search: how much of a step is taken.
!>
!> A step is halved until it can be evaluated and the residual is not larger than the largest of the
!> last few: a residual may grow for a while, but not beyond that. Where contacts change their state
!> along a step, the work of the forces on the structure shortens it further. After some steps contacts
!> are taken to alternate: then a step is bent wherever one opens or closes, and shortened back along its
!> path. A step of lagged factors that leads nowhere is dropped, and new factors follow.
module gfb_line_search
  use petscsnes
  use gfb_kinds, only: wp
  use gfb_nonlinear_system, only: nonlinear_system_type
  use gfb_linear_solver, only: linear_solver_type, judge_linear, choose_factors, ask_for_factors
  use gfb_secant_steps, only: secants_type, improve_step, expect_next
  use gfb_bent_step, only: bent_step_type, bend_step, state_on_path, destroy_bent_step
  implicit none (type)
  private
  public :: take_step, remaining_error

  integer, parameter :: memory = 5                 !! residuals that the line search remembers
  integer, parameter :: halvings = 24              !! shortest trial is 2^-24 of a step
  real(wp), parameter :: sufficient = 1.0e-4_wp    !! decrease asked for, relative to a full step's [1]
  real(wp), parameter :: blocked_length = 0.01_wp  !! of a step that goes nowhere [1]
  integer, parameter :: most_blocked = 2           !! such steps before it is given up
  integer, parameter :: path_halvings = 8          !! of a bent step, before the straight one is tried
  real(wp), parameter :: least_reached = 0.1_wp    !! share of a step that its path must reach to be followed [1]
  integer, parameter :: balances = 8               !! trials of a step's length for contacts
  integer, parameter :: patience = 12              !! steps after which contacts are taken to cycle
  real(wp), parameter :: unbalanced(2) = [10.0_wp, 0.5_wp] !! work at a step's end over that at its
  !! beginning, before and after that [1]
  real(wp), parameter :: driving = 0.5_wp          !! work over that at the beginning from which on a shortened step may be longer [1]
  real(wp), parameter :: at_rest = 1.0e-2_wp       !! work at a step's beginning that is none, over that at its end [1]
  real(wp), parameter, public :: stagnation = 1.0e-6_wp !! steps this small that shrink no more are round-off [1]

  !> What the steps of one solve have been.
  type, public :: line_search_type
    real(wp) :: length = 1.0_wp          !! share of the last step that was taken [1]
    real(wp) :: step = huge(1.0_wp)      !! last relative step, before it was shortened [1]
    real(wp) :: step_before = huge(1.0_wp) !! the one before [1]
    real(wp) :: size_x = 1.0_wp          !! largest unknown, at least 1, scaled [1]
    integer :: straight = 0              !! steps before contacts are taken to alternate
    integer :: bold = 0                  !! steps, the first ones, that are taken wherever they can be evaluated
    logical :: impossible = .false.      !! no trial along the step could be evaluated
    integer, private :: steps = 0        !! so far
    integer, private :: blocked = 0      !! steps in succession that were cut very short for that
    real(wp), private :: past(memory) = 0.0_wp !! last residual norms, scaled [1]
  end type line_search_type

contains

  !> Takes what can be taken of the step that SNES has found.
  subroutine take_step(line, solver, secants, system, search, residual_goal, ierr)
    type(line_search_type), intent(inout) :: line !! what the steps have been
    type(linear_solver_type), intent(inout) :: solver !! what is known of the factors
    type(secants_type), intent(inout) :: secants !! what steps with them have taught
    class(nonlinear_system_type), target, intent(inout) :: system !! the equations
    SNESLineSearch, intent(in) :: search !! SNES' line search
    real(wp), intent(in) :: residual_goal !! norm of the scaled residual that is small enough [1]
    PetscErrorCode, intent(out) :: ierr !! PETSc's error code, 0 for none

    SNES :: snes
    Vec :: x, f, y, trial, trial_residual
    PetscReal :: before, after
    logical :: found, solved
    type(bent_step_type) :: path

    PetscCall(SNESLineSearchGetSNES(search, snes, ierr))
    PetscCall(SNESLineSearchGetVecs(search, x, f, y, trial, trial_residual, ierr))
    PetscCall(SNESLineSearchSetReason(search, SNES_LINESEARCH_SUCCEEDED, ierr))
    if (secants%used) call improve_step(secants, y, ierr)
    CHKERRQ(ierr)
    call measure_step(line, x, f, y, before, ierr)
    CHKERRQ(ierr)
    if (system%slow_change .or. solver%iterates) then
      call judge_linear(solver, snes, system, f, y, trial, solved, ierr)
      CHKERRQ(ierr)
      if (.not. solved) then ! again with new factors
        line%length = 0.0_wp
        line%impossible = .false.
        PetscCall(SNESLineSearchComputeNorms(search, ierr))
        if (solver%unsolved /= '') then
          PetscCall(SNESLineSearchSetReason(search, SNES_LINESEARCH_FAILED_REDUCT, ierr))
        end if
        return
      end if
    end if
    found = .false.
    if (secants%used .and. system%settled) then
      call go_along_path(line, system, snes, path, 0, x, f, y, trial, trial_residual, found, ierr) ! of one piece: the whole step
      CHKERRQ(ierr)
    end if
    if (.not. found .and. solver%fresh .and. .not. system%slow_change .and. line%steps > line%straight) then
      call bend_step(snes, system, x, y, path, ierr)
      CHKERRQ(ierr)
      if (path%changes > 0 .and. path%reached >= least_reached) then
        call go_along_path(line, system, snes, path, path_halvings, x, f, y, trial, trial_residual, found, ierr)
        CHKERRQ(ierr)
      end if
    end if
    if (.not. found) then
      call find_length(line, snes, solver%fresh .or. system%slow_change, x, y, trial, trial_residual, found, ierr)
      CHKERRQ(ierr)
      if (found) call move_there(line, system, snes, residual_goal, x, f, y, trial, trial_residual, ierr)
      CHKERRQ(ierr)
    end if
    if (.not. found) then
      line%length = 0.0_wp
      if (solver%fresh) then
        PetscCall(SNESLineSearchSetReason(search, SNES_LINESEARCH_FAILED_REDUCT, ierr))
      else
        call ask_for_factors(solver)
      end if
      line%impossible = line%impossible .and. solver%fresh
    end if
    PetscCall(VecNorm(f, NORM_2, after, ierr))
    if (secants%used) then
      call expect_next(secants, y, found .and. line%length >= 1.0_wp .and. system%settled, ierr)
      CHKERRQ(ierr)
    end if
    ! Where contacts have changed their state the matrix has, too.
    call choose_factors(solver, .not. (line%length < 1.0_wp .or. .not. system%settled .or. path%changes > 0), &
                        line%steps == 1, line%step, line%step_before, .not. after > residual_goal, before, after)
    call destroy_bent_step(path)
    PetscCall(SNESLineSearchComputeNorms(search, ierr))
  end subroutine take_step

  !> Error that is left after a step at most: some times what it is if steps go on to shrink as the last two have.
  pure function remaining_error(line, caution) result(error)
    type(line_search_type), intent(in) :: line !! what the steps have been
    real(wp), intent(in) :: caution !! that many times [1]
    real(wp) :: error !! relative [1]
    real(wp), parameter :: steady = 0.5_wp !! a step over the one before, where that is known [1]

    error = huge(error)
    if (line%step < steady*line%step_before .and. line%step_before < huge(error)) then
      error = caution*line%step*line%step/(line%step_before - line%step)
    end if
  end function remaining_error

  !> Sizes of a step and of the residual where it begins.
  subroutine measure_step(line, x, f, y, before, ierr)
    type(line_search_type), intent(inout) :: line
    Vec, intent(in) :: x, f, y      !! state, residual, step
    PetscReal, intent(out) :: before !! norm of the residual
    PetscErrorCode, intent(out) :: ierr
    PetscReal :: size_x, size_y

    PetscCall(VecNorm(f, NORM_2, before, ierr))
    PetscCall(VecNormBegin(x, NORM_INFINITY, size_x, ierr))
    PetscCall(VecNormBegin(y, NORM_INFINITY, size_y, ierr))
    PetscCall(VecNormEnd(x, NORM_INFINITY, size_x, ierr))
    PetscCall(VecNormEnd(y, NORM_INFINITY, size_y, ierr))
    line%steps = line%steps + 1
    line%step_before = line%step
    line%size_x = max(1.0_wp, size_x)
    line%step = size_y/line%size_x
    line%past = [before, line%past(:memory - 1)]
    line%length = 1.0_wp
    line%impossible = .true.
  end subroutine measure_step

  !> Takes the end of a step's path as the new state, or what of it can be evaluated and has a
  !> residual that is small enough. Contacts are where they are at each trial.
  subroutine go_along_path(line, system, snes, path, most, x, f, y, trial, trial_residual, found, ierr)
    type(line_search_type), intent(inout) :: line
    class(nonlinear_system_type), target, intent(inout) :: system
    SNES, intent(in) :: snes
    type(bent_step_type), intent(in) :: path !! of one piece where the step is straight
    integer, intent(in) :: most              !! halvings; 0: a small step is taken as it is
    Vec, intent(in) :: x, f, y               !! state and residual, which are replaced; step
    Vec, intent(in) :: trial, trial_residual !! are overwritten
    logical, intent(out) :: found            !! else all is as it was, but for the trial
    PetscErrorCode, intent(out) :: ierr
    PetscReal :: after
    integer :: halving
    logical :: moved

    do halving = 0, most
      line%length = 0.5_wp**halving
      call state_on_path(path, line%length*path%length, x, y, trial, ierr)
      CHKERRQ(ierr)
      call system%settle(trial, moved)
      PetscCall(SNESComputeFunction(snes, trial, trial_residual, ierr))
      PetscCall(VecNorm(trial_residual, NORM_2, after, ierr))
      found = is_small_enough(line, after, most == 0)
      if (found) exit
    end do
    if (found) then
      line%length = line%length*path%reached
      line%impossible = .false.
      line%blocked = 0
      PetscCall(VecCopy(trial, x, ierr))
      PetscCall(VecCopy(trial_residual, f, ierr))
    else
      line%length = 1.0_wp
      call system%settle(x, moved)
    end if
  end subroutine go_along_path

  !> Whether a trial's residual is, at the present length of the step. Near the end round-off makes residuals jump: a small
  !> full step is taken as it is.
  pure logical function is_small_enough(line, residual, full) result(is)
    type(line_search_type), intent(in) :: line
    real(wp), intent(in) :: residual !! norm, scaled; not a number where the trial could not be evaluated [1]
    logical, intent(in) :: full      !! the step is not shortened

    is = residual <= huge(1.0_wp)
    if (.not. is .or. line%steps <= line%bold) return
    is = residual <= (1.0_wp - sufficient*line%length)*maxval(line%past) .or. (line%step <= stagnation .and. full)
  end function is_small_enough

  !> Halves a step until it can be evaluated and its residual is small enough.
  subroutine find_length(line, snes, may_halve, x, y, trial, trial_residual, found, ierr)
    type(line_search_type), intent(inout) :: line
    SNES, intent(in) :: snes
    logical, intent(in) :: may_halve         !! else the full step alone is tried
    Vec, intent(in) :: x, y                  !! state and step
    Vec, intent(in) :: trial, trial_residual !! are overwritten
    logical, intent(out) :: found
    PetscErrorCode, intent(out) :: ierr
    PetscReal :: after
    integer :: halving
    logical :: left !! a trial could not be evaluated

    ierr = 0
    found = .false.
    left = .false.
    do halving = 0, merge(halvings, 0, may_halve)
      PetscCall(VecWAXPY(trial, -line%length, y, x, ierr))
      PetscCall(SNESComputeFunction(snes, trial, trial_residual, ierr))
      PetscCall(VecNorm(trial_residual, NORM_2, after, ierr))
      if (after <= huge(1.0_wp)) then ! neither infinite nor NaN
        line%impossible = .false.
        found = is_small_enough(line, after, halving == 0)
      else
        left = .true.
      end if
      if (found) exit
      line%length = 0.5_wp*line%length
    end do
    line%blocked = merge(line%blocked + 1, 0, left .and. line%length < blocked_length)
    if (line%blocked >= most_blocked) then ! the method runs against where gap or pressure end
      found = .false.
      line%impossible = .true.
    end if
  end subroutine find_length

  !> Takes a trial as the new state; contacts follow it. Where its residual is small enough the work of forces is that of
  !> round-off, and says nothing of the step's length.
  subroutine move_there(line, system, snes, residual_goal, x, f, y, trial, trial_residual, ierr)
    type(line_search_type), intent(inout) :: line
    class(nonlinear_system_type), target, intent(inout) :: system
    SNES, intent(in) :: snes
    real(wp), intent(in) :: residual_goal
    Vec, intent(in) :: x, f, y               !! state and residual, which are replaced; step
    Vec, intent(in) :: trial, trial_residual !! at the present length of the step
    PetscErrorCode, intent(out) :: ierr
    PetscReal :: after
    logical :: moved

    ierr = 0
    call system%settle(trial, moved)
    if (moved) then
      PetscCall(SNESComputeFunction(snes, trial, trial_residual, ierr))
      PetscCall(VecNorm(trial_residual, NORM_2, after, ierr))
      if (.not. after <= residual_goal) then
        call balance_work(line, system, snes, x, f, y, trial, trial_residual, ierr)
        CHKERRQ(ierr)
      end if
    end if
    PetscCall(VecCopy(trial, x, ierr))
    PetscCall(VecCopy(trial_residual, f, ierr))
  end subroutine move_there

  !> Shortens a step along which contacts change their state, where the forces on the structure turn
  !> against it: to where they do little work along it. Without friction and film that is a search
  !> for the least energy, which converges from anywhere.
  !>
  !> The length is kept between one at which the forces still drive the step and one at which they turn
  !> too much against it. A straight line between them guesses far too short where a hard contact
  !> closes, so that at least half of the distance is tried.
  subroutine balance_work(line, system, snes, x, f, y, trial, trial_residual, ierr)
    type(line_search_type), intent(inout) :: line
    class(nonlinear_system_type), target, intent(inout) :: system
    SNES, intent(in) :: snes
    Vec, intent(in) :: x, f, y               !! state, residual, step
    Vec, intent(in) :: trial, trial_residual !! at the present length of the step
    PetscErrorCode, intent(out) :: ierr
    real(wp) :: start, low, high, work_low, work_high, work, allowed
    integer :: attempt
    logical :: moved

    ierr = 0
    allowed = merge(unbalanced(1), unbalanced(2), line%steps <= patience)
    start = system%virtual_work(f, y)
    work = system%virtual_work(trial_residual, y)
    ! Where the step begins in equilibrium, as when only the load has moved, there is nothing to compare.
    if (line%steps <= patience .and. start <= at_rest*abs(work)) return
    if (.not. start > 0.0_wp .or. work >= -allowed*start) return
    low = 0.0_wp
    work_low = start
    high = line%length
    work_high = work
    do attempt = 1, balances
      line%length = low + (high - low)*max(0.5_wp, min(0.9_wp, work_low/(work_low - work_high)))
      PetscCall(VecWAXPY(trial, -line%length, y, x, ierr))
      call system%settle(trial, moved)
      PetscCall(SNESComputeFunction(snes, trial, trial_residual, ierr))
      work = system%virtual_work(trial_residual, y)
      if (work > driving*start) then
        low = line%length
        work_low = work
      else if (work < -allowed*start) then
        high = line%length
        work_high = work
      else
        exit
      end if
    end do
  end subroutine balance_work
end module gfb_line_search
