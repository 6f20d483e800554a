!> Heat that the gas of orifices carries into the films and back, for answers and their derivatives.
module gfb_orifice_heat
  use gfb_kinds, only: wp
  use gfb_bearing, only: bearing_type, bearing_state_type
  use gfb_fed_state, only: line_point_type, line_point, state_of_mouth
  use gfb_film_feed, only: mouth_state_type, mouth_pressure, mouth_gap
  use gfb_heated_supply, only: supply_heat
  implicit none (type, external)
  private
  public :: orifice_heat, add_orifice_heat_rates

contains

  !> Heat that orifices bring into each pad over gas as it is drawn in, this rank's share; mirrored and turned copies with it [W].
  function orifice_heat(bearing, state) result(heat)
    class(bearing_type), intent(in) :: bearing !! with heat and orifices
    type(bearing_state_type), intent(in) :: state !! of it
    real(wp) :: heat(size(bearing%pad))
    real(wp) :: by_unknown(bearing%local_size()), by_gap(bearing%film_nodes())

    by_unknown = 0.0_wp
    by_gap = 0.0_wp
    call add_orifice_heat_rates(bearing, state, heat, by_unknown, by_gap)
  end function orifice_heat

  !> That heat, and adds its derivatives by the local unknowns and by the gaps at lines.
  subroutine add_orifice_heat_rates(bearing, state, heat, by_unknown, by_gap)
    class(bearing_type), intent(in) :: bearing !! with heat and orifices
    type(bearing_state_type), intent(in) :: state !! of it
    real(wp), intent(out) :: heat(:) !! of each pad [W]
    real(wp), intent(inout) :: by_unknown(:) !! the gap staying [W]
    real(wp), intent(inout) :: by_gap(:) !! at all film nodes [W/m]
    type(mouth_state_type) :: here
    type(line_point_type) :: point
    real(wp) :: by_flow
    integer :: j, i

    heat = 0.0_wp
    associate (feed => bearing%feed)
      do j = 1, size(feed%mouth)
        here = state_of_mouth(bearing, j, state)
        associate (mouth => feed%mouth(j))
          call add_shares(mouth%pad, mouth%node, mouth%part*mouth%weight, here%flow)
        end associate
        associate (pressure => by_unknown(feed%place(j, mouth_pressure)), gap => by_unknown(feed%place(j, mouth_gap)))
          pressure = pressure + by_flow*here%flow_by_pressure*feed%size(mouth_pressure)
          gap = gap + by_flow*here%flow_by_gap*feed%size(mouth_gap)
        end associate
      end do
      do j = 1, size(feed%line)
        associate (line => feed%line(j), pad => bearing%pad(feed%line(j)%pad))
          do i = 1, size(line%orifices)
            point = line_point(bearing, j, i, state)
            call add_shares(line%pad, line%node, line%shape(:, i)*line%orifices(i), point%flow)
            by_unknown(pad%first + line%node) = by_unknown(pad%first + line%node) + by_flow*point%by_pressure*line%shape(:, i)
            by_gap(pad%first_node + line%node) = by_gap(pad%first_node + line%node) + by_flow*point%by_gap*line%shape(:, i)
            associate (shaft => by_unknown(bearing%first_shaft + 1:))
              shaft = shaft + by_flow*point%by_gap*line%motion_excess(bearing%coordinate, i)
            end associate
          end do
        end associate
      end do
    end associate

  contains

    !> What nodes get of a flow.
    subroutine add_shares(pad, node, share, flow)
      integer, intent(in) :: pad, node(:)
      real(wp), intent(in) :: share(:) !! of each node [1]
      real(wp), intent(in) :: flow     !! [Pa m3/s]
      real(wp) :: value, rate, by_film
      integer :: a

      by_flow = 0.0_wp
      associate (of => bearing%heat, film => bearing%pad(pad)%film)
        do a = 1, size(node)
          if (film%fixed(node(a))) cycle
          associate (gas => of%place_of_gas(pad, node(a)), part => film%copies*share(a))
            call supply_heat(of%gas, bearing%feed%temperature, of%ambient, flow, state%unknown(gas), value, rate, by_film)
            heat(pad) = heat(pad) + part*value
            by_flow = by_flow + part*rate
            by_unknown(gas) = by_unknown(gas) + part*by_film
          end associate
        end do
      end associate
    end subroutine add_shares
  end subroutine add_orifice_heat_rates
end module gfb_orifice_heat
