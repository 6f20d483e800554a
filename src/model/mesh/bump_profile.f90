!> The curve of one bump: a circular arc between its two corners.
!>
!> $$ R_b = \frac{l^2 + h_b^2}{2 h_b} $$
module gfb_bump_profile
  use gfb_kinds, only: wp
  implicit none (type, external)
  private
  public :: arc_point, arc_normal

contains

  !> Radius of the arc [m].
  elemental real(wp) function arc_radius(half_length, height) result(radius)
    real(wp), intent(in) :: half_length !! l, half the chord [m]
    real(wp), intent(in) :: height      !! h_b, at most l [m]
    radius = (half_length**2 + height**2)/(2.0_wp*height)
  end function arc_radius

  !> Point (x, v) at a fraction of the arc's length, from the corner (0, 0) over the crest (l, h_b).
  pure function arc_point(half_length, height, fraction) result(point)
    real(wp), intent(in) :: half_length, height !! l, h_b [m]
    real(wp), intent(in) :: fraction !! 0 to 1; corners and crest are exact [1]
    real(wp) :: point(2), turn

    if (fraction <= 0.0_wp) then
      point = 0.0_wp
    else if (fraction >= 1.0_wp) then
      point = [2.0_wp*half_length, 0.0_wp]
    else
      turn = (2.0_wp*fraction - 1.0_wp)*half_angle(half_length, height)
      point(1) = half_length + arc_radius(half_length, height)*sin(turn)
      ! Versine by the half angle: the crest is at h_b to the last digit.
      point(2) = height - 2.0_wp*arc_radius(half_length, height)*sin(0.5_wp*turn)**2
    end if
  end function arc_point

  !> Unit normal (x, v) there, away from the arc's centre: towards the shaft.
  pure function arc_normal(half_length, height, fraction) result(normal)
    real(wp), intent(in) :: half_length, height !! l, h_b [m]
    real(wp), intent(in) :: fraction !! of the arc, 0 to 1 [1]
    real(wp) :: normal(2), turn

    turn = (2.0_wp*fraction - 1.0_wp)*half_angle(half_length, height)
    normal = [sin(turn), cos(turn)]
  end function arc_normal

  !> Half the angle of the arc [rad].
  pure real(wp) function half_angle(half_length, height) result(angle)
    real(wp), intent(in) :: half_length, height !! l, h_b [m]
    angle = 2.0_wp*atan2(height, half_length)
  end function half_angle
end module gfb_bump_profile
