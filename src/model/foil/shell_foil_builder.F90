#include "gfb_petsc.h"
!> From a scene to the shells under its film: meshes, numbers, contacts, pressure.
module gfb_shell_foil_builder
  use petscmat
  use gfb_kinds, only: wp
  use gfb_errors, only: error_type
  use gfb_petsc_kinds, only: pint
  use gfb_scene, only: scene_type
  use gfb_model_case, only: coupling_partitioned, reduction_guyan
  use gfb_film_mesh, only: film_mesh_type
  use gfb_partition, only: division_type
  use gfb_mesh_dm, only: local_mesh_type
  use gfb_matrix_rows, only: copy_row
  use gfb_foil_structure, only: foil_structure_type
  use gfb_shell_geometry, only: node_unknowns
  use gfb_shell_foil, only: shell_foil_type
  use gfb_foil_ranges, only: foil_ranges_type, ranges_of
  use gfb_foil_builder, only: build_top, build_bumps
  use gfb_shell_contacts, only: add_shell_contacts
  use gfb_initial_moment, only: add_initial_moment
  use gfb_foil_places, only: top_height, set_laws, place_unknowns, add_pressure, size_unknowns
  implicit none (type)
  private
  public :: create_shell_foil

  integer, parameter :: radial = 2, axial = 3 !! components of a displacement

contains

  !> Both foils under a film.
  !>
  !> Fails where an element is degenerate.
  subroutine create_shell_foil(scene, film, mesh, element_nodes, division, foil, error)
    type(scene_type), intent(in) :: scene !! what the case file asks for
    type(film_mesh_type), intent(in) :: film !! the film's whole mesh
    type(local_mesh_type), intent(in) :: mesh        !! this rank's part of the film
    integer, intent(in) :: element_nodes(:, :)       !! (nodes, elements) its elements, local nodes
    type(division_type), intent(in) :: division      !! of film and bumps
    type(shell_foil_type), intent(out) :: foil !! top foil and bumps, ready for the bearing
    type(error_type), allocatable, intent(out) :: error !! error, if an element is degenerate

    type(foil_ranges_type) :: ranges
    integer :: v(node_unknowns, size(mesh%mesh_node))

    foil%ambient_pressure = scene%gas%ambient_pressure
    call build_top(scene, film, top_height(scene), division, foil%top, error)
    if (allocated(error)) return
    call build_bumps(scene, film, division, scene%model%reduction == reduction_guyan, foil%bumps, error)
    if (allocated(error)) return
    ranges = ranges_of(foil%top, foil%bumps)
    foil%owned = foil%top%part%owned_unknowns + foil%bumps%part%owned_unknowns
    call join_stiffnesses(foil, ranges)
    call set_laws(scene, foil)
    foil%contacts%rows = foil%bumps%mesh%rows
    call add_shell_contacts(scene, top_height(scene), film, ranges, foil)
    v = ranges%of_top(foil%top%numbers_at(mesh%mesh_node))
    call place_unknowns(foil, foil%top%first + foil%bumps%first, v(radial, :))
    call add_initial_moment(scene%top_foil, film, foil)
    call add_pressure(film, mesh, element_nodes, &
                      scene%model%coupling == coupling_partitioned .or. scene%shaft_contact%present, foil)
    call size_unknowns(scene, film, [turning(foil%top, ranges%top_shift), turning(foil%bumps, ranges%bump_shift)], foil)
    call count_entries(foil, film)
  end subroutine create_shell_foil

  !> Foil's numbers of this rank's own rotations.
  function turning(structure, shift) result(list)
    type(foil_structure_type), intent(in) :: structure
    integer, intent(in) :: shift !! from a number of the structure, from 0, to the foil's
    integer, allocatable :: list(:)
    integer :: own(node_unknowns - axial, count(structure%part%owned)), i, k, component

    k = 0
    do i = 1, size(structure%part%mesh_node)
      if (.not. structure%part%owned(i)) cycle
      k = k + 1
      do component = axial + 1, node_unknowns
        own(component - axial, k) = structure%unknown(component, structure%part%mesh_node(i))
      end do
    end do
    list = pack(own, own >= 0) + shift
  end function turning

  !> One matrix of both foils' stiffness.
  subroutine join_stiffnesses(foil, ranges)
    type(shell_foil_type), intent(inout) :: foil
    type(foil_ranges_type), intent(in) :: ranges

    PetscInt, allocatable :: inside(:), outside(:)
    PetscErrorCode :: ierr

    allocate (inside(foil%owned), outside(foil%owned))
    associate (top => foil%top%part%owned_unknowns)
      call count_rows(foil%top, inside(:top), outside(:top))
      call count_rows(foil%bumps, inside(top + 1:), outside(top + 1:))
    end associate
    PetscCallA(MatCreate(PETSC_COMM_WORLD, foil%elastic, ierr))
    PetscCallA(MatSetSizes(foil%elastic, int(foil%owned, pint), int(foil%owned, pint), PETSC_DETERMINE, PETSC_DETERMINE, ierr))
    PetscCallA(MatSetType(foil%elastic, MATAIJ, ierr))
    PetscCallA(MatSeqAIJSetPreallocation(foil%elastic, 0_pint, inside, ierr))
    PetscCallA(MatMPIAIJSetPreallocation(foil%elastic, 0_pint, inside, 0_pint, outside, ierr))
    foil%row_entries = int(inside + outside)
    call copy_rows(foil%top, ranges, .false., foil%row_entries, foil%elastic)
    call copy_rows(foil%bumps, ranges, .true., foil%row_entries, foil%elastic)
    PetscCallA(MatAssemblyBegin(foil%elastic, MAT_FINAL_ASSEMBLY, ierr))
    PetscCallA(MatAssemblyEnd(foil%elastic, MAT_FINAL_ASSEMBLY, ierr))
    PetscCallA(MatCreateVecs(foil%elastic, foil%state, foil%force, ierr))
    PetscCallA(MatDestroy(foil%top%stiffness, ierr))
    PetscCallA(MatDestroy(foil%bumps%stiffness, ierr))
    foil%has_matrix = .true.
  end subroutine join_stiffnesses

  !> Entries of a structure's own rows, in this rank's columns and in others.
  subroutine count_rows(structure, inside, outside)
    type(foil_structure_type), intent(in) :: structure
    PetscInt, intent(out) :: inside(:), outside(:)
    PetscInt :: first, last, row, found, column(structure%row_entries())
    PetscErrorCode :: ierr

    PetscCallA(MatGetOwnershipRange(structure%stiffness, first, last, ierr))
    do row = first, last - 1
      call copy_row(structure%stiffness, row, found, column)
      inside(row - first + 1) = count(column(:found) >= first .and. column(:found) < last)
      outside(row - first + 1) = found - inside(row - first + 1)
    end do
  end subroutine count_rows

  !> A structure's rows with the foil's own numbers.
  subroutine copy_rows(structure, ranges, of_bumps, entries_of_rows, matrix)
    type(foil_structure_type), intent(in) :: structure
    type(foil_ranges_type), intent(in) :: ranges
    logical, intent(in) :: of_bumps
    integer, intent(in) :: entries_of_rows(:)
    Mat, intent(in) :: matrix

    PetscInt :: first, last, row, shifted, entries, column(maxval([0, entries_of_rows]))
    PetscScalar :: value(size(column))
    PetscErrorCode :: ierr

    PetscCallA(MatGetOwnershipRange(structure%stiffness, first, last, ierr))
    do row = first, last - 1
      call copy_row(structure%stiffness, row, entries, column, value)
      shifted = row + int(merge(ranges%bump_shift, ranges%top_shift, of_bumps), pint) - 1_pint
      if (of_bumps) then
        PetscCallA(MatSetValues(matrix, 1_pint, [shifted], entries, int(ranges%of_bumps(int(column(:entries))) - 1, pint), value, INSERT_VALUES, ierr))
      else
        PetscCallA(MatSetValues(matrix, 1_pint, [shifted], entries, int(ranges%of_top(int(column(:entries))) - 1, pint), value, INSERT_VALUES, ierr))
      end if
    end do
  end subroutine copy_rows

  !> Entries that film and contacts add to the rows of the foil, and the foil to those of the film.
  subroutine count_entries(foil, film)
    type(shell_foil_type), intent(inout) :: foil
    type(film_mesh_type), intent(in) :: film
    integer, parameter :: per_crest = 25 !! unknowns of a contact
    integer :: around, crests

    around = (2*film%order + 1)**2 ! a node and those of the elements around it
    foil%couplings = around
    ! Elements of the film that are wide against the bumps can hold several crests.
    crests = 4*(1 + maxval([0, count_crests(foil)]))
    foil%row_entries = foil%row_entries + around + merge(around, 0, foil%has_room) + per_crest*crests
  end subroutine count_entries

  !> Crests over the element that has most of them, on this rank.
  function count_crests(foil) result(most)
    type(shell_foil_type), intent(in) :: foil
    integer :: most
    integer :: tally(size(foil%global_unknown)), i

    tally = 0
    do i = 1, size(foil%contacts%point)
      associate (point => foil%contacts%point(i))
        if (size(point%share) == 0) cycle
        if (point%master(radial, 1) > 0) tally(point%master(radial, 1)) = tally(point%master(radial, 1)) + 1
      end associate
    end do
    most = maxval(tally)
  end function count_crests
end module gfb_shell_foil_builder
