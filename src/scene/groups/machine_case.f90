!> Groups of a machine, a shaft that bends in several bearings: `&shaft`, `&discs`, `&bearings`,
!> `&loads`, and `&machine` itself.
module gfb_machine_case
  use gfb_kinds, only: wp
  use gfb_shaft_element, only: cowper_coefficient
  use gfb_case_keys, only: case_keys_type, unless, from_to, not_negative, positive, any_value, &
                           longest_list, longest_string, between, rule_type
  use gfb_analysis_row, only: analysis_row_type
  use gfb_operation_case, only: other_sense
  use gfb_text, only: text
  implicit none (type, external)
  private
  public :: read_machine_case

  character(len=*), parameter, public :: machine_group = 'shaft' !! what has it is a machine
  integer, parameter :: most_bearings = 20
  real(wp), parameter :: most_elements = 100.0_wp !! of a segment [1]
  real(wp), parameter :: rounding = 1.0e-12_wp   !! of a length [1]
  real(wp), parameter :: coldest = 150.0_wp, hottest = 2000.0_wp !! else a temperature is not in K
  real(wp), parameter :: standard_gravity = 9.81_wp !! [m/s^2]

  !> Where something stands along the shaft, and what acts there.
  type, public :: machine_case_type
    logical :: present = .false. !! the case is one of a machine
    ! Segments, one value each.
    real(wp), allocatable :: length(:), outer_diameter(:), inner_diameter(:) !! [m]
    real(wp), allocatable :: youngs_modulus(:), shear_modulus(:) !! [Pa]
    real(wp), allocatable :: density(:)           !! [kg/m^3]
    real(wp), allocatable :: shear_coefficient(:) !! [1]
    integer :: elements = 4                       !! of a segment
    real(wp) :: material_damping = 0.0_wp         !! [s]
    ! Discs.
    real(wp), allocatable :: disc_position(:) !! [m]
    real(wp), allocatable :: disc_mass(:)     !! [kg]
    real(wp), allocatable :: transverse_inertia(:), polar_inertia(:) !! [kg m^2]
    real(wp), allocatable :: disc_conductance(:) !! to what is around them [W/K]
    real(wp), allocatable :: disc_temperature(:) !! of that [K]
    ! Bearings.
    character(len=longest_string), allocatable :: file(:) !! as they were typed
    real(wp), allocatable :: bearing_position(:) !! [m]
    real(wp), allocatable :: offset(:, :)        !! of the sleeves, (x and y, bearing) [m]
    real(wp), allocatable :: axial_offset(:)     !! of them, along z [m]
    real(wp), allocatable :: misalignment(:, :)  !! about x and y [rad]
    real(wp), allocatable :: facing(:)           !! 1: as in their files; -1: mirrored in z [1]
    real(wp), allocatable :: support_mass(:)     !! of the sleeves [kg]
    real(wp), allocatable :: support_stiffness(:, :) !! (x and y, bearing); 0: rigid [N/m]
    real(wp), allocatable :: support_damping(:, :)   !! [N s/m]
    ! Loads.
    real(wp), allocatable :: load_position(:) !! [m]
    real(wp), allocatable :: force(:, :)      !! (x and y, load) [N]
    real(wp), allocatable :: moment(:, :)     !! about x and y [N m]
    ! The machine.
    real(wp) :: speed_rpm = 0.0_wp
    real(wp) :: axial_load = 0.0_wp !! on the shaft, along -z [N]
    logical :: axial_load_given = .false.
    real(wp) :: gravity(2) = [-standard_gravity, 0.0_wp] !! x and y [m/s^2]
    logical :: journal_tilts = .true. !! each film sees how its journal is tilted
    real(wp), allocatable :: station(:) !! where the shaft's place is asked for [m]
    ! Heat along the shaft.
    real(wp), allocatable :: shaft_conductivity(:) !! of segments, if it conducts [W/(m K)]
    real(wp) :: shaft_end_conductance(2) = 0.0_wp  !! of the first and the last end [W/K]
    real(wp) :: shaft_end_temperature(2) = 0.0_wp  !! beyond them [K]
    real(wp) :: shaft_film_conductance = 0.0_wp    !! of the bare surface [W/(m^2 K)]
    real(wp) :: shaft_film_temperature = 0.0_wp    !! around that [K]
  end type machine_case_type

contains

  !> Reads the groups; without `&shaft` there is no machine, and the others have no use.
  subroutine read_machine_case(keys, machine, analysis)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(machine_case_type), intent(out) :: machine !! what they ask for
    type(analysis_row_type), intent(in) :: analysis !! of the case file

    machine%present = analysis%is_machine
    call read_shaft(keys, machine, analysis)
    call read_discs(keys, machine, analysis)
    call read_bearings(keys, machine, analysis)
    call read_loads(keys, machine, analysis)
    call read_operation(keys, machine, analysis)
    if (machine%present) call check_places(keys, machine)
  end subroutine read_machine_case

  !> All that is on the shaft stands between its ends; a shaft that nothing holds has no place, and
  !> groups of bearings are not those of the machine.
  subroutine check_places(keys, machine)
    type(case_keys_type), intent(inout) :: keys
    type(machine_case_type), intent(in) :: machine
    character(len=*), parameter :: of_bearings(*) = &
      [character(len=9) :: 'model', 'mesh', 'solver', 'top_foil', 'bump_foil']
    real(wp) :: whole
    integer :: i, line

    do i = 1, size(of_bearings)
      where (keys%book%groups%name == of_bearings(i)) keys%book%groups%is_echoed = .false.
      where (keys%book%keys%group == of_bearings(i)) keys%book%keys%is_echoed = .false.
      line = keys%line_of_group(trim(of_bearings(i)))
      if (line > 0) call keys%complaints%add(line, '&'//trim(of_bearings(i))//': the group '// &
                                             'belongs into the files of the bearings')
    end do
    whole = sum(machine%length)
    call check_list('discs', 'positions', machine%disc_position)
    call check_list('bearings', 'positions', machine%bearing_position)
    call check_list('loads', 'positions', machine%load_position)
    call check_list('machine', 'stations', machine%station)
    call keys%rule('bearings', 'files', size(machine%file) == 1 .and. &
                   .not. machine%journal_tilts, 'names one bearing, which holds no shaft '// &
                   'without journal_tilts: name two')

  contains

    !> A list of places.
    subroutine check_list(group, name, position)
      character(len=*), intent(in) :: group, name
      real(wp), intent(in) :: position(:) !! [m]

      do i = 1, size(position)
        call keys%rule(group, name, position(i) > whole*(1.0_wp + rounding) .and. whole > 0.0_wp, &
                       'must not be beyond the end of the shaft, '//text(whole)//' m', i)
      end do
    end subroutine check_list
  end subroutine check_places

  !> Why a group beside `&shaft` has no use.
  pure function misplaced(analysis) result(words)
    type(analysis_row_type), intent(in) :: analysis
    character(len=:), allocatable :: words
    words = unless(analysis%is_machine, 'needs &shaft')
  end function misplaced

  !> `&shaft`.
  subroutine read_shaft(keys, machine, analysis)
    type(case_keys_type), intent(inout) :: keys
    type(machine_case_type), intent(inout) :: machine
    type(analysis_row_type), intent(in) :: analysis
    real(wp), allocatable :: ratio(:)
    character(len=:), allocatable :: refused
    integer :: n

    refused = unless(analysis%is_machine .or. .not. analysis%is_known(), 'has no use with '// &
                     "analysis = '"//trim(analysis%word)//"': a machine has 'equilibrium', "// &
                     "'linear_dynamics', 'transient' and 'periodic'")
    call keys%start_group(machine_group, optional=.true., misplaced=refused)
    call keys%real_list_key('lengths', machine%length, longest_list, 'm', &
                            'lengths of the segments of the shaft, from its first end, z = 0, on', &
                            positive, machine%present)
    n = size(machine%length)
    call read_values(keys, n, 'outer_diameters', machine%outer_diameter, 'm', 'outer diameter '// &
                     'of each segment, or of all', positive, machine%present)
    call read_values(keys, n, 'inner_diameters', machine%inner_diameter, 'm', 'diameter of the '// &
                     'bore of each segment, or of all', not_negative, .false., '0: solid')
    call read_values(keys, n, 'youngs_modulus', machine%youngs_modulus, 'Pa', "Young's modulus "// &
                     'of each segment, or of all', positive, machine%present)
    call read_values(keys, n, 'poissons_ratio', ratio, '1', "Poisson's ratio of each segment, "// &
                     'or of all', between(-1.0_wp, 0.5_wp), .false., &
                     'required without `shear_modulus`')
    call read_values(keys, n, 'shear_modulus', machine%shear_modulus, 'Pa', 'shear modulus of '// &
                     'each segment, or of all', positive, .false., &
                     'required without `poissons_ratio`')
    call read_values(keys, n, 'density', machine%density, 'kg/m^3', 'density of each segment, '// &
                     'or of all', positive, machine%present)
    call read_values(keys, n, 'shear_coefficient', machine%shear_coefficient, '1', 'part of '// &
                     'the section that shears', positive, .false., "Cowper's, with the bore")
    call keys%integer_key('elements', machine%elements, 'beam elements of each segment, at '// &
                          'least', from_to(1.0_wp, most_elements))
    call keys%real_key('material_damping', machine%material_damping, 's', 'damping of the '// &
                       "shaft's material over its stiffness, as the turning shaft feels it: "// &
                       'above the first critical speed it excites', not_negative)
    if (.not. machine%present) return
    call keys%rule(machine_group, 'inner_diameters', any(machine%inner_diameter >= &
                   machine%outer_diameter .and. machine%outer_diameter > 0.0_wp), &
                   'must be less than the outer diameters')
    call keys%rule(machine_group, 'shear_modulus', any(machine%shear_modulus > 0.0_wp) .and. &
                   keys%meant(machine_group, 'poissons_ratio'), 'must not stand beside '// &
                   'poissons_ratio')
    call keys%rule(machine_group, 'poissons_ratio', .not. (any(machine%shear_modulus > 0.0_wp) &
                   .or. keys%meant(machine_group, 'poissons_ratio')), 'is required, or '// &
                   'shear_modulus')
    where (machine%shear_modulus > 0.0_wp)
      ratio = 0.5_wp*machine%youngs_modulus/machine%shear_modulus - 1.0_wp
    else where
      machine%shear_modulus = 0.5_wp*machine%youngs_modulus/(1.0_wp + ratio)
    end where
    where (.not. machine%shear_coefficient > 0.0_wp .and. machine%outer_diameter > 0.0_wp)
      machine%shear_coefficient = cowper_coefficient(ratio, machine%inner_diameter/ &
                                                     machine%outer_diameter)
    end where
  end subroutine read_shaft

  !> A value of each segment, disc, bearing or load, or one for all; 0 where there is none.
  subroutine read_values(keys, count, name, values, unit, meaning, rule, required, default)
    type(case_keys_type), intent(inout) :: keys
    integer, intent(in) :: count !! of them
    character(len=*), intent(in) :: name !! of the key
    real(wp), allocatable, intent(out) :: values(:) !! (count) [its unit]
    character(len=*), intent(in) :: unit, meaning
    type(rule_type), intent(in) :: rule
    logical, intent(in) :: required
    character(len=*), intent(in), optional :: default !! in words

    call keys%real_list_key(name, values, longest_list, unit, meaning, rule, required, default)
    if (size(values) > 1 .and. size(values) /= count) then
      call keys%complain(trim(keys%key%group), name, 'must have one value for all, or '// &
                         text(count)//', not '//text(size(values)))
      values = values(:1)
    end if
    if (size(values) == 0) values = [0.0_wp]
    if (size(values) == 1) values = spread(values(1), 1, count)
  end subroutine read_values

  !> Values in the plane of x and in that of y, two keys.
  subroutine read_planes(keys, count, name, values, unit, meaning, way, rule, default)
    type(case_keys_type), intent(inout) :: keys
    integer, intent(in) :: count !! of what has them
    character(len=*), intent(in) :: name !! of the keys, without their axes
    real(wp), allocatable, intent(out) :: values(:, :) !! (x and y, count) [their unit]
    character(len=*), intent(in) :: unit, meaning
    character(len=*), intent(in) :: way !! along or about the axes
    type(rule_type), intent(in) :: rule
    character(len=*), intent(in) :: default !! in words
    real(wp), allocatable :: x(:), y(:)

    call read_values(keys, count, name//'_x', x, unit, meaning//', '//way//' x', rule, .false., &
                     default)
    call read_values(keys, count, name//'_y', y, unit, 'the same '//way//' y', rule, .false., &
                     default)
    values = transpose(reshape([x, y], [count, 2]))
  end subroutine read_planes

  !> `&discs`.
  subroutine read_discs(keys, machine, analysis)
    type(case_keys_type), intent(inout) :: keys
    type(machine_case_type), intent(inout) :: machine
    type(analysis_row_type), intent(in) :: analysis
    character(len=*), parameter :: group = 'discs'
    logical :: given
    integer :: n

    call keys%start_group(group, optional=.true., present_in_file=given, &
                          misplaced=misplaced(analysis))
    given = given .and. machine%present
    call keys%real_list_key('positions', machine%disc_position, longest_list, 'm', 'where '// &
                            'rigid discs sit on the shaft, from its first end', not_negative, given)
    n = size(machine%disc_position)
    call read_values(keys, n, 'masses', machine%disc_mass, 'kg', 'mass of each disc, or of all', &
                     positive, given)
    call read_values(keys, n, 'transverse_inertias', machine%transverse_inertia, 'kg m^2', &
                     'moment of inertia of each about an axis across it', not_negative, .false., &
                     'half of the polar one')
    call read_values(keys, n, 'polar_inertias', machine%polar_inertia, 'kg m^2', &
                     'moment of inertia of each about the axis of the shaft', not_negative, &
                     .false., '0')
    call read_values(keys, n, 'heat_conductances', machine%disc_conductance, 'W/K', 'from each '// &
                     'disc, as warm as the shaft there, to what is around it: a wheel in its '// &
                     'gas', not_negative, .false., '0')
    call read_values(keys, n, 'heat_temperatures', machine%disc_temperature, 'K', 'temperature '// &
                     'of that', from_to(coldest, hottest), .false., &
                     'required with heat_conductances')
    call keys%rule(group, 'heat_temperatures', any(machine%disc_conductance > 0.0_wp .and. &
                   .not. machine%disc_temperature > 0.0_wp), 'is required with heat_conductances')
    call keys%rule(group, 'heat_conductances', any(machine%disc_conductance > 0.0_wp) .and. &
                   .not. keys%holds('machine', 'shaft_conductivity'), &
                   'needs shaft_conductivity in &machine')
    where (.not. machine%transverse_inertia > 0.0_wp)
      machine%transverse_inertia = 0.5_wp*machine%polar_inertia
    end where
    call keys%rule(group, 'polar_inertias', any(machine%polar_inertia > &
                   2.0_wp*machine%transverse_inertia), 'must not be more than twice the '// &
                   'transverse inertia: no body is so')
  end subroutine read_discs

  !> `&bearings`.
  subroutine read_bearings(keys, machine, analysis)
    type(case_keys_type), intent(inout) :: keys
    type(machine_case_type), intent(inout) :: machine
    type(analysis_row_type), intent(in) :: analysis
    character(len=*), parameter :: group = 'bearings'
    integer :: n

    call keys%start_group(group, required=machine%present, optional=.not. machine%present, &
                          misplaced=misplaced(analysis))
    call keys%strings_key('files', machine%file, most_bearings, 'a case file of each bearing, '// &
                          'as seen from the folder of this one; its speed, load and tilt are '// &
                          'those of the machine', machine%present)
    n = size(machine%file)
    call keys%real_list_key('positions', machine%bearing_position, most_bearings, 'm', 'where '// &
                            'their middles are, from the first end of the shaft', not_negative, &
                            machine%present)
    call keys%rule(group, 'positions', size(machine%bearing_position) /= n .and. n > 0, &
                   'must have one value a file: '//text(n)//', not '// &
                   text(size(machine%bearing_position)))
    call read_planes(keys, n, 'offset', machine%offset, 'm', 'how far each sleeve stands off '// &
                     'the line of the machine', 'along', any_value, '0')
    call read_values(keys, n, 'offset_z', machine%axial_offset, 'm', 'how far the pads of each '// &
                     'thrust bearing stand off their place along z: two that face each other '// &
                     'have their play by it', any_value, .false., '0')
    call read_planes(keys, n, 'misalignment', machine%misalignment, 'rad', 'how each sleeve is '// &
                     'turned out of the line of the machine', 'about', any_value, '0')
    call read_values(keys, n, 'facing', machine%facing, '1', 'which way the pads of each '// &
                     'thrust bearing face: 1 along +z, as in its file, -1 along -z, as its '// &
                     'mirror image', any_value, .false., '1')
    where (.not. abs(machine%facing) > 0.0_wp) machine%facing = 1.0_wp
    call keys%rule(group, 'facing', any(abs(abs(machine%facing) - 1.0_wp) > rounding), &
                   'must be 1 or -1')
    call read_supports(keys, machine, n, group)
  end subroutine read_bearings

  !> What holds the sleeves.
  subroutine read_supports(keys, machine, count, group)
    type(case_keys_type), intent(inout) :: keys
    type(machine_case_type), intent(inout) :: machine
    integer, intent(in) :: count !! of bearings
    character(len=*), intent(in) :: group
    logical :: springs(count)

    call read_values(keys, count, 'support_mass', machine%support_mass, 'kg', 'mass of each '// &
                     'sleeve on its support', not_negative, .false., '0')
    call read_planes(keys, count, 'support_stiffness', machine%support_stiffness, 'N/m', &
                     'stiffness of the support between each sleeve and the base', 'along', &
                     not_negative, '0: a rigid support')
    call read_planes(keys, count, 'support_damping', machine%support_damping, 'N s/m', &
                     'damping of the support', 'along', not_negative, '0')
    springs = all(machine%support_stiffness > 0.0_wp, 1)
    call keys%rule(group, 'support_stiffness_y', any(machine%support_stiffness(1, :) > 0.0_wp &
                   .neqv. springs), 'must be given where support_stiffness_x is')
    call keys%rule(group, 'support_stiffness_x', any(machine%support_stiffness(2, :) > 0.0_wp &
                   .neqv. springs), 'must be given where support_stiffness_y is')
    call keys%rule(group, 'support_mass', any(machine%support_mass > 0.0_wp .and. .not. springs), &
                   'needs support_stiffness_x and support_stiffness_y')
    call keys%rule(group, 'support_damping_x', any(any(machine%support_damping > 0.0_wp, 1) .and. &
                   .not. springs), 'needs support_stiffness_x and support_stiffness_y')
  end subroutine read_supports

  !> `&loads`.
  subroutine read_loads(keys, machine, analysis)
    type(case_keys_type), intent(inout) :: keys
    type(machine_case_type), intent(inout) :: machine
    type(analysis_row_type), intent(in) :: analysis
    logical :: given
    integer :: n

    call keys%start_group('loads', optional=.true., present_in_file=given, &
                          misplaced=misplaced(analysis))
    call keys%real_list_key('positions', machine%load_position, longest_list, 'm', 'where '// &
                            'forces and moments act on the shaft, from its first end', &
                            not_negative, given .and. machine%present)
    n = size(machine%load_position)
    call read_planes(keys, n, 'forces', machine%force, 'N', 'force of each on the shaft', 'along', &
                     any_value, '0')
    call read_planes(keys, n, 'moments', machine%moment, 'N m', 'moment of each on the shaft', &
                     'about', any_value, '0')
  end subroutine read_loads

  !> `&machine`.
  subroutine read_operation(keys, machine, analysis)
    type(case_keys_type), intent(inout) :: keys
    type(machine_case_type), intent(inout) :: machine
    type(analysis_row_type), intent(in) :: analysis

    call keys%start_group('machine', required=machine%present, optional=.not. machine%present, &
                          misplaced=misplaced(analysis))
    call keys%real_key('speed_rpm', machine%speed_rpm, 'rpm', 'speed of the shaft', any_value, &
                       machine%present)
    if (machine%speed_rpm < 0.0_wp) call keys%complain('machine', 'speed_rpm', other_sense)
    call keys%real_vector_key('gravity', machine%gravity, 'm/s^2', 'acceleration of free fall, '// &
                              'x and y')
    call keys%real_key('axial_load', machine%axial_load, 'N', 'force on the shaft along -z, '// &
                       'which thrust bearings carry; that which presses it on pads that face +z', &
                       any_value, default='required with a thrust bearing', &
                       given=machine%axial_load_given)
    call keys%logical_key('journal_tilts', machine%journal_tilts, 'each film sees how its '// &
                          'journal is tilted in its sleeve; else journals count as parallel, '// &
                          'and carry no moment')
    call keys%real_list_key('stations', machine%station, longest_list, 'm', 'further places '// &
                            'along the shaft at which results are asked for', not_negative, &
                            .false., 'none: bearings and discs')
    call read_shaft_heat(keys, machine)
  end subroutine read_operation

  !> How the shaft conducts heat; without conductivity each bearing's file says it for itself.
  subroutine read_shaft_heat(keys, machine)
    type(case_keys_type), intent(inout) :: keys
    type(machine_case_type), intent(inout) :: machine
    character(len=*), parameter :: group = 'machine', conductivity = 'shaft_conductivity'
    character(len=*), parameter :: others(*) = [character(len=22) :: 'shaft_end_conductance', &
      'shaft_end_temperature', 'shaft_film_conductance', 'shaft_film_temperature']
    logical :: ends, conducts
    integer :: i

    conducts = keys%holds(group, conductivity)
    call read_values(keys, size(machine%length), conductivity, machine%shaft_conductivity, &
                     'W/(m K)', 'conductivity of each segment of the shaft, or of all, along '// &
                     'which the heat of all bearings flows', positive, .false., &
                     'each bearing''s file has a shaft of its own')
    if (.not. conducts) machine%shaft_conductivity = machine%shaft_conductivity(:0)
    call keys%real_vector_key('shaft_end_conductance', machine%shaft_end_conductance, 'W/K', &
                              'from the first and the last end of the shaft to far places; 0: '// &
                              'insulated', not_negative)
    call keys%real_vector_key('shaft_end_temperature', machine%shaft_end_temperature, 'K', &
                              'temperatures of these places', from_to(coldest, hottest), &
                              default='required with shaft_end_conductance', given=ends)
    call keys%real_key('shaft_film_conductance', machine%shaft_film_conductance, 'W/(m^2 K)', &
                       'from the surface of the shaft, where no bearing is around it, to what '// &
                       'is around it', not_negative)
    call keys%real_key('shaft_film_temperature', machine%shaft_film_temperature, 'K', &
                       'temperature of that', from_to(coldest, hottest), &
                       default='required with shaft_film_conductance')
    do i = 1, size(others)
      call keys%rule(group, trim(others(i)), .not. conducts .and. &
                     keys%meant(group, trim(others(i))), 'needs shaft_conductivity')
    end do
    call keys%rule(group, 'shaft_end_temperature', any(machine%shaft_end_conductance > 0.0_wp) &
                   .and. .not. ends, 'is required with shaft_end_conductance')
    call keys%rule(group, 'shaft_film_temperature', machine%shaft_film_conductance > 0.0_wp .and. &
                   .not. machine%shaft_film_temperature > 0.0_wp, &
                   'is required with shaft_film_conductance')
  end subroutine read_shaft_heat
end module gfb_machine_case
