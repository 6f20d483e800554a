!> Contacts under a vibration of vanishing amplitude.
!>
!> After loading most contacts slide, and their law has no stiffness in the direction of sliding. A
!> small vibration reverses every half cycle, so that the contacts shake down and stick: their
!> tangent is the law's at no slip, under the normal force of the static state, and a change of that
!> force moves nothing along the surface.
module gfb_stick_tangent
  use gfb_kinds, only: wp
  use gfb_contact_law, only: contact_law_type, friction_force
  use gfb_contact_set, only: contact_set_type
  implicit none (type, external)
  private
  public :: stick_contacts

contains

  !> Linearises all closed contacts that rub as sticking, until they are settled again.
  pure subroutine stick_contacts(contacts)
    type(contact_set_type), intent(inout) :: contacts !! of this rank, settled
    type(contact_law_type) :: law
    real(wp), parameter :: no_slip(2) = 0.0_wp
    real(wp) :: pressing, friction(2), by_pressing(2)
    integer :: i

    do i = 1, size(contacts%point)
      associate (point => contacts%point(i))
        law = contacts%law_of(point)
        pressing = merge(point%pressing, point%force(3), point%pressed)
        if (.not. (law%friction > 0.0_wp .and. pressing > 0.0_wp)) cycle
        call friction_force(law, no_slip, pressing, friction, point%derivative(:2, :2), by_pressing)
        point%derivative(:2, 3) = 0.0_wp
      end associate
    end do
  end subroutine stick_contacts
end module gfb_stick_tangent
