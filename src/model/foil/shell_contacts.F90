!> Contacts of a bump foil of shells: its corner lines with the sleeve, its crests with the top foil.
module gfb_shell_contacts
  use gfb_kinds, only: wp
  use gfb_text, only: text
  use gfb_bump_foil_case, only: gap_of_crest, gap_of_corner
  use gfb_scene, only: scene_type
  use gfb_film_mesh, only: film_mesh_type
  use gfb_quad_mesh, only: quad_mesh_type, node_set, set_count, strip_at
  use gfb_contact_point, only: contact_point_type
  use gfb_shell_geometry, only: node_unknowns
  use gfb_bump_contacts, only: bump_contact, touch_with_face, touch_top_face, line_shares, line_length, crest_name, corner_name, &
                               contact_sleeve, contact_top
  use gfb_master_search, only: find_masters
  use gfb_projection, only: projection_type, project
  use gfb_shell_foil, only: shell_foil_type
  use gfb_foil_ranges, only: foil_ranges_type
  use gfb_top_mesh, only: top_mesh
  implicit none (type, external)
  private
  public :: add_shell_contacts

  integer, parameter :: tangential = 1, axial = 3 !! components of a displacement
  integer, parameter :: corners = 4

contains

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
    integer, allocatable :: crest(:), element(:), kept(:), nodes(:, :), number(:, :), pressed(:)
    integer :: i, k, before

    crest = pack([(i, i=1, size(foil%contacts%point))], foil%contacts%point%law == contact_top)
    allocate (element(size(crest)), coordinates(2, size(crest)), nodes(corners, size(crest)))
    points = foil%bumps%mesh%position(:, foil%contacts%point(crest)%node)
    above = top_mesh(film, height, stations_above(film, points(tangential, :)))
    before = lbound(above%position, 2) - 1
    call find_masters(points, above%position, above%element_nodes - before, height, element, coordinates)
    do i = 1, size(crest)
      nodes(:, i) = 1
      if (element(i) > 0) nodes(:, i) = above%element_nodes(:, lbound(above%element_nodes, 2) + element(i) - 1)
    end do
    number = ranges%of_top(foil%top%numbers_at([nodes]))
    do i = 1, size(crest)
      if (element(i) == 0) cycle
      associate (point => foil%contacts%point(crest(i)))
        foot = project(above%position(:, nodes(:, i)), points(:, i))
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

  !> The stretch of the film's stations above some points, with a column to spare on both sides.
  pure function stations_above(film, x) result(window)
    type(film_mesh_type), intent(in) :: film !! the film's whole mesh
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
end module gfb_shell_contacts
