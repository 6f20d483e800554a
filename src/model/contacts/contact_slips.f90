!> What friction remembers of the past, as numbers of a state: where the laws have their zero.
!>
!> All else that a contact remembers between steps follows from that and from where the foils are.
module gfb_contact_slips
  use gfb_kinds, only: wp
  use gfb_contact_set, only: contact_set_type
  implicit none (type, external)
  private
  public :: slips_of, put_slips

contains

  !> The slip of every contact that its law does not feel, u_s.
  pure function slips_of(contacts) result(slip)
    type(contact_set_type), intent(in) :: contacts !! of this rank, after a commit
    real(wp) :: slip(2*size(contacts%point)) !! two tangents a contact [m]
    integer :: i

    do i = 1, size(contacts%point)
      slip(2*i - 1:2*i) = contacts%point(i)%shift
    end do
  end function slips_of

  !> Puts contacts where a step has ended with such slips: as `commit` leaves them.
  pure subroutine put_slips(slip, displacement, contacts)
    real(wp), intent(in) :: slip(:) !! two tangents a contact [m]
    real(wp), intent(in) :: displacement(:) !! of the set's unknowns [m]
    type(contact_set_type), intent(inout) :: contacts !! of this rank
    integer :: i

    do i = 1, size(contacts%point)
      contacts%point(i)%shift = slip(2*i - 1:2*i)
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
