#include "gfb_petsc.h"
!> A sweep that goes on where what it changes turns back: the branch of answers is followed by its own
!> length, round its folds, until it leaves the range of the sweep's values.
module gfb_folds
  use petscsys
  use gfb_kinds, only: wp
  use gfb_errors, only: error_type
  use gfb_text, only: text
  use gfb_scene, only: scene_type
  use gfb_operating_point, only: point_between
  use gfb_newton, only: newton_report_type, solve_newton
  use gfb_continuation, only: path_report_type
  use gfb_arc_length, only: begin_arc, advance_arc, end_arc
  use gfb_fold_way, only: fold_way_type
  use gfb_tilt_response, only: measure_tilt
  use gfb_bearing_restart, only: keep_bearing, recall_way
  use gfb_bearing_record, only: add_row, sweep_name, sweep_unit
  use gfb_reasons, only: reason_type
  use gfb_answer_judgement, only: judge_answer
  use gfb_sweep, only: sweep_type
  implicit none (type)
  private
  public :: sweep_round_folds

  integer, parameter :: most_steps = 2000 !! along the branch

contains

  !> Follows the branch from the first value's answer, which has been recorded, or from where a restart file
  !> says; the bearing is left at the last answer.
  !>
  !> Fails when that file is damaged.
  subroutine sweep_round_folds(sweep, reason, error)
    type(sweep_type), target, intent(inout) :: sweep !! left at the last answer
    type(reason_type), intent(out) :: reason !! why the branch does not lead on
    type(error_type), allocatable, intent(out) :: error !! why it failed
    type(fold_way_type), target :: way
    type(path_report_type) :: report
    integer :: kept
    logical :: ended

    call begin_branch(sweep, way, error)
    if (allocated(error)) return
    ended = .false.
    do while (.not. ended)
      kept = size(sweep%record%history)
      call take_step(sweep, way, report, ended)
      associate (points => size(sweep%record%history), context => sweep%context)
        if (.not. ended .and. context%restart%is_due_after(kept, points)) then
          call keep_bearing(sweep%scene, context%restart, context%log, points, sweep%bearing, sweep%newton, &
                            sweep%record, way)
        end if
      end associate
    end do
    report%reached = sweep%bearing%point
    report%fraction = way%arc%place
    call end_arc(way%arc, sweep%newton)
    if (.not. report%converged) call sweep%stop_short(report, reason)
  end subroutine sweep_round_folds

  !> Begins at the bearing's present answer, or where a restart file has the branch.
  !>
  !> Fails when that file is damaged.
  subroutine begin_branch(sweep, way, error)
    type(sweep_type), target, intent(inout) :: sweep
    type(fold_way_type), target, intent(inout) :: way
    type(error_type), allocatable, intent(out) :: error
    logical :: begun

    associate (bearing => sweep%bearing, restart => sweep%context%restart, values => sweep%scene%sweep%values)
      way%first = bearing%point
      way%last = sweep%target_at(size(values))
      way%place = (values - values(1))/(values(size(values)) - values(1))
      begun = .false.
      if (restart%goes_on) then
        call bearing%linearise(bearing%state) ! an arc needs to know which entries the matrix has
        call recall_way(restart, way%last, bearing, sweep%newton, way, begun, error)
        if (allocated(error)) return
      end if
      if (.not. begun) call begin_arc(bearing, sweep%newton, way%last, 1.0_wp, way%arc)
    end associate
  end subroutine begin_branch

  !> One step along the branch, with what it has passed.
  subroutine take_step(sweep, way, report, ended)
    type(sweep_type), target, intent(inout) :: sweep
    type(fold_way_type), target, intent(inout) :: way
    type(path_report_type), intent(inout) :: report
    logical, intent(inout) :: ended
    real(wp) :: gap
    logical :: moved, again

    call advance_arc(way%arc, moved)
    report%steps = way%arc%steps
    if (moved) then
      call record_values(sweep, way, report, ended)
      if (.not. ended .and. way%arc%turned) then
        call way%arc%nears_fold(again)
        if (.not. again) call record_fold(sweep, way)
      end if
    else
      report%reason = 'no step, however short, leads on along the branch'
    end if
    gap = sweep%bearing%smallest_gap()
    if (moved .and. gap < sweep%path%touch_down_gap) then
      report%touched = .true.
      report%reason = 'the shaft touches down at '//value_text(sweep%scene, way%arc%place)
    else if (way%arc%steps >= most_steps) then
      report%reason = 'more than '//text(most_steps)//' steps along the branch'
    end if
    ended = ended .or. allocated(report%reason)
  end subroutine take_step

  !> Records the answers at those values that the last step has passed; the branch ends where it leaves
  !> their range.
  subroutine record_values(sweep, way, report, ended)
    type(sweep_type), target, intent(inout) :: sweep
    type(fold_way_type), intent(inout) :: way
    type(path_report_type), intent(inout) :: report
    logical, intent(out) :: ended
    logical :: found
    integer :: i, k, values

    values = size(way%place)
    ended = .false.
    associate (from => way%arc%place_before, to => way%arc%place)
      do i = 1, values
        k = merge(i, values + 1 - i, to > from)
        if (.not. passed(from, way%place(k), to)) cycle
        if (k == way%kept .and. way%arc%heading*way%kept_heading > 0.0_wp) cycle ! before a retreat
        call way%arc%between((way%place(k) - from)/(to - from))
        call record_value(sweep, k, way, report, found)
        if (.not. found) return
        ended = k == values .and. to >= way%place(k) .or. k == 1 .and. to <= way%place(k)
        if (ended) then
          report%converged = .true.
          if (k == 1) call sweep%context%log%line('the branch has come back to the first value')
          return
        end if
        call way%arc%return_to()
      end do
    end associate
  end subroutine record_values

  !> Finds and records the answer at a value from a state on the branch close to it.
  subroutine record_value(sweep, number, way, report, found)
    type(sweep_type), target, intent(inout) :: sweep
    integer, intent(in) :: number !! of the value
    type(fold_way_type), intent(inout) :: way
    type(path_report_type), intent(inout) :: report
    logical, intent(out) :: found
    type(newton_report_type) :: solved

    associate (scene => sweep%scene, bearing => sweep%bearing, newton => sweep%newton, record => sweep%record)
      bearing%point = point_between(way%first, way%last, way%place(number))
      call solve_newton(newton, solved)
      found = solved%converged
      if (.not. found) then
        report%reason = 'no answer at '//value_text(scene, way%place(number))//', which the branch passes ('// &
          solved%reason//')'
        return
      end if
      way%kept = number
      way%kept_heading = way%arc%heading
      call measure_tilt(scene, scene%sweep%values(number), bearing, newton, record%tilted)
      call judge_answer(scene, sweep%context%log, bearing, newton, record%judged)
      call add_row(scene, bearing, newton, .true., record, scene%sweep%values(number), .false.)
      call sweep%context%log%line('on the branch: '//value_text(scene, way%place(number)))
    end associate
  end subroutine record_value

  !> Records the answer at which the parameter turns back.
  subroutine record_fold(sweep, way)
    type(sweep_type), target, intent(inout) :: sweep
    type(fold_way_type), intent(inout) :: way
    real(wp) :: fold
    integer :: i

    call way%arc%to_turn()
    fold = way%arc%place_before
    associate (scene => sweep%scene, bearing => sweep%bearing, newton => sweep%newton, record => sweep%record)
      call measure_tilt(scene, value_at(scene, fold), bearing, newton, record%tilted)
      call judge_answer(scene, sweep%context%log, bearing, newton, record%judged)
      do i = 1, size(record%judged)
        if (record%judged(i)%name == 'determinant_sign') record%judged(i)%number = 0.0_wp ! it changes here
      end do
      call add_row(scene, bearing, newton, .true., record, value_at(scene, fold), .true.)
      way%kept = 0
      call sweep%context%log%line('fold: the branch turns back at '//value_text(scene, fold))
    end associate
    call way%arc%return_to()
  end subroutine record_fold

  !> Whether a place lies between two others, the second included.
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
end module gfb_folds
