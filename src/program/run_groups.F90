#include "gfb_petsc.h"
!> A job whose ranks are divided into groups: what is asked of them is checked, and then computed.
module gfb_run_groups
  use petscsys
  use gfb_kinds, only: wp
  use gfb_archive, only: archive_type
  use gfb_errors, only: error_type, fail, status_machine
  use gfb_text, only: text, one_line
  use gfb_run_log, only: run_log_type
  use gfb_quantity, only: quantity_type, add_quantity
  use gfb_result_names, only: add_result
  use gfb_result_table, only: of_whole_table
  use gfb_scene, only: scene_type
  use gfb_case_file, only: summary_text
  use gfb_text_file, only: table_member_type, write_table_file, write_unfinished_text
  use gfb_file_set, only: unfinished_file_type, case_lock_type, publish, drop_unfinished, lock_case, unlock_case
  use gfb_result_file, only: result_file_type
  use gfb_signals, only: stop_words, stop_status, agree_on_signal, agreed_signal
  use gfb_petsc_session, only: wall_time, stop_is_asked
  use gfb_pool, only: pool_type, visit_task, end_log, group_log_path
  use gfb_run_context, only: run_context_type, prepare_folder
  use gfb_study, only: study_type
  use gfb_reasons, only: status_unconverged
  use gfb_outcome, only: add_outcome
  use gfb_provenance, only: version_text
  use gfb_machine_memory, only: start_blas
  use gfb_scene_reading, only: read_scene
  use gfb_command_line, only: command_line_type
  use gfb_check_scene, only: check_scene
  use gfb_foil_plan, only: choose_solution
  use gfb_sample, only: sample_type, write_sample
  use gfb_studies, only: create_study, run_scene
  use gfb_divided_bearing, only: run_divided_bearing
  use gfb_bearing_summary, only: cost_type
  use gfb_c_library, only: peak_memory
  implicit none (type)
  private
  public :: run_groups

  integer, parameter :: writer = 1 !! the group that writes

contains

  !> Computes all members, each of which writes its own files, and writes their table.
  subroutine run_scene_table(scenes, name, context, pool, status)
    type(scene_type), intent(in) :: scenes(:) !! the members
    character(len=*), intent(in) :: name          !! of the table
    type(run_context_type), intent(in) :: context !! of the job; its log is the terminal
    type(pool_type), target, intent(inout) :: pool !! that is divided
    integer, intent(out) :: status                !! exit status of the program

    type(archive_type) :: mine
    type(table_member_type), allocatable :: members(:)
    type(error_type), allocatable :: error
    type(case_lock_type) :: lock !! of the table, on the first rank
    character(len=:), allocatable :: left
    type(run_log_type) :: log
    integer :: number

    log = context%log
    call log%line(version_text())
    call log%line(text(size(scenes))//' cases, results go to '//context%folder//', '//text(pool%ranks)// &
                  ' rank(s) in '//text(pool%groups)//' group(s), a log for each case as CASE.log')
    status = 0
    if (pool%rank == 0) then
      call lock_case(context%folder, name, lock, left, error)
      if (left /= '') call log%warning(left)
      if (allocated(error)) then
        call log%complaint(error%message)
        status = error%status
      end if
    end if
    status = pool%largest(status)
    if (status /= 0) return
    allocate (members(size(scenes)))
    pool%total = size(scenes)
    call pool%next_task(number)
    do while (number <= size(scenes))
      call run_member(scenes(number), context, pool, members(number))
      status = max(status, merge(members(number)%status, status_unconverged, members(number)%status <= status_machine))
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
      call unlock_case(lock)
    end if
    status = pool%largest(status)
  end subroutine run_scene_table

  !> One member from its case to its files.
  subroutine run_member(scene, context, pool, member)
    type(scene_type), intent(in) :: scene
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
      if (stop_is_asked()) call fail(error, 'not computed, '//stop_words(), stop_status())
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
      call pool%report(scene%name//trim(merge(' was stopped', ' failed     ', member%status > status_machine)), 1)
    else if (study%converged) then
      call pool%report(scene%name, 1)
    else
      member%status = merge(stop_status(), status_unconverged, study%reason%is_stop())
      member%reason = study%reason%words()
      call pool%report(scene%name//trim(merge(' was stopped  ', ' has no answer', study%reason%is_stop())), 1)
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
    call add_outcome(summary, .true.)
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
    if (member%status > status_machine) words = member%name//': stopped'
    if (member%reason /= '') words = words//' ('//one_line(member%reason)//')'
  end function outcome

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

  !> One sweep divided, or several cases.
  !>
  !> Fails before anything is computed, with all mistakes of all files. Later failures are those of
  !> members: they are reported, and `status` says so.
  subroutine run_groups(line, pool, log, status, error)
    type(command_line_type), intent(in) :: line !! what was typed
    type(pool_type), target, intent(inout) :: pool !! whose groups compute
    type(run_log_type), intent(in) :: log !! the terminal
    integer, intent(out) :: status        !! exit status of the program
    type(error_type), allocatable, intent(out) :: error !! why it failed
    type(scene_type), allocatable :: scenes(:)
    class(study_type), allocatable :: study
    type(run_context_type) :: context
    integer :: i

    status = 0
    context = line%context(log)
    call read_all(line, scenes, error)
    if (.not. allocated(error)) call check_work(line, pool, scenes, error)
    if (.not. (line%check .or. line%shares >= 0 .or. allocated(error)) .and. pool%group == 1) then
      ! By one group: a second one might take away its trial file.
      call prepare_folder(line%folder, error)
    end if
    if (allocated(error)) status = error%status
    status = pool%largest(status)
    if (status /= 0 .and. .not. allocated(error)) call fail(error, 'another rank failed', status)
    if (allocated(error)) return
    if (line%check .or. line%shares >= 0) then
      do i = 1, size(scenes)
        call create_study(scenes(i), line%branches, study, error)
        if (.not. allocated(error)) call check_scene(scenes(i), study, line%shares, log, error)
        if (allocated(error)) return
      end do
      return
    end if
    call start_blas()
    if (context%petsc_options /= '') then
      call log%line('options given to PETSc: '//context%petsc_options)
    end if
    do i = 1, size(scenes)
      if (scenes(i)%hints /= '') call log%line(scenes(i)%hints)
      if (scenes(i)%warnings /= '') call log%warned(scenes(i)%warnings)
    end do
    if (size(scenes) == 1) then
      if (allocated(scenes(1)%model%reduction_reason)) then
        context%reduction = 'bumps '//scenes(1)%model%reduction_reason
      end if
      if (scenes(1)%sample%present) then
        call run_sample(scenes(1), context, pool, status, error)
      else
        call run_divided_bearing(scenes(1), context, pool, status)
      end if
    else
      call run_scene_table(scenes, line%table, context, pool, status)
    end if
    call agree_on_signal(pool%largest(agreed_signal()))
  end subroutine run_groups

  !> One sample divided.
  subroutine run_sample(scene, context, pool, status, error)
    type(scene_type), intent(in) :: scene
    type(run_context_type), intent(in) :: context
    type(pool_type), target, intent(inout) :: pool
    integer, intent(out) :: status
    type(error_type), allocatable, intent(out) :: error
    class(study_type), allocatable :: study

    status = 0
    call create_study(scene, .false., study, error)
    if (allocated(error)) return
    select type (study)
    type is (sample_type)
      call run_divided_sample(scene, study, context, pool, status)
    end select
  end subroutine run_sample

  !> Reads all case files.
  !>
  !> Fails with every mistake of every file.
  subroutine read_all(line, scenes, error)
    type(command_line_type), intent(in) :: line
    type(scene_type), allocatable, intent(out) :: scenes(:)
    type(error_type), allocatable, intent(out) :: error
    type(error_type), allocatable :: one
    integer :: i

    allocate (scenes(size(line%case_files)))
    do i = 1, size(scenes)
      call read_scene(line%case_files(i)%path, scenes(i), one, line%strict)
      if (allocated(one)) call add(one%message, error, one%status)
      if (.not. allocated(one)) call choose_solution(scenes(i))
    end do
  end subroutine read_all

  !> Whether the ranks and the work can be divided as asked.
  !>
  !> Fails naming everything that forbids groups.
  subroutine check_work(line, pool, scenes, error)
    type(command_line_type), intent(in) :: line
    type(pool_type), intent(in) :: pool
    type(scene_type), intent(in) :: scenes(:)
    type(error_type), allocatable, intent(out) :: error

    call forbid(.not. pool%split .and. .not. line%check, &
                'gfb: '//text(line%groups)//' groups need as many ranks at least, and the job '// &
                'has '//text(pool%ranks)//': mpiexec -n '//text(line%groups)//' gfb ...')
    if (size(scenes) > 1) then
      call check_names(line, scenes, error)
      call enough(size(scenes), 'gfb', 'cases')
      return
    end if
    associate (scene => scenes(1))
      if (scene%sample%present) then
        call enough(scene%sample%count, scene%file//': &sample', 'members')
      else if (scene%sweep%present) then
        call forbid(scene%sweep%friction_memory, scene%file//': &sweep: friction_memory: the '// &
                    'sweep cannot be divided among groups, because what slid at a point is '// &
                    'needed at the next one')
        call forbid(scene%sweep%turn_folds, scene%file//': &sweep: turn_folds: the sweep '// &
                    'cannot be divided among groups, because its branch is followed from the '// &
                    'first value on')
        call enough(size(scene%sweep%values), scene%file//': &sweep', 'values')
      else if (scene%dynamics%present) then
        call forbid(size(scene%dynamics%amplitudes) > 0, scene%file//': &dynamics: '// &
                    'vibration_amplitudes: the frequencies cannot be divided among groups, '// &
                    'because amplitudes are found on all ranks alone')
        call enough(size(scene%dynamics%frequencies), scene%file//': &dynamics', 'frequencies')
      else
        call forbid(.true., scene%file//': has no &sweep whose points, nor &dynamics whose '// &
                    'frequencies, nor &sample whose members, could be divided among groups; '// &
                    '--groups is for those, or for several cases')
      end if
    end associate

  contains

    subroutine forbid(broken, message)
      logical, intent(in) :: broken
      character(len=*), intent(in) :: message
      if (broken) call add(message, error)
    end subroutine forbid

    !> Every group needs one thing at least.
    subroutine enough(number, place, things)
      integer, intent(in) :: number
      character(len=*), intent(in) :: place, things
      call forbid(line%groups > number, place//': '//text(line%groups)//' groups for '// &
                  text(number)//' '//things//': some would have nothing to do')
    end subroutine enough
  end subroutine check_work

  !> No two cases may write the same files, nor a case those of the table.
  subroutine check_names(line, scenes, error)
    type(command_line_type), intent(in) :: line
    type(scene_type), intent(in) :: scenes(:)
    type(error_type), allocatable, intent(inout) :: error
    integer :: i, k

    do i = 1, size(scenes)
      if (scenes(i)%name == line%table) then
        call add(scenes(i)%file//': its results and the table would have the same names; '// &
                 '--name NAME gives the table another one', error)
      end if
      do k = 1, i - 1
        if (scenes(k)%name /= scenes(i)%name) cycle
        call add(scenes(i)%file//': its results would have the same names as those of '// &
                 scenes(k)%file, error)
        exit
      end do
    end do
  end subroutine check_names

  !> Adds a mistake to those there are.
  subroutine add(message, error, status)
    character(len=*), intent(in) :: message
    type(error_type), allocatable, intent(inout) :: error
    integer, intent(in), optional :: status !! exit status
    type(error_type), allocatable :: both

    if (allocated(error)) then
      call fail(both, error%message//new_line('a')//message, error%status)
    else
      call fail(both, message)
    end if
    if (present(status)) both%status = max(both%status, status)
    call move_alloc(both, error)
  end subroutine add

  !> Computes the members of a sample side by side, and writes them as one run would. Every group takes the next
  !> member that is left; a member's answer does not depend on its group.
  subroutine run_divided_sample(scene, study, context, pool, status)
    type(scene_type), intent(in) :: scene !! with `&sample`
    type(sample_type), intent(inout) :: study !! of this group, as it was created
    type(run_context_type), intent(in) :: context !! of the job; its log is the terminal
    type(pool_type), target, intent(inout) :: pool !! that is divided
    integer, intent(out) :: status !! exit status of the program
    type(run_context_type) :: own
    type(archive_type) :: mine
    type(error_type), allocatable :: error
    real(wp) :: total(4)
    integer :: number

    call pool%show(scene, context, &
                   ', logs '//group_log_path(context%folder, scene%name, 1)//', ...')
    call context%log%line(text(scene%sample%count)//' members, each group takes the next one')
    call context%log%line('')
    own = context
    call pool%begin_log(group_log_path(context%folder, scene%name, pool%group), own, error)
    if (.not. allocated(error)) call study%prepare(scene, own%log)
    if (.not. allocated(error)) call study%check(scene, error)
    status = 0
    if (allocated(error)) then
      status = error%status
      call own%log%complaint(error%message)
    end if
    status = pool%largest(status)
    if (status == 0) then
      pool%counted = scene%sample%count
      pool%total = scene%sample%count
      call pool%next_task(number)
      do while (number <= scene%sample%count)
        call study%solve_member(scene, own, number)
        call visit_task(mine, study%member, number)
        call pool%next_task(number)
      end do
      call pool%gather_tasks(mine, writer, study%member)
      ! Counts of a group are on each of its ranks.
      total = pool%total_of(merge(1.0_wp, 0.0_wp, [.true., pool%leads, pool%leads, pool%leads])* &
                           [peak_memory(), real(study%iterations, wp), &
                            real(study%factorizations, wp), real(study%factorizations_finest, wp)])
      study%unknowns = pool%largest(study%unknowns)
      if (pool%group == writer) call write_all(scene, context, pool, study, total, status)
      status = pool%largest(status)
    else if (pool%group == writer .and. allocated(error)) then
      call context%log%complaint(error%message)
    end if
    call end_log(own%log)
    call study%discard()
  end subroutine run_divided_sample

  !> Writes all members, and says so on the terminal.
  subroutine write_all(scene, context, pool, study, total, status)
    type(scene_type), intent(in) :: scene
    type(run_context_type), intent(in) :: context
    type(pool_type), intent(in) :: pool
    type(sample_type), intent(inout) :: study
    real(wp), intent(in) :: total(4) !! memory [B], iterations, factorizations of all groups
    integer, intent(inout) :: status
    type(run_context_type) :: terminal
    type(quantity_type), allocatable :: origin(:), summary(:)
    type(error_type), allocatable :: error

    terminal = context
    terminal%log%active = pool%leads
    terminal%log%verbose = .false.
    call study%judge()
    if (.not. study%converged) status = status_unconverged
    origin = pool%origin(context)
    call add_result(origin, 'groups', pool%groups)
    call terminal%take_case(scene%name, error)
    if (.not. allocated(error)) then
      call write_sample(scene, terminal, study%member, study%reason, origin, pool%ranks, &
                        cost_type(study%unknowns, nint(total(2)), nint(total(3)), nint(total(4)), &
                                  wall_time() - pool%begun, total(1)), summary, error)
    end if
    call terminal%give_back()
    if (.not. allocated(error)) return
    status = max(status, error%status)
    call terminal%log%complaint(error%message)
  end subroutine write_all
end module gfb_run_groups
