#include "gfb_petsc.h"
!> Temperatures of a bearing, and where its heat goes, over all ranks.
module gfb_heat_answer
  use petscvec
  use gfb_kinds, only: wp
  use gfb_petsc_session, only: sum_over_ranks, largest_over_ranks
  use gfb_heated_film, only: heated_residual, heated_shear, mean_over_gap, heated_state_type, heated_rows, row_foil, row_shaft, field_gas, &
                             field_foil, field_gap, field_shaft
  use gfb_bearing_heat, only: film_heat_type, growth_of, moduli_at
  use gfb_gap_part, only: shift_of
  use gfb_film_flow, only: film_flow_type
  use gfb_film_heat, only: state_of, channel_places, feed, is_leading, is_trailing
  use gfb_heated_supply, only: wall_heat
  use gfb_operating_point, only: operating_point_type
  use gfb_pad, only: pad_type
  implicit none (type)
  private
  public :: heat_answer

  integer, parameter :: sums = 16 !! over elements and nodes of a pad
  !> of the gas that is fed, by which an imbalance is measured at least: at rest nothing else may be there [K]
  real(wp), parameter :: least_rise = 1.0_wp

  !> What one pad, or all together, say of heat.
  type, public :: heat_share_type
    real(wp) :: film_temperature = 0.0_wp         !! mean over the gas in the gap [K]
    real(wp) :: maximum_film_temperature = 0.0_wp !! mean over the gap, at the nodes [K]
    real(wp) :: top_foil_temperature = 0.0_wp     !! mean [K]
    real(wp) :: maximum_top_foil_temperature = 0.0_wp !! [K]
    real(wp) :: inlet_temperature = 0.0_wp        !! of the gas that feeds the slit [K]
    real(wp) :: power = 0.0_wp                    !! of the film's drag [W]
    real(wp) :: to_shaft = 0.0_wp, to_top_foil = 0.0_wp !! out of the film [W]
    real(wp) :: through_bumps = 0.0_wp, to_channel = 0.0_wp !! out of the top foil [W]
    real(wp) :: by_gas = 0.0_wp                   !! carried out over edges less carried in [W]
    real(wp) :: by_supply = 0.0_wp                !! that gas which is fed in brings, over gas that is drawn in [W]
    real(wp) :: leading = 0.0_wp, trailing = 0.0_wp, sides = 0.0_wp !! flow in, out, out [kg/s]
    real(wp) :: area = 0.0_wp, mean_gap = 0.0_wp !! of the film [m2], [m]
    real(wp) :: modulus(2) = 1.0_wp !! of top foil and bumps over the typed ones; of all pads the mean [1]
  end type heat_share_type

  !> All that is said of heat.
  type, public :: heat_answer_type
    logical :: present = .false.
    type(heat_share_type) :: whole
    type(heat_share_type), allocatable :: pad(:)
    real(wp) :: shaft_temperature = 0.0_wp, sleeve_temperature = 0.0_wp !! mean [K]
    logical :: is_fed = .false.
    logical :: has_cooling = .false.
    real(wp) :: cooling_outlet_temperature = 0.0_wp !! [K]
    real(wp) :: running_clearance = 0.0_wp          !! C less all growth, mean [m]
    real(wp) :: preload = 0.0_wp                    !! m C of the pads, and interference of assembly [m]
    real(wp) :: imbalance = 0.0_wp                  !! power and heat of the supply less all heat, over the larger [1]
    logical :: softens = .false.                    !! the modulus of foils follows their temperature
    logical :: top_foil_bends = .false.             !! then: that of the top foil counts, too
    logical :: off_table = .false.                  !! some foil is hotter or colder than its table
  end type heat_answer_type

contains

  !> Reads the heat off a state.
  function heat_answer(heat, pads, point, unknown, gap, flow, fed) result(answer)
    type(film_heat_type), intent(in) :: heat !! of the bearing
    type(pad_type), intent(in) :: pads(:)    !! of it
    type(operating_point_type), intent(in) :: point !! with the shaft's position
    real(wp), intent(in) :: unknown(:) !! the bearing's local ones [SI]
    real(wp), intent(in) :: gap(:)     !! at all film nodes [m]
    real(wp), intent(in) :: flow(:)    !! at each local unknown of a pressure, what all ranks' elements take there [Pa m3/s]
    real(wp), intent(in), optional :: fed(:) !! where films are fed: heat by this rank's orifices of each pad [W]
    type(heat_answer_type) :: answer
    real(wp) :: sum_of(sums, size(pads)), most(2, size(pads))
    integer :: i

    do i = 1, size(pads)
      associate (h => gap(pads(i)%first_node + 1:pads(i)%last_node))
        call read_pad(heat, pads(i), point, unknown, h, flow, present(fed), sum_of(:, i), most(:, i))
      end associate
    end do
    if (present(fed)) sum_of(16, :) = sum_of(16, :) + fed
    sum_of = reshape(sum_over_ranks(reshape(sum_of, [size(sum_of)])), shape(sum_of))
    most = reshape(largest_over_ranks(reshape(most, [size(most)])), shape(most))
    answer%present = .true.
    answer%is_fed = present(fed)
    answer%pad = [(share_of(sum_of(:, i), most(:, i), unknown(heat%place_of_slit(i))), i=1, size(pads))]
    answer%whole = share_of(sum(sum_of, 2), maxval(most, 2), sum(answer%pad%inlet_temperature)/real(size(pads), wp))
    if (heat%softens()) call read_moduli(heat, point, unknown, answer)
    answer%top_foil_bends = pads(1)%foil%is_meshed()
    associate (all => sum(sum_of, 2))
      answer%shaft_temperature = all(13)/all(3)
      answer%running_clearance = pads(1)%film%clearance - all(14)/all(3)
      answer%preload = norm2(shift_of(pads(1)%film%part, [0.0_wp, 0.0_wp])) + pads(1)%film%interference()
    end associate
    answer%sleeve_temperature = unknown(heat%place_of_sleeve())
    answer%has_cooling = heat%channels > 0
    if (answer%has_cooling) answer%cooling_outlet_temperature = unknown(heat%place_of_channel(heat%channels))
    associate (whole => answer%whole)
      answer%imbalance = (whole%power - whole%to_shaft - whole%to_top_foil - whole%by_gas)/max(whole%power, tiny(1.0_wp))
      if (answer%is_fed) answer%imbalance = (whole%power + whole%by_supply - whole%to_shaft - whole%to_top_foil - whole%by_gas)/ &
                                            max(whole%power, abs(whole%by_supply), abs(whole%by_gas), least_rise*heat%gas%specific_heat* &
                                                abs(whole%trailing + whole%sides - whole%leading), tiny(1.0_wp))
    end associate
  end function heat_answer

  !> What the temperatures leave of the foils' moduli.
  pure subroutine read_moduli(heat, point, unknown, answer)
    type(film_heat_type), intent(in) :: heat
    type(operating_point_type), intent(in) :: point
    real(wp), intent(in) :: unknown(:)
    type(heat_answer_type), intent(inout) :: answer !! with its pads
    real(wp) :: rate(2)
    integer :: i

    answer%softens = .true.
    answer%whole%modulus = 0.0_wp
    associate (sleeve => unknown(heat%place_of_sleeve()))
      do i = 1, size(answer%pad)
        call moduli_at(heat, i, point%growth, unknown, answer%pad(i)%modulus, rate)
        answer%whole%modulus = answer%whole%modulus + answer%pad(i)%modulus/real(size(answer%pad), wp)
        associate (foil => unknown(heat%place_of_mean(i)))
          answer%off_table = answer%off_table .or. .not. (heat%modulus%covers(foil) .and. heat%modulus%covers(0.5_wp*(foil + sleeve)))
        end associate
      end do
    end associate
  end subroutine read_moduli

  !> This rank's sums and largest values of a pad.
  subroutine read_pad(heat, pad, point, unknown, gap, flow, fed, sum_of, most)
    type(film_heat_type), intent(in) :: heat
    type(pad_type), intent(in) :: pad
    type(operating_point_type), intent(in) :: point
    real(wp), intent(in) :: unknown(:), gap(:), flow(:)
    logical, intent(in) :: fed !! then what flows over edges is no balance of its own: gas as it is drawn in carries no heat
    real(wp), intent(out) :: sum_of(sums) !! see `share_of`; mean of the shaft and of growth, times the area
    real(wp), intent(out) :: most(:)      !! temperatures of film and top foil [K]
    type(heated_state_type) :: state
    real(wp) :: share(size(pad%film%shape, 1), heated_rows), weight(size(pad%film%shape, 1)), growth(size(gap))
    real(wp), dimension(size(share, 1)) :: mean, foil, channel, by_pressure, by_gas
    real(wp) :: none, supplied
    type(film_flow_type) :: here
    integer :: element, node, n

    n = size(share, 1)
    sum_of = 0.0_wp
    most = 0.0_wp
    none = merge(heat%ambient, 0.0_wp, fed)
    growth = growth_of(heat, pad%mesh%mesh_node, pad%whole%rows(), point, unknown)
    here = pad%film%flow_at(point)
    channel = heat%cooling_temperature
    associate (film => pad%film, sleeve => unknown(heat%place_of_sleeve()))
      do element = 1, size(film%element_nodes, 2)
        associate (nodes => film%element_nodes(:, element), geometry => film%geometry(element))
          state = state_of(heat, pad, element, point, unknown, gap)
          call heated_residual(geometry, here, heat%gas, state, share)
          foil = state%field(:n, field_foil)
          mean = mean_over_gap(state%field(:n, field_gas), foil, state%field(:n, field_shaft))
          if (heat%channels > 0) channel = unknown(channel_places(heat, pad, nodes))
          weight = film%copies*matmul(film%shape, geometry%area)
          associate (gas => film%copies*matmul(film%shape, geometry%area*(matmul(state%field(:n, field_gap), film%shape) + state%excess(:n))))
            sum_of(:3) = sum_of(:3) + [dot_product(gas, mean), sum(gas), sum(weight)]
          end associate
          sum_of(4) = sum_of(4) + dot_product(weight, foil)
          sum_of(5:7) = sum_of(5:7) + film%copies*[heated_shear(geometry, here, heat%gas, state, n), &
                                                   sum(share(:, row_shaft)), sum(share(:, row_foil))]
          sum_of(8) = sum_of(8) + heat%bumps*dot_product(weight, foil - sleeve)
          if (heat%channels > 0) sum_of(9) = sum_of(9) + heat%channel*dot_product(weight, foil - channel)
          sum_of(13:14) = sum_of(13:14) + [dot_product(weight, state%field(:n, field_shaft)), dot_product(weight, growth(nodes))]
          most = max(most, [maxval(mean), maxval(foil)])
          if (.not. film%wall%present) cycle
          call wall_heat(geometry, heat%gas, state, none, supplied, by_pressure, by_gas)
          sum_of(16) = sum_of(16) + film%copies*supplied
        end associate
      end do
      do node = 1, size(film%fixed)
        if (.not. (film%fixed(node) .and. pad%mesh%owned(node))) cycle
        associate (inflow => film%copies*heat%gas%density*flow(pad%first + node))
          sum_of(10) = sum_of(10) - heat%gas%specific_heat*inflow* &
                          (merge(feed(heat, pad, node, unknown), unknown(heat%place_of_gas(pad%number, node)), inflow > 0.0_wp) - none)
          if (is_leading(pad, node)) then
            sum_of(11) = sum_of(11) + inflow
          else if (is_trailing(pad, node)) then
            sum_of(12) = sum_of(12) - inflow
          else
            sum_of(15) = sum_of(15) - inflow
          end if
        end associate
      end do
    end associate
  end subroutine read_pad

  !> A share from its sums.
  pure type(heat_share_type) function share_of(sum_of, most, inlet) result(share)
    real(wp), intent(in) :: sum_of(:), most(:)
    real(wp), intent(in) :: inlet !! temperature [K]

    share = heat_share_type(film_temperature=sum_of(1)/sum_of(2), maximum_film_temperature=most(1), &
                            top_foil_temperature=sum_of(4)/sum_of(3), maximum_top_foil_temperature=most(2), &
                            inlet_temperature=inlet, power=sum_of(5), to_shaft=sum_of(6), to_top_foil=sum_of(7), &
                            through_bumps=sum_of(8), to_channel=sum_of(9), by_gas=sum_of(10), by_supply=sum_of(16), leading=sum_of(11), &
                            trailing=sum_of(12), sides=sum_of(15), area=sum_of(3), mean_gap=sum_of(2)/sum_of(3))
  end function share_of
end module gfb_heat_answer
