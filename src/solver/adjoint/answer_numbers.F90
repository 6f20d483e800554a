#include "gfb_petsc.h"
!> Numbers of an answer as functions of its unknowns and of the bearing, and their derivatives by the unknowns.
!>
!> The smallest gap and the extreme pressures are those of the nodes where they are at the answer, the largest stresses of the foils
!> those of the elements.
module gfb_answer_numbers
  use gfb_kinds, only: wp
  use gfb_petsc_session, only: this_rank, sum_over_ranks, largest_over_ranks
  use gfb_film_load, only: film_forces
  use gfb_film_surface, only: film_surface_type, translations
  use gfb_film_measures, only: film_drag, film_drag_rates, film_moment
  use gfb_operating_point, only: operating_point_type
  use gfb_pad, only: pad_type
  use gfb_bearing, only: bearing_type
  use gfb_bearing_heat, only: moduli_at, softens_with_sleeve
  use gfb_heat_numbers, only: heat_numbers
  use gfb_largest_stress, only: surfaces, stress_place_type, find_largest_stress, stress_at, add_stress_rates
  implicit none (type)
  private
  public :: find_extremes, measure, measure_gradient, numbers_of

  integer, parameter, public :: place_e = 1, place_force = 3, place_torque = 7, place_speed = 8 !! first numbers of each kind
  !> those of blocks of equations are the last ones, 0 of blocks that are not there
  integer, parameter, public :: place_extremes = 9, place_stress = 12, place_blocks = place_stress + surfaces, &
                                numbers = place_blocks - 1 + heat_numbers
  integer, parameter :: forces = place_torque - place_force
  integer, parameter :: extremes = 3 !! smallest gap, largest and smallest pressure

  !> The film nodes of extreme values, 0 on all ranks but one; those of fields of blocks behind those of gap and pressure.
  type, public :: extreme_nodes_type
    integer, allocatable :: node(:)
    type(stress_place_type) :: stress(surfaces) !! of each surface's largest stress; pad 0 where it is not asked for
  end type extreme_nodes_type

  !> How a surface of a pad's foils moves.
  type :: known_motion_type
    real(wp), allocatable :: moved(:, :, :) !! (5, local nodes, motions) [m], [rad]
  end type known_motion_type

  !> An answer at which equations with other keys are evaluated.
  type, public :: known_answer_type
    real(wp), allocatable :: unknown(:) !! local ones, in SI
    type(extreme_nodes_type) :: nodes   !! of extreme values
    !> (surfaces, pads) where foils are meshed: first the answer's own motion, then the adjoints of all quantities
    type(known_motion_type), allocatable :: motion(:, :)
  end type known_answer_type

contains

  !> The nodes of the smallest gap and of the largest and smallest pressure at the present state, the elements of the largest stresses.
  subroutine find_extremes(bearing, stresses, where_they_are)
    class(bearing_type), intent(in) :: bearing !! at an answer
    logical, intent(in) :: stresses !! are looked for
    type(extreme_nodes_type), intent(out) :: where_they_are !! on this rank
    real(wp) :: unknown(bearing%local_size()), value(bearing%film_nodes(), extremes + sum(bearing%block%extremes))
    real(wp), dimension(size(value, 2)) :: most, here
    integer :: i, b, k

    call bearing%get_unknowns(unknown)
    value(:, 1) = -bearing%gap(unknown)
    value(:, 2) = bearing%film_pressure(unknown)
    value(:, 3) = -value(:, 2)
    i = extremes
    do b = 1, size(bearing%block)
      do k = 1, bearing%block(b)%extremes
        i = i + 1
        call bearing%block(b)%extreme_field(bearing, unknown, k, value(:, i))
      end do
    end do
    here = maxval(value, 1)
    most = largest_over_ranks(here)
    ! one of those ranks that have the node
    here = largest_over_ranks(merge(real(this_rank() + 1, wp), 0.0_wp, here >= most))
    allocate (where_they_are%node(size(here)), source=0)
    do i = 1, size(here)
      if (nint(here(i)) == this_rank() + 1) where_they_are%node(i) = maxloc(value(:, i), 1)
    end do
    if (stresses) call find_stresses(bearing, unknown, where_they_are%stress)
  end subroutine find_extremes

  !> The elements where the stresses of the foils are largest, on one rank each.
  subroutine find_stresses(bearing, unknown, stress)
    class(bearing_type), intent(in) :: bearing !! whose foils are meshed
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

  !> Eccentricity, or of a ring e_z and 0 [m], forces and torques, see `coordinates_of` [N], [N m], friction torque [N m], speed [rad/s], the values
  !> at the extreme nodes [m], [Pa], stresses of the foils [Pa], numbers of blocks.
  function measure(bearing, unknown, point, nodes) result(number)
    class(bearing_type), intent(in) :: bearing !! pads and shaft
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
    number(place_force:place_torque - 1) = force(coordinates_of(bearing%mesh%surface))
    do i = 1, size(bearing%pad)
      associate (pad => bearing%pad(i), first => bearing%pad(i)%first_node + 1, last => bearing%pad(i)%last_node)
        if (.not. any(bearing%block%has_film)) number(place_torque) = number(place_torque) + pad%film%surface%radius* &
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
    if (any(nodes%stress%pad > 0)) call measure_stresses(bearing, unknown, nodes%stress, number(place_stress:place_blocks - 1))
    number = sum_over_ranks(number)
    associate (of_force => coordinates_of(bearing%mesh%surface))
      number(place_e:place_e + 1) = here%place(of_force(:2))
    end associate
    number(place_speed) = point%speed
    call measure_blocks(bearing, here, unknown, gap, number)
  end function measure

  !> Numbers of all blocks, and their share in the friction torque.
  subroutine measure_blocks(bearing, here, unknown, gap, number)
    class(bearing_type), intent(in) :: bearing
    type(operating_point_type), intent(in) :: here !! with the shaft's position
    real(wp), intent(in) :: unknown(:) !! local, in SI
    real(wp), intent(in) :: gap(:) !! at all film nodes [m]
    real(wp), intent(inout) :: number(:)
    real(wp) :: own(heat_numbers + 1)
    integer :: b, first

    first = place_blocks
    do b = 1, size(bearing%block)
      associate (block => bearing%block(b))
        if (block%numbers == 0) cycle
        call block%measure(bearing, here, unknown, gap, own(:block%numbers + 1))
        number(first:first + block%numbers - 1) = own(:block%numbers)
        number(place_torque) = number(place_torque) + own(block%numbers + 1)
        first = first + block%numbers
      end associate
    end do
  end subroutine measure_blocks

  !> This rank's stresses at the places where they were largest.
  subroutine measure_stresses(bearing, unknown, place, stress)
    class(bearing_type), intent(in) :: bearing
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
    integer, allocatable :: motion(:)

    motion = surface%motions()
    coordinate = [motion(1), 2, 4, 5]
  end function coordinates_of

  !> This rank's shares of the derivatives of these numbers by the local unknowns, at the present state and point.
  subroutine measure_gradient(bearing, nodes, gradient)
    class(bearing_type), intent(in) :: bearing !! at an answer
    type(extreme_nodes_type), intent(in) :: nodes !! of extreme values
    real(wp), intent(out) :: gradient(:, :) !! (local unknowns, `numbers_of` the bearing) [SI]
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
        if (.not. any(bearing%block%has_film)) call add_drag(bearing, pad, unknown, gap(first:last), gradient, by_gap(first:last, :))
      end associate
    end do
    call add_block_rates(bearing, nodes, unknown, gap, gradient, by_gap)
    call add_extremes(bearing, nodes, gradient, by_gap)
    call add_stresses(bearing, nodes%stress, unknown, gradient(:, place_stress:place_blocks - 1))
    do i = 1, size(bearing%block)
      if (associated(bearing%block(i)%follow_gap)) call bearing%block(i)%follow_gap(bearing, unknown, by_gap, gradient)
    end do
    do i = 1, size(bearing%pad)
      call follow_gap(bearing, bearing%pad(i), by_gap(bearing%pad(i)%first_node + 1:bearing%pad(i)%last_node, :), gradient)
    end do
  end subroutine measure_gradient

  !> Numbers whose derivatives are not all zero: those of blocks that are not there are left out.
  pure integer function numbers_of(bearing)
    class(bearing_type), intent(in) :: bearing !! pads and shaft
    numbers_of = place_blocks - 1 + sum(bearing%block%numbers)
  end function numbers_of

  !> Derivatives of the numbers of all blocks; of the friction torque where a block has the films', with that of asperities.
  subroutine add_block_rates(bearing, nodes, unknown, gap, gradient, by_gap)
    class(bearing_type), intent(in) :: bearing
    type(extreme_nodes_type), intent(in) :: nodes !! of extreme values
    real(wp), intent(in) :: unknown(:) !! local, in SI
    real(wp), intent(in) :: gap(:)     !! at all film nodes [m]
    real(wp), intent(inout) :: gradient(:, :), by_gap(:, :) !! (unknowns or nodes, numbers)
    real(wp), allocatable :: own(:, :), own_by_gap(:, :)
    integer :: b, i, first, node

    first = place_blocks
    node = extremes
    do b = 1, size(bearing%block)
      associate (block => bearing%block(b), last => first + bearing%block(b)%numbers - 1)
        if (block%numbers == 0) cycle
        allocate (own(size(gradient, 1), block%numbers + 1), own_by_gap(size(by_gap, 1), block%numbers + 1))
        call block%add_number_rates(bearing, nodes%node(node + 1:node + block%extremes), unknown, gap, own, own_by_gap)
        gradient(:, first:last) = own(:, :block%numbers)
        by_gap(:, first:last) = own_by_gap(:, :block%numbers)
        gradient(:, place_torque) = gradient(:, place_torque) + own(:, block%numbers + 1)
        by_gap(:, place_torque) = by_gap(:, place_torque) + own_by_gap(:, block%numbers + 1)
        deallocate (own, own_by_gap)
        first = last + 1
        node = node + block%extremes
      end associate
    end do
    if (.not. any(bearing%block%has_film)) return
    do i = 1, size(bearing%pad)
      associate (pad => bearing%pad(i), first_node => bearing%pad(i)%first_node + 1, last_node => bearing%pad(i)%last_node)
        by_gap(first_node:last_node, place_torque) = by_gap(first_node:last_node, place_torque) + &
          pad%film%surface%radius*pad%contact%friction*nodal_levers(pad)*pad%solid_rate(gap(first_node:last_node))
      end associate
    end do
  end subroutine add_block_rates

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
        by_gap(:, place_force + k - 1) = weight*pad%solid_rate(gap)
      end associate
    end do
  end subroutine add_forces

  !> Friction torque of a pad's film and asperities. Between the nodes the rigid gap follows the shaft by itself.
  subroutine add_drag(bearing, pad, unknown, gap, gradient, by_gap)
    class(bearing_type), intent(in) :: bearing
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
      by_gap(:, place_torque) = film%surface%radius*(by_node + pad%contact%friction*area*pad%solid_rate(gap))
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

  !> The extreme values, on the rank that has their nodes.
  pure subroutine add_extremes(bearing, nodes, gradient, by_gap)
    class(bearing_type), intent(in) :: bearing
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
    class(bearing_type), intent(in) :: bearing
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
            if (softens_with_sleeve(k)) gradient(sleeve, k) = gradient(sleeve, k) + slope(1)
          end associate
        end associate
      end associate
    end do
  end subroutine add_stresses

  !> What a pad's gap does by the unknowns that move it: its foil's, or pressures, and the shaft's.
  pure subroutine follow_gap(bearing, pad, by_gap, gradient)
    class(bearing_type), intent(in) :: bearing
    type(pad_type), intent(in) :: pad
    real(wp), intent(in) :: by_gap(:, :) !! (pad's nodes, numbers)
    real(wp), intent(inout) :: gradient(:, :) !! (bearing's unknowns, numbers)
    integer :: node, k

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
