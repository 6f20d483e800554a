#include "gfb_petsc.h"
!> Earlier factors as preconditioner of GMRES, where matrices differ in few entries, and when new ones pay.
!>
!> All is decided by counts, so that runs repeat.
module gfb_lagged_factors
  use petscksp
  use gfb_kinds, only: wp
  use gfb_petsc_kinds, only: pint
  use gfb_direct_solver, only: are_of_mumps
  implicit none (type)
  private
  public :: use_lagged_factors, judge_factors

  integer, parameter :: longest_krylov = 60           !! GMRES iterations of a solve at most
  integer, parameter :: cheap_krylov = 2              !! of a solve that new factors would not make shorter
  integer, parameter :: least_krylov = 5              !! new factors never pay before
  real(wp), parameter :: krylov_share = 0.1_wp        !! they pay after this share of flops over entries of theirs
  real(wp), parameter :: krylov_tolerance = 1.0e-3_wp !! of the preconditioned residual, relative
  real(wp), parameter :: hopeless_krylov = 1.0e10_wp  !! growth of that residual that ends a solve

  !> What the present factors have cost so far.
  type, public :: lagged_factors_type
    logical :: outdated = .true.            !! GMRES has become expensive with them
    integer, private :: spent = 0           !! GMRES iterations that new factors might have saved
    integer, private :: price = least_krylov !! as many cost as much as new factors
  end type lagged_factors_type

contains

  !> Makes a linear solver keep the factors it has.
  subroutine use_lagged_factors(linear)
    KSP, intent(in) :: linear !! prepared by `use_factors`
    PetscErrorCode :: ierr

    PetscCallA(KSPSetType(linear, KSPGMRES, ierr))
    PetscCallA(KSPGMRESSetRestart(linear, int(longest_krylov, pint), ierr))
    PetscCallA(KSPSetTolerances(linear, krylov_tolerance, 0.0_wp, hopeless_krylov, int(longest_krylov, pint), ierr))
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
end module gfb_lagged_factors
