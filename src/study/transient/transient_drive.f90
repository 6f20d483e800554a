!> What drives the shaft of a scene over time, and how its steps are chosen.
module gfb_transient_drive
  use gfb_kinds, only: wp
  use gfb_scene, only: scene_type
  use gfb_operation_case, only: angular_speed
  use gfb_transient_case, only: duration_of
  use gfb_shaft_drive, only: shaft_drive_type
  use gfb_time_march, only: march_settings_type
  implicit none (type, external)
  private
  public :: drive_of, settings_of

contains

  !> How the steps of a scene are chosen.
  pure function settings_of(scene) result(settings)
    type(scene_type), intent(in) :: scene !! with `&transient`
    type(march_settings_type) :: settings

    settings%steps_per_turn = scene%transient%steps_per_turn
    settings%tolerance = scene%transient%time_tolerance
    settings%damping = scene%transient%foundation_damping
    settings%arm = scene%transient%arm
    settings%end_time = duration_of(scene%transient, scene%operation)
  end function settings_of

  !> What drives the shaft of a scene: of a rotor that tilts what each of two bearings carries
  !> counts twice.
  pure function drive_of(scene) result(drive)
    type(scene_type), intent(in) :: scene !! with `&transient`
    type(shaft_drive_type) :: drive
    real(wp) :: bearings

    drive%bearing_distance = scene%rotor%distance_in_time
    bearings = merge(2.0_wp, 1.0_wp, drive%bearing_distance > 0.0_wp)
    associate (transient => scene%transient)
      drive%mass = bearings*scene%rotor%mass
      drive%transverse_inertia = scene%rotor%transverse_inertia
      drive%polar_inertia = scene%rotor%polar_inertia
      drive%load = bearings*scene%operation%load
      drive%speed = angular_speed(scene%operation%speed_rpm)
      drive%ramp = duration_of(transient, scene%operation)
      if (transient%ramp_time > 0.0_wp) drive%ramp = transient%ramp_time
      drive%acceleration = (angular_speed(transient%final_speed_rpm) - drive%speed)/drive%ramp
      drive%unbalance = bearings*transient%unbalance
      drive%unbalance_angle = transient%unbalance_angle
      drive%couple_unbalance = transient%couple_unbalance
      drive%couple_unbalance_angle = transient%couple_unbalance_angle
      drive%pulse = bearings*transient%pulse
      drive%couple_pulse = transient%couple_pulse
      drive%pulse_start = transient%pulse_start
      drive%pulse_length = transient%pulse_length
      drive%orbit_radius = transient%orbit_radius
      drive%orbit_frequency = transient%orbit_frequency
      if (size(transient%base_time) == 0) return
      drive%base_time = transient%base_time
      allocate (drive%base_acceleration(2, size(drive%base_time)), source=0.0_wp)
      if (size(transient%base_acceleration_x) > 0) then
        drive%base_acceleration(1, :) = transient%base_acceleration_x
      end if
      if (size(transient%base_acceleration_y) > 0) then
        drive%base_acceleration(2, :) = transient%base_acceleration_y
      end if
    end associate
  end function drive_of
end module gfb_transient_drive
