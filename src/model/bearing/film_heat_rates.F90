#include "gfb_petsc.h"
!> Derivatives of a bearing's heat, see `gfb_film_heat`: an element's block of the matrix, gas over edges, slits, walls.
module gfb_film_heat_rates
  use petscmat
  use gfb_kinds, only: wp
  use gfb_petsc_kinds, only: pint
  use gfb_heated_film, only: heated_jacobian, heated_rows, heated_fields, row_mass, row_energy, row_foil, row_shaft, &
                             field_pressure, field_gap, field_gas, field_foil, field_shaft, wall_given, wall_conductance
  use gfb_film_geometry, only: most_film_nodes
  use gfb_film_surface, only: shaft_coordinates
  use gfb_bearing_heat, only: film_heat_type, moduli_at
  use gfb_pad, only: pad_type
  use gfb_bearing, only: bearing_type, bearing_state_type
  use gfb_film_heat, only: slit_type, element_walls, exchange_matrix, nodal_areas, slits_of, pad_after, state_of, feed, is_leading, &
                           is_trailing
  implicit none (type)
  private
  public :: add_heat_jacobian, sinking_of, mean_of

  !> Positions of an element's equations among those that it adds to: first those of its nodes, behind them those of walls.
  type :: equations_type
    integer, allocatable :: of_film(:, :) !! (nodes, rows), see `heated_rows`; of one shaft the same for all nodes
    integer, allocatable :: channel(:)    !! (nodes)
    integer :: sleeve = 0
    integer :: slit = 0, next_slit = 0    !! mixing before its pad, and before the next one
    integer :: nodal = 0                  !! how many are of nodes
    integer :: count = 0
  end type equations_type

  !> Positions of what an element's equations depend on.
  type :: unknowns_type
    integer, allocatable :: pressure(:), gas(:) !! (nodes)
    integer, allocatable :: foil(:), shaft(:), channel(:) !! (nodes) temperatures; of one shaft, and of no channel, the same for all
    integer :: sleeve = 0
    integer, allocatable :: mover(:)          !! (nodes) what moves the foil, unless it is the pressure itself
    integer :: mean = 0                       !! temperature of the top foil that springs without unknowns follow
    integer :: count = 0                      !! behind the mean are those of the shaft's coordinates
  end type unknowns_type

  !> What moves the gap at the nodes of an element, and how far.
  type :: gap_moves_type
    real(wp) :: shaft = 0.0_wp, sleeve = 0.0_wp     !! by the temperature of these, which grow [m/K]
    real(wp) :: sinking(most_film_nodes) = 0.0_wp   !! see `sinking_of`
    integer :: mover(most_film_nodes) = 0           !! position of what moves the foil
    real(wp) :: rate(most_film_nodes) = 0.0_wp      !! by that
    real(wp) :: motion(shaft_coordinates, most_film_nodes) = 0.0_wp !! by the shaft's coordinates that are unknowns
    real(wp) :: excess(shaft_coordinates, most_film_nodes) = 0.0_wp !! the same at the points beyond that at the nodes
  end type gap_moves_type

  !> What an element adds to the matrix: the same positions for all elements, local unknowns of the bearing for each.
  type :: element_block_type
    type(equations_type) :: row
    type(unknowns_type) :: column
    integer, allocatable :: equation(:) !! local unknown whose equation it is; 0: none is filled
    integer, allocatable :: unknown(:)  !! local unknown; 0: there is none
    real(wp), allocatable :: value(:, :) !! (unknowns, equations): as PETSc reads it, row by row
  end type element_block_type

  !> Equations of a pad's nodes, put together before PETSc looks for the place of each number: an element has four or nine of the
  !> many nodes around each of its own, and says of all three equations what they depend on.
  type :: node_rows_type
    integer, allocatable :: slot(:, :)      !! (unknowns, nodes) of an element: where its unknowns stand in its nodes' rows
    real(wp), allocatable :: value(:, :, :) !! (slots, equations of a node, local nodes)
    integer, allocatable :: unknown(:, :)   !! (slots, local nodes) local unknown; 0: there is none
    integer, allocatable :: equation(:, :)  !! (equations of a node, local nodes) local unknown whose equation it is; 0: none
  end type node_rows_type

  !> Equations of walls, which hold almost all unknowns: put together here, since PETSc looks for the place of each number in them.
  type :: wall_rows_type
    real(wp), allocatable :: value(:, :)  !! (local unknowns, walls)
    logical, allocatable :: coupled(:, :) !! (local unknowns, walls)
  end type wall_rows_type

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
    type(node_rows_type) :: rows
    type(wall_rows_type) :: walls
    real(wp) :: factor
    integer :: i, element

    associate (heat => bearing%heat, pads => bearing%pad)
      block = element_block(size(pads(1)%film%shape, 1), size(bearing%coordinate), heat%shafts > 1, heat%channels > 0)
      allocate (walls%value(bearing%local_size(), heat%walls), source=0.0_wp)
      allocate (walls%coupled(bearing%local_size(), heat%walls), source=.false.)
      if (.not. room) slit = slits_of(heat, pads, state%unknown, flow)
      factor = merge(0.0_wp, 1.0_wp, room)
      do i = 1, size(pads)
        associate (pad => pads(i))
          rows = empty_rows(pad, block%column)
          do element = 1, size(pad%film%element_nodes, 2)
            call place_block(bearing, i, element, block)
            block%value = 0.0_wp
            if (.not. room) then
              call put_element(bearing, state, i, element, block)
              call put_edges(bearing, state, i, element, slit, flow, block)
            end if
            call add_to_nodes(pad%film%element_nodes(:, element), block, rows)
            call add_to_walls(heat, block, walls)
            if (heat%softens()) then
              call put_mean(heat, i, pad%film%element_nodes(:, element), factor*nodal_areas(pad, element), matrix)
            end if
          end do
          call put_nodes(rows, matrix)
        end associate
      end do
      call put_walls(heat, walls, matrix)
      call add_flow_rates(heat, pads, slit, factor, flow, matrix)
      if (bearing%last_rank) call add_wall_rates(heat, pads, slit, factor, matrix)
    end associate
  end subroutine add_heat_jacobian

  !> Room for the equations of a pad's nodes.
  pure function empty_rows(pad, column) result(rows)
    type(pad_type), intent(in) :: pad
    type(unknowns_type), intent(in) :: column
    type(node_rows_type) :: rows
    integer :: slots

    rows%slot = slots_of(pad, column)
    slots = maxval(rows%slot)
    associate (nodes => size(pad%mesh%mesh_node))
      allocate (rows%value(slots, row_foil, nodes), source=0.0_wp)
      allocate (rows%unknown(slots, nodes), rows%equation(row_foil, nodes), source=0)
    end associate
  end function empty_rows

  !> Where the unknowns of an element stand in the rows of its nodes: those of the nodes around them station by station, so that numbers
  !> rise; then shaft and channel, which may have one a row of nodes; then all others.
  pure function slots_of(pad, column) result(slot)
    type(pad_type), intent(in) :: pad
    type(unknowns_type), intent(in) :: column
    integer :: slot(column%count, size(pad%film%shape, 1))
    integer :: a, b, p, station, row, reach, around, before

    reach = 2*pad%whole%order + 1
    around = reach**2
    do a = 1, size(slot, 2)
      do b = 1, size(slot, 2)
        associate (from => pad%mesh%mesh_node(pad%film%element_nodes(a, 1)) - 1, to => pad%mesh%mesh_node(pad%film%element_nodes(b, 1)) - 1, &
                   rows => pad%whole%rows(), stations => pad%whole%stations())
          station = to/rows - from/rows
          if (abs(station) > pad%whole%order) station = station - sign(stations, station) ! all around
          station = station + pad%whole%order
          row = modulo(to, rows) - modulo(from, rows) + pad%whole%order + 1
        end associate
        associate (place => reach*station + row)
          slot(column%pressure(b), a) = place
          slot(column%mover(b), a) = around + place
          slot(column%gas(b), a) = 2*around + 2*place - 1
          slot(column%foil(b), a) = 2*around + 2*place
        end associate
        before = 4*around
        slot(column%shaft(b), a) = before + row
        slot(column%channel(b), a) = before + reach + row ! the sleeve's where there is none, which follows
      end do
      before = 4*around + 2*reach
      do p = column%sleeve, column%count
        slot(p, a) = before + p - column%sleeve + 1
      end do
    end do
  end function slots_of

  !> Adds what an element says of its nodes.
  pure subroutine add_to_nodes(nodes, block, rows)
    integer, intent(in) :: nodes(:) !! of the element
    type(element_block_type), intent(in) :: block !! of it
    type(node_rows_type), intent(inout) :: rows
    integer :: a, r, p

    do a = 1, size(nodes)
      associate (node => nodes(a), slot => rows%slot)
        do p = 1, block%column%count
          rows%unknown(slot(p, a), node) = block%unknown(p)
        end do
        do r = 1, row_foil
          associate (equation => block%row%of_film(a, r))
            rows%equation(r, node) = block%equation(equation)
            do p = 1, block%column%count
              rows%value(slot(p, a), r, node) = rows%value(slot(p, a), r, node) + block%value(p, equation)
            end do
          end associate
        end do
      end associate
    end do
  end subroutine add_to_nodes

  !> Puts the rows of nodes into the matrix.
  subroutine put_nodes(rows, matrix)
    type(node_rows_type), intent(in) :: rows
    Mat, intent(in) :: matrix
    real(wp) :: line(size(rows%value, 1), row_foil)
    integer :: column(size(rows%value, 1)), node, s, used

    do node = 1, size(rows%unknown, 2)
      used = 0
      do s = 1, size(rows%unknown, 1)
        associate (unknown => rows%unknown(s, node), value => rows%value(s, :, node))
          if (unknown == 0) cycle
          if (column(max(1, used)) == unknown .and. used > 0) then ! a station moves as one
            line(used, :) = line(used, :) + value
          else
            used = used + 1
            column(used) = unknown
            line(used, :) = value
          end if
        end associate
      end do
      if (used > 0) call put_block(matrix, rows%equation(:, node), column(:used), line(:used, :))
    end do
  end subroutine put_nodes

  !> Adds what an element says of walls.
  pure subroutine add_to_walls(heat, block, walls)
    type(film_heat_type), intent(in) :: heat
    type(element_block_type), intent(in) :: block !! of the element
    type(wall_rows_type), intent(inout) :: walls
    integer :: i, k

    do i = block%row%nodal + 1, block%row%count
      if (block%equation(i) == 0) cycle
      associate (wall => block%equation(i) - heat%first_wall)
        do k = 1, block%column%count
          if (block%unknown(k) == 0) cycle
          walls%value(block%unknown(k), wall) = walls%value(block%unknown(k), wall) + block%value(k, i)
          walls%coupled(block%unknown(k), wall) = .true.
        end do
      end associate
    end do
  end subroutine add_to_walls

  !> Puts the rows of walls into the matrix.
  subroutine put_walls(heat, walls, matrix)
    type(film_heat_type), intent(in) :: heat
    type(wall_rows_type), intent(in) :: walls
    Mat, intent(in) :: matrix
    integer, allocatable :: column(:)
    integer :: k, wall

    do wall = 1, heat%walls
      column = pack([(k, k=1, size(walls%coupled, 1))], walls%coupled(:, wall))
      call put_block(matrix, [heat%first_wall + wall], column, reshape(walls%value(column, wall), [size(column), 1]))
    end do
  end subroutine put_walls

  !> Positions of an element's equations.
  pure function equations_of(nodes, by_rows) result(row)
    integer, intent(in) :: nodes !! of the element
    logical, intent(in) :: by_rows !! the shaft has a temperature a row
    type(equations_type) :: row
    integer :: i, shafts

    row%nodal = row_foil*nodes ! mass, energy, foil
    shafts = merge(nodes, 1, by_rows)
    row%of_film = reshape([(i, i=1, heated_rows*nodes)], [nodes, heated_rows])
    if (.not. by_rows) row%of_film(:, row_shaft) = row%nodal + 1
    row%channel = row%nodal + shafts + [(i, i=1, nodes)]
    row%sleeve = row%nodal + shafts + nodes + 1
    row%slit = row%sleeve + 1
    row%next_slit = row%slit + 1
    row%count = row%next_slit
  end function equations_of

  !> Positions of what an element's equations depend on.
  pure function unknowns_of(nodes, coordinates, by_rows, cooled) result(column)
    integer, intent(in) :: nodes !! of the element
    integer, intent(in) :: coordinates !! of the shaft, that are unknowns
    logical, intent(in) :: by_rows !! the shaft has a temperature a row
    logical, intent(in) :: cooled !! there is a channel
    type(unknowns_type) :: column
    integer :: i, before

    associate (at_nodes => [(i, i=1, nodes)])
      column%pressure = at_nodes
      column%mover = nodes + at_nodes
      column%gas = 2*nodes + 2*at_nodes - 1
      column%foil = 2*nodes + 2*at_nodes
      before = 4*nodes
      column%shaft = before + merge(at_nodes, 1, by_rows)
      before = before + merge(nodes, 1, by_rows)
      column%channel = before + merge(at_nodes, 1, cooled)
      before = before + merge(nodes, 1, cooled)
    end associate
    column%sleeve = before + 1
    column%mean = before + 2
    column%count = column%mean + coordinates
  end function unknowns_of

  !> A block for the elements of a bearing.
  pure function element_block(nodes, coordinates, by_rows, cooled) result(block)
    integer, intent(in) :: nodes !! of an element
    integer, intent(in) :: coordinates !! of the shaft, that are unknowns
    logical, intent(in) :: by_rows, cooled !! see `unknowns_of`
    type(element_block_type) :: block

    block%row = equations_of(nodes, by_rows)
    block%column = unknowns_of(nodes, coordinates, by_rows, cooled)
    allocate (block%equation(block%row%count), block%unknown(block%column%count), block%value(block%column%count, block%row%count))
  end function element_block

  !> Local unknowns of the equations of an element, and of what they depend on.
  pure subroutine place_block(bearing, number, element, block)
    class(bearing_type), intent(in) :: bearing
    integer, intent(in) :: number !! of the pad
    integer, intent(in) :: element
    type(element_block_type), intent(inout) :: block
    integer :: place(3*size(bearing%pad(1)%film%shape, 1) + 1), b, k, n

    n = size(bearing%pad(1)%film%shape, 1)
    associate (heat => bearing%heat, pad => bearing%pad(number), film => bearing%pad(number)%film, foil => bearing%pad(number)%foil, &
               row => block%row, column => block%column)
      place = element_walls(heat, pad, element)
      block%equation = 0
      block%unknown = 0
      do b = 1, n
        associate (node => film%element_nodes(b, element))
          block%unknown(column%pressure(b)) = pad%first + node
          block%unknown(column%gas(b)) = heat%place_of_gas(number, node)
          block%unknown(column%foil(b)) = place(b)
          block%unknown(column%shaft(b)) = place(n + b)
          if (heat%channels > 0) block%unknown(column%channel(b)) = place(2*n + b)
          if (foil%source(node) /= node .and. foil%source(node) /= 0) block%unknown(column%mover(b)) = pad%first + foil%source(node)
          if (.not. film%fixed(node)) block%equation(row%of_film(b, row_mass)) = pad%first + node
        end associate
        block%equation(row%of_film(b, row_energy)) = block%unknown(column%gas(b))
        if (heat%sheet) block%equation(row%of_film(b, row_foil)) = place(b)
        if (heat%shaft%kind /= wall_given) block%equation(row%of_film(b, row_shaft)) = place(n + b)
        if (heat%channels > 0) block%equation(row%channel(b)) = place(2*n + b)
      end do
      block%unknown(column%sleeve) = place(3*n + 1)
      if (heat%sleeve%kind /= wall_given) block%equation(row%sleeve) = place(3*n + 1)
      block%unknown(column%mean) = mean_of(heat, pad)
      block%unknown(column%mean + 1:) = bearing%first_shaft + [(k, k=1, size(bearing%coordinate))]
      if (any(is_leading(pad, film%element_nodes(:, element)) .or. is_trailing(pad, film%element_nodes(:, element)))) then
        block%equation(row%slit) = heat%place_of_slit(number)
        block%equation(row%next_slit) = heat%place_of_slit(pad_after(bearing%pad, number))
      end if
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
    real(wp) :: by_excess(size(by, 1), heated_rows, size(by, 1)), factor(heated_rows)
    real(wp) :: of_row(most_film_nodes, heated_fields), of_row_excess(most_film_nodes)
    type(gap_moves_type) :: moves
    integer :: k, a, b, c

    factor = 1.0_wp
    factor(row_foil) = -1.0_wp
    associate (heat => bearing%heat, pad => bearing%pad(number), film => bearing%pad(number)%film, row => block%row)
      factor(row_shaft) = film%copies
      call heated_jacobian(film%geometry(element), film%flow_at(state%point), heat%gas, &
                           state_of(heat, pad, element, state%point, state%unknown, state%gap(pad%first_node + 1:pad%last_node)), by, by_excess)
      call put_exchange(exchange_matrix(heat, pad, element), block)
      moves = moves_of_gap(bearing, state, number, element, block%column)
      do k = 1, heated_rows
        do a = 1, size(by, 1)
          do b = 1, size(by, 1)
            do c = 1, heated_fields
              of_row(b, c) = factor(k)*by(a, k, b, c)
            end do
            of_row_excess(b) = factor(k)*by_excess(a, k, b)
          end do
          call put_row(size(by, 1), block%column, moves, of_row, of_row_excess, block%value(:, row%of_film(a, k)))
        end do
      end do
    end associate
  end subroutine put_element

  !> What moves the gap at the nodes of an element.
  pure function moves_of_gap(bearing, state, number, element, column) result(moves)
    class(bearing_type), intent(in) :: bearing
    type(bearing_state_type), intent(in) :: state
    integer, intent(in) :: number !! of the pad
    integer, intent(in) :: element
    type(unknowns_type), intent(in) :: column
    type(gap_moves_type) :: moves
    integer :: b, c, n

    n = size(bearing%pad(number)%film%shape, 1)
    associate (heat => bearing%heat, film => bearing%pad(number)%film, foil => bearing%pad(number)%foil)
      moves%shaft = -state%point%growth*heat%shaft%growth
      moves%sleeve = state%point%growth*heat%sleeve%growth
      moves%sinking(:n) = sinking_of(bearing, state, number, film%element_nodes(:, element))
      do b = 1, n
        associate (node => film%element_nodes(b, element))
          moves%mover(b) = merge(column%pressure(b), column%mover(b), foil%source(node) == node) ! of springs the pressure itself
          moves%rate(b) = foil%rate(node)
          do c = 1, size(bearing%coordinate)
            moves%motion(c, b) = film%motion(bearing%coordinate(c), node)
            moves%excess(c, b) = film%motion_excess(bearing%coordinate(c), b, element)
          end do
        end associate
      end do
    end associate
  end function moves_of_gap

  !> Adds the derivatives of one equation of an element: by its fields, and by what moves its gap.
  pure subroutine put_row(nodes, column, moves, by, by_excess, line)
    integer, intent(in) :: nodes
    type(unknowns_type), intent(in) :: column
    type(gap_moves_type), intent(in) :: moves
    real(wp), intent(in) :: by(most_film_nodes, heated_fields)
    real(wp), intent(in) :: by_excess(most_film_nodes) !! by that of the gap at the points
    real(wp), intent(inout) :: line(column%count)
    real(wp) :: grown, sunk
    integer :: b, c

    grown = 0.0_wp
    sunk = 0.0_wp
    do b = 1, nodes
      associate (by_gap => by(b, field_gap))
        line(column%pressure(b)) = line(column%pressure(b)) + by(b, field_pressure)
        line(column%gas(b)) = line(column%gas(b)) + by(b, field_gas)
        line(column%foil(b)) = line(column%foil(b)) + by(b, field_foil)
        line(column%shaft(b)) = line(column%shaft(b)) + by(b, field_shaft) + moves%shaft*by_gap
        line(moves%mover(b)) = line(moves%mover(b)) + moves%rate(b)*by_gap
        grown = grown + moves%sleeve*by_gap
        sunk = sunk + moves%sinking(b)*by_gap
        do c = 1, column%count - column%mean
          line(column%mean + c) = line(column%mean + c) + moves%motion(c, b)*by_gap + moves%excess(c, b)*by_excess(b)
        end do
      end associate
    end do
    line(column%sleeve) = line(column%sleeve) + grown + sunk
    line(column%mean) = line(column%mean) + sunk
  end subroutine put_row

  !> Adds what foil, shaft, channel and sleeve exchange on an element.
  pure subroutine put_exchange(exchange, block)
    real(wp), intent(in) :: exchange(:, :) !! see `exchange_matrix`
    type(element_block_type), intent(inout) :: block
    integer :: place(size(exchange, 1)), equation(size(exchange, 1)), i, k

    associate (row => block%row, column => block%column)
      place = [column%foil, column%shaft, column%channel, column%sleeve]
      equation = [row%of_film(:, row_foil), row%of_film(:, row_shaft), row%channel, row%sleeve]
    end associate
    do i = 1, size(equation)
      do k = 1, size(place)
        block%value(place(k), equation(i)) = block%value(place(k), equation(i)) + exchange(i, k)
      end do
    end do
  end subroutine put_exchange

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
