#include "gfb_petsc.h"
!> What a strip's study shows and writes.
module gfb_strip_writing
  use petscvec
  use gfb_kinds, only: wp
  use gfb_errors, only: error_type
  use gfb_text, only: text
  use gfb_run_log, only: run_log_type
  use gfb_quantity, only: quantity_type, add_quantity
  use gfb_petsc_session, only: rank_count
  use gfb_scene, only: scene_type
  use gfb_strip_load_case, only: load_plates
  use gfb_shell_geometry, only: node_unknowns
  use gfb_strip_answer, only: strip_answer_type
  use gfb_case_file, only: case_array_type, add_arrays
  use gfb_result_set, only: result_grid_type, write_result_set
  use gfb_foil_grid, only: create_foil_grid, add_displacement, add_contacts, add_stress
  use gfb_foil_stress, only: shell_stresses
  use gfb_strip_summary, only: answer_quantities, cost_quantities
  use gfb_strip_record, only: strip_run_type
  use gfb_strip_companions, only: strip_companions, show_companions, companion_arrays
  use gfb_contact_notes, only: show_contact_notes, show_loop_note
  use gfb_contact_record, only: contact_arrays
  use gfb_provenance, only: blas_in_use
  use gfb_run_context, only: run_context_type
  use gfb_load_steps, only: load_steps_type
  implicit none (type)
  private
  public :: write_strip

  real(wp), parameter :: large_deflection = 0.25_wp !! of the bump height
  real(wp), parameter :: lost_digits = 1.0e-6_wp !! round-off of deflections that is worth a warning

contains

  !> Shows the answer and writes all files.
  !>
  !> Fails when one cannot be written.
  subroutine write_strip(scene, context, steps, more, summary, error)
    type(scene_type), intent(in) :: scene !! what is asked for
    type(run_context_type), intent(in) :: context !! of the run
    type(load_steps_type), intent(inout) :: steps !! that were taken
    type(quantity_type), intent(in) :: more(:) !! for the summary
    type(quantity_type), allocatable, intent(out) :: summary(:) !! all of it
    type(error_type), allocatable, intent(out) :: error !! why it failed
    logical :: plates

    plates = scene%strip_load%kind == load_plates
    associate (run => steps%run)
      call add_quantity(summary, answer_quantities(run%full, run%last, plates, run%converged))
      call add_quantity(summary, more)
      call add_quantity(summary, cost_quantities(steps%strip, steps%newton, context%start_time))
      run%companions = strip_companions(scene, run%full%force)
      call show_closing_block(context%log, run, plates)
      call warn(context%log, scene, run%full)
      call show_contact_notes(context%log, scene%contact, run%full%contact, max(run%full%travel, maxval(run%full%deflection)))
      if (run%full%factor > run%last%factor) call show_loop_note(context%log, scene%contact, run%full%contact%slip)
    end associate
    call write_files(scene, context, steps, summary, error)
  end subroutine write_strip

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

  !> Writes all files.
  !>
  !> Fails when one cannot be written.
  subroutine write_files(scene, context, steps, summary, error)
    type(scene_type), intent(in) :: scene
    type(run_context_type), intent(in) :: context
    type(load_steps_type), intent(in) :: steps
    type(quantity_type), intent(in) :: summary(:)
    type(error_type), allocatable, intent(out) :: error

    type(result_grid_type) :: grid
    type(case_array_type), allocatable :: arrays(:)
    real(wp), allocatable :: moved(:, :)
    Vec :: solution
    PetscErrorCode :: ierr

    associate (strip => steps%strip, run => steps%run)
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
      call write_result_set(scene, context%folder, run%converged, context%origin(), summary, run%history, &
                            arrays, [grid], context%csv, context%log, error)
    end associate
  end subroutine write_files

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
end module gfb_strip_writing
