#include "gfb_petsc.h"
!> The steady equations about an answer, as a vibration meets them.
module gfb_steady_tangent
  use petscmat
  use gfb_kinds, only: wp
  use gfb_solid_contact, only: contact_pressure_rate
  use gfb_contacts_in_motion, only: stick_contacts
  use gfb_bearing_system, only: bearing_system_type
  implicit none (type)
  private
  public :: linearise_steady, linearise_exactly, measure_asperities

contains

  !> Derivative of the steady equations, the shaft fixed, without what is lent to open contacts.
  subroutine linearise_steady(bearing, stick, steady, opposite)
    type(bearing_system_type), intent(inout) :: bearing !! at its answer
    logical, intent(in) :: stick !! contacts that rub stick
    Mat, intent(out) :: steady !! like the bearing's own
    type(bearing_system_type), allocatable, intent(inout) :: opposite !! gets the state, where there is one
    logical :: moved
    integer :: i

    call bearing%settle(bearing%state, moved)
    do i = 1, size(bearing%pad)
      associate (foil => bearing%pad(i)%foil)
        if (stick .and. foil%has_contacts()) call stick_contacts(foil%contacts)
      end associate
    end do
    call linearise_exactly(bearing, steady)
    if (allocated(opposite)) call lend_state(bearing, opposite)
    call bearing%settle(bearing%state, moved)
  end subroutine linearise_steady

  !> The same with the contacts as they are.
  subroutine linearise_exactly(bearing, steady)
    type(bearing_system_type), intent(inout) :: bearing !! whose contacts are linearised
    Mat, intent(out) :: steady !! like the bearing's own
    PetscErrorCode :: ierr
    integer :: i

    do i = 1, size(bearing%pad)
      bearing%pad(i)%foil%contacts%lends = .false.
    end do
    call bearing%linearise_at(bearing%point, .true., bearing%state)
    do i = 1, size(bearing%pad)
      bearing%pad(i)%foil%contacts%lends = .true.
    end do
    PetscCallA(MatDuplicate(bearing%jacobian, MAT_COPY_VALUES, steady, ierr))
  end subroutine linearise_exactly

  !> Gives the bearing of opposite motions the film of an answer and the stiffness of its contacts; its own
  !> foil stays, for at z = 0 it could not follow.
  subroutine lend_state(bearing, opposite)
    type(bearing_system_type), intent(in) :: bearing
    type(bearing_system_type), intent(inout) :: opposite
    real(wp) :: given(bearing%local_size()), taken(opposite%local_size())
    integer :: i, k

    call bearing%get_unknowns(given)
    opposite%point = bearing%point
    taken = 0.0_wp
    call opposite%put_pressure(bearing%film_pressure(given), taken)
    taken(opposite%first_shaft + 1:) = given(bearing%first_shaft + 1:)
    call opposite%set_unknowns(taken)
    do k = 1, size(bearing%pad)
      associate (pad => bearing%pad(k), other => opposite%pad(k))
        other%held = pad%foil%deflection(given(pad%first + 1:pad%last))
        do i = 1, size(pad%foil%contacts%point)
          other%foil%contacts%point(i)%derivative = pad%foil%contacts%point(i)%derivative
        end do
      end associate
    end do
  end subroutine lend_state

  !> Slope of the asperities' pressure at this rank's nodes.
  subroutine measure_asperities(bearing, rate)
    type(bearing_system_type), intent(in) :: bearing !! at its answer
    real(wp), allocatable, intent(out) :: rate(:) !! over the gap [Pa/m]
    real(wp) :: unknown(bearing%local_size())

    allocate (rate(bearing%film_nodes()), source=0.0_wp)
    if (.not. bearing%pad(1)%contact%present) return
    call bearing%get_unknowns(unknown)
    rate = contact_pressure_rate(bearing%pad(1)%contact, bearing%gap(unknown))
  end subroutine measure_asperities
end module gfb_steady_tangent
