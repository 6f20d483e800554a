#include "gfb_petsc.h"
!> The map of a bearing and its rigid shaft over one period, see `gfb_period_map`: all that the march of `gfb_time_march`
!> remembers, with the shaft's place and its velocity.
module gfb_bearing_map
  use petscvec
  use gfb_kinds, only: wp
  use gfb_units, only: pi
  use gfb_march_state, only: march_settings_type
  use gfb_bearing_system, only: bearing_system_type
  use gfb_shaft_drive, only: shaft_drive_type
  use gfb_newton, only: newton_type, newton_report_type
  use gfb_time_march, only: march_type, begin_march, resume_march, take_step, end_march
  use gfb_film_entries, only: film_entries, pack_film, unpack_film, take_back_springs, rest_of_springs
  use gfb_period_map, only: period_map_type, lay_out, begin_orbit, no_step, pack_shaft, unpack_shaft, period_of, driven_at, &
                            moved_speed, moved_unbalance, moved_mass
  implicit none (type)
  private
  public :: create_map

  integer, parameter :: planar = 2 !! components of a place

  !> The map.
  type, extends(period_map_type), public :: bearing_map_type
    type(bearing_system_type), pointer :: bearing => null() !! whose shaft is free
    type(newton_type), pointer :: newton => null()          !! its solver
    type(shaft_drive_type) :: drive  !! but for the parameter
    type(march_settings_type) :: settings !! what dissipates in the foils; steps are the map's own
    real(wp) :: touch_down_gap = 0.0_wp !! a smaller one is none [m]
  contains
    procedure :: rest => rest_of_bearing, release => release_shaft, apply => apply_bearing_map, touches_down
    procedure, private :: drive_at
  end type bearing_map_type

contains

  !> Sizes of the map's entries; the rest is given.
  subroutine create_map(bearing, newton, map)
    type(bearing_system_type), target, intent(inout) :: bearing !! whose shaft is free
    type(newton_type), target, intent(inout) :: newton !! its solver
    type(bearing_map_type), intent(inout) :: map !! with drive, steps and scales
    PetscInt :: all
    PetscErrorCode :: ierr

    map%bearing => bearing
    map%newton => newton
    map%driven = [map%drive%speed, map%drive%unbalance, map%drive%mass]
    PetscCallA(VecGetSize(bearing%state, all, ierr))
    if (.not. allocated(map%film)) allocate (map%film(1))
    map%film(1) = film_entries(map%settings, bearing)
    map%film%share = 1.0_wp/sqrt(real(all, wp))
    map%scale = spread(bearing%clearance, 1, planar)
    map%clock = map%drive%speed
    map%start = [1.0_wp, 0.5_wp, 1.0_wp, 0.5_wp, 0.3_wp, -0.4_wp, 0.3_wp, -0.4_wp]
    map%place = ['']
    call lay_out(map)
  end subroutine create_map

  !> The point at which the bearing rests in its present state, with the drive's parameter and the map's own period.
  function rest_of_bearing(self) result(x)
    class(bearing_map_type), intent(in) :: self !! laid out, its bearing in equilibrium
    real(wp), allocatable :: x(:) !! [1]
    real(wp) :: unknown(self%bearing%local_size(), 2), none(planar, 2)

    allocate (x(self%local + self%tail))
    call self%bearing%get_unknowns(unknown(:, 1))
    unknown(:, 2) = unknown(:, 1)
    none = 0.0_wp
    call pack_film(self%film(1), unknown, x, rest_of_springs(self%film(1), unknown(:, 1)))
    call pack_shaft(self, places_in(self%bearing, unknown), none, x)
    x(size(x) - 1) = 2.0_wp*pi*self%turns/self%drive%speed/self%period_scale
    x(size(x)) = 0.0_wp
    if (self%parameter > 0) x(size(x)) = self%driven(self%parameter)/self%parameter_scale
  end function rest_of_bearing

  !> Gives a point of rest the past of a shaft that is released there, as a march over time has it.
  subroutine release_shaft(self, x)
    class(bearing_map_type), intent(in) :: self !! laid out, its bearing in equilibrium, which is kept
    real(wp), intent(inout) :: x(:) !! that equilibrium [1]
    type(march_type) :: march

    call begin_at(self, x, march)
    associate (shaft => self%local, length => self%scale(1))
      x(shaft + 3:shaft + 4) = x(shaft + 1:shaft + 2) + (march%place(:2, 2) - march%place(:2, 1))/length
      x(shaft + 7:shaft + 8) = march%velocity(:2, 2)/(length*self%clock)
    end associate
    call end_march(march, self%bearing)
  end subroutine release_shaft

  !> Begins a march with what drives the shaft at a point, in the map's steps.
  subroutine begin_at(map, x, march)
    type(bearing_map_type), intent(in) :: map
    real(wp), intent(in) :: x(:)
    type(march_type), intent(out) :: march
    type(march_settings_type) :: settings
    type(shaft_drive_type) :: drive

    drive = map%drive_at(x)
    settings = map%settings
    settings%steps_per_turn = map%steps*2.0_wp*pi/(drive%speed*period_of(map, x))
    settings%end_time = huge(1.0_wp)
    call begin_march(drive, settings, map%bearing, march)
  end subroutine begin_at

  !> What drives the shaft at a point.
  pure function drive_at(self, x) result(drive)
    class(bearing_map_type), intent(in) :: self !! the map
    real(wp), intent(in) :: x(:) !! the point [1]
    type(shaft_drive_type) :: drive
    real(wp) :: driven(size(self%driven))

    drive = self%drive
    driven = driven_at(self, x)
    drive%speed = driven(moved_speed)
    drive%unbalance = driven(moved_unbalance)
    drive%mass = driven(moved_mass)
  end function drive_at

  !> The point one period later, with the same period and parameter; `.false.` where a step has no answer.
  !>
  !> A step that would have to be shortened has none: all steps are equal.
  function apply_bearing_map(self, x, y, keep) result(done)
    class(bearing_map_type), intent(inout) :: self !! counts periods; gets the orbit; its bearing is left at the end
    real(wp), intent(in) :: x(:)  !! the point [1]
    real(wp), intent(out) :: y(:) !! one period later [1]
    logical, intent(in) :: keep   !! the smallest gap of the orbit is wanted
    logical :: done
    type(march_type) :: march
    type(newton_report_type) :: report
    type(shaft_drive_type) :: drive
    real(wp) :: unknown(self%bearing%local_size(), 2), place(planar, 2), velocity(planar, 2)
    integer :: i

    y = x
    drive = self%drive_at(x)
    done = drive%speed > 0.0_wp .and. drive%mass > 0.0_wp .and. period_of(self, x) > 0.0_wp
    self%problem = 'speed, mass and period must be positive'
    if (.not. done) return
    associate (bearing => self%bearing)
      call unpack_shaft(self, x, place, velocity)
      call unpack_film(self%film(1), x, place, unknown)
      bearing%point%speed = drive%speed
      call bearing%set_unknowns(unknown(:, 1))
      call begin_at(self, x, march)
      call take_back_springs(self%film(1), x, unknown)
      call resume_march(unknown, place, velocity, bearing, march)
      call begin_orbit(self)
      self%orbit(:, 1) = march%place(:2, 1)
      do i = 1, self%steps
        call take_step(march, bearing, self%newton, report)
        done = report%converged .and. march%rejections == 0
        if (.not. done) exit
        self%orbit(:, i + 1) = march%place(:2, 1)
        if (keep) self%smallest_gap = min(self%smallest_gap, bearing%smallest_gap())
      end do
      if (done) then
        call pack_film(self%film(1), march%unknown, y, bearing%dampers%springs)
        call pack_shaft(self, places_in(bearing, march%unknown), march%velocity(:2, :), y)
      else
        self%problem = no_step(self, i, '')
        if (.not. report%converged) self%problem = no_step(self, i, report%reason)
      end if
      call end_march(march, bearing)
    end associate
  end function apply_bearing_map

  !> Where the sleeve is, now and one step ago [m].
  pure function places_in(bearing, unknown) result(place)
    type(bearing_system_type), intent(in) :: bearing
    real(wp), intent(in) :: unknown(:, :) !! (local unknowns, times) [SI]
    real(wp) :: place(planar, 2)
    place = unknown(bearing%first_shaft + 1:bearing%first_shaft + planar, :2)
  end function places_in

  !> Which bearing's shaft touched down in the orbit that was kept; empty where none.
  function touches_down(self) result(where)
    class(bearing_map_type), intent(in) :: self !! after an orbit
    character(len=:), allocatable :: where

    where = ''
    if (self%smallest_gap < self%touch_down_gap) where = 'the shaft touches down'
  end function touches_down
end module gfb_bearing_map
