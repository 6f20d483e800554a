!> `&scene`: what is asked for.
module gfb_scene_case
  use gfb_case_keys, only: case_keys_type
  use gfb_text, only: lower_case, nearest_word
  implicit none (type, external)
  private
  public :: scene_case_type, needs_type, read_scene_case, is_bearing, is_structure, asks_limit, &
            misplaced_group

  integer, parameter, public :: analysis_equilibrium = 1    !! the load is given
  integer, parameter, public :: analysis_fixed_position = 2 !! the eccentricity is given
  integer, parameter, public :: analysis_strip = 3          !! a bump strip under crest loads
  integer, parameter, public :: analysis_modes = 4          !! natural modes of a foil or, or a part
  integer, parameter, public :: analysis_linear_dynamics = 5 !! small vibrations about 1 or 2
  integer, parameter, public :: analysis_load_capacity = 6 !! load that leaves the least film
  integer, parameter, public :: analysis_lift_off = 7      !! speed that lifts the asperities off
  integer, parameter, public :: analysis_misalignment = 8  !! tilt that leaves the least film
  integer, parameter, public :: analysis_transient = 9     !! the shaft over time, from 1 or 2
  integer, parameter, public :: analysis_periodic = 10     !! orbits that close, about 1

  character(len=*), parameter, public :: analysis_words(*) = &
    [character(len=22) :: 'equilibrium', 'fixed_position', 'strip', 'modes', 'linear_dynamics', &
                          'load_capacity', 'lift_off', 'misalignment_allowance', 'transient', &
                          'periodic']

  !> What is asked for.
  type :: scene_case_type
    character(len=:), allocatable :: title        !! free text
    !> of the case file while it is read; then of the state about which the shaft vibrates, or
    !> whose limit is looked for
    integer :: analysis = analysis_equilibrium
  end type scene_case_type

  !> What an analysis must know of bearing and foils; keys of the rest may be left out.
  type :: needs_type
    logical :: pad = .false.      !! radius, length, where it begins
    logical :: film = .false.     !! between the pad and a shaft
    logical :: top_foil = .false. !! thickness and material
    logical :: top_mass = .false. !! its density
    logical :: bumps = .false.    !! their shape: the strip, or a part of it, is meshed
    logical :: mass = .false.     !! its density
    logical :: pitch = .false.    !! more of it than an arc is meshed, and no pad tells the pitch
    logical :: width = .false.    !! of the strip: no bearing tells it
  end type needs_type

contains

  !> Reads the group. The analysis is 0 where it was misspelt.
  subroutine read_scene_case(keys, scene)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(scene_case_type), intent(out) :: scene !! what `&scene` asks for

    scene%title = ''
    call keys%start_group('scene')
    call keys%string_key('title', scene%title, 'free text, copied into the results')
    call keys%choice_key('analysis', scene%analysis, analysis_words, &
                         'position that carries the load, film of a given position, bump '// &
                         'strip under loads, natural modes, small vibrations of the shaft '// &
                         'about one of the first two; load, speed or tilt up to a limit: '// &
                         'see `&capacity`; the shaft over time: see `&transient`; orbits '// &
                         'that close: see `&periodic`')
    if (is_misplaced(keys)) scene%analysis = 0
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

  !> Whether an analysis has a shaft and a film.
  pure logical function is_bearing(analysis) result(bearing)
    integer, intent(in) :: analysis !! 0 where it is not known
    bearing = analysis == analysis_equilibrium .or. analysis == analysis_fixed_position .or. &
              analysis == analysis_linear_dynamics .or. analysis == analysis_transient .or. &
              analysis == analysis_periodic .or. asks_limit(analysis)
  end function is_bearing

  !> Whether an analysis looks for a limit of equilibria.
  pure logical function asks_limit(analysis) result(asks)
    integer, intent(in) :: analysis !! 0 where it is not known
    asks = analysis == analysis_load_capacity .or. analysis == analysis_lift_off .or. &
           analysis == analysis_misalignment
  end function asks_limit

  !> Whether an analysis is of foils alone.
  pure logical function is_structure(analysis) result(structure)
    integer, intent(in) :: analysis !! 0 where it is not known
    structure = analysis == analysis_strip .or. analysis == analysis_modes
  end function is_structure

  !> What is wrong with a group that an analysis has no use for; empty where nothing is.
  pure function misplaced_group(analysis, fits) result(words)
    integer, intent(in) :: analysis !! 0 where it is not known
    logical, intent(in) :: fits     !! the analysis uses the group
    character(len=:), allocatable :: words

    words = ''
    if (fits .or. analysis == 0) return
    words = "has no use with analysis = '"//trim(analysis_words(analysis))//"'"
  end function misplaced_group
end module gfb_scene_case
