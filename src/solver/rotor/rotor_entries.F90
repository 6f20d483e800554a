#include "gfb_petsc.h"
!> The rotor's entries of a vector of film, foil and rotor: the last ones of the first rank.
module gfb_rotor_entries
  use petscvec
  use gfb_kinds, only: wp
  use gfb_petsc_session, only: sum_over_ranks, this_rank
  use gfb_rotor, only: planar
  implicit none (type)
  private
  public :: take_rotor, put_rotor

  !> Sizes of the rotor's entries.
  type, public :: rotor_scale_type
    real(wp) :: length = 1.0_wp !! of its coordinates [m], [rad]
    real(wp) :: clock = 1.0_wp  !! of rates [1/s]
  end type rotor_scale_type

contains

  !> The rotor's coordinates and their rates out of a vector.
  subroutine take_rotor(scale, x, q, v)
    type(rotor_scale_type), intent(in) :: scale !! of the entries
    Vec, intent(in) :: x !! the vector
    real(wp), intent(out) :: q(planar) !! coordinates [m], [rad]
    real(wp), intent(out) :: v(planar) !! their rates [m/s], [rad/s]
    real(wp) :: both(2*planar)
    PetscScalar, pointer :: values(:)
    PetscErrorCode :: ierr

    both = 0.0_wp
    if (this_rank() == 0) then
      PetscCallA(GFB_VecGetArrayRead(x, values, ierr))
      both = values(size(values) - 2*planar + 1:)
      PetscCallA(GFB_VecRestoreArrayRead(x, values, ierr))
    end if
    both = sum_over_ranks(both)*scale%length
    q = both(:planar)
    v = both(planar + 1:)*scale%clock
  end subroutine take_rotor

  !> The reverse.
  subroutine put_rotor(scale, q, v, x)
    type(rotor_scale_type), intent(in) :: scale !! of the entries
    real(wp), intent(in) :: q(planar) !! coordinates [m], [rad]
    real(wp), intent(in) :: v(planar) !! their rates [m/s], [rad/s]
    Vec, intent(in) :: x !! the vector
    PetscScalar, pointer :: values(:)
    PetscErrorCode :: ierr

    if (this_rank() /= 0) return
    PetscCallA(GFB_VecGetArray(x, values, ierr))
    values(size(values) - 2*planar + 1:) = [q, v/scale%clock]/scale%length
    PetscCallA(GFB_VecRestoreArray(x, values, ierr))
  end subroutine put_rotor
end module gfb_rotor_entries
