!> `&feed`: gas that is fed into the film under pressure, through a porous wall or orifices.
module gfb_feed_case
  use gfb_kinds, only: wp
  use gfb_units, only: turn, pi
  use gfb_analysis_row, only: analysis_row_type
  use gfb_bearing_case, only: bearing_case_type, pad_angle, pad_turn, pad_rows
  use gfb_bearing_row, only: bearing_row_type
  use gfb_case_keys, only: case_keys_type, longest_list, any_value, from_to, not_negative, &
                           positive, unless
  use gfb_feed_law, only: restriction_series
  use gfb_gas_case, only: gas_case_type, usual_temperature
  use gfb_gas_law, only: gas_constant, density_ideal
  use gfb_key_effect, only: acts_on_film, acts_on_all
  use gfb_text, only: text
  implicit none (type, external)
  private
  public :: feed_case_type, read_feed_case, follow_heat, hole_type, find_holes

  character(len=*), parameter, public :: feed_group = 'feed'

  integer, parameter, public :: feed_porous = 1, feed_orifices = 2
  integer, parameter, public :: spread_rim = 1  !! gas enters on the rims of mouths
  integer, parameter, public :: spread_line = 2 !! evenly along each row
  integer, parameter, public :: through_sleeve = 1   !! holes in it end at the film
  integer, parameter, public :: through_top_foil = 2 !! tubes end at holes in it
  integer, parameter, public :: through_channel = 3  !! the gas under it enters by holes in it

  character(len=*), parameter :: kind_words(*) = [character(len=8) :: 'porous', 'orifices']
  character(len=*), parameter :: restriction_words(*) = [character(len=7) :: 'series', &
                                                         'curtain', 'hole']
  character(len=*), parameter :: spread_words(*) = [character(len=4) :: 'rim', 'line']
  character(len=*), parameter :: backflow_words(*) = [character(len=3) :: 'yes', 'no']
  character(len=*), parameter :: through_words(*) = [character(len=8) :: 'sleeve', 'top_foil', &
                                                      'channel']
  character(len=*), parameter :: porous_only = "needs kind = 'porous'"
  character(len=*), parameter :: orifices_only = "needs kind = 'orifices'"
  real(wp), parameter :: most_orifices = 1000.0_wp !! of a row
  real(wp), parameter :: coldest = 50.0_wp, hottest = 3000.0_wp !! that a key may say [K]
  real(wp), parameter :: least_permeability = 1.0e-18_wp, most_permeability = 1.0e-10_wp !! [m2]

  !> What feeds the film. Lengths of rows are z, or radii of a thrust bearing.
  type :: feed_case_type
    logical :: present = .false.             !! the group stands in the file
    integer :: kind = 0                      !! `feed_porous`, `feed_orifices`; 0: not known
    real(wp) :: supply_pressure = 0.0_wp     !! absolute [Pa]
    real(wp) :: supply_temperature = usual_temperature !! [K]
    logical :: temperature_given = .false.   !! else it follows other groups
    logical :: heated = .false.              !! the film has heat, be it held or not yet solved for
    real(wp) :: film_temperature = usual_temperature !! T_r, at which the film's gas counts [K]
    real(wp) :: energy = 0.0_wp              !! Rg T_s of the gas [J/kg]
    !> of mass in the film's unit, Rg T_r; of a real gas p_a/rho_a [J/kg]
    real(wp) :: film_energy = 0.0_wp
    real(wp) :: permeability = 0.0_wp        !! [m2]
    real(wp) :: wall_thickness = 0.0_wp      !! [m]
    real(wp) :: inertia_coefficient = 0.0_wp !! Forchheimer's [1/m]
    real(wp) :: orifice_diameter = 0.0_wp    !! [m]
    integer :: orifices = 0                  !! of a row; of a thrust bearing's sector
    real(wp), allocatable :: row_positions(:)  !! z, or radius [m]
    real(wp), allocatable :: orifice_angles(:) !! in place of equal ones [rad]
    real(wp) :: first_orifice_angle = 0.0_wp !! [rad]
    logical :: first_given = .false.         !! else it is half a pitch
    real(wp) :: row_shift = 0.0_wp           !! of each row against the one before [rad]
    integer :: restriction = restriction_series
    real(wp) :: mouth_diameter = 0.0_wp      !! [m]
    real(wp) :: pocket_volume = 0.0_wp       !! of each [m3]
    real(wp) :: discharge_coefficient = 0.8_wp
    real(wp) :: specific_heat_ratio = 1.4_wp
    integer :: spread = spread_rim
    integer :: backflow = 1                  !! 1: gas may leave through orifices
    integer :: through = through_sleeve
    real(wp) :: tube_diameter = 0.0_wp       !! outer one; 0: tubes push nothing [m]
    real(wp) :: channel_pressure = 0.0_wp    !! of the gas under the top foil, absolute [Pa]
  contains
    procedure, non_overridable :: has_orifices, holes_of_row, flows_back, mirrors, gap_size
    procedure, non_overridable :: pressure_at_holes, fills_channel, tube_area
    procedure, non_overridable :: density_ratio
  end type feed_case_type

  !> Where an orifice lies on a pad.
  type :: hole_type
    integer :: row = 1        !! of orifices
    integer :: number = 1     !! of all of the bearing's, row by row
    real(wp) :: angle = 0.0_wp !! theta as on the pad's mesh, that of the first pad [rad]
    real(wp) :: along = 0.0_wp !! z, or radius [m]
  end type hole_type

contains

  !> Reads the group.
  subroutine read_feed_case(keys, feed, gas, bearing, analysis)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(feed_case_type), intent(out) :: feed !! what `&feed` asks for
    type(gas_case_type), intent(in) :: gas !! what `&gas` asks for
    type(bearing_case_type), intent(in) :: bearing !! what `&bearing` and `&pads` ask for
    type(analysis_row_type), intent(in) :: analysis !! of the case file
    character(len=:), allocatable :: of_wall, of_holes !! why keys of the kinds have no use
    logical :: given

    call keys%start_group(feed_group, optional=.true., present_in_file=feed%present, &
                          misplaced=analysis%refusal(feed_group), acts_on=acts_on_film)
    call keys%idle(unless(feed%present, 'the file has no group &feed'))
    call keys%choice_key('kind', feed%kind, kind_words, 'gas enters through a porous wall '// &
                         'behind the whole surface, or through orifices', required=.true.)
    of_wall = unless(any(feed%kind == [0, feed_porous]), porous_only)
    of_holes = unless(any(feed%kind == [0, feed_orifices]), orifices_only)
    call keys%real_key('supply_pressure', feed%supply_pressure, 'Pa', 'absolute pressure of '// &
                       'the supply', positive, .true.)
    if (gas%temperature > 0.0_wp) feed%supply_temperature = gas%temperature
    call keys%real_key('supply_temperature', feed%supply_temperature, 'K', 'temperature of the '// &
                       'gas that is fed in, and of a porous wall', from_to(coldest, hottest), &
                       default='with `&thermal` its `ambient_temperature`, else `temperature` '// &
                       'of `&gas`, else 293.15', given=feed%temperature_given)
    feed%film_temperature = feed%supply_temperature
    call find_energies(gas, feed)
    call keys%real_key('permeability', feed%permeability, 'm^2', 'of the porous wall, '// &
                       "Darcy's", from_to(least_permeability, most_permeability), &
                       feed%kind == feed_porous, "required with kind = 'porous'", useless=of_wall)
    call keys%real_key('wall_thickness', feed%wall_thickness, 'm', 'of the porous wall', &
                       positive, feed%kind == feed_porous, "required with kind = 'porous'", &
                       useless=of_wall)
    call keys%real_key('inertia_coefficient', feed%inertia_coefficient, '1/m', &
                       "Forchheimer's coefficient of the porous wall; 0: Darcy's law alone", &
                       not_negative, useless=of_wall)
    call read_holes(keys, feed, of_holes)
    call keys%choice_key('restriction', feed%restriction, restriction_words, 'what an orifice '// &
                         'is: its hole and the curtain of the film around its mouth, one '// &
                         'behind the other; the curtain; or the hole', useless=of_holes)
    feed%mouth_diameter = feed%orifice_diameter
    call keys%real_key('mouth_diameter', feed%mouth_diameter, 'm', 'of the pocket through '// &
                       'which an orifice opens into the film', positive, &
                       default='orifice_diameter', useless=of_holes, acts_on=acts_on_all, &
                       given=given)
    call keys%real_key('pocket_volume', feed%pocket_volume, 'm^3', 'of gas between an orifice '// &
                       'and the film, of each', not_negative, useless=of_holes)
    call keys%real_key('discharge_coefficient', feed%discharge_coefficient, '1', 'flow through '// &
                       'an orifice over the isentropic one', from_to(0.01_wp, 1.0_wp), &
                       useless=of_holes)
    call keys%real_key('specific_heat_ratio', feed%specific_heat_ratio, '1', 'of the gas, in '// &
                       'the flow through orifices', from_to(1.01_wp, 1.7_wp), useless=of_holes)
    call keys%choice_key('spread', feed%spread, spread_words, 'gas enters on the rims of '// &
                         'mouths, or evenly along each row, which overestimates force and '// &
                         'stiffness', useless=of_holes)
    call keys%choice_key('backflow', feed%backflow, backflow_words, 'whether gas of the film '// &
                         'may leave through orifices; check valves keep it', useless=of_holes)
    call keys%choice_key('through', feed%through, through_words, 'orifices are holes of the '// &
                         'sleeve; of the top foil, at the ends of tubes; or of the top foil, '// &
                         'fed by gas that fills the channel under it', useless=of_holes)
    call read_foil_holes(keys, feed)
    call check_holes(keys, feed, bearing, given)
  end subroutine read_feed_case

  !> With heat the film's gas counts at ambient temperature, which the supply has where nothing else
  !> is said.
  subroutine follow_heat(keys, feed, gas, ambient)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(feed_case_type), intent(inout) :: feed !! what `&feed` asks for
    type(gas_case_type), intent(in) :: gas !! what `&gas` asks for
    real(wp), intent(in) :: ambient !! temperature of `&thermal` [K]

    feed%heated = .true.
    feed%film_temperature = ambient
    if (.not. feed%temperature_given) feed%supply_temperature = ambient
    call keys%follow(feed_group, 'supply_temperature', feed%supply_temperature)
    call find_energies(gas, feed)
  end subroutine follow_heat

  !> Energies that stand for mass in flows.
  pure subroutine find_energies(gas, feed)
    type(gas_case_type), intent(in) :: gas
    type(feed_case_type), intent(inout) :: feed !! with its temperatures

    if (gas%molar_mass > 0.0_wp) then
      feed%energy = gas_constant/gas%molar_mass*feed%supply_temperature
      feed%film_energy = gas_constant/gas%molar_mass*feed%film_temperature
    end if
    if (gas%law%density == density_ideal .or. .not. gas%law%ambient_density > 0.0_wp) return
    feed%film_energy = gas%ambient_pressure/gas%law%ambient_density
  end subroutine find_energies

  !> Density of the supply's gas over that of the film's where it counts, \( T_r/T_s \) [1].
  pure real(wp) function density_ratio(self) result(ratio)
    class(feed_case_type), intent(in) :: self !! what `&feed` asks for
    ratio = self%film_temperature/self%supply_temperature
  end function density_ratio

  !> Where orifices are, and how large.
  subroutine read_holes(keys, feed, useless)
    type(case_keys_type), intent(inout) :: keys
    type(feed_case_type), intent(inout) :: feed
    character(len=*), intent(in) :: useless !! why the keys have no use
    logical :: wanted

    wanted = feed%kind == feed_orifices
    call keys%real_key('orifice_diameter', feed%orifice_diameter, 'm', 'of the holes', positive, &
                       wanted, "required with kind = 'orifices'", useless=useless, &
                       acts_on=acts_on_all)
    call keys%integer_key('orifices', feed%orifices, 'of a row, equally spaced; of thrust '// &
                          'bearings of a row of one sector', from_to(1.0_wp, most_orifices), &
                          default='required without orifice_angles', useless=useless)
    call keys%real_list_key('row_positions', feed%row_positions, longest_list, 'm', 'z of each '// &
                            'row of orifices, rising; of thrust bearings its radius', any_value, &
                            wanted, "required with kind = 'orifices'; there it may be 0")
    call keys%act_on('row_positions', acts_on_all)
    call keys%refuse(feed_group, 'row_positions', useless /= '', useless)
    call keys%real_key('first_orifice_angle', feed%first_orifice_angle, 'rad', 'theta of the '// &
                       'first orifice of the first row; of thrust bearings from the leading '// &
                       'edge of its sector', from_to(0.0_wp, turn), default='half a pitch', &
                       given=feed%first_given, useless=useless, acts_on=acts_on_all)
    call keys%real_list_key('orifice_angles', feed%orifice_angles, longest_list, 'rad', 'theta '// &
                            'of the orifices of the first row, rising, in place of equally '// &
                            'spaced ones; of thrust bearings from the leading edge', &
                            from_to(0.0_wp, turn), .false., 'equally spaced')
    call keys%act_on('orifice_angles', acts_on_all)
    call keys%refuse(feed_group, 'orifice_angles', useless /= '', useless)
    call keys%real_key('row_shift', feed%row_shift, 'rad', 'by which each row of orifices is '// &
                       'turned against the one before', any_value, useless=useless, &
                       acts_on=acts_on_all)
  end subroutine read_holes

  !> What holes of a top foil need beside.
  subroutine read_foil_holes(keys, feed)
    type(case_keys_type), intent(inout) :: keys
    type(feed_case_type), intent(inout) :: feed

    call keys%real_key('tube_diameter', feed%tube_diameter, 'm', 'of the tubes that end in '// &
                       'holes of the top foil, outside: each pushes it to the shaft with what '// &
                       'the supply has above ambient pressure on this area; 0: with nothing', &
                       not_negative, useless=unless(feed%through == through_top_foil, &
                                                    "needs through = 'top_foil'"))
    feed%channel_pressure = feed%supply_pressure
    call keys%real_key('channel_pressure', feed%channel_pressure, 'Pa', 'absolute pressure of '// &
                       'the gas under the top foil: its holes are fed from it, and it bends '// &
                       'the foil to the shaft; supply_pressure is what that gas is compressed '// &
                       'to, the channel has less where the way into it takes some', positive, &
                       default='supply_pressure', &
                       useless=unless(feed%through == through_channel, &
                                      "needs through = 'channel'"))
    if (.not. feed%has_orifices()) return
    call keys%rule(feed_group, 'spread', feed%through /= through_sleeve .and. &
                   feed%spread == spread_line, "must be 'rim' with through = 'top_foil' or "// &
                   "'channel': the foil's mesh has no lines along rows of orifices")
    call keys%rule(feed_group, 'channel_pressure', feed%fills_channel() .and. &
                   feed%channel_pressure > feed%supply_pressure, &
                   'must not be more than supply_pressure, '//text(feed%supply_pressure)// &
                   ' Pa, which fills the channel')
  end subroutine read_foil_holes

  !> What the keys of orifices ask of each other.
  subroutine check_holes(keys, feed, bearing, mouth_given)
    type(case_keys_type), intent(inout) :: keys
    type(feed_case_type), intent(in) :: feed
    type(bearing_case_type), intent(in) :: bearing
    logical, intent(in) :: mouth_given
    real(wp) :: rows(2)
    integer :: i
    logical :: listed

    if (.not. (feed%present .and. feed%kind == feed_orifices)) return
    listed = keys%holds(feed_group, 'orifice_angles')
    call keys%rule(feed_group, 'orifices', listed .and. keys%holds(feed_group, 'orifices'), &
                   'must not stand beside orifice_angles')
    call keys%rule(feed_group, 'orifices', .not. listed .and. &
                   .not. keys%holds(feed_group, 'orifices'), 'or orifice_angles is needed')
    call keys%rule(feed_group, 'first_orifice_angle', listed .and. feed%first_given, &
                   'must not stand beside orifice_angles')
    call keys%rule(feed_group, 'spread', listed .and. feed%spread == spread_line, &
                   "must be 'rim' with orifice_angles: along a line all places are alike")
    do i = 2, size(feed%orifice_angles)
      if (feed%orifice_angles(i) > feed%orifice_angles(i - 1)) cycle
      call keys%complain(feed_group, 'orifice_angles', 'must be greater than the value before '// &
                         'it', i)
    end do
    call keys%rule(feed_group, 'mouth_diameter', mouth_given .and. &
                   feed%mouth_diameter < feed%orifice_diameter, 'must not be less than '// &
                   'orifice_diameter, '//text(feed%orifice_diameter)//' m')
    call keys%rule(feed_group, 'pocket_volume', feed%pocket_volume > 0.0_wp .and. &
                   feed%restriction == 2 .and. &
                   .not. feed%mouth_diameter > feed%orifice_diameter, 'needs mouth_diameter: '// &
                   "a curtain around the hole itself, restriction = 'curtain', has no pocket")
    if (.not. bearing%length > 0.0_wp) return
    rows = pad_rows(bearing)
    do i = 1, size(feed%row_positions)
      associate (here => feed%row_positions(i), half => 0.5_wp*feed%mouth_diameter)
        if (here - half <= rows(1) .or. here + half >= rows(2)) then
          call keys%complain(feed_group, 'row_positions', 'must lie within the pad with its '// &
                             'mouths, between '//text(rows(1))//' and '//text(rows(2))//' m', i)
        end if
        if (i == 1) cycle
        if (here > feed%row_positions(i - 1)) cycle
        call keys%complain(feed_group, 'row_positions', 'must be greater than the value before '// &
                           'it', i)
      end associate
    end do
  end subroutine check_holes

  !> Whether the film is fed through orifices.
  pure logical function has_orifices(self)
    class(feed_case_type), intent(in) :: self !! what `&feed` asks for
    has_orifices = self%present .and. self%kind == feed_orifices
  end function has_orifices

  !> Orifices of a row, of thrust bearings of a sector's.
  pure integer function holes_of_row(self) result(holes)
    class(feed_case_type), intent(in) :: self !! what `&feed` asks for

    holes = self%orifices
    if (.not. allocated(self%orifice_angles)) return
    if (size(self%orifice_angles) > 0) holes = size(self%orifice_angles)
  end function holes_of_row

  !> Whether both halves of the width are fed alike: rows mirror each other, and are not turned.
  pure logical function mirrors(self)
    class(feed_case_type), intent(in) :: self !! what `&feed` asks for
    real(wp), parameter :: rounding = 1.0e-9_wp !! relative

    mirrors = .true.
    if (.not. self%has_orifices()) return
    associate (rows => self%row_positions)
      if (size(rows) == 0) return
      mirrors = all(abs(rows + rows(size(rows):1:-1)) <= rounding*maxval(abs(rows)))
      mirrors = mirrors .and. (size(rows) < 2 .or. .not. abs(self%row_shift) > 0.0_wp .or. &
                               self%spread == spread_line)
    end associate
  end function mirrors

  !> The gap at which film and supply resist alike, near which a fed film is stiffest; 0 where
  !> nothing says it.
  !>
  !> A wall of the film's width w: \( h^3 = 3 \kappa w^2/H \). n choked holes, and a film from
  !> them to both edges: \( h^3 = 1.5 \mu \sqrt{R_g T_s} \, n C_d d^2 \psi/p_s \).
  pure real(wp) function gap_size(self, viscosity, width) result(gap)
    class(feed_case_type), intent(in) :: self !! what `&feed` asks for
    real(wp), intent(in) :: viscosity !! of the gas [Pa s]
    real(wp), intent(in) :: width     !! of the film across the motion [m]
    real(wp), parameter :: choked = 0.68_wp !! psi of air [1]
    real(wp) :: holes

    gap = 0.0_wp
    if (.not. self%present) return
    if (self%kind == feed_porous .and. self%wall_thickness > 0.0_wp) then
      gap = (3.0_wp*self%permeability*width**2/self%wall_thickness)**(1.0_wp/3.0_wp)
    else if (self%has_orifices() .and. self%pressure_at_holes() > 0.0_wp) then
      holes = real(self%holes_of_row()*size(self%row_positions), wp)
      gap = (1.5_wp*viscosity*sqrt(self%energy)*holes*self%discharge_coefficient*choked* &
             self%orifice_diameter**2/self%pressure_at_holes())**(1.0_wp/3.0_wp)
    end if
  end function gap_size

  !> Whether gas under the top foil feeds its holes.
  pure logical function fills_channel(self) result(fills)
    class(feed_case_type), intent(in) :: self !! what `&feed` asks for
    fills = self%has_orifices() .and. self%through == through_channel
  end function fills_channel

  !> Absolute pressure behind orifices: the supply's, or that of the gas under the foil [Pa].
  pure real(wp) function pressure_at_holes(self) result(pressure)
    class(feed_case_type), intent(in) :: self !! what `&feed` asks for
    pressure = merge(self%channel_pressure, self%supply_pressure, self%fills_channel())
  end function pressure_at_holes

  !> Area on which a tube pushes the foil, \( \pi d_t^2/4 \) [m2].
  pure real(wp) function tube_area(self) result(area)
    class(feed_case_type), intent(in) :: self !! what `&feed` asks for
    area = 0.25_wp*pi*self%tube_diameter**2
  end function tube_area

  !> Whether gas may leave through orifices.
  pure logical function flows_back(self)
    class(feed_case_type), intent(in) :: self !! what `&feed` asks for
    flows_back = self%backflow == 1
  end function flows_back

  !> The orifices that lie on a pad, at their places on the mesh of the first one.
  !>
  !> Of a thrust bearing each sector has its own; around a journal they are counted from theta = 0,
  !> and those between pads feed nothing.
  pure subroutine find_holes(feed, bearing, pad, hole)
    type(feed_case_type), intent(in) :: feed !! what `&feed` asks for
    type(bearing_case_type), intent(in) :: bearing !! what `&bearing` and `&pads` ask for
    integer, intent(in) :: pad !! its number, from 1
    type(hole_type), allocatable, intent(out) :: hole(:)
    real(wp) :: pitch, angle, arc, start
    integer :: row, i, n, before

    allocate (hole(0))
    if (.not. feed%has_orifices()) return
    n = feed%holes_of_row()
    before = merge((pad - 1)*n*size(feed%row_positions), 0, bearing%row%has_sectors)
    arc = pad_angle(bearing)
    start = bearing%leading_edge_angle
    pitch = merge(arc, turn, bearing%row%has_sectors)/real(max(n, 1), wp)
    do row = 1, size(feed%row_positions)
      do i = 1, n
        if (size(feed%orifice_angles) > 0) then
          angle = feed%orifice_angles(i)
        else if (feed%first_given) then
          angle = feed%first_orifice_angle + pitch*real(i - 1, wp)
        else
          angle = pitch*(real(i, wp) - 0.5_wp)
        end if
        angle = angle + feed%row_shift*real(row - 1, wp)
        if (bearing%row%has_sectors) then
          if (arc >= turn) angle = modulo(angle, turn)
          angle = start + angle
        else
          angle = start + modulo(angle - pad_turn(bearing, pad) - start, turn)
        end if
        if (angle < start .or. angle > start + arc) cycle
        hole = [hole, hole_type(row, before + (row - 1)*n + i, angle, feed%row_positions(row))]
      end do
    end do
  end subroutine find_holes
end module gfb_feed_case
