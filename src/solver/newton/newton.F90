#include "gfb_petsc.h"
!> Newton's method on a set of equations, by SNES.
!>
!> Steps are judged by their size: the method has converged when the last full step was small. How much
!> of a step is taken, `line_search.F90` says; how it is found and when the matrix is factored anew,
!> `linear_solver.F90`.
!>
!> A residual cannot become smaller than what rounding leaves of the sums it is made of. Where it is
!> no larger than that, and the steps shrink no more, there is nothing left to find: the state solves
!> equations whose coefficients differ from the given ones in the last digits, by the theorem of
!> Oettli and Prager. Such a solve is said to have converged at round-off, and its last step shows how
!> many digits the equations have. A state that is no answer has a residual far above that.
!>
!> What rounding may leave of a residual.
!>
!> A computed sum \( \sum_j J_{ij} x_j \) is off by some \( \epsilon \sum_j |J_{ij}| |x_j| \). No state
!> has a residual that is known better; one whose residual is no larger solves equations whose
!> coefficients differ in their last digits alone, by the theorem of Oettli and Prager.
module gfb_newton
  use, intrinsic :: ieee_exceptions, only: ieee_divide_by_zero, ieee_get_halting_mode, ieee_set_halting_mode
  use petscsnes
  use petscmat
  use gfb_kinds, only: wp
  use gfb_text, only: text
  use gfb_run_log, only: run_log_type
  use gfb_petsc_kinds, only: pint
  use gfb_matrix_rows, only: copy_row, row_length
  use gfb_archive, only: archive_type
  use gfb_signals, only: stop_agreed, stop_words
  use gfb_petsc_session, only: stop_is_asked, any_rank
  use gfb_nonlinear_system, only: nonlinear_system_type
  use gfb_direct_solver, only: factor_matrix, sign_of_factors, factors_by
  use gfb_linear_solver, only: linear_solver_type, choose_solver, begin_solve, judge_start, decide_factors, keep_ready, &
                               linear_failure, drop_failed_factors, forget_solver
  use gfb_line_search, only: line_search_type, take_step, remaining_error, stagnation
  use gfb_secant_steps, only: secants_type, begin_secants, forget_secants, destroy_secants
  use gfb_work_bound, only: work_bound_type, count_factorization, is_spent, share_words, gave_up_words
  implicit none (type)
  private
  public :: show_enlargements, create_newton, renew_newton, solve_newton, solve_nearby, find_determinant_sign, tell_determinant_sign, &
            solve_with_factors, has_factors, solve_transposed, forget_factors, destroy_newton, visit_counts, imbalance, newton_report_type, work_bound_type

  !> How a solve ended.
  type, public :: newton_report_type
    logical :: converged = .false.
    character(len=:), allocatable :: reason !! in words
    integer :: iterations = 0
    real(wp) :: residual = 0.0_wp !! root mean square of the scaled residual [1]
    logical :: at_round_off = .false. !! the residual is above its tolerance, but all of it is rounding
    real(wp) :: round_off = 0.0_wp !! then: the last relative step [1]
  end type newton_report_type

  !> Roundings of a row's sum that do not cancel each other, with those of the solution before it.
  real(wp), parameter :: roundings = 4.0_wp

  real(wp), parameter :: careful = 1.0e-3_wp !! of the step's tolerance, where nothing shows how steps shrink [1]
  real(wp), parameter :: cautious = 1000.0_wp  !! times what is left if steps go on to shrink: two steps are few [1]
  real(wp), parameter :: hasty = 3.0_wp        !! the same on the way to another answer [1]
  real(wp), parameter :: visible = 1.0e-2_wp !! larger steps are no round-off [1]
  real(wp), parameter :: close_by = 0.1_wp !! scaled unknowns of states whose matrices differ by a part of each entry [1]
  real(wp), parameter :: nearness = 0.3_wp !! factors that are near miss no more of a vector than this [1]
  integer, parameter :: inverse_iterations = 2 !! that make this vector
  real(wp), parameter :: difference = 1.0e-7_wp !! of scaled unknowns, for a derivative along a vector [1]
  real(wp), parameter :: golden = 0.5_wp*(sqrt(5.0_wp) - 1.0_wp) !! multiples of it fill an interval evenly

  !> When to stop.
  type, public :: newton_settings_type
    real(wp) :: residual_tolerance = 1.0e-8_wp !! of the scaled residual's root mean square [1]
    real(wp) :: step_tolerance = 1.0e-10_wp    !! of the largest relative step [1]
    integer :: maximum_iterations = 40         !! of one solve
    !> Of one solve, before they are bent at contacts that change. A bent step may end on another branch: only a search
    !> for any answer bends them, a path that follows a branch does not.
    integer :: straight_steps = huge(1)
    integer :: bold_steps = 0 !! of one solve, the first ones, that may enlarge the residual
    logical :: on_the_way = .false. !! the answer is a stage of another iteration, which its error goes into once
    logical :: may_be_stopped = .true. !! by a signal, between two iterations
    type(work_bound_type), pointer :: bound => null() !! of a search for an answer, where it has one
  end type newton_settings_type

  !> The solver and its memory. It is handed to SNES by address: keep it where it is.
  type, public :: newton_type
    type(newton_settings_type) :: settings
    type(run_log_type) :: log
    integer :: iterations = 0     !! since its creation
    integer :: factorizations = 0 !! since its creation, and before
    integer :: factorizations_before = 0 !! of them on smaller systems, whose answer led here
    integer :: enlargements = 0   !! of the factors' workspace, since its creation
    SNES, private :: snes
    Vec, private :: residual
    logical :: created = .false.
    class(nonlinear_system_type), pointer, private :: system => null()
    type(linear_solver_type), private :: linear
    type(line_search_type), private :: line  !! of the present solve
    type(secants_type), private :: secants   !! what steps with kept factors have taught
    logical, private :: traps = .false.      !! divisions by zero stop the program (debug build)
    logical, private :: begins_near = .false. !! the present solve begins beside an answer
    logical, private :: rounded = .false.    !! the present solve has ended at round-off
    real(wp), private :: unknowns = 1.0_wp   !! their number
    integer, private :: factored = 0         !! times that the matrix had been filled when it was factored last
    Vec, private :: factored_at              !! the state where it was
  end type newton_type

contains

  !> SNES' reason as a sentence; empty where the linear solver knows more.
  function reason_in_words(reason, impossible, maximum_iterations) result(words)
    integer, intent(in) :: reason             !! SNES' number
    logical, intent(in) :: impossible         !! no trial along the last step could be evaluated
    integer, intent(in) :: maximum_iterations !! that were allowed
    character(len=:), allocatable :: words

    if (reason > 0) then
      words = 'converged'
    else if (impossible) then
      words = 'every trial along the step closed the gap or emptied the film'
    else if (reason == int(GFB_REASON(SNES_DIVERGED_FUNCTION_DOMAIN))) then
      words = 'the gap or the pressure was not positive at the start'
    else if (reason == int(GFB_REASON(SNES_DIVERGED_LINEAR_SOLVE))) then
      words = ''
    else if (reason == int(GFB_REASON(SNES_DIVERGED_MAX_IT))) then
      words = 'no convergence in '//text(maximum_iterations)//' iterations'
    else if (reason == int(GFB_REASON(SNES_DIVERGED_LINE_SEARCH)) .or. &
             reason == int(GFB_REASON(SNES_DIVERGED_LOCAL_MIN))) then
      words = 'no step made the residual smaller'
    else
      words = 'SNES stopped with reason '//text(reason)
    end if
  end function reason_in_words

  !> A line of the table of iterations.
  subroutine show_iteration(log, iteration, residual, step, length, new_factors, spent)
    type(run_log_type), intent(in) :: log !! gets the lines of progress
    integer, intent(in) :: iteration  !! 0: the start, whose line has no step
    real(wp), intent(in) :: residual  !! root mean square of the scaled residual [1]
    real(wp), intent(in) :: step      !! largest change of an unknown by the full step, relative [1]
    real(wp), intent(in) :: length    !! share of the step that was taken [1]
    logical, intent(in) :: new_factors !! the step's factors belong to its own matrix
    character(len=*), intent(in) :: spent !! how much of what a search may cost, before the iteration; or empty
    character(len=80) :: line

    if (iteration == 0) then
      call log%detail('iteration    residual        step      length  factors')
      write (line, '(i9, es12.3)') iteration, residual
    else
      write (line, '(i9, 2es12.3, f12.6, a9)') iteration, residual, step, length, &
        merge('new   ', 'lagged', new_factors)
    end if
    call log%detail(trim(line))
    call log%waiting(spent//'Newton iteration '//text(iteration)//', residual '//text(residual, 2))
  end subroutine show_iteration

  !> Says that MUMPS found its workspace too small, and how often so far.
  subroutine show_enlargements(log, enlargements)
    type(run_log_type), intent(in) :: log   !! gets the line
    integer, intent(in) :: enlargements !! of the workspace, since the solver's creation

    call log%line('the factors'' workspace was too small (MUMPS'' INFOG(1) = -9): enlarged, '//text(enlargements)// &
                  ' time(s) so far')
  end subroutine show_enlargements

  !> The norm over all equations of what rounding may leave of the scaled residual [1].
  real(wp) function backward_error(matrix, state) result(rounding)
    Mat, intent(in) :: matrix !! the derivative of the residual, scaled
    Vec, intent(in) :: state  !! scaled

    Mat :: magnitudes
    Vec :: sizes, sums
    PetscInt, allocatable :: column(:)
    PetscScalar, allocatable :: value(:)
    PetscInt :: first, last, row, entries
    PetscReal :: norm
    PetscErrorCode :: ierr

    PetscCallA(MatDuplicate(matrix, MAT_DO_NOT_COPY_VALUES, magnitudes, ierr))
    PetscCallA(MatGetOwnershipRange(matrix, first, last, ierr))
    do row = first, last - 1
      entries = row_length(matrix, row)
      allocate (column(entries), value(entries))
      call copy_row(matrix, row, entries, column, value)
      PetscCallA(MatSetValues(magnitudes, 1_pint, [row], entries, column, abs(value), INSERT_VALUES, ierr))
      deallocate (column, value)
    end do
    PetscCallA(MatAssemblyBegin(magnitudes, MAT_FINAL_ASSEMBLY, ierr))
    PetscCallA(MatAssemblyEnd(magnitudes, MAT_FINAL_ASSEMBLY, ierr))
    PetscCallA(VecDuplicate(state, sizes, ierr))
    PetscCallA(VecDuplicate(state, sums, ierr))
    PetscCallA(VecCopy(state, sizes, ierr))
    PetscCallA(VecAbs(sizes, ierr))
    PetscCallA(MatMult(magnitudes, sizes, sums, ierr))
    PetscCallA(VecNorm(sums, NORM_2, norm, ierr))
    rounding = roundings*0.5_wp*epsilon(1.0_wp)*norm
    PetscCallA(VecDestroy(sums, ierr))
    PetscCallA(VecDestroy(sizes, ierr))
    PetscCallA(MatDestroy(magnitudes, ierr))
  end function backward_error

  !> Sets up SNES for a system; both must stay where they are.
  subroutine create_newton(newton, system, prefix, settings, log)
    type(newton_type), target, intent(inout) :: newton !! must not have been created, or be destroyed
    class(nonlinear_system_type), target, intent(in) :: system !! with its state and its matrix
    character(len=*), intent(in) :: prefix !! of PETSc's options, such as 'bearing_'
    type(newton_settings_type), intent(in) :: settings !! when to stop
    type(run_log_type), intent(in) :: log !! gets the lines of progress

    SNESLineSearch :: search
    KSP :: linear
    PetscInt :: unknowns
    PetscErrorCode :: ierr

    newton%system => system
    newton%settings = settings
    newton%log = log
    call ieee_get_halting_mode(ieee_divide_by_zero, newton%traps)
    PetscCallA(VecDuplicate(system%state, newton%residual, ierr))
    PetscCallA(VecDuplicate(system%state, newton%factored_at, ierr))
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
    call choose_solver(newton%snes, prefix, system, newton%linear)
    PetscCallA(SNESSetFromOptions(newton%snes, ierr))
    if (system%low_fill .or. allocated(system%layer)) then
      PetscCallA(SNESGetKSP(newton%snes, linear, ierr))
      call log%detail('linear systems: '//factors_by(linear))
    end if
    newton%created = .true.
  end subroutine create_newton

  !> Makes the solver anew for a system that takes the place of the one before; settings and counts go on.
  subroutine renew_newton(newton, system, prefix)
    type(newton_type), target, intent(inout) :: newton !! of the one before, which may be gone
    class(nonlinear_system_type), target, intent(in) :: system !! with its state and its matrix
    character(len=*), intent(in) :: prefix !! of PETSc's options

    call destroy_newton(newton)
    call create_newton(newton, system, prefix, newton%settings, newton%log)
  end subroutine renew_newton

  !> Solves from the system's present state; on failure the state is where it stopped.
  subroutine solve_newton(newton, report)
    type(newton_type), target, intent(inout) :: newton !! the solver
    type(newton_report_type), intent(out) :: report !! how it ended

    call begin_secants(newton%secants, newton%system%state, .false.)
    call solve_on(newton, report)
  end subroutine solve_newton

  !> The same of equations that are nearly those of the solve before: with the factors at hand, if there are any, and with
  !> what steps have taught since they were made.
  subroutine solve_nearby(newton, report, again)
    type(newton_type), target, intent(inout) :: newton !! the solver
    type(newton_report_type), intent(out) :: report !! how it ended
    !> from beside the answer of the solve before: how small its residual is there says nothing of other solves
    logical, intent(in), optional :: again

    newton%begins_near = .false.
    if (present(again)) newton%begins_near = again
    call keep_ready(newton%linear, .not. newton%linear%forgotten, newton%system%times_filled)
    call begin_secants(newton%secants, newton%system%state, .not. newton%system%slow_change)
    call solve_on(newton, report)
  end subroutine solve_nearby

  !> Runs SNES, again where factors had too little room.
  subroutine solve_on(newton, report)
    type(newton_type), target, intent(inout) :: newton
    type(newton_report_type), intent(out) :: report

    integer :: before
    logical :: enlarged

    before = newton%iterations
    do
      call run_newton(newton, report)
      newton%iterations = newton%iterations + report%iterations
      if (report%converged) exit
      call drop_failed_factors(newton%linear, newton%snes, enlarged)
      if (.not. enlarged) exit ! else on from where it stopped
      newton%enlargements = newton%enlargements + 1
      call show_enlargements(newton%log, newton%enlargements)
    end do
    report%iterations = newton%iterations - before
  end subroutine solve_on

  !> One run of SNES.
  subroutine run_newton(newton, report)
    type(newton_type), target, intent(inout) :: newton
    type(newton_report_type), intent(out) :: report

    SNESConvergedReason :: reason
    PetscInt :: iterations
    PetscReal :: norm
    PetscErrorCode :: ierr
    logical :: moved

    call begin_solve(newton%linear, newton%system%times_filled, newton%settings%on_the_way)
    newton%rounded = .false.
    newton%line = line_search_type()
    newton%line%straight = newton%settings%straight_steps
    newton%line%bold = newton%settings%bold_steps
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
    report%reason = full_reason(newton, int(GFB_REASON(reason)))
    report%at_round_off = newton%rounded
    if (GFB_REASON(reason) == GFB_REASON(SNES_DIVERGED_MAX_IT)) call blame_round_off(newton, norm, report%reason)
    if (newton%rounded) report%round_off = newton%line%step
  end subroutine run_newton

  !> Sign of the determinant of the system's matrix at its present state: 1, -1, or 0 where there is
  !> none. It changes from state to state only where an eigenvalue goes through zero, as at a fold.
  !>
  !> Takes a factorization; where linear systems are iterated there is none, and no sign.
  subroutine find_determinant_sign(newton, sign_of_determinant)
    type(newton_type), intent(inout) :: newton !! the solver
    integer, intent(out) :: sign_of_determinant !! 1, -1, or 0
    KSP :: linear
    PetscErrorCode :: ierr
    integer :: before

    sign_of_determinant = 0
    if (newton%linear%iterates) return
    call newton%system%linearise(newton%system%state)
    call forget_secants(newton%secants)
    newton%factorizations = newton%factorizations + 1
    call count_factorization(newton%settings%bound, newton%unknowns)
    PetscCallA(SNESGetKSP(newton%snes, linear, ierr))
    call ieee_set_halting_mode(ieee_divide_by_zero, .false.)
    before = newton%enlargements
    call factor_matrix(linear, newton%system%jacobian, sign_of_determinant, newton%enlargements)
    call keep_ready(newton%linear, sign_of_determinant /= 0, newton%system%times_filled)
    newton%factored = newton%system%times_filled
    PetscCallA(VecCopy(newton%system%state, newton%factored_at, ierr))
    call ieee_set_halting_mode(ieee_divide_by_zero, newton%traps)
    if (newton%enlargements > before) call show_enlargements(newton%log, newton%enlargements)
  end subroutine find_determinant_sign

  !> The same where nobody needs the factors of just this state: from the last ones, if their matrix is near.
  subroutine tell_determinant_sign(newton, sign_of_determinant)
    type(newton_type), intent(inout) :: newton !! the solver
    integer, intent(out) :: sign_of_determinant !! 1, -1, or 0
    KSP :: linear
    PetscErrorCode :: ierr

    sign_of_determinant = 0
    if (factors_are_near(newton)) then
      PetscCallA(SNESGetKSP(newton%snes, linear, ierr))
      sign_of_determinant = sign_of_factors(linear)
      call keep_ready(newton%linear, sign_of_determinant /= 0, newton%system%times_filled)
    end if
    if (sign_of_determinant == 0) call find_determinant_sign(newton, sign_of_determinant)
  end subroutine tell_determinant_sign

  !> Whether the last factors are of a matrix so near to the present one that both determinants have one sign.
  !>
  !> Where the spectral radius of \( E = I - A^{-1} J \) is below 1, with the factored matrix \( A \) and the present one \( J \), the
  !> eigenvalues of \( A^{-1} J \) are nearer to 1 than 0 is: real ones are positive, others come in pairs, and so \( \det A^{-1} J > 0 \).
  !> Of states that are close the matrices are, too, and on what has gone through zero between them \( A \) does little, as little as it
  !> differs from \( J \): such a vector grows most where \( A^{-1} \) is applied again and again (inverse iteration). What \( E \) leaves of
  !> it then shows the radius. Its product with \( J \) is a difference of residuals, so that no matrix is made.
  logical function factors_are_near(newton) result(near)
    type(newton_type), intent(inout) :: newton
    Vec :: way, change, work
    PetscScalar, pointer :: value(:)
    PetscReal :: before, after, largest, moved
    PetscInt :: first, last, i
    PetscErrorCode :: ierr
    logical :: valid(2)
    integer :: k

    near = .false.
    if (newton%linear%iterates .or. newton%linear%forgotten .or. newton%system%slow_change) return
    if (newton%factored /= newton%system%times_filled) return
    PetscCallA(VecDuplicate(newton%residual, way, ierr))
    PetscCallA(VecDuplicate(newton%residual, change, ierr))
    PetscCallA(VecDuplicate(newton%residual, work, ierr))
    PetscCallA(VecWAXPY(work, -1.0_wp, newton%factored_at, newton%system%state, ierr))
    PetscCallA(VecNorm(work, NORM_INFINITY, moved, ierr))
    PetscCallA(VecGetOwnershipRange(way, first, last, ierr))
    PetscCallA(GFB_VecGetArray(way, value, ierr))
    value = [(golden*real(i, wp) - floor(golden*real(i, wp)) - 0.5_wp, i=first + 1, last)] ! an arbitrary one, on all ranks alike
    PetscCallA(GFB_VecRestoreArray(way, value, ierr))
    do k = 1, inverse_iterations
      if (moved > close_by) exit
      call solve_with_factors(newton, way, work)
      PetscCallA(VecNorm(work, NORM_INFINITY, largest, ierr))
      if (.not. (largest > 0.0_wp .and. largest <= huge(largest))) exit
      PetscCallA(VecAXPBY(way, difference/largest, 0.0_wp, work, ierr))
    end do
    if (k > inverse_iterations) then
      PetscCallA(VecWAXPY(work, 1.0_wp, way, newton%system%state, ierr))
      call newton%system%evaluate(work, change, valid(1))
      ! Last where the state is: the system keeps some of it.
      call newton%system%evaluate(newton%system%state, newton%residual, valid(2))
      PetscCallA(VecAXPY(change, -1.0_wp, newton%residual, ierr))
      call solve_with_factors(newton, change, work)
      PetscCallA(VecNorm(way, NORM_2, before, ierr))
      PetscCallA(VecAXPY(way, -1.0_wp, work, ierr))
      PetscCallA(VecNorm(way, NORM_2, after, ierr))
      near = .not. any_rank(.not. all(valid))
      near = near .and. after <= nearness*before
    end if
    PetscCallA(VecDestroy(work, ierr))
    PetscCallA(VecDestroy(change, ierr))
    PetscCallA(VecDestroy(way, ierr))
  end function factors_are_near

  !> Whether there are factors, those of the last matrix that was factored.
  pure logical function has_factors(newton)
    type(newton_type), intent(in) :: newton !! the solver
    has_factors = newton%created .and. .not. newton%linear%forgotten
  end function has_factors

  !> Solves a linear system with the factors at hand: those that `find_determinant_sign` made, or the last ones of a solve.
  subroutine solve_with_factors(newton, right, solution)
    type(newton_type), intent(in) :: newton !! the solver
    Vec, intent(in) :: right    !! scaled
    Vec, intent(in) :: solution !! scaled; is overwritten
    KSP :: linear
    PetscErrorCode :: ierr

    PetscCallA(SNESGetKSP(newton%snes, linear, ierr))
    PetscCallA(KSPSolve(linear, right, solution, ierr))
  end subroutine solve_with_factors

  !> The same of the transposed system.
  subroutine solve_transposed(newton, right, solution)
    type(newton_type), intent(in) :: newton !! the solver
    Vec, intent(in) :: right    !! scaled
    Vec, intent(in) :: solution !! scaled; is overwritten
    KSP :: linear
    PetscErrorCode :: ierr

    PetscCallA(SNESGetKSP(newton%snes, linear, ierr))
    PetscCallA(KSPSolveTranspose(linear, right, solution, ierr))
  end subroutine solve_transposed

  !> Forgets all factors and how they were found, as if no solve had been before: what follows depends
  !> on the system's state alone, and so does a run that is resumed from that state.
  subroutine forget_factors(newton)
    type(newton_type), intent(inout) :: newton !! the solver

    call forget_solver(newton%linear, newton%snes)
    call forget_secants(newton%secants)
  end subroutine forget_factors

  !> How a solve ended, in words.
  function full_reason(newton, reason) result(words)
    type(newton_type), intent(in) :: newton
    integer, intent(in) :: reason !! SNES' number
    character(len=:), allocatable :: words

    if (newton%rounded) then
      words = 'converged at round-off'
    else if (stop_agreed() .and. reason <= 0) then
      words = stop_words()
    else if (is_spent(newton%settings%bound) .and. reason <= 0) then
      words = gave_up_words
    else if (reason <= 0 .and. newton%linear%unsolved /= '') then
      words = newton%linear%unsolved
    else
      words = reason_in_words(reason, newton%line%impossible, newton%settings%maximum_iterations)
      if (words == '') words = linear_failure(newton%snes)
    end if
  end function full_reason

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
    logical :: fill

    call newton%system%begin_step()
    call decide_factors(newton%linear, snes, newton%system%slow_change, fill, ierr)
    CHKERRQ(ierr)
    if (.not. fill) return
    if (newton%linear%fresh) then
      newton%factorizations = newton%factorizations + 1
      call count_factorization(newton%settings%bound, newton%unknowns)
    end if
    call forget_secants(newton%secants)
    call ieee_set_halting_mode(ieee_divide_by_zero, newton%traps)
    call newton%system%linearise(x)
    newton%factored = newton%system%times_filled
    PetscCall(VecCopy(x, newton%factored_at, ierr))
    call ieee_set_halting_mode(ieee_divide_by_zero, .false.)
  end subroutine form_jacobian

  !> SNES callback. Takes what can be taken of a step.
  subroutine search_line(search, newton, ierr)
    SNESLineSearch, intent(in) :: search
    type(newton_type), intent(inout) :: newton
    PetscErrorCode, intent(out) :: ierr

    call take_step(newton%line, newton%linear, newton%secants, newton%system, search, &
                   newton%settings%residual_tolerance*sqrt(newton%unknowns), ierr)
  end subroutine search_line

  !> SNES callback. Ends what has converged, and between two iterations what is to stop.
  subroutine test_convergence(snes, iteration, size_x, size_y, norm, reason, newton, ierr)
    SNES, intent(in) :: snes
    PetscInt, intent(in) :: iteration
    PetscReal, intent(in) :: size_x, size_y, norm
    SNESConvergedReason, intent(out) :: reason
    type(newton_type), intent(inout) :: newton
    PetscErrorCode, intent(out) :: ierr

    ierr = 0
    call judge_iteration(newton, iteration, norm, reason)
    if (GFB_REASON(reason) /= GFB_REASON(SNES_CONVERGED_ITERATING)) return
    if (is_spent(newton%settings%bound)) reason = SNES_DIVERGED_FUNCTION_COUNT
    if (.not. newton%settings%may_be_stopped) return
    if (stop_is_asked()) reason = SNES_DIVERGED_FUNCTION_COUNT
  end subroutine test_convergence

  !> Converged when the last full step was small, or when small steps shrink no more.
  subroutine judge_iteration(newton, iteration, norm, reason)
    type(newton_type), intent(inout) :: newton
    PetscInt, intent(in) :: iteration
    PetscReal, intent(in) :: norm !! of the scaled residual [1]
    SNESConvergedReason, intent(out) :: reason

    real(wp) :: residual, rounding
    logical :: small

    reason = SNES_CONVERGED_ITERATING
    residual = norm/sqrt(newton%unknowns)
    if (newton%linear%left) then
      call newton%log%line('the linear iterations did not converge: factors from here on')
      newton%linear%left = .false.
    end if
    call show_iteration(newton%log, int(iteration), residual, newton%line%step, newton%line%length, newton%linear%fresh, &
                        share_words(newton%settings%bound))
    if (iteration == 0) then
      if (newton%secants%used .and. .not. newton%begins_near) call judge_start(newton%linear, residual)
      if (residual <= 10.0_wp*epsilon(1.0_wp) .and. newton%system%settled) reason = SNES_CONVERGED_FNORM_ABS
      return
    end if
    if (newton%line%length < 1.0_wp .or. .not. newton%system%settled) return
    small = newton%line%step <= newton%settings%step_tolerance
    if (newton%secants%used .and. newton%settings%on_the_way) then
      small = small .or. remaining_error(newton%line, hasty) <= newton%settings%step_tolerance
    else if (newton%secants%used) then ! errors of steps of time add up
      small = newton%line%step <= careful*newton%settings%step_tolerance
      small = small .or. remaining_error(newton%line, cautious) <= newton%settings%step_tolerance
    end if
    if ((newton%linear%fresh .or. newton%system%slow_change) .and. newton%line%step <= stagnation) then
      small = small .or. newton%line%step > 0.5_wp*newton%line%step_before
    end if
    if (.not. small) return
    if (residual <= newton%settings%residual_tolerance*newton%line%size_x) then
      reason = SNES_CONVERGED_SNORM_RELATIVE
    else if (newton%line%step > 0.5_wp*newton%line%step_before) then
      rounding = backward_error(newton%system%jacobian, newton%system%state)/sqrt(newton%unknowns)
      newton%rounded = residual <= rounding
      if (.not. newton%rounded) return
      reason = SNES_CONVERGED_SNORM_RELATIVE
      call newton%log%detail('converged at round-off: no more of the residual is left than the '//text(rounding, 2)// &
                             ' that rounding may leave of its sums')
    end if
  end subroutine judge_iteration

  !> Adds to the reason of a solve that ran out of iterations that nothing but rounding is left.
  subroutine blame_round_off(newton, norm, reason)
    type(newton_type), intent(in) :: newton
    real(wp), intent(in) :: norm !! of the residual
    character(len=:), allocatable, intent(inout) :: reason
    real(wp) :: rounding

    if (.not. newton%line%step <= visible) return
    rounding = backward_error(newton%system%jacobian, newton%system%state)
    if (.not. norm <= rounding) return
    reason = reason//': the residual is round-off alone, which moves the unknowns by '//text(newton%line%step, 2)// &
      ' of themselves from step to step'
  end subroutine blame_round_off

  !> Frees what PETSc holds; may be called twice.
  subroutine destroy_newton(newton)
    type(newton_type), intent(inout) :: newton !! may be one that was never created
    PetscErrorCode :: ierr

    if (.not. newton%created) return
    PetscCallA(SNESDestroy(newton%snes, ierr))
    PetscCallA(VecDestroy(newton%residual, ierr))
    PetscCallA(VecDestroy(newton%factored_at, ierr))
    call destroy_secants(newton%secants)
    if (allocated(newton%linear%unsolved)) deallocate (newton%linear%unsolved)
    newton%created = .false.
  end subroutine destroy_newton

  !> How far the system's present state is from an answer: root mean square of the scaled residual; huge where that cannot be
  !> evaluated.
  real(wp) function imbalance(newton) result(norm)
    type(newton_type), intent(inout) :: newton !! its solver
    logical :: valid
    PetscErrorCode :: ierr

    call newton%system%evaluate(newton%system%state, newton%residual, valid)
    norm = huge(norm)
    if (any_rank(.not. valid)) return
    PetscCallA(VecNorm(newton%residual, NORM_2, norm, ierr))
    norm = norm/sqrt(newton%unknowns)
  end function imbalance

  !> Saves or restores what was spent.
  pure subroutine visit_counts(archive, newton)
    type(archive_type), intent(inout) :: archive !! that saves or restores
    type(newton_type), intent(inout) :: newton !! written where the archive restores

    call archive%visit('newton_iterations', newton%iterations)
    call archive%visit('factorizations', newton%factorizations)
    call archive%visit('factorizations_before', newton%factorizations_before)
    if (archive%saves) return
    call archive%require(min(newton%iterations, newton%factorizations, newton%factorizations_before) >= 0, 'what the solver has spent')
  end subroutine visit_counts
end module gfb_newton
