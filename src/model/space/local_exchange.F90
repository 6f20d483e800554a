#include "gfb_petsc.h"
!> Carries values between a vector of all ranks and the unknowns a rank needs.
module gfb_local_exchange
  use petscvec
  use gfb_kinds, only: wp
  use gfb_petsc_kinds, only: pint
  implicit none (type)
  private
  public :: create_exchange

  !> The local unknowns of a rank among those of all.
  type, public :: local_exchange_type
    Vec, private :: local
    VecScatter, private :: ghosts
  contains
    procedure, non_overridable :: get, put, add
    procedure, non_overridable, private :: fill
    procedure, non_overridable :: destroy
  end type local_exchange_type

contains

  !> Prepares the exchange with vectors like a given one.
  subroutine create_exchange(global, vector, exchange)
    PetscInt, intent(in) :: global(:) !! number, from 0, of every local unknown
    Vec, intent(in) :: vector !! of all ranks
    type(local_exchange_type), intent(out) :: exchange !! with vectors like that one
    IS :: from
    PetscErrorCode :: ierr

    PetscCallA(VecCreateSeq(PETSC_COMM_SELF, int(size(global), pint), exchange%local, ierr))
    PetscCallA(ISCreateGeneral(PETSC_COMM_WORLD, int(size(global), pint), global, PETSC_COPY_VALUES, from, ierr))
    PetscCallA(VecScatterCreate(vector, from, exchange%local, PETSC_NULL_IS, exchange%ghosts, ierr))
    PetscCallA(ISDestroy(from, ierr))
  end subroutine create_exchange

  !> Values of a vector at the local unknowns.
  subroutine get(self, vector, value)
    class(local_exchange_type), intent(in) :: self !! the exchange
    Vec, intent(in) :: vector !! of all ranks
    real(wp), intent(out) :: value(:) !! one a local unknown, in the vector's units [SI]
    PetscScalar, pointer :: values(:)
    PetscErrorCode :: ierr

    PetscCallA(VecScatterBegin(self%ghosts, vector, self%local, INSERT_VALUES, SCATTER_FORWARD, ierr))
    PetscCallA(VecScatterEnd(self%ghosts, vector, self%local, INSERT_VALUES, SCATTER_FORWARD, ierr))
    PetscCallA(GFB_VecGetArrayRead(self%local, values, ierr))
    value = values
    PetscCallA(GFB_VecRestoreArrayRead(self%local, values, ierr))
  end subroutine get

  !> Writes local values into a vector; where ranks share an unknown their values must agree.
  subroutine put(self, value, vector)
    class(local_exchange_type), intent(in) :: self !! the exchange
    real(wp), intent(in) :: value(:) !! one a local unknown, in the vector's units [SI]
    Vec, intent(in) :: vector !! of all ranks
    PetscErrorCode :: ierr

    call self%fill(value)
    PetscCallA(VecScatterBegin(self%ghosts, self%local, vector, INSERT_VALUES, SCATTER_REVERSE, ierr))
    PetscCallA(VecScatterEnd(self%ghosts, self%local, vector, INSERT_VALUES, SCATTER_REVERSE, ierr))
  end subroutine put

  !> Adds every rank's local values to a vector.
  subroutine add(self, value, vector)
    class(local_exchange_type), intent(in) :: self !! the exchange
    real(wp), intent(in) :: value(:) !! one a local unknown, in the vector's units [SI]
    Vec, intent(in) :: vector !! of all ranks
    PetscErrorCode :: ierr

    call self%fill(value)
    PetscCallA(VecScatterBegin(self%ghosts, self%local, vector, ADD_VALUES, SCATTER_REVERSE, ierr))
    PetscCallA(VecScatterEnd(self%ghosts, self%local, vector, ADD_VALUES, SCATTER_REVERSE, ierr))
  end subroutine add

  !> Fills the local vector.
  subroutine fill(self, value)
    class(local_exchange_type), intent(in) :: self !! the exchange
    real(wp), intent(in) :: value(:) !! one a local unknown, in the vector's units [SI]
    PetscScalar, pointer :: values(:)
    PetscErrorCode :: ierr

    PetscCallA(GFB_VecGetArray(self%local, values, ierr))
    values = value
    PetscCallA(GFB_VecRestoreArray(self%local, values, ierr))
  end subroutine fill

  !> Frees what PETSc holds.
  subroutine destroy(self)
    class(local_exchange_type), intent(inout) :: self !! the exchange
    PetscErrorCode :: ierr

    PetscCallA(VecScatterDestroy(self%ghosts, ierr))
    PetscCallA(VecDestroy(self%local, ierr))
  end subroutine destroy
end module gfb_local_exchange
