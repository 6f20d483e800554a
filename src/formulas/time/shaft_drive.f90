!> What drives a shaft over time: speed, loads, motion of the base, or a given orbit.
module gfb_shaft_drive
  use gfb_kinds, only: wp
  implicit none (type, external)
  private

  real(wp), parameter :: pi = acos(-1.0_wp)

  !> What is given over the time; all of it begins at 0.
  type, public :: shaft_drive_type
    real(wp) :: mass = 0.0_wp            !! of the shaft [kg]
    real(wp) :: load(2) = 0.0_wp         !! steady [N]
    real(wp) :: speed = 0.0_wp           !! at the beginning [rad/s]
    real(wp) :: acceleration = 0.0_wp    !! of it [rad/s^2]
    real(wp) :: ramp = 0.0_wp            !! until when it changes [s]
    real(wp) :: unbalance = 0.0_wp       !! mass times its distance from the axis [kg m]
    real(wp) :: unbalance_angle = 0.0_wp !! of it at the beginning, from x [rad]
    real(wp) :: pulse(2) = 0.0_wp        !! force times time [N s]
    real(wp) :: pulse_start = 0.0_wp     !! [s]
    real(wp) :: pulse_length = 0.0_wp    !! [s]
    real(wp), allocatable :: base_time(:)            !! rising [s]
    real(wp), allocatable :: base_acceleration(:, :) !! (2, times) linear in between [m/s^2]
    real(wp) :: orbit_radius = 0.0_wp    !! of a sleeve whose place is given, about that [m]
    real(wp) :: orbit_frequency = 0.0_wp !! with the shaft's sense [rad/s]
  contains
    procedure :: speed_at
    procedure :: angle_at
    procedure :: load_at
    procedure :: orbit_at
    procedure :: jumps
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
    real(wp) :: angle, since, change

    load = self%load
    angle = self%angle_at(time) + self%unbalance_angle
    change = merge(self%acceleration, 0.0_wp, time < self%ramp)
    load = load + self%unbalance*(self%speed_at(time)**2*[cos(angle), sin(angle)] &
                                  - change*[-sin(angle), cos(angle)])
    since = time - self%pulse_start
    if (since > 0.0_wp .and. since < self%pulse_length) then
      load = load + self%pulse*2.0_wp/self%pulse_length*sin(pi*since/self%pulse_length)**2
    end if
    if (allocated(self%base_time)) load = load - self%mass*base_at(self, time)
  end function load_at

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
end module gfb_shaft_drive
