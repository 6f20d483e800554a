#include "gfb_petsc.h"
!> Distributes a mesh of quadrilaterals over the ranks, by DMPlex.
!>
!> Here, and nowhere else, PETSc's points and offsets (from 0) become our nodes and elements (from 1).
module gfb_mesh_dm
  use, intrinsic :: iso_c_binding, only: c_intptr_t, c_int
  use petscdmplex
  use petscvec
  use gfb_kinds, only: wp
  use gfb_errors, only: error_type
  use gfb_petsc_kinds, only: pint, preal
  use gfb_partition, only: partition_elements
  implicit none (type)
  private
  public :: distribute_mesh

  !> One rank's part of a mesh: its elements, and all their nodes.
  type, public :: local_mesh_type
    integer :: owned_nodes = 0                !! nodes whose unknowns this rank owns
    integer, allocatable :: element_nodes(:, :) !! (4, elements of this rank), local nodes
    integer, allocatable :: mesh_node(:)        !! number in the whole mesh of each local node
    integer, allocatable :: global_node(:)      !! number by owners, contiguous on a rank, from 1
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

  !> Cuts a mesh into parts and gives each rank its own. Elements and positions count on rank 0 only.
  !>
  !> Fails when METIS does.
  subroutine distribute_mesh(communicator, nodes, element_nodes, position, mesh, error)
    integer, intent(in) :: communicator         !! MPI's
    integer, intent(in) :: nodes                !! of the whole mesh
    integer, intent(in) :: element_nodes(:, :)  !! (4, elements) of the whole mesh, from 1
    real(wp), intent(in) :: position(:, :)      !! (2, nodes) [m]
    type(local_mesh_type), intent(out) :: mesh
    type(error_type), allocatable, intent(out) :: error

    DM :: whole, part
    PetscSF :: migration
    PetscErrorCode :: ierr
    integer :: ranks

    call MPI_Comm_size(communicator, ranks, ierr)
    call create_whole(communicator, nodes, element_nodes, position, whole)
    if (ranks == 1) then
      call read_local_mesh(whole, whole, .false., mesh)
    else
      call set_partition(communicator, whole, nodes, element_nodes, ranks, error)
      if (allocated(error)) return
      call add_node_section(whole)
      PetscCallA(DMSetUseNatural(whole, PETSC_TRUE, ierr))
      PetscCallA(DMPlexDistribute(whole, 0_pint, migration, part, ierr))
      PetscCallA(PetscSFDestroy(migration, ierr))
      call add_node_section(part)
      call read_local_mesh(whole, part, .true., mesh)
      PetscCallA(DMDestroy(part, ierr))
    end if
    PetscCallA(DMDestroy(whole, ierr))
  end subroutine distribute_mesh

  !> A DMPlex that holds the whole mesh on rank 0: cells and vertices, no edges, as none has unknowns.
  subroutine create_whole(communicator, nodes, element_nodes, position, whole)
    integer, intent(in) :: communicator
    integer, intent(in) :: nodes
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
      vertex_count = nodes
    else
      allocate (cells(1), source=0_pint)
      allocate (coordinates(2), source=0.0_preal)
      cell_count = 0
      vertex_count = 0
    end if
    PetscCallA(DMPlexCreateFromCellListPetsc(communicator, 2_pint, cell_count, vertex_count, 4_pint, PETSC_FALSE, cells, 2_pint, coordinates, whole, ierr))
    if (rank_count_of(communicator) == 1) call add_node_section(whole)
  end subroutine create_whole

  !> Ranks of a communicator.
  function rank_count_of(communicator) result(ranks)
    integer, intent(in) :: communicator
    integer :: ranks
    PetscErrorCode :: ierr
    call MPI_Comm_size(communicator, ranks, ierr)
  end function rank_count_of

  !> Tells the DMPlex which rank each element goes to.
  subroutine set_partition(communicator, whole, nodes, element_nodes, ranks, error)
    integer, intent(in) :: communicator
    DM, intent(in) :: whole
    integer, intent(in) :: nodes
    integer, intent(in) :: element_nodes(:, :)
    integer, intent(in) :: ranks
    type(error_type), allocatable, intent(out) :: error

    integer, allocatable :: element_part(:)
    PetscInt, allocatable :: sizes(:), cells(:)
    integer :: rank, part, element, filled
    PetscErrorCode :: ierr

    call MPI_Comm_rank(communicator, rank, ierr)
    allocate (sizes(ranks), source=0_pint)
    allocate (cells(max(1, size(element_nodes, 2))), source=0_pint)
    if (rank == 0) then
      call partition_elements(element_nodes, nodes, ranks, element_part, error)
    end if
    if (failed_anywhere(communicator, error)) return
    if (rank == 0) then
      filled = 0
      do part = 1, ranks
        sizes(part) = count(element_part == part)
        do element = 1, size(element_part)
          if (element_part(element) /= part) cycle
          filled = filled + 1
          cells(filled) = element - 1
        end do
      end do
    end if
    if (gfb_set_shell_partition(int(whole%v, c_intptr_t), int(ranks, pint), sizes, cells) /= 0) then
      error stop 'PETSc refused the partition'
    end if
  end subroutine set_partition

  !> Whether any rank has an error; the ranks without one get a copy that says so.
  function failed_anywhere(communicator, error) result(failed)
    integer, intent(in) :: communicator
    type(error_type), allocatable, intent(inout) :: error
    logical :: failed
    PetscErrorCode :: ierr

    call MPI_Allreduce(allocated(error), failed, 1, MPI_LOGICAL, MPI_LOR, communicator, ierr)
    if (failed .and. .not. allocated(error)) then
      allocate (error)
      error%message = 'another rank failed'
    end if
  end function failed_anywhere

  !> One unknown at every vertex.
  subroutine add_node_section(plex)
    DM, intent(in) :: plex
    PetscSection :: section
    PetscInt :: first, last, vertex
    PetscErrorCode :: ierr

    PetscCallA(PetscSectionCreate(PETSC_COMM_WORLD, section, ierr))
    PetscCallA(DMPlexGetChart(plex, first, last, ierr))
    PetscCallA(PetscSectionSetChart(section, first, last, ierr))
    PetscCallA(DMPlexGetDepthStratum(plex, 0_pint, first, last, ierr))
    do vertex = first, last - 1
      PetscCallA(PetscSectionSetDof(section, vertex, 1_pint, ierr))
    end do
    PetscCallA(PetscSectionSetUp(section, ierr))
    PetscCallA(DMSetLocalSection(plex, section, ierr))
    PetscCallA(PetscSectionDestroy(section, ierr))
  end subroutine add_node_section

  !> Nodes and elements of this rank's part as plain arrays.
  subroutine read_local_mesh(whole, part, distributed, mesh)
    DM, intent(in) :: whole        !! before distribution
    DM, intent(in) :: part         !! after it
    logical, intent(in) :: distributed
    type(local_mesh_type), intent(out) :: mesh

    PetscSection :: section
    PetscInt :: first_cell, end_cell, first_vertex, end_vertex, vertex, cell, offset
    PetscInt, pointer :: corners(:)
    PetscErrorCode :: ierr
    integer :: k, nodes

    PetscCallA(DMPlexGetHeightStratum(part, 0_pint, first_cell, end_cell, ierr))
    PetscCallA(DMPlexGetDepthStratum(part, 0_pint, first_vertex, end_vertex, ierr))
    nodes = int(end_vertex - first_vertex)
    allocate (mesh%global_node(nodes), mesh%owned(nodes))
    PetscCallA(DMGetGlobalSection(part, section, ierr))
    do vertex = first_vertex, end_vertex - 1
      PetscCallA(PetscSectionGetOffset(section, vertex, offset, ierr))
      k = int(vertex - first_vertex) + 1
      mesh%owned(k) = offset >= 0
      mesh%global_node(k) = int(merge(offset, -(offset + 1), offset >= 0)) + 1
    end do
    mesh%owned_nodes = count(mesh%owned)

    allocate (mesh%element_nodes(4, end_cell - first_cell))
    nullify (corners)
    do cell = first_cell, end_cell - 1
      PetscCallA(DMPlexGetCone(part, cell, corners, ierr))
      mesh%element_nodes(:, cell - first_cell + 1) = int(corners - first_vertex) + 1
      PetscCallA(DMPlexRestoreCone(part, cell, corners, ierr))
    end do
    call number_nodes(part, distributed, mesh)
  end subroutine read_local_mesh

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
      mesh%mesh_node = [(i, i=1, size(mesh%owned))]
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
