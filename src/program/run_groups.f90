!> A job whose ranks are divided into groups: what is asked of them is checked, and then computed.
module gfb_run_groups
  use gfb_errors, only: error_type, fail
  use gfb_text, only: text
  use gfb_run_log, only: run_log_type
  use gfb_signals, only: agree_on_signal, agreed_signal
  use gfb_machine_memory, only: start_blas
  use gfb_scene, only: scene_type
  use gfb_scene_reading, only: read_scene
  use gfb_pool, only: pool_type
  use gfb_command_line, only: command_line_type
  use gfb_run_context, only: run_context_type, prepare_folder
  use gfb_check_scene, only: check_scene
  use gfb_reduction_choice, only: choose_reduction
  use gfb_divided_sample, only: run_divided_sample
  use gfb_sample, only: sample_type
  use gfb_studies, only: create_study
  use gfb_study, only: study_type
  use gfb_divided_bearing, only: run_divided_bearing
  use gfb_scene_table, only: run_scene_table, scene_runner
  implicit none (type, external)
  private
  public :: run_groups

contains

  !> One sweep divided, or several cases.
  !>
  !> Fails before anything is computed, with all mistakes of all files. Later failures are those of
  !> members: they are told, and `status` says so.
  subroutine run_groups(line, pool, run_scene, log, status, error)
    type(command_line_type), intent(in) :: line !! what was typed
    type(pool_type), target, intent(inout) :: pool !! whose groups compute
    procedure(scene_runner) :: run_scene  !! computes one of several cases
    type(run_log_type), intent(in) :: log !! the terminal
    integer, intent(out) :: status        !! exit status of the program
    type(error_type), allocatable, intent(out) :: error !! why it failed
    type(scene_type), allocatable :: scenes(:)
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
        call check_scene(scenes(i), line%shares, log, error)
        if (allocated(error)) return
      end do
      return
    end if
    call start_blas()
    if (context%petsc_options /= '') then
      call log%line('options given to PETSc: '//context%petsc_options)
    end if
    do i = 1, size(scenes)
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
      call run_scene_table(scenes, line%table, run_scene, context, pool, status)
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
      if (.not. allocated(one)) call choose_reduction(scenes(i))
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
end module gfb_run_groups
