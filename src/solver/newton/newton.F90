#include "gfb_petsc.h"
!> Newton's method on a set of equations, by SNES.
!>
!> Steps are judged by their size: the method has come home when the last full step was small. The
!> factors of an earlier matrix serve again while that makes the steps shrink fast; where matrices
!> differ in few entries they precondition GMRES instead, as long as that needs few iterations. The
!> line search is non-monotone: a residual may grow for a while, but not beyond the largest of the
!> last few.
!>
!> A residual cannot become smaller than what rounding leaves of the sums it is made of. Where it is
!> no larger than that, and the steps shrink no more, there is nothing left to find: the state solves
!> equations whose coefficients differ from the given ones in the last digits, by the theorem of
!> Oettli and Prager. Such a solve is said to have converged at round-off, and its last step tells how
!> many digits the equations have. A state that is no answer has a residual far above that.
module gfb_newton
  use, intrinsic :: ieee_exceptions, only: ieee_divide_by_zero, ieee_get_halting_mode, &
                                           ieee_set_halting_mode
  use petscsnes
  use gfb_kinds, only: wp
  use gfb_text, only: text
  use gfb_run_log, only: run_log_type
  use gfb_petsc_kinds, only: pint
  use gfb_nonlinear_system, only: nonlinear_system_type
  use gfb_direct_solver, only: use_factors, factor_matrix, factor_failure
  use gfb_multigrid, only: coarse_level_type, use_multigrid, judge_iterations
  use gfb_backward_error, only: rounding_of
  use gfb_lagged_factors, only: old_factors_type, use_old_factors, judge_factors
  implicit none (type)
  private
  public :: create_newton, solve_newton, find_determinant_sign, solve_with_factors, forget_factors, &
            destroy_newton

  integer, parameter :: memory = 5                 !! residuals that the line search remembers
  integer, parameter :: halvings = 24              !! shortest trial is 2^-24 of a step
  real(wp), parameter :: sufficient = 1.0e-4_wp    !! decrease asked for, relative to a full step's
  real(wp), parameter :: chord_step = 0.02_wp      !! smaller steps leave the factors as they are
  real(wp), parameter :: chord_contraction = 0.2_wp !! old factors must shrink the steps by this
  real(wp), parameter :: chord_fall = 0.9_wp       !! and the residual by this
  real(wp), parameter :: blocked_length = 0.01_wp  !! of a step that goes nowhere
  integer, parameter :: most_blocked = 2           !! such steps before it is given up
  integer, parameter :: balances = 8                !! trials of a step's length for contacts
  integer, parameter :: patience = 12               !! steps after which contacts are taken to cycle
  real(wp), parameter :: unbalanced(2) = [10.0_wp, 0.5_wp] !! work at a step's end over that at its
  !! beginning, before and after that
  real(wp), parameter :: at_rest = 1.0e-2_wp       !! work at a step's beginning that is none, over that at its end
  real(wp), parameter :: stagnation = 1.0e-6_wp    !! steps this small that shrink no more are round-off
  real(wp), parameter :: visible = 1.0e-2_wp       !! larger steps are no round-off

  !> When to stop.
  type, public :: newton_settings_type
    real(wp) :: residual_tolerance = 1.0e-8_wp !! of the scaled residual's root mean square [1]
    real(wp) :: step_tolerance = 1.0e-10_wp    !! of the largest relative step [1]
    integer :: maximum_iterations = 40         !! of one solve
  end type newton_settings_type

  !> How a solve ended.
  type, public :: newton_report_type
    logical :: converged = .false.
    character(len=:), allocatable :: reason !! in words
    integer :: iterations = 0
    real(wp) :: residual = 0.0_wp !! root mean square of the scaled residual [1]
    logical :: at_round_off = .false. !! the residual is above its tolerance, but all of it is rounding
    real(wp) :: round_off = 0.0_wp !! then: the last relative step [1]
  end type newton_report_type

  !> The solver and its memory. It is handed to SNES by address: keep it where it is.
  type, public :: newton_type
    type(newton_settings_type) :: settings
    type(run_log_type) :: log
    integer :: iterations = 0     !! since its creation
    integer :: factorizations = 0 !! since its creation
    SNES, private :: snes
    Vec, private :: residual
    logical, private :: created = .false.
    logical, private :: iterates = .false.   !! linear systems are solved by iterations
    class(nonlinear_system_type), pointer, private :: system => null()
    logical, private :: keep = .false.       !! use the present factors again
    logical, private :: ready = .false.      !! they belong to an answer, and no solve has begun since
    integer, private :: filled = 0           !! times that the matrix had been filled then
    type(old_factors_type), private :: old   !! what GMRES has cost with the present factors
    type(coarse_level_type), private :: level !! of an iterative solver
    character(len=:), allocatable, private :: unsolved !! why a linear system was not, in words
    logical, private :: fresh = .false.      !! the factors belong to the present state
    logical, private :: traps = .false.      !! divisions by zero stop the program (debug build)
    logical, private :: rounded = .false.    !! the present solve has ended at round-off
    logical, private :: impossible = .false. !! no trial along the step could be evaluated
    integer, private :: blocked = 0          !! steps in succession that were cut very short for that
    real(wp), private :: unknowns = 1.0_wp   !! their number
    integer, private :: steps = 0            !! of the present solve
    real(wp), private :: size_x = 1.0_wp     !! largest unknown, at least 1
    real(wp), private :: step = 0.0_wp       !! last relative step, before it was shortened
    real(wp), private :: step_before = 0.0_wp
    real(wp), private :: length = 1.0_wp     !! share of the step that was gone
    real(wp), private :: past(memory) = 0.0_wp !! last residual norms
  end type newton_type

contains

  !> Sets up SNES for a system; both must stay where they are.
  subroutine create_newton(newton, system, prefix, settings, log)
    type(newton_type), target, intent(inout) :: newton
    class(nonlinear_system_type), target, intent(in) :: system
    character(len=*), intent(in) :: prefix !! of PETSc's options, such as 'bearing_'
    type(newton_settings_type), intent(in) :: settings
    type(run_log_type), intent(in) :: log

    SNESLineSearch :: search
    KSP :: linear
    PetscInt :: unknowns
    PetscErrorCode :: ierr

    newton%system => system
    newton%settings = settings
    newton%log = log
    newton%keep = .false.
    call ieee_get_halting_mode(ieee_divide_by_zero, newton%traps)
    PetscCallA(VecDuplicate(system%state, newton%residual, ierr))
    PetscCallA(VecGetSize(system%state, unknowns, ierr))
    newton%unknowns = real(max(unknowns, 1_pint), wp)
    PetscCallA(SNESCreate(PETSC_COMM_WORLD, newton%snes, ierr))
    PetscCallA(SNESSetOptionsPrefix(newton%snes, prefix, ierr))
    PetscCallA(SNESSetFunction(newton%snes, newton%residual, form_residual, newton, ierr))
    PetscCallA(SNESSetJacobian(newton%snes, system%jacobian, system%jacobian, form_jacobian, newton, ierr))
    PetscCallA(SNESSetConvergenceTest(newton%snes, test_convergence, newton, PETSC_NULL_FUNCTION, ierr))
    PetscCallA(SNESGetLineSearch(newton%snes, search, ierr))
    PetscCallA(SNESLineSearchSetType(search, SNESLINESEARCHSHELL, ierr))
    PetscCallA(SNESLineSearchShellSetApply(search, search_line, newton, ierr))
    PetscCallA(SNESGetKSP(newton%snes, linear, ierr))
    newton%iterates = system%has_motions
    if (newton%iterates) then
      call use_multigrid(linear, prefix, system%symmetric, system%motions)
    else
      call use_factors(linear, prefix, system%symmetric, system%dense_rows, system%definite)
    end if
    if (system%slow_change) then
      if (.not. newton%iterates) call use_old_factors(linear)
      PetscCallA(SNESSetMaxLinearSolveFailures(newton%snes, huge(1_pint), ierr))
    end if
    PetscCallA(SNESSetFromOptions(newton%snes, ierr))
    newton%created = .true.
  end subroutine create_newton

  !> Solves from the system's present state; on failure the state is where it stopped.
  subroutine solve_newton(newton, report)
    type(newton_type), target, intent(inout) :: newton
    type(newton_report_type), intent(out) :: report

    SNESConvergedReason :: reason
    PetscInt :: iterations
    PetscReal :: norm
    PetscErrorCode :: ierr
    logical :: moved

    newton%keep = newton%ready .and. newton%filled == newton%system%times_filled
    newton%ready = .false.
    newton%impossible = .false.
    newton%rounded = .false.
    newton%blocked = 0
    newton%unsolved = ''
    newton%step = huge(1.0_wp)
    newton%step_before = huge(1.0_wp)
    newton%length = 1.0_wp
    newton%size_x = 1.0_wp
    newton%steps = 0
    newton%past = 0.0_wp
    PetscCallA(SNESSetTolerances(newton%snes, 0.0_wp, 0.0_wp, 0.0_wp, int(newton%settings%maximum_iterations, pint), 1000000_pint, ierr))
    ! PETSc marks what it cannot evaluate or solve with one over zero.
    call newton%system%settle(newton%system%state, moved)
    call ieee_set_halting_mode(ieee_divide_by_zero, .false.)
    PetscCallA(SNESSolve(newton%snes, PETSC_NULL_VEC, newton%system%state, ierr))
    call ieee_set_halting_mode(ieee_divide_by_zero, newton%traps)
    PetscCallA(SNESGetConvergedReason(newton%snes, reason, ierr))
    PetscCallA(SNESGetIterationNumber(newton%snes, iterations, ierr))
    PetscCallA(SNESGetFunctionNorm(newton%snes, norm, ierr))
    report%converged = GFB_REASON(reason) > 0
    report%iterations = int(iterations)
    report%residual = norm/sqrt(newton%unknowns)
    report%reason = reason_in_words(newton, int(GFB_REASON(reason)))
    report%at_round_off = newton%rounded
    if (GFB_REASON(reason) == GFB_REASON(SNES_DIVERGED_MAX_IT)) call blame_round_off(newton, norm, report%reason)
    if (newton%rounded) report%round_off = newton%step
    newton%iterations = newton%iterations + report%iterations
  end subroutine solve_newton

  !> Sign of the determinant of the system's matrix at its present state: 1, -1, or 0 where there is
  !> none. It changes from state to state only where an eigenvalue goes through zero, as at a fold.
  !>
  !> Takes a factorization.
  subroutine find_determinant_sign(newton, sign_of_determinant)
    type(newton_type), intent(inout) :: newton
    integer, intent(out) :: sign_of_determinant
    KSP :: linear
    PetscErrorCode :: ierr

    call newton%system%linearise(newton%system%state)
    newton%factorizations = newton%factorizations + 1
    PetscCallA(SNESGetKSP(newton%snes, linear, ierr))
    call ieee_set_halting_mode(ieee_divide_by_zero, .false.)
    call factor_matrix(linear, newton%system%jacobian, sign_of_determinant)
    newton%ready = sign_of_determinant /= 0
    newton%filled = newton%system%times_filled
    call ieee_set_halting_mode(ieee_divide_by_zero, newton%traps)
  end subroutine find_determinant_sign

  !> Solves a linear system with the factors that `find_determinant_sign` made.
  subroutine solve_with_factors(newton, right, solution)
    type(newton_type), intent(in) :: newton
    Vec, intent(in) :: right
    Vec, intent(in) :: solution
    KSP :: linear
    PetscErrorCode :: ierr

    PetscCallA(SNESGetKSP(newton%snes, linear, ierr))
    PetscCallA(KSPSolve(linear, right, solution, ierr))
  end subroutine solve_with_factors

  !> Forgets all factors and how they were found, as if no solve had been before: what follows depends
  !> on the system's state alone, and so does a run that goes on from that state.
  subroutine forget_factors(newton)
    type(newton_type), intent(inout) :: newton
    type(old_factors_type) :: none
    KSP :: linear
    PetscErrorCode :: ierr

    PetscCallA(SNESGetKSP(newton%snes, linear, ierr))
    PetscCallA(KSPReset(linear, ierr))
    newton%ready = .false.
    newton%old = none
  end subroutine forget_factors

  !> SNES' reason as a sentence.
  function reason_in_words(newton, reason) result(words)
    type(newton_type), intent(in) :: newton
    integer, intent(in) :: reason
    character(len=:), allocatable :: words

    if (newton%rounded) then
      words = 'converged at round-off'
    else if (reason > 0) then
      words = 'converged'
    else if (newton%unsolved /= '') then
      words = newton%unsolved
    else if (newton%impossible) then
      words = 'every trial along the step closed the gap or emptied the film'
    else if (reason == int(GFB_REASON(SNES_DIVERGED_FUNCTION_DOMAIN))) then
      words = 'the gap or the pressure was not positive at the start'
    else if (reason == int(GFB_REASON(SNES_DIVERGED_LINEAR_SOLVE))) then
      words = newton_linear_failure(newton)
    else if (reason == int(GFB_REASON(SNES_DIVERGED_MAX_IT))) then
      words = 'no convergence in '//text(newton%settings%maximum_iterations)//' iterations'
    else if (reason == int(GFB_REASON(SNES_DIVERGED_LINE_SEARCH)) .or. &
             reason == int(GFB_REASON(SNES_DIVERGED_LOCAL_MIN))) then
      words = 'no step made the residual smaller'
    else
      words = 'SNES stopped with reason '//text(reason)
    end if
  end function reason_in_words

  !> Why PETSc gave up a linear system, in words.
  function newton_linear_failure(newton) result(words)
    type(newton_type), intent(in) :: newton
    character(len=:), allocatable :: words
    KSP :: linear
    PetscErrorCode :: ierr

    PetscCallA(SNESGetKSP(newton%snes, linear, ierr))
    words = factor_failure(linear)
    if (words == '') words = 'the matrix is singular'
  end function newton_linear_failure

  !> SNES callback. A state that cannot be evaluated is a domain error, so that the line search
  !> shortens the step; it is not a PETSc error.
  subroutine form_residual(snes, x, f, newton, ierr)
    SNES, intent(in) :: snes
    Vec, intent(in) :: x !! scaled state
    Vec, intent(in) :: f !! scaled residual
    type(newton_type), intent(inout) :: newton
    PetscErrorCode, intent(out) :: ierr
    logical :: valid

    call ieee_set_halting_mode(ieee_divide_by_zero, newton%traps)
    call newton%system%evaluate(x, f, valid)
    call ieee_set_halting_mode(ieee_divide_by_zero, .false.)
    ierr = 0
    if (.not. valid) then
      PetscCall(SNESSetFunctionDomainError(snes, ierr))
    end if
  end subroutine form_residual

  !> SNES callback. A matrix that is not touched keeps its factors.
  subroutine form_jacobian(snes, x, jacobian, preconditioner, newton, ierr)
    SNES, intent(in) :: snes
    Vec, intent(in) :: x !! scaled state
    Mat, intent(in) :: jacobian, preconditioner
    type(newton_type), intent(inout) :: newton
    PetscErrorCode, intent(out) :: ierr

    ierr = 0
    call newton%system%begin_step()
    if (newton%system%slow_change) then
      ! To PETSc -2 is: new factors now, -1: none until told.
      newton%fresh = merge(newton%level%outdated, newton%old%outdated, newton%iterates)
      PetscCall(SNESSetLagPreconditioner(snes, merge(-2_pint, -1_pint, newton%fresh), ierr))
      if (newton%fresh) newton%factorizations = newton%factorizations + 1
    else
      newton%fresh = .not. newton%keep
      if (newton%keep) return
      newton%factorizations = newton%factorizations + 1
    end if
    call ieee_set_halting_mode(ieee_divide_by_zero, newton%traps)
    call newton%system%linearise(x)
    call ieee_set_halting_mode(ieee_divide_by_zero, .false.)
  end subroutine form_jacobian

  !> SNES callback. Halves the step until it can be evaluated and the residual is not larger than
  !> the largest of the last few. Where old factors gave the step, it is dropped and new ones
  !> follow.
  subroutine search_line(search, newton, ierr)
    SNESLineSearch, intent(in) :: search
    type(newton_type), intent(inout) :: newton
    PetscErrorCode, intent(out) :: ierr

    SNES :: snes
    KSP :: linear
    Vec :: x, f, y, trial, trial_residual
    PetscReal :: before, after, size_x, size_y
    integer :: halving
    logical :: found, moved, solved, left

    PetscCall(SNESLineSearchGetSNES(search, snes, ierr))
    PetscCall(SNESLineSearchGetVecs(search, x, f, y, trial, trial_residual, ierr))
    PetscCall(SNESLineSearchSetReason(search, SNES_LINESEARCH_SUCCEEDED, ierr))
    PetscCall(VecNorm(f, NORM_2, before, ierr))
    PetscCall(VecNorm(x, NORM_INFINITY, size_x, ierr))
    PetscCall(VecNorm(y, NORM_INFINITY, size_y, ierr))
    newton%steps = newton%steps + 1
    newton%step_before = newton%step
    newton%size_x = max(1.0_wp, size_x)
    newton%step = size_y/newton%size_x
    newton%past = [before, newton%past(:memory - 1)]
    newton%length = 1.0_wp
    found = .false.
    left = .false.
    newton%impossible = .true.
    if (newton%system%slow_change) then
      PetscCall(SNESGetKSP(snes, linear, ierr))
      call judge_linear(newton, linear, f, y, trial, solved, ierr)
      CHKERRQ(ierr)
      if (.not. solved) then ! again with new factors
        newton%length = 0.0_wp
        newton%impossible = .false.
        PetscCall(SNESLineSearchComputeNorms(search, ierr))
        if (newton%unsolved /= '') then
          PetscCall(SNESLineSearchSetReason(search, SNES_LINESEARCH_FAILED_REDUCT, ierr))
        end if
        return
      end if
    end if
    do halving = 0, merge(halvings, 0, newton%fresh .or. newton%system%slow_change)
      PetscCall(VecWAXPY(trial, -newton%length, y, x, ierr))
      PetscCall(SNESComputeFunction(snes, trial, trial_residual, ierr))
      PetscCall(VecNorm(trial_residual, NORM_2, after, ierr))
      if (after <= huge(1.0_wp)) then ! neither infinite nor NaN
        newton%impossible = .false.
        ! Near the end round-off makes residuals jump: a small full step is taken as it is.
        found = after <= (1.0_wp - sufficient*newton%length)*maxval(newton%past) .or. &
          (newton%step <= stagnation .and. halving == 0)
      else
        left = .true.
      end if
      if (found) exit
      newton%length = 0.5_wp*newton%length
    end do
    newton%blocked = merge(newton%blocked + 1, 0, left .and. newton%length < blocked_length)
    if (newton%blocked >= most_blocked) then ! the method runs against where gap or pressure end
      found = .false.
      newton%impossible = .true.
    end if
    if (found) then
      call newton%system%settle(trial, moved)
      if (moved) then
        PetscCall(SNESComputeFunction(snes, trial, trial_residual, ierr))
        call balance_work(newton, snes, x, f, y, trial, trial_residual, ierr)
        CHKERRQ(ierr)
      end if
      PetscCall(VecCopy(trial, x, ierr))
      PetscCall(VecCopy(trial_residual, f, ierr))
    else
      newton%length = 0.0_wp
      if (newton%fresh .or. newton%system%slow_change) then
        PetscCall(SNESLineSearchSetReason(search, SNES_LINESEARCH_FAILED_REDUCT, ierr))
      end if
      newton%impossible = newton%impossible .and. newton%fresh
    end if
    PetscCall(VecNorm(f, NORM_2, after, ierr))
    call choose_factors(newton, before, after)
    PetscCall(SNESLineSearchComputeNorms(search, ierr))
  end subroutine search_line

  !> Whether a linear system was solved; says why where new factors could not do it.
  subroutine judge_linear(newton, linear, right, solution, work, solved, ierr)
    type(newton_type), intent(inout) :: newton
    KSP, intent(in) :: linear
    Vec, intent(in) :: right, solution
    Vec, intent(in) :: work !! overwritten
    logical, intent(out) :: solved
    PetscErrorCode, intent(out) :: ierr

    if (newton%iterates) then
      call judge_iterations(newton%level, linear, newton%system%jacobian, right, solution, work, newton%fresh, solved, ierr)
      CHKERRQ(ierr)
      if (newton%fresh .and. .not. solved) newton%unsolved = "the linear iterations did not converge: linear_solver = 'direct' needs none"
    else
      call judge_factors(newton%old, linear, newton%fresh, solved, ierr)
      CHKERRQ(ierr)
      newton%unsolved = factor_failure(linear)
      solved = solved .and. newton%unsolved == ''
    end if
  end subroutine judge_linear

  !> Shortens a step along which contacts change their state, where the forces on the structure turn
  !> against it: to where they do little work along it. Without friction and film that is a search
  !> for the least energy, which finds home from anywhere.
  subroutine balance_work(newton, snes, x, f, y, trial, trial_residual, ierr)
    type(newton_type), intent(inout) :: newton
    SNES, intent(in) :: snes
    Vec, intent(in) :: x, f, y               !! state, residual, step
    Vec, intent(in) :: trial, trial_residual !! at the present length of the step
    PetscErrorCode, intent(out) :: ierr
    real(wp) :: start, low, high, work_low, work
    integer :: attempt
    logical :: moved
    real(wp) :: allowed

    ierr = 0
    allowed = merge(unbalanced(1), unbalanced(2), newton%steps <= patience)
    start = newton%system%virtual_work(f, y)
    work = newton%system%virtual_work(trial_residual, y)
    low = 0.0_wp
    work_low = start
    high = newton%length
    ! Where the step begins in equilibrium, as when only the load has moved, there is nothing to compare.
    if (newton%steps <= patience .and. start <= at_rest*abs(work)) return
    do attempt = 1, balances
      if (.not. start > 0.0_wp .or. work >= -allowed*start) return
      newton%length = low + (high - low)*max(0.1_wp, min(0.9_wp, work_low/(work_low - work)))
      PetscCall(VecWAXPY(trial, -newton%length, y, x, ierr))
      call newton%system%settle(trial, moved)
      PetscCall(SNESComputeFunction(snes, trial, trial_residual, ierr))
      work = newton%system%virtual_work(trial_residual, y)
      high = newton%length
    end do
  end subroutine balance_work

  !> Whether the present factors serve the next step too.
  !>
  !> Where contacts have changed, old factors lead nowhere with steps that look small: then the
  !> residual stays.
  pure subroutine choose_factors(newton, before, after)
    type(newton_type), intent(inout) :: newton
    real(wp), intent(in) :: before, after !! norms of the residual before and after the step

    if (newton%length < 1.0_wp .or. .not. newton%system%settled) then
      newton%keep = .false.
    else if (newton%fresh .or. newton%steps == 1) then
      newton%keep = newton%step < chord_step
    else
      newton%keep = newton%step < chord_contraction*newton%step_before
    end if
    if (after > newton%settings%residual_tolerance*sqrt(newton%unknowns)) then
      newton%keep = newton%keep .and. after < chord_fall*before
    end if
  end subroutine choose_factors

  !> SNES callback. Converged when the last full step was small, or when small steps shrink no more.
  subroutine test_convergence(snes, iteration, size_x, size_y, norm, reason, newton, ierr)
    SNES, intent(in) :: snes
    PetscInt, intent(in) :: iteration
    PetscReal, intent(in) :: size_x, size_y, norm
    SNESConvergedReason, intent(out) :: reason
    type(newton_type), intent(inout) :: newton
    PetscErrorCode, intent(out) :: ierr

    real(wp) :: residual, rounding
    logical :: small

    ierr = 0
    reason = SNES_CONVERGED_ITERATING
    residual = norm/sqrt(newton%unknowns)
    call show_iteration(newton, int(iteration), residual)
    if (iteration == 0) then
      if (residual <= 10.0_wp*epsilon(1.0_wp) .and. newton%system%settled) reason = SNES_CONVERGED_FNORM_ABS
      return
    end if
    if (newton%length < 1.0_wp .or. .not. newton%system%settled) return
    small = newton%step <= newton%settings%step_tolerance
    if ((newton%fresh .or. newton%system%slow_change) .and. newton%step <= stagnation) then
      small = small .or. newton%step > 0.5_wp*newton%step_before
    end if
    if (.not. small) return
    if (residual <= newton%settings%residual_tolerance*newton%size_x) then
      reason = SNES_CONVERGED_SNORM_RELATIVE
    else if (newton%step > 0.5_wp*newton%step_before) then
      rounding = rounding_of(newton%system%jacobian, newton%system%state)/sqrt(newton%unknowns)
      newton%rounded = residual <= rounding
      if (.not. newton%rounded) return
      reason = SNES_CONVERGED_SNORM_RELATIVE
      call newton%log%detail('converged at round-off: no more of the residual is left than the '//text(rounding, 2)// &
                             ' that rounding may leave of its sums')
    end if
  end subroutine test_convergence

  !> Adds to the reason of a solve that ran out of iterations that nothing but rounding is left.
  subroutine blame_round_off(newton, norm, reason)
    type(newton_type), intent(in) :: newton
    real(wp), intent(in) :: norm !! of the residual
    character(len=:), allocatable, intent(inout) :: reason
    real(wp) :: rounding

    if (.not. newton%step <= visible) return
    rounding = rounding_of(newton%system%jacobian, newton%system%state)
    if (.not. norm <= rounding) return
    reason = reason//': the residual is round-off alone, which moves the unknowns by '//text(newton%step, 2)// &
      ' of themselves from step to step'
  end subroutine blame_round_off

  !> A line of the table of iterations.
  subroutine show_iteration(newton, iteration, residual)
    type(newton_type), intent(in) :: newton
    integer, intent(in) :: iteration
    real(wp), intent(in) :: residual
    character(len=80) :: line

    if (iteration == 0) then
      call newton%log%detail('iteration    residual        step      length  factors')
      write (line, '(i9, es12.3)') iteration, residual
    else
      write (line, '(i9, 2es12.3, f12.6, a9)') iteration, residual, newton%step, newton%length, &
        merge('new', 'old', newton%fresh)
    end if
    call newton%log%detail(trim(line))
  end subroutine show_iteration

  !> Frees what PETSc holds; may be called twice.
  subroutine destroy_newton(newton)
    type(newton_type), intent(inout) :: newton
    PetscErrorCode :: ierr

    if (.not. newton%created) return
    PetscCallA(SNESDestroy(newton%snes, ierr))
    PetscCallA(VecDestroy(newton%residual, ierr))
    newton%created = .false.
  end subroutine destroy_newton
end module gfb_newton
