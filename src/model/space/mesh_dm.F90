#include "gfb_petsc.h"
!> Distributes a mesh of stations and rows over the ranks, by DMPlex.
!>
!> Every rank gives an equal share of the columns of elements, none the whole mesh; DMPlex carries the
!> columns to the ranks that the partition says. A vertex is known by its station and row, which are
!> its coordinates there.
!>
!> Here, and nowhere else, PETSc's points and offsets (from 0) become our nodes and elements (from
!> 1).
module gfb_mesh_dm
  use, intrinsic :: iso_c_binding, only: c_intptr_t, c_int
  use petscdmplex
  use petscvec
  use gfb_kinds, only: wp
  use gfb_petsc_kinds, only: pint, preal
  use gfb_film_mesh, only: cell_nodes
  implicit none (type)
  private
  public :: distribute_mesh, columns_window

  !> One rank's part of a mesh: its elements, and all their nodes.
  type, public :: local_mesh_type
    integer :: owned_unknowns = 0               !! unknowns this rank owns
    integer, allocatable :: element_nodes(:, :) !! (4, elements of this rank), local nodes
    integer, allocatable :: mesh_node(:)        !! number in the whole mesh of each local node
    integer, allocatable :: first_unknown(:)    !! of each local node: by owners, from 1
    logical, allocatable :: owned(:)            !! whether this rank owns the local node
  end type local_mesh_type

  integer, parameter :: corners = 4

  interface
    function gfb_create_plex(communicator, cells, vertices, all_vertices, cell, coordinate, dm) result(status) bind(c)
      import :: c_intptr_t, c_int, pint, preal
      integer, value :: communicator
      integer(pint), value :: cells, vertices, all_vertices
      integer(pint), intent(in) :: cell(*)
      real(preal), intent(in) :: coordinate(*)
      integer(c_intptr_t), intent(out) :: dm
      integer(c_int) :: status
    end function gfb_create_plex
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
  !> Node (station i, row j) is number (i - 1)*rows + j.
  subroutine distribute_mesh(communicator, stations, rows, periodic, column_part, mesh, node_unknowns)
    integer, intent(in) :: communicator    !! MPI's
    integer, intent(in) :: stations, rows  !! of the whole mesh
    logical, intent(in) :: periodic        !! the last station's neighbour is the first
    integer, intent(in) :: column_part(:)  !! rank, from 1, of every column of elements
    type(local_mesh_type), intent(out) :: mesh !! this rank's part
    !> unknowns at the nodes, under their numbers in the whole mesh, at least of this rank's columns;
    !> default: one each
    integer, allocatable, intent(in), optional :: node_unknowns(:)

    DM :: whole, part
    PetscSF :: migration
    PetscErrorCode :: ierr
    integer :: ranks, i

    call MPI_Comm_size(communicator, ranks, ierr)
    call create_whole(communicator, stations, rows, periodic, whole)
    if (ranks == 1) then
      part = whole
    else
      call set_partition(communicator, whole, column_part, rows - 1)
      PetscCallA(DMPlexDistribute(whole, 0_pint, migration, part, ierr))
      PetscCallA(PetscSFDestroy(migration, ierr))
    end if
    call read_elements(part, mesh)
    call number_nodes(part, rows, mesh)
    if (present(node_unknowns)) then
      call set_section(part, node_unknowns(mesh%mesh_node))
    else
      call set_section(part, [(1, i=1, size(mesh%mesh_node))])
    end if
    call number_unknowns(part, mesh)
    PetscCallA(DMDestroy(part, ierr))
    if (ranks > 1) then
      PetscCallA(DMDestroy(whole, ierr))
    end if
  end subroutine distribute_mesh

  !> First and last station of a rank's columns; the last before the first where it has none.
  pure function columns_window(column_part, part) result(window)
    integer, intent(in) :: column_part(:) !! rank, from 1, of every column of elements
    integer, intent(in) :: part           !! rank, from 1
    integer :: window(2)

    window = [1, 0]
    if (any(column_part == part)) then
      window = [findloc(column_part, part, 1), findloc(column_part, part, 1, back=.true.) + 1]
    end if
  end function columns_window

  !> This rank's share of the columns before the mesh is distributed: those after the first, up to the
  !> second number.
  subroutine starting_share(communicator, columns, share)
    integer, intent(in) :: communicator, columns
    integer, intent(out) :: share(2)
    PetscErrorCode :: ierr
    integer :: rank, ranks

    call MPI_Comm_rank(communicator, rank, ierr)
    call MPI_Comm_size(communicator, ranks, ierr)
    share = [rank, rank + 1]*columns/ranks
  end subroutine starting_share

  !> A DMPlex of which every rank holds a share: cells and vertices, no edges, as none has unknowns.
  subroutine create_whole(communicator, stations, rows, periodic, whole)
    integer, intent(in) :: communicator, stations, rows
    logical, intent(in) :: periodic
    DM, intent(out) :: whole

    PetscInt, allocatable :: cells(:, :)
    PetscReal, allocatable :: coordinates(:, :)
    integer(c_intptr_t) :: handle
    integer :: columns, share(2), last, column, station, row, cell

    columns = merge(stations, stations - 1, periodic)
    call starting_share(communicator, columns, share)
    last = share(2) ! stations too are shared out, each once
    if (share(2) == columns) last = stations
    allocate (cells(corners, max(1, (share(2) - share(1))*(rows - 1))), source=0_pint)
    cell = 0
    do column = share(1) + 1, share(2)
      do row = 1, rows - 1
        cell = cell + 1
        cells(:, cell) = int(cell_nodes(column, row, stations, rows) - 1, pint)
      end do
    end do
    allocate (coordinates(2, max(1, (last - share(1))*rows)), source=0.0_preal)
    do station = share(1) + 1, last
      do row = 1, rows
        coordinates(:, (station - share(1) - 1)*rows + row) = real([station, row], preal)
      end do
    end do
    if (gfb_create_plex(communicator, int(cell, pint), int((last - share(1))*rows, pint), int(stations*rows, pint), &
                        cells, coordinates, handle) /= 0) error stop 'PETSc refused the mesh'
    whole%v = handle
  end subroutine create_whole

  !> Gives the DMPlex the rank that each of this rank's cells goes to.
  subroutine set_partition(communicator, whole, column_part, cells_a_column)
    integer, intent(in) :: communicator, column_part(:), cells_a_column
    DM, intent(in) :: whole

    PetscInt, allocatable :: sizes(:), cells(:)
    integer :: part, column, filled, share(2), ranks, i
    PetscErrorCode :: ierr

    call MPI_Comm_size(communicator, ranks, ierr)
    call starting_share(communicator, size(column_part), share)
    allocate (sizes(ranks), source=0_pint)
    allocate (cells(max(1, (share(2) - share(1))*cells_a_column)), source=0_pint)
    filled = 0
    do part = 1, ranks
      sizes(part) = count(column_part(share(1) + 1:share(2)) == part)*cells_a_column
      do column = share(1) + 1, share(2)
        if (column_part(column) /= part) cycle
        cells(filled + 1:filled + cells_a_column) = &
          [(int((column - share(1) - 1)*cells_a_column + i - 1, pint), i=1, cells_a_column)]
        filled = filled + cells_a_column
      end do
    end do
    if (gfb_set_shell_partition(int(whole%v, c_intptr_t), int(ranks, pint), sizes, cells) /= 0) then
      error stop 'PETSc refused the partition'
    end if
  end subroutine set_partition

  !> Unknowns at every vertex.
  subroutine set_section(plex, unknowns)
    DM, intent(in) :: plex
    integer, intent(in) :: unknowns(:) !! of the local nodes
    PetscSection :: section
    PetscInt :: first, last, first_vertex, end_vertex, vertex
    PetscErrorCode :: ierr

    PetscCallA(PetscSectionCreate(PETSC_COMM_WORLD, section, ierr))
    PetscCallA(DMPlexGetChart(plex, first, last, ierr))
    PetscCallA(PetscSectionSetChart(section, first, last, ierr))
    PetscCallA(DMPlexGetDepthStratum(plex, 0_pint, first_vertex, end_vertex, ierr))
    do vertex = first_vertex, end_vertex - 1
      PetscCallA(PetscSectionSetDof(section, vertex, int(unknowns(vertex - first_vertex + 1), pint), ierr))
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
    PetscInt, pointer :: cone(:)
    PetscErrorCode :: ierr

    PetscCallA(DMPlexGetHeightStratum(part, 0_pint, first_cell, end_cell, ierr))
    PetscCallA(DMPlexGetDepthStratum(part, 0_pint, first_vertex, end_vertex, ierr))
    allocate (mesh%mesh_node(end_vertex - first_vertex), source=0)
    allocate (mesh%element_nodes(4, end_cell - first_cell))
    nullify (cone)
    do cell = first_cell, end_cell - 1
      PetscCallA(DMPlexGetCone(part, cell, cone, ierr))
      mesh%element_nodes(:, cell - first_cell + 1) = int(cone - first_vertex) + 1
      PetscCallA(DMPlexRestoreCone(part, cell, cone, ierr))
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

  !> The whole mesh's number of every local node, from its station and row.
  subroutine number_nodes(part, rows, mesh)
    DM, intent(in) :: part
    integer, intent(in) :: rows
    type(local_mesh_type), intent(inout) :: mesh

    Vec :: places
    PetscScalar, pointer :: place(:)
    PetscErrorCode :: ierr
    integer :: i

    PetscCallA(DMGetCoordinatesLocal(part, places, ierr))
    PetscCallA(GFB_VecGetArrayRead(places, place, ierr))
    do i = 1, size(mesh%mesh_node)
      mesh%mesh_node(i) = (nint(place(2*i - 1)) - 1)*rows + nint(place(2*i))
    end do
    PetscCallA(GFB_VecRestoreArrayRead(places, place, ierr))
  end subroutine number_nodes
end module gfb_mesh_dm
