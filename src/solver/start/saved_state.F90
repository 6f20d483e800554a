#include "gfb_petsc.h"
!> The state of a bearing, saved to be restored: what a start may change and has to leave as it was.
module gfb_saved_state
  use petscvec
  use gfb_kinds, only: wp
  use gfb_operating_point, only: operating_point_type
  use gfb_bearing_system, only: bearing_system_type
  implicit none (type)
  private

  !> Unknowns, operating point, and whether the shaft is fixed.
  type, public :: saved_state_type
    type(operating_point_type) :: point
    logical :: shaft_fixed = .false.            !! the shaft is fixed at the point's position
    Vec, private :: state                !! scaled
    logical :: created = .false.         !! there is one
  contains
    procedure :: save => save_state
    procedure :: restore => restore_state
    procedure :: change, destroy
  end type saved_state_type

contains

  !> Saves the bearing's present state, instead of what was saved before.
  subroutine save_state(self, bearing)
    class(saved_state_type), intent(inout) :: self !! the saved state
    type(bearing_system_type), intent(in) :: bearing !! with the state that is saved
    PetscErrorCode :: ierr
    PetscInt :: saved_size, size

    if (self%created) then ! maybe of a bearing with another mesh
      PetscCallA(VecGetSize(self%state, saved_size, ierr))
      PetscCallA(VecGetSize(bearing%state, size, ierr))
      if (saved_size /= size) call self%destroy()
    end if
    if (.not. self%created) then
      PetscCallA(VecDuplicate(bearing%state, self%state, ierr))
      self%created = .true.
    end if
    PetscCallA(VecCopy(bearing%state, self%state, ierr))
    self%point = bearing%point
    self%shaft_fixed = bearing%shaft_fixed
  end subroutine save_state

  !> Makes what was saved the bearing's present state again.
  subroutine restore_state(self, bearing)
    class(saved_state_type), intent(in) :: self !! the saved state
    type(bearing_system_type), intent(inout) :: bearing !! that whose state was saved

    bearing%point = self%point
    bearing%shaft_fixed = self%shaft_fixed
    call bearing%return_to(self%state)
  end subroutine restore_state

  !> Largest change of a scaled unknown since the state was saved.
  function change(self, bearing) result(largest)
    class(saved_state_type), intent(in) :: self !! the saved state
    type(bearing_system_type), intent(in) :: bearing !! that whose state was saved
    real(wp) :: largest !! [1]
    Vec :: difference
    PetscErrorCode :: ierr

    PetscCallA(VecDuplicate(self%state, difference, ierr))
    PetscCallA(VecWAXPY(difference, -1.0_wp, self%state, bearing%state, ierr))
    PetscCallA(VecNorm(difference, NORM_INFINITY, largest, ierr))
    PetscCallA(VecDestroy(difference, ierr))
  end function change

  !> Frees what PETSc holds; may be called without anything saved.
  subroutine destroy(self)
    class(saved_state_type), intent(inout) :: self !! the saved state
    PetscErrorCode :: ierr

    if (.not. self%created) return
    PetscCallA(VecDestroy(self%state, ierr))
    self%created = .false.
  end subroutine destroy
end module gfb_saved_state
