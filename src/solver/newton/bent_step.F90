#include "gfb_petsc.h"
!> Newton's step, bent wherever a contact opens or closes along it.
!>
!> With contact forces that are straight lines on either side of first touch, the equations linearised at
!> a state are linear on pieces. A path leads from there on which their residual falls in proportion,
!> \( r(x(t)) = (1 - t) r_0 \). It is straight until a contact changes its state; there the matrix changes
!> by a dyad, \( J + C B^T \), and the path's new direction follows from the step by the formula of Sherman,
!> Morrison and Woodbury, with one more solution by the factors that there are. At \( t = 1 \) all contacts
!> agree with the step, and Newton's method does not alternate among their states. Where the determinant
!> changes its sign, as at a fold, the path goes on with t that falls for a while.
!>
!> Source: J. Katzenelson, Bell System Technical Journal 44 (1965) 1605-1620; the search back along the path
!> instead of the chord: D. Ralph, Mathematics of Operations Research 19 (1994) 352-389.
module gfb_bent_step
  use petscsnes
  use gfb_kinds, only: wp
  use gfb_nonlinear_system, only: nonlinear_system_type, contact_name
  implicit none (type)
  private
  public :: bend_step, state_on_path, destroy_bent_step

  integer, parameter :: most_pieces = 400        !! of a path
  integer, parameter :: most_contacts = 120      !! that change along it

  !> A path of pieces: x - t y + sum of shares times bends.
  type, public :: bent_step_type
    integer :: changes = 0          !! of contacts along it
    real(wp) :: reached = 1.0_wp    !! the largest t [1]
    real(wp) :: length = 1.0_wp     !! of the path up to there; t, where it never falls [1]
    integer, private :: contacts = 0                         !! those that change
    integer, private :: name(contact_name, most_contacts) = 0 !! theirs
    type(tVec), private :: bend(most_contacts)               !! J^-1 C
    type(tVec), private :: row(most_contacts)                !! B
    real(wp), allocatable, private :: matrix(:, :)           !! B^T J^-1 C
    real(wp), private :: along(most_contacts) = 0.0_wp       !! B^T y
    real(wp), allocatable, private :: length_at(:)           !! where pieces end, of the path [1]
    real(wp), allocatable, private :: t_at(:)                !! and of t [1]
    real(wp), allocatable, private :: share_at(:, :)         !! (contacts, pieces) of each bend
  end type bent_step_type

contains

  !> Follows a step from its beginning to its end, or to where no path continues.
  subroutine bend_step(snes, system, x, y, path, ierr)
    SNES, intent(in) :: snes !! with factors of the matrix at x
    class(nonlinear_system_type), intent(inout) :: system !! the equations
    Vec, intent(in) :: x, y !! where the step begins, and what it subtracts
    type(bent_step_type), intent(inout) :: path !! a new one
    PetscErrorCode, intent(out) :: ierr !! PETSc's error code, 0 for none
    Vec :: here, direction
    real(wp) :: piece, length, t, sense, share(most_contacts), slope(most_contacts)
    logical :: can, switched(most_contacts), leads_on
    integer :: name(contact_name), best

    ierr = 0
    call system%begin_path(can)
    if (.not. can) return
    allocate (path%matrix(most_contacts, most_contacts), path%length_at(0:most_pieces), path%t_at(0:most_pieces), &
              path%share_at(most_contacts, 0:most_pieces))
    PetscCall(VecDuplicate(x, here, ierr))
    PetscCall(VecDuplicate(x, direction, ierr))
    PetscCall(VecCopy(x, here, ierr))
    PetscCall(VecCopy(y, direction, ierr))
    length = 0.0_wp
    t = 0.0_wp
    sense = 1.0_wp
    share = 0.0_wp
    slope = 0.0_wp
    switched = .false.
    do
      call system%next_change(here, direction, piece, name)
      piece = min(piece, merge(1.0_wp - t, 1.0_wp + t, sense > 0.0_wp)) ! as far back as forward
      PetscCall(VecAXPY(here, -piece, direction, ierr))
      length = length + piece
      t = t + sense*piece
      share = share + sense*piece*slope
      path%length_at(path%changes) = length
      path%t_at(path%changes) = t
      path%share_at(:, path%changes) = share
      if (t >= 1.0_wp .or. t <= -1.0_wp .or. path%changes == most_pieces) exit
      call turn(snes, system, name, y, path, switched, slope, direction, sense, leads_on, ierr)
      CHKERRQ(ierr)
      if (.not. leads_on) exit
      path%changes = path%changes + 1
    end do
    best = maxloc(path%t_at(:path%changes), 1) - 1
    path%reached = path%t_at(best)
    path%length = path%length_at(best)
    PetscCall(VecDestroy(direction, ierr))
    PetscCall(VecDestroy(here, ierr))
  end subroutine bend_step

  !> The path's direction after a contact has changed its state.
  subroutine turn(snes, system, name, y, path, switched, slope, direction, sense, leads_on, ierr)
    SNES, intent(in) :: snes
    class(nonlinear_system_type), intent(inout) :: system
    integer, intent(in) :: name(:) !! of the contact
    Vec, intent(in) :: y
    type(bent_step_type), intent(inout) :: path
    logical, intent(inout) :: switched(:)  !! contacts that are not as they were in the beginning
    real(wp), intent(inout) :: slope(:)    !! of the bends' shares by t [1]
    Vec, intent(in) :: direction           !! replaced
    real(wp), intent(inout) :: sense       !! of t along it: 1 or -1
    logical, intent(out) :: leads_on       !! there is a direction
    PetscErrorCode, intent(out) :: ierr
    PetscReal :: before, now
    integer, allocatable :: list(:)
    integer :: i, contact

    call find_contact(snes, system, name, y, path, contact, ierr)
    CHKERRQ(ierr)
    leads_on = contact > 0
    if (.not. leads_on) return
    switched(contact) = .not. switched(contact)
    list = pack([(i, i=1, path%contacts)], switched(:path%contacts))
    slope = 0.0_wp
    slope(list) = solution_of(path%matrix(list, list), path%along(list))
    PetscCall(VecDot(path%row(contact), direction, before, ierr))
    PetscCall(VecCopy(y, direction, ierr))
    do i = 1, size(list)
      PetscCall(VecAXPY(direction, -slope(list(i)), path%bend(list(i)), ierr))
    end do
    PetscCall(VecDot(path%row(contact), direction, now, ierr))
    leads_on = abs(now) > 0.0_wp .and. abs(now) <= huge(now)
    if (.not. leads_on) return
    sense = sign(1.0_wp, before)*sign(1.0_wp, now) ! the contact moves on as it did
    PetscCall(VecScale(direction, sense, ierr))
  end subroutine turn

  !> The number of a contact among those of the path; a new one is solved for. None: 0.
  subroutine find_contact(snes, system, name, y, path, number, ierr)
    SNES, intent(in) :: snes
    class(nonlinear_system_type), intent(inout) :: system
    integer, intent(in) :: name(:)
    Vec, intent(in) :: y
    type(bent_step_type), intent(inout) :: path
    integer, intent(out) :: number
    PetscErrorCode, intent(out) :: ierr
    KSP :: linear
    Vec :: column
    PetscReal :: product
    integer :: i

    ierr = 0
    do number = path%contacts, 1, -1
      if (all(path%name(:, number) == name)) exit
    end do
    if (number == 0 .and. path%contacts == most_contacts) return
    PetscCall(VecDuplicate(y, column, ierr))
    if (number > 0) then
      call system%cross_change(column, column)
    else
      number = path%contacts + 1
      path%contacts = number
      path%name(:, number) = name
      PetscCall(VecDuplicate(y, path%row(number), ierr))
      PetscCall(VecDuplicate(y, path%bend(number), ierr))
      call system%cross_change(column, path%row(number))
      PetscCall(SNESGetKSP(snes, linear, ierr))
      PetscCall(KSPSolve(linear, column, path%bend(number), ierr))
      do i = 1, number
        PetscCall(VecDot(path%row(number), path%bend(i), product, ierr))
        path%matrix(number, i) = product
        PetscCall(VecDot(path%row(i), path%bend(number), product, ierr))
        path%matrix(i, number) = product
      end do
      PetscCall(VecDot(path%row(number), y, product, ierr))
      path%along(number) = product
    end if
    PetscCall(VecDestroy(column, ierr))
  end subroutine find_contact

  !> Solution of (I + matrix) s = right, by elimination with pivots.
  pure function solution_of(matrix, right) result(solution)
    real(wp), intent(in) :: matrix(:, :), right(:)
    real(wp) :: solution(size(right))
    real(wp) :: work(size(right) + 1, size(right)), row(size(right) + 1) ! a row in each column
    integer :: i, k, pivot, n

    n = size(right)
    work(:n, :) = transpose(matrix)
    work(n + 1, :) = right
    do k = 1, n
      work(k, k) = work(k, k) + 1.0_wp
    end do
    do k = 1, n
      pivot = k - 1 + maxloc(abs(work(k, k:)), 1)
      row = work(:, k)
      work(:, k) = work(:, pivot)
      work(:, pivot) = row
      do i = k + 1, n
        work(k + 1:, i) = work(k + 1:, i) - work(k, i)/work(k, k)*work(k + 1:, k)
      end do
    end do
    do k = n, 1, -1
      solution(k) = (work(n + 1, k) - dot_product(work(k + 1:n, k), solution(k + 1:)))/work(k, k)
    end do
  end function solution_of

  !> The state so far along the path.
  subroutine state_on_path(path, length, x, y, state, ierr)
    type(bent_step_type), intent(in) :: path !! of a step
    real(wp), intent(in) :: length !! of the path to there, at most its own [1]
    Vec, intent(in) :: x, y        !! where the step begins, and what it subtracts
    Vec, intent(in) :: state       !! overwritten
    PetscErrorCode, intent(out) :: ierr !! PETSc's error code, 0 for none
    real(wp) :: share(most_contacts), part, t
    integer :: i

    i = 0
    do while (i < path%changes)
      if (.not. path%length_at(i) < length) exit
      i = i + 1
    end do
    t = length
    share = 0.0_wp
    if (i > 0) then
      part = (length - path%length_at(i - 1))/max(path%length_at(i) - path%length_at(i - 1), tiny(1.0_wp))
      t = path%t_at(i - 1) + part*(path%t_at(i) - path%t_at(i - 1))
      share = path%share_at(:, i - 1) + part*(path%share_at(:, i) - path%share_at(:, i - 1))
    end if
    PetscCall(VecWAXPY(state, -t, y, x, ierr))
    do i = 1, path%contacts
      PetscCall(VecAXPY(state, share(i), path%bend(i), ierr))
    end do
  end subroutine state_on_path

  !> Frees what PETSc holds; may be called twice.
  subroutine destroy_bent_step(path)
    type(bent_step_type), intent(inout) :: path !! not used any more
    PetscErrorCode :: ierr
    integer :: i

    do i = 1, path%contacts
      PetscCallA(VecDestroy(path%bend(i), ierr))
      PetscCallA(VecDestroy(path%row(i), ierr))
    end do
    path%contacts = 0
    path%changes = 0
  end subroutine destroy_bent_step
end module gfb_bent_step
