#include "gfb_petsc.h"
!> A bump strip under crest loads or between plates, up and down in load steps.
module gfb_strip_study
  use petscvec
  use petscsys
  use gfb_kinds, only: wp
  use gfb_archive, only: archive_type
  use gfb_errors, only: error_type
  use gfb_text, only: text
  use gfb_signals, only: stop_agreed, stop_words
  use gfb_scene, only: scene_type
  use gfb_foil_cases, only: fixed_edge_none
  use gfb_strip_load_case, only: crest_forces, load_plates, support_contact
  use gfb_foil_mesh, only: crest_positions
  use gfb_foil_builder, only: strip_shape, foil_plan_type
  use gfb_strip_system, only: strip_system_type, destroy_strip_system
  use gfb_strip_answer, only: strip_recorder_type, start_recorder, resume_recorder, read_answer, destroy_recorder, &
                              strip_answer_type, differs_from
  use gfb_newton, only: newton_type, newton_report_type, forget_factors, visit_counts, newton_settings_type, create_newton, &
                        destroy_newton, imbalance
  use gfb_strip_load_step, only: load_path_type, create_load_path, take_load_step, destroy_load_path, visit_strip
  use gfb_case_file, only: history_row_type, case_array_type
  use gfb_contact_record, only: record_contacts, visit_contact_record, add_contact_arrays
  use gfb_strip_summary, only: step_quantities, show_step, show_step_header, answer_quantities, cost_quantities, strip_run_type, &
                               visit_run
  use gfb_strip_companions, only: strip_companions, show_companions, add_companions
  use gfb_restart_file, only: save_restart, read_restart, end_reading, refuse_restart, slipped_on
  use gfb_reasons, only: reason_type, reason_load_step
  use gfb_outcome, only: add_outcome
  use gfb_run_context, only: run_context_type
  use gfb_run_log, only: run_log_type
  use gfb_quantity, only: quantity_type, add_quantity
  use gfb_petsc_session, only: rank_count, largest_over_ranks
  use gfb_shell_geometry, only: node_unknowns
  use gfb_result_set, only: result_grid_type, write_result_set
  use gfb_foil_grid, only: create_foil_grid, add_displacement, add_contacts, add_stress
  use gfb_foil_stress, only: shell_stresses, shell_corner_stresses, find_largest
  use gfb_answer_notes, only: show_contact_notes, show_loop_note
  use gfb_provenance, only: blas_in_use
  use gfb_mesh_case, only: linear_solver_iterative
  use gfb_substructures, only: kind_count
  use gfb_strip_builder, only: build_strip
  use gfb_foil_plan, only: plan_foil
  use gfb_cost_events, only: enter_stage, leave_stage
  use gfb_study, only: study_type, run_points
  implicit none (type)
  private

  real(wp), parameter :: rounding = 1.0e-9_wp !! of a balance of forces, relative

  real(wp), parameter :: large_deflection = 0.25_wp !! of the bump height
  real(wp), parameter :: lost_digits = 1.0e-6_wp !! round-off of deflections that is worth a warning

  !> The strip, its solver, and what was recorded. Keep it where it is.
  type, extends(study_type), public :: strip_study_type
    private
    type(foil_plan_type) :: plan
    type(scene_type) :: scene
    type(run_context_type) :: context
    type(strip_system_type) :: strip
    type(newton_type) :: newton
    type(strip_run_type) :: run
    type(load_path_type) :: path
    type(strip_recorder_type) :: recorder
    integer :: before(2) = 0 !! iterations and factorizations before the present step
  contains
    procedure :: prepare => prepare_strip, solve => solve_strip, reach => reach_step
    procedure :: record_point => record_step, save_point => save_step, save_stopped
    procedure :: write => write_study, left_out => strip_left_out, discard => discard_strip
    procedure, private :: save, restore, visit, judge, explain
  end type strip_study_type

contains

  !> All load steps, after strip and solver have been made.
  !>
  !> Fails when a restart file cannot be read.
  subroutine load_and_unload(self, error)
    class(strip_study_type), target, intent(inout) :: self !! with strip and solver made
    type(error_type), allocatable, intent(out) :: error !! why it failed
    type(reason_type) :: reason
    character(len=:), allocatable :: lifted
    integer :: last

    associate (scene => self%scene, log => self%context%log, run => self%run)
      last = scene%strip_load%steps_up + scene%strip_load%steps_down
      allocate (run%history(0))
      call start_recorder(self%strip, scene%bump_foil%bumps, self%recorder)
      call create_load_path(self%strip, self%path)
      run%full = self%recorder%last
      run%last = self%recorder%last
      if (self%context%restart%continues) then
        call self%restore(last, error)
        if (allocated(error)) return
      end if
      call show_step_header(log)
      lifted = what_lifts(scene)
      if (lifted /= '' .and. run%steps == 0) then
        call self%explain(1, lifted, reason)
        reason%shown = .true.
      else
        call run_points(self, run%steps + 1, last, reason, error)
      end if
      self%reason = reason
      run%converged = .not. reason%is_given()
      associate (path => self%path)
        if (path%at_round_off > 0) then
          call log%line(text(path%at_round_off)//' steps ended at round-off, where Newton''s moved by up to '// &
                        text(path%round_off, 2)//' of the deflection')
        end if
        if (path%homotopies + path%cuts > 0) then
          call log%line(text(path%homotopies)//' steps by a longer stick length, '//text(path%cuts)//' cuts')
        end if
      end associate
    end associate
    call destroy_load_path(self%path)
    call destroy_recorder(self%recorder)
  end subroutine load_and_unload

  !> Brings the strip to the load of a step.
  subroutine reach_step(self, point, reason, error)
    class(strip_study_type), target, intent(inout) :: self !! the load steps
    integer, intent(in) :: point             !! number of the step
    type(reason_type), intent(out) :: reason !! why there is no answer
    type(error_type), allocatable, intent(out) :: error !! none
    type(newton_report_type) :: report

    self%before = [self%newton%iterations, self%newton%factorizations]
    associate (load => self%scene%strip_load)
      call take_load_step(self%strip, self%newton, load_factor(point, load%steps_up, load%steps_down), self%path, report)
    end associate
    if (.not. (stop_agreed() .or. report%converged)) call self%explain(point, report%reason, reason)
  end subroutine reach_step

  !> Displacements of this rank's nodes.
  function displacements_of(strip) result(moved)
    type(strip_system_type), intent(in) :: strip
    real(wp), allocatable :: moved(:, :) ! (5, local nodes) [m], [rad]
    Vec :: solution
    PetscErrorCode :: ierr

    allocate (moved(node_unknowns, size(strip%foil%part%mesh_node)))
    call strip%foil_solution(solution)
    call strip%foil%displacements(solution, moved)
    PetscCallA(VecDestroy(solution, ierr))
  end function displacements_of

  !> Largest von Mises stress of all elements, on either face [Pa].
  real(wp) function largest_stress(strip) result(stress)
    type(strip_system_type), intent(in) :: strip
    real(wp) :: largest(1)
    integer :: element, corner, face

    call find_largest(shell_corner_stresses(strip%foil, displacements_of(strip)), largest(1), element, corner, face)
    largest = largest_over_ranks(largest)
    stress = largest(1)
  end function largest_stress

  !> Records a step's answer, from which the next one starts.
  subroutine record_step(self, point)
    class(strip_study_type), target, intent(inout) :: self !! the load steps
    integer, intent(in) :: point !! number of the step
    type(history_row_type) :: row
    integer :: iterations, factorizations

    associate (load => self%scene%strip_load, run => self%run)
      call read_answer(self%strip, full_force(self%scene), self%recorder, run%last)
      call record_contacts(self%strip%contacts, point, load%steps_up + load%steps_down, run%contacts)
      call self%strip%commit()
      if (point == load%steps_up) run%last%round_off = max(self%strip%stiffness_round_off(), self%path%round_off)
      if (point == load%steps_up) run%last%stress = largest_stress(self%strip)
      if (point <= load%steps_up) run%full = run%last
      run%steps = point
      iterations = self%newton%iterations - self%before(1)
      factorizations = self%newton%factorizations - self%before(2)
      row%quantity = step_quantities(run%last, point, load%kind == load_plates, iterations, factorizations)
      run%history = [run%history, row]
      call show_step(self%context%log, run%last, point, iterations, factorizations)
    end associate
  end subroutine record_step

  !> Writes the restart file, where one is due.
  subroutine save_step(self, point)
    class(strip_study_type), target, intent(inout) :: self !! the load steps
    integer, intent(in) :: point !! number of the step
    if (self%context%restart%is_due(point)) call self%save()
  end subroutine save_step

  !> Writes the restart file of load steps that are stopped after one of them.
  subroutine save_stopped(self, point)
    class(strip_study_type), target, intent(inout) :: self !! the load steps
    integer, intent(in) :: point !! number of the last one that has an answer

    if (point < 1 .or. .not. self%context%restart%may_be_written()) return
    call self%save()
    call self%context%restart%tell(self%context%log, stop_words()//' after step '//text(point)//' of '// &
                                   text(self%scene%strip_load%steps_up + self%scene%strip_load%steps_down))
  end subroutine save_stopped

  !> Writes the restart file after a step; where files are asked for the solver loses its factors.
  subroutine save(self)
    class(strip_study_type), intent(inout) :: self !! the load steps
    type(archive_type) :: archive(1)

    if (self%context%restart%every > 0) call forget_factors(self%newton)
    archive(1)%name = 'strip'
    call self%visit(archive(1))
    call save_restart(self%scene, self%context%restart, self%context%log, self%run%steps, 0.0_wp, archive)
  end subroutine save

  !> Puts the strip where the restart file says.
  !>
  !> Fails when the file is damaged.
  subroutine restore(self, steps, error)
    class(strip_study_type), intent(inout) :: self !! the load steps, as they begin
    integer, intent(in) :: steps !! that there will be
    type(error_type), allocatable, intent(out) :: error !! why it failed
    type(archive_type) :: archive
    real(wp) :: off
    logical :: differs

    call read_restart(self%context%restart, 'strip', archive, error)
    if (allocated(error)) return
    call self%visit(archive)
    call end_reading(self%context%restart, archive, error)
    if (allocated(error)) return
    off = imbalance(self%newton)
    differs = differs_from(self%strip, self%scene%bump_foil%bumps, self%run%last)
    if (differs .or. .not. off <= slipped_on) then
      call refuse_restart(self%context%restart, 'the file is damaged at /strip: its state is not the answer of its last step', error)
      return
    end if
    call resume_recorder(self%strip, self%run%last, self%recorder)
    call self%context%log%line('restart: resumed from step '//text(self%run%steps)//' of '//text(steps))
  end subroutine restore

  !> Saves or restores strip, counters, and all that was recorded.
  subroutine visit(self, archive)
    class(strip_study_type), intent(inout) :: self !! the load steps
    type(archive_type), intent(inout) :: archive !! that saves or restores

    call visit_strip(archive, self%strip, self%path)
    call visit_counts(archive, self%newton)
    call visit_run(archive, self%run)
    if (.not. archive%saves) call self%judge(archive)
    if (archive%failed) return
    call visit_contact_record(archive, self%strip%contacts, self%strip%foil%mesh%rows, self%run%steps, self%run%contacts)
  end subroutine visit

  !> Whether the numbers of a run that were read are those after the step of the file.
  subroutine judge(self, archive)
    class(strip_study_type), intent(in) :: self !! the load steps
    type(archive_type), intent(inout) :: archive !! that has restored them
    real(wp) :: factor

    if (archive%failed) return
    associate (load => self%scene%strip_load, run => self%run, step => self%context%restart%step)
      call archive%require(run%steps == step, 'the number of steps')
      call archive%require(size(run%history) == step, 'a row for each step')
      factor = load_factor(step, load%steps_up, load%steps_down)
      call archive%require(max(abs(self%path%at_here - factor), abs(run%last%factor - factor)) <= rounding, 'the load of the last step')
      call archive%require(self%path%at_before >= 0.0_wp .and. self%path%at_before <= 1.0_wp, 'the load before that')
      factor = load_factor(min(step, load%steps_up), load%steps_up, load%steps_down)
      call archive%require(abs(run%full%factor - factor) <= rounding, 'the largest load')
      call archive%require(min(self%path%answers, self%path%homotopies, self%path%cuts, self%path%at_round_off) >= 0, &
                           'a count of the path')
      call archive%require(min(minval(run%full%count), minval(run%last%count)) >= 0, 'a count of contacts')
    end associate
  end subroutine judge

  !> Says why a step has no answer.
  subroutine explain(self, step, detail, reason)
    class(strip_study_type), intent(in) :: self !! the load steps
    integer, intent(in) :: step !! number of the step
    character(len=*), intent(in) :: detail !! what hinders
    type(reason_type), intent(out) :: reason !! why there is none

    associate (load => self%scene%strip_load)
      reason%code = reason_load_step
      reason%at = step
      reason%of = load%steps_up + load%steps_down
      reason%detail = detail
    end associate
    call self%context%log%tell(reason%words())
  end subroutine explain

  !> Share of the full load at a step.
  pure real(wp) function load_factor(step, up, down) result(factor)
    integer, intent(in) :: step, up, down

    if (step <= up) then
      factor = real(step, wp)/real(up, wp)
    else
      factor = real(up + down - step, wp)/real(down, wp)
    end if
  end function load_factor

  !> Full force on all crests where it is given [N].
  real(wp) function full_force(scene) result(force)
    type(scene_type), intent(in) :: scene

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
    real(wp), allocatable :: force(:), crest(:), half_length(:)
    real(wp) :: corner(2) !! the outermost ones [m]
    real(wp) :: total, size_of_load, centre, reach

    words = ''
    associate (foil => scene%bump_foil, load => scene%strip_load)
      if (foil%fixed_edge /= fixed_edge_none .or. load%kind == load_plates .or. &
          load%support /= support_contact) return
      force = crest_forces(load, foil)
      crest = crest_positions(strip_shape(scene))
      total = sum(force)
      size_of_load = sum(abs(force))
      half_length = foil%half_length%each(foil%bumps)
      corner = [minval(crest) - half_length(1), maxval(crest) + half_length(foil%bumps)]
      reach = maxval(crest) - minval(crest) + half_length(1) + half_length(foil%bumps)
      if (.not. size_of_load > 0.0_wp) return
      if (total <= rounding*size_of_load) then
        words = 'the load lifts the strip off the sleeve: the forces on the crests add up to '//text(total, 4)// &
                ' N towards the sleeve, and the strip is fixed nowhere'
        return
      end if
      centre = (dot_product(force, crest)/total - 0.5_wp*(corner(1) + corner(2)))/reach
      if (abs(centre) > 0.5_wp) then
        words = 'the load tips the strip over: it acts beyond the last corner line, and the strip is fixed nowhere'
      end if
    end associate
  end function what_lifts

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
    if (largest > large_deflection*scene%bump_foil%height%value) then
      call log%warning('a crest moves by '//text(100.0_wp*largest/scene%bump_foil%height%value, 3)// &
                       ' % of the bump height: displacements were taken to be small')
    end if
    if (answer%round_off > lost_digits) then
      call log%warning('round-off leaves an error of about '//text(answer%round_off, 2)//' of deflections and forces: '// &
                       'the foil is so thin that the last digits of its stretching stiffness are a part of its bending stiffness')
    end if
  end subroutine warn

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
    if (run%full%stress > 0.0_wp) then
      call log%line('largest stress '//text(run%full%stress*1.0e-6_wp, 5)//' MPa (von Mises)')
    end if
    if (run%converged .and. run%full%factor > run%last%factor) then
      call log%line('dissipated in the cycle '//text(run%last%external_work*1.0e3_wp, 5)//' mJ')
    end if
  end subroutine show_closing_block

  !> Plans the strip.
  subroutine prepare_strip(self, scene, log)
    class(strip_study_type), intent(inout) :: self !! the study
    type(scene_type), intent(in) :: scene !! what is asked for
    type(run_log_type), intent(in) :: log !! where lines go

    call plan_foil(scene, log, self%plan)
    self%memory = self%plan%memory
  end subroutine prepare_strip

  !> Builds the strip and takes all load steps.
  !>
  !> Fails when the mesh cannot be made or a restart file cannot be read.
  subroutine solve_strip(self, scene, context, error)
    class(strip_study_type), target, intent(inout) :: self !! the study
    type(scene_type), intent(in) :: scene !! what is asked for
    type(run_context_type), intent(in) :: context !! of the run
    type(error_type), allocatable, intent(out) :: error !! why it failed

    self%scene = scene
    self%context = context
    associate (strip => self%strip, newton => self%newton, run => self%run, solver => scene%solver)
      call enter_stage('set-up')
      call build_strip(scene, self%plan, strip, error)
      call leave_stage()
      if (allocated(error)) return
      call context%log%line('super-elements: '//text(kind_count(strip%foil%substructure))//' distinct of '// &
                            text(size(strip%foil%substructure))//', '//text(strip%unknowns)//' unknowns')
      if (solver%linear_solver == linear_solver_iterative) call strip%find_motions()
      call create_newton(newton, strip, 'strip_', &
                         newton_settings_type(solver%residual_tolerance, solver%step_tolerance, &
                                              solver%maximum_iterations), context%log)
      call load_and_unload(self, error)
      if (allocated(error)) return
      self%converged = run%converged
      self%unknowns = strip%unknowns
      self%iterations = newton%iterations
      self%factorizations = newton%factorizations
      self%found = answer_quantities(run%full, run%last, scene%strip_load%kind == load_plates, self%converged)
    end associate
  end subroutine solve_strip

  !> Shows the answer and writes the result files.
  !>
  !> Fails when one cannot be written.
  subroutine write_study(self, scene, context, summary, error)
    class(strip_study_type), target, intent(inout) :: self !! the study
    type(scene_type), intent(in) :: scene !! what is asked for
    type(run_context_type), intent(in) :: context !! of the run
    type(quantity_type), allocatable, intent(out) :: summary(:) !! what the summary says
    type(error_type), allocatable, intent(out) :: error !! why it failed
    type(result_grid_type) :: grid
    type(case_array_type), allocatable :: arrays(:)
    real(wp), allocatable :: moved(:, :)
    logical :: plates

    plates = scene%strip_load%kind == load_plates
    self%newton%iterations = self%iterations
    self%newton%factorizations = self%factorizations
    associate (strip => self%strip, run => self%run)
      run%converged = self%converged
      call add_quantity(summary, answer_quantities(run%full, run%last, plates, run%converged))
      if (allocated(self%more)) call add_quantity(summary, self%more)
      call add_quantity(summary, cost_quantities(strip, self%newton, context%start_time))
      run%companions = strip_companions(scene, run%full%force)
      call show_closing_block(context%log, run, plates)
      call warn(context%log, scene, run%full)
      call show_contact_notes(context%log, scene%contact, run%full%contact, max(run%full%travel, maxval(run%full%deflection)))
      if (run%full%factor > run%last%factor) call show_loop_note(context%log, scene%contact, run%full%contact%slip)
      moved = displacements_of(strip)
      call create_foil_grid(strip%foil, 'bump_foil', grid)
      call add_displacement(strip%foil, 'displacement', 'of the mid-surface', moved, grid)
      call add_contacts(strip%contacts, strip%foil, grid)
      call add_stress(strip%foil, shell_stresses(strip%foil, moved), grid)
      allocate (arrays(0))
      call add_contact_arrays(strip%contacts, strip%foil, run%contacts, run%steps, arrays)
      call add_companions(run%companions, arrays)
      call add_outcome(summary, run%converged, self%reason)
      call write_result_set(scene, context%folder, run%converged, context%origin(), summary, run%history, &
                            arrays, [grid], context%csv, context%log, error)
    end associate
  end subroutine write_study

  !> What the model leaves out, and why.
  function strip_left_out(self, scene) result(words)
    class(strip_study_type), intent(in) :: self !! the study
    type(scene_type), intent(in) :: scene !! what is asked for
    character(len=:), allocatable :: words

    words = ''
    if (self%plan%half) words = 'the other half of the width, which mirrors the one solved; '
    if (self%plan%reduced) words = words//'unknowns of '//text(scene%bump_foil%bumps)// &
                                   ' bumps between their loaded lines, condensed exactly; '
  end function strip_left_out

  !> Frees what the solvers hold.
  subroutine discard_strip(self)
    class(strip_study_type), intent(inout) :: self !! the study

    call destroy_newton(self%newton)
    call destroy_strip_system(self%strip)
  end subroutine discard_strip
end module gfb_strip_study
