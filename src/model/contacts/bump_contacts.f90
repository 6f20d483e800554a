!> What the contacts of bumps have in common, in a strip and in a bearing: lines and directions.
module gfb_bump_contacts
  use gfb_kinds, only: wp
  use gfb_text, only: text
  use gfb_contact_set, only: contact_set_type, contact_point_type
  use gfb_quad_mesh, only: quad_mesh_type, solid_rows
  implicit none (type, external)
  private
  public :: bump_contact, crest_name, line_shares, line_length, normal_line_force

  integer, parameter, public :: contact_sleeve = 1, contact_top = 2 !! laws of a set of bumps
  !> of a corner line among the node sets, before its number
  character(len=*), parameter, public :: corner_name = 'corner_'

  integer, parameter :: tangential = 1, radial = 2, axial = 3 !! components of a displacement

contains

  !> A contact of a bump's node, with its directions; nothing moves its master yet.
  pure function bump_contact(law, node, line, length) result(point)
    integer, intent(in) :: law       !! `contact_sleeve` or `contact_top`
    integer, intent(in) :: node      !! slave, number in its mesh
    integer, intent(in) :: line      !! number of the contact line
    real(wp), intent(in) :: length   !! of the line the node stands for [m]
    type(contact_point_type) :: point

    point%law = law
    point%node = node
    point%line = line
    point%length = length
    point%frame(tangential, 1) = 1.0_wp
    point%frame(axial, 2) = 1.0_wp
    point%frame(radial, 3) = merge(1.0_wp, -1.0_wp, law == contact_sleeve)
    allocate (point%master(axial, 0), point%share(0))
  end function bump_contact

  !> Name of a bump's crest line among the mesh's node sets.
  pure function crest_name(bump) result(name)
    integer, intent(in) :: bump !! number of the bump, from 1
    character(len=:), allocatable :: name
    name = 'crest_'//text(bump)
  end function crest_name

  !> Share of a line's length that each of its nodes stands for (trapezoid rule); they add up to
  !> one. Over a cut there is no line.
  pure function line_shares(mesh, line) result(share)
    type(quad_mesh_type), intent(in) :: mesh !! of the strip
    integer, intent(in) :: line(:) !! nodes in order of z
    real(wp) :: share(size(line))
    integer :: i, n

    if (size(line) == 0) return ! on another rank
    if (allocated(mesh%cut)) then
      share = 0.5_wp*([0.0_wp, solid_lengths(mesh)] + [solid_lengths(mesh), 0.0_wp])/ &
              sum(solid_lengths(mesh))
      return
    end if
    n = size(line)
    associate (z => mesh%position(axial, line))
      do i = 1, n
        share(i) = 0.5_wp*(z(min(i + 1, n)) - z(max(i - 1, 1)))/(z(n) - z(1))
      end do
    end associate
  end function line_shares

  !> Length of a line [m].
  pure function line_length(mesh, line) result(length)
    type(quad_mesh_type), intent(in) :: mesh !! of the strip
    integer, intent(in) :: line(:) !! nodes in order of z
    real(wp) :: length

    if (allocated(mesh%cut)) then
      length = sum(solid_lengths(mesh))
    else
      length = mesh%position(axial, line(size(line))) - mesh%position(axial, line(1))
    end if
  end function line_length

  !> Lengths of a line's elements, 0 over cuts [m].
  pure function solid_lengths(mesh) result(length)
    type(quad_mesh_type), intent(in) :: mesh !! with cuts
    real(wp) :: length(mesh%rows - 1)

    associate (z => mesh%row_axial)
      length = merge(z(2:) - z(:mesh%rows - 1), 0.0_wp, solid_rows(mesh))
    end associate
  end function solid_lengths

  !> Normal force of a contact per length of its line [N/m].
  pure function normal_line_force(contacts, i) result(force)
    type(contact_set_type), intent(in) :: contacts !! of this rank
    integer, intent(in) :: i !! contact
    real(wp) :: force !! [N/m]

    associate (point => contacts%point(i))
      force = merge(point%pressing, point%force(3), point%pressed)/point%length
    end associate
  end function normal_line_force
end module gfb_bump_contacts
