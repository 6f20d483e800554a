#include "gfb_petsc.h"
!> How patches of a foil move as rigid bodies: the coarse space of a multigrid method.
!>
!> What is soft in a thin shell is nearly rigid in the small. So few unknowns a patch, three
!> displacements and three rotations, catch what no smoother reaches.
module gfb_rigid_modes
  use petscmat
  use gfb_kinds, only: wp
  use gfb_petsc_kinds, only: pint
  use gfb_foil_structure, only: foil_structure_type
  use gfb_quad_mesh, only: quad_mesh_type
  use gfb_shell_geometry, only: node_unknowns
  use gfb_node_patches, only: cut_into_patches
  implicit none (type)
  private
  public :: find_patches, create_motions, node_motions

  integer, parameter :: space = 3
  integer, parameter :: modes = 2*space
  integer, parameter, public :: rigid_motion_count = modes !! of a body
  integer, parameter :: patch_nodes = 36       !! of a patch at most: 180 unknowns become six
  integer, parameter :: least_patch_nodes = 3  !! of a patch where a foil is to have many
  real(wp), parameter :: dependent = 1.0e-6_wp !! what is left of a mode that others make up, relative
  integer, parameter :: power_steps = 12       !! for the largest eigenvalue, which need not be exact
  real(wp), parameter :: damping = 4.0_wp/3.0_wp !! of Jacobi's step over the inverse of that eigenvalue

  !> What a patch can do.
  type, public :: patch_type
    integer(pint), allocatable, private :: row(:) !! its unknowns' numbers in the whole, from 0
    real(wp), allocatable, private :: mode(:, :) !! (unknowns, motions) orthonormal
  end type patch_type

contains

  !> The patches of one foil's nodes on this rank, and how they move; a patch lies on one rank.
  subroutine find_patches(foil, row, unit, wanted, patch)
    type(foil_structure_type), intent(in) :: foil !! of shells
    integer(pint), intent(in) :: row(:) !! number, from 0, of each unknown of the foil that this rank owns, in what is to be moved
    real(wp), intent(in) :: unit(:)     !! one scaled unknown of them is so much [m] or [1]
    integer, intent(in) :: wanted !! patches of the foil at least, while they are not smaller than they may be
    type(patch_type), allocatable, intent(out) :: patch(:) !! this rank's
    integer, allocatable :: owned(:), number(:), member(:), start(:), node(:), own(:)
    real(wp), allocatable :: mode(:, :)
    integer :: i, patches, most

    most = max(least_patch_nodes, min(patch_nodes, foil%mesh%nodes()/wanted))
    owned = pack([(i, i=1, size(foil%part%mesh_node))], foil%part%owned)
    call cut_into_patches(foil%mesh%position(:, foil%part%mesh_node(owned)), most, number, patches)
    call list_members(number, patches, member, start)
    allocate (patch(patches))
    do i = 1, patches
      node = foil%part%mesh_node(owned(member(start(i):start(i + 1) - 1)))
      call rigid_motions(foil, node, own, mode)
      mode = mode/spread(unit(own), 2, modes)
      call orthonormalise(mode, patch(i)%mode)
      patch(i)%row = row(own)
    end do
  end subroutine find_patches

  !> The matrix that takes motions of patches to unknowns: rigid ones, smoothed. Unknowns that no patch moves, such as a
  !> plate's, move on their own.
  subroutine create_motions(patch, stiffness, motions)
    type(patch_type), intent(in) :: patch(:) !! this rank's
    Mat, intent(in) :: stiffness !! scaled
    Mat, intent(out) :: motions  !! (unknowns, motions)
    PetscInt, allocatable :: column(:)
    PetscInt :: first, last, before
    PetscErrorCode :: ierr
    logical, allocatable :: moved(:)
    integer :: i, k

    PetscCallA(MatGetOwnershipRange(stiffness, first, last, ierr))
    allocate (moved(first:last - 1), source=.false.)
    do i = 1, size(patch)
      moved(patch(i)%row) = .true.
    end do
    PetscCallA(MatCreate(PETSC_COMM_WORLD, motions, ierr))
    PetscCallA(MatSetSizes(motions, last - first, int(sum([(size(patch(i)%mode, 2), i=1, size(patch))]) + count(.not. moved), pint), PETSC_DETERMINE, PETSC_DETERMINE, ierr))
    PetscCallA(MatSetType(motions, MATAIJ, ierr))
    PetscCallA(MatSeqAIJSetPreallocation(motions, int(modes, pint), PETSC_NULL_INTEGER_ARRAY, ierr))
    PetscCallA(MatMPIAIJSetPreallocation(motions, int(modes, pint), PETSC_NULL_INTEGER_ARRAY, 0_pint, PETSC_NULL_INTEGER_ARRAY, ierr))
    PetscCallA(MatGetOwnershipRangeColumn(motions, before, last, ierr))
    do i = 1, size(patch)
      associate (mode => patch(i)%mode)
        column = [(before + int(k - 1, pint), k=1, size(mode, 2))]
        before = before + size(mode, 2, pint)
        ! PETSc reads a block row by row.
        PetscCallA(MatSetValues(motions, size(mode, 1, pint), patch(i)%row, size(column, 1, pint), column, reshape(transpose(mode), [size(mode)]), INSERT_VALUES, ierr))
      end associate
    end do
    do i = lbound(moved, 1), ubound(moved, 1)
      if (moved(i)) cycle
      PetscCallA(MatSetValue(motions, int(i, pint), before, 1.0_wp, INSERT_VALUES, ierr))
      before = before + 1
    end do
    PetscCallA(MatAssemblyBegin(motions, MAT_FINAL_ASSEMBLY, ierr))
    PetscCallA(MatAssemblyEnd(motions, MAT_FINAL_ASSEMBLY, ierr))
    call smooth_motions(stiffness, motions)
  end subroutine create_motions

  !> The members of each patch, one patch after the other.
  pure subroutine list_members(number, patches, member, start)
    integer, intent(in) :: number(:) !! of each one's patch
    integer, intent(in) :: patches
    integer, allocatable, intent(out) :: member(:)
    integer, allocatable, intent(out) :: start(:) !! (patches + 1) number of its first in `member`
    integer :: next(patches), i

    allocate (member(size(number)), start(patches + 1), source=0)
    do i = 1, size(number)
      start(number(i) + 1) = start(number(i) + 1) + 1
    end do
    start(1) = 1
    do i = 1, patches
      start(i + 1) = start(i) + start(i + 1)
    end do
    next = start(:patches)
    do i = 1, size(number)
      member(next(number(i))) = i
      next(number(i)) = next(number(i)) + 1
    end do
  end subroutine list_members

  !> Rigid motions of some nodes in their unknowns: three displacements, three rotations about their
  !> middle.
  pure subroutine rigid_motions(foil, node, row, mode)
    type(foil_structure_type), intent(in) :: foil
    integer, intent(in) :: node(:) !! of the whole mesh
    integer, allocatable, intent(out) :: row(:)       !! their unknowns among those that this rank owns, from 1
    real(wp), allocatable, intent(out) :: mode(:, :)  !! (unknowns, 6) [m] or [1]
    real(wp) :: middle(space), motion(node_unknowns, modes)
    integer :: i, component, found

    allocate (row(node_unknowns*size(node)), mode(node_unknowns*size(node), modes))
    associate (mesh => foil%mesh)
      middle = sum(mesh%position(:, node), 2)/size(node)
      found = 0
      do i = 1, size(node)
        motion = node_motions(mesh, node(i), middle)
        do component = 1, node_unknowns
          if (foil%unknown(component, node(i)) < 0) cycle
          found = found + 1
          row(found) = foil%unknown(component, node(i)) - foil%first + 1
          mode(found, :) = motion(component, :)
        end do
      end do
    end associate
    row = row(:found)
    mode = mode(:found, :)
  end subroutine rigid_motions

  !> Rigid motions of a node: three displacements, three rotations about a point.
  pure function node_motions(mesh, node, middle) result(motion)
    type(quad_mesh_type), intent(in) :: mesh !! of the foil
    integer, intent(in) :: node !! number in the whole mesh
    real(wp), intent(in) :: middle(space)    !! the point [m]
    real(wp) :: motion(node_unknowns, modes) !! [1], [m]; of the node's rotations [1/m], [1]
    real(wp) :: arm(space)
    integer :: component

    arm = mesh%position(:, node) - middle
    motion = 0.0_wp
    do component = 1, space
      motion(component, component) = 1.0_wp
    end do
    motion(:space, space + 1) = [0.0_wp, -arm(3), arm(2)]
    motion(:space, space + 2) = [arm(3), 0.0_wp, -arm(1)]
    motion(:space, space + 3) = [-arm(2), arm(1), 0.0_wp]
    motion(space + 1, space + 1:) = mesh%axis_1(:, node)
    motion(space + 2, space + 1:) = mesh%axis_2(:, node)
  end function node_motions

  !> Orthonormal columns that span the same, by Gram and Schmidt, twice; dependent ones are left out.
  pure subroutine orthonormalise(column, basis)
    real(wp), intent(in) :: column(:, :)
    real(wp), allocatable, intent(out) :: basis(:, :)
    real(wp) :: vector(size(column, 1)), found(size(column, 1), size(column, 2))
    integer :: i, k, pass, kept

    kept = 0
    do i = 1, size(column, 2)
      vector = column(:, i)
      do pass = 1, 2
        do k = 1, kept
          vector = vector - dot_product(found(:, k), vector)*found(:, k)
        end do
      end do
      if (.not. norm2(vector) > dependent*norm2(column(:, i))) cycle
      kept = kept + 1
      found(:, kept) = vector/norm2(vector)
    end do
    basis = found(:, :kept)
  end subroutine orthonormalise
  !> Smooths the columns of a coarse space by a step of Jacobi's method, so that neighbouring patches
  !> do not tear.
  subroutine smooth_motions(matrix, motions)
    Mat, intent(in) :: matrix     !! stiffness, scaled
    Mat, intent(inout) :: motions !! (unknowns, motions)
    Mat :: smoothed
    Vec :: inverse
    PetscErrorCode :: ierr

    PetscCallA(MatCreateVecs(matrix, inverse, PETSC_NULL_VEC, ierr))
    PetscCallA(MatGetDiagonal(matrix, inverse, ierr))
    PetscCallA(VecReciprocal(inverse, ierr))
    PetscCallA(MatMatMult(matrix, motions, MAT_INITIAL_MATRIX, PETSC_DEFAULT_REAL, smoothed, ierr))
    PetscCallA(MatDiagonalScale(smoothed, inverse, PETSC_NULL_VEC, ierr))
    PetscCallA(MatAYPX(smoothed, -damping/largest_eigenvalue(matrix, inverse), motions, SUBSET_NONZERO_PATTERN, ierr))
    PetscCallA(MatDestroy(motions, ierr))
    motions = smoothed
    PetscCallA(VecDestroy(inverse, ierr))
  end subroutine smooth_motions

  !> Largest eigenvalue of a matrix whose rows are divided by its diagonal, from below.
  real(wp) function largest_eigenvalue(matrix, inverse) result(eigenvalue)
    Mat, intent(in) :: matrix
    Vec, intent(in) :: inverse !! of the diagonal

    Vec :: direction, image
    PetscScalar, pointer :: value(:)
    PetscReal :: norm
    PetscInt :: first, last
    integer :: step
    PetscErrorCode :: ierr

    PetscCallA(VecDuplicate(inverse, direction, ierr))
    PetscCallA(VecDuplicate(inverse, image, ierr))
    PetscCallA(VecGetOwnershipRange(direction, first, last, ierr))
    PetscCallA(GFB_VecGetArray(direction, value, ierr))
    value = some_pattern(int(first), size(value))
    PetscCallA(GFB_VecRestoreArray(direction, value, ierr))
    do step = 1, power_steps
      PetscCallA(VecNormalize(direction, norm, ierr))
      PetscCallA(MatMult(matrix, direction, image, ierr))
      PetscCallA(VecPointwiseMult(direction, image, inverse, ierr))
    end do
    PetscCallA(VecNorm(direction, NORM_2, norm, ierr))
    eigenvalue = norm
    PetscCallA(VecDestroy(direction, ierr))
    PetscCallA(VecDestroy(image, ierr))
  end function largest_eigenvalue

  !> Numbers that have a part of every mode.
  pure function some_pattern(before, numbers) result(pattern)
    integer, intent(in) :: before !! numbers on other ranks
    integer, intent(in) :: numbers
    real(wp) :: pattern(numbers)
    integer :: i
    pattern = [(1.0_wp + sin(real(7*(before + i), wp)), i=1, numbers)]
  end function some_pattern
end module gfb_rigid_modes
