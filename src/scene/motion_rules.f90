!> What a scene must have, and cannot have, where something moves: a shaft that vibrates, that is
!> followed over time, or that goes round an orbit which closes.
module gfb_motion_rules
  use gfb_kinds, only: wp
  use gfb_case_keys, only: case_keys_type
  use gfb_contact_law, only: law_tanh_reset
  use gfb_motion_cases, only: tangent_stick, mass_auto, mass_on, mass_off, motion_free, &
                              follow_nothing, follow_speed, follow_unbalance, follow_mass, &
                              duration_of, fewest_steps
  use gfb_model_case, only: needs_meshes, coupling_partitioned, half_width_yes, reduction_none, &
                            springs_two_sided
  use gfb_operation_case, only: angular_speed
  use gfb_scene, only: scene_type, foil_density
  use gfb_study_cases, only: derives_vibrations, of_whirl
  use gfb_sweep_case, only: sweep_speed, sweep_tilt_x, sweep_tilt_y
  use gfb_text, only: text
  implicit none (type, external)
  private
  public :: check_dynamics, check_foil_mass, check_rotor, check_transient, check_periodic

  real(wp), parameter :: least_steps = 20.0_wp !! of a pulse [1]
  character(len=*), parameter :: unused_where_free = "has no use with motion = 'free'"

contains

  !> Checks a scene that asks for vibrations.
  subroutine check_dynamics(keys, scene)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(scene_type), intent(in) :: scene !! what the case file asks for
    character(len=*), parameter :: group = 'dynamics'
    logical :: frequencies, ratios, amplitudes

    associate (asked => scene%dynamics, model => scene%model, sweep => scene%sweep)
      call check_derived_whirl(keys, scene)
      call keys%rule(group, 'response_speeds', keys%meant(group, 'response_speeds') .and. &
                     size(scene%unbalance%position) == 0, &
                     'needs &unbalance: what moves the machine')
      if (.not. asked%present) return
      frequencies = keys%meant(group, 'frequencies')
      ratios = keys%meant(group, 'frequency_ratios')
      amplitudes = keys%meant(group, 'vibration_amplitudes')
      call keys%rule(group, 'frequency_ratios', frequencies .and. ratios, &
                     'has no use beside frequencies: give one of them')
      call keys%rule(group, 'frequency_ratios', ratios .and. .not. frequencies .and. &
                     stands_still(keys, scene), 'needs a shaft that turns: give frequencies')
      call keys%rule('scene', 'analysis', .not. (frequencies .or. ratios), &
                     'needs frequencies or frequency_ratios in &dynamics')
      if (scene%accuracy%present) then
        call keys%rule(group, 'vibration_amplitudes', amplitudes, &
                       'has no error estimate: leave &accuracy out and give the mesh')
        call keys%rule(group, 'foil_mass', model%foil%has_top_foil .and. &
                       scene%foil_damping%foil_mass == mass_auto, "must be 'on' or 'off' with "// &
                       "&accuracy, in &foil_damping: 'auto' may choose differently on each mesh")
      end if
      if (sweep%parameter == sweep_speed .and. ratios) then
        call keys%rule(group, 'frequency_ratios', any(.not. sweep%values > 0.0_wp), &
                       'needs a shaft that turns at every point of the sweep: give frequencies')
      end if
      if (model%foil%is_known()) then
        call keys%rule('model', 'coupling', model%coupling == coupling_partitioned, &
                       "must be 'monolithic' with analysis = 'linear_dynamics': film and foil "// &
                       'vibrate together')
        call keys%refuse(group, 'contact_tangent', .not. model%foil%has_bumps, &
                         needs_meshes//'nothing else rubs')
        call keys%rule(group, 'loss_factor', asked%loss_factor > 0.0_wp .and. &
                       .not. model%foil%deflects, "has no use with foil = 'rigid': nothing "// &
                       'deflects')
        call check_damping(keys, scene)
      end if
      if (amplitudes) call check_amplitudes(keys, scene)
      if (asked%interpolation_tolerance > 0.0_wp) call check_interpolation(keys, scene)
    end associate
  end subroutine check_dynamics

  !> Where frequencies can be put between those given: how many is known afterwards alone.
  subroutine check_interpolation(keys, scene)
    type(case_keys_type), intent(inout) :: keys
    type(scene_type), intent(in) :: scene
    character(len=*), parameter :: group = 'dynamics', name = 'interpolation_tolerance'
    logical :: rising

    associate (given => scene%dynamics%frequencies, n => size(scene%dynamics%frequencies))
      rising = n > 1
      if (rising) rising = all(given(2:) > given(:n - 1))
    end associate
    call keys%rule(group, name, .not. rising, &
                   'needs two frequencies or more, each larger than the one before')
    call keys%rule(group, name, scene%sweep%present, &
                   'needs a scene of one answer, without &sweep')
    call keys%rule(group, name, scene%accuracy%present, 'cannot stand beside &accuracy: all '// &
                   'meshes must have the same frequencies')
    call keys%refuse(group, 'vibration_amplitudes', .true., 'cannot stand beside '//name// &
                     ': every amplitude is solved at every frequency')
  end subroutine check_interpolation

  !> Where results of small vibrations in `&sensitivity` have derivatives.
  subroutine check_derived_whirl(keys, scene)
    type(case_keys_type), intent(inout) :: keys
    type(scene_type), intent(in) :: scene
    character(len=*), parameter :: group = 'sensitivity', name = 'quantity'

    if (.not. derives_vibrations(scene%sensitivity)) return
    call keys%rule(group, name, .not. scene%dynamics%present, 'names a result of small '// &
                   "vibrations, which needs analysis = 'linear_dynamics' and &dynamics")
    call keys%rule(group, name, scene%dynamics%present .and. &
                   scene%sensitivity%asks(of_whirl) .and. stands_still(keys, scene), &
                   'names a result of whirl, which needs a shaft that turns')
  end subroutine check_derived_whirl

  !> Where amplitudes of the shaft count.
  subroutine check_amplitudes(keys, scene)
    type(case_keys_type), intent(inout) :: keys
    type(scene_type), intent(in) :: scene
    character(len=*), parameter :: group = 'dynamics', name = 'vibration_amplitudes'

    call keys%rule(group, name, scene%sweep%present, &
                   'needs a scene of one answer, without &sweep')
    call keys%rule(group, name, scene%dynamics%contact_tangent /= tangent_stick, 'needs '// &
                   "contact_tangent = 'stick': contacts that have shaken down are their limit")
    if (.not. scene%model%foil%is_known()) return
    if (.not. scene%model%foil%has_bumps) then
      call keys%complain(group, name, needs_meshes//'nothing else rubs')
    else if (.not. scene%contact%may_rub) then
      call keys%complain(group, name, 'needs friction: give friction_top or friction_sleeve in '// &
                         '&contact')
    else if (scene%contact%law_in_motion() == law_tanh_reset) then
      call keys%complain(group, name, "needs another friction_law than 'tanh_reset' in "// &
                         "&contact, or friction_law_in_motion = 'coulomb': that one never "// &
                         'shakes down')
    end if
  end subroutine check_amplitudes

  !> Dampers and Maxwell arms stand beside the springs of an elastic foundation; meshed foils have
  !> a loss factor at a frequency. Springs that open lose nothing while they are open: no matrix.
  subroutine check_damping(keys, scene)
    type(case_keys_type), intent(inout) :: keys
    type(scene_type), intent(in) :: scene
    character(len=*), parameter :: group = 'foil_damping', stiffness = 'maxwell_stiffness', &
                                   time = 'maxwell_time'
    character(len=*), parameter :: on_springs = "needs foil = 'elastic_foundation' in &model"
    character(len=*), parameter :: loss = 'loss_factor', frequency = 'loss_frequency'
    logical :: loses

    call keys%rule(group, 'foundation_damping', .not. scene%model%foil%has_foundation .and. &
                   scene%foil_damping%foundation_damping > 0.0_wp, on_springs)
    call keys%refuse(group, stiffness, .not. keys%meant(group, time), &
                     'needs '//time//' beside it')
    call keys%refuse(group, time, .not. keys%meant(group, stiffness), &
                     'needs '//stiffness//' beside it')
    call keys%refuse(group, stiffness//', '//time, &
                     scene%model%foil%is_known() .and. .not. &
                     scene%model%foil%has_foundation, on_springs)
    loses = scene%foil_damping%loss_factor > 0.0_wp
    call keys%rule(group, loss, loses .and. .not. keys%meant(group, frequency), 'needs '// &
                   frequency//' beside it: at which frequency foils have it')
    call keys%refuse(group, frequency, .not. keys%holds(group, loss), &
                     'has no use without '//loss//' beside it')
    call keys%rule('dynamics', loss, loses .and. scene%dynamics%loss_factor > 0.0_wp, &
                   'has no use beside '//loss//' in &foil_damping: give one of them')
    associate (model => scene%model)
      call keys%rule(group, loss, loses .and. model%foil%is_known() .and. .not. &
                     model%foil%has_top_foil, "needs foil = 'shell' in &model, 'beam' or "// &
                     "'plate': springs of a foundation have foundation_damping")
      call keys%rule(group, loss, loses .and. model%foil%has_crest_springs .and. &
                     model%crest_springs /= springs_two_sided, 'needs crest_springs = '// &
                     "'two_sided' in &model: one that opens loses nothing while it is open")
    end associate
  end subroutine check_damping

  !> The keys of the foil's mass have a use, and the foils a density.
  subroutine check_foil_mass(keys, scene)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(scene_type), intent(in) :: scene !! what the case file asks for
    character(len=*), parameter :: group = 'foil_damping'

    if (.not. scene%model%foil%is_known()) return
    if (.not. (scene%transient%present .or. scene%dynamics%present)) return
    associate (wanted => scene%foil_damping%foil_mass)
      if (keys%meant(group, 'foil_mass') .and. .not. scene%model%foil%has_top_foil) then
        call keys%complain(group, 'foil_mass', needs_meshes//'no other foil has a mass')
      else
        call keys%rule(group, 'foil_mass', wanted == mass_on .and. &
                       .not. foil_density(scene) > 0.0_wp, 'needs the density of both foils: '// &
                       'give density in &top_foil and in &bump_foil; a plate has but &top_foil')
      end if
      if (.not. scene%model%foil%has_shell_bumps .or. scene%model%reduction == reduction_none) then
        call keys%refuse(group, 'foil_modes', .true., "needs foil = 'shell' and condensed "// &
                         'bumps in &model: nothing else has modes of its own inside')
      else
        call keys%refuse(group, 'foil_modes', wanted == mass_off, &
                         "has no use with foil_mass = 'off'")
      end if
    end associate
  end subroutine check_foil_mass

  !> Checks a scene with a rotor. Conical modes need bearings that mirror each other.
  subroutine check_rotor(keys, scene)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(scene_type), intent(in) :: scene !! what the case file asks for
    character(len=*), parameter :: group = 'rotor', polar = 'polar_inertia', &
                                   transverse = 'transverse_inertia', distance = 'bearing_distance'
    logical :: tilts, apart

    if (.not. scene%rotor%present) return
    tilts = keys%meant(group, transverse)
    apart = keys%meant(group, distance)
    call keys%rule(group, 'mass', scene%dynamics%present .and. stands_still(keys, scene) .and. &
                   .not. (scene%feed%present .and. scene%bearing%row%has_sectors), &
                   'needs a shaft that turns: nothing whirls at rest')
    call keys%refuse(group, polar, .not. tilts, 'has no use without transverse_inertia: a '// &
                     'rotor that does not tilt has no gyroscopic torque')
    call keys%rule(group, transverse, tilts .and. .not. apart, &
                   'needs bearing_distance: a rotor tilts on two bearings')
    call keys%rule(group, distance, apart .and. .not. tilts, &
                   'needs transverse_inertia: that of a rotor which tilts on two bearings')
    call keys%rule(group, polar, tilts .and. &
                   scene%rotor%polar_inertia > 2.0_wp*scene%rotor%transverse_inertia, &
                   'must not be larger than twice transverse_inertia: no body has more')
    call keys%refuse(group, distance, any(abs(scene%operation%tilt) > 0.0_wp) .or. &
                     any(scene%sweep%parameter == [sweep_tilt_x, sweep_tilt_y]), 'needs an '// &
                     'aligned shaft: with a tilt the two bearings do not mirror each other')
  end subroutine check_rotor

  !> Checks a scene with `&transient`.
  subroutine check_transient(keys, scene)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(scene_type), intent(in) :: scene !! what the case file asks for
    character(len=*), parameter :: group = 'transient'

    associate (transient => scene%transient)
      if (.not. transient%present) return
      call keys%rule(group, 'turns', &
                     keys%meant(group, 'turns') .eqv. keys%meant(group, 'duration'), &
                     'or duration must say how long: give one of them')
      call keys%refuse(group, 'time_tolerance', keys%meant(group, 'steps_per_turn'), &
                       'has no use with steps_per_turn')
      call keys%refuse(group, 'turns', &
                       .not. max(scene%operation%speed_rpm, transient%final_speed_rpm) > 0.0_wp, &
                       'needs a shaft that turns: give duration')
      call keys%refuse(group, 'field_start', .not. transient%field_interval > 0.0_wp, &
                       'has no use without field_interval')
      if (scene%general%asked%is_machine) then
        call keys%refuse(group, 'couple_pulse', .not. keys%meant(group, 'pulse_position'), &
                         'needs pulse_position: where on the shaft it acts')
        call keys%refuse(group, 'pulse_position', .not. (keys%meant(group, 'pulse') .or. &
                         keys%meant(group, 'couple_pulse')), 'has no use without pulse')
      else
        call check_shaft(keys, scene)
      end if
      call check_pulse_and_base(keys, scene)
      call check_ends(keys, scene)
      call check_steps(keys, scene)
      call check_neighbours(keys, scene, group, ': final_speed_rpm in &transient changes the '// &
                            'speed over the time')
    end associate
  end subroutine check_transient

  !> A shaft that bears a load has a mass, and finds its orbit itself; one whose place is given
  !> feels no force. A rotor that tilts needs the whole width of its bearings, and what turns it
  !> needs such a rotor.
  subroutine check_shaft(keys, scene)
    type(case_keys_type), intent(inout) :: keys
    type(scene_type), intent(in) :: scene
    character(len=*), parameter :: group = 'transient'
    character(len=*), parameter :: couples = 'couple_unbalance, couple_unbalance_angle'
    character(len=*), parameter :: needs_tilt = 'needs transverse_inertia and bearing_distance '// &
                                   'in &rotor: a rotor that tilts on two bearings'
    character(len=*), parameter :: needs_force = 'needs a load in &operation, and a mass in &rotor'
    logical :: tilts

    if (.not. scene%general%analysis%floats) then
      call keys%rule(group, 'orbit_radius', keys%meant(group, 'orbit_radius') .neqv. &
                     keys%meant(group, 'orbit_frequency'), 'and orbit_frequency need each other')
      call keys%refuse('rotor', 'mass', .true., 'has no use where the place of the shaft is given')
      call keys%refuse(group, 'start_load, pulse, couple_pulse, base_time, steady_tolerance, '// &
                       'largest_orbit', .true., needs_force)
      call keys%refuse('unbalance', 'unbalance, '//couples, .true., needs_force)
      return
    end if
    tilts = keys%meant('rotor', 'bearing_distance')
    call keys%rule('scene', 'analysis', .not. scene%rotor%present, "'transient' needs the mass "// &
                   'of the shaft, in &rotor; without one give an eccentricity, and its orbit, '// &
                   'for the load')
    call keys%refuse(group, 'orbit_radius, orbit_frequency', .true., &
                     'needs an eccentricity in &operation instead of a load')
    call keys%rule('model', 'half_width', tilts .and. scene%model%half_width == half_width_yes, &
                   "must not be 'yes' where a rotor tilts on two bearings over time")
    call keys%refuse('unbalance', couples, .not. tilts, needs_tilt)
    call keys%refuse(group, 'couple_pulse', .not. tilts, needs_tilt)
  end subroutine check_shaft

  !> A pulse has a length, a table its columns.
  subroutine check_pulse_and_base(keys, scene)
    type(case_keys_type), intent(inout) :: keys
    type(scene_type), intent(in) :: scene
    character(len=*), parameter :: group = 'transient'
    logical :: pushed

    pushed = keys%meant(group, 'pulse') .or. keys%meant(group, 'couple_pulse')
    call keys%rule(group, 'pulse_length', pushed .and. .not. keys%meant(group, 'pulse_length'), &
                   'must be given with pulse or couple_pulse')
    call keys%refuse(group, 'pulse_start, pulse_length', .not. pushed, 'has no use without pulse')
    call keys%refuse(group, 'ramp_time', .not. scene%transient%speed_changes, &
                     'has no use without final_speed_rpm')
    associate (time => scene%transient%base_time, along_x => scene%transient%base_acceleration_x, &
               along_y => scene%transient%base_acceleration_y)
      call keys%rule(group, 'base_acceleration_x', all(size(along_x) /= [0, size(time)]), &
                     'must have as many values as base_time')
      call keys%rule(group, 'base_acceleration_y', all(size(along_y) /= [0, size(time)]), &
                     'must have as many values as base_time')
      call keys%rule(group, 'base_time', any(time(2:) <= time(:size(time) - 1)), &
                     'must rise from value to value')
      call keys%rule(group, 'base_time', size(time) == 1, 'must have two times at least')
      call keys%rule(group, 'base_time', size(time) > 0 .and. size(along_x) + size(along_y) == 0, &
                     'has no use without base_acceleration_x or base_acceleration_y')
    end associate
  end subroutine check_pulse_and_base

  !> What drives the shaft does so before the run ends.
  subroutine check_ends(keys, scene)
    type(case_keys_type), intent(inout) :: keys
    type(scene_type), intent(in) :: scene
    character(len=*), parameter :: group = 'transient'
    real(wp), parameter :: rounding = 1.0e-9_wp !! of times, over them [1]
    real(wp) :: end_time !! [s]

    associate (transient => scene%transient, speed => scene%operation%speed_rpm)
      if (.not. min(speed, transient%final_speed_rpm) >= 0.0_wp) return
      if (.not. (transient%duration > 0.0_wp .or. (transient%turns > 0.0_wp .and. &
                 max(speed, transient%final_speed_rpm) > 0.0_wp))) return
      end_time = duration_of(transient, scene%operation)
      if (.not. end_time < huge(end_time)) then
        call keys%complain(group, 'turns', 'are never reached: the shaft stands still before; '// &
                           'give duration')
        return
      end if
      call keys%refuse(group, 'pulse_start', .not. transient%pulse_start < end_time, &
                       'must lie before the end of the run, '//text(end_time, 6)//' s')
      call keys%refuse(group, 'ramp_time', transient%ramp_time > (1.0_wp + rounding)*end_time, &
                       'must not be longer than the run, '//text(end_time, 6)//' s')
    end associate
  end subroutine check_ends

  !> Steps resolve a turn; longer ones are for a slow push, where nothing turns with the shaft.
  subroutine check_steps(keys, scene)
    type(case_keys_type), intent(inout) :: keys
    type(scene_type), intent(in) :: scene
    real(wp) :: speed, steps, fewest
    logical :: slow

    fewest = fewest_steps(scene%transient%time_method)
    associate (transient => scene%transient)
      if (.not. transient%steps_per_turn > 0.0_wp .or. &
          transient%steps_per_turn >= fewest) return
      speed = max(angular_speed(scene%operation%speed_rpm), &
                  angular_speed(transient%final_speed_rpm))
      steps = transient%pulse_length*speed/angular_speed(60.0_wp)*transient%steps_per_turn
      slow = steps >= least_steps .and. size(transient%base_time) == 0 .and. .not. &
             max(scene%unbalance%static, scene%unbalance%couple, transient%orbit_radius) > 0.0_wp
      call keys%rule('transient', 'steps_per_turn', .not. slow, 'must be at least '// &
                     text(nint(fewest))//': fewer steps do not resolve a turn; or give a '// &
                     'pulse alone, of 20 steps or more')
    end associate
  end subroutine check_steps

  !> What cannot stand beside a motion in steps of time, and what foils have then.
  subroutine check_neighbours(keys, scene, analysis, instead)
    type(case_keys_type), intent(inout) :: keys
    type(scene_type), intent(in) :: scene
    character(len=*), intent(in) :: analysis
    character(len=*), intent(in) :: instead !! of a sweep
    character(len=:), allocatable :: useless

    useless = "has no use with analysis = '"//analysis//"'"
    call keys%refuse('sweep', 'parameter', .true., useless//instead)
    call keys%refuse('accuracy', 'quantity', .true., useless)
    call keys%refuse('sample', 'count', .true., useless)
    call keys%refuse('sensitivity', 'quantity', .true., useless)
    call keys%rule('model', 'coupling', scene%model%coupling == coupling_partitioned, &
                   "must be 'monolithic' with analysis = '"//analysis//"': film, foil and "// &
                   'shaft take their steps together')
    call check_damping(keys, scene)
  end subroutine check_neighbours

  !> Checks a scene with `&periodic`.
  subroutine check_periodic(keys, scene)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(scene_type), intent(in) :: scene !! what the case file asks for
    character(len=*), parameter :: group = 'periodic'

    associate (periodic => scene%periodic)
      if (.not. periodic%present) return
      if (scene%general%asked%is_machine) then
        call keys%rule('machine', 'speed_rpm', keys%meant('machine', 'speed_rpm') .and. &
                       .not. scene%machine%speed_rpm > 0.0_wp, &
                       "must be positive with analysis = 'periodic'")
      else
        call keys%rule('operation', 'speed_rpm', stands_still(keys, scene), &
                       "must be positive with analysis = 'periodic'")
        call keys%rule('scene', 'analysis', .not. scene%rotor%present, &
                       "'periodic' needs the mass of the shaft, in &rotor")
        call keys%refuse('rotor', 'bearing_distance', scene%rotor%present, 'has no use with '// &
                         "analysis = 'periodic': the shaft moves in x and y alone")
      end if
      call check_branch(keys, scene)
      call keys%rule('model', 'foil', scene%model%foil%has_bumps .and. &
                     scene%contact%may_rub .and. (periodic%motion == motion_free .or. &
                     periodic%parameter /= follow_nothing), 'needs friction_top and '// &
                     "friction_sleeve of 0 with motion = 'free', and with parameter: where "// &
                     'contacts stick, orbits lie side by side, and are no branch')
      call check_neighbours(keys, scene, group, ': parameter in &periodic follows the orbits')
      call keys%refuse('output', 'restart_every', .true., "has no use with analysis = 'periodic'")
    end associate
  end subroutine check_periodic

  !> A forced motion has its unbalance, a free one none. A branch has an end, which is not its
  !> beginning.
  subroutine check_branch(keys, scene)
    type(case_keys_type), intent(inout) :: keys
    type(scene_type), intent(in) :: scene
    character(len=*), parameter :: group = 'periodic', end_key = 'final_value'
    real(wp) :: begin
    logical :: free

    associate (periodic => scene%periodic, parameter => scene%periodic%parameter)
      free = periodic%motion == motion_free
      call keys%refuse(group, 'period_turns, start_turns', free, unused_where_free)
      call keys%refuse(group, 'first_amplitude', .not. free, "needs motion = 'free'")
      if (scene%general%asked%is_machine) then
        call check_drive_of_machine(keys, scene, free, begin)
      else
        call check_drive_of_bearing(keys, scene, free, begin)
      end if
      if (parameter == follow_nothing) then
        call keys%refuse(group, 'final_value, points, step', .true., &
                         "needs a parameter other than 'none'")
      else if (.not. keys%meant(group, end_key)) then
        call keys%complain(group, end_key, 'must be given with parameter')
      else if (.not. abs(periodic%final_value - begin) > 0.0_wp) then
        call keys%complain(group, end_key, 'must differ from where the parameter begins')
      else
        call keys%rule(group, end_key, parameter /= follow_unbalance .and. &
                       .not. periodic%final_value > 0.0_wp, 'must be positive')
      end if
    end associate
  end subroutine check_branch

  !> What drives the shaft of one bearing, and what may be followed; and where that begins.
  subroutine check_drive_of_bearing(keys, scene, free, begin)
    type(case_keys_type), intent(inout) :: keys
    type(scene_type), intent(in) :: scene
    logical, intent(in) :: free !! the motion
    real(wp), intent(out) :: begin !! of the parameter, as its key has it
    character(len=*), parameter :: group = 'periodic'

    associate (parameter => scene%periodic%parameter)
      call keys%refuse('unbalance', 'unbalance, unbalance_angle', free, unused_where_free)
      call keys%rule(group, 'parameter', free .and. all(parameter /= [0, follow_speed, &
                     follow_mass]), "must be 'speed_rpm' or 'mass' with motion = 'free': the "// &
                     'limit cycles are followed from the onset of whirl on')
      call keys%rule(group, 'unbalance', .not. (free .or. keys%meant(group, 'unbalance') .or. &
                     parameter == follow_unbalance), &
                     "must be given with motion = 'forced', in &unbalance")
      begin = scene%operation%speed_rpm
      if (parameter == follow_unbalance) begin = scene%unbalance%static
      if (parameter == follow_mass) begin = scene%rotor%mass
    end associate
  end subroutine check_drive_of_bearing

  !> The same of a machine: its speed moves, or all its unbalances do in proportion to the first.
  subroutine check_drive_of_machine(keys, scene, free, begin)
    type(case_keys_type), intent(inout) :: keys
    type(scene_type), intent(in) :: scene
    logical, intent(in) :: free !! the motion
    real(wp), intent(out) :: begin !! of the parameter, as its key has it
    character(len=*), parameter :: group = 'periodic'

    associate (parameter => scene%periodic%parameter, unbalance => scene%unbalance%value)
      call keys%refuse('unbalance', 'positions, values, angles', free, unused_where_free)
      call keys%rule(group, 'parameter', free .and. all(parameter /= [0, follow_speed]), &
                     "must be 'speed_rpm' with motion = 'free': the limit cycles of a machine "// &
                     'are followed from the onset of whirl on')
      call keys%rule(group, 'parameter', parameter == follow_mass .and. .not. free, &
                     "must be 'speed_rpm' or 'unbalance' beside &shaft")
      call keys%rule('unbalance', 'values', .not. free .and. &
                     .not. any(unbalance > 0.0_wp), "must be given with motion = 'forced'")
      begin = scene%machine%speed_rpm
      if (parameter /= follow_unbalance .or. size(unbalance) == 0) return
      begin = unbalance(1)
      call keys%rule('unbalance', 'values', .not. begin > 0.0_wp, 'must begin with one above '// &
                     "0: parameter = 'unbalance' follows that, and the others in proportion")
    end associate
  end subroutine check_drive_of_machine

  !> Whether the file says that the shaft does not turn.
  logical function stands_still(keys, scene) result(still)
    type(case_keys_type), intent(in) :: keys
    type(scene_type), intent(in) :: scene
    still = keys%meant('operation', 'speed_rpm') .and. .not. scene%operation%speed_rpm > 0.0_wp
  end function stands_still
end module gfb_motion_rules
