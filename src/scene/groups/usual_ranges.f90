!> What is usual of the real keys of a case file, and the units in which their numbers are typed by
!> mistake; each real key has a row here, or a reason for having none.
module gfb_usual_ranges
  use gfb_kinds, only: wp
  implicit none (type, external)
  private

  !> What is usual of a key's values; signs do not count, and zero is always usual.
  type, public :: range_type
    character(len=13) :: group
    character(len=23) :: key
    real(wp) :: low, high       !! smallest and largest usual value [the key's unit]
    character(len=8) :: unit    !! the key's
    character(len=19) :: others !! what the number may be meant in: units, the likeliest first
  end type range_type

  !> Why a key has no usual range.
  type, public :: reason_type
    character(len=13) :: group
    character(len=23) :: key
    character(len=40) :: reason
  end type reason_type

  !> A unit in which a number may be meant.
  type, public :: unit_type
    character(len=8) :: name
    real(wp) :: size !! in the key's unit [1]
  end type unit_type

  type(range_type), parameter, public :: ranges(*) = [ &
    range_type('bearing', 'radius', 1.0e-3_wp, 0.5_wp, 'm', 'mm,um'), &
    range_type('bearing', 'length', 1.0e-3_wp, 2.0_wp, 'm', 'mm,um'), &
    range_type('bearing', 'clearance', 1.0e-6_wp, 1.0e-3_wp, 'm', 'um,mm'), &
    range_type('bearing', 'assembly_interference', 0.0_wp, 1.0e-3_wp, 'm', 'um,mm'), &
    range_type('bearing', 'leading_edge_angle', 0.0_wp, 6.3_wp, 'rad', 'deg'), &
    range_type('bore', 'wave_amplitude', 0.0_wp, 1.0e-3_wp, 'm', 'um,mm'), &
    range_type('bore', 'wave_angle', 0.0_wp, 6.3_wp, 'rad', 'deg'), &
    range_type('bore', 'shim_angle', 0.0_wp, 6.3_wp, 'rad', 'deg'), &
    range_type('bore', 'shim_height', 0.0_wp, 1.0e-3_wp, 'm', 'um,mm'), &
    range_type('bore', 'shim_arc', 0.0_wp, 6.3_wp, 'rad', 'deg'), &
    range_type('bore', 'shim_ramp', 0.0_wp, 6.3_wp, 'rad', 'deg'), &
    range_type('bore', 'profile_height', 0.0_wp, 1.0e-3_wp, 'm', 'um,mm'), &
    range_type('bore', 'profile_angle', 0.0_wp, 6.3_wp, 'rad', 'deg'), &
    range_type('gas', 'viscosity', 3.0e-6_wp, 3.0e-4_wp, 'Pa s', 'uPa s,mPa s'), &
    range_type('gas', 'ambient_pressure', 1.0e3_wp, 5.0e7_wp, 'Pa', 'bar,kPa,MPa'), &
    range_type('gas', 'mean_free_path', 1.0e-10_wp, 1.0e-4_wp, 'm', 'um,mm'), &
    range_type('gas', 'temperature', 50.0_wp, 3000.0_wp, 'K', ''), &
    range_type('gas', 'molar_mass', 1.0e-3_wp, 0.5_wp, 'kg/mol', 'g/mol'), &
    range_type('gas', 'critical_pressure', 1.0e5_wp, 5.0e7_wp, 'Pa', 'bar,kPa,MPa'), &
    range_type('gas', 'critical_temperature', 3.0_wp, 2000.0_wp, 'K', ''), &
    range_type('gas', 'acentric_factor', 0.0_wp, 1.5_wp, '1', '%'), &
    range_type('gas', 'viscosity_exponent', 0.0_wp, 3.0_wp, '1', '%'), &
    range_type('gas', 'density_table_pressure', 1.0e2_wp, 1.0e8_wp, 'Pa', 'bar,kPa,MPa'), &
    range_type('gas', 'density_table_density', 1.0e-3_wp, 2.0e3_wp, 'kg/m^3', 'g/cm^3,g/m^3'), &
    range_type('gas', 'density_table_viscosity', 3.0e-6_wp, 3.0e-4_wp, 'Pa s', 'uPa s,mPa s'), &
    range_type('operation', 'speed_rpm', 100.0_wp, 2.0e6_wp, 'rpm', 'krpm'), &
    range_type('operation', 'eccentricity', 0.0_wp, 2.0e-3_wp, 'm', 'mm,um'), &
    range_type('operation', 'tilt', 0.0_wp, 2.0e-2_wp, 'rad', 'mrad,deg'), &
    range_type('operation', 'leading_edge_lift', 0.0_wp, 2.0e-3_wp, 'm', 'mm,um'), &
    range_type('operation', 'leading_edge_lift_edge', 0.0_wp, 2.0e-3_wp, 'm', 'mm,um'), &
    range_type('top_foil', 'thickness', 5.0e-6_wp, 2.0e-3_wp, 'm', 'mm,um'), &
    range_type('top_foil', 'free_radius', 1.0e-3_wp, 1.0e3_wp, 'm', 'mm,um'), &
    range_type('top_foil', 'youngs_modulus', 1.0e9_wp, 2.0e12_wp, 'Pa', 'GPa,MPa'), &
    range_type('top_foil', 'density', 500.0_wp, 2.5e4_wp, 'kg/m^3', 'g/cm^3,t/mm^3'), &
    range_type('bump_foil', 'thickness', 5.0e-6_wp, 2.0e-3_wp, 'm', 'mm,um'), &
    range_type('bump_foil', 'youngs_modulus', 1.0e9_wp, 2.0e12_wp, 'Pa', 'GPa,MPa'), &
    range_type('bump_foil', 'density', 500.0_wp, 2.5e4_wp, 'kg/m^3', 'g/cm^3,t/mm^3'), &
    range_type('bump_foil', 'half_length', 1.0e-4_wp, 2.0e-2_wp, 'm', 'mm,um'), &
    range_type('bump_foil', 'height', 2.0e-5_wp, 1.0e-2_wp, 'm', 'mm,um'), &
    range_type('bump_foil', 'crest_gap', 0.0_wp, 1.0e-3_wp, 'm', 'um,mm'), &
    range_type('bump_foil', 'corner_gap', 0.0_wp, 1.0e-3_wp, 'm', 'um,mm'), &
    range_type('bump_foil', 'height_deviation', 1.0e-9_wp, 1.0e-3_wp, 'm', 'um,mm'), &
    range_type('bump_foil', 'pitch', 2.0e-4_wp, 5.0e-2_wp, 'm', 'mm,um'), &
    range_type('bump_foil', 'bump_pitch', 2.0e-4_wp, 5.0e-2_wp, 'm', 'mm,um'), &
    range_type('bump_foil', 'bump_half_length', 1.0e-4_wp, 2.0e-2_wp, 'm', 'mm,um'), &
    range_type('bump_foil', 'bump_height', 2.0e-5_wp, 1.0e-2_wp, 'm', 'mm,um'), &
    range_type('bump_foil', 'bump_thickness', 5.0e-6_wp, 2.0e-3_wp, 'm', 'mm,um'), &
    range_type('bump_foil', 'strip_pitch', 2.0e-4_wp, 5.0e-2_wp, 'm', 'mm,um'), &
    range_type('bump_foil', 'strip_half_length', 1.0e-4_wp, 2.0e-2_wp, 'm', 'mm,um'), &
    range_type('bump_foil', 'strip_height', 2.0e-5_wp, 1.0e-2_wp, 'm', 'mm,um'), &
    range_type('bump_foil', 'strip_thickness', 5.0e-6_wp, 2.0e-3_wp, 'm', 'mm,um'), &
    range_type('bump_foil', 'strip_offset', 0.0_wp, 5.0e-2_wp, 'm', 'mm,um'), &
    range_type('bump_foil', 'cut_width', 1.0e-5_wp, 2.0e-2_wp, 'm', 'mm,um'), &
    range_type('bump_foil', 'width', 1.0e-3_wp, 2.0_wp, 'm', 'mm,um'), &
    range_type('contact', 'friction_top', 0.0_wp, 2.0_wp, '1', '%'), &
    range_type('contact', 'friction_sleeve', 0.0_wp, 2.0_wp, '1', '%'), &
    range_type('contact', 'stick_length', 1.0e-12_wp, 1.0e-3_wp, 'm', 'um,mm'), &
    range_type('shaft_contact', 'roughness', 1.0e-8_wp, 1.0e-4_wp, 'm', 'um,mm'), &
    range_type('shaft_contact', 'pressure', 1.0e4_wp, 1.0e11_wp, 'Pa', 'MPa,GPa'), &
    range_type('shaft_contact', 'friction', 0.0_wp, 2.0_wp, '1', '%'), &
    range_type('strip_load', 'pressure', 0.0_wp, 1.0e9_wp, 'Pa', ''), &
    range_type('strip_load', 'bump_pressure', 0.0_wp, 1.0e9_wp, 'Pa', ''), &
    range_type('strip_load', 'maximum_displacement', 0.0_wp, 1.0e-2_wp, 'm', 'mm,um'), &
    range_type('strip_load', 'maximum_force', 1.0e-6_wp, 1.0e6_wp, 'N', 'mN'), &
    range_type('model', 'foundation_stiffness', 1.0e6_wp, 1.0e20_wp, 'N/m^3', 'N/mm^3'), &
    range_type('capacity', 'smallest_gap', 1.0e-8_wp, 5.0e-4_wp, 'm', 'um,mm'), &
    range_type('solver', 'touch_down_gap', 0.0_wp, 1.0e-4_wp, 'm', 'mm,um'), &
    range_type('solver', 'residual_tolerance', 0.0_wp, 1.0e-2_wp, '1', '%'), &
    range_type('solver', 'step_tolerance', 0.0_wp, 1.0e-2_wp, '1', '%'), &
    range_type('solver', 'smallest_load_step', 0.0_wp, 1.0_wp, '1', '%'), &
    range_type('pads', 'arc', 0.0_wp, 6.3_wp, 'rad', 'deg'), &
    range_type('pads', 'first_leading_edge', 0.0_wp, 6.3_wp, 'rad', 'deg'), &
    range_type('pads', 'gap', 0.0_wp, 6.3_wp, 'rad', 'deg'), &
    range_type('dynamics', 'frequencies', 0.0_wp, 1.0e7_wp, 'rad/s', 'rpm'), &
    range_type('dynamics', 'frequency_ratios', 0.0_wp, 100.0_wp, '1', '%'), &
    range_type('dynamics', 'loss_factor', 0.0_wp, 2.0_wp, '1', '%'), &
    range_type('dynamics', 'foundation_damping', 1.0_wp, 1.0e11_wp, 'N s/m^3', 'N s/mm^3'), &
    range_type('dynamics', 'maxwell_stiffness', 1.0e3_wp, 1.0e20_wp, 'N/m^3', 'N/mm^3'), &
    range_type('dynamics', 'maxwell_time', 1.0e-9_wp, 1.0e2_wp, 's', 'ms,us'), &
    range_type('dynamics', 'vibration_amplitudes', 1.0e-13_wp, 1.0e-4_wp, 'm', 'um,mm'), &
    range_type('rotor', 'mass', 1.0e-4_wp, 1.0e4_wp, 'kg', 'g'), &
    range_type('rotor', 'transverse_inertia', 1.0e-10_wp, 50.0_wp, 'kg m^2', 'kg mm^2,g mm^2'), &
    range_type('rotor', 'polar_inertia', 1.0e-10_wp, 50.0_wp, 'kg m^2', 'kg mm^2,g mm^2'), &
    range_type('rotor', 'bearing_distance', 1.0e-3_wp, 5.0_wp, 'm', 'mm,um'), &
    range_type('transient', 'turns', 0.0_wp, 1.0e5_wp, '1', ''), &
    range_type('transient', 'duration', 1.0e-8_wp, 1.0e3_wp, 's', 'ms,us'), &
    range_type('transient', 'steps_per_turn', 0.0_wp, 1.0e5_wp, '1', ''), &
    range_type('transient', 'time_tolerance', 1.0e-10_wp, 0.1_wp, '1', '%'), &
    range_type('transient', 'start_load', 0.0_wp, 1.0e6_wp, 'N', 'mN'), &
    range_type('transient', 'final_speed_rpm', 100.0_wp, 2.0e6_wp, 'rpm', 'krpm'), &
    range_type('transient', 'ramp_time', 1.0e-8_wp, 1.0e3_wp, 's', 'ms,us'), &
    range_type('transient', 'unbalance', 1.0e-13_wp, 1.0e-2_wp, 'kg m', 'kg mm,g mm'), &
    range_type('transient', 'unbalance_angle', 0.0_wp, 6.3_wp, 'rad', 'deg'), &
    range_type('transient', 'couple_unbalance', 1.0e-14_wp, 1.0e-2_wp, 'kg m^2', &
               'kg mm^2,g mm^2'), &
    range_type('transient', 'couple_unbalance_angle', 0.0_wp, 6.3_wp, 'rad', 'deg'), &
    range_type('transient', 'pulse', 0.0_wp, 1.0e3_wp, 'N s', 'mN s'), &
    range_type('transient', 'couple_pulse', 0.0_wp, 1.0e2_wp, 'N m s', 'N mm s'), &
    range_type('transient', 'pulse_start', 0.0_wp, 1.0e3_wp, 's', 'ms,us'), &
    range_type('transient', 'pulse_length', 1.0e-8_wp, 10.0_wp, 's', 'ms,us'), &
    range_type('transient', 'base_time', 0.0_wp, 1.0e4_wp, 's', 'ms,us'), &
    range_type('transient', 'base_acceleration_x', 0.0_wp, 1.0e5_wp, 'm/s^2', 'mm/s^2'), &
    range_type('transient', 'base_acceleration_y', 0.0_wp, 1.0e5_wp, 'm/s^2', 'mm/s^2'), &
    range_type('transient', 'orbit_radius', 1.0e-13_wp, 1.0e-3_wp, 'm', 'um,mm'), &
    range_type('transient', 'orbit_frequency', 0.0_wp, 1.0e7_wp, 'rad/s', 'rpm'), &
    range_type('transient', 'foundation_damping', 1.0_wp, 1.0e11_wp, 'N s/m^3', 'N s/mm^3'), &
    range_type('transient', 'maxwell_stiffness', 1.0e3_wp, 1.0e20_wp, 'N/m^3', 'N/mm^3'), &
    range_type('transient', 'maxwell_time', 1.0e-9_wp, 1.0e2_wp, 's', 'ms,us'), &
    range_type('transient', 'field_interval', 1.0e-9_wp, 1.0e3_wp, 's', 'ms,us'), &
    range_type('transient', 'field_start', 0.0_wp, 1.0e3_wp, 's', 'ms,us'), &
    range_type('transient', 'steady_tolerance', 0.0_wp, 0.5_wp, '1', '%'), &
    range_type('transient', 'largest_orbit', 1.0e-10_wp, 2.0e-3_wp, 'm', 'um,mm'), &
    range_type('periodic', 'step', 1.0e-6_wp, 10.0_wp, '1', '%'), &
    range_type('periodic', 'first_amplitude', 1.0e-6_wp, 0.9_wp, '1', '%'), &
    range_type('periodic', 'unbalance', 1.0e-13_wp, 1.0e-2_wp, 'kg m', 'kg mm,g mm'), &
    range_type('periodic', 'unbalance_angle', 0.0_wp, 6.3_wp, 'rad', 'deg'), &
    range_type('periodic', 'foundation_damping', 1.0_wp, 1.0e11_wp, 'N s/m^3', 'N s/mm^3'), &
    range_type('periodic', 'maxwell_stiffness', 1.0e3_wp, 1.0e20_wp, 'N/m^3', 'N/mm^3'), &
    range_type('periodic', 'maxwell_time', 1.0e-9_wp, 1.0e2_wp, 's', 'ms,us')]

  type(reason_type), parameter, public :: reasons(*) = [ &
    reason_type('operation', 'load', 'judged against what films carry'), &
    reason_type('sweep', 'values', 'those of what the sweep changes'), &
    reason_type('periodic', 'final_value', 'that of the parameter'), &
    reason_type('sensitivity', 'tolerances', 'those of the parameters'), &
    reason_type('contact', 'normal_stiffness', 'its unit follows from the exponent'), &
    reason_type('pads', 'preload', 'from 0 to below 1 by its rule'), &
    reason_type('pads', 'preload_offset', 'from 0 to 1 by its rule'), &
    reason_type('capacity', 'contact_part', 'between 0 and 1 by its rule'), &
    reason_type('top_foil', 'poissons_ratio', 'between -1 and 0.5 by its rule'), &
    reason_type('bump_foil', 'poissons_ratio', 'between -1 and 0.5 by its rule'), &
    reason_type('contact', 'exponent', 'bounded by its rule'), &
    reason_type('mesh', 'edge_refinement', 'from 1 to 100 by its rule'), &
    reason_type('accuracy', 'target', 'between 0 and 1 by its rule'), &
    reason_type('sample', 'quantiles', 'between 0 and 1 by their rule')]

  type(unit_type), parameter, public :: units(*) = [ &
    unit_type('mm', 1.0e-3_wp), unit_type('um', 1.0e-6_wp), &
    unit_type('mrad', 1.0e-3_wp), unit_type('deg', acos(-1.0_wp)/180.0_wp), &
    unit_type('rpm', acos(-1.0_wp)/30.0_wp), unit_type('krpm', 1.0e3_wp), &
    unit_type('ms', 1.0e-3_wp), unit_type('us', 1.0e-6_wp), unit_type('mm/s^2', 1.0e-3_wp), &
    unit_type('kPa', 1.0e3_wp), unit_type('bar', 1.0e5_wp), unit_type('MPa', 1.0e6_wp), &
    unit_type('GPa', 1.0e9_wp), unit_type('uPa s', 1.0e-6_wp), unit_type('mPa s', 1.0e-3_wp), &
    unit_type('%', 1.0e-2_wp), unit_type('g', 1.0e-3_wp), unit_type('g/mol', 1.0e-3_wp), &
    unit_type('g/cm^3', 1.0e3_wp), unit_type('g/m^3', 1.0e-3_wp), &
    unit_type('t/mm^3', 1.0e12_wp), unit_type('N/mm^3', 1.0e9_wp), &
    unit_type('N s/mm^3', 1.0e9_wp), unit_type('mN', 1.0e-3_wp), unit_type('mN s', 1.0e-3_wp), &
    unit_type('N mm s', 1.0e-3_wp), unit_type('kg mm', 1.0e-3_wp), unit_type('g mm', 1.0e-6_wp), &
    unit_type('kg mm^2', 1.0e-6_wp), unit_type('g mm^2', 1.0e-9_wp)]
end module gfb_usual_ranges
