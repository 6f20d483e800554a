#include "gfb_petsc.h"
!> How a bearing answers vibrations of the shaft that are not small, as far as its contacts rub.
!>
!> Harmonic balance with one harmonic. About the answer film, foils and normal forces are linear as in
!> `gfb_dynamic_response`; each contact has the complex stiffness of the amplitude with which it slides
!> (`gfb_contact_law`), and both are found in turns: the matrix with these stiffnesses is
!> factorized, the motion scaled to the shaft's amplitude gives the amplitudes of the contacts.
module gfb_amplitude_response
  use petscmat
  use gfb_kinds, only: wp
  use gfb_petsc_session, only: sum_over_ranks, largest_over_ranks
  use gfb_film_surface, only: journal_motions
  use gfb_bearing_system, only: bearing_system_type
  use gfb_contacts_in_motion, only: vibrate_contacts
  use gfb_film_rates, only: fill_friction
  use gfb_dynamic_response, only: dynamic_response_type, motion_vectors_type, prepare_part, solve_part
  use gfb_vibration_equations, only: combine
  implicit none (type)
  private
  public :: start_vibration, find_at_amplitude

  integer, parameter :: most_passes = 50
  integer, parameter :: passes_watched = 3 !! before the stiffnesses are led on beyond the last change
  real(wp), parameter :: most_ratio = 0.9_wp   !! of a change to the one before [1]
  real(wp), parameter :: tolerance = 1.0e-6_wp !! change of a contact's stiffness that is left [1]

  !> A vibration of one of the shaft's coordinates.
  type, public :: vibration_state_type
    complex(wp), allocatable :: stiffness(:) !! along the surface, of this rank's contacts, pad by pad [N/m]
    complex(wp), allocatable, private :: sticking(:) !! the same of no amplitude [N/m]
    complex(wp) :: coefficient(journal_motions) = 0.0_wp !! forces and torques over the motion [SI]
    real(wp) :: lost = 0.0_wp    !! energy that contacts lose in a cycle [J]
    integer :: passes = 0        !! of the last amplitude
    logical :: converged = .false.
  end type vibration_state_type

contains

  !> A vibration of no amplitude.
  subroutine start_vibration(bearing, vibration)
    type(bearing_system_type), intent(in) :: bearing !! at its answer
    type(vibration_state_type), intent(out) :: vibration !! whose contacts stick
    real(wp) :: still(bearing%local_size()), lost
    integer :: i

    still = 0.0_wp
    allocate (vibration%stiffness(sum([(size(bearing%pad(i)%foil%contacts%point), i=1, size(bearing%pad))])))
    call vibrate_pads(bearing, still, still, 0.0_wp, vibration%stiffness, lost)
    vibration%sticking = vibration%stiffness
  end subroutine start_vibration

  !> Forces of a vibration with a given amplitude, from the contacts of another one.
  subroutine find_at_amplitude(bearing, response, rate, coordinate, amplitude, vibration, found)
    type(bearing_system_type), intent(inout) :: bearing !! as it was when the response was created
    type(dynamic_response_type), intent(inout) :: response !! of it, with contacts that stick
    complex(wp), intent(in) :: rate       !! i omega [1/s]
    integer, intent(in) :: coordinate     !! of the shaft that moves: 1 or 2
    real(wp), intent(in) :: amplitude     !! of it [m]
    type(vibration_state_type), intent(inout) :: vibration !! its contacts are a first guess
    logical, intent(out) :: found !! else a matrix cannot be factorized
    complex(wp), dimension(size(vibration%stiffness)) :: next, change, before
    integer :: pass

    vibration%converged = .false.
    before = 0.0_wp
    do pass = 1, most_passes
      vibration%passes = pass
      call solve_motion(bearing, response, rate, coordinate, vibration, found)
      if (.not. found) return
      call answer_contacts(bearing, response%change, coordinate, amplitude, next, vibration%lost)
      change = (next - vibration%stiffness)/max(abs(vibration%stiffness), tiny(1.0_wp))
      vibration%converged = maxval(largest_over_ranks([0.0_wp, maxval(abs(change))])) <= tolerance
      if (vibration%converged) return
      vibration%stiffness = next
      if (modulo(pass, passes_watched) == 0) call lead_on(change, before, vibration%stiffness)
      before = change
    end do
  end subroutine find_at_amplitude

  !> Where changes keep on in the same direction the stiffnesses go where they lead to: contacts that
  !> begin to slide unload each other slowly, to the same side in each pass.
  subroutine lead_on(change, before, stiffness)
    complex(wp), intent(in) :: change(:), before(:) !! of the last two passes, relative
    complex(wp), intent(inout) :: stiffness(:) !! [N/m]
    complex(wp) :: ahead(size(stiffness))
    real(wp) :: product(2), ratio

    product = sum_over_ranks([real(dot_product(before, change), wp), real(dot_product(before, before), wp)])
    ratio = min(most_ratio, max(0.0_wp, product(1)/max(product(2), tiny(1.0_wp))))
    ahead = stiffness + ratio/(1.0_wp - ratio)*change*abs(stiffness)
    where (real(ahead, wp) > 0.0_wp .and. aimag(ahead) >= 0.0_wp) stiffness = ahead
  end subroutine lead_on

  !> The motion of film and foil with the contacts as they are.
  subroutine solve_motion(bearing, response, rate, coordinate, vibration, found)
    type(bearing_system_type), intent(inout) :: bearing
    type(dynamic_response_type), intent(inout) :: response
    complex(wp), intent(in) :: rate   !! [1/s]
    integer, intent(in) :: coordinate
    type(vibration_state_type), intent(inout) :: vibration
    logical, intent(out) :: found
    complex(wp) :: z(journal_motions, journal_motions)

    call combine(response%equations, rate)
    associate (stiffness => vibration%stiffness - vibration%sticking)
      call add_friction(bearing, real(stiffness, wp), response%equations%real_part, response%equations%steady)
      call add_friction(bearing, aimag(stiffness), response%equations%imaginary_part, response%equations%steady)
    end associate
    z = 0.0_wp
    call prepare_part(response, 1, found)
    if (found) call solve_part(bearing, response, rate, coordinate, response%part(1), z, found)
    vibration%coefficient = z(:, coordinate)
  end subroutine solve_motion

  !> Adds a stiffness of the contacts along their surface.
  subroutine add_friction(bearing, stiffness, matrix, pattern)
    type(bearing_system_type), intent(inout) :: bearing
    real(wp), intent(in) :: stiffness(:) !! [N/m]
    Mat, intent(in) :: matrix, pattern
    Mat :: friction
    PetscErrorCode :: ierr

    PetscCallA(MatDuplicate(pattern, MAT_DO_NOT_COPY_VALUES, friction, ierr))
    call fill_friction(bearing, stiffness, friction)
    PetscCallA(MatAXPY(matrix, 1.0_wp, friction, SAME_NONZERO_PATTERN, ierr))
    PetscCallA(MatDestroy(friction, ierr))
  end subroutine add_friction

  !> What the contacts answer to the motion that was solved last.
  subroutine answer_contacts(bearing, change, coordinate, amplitude, stiffness, lost)
    type(bearing_system_type), intent(in) :: bearing
    type(motion_vectors_type), intent(in) :: change !! of the unknowns
    integer, intent(in) :: coordinate !! of the shaft that moves
    real(wp), intent(in) :: amplitude !! [m]
    complex(wp), intent(out) :: stiffness(:) !! [N/m]
    real(wp), intent(out) :: lost !! [J]
    real(wp), dimension(bearing%local_size()) :: in_phase, behind
    real(wp) :: total(1)

    call bearing%get_unknowns(in_phase, change%re(coordinate))
    call bearing%get_unknowns(behind, change%im(coordinate))
    call vibrate_pads(bearing, in_phase, behind, amplitude, stiffness, lost)
    total = sum_over_ranks([lost])
    lost = total(1)*merge(2.0_wp, 1.0_wp, bearing%mesh%half)
  end subroutine answer_contacts

  !> What this rank's contacts answer to a motion, pad by pad.
  pure subroutine vibrate_pads(bearing, in_phase, behind, amplitude, stiffness, lost)
    type(bearing_system_type), intent(in) :: bearing
    real(wp), intent(in) :: in_phase(:), behind(:) !! local unknowns over the amplitude, in SI
    real(wp), intent(in) :: amplitude !! [m]
    complex(wp), intent(out) :: stiffness(:) !! [N/m]
    real(wp), intent(out) :: lost !! [J]
    real(wp) :: lost_here
    integer :: i, first

    lost = 0.0_wp
    first = 0
    do i = 1, size(bearing%pad)
      associate (pad => bearing%pad(i), foil => bearing%pad(i)%foil)
        associate (last => first + size(foil%contacts%point))
          call vibrate_contacts(foil%contacts, foil%own_part(in_phase(pad%first + 1:pad%last)), &
                                foil%own_part(behind(pad%first + 1:pad%last)), amplitude, stiffness(first + 1:last), lost_here)
        end associate
        first = first + size(foil%contacts%point)
      end associate
      lost = lost + lost_here
    end do
  end subroutine vibrate_pads
end module gfb_amplitude_response
