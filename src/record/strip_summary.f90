!> Names, units and meanings of a strip's answer, and how the log shows it.
module gfb_strip_summary
  use gfb_kinds, only: wp
  use gfb_text, only: text
  use gfb_run_log, only: run_log_type
  use gfb_quantity, only: quantity_type, number_quantity, count_quantity, word_quantity, &
    truth_quantity, add_quantity
  use gfb_c_library, only: peak_memory
  use gfb_petsc_session, only: wall_time, sum_over_ranks
  use gfb_scene, only: scene_type
  use gfb_substructures, only: kind_count
  use gfb_newton, only: newton_type
  use gfb_shell_geometry, only: node_unknowns
  use gfb_strip_answer, only: strip_answer_type
  use gfb_strip_system, only: strip_system_type
  implicit none (type, external)
  private
  public :: step_quantities, answer_quantities, cost_quantities, show_step, &
            show_step_header

  real(wp), parameter :: micrometres = 1.0e6_wp !! in a metre
  real(wp), parameter :: told_round_off = 1.0e-8_wp !! smaller is no matter

contains

  !> A row of the history.
  function step_quantities(answer, step, plates, newton_iterations, factorizations) result(list)
    type(strip_answer_type), intent(in) :: answer
    integer, intent(in) :: step
    logical, intent(in) :: plates             !! the load is a plate's
    integer, intent(in) :: newton_iterations  !! of this step
    integer, intent(in) :: factorizations     !! of this step
    type(quantity_type), allocatable :: list(:)
    character(len=*), parameter :: surface(2) = [character(len=7) :: 'sleeve', 'top']
    character(len=*), parameter :: state(3) = [character(len=5) :: 'open', 'stick', 'slip']
    integer :: i, k

    call add_quantity(list, count_quantity('step', step, 'load step, 0: unloaded'))
    call add_quantity(list, number_quantity('load_factor', answer%factor, '1', &
      'share of the full load'))
    call add_quantity(list, number_quantity('force', answer%force, 'N', 'on all crests'))
    if (plates) call add_quantity(list, number_quantity('plate_travel', answer%travel, 'm', &
      'way of the upper plate towards the sleeve'))
    call add_quantity(list, crest_quantities(answer))
    do k = 1, size(surface)
      if (sum(answer%count(:, k)) == 0) cycle
      do i = 1, size(state)
        call add_quantity(list, count_quantity(trim(surface(k))//'_'//trim(state(i)), &
          answer%count(i, k), 'contact nodes in this state'))
      end do
    end do
    call add_quantity(list, energy_quantities(answer))
    call add_quantity(list, count_quantity('newton_iterations', newton_iterations, 'of this step'))
    call add_quantity(list, count_quantity('factorizations', factorizations, 'of this step'))
  end function step_quantities

  !> Deflection of every crest.
  function crest_quantities(answer) result(list)
    type(strip_answer_type), intent(in) :: answer
    type(quantity_type) :: list(size(answer%deflection))
    integer :: bump

    do bump = 1, size(list)
      list(bump) = number_quantity('crest_deflection_'//text(bump), answer%deflection(bump), 'm', &
                                   'mean deflection of a crest line towards the sleeve')
    end do
  end function crest_quantities

  !> Works and energies since the start.
  function energy_quantities(answer) result(list)
    type(strip_answer_type), intent(in) :: answer
    type(quantity_type), allocatable :: list(:)

    call add_quantity(list, number_quantity('external_work', answer%external_work, 'J', &
      'of the load, since the start'))
    call add_quantity(list, number_quantity('strain_energy', answer%strain_energy, 'J', &
      'in the foil'))
    call add_quantity(list, number_quantity('penalty_energy', answer%penalty_energy, 'J', &
      'in the penetrations'))
    call add_quantity(list, number_quantity('friction_work', answer%friction_work, 'J', &
      'done against friction, since the start'))
  end function energy_quantities

  !> The summary: what holds at the full load, and what the cycle cost.
  function answer_quantities(full, last, plates, converged) result(list)
    type(strip_answer_type), intent(in) :: full !! at the full load, or the largest reached
    type(strip_answer_type), intent(in) :: last !! of the last step
    logical, intent(in) :: plates, converged
    type(quantity_type), allocatable :: list(:)
    real(wp) :: largest

    largest = maxval(full%deflection)
    if (plates) largest = full%travel
    call add_quantity(list, word_quantity('analysis', 'strip', 'kind of analysis'))
    call add_quantity(list, truth_quantity('converged', converged, 'whether the answer was found'))
    call add_quantity(list, crest_quantities(full))
    call add_quantity(list, number_quantity('maximum_deflection', largest, 'm', &
      trim(merge('travel of the plate     ', 'largest crest deflection', plates))))
    call add_quantity(list, number_quantity('maximum_force', full%force, 'N', &
      'force on all crests'))
    if (largest > 0.0_wp) then
      call add_quantity(list, number_quantity('loading_stiffness', full%force/largest, 'N/m', &
        'maximum force over maximum deflection'))
    end if
    if (full%round_off > told_round_off) then
      call add_quantity(list, number_quantity('deflection_round_off', full%round_off, '1', &
                                    'relative error of deflections that round-off leaves, about'))
    end if
    if (converged .and. full%factor > last%factor) then
      call add_quantity(list, number_quantity('dissipated_energy', last%external_work, 'J', &
        'work of the load over the cycle'))
    end if
  end function answer_quantities

  !> Heads of the table of steps.
  subroutine show_step_header(log)
    type(run_log_type), intent(in) :: log
    call log%line('   step   force [N]  largest deflection [um]   sleeve open/stick/slip   '// &
                  'top open/stick/slip  Newton  factors')
  end subroutine show_step_header

  !> A line of the table of steps.
  subroutine show_step(log, answer, step, newton_iterations, factorizations)
    type(run_log_type), intent(in) :: log
    type(strip_answer_type), intent(in) :: answer
    integer, intent(in) :: step, newton_iterations, factorizations
    character(len=160) :: line

    write (line, '(i7, f12.4, f25.5, 2x, 3i8, 2x, 3i7, i8, i9)') step, answer%force, &
      max(answer%travel, maxval(answer%deflection))*micrometres, answer%count(:, 1), &
      answer%count(:, 2), &
      newton_iterations, factorizations
    call log%line(trim(line))
  end subroutine show_step

  !> Quantities of what it cost.
  function cost_quantities(scene, strip, newton, start_time) result(list)
    type(scene_type), intent(in) :: scene
    type(strip_system_type), intent(in) :: strip
    type(newton_type), intent(in) :: newton
    real(wp), intent(in) :: start_time !! [s]
    type(quantity_type), allocatable :: list(:)
    real(wp) :: memory(1)
    integer :: stations, rows

    stations = strip%foil%mesh%stations
    rows = scene%mesh%axial_elements + 1
    memory = sum_over_ranks([peak_memory()])
    call add_quantity(list, count_quantity('unknowns', strip%unknowns, 'unknowns of the equations'))
    call add_quantity(list, count_quantity('foil_unknowns_full', node_unknowns*stations*rows, &
      'of the bump foil, whole width, before constraints'))
    call add_quantity(list, count_quantity('foil_unknowns_retained', &
      node_unknowns*(size(strip%foil%substructure) + 1)*rows, &
      'of its retained lines, whole width, before constraints'))
    call add_quantity(list, count_quantity('distinct_super_elements', &
      kind_count(strip%foil%substructure), 'condensed once each'))
    call add_quantity(list, count_quantity('newton_iterations', newton%iterations, &
      'of all load steps'))
    call add_quantity(list, count_quantity('factorizations', newton%factorizations, &
      'of all load steps'))
    call add_quantity(list, number_quantity('wall_time', wall_time() - start_time, 's', &
      'from start to answer'))
    call add_quantity(list, number_quantity('peak_memory', memory(1), 'B', &
      'sum over ranks of the largest held'))
  end function cost_quantities
end module gfb_strip_summary
