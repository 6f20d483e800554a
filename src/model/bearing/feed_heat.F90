#include "gfb_petsc.h"
!> Heat that orifices bring into films: what enters has the supply's temperature. And what temperatures do at mouths and lines: they
!> change how a film lets gas pass around a rim, and move the gap.
!>
!> Where gas enters at points of an element, node a gets \( c_p \dot m \sum_b B_{ab} (T_w - T_b) \) with the shares B of `mixing_type`,
!> whose sums are those by which the film's mass gets \( \dot m \): so energy closes to round-off. At nodes alone,
!> \( \dot m_a (T_w - T_a) \), it would close, too, but biquadratic elements have negative shares, and such nodes run away.
!> A porous wall's heat is a term of `gfb_heated_film`.
module gfb_feed_heat
  use petscmat
  use gfb_kinds, only: wp
  use gfb_petsc_kinds, only: pint
  use gfb_bearing, only: bearing_type, bearing_state_type
  use gfb_bearing_heat, only: row_of
  use gfb_fed_state, only: line_point_type, line_point, state_of_mouth, rim_resistances, numbers_of, number
  use gfb_feed_law, only: rim_balance
  use gfb_film_feed, only: mouth_state_type, mixing_type, add_mixing, mouth_unknowns, mouth_pressure, mouth_mean, mouth_gap
  use gfb_film_heat_rates, only: sinking_of, mean_of
  use gfb_pad_terms, only: add_block
  implicit none (type)
  private
  public :: add_supply_heat, add_supply_heat_rates

contains

  !> Adds the heat of what enters to the energy of the gas.
  subroutine add_supply_heat(bearing, state, residual)
    class(bearing_type), intent(in) :: bearing !! with heat and orifices
    type(bearing_state_type), intent(in) :: state !! of it
    real(wp), intent(inout) :: residual(:) !! of the local equations [SI]
    type(mouth_state_type) :: here
    type(line_point_type) :: point
    integer :: j, i, k

    associate (feed => bearing%feed)
      do j = 1, size(feed%mouth)
        here = state_of_mouth(bearing, j, state)
        associate (mouth => feed%mouth(j))
          do k = 1, size(mouth%mixing)
            call add_gain(mouth%pad, mouth%mixing(k), mouth%part*here%flow)
          end do
        end associate
      end do
      do j = 1, size(feed%line)
        do i = 1, size(feed%line(j)%orifices)
          point = line_point(bearing, j, i, state)
          call add_gain(feed%line(j)%pad, mixing_of_line(bearing, j, i), point%flow)
        end do
      end do
    end associate

  contains

    !> What an element's nodes get of a flow.
    subroutine add_gain(pad, mixing, flow)
      integer, intent(in) :: pad
      type(mixing_type), intent(in) :: mixing
      real(wp), intent(in) :: flow !! [Pa m3/s]
      real(wp) :: gain(size(mixing%node))
      integer :: gas(size(mixing%node))

      gas = bearing%heat%place_of_gas(pad, mixing%node)
      gain = gain_of(bearing, mixing, state%unknown(gas))
      residual(gas) = residual(gas) - max(flow, 0.0_wp)*gain
    end subroutine add_gain
  end subroutine add_supply_heat

  !> How a line's gas mixes with the film at one of its points.
  pure type(mixing_type) function mixing_of_line(bearing, j, i) result(mixing)
    class(bearing_type), intent(in) :: bearing
    integer, intent(in) :: j, i !! piece of a line, its point

    associate (line => bearing%feed%line(j))
      mixing%node = line%node
      mixing%share = spread(0.0_wp*line%shape(:, i), 2, size(line%node))
      call add_mixing(line%shape(:, i), line%orifices(i), bearing%pad(line%pad)%film%fixed(line%node), mixing%share)
    end associate
  end function mixing_of_line

  !> Heat that nodes of an element get with gas that enters, over its flow [W s/(Pa m3)].
  pure function gain_of(bearing, mixing, temperature) result(gain)
    class(bearing_type), intent(in) :: bearing
    type(mixing_type), intent(in) :: mixing
    real(wp), intent(in) :: temperature(:) !! of the gas at these nodes [K]
    real(wp) :: gain(size(temperature))
    gain = bearing%heat%gas%density*bearing%heat%gas%specific_heat*matmul(mixing%share, bearing%feed%temperature - temperature)
  end function gain_of

  !> Adds the derivatives of that heat, and of mouths and lines by temperatures.
  subroutine add_supply_heat_rates(bearing, state, room, matrix)
    class(bearing_type), intent(in) :: bearing !! with heat and orifices
    type(bearing_state_type), intent(in) :: state !! of it
    logical, intent(in) :: room !! zeros alone, where they stand; the state has no values then
    Mat, intent(in) :: matrix !! by the bearing's local numbers
    integer :: j, i

    do j = 1, size(bearing%feed%mouth)
      call add_mouth_heat(bearing, state, j, room, matrix)
      call add_rim_rates(bearing, state, j, room, matrix)
      call add_gap_rates(bearing, state, j, room, matrix)
    end do
    do j = 1, size(bearing%feed%line)
      do i = 1, size(bearing%feed%line(j)%orifices)
        call add_line_heat(bearing, state, j, i, room, matrix)
      end do
    end do
  end subroutine add_supply_heat_rates

  !> Energy at the nodes of a rim by the mouth's pressure and gap, and by their temperatures.
  subroutine add_mouth_heat(bearing, state, j, room, matrix)
    class(bearing_type), intent(in) :: bearing
    type(bearing_state_type), intent(in) :: state
    integer, intent(in) :: j !! of the mouth
    logical, intent(in) :: room
    Mat, intent(in) :: matrix
    type(mouth_state_type) :: here
    real(wp) :: by(2)
    PetscInt :: own(mouth_unknowns)
    integer :: k

    own = numbers_of(bearing%feed, j)
    associate (feed => bearing%feed, mouth => bearing%feed%mouth(j))
      if (.not. room) here = state_of_mouth(bearing, j, state)
      by = mouth%part*[here%flow_by_pressure*feed%size(mouth_pressure), here%flow_by_gap*feed%size(mouth_gap)]
      do k = 1, size(mouth%mixing)
        call add_gain_rates(bearing, state, mouth%pad, mouth%mixing(k), mouth%part*here%flow, own([mouth_pressure, mouth_gap]), by, &
                            room, matrix)
      end do
    end associate
  end subroutine add_mouth_heat

  !> Energy at nodes of an element where gas enters, by what its flow follows and by their temperatures.
  subroutine add_gain_rates(bearing, state, pad, mixing, flow, column, by, room, matrix)
    class(bearing_type), intent(in) :: bearing
    type(bearing_state_type), intent(in) :: state
    integer, intent(in) :: pad
    type(mixing_type), intent(in) :: mixing
    real(wp), intent(in) :: flow  !! that enters [Pa m3/s]
    PetscInt, intent(in) :: column(:) !! numbers, from 0, of what it follows
    real(wp), intent(in) :: by(:) !! its derivatives by these
    logical, intent(in) :: room
    Mat, intent(in) :: matrix
    real(wp) :: gain(size(mixing%node))
    integer :: gas(size(gain))

    gas = bearing%heat%place_of_gas(pad, mixing%node)
    gain = 0.0_wp
    if (.not. room .and. flow > 0.0_wp) gain = gain_of(bearing, mixing, state%unknown(gas))
    call add_block(matrix, number(gas), column, outer(by, -gain))
    associate (capacity => bearing%heat%gas%density*bearing%heat%gas%specific_heat)
      call add_block(matrix, number(gas), number(gas), max(flow, 0.0_wp)*capacity*mixing%share) ! which is symmetric
    end associate
  end subroutine add_gain_rates

  !> What the mesh of the film smears around a rim, by the temperatures there.
  subroutine add_rim_rates(bearing, state, j, room, matrix)
    class(bearing_type), intent(in) :: bearing
    type(bearing_state_type), intent(in) :: state
    integer, intent(in) :: j
    logical, intent(in) :: room
    Mat, intent(in) :: matrix
    type(mouth_state_type) :: here
    real(wp) :: resistance(4, size(bearing%feed%mouth(j)%node)), rate(5)
    integer :: place(3*size(resistance, 2)), a, n
    PetscInt :: own(mouth_unknowns)

    own = numbers_of(bearing%feed, j)
    n = size(resistance, 2)
    resistance = 0.0_wp
    rate = 0.0_wp
    associate (feed => bearing%feed, mouth => bearing%feed%mouth(j), heat => bearing%heat, pad => bearing%pad(bearing%feed%mouth(j)%pad))
      do a = 1, n
        place([a, n + a, 2*n + a]) = [heat%place_of_gas(mouth%pad, mouth%node(a)), heat%place_of_foil(mouth%pad, mouth%node(a)), &
                                      heat%place_of_shaft(row_of(pad%mesh%mesh_node(mouth%node(a)), pad%whole%rows()))]
      end do
      if (.not. room) then
        here = state_of_mouth(bearing, j, state)
        resistance = rim_resistances(bearing, j, state)
        associate (mean => state%unknown(feed%place(j, mouth_mean))*feed%size(mouth_mean), &
                   gap => state%unknown(feed%place(j, mouth_gap))*feed%size(mouth_gap))
          call rim_balance(mouth%lack, pad%film%flow%viscosity, here%pressure, mean, gap, here%flow, rate(1), rate(2), rate(3), rate(4), rate(5))
        end associate
      end if
      associate (smeared => rate(5)*here%flow/feed%size(mouth_pressure)**2*mouth%weight)
        call add_block(matrix, own(mouth_pressure:mouth_pressure), number(place), &
                       [smeared*resistance(2, :), smeared*resistance(3, :), smeared*resistance(4, :)])
      end associate
    end associate
  end subroutine add_rim_rates

  !> The gap at a mouth's centre by temperatures.
  subroutine add_gap_rates(bearing, state, j, room, matrix)
    class(bearing_type), intent(in) :: bearing
    type(bearing_state_type), intent(in) :: state
    integer, intent(in) :: j
    logical, intent(in) :: room
    Mat, intent(in) :: matrix
    integer :: place(size(bearing%feed%mouth(j)%centre_node) + 2)
    real(wp) :: rate(size(place))
    PetscInt :: own(mouth_unknowns)

    own = numbers_of(bearing%feed, j)
    associate (feed => bearing%feed, mouth => bearing%feed%mouth(j))
      call find_gap_rates(bearing, state, mouth%pad, mouth%centre_node, mouth%centre_weight, room, place, rate)
      call add_block(matrix, own(mouth_gap:mouth_gap), number(place), -rate/feed%size(mouth_gap))
    end associate
  end subroutine add_gap_rates

  !> How a weighted gap follows temperatures: of the shaft as the nodes see it, the sleeve, the mean of the top foil.
  pure subroutine find_gap_rates(bearing, state, pad, node, weight, room, place, rate)
    class(bearing_type), intent(in) :: bearing
    type(bearing_state_type), intent(in) :: state
    integer, intent(in) :: pad, node(:)
    real(wp), intent(in) :: weight(:) !! of the nodes [1]
    logical, intent(in) :: room
    integer, intent(out) :: place(:) !! local unknowns; 0: none
    real(wp), intent(out) :: rate(:) !! [m/K]
    real(wp) :: sunk
    integer :: a, n

    n = size(node)
    associate (heat => bearing%heat, here => bearing%pad(pad))
      do a = 1, n
        place(a) = heat%place_of_shaft(row_of(here%mesh%mesh_node(node(a)), here%whole%rows()))
      end do
      place(n + 1) = heat%place_of_sleeve()
      place(n + 2) = mean_of(heat, here)
      rate = 0.0_wp
      if (room) return
      sunk = dot_product(weight, sinking_of(bearing, state, pad, node))
      rate(:n) = -state%point%growth*heat%shaft%growth*weight
      rate(n + 1) = state%point%growth*heat%sleeve%growth*sum(weight) + sunk
      rate(n + 2) = sunk
    end associate
  end subroutine find_gap_rates

  !> Energy at the nodes of a line by all that its flow follows, and the film's own rows by temperatures that move the gap.
  subroutine add_line_heat(bearing, state, j, i, room, matrix)
    class(bearing_type), intent(in) :: bearing
    type(bearing_state_type), intent(in) :: state
    integer, intent(in) :: j, i !! piece of a line, its point
    logical, intent(in) :: room
    Mat, intent(in) :: matrix
    type(line_point_type) :: here
    real(wp), dimension(3*size(bearing%feed%line(j)%node) + 2 + size(bearing%coordinate)) :: by
    real(wp) :: share(size(bearing%feed%line(j)%node))
    integer :: place(size(by)), film(size(share)), k, n

    n = size(share)
    associate (line => bearing%feed%line(j), pad => bearing%pad(bearing%feed%line(j)%pad))
      if (.not. room) here = line_point(bearing, j, i, state)
      share = line%shape(:, i)*line%orifices(i)
      call find_gap_rates(bearing, state, line%pad, line%node, line%shape(:, i), room, place(:n + 2), by(:n + 2))
      by(:n + 2) = here%by_gap*by(:n + 2)
      film = merge(0, pad%first + line%node, pad%film%fixed(line%node))
      call add_block(matrix, number(film), number(place(:n + 2)), outer(by(:n + 2), -share))
      place(n + 3:2*n + 2) = pad%first + line%node
      by(n + 3:2*n + 2) = here%by_pressure*line%shape(:, i)
      associate (source => pad%foil%source(line%node))
        place(2*n + 3:3*n + 2) = merge(pad%first + source, 0, source > 0)
      end associate
      by(2*n + 3:3*n + 2) = here%by_gap*line%shape(:, i)*pad%foil%rate(line%node)
      place(3*n + 3:) = bearing%first_shaft + [(k, k=1, size(bearing%coordinate))]
      by(3*n + 3:) = here%by_gap*line%motion(bearing%coordinate, i)
      call add_gain_rates(bearing, state, line%pad, mixing_of_line(bearing, j, i), here%flow, number(place), by, room, matrix)
    end associate
  end subroutine add_line_heat

  !> Products of all with all.
  pure function outer(column, row) result(product)
    real(wp), intent(in) :: column(:), row(:)
    real(wp) :: product(size(column), size(row)) !! a row of the matrix in each column
    product = spread(column, 2, size(row))*spread(row, 1, size(column))
  end function outer
end module gfb_feed_heat
