#include "gfb_petsc.h"
!> What is asked of a search for an answer from nothing, what a cold start is, and what it is tried on.
module gfb_start_problem
  use gfb_kinds, only: wp
  use gfb_scene, only: scene_type
  use gfb_operating_point, only: operating_point_type
  use gfb_bearing_system, only: bearing_system_type
  use gfb_run_log, only: run_log_type
  use gfb_mesh_plan, only: bearing_plan_type
  use gfb_newton, only: newton_type, newton_settings_type, forget_factors, destroy_newton
  use gfb_saved_state, only: saved_state_type
  use gfb_ending, only: path_settings_type, path_report_type
  implicit none (type)
  private
  public :: with_fixed_edges, settings_with_fixed_edge, clearance_of
  public :: trial_settings, drop_bearing, count_spent

  integer, parameter, public :: by_load = 1 !! before the shaft where the load is larger than the film's force, else after
  integer, parameter, public :: after = 2   !! after the shaft
  integer, parameter, public :: before = 3  !! before it

  !> Step of a path of a start, over all of it: longer ones are given up, shorter ones tried once more [1]
  real(wp), parameter, public :: first_step = 0.25_wp
  !> The same, before it is given up: smaller wins next to nothing, and every refusal pays for it [1]
  real(wp), parameter, public :: shortest_trial = 0.02_wp
  !> Eccentricity to begin with where none is given, over the free clearance: less has the film carry less, more meets the foil [1]
  real(wp), parameter, public :: usual_eccentricity = 0.5_wp
  real(wp), parameter :: hold_share = 100.0_wp   !! stiffness of the spring that fixes it, times clearance over a force [1]
  integer, parameter :: most_steps = 20           !! of it
  integer, parameter :: straight_steps = 8        !! Newton's, of one of its steps, before they are bent

  !> How a start uses soft two-way contact springs.
  type, public :: soft_contacts_type
    integer :: release = by_load        !! when they are released
    real(wp) :: eccentricity = 0.0_wp   !! of the shaft where none is given, over the free clearance [1]
    real(wp) :: first_decades = 0.0_wp  !! of their stiffness, in the first step [1]
    real(wp) :: growth = 1.0_wp         !! of a step that succeeded [1]
  end type soft_contacts_type

  !> What is searched, and how.
  type, public :: search_request_type
    type(scene_type), pointer :: scene => null() !! what the case file asks for
    type(bearing_plan_type) :: plan              !! its meshes
    type(operating_point_type) :: target         !! the scene's, or the first of its sweep
    type(newton_settings_type) :: tolerances     !! when Newton's method stops; their bound is the search's
    type(path_settings_type) :: settings         !! limits of a path
    type(run_log_type) :: log                    !! gets the lines of progress
  end type search_request_type

  !> A bearing of one mesh that is to be brought to an operating point from nothing.
  type, public, extends(search_request_type) :: start_problem_type
    type(bearing_system_type), pointer :: bearing => null()
    type(newton_type), pointer :: newton => null()             !! its solver
    type(bearing_system_type), pointer :: smaller => null()    !! on a coarser mesh or half the width, if there is one
    logical :: refused = .false.         !! no start led to an answer of the smaller system, which is left where its search ended
    type(path_report_type) :: refusal    !! how, where it was refused
    logical :: carried_only = .false.    !! no start but Newton's method from the smaller system's answer
    logical :: may_give_up = .false.     !! the start has longer least steps than the scene, and fewer of them
    type(saved_state_type) :: anchor      !! out: a state to show a refusal from, on a larger system, too
    logical :: from_smaller = .false.    !! out: the answer was found from the smaller system's
    logical :: no_room = .false.         !! out: the gap alone shows that there is no place for the shaft
  end type start_problem_type

contains

  !> The target with all edges fixed at their height at rest.
  function with_fixed_edges(problem) result(target)
    type(start_problem_type), intent(in) :: problem
    type(operating_point_type) :: target

    target = problem%target
    target%edge_hold(:size(problem%bearing%pad)) = hold_share*problem%bearing%force_scale()/clearance_of(problem%bearing)
    target%edge_height = 0.0_wp
  end function with_fixed_edges

  !> Limits of a path along which the edge is fixed.
  pure function settings_with_fixed_edge(settings) result(fixed)
    type(path_settings_type), intent(in) :: settings
    type(path_settings_type) :: fixed

    fixed = trial_settings(settings)
    fixed%look_for_folds = .false.
  end function settings_with_fixed_edge

  !> The bearing's clearance [m].
  pure real(wp) function clearance_of(bearing) result(clearance)
    type(bearing_system_type), intent(in) :: bearing !! a bearing
    clearance = bearing%clearance
  end function clearance_of

  !> Frees a bearing and its solver.
  subroutine drop_bearing(bearing, newton, spent)
    type(bearing_system_type), intent(inout) :: bearing !! pads and shaft
    type(newton_type), intent(inout) :: newton !! its solver; keeps its counts, unless they are taken
    integer, intent(out), optional :: spent(3) !! the counts so far; those of the solver begin anew

    call forget_factors(newton)
    call destroy_newton(newton)
    call bearing%destroy()
    if (.not. present(spent)) return
    spent = [newton%iterations, newton%factorizations, newton%factorizations_before]
    newton%iterations = 0
    newton%factorizations = 0
    newton%factorizations_before = 0
  end subroutine drop_bearing

  !> Adds what was spent before a bearing was built anew.
  subroutine count_spent(newton, spent)
    type(newton_type), intent(inout) :: newton !! the new bearing's
    integer, intent(in) :: spent(3) !! of `drop_bearing`

    newton%iterations = newton%iterations + spent(1)
    newton%factorizations = newton%factorizations + spent(2)
    newton%factorizations_before = newton%factorizations_before + spent(3)
  end subroutine count_spent

  !> Limits of a path while other starts, or another way to show a refusal, are left.
  pure function trial_settings(settings) result(trial)
    type(path_settings_type), intent(in) :: settings !! the scene's
    type(path_settings_type) :: trial

    trial = settings
    trial%smallest_step = max(settings%smallest_step, shortest_trial)
    trial%maximum_steps = min(settings%maximum_steps, most_steps)
    trial%longest_leap = huge(1.0_wp)
    trial%straight_steps = straight_steps
  end function trial_settings
end module gfb_start_problem
