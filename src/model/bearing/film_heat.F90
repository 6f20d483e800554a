!> Heat of a bearing: the gas, the top foil as a conducting sheet, and what lies beyond: shaft, sleeve, the gas that feeds a
!> slit, cooling gas along the bumps.
!>
!> Unknowns of a film node are the gas' and the top foil's temperature; those of all walls follow those of all pads, on the last
!> rank: of the shaft (one, or one a row), the sleeve, each pad's slit, the mean of each pad's top foil where the modulus of foils
!> follows it, the channel (one a row). What lies along the axis alone (a fin, a channel) is weighted over the film's elements, as
!> all else: so energy closes to round-off. Derivatives: see `gfb_film_heat_rates`.
module gfb_film_heat
  use gfb_kinds, only: wp
  use gfb_petsc_session, only: sum_over_ranks
  use gfb_heated_film, only: heated_state_type, heated_residual, heated_rows, row_mass, row_energy, row_foil, row_shaft, &
                             field_pressure, field_gap, field_gas, field_foil, field_shaft, wall_given, wall_conductance
  use gfb_film_flow, only: film_flow_type
  use gfb_bearing_heat, only: film_heat_type, row_of
  use gfb_operating_point, only: operating_point_type
  use gfb_pad, only: pad_type
  use gfb_bearing, only: bearing_type, bearing_state_type
  implicit none (type)
  private
  public :: add_shaft_flux, heat_flows, add_heat_flows, state_of, shaft_places, channel_places, feed, is_leading, is_trailing
  public :: element_walls, exchange_matrix, nodal_areas, slits_of, pad_after ! for the derivatives

  !> How gas mixes in the slit before a pad: its rise over ambient times `flow` is what is `carried` there. With nothing to feed
  !> it is ambient gas; with more from the pad before than it takes it has that gas' temperature.
  type, public :: slit_type
    real(wp) :: flow = 1.0_wp       !! that is mixed [kg/s]
    real(wp) :: carried = 0.0_wp    !! by what comes from the pad before, times its rise over ambient [kg K/s]
    real(wp) :: share = 0.0_wp      !! part of that pad's outflow that comes [1]
    real(wp) :: by_inflow = 0.0_wp  !! change of `flow` by what enters the pad [1]
    real(wp) :: by_outflow = 0.0_wp !! by what leaves the one before [1]
  end type slit_type

contains

  !> Adds what elements say of film and heat, and returns what those of all ranks take at each local unknown of a pressure.
  function heat_flows(bearing, state, residual) result(flow)
    class(bearing_type), intent(in) :: bearing !! with heat
    type(bearing_state_type), intent(in) :: state !! of it
    real(wp), intent(inout) :: residual(:) !! at pressures zero before [SI]
    real(wp), allocatable :: flow(:) !! [Pa m3/s]

    call add_heat_residual(bearing, state, residual)
    flow = bearing%summed(residual)
  end function heat_flows

  !> Fields at the nodes of an element.
  pure function state_of(heat, pad, element, point, unknown, gap) result(state)
    type(film_heat_type), intent(in) :: heat !! of the bearing
    type(pad_type), intent(in) :: pad !! of it
    integer, intent(in) :: element !! of this rank
    type(operating_point_type), intent(in) :: point !! with the shaft's position
    real(wp), intent(in) :: unknown(:) !! the bearing's local ones [SI]
    real(wp), intent(in) :: gap(:) !! at the pad's nodes [m]
    type(heated_state_type) :: state
    integer :: b

    associate (nodes => pad%film%element_nodes(:, element), row => pad%whole%rows())
      do b = 1, size(nodes)
        state%field(b, field_pressure) = unknown(pad%first + nodes(b))
        state%field(b, field_gap) = gap(nodes(b))
        state%field(b, field_gas) = unknown(heat%place_of_gas(pad%number, nodes(b)))
        state%field(b, field_foil) = unknown(heat%place_of_foil(pad%number, nodes(b)))
        state%field(b, field_shaft) = unknown(heat%place_of_shaft(row_of(pad%mesh%mesh_node(nodes(b)), row)))
      end do
    end associate
    state%excess = pad%film%excess(element, point)
    state%part = point%growth
    if (pad%film%wall%present) state%wall = pad%film%wall_at(point)
    state%leans = heat%has_orifices
  end function state_of

  !> Local unknowns of the bearing: the shaft's temperature as nodes see it.
  pure function shaft_places(heat, pad, nodes) result(place)
    type(film_heat_type), intent(in) :: heat !! of the bearing
    type(pad_type), intent(in) :: pad !! of it
    integer, intent(in) :: nodes(:)   !! of this rank
    integer :: place(size(nodes))
    place = heat%place_of_shaft(row_of(pad%mesh%mesh_node(nodes), pad%whole%rows()))
  end function shaft_places

  !> That of the channel behind them; where there is none the first one of a wall.
  pure function channel_places(heat, pad, nodes) result(place)
    type(film_heat_type), intent(in) :: heat !! of the bearing
    type(pad_type), intent(in) :: pad !! of it
    integer, intent(in) :: nodes(:)   !! of this rank
    integer :: place(size(nodes))

    place = heat%first_wall + 1
    if (heat%channels > 0) place = heat%place_of_channel(row_of(pad%mesh%mesh_node(nodes), pad%whole%rows()))
  end function channel_places

  !> What foil, shaft, channel and sleeve exchange on an element: rows of foil, shaft, channel, sleeve, columns the same [W/K].
  pure function exchange_matrix(heat, pad, element) result(matrix)
    type(film_heat_type), intent(in) :: heat
    type(pad_type), intent(in) :: pad
    integer, intent(in) :: element
    real(wp) :: matrix(3*size(pad%film%shape, 1) + 1, 3*size(pad%film%shape, 1) + 1)
    real(wp), dimension(size(pad%film%shape, 1), size(pad%film%shape, 1)) :: mass, slopes, along, carried
    integer :: i, b, c, n

    n = size(mass, 1)
    mass = 0.0_wp
    slopes = 0.0_wp
    associate (geometry => pad%film%geometry(element), shape => pad%film%shape)
      do i = 1, n
        do b = 1, n
          associate (weight => geometry%area(i)*shape(b, i), x => geometry%gradient(1, b, i), z => geometry%gradient(2, b, i))
            do c = 1, n
              mass(c, b) = mass(c, b) + weight*shape(c, i)
              slopes(c, b) = slopes(c, b) + geometry%area(i)*(x*geometry%gradient(1, c, i) + z*geometry%gradient(2, c, i))
            end do
          end associate
        end do
      end do
    end associate
    if (heat%shafts > 1 .or. heat%channels > 0) call find_axial(pad, element, along, carried)
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

  !> Its product with their temperatures, by sums over the points [W].
  pure function exchange(heat, pad, element, temperature) result(heat_flow)
    type(film_heat_type), intent(in) :: heat
    type(pad_type), intent(in) :: pad
    integer, intent(in) :: element
    real(wp), intent(in) :: temperature(:) !! of foil, shaft, channel, sleeve [K]
    real(wp) :: heat_flow(size(temperature))
    real(wp) :: foil, foil_x, foil_z, shaft_z, gas, gas_z, to_sleeve, to_gas, from_sleeve
    integer :: i, b, n

    n = size(pad%film%shape, 1)
    heat_flow = 0.0_wp
    associate (geometry => pad%film%geometry(element), copies => pad%film%copies, shape => pad%film%shape, sleeve => temperature(3*n + 1))
      do i = 1, n
        foil = 0.0_wp
        foil_x = 0.0_wp
        foil_z = 0.0_wp
        do b = 1, n
          foil = foil + shape(b, i)*temperature(b)
          ! Less one node's value: what is even has no gradient to the last digit.
          foil_x = foil_x + geometry%gradient(1, b, i)*(temperature(b) - temperature(1))
          foil_z = foil_z + geometry%gradient(2, b, i)*(temperature(b) - temperature(1))
        end do
        to_sleeve = geometry%area(i)*heat%bumps*(foil - sleeve)
        to_gas = 0.0_wp
        if (heat%channels > 0) then
          gas = dot_product(shape(:, i), temperature(2*n + 1:3*n))
          gas_z = dot_product(geometry%gradient(2, :, i), temperature(2*n + 1:3*n) - temperature(2*n + 1))
          to_gas = geometry%area(i)*heat%channel*(foil - gas)
          from_sleeve = geometry%area(i)*heat%channel_sleeve*(sleeve - gas)
          ! All around the axis it is one gas.
          heat_flow(2*n + 1:3*n) = heat_flow(2*n + 1:3*n) + copies*shape(:, i)* &
            (geometry%area(i)/geometry%stretch(i)*heat%cooling/heat%arc*gas_z - to_gas - from_sleeve)
          heat_flow(3*n + 1) = heat_flow(3*n + 1) - copies*from_sleeve
        end if
        associate (along => geometry%area(i)*heat%sheet_conductance)
          do b = 1, n
            heat_flow(b) = heat_flow(b) + along*(foil_x*geometry%gradient(1, b, i) + foil_z*geometry%gradient(2, b, i)) &
              + (to_sleeve + to_gas)*shape(b, i)
          end do
        end associate
        heat_flow(3*n + 1) = heat_flow(3*n + 1) + copies*to_sleeve
        if (heat%shafts > 1) then
          shaft_z = dot_product(geometry%gradient(2, :, i), temperature(n + 1:2*n) - temperature(n + 1))
          heat_flow(n + 1:2*n) = heat_flow(n + 1:2*n) &
            - copies*heat%fin/heat%arc*geometry%area(i)*shaft_z*geometry%gradient(2, :, i)
        end if
      end do
    end associate
  end function exchange

  !> What conducts along the axis on an element, and what a gas that flows there carries.
  pure subroutine find_axial(pad, element, along, carried)
    type(pad_type), intent(in) :: pad
    integer, intent(in) :: element
    real(wp), intent(out) :: along(:, :)   !! of a line [1]
    real(wp), intent(out) :: carried(:, :) !! [m]
    integer :: i, b

    along = 0.0_wp
    carried = 0.0_wp
    associate (geometry => pad%film%geometry(element))
      do i = 1, size(along, 1)
        associate (shape => pad%film%shape(:, i), z => geometry%gradient(2, :, i), area => geometry%area(i))
          do b = 1, size(along, 2)
            along(:, b) = along(:, b) + area*z(b)*z
            carried(:, b) = carried(:, b) + area/geometry%stretch(i)*z(b)*shape ! all around the axis it is one gas
          end do
        end associate
      end do
    end associate
  end subroutine find_axial

  !> Local unknowns that foil, shaft, channel and sleeve of an element have, in the order of its exchange matrix.
  pure function element_walls(heat, pad, element) result(place)
    type(film_heat_type), intent(in) :: heat
    type(pad_type), intent(in) :: pad
    integer, intent(in) :: element
    integer :: place(3*size(pad%film%shape, 1) + 1), b, n, row

    n = size(pad%film%shape, 1)
    associate (nodes => pad%film%element_nodes(:, element), rows => pad%whole%rows())
      do b = 1, n
        place(b) = heat%place_of_foil(pad%number, nodes(b))
        row = row_of(pad%mesh%mesh_node(nodes(b)), rows)
        place(n + b) = heat%place_of_shaft(row)
        place(2*n + b) = heat%first_wall + 1
        if (heat%channels > 0) place(2*n + b) = heat%place_of_channel(row)
      end do
    end associate
    place(3*n + 1) = heat%place_of_sleeve()
  end function element_walls

  !> Adds what the elements of this rank say of film and heat. What flows over the edges follows from the sum of all ranks, see
  !> `add_heat_flows`.
  subroutine add_heat_residual(bearing, state, residual)
    class(bearing_type), intent(in) :: bearing !! with heat
    type(bearing_state_type), intent(in) :: state !! of it
    real(wp), intent(inout) :: residual(:) !! one a local unknown [SI]
    real(wp) :: share(size(bearing%pad(1)%film%shape, 1), heated_rows), exchanged(3*size(share, 1) + 1), temperature(size(exchanged))
    integer :: place(size(exchanged))
    type(film_flow_type) :: flow
    integer :: i, element, b, n

    n = size(share, 1)
    do i = 1, size(bearing%pad)
      associate (pad => bearing%pad(i), film => bearing%pad(i)%film, heat => bearing%heat, unknown => state%unknown)
        flow = film%flow_at(state%point)
        do element = 1, size(film%element_nodes, 2)
          call heated_residual(film%geometry(element), flow, heat%gas, &
                               state_of(heat, pad, element, state%point, unknown, state%gap(pad%first_node + 1:pad%last_node)), share)
          place = element_walls(heat, pad, element)
          do b = 1, size(place)
            temperature(b) = unknown(place(b))
          end do
          exchanged = exchange(heat, pad, element, temperature)
          exchanged(:n) = exchanged(:n) - share(:, row_foil)
          exchanged(n + 1:2*n) = exchanged(n + 1:2*n) + film%copies*share(:, row_shaft)
          do b = 1, n
            associate (node => film%element_nodes(b, element))
              residual(pad%first + node) = residual(pad%first + node) + share(b, row_mass)
              associate (gas => heat%place_of_gas(i, node))
                residual(gas) = residual(gas) + share(b, row_energy)
              end associate
            end associate
            if (heat%sheet) residual(place(b)) = residual(place(b)) + exchanged(b)
            if (heat%shaft%kind /= wall_given) residual(place(n + b)) = residual(place(n + b)) + exchanged(n + b)
            if (heat%channels > 0) residual(place(2*n + b)) = residual(place(2*n + b)) + exchanged(2*n + b)
          end do
          if (heat%sleeve%kind /= wall_given) residual(place(3*n + 1)) = residual(place(3*n + 1)) + exchanged(3*n + 1)
          if (heat%softens()) then
            associate (mean => heat%place_of_mean(i), foil => heat%place_of_foil(i, film%element_nodes(:, element)))
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
  pure subroutine add_shaft_flux(bearing, state, flux, area)
    class(bearing_type), intent(in) :: bearing !! with heat
    type(bearing_state_type), intent(in) :: state !! of it
    real(wp), intent(inout) :: flux(:) !! at the pressures among the local unknowns [W]
    real(wp), intent(inout) :: area(:) !! the same [m2]
    real(wp) :: share(size(bearing%pad(1)%film%shape, 1), heated_rows)
    type(film_flow_type) :: flow
    integer :: i, element

    do i = 1, size(bearing%pad)
      associate (pad => bearing%pad(i), film => bearing%pad(i)%film, heat => bearing%heat)
        flow = film%flow_at(state%point)
        do element = 1, size(film%element_nodes, 2)
          call heated_residual(film%geometry(element), flow, heat%gas, &
                               state_of(heat, pad, element, state%point, state%unknown, state%gap(pad%first_node + 1:pad%last_node)), &
                               share)
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
  subroutine add_heat_flows(bearing, state, flow, residual)
    class(bearing_type), intent(in) :: bearing !! with heat
    type(bearing_state_type), intent(in) :: state !! of it
    real(wp), intent(in) :: flow(:)    !! at each local unknown of a pressure, what all ranks' elements take there [Pa m3/s]
    real(wp), intent(inout) :: residual(:) !! one a local unknown [SI]
    type(slit_type) :: slit(size(bearing%pad))
    integer :: i, node

    do i = 1, size(bearing%pad)
      associate (pad => bearing%pad(i), film => bearing%pad(i)%film, heat => bearing%heat, unknown => state%unknown)
        do node = 1, size(film%fixed)
          if (film%fixed(node)) residual(pad%first + node) = 0.0_wp
          if (.not. pad%mesh%owned(node)) cycle
          if (film%fixed(node)) then
            residual(pad%first + node) = unknown(pad%first + node) - film%ambient_pressure
            associate (inflow => heat%gas%density*flow(pad%first + node), gas => heat%place_of_gas(i, node))
              residual(gas) = residual(gas) + heat%gas%specific_heat*max(inflow, 0.0_wp)* &
                              (unknown(gas) - feed(heat, pad, node, unknown))
            end associate
          end if
          if (.not. heat%sheet) then
            residual(heat%place_of_foil(i, node)) = unknown(heat%place_of_foil(i, node)) - heat%foil_temperature
          end if
        end do
      end associate
    end do
    slit = slits_of(bearing%heat, bearing%pad, state%unknown, flow)
    if (bearing%last_rank) call add_walls(bearing%heat, bearing%pad, slit, state%unknown, residual)
  end subroutine add_heat_flows

  !> Temperature of the gas that is drawn in at a node of an edge [K].
  pure real(wp) function feed(heat, pad, node, unknown)
    type(film_heat_type), intent(in) :: heat !! of the bearing
    type(pad_type), intent(in) :: pad !! of it
    integer, intent(in) :: node   !! of this rank
    real(wp), intent(in) :: unknown(:) !! the bearing's local ones [SI]

    feed = heat%ambient
    if (is_leading(pad, node)) feed = unknown(heat%place_of_slit(pad%number))
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
              sums(3, i) = sums(3, i) + max(-inflow, 0.0_wp)*(unknown(heat%place_of_gas(i, node)) - heat%ambient)
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
    integer :: i

    associate (copies => pads(1)%film%copies, shaft => heat%place_of_shaft(1), sleeve => heat%place_of_sleeve())
      select case (heat%shaft%kind)
      case (wall_given)
        residual(shaft) = unknown(shaft) - heat%shaft%temperature
      case (wall_conductance)
        residual(shaft) = residual(shaft) - heat%shaft%conductance*(unknown(shaft) - heat%shaft%far)
      case default
        do i = merge(2, 1, copies > 1.0_wp), 2 ! of half the width one end
          associate (end => heat%place_of_shaft(merge(1, heat%shafts, i == 1)))
            residual(end) = residual(end) - copies*heat%end_conductance(i)*(unknown(end) - heat%end_temperature(i))
          end associate
        end do
      end select
      if (heat%sleeve%kind == wall_given) then
        residual(sleeve) = unknown(sleeve) - heat%sleeve%temperature
      else
        residual(sleeve) = residual(sleeve) - heat%sleeve%conductance*(unknown(sleeve) - heat%sleeve%far)
      end if
    end associate
    do i = 1, size(pads)
      associate (inlet => heat%place_of_slit(i))
        residual(inlet) = slit(i)%flow*(unknown(inlet) - heat%ambient) - slit(i)%carried
      end associate
    end do
    if (heat%channels > 0) then
      associate (mouth => heat%place_of_channel(1))
        residual(mouth) = residual(mouth) + heat%cooling*(unknown(mouth) - heat%cooling_temperature)
      end associate
    end if
  end subroutine add_walls
end module gfb_film_heat
