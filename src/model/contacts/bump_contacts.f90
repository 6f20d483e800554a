!> What the contacts of bumps have in common, in a strip and in a bearing: lines and directions.
module gfb_bump_contacts
  use gfb_kinds, only: wp
  use gfb_text, only: text
  use gfb_contact_point, only: contact_point_type
  use gfb_contact_set, only: contact_set_type
  use gfb_quad_mesh, only: quad_mesh_type, solid_rows, node_thickness
  implicit none (type, external)
  private
  public :: bump_contact, touch_with_face, touch_top_face, crest_name, line_shares, line_length, &
            normal_line_force

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

  !> The bump's face touches in place of its mid-surface: the upper face at crests, the lower at
  !> corners.
  !>
  !> A turn moves the face by its axis times the way from the node to the face.
  pure subroutine touch_with_face(mesh, thickness, turn, point)
    type(quad_mesh_type), intent(in) :: mesh !! of the strip
    real(wp), intent(in) :: thickness        !! where the mesh has none of its own [m]
    integer, intent(in) :: turn(2)           !! the set's unknowns that turn the node; 0: fixed
    type(contact_point_type), intent(inout) :: point !! of a bump
    real(wp) :: way(2), lever(axial, 2)

    associate (node => point%node)
      way = 0.5_wp*node_thickness(mesh, thickness, node)*mesh%face(:, node)
      if (point%law == contact_sleeve) way = -way
      lever(:, 1) = [-way(2), way(1), 0.0_wp] ! about the bearing's axis
      lever(:, 2) = [0.0_wp, 0.0_wp, mesh%axis_2(1, node)*way(2) - mesh%axis_2(2, node)*way(1)]
    end associate
    point%turn = turn
    point%lever = lever
  end subroutine touch_with_face

  !> The top foil's lower face is touched, after the bump's face; it is flat.
  pure subroutine touch_top_face(thickness, turn, point)
    real(wp), intent(in) :: thickness  !! of the top foil [m]
    integer, intent(in) :: turn(:, :)  !! (2, nodes) the set's unknowns that turn the master's nodes
    type(contact_point_type), intent(inout) :: point !! of a crest
    real(wp) :: lever(axial, 2*size(point%share))
    integer :: k

    lever = 0.0_wp
    do k = 1, size(point%share)
      lever(tangential, 2*k - 1) = -0.5_wp*thickness*point%share(k)
      lever(axial, 2*k) = 0.5_wp*thickness*point%share(k)
    end do
    point%turn = [point%turn, reshape(turn, [size(turn)])]
    point%lever = reshape([point%lever, lever], [axial, size(point%turn)])
  end subroutine touch_top_face

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
  pure real(wp) function line_length(mesh, line) result(length)
    type(quad_mesh_type), intent(in) :: mesh !! of the strip
    integer, intent(in) :: line(:) !! nodes in order of z

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
