!> Values that a case file may have and yet hardly means, most often a number in another unit: the
!> usual ranges of the real keys; each has a row here, or a reason for having none.
module gfb_plausible_values
  use gfb_kinds, only: wp
  use gfb_case_keys, only: case_keys_type, longest_list
  use gfb_namelist_file, only: find_elements
  use gfb_namelist_values, only: read_real, value_string
  use gfb_motion_cases, only: follow_mass, follow_speed, follow_unbalance
  use gfb_scene, only: scene_type
  use gfb_sweep_case, only: sweep_case_type, sweep_keys, sweep_load, sweep_load_angle, &
                            sweep_speed, sweep_tilt_x, sweep_tilt_y
  use gfb_text, only: text
  implicit none (type, external)
  private
  public :: check_plausible

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
    range_type('foil_damping', 'foundation_damping', 1.0_wp, 1.0e11_wp, 'N s/m^3', 'N s/mm^3'), &
    range_type('foil_damping', 'maxwell_stiffness', 1.0e3_wp, 1.0e20_wp, 'N/m^3', 'N/mm^3'), &
    range_type('foil_damping', 'maxwell_time', 1.0e-9_wp, 1.0e2_wp, 's', 'ms,us'), &
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
    range_type('unbalance', 'unbalance', 1.0e-13_wp, 1.0e-2_wp, 'kg m', 'kg mm,g mm'), &
    range_type('unbalance', 'unbalance_angle', 0.0_wp, 6.3_wp, 'rad', 'deg'), &
    range_type('unbalance', 'couple_unbalance', 1.0e-14_wp, 1.0e-2_wp, 'kg m^2', &
               'kg mm^2,g mm^2'), &
    range_type('unbalance', 'couple_unbalance_angle', 0.0_wp, 6.3_wp, 'rad', 'deg'), &
    range_type('transient', 'pulse', 0.0_wp, 1.0e3_wp, 'N s', 'mN s'), &
    range_type('transient', 'couple_pulse', 0.0_wp, 1.0e2_wp, 'N m s', 'N mm s'), &
    range_type('transient', 'pulse_start', 0.0_wp, 1.0e3_wp, 's', 'ms,us'), &
    range_type('transient', 'pulse_length', 1.0e-8_wp, 10.0_wp, 's', 'ms,us'), &
    range_type('transient', 'base_time', 0.0_wp, 1.0e4_wp, 's', 'ms,us'), &
    range_type('transient', 'base_acceleration_x', 0.0_wp, 1.0e5_wp, 'm/s^2', 'mm/s^2'), &
    range_type('transient', 'base_acceleration_y', 0.0_wp, 1.0e5_wp, 'm/s^2', 'mm/s^2'), &
    range_type('transient', 'orbit_radius', 1.0e-13_wp, 1.0e-3_wp, 'm', 'um,mm'), &
    range_type('transient', 'orbit_frequency', 0.0_wp, 1.0e7_wp, 'rad/s', 'rpm'), &
    range_type('transient', 'field_interval', 1.0e-9_wp, 1.0e3_wp, 's', 'ms,us'), &
    range_type('transient', 'field_start', 0.0_wp, 1.0e3_wp, 's', 'ms,us'), &
    range_type('transient', 'steady_tolerance', 0.0_wp, 0.5_wp, '1', '%'), &
    range_type('transient', 'largest_orbit', 1.0e-10_wp, 2.0e-3_wp, 'm', 'um,mm'), &
    range_type('periodic', 'step', 1.0e-6_wp, 10.0_wp, '1', '%'), &
    range_type('periodic', 'first_amplitude', 1.0e-6_wp, 0.9_wp, '1', '%')]

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

  !> No gas film carries a larger load over p_a D L [1].
  real(wp), parameter :: most_carried = 50.0_wp

contains

  !> Warns of values that are hardly meant, key by key.
  subroutine check_plausible(keys, scene)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(scene_type), intent(in) :: scene !! what the case file asks for
    integer :: i, mistakes

    mistakes = keys%complaints%count + keys%warnings%count
    do i = 1, size(ranges)
      call check_values(keys, trim(ranges(i)%group), trim(ranges(i)%key), ranges(i))
    end do
    call check_sweep_values(keys, scene%sweep)
    call check_final_value(keys, scene%periodic%parameter)
    ! A load that is large against a wrong pressure is not wrong.
    if (keys%complaints%count + keys%warnings%count == mistakes) call check_load(keys, scene)
  end subroutine check_plausible

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

  !> The values of a sweep are those of what it changes; a start from rest has slow ones, too.
  subroutine check_sweep_values(keys, sweep)
    type(case_keys_type), intent(inout) :: keys
    type(sweep_case_type), intent(in) :: sweep
    character(len=:), allocatable :: key
    type(range_type) :: range
    integer :: i

    if (any(sweep%parameter == [0, sweep_load, sweep_load_angle, sweep_keys])) return
    key = 'eccentricity'
    if (sweep%parameter == sweep_speed) key = 'speed_rpm'
    if (sweep%parameter == sweep_tilt_x .or. sweep%parameter == sweep_tilt_y) key = 'tilt'
    do i = 1, size(ranges)
      if (ranges(i)%group /= 'operation' .or. ranges(i)%key /= key) cycle
      range = ranges(i)
      range%low = 0.0_wp
      call check_values(keys, 'sweep', 'values', range)
    end do
  end subroutine check_sweep_values

  !> The last value of a branch of orbits is that of its parameter.
  subroutine check_final_value(keys, parameter)
    type(case_keys_type), intent(inout) :: keys
    integer, intent(in) :: parameter !! over which the orbits are followed
    integer :: i

    do i = 1, size(ranges)
      associate (group => ranges(i)%group, key => ranges(i)%key)
        if ((parameter == follow_speed .and. group == 'operation' .and. key == 'speed_rpm') .or. &
            (parameter == follow_unbalance .and. group == 'unbalance' .and. &
             key == 'unbalance') .or. &
            (parameter == follow_mass .and. group == 'rotor' .and. key == 'mass')) then
          call check_values(keys, 'periodic', 'final_value', ranges(i))
        end if
      end associate
    end do
  end subroutine check_final_value

  !> Warns of a load that no film carries.
  subroutine check_load(keys, scene)
    type(case_keys_type), intent(inout) :: keys
    type(scene_type), intent(in) :: scene
    real(wp) :: carried, loads !! [N] by a film of p_a, at most; asked for

    associate (bearing => scene%bearing)
      carried = scene%gas%ambient_pressure*2.0_wp*bearing%radius*bearing%length
    end associate
    loads = norm2(scene%operation%load)
    if (.not. carried > 0.0_wp .or. loads <= most_carried*carried) return
    call keys%warn('operation', 'load', 'is '//text(loads/carried, 3)//' p_a D L; gas films '// &
                   'carry some p_a D L at most')
  end subroutine check_load

  !> Whether a value lies where values of its key lie.
  elemental function is_usual(range, number) result(usual)
    type(range_type), intent(in) :: range
    real(wp), intent(in) :: number !! [the key's unit]
    logical :: usual

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
    integer :: comma, i

    words = ''
    left = trim(range%others)
    do while (left /= '')
      comma = index(left//',', ',')
      name = left(:comma - 1)
      left = left(min(comma, len(left)) + 1:)
      do i = 1, size(units)
        if (units(i)%name /= name .or. .not. is_usual(range, number*units(i)%size)) cycle
        words = '; did you mean '//text(number)//' '//name//' = '//text(number*units(i)%size)
        if (range%unit /= '1') words = words//' '//trim(range%unit)
        words = words//'?'
        return
      end do
    end do
  end function guess
end module gfb_plausible_values
