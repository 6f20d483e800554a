!> `&rotor`: the rigid rotor whose modes, or whose way over time, are asked for.
module gfb_rotor_case
  use gfb_kinds, only: wp
  use gfb_case_keys, only: case_keys_type, no_default
  use gfb_operation_case, only: operation_case_type
  use gfb_scene_case, only: analysis_linear_dynamics, analysis_transient, analysis_periodic, &
    misplaced_group
  use gfb_sweep_case, only: sweep_case_type, sweep_tilt_x, sweep_tilt_y
  use gfb_value_rules, only: positive, not_negative
  implicit none (type, external)
  private
  public :: rotor_case_type, read_rotor_case, check_rotor

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

contains

  !> Reads the group; without it no rotor is on the bearing.
  subroutine read_rotor_case(keys, rotor, analysis)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(rotor_case_type), intent(out) :: rotor !! what `&rotor` says
    integer, intent(in) :: analysis !! of the case file, 0 where it is not known

    call keys%start_group(group, optional=.true., present_in_file=rotor%present, &
                          misplaced=misplaced_group(analysis, any(analysis == &
                          [analysis_linear_dynamics, analysis_transient, analysis_periodic])))
    call keys%real_key(mass, rotor%mass, 'kg', &
                       'mass that this bearing carries: half of a rotor on two; the load is '// &
                       'given apart from it', positive, .true.)
    call keys%real_key(transverse, rotor%transverse_inertia, 'kg m^2', &
                       'moment of inertia of the whole rotor about an axis across it through '// &
                       'its centre of mass, which is halfway between two equal bearings', &
                       positive, default=no_default)
    call keys%real_key(polar, rotor%polar_inertia, 'kg m^2', &
                       'moment of inertia of the whole rotor about its own axis', not_negative)
    call keys%real_key(distance, rotor%bearing_distance, 'm', &
                       'distance of the two bearings, from midplane to midplane', positive, &
                       default=no_default)
    if (analysis == analysis_transient) rotor%distance_in_time = rotor%bearing_distance
    call keys%finish_group()
  end subroutine read_rotor_case

  !> What the keys, and the rest of the scene, ask of each other.
  subroutine check_rotor(keys, rotor, operation, sweep, whirls)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(rotor_case_type), intent(in) :: rotor !! what `&rotor` says
    type(operation_case_type), intent(in) :: operation !! what `&operation` asks for
    type(sweep_case_type), intent(in) :: sweep !! what `&sweep` asks for
    logical, intent(in) :: whirls !! its modes are asked for

    if (.not. rotor%present) return
    if (whirls .and. keys%meant('operation', 'speed_rpm') .and. &
        .not. operation%speed_rpm > 0.0_wp) then
      call keys%complain(group, mass, 'needs a shaft that turns: nothing whirls at rest')
    end if
    if (keys%meant(group, polar) .and. .not. keys%meant(group, transverse)) then
      call keys%complain(group, polar, 'has no use without transverse_inertia: a rotor that '// &
                         'does not tilt has no gyroscopic torque')
    end if
    if (keys%meant(group, transverse) .neqv. keys%meant(group, distance)) then
      if (keys%meant(group, transverse)) then
        call keys%complain(group, transverse, 'needs bearing_distance: a rotor tilts on two '// &
                           'bearings')
      else
        call keys%complain(group, distance, 'needs transverse_inertia: that of a rotor which '// &
                           'tilts on two bearings')
      end if
    end if
    if (keys%meant(group, transverse) .and. &
        rotor%polar_inertia > 2.0_wp*rotor%transverse_inertia) then
      call keys%complain(group, polar, 'must not be larger than twice transverse_inertia: no '// &
                         'body has more')
    end if
    if (keys%meant(group, distance)) call check_conical(keys, operation, sweep)
  end subroutine check_rotor

  !> Conical modes need bearings that mirror each other.
  subroutine check_conical(keys, operation, sweep)
    type(case_keys_type), intent(inout) :: keys
    type(operation_case_type), intent(in) :: operation
    type(sweep_case_type), intent(in) :: sweep

    if (any(abs(operation%tilt) > 0.0_wp) .or. sweep%parameter == sweep_tilt_x .or. &
        sweep%parameter == sweep_tilt_y) then
      call keys%complain(group, distance, 'needs an aligned shaft: with a tilt the two '// &
                         'bearings do not mirror each other')
    end if
  end subroutine check_conical
end module gfb_rotor_case
