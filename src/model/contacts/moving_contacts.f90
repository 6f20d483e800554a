!> Contacts of foils that begin to move.
!>
!> A state at rest has been found by loads that grow, and most of its contacts slide. A motion that
!> is small turns them back, and there they stick. Not all laws of friction at rest do so: tanh with
!> drag is flat where a contact that has slid turns back, until it has gone some stick lengths. In
!> motion a contact sticks elastically up to Coulomb's limit, from the friction that it has at rest.
module gfb_moving_contacts
  use gfb_kinds, only: wp
  use gfb_contact_law, only: contact_law_type, law_coulomb, slip_of_friction
  use gfb_contact_set, only: contact_set_type
  implicit none (type, external)
  private
  public :: set_contacts_moving, take_over_friction

contains

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
end module gfb_moving_contacts
