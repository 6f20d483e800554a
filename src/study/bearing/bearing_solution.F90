#include "gfb_petsc.h"
!> A bearing with an answer, and the next one: from nothing, along a path, from a restart file; and what is said where there is
!> none.
module gfb_bearing_solution
  use gfb_kinds, only: wp
  use gfb_film_surface, only: translations
  use gfb_units, only: pi, degree
  use gfb_errors, only: error_type
  use gfb_text, only: text
  use gfb_signals, only: stop_agreed, stop_words
  use gfb_scene, only: scene_type
  use gfb_scene_reading, only: scene_at_value
  use gfb_model_case, only: coupling_partitioned
  use gfb_sweep_case, only: operation_at, sweep_keys
  use gfb_scene_point, only: operating_point, operating_point_type
  use gfb_mesh_plan, only: bearing_plan_type
  use gfb_bearing_system, only: bearing_system_type
  use gfb_bearing_answer, only: place_of_gap
  use gfb_bearing_builder, only: build_bearing
  use gfb_newton, only: newton_type, newton_settings_type, work_bound_type, create_newton, destroy_newton
  use gfb_continuation, only: path_settings_type, path_report_type, follow_path
  use gfb_start_problem, only: search_request_type
  use gfb_cold_start, only: start_bearing, start_partitioned
  use gfb_partitioned, only: partitioned_type, create_partitioned, follow_partitioned, forget_partitioned, destroy_partitioned
  use gfb_bearing_record, only: bearing_record_type, sweep_name, sweep_unit
  use gfb_bearing_restart, only: save_bearing, restore_bearing
  use gfb_branch_watch, only: watch_branch
  use gfb_key_path, only: follow_keys
  use gfb_last_answer, only: last_answer_type
  use gfb_limit_search, only: find_limit, leave_limit, limit_straight_steps
  use gfb_ending, only: ending_stopped
  use gfb_reasons, only: reason_type, reason_no_equilibrium, reason_no_answer, reason_fixed_shaft, reason_no_limit
  use gfb_run_context, only: run_context_type
  implicit none (type)
  private
  public :: new_solution

  !> The bearing, its solvers, and what was recorded. Keep it where it is.
  type, public :: bearing_solution_type
    type(scene_type), allocatable :: scene !! what is asked for; large for the stack that first values pass over
    type(scene_type), allocatable :: here !! the same with the present value of swept keys
    type(bearing_plan_type) :: plan
    type(run_context_type) :: context
    type(path_settings_type) :: path
    type(newton_settings_type) :: tolerances
    type(work_bound_type) :: bound !! of a search from nothing
    type(bearing_system_type) :: bearing
    type(newton_type) :: newton
    type(bearing_record_type) :: record
    real(wp) :: value = 0.0_wp       !! of the keys that the sweep changes, at the present answer [their unit]
    logical :: anew = .false.        !! the present answer was found from nothing, where no path led to it
    type(last_answer_type) :: last   !! to save where the run is stopped on the path to the next one
    logical, private :: partitioned = .false. !! film and foil are solved in turns
    type(partitioned_type), private :: sides  !! of the bearing, then
  contains
    procedure :: set_up, start, resume, move_to, approach_limit, target_at, watch, save
    procedure :: save_stopped, explain, stop_short, drop_helpers, destroy
    procedure, private :: take_value, follow, may_start_anew, start_anew, search
  end type bearing_solution_type

contains

  !> Makes room for a solution: its first values pass over the stack, which is not to hold them for longer.
  subroutine new_solution(solution)
    type(bearing_solution_type), allocatable, intent(out) :: solution !! empty
    allocate (solution)
  end subroutine new_solution

  !> Settings of the solvers, and an empty record.
  subroutine set_up(self, scene, plan, context)
    class(bearing_solution_type), target, intent(inout) :: self !! the solution
    type(scene_type), intent(in) :: scene !! what is asked for
    type(bearing_plan_type), intent(in) :: plan !! of the bearing
    type(run_context_type), intent(in) :: context !! of the run

    self%scene = scene
    self%here = scene
    self%plan = plan
    self%context = context
    associate (solver => scene%solver)
      self%path = path_settings_type(solver%maximum_load_steps, solver%smallest_load_step, solver%touch_down_gap)
      self%tolerances = newton_settings_type(solver%residual_tolerance, solver%step_tolerance, solver%maximum_iterations)
      self%tolerances%bold_steps = scene%bearing%row%bold_steps
    end associate
    self%tolerances%bound => self%bound
    self%partitioned = scene%model%coupling == coupling_partitioned .and. scene%model%foil%deflects
    allocate (self%record%history(0), self%record%judged(0))
  end subroutine set_up

  !> Puts the value of a sweep's point into the scene, where the sweep changes keys.
  !>
  !> Fails where the value breaks a rule.
  subroutine take_value(self, point, error)
    class(bearing_solution_type), intent(inout) :: self !! the solution
    integer, intent(in) :: point !! of the sweep
    type(error_type), allocatable, intent(out) :: error !! which rule is broken

    if (self%scene%sweep%parameter /= sweep_keys) return
    self%value = self%scene%sweep%values(point)
    call scene_at_value(self%scene, self%value, self%here, error)
  end subroutine take_value

  !> The first answer, from nothing, and from there the limit, where the scene asks for one.
  !>
  !> Fails when the mesh cannot be cut.
  subroutine start(self, point, report, error)
    class(bearing_solution_type), target, intent(inout) :: self !! the solution
    integer, intent(in) :: point !! of the sweep; 0: the scene's own
    type(path_report_type), intent(out) :: report !! of the search
    type(error_type), allocatable, intent(out) :: error !! why it failed
    type(operating_point_type) :: target

    if (point > 0) call self%take_value(point, error)
    if (allocated(error)) return
    target = operating_point(self%here%operation)
    if (point > 0) target = operating_point(operation_at(self%here%operation, self%here%sweep, point))
    call self%search(self%here, target, report, error)
    if (.not. allocated(error)) call self%approach_limit(report)
  end subroutine start

  !> The answer that a restart file holds, and all that was recorded.
  !>
  !> Fails when the file is damaged.
  subroutine resume(self, error, name)
    class(bearing_solution_type), target, intent(inout) :: self !! the solution
    type(error_type), allocatable, intent(out) :: error !! why it failed
    character(len=*), intent(in), optional :: name !! of its archive in the file; default: bearing
    type(bearing_plan_type) :: on_way

    associate (restart => self%context%restart, log => self%context%log)
      call self%take_value(restart%step, error)
      if (allocated(error)) return
      on_way = self%plan
      on_way%bearing_distance = self%here%rotor%distance_in_time ! the file was written on the way
      call build_bearing(self%here, on_way, self%bearing, error, frozen=self%scene%transient%present)
      if (allocated(error)) return
      call create_newton(self%newton, self%bearing, 'bearing_', self%tolerances, log)
      call restore_bearing(self%here, restart, log, self%bearing, self%newton, self%record, error, name)
      if (allocated(error)) return
      if (self%partitioned) call create_partitioned(self%bearing, self%tolerances, log, self%sides)
      call self%last%save(self%bearing, self%newton)
    end associate
  end subroutine resume

  !> From the present answer to that of a sweep's point: along a path, or from nothing where that is lost on the way and nothing
  !> says why.
  !>
  !> Fails where the mesh cannot be cut, and where a value of the sweep breaks a rule.
  subroutine move_to(self, point, reason, error)
    class(bearing_solution_type), target, intent(inout) :: self !! the solution
    integer, intent(in) :: point !! of the sweep
    type(reason_type), intent(out) :: reason !! why there is no answer
    type(error_type), allocatable, intent(out) :: error !! why it failed
    type(path_report_type) :: report

    call self%follow(point, report)
    self%anew = self%may_start_anew(report)
    if (self%anew) call self%start_anew(point, report, error)
    if (allocated(error)) return
    if (report%converged()) call self%take_value(point, error)
    if (allocated(error)) return
    call self%approach_limit(report)
    if (.not. report%converged()) call self%stop_short(report, reason)
  end subroutine move_to

  !> The path from the present answer, back from its limit first where it is one.
  subroutine follow(self, point, report)
    class(bearing_solution_type), target, intent(inout) :: self !! the solution
    integer, intent(in) :: point !! of the sweep
    type(path_report_type), intent(out) :: report !! of the path
    type(operating_point_type) :: before
    type(path_settings_type) :: path
    logical :: limits

    limits = self%scene%capacity%limit > 0
    path = self%path
    if (limits) path%straight_steps = limit_straight_steps
    if (self%scene%sweep%parameter == sweep_keys) then
      before = operating_point(self%here%operation)
      if (limits) call leave_limit(before, path, self%bearing, self%newton)
      call follow_keys(self%scene, self%plan, self%value, self%scene%sweep%values(point), path, self%bearing, &
                       self%newton, report)
      return
    end if
    if (limits .and. point > 1) call leave_limit(self%target_at(point - 1), path, self%bearing, self%newton)
    if (self%partitioned) then
      call follow_partitioned(self%bearing, self%newton, self%target_at(point), self%path, self%sides, report)
    else
      call follow_path(self%bearing, self%newton, self%target_at(point), 1.0_wp, path, report)
    end if
  end subroutine follow

  !> Whether a point may be tried from nothing: its answer hangs on nothing but the point, and nothing shows why the path to
  !> it has ended.
  logical function may_start_anew(self, report) result(may)
    class(bearing_solution_type), intent(in) :: self !! the solution
    type(path_report_type), intent(in) :: report !! of the path

    may = .not. (report%converged() .or. report%has_cause())
    if (self%scene%sweep%parameter == sweep_keys .or. .not. may) return
    associate (sweep => self%scene%sweep)
      may = .not. (self%partitioned .or. sweep%friction_memory .or. sweep%turn_folds .or. sweep%hold_position .or. &
                   self%scene%capacity%limit > 0)
    end associate
    if (may) may = self%bearing%has_contacts()
    if (may) may = .not. stop_agreed()
  end function may_start_anew

  !> A point of a sweep from nothing.
  !>
  !> Fails where the mesh cannot be cut.
  subroutine start_anew(self, point, report, error)
    class(bearing_solution_type), target, intent(inout) :: self !! the solution
    integer, intent(in) :: point !! of the sweep
    type(path_report_type), intent(inout) :: report !! in: of the path that has ended; out: of the start
    type(error_type), allocatable, intent(out) :: error !! why it failed
    type(scene_type), target :: scene
    real(wp) :: before

    associate (sweep => self%scene%sweep, log => self%context%log)
      before = self%value
      if (sweep%parameter /= sweep_keys) before = sweep%values(point - 1)
      call log%line('the path from the point before ends at '//sweep_name(sweep)//' = '// &
                    text(before + report%fraction*(sweep%values(point) - before))//' '//sweep_unit(sweep)// &
                    ': '//report%reason())
      call log%line('point '//text(point)//' starts from nothing')
    end associate
    call self%take_value(point, error)
    if (allocated(error)) return
    scene = self%here
    scene%operation = operation_at(scene%operation, scene%sweep, point)
    call self%search(scene, operating_point(scene%operation), report, error)
  end subroutine start_anew

  !> Searches the answer of a scene with the present values from nothing.
  !>
  !> Fails when the mesh cannot be cut.
  subroutine search(self, scene, target, report, error)
    class(bearing_solution_type), target, intent(inout) :: self !! the solution
    type(scene_type), target, intent(in) :: scene !! with the present values
    type(operating_point_type), intent(in) :: target !! of it
    type(path_report_type), intent(out) :: report !! of the search
    type(error_type), allocatable, intent(out) :: error !! why it failed
    type(search_request_type) :: request

    request = search_request_type(scene, self%plan, target, self%tolerances, self%path, self%context%log)
    if (self%partitioned) then
      call start_partitioned(request, self%bearing, self%newton, self%sides, report, error)
    else
      call start_bearing(request, self%bearing, self%newton, report, error)
    end if
  end subroutine search

  !> From the present answer to its limit, where the scene asks for one.
  subroutine approach_limit(self, report)
    class(bearing_solution_type), target, intent(inout) :: self !! the solution
    type(path_report_type), intent(inout) :: report !! of the path to the answer, then to the limit

    if (self%scene%capacity%limit == 0) return
    if (.not. report%converged()) then
      call report%ending%add_words('no equilibrium to begin with: ', '')
      return
    end if
    call self%bound%begin(self%here%solver%most_factorizations, self%here%solver%most_work)
    call find_limit(self%here, self%context%log, self%path, self%bearing, self%newton, self%record%limit, self%record%at_fold, report)
    call self%bound%lift()
  end subroutine approach_limit

  !> Where a sweep point puts the shaft; a fixed shaft stays where it is.
  function target_at(self, point) result(target)
    class(bearing_solution_type), intent(in) :: self !! the solution
    integer, intent(in) :: point !! number of the sweep's value
    type(operating_point_type) :: target

    target = operating_point(operation_at(self%scene%operation, self%scene%sweep, point))
    if (self%scene%sweep%hold_position) target%place(:translations) = self%bearing%point%place(:translations)
  end function target_at

  !> Says whether the answer recorded last is on another branch than the one before.
  subroutine watch(self)
    class(bearing_solution_type), intent(inout) :: self !! the solution
    character(len=:), allocatable :: why
    logical :: in_short_steps

    in_short_steps = self%scene%sweep%parameter == sweep_keys .and. .not. self%anew
    call watch_branch(self%scene, in_short_steps, self%record%history, why)
    if (why == '') return
    call self%context%log%warning('another branch of equilibria than at the point before: '//why)
  end subroutine watch

  !> Writes the restart file after a point, where one is due; 0: where the shaft is fixed.
  subroutine save(self, point)
    class(bearing_solution_type), target, intent(inout) :: self !! the solution
    integer, intent(in) :: point !! number of the sweep's value

    call self%last%save(self%bearing, self%newton)
    associate (context => self%context)
      if (.not. context%restart%is_due(point)) return
      call save_bearing(self%scene, context%restart, context%log, point, self%bearing, self%newton, self%record)
      if (context%restart%every > 0) call forget_partitioned(self%sides)
    end associate
  end subroutine save

  !> Writes the restart file of a sweep that is stopped after a point; 0: where the shaft is fixed. Along keys the bearing of
  !> that point is there no more.
  subroutine save_stopped(self, point)
    class(bearing_solution_type), target, intent(inout) :: self !! the solution
    integer, intent(in) :: point !! number of the last value that has an answer

    if (self%scene%sweep%parameter == sweep_keys) return
    associate (context => self%context)
      if (.not. (self%last%known .and. context%restart%may_be_written())) return
      call self%last%restore(self%bearing, self%newton)
      call save_bearing(self%scene, context%restart, context%log, point, self%bearing, self%newton, self%record)
      call context%restart%tell(context%log, stop_words()//' after point '//text(point)//' of '// &
                                text(size(self%scene%sweep%values)))
    end associate
  end subroutine save_stopped

  !> Ends a sweep before its last point; what was known of the last answer is not of the state now.
  subroutine stop_short(self, report, reason)
    class(bearing_solution_type), intent(inout) :: self !! the solution
    type(path_report_type), intent(in) :: report !! of the path to the point without an answer
    type(reason_type), intent(out) :: reason     !! why there is none

    call self%explain(report, self%bearing%shaft_fixed, reason)
    self%record%judged = self%record%judged(:0)
  end subroutine stop_short

  !> Says why there is no answer, and how far the path led.
  subroutine explain(self, report, fixed, reason)
    class(bearing_solution_type), intent(in) :: self !! at the last state that was reached
    type(path_report_type), intent(in) :: report !! of the path
    logical, intent(in) :: fixed             !! the shaft was, at an equilibrium
    type(reason_type), intent(out) :: reason !! why there is none

    reason%code = reason_no_answer
    if (self%scene%general%analysis%floats) reason%code = reason_no_equilibrium
    if (self%scene%capacity%limit > 0) reason%code = reason_no_limit
    if (fixed) reason%code = reason_fixed_shaft
    reason%detail = report%reason()
    reason%shown = report%has_cause()
    reason%gave_up = report%ending%kind == ending_stopped
    if (stop_agreed()) then
      call reason%stopped()
      return
    end if
    associate (point => report%reached, force => self%bearing%reaction(), log => self%context%log)
      call log%tell(reason%words())
      if (self%scene%model%has_local_springs()) then
        call log%line('with foundation_pressure = ''local'' the edges, at ambient pressure, do '// &
                      'not deflect and may touch first; '''// &
                      trim(self%scene%bearing%row%width)//'_mean'' in &model lets them')
      end if
      select case (reason%code)
      case (reason_fixed_shaft)
        call log%line('last state reached: tilt ('//text(point%place(4), 4)//', '// &
                      text(point%place(5), 4)//') rad, film force '//force_words(self%bearing, force)//', '// &
                      thinnest_film(self%bearing, self%scene%bearing%row%coordinate))
      case (reason_no_equilibrium, reason_no_limit)
        call log%line('last state reached: load '//force_words(self%bearing, force)//', speed '//text(point%speed*30.0_wp/pi, 5)//' rpm, tilt ('// &
                      text(point%place(4), 4)//', '//text(point%place(5), 4)//') rad, '// &
                      thinnest_film(self%bearing, self%scene%bearing%row%coordinate))
      case default
        call log%line('last state reached: '//text(100.0_wp*report%fraction, 4)// &
                      ' % of the path, speed '// &
                      text(point%speed*30.0_wp/pi, 5)//' rpm, '//thinnest_film(self%bearing, self%scene%bearing%row%coordinate))
      end select
    end associate
  end subroutine explain

  !> Where the film is thinnest, in words; of half a width, the half that is solved.
  function thinnest_film(bearing, coordinate) result(words)
    type(bearing_system_type), intent(in) :: bearing
    character(len=*), intent(in) :: coordinate !! of its rows
    character(len=:), allocatable :: words
    real(wp) :: unknown(bearing%local_size()), smallest, place(2)

    call bearing%get_unknowns(unknown)
    smallest = bearing%smallest_gap()
    place = place_of_gap(bearing, bearing%gap(unknown), smallest)
    if (any(abs(place) > huge(place))) then ! a film that is no number anywhere
      words = 'no film that can be measured'
      return
    end if
    words = 'film thinnest at theta = '//text(place(2)/degree, 4)//' deg, '// &
            coordinate//' = '// &
            text(place(1)*1.0e3_wp, 3)//' mm: '//text(smallest*1.0e6_wp, 3)//' um'
  end function thinnest_film

  !> A force along the ways that the shaft may move.
  function force_words(bearing, force) result(words)
    type(bearing_system_type), intent(in) :: bearing
    real(wp), intent(in) :: force(:) !! of its film [N], [N m]
    character(len=:), allocatable :: words
    integer, allocatable :: way(:)
    integer :: i

    way = bearing%mesh%surface%motions()
    way = pack(way, way <= translations)
    words = text(force(way(1)), 5)
    do i = 2, size(way)
      words = words//', '//text(force(way(i)), 5)
    end do
    if (size(way) > 1) words = '('//words//')'
    words = words//' N'
  end function force_words

  !> Frees what paths alone need; the bearing stays.
  subroutine drop_helpers(self)
    class(bearing_solution_type), intent(inout) :: self !! the solution

    call destroy_partitioned(self%sides)
    call self%last%destroy()
  end subroutine drop_helpers

  !> Frees bearing and solver.
  subroutine destroy(self)
    class(bearing_solution_type), intent(inout) :: self !! the solution

    call destroy_newton(self%newton)
    call self%bearing%destroy()
  end subroutine destroy
end module gfb_bearing_solution
