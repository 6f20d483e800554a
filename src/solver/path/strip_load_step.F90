#include "gfb_petsc.h"
!> One load step of a strip: from an answer to the next, and never to anything else.
!>
!> The start value is a straight line through the last two answers, exact where no contact changes
!> its state under a load that grows in proportion. A step that fails is tried with a longer stick
!> length that is shortened again, and then cut. Neither is loading: friction's memory stays as it
!> is until the step is whole, so the answer does not depend on them.
module gfb_strip_load_step
  use petscvec
  use gfb_kinds, only: wp
  use gfb_archive, only: archive_type
  use gfb_natural_order, only: visit_vector
  use gfb_signals, only: stop_agreed
  use gfb_petsc_session, only: any_rank
  use gfb_newton, only: newton_type, newton_report_type, solve_newton
  use gfb_bump_contacts, only: contact_top
  use gfb_contact_memory, only: visit_contacts
  use gfb_strip_system, only: strip_system_type, plate_moved, strip_order
  implicit none (type)
  private
  public :: create_load_path, take_load_step, destroy_load_path
  public :: visit_strip, visit_load_path

  real(wp), parameter :: softening(3) = [100.0_wp, 10.0_wp, 1.0_wp] !! of the stick length in a homotopy
  integer, parameter :: most_halvings = 6
  real(wp), parameter :: less = 1.0e-2_wp !! of the artificial stiffness of strips that lie free, where steps shrink too slowly [1]

  !> The last two answers.
  type, public :: load_path_type
    Vec :: here, before              !! like the strip's state
    real(wp) :: at_here = 0.0_wp, at_before = 0.0_wp !! load factors
    integer :: answers = 0           !! of the last two, those that there are
    integer :: homotopies = 0        !! steps that needed one
    integer :: cuts = 0              !! steps that were shortened
    integer :: at_round_off = 0      !! steps, cut ones too, that ended there
    real(wp) :: round_off = 0.0_wp   !! Newton's largest relative step at their ends [1]
  end type load_path_type

contains

  !> Begins at the unloaded strip.
  subroutine create_load_path(strip, path)
    type(strip_system_type), intent(in) :: strip !! without load
    type(load_path_type), intent(out) :: path !! both its answers are the strip's state
    PetscErrorCode :: ierr

    PetscCallA(VecDuplicate(strip%state, path%here, ierr))
    PetscCallA(VecDuplicate(strip%state, path%before, ierr))
    PetscCallA(VecCopy(strip%state, path%here, ierr))
    PetscCallA(VecCopy(strip%state, path%before, ierr))
  end subroutine create_load_path

  !> Brings the strip to a load factor. Where that fails the strip is back at the last answer. The
  !> caller commits.
  subroutine take_load_step(strip, newton, target, path, report)
    type(strip_system_type), intent(inout) :: strip !! at the path's last answer; brought to the target
    type(newton_type), target, intent(inout) :: newton !! its solver
    real(wp), intent(in) :: target !! load factor to reach [1]
    type(load_path_type), intent(inout) :: path !! the last two answers
    type(newton_report_type), intent(out) :: report !! how the last solve ended

    real(wp) :: reached, step
    integer :: halvings
    PetscErrorCode :: ierr

    halvings = 0
    reached = path%at_here
    step = target - path%at_here
    do
      if (abs(target - reached) <= abs(step)*1.000001_wp) step = target - reached
      call start_values(strip, newton, path, reached, reached + step)
      call solve_step(strip, newton, report)
      if (.not. report%converged) call follow_softening(strip, newton, path, reached, reached + step, report)
      if (.not. report%converged) then
        if (stop_agreed() .or. halvings == most_halvings) exit
        halvings = halvings + 1
        path%cuts = path%cuts + 1
        step = 0.5_wp*step
        cycle
      end if
      if (report%at_round_off) path%at_round_off = path%at_round_off + 1
      path%round_off = max(path%round_off, report%round_off)
      if (abs(reached + step - target) <= 0.0_wp) exit
      call remember(strip, path, reached, reached + step)
      reached = reached + step
    end do
    if (report%converged) then
      call remember(strip, path, reached, target)
    else
      PetscCallA(VecCopy(path%here, strip%state, ierr))
      call strip%set_factor(path%at_here)
    end if
  end subroutine take_load_step

  !> Start values of a step.
  subroutine start_values(strip, newton, path, from, to)
    type(strip_system_type), intent(inout) :: strip
    type(newton_type), target, intent(inout) :: newton
    type(load_path_type), intent(in) :: path
    real(wp), intent(in) :: from, to !! load factors
    type(newton_report_type) :: first
    real(wp) :: stretch
    logical :: touches
    PetscErrorCode :: ierr

    call strip%set_factor(to)
    touches = any_rank(size(strip%contacts%point) > 0)
    PetscCallA(VecCopy(path%here, strip%state, ierr))
    if (.not. abs(to) > 0.0_wp) then
      ! Without load nothing presses, so nothing rubs: the foil is at rest.
      PetscCallA(VecSet(strip%state, 0.0_wp, ierr))
    else if (path%answers == 0 .and. touches) then
      strip%contacts%glued = .true.
      call solve_newton(newton, first)
      strip%contacts%glued = .false.
    else if ((to - from)*(path%at_here - path%at_before) > 0.0_wp) then
      stretch = (to - from)/(path%at_here - path%at_before)
      PetscCallA(VecAXPBYPCZ(strip%state, -stretch, stretch, 1.0_wp, path%before, path%here, ierr))
    end if
  end subroutine start_values

  !> Solves from the start values; where that does not end, on from there with less artificial stiffness along the surfaces.
  !>
  !> Friction whose slope is below the artificial stiffness lets the steps shrink by their ratio only. Less of it from
  !> the beginning would let round-off move a strip that slides everywhere.
  subroutine solve_step(strip, newton, report)
    type(strip_system_type), intent(inout) :: strip
    type(newton_type), target, intent(inout) :: newton
    type(newton_report_type), intent(out) :: report
    real(wp) :: artificial
    PetscErrorCode :: ierr

    call solve_newton(newton, report)
    artificial = strip%contacts%artificial_tangential
    if (report%converged .or. .not. artificial > 0.0_wp) return
    if (stop_agreed()) return
    if (is_out_of_reach(strip)) then ! round-off moves a strip that floats: it is at rest
      PetscCallA(VecSet(strip%state, 0.0_wp, ierr))
    end if
    call newton%log%detail('on with less artificial stiffness along the surfaces: '//report%reason)
    strip%contacts%artificial_tangential = less*artificial
    call solve_newton(newton, report)
    strip%contacts%artificial_tangential = artificial
  end subroutine solve_step

  !> Whether a plate that is moved has not come to any crest of the strip at rest.
  logical function is_out_of_reach(strip) result(out_of_reach)
    type(strip_system_type), intent(in) :: strip

    out_of_reach = strip%plate == plate_moved
    if (.not. out_of_reach) return
    associate (point => strip%contacts%point)
      out_of_reach = .not. any_rank(any(point%law == contact_top .and. point%gap < 0.0_wp))
    end associate
  end function is_out_of_reach

  !> Tries a step with stick lengths that grow shorter.
  subroutine follow_softening(strip, newton, path, from, to, report)
    type(strip_system_type), intent(inout) :: strip
    type(newton_type), target, intent(inout) :: newton
    type(load_path_type), intent(inout) :: path
    real(wp), intent(in) :: from, to !! load factors
    type(newton_report_type), intent(inout) :: report
    integer :: i

    if (all(strip%contacts%law%friction <= 0.0_wp)) return
    path%homotopies = path%homotopies + 1
    call newton%log%detail('again with a longer stick length: '//report%reason)
    call start_values(strip, newton, path, from, to)
    do i = 1, size(softening)
      strip%contacts%softening = softening(i)
      call solve_step(strip, newton, report)
      if (.not. report%converged) exit
    end do
    strip%contacts%softening = 1.0_wp
  end subroutine follow_softening

  !> The strip's state is an answer.
  subroutine remember(strip, path, from, to)
    type(strip_system_type), intent(in) :: strip
    type(load_path_type), intent(inout) :: path
    real(wp), intent(in) :: from, to !! load factors
    PetscErrorCode :: ierr

    PetscCallA(VecCopy(path%here, path%before, ierr))
    PetscCallA(VecCopy(strip%state, path%here, ierr))
    path%at_before = from
    path%at_here = to
    path%answers = min(2, path%answers + 1)
  end subroutine remember

  !> Frees what PETSc holds.
  subroutine destroy_load_path(path)
    type(load_path_type), intent(inout) :: path !! not used any more
    PetscErrorCode :: ierr

    PetscCallA(VecDestroy(path%here, ierr))
    PetscCallA(VecDestroy(path%before, ierr))
  end subroutine destroy_load_path

  !> Saves or restores a strip's last two answers and what its contacts remember. All ranks ask.
  subroutine visit_strip(archive, strip, path)
    type(archive_type), intent(inout) :: archive !! that saves or restores
    type(strip_system_type), intent(inout) :: strip !! put at the last answer where the archive restores
    type(load_path_type), intent(inout) :: path !! gets both answers there
    PetscErrorCode :: ierr

    call visit_load_path(archive, path)
    call visit_vector(archive, 'state', strip_order(strip), path%here)
    call visit_vector(archive, 'state_before', strip_order(strip), path%before)
    call visit_contacts(archive, 'contacts', strip%foil%mesh%rows, strip%contacts)
    if (archive%saves .or. archive%failed) return
    PetscCallA(VecCopy(path%here, strip%state, ierr))
    call strip%set_factor(path%at_here)
  end subroutine visit_strip

  !> Of these all but fields.
  pure subroutine visit_load_path(archive, path)
    type(archive_type), intent(inout) :: archive !! that saves or restores
    type(load_path_type), intent(inout) :: path !! written where the archive restores

    call archive%visit('at_here', path%at_here)
    call archive%visit('at_before', path%at_before)
    call archive%visit('answers', path%answers)
    call archive%visit('homotopies', path%homotopies)
    call archive%visit('cuts', path%cuts)
    call archive%visit('at_round_off', path%at_round_off)
    call archive%visit('round_off', path%round_off)
  end subroutine visit_load_path
end module gfb_strip_load_step
