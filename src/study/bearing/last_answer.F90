#include "gfb_petsc.h"
!> A sweep's last answer, kept while the next one is looked for: what a run that is stopped in between
!> resumes from.
module gfb_last_answer
  use petscvec
  use gfb_bearing_system, only: bearing_system_type
  use gfb_contact_point, only: contact_point_type
  use gfb_saved_state, only: saved_state_type
  use gfb_newton, only: newton_type
  implicit none (type)
  private

  !> State, operating point, contacts, counts.
  type, public :: last_answer_type
    logical :: known = .false.
    integer, private :: counts(3) = 0 !! of the solver
    type(saved_state_type), private :: state
    type(contact_point_type), allocatable, private :: contact(:) !! of this rank
  contains
    procedure :: save, restore, destroy
  end type last_answer_type

contains

  !> Keeps the bearing's present answer instead of the one before.
  subroutine save(self, bearing, newton)
    class(last_answer_type), intent(inout) :: self !! the kept answer
    type(bearing_system_type), intent(in) :: bearing !! at its answer
    type(newton_type), intent(in) :: newton !! its solver
    integer :: i

    self%known = .true.
    call self%state%save(bearing)
    self%contact = [(bearing%pad(i)%foil%contacts%point, i=1, size(bearing%pad))]
    self%counts = [newton%iterations, newton%factorizations, newton%factorizations_before]
  end subroutine save

  !> Brings the bearing back to the answer.
  subroutine restore(self, bearing, newton)
    class(last_answer_type), intent(in) :: self !! the kept answer
    type(bearing_system_type), intent(inout) :: bearing !! that had it
    type(newton_type), intent(inout) :: newton !! its solver; gets the counts it had
    integer :: contacts, i

    call self%state%restore(bearing)
    contacts = size(self%contact)/size(bearing%pad)
    do i = 1, size(bearing%pad)
      bearing%pad(i)%foil%contacts%point = self%contact((i - 1)*contacts + 1:i*contacts)
    end do
    newton%iterations = self%counts(1)
    newton%factorizations = self%counts(2)
    newton%factorizations_before = self%counts(3)
  end subroutine restore

  !> Frees what PETSc holds.
  subroutine destroy(self)
    class(last_answer_type), intent(inout) :: self !! not used any more

    call self%state%destroy()
    self%known = .false.
  end subroutine destroy
end module gfb_last_answer
