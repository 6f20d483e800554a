#include "gfb_petsc.h"
!> A bearing along keys of its case file: it is built anew for every value, and starts from the answer of the
!> value before, node by node: the meshes are the same, and displacements are kept in metres.
module gfb_key_path
  use petscvec
  use gfb_kinds, only: wp
  use gfb_ending, only: path_reached, path_touches, path_lost, path_settings_type, path_report_type
  use gfb_errors, only: error_type
  use gfb_text, only: text
  use gfb_petsc_session, only: any_rank
  use gfb_scene, only: scene_type
  use gfb_scene_reading, only: scene_at_value
  use gfb_scene_point, only: operating_point
  use gfb_mesh_plan, only: bearing_plan_type
  use gfb_bearing_system, only: bearing_system_type
  use gfb_bearing_builder, only: build_bearing
  use gfb_bearing_answer, only: bearing_answer_type, bearing_answer
  use gfb_newton, only: newton_type, newton_report_type, newton_settings_type, create_newton, solve_newton
  use gfb_start_problem, only: drop_bearing
  use gfb_answer_transfer, only: transfer_answer
  use gfb_stepper, only: path_problem_type, step_rules_type, follow_steps, steps_arrived, steps_too_far, steps_spent
  use gfb_run_log, only: run_log_type
  implicit none (type)
  private
  public :: follow_keys

  integer, parameter :: hasty_iterations = 20      !! of a step that can be cut: one that converges does so soon
  integer, parameter :: straight_steps = 8         !! of a leap, before they are bent at contacts that change
  real(wp), parameter :: shortest_step = 1.0_wp/64.0_wp !! of the way from value to value: no step is shorter [1]
  integer, parameter :: easy_iterations = 8        !! a step that took no more of them is doubled
  !> Of the shaft or the free edge in a step, over the clearance; beyond, it may be another branch [1].
  real(wp), parameter :: longest_move = 0.1_wp

  !> An answer without its equations.
  type :: carried_type
    real(wp), allocatable :: unknown(:) !! local ones of the bearing, in SI
    integer, allocatable :: node(:)     !! of the whole film mesh on this rank
    logical :: upwind = .false.
    real(wp) :: place(4) = 0.0_wp       !! of the shaft, lifts of the free edge [m]
    real(wp) :: value = 0.0_wp          !! of the keys [the sweep's unit]
    real(wp) :: at = 0.0_wp             !! path parameter [1]
  end type carried_type

  !> A bearing on its way from a value of keys to another; the parameter is the share of the way.
  type, extends(path_problem_type) :: key_path_type
    type(scene_type), pointer :: scene => null()
    type(bearing_plan_type), pointer :: plan => null()
    real(wp) :: from = 0.0_wp, to = 0.0_wp !! values [the keys' unit]
    integer :: maximum_steps = 0
    real(wp) :: touch_down_gap = 0.0_wp    !! [m]
    type(bearing_system_type), pointer :: bearing => null()
    type(newton_type), pointer :: newton => null() !! its solver
    type(carried_type) :: here, before     !! the last two answers
    logical :: leaps = .false.             !! Newton's steps may be bent
    character(len=:), allocatable :: problem !! why the last trial has no answer
  contains
    procedure :: try => try_key, accept => accept_key, restore => restore_key, has_steps
    procedure :: rescue => leap, is_too_far => touches
  end type key_path_type

contains

  !> Leads the bearing from a value of keys of its scene, where its state is the answer, to another.
  !>
  !> Each step starts from the answer before, from the second one on from the line through two. A step that does not
  !> converge, or moves the shaft or the free edge far, which may be to another branch, is halved. Where Newton's method
  !> goes to and fro between contacts however short the step, longer steps are tried, bent at contacts that change; what
  !> they find has to be near, too. On return the bearing is at the last answer.
  subroutine follow_keys(scene, plan, from, to, settings, bearing, newton, report)
    type(scene_type), target, intent(in) :: scene !! what is asked for
    type(bearing_plan_type), target, intent(in) :: plan !! of its meshes
    real(wp), intent(in) :: from, to !! values [the keys' unit]
    type(path_settings_type), intent(in) :: settings !! limits of the path
    type(bearing_system_type), target, intent(inout) :: bearing !! pads and shaft; is built anew
    type(newton_type), target, intent(inout) :: newton !! of the bearing; is created anew
    type(path_report_type), intent(out) :: report !! how far it led
    type(key_path_type) :: path
    character(len=:), allocatable :: problem
    integer :: ending

    path%scene => scene
    path%plan => plan
    path%from = from
    path%to = to
    path%maximum_steps = settings%maximum_steps
    path%touch_down_gap = settings%touch_down_gap
    path%bearing => bearing
    path%newton => newton
    call carry(bearing, from, 0.0_wp, path%here)
    path%before = path%here
    path%before%at = -1.0_wp
    call follow_steps(path, step_rules_type(smallest_step=max(shortest_step, settings%smallest_step), &
                                            easy_iterations=easy_iterations), ending)
    select case (ending)
    case (steps_arrived)
      report%ending = path_reached()
    case (steps_too_far)
      report%ending = path_touches(settings%touch_down_gap)
    case (steps_spent)
      report%ending = path_lost('more than '//text(settings%maximum_steps)//' steps')
    case default
      report%ending = path_lost('no step converges ('//path%problem//')')
    end select
    report%fraction = path%at
    report%steps = path%steps
    report%cuts = path%cuts
    if (report%fraction < 1.0_wp .and. .not. report%has_cause()) then
      call rebuild(scene, plan, value_at(from, to, report%fraction), path%here, bearing, newton, problem)
      if (problem /= '') error stop 'a bearing that had been built cannot be built again'
    end if
    report%reached = bearing%point
  end subroutine follow_keys

  !> The bearing at a value on the way; a trial that moves the shaft or the free edge far is none.
  subroutine try_key(self, trial, may_be_cut, converged, iterations)
    class(key_path_type), intent(inout) :: self !! the path
    real(wp), intent(in) :: trial     !! share of the way [1]
    logical, intent(in) :: may_be_cut !! does not matter
    logical, intent(out) :: converged !! there is an answer near the last one
    integer, intent(out) :: iterations

    call try_value(self%scene, self%plan, value_at(self%from, self%to, trial), trial, self%here, self%before, &
                   self%leaps, self%bearing, self%newton, iterations, self%problem)
    if (self%problem == '') then
      if (has_moved(self%here, self%bearing)) self%problem = 'the shaft or the free edge jumps'
    end if
    converged = self%problem == ''
  end subroutine try_key

  !> Takes an answer along.
  subroutine accept_key(self, trial)
    class(key_path_type), intent(inout) :: self !! the path
    real(wp), intent(in) :: trial !! share of the way [1]

    self%leaps = .false.
    self%before = self%here
    call carry(self%bearing, value_at(self%from, self%to, trial), trial, self%here)
  end subroutine accept_key

  !> The next trial is built from the last answer: nothing is to be done.
  subroutine restore_key(self)
    class(key_path_type), intent(inout) :: self !! the path
    call self%newton%log%detail('cut: '//self%problem)
  end subroutine restore_key

  !> Whether another step is allowed.
  logical function has_steps(self)
    class(key_path_type), intent(inout) :: self !! the path
    has_steps = self%steps + self%cuts < self%maximum_steps
  end function has_steps

  !> Where steps are too short: longer ones, bent at contacts that change.
  subroutine leap(self, step, continues)
    class(key_path_type), intent(inout) :: self !! the path
    real(wp), intent(inout) :: step !! share of the way [1]
    logical, intent(out) :: continues !! they have not been tried yet

    continues = .not. self%leaps
    self%leaps = .true.
    if (continues) step = 1.0_wp - self%at
  end subroutine leap

  !> Whether the shaft touches down.
  logical function touches(self)
    class(key_path_type), intent(inout) :: self !! the path
    touches = self%bearing%smallest_gap() < self%touch_down_gap
  end function touches

  !> The value at a path parameter; the last one to the last digit.
  pure real(wp) function value_at(from, to, at) result(value)
    real(wp), intent(in) :: from, to !! [the sweep's unit]
    real(wp), intent(in) :: at       !! path parameter [1]

    value = from + at*(to - from)
    if (at >= 1.0_wp) value = to
  end function value_at

  !> Builds the bearing at a value and solves it from the answers before.
  subroutine try_value(scene, plan, value, at, here, before, leaps, bearing, newton, iterations, problem)
    type(scene_type), intent(in) :: scene
    type(bearing_plan_type), intent(in) :: plan
    real(wp), intent(in) :: value              !! [the sweep's unit]
    real(wp), intent(in) :: at                 !! path parameter [1]
    type(carried_type), intent(in) :: here, before !! the last two answers
    logical, intent(in) :: leaps               !! Newton's steps may be bent
    type(bearing_system_type), target, intent(inout) :: bearing
    type(newton_type), target, intent(inout) :: newton
    integer, intent(out) :: iterations         !! of Newton
    character(len=:), allocatable, intent(out) :: problem !! why there is no answer; empty where there is one
    type(newton_report_type) :: solved
    type(newton_settings_type) :: kept

    iterations = 0
    call rebuild(scene, plan, value, here, bearing, newton, problem)
    if (problem /= '') return
    if (before%at >= 0.0_wp .and. .not. leaps) then
      call predict(here, before, (at - here%at)/(here%at - before%at), bearing)
    end if
    kept = newton%settings
    if (leaps) then
      newton%settings%straight_steps = straight_steps
    else
      newton%settings%maximum_iterations = min(kept%maximum_iterations, hasty_iterations)
    end if
    call solve_newton(newton, solved)
    newton%settings = kept
    iterations = solved%iterations
    if (.not. solved%converged) problem = solved%reason
  end subroutine try_value

  !> The bearing at a value, with a carried answer as its state; nothing is done where the value breaks a rule.
  subroutine rebuild(scene, plan, value, carried, bearing, newton, problem)
    type(scene_type), intent(in) :: scene
    type(bearing_plan_type), intent(in) :: plan
    real(wp), intent(in) :: value !! [the sweep's unit]
    type(carried_type), intent(in) :: carried
    type(bearing_system_type), target, intent(inout) :: bearing
    type(newton_type), target, intent(inout) :: newton
    character(len=:), allocatable, intent(out) :: problem !! empty where there is none
    type(scene_type), allocatable :: there ! large for a stack
    type(error_type), allocatable :: error
    logical :: fits

    problem = ''
    allocate (there)
    call scene_at_value(scene, value, there, error)
    if (allocated(error)) then
      problem = error%message
      return
    end if
    call build_anew(there, plan, bearing, newton)
    bearing%pad%film%flow%upwind = carried%upwind
    call compare_nodes(carried, bearing, fits)
    if (fits) then
      call bearing%set_unknowns(carried%unknown)
    else
      call interpolate(scene, plan, carried, bearing)
    end if
  end subroutine rebuild

  !> The bearing of a scene and its solver in the place of another; what was spent counts on.
  subroutine build_anew(scene, plan, bearing, newton)
    type(scene_type), intent(in) :: scene
    type(bearing_plan_type), intent(in) :: plan
    type(bearing_system_type), target, intent(inout) :: bearing
    type(newton_type), target, intent(inout) :: newton
    type(newton_settings_type) :: settings
    type(run_log_type) :: log
    type(error_type), allocatable :: error

    settings = newton%settings
    log = newton%log
    call drop_bearing(bearing, newton)
    call build_bearing(scene, plan, bearing, error)
    if (allocated(error)) error stop 'a mesh that was divided cannot be divided again'
    call create_newton(newton, bearing, 'bearing_', settings, log)
    bearing%point = operating_point(scene%operation)
  end subroutine build_anew

  !> Whether an answer's nodes are those of the bearing.
  subroutine compare_nodes(carried, bearing, fits)
    type(carried_type), intent(in) :: carried
    type(bearing_system_type), intent(in) :: bearing
    logical, intent(out) :: fits

    fits = bearing%local_size() == size(carried%unknown) .and. size(bearing%mesh_nodes()) == size(carried%node)
    if (fits) fits = all(bearing%mesh_nodes() == carried%node)
    fits = .not. any_rank(.not. fits)
  end subroutine compare_nodes

  !> Interpolates an answer on other nodes: where a pitch changes, the top foil may get more stations between its bumps.
  subroutine interpolate(scene, plan, carried, bearing)
    type(scene_type), intent(in) :: scene
    type(bearing_plan_type), intent(in) :: plan
    type(carried_type), intent(in) :: carried
    type(bearing_system_type), intent(inout) :: bearing !! gets a start value
    type(bearing_system_type) :: other
    type(scene_type), allocatable :: there ! large for a stack
    type(error_type), allocatable :: error

    allocate (there)
    call scene_at_value(scene, carried%value, there, error)
    if (.not. allocated(error)) call build_bearing(there, plan, other, error)
    if (allocated(error)) error stop 'a bearing that had been built cannot be built again'
    other%point = operating_point(there%operation)
    call other%set_unknowns(carried%unknown)
    call transfer_answer(other, bearing)
    call other%destroy()
  end subroutine interpolate

  !> Takes the bearing's present answer along.
  subroutine carry(bearing, value, at, carried)
    type(bearing_system_type), intent(in) :: bearing
    real(wp), intent(in) :: value !! of the keys [the sweep's unit]
    real(wp), intent(in) :: at !! path parameter [1]
    type(carried_type), intent(out) :: carried

    allocate (carried%unknown(bearing%local_size()))
    call bearing%get_unknowns(carried%unknown)
    carried%node = bearing%mesh_nodes()
    carried%upwind = bearing%upwinds()
    carried%place = place_of(bearing)
    carried%value = value
    carried%at = at
  end subroutine carry

  !> Moves the state on the line through two answers, where it can be evaluated there.
  subroutine predict(here, before, stretch, bearing)
    type(carried_type), intent(in) :: here, before
    real(wp), intent(in) :: stretch !! beyond the last, over their distance [1]
    type(bearing_system_type), intent(inout) :: bearing !! at the last one
    Vec :: residual
    PetscErrorCode :: ierr
    logical :: valid, here_fits, before_fits

    call compare_nodes(here, bearing, here_fits)
    call compare_nodes(before, bearing, before_fits)
    if (.not. (here_fits .and. before_fits)) return
    call bearing%set_unknowns(here%unknown + stretch*(here%unknown - before%unknown))
    PetscCallA(VecDuplicate(bearing%state, residual, ierr))
    call bearing%evaluate(bearing%state, residual, valid)
    if (any_rank(.not. valid)) call bearing%set_unknowns(here%unknown)
    PetscCallA(VecDestroy(residual, ierr))
  end subroutine predict

  !> Where the shaft and the free edge of the top foil are [m].
  function place_of(bearing) result(place)
    type(bearing_system_type), intent(in) :: bearing
    real(wp) :: place(4)
    type(bearing_answer_type) :: answer

    answer = bearing_answer(bearing)
    place = [bearing%eccentricity(), answer%leading_edge_lift]
  end function place_of

  !> Whether the shaft or the free edge is far from where it was.
  logical function has_moved(here, bearing) result(moved)
    type(carried_type), intent(in) :: here
    type(bearing_system_type), intent(in) :: bearing
    moved = any(abs(place_of(bearing) - here%place) > longest_move*bearing%clearance)
  end function has_moved
end module gfb_key_path
