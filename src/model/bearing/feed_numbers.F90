!> From `&feed` to the numbers of what feeds a bearing's films: laws of the wall and the orifices, supply, pockets, tubes.
module gfb_feed_numbers
  use gfb_kinds, only: wp
  use gfb_units, only: turn, pi
  use gfb_bearing, only: bearing_type
  use gfb_feed_case, only: feed_porous
  use gfb_feed_law, only: porous_wall_type, orifice_type
  use gfb_film_feed, only: mouth_pressure, mouth_mean, mouth_gap
  use gfb_gas_integrals, only: gas_integrals, of_volume, integrals
  use gfb_gas_law, only: density_ideal
  use gfb_heated_gas, only: heated_gas_type, relative_viscosity
  use gfb_scene, only: scene_type
  implicit none (type, external)
  private
  public :: take_feed_numbers

contains

  !> Gives a bearing the numbers of what feeds it; where it is fed stays.
  subroutine take_feed_numbers(scene, bearing)
    type(scene_type), intent(in) :: scene !! with the same places
    class(bearing_type), intent(inout) :: bearing !! whose pads stand in their places
    integer :: i, k, n

    if (.not. scene%feed%present) return
    associate (given => scene%feed, feed => bearing%feed)
      feed%energy = given%film_energy
      feed%temperature = given%supply_temperature
      feed%work = work_of(scene)
      feed%ambient = bearing%ambient_pressure
      feed%supply = given%supply_pressure
      if (given%kind == feed_porous) then
        feed%wall = wall_of(scene)
        do i = 1, size(bearing%pad)
          bearing%pad(i)%film%wall = feed%wall
        end do
        return
      end if
      feed%orifice = orifice_type(given%restriction, given%pressure_at_holes(), given%energy, given%specific_heat_ratio, &
                                  given%discharge_coefficient, given%orifice_diameter, given%mouth_diameter, given%flows_back(), &
                                  given%density_ratio())
      feed%volume = given%pocket_volume*given%density_ratio()
      feed%push = (given%supply_pressure - feed%ambient)*given%tube_area()
      do i = 1, size(bearing%pad)
        bearing%pad(i)%pressure_below = merge(given%channel_pressure - feed%ambient, 0.0_wp, given%fills_channel())
      end do
      feed%size([mouth_pressure, mouth_mean]) = bearing%ambient_pressure
      feed%size(mouth_gap) = bearing%clearance
      do i = 1, size(feed%line)
        associate (line => feed%line(i), film => bearing%pad(feed%line(i)%pad)%film)
          n = size(line%node)
          associate (angle => unwound(film%angle(line%node)), along => film%axial(line%node))
            line%motion_excess = film%surface%motion_excess(line%shape, angle, along)
          end associate
          line%motion = line%motion_excess
          do k = 1, n
            line%motion(:, k) = line%motion(:, k) + matmul(film%motion(:, line%node), line%shape(:, k))
          end do
        end associate
      end do
    end associate
  end subroutine take_feed_numbers

  !> Angles of a side's nodes, rising.
  pure function unwound(angle) result(rising)
    real(wp), intent(in) :: angle(:) !! [rad]
    real(wp) :: rising(size(angle))
    rising = merge(angle + turn, angle, maxval(angle) - angle > pi)
  end function unwound

  !> The porous wall, as thick as its flow sees it: of a journal's, which widens outwards, \( R \ln(1 + H/R) \).
  pure type(porous_wall_type) function wall_of(scene) result(wall)
    type(scene_type), intent(in) :: scene
    type(heated_gas_type) :: gas
    real(wp) :: thicker(3)

    associate (given => scene%feed, bearing => scene%bearing)
      wall%present = .true.
      wall%supply_pressure = given%supply_pressure
      wall%thickness = given%wall_thickness
      if (.not. bearing%row%has_sectors) wall%thickness = bearing%radius*log(1.0_wp + given%wall_thickness/bearing%radius)
      gas%reference = given%film_temperature
      gas%viscosity = scene%gas%viscosity_law
      gas%exponent = scene%gas%viscosity_temperature_exponent
      thicker = relative_viscosity(gas, given%supply_temperature)
      wall%resistance = scene%gas%viscosity/given%permeability*thicker(1)
      wall%inertia = given%inertia_coefficient/given%film_energy*given%density_ratio()
      wall%density = given%density_ratio()
      wall%temperature = given%supply_temperature
    end associate
  end function wall_of

  !> Work to compress the gas that is fed in from ambient pressure, isothermal, over its flow in the film's unit: of an ideal gas
  !> \( \ln(p_s/p_a) \, T_s/T_r \), of any \( \int dp/r \) [1].
  pure real(wp) function work_of(scene) result(work)
    type(scene_type), intent(in) :: scene
    real(wp) :: integral(integrals)

    associate (given => scene%feed, ambient => scene%gas%ambient_pressure)
      if (scene%gas%law%density == density_ideal) then
        associate (ratio => given%supply_pressure/ambient)
          work = log(ratio)/given%density_ratio()
        end associate
      else
        integral = gas_integrals(scene%gas%law, ambient, given%supply_pressure)
        work = integral(of_volume)/given%density_ratio()
      end if
    end associate
  end function work_of
end module gfb_feed_numbers
