#include "gfb_petsc.h"
!> What contacts remember from one load step to the next, as a field of an archive.
!>
!> What friction remembers of the past, as numbers of a state: where the laws have their zero, and
!> in motion the normal force that the stiffness of sticking is of.
!>
!> All else that a contact remembers between steps follows from that and from where the foils are.
module gfb_contact_memory
  use gfb_kinds, only: wp
  use gfb_contact_law, only: normal_force
  use gfb_contact_set, only: contact_set_type
  use gfb_archive, only: archive_type, open_archive
  use gfb_petsc_session, only: largest_number
  use gfb_natural_order, only: natural_order_type, visit_field
  use gfb_contact_point, only: contact_point_type
  use gfb_bump_contacts, only: contact_sleeve, contact_top
  implicit none (type)
  private
  public :: slips_of, put_slips, contact_order, visit_contacts

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
