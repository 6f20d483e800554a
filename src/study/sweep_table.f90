!> The points of a sweep as a table for the terminal, and which of them an answer is.
module gfb_sweep_table
  use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
  use gfb_kinds, only: wp
  use gfb_bearing_record, only: sweep_name, sweep_unit
  use gfb_case_file, only: history_row_type, history_values
  use gfb_run_log, only: run_log_type
  use gfb_scene, only: scene_type
  use gfb_sweep_case, only: sweep_keys
  use gfb_text, only: text
  implicit none (type, external)
  private
  public :: show_points, place_on_sweep

  integer, parameter :: digits = 5, widest = 8 !! of a number; columns of a table

  !> A column that a table may have.
  type :: column_type
    character(len=26) :: name !! of the result
    character(len=16) :: head !! with the unit of the table
    real(wp) :: scale         !! table's number over SI number [1]
    character(len=16) :: beside = '' !! the vector's other component: its size tells rounding
  end type column_type

  type(column_type), parameter :: columns(*) = [ &
    column_type('load_capacity', 'capacity [N]', 1.0_wp), &
    column_type('load_capacity_coefficient', 'in lbf/in^3krpm', 1.0_wp), &
    column_type('lift_off_speed_rpm', 'lift-off [rpm]', 1.0_wp), &
    column_type('misalignment_allowance', 'tilt [mrad]', 1.0e3_wp), &
    column_type('limit_reached', 'at the limit', 1.0_wp), &
    column_type('eccentricity_x', 'e_x [um]', 1.0e6_wp, 'eccentricity_y'), &
    column_type('eccentricity_y', 'e_y [um]', 1.0e6_wp, 'eccentricity_x'), &
    column_type('attitude_angle', 'attitude [deg]', 1.0_wp), &
    column_type('minimum_gap', 'film [um]', 1.0e6_wp), &
    column_type('force_x', 'force_x [N]', 1.0_wp, 'force_y'), &
    column_type('force_y', 'force_y [N]', 1.0_wp, 'force_x'), &
    column_type('torque_x', 'torque_x [N m]', 1.0_wp, 'torque_y'), &
    column_type('torque_y', 'torque_y [N m]', 1.0_wp, 'torque_x'), &
    column_type('friction_torque', 'friction [N m]', 1.0_wp), &
    column_type('critical_mass', 'crit. mass [kg]', 1.0_wp), &
    column_type('growth_rate', 'growth [1/s]', 1.0_wp), &
    column_type('branch_changed', 'other branch', 1.0_wp)]

contains

  !> A line a point, with the numbers that change along the sweep.
  subroutine show_points(scene, history, log)
    type(scene_type), intent(in) :: scene !! with a sweep
    type(history_row_type), intent(in) :: history(:) !! its points
    type(run_log_type), intent(in) :: log !! where lines go
    real(wp) :: numbers(size(history), widest)
    character(len=:), allocatable :: line
    integer :: i, k, wide, many

    if (size(history) < 2) return
    wide = max(12, len(swept(scene)))
    line = repeat(' ', wide - len(swept(scene)))//swept(scene)
    many = 0
    do i = 1, size(columns)
      if (columns(i)%name == column_name(scene) .or. many == widest) cycle
      numbers(:, many + 1) = columns(i)%scale*history_values(history, trim(columns(i)%name))
      if (.not. changes(numbers(:, many + 1), size_beside(columns(i), history))) cycle
      many = many + 1
      line = line//'  '//adjustr(columns(i)%head)
    end do
    call log%heading('points of the sweep')
    call log%line(line)
    associate (value => history_values(history, column_name(scene)))
      do k = 1, size(history)
        line = right(value(k), wide)
        do i = 1, many
          line = line//'  '//right(numbers(k, i), len(columns%head))
        end do
        call log%line(line)
      end do
    end associate
  end subroutine show_points

  !> Which point of its sweep the state is, or how far the sweep has come; empty without a sweep.
  function place_on_sweep(scene, history, converged) result(words)
    type(scene_type), intent(in) :: scene !! what is asked for
    type(history_row_type), intent(in) :: history(:) !! its points that have an answer
    logical, intent(in) :: converged !! the state is the last point's answer
    character(len=:), allocatable :: words
    real(wp) :: value(size(history))

    words = ''
    if (.not. scene%sweep%present) return
    if (size(history) == 0) then
      words = 'no point of the sweep has an answer'
      return
    end if
    value = history_values(history, column_name(scene))
    words = text(size(history))
    if (.not. scene%sweep%turn_folds) words = words//' of '//text(size(scene%sweep%values))
    words = words//': '//sweep_name(scene%sweep)//' = '//text(value(size(value)))//' '// &
            sweep_unit(scene%sweep)
    if (.not. converged) words = 'the last with an answer is '//words
  end function place_on_sweep

  !> What the sweep changes, with its unit.
  pure function swept(scene) result(words)
    type(scene_type), intent(in) :: scene
    character(len=:), allocatable :: words

    words = sweep_name(scene%sweep)//' ['//sweep_unit(scene%sweep)//']'
  end function swept

  !> Name of its column in the history.
  pure function column_name(scene) result(name)
    type(scene_type), intent(in) :: scene
    character(len=:), allocatable :: name

    name = 'key_value'
    if (scene%sweep%parameter /= sweep_keys) name = sweep_name(scene%sweep)
  end function column_name

  !> Largest of the vector's other component, in the table's unit; zero where there is none.
  function size_beside(column, history) result(largest)
    type(column_type), intent(in) :: column !! of the table
    type(history_row_type), intent(in) :: history(:) !! points of the sweep
    real(wp) :: largest

    largest = 0.0_wp
    if (column%beside == '') return
    largest = column%scale*maxval(abs(history_values(history, trim(column%beside))))
  end function size_beside

  !> Whether numbers are there and not all the same but for rounding.
  pure function changes(numbers, beside)
    real(wp), intent(in) :: numbers(:)
    real(wp), intent(in) :: beside !! size of what they are rounded beside
    logical :: changes
    real(wp), parameter :: rounding = 1.0e-9_wp

    changes = maxval(numbers) - minval(numbers) > rounding*max(maxval(abs(numbers)), beside)
  end function changes

  !> A number at the right end of a field; blank where there is none.
  pure function right(number, width) result(words)
    real(wp), intent(in) :: number !! in the table's unit
    integer, intent(in) :: width !! of the field
    character(len=width) :: words

    words = ''
    if (.not. ieee_is_nan(number)) words = text(number, digits)
    words = adjustr(words)
  end function right
end module gfb_sweep_table
