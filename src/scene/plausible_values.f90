!> Values that a case file may have and yet hardly means: most often a number in another unit.
module gfb_plausible_values
  use gfb_kinds, only: wp
  use gfb_case_keys, only: case_keys_type, longest_list
  use gfb_key_elements, only: find_elements
  use gfb_namelist_values, only: read_real, value_string
  use gfb_periodic_case, only: follow_mass, follow_speed, follow_unbalance
  use gfb_scene, only: scene_type
  use gfb_sweep_case, only: sweep_case_type, sweep_keys, sweep_load, sweep_load_angle, &
                            sweep_speed, sweep_tilt_x, sweep_tilt_y
  use gfb_text, only: text
  use gfb_usual_ranges, only: range_type, ranges, units
  implicit none (type, external)
  private
  public :: check_plausible

  !> No gas film carries a larger load over p_a D L [1].
  real(wp), parameter :: most_carried = 50.0_wp

contains

  !> Warns of values that are hardly meant, key by key.
  subroutine check_plausible(keys, scene)
    type(case_keys_type), intent(inout) :: keys !! the keys of the case file
    type(scene_type), intent(in) :: scene !! what the case file asks for
    integer :: i, mistakes

    mistakes = keys%complaints%count + keys%warnings%count
    do i = 1, size(ranges)
      call check_values(keys, trim(ranges(i)%group), trim(ranges(i)%key), ranges(i))
    end do
    call check_sweep_values(keys, scene%sweep)
    call check_final_value(keys, scene%periodic%parameter)
    ! A load that is large against a wrong pressure is not wrong.
    if (keys%complaints%count + keys%warnings%count == mistakes) call check_load(keys, scene)
  end subroutine check_plausible

  !> Warns of the first value of a key that is not usual.
  subroutine check_values(keys, group, key, range)
    type(case_keys_type), intent(inout) :: keys
    character(len=*), intent(in) :: group, key !! names in the case file
    type(range_type), intent(in) :: range      !! of the values
    integer, allocatable :: elements(:)
    character(len=:), allocatable :: problem
    real(wp) :: number
    integer :: i

    call find_elements(keys%file, group, key, longest_list, elements)
    do i = 1, size(elements)
      if (keys%file%values(elements(i))%kind == value_string) cycle
      call read_real(keys%file%value_text(elements(i)), number, problem)
      if (problem /= '' .or. is_usual(range, number)) cycle
      if (size(elements) == 1) then
        call keys%warn(group, key, range_words(range)//guess(range, number))
      else
        call keys%warn(group, key, range_words(range)//guess(range, number), i)
      end if
      return
    end do
  end subroutine check_values

  !> The values of a sweep are those of what it changes; a start from rest has slow ones, too.
  subroutine check_sweep_values(keys, sweep)
    type(case_keys_type), intent(inout) :: keys
    type(sweep_case_type), intent(in) :: sweep
    character(len=:), allocatable :: key
    type(range_type) :: range
    integer :: i

    if (any(sweep%parameter == [0, sweep_load, sweep_load_angle, sweep_keys])) return
    key = 'eccentricity'
    if (sweep%parameter == sweep_speed) key = 'speed_rpm'
    if (sweep%parameter == sweep_tilt_x .or. sweep%parameter == sweep_tilt_y) key = 'tilt'
    do i = 1, size(ranges)
      if (ranges(i)%group /= 'operation' .or. ranges(i)%key /= key) cycle
      range = ranges(i)
      range%low = 0.0_wp
      call check_values(keys, 'sweep', 'values', range)
    end do
  end subroutine check_sweep_values

  !> The last value of a branch of orbits is that of its parameter.
  subroutine check_final_value(keys, parameter)
    type(case_keys_type), intent(inout) :: keys
    integer, intent(in) :: parameter !! over which the orbits are followed
    integer :: i

    do i = 1, size(ranges)
      associate (group => ranges(i)%group, key => ranges(i)%key)
        if ((parameter == follow_speed .and. group == 'operation' .and. key == 'speed_rpm') .or. &
            (parameter == follow_unbalance .and. group == 'periodic' .and. &
             key == 'unbalance') .or. &
            (parameter == follow_mass .and. group == 'rotor' .and. key == 'mass')) then
          call check_values(keys, 'periodic', 'final_value', ranges(i))
        end if
      end associate
    end do
  end subroutine check_final_value

  !> Warns of a load that no film carries.
  subroutine check_load(keys, scene)
    type(case_keys_type), intent(inout) :: keys
    type(scene_type), intent(in) :: scene
    real(wp) :: carried, loads !! [N] by a film of p_a, at most; asked for

    associate (bearing => scene%bearing)
      carried = scene%gas%ambient_pressure*2.0_wp*bearing%radius*bearing%length
    end associate
    loads = norm2(scene%operation%load)
    if (.not. carried > 0.0_wp .or. loads <= most_carried*carried) return
    call keys%warn('operation', 'load', 'is '//text(loads/carried, 3)//' p_a D L; gas films '// &
                   'carry some p_a D L at most')
  end subroutine check_load

  !> Whether a value lies where values of its key lie.
  elemental function is_usual(range, number) result(usual)
    type(range_type), intent(in) :: range
    real(wp), intent(in) :: number !! [the key's unit]
    logical :: usual

    usual = .not. abs(number) > 0.0_wp .or. &
            (abs(number) >= range%low .and. abs(number) <= range%high)
  end function is_usual

  !> A range in words.
  pure function range_words(range) result(words)
    type(range_type), intent(in) :: range
    character(len=:), allocatable :: words

    words = 'usual is at most '//text(range%high)
    if (range%low > 0.0_wp) words = 'usual is '//text(range%low)//' to '//text(range%high)
    if (range%unit /= '1') words = words//' '//trim(range%unit)
  end function range_words

  !> The unit in which a number would be usual, as a question; empty where there is none.
  pure function guess(range, number) result(words)
    type(range_type), intent(in) :: range
    real(wp), intent(in) :: number !! [the key's unit]
    character(len=:), allocatable :: words
    character(len=:), allocatable :: left, name
    integer :: comma, i

    words = ''
    left = trim(range%others)
    do while (left /= '')
      comma = index(left//',', ',')
      name = left(:comma - 1)
      left = left(min(comma, len(left)) + 1:)
      do i = 1, size(units)
        if (units(i)%name /= name .or. .not. is_usual(range, number*units(i)%size)) cycle
        words = '; did you mean '//text(number)//' '//name//' = '//text(number*units(i)%size)
        if (range%unit /= '1') words = words//' '//trim(range%unit)
        words = words//'?'
        return
      end do
    end do
  end function guess
end module gfb_plausible_values
