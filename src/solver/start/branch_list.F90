#include "gfb_petsc.h"
!> The equilibria of a bearing that a search has found, and which of them is asked for.
module gfb_branch_list
  use petscvec
  use gfb_kinds, only: wp
  use gfb_text, only: text
  use gfb_operating_point, only: operating_point_type
  use gfb_bearing_system, only: bearing_system_type
  use gfb_bearing_answer, only: bearing_answer_type, bearing_answer
  use gfb_newton, only: newton_type
  implicit none (type)
  private
  public :: take_branch, destroy_branches, lifts_of_pads

  real(wp), parameter :: same_state = 1.0e-4_wp !! largest difference of scaled unknowns of one and the same [1]
  real(wp), parameter :: same_lifts = 1.0e-10_wp !! of midplane and ends, that are not told apart [m]
  real(wp), parameter :: micrometres = 1.0e6_wp !! in a metre

  !> An equilibrium.
  type, public :: branch_type
    Vec :: state                 !! scaled
    type(bearing_answer_type) :: answer
    integer :: pulled_pad = 0 !! whose edge led there; 0: none
  end type branch_type

  !> What is looked for, and what was found; the first is where the search began.
  type, public :: branch_search_type
    logical :: given(2) = .false.    !! lifts asked for at the midplane, at the bearing's ends
    real(wp), allocatable :: wanted(:, :) !! (2, pads) them [m]
    integer :: pulled_pad = 0        !! whose edge is pulled now; 0: none
    real(wp) :: close_enough = 0.0_wp !! to them [m]
    real(wp) :: lifts(2) = 0.0_wp    !! of the free edge, the smallest and the largest looked at [m]
    type(branch_type), allocatable :: branch(:)
  contains
    procedure :: wanted_of
    procedure :: nearest_branch
    procedure :: is_found
    procedure :: collect
  end type branch_search_type

contains

  !> Keeps the bearing's present answer unless it is known.
  subroutine collect(self, bearing, newton)
    class(branch_search_type), intent(inout) :: self !! the search
    type(bearing_system_type), intent(in) :: bearing !! in equilibrium
    type(newton_type), intent(in) :: newton          !! its solver, whose log tells of a new one
    type(branch_type) :: new
    real(wp) :: difference
    Vec :: work
    integer :: i
    logical :: known
    PetscErrorCode :: ierr

    if (.not. allocated(self%branch)) allocate (self%branch(0))
    PetscCallA(VecDuplicate(bearing%state, work, ierr))
    known = .false.
    do i = 1, size(self%branch)
      PetscCallA(VecWAXPY(work, -1.0_wp, self%branch(i)%state, bearing%state, ierr))
      PetscCallA(VecNorm(work, NORM_INFINITY, difference, ierr))
      known = known .or. difference < same_state
    end do
    if (known) then
      PetscCallA(VecDestroy(work, ierr))
      return
    end if
    PetscCallA(VecCopy(bearing%state, work, ierr))
    new%state = work
    new%answer = bearing_answer(bearing)
    new%pulled_pad = self%pulled_pad
    self%branch = [self%branch, new]
    associate (answer => new%answer, clearance => bearing%pad(1)%film%clearance)
      call newton%log%line('equilibrium '//text(size(self%branch))//': e/C ('// &
                           text(answer%eccentricity(1)/clearance, 5)//', '//text(answer%eccentricity(2)/clearance, 5)// &
                           '), leading edge lifted '//lifts(answer%leading_edge_lift)//', trailing '// &
                           lifts(answer%trailing_edge_lift)//' um (midplane, ends)'//lifts_of_pads(answer%pad_lift))
    end associate
  end subroutine collect

  !> Lifts of the leading edges of several pads [um], at the midplane, and at the ends where they differ; nothing of one.
  pure function lifts_of_pads(lift) result(words)
    real(wp), intent(in) :: lift(:, :) !! (2, pads) [m]
    character(len=:), allocatable :: words
    integer :: pad

    words = ''
    if (size(lift, 2) == 1) return
    words = ', by pads'
    do pad = 1, size(lift, 2)
      words = words//' '//text(lift(1, pad)*micrometres, 4)
      if (abs(lift(2, pad) - lift(1, pad)) > same_lifts) words = words//' ('//text(lift(2, pad)*micrometres, 4)//')'
    end do
    words = words//' um'
  end function lifts_of_pads

  !> Two lifts [um].
  pure function lifts(value) result(words)
    real(wp), intent(in) :: value(2) !! [m]
    character(len=:), allocatable :: words
    words = '('//text(value(1)*micrometres, 3)//', '//text(value(2)*micrometres, 3)//')'
  end function lifts

  !> Mean lift of a pad's leading edge that is asked for [m].
  pure function wanted_of(self, pad) result(mean)
    class(branch_search_type), intent(in) :: self !! the search
    integer, intent(in) :: pad !! its number
    real(wp) :: mean
    mean = sum(self%wanted(:, pad), mask=self%given)/real(count(self%given), wp)
  end function wanted_of

  !> The equilibrium whose leading edge is lifted most nearly as asked for.
  pure function nearest_branch(self) result(number)
    class(branch_search_type), intent(in) :: self !! the search
    integer :: number
    integer :: i

    number = minloc([(distance(self, i), i=1, size(self%branch))], 1)
  end function nearest_branch

  !> Whether one that was asked for has been found.
  pure function is_found(self) result(found)
    class(branch_search_type), intent(in) :: self !! the search
    logical :: found

    found = .false.
    if (.not. allocated(self%branch)) return
    if (any(self%given)) found = distance(self, self%nearest_branch()) <= self%close_enough
  end function is_found

  !> How far an equilibrium's lifts are from those asked for [m].
  pure function distance(search, number)
    type(branch_search_type), intent(in) :: search
    integer, intent(in) :: number
    real(wp) :: distance
    distance = maxval(abs(search%branch(number)%answer%pad_lift - search%wanted), &
                      mask=spread(search%given, 2, size(search%wanted, 2)))
  end function distance

  !> Puts the bearing on a branch.
  subroutine take_branch(bearing, point, branch)
    type(bearing_system_type), intent(inout) :: bearing !! is put on the branch
    type(operating_point_type), intent(in) :: point !! of the branches
    type(branch_type), intent(in) :: branch         !! one that was found on this bearing

    bearing%point = point
    bearing%shaft_fixed = .false. ! as a search that has failed may have left it
    call bearing%return_to(branch%state)
  end subroutine take_branch

  !> Frees what PETSc holds.
  subroutine destroy_branches(search)
    type(branch_search_type), intent(inout) :: search !! is empty then
    integer :: i
    PetscErrorCode :: ierr

    if (.not. allocated(search%branch)) return
    do i = 1, size(search%branch)
      PetscCallA(VecDestroy(search%branch(i)%state, ierr))
    end do
    deallocate (search%branch)
  end subroutine destroy_branches
end module gfb_branch_list
