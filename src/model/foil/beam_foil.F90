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
  use gfb_kinds, only: wp
  use gfb_bump_contacts, only: line_shares
  use gfb_contact_set, only: contact_set_type, contact_point_type
  use gfb_quad_mesh, only: quad_mesh_type
  use gfb_foil_structure, only: foil_structure_type
  use gfb_shell_foil, only: shell_foil_type
  implicit none (type, external)
  private

  !> Both foils, all of them on the first rank; the meshes are those that shells would have, the
  !> numbers of unknowns those that a station's nodes share.
  type, extends(shell_foil_type), public :: beam_foil_type
    integer, allocatable :: top_number(:, :)  !! (5, stations) foil's own number of an unknown, 0: held
    integer, allocatable :: bump_number(:, :) !! the same of the bump strip's
  contains
    procedure :: split_displacements => beam_displacements
    procedure :: nodal_contacts => beam_contacts
    procedure :: own_unknown => beam_own_unknown
  end type beam_foil_type

contains

  !> Displacements of all this rank's nodes of both foils: every node as its station.
  subroutine beam_displacements(self, unknown, top, bumps)
    class(beam_foil_type), intent(in) :: self
    real(wp), intent(in) :: unknown(:) !! local unknowns of the bearing, in SI
    real(wp), allocatable, intent(out) :: top(:, :), bumps(:, :) !! (5, local nodes) [m], [1]

    associate (owned => unknown(self%first + self%own_place))
      top = moved(owned, self%top_number(:, stations_of(self%top)))
      bumps = moved(owned, self%bump_number(:, stations_of(self%bumps)))
    end associate
  end subroutine beam_displacements

  !> Stations of this rank's nodes.
  pure function stations_of(structure) result(station)
    type(foil_structure_type), intent(in) :: structure
    integer :: station(size(structure%part%mesh_node))
    station = (structure%part%mesh_node - 1)/structure%mesh%rows + 1
  end function stations_of

  !> Local foil unknown of a component at one of this rank's own nodes; 0: held, or none of beams.
  pure function beam_own_unknown(self, of_bumps, component, node) result(place)
    class(beam_foil_type), intent(in) :: self
    logical, intent(in) :: of_bumps  !! instead of the top foil
    integer, intent(in) :: component !! 1 to 5: u, v, w, alpha, beta
    integer, intent(in) :: node      !! of the whole mesh
    integer :: place

    if (of_bumps) then
      place = self%bump_number(component, (node - 1)/self%bumps%mesh%rows + 1)
    else
      place = self%top_number(component, (node - 1)/self%top%mesh%rows + 1)
    end if
    if (place > 0) place = self%own_place(place)
  end function beam_own_unknown

  !> Unknowns by their numbers, 0 where they are held.
  pure function moved(owned, number) result(value)
    real(wp), intent(in) :: owned(:)    !! the foil's unknowns, all of them on one rank
    integer, intent(in) :: number(:, :) !! (5, nodes) from 1; 0: held
    real(wp) :: value(size(number, 1), size(number, 2))
    integer :: node, k

    value = 0.0_wp
    do node = 1, size(number, 2)
      do k = 1, size(number, 1)
        if (number(k, node) > 0) value(k, node) = owned(number(k, node))
      end do
    end do
  end function moved

  !> This rank's contacts, those of a line spread over its nodes.
  function beam_contacts(self) result(contacts)
    class(beam_foil_type), intent(in) :: self
    type(contact_set_type) :: contacts
    integer :: i, rows

    contacts = self%contacts
    rows = self%bumps%mesh%rows
    deallocate (contacts%point)
    allocate (contacts%point(size(self%contacts%point)*rows))
    do i = 1, size(self%contacts%point)
      contacts%point((i - 1)*rows + 1:i*rows) = self%contacts%point(i)
      call spread_line(self%bumps%mesh, contacts%point((i - 1)*rows + 1:i*rows))
    end do
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
end module gfb_beam_foil
