!> `&transient`: a shaft over time.
module gfb_transient_case
  use gfb_kinds, only: wp
  use gfb_case_keys, only: case_keys_type, any_value, not_negative, positive
  use gfb_operation_case, only: operation_case_type, angular_speed
  use gfb_scene_case, only: analysis_transient, misplaced_group
  implicit none (type, external)
  private
  public :: transient_case_type, read_transient_case, duration_of

  real(wp), parameter :: pi = acos(-1.0_wp)
  integer, parameter :: longest_table = 100000

  !> What is asked for.
  type :: transient_case_type
    logical :: present = .false.           !! the analysis is 'transient'
    real(wp) :: turns = 0.0_wp             !! to be computed; 0: `duration` says it [1]
    real(wp) :: duration = 0.0_wp          !! the same [s]
    real(wp) :: steps_per_turn = 0.0_wp    !! 0: the error chooses them [1]
    real(wp) :: time_tolerance = 1.0e-5_wp !! error of a step over the clearance, then [1]
    real(wp) :: start_load(2) = 0.0_wp     !! whose equilibrium the shaft begins with [N]
    logical :: start_load_given = .false.  !! else that of `&operation`
    real(wp) :: final_speed_rpm = 0.0_wp   !! [rpm]
    logical :: speed_changes = .false.     !! to that one
    real(wp) :: ramp_time = 0.0_wp         !! in which it is reached; 0: the whole time [s]
    real(wp) :: pulse(2) = 0.0_wp          !! [N s]
    real(wp) :: couple_pulse(2) = 0.0_wp   !! [N m s]
    real(wp) :: pulse_start = 0.0_wp       !! [s]
    real(wp) :: pulse_length = 0.0_wp      !! [s]
    real(wp), allocatable :: base_time(:)           !! [s]
    real(wp), allocatable :: base_acceleration_x(:) !! [m/s^2]
    real(wp), allocatable :: base_acceleration_y(:) !! [m/s^2]
    real(wp) :: orbit_radius = 0.0_wp       !! of a sleeve whose position is given [m]
    real(wp) :: orbit_frequency = 0.0_wp    !! [rad/s]
    integer :: output_every = 1             !! steps
    real(wp) :: field_interval = 0.0_wp     !! between stored fields; 0: the last ones alone [s]
    real(wp) :: field_start = 0.0_wp        !! first of these times [s]
    real(wp) :: steady_tolerance = 0.0_wp   !! 0: all turns are computed [1]
    real(wp) :: largest_orbit = 0.0_wp      !! 0: however large [m]
  end type transient_case_type

contains

  !> Reads the group.
  subroutine read_transient_case(keys, transient, operation, analysis)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(transient_case_type), intent(out) :: transient !! what `&transient` asks for
    type(operation_case_type), intent(in) :: operation !! what `&operation` asks for
    integer, intent(in) :: analysis !! of the case file, 0 where it is not known

    transient%present = analysis == analysis_transient
    call keys%start_group('transient', required=transient%present, &
                          optional=.not. transient%present, &
                          misplaced=misplaced_group(analysis, transient%present))
    call read_times(keys, transient)
    call read_drive(keys, transient, operation)
    call keys%real_key('orbit_radius', transient%orbit_radius, 'm', &
                       'radius of the circle on which a sleeve moves whose eccentricity is '// &
                       'given: it begins at +x from there', not_negative)
    call keys%real_key('orbit_frequency', transient%orbit_frequency, 'rad/s', &
                       'circular frequency of that motion, with the shaft''s sense', any_value)
    call keys%integer_key('output_every', transient%output_every, &
                          'steps from one line of the history to the next', positive)
    call keys%real_key('field_interval', transient%field_interval, 's', &
                       'time from one stored film and foil to the next, each at the step that '// &
                       'reaches it; 0: those of the end alone', not_negative)
    call keys%real_key('field_start', transient%field_start, 's', 'first of these times', &
                       not_negative)
    call keys%real_key('steady_tolerance', transient%steady_tolerance, '1', &
                       'a steady orbit is asked for: ends when two turns of the shaft differ '// &
                       'by no more than this part of the clearance, and has not reached it '// &
                       'where the time is over before; 0: all of the time', not_negative)
    call keys%real_key('largest_orbit', transient%largest_orbit, 'm', &
                       'ends when the shaft has left its first position by more, in either '// &
                       'bearing; 0: never', &
                       not_negative)
  end subroutine read_transient_case

  !> How long, in which steps.
  subroutine read_times(keys, transient)
    type(case_keys_type), intent(inout) :: keys
    type(transient_case_type), intent(inout) :: transient

    call keys%real_key('turns', transient%turns, '1', 'turns of the shaft that are computed', &
                       positive, default='required without `duration`')
    call keys%real_key('duration', transient%duration, 's', 'the same as a time', positive, &
                       default='required without `turns`')
    call keys%real_key('steps_per_turn', transient%steps_per_turn, '1', &
                       'steps of a turn of the shaft, all equal; default: the error chooses '// &
                       'them, 60 and more', positive, default='by the error')
    call keys%real_key('time_tolerance', transient%time_tolerance, '1', &
                       'error of a step in the position of the shaft, over the clearance, '// &
                       'where it chooses the steps', positive)
  end subroutine read_times

  !> What drives the shaft.
  subroutine read_drive(keys, transient, operation)
    type(case_keys_type), intent(inout) :: keys
    type(transient_case_type), intent(inout) :: transient
    type(operation_case_type), intent(in) :: operation

    transient%start_load = operation%load
    call keys%real_vector_key('start_load', transient%start_load, 'N', &
                              'load whose equilibrium the shaft begins with, x and y; from '// &
                              'then on it bears the load of &operation', &
                              default='load of &operation', given=transient%start_load_given)
    transient%final_speed_rpm = operation%speed_rpm
    call keys%real_key('final_speed_rpm', transient%final_speed_rpm, 'rpm', &
                       'speed to which the shaft runs up, or down, from that of &operation', &
                       not_negative, default='speed of &operation', given=transient%speed_changes)
    call keys%real_key('ramp_time', transient%ramp_time, 's', &
                       'time in which it reaches that speed, evenly', positive, &
                       default='the whole time')
    call keys%real_vector_key('pulse', transient%pulse, 'N s', &
                              'push on the shaft, force times time, x and y: a smooth one; on '// &
                              'two bearings what each of them carries')
    call keys%real_vector_key('couple_pulse', transient%couple_pulse, 'N m s', &
                              'turn of a rotor that tilts on two bearings, torque times time '// &
                              'about x and y, while the push takes')
    call keys%real_key('pulse_start', transient%pulse_start, 's', 'when it begins', not_negative)
    call keys%real_key('pulse_length', transient%pulse_length, 's', 'how long it takes', positive, &
                       default='required with `pulse` and `couple_pulse`')
    call keys%real_list_key('base_time', transient%base_time, longest_table, 's', &
                            'times of a table of the acceleration of the base, rising', &
                            any_value, .false., 'none: the base rests')
    call keys%real_list_key('base_acceleration_x', transient%base_acceleration_x, longest_table, &
                            'm/s^2', 'acceleration of the base along x at these times; linear '// &
                            'in between, none outside', any_value, .false., 'none')
    call keys%real_list_key('base_acceleration_y', transient%base_acceleration_y, longest_table, &
                            'm/s^2', 'the same along y', any_value, .false., 'none')
  end subroutine read_drive

  !> The whole time: as given, or that of the turns while the speed changes [s].
  pure function duration_of(transient, operation) result(duration)
    type(transient_case_type), intent(in) :: transient !! what `&transient` asks for
    type(operation_case_type), intent(in) :: operation !! what `&operation` asks for
    real(wp) :: duration, first, last, angle, rising

    duration = transient%duration
    if (duration > 0.0_wp) return
    first = angular_speed(operation%speed_rpm)
    last = angular_speed(transient%final_speed_rpm)
    angle = 2.0_wp*pi*transient%turns
    associate (ramp => transient%ramp_time)
      if (.not. ramp > 0.0_wp) then
        duration = 2.0_wp*angle/(first + last)
        return
      end if
      rising = 0.5_wp*(first + last)*ramp
      if (angle > rising) then
        duration = ramp + (angle - rising)/last
      else ! while it rises: the smaller root of the parabola
        duration = 2.0_wp*angle/(first + sqrt(first**2 + 2.0_wp*(last - first)/ramp*angle))
      end if
    end associate
  end function duration_of
end module gfb_transient_case
