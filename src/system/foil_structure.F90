#include "gfb_petsc.h"
!> A foil of shells on all ranks: full, or condensed onto the lines that can be loaded.
!>
!> Only free unknowns of kept nodes have a number; supports and condensed nodes have none. So one
!> mesh serves the full and the reduced foil, and a support costs nothing.
module gfb_foil_structure
  use petscksp
  use gfb_kinds, only: wp
  use gfb_errors, only: error_type, add_context
  use gfb_text, only: text
  use gfb_petsc_kinds, only: pint
  use gfb_petsc_session, only: share_failure
  use gfb_shell_geometry, only: shell_section_type, shell_nodes, node_unknowns, shell_unknowns
  use gfb_shell_element, only: shell_stiffness
  use gfb_shell_mass, only: shell_mass
  use gfb_quad_mesh, only: quad_mesh_type
  use gfb_substructures, only: substructure_type
  use gfb_mesh_dm, only: local_mesh_type, distribute_mesh
  use gfb_foil_pieces, only: number_slots, condense_piece, piece_unknowns, element_geometry, &
                             add_symmetric_block, create_foil_matrix, element_row
  use gfb_super_element, only: super_element_type, destroy_super_element
  implicit none (type)
  private
  public :: create_foil_structure, destroy_foil_structure

  !> One foil and this rank's part of it.
  type, public :: foil_structure_type
    type(quad_mesh_type) :: mesh             !! the whole foil
    type(shell_section_type) :: section
    logical :: reduced = .false.             !! only retained nodes have unknowns
    type(local_mesh_type) :: part            !! this rank's elements and nodes
    type(substructure_type), allocatable :: substructure(:) !! of the whole foil
    integer, allocatable :: mine(:)          !! substructures of this rank
    integer, allocatable :: my_elements(:)   !! elements of this rank, numbers in the whole mesh
    integer, allocatable :: slot(:, :)       !! (5, nodes) unknown's place at its node, 0: none
    logical, allocatable :: free(:, :)       !! (5, nodes) not held by a support
    integer, allocatable :: local_node(:)    !! this rank's number of a node, 0 where it is elsewhere
    integer :: unknowns = 0                  !! on all ranks
    integer :: condensations = 0             !! super-elements this rank condensed
    type(super_element_type), allocatable :: super(:) !! by kind; condensed where this rank needs it
    Mat :: stiffness
    logical, private :: created = .false.
  contains
    procedure :: unknown
    procedure :: owns
    procedure :: assemble_stiffness
    procedure :: assemble_mass
    procedure :: displacements
  end type foil_structure_type

contains

  !> Numbers the unknowns, condenses the substructures and assembles the stiffness.
  !>
  !> Fails where an element is clockwise or degenerate.
  subroutine create_foil_structure(mesh, section, fixed, substructure, reduced, structure, error)
    type(quad_mesh_type), intent(in) :: mesh
    type(shell_section_type), intent(in) :: section
    logical, intent(in) :: fixed(:, :)                !! (5, nodes) held by supports or symmetry
    type(substructure_type), intent(in) :: substructure(:) !! all elements, each in one of them
    logical, intent(in) :: reduced                    !! condense the substructures
    type(foil_structure_type), intent(out) :: structure
    type(error_type), allocatable, intent(out) :: error

    structure%mesh = mesh
    structure%section = section
    structure%reduced = reduced
    structure%substructure = substructure
    structure%free = .not. fixed
    call number_slots(structure%free, substructure, reduced, structure%slot)
    structure%unknowns = count(structure%slot > 0)
    call distribute_foil(structure)
    if (reduced) call condense_kinds(structure, error)
    call share_failure(error)
    if (allocated(error)) return
    call structure%assemble_stiffness(structure%stiffness, error)
    structure%created = .not. allocated(error)
  end subroutine create_foil_structure

  !> Whole substructures go to a rank, neighbours together.
  subroutine distribute_foil(structure)
    type(foil_structure_type), intent(inout) :: structure
    integer, allocatable :: element_part(:), node_count(:)
    integer :: rank, ranks, i, done, elements, part
    PetscErrorCode :: ierr

    call MPI_Comm_rank(PETSC_COMM_WORLD, rank, ierr)
    call MPI_Comm_size(PETSC_COMM_WORLD, ranks, ierr)
    elements = size(structure%mesh%element_nodes, 2)
    allocate (element_part(elements), source=1)
    allocate (structure%mine(0))
    done = 0
    do i = 1, size(structure%substructure)
      associate (own => structure%substructure(i)%elements)
        part = min(ranks, (done + size(own)/2)*ranks/elements + 1)
        element_part(own) = part
        done = done + size(own)
      end associate
      if (part == rank + 1) structure%mine = [structure%mine, i]
    end do
    node_count = maxval(structure%slot, 1)
    if (rank == 0) then
      call distribute_mesh(PETSC_COMM_WORLD, structure%mesh%element_nodes, element_part, &
                           structure%mesh%position, node_count, structure%part)
    else
      call distribute_mesh(PETSC_COMM_WORLD, structure%mesh%element_nodes(:, :0), element_part(:0), &
                           structure%mesh%position(:, :0), node_count, structure%part)
    end if
    structure%my_elements = pack([(i, i=1, elements)], element_part == rank + 1)
    allocate (structure%local_node(size(node_count)), source=0)
    do i = 1, size(structure%part%mesh_node)
      structure%local_node(structure%part%mesh_node(i)) = i
    end do
  end subroutine distribute_foil

  !> Condenses one substructure of every kind this rank has.
  !>
  !> Fails where an element is clockwise or degenerate.
  subroutine condense_kinds(structure, error)
    type(foil_structure_type), intent(inout) :: structure
    type(error_type), allocatable, intent(out) :: error
    integer :: i, kinds

    kinds = 0
    do i = 1, size(structure%substructure)
      kinds = max(kinds, structure%substructure(i)%kind)
    end do
    allocate (structure%super(kinds))
    do i = 1, size(structure%mine)
      associate (one => structure%substructure(structure%mine(i)))
        if (allocated(structure%super(one%kind)%stiffness)) cycle
        call condense_piece(structure%mesh, structure%section, structure%free, one, &
                            structure%super(one%kind), error)
        call add_context(error, 'substructure '//text(structure%mine(i)))
        if (allocated(error)) return
        structure%condensations = structure%condensations + 1
      end associate
    end do
  end subroutine condense_kinds

  !> Stiffness of the whole foil in its numbered unknowns.
  !>
  !> Fails where an element is clockwise or degenerate.
  subroutine assemble_stiffness(self, matrix, error)
    class(foil_structure_type), intent(in) :: self
    Mat, intent(out) :: matrix
    type(error_type), allocatable, intent(out) :: error

    real(wp) :: block(shell_unknowns, shell_unknowns)
    PetscErrorCode :: ierr
    integer :: i

    call create_foil_matrix(self%part%owned_unknowns, self%unknowns, row_entries(self), matrix)
    if (self%reduced) then
      do i = 1, size(self%mine)
        associate (one => self%substructure(self%mine(i)))
          call add_symmetric_block(matrix, retained_unknowns(self, one), self%super(one%kind)%stiffness)
        end associate
      end do
    else
      do i = 1, size(self%my_elements)
        call shell_stiffness(element_geometry(self%mesh, self%my_elements(i)), self%section, block, error)
        if (allocated(error)) exit
        call add_symmetric_block(matrix, element_unknowns(self, self%my_elements(i)), block)
      end do
    end if
    call share_failure(error)
    PetscCallA(MatAssemblyBegin(matrix, MAT_FINAL_ASSEMBLY, ierr))
    PetscCallA(MatAssemblyEnd(matrix, MAT_FINAL_ASSEMBLY, ierr))
    PetscCallA(MatSetOption(matrix, MAT_SYMMETRIC, PETSC_TRUE, ierr))
  end subroutine assemble_stiffness

  !> Consistent mass of the whole foil, for foils that are not condensed.
  !>
  !> Fails where an element is clockwise or degenerate.
  subroutine assemble_mass(self, matrix, error)
    class(foil_structure_type), intent(in) :: self
    Mat, intent(out) :: matrix
    type(error_type), allocatable, intent(out) :: error

    real(wp) :: block(shell_unknowns, shell_unknowns)
    PetscErrorCode :: ierr
    integer :: i

    if (self%reduced) error stop 'a condensed foil has no mass matrix of its own'
    call create_foil_matrix(self%part%owned_unknowns, self%unknowns, row_entries(self), matrix)
    do i = 1, size(self%my_elements)
      call shell_mass(element_geometry(self%mesh, self%my_elements(i)), self%section, block, error)
      if (allocated(error)) exit
      call add_symmetric_block(matrix, element_unknowns(self, self%my_elements(i)), block)
    end do
    call share_failure(error)
    PetscCallA(MatAssemblyBegin(matrix, MAT_FINAL_ASSEMBLY, ierr))
    PetscCallA(MatAssemblyEnd(matrix, MAT_FINAL_ASSEMBLY, ierr))
    PetscCallA(MatSetOption(matrix, MAT_SYMMETRIC, PETSC_TRUE, ierr))
  end subroutine assemble_mass

  !> Entries of a row of a foil's matrix, at most.
  pure function row_entries(structure) result(entries)
    type(foil_structure_type), intent(in) :: structure
    integer :: entries
    integer :: i, retained

    entries = element_row
    if (.not. structure%reduced) return
    retained = 0
    do i = 1, size(structure%substructure)
      retained = max(retained, count(structure%substructure(i)%retained))
    end do
    entries = 2*retained*node_unknowns ! the two substructures that share a line
  end function row_entries

  !> Global number, from 0, of a component at a node of this rank; -1 where it has none.
  pure function unknown(self, component, node) result(number)
    class(foil_structure_type), intent(in) :: self
    integer, intent(in) :: component !! 1 to 5: u, v, w, alpha, beta
    integer, intent(in) :: node      !! of the whole mesh
    integer :: number

    number = -1
    if (self%slot(component, node) == 0 .or. self%local_node(node) == 0) return
    number = self%part%first_unknown(self%local_node(node)) + self%slot(component, node) - 2
  end function unknown

  !> Whether this rank owns a node.
  pure function owns(self, node) result(mine)
    class(foil_structure_type), intent(in) :: self
    integer, intent(in) :: node !! of the whole mesh
    logical :: mine

    mine = .false.
    if (self%local_node(node) > 0) mine = self%part%owned(self%local_node(node))
  end function owns

  !> Global numbers of an element's unknowns.
  pure function element_unknowns(structure, element) result(number)
    type(foil_structure_type), intent(in) :: structure
    integer, intent(in) :: element !! of the whole mesh
    integer :: number(shell_unknowns)
    integer :: corner, component

    do corner = 1, shell_nodes
      do component = 1, node_unknowns
        number((corner - 1)*node_unknowns + component) = &
          structure%unknown(component, structure%mesh%element_nodes(corner, element))
      end do
    end do
  end function element_unknowns

  !> Global numbers of a substructure's retained unknowns, in the super-element's order; -1 at
  !> supports.
  pure function retained_unknowns(structure, substructure) result(number)
    type(foil_structure_type), intent(in) :: structure
    type(substructure_type), intent(in) :: substructure
    integer, allocatable :: number(:)
    integer :: i, component, found

    allocate (number(node_unknowns*count(substructure%retained)))
    found = 0
    do i = 1, size(substructure%nodes)
      if (.not. substructure%retained(i)) cycle
      do component = 1, node_unknowns
        found = found + 1
        number(found) = structure%unknown(component, substructure%nodes(i))
      end do
    end do
  end function retained_unknowns

  !> Displacements of all nodes of this rank, those of condensed nodes recovered.
  subroutine displacements(self, solution, moved)
    class(foil_structure_type), intent(in) :: self
    Vec, intent(in) :: solution         !! of the numbered unknowns
    real(wp), intent(out) :: moved(:, :) !! (5, local nodes) [m], [rad]

    Vec :: local
    IS :: from
    VecScatter :: fetch
    PetscScalar, pointer :: values(:)
    PetscInt, allocatable :: number(:)
    PetscErrorCode :: ierr
    integer :: node, component, found

    allocate (number(count(self%slot(:, self%part%mesh_node) > 0)))
    found = 0
    do node = 1, size(self%part%mesh_node)
      do component = 1, node_unknowns
        if (self%slot(component, self%part%mesh_node(node)) == 0) cycle
        found = found + 1
        number(found) = int(self%unknown(component, self%part%mesh_node(node)), pint)
      end do
    end do
    PetscCallA(VecCreateSeq(PETSC_COMM_SELF, int(size(number), pint), local, ierr))
    PetscCallA(ISCreateGeneral(PETSC_COMM_SELF, int(size(number), pint), number, PETSC_COPY_VALUES, from, ierr))
    PetscCallA(VecScatterCreate(solution, from, local, PETSC_NULL_IS, fetch, ierr))
    PetscCallA(VecScatterBegin(fetch, solution, local, INSERT_VALUES, SCATTER_FORWARD, ierr))
    PetscCallA(VecScatterEnd(fetch, solution, local, INSERT_VALUES, SCATTER_FORWARD, ierr))
    PetscCallA(GFB_VecGetArrayRead(local, values, ierr))
    moved = 0.0_wp
    found = 0
    do node = 1, size(self%part%mesh_node)
      do component = 1, node_unknowns
        if (self%slot(component, self%part%mesh_node(node)) == 0) cycle
        found = found + 1
        moved(component, node) = values(found)
      end do
    end do
    PetscCallA(GFB_VecRestoreArrayRead(local, values, ierr))
    PetscCallA(VecScatterDestroy(fetch, ierr))
    PetscCallA(ISDestroy(from, ierr))
    PetscCallA(VecDestroy(local, ierr))
    if (self%reduced) call recover_interior(self, moved)
  end subroutine displacements

  !> Fills in the displacements of the condensed nodes.
  subroutine recover_interior(structure, moved)
    type(foil_structure_type), intent(in) :: structure
    real(wp), intent(inout) :: moved(:, :) !! (5, local nodes)
    real(wp), allocatable :: known(:), all_unknowns(:)
    logical, allocatable :: has(:, :)
    integer :: i

    do i = 1, size(structure%mine)
      associate (one => structure%substructure(structure%mine(i)))
        associate (super => structure%super(one%kind), local => structure%local_node(one%nodes))
          has = piece_unknowns(structure%free, one)
          all_unknowns = pack(moved(:, local), has)
          known = all_unknowns(super%retained)
          call super%recover(known, all_unknowns)
          moved(:, local) = unpack(all_unknowns, has, 0.0_wp)
        end associate
      end associate
    end do
  end subroutine recover_interior

  !> Frees what PETSc holds; may be called twice.
  subroutine destroy_foil_structure(structure)
    type(foil_structure_type), intent(inout) :: structure
    PetscErrorCode :: ierr
    integer :: kind

    if (.not. structure%created) return
    PetscCallA(MatDestroy(structure%stiffness, ierr))
    if (allocated(structure%super)) then
      do kind = 1, size(structure%super)
        call destroy_super_element(structure%super(kind))
      end do
    end if
    structure%created = .false.
  end subroutine destroy_foil_structure
end module gfb_foil_structure
