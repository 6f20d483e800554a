#include "gfb_petsc.h"
!> What is written of a machine at an equilibrium: the body, the shaft's line, each bearing's answer and fields.
module gfb_machine_results
  use gfb_kinds, only: wp
  use gfb_text, only: text
  use gfb_run_log, only: run_log_type
  use gfb_quantity, only: quantity_type
  use gfb_result_names, only: add_result
  use gfb_study_cases, only: output_case_type
  use gfb_shaft, only: motions, body_type, journal_places
  use gfb_machine, only: machine_type, journal_type
  use gfb_bearing_rows, only: add_rows, show_rows
  use gfb_bearing_system, only: bearing_system_type
  use gfb_bearing_answer, only: bearing_answer_type, bearing_answer
  use gfb_machine_equilibrium, only: machine_bearing_type
  use gfb_machine_motions, only: machine_motions_type, growth_of, frequency_of
  use gfb_case_file, only: case_array_type, history_row_type, add_array
  use gfb_result_set, only: result_grid_type
  use gfb_film_grid, only: add_film_grid
  use gfb_foil_grid, only: add_foil_grids
  implicit none (type)
  private
  public :: add_body, add_shaft_line, add_bearing, add_surfaces, history_row

contains

  !> The body.
  subroutine add_body(machine, summary)
    type(machine_type), intent(in) :: machine
    type(quantity_type), allocatable, intent(inout) :: summary(:) !! gets mass, centre and inertias
    type(body_type) :: body

    body = machine%shaft%body()
    call add_result(summary, 'mass', body%mass)
    call add_result(summary, 'centre_of_mass', body%centre)
    call add_result(summary, 'transverse_inertia', body%transverse_inertia)
    call add_result(summary, 'polar_inertia', body%polar_inertia)
  end subroutine add_body

  !> The line of the shaft, node by node.
  subroutine add_shaft_line(machine, line, arrays)
    type(machine_type), intent(in) :: machine
    real(wp), intent(in) :: line(:) !! motions of its shaft across the axis [m], [1]
    type(case_array_type), allocatable, intent(inout) :: arrays(:) !! of the result file
    real(wp), allocatable :: table(:, :)
    real(wp) :: sign(motions)
    integer :: k, place(motions)

    associate (shaft => machine%shaft)
      allocate (table(1 + motions, size(shaft%z)))
      do k = 1, size(shaft%z)
        call journal_places(shaft, k, place, sign)
        table(:, k) = [shaft%z(k), sign*line(place)]
      end do
      call add_array(arrays, '/shaft/line', 'mixed SI', 'z [m], x, y [m], rotation about x and y [rad] of the shaft''s nodes', table)
    end associate
  end subroutine add_shaft_line

  !> A bearing: its answer, a line of the log, and its fields.
  subroutine add_bearing(number, journal, bearing, output, log, answer, summary, grids)
    integer, intent(in) :: number !! of the bearing
    type(journal_type), intent(in) :: journal !! in it
    type(bearing_system_type), intent(in) :: bearing !! at its answer
    type(output_case_type), intent(in) :: output !! what is to be written
    type(run_log_type), intent(in) :: log !! where lines go
    type(bearing_answer_type), intent(out) :: answer !! its
    type(quantity_type), allocatable, intent(inout) :: summary(:) !! gets the answer
    type(result_grid_type), allocatable, intent(inout) :: grids(:) !! get its surfaces

    answer = bearing_answer(bearing)
    call add_rows(number, journal, answer, summary)
    call show_rows(number, journal, answer, log)
    call add_surfaces(number, bearing, output, grids)
  end subroutine add_bearing

  !> The surfaces of a bearing, with its number in their names.
  subroutine add_surfaces(number, bearing, output, grids)
    integer, intent(in) :: number !! of the bearing
    type(bearing_system_type), intent(in) :: bearing !! at a state
    type(output_case_type), intent(in) :: output !! what is to be written
    type(result_grid_type), allocatable, intent(inout) :: grids(:) !! get its surfaces
    integer :: i, before

    before = size(grids)
    call add_film_grid(bearing, output, grids)
    call add_foil_grids(bearing, grids)
    do i = before + 1, size(grids)
      grids(i)%name = 'bearing_'//text(number)//'.'//grids(i)%name
    end do
  end subroutine add_surfaces

  !> A row of a sweep's history.
  function history_row(speed_rpm, machine, bearing, small) result(row)
    real(wp), intent(in) :: speed_rpm !! of the point [rpm]
    type(machine_type), intent(in) :: machine
    type(machine_bearing_type), intent(in) :: bearing(:) !! at their answers
    type(machine_motions_type), intent(in) :: small !! motions about the equilibrium
    type(history_row_type) :: row
    type(bearing_answer_type) :: answer
    real(wp) :: power
    integer :: i

    allocate (row%quantity(0))
    power = 0.0_wp
    call add_result(row%quantity, 'speed_rpm', speed_rpm)
    do i = 1, size(bearing)
      answer = bearing_answer(bearing(i)%bearing)
      power = power + answer%power_loss
      call add_rows(i, machine%journal(i), answer, row%quantity)
    end do
    call add_result(row%quantity, 'power_loss', power)
    if (.not. allocated(small%mode)) return
    call add_result(row%quantity, 'growth_rate', growth_of(small))
    call add_result(row%quantity, 'whirl_frequency', frequency_of(small))
  end function history_row
end module gfb_machine_results
