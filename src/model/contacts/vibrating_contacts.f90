!> Contacts under a vibration of finite amplitude: what each of them answers, by itself.
module gfb_vibrating_contacts
  use gfb_kinds, only: wp
  use gfb_contact_law, only: contact_law_type, law_coulomb
  use gfb_vibrating_friction, only: friction_stiffness
  use gfb_contact_set, only: contact_set_type
  implicit none (type, external)
  private
  public :: vibrate_contacts

contains

  !> Complex stiffness along their surface of all closed contacts that rub, under the normal forces
  !> of the static state, and the energy that they lose in a cycle.
  pure subroutine vibrate_contacts(contacts, cosine, sine, amplitude, stiffness, lost)
    type(contact_set_type), intent(in) :: contacts !! of this rank, settled
    !> the set's unknowns, Re((cosine + i sine) exp(i w t)), over the amplitude [1]
    real(wp), intent(in) :: cosine(:), sine(:)
    real(wp), intent(in) :: amplitude        !! that they are scaled with; zero: all stick [m]
    complex(wp), intent(out) :: stiffness(:) !! one a contact; zero where none rubs [N/m]
    real(wp), intent(out) :: lost              !! [J]
    real(wp), parameter :: pi = acos(-1.0_wp)
    type(contact_law_type) :: law
    real(wp) :: still(size(cosine)), origin(3), in_phase(3), behind(3), pressing
    complex(wp) :: motion(2)
    integer :: i

    still = 0.0_wp
    stiffness = 0.0_wp
    lost = 0.0_wp
    do i = 1, size(contacts%point)
      associate (point => contacts%point(i))
        law = contacts%law_of(point)
        if (contacts%sticks_in_motion) law%friction_law = law_coulomb
        pressing = merge(point%pressing, point%force(3), point%pressed)
        if (.not. (law%friction > 0.0_wp .and. pressing > 0.0_wp)) cycle
        origin = contacts%approach(i, still)
        in_phase = contacts%approach(i, cosine) - origin
        behind = contacts%approach(i, sine) - origin
        motion = amplitude*cmplx(in_phase(:2), behind(:2), wp)
        stiffness(i) = friction_stiffness(law, pressing, motion)
        lost = lost + pi*sum(abs(motion)**2)*aimag(stiffness(i))
      end associate
    end do
  end subroutine vibrate_contacts
end module gfb_vibrating_contacts
