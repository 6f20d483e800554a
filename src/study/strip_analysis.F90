#include "gfb_petsc.h"
!> A bump strip under crest loads or between plates, up and down in load steps.
module gfb_strip_analysis
  use petscvec
  use gfb_kinds, only: wp
  use gfb_errors, only: error_type
  use gfb_memory_check, only: check_memory
  use gfb_text, only: text
  use gfb_run_log, only: run_log_type
  use gfb_quantity, only: quantity_type, add_quantity
  use gfb_petsc_session, only: rank_count
  use gfb_scene, only: scene_type
  use gfb_bump_foil_case, only: fixed_edge_none
  use gfb_strip_load_case, only: crest_forces, load_plates, support_contact
  use gfb_shell_geometry, only: node_unknowns
  use gfb_substructures, only: kind_count
  use gfb_foil_mesh, only: crest_positions
  use gfb_foil_builder, only: foil_plan_type, strip_shape
  use gfb_strip_builder, only: build_strip
  use gfb_strip_system, only: strip_system_type, destroy_strip_system
  use gfb_strip_answer, only: strip_answer_type, strip_recorder_type, start_recorder, read_answer, &
                              destroy_recorder
  use gfb_solver_case, only: linear_solver_iterative
  use gfb_newton, only: newton_type, newton_settings_type, newton_report_type, create_newton, &
                        destroy_newton
  use gfb_load_step, only: load_path_type, create_load_path, take_load_step, destroy_load_path
  use gfb_case_file, only: history_row_type, case_array_type, add_arrays
  use gfb_result_set, only: result_grid_type, write_result_set
  use gfb_foil_grid, only: create_foil_grid, add_displacement, add_contacts, add_stress
  use gfb_foil_stress, only: shell_stresses
  use gfb_foil_plan, only: plan_foil
  use gfb_cost_events, only: enter_stage, leave_stage
  use gfb_strip_summary, only: step_quantities, answer_quantities, cost_quantities, show_step, show_step_header
  use gfb_restart, only: restart_type, drop_restart
  use gfb_strip_record, only: strip_run_type
  use gfb_strip_restart, only: keep_strip, recall_strip
  use gfb_strip_companions, only: strip_companions, show_companions, companion_arrays
  use gfb_contact_record, only: record_contacts, contact_arrays
  use gfb_provenance, only: provenance, blas_in_use
  implicit none (type)
  private
  public :: run_strip, solve_strip, write_answer

  real(wp), parameter :: large_deflection = 0.25_wp !! of the bump height
  real(wp), parameter :: rounding = 1.0e-9_wp !! of a balance of forces, relative
  real(wp), parameter :: lost_digits = 1.0e-6_wp !! round-off of deflections that is worth a warning

contains

  !> Computes a strip and writes its results.
  !>
  !> Fails when a file cannot be written.
  subroutine run_strip(scene, folder, command, restart, start_time, log, converged, error, answer)
    type(scene_type), intent(in) :: scene
    character(len=*), intent(in) :: folder   !! where the results go
    character(len=*), intent(in) :: command  !! the whole command line
    type(restart_type), intent(in) :: restart !! where the run goes on, if it does
    real(wp), intent(in) :: start_time       !! of the run [s]
    type(run_log_type), intent(in) :: log
    logical, intent(out) :: converged
    type(error_type), allocatable, intent(out) :: error
    type(quantity_type), allocatable, intent(out), optional :: answer(:) !! what the summary has

    type(foil_plan_type) :: plan
    type(strip_system_type), target :: strip
    type(newton_type), target :: newton
    type(strip_run_type) :: run
    type(quantity_type), allocatable :: summary(:)
    type(quantity_type) :: nothing(0)

    converged = .false.
    call plan_foil(scene, log, plan)
    call check_memory(scene, plan%memory, error)
    if (allocated(error)) return
    call log%heading('solution')
    call solve_strip(scene, plan, restart, log, strip, newton, run, error)
    if (allocated(error)) return
    converged = run%converged
    call write_answer(scene, folder, command, start_time, log, strip, newton, run, nothing, summary, error)
    if (converged .and. .not. allocated(error)) call drop_restart(restart)
    if (present(answer)) call move_alloc(summary, answer)
    call destroy_newton(newton)
    call destroy_strip_system(strip)
  end subroutine run_strip

  !> Builds a strip and takes all load steps.
  !>
  !> Fails when the mesh cannot be made or a restart file cannot be read.
  subroutine solve_strip(scene, plan, restart, log, strip, newton, run, error)
    type(scene_type), intent(in) :: scene
    type(foil_plan_type), intent(in) :: plan
    type(restart_type), intent(in) :: restart
    type(run_log_type), intent(in) :: log
    type(strip_system_type), target, intent(inout) :: strip
    type(newton_type), target, intent(inout) :: newton
    type(strip_run_type), intent(inout) :: run
    type(error_type), allocatable, intent(out) :: error

    call enter_stage('set-up')
    call build_strip(scene, plan, strip, error)
    call leave_stage()
    if (allocated(error)) return
    call log%line('super-elements: '//text(kind_count(strip%foil%substructure))//' distinct of '// &
                  text(size(strip%foil%substructure))//', '//text(strip%unknowns)//' unknowns')
    if (scene%solver%linear_solver == linear_solver_iterative) call strip%find_motions()
    call create_newton(newton, strip, 'strip_', newton_settings_type(scene%solver%residual_tolerance, &
                       scene%solver%step_tolerance, scene%solver%maximum_iterations), log)
    call load_and_unload(scene, restart, strip, newton, log, run, error)
  end subroutine solve_strip

  !> Shows the answer and writes all files.
  !>
  !> Fails when one cannot be written.
  subroutine write_answer(scene, folder, command, start_time, log, strip, newton, run, more, summary, error)
    type(scene_type), intent(in) :: scene
    character(len=*), intent(in) :: folder, command
    real(wp), intent(in) :: start_time         !! of the run [s]
    type(run_log_type), intent(in) :: log
    type(strip_system_type), intent(in) :: strip
    type(newton_type), intent(in) :: newton
    type(strip_run_type), intent(inout) :: run
    type(quantity_type), intent(in) :: more(:) !! for the summary
    type(quantity_type), allocatable, intent(out) :: summary(:)
    type(error_type), allocatable, intent(out) :: error
    logical :: plates

    plates = scene%strip_load%kind == load_plates
    call add_quantity(summary, answer_quantities(run%full, run%last, plates, run%converged))
    call add_quantity(summary, more)
    call add_quantity(summary, cost_quantities(scene, strip, newton, start_time))
    run%companions = strip_companions(scene, run%full%force)
    call show_closing_block(log, run, plates)
    call warn(log, scene, run%full)
    call enter_stage('output')
    call write_strip(scene, folder, command, strip, run, summary, log, error)
    call leave_stage()
  end subroutine write_answer

  !> All load steps, up and down again.
  subroutine load_and_unload(scene, restart, strip, newton, log, run, error)
    type(scene_type), intent(in) :: scene
    type(restart_type), intent(in) :: restart
    type(strip_system_type), target, intent(inout) :: strip
    type(newton_type), target, intent(inout) :: newton
    type(run_log_type), intent(in) :: log
    type(strip_run_type), intent(inout) :: run
    type(error_type), allocatable, intent(out) :: error

    type(load_path_type) :: path
    type(strip_recorder_type) :: recorder
    type(newton_report_type) :: report
    type(history_row_type) :: row
    integer :: step, steps, iterations, factorizations

    associate (load => scene%strip_load)
      steps = load%steps_up + load%steps_down
      allocate (run%history(0))
      call start_recorder(strip, scene%bump_foil%bumps, recorder)
      call create_load_path(strip, path)
      run%full = recorder%last
      run%last = recorder%last
      if (restart%goes_on) then
        call recall_strip(restart, steps, log, strip, newton, path, recorder, run, error)
        if (allocated(error)) return
      end if
      call show_step_header(log)
      report%reason = what_lifts(scene)
      do step = run%steps + 1, steps
        if (report%reason /= '' .and. step == 1) then
          call explain(log, step, steps, report%reason)
          run%converged = .false.
          exit
        end if
        iterations = newton%iterations
        factorizations = newton%factorizations
        call take_load_step(strip, newton, load_factor(step, load%steps_up, load%steps_down), path, report)
        if (.not. report%converged) then
          run%converged = .false.
          call explain(log, step, steps, report%reason)
          exit
        end if
        call read_answer(strip, full_force(scene), recorder, run%last)
        call record_contacts(strip%contacts, step, steps, run%contacts)
        call strip%commit()
        if (step == load%steps_up) run%last%round_off = max(strip%stiffness_round_off(), path%round_off)
        if (step <= load%steps_up) run%full = run%last
        run%steps = step
        iterations = newton%iterations - iterations
        factorizations = newton%factorizations - factorizations
        row%quantity = step_quantities(run%last, step, load%kind == load_plates, iterations, factorizations)
        run%history = [run%history, row]
        call show_step(log, run%last, step, iterations, factorizations)
        call keep_strip(scene, restart, log, strip, newton, path, run)
      end do
      if (path%at_round_off > 0) then
        call log%line(text(path%at_round_off)//' steps ended at round-off, where Newton''s moved by up to '// &
                      text(path%round_off, 2)//' of the deflection')
      end if
      if (path%homotopies + path%cuts > 0) then
        call log%line(text(path%homotopies)//' steps by a longer stick length, '//text(path%cuts)//' cuts')
      end if
    end associate
    call destroy_load_path(path)
    call destroy_recorder(recorder)
  end subroutine load_and_unload

  !> Share of the full load at a step.
  pure function load_factor(step, up, down) result(factor)
    integer, intent(in) :: step, up, down
    real(wp) :: factor

    if (step <= up) then
      factor = real(step, wp)/real(up, wp)
    else
      factor = real(up + down - step, wp)/real(down, wp)
    end if
  end function load_factor

  !> Full force on all crests where it is given [N].
  function full_force(scene) result(force)
    type(scene_type), intent(in) :: scene
    real(wp) :: force

    associate (foil => scene%bump_foil, load => scene%strip_load)
      if (load%kind == load_plates) then
        force = load%maximum_force
      else
        force = sum(crest_forces(load, foil))
      end if
    end associate
  end function full_force

  !> What moves a strip that nothing but the sleeve holds, in words; empty where the sleeve can hold
  !> it.
  function what_lifts(scene) result(words)
    type(scene_type), intent(in) :: scene
    character(len=:), allocatable :: words
    real(wp), allocatable :: force(:), crest(:)
    real(wp) :: total, size_of_load, place, reach

    words = ''
    associate (foil => scene%bump_foil, load => scene%strip_load)
      if (foil%fixed_edge /= fixed_edge_none .or. load%kind == load_plates .or. &
          load%support /= support_contact) return
      force = crest_forces(load, foil)
      crest = crest_positions(strip_shape(scene))
      total = sum(force)
      size_of_load = sum(abs(force))
      reach = maxval(crest) - minval(crest) + 2.0_wp*foil%half_length
      if (.not. size_of_load > 0.0_wp) return
      if (total <= rounding*size_of_load) then
        words = 'the load lifts the strip off the sleeve: the forces on the crests add up to '//text(total, 4)// &
                ' N towards the sleeve, and the strip is fixed nowhere'
        return
      end if
      place = (dot_product(force, crest)/total - 0.5_wp*(maxval(crest) + minval(crest)))/reach
      if (abs(place) > 0.5_wp) then
        words = 'the load tips the strip over: it acts beyond the last corner line, and the strip is fixed nowhere'
      end if
    end associate
  end function what_lifts

  !> Says why there is no answer.
  subroutine explain(log, step, steps, reason)
    type(run_log_type), intent(in) :: log
    integer, intent(in) :: step, steps
    character(len=*), intent(in) :: reason

    call log%gave_up('no equilibrium found in step '//text(step)//' of '//text(steps)//': '//reason)
  end subroutine explain

  !> Says where an answer is not what it seems.
  subroutine warn(log, scene, answer)
    type(run_log_type), intent(in) :: log
    type(scene_type), intent(in) :: scene
    type(strip_answer_type), intent(in) :: answer
    integer, parameter :: open_place = 1, sleeve = 1
    real(wp) :: largest

    if (sum(answer%count(:, sleeve)) > 0 .and. abs(answer%force) > 0.0_wp .and. &
        sum(answer%count(open_place + 1:, sleeve)) == 0) then
      call log%warning('the strip has lifted off the sleeve: its fixed edge alone holds it')
    end if
    largest = maxval(abs(answer%deflection))
    if (largest > large_deflection*scene%bump_foil%height) then
      call log%warning('a crest moves by '//text(100.0_wp*largest/scene%bump_foil%height, 3)// &
                       ' % of the bump height: displacements were taken to be small')
    end if
    if (answer%round_off > lost_digits) then
      call log%warning('round-off leaves an error of about '//text(answer%round_off, 2)//' of deflections and forces: '// &
                       'the foil is so thin that the last digits of its stretching stiffness are a part of its bending stiffness')
    end if
  end subroutine warn

  !> Writes all files.
  !>
  !> Fails when one cannot be written.
  subroutine write_strip(scene, folder, command, strip, run, summary, log, error)
    type(scene_type), intent(in) :: scene
    character(len=*), intent(in) :: folder, command
    type(strip_system_type), intent(in) :: strip
    type(strip_run_type), intent(in) :: run
    type(quantity_type), intent(in) :: summary(:)
    type(run_log_type), intent(in) :: log
    type(error_type), allocatable, intent(out) :: error

    type(result_grid_type) :: grid
    type(case_array_type), allocatable :: arrays(:)
    real(wp), allocatable :: moved(:, :)
    Vec :: solution
    PetscErrorCode :: ierr

    allocate (moved(node_unknowns, size(strip%foil%part%mesh_node)))
    call strip%foil_solution(solution)
    call strip%foil%displacements(solution, moved)
    PetscCallA(VecDestroy(solution, ierr))
    call create_foil_grid(strip%foil, 'bump_foil', grid)
    call add_displacement(strip%foil, 'displacement', 'of the mid-surface', moved, grid)
    call add_contacts(strip%contacts, strip%foil, grid)
    call add_stress(strip%foil, shell_stresses(strip%foil, moved), grid)
    arrays = contact_arrays(strip%contacts, strip%foil, run%contacts, run%steps)
    call add_arrays(arrays, companion_arrays(run%companions))
    call write_result_set(scene, folder, run%converged, provenance(command), summary, run%history, arrays, &
                          [grid], log, error)
  end subroutine write_strip

  !> The answer in the units an engineer reads.
  subroutine show_closing_block(log, run, plates)
    type(run_log_type), intent(in) :: log
    type(strip_run_type), intent(in) :: run
    logical, intent(in) :: plates

    call log%heading('answer')
    call show_companions(log, run%full%deflection, run%companions)
    if (plates) call log%line('plate travel '//text(run%full%travel*1.0e6_wp, 6)//' um')
    call log%line('force on all crests '//text(run%full%force, 5)//' N, '//text(rank_count())// &
                  ' rank(s), BLAS '//blas_in_use())
    if (run%converged .and. run%full%factor > run%last%factor) then
      call log%line('dissipated in the cycle '//text(run%last%external_work*1.0e3_wp, 5)//' mJ')
    end if
  end subroutine show_closing_block
end module gfb_strip_analysis
