#include "gfb_petsc.h"
!> A bearing with a given load or a given position, at one point or along a sweep.
module gfb_bearing_analysis
  use petscsys
  use gfb_kinds, only: wp
  use gfb_errors, only: error_type
  use gfb_memory_check, only: check_memory
  use gfb_text, only: text, exact_text
  use gfb_run_log, only: run_log_type
  use gfb_quantity, only: quantity_type, number_quantity, add_quantity
  use gfb_scene, only: scene_type
  use gfb_scene_case, only: analysis_equilibrium
  use gfb_model_case, only: coupling_partitioned, foil_rigid
  use gfb_operation_case, only: operation_case_type
  use gfb_sweep_case, only: operation_at, sweep_case_type, sweep_load, sweep_speed, sweep_tilt_x, &
                            sweep_tilt_y, sweep_eccentricity_x
  use gfb_c_library, only: peak_memory
  use gfb_petsc_session, only: wall_time, sum_over_ranks, rank_count
  use gfb_operating_point, only: operating_point_type
  use gfb_cost_events, only: enter_stage, leave_stage
  use gfb_bearing_system, only: bearing_system_type
  use gfb_bearing_builder, only: bearing_plan_type, operating_point
  use gfb_bearing_answer, only: bearing_answer_type, bearing_answer
  use gfb_newton, only: newton_type, newton_settings_type, destroy_newton
  use gfb_continuation, only: path_settings_type, path_report_type, follow_path
  use gfb_cold_start, only: start_bearing
  use gfb_partitioned, only: partitioned_type, start_partitioned, create_partitioned, follow_partitioned, &
                             forget_partitioned, destroy_partitioned
  use gfb_bearing_plan, only: plan_bearing
  use gfb_bearing_summary, only: cost_type, answer_quantities, cost_quantities, &
                                 show_closing_block
  use gfb_answer_judgement, only: judge_answer
  use gfb_tilt_response, only: begin_tilt, measure_tilt, summary_quantities, show_tilt_response
  use gfb_bearing_record, only: bearing_record_type, add_row, analysis_name, sweep_name, sweep_unit
  use gfb_restart, only: restart_type, drop_restart
  use gfb_bearing_restart, only: keep_bearing, recall_bearing
  use gfb_fold_sweep, only: sweep_round_folds
  use gfb_case_file, only: case_array_type
  use gfb_result_set, only: result_grid_type, write_result_set
  use gfb_film_grid, only: add_film_grid
  use gfb_foil_output, only: add_foil_grids
  use gfb_contact_record, only: foil_contact_arrays
  use gfb_provenance, only: provenance, blas_in_use
  implicit none (type)
  private
  public :: run_bearing, solve_scene, write_bearing, cost_of

  real(wp), parameter :: rough_limit = 10.0_wp !! cell Peclet number above which Galerkin may oscillate [1]


contains

  !> Computes a bearing and writes its results.
  !>
  !> `converged` is false where an answer could not be found. Fails when a file cannot be written.
  subroutine run_bearing(scene, folder, command, restart, start_time, log, converged, error, answer)
    type(scene_type), intent(in) :: scene
    character(len=*), intent(in) :: folder   !! where the results go
    character(len=*), intent(in) :: command  !! the whole command line
    type(restart_type), intent(in) :: restart !! where the run goes on, if it does
    real(wp), intent(in) :: start_time       !! of the run [s]
    type(run_log_type), intent(in) :: log
    logical, intent(out) :: converged
    type(error_type), allocatable, intent(out) :: error
    type(quantity_type), allocatable, intent(out), optional :: answer(:) !! what the summary has

    type(bearing_plan_type) :: plan
    type(bearing_system_type), target :: bearing
    type(newton_type), target :: newton
    type(bearing_record_type) :: record
    type(quantity_type), allocatable :: summary(:)

    converged = .false.
    call plan_bearing(scene, log, plan)
    call check_memory(scene, plan%memory, error)
    if (allocated(error)) return
    call log%heading('solution')
    call solve_scene(scene, plan, restart, log, bearing, newton, record, converged, error)
    if (allocated(error)) return
    call enter_stage('output')
    call write_bearing(scene, plan, folder, provenance(command), log, bearing, converged, record, &
                       cost_of(bearing, newton, start_time), rank_count(), &
                       foil_contact_arrays(bearing%foil, record%contacts, size(record%history)), summary, error)
    if (present(answer)) call move_alloc(summary, answer)
    if (converged .and. .not. allocated(error)) call drop_restart(restart)
    call leave_stage()
    call destroy_newton(newton)
    call bearing%destroy()
  end subroutine run_bearing

  !> Shows the present state and writes it with what was recorded on the way.
  !>
  !> Fails when a file cannot be written.
  subroutine write_bearing(scene, plan, folder, origin, log, bearing, converged, record, cost, ranks, contacts, &
                           summary, error)
    type(scene_type), intent(in) :: scene
    type(bearing_plan_type), intent(in) :: plan
    character(len=*), intent(in) :: folder        !! where the results go
    type(quantity_type), intent(in) :: origin(:)  !! what the files say of it
    type(run_log_type), intent(in) :: log
    type(bearing_system_type), intent(inout) :: bearing
    logical, intent(in) :: converged
    type(bearing_record_type), intent(in) :: record
    type(cost_type), intent(in) :: cost
    integer, intent(in) :: ranks                  !! that computed it
    type(case_array_type), intent(in) :: contacts(:)
    type(quantity_type), allocatable, intent(out) :: summary(:)
    type(error_type), allocatable, intent(out) :: error

    type(bearing_answer_type) :: answer
    type(result_grid_type), allocatable :: grids(:)

    answer = bearing_answer(bearing)
    call add_quantity(summary, answer_quantities(analysis_name(scene), converged, answer, bearing%film%clearance, &
      bearing%force_scale()))
    call add_quantity(summary, summary_quantities(record%tilted))
    call add_quantity(summary, bearing%foil%sizes())
    if (allocated(record%judged)) call add_quantity(summary, record%judged)
    call add_quantity(summary, cost_quantities(cost))
    call show_closing_block(log, converged, answer, bearing%film%clearance, cost, ranks, blas_in_use())
    call show_tilt_response(log, record%tilted)
    if (answer%rough_peclet > rough_limit .and. .not. plan%upwind) then
      call log%warning('cell Peclet number '//text(answer%rough_peclet, 3)//' where the gap changes from '// &
                       'cell to cell: the pressure may oscillate; refine, or use film_scheme = ''supg'' with film_order = 1')
    end if
    allocate (grids(0))
    call add_film_grid(bearing, scene%output, grids)
    call add_foil_grids(bearing, grids)
    call write_result_set(scene, folder, converged, origin, summary, record%history, contacts, grids, log, error)
  end subroutine write_bearing

  !> The first answer, and those of the sweep, each from its neighbour.
  subroutine solve_scene(scene, plan, restart, log, bearing, newton, record, converged, error)
    type(scene_type), intent(in) :: scene
    type(bearing_plan_type), intent(in) :: plan
    type(restart_type), intent(in) :: restart
    type(run_log_type), intent(in) :: log
    type(bearing_system_type), target, intent(inout) :: bearing
    type(newton_type), target, intent(inout) :: newton
    type(bearing_record_type), intent(inout) :: record
    logical, intent(out) :: converged
    type(error_type), allocatable, intent(out) :: error

    type(path_report_type) :: report
    type(path_settings_type) :: path
    type(newton_settings_type) :: newton_settings
    type(partitioned_type), target :: sides
    type(operation_case_type) :: operation
    integer :: point, first, last
    logical :: partitioned

    allocate (record%history(0), record%judged(0))
    path = path_settings_type(scene%solver%maximum_load_steps, scene%solver%smallest_load_step, &
                              scene%solver%touch_down_gap)
    operation = scene%operation
    first = 1
    if (scene%sweep%present .and. .not. scene%sweep%hold_position) then
      operation = operation_at(scene%operation, scene%sweep, 1)
      first = 2
    end if
    newton_settings = newton_settings_type(scene%solver%residual_tolerance, scene%solver%step_tolerance, &
                                           scene%solver%maximum_iterations)
    partitioned = scene%model%coupling == coupling_partitioned .and. scene%model%foil /= foil_rigid
    if (restart%goes_on) then
      call recall_bearing(scene, plan, restart, newton_settings, log, bearing, newton, record, first, error)
      if (.not. allocated(error) .and. partitioned) call create_partitioned(bearing, newton_settings, log, sides)
      first = first + 1
      if (scene%sweep%turn_folds) first = min(first, 2) ! answers along the branch are no points
      converged = .true.
    else if (partitioned) then
      call start_partitioned(scene, plan, operating_point(operation), newton_settings, path, log, bearing, &
                             newton, sides, report, error)
    else
      call start_bearing(scene, plan, operating_point(operation), newton_settings, path, log, bearing, &
                         newton, report, error)
    end if
    if (allocated(error)) return
    if (.not. restart%goes_on) then
      converged = report%converged
      if (.not. converged) call explain(log, scene, bearing, report, .false.)
      call begin_sweep(scene, log, converged, bearing, newton, record)
      if (converged) call keep(first - 1)
    end if
    call enter_stage('sweep')
    last = 0
    if (scene%sweep%present) last = size(scene%sweep%values)
    do point = first, last
      if (.not. converged) exit
      if (scene%sweep%turn_folds .and. point > 1) then
        call sweep_round_folds(scene, restart, log, sweep_target(scene, bearing, last), path, bearing, &
                               newton, record, report, error)
        if (allocated(error)) return
        converged = report%converged
        if (.not. converged) call stop_short(log, scene, bearing, report, record)
        exit
      end if
      if (partitioned) then
        call follow_partitioned(bearing, newton, sweep_target(scene, bearing, point), path, sides, report)
      else
        call follow_path(bearing, newton, sweep_target(scene, bearing, point), 1.0_wp, path, report)
      end if
      converged = report%converged
      if (.not. converged) call stop_short(log, scene, bearing, report, record)
      if (converged) call end_point(scene, log, point, bearing, newton, record)
      if (point == 1) record%begun = wall_time()
      if (converged) call keep(point)
    end do
    call leave_stage()
    call destroy_partitioned(sides)

  contains

    !> Writes the restart file after a point, where one is due; 0: where the shaft is held.
    subroutine keep(point)
      integer, intent(in) :: point

      if (.not. restart%is_due(point)) return
      call keep_bearing(scene, restart, log, point, bearing, newton, record)
      call forget_partitioned(sides)
    end subroutine keep
  end subroutine solve_scene

  !> What follows the first answer: a scene without a sweep is done, the shaft is held, or the first point
  !> of a sweep is there.
  subroutine begin_sweep(scene, log, converged, bearing, newton, record)
    type(scene_type), intent(in) :: scene
    type(run_log_type), intent(in) :: log
    logical, intent(in) :: converged !! the answer is one
    type(bearing_system_type), intent(inout) :: bearing
    type(newton_type), intent(inout) :: newton
    type(bearing_record_type), intent(inout) :: record

    record%begun = wall_time()
    if (.not. scene%sweep%present) then
      if (converged) call judge_answer(scene, log, bearing, newton, record%judged)
      call add_row(scene, bearing, newton, converged, record)
    else if (converged .and. scene%sweep%hold_position) then
      if (scene%sweep%friction_memory) call bearing%commit() ! the load was the first way the foils went
      call hold_shaft(bearing, log)
      call begin_tilt(scene, bearing, newton, record%tilted)
    else if (converged) then
      call end_point(scene, log, 1, bearing, newton, record)
    end if
  end subroutine begin_sweep

  !> Keeps a sweep point's answer. It is a load step of the scene: friction may carry its slip along.
  subroutine end_point(scene, log, point, bearing, newton, record)
    type(scene_type), intent(in) :: scene
    type(run_log_type), intent(in) :: log
    integer, intent(in) :: point
    type(bearing_system_type), intent(inout) :: bearing
    type(newton_type), intent(inout) :: newton
    type(bearing_record_type), intent(inout) :: record

    call measure_tilt(scene, scene%sweep%values(point), bearing, newton, record%tilted)
    call judge_answer(scene, log, bearing, newton, record%judged)
    if (scene%sweep%turn_folds) then
      call add_row(scene, bearing, newton, .true., record, scene%sweep%values(point), .false.)
    else
      call add_row(scene, bearing, newton, .true., record, scene%sweep%values(point))
    end if
    if (scene%sweep%friction_memory) call bearing%commit()
    call show_progress(log, scene%sweep, point, record%begun)
  end subroutine end_point

  !> Where a sweep point puts the shaft; a held shaft stays where it is.
  function sweep_target(scene, bearing, point) result(target)
    type(scene_type), intent(in) :: scene
    type(bearing_system_type), intent(in) :: bearing
    integer, intent(in) :: point
    type(operating_point_type) :: target

    target = operating_point(operation_at(scene%operation, scene%sweep, point))
    if (scene%sweep%hold_position) target%eccentricity = bearing%point%eccentricity
  end function sweep_target

  !> Keeps the shaft at its equilibrium from now on.
  subroutine hold_shaft(bearing, log)
    type(bearing_system_type), intent(inout) :: bearing
    type(run_log_type), intent(in) :: log

    bearing%point%eccentricity = bearing%eccentricity()
    bearing%held = .true.
    call log%line('shaft held at ('//text(bearing%point%eccentricity(1)*1.0e6_wp, 5)//', '// &
                  text(bearing%point%eccentricity(2)*1.0e6_wp, 5)//') um')
  end subroutine hold_shaft

  !> Ends a sweep before its last point; what was known of the last answer is not of the state now.
  subroutine stop_short(log, scene, bearing, report, record)
    type(run_log_type), intent(in) :: log
    type(scene_type), intent(in) :: scene
    type(bearing_system_type), intent(in) :: bearing
    type(path_report_type), intent(in) :: report
    type(bearing_record_type), intent(inout) :: record

    call explain(log, scene, bearing, report, bearing%held)
    record%judged = record%judged(:0)
  end subroutine stop_short

  !> Says why there is no answer, and how far the way led.
  subroutine explain(log, scene, bearing, report, held)
    type(run_log_type), intent(in) :: log
    type(scene_type), intent(in) :: scene
    type(bearing_system_type), intent(in) :: bearing
    type(path_report_type), intent(in) :: report
    logical, intent(in) :: held !! the shaft was, at an equilibrium

    associate (point => report%reached, force => bearing%reaction())
      if (held) then
        call log%gave_up('no answer found with the shaft held: '//report%reason)
        call log%line('last state reached: tilt ('//text(point%tilt(1), 4)//', '//text(point%tilt(2), 4)// &
                      ') rad, film force ('//text(force(1), 5)//', '//text(force(2), 5)//') N, smallest gap '// &
                      text(bearing%smallest_gap()*1.0e6_wp, 3)//' um')
      else if (scene%general%analysis == analysis_equilibrium) then
        call log%gave_up('no equilibrium found: '//report%reason)
        call log%line('last state reached: load ('//text(force(1), 5)//', '//text(force(2), 5)// &
                      ') N, speed '//text(point%speed*30.0_wp/acos(-1.0_wp), 5)//' rpm, tilt ('// &
                      text(point%tilt(1), 4)//', '//text(point%tilt(2), 4)//') rad')
      else
        call log%gave_up('no answer found: '//report%reason)
        call log%line('last state reached: '//text(100.0_wp*report%fraction, 4)//' % of the way, speed '// &
                      text(point%speed*30.0_wp/acos(-1.0_wp), 5)//' rpm')
      end if
    end associate
  end subroutine explain

  !> A line a point, with the time that is left; the first point, a cold start, does not tell it.
  subroutine show_progress(log, sweep, point, begun)
    type(run_log_type), intent(in) :: log
    type(sweep_case_type), intent(in) :: sweep
    integer, intent(in) :: point
    real(wp), intent(in) :: begun !! when the first point was there [s]
    character(len=:), allocatable :: line, place
    integer :: left

    place = sweep_name(sweep)//' = '//text(sweep%values(point))//' '//sweep_unit(sweep)
    call log%point_done(place)
    line = 'point '//text(point)//' of '//text(size(sweep%values))//': '//place
    left = size(sweep%values) - point
    if (point > 1 .and. left > 0) then
      line = line//', about '//text((wall_time() - begun)/real(point - 1, wp)*real(left, wp), 2)//' s left'
    end if
    call log%line(line)
  end subroutine show_progress

  !> What a scene cost so far.
  function cost_of(bearing, newton, start_time) result(cost)
    type(bearing_system_type), intent(in) :: bearing
    type(newton_type), intent(in) :: newton
    real(wp), intent(in) :: start_time !! [s]
    type(cost_type) :: cost
    real(wp) :: memory(1)

    memory = sum_over_ranks([peak_memory()])
    cost = cost_type(bearing%unknowns, newton%iterations, newton%factorizations, &
                     wall_time() - start_time, memory(1))
  end function cost_of

end module gfb_bearing_analysis
