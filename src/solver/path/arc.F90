#include "gfb_petsc.h"
!> A branch of answers that is followed by its own length: where it is, how it is measured, and how to
!> put the bearing on it.
!>
!> The measure is the mean square of the scaled unknowns, with a small weight for the parameter.
!>
!> Follows a branch of answers by its own length, round the folds where the path's parameter turns.
!>
!> A step from an answer \( x_0 \) goes along the tangent \( t \), and ends where
!> \( t \cdot (x - x_0) = s \) ([Riks1979]). The sign of the determinant of the equations bordered by the
!> tangent is the same all along a branch: it gives the tangent's sense.
!>
!> Where contacts open or close the branch has corners; a step round one goes along the penetration of
!> the contact that changes, which grows evenly while all else may turn back.
module gfb_arc
  use petscvec
  use gfb_kinds, only: wp
  use gfb_operating_point, only: operating_point_type
  use gfb_bearing_system, only: bearing_system_type, path_order
  use gfb_bearing_directions, only: contact_direction
  use gfb_newton, only: newton_type, newton_report_type, solve_newton, find_determinant_sign, solve_with_factors, create_newton, &
                        destroy_newton, visit_counts
  use gfb_archive, only: archive_type
  use gfb_natural_order, only: natural_order_type, visit_vector
  use gfb_bordered_system, only: bordered_system_type, create_bordered_system, destroy_bordered_system
  implicit none (type)
  private
  public :: begin_arc, advance_arc, create_arc, end_arc, visit_arc, visit_steps

  real(wp), parameter :: sharpest_turn = 0.5_wp    !! cosine between successive steps
  real(wp), parameter :: beyond_opening = 1.0e-3_wp !! of a contact, over the clearance [1]
  real(wp), parameter :: beyond_closing = 1.0e-6_wp !! the same, its penetration
  integer, parameter :: corner_attempts = 4
  real(wp), parameter :: longest_leap = 5.0_wp     !! round a corner, over the last step
  real(wp), parameter :: near = 0.2_wp             !! a change of contact that is turned round at once, over the step
  real(wp), parameter :: short_of_it = 0.9_wp      !! of the distance to a change of contact
  real(wp), parameter :: closer = 0.1_wp        !! beyond after a failure, over that before
  integer, parameter :: easy_iterations = 6        !! after a step that took no more the next is doubled
  integer, parameter :: corner_iterations = 25     !! at most, of a step round a corner

  real(wp), parameter :: first_step = 1.0e-3_wp
  real(wp), parameter :: shortest_step = 1.0e-7_wp
  real(wp), parameter :: longest_step = 0.05_wp
  real(wp), parameter :: least_start = 5.0e-4_wp   !! to which a step after a very short one is lengthened
  real(wp), parameter :: cut = 0.3_wp              !! of a step that failed
  real(wp), parameter :: lambda_weight = 1.0e-2_wp  !! of the parameter in the measure [1]
  integer, parameter :: max_iterations = 12        !! more are not given to a step
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
    procedure :: between, return_to, nears_fold, to_turn, path_length, length_of, weigh
  end type arc_type

contains

  !> Begins at the bearing's present answer, on the path to another point.
  subroutine begin_arc(bearing, newton, last, sense, arc)
    type(bearing_system_type), target, intent(inout) :: bearing !! pads and shaft
    type(newton_type), intent(in) :: newton !! of the bearing: its settings
    type(operating_point_type), intent(in) :: last !! end of the path
    real(wp), intent(in) :: sense !! +1: towards that point, -1: away from it [1]
    type(arc_type), target, intent(inout) :: arc !! a branch, followed
    PetscErrorCode :: ierr

    call create_arc(bearing, newton, last, arc)
    PetscCallA(VecCopy(arc%path%state, arc%previous, ierr))
    call start_along_path(arc, sense)
    PetscCallA(VecCopy(arc%tangent, arc%previous_tangent, ierr))
  end subroutine begin_arc

  !> The first direction is the one in which the path goes in the sense asked for.
  subroutine start_along_path(arc, sense)
    type(arc_type), target, intent(inout) :: arc
    real(wp), intent(in) :: sense
    PetscErrorCode :: ierr

    PetscCallA(VecSet(arc%tangent, 0.0_wp, ierr))
    call arc%path%set_lambda(arc%tangent, sense/sqrt(lambda_weight))
    arc%orientation = 0
    call find_tangent(arc)
    arc%step = first_step
    arc%steps = 0
    arc%lambda = 0.0_wp
    arc%lambda_before = 0.0_wp
  end subroutine start_along_path

  !> The branch's direction at the last answer, of length one, in the sense in which it is followed:
  !> \( f_x t_x + f_\lambda t_\lambda = 0 \), and one along the last direction.
  subroutine find_tangent(arc)
    type(arc_type), target, intent(inout) :: arc
    integer :: sense
    real(wp) :: length
    PetscErrorCode :: ierr

    call arc%weigh(arc%tangent, arc%path%direction)
    call find_determinant_sign(arc%newton, sense)
    if (sense == 0) return
    if (arc%orientation == 0) arc%orientation = sense
    PetscCallA(VecSet(arc%work, 0.0_wp, ierr))
    call arc%path%set_lambda(arc%work, 1.0_wp)
    call solve_with_factors(arc%newton, arc%work, arc%tangent)
    length = arc%length_of(arc%tangent)
    PetscCallA(VecScale(arc%tangent, real(sense*arc%orientation, wp)/length, ierr))
  end subroutine find_tangent

  !> One step along the branch; the bearing is at the new answer, or where it was.
  subroutine advance_arc(arc, moved)
    type(arc_type), target, intent(inout) :: arc !! a branch, followed
    logical, intent(out) :: moved !! some contact was
    real(wp) :: length, lambda
    logical :: easy
    PetscErrorCode :: ierr

    call remember(arc)
    PetscCallA(VecCopy(arc%path%state, arc%path%base, ierr))
    call find_next_change(arc)
    moved = .false.
    easy = .false.
    if (arc%next_change < near*arc%step) call turn_corner(arc, moved)
    do while (.not. moved .and. arc%step >= shortest_step)
      call try_step(arc, moved, easy)
      if (.not. moved) arc%step = min(cut*arc%step, max(short_of_it*arc%next_change, cut**3*arc%step))
    end do
    if (.not. moved) call turn_corner(arc, moved)
    if (.not. moved) then
      PetscCallA(VecCopy(arc%path%base, arc%path%state, ierr))
      lambda = arc%path%give()
      return
    end if
    lambda = arc%path%give()
    arc%turned = arc%steps > 0 .and. arc%heading*(lambda - arc%lambda) < 0.0_wp
    arc%heading = sign(1.0_wp, lambda - arc%lambda)
    arc%lambda_before = arc%lambda
    arc%lambda = lambda
    length = arc%path_length()
    arc%last_length = length
    call find_tangent(arc)
    arc%step = min(arc%step_limit, max(least_start, length))
    if (easy) arc%step = min(arc%step_limit, 2.0_wp*arc%step)
    arc%steps = arc%steps + 1
  end subroutine advance_arc

  !> Keeps the last answer but one, and how the branch led from there.
  subroutine remember(arc)
    type(arc_type), intent(inout) :: arc
    PetscErrorCode :: ierr

    PetscCallA(VecCopy(arc%previous, arc%earlier, ierr))
    PetscCallA(VecCopy(arc%previous_tangent, arc%earlier_tangent, ierr))
    PetscCallA(VecCopy(arc%path%state, arc%previous, ierr))
    PetscCallA(VecCopy(arc%tangent, arc%previous_tangent, ierr))
    arc%lambda_earlier = arc%lambda_before
    arc%earlier_step = arc%last_length
  end subroutine remember

  !> A step along the tangent.
  subroutine try_step(arc, moved, easy)
    type(arc_type), target, intent(inout) :: arc
    logical, intent(out) :: moved
    logical, intent(out) :: easy      !! it took few iterations
    type(newton_report_type) :: solved
    PetscErrorCode :: ierr

    call arc%weigh(arc%tangent, arc%path%direction)
    arc%path%step = arc%step
    PetscCallA(VecWAXPY(arc%path%state, arc%step, arc%tangent, arc%path%base, ierr))
    call solve_newton(arc%newton, solved)
    easy = solved%iterations <= easy_iterations
    moved = solved%converged
    if (moved) moved = arc%step >= sharpest_turn*arc%path_length()
  end subroutine try_step

  !> Where on the tangent a contact opens or closes, and the direction in which it comes on.
  subroutine find_next_change(arc)
    type(arc_type), intent(inout) :: arc
    Vec :: ahead, along
    real(wp) :: lambda
    PetscErrorCode :: ierr

    PetscCallA(VecDuplicate(arc%bearing%state, ahead, ierr))
    PetscCallA(VecDuplicate(arc%bearing%state, along, ierr))
    PetscCallA(VecWAXPY(arc%work, 1.0_wp, arc%tangent, arc%path%base, ierr))
    call arc%path%split(arc%work, ahead)
    PetscCallA(VecCopy(arc%path%base, arc%path%state, ierr))
    lambda = arc%path%give()
    call contact_direction(arc%bearing, ahead, along, arc%next_change, arc%distance, arc%closes)
    call arc%path%join(along, 0.0_wp, arc%coming)
    PetscCallA(VecDestroy(along, ierr))
    PetscCallA(VecDestroy(ahead, ierr))
  end subroutine find_next_change

  !> A step round a corner of the branch: those contacts that open or close next are moved on until
  !> they have.
  subroutine turn_corner(arc, moved)
    type(arc_type), target, intent(inout) :: arc
    logical, intent(out) :: moved
    type(newton_report_type) :: solved
    real(wp) :: beyond
    Vec :: start
    integer :: attempt
    PetscErrorCode :: ierr

    arc%newton%settings%maximum_iterations = corner_iterations
    PetscCallA(VecDuplicate(arc%path%base, start, ierr))
    PetscCallA(VecCopy(arc%path%base, start, ierr))
    call arc%newton%log%detail('corner of the branch: contacts that change are moved on')
    moved = .false.
    beyond = merge(beyond_closing, beyond_opening, arc%closes)
    PetscCallA(VecCopy(arc%coming, arc%path%direction, ierr))
    attempt = 0
    do while (.not. moved .and. attempt < corner_attempts)
      attempt = attempt + 1
      PetscCallA(VecCopy(start, arc%path%base, ierr))
      PetscCallA(VecCopy(start, arc%path%state, ierr))
      arc%path%step = arc%distance + beyond
      call solve_newton(arc%newton, solved)
      moved = solved%converged
      if (moved) moved = stays_near(arc)
      beyond = closer*beyond
    end do
    if (.not. moved) then
      PetscCallA(VecCopy(start, arc%path%base, ierr))
    end if
    PetscCallA(VecDestroy(start, ierr))
    arc%newton%settings%maximum_iterations = max_iterations
  end subroutine turn_corner

  !> Whether a step round a corner is not a leap to another branch.
  logical function stays_near(arc) result(near_by)
    type(arc_type), intent(inout) :: arc
    near_by = arc%path_length() <= min(longest_step, longest_leap*max(arc%last_length, least_start))
  end function stays_near

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
    arc%newton%settings%maximum_iterations = min(max_iterations, newton%settings%maximum_iterations)
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
  real(wp) function path_length(self) result(length)
    class(arc_type), intent(inout) :: self !! the arc
    PetscErrorCode :: ierr

    PetscCallA(VecWAXPY(self%work, -1.0_wp, self%path%base, self%path%state, ierr))
    length = self%length_of(self%work)
  end function path_length

  !> Length of a vector in the arc's measure.
  real(wp) function length_of(self, vector) result(length)
    class(arc_type), intent(in) :: self !! the arc
    Vec, intent(in) :: vector !! of all ranks
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
    if (archive%saves) return
    call archive%require(abs(arc%lambda - arc%path%lambda_of(arc%path%state)) <= 0.0_wp, 'where the branch is')
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
    if (archive%saves) return
    call archive%require(min(arc%step, arc%step_limit) > 0.0_wp .and. max(arc%step, arc%step_limit) <= longest_leap .and. &
                         min(arc%last_length, arc%earlier_step) >= 0.0_wp .and. abs(arc%heading) > 0.0_wp, 'a step of the branch')
    call archive%require(min(arc%steps, arc%retreats) >= 0 .and. abs(arc%orientation) <= 1, 'a count of the branch')
  end subroutine visit_steps
end module gfb_arc
