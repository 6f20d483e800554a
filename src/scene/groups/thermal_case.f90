!> `&thermal`: the heat of the film, and where it goes.
module gfb_thermal_case
  use gfb_kinds, only: wp
  use gfb_bearing_row, only: bearing_row_type
  use gfb_case_keys, only: case_keys_type, longest_list, any_value, between, from_to, no_default, &
                           not_negative, positive, unless
  use gfb_foil_cases, only: bump_foil_case_type
  use gfb_gas_case, only: gas_case_type, usual_temperature, follow_ambient
  use gfb_heated_film, only: wall_given, wall_conductance, wall_fin
  use gfb_modulus_law, only: modulus_law_type, slope_law, least_ratio, is_usual_modulus, &
                             usual_words
  use gfb_analysis_row, only: analysis_row_type
  use gfb_text, only: text
  use gfb_key_effect, only: acts_on_film
  implicit none (type, external)
  private
  public :: thermal_case_type, read_thermal_case, estimated_bump_conductance
  public :: wall_given, wall_conductance, wall_fin

  integer, parameter, public :: foil_given = 1 !! held at a temperature
  integer, parameter, public :: foil_sheet = 2 !! conducts in its plane

  character(len=*), parameter :: ambient = '`ambient_temperature`' !! a default
  character(len=*), parameter :: wall_words(*) = [character(len=11) :: 'given', 'conductance', &
                                                  'fin']
  character(len=*), parameter :: foil_words(*) = [character(len=5) :: 'given', 'sheet']

  real(wp), parameter :: coldest = 150.0_wp, hottest = 2000.0_wp !! that a key may say [K]
  real(wp), parameter :: usual_contact = 0.1_wp !! of crests and feet, a guess [1]
  real(wp), parameter :: channel_nusselt = 3.5_wp !! flow between bumps, of their height [1]

  !> Heat. A key that is not given has its default; one without a use is zero.
  type :: thermal_case_type
    logical :: present = .false.                    !! the group stands in the file: heat is on
    real(wp) :: ambient_temperature = usual_temperature !! of the gas drawn in [K]
    real(wp) :: specific_heat = 1005.0_wp           !! of the gas, at constant pressure [J/(kg K)]
    real(wp) :: prandtl = 0.71_wp                   !! of the gas [1]
    real(wp) :: carry_over = 0.8_wp                 !! of the outflow into the next pad [1]
    integer :: shaft = wall_conductance
    real(wp) :: shaft_temperature = 0.0_wp          !! of `wall_given` [K]
    real(wp) :: shaft_conductance = 0.0_wp          !! of `wall_conductance`; 0: insulated [W/K]
    real(wp) :: shaft_far_temperature = 0.0_wp      !! the same [K]
    real(wp) :: shaft_conductivity = 15.0_wp        !! of `wall_fin` [W/(m K)]
    real(wp) :: shaft_inner_radius = 0.0_wp         !! of a hollow shaft [m]
    real(wp) :: shaft_end_conductance(2) = 0.0_wp   !! of `wall_fin`, at -L/2, +L/2 [W/K]
    real(wp) :: shaft_end_temperature(2) = 0.0_wp   !! the same [K]
    real(wp) :: foil_conductivity = 12.0_wp         !! of top foil and bumps [W/(m K)]
    integer :: top_foil = foil_sheet
    real(wp) :: top_foil_temperature = 0.0_wp       !! of `foil_given` [K]
    real(wp) :: bump_conductance = 0.0_wp           !! top foil to sleeve [W/(m^2 K)]
    logical :: bump_conductance_estimated = .false. !! not given
    real(wp) :: cooling_flow = 0.0_wp               !! along the bumps, to +z; 0: none [kg/s]
    real(wp) :: cooling_temperature = 0.0_wp        !! where it enters, at -L/2 [K]
    real(wp) :: channel_conductance = 0.0_wp        !! top foil to cooling flow [W/(m^2 K)]
    real(wp) :: channel_sleeve_conductance = 0.0_wp !! cooling flow to sleeve [W/(m^2 K)]
    integer :: sleeve = wall_conductance
    real(wp) :: sleeve_temperature = 0.0_wp         !! of `wall_given` [K]
    real(wp) :: sleeve_conductance = 0.0_wp         !! of `wall_conductance`; 0: insulated [W/K]
    real(wp) :: sleeve_far_temperature = 0.0_wp     !! the same [K]
    real(wp) :: shaft_expansion = 0.0_wp            !! coefficient of thermal growth [1/K]
    real(wp) :: sleeve_expansion = 0.0_wp           !! the same [1/K]
    real(wp) :: reference_temperature = 0.0_wp      !! at which `clearance` is that of rest [K]
    logical :: centrifugal = .false.                !! the shaft grows with its speed, by these:
    real(wp) :: shaft_density = 0.0_wp              !! [kg/m^3]
    real(wp) :: shaft_youngs_modulus = 0.0_wp       !! [Pa]
    real(wp) :: shaft_poissons_ratio = 0.0_wp       !! [1]
    type(modulus_law_type) :: modulus               !! of the foils over their temperature
  contains
    procedure, non_overridable :: is_cooled, mirrors, has_way_out, growth
  end type thermal_case_type

contains

  !> Reads the group; the gas gets the viscosity that its law has at ambient temperature.
  subroutine read_thermal_case(keys, thermal, gas, foil, bearing, analysis)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(thermal_case_type), intent(out) :: thermal !! what `&thermal` asks for
    type(gas_case_type), intent(inout) :: gas !! what `&gas` asks for
    type(bump_foil_case_type), intent(in) :: foil !! what `&bump_foil` asks for
    type(bearing_row_type), intent(in) :: bearing !! the kind of bearing
    type(analysis_row_type), intent(in) :: analysis !! of the case file
    character(len=:), allocatable :: journal !! why keys of one have no use
    logical :: given(3)

    journal = trim(bearing%journal_keys)
    call keys%start_group('thermal', optional=.true., present_in_file=thermal%present, &
                          misplaced=analysis%refusal('thermal'), acts_on=acts_on_film)
    call keys%idle(unless(thermal%present, 'the file has no group &thermal'))
    if (gas%temperature > 0.0_wp) thermal%ambient_temperature = gas%temperature
    call keys%real_key('ambient_temperature', thermal%ambient_temperature, 'K', 'temperature '// &
                       'of the gas that is drawn in', from_to(coldest, hottest), &
                       default='`temperature` of `&gas`, else 293.15')
    if (thermal%present) call follow_ambient(keys, gas, thermal%ambient_temperature)
    call keys%real_key('specific_heat', thermal%specific_heat, 'J/(kg K)', &
                       'of the gas at constant pressure', positive)
    call keys%real_key('prandtl', thermal%prandtl, '1', 'Prandtl number of the gas', positive)
    call keys%real_key('carry_over', thermal%carry_over, '1', 'part of the outflow of a '// &
                       'trailing edge that enters the next leading edge', from_to(0.0_wp, 1.0_wp))
    call keys%choice_key('shaft', thermal%shaft, wall_words, 'shaft of one temperature, given '// &
                         'or such that its heat goes to a far place; or a fin along its axis; '// &
                         'of thrust bearings the runner')
    call keys%rule('thermal', 'shaft', bearing%has_sectors .and. thermal%shaft == wall_fin, &
                   "must be 'given' or 'conductance' with kind = 'thrust' in &bearing")
    call read_place(keys, 'shaft', thermal%shaft, thermal%ambient_temperature, &
                    thermal%shaft_temperature, thermal%shaft_conductance, &
                    thermal%shaft_far_temperature)
    call read_fin(keys, thermal, journal)
    call read_foil(keys, thermal, foil, gas%viscosity*thermal%specific_heat/thermal%prandtl)
    call keys%choice_key('sleeve', thermal%sleeve, wall_words(:wall_conductance), 'sleeve of '// &
                         'one temperature, given or such that its heat goes to a far place')
    call read_place(keys, 'sleeve', thermal%sleeve, thermal%ambient_temperature, &
                    thermal%sleeve_temperature, thermal%sleeve_conductance, &
                    thermal%sleeve_far_temperature)
    call keys%real_key('shaft_expansion', thermal%shaft_expansion, '1/K', &
                       'thermal expansion of the shaft', not_negative, useless=journal)
    call keys%real_key('sleeve_expansion', thermal%sleeve_expansion, '1/K', &
                       'thermal expansion of the sleeve', not_negative, useless=journal)
    thermal%reference_temperature = thermal%ambient_temperature
    call keys%real_key('reference_temperature', thermal%reference_temperature, 'K', 'at which '// &
                       '`clearance` is that of rest', from_to(coldest, hottest), default=ambient)
    call keys%real_key('shaft_density', thermal%shaft_density, 'kg/m^3', 'density of a shaft '// &
                       'that grows with its speed', positive, default=no_default, given=given(1), &
                       useless=journal)
    call keys%real_key('shaft_youngs_modulus', thermal%shaft_youngs_modulus, 'Pa', "Young's "// &
                       'modulus of that shaft', positive, default=no_default, given=given(2), &
                       useless=journal)
    call keys%real_key('shaft_poissons_ratio', thermal%shaft_poissons_ratio, '1', "Poisson's "// &
                       'ratio of that shaft', between(-1.0_wp, 0.5_wp), default=no_default, &
                       given=given(3), useless=journal)
    thermal%centrifugal = all(given)
    if (thermal%present) call follow_bumps(keys, thermal)
    call read_modulus(keys, thermal)
  end subroutine read_thermal_case

  !> Defaults follow sizes of the bumps, whatever foil there is.
  subroutine follow_bumps(keys, thermal)
    type(case_keys_type), intent(inout) :: keys
    type(thermal_case_type), intent(in) :: thermal
    character(len=*), parameter :: bumps = 'bump_foil'
    logical :: channel

    channel = thermal%is_cooled() .and. .not. (keys%meant('thermal', 'channel_conductance') .and. &
                                               keys%meant('thermal', 'channel_sleeve_conductance'))
    if (channel .or. thermal%bump_conductance_estimated) call keys%idle('', 'height', bumps)
    if (.not. thermal%bump_conductance_estimated) return
    call keys%idle('', 'thickness', bumps)
    call keys%idle('', 'half_length', bumps)
    call keys%idle('', 'pitch', bumps)
  end subroutine follow_bumps

  !> Young's modulus of the foils over their temperature: a table, or a slope.
  subroutine read_modulus(keys, thermal)
    type(case_keys_type), intent(inout) :: keys
    type(thermal_case_type), intent(inout) :: thermal
    character(len=*), parameter :: group = 'thermal', places = 'modulus_temperatures', &
                                   ratios = 'modulus_ratios', line = 'modulus_slope'
    real(wp), allocatable :: temperature(:), ratio(:)
    real(wp) :: slope
    logical :: table, given
    integer :: i

    table = keys%holds(group, places)
    call keys%real_list_key(places, temperature, longest_list, 'K', 'temperatures of a table '// &
                            "of the foils' modulus, rising", from_to(coldest, hottest), &
                            .false., 'no table')
    if (keys%last_key_is_right()) then
      if (size(temperature) < 2) call keys%complain(group, places, 'needs two values at least')
      do i = 2, size(temperature)
        if (temperature(i) > temperature(i - 1)) cycle
        call keys%complain(group, places, 'must be greater than the value before it', i)
        table = .false.
        exit
      end do
    end if
    call keys%real_list_key(ratios, ratio, longest_list, '1', "Young's modulus of top foil and "// &
                            'bumps there, over `youngs_modulus`; straight between, as at the '// &
                            'ends beyond', positive, keys%holds(group, places), &
                            'required with modulus_temperatures')
    if (keys%last_key_is_right()) then
      if (.not. keys%holds(group, places)) then
        call keys%complain(group, ratios, 'needs modulus_temperatures')
      else if (size(ratio) /= size(temperature)) then
        call keys%complain(group, ratios, 'must have one value a temperature: '// &
                           text(size(temperature))//', not '//text(size(ratio)))
      end if
    end if
    slope = 0.0_wp
    call keys%real_key(line, slope, '1/K', 'of that ratio, which is 1 at '// &
                       '`reference_temperature`, instead of a table; it ends at 0.1', &
                       any_value, default=no_default, given=given)
    if (given .and. keys%holds(group, places)) then
      call keys%complain(group, line, 'must not be given beside modulus_temperatures')
    else if (given) then
      call check_slope('ambient_temperature', thermal%ambient_temperature)
      call check_slope('top_foil_temperature', thermal%top_foil_temperature)
      call check_slope('sleeve_temperature', thermal%sleeve_temperature)
      thermal%modulus = slope_law(slope, thermal%reference_temperature, coldest, hottest)
    else if (table .and. size(temperature) > 1 .and. size(ratio) == size(temperature)) then
      thermal%modulus = modulus_law_type(temperature, ratio)
    end if

  contains

    !> The line leaves something of the modulus at a temperature that is given.
    subroutine check_slope(name, temperature)
      character(len=*), intent(in) :: name
      real(wp), intent(in) :: temperature !! 0: not given [K]
      real(wp) :: left

      if (.not. temperature > 0.0_wp) return
      left = 1.0_wp + slope*(temperature - thermal%reference_temperature)
      call keys%rule(group, line, left <= least_ratio, 'leaves '//text(left, 3)// &
                     ' of the modulus at '//name//', which must be more than 0.1')
      if (left <= least_ratio .or. is_usual_modulus(left)) return
      call keys%warn(group, line, 'makes '//text(left, 3)//' of the modulus at '//name// &
                     '; usual is '//usual_words)
    end subroutine check_slope
  end subroutine read_modulus

  !> Shaft or sleeve of one temperature.
  subroutine read_place(keys, name, wall, near, given, conductance, far)
    type(case_keys_type), intent(inout) :: keys
    character(len=*), intent(in) :: name !! of the wall, before those of its keys
    integer, intent(in) :: wall !! `wall_given`, ...; 0 where it is not known
    real(wp), intent(in) :: near !! ambient temperature [K]
    real(wp), intent(inout) :: given, conductance, far !! temperatures [K], to the far one [W/K]

    call keys%real_key(name//'_temperature', given, 'K', 'at which the '//name//' is held', &
                       from_to(coldest, hottest), wall == wall_given, &
                       'required with `'//name//" = 'given'`")
    call keys%real_key(name//'_conductance', conductance, 'W/K', 'from '//name//' to a far '// &
                       'place; 0: insulated', not_negative, wall == wall_conductance, &
                       'required with `'//name//" = 'conductance'`")
    if (wall == wall_conductance) far = near
    call keys%real_key(name//'_far_temperature', far, 'K', 'temperature of the far place of '// &
                       'the '//name, from_to(coldest, hottest), default=ambient)
  end subroutine read_place

  !> A shaft that is a fin.
  subroutine read_fin(keys, thermal, useless)
    type(case_keys_type), intent(inout) :: keys
    type(thermal_case_type), intent(inout) :: thermal
    character(len=*), intent(in) :: useless !! why its keys have no use

    call keys%real_key('shaft_conductivity', thermal%shaft_conductivity, 'W/(m K)', &
                       'conductivity of a shaft that is a fin', positive, useless=useless)
    call keys%real_key('shaft_inner_radius', thermal%shaft_inner_radius, 'm', 'of a hollow '// &
                       'shaft: of a fin, or one that grows with its speed', not_negative, &
                       useless=useless)
    call keys%real_vector_key('shaft_end_conductance', thermal%shaft_end_conductance, 'W/K', &
                              'from the ends of a fin, at -L/2 and +L/2, to far places; 0: '// &
                              'insulated', not_negative, thermal%shaft == wall_fin, &
                              "required with `shaft = 'fin'`", useless=useless)
    if (thermal%shaft == wall_fin) thermal%shaft_end_temperature = thermal%ambient_temperature
    call keys%real_vector_key('shaft_end_temperature', thermal%shaft_end_temperature, 'K', &
                              'temperatures of these places', from_to(coldest, hottest), &
                              default=ambient, useless=useless)
  end subroutine read_fin

  !> Top foil, the bumps under it, and what cools them.
  subroutine read_foil(keys, thermal, foil, conductivity)
    type(case_keys_type), intent(inout) :: keys
    type(thermal_case_type), intent(inout) :: thermal
    type(bump_foil_case_type), intent(in) :: foil
    real(wp), intent(in) :: conductivity !! of the gas [W/(m K)]
    logical :: known, cooled !! the bumps are

    call keys%real_key('foil_conductivity', thermal%foil_conductivity, 'W/(m K)', &
                       'conductivity of top foil and bumps', positive)
    call keys%choice_key('top_foil', thermal%top_foil, foil_words, 'top foil held at a '// &
                         'temperature, or a sheet of the `thickness` in `&top_foil`')
    call keys%real_key('top_foil_temperature', thermal%top_foil_temperature, 'K', 'at which '// &
                       'the top foil is held', from_to(coldest, hottest), &
                       thermal%top_foil == foil_given, "required with `top_foil = 'given'`")
    call read_channel(keys, thermal, foil, conductivity, cooled)
    known = min(foil%thickness%value, foil%half_length%value, foil%height%value, &
                foil%pitch%value) > 0.0_wp
    ! The gas under a cooled foil is that of the channel.
    if (known) thermal%bump_conductance = &
      estimated_bump_conductance(foil, thermal%foil_conductivity, &
                                 merge(0.0_wp, conductivity, cooled), usual_contact)
    call keys%real_key('bump_conductance', thermal%bump_conductance, 'W/(m^2 K)', 'from top '// &
                       'foil to sleeve through bumps and gas, of an area; beside a cooling '// &
                       'flow through the bumps alone', not_negative, &
                       default='estimated from `&bump_foil`, to a factor of 2; else required')
    thermal%bump_conductance_estimated = known .and. (keys%key%is_default .or. &
                                                      .not. keys%key%given)
  end subroutine read_foil

  !> The channel under the foil, through which cooling gas is blown.
  subroutine read_channel(keys, thermal, foil, conductivity, cooled)
    type(case_keys_type), intent(inout) :: keys
    type(thermal_case_type), intent(inout) :: thermal
    type(bump_foil_case_type), intent(in) :: foil
    real(wp), intent(in) :: conductivity !! of the gas [W/(m K)]
    logical, intent(out) :: cooled !! there is a channel
    character(len=*), parameter :: usual = '3.5 conductivity of the gas / `height` in `&bump_foil`'
    real(wp) :: of_height !! what the channel's own size makes of it; 0: not known [W/(m^2 K)]

    of_height = 0.0_wp
    if (foil%height%value > 0.0_wp) of_height = channel_conductance_of(foil%height%value, &
                                                                      conductivity)
    call keys%real_key('cooling_flow', thermal%cooling_flow, 'kg/s', 'of gas that is blown '// &
                       'along the bumps of this bearing, to +z, of thrust bearings '// &
                       'outwards; 0: none', not_negative)
    ! A flow of zero in a sweep over it leaves the channel, where its other keys are given.
    cooled = thermal%cooling_flow > 0.0_wp .or. keys%holds('thermal', 'cooling_temperature')
    if (cooled) thermal%channel_conductance = of_height
    call keys%real_key('channel_conductance', thermal%channel_conductance, 'W/(m^2 K)', &
                       'from top foil to cooling gas, of an area', not_negative, default=usual)
    cooled = cooled .or. thermal%channel_conductance > 0.0_wp
    if (cooled) thermal%cooling_temperature = thermal%ambient_temperature
    call keys%real_key('cooling_temperature', thermal%cooling_temperature, 'K', 'of that gas '// &
                       'where it enters, at -L/2 or inside', from_to(coldest, hottest), &
                       default=ambient)
    if (cooled) thermal%channel_sleeve_conductance = of_height
    call keys%real_key('channel_sleeve_conductance', thermal%channel_sleeve_conductance, &
                       'W/(m^2 K)', 'from cooling gas to sleeve, of an area', not_negative, &
                       default=usual)
  end subroutine read_channel

  !> Conductance from a wall to the flow along the bumps, laminar between plates as far apart as
  !> they are high: 3.5 k/h_b [W/(m^2 K)].
  elemental real(wp) function channel_conductance_of(height, gas) result(conductance)
    real(wp), intent(in) :: height !! of the bumps, h_b [m]
    real(wp), intent(in) :: gas !! conductivity of the gas, k [W/(m K)]
    conductance = channel_nusselt*gas/height
  end function channel_conductance_of

  !> Conductance from top foil to sleeve [W/(m^2 K)].
  !>
  !> In each pitch the two halves of an arc conduct side by side, each through its two contacts;
  !> the gas under the foil does beside them.
  !>
  !> $$ g_b = \frac{2 k_b t_b}{p \, (s + 2 t_b/c)} + \frac{k}{h_b} $$
  pure real(wp) function estimated_bump_conductance(foil, metal, gas, contact) result(conductance)
    type(bump_foil_case_type), intent(in) :: foil !! with thickness, half length, height, pitch
    real(wp), intent(in) :: metal   !! conductivity of the bumps, k_b [W/(m K)]
    real(wp), intent(in) :: gas     !! conductivity of the gas, k [W/(m K)]
    real(wp), intent(in) :: contact !! c: a thickness over the length that a contact adds [1]
    real(wp) :: arc !! s, from foot to crest [m]

    associate (thickness => foil%thickness%value, half => foil%half_length%value, &
               height => foil%height%value)
      arc = (half**2 + height**2)/height*atan(height/half)
      conductance = 2.0_wp*metal*thickness/(foil%pitch%value*(arc + 2.0_wp*thickness/contact)) &
        + gas/height
    end associate
  end function estimated_bump_conductance

  !> Growth of the shaft's radius with its speed; 0 where it does not grow [m].
  !>
  !> $$ u = \frac{\rho \Omega^2 R}{4 E} \left[ (1 - \nu) R^2 + (3 + \nu) R_i^2 \right] $$
  pure real(wp) function growth(self, radius, speed)
    class(thermal_case_type), intent(in) :: self !! what `&thermal` asks for
    real(wp), intent(in) :: radius !! R [m]
    real(wp), intent(in) :: speed  !! Omega [rad/s]

    growth = 0.0_wp
    if (self%centrifugal) growth = self%shaft_density*speed**2*radius/ &
      (4.0_wp*self%shaft_youngs_modulus)*((1.0_wp - self%shaft_poissons_ratio)*radius**2 + &
                                          (3.0_wp + self%shaft_poissons_ratio)* &
                                          self%shaft_inner_radius**2)
  end function growth

  !> Whether there is a channel for cooling gas, which may stand still at a point of a sweep.
  pure logical function is_cooled(self)
    class(thermal_case_type), intent(in) :: self !! what `&thermal` asks for
    is_cooled = max(self%cooling_flow, self%channel_conductance, &
                    self%channel_sleeve_conductance) > 0.0_wp
  end function is_cooled

  !> Whether both halves of the width are alike.
  pure logical function mirrors(self)
    class(thermal_case_type), intent(in) :: self !! what `&thermal` asks for

    mirrors = .not. self%is_cooled()
    if (self%shaft /= wall_fin) return
    mirrors = mirrors .and. .not. &
              (abs(self%shaft_end_conductance(2) - self%shaft_end_conductance(1)) > 0.0_wp .or. &
               abs(self%shaft_end_temperature(2) - self%shaft_end_temperature(1)) > 0.0_wp)
  end function mirrors

  !> Whether heat leaves the bearing otherwise than with the film's own gas.
  pure logical function has_way_out(self) result(has)
    class(thermal_case_type), intent(in) :: self !! what `&thermal` asks for
    logical :: by_foil !! from the foil on

    by_foil = self%bump_conductance > 0.0_wp .and. (self%sleeve == wall_given .or. &
                                                    self%sleeve_conductance > 0.0_wp)
    if (self%cooling_flow > 0.0_wp) by_foil = by_foil .or. self%channel_conductance > 0.0_wp .or. &
      min(self%bump_conductance, self%channel_sleeve_conductance) > 0.0_wp
    has = self%shaft == wall_given .or. self%top_foil == foil_given .or. by_foil .or. &
          self%shaft_conductance > 0.0_wp .or. any(self%shaft_end_conductance > 0.0_wp)
  end function has_way_out
end module gfb_thermal_case
