!> Groups of what moves: `&dynamics`, `&transient` and `&periodic`, each an analysis of its own, the
!> `&rotor` with its `&unbalance`, and `&foil_damping`, what foils are then.
module gfb_motion_cases
  use gfb_kinds, only: wp
  use gfb_units, only: pi
  use gfb_bearing_row, only: bearing_row_type, needs_journal
  use gfb_case_keys, only: case_keys_type, no_default, unless, from_to, not_negative, positive, &
                           any_value, longest_list, at_least, between
  use gfb_maxwell_arm, only: maxwell_arm_type
  use gfb_analysis_row, only: analysis_row_type, analysis_equilibrium, analysis_fixed_position
  use gfb_operation_case, only: operation_case_type, angular_speed
  use gfb_key_effect, only: acts_on_all
  implicit none (type, external)
  private
  public :: foil_damping_case_type, read_foil_damping_case, rotor_case_type, read_rotor_case, &
            unbalance_case_type, read_unbalance_case, dynamics_case_type, read_dynamics_case, &
            analysis_of_state, frequencies_at, periodic_case_type, read_periodic_case, &
            transient_case_type, read_transient_case, duration_of

  character(len=*), parameter :: needs_dynamics = "it needs analysis = 'linear_dynamics'"

  character(len=*), parameter :: no_use_of_machine = 'has no use beside &shaft: it is of one '// &
                                 'bearing'

  integer, parameter, public :: mass_auto = 1 !! the foil has its mass where it counts
  integer, parameter, public :: mass_on = 2   !! it has it
  integer, parameter, public :: mass_off = 3  !! it has none
  character(len=*), parameter :: mass_words(*) = [character(len=4) :: 'auto', 'on', 'off']

  !> What is asked for.
  type :: foil_damping_case_type
    real(wp) :: foundation_damping = 0.0_wp !! of a damper beside each spring [N s/m^3]
    type(maxwell_arm_type) :: arm           !! a spring and a dashpot in series beside it
    real(wp) :: loss_factor = 0.0_wp        !! eta of meshed foils at the next frequency [1]
    real(wp) :: loss_frequency = 0.0_wp     !! at which their viscous losses have it [rad/s]
    integer :: foil_mass = mass_auto
    integer :: foil_modes = 2               !! kept inside each condensed bump
  contains
    procedure :: loss_time
  end type foil_damping_case_type

  character(len=*), parameter :: group = 'rotor', mass = 'mass', polar = 'polar_inertia', &
                                 transverse = 'transverse_inertia', distance = 'bearing_distance'

  !> The rotor; without the last three it moves in x and y alone.
  type :: rotor_case_type
    logical :: present = .false.            !! the group stands in the file
    real(wp) :: mass = 0.0_wp               !! that this bearing carries [kg]
    real(wp) :: transverse_inertia = 0.0_wp !! of the whole rotor [kg m^2]
    real(wp) :: polar_inertia = 0.0_wp      !! of the whole rotor [kg m^2]
    real(wp) :: bearing_distance = 0.0_wp   !! from midplane to midplane [m]
    real(wp) :: distance_in_time = 0.0_wp   !! the same where it is followed over time, else 0 [m]
  end type rotor_case_type

  !> Its unbalance, of orbits and over time.
  type :: unbalance_case_type
    real(wp) :: static = 0.0_wp       !! that this bearing carries [kg m]
    real(wp) :: angle = 0.0_wp        !! of it at the beginning [rad]
    real(wp) :: couple = 0.0_wp       !! of a rotor that tilts [kg m^2]
    real(wp) :: couple_angle = 0.0_wp !! of that at +z at the beginning [rad]
    real(wp), allocatable :: position(:) !! of those of a machine along its shaft [m]
    real(wp), allocatable :: value(:)    !! of each [kg m]
    real(wp), allocatable :: angles(:)   !! of each at the beginning [rad]
  end type unbalance_case_type

  integer, parameter, public :: tangent_stick = 1 !! contacts that rub stick under vibration
  integer, parameter :: tangent_slip = 2  !! they slide on as they did
  character(len=*), parameter :: tangent_words(*) = [character(len=5) :: 'stick', 'slip']

  !> What is asked for.
  type :: dynamics_case_type
    logical :: present = .false.              !! the analysis is 'linear_dynamics'
    real(wp), allocatable :: frequencies(:)   !! [rad/s]
    real(wp), allocatable :: ratios(:)        !! the same over the speed of the shaft, or none [1]
    real(wp) :: interpolation_tolerance = 0.0_wp !! of lines between frequencies; 0: as given [1]
    integer :: contact_tangent = tangent_stick
    real(wp) :: loss_factor = 0.0_wp          !! eta of the foil's stiffness [1]
    real(wp), allocatable :: amplitudes(:)    !! of the shaft; contacts slide to and fro [m]
    real(wp) :: largest_frequency = 0.0_wp    !! of modes of a machine; 0: by its speed [rad/s]
    real(wp), allocatable :: response_speeds(:) !! of unbalance of a machine, or none [rpm]
    logical :: stability = .true.             !! critical mass and modes too; not a key
  end type dynamics_case_type

  integer, parameter :: motion_forced = 1 !! with the turns of the shaft
  integer, parameter, public :: motion_free = 2   !! by itself: a limit cycle
  character(len=*), parameter :: motion_words(*) = [character(len=6) :: 'forced', 'free']
  integer, parameter, public :: follow_nothing = 1, follow_speed = 2, follow_unbalance = 3, &
    follow_mass = 4
  character(len=*), parameter :: parameter_words(*) = [character(len=9) :: 'none', 'speed_rpm', &
    'unbalance', 'mass']

  !> What is asked for.
  type :: periodic_case_type
    logical :: present = .false.            !! the analysis is 'periodic'
    integer :: motion = motion_forced
    integer :: parameter = follow_nothing   !! over which the orbits are followed
    real(wp) :: final_value = 0.0_wp        !! up or down to this one [rpm], [kg m], [kg]
    integer :: points = 40                  !! of the branch, at most
    real(wp) :: step = 0.25_wp              !! from point to point, at most [1]
    real(wp) :: first_amplitude = 0.03_wp   !! of a limit cycle, over the clearance [1]
    integer :: steps_per_turn = 100
    integer :: period_turns = 1             !! of a forced motion
    integer :: start_turns = 2              !! marched before the first orbit is looked for
  end type periodic_case_type

  integer, parameter :: longest_table = 100000

  integer, parameter, public :: method_bdf2 = 1, method_esdirk4 = 2
  character(len=*), parameter :: method_words(*) = [character(len=7) :: 'bdf2', 'esdirk4']
  !> Steps of a turn at least, by the method: where they are given, where the error chooses [1].
  real(wp), parameter, public :: fewest_steps(2) = [20.0_wp, 10.0_wp]
  real(wp), parameter, public :: chosen_steps(2) = [60.0_wp, 20.0_wp]

  !> What is asked for.
  type :: transient_case_type
    logical :: present = .false.           !! the analysis is 'transient'
    real(wp) :: turns = 0.0_wp             !! to be computed; 0: `duration` says it [1]
    real(wp) :: duration = 0.0_wp          !! the same [s]
    real(wp) :: steps_per_turn = 0.0_wp    !! 0: the error chooses them [1]
    integer :: time_method = method_bdf2   !! how a step is taken
    real(wp) :: time_tolerance = 1.0e-5_wp !! error of a step over the clearance, then [1]
    real(wp) :: unsolved_part = 0.01_wp    !! of a step's error, to which it is solved [1]
    real(wp) :: start_load(2) = 0.0_wp     !! whose equilibrium the shaft begins with [N]
    logical :: start_load_given = .false.  !! else that of `&operation`
    real(wp) :: final_speed_rpm = 0.0_wp   !! [rpm]
    logical :: speed_changes = .false.     !! to that one
    real(wp) :: ramp_time = 0.0_wp         !! in which it is reached; 0: the whole time [s]
    real(wp) :: pulse(2) = 0.0_wp          !! [N s]
    real(wp) :: couple_pulse(2) = 0.0_wp   !! [N m s]
    real(wp) :: pulse_position = 0.0_wp    !! on a machine's shaft [m]
    logical :: pulse_is_placed = .false.   !! else it acts through the centre of mass
    real(wp) :: start_gravity(2) = 0.0_wp  !! in whose equilibrium a machine begins [m/s^2]
    logical :: start_gravity_given = .false. !! else that of `&machine`
    real(wp) :: pulse_start = 0.0_wp       !! [s]
    real(wp) :: pulse_length = 0.0_wp      !! [s]
    real(wp), allocatable :: base_time(:)           !! [s]
    real(wp), allocatable :: base_acceleration_x(:) !! [m/s^2]
    real(wp), allocatable :: base_acceleration_y(:) !! [m/s^2]
    real(wp) :: orbit_radius = 0.0_wp       !! of a sleeve whose position is given [m]
    real(wp) :: orbit_frequency = 0.0_wp    !! [rad/s]
    integer :: output_every = 1             !! steps
    real(wp) :: field_interval = 0.0_wp     !! between stored fields; 0: the last ones alone [s]
    real(wp) :: field_start = 0.0_wp        !! first of these times [s]
    real(wp) :: steady_tolerance = 0.0_wp   !! 0: all turns are computed [1]
    real(wp) :: largest_orbit = 0.0_wp      !! 0: however large [m]
  end type transient_case_type

contains

  !> Reads the group.
  subroutine read_foil_damping_case(keys, damping, analysis)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(foil_damping_case_type), intent(out) :: damping !! what `&foil_damping` asks for
    type(analysis_row_type), intent(in) :: analysis !! of the case file
    real(wp), parameter :: most_modes = 1000.0_wp !! in a piece
    character(len=:), allocatable :: massless
    logical :: moves

    moves = analysis%takes('foil_damping')
    massless = unless(.not. analysis%takes('periodic'), &
                      "has no use with analysis = 'periodic': there foils have no mass")
    call keys%start_group('foil_damping', optional=.not. moves, &
                          misplaced=analysis%refusal('foil_damping'), acts_on=acts_on_all)
    call keys%idle(unless(analysis%takes('dynamics'), needs_dynamics))
    call keys%real_key('foundation_damping', damping%foundation_damping, 'N s/m^3', &
                       'viscous damping of the elastic foundation, pressure over velocity', &
                       not_negative)
    call keys%real_key('maxwell_stiffness', damping%arm%stiffness, 'N/m^3', 'spring of the '// &
                       'Maxwell arm, a spring and a dashpot in series beside each spring of '// &
                       'the elastic foundation', positive, default=no_default)
    call keys%real_key('maxwell_time', damping%arm%time, 's', 'relaxation time of that arm: '// &
                       'its dashpot over its spring', positive, default=no_default)
    call keys%real_key('loss_factor', damping%loss_factor, '1', &
                       'loss factor of top foil and bumps, of a plate that of its springs, at '// &
                       '`loss_frequency`: it is viscous, and grows with the frequency', &
                       not_negative)
    call keys%real_key('loss_frequency', damping%loss_frequency, 'rad/s', &
                       'circular frequency at which they have it: that of the expected whirl', &
                       positive, default=no_default)
    call keys%choice_key('foil_mass', damping%foil_mass, mass_words, &
                         'whether top foil and bumps have their mass: where the frequencies '// &
                         'that are asked for, or with which the shaft moves, are high enough '// &
                         'for it to count, always, never', useless=massless)
    call keys%integer_key('foil_modes', damping%foil_modes, &
                          'fixed-interface modes kept inside each condensed piece of the bumps '// &
                          'that has its mass', from_to(0.0_wp, most_modes), useless=massless)
  end subroutine read_foil_damping_case

  !> Viscous losses of meshed foils: what they add to the elastic forces over the rates of these.
  pure real(wp) function loss_time(self) result(time)
    class(foil_damping_case_type), intent(in) :: self !! what `&foil_damping` asks for
    ! of a rule that is broken there is none [s]
    time = 0.0_wp
    if (self%loss_frequency > 0.0_wp) time = self%loss_factor/self%loss_frequency
  end function loss_time

  !> Reads the group; without it no rotor is on the bearing.
  subroutine read_rotor_case(keys, rotor, bearing, analysis)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(rotor_case_type), intent(out) :: rotor !! what `&rotor` says
    type(bearing_row_type), intent(in) :: bearing !! the kind of bearing
    type(analysis_row_type), intent(in) :: analysis !! of the case file
    character(len=:), allocatable :: misplaced, along

    along = unless(bearing%moves_across, needs_journal//': the rotor moves along its axis')
    misplaced = analysis%refusal(group)
    call keys%start_group(group, optional=.true., present_in_file=rotor%present, &
                          misplaced=misplaced, acts_on=acts_on_all)
    call keys%idle(unless(rotor%present, 'the file has no group &rotor'))
    call keys%real_key(mass, rotor%mass, 'kg', &
                       'mass that this bearing carries: half of a rotor on two; the load is '// &
                       'given apart from it', positive, .true.)
    call keys%real_key(transverse, rotor%transverse_inertia, 'kg m^2', &
                       'moment of inertia of the whole rotor about an axis across it through '// &
                       'its centre of mass, which is halfway between two equal bearings', &
                       positive, default=no_default, useless=along)
    call keys%real_key(polar, rotor%polar_inertia, 'kg m^2', &
                       'moment of inertia of the whole rotor about its own axis', not_negative, &
                       useless=along)
    call keys%real_key(distance, rotor%bearing_distance, 'm', &
                       'distance of the two bearings, from midplane to midplane', positive, &
                       default=no_default, useless=along)
    if (analysis%takes('transient')) rotor%distance_in_time = rotor%bearing_distance
  end subroutine read_rotor_case

  !> Reads `&unbalance`.
  subroutine read_unbalance_case(keys, unbalance, analysis)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(unbalance_case_type), intent(out) :: unbalance !! what `&unbalance` says
    type(analysis_row_type), intent(in) :: analysis !! of the case file
    character(len=:), allocatable :: no_couple, no_list, no_share
    logical :: drives

    drives = analysis%takes('unbalance')
    no_couple = unless(.not. analysis%takes('periodic'), &
                       "has no use with analysis = 'periodic': the shaft moves in x and y alone")
    call keys%start_group('unbalance', optional=.not. drives, &
                          misplaced=analysis%refusal('unbalance'))
    no_list = unless(analysis%is_machine, 'needs &shaft: one bearing has `unbalance`')
    no_share = unless(.not. analysis%is_machine, 'has no use beside &shaft: `values` are those '// &
                      'of the machine')
    if (analysis%is_machine) no_couple = no_share
    call keys%real_key('unbalance', unbalance%static, 'kg m', &
                       'unbalance that this bearing carries: mass times its distance from '// &
                       'the axis', not_negative, useless=no_share)
    call keys%real_key('unbalance_angle', unbalance%angle, 'rad', 'direction of the unbalance '// &
                       'at the beginning, of the time or of a period, from x towards y', &
                       any_value, useless=no_share)
    call keys%real_list_key('positions', unbalance%position, longest_list, 'm', 'where the '// &
                            'unbalances of a machine are, from the first end of its shaft', &
                            not_negative, .false., 'none', useless=no_list)
    call keys%real_list_key('values', unbalance%value, longest_list, 'kg m', 'mass times '// &
                            'distance from the axis of each', not_negative, .false., 'none', &
                            useless=no_list)
    call keys%real_list_key('angles', unbalance%angles, longest_list, 'rad', 'direction of '// &
                            'each at the beginning, from x towards y', any_value, .false., '0', &
                            useless=no_list)
    call keys%rule('unbalance', 'values', size(unbalance%value) /= size(unbalance%position), &
                   'must have one value a position')
    if (size(unbalance%angles) == 0) unbalance%angles = 0.0_wp*unbalance%position
    call keys%rule('unbalance', 'angles', size(unbalance%angles) /= size(unbalance%position), &
                   'must have one value a position')
    call keys%real_key('couple_unbalance', unbalance%couple, 'kg m^2', &
                       'of a rotor that tilts on two bearings: an unbalance times its distance '// &
                       'along the axis from an equal and opposite one', not_negative, &
                       useless=no_couple)
    call keys%real_key('couple_unbalance_angle', unbalance%couple_angle, 'rad', &
                       'direction of the one at +z at the beginning, from x towards y', &
                       any_value, useless=no_couple)
  end subroutine read_unbalance_case

  !> The analysis that finds the state about which the shaft vibrates, or from which it
  !> moves: a given load is balanced, else the given position is kept. A limit is one of
  !> equilibria. The group `&operation` is not read yet.
  pure function analysis_of_state(analysis, has_load, has_position) result(state)
    type(analysis_row_type), intent(in) :: analysis !! of the case file
    logical, intent(in) :: has_load, has_position !! keys that `&operation` holds
    type(analysis_row_type) :: state

    state = analysis
    if (.not. analysis%has_film) return
    state = analysis_equilibrium
    if (.not. analysis%holds) return
    if (.not. analysis%floats .or. (has_position .and. .not. has_load)) then
      state = analysis_fixed_position
    end if
  end function analysis_of_state

  !> Reads the group. Frequencies over the speed become frequencies.
  subroutine read_dynamics_case(keys, dynamics, operation, analysis)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(dynamics_case_type), intent(out) :: dynamics !! what `&dynamics` asks for
    type(operation_case_type), intent(in) :: operation !! what `&operation` asks for
    type(analysis_row_type), intent(in) :: analysis !! of the case file
    character(len=:), allocatable :: of_bearing

    dynamics%present = analysis%takes('dynamics') .and. .not. analysis%is_machine
    of_bearing = unless(.not. analysis%is_machine, 'has no use beside &shaft: each motion of a '// &
                        'machine has its own frequency')
    call keys%start_group('dynamics', required=dynamics%present, optional=.not. dynamics%present, &
                          misplaced=analysis%refusal('dynamics'), acts_on=acts_on_all)
    call keys%idle(unless(dynamics%present, needs_dynamics))
    call keys%real_list_key('frequencies', dynamics%frequencies, longest_list, 'rad/s', &
                            'circular frequencies at which stiffness and damping are asked for', &
                            positive, .false., 'required without `frequency_ratios`', &
                            useless=of_bearing)
    call keys%real_list_key('frequency_ratios', dynamics%ratios, longest_list, '1', &
                            'the same over the speed of the shaft', positive, .false., &
                            'required without `frequencies`', useless=of_bearing)
    call keys%real_key('largest_frequency', dynamics%largest_frequency, 'rad/s', 'circular '// &
                       'frequency up to which the modes of a machine are looked for', positive, &
                       default='1.5 times the speed', &
                       useless=unless(analysis%is_machine, 'needs &shaft: one bearing has '// &
                       '`frequencies`'))
    call keys%real_list_key('response_speeds', dynamics%response_speeds, longest_list, 'rpm', &
                            'speeds at which a machine is asked how unbalance moves it; '// &
                            'between them its critical speeds are looked for', positive, .false., &
                            'those of the sweep', &
                            useless=unless(analysis%is_machine, 'needs &shaft: one bearing has '// &
                                           'orbits over the speed in &periodic'))
    dynamics%frequencies = frequencies_at(dynamics, angular_speed(operation%speed_rpm))
    call keys%real_key('interpolation_tolerance', dynamics%interpolation_tolerance, '1', &
                       'further frequencies are put between those given until straight lines '// &
                       'between neighbours miss stiffness and damping by no more than this, '// &
                       'over their largest entry (0.02, say); 0: none', not_negative)
    call keys%choice_key('contact_tangent', dynamics%contact_tangent, tangent_words, &
                         'what contacts that rub do under a small vibration: stick, as those '// &
                         'do that it has shaken down, or slide on as when they were loaded')
    call keys%real_key('loss_factor', dynamics%loss_factor, '1', &
                       'loss factor of the foil: its stiffness times 1 + i loss_factor', &
                       not_negative)
    call keys%real_list_key('vibration_amplitudes', dynamics%amplitudes, longest_list, 'm', &
                            'amplitudes of the shaft along x and along y at which stiffness '// &
                            'and damping are asked for too, contacts sliding to and fro', &
                            positive, .false., 'none: small ones alone')
  end subroutine read_dynamics_case

  !> The frequencies at a speed of the shaft.
  pure function frequencies_at(dynamics, speed) result(frequencies)
    type(dynamics_case_type), intent(in) :: dynamics !! what `&dynamics` asks for
    real(wp), intent(in) :: speed !! of the shaft [rad/s]
    real(wp), allocatable :: frequencies(:) !! [rad/s]

    frequencies = dynamics%frequencies
    if (size(dynamics%ratios) > 0) frequencies = dynamics%ratios*speed
  end function frequencies_at

  !> Reads the group.
  subroutine read_periodic_case(keys, periodic, analysis)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(periodic_case_type), intent(out) :: periodic !! what `&periodic` asks for
    type(analysis_row_type), intent(in) :: analysis !! of the case file
    real(wp), parameter :: fewest_steps = 20.0_wp !! of a turn [1]
    real(wp), parameter :: most_points = 1.0e6_wp

    periodic%present = analysis%takes('periodic')
    call keys%start_group('periodic', required=periodic%present, optional=.not. periodic%present, &
                          misplaced=analysis%refusal('periodic'))
    call keys%choice_key('motion', periodic%motion, motion_words, &
                         'with the turns of the shaft, by its unbalance; or by itself: a '// &
                         'limit cycle, from the onset of whirl on')
    call keys%choice_key('parameter', periodic%parameter, parameter_words, &
                         'over what the orbits are followed, through folds: from its value in '// &
                         '&operation, &unbalance or &rotor to `final_value`')
    call keys%real_key('final_value', periodic%final_value, 'of the parameter', &
                       'value of the parameter at which the branch ends', not_negative, &
                       default=no_default)
    call keys%integer_key('points', periodic%points, 'orbits of the branch, at most', &
                          from_to(1.0_wp, most_points))
    call keys%real_key('step', periodic%step, '1', &
                       'longest step along the branch: in the shaft''s place over the '// &
                       'clearance '// &
                       'and the parameter over its way', positive)
    call keys%real_key('first_amplitude', periodic%first_amplitude, '1', &
                       'of the first limit cycle after the onset, over the clearance', &
                       between(0.0_wp, 1.0_wp))
    call keys%integer_key('steps_per_turn', periodic%steps_per_turn, &
                          'equal steps of time in a turn of the shaft', at_least(fewest_steps))
    call keys%integer_key('period_turns', periodic%period_turns, &
                          'turns in the period of a forced motion', positive)
    call keys%integer_key('start_turns', periodic%start_turns, &
                          'periods of a forced motion that are marched from rest before the '// &
                          'first orbit is looked for', at_least(0.0_wp))
  end subroutine read_periodic_case

  !> Reads the group.
  subroutine read_transient_case(keys, transient, operation, analysis)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(transient_case_type), intent(out) :: transient !! what `&transient` asks for
    type(operation_case_type), intent(in) :: operation !! what `&operation` asks for
    type(analysis_row_type), intent(in) :: analysis !! of the case file
    character(len=:), allocatable :: of_bearing

    transient%present = analysis%takes('transient')
    call keys%start_group('transient', required=transient%present, &
                          optional=.not. transient%present, &
                          misplaced=analysis%refusal('transient'))
    call keys%real_key('turns', transient%turns, '1', 'turns of the shaft that are computed', &
                       positive, default='required without `duration`')
    call keys%real_key('duration', transient%duration, 's', 'the same as a time', positive, &
                       default='required without `turns`')
    call keys%real_key('steps_per_turn', transient%steps_per_turn, '1', &
                       'steps of a turn of the shaft, all equal; default: the error chooses '// &
                       'them, 60 and more, with esdirk4 20 and more', positive, &
                       default='by the error')
    call keys%real_key('time_tolerance', transient%time_tolerance, '1', &
                       'error of a step in the position of the shaft, over the clearance, '// &
                       'where it chooses the steps', positive)
    call read_drive(keys, transient, operation, analysis%is_machine)
    of_bearing = unless(.not. analysis%is_machine, no_use_of_machine)
    call keys%choice_key('time_method', transient%time_method, method_words, &
                         'how a step is taken: bdf2 by a difference of order 2, esdirk4 by '// &
                         'five stages of order 4, each like a step of bdf2: 10 to 20 a turn', &
                         useless=of_bearing)
    ! Who asks for a tolerance gets it; an echo, which has both keys, is read as its case was.
    if (analysis%is_machine .or. keys%holds('solver', 'step_tolerance')) then
      transient%unsolved_part = 0.0_wp
    end if
    call keys%real_key('unsolved_part', transient%unsolved_part, '1', &
                       'of the error that a step has by its length: so much its equations may '// &
                       'leave unsolved; 0, and by default where step_tolerance is given: each '// &
                       'is solved to that', from_to(0.0_wp, 1.0_wp), useless=of_bearing)
    call keys%real_key('orbit_radius', transient%orbit_radius, 'm', &
                       'radius of the circle on which a sleeve moves whose eccentricity is '// &
                       'given: it begins at +x from there', not_negative, useless=of_bearing)
    call keys%real_key('orbit_frequency', transient%orbit_frequency, 'rad/s', &
                       'circular frequency of that motion, with the shaft''s sense', any_value, &
                       useless=of_bearing)
    call keys%integer_key('output_every', transient%output_every, &
                          'steps from one line of the history to the next', positive)
    call keys%real_key('field_interval', transient%field_interval, 's', &
                       'time from one stored film and foil to the next, each at the step that '// &
                       'reaches it; 0: those of the end alone', not_negative)
    call keys%real_key('field_start', transient%field_start, 's', 'first of these times', &
                       not_negative)
    call keys%real_key('steady_tolerance', transient%steady_tolerance, '1', &
                       'a steady orbit is asked for: ends when two turns of the shaft differ '// &
                       'by no more than this part of the clearance, and has not reached it '// &
                       'where the time is over before; 0: all of the time', not_negative)
    call keys%real_key('largest_orbit', transient%largest_orbit, 'm', &
                       'ends when the shaft has left its first position by more, in either '// &
                       'bearing; 0: never', &
                       not_negative)
  end subroutine read_transient_case

  !> What drives the shaft.
  subroutine read_drive(keys, transient, operation, is_machine)
    type(case_keys_type), intent(inout) :: keys
    type(transient_case_type), intent(inout) :: transient
    type(operation_case_type), intent(in) :: operation
    logical, intent(in) :: is_machine !! a shaft in several bearings
    character(len=:), allocatable :: of_bearing, of_machine

    of_bearing = unless(.not. is_machine, no_use_of_machine)
    of_machine = unless(is_machine, 'needs &shaft: it is of a machine')
    transient%start_load = operation%load
    call keys%real_vector_key('start_load', transient%start_load, 'N', &
                              'load whose equilibrium the shaft begins with, x and y; from '// &
                              'then on it bears the load of &operation', &
                              default='load of &operation', given=transient%start_load_given, &
                              useless=of_bearing)
    call keys%real_vector_key('start_gravity', transient%start_gravity, 'm/s^2', &
                              'of a machine: acceleration of free fall, x and y, in whose '// &
                              'equilibrium the shaft begins; from then on that of &machine '// &
                              'acts: 0, 0 drops it from the middle of its sleeves', &
                              default='gravity of &machine', &
                              given=transient%start_gravity_given, useless=of_machine)
    transient%final_speed_rpm = operation%speed_rpm
    call keys%real_key('final_speed_rpm', transient%final_speed_rpm, 'rpm', &
                       'speed to which the shaft runs up, or down, from that of &operation '// &
                       'or &machine', not_negative, default='that speed', &
                       given=transient%speed_changes)
    call keys%real_key('ramp_time', transient%ramp_time, 's', &
                       'time in which it reaches that speed, evenly', positive, &
                       default='the whole time')
    call keys%real_vector_key('pulse', transient%pulse, 'N s', &
                              'push on the shaft, force times time, x and y: a smooth one; on '// &
                              'two bearings what each of them carries, of a machine the whole')
    call keys%real_vector_key('couple_pulse', transient%couple_pulse, 'N m s', &
                              'turn of a rotor that tilts on two bearings, torque times time '// &
                              'about x and y, while the push takes; of a machine at '// &
                              '`pulse_position`')
    call keys%real_key('pulse_position', transient%pulse_position, 'm', 'where on the shaft of '// &
                       'a machine the push acts, from its first end', not_negative, &
                       default='its centre of mass', given=transient%pulse_is_placed, &
                       useless=of_machine)
    call keys%real_key('pulse_start', transient%pulse_start, 's', 'when it begins', not_negative)
    call keys%real_key('pulse_length', transient%pulse_length, 's', 'how long it takes', positive, &
                       default='required with `pulse` and `couple_pulse`')
    call keys%real_list_key('base_time', transient%base_time, longest_table, 's', &
                            'times of a table of the acceleration of the base, rising', &
                            any_value, .false., 'none: the base rests')
    call keys%real_list_key('base_acceleration_x', transient%base_acceleration_x, longest_table, &
                            'm/s^2', 'acceleration of the base along x at these times; linear '// &
                            'in between, none outside', any_value, .false., 'none')
    call keys%real_list_key('base_acceleration_y', transient%base_acceleration_y, longest_table, &
                            'm/s^2', 'the same along y', any_value, .false., 'none')
  end subroutine read_drive

  !> The whole time: as given, or that of the turns while the speed changes [s].
  pure function duration_of(transient, operation) result(duration)
    type(transient_case_type), intent(in) :: transient !! what `&transient` asks for
    type(operation_case_type), intent(in) :: operation !! what `&operation` asks for
    real(wp) :: duration, first, last, angle, rising

    duration = transient%duration
    if (duration > 0.0_wp) return
    first = angular_speed(operation%speed_rpm)
    last = angular_speed(transient%final_speed_rpm)
    angle = 2.0_wp*pi*transient%turns
    associate (ramp => transient%ramp_time)
      if (.not. ramp > 0.0_wp) then
        duration = 2.0_wp*angle/(first + last)
        return
      end if
      rising = 0.5_wp*(first + last)*ramp
      if (angle > rising) then
        duration = ramp + (angle - rising)/last
      else ! while it rises: the smaller root of the parabola
        duration = 2.0_wp*angle/(first + sqrt(first**2 + 2.0_wp*(last - first)/ramp*angle))
      end if
    end associate
  end function duration_of
end module gfb_motion_cases
