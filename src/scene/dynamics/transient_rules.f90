!> What a scene must have, and cannot have, where a shaft is followed over time.
module gfb_transient_rules
  use gfb_kinds, only: wp
  use gfb_case_keys, only: case_keys_type
  use gfb_maxwell_keys, only: check_maxwell_keys
  use gfb_model_case, only: model_case_type, coupling_partitioned, foil_elastic_foundation, &
                            half_width_yes
  use gfb_operation_case, only: operation_case_type, angular_speed
  use gfb_rotor_case, only: rotor_case_type
  use gfb_scene_case, only: analysis_equilibrium
  use gfb_text, only: text
  use gfb_transient_case, only: transient_case_type, duration_of
  implicit none (type, external)
  private
  public :: check_transient

  character(len=*), parameter :: group = 'transient'
  real(wp), parameter :: least_steps = 20.0_wp !! of a turn, or of a pulse [1]

contains

  !> Checks a scene with `&transient`.
  subroutine check_transient(keys, transient, operation, rotor, model, state)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(transient_case_type), intent(in) :: transient !! what `&transient` asks for
    type(operation_case_type), intent(in) :: operation !! what `&operation` asks for
    type(rotor_case_type), intent(in) :: rotor !! what `&rotor` says
    type(model_case_type), intent(in) :: model !! what `&model` asks for
    integer, intent(in) :: state !! analysis that finds where the shaft begins

    if (.not. transient%present) return
    if (keys%meant(group, 'turns') .eqv. keys%meant(group, 'duration')) then
      call keys%complain(group, 'turns', 'or duration must say how long: give one of them')
    end if
    if (keys%meant(group, 'steps_per_turn') .and. keys%meant(group, 'time_tolerance')) then
      call keys%complain(group, 'time_tolerance', 'has no use with steps_per_turn')
    end if
    if (keys%meant(group, 'turns') .and. .not. &
        max(operation%speed_rpm, transient%final_speed_rpm) > 0.0_wp) then
      call keys%complain(group, 'turns', 'needs a shaft that turns: give duration')
    end if
    if (keys%meant(group, 'field_start') .and. .not. transient%field_interval > 0.0_wp) then
      call keys%complain(group, 'field_start', 'has no use without field_interval')
    end if
    if (state == analysis_equilibrium) then
      call check_free_shaft(keys, rotor)
      call check_tilts(keys, model)
    else
      call check_given_orbit(keys)
    end if
    call check_pulse_and_base(keys, transient)
    call check_ends(keys, transient, operation)
    call check_steps(keys, transient, operation)
    call check_neighbours(keys, transient, model)
  end subroutine check_transient

  !> A shaft that bears a load has a mass, and finds its orbit itself.
  subroutine check_free_shaft(keys, rotor)
    type(case_keys_type), intent(inout) :: keys
    type(rotor_case_type), intent(in) :: rotor

    if (.not. rotor%present) then
      call keys%complain('scene', 'analysis', "'transient' needs the mass of the shaft, in "// &
                         '&rotor; without one give an eccentricity, and its orbit, for the load')
    end if
    call refuse(keys, 'orbit_radius', 'needs an eccentricity in &operation instead of a load')
    call refuse(keys, 'orbit_frequency', 'needs an eccentricity in &operation instead of a load')
  end subroutine check_free_shaft

  !> A rotor that tilts needs the whole width of its bearings, and what turns it needs such a rotor.
  subroutine check_tilts(keys, model)
    type(case_keys_type), intent(inout) :: keys
    type(model_case_type), intent(in) :: model
    character(len=*), parameter :: rigid = 'needs transverse_inertia and bearing_distance in '// &
                                           '&rotor: a rotor that tilts on two bearings'

    if (keys%meant('rotor', 'bearing_distance')) then
      if (model%half_width == half_width_yes) then
        call keys%complain('model', 'half_width', "must not be 'yes' where a rotor tilts "// &
                           'on two bearings over time')
      end if
      return
    end if
    call refuse(keys, 'couple_unbalance', rigid)
    call refuse(keys, 'couple_unbalance_angle', rigid)
    call refuse(keys, 'couple_pulse', rigid)
  end subroutine check_tilts

  !> A shaft whose place is given feels no force.
  subroutine check_given_orbit(keys)
    type(case_keys_type), intent(inout) :: keys
    character(len=*), parameter :: free = 'needs a load in &operation, and a mass in &rotor'

    if (keys%meant(group, 'orbit_radius') .neqv. keys%meant(group, 'orbit_frequency')) then
      call keys%complain(group, 'orbit_radius', 'and orbit_frequency need each other')
    end if
    if (keys%meant('rotor', 'mass')) then
      call keys%complain('rotor', 'mass', 'has no use where the place of the shaft is given')
    end if
    call refuse(keys, 'start_load', free)
    call refuse(keys, 'unbalance', free)
    call refuse(keys, 'couple_unbalance', free)
    call refuse(keys, 'couple_unbalance_angle', free)
    call refuse(keys, 'pulse', free)
    call refuse(keys, 'couple_pulse', free)
    call refuse(keys, 'base_time', free)
    call refuse(keys, 'steady_tolerance', free)
    call refuse(keys, 'largest_orbit', free)
  end subroutine check_given_orbit

  !> Complains about a key that is given.
  subroutine refuse(keys, name, words)
    type(case_keys_type), intent(inout) :: keys
    character(len=*), intent(in) :: name, words

    if (keys%meant(group, name)) call keys%complain(group, name, words)
  end subroutine refuse

  !> A pulse has a length, a table its columns.
  subroutine check_pulse_and_base(keys, transient)
    type(case_keys_type), intent(inout) :: keys
    type(transient_case_type), intent(in) :: transient
    logical :: pushed

    pushed = keys%meant(group, 'pulse') .or. keys%meant(group, 'couple_pulse')
    if (pushed .and. .not. keys%meant(group, 'pulse_length')) then
      call keys%complain(group, 'pulse_length', 'must be given with pulse or couple_pulse')
    end if
    if (.not. pushed) then
      call refuse(keys, 'pulse_start', 'has no use without pulse')
      call refuse(keys, 'pulse_length', 'has no use without pulse')
    end if
    if (keys%meant(group, 'ramp_time') .and. .not. transient%speed_changes) then
      call refuse(keys, 'ramp_time', 'has no use without final_speed_rpm')
    end if
    call check_column(keys, 'base_acceleration_x', size(transient%base_acceleration_x), &
                      size(transient%base_time))
    call check_column(keys, 'base_acceleration_y', size(transient%base_acceleration_y), &
                      size(transient%base_time))
    associate (time => transient%base_time)
      if (any(time(2:) <= time(:size(time) - 1))) then
        call keys%complain(group, 'base_time', 'must rise from value to value')
      end if
      if (size(time) == 1) call keys%complain(group, 'base_time', 'must have two times at least')
      if (size(time) > 0 .and. size(transient%base_acceleration_x) == 0 .and. &
          size(transient%base_acceleration_y) == 0) then
        call keys%complain(group, 'base_time', &
                           'has no use without base_acceleration_x or base_acceleration_y')
      end if
    end associate
  end subroutine check_pulse_and_base

  !> What drives the shaft does so before the run ends.
  subroutine check_ends(keys, transient, operation)
    type(case_keys_type), intent(inout) :: keys
    type(transient_case_type), intent(in) :: transient
    type(operation_case_type), intent(in) :: operation
    real(wp), parameter :: rounding = 1.0e-9_wp !! of times, over them [1]
    real(wp) :: slowest, end_time

    slowest = min(operation%speed_rpm, transient%final_speed_rpm)
    if (.not. slowest >= 0.0_wp .or. .not. has_end(transient, operation)) return
    end_time = duration_of(transient, operation)
    if (.not. end_time < huge(end_time)) then
      call keys%complain(group, 'turns', 'are never reached: the shaft stands still before; '// &
                         'give duration')
      return
    end if
    if (keys%meant(group, 'pulse_start') .and. .not. transient%pulse_start < end_time) then
      call keys%complain(group, 'pulse_start', 'must lie before the end of the run, '// &
                         text(end_time, 6)//' s')
    end if
    if (keys%meant(group, 'ramp_time') .and. &
        transient%ramp_time > (1.0_wp + rounding)*end_time) then
      call keys%complain(group, 'ramp_time', 'must not be longer than the run, '// &
                         text(end_time, 6)//' s')
    end if
  end subroutine check_ends

  !> Whether the case file says how long a run takes.
  pure logical function has_end(transient, operation)
    type(transient_case_type), intent(in) :: transient
    type(operation_case_type), intent(in) :: operation

    has_end = transient%duration > 0.0_wp .or. &
      (transient%turns > 0.0_wp .and. &
       max(operation%speed_rpm, transient%final_speed_rpm) > 0.0_wp)
  end function has_end

  !> Steps resolve a turn; longer ones are for a slow push, where nothing turns with the shaft.
  subroutine check_steps(keys, transient, operation)
    type(case_keys_type), intent(inout) :: keys
    type(transient_case_type), intent(in) :: transient
    type(operation_case_type), intent(in) :: operation
    real(wp) :: speed, steps
    logical :: slow

    if (.not. transient%steps_per_turn > 0.0_wp .or. transient%steps_per_turn >= least_steps) return
    speed = max(angular_speed(operation%speed_rpm), angular_speed(transient%final_speed_rpm))
    steps = transient%pulse_length*speed/angular_speed(60.0_wp)*transient%steps_per_turn
    slow = steps >= least_steps .and. .not. max(transient%unbalance, transient%couple_unbalance, &
                                                transient%orbit_radius) > 0.0_wp
    if (slow .and. size(transient%base_time) == 0) return
    call keys%complain(group, 'steps_per_turn', 'must be at least 20: fewer steps do not '// &
                       'resolve a turn; or give a pulse alone, of 20 steps or more')
  end subroutine check_steps

  !> A column of the table has a value a time, or none at all.
  subroutine check_column(keys, name, values, times)
    type(case_keys_type), intent(inout) :: keys
    character(len=*), intent(in) :: name
    integer, intent(in) :: values, times

    if (values > 0 .and. values /= times) then
      call keys%complain(group, name, 'must have as many values as base_time')
    end if
  end subroutine check_column

  !> What cannot stand beside `&transient`.
  subroutine check_neighbours(keys, transient, model)
    type(case_keys_type), intent(inout) :: keys
    type(transient_case_type), intent(in) :: transient
    type(model_case_type), intent(in) :: model
    character(len=*), parameter :: useless = "has no use with analysis = 'transient'"

    if (keys%meant('sweep', 'parameter')) then
      call keys%complain('sweep', 'parameter', useless//': final_speed_rpm in &transient '// &
                         'changes the speed over the time')
    end if
    if (keys%meant('accuracy', 'quantity')) call keys%complain('accuracy', 'quantity', useless)
    if (keys%meant('sample', 'count')) call keys%complain('sample', 'count', useless)
    if (keys%meant('sensitivity', 'quantity')) then
      call keys%complain('sensitivity', 'quantity', useless)
    end if
    if (model%coupling == coupling_partitioned) then
      call keys%complain('model', 'coupling', "must be 'monolithic' with analysis = "// &
                         "'transient': film, foil and shaft take their steps together")
    end if
    if (transient%foundation_damping > 0.0_wp .and. model%foil /= foil_elastic_foundation) then
      call keys%complain(group, 'foundation_damping', &
                         "needs foil = 'elastic_foundation' in &model")
    end if
    call check_maxwell_keys(keys, group, any(model%foil == [0, foil_elastic_foundation]))
  end subroutine check_neighbours
end module gfb_transient_rules
