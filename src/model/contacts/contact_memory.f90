!> What contacts remember from one load step to the next, as plain numbers.
module gfb_contact_memory
  use gfb_kinds, only: wp
  use gfb_contact_set, only: contact_set_type
  implicit none (type, external)
  private
  public :: contact_memory, recall_contacts

  integer, parameter, public :: memory_size = 24 !! numbers of a contact

contains

  !> The memory of this rank's contacts.
  pure function contact_memory(contacts) result(memory)
    type(contact_set_type), intent(in) :: contacts
    real(wp) :: memory(memory_size, size(contacts%point)) !! [m], [N], [N/m]
    integer :: i

    do i = 1, size(contacts%point)
      associate (point => contacts%point(i))
        memory(:, i) = [point%shift, point%old_slip, point%old_force, point%place, point%anchor, &
                        point%force, reshape(point%derivative, [size(point%derivative)])]
      end associate
    end do
  end function contact_memory

  !> Gives this rank's contacts their memory back.
  pure subroutine recall_contacts(memory, contacts)
    real(wp), intent(in) :: memory(:, :) !! (`memory_size`, contacts), as `contact_memory` gave it
    type(contact_set_type), intent(inout) :: contacts
    integer :: i

    do i = 1, size(contacts%point)
      associate (point => contacts%point(i))
        point%shift = memory(1:2, i)
        point%old_slip = memory(3:4, i)
        point%old_force = memory(5:6, i)
        point%place = memory(7:9, i)
        point%anchor = memory(10:12, i)
        point%force = memory(13:15, i)
        point%derivative = reshape(memory(16:memory_size, i), shape(point%derivative))
      end associate
    end do
  end subroutine recall_contacts
end module gfb_contact_memory
