#include "gfb_petsc.h"
!> Numbers of an answer as functions of its unknowns and of the bearing, and their derivatives by the unknowns.
!>
!> The smallest gap and the extreme pressures are those of the nodes where they are at the answer.
module gfb_answer_numbers
  use gfb_kinds, only: wp
  use gfb_petsc_session, only: this_rank, sum_over_ranks, largest_over_ranks
  use gfb_film_load, only: film_forces
  use gfb_film_surface, only: journal_motions, journal_coordinates
  use gfb_gas_film, only: film_drag, film_drag_rates, film_moment
  use gfb_solid_contact, only: contact_pressure_rate
  use gfb_operating_point, only: operating_point_type
  use gfb_pad, only: pad_type
  use gfb_bearing_system, only: bearing_system_type
  implicit none (type)
  private
  public :: find_extremes, measure, measure_gradient

  integer, parameter, public :: place_e = 1, place_force = 3, place_torque = 7, place_speed = 8 !! first numbers of each kind
  integer, parameter, public :: place_extremes = 9, numbers = 11
  integer, parameter :: extremes = 3 !! smallest gap, largest and smallest pressure

  !> The film nodes of extreme values, 0 on all ranks but one.
  type, public :: extreme_nodes_type
    integer :: node(extremes) = 0
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

  !> The nodes of the smallest gap and of the largest and smallest pressure at the present state.
  subroutine find_extremes(bearing, where_they_are)
    type(bearing_system_type), intent(in) :: bearing !! at an answer
    type(extreme_nodes_type), intent(out) :: where_they_are !! on this rank
    real(wp) :: unknown(bearing%local_size()), value(bearing%film_nodes(), extremes), most(extremes), here(extremes)
    integer :: i

    call bearing%get_unknowns(unknown)
    value(:, 1) = -bearing%gap(unknown)
    value(:, 2) = bearing%film_pressure(unknown)
    value(:, 3) = -value(:, 2)
    here = maxval(value, 1)
    most = largest_over_ranks(here)
    ! one of those ranks that have the node
    here = largest_over_ranks(merge(real(this_rank() + 1, wp), 0.0_wp, here >= most))
    do i = 1, extremes
      if (nint(here(i)) == this_rank() + 1) where_they_are%node(i) = maxloc(value(:, i), 1)
    end do
  end subroutine find_extremes

  !> Eccentricity [m], forces and torques on the sleeve [N], [N m], friction torque [N m], speed [rad/s], the values
  !> at the extreme nodes [m], [Pa].
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
    number(place_force:place_torque - 1) = force(journal_coordinates)
    do i = 1, size(bearing%pad)
      associate (pad => bearing%pad(i), first => bearing%pad(i)%first_node + 1, last => bearing%pad(i)%last_node)
        number(place_torque) = number(place_torque) + pad%film%surface%radius* &
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
    number = sum_over_ranks(number)
    number(place_e:place_e + 1) = here%place(:2)
    number(place_speed) = point%speed
  end function measure

  !> This rank's shares of the derivatives of these numbers by the local unknowns, at the present state and point.
  subroutine measure_gradient(bearing, nodes, gradient)
    type(bearing_system_type), intent(in) :: bearing !! at an answer
    type(extreme_nodes_type), intent(in) :: nodes !! of extreme values
    real(wp), intent(out) :: gradient(:, :) !! (local unknowns, numbers) [SI]
    real(wp) :: unknown(bearing%local_size()), gap(bearing%film_nodes()), by_gap(bearing%film_nodes(), numbers)
    integer :: i

    call bearing%get_unknowns(unknown)
    gap = bearing%gap(unknown)
    gradient = 0.0_wp
    by_gap = 0.0_wp
    if (bearing%floats .and. bearing%last_rank) then
      do i = 1, 2
        gradient(bearing%first_shaft + i, place_e + i - 1) = 1.0_wp
      end do
    end if
    do i = 1, size(bearing%pad)
      associate (pad => bearing%pad(i), first => bearing%pad(i)%first_node + 1, last => bearing%pad(i)%last_node)
        call add_forces(pad, gap(first:last), gradient(pad%first + 1:pad%last, :), by_gap(first:last, :))
        call add_drag(bearing, pad, unknown, gap(first:last), gradient, by_gap(first:last, :))
      end associate
    end do
    call add_extremes(bearing, nodes, gradient, by_gap)
    do i = 1, size(bearing%pad)
      call follow_gap(bearing, bearing%pad(i), by_gap(bearing%pad(i)%first_node + 1:bearing%pad(i)%last_node, :), gradient)
    end do
  end subroutine measure_gradient

  !> Forces and torques: weights of the pressures, those of the asperities by the gap.
  pure subroutine add_forces(pad, gap, by_unknown, by_gap)
    type(pad_type), intent(in) :: pad
    real(wp), intent(in) :: gap(:) !! at its nodes [m]
    real(wp), intent(inout) :: by_unknown(:, :), by_gap(:, :) !! (pad's unknowns or nodes, numbers)
    integer :: k

    do k = 1, journal_motions
      associate (weight => pad%film%force_weight(journal_coordinates(k), :))
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
    real(wp) :: by_pressure(size(gap)), by_node(size(gap)), area(size(gap)), step
    type(operating_point_type) :: ahead, behind
    integer :: k

    associate (film => pad%film, pressure => unknown(pad%first + 1:pad%first + size(gap)))
      call film_drag_rates(film, pressure, gap, bearing%position(unknown), by_pressure, by_node)
      associate (mine => gradient(pad%first + 1:pad%first + size(gap), place_torque))
        mine = mine + film%surface%radius*by_pressure
      end associate
      area = nodal_areas(pad)
      by_gap(:, place_torque) = film%surface%radius*(by_node + pad%contact%friction*area*contact_pressure_rate(pad%contact, gap))
      if (.not. bearing%floats) return
      step = part*film%clearance
      do k = 1, 2
        ahead = bearing%position(unknown)
        behind = ahead
        ahead%place(k) = ahead%place(k) + step
        behind%place(k) = behind%place(k) - step
        associate (by_shaft => gradient(bearing%first_shaft + k, place_torque))
          by_shaft = by_shaft + film%surface%radius*(film_drag(film, pressure, gap, ahead) &
                                             - film_drag(film, pressure, gap, behind))/(2.0_wp*step)
        end associate
      end do
    end associate
  end subroutine add_drag

  !> Weights of a field's nodal values in `film_moment`, this rank's share [m2].
  pure function nodal_areas(pad) result(area)
    type(pad_type), intent(in) :: pad
    real(wp) :: area(size(pad%film%angle))
    integer :: element

    area = 0.0_wp
    do element = 1, size(pad%film%element_nodes, 2)
      associate (nodes => pad%film%element_nodes(:, element), geometry => pad%film%geometry(element))
        area(nodes) = area(nodes) + pad%film%copies*matmul(pad%film%shape, geometry%area*geometry%stretch)
      end associate
    end do
  end function nodal_areas

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

  !> What a pad's gap does by the unknowns that move it: its foil's, or pressures, and the shaft's.
  pure subroutine follow_gap(bearing, pad, by_gap, gradient)
    type(bearing_system_type), intent(in) :: bearing
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
      do k = 1, 2
        associate (mine => gradient(bearing%first_shaft + k, :))
          mine = mine + pad%film%motion(k, node)*by_gap(node, :)
        end associate
      end do
    end do
  end subroutine follow_gap
end module gfb_answer_numbers
