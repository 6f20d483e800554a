#include "gfb_petsc.h"
!> Top foil and bump strip as shells under the film.
module gfb_shell_foil
  use petscmat
  use gfb_kinds, only: wp
  use gfb_errors, only: error_type
  use gfb_quantity, only: quantity_type
  use gfb_result_names, only: add_result
  use gfb_petsc_kinds, only: pint
  use gfb_petsc_session, only: largest_number
  use gfb_shell_geometry, only: shell_geometry_type, shell_section_type, node_unknowns, shell_unknowns, bilinear
  use gfb_shell_element, only: shell_stiffness
  use gfb_shell_mass, only: shell_mass
  use gfb_substructures, only: kind_count
  use gfb_foil_surface, only: foil_surface_type, nodal_values_type
  use gfb_foil_structure, only: foil_structure_type, destroy_foil_structure, element_geometry, element_section, assemble_piece, &
                                retained_in_piece
  use gfb_foil_assembly, only: element_unknowns, retained_unknowns
  use gfb_foil_places, only: foil_ranges_type, ranges_of, top_height, set_laws, place_unknowns, add_pressure, size_unknowns
  use gfb_condensed_piece, only: condensed_piece_type
  use gfb_foil_stress, only: shell_stresses, shell_corner_stresses
  use gfb_rigid_modes, only: patch_type, find_patches, create_motions
  use gfb_meshed_foil, only: meshed_foil_type, both_surfaces, top_surface, bump_surface
  use gfb_text, only: text
  use gfb_foil_cases, only: gap_of_crest, gap_of_corner
  use gfb_scene, only: scene_type
  use gfb_film_mesh, only: film_mesh_type
  use gfb_quad_mesh, only: quad_mesh_type, node_set, set_count, strip_at
  use gfb_contact_point, only: contact_point_type
  use gfb_bump_contacts, only: bump_contact, touch_with_face, touch_top_face, line_shares, line_length, crest_name, corner_name, &
                               contact_sleeve, contact_top
  use gfb_master_search, only: find_masters, projection_type, project
  use gfb_foil_mesh, only: top_mesh
  use gfb_model_case, only: coupling_partitioned, reduction_guyan
  use gfb_partition, only: division_type
  use gfb_mesh_dm, only: local_mesh_type
  use gfb_matrix_rows, only: copy_row
  use gfb_local_exchange, only: local_exchange_type, create_exchange
  use gfb_foil_builder, only: build_top, build_bumps
  use gfb_initial_moment, only: add_initial_moment
  implicit none (type)
  private
  public :: create_shell_foil, add_mass_block, count_rows, expand, gather, turning, work_of_surface

  !> Both foils, each a structure of shells, full or condensed.
  type, extends(meshed_foil_type), public :: shell_foil_type
    type(foil_structure_type) :: top, bumps
  contains
    procedure :: create_coarse_motions => patches_of_shells
    procedure :: add_mass => add_shell_mass
    procedure :: natural_numbers => shell_natural_numbers
    procedure :: surfaces => shell_surfaces
    procedure :: own_unknown => shell_own_unknown
    procedure :: split_displacements => shell_displacements
    procedure :: gather_forces => shell_forces
    procedure :: stresses => stresses_of_shells
    procedure :: corner_stresses => corner_stresses_of_shells
    procedure :: find_work => work_of_shells
    procedure :: sizes => shell_sizes
    procedure :: destroy => shell_destroy
  end type shell_foil_type

  integer, parameter :: tangential = 1, axial = 3 !! components of a displacement
  real(wp), parameter :: round_off = 1.0e-12_wp !! of an element's shape, over its size
  integer, parameter :: corners = 4

  integer, parameter :: radial = 2 !! components of a displacement
  !> Patches of a foil under a film. In small meshes coarse elements bend within a large patch in ways that neither its rigid
  !> motions nor Jacobi's method reach, and the coarse level costs next to nothing as long as there are no more of them.
  integer, parameter :: cheap_patches = 300

contains

  !> Patches of both foils that move as rigid bodies.
  subroutine patches_of_shells(self, motions, has)
    class(shell_foil_type), intent(in) :: self !! the shell foil
    Mat, intent(out) :: motions !! (unknowns, motions)
    logical, intent(out) :: has !! no bumps are condensed
    type(patch_type), allocatable :: of_top(:), of_bumps(:)
    real(wp) :: unit(self%owned)
    PetscScalar, pointer :: values(:)
    PetscInt :: first, last
    Vec :: inverse
    PetscErrorCode :: ierr
    integer :: i

    has = .not. self%bumps%reduced
    if (.not. has) return
    PetscCallA(MatGetOwnershipRange(self%elastic, first, last, ierr))
    unit = 1.0_wp ! `elastic` is in SI
    call find_patches(self%top, [(first + i - 1, i=1, self%owned_top)], unit, cheap_patches, of_top)
    call find_patches(self%bumps, [(first + i - 1, i=self%owned_top + 1, self%owned)], unit, cheap_patches, of_bumps)
    call create_motions([of_top, of_bumps], self%elastic, motions)
    PetscCallA(VecDuplicate(self%state, inverse, ierr))
    PetscCallA(GFB_VecGetArray(inverse, values, ierr))
    values = 1.0_wp/self%unknown_scale(self%own_place)
    PetscCallA(GFB_VecRestoreArray(inverse, values, ierr))
    PetscCallA(MatDiagonalScale(motions, inverse, PETSC_NULL_VEC, ierr))
    PetscCallA(VecDestroy(inverse, ierr))
  end subroutine patches_of_shells

  !> Mass of both foils, or of the top foil and, piece by piece, what the condensed bumps are.
  !>
  !> Fails where an element is degenerate.
  subroutine add_shell_mass(self, mass, piece, error)
    class(shell_foil_type), intent(in) :: self !! the shell foil
    Mat, intent(in) :: mass !! like `elastic`, not assembled yet [kg] between displacements
    type(condensed_piece_type), allocatable, intent(out) :: piece(:) !! one a kind
    type(error_type), allocatable, intent(out) :: error !! why it failed
    type(foil_ranges_type) :: ranges
    real(wp) :: block(shell_unknowns, shell_unknowns)
    integer :: i

    ranges = ranges_of(self%top, self%bumps)
    allocate (piece(0))
    associate (top => self%top)
      do i = 1, size(top%my_elements)
        call shell_mass(element_geometry(top%mesh, top%my_elements(i)), top%section, block, error)
        if (allocated(error)) return
        call add_mass_block(mass, ranges%of_top(element_unknowns(top, top%my_elements(i))), block)
      end do
    end associate
    if (self%bumps%reduced) then
      call list_pieces(self%bumps, ranges, piece, error)
      return
    end if
    associate (bumps => self%bumps)
      do i = 1, size(bumps%my_elements)
        call shell_mass(element_geometry(bumps%mesh, bumps%my_elements(i)), &
                        element_section(bumps%mesh, bumps%section, bumps%my_elements(i)), block, error)
        if (allocated(error)) return
        call add_mass_block(mass, ranges%of_bumps(element_unknowns(bumps, bumps%my_elements(i))), block)
      end do
    end associate
  end subroutine add_shell_mass

  !> Adds an element's mass.
  subroutine add_mass_block(mass, number, block)
    Mat, intent(in) :: mass !! of the foil [kg]
    integer, intent(in) :: number(:) !! foil's, from 1; 0: fixed
    real(wp), intent(in) :: block(:, :) !! of the element [kg]
    PetscErrorCode :: ierr
    PetscCallA(MatSetValues(mass, int(size(number), pint), int(number - 1, pint), int(size(number), pint), int(number - 1, pint), [block], ADD_VALUES, ierr))
  end subroutine add_mass_block

  !> The kinds of condensed pieces that this rank has.
  !>
  !> Fails where an element is degenerate.
  subroutine list_pieces(bumps, ranges, piece, error)
    type(foil_structure_type), intent(in) :: bumps
    type(foil_ranges_type), intent(in) :: ranges
    type(condensed_piece_type), allocatable, intent(out) :: piece(:)
    type(error_type), allocatable, intent(out) :: error
    type(condensed_piece_type) :: one
    integer, allocatable :: mine(:)
    integer :: kind, i

    allocate (piece(0))
    do kind = 1, kind_count(bumps%substructure)
      mine = pack(bumps%mine, bumps%substructure(bumps%mine)%kind == kind)
      if (size(mine) == 0) cycle
      associate (first => bumps%substructure(mine(1)))
        associate (free => bumps%free(:, first%nodes))
          call assemble_piece(bumps%mesh, bumps%section, free, first, .false., one%stiffness, error)
          if (.not. allocated(error)) call assemble_piece(bumps%mesh, bumps%section, free, first, .true., one%mass, error)
          if (allocated(error)) return
          one%is_retained = retained_in_piece(free, first)
        end associate
      end associate
      one%surface = bump_surface
      one%place = mine
      if (allocated(one%number)) deallocate (one%number)
      allocate (one%number(count(one%is_retained), size(mine)))
      do i = 1, size(mine)
        one%number(:, i) = ranges%of_bumps(retained_unknowns(bumps, bumps%substructure(mine(i))))
      end do
      piece = [piece, one]
    end do
  end subroutine list_pieces

  !> The top foil's numbers, then those of the bumps.
  function shell_natural_numbers(self) result(number)
    class(shell_foil_type), intent(in) :: self !! the shell foil
    integer, allocatable :: number(:), top(:), bumps(:)

    top = self%top%natural_numbers()
    bumps = self%bumps%natural_numbers()
    number = [top, largest_number(top) + bumps]
  end function shell_natural_numbers

  !> Top foil and bump foil.
  function shell_surfaces(self) result(list)
    class(shell_foil_type), intent(in) :: self !! the shell foil
    type(foil_surface_type), allocatable :: list(:)
    list = both_surfaces(self%top%foil_surface_type, self%bumps%foil_surface_type)
  end function shell_surfaces

  !> The structure's number, among those of both.
  pure integer function shell_own_unknown(self, surface, component, node) result(number)
    class(shell_foil_type), intent(in) :: self !! the shell foil
    integer, intent(in) :: surface !! which of `surfaces`
    integer, intent(in) :: component !! 1 to 5: u, v, w, alpha, beta
    integer, intent(in) :: node !! of the surface's whole mesh

    if (surface == bump_surface) then
      number = self%bumps%unknown(component, node) + 1
      if (number > 0) number = self%own_place(self%top%part%owned_unknowns + number - self%bumps%first)
    else
      number = self%top%unknown(component, node) + 1
      if (number > 0) number = self%own_place(number - self%top%first)
    end if
  end function shell_own_unknown

  !> Displacements of all this rank's nodes of both foils, condensed ones recovered.
  subroutine shell_displacements(self, unknown, moved)
    class(shell_foil_type), intent(in) :: self !! the shell foil
    real(wp), intent(in) :: unknown(:) !! local unknowns of the bearing [SI]
    type(nodal_values_type), allocatable, intent(out) :: moved(:) !! one a surface
    integer :: mine

    mine = self%top%part%owned_unknowns
    allocate (moved(bump_surface))
    call expand(self%top, unknown(self%first + self%own_place(:mine)), moved(top_surface)%value)
    call expand(self%bumps, unknown(self%first + self%own_place(mine + 1:)), moved(bump_surface)%value)
  end subroutine shell_displacements

  !> Forces on this rank's nodes of both foils as forces on the unknowns.
  subroutine shell_forces(self, nodal, force)
    class(shell_foil_type), intent(in) :: self !! the shell foil
    type(nodal_values_type), intent(in) :: nodal(:) !! on each surface
    real(wp), intent(out) :: force(:) !! one a local unknown of the foil, 0 where another rank owns it [N], [N m]
    integer :: mine

    mine = self%top%part%owned_unknowns
    force = 0.0_wp
    call gather(self%top, nodal(top_surface)%value, self%own_place(:mine), force)
    call gather(self%bumps, nodal(bump_surface)%value, self%own_place(mine + 1:), force)
  end subroutine shell_forces

  !> Forces on one structure's nodes at its owned unknowns.
  subroutine gather(structure, nodal, place, force)
    type(foil_structure_type), intent(in) :: structure !! of shells
    real(wp), intent(in) :: nodal(:, :) !! (5, local nodes) [N], [N m]
    integer, intent(in) :: place(:) !! local unknown of each owned one
    real(wp), intent(inout) :: force(:) !! one a local unknown [N], [N m]
    Vec :: total
    PetscScalar, pointer :: values(:)
    PetscErrorCode :: ierr

    PetscCallA(VecCreateMPI(PETSC_COMM_WORLD, int(size(place), pint), PETSC_DETERMINE, total, ierr))
    PetscCallA(VecSet(total, 0.0_wp, ierr))
    call structure%gather_forces(nodal, total)
    PetscCallA(GFB_VecGetArrayRead(total, values, ierr))
    force(place) = values
    PetscCallA(GFB_VecRestoreArrayRead(total, values, ierr))
    PetscCallA(VecDestroy(total, ierr))
  end subroutine gather

  !> Displacements of one structure's nodes from its owned unknowns.
  subroutine expand(structure, owned, moved)
    type(foil_structure_type), intent(in) :: structure !! of shells
    real(wp), intent(in) :: owned(:) !! in SI
    real(wp), allocatable, intent(out) :: moved(:, :) !! (5, local nodes) [m], [rad]
    Vec :: solution
    PetscScalar, pointer :: values(:)
    PetscErrorCode :: ierr

    allocate (moved(size(structure%slot, 1), size(structure%part%mesh_node)))
    PetscCallA(VecCreateMPI(PETSC_COMM_WORLD, int(size(owned), pint), PETSC_DETERMINE, solution, ierr))
    PetscCallA(GFB_VecGetArray(solution, values, ierr))
    values = owned
    PetscCallA(GFB_VecRestoreArray(solution, values, ierr))
    call structure%displacements(solution, moved)
    PetscCallA(VecDestroy(solution, ierr))
  end subroutine expand

  !> Stresses of shells.
  function stresses_of_shells(self, surface, moved) result(value)
    class(shell_foil_type), intent(in) :: self !! the shell foil
    type(foil_surface_type), intent(in) :: surface !! one of the foil's two
    real(wp), intent(in) :: moved(:, :) !! (5, local nodes) displacements [m], [rad]
    real(wp), allocatable :: value(:, :)
    value = shell_stresses(surface, moved)
  end function stresses_of_shells

  !> Stresses at the corners of shells.
  function corner_stresses_of_shells(self, surface, moved) result(value)
    class(shell_foil_type), intent(in) :: self !! the shell foil
    type(foil_surface_type), intent(in) :: surface !! one of the foil's surfaces
    real(wp), intent(in) :: moved(:, :) !! (5, local nodes) displacements [m], [rad]
    real(wp), allocatable :: value(:, :, :)
    value = shell_corner_stresses(surface, moved)
  end function corner_stresses_of_shells

  !> Work of shells.
  subroutine work_of_shells(self, surface, moved, work, error)
    class(shell_foil_type), intent(in) :: self !! the shell foil
    type(foil_surface_type), intent(in) :: surface !! one of the foil's two, whose numbers may differ
    real(wp), intent(in) :: moved(:, :, 0:) !! (5, local nodes, motions) first that whose forces work [m], [rad]
    real(wp), intent(out) :: work(:) !! on each of the others [J]
    type(error_type), allocatable, intent(out) :: error !! why it failed
    call work_of_surface(surface, moved, work, error)
  end subroutine work_of_shells

  !> Work of a surface of shells. Neighbours of the same shape share a stiffness.
  subroutine work_of_surface(surface, moved, work, error)
    type(foil_surface_type), intent(in) :: surface !! whose numbers may differ from those it was built with
    real(wp), intent(in) :: moved(:, :, 0:) !! (5, local nodes, motions) first that whose forces work [m], [rad]
    real(wp), intent(out) :: work(:) !! on each of the others [J]
    type(error_type), allocatable, intent(out) :: error !! why it failed
    real(wp) :: force(shell_unknowns), stiffness(shell_unknowns, shell_unknowns)
    type(shell_geometry_type) :: here, before
    type(shell_section_type) :: section
    real(wp) :: thickness !! of the neighbour [m]
    integer :: i, k
    logical :: known

    work = 0.0_wp
    known = .false.
    do i = 1, size(surface%my_elements)
      here = element_geometry(surface%mesh, surface%my_elements(i))
      section = element_section(surface%mesh, surface%section, surface%my_elements(i))
      if (known) known = is_same(here, before) .and. abs(section%thickness - thickness) <= 0.0_wp
      if (.not. known) then
        call shell_stiffness(here, section, stiffness, error)
        if (allocated(error)) return
        before = here
        thickness = section%thickness
        known = .true.
      end if
      associate (node => surface%local_node(surface%mesh%element_nodes(:, surface%my_elements(i))))
        force = matmul(stiffness, [moved(:, node, 0)])
        do k = 1, size(work)
          work(k) = work(k) + dot_product(force, [moved(:, node, k)])
        end do
      end associate
    end do
  end subroutine work_of_surface

  !> Whether an element is another one, moved.
  pure logical function is_same(here, other) result(same)
    type(shell_geometry_type), intent(in) :: here, other

    associate (p => here%position - spread(here%position(:, 1), 2, size(here%position, 2)), &
               q => other%position - spread(other%position(:, 1), 2, size(other%position, 2)))
      same = all(abs(p - q) <= round_off*maxval(abs(q)))
    end associate
    same = same .and. all(abs(here%director - other%director) <= round_off) .and. all(abs(here%axis - other%axis) <= round_off)
  end function is_same

  !> Unknowns of the bump foil, full and retained, and its super-elements.
  function shell_sizes(self) result(list)
    class(shell_foil_type), intent(in) :: self !! the shell foil
    type(quantity_type), allocatable :: list(:)
    integer :: rows

    allocate (list(0))
    rows = self%bumps%mesh%rows
    if (self%bumps%mesh%half) rows = 2*rows - 1
    call add_result(list, 'foil_unknowns_full', node_unknowns*rows*self%bumps%mesh%stations)
    call add_result(list, 'foil_unknowns_retained', node_unknowns*(size(self%bumps%substructure) + 1)*rows)
    call add_result(list, 'distinct_super_elements', kind_count(self%bumps%substructure))
  end function shell_sizes

  !> Frees what PETSc holds.
  subroutine shell_destroy(self)
    class(shell_foil_type), intent(inout) :: self !! the shell foil

    call self%free_matrix()
    call destroy_foil_structure(self%top)
    call destroy_foil_structure(self%bumps)
  end subroutine shell_destroy

  !> Contacts of this rank's bump nodes; their unknowns stand as the foil's own numbers for now.
  subroutine add_shell_contacts(scene, height, film, ranges, foil)
    type(scene_type), intent(in) :: scene !! what the case file asks for
    real(wp), intent(in) :: height        !! of the top foil's mid-surface [m]
    type(film_mesh_type), intent(in) :: film !! the film's whole mesh
    type(foil_ranges_type), intent(in) :: ranges     !! numbers of its unknowns
    type(shell_foil_type), intent(inout) :: foil     !! with its structures and laws

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
      do i = 1, found
        point(i)%strip = strip_at(mesh, point(i)%node)
        if (point(i)%law == contact_top) then
          point(i)%gap = gap_of_crest(scene%bump_foil, point(i)%line, point(i)%strip)
        else
          point(i)%gap = gap_of_corner(scene%bump_foil, point(i)%line)
        end if
      end do
      foil%contacts%point = point(:found)
    end associate
    call find_masters_of_crests(height, film, ranges, foil)
    if (film%surface%is_ring()) foil%crests = scene%bump_foil%bumps
  end subroutine add_shell_contacts

  !> Contacts of a line's own nodes that are not fixed everywhere.
  subroutine add_line(foil, ranges, line, law, number, point, found)
    type(shell_foil_type), intent(in) :: foil
    type(foil_ranges_type), intent(in) :: ranges
    integer, intent(in) :: line(:)
    integer, intent(in) :: law    !! `contact_sleeve` or `contact_top`
    integer, intent(in) :: number !! of the line
    type(contact_point_type), intent(inout) :: point(:)
    integer, intent(inout) :: found

    real(wp), allocatable :: length(:)
    integer :: i, k, unknown(node_unknowns)

    if (size(line) == 0) return
    length = line_shares(foil%bumps%mesh, line)*line_length(foil%bumps%mesh, line)
    do i = 1, size(line)
      if (.not. foil%bumps%owns(line(i))) cycle
      unknown = [(ranges%of_bumps(foil%bumps%unknown(k, line(i))), k=1, node_unknowns)]
      if (.not. any(unknown(:axial) > 0)) cycle
      found = found + 1
      point(found) = bump_contact(law, line(i), number, length(i))
      point(found)%slave = unknown(:axial)
      if (.not. foil%contacts%at_faces) cycle
      call touch_with_face(foil%bumps%mesh, foil%bumps%section%thickness, unknown(axial + 1:), point(found))
    end do
  end subroutine add_line

  !> The top foil's elements above the crests.
  subroutine find_masters_of_crests(height, film, ranges, foil)
    real(wp), intent(in) :: height        !! of the top foil's mid-surface [m]
    type(film_mesh_type), intent(in) :: film !! the film's whole mesh
    type(foil_ranges_type), intent(in) :: ranges
    type(shell_foil_type), intent(inout) :: foil

    type(projection_type) :: foot
    type(quad_mesh_type) :: above
    real(wp), allocatable :: points(:, :), coordinates(:, :)
    real(wp), parameter :: round_off = 1.0e-11_wp !! of a shape function
    !> A node stands for half an element on both sides: so far beyond the edge some of it still touches [1]
    real(wp), parameter :: half_element = 1.0_wp
    real(wp) :: slack
    integer, allocatable :: crest(:), element(:), kept(:), nodes(:, :), number(:, :), pressed(:)
    integer :: i, k, before

    crest = pack([(i, i=1, size(foil%contacts%point))], foil%contacts%point%law == contact_top)
    allocate (element(size(crest)), coordinates(2, size(crest)), nodes(corners, size(crest)))
    points = foil%bumps%mesh%position(:, foil%contacts%point(crest)%node)
    slack = 0.0_wp
    if (foil%top%mesh%middle > 0.0_wp) then ! crests cross the stations, and the edges
      above = top_mesh(film, height, middle=foil%top%mesh%middle)
      slack = half_element
    else
      above = top_mesh(film, height, stations_above(film, points(tangential, :)))
    end if
    before = lbound(above%position, 2) - 1
    call find_masters(points, above%position, above%element_nodes - before, height, element, coordinates, slack)
    do i = 1, size(crest)
      nodes(:, i) = 1
      if (element(i) > 0) nodes(:, i) = above%element_nodes(:, lbound(above%element_nodes, 2) + element(i) - 1)
    end do
    number = ranges%of_top(foil%top%numbers_at([nodes]))
    do i = 1, size(crest)
      if (element(i) == 0) cycle
      associate (point => foil%contacts%point(crest(i)))
        foot = project(above%position(:, nodes(:, i)), points(:, i))
        if (slack > 0.0_wp) foot%shape = edge_shape(coordinates(:, i))
        ! A crest on a line of nodes has one master; the others would only fill the matrix.
        pressed = pack([(k, k=1, corners)], abs(foot%shape) > round_off)
        point%share = foot%shape(pressed)
        point%master = number(:axial, (i - 1)*corners + pressed)
        if (foil%contacts%at_faces) call touch_top_face(foil%top%section%thickness, number(axial + 1:, (i - 1)*corners + pressed), point)
      end associate
    end do
    ! A crest beyond the top foil's edge touches nothing.
    kept = [(i, i=1, size(foil%contacts%point))]
    kept = pack(kept, foil%contacts%point%law == contact_sleeve .or. has_master(foil%contacts%point))
    foil%contacts%point = foil%contacts%point(kept)
  end subroutine find_masters_of_crests

  !> Shares of an element's nodes; at a place beyond its edge those of the nearest one on it.
  pure function edge_shape(place) result(shape)
    real(wp), intent(in) :: place(2) !! xi, eta
    real(wp) :: shape(corners), slope(corners, 2)
    call bilinear(max(-1.0_wp, min(place(1), 1.0_wp)), max(-1.0_wp, min(place(2), 1.0_wp)), shape, slope(:, 1), slope(:, 2))
  end function edge_shape

  !> The stretch of the film's stations above some points, with a column to spare on both sides.
  pure function stations_above(film, x) result(window)
    type(film_mesh_type), intent(in) :: film !! the film's whole mesh
    real(wp), intent(in) :: x(:) !! from the leading edge on [m]
    integer :: window(2)
    real(wp) :: station(film%stations())

    window = [1, 0]
    if (size(x) == 0) return
    station = film%surface%radius*(film%station_angle - film%station_angle(1))
    window(1) = max(1, count(station <= minval(x)) - 1)
    window(2) = min(size(station), max(2, count(station < maxval(x)) + 2))
    window(1) = min(window(1), window(2) - 1)
  end function stations_above

  !> Whether a contact has a master of its own.
  elemental logical function has_master(point) result(has)
    type(contact_point_type), intent(in) :: point
    has = size(point%share) > 0
  end function has_master

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
    foil%owned_top = foil%top%part%owned_unknowns
    foil%owned = foil%owned_top + foil%bumps%part%owned_unknowns
    call join_stiffnesses(foil, ranges)
    call set_laws(scene, foil)
    foil%contacts%rows = foil%bumps%mesh%rows
    call add_shell_contacts(scene, top_height(scene), film, ranges, foil)
    v = ranges%of_top(foil%top%numbers_at(mesh%mesh_node))
    call place_unknowns(foil, foil%top%first + foil%bumps%first, v(radial, :))
    call add_initial_moment(scene%top_foil, film, foil)
    call add_pressure(film, mesh, element_nodes, &
                      scene%model%coupling == coupling_partitioned .or. scene%shaft_contact%present, foil)
    call size_unknowns(scene, film, [turning(foil%top, ranges%top_shift), turning(foil%bumps, ranges%bump_shift)], scene%bump_foil%half_length%value, foil)
    call count_entries(foil, film)
  end subroutine create_shell_foil

  !> Foil's numbers of this rank's own rotations.
  function turning(structure, shift) result(list)
    type(foil_structure_type), intent(in) :: structure !! of shells
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
    type(foil_structure_type), intent(in) :: structure !! with its stiffness
    PetscInt, intent(out) :: inside(:), outside(:) !! of each owned row
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
    integer :: tally(0:size(foil%global_unknown)), around, i
    type(local_exchange_type) :: exchange
    PetscScalar, pointer :: value(:)
    Vec :: room
    PetscErrorCode :: ierr

    around = (2*film%order + 1)**2 ! a node and those of the elements around it
    foil%couplings = around
    tally = 0
    tally(abs(foil%source)) = around + merge(around, 0, foil%has_room)
    do i = 1, size(foil%contacts%point)
      associate (unknown => foil%contacts%point_unknowns(i))
        tally(unknown) = tally(unknown) + count(unknown > 0)
      end associate
    end do
    ! A rank's contacts may push unknowns of another.
    call create_exchange(int(foil%global_unknown - 1, pint), foil%state, exchange)
    PetscCallA(VecDuplicate(foil%state, room, ierr))
    PetscCallA(VecZeroEntries(room, ierr))
    call exchange%add(real(tally(1:), wp), room)
    PetscCallA(GFB_VecGetArrayRead(room, value, ierr))
    foil%row_entries = foil%row_entries + nint(value)
    PetscCallA(GFB_VecRestoreArrayRead(room, value, ierr))
    PetscCallA(VecDestroy(room, ierr))
    call exchange%destroy()
  end subroutine count_entries
end module gfb_shell_foil
