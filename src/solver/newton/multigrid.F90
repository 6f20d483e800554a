#include "gfb_petsc.h"
!> An iterative linear solver for shells: conjugate gradients, or GMRES where the matrix is not
!> symmetric, with two levels of multigrid below.
!>
!> The coarse level holds smoothed motions of patches as rigid bodies and is solved by MUMPS; it has
!> a thirtieth of the unknowns. What is short waved is smoothed by Chebyshev's polynomial of Jacobi's
!> method, which does not depend on the ranks. An answer of the iterations is taken only when its
!> true residual is small.
module gfb_multigrid
  use petscksp
  use gfb_kinds, only: wp
  use gfb_petsc_kinds, only: pint
  use gfb_direct_solver, only: set_option_default
  implicit none (type)
  private
  public :: use_multigrid, judge_iterations

  integer(pint), parameter :: longest = 500        !! iterations of a solve at most
  integer(pint), parameter :: restart = 60         !! of GMRES
  real(wp), parameter :: tolerance = 1.0e-5_wp     !! of the preconditioned residual, relative
  !> Of the true residual, relative: Newton's last steps start at round-off, which is all that the
  !> iterations can reach then.
  real(wp), parameter :: true_tolerance = 1.0e-3_wp
  integer, parameter :: slower = 2                 !! growth of the iterations after which a new coarse level pays
  real(wp), parameter :: hopeless = 1.0e10_wp      !! growth of it that ends a solve

  !> What the present coarse level has cost so far.
  type, public :: coarse_level_type
    logical :: outdated = .true.            !! it serves no longer
    integer, private :: iterations = 0      !! of the solve for which it was made
  end type coarse_level_type

contains

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
    call set_option_default(levels//'ksp_type', 'chebyshev')
    call set_option_default(levels//'ksp_max_it', '4')
    call set_option_default(levels//'pc_type', 'jacobi')
    call set_option_default(coarse//'ksp_type', 'preonly')
    call set_option_default(coarse//'pc_type', trim(merge('cholesky', 'lu      ', symmetric)))
    call set_option_default(coarse//'pc_factor_mat_solver_type', MATSOLVERMUMPS)
    if (symmetric) then
      PetscCallA(KSPSetType(linear, KSPCG, ierr))
      PetscCallA(KSPSetNormType(linear, KSP_NORM_NATURAL, ierr))
    else
      PetscCallA(KSPSetType(linear, KSPGMRES, ierr))
      PetscCallA(KSPGMRESSetRestart(linear, restart, ierr))
    end if
    PetscCallA(KSPSetTolerances(linear, tolerance, 0.0_wp, hopeless, longest, ierr))
    PetscCallA(KSPGetPC(linear, grids, ierr))
    PetscCallA(PCSetType(grids, PCMG, ierr))
    PetscCallA(PCSetFromOptions(grids, ierr))
    PetscCallA(PCMGSetInterpolation(grids, 1_pint, motions, ierr))
  end subroutine use_multigrid

  !> Whether the iterations converged by their true residual, and whether the coarse level serves on.
  subroutine judge_iterations(level, linear, matrix, right, solution, work, fresh, solved, ierr)
    type(coarse_level_type), intent(inout) :: level !! what it has cost; brought up to date
    KSP, intent(in) :: linear          !! after a solve
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
    if (solved) then
      PetscCall(MatMult(matrix, solution, work, ierr))
      PetscCall(VecAXPY(work, -1.0_wp, right, ierr))
      PetscCall(VecNorm(work, NORM_2, left, ierr))
      PetscCall(VecNorm(right, NORM_2, wanted, ierr))
      solved = left <= true_tolerance*wanted
    end if
    if (fresh) level%iterations = int(iterations)
    level%outdated = .not. solved .or. int(iterations) > slower*level%iterations
  end subroutine judge_iterations
end module gfb_multigrid
