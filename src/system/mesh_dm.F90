#include "gfb_petsc.h"
!> Distributes a mesh of quadrilaterals over the ranks, by DMPlex.
!>
!> Here, and nowhere else, PETSc's points and offsets (from 0) become our nodes and elements (from
!> 1).
module gfb_mesh_dm
  use, intrinsic :: iso_c_binding, only: c_intptr_t, c_int
  use petscdmplex
  use petscvec
  use gfb_kinds, only: wp
  use gfb_petsc_kinds, only: pint, preal
  implicit none (type)
  private
  public :: distribute_mesh

  !> One rank's part of a mesh: its elements, and all their nodes.
  type, public :: local_mesh_type
    integer :: owned_unknowns = 0               !! unknowns this rank owns
    integer, allocatable :: element_nodes(:, :) !! (4, elements of this rank), local nodes
    integer, allocatable :: mesh_node(:)        !! number in the whole mesh of each local node
    integer, allocatable :: first_unknown(:)    !! of each local node: by owners, from 1
    logical, allocatable :: owned(:)            !! whether this rank owns the local node
  end type local_mesh_type

  interface
    function gfb_set_shell_partition(dm, parts, sizes, cells) result(status) bind(c)
      import :: c_intptr_t, c_int, pint
      integer(c_intptr_t), value :: dm
      integer(pint), value :: parts
      integer(pint), intent(in) :: sizes(*), cells(*)
      integer(c_int) :: status
    end function gfb_set_shell_partition
  end interface

contains

  !> Gives each rank its part of a mesh, and numbers the unknowns of its nodes.
  !>
  !> Elements, their parts and positions count on rank 0 only, the nodes' unknowns on all ranks.
  subroutine distribute_mesh(communicator, element_nodes, element_part, position, node_unknowns, mesh)
    integer, intent(in) :: communicator         !! MPI's
    integer, intent(in) :: element_nodes(:, :)  !! (4, elements) of the whole mesh, from 1
    integer, intent(in) :: element_part(:)      !! rank of every element, from 1
    real(wp), intent(in) :: position(:, :)      !! (2 or 3, nodes) [m]
    integer, intent(in) :: node_unknowns(:)     !! unknowns at every node of the whole mesh
    type(local_mesh_type), intent(out) :: mesh

    DM :: whole, part
    PetscSF :: migration
    PetscErrorCode :: ierr
    integer :: ranks

    call MPI_Comm_size(communicator, ranks, ierr)
    call create_whole(communicator, element_nodes, position, whole)
    if (ranks == 1) then
      part = whole
    else
      call set_partition(whole, element_part, ranks)
      call set_section(whole)
      PetscCallA(DMSetUseNatural(whole, PETSC_TRUE, ierr))
      PetscCallA(DMPlexDistribute(whole, 0_pint, migration, part, ierr))
      PetscCallA(PetscSFDestroy(migration, ierr))
      call set_section(part)
    end if
    call read_elements(part, mesh)
    call number_nodes(part, ranks > 1, mesh)
    call set_section(part, node_unknowns(mesh%mesh_node))
    call number_unknowns(part, mesh)
    PetscCallA(DMDestroy(part, ierr))
    if (ranks > 1) then
      PetscCallA(DMDestroy(whole, ierr))
    end if
  end subroutine distribute_mesh

  !> A DMPlex that holds the whole mesh on rank 0: cells and vertices, no edges, as none has
  !> unknowns.
  subroutine create_whole(communicator, element_nodes, position, whole)
    integer, intent(in) :: communicator
    integer, intent(in) :: element_nodes(:, :)
    real(wp), intent(in) :: position(:, :)
    DM, intent(out) :: whole

    PetscInt, allocatable :: cells(:)
    PetscReal, allocatable :: coordinates(:)
    PetscInt :: cell_count, vertex_count
    PetscErrorCode :: ierr
    integer :: rank

    call MPI_Comm_rank(communicator, rank, ierr)
    if (rank == 0) then
      cells = int(reshape(element_nodes, [size(element_nodes)]) - 1, pint)
      coordinates = reshape(position, [size(position)])
      cell_count = size(element_nodes, 2)
      vertex_count = size(position, 2)
    else
      allocate (cells(1), source=0_pint)
      allocate (coordinates(2), source=0.0_preal)
      cell_count = 0
      vertex_count = 0
    end if
    PetscCallA(DMPlexCreateFromCellListPetsc(communicator, 2_pint, cell_count, vertex_count, 4_pint, PETSC_FALSE, cells, int(size(position, 1), pint), coordinates, whole, ierr))
  end subroutine create_whole

  !> Tells the DMPlex which rank each element goes to.
  subroutine set_partition(whole, element_part, ranks)
    DM, intent(in) :: whole
    integer, intent(in) :: element_part(:)
    integer, intent(in) :: ranks

    PetscInt, allocatable :: sizes(:), cells(:)
    integer :: part, element, filled

    allocate (sizes(ranks), source=0_pint)
    allocate (cells(max(1, size(element_part))), source=0_pint)
    filled = 0
    do part = 1, ranks
      sizes(part) = count(element_part == part)
      do element = 1, size(element_part)
        if (element_part(element) /= part) cycle
        filled = filled + 1
        cells(filled) = element - 1
      end do
    end do
    if (gfb_set_shell_partition(int(whole%v, c_intptr_t), int(ranks, pint), sizes, cells) /= 0) then
      error stop 'PETSc refused the partition'
    end if
  end subroutine set_partition

  !> Unknowns at every vertex, one where not said.
  subroutine set_section(plex, unknowns)
    DM, intent(in) :: plex
    integer, intent(in), optional :: unknowns(:) !! of the local nodes
    PetscSection :: section
    PetscInt :: first, last, first_vertex, end_vertex, vertex
    PetscErrorCode :: ierr

    PetscCallA(PetscSectionCreate(PETSC_COMM_WORLD, section, ierr))
    PetscCallA(DMPlexGetChart(plex, first, last, ierr))
    PetscCallA(PetscSectionSetChart(section, first, last, ierr))
    PetscCallA(DMPlexGetDepthStratum(plex, 0_pint, first_vertex, end_vertex, ierr))
    do vertex = first_vertex, end_vertex - 1
      if (present(unknowns)) then
        PetscCallA(PetscSectionSetDof(section, vertex, int(unknowns(vertex - first_vertex + 1), pint), ierr))
      else
        PetscCallA(PetscSectionSetDof(section, vertex, 1_pint, ierr))
      end if
    end do
    PetscCallA(PetscSectionSetUp(section, ierr))
    PetscCallA(DMSetLocalSection(plex, section, ierr))
    PetscCallA(PetscSectionDestroy(section, ierr))
  end subroutine set_section

  !> Elements of this rank's part as plain arrays.
  subroutine read_elements(part, mesh)
    DM, intent(in) :: part
    type(local_mesh_type), intent(inout) :: mesh

    PetscInt :: first_cell, end_cell, first_vertex, end_vertex, cell
    PetscInt, pointer :: corners(:)
    PetscErrorCode :: ierr

    PetscCallA(DMPlexGetHeightStratum(part, 0_pint, first_cell, end_cell, ierr))
    PetscCallA(DMPlexGetDepthStratum(part, 0_pint, first_vertex, end_vertex, ierr))
    allocate (mesh%mesh_node(end_vertex - first_vertex), source=0)
    allocate (mesh%element_nodes(4, end_cell - first_cell))
    nullify (corners)
    do cell = first_cell, end_cell - 1
      PetscCallA(DMPlexGetCone(part, cell, corners, ierr))
      mesh%element_nodes(:, cell - first_cell + 1) = int(corners - first_vertex) + 1
      PetscCallA(DMPlexRestoreCone(part, cell, corners, ierr))
    end do
  end subroutine read_elements

  !> Global numbers of the unknowns, and who owns the nodes.
  subroutine number_unknowns(part, mesh)
    DM, intent(in) :: part
    type(local_mesh_type), intent(inout) :: mesh

    PetscSection :: section
    PetscInt :: first_vertex, end_vertex, vertex, offset, unknowns
    PetscErrorCode :: ierr
    integer :: node

    PetscCallA(DMPlexGetDepthStratum(part, 0_pint, first_vertex, end_vertex, ierr))
    allocate (mesh%first_unknown(size(mesh%mesh_node)), mesh%owned(size(mesh%mesh_node)))
    PetscCallA(DMGetGlobalSection(part, section, ierr))
    mesh%owned_unknowns = 0
    do vertex = first_vertex, end_vertex - 1
      PetscCallA(PetscSectionGetOffset(section, vertex, offset, ierr))
      PetscCallA(PetscSectionGetDof(section, vertex, unknowns, ierr))
      node = int(vertex - first_vertex) + 1
      mesh%owned(node) = offset >= 0
      mesh%first_unknown(node) = int(merge(offset, -(offset + 1), offset >= 0)) + 1
      if (mesh%owned(node)) mesh%owned_unknowns = mesh%owned_unknowns + int(max(unknowns, 0_pint))
    end do
  end subroutine number_unknowns

  !> The whole mesh's number of every local node: the numbers travel as a field of the whole mesh.
  subroutine number_nodes(part, distributed, mesh)
    DM, intent(in) :: part
    logical, intent(in) :: distributed
    type(local_mesh_type), intent(inout) :: mesh

    Vec :: natural, global, local
    PetscScalar, pointer :: numbers(:)
    PetscInt :: first, last
    PetscErrorCode :: ierr
    integer :: i

    if (.not. distributed) then
      mesh%mesh_node = [(i, i=1, size(mesh%mesh_node))]
      return
    end if
    PetscCallA(DMPlexCreateNaturalVector(part, natural, ierr))
    PetscCallA(VecGetOwnershipRange(natural, first, last, ierr))
    PetscCallA(GFB_VecGetArray(natural, numbers, ierr))
    numbers = [(real(first + i, wp), i=1, int(last - first))]
    PetscCallA(GFB_VecRestoreArray(natural, numbers, ierr))
    PetscCallA(DMGetGlobalVector(part, global, ierr))
    PetscCallA(DMPlexNaturalToGlobalBegin(part, natural, global, ierr))
    PetscCallA(DMPlexNaturalToGlobalEnd(part, natural, global, ierr))
    PetscCallA(DMGetLocalVector(part, local, ierr))
    PetscCallA(DMGlobalToLocalBegin(part, global, INSERT_VALUES, local, ierr))
    PetscCallA(DMGlobalToLocalEnd(part, global, INSERT_VALUES, local, ierr))
    PetscCallA(GFB_VecGetArrayRead(local, numbers, ierr))
    mesh%mesh_node = nint(numbers)
    PetscCallA(GFB_VecRestoreArrayRead(local, numbers, ierr))
    PetscCallA(DMRestoreLocalVector(part, local, ierr))
    PetscCallA(DMRestoreGlobalVector(part, global, ierr))
    PetscCallA(VecDestroy(natural, ierr))
  end subroutine number_nodes
end module gfb_mesh_dm
