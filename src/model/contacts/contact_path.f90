!> Contacts that open and close along a Newton step.
!>
!> Within a step each contact's normal force is a straight line; where its penetration changes its
!> sign the line is another one, open or closed. Friction keeps its linearisation, but for what
!> follows the normal force.
module gfb_contact_path
  use gfb_kinds, only: wp
  use gfb_contact_law, only: contact_law_type, friction_force
  use gfb_contact_point, only: add_at_contact
  use gfb_contact_set, only: contact_set_type
  implicit none (type, external)
  private
  public :: begin_contact_path, next_contact, switch_contact

  integer, parameter :: normal = 3 !! component of an approach
  !> Share of a step at which no contact changes; far below `huge`, for a step that diverges is
  !> longer than a metre [1]
  real(wp), parameter, public :: never = 1.0e30_wp

contains

  !> Every contact is closed or open as it is linearised; `can` is false where forces are no lines.
  pure subroutine begin_contact_path(contacts, can)
    type(contact_set_type), intent(inout) :: contacts !! of this rank
    logical, intent(out) :: can !! all penetrations press in proportion

    can = .not. contacts%glued .and. all(abs(contacts%law%exponent - 1.0_wp) <= 0.0_wp)
    contacts%closed = contacts%point%place(normal) >= 0.0_wp
  end subroutine begin_contact_path

  !> Which contact opens or closes first on the way from one displacement to another, or beyond it.
  pure subroutine next_contact(contacts, here, ahead, share, number)
    type(contact_set_type), intent(in) :: contacts !! of this rank
    real(wp), intent(in) :: here(:), ahead(:) !! displacements of the set's unknowns [m]
    real(wp), intent(out) :: share  !! of that way; `never` where none does [1]
    integer, intent(out) :: number  !! of the contact; 0 where none does
    real(wp) :: first(normal), last(normal), change, left
    integer :: i

    share = never
    number = 0
    do i = 1, size(contacts%point)
      if (contacts%point(i)%pressed) cycle
      first = contacts%approach(i, here)
      last = contacts%approach(i, ahead)
      change = last(normal) - first(normal)
      if (contacts%closed(i)) change = -change
      if (.not. change > 0.0_wp) cycle
      ! What has just changed lies beyond zero by round-off alone.
      left = max(0.0_wp, merge(first(normal), -first(normal), contacts%closed(i)))
      if (left >= share*change) cycle
      share = left/change
      number = i
    end do
  end subroutine next_contact

  !> A contact opens, or closes: that adds the dyad of two vectors to the matrix.
  pure subroutine switch_contact(contacts, number, force, rate)
    type(contact_set_type), intent(inout) :: contacts !! of this rank
    integer, intent(in) :: number !! of the contact
    real(wp), intent(inout) :: force(:) !! added: change of residual forces by penetration [N/m]
    real(wp), intent(inout) :: rate(:)  !! added: derivative of the penetration by the unknowns [1]
    type(contact_law_type) :: law
    real(wp) :: stiffness, change(normal), rubbing(2), by_slip(2, 2), by_pressing(2)

    associate (point => contacts%point(number))
      law = contacts%law_of(point)
      stiffness = law%normal_stiffness*point%length
      change = [0.0_wp, 0.0_wp, stiffness*(1.0_wp - law%adhesion)]
      if (.not. law%adhesion > 0.0_wp .and. contacts%artificial) then
        change(normal) = stiffness - contacts%artificial_normal*point%length
      end if
      if (law%friction > 0.0_wp) then
        call friction_force(law, point%place(:2), max(point%force(normal), 0.0_wp), rubbing, &
                            by_slip, by_pressing)
        change(:2) = stiffness*by_pressing
      end if
      contacts%closed(number) = .not. contacts%closed(number)
      if (.not. contacts%closed(number)) change = -change
      change = matmul(point%frame, change)
      call add_at_contact(point, -change, force)
    end associate
    call contacts%add_penetration_rate(number, 1.0_wp, rate)
  end subroutine switch_contact
end module gfb_contact_path
