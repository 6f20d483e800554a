#include "gfb_petsc.h"
!> Top foil and bump strip as planar beams under the film.
!>
!> The equations are those of shells all nodes of whose stations move as one: along x, along v, and
!> turning about the axis. So the station's force is the sum of the shells' forces on its nodes,
!>
!> $$ f_i = \int N_i(x) \int (p - p_a) \, dz \, dx, $$
!>
!> which knows of the film no more than its mean along the axis. Forces are those on the solved
!> width. What differs from shells is the stiffness, and how the foil is built and shown.
!>
!> From a scene to the beams under its film: stations, numbers, stiffness, contacts, pressure.
!>
!> Beams are so small beside the film that the first rank owns all of them, and their contacts.
module gfb_beam_foil
  use petscmat
  use gfb_kinds, only: wp
  use gfb_errors, only: error_type
  use gfb_petsc_kinds, only: pint
  use gfb_quantity, only: quantity_type
  use gfb_result_names, only: add_result
  use gfb_bump_contacts, only: line_shares, line_length, bump_contact, touch_with_face, touch_top_face, crest_name, &
                               contact_sleeve, contact_top
  use gfb_contact_point, only: contact_point_type
  use gfb_contact_set, only: contact_set_type
  use gfb_quad_mesh, only: quad_mesh_type, node_set, solid_rows
  use gfb_planar_beam, only: beam_unknowns, beam_mass, beam_section_type, plane_strain_section, linear_beam_stiffness, &
                             bent_beam_stiffness
  use gfb_condensed_piece, only: condensed_piece_type
  use gfb_foil_surface, only: foil_surface_type, nodal_values_type
  use gfb_foil_stress, only: beam_stresses, beam_end_stresses
  use gfb_foil_structure, only: element_section
  use gfb_shell_geometry, only: shell_section_type, node_unknowns
  use gfb_meshed_foil, only: meshed_foil_type, both_surfaces, top_surface, bump_surface
  use gfb_petsc_session, only: this_rank
  use gfb_scene, only: scene_type
  use gfb_top_foil_case, only: top_foil_leading
  use gfb_foil_cases, only: fixed_edge_trailing, gap_of_crest, gap_of_corner
  use gfb_model_case, only: coupling_partitioned
  use gfb_film_mesh, only: film_mesh_type
  use gfb_mesh_dm, only: local_mesh_type
  use gfb_foil_mesh, only: station_positions, top_mesh
  use gfb_foil_builder, only: shape_on_pad, plate_section, section_of, strip_on_pad
  use gfb_initial_moment, only: add_initial_moment
  use gfb_foil_places, only: top_height, set_laws, place_unknowns, add_pressure, size_unknowns
  implicit none (type)
  private
  public :: create_beam_foil

  integer, parameter :: of_beam(beam_unknowns) = [1, 2, 4] !! of a node's: along x, along v, about the axis

  !> Both foils, all of them on the first rank; the surfaces are those that shells would have, the
  !> numbers of unknowns those that a station's nodes share.
  type, extends(meshed_foil_type), public :: beam_foil_type
    type(foil_surface_type) :: top, bumps
    integer, allocatable :: top_number(:, :)  !! (5, stations) foil's own number of an unknown, 0: fixed
    integer, allocatable :: bump_number(:, :) !! the same of the bump strip's
  contains
    procedure :: add_mass => add_beam_mass
    procedure :: moves_against_mirror => beam_moves_against_mirror
    procedure :: natural_numbers => beam_natural_numbers
    procedure :: surfaces => beam_surfaces
    procedure :: own_unknown => beam_own_unknown
    procedure :: split_displacements => beam_displacements
    procedure :: gather_forces => beam_forces
    procedure :: stresses => stresses_of_beams
    procedure :: corner_stresses => corner_stresses_of_beams
    procedure :: find_work => work_of_beams
    procedure :: nodal_contacts => beam_contacts
    procedure :: sizes => beam_sizes
    procedure :: destroy => beam_destroy
  end type beam_foil_type

  integer, parameter :: tangential = 1, radial = 2, axial = 3 !! components of a displacement
  integer, parameter :: about_axis = 4                        !! the turn among a node's unknowns
  integer, parameter :: ends = 2
  real(wp), parameter :: rounding = 1.0e-9_wp !! of crests at the top foil's edge, over the pitch

contains

  !> Mass of both foils, on the solved width.
  subroutine add_beam_mass(self, mass, piece, error)
    class(beam_foil_type), intent(in) :: self !! the beam foil
    Mat, intent(in) :: mass !! like `elastic`, not assembled yet [kg] between displacements
    type(condensed_piece_type), allocatable, intent(out) :: piece(:) !! none
    type(error_type), allocatable, intent(out) :: error !! never

    allocate (piece(0))
    call add_mass_along(self%top, self%top_number, mass)
    call add_mass_along(self%bumps, self%bump_number, mass)
  end subroutine add_beam_mass

  !> Adds the mass of a beam through a surface's stations.
  subroutine add_mass_along(surface, number, mass)
    type(foil_surface_type), intent(in) :: surface
    integer, intent(in) :: number(:, :) !! (5, stations)
    Mat, intent(in) :: mass
    real(wp) :: block(2*beam_unknowns, 2*beam_unknowns)
    PetscInt :: row(2*beam_unknowns)
    PetscErrorCode :: ierr
    type(shell_section_type) :: section
    integer :: station, here, next

    if (size(surface%my_elements) == 0) return ! another rank's
    associate (mesh => surface%mesh)
      do station = 1, mesh%stations - 1
        here = (station - 1)*mesh%rows + 1
        next = here + mesh%rows
        section = element_section(mesh, surface%section, (station - 1)*(mesh%rows - 1) + 1)
        block = width_of(mesh)*beam_mass(section%density, section%thickness, mesh%position(:2, [here, next]))
        row = int([number(of_beam, station), number(of_beam, station + 1)] - 1, pint)
        PetscCallA(MatSetValues(mass, int(size(row), pint), row, int(size(row), pint), row, [block], ADD_VALUES, ierr))
      end do
    end associate
  end subroutine add_mass_along

  !> Stiffness of the element between a station and the next one, per metre of width.
  !>
  !> Film and crests see the top foil as a straight line between stations, the bumps show nodes only.
  pure function stiffness_behind(mesh, section, station, bent) result(stiffness)
    type(quad_mesh_type), intent(in) :: mesh !! of one of the foils
    type(shell_section_type), intent(in) :: section !! thickness and material where the mesh has none of its own
    integer, intent(in) :: station !! but the last one
    logical, intent(in) :: bent !! the element bends between its ends
    real(wp) :: stiffness(2*beam_unknowns, 2*beam_unknowns)
    type(shell_section_type) :: sheet
    type(beam_section_type) :: beam

    associate (here => (station - 1)*mesh%rows + 1)
      sheet = element_section(mesh, section, (station - 1)*(mesh%rows - 1) + 1)
      beam = plane_strain_section(sheet%thickness, sheet%youngs_modulus, sheet%poissons_ratio)
      if (bent) then
        stiffness = bent_beam_stiffness(beam, mesh%position(:2, [here, here + mesh%rows]))
      else
        stiffness = linear_beam_stiffness(beam, mesh%position(:2, [here, here + mesh%rows]))
      end if
    end associate
  end function stiffness_behind

  !> Width that is solved [m].
  pure real(wp) function width_of(mesh) result(width)
    type(quad_mesh_type), intent(in) :: mesh !! of one of the foils
    width = line_length(mesh, [1, mesh%rows])
  end function width_of

  !> Beams feel the mean pressure across the width, which is none then.
  pure logical function beam_moves_against_mirror(self) result(moves)
    class(beam_foil_type), intent(in) :: self !! the beam foil
    moves = .false.
  end function beam_moves_against_mirror

  !> The foil's own numbers: the first rank has all of them.
  function beam_natural_numbers(self) result(number)
    class(beam_foil_type), intent(in) :: self !! the beam foil
    integer, allocatable :: number(:)
    number = self%global_unknown(self%own_place)
  end function beam_natural_numbers

  !> Top foil and bump foil.
  function beam_surfaces(self) result(list)
    class(beam_foil_type), intent(in) :: self !! the beam foil
    type(foil_surface_type), allocatable :: list(:)
    list = both_surfaces(self%top, self%bumps)
  end function beam_surfaces

  !> The unknown of a node's station.
  pure integer function beam_own_unknown(self, surface, component, node) result(number)
    class(beam_foil_type), intent(in) :: self !! the beam foil
    integer, intent(in) :: surface !! which of `surfaces`
    integer, intent(in) :: component !! 1 to 5: u, v, w, alpha, beta
    integer, intent(in) :: node !! of the surface's whole mesh

    if (surface == bump_surface) then
      number = self%bump_number(component, (node - 1)/self%bumps%mesh%rows + 1)
    else
      number = self%top_number(component, (node - 1)/self%top%mesh%rows + 1)
    end if
    if (number > 0) number = self%own_place(number)
  end function beam_own_unknown

  !> Displacements of all this rank's nodes of both foils: every node as its station.
  subroutine beam_displacements(self, unknown, moved)
    class(beam_foil_type), intent(in) :: self !! the beam foil
    real(wp), intent(in) :: unknown(:) !! local unknowns of the bearing [SI]
    type(nodal_values_type), allocatable, intent(out) :: moved(:) !! one a surface

    allocate (moved(bump_surface))
    associate (owned => unknown(self%first + self%own_place))
      moved(top_surface)%value = displaced(owned, self%top_number(:, stations_of(self%top)))
      moved(bump_surface)%value = displaced(owned, self%bump_number(:, stations_of(self%bumps)))
    end associate
  end subroutine beam_displacements

  !> Forces on this rank's nodes as forces on their stations.
  subroutine beam_forces(self, nodal, force)
    class(beam_foil_type), intent(in) :: self !! the beam foil
    type(nodal_values_type), intent(in) :: nodal(:) !! on each surface
    real(wp), intent(out) :: force(:) !! one a local unknown of the foil, 0 where another rank owns it [N], [N m]

    force = 0.0_wp
    call add_to_stations(nodal(top_surface)%value, self%top_number(:, stations_of(self%top)))
    call add_to_stations(nodal(bump_surface)%value, self%bump_number(:, stations_of(self%bumps)))

  contains

    !> Adds the forces on one foil's nodes.
    subroutine add_to_stations(nodal, number)
      real(wp), intent(in) :: nodal(:, :)
      integer, intent(in) :: number(:, :) !! (5, nodes) from 1; 0: fixed
      integer :: node, k

      do node = 1, size(number, 2)
        do k = 1, size(number, 1)
          if (number(k, node) == 0) cycle
          associate (mine => force(self%own_place(number(k, node))))
            mine = mine + nodal(k, node)
          end associate
        end do
      end do
    end subroutine add_to_stations
  end subroutine beam_forces

  !> Stations of this rank's nodes.
  pure function stations_of(surface) result(station)
    type(foil_surface_type), intent(in) :: surface
    integer :: station(size(surface%part%mesh_node))
    station = (surface%part%mesh_node - 1)/surface%mesh%rows + 1
  end function stations_of

  !> Unknowns by their numbers, 0 where they are fixed.
  pure function displaced(owned, number) result(value)
    real(wp), intent(in) :: owned(:)    !! the foil's unknowns, all of them on one rank
    integer, intent(in) :: number(:, :) !! (5, nodes) from 1; 0: fixed
    real(wp) :: value(size(number, 1), size(number, 2))
    integer :: node, k

    value = 0.0_wp
    do node = 1, size(number, 2)
      do k = 1, size(number, 1)
        if (number(k, node) > 0) value(k, node) = owned(number(k, node))
      end do
    end do
  end function displaced

  !> Stresses of beams.
  function stresses_of_beams(self, surface, moved) result(value)
    class(beam_foil_type), intent(in) :: self !! the beam foil
    type(foil_surface_type), intent(in) :: surface !! one of the foil's two
    real(wp), intent(in) :: moved(:, :) !! (5, local nodes) displacements [m], [rad]
    real(wp), allocatable :: value(:, :)
    value = beam_stresses(surface, moved)
  end function stresses_of_beams

  !> Stresses at the corners of beams, which are their ends.
  function corner_stresses_of_beams(self, surface, moved) result(value)
    class(beam_foil_type), intent(in) :: self !! the beam foil
    type(foil_surface_type), intent(in) :: surface !! one of the foil's surfaces
    real(wp), intent(in) :: moved(:, :) !! (5, local nodes) displacements [m], [rad]
    real(wp), allocatable :: value(:, :, :)
    value = beam_end_stresses(surface, moved)
  end function corner_stresses_of_beams

  !> Work of beams, on the solved width.
  subroutine work_of_beams(self, surface, moved, work, error)
    class(beam_foil_type), intent(in) :: self !! the beam foil
    type(foil_surface_type), intent(in) :: surface !! one of the foil's two, whose numbers may differ
    real(wp), intent(in) :: moved(:, :, 0:) !! (5, local nodes, motions) first that whose forces work [m], [rad]
    real(wp), intent(out) :: work(:) !! on each of the others [J]
    type(error_type), allocatable, intent(out) :: error !! never
    real(wp) :: force(2*beam_unknowns)
    integer :: station, k

    work = 0.0_wp
    if (size(surface%my_elements) == 0) return ! another rank's
    do station = 1, surface%mesh%stations - 1
      associate (node => surface%local_node((station - 1)*surface%mesh%rows + 1 + [0, surface%mesh%rows]))
        force = width_of(surface%mesh)*matmul(stiffness_behind(surface%mesh, surface%section, station, surface%has_contacts), &
                                              [moved(of_beam, node, 0)])
        do k = 1, size(work)
          work(k) = work(k) + dot_product(force, [moved(of_beam, node, k)])
        end do
      end associate
    end do
  end subroutine work_of_beams

  !> This rank's contacts, those of a line spread over its nodes.
  function beam_contacts(self) result(contacts)
    class(beam_foil_type), intent(in) :: self !! the beam foil
    type(contact_set_type) :: contacts
    integer, allocatable :: part_of_line(:)
    integer :: i, rows

    contacts = self%contacts
    rows = self%bumps%mesh%rows
    deallocate (contacts%point)
    allocate (contacts%point(size(self%contacts%point)*rows))
    do i = 1, size(self%contacts%point)
      contacts%point((i - 1)*rows + 1:i*rows) = self%contacts%point(i)
      call spread_line(self%bumps%mesh, contacts%point((i - 1)*rows + 1:i*rows))
    end do
    if (.not. allocated(self%bumps%mesh%cut)) return
    part_of_line = pack([(i, i=1, size(contacts%point))], contacts%point%length > 0.0_wp)
    contacts%point = contacts%point(part_of_line)
  end function beam_contacts

  !> Gives copies of a line's contact, one a node, the nodes' parts of it.
  pure subroutine spread_line(mesh, point)
    type(quad_mesh_type), intent(in) :: mesh
    type(contact_point_type), intent(inout) :: point(:) !! at the line's first node on entry
    real(wp) :: share(size(point))
    integer :: k

    point%node = point%node + [(k, k=0, size(point) - 1)]
    share = line_shares(mesh, point%node)
    point%length = share*point%length
    do k = 1, size(point)
      point(k)%force = share(k)*point(k)%force
    end do
  end subroutine spread_line

  !> Unknowns of the bump foil.
  function beam_sizes(self) result(list)
    class(beam_foil_type), intent(in) :: self !! the beam foil
    type(quantity_type), allocatable :: list(:)

    allocate (list(0))
    call add_result(list, 'foil_unknowns_full', beam_unknowns*self%bumps%mesh%stations)
  end function beam_sizes

  !> Frees what PETSc holds.
  subroutine beam_destroy(self)
    class(beam_foil_type), intent(inout) :: self !! the beam foil
    call self%free_matrix()
  end subroutine beam_destroy

  !> Both foils under a film.
  subroutine create_beam_foil(scene, film, mesh, element_nodes, foil)
    type(scene_type), intent(in) :: scene !! what the case file asks for
    type(film_mesh_type), intent(in) :: film !! the film's whole mesh
    type(local_mesh_type), intent(in) :: mesh  !! this rank's part of the film
    integer, intent(in) :: element_nodes(:, :) !! (nodes, elements) its elements, local nodes
    type(beam_foil_type), intent(out) :: foil !! top foil and bumps, ready for the bearing

    integer :: unknowns, window(2), i
    logical :: mine

    mine = this_rank() == 0
    foil%ambient_pressure = scene%gas%ambient_pressure
    window = [1, merge(film%stations(), 0, mine)]
    foil%top%mesh = top_mesh(film, top_height(scene), window)
    window = [1, merge(size(station_positions(shape_on_pad(scene))), 0, mine)]
    foil%bumps%mesh = strip_on_pad(scene, film, window)
    unknowns = 0
    call number_stations(foil%top%mesh%stations, scene%top_foil%fixed_edge == top_foil_leading, unknowns, foil%top_number)
    call number_stations(foil%bumps%mesh%stations, scene%bump_foil%fixed_edge /= fixed_edge_trailing, unknowns, &
                         foil%bump_number)
    foil%owned = merge(unknowns, 0, mine)
    foil%owned_top = merge(maxval(foil%top_number), 0, mine)
    foil%top%section = plate_section(scene)
    foil%bumps%section = section_of(scene%bump_foil)
    call own_nodes(mine, foil%top)
    call own_nodes(mine, foil%bumps)
    call set_laws(scene, foil)
    foil%contacts%rows = foil%bumps%mesh%rows
    call add_contacts(scene, foil)
    call create_stiffness(foil)
    call place_unknowns(foil, merge(0, unknowns, mine), &
                        [(foil%top_number(radial, (mesh%mesh_node(i) - 1)/film%rows() + 1), i=1, size(mesh%mesh_node))])
    call add_initial_moment(scene%top_foil, film, foil)
    call add_pressure(film, mesh, element_nodes, &
                      scene%model%coupling == coupling_partitioned .or. scene%shaft_contact%present, foil)
    call size_unknowns(scene, film, turning(foil), scene%bump_foil%half_length%value, foil)
    foil%equation_scale = foil%equation_scale*film%axial() ! a station carries what its nodes do
    call count_entries(foil, film)
  end subroutine create_beam_foil

  !> Numbers the unknowns of a foil, station by station.
  pure subroutine number_stations(stations, leading, last, number)
    integer, intent(in) :: stations
    logical, intent(in) :: leading                    !! clamped at the leading edge, else the trailing one
    integer, intent(inout) :: last                    !! number in use
    integer, allocatable, intent(out) :: number(:, :) !! (5, stations), from 1; 0: fixed
    integer :: station, k

    allocate (number(node_unknowns, stations), source=0)
    do station = 1, stations
      if (station == merge(1, stations, leading)) cycle
      do k = 1, beam_unknowns
        last = last + 1
        number(of_beam(k), station) = last
      end do
    end do
  end subroutine number_stations

  !> Numbers of this rank's rotations.
  pure function turning(foil) result(list)
    type(beam_foil_type), intent(in) :: foil
    integer, allocatable :: list(:)

    list = [integer ::]
    if (foil%owned == 0) return
    list = [foil%top_number(about_axis, :), foil%bump_number(about_axis, :)]
    list = pack(list, list > 0)
  end function turning

  !> All nodes and elements of a foil, or none, are this rank's.
  pure subroutine own_nodes(mine, surface)
    logical, intent(in) :: mine
    type(foil_surface_type), intent(inout) :: surface
    integer :: i

    associate (mesh => surface%mesh)
      surface%local_node = [(i, i=1, merge(mesh%nodes(), 0, mine))]
      surface%part%mesh_node = surface%local_node
      allocate (surface%part%owned(size(surface%part%mesh_node)), source=.true.)
      surface%my_elements = [(i, i=1, merge(mesh%elements(), 0, mine))]
      if (allocated(mesh%cut) .and. mine) then
        surface%my_elements = pack(surface%my_elements, [(solid_rows(mesh), i=2, mesh%stations)])
      end if
    end associate
  end subroutine own_nodes

  !> One matrix of both foils' stiffness, on the solved width.
  subroutine create_stiffness(foil)
    type(beam_foil_type), intent(inout) :: foil

    integer, parameter :: around = 3*beam_unknowns !! unknowns of a station and its neighbours
    PetscErrorCode :: ierr

    PetscCallA(MatCreate(PETSC_COMM_WORLD, foil%elastic, ierr))
    PetscCallA(MatSetSizes(foil%elastic, int(foil%owned, pint), int(foil%owned, pint), PETSC_DETERMINE, PETSC_DETERMINE, ierr))
    PetscCallA(MatSetType(foil%elastic, MATAIJ, ierr))
    PetscCallA(MatSeqAIJSetPreallocation(foil%elastic, int(around, pint), PETSC_NULL_INTEGER_ARRAY, ierr))
    PetscCallA(MatMPIAIJSetPreallocation(foil%elastic, int(around, pint), PETSC_NULL_INTEGER_ARRAY, 0_pint, PETSC_NULL_INTEGER_ARRAY, ierr))
    if (foil%owned > 0) then
      call add_beam(foil%top, .false., foil%top_number, foil%elastic)
      call add_beam(foil%bumps, .true., foil%bump_number, foil%elastic)
    end if
    PetscCallA(MatAssemblyBegin(foil%elastic, MAT_FINAL_ASSEMBLY, ierr))
    PetscCallA(MatAssemblyEnd(foil%elastic, MAT_FINAL_ASSEMBLY, ierr))
    PetscCallA(MatCreateVecs(foil%elastic, foil%state, foil%force, ierr))
    foil%has_matrix = .true.
    allocate (foil%row_entries(foil%owned), source=around)
  end subroutine create_stiffness

  !> Adds the stiffness of a beam through a surface's stations.
  subroutine add_beam(surface, bent, number, matrix)
    type(foil_surface_type), intent(in) :: surface
    logical, intent(in) :: bent         !! elements bend between their ends
    integer, intent(in) :: number(:, :) !! (5, stations)
    Mat, intent(in) :: matrix
    PetscInt :: row(ends*beam_unknowns)
    PetscErrorCode :: ierr
    integer :: station

    associate (mesh => surface%mesh)
      do station = 1, mesh%stations - 1
        row = int([number(of_beam, station), number(of_beam, station + 1)] - 1, pint)
        PetscCallA(MatSetValues(matrix, int(size(row), pint), row, int(size(row), pint), row, [width_of(mesh)*stiffness_behind(mesh, surface%section, station, bent)], ADD_VALUES, ierr))
      end do
    end associate
  end subroutine add_beam

  !> One contact a line; their unknowns stand as the foil's own numbers for now.
  subroutine add_contacts(scene, foil)
    type(scene_type), intent(in) :: scene
    type(beam_foil_type), intent(inout) :: foil

    integer, allocatable :: line(:)
    integer :: bump, i

    allocate (foil%contacts%point(0))
    if (foil%owned == 0) return
    associate (mesh => foil%bumps%mesh)
      line = node_set(mesh, 'corners')
      do i = 1, size(line)/mesh%rows
        call add_line(foil, line((i - 1)*mesh%rows + 1), contact_sleeve, i, 0.0_wp, &
                      gap_of_corner(scene%bump_foil, i))
      end do
      do bump = 1, scene%bump_foil%bumps
        line = node_set(mesh, crest_name(bump))
        call add_line(foil, line(1), contact_top, bump, rounding*scene%bump_foil%pitch%value, &
                      gap_of_crest(scene%bump_foil, bump))
      end do
    end associate
  end subroutine add_contacts

  !> Contact of a line that is not fixed, nor beyond the top foil.
  subroutine add_line(foil, node, law, number, overhang, gap)
    type(beam_foil_type), intent(inout) :: foil
    integer, intent(in) :: node     !! first of the line
    integer, intent(in) :: law      !! `contact_sleeve` or `contact_top`
    integer, intent(in) :: number   !! of the line
    real(wp), intent(in) :: overhang !! a crest so far beyond the top foil lies at its edge [m]
    real(wp), intent(in) :: gap      !! at rest [m]

    type(contact_point_type) :: point

    integer :: station

    station = (node - 1)/foil%bumps%mesh%rows + 1
    if (.not. any(foil%bump_number(:, station) > 0)) return
    point = bump_contact(law, node, number, width_of(foil%bumps%mesh))
    point%slave = foil%bump_number(:axial, station)
    point%gap = gap
    if (foil%contacts%at_faces) then
      call touch_with_face(foil%bumps%mesh, foil%bumps%section%thickness, foil%bump_number(axial + 1:, station), point)
    end if
    if (law == contact_top) then
      call find_master(foil, overhang, point)
      if (size(point%share) == 0) return
    end if
    foil%contacts%point = [foil%contacts%point, point]
  end subroutine add_line

  !> The top foil's element above a crest, where there is one.
  pure subroutine find_master(foil, overhang, point)
    type(beam_foil_type), intent(in) :: foil
    real(wp), intent(in) :: overhang !! [m]
    type(contact_point_type), intent(inout) :: point
    real(wp) :: along
    integer :: station, here, next

    associate (mesh => foil%top%mesh, x => foil%bumps%mesh%position(tangential, point%node))
      if (x < mesh%position(tangential, 1) - overhang) return
      do station = 1, mesh%stations - 1
        here = (station - 1)*mesh%rows + 1
        next = here + mesh%rows
        if (x > mesh%position(tangential, next) + overhang) cycle
        along = (x - mesh%position(tangential, here))/ &
                (mesh%position(tangential, next) - mesh%position(tangential, here))
        along = min(1.0_wp, max(0.0_wp, along))
        point%share = [1.0_wp - along, along]
        point%master = foil%top_number(:axial, [station, station + 1])
        if (allocated(point%turn)) then
          call touch_top_face(foil%top%section%thickness, foil%top_number(axial + 1:, [station, station + 1]), point)
        end if
        return
      end do
    end associate
  end subroutine find_master

  !> Entries that film and contacts add to the rows of the foil, and the foil to those of the film.
  subroutine count_entries(foil, film)
    type(beam_foil_type), intent(inout) :: foil
    type(film_mesh_type), intent(in) :: film

    integer :: tally(0:size(foil%global_unknown)), i, around

    around = 2*film%order + 1 ! a station and those of the elements beside it
    foil%couplings = around
    tally = 0
    do i = 1, size(foil%contacts%point)
      associate (unknown => foil%contacts%point_unknowns(i))
        tally(unknown) = tally(unknown) + count(unknown > 0)
      end associate
    end do
    foil%row_entries = foil%row_entries + around*film%rows() + merge(around, 0, foil%has_room) + tally(foil%own_place)
  end subroutine count_entries
end module gfb_beam_foil
