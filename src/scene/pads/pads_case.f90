!> `&pads`: several equal pads, and their preload.
module gfb_pads_case
  use gfb_kinds, only: wp, most_pads
  use gfb_bearing_case, only: bearing_case_type, leading_edge_periodic, full_turn
  use gfb_case_keys, only: case_keys_type
  use gfb_text, only: text
  use gfb_value_rules, only: positive, from_to, from_below
  implicit none (type, external)
  private
  public :: read_pads_case

  character(len=*), parameter :: group = 'pads'
  real(wp), parameter :: rounding = 1.0e-9_wp !! of angles that are meant to be equal [rad]

contains

  !> Reads the group into the bearing; without it the bearing has the one pad of `&bearing`.
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
                       from_below(0.0_wp, full_turn), default='leading_edge_angle in &bearing')
    call keys%real_key('gap', gap, 'rad', 'angle between the trailing edge of a pad and the '// &
                       'leading edge of the next', from_below(0.0_wp, full_turn), &
                       default='2 pi/count less arc')
    call keys%real_key('preload', bearing%preload, '1', 'shift of a pad''s centre of curvature '// &
                       'towards the shaft, over the clearance', from_below(0.0_wp, 1.0_wp))
    call keys%real_key('preload_offset', bearing%preload_offset, '1', 'where on the pad the '// &
                       'preload narrows the gap most: part of the arc from the leading edge', &
                       from_to(0.0_wp, 1.0_wp))
    call check_edges(keys, bearing, first)
    call check_arc(keys, bearing, gap)
    call keys%finish_group()
    bearing%leading_edge_angle = first
    if (keys%meant(group, 'arc')) return
    if (bearing%pads > 1 .or. keys%meant(group, 'gap')) then
      bearing%arc = max(full_turn/bearing%pads - gap, rounding)
    end if
  end subroutine read_pads_case

  !> What the group says twice with `&bearing`, or against it.
  subroutine check_edges(keys, bearing, first)
    type(case_keys_type), intent(inout) :: keys
    type(bearing_case_type), intent(in) :: bearing
    real(wp), intent(in) :: first !! leading edge of pad 1 [rad]
    character(len=*), parameter :: ring = "needs leading_edge_condition = 'slit' in &bearing: "// &
                                          'a full ring has no edges'
    character(len=18) :: edge_key(4)
    integer :: i

    if (keys%meant('bearing', 'leading_edge_angle') .and. &
        keys%meant(group, 'first_leading_edge') .and. &
        abs(first - bearing%leading_edge_angle) > rounding) then
      call keys%complain(group, 'first_leading_edge', 'contradicts leading_edge_angle in '// &
                         '&bearing, '//text(bearing%leading_edge_angle)//' rad: give one of them')
    end if
    if (bearing%leading_edge_condition /= leading_edge_periodic) return
    edge_key = [character(len=18) :: 'count', 'arc', 'gap', 'first_leading_edge']
    do i = 1, size(edge_key)
      if (.not. keys%meant(group, trim(edge_key(i)))) cycle
      if (edge_key(i) == 'count' .and. bearing%pads == 1) cycle
      call keys%complain(group, trim(edge_key(i)), ring)
    end do
  end subroutine check_edges

  !> Whether the pads fit into the circle.
  subroutine check_arc(keys, bearing, gap)
    type(case_keys_type), intent(inout) :: keys
    type(bearing_case_type), intent(in) :: bearing
    real(wp), intent(in) :: gap !! between pads [rad]
    character(len=:), allocatable :: room
    real(wp) :: share

    share = full_turn/bearing%pads
    room = text(share, 7)//' rad, 2 pi over count'
    if (keys%meant(group, 'arc') .and. bearing%arc > share + rounding) then
      call keys%complain(group, 'arc', 'must not be longer than '//room//': the pads overlap')
    else if (keys%meant(group, 'arc') .and. keys%meant(group, 'gap')) then
      if (abs(bearing%arc + gap - share) > rounding) then
        call keys%complain(group, 'gap', 'contradicts arc: together they must be '//room// &
                           '; give one of them')
      end if
    else if (gap >= share) then
      call keys%complain(group, 'gap', 'must be smaller than '//room//': it leaves no pad')
    end if
  end subroutine check_arc
end module gfb_pads_case
