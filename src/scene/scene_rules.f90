!> What the groups of a scene ask of each other, all called in one place.
module gfb_scene_rules
  use gfb_kinds, only: wp
  use gfb_units, only: turn
  use gfb_bearing_case, only: bearing_case_type, surface_of, pad_angle, pad_turn, &
                              preload_angle, leading_edge_periodic
  use gfb_case_keys, only: case_keys_type
  use gfb_film_surface, only: film_surface_type
  use gfb_study_rules, only: check_sweep, check_edge_lift, check_accuracy, check_capacity, &
                             is_unloaded
  use gfb_count_rules, only: check_counts
  use gfb_sample_rules, only: check_sample
  use gfb_feed_rules, only: check_feed
  use gfb_groove_rules, only: check_grooves
  use gfb_foil_rules, only: check_foils
  use gfb_shape_rules, only: check_shape
  use gfb_model_case, only: needs_meshes, half_width_yes, reduction_guyan, coupling_partitioned
  use gfb_motion_rules, only: check_dynamics, check_foil_mass, check_rotor, check_transient, &
                              check_periodic
  use gfb_foil_cases, only: missing_of_bumps
  use gfb_operation_case, only: operation_case_type, angular_speed
  use gfb_scene, only: scene_type
  use gfb_mesh_case, only: linear_solver_direct, linear_solver_iterative, linear_solver_auto
  use gfb_study_cases, only: of_heat
  use gfb_sweep_case, only: sweep_case_type, operation_at, sweep_keys, sweep_load, sweep_speed, &
                            sweep_tilt_x, sweep_tilt_y
  use gfb_plate_rules, only: check_plate
  use gfb_text, only: join, text
  use gfb_thrust_rules, only: check_thrust
  use gfb_cone_rules, only: check_cone
  use gfb_thermal_case, only: thermal_case_type, wall_given, wall_conductance, wall_fin, &
                              foil_given, foil_sheet
  implicit none (type, external)
  private
  public :: what_factors_do, check_groups, is_symmetric, heat_mirrors, solves_one_pad

  character(len=*), parameter :: heat = 'thermal' !! the group
  character(len=*), parameter :: moduli = 'modulus_temperatures, modulus_ratios, modulus_slope'

contains

  !> Checks what the groups ask of each other, in this order where mistakes have one line.
  subroutine check_groups(keys, scene)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(scene_type), intent(in) :: scene !! what the case file asks for

    call check_thrust(keys, scene)
    call check_cone(keys, scene)
    call check_plate(keys, scene)
    call check_sweep(keys, scene)
    call check_shaft_contact(keys, scene)
    call check_model(keys, scene)
    call check_rigid_position(keys, scene)
    call check_dynamics(keys, scene)
    call check_foil_mass(keys, scene)
    call check_rotor(keys, scene)
    call check_foils(keys, scene)
    call check_edge_lift(keys, scene)
    call check_accuracy(keys, scene)
    call check_capacity(keys, scene)
    call check_sample(keys, scene)
    call check_transient(keys, scene)
    call check_periodic(keys, scene)
    call check_shape(keys, scene)
    call check_counts(keys, scene)
    call check_heat(keys, scene)
    call check_feed(keys, scene)
    call check_grooves(keys, scene)
  end subroutine check_groups

  !> What heat asks of the scene; first what it cannot have beside it yet.
  subroutine check_heat(keys, scene)
    type(case_keys_type), intent(inout) :: keys
    type(scene_type), intent(in) :: scene

    call keys%rule('sensitivity', 'quantity', .not. scene%thermal%present .and. &
                   scene%sensitivity%asks(of_heat), 'names a result of heat, which needs &thermal')
    if (.not. (scene%thermal%present .and. scene%general%analysis%has_film)) return
    call keys%rule('model', 'coupling', scene%model%coupling == coupling_partitioned, &
                   "must be 'monolithic' with &thermal")
    call keys%rule('model', 'half_width', scene%model%half_width == half_width_yes .and. &
                   .not. scene%thermal%mirrors(), "must not be 'yes': cooling_flow, or ends of "// &
                   'the shaft that differ, in &thermal make both halves differ')
    call check_walls(keys, scene%thermal)
    call check_heated_foil(keys, scene)
    call check_growth(keys, scene)
  end subroutine check_heat

  !> Each wall has the keys of its kind alone, and heat has a way out.
  subroutine check_walls(keys, thermal)
    type(case_keys_type), intent(inout) :: keys
    type(thermal_case_type), intent(in) :: thermal
    logical :: known

    call only('shaft_temperature', thermal%shaft, wall_given, "shaft = 'given'")
    call only('shaft_conductance, shaft_far_temperature', thermal%shaft, wall_conductance, &
              "shaft = 'conductance'")
    call only('shaft_conductivity, shaft_end_conductance, shaft_end_temperature', thermal%shaft, &
              wall_fin, "shaft = 'fin'")
    call only('sleeve_temperature', thermal%sleeve, wall_given, "sleeve = 'given'")
    call only('sleeve_conductance, sleeve_far_temperature', thermal%sleeve, wall_conductance, &
              "sleeve = 'conductance'")
    call only('top_foil_temperature', thermal%top_foil, foil_given, "top_foil = 'given'")
    call keys%refuse(heat, 'cooling_temperature, channel_conductance, '// &
                     'channel_sleeve_conductance', .not. keys%holds(heat, 'cooling_flow'), &
                     'needs cooling_flow')
    known = min(thermal%shaft, thermal%sleeve, thermal%top_foil) > 0 .and. &
      (keys%holds(heat, 'bump_conductance') .or. thermal%bump_conductance_estimated)
    if (thermal%shaft == wall_conductance) known = known .and. keys%meant(heat, 'shaft_conductance')
    if (thermal%shaft == wall_fin) known = known .and. keys%meant(heat, 'shaft_end_conductance')
    if (thermal%sleeve /= wall_conductance .or. .not. known) return
    if (.not. keys%meant(heat, 'sleeve_conductance')) return
    call keys%rule(heat, 'shaft', .not. thermal%has_way_out(), 'leaves no way out for the '// &
                   'heat: shaft, sleeve and foil are insulated')
    call keys%rule(heat, 'sleeve_conductance', .not. max(thermal%sleeve_conductance, &
                   thermal%bump_conductance, thermal%cooling_flow* &
                   thermal%channel_sleeve_conductance) > 0.0_wp, 'must be positive where no '// &
                   'heat reaches the sleeve: else its temperature is undetermined')

  contains

    !> Refuses keys of another kind of wall.
    subroutine only(names, wall, kind, words)
      character(len=*), intent(in) :: names, words
      integer, intent(in) :: wall, kind !! that there is, 0 where not known; that has the keys
      call keys%refuse(heat, names, all(wall /= [0, kind]), 'needs '//words)
    end subroutine only
  end subroutine check_walls

  !> Sizes of foils that are not meshed, on which their heat depends.
  subroutine check_heated_foil(keys, scene)
    type(case_keys_type), intent(inout) :: keys
    type(scene_type), intent(in) :: scene
    character(len=:), allocatable :: stiffness, useless

    associate (thermal => scene%thermal)
      call keys%rule(heat, 'carry_over', scene%bearing%leading_edge_condition == &
                     leading_edge_periodic .and. keys%meant(heat, 'carry_over'), 'has no use '// &
                     "with leading_edge_condition = 'periodic': a full ring has no slit")
      stiffness = trim(scene%model%foil%stiffness_key)
      useless = trim(scene%model%foil%without_modulus)
      if (useless == '' .and. keys%meant('model', stiffness)) then
        useless = 'has no use with '//stiffness//' in &model, which no modulus changes'
      end if
      call keys%refuse(heat, moduli, useless /= '', useless)
      call keys%refuse(heat, moduli, max(scene%foil_damping%foundation_damping, &
                       scene%foil_damping%arm%stiffness) > 0.0_wp, 'must not be given with '// &
                       'foundation_damping or maxwell_stiffness in &foil_damping, in this version')
      if (scene%model%foil%has_bumps) return
      call keys%rule('top_foil', 'thickness', thermal%top_foil == foil_sheet .and. .not. &
                     keys%meant('top_foil', 'thickness'), 'must be given: top_foil is '// &
                     "'sheet' in &thermal")
      call keys%rule(heat, 'bump_conductance', thermal%top_foil == foil_sheet .and. .not. &
                     (thermal%bump_conductance_estimated .or. keys%holds(heat, &
                     'bump_conductance')), 'must be given: an estimate needs thickness, '// &
                     'half_length, height and pitch in &bump_foil')
      if (scene%bump_foil%height%value > 0.0_wp .or. .not. thermal%is_cooled()) return
      if (keys%holds(heat, 'cooling_flow')) call must_be_given('channel_conductance')
      if (keys%holds(heat, 'cooling_flow')) call must_be_given('channel_sleeve_conductance')
    end associate

  contains

    !> A conductance of the channel has no default without the height of the bumps.
    subroutine must_be_given(key)
      character(len=*), intent(in) :: key
      call keys%rule(heat, key, .not. keys%holds(heat, key), 'must be given: &bump_foil has no '// &
                     'height')
    end subroutine must_be_given
  end subroutine check_heated_foil

  !> A shaft that grows with its speed leaves a gap at rest.
  subroutine check_growth(keys, scene)
    type(case_keys_type), intent(inout) :: keys
    type(scene_type), intent(in) :: scene
    character(len=*), parameter :: names(*) = [character(len=20) :: 'shaft_density', &
                                   'shaft_youngs_modulus', 'shaft_poissons_ratio']
    logical :: given(size(names))
    integer :: i

    given = [(keys%meant(heat, trim(names(i))), i=1, size(names))]
    call keys%rule(heat, trim(names(max(1, findloc(given, .true., 1)))), any(given) .and. .not. &
                   all(given), 'needs '//join(pack(names, .not. given), ' and ')//', too')
    associate (thermal => scene%thermal, bearing => scene%bearing, sweep => scene%sweep)
      call keys%refuse(heat, 'shaft_inner_radius', .not. any(given) .and. all(thermal%shaft /= &
                       [0, wall_fin]), "needs shaft = 'fin', or shaft_density")
      if (.not. min(bearing%radius, bearing%clearance) > 0.0_wp) return
      call keys%rule(heat, 'shaft_inner_radius', thermal%shaft_inner_radius >= bearing%radius, &
                     'must be less than the radius of '//text(bearing%radius)//' m')
      if (.not. thermal%centrifugal) return
      call check_speed('operation', 'speed_rpm', scene%operation%speed_rpm)
      if (sweep%parameter /= sweep_speed) return
      do i = 1, size(sweep%values)
        call check_speed('sweep', 'values', sweep%values(i), i)
      end do
    end associate

  contains

    !> Complains about a speed at which the shaft fills the bearing.
    subroutine check_speed(group, key, speed_rpm, point)
      character(len=*), intent(in) :: group, key
      real(wp), intent(in) :: speed_rpm !! [rpm]
      integer, intent(in), optional :: point
      real(wp) :: growth !! [m]

      growth = scene%thermal%growth(scene%bearing%radius, angular_speed(speed_rpm))
      call keys%rule(group, key, growth >= scene%bearing%clearance, 'makes the shaft grow by '// &
                     text(growth, 4)//' m, which must be less than the clearance of '// &
                     text(scene%bearing%clearance)//' m', point)
    end subroutine check_speed
  end subroutine check_growth

  !> What the asperities load must have equations of its own, and at rest they must carry something.
  subroutine check_shaft_contact(keys, scene)
    type(case_keys_type), intent(inout) :: keys
    type(scene_type), intent(in) :: scene
    character(len=*), parameter :: none_at_rest = 'must not be zero at rest: without a load '// &
                                   'every position is an equilibrium'
    logical :: rests

    associate (model => scene%model, sweep => scene%sweep, analysis => scene%general%analysis)
      if (.not. scene%shaft_contact%present .or. .not. analysis%has_film) return
      call keys%rule('model', 'foundation_pressure', model%has_local_springs(), 'must be '// &
                     "'axial_mean', of thrust bearings 'radial_mean', with &shaft_contact: "// &
                     'springs without unknowns of their own '// &
                     'feel the film alone')
      call keys%rule('model', 'coupling', model%coupling == coupling_partitioned, &
                     "must be 'monolithic' with &shaft_contact")
      if (.not. analysis%floats .or. .not. allocated(sweep%values)) return
      rests = .not. scene%operation%speed_rpm > 0.0_wp .and. keys%meant('operation', 'speed_rpm')
      if (sweep%parameter == sweep_speed) rests = any(.not. sweep%values > 0.0_wp)
      if (.not. rests) return
      call keys%rule('operation', 'load', is_unloaded(scene), none_at_rest)
      call keys%rule('sweep', 'values', .not. is_unloaded(scene) .and. &
                     sweep%parameter == sweep_load .and. any(.not. abs(sweep%values) > 0.0_wp), &
                     none_at_rest)
    end associate
  end subroutine check_shaft_contact

  !> What in a scene of a bearing needs factors of its matrix, or is cheap by them; empty: nothing.
  pure function what_factors_do(scene) result(words)
    type(scene_type), intent(in) :: scene !! with a film
    character(len=:), allocatable :: words

    words = ''
    if (.not. scene%model%foil%has_shell_bumps) then
      words = 'a foil that is not of shells'
    else if (scene%transient%present .or. scene%periodic%present) then
      words = 'a motion over time'
    else if (scene%capacity%limit /= 0) then
      words = 'a search for a limit'
    else if (scene%model%coupling == coupling_partitioned) then
      words = "coupling = 'partitioned' in &model"
    else if (scene%solver%stability) then
      words = 'stability in &solver'
    end if
  end function what_factors_do

  !> What model, mesh and solver ask of the scene: an elastic foundation its stiffness, or what it
  !> is computed from; half the width a film that is symmetric to the midplane; stability foils
  !> under a film; iterations shells whose matrix is sparse.
  subroutine check_model(keys, scene)
    type(case_keys_type), intent(inout) :: keys
    type(scene_type), intent(in) :: scene
    character(len=:), allocatable :: missing, factored
    logical :: half, bearing, iterative, pitched

    missing = missing_of_bumps(keys, .false., pitched)
    associate (model => scene%model, solver => scene%solver, analysis => scene%general%analysis, &
               elements => scene%mesh%axial_elements)
      call keys%rule('model', 'foil', model%foil%has_foundation .and. missing /= '' &
                     .and. .not. (keys%meant('model', 'foundation_stiffness') .or. &
                     model%has_strips()), 'needs '// &
                     'foundation_stiffness, or what is missing in &bump_foil: '//missing)
      half = model%half_width == half_width_yes
      call keys%rule('model', 'half_width', half .and. &
                     tilts(scene%operation, scene%sweep), 'needs a bearing without tilt')
      call keys%rule('model', 'half_width', half .and. .not. scene%feed%mirrors(), 'needs rows '// &
                     'of orifices in &feed that mirror each other about z = 0, without row_shift')
      call keys%rule('model', 'half_width', half .and. mod(elements, 2) /= 0, 'needs an even '// &
                     'number of axial_elements in &mesh, not '//text(elements))
      call check_lifts('leading_edge_lift', size(scene%operation%leading_edge_lift))
      call check_lifts('leading_edge_lift_edge', size(scene%operation%leading_edge_lift_edge))
      if (.not. analysis%is_known()) return
      bearing = analysis%has_film
      call keys%rule('solver', 'stability', solver%stability .and. model%foil%is_known() .and. &
                     .not. bearing, 'needs a bearing: it is that of foils under a film')
      call keys%rule('solver', 'stability', solver%stability .and. model%foil%is_known() .and. &
                     bearing .and. .not. model%foil%has_bumps, &
                     needs_meshes//'nothing else moves by itself')
      call keys%rule('solver', 'linear_solver', analysis%finds_modes .and. &
                     all(solver%linear_solver /= [linear_solver_direct, linear_solver_auto]), &
                     "must be 'direct' for modes")
      iterative = .not. analysis%finds_modes .and. solver%linear_solver == linear_solver_iterative
      factored = ''
      if (iterative .and. bearing) factored = what_factors_do(scene)
      call keys%rule('solver', 'linear_solver', factored /= '', "'iterative' has no factors, "// &
                     'and '//factored//" needs them; 'out_of_core' saves memory, too")
      call keys%rule('solver', 'linear_solver', iterative .and. factored == '' .and. &
                     model%reduction == reduction_guyan, "'iterative' needs reduction = "// &
                     "'none' in &model: rows of condensed bumps are full, and hold more than "// &
                     'their factors')
    end associate

  contains

    !> A list has one value for all pads, or one for each.
    subroutine check_lifts(key, values)
      character(len=*), intent(in) :: key
      integer, intent(in) :: values

      call keys%rule('operation', key, all(values /= [0, 1, scene%bearing%pads]), 'has '// &
                     text(values)//' values, must have one for all pads or one for each of '// &
                     text(scene%bearing%pads))
    end subroutine check_lifts
  end subroutine check_model

  !> Whether one half mirrors the other: no point is tilted, and heat leaves both ends alike.
  pure logical function is_symmetric(scene) result(symmetric)
    type(scene_type), intent(in) :: scene !! what the case file asks for
    symmetric = .not. (scene%bearing%row%ends_differ .or. &
                       tilts(scene%operation, scene%sweep)) .and. heat_mirrors(scene) .and. &
                scene%feed%mirrors() .and. scene%grooves%mirrors()
  end function is_symmetric

  !> Whether heat leaves both halves of the width alike, at every point of the scene.
  pure logical function heat_mirrors(scene) result(mirrors)
    type(scene_type), intent(in) :: scene !! what the case file asks for

    mirrors = scene%thermal%mirrors()
    if (scene%sweep%parameter /= sweep_keys) return
    mirrors = mirrors .and. index(scene%sweep%keys, 'cooling_flow') == 0
  end function heat_mirrors

  !> Whether one pad stands for all: they are equal, and the shaft neither moves across nor tilts.
  pure logical function solves_one_pad(scene) result(one)
    type(scene_type), intent(in) :: scene !! what the case file asks for
    one = .not. (scene%bearing%row%moves_across .or. scene%operation%moment_given .or. &
      tilts(scene%operation, scene%sweep) .or. scene%bump_foil%random%deviation > 0.0_wp .or. &
      scene%bore%present)
  end function solves_one_pad

  !> Whether a point of the scene is tilted.
  pure logical function tilts(operation, sweep)
    type(operation_case_type), intent(in) :: operation
    type(sweep_case_type), intent(in) :: sweep
    tilts = any(abs(operation%tilt) > 0.0_wp) .or. operation%tilt_is_sought .or. &
            sweep%parameter == sweep_tilt_x .or. sweep%parameter == sweep_tilt_y
  end function tilts

  !> A rigid pad leaves the shaft no more room than the clearance, at both ends of the bearing. If
  !> an equilibrium is sought an eccentricity is where the search begins, anywhere, and only of a
  !> full circle it is known here that no place is better than the middle.
  subroutine check_rigid_position(keys, scene)
    type(case_keys_type), intent(inout) :: keys
    type(scene_type), intent(in) :: scene
    character(len=:), allocatable :: key
    integer :: point

    associate (bearing => scene%bearing, sweep => scene%sweep)
      if (scene%model%foil%deflects .or. .not. bearing%row%moves_across) return
      if (.not. (bearing%clearance > 0.0_wp .and. bearing%length > 0.0_wp)) return
      if (.not. sweep%present .or. sweep%parameter < sweep_tilt_x .or. &
          sweep%parameter == sweep_keys) then
        key = 'tilt'
        if (any(abs(scene%operation%eccentricity) > 0.0_wp)) key = 'eccentricity'
        call check_approach('operation', key, scene%operation)
        return
      end if
      do point = 1, size(sweep%values)
        call check_approach('sweep', 'values', operation_at(scene%operation, sweep, point), point)
      end do
    end associate

  contains

    !> Complains about what brings the shaft out of the bearing.
    subroutine check_approach(group, key, operation, point)
      character(len=*), intent(in) :: group, key
      type(operation_case_type), intent(in) :: operation
      integer, intent(in), optional :: point
      real(wp), parameter :: rounding = 1.0e-9_wp !! of a turn [1]
      type(operation_case_type) :: here
      real(wp) :: approach !! [m]

      here = operation
      if (scene%general%analysis%floats) then
        if (scene%bearing%pads > 1 .or. scene%bearing%preload > 0.0_wp .or. &
            scene%bore%present .or. pad_angle(scene%bearing) < turn*(1.0_wp - rounding)) return
        here%eccentricity = 0.0_wp
      end if
      approach = approach_to_pad(scene%bearing, here)
      call keys%rule(group, key, approach >= scene%bearing%clearance, 'moves the shaft by '// &
                     text(approach, 4)//' m towards the pad, which must stay below the '// &
                     'clearance of '//text(scene%bearing%clearance)//' m in a rigid bearing', point)
    end subroutine check_approach
  end subroutine check_rigid_position

  !> Displacement of the shaft towards the pad, the larger one of both ends [m].
  pure real(wp) function approach_to_pad(bearing, operation) result(approach)
    type(bearing_case_type), intent(in) :: bearing
    type(operation_case_type), intent(in) :: operation
    type(film_surface_type) :: surface
    real(wp) :: e(2), tilted(2)
    integer :: pad, end

    surface = surface_of(bearing)
    approach = -huge(approach)
    do pad = 1, bearing%pads
      e = operation%eccentricity
      if (bearing%preload > 0.0_wp) then
        e = e - bearing%preload*bearing%clearance*[cos(preload_angle(bearing, pad)), &
                                                   sin(preload_angle(bearing, pad))]
      end if
      do end = -1, 1, 2
        tilted = surface%lever(0.5_wp*bearing%length*end)*[operation%tilt(2), -operation%tilt(1)]
        approach = max(approach, approach_at_end(bearing, pad, surface%cosine*e + tilted))
      end do
    end do
    approach = approach + surface%sine*operation%axial_eccentricity
  end function approach_to_pad

  !> Displacement towards the pad at one end of the bearing; towards the
  !> pad's edges where the thinnest gap would not be on the pad.
  pure real(wp) function approach_at_end(bearing, pad, eccentricity) result(approach)
    type(bearing_case_type), intent(in) :: bearing
    integer, intent(in) :: pad !! its number
    real(wp), intent(in) :: eccentricity(2) !! of the sleeve relative to the shaft at that end [m]
    real(wp) :: thinnest, edge(2)

    edge = bearing%leading_edge_angle + pad_turn(bearing, pad) + [0.0_wp, pad_angle(bearing)]
    thinnest = atan2(-eccentricity(2), -eccentricity(1))
    if (modulo(thinnest - edge(1), turn) <= edge(2) - edge(1)) then
      approach = norm2(eccentricity)
    else
      approach = maxval(-eccentricity(1)*cos(edge) - eccentricity(2)*sin(edge))
    end if
  end function approach_at_end
end module gfb_scene_rules
