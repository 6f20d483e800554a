#include "gfb_petsc.h"
!> A bearing that walks along a sweep, each answer from its neighbour's; a scene without a sweep has the
!> first answer only.
module gfb_sweep
  use gfb_kinds, only: wp
  use gfb_text, only: text
  use gfb_run_log, only: run_log_type
  use gfb_signals, only: stop_agreed, stop_words
  use gfb_scene, only: scene_type
  use gfb_model_case, only: foil_elastic_foundation, foundation_pressure_local
  use gfb_scene_case, only: analysis_equilibrium
  use gfb_petsc_session, only: largest_over_ranks, wall_time
  use gfb_bearing_system, only: bearing_system_type
  use gfb_continuation, only: path_report_type, path_settings_type, follow_path
  use gfb_reasons, only: reason_type, reason_no_equilibrium, reason_no_answer, reason_fixed_shaft, reason_no_limit, reason_stopped
  use gfb_sweep_case, only: operation_at, sweep_keys
  use gfb_scene_point, only: operating_point, operating_point_type
  use gfb_newton, only: newton_type, newton_settings_type, work_bound_type
  use gfb_partitioned, only: partitioned_type, follow_partitioned, forget_partitioned
  use gfb_bearing_record, only: bearing_record_type, sweep_name, sweep_unit
  use gfb_bearing_restart, only: save_bearing
  use gfb_branch_watch, only: watch_branch, note_start
  use gfb_run_context, only: run_context_type
  use gfb_walk, only: walk_type
  use gfb_answer_record, only: record_single, record_swept, fix_shaft, builders_type
  use gfb_onset, only: look_for_onset, judge_first_point
  use gfb_last_answer, only: last_answer_type
  use gfb_limit_search, only: find_limit, leave_limit
  implicit none (type)
  private

  real(wp), parameter :: degree = acos(-1.0_wp)/180.0_wp !! [rad]

  !> The bearing, its solvers, and what was recorded. Keep it where it is.
  type, extends(walk_type), public :: sweep_type
    type(scene_type) :: scene
    type(scene_type), allocatable :: here !! the same with the present value of the keys that it sweeps
    type(run_context_type) :: context
    type(path_settings_type) :: path
    type(newton_settings_type) :: tolerances
    type(work_bound_type) :: bound !! of a search from nothing
    type(bearing_system_type) :: bearing
    type(newton_type) :: newton
    type(bearing_record_type) :: record
    real(wp) :: value = 0.0_wp       !! of the keys that the sweep changes, at the present answer [their unit]
    logical :: anew = .false.        !! the present answer was found from nothing, where no path led to it
    integer :: lost_at = 0           !! point to which no path led and nothing tells why; 0: none
    type(path_report_type) :: lost   !! of that path
    logical :: partitioned = .false. !! film and foil are solved in turns
    type(partitioned_type) :: sides  !! of the bearing, then
    type(last_answer_type) :: last
    type(builders_type) :: build     !! of further bearings of the scene
  contains
    procedure :: begin => begin_sweep
    procedure :: reach => reach_value
    procedure :: record_point => record_value
    procedure :: save_point => save_value
    procedure :: save_stopped
    procedure :: target_at
    procedure :: approach_limit
    procedure :: leave
    procedure :: stop_short
    procedure :: explain
    procedure :: watch
    procedure :: tell_end
    procedure :: judge_begin
    procedure, private :: may_start_anew
  end type sweep_type

contains

  !> Says why there is no answer, and how far the path led.
  subroutine explain_missing(scene, bearing, report, fixed, log, reason)
    type(scene_type), intent(in) :: scene !! what was asked for
    type(bearing_system_type), intent(in) :: bearing !! at the last state that was reached
    type(path_report_type), intent(in) :: report !! of the path
    logical, intent(in) :: fixed             !! the shaft was, at an equilibrium
    type(run_log_type), intent(in) :: log    !! gets the lines
    type(reason_type), intent(out) :: reason !! why there is none

    reason%code = reason_no_answer
    if (scene%general%analysis == analysis_equilibrium) reason%code = reason_no_equilibrium
    if (scene%capacity%question > 0) reason%code = reason_no_limit
    if (fixed) reason%code = reason_fixed_shaft
    reason%detail = report%reason()
    if (stop_agreed()) then
      reason%code = reason_stopped
      reason%detail = stop_words()
      return
    end if
    associate (point => report%reached, force => bearing%reaction())
      call log%tell(reason%words())
      if (has_stiff_edges(scene)) then
        call log%line('with foundation_pressure = ''local'' the edges, at ambient pressure, do '// &
                      'not deflect and may touch first; ''axial_mean'' in &model lets them')
      end if
      select case (reason%code)
      case (reason_fixed_shaft)
        call log%line('last state reached: tilt ('//text(point%tilt(1), 4)//', '// &
                      text(point%tilt(2), 4)//') rad, film force ('//text(force(1), 5)//', '// &
                      text(force(2), 5)//') N, '//thinnest_film(bearing))
      case (reason_no_equilibrium, reason_no_limit)
        call log%line('last state reached: load ('//text(force(1), 5)//', '//text(force(2), 5)// &
                      ') N, speed '//text(point%speed*30.0_wp/acos(-1.0_wp), 5)//' rpm, tilt ('// &
                      text(point%tilt(1), 4)//', '//text(point%tilt(2), 4)//') rad, '// &
                      thinnest_film(bearing))
      case default
        call log%line('last state reached: '//text(100.0_wp*report%fraction, 4)// &
                      ' % of the path, speed '// &
                      text(point%speed*30.0_wp/acos(-1.0_wp), 5)//' rpm, '//thinnest_film(bearing))
      end select
    end associate
  end subroutine explain_missing

  !> Where the film is thinnest, in words; of half a width, the half that is solved.
  function thinnest_film(bearing) result(words)
    type(bearing_system_type), intent(in) :: bearing
    character(len=:), allocatable :: words
    real(wp) :: unknown(bearing%local_size()), smallest, place(2)
    real(wp), allocatable :: gap(:)
    integer :: node, pad

    call bearing%get_unknowns(unknown)
    gap = bearing%gap(unknown)
    smallest = bearing%smallest_gap()
    place = -huge(place)
    node = minloc(gap, 1)
    if (node > 0) then
      pad = count(bearing%pad%first_node < node)
      associate (film => bearing%pad(pad)%film, here => node - bearing%pad(pad)%first_node)
        if (gap(node) <= smallest) place = [film%angle(here), film%axial(here)]
      end associate
    end if
    place = largest_over_ranks(place)
    words = 'film thinnest at theta = '//text(place(1)/degree, 4)//' deg, z = '// &
            text(place(2)*1.0e3_wp, 3)//' mm: '//text(smallest*1.0e6_wp, 3)//' um'
  end function thinnest_film

  !> Whether the edges of the film do not deflect: they are at ambient pressure.
  pure function has_stiff_edges(scene) result(has)
    type(scene_type), intent(in) :: scene
    logical :: has

    has = .false.
    if (scene%model%foil /= foil_elastic_foundation) return
    has = scene%model%foundation_pressure == foundation_pressure_local
  end function has_stiff_edges

  !> What follows the first answer: a scene without a sweep is done, the shaft is fixed, or the first point
  !> of a sweep is there.
  subroutine begin_sweep(self, converged)
    class(sweep_type), target, intent(inout) :: self !! the sweep
    logical, intent(in) :: converged !! the answer is one

    associate (scene => self%scene, bearing => self%bearing, newton => self%newton, record => self%record)
      record%begun = wall_time()
      if (.not. scene%sweep%present) then
        call record_single(scene, self%context%log, bearing, newton, self%build, converged, record)
      else if (converged .and. scene%sweep%hold_position) then
        call fix_shaft(scene, self%context%log, bearing, newton, record)
      else if (converged) then
        call self%record_point(1)
      end if
    end associate
  end subroutine begin_sweep

  !> Follows the path from the present answer to that of a sweep point.
  subroutine reach_value(self, point, reason)
    class(sweep_type), target, intent(inout) :: self !! the sweep
    integer, intent(in) :: point             !! number of the sweep's value
    type(reason_type), intent(out) :: reason !! why there is no answer
    type(path_report_type) :: report

    if (point > 1) call self%leave(self%target_at(point - 1))
    if (self%partitioned) then
      call follow_partitioned(self%bearing, self%newton, self%target_at(point), self%path, self%sides, report)
    else
      call follow_path(self%bearing, self%newton, self%target_at(point), 1.0_wp, self%path, report)
    end if
    call self%approach_limit(report)
    self%anew = .false.
    if (report%converged()) return
    if (self%may_start_anew(report)) then
      self%lost_at = point
      self%lost = report
      reason%code = reason_no_equilibrium ! until it has been tried
    else
      call self%stop_short(report, reason)
    end if
  end subroutine reach_value

  !> Whether a point may be tried from nothing: its answer hangs on nothing but the point, and nothing tells why the path to
  !> it has ended.
  function may_start_anew(self, report) result(may)
    class(sweep_type), intent(in) :: self !! the sweep
    type(path_report_type), intent(in) :: report !! of the path
    logical :: may

    associate (sweep => self%scene%sweep)
      may = .not. (report%has_cause() .or. self%partitioned .or. sweep%friction_memory .or. &
                   sweep%turn_folds .or. sweep%hold_position .or. self%scene%capacity%question > 0)
    end associate
    if (may) may = self%bearing%pad(1)%foil%has_contacts()
    if (may) may = .not. stop_agreed()
  end function may_start_anew

  !> From the present answer to its limit, where the scene asks for one.
  subroutine approach_limit(self, report)
    class(sweep_type), target, intent(inout) :: self !! the sweep
    type(path_report_type), intent(inout) :: report !! of the path to the answer, then to the limit

    if (self%scene%capacity%question == 0) return
    if (.not. report%converged()) then
      call report%ending%add_words('no equilibrium to begin with: ', '')
      return
    end if
    call find_limit(self%here, self%context%log, self%path, self%bearing, self%newton, self%record%limit, self%record%at_fold, report)
  end subroutine approach_limit

  !> From a limit back to the answer from which it was found, where the scene asks for limits.
  subroutine leave(self, point)
    class(sweep_type), target, intent(inout) :: self !! the sweep
    type(operating_point_type), intent(in) :: point !! of that answer

    if (self%scene%capacity%question == 0) return
    call leave_limit(point, self%path, self%bearing, self%newton)
  end subroutine leave

  !> Records a sweep point's answer. It is a load step of the scene: friction may carry its slip along.
  subroutine record_value(self, point)
    class(sweep_type), target, intent(inout) :: self !! the sweep
    integer, intent(in) :: point !! number of the sweep's value

    associate (scene => self%scene, bearing => self%bearing, newton => self%newton, record => self%record)
      if (scene%sweep%turn_folds) then
        call record_swept(scene, self%here, self%context%log, bearing, newton, self%build, record, scene%sweep%values(point), .false.)
      else
        call record_swept(scene, self%here, self%context%log, bearing, newton, self%build, record, scene%sweep%values(point))
      end if
      call look_for_onset(scene, self%context%log, self%path, record%history, bearing, newton, self%build%opposite, &
                          record%dynamics%onset)
      if (scene%sweep%parameter == sweep_keys .or. self%anew) then
        call note_start(record%history, self%anew)
      end if
      if (scene%sweep%friction_memory) call bearing%commit()
      call show_progress(self%context, scene, point, record%begun)
      if (point == 1) record%begun = wall_time()
    end associate
    call self%watch()
  end subroutine record_value

  !> Says where a path along keys has ended before its point, which starts from nothing then.
  subroutine tell_end(self, point, report)
    class(sweep_type), intent(in) :: self !! the sweep
    integer, intent(in) :: point !! number of the sweep's value
    type(path_report_type), intent(in) :: report !! of the path

    real(wp) :: before

    associate (sweep => self%scene%sweep, log => self%context%log)
      before = self%value
      if (sweep%parameter /= sweep_keys) before = sweep%values(point - 1)
      call log%line('the path from the point before ends at '//sweep_name(sweep)//' = '// &
                    text(before + report%fraction*(sweep%values(point) - before))//' '//sweep_unit(sweep)// &
                    ': '//report%reason())
      call log%line('point '//text(point)//' starts from nothing')
    end associate
  end subroutine tell_end

  !> Says whether the answer recorded last is on another branch than the one before.
  subroutine watch(self)
    class(sweep_type), intent(inout) :: self !! the sweep
    character(len=:), allocatable :: why
    logical :: in_short_steps

    in_short_steps = self%scene%sweep%parameter == sweep_keys .and. .not. self%anew
    call watch_branch(self%scene, in_short_steps, self%record%history, why)
    if (why == '') return
    call self%context%log%warning('another branch of equilibria than at the point before: '//why)
  end subroutine watch

  !> Writes the restart file after a point, where one is due; 0: where the shaft is fixed.
  subroutine save_value(self, point)
    class(sweep_type), target, intent(inout) :: self !! the sweep
    integer, intent(in) :: point !! number of the sweep's value

    if (.not. self%scene%sweep%present) return
    call self%last%save(self%bearing, self%newton)
    if (.not. self%context%restart%is_due(point)) return
    call save_bearing(self%scene, self%context%restart, self%context%log, point, self%bearing, self%newton, &
                      self%record)
    if (self%context%restart%every > 0) call forget_partitioned(self%sides)
  end subroutine save_value

  !> Writes the restart file of a sweep that is stopped after a point; 0: where the shaft is fixed.
  subroutine save_stopped(self, point)
    class(sweep_type), target, intent(inout) :: self !! the sweep
    integer, intent(in) :: point !! number of the last value that has an answer

    if (.not. (self%last%known .and. self%context%restart%may_be_written())) return
    call self%last%restore(self%bearing, self%newton)
    call save_bearing(self%scene, self%context%restart, self%context%log, point, self%bearing, self%newton, &
                      self%record)
    call self%context%restart%tell(self%context%log, stop_words()//' after point '//text(point)//' of '// &
                                   text(size(self%scene%sweep%values)))
  end subroutine save_stopped

  !> Where a sweep point puts the shaft; a fixed shaft stays where it is.
  function target_at(self, point) result(target)
    class(sweep_type), intent(in) :: self !! the sweep
    integer, intent(in) :: point !! number of the sweep's value
    type(operating_point_type) :: target

    target = operating_point(operation_at(self%scene%operation, self%scene%sweep, point))
    if (self%scene%sweep%hold_position) target%eccentricity = self%bearing%point%eccentricity
  end function target_at

  !> Ends a sweep before its last point; what was known of the last answer is not of the state now.
  subroutine stop_short(self, report, reason)
    class(sweep_type), intent(inout) :: self !! the sweep
    type(path_report_type), intent(in) :: report !! of the path to the point without an answer
    type(reason_type), intent(out) :: reason     !! why there is none

    call self%explain(report, self%bearing%shaft_fixed, reason)
    self%record%judged = self%record%judged(:0)
  end subroutine stop_short

  !> Says why there is no answer, and how far the path led.
  subroutine explain(self, report, fixed, reason)
    class(sweep_type), intent(in) :: self !! the sweep
    type(path_report_type), intent(in) :: report !! of the path
    logical, intent(in) :: fixed             !! the shaft was, at an equilibrium
    type(reason_type), intent(out) :: reason !! why there is none

    call explain_missing(self%scene, self%bearing, report, fixed, self%context%log, reason)
  end subroutine explain

  !> Judges the one answer as the point from which a shaft is followed over time.
  subroutine judge_begin(self)
    class(sweep_type), target, intent(inout) :: self !! at the answer
    call judge_first_point(self%scene, self%context%log, self%bearing, self%newton, self%record%judged)
  end subroutine judge_begin

  !> A line a point, with the time that is left; the first point, a cold start, does not tell it.
  subroutine show_progress(context, scene, point, begun)
    type(run_context_type), intent(in) :: context
    type(scene_type), intent(in) :: scene
    integer, intent(in) :: point
    real(wp), intent(in) :: begun !! when the first point was there [s]
    character(len=:), allocatable :: line, value
    integer :: left

    associate (sweep => scene%sweep)
      value = sweep_name(sweep)//' = '//text(sweep%values(point))//' '//sweep_unit(sweep)
      call context%point_done(value)
      line = 'point '//text(point)//' of '//text(size(sweep%values))//': '//value
      left = size(sweep%values) - point
    end associate
    if (point > 1 .and. left > 0) then
      line = line//', about '//text((wall_time() - begun)/real(point - 1, wp)*real(left, wp), 2)//' s left'
    end if
    call context%log%stage(line)
    if (left > 0) then
      call context%log%is_within('point '//text(point + 1)//' of '//text(size(scene%sweep%values)), &
                                 real(point - 1, wp)/real(point - 1 + left, wp))
    else
      call context%log%is_within('')
    end if
  end subroutine show_progress
end module gfb_sweep
