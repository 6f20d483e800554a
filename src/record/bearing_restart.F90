#include "gfb_petsc.h"
!> A sweep's restart file: the bearing at a point, its contacts, and all that was recorded.
module gfb_bearing_restart
  use petscvec
  use gfb_kinds, only: wp
  use gfb_errors, only: error_type
  use gfb_text, only: text
  use gfb_run_log, only: run_log_type
  use gfb_petsc_session, only: wall_time
  use gfb_scene, only: scene_type
  use gfb_natural_order, only: natural_order_type, bearing_order, path_order
  use gfb_operating_point, only: operating_point_type
  use gfb_bearing_system, only: bearing_system_type
  use gfb_bearing_builder, only: bearing_plan_type, build_bearing
  use gfb_newton, only: newton_type, newton_settings_type, create_newton, forget_factors
  use gfb_arc_length, only: create_arc
  use gfb_arc_memory, only: arc_memory_size, arc_numbers, recall_arc
  use gfb_fold_way, only: fold_way_type
  use gfb_case_file, only: history_row_type
  use gfb_history_store, only: put_rows, read_rows
  use gfb_result_file, only: result_file_type
  use gfb_stored_file, only: stored_file_type, close_stored_file
  use gfb_tilt_response, only: response_numbers, recall_response
  use gfb_bearing_record, only: bearing_record_type, sweep_name, sweep_unit
  use gfb_restart, only: restart_type, begin_restart_file, end_restart_file, open_restart, check_restart_file
  use gfb_restart_fields, only: put_vector, read_vector, put_contacts, read_contacts, put_contact_record, &
                                read_contact_record
  implicit none (type)
  private
  public :: keep_bearing, recall_bearing, recall_way

  integer, parameter :: point_size = 9 !! numbers of an operating point
  character(len=*), parameter :: point_words = &
    'speed, load, eccentricity, tilt, pull and tension on the free edge'

contains

  !> Writes the file after a point.
  subroutine keep_bearing(scene, restart, log, point, bearing, newton, record, way)
    type(scene_type), intent(in) :: scene
    type(restart_type), intent(in) :: restart
    type(run_log_type), intent(in) :: log
    integer, intent(in) :: point !! of the sweep; 0: where the shaft is held
    type(bearing_system_type), intent(in) :: bearing
    type(newton_type), intent(inout) :: newton
    type(bearing_record_type), intent(in) :: record
    type(fold_way_type), intent(inout), optional :: way !! along a branch that is followed round its folds

    type(result_file_type) :: file
    type(error_type), allocatable :: error

    call forget_factors(newton)
    if (present(way)) call forget_factors(way%arc%newton)
    call begin_restart_file(scene, restart, point, file, error)
    if (.not. allocated(error)) then
      call put_state(bearing, newton, file)
      call put_record(bearing, record, file)
      if (present(way)) call put_way(bearing, way, file)
    end if
    call end_restart_file(file, log, error)
  end subroutine keep_bearing

  !> State, operating point, contacts, counters.
  subroutine put_state(bearing, newton, file)
    type(bearing_system_type), intent(in) :: bearing
    type(newton_type), intent(in) :: newton
    type(result_file_type), intent(inout) :: file

    call file%put_scalar('/step/newton_iterations', real(newton%iterations, wp), '1', 'so far')
    call file%put_scalar('/step/factorizations', real(newton%factorizations, wp), '1', 'so far')
    call file%group('/bearing')
    call file%put_scalar('/bearing/held', merge(1.0_wp, 0.0_wp, bearing%held), '1', 'the shaft is held')
    call file%put_scalar('/bearing/upwind', merge(1.0_wp, 0.0_wp, bearing%film%flow%upwind), '1', &
                         'the film''s elements are')
    call file%put_numbers('/bearing/point', point_numbers(bearing%point), 'SI', point_words)
    call put_vector(bearing_order(bearing), bearing%state, '/bearing/state', &
                    'scaled unknowns: film, foil, shaft', file)
    call put_contacts(bearing%foil%contacts, bearing%foil%contacts%rows, '/bearing/contacts', file)
  end subroutine put_state

  !> An operating point as plain numbers.
  pure function point_numbers(point) result(number)
    type(operating_point_type), intent(in) :: point
    real(wp) :: number(point_size)

    number = [point%speed, point%load, point%eccentricity, point%tilt, point%edge_pull, point%edge_tension]
  end function point_numbers

  !> Reads an operating point.
  subroutine read_point(file, path, point)
    type(stored_file_type), intent(inout) :: file
    character(len=*), intent(in) :: path
    type(operating_point_type), intent(inout) :: point
    real(wp), allocatable :: number(:)

    number = file%numbers(path)
    if (size(number) /= point_size) file%failed = .true.
    if (file%failed) return
    point = operating_point_type(number(1), number(2:3), number(4:5), number(6:7), number(8), number(9))
  end subroutine read_point

  !> Where a branch has led.
  subroutine put_way(bearing, way, file)
    type(bearing_system_type), intent(in) :: bearing
    type(fold_way_type), intent(in) :: way
    type(result_file_type), intent(inout) :: file
    type(natural_order_type) :: order

    order = path_order(bearing)
    call file%group('/branch')
    call file%put_numbers('/branch/first', point_numbers(way%first), 'SI', point_words)
    call file%put_numbers('/branch/kept', [real(way%kept, wp), way%kept_heading], '1', &
                          'value whose answer was kept last, and in which sense it was passed')
    call file%put_numbers('/branch/arc', arc_numbers(way%arc), '1', 'places, lengths and counts of the steps')
    associate (arc => way%arc)
      call put_vector(order, arc%path%state, '/branch/state', 'scaled unknowns, place', file)
      call put_vector(order, arc%previous, '/branch/previous', 'the answer before', file)
      call put_vector(order, arc%earlier, '/branch/earlier', 'the one before that', file)
      call put_vector(order, arc%tangent, '/branch/tangent', 'at the last answer', file)
      call put_vector(order, arc%previous_tangent, '/branch/previous_tangent', 'at the answer before', file)
      call put_vector(order, arc%earlier_tangent, '/branch/earlier_tangent', 'at the one before that', file)
    end associate
  end subroutine put_way

  !> Goes on along the branch where the file has one; otherwise nothing is done.
  !>
  !> Fails when the file is damaged.
  subroutine recall_way(restart, last, bearing, newton, way, there, error)
    type(restart_type), intent(in) :: restart
    type(operating_point_type), intent(in) :: last !! of the sweep
    type(bearing_system_type), target, intent(inout) :: bearing
    type(newton_type), intent(in) :: newton
    type(fold_way_type), target, intent(inout) :: way
    logical, intent(out) :: there !! the branch had been begun
    type(error_type), allocatable, intent(out) :: error
    type(stored_file_type) :: file
    type(natural_order_type) :: order
    real(wp), allocatable :: number(:), kept(:)

    there = .false.
    call open_restart(restart, file, error)
    if (allocated(error)) return
    there = file%has('/branch')
    if (there) then
      order = path_order(bearing)
      call read_point(file, '/branch/first', bearing%point)
      way%first = bearing%point
      call create_arc(bearing, newton, last, way%arc)
      kept = file%numbers('/branch/kept')
      number = file%numbers('/branch/arc')
      call read_vector(order, '/branch/state', file, way%arc%path%state)
      call read_vector(order, '/branch/previous', file, way%arc%previous)
      call read_vector(order, '/branch/earlier', file, way%arc%earlier)
      call read_vector(order, '/branch/tangent', file, way%arc%tangent)
      call read_vector(order, '/branch/previous_tangent', file, way%arc%previous_tangent)
      call read_vector(order, '/branch/earlier_tangent', file, way%arc%earlier_tangent)
      if (size(kept) /= 2 .or. size(number) /= arc_memory_size) file%failed = .true.
    end if
    call check_restart_file(file, error)
    call close_stored_file(file)
    if (allocated(error) .or. .not. there) return
    way%kept = nint(kept(1))
    way%kept_heading = kept(2)
    call recall_arc(number, way%arc)
  end subroutine recall_way

  !> Rows and contacts of the points so far, and what is known of the last.
  subroutine put_record(bearing, record, file)
    type(bearing_system_type), intent(in) :: bearing
    type(bearing_record_type), intent(in) :: record
    type(result_file_type), intent(inout) :: file
    type(history_row_type) :: judged(1)

    call file%put_scalar('/step/elapsed', wall_time() - record%begun, 's', 'since the first answer')
    call put_rows(file, '/history', record%history)
    if (allocated(record%judged)) judged(1)%quantity = record%judged
    call put_rows(file, '/judged', judged)
    call file%group('/record')
    call file%put_numbers('/record/tilt_response', response_numbers(record%tilted), 'SI', &
                          'slopes of the torque and what belongs to them')
    if (size(record%history) == 0 .or. .not. bearing%foil%has_contacts()) return
    call put_contact_record(bearing%foil%nodal_contacts(), bearing%foil%contacts%rows, record%contacts, &
                            size(record%history), '/record/contacts', file)
  end subroutine put_record

  !> Builds a scene's equations and puts them where the file says.
  !>
  !> Fails when the mesh cannot be cut, or the file is damaged.
  subroutine recall_bearing(scene, plan, restart, settings, log, bearing, newton, record, point, error)
    type(scene_type), intent(in) :: scene
    type(bearing_plan_type), intent(in) :: plan
    type(restart_type), intent(in) :: restart
    type(newton_settings_type), intent(in) :: settings
    type(run_log_type), intent(in) :: log
    type(bearing_system_type), target, intent(inout) :: bearing
    type(newton_type), target, intent(inout) :: newton
    type(bearing_record_type), intent(inout) :: record
    integer, intent(out) :: point !! of the sweep that was done last; 0: where the shaft is held
    type(error_type), allocatable, intent(out) :: error
    type(stored_file_type) :: file

    point = 0
    call build_bearing(scene, plan, bearing, error)
    if (allocated(error)) return
    call create_newton(newton, bearing, 'bearing_', settings, log)
    call open_restart(restart, file, error)
    if (allocated(error)) return
    point = file%count('/step/number')
    call read_state(file, bearing, newton)
    call read_record(file, bearing, record)
    call check_restart_file(file, error)
    call close_stored_file(file)
    if (allocated(error)) return
    if (scene%sweep%turn_folds .and. point > 1) then
      call log%line('restart: goes on from answer '//text(point)//' of the branch')
    else if (point == 0) then
      call log%line('restart: goes on from where the shaft is held')
    else
      call log%line('restart: goes on from point '//text(point)//' of '//text(size(scene%sweep%values))//', '// &
                    sweep_name(scene%sweep)//' = '//text(scene%sweep%values(point))//' '//sweep_unit(scene%sweep))
    end if
  end subroutine recall_bearing

  !> The reverse of `put_state`.
  subroutine read_state(file, bearing, newton)
    type(stored_file_type), intent(inout) :: file
    type(bearing_system_type), intent(inout) :: bearing
    type(newton_type), intent(inout) :: newton

    newton%iterations = file%count('/step/newton_iterations')
    newton%factorizations = file%count('/step/factorizations')
    bearing%held = file%count('/bearing/held') == 1
    bearing%film%flow%upwind = file%count('/bearing/upwind') == 1
    call read_point(file, '/bearing/point', bearing%point)
    call read_vector(bearing_order(bearing), '/bearing/state', file, bearing%state)
    call read_contacts(bearing%foil%contacts%rows, '/bearing/contacts', file, bearing%foil%contacts)
  end subroutine read_state

  !> The reverse of `put_record`.
  subroutine read_record(file, bearing, record)
    type(stored_file_type), intent(inout) :: file
    type(bearing_system_type), intent(in) :: bearing
    type(bearing_record_type), intent(inout) :: record
    type(history_row_type), allocatable :: judged(:)
    real(wp), allocatable :: number(:)

    record%begun = wall_time() - file%scalar('/step/elapsed')
    call read_rows(file, '/history', record%history)
    call read_rows(file, '/judged', judged)
    number = file%numbers('/record/tilt_response')
    if (size(judged) /= 1 .or. size(number) /= size(response_numbers(record%tilted))) file%failed = .true.
    if (file%failed) return
    record%judged = judged(1)%quantity
    call recall_response(number, record%tilted)
    if (size(record%history) == 0 .or. .not. bearing%foil%has_contacts()) return
    call read_contact_record(bearing%foil%nodal_contacts(), bearing%foil%contacts%rows, size(record%history), &
                             '/record/contacts', file, record%contacts)
  end subroutine read_record
end module gfb_bearing_restart
