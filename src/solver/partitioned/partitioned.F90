#include "gfb_petsc.h"
!> Film and foil in turns, as in [Gu2020] Fig. 6b, for comparison with solving them together.
!>
!> A loop solves the film, and the shaft's position where it floats, with the foil fixed, and then
!> the foil with the film fixed. It has converged when the foil's answer is the deflection that the
!> film was solved with. Anderson acceleration shortens the loops. They start from the film of a
!> rigid foil with the foil at rest, or along a sweep from the neighbour's answer; nothing else
!> helps them.
module gfb_partitioned
  use petscmat
  use petscvec
  use gfb_kinds, only: wp
  use gfb_bearing_system, only: bearing_system_type
  use gfb_ending, only: path_reached, path_thins, path_lost
  use gfb_text, only: text
  use gfb_run_log, only: run_log_type
  use gfb_petsc_session, only: largest_over_ranks
  use gfb_operating_point, only: operating_point_type
  use gfb_newton, only: newton_type, newton_settings_type, newton_report_type, create_newton, solve_newton, forget_factors, &
       destroy_newton
  use gfb_anderson_acceleration, only: anderson_type, create_anderson, accelerate, destroy_anderson
  use gfb_continuation, only: path_settings_type, path_report_type
  use gfb_coupling_side, only: coupling_side_type, create_side
  implicit none (type)
  private
  public :: create_partitioned, follow_partitioned, forget_partitioned, destroy_partitioned

  integer, parameter :: most_loops = 200         !! of film and foil
  integer, parameter :: foil_patience = 5        !! iterations of the foil over those of a solve
  integer, parameter :: halvings = 8             !! of a displacement to where the film has no answer
  real(wp), parameter :: longest_displacement = 0.3_wp    !! in a loop, over the clearance [1]

  !> Both sides, their solvers and what the loops remember. Keep it where it is.
  type, public :: partitioned_type
    type(newton_type) :: film_newton, foil_newton
    integer :: loops = 0 !! since its creation
    type(coupling_side_type), private :: film, foil
    type(run_log_type), private :: log
    logical, private :: created = .false.
    type(anderson_type), private :: anderson
    Vec, private :: kept                       !! foil that the film was solved with
    Vec, private :: answer                     !! foil under that film
    Vec, private :: change                     !! from the one to the other
    Vec, private :: film_before, kept_before   !! one loop ago
    real(wp), allocatable, private :: asked(:) !! change as deflection of this rank's film nodes [m]
  end type partitioned_type

contains

  !> Cuts a bearing into its two sides.
  subroutine create_partitioned(bearing, settings, log, sides)
    type(bearing_system_type), target, intent(inout) :: bearing !! with a state
    type(newton_settings_type), intent(in) :: settings !! when Newton's method stops
    type(run_log_type), intent(in) :: log !! gets the lines of progress
    type(partitioned_type), target, intent(inout) :: sides !! are created
    type(newton_settings_type) :: foil_settings
    PetscErrorCode :: ierr

    call bearing%linearise(bearing%state)
    call create_side(bearing, .false., sides%film)
    call create_side(bearing, .true., sides%foil)
    call create_newton(sides%film_newton, sides%film, 'film_', settings, log)
    foil_settings = settings
    foil_settings%maximum_iterations = foil_patience*settings%maximum_iterations
    call create_newton(sides%foil_newton, sides%foil, 'foil_', foil_settings, log)
    sides%log = log
    PetscCallA(VecDuplicate(sides%film%state, sides%film_before, ierr))
    PetscCallA(VecDuplicate(sides%foil%state, sides%kept, ierr))
    PetscCallA(VecDuplicate(sides%foil%state, sides%answer, ierr))
    PetscCallA(VecDuplicate(sides%foil%state, sides%change, ierr))
    PetscCallA(VecDuplicate(sides%foil%state, sides%kept_before, ierr))
    allocate (sides%asked(size(deflection(bearing))), source=0.0_wp)
    call create_anderson(sides%foil%state, size(sides%asked), sides%anderson)
    sides%created = .true.
  end subroutine create_partitioned

  !> Brings the bearing to a point by loops from its present state. On return the state is the
  !> answer, or the last film there was on the foil that it was solved with.
  subroutine follow_partitioned(bearing, newton, target, settings, sides, report)
    type(bearing_system_type), target, intent(inout) :: bearing !! the bearing, in its present state
    type(newton_type), intent(inout) :: newton !! of the coupled equations: only counts here
    type(operating_point_type), intent(in) :: target !! the operating point asked for
    type(path_settings_type), intent(in) :: settings !! limits
    type(partitioned_type), target, intent(inout) :: sides !! film and foil
    type(path_report_type), intent(out) :: report !! how it ended
    character(len=:), allocatable :: reason
    logical :: converged
    integer :: spent(5)

    spent = counts(sides)
    bearing%point = target
    call repeat_loops(bearing, sides, converged, reason)
    report%ending = path_lost(reason)
    if (converged) then
      report%ending = path_reached()
      if (bearing%smallest_gap() < settings%touch_down_gap) report%ending = path_thins()
    end if
    spent = counts(sides) - spent
    newton%iterations = newton%iterations + spent(2) + spent(4)
    newton%factorizations = newton%factorizations + spent(3) + spent(5)
    call sides%log%line('partitioned: '//text(spent(1))//' loops, film '//text(spent(2))//' Newton iterations with '// &
                        text(spent(3))//' factorizations, foil '//text(spent(4))//' with '//text(spent(5))// &
                        ': '//report%reason())
    report%reached = target
    report%fraction = merge(1.0_wp, 0.0_wp, report%converged())
    report%steps = 1
  end subroutine follow_partitioned

  !> What was spent since creation: loops, then iterations and factorizations of the film and the
  !> foil.
  pure function counts(sides) result(spent)
    type(partitioned_type), intent(in) :: sides
    integer :: spent(5)

    spent = [sides%loops, sides%film_newton%iterations, sides%film_newton%factorizations, &
             sides%foil_newton%iterations, sides%foil_newton%factorizations]
  end function counts

  !> Film, foil, acceleration, until neither changes.
  subroutine repeat_loops(bearing, sides, converged, reason)
    type(bearing_system_type), target, intent(inout) :: bearing
    type(partitioned_type), target, intent(inout) :: sides
    logical, intent(out) :: converged
    character(len=:), allocatable, intent(out) :: reason

    type(newton_report_type) :: solved
    real(wp) :: size_of_change
    integer :: loop
    PetscErrorCode :: ierr

    call sides%film%take()
    call sides%foil%take()
    PetscCallA(VecCopy(sides%foil%state, sides%kept, ierr))
    PetscCallA(VecCopy(sides%foil%state, sides%answer, ierr))
    PetscCallA(VecCopy(sides%kept, sides%kept_before, ierr))
    PetscCallA(VecCopy(sides%film%state, sides%film_before, ierr))
    converged = .false.
    reason = 'film and foil still change after '//text(most_loops)//' loops'
    do loop = 1, most_loops
      sides%loops = sides%loops + 1
      call solve_film(sides, loop > 1, solved)
      if (.not. solved%converged) then
        reason = 'the film above the fixed foil in loop '//text(loop)//': '//solved%reason
        exit
      end if
      call solve_foil(bearing, sides, solved)
      if (.not. solved%converged) then
        reason = 'the foil under the fixed film in loop '//text(loop)//': '//solved%reason
        exit
      end if
      size_of_change = largest(sides%asked)/bearing%clearance
      call show_loop(bearing, sides, loop, size_of_change)
      converged = size_of_change <= sides%foil_newton%settings%step_tolerance
      if (converged) then
        reason = 'converged'
        return
      end if
      PetscCallA(VecCopy(sides%kept, sides%kept_before, ierr))
      PetscCallA(VecCopy(sides%film%state, sides%film_before, ierr))
      call choose_next(bearing, sides, loop == 1)
    end do
    call put_foil(sides, sides%kept_before)
    PetscCallA(VecCopy(sides%film_before, sides%film%state, ierr))
    call sides%film%give()
  end subroutine repeat_loops

  !> Film and shaft above the fixed foil; where they have no answer, the foil is displaced by less.
  subroutine solve_film(sides, may_shorten, solved)
    type(partitioned_type), target, intent(inout) :: sides
    logical, intent(in) :: may_shorten !! there is a film above the foil of one loop ago
    type(newton_report_type), intent(out) :: solved
    PetscErrorCode :: ierr
    integer :: halving

    do halving = 0, merge(halvings, 0, may_shorten)
      if (halving > 0) then
        call sides%log%detail('half the displacement of the foil: '//solved%reason)
        PetscCallA(VecAXPBY(sides%kept, 0.5_wp, 0.5_wp, sides%kept_before, ierr))
        PetscCallA(VecCopy(sides%film_before, sides%film%state, ierr))
      end if
      call put_foil(sides, sides%kept)
      call solve_newton(sides%film_newton, solved)
      if (solved%converged) exit
    end do
    if (solved%converged) call sides%film%give()
  end subroutine solve_film

  !> The foil under the fixed film, and its change from what the film was solved with.
  subroutine solve_foil(bearing, sides, solved)
    type(bearing_system_type), target, intent(inout) :: bearing
    type(partitioned_type), target, intent(inout) :: sides
    type(newton_report_type), intent(out) :: solved
    real(wp) :: before(size(sides%asked))
    PetscErrorCode :: ierr

    before = deflection(bearing)
    call sides%foil%fix_film()
    call solve_newton(sides%foil_newton, solved)
    if (.not. solved%converged) return
    PetscCallA(VecCopy(sides%foil%state, sides%answer, ierr))
    PetscCallA(VecWAXPY(sides%change, -1.0_wp, sides%kept, sides%answer, ierr))
    call sides%foil%give()
    sides%asked = deflection(bearing) - before
  end subroutine solve_foil

  !> Makes a state of the foil that of the bearing.
  subroutine put_foil(sides, state)
    type(partitioned_type), intent(inout) :: sides
    Vec, intent(in) :: state
    PetscErrorCode :: ierr

    PetscCallA(VecCopy(state, sides%foil%state, ierr))
    call sides%foil%give()
  end subroutine put_foil

  !> Deflection of the film nodes that this rank owns [m].
  function deflection(bearing)
    type(bearing_system_type), intent(in) :: bearing
    real(wp), allocatable :: deflection(:)
    real(wp) :: unknown(bearing%local_size())
    integer :: i

    call bearing%get_unknowns(unknown)
    allocate (deflection(0))
    do i = 1, size(bearing%pad)
      associate (pad => bearing%pad(i))
        deflection = [deflection, pack(pad%foil%deflection(unknown(pad%first + 1:pad%last)), pad%mesh%owned)]
      end associate
    end do
  end function deflection

  !> What the film is solved with next, not too far away.
  subroutine choose_next(bearing, sides, first)
    type(bearing_system_type), intent(in) :: bearing !! with the foil's answer
    type(partitioned_type), intent(inout) :: sides
    logical, intent(in) :: first !! of these loops
    real(wp) :: displacement(size(sides%asked)), stretch
    PetscErrorCode :: ierr

    call accelerate(sides%anderson, first, sides%kept, sides%change, sides%asked)
    displacement = sides%asked - deflection(bearing)
    call put_foil(sides, sides%kept)
    displacement = displacement + deflection(bearing)
    stretch = longest_displacement*bearing%clearance/max(largest(displacement), tiny(1.0_wp))
    if (stretch < 1.0_wp) then
      PetscCallA(VecAXPBY(sides%kept, 1.0_wp - stretch, stretch, sides%kept_before, ierr))
    end if
  end subroutine choose_next

  !> Largest size over all ranks.
  function largest(values)
    real(wp), intent(in) :: values(:) !! this rank's
    real(wp) :: largest, whole(1)

    whole = largest_over_ranks([maxval([0.0_wp, abs(values)])])
    largest = whole(1)
  end function largest

  !> A line of the table of loops.
  subroutine show_loop(bearing, sides, loop, change)
    type(bearing_system_type), intent(in) :: bearing
    type(partitioned_type), intent(in) :: sides
    integer, intent(in) :: loop
    real(wp), intent(in) :: change !! that the foil asks for, over the clearance [1]
    real(wp) :: position(2)

    position = bearing%eccentricity()/bearing%clearance
    call sides%log%detail('loop '//text(loop)//': change '//text(change, 3)//' C, e/C ('//text(position(1), 8)// &
                          ', '//text(position(2), 8)//')')
  end subroutine show_loop

  !> Forgets the factors of both sides; may be called without ever having been created.
  subroutine forget_partitioned(sides)
    type(partitioned_type), intent(inout) :: sides !! may be ones that were never created

    if (.not. sides%created) return
    call forget_factors(sides%film_newton)
    call forget_factors(sides%foil_newton)
  end subroutine forget_partitioned

  !> Frees what PETSc holds; may be called without ever having been created.
  subroutine destroy_partitioned(sides)
    type(partitioned_type), intent(inout) :: sides !! may be ones that were never created
    PetscErrorCode :: ierr

    if (.not. sides%created) return
    call destroy_newton(sides%film_newton)
    call destroy_newton(sides%foil_newton)
    call sides%film%destroy()
    call sides%foil%destroy()
    PetscCallA(VecDestroy(sides%film_before, ierr))
    PetscCallA(VecDestroy(sides%kept, ierr))
    PetscCallA(VecDestroy(sides%answer, ierr))
    PetscCallA(VecDestroy(sides%change, ierr))
    PetscCallA(VecDestroy(sides%kept_before, ierr))
    call destroy_anderson(sides%anderson)
    if (allocated(sides%asked)) deallocate (sides%asked)
    sides%created = .false.
  end subroutine destroy_partitioned
end module gfb_partitioned
