!> Groups of what is asked for beside an answer: `&modes`, `&accuracy`, `&sample`, `&sensitivity`,
!> `&capacity` and `&output`.
module gfb_study_cases
  use gfb_kinds, only: wp
  use gfb_case_keys, only: case_keys_type, from_to, at_least, between, not_negative, positive, &
                           unless, no_default
  use gfb_analysis_row, only: analysis_row_type, limit_speed, limit_supply, limit_tilt
  use gfb_result_names, only: asked_names
  use gfb_result_table, only: name_length, strip
  use gfb_text, only: text
  use gfb_sweep_case, only: swept_key_type
  use gfb_key_effect, only: acts_on_all
  implicit none (type, external)
  private
  public :: output_case_type, read_output_case, modes_case_type, read_modes_case, &
            accuracy_case_type, read_accuracy_case, asked_name, sample_case_type, &
            read_sample_case, percent_of, sensitivity_case_type, read_sensitivity_case, &
            derives_vibrations, derives_stress, quantities_of, &
            capacity_case_type, read_capacity_case

  character(len=*), parameter :: field_words(*) = [character(len=10) :: &
                                                   'all', 'none', 'pressure', 'gap', 'deflection']

  real(wp), parameter :: most_steps = 1.0e6_wp

  !> Fields that are written for ParaView, and how often the state is saved to resume the run.
  type :: output_case_type
    logical :: pressure = .true.
    logical :: gap = .true.
    logical :: deflection = .true.
    integer :: restart_every = 0 !! points or load steps between restart files; 0: one a minute
  end type output_case_type

  integer, parameter, public :: part_half_arc = 1 !! from corner line to crest line, both fixed
  integer, parameter, public :: part_arc = 2      !! from corner line to corner line, both fixed
  integer, parameter, public :: part_flat = 3     !! between two corner lines, both fixed
  integer, parameter, public :: part_strip = 4    !! the whole strip, fixed at its fixed edge
  integer, parameter, public :: part_top_foil = 5 !! fixed at its fixed edge

  character(len=*), parameter, public :: part_words(*) = [character(len=8) :: 'half_arc', 'arc', &
                                                          'flat', 'strip', 'top_foil']

  !> The modes asked for.
  type :: modes_case_type
    integer :: count = 10
    integer :: part = part_strip
    integer :: substructure_modes = 0 !! Craig-Bampton modes kept in every super-element
  end type modes_case_type

  character(len=*), parameter, public :: all_coefficients = 'coefficients' !! not one number
  character(len=*), parameter, public :: of_vibrations(*) = &
    [character(len=13) :: 'critical_mass', 'whirl_ratio', 'stiffness_xx', 'stiffness_xy', &
     'stiffness_yx', 'stiffness_yy', 'damping_xx', 'damping_xy', 'damping_yx', 'damping_yy', &
     all_coefficients]

  !> The number and its error.
  type :: accuracy_case_type
    logical :: present = .false.    !! the case asks for it
    integer :: quantity = 0         !! number among the names that may be asked for
    real(wp) :: target = 1.0e-2_wp  !! error allowed, relative
    integer :: maximum_refinements = 4 !! of the first mesh, each by two
  end type accuracy_case_type

  real(wp), parameter :: usual(*) = [0.05_wp, 0.25_wp, 0.5_wp, 0.75_wp, 0.95_wp]
  integer, parameter :: most_members = 1000000
  real(wp), parameter :: rounding = 1.0e-9_wp !! of a percentage that is whole

  integer, parameter :: most_tolerances = 1000 !! of a list

  ! What a result whose derivatives are offered is of.
  integer, parameter, public :: of_film = 1           !! the film of any bearing
  integer, parameter, public :: of_journal = 2        !! a shaft's place and force across the axis
  integer, parameter, public :: of_top_foil = 3, of_bump_foil = 4 !! their largest stress
  integer, parameter, public :: of_heat = 5
  integer, parameter, public :: of_runner = 6         !! its gap and force along the axis
  integer, parameter, public :: of_whirl = 7
  integer, parameter, public :: of_coefficients = 8   !! stiffness, damping at the first frequency

  !> A result whose derivatives are offered.
  type :: derived_type
    character(len=28) :: name
    integer :: of !! what
  end type derived_type

  !> All of them, in the order in which the solver has them.
  type(derived_type), parameter :: derived_row(*) = [ &
    derived_type('eccentricity_x', of_journal), &
    derived_type('eccentricity_y', of_journal), &
    derived_type('attitude_angle', of_journal), &
    derived_type('force_x', of_journal), &
    derived_type('force_y', of_journal), &
    derived_type('torque_x', of_film), &
    derived_type('torque_y', of_film), &
    derived_type('friction_torque', of_film), &
    derived_type('power_loss', of_film), &
    derived_type('minimum_gap', of_film), &
    derived_type('maximum_pressure', of_film), &
    derived_type('minimum_pressure', of_film), &
    derived_type('maximum_top_foil_stress', of_top_foil), &
    derived_type('maximum_bump_foil_stress', of_bump_foil), &
    derived_type('film_temperature', of_heat), &
    derived_type('maximum_film_temperature', of_heat), &
    derived_type('top_foil_temperature', of_heat), &
    derived_type('maximum_top_foil_temperature', of_heat), &
    derived_type('shaft_temperature', of_heat), &
    derived_type('sleeve_temperature', of_heat), &
    derived_type('inlet_temperature', of_heat), &
    derived_type('cooling_outlet_temperature', of_heat), &
    derived_type('heat_to_shaft', of_heat), &
    derived_type('heat_to_top_foil', of_heat), &
    derived_type('heat_through_bumps', of_heat), &
    derived_type('heat_to_channel', of_heat), &
    derived_type('heat_by_gas', of_heat), &
    derived_type('running_clearance', of_heat), &
    derived_type('axial_gap', of_runner), &
    derived_type('axial_force', of_runner), &
    derived_type('critical_mass', of_whirl), &
    derived_type('whirl_ratio', of_whirl), &
    derived_type('stiffness_xx', of_coefficients), &
    derived_type('stiffness_xy', of_coefficients), &
    derived_type('stiffness_yx', of_coefficients), &
    derived_type('stiffness_yy', of_coefficients), &
    derived_type('damping_xx', of_coefficients), &
    derived_type('damping_xy', of_coefficients), &
    derived_type('damping_yx', of_coefficients), &
    derived_type('damping_yy', of_coefficients)]
  character(len=*), parameter, public :: quantity_words(size(derived_row)) = derived_row%name

  !> A key by which results are derived.
  type, public :: parameter_type
    type(swept_key_type) :: key
    character(len=:), allocatable :: unit
    real(wp) :: value = 0.0_wp     !! in the case file [its unit]
    real(wp) :: tolerance = 0.0_wp !! standard deviation [its unit]
  end type parameter_type

  !> What is drawn, and what is said of it.
  type :: sample_case_type
    logical :: present = .false.          !! the case asks for it
    integer :: count = 0                  !! members
    real(wp), allocatable :: quantiles(:) !! parts of the members below them [1]
    character(len=:), allocatable :: names !! `group%key, ...` of keys that are drawn
    integer :: strings = 0                 !! in which they stand
    real(wp), allocatable :: factors(:)    !! by which they scatter, one a key [1]
    type(parameter_type), allocatable :: parameter(:) !! the keys, once they are checked
  end type sample_case_type

  !> The derivatives asked for.
  type :: sensitivity_case_type
    logical :: present = .false.                        !! the case asks for them
    logical :: quantity(size(quantity_words)) = .false. !! whose derivatives are asked for
    character(len=:), allocatable :: names              !! `group%key, ...` of the keys
    integer :: strings = 0                              !! in which they stand
    real(wp), allocatable :: tolerances(:)              !! one a key, or none [their units]
    type(parameter_type), allocatable :: parameter(:)   !! the keys, once they are checked
  contains
    procedure, non_overridable :: asks
  end type sensitivity_case_type

  character(len=*), parameter :: axis_words(*) = ['x', 'y']
  character(len=*), parameter :: lift_words(*) = [character(len=15) :: 'speed', 'supply_pressure']

  !> What is asked for.
  type :: capacity_case_type
    integer :: limit = 0                 !! `limit_load`, `limit_speed`, ...; 0: none is
    real(wp) :: smallest_gap = 0.0_wp    !! that the film may have; 0: none is given [m]
    !> that film and top foil may have; 0: none is given [K]
    real(wp) :: highest_temperature = 0.0_wp
    real(wp) :: largest_stress = 0.0_wp !! that foils may have; 0: none is given [Pa]
    real(wp) :: contact_part = 1.0e-2_wp !! of the load that asperities may carry [1]
    integer :: tilt_axis = 1             !! about which the shaft tilts: 1 x, 2 y
  end type capacity_case_type

contains

  !> Reads the group.
  subroutine read_output_case(keys, output)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(output_case_type), intent(out) :: output !! what `&output` asks for
    logical :: chosen(size(field_words))

    chosen = field_words == 'all'
    call keys%start_group('output')
    call keys%words_key('fields', chosen, field_words, 'fields that are written for ParaView')
    call keys%rule('output', 'fields', any(chosen .and. field_words == 'none') .and. &
                   count(chosen) > 1, "'none' must stand alone")
    output%pressure = any(chosen .and. (field_words == 'all' .or. field_words == 'pressure'))
    output%gap = any(chosen .and. (field_words == 'all' .or. field_words == 'gap'))
    output%deflection = any(chosen .and. (field_words == 'all' .or. field_words == 'deflection'))
    call keys%integer_key('restart_every', output%restart_every, &
                          'sweep points, load steps of a strip or steps of time, after which '// &
                          '`CASE.restart.h5` is written for `--restart`; 0: once a minute', &
                          from_to(0.0_wp, most_steps))
  end subroutine read_output_case

  !> Reads the group.
  subroutine read_modes_case(keys, modes, analysis)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(modes_case_type), intent(out) :: modes !! what `&modes` asks for
    type(analysis_row_type), intent(in) :: analysis !! of the case file

    call keys%start_group('modes', optional=.not. analysis%takes('modes'), &
                          misplaced=analysis%refusal('modes'))
    call keys%integer_key('count', modes%count, 'number of modes, from the lowest frequency up', &
                          from_to(1.0_wp, 1000.0_wp))
    call keys%choice_key('part', modes%part, part_words, 'component that vibrates')
    call keys%integer_key('substructure_modes', modes%substructure_modes, &
                          'fixed-interface modes kept in every super-element of a strip '// &
                          '(Craig-Bampton)', from_to(0.0_wp, 1000.0_wp))
    if (modes%substructure_modes > 0 .and. modes%part /= part_strip .and. modes%part /= 0) then
      call keys%complain('modes', 'substructure_modes', "needs part = 'strip', which alone is "// &
                         'made of super-elements')
    end if
  end subroutine read_modes_case

  !> Reads the group.
  subroutine read_accuracy_case(keys, accuracy, analysis)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(accuracy_case_type), intent(out) :: accuracy !! what `&accuracy` asks for
    type(analysis_row_type), intent(in) :: analysis !! of the case file

    call keys%start_group('accuracy', optional=.true., present_in_file=accuracy%present, &
                          misplaced=analysis%refusal('accuracy'))
    call keys%choice_key('quantity', accuracy%quantity, asked_names(), &
                         'result whose error is estimated', accuracy%present)
    call keys%real_key('target', accuracy%target, '1', &
                       'error allowed, relative to the result; meshes are refined until the '// &
                       'estimate meets it', between(0.0_wp, 1.0_wp))
    call keys%integer_key('maximum_refinements', accuracy%maximum_refinements, &
                          'refinements, each by two, of a first mesh that is four times '// &
                          'coarser than `&mesh`', &
                          from_to(2.0_wp, 8.0_wp))
  end subroutine read_accuracy_case

  !> Name of the number that must be known so well.
  pure function asked_name(accuracy) result(name)
    type(accuracy_case_type), intent(in) :: accuracy !! with a quantity
    character(len=:), allocatable :: name
    character(len=name_length), allocatable :: names(:)

    names = asked_names()
    name = trim(names(accuracy%quantity))
  end function asked_name

  !> Reads the group.
  subroutine read_sample_case(keys, sample, misplaced)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(sample_case_type), intent(out) :: sample !! what `&sample` asks for
    character(len=*), intent(in) :: misplaced !! why the case has no use for it; empty: it has
    integer :: i

    call keys%start_group('sample', optional=.true., present_in_file=sample%present, &
                          misplaced=misplaced)
    call keys%integer_key('count', sample%count, 'members: the scene with `seed`, `seed` + 1, '// &
                          '... of `&bump_foil`', from_to(2.0_wp, real(most_members, wp)), &
                          sample%present)
    call keys%real_list_key('quantiles', sample%quantiles, 99, '1', 'quantiles of the results, '// &
                            'in whole hundredths', between(0.0_wp, 1.0_wp), .false., &
                            '0.05, 0.25, 0.5, 0.75, 0.95')
    if (size(sample%quantiles) == 0) sample%quantiles = usual
    call keys%names_key('parameters', sample%names, sample%strings, 'keys that each member '// &
                        'has other values of, such as `''thermal%bump_conductance''`', .false., &
                        'none')
    call keys%real_list_key('factors', sample%factors, most_tolerances, '1', &
                            'a member''s value lies between that of the file over this factor '// &
                            'and times it, even in its logarithm; one a parameter', &
                            at_least(1.0_wp), .false., 'none')
    call keys%rule('sample', 'factors', size(sample%factors) > 0 .and. sample%names == '', &
                   'needs parameters')
    allocate (sample%parameter(0))
    do i = 1, size(sample%quantiles)
      associate (hundredths => 100.0_wp*sample%quantiles(i))
        if (abs(hundredths - percent_of(sample%quantiles(i))) < rounding) cycle
        call keys%complain('sample', 'quantiles', 'must be whole hundredths, which name the '// &
                           'results, not '//text(sample%quantiles(i), 4))
      end associate
    end do
  end subroutine read_sample_case

  !> A quantile in percent.
  elemental integer function percent_of(quantile) result(percent)
    real(wp), intent(in) :: quantile !! between 0 and 1 [1]
    percent = nint(100.0_wp*quantile)
  end function percent_of

  !> Reads the group.
  subroutine read_sensitivity_case(keys, sensitivity, analysis)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(sensitivity_case_type), intent(out) :: sensitivity !! what `&sensitivity` asks for
    type(analysis_row_type), intent(in) :: analysis !! of the case file

    call keys%start_group('sensitivity', optional=.true., present_in_file=sensitivity%present, &
                          misplaced=analysis%refusal('sensitivity'))
    call keys%words_key('quantity', sensitivity%quantity, quantity_words, &
                        'results whose derivatives are found')
    call keys%rule('sensitivity', 'quantity', sensitivity%present .and. &
                   .not. any(sensitivity%quantity) .and. (keys%last_key_is_right() .or. &
                   .not. keys%holds('sensitivity', 'quantity')), 'must name a result')
    call keys%names_key('parameters', sensitivity%names, sensitivity%strings, &
                        'keys by which they are derived, such as `''bump_foil%thickness''`; '// &
                        'of a list a value, `''bump_foil%crest_gap(2)''`, or all, `(:)`; '// &
                        '`''operation%load''` is its magnitude', .true.)
    call keys%real_list_key('tolerances', sensitivity%tolerances, most_tolerances, &
                            'those of parameters', 'standard deviation of each of them: the '// &
                            'variance that they cause is a result', not_negative, .false., 'none')
  end subroutine read_sensitivity_case

  !> Which of the results are of something.
  pure function quantities_of(what) result(are)
    integer, intent(in) :: what !! such as `of_heat`
    logical :: are(size(derived_row))
    are = derived_row%of == what
  end function quantities_of

  !> Whether derivatives of results of something are asked for.
  pure logical function asks(self, what)
    class(sensitivity_case_type), intent(in) :: self !! what is asked for
    integer, intent(in) :: what !! such as `of_heat`
    asks = any(self%quantity .and. quantities_of(what))
  end function asks

  !> Whether derivatives of the foils' stresses are asked for.
  pure logical function derives_stress(sensitivity) result(derives)
    type(sensitivity_case_type), intent(in) :: sensitivity !! what is asked for
    derives = sensitivity%asks(of_top_foil) .or. sensitivity%asks(of_bump_foil)
  end function derives_stress

  !> Whether derivatives of what small vibrations tell are asked for.
  pure logical function derives_vibrations(sensitivity) result(derives)
    type(sensitivity_case_type), intent(in) :: sensitivity !! what is asked for
    derives = sensitivity%asks(of_whirl) .or. sensitivity%asks(of_coefficients)
  end function derives_vibrations

  !> Reads the group. Where no limit is looked for, its film is what the answer is measured against.
  subroutine read_capacity_case(keys, capacity, analysis)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(capacity_case_type), intent(out) :: capacity !! what `&capacity` asks for
    type(analysis_row_type), intent(in) :: analysis !! of the case file
    logical :: by_gap, lifts
    integer :: by

    lifts = analysis%limit == limit_speed
    by_gap = analysis%limit > 0 .and. .not. lifts
    call keys%start_group('capacity', required=by_gap, optional=.not. by_gap, &
                          misplaced=analysis%refusal('capacity'), acts_on=acts_on_all)
    by = 1
    call keys%choice_key('lift_off_by', by, lift_words, 'what lifts the shaft off: the speed '// &
                         'at which asperities carry no more than contact_part, or, at the '// &
                         'speed that is given, 0 too, the supply pressure of &feed at which '// &
                         'the film is smallest_gap')
    call keys%rule('capacity', 'lift_off_by', keys%meant('capacity', 'lift_off_by') .and. &
                   .not. lifts, "needs analysis = 'lift_off'")
    capacity%limit = analysis%limit
    if (lifts .and. by == 2) capacity%limit = limit_supply
    by_gap = capacity%limit > 0 .and. capacity%limit /= limit_speed
    call keys%idle(unless(by_gap, 'the answer is measured against it, and does not follow it'))
    call keys%real_key('smallest_gap', capacity%smallest_gap, 'm', 'smallest film that is '// &
                       'wanted: at it load, tilt or supply has reached its limit; of another '// &
                       'analysis `film_margin` and the verdict say how far the film keeps it', &
                       positive, required=by_gap, &
                       default="required for 'load_capacity', 'misalignment_allowance' and "// &
                               "lift_off_by = 'supply_pressure'")
    call keys%real_key('highest_temperature', capacity%highest_temperature, 'K', 'that film '// &
                       'and top foil may have: a load capacity or a misalignment allowance '// &
                       'ends at it, too; of another analysis `temperature_margin` and the '// &
                       'verdict say how far the hottest place of both keeps it', positive, &
                       default=no_default)
    call keys%idle('the answer is measured against it, and does not follow it')
    call keys%real_key('largest_stress', capacity%largest_stress, 'Pa', 'that the foils may '// &
                       'have: `stress_margin` and the verdict say how far the largest von '// &
                       'Mises stress keeps it', positive, default=no_default)
    call keys%idle(unless(capacity%limit > 0, 'no limit is looked for'))
    call keys%real_key('contact_part', capacity%contact_part, '1', &
                       'part of the load that asperities carry at the lift-off speed', &
                       between(0.0_wp, 1.0_wp))
    call keys%choice_key('tilt_axis', capacity%tilt_axis, axis_words, &
                         'axis about which the sleeve tilts for the misalignment allowance')
    if (capacity%limit == limit_speed) then
      call keys%rule('capacity', 'smallest_gap', keys%meant('capacity', 'smallest_gap'), &
                     "has no use with analysis = 'lift_off': that has its limit in contact_part")
    else if (lifts) then
      call keys%rule('capacity', 'contact_part', keys%meant('capacity', 'contact_part'), &
                     "has no use with lift_off_by = 'supply_pressure': that has its limit in "// &
                     'smallest_gap')
    else if (keys%meant('capacity', 'contact_part')) then
      call keys%complain('capacity', 'contact_part', "needs analysis = 'lift_off'")
    end if
    call keys%rule('capacity', 'tilt_axis', keys%meant('capacity', 'tilt_axis') .and. &
                   capacity%limit /= limit_tilt, "needs analysis = 'misalignment_allowance'")
  end subroutine read_capacity_case
end module gfb_study_cases
