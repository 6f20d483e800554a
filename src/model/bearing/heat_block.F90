#include "gfb_petsc.h"
!> Heat as a block of a bearing's equations: film with energy, top foil and walls, see `gfb_film_heat`.
module gfb_heat_block
  use petscmat
  use gfb_kinds, only: wp
  use gfb_bearing_heat, only: number_heat, heat_sizes, heat_scale
  use gfb_bearing, only: bearing_type, bearing_block_type, bearing_state_type, scalar_group_type
  use gfb_film_heat, only: add_heat_residual, add_heat_flows
  use gfb_film_heat_rates, only: add_heat_jacobian
  implicit none (type)
  private
  public :: heat_block, heat_flows

contains

  !> The block of a bearing with heat; counts its walls.
  subroutine heat_block(bearing, block)
    class(bearing_type), intent(inout) :: bearing !! with its pads
    type(bearing_block_type), intent(out) :: block !! not numbered yet

    call number_heat(bearing%heat, size(bearing%pad), bearing%pad(1)%whole%rows())
    block%name = 'heat'
    block%fields = 2
    block%scalars = bearing%heat%walls
    block%unknown_size = heat_scale
    block%start = bearing%heat%ambient
    block%positive = .true.
    block%has_film = .true.
    block%take_numbers => take_numbers
    block%equation_sizes => sizes_of_equations
    block%add_residual => heat_residual
    block%add_jacobian => heat_jacobian
    block%groups => walls_in_groups
  end subroutine heat_block

  !> Where temperatures stand.
  pure subroutine take_numbers(bearing, block)
    class(bearing_type), intent(inout) :: bearing
    type(bearing_block_type), intent(in) :: block

    bearing%heat%first = block%first
    bearing%heat%first_wall = block%first_scalar
  end subroutine take_numbers

  !> Sizes of the equations of temperatures.
  pure subroutine sizes_of_equations(bearing, scale)
    class(bearing_type), intent(in) :: bearing
    real(wp), intent(out) :: scale(:)
    scale = heat_sizes(bearing%heat, bearing%pad(1)%film)
  end subroutine sizes_of_equations

  !> Film, energy, foil and walls.
  subroutine heat_residual(bearing, state, residual)
    class(bearing_type), intent(in) :: bearing
    type(bearing_state_type), intent(in) :: state
    real(wp), intent(inout) :: residual(:)
    real(wp), allocatable :: flow(:)

    flow = heat_flows(bearing, state, residual)
    call add_heat_flows(bearing, state, flow, residual)
  end subroutine heat_residual

  !> Adds what elements say of film and heat, and tells what those of all ranks take at each local unknown of a pressure.
  function heat_flows(bearing, state, residual) result(flow)
    class(bearing_type), intent(in) :: bearing !! with heat
    type(bearing_state_type), intent(in) :: state !! of it
    real(wp), intent(inout) :: residual(:) !! at pressures zero before [SI]
    real(wp), allocatable :: flow(:) !! [Pa m3/s]

    call add_heat_residual(bearing, state, residual)
    flow = bearing%summed(residual)
  end function heat_flows

  !> Their derivatives.
  subroutine heat_jacobian(bearing, state, room, matrix)
    class(bearing_type), intent(in) :: bearing
    type(bearing_state_type), intent(in) :: state
    logical, intent(in) :: room
    Mat, intent(in) :: matrix
    real(wp) :: residual(bearing%local_size()), flow(bearing%local_size())

    residual = 0.0_wp
    flow = 0.0_wp
    if (.not. room) flow = heat_flows(bearing, state, residual)
    call add_heat_jacobian(bearing, state, flow, room, matrix)
  end subroutine heat_jacobian

  !> Shaft, sleeve, slits, means of foils, channel.
  pure subroutine walls_in_groups(bearing, group)
    class(bearing_type), intent(in) :: bearing
    type(scalar_group_type), allocatable, intent(out) :: group(:)

    associate (heat => bearing%heat, pads => size(bearing%pad))
      group = [scalar_group_type(heat%place_of_shaft(1) - 1, heat%shafts, .true.), &
               scalar_group_type(heat%place_of_sleeve() - 1, 1), scalar_group_type(heat%place_of_slit(1) - 1, pads), &
               scalar_group_type(heat%place_of_mean(1) - 1, merge(pads, 0, heat%softens())), &
               scalar_group_type(heat%place_of_channel(1) - 1, heat%channels, .true.)]
    end associate
  end subroutine walls_in_groups
end module gfb_heat_block
