#include "gfb_petsc.h"
!> The map over a period that a scene asks for, and its parameter.
module gfb_scene_map
  use gfb_kinds, only: wp
  use gfb_text, only: text
  use gfb_scene, only: scene_type
  use gfb_operation_case, only: angular_speed
  use gfb_periodic_case, only: motion_free, follow_speed, follow_unbalance, follow_mass
  use gfb_bearing_system, only: bearing_system_type
  use gfb_period_map, only: period_map_type, create_map, parameter_of, moved_speed, moved_unbalance, moved_mass
  implicit none (type)
  private
  public :: set_map, value_words, words_at, step_within

  real(wp), parameter :: pi = acos(-1.0_wp)

contains

  !> The map of a scene, and the bounds of its parameter.
  subroutine set_map(scene, bearing, map, bounds)
    type(scene_type), intent(in) :: scene !! with `&periodic`
    type(bearing_system_type), intent(in) :: bearing !! whose shaft is free
    type(period_map_type), intent(out) :: map !! created
    real(wp), intent(out) :: bounds(2) !! of the parameter of a point: begin, end [1]
    real(wp) :: final

    associate (periodic => scene%periodic)
      map%drive%mass = scene%rotor%mass
      map%drive%load = scene%operation%load
      map%drive%speed = angular_speed(scene%operation%speed_rpm)
      map%drive%unbalance = periodic%unbalance
      map%drive%unbalance_angle = periodic%unbalance_angle
      map%settings%damping = periodic%foundation_damping
      map%settings%arm = periodic%arm
      map%turns = 1
      if (periodic%motion /= motion_free) map%turns = periodic%period_turns
      map%steps = periodic%steps_per_turn*map%turns
      map%period_scale = 2.0_wp*pi*map%turns/map%drive%speed
      final = periodic%final_value
      select case (periodic%parameter)
      case (follow_speed)
        map%parameter = moved_speed
        final = angular_speed(final)
        bounds = [map%drive%speed, final]
      case (follow_unbalance)
        map%parameter = moved_unbalance
        bounds = [map%drive%unbalance, final]
      case (follow_mass)
        map%parameter = moved_mass
        bounds = [map%drive%mass, final]
      case default
        map%parameter = 0
        bounds = [0.0_wp, 1.0_wp]
      end select
    end associate
    map%parameter_scale = abs(bounds(2) - bounds(1))
    bounds = bounds/map%parameter_scale
    call create_map(bearing, map)
  end subroutine set_map

  !> The parameter at an orbit, in words.
  function value_words(map, x) result(words)
    type(period_map_type), intent(in) :: map !! the map
    real(wp), intent(in) :: x(:) !! the orbit's point [1]
    character(len=:), allocatable :: words
    real(wp) :: value

    value = parameter_of(map, x)
    select case (map%parameter)
    case (moved_speed)
      words = text(value*30.0_wp/pi, 7)//' rpm'
    case (moved_unbalance)
      words = 'unbalance '//text(value, 6)//' kg m'
    case (moved_mass)
      words = 'mass '//text(value, 6)//' kg'
    case default
      words = text(map%drive%speed*30.0_wp/pi, 7)//' rpm'
    end select
  end function value_words

  !> Another value of the parameter, in words.
  function words_at(map, x, parameter) result(words)
    type(period_map_type), intent(in) :: map !! the map
    real(wp), intent(in) :: x(:) !! any point [1]
    real(wp), intent(in) :: parameter !! as points have it [1]
    character(len=:), allocatable :: words

    words = value_words(map, [x(:size(x) - 1), parameter])
  end function words_at

  !> A step along the branch, not beyond the bounds of the parameter.
  function step_within(bounds, now, rate, step, at_bound) result(taken)
    real(wp), intent(in) :: bounds(2) !! of the parameter of a point [1]
    real(wp), intent(in) :: now, rate !! of the parameter: its value, and its change along the branch [1]
    real(wp), intent(in) :: step !! along the branch [1]
    logical, intent(out) :: at_bound !! the step ends there
    real(wp) :: taken, low, high

    low = minval(bounds)
    high = maxval(bounds)
    taken = step
    if (now + rate*step > high) taken = (high - now)/rate
    if (now + rate*step < low) taken = (low - now)/rate
    at_bound = now + rate*step > high .or. now + rate*step < low
  end function step_within
end module gfb_scene_map
