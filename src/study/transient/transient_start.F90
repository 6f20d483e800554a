#include "gfb_petsc.h"
!> Where a shaft begins its way through time.
module gfb_transient_start
  use gfb_kinds, only: wp
  use gfb_run_log, only: run_log_type
  use gfb_scene, only: scene_type
  use gfb_operating_point, only: operating_point_type
  use gfb_bearing_system, only: bearing_system_type
  use gfb_newton, only: newton_type
  use gfb_continuation, only: path_settings_type, path_report_type, follow_path
  use gfb_moving_friction, only: begin_rubbing
  use gfb_shaft_drive, only: shaft_drive_type
  use gfb_time_march, only: march_type, march_settings_type, begin_march
  use gfb_foil_mass_choice, only: choose_momentum
  implicit none (type)
  private
  public :: begin_transient

  real(wp), parameter :: shortest = 0.01_wp !! step of the way there [1]

contains

  !> Begins at rest, or with what a restart file will overwrite.
  subroutine begin_transient(scene, drive, settings, goes_on, log, bearing, newton, march)
    type(scene_type), intent(in) :: scene !! with `&transient`
    type(shaft_drive_type), intent(in) :: drive !! what drives the shaft
    type(march_settings_type), intent(in) :: settings !! how steps are chosen
    logical, intent(in) :: goes_on !! a restart file has the rest
    type(run_log_type), intent(in) :: log !! is told what was chosen
    type(bearing_system_type), target, intent(inout) :: bearing !! at its steady state
    type(newton_type), target, intent(inout) :: newton !! its solver
    type(march_type), intent(out) :: march !! ready for its first step

    if (.not. goes_on) then
      call go_to_orbit(scene, log, bearing, newton)
      call choose_momentum(scene, log, bearing)
    end if
    call begin_rubbing(bearing, goes_on)
    call begin_march(drive, settings, bearing, march)
    if (scene%transient%orbit_radius > 0.0_wp) march%start%eccentricity = scene%operation%eccentricity
  end subroutine begin_transient

  !> Moves the sleeve and its steady film from the centre of the circle to the circle, along x.
  !>
  !> Where that has an end before, the first step of time is a jump from there.
  subroutine go_to_orbit(scene, log, bearing, newton)
    type(scene_type), intent(in) :: scene !! with `&transient`
    type(run_log_type), intent(in) :: log !! told where it cannot
    type(bearing_system_type), target, intent(inout) :: bearing !! at the centre
    type(newton_type), target, intent(inout) :: newton !! its solver
    type(operating_point_type) :: first
    type(path_report_type) :: report

    if (.not. scene%transient%orbit_radius > 0.0_wp) return
    first = bearing%point
    first%eccentricity(1) = first%eccentricity(1) + scene%transient%orbit_radius
    associate (solver => scene%solver)
      call follow_path(bearing, newton, first, 1.0_wp, &
                       path_settings_type(solver%maximum_load_steps, max(shortest, solver%smallest_load_step), solver%touch_down_gap), &
                       report)
    end associate
    if (.not. report%converged) call log%line('the sleeve jumps to its orbit: no steady film leads there ('//report%reason//')')
  end subroutine go_to_orbit
end module gfb_transient_start
