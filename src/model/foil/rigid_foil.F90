#include "gfb_petsc.h"
!> A rigid bearing surface: no unknowns, no deflection.
module gfb_rigid_foil
  use petscmat
  use gfb_kinds, only: wp
  use gfb_foil_model, only: foil_model_type
  implicit none (type)
  private
  public :: create_rigid_foil

  !> The foil that does not move.
  type, extends(foil_model_type), public :: rigid_foil_type
  contains
    procedure :: add_residual => rigid_residual
    procedure :: add_jacobian => rigid_jacobian
    procedure :: estimate => rigid_estimate
  end type rigid_foil_type

contains

  !> A rigid surface under a film.
  subroutine create_rigid_foil(nodes, foil)
    integer, intent(in) :: nodes !! film nodes of this rank
    type(rigid_foil_type), intent(out) :: foil

    allocate (foil%global_unknown(0), foil%unknown_scale(0), foil%equation_scale(0))
    allocate (foil%row_entries(0))
    allocate (foil%source(nodes), source=0)
    allocate (foil%rate(nodes), foil%origin(nodes), source=0.0_wp)
  end subroutine create_rigid_foil

  !> Nothing to add: the surface has no equations.
  subroutine rigid_residual(self, unknown, residual)
    class(rigid_foil_type), intent(in) :: self
    real(wp), intent(in) :: unknown(:)
    real(wp), intent(inout) :: residual(:)
  end subroutine rigid_residual

  !> Nothing to add: the surface has no equations.
  subroutine rigid_jacobian(self, unknown, jacobian)
    class(rigid_foil_type), intent(in) :: self
    real(wp), intent(in) :: unknown(:)
    Mat, intent(in) :: jacobian
  end subroutine rigid_jacobian

  !> Nothing to estimate: the surface has no unknowns.
  subroutine rigid_estimate(self, unknown)
    class(rigid_foil_type), intent(in) :: self
    real(wp), intent(inout) :: unknown(:)
  end subroutine rigid_estimate
end module gfb_rigid_foil
