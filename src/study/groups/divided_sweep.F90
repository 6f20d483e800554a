#include "gfb_petsc.h"
!> A sweep whose points are divided among groups of ranks: a stretch each, one set of results.
!>
!> A group's first point starts from nothing, where the sweep in one piece comes from the point before.
!> Whether both lead to the same answer is seen: every group but the last also follows its path to the
!> first point of the next one.
module gfb_divided_sweep
  use petscsys
  use gfb_kinds, only: wp
  use gfb_archive, only: archive_type
  use gfb_errors, only: error_type
  use gfb_text, only: text
  use gfb_division, only: block_ends
  use gfb_run_log, only: run_log_type
  use gfb_quantity, only: quantity_type
  use gfb_c_library, only: peak_memory
  use gfb_scene, only: scene_type
  use gfb_petsc_session, only: wall_time
  use gfb_bearing_summary, only: cost_type
  use gfb_dynamics_writing, only: record_arrays, write_coefficients
  use gfb_restart, only: drop_restart
  use gfb_provenance, only: version_text
  use gfb_run_context, only: run_context_type
  use gfb_reasons, only: reason_failed
  use gfb_bearing_study, only: bearing_study_type
  use gfb_bearing_writing, only: bearing_result_type, write_bearing
  use gfb_job_groups, only: job_type
  use gfb_group_log, only: group_log_path, open_group_log, close_group_log
  use gfb_sweep_stretch, only: stretch_type, visit_stretch, merge_histories, merge_arrays, &
                               seam_words, place_text, add_origin, merge_dynamics, merge_series, keep_series
  implicit none (type)
  private
  public :: run_divided_sweep

  integer, parameter :: status_unconverged = 2

contains

  !> Computes the stretches side by side, and writes what they have found as one.
  subroutine run_divided_sweep(scene, context, job, status)
    type(scene_type), intent(in) :: scene !! with the whole sweep
    type(run_context_type), intent(in) :: context !! of the job; its log is the terminal
    type(job_type), target, intent(inout) :: job !! that is divided
    integer, intent(out) :: status !! exit status of the program

    type(bearing_study_type), allocatable, target :: study
    type(run_context_type) :: own
    type(stretch_type), allocatable :: mine
    type(stretch_type), allocatable :: stretches(:)
    type(error_type), allocatable :: error
    real(wp) :: memory(1)
    integer :: writer

    allocate (study, mine)
    call show_division(scene, context, job)
    job%total = size(scene%sweep%values)
    own = context
    call open_group_log(group_log_path(context%folder, scene%name, job%group), job, own, error)
    if (.not. allocated(error)) call compute(scene, job, own, study, mine, error)
    if (allocated(error)) call log_failure(scene, job, error, mine)
    writer = job%largest(merge(0, job%group, allocated(error)))
    memory = job%total_of([peak_memory()])
    if (writer > 0) then
      call gather(job, writer, mine, study, stretches)
      if (job%group == writer) call write_all(scene, context, job, memory(1), study, stretches, mine%status)
    end if
    status = job%largest(mine%status)
    if (status == 0) call drop_restart(own%restart)
    call own%give_back()
    call close_group_log(own%log)
    call study%discard()
  end subroutine run_divided_sweep

  !> Where each group begins and how.
  subroutine show_division(scene, context, job)
    type(scene_type), intent(in) :: scene
    type(run_context_type), intent(in) :: context
    type(job_type), intent(in) :: job
    type(run_log_type) :: log
    integer :: group, ends(2), ranks(2)

    log = context%log
    call log%line(version_text())
    call log%line(scene%file//': '//scene%general%title)
    call log%line('results go to '//context%folder//', '//text(job%ranks)//' rank(s) in '//text(job%groups)// &
                  ' group(s)')
    do group = 1, job%groups
      ends = block_ends(size(scene%sweep%values), job%groups, group)
      ranks = block_ends(job%ranks, job%groups, group)
      call log%line('group '//text(group)//': '//text(ranks(2) - ranks(1) + 1)//' rank(s), '// &
                    place_text(scene, ends(1))//' to '//place_text(scene, ends(2))//', '// &
                    text(ends(2) - ends(1) + 1)//' point(s), log '//group_log_path(context%folder, scene%name, group))
    end do
    if (job%groups == 1) return
    if (scene%sweep%hold_position) then
      call log%line('every group finds the equilibrium at which the shaft is fixed, and sweeps from there')
    else
      call log%line('the first point of every group starts from nothing, not from the point before')
    end if
    call log%line('')
  end subroutine show_division

  !> This group's stretch, and the first point of the next one for comparison.
  subroutine compute(scene, job, context, study, mine, error)
    type(scene_type), intent(in) :: scene
    type(job_type), intent(inout) :: job
    type(run_context_type), intent(inout) :: context !! of this group
    type(bearing_study_type), target, intent(inout) :: study
    type(stretch_type), intent(out) :: mine
    type(error_type), allocatable, intent(out) :: error
    type(scene_type) :: own
    integer :: ends(2), points

    ends = block_ends(size(scene%sweep%values), job%groups, job%group)
    points = ends(2) - ends(1) + 1
    own = scene
    ! What it may write while it runs is its own, and that of as many groups.
    own%name = scene%name//'.group'//text(job%group)//'of'//text(job%groups)
    own%sweep%values = scene%sweep%values(ends(1):min(ends(2) + 1, size(scene%sweep%values)))
    job%counted = points
    associate (log => context%log)
      call log%line(version_text())
      call log%line(scene%file//': '//scene%general%title)
      call study%prepare(scene, log)
      call log%line('group '//text(job%group)//' of '//text(job%groups)//': points '//text(ends(1))//' to '// &
                    text(ends(2)))
      if (size(own%sweep%values) > points) then
        call log%line('its last point here is the next group''s first, to see that both find the same')
      end if
    end associate
    call study%check(scene, error)
    if (.not. allocated(error)) call context%take_case(own%name, error)
    if (.not. allocated(error)) call context%find_restart(own, error)
    if (allocated(error)) return
    call context%log%heading('solution')
    call study%solve(own, context, error)
    if (allocated(error)) return
    call take_stretch(study, ends, mine)
    if (mine%status == 0) return
    call job%report('no answer at '//place_text(scene, ends(1) + size(mine%row)), points - size(mine%row))
  end subroutine compute

  !> What a study has found of a stretch.
  subroutine take_stretch(study, ends, stretch)
    type(bearing_study_type), intent(in) :: study
    integer, intent(in) :: ends(2) !! numbers of its values in the whole sweep
    type(stretch_type), intent(out) :: stretch
    integer :: points, found

    points = ends(2) - ends(1) + 1
    associate (sweep => study%sweep)
      found = min(size(sweep%record%history), points)
      stretch%first = ends(1)
      stretch%last = ends(2)
      stretch%iterations = study%iterations
      stretch%factorizations = study%factorizations
      stretch%factorizations_finest = study%factorizations_finest
      stretch%row = sweep%record%history(:found)
      stretch%next = sweep%record%history(found + 1:)
      stretch%contacts = record_arrays(sweep%scene, sweep%bearing, sweep%record, found)
      stretch%dynamics = sweep%record%dynamics
      if (allocated(stretch%dynamics%point)) stretch%dynamics%point = stretch%dynamics%point(:found)
      call keep_series(sweep%record%series, found, stretch)
    end associate
    if (found == points) return
    stretch%status = status_unconverged
    stretch%reason = study%reason
  end subroutine take_stretch

  !> A group that has failed: it says why, and has found nothing.
  subroutine log_failure(scene, job, error, mine)
    type(scene_type), intent(in) :: scene
    type(job_type), intent(inout) :: job
    type(error_type), intent(in) :: error
    type(stretch_type), intent(out) :: mine
    type(run_log_type) :: terminal
    integer :: ends(2)

    ends = block_ends(size(scene%sweep%values), job%groups, job%group)
    mine%first = ends(1)
    mine%last = ends(2)
    mine%status = error%status
    mine%reason%code = reason_failed
    mine%reason%detail = error%message
    allocate (mine%row(0), mine%next(0), mine%contacts(0))
    terminal%active = job%leads
    call terminal%complaint('group '//text(job%group)//': '//error%message)
    call job%report('failed', ends(2) - ends(1) + 1)
  end subroutine log_failure

  !> Brings all stretches to one group.
  subroutine gather(job, writer, mine, study, stretches)
    type(job_type), intent(in) :: job
    integer, intent(in) :: writer !! the group
    type(stretch_type), intent(inout) :: mine
    type(bearing_study_type), intent(in) :: study
    type(stretch_type), allocatable, intent(out) :: stretches(:) !! nothing in the other groups
    type(archive_type) :: archive
    type(archive_type), allocatable :: sent(:)
    integer :: i

    mine%first_slope = study%sweep%record%tilted%first_slope
    call visit_stretch(archive, mine)
    call job%collect(archive, writer, sent)
    allocate (stretches(size(sent)))
    do i = 1, size(stretches)
      call visit_stretch(sent(i), stretches(i))
      call sent(i)%finish()
      if (sent(i)%failed) error stop 'what a group of ranks has sent is no stretch of the sweep'
    end do
  end subroutine gather

  !> Writes the whole sweep, with this group's last state as the sweep's, and tells the terminal.
  subroutine write_all(scene, context, job, memory, study, stretches, status)
    type(scene_type), intent(in) :: scene
    type(run_context_type), intent(in) :: context
    type(job_type), intent(in) :: job
    real(wp), intent(in) :: memory !! of all ranks [B]
    type(bearing_study_type), intent(inout) :: study
    type(stretch_type), intent(in) :: stretches(:)
    integer, intent(inout) :: status

    type(run_context_type) :: terminal
    type(bearing_result_type) :: result
    type(quantity_type), allocatable :: summary(:)
    type(error_type), allocatable :: error

    terminal = context
    terminal%log%active = job%leads
    call terminal%take_case(scene%name, error)
    if (allocated(error)) then
      status = max(status, error%status)
      call terminal%log%complaint(error%message)
      return
    end if
    result%converged = all(stretches%status == 0)
    result%upwind = study%plan%upwind
    result%peclet = study%plan%peclet
    result%cells = study%plan%circumferential
    result%cost = cost_type(study%unknowns, sum(stretches%iterations), sum(stretches%factorizations), &
                            sum(stretches%factorizations_finest), &
                            wall_time() - job%begun, memory)
    result%ranks = job%ranks
    result%origin = origin(context, job, stretches, scene)
    call merge_arrays(stretches, result%contacts)
    call merge_histories(scene, stretches, study%sweep%record%history)
    call merge_dynamics(stretches, study%sweep%record%dynamics)
    call merge_series(stretches, study%sweep%record%series)
    study%sweep%record%tilted%first_slope = stretches(1)%first_slope
    call write_bearing(scene, terminal, study%sweep, result, summary, error)
    if (.not. allocated(error)) call write_coefficients(study%sweep%record, scene, terminal, error)
    call terminal%give_back()
    call show_failures(scene, stretches, terminal%log)
    call show_seams(scene, stretches, terminal%log)
    if (.not. allocated(error)) return
    status = max(status, error%status)
    call terminal%log%complaint(error%message)
  end subroutine write_all

  !> What the files say of their origin: of the whole job.
  function origin(context, job, stretches, scene) result(list)
    type(run_context_type), intent(in) :: context
    type(job_type), intent(in) :: job
    type(stretch_type), intent(in) :: stretches(:)
    type(scene_type), intent(in) :: scene
    type(quantity_type), allocatable :: list(:)
    integer :: i

    list = context%origin()
    do i = 1, size(list)
      if (list(i)%name == 'ranks') list(i)%number = real(job%ranks, wp)
    end do
    call add_origin(scene, job%groups, stretches, list)
  end function origin

  !> Which stretches end early, and why.
  subroutine show_failures(scene, stretches, log)
    type(scene_type), intent(in) :: scene
    type(stretch_type), intent(in) :: stretches(:)
    type(run_log_type), intent(in) :: log
    integer :: i, missing

    do i = 1, size(stretches)
      associate (one => stretches(i))
        if (one%status == 0) cycle
        missing = one%last - one%first + 1 - size(one%row)
        call log%line('')
        call log%line('group '//text(i)//': '//one%reason%words())
        call log%line('  missing: '//place_text(scene, one%first + size(one%row))//' to '// &
                      place_text(scene, one%last)//', '//text(missing)//' point(s)')
      end associate
    end do
  end subroutine show_failures

  !> Where the stretches do not fit together.
  subroutine show_seams(scene, stretches, log)
    type(scene_type), intent(in) :: scene
    type(stretch_type), intent(in) :: stretches(:)
    type(run_log_type), intent(in) :: log
    character(len=:), allocatable :: words
    integer :: i

    do i = 2, size(stretches)
      words = seam_words(scene, stretches(i - 1), stretches(i))
      if (words /= '') call log%warning('group '//text(i)//': '//words)
    end do
  end subroutine show_seams
end module gfb_divided_sweep
