#include "gfb_petsc.h"
!> Heat as a block of a bearing's equations: film with energy, top foil and walls, see `gfb_film_heat`.
module gfb_heat_block
  use petscmat
  use gfb_kinds, only: wp
  use gfb_operating_point, only: operating_point_type
  use gfb_bearing_heat, only: number_heat, heat_sizes, heat_scale, growth_of
  use gfb_bearing, only: bearing_type, bearing_block_type, bearing_state_type, scalar_group_type, shown_field_type
  use gfb_film_heat, only: heat_flows, add_heat_flows, add_shaft_flux
  use gfb_film_heat_rates, only: add_heat_jacobian
  use gfb_heat_answer, only: heat_answer_type
  use gfb_heat_numbers, only: heat_numbers, heat_of_answer, mean_temperature, measure_heat, add_heat_number_rates, follow_heat
  implicit none (type)
  private
  public :: heat_block

  integer, parameter :: gas = 1, top_foil = 2, into_shaft = 3 !! fields: unknowns of a node, and a flux

contains

  !> The block of a bearing with heat; counts its walls.
  subroutine heat_block(bearing, block)
    class(bearing_type), intent(inout) :: bearing !! with its pads
    type(bearing_block_type), intent(out) :: block !! not numbered yet

    call number_heat(bearing%heat, size(bearing%pad), bearing%mesh%rows())
    block%name = 'heat'
    block%fields = top_foil
    block%scalars = bearing%heat%walls
    block%unknown_size = heat_scale
    block%start = bearing%heat%ambient
    block%positive = .true.
    block%has_film = .true.
    block%is_slow = .true.
    block%mover = 'temperature (thermal runaway)'
    block%take_numbers => take_numbers
    block%equation_sizes => sizes_of_equations
    block%add_residual => heat_residual
    block%add_jacobian => heat_jacobian
    block%groups => walls_in_groups
    block%add_gap => take_growth_off
    block%gauge => hottest_film
    block%shown = [shown_field_type('temperature', 'K', 'at which the gas carries its heat'), &
                   shown_field_type('top_foil_temperature', 'K', 'of the top foil'), &
                   shown_field_type('heat_flux_shaft', 'W/m2', 'of the heat into the shaft')]
    block%show => field_of_heat
    block%numbers = heat_numbers
    block%extremes = 2
    block%extreme_field => extreme_of_heat
    block%measure => measure_heat
    block%add_number_rates => add_heat_number_rates
    block%follow_gap => follow_heat
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

  !> Temperature and speed take their growth off the gap.
  pure subroutine take_growth_off(bearing, point, unknown, gap)
    class(bearing_type), intent(in) :: bearing
    type(operating_point_type), intent(in) :: point
    real(wp), intent(in) :: unknown(:)
    real(wp), intent(inout) :: gap(:)
    integer :: i

    do i = 1, size(bearing%pad)
      associate (pad => bearing%pad(i), h => gap(bearing%pad(i)%first_node + 1:bearing%pad(i)%last_node))
        h = h - growth_of(bearing%heat, pad%mesh%mesh_node, pad%whole%rows(), point, unknown)
      end associate
    end do
  end subroutine take_growth_off

  !> The hottest place of the film as the gas feels it [K].
  subroutine hottest_film(bearing, value)
    class(bearing_type), intent(in) :: bearing
    real(wp), intent(out) :: value
    type(heat_answer_type) :: answer

    answer = heat_of_answer(bearing)
    value = bearing%heat%ambient + bearing%point%growth*(answer%whole%maximum_film_temperature - bearing%heat%ambient)
  end subroutine hottest_film

  !> Temperatures of gas and top foil, heat that flows into the shaft.
  subroutine field_of_heat(bearing, unknown, which, value)
    class(bearing_type), intent(in) :: bearing
    real(wp), intent(in) :: unknown(:)
    integer, intent(in) :: which
    real(wp), intent(out) :: value(:)
    real(wp), dimension(bearing%local_size()) :: flux, area

    if (which /= into_shaft) then
      value = unknown(bearing%heat%first(1) + which:bearing%heat%first_wall:top_foil)
      return
    end if
    flux = 0.0_wp
    area = 0.0_wp
    call add_shaft_flux(bearing, bearing_state_type(bearing%position(unknown), bearing%point, unknown, bearing%gap(unknown)), flux, area)
    value = bearing%film_pressure(bearing%summed(flux))/bearing%film_pressure(bearing%summed(area))
  end subroutine field_of_heat

  !> Fields whose largest values are numbers: the mean over the gap, and the top foil.
  subroutine extreme_of_heat(bearing, unknown, which, value)
    class(bearing_type), intent(in) :: bearing
    real(wp), intent(in) :: unknown(:)
    integer, intent(in) :: which
    real(wp), intent(out) :: value(:)

    if (which == 1) then
      value = mean_temperature(bearing, unknown)
    else
      call field_of_heat(bearing, unknown, top_foil, value)
    end if
  end subroutine extreme_of_heat
end module gfb_heat_block
