!> `&dynamics`: frequencies at which stiffness and damping are asked for, and what foils do then.
module gfb_dynamics_case
  use gfb_kinds, only: wp
  use gfb_case_keys, only: case_keys_type, longest_list, not_negative, positive
  use gfb_operation_case, only: operation_case_type, angular_speed
  use gfb_scene_case, only: analysis_linear_dynamics, analysis_equilibrium, &
                            analysis_fixed_position, analysis_transient, analysis_periodic, &
                            asks_limit, misplaced_group
  implicit none (type, external)
  private
  public :: dynamics_case_type, read_dynamics_case, analysis_of_state, &
            frequencies_at

  integer, parameter, public :: tangent_stick = 1 !! contacts that rub stick under vibration
  integer, parameter, public :: tangent_slip = 2  !! they slide on as they did
  character(len=*), parameter :: tangent_words(*) = [character(len=5) :: 'stick', 'slip']

  !> What is asked for.
  type :: dynamics_case_type
    logical :: present = .false.              !! the analysis is 'linear_dynamics'
    real(wp), allocatable :: frequencies(:)   !! [rad/s]
    real(wp), allocatable :: ratios(:)        !! the same over the speed of the shaft, or none [1]
    integer :: contact_tangent = tangent_stick
    real(wp) :: loss_factor = 0.0_wp          !! eta of the foil's stiffness [1]
    real(wp), allocatable :: amplitudes(:)    !! of the shaft; contacts slide to and fro [m]
    logical :: stability = .true.             !! critical mass and modes too; not a key
  end type dynamics_case_type

contains

  !> The analysis that finds the state about which the shaft vibrates, or from which it
  !> moves: a given load is balanced, else the given position is kept. A limit is one of
  !> equilibria. The group `&operation` is not read yet.
  pure function analysis_of_state(analysis, has_load, has_position) result(state)
    integer, intent(in) :: analysis !! of the case file, 0 where it is not known
    logical, intent(in) :: has_load, has_position !! keys that `&operation` holds
    integer :: state

    state = analysis
    if (asks_limit(analysis) .or. analysis == analysis_periodic) state = analysis_equilibrium
    if (analysis /= analysis_linear_dynamics .and. analysis /= analysis_transient) return
    state = analysis_equilibrium
    if (has_position .and. .not. has_load) state = analysis_fixed_position
  end function analysis_of_state

  !> Reads the group. Frequencies over the speed become frequencies.
  subroutine read_dynamics_case(keys, dynamics, operation, analysis)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(dynamics_case_type), intent(out) :: dynamics !! what `&dynamics` asks for
    type(operation_case_type), intent(in) :: operation !! what `&operation` asks for
    integer, intent(in) :: analysis !! of the case file, 0 where it is not known

    dynamics%present = analysis == analysis_linear_dynamics
    call keys%start_group('dynamics', required=dynamics%present, optional=.not. dynamics%present, &
                          misplaced=misplaced_group(analysis, dynamics%present))
    call keys%real_list_key('frequencies', dynamics%frequencies, longest_list, 'rad/s', &
                            'circular frequencies at which stiffness and damping are asked for', &
                            positive, .false., 'required without `frequency_ratios`')
    call keys%real_list_key('frequency_ratios', dynamics%ratios, longest_list, '1', &
                            'the same over the speed of the shaft', positive, .false., &
                            'required without `frequencies`')
    dynamics%frequencies = frequencies_at(dynamics, angular_speed(operation%speed_rpm))
    call keys%choice_key('contact_tangent', dynamics%contact_tangent, tangent_words, &
                         'what contacts that rub do under a small vibration: stick, as those '// &
                         'do that it has shaken down, or slide on as when they were loaded')
    call keys%real_key('loss_factor', dynamics%loss_factor, '1', &
                       'loss factor of the foil: its stiffness times 1 + i loss_factor', &
                       not_negative)
    call keys%real_list_key('vibration_amplitudes', dynamics%amplitudes, longest_list, 'm', &
                            'amplitudes of the shaft along x and along y at which stiffness '// &
                            'and damping are asked for too, contacts sliding to and fro', &
                            positive, .false., 'none: small ones alone')
  end subroutine read_dynamics_case

  !> The frequencies at a speed of the shaft.
  pure function frequencies_at(dynamics, speed) result(frequencies)
    type(dynamics_case_type), intent(in) :: dynamics !! what `&dynamics` asks for
    real(wp), intent(in) :: speed !! of the shaft [rad/s]
    real(wp), allocatable :: frequencies(:) !! [rad/s]

    frequencies = dynamics%frequencies
    if (size(dynamics%ratios) > 0) frequencies = dynamics%ratios*speed
  end function frequencies_at

end module gfb_dynamics_case
