#include "gfb_petsc.h"
!> What restart files of bearings hold, in sweeps and over time: the bearing at a point, and all that was recorded.
module gfb_bearing_restart
  use petscvec
  use gfb_kinds, only: wp
  use gfb_archive, only: archive_type
  use gfb_errors, only: error_type
  use gfb_text, only: text
  use gfb_run_log, only: run_log_type
  use gfb_scene, only: scene_type
  use gfb_sweep_case, only: sweep_case_type
  use gfb_operating_point, only: operating_point_type
  use gfb_bearing_system, only: bearing_system_type, visit_bearing
  use gfb_heat_switch, only: visit_frozen
  use gfb_pad_contacts, only: pad_contacts
  use gfb_newton, only: newton_type, forget_factors, visit_counts, imbalance
  use gfb_arc, only: create_arc, visit_arc
  use gfb_continuation, only: fold_path_type, visit_fold_path
  use gfb_grid_series, only: forget_numbers
  use gfb_petsc_session, only: this_rank, wall_time
  use gfb_contact_record, only: visit_contact_record
  use gfb_bearing_record, only: bearing_record_type, visit_record, sweep_name, sweep_unit
  use gfb_restart_file, only: restart_type, save_restart, read_restart, end_reading, refuse_restart, no_answer, slipped_on
  implicit none (type)
  private
  public :: save_bearing, restore_bearing, restore_branch, visit_answer_and_record

contains

  !> Writes the file after a point.
  subroutine save_bearing(scene, restart, log, point, bearing, newton, record, branch)
    type(scene_type), intent(in) :: scene !! what is asked for
    type(restart_type), intent(in) :: restart !! name and origin of the file
    type(run_log_type), intent(in) :: log !! where lines go
    integer, intent(in) :: point !! of the sweep; 0: the equilibrium at which the shaft is fixed
    type(bearing_system_type), intent(inout) :: bearing !! at the point's answer
    type(newton_type), intent(inout) :: newton !! its solver; loses its factors
    type(bearing_record_type), intent(inout) :: record !! of the points so far
    type(fold_path_type), intent(inout), optional :: branch !! along a branch that is followed round its folds
    type(archive_type) :: archive(2)

    if (restart%every > 0) then
      call forget_factors(newton)
      if (present(branch)) call forget_factors(branch%arc%newton)
    end if
    archive(1)%name = 'bearing'
    call visit_answer_and_record(archive(1), bearing, newton, record)
    if (present(branch)) then
      archive(2)%name = 'branch'
      call visit_fold_path(archive(2), branch)
      call visit_arc(archive(2), branch%arc)
    end if
    call save_restart(scene, restart, log, point, wall_time() - record%begun, archive)
  end subroutine save_bearing

  !> Saves or restores the bearing's answer, counters, and all that was recorded.
  subroutine visit_answer_and_record(archive, bearing, newton, record)
    type(archive_type), intent(inout) :: archive !! that saves or restores
    type(bearing_system_type), intent(inout) :: bearing !! at the answer; put there where the archive restores
    type(newton_type), intent(inout) :: newton !! its solver
    type(bearing_record_type), intent(inout) :: record !! of the points so far
    integer :: points
    logical :: others

    call visit_bearing(archive, bearing)
    call visit_frozen(archive, bearing)
    call visit_counts(archive, newton)
    call archive%part('record')
    call visit_record(archive, record)
    if (archive%failed) return
    others = this_rank() > 0
    if (others .and. .not. archive%saves) call forget_numbers(record%series) ! the first rank has them
    points = 0
    if (allocated(record%history)) points = size(record%history)
    if (points == 0 .or. .not. bearing%has_contacts()) return
    call visit_contact_record(archive, pad_contacts(bearing), bearing%pad(1)%foil%contacts%rows, points, record%contacts)
  end subroutine visit_answer_and_record

  !> Puts a scene's equations where the file says.
  !>
  !> Fails when the file is damaged.
  subroutine restore_bearing(scene, restart, log, bearing, newton, record, error, name)
    type(scene_type), intent(in) :: scene !! what the case file asks for
    type(restart_type), intent(in) :: restart !! the file to resume from
    type(run_log_type), intent(in) :: log !! gets the lines of progress
    type(bearing_system_type), target, intent(inout) :: bearing !! is put where the file says
    type(newton_type), target, intent(inout) :: newton !! gets its counts
    type(bearing_record_type), intent(inout) :: record !! gets the points so far
    type(error_type), allocatable, intent(out) :: error !! why it failed
    character(len=*), intent(in), optional :: name !! of its archive; default: bearing
    type(archive_type) :: archive

    if (present(name)) then
      call read_restart(restart, name, archive, error)
    else
      call read_restart(restart, 'bearing', archive, error)
    end if
    if (allocated(error)) return
    call visit_answer_and_record(archive, bearing, newton, record)
    call end_reading(restart, archive, error)
    record%begun = wall_time() - restart%elapsed
    if (allocated(error) .or. .not. scene%sweep%present) return
    call judge_point(scene%sweep, restart, newton, record, error)
    if (allocated(error)) return
    associate (point => restart%step)
      if (scene%sweep%turn_folds .and. point > 1) then
        call log%line('restart: resumed from answer '//text(point)//' of the branch')
      else if (point == 0) then
        call log%line('restart: resumed from the equilibrium at which the shaft is fixed')
      else
        call log%line('restart: resumed from point '//text(point)//' of '//text(size(scene%sweep%values))//', '// &
                      sweep_name(scene%sweep)//' = '//text(scene%sweep%values(point))//' '//sweep_unit(scene%sweep))
      end if
    end associate
  end subroutine restore_bearing

  !> Whether what was read is the answer of a sweep's point, and as many rows as there are points.
  !>
  !> Fails where it is not.
  subroutine judge_point(sweep, restart, newton, record, error)
    type(sweep_case_type), intent(in) :: sweep !! what is asked for
    type(restart_type), intent(in) :: restart !! the file it comes from
    type(newton_type), intent(inout) :: newton !! of the bearing there
    type(bearing_record_type), intent(in) :: record !! of the points so far
    type(error_type), allocatable, intent(out) :: error !! why it failed
    real(wp) :: off !! from an answer
    integer :: rows

    rows = 0
    if (allocated(record%history)) rows = size(record%history)
    if (rows /= restart%step) then
      call refuse_restart(restart, 'the file is damaged: /step/number is '//text(restart%step)//', the history has '//text(rows)// &
                          ' rows', error)
      return
    end if
    if (sweep%turn_folds .and. rows > 1) return ! along the branch the contacts are linearised elsewhere
    off = imbalance(newton)
    if (off <= merge(slipped_on, no_answer, sweep%friction_memory)) return
    call refuse_restart(restart, 'the file is damaged at /bearing: its state is no answer (residual '//text(off, 3)//')', error)
  end subroutine judge_point

  !> Resumes the branch where the file has one; otherwise nothing is done.
  !>
  !> Fails when the file is damaged.
  subroutine restore_branch(restart, last, bearing, newton, branch, there, error)
    type(restart_type), intent(in) :: restart !! name of the file
    type(operating_point_type), intent(in) :: last !! of the sweep
    type(bearing_system_type), target, intent(inout) :: bearing !! as `restore_bearing` left it; put at the branch's last answer
    type(newton_type), intent(in) :: newton !! of the bearing: its settings
    type(fold_path_type), target, intent(inout) :: branch !! out: the branch as the file has it
    logical, intent(out) :: there !! the branch had been begun
    type(error_type), allocatable, intent(out) :: error !! why it failed
    type(archive_type) :: archive

    call read_restart(restart, 'branch', archive, error, there)
    if (allocated(error) .or. .not. there) return
    call visit_fold_path(archive, branch)
    bearing%point = branch%first
    call create_arc(bearing, newton, last, branch%arc)
    call visit_arc(archive, branch%arc)
    call end_reading(restart, archive, error)
    if (allocated(error)) return
    call branch%arc%return_to()
    call forget_factors(branch%arc%newton)
  end subroutine restore_branch
end module gfb_bearing_restart
