!> `&operation`: speed, load and position of the shaft.
module gfb_operation_case
  use gfb_kinds, only: wp, most_pads
  use gfb_units, only: rpm
  use gfb_bearing_case, only: bearing_case_type
  use gfb_case_keys, only: case_keys_type, no_default, any_value, positive, unless
  use gfb_text, only: text
  use gfb_analysis_row, only: analysis_row_type
  use gfb_key_effect, only: acts_on_point, acts_on_speed, acts_on_load, acts_on_axial_load, &
                            acts_on_axial_gap
  implicit none (type, external)
  private
  public :: operation_case_type, read_operation_case, angular_speed, size_of_gap

  character(len=*), parameter, public :: other_sense = &
    'must not be negative: the shaft turns in +theta. For the other sense mirror the scene: '// &
    'change the signs of y in load and eccentricity and of the tilt about x, and swap leading '// &
    'and trailing edges'

  !> Operating point.
  type :: operation_case_type
    real(wp) :: speed_rpm = 0.0_wp        !! of the shaft [rpm]
    real(wp) :: load(2) = 0.0_wp          !! external force on the shaft, x and y [N]
    real(wp) :: eccentricity(2) = 0.0_wp  !! of the sleeve relative to the shaft, x and y [m]
    real(wp) :: tilt(2) = 0.0_wp          !! of the sleeve against the shaft, about x and y [rad]
    real(wp) :: axial_load = 0.0_wp       !! that presses runner on pads, shaft into cone [N]
    real(wp) :: axial_eccentricity = 0.0_wp !! of a cone's sleeve relative to the shaft [m]
    real(wp) :: axial_gap = 0.0_wp        !! from their land to the runner, on the axis [m]
    real(wp) :: moment(2) = 0.0_wp        !! external, on the shaft of a thrust bearing [N m]
    real(wp), allocatable :: leading_edge_lift(:) !! of each pad or all, to start with, z = 0 [m]
    real(wp), allocatable :: leading_edge_lift_edge(:) !! the same at the ends [m]
    logical :: load_given = .false.
    logical :: eccentricity_given = .false.
    logical :: axial_gap_given = .false.
    logical :: moment_given = .false. !! the tilts are unknown
    logical :: tilt_is_sought = .false. !! a tilt is looked for, beginning with `tilt`
  contains
    procedure :: asks_for_lift
  end type operation_case_type

contains

  !> Whether the file asks for lifts of free edges.
  pure logical function asks_for_lift(self) result(asks)
    class(operation_case_type), intent(in) :: self !! what `&operation` asks for

    asks = .false.
    if (allocated(self%leading_edge_lift)) asks = size(self%leading_edge_lift) > 0
    if (asks .or. .not. allocated(self%leading_edge_lift_edge)) return
    asks = size(self%leading_edge_lift_edge) > 0
  end function asks_for_lift

  !> Reads the group; what it must hold depends on the analysis.
  subroutine read_operation_case(keys, operation, bearing, analysis, may_rest)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(operation_case_type), intent(out) :: operation !! what `&operation` asks for
    type(bearing_case_type), intent(in) :: bearing !! what `&bearing` asks for
    type(analysis_row_type), intent(in) :: analysis !! of the state
    logical, intent(in) :: may_rest  !! something else than the film bears the shaft, too
    character(len=:), allocatable :: journal, thrust !! why keys of the kind have no use

    journal = trim(bearing%row%journal_keys)
    thrust = trim(bearing%row%thrust_keys)
    call keys%start_group('operation', required=analysis%has_film, &
                          optional=analysis%is_structure(), &
                          misplaced=analysis%refusal('operation'), acts_on=acts_on_point)
    call keys%real_key('speed_rpm', operation%speed_rpm, 'rpm', 'speed of the shaft', &
                       any_value, analysis%has_film, acts_on=acts_on_speed)
    if (operation%speed_rpm < 0.0_wp) call keys%complain('operation', 'speed_rpm', other_sense)
    call keys%rule('operation', 'speed_rpm', analysis%floats .and. &
                   keys%last_key_is_right() .and. .not. (operation%speed_rpm > 0.0_wp .or. &
                   may_rest), 'must be positive: a film without speed carries no load; '// &
                   '&shaft_contact does, or &feed')
    call keys%real_vector_key('load', operation%load, 'N', 'external force on the shaft, x and y', &
                              required=analysis%floats .and. bearing%row%moves_across, &
                              default='required for an equilibrium', given=operation%load_given, &
                              useless=journal)
    call keys%act_on('load', acts_on_load)
    call keys%real_vector_key('eccentricity', operation%eccentricity, 'm', &
                              'position of the sleeve relative to the shaft, x and y: fixed, '// &
                              'or where the search for an equilibrium starts', &
                              required=analysis%holds .and. bearing%row%moves_across, &
                              default='required for a fixed position', &
                              given=operation%eccentricity_given, useless=journal)
    call keys%idle(unless(analysis%holds, 'the search for the equilibrium starts there'))
    call keys%real_key('axial_eccentricity', operation%axial_eccentricity, 'm', 'position of '// &
                       'the sleeve of a cone relative to the shaft, z, which narrows the gap: '// &
                       'fixed, or where the search for an equilibrium starts', any_value, &
                       useless=trim(bearing%row%cone_keys))
    call keys%idle(unless(.not. analysis%holds, 'the gap is given'))
    call keys%real_key('axial_load', operation%axial_load, 'N', 'force that presses the runner '// &
                       'of a thrust bearing on its pads, or the shaft into its cone, along -z', &
                       merge(any_value, positive, bearing%play > 0.0_wp), &
                       bearing%row%moves_along .and. analysis%floats, default=no_default, &
                       useless=trim(bearing%row%axial_keys), acts_on=acts_on_axial_load)
    call keys%idle(unless(analysis%holds, 'the search for the equilibrium starts there'))
    call keys%real_key('axial_gap', operation%axial_gap, 'm', 'gap from the land of its pads '// &
                       'to its runner, on the axis, foils at rest: held, or where the search '// &
                       'for an equilibrium starts', positive, &
                       bearing%row%has_sectors .and. analysis%holds, default=no_default, &
                       given=operation%axial_gap_given, useless=thrust, acts_on=acts_on_axial_gap)
    call keys%rule('operation', 'axial_gap', bearing%play > 0.0_wp .and. &
                   operation%axial_gap >= bearing%play, 'must be less than axial_play in '// &
                   '&bearing, '//text(bearing%play)//' m')
    call keys%real_vector_key('moment', operation%moment, 'N m', 'external moment on the shaft '// &
                              'of a thrust bearing, about x and y; with it the tilt is found, '// &
                              'and `tilt` is where the search starts', any_value, .false., &
                              default=no_default, given=operation%moment_given, useless=thrust)
    call keys%rule('operation', 'moment', operation%moment_given .and. &
                   analysis%holds, 'needs axial_load: at a held gap the '// &
                   'tilt is held, too')
    call keys%real_vector_key('tilt', operation%tilt, 'rad', &
                              'rotation of the sleeve relative to the shaft, about x and y')
    call keys%idle('it chooses the first answer, the others follow that')
    call keys%real_list_key('leading_edge_lift', operation%leading_edge_lift, most_pads, 'm', &
                            'look for the equilibrium whose top foil''s free leading edge is '// &
                            'lifted this far towards the shaft at the midplane, or, negative, '// &
                            'away from it; of several pads each one''s, or one value for all', &
                            any_value, required=.false., default=no_default, useless=journal)
    call keys%real_list_key('leading_edge_lift_edge', operation%leading_edge_lift_edge, most_pads, &
                            'm', 'the same at the ends of the bearing', any_value, &
                            required=.false., default=no_default, useless=journal)
  end subroutine read_operation_case

  !> Size of a thrust bearing's gap: that asked for, or half of its ramp, or that of a bearing
  !> number 6 mu Omega/p_a (R/h)^2 of 10 where it has none.
  pure real(wp) function size_of_gap(bearing, operation, viscosity, ambient_pressure) result(gap)
    type(bearing_case_type), intent(in) :: bearing !! what `&bearing` and `&ramp` ask for
    type(operation_case_type), intent(in) :: operation !! what `&operation` asks for
    real(wp), intent(in) :: viscosity, ambient_pressure !! of the gas [Pa s], [Pa]
    real(wp), parameter :: usual_number = 10.0_wp

    gap = max(operation%axial_gap, 0.5_wp*bearing%ramp_height)
    if (gap > 0.0_wp .or. .not. ambient_pressure > 0.0_wp) return
    gap = bearing%radius*sqrt(6.0_wp*viscosity*angular_speed(operation%speed_rpm)/ &
                              (usual_number*ambient_pressure))
  end function size_of_gap

  !> Angular speed [rad/s].
  elemental real(wp) function angular_speed(speed_rpm) result(speed)
    real(wp), intent(in) :: speed_rpm !! [rpm]
    speed = speed_rpm*rpm
  end function angular_speed
end module gfb_operation_case
