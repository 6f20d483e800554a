!> Starts PETSc and SLEPc for a program of tests.
!>
!> They are not ended: pFUnit has ended MPI by the time it could be asked to.
module gfb_petsc_start
#include <slepc/finclude/slepcsys.h>
  use slepcsys
  implicit none (type, external)
  private
  public :: start_petsc

contains

  !> Called once, on all ranks, with MPI running.
  subroutine start_petsc()
    PetscErrorCode :: ierr

    PetscCallA(SlepcInitialize(PETSC_NULL_CHARACTER, ierr))
  end subroutine start_petsc
end module gfb_petsc_start
