#include "gfb_petsc.h"
!> The first answer of a scene, from nothing.
!>
!> A coarse mesh finds the way: at rest the film is at ambient pressure whatever the shaft's position;
!> from there the shaft is brought to speed at a held position, and then the load vector is moved from
!> the film's reaction to the load asked for. A finer mesh starts from the coarser one's answer, and
!> goes the same way itself only if that fails.
module gfb_cold_start
  use petscsys
  use gfb_kinds, only: wp
  use gfb_errors, only: error_type
  use gfb_text, only: text
  use gfb_run_log, only: run_log_type
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
  public :: start_bearing

  integer, parameter :: least_circumferential = 32 !! elements of the coarsest mesh, at least
  integer, parameter :: least_axial = 4            !! of the part of the width that is solved

  real(wp), parameter :: start_eccentricity = 0.5_wp !! of the free clearance, where none is given [1]
  real(wp), parameter :: start_attitude = 0.5_wp     !! of that position [rad]

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
    logical :: started

    call build_bearing(scene, plan, bearing, error)
    if (allocated(error)) return
    call create_newton(newton, bearing, 'bearing_', newton_settings, log)
    started = .false.
    if (can_coarsen(plan)) then
      call start_bearing(scene, coarser(plan), target, newton_settings, path_settings, log, coarse, &
                         coarse_newton, report, error)
      if (allocated(error)) return
      newton%iterations = coarse_newton%iterations
      newton%factorizations = coarse_newton%factorizations
      call log%detail('film '//text(plan%circumferential)//' x '//text(plan%axial)//', from the coarser mesh')
      call refine(coarse, bearing)
      call destroy_newton(coarse_newton)
      if (report%converged) call try_target(bearing, newton, target, path_settings, started, report)
      if (.not. started) call refine_position(coarse, bearing)
      call coarse%destroy()
    else
      call guess_position(bearing, scene, target)
    end if
    if (.not. started) call find_way(bearing, newton, target, path_settings, report)
  end subroutine start_bearing

  !> Newton's method straight at the target.
  subroutine try_target(bearing, newton, target, settings, found, report)
    type(bearing_system_type), intent(inout) :: bearing
    type(newton_type), target, intent(inout) :: newton
    type(operating_point_type), intent(in) :: target
    type(path_settings_type), intent(in) :: settings
    logical, intent(out) :: found
    type(path_report_type), intent(out) :: report
    type(newton_report_type) :: solved

    bearing%point = target
    bearing%held = .false.
    call bearing%apply_point()
    call solve_newton(newton, solved)
    found = solved%converged
    if (found) found = bearing%smallest_gap() >= settings%touch_down_gap .or. .not. bearing%floats
    report%converged = found
    report%reason = solved%reason
    report%reached = target
    report%fraction = 1.0_wp
    report%steps = 1
  end subroutine try_target

  !> Held position at rest, brought to speed; then the load vector moved to its target.
  subroutine find_way(bearing, newton, target, settings, report)
    type(bearing_system_type), intent(inout) :: bearing
    type(newton_type), target, intent(inout) :: newton
    type(operating_point_type), intent(in) :: target
    type(path_settings_type), intent(in) :: settings
    type(path_report_type), intent(out) :: report

    type(path_settings_type) :: to_speed
    type(operating_point_type) :: held
    real(wp) :: force(film_forces), way

    held = target
    held%eccentricity = bearing%eccentricity()
    call put_at_rest(bearing, held)
    call newton%log%detail('held position, from rest to speed')
    to_speed = settings
    to_speed%touch_down_gap = 0.0_wp
    call follow_path(bearing, newton, held, 1.0_wp, to_speed, report)
    if (.not. report%converged .or. .not. bearing%floats) return

    force = bearing%reaction()
    bearing%held = .false.
    bearing%point%load = force(1:2)
    call bearing%apply_point()
    call newton%log%detail('shaft let go, load from the reaction to its target')
    way = norm2(target%load - force(1:2))
    call follow_path(bearing, newton, target, 2.0_wp*norm2(force(1:2))/max(way, tiny(1.0_wp)), settings, report)
  end subroutine find_way

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
  subroutine guess_position(bearing, scene, target)
    type(bearing_system_type), intent(inout) :: bearing
    type(scene_type), intent(in) :: scene
    type(operating_point_type), intent(in) :: target
    real(wp) :: direction, free, unknown(bearing%local_size())

    bearing%point%eccentricity = target%eccentricity
    if (.not. bearing%floats) return
    if (.not. scene%operation%eccentricity_given) then
      free = scene%bearing%clearance - 0.5_wp*scene%bearing%length*norm2(target%tilt)
      direction = start_attitude
      if (norm2(target%load) > 0.0_wp) direction = direction + atan2(target%load(2), target%load(1))
      bearing%point%eccentricity = -start_eccentricity*max(free, 0.0_wp)*[cos(direction), sin(direction)]
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

  !> Takes the position alone over from a coarser mesh.
  subroutine refine_position(coarse, fine)
    type(bearing_system_type), intent(in) :: coarse
    type(bearing_system_type), intent(inout) :: fine
    real(wp) :: unknown(fine%local_size())

    fine%point%eccentricity = coarse%eccentricity()
    if (.not. fine%floats) return
    unknown = 0.0_wp
    unknown(fine%first_shaft + 1:) = fine%point%eccentricity
    call fine%set_unknowns(unknown)
  end subroutine refine_position

  !> Whether half the elements each way still make a mesh.
  pure function can_coarsen(plan) result(can)
    type(bearing_plan_type), intent(in) :: plan
    logical :: can
    integer :: solved

    solved = merge(plan%axial/2, plan%axial, plan%half)
    can = modulo(plan%circumferential, 2) == 0 .and. modulo(solved, 2) == 0 .and. &
      plan%circumferential >= 2*least_circumferential .and. solved >= 2*least_axial
  end function can_coarsen

  !> The plan with half the elements each way.
  pure function coarser(plan) result(coarse)
    type(bearing_plan_type), intent(in) :: plan
    type(bearing_plan_type) :: coarse

    coarse = plan
    coarse%circumferential = plan%circumferential/2
    coarse%axial = plan%axial/2
  end function coarser
end module gfb_cold_start
