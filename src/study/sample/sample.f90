!> A scene with many draws of its random heights: the members one after another, and their
!> statistics.
!>
!> Every member begins cold, as the scene alone with its seed does: so its answer is that one's to
!> the last digit, whichever members went before and whichever group of ranks computes it. A start
!> from the answer without deviations would be another path of loads, and with friction another
!> answer.
module gfb_sample
  use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
  use gfb_kinds, only: wp
  use gfb_analysis_row, only: analysis_row_type
  use gfb_bump_heights, only: even_deviations
  use gfb_bearing_summary, only: cost_type, cost_quantities
  use gfb_case_file, only: case_array_type, csv_settings_type, history_row_type, add_array, &
                           history_values
  use gfb_errors, only: error_type, status_machine
  use gfb_quantity, only: quantity_type, add_quantity, number_quantity, quantity_word
  use gfb_result_names, only: asked_names, result_unit, result_meaning, add_result
  use gfb_result_set, only: result_grid_type, write_result_set
  use gfb_result_table, only: all_members, seed_and_reason, name_length
  use gfb_run_context, only: run_context_type
  use gfb_run_log, only: run_log_type
  use gfb_study_cases, only: percent_of
  use gfb_scene, only: scene_type
  use gfb_scene_reading, only: scene_with_keys
  use gfb_text_file, only: table_member_type
  use gfb_text, only: text
  use gfb_c_library, only: peak_memory
  use gfb_petsc_session, only: rank_count, stop_is_asked, sum_over_ranks, wall_time
  use gfb_outcome, only: add_outcome
  use gfb_reasons, only: reason_type, reason_failed, reason_members, status_unconverged
  use gfb_sample_rules, only: sample_member
  use gfb_signals, only: stop_status, stop_words
  use gfb_study, only: study_type
  use gfb_sample_statistics, only: mean_of, deviation_of, quantile_of
  implicit none (type, external)
  private
  public :: write_sample

  !> What the log shows of the statistics.
  character(len=name_length), parameter :: shown(*) = [character(len=name_length) :: &
    'minimum_gap', 'eccentricity_x', 'eccentricity_y', 'force_x', 'force_y', 'friction_torque', &
    'maximum_pressure', 'stiffness_xx', 'stiffness_yy', 'loading_stiffness', 'maximum_force', &
    'dissipated_energy', 'load_capacity', 'lift_off_speed_rpm', 'lift_off_supply_pressure', &
    'misalignment_allowance', &
    'shaft_temperature', 'maximum_film_temperature', 'maximum_top_foil_temperature', &
    'running_clearance']

  character(len=*), parameter :: group = '/sample/' !! of the result file

  !> The members and what they found.
  type, extends(study_type), public :: sample_type
    class(study_type), allocatable :: pattern !! like the studies of the members, without an answer
    class(study_type), allocatable, private :: plan !! of the scene's own draw
    type(table_member_type), allocatable :: member(:)
  contains
    procedure :: prepare => prepare_sample, check => check_sample, solve => solve_all
    procedure :: solve_member, judge
    procedure :: write => write_study, left_out => left_out_of_members, discard => discard_sample
  end type sample_type

contains

  !> Shows the statistics, and writes them with all members; members without an answer are in the
  !> table and not in the statistics.
  !>
  !> Fails when a file cannot be written.
  subroutine write_sample(scene, context, members, reason, origin, ranks, cost, summary, error)
    type(scene_type), intent(in) :: scene !! what was asked for
    type(run_context_type), intent(in) :: context !! of the run
    type(table_member_type), intent(in) :: members(:) !! by their seeds
    type(reason_type), intent(in) :: reason !! why not all have an answer
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
    call add_result(summary, 'analysis', trim(scene%general%asked%word))
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
    call add_outcome(summary, converged, reason)
    call write_result_set(scene, context%folder, converged, origin, summary, rows, arrays, &
                          no_grid, csv_settings_type(.true., context%csv%decimal_comma), &
                          context%log, error)
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
    call add_array(arrays, group//'quantiles', '1', 'parts of the members below the quantiles', &
                   reshape(quantiles, [size(quantiles), 1]))
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
    type(analysis_row_type), intent(in) :: analysis !! of the scene
    character(len=name_length), allocatable :: names(:)

    allocate (names(0))
    if (analysis%floats) then
      names = [character(len=name_length) :: 'force_x', 'force_y']
    end if
    if (.not. analysis%holds) return
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
    call add_array(arrays, group//name//'/mean', unit, 'mean over the members', &
                   reshape([mean], [1, 1]))
    call add_array(arrays, group//name//'/deviation', unit, 'standard deviation of the members', &
                   reshape([deviation], [1, 1]))
    call add_array(arrays, group//name//'/quantiles', unit, 'quantiles of the members', &
                   reshape(levels, [size(levels), 1]))
    if (all(shown /= name)) return
    i = size(quantiles)
    call log%line(name//': mean '//text(mean, 5)//' '//unit//', deviation '//text(deviation, 3)// &
                  ', '//text(percent_of(quantiles(1)))//' % below '//text(levels(1), 5)//', '// &
                  text(percent_of(quantiles(i)))//' % below '//text(levels(i), 5))
  end subroutine add_result_statistics

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

  !> Says what the scene needs; all members need the same.
  subroutine prepare_sample(self, scene, log)
    class(sample_type), intent(inout) :: self !! the study
    type(scene_type), intent(in) :: scene !! what is asked for
    type(run_log_type), intent(in) :: log !! where lines go

    self%heading = 'members'
    allocate (self%plan, mold=self%pattern)
    call self%plan%prepare(scene, log)
    self%memory = self%plan%memory
    associate (first => scene%bump_foil%random%seed)
      call log%line('sample: '//text(scene%sample%count)//' members, seeds '//text(first)// &
                    ' to '//text(first + scene%sample%count - 1)//', each from a cold start')
    end associate
    allocate (self%member(scene%sample%count))
  end subroutine prepare_sample

  !> Checks, after `prepare`, whether the scene can be done.
  !>
  !> Fails where the study of a member fails.
  subroutine check_sample(self, scene, error)
    class(sample_type), intent(in) :: self !! the study
    type(scene_type), intent(in) :: scene !! what is asked for
    type(error_type), allocatable, intent(out) :: error !! what is lacking
    call self%plan%check(scene, error)
  end subroutine check_sample

  !> Finds the answers of all members.
  subroutine solve_all(self, scene, context, error)
    class(sample_type), target, intent(inout) :: self !! the study
    type(scene_type), intent(in) :: scene !! what is asked for
    type(run_context_type), intent(in) :: context !! of the run
    type(error_type), allocatable, intent(out) :: error !! none: what fails is a member
    integer :: number

    do number = 1, size(self%member)
      call context%log%is_within('member '//text(number)//' of '//text(size(self%member)), &
                                 real(number - 1, wp)/real(size(self%member), wp))
      call self%solve_member(scene, context, number)
    end do
    call context%log%is_within('')
    call self%judge()
  end subroutine solve_all

  !> Finds the answer of one member, and logs it.
  subroutine solve_member(self, scene, context, number)
    class(sample_type), intent(inout) :: self !! the study
    type(scene_type), intent(in) :: scene !! what is asked for
    type(run_context_type), intent(in) :: context !! of the run
    integer, intent(in) :: number !! of the member, from 1
    class(study_type), allocatable, target :: study
    type(scene_type) :: there
    type(run_context_type) :: quiet
    type(error_type), allocatable :: error
    real(wp) :: value(size(scene%sample%parameter))

    call draw_member(scene, number, there, value, error)
    quiet = context
    quiet%log%silent = .true.
    nullify (quiet%listener)
    associate (member => self%member(number))
      member%name = 'seed '//text(there%bump_foil%random%seed)
      member%reason = ''
      if (stop_is_asked()) then
        member%status = stop_status()
        member%reason = 'not computed, '//stop_words()
      else
        allocate (study, mold=self%pattern)
        if (.not. allocated(error)) call study%prepare(there, quiet%log)
        if (.not. allocated(error)) call study%check(there, error)
        if (.not. allocated(error)) call study%solve(there, quiet, error)
        if (allocated(error)) then
          member%status = error%status
          member%reason = error%message
        else if (.not. study%converged) then
          member%status = merge(stop_status(), status_unconverged, study%reason%is_stop())
          member%reason = study%reason%words()
        end if
        self%unknowns = max(self%unknowns, study%unknowns)
        self%iterations = self%iterations + study%iterations
        self%factorizations = self%factorizations + study%factorizations
        self%factorizations_finest = self%factorizations_finest + study%factorizations_finest
      end if
      call add_result(member%row%quantity, 'seed', there%bump_foil%random%seed)
      call add_values(scene, value, member%row%quantity)
      call add_result(member%row%quantity, 'exit_status', member%status)
      if (member%status == 0) call add_numbers(study%found, member%row%quantity)
      call show_member(context, member, number, size(self%member))
    end associate
    if (allocated(study)) call study%discard()
  end subroutine solve_member

  !> A member: the scene with another seed, and values of its parameters that the seed chooses.
  !>
  !> Fails where the values break a rule together.
  subroutine draw_member(scene, number, member, value, error)
    type(scene_type), intent(in) :: scene !! what is asked for
    integer, intent(in) :: number !! of the member, from 1
    type(scene_type), intent(out) :: member !! what is asked of it
    real(wp), intent(out) :: value(:) !! [its unit] of each parameter
    type(error_type), allocatable, intent(out) :: error !! which rule is broken
    type(scene_type), allocatable :: there ! large

    member = sample_member(scene, number)
    associate (asked => scene%sample)
      value = asked%parameter%value*asked%factors**even_deviations( &
              member%bump_foil%random%seed, size(value))
      if (size(value) == 0) return
      allocate (there)
      call scene_with_keys(scene, asked%parameter, value, there, error)
      if (.not. allocated(error)) member = sample_member(there, number)
    end associate
  end subroutine draw_member

  !> Adds the values of the parameters.
  subroutine add_values(scene, value, list)
    type(scene_type), intent(in) :: scene
    real(wp), intent(in) :: value(:) !! [its unit]
    type(quantity_type), allocatable, intent(inout) :: list(:)
    character(len=:), allocatable :: name
    integer :: i, k

    do i = 1, size(value)
      associate (parameter => scene%sample%parameter(i))
        name = parameter%key%label()
        do k = 1, len(name)
          if (scan(name(k:k), '%()') > 0) name(k:k) = '_'
        end do
        call add_quantity(list, number_quantity('value_of_'//name, value(i), parameter%unit, &
                                                result_meaning('value_of_'//name, &
                                                               parameter%key%label())))
      end associate
    end do
  end subroutine add_values

  !> Adds what is a number.
  subroutine add_numbers(found, list)
    type(quantity_type), intent(in) :: found(:)
    type(quantity_type), allocatable, intent(inout) :: list(:)
    integer :: i

    do i = 1, size(found)
      if (found(i)%kind == quantity_word .or. found(i)%name == 'converged') cycle
      call add_quantity(list, found(i))
    end do
  end subroutine add_numbers

  !> A line for a member.
  subroutine show_member(context, member, number, members)
    type(run_context_type), intent(in) :: context
    type(table_member_type), intent(in) :: member
    integer, intent(in) :: number, members !! of the member; in all
    character(len=:), allocatable :: words
    integer :: i

    words = ''
    if (member%status /= 0) words = ': no answer: '//member%reason
    associate (found => member%row%quantity)
      do i = 1, size(found)
        if (all(found(i)%name /= [character(len=17) :: 'minimum_gap', 'loading_stiffness'])) cycle
        words = ': '//found(i)%name//' '//text(found(i)%number, 5)//' '//found(i)%unit
      end do
    end associate
    words = member%name//', member '//text(number)//' of '//text(members)//words
    call context%log%line(words)
    call context%point_done(words)
  end subroutine show_member

  !> Whether all members have an answer, and why not.
  subroutine judge(self)
    class(sample_type), intent(inout) :: self !! the study, with all members

    self%converged = all(self%member%status == 0)
    if (self%converged) return
    self%reason%code = reason_members
    if (any(self%member%status == status_machine)) self%reason%code = reason_failed
    self%reason%detail = text(count(self%member%status /= 0))//' of '//text(size(self%member))// &
                         ' members have no answer'
    if (stop_is_asked()) call self%reason%stopped()
  end subroutine judge

  !> Writes the members and their statistics.
  !>
  !> Fails when a file cannot be written.
  subroutine write_study(self, scene, context, summary, error)
    class(sample_type), target, intent(inout) :: self !! the study
    type(scene_type), intent(in) :: scene !! what is asked for
    type(run_context_type), intent(in) :: context !! of the run
    type(quantity_type), allocatable, intent(out) :: summary(:) !! what the summary says
    type(error_type), allocatable, intent(out) :: error !! why it failed
    real(wp) :: memory(1)

    memory = sum_over_ranks([peak_memory()])
    call write_sample(scene, context, self%member, self%reason, context%origin(), rank_count(), &
                      cost_type(self%unknowns, self%iterations, self%factorizations, &
                                self%factorizations_finest, wall_time() - context%start_time, &
                                memory(1)), summary, error)
  end subroutine write_study

  !> What the model leaves out, and why.
  function left_out_of_members(self, scene) result(words)
    class(sample_type), intent(in) :: self !! the study
    type(scene_type), intent(in) :: scene !! what is asked for
    character(len=:), allocatable :: words
    words = self%plan%left_out(scene)
  end function left_out_of_members

  !> Every member was discarded when it had its answer.
  subroutine discard_sample(self)
    class(sample_type), intent(inout) :: self !! the study
    if (allocated(self%plan)) deallocate (self%plan)
  end subroutine discard_sample
end module gfb_sample
