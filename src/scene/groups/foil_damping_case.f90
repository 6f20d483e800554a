!> `&foil_damping`: what foils are where something moves: a damper and a Maxwell arm beside the
!> springs of an elastic foundation, and the mass of foils that are meshed.
module gfb_foil_damping_case
  use gfb_kinds, only: wp
  use gfb_case_keys, only: case_keys_type, no_default, unless, from_to, not_negative, positive
  use gfb_maxwell_arm, only: maxwell_arm_type
  use gfb_scene_case, only: analysis_linear_dynamics, analysis_transient, analysis_periodic, &
                            misplaced_group
  implicit none (type, external)
  private
  public :: foil_damping_case_type, read_foil_damping_case

  integer, parameter, public :: mass_auto = 1 !! the foil has its mass where it counts
  integer, parameter, public :: mass_on = 2   !! it has it
  integer, parameter, public :: mass_off = 3  !! it has none
  character(len=*), parameter :: mass_words(*) = [character(len=4) :: 'auto', 'on', 'off']

  !> What is asked for.
  type :: foil_damping_case_type
    real(wp) :: foundation_damping = 0.0_wp !! of a damper beside each spring [N s/m^3]
    type(maxwell_arm_type) :: arm           !! a spring and a dashpot in series beside it
    integer :: foil_mass = mass_auto
    integer :: foil_modes = 2               !! kept inside each condensed bump
  end type foil_damping_case_type

contains

  !> Reads the group.
  subroutine read_foil_damping_case(keys, damping, analysis)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(foil_damping_case_type), intent(out) :: damping !! what `&foil_damping` asks for
    integer, intent(in) :: analysis !! of the case file, 0 where it is not known
    real(wp), parameter :: most_modes = 1000.0_wp !! in a piece
    character(len=:), allocatable :: massless
    logical :: moves

    moves = any(analysis == [analysis_linear_dynamics, analysis_transient, analysis_periodic])
    massless = unless(analysis /= analysis_periodic, &
                      "has no use with analysis = 'periodic': there foils have no mass")
    call keys%start_group('foil_damping', optional=.not. moves, &
                          misplaced=misplaced_group(analysis, moves))
    call keys%real_key('foundation_damping', damping%foundation_damping, 'N s/m^3', &
                       'viscous damping of the elastic foundation, pressure over velocity', &
                       not_negative)
    call keys%real_key('maxwell_stiffness', damping%arm%stiffness, 'N/m^3', 'spring of the '// &
                       'Maxwell arm, a spring and a dashpot in series beside each spring of '// &
                       'the elastic foundation', positive, default=no_default)
    call keys%real_key('maxwell_time', damping%arm%time, 's', 'relaxation time of that arm: '// &
                       'its dashpot over its spring', positive, default=no_default)
    call keys%choice_key('foil_mass', damping%foil_mass, mass_words, &
                         'whether top foil and bumps have their mass: where the frequencies '// &
                         'that are asked for, or with which the shaft moves, are high enough '// &
                         'for it to count, always, never', useless=massless)
    call keys%integer_key('foil_modes', damping%foil_modes, &
                          'fixed-interface modes kept inside each condensed piece of the bumps '// &
                          'that has its mass', from_to(0.0_wp, most_modes), useless=massless)
  end subroutine read_foil_damping_case
end module gfb_foil_damping_case
