#include "gfb_petsc.h"
!> The first answer of a scene, from nothing.
!>
!> A coarse mesh finds the way: at rest the film is at ambient pressure whatever the shaft's
!> position; from there the shaft is brought to speed at a held position, and then the load vector
!> is moved from the film's reaction to the load asked for. A finer mesh starts from the coarser
!> one's answer, and goes the same way itself only if that fails. Coarse meshes use SUPG, which
!> comes home from far away at cell Peclet numbers where Galerkin's pressure becomes negative.
module gfb_cold_start
  use petscvec
  use gfb_kinds, only: wp
  use gfb_errors, only: error_type
  use gfb_text, only: text
  use gfb_run_log, only: run_log_type
  use gfb_petsc_session, only: largest_over_ranks
  use gfb_scene, only: scene_type
  use gfb_operating_point, only: operating_point_type
  use gfb_film_load, only: film_forces
  use gfb_film_mesh, only: interpolate_film
  use gfb_bearing_system, only: bearing_system_type, film_on_all_ranks
  use gfb_bearing_builder, only: bearing_plan_type, build_bearing
  use gfb_newton, only: newton_type, newton_settings_type, newton_report_type, create_newton, &
                        solve_newton, destroy_newton
  use gfb_continuation, only: path_settings_type, path_report_type, follow_path
  implicit none (type)
  private
  public :: start_bearing, refine

  integer, parameter :: least_circumferential = 32 !! elements of the coarsest mesh, at least
  integer, parameter :: least_axial = 4            !! of the part of the width that is solved

  !> Eccentricities to begin with where none is given, over the free clearance: the first one, and
  !> with foils in contact the others where that fails.
  real(wp), parameter :: start_eccentricity(3) = [0.5_wp, 0.9_wp, 0.25_wp]
  real(wp), parameter :: shortest_trial = 0.02_wp    !! step of a start while others are left [1]
  real(wp), parameter :: start_attitude = 0.5_wp     !! of that position [rad]
  real(wp), parameter :: first_stride = 10.0_wp      !! factor by which contacts are made harder
  real(wp), parameter :: shortest_stride = 1.1_wp
  real(wp), parameter :: room_at_rest = 0.75_wp      !! way to begin with, over the clearance [1]

contains

  !> Builds a scene's equations and finds their answer at the scene's operating point.
  !>
  !> Fails when the mesh cannot be cut; a scene without an answer is a report, not an error.
  recursive subroutine start_bearing(scene, plan, target, newton_settings, path_settings, log, &
                                     bearing, newton, report, error)
    type(scene_type), intent(in) :: scene
    type(bearing_plan_type), intent(in) :: plan
    type(operating_point_type), intent(in) :: target
    type(newton_settings_type), intent(in) :: newton_settings
    type(path_settings_type), intent(in) :: path_settings
    type(run_log_type), intent(in) :: log
    type(bearing_system_type), target, intent(inout) :: bearing
    type(newton_type), target, intent(inout) :: newton
    type(path_report_type), intent(out) :: report
    type(error_type), allocatable, intent(out) :: error

    type(bearing_system_type), target :: coarse
    type(newton_type), target :: coarse_newton
    logical :: helped

    call build_bearing(scene, plan, bearing, error)
    if (allocated(error)) return
    call create_newton(newton, bearing, 'bearing_', newton_settings, log)
    helped = can_coarsen(plan)
    if (helped) then
      call start_bearing(scene, coarser(plan), target, newton_settings, path_settings, log, coarse, &
                         coarse_newton, report, error)
      if (allocated(error)) return
      newton%iterations = coarse_newton%iterations
      newton%factorizations = coarse_newton%factorizations
      helped = report%converged
      call destroy_newton(coarse_newton)
    end if
    call log%detail('film '//text(plan%circumferential)//' x '//text(plan%axial))
    call find_answer(scene, target, path_settings, helped, coarse, bearing, newton, report)
    if (.not. report%converged .and. plan%may_upwind .and. .not. plan%upwind) then
      bearing%film%flow%upwind = .true.
      call log%line('film: Galerkin finds no answer, SUPG is tried')
      call find_answer(scene, target, path_settings, helped, coarse, bearing, newton, report)
    end if
    call coarse%destroy()
  end subroutine start_bearing

  !> Tries the starts there are, the cheapest first: at the target from the coarser mesh's answer;
  !> held at the coarser mesh's position, then let go; from nothing.
  subroutine find_answer(scene, target, settings, helped, coarse, bearing, newton, report)
    type(scene_type), intent(in) :: scene
    type(operating_point_type), intent(in) :: target
    type(path_settings_type), intent(in) :: settings
    logical, intent(in) :: helped !! the coarser mesh has an answer
    type(bearing_system_type), intent(in) :: coarse
    type(bearing_system_type), intent(inout) :: bearing
    type(newton_type), target, intent(inout) :: newton
    type(path_report_type), intent(out) :: report
    type(operating_point_type) :: held

    if (helped) then
      call refine(coarse, bearing)
      call solve_at(bearing, newton, target, .false., settings, report)
      if (report%converged) return
      if (bearing%floats) then
        call refine(coarse, bearing)
        held = target
        held%eccentricity = bearing%eccentricity()
        call solve_at(bearing, newton, held, .true., settings, report)
        if (report%converged) call let_go(bearing, newton, target, settings, report)
        if (report%converged) return
      end if
    end if
    if (bearing%foil%softest() < 1.0_wp) then
      call find_with_contacts(scene, target, settings, bearing, newton, report)
    else
      call guess_position(bearing, scene, target, start_eccentricity(1))
      call find_way(bearing, newton, target, settings, report)
    end if
  end subroutine find_answer

  !> From nothing with foils in contact: soft contacts first, and several positions to begin with.
  subroutine find_with_contacts(scene, target, settings, bearing, newton, report)
    type(scene_type), intent(in) :: scene
    type(operating_point_type), intent(in) :: target
    type(path_settings_type), intent(in) :: settings
    type(bearing_system_type), intent(inout) :: bearing
    type(newton_type), target, intent(inout) :: newton
    type(path_report_type), intent(out) :: report
    type(path_settings_type) :: trial
    integer :: attempt, attempts

    attempts = size(start_eccentricity)
    if (scene%operation%eccentricity_given .or. .not. bearing%floats) attempts = 1
    do attempt = 1, attempts
      trial = settings
      if (attempt < attempts) trial%smallest_step = max(trial%smallest_step, shortest_trial)
      call bearing%foil%set_hardness(bearing%foil%softest())
      call guess_position(bearing, scene, target, start_eccentricity(attempt))
      call find_way(bearing, newton, target, trial, report)
      if (report%converged) call harden(bearing, newton, target, settings, report)
      call bearing%foil%set_hardness(1.0_wp)
      if (report%converged .or. report%touched) return
      if (attempt < attempts) call newton%log%line('no answer from this start ('//report%reason//'): another one')
    end do
  end subroutine find_with_contacts

  !> Makes the contacts as hard as the scene has them, from an answer with soft ones.
  subroutine harden(bearing, newton, target, settings, report)
    type(bearing_system_type), intent(inout) :: bearing
    type(newton_type), target, intent(inout) :: newton
    type(operating_point_type), intent(in) :: target
    type(path_settings_type), intent(in) :: settings
    type(path_report_type), intent(inout) :: report

    Vec :: here
    real(wp) :: hardness, stride
    PetscErrorCode :: ierr

    hardness = bearing%foil%softest()
    stride = first_stride
    PetscCallA(VecDuplicate(bearing%state, here, ierr))
    do while (hardness < 1.0_wp)
      PetscCallA(VecCopy(bearing%state, here, ierr))
      call newton%log%detail('contacts harder: '//text(min(1.0_wp, hardness*stride), 3)//' of their stiffness')
      call bearing%foil%set_hardness(min(1.0_wp, hardness*stride))
      call solve_at(bearing, newton, target, .false., settings, report)
      if (report%converged) then
        hardness = min(1.0_wp, hardness*stride)
      else
        PetscCallA(VecCopy(here, bearing%state, ierr))
        stride = sqrt(stride)
        if (stride < shortest_stride) exit
      end if
    end do
    PetscCallA(VecDestroy(here, ierr))
  end subroutine harden

  !> Newton's method at a point, as a path of one step.
  subroutine solve_at(bearing, newton, target, held, settings, report)
    type(bearing_system_type), intent(inout) :: bearing
    type(newton_type), target, intent(inout) :: newton
    type(operating_point_type), intent(in) :: target
    logical, intent(in) :: held !! the shaft is kept at the point's position
    type(path_settings_type), intent(in) :: settings
    type(path_report_type), intent(out) :: report
    type(newton_report_type) :: solved

    bearing%point = target
    bearing%held = held
    call bearing%apply_point()
    call solve_newton(newton, solved)
    report%converged = solved%converged
    if (solved%converged .and. bearing%floats .and. .not. held) then
      report%converged = bearing%smallest_gap() >= settings%touch_down_gap
    end if
    report%reason = solved%reason
    report%reached = target
    report%fraction = 1.0_wp
    report%steps = 1
  end subroutine solve_at

  !> Held position at rest, brought to speed; then the load vector moved to its target.
  subroutine find_way(bearing, newton, target, settings, report)
    type(bearing_system_type), intent(inout) :: bearing
    type(newton_type), target, intent(inout) :: newton
    type(operating_point_type), intent(in) :: target
    type(path_settings_type), intent(in) :: settings
    type(path_report_type), intent(out) :: report

    type(path_settings_type) :: to_position
    type(operating_point_type) :: wanted, free

    to_position = settings
    to_position%touch_down_gap = 0.0_wp
    wanted = target
    wanted%eccentricity = bearing%eccentricity()
    free = free_position(bearing, wanted)
    call put_at_rest(bearing, free)
    call newton%log%detail('held position, from rest to speed')
    call follow_path(bearing, newton, free, 1.0_wp, to_position, report)
    if (report%converged .and. norm2(free%eccentricity - wanted%eccentricity) + &
        norm2(free%tilt - wanted%tilt) > 0.0_wp) then
      call newton%log%detail('to the position asked for')
      call follow_path(bearing, newton, wanted, 0.25_wp, to_position, report)
    end if
    if (report%converged .and. bearing%floats) call let_go(bearing, newton, target, settings, report)
  end subroutine find_way

  !> Lets the shaft go where it is held, and moves the load from the film's reaction to its target.
  subroutine let_go(bearing, newton, target, settings, report)
    type(bearing_system_type), intent(inout) :: bearing
    type(newton_type), target, intent(inout) :: newton
    type(operating_point_type), intent(in) :: target
    type(path_settings_type), intent(in) :: settings
    type(path_report_type), intent(out) :: report
    real(wp) :: force(film_forces), way

    force = bearing%reaction()
    bearing%held = .false.
    bearing%point%load = force(1:2)
    call bearing%apply_point()
    call newton%log%detail('shaft let go, load from the reaction to its target')
    way = norm2(target%load - force(1:2))
    call follow_path(bearing, newton, target, 2.0_wp*norm2(force(1:2))/max(way, tiny(1.0_wp)), settings, report)
  end subroutine let_go

  !> A position with room for the shaft while the foil has not yet moved: the one asked for, or one
  !> on the way to it.
  function free_position(bearing, wanted) result(free)
    type(bearing_system_type), intent(in) :: bearing
    type(operating_point_type), intent(in) :: wanted
    type(operating_point_type) :: free
    real(wp) :: undeflected(size(bearing%film%angle)), approach(1)

    free = wanted
    undeflected = 0.0_wp
    associate (clearance => bearing%film%clearance)
      approach = largest_over_ranks([clearance - minval(bearing%film%gap(wanted, undeflected))])
      if (approach(1) < clearance) return
      free%eccentricity = wanted%eccentricity*room_at_rest*clearance/approach(1)
      free%tilt = wanted%tilt*room_at_rest*clearance/approach(1)
    end associate
  end function free_position

  !> Puts the bearing at rest at a held position: ambient pressure everywhere, exactly.
  subroutine put_at_rest(bearing, held)
    type(bearing_system_type), intent(inout) :: bearing
    type(operating_point_type), intent(in) :: held
    real(wp) :: unknown(bearing%local_size())

    bearing%point = held
    bearing%point%speed = 0.0_wp
    bearing%held = .true.
    unknown = 0.0_wp
    unknown(:size(bearing%mesh%mesh_node)) = bearing%film%ambient_pressure
    if (bearing%floats) unknown(bearing%first_shaft + 1:) = held%eccentricity
    call bearing%set_unknowns(unknown)
    call bearing%apply_point()
  end subroutine put_at_rest

  !> A position to begin with: the scene's, or halfway to where a film would carry the load.
  subroutine guess_position(bearing, scene, target, eccentricity)
    type(bearing_system_type), intent(inout) :: bearing
    type(scene_type), intent(in) :: scene
    type(operating_point_type), intent(in) :: target
    real(wp), intent(in) :: eccentricity !! where none is given, over the free clearance [1]
    real(wp) :: direction, free, unknown(bearing%local_size())

    bearing%point%eccentricity = target%eccentricity
    if (.not. bearing%floats) return
    if (.not. scene%operation%eccentricity_given) then
      free = scene%bearing%clearance - 0.5_wp*scene%bearing%length*norm2(target%tilt)
      direction = start_attitude
      if (norm2(target%load) > 0.0_wp) direction = direction + atan2(target%load(2), target%load(1))
      bearing%point%eccentricity = -eccentricity*max(free, 0.0_wp)*[cos(direction), sin(direction)]
    end if
    unknown = 0.0_wp
    unknown(bearing%first_shaft + 1:) = bearing%point%eccentricity
    call bearing%set_unknowns(unknown)
  end subroutine guess_position

  !> Takes pressure and position over from a coarser mesh.
  subroutine refine(coarse, fine)
    type(bearing_system_type), intent(in) :: coarse
    type(bearing_system_type), intent(inout) :: fine

    real(wp) :: rough(coarse%local_size()), unknown(fine%local_size())
    real(wp) :: whole(coarse%whole%nodes())
    integer :: node

    call coarse%get_unknowns(rough)
    whole = film_on_all_ranks(coarse, rough(:size(coarse%mesh%mesh_node)))
    unknown = 0.0_wp
    do node = 1, size(fine%mesh%mesh_node)
      unknown(node) = interpolate_film(coarse%whole, whole, fine%film%angle(node), fine%film%axial(node))
    end do
    call fine%foil%estimate(unknown)
    if (fine%floats) unknown(fine%first_shaft + 1:) = coarse%eccentricity()
    call fine%set_unknowns(unknown)
  end subroutine refine

  !> Whether half the elements each way still make a mesh.
  pure function can_coarsen(plan) result(can)
    type(bearing_plan_type), intent(in) :: plan
    logical :: can
    integer :: solved

    solved = merge(plan%axial/2, plan%axial, plan%half)
    can = plan%may_coarsen .and. modulo(plan%circumferential, 2) == 0 .and. modulo(solved, 2) == 0 .and. &
      plan%circumferential >= 2*least_circumferential .and. solved >= 2*least_axial
  end function can_coarsen

  !> The plan with half the elements each way.
  pure function coarser(plan) result(coarse)
    type(bearing_plan_type), intent(in) :: plan
    type(bearing_plan_type) :: coarse

    coarse = plan
    coarse%circumferential = plan%circumferential/2
    coarse%axial = plan%axial/2
    coarse%upwind = .true.
  end function coarser
end module gfb_cold_start
