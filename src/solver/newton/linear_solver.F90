#include "gfb_petsc.h"
!> The linear solver of Newton's method: which one a system gets, and when it factors its matrix anew.
!>
!> - direct: factors. They serve again while that makes Newton's steps shrink fast.
!> - lagged: where matrices differ in few entries, earlier factors precondition GMRES.
!> - iterative: multigrid, where the system knows its motions.
!>
!> Earlier factors as preconditioner of GMRES, where matrices differ in few entries, and when new ones pay.
!>
!> All is decided by counts, so that runs repeat.
!>
!> An iterative linear solver for shells: conjugate gradients, or GMRES where the matrix is not
!> symmetric, with two levels of multigrid below.
!>
!> The coarse level holds smoothed motions of patches as rigid bodies and is solved by MUMPS; it has
!> a thirtieth of the unknowns. What is short waved is smoothed by Chebyshev's polynomial of Jacobi's
!> method, which does not depend on the ranks. An answer of the iterations is taken only when its
!> true residual is small.
module gfb_linear_solver
  use petscksp
  use petscsnes
  use gfb_kinds, only: wp
  use gfb_petsc_kinds, only: pint
  use gfb_direct_solver, only: are_of_mumps, set_option_default, use_factors, factor_failure, enlarge_workspace, drop_factors
  use gfb_nonlinear_system, only: nonlinear_system_type
  implicit none (type)
  private
  public :: use_multigrid, choose_solver, begin_solve, judge_start, decide_factors, keep_ready, judge_linear, choose_factors, ask_for_factors, &
            linear_failure, drop_failed_factors, forget_solver

  integer, parameter :: longest_krylov = 60           !! GMRES iterations of a solve at most
  integer, parameter :: cheap_krylov = 2              !! of a solve that new factors would not make shorter
  integer, parameter :: least_krylov = 5              !! new factors never pay before
  real(wp), parameter :: krylov_share = 0.1_wp        !! they pay after this share of flops over entries of theirs
  real(wp), parameter :: krylov_tolerance = 1.0e-3_wp !! of the preconditioned residual, relative

  !> What the present factors have cost so far.
  type :: lagged_factors_type
    logical :: outdated = .true.            !! GMRES has become expensive with them
    integer, private :: spent = 0           !! GMRES iterations that new factors might have saved
    integer, private :: price = least_krylov !! as many cost as much as new factors
  end type lagged_factors_type

  integer(pint), parameter :: longest = 500        !! iterations of a solve at most
  integer(pint), parameter :: restart = 100        !! of GMRES: small bearings stall with 10; it takes room as it goes
  real(wp), parameter :: tolerance = 1.0e-5_wp     !! of the energy of what is left, relative
  real(wp), parameter :: true_tolerance = 1.0e-2_wp !! of the true residual, relative: Newton's method corrects what is left
  integer, parameter :: slower = 2                 !! growth of the iterations after which a new coarse level pays
  real(wp), parameter :: hopeless = 1.0e10_wp      !! growth of the residual that ends a solve

  !> What the present coarse level has cost so far.
  type :: coarse_level_type
    logical :: outdated = .true.            !! it serves no longer
    integer, private :: iterations = 0      !! of the solve for which it was made
  end type coarse_level_type

  real(wp), parameter :: chord_step = 0.02_wp       !! smaller steps leave the factors as they are [1]
  real(wp), parameter :: chord_contraction = 0.2_wp !! kept factors must shrink the steps by this [1]
  real(wp), parameter :: chord_on_the_way = 0.3_wp  !! the same where few digits are wanted [1]
  real(wp), parameter :: chord_fall = 0.9_wp        !! and the residual by this [1]

  real(wp), parameter :: jump = 5.0_wp              !! of the residual at the start of nearby solves, where contacts have changed [1]
  real(wp), parameter :: at_rest = 1.0e-6_wp        !! less than that is usual where nothing moves yet [1]
  real(wp), parameter :: growth = 2.0_wp            !! of what is usual there, from one to the next [1]

  !> What is known of the present factors.
  type, public :: linear_solver_type
    logical :: fresh = .false.                !! they belong to the present state
    character(len=:), allocatable :: unsolved !! why a linear system was not solved, in words; else empty
    logical :: iterates = .false.             !! linear systems are solved by multigrid
    logical :: left = .false.                 !! multigrid has failed since this was last said
    real(wp), private :: contraction = chord_contraction !! that kept factors must reach in the present solve [1]
    logical, private :: keep = .false.        !! use the present factors again
    logical :: forgotten = .true.             !! there are no factors since the beginning, or since they were dropped
    logical, private :: ready = .false.       !! they belong to an answer, and no solve has begun since
    integer, private :: filled = 0            !! times that the matrix had been filled then
    real(wp), private :: usual = 0.0_wp       !! residual at the start of nearby solves; 0: not known [1]
    type(lagged_factors_type), private :: lagged !! what GMRES has cost with the present factors
    type(coarse_level_type), private :: level !! of multigrid
  end type linear_solver_type

contains

  !> Makes a linear solver keep the factors it has.
  subroutine use_lagged_factors(linear)
    KSP, intent(in) :: linear !! prepared by `use_factors`
    PetscErrorCode :: ierr

    PetscCallA(KSPSetType(linear, KSPGMRES, ierr))
    PetscCallA(KSPGMRESSetRestart(linear, int(longest_krylov, pint), ierr))
    PetscCallA(KSPSetTolerances(linear, krylov_tolerance, 0.0_wp, hopeless, int(longest_krylov, pint), ierr))
  end subroutine use_lagged_factors

  !> Whether GMRES converged with the present factors, and whether they serve it further.
  subroutine judge_factors(factors, linear, fresh, solved, ierr)
    type(lagged_factors_type), intent(inout) :: factors !! what they have cost; brought up to date
    KSP, intent(in) :: linear    !! after a solve
    logical, intent(in) :: fresh !! they belong to the present matrix
    logical, intent(out) :: solved !! GMRES reached its tolerance
    PetscErrorCode, intent(out) :: ierr !! PETSc's error code, 0 for none
    KSPConvergedReason :: reason
    PetscInt :: iterations

    PetscCall(KSPGetConvergedReason(linear, reason, ierr))
    PetscCall(KSPGetIterationNumber(linear, iterations, ierr))
    solved = GFB_REASON(reason) > 0 .or. fresh
    if (fresh) then
      factors%spent = 0
      call price_factors(linear, factors%price, ierr)
      CHKERRQ(ierr)
    end if
    factors%spent = factors%spent + max(0, int(iterations) - cheap_krylov)
    factors%outdated = .not. solved .or. factors%spent > factors%price
  end subroutine judge_factors

  !> How many GMRES iterations cost as much as the factors of a solver: by counts, so that runs
  !> repeat.
  subroutine price_factors(linear, price, ierr)
    KSP, intent(in) :: linear
    integer, intent(out) :: price
    PetscErrorCode, intent(out) :: ierr
    integer, parameter :: flops_place = 3, entries_place = 29 !! in MUMPS' RINFOG and INFOG
    PetscReal :: flops
    PetscInt :: entries
    Mat :: factors
    PC :: preconditioner

    price = least_krylov
    PetscCall(KSPGetPC(linear, preconditioner, ierr))
    if (.not. are_of_mumps(preconditioner)) return
    PetscCall(PCFactorGetMatrix(preconditioner, factors, ierr))
    PetscCall(MatMumpsGetRinfog(factors, int(flops_place, pint), flops, ierr))
    PetscCall(MatMumpsGetInfog(factors, int(entries_place, pint), entries, ierr))
    if (entries < 0) entries = -1000000*entries ! in millions where they are many
    price = max(least_krylov, nint(min(krylov_share*flops/max(1, entries), real(longest_krylov, wp))))
  end subroutine price_factors

  !> Makes a linear solver iterate.
  subroutine use_multigrid(linear, prefix, symmetric, motions)
    KSP, intent(in) :: linear              !! without a type yet
    character(len=*), intent(in) :: prefix !! of PETSc's options, such as 'strip_'
    logical, intent(in) :: symmetric       !! the matrix is, and positive definite
    Mat, intent(in) :: motions             !! coarse unknowns to fine ones
    character(len=:), allocatable :: levels, coarse
    PC :: grids
    PetscErrorCode :: ierr

    levels = '-'//prefix//'mg_levels_'
    coarse = '-'//prefix//'mg_coarse_'
    call set_option_default('-'//prefix//'pc_mg_levels', '2')
    call set_option_default('-'//prefix//'pc_mg_galerkin', 'both')
    call set_option_default(levels//'ksp_type', trim(merge('chebyshev', 'gmres    ', symmetric)))
    call set_option_default(levels//'ksp_max_it', merge('4', '6', symmetric))
    call set_option_default(levels//'pc_type', 'jacobi')
    call set_option_default(coarse//'ksp_type', 'preonly')
    call set_option_default(coarse//'pc_type', trim(merge('cholesky', 'lu      ', symmetric)))
    call set_option_default(coarse//'pc_factor_mat_solver_type', MATSOLVERMUMPS)
    call set_option_default(coarse//'mat_mumps_icntl_7', '2') ! PORD, MUMPS' own choice, crashed at 3.4e5 unknowns
    if (symmetric) then
      PetscCallA(KSPSetType(linear, KSPCG, ierr))
      PetscCallA(KSPSetNormType(linear, KSP_NORM_NATURAL, ierr))
    else
      PetscCallA(KSPSetType(linear, KSPFGMRES, ierr)) ! its residual is the true one
      PetscCallA(KSPGMRESSetRestart(linear, restart, ierr))
    end if
    PetscCallA(KSPSetTolerances(linear, merge(tolerance, true_tolerance, symmetric), 0.0_wp, hopeless, longest, ierr))
    PetscCallA(KSPGetPC(linear, grids, ierr))
    PetscCallA(PCSetType(grids, PCMG, ierr))
    PetscCallA(PCSetFromOptions(grids, ierr))
    PetscCallA(PCMGSetInterpolation(grids, 1_pint, motions, ierr))
  end subroutine use_multigrid

  !> Whether the iterations converged by their true residual, and whether the coarse level serves on.
  subroutine judge_iterations(level, linear, symmetric, matrix, right, solution, work, fresh, solved, ierr)
    type(coarse_level_type), intent(inout) :: level !! what it has cost; brought up to date
    KSP, intent(in) :: linear          !! after a solve
    logical, intent(in) :: symmetric   !! the matrix is
    Mat, intent(in) :: matrix          !! of the system that was solved
    Vec, intent(in) :: right, solution !! of the system, scaled
    Vec, intent(in) :: work            !! overwritten
    logical, intent(in) :: fresh       !! the coarse level belongs to this matrix
    logical, intent(out) :: solved     !! the true residual is small
    PetscErrorCode, intent(out) :: ierr !! PETSc's error code, 0 for none
    KSPConvergedReason :: reason
    PetscInt :: iterations
    PetscReal :: wanted, left

    PetscCall(KSPGetConvergedReason(linear, reason, ierr))
    PetscCall(KSPGetIterationNumber(linear, iterations, ierr))
    solved = GFB_REASON(reason) > 0
    if (solved .and. symmetric) then ! GMRES follows the true one itself
      PetscCall(MatMult(matrix, solution, work, ierr))
      PetscCall(VecAXPY(work, -1.0_wp, right, ierr))
      PetscCall(VecNorm(work, NORM_2, left, ierr))
      PetscCall(VecNorm(right, NORM_2, wanted, ierr))
      solved = left <= true_tolerance*wanted
    end if
    if (fresh) level%iterations = int(iterations)
    level%outdated = .not. solved .or. int(iterations) > slower*level%iterations
  end subroutine judge_iterations

  !> Gives SNES the solver that suits a system: multigrid where it has motions, else factors.
  subroutine choose_solver(snes, prefix, system, solver)
    SNES, intent(in) :: snes !! whose linear solver it is
    character(len=*), intent(in) :: prefix !! of PETSc's options, such as 'bearing_'
    class(nonlinear_system_type), intent(in) :: system !! the equations
    type(linear_solver_type), intent(inout) :: solver !! what is known of the factors
    KSP :: linear
    PetscErrorCode :: ierr

    PetscCallA(SNESGetKSP(snes, linear, ierr))
    solver%keep = .false.
    solver%iterates = system%has_motions
    if (solver%iterates) then
      call use_multigrid(linear, prefix, system%symmetric, system%motions)
    else
      call use_factors(linear, prefix, system%symmetric, system%dense_rows, system%definite, system%low_fill, &
                       system%jacobian, system%plane, system%layer)
    end if
    if (.not. (system%slow_change .or. solver%iterates)) return
    if (.not. solver%iterates) call use_lagged_factors(linear)
    PetscCallA(SNESSetMaxLinearSolveFailures(snes, huge(1_pint), ierr))
  end subroutine choose_solver

  !> A solve of the nonlinear equations begins: factors that belong to its start serve once.
  subroutine begin_solve(solver, times_filled, on_the_way)
    type(linear_solver_type), intent(inout) :: solver !! its kept factors serve once
    integer, intent(in) :: times_filled !! the system's matrix, so far
    logical, intent(in) :: on_the_way   !! the solve is a stage of another iteration

    solver%keep = solver%ready .and. solver%filled == times_filled
    solver%ready = .false.
    solver%contraction = merge(chord_on_the_way, chord_contraction, on_the_way)
    solver%unsolved = ''
  end subroutine begin_solve

  !> A solve of nearly the same equations begins with a residual. Where it is far above the usual one contacts have opened or
  !> closed, and a step by the factors at hand would lead nowhere.
  pure subroutine judge_start(solver, residual)
    type(linear_solver_type), intent(inout) :: solver !! its factors are kept or not
    real(wp), intent(in) :: residual !! root mean square, scaled [1]

    if (solver%usual > 0.0_wp) then
      solver%keep = solver%keep .and. residual <= jump*solver%usual
      solver%usual = max(min(residual, growth*solver%usual), at_rest)
    else
      solver%usual = max(residual, at_rest)
    end if
  end subroutine judge_start

  !> The present factors belong to an answer: the next solve may use them.
  subroutine keep_ready(solver, ready, times_filled)
    type(linear_solver_type), intent(inout) :: solver !! what is known of the factors
    logical, intent(in) :: ready        !! the matrix could be factored
    integer, intent(in) :: times_filled !! the system's matrix, so far

    solver%ready = ready
    solver%filled = times_filled
  end subroutine keep_ready

  !> Whether a step gets new factors, and whether the matrix is to be filled for it.
  subroutine decide_factors(solver, snes, slow_change, fill, ierr)
    type(linear_solver_type), intent(inout) :: solver !! what is known of the factors
    SNES, intent(in) :: snes !! whose linear solver it is
    logical, intent(in) :: slow_change !! matrices differ in few entries
    logical, intent(out) :: fill       !! a matrix that is not touched keeps its factors
    PetscErrorCode, intent(out) :: ierr !! PETSc's error code, 0 for none

    ierr = 0
    fill = .true.
    if (slow_change) then
      ! To PETSc -2 is: new factors now, -1: none until asked.
      solver%fresh = merge(solver%level%outdated, solver%lagged%outdated, solver%iterates)
      PetscCall(SNESSetLagPreconditioner(snes, merge(-2_pint, -1_pint, solver%fresh), ierr))
    else
      solver%fresh = solver%iterates .or. .not. solver%keep
      fill = solver%fresh
    end if
    if (solver%fresh) solver%forgotten = .false.
  end subroutine decide_factors

  !> Whether a linear system was solved; says why where new factors could not do it.
  subroutine judge_linear(solver, snes, system, right, solution, work, solved, ierr)
    type(linear_solver_type), intent(inout) :: solver !! what is known of the factors
    SNES, intent(in) :: snes !! whose linear solver it is
    class(nonlinear_system_type), intent(in) :: system !! whose matrix it was, scaled
    Vec, intent(in) :: right, solution !! scaled
    Vec, intent(in) :: work            !! overwritten
    logical, intent(out) :: solved !! its solution serves a step
    PetscErrorCode, intent(out) :: ierr !! PETSc's error code, 0 for none
    KSP :: linear

    PetscCall(SNESGetKSP(snes, linear, ierr))
    if (solver%iterates) then
      call judge_iterations(solver%level, linear, system%symmetric, system%jacobian, right, solution, work, solver%fresh, solved, ierr)
      CHKERRQ(ierr)
      if (solver%fresh .and. .not. solved) call leave_iterations(solver, linear, system)
    else
      call judge_factors(solver%lagged, linear, solver%fresh, solved, ierr)
      CHKERRQ(ierr)
      solver%unsolved = factor_failure(linear)
      solved = solved .and. solver%unsolved == ''
    end if
  end subroutine judge_linear

  !> From now on there are factors.
  subroutine leave_iterations(solver, linear, system)
    type(linear_solver_type), intent(inout) :: solver !! its multigrid has failed
    KSP, intent(in) :: linear !! its
    class(nonlinear_system_type), intent(in) :: system !! the equations
    character(len=80) :: prefix
    PetscErrorCode :: ierr

    solver%iterates = .false.
    solver%left = .true.
    PetscCallA(KSPGetOptionsPrefix(linear, prefix, ierr))
    PetscCallA(KSPReset(linear, ierr))
    PetscCallA(KSPSetNormType(linear, KSP_NORM_DEFAULT, ierr))
    call use_factors(linear, trim(prefix), system%symmetric, system%dense_rows, system%definite, system%low_fill, &
                     system%jacobian, system%plane, system%layer)
    if (system%slow_change) call use_lagged_factors(linear)
    call ask_for_factors(solver)
  end subroutine leave_iterations

  !> Whether the present factors serve the next step too.
  !>
  !> Where contacts have changed, kept factors lead nowhere with steps that look small: then the
  !> residual stays.
  pure subroutine choose_factors(solver, full, first, step, step_before, small, before, after)
    type(linear_solver_type), intent(inout) :: solver !! what is known of the factors
    logical, intent(in) :: full            !! the step was taken whole, and contacts are where they are linearised
    logical, intent(in) :: first           !! it was the first of its solve
    real(wp), intent(in) :: step           !! largest relative change of an unknown [1]
    real(wp), intent(in) :: step_before    !! the same of the step before [1]
    logical, intent(in) :: small           !! the residual after it is within its tolerance
    real(wp), intent(in) :: before, after  !! norms of the scaled residual before and after it [1]

    if (.not. full) then
      solver%keep = .false.
    else if (solver%fresh .or. first) then
      solver%keep = step < chord_step
    else
      solver%keep = step < solver%contraction*step_before
    end if
    if (.not. small) solver%keep = solver%keep .and. after < chord_fall*before
  end subroutine choose_factors

  !> A step of earlier factors has led nowhere: the next one gets new ones.
  !>
  !> Iterations with earlier factors end by the residual that those have been applied to. Where a strip that lies free
  !> glides as a whole that is next to all of it, and the rest of the step may be anything.
  pure subroutine ask_for_factors(solver)
    type(linear_solver_type), intent(inout) :: solver !! what is known of the factors

    solver%keep = .false.
    solver%lagged%outdated = .true.
    solver%level%outdated = .true.
  end subroutine ask_for_factors

  !> Why PETSc gave up a linear system, in words.
  function linear_failure(snes) result(words)
    SNES, intent(in) :: snes !! whose linear solver it is
    character(len=:), allocatable :: words
    KSP :: linear
    PetscErrorCode :: ierr

    PetscCallA(SNESGetKSP(snes, linear, ierr))
    words = factor_failure(linear)
    if (words == '') words = 'the matrix is singular'
  end function linear_failure

  !> Forgets factors that could not be made, as PETSc would not make them again; whether those to come get a
  !> larger workspace, so that it is worth while to try.
  subroutine drop_failed_factors(solver, snes, enlarged)
    type(linear_solver_type), intent(inout) :: solver !! what is known of the factors
    SNES, intent(in) :: snes !! after a solve without an answer
    logical, intent(out) :: enlarged !! the workspace was too small
    KSP :: linear
    PetscInt :: failures
    PetscErrorCode :: ierr
    integer :: room

    enlarged = .false.
    PetscCallA(SNESGetLinearSolveFailures(snes, failures, ierr))
    if (solver%iterates .or. failures == 0) return ! what the linear solver says is of an earlier solve
    PetscCallA(SNESGetKSP(snes, linear, ierr))
    if (factor_failure(linear) == '') return
    call enlarge_workspace(linear, room)
    call forget_solver(solver, snes)
    enlarged = room > 0
  end subroutine drop_failed_factors

  !> Forgets all factors and what they have cost.
  subroutine forget_solver(solver, snes)
    type(linear_solver_type), intent(inout) :: solver !! what is known of the factors
    SNES, intent(in) :: snes !! whose linear solver it is
    type(lagged_factors_type) :: none
    KSP :: linear
    PetscErrorCode :: ierr

    PetscCallA(SNESGetKSP(snes, linear, ierr))
    call drop_factors(linear)
    solver%ready = .false.
    solver%forgotten = .true.
    solver%usual = 0.0_wp
    solver%lagged = none
  end subroutine forget_solver
end module gfb_linear_solver
