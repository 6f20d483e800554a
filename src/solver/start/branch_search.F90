#include "gfb_petsc.h"
!> Other equilibria of a bearing, found by pulling at the top foil's free edge.
!>
!> A fictitious force lifts the edge. The answers with that force form a curve, followed by its own
!> length; wherever the force is zero on it, the bearing is in equilibrium by itself. The corners of a
!> foil of shells lift first. To find those equilibria too whose edge is lifted all along, a fictitious
!> string keeps the edge straight, and is released where the force is zero.
module gfb_branch_search
  use petscvec
  use gfb_kinds, only: wp
  use gfb_units, only: micrometres
  use gfb_text, only: text
  use gfb_operating_point, only: operating_point_type
  use gfb_bearing_system, only: bearing_system_type
  use gfb_bearing_answer, only: bearing_answer_type, bearing_answer
  use gfb_newton, only: newton_type, newton_report_type, solve_newton
  use gfb_petsc_session, only: any_rank
  use gfb_bearing_directions, only: edge_lift, edge_words
  use gfb_continuation, only: path_settings_type, path_report_type, follow_path
  use gfb_arc, only: arc_type, end_arc, begin_arc, advance_arc
  use gfb_saved_state, only: saved_state_type
  use gfb_start_problem, only: start_problem_type, with_fixed_edges, settings_with_fixed_edge, first_step
  use gfb_edge_start, only: same_height
  use gfb_start_position, only: solve_at
  implicit none (type)
  private
  public :: take_branch, destroy_branches, lifts_of_pads, find_branches, seek_branch

  real(wp), parameter :: same_state = 1.0e-4_wp !! largest difference of scaled unknowns of one and the same [1]
  real(wp), parameter :: same_lifts = 1.0e-10_wp !! of midplane and ends, that are not distinguished [m]

  !> An equilibrium.
  type :: branch_type
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
    procedure :: wanted_of, nearest_branch, is_found, collect
  end type branch_search_type

  integer, parameter :: most_steps = 600        !! along one curve
  integer, parameter :: most_starts = 8         !! equilibria of several pads that edges are pulled from
  integer, parameter :: steps_a_line = 100      !! of progress
  integer, parameter :: most_release_steps = 200 !! of the string, a decade
  integer, parameter :: decades = 4             !! of its tension, before it is none
  !> Unit of the force, and tension of the string over width over clearance, over the bearing's size of a force: a higher tension
  !> keeps the edge straighter, and takes longer to release [1]
  real(wp), parameter :: pull_share = 1.0e-2_wp
  real(wp), parameter :: release_range = 0.35_wp   !! change of the mean lift when a string is released, over the clearance [1]
  real(wp), parameter :: lift_margin = 0.25_wp !! that is looked at beyond, over clearance and change of the lift [1]

contains

  !> Keeps the bearing's present answer unless it is known.
  subroutine collect(self, bearing, newton)
    class(branch_search_type), intent(inout) :: self !! the search
    type(bearing_system_type), intent(in) :: bearing !! in equilibrium
    type(newton_type), intent(in) :: newton          !! its solver, whose log names a new one
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
    associate (answer => new%answer, clearance => bearing%clearance)
      call newton%log%line('equilibrium '//text(size(self%branch))//': e/C ('// &
                           text(answer%place(1)/clearance, 5)//', '//text(answer%place(2)/clearance, 5)// &
                           '), leading edge lifted '//lifts(answer%leading_edge_lift)//', trailing '// &
                           lifts(answer%trailing_edge_lift)//' um (midplane, ends'// &
                           trim(merge('; mean of the pads', '                  ', size(answer%pad_lift, 2) > 1))//')'// &
                           lifts_of_pads(answer%pad_lift))
    end associate
  end subroutine collect

  !> Lifts of the leading edges of several pads [um], at the midplane, and at the ends where they differ; nothing of one.
  pure function lifts_of_pads(lift) result(words)
    real(wp), intent(in) :: lift(:, :) !! (2, pads) [m]
    character(len=:), allocatable :: words
    integer :: pad

    words = ''
    if (size(lift, 2) == 1) return
    words = ', leading by pads'
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
  pure real(wp) function wanted_of(self, pad) result(mean)
    class(branch_search_type), intent(in) :: self !! the search
    integer, intent(in) :: pad !! its number
    mean = sum(self%wanted(:, pad), mask=self%given)/real(count(self%given), wp)
  end function wanted_of

  !> The equilibrium whose leading edge is lifted most nearly as asked for.
  pure integer function nearest_branch(self) result(number)
    class(branch_search_type), intent(in) :: self !! the search
    integer :: i
    number = minloc([(distance(self, i), i=1, size(self%branch))], 1)
  end function nearest_branch

  !> Whether one that was asked for has been found.
  pure logical function is_found(self) result(found)
    class(branch_search_type), intent(in) :: self !! the search

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

  !> Goes over to the equilibrium whose leading edge is lifted as asked for.
  subroutine seek_branch(midplane, ends, problem)
    !> lifts asked for at the midplane and at the bearing's ends: none, one for all pads, or one for each [m]
    real(wp), intent(in) :: midplane(:), ends(:)
    type(start_problem_type), intent(inout) :: problem !! in equilibrium; that may be another one after
    type(branch_search_type) :: search
    type(saved_state_type) :: start
    real(wp) :: lift(size(problem%bearing%pad)), mean(size(problem%bearing%pad))
    integer :: pad
    logical :: there

    associate (bearing => problem%bearing, clearance => problem%bearing%clearance)
      search%given = [size(midplane) > 0, size(ends) > 0]
      allocate (search%wanted(2, size(bearing%pad)), source=0.0_wp)
      if (search%given(1)) search%wanted(1, :) = [(midplane(min(pad, size(midplane))), pad=1, size(bearing%pad))]
      if (search%given(2)) search%wanted(2, :) = [(ends(min(pad, size(ends))), pad=1, size(bearing%pad))]
      search%close_enough = same_height*clearance
      lift = [(edge_lift(bearing, pad), pad=1, size(bearing%pad))]
      mean = [(search%wanted_of(pad), pad=1, size(bearing%pad))]
      search%lifts = [min(minval(lift), minval(mean)), max(maxval(lift), maxval(mean))]
      search%lifts = search%lifts + lift_margin*(clearance + search%lifts(2) - search%lifts(1))*[-1.0_wp, 1.0_wp]
      if (size(bearing%pad) > 1) then
        call start%save(bearing)
        call raise_edges(problem, mean, there)
        if (there) call search%collect(bearing, problem%newton)
        if (there) there = search%is_found()
        if (.not. there) call start%restore(bearing)
        call start%destroy()
      end if
      if (.not. search%is_found()) call find_branches(bearing, problem%newton, search)
      call take_branch(bearing, bearing%point, search%branch(search%nearest_branch()))
      if (.not. search%is_found()) then
        call problem%newton%log%line('no equilibrium was found with its leading edge lifted as asked for; the nearest is taken')
      end if
    end associate
    call destroy_branches(search)
  end subroutine seek_branch

  !> Fixes the edges of several pads, moves them to heights, and releases them there.
  subroutine raise_edges(problem, height, there)
    type(start_problem_type), intent(inout) :: problem !! in equilibrium
    real(wp), intent(in) :: height(:) !! (pads) of the edges [m]
    logical, intent(out) :: there !! in equilibrium again, with all edges free
    type(operating_point_type) :: fixed
    type(path_report_type) :: report
    integer :: pad

    fixed = with_fixed_edges(problem)
    do pad = 1, size(height)
      fixed%edge_height(pad) = edge_lift(problem%bearing, pad)
    end do
    problem%bearing%point = fixed
    fixed%edge_height(:size(height)) = height
    call follow_path(problem%bearing, problem%newton, fixed, first_step, settings_with_fixed_edge(problem%settings), report)
    if (report%converged()) call solve_at(problem%bearing, problem%newton, problem%target, .false., problem%settings, report)
    there = report%converged()
  end subroutine raise_edges

  !> Looks for equilibria from the bearing's present one on, until the one asked for is found, or all
  !> lifts have been looked at; from one that is known already it does not look again. The edges of several pads are pulled
  !> one at a time, from what that leads to as well.
  subroutine find_branches(bearing, newton, search)
    type(bearing_system_type), target, intent(inout) :: bearing !! in equilibrium, and in the same one after
    type(newton_type), target, intent(inout) :: newton          !! its solver
    type(branch_search_type), intent(inout) :: search           !! what is asked for and known; what is found joins it
    type(operating_point_type) :: free
    integer :: known, first, from, pad

    free = bearing%point
    known = 0
    if (allocated(search%branch)) known = size(search%branch)
    call search%collect(bearing, newton)
    first = size(search%branch)
    if (first == known .or. search%is_found()) return
    from = first
    do while (from <= size(search%branch) .and. from < first + most_starts)
      if (from > first .and. size(bearing%pad) == 1) exit ! one edge leads to all of a curve at once
      do pad = 1, size(bearing%pad)
        if (search%branch(from)%pulled_pad == pad) cycle ! on a curve that was followed
        call pull_pad(bearing, newton, free, from, pad, search)
        if (search%is_found()) return
      end do
      from = from + 1
    end do
    if (from > first + 1) call take_branch(bearing, free, search%branch(first))
  end subroutine find_branches

  !> Looks from a known equilibrium on, by the free edge of a pad: kept straight, where it is that of shells, and as it is.
  subroutine pull_pad(bearing, newton, free, from, pad, search)
    type(bearing_system_type), target, intent(inout) :: bearing !! ends in that equilibrium
    type(newton_type), target, intent(inout) :: newton
    type(operating_point_type), intent(in) :: free !! nothing pulls
    integer, intent(in) :: from !! number of the equilibrium
    integer, intent(in) :: pad  !! its number
    type(branch_search_type), intent(inout) :: search
    type(operating_point_type) :: straight
    type(path_settings_type) :: settings
    type(path_report_type) :: report
    character(len=:), allocatable :: edge

    edge = 'its free edge'
    if (size(bearing%pad) > 1) edge = edge_words(bearing, pad)
    if (size(bearing%pad) > 1) call take_branch(bearing, free, search%branch(from))
    search%pulled_pad = pad
    if (any_rank(bearing%pad(pad)%edge%pairs() > 0)) then
      call newton%log%line('from equilibrium '//text(from)//', '//edge//' kept straight and pulled:')
      straight = free
      straight%edge_tension(pad) = pull_share*bearing%force_scale()* &
        (maxval(bearing%pad(pad)%whole%row_axial) - minval(bearing%pad(pad)%whole%row_axial))/bearing%pad(pad)%film%clearance
      settings%look_for_folds = .false.
      call follow_path(bearing, newton, straight, 1.0_wp, settings, report)
      if (report%converged()) call pull_both_ways(bearing, newton, straight, free, pad, search)
      call take_branch(bearing, free, search%branch(from))
    end if
    if (search%is_found()) return
    call newton%log%line('from equilibrium '//text(from)//', '//edge//' pulled:')
    call pull_both_ways(bearing, newton, free, free, pad, search)
    search%pulled_pad = 0
    call take_branch(bearing, free, search%branch(from))
  end subroutine pull_pad

  !> Pulls the edge in the sense that leads to the lift asked for; in both where none is.
  subroutine pull_both_ways(bearing, newton, point, free, pad, search)
    type(bearing_system_type), target, intent(inout) :: bearing
    type(newton_type), target, intent(inout) :: newton
    type(operating_point_type), intent(in) :: point, free !! where the curve begins; without a string
    integer, intent(in) :: pad !! whose edge
    type(branch_search_type), intent(inout) :: search
    type(saved_state_type) :: start
    real(wp) :: sense

    sense = sign(1.0_wp, 0.5_wp*sum(search%lifts) - edge_lift(bearing, pad))
    if (any(search%given) .and. size(bearing%pad) > 1) sense = sign(1.0_wp, search%wanted_of(pad) - edge_lift(bearing, pad))
    call start%save(bearing)
    call pull_edge(bearing, newton, point, free, pad, sense, search)
    if (.not. any(search%given)) then
      call start%restore(bearing)
      call pull_edge(bearing, newton, point, free, pad, -sense, search)
    end if
    call start%destroy()
  end subroutine pull_both_ways

  !> Goes along the curve of answers with a pulled edge, and collects the equilibria on it.
  subroutine pull_edge(bearing, newton, point, free, pad, sense, search)
    type(bearing_system_type), target, intent(inout) :: bearing
    type(newton_type), target, intent(inout) :: newton
    type(operating_point_type), intent(in) :: point !! where the curve begins
    type(operating_point_type), intent(in) :: free  !! the same without a string
    integer, intent(in) :: pad                      !! whose edge
    real(wp), intent(in) :: sense                   !! +1: up, -1: down
    type(branch_search_type), intent(inout) :: search
    type(arc_type), target :: arc
    type(operating_point_type) :: pulled
    logical :: moved, here
    real(wp) :: lift

    pulled = point
    pulled%edge_pull(pad) = pull_share*bearing%force_scale()
    call begin_arc(bearing, newton, pulled, sense, arc)
    moved = .true.
    do while (moved .and. arc%steps < most_steps .and. .not. search%is_found())
      call advance_arc(arc, moved)
      lift = edge_lift(bearing, pad)
      call newton%log%detail('free edge at '//text(lift*micrometres, 4)//' um, force '// &
                             text(bearing%point%edge_pull(pad), 4)//' N')
      if (modulo(arc%steps, steps_a_line) == 0) call newton%log%line('  '//text(arc%steps)// &
        ' steps, free edge at '//text(lift*micrometres, 4)//' um')
      if (lift < search%lifts(1) .or. lift > search%lifts(2)) exit
      if (.not. moved .or. arc%steps == 1 .or. arc%lambda*arc%lambda_before > 0.0_wp) cycle
      if (.not. is_worth_it(search, pad, lift, bearing%clearance)) cycle
      call find_equilibrium(arc, bearing, newton, point, free, pad, here)
      if (here) call search%collect(bearing, newton)
    end do
    call end_arc(arc, newton)
  end subroutine pull_edge

  !> Whether an edge that is lifted so much in the mean may lead to the lift asked for.
  pure logical function is_worth_it(search, pad, lift, clearance) result(worth)
    type(branch_search_type), intent(in) :: search
    integer, intent(in) :: pad !! whose edge
    real(wp), intent(in) :: lift, clearance !! [m]

    worth = .not. any(search%given)
    if (.not. worth) worth = abs(lift - search%wanted_of(pad)) <= release_range*clearance
  end function is_worth_it

  !> Newton's method without the force, from the line between the two answers on both sides of no force; then
  !> without the string.
  subroutine find_equilibrium(arc, bearing, newton, point, free, pad, here)
    type(arc_type), intent(inout) :: arc
    type(bearing_system_type), target, intent(inout) :: bearing
    type(newton_type), target, intent(inout) :: newton
    type(operating_point_type), intent(in) :: point, free !! without the force; without the string
    integer, intent(in) :: pad !! whose edge
    logical, intent(out) :: here
    call arc%between(arc%lambda_before/(arc%lambda_before - arc%lambda))
    call solve_there(bearing, newton, point, here)
    if (here .and. abs(point%edge_tension(pad)) > 0.0_wp) call release_string(bearing, newton, free, pad, here)
  end subroutine find_equilibrium

  !> From an equilibrium of a straight edge to one of a free edge, by decades of the string's tension.
  subroutine release_string(bearing, newton, free, pad, here)
    type(bearing_system_type), target, intent(inout) :: bearing
    type(newton_type), target, intent(inout) :: newton
    type(operating_point_type), intent(in) :: free
    integer, intent(in) :: pad
    logical, intent(out) :: here
    type(operating_point_type) :: looser
    integer :: decade

    looser = bearing%point
    here = .true.
    decade = 0
    do while (here .and. decade <= decades)
      decade = decade + 1
      looser%edge_tension = 0.1_wp*looser%edge_tension
      if (decade > decades) looser = free
      call lead_to(bearing, newton, looser, here)
      call newton%log%detail('string of '//text(looser%edge_tension(pad), 4)//' N, free edge at '// &
                             text(edge_lift(bearing, pad)*micrometres, 4)//' um')
    end do
  end subroutine release_string

  !> Along a branch to a point, round its folds and corners.
  subroutine lead_to(bearing, newton, point, here)
    type(bearing_system_type), target, intent(inout) :: bearing
    type(newton_type), target, intent(inout) :: newton
    type(operating_point_type), intent(in) :: point
    logical, intent(out) :: here
    type(arc_type), target :: arc
    logical :: moved

    call begin_arc(bearing, newton, point, 1.0_wp, arc)
    moved = .true.
    do while (moved .and. arc%lambda < 1.0_wp .and. arc%lambda >= 0.0_wp .and. arc%steps < most_release_steps)
      call advance_arc(arc, moved)
    end do
    here = arc%lambda >= 1.0_wp
    if (here) then
      call arc%between((1.0_wp - arc%lambda_before)/(arc%lambda - arc%lambda_before))
      call solve_there(bearing, newton, point, here)
    end if
    call end_arc(arc, newton)
  end subroutine lead_to

  !> Newton's method at a point from the present state.
  subroutine solve_there(bearing, newton, point, here)
    type(bearing_system_type), intent(inout) :: bearing
    type(newton_type), target, intent(inout) :: newton
    type(operating_point_type), intent(in) :: point
    logical, intent(out) :: here
    type(newton_report_type) :: solved

    bearing%point = point
    call solve_newton(newton, solved)
    here = solved%converged
  end subroutine solve_there
end module gfb_branch_search
