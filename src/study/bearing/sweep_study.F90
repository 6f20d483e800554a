#include "gfb_petsc.h"
!> A bearing along a sweep: each answer from its neighbour's, or, beyond the folds where what it changes turns
!> back, along the branch of answers by its own length, until it leaves the range of the sweep's values.
module gfb_sweep_study
  use petscsys
  use gfb_kinds, only: wp
  use gfb_errors, only: error_type
  use gfb_text, only: text
  use gfb_petsc_session, only: wall_time, stop_is_asked
  use gfb_sweep_case, only: sweep_keys
  use gfb_bearing_record, only: sweep_name, sweep_unit
  use gfb_branch_watch, only: note_start
  use gfb_reasons, only: reason_type
  use gfb_study, only: run_points
  use gfb_bearing_study, only: bearing_study_type
  use gfb_answer_record, only: record_answer, fix_shaft
  use gfb_onset, only: look_for_onset, may_look_for_onset
  use gfb_ending, only: path_reached, path_touches_at, path_lost
  use gfb_signals, only: stop_words
  use gfb_scene, only: scene_type
  use gfb_operating_point, only: point_between
  use gfb_newton, only: newton_report_type, solve_newton
  use gfb_continuation, only: path_report_type, fold_path_type
  use gfb_arc, only: end_arc, begin_arc, advance_arc
  use gfb_bearing_restart, only: save_bearing, restore_branch
  use gfb_bearing_solution, only: bearing_solution_type
  implicit none (type)
  private

  integer, parameter :: most_steps = 2000 !! along the branch

  !> The bearing, and its points.
  type, extends(bearing_study_type), public :: sweep_study_type
  contains
    procedure :: first_point => first_value, record_first => begin_sweep, continue => finish_sweep
    procedure :: reach => reach_value, record_point => record_value, save_point => save_value
    procedure :: save_stopped
    procedure, private :: show_progress
  end type sweep_study_type

contains

  !> The first value; the scene's own point where the shaft is to be fixed there.
  integer function first_value(self) result(point)
    class(sweep_study_type), intent(in) :: self !! the study, with its scene
    point = merge(0, 1, self%solution%scene%sweep%hold_position)
  end function first_value

  !> The shaft is fixed, or the first point is there.
  subroutine begin_sweep(self, converged)
    class(sweep_study_type), target, intent(inout) :: self !! the study
    logical, intent(in) :: converged !! there is an answer

    if (.not. converged) return
    if (self%solution%scene%sweep%hold_position) then
      call fix_shaft(self%solution)
    else
      call self%record_point(1)
    end if
    call self%save_point(self%first_point())
  end subroutine begin_sweep

  !> The rest of the sweep, point by point, or along its branch.
  !>
  !> Fails where a bearing cannot be built, and when a restart file is damaged.
  subroutine finish_sweep(self, next, error)
    class(sweep_study_type), target, intent(inout) :: self !! the study
    integer, intent(in) :: next !! point
    type(error_type), allocatable, intent(out) :: error !! why it failed
    type(reason_type) :: reason

    associate (sweep => self%solution%scene%sweep)
      ! Answers along a branch are no points: it begins behind the first.
      call run_points(self, next, merge(1, size(sweep%values), sweep%turn_folds), reason, error)
      if (allocated(error)) return
      if (sweep%turn_folds .and. .not. reason%is_given()) call sweep_round_folds(self%solution, reason, error)
    end associate
    self%reason = reason
  end subroutine finish_sweep

  !> Finds a point's answer from its neighbour's.
  subroutine reach_value(self, point, reason, error)
    class(sweep_study_type), target, intent(inout) :: self !! the study
    integer, intent(in) :: point             !! number of the sweep's value
    type(reason_type), intent(out) :: reason !! why there is no answer
    type(error_type), allocatable, intent(out) :: error !! why it failed
    call self%solution%move_to(point, reason, error)
  end subroutine reach_value

  !> Records a point's answer. It is a load step of the scene: friction may carry its slip along.
  subroutine record_value(self, point)
    class(sweep_study_type), target, intent(inout) :: self !! the study
    integer, intent(in) :: point !! number of the sweep's value

    associate (solution => self%solution, sweep => self%solution%scene%sweep)
      if (sweep%turn_folds) then
        call record_answer(solution, sweep%values(point), .false.)
      else
        call record_answer(solution, sweep%values(point))
      end if
      call look_for_onset(solution)
      if (sweep%parameter == sweep_keys .or. solution%anew) call note_start(solution%record%history, solution%anew)
      if (sweep%friction_memory) call solution%bearing%commit()
      call self%show_progress(point)
      if (point == 1) solution%record%begun = wall_time()
      call solution%watch()
    end associate
  end subroutine record_value

  !> Writes the restart file, where one is due.
  subroutine save_value(self, point)
    class(sweep_study_type), target, intent(inout) :: self !! the study
    integer, intent(in) :: point !! number of the sweep's value; 0: where the shaft is fixed
    call self%solution%save(point)
  end subroutine save_value

  !> Writes the restart file of a sweep that is stopped after a point.
  subroutine save_stopped(self, point)
    class(sweep_study_type), target, intent(inout) :: self !! the study
    integer, intent(in) :: point !! number of the last value that has an answer; 0: where the shaft is fixed
    call self%solution%save_stopped(point)
  end subroutine save_stopped

  !> A line a point, with the time that is left; the first point, a cold start, does not show it.
  subroutine show_progress(self, point)
    class(sweep_study_type), intent(in) :: self !! the study
    integer, intent(in) :: point !! number of the sweep's value
    character(len=:), allocatable :: line, value
    integer :: left

    associate (sweep => self%solution%scene%sweep, context => self%solution%context, begun => self%solution%record%begun)
      value = sweep_name(sweep)//' = '//text(sweep%values(point))//' '//sweep_unit(sweep)
      call context%point_done(value)
      line = 'point '//text(point)//' of '//text(size(sweep%values))//': '//value
      left = size(sweep%values) - point
      if (point > 1 .and. left > 0) then
        line = line//', about '//text((wall_time() - begun)/real(point - 1, wp)*real(left, wp), 2)//' s left'
        if (may_look_for_onset(self%solution)) line = line//', a search for the onset of whirl not counted'
      end if
      call context%log%stage(line)
      if (left > 0) then
        call context%log%is_within('point '//text(point + 1)//' of '//text(size(sweep%values)), &
                                   real(point - 1, wp)/real(point - 1 + left, wp))
      else
        call context%log%is_within('')
      end if
    end associate
  end subroutine show_progress

  !> Follows the branch from the first value's answer, which has been recorded, or from where a restart file
  !> says; the bearing is left at the last answer.
  !>
  !> Fails when that file is damaged.
  subroutine sweep_round_folds(sweep, reason, error)
    type(bearing_solution_type), target, intent(inout) :: sweep !! left at the last answer
    type(reason_type), intent(out) :: reason !! why the branch does not continue
    type(error_type), allocatable, intent(out) :: error !! why it failed
    type(fold_path_type), allocatable, target :: branch
    type(path_report_type) :: report
    integer :: kept
    logical :: ended, stops, due

    allocate (branch)
    call begin_branch(sweep, branch, error)
    if (allocated(error)) return
    ended = .false.
    do while (.not. ended)
      kept = size(sweep%record%history)
      call take_step(sweep, branch, report, ended)
      associate (points => size(sweep%record%history), context => sweep%context)
        stops = stop_is_asked()
        due = context%restart%is_due_after(kept, points)
        if (stops .and. context%restart%may_be_written()) due = .true.
        if (due .and. .not. ended) then
          call save_bearing(sweep%scene, context%restart, context%log, points, sweep%bearing, sweep%newton, &
                            sweep%record, branch)
        end if
        if (stops) then
          if (.not. report%converged()) report%ending = path_lost(stop_words())
          ended = .true.
          call context%restart%tell(context%log, stop_words()//' after answer '//text(points)//' of the branch')
        end if
      end associate
    end do
    report%reached = sweep%bearing%point
    report%fraction = branch%arc%lambda
    call end_arc(branch%arc, sweep%newton)
    if (.not. report%converged()) call sweep%stop_short(report, reason)
  end subroutine sweep_round_folds

  !> Begins at the bearing's present answer, or where a restart file has the branch.
  !>
  !> Fails when that file is damaged.
  subroutine begin_branch(sweep, branch, error)
    type(bearing_solution_type), target, intent(inout) :: sweep
    type(fold_path_type), target, intent(inout) :: branch
    type(error_type), allocatable, intent(out) :: error
    logical :: begun

    associate (bearing => sweep%bearing, restart => sweep%context%restart, values => sweep%scene%sweep%values)
      branch%first = bearing%point
      branch%last = sweep%target_at(size(values))
      branch%lambda = (values - values(1))/(values(size(values)) - values(1))
      begun = .false.
      if (restart%continues) then
        call bearing%linearise(bearing%state) ! an arc needs to know which entries the matrix has
        call restore_branch(restart, branch%last, bearing, sweep%newton, branch, begun, error)
        if (allocated(error)) return
      end if
      if (.not. begun) call begin_arc(bearing, sweep%newton, branch%last, 1.0_wp, branch%arc)
      sweep%newton%settings%may_be_stopped = .false. ! a step along the branch is short and resumes as a whole
      branch%arc%newton%settings%may_be_stopped = .false.
    end associate
  end subroutine begin_branch

  !> One step along the branch, with what it has passed.
  subroutine take_step(sweep, branch, report, ended)
    type(bearing_solution_type), target, intent(inout) :: sweep
    type(fold_path_type), target, intent(inout) :: branch
    type(path_report_type), intent(inout) :: report
    logical, intent(inout) :: ended
    real(wp) :: gap
    logical :: moved, again

    call advance_arc(branch%arc, moved)
    report%steps = branch%arc%steps
    if (moved) then
      call record_values(sweep, branch, report, ended)
      if (.not. ended .and. branch%arc%turned) then
        call branch%arc%nears_fold(again)
        if (.not. again) call record_fold(sweep, branch)
      end if
    else
      report%ending = path_lost('no step along the branch converges, however short')
    end if
    gap = sweep%bearing%smallest_gap()
    if (moved .and. gap < sweep%path%touch_down_gap) then
      report%ending = path_touches_at('at '//value_text(sweep%scene, branch%arc%lambda))
    else if (branch%arc%steps >= most_steps) then
      report%ending = path_lost('more than '//text(most_steps)//' steps along the branch')
    end if
    ended = ended .or. report%reason() /= ''
  end subroutine take_step

  !> Records the answers at those values that the last step has passed; the branch ends where it leaves
  !> their range.
  subroutine record_values(sweep, branch, report, ended)
    type(bearing_solution_type), target, intent(inout) :: sweep
    type(fold_path_type), intent(inout) :: branch
    type(path_report_type), intent(inout) :: report
    logical, intent(out) :: ended
    logical :: found
    integer :: i, k, values

    values = size(branch%lambda)
    ended = .false.
    associate (from => branch%arc%lambda_before, to => branch%arc%lambda)
      do i = 1, values
        k = merge(i, values + 1 - i, to > from)
        if (.not. passed(from, branch%lambda(k), to)) cycle
        if (k == branch%kept .and. branch%arc%heading*branch%kept_heading > 0.0_wp) cycle ! before a retreat
        call branch%arc%between((branch%lambda(k) - from)/(to - from))
        call record_on_branch(sweep, k, branch, report, found)
        if (.not. found) return
        ended = k == values .and. to >= branch%lambda(k) .or. k == 1 .and. to <= branch%lambda(k)
        if (ended) then
          report%ending = path_reached()
          if (k == 1) call sweep%context%log%line('the branch has come back to the first value')
          return
        end if
        call branch%arc%return_to()
      end do
    end associate
  end subroutine record_values

  !> Finds and records the answer at a value from a state on the branch close to it.
  subroutine record_on_branch(sweep, number, branch, report, found)
    type(bearing_solution_type), target, intent(inout) :: sweep
    integer, intent(in) :: number !! of the value
    type(fold_path_type), intent(inout) :: branch
    type(path_report_type), intent(inout) :: report
    logical, intent(out) :: found
    type(newton_report_type) :: solved

    associate (scene => sweep%scene, bearing => sweep%bearing, newton => sweep%newton)
      bearing%point = point_between(branch%first, branch%last, branch%lambda(number))
      call solve_newton(newton, solved)
      found = solved%converged
      if (.not. found) then
        report%ending = path_lost('no answer at '//value_text(scene, branch%lambda(number))//', which the branch passes ('// &
                                  solved%reason//')')
        return
      end if
      branch%kept = number
      branch%kept_heading = branch%arc%heading
      call record_answer(sweep, scene%sweep%values(number), .false.)
      call sweep%context%log%line('on the branch: '//value_text(scene, branch%lambda(number)))
    end associate
    call sweep%watch()
  end subroutine record_on_branch

  !> Records the answer at which the parameter turns back.
  subroutine record_fold(sweep, branch)
    type(bearing_solution_type), target, intent(inout) :: sweep
    type(fold_path_type), intent(inout) :: branch
    real(wp) :: fold

    call branch%arc%to_turn()
    fold = branch%arc%lambda_before
    call record_answer(sweep, value_at(sweep%scene, fold), .true.)
    branch%kept = 0
    call sweep%context%log%line('fold: the branch turns back at '//value_text(sweep%scene, fold))
    call sweep%watch()
    call branch%arc%return_to()
  end subroutine record_fold

  !> Whether a value of the path parameter lies between two others, the second included.
  pure function passed(from, at, to)
    real(wp), intent(in) :: from, at, to
    logical :: passed
    passed = (at - from)*(to - from) > 0.0_wp .and. abs(at - from) <= abs(to - from)
  end function passed

  !> What the sweep changes, at a path parameter of 0 at its first and 1 at its last value.
  pure real(wp) function value_at(scene, at) result(value)
    type(scene_type), intent(in) :: scene
    real(wp), intent(in) :: at !! path parameter [1]

    associate (values => scene%sweep%values)
      value = values(1) + at*(values(size(values)) - values(1))
    end associate
  end function value_at

  !> The same in words.
  function value_text(scene, at) result(words)
    type(scene_type), intent(in) :: scene
    real(wp), intent(in) :: at !! path parameter [1]
    character(len=:), allocatable :: words
    words = sweep_name(scene%sweep)//' = '//text(value_at(scene, at), 6)//' '//sweep_unit(scene%sweep)
  end function value_text
end module gfb_sweep_study
