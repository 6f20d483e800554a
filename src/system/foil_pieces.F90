#include "gfb_petsc.h"
!> Pieces of foils as matrices: elements, and substructures on their own.
module gfb_foil_pieces
  use petscksp
  use gfb_kinds, only: wp
  use gfb_errors, only: error_type
  use gfb_petsc_kinds, only: pint
  use gfb_shell_geometry, only: shell_geometry_type, shell_section_type, node_unknowns, &
                                shell_unknowns
  use gfb_shell_element, only: shell_stiffness
  use gfb_shell_mass, only: shell_mass
  use gfb_quad_mesh, only: quad_mesh_type
  use gfb_substructures, only: substructure_type
  use gfb_super_element, only: super_element_type, condense
  implicit none (type)
  private
  public :: number_slots, condense_piece, assemble_piece, retained_in_piece, piece_unknowns, &
            element_geometry, add_symmetric_block, create_foil_matrix

  integer, parameter, public :: element_row = 9*node_unknowns !! entries of a row: a node, its neighbours

contains

  !> Place of each free unknown of a kept node at its node, 0 for all others.
  pure subroutine number_slots(free, substructure, reduced, slot)
    logical, intent(in) :: free(:, :)                 !! (5, nodes) not held by a support
    type(substructure_type), intent(in) :: substructure(:)
    logical, intent(in) :: reduced                    !! only retained nodes are kept
    integer, allocatable, intent(out) :: slot(:, :)   !! (5, nodes)
    logical :: kept(size(free, 2))
    integer :: node, i, component, slots

    kept = .not. reduced
    if (reduced) then
      do i = 1, size(substructure)
        kept(pack(substructure(i)%nodes, substructure(i)%retained)) = .true.
      end do
    end if
    allocate (slot(node_unknowns, size(kept)), source=0)
    do node = 1, size(kept)
      if (.not. kept(node)) cycle
      slots = 0
      do component = 1, node_unknowns
        if (.not. free(component, node)) cycle
        slots = slots + 1
        slot(component, node) = slots
      end do
    end do
  end subroutine number_slots

  !> Assembles a substructure on its own and condenses it.
  subroutine condense_piece(mesh, section, free, substructure, super, error)
    type(quad_mesh_type), intent(in) :: mesh
    type(shell_section_type), intent(in) :: section
    logical, intent(in) :: free(:, :) !! (5, nodes) not held by a support
    type(substructure_type), intent(in) :: substructure
    type(super_element_type), intent(out) :: super
    type(error_type), allocatable, intent(out) :: error
    Mat :: stiffness
    PetscErrorCode :: ierr

    call assemble_piece(mesh, section, free, substructure, .false., stiffness, error)
    if (allocated(error)) return
    call condense(stiffness, retained_in_piece(free, substructure), 'super_', super)
    PetscCallA(MatDestroy(stiffness, ierr))
  end subroutine condense_piece

  !> Stiffness or mass of a substructure on this rank alone, all of its unknowns.
  !>
  !> Fails where an element is clockwise or degenerate.
  subroutine assemble_piece(mesh, section, free, substructure, mass, matrix, error)
    type(quad_mesh_type), intent(in) :: mesh
    type(shell_section_type), intent(in) :: section
    logical, intent(in) :: free(:, :) !! (5, nodes) not held by a support
    type(substructure_type), intent(in) :: substructure
    logical, intent(in) :: mass       !! instead of stiffness
    Mat, intent(out) :: matrix
    type(error_type), allocatable, intent(out) :: error

    integer, allocatable :: number(:, :)
    logical, allocatable :: has(:, :)
    real(wp) :: block(shell_unknowns, shell_unknowns)
    PetscErrorCode :: ierr
    integer :: i, component, unknowns

    unknowns = 0
    allocate (number(node_unknowns, size(mesh%position, 2)), source=0)
    has = piece_unknowns(free, substructure)
    do i = 1, size(substructure%nodes)
      do component = 1, node_unknowns
        if (.not. has(component, i)) cycle
        unknowns = unknowns + 1
        number(component, substructure%nodes(i)) = unknowns
      end do
    end do
    PetscCallA(MatCreateSeqAIJ(PETSC_COMM_SELF, int(unknowns, pint), int(unknowns, pint), int(element_row, pint), PETSC_NULL_INTEGER, matrix, ierr))
    do i = 1, size(substructure%elements)
      associate (nodes => mesh%element_nodes(:, substructure%elements(i)), &
                 geometry => element_geometry(mesh, substructure%elements(i)))
        if (mass) then
          call shell_mass(geometry, section, block, error)
        else
          call shell_stiffness(geometry, section, block, error)
        end if
        if (allocated(error)) return
        call add_symmetric_block(matrix, reshape(number(:, nodes), [shell_unknowns]) - 1, block)
      end associate
    end do
    PetscCallA(MatAssemblyBegin(matrix, MAT_FINAL_ASSEMBLY, ierr))
    PetscCallA(MatAssemblyEnd(matrix, MAT_FINAL_ASSEMBLY, ierr))
  end subroutine assemble_piece

  !> Which of a substructure's unknowns are kept.
  pure function retained_in_piece(free, substructure) result(is_retained)
    logical, intent(in) :: free(:, :) !! (5, nodes) not held by a support
    type(substructure_type), intent(in) :: substructure
    logical, allocatable :: is_retained(:)

    is_retained = pack(spread(substructure%retained, 1, node_unknowns), piece_unknowns(free, substructure))
  end function retained_in_piece

  !> Unknowns a super-element has, (5, nodes): all of its retained nodes, so that a support there
  !> does not make it another kind, and the free ones inside.
  pure function piece_unknowns(free, substructure) result(has)
    logical, intent(in) :: free(:, :) !! (5, nodes) not held by a support
    type(substructure_type), intent(in) :: substructure
    logical :: has(node_unknowns, size(substructure%nodes))

    has = free(:, substructure%nodes) .or. spread(substructure%retained, 1, node_unknowns)
  end function piece_unknowns

  !> Where an element of a mesh is.
  pure function element_geometry(mesh, element) result(geometry)
    type(quad_mesh_type), intent(in) :: mesh
    integer, intent(in) :: element
    type(shell_geometry_type) :: geometry

    associate (nodes => mesh%element_nodes(:, element))
      geometry%position = mesh%position(:, nodes)
      geometry%director = mesh%director(:, :, element)
      geometry%axis(:, 1, :) = mesh%axis_1(:, nodes)
      geometry%axis(:, 2, :) = mesh%axis_2(:, nodes)
    end associate
  end function element_geometry

  !> Adds a symmetric block by global numbers, from 0; negative ones are skipped.
  subroutine add_symmetric_block(matrix, number, block)
    Mat, intent(in) :: matrix
    integer, intent(in) :: number(:)
    real(wp), intent(in) :: block(size(number)*size(number))
    PetscInt :: index(size(number))
    PetscErrorCode :: ierr

    index = int(number, pint)
    PetscCallA(MatSetValues(matrix, int(size(index), pint), index, int(size(index), pint), index, block, ADD_VALUES, ierr))
  end subroutine add_symmetric_block

  !> An empty matrix over all ranks with room for what a row couples.
  subroutine create_foil_matrix(owned, unknowns, entries, matrix)
    PetscInt, intent(in) :: owned   !! unknowns of this rank
    integer, intent(in) :: unknowns !! of all ranks
    integer, intent(in) :: entries  !! of a row, at most
    Mat, intent(out) :: matrix
    PetscInt :: inside, outside
    PetscErrorCode :: ierr

    inside = min(int(entries, pint), owned)
    outside = min(int(entries, pint), int(unknowns, pint) - owned)
    PetscCallA(MatCreate(PETSC_COMM_WORLD, matrix, ierr))
    PetscCallA(MatSetSizes(matrix, owned, owned, PETSC_DETERMINE, PETSC_DETERMINE, ierr))
    PetscCallA(MatSetType(matrix, MATAIJ, ierr))
    PetscCallA(MatSeqAIJSetPreallocation(matrix, inside, PETSC_NULL_INTEGER, ierr))
    PetscCallA(MatMPIAIJSetPreallocation(matrix, inside, PETSC_NULL_INTEGER, outside, PETSC_NULL_INTEGER, ierr))
  end subroutine create_foil_matrix
end module gfb_foil_pieces
