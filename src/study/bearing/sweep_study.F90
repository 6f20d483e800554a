#include "gfb_petsc.h"
!> A bearing along a sweep: each answer from its neighbour's, or along a branch round its folds.
module gfb_sweep_study
  use gfb_kinds, only: wp
  use gfb_errors, only: error_type
  use gfb_text, only: text
  use gfb_petsc_session, only: wall_time
  use gfb_sweep_case, only: sweep_keys
  use gfb_bearing_record, only: sweep_name, sweep_unit
  use gfb_branch_watch, only: note_start
  use gfb_reasons, only: reason_type
  use gfb_study, only: run_points
  use gfb_bearing_study, only: bearing_study_type
  use gfb_answer_record, only: record_answer, fix_shaft
  use gfb_onset, only: look_for_onset
  use gfb_folds, only: sweep_round_folds
  implicit none (type, external)
  private

  !> The bearing, and its points.
  type, extends(bearing_study_type), public :: sweep_study_type
  contains
    procedure :: first_point => first_value
    procedure :: record_first => begin_sweep
    procedure :: continue => finish_sweep
    procedure :: reach => reach_value
    procedure :: record_point => record_value
    procedure :: save_point => save_value
    procedure :: save_stopped
    procedure, private :: show_progress
  end type sweep_study_type

contains

  !> The first value; the scene's own point where the shaft is to be fixed there.
  function first_value(self) result(point)
    class(sweep_study_type), intent(in) :: self !! the study, with its scene
    integer :: point
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

  !> A line a point, with the time that is left; the first point, a cold start, does not tell it.
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
end module gfb_sweep_study
