!> All equilibria of a bearing that can be found, from a set of starts, side by side.
module gfb_branch_analysis
  use gfb_kinds, only: wp
  use gfb_errors, only: error_type, fail
  use gfb_memory_check, only: check_memory
  use gfb_text, only: text
  use gfb_run_log, only: run_log_type
  use gfb_quantity, only: quantity_type, add_quantity
  use gfb_results, only: add_result
  use gfb_scene, only: scene_type
  use gfb_scene_case, only: analysis_equilibrium
  use gfb_model_case, only: meshes_foils
  use gfb_petsc_session, only: wall_time
  use gfb_cost_events, only: enter_stage, leave_stage
  use gfb_operating_point, only: operating_point_type
  use gfb_bearing_system, only: bearing_system_type
  use gfb_bearing_builder, only: bearing_plan_type, operating_point
  use gfb_bearing_answer, only: bearing_answer_type, bearing_answer
  use gfb_newton, only: newton_type, newton_settings_type, destroy_newton
  use gfb_continuation, only: path_settings_type, path_report_type
  use gfb_cold_start, only: start_bearing
  use gfb_contact_start, only: try_start, start_count
  use gfb_branch_search, only: branch_search_type, find_branches, take_branch, destroy_branches
  use gfb_bearing_plan, only: plan_bearing
  use gfb_bearing_record, only: bearing_record_type, add_row, analysis_name
  use gfb_answer_judgement, only: judge_answer
  use gfb_bearing_summary, only: cost_type, answer_quantities, cost_quantities
  use gfb_result_set, only: result_grid_type, write_result_set
  use gfb_film_grid, only: add_film_grid
  use gfb_foil_output, only: add_foil_grids
  use gfb_contact_record, only: foil_contact_arrays
  use gfb_provenance, only: provenance
  use gfb_c_library, only: peak_memory
  implicit none (type, external)
  private
  public :: run_branches

  real(wp), parameter :: lowest_lift = -0.25_wp !! that is looked at, over the clearance [1]
  real(wp), parameter :: highest_lift = 3.0_wp
  real(wp), parameter :: micrometres = 1.0e6_wp !! in a metre
  character(len=*), parameter :: ending = '.branches' !! of the results' names

contains

  !> Looks for equilibria and writes what was found.
  !>
  !> `converged` is false where there is none. Fails for scenes without foils that can lift, and when a
  !> file cannot be written.
  subroutine run_branches(scene, folder, command, start_time, log, converged, error)
    type(scene_type), intent(in) :: scene
    character(len=*), intent(in) :: folder  !! where the results go
    character(len=*), intent(in) :: command !! the whole command line
    real(wp), intent(in) :: start_time      !! of the run [s]
    type(run_log_type), intent(in) :: log
    logical, intent(out) :: converged
    type(error_type), allocatable, intent(out) :: error

    type(scene_type) :: searched
    type(bearing_plan_type) :: plan
    type(bearing_system_type), target :: bearing
    type(newton_type), target :: newton
    type(branch_search_type) :: search

    converged = .false.
    if (scene%general%analysis /= analysis_equilibrium .or. .not. meshes_foils(scene%model%foil)) then
      call fail(error, scene%file//": --branches needs analysis = 'equilibrium' and foil = 'shell' or 'beam'")
      return
    end if
    searched = scene
    searched%name = scene%name//ending
    searched%sweep%present = .false. ! its points are not looked at
    searched%solver%stability = .true.
    call plan_bearing(searched, log, plan)
    call check_memory(searched, plan%memory, error)
    if (allocated(error)) return
    call log%heading('search for equilibria')
    call search_from_starts(searched, plan, log, bearing, newton, search, error)
    if (allocated(error)) return
    converged = allocated(search%branch)
    if (converged) call write_branches(searched, folder, command, start_time, log, bearing, newton, search, error)
    call destroy_branches(search)
    call destroy_newton(newton)
    call bearing%destroy()
  end subroutine run_branches

  !> From the first answer, and from those of the other starts that are new.
  subroutine search_from_starts(scene, plan, log, bearing, newton, search, error)
    type(scene_type), intent(in) :: scene
    type(bearing_plan_type), intent(in) :: plan
    type(run_log_type), intent(in) :: log
    type(bearing_system_type), target, intent(inout) :: bearing
    type(newton_type), target, intent(inout) :: newton
    type(branch_search_type), intent(inout) :: search
    type(error_type), allocatable, intent(out) :: error

    type(operating_point_type) :: target
    type(path_settings_type) :: settings
    type(path_report_type) :: report
    integer :: attempt

    target = operating_point(scene%operation)
    settings = path_settings_type(scene%solver%maximum_load_steps, scene%solver%smallest_load_step, &
                                  scene%solver%touch_down_gap)
    call start_bearing(scene, plan, target, newton_settings_type(scene%solver%residual_tolerance, &
                                                                 scene%solver%step_tolerance, &
                                                                 scene%solver%maximum_iterations), &
                       settings, log, bearing, newton, report, error)
    if (allocated(error)) return
    search%lifts = [lowest_lift, highest_lift]*bearing%film%clearance
    if (report%converged) then
      call find_branches(bearing, newton, search)
    else
      call log%line('no equilibrium from the usual starts: '//report%reason)
    end if
    settings%look_for_folds = .false.
    settings%smallest_step = max(settings%smallest_step, 0.01_wp)
    do attempt = 1, start_count
      call log%line('start '//text(attempt)//' of '//text(start_count)//':')
      call try_start(scene, target, settings, attempt, bearing, newton, report)
      if (report%converged) then
        call find_branches(bearing, newton, search)
      else
        call log%line('no equilibrium from this start')
      end if
    end do
  end subroutine search_from_starts

  !> Table, history and surfaces of the equilibria, by rising lift.
  subroutine write_branches(scene, folder, command, start_time, log, bearing, newton, search, error)
    type(scene_type), intent(in) :: scene
    character(len=*), intent(in) :: folder, command
    real(wp), intent(in) :: start_time
    type(run_log_type), intent(in) :: log
    type(bearing_system_type), target, intent(inout) :: bearing
    type(newton_type), target, intent(inout) :: newton
    type(branch_search_type), intent(in) :: search
    type(error_type), allocatable, intent(out) :: error

    type(bearing_record_type) :: record
    type(result_grid_type), allocatable :: grids(:)
    type(quantity_type), allocatable :: summary(:)
    integer, allocatable :: order(:)
    integer :: i, k, first

    call enter_stage('output')
    order = by_lift(search)
    allocate (grids(0))
    do i = 1, size(order)
      call take_branch(bearing, operating_point(scene%operation), search%branch(order(i)))
      call judge_answer(scene, log, bearing, newton, record%judged)
      call add_row(scene, bearing, newton, .true., record, branch=i)
      first = size(grids) + 1
      call add_film_grid(bearing, scene%output, grids)
      call add_foil_grids(bearing, grids)
      do k = first, size(grids)
        grids(k)%name = text(i)//'.'//grids(k)%name
      end do
    end do
    call show_table(log, search, order, record, bearing%film%clearance)
    call take_branch(bearing, operating_point(scene%operation), search%branch(order(1)))
    call add_quantity(summary, answer_quantities(analysis_name(scene), .true., search%branch(order(1))%answer, &
      bearing%film%clearance, bearing%force_scale()))
    call add_result(summary, 'branches', size(order))
    call add_quantity(summary, bearing%foil%sizes())
    call add_quantity(summary, cost_quantities(cost_type(bearing%unknowns, newton%iterations, &
      newton%factorizations, wall_time() - start_time, peak_memory())))
    call write_result_set(scene, folder, .true., provenance(command), summary, record%history, &
                          foil_contact_arrays(bearing%foil, record%contacts, size(record%history)), grids, log, error)
    call leave_stage()
  end subroutine write_branches

  !> The equilibria side by side, and how to start on one.
  subroutine show_table(log, search, order, record, clearance)
    type(run_log_type), intent(in) :: log
    type(branch_search_type), intent(in) :: search
    integer, intent(in) :: order(:)
    type(bearing_record_type), intent(in) :: record
    real(wp), intent(in) :: clearance !! C [m]
    character(len=160) :: line
    integer :: i

    call log%heading('equilibria')
    call log%line('      e_x/C     e_y/C   leading edge [um]  trailing edge [um]  crests  film [um]  growing  nearest')
    call log%line('                        midplane    ends    midplane    ends    open %  smallest   modes  to change')
    do i = 1, size(order)
      associate (answer => search%branch(order(i))%answer)
        write (line, '(i3, 2f10.5, f11.2, f8.2, f12.2, f8.2, f10.1, f10.3, a9, a11)') i, answer%eccentricity/clearance, &
          micrometres*answer%leading_edge_lift, micrometres*answer%trailing_edge_lift, 100.0_wp*answer%lifted_length, &
          micrometres*answer%minimum_gap, value_of(record%history(i)%quantity, 'stability'), &
          value_of(record%history(i)%quantity, 'stability_margin')
      end associate
      call log%line(trim(line))
    end do
    call log%line('To start on one: leading_edge_lift and leading_edge_lift_edge in &operation, as above, in m.')
    call log%line('Other equilibria may exist; these were met from the starts, and by pulling the free edge from them.')
  end subroutine show_table

  !> A quantity of a row, in few digits; a dash where it is not known.
  pure function value_of(list, name) result(words)
    type(quantity_type), intent(in) :: list(:)
    character(len=*), intent(in) :: name
    character(len=:), allocatable :: words
    integer :: i

    words = '-'
    do i = 1, size(list)
      if (list(i)%name == name) words = text(list(i)%number, 3)
    end do
  end function value_of

  !> Numbers of the equilibria by rising lift of both ends of the top foil, midplane and edges.
  pure function by_lift(search) result(order)
    type(branch_search_type), intent(in) :: search
    integer, allocatable :: order(:)
    real(wp) :: lift(size(search%branch))
    integer :: i

    do i = 1, size(lift)
      associate (answer => search%branch(i)%answer)
        lift(i) = sum(answer%leading_edge_lift + answer%trailing_edge_lift)
      end associate
    end do
    allocate (order(size(lift)))
    do i = 1, size(lift)
      order(i) = minloc(lift, 1)
      lift(order(i)) = huge(1.0_wp)
    end do
  end function by_lift
end module gfb_branch_analysis
