#include "gfb_petsc.h"
!> What the film needs to know of the foil under it, whatever the foil is.
!>
!> A foil has unknowns of its own, or none. Its deflection at each film node follows from one
!> unknown of the bearing: \( h_f = r (x - x_0) \). It adds its equations to those of the film.
module gfb_foil_model
  use petscmat
  use gfb_kinds, only: wp
  use gfb_cost_events, only: cost_events_type
  implicit none (type)
  private

  !> A foil model: deflection at the film nodes, equations, their derivatives.
  type, abstract, public :: foil_model_type
    integer :: owned = 0      !! unknowns of the foil this rank owns
    integer :: first = 0      !! local unknowns of the bearing before the foil's first
    integer :: couplings = 0  !! entries a film node's row needs for the foil, at most
    integer, allocatable :: row_entries(:) !! entries that the row of each owned unknown needs, at most
    logical :: has_elastic = .false. !! linear equations of its own, in `elastic`
    Mat :: elastic            !! their matrix, the foil's own numbers [SI]
    type(cost_events_type) :: events !! of PETSc's log
    integer, allocatable :: global_unknown(:)  !! foil's own number of each local unknown, by owners
    real(wp), allocatable :: unknown_scale(:)  !! size of each local unknown, in its unit
    real(wp), allocatable :: equation_scale(:) !! size of each local equation, in its unit
    !> Local unknown of the bearing that moves a film node, 0 where none does; until the foil's
    !> unknowns are placed, those of its own stand as negative numbers.
    integer, allocatable :: source(:)
    real(wp), allocatable :: rate(:)           !! r, deflection over that unknown
    real(wp), allocatable :: origin(:)         !! x_0, the unknown's value without deflection
  contains
    procedure(add_residual), deferred :: add_residual
    procedure(add_jacobian), deferred :: add_jacobian
    procedure(estimate), deferred :: estimate
    procedure :: add_constant
    procedure :: add_load_rates
    procedure :: settle
    procedure :: begin_step
    procedure :: set_hardness
    procedure :: set_adhesion
    procedure :: softest
    procedure :: crest_lengths
    procedure :: next_contact_change
    procedure :: add_penetration_rates
    procedure :: commit
    procedure :: destroy
    procedure :: place
    procedure :: local_unknowns
    procedure :: deflection
  end type foil_model_type

  abstract interface
    !> Adds the foil's equations to the local residual of the bearing.
    subroutine add_residual(self, unknown, residual)
      import :: foil_model_type, wp
      class(foil_model_type), intent(in) :: self
      real(wp), intent(in) :: unknown(:)     !! local unknowns of the bearing, in SI
      real(wp), intent(inout) :: residual(:) !! one a local unknown
    end subroutine add_residual

    !> Adds the derivatives of the foil's equations to the bearing's matrix, by local numbers.
    subroutine add_jacobian(self, unknown, jacobian)
      import :: foil_model_type, wp, tMat
      class(foil_model_type), intent(in) :: self
      real(wp), intent(in) :: unknown(:) !! local unknowns of the bearing, in SI
      Mat, intent(in) :: jacobian
    end subroutine add_jacobian

    !> Sets the foil's local unknowns to what suits the film's pressures, as a start value.
    subroutine estimate(self, unknown)
      import :: foil_model_type, wp
      class(foil_model_type), intent(in) :: self
      real(wp), intent(inout) :: unknown(:) !! local unknowns of the bearing, in SI
    end subroutine estimate
  end interface

contains

  !> Adds what never changes in the foil's part of the matrix, beside `elastic`, and makes room for
  !> what does; here nothing.
  subroutine add_constant(self, jacobian)
    class(foil_model_type), intent(in) :: self
    Mat, intent(in) :: jacobian
  end subroutine add_constant

  !> Adds what the foil's equations gain where more than the film loads it: a pressure at each film
  !> node that depends on up to three unknowns of the bearing. Here there are no such equations.
  subroutine add_load_rates(self, column, slope, jacobian)
    class(foil_model_type), intent(in) :: self
    integer, intent(in) :: column(:, :) !! (3, film nodes) local numbers from 0; negative: none
    real(wp), intent(in) :: slope(:, :) !! (3, film nodes) of the pressure by them
    Mat, intent(in) :: jacobian
  end subroutine add_load_rates

  !> Moves the contacts' places on their laws to where the foils have gone. `moved` where it has
  !> any; `settled` where each is linearised where it is. Here none.
  subroutine settle(self, unknown, moved, settled)
    class(foil_model_type), intent(inout) :: self
    real(wp), intent(in) :: unknown(:) !! local unknowns of the bearing, in SI
    logical, intent(out) :: moved, settled
    moved = .false.
    settled = .true.
  end subroutine settle

  !> Makes the contacts softer than the scene has them, for a first answer; here there are none.
  subroutine set_hardness(self, hardness)
    class(foil_model_type), intent(inout) :: self
    real(wp), intent(in) :: hardness !! factor of their normal stiffness
  end subroutine set_hardness

  !> Lets the contacts hold what they touch, for a first answer; here there are none.
  subroutine set_adhesion(self, adhesion)
    class(foil_model_type), intent(inout) :: self
    real(wp), intent(in) :: adhesion !! stiffness against opening over that against closing
  end subroutine set_adhesion

  !> The hardness to begin with, 1 where there is nothing to soften.
  pure function softest(self) result(hardness)
    class(foil_model_type), intent(in) :: self
    real(wp) :: hardness
    hardness = 1.0_wp
  end function softest

  !> Length of this rank's crest lines that touches nothing, and of all of them [m]; here there are
  !> none.
  pure function crest_lengths(self) result(length)
    class(foil_model_type), intent(in) :: self
    real(wp) :: length(2)
    length = 0.0_wp
  end function crest_lengths

  !> The part of the way between two states, or on beyond, after which the first of this rank's
  !> contacts opens or closes; huge where none does, as here.
  pure function next_contact_change(self, here, ahead) result(way)
    class(foil_model_type), intent(in) :: self
    real(wp), intent(in) :: here(:), ahead(:) !! local unknowns of the bearing, in SI
    real(wp) :: way
    way = huge(way)
  end function next_contact_change

  !> Adds up, for those contacts that change after that part of the way, the derivatives of their
  !> penetrations after the bearing's local unknowns, in the sense in which they go; and how far they
  !> go before they change. Here there are none.
  pure subroutine add_penetration_rates(self, here, ahead, way, rate, distance, closes)
    class(foil_model_type), intent(in) :: self
    real(wp), intent(in) :: here(:), ahead(:) !! local unknowns of the bearing, in SI
    real(wp), intent(in) :: way               !! part of the way to the first change [1]
    real(wp), intent(inout) :: rate(:)
    real(wp), intent(inout) :: distance       !! sum of the penetrations' sizes [m]
    logical, intent(inout) :: closes          !! one of them closes
  end subroutine add_penetration_rates

  !> A new Newton step begins where the contacts are; here none.
  subroutine begin_step(self)
    class(foil_model_type), intent(inout) :: self
  end subroutine begin_step

  !> Ends a load step of the scene: friction carries its slip along; here none.
  subroutine commit(self, unknown)
    class(foil_model_type), intent(inout) :: self
    real(wp), intent(in) :: unknown(:) !! local unknowns of the bearing, in SI
  end subroutine commit

  !> Frees what PETSc holds; here nothing.
  subroutine destroy(self)
    class(foil_model_type), intent(inout) :: self
  end subroutine destroy

  !> Tells the foil where its unknowns stand among those of the bearing.
  pure subroutine place(self, first)
    class(foil_model_type), intent(inout) :: self
    integer, intent(in) :: first !! local unknowns before the foil's first

    self%first = first
    where (self%source < 0) self%source = first - self%source
  end subroutine place

  !> Unknowns of the foil that this rank's nodes and equations need.
  pure function local_unknowns(self) result(unknowns)
    class(foil_model_type), intent(in) :: self
    integer :: unknowns
    unknowns = size(self%global_unknown)
  end function local_unknowns

  !> Deflection at the local film nodes, positive away from the shaft [m].
  pure function deflection(self, unknown) result(moved)
    class(foil_model_type), intent(in) :: self
    real(wp), intent(in) :: unknown(:) !! local unknowns of the bearing, in SI
    real(wp) :: moved(size(self%source))
    integer :: node

    moved = 0.0_wp
    do node = 1, size(moved)
      if (self%source(node) == 0) cycle
      moved(node) = self%rate(node)*(unknown(self%source(node)) - self%origin(node))
    end do
  end function deflection
end module gfb_foil_model
