!> `&scene`: what is asked for.
module gfb_scene_case
  use gfb_analysis_row, only: analysis_row_type, analysis_rows, analysis_equilibrium, &
                              analysis_unknown
  use gfb_case_keys, only: case_keys_type
  use gfb_text, only: lower_case, nearest_word
  implicit none (type, external)
  private
  public :: scene_case_type, needs_type, read_scene_case

  !> What is asked for.
  type :: scene_case_type
    character(len=:), allocatable :: title        !! free text
    type(analysis_row_type) :: asked = analysis_equilibrium !! in the case file
    !> that of the state about which the shaft vibrates, where it begins to move, or whose limit is
    !> looked for; else the same
    type(analysis_row_type) :: analysis = analysis_equilibrium
  end type scene_case_type

  !> What an analysis must know of bearing and foils; keys of the rest may be left out.
  type :: needs_type
    logical :: pad = .false.      !! radius, length, where it begins
    logical :: film = .false.     !! between the pad and a shaft
    logical :: top_foil = .false. !! thickness and material
    logical :: top_mass = .false. !! its density
    logical :: bumps = .false.    !! their shape: the strip, or a part of it, is meshed
    logical :: mass = .false.     !! its density
    logical :: pitch = .false.    !! more of it than an arc is meshed, and no pad gives the pitch
    logical :: width = .false.    !! of the strip: no bearing gives it
    character(len=20) :: weightless = '' !! why no answer follows a density; empty: one may
  end type needs_type

contains

  !> Reads the group. The analysis is unknown where it was misspelt.
  subroutine read_scene_case(keys, scene)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(scene_case_type), intent(out) :: scene !! what `&scene` asks for
    integer :: number

    scene%title = ''
    call keys%start_group('scene')
    call keys%string_key('title', scene%title, 'free text, copied into the results')
    number = scene%asked%number
    call keys%choice_key('analysis', number, analysis_rows%word, &
                         'position that carries the load, film of a given position, bump '// &
                         'strip under loads, natural modes, small vibrations of the shaft '// &
                         'about one of the first two. Load, speed or tilt up to a limit: '// &
                         '`&capacity`; the shaft over time: `&transient`; orbits that '// &
                         'close: `&periodic`')
    if (is_misplaced(keys)) number = 0
    scene%asked = analysis_unknown
    if (number > 0) scene%asked = analysis_rows(number)
    scene%analysis = scene%asked
  end subroutine read_scene_case

  !> Whether the analysis may be said where it is not read: in a group or by a key that is misspelt.
  !> The rest of the file must not be judged by the default then.
  logical function is_misplaced(keys) result(misplaced)
    type(case_keys_type), intent(in) :: keys
    character(len=:), allocatable :: key
    integer :: i

    misplaced = .false.
    if (keys%holds('scene', 'analysis')) return
    associate (file => keys%file)
      do i = 1, size(file%entries)
        key = file%key_name(i)
        if (key == 'analysis') misplaced = .true.
        if (key == 'title' .or. file%group_name(file%entries(i)%group) /= 'scene') cycle
        if (nearest_word(key, ['analysis']) /= '') misplaced = .true.
      end do
      do i = 1, size(file%strays)
        associate (word => file%strays(i))
          if (lower_case(file%words(word%first:word%last)) == 'scene') misplaced = .true.
        end associate
      end do
    end associate
  end function is_misplaced
end module gfb_scene_case
