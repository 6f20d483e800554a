!> `&rotor` and `&unbalance`: the rigid rotor whose modes, or whose path over time, are asked for.
module gfb_rotor_case
  use gfb_kinds, only: wp
  use gfb_case_keys, only: case_keys_type, no_default, unless, any_value, not_negative, positive
  use gfb_scene_case, only: analysis_linear_dynamics, analysis_transient, analysis_periodic, &
                            misplaced_group
  implicit none (type, external)
  private
  public :: rotor_case_type, read_rotor_case, unbalance_case_type, read_unbalance_case

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

  !> Its unbalance, of orbits and over time.
  type :: unbalance_case_type
    real(wp) :: static = 0.0_wp       !! that this bearing carries [kg m]
    real(wp) :: angle = 0.0_wp        !! of it at the beginning [rad]
    real(wp) :: couple = 0.0_wp       !! of a rotor that tilts [kg m^2]
    real(wp) :: couple_angle = 0.0_wp !! of that at +z at the beginning [rad]
  end type unbalance_case_type

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
  end subroutine read_rotor_case

  !> Reads `&unbalance`.
  subroutine read_unbalance_case(keys, unbalance, analysis)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(unbalance_case_type), intent(out) :: unbalance !! what `&unbalance` says
    integer, intent(in) :: analysis !! of the case file, 0 where it is not known
    character(len=:), allocatable :: no_couple
    logical :: drives

    drives = any(analysis == [analysis_transient, analysis_periodic])
    no_couple = unless(analysis /= analysis_periodic, "has no use with analysis = 'periodic': "// &
                       'the shaft moves in x and y alone')
    call keys%start_group('unbalance', optional=.not. drives, &
                          misplaced=misplaced_group(analysis, drives))
    call keys%real_key('unbalance', unbalance%static, 'kg m', &
                       'unbalance that this bearing carries: mass times its distance from '// &
                       'the axis', not_negative)
    call keys%real_key('unbalance_angle', unbalance%angle, 'rad', 'direction of the unbalance '// &
                       'at the beginning, of the time or of a period, from x towards y', any_value)
    call keys%real_key('couple_unbalance', unbalance%couple, 'kg m^2', &
                       'of a rotor that tilts on two bearings: an unbalance times its distance '// &
                       'along the axis from an equal and opposite one', not_negative, &
                       useless=no_couple)
    call keys%real_key('couple_unbalance_angle', unbalance%couple_angle, 'rad', &
                       'direction of the one at +z at the beginning, from x towards y', &
                       any_value, useless=no_couple)
  end subroutine read_unbalance_case
end module gfb_rotor_case
