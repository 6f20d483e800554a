#include "gfb_petsc.h"
!> Follows a branch of answers by its own length, round the folds where the path's parameter turns.
!>
!> A step from an answer \( x_0 \) goes along the tangent \( t \), and ends where
!> \( t \cdot (x - x_0) = s \) ([Riks1979]). The sign of the determinant of the equations bordered by the
!> tangent is the same all along a branch: it tells the tangent's sense.
!>
!> Where contacts open or close the branch has corners; a step round one goes along the penetration of
!> the contact that changes, which grows evenly while all else may turn back.
module gfb_arc_length
  use petscvec
  use gfb_kinds, only: wp
  use gfb_operating_point, only: operating_point_type
  use gfb_bearing_system, only: bearing_system_type
  use gfb_bearing_directions, only: contact_direction
  use gfb_newton, only: newton_type, newton_report_type, solve_newton, find_determinant_sign, solve_with_factors
  use gfb_arc, only: arc_type, create_arc, first_step, shortest_step, longest_step, least_start, cut, lambda_weight, &
                     hasty_iterations
  implicit none (type)
  private
  public :: begin_arc, advance_arc

  real(wp), parameter :: growth = 2.0_wp
  real(wp), parameter :: sharpest_turn = 0.5_wp    !! cosine between successive steps
  real(wp), parameter :: beyond_opening = 1.0e-3_wp !! of a contact, over the clearance [1]
  real(wp), parameter :: beyond_closing = 1.0e-6_wp !! the same, its penetration
  integer, parameter :: corner_attempts = 4
  real(wp), parameter :: longest_leap = 5.0_wp     !! round a corner, over the last step
  real(wp), parameter :: near = 0.2_wp             !! a change of contact that is turned round at once, over the step
  real(wp), parameter :: short_of_it = 0.9_wp      !! of the distance to a change of contact
  real(wp), parameter :: closer = 0.1_wp        !! beyond after a failure, over that before
  integer, parameter :: easy_iterations = 6        !! after a step that took no more the next is longer
  integer, parameter :: corner_iterations = 25     !! at most, of a step round a corner

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
    if (easy) arc%step = min(arc%step_limit, growth*arc%step)
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
    arc%newton%settings%maximum_iterations = hasty_iterations
  end subroutine turn_corner

  !> Whether a step round a corner is not a leap to another branch.
  function stays_near(arc) result(near_by)
    type(arc_type), intent(inout) :: arc
    logical :: near_by
    near_by = arc%path_length() <= min(longest_step, longest_leap*max(arc%last_length, least_start))
  end function stays_near

end module gfb_arc_length
