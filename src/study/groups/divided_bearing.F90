#include "gfb_petsc.h"
!> A bearing whose sweep, or whose frequencies, are divided among groups of ranks: a block each, one set of results.
!>
!> A sweep's block starts from nothing at its first point, where the sweep in one piece comes from the point before.
!> Whether both lead to the same answer is seen: every group but the last also follows its path to the first point of
!> the next one. With frequencies every group finds the same answer for itself, and vibrates about it with its own; the
!> first group also looks for the critical mass and the rotor's modes, so it has fewer.
module gfb_divided_bearing
  use petscsys
  use gfb_kinds, only: wp
  use gfb_text, only: text
  use gfb_archive, only: archive_type
  use gfb_quantity, only: quantity_type, place_of, number_in
  use gfb_result_names, only: compared_names, result_unit, add_result
  use gfb_result_table, only: with_stretches, name_length
  use gfb_scene, only: scene_type
  use gfb_case_file, only: history_row_type, case_array_type, visit_rows, visit_arrays
  use gfb_grid_series, only: grid_series_type, join_series, visit_series, cut_series
  use gfb_dynamics_record, only: dynamics_record_type, dynamics_point_type, visit_dynamics
  use gfb_tilt_response, only: tilt_axis
  use gfb_bearing_record, only: sweep_name, sweep_unit
  use gfb_reasons, only: reason_type, reason_failed, status_unconverged
  use gfb_errors, only: error_type
  use gfb_division, only: block_ends
  use gfb_run_log, only: run_log_type
  use gfb_c_library, only: peak_memory
  use gfb_petsc_session, only: wall_time
  use gfb_bearing_summary, only: cost_type
  use gfb_bearing_writing, only: record_arrays, bearing_result_type, write_bearing
  use gfb_restart_file, only: drop_restart
  use gfb_provenance, only: version_text
  use gfb_run_context, only: run_context_type
  use gfb_bearing_study, only: bearing_study_type
  use gfb_sweep_study, only: sweep_study_type
  use gfb_pool, only: pool_type, group_log_path, end_log
  implicit none (type)
  private
  public :: visit_block, merge_histories, merge_frequencies, run_divided_bearing

  !> Two paths to one answer differ by less, over the clearance [1].
  real(wp), parameter :: same_answer = 1.0e-5_wp
  character(len=1), parameter :: axes(2) = ['x', 'y']
  character(len=*), parameter :: secants(2) = 'secant_stiffness_'//axes

  !> What a group has found.
  type, public :: bearing_block_type
    !> numbers of its values in the whole sweep, or of its frequencies
    integer :: first = 1, last = 0
    integer :: status = 0          !! exit status that gfb would have had
    !> Newton iterations, factorizations, those of the finest mesh's matrix
    integer :: count(3) = 0
    type(reason_type) :: reason    !! why it ended before its last value, or has no answer
    type(history_row_type), allocatable :: row(:)  !! its points
    !> The first point of the block behind, from its own last one; none where there is none.
    type(history_row_type), allocatable :: next(:)
    type(case_array_type), allocatable :: contacts(:)
    real(wp) :: first_slope(2, 2) = 0.0_wp     !! where it begins [N m/rad]
    type(dynamics_record_type) :: dynamics !! coefficients at its points, onset of whirl
    type(grid_series_type) :: series       !! film and foils at its points
  end type bearing_block_type

contains

  !> Saves or restores a block.
  pure subroutine visit_block(archive, block)
    type(archive_type), intent(inout) :: archive !! that saves or restores
    type(bearing_block_type), intent(inout) :: block !! written where the archive restores

    call archive%visit('first', block%first)
    call archive%visit('last', block%last)
    call archive%visit('status', block%status)
    call archive%visit('count', block%count)
    call archive%visit('reason_code', block%reason%code)
    call archive%visit('reason_at', block%reason%at)
    call archive%visit('reason_of', block%reason%of)
    call archive%visit('reason_shown', block%reason%shown)
    call archive%visit('reason_gave_up', block%reason%gave_up)
    call archive%visit('reason_detail', block%reason%detail)
    call archive%part('row')
    call visit_rows(archive, block%row)
    call archive%part('next')
    call visit_rows(archive, block%next)
    call archive%part('contacts')
    call visit_arrays(archive, block%contacts)
    call archive%visit('first_slope', block%first_slope)
    call archive%part('dynamics')
    call visit_dynamics(archive, block%dynamics)
    call archive%part('series')
    call visit_series(archive, block%series)
  end subroutine visit_block

  !> All rows in the sweep's order, counts from the sweep's first point on.
  subroutine merge_histories(scene, blocks, history)
    type(scene_type), intent(in) :: scene !! with the whole sweep
    type(bearing_block_type), intent(in) :: blocks(:) !! in the sweep's order
    type(history_row_type), allocatable, intent(out) :: history(:) !! one row a point
    type(history_row_type) :: row
    integer :: i, k, before(2)

    allocate (history(0))
    before = 0
    do i = 1, size(blocks)
      do k = 1, size(blocks(i)%row)
        row = blocks(i)%row(k)
        call add_to(row, 'newton_iterations', before(1))
        call add_to(row, 'factorizations', before(2))
        if (k == 1 .and. parts(scene, blocks, i)) call add_to(row, 'branch_changed', 1)
        if (size(history) > 0) call match_secants(tilt_axis(scene%sweep), history(1), row)
        history = [history, row]
      end do
      before = before + blocks(i)%count(:2)
    end do
  end subroutine merge_histories

  !> Whether a block begins with another answer than that to which the one before leads.
  function parts(scene, blocks, number)
    type(scene_type), intent(in) :: scene
    type(bearing_block_type), intent(in) :: blocks(:)
    integer, intent(in) :: number !! of the block
    logical :: parts

    parts = .false.
    if (number < 2) return
    if (.not. allocated(blocks(number - 1)%next)) return
    parts = seam_words(scene, blocks(number - 1), blocks(number)) /= ''
  end function parts

  !> Adds to a row's count, or says that something is true.
  pure subroutine add_to(row, name, number)
    type(history_row_type), intent(inout) :: row
    character(len=*), intent(in) :: name
    integer, intent(in) :: number
    integer :: place

    place = place_of(name, row%quantity)
    if (place > 0) row%quantity(place)%number = row%quantity(place)%number + real(number, wp)
  end subroutine add_to

  !> Measures a row's secant stiffness from the torque without tilt that the sweep's first point
  !> knows, as a sweep in one piece does; none where it does not know it.
  subroutine match_secants(axis, first, row)
    integer, intent(in) :: axis !! that the sweep tilts about: 1 is x, 2 is y, 0 none
    type(history_row_type), intent(in) :: first
    type(history_row_type), intent(inout) :: row
    type(quantity_type), allocatable :: kept(:)
    type(quantity_type) :: new
    real(wp) :: tilt, untilted
    integer :: i, torque

    if (axis == 0) return
    allocate (kept(0))
    do i = 1, size(row%quantity)
      if (all(row%quantity(i)%name /= secants)) kept = [kept, row%quantity(i)]
    end do
    do i = 1, size(first%quantity)
      torque = findloc(secants == first%quantity(i)%name, .true., 1)
      if (torque == 0) cycle
      new = first%quantity(i)
      ! The torque without tilt stands in the first row's secant, or is the first row's torque.
      tilt = number_in(first%quantity, 'tilt_'//axes(axis))
      untilted = number_in(first%quantity, 'torque_'//axes(torque))
      if (abs(tilt) > 0.0_wp) untilted = untilted - tilt*new%number
      tilt = number_in(row%quantity, 'tilt_'//axes(axis))
      if (abs(tilt) > 0.0_wp) then
        new%number = (number_in(row%quantity, 'torque_'//axes(torque)) - untilted)/tilt
      else
        new%number = number_in(row%quantity, 'angular_stiffness_'//axes(torque)//axes(axis))
      end if
      kept = [kept, new]
    end do
    call move_alloc(kept, row%quantity)
  end subroutine match_secants

  !> The contacts of all points in the sweep's order.
  subroutine merge_arrays(blocks, arrays)
    type(bearing_block_type), intent(in) :: blocks(:) !! in the sweep's order
    type(case_array_type), allocatable, intent(out) :: arrays(:) !! with all points
    real(wp), allocatable :: values(:, :)
    integer :: i, k, columns, rows

    allocate (arrays(0))
    do i = 1, size(blocks)
      if (size(arrays) == 0) then
        arrays = blocks(i)%contacts
        cycle
      end if
      do k = 1, size(blocks(i)%contacts)
        if (.not. arrays(k)%by_step) cycle
        associate (more => blocks(i)%contacts(k)%values)
          columns = size(more, 1)
          rows = size(arrays(k)%values, 2)
          allocate (values(columns, rows + size(more, 2)))
          values(:, :rows) = arrays(k)%values
          values(:, rows + 1:) = more
        end associate
        call move_alloc(values, arrays(k)%values)
      end do
    end do
  end subroutine merge_arrays

  !> Film and foils at all points in the sweep's order.
  pure subroutine merge_series(blocks, series)
    type(bearing_block_type), intent(in) :: blocks(:) !! in the sweep's order
    type(grid_series_type), intent(out) :: series !! of all points
    integer :: i

    do i = 1, size(blocks)
      call join_series(series, blocks(i)%series)
    end do
  end subroutine merge_series

  !> Coefficients of all points, and the first onset of whirl that any block has seen.
  pure subroutine merge_dynamics(blocks, record)
    type(bearing_block_type), intent(in) :: blocks(:) !! in the sweep's order
    type(dynamics_record_type), intent(inout) :: record !! of one of them, gets those of all
    type(dynamics_point_type), allocatable :: all(:)
    integer :: i

    record%onset = 0.0_wp
    do i = size(blocks), 1, -1
      if (blocks(i)%dynamics%onset > 0.0_wp) record%onset = blocks(i)%dynamics%onset
    end do
    if (.not. allocated(record%point)) return
    allocate (all(0))
    do i = 1, size(blocks)
      if (allocated(blocks(i)%dynamics%point)) all = [all, blocks(i)%dynamics%point]
    end do
    call move_alloc(all, record%point)
  end subroutine merge_dynamics

  !> Coefficients at all frequencies in their order; what else was found is the first block's.
  pure subroutine merge_frequencies(blocks, point)
    type(bearing_block_type), intent(in) :: blocks(:) !! each with an answer
    type(dynamics_point_type), intent(inout) :: point !! the first block's, gets all frequencies
    complex(wp), allocatable :: coefficient(:, :, :)
    integer :: i, first, last

    point%frequency = [(blocks(i)%dynamics%point(1)%frequency, i=1, size(blocks))]
    associate (old => point%coefficient)
      allocate (coefficient(size(old, 1), size(old, 2), size(point%frequency)))
    end associate
    first = 1
    do i = 1, size(blocks)
      associate (part => blocks(i)%dynamics%point(1)%coefficient)
        last = first + size(part, 3) - 1
        coefficient(:, :, first:last) = part
      end associate
      first = last + 1
    end do
    call move_alloc(coefficient, point%coefficient)
  end subroutine merge_frequencies

  !> Adds how the sweep was divided, and whether its blocks meet.
  subroutine add_origin(scene, groups, blocks, list)
    type(scene_type), intent(in) :: scene          !! with the whole sweep
    integer, intent(in) :: groups                  !! of ranks
    type(bearing_block_type), intent(in) :: blocks(:) !! in the sweep's order
    type(quantity_type), allocatable, intent(inout) :: list(:) !! what the files say of their origin
    character(len=:), allocatable :: words
    integer :: i

    words = 'all begin with the answer to which the stretch before leads'
    do i = 2, size(blocks)
      if (seam_words(scene, blocks(i - 1), blocks(i)) /= '') words = 'not all begin with '// &
                                                    'the answer to which the stretch before leads'
    end do
    call add_result(list, 'groups', groups, with_stretches)
    if (groups > 1) call add_result(list, 'stretches', words)
  end subroutine add_origin

  !> What is to be said of the seam between two blocks; nothing where the first leads to the same
  !> answer as that with which the second begins.
  function seam_words(scene, before, behind) result(words)
    type(scene_type), intent(in) :: scene !! with the whole sweep
    type(bearing_block_type), intent(in) :: before, behind !! the seam
    character(len=:), allocatable :: words
    character(len=name_length), allocatable :: compared(:)
    real(wp) :: one, other, difference
    integer :: i

    words = ''
    if (before%status /= 0 .or. size(behind%row) == 0) return
    if (size(before%next) == 0) then
      words = 'the path from the point before finds no answer at '// &
        place_text(scene, behind%first)//': without groups the sweep would have ended there'
      return
    end if
    compared = compared_names()
    do i = 1, size(compared)
      one = number_in(before%next(1)%quantity, trim(compared(i)))
      other = number_in(behind%row(1)%quantity, trim(compared(i)))
      difference = abs(other - one)
      if (result_unit(trim(compared(i))) == 'm') difference = difference/scene%bearing%clearance
      if (difference <= same_answer) cycle
      words = 'another answer than a sweep without groups from '// &
        place_text(scene, behind%first)//' on: there '//trim(compared(i))//' is '//text(one)// &
        ' on the path from the point before, and '//text(other)//' as it was found'
      return
    end do
  end function seam_words

  !> A point of the sweep in words.
  function place_text(scene, point) result(words)
    type(scene_type), intent(in) :: scene !! with the whole sweep
    integer, intent(in) :: point !! number of the value
    character(len=:), allocatable :: words

    words = sweep_name(scene%sweep)//' = '//text(scene%sweep%values(point))//' '// &
            sweep_unit(scene%sweep)
  end function place_text

  !> Computes the blocks side by side, and writes what they have found as one.
  subroutine run_divided_bearing(scene, context, pool, status)
    type(scene_type), intent(in) :: scene !! with the whole sweep, or all frequencies
    type(run_context_type), intent(in) :: context !! of the job; its log is the terminal
    type(pool_type), target, intent(inout) :: pool !! whose groups compute
    integer, intent(out) :: status !! exit status of the program
    class(bearing_study_type), allocatable, target :: study
    type(run_context_type) :: own
    type(bearing_block_type), allocatable :: mine, blocks(:)
    type(error_type), allocatable :: error
    real(wp) :: memory(1)
    integer :: writer, ends(2)

    if (scene%sweep%present) then
      allocate (sweep_study_type :: study)
    else
      allocate (bearing_study_type :: study)
    end if
    allocate (mine)
    call show_division(scene, context, pool)
    ends = ends_of(scene, pool%groups, pool%group)
    pool%total = pool%groups
    pool%counted = 0
    if (scene%sweep%present) pool%total = size(scene%sweep%values)
    own = context
    call pool%begin_log(group_log_path(context%folder, scene%name, pool%group), own, error)
    if (.not. allocated(error)) call compute(scene, pool, ends, own, study, mine, error)
    if (allocated(error)) call log_failure(pool, error, mine)
    mine%first = ends(1)
    mine%last = ends(2)
    call report_end(scene, pool, mine, allocated(error))
    if (scene%sweep%present) then ! with the last state that there is as the sweep's
      writer = pool%largest(merge(0, pool%group, allocated(error)))
    else ! with the critical mass
      writer = pool%largest(merge(1, 0, pool%group == 1 .and. .not. allocated(error)))
    end if
    memory = pool%total_of([peak_memory()])
    if (writer > 0) then
      call gather(pool, writer, mine, blocks)
      if (pool%group == writer) call write_all(scene, context, pool, memory(1), study, blocks, mine%status)
    end if
    status = pool%largest(mine%status)
    if (status == 0) call drop_restart(own%restart)
    call own%give_back()
    call end_log(own%log)
    call study%discard()
  end subroutine run_divided_bearing

  !> Numbers of the first and last value, or frequency, of a group.
  pure function ends_of(scene, groups, group) result(ends)
    type(scene_type), intent(in) :: scene
    integer, intent(in) :: groups, group !! of the job; from 1
    integer :: ends(2)

    if (scene%sweep%present) then
      ends = block_ends(size(scene%sweep%values), groups, group)
    else
      ends = block_ends(size(scene%dynamics%frequencies), groups, group)
    end if
  end function ends_of

  !> Which group has what.
  subroutine show_division(scene, context, pool)
    type(scene_type), intent(in) :: scene
    type(run_context_type), intent(in) :: context
    type(pool_type), intent(in) :: pool
    character(len=:), allocatable :: words
    integer :: group, ends(2), ranks(2)

    call pool%show(scene, context, '')
    associate (log => context%log, number => scene%dynamics%frequencies)
      do group = 1, pool%groups
        ends = ends_of(scene, pool%groups, group)
        ranks = block_ends(pool%ranks, pool%groups, group)
        if (scene%sweep%present) then
          words = place_text(scene, ends(1))//' to '//place_text(scene, ends(2))//', '//text(ends(2) - ends(1) + 1)//' point(s)'
        else
          words = text(number(ends(1)))//' to '//text(number(ends(2)))//' rad/s, '//text(ends(2) - ends(1) + 1)//' frequencies'
        end if
        call log%line('group '//text(group)//': '//text(ranks(2) - ranks(1) + 1)//' rank(s), '//words//', log '// &
                      group_log_path(context%folder, scene%name, group))
      end do
      if (.not. scene%sweep%present) then
        call log%line('every group finds the answer about which the shaft vibrates')
      else if (pool%groups == 1) then
        return
      else if (scene%sweep%hold_position) then
        call log%line('every group finds the equilibrium at which the shaft is fixed, and sweeps from there')
      else
        call log%line('the first point of every group starts from nothing, not from the point before')
      end if
      call log%line('')
    end associate
  end subroutine show_division

  !> This group's block; of a sweep also the first point of the next one, for comparison.
  subroutine compute(scene, pool, ends, context, study, mine, error)
    type(scene_type), intent(in) :: scene
    type(pool_type), intent(inout) :: pool
    integer, intent(in) :: ends(2) !! of the block
    type(run_context_type), intent(inout) :: context !! of this group
    class(bearing_study_type), target, intent(inout) :: study
    type(bearing_block_type), intent(inout) :: mine
    type(error_type), allocatable, intent(out) :: error
    type(scene_type) :: own

    own = scene
    ! What it may write while it runs is its own, and that of as many groups.
    own%name = scene%name//'.group'//text(pool%group)//'of'//text(pool%groups)
    associate (log => context%log)
      call log%line(version_text())
      call log%line(scene%file//': '//scene%general%title)
      call study%prepare(scene, log)
      if (scene%sweep%present) then
        own%sweep%values = scene%sweep%values(ends(1):min(ends(2) + 1, size(scene%sweep%values)))
        pool%counted = ends(2) - ends(1) + 1
        call log%line('group '//text(pool%group)//' of '//text(pool%groups)//': points '//text(ends(1))//' to '//text(ends(2)))
        if (size(own%sweep%values) > pool%counted) then
          call log%line('its last point here is the next group''s first, to see that both find the same')
        end if
      else
        own%dynamics%frequencies = scene%dynamics%frequencies(ends(1):ends(2))
        if (size(scene%dynamics%ratios) > 0) own%dynamics%ratios = scene%dynamics%ratios(ends(1):ends(2))
        own%dynamics%stability = pool%group == 1
      end if
    end associate
    call study%check(scene, error)
    if (.not. allocated(error)) call context%take_case(own%name, error)
    if (.not. allocated(error)) call context%find_restart(own, error)
    if (allocated(error)) return
    call context%log%heading('solution')
    call study%solve(own, context, error)
    if (.not. allocated(error)) call take_block(study, ends(2) - ends(1) + 1, mine)
  end subroutine compute

  !> What a study has found of a block.
  subroutine take_block(study, points, block)
    class(bearing_study_type), intent(in) :: study
    integer, intent(in) :: points !! of the block, where it is one of a sweep
    type(bearing_block_type), intent(inout) :: block
    integer :: found
    logical :: whole

    block%count = [study%iterations, study%factorizations, study%factorizations_finest]
    whole = study%converged
    associate (solution => study%solution)
      block%dynamics = solution%record%dynamics
      block%first_slope = solution%record%tilted%first_slope
      if (solution%scene%sweep%present) then
        found = min(size(solution%record%history), points)
        whole = found == points
        block%row = solution%record%history(:found)
        block%next = solution%record%history(found + 1:)
        block%contacts = record_arrays(solution%scene, solution%bearing, solution%record, found)
        if (allocated(block%dynamics%point)) block%dynamics%point = block%dynamics%point(:found)
        block%series = solution%record%series
        call cut_series(block%series, found)
      end if
    end associate
    if (whole) return
    block%status = status_unconverged
    block%reason = study%reason
  end subroutine take_block

  !> A group that has failed: it says why, and has found nothing.
  subroutine log_failure(pool, error, mine)
    type(pool_type), intent(in) :: pool
    type(error_type), intent(in) :: error
    type(bearing_block_type), intent(out) :: mine
    type(run_log_type) :: terminal

    mine%status = error%status
    mine%reason%code = reason_failed
    mine%reason%detail = error%message
    allocate (mine%row(0), mine%next(0), mine%contacts(0))
    terminal%active = pool%leads
    call terminal%complaint('group '//text(pool%group)//': '//error%message)
  end subroutine log_failure

  !> Says on the terminal how a group has ended; the points of a sweep say it themselves while they last.
  subroutine report_end(scene, pool, mine, failed)
    type(scene_type), intent(in) :: scene
    type(pool_type), intent(in) :: pool
    type(bearing_block_type), intent(in) :: mine
    logical, intent(in) :: failed !! it has found nothing

    if (.not. scene%sweep%present) then
      call pool%report(trim(merge('done     ', 'no answer', mine%status == 0)), 1)
    else if (failed) then
      call pool%report('failed', mine%last - mine%first + 1)
    else if (mine%status /= 0) then
      call pool%report('no answer at '//place_text(scene, mine%first + size(mine%row)), mine%last - mine%first + 1 - size(mine%row))
    end if
  end subroutine report_end

  !> Brings all blocks to one group.
  subroutine gather(pool, writer, mine, blocks)
    type(pool_type), intent(in) :: pool
    integer, intent(in) :: writer !! the group
    type(bearing_block_type), intent(inout) :: mine
    type(bearing_block_type), allocatable, intent(out) :: blocks(:) !! nothing in the other groups
    type(archive_type) :: archive
    type(archive_type), allocatable :: sent(:)
    integer :: i

    call visit_block(archive, mine)
    call pool%gather(archive, writer, sent)
    allocate (blocks(size(sent)))
    do i = 1, size(blocks)
      call visit_block(sent(i), blocks(i))
      call sent(i)%finish()
      if (sent(i)%failed) error stop 'what a group of ranks has sent is no block'
    end do
  end subroutine gather

  !> Writes all blocks, with this group's last state as that of all, and tells the terminal.
  subroutine write_all(scene, context, pool, memory, study, blocks, status)
    type(scene_type), intent(in) :: scene
    type(run_context_type), intent(in) :: context
    type(pool_type), intent(in) :: pool
    real(wp), intent(in) :: memory !! of all ranks [B]
    class(bearing_study_type), target, intent(inout) :: study
    type(bearing_block_type), intent(in) :: blocks(:)
    integer, intent(inout) :: status
    type(run_context_type) :: terminal
    type(bearing_result_type) :: result
    type(quantity_type), allocatable :: summary(:)
    type(error_type), allocatable :: error

    terminal = context
    terminal%log%active = pool%leads
    if (.not. scene%sweep%present) terminal%log%verbose = .false.
    call terminal%take_case(scene%name, error)
    if (.not. allocated(error)) then
      result%converged = all(blocks%status == 0)
      result%reason = reason_of(blocks)
      result%plan = study%plan
      result%cost = cost_type(study%unknowns, sum(blocks%count(1)), sum(blocks%count(2)), sum(blocks%count(3)), &
                              wall_time() - pool%begun, memory)
      result%ranks = pool%ranks
      result%origin = pool%origin(context)
      associate (record => study%solution%record)
        if (scene%sweep%present) then
          call add_origin(scene, pool%groups, blocks, result%origin)
          call merge_arrays(blocks, result%contacts)
          call merge_histories(scene, blocks, record%history)
          call merge_dynamics(blocks, record%dynamics)
          call merge_series(blocks, record%series)
          record%tilted%first_slope = blocks(1)%first_slope
        else
          call add_result(result%origin, 'groups', pool%groups)
          if (result%converged) call merge_frequencies(blocks, record%dynamics%point(1))
          result%contacts = record_arrays(scene, study%solution%bearing, record, size(record%history))
        end if
        call write_bearing(scene, terminal, study%solution, result, summary, error)
      end associate
    end if
    call terminal%give_back()
    call show_failures(scene, blocks, terminal%log)
    if (.not. allocated(error)) return
    status = max(status, error%status)
    call terminal%log%complaint(error%message)
  end subroutine write_all

  !> Why not all blocks have their answers: the first one that has none says it, or one that was stopped.
  pure function reason_of(blocks) result(reason)
    type(bearing_block_type), intent(in) :: blocks(:)
    type(reason_type) :: reason
    integer :: i

    do i = size(blocks), 1, -1
      if (blocks(i)%status /= 0 .and. .not. reason%is_stop()) reason = blocks(i)%reason
      if (blocks(i)%reason%is_stop()) reason = blocks(i)%reason
    end do
  end function reason_of

  !> Which blocks end early, and why; and where those of a sweep do not fit together.
  subroutine show_failures(scene, blocks, log)
    type(scene_type), intent(in) :: scene
    type(bearing_block_type), intent(in) :: blocks(:)
    type(run_log_type), intent(in) :: log
    character(len=:), allocatable :: words
    integer :: i, missing

    do i = 1, size(blocks)
      associate (one => blocks(i))
        if (one%status == 0) cycle
        if (scene%sweep%present) call log%line('')
        call log%line('group '//text(i)//': '//one%reason%words())
        if (.not. scene%sweep%present) cycle
        missing = one%last - one%first + 1 - size(one%row)
        call log%line('  missing: '//place_text(scene, one%first + size(one%row))//' to '// &
                      place_text(scene, one%last)//', '//text(missing)//' point(s)')
      end associate
    end do
    if (.not. scene%sweep%present) return
    do i = 2, size(blocks)
      words = seam_words(scene, blocks(i - 1), blocks(i))
      if (words /= '') call log%warning('group '//text(i)//': '//words)
    end do
  end subroutine show_failures
end module gfb_divided_bearing
