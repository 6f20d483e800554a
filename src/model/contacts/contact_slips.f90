!> What friction remembers of the past, as numbers of a state: where the laws have their zero, and
!> in motion the normal force that the stiffness of sticking is of.
!>
!> All else that a contact remembers between steps follows from that and from where the foils are.
module gfb_contact_slips
  use gfb_kinds, only: wp
  use gfb_contact_law, only: normal_force
  use gfb_contact_set, only: contact_set_type
  implicit none (type, external)
  private
  public :: slips_of, put_slips

  integer, parameter, public :: slip_entries = 3 !! of a contact

contains

  !> The slip of every contact that its law does not feel, u_s, and the normal force that its
  !> stiffness is of, as a length.
  pure function slips_of(contacts) result(slip)
    type(contact_set_type), intent(in) :: contacts !! of this rank, after a commit
    real(wp) :: slip(slip_entries*size(contacts%point)) !! two tangents and that force a contact [m]
    integer :: i

    do i = 1, size(contacts%point)
      associate (point => contacts%point(i))
        slip(3*i - 2:3*i) = [point%shift, point%stick_pressing*compliance(contacts, i)]
      end associate
    end do
  end function slips_of

  !> The stick length over a contact's typical normal force: both are the sizes of what a contact
  !> remembers.
  pure function compliance(contacts, i) result(value)
    type(contact_set_type), intent(in) :: contacts
    integer, intent(in) :: i !! contact
    real(wp) :: value !! [m/N]
    real(wp) :: force, slope

    associate (law => contacts%law(contacts%point(i)%law))
      call normal_force(law, contacts%point(i)%length, contacts%secant_penetration, force, slope)
      value = law%stick_length/force
    end associate
  end function compliance

  !> Puts contacts where a step has ended with such slips: as `commit` leaves them.
  pure subroutine put_slips(slip, displacement, contacts)
    real(wp), intent(in) :: slip(:) !! as `slips_of` gave them [m]
    real(wp), intent(in) :: displacement(:) !! of the set's unknowns [m]
    type(contact_set_type), intent(inout) :: contacts !! of this rank
    integer :: i

    do i = 1, size(contacts%point)
      contacts%point(i)%shift = slip(3*i - 2:3*i - 1)
      contacts%point(i)%stick_pressing = slip(3*i)/compliance(contacts, i)
      associate (now => contacts%approach(i, displacement), point => contacts%point(i))
        point%place = now
        point%anchor = now
        point%old_slip = now(:2) + point%shift
      end associate
    end do
    call contacts%linearise_again()
    do i = 1, size(contacts%point)
      contacts%point(i)%old_force = contacts%point(i)%force(:2)
    end do
  end subroutine put_slips
end module gfb_contact_slips
