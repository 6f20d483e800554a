#include "gfb_petsc.h"
!> Numbers of an answer as functions of its unknowns and of the bearing, and their derivatives by the unknowns.
!>
!> The smallest gap and the extreme pressures are those of the nodes where they are at the answer, the largest stresses of the foils
!> those of the elements.
module gfb_answer_numbers
  use gfb_kinds, only: wp
  use gfb_petsc_session, only: this_rank, sum_over_ranks, largest_over_ranks
  use gfb_film_load, only: film_forces
  use gfb_film_surface, only: film_surface_type, axial_coordinate, translations
  use gfb_film_measures, only: film_drag, film_drag_rates, film_moment
  use gfb_solid_contact, only: contact_pressure_rate
  use gfb_operating_point, only: operating_point_type
  use gfb_pad, only: pad_type
  use gfb_bearing_answer, only: read_heat
  use gfb_bearing_system, only: bearing_system_type
  use gfb_heated_film, only: heated_state_type, heated_jacobian, heated_shear_rates, mean_over_gap, heated_rows, heated_fields, row_foil, &
                             row_shaft, field_pressure, field_gap, field_gas, field_foil, field_shaft
  use gfb_bearing_heat, only: temperatures_at, moduli_at
  use gfb_film_heat, only: state_of, shaft_places, channel_places
  use gfb_heat_answer, only: heat_answer_type
  use gfb_meshed_foil, only: bump_surface
  use gfb_largest_stress, only: surfaces, stress_place_type, find_largest_stress, stress_at, add_stress_rates
  implicit none (type)
  private
  public :: find_extremes, measure, measure_gradient

  integer, parameter, public :: place_e = 1, place_force = 3, place_torque = 7, place_speed = 8 !! first numbers of each kind
  integer, parameter, public :: place_extremes = 9, place_stress = 12, place_heat = place_stress + surfaces, numbers = 27
  integer, parameter :: forces = place_torque - place_force
  integer, parameter :: extremes = 3 !! smallest gap, largest and smallest pressure
  !> numbers of heat: temperatures
  integer, parameter :: of_film = place_heat, of_hottest_film = of_film + 1, of_top_foil = of_film + 2, of_hottest_foil = of_film + 3, &
                        of_shaft = of_film + 4, of_sleeve = of_film + 5, of_inlet = of_film + 6, of_outlet = of_film + 7
  !> ways of the heat, and the clearance that is left
  integer, parameter :: to_shaft = of_film + 8, to_top_foil = of_film + 9, through_bumps = of_film + 10, to_channel = of_film + 11, &
                        by_gas = of_film + 12, left_clearance = of_film + 13

  !> The film nodes of extreme values, 0 on all ranks but one; with heat those of the hottest film and top foil, too.
  type, public :: extreme_nodes_type
    integer :: node(extremes + 2) = 0
    type(stress_place_type) :: stress(surfaces) !! of each surface's largest stress; pad 0 where it is not asked for
  end type extreme_nodes_type

  !> How the foils of a pad move.
  type :: pad_motions_type
    real(wp), allocatable :: top(:, :, :), bumps(:, :, :) !! (5, local nodes, motions) [m], [rad]
  end type pad_motions_type

  !> An answer at which equations with other keys are evaluated.
  type, public :: known_answer_type
    real(wp), allocatable :: unknown(:) !! local ones, in SI
    type(extreme_nodes_type) :: nodes   !! of extreme values
    !> of its pads where foils are meshed: first the answer's own motion, then the adjoints of all quantities
    type(pad_motions_type), allocatable :: motion(:)
  end type known_answer_type

contains

  !> The nodes of the smallest gap and of the largest and smallest pressure at the present state, the elements of the largest stresses.
  subroutine find_extremes(bearing, stresses, where_they_are)
    type(bearing_system_type), intent(in) :: bearing !! at an answer
    logical, intent(in) :: stresses !! are looked for
    type(extreme_nodes_type), intent(out) :: where_they_are !! on this rank
    real(wp) :: unknown(bearing%local_size()), value(bearing%film_nodes(), extremes + 2)
    real(wp), dimension(extremes + 2) :: most, here
    integer :: i

    call bearing%get_unknowns(unknown)
    value(:, 1) = -bearing%gap(unknown)
    value(:, 2) = bearing%film_pressure(unknown)
    value(:, 3) = -value(:, 2)
    value(:, 4:) = 0.0_wp
    if (bearing%heat%present) then
      value(:, 4) = mean_temperature(bearing, unknown)
      value(:, 5) = bearing%film_temperature(unknown, 2)
    end if
    here = maxval(value, 1)
    most = largest_over_ranks(here)
    ! one of those ranks that have the node
    here = largest_over_ranks(merge(real(this_rank() + 1, wp), 0.0_wp, here >= most))
    do i = 1, merge(size(here), extremes, bearing%heat%present)
      if (nint(here(i)) == this_rank() + 1) where_they_are%node(i) = maxloc(value(:, i), 1)
    end do
    if (stresses) call find_stresses(bearing, unknown, where_they_are%stress)
  end subroutine find_extremes

  !> The elements where the stresses of the foils are largest, on one rank each.
  subroutine find_stresses(bearing, unknown, stress)
    type(bearing_system_type), intent(in) :: bearing !! whose foils are meshed
    real(wp), intent(in) :: unknown(:) !! local, in SI
    type(stress_place_type), intent(out) :: stress(:)
    type(stress_place_type) :: place(surfaces)
    real(wp), dimension(surfaces) :: most, largest, owner
    integer :: i, k

    most = 0.0_wp
    do i = 1, size(bearing%pad)
      associate (pad => bearing%pad(i))
        call find_largest_stress(pad%foil, unknown(pad%first + 1:pad%last), place, largest)
        largest = bearing%modulus(i, unknown)*largest
        owner = largest_over_ranks(largest)
        do k = 1, surfaces
          if (.not. owner(k) > most(k)) cycle
          most(k) = owner(k)
          stress(k) = place(k)
          stress(k)%pad = i
          if (largest(k) < most(k)) stress(k)%element = 0
        end do
      end associate
    end do
    ! one of those ranks that have the same stress
    owner = largest_over_ranks(merge(real(this_rank() + 1, wp), 0.0_wp, stress%element > 0))
    where (nint(owner) /= this_rank() + 1) stress%element = 0
  end subroutine find_stresses

  !> Mean temperature over the gap at this rank's film nodes, pad by pad [K].
  function mean_temperature(bearing, unknown) result(mean)
    type(bearing_system_type), intent(in) :: bearing !! with heat
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

  !> Eccentricity, or of a ring e_z and 0 [m], forces and torques, see `coordinates_of` [N], [N m], friction torque [N m], speed [rad/s], the values
  !> at the extreme nodes [m], [Pa], stresses of the foils [Pa]; with heat temperatures [K], its ways [W], the clearance that is left [m].
  function measure(bearing, unknown, point, nodes) result(number)
    type(bearing_system_type), intent(in) :: bearing !! pads and shaft
    real(wp), intent(in) :: unknown(:) !! local, in SI
    type(operating_point_type), intent(in) :: point !! with the shaft's position where it is fixed
    type(extreme_nodes_type), intent(in) :: nodes !! of extreme values
    real(wp) :: number(numbers)
    real(wp) :: gap(bearing%film_nodes()), pressure(bearing%film_nodes()), solid(bearing%film_nodes()), force(film_forces)
    type(operating_point_type) :: here
    integer :: i

    here = bearing%position(unknown, point)
    gap = bearing%gap(unknown, point)
    pressure = bearing%film_pressure(unknown)
    solid = bearing%solid_pressure(unknown)
    number = 0.0_wp
    force = bearing%local_force(unknown, gap)
    number(place_force:place_torque - 1) = force(coordinates_of(bearing%pad(1)%film%surface))
    do i = 1, size(bearing%pad)
      associate (pad => bearing%pad(i), first => bearing%pad(i)%first_node + 1, last => bearing%pad(i)%last_node)
        if (.not. bearing%heat%present) number(place_torque) = number(place_torque) + pad%film%surface%radius* &
          film_drag(pad%film, pressure(first:last), gap(first:last), here)
        if (.not. pad%contact%present) cycle
        number(place_torque) = number(place_torque) + pad%film%surface%radius*pad%contact%friction* &
          film_moment(pad%film, solid(first:last))
      end associate
    end do
    if (nodes%node(1) > 0) number(place_extremes) = gap(nodes%node(1))
    do i = 2, extremes
      if (nodes%node(i) > 0) number(place_extremes + i - 1) = pressure(nodes%node(i))
    end do
    if (any(nodes%stress%pad > 0)) call measure_stresses(bearing, unknown, nodes%stress, number(place_stress:place_heat - 1))
    number = sum_over_ranks(number)
    associate (of_force => coordinates_of(bearing%pad(1)%film%surface))
      number(place_e:place_e + 1) = here%place(of_force(:2))
    end associate
    number(place_speed) = point%speed
    if (bearing%heat%present) call measure_heat(bearing, here, unknown, gap, number)
  end function measure

  !> This rank's stresses at the places where they were largest.
  subroutine measure_stresses(bearing, unknown, place, stress)
    type(bearing_system_type), intent(in) :: bearing
    real(wp), intent(in) :: unknown(:) !! local, in SI
    type(stress_place_type), intent(in) :: place(:)
    real(wp), intent(inout) :: stress(:) !! one a surface [Pa]
    logical :: here(size(place))
    integer :: i

    do i = 1, size(bearing%pad)
      here = place%pad == i
      if (.not. any(here)) cycle
      associate (pad => bearing%pad(i))
        stress = stress + bearing%modulus(i, unknown)* &
          unpack(stress_at(pad%foil, pack(place, here), unknown(pad%first + 1:pad%last)), here, 0.0_wp)
      end associate
    end do
  end subroutine measure_stresses

  !> The shaft's coordinates whose forces are numbers: F_x, F_y, M_x, M_y of a journal; of a ring F_z in F_x' place, and F_y is 0.
  pure function coordinates_of(surface) result(coordinate)
    type(film_surface_type), intent(in) :: surface !! that the film lies on
    integer :: coordinate(forces)

    coordinate = [1, 2, 4, 5]
    if (surface%is_ring()) coordinate(1) = axial_coordinate
  end function coordinates_of

  !> Numbers of heat, and the film's share of the friction torque. Heat that the gas carries is what is left: energy closes.
  subroutine measure_heat(bearing, here, unknown, gap, number)
    type(bearing_system_type), intent(in) :: bearing !! with heat
    type(operating_point_type), intent(in) :: here !! with the shaft's position
    real(wp), intent(in) :: unknown(:) !! local, in SI
    real(wp), intent(in) :: gap(:) !! at all film nodes [m]
    real(wp), intent(inout) :: number(:)
    type(heat_answer_type) :: heat

    heat = read_heat(bearing, here, unknown, gap)
    associate (whole => heat%whole)
      if (abs(here%speed) > 0.0_wp) number(place_torque) = number(place_torque) + whole%power/here%speed
      number(of_film:of_hottest_foil) = [whole%film_temperature, whole%maximum_film_temperature, whole%top_foil_temperature, &
                                         whole%maximum_top_foil_temperature]
      number(of_shaft:of_outlet) = [heat%shaft_temperature, heat%sleeve_temperature, whole%inlet_temperature, &
                                    heat%cooling_outlet_temperature]
      number(to_shaft:to_channel) = [whole%to_shaft, whole%to_top_foil, whole%through_bumps, whole%to_channel]
      number(by_gas) = whole%power - whole%to_shaft - whole%to_top_foil
      number(left_clearance) = heat%running_clearance
    end associate
  end subroutine measure_heat

  !> This rank's shares of the derivatives of these numbers by the local unknowns, at the present state and point.
  subroutine measure_gradient(bearing, nodes, gradient)
    type(bearing_system_type), intent(in) :: bearing !! at an answer
    type(extreme_nodes_type), intent(in) :: nodes !! of extreme values
    real(wp), intent(out) :: gradient(:, :) !! (local unknowns, numbers; without heat those before its) [SI]
    real(wp) :: unknown(bearing%local_size()), gap(bearing%film_nodes()), by_gap(bearing%film_nodes(), size(gradient, 2))
    integer :: i

    call bearing%get_unknowns(unknown)
    gap = bearing%gap(unknown)
    gradient = 0.0_wp
    by_gap = 0.0_wp
    if (bearing%floats .and. bearing%last_rank) then
      do i = 1, count(bearing%coordinate <= translations)
        gradient(bearing%first_shaft + i, place_e + i - 1) = 1.0_wp
      end do
    end if
    do i = 1, size(bearing%pad)
      associate (pad => bearing%pad(i), first => bearing%pad(i)%first_node + 1, last => bearing%pad(i)%last_node)
        call add_forces(pad, gap(first:last), gradient(pad%first + 1:pad%last, :), by_gap(first:last, :))
        if (bearing%heat%present) then
          call add_pad_heat(bearing, i, unknown, gap(first:last), gradient, by_gap(first:last, :))
        else
          call add_drag(bearing, pad, unknown, gap(first:last), gradient, by_gap(first:last, :))
        end if
      end associate
    end do
    if (bearing%heat%present) then
      call finish_heat(bearing, nodes, gradient, by_gap)
      do i = 1, size(bearing%pad)
        associate (pad => bearing%pad(i), first => bearing%pad(i)%first_node + 1, last => bearing%pad(i)%last_node)
          by_gap(first:last, place_torque) = by_gap(first:last, place_torque) + pad%film%surface%radius*pad%contact%friction* &
            nodal_levers(pad)*contact_pressure_rate(pad%contact, gap(first:last))
        end associate
      end do
    end if
    call add_extremes(bearing, nodes, gradient, by_gap)
    call add_stresses(bearing, nodes%stress, unknown, gradient(:, place_stress:place_heat - 1))
    do i = 1, size(bearing%pad)
      call follow_gap(bearing, bearing%pad(i), unknown, by_gap(bearing%pad(i)%first_node + 1:bearing%pad(i)%last_node, :), gradient)
    end do
  end subroutine measure_gradient

  !> Forces and torques: weights of the pressures, those of the asperities by the gap.
  pure subroutine add_forces(pad, gap, by_unknown, by_gap)
    type(pad_type), intent(in) :: pad
    real(wp), intent(in) :: gap(:) !! at its nodes [m]
    real(wp), intent(inout) :: by_unknown(:, :), by_gap(:, :) !! (pad's unknowns or nodes, numbers)
    integer :: k, coordinate(forces)

    coordinate = coordinates_of(pad%film%surface)
    do k = 1, forces
      associate (weight => pad%film%force_weight(coordinate(k), :))
        by_unknown(:size(gap), place_force + k - 1) = weight
        by_gap(:, place_force + k - 1) = weight*contact_pressure_rate(pad%contact, gap)
      end associate
    end do
  end subroutine add_forces

  !> Friction torque of a pad's film and asperities. Between the nodes the rigid gap follows the shaft by itself.
  subroutine add_drag(bearing, pad, unknown, gap, gradient, by_gap)
    type(bearing_system_type), intent(in) :: bearing
    type(pad_type), intent(in) :: pad
    real(wp), intent(in) :: unknown(:) !! the bearing's, in SI
    real(wp), intent(in) :: gap(:)     !! at the pad's nodes [m]
    real(wp), intent(inout) :: gradient(:, :), by_gap(:, :) !! (bearing's unknowns or pad's nodes, numbers)
    real(wp), parameter :: part = 1.0e-3_wp ! of the clearance, that the shaft is moved by
    real(wp) :: by_pressure(size(gap)), by_node(size(gap)), area(size(gap)), step, lever(size(bearing%coordinate))
    type(operating_point_type) :: ahead, behind
    integer :: k

    associate (film => pad%film, pressure => unknown(pad%first + 1:pad%first + size(gap)))
      call film_drag_rates(film, pressure, gap, bearing%position(unknown), by_pressure, by_node)
      associate (mine => gradient(pad%first + 1:pad%first + size(gap), place_torque))
        mine = mine + film%surface%radius*by_pressure
      end associate
      area = nodal_levers(pad)
      by_gap(:, place_torque) = film%surface%radius*(by_node + pad%contact%friction*area*contact_pressure_rate(pad%contact, gap))
      lever = bearing%levers()
      do k = 1, size(bearing%coordinate) ! none of a shaft that is fixed
        step = part*film%clearance/lever(k)
        ahead = bearing%position(unknown)
        behind = ahead
        associate (forwards => ahead%place(bearing%coordinate(k)), backwards => behind%place(bearing%coordinate(k)))
          forwards = forwards + step
          backwards = backwards - step
        end associate
        associate (by_shaft => gradient(bearing%first_shaft + k, place_torque))
          by_shaft = by_shaft + film%surface%radius*(film_drag(film, pressure, gap, ahead) &
                                             - film_drag(film, pressure, gap, behind))/(2.0_wp*step)
        end associate
      end do
    end associate
  end subroutine add_drag

  !> Adds a pad's integrals of heat: of temperatures times what they are weighted with, by power in the torque's place.
  subroutine add_pad_heat(bearing, number, unknown, gap, gradient, by_gap)
    type(bearing_system_type), intent(in) :: bearing !! with heat
    integer, intent(in) :: number !! of the pad
    real(wp), intent(in) :: unknown(:) !! the bearing's, in SI
    real(wp), intent(in) :: gap(:)     !! at the pad's nodes [m]
    real(wp), intent(inout) :: gradient(:, :), by_gap(:, :) !! (bearing's unknowns or pad's nodes, numbers)
    type(heated_state_type) :: state
    type(operating_point_type) :: here
    real(wp) :: rate(size(bearing%pad(1)%film%shape, 1), heated_rows, size(bearing%pad(1)%film%shape, 1), heated_fields)
    real(wp) :: of_excess(size(rate, 1), heated_rows, size(rate, 1)), shear(size(rate, 1), heated_fields), of_shear(size(rate, 1))
    real(wp) :: by(size(rate, 1), heated_fields, numbers), by_excess(size(rate, 1), numbers), mean(size(rate, 1)), whole(2)
    integer :: element, k, n

    n = size(rate, 1)
    here = bearing%position(unknown)
    whole = film_sums(bearing, unknown)
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
        by(:, :, place_torque) = shear
        by_excess(:, place_torque) = of_shear
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
            do k = 1, numbers
              gradient(pad%first + nodes, k) = gradient(pad%first + nodes, k) + film%copies*by(:, field_pressure, k)
              gradient(gas, k) = gradient(gas, k) + film%copies*by(:, field_gas, k)
              gradient(foil, k) = gradient(foil, k) + film%copies*by(:, field_foil, k)
            end do
          end associate
          do k = 1, numbers
            by_gap(nodes, k) = by_gap(nodes, k) + film%copies*by(:, field_gap, k)
          end do
          call add_shares(shaft_places(heat, pad, nodes), film%copies*by(:, field_shaft, :), gradient)
          if (heat%channels > 0) call add_shares(channel_places(heat, pad, nodes), &
            reshape([(-merge(film%copies*heat%channel, 0.0_wp, k == to_channel)*by(:, field_foil, of_top_foil), k=1, numbers)], &
                    [n, numbers]), gradient)
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
    real(wp), intent(in) :: share(:, :) !! (nodes, numbers)
    real(wp), intent(inout) :: gradient(:, :) !! (unknowns, numbers)
    integer :: i

    do i = 1, size(place)
      gradient(place(i), :) = gradient(place(i), :) + share(i, :)
    end do
  end subroutine add_shares

  !> Gas in the gap of all pads [m3], and its mean temperature [K].
  function film_sums(bearing, unknown) result(sums)
    type(bearing_system_type), intent(in) :: bearing !! with heat
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
  subroutine finish_heat(bearing, nodes, gradient, by_gap)
    type(bearing_system_type), intent(in) :: bearing !! with heat
    type(extreme_nodes_type), intent(in) :: nodes !! of extreme values
    real(wp), intent(inout) :: gradient(:, :), by_gap(:, :) !! (unknowns or nodes, numbers)
    real(wp) :: area(1)
    integer :: i, shaft(1)

    area = sum_over_ranks([sum([(film_area(bearing%pad(i)), i=1, size(bearing%pad))])])
    associate (heat => bearing%heat, growth => bearing%point%growth, sleeve => bearing%heat%place_of_sleeve())
      gradient(:, through_bumps) = heat%bumps*gradient(:, of_top_foil)
      gradient(:, to_channel) = gradient(:, to_channel) + merge(heat%channel, 0.0_wp, heat%channels > 0)*gradient(:, of_top_foil)
      gradient(:, of_top_foil) = gradient(:, of_top_foil)/area(1)
      gradient(:, of_shaft) = gradient(:, of_shaft)/area(1)
      gradient(:, left_clearance) = -growth*heat%shaft%growth*gradient(:, of_shaft)
      gradient(:, by_gas) = gradient(:, place_torque) - gradient(:, to_shaft) - gradient(:, to_top_foil)
      by_gap(:, by_gas) = by_gap(:, place_torque) - by_gap(:, to_shaft) - by_gap(:, to_top_foil)
      if (abs(bearing%point%speed) > 0.0_wp) then
        gradient(:, place_torque) = gradient(:, place_torque)/bearing%point%speed
        by_gap(:, place_torque) = by_gap(:, place_torque)/bearing%point%speed
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
          associate (film => nodes%node(extremes + 1) - pad%first_node, foil => nodes%node(extremes + 2) - pad%first_node, &
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

  !> Weights of a field's nodal values in `film_moment`, over the film's radius: areas, of sectors times r/R; this rank's share [m2].
  pure function nodal_levers(pad) result(area)
    type(pad_type), intent(in) :: pad
    real(wp) :: area(size(pad%film%angle))
    integer :: element

    area = 0.0_wp
    do element = 1, size(pad%film%element_nodes, 2)
      associate (nodes => pad%film%element_nodes(:, element), geometry => pad%film%geometry(element))
        area(nodes) = area(nodes) + pad%film%copies*matmul(pad%film%shape, geometry%area*geometry%stretch)
      end associate
    end do
  end function nodal_levers

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

  !> The extreme values, on the rank that has their nodes.
  pure subroutine add_extremes(bearing, nodes, gradient, by_gap)
    type(bearing_system_type), intent(in) :: bearing
    type(extreme_nodes_type), intent(in) :: nodes
    real(wp), intent(inout) :: gradient(:, :), by_gap(:, :) !! (bearing's unknowns or nodes, numbers)
    integer :: i, k

    if (nodes%node(1) > 0) by_gap(nodes%node(1), place_extremes) = 1.0_wp
    do k = 2, extremes
      do i = 1, size(bearing%pad)
        associate (pad => bearing%pad(i))
          if (nodes%node(k) <= pad%first_node .or. nodes%node(k) > pad%last_node) cycle
          gradient(pad%first + nodes%node(k) - pad%first_node, place_extremes + k - 1) = 1.0_wp
        end associate
      end do
    end do
  end subroutine add_extremes

  !> The largest stresses, by the foil's unknowns and by the temperatures that its modulus follows.
  subroutine add_stresses(bearing, place, unknown, gradient)
    type(bearing_system_type), intent(in) :: bearing
    type(stress_place_type), intent(in) :: place(:)
    real(wp), intent(in) :: unknown(:) !! the bearing's, in SI
    real(wp), intent(inout) :: gradient(:, :) !! (bearing's unknowns, stresses)
    real(wp) :: ratio(2), rate(2)
    integer :: k

    do k = 1, size(place)
      if (place(k)%pad == 0) cycle
      associate (pad => bearing%pad(place(k)%pad), heat => bearing%heat)
        associate (own => unknown(pad%first + 1:pad%last), mine => gradient(pad%first + 1:pad%last, k))
          call add_stress_rates(pad%foil, place(k), own, mine)
          ratio = bearing%modulus(place(k)%pad, unknown)
          mine = ratio(k)*mine
          if (.not. heat%softens()) cycle
          call moduli_at(heat, place(k)%pad, bearing%point%growth, unknown, ratio, rate)
          associate (slope => rate(k)*stress_at(pad%foil, place(k:k), own), mean => heat%place_of_mean(pad%number), &
                     sleeve => heat%place_of_sleeve())
            gradient(mean, k) = gradient(mean, k) + slope(1)
            if (k == bump_surface) gradient(sleeve, k) = gradient(sleeve, k) + slope(1)
          end associate
        end associate
      end associate
    end do
  end subroutine add_stresses

  !> What a pad's gap does by the temperatures of shaft and sleeve.
  pure subroutine follow_growth(bearing, pad, by_gap, gradient)
    type(bearing_system_type), intent(in) :: bearing !! with heat
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
    type(bearing_system_type), intent(in) :: bearing !! with heat
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

  !> What a pad's gap does by the unknowns that move it: its foil's, or pressures, and the shaft's.
  pure subroutine follow_gap(bearing, pad, unknown, by_gap, gradient)
    type(bearing_system_type), intent(in) :: bearing
    type(pad_type), intent(in) :: pad
    real(wp), intent(in) :: unknown(:) !! the bearing's, in SI
    real(wp), intent(in) :: by_gap(:, :) !! (pad's nodes, numbers)
    real(wp), intent(inout) :: gradient(:, :) !! (bearing's unknowns, numbers)
    integer :: node, k

    if (bearing%heat%present) call follow_growth(bearing, pad, by_gap, gradient)
    if (bearing%heat%softens()) call follow_modulus(bearing, pad, unknown, by_gap, gradient)
    do node = 1, size(by_gap, 1)
      if (pad%foil%source(node) > 0) then
        associate (mine => gradient(pad%first + pad%foil%source(node), :))
          mine = mine + pad%foil%rate(node)*by_gap(node, :)
        end associate
      end if
      if (.not. bearing%floats) cycle
      do k = 1, size(bearing%coordinate)
        associate (mine => gradient(bearing%first_shaft + k, :))
          mine = mine + pad%film%motion(bearing%coordinate(k), node)*by_gap(node, :)
        end associate
      end do
    end do
  end subroutine follow_gap
end module gfb_answer_numbers
