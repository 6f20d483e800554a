#include "gfb_petsc.h"
!> What Newton's method needs of a set of equations.
module gfb_nonlinear_system
  use petscmat
  use gfb_kinds, only: wp
  implicit none (type)
  private

  integer, parameter, public :: contact_name = 3 !! numbers that name a contact
  integer, parameter, public :: few_unknowns = 40000 !! of a matrix of low fill that each of several ranks factors whole

  !> Equations \( f(x) = 0 \) in scaled unknowns, with their exact derivative.
  type, abstract, public :: nonlinear_system_type
    Vec :: state    !! x, scaled; owned by the system
    Mat :: jacobian !! df/dx, scaled; owned by the system
    logical :: dense_rows = .false. !! a few equations hold almost all unknowns
    logical :: plane = .false.      !! unknowns stand at the nodes of a plane mesh
    logical :: low_fill = .false.   !! factors of the matrix stay sparse: a plane mesh with few unknowns a node
    !> of each unknown of one rank: it is coupled with its own layer and those beside it; 0: with all; else none
    integer, allocatable :: layer(:)
    logical :: symmetric = .false.  !! the matrix is, at every state
    logical :: definite = .false.   !! it is positive definite too, and says so to PETSc
    Mat :: motions  !! coarse space of an iterative solver, (unknowns, motions); owned by the system
    logical :: has_motions = .false. !! there is one
    logical :: slow_change = .false. !! matrices differ in few entries: lagged factors precondition well
    integer :: times_filled = 0     !! the matrix, by whomever
    logical :: settled = .true.     !! no contact is linearised away from where it is
  contains
    procedure :: settle, begin_step, virtual_work, begin_path, next_change, cross_change
    procedure(evaluate), deferred :: evaluate
    procedure(linearise), deferred :: linearise
  end type nonlinear_system_type

  abstract interface
    !> Residual at a state; `valid` is false on a rank that cannot evaluate it there.
    subroutine evaluate(self, state, residual, valid)
      import :: nonlinear_system_type, tVec
      class(nonlinear_system_type), intent(inout) :: self !! the equations
      Vec, intent(in) :: state    !! scaled
      Vec, intent(in) :: residual !! scaled
      logical, intent(out) :: valid !! the residual is there, on this rank
    end subroutine evaluate

    !> Fills the system's matrix with the derivative at a state.
    subroutine linearise(self, state)
      import :: nonlinear_system_type, tVec
      class(nonlinear_system_type), intent(inout) :: self !! the equations
      Vec, intent(in) :: state !! scaled
    end subroutine linearise
  end interface

contains

  !> Called after every step: linearisation points of contacts move. The residual
  !> changes with it. Says so in `moved`; here nothing does.
  subroutine settle(self, state, moved)
    class(nonlinear_system_type), intent(inout) :: self !! the equations
    Vec, intent(in) :: state !! scaled
    logical, intent(out) :: moved !! something may have moved: the residual is another
    moved = .false.
  end subroutine settle

  !> Called before every step; `settle` may be called for several trials of it. Here nothing is
  !> kept.
  subroutine begin_step(self)
    class(nonlinear_system_type), intent(inout) :: self !! the equations
  end subroutine begin_step

  !> Work of a structure's residual forces along a step, scaled; where a structure is in equilibrium
  !> it changes its sign along the step. Here there is none.
  real(wp) function virtual_work(self, residual, step) result(work)
    class(nonlinear_system_type), intent(in) :: self !! the equations
    Vec, intent(in) :: residual, step !! scaled
    work = 0.0_wp
  end function virtual_work

  !> A step is about to be followed along which contacts open and close; here none does.
  subroutine begin_path(self, can)
    class(nonlinear_system_type), intent(inout) :: self !! the equations
    logical, intent(out) :: can !! it can be followed
    can = .false.
  end subroutine begin_path

  !> How much of a step can be taken until a contact opens or closes, and which one that is.
  subroutine next_change(self, state, step, share, name)
    class(nonlinear_system_type), intent(inout) :: self !! the equations; they remember the contact
    Vec, intent(in) :: state !! scaled
    Vec, intent(in) :: step  !! subtracted from it, scaled
    real(wp), intent(out) :: share !! of the step, may be above 1; huge where none does [1]
    integer, intent(out) :: name(contact_name) !! of the contact, on all ranks
    share = huge(share)
    name = 0
  end subroutine next_change

  !> The contact that `next_change` found opens or closes: the matrix changes by the dyad of two vectors.
  subroutine cross_change(self, column, row)
    class(nonlinear_system_type), intent(inout) :: self !! the equations
    Vec, intent(in) :: column !! scaled; overwritten
    Vec, intent(in) :: row    !! scaled; overwritten
  end subroutine cross_change
end module gfb_nonlinear_system
