#include "gfb_petsc.h"
!> The first answer of a bearing with foils in contact, from nothing.
!>
!> A foil at rest lies on all its contacts with no force, so that every least film decides all of
!> them anew, and Newton's method cycles among them. Therefore contacts begin soft, and hold what
!> they touch: as springs both ways they leave the equations nearly linear. With a film there they
!> are made to let go, by decades of their stiffness against opening, and then as hard as they are.
module gfb_contact_start
  use petscvec
  use gfb_kinds, only: wp
  use gfb_text, only: text
  use gfb_scene, only: scene_type
  use gfb_operating_point, only: operating_point_type
  use gfb_film_load, only: film_forces
  use gfb_bearing_system, only: bearing_system_type
  use gfb_newton, only: newton_type, newton_settings_type, newton_report_type, solve_newton
  use gfb_continuation, only: path_settings_type, path_report_type, follow_path
  use gfb_start_position, only: guess_position, find_position, let_go, solve_at
  implicit none (type)
  private
  public :: try_start

  !> Eccentricities to begin with where none is given, over the free clearance; when contacts let go,
  !> before the shaft does or after; and by how many decades of their stiffness at first. The first
  !> start lets them go while the foil is pressed most: before, where the load is larger than the held
  !> film's force.
  integer, parameter :: by_load = 1, against_load = 2, after = 3, before = 4
  real(wp), parameter :: start_eccentricity(6) = [0.5_wp, 0.5_wp, 0.5_wp, 0.5_wp, 0.9_wp, 0.25_wp]
  integer, parameter :: let_go_when(6) = [by_load, against_load, after, after, before, before]
  real(wp), parameter :: first_decades(6) = [1.5_wp, 1.5_wp, 0.8_wp, 1.5_wp, 1.5_wp, 1.5_wp]
  real(wp), parameter :: growth(6) = [1.0_wp, 1.0_wp, 1.0_wp, 2.0_wp, 2.0_wp, 1.0_wp] !! of a step that succeeded
  integer, parameter, public :: start_count = size(start_eccentricity)
  integer, parameter, public :: plain_starts = 4    !! those that differ only in how contacts let go
  real(wp), parameter, public :: shortest_trial = 0.02_wp !! step of a start while others are left [1]
  real(wp), parameter :: first_hard_step = 0.1_wp   !! of the rest of a way, with hard contacts [1]

  type(newton_settings_type), parameter :: rough = newton_settings_type(1.0e-3_wp, 1.0e-2_wp, 25) !! on the way
  integer, parameter :: releasing = 1, hardening = 2 !! what is done to contacts
  real(wp), parameter :: shortest_decades = 0.05_wp
  real(wp), parameter :: enough = 4.0_wp             !! decades of letting go that are all where steps do not grow
  real(wp), parameter :: least_adhesion = -8.0_wp    !! decades at which it is none

contains

  !> One of the starts.
  subroutine try_start(scene, target, settings, attempt, bearing, newton, report)
    type(scene_type), intent(in) :: scene
    type(operating_point_type), intent(in) :: target
    type(path_settings_type), intent(in) :: settings
    integer, intent(in) :: attempt !! from 1 to `start_count`
    type(bearing_system_type), intent(inout) :: bearing
    type(newton_type), target, intent(inout) :: newton
    type(path_report_type), intent(out) :: report

    call guess_position(bearing, scene, target, start_eccentricity(attempt))
    call find_from(bearing, newton, target, settings, attempt, report)
  end subroutine try_start

  !> The way to the target with contacts that are soft and hold what they touch; what it reached is
  !> made to let go, and hard, and goes on from there.
  subroutine find_from(bearing, newton, target, settings, attempt, report)
    type(bearing_system_type), intent(inout) :: bearing
    type(newton_type), target, intent(inout) :: newton
    type(operating_point_type), intent(in) :: target
    type(path_settings_type), intent(in) :: settings
    integer, intent(in) :: attempt
    type(path_report_type), intent(out) :: report
    type(path_settings_type) :: soft
    type(newton_settings_type) :: wanted
    real(wp) :: force(film_forces)
    logical :: early, real_contacts

    soft = settings
    soft%look_for_folds = .false. ! they would be those of soft contacts
    wanted = newton%settings
    newton%settings%residual_tolerance = max(wanted%residual_tolerance, rough%residual_tolerance)
    newton%settings%step_tolerance = max(wanted%step_tolerance, rough%step_tolerance)
    newton%settings%maximum_iterations = min(wanted%maximum_iterations, rough%maximum_iterations)
    call bearing%foil%set_hardness(bearing%foil%softest())
    call bearing%foil%set_adhesion(1.0_wp)
    call find_position(bearing, newton, target, soft, report)
    force = bearing%reaction()
    early = let_go_when(attempt) == before
    if (let_go_when(attempt) <= against_load) early = norm2(target%load) > norm2(force(1:2)) .eqv. let_go_when(attempt) == by_load
    if (report%converged .and. early) call lead_contacts(bearing, newton, releasing, attempt, report)
    if (report%converged .and. bearing%floats) call let_go(bearing, newton, target, soft, report)
    if (report%converged .and. .not. early) call lead_contacts(bearing, newton, releasing, attempt, report)
    call bearing%foil%set_adhesion(0.0_wp)
    real_contacts = .false.
    if (report%converged .or. .not. report%held) then
      call lead_contacts(bearing, newton, hardening, attempt, report, real_contacts)
    end if
    newton%settings = wanted
    if (report%converged) then
      call solve_at(bearing, newton, target, .false., settings, report)
    else if (real_contacts) then
      call follow_path(bearing, newton, target, first_hard_step, settings, report)
    else
      report%held = .true. ! not a state of this scene
    end if
    call bearing%foil%set_hardness(1.0_wp)
  end subroutine find_from

  !> Makes contacts let go, or as hard as the scene has them, at the bearing's present point and by
  !> decades. A report of success becomes one of failure where that does not succeed.
  subroutine lead_contacts(bearing, newton, change, attempt, report, arrived)
    type(bearing_system_type), intent(inout) :: bearing
    type(newton_type), target, intent(inout) :: newton
    integer, intent(in) :: change !! `releasing` or `hardening`
    integer, intent(in) :: attempt
    type(path_report_type), intent(inout) :: report
    logical, intent(out), optional :: arrived
    type(newton_report_type) :: solved
    real(wp) :: gone, way, step, trial
    Vec :: here
    PetscErrorCode :: ierr

    way = least_adhesion
    if (change == hardening) way = log10(bearing%foil%softest())
    way = -way
    step = first_decades(attempt)
    gone = 0.0_wp
    PetscCallA(VecDuplicate(bearing%state, here, ierr))
    PetscCallA(VecCopy(bearing%state, here, ierr))
    do while (gone < way .and. step >= shortest_decades)
      trial = gone + step
      if (trial >= way .or. (change == releasing .and. trial >= enough .and. growth(attempt) <= 1.0_wp)) trial = way
      call set_contacts(bearing, newton, change, trial, way)
      call solve_newton(newton, solved)
      if (solved%converged) then
        gone = trial
        step = growth(attempt)*step
        PetscCallA(VecCopy(bearing%state, here, ierr))
      else
        PetscCallA(VecCopy(here, bearing%state, ierr))
        step = 0.5_wp*step
      end if
    end do
    PetscCallA(VecDestroy(here, ierr))
    if (present(arrived)) arrived = gone >= way
    if (gone >= way .or. .not. report%converged) return
    report%converged = .false.
    report%reason = solved%reason
    report%held = .true. ! not a state of this scene
  end subroutine lead_contacts

  !> Contacts on their way, so many decades from how they began.
  subroutine set_contacts(bearing, newton, change, gone, way)
    type(bearing_system_type), intent(inout) :: bearing
    type(newton_type), intent(in) :: newton
    integer, intent(in) :: change    !! `releasing` or `hardening`
    real(wp), intent(in) :: gone, way !! decades
    real(wp) :: factor

    if (change == releasing) then
      factor = merge(0.0_wp, 10.0_wp**(-gone), gone >= way)
      call bearing%foil%set_adhesion(factor)
      call newton%log%detail('contacts hold less: '//text(factor, 3)//' of their stiffness')
    else
      factor = merge(1.0_wp, 10.0_wp**(gone - way), gone >= way)
      call bearing%foil%set_hardness(factor)
      call newton%log%detail('contacts harder: '//text(factor, 3)//' of their stiffness')
    end if
  end subroutine set_contacts
end module gfb_contact_start
