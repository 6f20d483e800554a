#include "gfb_petsc.h"
!> What a strip's state says: forces, deflections, states of contact, works.
module gfb_strip_answer
  use petscvec
  use gfb_kinds, only: wp
  use gfb_archive, only: archive_type
  use gfb_petsc_kinds, only: pint
  use gfb_petsc_session, only: sum_over_ranks, largest_over_ranks
  use gfb_contact_measures, only: contact_measures_type, contact_extremes, contact_sums, measures_of
  use gfb_contact_law, only: state_open, state_slip
  use gfb_quad_mesh, only: node_set
  use gfb_bump_contacts, only: contact_top, crest_name, line_shares
  use gfb_strip_system, only: strip_system_type, plate_moved
  implicit none (type)
  private
  public :: start_recorder, resume_recorder, read_answer, destroy_recorder
  public :: visit_answer, differs_from

  integer, parameter :: radial = 2, axial = 3
  integer, parameter :: states = state_slip - state_open + 1

  !> One step's answer, for the whole width.
  type, public :: strip_answer_type
    real(wp) :: factor = 0.0_wp               !! share of the full load
    real(wp) :: force = 0.0_wp                !! on all crests [N]
    real(wp) :: travel = 0.0_wp               !! of the plate towards the sleeve [m]
    real(wp), allocatable :: deflection(:)    !! (bumps) mean of each crest line towards the sleeve [m]
    integer :: count(states, 2) = 0           !! nodes that are open, stick, slip, at sleeve and top
    real(wp) :: external_work = 0.0_wp        !! since the start [J]
    real(wp) :: strain_energy = 0.0_wp        !! [J]
    real(wp) :: penalty_energy = 0.0_wp       !! in the penetrations [J]
    real(wp) :: friction_work = 0.0_wp        !! since the start [J]
    type(contact_measures_type) :: contact    !! what its contacts say of the numbers of their laws
    real(wp) :: stress = 0.0_wp               !! largest von Mises stress, where it was looked for [Pa]
    real(wp) :: round_off = 0.0_wp            !! of the deflections, relative, where it was looked for [1]
  end type strip_answer_type

  !> What is needed to go on from one step to the next.
  type, public :: strip_recorder_type
    type(strip_answer_type) :: last
    Vec, private :: state, change
    integer, private :: bumps = 0
  end type strip_recorder_type

contains

  !> Begins at the unloaded strip.
  subroutine start_recorder(strip, bumps, recorder)
    type(strip_system_type), intent(in) :: strip !! at rest
    integer, intent(in) :: bumps !! number of bumps
    type(strip_recorder_type), intent(out) :: recorder !! at the unloaded strip
    PetscErrorCode :: ierr

    recorder%bumps = bumps
    allocate (recorder%last%deflection(bumps), source=0.0_wp)
    PetscCallA(VecDuplicate(strip%state, recorder%state, ierr))
    PetscCallA(VecDuplicate(strip%state, recorder%change, ierr))
    PetscCallA(VecCopy(strip%state, recorder%state, ierr))
  end subroutine start_recorder

  !> Resumes from the strip's present state, whose answer is known.
  subroutine resume_recorder(strip, answer, recorder)
    type(strip_system_type), intent(in) :: strip !! at the state of the answer
    type(strip_answer_type), intent(in) :: answer !! that steps go on from
    type(strip_recorder_type), intent(inout) :: recorder !! has been started
    PetscErrorCode :: ierr

    recorder%last = answer
    PetscCallA(VecCopy(strip%state, recorder%state, ierr))
  end subroutine resume_recorder

  !> The answer of a step that has converged and is not committed yet; works go on from the last
  !> one.
  subroutine read_answer(strip, full_force, recorder, answer)
    type(strip_system_type), intent(inout) :: strip !! at a step that has converged
    real(wp), intent(in) :: full_force !! on all crests where it is given [N]
    type(strip_recorder_type), intent(inout) :: recorder !! at the last step; on return at this one
    type(strip_answer_type), intent(out) :: answer !! of this step

    real(wp) :: widths, done
    real(wp), allocatable :: displacement(:)
    PetscScalar :: product
    PetscErrorCode :: ierr

    widths = merge(2.0_wp, 1.0_wp, strip%foil%mesh%half) ! whole over solved
    allocate (displacement(size(strip%contacts%global)))
    call strip%contact_displacements(strip%state, displacement)
    answer%factor = strip%factor
    answer%travel = strip%plate_travel()
    answer%deflection = crest_deflections(strip, recorder%bumps)
    call count_states(strip, answer%count)
    answer%force = strip%factor*full_force
    if (strip%plate == plate_moved) then
      answer%force = widths*sum(sum_over_ranks([sum(strip%contacts%point%force(3), &
                                                    strip%contacts%point%law == contact_top)]))
      done = 0.5_wp*(answer%force + recorder%last%force)*(answer%travel - recorder%last%travel)
    else
      PetscCallA(VecWAXPY(recorder%change, -1.0_wp, recorder%state, strip%state, ierr))
      PetscCallA(VecDot(strip%full_load, recorder%change, product, ierr))
      done = widths*0.5_wp*(answer%factor + recorder%last%factor)*product*strip%scale%force*strip%scale%length
    end if
    answer%external_work = recorder%last%external_work + done
    answer%strain_energy = widths*strip%strain_energy()
    answer%contact = measures_of(largest_over_ranks(contact_extremes(strip%contacts)), &
                                 sum_over_ranks(contact_sums(strip%contacts)))
    associate (sums => sum_over_ranks([strip%contacts%penalty_energy(), &
                                       strip%contacts%friction_work(displacement)]))
      answer%penalty_energy = widths*sums(1)
      answer%friction_work = recorder%last%friction_work + widths*sums(2)
    end associate
    recorder%last = answer
    PetscCallA(VecCopy(strip%state, recorder%state, ierr))
  end subroutine read_answer

  !> Whether an answer is that of another state: travel of the plate, deflections, strain energy.
  logical function differs_from(strip, bumps, answer) result(differs)
    type(strip_system_type), intent(inout) :: strip !! at its state
    integer, intent(in) :: bumps !! number of bumps
    type(strip_answer_type), intent(in) :: answer !! that may be another state's
    real(wp), parameter :: rounding = 1.0e-6_wp !! relative
    real(wp) :: here(bumps + 2), there(bumps + 2), widths

    widths = merge(2.0_wp, 1.0_wp, strip%foil%mesh%half) ! whole over solved
    here = [strip%plate_travel(), crest_deflections(strip, bumps), widths*strip%strain_energy()]
    there = [answer%travel, answer%deflection, answer%strain_energy]
    associate (size => max(maxval(abs(there(:bumps + 1))), maxval(abs(here(:bumps + 1)))), last => bumps + 2)
      differs = any(abs(here(:bumps + 1) - there(:bumps + 1)) > rounding*size)
      differs = differs .or. abs(here(last) - there(last)) > rounding*max(abs(here(last)), abs(there(last)))
    end associate
  end function differs_from

  !> Mean deflection of each crest line towards the sleeve [m].
  function crest_deflections(strip, bumps) result(deflection)
    type(strip_system_type), intent(in) :: strip
    integer, intent(in) :: bumps
    real(wp) :: deflection(bumps)
    integer, allocatable :: line(:)
    real(wp), allocatable :: share(:)
    PetscScalar :: value(1)
    PetscErrorCode :: ierr
    integer :: bump, i

    deflection = 0.0_wp
    do bump = 1, bumps
      line = node_set(strip%foil%mesh, crest_name(bump))
      share = line_shares(strip%foil%mesh, line)
      do i = 1, size(line)
        if (.not. strip%foil%owns(line(i)) .or. strip%foil%unknown(radial, line(i)) < 0) cycle
        PetscCallA(VecGetValues(strip%state, 1_pint, [int(strip%foil%unknown(radial, line(i)), pint)], value, ierr))
        deflection(bump) = deflection(bump) - share(i)*value(1)*strip%scale%length
      end do
    end do
    deflection = sum_over_ranks(deflection)
  end function crest_deflections

  !> Nodes of the whole width that are open, stick and slip.
  subroutine count_states(strip, total)
    type(strip_system_type), intent(in) :: strip
    integer, intent(out) :: total(states, 2)
    real(wp) :: found(states*2)
    integer :: i, entry

    found = 0.0_wp
    do i = 1, size(strip%contacts%point)
      associate (point => strip%contacts%point(i), mesh => strip%foil%mesh)
        entry = (point%law - 1)*states + strip%contacts%state_of(i) - state_open + 1
        found(entry) = found(entry) + 1.0_wp
        if (mesh%half .and. mesh%position(axial, point%node) > 0.0_wp) found(entry) = found(entry) + 1.0_wp
      end associate
    end do
    total = reshape(nint(sum_over_ranks(found)), [states, 2])
  end subroutine count_states

  !> Frees what PETSc holds.
  subroutine destroy_recorder(recorder)
    type(strip_recorder_type), intent(inout) :: recorder !! its vectors are freed
    PetscErrorCode :: ierr

    PetscCallA(VecDestroy(recorder%state, ierr))
    PetscCallA(VecDestroy(recorder%change, ierr))
  end subroutine destroy_recorder

  !> Saves or restores an answer; one that is restored knows its number of bumps.
  pure subroutine visit_answer(archive, answer)
    type(archive_type), intent(inout) :: archive !! saves or restores
    type(strip_answer_type), intent(inout) :: answer !! written where the archive restores

    call archive%visit('factor', answer%factor)
    call archive%visit('force', answer%force)
    call archive%visit('travel', answer%travel)
    call archive%visit('deflection', answer%deflection)
    call archive%visit('count', answer%count)
    call archive%visit('external_work', answer%external_work)
    call archive%visit('strain_energy', answer%strain_energy)
    call archive%visit('penalty_energy', answer%penalty_energy)
    call archive%visit('friction_work', answer%friction_work)
    call archive%visit('penetration', answer%contact%penetration)
    call archive%visit('slip', answer%contact%slip)
    call archive%visit('lacking', answer%contact%lacking)
    call archive%visit('stress', answer%stress)
    call archive%visit('round_off', answer%round_off)
  end subroutine visit_answer
end module gfb_strip_answer
