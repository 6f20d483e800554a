#include "gfb_petsc.h"
!> Static condensation of a substructure onto its retained unknowns.
!>
!> $$ \tilde{K} = K_{BB} - K_{BI} K_{II}^{-1} K_{IB}, \qquad q_I = -K_{II}^{-1} K_{IB} q_B $$
!>
!> Source: [Gu2020] eqs. 3 to 6, [Guyan1965]. The substructure is kept as a MatSchurComplement whose
!> inner solver is an exact Cholesky factorization, made when interior displacements are asked for.
!> Its explicit matrix comes from MUMPS, and not from PETSc's own explicit operator, which drops
!> entries below 1e-10. Any symmetric positive definite stiffness with any retained unknowns will
!> do.
module gfb_super_element
  use petscksp
  use gfb_kinds, only: wp
  use gfb_petsc_kinds, only: pint
  implicit none (type)
  private
  public :: condense, hold_blocks, form_explicitly, destroy_super_element

  !> A condensed substructure.
  type, public :: super_element_type
    integer, allocatable :: retained(:)       !! unknowns kept, numbers in the substructure
    integer, allocatable :: interior(:)       !! unknowns condensed
    real(wp), allocatable :: stiffness(:, :)  !! (retained, retained)
    logical, private :: created = .false.
    Mat, private :: block_ii, block_ib, block_bi, block_bb
    Mat :: schur                              !! the complement as PETSc keeps it
  contains
    procedure, non_overridable :: recover, condense_force, constraint_modes, interior_stiffness
  end type super_element_type

contains

  !> The condensed stiffness, unknowns in the order of the retained ones.
  subroutine form_schur_complement(stiffness, is_retained, condensed)
    Mat, intent(in) :: stiffness                        !! of a substructure, on this rank alone
    logical, intent(in) :: is_retained(:)               !! one an unknown
    real(wp), allocatable, intent(out) :: condensed(:, :) !! (retained, retained) stiffness [SI]

    IS :: retained
    KSP :: solver
    PC :: factors
    Mat :: unit_sized, factor, complement
    MatFactorSchurStatus :: status
    PetscScalar, pointer :: values(:, :)
    PetscReal :: norm
    PetscErrorCode :: ierr
    real(wp) :: unit
    integer :: i, j
    integer, allocatable :: kept(:)

    kept = pack([(i, i=1, size(is_retained))], is_retained)
    PetscCallA(ISCreateGeneral(PETSC_COMM_SELF, int(size(kept), pint), int(kept - 1, pint), PETSC_COPY_VALUES, retained, ierr))
    ! MUMPS takes pivots near 1e-20 for none, whatever the size of the rest. A power of two loses no digit.
    PetscCallA(MatNorm(stiffness, NORM_INFINITY, norm, ierr))
    unit = 2.0_wp**exponent(norm)
    PetscCallA(MatDuplicate(stiffness, MAT_COPY_VALUES, unit_sized, ierr))
    PetscCallA(MatScale(unit_sized, 1.0_wp/unit, ierr))
    PetscCallA(MatSetOption(unit_sized, MAT_SPD, PETSC_TRUE, ierr)) ! of the interior, all that is factored
    PetscCallA(KSPCreate(PETSC_COMM_SELF, solver, ierr))
    PetscCallA(KSPSetOperators(solver, unit_sized, unit_sized, ierr))
    PetscCallA(KSPSetType(solver, KSPPREONLY, ierr))
    PetscCallA(KSPGetPC(solver, factors, ierr))
    PetscCallA(PCSetType(factors, PCCHOLESKY, ierr))
    PetscCallA(PCFactorSetMatSolverType(factors, MATSOLVERMUMPS, ierr))
    PetscCallA(PCFactorSetUpMatSolverType(factors, ierr))
    PetscCallA(PCFactorGetMatrix(factors, factor, ierr))
    PetscCallA(MatFactorSetSchurIS(factor, retained, ierr))
    PetscCallA(KSPSetUp(solver, ierr))
    PetscCallA(MatFactorGetSchurComplement(factor, complement, status, ierr))
    PetscCallA(GFB_MatDenseGetArray(complement, values, ierr))
    allocate (condensed(size(kept), size(kept)))
    do j = 1, size(kept)
      condensed(j:, j) = unit*values(j:, j) ! only the lower triangle is filled
      condensed(j, j + 1:) = unit*values(j + 1:, j)
    end do
    PetscCallA(GFB_MatDenseRestoreArray(complement, values, ierr))
    PetscCallA(MatFactorRestoreSchurComplement(factor, complement, status, ierr))
    PetscCallA(KSPDestroy(solver, ierr))
    PetscCallA(MatDestroy(unit_sized, ierr))
    PetscCallA(ISDestroy(retained, ierr))
  end subroutine form_schur_complement

  !> Condenses a sequential stiffness matrix.
  subroutine condense(stiffness, is_retained, prefix, super)
    Mat, intent(in) :: stiffness              !! of the substructure, on this rank alone
    logical, intent(in) :: is_retained(:)     !! one an unknown
    character(len=*), intent(in) :: prefix    !! of PETSc's options
    type(super_element_type), intent(out) :: super !! with its condensed matrix

    call hold_blocks(stiffness, is_retained, prefix, super)
    call form_explicitly(stiffness, is_retained, super)
  end subroutine condense

  !> Keeps what recovers interior displacements; nothing is factored until they are asked for.
  subroutine hold_blocks(stiffness, is_retained, prefix, super)
    Mat, intent(in) :: stiffness              !! of the substructure, on this rank alone
    logical, intent(in) :: is_retained(:)     !! one an unknown
    character(len=*), intent(in) :: prefix    !! of PETSc's options
    type(super_element_type), intent(out) :: super !! without its condensed matrix

    IS :: retained, interior
    PetscErrorCode :: ierr
    integer :: i

    super%retained = pack([(i, i=1, size(is_retained))], is_retained)
    super%interior = pack([(i, i=1, size(is_retained))], .not. is_retained)
    PetscCallA(ISCreateGeneral(PETSC_COMM_SELF, int(size(super%retained), pint), int(super%retained - 1, pint), PETSC_COPY_VALUES, retained, ierr))
    PetscCallA(ISCreateGeneral(PETSC_COMM_SELF, int(size(super%interior), pint), int(super%interior - 1, pint), PETSC_COPY_VALUES, interior, ierr))
    PetscCallA(MatCreateSubMatrix(stiffness, interior, interior, MAT_INITIAL_MATRIX, super%block_ii, ierr))
    PetscCallA(MatCreateSubMatrix(stiffness, interior, retained, MAT_INITIAL_MATRIX, super%block_ib, ierr))
    PetscCallA(MatCreateSubMatrix(stiffness, retained, interior, MAT_INITIAL_MATRIX, super%block_bi, ierr))
    PetscCallA(MatCreateSubMatrix(stiffness, retained, retained, MAT_INITIAL_MATRIX, super%block_bb, ierr))
    PetscCallA(ISDestroy(retained, ierr))
    PetscCallA(ISDestroy(interior, ierr))
    PetscCallA(MatSetOption(super%block_ii, MAT_SPD, PETSC_TRUE, ierr))
    PetscCallA(MatCreateSchurComplement(super%block_ii, super%block_ii, super%block_ib, super%block_bi, super%block_bb, super%schur, ierr))
    super%created = .true.
    call set_inner_solver(super, prefix)
  end subroutine hold_blocks

  !> Makes the complement's inner solver exact.
  subroutine set_inner_solver(super, prefix)
    type(super_element_type), intent(in) :: super
    character(len=*), intent(in) :: prefix
    KSP :: inner
    PC :: factors
    PetscErrorCode :: ierr

    PetscCallA(MatSchurComplementGetKSP(super%schur, inner, ierr))
    PetscCallA(KSPSetOptionsPrefix(inner, prefix, ierr))
    PetscCallA(KSPSetType(inner, KSPPREONLY, ierr))
    PetscCallA(KSPGetPC(inner, factors, ierr))
    PetscCallA(PCSetType(factors, PCCHOLESKY, ierr))
    PetscCallA(PCFactorSetMatSolverType(factors, MATSOLVERMUMPS, ierr))
    PetscCallA(KSPSetFromOptions(inner, ierr))
  end subroutine set_inner_solver

  !> The complement as a dense matrix, symmetric to the last digit.
  subroutine form_explicitly(stiffness, is_retained, super)
    Mat, intent(in) :: stiffness          !! of the substructure
    logical, intent(in) :: is_retained(:) !! one an unknown
    type(super_element_type), intent(inout) :: super !! gets its condensed matrix
    Mat :: dense
    PetscScalar, pointer :: values(:, :)
    PetscErrorCode :: ierr

    if (size(super%interior) > 0) then
      call form_schur_complement(stiffness, is_retained, super%stiffness)
    else
      PetscCallA(MatConvert(super%block_bb, MATSEQDENSE, MAT_INITIAL_MATRIX, dense, ierr))
      PetscCallA(GFB_MatDenseGetArray(dense, values, ierr))
      super%stiffness = 0.5_wp*(values + transpose(values))
      PetscCallA(GFB_MatDenseRestoreArray(dense, values, ierr))
      PetscCallA(MatDestroy(dense, ierr))
    end if
  end subroutine form_explicitly

  !> Displacements of all unknowns of the substructure from those of the retained ones.
  subroutine recover(self, retained, all_unknowns)
    class(super_element_type), intent(in) :: self !! the super-element
    real(wp), intent(in) :: retained(:)      !! q_B [m], [rad]
    real(wp), intent(out) :: all_unknowns(:) !! of the substructure [m], [rad]

    KSP :: inner
    Vec :: boundary, force, moved
    PetscScalar, pointer :: values(:)
    PetscErrorCode :: ierr

    all_unknowns = 0.0_wp
    all_unknowns(self%retained) = retained
    if (size(self%interior) == 0) return
    PetscCallA(MatCreateVecs(self%block_ib, boundary, force, ierr))
    PetscCallA(VecDuplicate(force, moved, ierr))
    PetscCallA(GFB_VecGetArray(boundary, values, ierr))
    values = retained
    PetscCallA(GFB_VecRestoreArray(boundary, values, ierr))
    PetscCallA(MatMult(self%block_ib, boundary, force, ierr))
    PetscCallA(MatSchurComplementGetKSP(self%schur, inner, ierr))
    PetscCallA(KSPSolve(inner, force, moved, ierr))
    PetscCallA(GFB_VecGetArrayRead(moved, values, ierr))
    all_unknowns(self%interior) = -values
    PetscCallA(GFB_VecRestoreArrayRead(moved, values, ierr))
    PetscCallA(VecDestroy(moved, ierr))
    PetscCallA(VecDestroy(force, ierr))
    PetscCallA(VecDestroy(boundary, ierr))
  end subroutine recover

  !> Forces on all unknowns as forces on the retained ones, which do the same work in every motion that `recover` gives:
  !>
  !> $$ \tilde{f} = f_B - K_{BI} K_{II}^{-1} f_I $$
  function condense_force(self, force) result(condensed)
    class(super_element_type), intent(in) :: self !! the super-element
    real(wp), intent(in) :: force(:) !! one an unknown of the substructure [N], [N m]
    real(wp) :: condensed(size(self%retained)) ! [N], [N m]

    KSP :: inner
    Vec :: boundary, load, moved
    PetscScalar, pointer :: values(:)
    PetscErrorCode :: ierr

    condensed = force(self%retained)
    if (size(self%interior) == 0) return
    PetscCallA(MatCreateVecs(self%block_ib, boundary, load, ierr))
    PetscCallA(VecDuplicate(load, moved, ierr))
    PetscCallA(GFB_VecGetArray(load, values, ierr))
    values = force(self%interior)
    PetscCallA(GFB_VecRestoreArray(load, values, ierr))
    PetscCallA(MatSchurComplementGetKSP(self%schur, inner, ierr))
    PetscCallA(KSPSolve(inner, load, moved, ierr))
    PetscCallA(MatMult(self%block_bi, moved, boundary, ierr))
    PetscCallA(GFB_VecGetArrayRead(boundary, values, ierr))
    condensed = condensed - values
    PetscCallA(GFB_VecRestoreArrayRead(boundary, values, ierr))
    PetscCallA(VecDestroy(moved, ierr))
    PetscCallA(VecDestroy(load, ierr))
    PetscCallA(VecDestroy(boundary, ierr))
  end function condense_force

  !> Stiffness of the interior; a borrowed handle, not to be destroyed.
  subroutine interior_stiffness(self, matrix)
    class(super_element_type), intent(in) :: self !! the super-element
    Mat, intent(out) :: matrix !! K_II
    matrix = self%block_ii
  end subroutine interior_stiffness

  !> Interior displacements for a unit of each retained unknown, \( -K_{II}^{-1} K_{IB} \), [Gu2020]
  !> eq. 4.
  function constraint_modes(self) result(modes)
    class(super_element_type), intent(in) :: self !! the super-element
    real(wp) :: modes(size(self%interior), size(self%retained))
    KSP :: inner
    Mat :: coupling, solution
    PetscScalar, pointer :: values(:, :)
    PetscErrorCode :: ierr

    if (size(modes) == 0) return
    PetscCallA(MatSchurComplementGetKSP(self%schur, inner, ierr))
    PetscCallA(MatConvert(self%block_ib, MATSEQDENSE, MAT_INITIAL_MATRIX, coupling, ierr))
    PetscCallA(MatDuplicate(coupling, MAT_DO_NOT_COPY_VALUES, solution, ierr))
    PetscCallA(KSPMatSolve(inner, coupling, solution, ierr))
    PetscCallA(GFB_MatDenseGetArray(solution, values, ierr))
    modes = -values
    PetscCallA(GFB_MatDenseRestoreArray(solution, values, ierr))
    PetscCallA(MatDestroy(solution, ierr))
    PetscCallA(MatDestroy(coupling, ierr))
  end function constraint_modes

  !> Frees what PETSc holds; may be called twice.
  subroutine destroy_super_element(super)
    type(super_element_type), intent(inout) :: super !! its matrices are freed
    PetscErrorCode :: ierr

    if (.not. super%created) return
    PetscCallA(MatDestroy(super%schur, ierr))
    PetscCallA(MatDestroy(super%block_bb, ierr))
    PetscCallA(MatDestroy(super%block_bi, ierr))
    PetscCallA(MatDestroy(super%block_ib, ierr))
    PetscCallA(MatDestroy(super%block_ii, ierr))
    super%created = .false.
  end subroutine destroy_super_element
end module gfb_super_element
