!> What foils are where something moves, in each group that has keys of it: their mass, and a damper
!> and a Maxwell arm beside the springs of an elastic foundation.
module gfb_foil_motion_keys
  use gfb_kinds, only: wp
  use gfb_case_keys, only: case_keys_type, no_default
  use gfb_maxwell_arm, only: maxwell_arm_type
  use gfb_value_rules, only: positive, not_negative
  implicit none (type, external)
  private
  public :: read_damping_keys

  integer, parameter, public :: mass_auto = 1 !! the foil has its mass where it counts
  integer, parameter, public :: mass_on = 2   !! it has it
  integer, parameter, public :: mass_off = 3  !! it has none
  character(len=*), parameter, public :: mass_words(*) = [character(len=4) :: 'auto', 'on', 'off']
  real(wp), parameter, public :: most_foil_modes = 1000.0_wp !! in a piece
  character(len=*), parameter, public :: foil_modes_words = &
    'fixed-interface modes kept inside each condensed piece of the bumps that has its mass'

contains

  !> Reads the damper and the Maxwell arm of an elastic foundation.
  subroutine read_damping_keys(keys, damping, arm)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file, in the group
    real(wp), intent(inout) :: damping !! of a damper beside each spring [N s/m^3]
    type(maxwell_arm_type), intent(inout) :: arm !! a spring and a dashpot in series beside it

    call keys%real_key('foundation_damping', damping, 'N s/m^3', 'viscous damping of the '// &
                       'elastic foundation, pressure over velocity', not_negative)
    call keys%real_key('maxwell_stiffness', arm%stiffness, 'N/m^3', 'spring of the Maxwell '// &
                       'arm, a spring and a dashpot in series beside each spring of the '// &
                       'elastic foundation', positive, default=no_default)
    call keys%real_key('maxwell_time', arm%time, 's', 'relaxation time of that arm: its '// &
                       'dashpot over its spring', positive, default=no_default)
  end subroutine read_damping_keys
end module gfb_foil_motion_keys
