#include "gfb_petsc.h"
!> A foil of shells on all ranks: full, or condensed onto the lines that can be loaded.
!>
!> Only free unknowns of kept nodes have a number; supports and condensed nodes have none. So one
!> mesh serves the full and the reduced foil, and a support costs nothing. A rank needs the mesh of
!> its own columns of elements only; nodes keep their numbers in the whole mesh.
module gfb_foil_structure
  use petscksp
  use gfb_kinds, only: wp
  use gfb_errors, only: error_type, add_context
  use gfb_text, only: text
  use gfb_petsc_kinds, only: pint
  use gfb_petsc_session, only: share_failure, fetch_entries, this_rank, rank_count
  use gfb_shell_geometry, only: shell_section_type, shell_nodes, node_unknowns, shell_unknowns
  use gfb_shell_element, only: shell_stiffness
  use gfb_shell_mass, only: shell_mass
  use gfb_quad_mesh, only: quad_mesh_type
  use gfb_substructures, only: substructure_type, kind_count
  use gfb_foil_sharing, only: cut_columns, share_kinds, pass_on, lines_at_seams
  use gfb_mesh_dm, only: distribute_mesh
  use gfb_foil_surface, only: foil_surface_type
  use gfb_foil_pieces, only: number_slots, condense_piece, piece_unknowns, element_geometry, &
                             add_symmetric_block, create_foil_matrix, element_row
  use gfb_super_element, only: super_element_type, destroy_super_element
  use gfb_cost_events, only: enter_stage, leave_stage
  implicit none (type)
  private
  public :: create_foil_structure, destroy_foil_structure

  !> One foil and this rank's part of its equations.
  type, extends(foil_surface_type), public :: foil_structure_type
    logical :: reduced = .false.             !! only retained nodes have unknowns
    type(substructure_type), allocatable :: substructure(:) !! of the whole foil; nodes of this rank's
    integer, allocatable :: mine(:)          !! substructures of this rank
    integer, allocatable :: slot(:, :)       !! (5, nodes) unknown's place at its node, 0: none
    logical, allocatable :: free(:, :)       !! (5, nodes) not held by a support
    integer :: unknowns = 0                  !! on all ranks
    integer :: first = 0                     !! unknowns of the ranks before this one
    integer :: condensations = 0             !! super-elements this rank condensed, each for all ranks
    type(super_element_type), allocatable :: super(:) !! by kind; those that this rank has
    Mat :: stiffness
    integer, allocatable :: column_part(:)   !! rank, from 1, of every column of elements
    logical, private :: created = .false.
  contains
    procedure :: unknown
    procedure :: numbers_at
    procedure :: natural_numbers
    procedure :: assemble_stiffness
    procedure :: assemble_mass
    procedure :: displacements
    procedure :: row_entries
  end type foil_structure_type

contains

  !> Numbers the unknowns, condenses the substructures and assembles the stiffness.
  !>
  !> Fails where an element is clockwise or degenerate.
  subroutine create_foil_structure(mesh, section, fixed, substructure, reduced, structure, error, column_part)
    type(quad_mesh_type), intent(in) :: mesh          !! this rank's columns at least
    type(shell_section_type), intent(in) :: section
    !> (5, nodes) held by supports or symmetry, under the mesh's numbers
    logical, allocatable, intent(in) :: fixed(:, :)
    !> every column in one of them, in order; none where nothing is condensed
    type(substructure_type), intent(in) :: substructure(:)
    logical, intent(in) :: reduced                    !! condense the substructures
    type(foil_structure_type), intent(out) :: structure
    type(error_type), allocatable, intent(out) :: error
    !> rank, from 1, of every column of elements; default: the foil is cut by itself
    integer, intent(in), optional :: column_part(:)
    integer, allocatable :: first(:)
    integer :: last, i
    PetscErrorCode :: ierr

    structure%mesh = mesh
    structure%section = section
    structure%reduced = reduced
    structure%substructure = substructure
    allocate (structure%free(node_unknowns, lbound(fixed, 2):ubound(fixed, 2)))
    structure%free(:, :) = .not. fixed
    call number_slots(structure%free, substructure, reduced, structure%slot)
    if (present(column_part)) then
      structure%column_part = column_part
    else
      first = [(i, i=1, mesh%stations)]
      if (reduced) first = [substructure%column, mesh%stations]
      call cut_columns(first, rank_count(), structure%column_part, error)
      if (allocated(error)) return
    end if
    call distribute_foil(structure)
    call MPI_Allreduce(structure%part%owned_unknowns, structure%unknowns, 1, MPI_INTEGER, MPI_SUM, PETSC_COMM_WORLD, ierr)
    call MPI_Scan(structure%part%owned_unknowns, last, 1, MPI_INTEGER, MPI_SUM, PETSC_COMM_WORLD, ierr)
    structure%first = last - structure%part%owned_unknowns
    call enter_stage('condensation')
    if (reduced) call condense_kinds(structure, error)
    call leave_stage()
    if (allocated(error)) return
    call enter_stage('stiffness')
    call structure%assemble_stiffness(structure%stiffness, error)
    call leave_stage()
    structure%created = .not. allocated(error)
  end subroutine create_foil_structure

  !> Every column of elements goes to its rank.
  subroutine distribute_foil(structure)
    type(foil_structure_type), intent(inout) :: structure
    integer, allocatable :: node_count(:), columns(:)
    integer :: i, k, node, width

    associate (mesh => structure%mesh, mine => structure%column_part == this_rank() + 1)
      allocate (node_count(lbound(mesh%position, 2):ubound(mesh%position, 2)))
      do node = lbound(node_count, 1), ubound(node_count, 1)
        node_count(node) = maxval(structure%slot(:, node))
      end do
      call distribute_mesh(PETSC_COMM_WORLD, mesh%stations, mesh%rows, .false., structure%column_part, &
                           structure%part, node_count)
      width = mesh%rows - 1
      columns = pack([(i, i=1, size(mine))], mine)
      structure%my_elements = [(((columns(i) - 1)*width + k, k=1, width), i=1, size(columns))]
      structure%mine = pack([(i, i=1, size(structure%substructure))], mine(structure%substructure%column))
      allocate (structure%local_node(lbound(node_count, 1):ubound(node_count, 1)), source=0)
    end associate
    do i = 1, size(structure%part%mesh_node)
      structure%local_node(structure%part%mesh_node(i)) = i
    end do
  end subroutine distribute_foil

  !> Condenses one substructure of every kind, once in the whole job, and shares it with the ranks that
  !> have others of that kind.
  !>
  !> Fails where an element is clockwise or degenerate.
  subroutine condense_kinds(structure, error)
    type(foil_structure_type), intent(inout) :: structure
    type(error_type), allocatable, intent(out) :: error
    integer, allocatable :: maker(:)
    logical, allocatable :: has(:, :)
    integer :: i

    allocate (structure%super(kind_count(structure%substructure)))
    call share_kinds(structure%substructure%kind, structure%column_part(structure%substructure%column), &
                     rank_count(), has, maker)
    do i = 1, size(structure%mine)
      associate (one => structure%substructure(structure%mine(i)))
        if (allocated(structure%super(one%kind)%retained)) cycle
        call condense_piece(structure%mesh, structure%section, structure%free(:, one%nodes), one, &
                            maker(one%kind) == this_rank() + 1, structure%super(one%kind), error)
        call add_context(error, 'substructure '//text(structure%mine(i)))
        if (allocated(error)) exit
        if (maker(one%kind) == this_rank() + 1) structure%condensations = structure%condensations + 1
      end associate
    end do
    call share_failure(error)
    if (allocated(error)) return
    do i = 1, size(maker)
      if (.not. has(this_rank() + 1, i)) cycle
      call pass_on(has(:, i), maker(i), size(structure%super(i)%retained), structure%super(i)%stiffness)
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

    call create_foil_matrix(self%row_entries(), at_seam(self), self%unknowns, matrix)
    if (self%reduced) then
      do i = 1, size(self%mine)
        associate (one => self%substructure(self%mine(i)))
          call add_symmetric_block(matrix, retained_unknowns(self, one), self%super(one%kind)%stiffness)
        end associate
      end do
    else
      PetscCallA(MatSetOption(matrix, MAT_IGNORE_ZERO_ENTRIES, PETSC_TRUE, ierr))
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
    call create_foil_matrix(self%row_entries(), at_seam(self), self%unknowns, matrix)
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

  !> Entries of a row of the foil's matrix, at most.
  pure function row_entries(self) result(entries)
    class(foil_structure_type), intent(in) :: self
    integer :: entries
    integer :: i, retained

    entries = element_row
    if (.not. self%reduced) return
    retained = 0
    do i = 1, size(self%substructure)
      retained = max(retained, count(self%substructure(i)%retained))
    end do
    entries = 2*retained*node_unknowns ! the two substructures that share a line
  end function row_entries

  !> Which of this rank's unknowns are coupled to those of other ranks.
  pure function at_seam(structure) result(coupled)
    type(foil_structure_type), intent(in) :: structure
    logical :: coupled(structure%part%owned_unknowns)
    logical :: line(structure%mesh%stations)
    integer :: i, k, ends(2, size(structure%mine)), place, unknowns

    if (structure%reduced) then
      do i = 1, size(structure%mine)
        associate (nodes => structure%substructure(structure%mine(i))%nodes)
          ends(:, i) = (nodes([1, size(nodes)]) - 1)/structure%mesh%rows + 1
        end associate
      end do
      line = lines_at_seams(structure%column_part, ends)
    else
      line = lines_at_seams(structure%column_part, reshape([(k, k + 1, k=1, size(line) - 1)], [2, size(line) - 1]))
    end if
    coupled = .false.
    do i = 1, size(structure%part%mesh_node)
      if (.not. structure%part%owned(i)) cycle
      unknowns = maxval(structure%slot(:, structure%part%mesh_node(i)))
      place = structure%part%first_unknown(i) - 1 - structure%first
      coupled(place + 1:place + unknowns) = line((structure%part%mesh_node(i) - 1)/structure%mesh%rows + 1)
    end do
  end function at_seam

  !> Global numbers, from 0, of all components at any nodes; -1 where there is none. All ranks ask.
  function numbers_at(self, nodes) result(number)
    class(foil_structure_type), intent(in) :: self
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
  pure function unknown(self, component, node) result(number)
    class(foil_structure_type), intent(in) :: self
    integer, intent(in) :: component !! 1 to 5: u, v, w, alpha, beta
    integer, intent(in) :: node      !! of the whole mesh
    integer :: number

    number = -1
    if (node < lbound(self%local_node, 1) .or. node > ubound(self%local_node, 1)) return
    if (self%slot(component, node) == 0 .or. self%local_node(node) == 0) return
    number = self%part%first_unknown(self%local_node(node)) + self%slot(component, node) - 2
  end function unknown

  !> Natural numbers, from 1, of the unknowns this rank owns, in the order of the vectors: node by node
  !> over the whole mesh, with gaps where nothing has a number.
  function natural_numbers(self) result(number)
    class(foil_structure_type), intent(in) :: self
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
          has = piece_unknowns(structure%free(:, one%nodes), one)
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
