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
  use gfb_shell_foil, only: shell_foil_type
  implicit none (type, external)
  private

  !> Both foils and this rank's part of their equations; the meshes are those that shells would
  !> have, the numbers of unknowns those that a station's nodes share.
  type, extends(shell_foil_type), public :: beam_foil_type
  contains
    procedure :: split_displacements => beam_displacements
    procedure :: nodal_contacts => beam_contacts
  end type beam_foil_type

contains

  !> Displacements of all this rank's nodes of both foils: every node as its station.
  subroutine beam_displacements(self, unknown, top, bumps)
    class(beam_foil_type), intent(in) :: self
    real(wp), intent(in) :: unknown(:) !! local unknowns of the bearing, in SI
    real(wp), allocatable, intent(out) :: top(:, :), bumps(:, :) !! (5, local nodes) [m], [1]

    associate (owned => unknown(self%first + self%own_place))
      top = moved(owned, self%top_number(:, self%top%part%mesh_node))
      bumps = moved(owned, self%bump_number(:, self%bumps%part%mesh_node))
    end associate
  end subroutine beam_displacements

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
