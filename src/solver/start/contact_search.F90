#include "gfb_petsc.h"
!> The first answer of a bearing with foils in contact: which starts are tried, and in what order.
module gfb_contact_search
  use petscvec
  use gfb_kinds, only: wp
  use gfb_text, only: text
  use gfb_scene, only: scene_type
  use gfb_operating_point, only: operating_point_type
  use gfb_bearing_system, only: bearing_system_type
  use gfb_newton, only: newton_type
  use gfb_continuation, only: path_settings_type, path_report_type, follow_path
  use gfb_contact_start, only: try_start, start_count, plain_starts, shortest_trial
  use gfb_edge_start, only: search_heights, has_free_edge
  implicit none (type)
  private
  public :: find_with_contacts

  integer, parameter :: most_halvings = 1 !! of the speed, to come to the target from below
  integer, parameter :: edge_after = 1    !! starts the free edge is held; where the shaft is held, after all

contains

  !> Tries several positions to begin with, and where none leads to the target a slower shaft first.
  !> Without an answer the state is the equilibrium nearest to the target.
  recursive subroutine find_with_contacts(scene, target, settings, slower, bearing, newton, report)
    type(scene_type), intent(in) :: scene
    type(operating_point_type), intent(in) :: target
    type(path_settings_type), intent(in) :: settings
    integer, intent(in) :: slower !! times the speed has been halved
    type(bearing_system_type), intent(inout) :: bearing
    type(newton_type), target, intent(inout) :: newton
    type(path_report_type), intent(out) :: report
    type(path_settings_type) :: trial
    type(path_report_type) :: nearest
    type(operating_point_type) :: slow
    Vec :: kept
    integer :: attempt, attempts, edge_at
    logical :: edge, shown
    PetscErrorCode :: ierr

    attempts = start_count
    if (scene%operation%eccentricity_given) attempts = plain_starts + 1 ! the position, in all ways
    if (.not. bearing%floats) attempts = plain_starts
    PetscCallA(VecDuplicate(bearing%state, kept, ierr))
    edge = has_free_edge(bearing)
    edge = edge .and. slower == 0
    edge_at = merge(edge_after, attempts, bearing%floats)
    shown = .false.
    do attempt = 1, attempts
      trial = settings
      if (attempt < attempts) trial%smallest_step = max(trial%smallest_step, shortest_trial)
      call try_start(scene, target, trial, attempt, bearing, newton, report)
      call keep_nearest(bearing, target, attempt == 1, report, nearest, kept)
      if (report%converged .or. report%touched) exit
      if (attempt == edge_at .and. edge) then
        call search_heights(scene, target, settings, bearing, newton, report, shown)
        if (report%converged) exit
        if (shown) then
          nearest%reason = report%reason
          exit
        end if
      end if
      if (attempt < attempts) call newton%log%line('no answer from this start ('//report%reason//'): another one')
    end do
    if (.not. (report%converged .or. report%touched .or. shown) .and. bearing%floats .and. slower < most_halvings) then
      slow = target
      slow%speed = 0.5_wp*target%speed
      call newton%log%line('no answer from these starts: first with half the speed')
      call find_with_contacts(scene, slow, settings, slower + 1, bearing, newton, report)
      if (report%converged) then
        call follow_path(bearing, newton, target, 0.25_wp, settings, report)
        call keep_nearest(bearing, target, .false., report, nearest, kept)
      end if
    end if
    if (.not. report%converged) then
      report = nearest
      if (slower == 0 .and. attempts > plain_starts .and. .not. (report%touched .or. report%folded .or. shown)) then
        report%reason = text(attempts)//' starts failed, and one with half the speed; from the nearest state '// &
          'they reached: '//report%reason
      end if
      PetscCallA(VecCopy(kept, bearing%state, ierr))
      bearing%point = report%reached
      bearing%held = report%held .and. bearing%floats
    end if
    PetscCallA(VecDestroy(kept, ierr))
  end subroutine find_with_contacts

  !> Keeps a state if it is the nearest to the target so far: an equilibrium rather than a held
  !> position, at the speed asked for, and the load's.
  subroutine keep_nearest(bearing, target, first, report, nearest, kept)
    type(bearing_system_type), intent(in) :: bearing
    type(operating_point_type), intent(in) :: target
    logical, intent(in) :: first !! there is none yet
    type(path_report_type), intent(in) :: report
    type(path_report_type), intent(inout) :: nearest
    Vec, intent(in) :: kept
    PetscErrorCode :: ierr

    if (.not. first) then
      if (distance(report) >= distance(nearest)) return
    end if
    nearest = report
    PetscCallA(VecCopy(bearing%state, kept, ierr))

  contains

    !> Loads and speeds that are missing, held positions last [1].
    pure function distance(report)
      type(path_report_type), intent(in) :: report
      real(wp) :: distance

      distance = norm2(report%reached%load - target%load)/max(norm2(target%load), tiny(1.0_wp)) + &
        abs(report%reached%speed - target%speed)/max(abs(target%speed), tiny(1.0_wp))
      if (report%held) distance = huge(1.0_wp)
    end function distance
  end subroutine keep_nearest
end module gfb_contact_search
