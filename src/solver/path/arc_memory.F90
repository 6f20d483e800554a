#include "gfb_petsc.h"
!> What an arc remembers from step to step, beside its vectors, as plain numbers.
module gfb_arc_memory
  use petscvec
  use gfb_kinds, only: wp
  use gfb_arc_length, only: arc_type
  use gfb_newton, only: forget_factors
  implicit none (type)
  private
  public :: arc_numbers, recall_arc

  integer, parameter, public :: arc_memory_size = 14

contains

  !> The numbers.
  pure function arc_numbers(arc) result(number)
    type(arc_type), intent(in) :: arc
    real(wp) :: number(arc_memory_size)

    number = [arc%place, arc%place_before, arc%place_earlier, arc%heading, arc%step, arc%last_way, &
              arc%earlier_step, arc%step_limit, real(arc%orientation, wp), real(arc%retreats, wp), &
              real(arc%steps, wp), merge(1.0_wp, 0.0_wp, arc%turned), real(arc%newton%iterations, wp), &
              real(arc%newton%factorizations, wp)]
  end function arc_numbers

  !> Goes on where an arc was; its vectors have been set. The bearing is put there.
  subroutine recall_arc(number, arc)
    real(wp), intent(in) :: number(arc_memory_size) !! as `arc_numbers` gave them
    type(arc_type), intent(inout) :: arc

    arc%place = number(1)
    arc%place_before = number(2)
    arc%place_earlier = number(3)
    arc%heading = number(4)
    arc%step = number(5)
    arc%last_way = number(6)
    arc%earlier_step = number(7)
    arc%step_limit = number(8)
    arc%orientation = nint(number(9))
    arc%retreats = nint(number(10))
    arc%steps = nint(number(11))
    arc%turned = number(12) > 0.5_wp
    arc%newton%iterations = nint(number(13))
    arc%newton%factorizations = nint(number(14))
    call arc%return_to()
    call forget_factors(arc%newton)
  end subroutine recall_arc
end module gfb_arc_memory
