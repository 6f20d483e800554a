#include "gfb_petsc.h"
!> A foil of shells on all ranks, full or condensed onto the lines that can be loaded: the numbers of
!> its unknowns, and displacements from them.
!>
!> Only free unknowns of kept nodes have a number; supports and condensed nodes have none. So one
!> mesh serves the full and the reduced foil, and a support costs nothing. A rank needs the mesh of
!> its own columns of elements only; nodes keep their numbers in the whole mesh.
module gfb_foil_structure
  use petscksp
  use gfb_kinds, only: wp
  use gfb_errors, only: error_type
  use gfb_petsc_kinds, only: pint
  use gfb_shell_geometry, only: shell_geometry_type, shell_section_type, node_unknowns, shell_unknowns
  use gfb_shell_element, only: shell_stiffness
  use gfb_shell_mass, only: shell_mass
  use gfb_quad_mesh, only: quad_mesh_type, own_thickness
  use gfb_substructures, only: substructure_type, places_in
  use gfb_super_element, only: super_element_type, hold_blocks, form_explicitly, destroy_super_element
  use gfb_petsc_session, only: fetch_entries
  use gfb_foil_surface, only: foil_surface_type
  implicit none (type)
  private
  public :: number_slots, condense_piece, assemble_piece, retained_in_piece, element_geometry, element_section, &
            add_symmetric_block, create_foil_matrix, destroy_foil_structure

  integer, parameter :: element_row = 9*node_unknowns !! entries of a row: a node, its neighbours

  !> One foil and this rank's part of its equations.
  type, extends(foil_surface_type), public :: foil_structure_type
    logical :: reduced = .false.             !! only retained nodes have unknowns
    type(substructure_type), allocatable :: substructure(:) !! of the whole foil; nodes of this rank's
    integer, allocatable :: mine(:)          !! substructures of this rank
    integer, allocatable :: slot(:, :)       !! (5, nodes) unknown's number at its node, 0: none
    logical, allocatable :: free(:, :)       !! (5, nodes) not fixed by a support
    integer :: unknowns = 0                  !! on all ranks
    integer :: first = 0                     !! unknowns of the ranks before this one
    integer :: condensations = 0             !! super-elements this rank condensed, each for all ranks
    type(super_element_type), allocatable :: super(:) !! by kind; those that this rank has
    Mat :: stiffness
    integer, allocatable :: column_part(:)   !! rank, from 1, of every column of elements
    logical :: created = .false.             !! the matrix is there
  contains
    procedure, non_overridable :: unknown, numbers_at, natural_numbers, displacements, gather_forces, row_entries
  end type foil_structure_type

contains

  !> Number of each free unknown of a kept node at its node, 0 for all others.
  pure subroutine number_slots(free, substructure, reduced, slot)
    logical, allocatable, intent(in) :: free(:, :)    !! (5, nodes) not fixed by a support
    type(substructure_type), intent(in) :: substructure(:) !! all of the foil's
    logical, intent(in) :: reduced                    !! only retained nodes are kept
    integer, allocatable, intent(out) :: slot(:, :)   !! (5, nodes)
    logical :: kept(lbound(free, 2):ubound(free, 2))
    integer :: node, i, component, slots

    kept = .not. reduced
    if (reduced) then
      do i = 1, size(substructure)
        kept(pack(substructure(i)%nodes, substructure(i)%retained)) = .true.
      end do
    end if
    allocate (slot(node_unknowns, lbound(kept, 1):ubound(kept, 1)), source=0)
    do node = lbound(kept, 1), ubound(kept, 1)
      if (.not. kept(node)) cycle
      slots = 0
      do component = 1, node_unknowns
        if (.not. free(component, node)) cycle
        slots = slots + 1
        slot(component, node) = slots
      end do
    end do
  end subroutine number_slots

  !> Assembles a substructure on its own and condenses it, or only keeps what recovers its interior.
  !>
  !> Fails where an element is clockwise or degenerate.
  subroutine condense_piece(mesh, section, free, substructure, explicitly, super, error)
    type(quad_mesh_type), intent(in) :: mesh !! of the foil
    type(shell_section_type), intent(in) :: section !! thickness and material
    logical, intent(in) :: free(:, :) !! (5, the piece's nodes) not fixed by a support
    type(substructure_type), intent(in) :: substructure !! to be condensed
    logical, intent(in) :: explicitly !! the condensed matrix too
    type(super_element_type), intent(out) :: super !! what the substructure becomes
    type(error_type), allocatable, intent(out) :: error !! error, if an element is degenerate
    logical, allocatable :: is_retained(:)
    Mat :: stiffness
    PetscErrorCode :: ierr

    call assemble_piece(mesh, section, free, substructure, .false., stiffness, error)
    if (allocated(error)) return
    is_retained = retained_in_piece(free, substructure)
    call hold_blocks(stiffness, is_retained, 'super_', super)
    if (explicitly) call form_explicitly(stiffness, is_retained, super)
    PetscCallA(MatDestroy(stiffness, ierr))
  end subroutine condense_piece

  !> Stiffness or mass of a substructure on this rank alone, all of its unknowns.
  !>
  !> Fails where an element is clockwise or degenerate.
  subroutine assemble_piece(mesh, section, free, substructure, mass, matrix, error)
    type(quad_mesh_type), intent(in) :: mesh !! of the foil
    type(shell_section_type), intent(in) :: section !! thickness and material
    logical, intent(in) :: free(:, :) !! (5, the piece's nodes) not fixed by a support
    type(substructure_type), intent(in) :: substructure !! whose matrix it is
    logical, intent(in) :: mass       !! instead of stiffness
    Mat, intent(out) :: matrix !! of all its unknowns, on this rank alone
    type(error_type), allocatable, intent(out) :: error !! error, if an element is degenerate

    integer :: number(node_unknowns, size(substructure%nodes)), i, unknowns
    real(wp) :: block(shell_unknowns, shell_unknowns)
    PetscErrorCode :: ierr

    number = piece_numbers(free, substructure)
    unknowns = maxval(number)
    PetscCallA(MatCreateSeqAIJ(PETSC_COMM_SELF, int(unknowns, pint), int(unknowns, pint), int(element_row, pint), PETSC_NULL_INTEGER_ARRAY, matrix, ierr))
    do i = 1, size(substructure%elements)
      associate (corner => places_in(substructure, mesh%element_nodes(:, substructure%elements(i))), &
                 geometry => element_geometry(mesh, substructure%elements(i)))
        if (mass) then
          call shell_mass(geometry, element_section(mesh, section, substructure%elements(i)), block, error)
        else
          call shell_stiffness(geometry, element_section(mesh, section, substructure%elements(i)), block, error)
        end if
        if (allocated(error)) return
        call add_symmetric_block(matrix, reshape(number(:, corner), [shell_unknowns]) - 1, block)
      end associate
    end do
    PetscCallA(MatAssemblyBegin(matrix, MAT_FINAL_ASSEMBLY, ierr))
    PetscCallA(MatAssemblyEnd(matrix, MAT_FINAL_ASSEMBLY, ierr))
  end subroutine assemble_piece

  !> Which of a substructure's unknowns are kept.
  pure function retained_in_piece(free, substructure) result(is_retained)
    logical, intent(in) :: free(:, :) !! (5, the piece's nodes) not fixed by a support
    type(substructure_type), intent(in) :: substructure !! whose unknowns they are
    logical, allocatable :: is_retained(:)
    is_retained = pack(spread(substructure%retained, 1, node_unknowns), piece_unknowns(free, substructure))
  end function retained_in_piece

  !> Unknowns a super-element has, (5, nodes): all of its retained nodes, so that a support there
  !> does not make it another kind, and the free ones inside.
  pure function piece_unknowns(free, substructure) result(has)
    logical, intent(in) :: free(:, :) !! (5, the piece's nodes) not fixed by a support
    type(substructure_type), intent(in) :: substructure !! whose unknowns they are
    logical :: has(node_unknowns, size(substructure%nodes))
    has = free .or. spread(substructure%retained, 1, node_unknowns)
  end function piece_unknowns

  !> Numbers of a substructure's unknowns, from 1, node by node; 0 where there is none.
  pure function piece_numbers(free, substructure) result(number)
    logical, intent(in) :: free(:, :) !! (5, the piece's nodes) not fixed by a support
    type(substructure_type), intent(in) :: substructure !! whose unknowns they are
    integer :: number(node_unknowns, size(substructure%nodes))
    integer :: i

    associate (has => piece_unknowns(free, substructure))
      number = unpack([(i, i=1, count(has))], has, 0)
    end associate
  end function piece_numbers

  !> Where an element of a mesh is.
  pure function element_geometry(mesh, element) result(geometry)
    type(quad_mesh_type), intent(in) :: mesh !! of the foil
    integer, intent(in) :: element !! number in the whole mesh
    type(shell_geometry_type) :: geometry

    associate (nodes => mesh%element_nodes(:, element))
      geometry%position = mesh%position(:, nodes)
      geometry%director = mesh%director(:, :, element)
      geometry%axis(:, 1, :) = mesh%axis_1(:, nodes)
      geometry%axis(:, 2, :) = mesh%axis_2(:, nodes)
    end associate
    if (mesh%ring_radius > 0.0_wp) call roll_up(mesh%ring_radius, geometry)
  end function element_geometry

  !> Puts an element of a ring where it is in space, seen along the ray in its middle: equal ones are equal all around.
  !>
  !> $$ (x, v, r) \to (r \sin \varphi, v, r \cos \varphi), \quad \varphi = (x - x_m)/R $$
  pure subroutine roll_up(radius, geometry)
    real(wp), intent(in) :: radius !! R, at which x is measured [m]
    type(shell_geometry_type), intent(inout) :: geometry !! unrolled; in space
    real(wp) :: direction(3, 3)
    integer :: node

    associate (x => geometry%position(1, :), r => geometry%position(3, :))
      geometry%angle = (x - 0.5_wp*(minval(x) + maxval(x)))/radius
      do node = 1, size(geometry%angle)
        direction = geometry%directions(node)
        geometry%position(:, node) = [r(node)*direction(1, 3), geometry%position(2, node), r(node)*direction(3, 3)]
        geometry%director(:, node) = matmul(direction, geometry%director(:, node))
        geometry%axis(:, :, node) = matmul(direction, geometry%axis(:, :, node))
      end do
    end associate
  end subroutine roll_up

  !> What an element of a mesh is made of.
  pure function element_section(mesh, section, element) result(own)
    type(quad_mesh_type), intent(in) :: mesh !! of the foil
    type(shell_section_type), intent(in) :: section !! thickness and material of the foil
    integer, intent(in) :: element !! number in the whole mesh
    type(shell_section_type) :: own

    own = section
    if (own_thickness(mesh, element) > 0.0_wp) own%thickness = own_thickness(mesh, element)
  end function element_section

  !> Adds a symmetric block by global numbers, from 0; negative ones are skipped.
  !>
  !> What couples unknowns of this rank only goes straight into the rank's own block, which costs an
  !> eighth less a value than by the matrix of all ranks.
  subroutine add_symmetric_block(matrix, number, block)
    Mat, intent(in) :: matrix !! of the foil, over all ranks
    integer, intent(in) :: number(:) !! of the block's unknowns, from 0
    real(wp), intent(in) :: block(size(number)*size(number)) !! row by row, stiffness or mass [SI]
    Mat :: own
    PetscInt :: index(size(number)), first, last
    PetscErrorCode :: ierr

    index = int(number, pint)
    PetscCallA(MatGetOwnershipRange(matrix, first, last, ierr))
    if (any(index >= 0 .and. (index < first .or. index >= last))) then
      PetscCallA(MatSetValues(matrix, int(size(index), pint), index, int(size(index), pint), index, block, ADD_VALUES, ierr))
      return
    end if
    PetscCallA(MatGetDiagonalBlock(matrix, own, ierr))
    where (index >= 0) index = index - first
    PetscCallA(MatSetValues(own, int(size(index), pint), index, int(size(index), pint), index, block, ADD_VALUES, ierr))
  end subroutine add_symmetric_block

  !> An empty matrix over all ranks with room for what a row couples.
  subroutine create_foil_matrix(entries, at_seam, unknowns, matrix)
    integer, intent(in) :: entries     !! of a row, at most
    logical, intent(in) :: at_seam(:)  !! (unknowns of this rank) coupled to other ranks' unknowns
    integer, intent(in) :: unknowns    !! of all ranks
    Mat, intent(out) :: matrix !! empty, preallocated
    PetscInt :: inside(size(at_seam)), outside(size(at_seam)), owned
    PetscErrorCode :: ierr

    owned = size(at_seam)
    inside = min(int(entries, pint), owned)
    outside = merge(min(int(entries, pint), int(unknowns, pint) - owned), 0_pint, at_seam)
    PetscCallA(MatCreate(PETSC_COMM_WORLD, matrix, ierr))
    PetscCallA(MatSetSizes(matrix, owned, owned, PETSC_DETERMINE, PETSC_DETERMINE, ierr))
    PetscCallA(MatSetType(matrix, MATAIJ, ierr))
    PetscCallA(MatSeqAIJSetPreallocation(matrix, 0_pint, inside, ierr))
    PetscCallA(MatMPIAIJSetPreallocation(matrix, 0_pint, inside, 0_pint, outside, ierr))
  end subroutine create_foil_matrix

  !> Entries of a row of the foil's matrix, at most.
  pure integer function row_entries(self) result(entries)
    class(foil_structure_type), intent(in) :: self !! the foil
    integer :: i, retained

    entries = element_row
    if (.not. self%reduced) return
    retained = 0
    do i = 1, size(self%substructure)
      retained = max(retained, count(self%substructure(i)%retained))
    end do
    entries = 2*retained*node_unknowns ! the two substructures that share a line
  end function row_entries

  !> Global numbers, from 0, of all components at any nodes; -1 where there is none. All ranks ask.
  function numbers_at(self, nodes) result(number)
    class(foil_structure_type), intent(in) :: self !! the foil
    integer, intent(in) :: nodes(:) !! of the whole mesh
    integer :: number(node_unknowns, size(nodes))
    real(wp) :: known(node_unknowns, count(self%part%owned))
    integer, allocatable :: own(:)
    integer :: i, component

    own = pack(self%part%mesh_node, self%part%owned)
    do i = 1, size(own)
      do component = 1, node_unknowns
        known(component, i) = real(self%unknown(component, own(i)), wp)
      end do
    end do
    number = nint(fetch_entries(self%mesh%nodes(), own, known, nodes))
  end function numbers_at

  !> Global number, from 0, of a component at a node of this rank; -1 where it has none.
  pure integer function unknown(self, component, node) result(number)
    class(foil_structure_type), intent(in) :: self !! the foil
    integer, intent(in) :: component !! 1 to 5: u, v, w, alpha, beta
    integer, intent(in) :: node      !! of the whole mesh

    number = -1
    if (node < lbound(self%local_node, 1) .or. node > ubound(self%local_node, 1)) return
    if (self%slot(component, node) == 0 .or. self%local_node(node) == 0) return
    number = self%part%first_unknown(self%local_node(node)) + self%slot(component, node) - 2
  end function unknown

  !> Natural numbers, from 1, of the unknowns this rank owns, in the order of the vectors: node by node
  !> over the whole mesh, with gaps where nothing has a number.
  function natural_numbers(self) result(number)
    class(foil_structure_type), intent(in) :: self !! the foil
    integer, allocatable :: number(:), unknown(:), natural(:)
    integer :: node, component, found, here

    associate (part => self%part)
      allocate (number(part%owned_unknowns), unknown(part%owned_unknowns), natural(part%owned_unknowns))
      found = 0
      do node = 1, size(part%mesh_node)
        if (.not. part%owned(node)) cycle
        do component = 1, node_unknowns
          here = self%unknown(component, part%mesh_node(node))
          if (here < 0) cycle
          found = found + 1
          unknown(found) = here
          natural(found) = node_unknowns*(part%mesh_node(node) - 1) + component
        end do
      end do
    end associate
    if (found /= size(number)) error stop 'a node''s unknowns are not where its mesh says'
    if (found > 0) number(unknown - minval(unknown) + 1) = natural
  end function natural_numbers

  !> Displacements of all nodes of this rank, those of condensed nodes recovered.
  subroutine displacements(self, solution, moved)
    class(foil_structure_type), intent(in) :: self !! the foil
    Vec, intent(in) :: solution         !! of the numbered unknowns
    real(wp), intent(out) :: moved(:, :) !! (5, local nodes) [m], [rad]

    Vec :: local
    VecScatter :: fetch
    PetscScalar, pointer :: values(:)
    PetscErrorCode :: ierr

    call create_fetch(self, solution, local, fetch)
    PetscCallA(VecScatterBegin(fetch, solution, local, INSERT_VALUES, SCATTER_FORWARD, ierr))
    PetscCallA(VecScatterEnd(fetch, solution, local, INSERT_VALUES, SCATTER_FORWARD, ierr))
    PetscCallA(GFB_VecGetArrayRead(local, values, ierr))
    moved = unpack(values, self%slot(:, self%part%mesh_node) > 0, 0.0_wp)
    PetscCallA(GFB_VecRestoreArrayRead(local, values, ierr))
    PetscCallA(VecScatterDestroy(fetch, ierr))
    PetscCallA(VecDestroy(local, ierr))
    if (self%reduced) call recover_interior(self, moved)
  end subroutine displacements

  !> Forces on this rank's nodes as forces on the numbered unknowns: what `displacements` does, transposed.
  subroutine gather_forces(self, force, total)
    class(foil_structure_type), intent(in) :: self !! the foil
    real(wp), intent(in) :: force(:, :) !! (5, local nodes) [N], [N m]; a node's forces of all ranks add up
    Vec, intent(in) :: total !! of the numbered unknowns, gets what is added to it

    Vec :: local
    VecScatter :: fetch
    PetscScalar, pointer :: values(:)
    PetscErrorCode :: ierr
    real(wp), allocatable :: outside(:, :)

    outside = force
    if (self%reduced) call condense_interior(self, outside)
    call create_fetch(self, total, local, fetch)
    PetscCallA(GFB_VecGetArray(local, values, ierr))
    values = pack(outside, self%slot(:, self%part%mesh_node) > 0)
    PetscCallA(GFB_VecRestoreArray(local, values, ierr))
    PetscCallA(VecScatterBegin(fetch, local, total, ADD_VALUES, SCATTER_REVERSE, ierr))
    PetscCallA(VecScatterEnd(fetch, local, total, ADD_VALUES, SCATTER_REVERSE, ierr))
    PetscCallA(VecScatterDestroy(fetch, ierr))
    PetscCallA(VecDestroy(local, ierr))
  end subroutine gather_forces

  !> The way from the numbered unknowns to those of this rank's nodes, node by node.
  subroutine create_fetch(structure, solution, local, fetch)
    type(foil_structure_type), intent(in) :: structure
    Vec, intent(in) :: solution !! of the numbered unknowns
    Vec, intent(out) :: local !! of this rank alone
    VecScatter, intent(out) :: fetch
    IS :: from
    PetscInt, allocatable :: number(:)
    PetscErrorCode :: ierr
    integer :: node, component, found

    associate (nodes => structure%part%mesh_node)
      allocate (number(count(structure%slot(:, nodes) > 0)))
      found = 0
      do node = 1, size(nodes)
        do component = 1, node_unknowns
          if (structure%slot(component, nodes(node)) == 0) cycle
          found = found + 1
          number(found) = int(structure%unknown(component, nodes(node)), pint)
        end do
      end do
    end associate
    PetscCallA(VecCreateSeq(PETSC_COMM_SELF, int(size(number), pint), local, ierr))
    PetscCallA(ISCreateGeneral(PETSC_COMM_SELF, int(size(number), pint), number, PETSC_COPY_VALUES, from, ierr))
    PetscCallA(VecScatterCreate(solution, from, local, PETSC_NULL_IS, fetch, ierr))
    PetscCallA(ISDestroy(from, ierr))
  end subroutine create_fetch

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
          has = piece_unknowns(structure%free(:, one%nodes), one)
          all_unknowns = pack(moved(:, local), has)
          known = all_unknowns(super%retained)
          call super%recover(known, all_unknowns)
          moved(:, local) = unpack(all_unknowns, has, 0.0_wp)
        end associate
      end associate
    end do
  end subroutine recover_interior

  !> Brings forces on the condensed nodes to the retained ones, transposed to `recover_interior`.
  subroutine condense_interior(structure, force)
    type(foil_structure_type), intent(in) :: structure
    real(wp), intent(inout) :: force(:, :) !! (5, local nodes)
    real(wp), allocatable :: all_unknowns(:), condensed(:)
    logical, allocatable :: has(:, :)
    integer :: i

    do i = 1, size(structure%mine)
      associate (one => structure%substructure(structure%mine(i)))
        associate (super => structure%super(one%kind), local => structure%local_node(one%nodes))
          has = piece_unknowns(structure%free(:, one%nodes), one)
          all_unknowns = pack(force(:, local), has)
          all_unknowns(super%retained) = 0.0_wp ! they stay where they are
          if (.not. any(abs(all_unknowns) > 0.0_wp)) cycle
          condensed = super%condense_force(all_unknowns)
          all_unknowns = 0.0_wp
          all_unknowns(super%retained) = condensed
          force(:, local) = force(:, local) + unpack(all_unknowns, has, 0.0_wp)
        end associate
      end associate
    end do
  end subroutine condense_interior

  !> Frees what PETSc holds; may be called twice.
  subroutine destroy_foil_structure(structure)
    type(foil_structure_type), intent(inout) :: structure !! its matrices are freed
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
