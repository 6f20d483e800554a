!> What the program tells of itself, without a case.
module gfb_information
  use gfb_case_template, only: template_text
  use gfb_command_line, only: command_line_type, help_text
  use gfb_errors, only: error_type
  use gfb_explanation, only: explanation
  use gfb_provenance, only: version_text
  use gfb_result_names, only: results_text
  use gfb_scene_reading, only: key_table
  implicit none (type, external)
  private
  public :: information

contains

  !> The text that is asked for; empty where a case is to be computed.
  !>
  !> Fails where nothing is known of what is asked for.
  subroutine information(line, words, error)
    type(command_line_type), intent(in) :: line !! what was typed
    character(len=:), allocatable, intent(out) :: words !! to be printed
    type(error_type), allocatable, intent(out) :: error !! why there is none

    words = ''
    if (line%help) then
      words = help_text()
    else if (line%version) then
      words = version_text()
    else if (line%keys) then
      words = key_table()
    else if (line%results) then
      words = results_text()
    else if (line%template /= '') then
      call template_text(line%template, words, error)
    else if (line%explain /= '') then
      call explanation(line%explain, words, error)
    end if
  end subroutine information
end module gfb_information
