#include "gfb_petsc.h"
!> From a scene to the shells under its film: meshes, numbers, contacts, pressure.
module gfb_shell_foil_builder
  use petscmat
  use gfb_kinds, only: wp
  use gfb_errors, only: error_type
  use gfb_petsc_kinds, only: pint
  use gfb_scene, only: scene_type
  use gfb_film_mesh, only: film_mesh_type
  use gfb_mesh_dm, only: local_mesh_type
  use gfb_quad_mesh, only: quad_mesh_type, node_set
  use gfb_foil_mesh, only: strip_shape_type, bump_strip_mesh, strip_substructures
  use gfb_substructures, only: substructure_type, substructure, find_kinds
  use gfb_foil_structure, only: foil_structure_type, create_foil_structure
  use gfb_foil_builder, only: shape_on_pad, section_of, plate_section, plate_fixed_edge, &
                              symmetry_supports
  use gfb_contact_set, only: contact_point_type
  use gfb_bump_contacts, only: bump_contact, line_shares, line_length, crest_name, contact_sleeve, &
                               contact_top
  use gfb_master_search, only: find_masters
  use gfb_projection, only: projection_type, project
  use gfb_shell_geometry, only: node_unknowns
  use gfb_shell_foil, only: shell_foil_type
  use gfb_foil_places, only: top_mesh, set_laws, list_wanted, place_unknowns, &
                             add_pressure, size_unknowns
  implicit none (type)
  private
  public :: create_shell_foil

  integer, parameter :: tangential = 1, radial = 2, axial = 3 !! components of a displacement
  integer, parameter :: corners = 4

contains

  !> Both foils under a film.
  !>
  !> Fails where an element is degenerate.
  subroutine create_shell_foil(scene, film, mesh, element_nodes, reduced, foil, error)
    type(scene_type), intent(in) :: scene
    type(film_mesh_type), intent(in) :: film
    type(local_mesh_type), intent(in) :: mesh        !! this rank's part of the film
    integer, intent(in) :: element_nodes(:, :)       !! (4, elements) its elements, local nodes
    logical, intent(in) :: reduced                   !! bumps are condensed
    type(shell_foil_type), intent(out) :: foil
    type(error_type), allocatable, intent(out) :: error

    logical, allocatable :: wanted(:)
    integer, allocatable :: top_shift(:), bump_shift(:)
    integer :: first

    foil%ambient_pressure = scene%gas%ambient_pressure
    call build_top(scene, film, foil%top, error)
    if (allocated(error)) return
    call build_bumps(scene, film, reduced, foil%bumps, error)
    if (allocated(error)) return
    call number_unknowns(foil, first, top_shift, bump_shift)
    call join_stiffnesses(foil, top_shift, bump_shift)
    call set_laws(scene, foil)
    call add_contacts(scene, foil)
    call list_wanted(foil, mesh, first, wanted)
    call place_unknowns(foil, mesh, first, wanted)
    call add_pressure(film, mesh, element_nodes, foil)
    call size_unknowns(scene, film, foil, wanted)
    call count_entries(foil, film)
  end subroutine create_shell_foil

  !> The top foil on the film's nodes.
  subroutine build_top(scene, film, top, error)
    type(scene_type), intent(in) :: scene
    type(film_mesh_type), intent(in) :: film
    type(foil_structure_type), intent(out) :: top
    type(error_type), allocatable, intent(out) :: error

    type(quad_mesh_type) :: mesh
    type(substructure_type), allocatable :: piece(:)
    logical, allocatable :: fixed(:, :)
    logical :: none(film%nodes())
    integer :: i, k

    none = .false.
    mesh = top_mesh(scene, film)
    fixed = symmetry_supports(mesh)
    fixed(:, node_set(mesh, plate_fixed_edge(scene))) = .true.
    allocate (piece(film%circumferential()))
    do i = 1, size(piece)
      piece(i) = substructure(mesh, [((i - 1)*film%axial() + k, k=1, film%axial())], none)
      piece(i)%kind = 1
    end do
    call create_foil_structure(mesh, plate_section(scene), fixed, piece, .false., top, error)
  end subroutine build_top

  !> The bump strip on the sleeve, from its fixed edge.
  subroutine build_bumps(scene, film, reduced, bumps, error)
    type(scene_type), intent(in) :: scene
    type(film_mesh_type), intent(in) :: film
    logical, intent(in) :: reduced
    type(foil_structure_type), intent(out) :: bumps
    type(error_type), allocatable, intent(out) :: error

    type(quad_mesh_type) :: mesh
    type(strip_shape_type) :: shape
    type(substructure_type), allocatable :: piece(:)
    logical, allocatable :: fixed(:, :)

    shape = shape_on_pad(scene)
    mesh = bump_strip_mesh(shape, film%row_axial, film%half)
    piece = strip_substructures(shape, mesh)
    fixed = symmetry_supports(mesh)
    fixed(:, node_set(mesh, 'fixed_edge')) = .true.
    call find_kinds(mesh, fixed, piece)
    call create_foil_structure(mesh, section_of(scene%bump_foil), fixed, piece, reduced, bumps, error)
  end subroutine build_bumps

  !> Numbers of both foils' unknowns, rank by rank: top foil, then bumps.
  subroutine number_unknowns(foil, first, top_shift, bump_shift)
    type(shell_foil_type), intent(inout) :: foil
    integer, intent(out) :: first !! unknowns of the ranks before this one
    !> (from 0) foil's number of every unknown of the structures less its own
    integer, allocatable, intent(out) :: top_shift(:), bump_shift(:)

    integer, allocatable :: both(:, :)
    integer :: rank, ranks, i
    PetscErrorCode :: ierr

    call MPI_Comm_rank(PETSC_COMM_WORLD, rank, ierr)
    call MPI_Comm_size(PETSC_COMM_WORLD, ranks, ierr)
    allocate (both(2, ranks))
    call MPI_Allgather([foil%top%part%owned_unknowns, foil%bumps%part%owned_unknowns], 2, MPI_INTEGER, both, 2, MPI_INTEGER, PETSC_COMM_WORLD, ierr)
    first = sum(both(:, :rank))
    foil%owned = sum(both(:, rank + 1))
    allocate (top_shift(0:foil%top%unknowns - 1), bump_shift(0:foil%bumps%unknowns - 1))
    do i = 1, ranks
      top_shift(sum(both(1, :i - 1)):sum(both(1, :i)) - 1) = sum(both(2, :i - 1))
      bump_shift(sum(both(2, :i - 1)):sum(both(2, :i)) - 1) = sum(both(1, :i))
    end do
    foil%top_number = numbers_of(foil%top, top_shift)
    foil%bump_number = numbers_of(foil%bumps, bump_shift)
  end subroutine number_unknowns

  !> The foil's own numbers of a structure's unknowns, known on all ranks.
  function numbers_of(structure, shift) result(number)
    type(foil_structure_type), intent(in) :: structure
    integer, intent(in) :: shift(0:)     !! of the structure's unknowns
    integer, allocatable :: number(:, :) !! (5, nodes), from 1; 0: none
    integer, allocatable :: mine(:, :)
    PetscErrorCode :: ierr
    integer :: node, component, unknown

    allocate (mine(node_unknowns, size(structure%mesh%position, 2)), source=0)
    do node = 1, size(mine, 2)
      if (.not. structure%owns(node)) cycle
      do component = 1, node_unknowns
        unknown = structure%unknown(component, node)
        if (unknown >= 0) mine(component, node) = unknown + shift(unknown) + 1
      end do
    end do
    allocate (number, mold=mine)
    call MPI_Allreduce(mine, number, size(mine), MPI_INTEGER, MPI_SUM, PETSC_COMM_WORLD, ierr)
  end function numbers_of

  !> One matrix of both foils' stiffness.
  subroutine join_stiffnesses(foil, top_shift, bump_shift)
    type(shell_foil_type), intent(inout) :: foil
    integer, intent(in) :: top_shift(0:), bump_shift(0:) !! of the structures' unknowns
    PetscInt, allocatable :: entries(:)
    PetscErrorCode :: ierr

    allocate (entries(foil%owned))
    call count_rows(foil%top, entries(:foil%top%part%owned_unknowns))
    call count_rows(foil%bumps, entries(foil%top%part%owned_unknowns + 1:))
    PetscCallA(MatCreate(PETSC_COMM_WORLD, foil%elastic, ierr))
    PetscCallA(MatSetSizes(foil%elastic, int(foil%owned, pint), int(foil%owned, pint), PETSC_DETERMINE, PETSC_DETERMINE, ierr))
    PetscCallA(MatSetType(foil%elastic, MATAIJ, ierr))
    PetscCallA(MatSeqAIJSetPreallocation(foil%elastic, 0_pint, entries, ierr))
    PetscCallA(MatMPIAIJSetPreallocation(foil%elastic, 0_pint, min(entries, int(foil%owned, pint)), 0_pint, entries, ierr))
    call copy_rows(foil%top, top_shift, foil%elastic)
    call copy_rows(foil%bumps, bump_shift, foil%elastic)
    PetscCallA(MatAssemblyBegin(foil%elastic, MAT_FINAL_ASSEMBLY, ierr))
    PetscCallA(MatAssemblyEnd(foil%elastic, MAT_FINAL_ASSEMBLY, ierr))
    PetscCallA(MatCreateVecs(foil%elastic, foil%state, foil%force, ierr))
    PetscCallA(MatDestroy(foil%top%stiffness, ierr))
    PetscCallA(MatDestroy(foil%bumps%stiffness, ierr))
    foil%has_elastic = .true.
    foil%row_entries = int(entries)
  end subroutine join_stiffnesses

  !> Entries of a structure's own rows.
  subroutine count_rows(structure, entries)
    type(foil_structure_type), intent(in) :: structure
    PetscInt, intent(out) :: entries(:)
    PetscInt :: first, last, row, found, column(structure%unknowns)
    PetscErrorCode :: ierr

    PetscCallA(MatGetOwnershipRange(structure%stiffness, first, last, ierr))
    do row = first, last - 1
      PetscCallA(MatGetRow(structure%stiffness, row, found, column, PETSC_NULL_SCALAR, ierr))
      entries(row - first + 1) = found
      PetscCallA(MatRestoreRow(structure%stiffness, row, found, column, PETSC_NULL_SCALAR, ierr))
    end do
  end subroutine count_rows

  !> A structure's rows with the foil's own numbers.
  subroutine copy_rows(structure, shift, matrix)
    type(foil_structure_type), intent(in) :: structure
    integer, intent(in) :: shift(0:) !! of the structure's unknowns
    Mat, intent(in) :: matrix

    PetscInt :: first, last, row, entries, column(structure%unknowns)
    PetscScalar :: value(structure%unknowns)
    PetscErrorCode :: ierr

    PetscCallA(MatGetOwnershipRange(structure%stiffness, first, last, ierr))
    do row = first, last - 1
      PetscCallA(MatGetRow(structure%stiffness, row, entries, column, value, ierr))
      PetscCallA(MatSetValues(matrix, 1_pint, [row + int(shift(row), pint)], entries, column(:entries) + int(shift(column(:entries)), pint), value, INSERT_VALUES, ierr))
      PetscCallA(MatRestoreRow(structure%stiffness, row, entries, column, value, ierr))
    end do
  end subroutine copy_rows

  !> Contacts of this rank's bump nodes; their unknowns stand as the foil's own numbers for now.
  subroutine add_contacts(scene, foil)
    type(scene_type), intent(in) :: scene
    type(shell_foil_type), intent(inout) :: foil

    type(contact_point_type), allocatable :: point(:)
    integer, allocatable :: line(:)
    integer :: bump, i, rows, found

    associate (mesh => foil%bumps%mesh)
      rows = mesh%rows
      line = node_set(mesh, 'corners')
      allocate (point(size(line) + size(node_set(mesh, 'crests'))))
      found = 0
      do i = 1, size(line)/rows
        call add_line(foil, line((i - 1)*rows + 1:i*rows), contact_sleeve, i, point, found)
      end do
      do bump = 1, scene%bump_foil%bumps
        call add_line(foil, node_set(mesh, crest_name(bump)), contact_top, bump, point, found)
      end do
      foil%contacts%point = point(:found)
    end associate
    call find_masters_of_crests(scene, foil)
  end subroutine add_contacts

  !> Contacts of a line's own nodes that are not held everywhere.
  subroutine add_line(foil, line, law, number, point, found)
    type(shell_foil_type), intent(in) :: foil
    integer, intent(in) :: line(:)
    integer, intent(in) :: law    !! `contact_sleeve` or `contact_top`
    integer, intent(in) :: number !! of the line
    type(contact_point_type), intent(inout) :: point(:)
    integer, intent(inout) :: found

    real(wp), allocatable :: length(:)
    integer :: i

    length = line_shares(foil%bumps%mesh, line)*line_length(foil%bumps%mesh, line)
    do i = 1, size(line)
      if (.not. foil%bumps%owns(line(i)) .or. .not. any(foil%bump_number(:axial, line(i)) > 0)) cycle
      found = found + 1
      point(found) = bump_contact(law, line(i), number, length(i))
      point(found)%slave = foil%bump_number(:axial, line(i))
    end do
  end subroutine add_line

  !> The top foil's elements above the crests.
  subroutine find_masters_of_crests(scene, foil)
    type(scene_type), intent(in) :: scene
    type(shell_foil_type), intent(inout) :: foil

    type(projection_type) :: foot
    real(wp), allocatable :: place(:, :), coordinates(:, :)
    integer, allocatable :: crest(:), element(:), kept(:)
    integer :: i, k

    crest = pack([(i, i=1, size(foil%contacts%point))], foil%contacts%point%law == contact_top)
    allocate (element(size(crest)), coordinates(2, size(crest)))
    associate (mesh => foil%top%mesh)
      place = foil%bumps%mesh%position(:, foil%contacts%point(crest)%node)
      call find_masters(place, mesh%position, mesh%element_nodes, scene%bump_foil%height, element, coordinates)
      do i = 1, size(crest)
        if (element(i) == 0) cycle
        associate (point => foil%contacts%point(crest(i)), nodes => mesh%element_nodes(:, element(i)))
          foot = project(mesh%position(:, nodes), place(:, i))
          point%share = foot%shape
          point%master = reshape([(foil%top_number(:axial, nodes(k)), k=1, corners)], [axial, corners])
        end associate
      end do
    end associate
    ! A crest beyond the top foil's edge touches nothing.
    kept = [(i, i=1, size(foil%contacts%point))]
    kept = pack(kept, foil%contacts%point%law == contact_sleeve .or. has_master(foil%contacts%point))
    foil%contacts%point = foil%contacts%point(kept)
  end subroutine find_masters_of_crests

  !> Whether a contact has a master of its own.
  elemental function has_master(point) result(has)
    type(contact_point_type), intent(in) :: point
    logical :: has
    has = size(point%share) > 0
  end function has_master

  !> Entries that film and contacts add to the rows of the foil, and the foil to those of the film.
  subroutine count_entries(foil, film)
    type(shell_foil_type), intent(inout) :: foil
    type(film_mesh_type), intent(in) :: film
    integer, parameter :: around = 9    !! a node and its neighbours
    integer, parameter :: per_crest = 15 !! unknowns of a contact
    integer :: crests

    foil%couplings = around
    ! Elements of the film that are wide against the bumps can hold several crests.
    crests = 4*(1 + maxval([0, count_crests(foil)]))
    foil%row_entries = foil%row_entries + around + per_crest*crests
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
