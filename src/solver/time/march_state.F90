#include "gfb_petsc.h"
!> A march through time: its past, what drives it, and how long its next step is.
module gfb_march_state
  use petscvec
  use gfb_kinds, only: wp
  use gfb_units, only: pi
  use gfb_archive, only: archive_type
  use gfb_backward_difference, only: extrapolation_weights, error_share, kept_times
  use gfb_shaft_drive, only: shaft_drive_type
  use gfb_operating_point, only: operating_point_type
  use gfb_film_surface, only: shaft_coordinates
  use gfb_maxwell_arm, only: maxwell_arm_type
  implicit none (type)
  private
  public :: visit_march, allowed_step, first_step, usual_step, place_ahead, error_of, largest_way

  !> What was before, on this rank, of a pad: now and one step ago.
  type, public :: pad_history_type
    real(wp), allocatable :: stored(:, :, :)  !! (points, elements, 2) r h [Pa m]
  end type pad_history_type

  !> What a march by stages keeps from step to step, on this rank; a march that begins anew finds it.
  type, public :: stages_past_type
    logical :: ready = .false.            !! the rates are those of the present state
    real(wp), allocatable :: rate(:)      !! of all that has a past, in the order of `gfb_stage_memory`, per second
    integer :: known = 0                  !! stages that the next one is predicted from
    real(wp), allocatable :: time(:)      !! (stages) theirs, the newest first [s]
    real(wp), allocatable :: unknown(:, :) !! (local unknowns, stages) [SI]
  end type stages_past_type

  !> How steps are chosen.
  type, public :: march_settings_type
    real(wp) :: steps_per_turn = 0.0_wp !! 0: by the error [1]
    real(wp) :: least_steps = 60.0_wp   !! of a turn, then [1]
    real(wp) :: tolerance = 1.0e-5_wp   !! error of a step in the shaft's position, over the clearance, then [1]
    real(wp) :: damping = 0.0_wp        !! of an elastic foundation [N s/m^3]
    type(maxwell_arm_type) :: arm       !! beside its springs
    real(wp) :: unsolved = 0.0_wp       !! of a step's own error, to which its equations are solved; 0: to the last digits [1]
    logical :: by_stages = .false.      !! of order 4 (`gfb_runge_kutta`), else of order 2
    real(wp) :: loss_time = 0.0_wp      !! viscous losses of meshed foils, over their stiffness [s]
    real(wp) :: end_time = 0.0_wp       !! [s]
  contains
    procedure :: damps
  end type march_settings_type

  !> The march: what drives it, its past, the next step.
  type, public :: march_type
    type(shaft_drive_type) :: drive
    type(march_settings_type) :: settings
    real(wp) :: time = 0.0_wp           !! of the present state [s]
    real(wp) :: step = 0.0_wp           !! that led there [s]
    real(wp) :: next = 0.0_wp           !! that is tried next [s]
    real(wp) :: error = 0.0_wp          !! of that step, in the shaft's position [m]
    integer :: steps = 0                !! taken
    integer :: rejections = 0           !! steps that were taken again, shorter
    !> of the sleeve and its tilt, now and one step ago [m/s], [rad/s]
    real(wp) :: velocity(shaft_coordinates, 2) = 0.0_wp
    real(wp) :: place(shaft_coordinates, kept_times) = 0.0_wp !! of them, now and before [m], [rad]
    real(wp) :: first_place(shaft_coordinates) = 0.0_wp !! of them at the beginning [m], [rad]
    real(wp) :: past_step(kept_times) = 0.0_wp !! the last steps, `step` first [s]
    real(wp), allocatable :: unknown(:, :) !! (local unknowns, kept_times) now and before [SI]
    type(pad_history_type), allocatable :: pad(:)
    type(stages_past_type) :: stages    !! of a march by stages
    type(operating_point_type) :: start !! whose tilt and fixed position stay
    Vec :: state(kept_times) !! scaled, now and before, with all their digits
  contains
    procedure :: turns, way_in_bearings
  end type march_type

contains

  !> Whether the springs of an elastic foundation have dampers beside them.
  pure function damps(self)
    class(march_settings_type), intent(in) :: self !! of the march
    logical :: damps
    damps = self%damping > 0.0_wp .or. self%arm%is_present()
  end function damps

  !> The sleeve's place one step ahead, on the parabola through the last ones.
  pure function place_ahead(march, step) result(place)
    type(march_type), intent(in) :: march
    real(wp), intent(in) :: step !! [s]
    real(wp) :: place(shaft_coordinates)
    place = matmul(march%place, extrapolation_weights([step, march%past_step(:2)]))
  end function place_ahead

  !> Error of a step in the sleeve's place, that of the bearing where it is larger [m].
  pure real(wp) function error_of(march, step, place) result(error)
    type(march_type), intent(in) :: march
    real(wp), intent(in) :: step !! [s]
    real(wp), intent(in) :: place(shaft_coordinates) !! that it led to [m], [rad]
    error = error_share([step, march%past_step(:2)])*largest_way(march, place - place_ahead(march, step))
  end function error_of

  !> The way that a motion of the shaft moves its journals, the larger one [m].
  pure function largest_way(march, change) result(way)
    type(march_type), intent(in) :: march
    real(wp), intent(in) :: change(shaft_coordinates) !! [m], [rad]
    real(wp) :: way, ways(2, 2)

    ways = march%way_in_bearings(change)
    way = max(norm2(ways(:, 1)), norm2(ways(:, 2)))
  end function largest_way

  !> What a motion of the shaft is in each of two bearings, e + z (phi_y, -phi_x): that at +z, that at -z.
  pure function way_in_bearings(self, change) result(way)
    class(march_type), intent(in) :: self !! the march
    real(wp), intent(in) :: change(shaft_coordinates) !! [m], [rad]
    real(wp) :: way(2, 2) !! (x and y, bearings) [m]
    real(wp) :: lever(2)

    lever = 0.5_wp*self%drive%bearing_distance*[change(5), -change(4)]
    way(:, 1) = change(:2) + lever
    way(:, 2) = change(:2) - lever
  end function way_in_bearings

  !> The next step, not beyond the end; one that the error chooses not beyond a jump of what drives the shaft either, and
  !> with no short one left over before it.
  pure function allowed_step(march) result(step)
    type(march_type), intent(in) :: march
    real(wp), parameter :: nearly = 0.999_wp !! over what is left [1]
    real(wp) :: step, left

    step = march%next
    left = march%settings%end_time - march%time
    if (march%settings%steps_per_turn > 0.0_wp) then
      if (step > nearly*left) step = left
      return
    end if
    step = min(step, longest_step(march))
    left = min(left, march%drive%jumps(march%time) - march%time)
    if (step > nearly*left) then
      step = left
    else if (step > 0.5_wp*left) then
      step = 0.5_wp*left
    end if
  end function allowed_step

  !> Steps of a turn that are asked for, or to begin with where the error chooses them.
  pure real(wp) function first_step(march) result(step)
    type(march_type), intent(in) :: march
    real(wp), parameter :: short = 0.02_wp !! over the longest one [1]

    step = short*longest_step(march)
    if (march%settings%steps_per_turn > 0.0_wp) step = usual_step(march)
  end function first_step

  !> A step where their number is given.
  pure real(wp) function usual_step(march) result(step)
    type(march_type), intent(in) :: march
    step = 2.0_wp*pi/(march%settings%steps_per_turn*fastest(march))
  end function usual_step

  !> The longest step.
  pure real(wp) function longest_step(march) result(step)
    type(march_type), intent(in) :: march
    step = 2.0_wp*pi/(march%settings%least_steps*fastest(march))
  end function longest_step

  !> The speed whose turns are divided: the present one, a tenth of the largest one at least; that of one turn in the whole
  !> time where nothing turns.
  pure real(wp) function fastest(march) result(speed)
    type(march_type), intent(in) :: march
    associate (drive => march%drive, end_time => march%settings%end_time)
      speed = max(abs(drive%speed_at(march%time)), abs(drive%orbit_frequency), &
                  0.1_wp*max(abs(drive%speed), abs(drive%speed_at(end_time))))
      if (.not. speed > 0.0_wp) speed = 2.0_wp*pi/end_time
    end associate
  end function fastest

  !> Turns of the shaft so far.
  pure function turns(self) result(number)
    class(march_type), intent(in) :: self !! the march
    real(wp) :: number !! [1]
    number = self%drive%angle_at(self%time)/(2.0_wp*pi)
  end function turns

  !> Saves or restores all but what follows from the states, and fields.
  pure subroutine visit_march(archive, march)
    type(archive_type), intent(inout) :: archive !! that saves or restores
    type(march_type), intent(inout) :: march !! written where the archive restores

    call archive%visit('time', march%time)
    call archive%visit('step', march%step)
    call archive%visit('next', march%next)
    call archive%visit('error', march%error)
    call archive%visit('steps', march%steps)
    call archive%visit('rejections', march%rejections)
    call archive%visit('velocity', march%velocity)
    call archive%visit('place', march%place)
    call archive%visit('first_place', march%first_place)
    call archive%visit('past_step', march%past_step)
    call archive%visit('start', march%start%place(:2))
  end subroutine visit_march
end module gfb_march_state
