#include "gfb_petsc.h"
!> A sweep whose points are divided among groups of ranks: a stretch each, one set of results.
!>
!> A group's first point starts from nothing, where the sweep in one piece comes from the point before.
!> Whether both lead to the same answer is seen: every group but the last also follows its way to the
!> first point of the next one.
module gfb_divided_sweep
  use petscsys
  use gfb_kinds, only: wp
  use gfb_errors, only: error_type, status_machine
  use gfb_text, only: text
  use gfb_division, only: stretch_of
  use gfb_run_log, only: run_log_type
  use gfb_quantity, only: quantity_type
  use gfb_results, only: add_result
  use gfb_result_table, only: with_stretches
  use gfb_c_library, only: peak_memory
  use gfb_scene, only: scene_type
  use gfb_case_file, only: case_array_type
  use gfb_row_packing, only: pack_arrays, unpack_arrays
  use gfb_petsc_session, only: wall_time
  use gfb_job_groups, only: job_type, text_type
  use gfb_bearing_system, only: bearing_system_type
  use gfb_bearing_builder, only: bearing_plan_type
  use gfb_newton, only: newton_type, destroy_newton
  use gfb_bearing_plan, only: plan_bearing
  use gfb_bearing_record, only: bearing_record_type
  use gfb_bearing_summary, only: cost_type
  use gfb_bearing_analysis, only: solve_scene, write_bearing
  use gfb_restart, only: restart_type, find_restart, drop_restart
  use gfb_memory_check, only: check_memory
  use gfb_contact_record, only: foil_contact_arrays
  use gfb_command_line, only: command_line_type
  use gfb_group_log, only: open_group_log, close_group_log
  use gfb_provenance, only: provenance, version_text
  use gfb_sweep_stretch, only: stretch_type, stretch_words, read_stretch, merge_histories, merge_arrays, &
                               seam_words, place_text
  implicit none (type)
  private
  public :: run_divided_sweep

  integer, parameter :: status_unconverged = 2

contains

  !> Computes the stretches side by side, and writes what they have found as one.
  subroutine run_divided_sweep(scene, line, job, log, status)
    type(scene_type), intent(in) :: scene
    type(command_line_type), intent(in) :: line
    type(job_type), target, intent(inout) :: job
    type(run_log_type), intent(in) :: log !! the terminal
    integer, intent(out) :: status        !! exit status of the program

    type(bearing_plan_type) :: plan
    type(bearing_system_type), target :: bearing
    type(newton_type), target :: newton
    type(bearing_record_type) :: record
    type(restart_type) :: restart
    type(stretch_type) :: mine
    type(stretch_type), allocatable :: stretches(:)
    type(run_log_type) :: own_log
    type(error_type), allocatable :: error
    real(wp) :: memory(1)
    integer :: writer
    logical :: built

    call show_division(scene, line, job, log)
    job%total = size(scene%sweep%values)
    call open_group_log(log_path(scene, line, job%group), log%verbose, job, own_log, error)
    built = .not. allocated(error)
    if (built) call compute(scene, line, job, own_log, restart, plan, bearing, newton, record, mine, error)
    if (allocated(error)) call log_failure(scene, job, error, mine)
    writer = job%largest(merge(0, job%group, allocated(error)))
    memory = job%total_of([peak_memory()])
    if (writer > 0) then
      call gather(job, writer, mine, record, stretches)
      if (job%group == writer) then
        call write_all(scene, line, job, memory(1), plan, bearing, stretches, record, mine%status)
      end if
    end if
    status = job%largest(mine%status)
    if (status == 0) call drop_restart(restart)
    call close_group_log(own_log)
    if (allocated(error)) return
    call destroy_newton(newton)
    call bearing%destroy()
  end subroutine run_divided_sweep

  !> Where each group begins and how.
  subroutine show_division(scene, line, job, log)
    type(scene_type), intent(in) :: scene
    type(command_line_type), intent(in) :: line
    type(job_type), intent(in) :: job
    type(run_log_type), intent(in) :: log
    integer :: group, ends(2), ranks(2)

    call log%line(version_text())
    call log%line(scene%file//': '//scene%general%title)
    call log%line('results go to '//line%folder//', '//text(job%ranks)//' rank(s) in '//text(job%groups)// &
                  ' group(s)')
    do group = 1, job%groups
      ends = stretch_of(size(scene%sweep%values), job%groups, group)
      ranks = stretch_of(job%ranks, job%groups, group)
      call log%line('group '//text(group)//': '//text(ranks(2) - ranks(1) + 1)//' rank(s), '// &
                    place_text(scene, ends(1))//' to '//place_text(scene, ends(2))//', '// &
                    text(ends(2) - ends(1) + 1)//' point(s), log '//log_path(scene, line, group))
    end do
    if (job%groups == 1) return
    if (scene%sweep%hold_position) then
      call log%line('every group finds the equilibrium at which the shaft is held, and goes from there')
    else
      call log%line('the first point of every group starts from nothing, not from the point before')
    end if
    call log%line('')
  end subroutine show_division

  !> File of a group's log.
  function log_path(scene, line, group) result(path)
    type(scene_type), intent(in) :: scene
    type(command_line_type), intent(in) :: line
    integer, intent(in) :: group
    character(len=:), allocatable :: path
    path = line%folder//'/'//scene%name//'.group'//text(group)//'.log'
  end function log_path

  !> This group's stretch, and the first point of the next one for comparison.
  subroutine compute(scene, line, job, log, restart, plan, bearing, newton, record, mine, error)
    type(scene_type), intent(in) :: scene
    type(command_line_type), intent(in) :: line
    type(job_type), intent(inout) :: job
    type(run_log_type), intent(in) :: log
    type(restart_type), intent(out) :: restart !! of this group
    type(bearing_plan_type), intent(out) :: plan
    type(bearing_system_type), target, intent(inout) :: bearing
    type(newton_type), target, intent(inout) :: newton
    type(bearing_record_type), intent(inout) :: record
    type(stretch_type), intent(out) :: mine
    type(error_type), allocatable, intent(out) :: error
    type(scene_type) :: part
    integer :: ends(2), points, found
    logical :: converged

    ends = stretch_of(size(scene%sweep%values), job%groups, job%group)
    points = ends(2) - ends(1) + 1
    part = scene
    ! What it may write on its way is its own, and that of as many groups.
    part%name = scene%name//'.group'//text(job%group)//'of'//text(job%groups)
    part%sweep%values = scene%sweep%values(ends(1):min(ends(2) + 1, size(scene%sweep%values)))
    job%counted = points
    job%reason = ''
    call log%line(version_text())
    call log%line(scene%file//': '//scene%general%title)
    call plan_bearing(scene, log, plan)
    call log%line('group '//text(job%group)//' of '//text(job%groups)//': points '//text(ends(1))//' to '// &
                  text(ends(2)))
    if (size(part%sweep%values) > points) then
      call log%line('its last point here is the next group''s first, to see that both find the same')
    end if
    call check_memory(scene, plan%memory, error)
    if (allocated(error)) return
    call find_restart(part, line%folder, line%restart, line%words, log, restart, error)
    if (allocated(error)) return
    call log%heading('solution')
    call solve_scene(part, plan, restart, log, bearing, newton, record, converged, error)
    if (allocated(error)) return
    found = min(size(record%history), points)
    mine%first = ends(1)
    mine%last = ends(2)
    mine%iterations = newton%iterations
    mine%factorizations = newton%factorizations
    mine%row = record%history(:found)
    mine%next = record%history(found + 1:)
    mine%contacts = foil_contact_arrays(bearing%foil, record%contacts, found)
    mine%reason = ''
    if (found < points) then
      mine%status = status_unconverged
      mine%reason = job%reason
      call job%report('no answer at '//place_text(scene, ends(1) + found), points - found)
    end if
  end subroutine compute

  !> A group that has failed: it says why, and has found nothing.
  subroutine log_failure(scene, job, error, mine)
    type(scene_type), intent(in) :: scene
    type(job_type), intent(inout) :: job
    type(error_type), intent(in) :: error
    type(stretch_type), intent(out) :: mine
    type(run_log_type) :: terminal
    integer :: ends(2)

    ends = stretch_of(size(scene%sweep%values), job%groups, job%group)
    mine%first = ends(1)
    mine%last = ends(2)
    mine%status = error%status
    mine%reason = error%message
    allocate (mine%row(0), mine%next(0), mine%contacts(0))
    terminal%active = job%leads
    call terminal%complaint('group '//text(job%group)//': '//error%message)
    call job%report('failed', ends(2) - ends(1) + 1)
  end subroutine log_failure

  !> Brings all stretches to one group.
  subroutine gather(job, writer, mine, record, stretches)
    type(job_type), intent(in) :: job
    integer, intent(in) :: writer !! the group
    type(stretch_type), intent(in) :: mine
    type(bearing_record_type), intent(in) :: record
    type(stretch_type), allocatable, intent(out) :: stretches(:) !! nothing in the other groups
    type(text_type), allocatable :: points(:), contacts(:)
    integer :: i

    call job%collect(stretch_words(mine, record%tilted), writer, points)
    call job%collect(pack_arrays(mine%contacts), writer, contacts)
    allocate (stretches(size(points)))
    do i = 1, size(stretches)
      call read_stretch(points(i)%words, stretches(i))
      call unpack_arrays(contacts(i)%words, stretches(i)%contacts)
    end do
  end subroutine gather

  !> Writes the whole sweep, with this group's last state as the sweep's, and tells the terminal.
  subroutine write_all(scene, line, job, memory, plan, bearing, stretches, record, status)
    type(scene_type), intent(in) :: scene
    type(command_line_type), intent(in) :: line
    type(job_type), intent(in) :: job
    real(wp), intent(in) :: memory !! of all ranks [B]
    type(bearing_plan_type), intent(in) :: plan
    type(bearing_system_type), intent(inout) :: bearing
    type(stretch_type), intent(in) :: stretches(:)
    type(bearing_record_type), intent(inout) :: record
    integer, intent(inout) :: status

    type(run_log_type) :: terminal
    type(case_array_type), allocatable :: contacts(:)
    type(quantity_type), allocatable :: summary(:)
    type(error_type), allocatable :: error
    logical :: converged

    terminal%active = job%leads
    terminal%verbose = .false.
    converged = all(stretches%status == 0)
    call merge_histories(scene, stretches, record%history)
    call merge_arrays(stretches, contacts)
    record%tilted%first_slope = stretches(1)%first_slope
    call write_bearing(scene, plan, line%folder, origin(line, job, stretches, scene), terminal, bearing, converged, &
                       record, cost_type(bearing%unknowns, sum(stretches%iterations), &
                                         sum(stretches%factorizations), wall_time() - job%begun, memory), &
                       job%ranks, contacts, summary, error)
    call show_failures(scene, stretches, terminal)
    call show_seams(scene, stretches, terminal)
    if (.not. allocated(error)) return
    status = max(status, error%status)
    call terminal%complaint(error%message)
  end subroutine write_all

  !> What the files say of their origin: of the whole job.
  function origin(line, job, stretches, scene) result(list)
    type(command_line_type), intent(in) :: line
    type(job_type), intent(in) :: job
    type(stretch_type), intent(in) :: stretches(:)
    type(scene_type), intent(in) :: scene
    type(quantity_type), allocatable :: list(:)
    character(len=:), allocatable :: words
    integer :: i

    list = provenance(line%words)
    do i = 1, size(list)
      if (list(i)%name == 'ranks') list(i)%number = real(job%ranks, wp)
    end do
    words = 'all begin with the answer to which the stretch before leads'
    do i = 2, size(stretches)
      if (seam_words(scene, stretches(i - 1), stretches(i)) /= '') words = 'not all begin with the answer '// &
                                                                    'to which the stretch before leads'
    end do
    call add_result(list, 'groups', job%groups, with_stretches)
    if (job%groups > 1) call add_result(list, 'stretches', words)
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
        call log%line('group '//text(i)//': '//one%reason)
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
