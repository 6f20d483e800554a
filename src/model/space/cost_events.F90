#include "gfb_petsc.h"
!> Names under which PETSc's log (-log_view) shows what the equations of a bearing cost.
!>
!> The times of `film` and `foil` are parts of that of `assembly`, those of `contact` are parts of
!> that of `foil`. What stages of a run take, the log shows by itself.
module gfb_cost_events
  use, intrinsic :: iso_c_binding, only: c_char, c_int, c_null_char
  use petscsys
  implicit none (type)
  private
  public :: register_cost_events, enter_stage, leave_stage

  !> Events of PETSc's log.
  type, public :: cost_events_type
    PetscLogEvent :: assembly = 0 !! residuals, matrices, contacts: all but solving
    PetscLogEvent :: film = 0     !! the film's and the shaft's equations
    PetscLogEvent :: foil = 0     !! the foil's equations, with its contacts
    PetscLogEvent :: contact = 0  !! contacts only
  end type cost_events_type

  interface
    !> PETSc's number of an event, -1 where none has the name; Debian's PETSc has no Fortran for it.
    function find_event(name, event) bind(C, name='PetscLogEventGetId') result(error)
      import :: c_char, c_int
      implicit none (type)
      character(kind=c_char), intent(in) :: name(*) !! ends with a null
      integer(c_int), intent(out) :: event
      integer(c_int) :: error
    end function find_event
  end interface

contains

  !> Asks PETSc for the events, which are registered once a run: PETSc has room for few classes.
  subroutine register_cost_events(events)
    type(cost_events_type), intent(out) :: events !! of assembly, film, foil and contact
    character(len=*), parameter :: name(4) = [character(len=12) :: 'gfb assembly', 'gfb film', 'gfb foil', 'gfb contact']
    PetscLogEvent :: event(size(name))
    PetscClassId :: class
    PetscErrorCode :: ierr
    integer :: i

    do i = 1, size(name)
      ierr = find_event(trim(name(i))//c_null_char, event(i))
      CHKERRA(ierr)
    end do
    if (any(event < 0)) then
      PetscCallA(PetscClassIdRegister('gfb', class, ierr))
      do i = 1, size(name)
        PetscCallA(PetscLogEventRegister(trim(name(i)), class, event(i), ierr))
      end do
    end if
    events = cost_events_type(event(1), event(2), event(3), event(4))
  end subroutine register_cost_events

  !> What follows belongs to a stage of the run, until it is left.
  subroutine enter_stage(name)
    character(len=*), intent(in) :: name !! of the stage, as PETSc's log shows it
    PetscLogStage :: stage
    PetscErrorCode :: ierr

    PetscCallA(PetscLogStageGetId(name, stage, ierr))
    if (stage < 0) then
      PetscCallA(PetscLogStageRegister(name, stage, ierr))
    end if
    PetscCallA(PetscLogStagePush(stage, ierr))
  end subroutine enter_stage

  !> Ends the stage entered last.
  subroutine leave_stage()
    PetscErrorCode :: ierr
    PetscCallA(PetscLogStagePop(ierr))
  end subroutine leave_stage
end module gfb_cost_events
