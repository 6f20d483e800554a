!> A strip's answer as results, and how the log shows it.
module gfb_strip_summary
  use gfb_kinds, only: wp
  use gfb_units, only: micrometres
  use gfb_fixed_lines, only: fixed_line_corner
  use gfb_text, only: text
  use gfb_run_log, only: run_log_type
  use gfb_scene, only: scene_type
  use gfb_foil_cases, only: bump_foil_case_type, fixed_edge_none, fixed_edge_trailing, has_sizes, &
                            one_bump, one_strip, solid_width, strips_differ
  use gfb_strip_load_case, only: crest_forces, load_plates, bump_stiffness
  use gfb_bump_chain, only: bump_chain_type, bump_chain_solution_type, solve_bump_chain
  use gfb_curved_bump, only: curved_bump_stiffness
  use gfb_case_file, only: case_array_type, add_array, history_row_type, visit_rows
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
  use gfb_strip_system, only: strip_system_type
  implicit none (type, external)
  private
  public :: strip_companions, show_companions, add_companions, visit_run, step_quantities, &
            answer_quantities, cost_quantities, show_step, show_step_header

  integer, parameter :: longest_chain = 60 !! bumps; longer ones can take seconds

  !> Deflections at the full load, [m].
  type :: companions_type
    real(wp), allocatable :: walowit_anno(:) !! (bumps), single bumps without friction
    real(wp), allocatable :: curved_bump(:)  !! (bumps), exact single bumps, feet rub on the sleeve
    real(wp), allocatable :: chain(:)        !! (bumps), planar chain; empty where there is none
    logical :: chain_lifts = .false.         !! it holds corners down that would lift
  end type companions_type

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

  !> Computes them for the forces on the crests; a plate's force is shared evenly, as single bumps
  !> do.
  function strip_companions(scene, force) result(companions)
    type(scene_type), intent(in) :: scene !! what is asked for
    real(wp), intent(in) :: force !! on all crests at the full load [N]
    type(companions_type) :: companions
    type(bump_foil_case_type), allocatable :: one(:)
    real(wp) :: crest_force(scene%bump_foil%bumps), soft(scene%bump_foil%bumps), &
                exact(scene%bump_foil%bumps) !! forces, stiffnesses by two formulas [N], [N/m]
    integer :: bump, strip

    associate (foil => scene%bump_foil)
      if (scene%strip_load%kind == load_plates) then
        crest_force = force/foil%bumps
      else
        crest_force = crest_forces(scene%strip_load, foil)
      end if
      soft = 0.0_wp
      exact = 0.0_wp
      do strip = 1, merge(foil%strips, 1, strips_differ(foil)) ! side by side, under one plate
        one = one_bump(foil, [(bump, bump=1, foil%bumps)])
        if (strips_differ(foil)) one = one_bump(one_strip(foil, strip), &
                                                [(bump, bump=1, foil%bumps)])
        soft = soft + bump_stiffness(one)*one%pitch%value*solid_width(one)
        exact = exact + curved_bump_stiffness(one%youngs_modulus, one%poissons_ratio, &
                                              one%thickness%value, one%half_length%value, &
                                              one%height%value, solid_width(one), &
                                              scene%contact%friction_sleeve)
      end do
    end associate
    companions%walowit_anno = crest_force/soft
    companions%curved_bump = crest_force/exact
    call solve_chain(scene, crest_force, companions)
  end function strip_companions

  !> The planar chain, where it models the strip: crests with given forces, a bump at the fixed
  !> edge.
  subroutine solve_chain(scene, crest_force, companions)
    type(scene_type), intent(in) :: scene
    real(wp), intent(in) :: crest_force(:) !! [N]
    type(companions_type), intent(inout) :: companions
    type(bump_chain_type) :: chain
    type(bump_chain_solution_type) :: solution
    logical :: mirrored

    allocate (companions%chain(0))
    associate (foil => scene%bump_foil, contact => scene%contact)
      if (foil%bumps > longest_chain .or. scene%strip_load%kind == load_plates) return
      if (has_sizes(foil) .or. strips_differ(foil)) return ! its bumps are alike
      if (foil%fixed_edge /= fixed_edge_none .and. foil%fixed_line /= fixed_line_corner) return
      mirrored = foil%fixed_edge == fixed_edge_trailing
      chain = bump_chain_type(foil%half_length%value, foil%height%value, foil%thickness%value, &
                              foil%youngs_modulus, foil%poissons_ratio, foil%pitch%value, &
                              solid_width(foil), foil%bumps, foil%fixed_edge /= fixed_edge_none, &
                              contact%friction_top, contact%friction_sleeve)
    end associate
    if (mirrored) then
      call solve_bump_chain(chain, crest_force(size(crest_force):1:-1), solution)
      solution%crest_deflection = solution%crest_deflection(size(crest_force):1:-1)
    else
      call solve_bump_chain(chain, crest_force, solution)
    end if
    if (.not. solution%converged) return
    companions%chain = solution%crest_deflection
    companions%chain_lifts = solution%lifted
  end subroutine solve_chain

  !> A table of the crests: shells, chain, single bumps.
  subroutine show_companions(log, deflection, companions)
    type(run_log_type), intent(in) :: log !! where lines go
    real(wp), intent(in) :: deflection(:) !! of the shells' crests [m]
    type(companions_type), intent(in) :: companions !! deflections by formulas
    character(len=80) :: line
    integer :: bump

    call log%line('deflection [um]   shells   planar chain   curved bump   Walowit-Anno')
    do bump = 1, size(deflection)
      if (size(companions%chain) > 0) then
        write (line, '(a, i4, 4x, f12.4, f15.4, f14.4, f15.4)') 'crest', bump, &
          micrometres*[deflection(bump), companions%chain(bump), companions%curved_bump(bump), &
                       companions%walowit_anno(bump)]
      else
        write (line, '(a, i4, 4x, f12.4, a15, f14.4, f15.4)') 'crest', bump, &
          micrometres*deflection(bump), '-', &
          micrometres*[companions%curved_bump(bump), companions%walowit_anno(bump)]
      end if
      call log%line(trim(line))
    end do
    if (companions%chain_lifts) then
      call log%line('the planar chain holds down corners that would lift')
    end if
  end subroutine show_companions

  !> The same for the result file.
  subroutine add_companions(companions, arrays)
    type(companions_type), intent(in) :: companions !! deflections by formulas
    type(case_array_type), allocatable, intent(inout) :: arrays(:) !! of the file

    call add('walowit_anno', 'deflection of single bumps without friction', companions%walowit_anno)
    call add('curved_bump', 'deflection of exact single bumps, feet rubbing', &
             companions%curved_bump)
    if (size(companions%chain) > 0) then
      call add('planar_chain', 'deflection of a planar chain of bumps', companions%chain)
    end if

  contains

    !> One number a bump.
    subroutine add(name, meaning, values)
      character(len=*), intent(in) :: name, meaning
      real(wp), intent(in) :: values(:) !! [m]
      call add_array(arrays, '/companions/'//name, 'm', meaning, reshape(values, [size(values), 1]))
    end subroutine add
  end subroutine add_companions

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
