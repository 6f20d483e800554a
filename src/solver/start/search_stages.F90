#include "gfb_petsc.h"
!> What a bearing gets after its first answer from nothing, in stages: interference of assembly, heat, edges that are lifted.
!>
!> Each begins from the answer without it and ends at that with it. They are gone through on the coarsest mesh; a finer one takes
!> the answer with all of them from it, or what it refuses.
!>
!> Asperities are no stage: a shaft at rest has no answer without them from which one could begin. The equations have them from the
!> first start on, which puts such a shaft where they bear its load (`gfb_start_position`).
module gfb_search_stages
  use gfb_kinds, only: wp
  use gfb_units, only: micrometres
  use gfb_text, only: text
  use gfb_ending, only: ending_stopped, path_reached, path_touches_at, path_lost
  use gfb_work_bound, only: gives_up, work_bound_type
  use gfb_scene, only: scene_type
  use gfb_operating_point, only: operating_point_type
  use gfb_bearing_heat, only: film_heat_type
  use gfb_bearing_system, only: bearing_system_type
  use gfb_bearing_builder, only: heat_of
  use gfb_newton, only: newton_type, newton_report_type, solve_newton
  use gfb_stepper, only: path_problem_type, step_rules_type, follow_steps, steps_arrived, steps_given_up
  use gfb_continuation, only: path_report_type
  use gfb_saved_state, only: saved_state_type
  use gfb_start_problem, only: start_problem_type, first_step
  use gfb_start_position, only: set_interference
  use gfb_start_list, only: try_starts
  use gfb_heat_start, only: heat_up
  use gfb_branch_search, only: seek_branch
  implicit none (type)
  private
  public :: stages_of, take_heat_away, start_pressed, take_stages, close_interference

  integer, parameter, public :: stage_interference = 1, stage_heat = 2, stage_edges = 3 !! in their order

  real(wp), parameter :: smallest_share = 0.005_wp !! of the interference in a step, before it is given up [1]
  integer, parameter :: max_iterations = 20 !! of such a step
  real(wp), parameter :: growth = 1.5_wp    !! of one that succeeded [1]

  !> A bearing whose shaft grows to its size; the parameter is the share of the interference.
  type, extends(path_problem_type) :: interference_path_type
    type(bearing_system_type), pointer :: bearing => null()
    type(newton_type), pointer :: newton => null() !! its solver
    real(wp) :: whole = 0.0_wp         !! interference [m]
    type(newton_report_type) :: solved !! of the last trial
    type(saved_state_type) :: saved     !! the last answer
  contains
    procedure :: try => try_interference
    procedure :: accept => accept_interference
    procedure :: restore => restore_interference
    procedure :: gives_up => search_gives_up
  end type interference_path_type

contains

  !> The stages that a scene asks for, in their order.
  pure function stages_of(scene) result(stages)
    type(scene_type), intent(in) :: scene !! what the case file asks for
    integer, allocatable :: stages(:)
    stages = pack([stage_interference, stage_heat, stage_edges], &
                  [scene%bearing%interference > 0.0_wp, scene%thermal%present, scene%operation%asks_for_lift()])
  end function stages_of

  !> A scene before its stage of heat: at ambient temperature, where its shaft is as its speed has made it grow; edges that are lifted
  !> come after heat. One without heat as it is. Allocated, as scenes are large.
  subroutine take_heat_away(scene, target, cold)
    type(scene_type), intent(in) :: scene !! what the case file asks for
    type(operating_point_type), intent(in) :: target !! of it
    type(scene_type), allocatable, intent(out) :: cold
    type(film_heat_type) :: heat

    allocate (cold, source=scene)
    if (.not. scene%thermal%present) return
    heat = heat_of(scene)
    cold%thermal%present = .false.
    cold%operation%leading_edge_lift = [real(wp) ::]
    cold%operation%leading_edge_lift_edge = [real(wp) ::]
    cold%bearing%interference = cold%bearing%interference + heat%centrifugal*target%speed**2
  end subroutine take_heat_away

  !> From an answer through stages, until one of them has none.
  subroutine take_stages(stages, problem, report)
    integer, intent(in) :: stages(:) !! of `stages_of`
    type(start_problem_type), intent(inout) :: problem !! at the answer without them; its scene has them
    type(path_report_type), intent(inout) :: report !! in: of the search so far; out: of the last stage
    integer :: k

    do k = 1, size(stages)
      if (.not. report%converged()) return
      select case (stages(k))
      case (stage_interference)
        call close_interference(problem, problem%scene%bearing%interference, report)
      case (stage_heat)
        call heat_up(problem, report)
      case (stage_edges)
        call lift_edges(problem)
      case default
        error stop 'a stage that is none'
      end select
    end do
  end subroutine take_stages

  !> From an answer to that with the lift of an edge that the scene asks for. What follows a branch has bounds of its own.
  subroutine lift_edges(problem)
    type(start_problem_type), intent(inout) :: problem !! at the answer
    type(work_bound_type), pointer :: bound

    associate (operation => problem%scene%operation, settings => problem%newton%settings)
      bound => settings%bound
      settings%bound => null()
      call seek_branch(operation%leading_edge_lift, operation%leading_edge_lift_edge, problem)
      settings%bound => bound
    end associate
  end subroutine lift_edges

  !> The starts; where there is interference, from a smaller system's answer with it, or else without it first.
  !>
  !> Without an answer the films are left with as much interference as the state has.
  subroutine start_pressed(problem, report)
    type(start_problem_type), intent(inout) :: problem !! what is to be solved
    type(path_report_type), intent(out) :: report !! how it ended
    real(wp) :: interference

    interference = problem%scene%bearing%interference
    call set_interference(problem%bearing, interference)
    if (.not. interference > 0.0_wp .or. associated(problem%smaller)) then
      call try_starts(problem, report)
      if (.not. interference > 0.0_wp .or. report%converged() .or. problem%refused .or. problem%carried_only) return
    end if
    problem%smaller => null()
    call problem%newton%log%detail('without interference of assembly:')
    call set_interference(problem%bearing, 0.0_wp)
    call try_starts(problem, report)
    if (.not. report%converged() .and. report%ending%kind /= ending_stopped) then
      call report%ending%add_words('without the growth and interference of '//text(interference*micrometres, 4)//' um ', '')
    end if
    call take_stages([stage_interference], problem, report)
  end subroutine start_pressed

  !> From an answer without interference to that with all of it, at the same operating point; a step that fails is halved.
  !>
  !> At rest there is no gap between an undeflected foil and a shaft that is larger than the bore in it, and no film to
  !> begin with. With no interference there is; from the answer there the shaft grows in steps to its size.
  subroutine close_interference(problem, interference, report)
    type(start_problem_type), intent(inout) :: problem !! at an answer without interference
    real(wp), intent(in) :: interference !! asked for [m]
    type(path_report_type), intent(inout) :: report !! of success, which becomes one of failure where a step is too small
    type(interference_path_type) :: path
    real(wp) :: least !! gap [m]
    integer :: allowed, ending
    logical :: touched

    path%bearing => problem%bearing
    path%newton => problem%newton
    path%whole = interference
    call path%saved%save(problem%bearing)
    allowed = problem%newton%settings%maximum_iterations
    problem%newton%settings%maximum_iterations = min(max_iterations, allowed)
    call follow_steps(path, step_rules_type(first_step=first_step, smallest_step=smallest_share, growth=growth, &
                                            cuts_the_trial=.true.), ending)
    problem%newton%settings%maximum_iterations = allowed
    call path%saved%destroy()
    least = problem%settings%touch_down_gap
    if (ending /= steps_arrived) least = max(least, smallest_share*interference)
    touched = problem%bearing%smallest_gap() < least
    if (ending == steps_arrived .and. .not. (touched .and. problem%bearing%floats)) then
      report%ending = path_reached()
    else if (touched .and. ending /= steps_given_up) then
      report%ending = path_touches_at('where the interference is '//text(path%at*interference, 4)//' m')
    else
      report%ending = path_lost('no step converges beyond an interference of '//text(path%at*interference, 4)//' m: '//path%solved%reason)
    end if
  end subroutine close_interference

  !> A share of the interference: Newton's method from the last answer.
  subroutine try_interference(self, trial, may_be_cut, converged, iterations)
    class(interference_path_type), intent(inout) :: self !! the path
    real(wp), intent(in) :: trial     !! share [1]
    logical, intent(in) :: may_be_cut !! does not matter
    logical, intent(out) :: converged !! there is an answer
    integer, intent(out) :: iterations

    call set_interference(self%bearing, trial*self%whole)
    call self%newton%log%detail('interference '//text(trial*self%whole, 4)//' m')
    call solve_newton(self%newton, self%solved)
    converged = self%solved%converged
    iterations = self%solved%iterations
  end subroutine try_interference

  !> Saves an answer.
  subroutine accept_interference(self, trial)
    class(interference_path_type), intent(inout) :: self !! the path
    real(wp), intent(in) :: trial !! share [1]
    call self%saved%save(self%bearing)
  end subroutine accept_interference

  !> Goes back to the last answer.
  subroutine restore_interference(self)
    class(interference_path_type), intent(inout) :: self !! the path

    call self%saved%restore(self%bearing)
    call set_interference(self%bearing, self%at*self%whole)
  end subroutine restore_interference

  !> Whether all work that is allowed is done.
  logical function search_gives_up(self)
    class(interference_path_type), intent(inout) :: self !! the path
    search_gives_up = gives_up(self%newton%settings%bound)
  end function search_gives_up
end module gfb_search_stages
