#include "gfb_petsc.h"
!> A sweep that goes on where what it changes turns back: the branch of answers is followed by its own
!> length, round its folds, until it leaves the range of the sweep's values.
module gfb_fold_sweep
  use petscsys
  use gfb_kinds, only: wp
  use gfb_errors, only: error_type
  use gfb_text, only: text
  use gfb_run_log, only: run_log_type
  use gfb_scene, only: scene_type
  use gfb_operating_point, only: operating_point_type, point_between
  use gfb_bearing_system, only: bearing_system_type
  use gfb_newton, only: newton_type, newton_report_type, solve_newton
  use gfb_continuation, only: path_settings_type, path_report_type
  use gfb_arc_length, only: begin_arc, advance_arc, end_arc
  use gfb_fold_way, only: fold_way_type
  use gfb_answer_judgement, only: judge_answer
  use gfb_tilt_response, only: measure_tilt
  use gfb_restart, only: restart_type
  use gfb_bearing_restart, only: keep_bearing, recall_way
  use gfb_bearing_record, only: bearing_record_type, add_row, sweep_name, sweep_unit
  implicit none (type)
  private
  public :: sweep_round_folds

  integer, parameter :: most_steps = 2000 !! along the branch

contains

  !> Follows the branch from the first value's answer, which has been kept, or from where a restart file
  !> says; the bearing is left at the last answer.
  !>
  !> Fails when that file is damaged.
  subroutine sweep_round_folds(scene, restart, log, last, settings, bearing, newton, record, report, error)
    type(scene_type), intent(in) :: scene
    type(restart_type), intent(in) :: restart
    type(run_log_type), intent(in) :: log
    type(operating_point_type), intent(in) :: last !! of the sweep
    type(path_settings_type), intent(in) :: settings
    type(bearing_system_type), target, intent(inout) :: bearing
    type(newton_type), target, intent(inout) :: newton
    type(bearing_record_type), intent(inout) :: record
    type(path_report_type), intent(out) :: report
    type(error_type), allocatable, intent(out) :: error
    type(fold_way_type), target :: way
    real(wp) :: gap
    integer :: kept
    logical :: moved, again, ended, begun

    way%first = bearing%point
    way%last = last
    associate (values => scene%sweep%values)
      way%place = (values - values(1))/(values(size(values)) - values(1))
    end associate
    begun = .false.
    if (restart%goes_on) then
      call bearing%linearise(bearing%state) ! an arc needs to know which entries the matrix has
      call recall_way(restart, last, bearing, newton, way, begun, error)
      if (allocated(error)) return
    end if
    if (.not. begun) call begin_arc(bearing, newton, last, 1.0_wp, way%arc)
    ended = .false.
    do while (.not. ended)
      kept = size(record%history)
      call advance_arc(way%arc, moved)
      report%steps = way%arc%steps
      if (moved) then
        call keep_values(scene, log, bearing, newton, way, record, report, ended)
        if (.not. ended .and. way%arc%turned) then
          call way%arc%nears_fold(again)
          if (.not. again) call keep_fold(scene, log, bearing, newton, way, record)
        end if
      else
        report%reason = 'no step, however short, leads on along the branch'
      end if
      gap = bearing%smallest_gap()
      if (moved .and. gap < settings%touch_down_gap) then
        report%touched = .true.
        report%reason = 'the shaft touches down at '//value_text(scene, way%arc%place)
      else if (way%arc%steps >= most_steps) then
        report%reason = 'more than '//text(most_steps)//' steps along the branch'
      end if
      ended = ended .or. allocated(report%reason)
      if (.not. ended .and. restart%is_due_after(kept, size(record%history))) then
        call keep_bearing(scene, restart, log, size(record%history), bearing, newton, record, way)
      end if
    end do
    report%reached = bearing%point
    report%fraction = way%arc%place
    call end_arc(way%arc, newton)
  end subroutine sweep_round_folds

  !> Keeps the answers at those values that the last step has passed; the branch ends where it leaves
  !> their range.
  subroutine keep_values(scene, log, bearing, newton, way, record, report, ended)
    type(scene_type), intent(in) :: scene
    type(run_log_type), intent(in) :: log
    type(bearing_system_type), target, intent(inout) :: bearing
    type(newton_type), target, intent(inout) :: newton
    type(fold_way_type), intent(inout) :: way
    type(bearing_record_type), intent(inout) :: record
    type(path_report_type), intent(inout) :: report
    logical, intent(out) :: ended
    type(newton_report_type) :: solved
    integer :: i, k, values

    values = size(way%place)
    ended = .false.
    associate (from => way%arc%place_before, to => way%arc%place)
      do i = 1, values
        k = merge(i, values + 1 - i, to > from)
        if (.not. passed(from, way%place(k), to)) cycle
        if (k == way%kept .and. way%arc%heading*way%kept_heading > 0.0_wp) cycle ! before a retreat
        call way%arc%between((way%place(k) - from)/(to - from))
        bearing%point = point_between(way%first, way%last, way%place(k))
        call solve_newton(newton, solved)
        if (.not. solved%converged) then
          report%reason = 'no answer at '//value_text(scene, way%place(k))//', which the branch passes ('//solved%reason//')'
          return
        end if
        way%kept = k
        way%kept_heading = way%arc%heading
        call measure_tilt(scene, scene%sweep%values(k), bearing, newton, record%tilted)
        call judge_answer(scene, log, bearing, newton, record%judged)
        call add_row(scene, bearing, newton, .true., record, scene%sweep%values(k), .false.)
        call log%line('on the branch: '//value_text(scene, way%place(k)))
        ended = k == values .and. to >= way%place(k) .or. k == 1 .and. to <= way%place(k)
        if (ended) then
          report%converged = .true.
          if (k == 1) call log%line('the branch has come back to the first value')
          return
        end if
        call way%arc%return_to()
      end do
    end associate
  end subroutine keep_values

  !> Keeps the answer at which the parameter turns back.
  subroutine keep_fold(scene, log, bearing, newton, way, record)
    type(scene_type), intent(in) :: scene
    type(run_log_type), intent(in) :: log
    type(bearing_system_type), intent(inout) :: bearing
    type(newton_type), intent(inout) :: newton
    type(fold_way_type), intent(inout) :: way
    type(bearing_record_type), intent(inout) :: record
    real(wp) :: fold
    integer :: i

    call way%arc%to_turn()
    fold = way%arc%place_before
    call measure_tilt(scene, value_at(scene, fold), bearing, newton, record%tilted)
    call judge_answer(scene, log, bearing, newton, record%judged)
    do i = 1, size(record%judged)
      if (record%judged(i)%name == 'determinant_sign') record%judged(i)%number = 0.0_wp ! it changes here
    end do
    call add_row(scene, bearing, newton, .true., record, value_at(scene, fold), .true.)
    way%kept = 0
    call log%line('fold: the branch turns back at '//value_text(scene, fold))
    call way%arc%return_to()
  end subroutine keep_fold

  !> Whether a place lies on the way from one to another, its end included.
  pure function passed(from, place, to)
    real(wp), intent(in) :: from, place, to
    logical :: passed
    passed = (place - from)*(to - from) > 0.0_wp .and. abs(place - from) <= abs(to - from)
  end function passed

  !> What the sweep changes, at a place between its first and last values.
  pure function value_at(scene, place) result(value)
    type(scene_type), intent(in) :: scene
    real(wp), intent(in) :: place
    real(wp) :: value

    associate (values => scene%sweep%values)
      value = values(1) + place*(values(size(values)) - values(1))
    end associate
  end function value_at

  !> The same in words.
  function value_text(scene, place) result(words)
    type(scene_type), intent(in) :: scene
    real(wp), intent(in) :: place
    character(len=:), allocatable :: words
    words = sweep_name(scene%sweep)//' = '//text(value_at(scene, place), 6)//' '//sweep_unit(scene%sweep)
  end function value_text
end module gfb_fold_sweep
