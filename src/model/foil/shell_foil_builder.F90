#include "gfb_petsc.h"
!> From a scene to the shells under its film: meshes, numbers, contacts, pressure.
module gfb_shell_foil_builder
  use petscmat
  use gfb_kinds, only: wp
  use gfb_errors, only: error_type
  use gfb_text, only: text
  use gfb_petsc_kinds, only: pint
  use gfb_petsc_session, only: this_rank, rank_count
  use gfb_scene, only: scene_type
  use gfb_model_case, only: coupling_partitioned, reduction_guyan
  use gfb_film_mesh, only: film_mesh_type
  use gfb_partition, only: division_type
  use gfb_part_chains, only: strip_columns, strip_kinds
  use gfb_mesh_dm, only: local_mesh_type, columns_window
  use gfb_matrix_rows, only: copy_row
  use gfb_quad_mesh, only: quad_mesh_type, node_set, set_count
  use gfb_foil_mesh, only: strip_shape_type, bump_strip_mesh, strip_substructures
  use gfb_substructures, only: substructure_type
  use gfb_foil_structure, only: foil_structure_type, create_foil_structure
  use gfb_foil_builder, only: shape_on_pad, section_of, plate_section, plate_fixed_edge, &
                              find_symmetry_supports
  use gfb_contact_set, only: contact_point_type
  use gfb_bump_contacts, only: bump_contact, line_shares, line_length, crest_name, corner_name, &
                               contact_sleeve, contact_top
  use gfb_master_search, only: find_masters
  use gfb_projection, only: projection_type, project
  use gfb_shell_geometry, only: node_unknowns
  use gfb_shell_foil, only: shell_foil_type
  use gfb_foil_places, only: top_mesh, set_laws, place_unknowns, add_pressure, size_unknowns
  implicit none (type)
  private
  public :: create_shell_foil

  integer, parameter :: tangential = 1, radial = 2, axial = 3 !! components of a displacement
  integer, parameter :: corners = 4

  !> Unknowns of the ranks, and how a structure's numbers become the foil's.
  type :: foil_ranges_type
    integer, allocatable :: top_end(:), bump_end(:) !! (ranks) unknowns of the ranks so far
    integer :: top_shift = 0, bump_shift = 0 !! from this rank's own numbers, from 0, to the foil's, from 1
  contains
    procedure :: of_top => number_of_top
    procedure :: of_bumps => number_of_bumps
  end type foil_ranges_type

contains

  !> Both foils under a film.
  !>
  !> Fails where an element is degenerate.
  subroutine create_shell_foil(scene, film, mesh, element_nodes, division, foil, error)
    type(scene_type), intent(in) :: scene
    type(film_mesh_type), intent(in) :: film
    type(local_mesh_type), intent(in) :: mesh        !! this rank's part of the film
    integer, intent(in) :: element_nodes(:, :)       !! (nodes, elements) its elements, local nodes
    type(division_type), intent(in) :: division      !! of film and bumps
    type(shell_foil_type), intent(out) :: foil
    type(error_type), allocatable, intent(out) :: error

    type(foil_ranges_type) :: ranges
    integer :: v(node_unknowns, size(mesh%mesh_node))

    foil%ambient_pressure = scene%gas%ambient_pressure
    call build_top(scene, film, division, foil%top, error)
    if (allocated(error)) return
    call build_bumps(scene, film, division, scene%model%reduction == reduction_guyan, foil%bumps, error)
    if (allocated(error)) return
    ranges = ranges_of(foil)
    foil%owned = foil%top%part%owned_unknowns + foil%bumps%part%owned_unknowns
    call join_stiffnesses(foil, ranges)
    call set_laws(scene, foil)
    foil%contacts%rows = foil%bumps%mesh%rows
    call add_contacts(scene, film, ranges, foil)
    v = ranges%of_top(foil%top%numbers_at(mesh%mesh_node))
    call place_unknowns(foil, foil%top%first + foil%bumps%first, v(radial, :))
    call add_pressure(film, mesh, element_nodes, &
                      scene%model%coupling == coupling_partitioned .or. scene%shaft_contact%present, foil)
    call size_unknowns(scene, film, [turning(foil%top, ranges%top_shift), turning(foil%bumps, ranges%bump_shift)], foil)
    call count_entries(foil, film)
  end subroutine create_shell_foil

  !> The top foil on the film's nodes.
  subroutine build_top(scene, film, division, top, error)
    type(scene_type), intent(in) :: scene
    type(film_mesh_type), intent(in) :: film
    type(division_type), intent(in) :: division
    type(foil_structure_type), intent(out) :: top
    type(error_type), allocatable, intent(out) :: error

    type(quad_mesh_type) :: mesh
    type(substructure_type) :: none(0)
    logical, allocatable :: fixed(:, :)

    mesh = top_mesh(scene, film, columns_window(division%film, this_rank() + 1))
    call find_symmetry_supports(mesh, fixed)
    fixed(:, node_set(mesh, plate_fixed_edge(scene))) = .true.
    call create_foil_structure(mesh, plate_section(scene), fixed, none, .false., top, error, division%film)
  end subroutine build_top

  !> The bump strip on the sleeve, from its fixed edge.
  subroutine build_bumps(scene, film, division, reduced, bumps, error)
    type(scene_type), intent(in) :: scene
    type(film_mesh_type), intent(in) :: film
    type(division_type), intent(in) :: division
    logical, intent(in) :: reduced
    type(foil_structure_type), intent(out) :: bumps
    type(error_type), allocatable, intent(out) :: error

    type(quad_mesh_type) :: mesh
    type(strip_shape_type) :: shape
    type(substructure_type), allocatable :: piece(:)
    integer, allocatable :: column_part(:)
    logical, allocatable :: fixed(:, :)

    shape = shape_on_pad(scene)
    column_part = strip_columns(shape, reduced, division%bumps)
    mesh = bump_strip_mesh(shape, film%row_axial, film%half, columns_window(column_part, this_rank() + 1))
    piece = strip_substructures(shape, mesh)
    piece%kind = strip_kinds(shape, film%row_axial, film%half)
    call find_symmetry_supports(mesh, fixed)
    fixed(:, node_set(mesh, 'fixed_edge')) = .true.
    call create_foil_structure(mesh, section_of(scene%bump_foil), fixed, piece, reduced, bumps, error, column_part)
  end subroutine build_bumps

  !> Numbers of both foils' unknowns, rank by rank: top foil, then bumps.
  function ranges_of(foil) result(ranges)
    type(shell_foil_type), intent(in) :: foil
    type(foil_ranges_type) :: ranges
    integer, allocatable :: both(:, :)
    integer :: i
    PetscErrorCode :: ierr

    allocate (both(2, rank_count()))
    call MPI_Allgather([foil%top%part%owned_unknowns, foil%bumps%part%owned_unknowns], 2, MPI_INTEGER, both, 2, MPI_INTEGER, PETSC_COMM_WORLD, ierr)
    ranges%top_end = [(sum(both(1, :i)), i=1, size(both, 2))]
    ranges%bump_end = [(sum(both(2, :i)), i=1, size(both, 2))]
    ranges%top_shift = foil%bumps%first + 1
    ranges%bump_shift = foil%top%first + foil%top%part%owned_unknowns + 1
  end function ranges_of

  !> Foil's number, from 1, of an unknown of the top foil, from 0; 0 where there is none.
  elemental function number_of_top(self, number) result(of_foil)
    class(foil_ranges_type), intent(in) :: self
    integer, intent(in) :: number
    integer :: of_foil
    integer :: owner

    of_foil = 0
    if (number < 0) return
    owner = findloc(self%top_end > number, .true., 1)
    of_foil = number + 1
    if (owner > 1) of_foil = of_foil + self%bump_end(owner - 1)
  end function number_of_top

  !> The same of an unknown of the bumps.
  elemental function number_of_bumps(self, number) result(of_foil)
    class(foil_ranges_type), intent(in) :: self
    integer, intent(in) :: number
    integer :: of_foil

    of_foil = 0
    if (number < 0) return
    of_foil = number + 1 + self%top_end(findloc(self%bump_end > number, .true., 1))
  end function number_of_bumps

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

  !> Contacts of this rank's bump nodes; their unknowns stand as the foil's own numbers for now.
  subroutine add_contacts(scene, film, ranges, foil)
    type(scene_type), intent(in) :: scene
    type(film_mesh_type), intent(in) :: film
    type(foil_ranges_type), intent(in) :: ranges
    type(shell_foil_type), intent(inout) :: foil

    type(contact_point_type), allocatable :: point(:)
    integer :: i, found

    associate (mesh => foil%bumps%mesh)
      allocate (point(size(node_set(mesh, 'corners')) + size(node_set(mesh, 'crests'))))
      found = 0
      do i = 1, set_count(mesh, corner_name)
        call add_line(foil, ranges, node_set(mesh, corner_name//text(i)), contact_sleeve, i, point, found)
      end do
      do i = 1, scene%bump_foil%bumps
        call add_line(foil, ranges, node_set(mesh, crest_name(i)), contact_top, i, point, found)
      end do
      foil%contacts%point = point(:found)
    end associate
    call find_masters_of_crests(scene, film, ranges, foil)
  end subroutine add_contacts

  !> Contacts of a line's own nodes that are not held everywhere.
  subroutine add_line(foil, ranges, line, law, number, point, found)
    type(shell_foil_type), intent(in) :: foil
    type(foil_ranges_type), intent(in) :: ranges
    integer, intent(in) :: line(:)
    integer, intent(in) :: law    !! `contact_sleeve` or `contact_top`
    integer, intent(in) :: number !! of the line
    type(contact_point_type), intent(inout) :: point(:)
    integer, intent(inout) :: found

    real(wp), allocatable :: length(:)
    integer :: i, k, slave(axial)

    if (size(line) == 0) return
    length = line_shares(foil%bumps%mesh, line)*line_length(foil%bumps%mesh, line)
    do i = 1, size(line)
      if (.not. foil%bumps%owns(line(i))) cycle
      slave = [(ranges%of_bumps(foil%bumps%unknown(k, line(i))), k=1, axial)]
      if (.not. any(slave > 0)) cycle
      found = found + 1
      point(found) = bump_contact(law, line(i), number, length(i))
      point(found)%slave = slave
    end do
  end subroutine add_line

  !> The top foil's elements above the crests.
  subroutine find_masters_of_crests(scene, film, ranges, foil)
    type(scene_type), intent(in) :: scene
    type(film_mesh_type), intent(in) :: film
    type(foil_ranges_type), intent(in) :: ranges
    type(shell_foil_type), intent(inout) :: foil

    type(projection_type) :: foot
    type(quad_mesh_type) :: above
    real(wp), allocatable :: place(:, :), coordinates(:, :)
    real(wp), parameter :: round_off = 1.0e-11_wp !! of a shape function
    integer, allocatable :: crest(:), element(:), kept(:), nodes(:, :), number(:, :), pressed(:)
    integer :: i, k, before

    crest = pack([(i, i=1, size(foil%contacts%point))], foil%contacts%point%law == contact_top)
    allocate (element(size(crest)), coordinates(2, size(crest)), nodes(corners, size(crest)))
    place = foil%bumps%mesh%position(:, foil%contacts%point(crest)%node)
    above = top_mesh(scene, film, stations_above(film, place(tangential, :)))
    before = lbound(above%position, 2) - 1
    call find_masters(place, above%position, above%element_nodes - before, scene%bump_foil%height, element, coordinates)
    do i = 1, size(crest)
      nodes(:, i) = 1
      if (element(i) > 0) nodes(:, i) = above%element_nodes(:, lbound(above%element_nodes, 2) + element(i) - 1)
    end do
    number = ranges%of_top(foil%top%numbers_at([nodes]))
    do i = 1, size(crest)
      if (element(i) == 0) cycle
      associate (point => foil%contacts%point(crest(i)))
        foot = project(above%position(:, nodes(:, i)), place(:, i))
        ! A crest on a line of nodes has one master; the others would only fill the matrix.
        pressed = pack([(k, k=1, corners)], abs(foot%shape) > round_off)
        point%share = foot%shape(pressed)
        point%master = number(:axial, (i - 1)*corners + pressed)
      end associate
    end do
    ! A crest beyond the top foil's edge touches nothing.
    kept = [(i, i=1, size(foil%contacts%point))]
    kept = pack(kept, foil%contacts%point%law == contact_sleeve .or. has_master(foil%contacts%point))
    foil%contacts%point = foil%contacts%point(kept)
  end subroutine find_masters_of_crests

  !> The stretch of the film's stations above some places, with a column to spare on both sides.
  pure function stations_above(film, x) result(window)
    type(film_mesh_type), intent(in) :: film
    real(wp), intent(in) :: x(:) !! from the leading edge on [m]
    integer :: window(2)
    real(wp) :: station(film%stations())

    window = [1, 0]
    if (size(x) == 0) return
    station = film%radius*(film%station_angle - film%station_angle(1))
    window(1) = max(1, count(station <= minval(x)) - 1)
    window(2) = min(size(station), max(2, count(station < maxval(x)) + 2))
    window(1) = min(window(1), window(2) - 1)
  end function stations_above

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
    integer, parameter :: per_crest = 15 !! unknowns of a contact
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
