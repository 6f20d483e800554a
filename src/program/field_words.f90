!> The field's words for what gfb has under names of its own: keys, results, a case to begin with,
!> and the page of the manual. The one place that joins them; a test looks up every target.
module gfb_field_words
  use gfb_text, only: lower_case
  implicit none (type, external)
  private
  public :: find_field_word, field_word_rows, first_word

  !> A word of the field, with its synonyms.
  type, public :: field_word_type
    character(len=110) :: words = ''   !! the first is its title; in them, _ stands for a blank
    character(len=330) :: meaning = ''
    character(len=170) :: keys = ''    !! group%key
    character(len=150) :: results = ''
    character(len=24) :: analysis = '' !! template that shows it; empty: none
    character(len=24) :: groups = ''   !! of the template, of those that it only offers
    character(len=24) :: page = ''     !! docs/manual/PAGE.md
  end type field_word_type

  type(field_word_type), parameter :: rows(*) = [ &
    field_word_type('rotordynamic_coefficients kxx kxy kyx kyy cxx cxy cyx cyy stiffness '// &
      'damping dynamic_coefficients', &
      'K and C of the film and the foils under a small vibration, which depend on its '// &
      'frequency: synchronous ones are those at frequency ratio 1', &
      'dynamics%frequency_ratios dynamics%frequencies', &
      'stiffness_xx stiffness_xy stiffness_yx stiffness_yy damping_xx damping_xy '// &
      'damping_yx damping_yy', 'linear_dynamics', '', 'coefficients'), &
    field_word_type('axial_stiffness kzz czz tilting_stiffness', &
      'K and C of a thrust bearing along its axis, and against a tilt of the runner', &
      'dynamics%frequency_ratios', 'stiffness_zz damping_zz stiffness_phixphix', '', '', &
      'thrust'), &
    field_word_type('cooling cooling_air cooling_flow', &
      'gas that is blown along the bumps, behind the top foil, and takes heat away', &
      'thermal%cooling_flow thermal%cooling_temperature thermal%channel_conductance', &
      'heat_to_channel cooling_outlet_temperature', 'equilibrium', 'thermal', 'heat'), &
    field_word_type('heat temperature thermal thermohydrodynamic thd', &
      'temperatures of gas, top foil, shaft and sleeve, and what they do to viscosity and '// &
      'clearance', 'thermal%shaft thermal%top_foil thermal%sleeve thermal%ambient_temperature', &
      'maximum_film_temperature top_foil_temperature shaft_temperature', 'equilibrium', 'thermal', &
      'heat'), &
    field_word_type('thermal_runaway runaway seizure', &
      'the shaft grows with its temperature, the film thins and heats it more, until no answer '// &
      'is left', 'thermal%shaft_expansion thermal%sleeve_expansion thermal%shaft_conductance', &
      'running_clearance running_play energy_imbalance', 'equilibrium', 'thermal', 'heat'), &
    field_word_type('margin safety_factor load_margin', &
      'a limit over what the bearing is asked for: of load, speed or tilt; of the film over '// &
      'the smallest one wanted, of the rise of temperature and of the stress that are allowed; '// &
      'and of stability, the stiffness of the mode nearest to a change', &
      'capacity%smallest_gap capacity%highest_temperature capacity%largest_stress', &
      'film_margin temperature_margin stress_margin load_capacity lift_off_speed_rpm '// &
      'misalignment_allowance stability_margin', &
      'load_capacity', '', 'capacity'), &
    field_word_type('load_capacity capacity', &
      'the largest load that leaves the smallest film', 'capacity%smallest_gap', &
      'load_capacity load_capacity_coefficient', 'load_capacity', '', 'capacity'), &
    field_word_type('lift_off lift_off_speed touch_down touchdown take_off', &
      'the speed from which the film alone carries, and the asperities nothing; or the supply '// &
      'pressure from which a film that is fed carries', &
      'capacity%contact_part capacity%lift_off_by shaft_contact%roughness shaft_contact%pressure', &
      'lift_off_speed_rpm lift_off_supply_pressure', 'lift_off', '', 'capacity'), &
    field_word_type('externally_pressurized externally_pressurised aerostatic hybrid supply '// &
      'orifice porous', &
      'a film that is fed with gas under pressure through orifices or a porous wall: the '// &
      'supply lifts the shaft at rest and at low speed', &
      'feed%kind feed%supply_pressure feed%orifice_diameter feed%permeability feed%through', &
      'supply_flow supply_power choked_orifices lift_off_supply_pressure', 'equilibrium', 'feed', &
      'feed'), &
    field_word_type('misalignment tilt', &
      'a shaft whose axis is not the sleeve''s: given, swept, or looked for up to a film', &
      'operation%tilt operation%moment capacity%tilt_axis', &
      'misalignment_allowance angular_stiffness_xx', 'misalignment_allowance', '', &
      'misaligned_shaft'), &
    field_word_type('whirl subsynchronous subsynchronous_whirl threshold_speed onset_speed '// &
      'stability', 'self-excited vibration below the speed: from which mass or speed on it grows', &
      'rotor%mass sweep%parameter', 'critical_mass whirl_ratio onset_speed_rpm growth_rate', &
      'linear_dynamics', 'rotor', 'stability'), &
    field_word_type('machine flexible_rotor flexible_shaft rotor_bearing_system', &
      'a shaft that bends, with discs, in several bearings, each a case file of its own: '// &
      'equilibrium, modes, unbalance', 'shaft%lengths discs%masses bearings%files '// &
      'machine%speed_rpm unbalance%values', 'mass growth_rate whirl_frequency '// &
      'onset_speed_rpm', 'machine', '', 'machine'), &
    field_word_type('critical_speed natural_frequency campbell rotor_mode', &
      'frequency and damping of the rotor on this bearing; of natural modes of a foil, '// &
      "analysis = 'modes'", 'rotor%mass dynamics%frequency_ratios', &
      'whirl_frequency damping_ratio growth_rate', 'linear_dynamics', 'rotor', 'stability'), &
    field_word_type('limit_cycle hopf bifurcation floquet', &
      'orbits that close, forced or self-excited, and whether they are stable', &
      'periodic%motion periodic%parameter', 'largest_multiplier orbit_stable orbit_x', &
      'periodic', 'unbalance', 'periodic'), &
    field_word_type('unbalance imbalance orbit transient run_up coast_down', &
      'a shaft followed over time: under unbalance, a run-up, a push, a drop', &
      'unbalance%unbalance transient%turns transient%final_speed_rpm', &
      'orbit_x orbit_y minimum_gap_over_time', 'transient', 'unbalance', 'transient'), &
    field_word_type('dry_friction coulomb_damping micro_slip stick slip hysteresis', &
      'contacts of bumps with top foil and sleeve stick, or slide at the friction''s limit, '// &
      'which takes energy', &
      'contact%friction_top contact%friction_sleeve contact%friction_law '// &
      'dynamics%contact_tangent', 'dissipated_energy', 'strip', '', 'strip'), &
    field_word_type('structural_damping loss_factor', &
      'the foil''s stiffness times 1 + i loss_factor', &
      'dynamics%loss_factor foil_damping%loss_factor', 'damping_xx', '', '', 'foil_damping'), &
    field_word_type('bump_stiffness foil_stiffness compliance foundation_stiffness', &
      'of springs under the film it is given, of beams and shells computed from the bumps', &
      'model%foil model%foundation_stiffness model%crest_stiffness', &
      'loading_stiffness maximum_deflection', 'strip', '', 'strip'), &
    field_word_type('beam shell rigid elastic_foundation plate foil_model', &
      'the foils as rigid walls, springs under each point, planar beams, shells with '// &
      'friction, or a plate between its crests', 'model%foil', '', 'equilibrium', '', &
      'model_and_mesh'), &
    field_word_type('film_thickness gap clearance minimum_film', &
      'between shaft and top foil: at rest, in operation at its thinnest, and hot', &
      'bearing%clearance', 'minimum_gap running_clearance', 'equilibrium', '', 'frame'), &
    field_word_type('eccentricity attitude_angle frame signs', &
      'where the shaft''s centre is, and the angle of that from the load', &
      'operation%eccentricity', 'eccentricity_x eccentricity_y attitude_angle', &
      'fixed_position', '', 'frame'), &
    field_word_type('power_loss friction_torque windage drag', &
      'what the film, and contacts with the shaft, take from it', 'gas%viscosity', &
      'friction_torque power_loss', 'equilibrium', '', 'results'), &
    field_word_type('preload lobe pad three_pad play', &
      'pads whose centres lie off the bearing''s', 'pads%count pads%preload pads%preload_offset', &
      'minimum_gap_1 running_play', 'equilibrium', 'pads', 'pads'), &
    field_word_type('herringbone spiral_groove grooved groove pumping', &
      'grooves on shaft or sleeve, narrow and many, that the motion drives gas along', &
      'grooves%on grooves%angle grooves%depth grooves%ridge_part grooves%band_begin '// &
      'grooves%pumping', 'pumped_pressure flow_low flow_high', 'equilibrium', 'grooves', &
      'grooves'), &
    field_word_type('shim wear bore', &
      'a bore that is not round: waves, shims, a measured profile', &
      'bore%shim_height bore%wave_amplitude bore%profile_height', '', 'equilibrium', 'bore', &
      'gas_and_bore'), &
    field_word_type('thrust runner ramp taper_land', &
      'a bearing of sectors with ramps that carries along the axis', &
      'bearing%kind ramp%height operation%axial_load', 'axial_gap axial_force', 'thrust', '', &
      'thrust'), &
    field_word_type('stress fatigue yield_strength von_mises', &
      'largest von Mises stress of top foil and bumps', '', &
      'maximum_top_foil_stress maximum_bump_foil_stress', 'equilibrium', '', 'results'), &
    field_word_type('mesh accuracy convergence discretization error', &
      'elements along and across the film and the foils, and a stated error of a result', &
      'mesh%circumferential_elements accuracy%quantity accuracy%target', &
      'minimum_gap_error accuracy_met', '', '', 'accuracy'), &
    field_word_type('sensitivity derivative tolerance uncertainty', &
      'what a key does to a result, and what its tolerance does', &
      'sensitivity%quantity sensitivity%parameters sensitivity%tolerances', &
      'standard_deviation_minimum_gap', 'equilibrium', 'sensitivity', 'sensitivity'), &
    field_word_type('monte_carlo statistics scatter manufacturing_error', &
      'many bearings whose bumps or values differ at random', &
      'sample%count bump_foil%height_deviation', 'minimum_gap_mean', '', '', 'sample'), &
    field_word_type('slip_flow knudsen rarefied turbulence real_gas', &
      'a film so thin, fast or dense that gas slips at the walls, swirls, or is not ideal', &
      'gas%mean_free_path gas%turbulence gas%equation_of_state', '', '', '', 'gas_and_bore'), &
    field_word_type('sweep parameter_study map', &
      'one key over several values, each from the answer of the last', &
      'sweep%parameter sweep%values', 'key_value', 'equilibrium', 'sweep', 'sweeps'), &
    field_word_type('peclet peclet_number galerkin supg upwind upwinding weighting', &
      'how the film''s elements are weighed: the Peclet number of a cell is how much more gas '// &
      'the shaft drags through it than pressure drives; up to about 2 Galerkin''s plain '// &
      'weights are better, above they let the pressure oscillate, and SUPG weighs upstream', &
      'model%film_scheme mesh%circumferential_elements', 'maximum_peclet', '', '', 'method'), &
    field_word_type('soft_contacts soft_contact release released two_way_contacts', &
      'how a search from nothing begins: contacts of the foils are soft springs that also '// &
      'pull; they are stiffened and released step by step, and the answer has those of the '// &
      'case alone', &
      'contact%friction_top contact%friction_sleeve', 'lifted_length', '', '', 'method'), &
    field_word_type('newton newtons_method newton_step residual iteration factorization', &
      'Newton''s method: the residual is what the equations leave open; each iteration solves '// &
      'them linearised, by factors of their matrix', &
      'solver%residual_tolerance solver%maximum_iterations solver%maximum_factorizations', &
      'newton_iterations factorizations', '', '', 'method'), &
    field_word_type('fold turning_point snap branch_of_answers', &
      'where a branch of answers turns back: beyond it there is none near by, and shaft, top '// &
      'foil or temperature moves on by itself', 'sweep%turn_folds', 'fold', '', '', 'branches'), &
    field_word_type('no_answer not_converged refused diverged', &
      'what the sentences of a run without an answer mean, and what to change', &
      'solver%maximum_factorizations', 'outcome reason', '', '', 'no_answer')]

contains

  !> The row of a word; one with no words where it is in none.
  pure function find_field_word(word) result(row)
    character(len=*), intent(in) :: word !! as typed: blanks and - stand for _
    type(field_word_type) :: row
    character(len=:), allocatable :: name
    integer :: i

    name = lower_case(trim(word))
    do i = 1, len(name)
      if (name(i:i) == ' ' .or. name(i:i) == '-') name(i:i) = '_'
    end do
    do i = 1, size(rows)
      if (name /= '' .and. index(' '//rows(i)%words, ' '//name//' ') > 0) row = rows(i)
    end do
  end function find_field_word

  !> All rows.
  pure function field_word_rows() result(all)
    type(field_word_type), allocatable :: all(:)
    all = rows
  end function field_word_rows

  !> The title of a row.
  pure function first_word(row) result(word)
    type(field_word_type), intent(in) :: row
    character(len=:), allocatable :: word
    word = row%words(:index(row%words, ' ') - 1)
  end function first_word
end module gfb_field_words
