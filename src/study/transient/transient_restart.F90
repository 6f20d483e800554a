#include "gfb_petsc.h"
!> The restart file of a shaft over time: the bearing, the last three states, and the lines so far.
module gfb_transient_restart
  use petscvec
  use gfb_memory, only: memory_type
  use gfb_text, only: text
  use gfb_errors, only: error_type
  use gfb_scene, only: scene_type
  use gfb_run_log, only: run_log_type
  use gfb_natural_order, only: bearing_order
  use gfb_bearing_system, only: bearing_system_type
  use gfb_newton, only: newton_type, forget_factors
  use gfb_result_file, only: result_file_type
  use gfb_stored_file, only: stored_file_type, close_stored_file
  use gfb_bearing_record, only: bearing_record_type
  use gfb_bearing_restart, only: put_state, put_record
  use gfb_restart, only: restart_type, begin_restart_file, end_restart_file, open_restart, check_restart_file
  use gfb_restart_fields, only: put_memory, read_memory, end_memory, put_vector, read_vector
  use gfb_time_march, only: march_type, rebuild_past
  use gfb_foil_mass_choice, only: resume_momentum
  use gfb_transient_history, only: transient_history_type
  use gfb_spring_restart, only: keep_springs, recall_past_springs
  use gfb_mode_restart, only: keep_modes, recall_modes
  implicit none (type)
  private
  public :: keep_march, recall_march

contains

  !> Writes the file after a step.
  subroutine keep_march(scene, restart, log, bearing, newton, record, march, history)
    type(scene_type), intent(in) :: scene !! what is asked for
    type(restart_type), intent(in) :: restart !! name and origin of the file
    type(run_log_type), intent(in) :: log !! where lines go
    type(bearing_system_type), intent(inout) :: bearing !! at the newest state
    type(newton_type), intent(inout) :: newton !! its solver; loses its factors where files are asked for
    type(bearing_record_type), intent(inout) :: record !! of the steady state before
    type(march_type), intent(inout) :: march !! its past
    type(transient_history_type), intent(inout) :: history !! the lines so far
    type(result_file_type) :: file
    type(error_type), allocatable :: error
    type(memory_type) :: memory
    logical :: has_mass

    if (restart%every > 0) call forget_factors(newton)
    call begin_restart_file(scene, restart, march%steps, file, error)
    if (.not. allocated(error)) then
      call put_state(bearing, newton, file)
      call put_record(bearing, record, file)
      has_mass = bearing%momentum%present
      call remember_march(memory, march, has_mass)
      call history%remember(memory)
      call put_memory(memory, '/march', 'place and speed of the shaft, steps, lines so far', file)
      call put_vector(bearing_order(bearing), march%state(2), '/march/before', 'scaled unknowns one step ago', file)
      call put_vector(bearing_order(bearing), march%state(3), '/march/before_that', 'scaled unknowns two steps ago', file)
      if (has_mass) then
        call put_vector(bearing_order(bearing), bearing%momentum%rate(1), '/march/rate', 'of the scaled unknowns [1/s]', file)
        call put_vector(bearing_order(bearing), bearing%momentum%rate(2), '/march/rate_before', 'the same one step ago', file)
        call keep_modes(bearing%momentum%inner, file)
      end if
      call keep_springs(bearing, march, file)
    end if
    call end_restart_file(file, log, error)
  end subroutine keep_march

  !> Puts a march that has begun anew where the file says; the bearing stands there already (`recall_bearing`).
  !>
  !> Fails when the file is damaged.
  subroutine recall_march(scene, restart, bearing, march, history, error)
    type(scene_type), intent(in) :: scene !! what is asked for
    type(restart_type), intent(in) :: restart !! the file to resume from
    type(bearing_system_type), intent(inout) :: bearing !! at the newest state
    type(march_type), intent(inout) :: march !! gets its past
    type(transient_history_type), intent(inout) :: history !! gets the lines so far
    type(error_type), allocatable, intent(out) :: error !! why it failed
    type(stored_file_type) :: file
    type(memory_type) :: memory
    logical :: has_mass

    call open_restart(restart, file, error)
    if (allocated(error)) return
    call read_memory('/march', file, memory)
    has_mass = .false.
    call remember_march(memory, march, has_mass)
    call history%remember(memory)
    call end_memory(memory, file)
    call read_vector(bearing_order(bearing), '/march/before', file, march%state(2))
    call read_vector(bearing_order(bearing), '/march/before_that', file, march%state(3))
    if (has_mass) then
      call resume_momentum(scene, bearing)
      call read_vector(bearing_order(bearing), '/march/rate', file, bearing%momentum%rate(1))
      call read_vector(bearing_order(bearing), '/march/rate_before', file, bearing%momentum%rate(2))
      call recall_modes(file, bearing%momentum%inner)
    end if
    call recall_past_springs(bearing, file, march)
    call check_restart_file(file, error)
    call close_stored_file(file)
    if (allocated(error)) return
    call rebuild_past(bearing, march)
  end subroutine recall_march

  !> Packs or unpacks all but what follows from the states.
  subroutine remember_march(memory, march, has_mass)
    type(memory_type), intent(inout) :: memory
    type(march_type), intent(inout) :: march
    logical, intent(inout) :: has_mass !! of the foils
    integer :: i

    call memory%visit('time', march%time)
    call memory%visit('step', march%step)
    call memory%visit('next', march%next)
    call memory%visit('steps', march%steps)
    call memory%visit('rejections', march%rejections)
    call memory%visit('velocity', march%velocity)
    call memory%visit('place', march%place)
    call memory%visit('first_place', march%first_place)
    call memory%visit('past_step', march%past_step)
    call memory%visit('start', march%start%eccentricity)
    call memory%visit('foil_mass', has_mass)
    do i = 1, size(march%pad)
      if (march%pad(i)%springs%local) call memory%visit('spring_drag_'//text(i), march%pad(i)%springs%drag)
    end do
  end subroutine remember_march
end module gfb_transient_restart
