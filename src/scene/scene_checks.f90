!> All rules between the groups of a scene, called in one place.
module gfb_scene_checks
  use gfb_accuracy_case, only: check_accuracy
  use gfb_assembly_rules, only: check_assembly, check_crest_gaps, check_bump_sizes
  use gfb_branch_key_rules, only: check_edge_lift, check_turn_folds, check_load_angles
  use gfb_capacity_rules, only: check_capacity
  use gfb_case_keys, only: case_keys_type
  use gfb_count_rules, only: check_counts
  use gfb_dynamics_case, only: check_dynamics
  use gfb_own_strip_rules, only: check_own_strips
  use gfb_pads_rules, only: check_pads
  use gfb_foil_mass_case, only: check_foil_mass
  use gfb_periodic_rules, only: check_periodic
  use gfb_rotor_case, only: check_rotor
  use gfb_sample_rules, only: check_sample
  use gfb_scene, only: scene_type
  use gfb_scene_rules, only: check_shell_bearing, check_sweep, check_foundation, check_half_width, &
                             check_rigid_position, check_strip, check_plates, &
                             check_friction_memory, check_stability, check_restart, &
                             check_linear_solver
  use gfb_shaft_contact_case, only: check_shaft_contact
  use gfb_shape_rules, only: check_shape
  use gfb_transient_rules, only: check_transient
  implicit none (type, external)
  private
  public :: check_groups

contains

  !> Checks what the groups ask of each other.
  subroutine check_groups(keys, scene)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(scene_type), intent(in) :: scene !! what the case file asks for

    call check_sweep(keys, scene%sweep, scene%operation, scene%general%analysis, &
                     scene%shaft_contact%present)
    call check_shaft_contact(keys, scene%shaft_contact, scene%model, scene%operation, scene%sweep, &
                             scene%general%analysis)
    call check_friction_memory(keys, scene%sweep, scene%model, scene%contact)
    call check_foundation(keys, scene%model)
    call check_half_width(keys, scene%model, scene%mesh, scene%operation, scene%sweep)
    call check_rigid_position(keys, scene%model, scene%bearing, scene%operation, scene%sweep)
    call check_dynamics(keys, scene%dynamics, scene%operation, scene%model, &
                        scene%contact%may_rub, scene%contact%law_in_motion(), scene%sweep, &
                        scene%accuracy%present)
    call check_pads(keys, scene%bearing, scene%operation)
    call check_foil_mass(keys, scene%dynamics, scene%transient, scene%model, scene%top_foil, &
                         scene%bump_foil)
    call check_rotor(keys, scene%rotor, scene%operation, scene%sweep, scene%dynamics%present)
    call check_strip(keys, scene%bump_foil, scene%mesh, scene%modes, scene%general%analysis, &
                     scene%model)
    call check_shell_bearing(keys, scene%bump_foil, scene%bearing, scene%model, &
                             scene%general%analysis)
    call check_crest_gaps(keys, scene)
    call check_bump_sizes(keys, scene)
    call check_own_strips(keys, scene)
    call check_plates(keys, scene%strip_load, scene%general%analysis)
    call check_assembly(keys, scene)
    call check_edge_lift(keys, scene%operation, scene%model, scene%top_foil, scene%general%analysis)
    call check_turn_folds(keys, scene%sweep, scene%model)
    call check_load_angles(keys, scene%sweep)
    call check_stability(keys, scene%solver, scene%model, scene%general%analysis)
    call check_restart(keys, scene%output, scene%general%analysis, &
                       scene%sweep%present .or. scene%transient%present)
    call check_linear_solver(keys, scene%solver, scene%model, scene%general%analysis)
    call check_accuracy(keys, scene%accuracy, scene%sweep, scene%output, scene%general%analysis, &
                        scene%dynamics%present)
    call check_capacity(keys, scene%capacity, scene%operation, scene%model, scene%solver, &
                        scene%sweep, scene%accuracy, scene%shaft_contact%present)
    call check_sample(keys, scene)
    call check_transient(keys, scene%transient, scene%operation, scene%rotor, scene%model, &
                         scene%general%analysis)
    call check_periodic(keys, scene%periodic, scene%operation, scene%rotor, scene%model, &
                        scene%contact%may_rub)
    call check_shape(keys, scene)
    call check_counts(keys, scene)
  end subroutine check_groups
end module gfb_scene_checks
