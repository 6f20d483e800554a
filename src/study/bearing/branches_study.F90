!> All equilibria of a bearing that can be found, from a set of starts, side by side.
module gfb_branches_study
  use gfb_kinds, only: wp
  use gfb_units, only: micrometres
  use gfb_errors, only: error_type
  use gfb_text, only: text
  use gfb_run_log, only: run_log_type
  use gfb_quantity, only: quantity_type, add_quantity, place_of, number_in
  use gfb_result_names, only: add_result
  use gfb_c_library, only: peak_memory
  use gfb_scene, only: scene_type
  use gfb_petsc_session, only: wall_time
  use gfb_bearing_system, only: bearing_system_type
  use gfb_scene_point, only: operating_point
  use gfb_newton, only: newton_type, newton_settings_type, work_bound_type, destroy_newton
  use gfb_branch_search, only: branch_search_type, take_branch, lifts_of_pads, destroy_branches, find_branches
  use gfb_bearing_record, only: bearing_record_type, add_row
  use gfb_bearing_summary, only: cost_type, answer_quantities, cost_quantities
  use gfb_result_set, only: result_grid_type, write_result_set
  use gfb_film_grid, only: add_film_grid
  use gfb_foil_grid, only: add_foil_grids
  use gfb_case_file, only: case_array_type
  use gfb_contact_record, only: add_foil_contacts
  use gfb_run_context, only: run_context_type
  use gfb_answer_judgement, only: judge_answer
  use gfb_mesh_plan, only: bearing_plan_type
  use gfb_continuation, only: path_settings_type, path_report_type
  use gfb_cold_start, only: start_bearing
  use gfb_start_problem, only: start_problem_type, search_request_type
  use gfb_start_list, only: soft_starts_of, start_name, try_start
  use gfb_bearing_plan, only: plan_bearing
  use gfb_outcome, only: add_outcome
  use gfb_reasons, only: reason_no_equilibrium
  use gfb_study, only: study_type
  implicit none (type, external)
  private

  real(wp), parameter :: lowest_lift = -0.25_wp !! that is looked at, over the clearance [1]
  real(wp), parameter :: highest_lift = 3.0_wp
  character(len=*), parameter :: ending = '.branches' !! of the results' names

  !> The bearing, and its equilibria.
  type, extends(study_type), public :: branches_study_type
    private
    type(bearing_plan_type) :: plan
    type(bearing_system_type) :: bearing
    type(newton_type) :: newton
    type(work_bound_type) :: bound !! of the first search
    type(branch_search_type) :: search
  contains
    procedure :: prepare => prepare_search, solve => solve_study, write => write_study
    procedure :: discard => discard_search
  end type branches_study_type

contains

  !> Table, history and surfaces of the equilibria, by rising lift.
  !>
  !> Fails when a file cannot be written.
  subroutine write_branches(scene, context, search, bearing, newton, summary, error)
    type(scene_type), intent(in) :: scene !! what is asked for
    type(run_context_type), intent(in) :: context !! of the run
    type(branch_search_type), intent(in) :: search !! with one equilibrium at least
    type(bearing_system_type), target, intent(inout) :: bearing !! whose equilibria they are
    type(newton_type), target, intent(inout) :: newton !! its solver
    type(quantity_type), allocatable, intent(out) :: summary(:) !! what the summary says
    type(error_type), allocatable, intent(out) :: error !! why it failed

    type(bearing_record_type) :: record
    type(case_array_type), allocatable :: arrays(:)
    type(result_grid_type), allocatable :: grids(:)
    integer, allocatable :: order(:)

    order = by_lift(search)
    call record_branches(scene, context%log, search, order, bearing, newton, record, grids)
    call show_table(context%log, search, order, record, bearing%clearance)
    call take_branch(bearing, operating_point(scene%operation), search%branch(order(1)))
    call add_quantity(summary, answer_quantities(trim(scene%general%asked%word), .true., search%branch(order(1))%answer, &
                                                 bearing%clearance, bearing%force_scale()))
    call add_result(summary, 'branches', size(order))
    call add_quantity(summary, bearing%pad(1)%foil%sizes())
    call add_quantity(summary, cost_quantities(cost_type( &
                      bearing%unknowns, newton%iterations, newton%factorizations, &
                      newton%factorizations - newton%factorizations_before, &
                      wall_time() - context%start_time, peak_memory())))
    allocate (arrays(0))
    call add_foil_contacts(bearing, record%contacts, size(record%history), arrays)
    call add_outcome(summary, .true.)
    call write_result_set(scene, context%folder, .true., context%origin(), summary, record%history, arrays, grids, context%csv, &
                          context%log, error)
  end subroutine write_branches

  !> A row and the surfaces of every equilibrium.
  subroutine record_branches(scene, log, search, order, bearing, newton, record, grids)
    type(scene_type), intent(in) :: scene
    type(run_log_type), intent(in) :: log
    type(branch_search_type), intent(in) :: search
    integer, intent(in) :: order(:)
    type(bearing_system_type), target, intent(inout) :: bearing
    type(newton_type), target, intent(inout) :: newton
    type(bearing_record_type), intent(out) :: record
    type(result_grid_type), allocatable, intent(out) :: grids(:)
    integer :: i, k, first

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
  end subroutine record_branches

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
        write (line, '(i3, 2f10.5, f11.2, f8.2, f12.2, f8.2, f10.1, f10.3, a9, a11)') i, answer%place(:2)/clearance, &
          micrometres*answer%leading_edge_lift, micrometres*answer%trailing_edge_lift, 100.0_wp*answer%lifted_length, &
          micrometres*answer%minimum_gap, value_of(record%history(i)%quantity, 'stability'), &
          value_of(record%history(i)%quantity, 'stability_margin')
      end associate
      call log%line(trim(line)//lifts_of_pads(search%branch(order(i))%answer%pad_lift))
    end do
    if (size(search%branch(1)%answer%pad_lift, 2) == 1) then
      call log%line('To start on one: leading_edge_lift and leading_edge_lift_edge in &operation, as above, in m.')
    else
      call log%line('To start on one: leading_edge_lift in &operation, with the lifts of the pads as above, in m; '// &
                    'leading_edge_lift_edge with those in brackets, at the ends.')
    end if
    call log%line('Other equilibria may exist; these were met from the starts, and by pulling the free edge from them.')
  end subroutine show_table

  !> A quantity of a row, in few digits; a dash where it is not known.
  pure function value_of(list, name) result(words)
    type(quantity_type), intent(in) :: list(:)
    character(len=*), intent(in) :: name
    character(len=:), allocatable :: words

    words = '-'
    if (place_of(name, list) > 0) words = text(number_in(list, name), 3)
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

  !> The scene as it is searched: its sweep's points are not looked at.
  pure function searched(scene)
    type(scene_type), intent(in) :: scene
    type(scene_type) :: searched

    searched = scene
    searched%name = scene%name//ending
    searched%sweep%present = .false.
    searched%solver%stability = .true.
  end function searched

  !> Plans the bearing.
  subroutine prepare_search(self, scene, log)
    class(branches_study_type), intent(inout) :: self !! the study
    type(scene_type), intent(in) :: scene !! what is asked for
    type(run_log_type), intent(in) :: log !! where lines go

    self%heading = 'search for equilibria'
    call plan_bearing(searched(scene), log, self%plan)
    self%memory = self%plan%memory
  end subroutine prepare_search

  !> Looks for equilibria.
  !>
  !> Fails when the mesh cannot be cut.
  subroutine solve_study(self, scene, context, error)
    class(branches_study_type), target, intent(inout) :: self !! the study
    type(scene_type), intent(in) :: scene !! what is asked for
    type(run_context_type), intent(in) :: context !! of the run
    type(error_type), allocatable, intent(out) :: error !! why it failed
    type(path_settings_type) :: settings
    type(newton_settings_type) :: tolerances
    type(path_report_type) :: report
    type(scene_type), allocatable, target :: own

    own = searched(scene)
    associate (solver => scene%solver)
      settings = path_settings_type(solver%maximum_load_steps, solver%smallest_load_step, solver%touch_down_gap)
      tolerances = newton_settings_type(solver%residual_tolerance, solver%step_tolerance, solver%maximum_iterations)
      tolerances%bound => self%bound
      call start_bearing(search_request_type(own, self%plan, operating_point(scene%operation), tolerances, settings, context%log), &
                         self%bearing, self%newton, report, error)
    end associate
    if (allocated(error)) return
    self%search%lifts = [lowest_lift, highest_lift]*self%bearing%clearance
    if (report%converged()) then
      call find_branches(self%bearing, self%newton, self%search)
    else
      call context%log%line('no equilibrium from the usual starts: '//report%reason())
    end if
    ! The other starts are those of a film without heat.
    if (.not. scene%thermal%present) call search_from_starts(self, own, settings, context%log)
    self%converged = allocated(self%search%branch)
    if (.not. self%converged) self%reason%code = reason_no_equilibrium
    self%unknowns = self%bearing%unknowns
    self%iterations = self%newton%iterations
    self%factorizations = self%newton%factorizations
    self%factorizations_finest = self%factorizations - self%newton%factorizations_before
  end subroutine solve_study

  !> From the answers of all other starts that are new.
  subroutine search_from_starts(self, scene, settings, log)
    class(branches_study_type), target, intent(inout) :: self !! the study
    type(scene_type), target, intent(in) :: scene
    type(path_settings_type), intent(in) :: settings !! of the first start
    type(run_log_type), intent(in) :: log
    type(path_settings_type) :: quick
    type(path_report_type) :: report
    type(start_problem_type) :: problem
    integer, allocatable :: starts(:)
    logical :: ends
    integer :: i

    quick = settings
    quick%look_for_folds = .false.
    quick%smallest_step = max(quick%smallest_step, 0.01_wp)
    problem = start_problem_type(scene=scene, target=operating_point(scene%operation), settings=quick, bearing=self%bearing, &
                                 newton=self%newton)
    starts = soft_starts_of(problem) ! the others follow from these
    do i = 1, size(starts)
      call log%stage('start "'//start_name(starts(i))//'":')
      call try_start(starts(i), problem, report, ends)
      if (report%converged()) then
        call find_branches(self%bearing, self%newton, self%search)
      else
        call log%line('no equilibrium from this start')
      end if
    end do
  end subroutine search_from_starts

  !> Writes the result files; none where there is no equilibrium.
  !>
  !> Fails when one cannot be written.
  subroutine write_study(self, scene, context, summary, error)
    class(branches_study_type), target, intent(inout) :: self !! the study
    type(scene_type), intent(in) :: scene !! what is asked for
    type(run_context_type), intent(in) :: context !! of the run
    type(quantity_type), allocatable, intent(out) :: summary(:) !! what the summary says
    type(error_type), allocatable, intent(out) :: error !! why it failed

    if (.not. self%converged) return
    call write_branches(searched(scene), context, self%search, self%bearing, self%newton, summary, error)
  end subroutine write_study

  !> Frees what the solvers hold.
  subroutine discard_search(self)
    class(branches_study_type), intent(inout) :: self !! the study

    call destroy_branches(self%search)
    call destroy_newton(self%newton)
    call self%bearing%destroy()
  end subroutine discard_search
end module gfb_branches_study
