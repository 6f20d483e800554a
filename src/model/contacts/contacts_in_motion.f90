!> Contacts of foils that move: at the begin, under a vanishing and a finite vibration.
!>
!> Contacts under a vibration of vanishing amplitude.
!>
!> After loading most contacts slide, and their law has no stiffness in the direction of sliding. A
!> small vibration reverses every half cycle, so that the contacts shake down and stick: their
!> tangent is the law's at no slip, under the normal force of the static state, and a change of that
!> force moves nothing along the surface.
!>
!> Contacts of foils that begin to move.
!>
!> A state at rest has been found by loads that grow, and most of its contacts slide. A motion that
!> is small turns them back, and there they stick. Not all laws of friction at rest do so: tanh with
!> drag is flat where a contact that has slid turns back, until it has gone some stick lengths. In
!> motion a contact sticks elastically up to Coulomb's limit, from the friction that it has at rest.
module gfb_contacts_in_motion
  use gfb_kinds, only: wp
  use gfb_units, only: pi
  use gfb_contact_law, only: contact_law_type, friction_force, law_coulomb, slip_of_friction, &
                             friction_stiffness
  use gfb_contact_set, only: contact_set_type
  implicit none (type, external)
  private
  public :: stick_contacts, set_contacts_moving, take_over_friction, vibrate_contacts

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

  !> Gives contacts the law of motions, if it is not that of rest.
  pure subroutine set_contacts_moving(contacts)
    type(contact_set_type), intent(inout) :: contacts !! of this rank

    if (.not. contacts%sticks_in_motion) return
    contacts%keeps_friction = .true.
    contacts%law%friction_law = law_coulomb
  end subroutine set_contacts_moving

  !> Contacts at rest begin to move: each remembers the slip at which its new law has the friction
  !> \( t \) of its old one,
  !>
  !> $$ s = -\frac{u_{max}}{\mu f_n} t $$
  pure subroutine take_over_friction(displacement, contacts)
    real(wp), intent(in) :: displacement(:) !! of the set's unknowns [m]
    type(contact_set_type), intent(inout) :: contacts !! of this rank, settled by their old law
    type(contact_law_type) :: law
    real(wp) :: now(3), force(3), slip(2), pressing
    integer :: i

    if (.not. contacts%keeps_friction) return
    do i = 1, size(contacts%point)
      now = contacts%approach(i, displacement)
      associate (point => contacts%point(i))
        force = point%force + matmul(point%derivative, now - point%place)
        pressing = merge(point%pressing, force(3), point%pressed)
        law = contacts%law_of(point)
        slip = 0.0_wp
        point%stick_pressing = 0.0_wp
        if (law%friction > 0.0_wp .and. pressing > 0.0_wp) then
          point%stick_pressing = pressing
          slip = slip_of_friction(law, force(:2), pressing)
        end if
        point%old_slip = now(:2) + point%shift
        point%shift = point%old_slip - slip
        point%place = [slip, now(3)]
        point%anchor = point%place
        point%old_force = force(:2)
      end associate
    end do
    call contacts%linearise_again()
  end subroutine take_over_friction

  !> Complex stiffness along their surface of all closed contacts that rub, under the normal forces
  !> of the static state, and the energy that they lose in a cycle.
  pure subroutine vibrate_contacts(contacts, cosine, sine, amplitude, stiffness, lost)
    type(contact_set_type), intent(in) :: contacts !! of this rank, settled
    !> the set's unknowns, Re((cosine + i sine) exp(i w t)), over the amplitude [1]
    real(wp), intent(in) :: cosine(:), sine(:)
    real(wp), intent(in) :: amplitude        !! that they are scaled with; zero: all stick [m]
    complex(wp), intent(out) :: stiffness(:) !! one a contact; zero where none rubs [N/m]
    real(wp), intent(out) :: lost              !! [J]
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
end module gfb_contacts_in_motion
