!> `&output`: what is written.
module gfb_output_case
  use gfb_case_keys, only: case_keys_type
  implicit none (type, external)
  private
  public :: output_case_type, read_output_case

  character(len=*), parameter :: field_words(*) = [character(len=10) :: &
                                                   'all', 'none', 'pressure', 'gap', 'deflection']

  !> Fields that are written for ParaView.
  type :: output_case_type
    logical :: pressure = .true.
    logical :: gap = .true.
    logical :: deflection = .true.
  end type output_case_type

contains

  !> Reads the group.
  subroutine read_output_case(keys, output)
    type(case_keys_type), intent(inout) :: keys
    type(output_case_type), intent(out) :: output
    logical :: chosen(size(field_words))

    chosen = field_words == 'all'
    call keys%start_group('output')
    call keys%words_key('fields', chosen, field_words, 'fields that are written for ParaView')
    if (any(chosen .and. field_words == 'none') .and. count(chosen) > 1) then
      call keys%complain('output', 'fields', "'none' must stand alone")
    end if
    output%pressure = any(chosen .and. (field_words == 'all' .or. field_words == 'pressure'))
    output%gap = any(chosen .and. (field_words == 'all' .or. field_words == 'gap'))
    output%deflection = any(chosen .and. (field_words == 'all' .or. field_words == 'deflection'))
    call keys%finish_group()
  end subroutine read_output_case
end module gfb_output_case
