#include "gfb_petsc.h"
!> Derivatives of a bearing's heat, see `gfb_film_heat`: an element's block of the matrix, gas over edges, slits, walls.
module gfb_film_heat_rates
  use petscmat
  use gfb_kinds, only: wp
  use gfb_petsc_kinds, only: pint
  use gfb_heated_film, only: heated_jacobian, heated_rows, heated_fields, row_mass, row_energy, row_foil, row_shaft, &
                             field_pressure, field_gap, field_gas, field_foil, field_shaft, wall_given, wall_conductance
  use gfb_bearing_heat, only: film_heat_type, moduli_at
  use gfb_pad, only: pad_type
  use gfb_bearing, only: bearing_type, bearing_state_type
  use gfb_film_heat, only: slit_type, equations_type, equations_of, element_rows, element_walls, exchange_matrix, nodal_areas, &
                           slits_of, pad_after, state_of, feed, is_leading, is_trailing
  implicit none (type)
  private
  public :: add_heat_jacobian

  !> Positions of what an element's equations depend on.
  type :: unknowns_type
    integer, allocatable :: pressure(:), gas(:) !! (nodes)
    integer, allocatable :: foil(:), shaft(:), channel(:) !! (nodes) temperatures
    integer :: sleeve = 0
    integer, allocatable :: walls(:)          !! these four together
    integer, allocatable :: mover(:)          !! (nodes) what moves the foil, unless it is the pressure itself
    integer, allocatable :: coordinate(:)     !! of the shaft
    integer :: mean = 0                       !! temperature of the top foil that springs without unknowns follow
    integer :: count = 0
  end type unknowns_type

  !> What an element adds to the matrix: the same positions for all elements, local unknowns of the bearing for each.
  type :: element_block_type
    type(equations_type) :: row
    type(unknowns_type) :: column
    integer, allocatable :: equation(:) !! local unknown whose equation it is; 0: none is filled
    integer, allocatable :: unknown(:)  !! local unknown; 0: there is none
    real(wp), allocatable :: value(:, :) !! (unknowns, equations): as PETSc reads it, row by row
  end type element_block_type

contains

  !> Adds the derivatives of all that elements, edges, slits and walls say.
  subroutine add_heat_jacobian(bearing, state, flow, room, matrix)
    class(bearing_type), intent(in) :: bearing !! with heat
    type(bearing_state_type), intent(in) :: state !! of it
    real(wp), intent(in) :: flow(:) !! see `add_heat_flows`
    logical, intent(in) :: room !! zeros alone, where they stand; the state has no values then
    Mat, intent(in) :: matrix !! by the bearing's local numbers
    type(slit_type) :: slit(size(bearing%pad))
    type(element_block_type) :: block
    real(wp) :: factor
    integer :: i, element

    associate (heat => bearing%heat, pads => bearing%pad)
      block = element_block(size(pads(1)%film%shape, 1), size(bearing%coordinate))
      if (.not. room) slit = slits_of(heat, pads, state%unknown, flow)
      factor = merge(0.0_wp, 1.0_wp, room)
      do i = 1, size(pads)
        associate (pad => pads(i))
          do element = 1, size(pad%film%element_nodes, 2)
            call place_block(bearing, i, element, block)
            block%value = 0.0_wp
            if (.not. room) then
              call put_element(bearing, state, i, element, block)
              call put_edges(bearing, state, i, element, slit, flow, block)
            end if
            call put_block(matrix, block%equation, block%unknown, block%value)
            if (heat%softens()) then
              call put_mean(heat, i, pad%film%element_nodes(:, element), factor*nodal_areas(pad, element), matrix)
            end if
          end do
        end associate
      end do
      call add_flow_rates(heat, pads, slit, factor, flow, matrix)
      if (bearing%last_rank) call add_wall_rates(heat, pads, slit, factor, matrix)
    end associate
  end subroutine add_heat_jacobian

  !> Positions of what an element's equations depend on.
  pure function unknowns_of(nodes, coordinates) result(column)
    integer, intent(in) :: nodes !! of the element
    integer, intent(in) :: coordinates !! of the shaft, that are unknowns
    type(unknowns_type) :: column
    integer :: i

    associate (at_nodes => [(i, i=1, nodes)])
      column%pressure = at_nodes
      column%gas = nodes + at_nodes
      column%foil = 2*nodes + at_nodes
      column%shaft = 3*nodes + at_nodes
      column%channel = 4*nodes + at_nodes
      column%sleeve = 5*nodes + 1
      column%walls = [column%foil, column%shaft, column%channel, column%sleeve]
      column%mover = column%sleeve + at_nodes
    end associate
    column%coordinate = column%sleeve + nodes + [(i, i=1, coordinates)]
    column%mean = column%sleeve + nodes + coordinates + 1
    column%count = column%mean
  end function unknowns_of

  !> A block for the elements of a bearing.
  pure function element_block(nodes, coordinates) result(block)
    integer, intent(in) :: nodes !! of an element
    integer, intent(in) :: coordinates !! of the shaft, that are unknowns
    type(element_block_type) :: block

    block%row = equations_of(nodes)
    block%column = unknowns_of(nodes, coordinates)
    allocate (block%equation(block%row%count), block%unknown(block%column%count), block%value(block%column%count, block%row%count))
  end function element_block

  !> Local unknowns of the equations of an element, and of what they depend on.
  pure subroutine place_block(bearing, number, element, block)
    class(bearing_type), intent(in) :: bearing
    integer, intent(in) :: number !! of the pad
    integer, intent(in) :: element
    type(element_block_type), intent(inout) :: block
    integer :: k

    associate (heat => bearing%heat, pad => bearing%pad(number), foil => bearing%pad(number)%foil, &
               nodes => bearing%pad(number)%film%element_nodes(:, element), row => block%row, column => block%column)
      block%equation(:row%sleeve) = element_rows(heat, pad, element, row)
      where (pad%film%fixed(nodes)) block%equation(row%of_film(:, row_mass)) = 0
      block%equation([row%slit, row%next_slit]) = 0
      if (any(is_leading(pad, nodes) .or. is_trailing(pad, nodes))) then
        block%equation([row%slit, row%next_slit]) = heat%place_of_slit([number, pad_after(bearing%pad, number)])
      end if
      block%unknown(column%pressure) = pad%first + nodes
      block%unknown(column%gas) = heat%place_of_gas(number, nodes)
      block%unknown(column%walls) = element_walls(heat, pad, element)
      if (heat%channels == 0) block%unknown(column%channel) = 0
      block%unknown(column%mover) = merge(0, pad%first + foil%source(nodes), foil%source(nodes) == nodes .or. foil%source(nodes) == 0)
      block%unknown(column%coordinate) = bearing%first_shaft + [(k, k=1, size(bearing%coordinate))]
      block%unknown(column%mean) = mean_of(heat, pad)
    end associate
  end subroutine place_block

  !> Local unknown of the mean temperature of a pad's top foil where it moves the gap: of springs without unknowns; else 0.
  pure integer function mean_of(heat, pad) result(mean)
    type(film_heat_type), intent(in) :: heat
    type(pad_type), intent(in) :: pad

    mean = 0
    if (heat%softens() .and. pad%foil%local_unknowns() == 0) mean = heat%place_of_mean(pad%number)
  end function mean_of

  !> Derivatives of an element's part of the equation of the mean temperature of a pad's top foil.
  subroutine put_mean(heat, number, nodes, area, matrix)
    type(film_heat_type), intent(in) :: heat
    integer, intent(in) :: number !! of the pad
    integer, intent(in) :: nodes(:) !! of the element
    real(wp), intent(in) :: area(:) !! of each; 0: makes room [m2]
    Mat, intent(in) :: matrix

    associate (mean => heat%place_of_mean(number))
      call put_block(matrix, [mean], [heat%place_of_foil(number, nodes), mean], reshape([area, -sum(area)], [size(area) + 1, 1]))
    end associate
  end subroutine put_mean

  !> How the gap at a pad's nodes falls by the mean temperature of its top foil, or the sleeve's, where springs without unknowns
  !> soften by them [m/K].
  pure function sinking_of(bearing, state, number, nodes) result(rate)
    class(bearing_type), intent(in) :: bearing
    type(bearing_state_type), intent(in) :: state
    integer, intent(in) :: number !! of the pad
    integer, intent(in) :: nodes(:) !! of an element
    real(wp) :: rate(size(nodes)), ratio(2), by(2)

    rate = 0.0_wp
    associate (pad => bearing%pad(number))
      if (mean_of(bearing%heat, pad) == 0) return
      call moduli_at(bearing%heat, number, state%point%growth, state%unknown, ratio, by)
      associate (deflection => pad%foil%deflection(state%unknown(pad%first + 1:pad%last), ratio))
        rate = -deflection(nodes)*by(2)/ratio(2)
      end associate
    end associate
  end function sinking_of

  !> Derivatives of what an element says.
  pure subroutine put_element(bearing, state, number, element, block)
    class(bearing_type), intent(in) :: bearing
    type(bearing_state_type), intent(in) :: state
    integer, intent(in) :: number !! of the pad
    integer, intent(in) :: element
    type(element_block_type), intent(inout) :: block !! zero before
    real(wp) :: by(size(bearing%pad(1)%film%shape, 1), heated_rows, size(bearing%pad(1)%film%shape, 1), heated_fields)
    real(wp) :: by_excess(size(by, 1), heated_rows, size(by, 1)), factor(heated_rows), sinking(size(by, 1))
    integer :: k, b, c, mover

    associate (heat => bearing%heat, pad => bearing%pad(number), film => bearing%pad(number)%film, foil => bearing%pad(number)%foil, &
               nodes => bearing%pad(number)%film%element_nodes(:, element), column => block%column, growth => state%point%growth)
      sinking = sinking_of(bearing, state, number, nodes)
      call heated_jacobian(film%geometry(element), film%flow_at(state%point), heat%gas, &
                           state_of(heat, pad, element, state%point, state%unknown, state%gap(pad%first_node + 1:pad%last_node)), by, by_excess)
      block%value(column%walls, block%row%walls) = transpose(exchange_matrix(heat, pad, element))
      factor = 1.0_wp
      factor(row_foil) = -1.0_wp
      factor(row_shaft) = film%copies
      do k = 1, heated_rows
        by(:, k, :, :) = factor(k)*by(:, k, :, :)
        associate (part => block%value(:, block%row%of_film(1, k):block%row%of_film(size(by, 1), k)), by_gap => by(:, k, :, field_gap))
          part(column%pressure, :) = part(column%pressure, :) + transpose(by(:, k, :, field_pressure))
          part(column%gas, :) = part(column%gas, :) + transpose(by(:, k, :, field_gas))
          part(column%foil, :) = part(column%foil, :) + transpose(by(:, k, :, field_foil))
          part(column%shaft, :) = part(column%shaft, :) + transpose(by(:, k, :, field_shaft) - growth*heat%shaft%growth*by_gap)
          part(column%sleeve, :) = part(column%sleeve, :) + growth*heat%sleeve%growth*sum(by_gap, 2)
          part(column%mean, :) = matmul(by_gap, sinking)
          part(column%sleeve, :) = part(column%sleeve, :) + matmul(by_gap, sinking)
          do b = 1, size(nodes)
            mover = merge(column%pressure(b), column%mover(b), foil%source(nodes(b)) == nodes(b)) ! of springs the pressure itself
            part(mover, :) = part(mover, :) + foil%rate(nodes(b))*by_gap(:, b)
            do c = 1, size(bearing%coordinate)
              associate (at => column%coordinate(c), coordinate => bearing%coordinate(c))
                part(at, :) = part(at, :) + film%motion(coordinate, nodes(b))*by_gap(:, b) &
                  + film%motion_excess(coordinate, b, element)*factor(k)*by_excess(:, k, b)
              end associate
            end do
          end do
        end associate
      end do
    end associate
  end subroutine put_element

  !> What flows over edges changes with the mass equations of their nodes, which stand in the block.
  pure subroutine put_edges(bearing, state, number, element, slit, flow, block)
    class(bearing_type), intent(in) :: bearing
    type(bearing_state_type), intent(in) :: state
    integer, intent(in) :: number !! of the pad
    integer, intent(in) :: element
    type(slit_type), intent(in) :: slit(:)
    real(wp), intent(in) :: flow(:)
    type(element_block_type), intent(inout) :: block
    integer :: b, next

    next = pad_after(bearing%pad, number)
    associate (pad => bearing%pad(number), heat => bearing%heat, density => bearing%heat%gas%density, row => block%row, value => block%value)
      do b = 1, size(pad%film%shape, 1)
        associate (node => pad%film%element_nodes(b, element))
          if (.not. pad%film%fixed(node)) cycle
          associate (mass => value(:, row%of_film(b, row_mass)), energy => row%of_film(b, row_energy), &
                     inflow => flow(pad%first + node), gas => state%unknown(heat%place_of_gas(number, node)))
            if (inflow > 0.0_wp) then
              value(:, energy) = value(:, energy) &
                + heat%gas%specific_heat*density*(gas - feed(heat, pad, node, state%unknown))*mass
              if (is_leading(pad, node)) value(:, row%slit) = value(:, row%slit) + pad%film%copies*density*slit(number)%by_inflow* &
                                                              (state%unknown(heat%place_of_slit(number)) - heat%ambient)*mass
            else if (is_trailing(pad, node)) then
              associate (left => slit(next), rise => state%unknown(heat%place_of_slit(next)) - heat%ambient)
                value(:, row%next_slit) = value(:, row%next_slit) &
                  + pad%film%copies*density*(left%share*(gas - heat%ambient) - left%by_outflow*rise)*mass
              end associate
            end if
          end associate
        end associate
      end do
    end associate
  end subroutine put_edges

  !> Derivatives by temperatures of what flows over the edges, and of what is given.
  subroutine add_flow_rates(heat, pads, slit, factor, flow, matrix)
    type(film_heat_type), intent(in) :: heat
    type(pad_type), intent(in) :: pads(:)
    type(slit_type), intent(in) :: slit(:)
    real(wp), intent(in) :: factor !! 0: makes room [1]
    real(wp), intent(in) :: flow(:)
    Mat, intent(in) :: matrix
    integer :: i, node, next

    do i = 1, size(pads)
      next = pad_after(pads, i)
      associate (pad => pads(i), film => pads(i)%film)
        do node = 1, size(film%fixed)
          if (.not. pad%mesh%owned(node)) cycle
          associate (gas => heat%place_of_gas(i, node), foil => heat%place_of_foil(i, node), &
                     inflow => factor*heat%gas%density*flow(pad%first + node))
            if (.not. heat%sheet) call put_block(matrix, [foil], [foil], reshape([factor], [1, 1]))
            if (.not. film%fixed(node)) cycle
            call put_block(matrix, [pad%first + node], [pad%first + node], reshape([factor], [1, 1]))
            associate (gain => heat%gas%specific_heat*max(inflow, 0.0_wp), &
                       slit => merge(heat%place_of_slit(i), 0, is_leading(pad, node)))
              call put_block(matrix, [gas], [gas, slit], reshape([gain, -gain], [2, 1]))
            end associate
            if (.not. is_trailing(pad, node)) cycle
            call put_block(matrix, [heat%place_of_slit(next)], [gas], &
                           reshape([-slit(next)%share*film%copies*max(-inflow, 0.0_wp)], [1, 1]))
          end associate
        end do
      end associate
    end do
  end subroutine add_flow_rates

  !> Derivatives of what the walls give away.
  subroutine add_wall_rates(heat, pads, slit, factor, matrix)
    type(film_heat_type), intent(in) :: heat
    type(pad_type), intent(in) :: pads(:)
    type(slit_type), intent(in) :: slit(:)
    real(wp), intent(in) :: factor !! 0: makes room [1]
    Mat, intent(in) :: matrix
    real(wp) :: rate(heat%first_wall + 1:heat%last())
    integer :: i

    rate = 0.0_wp
    associate (copies => pads(1)%film%copies, shaft => heat%place_of_shaft(1), end => heat%place_of_shaft(heat%shafts))
      select case (heat%shaft%kind)
      case (wall_given)
        rate(shaft) = 1.0_wp
      case (wall_conductance)
        rate(shaft) = -heat%shaft%conductance
      case default
        if (.not. copies > 1.0_wp) rate(shaft) = -heat%end_conductance(1)
        rate(end) = rate(end) - copies*heat%end_conductance(2)
      end select
      rate(heat%place_of_sleeve()) = merge(1.0_wp, -heat%sleeve%conductance, heat%sleeve%kind == wall_given)
    end associate
    do i = 1, size(pads)
      rate(heat%place_of_slit(i)) = slit(i)%flow
    end do
    if (heat%channels > 0) rate(heat%place_of_channel(1)) = heat%cooling
    do i = heat%first_wall + 1, heat%last()
      call put_block(matrix, [i], [i], reshape([factor*rate(i)], [1, 1]))
    end do
  end subroutine add_wall_rates

  !> Adds a block by local numbers, from 1; zero is skipped.
  subroutine put_block(matrix, row, column, block)
    Mat, intent(in) :: matrix
    integer, intent(in) :: row(:), column(:)
    real(wp), intent(in) :: block(:, :) !! a row of the matrix in each column [SI]
    PetscErrorCode :: ierr
    PetscCallA(MatSetValuesLocal(matrix, size(row, 1, pint), int(row - 1, pint), size(column, 1, pint), int(column - 1, pint), reshape(block, [size(block)]), ADD_VALUES, ierr))
  end subroutine put_block
end module gfb_film_heat_rates
