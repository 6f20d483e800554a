!> What drives a shaft over time: speed, loads, motion of the base, or a given orbit.
module gfb_shaft_drive
  use gfb_kinds, only: wp
  use gfb_units, only: pi
  implicit none (type, external)
  private

  !> What is given over the time; all of it begins at 0.
  type, public :: shaft_drive_type
    real(wp) :: mass = 0.0_wp            !! of the shaft [kg]
    real(wp) :: transverse_inertia = 0.0_wp !! of a rotor that tilts [kg m^2]
    real(wp) :: polar_inertia = 0.0_wp   !! of it [kg m^2]
    real(wp) :: bearing_distance = 0.0_wp !! of the two that it then stands on; 0: there is one [m]
    real(wp) :: load(2) = 0.0_wp         !! steady [N]
    real(wp) :: speed = 0.0_wp           !! at the beginning [rad/s]
    real(wp) :: acceleration = 0.0_wp    !! of it [rad/s^2]
    real(wp) :: ramp = 0.0_wp            !! until when it changes [s]
    real(wp) :: unbalance = 0.0_wp       !! mass times its distance from the axis [kg m]
    real(wp) :: unbalance_angle = 0.0_wp !! of it at the beginning, from x [rad]
    !> Unbalance times its distance along the axis from an opposite one [kg m^2].
    real(wp) :: couple_unbalance = 0.0_wp
    real(wp) :: couple_unbalance_angle = 0.0_wp !! of that at +z at the beginning, from x [rad]
    real(wp) :: pulse(2) = 0.0_wp        !! force times time [N s]
    real(wp) :: couple_pulse(2) = 0.0_wp !! torque times time, while the pulse takes [N m s]
    real(wp) :: pulse_start = 0.0_wp     !! [s]
    real(wp) :: pulse_length = 0.0_wp    !! [s]
    real(wp), allocatable :: base_time(:)            !! rising [s]
    real(wp), allocatable :: base_acceleration(:, :) !! (2, times) linear in between [m/s^2]
    real(wp) :: orbit_radius = 0.0_wp    !! of a sleeve whose place is given, about that [m]
    real(wp) :: orbit_frequency = 0.0_wp !! with the shaft's sense [rad/s]
  contains
    procedure, non_overridable :: speed_at, angle_at, load_at, torque_at, orbit_at, jumps, settled
  end type shaft_drive_type

contains

  !> Speed of the shaft.
  pure function speed_at(self, time) result(speed)
    class(shaft_drive_type), intent(in) :: self !! the drive
    real(wp), intent(in) :: time !! [s]
    real(wp) :: speed            !! [rad/s]
    speed = self%speed + self%acceleration*min(time, self%ramp)
  end function speed_at

  !> Angle that the shaft has turned by.
  pure function angle_at(self, time) result(angle)
    class(shaft_drive_type), intent(in) :: self !! the drive
    real(wp), intent(in) :: time !! [s]
    real(wp) :: angle            !! [rad]
    real(wp) :: rising

    rising = min(time, self%ramp)
    angle = self%speed*time + self%acceleration*rising*(time - 0.5_wp*rising)
  end function angle_at

  !> All outer forces on the shaft: load, unbalance, pulse, and the inertia of a base that moves.
  !>
  !> $$ \mathbf{f} = \mathbf{w} + u \, (\dot\varphi^2 \mathbf{n} - \ddot\varphi \mathbf{t})
  !>      + \mathbf{I} \frac{2}{T} \sin^2 \frac{\pi (t - t_0)}{T} - m \ddot{\mathbf{b}} $$
  pure function load_at(self, time) result(load)
    class(shaft_drive_type), intent(in) :: self !! the drive
    real(wp), intent(in) :: time !! [s]
    real(wp) :: load(2)          !! [N]

    load = self%load
    load = load + self%unbalance*turning(self, time, self%unbalance_angle)
    if (pushes(self, time)) load = load + self%pulse*2.0_wp/self%pulse_length*push_at(self, time)
    if (allocated(self%base_time)) load = load - self%mass*base_at(self, time)
  end function load_at

  !> All outer torques on a rotor that tilts, about x and y: couple unbalance and pulse.
  !>
  !> A force f at the height z has the torque \( z (-f_y, f_x) \); the unbalance u at z = d/2 and
  !> the opposite one at -d/2 have, with v = u d,
  !>
  !> $$ \boldsymbol{\tau} = v \, [0, -1; 1, 0]
  !>      (\dot\varphi^2 \mathbf{n} - \ddot\varphi \mathbf{t})
  !>      + \mathbf{J} \frac{2}{T} \sin^2 \frac{\pi (t - t_0)}{T} $$
  pure function torque_at(self, time) result(torque)
    class(shaft_drive_type), intent(in) :: self !! the drive
    real(wp), intent(in) :: time !! [s]
    real(wp) :: torque(2)        !! [N m]
    real(wp) :: force(2)

    force = self%couple_unbalance*turning(self, time, self%couple_unbalance_angle)
    torque = [-force(2), force(1)]
    if (pushes(self, time)) then
      torque = torque + self%couple_pulse*2.0_wp/self%pulse_length*push_at(self, time)
    end if
  end function torque_at

  !> Force of an unbalance that turns with the shaft, over it.
  pure function turning(self, time, from) result(force)
    class(shaft_drive_type), intent(in) :: self
    real(wp), intent(in) :: time
    real(wp), intent(in) :: from !! angle at the beginning [rad]
    real(wp) :: force(2)         !! [1/s^2]
    real(wp) :: angle, change

    angle = self%angle_at(time) + from
    change = merge(self%acceleration, 0.0_wp, time < self%ramp)
    force = self%speed_at(time)**2*[cos(angle), sin(angle)] - change*[-sin(angle), cos(angle)]
  end function turning

  !> Whether the pulse pushes.
  pure logical function pushes(self, time)
    class(shaft_drive_type), intent(in) :: self
    real(wp), intent(in) :: time
    real(wp) :: since
    since = time - self%pulse_start
    pushes = since > 0.0_wp .and. since < self%pulse_length
  end function pushes

  !> Force of the pulse over its mean twice.
  pure function push_at(self, time) result(share)
    class(shaft_drive_type), intent(in) :: self
    real(wp), intent(in) :: time !! while it pushes [s]
    real(wp) :: share            !! [1]
    share = sin(pi*(time - self%pulse_start)/self%pulse_length)**2
  end function push_at

  !> Acceleration of the base; none beyond the table.
  pure function base_at(self, time) result(acceleration)
    class(shaft_drive_type), intent(in) :: self
    real(wp), intent(in) :: time
    real(wp) :: acceleration(2), part
    integer :: i

    acceleration = 0.0_wp
    do i = 2, size(self%base_time)
      if (time < self%base_time(i - 1) .or. time > self%base_time(i)) cycle
      part = (time - self%base_time(i - 1))/(self%base_time(i) - self%base_time(i - 1))
      acceleration = (1.0_wp - part)*self%base_acceleration(:, i - 1) &
        + part*self%base_acceleration(:, i)
    end do
  end function base_at

  !> Way of the sleeve from its first position, where its orbit is given.
  pure function orbit_at(self, time) result(way)
    class(shaft_drive_type), intent(in) :: self !! the drive
    real(wp), intent(in) :: time !! [s]
    real(wp) :: way(2)           !! [m]
    way = self%orbit_radius*[cos(self%orbit_frequency*time), sin(self%orbit_frequency*time)]
  end function orbit_at

  !> The next time after which what drives the shaft is another function; huge where there is none.
  pure function jumps(self, time) result(next)
    class(shaft_drive_type), intent(in) :: self !! the drive
    real(wp), intent(in) :: time !! [s]
    real(wp) :: next             !! [s]
    real(wp), allocatable :: times(:)

    times = [self%ramp, self%pulse_start, self%pulse_start + self%pulse_length]
    if (allocated(self%base_time)) times = [times, self%base_time]
    next = huge(next)
    times = pack(times, times > time*(1.0_wp + 1.0e-9_wp) .and. times > 0.0_wp)
    if (size(times) > 0) next = minval(times)
  end function jumps

  !> From when on the speed stays and nothing acts on the shaft but its load and its unbalance.
  pure function settled(self) result(time)
    class(shaft_drive_type), intent(in) :: self !! the drive
    real(wp) :: time             !! [s]
    integer :: i

    time = 0.0_wp
    if (abs(self%acceleration) > 0.0_wp) time = self%ramp
    if (any(abs([self%pulse, self%couple_pulse]) > 0.0_wp)) then
      time = max(time, self%pulse_start + self%pulse_length)
    end if
    if (.not. allocated(self%base_time)) return
    do i = size(self%base_time), 1, -1
      if (.not. any(abs(self%base_acceleration(:, i)) > 0.0_wp)) cycle
      time = max(time, self%base_time(min(i + 1, size(self%base_time))))
      exit
    end do
  end function settled
end module gfb_shaft_drive
