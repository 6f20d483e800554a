!> `&sweep`: a parameter of the operating point takes several values, or real keys of the case file
!> do.
module gfb_sweep_case
  use gfb_kinds, only: wp
  use gfb_units, only: degree
  use gfb_case_keys, only: case_keys_type, longest_list, any_value, not_negative, rule_type, &
                           positive
  use gfb_operation_case, only: operation_case_type, other_sense
  use gfb_analysis_row, only: analysis_row_type
  use gfb_text, only: text
  use gfb_key_effect, only: acts_on_nothing
  implicit none (type, external)
  private
  public :: sweep_case_type, read_sweep_case, operation_at, swept_keys, named_keys

  integer, parameter, public :: sweep_load = 1
  integer, parameter, public :: sweep_speed = 2
  integer, parameter, public :: sweep_tilt_x = 3
  integer, parameter, public :: sweep_tilt_y = 4
  integer, parameter, public :: sweep_eccentricity_x = 5
  integer, parameter, public :: sweep_eccentricity_y = 6
  integer, parameter, public :: sweep_load_angle = 7
  integer, parameter, public :: sweep_axial_load = 8
  integer, parameter, public :: sweep_axial_gap = 9
  integer, parameter, public :: sweep_keys = 10 !! of the case file; each value is another bearing

  character(len=*), parameter, public :: parameter_words(*) = &
    [character(len=14) :: 'load', 'speed_rpm', 'tilt_x', 'tilt_y', 'eccentricity_x', &
                          'eccentricity_y', 'load_angle', 'axial_load', 'axial_gap']
  character(len=*), parameter :: units(0:10) = [character(len=18) :: &
                                               'that of parameter', 'N', 'rpm', 'rad', 'rad', &
                                               'm', 'm', 'deg', 'N', 'm', 'that of parameter']

  integer, parameter, public :: every_element = -1 !! of a list

  !> A key of the case file, or a value of one that is a list.
  type, public :: swept_key_type
    character(len=:), allocatable :: group, name !! in lower case
    integer :: element = 0 !! of the list, or `every_element`; 0: no index is given
    integer :: acts_on = acts_on_nothing !! see `gfb_key_effect`; once it has been looked up
  contains
    procedure, non_overridable :: label, is_gap
  end type swept_key_type

  !> The sweep.
  type :: sweep_case_type
    logical :: present = .false.           !! the case asks for a sweep
    integer :: parameter = 0               !! `sweep_load`, ...; 0 without a sweep
    character(len=:), allocatable :: keys  !! `group%key, ...` of `sweep_keys`
    character(len=:), allocatable :: unit  !! of these keys
    real(wp), allocatable :: values(:)     !! of the parameter; a load is its magnitude
    logical :: hold_position = .false.     !! the shaft stays where &operation's equilibrium is
    logical :: turn_folds = .false.        !! goes on where the branch of answers turns back
    logical :: friction_memory = .false.   !! friction carries its slip from point to point
  end type sweep_case_type

contains

  !> Reads the group.
  subroutine read_sweep_case(keys, sweep, analysis)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(sweep_case_type), intent(out) :: sweep !! what `&sweep` asks for
    type(analysis_row_type), intent(in) :: analysis !! of the case file
    type(rule_type) :: rule
    integer :: point

    call keys%start_group('sweep', optional=.true., present_in_file=sweep%present, &
                          misplaced=analysis%refusal('sweep'))
    call keys%choice_or_keys_key('parameter', sweep%parameter, parameter_words, sweep%keys, &
                                 'quantity that is varied; load: its magnitude, in the '// &
                                 'direction of `load`; load_angle: its direction from x '// &
                                 'towards y, its magnitude kept; axial_load and '// &
                                 'axial_gap: of a thrust bearing')
    rule = any_value
    if (sweep%parameter == sweep_load) rule = not_negative
    if (sweep%parameter == sweep_axial_gap) rule = positive
    call keys%real_list_key('values', sweep%values, longest_list, trim(units(sweep%parameter)), &
                            'values of the parameter, in the order in which they are computed', &
                            rule)
    do point = 1, size(sweep%values)
      if (sweep%parameter /= sweep_speed .or. .not. sweep%values(point) < 0.0_wp) cycle
      call keys%complain('sweep', 'values', other_sense, point)
    end do
    call keys%logical_key('hold_position', sweep%hold_position, &
                          'keep the shaft fixed at its equilibrium at `&operation`')
    call keys%logical_key('turn_folds', sweep%turn_folds, &
                          'follow the branch round its folds, where the parameter turns back, '// &
                          'until it leaves the range of the values')
    call keys%logical_key('friction_memory', sweep%friction_memory, &
                          'points are steps of one loading history: friction keeps its slip '// &
                          'from point to point; otherwise every point is loaded from rest')
  end subroutine read_sweep_case

  !> The keys that take the sweep's values; names are empty where the sweep has them wrong.
  pure function swept_keys(sweep) result(list)
    type(sweep_case_type), intent(in) :: sweep !! what `&sweep` asks for, with `sweep_keys`
    type(swept_key_type), allocatable :: list(:)
    list = named_keys(sweep%keys)
  end function swept_keys

  !> The keys that a list names; names are empty where it has them wrong.
  pure function named_keys(names) result(list)
    character(len=*), intent(in) :: names !! `group%key, ...`
    type(swept_key_type), allocatable :: list(:)
    type(swept_key_type) :: one
    character(len=:), allocatable :: left
    integer :: comma, sign

    allocate (list(0))
    left = names//','
    do while (left /= '')
      comma = index(left, ',')
      sign = index(left(:comma - 1), '%')
      one%group = trim(adjustl(left(:max(sign, 1) - 1)))
      one%name = trim(adjustl(left(sign + 1:comma - 1)))
      call take_index(one)
      list = [list, one]
      left = left(comma + 1:)
    end do
  end function named_keys

  !> Takes the index off a key's name; what is no index stays part of the name.
  pure subroutine take_index(key)
    type(swept_key_type), intent(inout) :: key
    character(len=:), allocatable :: words
    integer :: open, status

    key%element = 0
    open = index(key%name, '(')
    if (open < 2 .or. index(key%name, ')') /= len(key%name)) return
    words = trim(adjustl(key%name(open + 1:len(key%name) - 1)))
    if (words == ':') then
      key%element = every_element
    else if (words == '' .or. verify(words, '0123456789') > 0) then
      return
    else
      read (words, *, iostat=status) key%element
      if (status /= 0) key%element = huge(0) ! longer than any list
      if (key%element == 0) return           ! lists begin with 1
    end if
    key%name = trim(key%name(:open - 1))
  end subroutine take_index

  !> Group, name and index of a key.
  pure function label(self) result(words)
    class(swept_key_type), intent(in) :: self !! the key
    character(len=:), allocatable :: words

    words = self%group//'%'//self%name
    if (self%element == every_element) words = words//'(:)'
    if (self%element > 0) words = words//'('//text(self%element)//')'
  end function label

  !> Whether a key is a list of gaps at rest, which are 0 where it is absent.
  pure logical function is_gap(self) result(gap)
    class(swept_key_type), intent(in) :: self !! the key
    gap = self%group == 'bump_foil' .and. (self%name == 'crest_gap' .or. self%name == 'corner_gap')
  end function is_gap

  !> The operating point with one of the sweep's values in it.
  pure function operation_at(operation, sweep, point) result(there)
    type(operation_case_type), intent(in) :: operation !! what `&operation` asks for
    type(sweep_case_type), intent(in) :: sweep !! what `&sweep` asks for
    integer, intent(in) :: point  !! number of the value
    type(operation_case_type) :: there

    there = operation
    associate (value => sweep%values(point))
      select case (sweep%parameter)
      case (sweep_load)
        there%load = value*(operation%load/hypot(operation%load(1), operation%load(2)))
      case (sweep_load_angle)
        there%load = norm2(operation%load)*[cos(value*degree), sin(value*degree)]
      case (sweep_speed)
        there%speed_rpm = value
      case (sweep_tilt_x)
        there%tilt(1) = value
      case (sweep_tilt_y)
        there%tilt(2) = value
      case (sweep_eccentricity_x)
        there%eccentricity(1) = value
      case (sweep_eccentricity_y)
        there%eccentricity(2) = value
      case (sweep_axial_load)
        there%axial_load = value
      case (sweep_axial_gap)
        there%axial_gap = value
      case default
        return ! a misspelt parameter, complained about, or keys: the scene has their value
      end select
    end associate
  end function operation_at
end module gfb_sweep_case
