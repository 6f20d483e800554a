#include "gfb_petsc.h"
!> What a study of modes shows and writes.
module gfb_modes_writing
  use petscmat
  use gfb_kinds, only: wp
  use gfb_errors, only: error_type
  use gfb_text, only: text
  use gfb_run_log, only: run_log_type
  use gfb_quantity, only: quantity_type, add_quantity
  use gfb_results, only: add_result
  use gfb_result_phrases, only: all_modes_found, of_shifted_stiffness
  use gfb_petsc_session, only: wall_time, sum_over_ranks, rank_count
  use gfb_c_library, only: peak_memory
  use gfb_scene, only: scene_type
  use gfb_modes_case, only: part_words, part_top_foil, part_strip
  use gfb_shell_geometry, only: node_unknowns
  use gfb_foil_structure, only: foil_structure_type
  use gfb_eigenmodes, only: modes_type
  use gfb_mode_energies, only: exact
  use gfb_case_file, only: history_row_type, case_array_type
  use gfb_result_set, only: result_grid_type, write_result_set
  use gfb_foil_grid, only: create_foil_grid, add_displacement
  use gfb_provenance, only: blas_in_use
  use gfb_run_context, only: run_context_type
  implicit none (type)
  private
  public :: write_modes

  real(wp), parameter, public :: turn = 2.0_wp*acos(-1.0_wp)
  real(wp), parameter, public :: rigid = 1.0e-3_wp !! eigenvalues below this share of the plate's are rigid [1]

  !> What was found.
  type, public :: modes_result_type
    logical :: converged = .false.                  !! all modes asked for
    type(modes_type) :: modes
    real(wp) :: shift = 0.0_wp                      !! size of the lowest eigenvalue [1/s2]
    real(wp) :: lost = 0.0_wp, left = 0.0_wp        !! digits of eigenvalues, as `sharpen_modes` has it [1]
    type(case_array_type), allocatable :: arrays(:) !! matrices of the reduced strip
    type(quantity_type), allocatable :: reduced(:)  !! its frequencies
  end type modes_result_type

contains

  !> Shows the modes and writes all files.
  !>
  !> Fails when one cannot be written.
  subroutine write_modes(scene, context, component, found, summary, error)
    type(scene_type), intent(in) :: scene !! what is asked for
    type(run_context_type), intent(in) :: context !! of the run
    type(foil_structure_type), intent(in) :: component !! that vibrates
    type(modes_result_type), intent(in) :: found !! the modes
    type(quantity_type), allocatable, intent(out) :: summary(:) !! all of it
    type(error_type), allocatable, intent(out) :: error !! why it failed
    type(history_row_type) :: history(1)
    type(result_grid_type) :: grid

    call show_closing_block(context%log, scene, found%modes, component)
    call warn_of_round_off(context%log, found%lost, found%left, scene%modes%part == part_strip)
    call draw_modes(scene, component, found%modes, grid)
    call add_quantity(history(1)%quantity, mode_quantities(found%converged, found%modes, found%shift))
    call add_round_off(found%lost, found%left, history(1)%quantity)
    call add_quantity(history(1)%quantity, cost_quantities(component, context%start_time))
    call add_quantity(summary, history(1)%quantity)
    call add_quantity(summary, found%reduced)
    call write_result_set(scene, context%folder, found%converged, context%origin(), summary, history, &
                          found%arrays, [grid], context%csv, context%log, error)
  end subroutine write_modes

  !> The shapes of the modes as fields of a surface.
  subroutine draw_modes(scene, component, modes, grid)
    type(scene_type), intent(in) :: scene
    type(foil_structure_type), intent(in) :: component
    type(modes_type), intent(in) :: modes
    type(result_grid_type), intent(out) :: grid
    real(wp), allocatable :: moved(:, :)
    integer :: i

    call create_foil_grid(component, trim(merge('top_foil ', 'bump_foil', scene%modes%part == part_top_foil)), grid)
    allocate (moved(node_unknowns, size(component%part%mesh_node)))
    do i = 1, size(modes%shape)
      call component%displacements(modes%shape(i), moved)
      call add_displacement(component, 'mode_'//text(i), 'shape of unit modal mass', moved, grid)
    end do
  end subroutine draw_modes

  !> Quantities of the answer.
  function mode_quantities(converged, modes, shift) result(list)
    logical, intent(in) :: converged
    type(modes_type), intent(in) :: modes
    real(wp), intent(in) :: shift !! [1/s2]
    type(quantity_type), allocatable :: list(:)
    integer :: i

    call add_result(list, 'analysis', 'modes')
    call add_result(list, 'converged', converged, all_modes_found)
    do i = 1, size(modes%eigenvalue)
      call add_result(list, 'frequency_'//text(i), sqrt(max(modes%eigenvalue(i), 0.0_wp))/turn)
    end do
    call add_result(list, 'rigid_modes', count(abs(modes%eigenvalue) < rigid*shift))
  end function mode_quantities

  !> Quantities of what it cost.
  function cost_quantities(component, start_time) result(list)
    type(foil_structure_type), intent(in) :: component
    real(wp), intent(in) :: start_time !! [s]
    type(quantity_type), allocatable :: list(:)
    real(wp) :: memory(1)

    memory = sum_over_ranks([peak_memory()])
    call add_result(list, 'unknowns', component%unknowns)
    call add_result(list, 'factorizations', 1, of_shifted_stiffness)
    call add_result(list, 'wall_time', wall_time() - start_time)
    call add_result(list, 'peak_memory', memory(1))
  end function cost_quantities

  !> Adds what round-off leaves, where it is worth a word.
  subroutine add_round_off(lost, left, list)
    real(wp), intent(in) :: lost, left !! of the eigenvalues, as `sharpen_modes` has it [1]
    type(quantity_type), allocatable, intent(inout) :: list(:)

    if (lost > exact) call add_result(list, 'frequency_round_off', left)
  end subroutine add_round_off

  !> Says where the matrix had lost digits.
  subroutine warn_of_round_off(log, lost, left, reduced)
    type(run_log_type), intent(in) :: log
    real(wp), intent(in) :: lost, left !! of the eigenvalues [1]
    logical, intent(in) :: reduced     !! there is a reduced strip too

    if (.not. lost > exact) return
    call log%warning('the foil is so thin that round-off of its stretching stiffness moves frequencies by up to '// &
                     text(0.5_wp*lost, 2)//' of themselves; the energies of strains put them right, to about '// &
                     text(left, 2))
    if (reduced) call log%warning('the Craig-Bampton matrices and frequencies keep that round-off')
  end subroutine warn_of_round_off

  !> The answer in the units an engineer reads.
  subroutine show_closing_block(log, scene, modes, component)
    type(run_log_type), intent(in) :: log
    type(scene_type), intent(in) :: scene
    type(modes_type), intent(in) :: modes
    type(foil_structure_type), intent(in) :: component
    integer :: i

    call log%heading('answer')
    do i = 1, size(modes%eigenvalue)
      call log%line('mode '//text(i)//'  '//text(sqrt(max(modes%eigenvalue(i), 0.0_wp))/turn, 6)//' Hz')
    end do
    call log%line(trim(part_words(scene%modes%part))//' of '//text(component%unknowns)//' unknowns, '// &
                  text(rank_count())//' rank(s), BLAS '//blas_in_use())
  end subroutine show_closing_block
end module gfb_modes_writing
