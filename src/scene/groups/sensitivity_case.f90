!> `&sensitivity`: how results of an answer follow keys of the case file.
module gfb_sensitivity_case
  use gfb_kinds, only: wp
  use gfb_case_keys, only: case_keys_type, not_negative
  use gfb_scene_case, only: analysis_equilibrium, analysis_fixed_position, misplaced_group
  use gfb_sweep_case, only: swept_key_type
  implicit none (type, external)
  private
  public :: sensitivity_case_type, read_sensitivity_case

  integer, parameter :: most_tolerances = 1000 !! of a list

  !> Results whose derivatives are offered, in the order in which the solver has them.
  character(len=*), parameter, public :: quantity_words(*) = [character(len=16) :: &
    'eccentricity_x', 'eccentricity_y', 'attitude_angle', 'force_x', 'force_y', 'torque_x', &
    'torque_y', 'friction_torque', 'power_loss', 'minimum_gap', 'maximum_pressure', &
    'minimum_pressure']

  !> A key by which results are derived.
  type, public :: parameter_type
    type(swept_key_type) :: key
    character(len=:), allocatable :: unit
    real(wp) :: value = 0.0_wp     !! in the case file [its unit]
    real(wp) :: tolerance = 0.0_wp !! standard deviation [its unit]
  end type parameter_type

  !> The derivatives asked for.
  type :: sensitivity_case_type
    logical :: present = .false.                        !! the case asks for them
    logical :: quantity(size(quantity_words)) = .false. !! whose derivatives are asked for
    character(len=:), allocatable :: names              !! `group%key, ...` of the keys
    integer :: strings = 0                              !! in which they stand
    real(wp), allocatable :: tolerances(:)              !! one a key, or none [their units]
    type(parameter_type), allocatable :: parameter(:)   !! the keys, once they are checked
  end type sensitivity_case_type

contains

  !> Reads the group.
  subroutine read_sensitivity_case(keys, sensitivity, analysis)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(sensitivity_case_type), intent(out) :: sensitivity !! what `&sensitivity` asks for
    integer, intent(in) :: analysis !! 0 where it is not known

    call keys%start_group('sensitivity', optional=.true., present_in_file=sensitivity%present, &
                          misplaced=misplaced_group(analysis, &
                                                    analysis == analysis_equilibrium .or. &
                                                    analysis == analysis_fixed_position))
    call keys%words_key('quantity', sensitivity%quantity, quantity_words, &
                        'results whose derivatives are found')
    call keys%rule('sensitivity', 'quantity', sensitivity%present .and. &
                   .not. any(sensitivity%quantity) .and. (keys%last_key_is_right() .or. &
                   .not. keys%holds('sensitivity', 'quantity')), 'must name a result')
    call keys%names_key('parameters', sensitivity%names, sensitivity%strings, &
                        'keys by which they are derived, such as `''bump_foil%thickness''`; '// &
                        'of a list a value, `''bump_foil%crest_gap(2)''`, or all, `(:)`; '// &
                        '`''operation%load''` is its magnitude')
    call keys%real_list_key('tolerances', sensitivity%tolerances, most_tolerances, &
                            'those of parameters', 'standard deviation of each of them: the '// &
                            'variance is told that they cause', not_negative, .false., 'none')
  end subroutine read_sensitivity_case
end module gfb_sensitivity_case
