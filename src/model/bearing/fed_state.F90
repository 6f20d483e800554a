!> What mouths and lines of orifices do at a state of a bearing.
module gfb_fed_state
  use gfb_kinds, only: wp
  use gfb_bearing, only: bearing_type, bearing_state_type
  use gfb_feed_law, only: orifice_flow
  use gfb_film_feed, only: film_feed_type, mouth_state_type, mouth_state, mouth_unknowns, &
                           mouth_pressure, mouth_mean, mouth_gap
  use gfb_gas_film, only: frozen_growth
  use gfb_bearing_heat, only: row_of
  use gfb_heated_supply, only: flow_resistance
  use gfb_petsc_kinds, only: pint
  implicit none (type, external)
  private
  public :: state_of_mouth, line_point, is_warm, rim_resistances, numbers_of, number

  !> A line's point: pressure, gap, what it feeds and derivatives.
  type, public :: line_point_type
    real(wp) :: pressure = 0.0_wp    !! [Pa]
    real(wp) :: gap = 0.0_wp         !! [m]
    real(wp) :: flow = 0.0_wp        !! of one orifice into the film [Pa m3/s]
    real(wp) :: by_pressure = 0.0_wp !! its derivative [m3/s]
    real(wp) :: by_gap = 0.0_wp      !! its derivative [Pa m2/s]
  end type line_point_type

contains

  !> A mouth at a state of the bearing. Where the film has temperatures of its own each rank has a share of what the mesh of the
  !> film smears.
  pure type(mouth_state_type) function state_of_mouth(bearing, j, state) result(here)
    class(bearing_type), intent(in) :: bearing !! that is fed
    integer, intent(in) :: j !! of the mouth
    type(bearing_state_type), intent(in) :: state !! of the bearing
    real(wp) :: viscosity

    viscosity = bearing%pad(1)%film%flow%viscosity
    if (is_warm(bearing)) then
      associate (resistance => rim_resistances(bearing, j, state))
        viscosity = viscosity*dot_product(bearing%feed%mouth(j)%weight, resistance(1, :))
      end associate
      here = mouth_state(bearing%feed, j, state%unknown, state%point%supply, viscosity, bearing%last_rank)
    else
      here = mouth_state(bearing%feed, j, state%unknown, state%point%supply, viscosity)
    end if
  end function state_of_mouth

  !> Whether the films have temperatures of their own.
  pure logical function is_warm(bearing)
    class(bearing_type), intent(in) :: bearing !! pads and shaft
    is_warm = bearing%heat%present .or. allocated(bearing%pad(1)%film%frozen)
  end function is_warm

  !> How much harder a warm film lets gas pass at this rank's nodes of a rim, see `flow_resistance`.
  pure function rim_resistances(bearing, j, state) result(resistance)
    class(bearing_type), intent(in) :: bearing !! whose films have temperatures
    integer, intent(in) :: j !! of the mouth
    type(bearing_state_type), intent(in) :: state !! of the bearing
    real(wp) :: resistance(4, size(bearing%feed%mouth(j)%node))
    real(wp) :: here(3)
    integer :: a

    associate (mouth => bearing%feed%mouth(j), pad => bearing%pad(bearing%feed%mouth(j)%pad), heat => bearing%heat)
      do a = 1, size(mouth%node)
        if (heat%present) then
          associate (node => mouth%node(a), row => row_of(pad%mesh%mesh_node(mouth%node(a)), pad%whole%rows()))
            here = state%unknown([heat%place_of_gas(mouth%pad, node), heat%place_of_foil(mouth%pad, node), heat%place_of_shaft(row)])
          end associate
          resistance(:, a) = flow_resistance(heat%gas, state%point%growth, here(1), here(2), here(3))
        else
          here = pad%film%frozen%field(mouth%node(a), :frozen_growth - 1)
          resistance(:, a) = flow_resistance(pad%film%frozen%gas, 1.0_wp, here(1), here(2), here(3))
        end if
      end do
    end associate
  end function rim_resistances

  !> What happens at a point of a line.
  pure type(line_point_type) function line_point(bearing, j, i, state) result(here)
    class(bearing_type), intent(in) :: bearing !! that is fed
    integer, intent(in) :: j, i !! piece of a line, its point
    type(bearing_state_type), intent(in) :: state !! of the bearing

    associate (feed => bearing%feed, line => bearing%feed%line(j), pad => bearing%pad(bearing%feed%line(j)%pad))
      here%pressure = dot_product(line%shape(:, i), state%unknown(pad%first + line%node))
      here%gap = dot_product(line%shape(:, i), state%gap(pad%first_node + line%node)) &
        + dot_product(line%motion_excess(:, i), state%point%place)
      call orifice_flow(feed%orifice_at(state%point%supply), here%pressure, here%gap, here%flow, here%by_pressure, here%by_gap)
      if (.not. allocated(line%past)) return
      here%flow = here%flow - feed%volume*feed%storage*here%pressure - line%past(i)
      here%by_pressure = here%by_pressure - feed%volume*feed%storage
    end associate
  end function line_point

  !> Numbers of a mouth's unknowns, from 0.
  pure function numbers_of(feed, j) result(own)
    type(film_feed_type), intent(in) :: feed !! with its numbers
    integer, intent(in) :: j !! of the mouth
    integer(pint) :: own(mouth_unknowns)
    own = number(feed%place(j, [mouth_pressure, mouth_mean, mouth_gap]))
  end function numbers_of

  !> Local numbers of PETSc, from 0.
  elemental function number(place)
    integer, intent(in) :: place !! from 1
    integer(pint) :: number
    number = int(place - 1, pint)
  end function number
end module gfb_fed_state
