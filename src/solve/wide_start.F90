!> An answer on half the width as a start on the whole width, where nothing tilts yet.
module gfb_wide_start
  use gfb_kinds, only: wp
  use gfb_petsc_session, only: sum_over_ranks
  use gfb_shell_foil, only: shell_foil_type
  use gfb_foil_builder, only: axial, about_tangent
  use gfb_bearing_system, only: bearing_system_type, film_on_all_ranks
  implicit none (type, external)
  private
  public :: widen

contains

  !> Makes the answer on half the width, and its mirror, the state on the whole width.
  subroutine widen(half, whole)
    type(bearing_system_type), intent(in) :: half
    type(bearing_system_type), intent(inout) :: whole
    real(wp) :: narrow(half%local_size()), unknown(whole%local_size())
    real(wp) :: pressure(half%whole%nodes())
    integer :: node

    call half%get_unknowns(narrow)
    pressure = film_on_all_ranks(half, narrow(:size(half%mesh%mesh_node)))
    unknown = 0.0_wp
    do node = 1, size(whole%mesh%mesh_node)
      unknown(node) = pressure(mirrored(whole%mesh%mesh_node(node), whole%whole%rows()))
    end do
    if (whole%floats) unknown(whole%first_shaft + 1:) = half%eccentricity()
    select type (wide => whole%foil)
    class is (shell_foil_type)
      select type (foil => half%foil)
      class is (shell_foil_type)
        call widen_foil(foil, narrow, wide, unknown)
      end select
    end select
    call whole%set_unknowns(unknown)
  end subroutine widen

  !> The foils' unknowns, by their places in the meshes.
  subroutine widen_foil(half, narrow, whole, unknown)
    class(shell_foil_type), intent(in) :: half, whole
    real(wp), intent(in) :: narrow(:)      !! half's local unknowns of the bearing, in SI
    real(wp), intent(inout) :: unknown(:)  !! whole's
    real(wp), allocatable :: of_half(:), of_whole(:)
    integer :: i

    allocate (of_half(0:half%top%unknowns + half%bumps%unknowns), source=0.0_wp)
    allocate (of_whole(0:whole%top%unknowns + whole%bumps%unknowns), source=0.0_wp)
    do i = 1, size(half%own_place)
      of_half(half%global_unknown(half%own_place(i))) = narrow(half%first + half%own_place(i))
    end do
    of_half = sum_over_ranks(of_half) ! every one has one owner
    call widen_mesh(half%top_number, whole%top_number, whole%top%mesh%rows, of_half, of_whole)
    call widen_mesh(half%bump_number, whole%bump_number, whole%bumps%mesh%rows, of_half, of_whole)
    do i = 1, whole%local_unknowns()
      unknown(whole%first + i) = of_whole(whole%global_unknown(i))
    end do
  end subroutine widen_foil

  !> One mesh's unknowns; what turns its sense in the mirror is negative where z is.
  pure subroutine widen_mesh(half_number, whole_number, rows, of_half, of_whole)
    integer, intent(in) :: half_number(:, :), whole_number(:, :) !! (5, nodes) 0: held
    integer, intent(in) :: rows                                  !! of the whole width
    real(wp), intent(in) :: of_half(0:)
    real(wp), intent(inout) :: of_whole(0:)
    integer :: node, k
    real(wp) :: value(size(whole_number, 1))

    do node = 1, size(whole_number, 2)
      value = of_half(half_number(:, mirrored(node, rows)))
      if (modulo(node - 1, rows) < rows/2) value([axial, about_tangent]) = -value([axial, about_tangent])
      do k = 1, size(value)
        of_whole(whole_number(k, node)) = value(k)
      end do
    end do
  end subroutine widen_mesh

  !> The half's node that is a node of the whole, or its mirror; numbers run along stations of rows.
  pure function mirrored(node, rows) result(number)
    integer, intent(in) :: node, rows !! of the whole width, an odd number of rows
    integer :: number
    integer :: station, row

    station = (node - 1)/rows
    row = abs(modulo(node - 1, rows) - rows/2)
    number = station*(rows/2 + 1) + row + 1
  end function mirrored
end module gfb_wide_start
