#include "gfb_petsc.h"
!> Heat of a bearing: the gas, the top foil as a conducting sheet, and what lies beyond: shaft, sleeve, the gas that feeds a
!> slit, cooling gas along the bumps.
!>
!> Unknowns of a film node are the gas' and the top foil's temperature; those of all walls follow those of all pads, on the last
!> rank: of the shaft (one, or one a row), the sleeve, each pad's slit, the mean of each pad's top foil where the modulus of foils
!> follows it, the channel (one a row). What lies along the axis alone (a fin, a channel) is weighted over the film's elements, as
!> all else: so energy closes to round-off.
module gfb_film_heat
  use petscmat
  use gfb_kinds, only: wp
  use gfb_petsc_kinds, only: pint
  use gfb_petsc_session, only: sum_over_ranks
  use gfb_heated_film, only: heated_state_type, heated_residual, heated_jacobian, heated_rows, heated_fields, &
                             row_mass, row_energy, row_foil, row_shaft, field_pressure, field_gap, field_gas, field_foil, &
                             field_shaft, wall_given, wall_conductance
  use gfb_bearing_heat, only: film_heat_type, moduli_at, row_of
  use gfb_operating_point, only: operating_point_type
  use gfb_pad, only: pad_type
  implicit none (type)
  private
  public :: add_shaft_flux, add_heat_residual, add_heat_flows, add_heat_jacobian, state_of, walls_of, feed, is_leading, is_trailing

  !> How gas mixes in the slit before a pad: its rise over ambient times `flow` is what is `carried` there. With nothing to feed
  !> it is ambient gas; with more from the pad before than it takes it has that gas' temperature.
  type :: slit_type
    real(wp) :: flow = 1.0_wp       !! that is mixed [kg/s]
    real(wp) :: carried = 0.0_wp    !! by what comes from the pad before, times its rise over ambient [kg K/s]
    real(wp) :: share = 0.0_wp      !! part of that pad's outflow that comes [1]
    real(wp) :: by_inflow = 0.0_wp  !! change of `flow` by what enters the pad [1]
    real(wp) :: by_outflow = 0.0_wp !! by what leaves the one before [1]
  end type slit_type

contains

  !> Fields at the nodes of an element.
  pure function state_of(heat, pad, number, element, point, unknown, gap) result(state)
    type(film_heat_type), intent(in) :: heat !! of the bearing
    type(pad_type), intent(in) :: pad !! of it
    integer, intent(in) :: number  !! of the pad
    integer, intent(in) :: element !! of this rank
    type(operating_point_type), intent(in) :: point !! with the shaft's position
    real(wp), intent(in) :: unknown(:) !! the bearing's local ones [SI]
    real(wp), intent(in) :: gap(:) !! at the pad's nodes [m]
    type(heated_state_type) :: state
    integer :: n

    n = size(pad%film%shape, 1)
    associate (nodes => pad%film%element_nodes(:, element), first => heat%first(number))
      state%field(:n, field_pressure) = unknown(pad%first + nodes)
      state%field(:n, field_gap) = gap(nodes)
      state%field(:n, field_gas) = unknown(first + 2*nodes - 1)
      state%field(:n, field_foil) = unknown(first + 2*nodes)
      state%field(:n, field_shaft) = unknown(heat%first_wall + walls_of(heat, pad, nodes, .true.))
      state%excess = pad%film%excess(element, point)
      state%part = point%growth
    end associate
  end function state_of

  !> Walls that nodes see: the shaft's, or the channel's (the first one where there is none).
  pure function walls_of(heat, pad, nodes, of_shaft) result(wall)
    type(film_heat_type), intent(in) :: heat !! of the bearing
    type(pad_type), intent(in) :: pad !! of it
    integer, intent(in) :: nodes(:)   !! of this rank
    logical, intent(in) :: of_shaft   !! else of the channel
    integer :: wall(size(nodes)), i

    do i = 1, size(nodes)
      wall(i) = 1
      if (of_shaft) then
        wall(i) = heat%shaft_wall(row_of(pad%mesh%mesh_node(nodes(i)), pad%whole%rows()))
      else if (heat%channels > 0) then
        wall(i) = heat%channel_wall(row_of(pad%mesh%mesh_node(nodes(i)), pad%whole%rows()))
      end if
    end do
  end function walls_of

  !> What foil, shaft, channel and sleeve exchange on an element: rows of foil, shaft, channel, sleeve, columns the same [W/K].
  pure function exchange_matrix(heat, pad, element) result(matrix)
    type(film_heat_type), intent(in) :: heat
    type(pad_type), intent(in) :: pad
    integer, intent(in) :: element
    real(wp) :: matrix(3*size(pad%film%shape, 1) + 1, 3*size(pad%film%shape, 1) + 1)
    real(wp), dimension(size(pad%film%shape, 1), size(pad%film%shape, 1)) :: mass, slopes, along, carried
    integer :: i, b, n

    n = size(mass, 1)
    mass = 0.0_wp
    slopes = 0.0_wp
    along = 0.0_wp
    carried = 0.0_wp
    associate (geometry => pad%film%geometry(element))
      do i = 1, n
        associate (shape => pad%film%shape(:, i), x => geometry%gradient(1, :, i), z => geometry%gradient(2, :, i), &
                   area => geometry%area(i))
          do b = 1, n
            mass(:, b) = mass(:, b) + area*shape(b)*shape
            slopes(:, b) = slopes(:, b) + area*(x(b)*x + z(b)*z)
            along(:, b) = along(:, b) + area*z(b)*z
            carried(:, b) = carried(:, b) + area/geometry%stretch(i)*z(b)*shape ! all around the axis it is one gas
          end do
        end associate
      end do
    end associate
    matrix = 0.0_wp
    associate (copies => pad%film%copies, last => 3*n + 1)
      matrix(:n, :n) = heat%sheet_conductance*slopes + (heat%bumps + heat%channel)*mass
      matrix(:n, last) = -heat%bumps*sum(mass, 2)
      matrix(last, :n) = copies*heat%bumps*sum(mass, 1)
      matrix(last, last) = -copies*(heat%bumps + heat%channel_sleeve)*sum(mass)
      if (heat%shafts > 1) matrix(n + 1:2*n, n + 1:2*n) = -copies*heat%fin/heat%arc*along
      if (heat%channels == 0) then
        matrix(:n, :n) = matrix(:n, :n) - heat%channel*mass
        matrix(last, last) = matrix(last, last) + copies*heat%channel_sleeve*sum(mass)
        return
      end if
      matrix(:n, 2*n + 1:3*n) = -heat%channel*mass
      matrix(2*n + 1:3*n, :n) = -copies*heat%channel*mass
      matrix(2*n + 1:3*n, 2*n + 1:3*n) = copies*(heat%cooling/heat%arc*carried + (heat%channel + heat%channel_sleeve)*mass)
      matrix(2*n + 1:3*n, last) = -copies*heat%channel_sleeve*sum(mass, 2)
      matrix(last, 2*n + 1:3*n) = copies*heat%channel_sleeve*sum(mass, 1)
    end associate
  end function exchange_matrix

  !> Local unknowns whose equations an element adds to: mass, energy, foil, shaft, channel, a node each, and sleeve; 0 where it
  !> is given.
  pure function element_rows(heat, pad, number, element) result(row)
    type(film_heat_type), intent(in) :: heat
    type(pad_type), intent(in) :: pad
    integer, intent(in) :: number !! of the pad
    integer, intent(in) :: element
    integer :: row(5*size(pad%film%shape, 1) + 1), n

    n = size(pad%film%shape, 1)
    associate (nodes => pad%film%element_nodes(:, element), first => heat%first(number))
      row(:n) = pad%first + nodes
      row(n + 1:2*n) = first + 2*nodes - 1
      row(2*n + 1:3*n) = merge(first + 2*nodes, 0, heat%sheet)
      row(3*n + 1:4*n) = merge(0, heat%first_wall + walls_of(heat, pad, nodes, .true.), heat%shaft%kind == wall_given)
      row(4*n + 1:5*n) = merge(heat%first_wall + walls_of(heat, pad, nodes, .false.), 0, heat%channels > 0)
      row(5*n + 1) = merge(0, heat%first_wall + heat%sleeve_wall(), heat%sleeve%kind == wall_given)
    end associate
  end function element_rows

  !> Local unknowns that foil, shaft, channel and sleeve of an element have, in the order of its exchange matrix.
  pure function element_walls(heat, pad, number, element) result(place)
    type(film_heat_type), intent(in) :: heat
    type(pad_type), intent(in) :: pad
    integer, intent(in) :: number !! of the pad
    integer, intent(in) :: element
    integer :: place(3*size(pad%film%shape, 1) + 1)

    associate (nodes => pad%film%element_nodes(:, element))
      place = [heat%first(number) + 2*nodes, heat%first_wall + walls_of(heat, pad, nodes, .true.), &
               heat%first_wall + walls_of(heat, pad, nodes, .false.), heat%first_wall + heat%sleeve_wall()]
    end associate
  end function element_walls

  !> Adds what the elements of this rank say of film and heat. What flows over the edges follows from the sum of all ranks, see
  !> `add_heat_flows`.
  subroutine add_heat_residual(heat, pads, point, unknown, gap, residual)
    type(film_heat_type), intent(in) :: heat !! of the bearing
    type(pad_type), intent(in) :: pads(:)    !! of it
    type(operating_point_type), intent(in) :: point !! with the shaft's position
    real(wp), intent(in) :: unknown(:) !! the bearing's local ones [SI]
    real(wp), intent(in) :: gap(:)     !! at all film nodes [m]
    real(wp), intent(inout) :: residual(:) !! one a local unknown [SI]
    real(wp) :: share(size(pads(1)%film%shape, 1), heated_rows), all_rows(5*size(share, 1) + 1)
    integer :: row(size(all_rows)), i, element, n, k

    n = size(share, 1)
    do i = 1, size(pads)
      associate (pad => pads(i), film => pads(i)%film)
        do element = 1, size(film%element_nodes, 2)
          call heated_residual(film%geometry(element), film%flow_at(point), heat%gas, &
                               state_of(heat, pad, i, element, point, unknown, gap(pad%first_node + 1:pad%last_node)), share)
          row = element_rows(heat, pad, i, element)
          all_rows(2*n + 1:) = matmul(exchange_matrix(heat, pad, element), unknown(element_walls(heat, pad, i, element)))
          all_rows(:n) = share(:, row_mass)
          all_rows(n + 1:2*n) = share(:, row_energy)
          all_rows(2*n + 1:3*n) = all_rows(2*n + 1:3*n) - share(:, row_foil)
          all_rows(3*n + 1:4*n) = all_rows(3*n + 1:4*n) + film%copies*share(:, row_shaft)
          do k = 1, size(row) ! some are the same
            if (row(k) > 0) residual(row(k)) = residual(row(k)) + all_rows(k)
          end do
          if (heat%softens()) then
            associate (mean => heat%first_wall + heat%mean_wall(i), foil => heat%first(i) + 2*film%element_nodes(:, element))
              residual(mean) = residual(mean) + dot_product(nodal_areas(pad, element), unknown(foil) - unknown(mean))
            end associate
          end if
        end do
      end associate
    end do
  end subroutine add_heat_residual

  !> Weights of a field's values at the nodes of an element in its integral [m2].
  pure function nodal_areas(pad, element) result(area)
    type(pad_type), intent(in) :: pad
    integer, intent(in) :: element
    real(wp) :: area(size(pad%film%shape, 1))
    area = matmul(pad%film%shape, pad%film%geometry(element)%area)
  end function nodal_areas

  !> Adds the heat that elements give to the shaft around each film node, and their area there.
  pure subroutine add_shaft_flux(heat, pads, point, unknown, gap, flux, area)
    type(film_heat_type), intent(in) :: heat !! of the bearing
    type(pad_type), intent(in) :: pads(:)    !! of it
    type(operating_point_type), intent(in) :: point !! with the shaft's position
    real(wp), intent(in) :: unknown(:) !! the bearing's local ones [SI]
    real(wp), intent(in) :: gap(:)     !! at all film nodes [m]
    real(wp), intent(inout) :: flux(:) !! at the pressures among the local unknowns [W]
    real(wp), intent(inout) :: area(:) !! the same [m2]
    real(wp) :: share(size(pads(1)%film%shape, 1), heated_rows)
    integer :: i, element

    do i = 1, size(pads)
      associate (pad => pads(i), film => pads(i)%film)
        do element = 1, size(film%element_nodes, 2)
          call heated_residual(film%geometry(element), film%flow_at(point), heat%gas, &
                               state_of(heat, pad, i, element, point, unknown, gap(pad%first_node + 1:pad%last_node)), share)
          associate (place => pad%first + film%element_nodes(:, element))
            flux(place) = flux(place) + share(:, row_shaft)
            area(place) = area(place) + nodal_areas(pad, element)
          end associate
        end do
      end associate
    end do
  end subroutine add_shaft_flux

  !> Adds what flows over the edges and what the walls give away, and puts what is given in its place.
  !>
  !> Edges are met weakly: gas that is drawn in has the temperature of what feeds it.
  subroutine add_heat_flows(heat, pads, unknown, flow, last_rank, residual)
    type(film_heat_type), intent(in) :: heat !! of the bearing
    type(pad_type), intent(in) :: pads(:)    !! of it
    real(wp), intent(in) :: unknown(:) !! the bearing's local ones [SI]
    real(wp), intent(in) :: flow(:)    !! at each local unknown of a pressure, what all ranks' elements take there [Pa m3/s]
    logical, intent(in) :: last_rank   !! this rank owns the walls
    real(wp), intent(inout) :: residual(:) !! one a local unknown [SI]
    type(slit_type) :: slit(size(pads))
    integer :: i, node

    do i = 1, size(pads)
      associate (pad => pads(i), film => pads(i)%film, first => heat%first(i))
        do node = 1, size(film%fixed)
          if (film%fixed(node)) residual(pad%first + node) = 0.0_wp
          if (.not. pad%mesh%owned(node)) cycle
          if (film%fixed(node)) then
            residual(pad%first + node) = unknown(pad%first + node) - film%ambient_pressure
            associate (inflow => heat%gas%density*flow(pad%first + node), gas => first + 2*node - 1)
              residual(gas) = residual(gas) + heat%gas%specific_heat*max(inflow, 0.0_wp)* &
                              (unknown(gas) - feed(heat, pad, i, node, unknown))
            end associate
          end if
          if (.not. heat%sheet) residual(first + 2*node) = unknown(first + 2*node) - heat%foil_temperature
        end do
      end associate
    end do
    slit = slits_of(heat, pads, unknown, flow)
    if (last_rank) call add_walls(heat, pads, slit, unknown, residual)
  end subroutine add_heat_flows

  !> Temperature of the gas that is drawn in at a node of an edge [K].
  pure real(wp) function feed(heat, pad, number, node, unknown)
    type(film_heat_type), intent(in) :: heat !! of the bearing
    type(pad_type), intent(in) :: pad !! of it
    integer, intent(in) :: number !! of the pad
    integer, intent(in) :: node   !! of this rank
    real(wp), intent(in) :: unknown(:) !! the bearing's local ones [SI]

    feed = heat%ambient
    if (is_leading(pad, node)) feed = unknown(heat%first_wall + heat%inlet_wall(number))
  end function feed

  !> Whether a node lies on the edge where the motion enters.
  elemental logical function is_leading(pad, node) result(is)
    type(pad_type), intent(in) :: pad !! of the bearing
    integer, intent(in) :: node       !! of this rank
    is = .not. pad%whole%periodic .and. pad%mesh%mesh_node(node) <= pad%whole%rows()
  end function is_leading

  !> Whether it lies on the edge where the motion leaves.
  elemental logical function is_trailing(pad, node) result(is)
    type(pad_type), intent(in) :: pad !! of the bearing
    integer, intent(in) :: node       !! of this rank
    is = .not. pad%whole%periodic .and. pad%mesh%mesh_node(node) > pad%whole%nodes() - pad%whole%rows()
  end function is_trailing

  !> The slits before all pads, by what flows over leading and trailing edges on all ranks.
  function slits_of(heat, pads, unknown, flow) result(slit)
    type(film_heat_type), intent(in) :: heat
    type(pad_type), intent(in) :: pads(:)
    real(wp), intent(in) :: unknown(:), flow(:)
    type(slit_type) :: slit(size(pads))
    real(wp) :: sums(3, size(pads)) ! flow in, flow out, that times its rise over ambient
    integer :: i, neighbour, node

    sums = 0.0_wp
    do i = 1, size(pads)
      associate (pad => pads(i))
        do node = 1, size(pad%film%fixed)
          if (.not. pad%mesh%owned(node)) cycle
          associate (inflow => pad%film%copies*heat%gas%density*flow(pad%first + node))
            if (is_leading(pad, node)) sums(1, i) = sums(1, i) + max(inflow, 0.0_wp)
            if (is_trailing(pad, node)) then
              sums(2, i) = sums(2, i) + max(-inflow, 0.0_wp)
              sums(3, i) = sums(3, i) + max(-inflow, 0.0_wp)*(unknown(heat%first(i) + 2*node - 1) - heat%ambient)
            end if
          end associate
        end do
      end associate
    end do
    sums = reshape(sum_over_ranks(reshape(sums, [size(sums)])), shape(sums))
    do i = 1, size(pads)
      neighbour = pad_before(pads, i)
      associate (inflow => sums(1, i), before => sums(2:, neighbour))
        if (.not. inflow > tiny(1.0_wp)/epsilon(1.0_wp)) cycle
        if (heat%carry_over*before(1) > inflow) then
          slit(i) = slit_type(before(1), before(2), 1.0_wp, 0.0_wp, 1.0_wp)
        else
          slit(i) = slit_type(inflow, heat%carry_over*before(2), heat%carry_over, 1.0_wp, 0.0_wp)
        end if
      end associate
    end do
  end function slits_of

  !> The pad whose trailing edge lies before a pad.
  pure integer function pad_before(pads, number) result(before)
    type(pad_type), intent(in) :: pads(:)
    integer, intent(in) :: number
    before = modulo(number - 2, size(pads)) + 1
  end function pad_before

  !> The pad that one feeds.
  pure integer function pad_after(pads, number) result(after)
    type(pad_type), intent(in) :: pads(:)
    integer, intent(in) :: number
    after = modulo(number, size(pads)) + 1
  end function pad_after

  !> Adds what walls give away, and the mixing in slits.
  pure subroutine add_walls(heat, pads, slit, unknown, residual)
    type(film_heat_type), intent(in) :: heat
    type(pad_type), intent(in) :: pads(:)
    type(slit_type), intent(in) :: slit(:)
    real(wp), intent(in) :: unknown(:)
    real(wp), intent(inout) :: residual(:)
    integer :: i, end_row

    associate (wall => unknown(heat%first_wall + 1:heat%first_wall + heat%walls), first => heat%first_wall, &
               copies => pads(1)%film%copies)
      associate (equation => residual(first + 1:first + heat%walls))
        select case (heat%shaft%kind)
        case (wall_given)
          equation(1) = wall(1) - heat%shaft%temperature
        case (wall_conductance)
          equation(1) = equation(1) - heat%shaft%conductance*(wall(1) - heat%shaft%far)
        case default
          do i = merge(2, 1, copies > 1.0_wp), 2 ! of half the width one end
            end_row = merge(1, heat%shafts, i == 1)
            equation(end_row) = equation(end_row) - copies*heat%end_conductance(i)*(wall(end_row) - heat%end_temperature(i))
          end do
        end select
        associate (sleeve => heat%sleeve_wall())
          if (heat%sleeve%kind == wall_given) then
            equation(sleeve) = wall(sleeve) - heat%sleeve%temperature
          else
            equation(sleeve) = equation(sleeve) - heat%sleeve%conductance*(wall(sleeve) - heat%sleeve%far)
          end if
        end associate
        do i = 1, size(pads)
          associate (inlet => heat%inlet_wall(i))
            equation(inlet) = slit(i)%flow*(wall(inlet) - heat%ambient) - slit(i)%carried
          end associate
        end do
        if (heat%channels > 0) then
          associate (mouth => heat%channel_wall(1))
            equation(mouth) = equation(mouth) + heat%cooling*(wall(mouth) - heat%cooling_temperature)
          end associate
        end if
      end associate
    end associate
  end subroutine add_walls

  !> Adds the derivatives of all that.
  subroutine add_heat_jacobian(heat, pads, point, coordinate, first_shaft, unknown, gap, flow, last_rank, room, matrix)
    type(film_heat_type), intent(in) :: heat !! of the bearing
    type(pad_type), intent(in) :: pads(:)    !! of it
    type(operating_point_type), intent(in) :: point !! with the shaft's position
    integer, intent(in) :: coordinate(:)     !! of the shaft, those that are unknowns
    integer, intent(in) :: first_shaft !! local unknowns before them
    real(wp), intent(in) :: unknown(:) !! the bearing's local ones [SI]
    real(wp), intent(in) :: gap(:)     !! at all film nodes [m]
    real(wp), intent(in) :: flow(:)    !! see `add_heat_flows`
    logical, intent(in) :: last_rank   !! this rank owns the walls
    logical, intent(in) :: room !! zeros alone, where they stand; the state has no values then
    Mat, intent(in) :: matrix !! by the bearing's local numbers
    type(slit_type) :: slit(size(pads))
    real(wp), allocatable :: block(:, :)
    integer, allocatable :: row(:), column(:)
    integer :: i, k, n, element, next

    n = size(pads(1)%film%shape, 1)
    ! a row of the matrix in each column, as PETSc reads it
    allocate (block(6*n + 2 + size(coordinate), 5*n + 3))
    if (.not. room) slit = slits_of(heat, pads, unknown, flow)
    do i = 1, size(pads)
      next = pad_after(pads, i)
      associate (pad => pads(i), foil => pads(i)%foil)
        do element = 1, size(pad%film%element_nodes, 2)
          associate (nodes => pad%film%element_nodes(:, element))
            row = [element_rows(heat, pad, i, element), heat%first_wall + heat%inlet_wall(i), heat%first_wall + heat%inlet_wall(next)]
            column = [pad%first + nodes, heat%first(i) + 2*nodes - 1, element_walls(heat, pad, i, element), &
                      merge(0, pad%first + foil%source(nodes), foil%source(nodes) == nodes .or. foil%source(nodes) == 0), &
                      [(first_shaft + k, k=1, size(coordinate))], mean_of(heat, pad, i)]
            if (heat%channels == 0) column(4*n + 1:5*n) = 0
            block = 0.0_wp
            if (.not. room) then
              call put_element(heat, pad, i, element, point, coordinate, unknown, gap(pad%first_node + 1:pad%last_node), block)
              call put_edges(heat, pads, i, element, slit, unknown, flow, block)
            end if
            where (pad%film%fixed(nodes)) row(:n) = 0
            if (.not. any(is_leading(pad, nodes) .or. is_trailing(pad, nodes))) row(5*n + 2:) = 0
            call put_block(matrix, row, column, block)
            if (heat%softens()) call put_mean(heat, i, nodes, merge(0.0_wp, 1.0_wp, room)*nodal_areas(pad, element), matrix)
          end associate
        end do
      end associate
    end do
    call add_flow_rates(heat, pads, slit, merge(0.0_wp, 1.0_wp, room), flow, matrix)
    if (last_rank) call add_wall_rates(heat, pads, slit, merge(0.0_wp, 1.0_wp, room), matrix)
  end subroutine add_heat_jacobian

  !> Local unknown of the mean temperature of a pad's top foil where it moves the gap: of springs without unknowns; else 0.
  pure integer function mean_of(heat, pad, number) result(mean)
    type(film_heat_type), intent(in) :: heat
    type(pad_type), intent(in) :: pad
    integer, intent(in) :: number !! of the pad

    mean = 0
    if (heat%softens() .and. pad%foil%local_unknowns() == 0) mean = heat%first_wall + heat%mean_wall(number)
  end function mean_of

  !> Derivatives of an element's part of the equation of the mean temperature of a pad's top foil.
  subroutine put_mean(heat, number, nodes, area, matrix)
    type(film_heat_type), intent(in) :: heat
    integer, intent(in) :: number !! of the pad
    integer, intent(in) :: nodes(:) !! of the element
    real(wp), intent(in) :: area(:) !! of each; 0: makes room [m2]
    Mat, intent(in) :: matrix

    associate (mean => heat%first_wall + heat%mean_wall(number))
      call put_block(matrix, [mean], [heat%first(number) + 2*nodes, mean], reshape([area, -sum(area)], [size(area) + 1, 1]))
    end associate
  end subroutine put_mean

  !> Derivatives of what an element says: by pressure, gas, foil, shaft, channel, sleeve, what moves the foil, the shaft's
  !> coordinates, and the mean temperature of the top foil.
  subroutine put_element(heat, pad, number, element, point, coordinate, unknown, gap, block)
    type(film_heat_type), intent(in) :: heat
    type(pad_type), intent(in) :: pad
    integer, intent(in) :: number !! of the pad
    integer, intent(in) :: element
    type(operating_point_type), intent(in) :: point
    integer, intent(in) :: coordinate(:)
    real(wp), intent(in) :: unknown(:), gap(:)
    real(wp), intent(inout) :: block(:, :) !! zero before
    real(wp) :: by(size(pad%film%shape, 1), heated_rows, size(pad%film%shape, 1), heated_fields)
    real(wp) :: by_excess(size(by, 1), heated_rows, size(by, 1)), factor(heated_rows), sinking(size(by, 1)), ratio(2), rate(2)
    integer :: k, b, c, n, mover

    n = size(by, 1)
    sinking = 0.0_wp
    if (mean_of(heat, pad, number) > 0) then
      call moduli_at(heat, number, point%growth, unknown, ratio, rate)
      associate (nodes => pad%film%element_nodes(:, element), deflection => pad%foil%deflection(unknown(pad%first + 1:pad%last), ratio))
        sinking = -deflection(nodes)*rate(2)/ratio(2)
      end associate
    end if
    associate (film => pad%film, foil => pad%foil, nodes => pad%film%element_nodes(:, element))
      call heated_jacobian(film%geometry(element), film%flow_at(point), heat%gas, &
                           state_of(heat, pad, number, element, point, unknown, gap), by, by_excess)
      block(2*n + 1:5*n + 1, 2*n + 1:5*n + 1) = transpose(exchange_matrix(heat, pad, element))
      factor = 1.0_wp
      factor(row_foil) = -1.0_wp
      factor(row_shaft) = film%copies
      do k = 1, heated_rows
        by(:, k, :, :) = factor(k)*by(:, k, :, :)
        associate (part => block(:, (k - 1)*n + 1:k*n), by_gap => by(:, k, :, field_gap))
          part(:n, :) = part(:n, :) + transpose(by(:, k, :, field_pressure))
          part(n + 1:2*n, :) = part(n + 1:2*n, :) + transpose(by(:, k, :, field_gas))
          part(2*n + 1:3*n, :) = part(2*n + 1:3*n, :) + transpose(by(:, k, :, field_foil))
          part(3*n + 1:4*n, :) = part(3*n + 1:4*n, :) + transpose(by(:, k, :, field_shaft) - point%growth*heat%shaft%growth*by_gap)
          part(5*n + 1, :) = part(5*n + 1, :) + point%growth*heat%sleeve%growth*sum(by_gap, 2)
          part(6*n + 2 + size(coordinate), :) = matmul(by_gap, sinking)
          part(5*n + 1, :) = part(5*n + 1, :) + matmul(by_gap, sinking)
          do b = 1, n
            mover = merge(b, 5*n + 1 + b, foil%source(nodes(b)) == nodes(b)) ! springs: the pressure itself
            part(mover, :) = part(mover, :) + foil%rate(nodes(b))*by_gap(:, b)
            do c = 1, size(coordinate)
              part(6*n + 1 + c, :) = part(6*n + 1 + c, :) + film%motion(coordinate(c), nodes(b))*by_gap(:, b) &
                + film%motion_excess(coordinate(c), b, element)*factor(k)*by_excess(:, k, b)
            end do
          end do
        end associate
      end do
    end associate
  end subroutine put_element

  !> What flows over edges changes with the mass equations of their nodes, which stand in the block.
  subroutine put_edges(heat, pads, number, element, slit, unknown, flow, block)
    type(film_heat_type), intent(in) :: heat
    type(pad_type), intent(in) :: pads(:)
    integer, intent(in) :: number !! of the pad
    integer, intent(in) :: element
    type(slit_type), intent(in) :: slit(:)
    real(wp), intent(in) :: unknown(:), flow(:)
    real(wp), intent(inout) :: block(:, :)
    integer :: b, n, next

    n = size(pads(1)%film%shape, 1)
    next = pad_after(pads, number)
    do b = 1, n
      associate (pad => pads(number), node => pads(number)%film%element_nodes(b, element), wall => heat%first_wall, &
                 density => heat%gas%density)
        if (.not. pad%film%fixed(node)) cycle
        associate (mass => block(:, b), inflow => flow(pad%first + node), gas => unknown(heat%first(number) + 2*node - 1))
          if (inflow > 0.0_wp) then
            block(:, n + b) = block(:, n + b) + heat%gas%specific_heat*density*(gas - feed(heat, pad, number, node, unknown))*mass
            if (is_leading(pad, node)) block(:, 5*n + 2) = block(:, 5*n + 2) &
              + pad%film%copies*density*slit(number)%by_inflow*(unknown(wall + heat%inlet_wall(number)) - heat%ambient)*mass
          else if (is_trailing(pad, node)) then
            associate (left => slit(next), rise => unknown(wall + heat%inlet_wall(next)) - heat%ambient)
              block(:, 5*n + 3) = block(:, 5*n + 3) &
                + pad%film%copies*density*(left%share*(gas - heat%ambient) - left%by_outflow*rise)*mass
            end associate
          end if
        end associate
      end associate
    end do
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
          associate (gas => heat%first(i) + 2*node - 1, inflow => factor*heat%gas%density*flow(pad%first + node))
            if (.not. heat%sheet) call put_block(matrix, [gas + 1], [gas + 1], reshape([factor], [1, 1]))
            if (.not. film%fixed(node)) cycle
            call put_block(matrix, [pad%first + node], [pad%first + node], reshape([factor], [1, 1]))
            associate (gain => heat%gas%specific_heat*max(inflow, 0.0_wp), &
                       slit => merge(heat%first_wall + heat%inlet_wall(i), 0, is_leading(pad, node)))
              call put_block(matrix, [gas], [gas, slit], reshape([gain, -gain], [2, 1]))
            end associate
            if (.not. is_trailing(pad, node)) cycle
            call put_block(matrix, [heat%first_wall + heat%inlet_wall(next)], [gas], &
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
    real(wp) :: rate(heat%walls)
    integer :: i

    rate = 0.0_wp
    associate (copies => pads(1)%film%copies)
      select case (heat%shaft%kind)
      case (wall_given)
        rate(1) = 1.0_wp
      case (wall_conductance)
        rate(1) = -heat%shaft%conductance
      case default
        if (.not. copies > 1.0_wp) rate(1) = -heat%end_conductance(1)
        rate(heat%shafts) = rate(heat%shafts) - copies*heat%end_conductance(2)
      end select
      rate(heat%sleeve_wall()) = merge(1.0_wp, -heat%sleeve%conductance, heat%sleeve%kind == wall_given)
    end associate
    do i = 1, size(pads)
      rate(heat%inlet_wall(i)) = slit(i)%flow
    end do
    if (heat%channels > 0) rate(heat%channel_wall(1)) = heat%cooling
    do i = 1, heat%walls
      call put_block(matrix, [heat%first_wall + i], [heat%first_wall + i], reshape([factor*rate(i)], [1, 1]))
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
end module gfb_film_heat
