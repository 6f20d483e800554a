!> All equilibria of a bearing that can be found, from a set of starts, side by side.
module gfb_branches_study
  use gfb_kinds, only: wp
  use gfb_errors, only: error_type
  use gfb_quantity, only: quantity_type
  use gfb_run_log, only: run_log_type
  use gfb_scene, only: scene_type
  use gfb_bearing_system, only: bearing_system_type
  use gfb_scene_point, only: operating_point
  use gfb_mesh_plan, only: bearing_plan_type
  use gfb_newton, only: newton_type, newton_settings_type, work_bound_type, destroy_newton
  use gfb_continuation, only: path_settings_type, path_report_type
  use gfb_cold_start, only: start_bearing
  use gfb_start_problem, only: start_problem_type
  use gfb_start_list, only: soft_starts_of, start_name, try_start
  use gfb_branch_list, only: branch_search_type, destroy_branches
  use gfb_branch_search, only: find_branches
  use gfb_bearing_plan, only: plan_bearing
  use gfb_reasons, only: reason_no_equilibrium
  use gfb_run_context, only: run_context_type
  use gfb_study, only: study_type
  use gfb_branches_writing, only: write_branches
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
    procedure :: prepare => prepare_search
    procedure :: solve => solve_study
    procedure :: write => write_study
    procedure :: discard => discard_search
  end type branches_study_type

contains

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

    associate (solver => scene%solver)
      settings = path_settings_type(solver%maximum_load_steps, solver%smallest_load_step, solver%touch_down_gap)
      tolerances = newton_settings_type(solver%residual_tolerance, solver%step_tolerance, solver%maximum_iterations)
      tolerances%bound => self%bound
      call self%bound%begin(solver%maximum_factorizations)
      call start_bearing(searched(scene), self%plan, operating_point(scene%operation), tolerances, settings, context%log, &
                         self%bearing, self%newton, report, error)
      call self%bound%lift()
    end associate
    if (allocated(error)) return
    self%search%lifts = [lowest_lift, highest_lift]*self%bearing%pad(1)%film%clearance
    if (report%converged()) then
      call find_branches(self%bearing, self%newton, self%search)
    else
      call context%log%line('no equilibrium from the usual starts: '//report%reason())
    end if
    call search_from_starts(self, searched(scene), settings, context%log)
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
    problem = start_problem_type(scene, operating_point(scene%operation), quick, self%bearing, self%newton)
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
