#include "gfb_petsc.h"
!> The branch of equilibria beyond the end of a path.
!>
!> The free edge of the top foil is moved on instead, or the whole state as it last changed, and the operating point on the path
!> is what follows from it. Where the point turns back, the branch of answers folds: with a foil that leaves its bumps that is a
!> corner, where no small step along the path itself has an answer.
module gfb_branch_beyond
  use petscvec
  use gfb_kinds, only: wp
  use gfb_operating_point, only: operating_point_type
  use gfb_bearing_system, only: bearing_system_type
  use gfb_bearing_directions, only: edge_direction, has_free_edge
  use gfb_newton, only: newton_type, newton_report_type, create_newton, solve_newton, destroy_newton
  use gfb_bordered_system, only: bordered_system_type, create_bordered_system, destroy_bordered_system
  implicit none (type)
  private
  public :: look_beyond

  integer, parameter, public :: branch_lost = 0    !! nothing was found
  integer, parameter, public :: branch_continues = 1 !! answers there are beyond
  integer, parameter, public :: branch_folds = 2   !! the point turns back
  real(wp), parameter :: first_move = 1.0e-3_wp    !! of the edge, over the clearance [1]
  real(wp), parameter :: shortest_move = 1.0e-9_wp
  real(wp), parameter :: longest_change = 0.02_wp     !! of any unknown in a move; beyond, it is another branch
  real(wp), parameter :: closest_change = 2.0e-3_wp   !! of any unknown, that shows where a fold lies
  integer, parameter :: most_moves = 16            !! of contacts: more name a fold, and find no answer
  integer, parameter :: most_smooth_moves = 600    !! without contacts, where moves cost next to nothing
  integer, parameter :: easy_iterations = 6        !! a move that took no more of them is doubled
  integer, parameter :: max_iterations = 20          !! of a move, which can be cut

contains

  !> Moves the free edge on from an answer, or all of it, until the point is `wanted` ahead on the path, or turns
  !> back. On return the bearing is at the answer that lies farthest ahead.
  !>
  !> The edge moves on in the sense in which it moved; where that is not known, in both.
  subroutine look_beyond(bearing, newton, target, before, known, wanted, outcome, ahead)
    type(bearing_system_type), target, intent(inout) :: bearing !! pads and shaft
    type(newton_type), target, intent(inout) :: newton !! of the bearing: settings, and what is spent
    type(operating_point_type), intent(in) :: target   !! end of the path
    Vec, intent(in) :: before                !! the answer before the present one
    logical, intent(in) :: known             !! there is one
    real(wp), intent(in) :: wanted           !! share of the path from here to the target [1]
    integer, intent(out) :: outcome !! what was found
    real(wp), intent(out) :: ahead           !! share of that path that was gone [1]

    type(bordered_system_type), target :: path
    type(newton_type), target :: mover
    Vec :: farthest
    integer :: most
    PetscErrorCode :: ierr

    ahead = 0.0_wp
    outcome = branch_lost
    most = merge(most_moves, most_smooth_moves, bearing%has_contacts())
    call create_bordered_system(bearing, target, path)
    call create_newton(mover, path, 'bearing_', newton%settings, newton%log)
    mover%settings%maximum_iterations = min(mover%settings%maximum_iterations, max_iterations) ! a move can be cut
    PetscCallA(VecDuplicate(path%state, farthest, ierr))
    PetscCallA(VecCopy(path%state, farthest, ierr))
    if (has_free_edge(bearing)) then
      call aim_at_edge(bearing, path, before, known)
      call newton%log%detail('the free edge is moved on, the path follows')
      call move_on(path, mover, wanted, farthest, most, outcome, ahead)
      if (outcome == branch_folds .and. .not. known) then
        PetscCallA(VecScale(path%direction, -1.0_wp, ierr))
        call move_on(path, mover, wanted, farthest, most, outcome, ahead)
      end if
    end if
    if (outcome == branch_lost .and. known) then
      call aim_along_change(bearing, path, before)
      call newton%log%detail('the state is moved on as it changed, the path follows')
      call move_on(path, mover, wanted, farthest, most, outcome, ahead)
    end if
    PetscCallA(VecCopy(farthest, path%state, ierr))
    ahead = path%give()
    newton%iterations = newton%iterations + mover%iterations
    newton%factorizations = newton%factorizations + mover%factorizations
    PetscCallA(VecDestroy(farthest, ierr))
    call destroy_newton(mover)
    call destroy_bordered_system(path)
  end subroutine look_beyond

  !> Moves on in the path's direction.
  subroutine move_on(path, mover, wanted, farthest, most, outcome, ahead)
    type(bordered_system_type), intent(inout) :: path
    type(newton_type), target, intent(inout) :: mover
    real(wp), intent(in) :: wanted   !! share of the path [1]
    Vec, intent(in) :: farthest      !! answer that lies farthest ahead
    integer, intent(in) :: most      !! moves
    integer, intent(out) :: outcome
    real(wp), intent(inout) :: ahead !! its share of the path [1]
    type(newton_report_type) :: solved
    real(wp) :: move, lambda, change
    integer :: moves
    PetscErrorCode :: ierr

    outcome = branch_lost
    move = first_move
    moves = 0
    do while (outcome == branch_lost .and. moves < most .and. move >= shortest_move)
      moves = moves + 1
      PetscCallA(VecCopy(farthest, path%base, ierr))
      PetscCallA(VecCopy(farthest, path%state, ierr))
      path%step = move
      call solve_newton(mover, solved)
      lambda = path%lambda_of(path%state)
      PetscCallA(VecAXPY(path%base, -1.0_wp, path%state, ierr))
      PetscCallA(VecNorm(path%base, NORM_INFINITY, change, ierr))
      if (.not. solved%converged .or. change > longest_change) then
        move = 0.1_wp*move
      else if (lambda > ahead) then
        ahead = lambda
        PetscCallA(VecCopy(path%state, farthest, ierr))
        if (ahead >= wanted) outcome = branch_continues
        if (solved%iterations <= easy_iterations) move = 2.0_wp*move
      else
        if (change <= closest_change) outcome = branch_folds
        move = 0.25_wp*move
      end if
    end do
  end subroutine move_on

  !> Makes the mean displacement of the top foil's free edge, over the clearance, the path's length,
  !> in the sense in which it was moving.
  subroutine aim_at_edge(bearing, path, before, known)
    type(bearing_system_type), intent(inout) :: bearing
    type(bordered_system_type), intent(inout) :: path
    Vec, intent(in) :: before
    logical, intent(in) :: known
    Vec :: edge
    real(wp) :: was, is
    PetscErrorCode :: ierr

    PetscCallA(VecDuplicate(bearing%state, edge, ierr))
    call edge_direction(bearing, edge)
    PetscCallA(VecDot(edge, bearing%state, is, ierr))
    was = is
    if (known) then
      PetscCallA(VecDot(edge, before, was, ierr))
    end if
    if (is < was) then
      PetscCallA(VecScale(edge, -1.0_wp, ierr))
    end if
    call path%join(edge, 0.0_wp, path%direction)
    PetscCallA(VecDestroy(edge, ierr))
  end subroutine aim_at_edge

  !> Makes the way along the last change of the state the path's length, over that of its unknown that changed most.
  subroutine aim_along_change(bearing, path, before)
    type(bearing_system_type), intent(inout) :: bearing
    type(bordered_system_type), intent(inout) :: path
    Vec, intent(in) :: before
    Vec :: change
    real(wp) :: largest, product
    PetscErrorCode :: ierr

    PetscCallA(VecDuplicate(bearing%state, change, ierr))
    PetscCallA(VecWAXPY(change, -1.0_wp, before, bearing%state, ierr))
    PetscCallA(VecNorm(change, NORM_INFINITY, largest, ierr))
    PetscCallA(VecDot(change, change, product, ierr))
    if (product > 0.0_wp) then
      PetscCallA(VecScale(change, largest/product, ierr))
    end if
    call path%join(change, 0.0_wp, path%direction)
    PetscCallA(VecDestroy(change, ierr))
  end subroutine aim_along_change
end module gfb_branch_beyond
