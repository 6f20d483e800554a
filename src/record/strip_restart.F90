#include "gfb_petsc.h"
!> A strip's restart file: the last two answers, the contacts, and all that was recorded.
module gfb_strip_restart
  use petscvec
  use gfb_kinds, only: wp
  use gfb_errors, only: error_type
  use gfb_text, only: text
  use gfb_run_log, only: run_log_type
  use gfb_scene, only: scene_type
  use gfb_natural_order, only: strip_order
  use gfb_strip_system, only: strip_system_type
  use gfb_strip_answer, only: strip_answer_type, strip_recorder_type, resume_recorder
  use gfb_newton, only: newton_type, forget_factors
  use gfb_load_step, only: load_path_type
  use gfb_history_store, only: put_rows, read_rows
  use gfb_result_file, only: result_file_type
  use gfb_stored_file, only: stored_file_type, close_stored_file
  use gfb_restart, only: restart_type, begin_restart_file, end_restart_file, open_restart, check_restart_file
  use gfb_restart_fields, only: put_vector, read_vector, put_contacts, read_contacts, put_contact_record, &
                                read_contact_record
  use gfb_strip_record, only: strip_run_type
  implicit none (type)
  private
  public :: keep_strip, recall_strip

  integer, parameter :: plain_numbers = 8 !! of an answer, before its counts and deflections

contains

  !> Writes the file after a step, if one is due.
  subroutine keep_strip(scene, restart, log, strip, newton, path, run)
    type(scene_type), intent(in) :: scene
    type(restart_type), intent(in) :: restart
    type(run_log_type), intent(in) :: log
    type(strip_system_type), intent(in) :: strip
    type(newton_type), intent(inout) :: newton
    type(load_path_type), intent(in) :: path
    type(strip_run_type), intent(in) :: run

    type(result_file_type) :: file
    type(error_type), allocatable :: error

    if (.not. restart%is_due(run%steps)) return
    call forget_factors(newton)
    call begin_restart_file(scene, restart, run%steps, file, error)
    if (.not. allocated(error)) then
      call put_state(strip, newton, path, file)
      call put_rows(file, '/history', run%history)
      call file%group('/record')
      call file%put_numbers('/record/full', answer_numbers(run%full), 'SI', 'answer at the largest load so far')
      call file%put_numbers('/record/last', answer_numbers(run%last), 'SI', 'answer of the last step')
      call put_contact_record(strip%contacts, strip%foil%mesh%rows, run%contacts, run%steps, '/record/contacts', &
                              file)
    end if
    call end_restart_file(file, log, error)
  end subroutine keep_strip

  !> States, contacts, counters.
  subroutine put_state(strip, newton, path, file)
    type(strip_system_type), intent(in) :: strip
    type(newton_type), intent(in) :: newton
    type(load_path_type), intent(in) :: path
    type(result_file_type), intent(inout) :: file

    call file%put_numbers('/step/counts', real([newton%iterations, newton%factorizations, path%homotopies, &
                                                path%cuts, path%answers, path%at_round_off], wp), '1', &
                          'Newton iterations, factorizations, homotopies, cuts, answers that are known, steps at round-off')
    call file%put_numbers('/step/factors', [path%at_here, path%at_before, path%round_off], '1', &
                          'shares of the full load at the last two answers, round-off')
    call file%group('/strip')
    call put_vector(strip_order(strip), path%here, '/strip/state', 'scaled unknowns: foil, plate', file)
    call put_vector(strip_order(strip), path%before, '/strip/state_before', 'the same of the answer before', file)
    call put_contacts(strip%contacts, strip%foil%mesh%rows, '/strip/contacts', file)
  end subroutine put_state

  !> An answer as plain numbers.
  pure function answer_numbers(answer) result(numbers)
    type(strip_answer_type), intent(in) :: answer
    real(wp), allocatable :: numbers(:)

    numbers = [answer%factor, answer%force, answer%travel, answer%external_work, answer%strain_energy, &
               answer%penalty_energy, answer%friction_work, answer%round_off, &
               real(reshape(answer%count, [size(answer%count)]), wp), answer%deflection]
  end function answer_numbers

  !> The reverse; `deflection` has its size.
  pure subroutine recall_answer(numbers, answer)
    real(wp), intent(in) :: numbers(:)
    type(strip_answer_type), intent(inout) :: answer
    integer :: counts

    counts = size(answer%count)
    answer%factor = numbers(1)
    answer%force = numbers(2)
    answer%travel = numbers(3)
    answer%external_work = numbers(4)
    answer%strain_energy = numbers(5)
    answer%penalty_energy = numbers(6)
    answer%friction_work = numbers(7)
    answer%round_off = numbers(plain_numbers)
    answer%count = reshape(nint(numbers(plain_numbers + 1:plain_numbers + counts)), shape(answer%count))
    answer%deflection = numbers(plain_numbers + counts + 1:)
  end subroutine recall_answer

  !> Puts a strip where the file says.
  !>
  !> Fails when the file is damaged.
  subroutine recall_strip(restart, steps, log, strip, newton, path, recorder, run, error)
    type(restart_type), intent(in) :: restart
    integer, intent(in) :: steps !! that there will be
    type(run_log_type), intent(in) :: log
    type(strip_system_type), intent(inout) :: strip
    type(newton_type), intent(inout) :: newton
    type(load_path_type), intent(inout) :: path
    type(strip_recorder_type), intent(inout) :: recorder
    type(strip_run_type), intent(inout) :: run !! with its deflections' sizes
    type(error_type), allocatable, intent(out) :: error

    type(stored_file_type) :: file
    PetscErrorCode :: ierr

    call open_restart(restart, file, error)
    if (allocated(error)) return
    run%steps = file%count('/step/number')
    call read_state(file, strip, newton, path)
    call read_rows(file, '/history', run%history)
    call read_answer(file, '/record/full', run%full)
    call read_answer(file, '/record/last', run%last)
    call read_contact_record(strip%contacts, strip%foil%mesh%rows, run%steps, '/record/contacts', file, run%contacts)
    call check_restart_file(file, error)
    call close_stored_file(file)
    if (allocated(error)) return
    PetscCallA(VecCopy(path%here, strip%state, ierr))
    call strip%set_factor(path%at_here)
    call resume_recorder(strip, run%last, recorder)
    call log%line('restart: goes on from step '//text(run%steps)//' of '//text(steps))
  end subroutine recall_strip

  !> The reverse of `put_state`.
  subroutine read_state(file, strip, newton, path)
    type(stored_file_type), intent(inout) :: file
    type(strip_system_type), intent(inout) :: strip
    type(newton_type), intent(inout) :: newton
    type(load_path_type), intent(inout) :: path
    real(wp), allocatable :: count(:), factor(:)

    count = file%numbers('/step/counts')
    factor = file%numbers('/step/factors')
    if (size(count) /= 6 .or. size(factor) /= 3) file%failed = .true.
    if (.not. file%failed) then
      newton%iterations = nint(count(1))
      newton%factorizations = nint(count(2))
      path%homotopies = nint(count(3))
      path%cuts = nint(count(4))
      path%answers = nint(count(5))
      path%at_here = factor(1)
      path%at_before = factor(2)
      path%at_round_off = nint(count(6))
      path%round_off = factor(3)
    end if
    call read_vector(strip_order(strip), '/strip/state', file, path%here)
    call read_vector(strip_order(strip), '/strip/state_before', file, path%before)
    call read_contacts(strip%foil%mesh%rows, '/strip/contacts', file, strip%contacts)
  end subroutine read_state

  !> Reads an answer.
  subroutine read_answer(file, path, answer)
    type(stored_file_type), intent(inout) :: file
    character(len=*), intent(in) :: path
    type(strip_answer_type), intent(inout) :: answer !! with its deflections' size
    real(wp), allocatable :: number(:)

    number = file%numbers(path)
    if (size(number) == plain_numbers + size(answer%count) + size(answer%deflection)) then
      call recall_answer(number, answer)
    else
      file%failed = .true.
    end if
  end subroutine read_answer
end module gfb_strip_restart
