!> What is read off a film: forces without suction, drag, integrals, smallest gaps, Peclet numbers.
module gfb_film_measures
  use gfb_kinds, only: wp
  use gfb_film_surface, only: translations
  use gfb_film_load, only: film_forces, film_force, film_friction, film_friction_rates
  use gfb_general_film, only: general_friction, general_friction_rates, general_peclet
  use gfb_groove_film, only: groove_type, groove_friction, groove_friction_rates
  use gfb_film_flow, only: film_flow_type, flow_here
  use gfb_operating_point, only: operating_point_type
  use gfb_gas_film, only: gas_film_type
  implicit none (type, external)
  private
  public :: force_without_suction, film_drag, film_drag_rates, film_moment, square_integrals, &
            film_peclet, film_midplane_gap, pressure_moments

  integer, parameter :: corners = 4 !! of a cell

contains

  !> This rank's share of force and torque where the pressure is above ambient only [N], [N m].
  pure function force_without_suction(film, pressure) result(force)
    type(gas_film_type), intent(in) :: film !! this rank's share of it
    real(wp), intent(in) :: pressure(:) !! at the nodes [Pa]
    real(wp) :: force(film_forces)
    integer :: element

    force = 0.0_wp
    do element = 1, size(film%element_nodes, 2)
      associate (nodes => film%element_nodes(:, element))
        force = force + film%copies*film_force(film%geometry(element), &
                                               film%point_motion(:, :, element), &
                                               pressure(nodes) - film%ambient_pressure)
      end associate
    end do
    if (film%copies > 1.0_wp) force(translations + 1:) = 0.0_wp
  end function force_without_suction

  !> This rank's share of the drag on the shaft [N].
  pure real(wp) function film_drag(film, pressure, gap, point) result(drag)
    type(gas_film_type), intent(in) :: film !! this rank's share of it
    real(wp), intent(in) :: pressure(:) !! at the nodes [Pa]
    real(wp), intent(in) :: gap(:)      !! at the nodes [m]
    type(operating_point_type), intent(in) :: point !! operating point
    type(film_flow_type) :: flow
    integer :: element

    drag = 0.0_wp
    flow = film%flow_at(point)
    do element = 1, size(film%element_nodes, 2)
      associate (nodes => film%element_nodes(:, element))
        drag = drag + film%copies*element_drag(film, flow, element, pressure(nodes), &
                                               film%element_gap(element, pressure, gap), &
                                               film%excess(element, point))
      end associate
    end do
  end function film_drag

  !> An element's drag on the shaft [N].
  pure real(wp) function element_drag(film, flow, element, pressure, gap, excess) result(drag)
    type(gas_film_type), intent(in) :: film
    type(film_flow_type), intent(in) :: flow
    integer, intent(in) :: element
    real(wp), intent(in) :: pressure(:), gap(:) !! at its nodes [Pa], [m]
    real(wp), intent(in) :: excess(:)           !! of the gap at its points, the first ones [m]
    type(groove_type) :: groove

    groove = film%groove_of(element)
    if (groove%share > 0.0_wp) then
      drag = groove_friction(film%geometry(element), flow, film%law, groove, pressure, gap, &
                             excess(:size(gap)))
    else if (film%law%plain) then
      drag = film_friction(film%geometry(element), flow, pressure, gap, excess(:size(gap)))
    else
      drag = general_friction(film%geometry(element), flow, film%law, pressure, gap, &
                              excess(:size(gap)), film%factors_of(element))
    end if
  end function element_drag

  !> This rank's shares of the derivatives of the drag by the nodes' pressures and gaps.
  pure subroutine film_drag_rates(film, pressure, gap, point, by_pressure, by_gap)
    type(gas_film_type), intent(in) :: film !! this rank's share of it
    real(wp), intent(in) :: pressure(:) !! at the nodes [Pa]
    real(wp), intent(in) :: gap(:)      !! at the nodes [m]
    type(operating_point_type), intent(in) :: point !! operating point
    real(wp), intent(out) :: by_pressure(:) !! [N/Pa]
    real(wp), intent(out) :: by_gap(:)      !! [N/m]
    real(wp), dimension(size(film%element_nodes, 1)) :: h, excess, of_pressure, of_gap
    type(film_flow_type) :: flow
    type(groove_type) :: groove
    integer :: element

    by_pressure = 0.0_wp
    by_gap = 0.0_wp
    flow = film%flow_at(point)
    do element = 1, size(film%element_nodes, 2)
      associate (nodes => film%element_nodes(:, element), geometry => film%geometry(element))
        h = film%element_gap(element, pressure, gap)
        associate (p => pressure(nodes), every => film%excess(element, point))
          excess = every(:size(excess))
          groove = film%groove_of(element)
          if (groove%share > 0.0_wp) then
            call groove_friction_rates(geometry, flow, film%law, groove, p, h, excess, &
                                       of_pressure, of_gap)
          else if (film%law%plain) then
            call film_friction_rates(geometry, flow, p, h, excess, of_pressure, of_gap)
          else
            call general_friction_rates(geometry, flow, film%law, p, h, excess, of_pressure, &
                                        of_gap, film%factors_of(element))
          end if
        end associate
        by_pressure(nodes) = by_pressure(nodes) + film%copies*(of_pressure + &
                                                               film%softness_of(element)*of_gap)
        by_gap(nodes) = by_gap(nodes) + film%copies*of_gap
      end associate
    end do
  end subroutine film_drag_rates

  !> This rank's share of the integral of a nodal field over the bearing's surface [m2] times it,
  !> where what it does counts by its radius: torque over the radius R of the surface.
  pure real(wp) function film_moment(film, value) result(integral)
    type(gas_film_type), intent(in) :: film !! this rank's share of it
    real(wp), intent(in) :: value(:) !! at the local film nodes, in any unit [SI]
    integer :: element

    integral = 0.0_wp
    do element = 1, size(film%element_nodes, 2)
      associate (here => value(film%element_nodes(:, element)), geometry => film%geometry(element))
        integral = integral + film%copies*dot_product(matmul(here, film%shape), &
                                                      geometry%area*geometry%stretch)
      end associate
    end do
  end function film_moment

  !> This rank's shares of the integrals of p - p_a, of that times s, and times theta, over the
  !> solved surface.
  pure function pressure_moments(film, pressure) result(integrals)
    type(gas_film_type), intent(in) :: film !! this rank's share of it
    real(wp), intent(in) :: pressure(:) !! at the nodes [Pa]
    real(wp) :: integrals(3) !! [N], [N m], [N rad]
    real(wp) :: load(size(film%shape, 2))
    integer :: element

    integrals = 0.0_wp
    do element = 1, size(film%element_nodes, 2)
      associate (nodes => film%element_nodes(:, element))
        load = film%geometry(element)%area* &
          matmul(pressure(nodes) - film%ambient_pressure, film%shape)
        integrals = integrals + [sum(load), dot_product(load, matmul(film%axial(nodes), &
                                 film%shape)), dot_product(load, matmul(film%angle(nodes), &
                                                                        film%shape))]
      end associate
    end do
  end function pressure_moments

  !> This rank's shares of the integral of a nodal field's square over the solved surface, and of
  !> its area [m2].
  pure function square_integrals(film, value) result(integrals)
    type(gas_film_type), intent(in) :: film !! this rank's share of it
    real(wp), intent(in) :: value(:) !! at the nodes, in any unit [SI]
    real(wp) :: integrals(2)
    integer :: element

    integrals = 0.0_wp
    do element = 1, size(film%element_nodes, 2)
      associate (nodes => film%element_nodes(:, element), area => film%geometry(element)%area)
        integrals = integrals + [dot_product(matmul(value(nodes), film%shape)**2, area), sum(area)]
      end associate
    end do
  end function square_integrals

  !> Largest cell Peclet number of this rank, where the gap changes by a share of itself [1].
  pure real(wp) function film_peclet(film, point, pressure, gap, change) result(peclet)
    type(gas_film_type), intent(in) :: film !! this rank's share of it
    type(operating_point_type), intent(in) :: point !! whose speed counts
    real(wp), intent(in) :: pressure(:) !! at the nodes [Pa]
    real(wp), intent(in) :: gap(:)      !! at the nodes [m]
    real(wp), intent(in) :: change      !! least change of the gap in a cell, over the gap [1]
    type(film_flow_type) :: flow
    integer :: element, i

    peclet = 0.0_wp
    flow = film%flow_at(point)
    do element = 1, size(film%element_nodes, 2)
      associate (nodes => film%element_nodes(:, element), geometry => film%geometry(element), &
                 factors => film%factors_of(element))
        if (maxval(gap(nodes)) - minval(gap(nodes)) < change*minval(gap(nodes))) cycle
        do i = 1, size(film%shape, 2)
          peclet = max(peclet, abs(general_peclet(film%law, flow_here(flow, geometry%stretch(i)), &
                                                  geometry%stream_length(i), &
                                                  dot_product(film%shape(:, i), pressure(nodes)), &
                                                  dot_product(film%shape(:, i), gap(nodes)), &
                                                  factors(i))))
        end do
      end associate
    end do
  end function film_peclet

  !> Smallest gap of this rank at z = 0, between nodes where none stands there [m].
  pure real(wp) function film_midplane_gap(film, gap) result(smallest)
    type(gas_film_type), intent(in) :: film !! this rank's share of it
    real(wp), intent(in) :: gap(:) !! at the nodes [m]
    real(wp) :: share
    integer :: cell, a, b

    smallest = huge(1.0_wp)
    do cell = 1, size(film%cell_nodes, 2)
      associate (nodes => film%cell_nodes(:, cell))
        do a = 1, corners
          b = modulo(a, corners) + 1
          associate (z_a => film%axial(nodes(a)), z_b => film%axial(nodes(b)))
            if (z_a*z_b > 0.0_wp .or. abs(z_b - z_a) <= 0.0_wp) cycle
            share = z_a/(z_a - z_b)
            smallest = min(smallest, (1.0_wp - share)*gap(nodes(a)) + share*gap(nodes(b)))
          end associate
        end do
      end associate
    end do
  end function film_midplane_gap
end module gfb_film_measures
