!> One case file as plain values: what was asked, in SI, read group by group.
module gfb_scene
  use gfb_kinds, only: wp
  use gfb_study_cases, only: accuracy_case_type, capacity_case_type, modes_case_type, &
                             output_case_type, sample_case_type, sensitivity_case_type, &
                             read_accuracy_case, read_capacity_case, part_half_arc, part_arc, &
                             read_modes_case, part_top_foil, read_output_case, read_sample_case, &
                             read_sensitivity_case
  use gfb_bearing_case, only: bearing_case_type, bore_case_type, read_bearing_case, &
                              read_pads_case, read_bore_case, read_ramp_case
  use gfb_foil_cases, only: bump_foil_case_type, read_bump_foil_case
  use gfb_top_foil_case, only: top_foil_case_type, read_top_foil_case
  use gfb_contact_case, only: contact_case_type, read_contact_case, read_shaft_contact_case
  use gfb_motion_cases, only: dynamics_case_type, foil_damping_case_type, periodic_case_type, &
                              rotor_case_type, unbalance_case_type, transient_case_type, mass_off, &
                              read_dynamics_case, analysis_of_state, read_foil_damping_case, &
                              read_periodic_case, read_rotor_case, read_unbalance_case, &
                              read_transient_case
  use gfb_feed_case, only: feed_case_type, read_feed_case, follow_heat
  use gfb_groove_case, only: groove_case_type, read_groove_case
  use gfb_gas_case, only: gas_case_type, read_gas_case
  use gfb_mesh_case, only: mesh_case_type, solver_case_type, read_mesh_case, read_solver_case
  use gfb_foil_row, only: foil_row_type, foil_unknown
  use gfb_model_case, only: model_case_type, read_model_case
  use gfb_operation_case, only: operation_case_type, read_operation_case, size_of_gap
  use gfb_analysis_row, only: analysis_row_type, limit_tilt, machine_row
  use gfb_machine_case, only: machine_case_type, read_machine_case, machine_group
  use gfb_scene_case, only: scene_case_type, needs_type, read_scene_case
  use gfb_strip_load_case, only: strip_load_case_type, read_strip_load_case
  use gfb_solid_contact, only: solid_contact_type
  use gfb_sweep_case, only: sweep_case_type, read_sweep_case
  use gfb_thermal_case, only: thermal_case_type, read_thermal_case
  use gfb_case_keys, only: case_keys_type, unless
  implicit none (type, external)
  private
  public :: read_groups, needs_of, foil_density

  !> One scene.
  type, public :: scene_type
    character(len=:), allocatable :: file      !! as the user gave it
    character(len=:), allocatable :: name      !! of the file, without folder and ending
    character(len=:), allocatable :: verbatim  !! text of the file
    character(len=:), allocatable :: echo      !! the same with every value used; can be run again
    character(len=:), allocatable :: warnings  !! of improbable values, one a line
    character(len=:), allocatable :: hints     !! of keys that have moved, one a line
    type(scene_case_type) :: general
    type(machine_case_type), allocatable :: machine !! a shaft in several bearings
    type(bearing_case_type) :: bearing
    type(bore_case_type) :: bore
    type(gas_case_type) :: gas
    type(feed_case_type) :: feed
    type(groove_case_type) :: grooves
    type(thermal_case_type) :: thermal
    type(operation_case_type) :: operation
    type(sweep_case_type) :: sweep
    type(dynamics_case_type) :: dynamics
    type(rotor_case_type) :: rotor
    type(transient_case_type) :: transient
    type(periodic_case_type) :: periodic
    type(unbalance_case_type) :: unbalance
    type(foil_damping_case_type) :: foil_damping
    type(capacity_case_type) :: capacity
    type(sensitivity_case_type) :: sensitivity
    type(accuracy_case_type) :: accuracy
    type(sample_case_type) :: sample
    type(top_foil_case_type) :: top_foil
    type(bump_foil_case_type) :: bump_foil
    type(strip_load_case_type) :: strip_load
    type(contact_case_type) :: contact
    type(solid_contact_type) :: shaft_contact
    type(modes_case_type) :: modes
    type(model_case_type) :: model
    type(mesh_case_type) :: mesh
    type(solver_case_type) :: solver
    type(output_case_type) :: output
  end type scene_type

contains

  !> Reads the groups in the order in which they need each other.
  subroutine read_groups(keys, scene)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(scene_type), intent(inout) :: scene !! gets what they say
    type(needs_type) :: needs !! of the analysis
    character(len=:), allocatable :: misplaced !! why `&bearing` does not fit
    type(analysis_row_type) :: state !! that finds it, where vibrations about a state are asked for

    call read_scene_case(keys, scene%general)
    if (keys%line_of_group(machine_group) > 0) then
      scene%general%asked = machine_row(scene%general%asked)
      scene%general%analysis = scene%general%asked
    end if
    call read_modes_case(keys, scene%modes, scene%general%asked)
    state = analysis_of_state(scene%general%asked, keys%holds('operation', 'load') .or. &
                              keys%holds('operation', 'axial_load'), &
                              keys%holds('operation', 'eccentricity') .or. &
                              keys%holds('operation', 'axial_gap'))
    needs = needs_of(scene%general%asked, scene%modes%part, foil_unknown)
    associate (analysis => scene%general%asked, part => scene%modes%part)
      misplaced = analysis%refusal('bearing')
      ! Foils alone have a pad only where the top foil vibrates.
      if (analysis%finds_modes) misplaced = unless(any(part == [0, part_top_foil]), &
        "needs part = 'top_foil' in &modes: no other part has a pad")
      call read_bearing_case(keys, scene%bearing, needs%pad, needs%film, misplaced)
      call read_model_case(keys, scene%model, scene%bearing%row, analysis)
      needs = needs_of(analysis, part, scene%model%foil)
      call read_pads_case(keys, scene%bearing, analysis%refusal('pads'))
      call read_ramp_case(keys, scene%bearing, analysis%refusal('ramp'))
      call read_bore_case(keys, scene%bore, scene%bearing, analysis%refusal('bore'))
      call read_gas_case(keys, scene%gas, analysis)
      call read_feed_case(keys, scene%feed, scene%gas, scene%bearing, analysis)
      call read_groove_case(keys, scene%grooves, scene%bearing, analysis)
      call read_shaft_contact_case(keys, scene%shaft_contact, analysis)
      call read_operation_case(keys, scene%operation, scene%bearing, state, &
                               scene%shaft_contact%present .or. scene%feed%present)
      if (scene%bearing%row%has_sectors) call size_gap(scene)
      call read_dynamics_case(keys, scene%dynamics, scene%operation, analysis)
      call read_rotor_case(keys, scene%rotor, scene%bearing%row, analysis)
      call read_transient_case(keys, scene%transient, scene%operation, analysis)
      call read_periodic_case(keys, scene%periodic, analysis)
      call read_unbalance_case(keys, scene%unbalance, analysis)
      call read_foil_damping_case(keys, scene%foil_damping, analysis)
      call read_capacity_case(keys, scene%capacity, analysis)
      scene%operation%tilt_is_sought = analysis%limit == limit_tilt
      ! A mass that whirls moves across the axis, and across it alone.
      scene%dynamics%stability = scene%dynamics%stability .and. .not. scene%bearing%row%moves_along
      call read_sweep_case(keys, scene%sweep, analysis)
      if (scene%foil_damping%foil_mass == mass_off) needs%weightless = "foil_mass = 'off'"
      if (.not. scene%dynamics%present) needs%weightless = 'nothing vibrates'
      call read_top_foil_case(keys, scene%top_foil, scene%bearing%row, needs, &
                              scene%model%foil)
      call read_bump_foil_case(keys, scene%bump_foil, scene%bearing, needs, scene%model%foil)
      call read_thermal_case(keys, scene%thermal, scene%gas, scene%bump_foil, &
                             scene%bearing%row, analysis)
      if (scene%thermal%present) then
        call follow_heat(keys, scene%feed, scene%gas, scene%thermal%ambient_temperature)
      end if
      call read_strip_load_case(keys, scene%strip_load, scene%bump_foil%bumps, analysis)
      call read_contact_case(keys, scene%contact, scene%strip_load, scene%bump_foil, &
                             scene%bearing%clearance, analysis, scene%model%foil)
      call read_mesh_case(keys, scene%mesh, scene%bearing, scene%bump_foil, scene%model, &
                          scene%grooves)
      call read_solver_case(keys, scene%solver, scene%bearing, scene%shaft_contact%present, &
                            scene%model%foil%has_shell_bumps)
      call read_output_case(keys, scene%output)
      call read_sensitivity_case(keys, scene%sensitivity, analysis)
      call read_accuracy_case(keys, scene%accuracy, analysis)
      call read_sample_case(keys, scene%sample, analysis%refusal('sample'))
      allocate (scene%machine)
      call read_machine_case(keys, scene%machine, analysis)
      call follow_machine(scene)
    end associate
    scene%general%analysis = state
  end subroutine read_groups

  !> Speed and gravity are those of a machine, where there is one.
  subroutine follow_machine(scene)
    type(scene_type), intent(inout) :: scene

    if (.not. scene%machine%present) then
      deallocate (scene%machine)
      return
    end if
    scene%operation%speed_rpm = scene%machine%speed_rpm
    associate (transient => scene%transient)
      if (.not. transient%speed_changes) transient%final_speed_rpm = scene%machine%speed_rpm
      if (.not. transient%start_gravity_given) transient%start_gravity = scene%machine%gravity
    end associate
  end subroutine follow_machine

  !> Sizes of gaps of a thrust bearing are measured by one of its own: that which is held, or that
  !> of its ramp, its speed, or its supply, whichever is larger.
  pure subroutine size_gap(scene)
    type(scene_type), intent(inout) :: scene

    associate (gas => scene%gas, bearing => scene%bearing)
      bearing%clearance = size_of_gap(bearing, scene%operation, gas%viscosity, &
                                      gas%ambient_pressure)
      if (scene%operation%axial_gap > 0.0_wp) return
      bearing%clearance = max(bearing%clearance, scene%feed%gap_size(gas%viscosity, bearing%length))
    end associate
  end subroutine size_gap

  !> Smallest density of the foils that have a mesh; 0 where one of them has none [kg/m^3].
  pure real(wp) function foil_density(scene) result(density)
    type(scene_type), intent(in) :: scene !! of a bearing

    density = scene%top_foil%density
    if (scene%model%foil%has_bumps) density = min(density, scene%bump_foil%density)
  end function foil_density

  !> What an analysis needs, of foils by a model, or of modes of a part.
  pure function needs_of(analysis, part, foil) result(needs)
    type(analysis_row_type), intent(in) :: analysis !! of the case file
    integer, intent(in) :: part !! 0 where it is not known
    type(foil_row_type), intent(in) :: foil !! the model of the foils
    type(needs_type) :: needs
    logical :: modes, meshed

    modes = analysis%finds_modes .and. part /= 0
    meshed = analysis%has_film .and. foil%has_bumps
    needs%film = analysis%has_film
    needs%top_mass = modes .and. part == part_top_foil
    needs%pad = needs%film .or. needs%top_mass
    needs%top_foil = needs%top_mass .or. (needs%film .and. foil%has_top_foil)
    needs%mass = modes .and. part /= part_top_foil
    needs%width = needs%mass .or. analysis%loads_strip
    needs%bumps = needs%width .or. meshed
    needs%pitch = needs%width .and. .not. (modes .and. any(part == [part_half_arc, part_arc]))
  end function needs_of

end module gfb_scene
