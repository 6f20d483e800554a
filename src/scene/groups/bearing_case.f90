!> `&bearing` and `&pads`: the pad, or several equal ones with their preload; `&bore`: where the
!> bore is no circle; `&ramp`: how the pads of a thrust bearing begin.
module gfb_bearing_case
  use gfb_kinds, only: wp, most_pads
  use gfb_units, only: turn, pi
  use gfb_case_keys, only: case_keys_type, no_default, at_least, from_below, from_to, positive, &
                           longest_list, any_value, not_negative, rule_type, unless
  use gfb_text, only: text
  use gfb_bearing_row, only: bearing_row_type, bearing_rows, bearing_words, bearing_unknown, &
                             bearing_journal, bearing_cone, needs_journal
  use gfb_bore_profile, only: bore_profile_type
  use gfb_film_surface, only: film_surface_type, cone, ring
  use gfb_ramp_shape, only: ramp_shape_type, ramp_shape
  use gfb_key_effect, only: acts_on_film, acts_on_all
  implicit none (type, external)
  private
  public :: bearing_case_type, bore_case_type, read_bearing_case, read_pads_case, read_bore_case
  public :: read_ramp_case, ramp_of
  public :: surface_of, pad_area, pad_rows, pad_angle, pad_length, strip_length, strip_ends
  public :: middle_radius, pad_turn, preload_angle

  integer, parameter, public :: leading_edge_slit = 1     !! ambient pressure at both ends
  integer, parameter, public :: leading_edge_periodic = 2 !! a full ring without ends
  integer, parameter, public :: inner_edge_sealed = 2     !! nothing flows through it

  character(len=*), parameter :: edge_words(*) = [character(len=8) :: 'slit', 'periodic']
  character(len=*), parameter :: inner_words(*) = [character(len=7) :: 'ambient', 'sealed']
  character(len=*), parameter :: pads_group = 'pads', bore_group = 'bore', ramp_group = 'ramp'
  real(wp), parameter :: most_waves = 1000.0_wp !! of a bore; more are roughness, which no mesh has
  real(wp), parameter :: rounding = 1.0e-9_wp !! of angles that are meant to be equal [rad]

  !> The pad.
  type :: bearing_case_type
    type(bearing_row_type) :: row = bearing_journal !! its kind
    real(wp) :: radius = 0.0_wp              !! of the shaft; outer one of a ring [m]
    real(wp) :: inner_radius = 0.0_wp        !! of a ring [m]
    real(wp) :: play = 0.0_wp                !! between two rings; 0: there is one [m]
    real(wp) :: length = 0.0_wp              !! across the motion: along the axis, or the radius [m]
    real(wp) :: half_angle = 0.0_wp          !! of a cone; 0: it is none [rad]
    !> radial; of a thrust bearing the size of its gap, see `size_of_gap` [m]
    real(wp) :: clearance = 0.0_wp
    real(wp) :: ramp_part = 0.0_wp           !! of a pad's arc; 0: no ramp [1]
    real(wp) :: ramp_height = 0.0_wp         !! at the leading edge [m]
    real(wp) :: interference = 0.0_wp        !! of assembly, off the gap all around [m]
    real(wp) :: leading_edge_angle = 0.0_wp  !! where the first pad begins [rad]
    integer :: leading_edge_condition = leading_edge_slit
    integer :: inner_edge = 1                !! of a thrust bearing: ambient, `inner_edge_sealed`
    integer :: pads = 1                      !! equal ones, equally spaced
    real(wp) :: arc = 0.0_wp                 !! of one of them; 0: it ends at 2 pi [rad]
    real(wp) :: preload = 0.0_wp             !! shift of its centre over the clearance [1]
    real(wp) :: preload_offset = 0.5_wp      !! where on it: part of the arc [1]
  contains
    procedure :: all_pads, is_ring
  end type bearing_case_type

  !> The bore.
  type :: bore_case_type
    logical :: present = .false.       !! the file has the group
    type(bore_profile_type) :: profile !! its height over the circle
  end type bore_case_type

contains

  !> Reads `&bearing`.
  subroutine read_bearing_case(keys, bearing, needed, with_film, misplaced)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(bearing_case_type), intent(out) :: bearing !! what `&bearing` asks for
    logical, intent(in) :: needed             !! the scene has a pad
    logical, intent(in) :: with_film          !! and a film between it and a shaft
    character(len=*), intent(in) :: misplaced !! why the group does not fit; empty where it does

    character(len=:), allocatable :: journal, thrust !! why keys of the kind have no use
    logical :: ring
    integer :: kind !! its number, 0 where it is not known

    call keys%start_group('bearing', required=needed, optional=.not. needed, &
                          misplaced=misplaced, acts_on=acts_on_all)
    kind = bearing%row%number
    call keys%choice_key('kind', kind, bearing_rows(:bearing_words)%word, 'a cylinder around '// &
                         'the shaft, or pads in a plane across the axis with a runner above them', &
                         useless=unless(with_film .or. .not. needed, 'has no use without a film'))
    bearing%row = bearing_unknown
    if (kind > 0) bearing%row = bearing_rows(kind)
    ring = bearing%row%has_sectors
    journal = trim(bearing%row%journal_keys)
    thrust = trim(bearing%row%thrust_keys)
    call keys%real_key('radius', bearing%radius, 'm', 'radius of the shaft; of a cone in the '// &
                       'middle of its length', positive, needed .and. .not. ring, useless=journal)
    call keys%real_key('length', bearing%length, 'm', 'length along the axis; of a cone along '// &
                       'its lines', positive, needed .and. .not. ring, useless=journal)
    call keys%real_key('half_angle', bearing%half_angle, 'rad', 'of a conical bearing: angle '// &
                       'of its lines with the axis; it is wider towards +z', &
                       from_below(0.0_wp, 0.5_wp*pi), default='0: a cylinder', &
                       useless=unless(with_film .or. .not. needed, 'has no use without a film'))
    call keys%refuse('bearing', 'half_angle', ring, needs_journal)
    if (kind == bearing_journal%number .and. bearing%half_angle > 0.0_wp) then
      bearing%row = bearing_cone
    end if
    call keys%rule('bearing', 'half_angle', min(bearing%half_angle, bearing%radius) > 0.0_wp .and. &
                   0.5_wp*bearing%length*sin(bearing%half_angle) >= bearing%radius, &
                   'must leave a radius at the narrow end: half of length times its sine is '// &
                   text(0.5_wp*bearing%length*sin(bearing%half_angle), 4)//' m')
    call keys%real_key('outer_radius', bearing%radius, 'm', 'outer radius of the pads of a '// &
                       'thrust bearing', positive, ring, default=no_default, useless=thrust)
    call keys%real_key('inner_radius', bearing%inner_radius, 'm', 'their inner radius', &
                       positive, ring, default=no_default, useless=thrust)
    call keys%rule('bearing', 'inner_radius', ring .and. bearing%radius > 0.0_wp .and. &
                   bearing%inner_radius >= bearing%radius, 'must be less than outer_radius, '// &
                   text(bearing%radius)//' m')
    call keys%real_key('axial_play', bearing%play, 'm', 'sum of the gaps on both sides of the '// &
                       'runner: on its other side there is the same bearing as its mirror '// &
                       'image, and `axial_load` may be 0 or negative', positive, &
                       default='no bearing on the other side', useless=thrust)
    if (ring) bearing%length = max(bearing%radius - bearing%inner_radius, 0.0_wp)
    call keys%real_key('clearance', bearing%clearance, 'm', &
                       'radial clearance, shaft to top foil at rest; of a cone normal to its '// &
                       'surface, where nothing is moved', positive, &
                       with_film .and. .not. ring, default=merge('    ', no_default, with_film), &
                       useless=journal, acts_on=acts_on_film)
    call keys%real_key('leading_edge_angle', bearing%leading_edge_angle, 'rad', &
                       'where the pad begins; it ends at 2 pi', from_below(0.0_wp, turn), &
                       useless=unless(.not. ring, needs_journal//': first_leading_edge in '// &
                                      '&pads says where its pads begin'))
    call keys%choice_key('leading_edge_condition', bearing%leading_edge_condition, edge_words, &
                         'ambient pressure at both ends of the pad, or a full ring')
    call keys%choice_key('inner_edge', bearing%inner_edge, inner_words, 'of thrust bearings: '// &
                         'ambient pressure at the inner radius, or nothing flows through it', &
                         useless=thrust)
    call keys%real_key('assembly_interference', bearing%interference, 'm', 'taken off the gap '// &
                       'all around; more than `clearance` presses the foil back at rest', &
                       at_least(0.0_wp), useless=journal, acts_on=acts_on_film)
    call keys%rule('bearing', 'leading_edge_angle', &
                   bearing%leading_edge_condition == leading_edge_periodic .and. &
                   bearing%leading_edge_angle > 0.0_wp, 'must be 0 with leading_edge_condition '// &
                   "= 'periodic', a full ring")
  end subroutine read_bearing_case

  !> Pads on all sides of the runner, or around the shaft.
  elemental integer function all_pads(self) result(pads)
    class(bearing_case_type), intent(in) :: self !! what `&bearing` and `&pads` ask for
    pads = self%pads*merge(2, 1, self%play > 0.0_wp)
  end function all_pads

  !> Whether the pad goes all around, without edges.
  elemental logical function is_ring(self) result(ring)
    class(bearing_case_type), intent(in) :: self !! what `&bearing` asks for
    ring = self%leading_edge_condition == leading_edge_periodic
  end function is_ring

  !> The ramp of a pad, and the play on the runner's other side.
  pure type(ramp_shape_type) function ramp_of(bearing, leading_edge, facing) result(ramp)
    type(bearing_case_type), intent(in) :: bearing !! what `&bearing`, `&pads` and `&ramp` ask for
    real(wp), intent(in) :: leading_edge !! where the pad begins [rad]
    real(wp), intent(in) :: facing !! -1: it is on the runner's other side [1]

    ramp = ramp_shape(leading_edge, bearing%ramp_part*pad_angle(bearing), bearing%ramp_height, &
                      merge(bearing%play, 0.0_wp, facing < 0.0_wp))
  end function ramp_of

  !> The surface that its film lies on.
  pure type(film_surface_type) function surface_of(bearing) result(surface)
    type(bearing_case_type), intent(in) :: bearing !! what `&bearing` asks for

    surface = cone(bearing%radius, bearing%half_angle, 0.0_wp)
    if (bearing%row%has_sectors) surface = ring(bearing%radius)
  end function surface_of

  !> Area of the pads of one side as the load sees it: D L, or that of the sectors [m^2].
  elemental real(wp) function pad_area(bearing) result(area)
    type(bearing_case_type), intent(in) :: bearing !! what `&bearing` and `&pads` ask for

    area = 2.0_wp*bearing%radius*bearing%length
    if (bearing%row%has_sectors) area = 0.5_wp*real(bearing%pads, wp)*pad_angle(bearing)* &
                                        (bearing%radius**2 - bearing%inner_radius**2)
  end function pad_area

  !> First and last row of a pad: s, as `gfb_film_surface` has it [m].
  pure function pad_rows(bearing) result(ends)
    type(bearing_case_type), intent(in) :: bearing !! what `&bearing` asks for
    real(wp) :: ends(2)

    ends = 0.5_wp*bearing%length*[-1.0_wp, 1.0_wp]
    if (bearing%row%has_sectors) ends = [bearing%inner_radius, bearing%radius]
  end function pad_rows

  !> Angle that the pad covers [rad].
  elemental real(wp) function pad_angle(bearing) result(angle)
    type(bearing_case_type), intent(in) :: bearing !! what `&bearing` asks for
    angle = turn - bearing%leading_edge_angle
    if (bearing%arc > 0.0_wp) angle = bearing%arc
  end function pad_angle

  !> Angle from the first pad to another [rad].
  elemental real(wp) function pad_turn(bearing, pad) result(angle)
    type(bearing_case_type), intent(in) :: bearing !! what `&bearing` asks for
    integer, intent(in) :: pad !! its number, from 1
    angle = turn*real(pad - 1, wp)/real(bearing%pads, wp)
  end function pad_turn

  !> Where the preload narrows the gap of a pad most, theta_p [rad].
  elemental real(wp) function preload_angle(bearing, pad) result(angle)
    type(bearing_case_type), intent(in) :: bearing !! what `&bearing` asks for
    integer, intent(in) :: pad !! its number, from 1
    angle = bearing%leading_edge_angle + pad_turn(bearing, pad) &
            + bearing%preload_offset*pad_angle(bearing)
  end function preload_angle

  !> Length of the unrolled pad [m].
  elemental real(wp) function pad_length(bearing) result(length)
    type(bearing_case_type), intent(in) :: bearing !! what `&bearing` asks for
    length = bearing%radius*pad_angle(bearing)
  end function pad_length

  !> Length of the pad that bumps lie under [m].
  elemental real(wp) function strip_length(bearing) result(length)
    type(bearing_case_type), intent(in) :: bearing !! what `&bearing` asks for

    length = middle_radius(bearing)*pad_angle(bearing)*(1.0_wp - bearing%ramp_part)
  end function strip_length

  !> Radius in the middle of the pad's width [m].
  elemental real(wp) function middle_radius(bearing) result(radius)
    type(bearing_case_type), intent(in) :: bearing !! what `&bearing` asks for
    type(film_surface_type) :: surface

    surface = surface_of(bearing)
    radius = surface%radius_at(0.5_wp*sum(pad_rows(bearing)))
  end function middle_radius

  !> Where one of equal strips side by side ends along the rows of a pad: z, or the radius of a
  !> sector [m].
  pure function strip_ends(bearing, strips, cut, strip) result(ends)
    type(bearing_case_type), intent(in) :: bearing !! what `&bearing` asks for
    integer, intent(in) :: strips !! side by side
    real(wp), intent(in) :: cut !! between two of them [m]
    integer, intent(in) :: strip !! its number, from the smallest z on
    real(wp) :: ends(2)
    real(wp) :: rows(2), width

    rows = pad_rows(bearing)
    width = (bearing%length - real(strips - 1, wp)*cut)/real(strips, wp)
    ends = rows(1) + real(strip - 1, wp)*(width + cut) + [0.0_wp, width]
  end function strip_ends

  !> Reads `&pads` into the bearing; without it the bearing has the one pad of `&bearing`.
  subroutine read_pads_case(keys, bearing, misplaced)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(bearing_case_type), intent(inout) :: bearing !! what `&bearing` asks for; gets the pads
    character(len=*), intent(in) :: misplaced !! why the group does not fit; empty where it does
    real(wp) :: first, gap

    first = bearing%leading_edge_angle
    gap = 0.0_wp
    call keys%start_group(pads_group, optional=.true., misplaced=misplaced, acts_on=acts_on_all)
    call keys%integer_key('count', bearing%pads, 'pads, equal and equally spaced', &
                          from_to(1.0_wp, real(most_pads, wp)))
    call keys%real_key('arc', bearing%arc, 'rad', 'of one pad, from its leading to its '// &
                       'trailing edge', positive, &
                       default='2 pi/count less gap; of one pad to 2 pi')
    call keys%real_key('first_leading_edge', first, 'rad', 'where pad 1 begins', &
                       from_below(0.0_wp, turn), default='leading_edge_angle in &bearing')
    call keys%real_key('gap', gap, 'rad', 'angle between the trailing edge of a pad and the '// &
                       'leading edge of the next', from_below(0.0_wp, turn), &
                       default='2 pi/count less arc')
    call keys%real_key('preload', bearing%preload, '1', 'shift of a pad''s centre of curvature '// &
                       'towards the shaft, over the clearance', from_below(0.0_wp, 1.0_wp), &
                       useless=trim(bearing%row%journal_keys), &
                       acts_on=acts_on_film)
    call keys%real_key('preload_offset', bearing%preload_offset, '1', 'where on the pad the '// &
                       'preload narrows the gap most: part of the arc from the leading edge', &
                       from_to(0.0_wp, 1.0_wp), &
                       useless=trim(bearing%row%journal_keys), &
                       acts_on=acts_on_film)
    call keys%rule(pads_group, 'count', bearing%play > 0.0_wp .and. 2*bearing%pads > most_pads, &
                   'must be '//text(most_pads/2)//' or less with axial_play in &bearing: both '// &
                   'sides have as many')
    call check_edges(keys, bearing, first)
    call check_arc(keys, bearing, gap)
    bearing%leading_edge_angle = first
    if (keys%meant(pads_group, 'arc')) return
    if (bearing%pads > 1 .or. keys%meant(pads_group, 'gap')) then
      bearing%arc = max(turn/bearing%pads - gap, rounding)
    end if
  end subroutine read_pads_case

  !> What the group says twice with `&bearing`, or against it.
  subroutine check_edges(keys, bearing, first)
    type(case_keys_type), intent(inout) :: keys
    type(bearing_case_type), intent(in) :: bearing
    real(wp), intent(in) :: first !! leading edge of pad 1 [rad]
    character(len=*), parameter :: ring = "needs leading_edge_condition = 'slit' in &bearing: "// &
                                          'a full ring has no edges'
    logical :: periodic

    periodic = bearing%leading_edge_condition == leading_edge_periodic
    call keys%rule(pads_group, 'first_leading_edge', &
                   keys%meant('bearing', 'leading_edge_angle') .and. &
                   keys%meant(pads_group, 'first_leading_edge') .and. &
                   abs(first - bearing%leading_edge_angle) > rounding, 'contradicts '// &
                   'leading_edge_angle in &bearing, '//text(bearing%leading_edge_angle)// &
                   ' rad: give one of them')
    call keys%refuse(pads_group, 'arc, gap, first_leading_edge', periodic, ring)
    call keys%refuse(pads_group, 'count', periodic .and. bearing%pads > 1, ring)
  end subroutine check_edges

  !> Whether the pads fit into the circle.
  subroutine check_arc(keys, bearing, gap)
    type(case_keys_type), intent(inout) :: keys
    type(bearing_case_type), intent(in) :: bearing
    real(wp), intent(in) :: gap !! between pads [rad]
    character(len=:), allocatable :: room
    real(wp) :: share

    share = turn/bearing%pads
    room = text(share, 7)//' rad, 2 pi over count'
    if (keys%meant(pads_group, 'arc') .and. bearing%arc > share + rounding) then
      call keys%complain(pads_group, 'arc', 'must not be longer than '//room//': the pads overlap')
    else if (keys%meant(pads_group, 'arc') .and. keys%meant(pads_group, 'gap')) then
      call keys%rule(pads_group, 'gap', abs(bearing%arc + gap - share) > rounding, &
                     'contradicts arc: together they must be '//room//'; give one of them')
    else if (gap >= share) then
      call keys%complain(pads_group, 'gap', 'must be smaller than '//room//': it leaves no pad')
    end if
  end subroutine check_arc

  !> Reads `&ramp` into the bearing; without it the pads are flat.
  subroutine read_ramp_case(keys, bearing, misplaced)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(bearing_case_type), intent(inout) :: bearing !! what `&bearing` asks for; gets the ramp
    character(len=*), intent(in) :: misplaced !! why the group does not fit; empty where it does
    character(len=:), allocatable :: why
    logical :: present_in_file

    why = misplaced
    if (why == '') why = trim(bearing%row%thrust_keys)
    call keys%start_group(ramp_group, optional=.true., present_in_file=present_in_file, &
                          misplaced=why, acts_on=acts_on_all)
    call keys%idle(unless(present_in_file, 'the file has no group &ramp'))
    call keys%real_key('part', bearing%ramp_part, '1', 'part of each pad, from its leading '// &
                       'edge, over which the gap narrows to that of the land', &
                       from_to(0.0_wp, 1.0_wp), present_in_file, default=no_default)
    call keys%real_key('height', bearing%ramp_height, 'm', 'what the ramp adds to the gap at '// &
                       'the leading edge, falling evenly along the angle', positive, &
                       present_in_file, default=no_default)
    call keys%rule(ramp_group, 'part', present_in_file .and. keys%meant(ramp_group, 'part') .and. &
                   .not. bearing%ramp_part > 0.0_wp, 'must be positive: without a ramp leave '// &
                   'out the group')
  end subroutine read_ramp_case

  !> Reads `&bore`.
  subroutine read_bore_case(keys, bore, bearing, misplaced)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(bore_case_type), intent(out) :: bore !! what `&bore` asks for
    type(bearing_case_type), intent(in) :: bearing !! the pads on it
    character(len=*), intent(in) :: misplaced !! why the group does not fit; empty where it does
    real(wp) :: peak, shims !! highest of the bore; of its shims, be the others wrong [m]
    integer :: mistakes !! before the group

    mistakes = keys%mistakes()
    call keys%start_group(bore_group, optional=.true., present_in_file=bore%present, &
                          misplaced=misplaced, acts_on=acts_on_film)
    call keys%idle(unless(bore%present, 'the file has no group &bore'))
    call read_waves(keys, bore%profile)
    call read_shims(keys, bore%profile, shims)
    call read_table(keys, bore%profile)
    if (.not. bore%present) return
    call keys%rule(bore_group, 'shim_height', .not. allocated(bore%profile%shim_height) .and. &
                   bearing%clearance > 0.0_wp .and. shims >= bearing%clearance, &
                   'must be less than the clearance of '//text(bearing%clearance)// &
                   ' m: no gap is left at rest')
    if (.not. bore%profile%present()) then
      call keys%rule(bore_group, 'waves', keys%mistakes() == mistakes, 'or shim_angle or '// &
                     'profile_angle is needed: the group says nothing of the bore')
      return
    end if
    peak = bore%profile%peak()
    if (.not. bearing%clearance > 0.0_wp) return
    if (peak >= bearing%clearance) then
      call keys%complain(bore_group, highest_key(bore%profile), 'makes the bore '//text(peak, 4)// &
                         ' m high in all, which must be less than the clearance of '// &
                         text(bearing%clearance)//' m: no gap is left at rest')
    else if (.not. least_gap(bearing, bore%profile) > 0.0_wp) then
      call keys%complain(bore_group, highest_key(bore%profile), 'with the preload of the pads '// &
                         'leaves no gap at rest')
    end if
  end subroutine read_bore_case

  !> Smallest gap at rest of pads with a preload [m].
  pure real(wp) function least_gap(bearing, profile) result(gap)
    type(bearing_case_type), intent(in) :: bearing
    type(bore_profile_type), intent(in) :: profile
    integer, parameter :: points = 2000 !! of a pad
    real(wp) :: angle, shift
    integer :: pad, i

    gap = bearing%clearance
    do pad = 1, bearing%pads
      do i = 0, points
        angle = bearing%leading_edge_angle + pad_turn(bearing, pad) &
          + pad_angle(bearing)*real(i, wp)/real(points, wp)
        shift = bearing%preload*cos(angle - preload_angle(bearing, pad))
        gap = min(gap, bearing%clearance*(1.0_wp - shift) - profile%height(angle, 0.0_wp))
      end do
    end do
  end function least_gap

  !> Lobes.
  subroutine read_waves(keys, profile)
    type(case_keys_type), intent(inout) :: keys
    type(bore_profile_type), intent(inout) :: profile
    logical :: waves, amplitude

    call keys%integer_key('waves', profile%waves, 'waves of the bore around the circle; 0: none', &
                          from_to(0.0_wp, most_waves), given=waves)
    waves = profile%waves > 0
    call keys%real_key('wave_amplitude', profile%wave_amplitude, 'm', 'amplitude of the waves, '// &
                       'half of their height from trough to crest', positive, waves, &
                       default='required with waves', given=amplitude)
    call keys%real_key('wave_angle', profile%wave_angle, 'rad', 'angle of a crest, where the '// &
                       'bore is nearest to the shaft', any_value)
    if (amplitude .and. .not. waves) call keys%complain(bore_group, 'wave_amplitude', 'needs waves')
    call keys%rule(bore_group, 'wave_angle', keys%meant(bore_group, 'wave_angle') .and. &
                   .not. waves, 'needs waves')
  end subroutine read_waves

  !> Shims: each list has one value a shim; of arcs, ramps and heights one may stand for all.
  subroutine read_shims(keys, profile, highest)
    type(case_keys_type), intent(inout) :: keys
    type(bore_profile_type), intent(inout) :: profile
    real(wp), intent(out) :: highest !! shim; 0 where their heights are wrong [m]
    real(wp), allocatable :: angle(:), height(:), arc(:), ramp(:)
    logical :: right, here

    call keys%real_list_key('shim_angle', angle, longest_list, 'rad', 'middle of each shim '// &
                            'under the foil', any_value, .false., 'no shims')
    here = keys%key%given
    right = here .and. keys%last_key_is_right()
    call one_list('shim_height', height, 'm', 'height of the plateau of each shim, or '// &
                  'of all', any_value)
    highest = 0.0_wp
    if (keys%last_key_is_right()) highest = maxval(height)
    call one_list('shim_arc', arc, 'rad', 'whole arc of the plateau of each shim, or of all', &
                  not_negative)
    call one_list('shim_ramp', ramp, 'rad', 'arc of the ramp on each side of the plateau of '// &
                  'each shim, or of all', positive)
    if (.not. right) return
    if (any(0.5_wp*arc + ramp > 0.5_wp*turn)) then
      call keys%complain(bore_group, 'shim_arc', 'with both ramps must be a whole turn at most')
      return
    end if
    profile%shim_angle = angle
    profile%shim_height = height
    profile%shim_arc = arc
    profile%shim_ramp = ramp
    call warn_of_overlaps(keys, angle, 0.5_wp*arc + ramp)

  contains

    !> One of the lists beside the angles.
    subroutine one_list(name, list, unit, meaning, rule)
      character(len=*), intent(in) :: name, unit, meaning
      real(wp), allocatable, intent(out) :: list(:)
      type(rule_type), intent(in) :: rule

      call keys%real_list_key(name, list, longest_list, unit, meaning, rule, here, &
                              'required with shim_angle')
      if (.not. here) then
        if (keys%key%given) call keys%complain(bore_group, name, 'needs shim_angle')
      else if (.not. keys%last_key_is_right()) then
        right = .false.
      else if (size(list) == 1) then
        list = spread(list(1), 1, size(angle))
      else if (size(list) /= size(angle)) then
        call keys%complain(bore_group, name, 'must have one value, or one a shim: '// &
                           text(size(angle))//', not '//text(size(list)))
        right = .false.
      end if
    end subroutine one_list
  end subroutine read_shims

  !> Warns of shims that overlap, as their heights add.
  subroutine warn_of_overlaps(keys, angle, reach)
    type(case_keys_type), intent(inout) :: keys
    real(wp), intent(in) :: angle(:) !! of their middles [rad]
    real(wp), intent(in) :: reach(:) !! from there to their ends [rad]
    real(wp) :: apart
    integer :: i, k

    do i = 2, size(angle)
      do k = 1, i - 1
        apart = modulo(angle(i) - angle(k), turn)
        apart = min(apart, turn - apart)
        if (apart > reach(i) + reach(k) - rounding) cycle
        call keys%warn(bore_group, 'shim_angle', 'shims '//text(k)//' and '//text(i)// &
                       ' overlap, ramps included: their heights add', i)
        exit
      end do
    end do
  end subroutine warn_of_overlaps

  !> A measured bore, or wear.
  subroutine read_table(keys, profile)
    type(case_keys_type), intent(inout) :: keys
    type(bore_profile_type), intent(inout) :: profile
    real(wp), allocatable :: angle(:), height(:)
    logical :: here, right
    integer :: i

    call keys%real_list_key('profile_angle', angle, longest_list, 'rad', 'angles of a measured '// &
                            'bore, rising', from_below(0.0_wp, turn), .false., 'no profile')
    here = keys%key%given
    right = here .and. keys%last_key_is_right()
    if (right .and. size(angle) < 2) then
      call keys%complain(bore_group, 'profile_angle', 'needs two values at least')
      right = .false.
    end if
    do i = 2, size(angle)
      if (.not. right) exit
      if (angle(i) > angle(i - 1)) cycle
      call keys%complain(bore_group, 'profile_angle', 'must be greater than the value before it', i)
      right = .false.
    end do
    call keys%real_list_key('profile_height', height, longest_list, 'm', 'height of the bore '// &
                            'over the circle there, or of a thrust bearing over the plane of '// &
                            'its pads, linear between the angles and around', &
                            any_value, here, 'required with profile_angle')
    if (keys%key%given .and. .not. here) then
      call keys%complain(bore_group, 'profile_height', 'needs profile_angle')
    else if (keys%key%given .and. size(height) /= size(angle)) then
      call keys%complain(bore_group, 'profile_height', 'must have one value an angle: '// &
                         text(size(angle))//', not '//text(size(height)))
      right = .false.
    end if
    if (.not. (right .and. keys%key%given)) return
    profile%table_angle = angle
    profile%table_height = height
  end subroutine read_table

  !> The key that has most to do with the height.
  pure function highest_key(profile) result(key)
    type(bore_profile_type), intent(in) :: profile
    character(len=:), allocatable :: key
    real(wp) :: height

    key = 'wave_amplitude'
    height = profile%wave_amplitude
    if (allocated(profile%shim_height)) then
      if (maxval(profile%shim_height) > height) key = 'shim_height'
      height = max(height, maxval(profile%shim_height))
    end if
    if (allocated(profile%table_height)) then
      if (maxval(profile%table_height) > height) key = 'profile_height'
    end if
  end function highest_key
end module gfb_bearing_case
