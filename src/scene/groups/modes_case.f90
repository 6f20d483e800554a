!> `&modes`: which natural modes are asked for.
module gfb_modes_case
  use gfb_kinds, only: wp
  use gfb_case_keys, only: case_keys_type, from_to
  use gfb_scene_case, only: analysis_modes, misplaced_group
  implicit none (type, external)
  private
  public :: modes_case_type, read_modes_case

  integer, parameter, public :: part_half_arc = 1 !! from corner line to crest line, both fixed
  integer, parameter, public :: part_arc = 2      !! from corner line to corner line, both fixed
  integer, parameter, public :: part_flat = 3     !! between two corner lines, both fixed
  integer, parameter, public :: part_strip = 4    !! the whole strip, fixed at its fixed edge
  integer, parameter, public :: part_top_foil = 5 !! fixed at its fixed edge

  character(len=*), parameter, public :: part_words(*) = [character(len=8) :: 'half_arc', 'arc', &
                                                          'flat', 'strip', 'top_foil']

  !> The modes asked for.
  type :: modes_case_type
    integer :: count = 10
    integer :: part = part_strip
    integer :: substructure_modes = 0 !! Craig-Bampton modes kept in every super-element
  end type modes_case_type

contains

  !> Reads the group.
  subroutine read_modes_case(keys, modes, analysis)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(modes_case_type), intent(out) :: modes !! what `&modes` asks for
    integer, intent(in) :: analysis !! 0 where it is not known

    call keys%start_group('modes', optional=analysis /= analysis_modes, &
                          misplaced=misplaced_group(analysis, analysis == analysis_modes))
    call keys%integer_key('count', modes%count, 'number of modes, from the lowest frequency up', &
                          from_to(1.0_wp, 1000.0_wp))
    call keys%choice_key('part', modes%part, part_words, 'component that vibrates')
    call keys%integer_key('substructure_modes', modes%substructure_modes, &
                          'fixed-interface modes kept in every super-element of a strip '// &
                          '(Craig-Bampton)', from_to(0.0_wp, 1000.0_wp))
    if (modes%substructure_modes > 0 .and. modes%part /= part_strip .and. modes%part /= 0) then
      call keys%complain('modes', 'substructure_modes', "needs part = 'strip', which alone is "// &
                         'made of super-elements')
    end if
  end subroutine read_modes_case
end module gfb_modes_case
