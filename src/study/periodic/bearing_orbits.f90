!> The map over a period of a bearing in equilibrium, by what its case file asks for.
module gfb_bearing_orbits
  use gfb_kinds, only: wp
  use gfb_units, only: pi
  use gfb_scene, only: scene_type
  use gfb_operation_case, only: angular_speed
  use gfb_motion_cases, only: periodic_case_type, motion_free, follow_speed, follow_unbalance, &
        follow_mass
  use gfb_bearing_system, only: bearing_system_type
  use gfb_newton, only: newton_type
  use gfb_time_march, only: begin_rubbing
  use gfb_transient, only: settings_of
  use gfb_period_map, only: period_map_type, moved_speed, moved_unbalance, moved_mass
  use gfb_bearing_map, only: bearing_map_type, create_map
  implicit none (type, external)
  private
  public :: map_of_bearing, set_parameter, make_tight

  !> tolerances of a step of time: residual, step [1]
  real(wp), parameter :: tight(2) = [1.0e-11_wp, 1.0e-12_wp]

contains

  !> The map of a scene, and the bounds of its parameter.
  subroutine map_of_bearing(scene, bearing, newton, map, bounds)
    type(scene_type), intent(in) :: scene !! with `&periodic`
    !> whose shaft is free; begins to rub
    type(bearing_system_type), target, intent(inout) :: bearing
    type(newton_type), target, intent(inout) :: newton !! its solver; becomes tight
    class(period_map_type), allocatable, intent(out) :: map !! created
    real(wp), intent(out) :: bounds(2) !! of the parameter of a point: begin, end [1]
    type(bearing_map_type), allocatable :: own

    call make_tight(newton)
    call begin_rubbing(bearing, .false.)
    allocate (own)
    own%drive%mass = scene%rotor%mass
    own%drive%load = scene%operation%load
    own%drive%speed = angular_speed(scene%operation%speed_rpm)
    own%drive%unbalance = scene%unbalance%static
    own%drive%unbalance_angle = scene%unbalance%angle
    own%settings = settings_of(scene)
    own%settings%unsolved = 0.0_wp ! what is left of steps does not close
    if (.not. scene%shaft_contact%present) own%touch_down_gap = scene%solver%touch_down_gap
    call create_map(bearing, newton, own)
    call set_parameter(scene%periodic, own, bounds)
    call move_alloc(own, map)
  end subroutine map_of_bearing

  !> Steps of time are solved as far as orbits close, without lines of their own.
  subroutine make_tight(newton)
    type(newton_type), intent(inout) :: newton !! of a bearing

    newton%log%verbose = .false.
    newton%settings%residual_tolerance = min(newton%settings%residual_tolerance, tight(1))
    newton%settings%step_tolerance = min(newton%settings%step_tolerance, tight(2))
  end subroutine make_tight

  !> Period, steps and parameter of a map.
  subroutine set_parameter(periodic, map, bounds)
    type(periodic_case_type), intent(in) :: periodic !! what is asked for
    class(period_map_type), intent(inout) :: map !! what drives it is known
    real(wp), intent(out) :: bounds(2) !! of the parameter of a point: begin, end [1]
    real(wp) :: final

    map%turns = 1
    if (periodic%motion /= motion_free) map%turns = periodic%period_turns
    map%steps = periodic%steps_per_turn*map%turns
    map%period_scale = 2.0_wp*pi*map%turns/map%driven(moved_speed)
    final = periodic%final_value
    select case (periodic%parameter)
    case (follow_speed)
      map%parameter = moved_speed
      final = angular_speed(final)
    case (follow_unbalance)
      map%parameter = moved_unbalance
    case (follow_mass)
      map%parameter = moved_mass
    case default
      map%parameter = 0
    end select
    bounds = [0.0_wp, 1.0_wp]
    if (map%parameter > 0) bounds = [map%driven(map%parameter), final]
    map%parameter_scale = abs(bounds(2) - bounds(1))
    bounds = bounds/map%parameter_scale
  end subroutine set_parameter
end module gfb_bearing_orbits
