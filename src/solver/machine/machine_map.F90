#include "gfb_petsc.h"
!> The map of a machine over one period, see `gfb_period_map`: all that the march of `gfb_machine_march` remembers, that is each
!> film and foil, and all motions of the shaft and of sleeves on supports.
module gfb_machine_map
  use gfb_kinds, only: wp
  use gfb_units, only: pi
  use gfb_text, only: text
  use gfb_backward_difference, only: difference_weights
  use gfb_film_surface, only: shaft_coordinates
  use gfb_march_state, only: march_settings_type
  use gfb_film_entries, only: film_entries, pack_film, unpack_film, take_back_springs, rest_of_springs
  use gfb_machine, only: machine_type, place_of_sleeve, places_along
  use gfb_machine_drive, only: machine_drive_type
  use gfb_machine_equilibrium, only: machine_bearing_type
  use gfb_machine_march, only: machine_march_type, begin_machine_march, resume_from_past, take_machine_step, end_machine_march
  use gfb_time_march, only: resume_march
  use gfb_period_map, only: period_map_type, lay_out, begin_orbit, no_step, pack_shaft, unpack_shaft, period_of, &
                            driven_at, moved_speed, moved_unbalance
  implicit none (type)
  private
  public :: create_machine_map

  real(wp), parameter :: finest = 1.0e-12_wp !! what journals are solved to, over the clearance [1]

  !> The map.
  type, extends(period_map_type), public :: machine_map_type
    type(machine_type), pointer :: machine => null()
    type(machine_bearing_type), pointer :: bearing(:) => null() !! their journals held
    type(machine_drive_type) :: drive         !! but for the parameter
    type(march_settings_type), allocatable :: settings(:) !! of each bearing; steps are the map's own
    real(wp), allocatable :: motion(:)        !! all of the machine, where it rests [m], [1]
    integer, allocatable :: node(:)           !! of the places where orbits are shown
    real(wp), allocatable :: touch_down_gap(:) !! of each bearing: a smaller one is none [m]
    real(wp), allocatable, private :: gap(:)  !! smallest one of each bearing in the orbit that was kept [m]
  contains
    procedure :: rest => rest_of_machine, apply => apply_machine_map, touches_down
  end type machine_map_type

  !> A bearing now and one step ago.
  type :: past_type
    real(wp), allocatable :: unknown(:, :) !! of film and foils [SI]
    real(wp), dimension(shaft_coordinates, 2) :: place, velocity !! of its sleeve [m], [rad], [m/s], [rad/s]
  end type past_type

contains

  !> Sizes of the map's entries; the rest is given.
  subroutine create_machine_map(machine, bearing, map)
    type(machine_type), target, intent(in) :: machine
    type(machine_bearing_type), target, intent(in) :: bearing(:) !! at their answers
    type(machine_map_type), intent(inout) :: map !! with drive, settings, steps and scales of period and parameter
    real(wp), allocatable :: start(:)
    real(wp) :: length
    integer :: i, n

    map%machine => machine
    map%bearing => bearing
    allocate (map%film(size(bearing)))
    do i = 1, size(bearing)
      map%film(i) = film_entries(map%settings(i), bearing(i)%bearing)
    end do
    map%film%share = 1.0_wp/sqrt(real(sum([(bearing(i)%bearing%unknowns, i=1, size(bearing))]), wp))
    n = machine%shaft%coordinates()
    length = minval([(bearing(i)%bearing%clearance, i=1, size(bearing))])
    associate (z => machine%shaft%z)
      allocate (map%scale(size(map%motion)), source=length*sqrt(real(size(z), wp)))
      map%scale(2:n:2) = map%scale(1)/(0.5_wp*(z(size(z)) - z(1)))
      start = 1.0_wp + 0.0_wp*map%motion
      start(1:n) = [along_a_line(z, 1.0_wp, 0.4_wp), along_a_line(z, 0.5_wp, -0.3_wp)]
    end associate
    map%start = [start, start, 0.3_wp*start, 0.3_wp*start]
    map%clock = map%driven(moved_speed)
    call lay_out(map)
  end subroutine create_machine_map

  !> A shaft that is moved and turned as one, in a plane, over the scales of its motions.
  pure function along_a_line(z, moved, turned) result(motion)
    real(wp), intent(in) :: z(:) !! of the nodes [m]
    real(wp), intent(in) :: moved, turned !! [1]
    real(wp) :: motion(2*size(z))

    motion(1::2) = moved + turned*(2.0_wp*(z - z(1))/(z(size(z)) - z(1)) - 1.0_wp)
    motion(2::2) = turned
  end function along_a_line

  !> The point at which the machine rests in its present state, with the drive's parameter and the map's own period.
  function rest_of_machine(self) result(x)
    class(machine_map_type), intent(in) :: self !! laid out, its bearings in equilibrium
    real(wp), allocatable :: x(:) !! [1]
    real(wp), allocatable :: unknown(:)
    integer :: i

    allocate (x(self%local + self%tail))
    do i = 1, size(self%film)
      associate (bearing => self%bearing(i)%bearing)
        allocate (unknown(bearing%local_size()))
        call bearing%get_unknowns(unknown)
        unknown(bearing%first_shaft + 1:) = bearing%point%place(bearing%coordinate)
      end associate
      call pack_film(self%film(i), spread(unknown, 2, 2), x, rest_of_springs(self%film(i), unknown))
      deallocate (unknown)
    end do
    call pack_shaft(self, spread(self%motion, 2, 2), spread(0.0_wp*self%motion, 2, 2), x)
    x(size(x) - 1) = 2.0_wp*pi*self%turns/self%driven(moved_speed)/self%period_scale
    x(size(x)) = 0.0_wp
    if (self%parameter > 0) x(size(x)) = self%driven(self%parameter)/self%parameter_scale
  end function rest_of_machine

  !> The point one period later, with the same period and parameter; `.false.` where a step has no answer.
  !>
  !> A step that would have to be shortened has none: all steps are equal.
  function apply_machine_map(self, x, y, keep) result(done)
    class(machine_map_type), intent(inout) :: self !! counts periods; gets the orbit; its bearings are left at the end
    real(wp), intent(in) :: x(:)  !! the point [1]
    real(wp), intent(out) :: y(:) !! one period later [1]
    logical, intent(in) :: keep   !! the smallest gap of the orbit is wanted
    logical :: done
    type(machine_march_type) :: march
    character(len=:), allocatable :: reason
    integer :: i, k

    y = x
    associate (driven => driven_at(self, x))
      done = driven(moved_speed) > 0.0_wp .and. period_of(self, x) > 0.0_wp
    end associate
    self%problem = 'speed and period must be positive'
    if (.not. done) return
    call begin_at(self, x, march)
    call begin_orbit(self)
    self%gap = spread(huge(1.0_wp), 1, size(self%film))
    self%orbit(:, 1) = places_along(self%machine, march%motion(:, 1), self%node)
    do i = 1, self%steps
      call take_machine_step(self%machine, self%bearing, march, reason)
      done = reason == '' .and. march%film(1)%rejections == 0
      if (.not. done) exit
      self%orbit(:, i + 1) = places_along(self%machine, march%motion(:, 1), self%node)
      if (keep) self%gap = [(min(self%gap(k), self%bearing(k)%bearing%smallest_gap()), k=1, size(self%gap))]
    end do
    self%smallest_gap = minval(self%gap)
    if (done) then
      do k = 1, size(self%film)
        call pack_own(self, march, k, y)
      end do
      call pack_shaft(self, march%motion(:, :2), march%rate, y)
    else
      self%problem = no_step(self, i, reason)
    end if
    call end_machine_march(march, self%bearing)
  end function apply_machine_map

  !> A film's entries at the end of a march.
  subroutine pack_own(map, march, number, y)
    type(machine_map_type), intent(in) :: map
    type(machine_march_type), intent(in) :: march
    integer, intent(in) :: number !! of the bearing
    real(wp), intent(inout) :: y(:)
    real(wp), allocatable :: unknown(:, :)

    associate (film => march%film(number), bearing => map%bearing(number)%bearing)
      unknown = film%unknown(:, :2)
      unknown(bearing%first_shaft + 1:, :) = film%place(bearing%coordinate, :2)
      call pack_film(map%film(number), unknown, y, bearing%dampers%springs)
    end associate
  end subroutine pack_own

  !> Begins a march with what drives the shaft at a point, in the map's steps, with the past that the point has.
  subroutine begin_at(map, x, march)
    type(machine_map_type), intent(inout) :: map !! its bearings get the point's state
    real(wp), intent(in) :: x(:)
    type(machine_march_type), intent(out) :: march
    type(march_settings_type) :: settings(size(map%film))
    type(machine_drive_type) :: drive
    type(past_type) :: past(size(map%film))
    real(wp), dimension(size(map%motion), 2) :: motion, rate
    real(wp) :: driven(size(map%driven)), none(size(map%machine%held))
    integer :: i

    driven = driven_at(map, x)
    drive = map%drive
    call drive%turn_with(driven(moved_speed), driven(moved_unbalance))
    settings = map%settings
    settings%steps_per_turn = map%steps*2.0_wp*pi/(driven(moved_speed)*period_of(map, x))
    settings%end_time = huge(1.0_wp)
    call unpack_shaft(map, x, motion, rate)
    do i = 1, size(past)
      associate (bearing => map%bearing(i)%bearing, one => past(i))
        call find_places(map%machine, i, motion, rate, bearing%point%place, one%place, one%velocity)
        allocate (one%unknown(bearing%local_size(), 2))
        call unpack_film(map%film(i), x, one%place(bearing%coordinate, :), one%unknown)
        bearing%point%speed = driven(moved_speed)
        bearing%point%place = one%place(:, 1)
        call bearing%set_unknowns(one%unknown(:, 1))
      end associate
    end do
    none = 0.0_wp
    call begin_machine_march(map%machine, motion(:, 1), none, drive, settings, map%bearing, march)
    march%part = 0.0_wp
    march%finest = finest
    do i = 1, size(past)
      call take_back_springs(map%film(i), x, past(i)%unknown)
      call resume_march(past(i)%unknown, past(i)%place, past(i)%velocity, map%bearing(i)%bearing, march%film(i))
    end do
    call resume_from_past(motion, rate, march)
  end subroutine begin_at

  !> Where the sleeve of a bearing is against its journal, and how fast it moves, now and one step ago.
  subroutine find_places(machine, number, motion, rate, kept, place, velocity)
    type(machine_type), intent(in) :: machine
    integer, intent(in) :: number !! of the bearing
    real(wp), intent(in) :: motion(:, :) !! (all motions, 2) [m], [1]
    real(wp), intent(in) :: rate(:, :)   !! (all motions, 2) [m/s], [1/s]
    real(wp), intent(in) :: kept(:) !! its coordinates that no film feels [m], [rad]
    real(wp), intent(out) :: place(:, :) !! (coordinates, 2) [m], [rad]
    real(wp), intent(out) :: velocity(:, :) !! (coordinates, 2) [m/s], [rad/s]
    integer :: k

    place = spread(kept, 2, 2)
    velocity = 0.0_wp
    associate (journal => machine%journal(number))
      do k = 1, 2
        place(journal%coordinate, k) = place_of_sleeve(journal, motion(machine%held, k))
        velocity(journal%coordinate, k) = -journal%sign*rate(journal%place, k)
      end do
    end associate
  end subroutine find_places

  !> Which bearing's shaft touched down in the orbit that was kept; empty where none.
  function touches_down(self) result(where)
    class(machine_map_type), intent(in) :: self !! after an orbit
    character(len=:), allocatable :: where
    integer :: i

    where = ''
    do i = 1, size(self%gap)
      if (where == '' .and. self%gap(i) < self%touch_down_gap(i)) where = 'the shaft touches down in bearing '//text(i)
    end do
  end function touches_down
end module gfb_machine_map
