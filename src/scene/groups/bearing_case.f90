!> `&bearing` and `&pads`: the pad, or several equal ones with their preload.
module gfb_bearing_case
  use gfb_kinds, only: wp, most_pads
  use gfb_units, only: turn
  use gfb_case_keys, only: case_keys_type, no_default, at_least, from_below, from_to, positive
  use gfb_text, only: text
  implicit none (type, external)
  private
  public :: bearing_case_type, read_bearing_case, pad_angle, pad_length, pad_turn, preload_angle, &
            read_pads_case

  integer, parameter, public :: leading_edge_slit = 1     !! ambient pressure at both ends
  integer, parameter, public :: leading_edge_periodic = 2 !! a full ring without ends

  character(len=*), parameter :: edge_words(*) = [character(len=8) :: 'slit', 'periodic']
  character(len=*), parameter :: group = 'pads'
  real(wp), parameter :: rounding = 1.0e-9_wp !! of angles that are meant to be equal [rad]

  !> The pad.
  type :: bearing_case_type
    real(wp) :: radius = 0.0_wp              !! of the shaft [m]
    real(wp) :: length = 0.0_wp              !! along the axis [m]
    real(wp) :: clearance = 0.0_wp           !! radial [m]
    real(wp) :: interference = 0.0_wp        !! of assembly, off the gap all around [m]
    real(wp) :: leading_edge_angle = 0.0_wp  !! where the first pad begins [rad]
    integer :: leading_edge_condition = leading_edge_slit
    integer :: pads = 1                      !! equal ones, equally spaced
    real(wp) :: arc = 0.0_wp                 !! of one of them; 0: it ends at 2 pi [rad]
    real(wp) :: preload = 0.0_wp             !! shift of its centre over the clearance [1]
    real(wp) :: preload_offset = 0.5_wp      !! where on it: part of the arc [1]
  end type bearing_case_type

contains

  !> Reads `&bearing`.
  subroutine read_bearing_case(keys, bearing, needed, with_film, misplaced)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(bearing_case_type), intent(out) :: bearing !! what `&bearing` asks for
    logical, intent(in) :: needed             !! the scene has a pad
    logical, intent(in) :: with_film          !! and a film between it and a shaft
    character(len=*), intent(in) :: misplaced !! why the group does not fit; empty where it does

    call keys%start_group('bearing', required=needed, optional=.not. needed, &
                          misplaced=misplaced)
    call keys%real_key('radius', bearing%radius, 'm', 'radius of the shaft', positive, needed)
    call keys%real_key('length', bearing%length, 'm', 'length along the axis', positive, needed)
    call keys%real_key('clearance', bearing%clearance, 'm', &
                       'radial clearance, shaft to top foil at rest', positive, with_film, &
                       default=merge('    ', no_default, with_film))
    call keys%real_key('leading_edge_angle', bearing%leading_edge_angle, 'rad', &
                       'where the pad begins; it ends at 2 pi', from_below(0.0_wp, turn))
    call keys%choice_key('leading_edge_condition', bearing%leading_edge_condition, edge_words, &
                         'ambient pressure at both ends of the pad, or a full ring')
    call keys%real_key('assembly_interference', bearing%interference, 'm', 'taken off the gap '// &
                       'all around; more than `clearance` presses the foil back at rest', &
                       at_least(0.0_wp))
    call keys%rule('bearing', 'leading_edge_angle', &
                   bearing%leading_edge_condition == leading_edge_periodic .and. &
                   bearing%leading_edge_angle > 0.0_wp, 'must be 0 with leading_edge_condition '// &
                   "= 'periodic', a full ring")
  end subroutine read_bearing_case

  !> Angle that the pad covers [rad].
  elemental function pad_angle(bearing) result(angle)
    type(bearing_case_type), intent(in) :: bearing !! what `&bearing` asks for
    real(wp) :: angle
    angle = turn - bearing%leading_edge_angle
    if (bearing%arc > 0.0_wp) angle = bearing%arc
  end function pad_angle

  !> Angle from the first pad to another [rad].
  elemental function pad_turn(bearing, pad) result(angle)
    type(bearing_case_type), intent(in) :: bearing !! what `&bearing` asks for
    integer, intent(in) :: pad !! its number, from 1
    real(wp) :: angle
    angle = turn*real(pad - 1, wp)/real(bearing%pads, wp)
  end function pad_turn

  !> Where the preload narrows the gap of a pad most, theta_p [rad].
  elemental function preload_angle(bearing, pad) result(angle)
    type(bearing_case_type), intent(in) :: bearing !! what `&bearing` asks for
    integer, intent(in) :: pad !! its number, from 1
    real(wp) :: angle
    angle = bearing%leading_edge_angle + pad_turn(bearing, pad) &
            + bearing%preload_offset*pad_angle(bearing)
  end function preload_angle

  !> Length of the unrolled pad [m].
  elemental function pad_length(bearing) result(length)
    type(bearing_case_type), intent(in) :: bearing !! what `&bearing` asks for
    real(wp) :: length
    length = bearing%radius*pad_angle(bearing)
  end function pad_length

  !> Reads `&pads` into the bearing; without it the bearing has the one pad of `&bearing`.
  subroutine read_pads_case(keys, bearing, misplaced)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(bearing_case_type), intent(inout) :: bearing !! what `&bearing` asks for; gets the pads
    character(len=*), intent(in) :: misplaced !! why the group does not fit; empty where it does
    real(wp) :: first, gap

    first = bearing%leading_edge_angle
    gap = 0.0_wp
    call keys%start_group(group, optional=.true., misplaced=misplaced)
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
                       'towards the shaft, over the clearance', from_below(0.0_wp, 1.0_wp))
    call keys%real_key('preload_offset', bearing%preload_offset, '1', 'where on the pad the '// &
                       'preload narrows the gap most: part of the arc from the leading edge', &
                       from_to(0.0_wp, 1.0_wp))
    call check_edges(keys, bearing, first)
    call check_arc(keys, bearing, gap)
    bearing%leading_edge_angle = first
    if (keys%meant(group, 'arc')) return
    if (bearing%pads > 1 .or. keys%meant(group, 'gap')) then
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
    call keys%rule(group, 'first_leading_edge', keys%meant('bearing', 'leading_edge_angle') .and. &
                   keys%meant(group, 'first_leading_edge') .and. &
                   abs(first - bearing%leading_edge_angle) > rounding, 'contradicts '// &
                   'leading_edge_angle in &bearing, '//text(bearing%leading_edge_angle)// &
                   ' rad: give one of them')
    call keys%refuse(group, 'arc, gap, first_leading_edge', periodic, ring)
    call keys%refuse(group, 'count', periodic .and. bearing%pads > 1, ring)
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
    if (keys%meant(group, 'arc') .and. bearing%arc > share + rounding) then
      call keys%complain(group, 'arc', 'must not be longer than '//room//': the pads overlap')
    else if (keys%meant(group, 'arc') .and. keys%meant(group, 'gap')) then
      call keys%rule(group, 'gap', abs(bearing%arc + gap - share) > rounding, &
                     'contradicts arc: together they must be '//room//'; give one of them')
    else if (gap >= share) then
      call keys%complain(group, 'gap', 'must be smaller than '//room//': it leaves no pad')
    end if
  end subroutine check_arc
end module gfb_bearing_case
