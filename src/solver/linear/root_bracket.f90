!> False position with halved weights (Illinois) for a root between two places.
!>
!> After a step that stays on one side the value at the other end counts half, so that both ends
!> close in. Source: [DowellJarratt1971].
module gfb_root_bracket
  use gfb_kinds, only: wp
  implicit none (type, external)
  private

  !> Two places with a root between them, and the values there.
  type, public :: root_bracket_type
    real(wp) :: low, high       !! places; the last trial is `high`
    real(wp) :: at_low, at_high !! values there, the one at `low` halved where it stays
  contains
    procedure :: trial, narrow
  end type root_bracket_type

contains

  !> Where the line between both values vanishes.
  pure real(wp) function trial(bracket)
    class(root_bracket_type), intent(in) :: bracket

    associate (low => bracket%low, high => bracket%high, at_low => bracket%at_low, &
               at_high => bracket%at_high)
      trial = (low*at_high - high*at_low)/(at_high - at_low)
    end associate
  end function trial

  !> Takes a trial for the nearer end.
  pure subroutine narrow(bracket, place, value)
    class(root_bracket_type), intent(inout) :: bracket
    real(wp), intent(in) :: place !! the trial
    real(wp), intent(in) :: value !! there

    if (value*bracket%at_high < 0.0_wp) then
      bracket%low = bracket%high
      bracket%at_low = bracket%at_high
    else
      bracket%at_low = 0.5_wp*bracket%at_low
    end if
    bracket%high = place
    bracket%at_high = value
  end subroutine narrow
end module gfb_root_bracket
