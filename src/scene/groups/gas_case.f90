!> `&gas`: the gas in the film.
module gfb_gas_case
  use gfb_kinds, only: wp
  use gfb_case_keys, only: case_keys_type, longest_list, any_value, not_negative, positive, &
                           rule_type, unless
  use gfb_gas_law, only: gas_law_type, gas_state, gas_state_type, sutherland_viscosity, &
                         density_peng_robinson, density_table, monotone_table, table_at, &
                         peng_robinson, saturate, amount_at, gas_constant, &
                         viscosity_constant, viscosity_sutherland, viscosity_power
  use gfb_analysis_row, only: analysis_row_type
  use gfb_text, only: text
  use gfb_key_effect, only: acts_on_film
  implicit none (type, external)
  private
  public :: gas_case_type, read_gas_case, follow_ambient

  character(len=*), parameter :: group = 'gas'
  integer, parameter :: second_word = 2 !! of state and turbulence: not the simplest
  real(wp), parameter :: air = 0.0289647_wp !! [kg/mol]

  real(wp), parameter, public :: usual_temperature = 293.15_wp !! where heat is on [K]

  character(len=*), parameter :: viscosity_words(*) = [character(len=10) :: 'constant', &
                                                       'sutherland', 'power']
  character(len=*), parameter :: state_words(*) = [character(len=13) :: 'ideal', 'peng_robinson']
  character(len=*), parameter :: turbulence_words(*) = [character(len=6) :: 'none', 'ng_pan']
  real(wp), parameter :: same = 0.01_wp !! a viscosity beside a law differs by less, relative [1]

  !> The gas. Without `&thermal` its temperature is even and constant.
  type :: gas_case_type
    real(wp) :: viscosity = 0.0_wp         !! dynamic, at ambient pressure [Pa s]
    real(wp) :: ambient_pressure = 0.0_wp  !! absolute [Pa]
    logical :: has_viscosity_law = .false. !! or a table: `viscosity` is not needed
    integer :: viscosity_law = viscosity_constant
    real(wp) :: viscosity_temperature_exponent = 0.0_wp !! of `viscosity_power` [1]
    real(wp) :: temperature = 0.0_wp       !! 0: not given [K]
    real(wp) :: molar_mass = 0.0_wp        !! 0: nothing needs it [kg/mol]
    type(gas_law_type) :: law              !! how density, viscosity and flow depend on the pressure
  end type gas_case_type

  !> What else the group says.
  type :: gas_keys_type
    logical :: heated = .false. !! the file has `&thermal`
    logical :: fed = .false.    !! the file has `&feed`
    integer :: state = 1, turbulence = 1 !! words
    real(wp) :: critical_temperature = 0.0_wp !! [K]
    real(wp) :: critical_pressure = 0.0_wp    !! [Pa]
    real(wp) :: acentric_factor = 0.0_wp      !! [1]
    logical :: table = .false.     !! densities are given
    logical :: viscosities = .false. !! and viscosities
    real(wp), allocatable :: pressure(:), density(:), viscosity(:) !! [Pa], [kg/m3], [Pa s]
  end type gas_keys_type

contains

  !> Reads the group.
  subroutine read_gas_case(keys, gas, analysis)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(gas_case_type), intent(out) :: gas !! what `&gas` asks for
    type(analysis_row_type), intent(in) :: analysis !! of the case file
    type(gas_keys_type) :: said
    logical :: needed, by_law, given
    integer :: mistakes !! before the group

    mistakes = keys%mistakes()
    needed = analysis%takes(group)
    call keys%start_group(group, required=needed, optional=.not. needed, &
                          misplaced=analysis%refusal(group), acts_on=acts_on_film)
    said%heated = needed .and. keys%line_of_group('thermal') > 0
    said%fed = needed .and. keys%line_of_group('feed') > 0
    said%table = keys%holds(group, 'density_table_pressure')
    said%viscosities = keys%holds(group, 'density_table_viscosity')
    by_law = said%viscosities .or. keys%holds(group, 'viscosity_law')
    call keys%real_key('viscosity', gas%viscosity, 'Pa s', 'dynamic viscosity, at '// &
                       '`ambient_pressure` where it depends on it', positive, &
                       needed .and. .not. by_law, &
                       default='required without a law or a table of it', given=given)
    call keys%real_key('ambient_pressure', gas%ambient_pressure, 'Pa', &
                       'absolute pressure at the edges of the pad', positive, needed)
    call keys%choice_key('viscosity_law', gas%viscosity_law, viscosity_words, &
                         'viscosity as given, or that of air at its temperature; with '// &
                         '`&thermal` also a power of the temperature')
    call keys%rule(group, 'viscosity_law', by_law .and. needed .and. .not. given .and. &
                   .not. said%viscosities .and. any(gas%viscosity_law == &
                   [viscosity_constant, viscosity_power]), 'needs the key viscosity, or '// &
                   'another word')
    call keys%rule(group, 'viscosity_law', gas%viscosity_law == viscosity_power .and. &
                   .not. said%heated, 'needs &thermal: without it the temperature is even')
    by_law = said%viscosities .or. gas%viscosity_law == viscosity_sutherland
    gas%has_viscosity_law = by_law
    call keys%idle(unless(.not. by_law, 'a law or a table gives the viscosity'), 'viscosity')
    call keys%real_key('mean_free_path', gas%law%mean_free_path, 'm', 'mean free path of the '// &
                       'molecules at `ambient_pressure`, for slip at the surfaces; 0: no slip', &
                       not_negative)
    call read_state(keys, said, gas, needed)
    call read_table(keys, said, needed)
    if (.not. needed .or. keys%mistakes() > mistakes) return
    if (.not. is_complete(said, gas)) return
    call keys%rule(group, 'equation_of_state', said%table .and. said%state == second_word, &
                   'has no use with a table: density_table_density gives the density')
    call keys%rule(group, 'viscosity_law', said%viscosities .and. &
                   gas%viscosity_law > viscosity_constant, 'has no use with '// &
                   'density_table_viscosity, which gives the viscosity')
    if (said%table) call keys%rule(group, 'ambient_pressure', &
                                   gas%ambient_pressure < minval(said%pressure) .or. &
                                   gas%ambient_pressure > maxval(said%pressure), 'must lie in '// &
                                   'the table of the gas, '//text(minval(said%pressure))// &
                                   ' to '//text(maxval(said%pressure))//' Pa')
    if (keys%mistakes() > mistakes) return
    call make_law(said, gas)
    call keys%rule(group, 'ambient_pressure', gas%ambient_pressure >= gas%law%fluid%saturation, &
                   'must be below '//text(gas%law%fluid%saturation, 4)//' Pa, at which the gas '// &
                   'condenses at its temperature')
    if (.not. (said%heated .and. gas%viscosity_law == viscosity_sutherland)) then
      call take_viscosity(keys, gas)
    end if
  end subroutine read_gas_case

  !> The viscosity becomes that of the law or table, which one that is given must not contradict.
  subroutine take_viscosity(keys, gas)
    type(case_keys_type), intent(inout) :: keys
    type(gas_case_type), intent(inout) :: gas

    call keys%rule(group, 'viscosity', gas%has_viscosity_law .and. gas%viscosity > 0.0_wp .and. &
                   abs(gas%viscosity - gas%law%viscosity) > same*gas%law%viscosity, 'is not '// &
                   'needed: the law or table gives '//text(gas%law%viscosity, 4)//' Pa s at '// &
                   'ambient_pressure; leave it out')
    gas%viscosity = gas%law%viscosity
  end subroutine take_viscosity

  !> With heat, a law that gives the viscosity gives it at ambient temperature.
  subroutine follow_ambient(keys, gas, temperature)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(gas_case_type), intent(inout) :: gas !! what `&gas` asks for; gets its viscosity
    real(wp), intent(in) :: temperature !! ambient [K]

    if (gas%viscosity_law /= viscosity_sutherland) return
    gas%law%viscosity = sutherland_viscosity(temperature)
    call take_viscosity(keys, gas)
  end subroutine follow_ambient

  !> Density by an equation of state, and what turbulence needs.
  subroutine read_state(keys, said, gas, needed)
    type(case_keys_type), intent(inout) :: keys
    type(gas_keys_type), intent(inout) :: said
    type(gas_case_type), intent(inout) :: gas
    logical, intent(in) :: needed
    character(len=*), parameter :: no_heat = ' with &thermal, in this version'
    logical :: real_gas, turbulent, ideal_turbulence, even
    logical :: real_needed !! the keys of a real gas are: with heat it is refused anyway

    call keys%choice_key('equation_of_state', said%state, state_words, &
                         'density of an ideal gas, or by Peng and Robinson')
    call keys%choice_key('turbulence', said%turbulence, turbulence_words, &
                         'laminar film, or the factors of Ng and Pan')
    real_gas = said%state == second_word
    turbulent = said%turbulence == second_word
    real_needed = real_gas .and. .not. said%heated
    ideal_turbulence = turbulent .and. .not. (real_gas .or. said%table)
    call keys%rule(group, 'equation_of_state', said%heated .and. real_gas, &
                   "must be 'ideal'"//no_heat)
    call keys%rule(group, 'turbulence', said%heated .and. turbulent, "must be 'none'"//no_heat)
    even = gas%viscosity_law == viscosity_sutherland .and. .not. said%heated
    call key('temperature', gas%temperature, 'K', 'temperature of the gas, even and constant '// &
             'without `&thermal`', positive, real_needed .or. even .or. ideal_turbulence .and. &
             .not. said%heated, &
             real_gas .or. said%table .or. turbulent .or. even .or. said%heated .or. said%fed, &
             "viscosity_law = 'sutherland', equation_of_state = 'peng_robinson', a table, "// &
             'turbulence of an ideal gas, &thermal or &feed')
    if (said%heated .or. said%fed .and. .not. real_gas) gas%molar_mass = air
    call key('molar_mass', gas%molar_mass, 'kg/mol', "mass of a mole of the gas, air's "// &
             '0.0289647 by default with `&thermal` or, of an ideal gas or a table, `&feed`', &
             positive, turbulent .and. .not. (said%table .or. said%heated .or. said%fed) .or. &
             real_needed .and. said%fed, &
             real_gas .or. ideal_turbulence .or. said%heated .or. said%fed, &
             "equation_of_state = 'peng_robinson', turbulence of an ideal gas, &thermal or &feed")
    call key('viscosity_temperature_exponent', gas%viscosity_temperature_exponent, '1', &
             'viscosity is `viscosity` times this power of the temperature over that of the '// &
             'ambient gas', any_value, gas%viscosity_law == viscosity_power, &
             gas%viscosity_law == viscosity_power, "viscosity_law = 'power'")
    call key('critical_temperature', said%critical_temperature, 'K', 'of the gas', positive, &
             real_needed, real_gas, "equation_of_state = 'peng_robinson'")
    call key('critical_pressure', said%critical_pressure, 'Pa', 'of the gas', positive, &
             real_needed, real_gas, "equation_of_state = 'peng_robinson'")
    call key('acentric_factor', said%acentric_factor, '1', 'of the gas', any_value, &
             real_needed, real_gas, "equation_of_state = 'peng_robinson'")
    call key('viscosity_exponent', gas%law%viscosity_exponent, '1', 'viscosity of a real gas '// &
             'is in proportion to this power of its density', any_value, .false., &
             (real_gas .or. said%table) .and. .not. said%viscosities, &
             'a real gas whose viscosity is not in its table')

  contains

    !> A key that some gases need, and others have no use for.
    subroutine key(name, value, unit, meaning, rule, must, may, who)
      character(len=*), intent(in) :: name, unit, meaning
      real(wp), intent(inout) :: value
      type(rule_type), intent(in) :: rule
      logical, intent(in) :: must, may    !! it is required; it has a use
      character(len=*), intent(in) :: who !! has a use for it
      logical :: given

      call keys%real_key(name, value, unit, meaning, rule, must .and. needed, &
                         default='none; it is for '//who, given=given)
      if (given .and. .not. may) call keys%complain(group, name, 'needs '//who)
    end subroutine key
  end subroutine read_state

  !> Density and viscosity by a table over the pressure.
  subroutine read_table(keys, said, needed)
    type(case_keys_type), intent(inout) :: keys
    type(gas_keys_type), intent(inout) :: said
    logical, intent(in) :: needed
    character(len=*), parameter :: alone = 'needs density_table_pressure'

    call keys%real_list_key('density_table_pressure', said%pressure, longest_list, 'Pa', &
                            'pressures of a table of the gas at its temperature, rising', &
                            positive, .false., 'no table')
    if (keys%last_key_is_right()) call check_rising('density_table_pressure', said%pressure)
    call keys%real_list_key('density_table_density', said%density, longest_list, 'kg/m^3', &
                            'densities there, rising', positive, said%table .and. needed, &
                            'required with density_table_pressure')
    if (keys%last_key_is_right()) then
      call check_size('density_table_density', said%density)
      call check_rising('density_table_density', said%density)
    end if
    call keys%real_list_key('density_table_viscosity', said%viscosity, longest_list, 'Pa s', &
                            'viscosities there', positive, .false., '`viscosity`')
    if (keys%last_key_is_right()) call check_size('density_table_viscosity', said%viscosity)

  contains

    !> As many values as pressures.
    subroutine check_size(name, values)
      character(len=*), intent(in) :: name
      real(wp), intent(in) :: values(:)

      if (.not. said%table) then
        call keys%complain(group, name, alone)
      else if (size(values) /= size(said%pressure)) then
        call keys%complain(group, name, 'must have one value a pressure: '// &
                           text(size(said%pressure))//', not '//text(size(values)))
      end if
    end subroutine check_size

    !> Each value is greater than the one before.
    subroutine check_rising(name, values)
      character(len=*), intent(in) :: name
      real(wp), intent(in) :: values(:)
      integer :: i

      if (size(values) < 2) call keys%complain(group, name, 'needs two values at least')
      do i = 2, size(values)
        if (values(i) > values(i - 1)) cycle
        call keys%complain(group, name, 'must be greater than the value before it', i)
        return
      end do
    end subroutine check_rising
  end subroutine read_table

  !> Whether no key is missing, which is reported later.
  pure logical function is_complete(said, gas) result(complete)
    type(gas_keys_type), intent(in) :: said
    type(gas_case_type), intent(in) :: gas
    logical :: real_gas

    real_gas = said%state == second_word
    complete = gas%ambient_pressure > 0.0_wp
    complete = complete .and. (gas%viscosity > 0.0_wp .or. gas%has_viscosity_law)
    if (real_gas .or. (gas%viscosity_law == viscosity_sutherland .and. .not. said%heated)) then
      complete = complete .and. gas%temperature > 0.0_wp
    end if
    if (real_gas) complete = complete .and. said%critical_temperature > 0.0_wp .and. &
                             said%critical_pressure > 0.0_wp
    if (said%table) complete = complete .and. size(said%density) == size(said%pressure)
    if (said%turbulence == second_word .and. .not. said%table) then
      complete = complete .and. gas%molar_mass > 0.0_wp .and. gas%temperature > 0.0_wp
    end if
  end function is_complete

  !> The gas that the keys describe.
  subroutine make_law(said, gas)
    type(gas_keys_type), intent(in) :: said
    type(gas_case_type), intent(inout) :: gas
    type(gas_state_type) :: ambient
    real(wp) :: density, slope, curvature !! at ambient pressure [kg/m3] or [mol/m3]

    associate (law => gas%law)
      law%ambient_pressure = gas%ambient_pressure
      law%viscosity = gas%viscosity
      if (gas%viscosity_law == viscosity_sutherland) law%viscosity = &
        sutherland_viscosity(merge(gas%temperature, usual_temperature, gas%temperature > 0.0_wp))
      law%turbulent = said%turbulence == second_word
      law%ambient_density = 0.0_wp
      if (said%table) then
        law%density = density_table
        law%density_curve = monotone_table(said%pressure, said%density)
        call table_at(law%density_curve, gas%ambient_pressure, density, slope, curvature)
        law%unit = gas%ambient_pressure/density
        law%ambient_density = density
        law%has_viscosity_curve = said%viscosities
        if (said%viscosities) law%viscosity_curve = monotone_table(said%pressure, said%viscosity)
      else if (said%state == second_word) then
        law%density = density_peng_robinson
        law%fluid = peng_robinson(gas%temperature, said%critical_temperature, &
                                  said%critical_pressure, said%acentric_factor)
        if (gas%temperature < said%critical_temperature) call saturate(law%fluid)
        call amount_at(law%fluid, gas%ambient_pressure, density, slope, curvature)
        law%unit = gas%ambient_pressure/density
        law%ambient_density = density*gas%molar_mass
      else if (law%turbulent) then
        law%ambient_density = gas%ambient_pressure*gas%molar_mass/(gas_constant*gas%temperature)
      end if
      law%plain = .not. (law%mean_free_path > 0.0_wp .or. law%turbulent .or. said%table .or. &
                         said%state == second_word)
      ambient = gas_state(law, gas%ambient_pressure)
      law%viscosity = ambient%mu
    end associate
  end subroutine make_law

end module gfb_gas_case
