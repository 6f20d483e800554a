#include "gfb_petsc.h"
!> The inertia of foils over a step of time, differenced twice as the shaft's is, and what they lose.
!>
!> With the weights of `gfb_backward_difference` and the mass M of the foils
!>
!> $$ M \ddot u \approx a_0^2 M (u - \hat u), \quad
!>    \hat u = u_1 - \frac{1}{a_0} \left( a_2 (u_2 - u_1) + \frac{a_1 \dot u_1 + a_2 \dot u_2}{a_0} \right): $$
!>
!> the foils would be at \( \hat u \) without any force. Film and shaft have neither row nor column in M. Modes inside
!> condensed pieces join in (`gfb_inner_motion`).
!>
!> Viscous losses of foils over a step of time, in proportion to their stiffness.
!>
!> With the matrix K of the foils' elastic forces, without contacts and film, and the loss time \( \tau \) the foils' equations
!> gain \( \tau \mathbf K \dot{\mathbf u} \): a loss factor \( \omega \tau \) in a vibration, and a power
!> \( \tau \dot{\mathbf u}^T \mathbf K \dot{\mathbf u} \ge 0 \) that is lost. What foils rest with, assembled or bent before, has no rate.
!> By the weights of `gfb_backward_difference`
!>
!> $$ \tau \mathbf K \dot{\mathbf u} \approx \tau a_0 \mathbf K (\mathbf u - \hat{\mathbf u}), \quad
!>    \hat{\mathbf u} = \mathbf u_1 - \frac{a_2}{a_0} (\mathbf u_2 - \mathbf u_1): $$
!>
!> of the past it needs two states, which the march keeps. Modes inside condensed pieces lose by themselves
!> (`gfb_inner_motion`).
module gfb_foil_momentum
  use petscmat
  use gfb_kinds, only: wp
  use gfb_inner_motion, only: inner_motion_type
  implicit none (type)
  private

  !> Mass of the foils, and what of their past a step needs; nothing where it is not begun.
  type, public :: foil_momentum_type
    logical :: present = .false.
    real(wp), private :: share = 0.0_wp !! a_0 squared of the present step [1/s2]
    Mat, private :: mass             !! M, scaled as the bearing's matrix
    Vec, private :: free             !! scaled unknowns without forces on the foils
    Vec :: rate(2)                   !! of the scaled unknowns, now and one step ago [1/s]
    Vec, private :: way, force       !! work space: from there to a state; its inertia
    type(inner_motion_type) :: inner !! modes inside condensed pieces, where they have any
  contains
    procedure, non_overridable :: begin, prepare, carry, add_force, add_stiffness, destroy
  end type foil_momentum_type

  !> Losses of the foils; none where they are not begun.
  type, public :: foil_losses_type
    logical :: present = .false.
    real(wp) :: time = 0.0_wp           !! tau; 0 where they are not begun [s]
    real(wp), private :: share = 0.0_wp !! tau a_0 of the present step [1]
    Mat, private :: stiffness           !! K, scaled as the bearing's matrix
    Vec, private :: still               !! scaled unknowns without rates
    Vec, private :: way, force          !! work space: from there to a state; what is lost
  contains
    procedure, non_overridable :: begin => begin_losses
    procedure, non_overridable :: prepare => prepare_losses
    procedure, non_overridable :: add_force => add_losses
    procedure, non_overridable :: add_stiffness => add_viscosity
    procedure, non_overridable :: destroy => destroy_losses
  end type foil_losses_type

contains

  !> Begins at rest.
  subroutine begin(self, mass, state)
    class(foil_momentum_type), intent(inout) :: self !! nothing before
    Mat, intent(in) :: mass  !! scaled as the bearing's matrix; kept, and freed in the end
    Vec, intent(in) :: state !! a vector of its size
    PetscErrorCode :: ierr
    integer :: i

    self%mass = mass
    PetscCallA(VecDuplicate(state, self%free, ierr))
    PetscCallA(VecDuplicate(state, self%way, ierr))
    PetscCallA(VecDuplicate(state, self%force, ierr))
    do i = 1, size(self%rate)
      PetscCallA(VecDuplicate(state, self%rate(i), ierr))
      PetscCallA(VecSet(self%rate(i), 0.0_wp, ierr))
    end do
    self%share = 0.0_wp
    self%present = .true.
  end subroutine begin

  !> From now on the equations are those of a step.
  subroutine prepare(self, weight, loss_time, now, before)
    class(foil_momentum_type), intent(inout) :: self !! the foils' inertia
    real(wp), intent(in) :: weight(0:2) !! a_0, a_1, a_2 of the step [1/s]
    real(wp), intent(in) :: loss_time   !! tau of the losses of modes inside pieces [s]
    Vec, intent(in) :: now, before      !! scaled, at its beginning and one step earlier
    PetscErrorCode :: ierr

    self%share = weight(0)**2
    PetscCallA(VecWAXPY(self%way, -1.0_wp, now, before, ierr))
    PetscCallA(VecCopy(now, self%free, ierr))
    PetscCallA(VecAXPY(self%free, -weight(2)/weight(0), self%way, ierr))
    PetscCallA(VecAXPY(self%free, -weight(1)/self%share, self%rate(1), ierr))
    PetscCallA(VecAXPY(self%free, -weight(2)/self%share, self%rate(2), ierr))
    call self%inner%prepare(weight, loss_time)
  end subroutine prepare

  !> Ends a step: its rate becomes the newest.
  subroutine carry(self, weight, state, now, before)
    class(foil_momentum_type), intent(inout) :: self !! the foils' inertia
    real(wp), intent(in) :: weight(0:2) !! as in `prepare` [1/s]
    Vec, intent(in) :: state !! that the step led to, scaled
    Vec, intent(in) :: now, before !! as in `prepare`
    PetscErrorCode :: ierr

    PetscCallA(VecWAXPY(self%way, -1.0_wp, self%free, state, ierr))
    call self%inner%carry(weight, self%way)
    PetscCallA(VecCopy(self%rate(1), self%rate(2), ierr))
    PetscCallA(VecWAXPY(self%way, -1.0_wp, now, before, ierr))
    PetscCallA(VecWAXPY(self%rate(1), -1.0_wp, now, state, ierr))
    PetscCallA(VecAXPBY(self%rate(1), weight(2), weight(0), self%way, ierr))
  end subroutine carry

  !> Adds the inertia at a state.
  subroutine add_force(self, state, residual)
    class(foil_momentum_type), intent(inout) :: self !! the foils' inertia
    Vec, intent(in) :: state    !! scaled
    Vec, intent(in) :: residual !! of the bearing, scaled
    PetscErrorCode :: ierr

    if (.not. self%present) return
    PetscCallA(VecWAXPY(self%way, -1.0_wp, self%free, state, ierr))
    PetscCallA(MatMult(self%mass, self%way, self%force, ierr))
    PetscCallA(VecAXPY(residual, self%share, self%force, ierr))
    call self%inner%add_force(self%way, residual)
  end subroutine add_force

  !> Adds its derivative.
  subroutine add_stiffness(self, jacobian)
    class(foil_momentum_type), intent(inout) :: self !! the foils' inertia
    Mat, intent(in) :: jacobian !! of the bearing, scaled
    PetscErrorCode :: ierr

    if (.not. self%present) return
    PetscCallA(MatAXPY(jacobian, self%share, self%mass, SAME_NONZERO_PATTERN, ierr))
    call self%inner%add_stiffness(jacobian)
  end subroutine add_stiffness

  !> Frees what PETSc holds; may be called twice.
  subroutine destroy(self)
    class(foil_momentum_type), intent(inout) :: self !! no inertia any longer
    PetscErrorCode :: ierr
    integer :: i

    if (.not. self%present) return
    do i = 1, size(self%rate)
      PetscCallA(VecDestroy(self%rate(i), ierr))
    end do
    PetscCallA(VecDestroy(self%force, ierr))
    PetscCallA(VecDestroy(self%way, ierr))
    PetscCallA(VecDestroy(self%free, ierr))
    PetscCallA(MatDestroy(self%mass, ierr))
    call self%inner%destroy()
    self%present = .false.
  end subroutine destroy

  !> Losses begin at rest.
  subroutine begin_losses(self, time, stiffness, state)
    class(foil_losses_type), intent(inout) :: self !! nothing before
    real(wp), intent(in) :: time  !! tau, positive [s]
    Mat, intent(in) :: stiffness  !! scaled as the bearing's matrix; kept, and freed in the end
    Vec, intent(in) :: state      !! a vector of its size
    PetscErrorCode :: ierr

    self%time = time
    self%stiffness = stiffness
    PetscCallA(VecDuplicate(state, self%still, ierr))
    PetscCallA(VecDuplicate(state, self%way, ierr))
    PetscCallA(VecDuplicate(state, self%force, ierr))
    self%share = 0.0_wp
    self%present = .true.
  end subroutine begin_losses

  !> From now on they are those of a step.
  subroutine prepare_losses(self, weight, now, before)
    class(foil_losses_type), intent(inout) :: self !! of the foils
    real(wp), intent(in) :: weight(0:2) !! a_0, a_1, a_2 of the step [1/s]
    Vec, intent(in) :: now, before      !! scaled, at its beginning and one step earlier
    PetscErrorCode :: ierr

    if (.not. self%present) return
    self%share = self%time*weight(0)
    PetscCallA(VecWAXPY(self%way, -1.0_wp, now, before, ierr))
    PetscCallA(VecWAXPY(self%still, -weight(2)/weight(0), self%way, now, ierr))
  end subroutine prepare_losses

  !> Adds what is lost at a state.
  subroutine add_losses(self, state, residual)
    class(foil_losses_type), intent(inout) :: self !! of the foils
    Vec, intent(in) :: state    !! scaled
    Vec, intent(in) :: residual !! of the bearing, scaled
    PetscErrorCode :: ierr

    if (.not. self%present) return
    PetscCallA(VecWAXPY(self%way, -1.0_wp, self%still, state, ierr))
    PetscCallA(MatMult(self%stiffness, self%way, self%force, ierr))
    PetscCallA(VecAXPY(residual, self%share, self%force, ierr))
  end subroutine add_losses

  !> Adds its derivative.
  subroutine add_viscosity(self, jacobian)
    class(foil_losses_type), intent(in) :: self !! of the foils
    Mat, intent(in) :: jacobian !! of the bearing, scaled
    PetscErrorCode :: ierr

    if (.not. self%present) return
    PetscCallA(MatAXPY(jacobian, self%share, self%stiffness, SAME_NONZERO_PATTERN, ierr))
  end subroutine add_viscosity

  !> Frees what PETSc holds; may be called twice.
  subroutine destroy_losses(self)
    class(foil_losses_type), intent(inout) :: self !! none any longer
    PetscErrorCode :: ierr

    if (.not. self%present) return
    PetscCallA(MatDestroy(self%stiffness, ierr))
    PetscCallA(VecDestroy(self%still, ierr))
    PetscCallA(VecDestroy(self%way, ierr))
    PetscCallA(VecDestroy(self%force, ierr))
    self%time = 0.0_wp
    self%present = .false.
  end subroutine destroy_losses
end module gfb_foil_momentum
