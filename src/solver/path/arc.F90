#include "gfb_petsc.h"
!> A branch of answers that is followed by its own length: where it is, how it is measured, and how to
!> put the bearing on it.
!>
!> The measure is the mean square of the scaled unknowns, with a small weight for the parameter.
module gfb_arc
  use petscvec
  use gfb_kinds, only: wp
  use gfb_archive, only: archive_type
  use gfb_natural_order, only: natural_order_type, visit_vector
  use gfb_operating_point, only: operating_point_type
  use gfb_bearing_system, only: bearing_system_type, path_order
  use gfb_newton, only: newton_type, newton_report_type, create_newton, solve_newton, destroy_newton, visit_counts
  use gfb_bordered_system, only: bordered_system_type, create_bordered_system, destroy_bordered_system
  implicit none (type)
  private
  public :: create_arc, end_arc, visit_arc, visit_steps

  real(wp), parameter, public :: first_step = 1.0e-3_wp
  real(wp), parameter, public :: shortest_step = 1.0e-7_wp
  real(wp), parameter, public :: longest_step = 0.05_wp
  real(wp), parameter, public :: least_start = 5.0e-4_wp   !! to which a step after a very short one is lengthened
  real(wp), parameter, public :: cut = 0.3_wp              !! of a step that failed
  real(wp), parameter, public :: lambda_weight = 1.0e-2_wp  !! of the parameter in the measure [1]
  integer, parameter, public :: hasty_iterations = 12      !! more are not given to a step
  real(wp), parameter :: sharp_fold = 1.0e-4_wp    !! change of the parameter about a fold that is passed [1]
  integer, parameter :: most_retreats = 6          !! before one, for shorter steps

  !> A branch and the last answer on it. Keep it where it is.
  type, public :: arc_type
    type(bordered_system_type) :: path
    type(newton_type) :: newton
    real(wp) :: lambda = 0.0_wp        !! lambda of the last answer
    real(wp) :: lambda_before = 0.0_wp !! of the one before
    integer :: steps = 0
    integer :: orientation = 0 !! sign of the determinant with the tangent in its sense
    real(wp) :: heading = 1.0_wp      !! sign of the last change of lambda
    logical :: turned = .false.       !! it changed in the last step
    type(bearing_system_type), pointer :: bearing => null()
    real(wp) :: step = first_step      !! to try next
    Vec :: tangent                    !! at the last answer, of length one
    real(wp) :: next_change = 0.0_wp !! on the tangent, where a contact opens or closes
    real(wp) :: distance = 0.0_wp     !! of that contact from it, over the clearance [1]
    real(wp) :: last_length = least_start !! length of the last step
    logical :: closes = .false.
    Vec :: coming            !! direction in which it comes on
    real(wp) :: lambda_earlier = 0.0_wp !! lambda of the answer before those two
    real(wp) :: earlier_step = 0.0_wp !! its length
    integer :: retreats = 0           !! before the fold ahead
    real(wp) :: step_limit = longest_step !! until that is passed
    Vec :: previous, earlier          !! the answers before the last one
    Vec :: previous_tangent, earlier_tangent !! tangents at the last answer, at the one before the last but one
    Vec :: work
  contains
    procedure :: between
    procedure :: return_to
    procedure :: nears_fold
    procedure :: to_turn
    procedure :: path_length
    procedure :: length_of
    procedure :: weigh
  end type arc_type

contains

  !> Prepares what an arc needs, on the path from the bearing's present point to another.
  subroutine create_arc(bearing, newton, last, arc)
    type(bearing_system_type), target, intent(inout) :: bearing !! pads and shaft
    type(newton_type), intent(in) :: newton !! of the bearing: its settings
    type(operating_point_type), intent(in) :: last !! end of the path
    type(arc_type), target, intent(inout) :: arc !! a branch, followed
    PetscErrorCode :: ierr

    arc%bearing => bearing
    call create_bordered_system(bearing, last, arc%path)
    call create_newton(arc%newton, arc%path, 'bearing_', newton%settings, newton%log)
    arc%newton%settings%maximum_iterations = min(hasty_iterations, newton%settings%maximum_iterations)
    PetscCallA(VecDuplicate(arc%path%state, arc%tangent, ierr))
    PetscCallA(VecDuplicate(arc%path%state, arc%work, ierr))
    PetscCallA(VecDuplicate(arc%path%state, arc%coming, ierr))
    PetscCallA(VecDuplicate(arc%path%state, arc%previous, ierr))
    PetscCallA(VecDuplicate(arc%path%state, arc%earlier, ierr))
    PetscCallA(VecDuplicate(arc%path%state, arc%previous_tangent, ierr))
    PetscCallA(VecDuplicate(arc%path%state, arc%earlier_tangent, ierr))
  end subroutine create_arc

  !> Puts the bearing between the last two answers.
  subroutine between(self, share)
    class(arc_type), intent(inout) :: self !! the arc
    real(wp), intent(in) :: share !! of the path from the one before the last to the last [1]
    real(wp) :: lambda
    PetscErrorCode :: ierr

    PetscCallA(VecCopy(self%path%state, self%work, ierr))
    PetscCallA(VecAXPBY(self%path%state, 1.0_wp - share, share, self%previous, ierr))
    lambda = self%path%give()
    PetscCallA(VecCopy(self%work, self%path%state, ierr))
  end subroutine between

  !> Puts the bearing back to the last answer.
  subroutine return_to(self)
    class(arc_type), intent(inout) :: self !! the arc
    real(wp) :: lambda
    lambda = self%path%give()
  end subroutine return_to

  !> Puts the bearing where lambda has just turned: at the answer before the last, or where a contact
  !> changed since then, if lambda went farther there.
  subroutine to_turn(self)
    class(arc_type), target, intent(inout) :: self !! the arc
    type(newton_report_type) :: solved
    real(wp) :: lambda
    PetscErrorCode :: ierr

    PetscCallA(VecCopy(self%path%state, self%earlier, ierr))
    PetscCallA(VecCopy(self%previous, self%path%base, ierr))
    PetscCallA(VecCopy(self%previous, self%path%state, ierr))
    if (self%next_change <= self%last_length) then
      PetscCallA(VecCopy(self%coming, self%path%direction, ierr))
      self%path%step = self%distance
      call solve_newton(self%newton, solved)
      lambda = self%path%lambda_of(self%path%state)
      if (solved%converged .and. self%heading*(lambda - self%lambda_before) < 0.0_wp) then
        self%lambda_before = lambda
      else
        PetscCallA(VecCopy(self%previous, self%path%state, ierr))
      end if
    end if
    lambda = self%path%give()
    PetscCallA(VecCopy(self%earlier, self%path%state, ierr))
  end subroutine to_turn

  !> Where lambda has just turned: goes back behind the turn to pass it in shorter steps, unless
  !> they are short already. Without that the turn is at `lambda_before`, to about the last step.
  subroutine nears_fold(self, again)
    class(arc_type), intent(inout) :: self !! the arc
    logical, intent(out) :: again !! the turn is still ahead
    PetscErrorCode :: ierr

    again = self%turned .and. self%retreats < most_retreats .and. &
      max(abs(self%lambda - self%lambda_before), abs(self%lambda_before - self%lambda_earlier)) > sharp_fold
    if (.not. again) then
      self%retreats = 0
      self%step_limit = longest_step
      return
    end if
    self%retreats = self%retreats + 1
    PetscCallA(VecCopy(self%earlier, self%path%state, ierr))
    PetscCallA(VecCopy(self%earlier_tangent, self%tangent, ierr))
    self%step = max(shortest_step, cut*min(self%step_limit, self%earlier_step, self%last_length))
    self%step_limit = self%step
    self%lambda = self%lambda_earlier
    self%heading = sign(1.0_wp, self%lambda_before - self%lambda_earlier)
    self%lambda_before = self%lambda_earlier
    self%turned = .false.
    call self%return_to()
  end subroutine nears_fold

  !> Length of the path from the base to the state.
  function path_length(self) result(length)
    class(arc_type), intent(inout) :: self !! the arc
    real(wp) :: length
    PetscErrorCode :: ierr

    PetscCallA(VecWAXPY(self%work, -1.0_wp, self%path%base, self%path%state, ierr))
    length = self%length_of(self%work)
  end function path_length

  !> Length of a vector in the arc's measure.
  function length_of(self, vector) result(length)
    class(arc_type), intent(in) :: self !! the arc
    Vec, intent(in) :: vector !! of all ranks
    real(wp) :: length
    Vec :: weighted
    PetscErrorCode :: ierr

    PetscCallA(VecDuplicate(vector, weighted, ierr))
    call self%weigh(vector, weighted)
    PetscCallA(VecDot(vector, weighted, length, ierr))
    PetscCallA(VecDestroy(weighted, ierr))
    length = sqrt(length)
  end function length_of

  !> A vector times the weights of the measure.
  subroutine weigh(self, vector, weighted)
    class(arc_type), intent(in) :: self !! the arc
    Vec, intent(in) :: vector !! of all ranks
    Vec, intent(in) :: weighted !! it, weighted
    real(wp) :: lambda
    PetscErrorCode :: ierr

    lambda = self%path%lambda_of(vector)
    PetscCallA(VecCopy(vector, weighted, ierr))
    PetscCallA(VecScale(weighted, 1.0_wp/real(self%bearing%unknowns, wp), ierr))
    call self%path%set_lambda(weighted, lambda_weight*lambda)
  end subroutine weigh

  !> Frees what PETSc holds; adds what was spent to the bearing's own Newton method.
  subroutine end_arc(arc, newton)
    type(arc_type), intent(inout) :: arc !! a branch, followed
    type(newton_type), intent(inout) :: newton !! of the bearing
    PetscErrorCode :: ierr

    newton%iterations = newton%iterations + arc%newton%iterations
    newton%factorizations = newton%factorizations + arc%newton%factorizations
    call destroy_newton(arc%newton)
    call destroy_bordered_system(arc%path)
    PetscCallA(VecDestroy(arc%tangent, ierr))
    PetscCallA(VecDestroy(arc%work, ierr))
    PetscCallA(VecDestroy(arc%coming, ierr))
    PetscCallA(VecDestroy(arc%previous, ierr))
    PetscCallA(VecDestroy(arc%earlier, ierr))
    PetscCallA(VecDestroy(arc%previous_tangent, ierr))
    PetscCallA(VecDestroy(arc%earlier_tangent, ierr))
  end subroutine end_arc

  !> Saves or restores an arc. All ranks ask.
  subroutine visit_arc(archive, arc)
    type(archive_type), intent(inout) :: archive !! that saves or restores
    type(arc_type), intent(inout) :: arc !! written where the archive restores, once it was created
    type(natural_order_type) :: order

    call visit_steps(archive, arc)
    order = path_order(arc%bearing)
    call visit_vector(archive, 'state', order, arc%path%state)
    call visit_vector(archive, 'previous', order, arc%previous)
    call visit_vector(archive, 'earlier', order, arc%earlier)
    call visit_vector(archive, 'tangent', order, arc%tangent)
    call visit_vector(archive, 'previous_tangent', order, arc%previous_tangent)
    call visit_vector(archive, 'earlier_tangent', order, arc%earlier_tangent)
  end subroutine visit_arc

  !> Of it all but the vectors.
  pure subroutine visit_steps(archive, arc)
    type(archive_type), intent(inout) :: archive !! that saves or restores
    type(arc_type), intent(inout) :: arc !! written where the archive restores

    call archive%visit('lambda', arc%lambda)
    call archive%visit('lambda_before', arc%lambda_before)
    call archive%visit('lambda_earlier', arc%lambda_earlier)
    call archive%visit('heading', arc%heading)
    call archive%visit('step', arc%step)
    call archive%visit('last_length', arc%last_length)
    call archive%visit('earlier_step', arc%earlier_step)
    call archive%visit('step_limit', arc%step_limit)
    call archive%visit('orientation', arc%orientation)
    call archive%visit('retreats', arc%retreats)
    call archive%visit('steps', arc%steps)
    call archive%visit('turned', arc%turned)
    call visit_counts(archive, arc%newton)
  end subroutine visit_steps
end module gfb_arc
