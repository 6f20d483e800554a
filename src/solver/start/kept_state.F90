#include "gfb_petsc.h"
!> The state of a bearing, kept to be put back: what a start may change and has to leave as it was.
module gfb_kept_state
  use petscvec
  use gfb_kinds, only: wp
  use gfb_operating_point, only: operating_point_type
  use gfb_bearing_system, only: bearing_system_type
  implicit none (type)
  private

  !> Unknowns, operating point, and whether the shaft is fixed.
  type, public :: kept_state_type
    type(operating_point_type) :: point
    logical :: shaft_fixed = .false.            !! the shaft is fixed at the point's position
    Vec, private :: state                !! scaled
    logical :: created = .false.         !! there is one
  contains
    procedure :: keep
    procedure :: put_back
    procedure :: change
    procedure :: destroy
  end type kept_state_type

contains

  !> Keeps the bearing's present state, instead of what was kept before.
  subroutine keep(self, bearing)
    class(kept_state_type), intent(inout) :: self !! the kept state
    type(bearing_system_type), intent(in) :: bearing !! with the state that is kept
    PetscErrorCode :: ierr
    PetscInt :: kept_size, size

    if (self%created) then ! maybe of a bearing with another mesh
      PetscCallA(VecGetSize(self%state, kept_size, ierr))
      PetscCallA(VecGetSize(bearing%state, size, ierr))
      if (kept_size /= size) call self%destroy()
    end if
    if (.not. self%created) then
      PetscCallA(VecDuplicate(bearing%state, self%state, ierr))
      self%created = .true.
    end if
    PetscCallA(VecCopy(bearing%state, self%state, ierr))
    self%point = bearing%point
    self%shaft_fixed = bearing%shaft_fixed
  end subroutine keep

  !> Makes what was kept the bearing's present state again.
  subroutine put_back(self, bearing)
    class(kept_state_type), intent(in) :: self !! the kept state
    type(bearing_system_type), intent(inout) :: bearing !! that whose state was kept

    bearing%point = self%point
    bearing%shaft_fixed = self%shaft_fixed
    call bearing%return_to(self%state)
  end subroutine put_back

  !> Largest change of a scaled unknown since the state was kept.
  function change(self, bearing) result(largest)
    class(kept_state_type), intent(in) :: self !! the kept state
    type(bearing_system_type), intent(in) :: bearing !! that whose state was kept
    real(wp) :: largest !! [1]
    Vec :: difference
    PetscErrorCode :: ierr

    PetscCallA(VecDuplicate(self%state, difference, ierr))
    PetscCallA(VecWAXPY(difference, -1.0_wp, self%state, bearing%state, ierr))
    PetscCallA(VecNorm(difference, NORM_INFINITY, largest, ierr))
    PetscCallA(VecDestroy(difference, ierr))
  end function change

  !> Frees what PETSc holds; may be called without anything kept.
  subroutine destroy(self)
    class(kept_state_type), intent(inout) :: self !! the kept state
    PetscErrorCode :: ierr

    if (.not. self%created) return
    PetscCallA(VecDestroy(self%state, ierr))
    self%created = .false.
  end subroutine destroy
end module gfb_kept_state
