!> A strip's answer as results, and how the log shows it.
module gfb_strip_summary
  use gfb_kinds, only: wp
  use gfb_units, only: micrometres
  use gfb_text, only: text
  use gfb_run_log, only: run_log_type
  use gfb_case_file, only: history_row_type, visit_rows
  use gfb_archive, only: archive_type
  use gfb_strip_answer, only: strip_answer_type, visit_answer
  use gfb_contact_record, only: contact_record_type
  use gfb_quantity, only: quantity_type
  use gfb_result_names, only: add_result
  use gfb_result_table, only: of_this_step, of_all_steps, travel_of_plate
  use gfb_c_library, only: peak_memory
  use gfb_petsc_session, only: wall_time, sum_over_ranks
  use gfb_substructures, only: kind_count
  use gfb_newton, only: newton_type
  use gfb_shell_geometry, only: node_unknowns
  use gfb_strip_companions, only: companions_type
  use gfb_strip_system, only: strip_system_type
  implicit none (type, external)
  private
  public :: visit_run, step_quantities, answer_quantities, cost_quantities, show_step, &
            show_step_header

  !> What a run gathers.
  type, public :: strip_run_type
    type(strip_answer_type) :: full, last !! at the largest load, and of the last step
    type(history_row_type), allocatable :: history(:)
    type(contact_record_type) :: contacts
    type(companions_type) :: companions
    integer :: steps = 0                  !! done
    logical :: converged = .true.
  end type strip_run_type

  real(wp), parameter :: told_round_off = 1.0e-8_wp !! smaller is no matter

contains

  !> Saves or restores a run but for the contacts; one that is restored knows its number of bumps.
  pure subroutine visit_run(archive, run)
    type(archive_type), intent(inout) :: archive !! that saves or restores
    type(strip_run_type), intent(inout) :: run !! written where the archive restores

    call archive%part('history')
    call visit_rows(archive, run%history)
    call archive%part('full')
    call visit_answer(archive, run%full)
    call archive%part('last')
    call visit_answer(archive, run%last)
    call archive%visit('steps', run%steps)
  end subroutine visit_run

  !> A row of the history.
  function step_quantities(answer, step, plates, newton_iterations, factorizations) result(list)
    type(strip_answer_type), intent(in) :: answer !! of this step
    integer, intent(in) :: step !! number of the step
    logical, intent(in) :: plates             !! the load is a plate's
    integer, intent(in) :: newton_iterations, factorizations  !! of this step
    type(quantity_type), allocatable :: list(:)
    character(len=*), parameter :: surface(2) = [character(len=7) :: 'sleeve', 'top']
    character(len=*), parameter :: state(3) = [character(len=5) :: 'open', 'stick', 'slip']
    integer :: i, k

    call add_result(list, 'step', step)
    call add_result(list, 'load_factor', answer%factor)
    call add_result(list, 'force', answer%force)
    if (plates) call add_result(list, 'plate_travel', answer%travel)
    call add_crests(answer, list)
    do k = 1, size(surface)
      if (sum(answer%count(:, k)) == 0) cycle
      do i = 1, size(state)
        call add_result(list, trim(surface(k))//'_'//trim(state(i)), answer%count(i, k))
      end do
    end do
    call add_result(list, 'external_work', answer%external_work)
    call add_result(list, 'strain_energy', answer%strain_energy)
    call add_result(list, 'penalty_energy', answer%penalty_energy)
    call add_result(list, 'friction_work', answer%friction_work)
    call add_result(list, 'newton_iterations', newton_iterations, of_this_step)
    call add_result(list, 'factorizations', factorizations, of_this_step)
  end function step_quantities

  !> Adds the deflection of every crest.
  subroutine add_crests(answer, list)
    type(strip_answer_type), intent(in) :: answer
    type(quantity_type), allocatable, intent(inout) :: list(:)
    integer :: bump

    do bump = 1, size(answer%deflection)
      call add_result(list, 'crest_deflection_'//text(bump), answer%deflection(bump))
    end do
  end subroutine add_crests

  !> The summary: what holds at the full load, and what the cycle cost.
  function answer_quantities(full, last, plates, converged) result(list)
    type(strip_answer_type), intent(in) :: full !! at the full load, or the largest reached
    type(strip_answer_type), intent(in) :: last !! of the last step
    logical, intent(in) :: plates !! the load is a plate's
    logical, intent(in) :: converged !! all load steps were taken
    type(quantity_type), allocatable :: list(:)
    real(wp) :: largest

    largest = maxval(full%deflection)
    call add_result(list, 'analysis', 'strip')
    call add_result(list, 'converged', converged)
    call add_crests(full, list)
    if (plates) then
      largest = full%travel
      call add_result(list, 'maximum_deflection', largest, travel_of_plate)
    else
      call add_result(list, 'maximum_deflection', largest)
    end if
    call add_result(list, 'maximum_force', full%force)
    if (largest > 0.0_wp) call add_result(list, 'loading_stiffness', full%force/largest)
    if (full%stress > 0.0_wp) call add_result(list, 'maximum_bump_foil_stress', full%stress)
    if (full%round_off > told_round_off) then
      call add_result(list, 'deflection_round_off', full%round_off)
    end if
    if (converged .and. full%factor > last%factor) then
      call add_result(list, 'dissipated_energy', last%external_work)
    end if
  end function answer_quantities

  !> Heads of the table of steps.
  subroutine show_step_header(log)
    type(run_log_type), intent(in) :: log !! where lines go
    call log%line('   step   force [N]  largest deflection [um]   sleeve open/stick/slip   '// &
                  'top open/stick/slip  Newton  factors')
  end subroutine show_step_header

  !> A line of the table of steps.
  subroutine show_step(log, answer, step, newton_iterations, factorizations)
    type(run_log_type), intent(in) :: log !! where lines go
    type(strip_answer_type), intent(in) :: answer !! of this step
    integer, intent(in) :: step !! number of the step
    integer, intent(in) :: newton_iterations, factorizations !! of this step
    character(len=160) :: line

    write (line, '(i7, f12.4, f25.5, 2x, 3i8, 2x, 3i7, i8, i9)') step, answer%force, &
      max(answer%travel, maxval(answer%deflection))*micrometres, answer%count(:, 1), &
      answer%count(:, 2), newton_iterations, factorizations
    call log%line(trim(line))
    call log%progress('step '//text(step))
  end subroutine show_step

  !> Quantities of what it cost.
  function cost_quantities(strip, newton, start_time) result(list)
    type(strip_system_type), intent(in) :: strip !! with its unknowns and super-elements
    type(newton_type), intent(in) :: newton !! its solver, with the counts of all steps
    real(wp), intent(in) :: start_time !! [s]
    type(quantity_type), allocatable :: list(:)
    real(wp) :: memory(1)
    integer :: stations, rows

    stations = strip%foil%mesh%stations
    rows = strip%foil%mesh%rows
    if (strip%foil%mesh%half) rows = 2*rows - 1
    memory = sum_over_ranks([peak_memory()])
    call add_result(list, 'unknowns', strip%unknowns)
    call add_result(list, 'foil_unknowns_full', node_unknowns*stations*rows)
    call add_result(list, 'foil_unknowns_retained', &
                    node_unknowns*(size(strip%foil%substructure) + 1)*rows)
    call add_result(list, 'distinct_super_elements', kind_count(strip%foil%substructure))
    call add_result(list, 'newton_iterations', newton%iterations, of_all_steps)
    call add_result(list, 'factorizations', newton%factorizations, of_all_steps)
    call add_result(list, 'wall_time', wall_time() - start_time)
    call add_result(list, 'peak_memory', memory(1))
  end function cost_quantities
end module gfb_strip_summary
