#include "gfb_petsc.h"
!> Builds a foil of shells: cuts it among the ranks, condenses its substructures, assembles its
!> matrices.
module gfb_foil_assembly
  use petscsys
  use petscmat
  use gfb_kinds, only: wp
  use gfb_errors, only: error_type, add_context
  use gfb_petsc_session, only: this_rank, share_failure, rank_count
  use gfb_partition, only: division_type, divide, chain, no_chain
  use gfb_text, only: text
  use gfb_shell_geometry, only: shell_section_type, shell_nodes, node_unknowns, shell_unknowns
  use gfb_shell_element, only: shell_stiffness
  use gfb_shell_mass, only: shell_mass
  use gfb_quad_mesh, only: quad_mesh_type, solid_rows
  use gfb_substructures, only: substructure_type, kind_count
  use gfb_mesh_dm, only: distribute_mesh
  use gfb_foil_structure, only: number_slots, condense_piece, element_geometry, element_section, add_symmetric_block, &
                                create_foil_matrix, foil_structure_type
  use gfb_cost_events, only: enter_stage, leave_stage
  implicit none (type)
  private
  public :: share_kinds, pass_on, create_foil_structure, assemble_mass, element_unknowns, retained_unknowns

contains

  !> Shares out the columns of a foil that nothing lies above; those of a piece stay together.
  !>
  !> Fails when METIS does.
  subroutine cut_columns(first, ranks, column_part, error)
    integer, intent(in) :: first(:) !! first column of every piece, and one beyond the last
    integer, intent(in) :: ranks !! number of ranks
    integer, allocatable, intent(out) :: column_part(:) !! rank, from 1, of every column
    type(error_type), allocatable, intent(out) :: error !! error, if METIS fails
    type(division_type) :: division
    integer :: i, pieces

    pieces = size(first) - 1
    call divide(no_chain(), chain(real(first, wp), real(first(2:) - first(:pieces), wp), .false.), ranks, division, error)
    if (allocated(error)) return
    allocate (column_part(first(pieces + 1) - 1))
    do i = 1, pieces
      column_part(first(i):first(i + 1) - 1) = division%bumps(i)
    end do
  end subroutine cut_columns

  !> Which rank has which kind of substructure, and which one condenses it: of those that have it the
  !> one with the least to condense.
  pure subroutine share_kinds(kind, part, ranks, has, maker)
    integer, intent(in) :: kind(:) !! of the substructures
    integer, intent(in) :: part(:) !! rank, from 1, of the substructures
    integer, intent(in) :: ranks !! number of ranks
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

  !> Hands a kind's matrix from the rank that made it to the others that have the kind; kinds come in the
  !> same order on all ranks, so that nobody waits for ever.
  subroutine pass_on(has, maker, order, matrix)
    logical, intent(in) :: has(:)  !! (ranks)
    integer, intent(in) :: maker   !! rank, from 1
    integer, intent(in) :: order   !! of the matrix
    real(wp), allocatable, intent(inout) :: matrix(:, :) !! there on the rank that made it [SI]
    integer, parameter :: tag = 1
    integer :: rank, entries, status(MPI_STATUS_SIZE)
    PetscErrorCode :: ierr

    entries = order**2
    if (maker /= this_rank() + 1) then
      allocate (matrix(order, order))
      call MPI_Recv(matrix, entries, MPI_DOUBLE_PRECISION, maker - 1, tag, PETSC_COMM_WORLD, status, ierr)
      return
    end if
    do rank = 1, size(has)
      if (rank == maker .or. .not. has(rank)) cycle
      call MPI_Send(matrix, entries, MPI_DOUBLE_PRECISION, rank - 1, tag, PETSC_COMM_WORLD, ierr)
    end do
  end subroutine pass_on

  !> Which lines of nodes belong to a piece that ends where another rank begins.
  pure function lines_at_seams(column_part, ends) result(line)
    integer, intent(in) :: column_part(:) !! rank, from 1, of every column of elements
    integer, intent(in) :: ends(:, :)     !! (2, pieces) first and last station
    logical :: line(size(column_part) + 1)
    integer :: i

    line = .false.
    do i = 1, size(ends, 2)
      if (is_seam(ends(1, i)) .or. is_seam(ends(2, i))) line(ends(:, i)) = .true.
    end do

  contains

    !> Whether the columns before and behind a station are different ranks'.
    pure logical function is_seam(station) result(seam)
      integer, intent(in) :: station

      seam = .false.
      if (station == 1 .or. station > size(column_part)) return
      seam = column_part(station - 1) /= column_part(station)
    end function is_seam
  end function lines_at_seams

  !> Numbers the unknowns, condenses the substructures and assembles the stiffness.
  !>
  !> Fails where an element is clockwise or degenerate.
  subroutine create_foil_structure(mesh, section, fixed, substructure, reduced, structure, error, column_part)
    type(quad_mesh_type), intent(in) :: mesh          !! this rank's columns at least
    type(shell_section_type), intent(in) :: section !! thickness and material
    !> (5, nodes) fixed by supports or symmetry, under the mesh's numbers
    logical, allocatable, intent(in) :: fixed(:, :)
    !> every column in one of them, in order; none where nothing is condensed
    type(substructure_type), intent(in) :: substructure(:)
    logical, intent(in) :: reduced                    !! condense the substructures
    type(foil_structure_type), intent(out) :: structure !! with its stiffness
    type(error_type), allocatable, intent(out) :: error !! error, if the foil cannot be cut or an element is degenerate
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
    call assemble_stiffness(structure, structure%stiffness, error)
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
      if (allocated(mesh%cut)) then
        structure%my_elements = pack(structure%my_elements, [(solid_rows(mesh), i=1, size(columns))])
      end if
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
  subroutine assemble_stiffness(structure, matrix, error)
    type(foil_structure_type), intent(in) :: structure
    Mat, intent(out) :: matrix
    type(error_type), allocatable, intent(out) :: error

    real(wp) :: block(shell_unknowns, shell_unknowns)
    PetscErrorCode :: ierr
    integer :: i

    call create_foil_matrix(structure%row_entries(), at_seam(structure), structure%unknowns, matrix)
    if (structure%reduced) then
      do i = 1, size(structure%mine)
        associate (one => structure%substructure(structure%mine(i)))
          call add_symmetric_block(matrix, retained_unknowns(structure, one), structure%super(one%kind)%stiffness)
        end associate
      end do
    else
      PetscCallA(MatSetOption(matrix, MAT_IGNORE_ZERO_ENTRIES, PETSC_TRUE, ierr))
      do i = 1, size(structure%my_elements)
        call shell_stiffness(element_geometry(structure%mesh, structure%my_elements(i)), &
                             element_section(structure%mesh, structure%section, structure%my_elements(i)), block, error)
        if (allocated(error)) exit
        call add_symmetric_block(matrix, element_unknowns(structure, structure%my_elements(i)), block)
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
  subroutine assemble_mass(structure, matrix, error)
    type(foil_structure_type), intent(in) :: structure !! not condensed
    Mat, intent(out) :: matrix !! of the numbered unknowns
    type(error_type), allocatable, intent(out) :: error !! error, if an element is degenerate

    real(wp) :: block(shell_unknowns, shell_unknowns)
    PetscErrorCode :: ierr
    integer :: i

    if (structure%reduced) error stop 'a condensed foil has no mass matrix of its own'
    call create_foil_matrix(structure%row_entries(), at_seam(structure), structure%unknowns, matrix)
    do i = 1, size(structure%my_elements)
      call shell_mass(element_geometry(structure%mesh, structure%my_elements(i)), &
                      element_section(structure%mesh, structure%section, structure%my_elements(i)), block, error)
      if (allocated(error)) exit
      call add_symmetric_block(matrix, element_unknowns(structure, structure%my_elements(i)), block)
    end do
    call share_failure(error)
    PetscCallA(MatAssemblyBegin(matrix, MAT_FINAL_ASSEMBLY, ierr))
    PetscCallA(MatAssemblyEnd(matrix, MAT_FINAL_ASSEMBLY, ierr))
    PetscCallA(MatSetOption(matrix, MAT_SYMMETRIC, PETSC_TRUE, ierr))
  end subroutine assemble_mass

  !> Which of this rank's unknowns are coupled to those of other ranks.
  pure function at_seam(structure) result(coupled)
    type(foil_structure_type), intent(in) :: structure
    logical :: coupled(structure%part%owned_unknowns)
    logical :: line(structure%mesh%stations)
    integer :: i, k, ends(2, size(structure%mine)), before, unknowns

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
      before = structure%part%first_unknown(i) - 1 - structure%first
      coupled(before + 1:before + unknowns) = line((structure%part%mesh_node(i) - 1)/structure%mesh%rows + 1)
    end do
  end function at_seam

  !> Global numbers of an element's unknowns.
  pure function element_unknowns(structure, element) result(number)
    type(foil_structure_type), intent(in) :: structure !! the foil
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
    type(foil_structure_type), intent(in) :: structure !! the foil
    type(substructure_type), intent(in) :: substructure !! of the foil, on this rank
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
end module gfb_foil_assembly
