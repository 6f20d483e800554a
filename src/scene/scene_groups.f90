!> Reads the groups of a case file into a scene.
module gfb_scene_groups
  use gfb_accuracy_case, only: read_accuracy_case
  use gfb_bearing_case, only: read_bearing_case, read_pads_case
  use gfb_bore_case, only: read_bore_case
  use gfb_bump_foil_case, only: read_bump_foil_case
  use gfb_capacity_case, only: read_capacity_case
  use gfb_case_keys, only: case_keys_type
  use gfb_contact_case, only: read_contact_case
  use gfb_dynamics_case, only: read_dynamics_case, analysis_of_state
  use gfb_gas_case, only: read_gas_case
  use gfb_mesh_case, only: read_mesh_case
  use gfb_model_case, only: read_model_case, meshes_foils
  use gfb_modes_case, only: read_modes_case, part_half_arc, part_arc, part_top_foil
  use gfb_operation_case, only: read_operation_case
  use gfb_output_case, only: read_output_case
  use gfb_periodic_case, only: read_periodic_case
  use gfb_rotor_case, only: read_rotor_case
  use gfb_sample_case, only: read_sample_case
  use gfb_scene, only: scene_type
  use gfb_scene_case, only: read_scene_case, is_bearing, misplaced_group, analysis_strip, &
                            analysis_modes, analysis_misalignment
  use gfb_sensitivity_case, only: read_sensitivity_case
  use gfb_shaft_contact_case, only: read_shaft_contact_case
  use gfb_solver_case, only: read_solver_case
  use gfb_strip_load_case, only: read_strip_load_case
  use gfb_sweep_case, only: read_sweep_case
  use gfb_top_foil_case, only: read_top_foil_case
  use gfb_transient_case, only: read_transient_case
  implicit none (type, external)
  private
  public :: read_groups

contains

  !> Reads the groups in the order in which they need each other.
  subroutine read_groups(keys, scene)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(scene_type), intent(inout) :: scene !! gets what they say
    integer :: state !! analysis that finds it, where vibrations about a state are asked for
    logical :: modes !! they are asked for, and of what is known
    logical :: plate !! of the top foil
    logical :: bumps !! the bump foil is meshed
    logical :: both  !! of a bearing: both foils are meshed
    logical :: arc   !! an arc of it alone

    call read_scene_case(keys, scene%general)
    call read_modes_case(keys, scene%modes, scene%general%analysis)
    call read_model_case(keys, scene%model, scene%general%analysis)
    state = analysis_of_state(scene%general%analysis, keys%holds('operation', 'load'), &
                              keys%holds('operation', 'eccentricity'))
    associate (analysis => scene%general%analysis, part => scene%modes%part)
      modes = analysis == analysis_modes .and. part /= 0
      plate = modes .and. part == part_top_foil
      both = is_bearing(analysis) .and. meshes_foils(scene%model%foil)
      bumps = analysis == analysis_strip .or. (modes .and. .not. plate) .or. both
      arc = modes .and. (part == part_half_arc .or. part == part_arc)
      call read_bearing_case(keys, scene%bearing, is_bearing(analysis) .or. plate, &
                             is_bearing(analysis), bearing_misplaced(analysis, part))
      call read_pads_case(keys, scene%bearing, misplaced_group(analysis, is_bearing(analysis)))
      call read_bore_case(keys, scene%bore, scene%bearing, analysis)
      call read_gas_case(keys, scene%gas, analysis)
      call read_shaft_contact_case(keys, scene%shaft_contact, analysis)
      call read_operation_case(keys, scene%operation, state, scene%shaft_contact%present)
      call read_dynamics_case(keys, scene%dynamics, scene%operation, analysis)
      call read_rotor_case(keys, scene%rotor, analysis)
      call read_transient_case(keys, scene%transient, scene%operation, analysis)
      call read_periodic_case(keys, scene%periodic, analysis)
      call read_capacity_case(keys, scene%capacity, analysis)
      scene%operation%tilt_is_sought = analysis == analysis_misalignment
      call read_sweep_case(keys, scene%sweep, analysis)
      call read_foil_groups(keys, scene, modes, plate, bumps, both, arc)
    end associate
    call read_mesh_case(keys, scene%mesh, scene%bearing, scene%bump_foil, scene%model)
    call read_solver_case(keys, scene%solver, scene%bearing, scene%shaft_contact%present)
    call read_study_groups(keys, scene)
    scene%general%analysis = state
  end subroutine read_groups

  !> What is wrong with a group &bearing: foils alone have a pad only where the top foil vibrates.
  pure function bearing_misplaced(analysis, part) result(words)
    integer, intent(in) :: analysis, part !! 0 where they are not known
    character(len=:), allocatable :: words

    words = misplaced_group(analysis, is_bearing(analysis))
    if (analysis /= analysis_modes) return
    words = ''
    if (part /= 0 .and. part /= part_top_foil) then
      words = "needs part = 'top_foil' in &modes: no other part has a pad"
    end if
  end function bearing_misplaced

  !> Reads the groups in the order in which they need each other.
  subroutine read_foil_groups(keys, scene, modes, plate, bumps, both, arc)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(scene_type), intent(inout) :: scene !! gets what they say
    logical, intent(in) :: modes !! they are asked for, and of what is known
    logical, intent(in) :: plate !! of the top foil
    logical, intent(in) :: bumps !! the bump foil is meshed
    logical, intent(in) :: both  !! of a bearing: both foils are meshed
    logical, intent(in) :: arc   !! an arc of it alone

    associate (analysis => scene%general%analysis)
      call read_top_foil_case(keys, scene%top_foil, plate .or. both, plate)
      call read_bump_foil_case(keys, scene%bump_foil, scene%bearing, bumps, modes .and. bumps, &
                               bumps .and. .not. arc .and. .not. both, bumps .and. .not. both)
      call read_strip_load_case(keys, scene%strip_load, scene%bump_foil%bumps, analysis)
      call read_contact_case(keys, scene%contact, scene%strip_load, scene%bump_foil, &
                             scene%bearing%clearance, analysis, scene%model%foil)
    end associate
  end subroutine read_foil_groups

  !> Reads them, behind the groups that say what is computed.
  subroutine read_study_groups(keys, scene)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(scene_type), intent(inout) :: scene !! gets what they say; its analysis is the file's

    call read_output_case(keys, scene%output)
    associate (analysis => scene%general%analysis)
      call read_sensitivity_case(keys, scene%sensitivity, analysis)
      call read_accuracy_case(keys, scene%accuracy, analysis)
      call read_sample_case(keys, scene%sample, &
                            misplaced_group(analysis, analysis /= analysis_modes))
    end associate
  end subroutine read_study_groups
end module gfb_scene_groups
