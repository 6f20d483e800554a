#include "gfb_petsc.h"
!> The first answer of a scene, from nothing.
!>
!> A scene is solved on a smaller system first, as `smaller_scene.F90` finds it. The larger one starts from
!> its answer, and from nothing only if that fails: `start_list.F90` has all starts, in order.
module gfb_cold_start
  use gfb_kinds, only: wp
  use gfb_errors, only: error_type
  use gfb_text, only: text
  use gfb_work_bound, only: gives_up
  use gfb_run_log, only: run_log_type
  use gfb_scene, only: scene_type
  use gfb_operating_point, only: operating_point_type
  use gfb_bearing_system, only: bearing_system_type
  use gfb_pad_contacts, only: set_upwind
  use gfb_mesh_plan, only: bearing_plan_type
  use gfb_bearing_builder, only: build_bearing
  use gfb_newton, only: newton_type, newton_settings_type, create_newton, destroy_newton
  use gfb_continuation, only: path_settings_type, path_report_type, follow_path
  use gfb_start_problem, only: start_problem_type, drop_bearing, count_spent
  use gfb_kept_state, only: kept_state_type
  use gfb_start_list, only: start_pressed
  use gfb_branch_search, only: seek_branch
  use gfb_smaller_scene, only: find_smaller, find_between, lies_between
  use gfb_bearing_directions, only: has_free_edge
  use gfb_answer_transfer, only: transfer_answer
  use gfb_partitioned, only: partitioned_type, create_partitioned, follow_partitioned
  use gfb_model_case, only: foil_rigid, foil_shell
  implicit none (type)
  private
  public :: start_bearing, restart_bearing, start_partitioned

  integer, parameter :: points_on_the_way = 5
  !> loads of a lighter start, and on the way up from there, over the one asked for [1]
  real(wp), parameter :: light(points_on_the_way) = [0.1_wp, 0.25_wp, 0.5_wp, 0.75_wp, 1.0_wp]
  !> speeds of a faster start, and on the way down from there, over the one asked for [1]
  real(wp), parameter :: fast(points_on_the_way) = [2.0_wp, 1.6_wp, 1.3_wp, 1.15_wp, 1.0_wp]
  real(wp), parameter :: shortest = 0.02_wp !! step on the way [1]
  real(wp), parameter :: worthwhile = 0.2_wp !! nodes of a smaller system that goes first, over the scene's [1]

contains

  !> Builds a scene's equations and finds their answer at the scene's operating point.
  !>
  !> Where a search ends, it may be the end of the branch on which it came under the load, not of all: it has to show on the
  !> way up from a lighter load, too, where that has an answer; a tenth of what is far too heavy has none. Where no reason is
  !> found, or a film draws up the free edge of shells, which is kept straight while that is looked into, it has to show on the way
  !> down from a faster shaft, too. A reason that was found stands where the smallest system has none of these ways.
  !>
  !> Fails when the mesh cannot be cut; a scene without an answer is a report, not an error.
  subroutine start_bearing(scene, plan, target, newton_settings, path_settings, log, bearing, newton, report, error)
    type(scene_type), target, intent(in) :: scene !! what the case file asks for
    type(bearing_plan_type), intent(in) :: plan          !! its meshes
    type(operating_point_type), intent(in) :: target     !! the scene's, or the first of its sweep
    type(newton_settings_type), intent(in) :: newton_settings !! when Newton's method stops
    type(path_settings_type), intent(in) :: path_settings !! limits of a path
    type(run_log_type), intent(in) :: log !! gets the lines of progress
    type(bearing_system_type), target, intent(inout) :: bearing !! is built
    type(newton_type), target, intent(inout) :: newton          !! its solver, is created
    type(path_report_type), intent(out) :: report        !! of the start that led to the answer, or nearest to one
    type(error_type), allocatable, intent(out) :: error !! why it could not be done
    type(operating_point_type) :: way(points_on_the_way)
    type(path_report_type) :: refusal
    type(kept_state_type) :: refused
    logical :: again

    call start_on_meshes(scene, plan, target, newton_settings, path_settings, log, bearing, newton, report, error)
    if (allocated(error)) return
    if (report%converged .or. .not. bearing%floats .or. scene%operation%asks_for_lift()) return
    if (.not. bearing%pad(1)%foil%has_contacts()) return
    refusal = report
    call refused%keep(bearing)
    again = report%touched .or. .not. (report%drawn .or. report%has_cause())
    if (report%touched) again = norm2(report%reached%load) > light(1)*norm2(target%load)
    if (again) again = .not. gives_up(newton%settings%bound)
    if (again) then
      call log%line('no answer from there ('//report%reason//'); from '//text(100.0_wp*light(1), 2)//' % of the load:')
      way = target
      way%load(1) = light*target%load(1)
      way%load(2) = light*target%load(2)
      call come_along(way, .true.)
      if (allocated(error)) return
      call add_evidence('from '//text(100.0_wp*light(1), 2)//' % of the load up')
    end if
    again = .not. (refusal%drawn .or. refusal%has_cause() .or. report%has_cause())
    again = (again .or. (refusal%drawn .and. scene%model%foil == foil_shell)) .and. .not. report%converged
    if (again) again = has_free_edge(bearing)
    if (again) again = .not. gives_up(newton%settings%bound)
    if (again) then
      call log%line('no answer from there ('//report%reason//'); from '//text(fast(1), 2)//' times the speed:')
      way = target
      way%speed = fast*target%speed
      call come_along(way, .false.)
      if (allocated(error)) return
      call add_evidence('from '//text(fast(1), 2)//' times the speed down')
    end if
    if (.not. report%converged .and. (refusal%has_cause() .or. refusal%drawn .or. .not. report%has_cause())) then
      report = refusal
      call refused%put_back(bearing)
    end if
    call refused%destroy()

  contains

    !> A refusal that names no cause tells what has ended a way to it, where that is one.
    subroutine add_evidence(place)
      character(len=*), intent(in) :: place !! where the way begins

      if (report%converged .or. refusal%tells_why() .or. .not. report%tells_why()) return
      refusal%reason = refusal%reason//'; sought '//place//': '//report%reason
      refusal%names_cause = .true.
    end subroutine add_evidence

    !> From an answer at the first of some points to the last.
    subroutine come_along(way, one_start)
      type(operating_point_type), intent(in) :: way(:)
      logical, intent(in) :: one_start !! to the first point, no more
      integer :: spent(3)

      if (refusal%drawn .or. refusal%has_cause()) then
        if (.not. smallest_comes_along(way, one_start)) return
        if (allocated(error)) return
      end if
      call drop_bearing(bearing, newton, spent)
      call go_along(scene, plan, way, one_start, bearing, newton)
      call count_spent(newton, spent)
    end subroutine come_along

    !> Whether the smallest system does; where that is not much smaller, it is left to the scene's own.
    function smallest_comes_along(way, one_start) result(comes)
      type(operating_point_type), intent(in) :: way(:)
      logical, intent(in) :: one_start
      logical :: comes, has_smaller
      type(bearing_system_type), allocatable, target :: coarse
      type(newton_type), allocatable, target :: coarse_newton
      type(scene_type), allocatable, target :: small, next
      type(bearing_plan_type) :: small_plan, next_plan

      allocate (coarse, coarse_newton, next)
      small = scene
      small_plan = plan
      do
        call find_smaller(small, small_plan, target, has_smaller, next, next_plan)
        if (.not. has_smaller) exit
        small = next
        small_plan = next_plan
      end do
      comes = small_plan%nodes() > worthwhile*plan%nodes()
      if (comes) return
      call go_along(small, small_plan, way, one_start, coarse, coarse_newton)
      if (allocated(error)) return
      comes = report%converged .or. .not. report%has_cause()
      newton%iterations = newton%iterations + coarse_newton%iterations
      newton%factorizations = newton%factorizations + coarse_newton%factorizations
      newton%factorizations_before = newton%factorizations_before + coarse_newton%factorizations
      call drop_bearing(coarse, coarse_newton)
    end function smallest_comes_along

    !> Of one system.
    subroutine go_along(scene, plan, way, one_start, bearing, newton)
      type(scene_type), target, intent(in) :: scene
      type(bearing_plan_type), intent(in) :: plan
      type(operating_point_type), intent(in) :: way(:)
      logical, intent(in) :: one_start
      type(bearing_system_type), target, intent(inout) :: bearing !! is built
      type(newton_type), target, intent(inout) :: newton          !! its solver, is created
      type(path_settings_type) :: settings
      integer :: i

      settings = path_settings
      settings%smallest_step = max(settings%smallest_step, shortest)
      call start_on_meshes(scene, plan, way(1), newton_settings, path_settings, log, bearing, newton, report, error, on_the_way=one_start)
      if (allocated(error)) return
      do i = 2, size(way)
        if (.not. report%converged) exit
        call follow_path(bearing, newton, way(i), 1.0_wp, settings, report)
      end do
    end subroutine go_along
  end subroutine start_bearing

  !> `start_bearing` where there is a bearing already, whose way has ended: it is built anew, and what was spent on it counts.
  !>
  !> Fails when the mesh cannot be cut.
  subroutine restart_bearing(scene, plan, target, newton_settings, path_settings, log, bearing, newton, report, error)
    type(scene_type), target, intent(in) :: scene !! what the case file asks for
    type(bearing_plan_type), intent(in) :: plan          !! its meshes
    type(operating_point_type), intent(in) :: target     !! where the answer is asked for
    type(newton_settings_type), intent(in) :: newton_settings !! when Newton's method stops
    type(path_settings_type), intent(in) :: path_settings !! limits of a path
    type(run_log_type), intent(in) :: log !! gets the lines of progress
    type(bearing_system_type), target, intent(inout) :: bearing !! in: the one before; out: built anew
    type(newton_type), target, intent(inout) :: newton          !! its solver
    type(path_report_type), intent(out) :: report        !! of the start that led to the answer, or nearest to one
    type(error_type), allocatable, intent(out) :: error !! why it could not be done
    integer :: spent(3)

    call drop_bearing(bearing, newton, spent)
    call start_bearing(scene, plan, target, newton_settings, path_settings, log, bearing, newton, report, error)
    call count_spent(newton, spent)
  end subroutine restart_bearing

  !> Builds a scene's equations and finds their answer, on smaller meshes first. Where the answer of one with few rows does not
  !> lead there, one with half the rows is put in between.
  recursive subroutine start_on_meshes(scene, plan, target, newton_settings, path_settings, log, &
                                       bearing, newton, report, error, anchor, on_the_way, known, known_plan)
    type(scene_type), target, intent(in) :: scene !! what the case file asks for
    type(bearing_plan_type), intent(in) :: plan          !! its meshes
    type(operating_point_type), intent(in) :: target     !! the scene's, or the first of its sweep
    type(newton_settings_type), intent(in) :: newton_settings !! when Newton's method stops
    type(path_settings_type), intent(in) :: path_settings !! limits of a path
    type(run_log_type), intent(in) :: log !! gets the lines of progress
    type(bearing_system_type), target, intent(inout) :: bearing !! is built
    type(newton_type), target, intent(inout) :: newton          !! its solver, is created
    type(path_report_type), intent(out) :: report        !! of the start that led to the answer, or nearest to one
    type(error_type), allocatable, intent(out) :: error !! why it could not be done
    type(kept_state_type), intent(out), optional :: anchor !! of a refusal: a state that shows it on a larger system, too
    logical, intent(in), optional :: on_the_way !! the target lies on the way to another one: one start, no more
    type(bearing_system_type), target, intent(in), optional :: known !! a smaller system with its answer
    type(bearing_plan_type), intent(in), optional :: known_plan !! its meshes

    type(bearing_system_type), allocatable, target :: coarse, middle ! not on the stack: a few meshes are open at once
    type(kept_state_type) :: coarse_anchor
    type(newton_type), allocatable, target :: coarse_newton, middle_newton
    type(scene_type), allocatable, target :: small
    type(bearing_plan_type) :: small_plan, middle_plan
    type(start_problem_type), allocatable :: problem
    logical :: has_smaller, helped, between, told, again

    allocate (coarse, middle, coarse_newton, middle_newton, small, problem)
    call build_bearing(scene, plan, bearing, error)
    if (allocated(error)) return
    call create_newton(newton, bearing, 'bearing_', newton_settings, log)
    helped = present(known)
    has_smaller = helped
    if (helped) then
      small_plan = known_plan
    else
      call find_smaller(scene, plan, target, has_smaller, small, small_plan)
    end if
    if (has_smaller .and. .not. helped) then
      call start_on_meshes(small, small_plan, target, newton_settings, path_settings, log, coarse, &
                           coarse_newton, report, error, coarse_anchor, on_the_way)
      if (allocated(error)) return
      if (coarse_anchor%created) call coarse_anchor%put_back(coarse)
      helped = report%converged
      call count_smaller(coarse_newton)
    end if
    call log%stage('film '//text(plan%circumferential)//' x '//text(plan%axial))
    problem%scene => scene
    problem%target = target
    if (present(on_the_way)) problem%on_the_way = on_the_way
    problem%settings = path_settings
    problem%bearing => bearing
    problem%newton => newton
    problem%refused = has_smaller .and. .not. helped .and. bearing%pad(1)%foil%has_contacts()
    if (helped .or. coarse_anchor%created) problem%smaller => coarse
    if (present(known)) problem%smaller => known
    if (problem%refused) problem%refusal = report
    if (helped) problem%carried_only = lies_between(plan, small_plan)
    call start_pressed(problem, report)
    between = problem%carried_only .and. .not. report%converged
    if (between) between = .not. gives_up(newton%settings%bound)
    if (between) then
      call log%line('no answer from that of '//text(small_plan%axial)//' rows ('//report%reason//'); half of '// &
                    text(plan%axial)//' first:')
      call find_between(scene, plan, small, middle_plan)
      call start_on_meshes(small, middle_plan, target, newton_settings, path_settings, log, middle, middle_newton, &
                           report, error, on_the_way=on_the_way, known=problem%smaller, known_plan=small_plan)
      if (allocated(error)) return
      problem%smaller => null()
      if (report%converged) problem%smaller => middle
      call count_smaller(middle_newton)
      call log%stage('film '//text(plan%circumferential)//' x '//text(plan%axial))
      problem%carried_only = .false.
      call start_pressed(problem, report)
      call middle%destroy()
    end if
    again = .not. report%converged .and. plan%may_upwind .and. .not. (plan%upwind .or. bearing%pad(1)%foil%has_contacts())
    if (again) again = .not. gives_up(newton%settings%bound)
    if (again) then
      call set_upwind(bearing, .true.)
      call log%line('film: Galerkin finds no answer, SUPG is tried')
      call start_pressed(problem, report)
    end if
    if (problem%refused .and. .not. (report%converged .or. report%has_cause())) then
      told = allocated(problem%suspicion) .and. .not. (problem%refusal%has_cause() .or. problem%refusal%drawn)
      if (told) then
        report%reason = problem%suspicion
      else
        report%reason = problem%refusal%reason ! of all starts, not of one
        report%drawn = problem%refusal%drawn
        report%of_smaller = .true.
        report%names_cause = problem%refusal%tells_why()
      end if
      if (.not. (told .or. problem%refusal%of_smaller .or. problem%refusal%gave_up)) then
        report%reason = report%reason//', as the mesh of '//text(small_plan%circumferential)//' x '// &
          text(small_plan%axial)//' has it'
      end if
    end if
    call coarse_anchor%destroy()
    call coarse%destroy()
    if (present(anchor) .and. .not. report%converged) then
      anchor = problem%anchor
    else
      call problem%anchor%destroy()
    end if
    if (report%converged .and. .not. problem%from_smaller .and. scene%operation%asks_for_lift()) then
      call seek_branch(scene%operation%leading_edge_lift, scene%operation%leading_edge_lift_edge, problem)
    end if

  contains

    !> What a smaller system has cost counts here.
    subroutine count_smaller(smaller)
      type(newton_type), intent(inout) :: smaller !! its solver, is destroyed

      newton%iterations = newton%iterations + smaller%iterations
      newton%factorizations = newton%factorizations + smaller%factorizations
      newton%factorizations_before = newton%factorizations_before + smaller%factorizations
      call destroy_newton(smaller)
    end subroutine count_smaller
  end subroutine start_on_meshes

  !> Builds a scene's equations and finds their answer by loops, from the film of a rigid foil.
  !>
  !> Fails when the mesh cannot be cut; a scene without an answer is a report, not an error.
  subroutine start_partitioned(scene, plan, target, newton_settings, path_settings, log, bearing, newton, &
                               sides, report, error)
    type(scene_type), intent(in) :: scene !! what the case file asks for
    type(bearing_plan_type), intent(in) :: plan      !! its meshes
    type(operating_point_type), intent(in) :: target !! the scene's, or the first of its sweep
    type(newton_settings_type), intent(in) :: newton_settings !! when Newton's method stops
    type(path_settings_type), intent(in) :: path_settings !! limits of a path
    type(run_log_type), intent(in) :: log !! gets the lines of progress
    type(bearing_system_type), target, intent(inout) :: bearing !! is built
    type(newton_type), target, intent(inout) :: newton !! of the coupled equations: only counts here
    type(partitioned_type), target, intent(inout) :: sides !! are created
    type(path_report_type), intent(out) :: report !! how it ended
    type(error_type), allocatable, intent(out) :: error !! why it could not be done

    type(bearing_system_type), allocatable, target :: rigid
    type(newton_type), allocatable, target :: rigid_newton
    type(scene_type), allocatable :: stiff
    real(wp), allocatable :: unknown(:)
    integer :: i

    allocate (rigid, rigid_newton)
    call build_bearing(scene, plan, bearing, error)
    if (allocated(error)) return
    call create_newton(newton, bearing, 'bearing_', newton_settings, log)
    stiff = scene
    stiff%model%foil = foil_rigid
    call start_on_meshes(stiff, plan, target, newton_settings, path_settings, log, rigid, rigid_newton, &
                       report, error)
    if (allocated(error)) return
    newton%iterations = rigid_newton%iterations
    newton%factorizations = rigid_newton%factorizations
    newton%factorizations_before = rigid_newton%factorizations
    bearing%point = target
    call set_upwind(bearing, rigid%pad(1)%film%flow%upwind)
    call transfer_answer(rigid, bearing)
    allocate (unknown(bearing%local_size()))
    call bearing%get_unknowns(unknown)
    do i = 1, size(bearing%pad)
      unknown(bearing%pad(i)%first + bearing%pad(i)%foil%first + 1:bearing%pad(i)%last) = 0.0_wp ! at rest
    end do
    call bearing%set_unknowns(unknown)
    call create_partitioned(bearing, newton_settings, log, sides)
    if (report%converged) then
      call log%line('partitioned: starts from the film of a rigid foil, found by '// &
                    text(newton%iterations)//' Newton iterations, and the foil at rest')
      call follow_partitioned(bearing, newton, target, path_settings, sides, report)
    else
      report%reason = 'the film of a rigid foil, where the loops start: '//report%reason
    end if
    call destroy_newton(rigid_newton)
    call rigid%destroy()
  end subroutine start_partitioned
end module gfb_cold_start
