!> `&periodic`: orbits of the shaft that close after a period.
module gfb_periodic_case
  use gfb_kinds, only: wp
  use gfb_case_keys, only: case_keys_type, no_default, at_least, between, from_to, not_negative, &
                           positive
  use gfb_scene_case, only: analysis_periodic, misplaced_group
  implicit none (type, external)
  private
  public :: periodic_case_type, read_periodic_case

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
                         '&operation, &unbalance or &rotor to `final_value`')
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
  end subroutine read_periodic_case
end module gfb_periodic_case
