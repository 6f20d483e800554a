!> `&scene`: what is asked for.
module gfb_scene_case
  use gfb_case_keys, only: case_keys_type
  implicit none (type, external)
  private
  public :: scene_case_type, read_scene_case

  integer, parameter, public :: analysis_equilibrium = 1    !! the load is given
  integer, parameter, public :: analysis_fixed_position = 2 !! the eccentricity is given

  character(len=*), parameter :: analysis_words(*) = [character(len=14) :: &
                                                      'equilibrium', 'fixed_position']

  !> What is asked for.
  type :: scene_case_type
    character(len=:), allocatable :: title        !! free text
    integer :: analysis = analysis_equilibrium
  end type scene_case_type

contains

  !> Reads the group. The analysis is 0 where it was misspelt.
  subroutine read_scene_case(keys, scene)
    type(case_keys_type), intent(inout) :: keys
    type(scene_case_type), intent(out) :: scene

    scene%title = ''
    call keys%start_group('scene')
    call keys%string_key('title', scene%title, 'free text, copied into the results')
    call keys%choice_key('analysis', scene%analysis, analysis_words, &
                         'find the position that carries the load, or hold a given position')
    call keys%finish_group()
  end subroutine read_scene_case
end module gfb_scene_case
