!> How far contacts penetrate and slide at an answer: what the numbers of their laws are judged by.
module gfb_contact_measures
  use gfb_kinds, only: wp
  use gfb_contact_set, only: contact_set_type
  implicit none (type, external)
  private
  public :: contact_extremes, contact_sums, measures_of

  integer, parameter, public :: extremes = 2, summed = 2 !! numbers of contacts

  !> What contacts say of the numbers of their laws.
  type, public :: contact_measures_type
    real(wp) :: penetration = 0.0_wp !! largest [m]
    !> largest since the foils were at rest, of those that are pressed together and rub [m]
    real(wp) :: slip = 0.0_wp
    !> friction that has not come up, times the slip, over the force on all contacts [m]
    real(wp) :: lacking = 0.0_wp
  end type contact_measures_type

contains

  !> Largest penetration and slip.
  pure function contact_extremes(contacts) result(largest)
    type(contact_set_type), intent(in) :: contacts !! this rank's, linearised at the answer
    real(wp) :: largest(extremes) !! [m]
    integer :: i

    largest = 0.0_wp
    if (.not. allocated(contacts%point)) return
    do i = 1, size(contacts%point)
      associate (point => contacts%point(i))
        if (.not. point%pressed) then
          if (.not. point%place(3) > 0.0_wp) cycle
          largest(1) = max(largest(1), point%place(3))
        end if
        if (.not. contacts%law(point%law)%friction > 0.0_wp) cycle
        largest(2) = max(largest(2), norm2(point%place(:2) + point%shift))
      end associate
    end do
  end function contact_extremes

  !> Friction that has not come up times the slip, and the force on all contacts.
  !>
  !> $$ \sum (\mu f_n - |t|) |s|, \qquad \sum f_n $$
  !>
  !> The first is nothing where Coulomb's law holds: a contact that has slid feels its whole
  !> friction, one that sticks has not slid. In motion it says nothing: what turns back sticks.
  pure function contact_sums(contacts) result(sums)
    type(contact_set_type), intent(in) :: contacts !! this rank's, linearised at the answer
    real(wp) :: sums(summed) !! [J], [N]
    real(wp) :: pressing, lacking
    integer :: i

    sums = 0.0_wp
    if (.not. allocated(contacts%point)) return
    do i = 1, size(contacts%point)
      associate (point => contacts%point(i))
        pressing = max(0.0_wp, merge(point%pressing, point%force(3), point%pressed))
        lacking = contacts%law(point%law)%friction*pressing - norm2(point%force(:2))
        if (contacts%keeps_friction) lacking = 0.0_wp
        sums = sums + [max(0.0_wp, lacking)*norm2(point%place(:2)), pressing]
      end associate
    end do
  end function contact_sums

  !> The measures of all contacts.
  pure function measures_of(largest, sums) result(measures)
    real(wp), intent(in) :: largest(extremes) !! of all ranks
    real(wp), intent(in) :: sums(summed) !! over all ranks
    type(contact_measures_type) :: measures

    measures%penetration = largest(1)
    measures%slip = largest(2)
    if (sums(2) > 0.0_wp) measures%lacking = sums(1)/sums(2)
  end function measures_of
end module gfb_contact_measures
