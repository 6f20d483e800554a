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
module gfb_beam_foil
  use petscmat
  use gfb_kinds, only: wp
  use gfb_errors, only: error_type
  use gfb_petsc_kinds, only: pint
  use gfb_quantity, only: quantity_type
  use gfb_results, only: add_result
  use gfb_bump_contacts, only: line_shares, line_length
  use gfb_contact_point, only: contact_point_type
  use gfb_contact_set, only: contact_set_type
  use gfb_quad_mesh, only: quad_mesh_type
  use gfb_planar_beam, only: beam_unknowns, beam_mass, beam_section_type, plane_strain_section, linear_beam_stiffness, &
                             bent_beam_stiffness
  use gfb_condensed_piece, only: condensed_piece_type
  use gfb_foil_surface, only: foil_surface_type
  use gfb_foil_stress, only: beam_stresses
  use gfb_foil_pieces, only: element_section
  use gfb_shell_geometry, only: shell_section_type
  use gfb_meshed_foil, only: meshed_foil_type, both_surfaces, bump_surface
  implicit none (type)
  private
  public :: stiffness_behind, width_of

  integer, parameter, public :: of_beam(beam_unknowns) = [1, 2, 4] !! of a node's: along x, along v, about the axis

  !> Both foils, all of them on the first rank; the surfaces are those that shells would have, the
  !> numbers of unknowns those that a station's nodes share.
  type, extends(meshed_foil_type), public :: beam_foil_type
    type(foil_surface_type) :: top, bumps
    integer, allocatable :: top_number(:, :)  !! (5, stations) foil's own number of an unknown, 0: fixed
    integer, allocatable :: bump_number(:, :) !! the same of the bump strip's
  contains
    procedure :: add_mass => add_beam_mass
    procedure :: natural_numbers => beam_natural_numbers
    procedure :: surfaces => beam_surfaces
    procedure :: own_unknown => beam_own_unknown
    procedure :: split_displacements => beam_displacements
    procedure :: stresses => stresses_of_beams
    procedure :: nodal_contacts => beam_contacts
    procedure :: sizes => beam_sizes
    procedure :: destroy => beam_destroy
  end type beam_foil_type

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
  pure function width_of(mesh) result(width)
    type(quad_mesh_type), intent(in) :: mesh !! of one of the foils
    real(wp) :: width
    width = line_length(mesh, [1, mesh%rows])
  end function width_of

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
  pure function beam_own_unknown(self, surface, component, node) result(number)
    class(beam_foil_type), intent(in) :: self !! the beam foil
    integer, intent(in) :: surface !! which of `surfaces`
    integer, intent(in) :: component !! 1 to 5: u, v, w, alpha, beta
    integer, intent(in) :: node !! of the surface's whole mesh
    integer :: number

    if (surface == bump_surface) then
      number = self%bump_number(component, (node - 1)/self%bumps%mesh%rows + 1)
    else
      number = self%top_number(component, (node - 1)/self%top%mesh%rows + 1)
    end if
    if (number > 0) number = self%own_place(number)
  end function beam_own_unknown

  !> Displacements of all this rank's nodes of both foils: every node as its station.
  subroutine beam_displacements(self, unknown, top, bumps)
    class(beam_foil_type), intent(in) :: self !! the beam foil
    real(wp), intent(in) :: unknown(:) !! local unknowns of the bearing [SI]
    real(wp), allocatable, intent(out) :: top(:, :), bumps(:, :) !! (5, local nodes) of top foil and bumps [m], [rad]

    associate (owned => unknown(self%first + self%own_place))
      top = moved(owned, self%top_number(:, stations_of(self%top)))
      bumps = moved(owned, self%bump_number(:, stations_of(self%bumps)))
    end associate
  end subroutine beam_displacements

  !> Stations of this rank's nodes.
  pure function stations_of(surface) result(station)
    type(foil_surface_type), intent(in) :: surface
    integer :: station(size(surface%part%mesh_node))
    station = (surface%part%mesh_node - 1)/surface%mesh%rows + 1
  end function stations_of

  !> Unknowns by their numbers, 0 where they are fixed.
  pure function moved(owned, number) result(value)
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
  end function moved

  !> Stresses of beams.
  function stresses_of_beams(self, surface, moved) result(value)
    class(beam_foil_type), intent(in) :: self !! the beam foil
    type(foil_surface_type), intent(in) :: surface !! one of the foil's two
    real(wp), intent(in) :: moved(:, :) !! (5, local nodes) displacements [m], [rad]
    real(wp), allocatable :: value(:, :)
    value = beam_stresses(surface, moved)
  end function stresses_of_beams

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
end module gfb_beam_foil
