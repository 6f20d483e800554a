!> The ramp of a pad: from its leading edge on, where it opens the gap, it falls evenly along the
!> angle to the land.
module gfb_ramp_shape
  use gfb_kinds, only: wp
  use gfb_gap_shape, only: gap_shape_type
  implicit none (type, external)
  private
  public :: ramp_shape

  !> A ramp.
  type, extends(gap_shape_type), public :: ramp_shape_type
    real(wp) :: leading_edge = 0.0_wp !! where it begins [rad]
    real(wp) :: arc = 0.0_wp          !! of the ramp; 0: there is none [rad]
    real(wp) :: opening = 0.0_wp      !! what it adds to the gap at the leading edge [m]
    real(wp) :: land = 0.0_wp         !! the same all over the pad [m]
  contains
    procedure :: add_kinked => add_ramp
    procedure :: kinks => ramp_end
  end type ramp_shape_type

contains

  !> A ramp.
  pure function ramp_shape(leading_edge, arc, opening, land) result(ramp)
    real(wp), intent(in) :: leading_edge !! where it begins [rad]
    real(wp), intent(in) :: arc !! of the ramp; 0: there is none [rad]
    real(wp), intent(in) :: opening !! of the gap at the leading edge, over the land [m]
    real(wp), intent(in) :: land !! of the gap all over the pad [m]
    type(ramp_shape_type) :: ramp

    ramp%of_each_pad = .true.
    ramp%on_sides = .true.
    ramp%leading_edge = leading_edge
    ramp%arc = arc
    ramp%opening = opening
    ramp%land = land
  end function ramp_shape

  !> Takes off the ramp's height, which is less than none.
  !>
  !> $$ -\Bigl(h_0 + h_1 \max\Bigl(0, 1 - \frac{\theta - \theta_0}{\alpha}\Bigr)\Bigr) $$
  pure subroutine add_ramp(self, angle, along, height)
    class(ramp_shape_type), intent(in) :: self !! the ramp
    real(wp), intent(in) :: angle !! theta, on the pad [rad]
    real(wp), intent(in) :: along !! does not count [m]
    real(wp), intent(inout) :: height !! [m]
    real(wp) :: gap

    gap = 0.0_wp
    if (self%arc > 0.0_wp) then
      gap = self%opening*max(0.0_wp, 1.0_wp - (angle - self%leading_edge)/self%arc)
    end if
    height = height - (gap + self%land)
  end subroutine add_ramp

  !> Where the ramp ends, from an origin on [rad].
  pure function ramp_end(self, origin, arc) result(kink)
    class(ramp_shape_type), intent(in) :: self !! the ramp
    real(wp), intent(in) :: origin !! [rad]
    real(wp), intent(in) :: arc !! does not count [rad]
    real(wp), allocatable :: kink(:)

    allocate (kink(0))
    if (self%arc > 0.0_wp) kink = [self%arc + (self%leading_edge - origin)]
  end function ramp_end
end module gfb_ramp_shape
