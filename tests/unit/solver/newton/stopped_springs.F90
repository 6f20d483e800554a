#include "gfb_petsc.h"
!> A chain of springs whose nodes touch hard stops: equations that are linear on pieces.
module stopped_springs
  use petscsnes
  use gfb_kinds, only: wp
  use gfb_petsc_kinds, only: pint
  use gfb_nonlinear_system, only: nonlinear_system_type, contact_name
  implicit none (type)
  private
  public :: create_springs, residual_size, destroy_springs

  integer, parameter :: nodes = 8
  real(wp), parameter :: hard = 1.0e6_wp !! stiffness of a stop over a spring's
  real(wp), parameter :: load(nodes) = [1.0_wp, -2.0_wp, 1.5_wp, 0.5_wp, -1.0_wp, 2.0_wp, -0.5_wp, 1.0_wp]
  real(wp), parameter :: gap(nodes) = [0.5_wp, -0.25_wp, 1.0_wp, 0.125_wp, 0.25_wp, 0.75_wp, -0.5_wp, 0.3_wp]

  !> Displacements of the nodes; a node that is farther than its gap presses on its stop.
  type, extends(nonlinear_system_type), public :: springs_type
    logical :: closed(nodes) = .false. !! along a step
    integer :: changing = 0
  contains
    procedure :: evaluate
    procedure :: linearise
    procedure :: begin_path
    procedure :: next_change
    procedure :: cross_change
  end type springs_type

contains

  !> The values of a vector.
  function values_of(vector) result(value)
    Vec, intent(in) :: vector
    real(wp) :: value(nodes)
    PetscScalar, pointer :: entry(:)
    PetscErrorCode :: ierr

    PetscCallA(GFB_VecGetArrayRead(vector, entry, ierr))
    value = entry(:nodes)
    PetscCallA(GFB_VecRestoreArrayRead(vector, entry, ierr))
  end function values_of

  !> Makes values a vector's.
  subroutine fill(vector, value)
    Vec, intent(in) :: vector
    real(wp), intent(in) :: value(:)
    PetscErrorCode :: ierr
    integer :: i

    do i = 1, nodes
      PetscCallA(VecSetValue(vector, int(i - 1, pint), value(i), INSERT_VALUES, ierr))
    end do
    PetscCallA(VecAssemblyBegin(vector, ierr))
    PetscCallA(VecAssemblyEnd(vector, ierr))
  end subroutine fill

  !> Stiffness of the chain, fixed at one end.
  pure function chain() result(stiffness)
    real(wp) :: stiffness(nodes, nodes)
    integer :: i

    stiffness = 0.0_wp
    do i = 1, nodes
      stiffness(i, i) = merge(2.0_wp, 1.0_wp, i < nodes)
    end do
    do i = 2, nodes
      stiffness(i, i - 1) = -1.0_wp
      stiffness(i - 1, i) = -1.0_wp
    end do
  end function chain

  !> Forces of springs and stops less the load.
  subroutine evaluate(self, state, residual, valid)
    class(springs_type), intent(inout) :: self
    Vec, intent(in) :: state, residual
    logical, intent(out) :: valid
    real(wp) :: x(nodes)

    x = values_of(state)
    valid = .true.
    call fill(residual, matmul(chain(), x) + hard*max(0.0_wp, x - gap) - load)
  end subroutine evaluate

  !> Their derivative.
  subroutine linearise(self, state)
    class(springs_type), intent(inout) :: self
    Vec, intent(in) :: state
    real(wp) :: stiffness(nodes, nodes), x(nodes)
    PetscErrorCode :: ierr
    integer :: i, k

    x = values_of(state)
    stiffness = chain()
    do i = 1, nodes
      if (x(i) >= gap(i)) stiffness(i, i) = stiffness(i, i) + hard
      do k = 1, nodes
        PetscCallA(MatSetValue(self%jacobian, int(i - 1, pint), int(k - 1, pint), stiffness(i, k), INSERT_VALUES, ierr))
      end do
    end do
    PetscCallA(MatAssemblyBegin(self%jacobian, MAT_FINAL_ASSEMBLY, ierr))
    PetscCallA(MatAssemblyEnd(self%jacobian, MAT_FINAL_ASSEMBLY, ierr))
  end subroutine linearise

  !> Stops are as they are at the present state.
  subroutine begin_path(self, can)
    class(springs_type), intent(inout) :: self
    logical, intent(out) :: can

    can = .true.
    self%closed = values_of(self%state) >= gap
  end subroutine begin_path

  !> The first stop that a node reaches or leaves.
  subroutine next_change(self, state, step, share, name)
    class(springs_type), intent(inout) :: self
    Vec, intent(in) :: state, step
    real(wp), intent(out) :: share
    integer, intent(out) :: name(contact_name)
    real(wp) :: x(nodes), change(nodes)
    integer :: i

    x = values_of(state)
    change = -values_of(step)
    share = huge(share)
    self%changing = 0
    do i = 1, nodes
      if (self%closed(i) .eqv. change(i) >= 0.0_wp) cycle
      if ((gap(i) - x(i))/change(i) >= share) cycle
      share = max(0.0_wp, (gap(i) - x(i))/change(i))
      self%changing = i
    end do
    name = self%changing
  end subroutine next_change

  !> That stop's stiffness comes or goes.
  subroutine cross_change(self, column, row)
    class(springs_type), intent(inout) :: self
    Vec, intent(in) :: column, row
    real(wp) :: unit(nodes)

    unit = 0.0_wp
    unit(self%changing) = 1.0_wp
    self%closed(self%changing) = .not. self%closed(self%changing)
    call fill(column, merge(hard, -hard, self%closed(self%changing))*unit)
    call fill(row, unit)
  end subroutine cross_change

  !> The chain with some nodes on their stops, a solver with its factors, and Newton's step.
  subroutine create_springs(springs, snes, step)
    type(springs_type), intent(out) :: springs
    SNES, intent(out) :: snes
    Vec, intent(out) :: step
    KSP :: linear
    PC :: factors
    Vec :: residual
    PetscErrorCode :: ierr
    logical :: valid
    integer :: i

    PetscCallA(VecCreateSeq(PETSC_COMM_SELF, int(nodes, pint), springs%state, ierr))
    call fill(springs%state, [(merge(gap(i) + 1.0e-3_wp, 0.0_wp, modulo(i, 3) == 0), i=1, nodes)])
    PetscCallA(MatCreateSeqAIJ(PETSC_COMM_SELF, int(nodes, pint), int(nodes, pint), int(nodes, pint), PETSC_NULL_INTEGER_ARRAY, springs%jacobian, ierr))
    call springs%linearise(springs%state)
    PetscCallA(SNESCreate(PETSC_COMM_SELF, snes, ierr))
    PetscCallA(SNESGetKSP(snes, linear, ierr))
    PetscCallA(KSPSetOperators(linear, springs%jacobian, springs%jacobian, ierr))
    PetscCallA(KSPSetType(linear, KSPPREONLY, ierr))
    PetscCallA(KSPGetPC(linear, factors, ierr))
    PetscCallA(PCSetType(factors, PCLU, ierr))
    PetscCallA(VecDuplicate(springs%state, residual, ierr))
    PetscCallA(VecDuplicate(springs%state, step, ierr))
    call springs%evaluate(springs%state, residual, valid)
    PetscCallA(KSPSolve(linear, residual, step, ierr))
    PetscCallA(VecDestroy(residual, ierr))
  end subroutine create_springs

  !> Norm of the residual at a state.
  function residual_size(springs, state) result(size)
    type(springs_type), intent(inout) :: springs
    Vec, intent(in) :: state
    real(wp) :: size
    PetscReal :: norm
    Vec :: residual
    PetscErrorCode :: ierr
    logical :: valid

    PetscCallA(VecDuplicate(state, residual, ierr))
    call springs%evaluate(state, residual, valid)
    PetscCallA(VecNorm(residual, NORM_2, norm, ierr))
    PetscCallA(VecDestroy(residual, ierr))
    size = norm
  end function residual_size

  !> Frees what PETSc holds.
  subroutine destroy_springs(springs, snes, step)
    type(springs_type), intent(inout) :: springs
    SNES, intent(inout) :: snes
    Vec, intent(inout) :: step
    PetscErrorCode :: ierr

    PetscCallA(VecDestroy(step, ierr))
    PetscCallA(SNESDestroy(snes, ierr))
    PetscCallA(MatDestroy(springs%jacobian, ierr))
    PetscCallA(VecDestroy(springs%state, ierr))
  end subroutine destroy_springs
end module stopped_springs
