!> One case file as plain values: what was asked, in SI.
module gfb_scene
  use gfb_accuracy_case, only: accuracy_case_type
  use gfb_bearing_case, only: bearing_case_type
  use gfb_bore_case, only: bore_case_type
  use gfb_bump_foil_case, only: bump_foil_case_type
  use gfb_capacity_case, only: capacity_case_type
  use gfb_contact_case, only: contact_case_type
  use gfb_dynamics_case, only: dynamics_case_type
  use gfb_foil_damping_case, only: foil_damping_case_type
  use gfb_gas_case, only: gas_case_type
  use gfb_mesh_case, only: mesh_case_type
  use gfb_model_case, only: model_case_type
  use gfb_modes_case, only: modes_case_type
  use gfb_operation_case, only: operation_case_type
  use gfb_output_case, only: output_case_type
  use gfb_periodic_case, only: periodic_case_type
  use gfb_rotor_case, only: rotor_case_type, unbalance_case_type
  use gfb_sample_case, only: sample_case_type
  use gfb_scene_case, only: scene_case_type
  use gfb_sensitivity_case, only: sensitivity_case_type
  use gfb_shaft_contact_case, only: shaft_contact_case_type
  use gfb_solver_case, only: solver_case_type
  use gfb_strip_load_case, only: strip_load_case_type
  use gfb_sweep_case, only: sweep_case_type
  use gfb_top_foil_case, only: top_foil_case_type
  use gfb_transient_case, only: transient_case_type
  implicit none (type, external)
  private

  !> One scene.
  type, public :: scene_type
    character(len=:), allocatable :: file      !! as the user gave it
    character(len=:), allocatable :: name      !! of the file, without folder and ending
    character(len=:), allocatable :: verbatim  !! text of the file
    character(len=:), allocatable :: echo      !! the same with every value used; can be run again
    character(len=:), allocatable :: warnings  !! of values that are hardly meant, one a line
    character(len=:), allocatable :: hints     !! of keys that have moved, one a line
    type(scene_case_type) :: general
    type(bearing_case_type) :: bearing
    type(bore_case_type) :: bore
    type(gas_case_type) :: gas
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
    type(shaft_contact_case_type) :: shaft_contact
    type(modes_case_type) :: modes
    type(model_case_type) :: model
    type(mesh_case_type) :: mesh
    type(solver_case_type) :: solver
    type(output_case_type) :: output
  end type scene_type
end module gfb_scene
