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
  use gfb_quantity, only: quantity_type
  use gfb_result_names, only: add_result
  use gfb_scene, only: scene_type
  use gfb_grid_series, only: cut_series
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
  use gfb_bearing_blocks, only: group_result_type, visit_block, merge_histories, merge_arrays, merge_series, merge_dynamics, &
       merge_frequencies, add_origin, seam_words, place_text
  implicit none (type)
  private
  public :: run_divided_bearing

contains

  !> Computes the blocks side by side, and writes what they have found as one.
  subroutine run_divided_bearing(scene, context, pool, status)
    type(scene_type), intent(in) :: scene !! with the whole sweep, or all frequencies
    type(run_context_type), intent(in) :: context !! of the job; its log is the terminal
    type(pool_type), target, intent(inout) :: pool !! whose groups compute
    integer, intent(out) :: status !! exit status of the program
    class(bearing_study_type), allocatable, target :: study
    type(run_context_type), allocatable :: own
    type(group_result_type), allocatable :: mine, blocks(:)
    type(error_type), allocatable :: error
    real(wp) :: memory(1)
    integer :: writer, ends(2)

    call choose_study(scene, study)
    allocate (mine)
    call show_division(scene, context, pool)
    ends = ends_of(scene, pool%groups, pool%group)
    pool%total = pool%groups
    pool%counted = 0
    if (scene%sweep%present) pool%total = size(scene%sweep%values)
    allocate (own, source=context)
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

  !> The study that a scene asks for.
  subroutine choose_study(scene, study)
    type(scene_type), intent(in) :: scene
    class(bearing_study_type), allocatable, intent(out) :: study

    if (scene%sweep%present) then
      allocate (sweep_study_type :: study)
    else
      allocate (bearing_study_type :: study)
    end if
  end subroutine choose_study

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
    type(group_result_type), intent(inout) :: mine
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
    type(group_result_type), intent(inout) :: block
    integer :: found
    logical :: whole

    block%iterations = study%iterations
    block%factorizations = study%factorizations
    block%factorizations_finest = study%factorizations_finest
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
    type(group_result_type), intent(out) :: mine
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
    type(group_result_type), intent(in) :: mine
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
    type(group_result_type), intent(inout) :: mine
    type(group_result_type), allocatable, intent(out) :: blocks(:) !! nothing in the other groups
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

  !> Writes all blocks, with this group's last state as that of all, and says so on the terminal.
  subroutine write_all(scene, context, pool, memory, study, blocks, status)
    type(scene_type), intent(in) :: scene
    type(run_context_type), intent(in) :: context
    type(pool_type), intent(in) :: pool
    real(wp), intent(in) :: memory !! of all ranks [B]
    class(bearing_study_type), target, intent(inout) :: study
    type(group_result_type), intent(in) :: blocks(:)
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
      result%cost = cost_type(study%unknowns, sum(blocks%iterations), sum(blocks%factorizations), sum(blocks%factorizations_finest), &
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
        call write_bearing(scene, terminal, study%solution, study%answer, result, summary, error)
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
    type(group_result_type), intent(in) :: blocks(:)
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
    type(group_result_type), intent(in) :: blocks(:)
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
