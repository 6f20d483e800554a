!> The ellipse of a motion \( x = \Re (X e^{i \Omega t}), y = \Re (Y e^{i \Omega t}) \).
!>
!> It is the sum of two circles, one each way: \( x + i y = f e^{i \Omega t} + b e^{-i \Omega t} \)
!> with \( f = (X + i Y)/2 \) and \( \bar b = (X - i Y)/2 \). Its half axes are \( |f| + |b| \) and
!> \( |f| - |b| \), the longer one half way between where both begin.
module gfb_ellipse_axes
  use gfb_kinds, only: wp
  implicit none (type, external)
  private
  public :: ellipse_axes, major_axis

contains

  !> Half axes, the shorter one negative where the motion goes against the speed, and the angle of
  !> the longer one from x on, -pi/2 to pi/2.
  pure function ellipse_axes(x, y) result(axes)
    complex(wp), intent(in) :: x, y !! X and Y [m]
    real(wp) :: axes(3) !! [m], [m], [rad]
    complex(wp) :: both

    axes(1) = major_axis(x, y)
    axes(2) = abs(forward(x, y)) - abs(backward(x, y))
    both = forward(x, y)*conjg(backward(x, y))
    axes(3) = 0.5_wp*atan2(aimag(both), real(both, wp))
  end function ellipse_axes

  !> The longer half axis.
  elemental real(wp) function major_axis(x, y) result(axis)
    complex(wp), intent(in) :: x, y !! X and Y [m]
    axis = abs(forward(x, y)) + abs(backward(x, y))
  end function major_axis

  !> f.
  elemental complex(wp) function forward(x, y) result(circle)
    complex(wp), intent(in) :: x, y !! X and Y [m]
    circle = 0.5_wp*(x + cmplx(-aimag(y), real(y, wp), wp))
  end function forward

  !> The conjugate of b.
  elemental complex(wp) function backward(x, y) result(circle)
    complex(wp), intent(in) :: x, y !! X and Y [m]
    circle = 0.5_wp*(x - cmplx(-aimag(y), real(y, wp), wp))
  end function backward
end module gfb_ellipse_axes
