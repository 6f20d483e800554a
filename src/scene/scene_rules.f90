!> What the groups of a scene ask of each other, all called in one place.
module gfb_scene_rules
  use gfb_kinds, only: wp
  use gfb_accuracy_case, only: check_accuracy
  use gfb_bearing_case, only: bearing_case_type, leading_edge_periodic, pad_angle, pad_turn, &
                              preload_angle, check_pads
  use gfb_bump_foil_case, only: bump_foil_case_type, fixed_edge_none, fixed_edge_trailing, &
                                has_flats, bumps_overlap, has_sizes, one_bump
  use gfb_capacity_case, only: check_capacity
  use gfb_case_keys, only: case_keys_type
  use gfb_contact_case, only: contact_case_type
  use gfb_count_rules, only: check_counts
  use gfb_dynamics_case, only: check_dynamics
  use gfb_fixed_lines, only: fixed_line_corner
  use gfb_foil_motion_keys, only: check_foil_mass
  use gfb_foil_rules, only: check_assembly, check_crest_gaps, check_bump_sizes, check_own_strips
  use gfb_mesh_case, only: mesh_case_type
  use gfb_model_case, only: model_case_type, foil_rigid, foil_elastic_foundation, foil_word, &
                            meshes_foils, half_width_yes, reduction_guyan, coupling_partitioned
  use gfb_modes_case, only: modes_case_type, part_flat, part_strip, part_top_foil
  use gfb_operation_case, only: operation_case_type
  use gfb_output_case, only: output_case_type
  use gfb_periodic_case, only: check_periodic
  use gfb_rotor_case, only: check_rotor
  use gfb_sample_rules, only: check_sample
  use gfb_scene, only: scene_type
  use gfb_scene_case, only: analysis_equilibrium, analysis_fixed_position, analysis_strip, &
                            analysis_modes, is_bearing
  use gfb_shaft_contact_case, only: check_shaft_contact
  use gfb_shape_rules, only: check_shape
  use gfb_solver_case, only: solver_case_type, linear_solver_direct, linear_solver_iterative
  use gfb_strip_load_case, only: strip_load_case_type, load_plates
  use gfb_sweep_case, only: sweep_case_type, operation_at, sweep_keys, sweep_load, sweep_speed, &
                            sweep_load_angle, sweep_tilt_x, sweep_tilt_y, sweep_eccentricity_x, &
                            sweep_eccentricity_y
  use gfb_text, only: join, text
  use gfb_top_foil_case, only: top_foil_case_type, top_foil_trailing
  use gfb_transient_case, only: check_transient
  implicit none (type, external)
  private
  public :: check_groups, is_symmetric

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
    if (scene%transient%present) then
      call check_foil_mass(keys, 'transient', scene%transient%foil_mass, scene%model, &
                           scene%top_foil, scene%bump_foil)
    end if
    if (scene%dynamics%present) then
      call check_foil_mass(keys, 'dynamics', scene%dynamics%foil_mass, scene%model, &
                           scene%top_foil, scene%bump_foil)
    end if
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

  !> A sweep needs an analysis that fits to its parameter.
  subroutine check_sweep(keys, sweep, operation, analysis, may_rest)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(sweep_case_type), intent(in) :: sweep !! what `&sweep` asks for
    type(operation_case_type), intent(in) :: operation !! what `&operation` asks for
    integer, intent(in) :: analysis  !! 0 where it is not known
    logical, intent(in) :: may_rest  !! something else than the film bears the shaft, too
    integer :: point

    if (.not. sweep%present .or. analysis == 0) return
    if (sweep%hold_position .and. analysis /= analysis_equilibrium) then
      call keys%complain('sweep', 'hold_position', "needs analysis = 'equilibrium': it fixes "// &
                         'the shaft at its equilibrium at &operation')
    end if
    select case (sweep%parameter)
    case (sweep_load, sweep_load_angle)
      if (analysis /= analysis_equilibrium .or. sweep%hold_position) then
        call keys%complain('sweep', 'parameter', "needs analysis = 'equilibrium' without "// &
                           'hold_position')
      else if (operation%load_given .and. .not. any(abs(operation%load) > 0.0_wp)) then
        call keys%complain('operation', 'load', 'must not be zero where it is swept: it gives '// &
                           merge('the direction', 'the magnitude', sweep%parameter == sweep_load))
      end if
    case (sweep_eccentricity_x, sweep_eccentricity_y)
      if (analysis /= analysis_fixed_position) then
        call keys%complain('sweep', 'parameter', "needs analysis = 'fixed_position'")
      end if
    case (sweep_speed)
      if (analysis /= analysis_equilibrium .or. sweep%hold_position .or. may_rest) return
      do point = 1, size(sweep%values)
        if (abs(sweep%values(point)) > 0.0_wp) cycle ! a negative one has been complained about
        call keys%complain('sweep', 'values', 'must be positive: a film without speed carries '// &
                           'no load', point)
      end do
    case default
      return ! a tilt fits to every analysis
    end select
  end subroutine check_sweep

  !> Friction that remembers needs foils that rub.
  subroutine check_friction_memory(keys, sweep, model, contact)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(sweep_case_type), intent(in) :: sweep !! what `&sweep` asks for
    type(model_case_type), intent(in) :: model !! what `&model` asks for
    type(contact_case_type), intent(in) :: contact !! what `&contact` asks for

    if (.not. sweep%friction_memory .or. model%foil == 0) return
    if (.not. meshes_foils(model%foil)) then
      call keys%complain('sweep', 'friction_memory', "needs foil = 'shell' in &model, or "// &
                         "'beam': nothing else rubs")
    else if (.not. contact%may_rub) then
      call keys%complain('sweep', 'friction_memory', 'needs friction_top or friction_sleeve in '// &
                         '&contact: without friction nothing is remembered')
    end if
  end subroutine check_friction_memory

  !> Stability is that of foils under a film.
  subroutine check_stability(keys, solver, model, analysis)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(solver_case_type), intent(in) :: solver !! what `&solver` asks for
    type(model_case_type), intent(in) :: model !! what `&model` asks for
    integer, intent(in) :: analysis  !! 0 where it is not known

    if (.not. solver%stability .or. analysis == 0 .or. model%foil == 0) return
    if (.not. is_bearing(analysis)) then
      call keys%complain('solver', 'stability', 'needs a bearing: it is that of foils under a film')
    else if (.not. meshes_foils(model%foil)) then
      call keys%complain('solver', 'stability', "needs foil = 'shell' in &model, or 'beam': "// &
                         'nothing else moves by itself')
    end if
  end subroutine check_stability

  !> A run can be resumed where it has steps.
  subroutine check_restart(keys, output, analysis, has_steps)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(output_case_type), intent(in) :: output !! what `&output` asks for
    integer, intent(in) :: analysis  !! 0 where it is not known
    logical, intent(in) :: has_steps !! points of a sweep, or steps of time

    if (output%restart_every == 0 .or. analysis == 0) return
    if (analysis /= analysis_strip .and. .not. has_steps) then
      call keys%complain('output', 'restart_every', "needs a &sweep, or analysis = 'strip' or "// &
                         "'transient': nothing else has steps to resume from")
    end if
  end subroutine check_restart

  !> Iterations are those of shells whose matrix is sparse; modes have a solver of their own.
  subroutine check_linear_solver(keys, solver, model, analysis)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(solver_case_type), intent(in) :: solver !! what `&solver` asks for
    type(model_case_type), intent(in) :: model !! what `&model` asks for
    integer, intent(in) :: analysis  !! 0 where it is not known
    character(len=*), parameter :: name = 'linear_solver'

    if (solver%linear_solver == linear_solver_direct .or. analysis == 0) return
    if (analysis == analysis_modes) then
      call keys%complain('solver', name, "must be 'direct' for modes")
    else if (solver%linear_solver /= linear_solver_iterative) then
      return
    else if (is_bearing(analysis)) then
      call keys%complain('solver', name, "'iterative' needs a strip: the matrix of film, foils "// &
                         "and shaft has no definite sign; 'out_of_core' saves memory, too")
    else if (model%reduction == reduction_guyan) then
      call keys%complain('solver', name, "'iterative' needs reduction = 'none' in &model: rows "// &
                         'of condensed bumps are full, and hold more than their factors')
    end if
  end subroutine check_linear_solver

  !> An elastic foundation needs its stiffness, or what it is computed from.
  subroutine check_foundation(keys, model)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(model_case_type), intent(in) :: model !! what `&model` asks for
    character(len=*), parameter :: needed(*) = [character(len=14) :: &
                                                'thickness', 'youngs_modulus', 'poissons_ratio', &
                                                'half_length']
    character(len=14) :: missing(size(needed) + 1)
    integer :: i, n

    if (model%foil /= foil_elastic_foundation) return
    if (keys%meant('model', 'foundation_stiffness')) return
    n = 0
    do i = 1, size(needed)
      if (keys%meant('bump_foil', trim(needed(i)))) cycle
      n = n + 1
      missing(n) = needed(i)
    end do
    if (.not. keys%meant('bump_foil', 'pitch') .and. .not. keys%meant('bump_foil', 'bumps')) then
      n = n + 1
      missing(n) = 'pitch or bumps'
    end if
    if (n == 0) return
    call keys%complain('model', 'foil', 'needs foundation_stiffness, or what is missing in '// &
                       '&bump_foil: '//join(missing(:n), ', '))
  end subroutine check_foundation

  !> A bump foil that is meshed: its flats, its strips.
  subroutine check_strip(keys, foil, mesh, modes, analysis, model)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(bump_foil_case_type), intent(in) :: foil !! what `&bump_foil` asks for
    type(mesh_case_type), intent(in) :: mesh !! what `&mesh` asks for
    type(modes_case_type), intent(in) :: modes !! what `&modes` asks for
    integer, intent(in) :: analysis  !! 0 where it is not known
    type(model_case_type), intent(in) :: model !! what `&model` asks for
    integer :: edge !! bump at the fixed one
    logical :: strip, bearing

    bearing = is_bearing(analysis) .and. meshes_foils(model%foil)
    if (analysis /= analysis_strip .and. analysis /= analysis_modes .and. .not. bearing) return
    if (analysis == analysis_modes .and. modes%part == part_top_foil) return
    strip = analysis == analysis_strip .or. modes%part == part_strip .or. bearing
    ! A pitch that is shorter is complained about elsewhere.
    if (foil%half_length > 0.0_wp .and. .not. has_flats(foil) .and. .not. bumps_overlap(foil)) then
      if (analysis == analysis_modes .and. modes%part == part_flat) then
        call keys%complain('modes', 'part', 'there are no flats: pitch in &bump_foil is 2 '// &
                           'half_length')
      else if (strip .and. foil%fixed_line > fixed_line_corner) then
        call keys%complain('bump_foil', 'fixed_line', 'there are no flats: pitch is 2 half_length')
      end if
    end if
    if (strip .and. has_sizes(foil) .and. has_flats(foil) .and. &
        foil%fixed_line > fixed_line_corner .and. foil%bumps > 0) then
      edge = merge(foil%bumps, 1, foil%fixed_edge == fixed_edge_trailing)
      if (.not. has_flats(one_bump(foil, edge))) then
        call keys%complain('bump_foil', 'fixed_line', 'the bump at the fixed edge, '// &
                           text(edge)//', has no flat: its pitch is 2 half_length')
      end if
    end if
    if (foil%strips > mesh%axial_elements) then
      call keys%complain('bump_foil', 'strips', 'must not be more than axial_elements = '// &
                         text(mesh%axial_elements)//' in &mesh: each strip has its share of them')
    end if
  end subroutine check_strip

  !> A bearing of shells or beams: its strip is fixed at an edge and as wide as it, its pad open.
  subroutine check_shell_bearing(keys, foil, bearing, model, analysis)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(bump_foil_case_type), intent(in) :: foil !! what `&bump_foil` asks for
    type(bearing_case_type), intent(in) :: bearing !! what `&bearing` asks for
    type(model_case_type), intent(in) :: model !! what `&model` asks for
    integer, intent(in) :: analysis  !! 0 where it is not known
    real(wp), parameter :: rounding = 1.0e-9_wp !! of a width that is the bearing's, relative

    if (.not. is_bearing(analysis) .or. .not. meshes_foils(model%foil)) return
    if (foil%fixed_edge == fixed_edge_none) then
      call keys%complain('bump_foil', 'fixed_edge', "must be 'leading' or 'trailing' in a bearing")
    end if
    if (bearing%leading_edge_condition == leading_edge_periodic) then
      call keys%complain('bearing', 'leading_edge_condition', "must be 'slit' with foil = '"// &
                         foil_word(model%foil)// &
                         "': a foil has edges")
    end if
    if (bearing%length > 0.0_wp .and. foil%width > 0.0_wp .and. &
        abs(foil%width - bearing%length) > rounding*bearing%length) then
      call keys%complain('bump_foil', 'width', 'must be the length of the bearing, '// &
                         text(bearing%length)//' m')
    end if
  end subroutine check_shell_bearing

  !> Plates are either forced or moved.
  subroutine check_plates(keys, load, analysis)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(strip_load_case_type), intent(in) :: load !! what `&strip_load` asks for
    integer, intent(in) :: analysis  !! 0 where it is not known
    logical :: forced, moved

    if (analysis /= analysis_strip .or. load%kind /= load_plates) return
    forced = keys%meant('strip_load', 'maximum_force')
    moved = keys%meant('strip_load', 'maximum_displacement')
    if (forced .and. moved) then
      call keys%complain('strip_load', 'maximum_displacement', 'has no use beside '// &
                         'maximum_force: plates are either forced or moved')
    else if (.not. forced .and. .not. moved) then
      call keys%complain('strip_load', 'kind', 'needs maximum_force or maximum_displacement')
    end if
  end subroutine check_plates

  !> Half the width can be asked for only where the film is symmetric to the midplane.
  subroutine check_half_width(keys, model, mesh, operation, sweep)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(model_case_type), intent(in) :: model !! what `&model` asks for
    type(mesh_case_type), intent(in) :: mesh !! what `&mesh` asks for
    type(operation_case_type), intent(in) :: operation !! what `&operation` asks for
    type(sweep_case_type), intent(in) :: sweep !! what `&sweep` asks for

    if (model%half_width /= half_width_yes) return
    if (.not. is_symmetric(operation, sweep)) then
      call keys%complain('model', 'half_width', 'needs a bearing without tilt')
    end if
    if (mod(mesh%axial_elements, 2) /= 0) then
      call keys%complain('model', 'half_width', 'needs an even number of axial_elements in '// &
                         '&mesh, not '//text(mesh%axial_elements))
    end if
  end subroutine check_half_width

  !> Whether no point of the scene is tilted, so that one half mirrors the other.
  pure function is_symmetric(operation, sweep) result(symmetric)
    type(operation_case_type), intent(in) :: operation !! what `&operation` asks for
    type(sweep_case_type), intent(in) :: sweep !! what `&sweep` asks for
    logical :: symmetric

    symmetric = .not. any(abs(operation%tilt) > 0.0_wp) .and. .not. operation%tilt_is_sought .and. &
                sweep%parameter /= sweep_tilt_x .and. sweep%parameter /= sweep_tilt_y
  end function is_symmetric

  !> A rigid pad leaves the shaft no more room than the clearance, at both ends of the bearing.
  subroutine check_rigid_position(keys, model, bearing, operation, sweep)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(model_case_type), intent(in) :: model !! what `&model` asks for
    type(bearing_case_type), intent(in) :: bearing !! what `&bearing` asks for
    type(operation_case_type), intent(in) :: operation !! what `&operation` asks for
    type(sweep_case_type), intent(in) :: sweep !! what `&sweep` asks for
    real(wp) :: approach
    integer :: point

    if (model%foil /= foil_rigid) return
    if (.not. (bearing%clearance > 0.0_wp .and. bearing%length > 0.0_wp)) return
    if (.not. sweep%present .or. sweep%parameter < sweep_tilt_x .or. &
        sweep%parameter == sweep_keys) then
      approach = approach_to_pad(bearing, operation)
      if (approach >= bearing%clearance) call complain(guilty_key(operation))
      return
    end if
    do point = 1, size(sweep%values)
      approach = approach_to_pad(bearing, operation_at(operation, sweep, point))
      if (approach >= bearing%clearance) call complain('values', point)
    end do

  contains

    !> Complains about what brings the shaft out of the bearing.
    subroutine complain(key, point)
      character(len=*), intent(in) :: key
      integer, intent(in), optional :: point
      character(len=9) :: group

      group = 'operation'
      if (present(point)) group = 'sweep'
      call keys%complain(trim(group), key, 'moves the shaft by '//text(approach, 4)// &
                         ' m towards the pad, which must stay below the clearance of '// &
                         text(bearing%clearance)//' m in a rigid bearing', point)
    end subroutine complain
  end subroutine check_rigid_position

  !> The key that tells where the shaft is fixed, or how it is tilted.
  pure function guilty_key(operation) result(key)
    type(operation_case_type), intent(in) :: operation
    character(len=:), allocatable :: key
    key = 'tilt'
    if (any(abs(operation%eccentricity) > 0.0_wp)) key = 'eccentricity'
  end function guilty_key

  !> Displacement of the shaft towards the pad, the larger one of both ends [m].
  pure function approach_to_pad(bearing, operation) result(approach)
    type(bearing_case_type), intent(in) :: bearing
    type(operation_case_type), intent(in) :: operation
    real(wp) :: approach
    real(wp) :: z, e(2)
    integer :: pad

    approach = -huge(approach)
    do pad = 1, bearing%pads
      e = operation%eccentricity
      if (bearing%preload > 0.0_wp) then
        e = e - bearing%preload*bearing%clearance*[cos(preload_angle(bearing, pad)), &
                                                   sin(preload_angle(bearing, pad))]
      end if
      associate (tilt => operation%tilt)
        z = 0.5_wp*bearing%length
        approach = max(approach, approach_at_end(bearing, pad, e + z*[tilt(2), -tilt(1)]), &
                       approach_at_end(bearing, pad, e - z*[tilt(2), -tilt(1)]))
      end associate
    end do
  end function approach_to_pad

  !> Displacement towards the pad at one end of the bearing; towards the
  !> pad's edges where the thinnest gap would not be on the pad.
  pure function approach_at_end(bearing, pad, eccentricity) result(approach)
    type(bearing_case_type), intent(in) :: bearing
    integer, intent(in) :: pad !! its number
    real(wp), intent(in) :: eccentricity(2) !! of the sleeve relative to the shaft at that end [m]
    real(wp) :: approach
    real(wp), parameter :: turn = 2.0_wp*acos(-1.0_wp)
    real(wp) :: thinnest, edge(2)

    edge = bearing%leading_edge_angle + pad_turn(bearing, pad) + [0.0_wp, pad_angle(bearing)]
    thinnest = atan2(-eccentricity(2), -eccentricity(1))
    if (modulo(thinnest - edge(1), turn) <= edge(2) - edge(1)) then
      approach = norm2(eccentricity)
    else
      approach = maxval(-eccentricity(1)*cos(edge) - eccentricity(2)*sin(edge))
    end if
  end function approach_at_end

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
end module gfb_scene_rules
