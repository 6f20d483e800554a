#include "gfb_petsc.h"
!> What heat adds to the numbers of an answer, and their derivatives by the unknowns: temperatures, ways of the heat, the clearance
!> that is left, and the films' friction torque, which is their power over the speed.
module gfb_heat_numbers
  use gfb_kinds, only: wp
  use gfb_petsc_session, only: sum_over_ranks
  use gfb_operating_point, only: operating_point_type
  use gfb_pad, only: pad_type
  use gfb_heated_film, only: heated_state_type, heated_jacobian, heated_shear_rates, mean_over_gap, heated_rows, heated_fields, row_foil, &
                             row_shaft, field_pressure, field_gap, field_gas, field_foil, field_shaft
  use gfb_bearing_heat, only: temperatures_at, moduli_at
  use gfb_orifice_heat, only: orifice_heat, add_orifice_heat_rates
  use gfb_heated_supply, only: wall_heat
  use gfb_film_heat, only: heat_flows, state_of, shaft_places, channel_places
  use gfb_heat_answer, only: heat_answer_type, heat_answer
  use gfb_bearing, only: bearing_type, bearing_state_type
  implicit none (type)
  private
  public :: heat_of_answer, read_heat, mean_temperature, measure_heat, add_heat_number_rates, follow_heat

  !> temperatures
  integer, parameter :: of_film = 1, of_hottest_film = 2, of_top_foil = 3, of_hottest_foil = 4, of_shaft = 5, of_sleeve = 6, of_inlet = 7, &
                        of_outlet = 8
  !> ways of the heat, and the clearance that is left
  integer, parameter :: to_shaft = 9, to_top_foil = 10, through_bumps = 11, to_channel = 12, by_gas = 13, left_clearance = 14
  integer, parameter, public :: heat_numbers = left_clearance
  integer, parameter :: of_torque = heat_numbers + 1, columns = of_torque

contains

  !> The heat alone of an answer, off the present state.
  function heat_of_answer(bearing) result(heat)
    class(bearing_type), intent(in) :: bearing !! with heat
    type(heat_answer_type) :: heat
    real(wp) :: unknown(bearing%local_size())

    call bearing%get_unknowns(unknown)
    heat = read_heat(bearing, bearing%position(unknown), unknown, bearing%gap(unknown))
  end function heat_of_answer

  !> Reads the heat off unknowns and gap.
  function read_heat(bearing, here, unknown, gap) result(heat)
    class(bearing_type), intent(in) :: bearing !! with heat
    type(operating_point_type), intent(in) :: here !! with the shaft's position
    real(wp), intent(in) :: unknown(:) !! the local ones [SI]
    real(wp), intent(in) :: gap(:)     !! at all film nodes [m]
    type(heat_answer_type) :: heat
    real(wp) :: value(size(unknown))
    type(bearing_state_type) :: state

    value = 0.0_wp
    state = bearing_state_type(here, bearing%point, unknown, gap)
    if (allocated(bearing%feed)) then
      heat = heat_answer(bearing%heat, bearing%pad, here, unknown, gap, heat_flows(bearing, state, value), orifice_heat(bearing, state))
    else
      heat = heat_answer(bearing%heat, bearing%pad, here, unknown, gap, heat_flows(bearing, state, value))
    end if
  end function read_heat

  !> Mean temperature over the gap at this rank's film nodes, pad by pad [K].
  function mean_temperature(bearing, unknown) result(mean)
    class(bearing_type), intent(in) :: bearing !! with heat
    real(wp), intent(in) :: unknown(:) !! local, in SI
    real(wp) :: mean(bearing%film_nodes())
    integer :: i

    do i = 1, size(bearing%pad)
      associate (pad => bearing%pad(i))
        associate (t => temperatures_at(bearing%heat, i, pad%mesh%mesh_node, pad%whole%rows(), unknown))
          mean(pad%first_node + 1:pad%last_node) = mean_over_gap(t(:, 1), t(:, 2), t(:, 3))
        end associate
      end associate
    end do
  end function mean_temperature

  !> Numbers of heat, and the film's share of the friction torque. Heat that the gas carries is what is left: energy closes.
  subroutine measure_heat(bearing, here, unknown, gap, number)
    class(bearing_type), intent(in) :: bearing !! with heat
    type(operating_point_type), intent(in) :: here !! with the shaft's position
    real(wp), intent(in) :: unknown(:) !! local, in SI
    real(wp), intent(in) :: gap(:) !! at all film nodes [m]
    real(wp), intent(out) :: number(:) !! behind them the films' friction torque [SI]
    type(heat_answer_type) :: heat

    heat = read_heat(bearing, here, unknown, gap)
    associate (whole => heat%whole)
      number(of_torque) = 0.0_wp
      if (abs(here%speed) > 0.0_wp) number(of_torque) = whole%power/here%speed
      number(of_film:of_hottest_foil) = [whole%film_temperature, whole%maximum_film_temperature, whole%top_foil_temperature, &
                                         whole%maximum_top_foil_temperature]
      number(of_shaft:of_outlet) = [heat%shaft_temperature, heat%sleeve_temperature, whole%inlet_temperature, &
                                    heat%cooling_outlet_temperature]
      number(to_shaft:to_channel) = [whole%to_shaft, whole%to_top_foil, whole%through_bumps, whole%to_channel]
      number(by_gas) = whole%power - whole%to_shaft - whole%to_top_foil
      if (heat%is_fed) number(by_gas) = number(by_gas) + whole%by_supply
      number(left_clearance) = heat%running_clearance
    end associate
  end subroutine measure_heat

  !> This rank's shares of the derivatives of these numbers at the present state and point, the gap staying, and by the gap.
  subroutine add_heat_number_rates(bearing, node, unknown, gap, by_unknown, by_gap)
    class(bearing_type), intent(in) :: bearing !! with heat
    integer, intent(in) :: node(:) !! of the hottest film and top foil; 0: on another rank
    real(wp), intent(in) :: unknown(:) !! local, in SI
    real(wp), intent(in) :: gap(:)     !! at all film nodes [m]
    real(wp), intent(out) :: by_unknown(:, :), by_gap(:, :) !! (unknowns or nodes, numbers and torque) [SI]
    real(wp) :: whole(2), supplied(size(bearing%pad))
    integer :: i

    by_unknown = 0.0_wp
    by_gap = 0.0_wp
    whole = film_sums(bearing, unknown)
    do i = 1, size(bearing%pad)
      associate (first => bearing%pad(i)%first_node + 1, last => bearing%pad(i)%last_node)
        call add_pad_heat(bearing, i, unknown, gap(first:last), whole, by_unknown, by_gap(first:last, :))
      end associate
    end do
    if (allocated(bearing%feed)) then
      call add_orifice_heat_rates(bearing, bearing_state_type(bearing%position(unknown), bearing%point, unknown, gap), supplied, &
                                  by_unknown(:, by_gas), by_gap(:, by_gas))
    end if
    call finish_heat(bearing, node, by_unknown, by_gap)
  end subroutine add_heat_number_rates

  !> Adds a pad's integrals of heat: of temperatures times what they are weighted with, by power in the torque's place.
  subroutine add_pad_heat(bearing, number, unknown, gap, whole, gradient, by_gap)
    class(bearing_type), intent(in) :: bearing !! with heat
    integer, intent(in) :: number !! of the pad
    real(wp), intent(in) :: unknown(:) !! the bearing's, in SI
    real(wp), intent(in) :: gap(:)     !! at the pad's nodes [m]
    real(wp), intent(in) :: whole(2)   !! see `film_sums`
    real(wp), intent(inout) :: gradient(:, :), by_gap(:, :) !! (bearing's unknowns or pad's nodes, columns)
    type(heated_state_type) :: state
    type(operating_point_type) :: here
    real(wp) :: rate(size(bearing%pad(1)%film%shape, 1), heated_rows, size(bearing%pad(1)%film%shape, 1), heated_fields)
    real(wp) :: of_excess(size(rate, 1), heated_rows, size(rate, 1)), shear(size(rate, 1), heated_fields), of_shear(size(rate, 1))
    real(wp) :: by(size(rate, 1), heated_fields, columns), by_excess(size(rate, 1), columns), mean(size(rate, 1))
    real(wp) :: supplied
    integer :: element, k, n

    n = size(rate, 1)
    here = bearing%position(unknown)
    associate (heat => bearing%heat, pad => bearing%pad(number), film => bearing%pad(number)%film)
      do element = 1, size(film%element_nodes, 2)
        state = state_of(heat, pad, element, here, unknown, gap)
        call heated_jacobian(film%geometry(element), film%flow_at(here), heat%gas, state, rate, of_excess)
        call heated_shear_rates(film%geometry(element), film%flow_at(here), heat%gas, state, shear, of_shear)
        by = 0.0_wp
        by_excess = 0.0_wp
        by(:, :, to_shaft) = sum(rate(:, row_shaft, :, :), 1)
        by_excess(:, to_shaft) = sum(of_excess(:, row_shaft, :), 1)
        by(:, :, to_top_foil) = sum(rate(:, row_foil, :, :), 1)
        by_excess(:, to_top_foil) = sum(of_excess(:, row_foil, :), 1)
        by(:, :, of_torque) = shear
        by_excess(:, of_torque) = of_shear
        if (film%wall%present) call wall_heat(film%geometry(element), heat%gas, state, heat%ambient, supplied, &
                                              by(:, field_pressure, by_gas), by(:, field_gas, by_gas))
        mean = mean_over_gap(state%field(:n, field_gas), state%field(:n, field_foil), state%field(:n, field_shaft))
        associate (area => film%geometry(element)%area, shape => film%shape, &
                   h => matmul(state%field(:n, field_gap), film%shape) + state%excess(:n))
          associate (gas => matmul(shape, area*h)/whole(1), off => area*(matmul(mean, shape) - whole(2))/whole(1))
            by(:, field_gas, of_film) = gas
            by(:, field_foil, of_film) = gas/6.0_wp
            by(:, field_shaft, of_film) = -gas/6.0_wp
            by(:, field_gap, of_film) = matmul(shape, off)
            by_excess(:, of_film) = off
          end associate
          by(:, field_foil, of_top_foil) = matmul(shape, area)
          by(:, field_shaft, of_shaft) = matmul(shape, area)
        end associate
        associate (nodes => film%element_nodes(:, element))
          associate (gas => heat%place_of_gas(number, nodes), foil => heat%place_of_foil(number, nodes))
            do k = 1, columns
              gradient(pad%first + nodes, k) = gradient(pad%first + nodes, k) + film%copies*by(:, field_pressure, k)
              gradient(gas, k) = gradient(gas, k) + film%copies*by(:, field_gas, k)
              gradient(foil, k) = gradient(foil, k) + film%copies*by(:, field_foil, k)
            end do
          end associate
          do k = 1, columns
            by_gap(nodes, k) = by_gap(nodes, k) + film%copies*by(:, field_gap, k)
          end do
          call add_shares(shaft_places(heat, pad, nodes), film%copies*by(:, field_shaft, :), gradient)
          if (heat%channels > 0) call add_shares(channel_places(heat, pad, nodes), &
            reshape([(-merge(film%copies*heat%channel, 0.0_wp, k == to_channel)*by(:, field_foil, of_top_foil), k=1, columns)], &
                    [n, columns]), gradient)
          if (bearing%floats) then
            do k = 1, 2
              gradient(bearing%first_shaft + k, :) = gradient(bearing%first_shaft + k, :) &
                + film%copies*matmul(film%motion_excess(k, :, element), by_excess)
            end do
          end if
        end associate
      end do
    end associate
  end subroutine add_pad_heat

  !> Adds to unknowns that some nodes have together.
  pure subroutine add_shares(place, share, gradient)
    integer, intent(in) :: place(:) !! local unknown of each node
    real(wp), intent(in) :: share(:, :) !! (nodes, columns)
    real(wp), intent(inout) :: gradient(:, :) !! (unknowns, columns)
    integer :: i

    do i = 1, size(place)
      gradient(place(i), :) = gradient(place(i), :) + share(i, :)
    end do
  end subroutine add_shares

  !> Gas in the gap of all pads [m3], and its mean temperature [K].
  function film_sums(bearing, unknown) result(sums)
    class(bearing_type), intent(in) :: bearing !! with heat
    real(wp), intent(in) :: unknown(:) !! local, in SI
    real(wp) :: sums(2), mean(bearing%film_nodes()), gap(bearing%film_nodes())
    integer :: i, element

    mean = mean_temperature(bearing, unknown)
    gap = bearing%gap(unknown)
    sums = 0.0_wp
    do i = 1, size(bearing%pad)
      associate (film => bearing%pad(i)%film, first => bearing%pad(i)%first_node)
        do element = 1, size(film%element_nodes, 2)
          associate (nodes => first + film%element_nodes(:, element), area => film%copies*film%geometry(element)%area, &
                     excess => film%excess(element, bearing%position(unknown)))
            associate (gas => area*(matmul(gap(nodes), film%shape) + excess(:size(area))))
              sums = sums + [sum(gas), dot_product(gas, matmul(mean(nodes), film%shape))]
            end associate
          end associate
        end do
      end associate
    end do
    sums = sum_over_ranks(sums)
    sums(2) = sums(2)/sums(1)
  end function film_sums

  !> What follows from the integrals of all pads, and temperatures of single walls and nodes.
  subroutine finish_heat(bearing, node, gradient, by_gap)
    class(bearing_type), intent(in) :: bearing !! with heat
    integer, intent(in) :: node(:) !! of the hottest film and top foil
    real(wp), intent(inout) :: gradient(:, :), by_gap(:, :) !! (unknowns or nodes, columns)
    real(wp) :: area(1)
    integer :: i, shaft(1)

    area = sum_over_ranks([sum([(film_area(bearing%pad(i)), i=1, size(bearing%pad))])])
    associate (heat => bearing%heat, growth => bearing%point%growth, sleeve => bearing%heat%place_of_sleeve())
      gradient(:, through_bumps) = heat%bumps*gradient(:, of_top_foil)
      gradient(:, to_channel) = gradient(:, to_channel) + merge(heat%channel, 0.0_wp, heat%channels > 0)*gradient(:, of_top_foil)
      gradient(:, of_top_foil) = gradient(:, of_top_foil)/area(1)
      gradient(:, of_shaft) = gradient(:, of_shaft)/area(1)
      gradient(:, left_clearance) = -growth*heat%shaft%growth*gradient(:, of_shaft)
      ! What a supply brings stands there.
      gradient(:, by_gas) = gradient(:, by_gas) + gradient(:, of_torque) - gradient(:, to_shaft) - gradient(:, to_top_foil)
      by_gap(:, by_gas) = by_gap(:, by_gas) + by_gap(:, of_torque) - by_gap(:, to_shaft) - by_gap(:, to_top_foil)
      if (abs(bearing%point%speed) > 0.0_wp) then
        gradient(:, of_torque) = gradient(:, of_torque)/bearing%point%speed
        by_gap(:, of_torque) = by_gap(:, of_torque)/bearing%point%speed
      end if
      if (bearing%last_rank) then
        gradient(sleeve, of_sleeve) = 1.0_wp
        gradient(sleeve, through_bumps) = -heat%bumps*area(1)
        gradient(sleeve, left_clearance) = growth*heat%sleeve%growth
        do i = 1, size(bearing%pad)
          gradient(heat%place_of_slit(i), of_inlet) = 1.0_wp/real(size(bearing%pad), wp)
        end do
        if (heat%channels > 0) gradient(heat%place_of_channel(heat%channels), of_outlet) = 1.0_wp
      end if
      do i = 1, size(bearing%pad)
        associate (pad => bearing%pad(i))
          associate (film => node(1) - pad%first_node, foil => node(2) - pad%first_node, &
                     own => pad%last_node - pad%first_node)
            if (film > 0 .and. film <= own) then
              shaft = shaft_places(heat, pad, [film])
              gradient(heat%place_of_gas(i, film), of_hottest_film) = 1.0_wp
              gradient(heat%place_of_foil(i, film), of_hottest_film) = 1.0_wp/6.0_wp
              gradient(shaft(1), of_hottest_film) = -1.0_wp/6.0_wp
            end if
            if (foil > 0 .and. foil <= own) gradient(heat%place_of_foil(i, foil), of_hottest_foil) = 1.0_wp
          end associate
        end associate
      end do
    end associate
  end subroutine finish_heat

  !> This rank's share of the area of a pad's film, mirrored and turned copies with it [m2].
  pure real(wp) function film_area(pad) result(area)
    type(pad_type), intent(in) :: pad
    integer :: element

    area = 0.0_wp
    do element = 1, size(pad%film%element_nodes, 2)
      associate (geometry => pad%film%geometry(element))
        area = area + pad%film%copies*sum(geometry%area)
      end associate
    end do
  end function film_area

  !> What the gap of all pads does by temperatures: of shaft and sleeve, which grow, and of springs without unknowns, which soften.
  subroutine follow_heat(bearing, unknown, by_gap, gradient)
    class(bearing_type), intent(in) :: bearing !! with heat
    real(wp), intent(in) :: unknown(:) !! local, in SI
    real(wp), intent(in) :: by_gap(:, :) !! (all film nodes, numbers)
    real(wp), intent(inout) :: gradient(:, :) !! (unknowns, numbers)
    integer :: i

    do i = 1, size(bearing%pad)
      associate (pad => bearing%pad(i), mine => by_gap(bearing%pad(i)%first_node + 1:bearing%pad(i)%last_node, :))
        call follow_growth(bearing, pad, mine, gradient)
        if (bearing%heat%softens()) call follow_modulus(bearing, pad, unknown, mine, gradient)
      end associate
    end do
  end subroutine follow_heat

  !> What a pad's gap does by the temperatures of shaft and sleeve.
  pure subroutine follow_growth(bearing, pad, by_gap, gradient)
    class(bearing_type), intent(in) :: bearing !! with heat
    type(pad_type), intent(in) :: pad
    real(wp), intent(in) :: by_gap(:, :) !! (pad's nodes, numbers)
    real(wp), intent(inout) :: gradient(:, :) !! (bearing's unknowns, numbers)
    integer :: node

    associate (heat => bearing%heat, part => bearing%point%growth)
      call add_shares(shaft_places(heat, pad, [(node, node=1, size(by_gap, 1))]), &
                      -part*heat%shaft%growth*by_gap, gradient)
      associate (sleeve => gradient(heat%place_of_sleeve(), :))
        sleeve = sleeve + part*heat%sleeve%growth*sum(by_gap, 1)
      end associate
    end associate
  end subroutine follow_growth

  !> What a pad's gap does by the temperatures that its springs follow, where these have no unknowns.
  pure subroutine follow_modulus(bearing, pad, unknown, by_gap, gradient)
    class(bearing_type), intent(in) :: bearing !! with heat
    type(pad_type), intent(in) :: pad
    real(wp), intent(in) :: unknown(:) !! the bearing's, in SI
    real(wp), intent(in) :: by_gap(:, :) !! (pad's nodes, numbers)
    real(wp), intent(inout) :: gradient(:, :) !! (bearing's unknowns, numbers)
    real(wp) :: ratio(2), rate(2)
    integer :: k

    if (pad%foil%local_unknowns() > 0) return
    associate (heat => bearing%heat)
      call moduli_at(heat, pad%number, bearing%point%growth, unknown, ratio, rate)
      associate (slope => matmul(-rate(2)/ratio(2)*pad%foil%deflection(unknown(pad%first + 1:pad%last), ratio), by_gap), &
                 wall => [heat%place_of_mean(pad%number), heat%place_of_sleeve()])
        do k = 1, size(wall)
          gradient(wall(k), :) = gradient(wall(k), :) + slope
        end do
      end associate
    end associate
  end subroutine follow_modulus
end module gfb_heat_numbers
