!> An answer on half the width as a start on the whole width, where nothing tilts yet.
module gfb_full_width_start
  use gfb_kinds, only: wp
  use gfb_petsc_session, only: fetch_entries
  use gfb_shell_geometry, only: node_unknowns
  use gfb_foil_surface, only: foil_surface_type
  use gfb_foil_model, only: foil_model_type
  use gfb_foil_builder, only: axial, about_tangent
  use gfb_bearing, only: film_values
  use gfb_bearing_system, only: bearing_system_type
  implicit none (type, external)
  private
  public :: take_full_width

contains

  !> Makes the answer on half the width, and its mirror, the state on the whole width.
  subroutine take_full_width(half, whole)
    type(bearing_system_type), intent(in) :: half     !! with its answer
    type(bearing_system_type), intent(inout) :: whole !! gets a start value
    real(wp) :: narrow(half%local_size()), unknown(whole%local_size())
    type(foil_surface_type), allocatable :: half_surface(:), full_surface(:)
    integer :: i

    call half%get_unknowns(narrow)
    unknown = 0.0_wp
    associate (mesh => whole%pad(1)%mesh, nodes => size(whole%pad(1)%mesh%mesh_node))
      unknown(:nodes) = film_values(half, narrow(:size(half%pad(1)%mesh%mesh_node)), &
                                    [(mirrored(mesh%mesh_node(i), whole%pad(1)%whole%rows()), i=1, nodes)])
      where (.not. mesh%owned) unknown(:nodes) = 0.0_wp
    end associate
    if (whole%floats) unknown(whole%first_shaft + 1:) = merge(half%eccentricity(), 0.0_wp, whole%last_rank)
    half_surface = half%pad(1)%foil%surfaces()
    full_surface = whole%pad(1)%foil%surfaces()
    do i = 1, size(full_surface)
      call mirror_surface(half%pad(1)%foil, half_surface(i), narrow, whole%pad(1)%foil, full_surface(i), i, unknown)
    end do
    call whole%add_up(unknown, whole%state)
  end subroutine take_full_width

  !> The owned unknowns of one surface; what turns its sense in the mirror is negative where z is.
  subroutine mirror_surface(half, half_surface, narrow, whole, full_surface, surface, unknown)
    class(foil_model_type), intent(in) :: half, whole
    type(foil_surface_type), intent(in) :: half_surface, full_surface
    real(wp), intent(in) :: narrow(:)      !! half's local unknowns of the bearing, in SI
    integer, intent(in) :: surface         !! which of the foils' surfaces it is
    real(wp), intent(inout) :: unknown(:)  !! whole's
    integer, allocatable :: own(:), wanted(:)
    real(wp), allocatable :: value(:, :)
    integer :: i, k, number, rows

    own = pack(half_surface%part%mesh_node, half_surface%part%owned)
    allocate (value(node_unknowns, size(own)), source=0.0_wp)
    do i = 1, size(own)
      do k = 1, node_unknowns
        number = half%own_unknown(surface, k, own(i))
        if (number > 0) value(k, i) = narrow(half%first + number)
      end do
    end do
    wanted = pack(full_surface%part%mesh_node, full_surface%part%owned)
    rows = full_surface%mesh%rows
    value = fetch_entries(half_surface%mesh%nodes(), own, value, [(mirrored(wanted(i), rows), i=1, size(wanted))])
    do i = 1, size(wanted)
      if (modulo(wanted(i) - 1, rows) < rows/2) value([axial, about_tangent], i) = -value([axial, about_tangent], i)
      do k = 1, node_unknowns
        number = whole%own_unknown(surface, k, wanted(i))
        if (number > 0) unknown(whole%first + number) = value(k, i)
      end do
    end do
  end subroutine mirror_surface

  !> The half's node that is a node of the whole, or its mirror; numbers run along stations of rows.
  pure function mirrored(node, rows) result(number)
    integer, intent(in) :: node, rows !! of the whole width, an odd number of rows
    integer :: number
    integer :: station, row

    station = (node - 1)/rows
    row = abs(modulo(node - 1, rows) - rows/2)
    number = station*(rows/2 + 1) + row + 1
  end function mirrored
end module gfb_full_width_start
