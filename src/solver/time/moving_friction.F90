#include "gfb_petsc.h"
!> Friction of foils that begin to move: the law of motions takes over from that of the state at rest.
module gfb_moving_friction
  use gfb_kinds, only: wp
  use gfb_contacts_in_motion, only: set_contacts_moving, take_over_friction
  use gfb_bearing_system, only: bearing_system_type
  implicit none (type)
  private
  public :: begin_rubbing

contains

  !> All contacts rub as motions have it from now on; what they rub with stays as it is.
  subroutine begin_rubbing(bearing, goes_on)
    type(bearing_system_type), intent(inout) :: bearing !! at rest, or where a restart file has left it
    logical, intent(in) :: goes_on !! its contacts remember what they did in motion
    real(wp) :: unknown(bearing%local_size())
    integer :: i

    if (.not. bearing%is_meshed()) return
    call bearing%get_unknowns(unknown)
    do i = 1, size(bearing%pad)
      associate (pad => bearing%pad(i))
        call set_contacts_moving(pad%foil%contacts)
        if (goes_on) cycle
        call take_over_friction(pad%foil%own_part(unknown(pad%first + 1:pad%last)), pad%foil%contacts)
      end associate
    end do
  end subroutine begin_rubbing
end module gfb_moving_friction
