#include "gfb_petsc.h"
!> Where a sleeve begins that moves on a given circle.
module gfb_orbit_begin
  use gfb_kinds, only: wp
  use gfb_run_log, only: run_log_type
  use gfb_scene, only: scene_type
  use gfb_operating_point, only: operating_point_type
  use gfb_bearing_system, only: bearing_system_type
  use gfb_newton, only: newton_type
  use gfb_continuation, only: path_settings_type, path_report_type, follow_path
  implicit none (type)
  private
  public :: go_to_orbit

  real(wp), parameter :: shortest = 0.01_wp !! step of the way there [1]

contains

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
end module gfb_orbit_begin
