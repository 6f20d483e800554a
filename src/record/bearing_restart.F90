#include "gfb_petsc.h"
!> A sweep's restart file: the bearing at a point, its contacts, and all that was recorded.
module gfb_bearing_restart
  use petscvec
  use gfb_memory, only: memory_type
  use gfb_errors, only: error_type
  use gfb_text, only: text
  use gfb_run_log, only: run_log_type
  use gfb_scene, only: scene_type
  use gfb_natural_order, only: natural_order_type, bearing_order, path_order
  use gfb_operating_point, only: operating_point_type, remember_point
  use gfb_bearing_system, only: bearing_system_type
  use gfb_pad_contacts, only: pad_contacts, set_upwind
  use gfb_newton, only: newton_type, forget_factors
  use gfb_arc, only: create_arc
  use gfb_arc_memory, only: remember_arc, resume_arc
  use gfb_fold_way, only: fold_way_type, remember_way
  use gfb_grid_series, only: forget_numbers
  use gfb_petsc_session, only: this_rank
  use gfb_result_file, only: result_file_type
  use gfb_stored_file, only: stored_file_type, close_stored_file
  use gfb_bearing_record, only: bearing_record_type, remember_record, sweep_name, sweep_unit
  use gfb_restart, only: restart_type, begin_restart_file, end_restart_file, open_restart, check_restart_file
  use gfb_restart_fields, only: put_memory, read_memory, end_memory, put_vector, read_vector, put_contacts, &
                                read_contacts, put_contact_record, read_contact_record
  implicit none (type)
  private
  public :: keep_bearing, find_restart_point, recall_bearing, recall_way, remember_bearing, put_state, put_record

contains

  !> Writes the file after a point.
  subroutine keep_bearing(scene, restart, log, point, bearing, newton, record, branch)
    type(scene_type), intent(in) :: scene !! what is asked for
    type(restart_type), intent(in) :: restart !! name and origin of the file
    type(run_log_type), intent(in) :: log !! where lines go
    integer, intent(in) :: point !! of the sweep; 0: the equilibrium at which the shaft is fixed
    type(bearing_system_type), intent(inout) :: bearing !! at the point's answer
    type(newton_type), intent(inout) :: newton !! its solver; loses its factors
    type(bearing_record_type), intent(inout) :: record !! of the points so far
    type(fold_way_type), intent(inout), optional :: branch !! along a branch that is followed round its folds

    type(result_file_type) :: file
    type(error_type), allocatable :: error

    if (restart%every > 0) then
      call forget_factors(newton)
      if (present(branch)) call forget_factors(branch%arc%newton)
    end if
    call begin_restart_file(scene, restart, point, file, error)
    if (.not. allocated(error)) then
      call put_state(bearing, newton, file)
      call put_record(bearing, record, file)
      if (present(branch)) call put_way(bearing, branch, file)
    end if
    call end_restart_file(file, log, error)
  end subroutine keep_bearing

  !> Packs or unpacks what is one for the whole bearing: operating point, switches, counters.
  subroutine remember_bearing(memory, bearing, newton)
    type(memory_type), intent(inout) :: memory !! that packs or unpacks
    type(bearing_system_type), intent(inout) :: bearing !! written where the memory unpacks
    type(newton_type), intent(inout) :: newton          !! the same
    logical :: upwind

    call memory%visit('shaft_fixed', bearing%shaft_fixed)
    upwind = bearing%pad(1)%film%flow%upwind
    call memory%visit('upwind', upwind)
    call set_upwind(bearing, upwind)
    call remember_point(memory, bearing%point)
    call memory%visit('newton_iterations', newton%iterations)
    call memory%visit('factorizations', newton%factorizations)
    call memory%visit('factorizations_before', newton%factorizations_before)
  end subroutine remember_bearing

  !> State, operating point, contacts, counters.
  subroutine put_state(bearing, newton, file)
    type(bearing_system_type), intent(inout) :: bearing !! at an answer
    type(newton_type), intent(inout) :: newton !! its solver
    type(result_file_type), intent(inout) :: file !! that is being written
    type(memory_type) :: memory
    integer :: i

    call remember_bearing(memory, bearing, newton)
    call put_memory(memory, '/bearing', 'operating point, switches and counters', file)
    call put_vector(bearing_order(bearing), bearing%state, '/bearing/state', &
                    'scaled unknowns: film, foil, shaft', file)
    do i = 1, size(bearing%pad)
      associate (contacts => bearing%pad(i)%foil%contacts)
        call put_contacts(contacts, contacts%rows, contacts_of(i), file)
      end associate
    end do
  end subroutine put_state

  !> The group of a pad's contacts.
  pure function contacts_of(pad) result(group)
    integer, intent(in) :: pad !! its number
    character(len=:), allocatable :: group

    group = '/bearing/contacts'
    if (pad > 1) group = group//'_'//text(pad)
  end function contacts_of

  !> Where a branch has led.
  subroutine put_way(bearing, branch, file)
    type(bearing_system_type), intent(in) :: bearing
    type(fold_way_type), intent(inout) :: branch
    type(result_file_type), intent(inout) :: file
    type(natural_order_type) :: order
    type(memory_type) :: begun, arc_memory

    order = path_order(bearing)
    call remember_way(begun, branch)
    call put_memory(begun, '/branch', 'where it begins, value that was kept last', file)
    call remember_arc(arc_memory, branch%arc)
    call put_memory(arc_memory, '/branch/arc', 'path parameters, lengths and counts of the steps', file)
    associate (arc => branch%arc)
      call put_vector(order, arc%path%state, '/branch/state', 'scaled unknowns, path parameter', file)
      call put_vector(order, arc%previous, '/branch/previous', 'the answer before', file)
      call put_vector(order, arc%earlier, '/branch/earlier', 'the one before that', file)
      call put_vector(order, arc%tangent, '/branch/tangent', 'at the last answer', file)
      call put_vector(order, arc%previous_tangent, '/branch/previous_tangent', 'at the answer before', file)
      call put_vector(order, arc%earlier_tangent, '/branch/earlier_tangent', 'at the one before that', file)
    end associate
  end subroutine put_way

  !> Resumes the branch where the file has one; otherwise nothing is done.
  !>
  !> Fails when the file is damaged.
  subroutine recall_way(restart, last, bearing, newton, branch, there, error)
    type(restart_type), intent(in) :: restart !! name of the file
    type(operating_point_type), intent(in) :: last !! of the sweep
    type(bearing_system_type), target, intent(inout) :: bearing !! as `recall_bearing` left it; put at the branch's last answer
    type(newton_type), intent(in) :: newton !! of the bearing: its settings
    type(fold_way_type), target, intent(inout) :: branch !! out: the branch as the file has it
    logical, intent(out) :: there !! the branch had been begun
    type(error_type), allocatable, intent(out) :: error !! why it failed
    type(stored_file_type) :: file
    type(natural_order_type) :: order
    type(memory_type) :: memory

    there = .false.
    call open_restart(restart, file, error)
    if (allocated(error)) return
    there = file%has('/branch')
    if (there) then
      order = path_order(bearing)
      call read_memory('/branch', file, memory)
      call remember_way(memory, branch)
      call end_memory(memory, file)
      bearing%point = branch%first
      call create_arc(bearing, newton, last, branch%arc)
      call read_memory('/branch/arc', file, memory)
      call remember_arc(memory, branch%arc)
      call end_memory(memory, file)
      call read_vector(order, '/branch/state', file, branch%arc%path%state)
      call read_vector(order, '/branch/previous', file, branch%arc%previous)
      call read_vector(order, '/branch/earlier', file, branch%arc%earlier)
      call read_vector(order, '/branch/tangent', file, branch%arc%tangent)
      call read_vector(order, '/branch/previous_tangent', file, branch%arc%previous_tangent)
      call read_vector(order, '/branch/earlier_tangent', file, branch%arc%earlier_tangent)
    end if
    call check_restart_file(file, error)
    call close_stored_file(file)
    if (allocated(error) .or. .not. there) return
    call resume_arc(branch%arc)
  end subroutine recall_way

  !> Rows and contacts of the points so far, and what is known of the last.
  subroutine put_record(bearing, record, file)
    type(bearing_system_type), intent(in) :: bearing !! whose contacts they are
    type(bearing_record_type), intent(inout) :: record !! what is recorded
    type(result_file_type), intent(inout) :: file !! that is being written
    type(memory_type) :: memory

    call remember_record(memory, record)
    call put_memory(memory, '/record', 'history, what else is known of the last answer, tilt response', file)
    if (.not. allocated(record%history)) return
    if (size(record%history) == 0 .or. .not. bearing%pad(1)%foil%has_contacts()) return
    call put_contact_record(pad_contacts(bearing), bearing%pad(1)%foil%contacts%rows, record%contacts, &
                            size(record%history), '/record/contacts', file)
  end subroutine put_record

  !> The point after which the file was written.
  !>
  !> Fails when the file is damaged.
  subroutine find_restart_point(restart, point, error)
    type(restart_type), intent(in) :: restart !! the file to resume from
    integer, intent(out) :: point !! of the sweep; 0: where the shaft is held
    type(error_type), allocatable, intent(out) :: error !! why it failed
    type(stored_file_type) :: file

    point = 0
    call open_restart(restart, file, error)
    if (allocated(error)) return
    point = file%count('/step/number')
    call check_restart_file(file, error)
    call close_stored_file(file)
  end subroutine find_restart_point

  !> Puts a scene's equations where the file says.
  !>
  !> Fails when the file is damaged.
  subroutine recall_bearing(scene, restart, log, bearing, newton, record, point, error)
    type(scene_type), intent(in) :: scene !! what the case file asks for
    type(restart_type), intent(in) :: restart !! the file to resume from
    type(run_log_type), intent(in) :: log !! gets the lines of progress
    type(bearing_system_type), target, intent(inout) :: bearing !! is put where the file says
    type(newton_type), target, intent(inout) :: newton !! gets its counts
    type(bearing_record_type), intent(inout) :: record !! gets the points so far
    integer, intent(out) :: point !! of the sweep that was done last; 0: where the shaft is held
    type(error_type), allocatable, intent(out) :: error !! why it failed
    type(stored_file_type) :: file

    point = 0
    call open_restart(restart, file, error)
    if (allocated(error)) return
    point = file%count('/step/number')
    call read_state(file, bearing, newton)
    call read_record(file, bearing, record)
    call check_restart_file(file, error)
    call close_stored_file(file)
    if (allocated(error)) return
    if (.not. scene%sweep%present) return
    if (scene%sweep%turn_folds .and. point > 1) then
      call log%line('restart: resumed from answer '//text(point)//' of the branch')
    else if (point == 0) then
      call log%line('restart: resumed from the equilibrium at which the shaft is fixed')
    else
      call log%line('restart: resumed from point '//text(point)//' of '//text(size(scene%sweep%values))//', '// &
                    sweep_name(scene%sweep)//' = '//text(scene%sweep%values(point))//' '//sweep_unit(scene%sweep))
    end if
  end subroutine recall_bearing

  !> The reverse of `put_state`.
  subroutine read_state(file, bearing, newton)
    type(stored_file_type), intent(inout) :: file
    type(bearing_system_type), intent(inout) :: bearing
    type(newton_type), intent(inout) :: newton
    type(memory_type) :: memory
    integer :: i

    call read_memory('/bearing', file, memory)
    call remember_bearing(memory, bearing, newton)
    call end_memory(memory, file)
    call read_vector(bearing_order(bearing), '/bearing/state', file, bearing%state)
    do i = 1, size(bearing%pad)
      associate (contacts => bearing%pad(i)%foil%contacts)
        call read_contacts(contacts%rows, contacts_of(i), file, contacts)
      end associate
    end do
  end subroutine read_state

  !> The reverse of `put_record`.
  subroutine read_record(file, bearing, record)
    type(stored_file_type), intent(inout) :: file
    type(bearing_system_type), intent(in) :: bearing
    type(bearing_record_type), intent(inout) :: record
    type(memory_type) :: memory

    call read_memory('/record', file, memory)
    call remember_record(memory, record)
    call end_memory(memory, file)
    if (file%failed) return
    if (this_rank() > 0) call forget_numbers(record%series)
    if (size(record%history) == 0 .or. .not. bearing%pad(1)%foil%has_contacts()) return
    call read_contact_record(pad_contacts(bearing), bearing%pad(1)%foil%contacts%rows, size(record%history), &
                             '/record/contacts', file, record%contacts)
  end subroutine read_record
end module gfb_bearing_restart
