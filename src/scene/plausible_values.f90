!> Values that a case file may have and yet are improbable, most often a number in another unit: the
!> usual ranges of the real keys; each has a row here, or a reason for having none.
module gfb_plausible_values
  use gfb_kinds, only: wp
  use gfb_units, only: degree, rpm
  use gfb_bearing_case, only: pad_area
  use gfb_operation_case, only: angular_speed
  use gfb_case_keys, only: case_keys_type, longest_list
  use gfb_namelist_file, only: find_elements
  use gfb_namelist_values, only: read_real, value_string
  use gfb_motion_cases, only: follow_mass, follow_speed, follow_unbalance
  use gfb_scene, only: scene_type
  use gfb_sweep_case, only: sweep_keys, sweep_load, sweep_load_angle, &
                            sweep_speed, sweep_tilt_x, sweep_tilt_y, sweep_axial_load, &
                            sweep_axial_gap
  use gfb_gas_case, only: usual_temperature
  use gfb_thermal_case, only: foil_given
  use gfb_text, only: text
  implicit none (type, external)
  private
  public :: check_plausible, check_tolerance

  !> What is usual of the values of some keys; signs do not count, and zero is always usual.
  type, public :: range_type
    real(wp) :: low, high       !! smallest and largest usual value [the keys' unit]
    character(len=16) :: unit   !! the keys'
    character(len=19) :: others !! what the number may be meant in: units, the likeliest first
    character(len=207) :: keys !! `group%key`, with blanks between them
  end type range_type

  !> Why a key has no usual range.
  type, public :: reason_type
    character(len=28) :: key !! `group%key`
    character(len=40) :: reason
  end type reason_type

  !> A unit in which a number may be meant.
  type, public :: unit_type
    character(len=10) :: name
    real(wp) :: size          !! in the key's unit [1]
    real(wp) :: zero = 0.0_wp !! what it counts from [the key's unit]
  end type unit_type

  type(range_type), parameter, public :: ranges(*) = [ &
    range_type(1.0e-3_wp, 0.5_wp, 'm', 'mm,um', 'bearing%radius bearing%outer_radius '// &
               'bearing%inner_radius model%cut_radii'), &
    range_type(1.0e-3_wp, 2.0_wp, 'm', 'mm,um', 'bearing%length bump_foil%width'), &
    range_type(1.0e-6_wp, 1.0e-3_wp, 'm', 'um,mm', 'bearing%clearance'), &
    range_type(1.0e-6_wp, 5.0e-4_wp, 'm', 'um,mm', 'ramp%height'), &
    range_type(5.0e-7_wp, 2.0e-4_wp, 'm', 'um,mm', 'operation%axial_gap'), &
    range_type(5.0e-6_wp, 1.0e-3_wp, 'm', 'um,mm', 'bearing%axial_play'), &
    range_type(0.0_wp, 1.0e3_wp, 'N m', 'N mm', 'operation%moment'), &
    range_type(0.0_wp, 1.0e-3_wp, 'm', 'um,mm', &
               'bearing%assembly_interference bore%wave_amplitude bore%shim_height '// &
               'bore%profile_height bump_foil%crest_gap bump_foil%corner_gap'), &
    range_type(0.0_wp, 6.3_wp, 'rad', 'deg', &
               'bearing%leading_edge_angle bore%wave_angle bore%shim_angle bore%shim_arc '// &
               'bore%shim_ramp bore%profile_angle pads%arc pads%first_leading_edge pads%gap '// &
               'unbalance%unbalance_angle unbalance%couple_unbalance_angle'), &
    range_type(0.0_wp, 6.3_wp, 'rad', 'deg', 'bump_foil%crest_angles'), &
    range_type(3.0e-6_wp, 3.0e-4_wp, 'Pa s', 'uPa s,mPa s', &
               'gas%viscosity gas%density_table_viscosity'), &
    range_type(1.0e3_wp, 5.0e7_wp, 'Pa', 'bar,kPa,MPa', 'gas%ambient_pressure'), &
    range_type(1.0e-10_wp, 1.0e-4_wp, 'm', 'um,mm', 'gas%mean_free_path'), &
    range_type(50.0_wp, 3000.0_wp, 'K', 'degC', 'gas%temperature'), &
    range_type(200.0_wp, 1300.0_wp, 'K', 'degC', &
               'thermal%ambient_temperature thermal%shaft_temperature '// &
               'thermal%shaft_far_temperature thermal%shaft_end_temperature '// &
               'thermal%top_foil_temperature thermal%reference_temperature '// &
               'thermal%modulus_temperatures'), &
    range_type(200.0_wp, 1300.0_wp, 'K', 'degC', 'machine%shaft_end_temperature '// &
               'machine%shaft_film_temperature discs%heat_temperatures'), &
    range_type(200.0_wp, 1300.0_wp, 'K', 'degC', 'thermal%cooling_temperature '// &
               'thermal%sleeve_temperature thermal%sleeve_far_temperature'), &
    range_type(300.0_wp, 1.6e4_wp, 'J/(kg K)', 'J/(g K)', 'thermal%specific_heat'), &
    range_type(0.1_wp, 2.0_wp, '1', '%', 'thermal%prandtl'), &
    range_type(0.2_wp, 1.2_wp, '1', '%', 'thermal%modulus_ratios'), &
    range_type(1.0e-6_wp, 2.0e-3_wp, '1/K', '%/K', 'thermal%modulus_slope'), &
    range_type(1.0e-3_wp, 1.0e2_wp, 'W/K', 'mW/K', &
               'thermal%shaft_conductance thermal%sleeve_conductance '// &
               'thermal%shaft_end_conductance machine%shaft_end_conductance'), &
    range_type(0.1_wp, 500.0_wp, 'W/(m K)', 'W/(cm K)', &
               'thermal%shaft_conductivity thermal%foil_conductivity machine%shaft_conductivity'), &
    range_type(1.0e-3_wp, 1.0e3_wp, 'W/K', 'mW/K', 'discs%heat_conductances'), &
    range_type(0.1_wp, 1.0e4_wp, 'W/(m^2 K)', 'W/(cm^2 K)', 'machine%shaft_film_conductance'), &
    range_type(1.0_wp, 1.0e5_wp, 'W/(m^2 K)', 'W/(cm^2 K)', 'thermal%bump_conductance '// &
               'thermal%channel_conductance thermal%channel_sleeve_conductance'), &
    range_type(1.0e-6_wp, 0.02_wp, 'kg/s', 'g/s', 'thermal%cooling_flow'), &
    range_type(1.0e-7_wp, 1.0e-4_wp, '1/K', 'um/(m K)', &
               'thermal%shaft_expansion thermal%sleeve_expansion'), &
    range_type(1.0e-4_wp, 0.5_wp, 'm', 'mm,um', 'thermal%shaft_inner_radius'), &
    range_type(1.0e-3_wp, 0.5_wp, 'kg/mol', 'g/mol', 'gas%molar_mass'), &
    range_type(1.0e5_wp, 5.0e7_wp, 'Pa', 'bar,kPa,MPa', 'gas%critical_pressure'), &
    range_type(3.0_wp, 2000.0_wp, 'K', '', 'gas%critical_temperature'), &
    range_type(0.0_wp, 1.5_wp, '1', '%', 'gas%acentric_factor'), &
    range_type(0.0_wp, 3.0_wp, '1', '%', &
               'gas%viscosity_exponent gas%viscosity_temperature_exponent'), &
    range_type(1.0e2_wp, 1.0e8_wp, 'Pa', 'bar,kPa,MPa', 'gas%density_table_pressure'), &
    range_type(1.0e-3_wp, 2.0e3_wp, 'kg/m^3', 'g/cm^3,g/m^3', 'gas%density_table_density'), &
    range_type(100.0_wp, 2.0e6_wp, 'rpm', 'krpm', &
               'operation%speed_rpm machine%speed_rpm transient%final_speed_rpm '// &
               'dynamics%response_speeds'), &
    range_type(0.0_wp, 2.0e-3_wp, 'm', 'mm,um', &
               'operation%eccentricity operation%axial_eccentricity '// &
               'operation%leading_edge_lift operation%leading_edge_lift_edge'), &
    range_type(0.0_wp, 2.0e-2_wp, 'rad', 'mrad,deg', 'operation%tilt'), &
    range_type(0.0_wp, 1.56_wp, 'rad', 'deg', 'bearing%half_angle'), &
    range_type(5.0e-6_wp, 2.0e-3_wp, 'm', 'mm,um', &
               'top_foil%thickness bump_foil%thickness bump_foil%bump_thickness '// &
               'bump_foil%strip_thickness'), &
    range_type(1.0e-3_wp, 1.0e3_wp, 'm', 'mm,um', 'top_foil%free_radius'), &
    range_type(1.0e9_wp, 2.0e12_wp, 'Pa', 'GPa,MPa', &
               'top_foil%youngs_modulus bump_foil%youngs_modulus thermal%shaft_youngs_modulus'), &
    range_type(500.0_wp, 2.5e4_wp, 'kg/m^3', 'g/cm^3,t/mm^3', &
               'top_foil%density bump_foil%density thermal%shaft_density'), &
    range_type(1.0e-4_wp, 2.0e-2_wp, 'm', 'mm,um', &
               'bump_foil%half_length bump_foil%bump_half_length bump_foil%strip_half_length'), &
    range_type(2.0e-5_wp, 1.0e-2_wp, 'm', 'mm,um', &
               'bump_foil%height bump_foil%bump_height bump_foil%strip_height'), &
    range_type(1.0e-9_wp, 1.0e-4_wp, 'm', 'um,mm', 'bump_foil%height_deviation'), &
    range_type(2.0e-4_wp, 5.0e-2_wp, 'm', 'mm,um', &
               'bump_foil%pitch bump_foil%bump_pitch bump_foil%strip_pitch model%spring_pitch'), &
    range_type(0.0_wp, 5.0e-2_wp, 'm', 'mm,um', 'bump_foil%strip_offset'), &
    range_type(1.0e-5_wp, 2.0e-2_wp, 'm', 'mm,um', 'bump_foil%cut_width'), &
    range_type(0.0_wp, 2.0_wp, '1', '%', &
               'contact%friction_top contact%friction_sleeve shaft_contact%friction '// &
               'dynamics%loss_factor foil_damping%loss_factor'), &
    range_type(1.0e-12_wp, 1.0e-3_wp, 'm', 'um,mm', 'contact%stick_length'), &
    range_type(1.0e-8_wp, 1.0e-4_wp, 'm', 'um,mm', 'shaft_contact%roughness'), &
    range_type(1.0e4_wp, 1.0e11_wp, 'Pa', 'MPa,GPa', 'shaft_contact%pressure'), &
    range_type(0.0_wp, 1.0e9_wp, 'Pa', '', 'strip_load%pressure strip_load%bump_pressure'), &
    range_type(0.0_wp, 1.0e-2_wp, 'm', 'mm,um', 'strip_load%maximum_displacement'), &
    range_type(1.0e-6_wp, 1.0e6_wp, 'N', 'mN', 'strip_load%maximum_force'), &
    range_type(1.0e7_wp, 1.0e12_wp, 'N/m^3', 'N/mm^3', 'model%foundation_stiffness '// &
               'model%strip_foundation_stiffness'), &
    range_type(1.0e5_wp, 1.0e10_wp, 'N/m^2', 'N/mm^2', 'model%crest_stiffness'), &
    range_type(1.0e-8_wp, 5.0e-4_wp, 'm', 'um,mm', 'capacity%smallest_gap'), &
    range_type(200.0_wp, 1300.0_wp, 'K', 'degC', 'capacity%highest_temperature'), &
    range_type(1.0e6_wp, 5.0e9_wp, 'Pa', 'MPa,GPa', 'capacity%largest_stress'), &
    range_type(0.0_wp, 1.0e-4_wp, 'm', 'mm,um', 'solver%touch_down_gap'), &
    range_type(0.0_wp, 1.0e-2_wp, '1', '%', 'solver%residual_tolerance solver%step_tolerance'), &
    range_type(0.0_wp, 1.0_wp, '1', '%', 'solver%smallest_load_step'), &
    range_type(0.0_wp, 1.0e7_wp, 'rad/s', 'rpm', &
               'dynamics%frequencies transient%orbit_frequency '// &
               'foil_damping%loss_frequency'), &
    range_type(0.0_wp, 100.0_wp, '1', '%', 'dynamics%frequency_ratios'), &
    range_type(0.0_wp, 0.5_wp, '1', '%', 'dynamics%interpolation_tolerance'), &
    range_type(1.0e4_wp, 2.0e7_wp, 'Pa', 'bar,kPa,MPa', 'feed%supply_pressure '// &
               'feed%channel_pressure'), &
    range_type(200.0_wp, 1300.0_wp, 'K', 'degC', 'feed%supply_temperature'), &
    range_type(1.0e-17_wp, 1.0e-11_wp, 'm^2', 'um^2', 'feed%permeability'), &
    range_type(5.0e-4_wp, 5.0e-2_wp, 'm', 'mm,um', 'feed%wall_thickness'), &
    range_type(0.0_wp, 1.0e13_wp, '1/m', '1/mm', 'feed%inertia_coefficient'), &
    range_type(5.0e-5_wp, 3.0e-3_wp, 'm', 'mm,um', 'feed%orifice_diameter'), &
    range_type(5.0e-5_wp, 2.0e-2_wp, 'm', 'mm,um', 'feed%mouth_diameter'), &
    range_type(0.0_wp, 2.0e-2_wp, 'm', 'mm,um', 'feed%tube_diameter'), &
    range_type(0.0_wp, 0.5_wp, 'm', 'mm,um', 'feed%row_positions'), &
    range_type(0.0_wp, 6.3_wp, 'rad', 'deg', 'feed%first_orifice_angle feed%orifice_angles '// &
               'feed%row_shift'), &
    range_type(0.0_wp, 1.0e-6_wp, 'm^3', 'mm^3', 'feed%pocket_volume'), &
    range_type(0.3_wp, 1.0_wp, '1', '%', 'feed%discharge_coefficient'), &
    range_type(1.05_wp, 1.67_wp, '1', '%', 'feed%specific_heat_ratio'), &
    range_type(0.15_wp, 1.2_wp, 'rad', 'deg', 'grooves%angle'), &
    range_type(1.0e-7_wp, 1.0e-3_wp, 'm', 'um,mm', 'grooves%depth'), &
    range_type(0.2_wp, 0.8_wp, '1', '%', 'grooves%ridge_part'), &
    range_type(0.0_wp, 0.5_wp, 'm', 'mm,um', 'grooves%band_begin grooves%band_end'), &
    range_type(1.0e2_wp, 1.0e8_wp, 'N s/m^3', 'N s/mm^3', 'foil_damping%foundation_damping'), &
    range_type(1.0e6_wp, 1.0e13_wp, 'N/m^3', 'N/mm^3', 'foil_damping%maxwell_stiffness'), &
    range_type(1.0e-9_wp, 1.0e2_wp, 's', 'ms,us', 'foil_damping%maxwell_time'), &
    range_type(1.0e-13_wp, 1.0e-4_wp, 'm', 'um,mm', 'dynamics%vibration_amplitudes'), &
    range_type(1.0e-4_wp, 1.0e4_wp, 'kg', 'g', 'rotor%mass'), &
    range_type(1.0e-10_wp, 50.0_wp, 'kg m^2', 'kg mm^2,g mm^2', &
               'rotor%transverse_inertia rotor%polar_inertia'), &
    range_type(1.0e-3_wp, 5.0_wp, 'm', 'mm,um', 'rotor%bearing_distance shaft%lengths'), &
    range_type(1.0e-3_wp, 1.0_wp, 'm', 'mm,um', 'shaft%outer_diameters'), &
    range_type(0.0_wp, 1.0_wp, 'm', 'mm,um', 'shaft%inner_diameters'), &
    range_type(1.0e9_wp, 2.0e12_wp, 'Pa', 'GPa,MPa', 'shaft%youngs_modulus shaft%shear_modulus'), &
    range_type(500.0_wp, 2.5e4_wp, 'kg/m^3', 'g/cm^3,t/mm^3', 'shaft%density'), &
    range_type(0.3_wp, 1.2_wp, '1', '%', 'shaft%shear_coefficient'), &
    range_type(0.0_wp, 1.0e-2_wp, 's', 'ms,us', 'shaft%material_damping'), &
    range_type(0.0_wp, 10.0_wp, 'm', 'mm,um', 'discs%positions bearings%positions '// &
               'loads%positions unbalance%positions machine%stations transient%pulse_position'), &
    range_type(1.0e-4_wp, 1.0e4_wp, 'kg', 'g', 'discs%masses'), &
    range_type(1.0e-10_wp, 50.0_wp, 'kg m^2', 'kg mm^2,g mm^2', 'discs%polar_inertias '// &
               'discs%transverse_inertias'), &
    range_type(0.0_wp, 5.0e-3_wp, 'm', 'um,mm', 'bearings%offset_x bearings%offset_y '// &
               'bearings%offset_z'), &
    range_type(0.0_wp, 0.05_wp, 'rad', 'deg', 'bearings%misalignment_x bearings%misalignment_y'), &
    range_type(0.0_wp, 1.0e3_wp, 'kg', 'g', 'bearings%support_mass'), &
    range_type(0.0_wp, 1.0e13_wp, 'N/m', '', 'bearings%support_stiffness_x '// &
               'bearings%support_stiffness_y'), &
    range_type(0.0_wp, 1.0e8_wp, 'N s/m', '', 'bearings%support_damping_x '// &
               'bearings%support_damping_y'), &
    range_type(0.0_wp, 1.0e6_wp, 'N', 'mN', 'loads%forces_x loads%forces_y machine%axial_load'), &
    range_type(0.0_wp, 1.0e4_wp, 'N m', 'N mm', 'loads%moments_x loads%moments_y'), &
    range_type(0.0_wp, 1.0e3_wp, 'm/s^2', 'mm/s^2', 'machine%gravity transient%start_gravity'), &
    range_type(0.0_wp, 1.0e7_wp, 'rad/s', 'rpm', 'dynamics%largest_frequency'), &
    range_type(1.0e-13_wp, 1.0e-2_wp, 'kg m', 'kg mm,g mm', 'unbalance%values'), &
    range_type(0.0_wp, 6.3_wp, 'rad', 'deg', 'unbalance%angles'), &
    range_type(0.0_wp, 1.0e5_wp, '1', '', 'transient%turns transient%steps_per_turn'), &
    range_type(1.0e-8_wp, 1.0e3_wp, 's', 'ms,us', 'transient%duration transient%ramp_time'), &
    range_type(1.0e-10_wp, 0.1_wp, '1', '%', 'transient%time_tolerance'), &
    range_type(0.0_wp, 0.1_wp, '1', '%', 'transient%unsolved_part'), &
    range_type(0.0_wp, 1.0e6_wp, 'N', 'mN', 'transient%start_load'), &
    range_type(1.0e-13_wp, 1.0e-2_wp, 'kg m', 'kg mm,g mm', 'unbalance%unbalance'), &
    range_type(1.0e-14_wp, 1.0e-2_wp, 'kg m^2', 'kg mm^2,g mm^2', 'unbalance%couple_unbalance'), &
    range_type(0.0_wp, 1.0e3_wp, 'N s', 'mN s', 'transient%pulse'), &
    range_type(0.0_wp, 1.0e2_wp, 'N m s', 'N mm s', 'transient%couple_pulse'), &
    range_type(0.0_wp, 1.0e3_wp, 's', 'ms,us', 'transient%pulse_start transient%field_start'), &
    range_type(1.0e-8_wp, 10.0_wp, 's', 'ms,us', 'transient%pulse_length'), &
    range_type(0.0_wp, 1.0e4_wp, 's', 'ms,us', 'transient%base_time'), &
    range_type(0.0_wp, 1.0e5_wp, 'm/s^2', 'mm/s^2', &
               'transient%base_acceleration_x transient%base_acceleration_y'), &
    range_type(1.0e-13_wp, 1.0e-3_wp, 'm', 'um,mm', 'transient%orbit_radius'), &
    range_type(1.0e-9_wp, 1.0e3_wp, 's', 'ms,us', 'transient%field_interval'), &
    range_type(0.0_wp, 0.5_wp, '1', '%', 'transient%steady_tolerance'), &
    range_type(1.0e-10_wp, 2.0e-3_wp, 'm', 'um,mm', 'transient%largest_orbit'), &
    range_type(1.0e-6_wp, 10.0_wp, '1', '%', 'periodic%step'), &
    range_type(1.0e-6_wp, 0.9_wp, '1', '%', 'periodic%first_amplitude'), &
    range_type(0.0_wp, 10.0_wp, '1', '', 'sample%factors')]

  type(reason_type), parameter, public :: reasons(*) = [ &
    reason_type('operation%load', 'judged against what films carry'), &
    reason_type('operation%axial_load', 'judged against what films carry'), &
    reason_type('ramp%part', 'from 0 to 1 by its rule'), &
    reason_type('model%foundation_exponent', 'from -20 to 20 by its rule'), &
    reason_type('sweep%values', 'those of what the sweep changes'), &
    reason_type('periodic%final_value', 'that of the parameter'), &
    reason_type('sensitivity%tolerances', 'judged against their parameters'), &
    reason_type('contact%normal_stiffness', 'its unit follows from the exponent'), &
    reason_type('pads%preload', 'from 0 to below 1 by its rule'), &
    reason_type('pads%preload_offset', 'from 0 to 1 by its rule'), &
    reason_type('capacity%contact_part', 'between 0 and 1 by its rule'), &
    reason_type('top_foil%poissons_ratio', 'between -1 and 0.5 by its rule'), &
    reason_type('bump_foil%poissons_ratio', 'between -1 and 0.5 by its rule'), &
    reason_type('shaft%poissons_ratio', 'between -1 and 0.5 by its rule'), &
    reason_type('thermal%shaft_poissons_ratio', 'between -1 and 0.5 by its rule'), &
    reason_type('bearings%facing', '1 or -1 by its rule'), &
    reason_type('thermal%carry_over', 'from 0 to 1 by its rule'), &
    reason_type('contact%exponent', 'bounded by its rule'), &
    reason_type('mesh%edge_refinement', 'from 1 to 100 by its rule'), &
    reason_type('accuracy%target', 'between 0 and 1 by its rule'), &
    reason_type('sample%quantiles', 'between 0 and 1 by their rule')]

  type(unit_type), parameter, public :: units(*) = [ &
    unit_type('mm', 1.0e-3_wp), unit_type('um', 1.0e-6_wp), &
    unit_type('mrad', 1.0e-3_wp), unit_type('deg', degree), &
    unit_type('rpm', rpm), unit_type('krpm', 1.0e3_wp), &
    unit_type('ms', 1.0e-3_wp), unit_type('us', 1.0e-6_wp), unit_type('mm/s^2', 1.0e-3_wp), &
    unit_type('kPa', 1.0e3_wp), unit_type('bar', 1.0e5_wp), unit_type('MPa', 1.0e6_wp), &
    unit_type('GPa', 1.0e9_wp), unit_type('uPa s', 1.0e-6_wp), unit_type('mPa s', 1.0e-3_wp), &
    unit_type('degC', 1.0_wp, 273.15_wp), unit_type('J/(g K)', 1.0e3_wp), &
    unit_type('mW/K', 1.0e-3_wp), unit_type('W/(cm K)', 1.0e2_wp), &
    unit_type('%', 1.0e-2_wp), unit_type('g', 1.0e-3_wp), unit_type('g/mol', 1.0e-3_wp), &
    unit_type('W/(cm^2 K)', 1.0e4_wp), &
    unit_type('g/s', 1.0e-3_wp), unit_type('um/(m K)', 1.0e-6_wp), unit_type('%/K', 1.0e-2_wp), &
    unit_type('g/cm^3', 1.0e3_wp), unit_type('g/m^3', 1.0e-3_wp), &
    unit_type('t/mm^3', 1.0e12_wp), unit_type('N/mm^3', 1.0e9_wp), unit_type('N/mm^2', 1.0e6_wp), &
    unit_type('N s/mm^3', 1.0e9_wp), unit_type('mN', 1.0e-3_wp), unit_type('mN s', 1.0e-3_wp), &
    unit_type('N mm', 1.0e-3_wp), unit_type('N mm s', 1.0e-3_wp), &
    unit_type('kg mm', 1.0e-3_wp), unit_type('g mm', 1.0e-6_wp), &
    unit_type('kg mm^2', 1.0e-6_wp), unit_type('g mm^2', 1.0e-9_wp), &
    unit_type('um^2', 1.0e-12_wp), unit_type('mm^3', 1.0e-9_wp), unit_type('1/mm', 1.0e3_wp)]

  !> No gas film carries a larger load over p_a D L [1].
  real(wp), parameter :: most_carried = 50.0_wp

contains

  !> Warns of improbable values, key by key.
  subroutine check_plausible(keys, scene)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(scene_type), intent(in) :: scene !! what the case file asks for
    integer :: i, row, mistakes

    mistakes = keys%complaints%count + keys%warnings%count
    do i = 1, keys%book%count
      associate (key => keys%book%keys(i))
        row = 0
        if (key%given) row = row_of(trim(key%group)//'%'//trim(key%name))
        if (row > 0) call check_values(keys, trim(key%group), trim(key%name), ranges(row))
      end associate
    end do
    call check_changed_values(keys, scene%sweep%parameter, scene%periodic%parameter)
    if (scene%thermal%present) then
      call warn_of_channel(keys, scene)
      call warn_of_growth(keys, scene)
      call warn_of_reference(keys, scene)
    end if
    if (scene%grooves%present) call warn_of_depth(keys, scene)
    ! A load that is large against a wrong pressure is not wrong.
    if (keys%complaints%count + keys%warnings%count == mistakes) call check_load(keys, scene)
  end subroutine check_plausible

  !> Warns of the tolerance of a parameter that is none: a deviation larger than the key itself, or
  !> one that nothing shows.
  subroutine check_tolerance(keys, label, value, tolerance, unit, element)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    character(len=*), intent(in) :: label !! of the parameter, `group%key`
    real(wp), intent(in) :: value     !! the parameter's, of a list the largest [its unit]
    real(wp), intent(in) :: tolerance !! of it [its unit]
    character(len=*), intent(in) :: unit !! of both
    integer, intent(in) :: element !! of `tolerances`
    real(wp), parameter :: least = 1.0e-8_wp !! part of a key that means something [1]
    character(len=*), parameter :: group = 'sensitivity', key = 'tolerances'
    type(range_type) :: range
    integer :: row

    range = range_type(0.0_wp, abs(value), unit, '', '')
    row = row_of(label)
    if (row > 0) then
      if (ranges(row)%unit /= 'K') range%others = ranges(row)%others
      ! What may be zero has its size from what is usual of it.
      if (.not. ranges(row)%low > 0.0_wp) range%high = max(abs(value), ranges(row)%high)
    end if
    range%low = least*range%high
    if (is_usual(range, tolerance)) return
    call keys%warn(group, key, 'is the standard deviation of '//label//', '//text(value)//': '// &
                   range_words(range)//guess(range, tolerance), element)
  end subroutine check_tolerance

  !> Number of a key's range; 0 where it has none.
  pure integer function row_of(key) result(row)
    character(len=*), intent(in) :: key !! `group%key`

    do row = size(ranges), 1, -1
      if (index(' '//ranges(row)%keys//' ', ' '//key//' ') > 0) return
    end do
  end function row_of

  !> Warns of the first value of a key that is not usual.
  subroutine check_values(keys, group, key, range)
    type(case_keys_type), intent(inout) :: keys
    character(len=*), intent(in) :: group, key !! names in the case file
    type(range_type), intent(in) :: range      !! of the values
    integer, allocatable :: elements(:)
    character(len=:), allocatable :: problem
    real(wp) :: number
    integer :: i

    call find_elements(keys%file, group, key, longest_list, elements)
    do i = 1, size(elements)
      if (keys%file%values(elements(i))%kind == value_string) cycle
      call read_real(keys%file%value_text(elements(i)), number, problem)
      if (problem /= '' .or. is_usual(range, number)) cycle
      if (size(elements) == 1) then
        call keys%warn(group, key, range_words(range)//guess(range, number))
      else
        call keys%warn(group, key, range_words(range)//guess(range, number), i)
      end if
      return
    end do
  end subroutine check_values

  !> The values of a sweep, and the last value of a branch of orbits, are those of what changes; a
  !> start from rest has slow speeds, too.
  subroutine check_changed_values(keys, swept, followed)
    type(case_keys_type), intent(inout) :: keys
    integer, intent(in) :: swept    !! parameter of the sweep, 0 without one
    integer, intent(in) :: followed !! over which orbits are followed
    type(range_type) :: range

    select case (swept)
    case (sweep_speed)
      range = ranges(row_of('operation%speed_rpm'))
    case (sweep_tilt_x, sweep_tilt_y)
      range = ranges(row_of('operation%tilt'))
    case (sweep_axial_gap)
      range = ranges(row_of('operation%axial_gap'))
    case default
      range = ranges(row_of('operation%eccentricity'))
    end select
    range%low = 0.0_wp
    if (all(swept /= [0, sweep_load, sweep_load_angle, sweep_axial_load, sweep_keys])) then
      call check_values(keys, 'sweep', 'values', range)
    end if
    select case (followed)
    case (follow_speed)
      range = ranges(row_of('operation%speed_rpm'))
    case (follow_unbalance)
      range = ranges(row_of('unbalance%unbalance'))
    case (follow_mass)
      range = ranges(row_of('rotor%mass'))
    case default
      return
    end select
    call check_values(keys, 'periodic', 'final_value', range)
  end subroutine check_changed_values

  !> Warns of a load that no film carries.
  subroutine check_load(keys, scene)
    type(case_keys_type), intent(inout) :: keys
    type(scene_type), intent(in) :: scene
    real(wp) :: carried, loads !! [N] by a film of p_a, at most; asked for

    associate (bearing => scene%bearing)
      carried = scene%gas%ambient_pressure*pad_area(bearing)
      if (.not. bearing%row%moves_across) then
        if (carried > 0.0_wp .and. scene%operation%axial_load > most_carried*carried) then
          call keys%warn('operation', 'axial_load', 'is '//text(scene%operation%axial_load/ &
                         carried, 3)//' p_a times the area of the pads; gas films carry some '// &
                         'of that at most')
        end if
        call warn_of_shape(keys, scene)
        return
      end if
    end associate
    loads = norm2(scene%operation%load)
    if (.not. carried > 0.0_wp .or. loads <= most_carried*carried) return
    call keys%warn('operation', 'load', 'is '//text(loads/carried, 3)//' p_a D L; gas films '// &
                   'carry some p_a D L at most')
  end subroutine check_load

  !> Warns of a cooling flow to which the top foil gives no heat.
  subroutine warn_of_channel(keys, scene)
    type(case_keys_type), intent(inout) :: keys
    type(scene_type), intent(in) :: scene
    character(len=:), allocatable :: words

    associate (thermal => scene%thermal)
      if (.not. thermal%cooling_flow > 0.0_wp .or. thermal%channel_conductance > 0.0_wp) return
      if (thermal%top_foil == foil_given .or. keys%mistakes() > 0) return
      words = 'is 0: cooling_flow cools the sleeve alone, not the top foil'
      if (.not. thermal%channel_sleeve_conductance > 0.0_wp) then
        words = 'is 0, as is channel_sleeve_conductance: cooling_flow cools nothing'
      end if
      call keys%warn('thermal', 'channel_conductance', words//'; without the key it is 3.5 '// &
                     'conductivity of the gas / height in &bump_foil')
    end associate
  end subroutine warn_of_channel

  !> Warns where one of shaft and sleeve grows, and nothing is said of the other one.
  subroutine warn_of_growth(keys, scene)
    type(case_keys_type), intent(inout) :: keys
    type(scene_type), intent(in) :: scene

    call warn_of('shaft', 'sleeve', scene%thermal%shaft_expansion)
    call warn_of('sleeve', 'shaft', scene%thermal%sleeve_expansion)

  contains

    !> Warns of a wall that keeps its size.
    subroutine warn_of(one, other, expansion)
      character(len=*), intent(in) :: one, other !! which grows; the other one
      real(wp), intent(in) :: expansion !! of the one [1/K]

      if (.not. expansion > 0.0_wp .or. keys%holds('thermal', other//'_expansion')) return
      call keys%warn('thermal', other//'_expansion', 'is not given: the '//other//' keeps its '// &
                     'size while the '//one//' grows with its temperature; 0 says so')
    end subroutine warn_of
  end subroutine warn_of_growth

  !> Warns of a machine that is not as warm as the room in which drawings hold.
  subroutine warn_of_reference(keys, scene)
    type(case_keys_type), intent(inout) :: keys
    type(scene_type), intent(in) :: scene
    real(wp), parameter :: near_room = 60.0_wp !! about `usual_temperature` [K]
    character(len=:), allocatable :: what

    associate (thermal => scene%thermal)
      if (keys%holds('thermal', 'reference_temperature')) return
      if (.not. abs(thermal%reference_temperature - usual_temperature) > near_room) return
      what = ''
      if (keys%meant('thermal', 'modulus_slope')) what = 'youngs_modulus'
      if (max(thermal%shaft_expansion, thermal%sleeve_expansion) > 0.0_wp) what = 'clearance'
      if (what == '') return
      call keys%warn('thermal', 'reference_temperature', 'is not given: '//what//' counts at '// &
                     'ambient_temperature, '//text(thermal%reference_temperature)// &
                     ' K; that of a drawing holds at 293.15 K')
    end associate
  end subroutine warn_of_reference

  !> Warns of grooves that are much shallower or deeper than the film is thick; without depth there
  !> are none.
  subroutine warn_of_depth(keys, scene)
    type(case_keys_type), intent(inout) :: keys
    type(scene_type), intent(in) :: scene
    real(wp), parameter :: usual_ratios(2) = [0.2_wp, 5.0_wp] !! of depth and gap [1]
    real(wp) :: gap, ratio

    gap = scene%bearing%clearance
    if (.not. gap > 0.0_wp) gap = scene%operation%axial_gap
    if (.not. min(gap, scene%grooves%depth) > 0.0_wp) return
    ratio = scene%grooves%depth/gap
    if (ratio >= usual_ratios(1) .and. ratio <= usual_ratios(2)) return
    call keys%warn('grooves', 'depth', 'is '//text(ratio, 3)//' of the gap of '//text(gap)// &
                   ' m; usual is 0.2 to 5')
  end subroutine warn_of_depth

  !> Warns of an improbable ring, and of a runner that would burst.
  subroutine warn_of_shape(keys, scene)
    type(case_keys_type), intent(inout) :: keys
    type(scene_type), intent(in) :: scene
    real(wp), parameter :: usual_ratios(2) = [0.2_wp, 0.95_wp] !! of the radii [1]
    real(wp), parameter :: fastest = 700.0_wp !! at the outer radius [m/s]
    real(wp) :: ratio, tip

    if (.not. scene%bearing%length > 0.0_wp) return
    ratio = scene%bearing%inner_radius/scene%bearing%radius
    if (ratio < usual_ratios(1) .or. ratio > usual_ratios(2)) then
      call keys%warn('bearing', 'inner_radius', 'is '//text(ratio, 3)//' of outer_radius; '// &
                     'usual is 0.2 to 0.95')
    end if
    tip = angular_speed(scene%operation%speed_rpm)*scene%bearing%radius
    if (tip > fastest) call keys%warn('operation', 'speed_rpm', 'makes the runner''s edge move '// &
                                      'at '//text(tip, 3)//' m/s; usual is at most 700')
  end subroutine warn_of_shape

  !> Whether a value lies where values of its key lie.
  elemental logical function is_usual(range, number) result(usual)
    type(range_type), intent(in) :: range
    real(wp), intent(in) :: number !! [the key's unit]

    usual = .not. abs(number) > 0.0_wp .or. &
            (abs(number) >= range%low .and. abs(number) <= range%high)
  end function is_usual

  !> A range in words.
  pure function range_words(range) result(words)
    type(range_type), intent(in) :: range
    character(len=:), allocatable :: words

    words = 'usual is at most '//text(range%high)
    if (range%low > 0.0_wp) words = 'usual is '//text(range%low)//' to '//text(range%high)
    if (range%unit /= '1') words = words//' '//trim(range%unit)
  end function range_words

  !> The unit in which a number would be usual, as a question; empty where there is none.
  pure function guess(range, number) result(words)
    type(range_type), intent(in) :: range
    real(wp), intent(in) :: number !! [the key's unit]
    character(len=:), allocatable :: words
    character(len=:), allocatable :: left, name
    real(wp) :: value !! [the key's unit]
    integer :: comma, i

    words = ''
    left = trim(range%others)
    do while (left /= '')
      comma = index(left//',', ',')
      name = left(:comma - 1)
      left = left(min(comma, len(left)) + 1:)
      do i = 1, size(units)
        value = number*units(i)%size + units(i)%zero
        if (units(i)%name /= name .or. .not. is_usual(range, value)) cycle
        words = '; did you mean '//text(number)//' '//name//' = '//text(value)
        if (range%unit /= '1') words = words//' '//trim(range%unit)
        words = words//'?'
        return
      end do
    end do
  end function guess
end module gfb_plausible_values
