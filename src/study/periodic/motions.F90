#include "gfb_petsc.h"
!> A shaft that moves, from an equilibrium on: over time, or on orbits that close.
module gfb_motions
  use gfb_kinds, only: wp
  use gfb_errors, only: error_type
  use gfb_quantity, only: quantity_type
  use gfb_scene, only: scene_type
  use gfb_bearing_system, only: bearing_system_type
  use gfb_newton, only: newton_type
  use gfb_case_file, only: case_array_type
  use gfb_bearing_record, only: bearing_record_type
  use gfb_reasons, only: reason_type
  use gfb_run_context, only: run_context_type
  use gfb_two_bearings, only: stand_on_two
  use gfb_transient, only: transient_type
  use gfb_periodic, only: periodic_type
  implicit none (type)
  private
  public :: moves

  !> What was found of the motion asked for.
  type, public :: motion_type
    type(transient_type), allocatable :: transient
    type(periodic_type), allocatable :: periodic
  contains
    procedure :: run
    procedure :: results
    procedure :: add_arrays
  end type motion_type

contains

  !> Whether a scene asks for a motion.
  pure function moves(scene)
    type(scene_type), intent(in) :: scene !! what is asked for
    logical :: moves
    moves = scene%transient%present .or. scene%periodic%present
  end function moves

  !> Follows the shaft; one that tilts on two bearings.
  !>
  !> Fails when a restart file is damaged.
  subroutine run(self, scene, context, bearing, newton, record, reason, error)
    class(motion_type), intent(inout) :: self !! gets what is found
    type(scene_type), intent(in) :: scene !! that asks for a motion
    type(run_context_type), intent(in) :: context !! of the run
    type(bearing_system_type), target, intent(inout) :: bearing !! where the shaft begins; left at its end
    type(newton_type), target, intent(inout) :: newton !! its solver
    type(bearing_record_type), intent(inout) :: record !! of where the shaft begins
    type(reason_type), intent(inout) :: reason !! why there is no answer
    type(error_type), allocatable, intent(out) :: error !! why it failed

    if (scene%transient%present) then
      allocate (self%transient)
      if (scene%rotor%distance_in_time > 0.0_wp .and. .not. context%restart%goes_on) then
        call stand_on_two(scene, context%log, bearing, newton, record, error)
      end if
      if (allocated(error)) return
      call self%transient%run(scene, context, bearing, newton, record, reason, error)
    else
      allocate (self%periodic)
      call self%periodic%run(scene, context, bearing, newton, reason)
    end if
  end subroutine run

  !> What the summary says of it.
  function results(self) result(found)
    class(motion_type), intent(in) :: self !! what was found
    type(quantity_type), allocatable :: found(:)

    if (allocated(self%transient)) then
      found = self%transient%results()
    else
      found = self%periodic%results()
    end if
  end function results

  !> Adds it to what the result file gets.
  subroutine add_arrays(self, arrays)
    class(motion_type), intent(in) :: self !! what was found
    type(case_array_type), allocatable, intent(inout) :: arrays(:) !! get a dataset a name

    if (allocated(self%transient)) call self%transient%add_arrays(arrays)
    if (allocated(self%periodic)) call self%periodic%add_arrays(arrays)
  end subroutine add_arrays
end module gfb_motions
