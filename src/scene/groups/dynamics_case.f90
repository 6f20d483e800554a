!> `&dynamics`: frequencies at which stiffness and damping are asked for, and what foils do then.
module gfb_dynamics_case
  use gfb_kinds, only: wp
  use gfb_case_keys, only: case_keys_type, longest_list
  use gfb_contact_law, only: law_tanh_reset
  use gfb_foil_motion_keys, only: mass_auto, mass_words, foil_modes_words, most_foil_modes, &
                                  read_maxwell_keys, check_maxwell_keys
  use gfb_maxwell_arm, only: maxwell_arm_type
  use gfb_model_case, only: model_case_type, coupling_partitioned, foil_elastic_foundation, &
                            foil_rigid, meshes_foils
  use gfb_operation_case, only: operation_case_type, angular_speed
  use gfb_scene_case, only: analysis_linear_dynamics, analysis_equilibrium, &
                            analysis_fixed_position, analysis_transient, analysis_periodic, &
                            asks_limit, misplaced_group
  use gfb_sweep_case, only: sweep_case_type, sweep_speed
  use gfb_value_rules, only: from_to, positive, not_negative
  implicit none (type, external)
  private
  public :: dynamics_case_type, read_dynamics_case, check_dynamics, analysis_of_state, &
            frequencies_at

  integer, parameter, public :: tangent_stick = 1 !! contacts that rub stick under vibration
  integer, parameter, public :: tangent_slip = 2  !! they slide on as they did
  character(len=*), parameter :: tangent_words(*) = [character(len=5) :: 'stick', 'slip']

  !> What is asked for.
  type :: dynamics_case_type
    logical :: present = .false.              !! the analysis is 'linear_dynamics'
    real(wp), allocatable :: frequencies(:)   !! [rad/s]
    real(wp), allocatable :: ratios(:)        !! the same over the speed of the shaft, or none [1]
    integer :: contact_tangent = tangent_stick
    real(wp) :: loss_factor = 0.0_wp          !! eta of the foil's stiffness [1]
    real(wp) :: foundation_damping = 0.0_wp   !! viscous, of the elastic foundation [N s/m^3]
    type(maxwell_arm_type) :: arm             !! beside the springs of the elastic foundation
    integer :: foil_mass = mass_auto
    integer :: foil_modes = 2                 !! kept inside each condensed bump
    real(wp), allocatable :: amplitudes(:)    !! of the shaft; contacts slide to and fro [m]
    logical :: stability = .true.             !! critical mass and modes too; not a key
  end type dynamics_case_type

contains

  !> The analysis that finds the state about which the shaft vibrates, or from which it
  !> moves: a given load is balanced, else the given position is kept. A limit is one of
  !> equilibria. The group `&operation` is not read yet.
  pure function analysis_of_state(analysis, has_load, has_position) result(state)
    integer, intent(in) :: analysis !! of the case file, 0 where it is not known
    logical, intent(in) :: has_load, has_position !! keys that `&operation` holds
    integer :: state

    state = analysis
    if (asks_limit(analysis) .or. analysis == analysis_periodic) state = analysis_equilibrium
    if (analysis /= analysis_linear_dynamics .and. analysis /= analysis_transient) return
    state = analysis_equilibrium
    if (has_position .and. .not. has_load) state = analysis_fixed_position
  end function analysis_of_state

  !> Reads the group. Frequencies over the speed become frequencies.
  subroutine read_dynamics_case(keys, dynamics, operation, analysis)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(dynamics_case_type), intent(out) :: dynamics !! what `&dynamics` asks for
    type(operation_case_type), intent(in) :: operation !! what `&operation` asks for
    integer, intent(in) :: analysis !! of the case file, 0 where it is not known

    dynamics%present = analysis == analysis_linear_dynamics
    call keys%start_group('dynamics', required=dynamics%present, optional=.not. dynamics%present, &
                          misplaced=misplaced_group(analysis, dynamics%present))
    call keys%real_list_key('frequencies', dynamics%frequencies, longest_list, 'rad/s', &
                            'circular frequencies at which stiffness and damping are asked for', &
                            positive, .false., 'required without `frequency_ratios`')
    call keys%real_list_key('frequency_ratios', dynamics%ratios, longest_list, '1', &
                            'the same over the speed of the shaft', positive, .false., &
                            'required without `frequencies`')
    dynamics%frequencies = frequencies_at(dynamics, angular_speed(operation%speed_rpm))
    call keys%choice_key('contact_tangent', dynamics%contact_tangent, tangent_words, &
                         'what contacts that rub do under a small vibration: stick, as those '// &
                         'do that it has shaken down, or slide on as when they were loaded')
    call keys%real_key('loss_factor', dynamics%loss_factor, '1', &
                       'loss factor of the foil: its stiffness times 1 + i loss_factor', &
                       not_negative)
    call keys%real_key('foundation_damping', dynamics%foundation_damping, 'N s/m^3', &
                       'viscous damping of the elastic foundation, pressure over velocity', &
                       not_negative)
    call read_maxwell_keys(keys, dynamics%arm)
    call keys%choice_key('foil_mass', dynamics%foil_mass, mass_words, &
                         'whether top foil and bumps have their mass: where the frequencies '// &
                         'ask for it, always, never')
    call keys%integer_key('foil_modes', dynamics%foil_modes, foil_modes_words, &
                          from_to(0.0_wp, most_foil_modes))
    call keys%real_list_key('vibration_amplitudes', dynamics%amplitudes, longest_list, 'm', &
                            'amplitudes of the shaft along x and along y at which stiffness '// &
                            'and damping are asked for too, contacts sliding to and fro', &
                            positive, .false., 'none: small ones alone')
    call keys%finish_group()
  end subroutine read_dynamics_case

  !> The frequencies at a speed of the shaft.
  pure function frequencies_at(dynamics, speed) result(frequencies)
    type(dynamics_case_type), intent(in) :: dynamics !! what `&dynamics` asks for
    real(wp), intent(in) :: speed !! of the shaft [rad/s]
    real(wp), allocatable :: frequencies(:) !! [rad/s]

    frequencies = dynamics%frequencies
    if (size(dynamics%ratios) > 0) frequencies = dynamics%ratios*speed
  end function frequencies_at

  !> One key gives the frequencies; those over the speed need one.
  subroutine check_frequencies(keys, operation)
    type(case_keys_type), intent(inout) :: keys
    type(operation_case_type), intent(in) :: operation
    character(len=*), parameter :: group = 'dynamics', name = 'frequencies', &
                                   ratios = 'frequency_ratios'

    if (keys%meant(group, name) .and. keys%meant(group, ratios)) then
      call keys%complain(group, ratios, 'has no use beside frequencies: give one of them')
    else if (keys%meant(group, ratios)) then
      if (keys%meant('operation', 'speed_rpm') .and. .not. operation%speed_rpm > 0.0_wp) then
        call keys%complain(group, ratios, 'needs a shaft that turns: give frequencies')
      end if
    else if (.not. keys%meant(group, name)) then
      call keys%complain('scene', 'analysis', 'needs frequencies or frequency_ratios in &dynamics')
    end if
  end subroutine check_frequencies

  !> What the rest of the scene allows.
  subroutine check_dynamics(keys, dynamics, operation, model, may_rub, friction_law, sweep, &
                            refines)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(dynamics_case_type), intent(in) :: dynamics !! what `&dynamics` asks for
    type(operation_case_type), intent(in) :: operation !! what `&operation` asks for
    type(model_case_type), intent(in) :: model !! what `&model` asks for
    logical, intent(in) :: may_rub !! a friction coefficient of `&contact` is positive
    integer, intent(in) :: friction_law !! of motions: `law_tanh_drag`, ...
    type(sweep_case_type), intent(in) :: sweep !! what `&sweep` asks for
    logical, intent(in) :: refines !! the scene asks for an accuracy

    if (.not. dynamics%present) return
    call check_frequencies(keys, operation)
    if (refines) call check_refinement(keys, dynamics, model)
    if (sweep%parameter == sweep_speed .and. keys%meant('dynamics', 'frequency_ratios') .and. &
        any(.not. sweep%values > 0.0_wp)) then
      call keys%complain('dynamics', 'frequency_ratios', 'needs a shaft that turns '// &
                         'at every point of the sweep: give frequencies')
    end if
    call check_model(keys, dynamics, model)
    if (keys%meant('dynamics', 'vibration_amplitudes')) then
      call check_amplitudes(keys, dynamics, model, may_rub, friction_law, sweep)
    end if
  end subroutine check_dynamics

  !> What meshes of different fineness can be compared in.
  subroutine check_refinement(keys, dynamics, model)
    type(case_keys_type), intent(inout) :: keys
    type(dynamics_case_type), intent(in) :: dynamics
    type(model_case_type), intent(in) :: model

    if (keys%meant('dynamics', 'vibration_amplitudes')) then
      call keys%complain('dynamics', 'vibration_amplitudes', 'has no error estimate: leave '// &
                         '&accuracy out and give the mesh')
    end if
    if (model%foil == 0) return
    if (meshes_foils(model%foil) .and. dynamics%foil_mass == mass_auto) then
      call keys%complain('dynamics', 'foil_mass', "must be 'on' or 'off' with &accuracy: "// &
                         "'auto' may choose differently on each mesh")
    end if
  end subroutine check_refinement

  !> Where amplitudes of the shaft count.
  subroutine check_amplitudes(keys, dynamics, model, may_rub, friction_law, sweep)
    type(case_keys_type), intent(inout) :: keys
    type(dynamics_case_type), intent(in) :: dynamics
    type(model_case_type), intent(in) :: model
    logical, intent(in) :: may_rub
    integer, intent(in) :: friction_law
    type(sweep_case_type), intent(in) :: sweep
    character(len=*), parameter :: group = 'dynamics', name = 'vibration_amplitudes'

    if (sweep%present) then
      call keys%complain(group, name, 'needs a scene of one answer, without &sweep')
    end if
    if (dynamics%contact_tangent /= tangent_stick) then
      call keys%complain(group, name, "needs contact_tangent = 'stick': contacts that have "// &
                         'shaken down are their limit')
    end if
    if (model%foil == 0) return
    if (.not. meshes_foils(model%foil)) then
      call keys%complain(group, name, "needs foil = 'shell' in &model, or 'beam': nothing else "// &
                         'rubs')
    else if (.not. may_rub) then
      call keys%complain(group, name, 'needs friction: give friction_top or friction_sleeve in '// &
                         '&contact')
    else if (friction_law == law_tanh_reset) then
      call keys%complain(group, name, "needs another friction_law than 'tanh_reset' in "// &
                         "&contact, or friction_law_in_motion = 'coulomb': that one never "// &
                         'shakes down')
    end if
  end subroutine check_amplitudes

  !> What foils and the way of solving allow.
  subroutine check_model(keys, dynamics, model)
    type(case_keys_type), intent(inout) :: keys
    type(dynamics_case_type), intent(in) :: dynamics
    type(model_case_type), intent(in) :: model

    if (model%foil == 0) return
    if (model%coupling == coupling_partitioned) then
      call keys%complain('model', 'coupling', "must be 'monolithic' with analysis = "// &
                         "'linear_dynamics': film and foil vibrate together")
    end if
    if (keys%meant('dynamics', 'contact_tangent') .and. .not. meshes_foils(model%foil)) then
      call keys%complain('dynamics', 'contact_tangent', "needs foil = 'shell' in &model, or "// &
                         "'beam': nothing else rubs")
    end if
    if (dynamics%loss_factor > 0.0_wp .and. model%foil == foil_rigid) then
      call keys%complain('dynamics', 'loss_factor', "has no use with foil = 'rigid': nothing "// &
                         'deflects')
    end if
    if (dynamics%foundation_damping > 0.0_wp .and. model%foil /= foil_elastic_foundation) then
      call keys%complain('dynamics', 'foundation_damping', &
                         "needs foil = 'elastic_foundation' in &model")
    end if
    call check_maxwell_keys(keys, 'dynamics', model%foil == foil_elastic_foundation)
  end subroutine check_model
end module gfb_dynamics_case
