#include "gfb_petsc.h"
!> A strip's restart file: the last two answers, the contacts, and all that was recorded.
module gfb_strip_restart
  use petscvec
  use gfb_memory, only: memory_type
  use gfb_errors, only: error_type
  use gfb_text, only: text
  use gfb_run_log, only: run_log_type
  use gfb_scene, only: scene_type
  use gfb_natural_order, only: strip_order
  use gfb_strip_system, only: strip_system_type
  use gfb_strip_answer, only: strip_recorder_type, resume_recorder
  use gfb_newton, only: newton_type, forget_factors
  use gfb_load_step, only: load_path_type, remember_load_path
  use gfb_result_file, only: result_file_type
  use gfb_stored_file, only: stored_file_type, close_stored_file
  use gfb_restart, only: restart_type, begin_restart_file, end_restart_file, open_restart, check_restart_file
  use gfb_restart_fields, only: put_memory, read_memory, end_memory, put_vector, read_vector, put_contacts, &
                                read_contacts, put_contact_record, read_contact_record
  use gfb_strip_record, only: strip_run_type, remember_run
  implicit none (type)
  private
  public :: keep_strip, recall_strip, remember_strip

contains

  !> Writes the file after a step.
  subroutine keep_strip(scene, restart, log, strip, newton, path, run)
    type(scene_type), intent(in) :: scene !! what is asked for
    type(restart_type), intent(in) :: restart !! name and origin of the file, and when one is due
    type(run_log_type), intent(in) :: log !! where lines go
    type(strip_system_type), intent(in) :: strip !! at the step's answer
    type(newton_type), intent(inout) :: newton !! its solver; loses its factors
    type(load_path_type), intent(inout) :: path !! the last two answers
    type(strip_run_type), intent(inout) :: run !! what was recorded so far

    type(memory_type) :: memory
    type(result_file_type) :: file
    type(error_type), allocatable :: error

    if (restart%every > 0) call forget_factors(newton)
    call begin_restart_file(scene, restart, run%steps, file, error)
    if (.not. allocated(error)) then
      call put_state(strip, newton, path, file)
      call remember_run(memory, run)
      call put_memory(memory, '/record', 'history, answers at the largest load so far and of the last step', file)
      call put_contact_record(strip%contacts, strip%foil%mesh%rows, run%contacts, run%steps, '/record/contacts', &
                              file)
    end if
    call end_restart_file(file, log, error)
  end subroutine keep_strip

  !> States, contacts, counters.
  subroutine put_state(strip, newton, path, file)
    type(strip_system_type), intent(in) :: strip
    type(newton_type), intent(inout) :: newton
    type(load_path_type), intent(inout) :: path
    type(result_file_type), intent(inout) :: file
    type(memory_type) :: memory

    call remember_strip(memory, newton, path)
    call put_memory(memory, '/strip', 'counters and the last two load factors', file)
    call put_vector(strip_order(strip), path%here, '/strip/state', 'scaled unknowns: foil, plate', file)
    call put_vector(strip_order(strip), path%before, '/strip/state_before', 'the same of the answer before', file)
    call put_contacts(strip%contacts, strip%foil%mesh%rows, '/strip/contacts', file)
  end subroutine put_state

  !> Packs or unpacks what is one for the whole strip.
  subroutine remember_strip(memory, newton, path)
    type(memory_type), intent(inout) :: memory !! that packs or unpacks
    type(newton_type), intent(inout) :: newton  !! written where the memory unpacks
    type(load_path_type), intent(inout) :: path !! the same

    call memory%visit('newton_iterations', newton%iterations)
    call memory%visit('factorizations', newton%factorizations)
    call remember_load_path(memory, path)
  end subroutine remember_strip

  !> Puts a strip where the file says.
  !>
  !> Fails when the file is damaged.
  subroutine recall_strip(restart, steps, log, strip, newton, path, recorder, run, error)
    type(restart_type), intent(in) :: restart !! name of the file
    integer, intent(in) :: steps !! that there will be
    type(run_log_type), intent(in) :: log !! where lines go
    type(strip_system_type), intent(inout) :: strip !! as it was built; put at the last answer
    type(newton_type), intent(inout) :: newton !! its solver; gets the counts so far
    type(load_path_type), intent(inout) :: path !! as it was created; gets the last two answers
    type(strip_recorder_type), intent(inout) :: recorder !! of works and deflections, put at the last answer
    type(strip_run_type), intent(inout) :: run !! with its deflections' sizes
    type(error_type), allocatable, intent(out) :: error !! why it failed

    type(stored_file_type) :: file
    type(memory_type) :: memory
    PetscErrorCode :: ierr

    call open_restart(restart, file, error)
    if (allocated(error)) return
    call read_state(file, strip, newton, path)
    call read_memory('/record', file, memory)
    call remember_run(memory, run)
    call end_memory(memory, file)
    call read_contact_record(strip%contacts, strip%foil%mesh%rows, run%steps, '/record/contacts', file, run%contacts)
    call check_restart_file(file, error)
    call close_stored_file(file)
    if (allocated(error)) return
    PetscCallA(VecCopy(path%here, strip%state, ierr))
    call strip%set_factor(path%at_here)
    call resume_recorder(strip, run%last, recorder)
    call log%line('restart: resumed from step '//text(run%steps)//' of '//text(steps))
  end subroutine recall_strip

  !> The reverse of `put_state`.
  subroutine read_state(file, strip, newton, path)
    type(stored_file_type), intent(inout) :: file
    type(strip_system_type), intent(inout) :: strip
    type(newton_type), intent(inout) :: newton
    type(load_path_type), intent(inout) :: path
    type(memory_type) :: memory

    call read_memory('/strip', file, memory)
    call remember_strip(memory, newton, path)
    call end_memory(memory, file)
    call read_vector(strip_order(strip), '/strip/state', file, path%here)
    call read_vector(strip_order(strip), '/strip/state_before', file, path%before)
    call read_contacts(strip%foil%mesh%rows, '/strip/contacts', file, strip%contacts)
  end subroutine read_state
end module gfb_strip_restart
