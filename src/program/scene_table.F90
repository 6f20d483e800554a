#include "gfb_petsc.h"
!> Several scenes side by side: every group of ranks takes the next one that is left.
module gfb_scene_table
  use petscsys
  use gfb_archive, only: archive_type
  use gfb_errors, only: error_type, fail
  use gfb_text, only: text
  use gfb_run_log, only: run_log_type
  use gfb_quantity, only: quantity_type, count_quantity, word_quantity, add_quantity
  use gfb_results, only: add_result
  use gfb_result_phrases, only: of_whole_table
  use gfb_scene, only: scene_type
  use gfb_case_file, only: summary_text
  use gfb_text_file, only: table_member_type, write_table_file, write_unfinished_text
  use gfb_file_set, only: unfinished_file_type, publish, drop_unfinished
  use gfb_result_file, only: result_file_type
  use gfb_signals, only: stop_words
  use gfb_petsc_session, only: wall_time, stop_is_asked
  use gfb_pool, only: pool_type, visit_task, end_log
  use gfb_run_context, only: run_context_type
  use gfb_study, only: study_type
  use gfb_provenance, only: version_text
  implicit none (type)
  private
  public :: run_scene_table, scene_runner

  integer, parameter :: status_unconverged = 2

  abstract interface
    !> Computes and writes what one scene asks for. Fails on files that cannot be written.
    subroutine scene_runner(scene, branches, context, study, summary, error)
      import :: scene_type, run_context_type, study_type, quantity_type, error_type
      type(scene_type), intent(in) :: scene !! what the case file asks for
      logical, intent(in) :: branches !! all equilibria are looked for
      type(run_context_type), intent(inout) :: context !! of the run
      class(study_type), allocatable, intent(out) :: study !! that was done
      type(quantity_type), allocatable, intent(out) :: summary(:) !! what was written of the answer
      type(error_type), allocatable, intent(out) :: error !! why it failed
    end subroutine scene_runner
  end interface

contains

  !> Computes all members, each of which writes its own files, and writes their table.
  subroutine run_scene_table(scenes, name, run_scene, context, pool, status)
    type(scene_type), intent(in) :: scenes(:) !! the members
    character(len=*), intent(in) :: name          !! of the table
    procedure(scene_runner) :: run_scene          !! computes a member
    type(run_context_type), intent(in) :: context !! of the job; its log is the terminal
    type(pool_type), target, intent(inout) :: pool !! that is divided
    integer, intent(out) :: status                !! exit status of the program

    type(archive_type) :: mine
    type(table_member_type), allocatable :: members(:)
    type(error_type), allocatable :: error
    type(run_log_type) :: log
    integer :: number

    log = context%log
    call log%line(version_text())
    call log%line(text(size(scenes))//' cases, results go to '//context%folder//', '//text(pool%ranks)// &
                  ' rank(s) in '//text(pool%groups)//' group(s), a log for each case as CASE.log')
    status = 0
    allocate (members(size(scenes)))
    pool%total = size(scenes)
    call pool%next_task(number)
    do while (number <= size(scenes))
      call run_member(scenes(number), run_scene, context, pool, members(number))
      status = max(status, members(number)%status)
      call visit_task(mine, members, number)
      call pool%next_task(number)
    end do
    call pool%gather_tasks(mine, 1, members)
    if (pool%rank == 0) then
      call write_table(members, scenes, name, context, pool, error)
      call show_failures(members, log)
      if (allocated(error)) then
        call log%complaint(error%message)
        status = max(status, error%status)
      end if
    end if
    status = pool%largest(status)
  end subroutine run_scene_table

  !> One member from its case to its files.
  subroutine run_member(scene, run_scene, context, pool, member)
    type(scene_type), intent(in) :: scene
    procedure(scene_runner) :: run_scene
    type(run_context_type), intent(in) :: context
    type(pool_type), target, intent(inout) :: pool
    type(table_member_type), intent(out) :: member
    class(study_type), allocatable :: study
    type(quantity_type), allocatable :: answer(:)
    type(error_type), allocatable :: error
    type(run_context_type) :: own

    own = context
    call pool%begin_log(context%folder//'/'//scene%name//'.log', own, error)
    if (.not. allocated(error)) then
      if (stop_is_asked()) call fail(error, 'not computed, '//stop_words(), status_unconverged)
    end if
    if (.not. allocated(error)) then
      own%start_time = wall_time()
      call run_scene(scene, .false., own, study, answer, error)
    end if
    member%name = scene%name
    member%group = pool%group
    member%reason = ''
    if (allocated(error)) then
      call own%log%complaint(error%message)
      member%status = error%status
      member%reason = error%message
      call pool%report(scene%name//' failed', 1)
    else if (study%converged) then
      call pool%report(scene%name, 1)
    else
      member%status = status_unconverged
      member%reason = study%reason%words()
      call pool%report(scene%name//' has no answer', 1)
    end if
    if (.not. allocated(answer)) call add_result(answer, 'converged', .false.)
    call add_result(member%row%quantity, 'exit_status', member%status)
    call add_result(member%row%quantity, 'group', member%group)
    call add_quantity(member%row%quantity, answer)
    call end_log(own%log)
  end subroutine run_member

  !> Writes the table and its summary; older ones are replaced when both are whole.
  !>
  !> Fails when they cannot be written.
  subroutine write_table(members, scenes, name, context, pool, error)
    type(table_member_type), intent(in) :: members(:)
    type(scene_type), intent(in) :: scenes(:)
    character(len=*), intent(in) :: name
    type(run_context_type), intent(in) :: context
    type(pool_type), intent(in) :: pool
    type(error_type), allocatable, intent(out) :: error
    type(quantity_type), allocatable :: summary(:)
    type(result_file_type) :: file
    type(unfinished_file_type) :: files(2)
    character(len=:), allocatable :: stem
    integer :: i

    call add_result(summary, 'members', size(members))
    call add_result(summary, 'converged_members', count(members%status == 0))
    call add_result(summary, 'groups', pool%groups)
    call add_result(summary, 'ranks', pool%ranks)
    call add_result(summary, 'wall_time', wall_time() - pool%begun, of_whole_table)
    do i = 1, size(members)
      call add_result(summary, 'member_'//text(i), outcome(members(i)), scenes(i)%file)
    end do
    stem = context%folder//'/'//name
    call write_table_file(stem//'.h5', MPI_COMM_SELF, context%origin(), summary, members, &
                          file, error)
    files(1) = file%written
    if (.not. allocated(error)) call write_unfinished_text(stem//'.summary', summary_text(summary), files(2), error)
    if (.not. allocated(error)) call publish(files, error)
    do i = 1, size(files)
      call drop_unfinished(files(i))
    end do
    if (allocated(error)) return
    call context%log%line('')
    call context%log%tell('table of all cases: '//stem//'.summary, .h5')
  end subroutine write_table

  !> How a member ended.
  pure function outcome(member) result(words)
    type(table_member_type), intent(in) :: member
    character(len=:), allocatable :: words

    words = member%name//': done'
    if (member%status == status_unconverged) words = member%name//': no answer'
    if (member%status /= 0 .and. member%status /= status_unconverged) words = member%name//': failed'
    if (member%reason /= '') words = words//' ('//one_line(member%reason)//')'
  end function outcome

  !> A text without line ends.
  pure function one_line(words) result(flat)
    character(len=*), intent(in) :: words
    character(len=len(words)) :: flat
    integer :: i

    flat = words
    do i = 1, len(words)
      if (words(i:i) == new_line('a')) flat(i:i) = ' '
    end do
  end function one_line

  !> The members that have no answer, and why.
  subroutine show_failures(members, log)
    type(table_member_type), intent(in) :: members(:)
    type(run_log_type), intent(in) :: log
    integer :: i, failed

    failed = count(members%status /= 0)
    if (failed == 0) return
    call log%tell(text(failed)//' of '//text(size(members))//' without an answer:')
    do i = 1, size(members)
      if (members(i)%status /= 0) call log%tell('  '//outcome(members(i)))
    end do
  end subroutine show_failures
end module gfb_scene_table
