!> The surfaces of a bearing's foil, with displacements, stresses and contacts.
module gfb_foil_output
  use gfb_kinds, only: wp
  use gfb_text, only: text
  use gfb_bearing_system, only: bearing_system_type
  use gfb_foil_surface, only: foil_surface_type, surface_motion_type
  use gfb_grid, only: result_grid_type
  use gfb_foil_grid, only: create_foil_grid, add_displacement, add_contacts, add_stress
  implicit none (type, external)
  private
  public :: add_foil_grids

contains

  !> Adds the surfaces that the foil has at the present state, of several pads under names with their numbers; a foil
  !> without a mesh has none.
  subroutine add_foil_grids(bearing, grids)
    type(bearing_system_type), intent(in) :: bearing !! at the state to be written
    type(result_grid_type), allocatable, intent(inout) :: grids(:) !! to be written

    type(foil_surface_type), allocatable :: surface(:)
    type(surface_motion_type), allocatable :: motion(:)
    type(result_grid_type) :: grid
    real(wp) :: unknown(bearing%local_size())
    character(len=:), allocatable :: behind !! the surface's name
    integer :: i, k

    call bearing%get_unknowns(unknown)
    surface = bearing%pad(1)%foil%surfaces()
    if (size(surface) == 0) return
    behind = ''
    do k = 1, size(bearing%pad)
      associate (pad => bearing%pad(k))
        if (size(bearing%pad) > 1) behind = '_'//text(k)
        motion = pad%foil%motions(unknown(pad%first + 1:pad%last))
        do i = 1, size(surface)
          call create_foil_grid(surface(i), surface(i)%name//behind, grid)
          grid%grid%point(3, :) = grid%grid%point(3, :) + pad%film%offset
          call add_displacement(surface(i), 'displacement', 'of the mid-surface', motion(i)%displacement, grid)
          call add_stress(surface(i), motion(i)%stress, grid)
          if (surface(i)%has_contacts) call add_contacts(pad%foil%nodal_contacts(), surface(i), grid)
          grids = [grids, grid]
        end do
      end associate
    end do
  end subroutine add_foil_grids
end module gfb_foil_output
