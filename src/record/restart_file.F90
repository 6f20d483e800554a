#include "gfb_petsc.h"
!> `<case>.restart.h5`: from where a run that was stopped is resumed. It says where it comes from and holds archives,
!> a group each. What they hold is a line in the `visit_...` of the type that it belongs to; `bearing_restart`,
!> and the studies of strips and orbits, say which types.
!>
!> It is written after every so many steps where the scene asks for that. The solvers then forget their
!> factors, so that what follows depends on what the file holds and on nothing else: a run that is resumed
!> from it ends with the digits of one that was never stopped. Otherwise it is written once a minute and
!> where a run is stopped; the solvers keep their factors, and the run its digits.
module gfb_restart_file
  use petscsys
  use gfb_kinds, only: wp
  use gfb_errors, only: error_type, fail, status_machine
  use gfb_text, only: text
  use gfb_run_log, only: run_log_type
  use gfb_c_library, only: remove_file
  use gfb_petsc_session, only: this_rank, rank_count, any_rank, share_failure, wall_time
  use gfb_scene, only: scene_type
  use gfb_case_file, only: write_quantities
  use gfb_archive, only: archive_type
  use gfb_result_file, only: result_file_type, open_result_file, close_result_file, keep_result_file, drop_result_file
  use gfb_stored_file, only: stored_file_type, open_stored_file, close_stored_file
  use gfb_provenance, only: provenance, program_words
  use gfb_archive_file, only: write_archive, read_archive
  implicit none (type)
  private
  public :: find_restart, save_restart, read_restart, end_reading, refuse_restart, drop_restart

  character(len=1), parameter :: line_end = new_line('a')

  !> Where a run's restart file is, and whether the run is resumed from it.
  type, public :: restart_type
    character(len=:), allocatable :: path    !! of the file
    character(len=:), allocatable :: command !! the whole command line
    integer :: every = 0                     !! steps between files; 0: one a minute
    real(wp), private :: last_time = 0.0_wp  !! when the last one was written, or the run began [s]
    logical :: continues = .false.             !! from the file that is there
    integer :: step = 0                      !! of a run that goes on: number of the step or point that was done
    real(wp) :: elapsed = 0.0_wp             !! and how long after the first one [s]
  contains
    procedure :: is_due, is_due_after, may_be_written, tell
  end type restart_type

  integer, parameter :: format = 10 !! of the file; the first one had none to say
  !> Root mean square of the scaled residual beyond which a state that was read is no answer: a thousand times what answers
  !> have [1].
  real(wp), parameter, public :: no_answer = 1.0e-5_wp
  !> The same where contacts have carried their slip along since: 2e-4 was seen [1].
  real(wp), parameter, public :: slipped_on = 1.0e-2_wp
  real(wp), parameter :: between_files = 60.0_wp !! where no number of steps is given [s]

contains

  !> The first difference between two echoes in words; empty where all keys are the same.
  function scene_difference(there, here) result(words)
    character(len=*), intent(in) :: there !! text of a scene with every value used
    character(len=*), intent(in) :: here  !! the same of the present scene
    character(len=:), allocatable :: words
    character(len=:), allocatable :: line, other, group
    integer :: position, other_position

    words = ''
    group = ''
    position = 1
    other_position = 1
    do
      line = next_line(there, position)
      other = next_line(here, other_position)
      if (line == '' .and. other == '') return
      if (line /= other) exit
      if (line(1:1) == '&') group = line//': '
    end do
    if (line == '' .or. line == '/') line = 'nothing more'
    if (other == '' .or. other == '/') other = 'nothing more'
    words = group//line//' there, '//other//' here'
  end function scene_difference

  !> The next line that says something, without its comment; empty at the end.
  function next_line(words, position) result(line)
    character(len=*), intent(in) :: words
    integer, intent(inout) :: position !! where to look; moves behind the line
    character(len=:), allocatable :: line
    integer :: length

    line = ''
    do while (line == '' .and. position <= len(words))
      length = index(words(position:), line_end) - 1
      if (length < 0) length = len(words) - position + 1
      line = trim(adjustl(without_comment(words(position:position + length - 1))))
      position = position + length + 1
    end do
  end function next_line

  !> A line up to its comment, which no quotes hold.
  pure function without_comment(line) result(part)
    character(len=*), intent(in) :: line
    character(len=:), allocatable :: part
    integer :: i
    logical :: quoted

    quoted = .false.
    part = line
    do i = 1, len(line)
      if (line(i:i) == '''') quoted = .not. quoted
      if (line(i:i) == '!' .and. .not. quoted) then
        part = line(:i - 1)
        return
      end if
    end do
  end function without_comment

  !> Whether a file is written after a step.
  logical function is_due(self, step) result(due)
    class(restart_type), intent(inout) :: self !! the restart file
    integer, intent(in) :: step !! number of the step or point that is done
    due = self%is_due_after(step - 1, step)
  end function is_due

  !> Whether a file is written where some steps came at once.
  logical function is_due_after(self, before, now) result(due)
    class(restart_type), intent(inout) :: self !! the restart file
    integer, intent(in) :: before, now !! steps that were and are done

    due = self%may_be_written()
    if (.not. due) return
    if (self%every > 0) then
      due = now/self%every > before/self%every .or. now == 0
    else
      due = any_rank(wall_time() > self%last_time + between_files)
      if (due) self%last_time = wall_time()
    end if
  end function is_due_after

  !> Whether the run has a restart file; a search for all equilibria or for a mesh has none.
  pure logical function may_be_written(self) result(may)
    class(restart_type), intent(in) :: self !! the restart file
    may = allocated(self%path)
  end function may_be_written

  !> Says of a run that is stopped where it can be resumed.
  subroutine tell(self, log, words)
    class(restart_type), intent(in) :: self !! the restart file
    type(run_log_type), intent(in) :: log !! where lines go
    character(len=*), intent(in) :: words !! where it was stopped, and why
    logical :: there

    there = .false.
    if (this_rank() == 0 .and. self%may_be_written()) inquire (file=self%path, exist=there)
    if (.not. any_rank(there)) return
    call log%line(words//'; --restart resumes from '//self%path)
  end subroutine tell

  !> Looks for the file of a scene.
  !>
  !> Fails where the run is to be resumed from a file of another scene or program, or from a damaged one.
  subroutine find_restart(scene, folder, wanted, command, log, restart, error)
    type(scene_type), intent(in) :: scene !! what is asked for
    character(len=*), intent(in) :: folder  !! where the results go
    logical, intent(in) :: wanted           !! the run is to be resumed
    character(len=*), intent(in) :: command !! the whole command line
    type(run_log_type), intent(in) :: log !! where lines go
    type(restart_type), intent(out) :: restart !! name of the file, and whether the run is resumed from it
    type(error_type), allocatable, intent(out) :: error !! why it failed
    logical :: there

    restart%path = folder//'/'//scene%name//'.restart.h5'
    restart%command = command
    restart%every = scene%output%restart_every
    restart%last_time = wall_time()
    there = .false.
    if (this_rank() == 0) inquire (file=restart%path, exist=there)
    there = any_rank(there)
    if (wanted .and. .not. there) then
      call log%line('restart: there is no '//restart%path//', the run starts from the beginning')
    else if (there .and. .not. wanted) then
      call log%warning(restart%path//' of an earlier run is there; --restart would resume from it; it will be replaced')
    end if
    if (.not. (wanted .and. there)) return
    call compare_origin(scene, log, restart, error)
    restart%continues = .not. allocated(error)
  end subroutine find_restart

  !> Compares program and scene with those that wrote the file.
  !>
  !> Fails naming what differs.
  subroutine compare_origin(scene, log, restart, error)
    type(scene_type), intent(in) :: scene
    type(run_log_type), intent(in) :: log
    type(restart_type), intent(inout) :: restart
    type(error_type), allocatable, intent(out) :: error

    type(stored_file_type) :: file
    character(len=:), allocatable :: program, own, difference
    logical :: fits
    integer :: ranks, steps(2)

    call open_file(restart, file, error)
    if (allocated(error)) return
    program = 'gfb '//file%words('/provenance/program_version')//' ('//file%words('/provenance/commit')//')'
    own = program_words()
    difference = ''
    ranks = file%count('/provenance/ranks')
    fits = file%has('/format')
    if (fits) fits = file%count('/format') == format
    if (fits) then
      difference = scene_difference(file%words('/scene/used'), scene%echo)
      restart%step = file%count('/step/number')
      restart%elapsed = file%scalar('/step/elapsed')
    else
      own = own//', whose restart files are of another kind'
    end if
    call close_file(restart, file, error)
    if (allocated(error)) return
    if (program /= own) then
      call fail(error, restart%path//': was written by '//program//', this is '//own// &
                '; run without --restart to start from the beginning')
    else if (difference /= '') then
      call fail(error, restart%path//': belongs to another scene than '//scene%file//': '//difference// &
                '; run without --restart to start from the beginning')
    end if
    if (allocated(error)) return
    steps = steps_of(scene)
    if (steps(2) < steps(1)) then
      call refuse_restart(restart, 'no run of this scene writes such a file', error)
    else if (restart%step < steps(1) .or. restart%step > steps(2)) then
      call refuse_restart(restart, '/step/number is '//text(restart%step)//', the run has '//text(steps(1))//' to '// &
                          text(steps(2)), error)
    else if (.not. restart%elapsed >= 0.0_wp) then
      call refuse_restart(restart, '/step/elapsed is negative', error)
    else if (ranks /= rank_count()) then
      call log%line('restart: '//restart%path//' was written by '//text(ranks)//' rank(s); digits of '// &
                    'the answer beyond the tolerances may differ from theirs')
    end if
  end subroutine compare_origin

  !> The first and the last step or point after which a run of a scene may be resumed; none where the last is before the first.
  pure function steps_of(scene) result(steps)
    type(scene_type), intent(in) :: scene !! what is asked for
    integer :: steps(2)

    steps = [1, 0]
    if (scene%general%analysis%loads_strip) then
      steps(2) = scene%strip_load%steps_up + scene%strip_load%steps_down
    else if (scene%transient%present) then
      steps(2) = huge(steps)
    else if (scene%sweep%present .and. .not. scene%periodic%present) then
      if (scene%sweep%hold_position) steps(1) = 0
      steps(2) = size(scene%sweep%values)
      if (scene%sweep%turn_folds) steps(2) = huge(steps) ! answers along the branch
    end if
  end function steps_of

  !> Writes the file; it replaces the one before when it is whole. A run does not end because it cannot be written.
  subroutine save_restart(scene, restart, log, step, elapsed, archive)
    type(scene_type), intent(in) :: scene !! what is asked for
    type(restart_type), intent(in) :: restart !! name and origin of the file
    type(run_log_type), intent(in) :: log !! where lines go
    integer, intent(in) :: step !! number of the step or point that is done
    real(wp), intent(in) :: elapsed !! since the first one, where anybody asks [s]
    type(archive_type), intent(in) :: archive(:) !! that have saved; one without a name is left out
    type(result_file_type) :: file
    type(error_type), allocatable :: error
    integer :: i

    call open_result_file(restart%path, PETSC_COMM_WORLD, this_rank() == 0, file, error)
    call share_failure(error)
    if (.not. allocated(error)) then
      file%compressed = .false.
      call file%put_scalar('/format', real(format, wp), '1', 'of restart files')
      call file%group('/scene')
      call file%put_text('/scene/case_file', scene%verbatim, 'the case file as it was read')
      call file%put_text('/scene/used', scene%echo, 'every key with the value used')
      call write_quantities(file, '/provenance', provenance(restart%command))
      call file%group('/step')
      call file%put_scalar('/step/number', real(step, wp), '1', 'load steps, or points of the sweep, that are done')
      call file%put_scalar('/step/elapsed', elapsed, 's', 'since the first point was there')
      do i = 1, size(archive)
        if (allocated(archive(i)%name)) call write_archive(archive(i), file)
      end do
      call close_result_file(file, error)
      call share_failure(error)
      if (.not. allocated(error)) call keep_result_file(file, error)
      call share_failure(error)
    end if
    if (.not. allocated(error)) return
    call drop_result_file(file)
    call log%warning(error%message//'; the run continues without it')
  end subroutine save_restart

  !> Reads one of the archives of the file from which the run is resumed.
  !>
  !> Fails when it cannot be read.
  subroutine read_restart(restart, name, archive, error, there)
    type(restart_type), intent(in) :: restart !! name of the file
    character(len=*), intent(in) :: name !! of the archive
    type(archive_type), intent(out) :: archive !! will restore
    type(error_type), allocatable, intent(out) :: error !! why it failed
    logical, intent(out), optional :: there !! the file has it; without this argument it must
    type(stored_file_type) :: file

    if (present(there)) there = .false.
    call open_file(restart, file, error)
    if (allocated(error)) return
    if (present(there)) there = file%has('/'//name)
    call read_archive(name, this_rank(), rank_count(), file, archive)
    if (present(there)) file%failed = file%failed .and. there
    call close_file(restart, file, error)
  end subroutine read_restart

  !> Ends reading an archive.
  !>
  !> Fails naming what did not fit.
  subroutine end_reading(restart, archive, error)
    type(restart_type), intent(in) :: restart !! name of the file
    type(archive_type), intent(inout) :: archive !! that has restored
    type(error_type), allocatable, intent(out) :: error !! why it failed
    character(len=:), allocatable :: why

    call archive%finish()
    why = 'the file is damaged at /'//archive%name
    if (archive%failed) why = why//': '//archive%problem
    if (any_rank(archive%failed)) call refuse_restart(restart, why, error)
  end subroutine end_reading

  !> Opens the file from which the run is resumed.
  !>
  !> Fails when it cannot be read.
  subroutine open_file(restart, file, error)
    type(restart_type), intent(in) :: restart
    type(stored_file_type), intent(out) :: file
    type(error_type), allocatable, intent(out) :: error

    call open_stored_file(restart%path, PETSC_COMM_WORLD, this_rank() == 0, file, error)
    call share_failure(error)
  end subroutine open_file

  !> Closes it.
  !>
  !> Fails where something could not be read.
  subroutine close_file(restart, file, error)
    type(restart_type), intent(in) :: restart
    type(stored_file_type), intent(inout) :: file
    type(error_type), allocatable, intent(out) :: error
    character(len=:), allocatable :: why

    call close_stored_file(file)
    why = 'the file is damaged'
    if (file%lost /= '') why = why//': '//file%lost//' cannot be read'
    if (file%refused /= '') why = file%refused
    if (any_rank(file%failed)) call refuse_restart(restart, why, error)
  end subroutine close_file

  !> Says why a file does not serve.
  subroutine refuse_restart(restart, why, error)
    type(restart_type), intent(in) :: restart !! name of the file
    character(len=*), intent(in) :: why !! the sentence's middle
    type(error_type), allocatable, intent(out) :: error !! it
    call fail(error, restart%path//': '//why//'; run without --restart to start from the beginning', status_machine)
  end subroutine refuse_restart

  !> Removes the file of a run that has ended well.
  subroutine drop_restart(restart)
    type(restart_type), intent(in) :: restart !! name of the file

    if (this_rank() /= 0 .or. .not. restart%may_be_written()) return
    call remove_file(restart%path)
  end subroutine drop_restart
end module gfb_restart_file
