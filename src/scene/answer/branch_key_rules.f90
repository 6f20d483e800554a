!> What keys that choose and follow branches of equilibria ask of the rest of a scene.
module gfb_branch_key_rules
  use gfb_kinds, only: wp
  use gfb_case_keys, only: case_keys_type
  use gfb_model_case, only: model_case_type, meshes_foils, coupling_partitioned
  use gfb_operation_case, only: operation_case_type
  use gfb_scene_case, only: analysis_equilibrium
  use gfb_sweep_case, only: sweep_case_type, sweep_load_angle
  use gfb_top_foil_case, only: top_foil_case_type, top_foil_trailing
  implicit none (type, external)
  private
  public :: check_edge_lift, check_turn_folds, check_load_angles

contains

  !> A branch can be asked for by the lift of an edge that is free to lift.
  subroutine check_edge_lift(keys, operation, model, top_foil, analysis)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(operation_case_type), intent(in) :: operation !! what `&operation` asks for
    type(model_case_type), intent(in) :: model !! what `&model` asks for
    type(top_foil_case_type), intent(in) :: top_foil !! what `&top_foil` asks for
    integer, intent(in) :: analysis  !! 0 where it is not known
    character(len=:), allocatable :: problem

    problem = ''
    if (analysis /= analysis_equilibrium) then
      problem = "needs analysis = 'equilibrium'"
    else if (.not. meshes_foils(model%foil)) then
      problem = "needs foil = 'shell' in &model, or 'beam': no other foil has an edge that lifts"
    else if (top_foil%fixed_edge /= top_foil_trailing) then
      problem = "needs fixed_edge = 'trailing' in &top_foil: a fixed edge does not lift"
    else if (model%coupling == coupling_partitioned) then
      problem = "needs coupling = 'monolithic' in &model"
    end if
    if (problem == '' .or. analysis == 0 .or. model%foil == 0) return
    if (size(operation%leading_edge_lift) > 0) then
      call keys%complain('operation', 'leading_edge_lift', problem)
    end if
    if (size(operation%leading_edge_lift_edge) > 0) then
      call keys%complain('operation', 'leading_edge_lift_edge', problem)
    end if
  end subroutine check_edge_lift

  !> A branch is followed round its folds between two values, with all its points in equilibrium.
  subroutine check_turn_folds(keys, sweep, model)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(sweep_case_type), intent(in) :: sweep !! what `&sweep` asks for
    type(model_case_type), intent(in) :: model !! what `&model` asks for
    real(wp), allocatable :: change(:)

    if (.not. sweep%turn_folds) return
    if (sweep%friction_memory) then
      call keys%complain('sweep', 'turn_folds', 'has no use beside friction_memory: what slid '// &
                         'must not depend on the path round a fold')
    end if
    if (sweep%parameter == sweep_load_angle) then
      call keys%complain('sweep', 'turn_folds', 'has no use with parameter = ''load_angle'': '// &
                         'between two angles the load goes straight, not round')
    end if
    if (model%coupling == coupling_partitioned) then
      call keys%complain('sweep', 'turn_folds', "needs coupling = 'monolithic' in &model")
    end if
    if (.not. allocated(sweep%values)) return
    if (size(sweep%values) == 1) then
      call keys%complain('sweep', 'turn_folds', 'needs two values at least, the ends of the path')
    else if (size(sweep%values) > 1) then
      change = sweep%values(2:) - sweep%values(:size(sweep%values) - 1)
      if (any(change*change(1) <= 0.0_wp)) then
        call keys%complain('sweep', 'values', 'must all rise or all fall with turn_folds')
      end if
    end if
  end subroutine check_turn_folds

  !> Between two angles the load goes straight, and must not come near zero.
  subroutine check_load_angles(keys, sweep)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(sweep_case_type), intent(in) :: sweep !! what `&sweep` asks for
    real(wp), parameter :: circle = 360.0_wp, farthest = 90.0_wp !! [deg]
    integer :: point

    if (sweep%parameter /= sweep_load_angle .or. .not. allocated(sweep%values)) return
    do point = 2, size(sweep%values)
      associate (turn => modulo(sweep%values(point) - sweep%values(point - 1), circle))
        if (min(turn, circle - turn) <= farthest) cycle
      end associate
      call keys%complain('sweep', 'values', 'must be within 90 degrees of the angle before: '// &
                         'between them the load goes straight', point)
    end do
  end subroutine check_load_angles
end module gfb_branch_key_rules
