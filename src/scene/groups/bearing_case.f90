!> `&bearing`: the pad, or several equal ones.
module gfb_bearing_case
  use gfb_kinds, only: wp
  use gfb_case_keys, only: case_keys_type, no_default
  use gfb_value_rules, only: at_least, positive, from_below
  implicit none (type, external)
  private
  public :: bearing_case_type, read_bearing_case, pad_angle, pad_length
  public :: pad_turn, preload_angle

  integer, parameter, public :: leading_edge_slit = 1     !! ambient pressure at both ends
  integer, parameter, public :: leading_edge_periodic = 2 !! a full ring without ends

  character(len=*), parameter :: edge_words(*) = [character(len=8) :: 'slit', 'periodic']
  real(wp), parameter, public :: full_turn = 2.0_wp*acos(-1.0_wp) !! [rad]

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

  !> Reads the group.
  subroutine read_bearing_case(keys, bearing, needed, with_film, misplaced)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(bearing_case_type), intent(out) :: bearing !! what `&bearing` asks for
    logical, intent(in) :: needed             !! the scene has a pad
    logical, intent(in) :: with_film          !! and a film between it and a shaft
    character(len=*), intent(in) :: misplaced !! why the group does not fit; empty where it does

    call keys%start_group('bearing', required=needed, optional=.not. needed, misplaced=misplaced)
    call keys%real_key('radius', bearing%radius, 'm', 'radius of the shaft', positive, needed)
    call keys%real_key('length', bearing%length, 'm', 'length along the axis', positive, needed)
    call keys%real_key('clearance', bearing%clearance, 'm', &
                       'radial clearance, shaft to top foil at rest', positive, with_film, &
                       default=merge('    ', no_default, with_film))
    call keys%real_key('leading_edge_angle', bearing%leading_edge_angle, 'rad', &
                       'where the pad begins; it ends at 2 pi', from_below(0.0_wp, full_turn))
    call keys%choice_key('leading_edge_condition', bearing%leading_edge_condition, edge_words, &
                         'ambient pressure at both ends of the pad, or a full ring')
    call keys%real_key('assembly_interference', bearing%interference, 'm', 'taken off the gap '// &
                       'all around; more than `clearance` presses the foil back at rest', &
                       at_least(0.0_wp))
    if (bearing%leading_edge_condition == leading_edge_periodic .and. &
        bearing%leading_edge_angle > 0.0_wp) then
      call keys%complain('bearing', 'leading_edge_angle', &
                         "must be 0 with leading_edge_condition = 'periodic', a full ring")
    end if
    call keys%finish_group()
  end subroutine read_bearing_case

  !> Angle that the pad covers [rad].
  elemental function pad_angle(bearing) result(angle)
    type(bearing_case_type), intent(in) :: bearing !! what `&bearing` asks for
    real(wp) :: angle
    angle = full_turn - bearing%leading_edge_angle
    if (bearing%arc > 0.0_wp) angle = bearing%arc
  end function pad_angle

  !> Angle from the first pad to another [rad].
  elemental function pad_turn(bearing, pad) result(angle)
    type(bearing_case_type), intent(in) :: bearing !! what `&bearing` asks for
    integer, intent(in) :: pad !! its number, from 1
    real(wp) :: angle
    angle = full_turn*real(pad - 1, wp)/real(bearing%pads, wp)
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
end module gfb_bearing_case
