!> `&strip_load`: what presses on a bump strip.
module gfb_strip_load_case
  use gfb_kinds, only: wp
  use gfb_case_keys, only: case_keys_type, longest_list
  use gfb_scene_case, only: analysis_strip, misplaced_group
  use gfb_text, only: text
  use gfb_value_rules, only: any_value
  implicit none (type, external)
  private
  public :: strip_load_case_type, read_strip_load_case, crest_pressures

  integer, parameter, public :: load_crest_pressure = 1

  integer, parameter, public :: distribution_uniform = 1
  integer, parameter, public :: distribution_increasing_decreasing = 2
  integer, parameter, public :: distribution_table = 3

  integer, parameter, public :: support_held = 1 !! corner lines cannot move in v

  character(len=*), parameter :: kind_words(*) = [character(len=14) :: 'crest_pressure']
  character(len=*), parameter :: distribution_words(*) = [character(len=21) :: 'uniform', &
                                                          'increasing_decreasing', 'table']
  character(len=*), parameter :: support_words(*) = [character(len=4) :: 'held']

  !> The load of a strip.
  type :: strip_load_case_type
    integer :: kind = load_crest_pressure
    integer :: distribution = distribution_uniform
    real(wp) :: pressure = 0.0_wp              !! the uniform one, or the peak [Pa]
    real(wp), allocatable :: bump_pressure(:)  !! one a bump [Pa]
    integer :: support = support_held
  end type strip_load_case_type

contains

  !> Reads the group.
  subroutine read_strip_load_case(keys, load, bumps, analysis)
    type(case_keys_type), intent(inout) :: keys
    type(strip_load_case_type), intent(out) :: load
    integer, intent(in) :: bumps    !! of the strip, 0 where not known
    integer, intent(in) :: analysis !! 0 where it is not known
    logical :: needed, table, given

    needed = analysis == analysis_strip
    call keys%start_group('strip_load', required=needed, optional=.not. needed, &
                          misplaced=misplaced_group(analysis, needed))
    call keys%choice_key('kind', load%kind, kind_words, 'how the strip is loaded')
    call keys%choice_key('distribution', load%distribution, distribution_words, &
                         'of the crest pressure over the bumps')
    table = load%distribution == distribution_table
    call keys%real_key('pressure', load%pressure, 'Pa', 'uniform pressure, or the peak', &
                       any_value, needed .and. .not. table .and. load%distribution /= 0, &
                       default='required unless a table', given=given)
    if (table .and. given) then
      call keys%complain('strip_load', 'pressure', "has no use with distribution = 'table': "// &
                         'bump_pressure gives the pressures')
    end if
    call keys%real_list_key('bump_pressure', load%bump_pressure, longest_list, 'Pa', &
                            'pressure on every bump of a table', any_value, needed .and. table, &
                            'required for a table')
    if (table .and. bumps > 0 .and. keys%last_key_is_right()) then
      if (size(load%bump_pressure) /= bumps) then
        call keys%complain('strip_load', 'bump_pressure', 'must have one value a bump: '// &
                           text(bumps)//', not '//text(size(load%bump_pressure)))
      end if
    else if (size(load%bump_pressure) > 0 .and. .not. table .and. load%distribution /= 0) then
      call keys%complain('strip_load', 'bump_pressure', "needs distribution = 'table'")
    end if
    call keys%choice_key('support', load%support, support_words, &
                         'corner lines held in v: a linear strip')
    call keys%finish_group()
  end subroutine read_strip_load_case

  !> Pressure on every bump, from the smallest x on [Pa].
  pure function crest_pressures(load, bumps) result(pressure)
    type(strip_load_case_type), intent(in) :: load
    integer, intent(in) :: bumps
    real(wp) :: pressure(bumps)
    integer :: n

    select case (load%distribution)
    case (distribution_increasing_decreasing)
      pressure = load%pressure* &
                 [(real(min(n, bumps + 1 - n), wp)/real((bumps + 1)/2, wp), n=1, bumps)]
    case (distribution_table)
      pressure = load%bump_pressure
    case default
      pressure = load%pressure
    end select
  end function crest_pressures
end module gfb_strip_load_case
