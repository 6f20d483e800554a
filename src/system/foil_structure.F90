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
  use gfb_partition, only: division_type, divide, chain, no_chain
  use gfb_mesh_dm, only: local_mesh_type, distribute_mesh
  use gfb_foil_pieces, only: number_slots, condense_piece, piece_unknowns, element_geometry, &
                             add_symmetric_block, create_foil_matrix, element_row
  use gfb_super_element, only: super_element_type, destroy_super_element
  use gfb_cost_events, only: enter_stage, leave_stage
  implicit none (type)
  private
  public :: create_foil_structure, destroy_foil_structure, share_kinds

  !> One foil and this rank's part of it.
  type, public :: foil_structure_type
    type(quad_mesh_type) :: mesh             !! the stretch that holds this rank's columns, or more
    type(shell_section_type) :: section
    logical :: reduced = .false.             !! only retained nodes have unknowns
    type(local_mesh_type) :: part            !! this rank's elements and nodes
    type(substructure_type), allocatable :: substructure(:) !! of the whole foil; nodes of this rank's
    integer, allocatable :: mine(:)          !! substructures of this rank
    integer, allocatable :: my_elements(:)   !! elements of this rank, numbers in the whole mesh
    integer, allocatable :: slot(:, :)       !! (5, nodes) unknown's place at its node, 0: none
    logical, allocatable :: free(:, :)       !! (5, nodes) not held by a support
    integer, allocatable :: local_node(:)    !! this rank's number of a node, 0 where it is elsewhere
    integer :: unknowns = 0                  !! on all ranks
    integer :: first = 0                     !! unknowns of the ranks before this one
    integer :: condensations = 0             !! super-elements this rank condensed, each for all ranks
    type(super_element_type), allocatable :: super(:) !! by kind; those that this rank has
    Mat :: stiffness
    logical, private :: created = .false.
    integer, allocatable, private :: column_part(:) !! rank, from 1, of every column of elements
  contains
    procedure :: unknown
    procedure :: numbers_at
    procedure :: owns
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
    integer :: last
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
      call cut_foil(structure, error)
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

  !> Cuts a foil that nothing lies above: between substructures where it is condensed.
  !>
  !> Fails when METIS does.
  subroutine cut_foil(structure, error)
    type(foil_structure_type), intent(inout) :: structure
    type(error_type), allocatable, intent(out) :: error
    type(division_type) :: division
    integer, allocatable :: first(:)
    integer :: i, columns

    columns = structure%mesh%stations - 1
    first = [(i, i=1, columns + 1)]
    if (structure%reduced) first = [structure%substructure%column, columns + 1]
    call divide(no_chain(), chain(real(first, wp), real(first(2:) - first(:size(first) - 1), wp), .false.), &
                rank_count(), division, error)
    if (allocated(error)) return
    allocate (structure%column_part(columns))
    do i = 1, size(first) - 1
      structure%column_part(first(i):first(i + 1) - 1) = division%bumps(i)
    end do
  end subroutine cut_foil

  !> Every column of elements goes to its rank.
  subroutine distribute_foil(structure)
    type(foil_structure_type), intent(inout) :: structure
    integer, allocatable :: node_count(:)
    integer :: i, k, node, width

    associate (mesh => structure%mesh, mine => structure%column_part == this_rank() + 1)
      allocate (node_count(lbound(mesh%position, 2):ubound(mesh%position, 2)))
      do node = lbound(node_count, 1), ubound(node_count, 1)
        node_count(node) = maxval(structure%slot(:, node))
      end do
      call distribute_mesh(PETSC_COMM_WORLD, mesh%stations, mesh%rows, .false., structure%column_part, &
                           structure%part, node_count)
      width = mesh%rows - 1
      structure%my_elements = [((((i - 1)*width + k), k=1, width), i=1, merge(size(mine), 0, width > 0))]
      structure%my_elements = pack(structure%my_elements, [((mine(i), k=1, width), i=1, size(mine))])
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
      if (has(this_rank() + 1, i)) call pass_on(has(:, i), maker(i), structure%super(i))
    end do
  end subroutine condense_kinds

  !> Which rank has which kind of substructure, and which one condenses it: of those that have it the
  !> one with the least to condense.
  pure subroutine share_kinds(kind, part, ranks, has, maker)
    integer, intent(in) :: kind(:) !! of the substructures
    integer, intent(in) :: part(:) !! rank, from 1, of the substructures
    integer, intent(in) :: ranks
    logical, allocatable, intent(out) :: has(:, :)  !! (ranks, kinds)
    integer, allocatable, intent(out) :: maker(:) !! (kinds) rank, from 1
    integer :: burden(ranks), i

    allocate (has(ranks, maxval([0, kind])), source=.false.)
    allocate (maker(size(has, 2)))
    do i = 1, size(kind)
      has(part(i), kind(i)) = .true.
    end do
    burden = 0
    do i = 1, size(maker)
      maker(i) = minloc(burden, 1, mask=has(:, i))
      burden(maker(i)) = burden(maker(i)) + 1
    end do
  end subroutine share_kinds

  !> Hands a condensed matrix from the rank that made it to the others that have the kind; kinds come in
  !> the same order on all ranks, so that nobody waits for ever.
  subroutine pass_on(has, maker, super)
    logical, intent(in) :: has(:)  !! (ranks)
    integer, intent(in) :: maker   !! rank, from 1
    type(super_element_type), intent(inout) :: super
    integer, parameter :: tag = 1
    integer :: rank, entries, status(MPI_STATUS_SIZE)
    PetscErrorCode :: ierr

    entries = size(super%retained)**2
    if (maker /= this_rank() + 1) then
      allocate (super%stiffness(size(super%retained), size(super%retained)))
      call MPI_Recv(super%stiffness, entries, MPI_DOUBLE_PRECISION, maker - 1, tag, PETSC_COMM_WORLD, status, ierr)
      return
    end if
    do rank = 1, size(has)
      if (rank == maker .or. .not. has(rank)) cycle
      call MPI_Send(super%stiffness, entries, MPI_DOUBLE_PRECISION, rank - 1, tag, PETSC_COMM_WORLD, ierr)
    end do
  end subroutine pass_on

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

  !> Which of this rank's unknowns are coupled to those of other ranks: those of elements and
  !> substructures that end where another rank begins.
  pure function at_seam(structure) result(coupled)
    type(foil_structure_type), intent(in) :: structure
    logical :: coupled(structure%part%owned_unknowns)
    logical :: line(structure%mesh%stations)
    integer :: i, first, last, place, unknowns

    line = .false.
    if (structure%reduced) then
      do i = 1, size(structure%mine)
        associate (nodes => structure%substructure(structure%mine(i))%nodes)
          first = (nodes(1) - 1)/structure%mesh%rows + 1
          last = (nodes(size(nodes)) - 1)/structure%mesh%rows + 1
        end associate
        if (is_seam(first) .or. is_seam(last)) line([first, last]) = .true.
      end do
    else
      do i = 1, size(line)
        line(i) = is_seam(i) .or. is_seam(max(1, i - 1)) .or. is_seam(min(size(line), i + 1))
      end do
    end if
    coupled = .false.
    place = 0
    do i = 1, size(structure%part%mesh_node)
      if (.not. structure%part%owned(i)) cycle
      unknowns = maxval(structure%slot(:, structure%part%mesh_node(i)))
      place = structure%part%first_unknown(i) - 1 - structure%first
      coupled(place + 1:place + unknowns) = line((structure%part%mesh_node(i) - 1)/structure%mesh%rows + 1)
    end do

  contains

    !> Whether the columns before and behind a station are different ranks'.
    pure function is_seam(station) result(seam)
      integer, intent(in) :: station
      logical :: seam
      seam = .false.
      if (station == 1 .or. station == structure%mesh%stations) return
      seam = structure%column_part(station - 1) /= structure%column_part(station)
    end function is_seam
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

  !> Whether this rank owns a node.
  pure function owns(self, node) result(mine)
    class(foil_structure_type), intent(in) :: self
    integer, intent(in) :: node !! of the whole mesh
    logical :: mine

    mine = .false.
    if (node < lbound(self%local_node, 1) .or. node > ubound(self%local_node, 1)) return
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
