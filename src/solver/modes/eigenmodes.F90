#include "gfb_petsc.h"
!> Lowest natural modes of a structure, by SLEPc.
!>
!> $$ K \phi = \omega^2 M \phi, \qquad \phi_i^T M \phi_j = \delta_{ij} $$
!>
!> Krylov-Schur on the shifted inverse \( (K + s M)^{-1} M \), which MUMPS factorizes once. A
!> positive s makes it definite for a structure that moves freely.
module gfb_eigenmodes
  use slepceps
  use gfb_kinds, only: wp
  use gfb_petsc_kinds, only: pint
  implicit none (type)
  private
  public :: lowest_modes, destroy_modes

  real(wp), parameter :: tolerance = 1.0e-10_wp !! of the eigenvalues, relative [1]

  !> Modes in rising order.
  type, public :: modes_type
    Vec, allocatable, public :: shape(:)   !! normalised by the mass
    real(wp), allocatable :: eigenvalue(:) !! omega squared [1/s2]
  end type modes_type

contains

  !> The lowest modes; fewer where the structure or the iteration has no more.
  !>
  !> Motions without strain that are known are taken as they are, and come first; the iteration looks
  !> for what is at right angles to them.
  subroutine lowest_modes(communicator, stiffness, mass, shift, wanted, modes, known)
    integer, intent(in) :: communicator !! MPI's, of the matrices
    Mat, intent(in) :: stiffness, mass  !! K and M
    real(wp), intent(in) :: shift       !! s, not negative [1/s2]
    integer, intent(in) :: wanted       !! modes asked for
    type(modes_type), intent(out) :: modes !! of unit modal mass, in rising order
    type(modes_type), intent(in), optional :: known !! motions without strain, of unit modal mass

    type(modes_type) :: rigid
    EPS :: solver
    ST :: spectral
    KSP :: linear
    PC :: factors
    PetscInt :: found, unknowns, columns
    PetscScalar :: value, imaginary
    Vec :: unused
    PetscErrorCode :: ierr
    integer :: i, first

    rigid%eigenvalue = [real(wp) ::]
    allocate (rigid%shape(0))
    if (present(known)) call copy_modes(known, wanted, rigid)
    PetscCallA(MatGetSize(stiffness, unknowns, columns, ierr))
    unknowns = min(int(wanted, pint), unknowns) - size(rigid%shape, 1, pint)
    if (unknowns <= 0) then
      modes = rigid
      return
    end if
    PetscCallA(EPSCreate(communicator, solver, ierr))
    PetscCallA(EPSSetOptionsPrefix(solver, 'modes_', ierr))
    PetscCallA(EPSSetOperators(solver, stiffness, mass, ierr))
    PetscCallA(EPSSetProblemType(solver, EPS_GHEP, ierr))
    PetscCallA(EPSSetWhichEigenpairs(solver, EPS_TARGET_MAGNITUDE, ierr))
    PetscCallA(EPSSetTarget(solver, -shift, ierr))
    PetscCallA(EPSSetDimensions(solver, unknowns, PETSC_DEFAULT_INTEGER, PETSC_DEFAULT_INTEGER, ierr))
    PetscCallA(EPSSetTolerances(solver, tolerance, PETSC_DEFAULT_INTEGER, ierr))
    if (size(rigid%shape) > 0) then
      PetscCallA(EPSSetDeflationSpace(solver, size(rigid%shape, 1, pint), rigid%shape, ierr))
    end if
    PetscCallA(EPSGetST(solver, spectral, ierr))
    PetscCallA(STSetType(spectral, STSINVERT, ierr))
    PetscCallA(STGetKSP(spectral, linear, ierr))
    PetscCallA(KSPSetType(linear, KSPPREONLY, ierr))
    PetscCallA(KSPGetPC(linear, factors, ierr))
    PetscCallA(PCSetType(factors, PCCHOLESKY, ierr))
    PetscCallA(PCFactorSetMatSolverType(factors, MATSOLVERMUMPS, ierr))
    PetscCallA(EPSSetFromOptions(solver, ierr))
    PetscCallA(EPSSolve(solver, ierr))
    PetscCallA(EPSGetConverged(solver, found, ierr))
    found = min(found, unknowns)
    first = size(rigid%shape)
    allocate (modes%eigenvalue(first + found), modes%shape(first + found))
    modes%eigenvalue(:first) = rigid%eigenvalue
    modes%shape(:first) = rigid%shape
    PetscCallA(MatCreateVecs(stiffness, unused, PETSC_NULL_VEC, ierr))
    do i = 1, int(found)
      PetscCallA(MatCreateVecs(stiffness, modes%shape(first + i), PETSC_NULL_VEC, ierr))
      PetscCallA(EPSGetEigenpair(solver, int(i - 1, pint), value, imaginary, modes%shape(first + i), unused, ierr))
      modes%eigenvalue(first + i) = real(value, wp)
    end do
    PetscCallA(VecDestroy(unused, ierr))
    PetscCallA(EPSDestroy(solver, ierr))
    call normalise(mass, modes)
  end subroutine lowest_modes

  !> Copies of the first modes.
  subroutine copy_modes(modes, wanted, copies)
    type(modes_type), intent(in) :: modes
    integer, intent(in) :: wanted !! of them at most
    type(modes_type), intent(out) :: copies
    PetscErrorCode :: ierr
    integer :: i

    copies%eigenvalue = modes%eigenvalue(:min(wanted, size(modes%eigenvalue)))
    allocate (copies%shape(size(copies%eigenvalue)))
    do i = 1, size(copies%shape)
      PetscCallA(VecDuplicate(modes%shape(i), copies%shape(i), ierr))
      PetscCallA(VecCopy(modes%shape(i), copies%shape(i), ierr))
    end do
  end subroutine copy_modes

  !> Makes the modal masses one.
  subroutine normalise(mass, modes)
    Mat, intent(in) :: mass
    type(modes_type), intent(inout) :: modes
    Vec :: momentum
    PetscScalar :: modal_mass
    PetscErrorCode :: ierr
    integer :: i

    do i = 1, size(modes%shape)
      PetscCallA(VecDuplicate(modes%shape(i), momentum, ierr))
      PetscCallA(MatMult(mass, modes%shape(i), momentum, ierr))
      PetscCallA(VecDot(modes%shape(i), momentum, modal_mass, ierr))
      PetscCallA(VecScale(modes%shape(i), 1.0_wp/sqrt(modal_mass), ierr))
      PetscCallA(VecDestroy(momentum, ierr))
    end do
  end subroutine normalise

  !> Frees what PETSc holds; may be called twice.
  subroutine destroy_modes(modes)
    type(modes_type), intent(inout) :: modes !! are freed
    PetscErrorCode :: ierr
    integer :: i

    if (.not. allocated(modes%shape)) return
    do i = 1, size(modes%shape)
      PetscCallA(VecDestroy(modes%shape(i), ierr))
    end do
    deallocate (modes%shape)
  end subroutine destroy_modes
end module gfb_eigenmodes
