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
  use gfb_petsc_kinds, only: pint
  use gfb_petsc_session, only: fetch_entries
  use gfb_shell_geometry, only: node_unknowns
  use gfb_substructures, only: substructure_type
  use gfb_foil_surface, only: foil_surface_type
  use gfb_foil_pieces, only: piece_unknowns, element_row
  use gfb_super_element, only: super_element_type, destroy_super_element
  implicit none (type)
  private
  public :: destroy_foil_structure

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
    procedure :: unknown
    procedure :: numbers_at
    procedure :: natural_numbers
    procedure :: displacements
    procedure :: row_entries
  end type foil_structure_type

contains

  !> Entries of a row of the foil's matrix, at most.
  pure function row_entries(self) result(entries)
    class(foil_structure_type), intent(in) :: self !! the foil
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
  pure function unknown(self, component, node) result(number)
    class(foil_structure_type), intent(in) :: self !! the foil
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
