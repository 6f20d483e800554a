#include "gfb_petsc.h"
!> Starts from the answer of a smaller system: on a coarser mesh, or on half the width.
!>
!> Which smaller system may give a scene its start: half the width, fewer rows, fewer stations.
!>
!> The way from nothing to an answer is long, and few of its iterations need the finest mesh. A film
!> without meshed foils is solved with half the elements each way, as often as that leaves a mesh, by
!> SUPG. Meshed foils keep their bumps, which decide the branch; their film and top foil lose rows
!> first, then stations.
module gfb_smaller_start
  use gfb_kinds, only: wp
  use gfb_scene, only: scene_type
  use gfb_operating_point, only: operating_point_type
  use gfb_model_case, only: half_width_auto
  use gfb_bearing_case, only: pad_length
  use gfb_mesh_case, only: linear_solver_direct, linear_solver_iterative
  use gfb_mesh_plan, only: bearing_plan_type
  use gfb_foil_builder, only: plate_stations, stations_follow_crests
  use gfb_ending, only: path_lost
  use gfb_continuation, only: path_report_type, follow_path
  use gfb_start_problem, only: start_problem_type, trial_settings, first_step
  use gfb_start_position, only: solve_at
  use gfb_answer_transfer, only: transfer_answer
  use gfb_bearing_directions, only: edge_force
  implicit none (type)
  private
  public :: find_smaller, find_between, lies_between, try_smaller_answer, try_smaller_end

  integer, parameter :: least_circumferential = 32 !! elements of the coarsest mesh, at least
  integer, parameter :: least_axial = 4            !! of half the width, at least
  integer, parameter :: least_of_pitch = 3         !! of a bump's pitch, at least

  integer, parameter :: max_iterations = 16 !! where a mesh in between may help; 6 to 10 where none is needed

contains

  !> The scene on the next smaller system, where there is one.
  subroutine find_smaller(scene, plan, target, found, small, small_plan)
    type(scene_type), intent(in) :: scene            !! what the case file asks for
    type(bearing_plan_type), intent(in) :: plan      !! its meshes
    type(operating_point_type), intent(in) :: target !! what is to be found
    logical, intent(out) :: found !! there is a smaller system
    type(scene_type), intent(out) :: small             !! the scene on it
    type(bearing_plan_type), intent(out) :: small_plan !! its meshes

    small = scene
    if (scene%solver%linear_solver == linear_solver_iterative) small%solver%linear_solver = linear_solver_direct ! cheaper there
    small_plan = plan
    found = .true.
    if (can_halve(scene, plan, target)) then
      small_plan%half = .true.
    else if (scene%model%foil%has_bumps) then
      call coarsen_foils(scene, plan, found, small, small_plan)
    else if (can_coarsen(plan)) then
      small_plan = coarser_film(plan)
    else
      found = .false.
    end if
  end subroutine find_smaller

  !> Whether a mesh of foils lies between one and the next smaller one: many rows were left out at once.
  pure logical function lies_between(plan, small_plan) result(lies)
    type(bearing_plan_type), intent(in) :: plan, small_plan !! meshes of both
    lies = plan%circumferential == small_plan%circumferential .and. (plan%half .eqv. small_plan%half) .and. &
      plan%axial > 2*small_plan%axial
  end function lies_between

  !> The scene on it: with half the rows.
  subroutine find_between(scene, plan, small, small_plan)
    type(scene_type), intent(in) :: scene       !! what the case file asks for
    type(bearing_plan_type), intent(in) :: plan !! its meshes
    type(scene_type), intent(out) :: small             !! the scene on the smaller mesh
    type(bearing_plan_type), intent(out) :: small_plan !! its meshes

    small = scene
    small_plan = plan
    small_plan%axial = 2*(plan%axial/4)
    small%mesh%axial_elements = small_plan%axial
  end subroutine find_between

  !> Whether half the width has the answer too: of foils, where the sweep alone tilts; never of a sector.
  pure logical function can_halve(scene, plan, target) result(can)
    type(scene_type), intent(in) :: scene
    type(bearing_plan_type), intent(in) :: plan
    type(operating_point_type), intent(in) :: target

    can = scene%model%foil%has_bumps .and. scene%model%half_width == half_width_auto .and. .not. plan%half .and. &
      modulo(plan%axial, 2) == 0 .and. scene%thermal%mirrors() .and. .not. any(abs(target%place(4:5)) > 0.0_wp) .and. &
      scene%bearing%row%has_half_width
  end function can_halve

  !> Few rows, or else half the stations of film and top foil; a fixed shaft, which cannot move away where the foil deflects
  !> otherwise, keeps its stations.
  subroutine coarsen_foils(scene, plan, found, small, small_plan)
    type(scene_type), intent(in) :: scene
    type(bearing_plan_type), intent(in) :: plan
    logical, intent(out) :: found
    type(scene_type), intent(inout) :: small
    type(bearing_plan_type), intent(inout) :: small_plan
    integer :: fewest, of_pitch

    fewest = fewest_rows(scene, plan)
    of_pitch = nint(plan%circumferential*scene%bump_foil%pitch%value/pad_length(scene%bearing))
    found = .true.
    if (plan%axial >= 2*fewest) then
      small_plan%axial = fewest
      small%mesh%axial_elements = fewest
    else if (plan%floats .and. of_pitch*plan%order >= 2*least_of_pitch .and. &
             plan%circumferential*plan%order >= 2*least_circumferential) then
      small%mesh%circumferential_elements = scene%mesh%circumferential_elements/2
      small_plan%circumferential = small%mesh%circumferential_elements
      if (stations_follow_crests(scene)) small_plan%circumferential = size(plate_stations(small)) - 1
      found = small_plan%circumferential < plan%circumferential
    else
      found = .false.
    end if
  end subroutine coarsen_foils

  !> Elements over the width of the smallest mesh of foils; as many on every strip of shells, so that the top foil bends where
  !> strips are cut apart, as they do.
  pure function fewest_rows(scene, plan) result(fewest)
    type(scene_type), intent(in) :: scene
    type(bearing_plan_type), intent(in) :: plan
    integer :: fewest, of_strips

    fewest = 2*max(1, least_axial/plan%order)
    if (.not. scene%model%foil%has_shell_bumps) return
    of_strips = 2*max(1, scene%bump_foil%strips) ! symmetric
    fewest = of_strips*((fewest - 1)/of_strips + 1)
  end function fewest_rows

  !> Whether half the elements of a film each way still make a mesh.
  pure logical function can_coarsen(plan) result(can)
    type(bearing_plan_type), intent(in) :: plan
    integer :: solved

    solved = merge(plan%axial/2, plan%axial, plan%half)
    can = plan%order > 1 .or. (modulo(plan%circumferential, 2) == 0 .and. modulo(solved, 2) == 0 .and. &
                               plan%circumferential >= 2*least_circumferential .and. solved >= 2*least_axial)
  end function can_coarsen

  !> Half the elements of a film each way, by SUPG; of biquadratic ones, bilinear ones on their corners.
  pure function coarser_film(plan) result(coarse)
    type(bearing_plan_type), intent(in) :: plan
    type(bearing_plan_type) :: coarse

    coarse = plan
    coarse%upwind = .true.
    if (plan%order > 1) then
      coarse%order = 1
      return
    end if
    coarse%circumferential = plan%circumferential/2
    coarse%axial = plan%axial/2
  end function coarser_film

  !> Newton's method at the target, from the smaller system's answer.
  subroutine try_smaller_answer(problem, report)
    type(start_problem_type), intent(inout) :: problem !! what is to be solved
    type(path_report_type), intent(out) :: report !! how it ended

    call transfer_answer(problem%smaller, problem%bearing)
    call solve_at(problem%bearing, problem%newton, problem%target, .false., problem%settings, report, &
                  merge(max_iterations, problem%newton%settings%maximum_iterations, problem%carried_only))
    problem%from_smaller = report%converged()
  end subroutine try_smaller_answer

  !> The smaller system's refusal is shown on this one from the state that it was shown from there: with the free edge
  !> fixed where that takes the least force, or else on the way to the load.
  subroutine try_smaller_end(problem, report, ends)
    type(start_problem_type), intent(inout) :: problem !! what is to be solved
    type(path_report_type), intent(out) :: report !! how it ended
    logical, intent(out) :: ends                  !! this system refuses the target, too
    integer :: pad

    call transfer_answer(problem%smaller, problem%bearing)
    call solve_at(problem%bearing, problem%newton, problem%smaller%point, .false., problem%settings, report)
    ends = report%converged()
    if (.not. ends) return
    call problem%anchor%save(problem%bearing)
    if (any(problem%bearing%point%edge_hold > 0.0_wp)) then
      ends = any([(edge_force(problem%bearing, pad), pad=1, size(problem%bearing%pad))] < 0.0_wp)
      report%ending = path_lost(problem%refusal%reason())
      if (ends) report%ending = problem%refusal%ending
    else
      call follow_path(problem%bearing, problem%newton, problem%target, first_step, &
                       trial_settings(problem%settings), report)
      ends = report%has_cause()
    end if
  end subroutine try_smaller_end
end module gfb_smaller_start
