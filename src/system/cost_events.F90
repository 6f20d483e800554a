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
    type(cost_events_type), intent(out) :: events
    PetscClassId :: class
    PetscErrorCode :: ierr

    ierr = find_event('gfb assembly'//c_null_char, events%assembly)
    CHKERRA(ierr)
    if (events%assembly < 0) then
      PetscCallA(PetscClassIdRegister('gfb', class, ierr))
      PetscCallA(PetscLogEventRegister('gfb assembly', class, events%assembly, ierr))
      PetscCallA(PetscLogEventRegister('gfb film', class, events%film, ierr))
      PetscCallA(PetscLogEventRegister('gfb foil', class, events%foil, ierr))
      PetscCallA(PetscLogEventRegister('gfb contact', class, events%contact, ierr))
    else
      ierr = find_event('gfb film'//c_null_char, events%film)
      CHKERRA(ierr)
      ierr = find_event('gfb foil'//c_null_char, events%foil)
      CHKERRA(ierr)
      ierr = find_event('gfb contact'//c_null_char, events%contact)
      CHKERRA(ierr)
    end if
  end subroutine register_cost_events

  !> What follows belongs to a stage of the run, until it is left.
  subroutine enter_stage(name)
    character(len=*), intent(in) :: name
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
