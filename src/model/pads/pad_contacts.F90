!> The contacts of all pads' foils, and how their law is changed while an answer is looked for.
module gfb_pad_contacts
  use gfb_kinds, only: wp
  use gfb_petsc_session, only: largest_number
  use gfb_bump_contacts, only: contact_sleeve, contact_top
  use gfb_contact_set, only: contact_set_type
  use gfb_bearing_system, only: bearing_system_type
  implicit none (type, external)
  private
  public :: set_hardness, set_adhesion, linearise_exactly, pad_contacts

contains

  !> Makes the contacts of all pads softer than the scene has them.
  subroutine set_hardness(bearing, hardness)
    type(bearing_system_type), intent(inout) :: bearing !! pads and shaft
    real(wp), intent(in) :: hardness !! factor of their normal stiffness [1]
    integer :: i

    do i = 1, size(bearing%pad)
      bearing%pad(i)%foil%contacts%hardness = hardness
    end do
  end subroutine set_hardness

  !> Makes the contacts of all pads two-way (adhesive).
  subroutine set_adhesion(bearing, adhesion)
    type(bearing_system_type), intent(inout) :: bearing !! pads and shaft
    real(wp), intent(in) :: adhesion !! stiffness against opening over that against closing [1]
    integer :: i

    do i = 1, size(bearing%pad)
      bearing%pad(i)%foil%contacts%adhesion = adhesion
    end do
  end subroutine set_adhesion

  !> Whether the matrix has a stiffness at contacts that are open: it keeps Newton's steps short, but is no derivative.
  subroutine set_artificial_stiffness(bearing, artificial)
    type(bearing_system_type), intent(inout) :: bearing !! pads and shaft
    logical, intent(in) :: artificial !! it has
    integer :: i

    do i = 1, size(bearing%pad)
      bearing%pad(i)%foil%contacts%artificial = artificial
    end do
  end subroutine set_artificial_stiffness

  !> The bearing's matrix at its state, without the artificial stiffness of contacts that are open: that keeps Newton's
  !> steps short, but is no derivative.
  subroutine linearise_exactly(bearing, fixed)
    type(bearing_system_type), intent(inout) :: bearing !! whose contacts are linearised
    logical, intent(in) :: fixed !! the shaft is fixed

    call set_artificial_stiffness(bearing, .false.)
    call bearing%linearise_at(bearing%point, fixed, bearing%state)
    call set_artificial_stiffness(bearing, .true.)
  end subroutine linearise_exactly

  !> This rank's contacts of all pads, each of one node; contact lines are numbered on from pad to pad. All ranks ask.
  function pad_contacts(bearing) result(contacts)
    type(bearing_system_type), intent(in) :: bearing !! pads and shaft
    type(contact_set_type) :: contacts
    type(contact_set_type) :: one
    integer :: sleeve_lines, top_lines, i

    contacts = bearing%pad(1)%foil%nodal_contacts()
    if (size(bearing%pad) == 1 .or. .not. bearing%has_contacts()) return
    sleeve_lines = largest_number(pack(contacts%point%line, contacts%point%law == contact_sleeve))
    top_lines = largest_number(pack(contacts%point%line, contacts%point%law == contact_top))
    do i = 2, size(bearing%pad)
      one = bearing%pad(i)%foil%nodal_contacts()
      one%point%line = one%point%line + (i - 1)*merge(sleeve_lines, top_lines, one%point%law == contact_sleeve)
      contacts%point = [contacts%point, one%point]
    end do
  end function pad_contacts
end module gfb_pad_contacts
