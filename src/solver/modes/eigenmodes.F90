#include "gfb_petsc.h"
!> Lowest natural modes of a structure.
!>
!> $$ K \phi = \omega^2 M \phi, \qquad \phi_i^T M \phi_j = \delta_{ij} $$
!>
!> Lanczos' method on the shifted inverse \( (K + s M)^{-1} M \), which MUMPS factorizes once. A
!> positive s makes it definite for a structure that moves freely.
module gfb_eigenmodes
  use petscksp
  use gfb_kinds, only: wp
  use gfb_lanczos, only: find_largest
  implicit none (type)
  private
  public :: lowest_modes, factor_shifted, destroy_modes

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
  subroutine lowest_modes(stiffness, mass, shift, wanted, modes, known)
    Mat, intent(in) :: stiffness, mass  !! K and M
    real(wp), intent(in) :: shift       !! s, not negative [1/s2]
    integer, intent(in) :: wanted       !! modes asked for
    type(modes_type), intent(out) :: modes !! of unit modal mass, in rising order
    type(modes_type), intent(in), optional :: known !! motions without strain, of unit modal mass

    real(wp), allocatable :: inverse(:)
    Vec, allocatable :: shape(:)
    KSP :: solver
    PetscInt :: unknowns, columns
    PetscErrorCode :: ierr
    integer :: elastic

    modes%eigenvalue = [real(wp) ::]
    allocate (modes%shape(0))
    if (present(known)) call copy_modes(known, wanted, modes)
    PetscCallA(MatGetSize(stiffness, unknowns, columns, ierr))
    elastic = min(wanted, int(unknowns)) - size(modes%shape)
    if (elastic <= 0) return
    call factor_shifted(stiffness, mass, shift, 'modes_', solver)
    call find_largest(solver, mass, modes%shape, elastic, tolerance, inverse, shape)
    PetscCallA(KSPDestroy(solver, ierr))
    modes%eigenvalue = [modes%eigenvalue, 1.0_wp/inverse - shift]
    modes%shape = [modes%shape, shape]
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

  !> Factors of the stiffness with a shift.
  subroutine factor_shifted(stiffness, mass, shift, prefix, solver)
    Mat, intent(in) :: stiffness, mass !! K and M
    real(wp), intent(in) :: shift !! s, not negative [1/s2]
    character(len=*), intent(in) :: prefix !! of PETSc's options
    KSP, intent(out) :: solver !! of K + s M
    integer :: communicator
    Mat :: shifted
    PC :: factors
    PetscErrorCode :: ierr

    PetscCallA(PetscObjectGetComm(stiffness, communicator, ierr))
    PetscCallA(KSPCreate(communicator, solver, ierr))
    PetscCallA(KSPSetOptionsPrefix(solver, prefix, ierr))
    if (shift > 0.0_wp) then
      PetscCallA(MatDuplicate(stiffness, MAT_COPY_VALUES, shifted, ierr))
      PetscCallA(MatAXPY(shifted, shift, mass, UNKNOWN_NONZERO_PATTERN, ierr))
      PetscCallA(KSPSetOperators(solver, shifted, shifted, ierr))
      PetscCallA(MatDestroy(shifted, ierr)) ! the solver holds it
    else
      PetscCallA(KSPSetOperators(solver, stiffness, stiffness, ierr))
    end if
    PetscCallA(KSPSetType(solver, KSPPREONLY, ierr))
    PetscCallA(KSPGetPC(solver, factors, ierr))
    PetscCallA(PCSetType(factors, PCCHOLESKY, ierr))
    PetscCallA(PCFactorSetMatSolverType(factors, MATSOLVERMUMPS, ierr))
    PetscCallA(KSPSetFromOptions(solver, ierr))
  end subroutine factor_shifted

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
