!> What a sample shows and writes: its members, and the statistics of their results.
module gfb_sample_writing
  use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
  use gfb_bearing_record, only: analysis_name
  use gfb_bearing_summary, only: cost_type, cost_quantities
  use gfb_case_file, only: case_array_type, history_row_type, add_arrays, fill_array, &
                           history_values
  use gfb_errors, only: error_type
  use gfb_kinds, only: wp
  use gfb_quantity, only: quantity_type, add_quantity
  use gfb_result_names, only: asked_names, result_unit
  use gfb_result_set, only: result_grid_type, write_result_set
  use gfb_result_phrases, only: all_members, seed_and_reason
  use gfb_result_table, only: name_length
  use gfb_results, only: add_result
  use gfb_run_context, only: run_context_type
  use gfb_run_log, only: run_log_type
  use gfb_sample_case, only: percent_of
  use gfb_sample_statistics, only: mean_of, deviation_of, quantile_of
  use gfb_scene, only: scene_type
  use gfb_scene_case, only: analysis_equilibrium, analysis_fixed_position
  use gfb_table_file, only: table_member_type
  use gfb_text, only: text
  implicit none (type, external)
  private
  public :: write_sample

  !> What the log shows of the statistics.
  character(len=name_length), parameter :: shown(*) = [character(len=name_length) :: &
    'minimum_gap', 'eccentricity_x', 'eccentricity_y', 'force_x', 'force_y', 'friction_torque', &
    'maximum_pressure', 'stiffness_xx', 'stiffness_yy', 'loading_stiffness', 'maximum_force', &
    'dissipated_energy', 'load_capacity', 'lift_off_speed_rpm', 'misalignment_allowance']

contains

  !> Shows the statistics, and writes them with all members; members without an answer are in the
  !> table and not in the statistics.
  !>
  !> Fails when a file cannot be written.
  subroutine write_sample(scene, context, members, origin, ranks, cost, summary, error)
    type(scene_type), intent(in) :: scene !! what was asked for
    type(run_context_type), intent(in) :: context !! of the run
    type(table_member_type), intent(in) :: members(:) !! by their seeds
    type(quantity_type), intent(in) :: origin(:) !! of the files
    integer, intent(in) :: ranks !! that computed all members
    type(cost_type), intent(in) :: cost !! of all members
    type(quantity_type), allocatable, intent(out) :: summary(:) !! what the summary says
    type(error_type), allocatable, intent(out) :: error !! why it failed
    type(history_row_type) :: rows(size(members))
    type(case_array_type), allocatable :: arrays(:)
    type(result_grid_type) :: no_grid(0)
    logical :: converged
    integer :: i

    do i = 1, size(members)
      rows(i) = members(i)%row
    end do
    converged = all(members%status == 0)
    call add_result(summary, 'analysis', analysis_name(scene))
    call add_result(summary, 'converged', converged, all_members)
    call add_result(summary, 'members', size(members))
    call add_result(summary, 'converged_members', count(members%status == 0))
    do i = 1, size(members)
      if (members(i)%status == 0) cycle
      call add_result(summary, 'member_'//text(i), members(i)%name//': no answer ('// &
                      first_line(members(i)%reason)//')', seed_and_reason)
    end do
    call context%log%heading('statistics')
    call add_statistics(rows, scene%sample%quantiles, given_names(scene%general%analysis), &
                        context%log, summary, arrays)
    call add_quantity(summary, cost_quantities(cost))
    call show_members(members, ranks, context%log)
    call write_result_set(scene, context%folder, converged, origin, summary, rows, arrays, &
                          no_grid, .true., context%log, error)
  end subroutine write_sample

  !> A text without what follows its first line.
  pure function first_line(words) result(line)
    character(len=*), intent(in) :: words
    character(len=:), allocatable :: line

    line = words
    if (index(line, new_line('a')) > 0) line = line(:index(line, new_line('a')) - 1)
  end function first_line

  !> Statistics of every result that one answer may be asked for, for summary, file and log.
  subroutine add_statistics(rows, quantiles, given, log, summary, arrays)
    type(history_row_type), intent(in) :: rows(:)
    real(wp), intent(in) :: quantiles(:)
    character(len=name_length), intent(in) :: given(:) !! not found, but the same in all members
    type(run_log_type), intent(in) :: log
    type(quantity_type), allocatable, intent(inout) :: summary(:)
    type(case_array_type), allocatable, intent(out) :: arrays(:)
    character(len=name_length), allocatable :: names(:)
    real(wp), allocatable :: numbers(:)
    integer :: i

    allocate (arrays(0))
    call add_array('quantiles', '1', 'parts of the members below the quantiles', quantiles, arrays)
    names = asked_names()
    do i = 1, size(names)
      if (any(given == names(i))) cycle
      numbers = history_values(rows, trim(names(i)))
      numbers = pack(numbers, .not. ieee_is_nan(numbers))
      if (size(numbers) < 2) cycle
      call add_result_statistics(trim(names(i)), numbers, quantiles, log, summary, arrays)
    end do
  end subroutine add_statistics

  !> Results that the case gives.
  pure function given_names(analysis) result(names)
    integer, intent(in) :: analysis !! of the scene
    character(len=name_length), allocatable :: names(:)

    allocate (names(0))
    if (analysis == analysis_equilibrium) then
      names = [character(len=name_length) :: 'force_x', 'force_y']
    end if
    if (analysis /= analysis_fixed_position) return
    names = [character(len=name_length) :: 'eccentricity_x', 'eccentricity_y']
  end function given_names

  !> Statistics of one result.
  subroutine add_result_statistics(name, numbers, quantiles, log, summary, arrays)
    character(len=*), intent(in) :: name !! of the result
    real(wp), intent(in) :: numbers(:)   !! of the members
    real(wp), intent(in) :: quantiles(:)
    type(run_log_type), intent(in) :: log
    type(quantity_type), allocatable, intent(inout) :: summary(:)
    type(case_array_type), allocatable, intent(inout) :: arrays(:)
    real(wp) :: levels(size(quantiles)), mean, deviation
    character(len=:), allocatable :: unit
    integer :: i

    unit = result_unit(name)
    mean = mean_of(numbers)
    deviation = deviation_of(numbers)
    call add_result(summary, name//'_mean', mean)
    call add_result(summary, name//'_deviation', deviation)
    do i = 1, size(quantiles)
      levels(i) = quantile_of(numbers, quantiles(i))
      call add_result(summary, name//'_q'//two_digits(percent_of(quantiles(i))), levels(i))
    end do
    call add_array(name//'/mean', unit, 'mean over the members', [mean], arrays)
    call add_array(name//'/deviation', unit, 'standard deviation of the members', [deviation], &
                   arrays)
    call add_array(name//'/quantiles', unit, 'quantiles of the members', levels, arrays)
    if (all(shown /= name)) return
    i = size(quantiles)
    call log%line(name//': mean '//text(mean, 5)//' '//unit//', deviation '//text(deviation, 3)// &
                  ', '//text(percent_of(quantiles(1)))//' % below '//text(levels(1), 5)//', '// &
                  text(percent_of(quantiles(i)))//' % below '//text(levels(i), 5))
  end subroutine add_result_statistics

  !> A row of numbers in the file's group of the sample.
  subroutine add_array(name, unit, meaning, values, arrays)
    character(len=*), intent(in) :: name, unit, meaning
    real(wp), intent(in) :: values(:)
    type(case_array_type), allocatable, intent(inout) :: arrays(:)
    type(case_array_type) :: one(1)

    call fill_array('/sample/'//name, unit, meaning, reshape(values, [size(values), 1]), one(1))
    call add_arrays(arrays, one)
  end subroutine add_array

  !> A number below a hundred with two digits.
  pure function two_digits(number) result(words)
    integer, intent(in) :: number
    character(len=2) :: words

    write (words, '(i2.2)') number
  end function two_digits

  !> How many members there are, and which have no answer.
  subroutine show_members(members, ranks, log)
    type(table_member_type), intent(in) :: members(:)
    integer, intent(in) :: ranks
    type(run_log_type), intent(in) :: log
    integer :: i, failed

    failed = count(members%status /= 0)
    call log%line(text(size(members) - failed)//' members, '//text(ranks)//' rank(s)')
    if (failed == 0) return
    call log%tell(text(failed)//' of '//text(size(members))//' members have no answer, and '// &
                  'are not in the statistics:')
    do i = 1, size(members)
      if (members(i)%status /= 0) then
        call log%tell('  '//members(i)%name//': '//first_line(members(i)%reason))
      end if
    end do
  end subroutine show_members
end module gfb_sample_writing
