!> `&periodic`: orbits of the shaft that close after a period, and what a scene must have, and cannot
!> have, where they are looked for.
module gfb_periodic_case
  use gfb_kinds, only: wp
  use gfb_case_keys, only: case_keys_type, no_default
  use gfb_foil_motion_keys, only: read_maxwell_keys, check_maxwell_keys
  use gfb_maxwell_arm, only: maxwell_arm_type
  use gfb_model_case, only: model_case_type, coupling_partitioned, foil_elastic_foundation, &
                            meshes_foils
  use gfb_operation_case, only: operation_case_type
  use gfb_rotor_case, only: rotor_case_type
  use gfb_scene_case, only: analysis_periodic, misplaced_group
  use gfb_value_rules, only: any_value, positive, not_negative, at_least, between, from_to
  implicit none (type, external)
  private
  public :: periodic_case_type, read_periodic_case, check_periodic

  character(len=*), parameter :: group = 'periodic'
  character(len=*), parameter :: useless = "has no use with analysis = 'periodic'"

  integer, parameter, public :: motion_forced = 1 !! with the turns of the shaft
  integer, parameter, public :: motion_free = 2   !! by itself: a limit cycle
  character(len=*), parameter :: motion_words(*) = [character(len=6) :: 'forced', 'free']
  integer, parameter, public :: follow_nothing = 1, follow_speed = 2, follow_unbalance = 3, &
    follow_mass = 4
  character(len=*), parameter :: parameter_words(*) = [character(len=9) :: 'none', 'speed_rpm', &
    'unbalance', 'mass']

  !> What is asked for.
  type :: periodic_case_type
    logical :: present = .false.            !! the analysis is 'periodic'
    integer :: motion = motion_forced
    integer :: parameter = follow_nothing   !! over which the orbits are followed
    real(wp) :: final_value = 0.0_wp        !! up or down to this one [rpm], [kg m], [kg]
    integer :: points = 40                  !! of the branch, at most
    real(wp) :: step = 0.25_wp              !! from point to point, at most [1]
    real(wp) :: first_amplitude = 0.03_wp   !! of a limit cycle, over the clearance [1]
    integer :: steps_per_turn = 100
    integer :: period_turns = 1             !! of a forced motion
    integer :: start_turns = 2              !! marched before the first orbit is looked for
    real(wp) :: unbalance = 0.0_wp          !! [kg m]
    real(wp) :: unbalance_angle = 0.0_wp    !! [rad]
    real(wp) :: foundation_damping = 0.0_wp !! [N s/m^3]
    type(maxwell_arm_type) :: arm           !! beside the springs of an elastic foundation
  end type periodic_case_type

contains

  !> Reads the group.
  subroutine read_periodic_case(keys, periodic, analysis)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(periodic_case_type), intent(out) :: periodic !! what `&periodic` asks for
    integer, intent(in) :: analysis !! of the case file, 0 where it is not known
    real(wp), parameter :: fewest_steps = 20.0_wp !! of a turn [1]
    real(wp), parameter :: most_points = 1.0e6_wp

    periodic%present = analysis == analysis_periodic
    call keys%start_group('periodic', required=periodic%present, optional=.not. periodic%present, &
                          misplaced=misplaced_group(analysis, periodic%present))
    call keys%choice_key('motion', periodic%motion, motion_words, &
                         'with the turns of the shaft, by its unbalance; or by itself: a '// &
                         'limit cycle, from the onset of whirl on')
    call keys%choice_key('parameter', periodic%parameter, parameter_words, &
                         'over what the orbits are followed, through folds: from its value in '// &
                         '&operation, &periodic or &rotor to `final_value`')
    call keys%real_key('final_value', periodic%final_value, 'of the parameter', &
                       'value of the parameter at which the branch ends', not_negative, &
                       default=no_default)
    call keys%integer_key('points', periodic%points, 'orbits of the branch, at most', &
                          from_to(1.0_wp, most_points))
    call keys%real_key('step', periodic%step, '1', &
                       'longest step along the branch: in the shaft''s place over the '// &
                       'clearance '// &
                       'and the parameter over its way', positive)
    call keys%real_key('first_amplitude', periodic%first_amplitude, '1', &
                       'of the first limit cycle after the onset, over the clearance', &
                       between(0.0_wp, 1.0_wp))
    call keys%integer_key('steps_per_turn', periodic%steps_per_turn, &
                          'equal steps of time in a turn of the shaft', at_least(fewest_steps))
    call keys%integer_key('period_turns', periodic%period_turns, &
                          'turns in the period of a forced motion', positive)
    call keys%integer_key('start_turns', periodic%start_turns, &
                          'periods of a forced motion that are marched from rest before the '// &
                          'first orbit is looked for', at_least(0.0_wp))
    call keys%real_key('unbalance', periodic%unbalance, 'kg m', &
                       'unbalance that this bearing carries: mass times its distance from '// &
                       'the axis', not_negative)
    call keys%real_key('unbalance_angle', periodic%unbalance_angle, 'rad', &
                       'direction of the unbalance where a period begins, from x towards y', &
                       any_value)
    call keys%real_key('foundation_damping', periodic%foundation_damping, 'N s/m^3', &
                       'viscous damping of the elastic foundation, pressure over velocity', &
                       not_negative)
    call read_maxwell_keys(keys, periodic%arm)
    call keys%finish_group()
  end subroutine read_periodic_case

  !> Checks a scene with `&periodic`.
  subroutine check_periodic(keys, periodic, operation, rotor, model, may_rub)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(periodic_case_type), intent(in) :: periodic !! what `&periodic` asks for
    type(operation_case_type), intent(in) :: operation !! what `&operation` asks for
    type(rotor_case_type), intent(in) :: rotor !! what `&rotor` says
    type(model_case_type), intent(in) :: model !! what `&model` asks for
    logical, intent(in) :: may_rub !! a friction coefficient of `&contact` is positive

    if (.not. periodic%present) return
    if (keys%meant('operation', 'speed_rpm') .and. .not. operation%speed_rpm > 0.0_wp) then
      call keys%complain('operation', 'speed_rpm', "must be positive with analysis = 'periodic'")
    end if
    if (.not. rotor%present) then
      call keys%complain('scene', 'analysis', "'periodic' needs the mass of the shaft, in &rotor")
    else if (keys%meant('rotor', 'bearing_distance')) then
      call keys%complain('rotor', 'bearing_distance', useless//': the shaft moves in x and y alone')
    end if
    call check_motion(keys, periodic)
    call check_branch(keys, periodic, operation, rotor)
    call check_foil(keys, periodic, model, may_rub)
    call check_other_groups(keys)
  end subroutine check_periodic

  !> A forced motion has its unbalance, a free one none.
  subroutine check_motion(keys, periodic)
    type(case_keys_type), intent(inout) :: keys
    type(periodic_case_type), intent(in) :: periodic

    if (periodic%motion == motion_free) then
      call refuse(keys, 'unbalance', "has no use with motion = 'free'")
      call refuse(keys, 'unbalance_angle', "has no use with motion = 'free'")
      call refuse(keys, 'period_turns', "has no use with motion = 'free'")
      call refuse(keys, 'start_turns', "has no use with motion = 'free'")
      if (periodic%parameter /= 0 .and. all(periodic%parameter /= [follow_speed, follow_mass])) then
        call keys%complain(group, 'parameter', "must be 'speed_rpm' or 'mass' with "// &
                           "motion = 'free': the limit cycles are followed from the onset "// &
                           'of whirl on')
      end if
    else
      call refuse(keys, 'first_amplitude', "needs motion = 'free'")
      if (.not. keys%meant(group, 'unbalance') .and. periodic%parameter /= follow_unbalance) then
        call keys%complain(group, 'unbalance', "must be given with motion = 'forced'")
      end if
    end if
  end subroutine check_motion

  !> A branch has an end, which is not its beginning.
  subroutine check_branch(keys, periodic, operation, rotor)
    type(case_keys_type), intent(inout) :: keys
    type(periodic_case_type), intent(in) :: periodic
    type(operation_case_type), intent(in) :: operation
    type(rotor_case_type), intent(in) :: rotor
    real(wp) :: begin

    if (periodic%parameter == follow_nothing) then
      call refuse(keys, 'final_value', "needs a parameter other than 'none'")
      call refuse(keys, 'points', "needs a parameter other than 'none'")
      call refuse(keys, 'step', "needs a parameter other than 'none'")
      return
    end if
    if (.not. keys%meant(group, 'final_value')) then
      call keys%complain(group, 'final_value', 'must be given with parameter')
      return
    end if
    begin = operation%speed_rpm
    if (periodic%parameter == follow_unbalance) begin = periodic%unbalance
    if (periodic%parameter == follow_mass) begin = rotor%mass
    if (.not. abs(periodic%final_value - begin) > 0.0_wp) then
      call keys%complain(group, 'final_value', 'must differ from where the parameter begins')
    else if (periodic%parameter /= follow_unbalance .and. .not. periodic%final_value > 0.0_wp) then
      call keys%complain(group, 'final_value', 'must be positive')
    end if
  end subroutine check_branch

  !> What the foil must be.
  subroutine check_foil(keys, periodic, model, may_rub)
    type(case_keys_type), intent(inout) :: keys
    type(periodic_case_type), intent(in) :: periodic
    type(model_case_type), intent(in) :: model
    logical, intent(in) :: may_rub

    if (periodic%foundation_damping > 0.0_wp .and. model%foil /= foil_elastic_foundation) then
      call keys%complain(group, 'foundation_damping', "needs foil = 'elastic_foundation' in &model")
    end if
    call check_maxwell_keys(keys, group, any(model%foil == [0, foil_elastic_foundation]))
    if (meshes_foils(model%foil) .and. may_rub .and. &
        (periodic%motion == motion_free .or. periodic%parameter /= follow_nothing)) then
      call keys%complain('model', 'foil', 'needs friction_top and friction_sleeve of 0 with '// &
                         "motion = 'free', and with parameter: where contacts stick, orbits "// &
                         'lie side by side, and are no branch')
    end if
    if (model%coupling == coupling_partitioned) then
      call keys%complain('model', 'coupling', "must be 'monolithic' with analysis = "// &
                         "'periodic': film, foil and shaft take their steps together")
    end if
  end subroutine check_foil

  !> What cannot stand beside `&periodic`.
  subroutine check_other_groups(keys)
    type(case_keys_type), intent(inout) :: keys

    if (keys%meant('sweep', 'parameter')) then
      call keys%complain('sweep', 'parameter', &
        useless//': parameter in &periodic follows the orbits')
    end if
    if (keys%meant('accuracy', 'quantity')) call keys%complain('accuracy', 'quantity', useless)
    if (keys%meant('sample', 'count')) call keys%complain('sample', 'count', useless)
    if (keys%meant('sensitivity', 'quantity')) then
      call keys%complain('sensitivity', 'quantity', useless)
    end if
    if (keys%meant('output', 'restart_every')) then
      call keys%complain('output', 'restart_every', useless)
    end if
  end subroutine check_other_groups

  !> Complains about a key that is given.
  subroutine refuse(keys, name, words)
    type(case_keys_type), intent(inout) :: keys
    character(len=*), intent(in) :: name, words

    if (keys%meant(group, name)) call keys%complain(group, name, words)
  end subroutine refuse
end module gfb_periodic_case
