#include "gfb_petsc.h"
!> The first answer of a scene, from nothing.
!>
!> A coarse mesh finds the way: at rest the film is at ambient pressure whatever the shaft's
!> position; from there the shaft is brought to speed at a held position, and then the load vector
!> is moved from the film's reaction to the load asked for. A finer mesh starts from the coarser
!> one's answer, and goes the same way itself only if that fails. Coarse meshes use SUPG, which
!> comes home from far away at cell Peclet numbers where Galerkin's pressure becomes negative. Foils that
!> only a sweep will tilt start from the answer on half the width.
module gfb_cold_start
  use petscvec
  use gfb_kinds, only: wp
  use gfb_errors, only: error_type
  use gfb_text, only: text
  use gfb_run_log, only: run_log_type
  use gfb_scene, only: scene_type
  use gfb_operating_point, only: operating_point_type
  use gfb_film_mesh, only: find_film_place
  use gfb_bearing_system, only: bearing_system_type, film_values
  use gfb_bearing_builder, only: bearing_plan_type, build_bearing
  use gfb_bearing_answer, only: bearing_answer_type, bearing_answer
  use gfb_newton, only: newton_type, newton_settings_type, create_newton, destroy_newton
  use gfb_continuation, only: path_settings_type, path_report_type
  use gfb_start_position, only: guess_position, find_position, let_go, solve_at
  use gfb_contact_search, only: find_with_contacts
  use gfb_branch_search, only: seek_branch
  use gfb_full_width_start, only: widen
  use gfb_model_case, only: meshes_foils, half_width_auto
  implicit none (type)
  private
  public :: start_bearing, refine

  integer, parameter :: least_circumferential = 32 !! elements of the coarsest mesh, at least
  integer, parameter :: least_axial = 4            !! of the part of the width that is solved
  integer, parameter :: galerkin_steps = 2         !! of a path, before SUPG is asked
  real(wp), parameter :: coarse_peclet = 5.0_wp    !! of a cell that is too large for Galerkin [1]
  integer, parameter :: corners = 4                !! of an element

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
    logical :: helped, found_before

    call build_bearing(scene, plan, bearing, error)
    if (allocated(error)) return
    call create_newton(newton, bearing, 'bearing_', newton_settings, log)
    helped = can_coarsen(plan) .or. can_halve(scene, plan, target)
    if (helped) then
      call start_bearing(scene, smaller(plan), target, newton_settings, path_settings, log, coarse, &
                         coarse_newton, report, error)
      if (allocated(error)) return
      newton%iterations = coarse_newton%iterations
      newton%factorizations = coarse_newton%factorizations
      helped = report%converged
      call destroy_newton(coarse_newton)
    end if
    call log%detail('film '//text(plan%circumferential)//' x '//text(plan%axial))
    call find_answer(scene, target, path_settings, helped, coarse, bearing, newton, found_before, report)
    if (.not. report%converged .and. plan%may_upwind .and. .not. plan%upwind) then
      bearing%film%flow%upwind = .true.
      call log%line('film: Galerkin finds no answer, SUPG is tried')
      call find_answer(scene, target, path_settings, helped, coarse, bearing, newton, found_before, report)
    end if
    call coarse%destroy()
    if (report%converged .and. .not. found_before .and. any(scene%operation%lift_given)) then
      call seek_branch(scene%operation%lift_given, scene%operation%leading_edge_lift, bearing, newton)
    end if
  end subroutine start_bearing

  !> Tries the starts there are, the cheapest first: at the target from the coarser mesh's answer;
  !> held at the coarser mesh's position, then let go; from nothing.
  subroutine find_answer(scene, target, settings, helped, coarse, bearing, newton, found_before, report)
    type(scene_type), intent(in) :: scene
    type(operating_point_type), intent(in) :: target
    type(path_settings_type), intent(in) :: settings
    logical, intent(in) :: helped !! the coarser mesh has an answer
    type(bearing_system_type), intent(in) :: coarse
    type(bearing_system_type), intent(inout) :: bearing
    type(newton_type), target, intent(inout) :: newton
    logical, intent(out) :: found_before !! it is the smaller system's answer
    type(path_report_type), intent(out) :: report
    type(operating_point_type) :: held

    found_before = .false.
    if (helped) then
      call take_over(coarse, bearing)
      call solve_at(bearing, newton, target, .false., settings, report)
      found_before = report%converged
      if (report%converged) return
      if (bearing%floats) then
        call take_over(coarse, bearing)
        held = target
        held%eccentricity = bearing%eccentricity()
        call solve_at(bearing, newton, held, .true., settings, report)
        if (report%converged) call let_go(bearing, newton, target, settings, report)
        found_before = report%converged
        if (report%converged) return
      end if
    end if
    if (bearing%foil%has_contacts()) then
      call find_with_contacts(scene, target, settings, 0, bearing, newton, report)
    else
      call guess_position(bearing, scene, target, 0.5_wp)
      call find_rigid_position(bearing, newton, target, settings, report)
      if (report%converged .and. bearing%floats) call let_go(bearing, newton, target, settings, report)
    end if
  end subroutine find_answer

  !> A held position. Where Galerkin fails it is tried from the answer of SUPG; if that does not help, and
  !> its cells are large, no way leads to an answer.
  subroutine find_rigid_position(bearing, newton, target, settings, report)
    type(bearing_system_type), intent(inout) :: bearing
    type(newton_type), target, intent(inout) :: newton
    type(operating_point_type), intent(in) :: target
    type(path_settings_type), intent(in) :: settings
    type(path_report_type), intent(out) :: report
    type(path_settings_type) :: quick
    type(path_report_type) :: other
    type(operating_point_type) :: wanted
    type(bearing_answer_type) :: answer
    real(wp) :: place(2), peclet
    Vec :: start, kept
    PetscErrorCode :: ierr

    place = bearing%eccentricity()
    PetscCallA(VecDuplicate(bearing%state, start, ierr))
    PetscCallA(VecDuplicate(bearing%state, kept, ierr))
    PetscCallA(VecCopy(bearing%state, start, ierr))
    quick = settings
    if (.not. bearing%film%flow%upwind) quick%maximum_steps = min(quick%maximum_steps, galerkin_steps)
    call find_position(bearing, newton, target, quick, report)
    if (.not. (report%converged .or. bearing%film%flow%upwind)) then
      PetscCallA(VecCopy(bearing%state, kept, ierr))
      call start_over()
      bearing%film%flow%upwind = .true.
      call find_position(bearing, newton, target, settings, other)
      bearing%film%flow%upwind = .false.
      peclet = 0.0_wp
      if (other%converged) then
        answer = bearing_answer(bearing)
        peclet = answer%maximum_peclet
        wanted = target
        wanted%eccentricity = place
        call solve_at(bearing, newton, wanted, .true., settings, other)
        other%held = .true.
      end if
      if (other%converged) then
        report = other
      else if (peclet > coarse_peclet) then
        report%reason = "Galerkin's pressure oscillates and empties the film, as the cell Peclet number is "// &
          text(peclet, 3)//": film_scheme = 'supg' has an answer, or use a finer mesh"
        PetscCallA(VecCopy(kept, bearing%state, ierr))
        bearing%point = report%reached
      else
        call start_over()
        call find_position(bearing, newton, target, settings, report)
      end if
    end if
    PetscCallA(VecDestroy(kept, ierr))
    PetscCallA(VecDestroy(start, ierr))

  contains

    !> Puts the beginning back.
    subroutine start_over()
      PetscCallA(VecCopy(start, bearing%state, ierr))
      bearing%point%eccentricity = place
    end subroutine start_over
  end subroutine find_rigid_position

  !> Takes an answer over from a smaller system: on half the width, or on a coarser mesh.
  subroutine take_over(small, bearing)
    type(bearing_system_type), intent(in) :: small
    type(bearing_system_type), intent(inout) :: bearing

    if (small%whole%half .and. .not. bearing%whole%half) then
      call widen(small, bearing)
    else
      call refine(small, bearing)
    end if
  end subroutine take_over

  !> Takes pressure and position over from a coarser mesh.
  subroutine refine(coarse, fine)
    type(bearing_system_type), intent(in) :: coarse
    type(bearing_system_type), intent(inout) :: fine

    real(wp) :: rough(coarse%local_size()), unknown(fine%local_size())
    real(wp) :: share(corners, size(fine%mesh%mesh_node))
    integer :: around(corners, size(fine%mesh%mesh_node)), node

    call coarse%get_unknowns(rough)
    do node = 1, size(fine%mesh%mesh_node)
      call find_film_place(coarse%whole, fine%film%angle(node), fine%film%axial(node), around(:, node), share(:, node))
    end do
    unknown = 0.0_wp
    unknown(:size(share, 2)) = taken(rough(:size(coarse%mesh%mesh_node)) + coarse%solid_pressure(rough))
    call fine%foil%estimate(unknown)
    unknown(:size(share, 2)) = taken(rough(:size(coarse%mesh%mesh_node)))
    if (fine%floats) unknown(fine%first_shaft + 1:) = coarse%eccentricity()
    call fine%set_unknowns(unknown)

  contains

    !> A field of the coarse film at the fine one's nodes.
    function taken(value) result(there)
      real(wp), intent(in) :: value(:)
      real(wp) :: there(size(share, 2)), corner(corners, size(share, 2))

      corner = reshape(film_values(coarse, value, [around]), shape(corner))
      ! Less one corner's value: an even field stays so to the last digit.
      there = corner(1, :) + sum(share*(corner - spread(corner(1, :), 1, corners)), 1)
    end function taken
  end subroutine refine

  !> Whether half the elements each way still make a mesh.
  pure function can_coarsen(plan) result(can)
    type(bearing_plan_type), intent(in) :: plan
    logical :: can
    integer :: solved

    solved = merge(plan%axial/2, plan%axial, plan%half)
    if (plan%order > 1) then
      can = plan%may_coarsen
      return
    end if
    can = plan%may_coarsen .and. modulo(plan%circumferential, 2) == 0 .and. modulo(solved, 2) == 0 .and. &
      plan%circumferential >= 2*least_circumferential .and. solved >= 2*least_axial
  end function can_coarsen

  !> Whether half the width has the answer too: of foils, where the sweep alone tilts.
  pure function can_halve(scene, plan, target) result(can)
    type(scene_type), intent(in) :: scene
    type(bearing_plan_type), intent(in) :: plan
    type(operating_point_type), intent(in) :: target
    logical :: can

    can = meshes_foils(scene%model%foil) .and. scene%model%half_width == half_width_auto .and. .not. plan%half .and. &
      modulo(plan%axial, 2) == 0 .and. .not. any(abs(target%tilt) > 0.0_wp)
  end function can_halve

  !> The plan with half the width, or else with half the nodes each way.
  pure function smaller(plan) result(coarse)
    type(bearing_plan_type), intent(in) :: plan
    type(bearing_plan_type) :: coarse

    coarse = plan
    if (.not. plan%may_coarsen) then
      coarse%half = .true.
      return
    end if
    coarse%upwind = .true.
    if (plan%order > 1) then ! bilinear elements on the corners of the others
      coarse%order = 1
      return
    end if
    coarse%circumferential = plan%circumferential/2
    coarse%axial = plan%axial/2
  end function smaller
end module gfb_cold_start
