#include "gfb_petsc.h"
!> Craig-Bampton matrices of a strip's super-elements, for a dynamic extension.
!>
!> $$ T = \begin{bmatrix} I & 0 \\ -K_{II}^{-1} K_{IB} & \Phi \end{bmatrix}, \qquad
!>    \hat{K} = T^T K T, \quad \hat{M} = T^T M T $$
!>
!> with the fixed-interface modes \( \Phi \) of the interior. Source: [CraigBampton1968]. Without
!> modes it is Guyan's reduction.
module gfb_craig_bampton
  use petscmat
  use gfb_kinds, only: wp
  use gfb_errors, only: error_type
  use gfb_petsc_kinds, only: pint
  use gfb_shell_geometry, only: node_unknowns
  use gfb_substructures, only: substructure_type, kind_count
  use gfb_foil_structure, only: foil_structure_type
  use gfb_foil_pieces, only: assemble_piece, retained_in_piece, add_symmetric_block
  use gfb_super_element, only: super_element_type, condense, destroy_super_element
  use gfb_eigenmodes, only: modes_type, lowest_modes, destroy_modes
  implicit none (type)
  private
  public :: craig_bampton, assembled_eigenvalues

  !> One kind of super-element with its modes. Unknowns: the retained ones, then the modes.
  type, public :: craig_bampton_type
    real(wp), allocatable :: stiffness(:, :)
    real(wp), allocatable :: mass(:, :)
    real(wp), allocatable :: eigenvalue(:) !! of the fixed-interface modes [1/s2]
  end type craig_bampton_type

contains

  !> Matrices of every kind of super-element of a foil, on this rank alone.
  !>
  !> Fails where an element is clockwise or degenerate.
  subroutine craig_bampton(foil, modes_kept, kinds, error)
    type(foil_structure_type), intent(in) :: foil
    integer, intent(in) :: modes_kept !! fixed-interface modes of every super-element
    type(craig_bampton_type), allocatable, intent(out) :: kinds(:)
    type(error_type), allocatable, intent(out) :: error
    integer :: i

    allocate (kinds(kind_count(foil%substructure)))
    do i = 1, size(foil%substructure)
      associate (piece => foil%substructure(i))
        if (allocated(kinds(piece%kind)%mass)) cycle
        call reduce_piece(foil, piece, modes_kept, kinds(piece%kind), error)
        if (allocated(error)) return
      end associate
    end do
  end subroutine craig_bampton

  !> Matrices of one substructure.
  subroutine reduce_piece(foil, piece, modes_kept, reduced, error)
    type(foil_structure_type), intent(in) :: foil
    type(substructure_type), intent(in) :: piece
    integer, intent(in) :: modes_kept
    type(craig_bampton_type), intent(out) :: reduced
    type(error_type), allocatable, intent(out) :: error

    type(super_element_type) :: super
    type(modes_type) :: modes
    real(wp), allocatable :: basis(:, :)
    Mat :: stiffness, mass
    PetscErrorCode :: ierr
    integer :: i, kept

    call assemble_piece(foil%mesh, foil%section, foil%free(:, piece%nodes), piece, .false., stiffness, error)
    if (allocated(error)) return
    call assemble_piece(foil%mesh, foil%section, foil%free(:, piece%nodes), piece, .true., mass, error)
    if (allocated(error)) return
    call condense(stiffness, retained_in_piece(foil%free(:, piece%nodes), piece), 'super_', super)
    call interior_modes(super, mass, modes_kept, modes)
    kept = size(super%retained)
    allocate (basis(kept + size(super%interior), kept + size(modes%eigenvalue)), source=0.0_wp)
    do i = 1, kept
      basis(super%retained(i), i) = 1.0_wp
    end do
    basis(super%interior, :kept) = super%constraint_modes()
    do i = 1, size(modes%eigenvalue)
      basis(super%interior, kept + i) = values_of(modes%shape(i))
    end do
    reduced%eigenvalue = modes%eigenvalue
    reduced%mass = congruent(mass, basis)
    allocate (reduced%stiffness(size(basis, 2), size(basis, 2)), source=0.0_wp)
    reduced%stiffness(:kept, :kept) = super%stiffness
    do i = 1, size(modes%eigenvalue)
      reduced%stiffness(kept + i, kept + i) = modes%eigenvalue(i)
    end do
    call destroy_modes(modes)
    call destroy_super_element(super)
    PetscCallA(MatDestroy(stiffness, ierr))
    PetscCallA(MatDestroy(mass, ierr))
  end subroutine reduce_piece

  !> Modes of the interior with all retained unknowns held.
  subroutine interior_modes(super, mass, wanted, modes)
    type(super_element_type), intent(in) :: super
    Mat, intent(in) :: mass
    integer, intent(in) :: wanted
    type(modes_type), intent(out) :: modes
    IS :: interior
    Mat :: interior_mass, interior_stiffness
    PetscErrorCode :: ierr

    if (wanted == 0 .or. size(super%interior) == 0) then
      allocate (modes%eigenvalue(0), modes%shape(0))
      return
    end if
    PetscCallA(ISCreateGeneral(PETSC_COMM_SELF, int(size(super%interior), pint), int(super%interior - 1, pint), PETSC_COPY_VALUES, interior, ierr))
    PetscCallA(MatCreateSubMatrix(mass, interior, interior, MAT_INITIAL_MATRIX, interior_mass, ierr))
    call super%interior_stiffness(interior_stiffness)
    call lowest_modes(PETSC_COMM_SELF, interior_stiffness, interior_mass, 0.0_wp, wanted, modes)
    PetscCallA(MatDestroy(interior_mass, ierr))
    PetscCallA(ISDestroy(interior, ierr))
  end subroutine interior_modes

  !> \( T^T M T \), symmetric to the last digit.
  function congruent(matrix, basis) result(product)
    Mat, intent(in) :: matrix
    real(wp), intent(in) :: basis(:, :) !! T
    real(wp) :: product(size(basis, 2), size(basis, 2))
    Mat :: dense, moved
    PetscScalar, pointer :: values(:, :)
    PetscErrorCode :: ierr

    PetscCallA(MatCreateSeqDense(PETSC_COMM_SELF, int(size(basis, 1), pint), int(size(basis, 2), pint), PETSC_NULL_SCALAR_ARRAY, dense, ierr))
    PetscCallA(GFB_MatDenseGetArray(dense, values, ierr))
    values = basis
    PetscCallA(GFB_MatDenseRestoreArray(dense, values, ierr))
    PetscCallA(MatMatMult(matrix, dense, MAT_INITIAL_MATRIX, 1.0_wp, moved, ierr))
    PetscCallA(MatDestroy(dense, ierr))
    PetscCallA(GFB_MatDenseGetArray(moved, values, ierr))
    product = matmul(transpose(basis), values)
    PetscCallA(GFB_MatDenseRestoreArray(moved, values, ierr))
    PetscCallA(MatDestroy(moved, ierr))
    product = 0.5_wp*(product + transpose(product))
  end function congruent

  !> Lowest eigenvalues of the strip put together from its super-elements, on this rank alone
  !> [1/s2].
  function assembled_eigenvalues(foil, kinds, shift, wanted) result(eigenvalue)
    type(foil_structure_type), intent(in) :: foil
    type(craig_bampton_type), intent(in) :: kinds(:)
    real(wp), intent(in) :: shift !! [1/s2]
    integer, intent(in) :: wanted
    real(wp), allocatable :: eigenvalue(:)

    type(modes_type) :: modes
    Mat :: stiffness, mass
    integer, allocatable :: number(:, :), list(:)
    PetscErrorCode :: ierr
    integer :: i, unknowns, entries, k

    call number_retained(foil, number, unknowns)
    entries = 0
    do i = 1, size(kinds)
      entries = max(entries, size(kinds(i)%mass, 1))
    end do
    k = unknowns
    do i = 1, size(foil%substructure)
      k = k + size(kinds(foil%substructure(i)%kind)%eigenvalue)
    end do
    PetscCallA(MatCreateSeqAIJ(PETSC_COMM_SELF, int(k, pint), int(k, pint), int(min(k, 2*entries), pint), PETSC_NULL_INTEGER_ARRAY, stiffness, ierr))
    PetscCallA(MatCreateSeqAIJ(PETSC_COMM_SELF, int(k, pint), int(k, pint), int(min(k, 2*entries), pint), PETSC_NULL_INTEGER_ARRAY, mass, ierr))
    do i = 1, size(foil%substructure)
      associate (piece => foil%substructure(i), kind => kinds(foil%substructure(i)%kind))
        list = [reshape(number(:, pack(piece%nodes, piece%retained)), [node_unknowns*count(piece%retained)]) - 1, &
                [(unknowns + k - 1, k=1, size(kind%eigenvalue))]]
        unknowns = unknowns + size(kind%eigenvalue)
        call add_symmetric_block(stiffness, list, kind%stiffness)
        call add_symmetric_block(mass, list, kind%mass)
      end associate
    end do
    PetscCallA(MatAssemblyBegin(stiffness, MAT_FINAL_ASSEMBLY, ierr))
    PetscCallA(MatAssemblyEnd(stiffness, MAT_FINAL_ASSEMBLY, ierr))
    PetscCallA(MatAssemblyBegin(mass, MAT_FINAL_ASSEMBLY, ierr))
    PetscCallA(MatAssemblyEnd(mass, MAT_FINAL_ASSEMBLY, ierr))
    call lowest_modes(PETSC_COMM_SELF, stiffness, mass, shift, wanted, modes)
    eigenvalue = modes%eigenvalue
    call destroy_modes(modes)
    PetscCallA(MatDestroy(stiffness, ierr))
    PetscCallA(MatDestroy(mass, ierr))
  end function assembled_eigenvalues

  !> Numbers, from 1, of the free unknowns of retained nodes; 0 elsewhere.
  pure subroutine number_retained(foil, number, unknowns)
    type(foil_structure_type), intent(in) :: foil
    integer, allocatable, intent(out) :: number(:, :) !! (5, nodes)
    integer, intent(out) :: unknowns
    logical :: kept(size(foil%mesh%position, 2))
    integer :: i, node, component

    kept = .false.
    do i = 1, size(foil%substructure)
      kept(pack(foil%substructure(i)%nodes, foil%substructure(i)%retained)) = .true.
    end do
    allocate (number(node_unknowns, size(kept)), source=0)
    unknowns = 0
    do node = 1, size(kept)
      do component = 1, node_unknowns
        if (.not. (kept(node) .and. foil%free(component, node))) cycle
        unknowns = unknowns + 1
        number(component, node) = unknowns
      end do
    end do
  end subroutine number_retained

  !> Entries of a sequential vector.
  function values_of(vector) result(list)
    Vec, intent(in) :: vector
    real(wp), allocatable :: list(:)
    PetscScalar, pointer :: values(:)
    PetscErrorCode :: ierr

    PetscCallA(GFB_VecGetArrayRead(vector, values, ierr))
    list = values
    PetscCallA(GFB_VecRestoreArrayRead(vector, values, ierr))
  end function values_of
end module gfb_craig_bampton
