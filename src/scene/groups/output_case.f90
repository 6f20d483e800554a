!> `&output`: what is written.
module gfb_output_case
  use gfb_kinds, only: wp
  use gfb_case_keys, only: case_keys_type, from_to
  implicit none (type, external)
  private
  public :: output_case_type, read_output_case

  character(len=*), parameter :: field_words(*) = [character(len=10) :: &
                                                   'all', 'none', 'pressure', 'gap', 'deflection']

  real(wp), parameter :: most_steps = 1.0e6_wp

  !> Fields that are written for ParaView, and how often the state is saved to resume the run.
  type :: output_case_type
    logical :: pressure = .true.
    logical :: gap = .true.
    logical :: deflection = .true.
    integer :: restart_every = 0 !! points or load steps between restart files; 0: one a minute
  end type output_case_type

contains

  !> Reads the group.
  subroutine read_output_case(keys, output)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(output_case_type), intent(out) :: output !! what `&output` asks for
    logical :: chosen(size(field_words))

    chosen = field_words == 'all'
    call keys%start_group('output')
    call keys%words_key('fields', chosen, field_words, 'fields that are written for ParaView')
    call keys%rule('output', 'fields', any(chosen .and. field_words == 'none') .and. &
                   count(chosen) > 1, "'none' must stand alone")
    output%pressure = any(chosen .and. (field_words == 'all' .or. field_words == 'pressure'))
    output%gap = any(chosen .and. (field_words == 'all' .or. field_words == 'gap'))
    output%deflection = any(chosen .and. (field_words == 'all' .or. field_words == 'deflection'))
    call keys%integer_key('restart_every', output%restart_every, &
                          'sweep points, load steps of a strip or steps of time, after which '// &
                          '`CASE.restart.h5` is written for `--restart`; 0: once a minute', &
                          from_to(0.0_wp, most_steps))
  end subroutine read_output_case
end module gfb_output_case
