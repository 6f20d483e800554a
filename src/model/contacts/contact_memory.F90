#include "gfb_petsc.h"
!> What contacts remember from one load step to the next, as a field of an archive.
module gfb_contact_memory
  use gfb_kinds, only: wp
  use gfb_archive, only: archive_type, open_archive
  use gfb_petsc_session, only: largest_number
  use gfb_natural_order, only: natural_order_type, visit_field
  use gfb_contact_point, only: contact_point_type
  use gfb_contact_set, only: contact_set_type
  use gfb_bump_contacts, only: contact_sleeve, contact_top
  implicit none (type)
  private
  public :: contact_order, visit_contacts

contains

  !> Order of contacts: surface by surface, line by line, node by node. All ranks ask.
  function contact_order(contacts, rows) result(order)
    type(contact_set_type), intent(in) :: contacts !! of all surfaces
    integer, intent(in) :: rows !! nodes of a line
    type(natural_order_type) :: order
    integer :: sleeve_lines

    associate (point => contacts%point)
      sleeve_lines = largest_number(pack(point%line, point%law == contact_sleeve))
      order%number = (point%line - 1)*rows + modulo(point%node - 1, rows) + 1
      where (point%law == contact_top) order%number = order%number + sleeve_lines*rows
    end associate
    order%total = largest_number(order%number)
  end function contact_order

  !> Saves or restores what contacts remember, a column of numbers each. All ranks ask.
  subroutine visit_contacts(archive, name, rows, contacts)
    type(archive_type), intent(inout) :: archive !! that saves or restores
    character(len=*), intent(in) :: name !! of the field, of its own in the archive
    integer, intent(in) :: rows !! nodes of a line
    type(contact_set_type), intent(inout) :: contacts !! of this rank, with the laws they had; written where the archive restores
    type(archive_type) :: one
    type(contact_point_type) :: point
    character(len=:), allocatable :: words
    real(wp), allocatable :: column(:, :)
    integer :: i

    call visit_contact(one, point)
    words = one%words()
    allocate (column(size(one%numbers()), size(contacts%point)))
    do i = 1, size(contacts%point)
      one = archive_type()
      call visit_contact(one, contacts%point(i))
      column(:, i) = one%numbers()
    end do
    call visit_field(archive, name, contact_order(contacts, rows), column)
    if (archive%saves .or. archive%failed) return
    do i = 1, size(contacts%point)
      call open_archive(column(:, i), words, one)
      call visit_contact(one, contacts%point(i))
    end do
  end subroutine visit_contacts

  !> Saves or restores what a contact remembers from one load step to the next.
  pure subroutine visit_contact(archive, point)
    type(archive_type), intent(inout) :: archive
    type(contact_point_type), intent(inout) :: point

    call archive%visit('shift', point%shift)
    call archive%visit('old_slip', point%old_slip)
    call archive%visit('old_force', point%old_force)
    call archive%visit('stick_pressing', point%stick_pressing)
    call archive%visit('place', point%place)
    call archive%visit('anchor', point%anchor)
    call archive%visit('force', point%force)
    call archive%visit('derivative', point%derivative)
  end subroutine visit_contact
end module gfb_contact_memory
