!> What contacts remember from one load step to the next: a column of numbers each.
module gfb_contact_memory
  use gfb_kinds, only: wp
  use gfb_memory, only: memory_type, open_memory
  use gfb_contact_point, only: contact_point_type
  use gfb_contact_set, only: contact_set_type
  implicit none (type, external)
  private
  public :: pack_contacts, unpack_contacts

contains

  !> Packs or unpacks the memory of a contact.
  pure subroutine remember_contact(memory, point)
    type(memory_type), intent(inout) :: memory !! packs or unpacks
    type(contact_point_type), intent(inout) :: point !! written where the memory unpacks

    call memory%visit('shift', point%shift)
    call memory%visit('old_slip', point%old_slip)
    call memory%visit('old_force', point%old_force)
    call memory%visit('stick_pressing', point%stick_pressing)
    call memory%visit('place', point%place)
    call memory%visit('anchor', point%anchor)
    call memory%visit('force', point%force)
    call memory%visit('derivative', point%derivative)
  end subroutine remember_contact

  !> The memory of this rank's contacts. The words are the same for all contacts and on all ranks.
  pure subroutine pack_contacts(contacts, words, column)
    type(contact_set_type), intent(in) :: contacts !! of this rank
    character(len=:), allocatable, intent(out) :: words !! that say what the numbers are
    real(wp), allocatable, intent(out) :: column(:, :)  !! (numbers, contacts) [m], [N], [N/m]
    type(memory_type) :: memory
    type(contact_point_type) :: point
    integer :: i

    call remember_contact(memory, point)
    words = memory%words()
    allocate (column(size(memory%numbers()), size(contacts%point)))
    do i = 1, size(contacts%point)
      memory = memory_type()
      point = contacts%point(i)
      call remember_contact(memory, point)
      column(:, i) = memory%numbers()
    end do
  end subroutine pack_contacts

  !> Gives this rank's contacts their memory back.
  pure subroutine unpack_contacts(words, column, contacts, failed)
    character(len=*), intent(in) :: words    !! as `pack_contacts` gave them
    real(wp), intent(in) :: column(:, :)     !! the same, (numbers, contacts) [m], [N], [N/m]
    type(contact_set_type), intent(inout) :: contacts !! of this rank, with the laws they had
    logical, intent(inout) :: failed         !! words or numbers do not fit
    type(memory_type) :: memory
    integer :: i

    do i = 1, size(contacts%point)
      call open_memory(column(:, i), words, memory)
      call remember_contact(memory, contacts%point(i))
      call memory%finish()
      failed = failed .or. memory%failed
    end do
  end subroutine unpack_contacts
end module gfb_contact_memory
