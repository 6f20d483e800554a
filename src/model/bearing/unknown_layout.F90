#include "gfb_petsc.h"
!> Where the bearing's unknowns stand: on each rank film, foil, and on the last one the shaft.
module gfb_unknown_layout
  use petscmat
  use gfb_petsc_kinds, only: pint
  use gfb_mesh_dm, only: local_mesh_type
  use gfb_foil_model, only: foil_model_type
  implicit none (type)
  private
  public :: create_layout, create_coupled_matrix

  integer, parameter, public :: shaft_unknowns = 2 !! e_x, e_y

  !> Numbers of the unknowns.
  type, public :: unknown_layout_type
    integer :: owned = 0                !! unknowns this rank owns
    integer :: unknowns = 0             !! on all ranks
    integer :: shaft = 0                !! of them the shaft's: 2 where it floats, 0 where it is held
    logical :: last_rank = .false.      !! this rank owns the shaft's equations
    PetscInt, allocatable :: global(:)  !! number, from 0, of every local unknown
    integer, allocatable, private :: film_end(:), foil_end(:) !! (0:ranks) unknowns of the ranks so far
  contains
    procedure :: of_foil
  end type unknown_layout_type

contains

  !> Numbers the local unknowns: film nodes, foil, shaft.
  subroutine create_layout(mesh, foil, floats, layout)
    type(local_mesh_type), intent(in) :: mesh
    class(foil_model_type), intent(in) :: foil
    logical, intent(in) :: floats !! (e_x, e_y) are unknowns
    type(unknown_layout_type), intent(out) :: layout

    integer, allocatable :: both(:, :)
    integer :: ranks, rank, owner, nodes, i
    PetscErrorCode :: ierr

    call MPI_Comm_size(PETSC_COMM_WORLD, ranks, ierr)
    call MPI_Comm_rank(PETSC_COMM_WORLD, rank, ierr)
    layout%last_rank = rank == ranks - 1
    layout%shaft = merge(shaft_unknowns, 0, floats)
    layout%owned = mesh%owned_unknowns + foil%owned
    if (layout%last_rank) layout%owned = layout%owned + layout%shaft
    allocate (both(2, ranks))
    call MPI_Allgather([mesh%owned_unknowns, foil%owned], 2, MPI_INTEGER, both, 2, MPI_INTEGER, PETSC_COMM_WORLD, ierr)
    allocate (layout%film_end(0:ranks), layout%foil_end(0:ranks))
    layout%film_end = [(sum(both(1, :i)), i=0, ranks)]
    layout%foil_end = [(sum(both(2, :i)), i=0, ranks)]
    layout%unknowns = layout%film_end(ranks) + layout%foil_end(ranks) + layout%shaft

    nodes = size(mesh%first_unknown)
    allocate (layout%global(nodes + foil%local_unknowns() + layout%shaft))
    owner = 1
    do i = 1, nodes
      call find_owner(layout%film_end, mesh%first_unknown(i), owner)
      layout%global(i) = layout%foil_end(owner - 1) + mesh%first_unknown(i) - 1
    end do
    do i = 1, foil%local_unknowns()
      layout%global(nodes + i) = layout%of_foil(foil%global_unknown(i))
    end do
    do i = 1, layout%shaft
      layout%global(size(layout%global) - layout%shaft + i) = layout%unknowns - layout%shaft + i - 1
    end do
  end subroutine create_layout

  !> Number, from 0, in the bearing of a foil's own number, from 1.
  pure function of_foil(self, number) result(global)
    class(unknown_layout_type), intent(in) :: self
    integer, intent(in) :: number
    integer :: global
    integer :: owner

    owner = 1
    call find_owner(self%foil_end, number, owner)
    global = self%film_end(owner) + number - 1
  end function of_foil

  !> Moves `owner` to the rank, from 1, in whose range a number lies.
  pure subroutine find_owner(range_end, number, owner)
    integer, intent(in) :: range_end(0:)
    integer, intent(in) :: number   !! from 1
    integer, intent(inout) :: owner !! where the search begins

    if (number <= range_end(owner - 1)) owner = 1
    do while (number > range_end(owner))
      owner = owner + 1
    end do
  end subroutine find_owner

  !> Matrix with room for what each row couples: film nodes around, foil, shaft.
  subroutine create_coupled_matrix(layout, mesh, foil, order, matrix)
    type(unknown_layout_type), intent(in) :: layout
    type(local_mesh_type), intent(in) :: mesh
    class(foil_model_type), intent(in) :: foil
    integer, intent(in) :: order !! of the film's elements
    Mat, intent(out) :: matrix

    ISLocalToGlobalMapping :: map
    PetscInt, allocatable :: inside(:), outside(:)
    PetscInt :: owned
    PetscErrorCode :: ierr
    integer :: film_row

    film_row = (2*order + 1)**2 ! a node and those of the elements around it
    owned = layout%owned
    allocate (inside(owned), source=int(film_row + foil%couplings + layout%shaft, pint))
    inside(mesh%owned_unknowns + 1:mesh%owned_unknowns + foil%owned) = foil%row_entries
    outside = inside
    if (layout%last_rank .and. layout%shaft > 0) then ! a force depends on every pressure
      inside(owned - layout%shaft + 1:) = owned
      outside(owned - layout%shaft + 1:) = layout%unknowns - owned
    end if
    inside = min(inside, owned)
    outside = min(outside, int(layout%unknowns, pint) - owned)
    PetscCallA(MatCreate(PETSC_COMM_WORLD, matrix, ierr))
    PetscCallA(MatSetSizes(matrix, owned, owned, PETSC_DETERMINE, PETSC_DETERMINE, ierr))
    PetscCallA(MatSetType(matrix, MATAIJ, ierr))
    PetscCallA(MatSeqAIJSetPreallocation(matrix, 0_pint, inside, ierr))
    PetscCallA(MatMPIAIJSetPreallocation(matrix, 0_pint, inside, 0_pint, outside, ierr))
    PetscCallA(ISLocalToGlobalMappingCreate(PETSC_COMM_WORLD, 1_pint, int(size(layout%global), pint), layout%global, PETSC_COPY_VALUES, map, ierr))
    PetscCallA(MatSetLocalToGlobalMapping(matrix, map, map, ierr))
    PetscCallA(ISLocalToGlobalMappingDestroy(map, ierr))
  end subroutine create_coupled_matrix
end module gfb_unknown_layout
