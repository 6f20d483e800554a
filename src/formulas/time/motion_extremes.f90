!> Extremes of a motion that is known at some instants, wherever these lie.
!>
!> Between two instants the motion is the parabola through them and the one before (for the first
!> two the one behind). At an extreme of an oscillation of frequency w in steps D it errs by about
!> (w D)^4/30 of the amplitude, 4e-6 with 60 steps a period; the largest of the instants
!> themselves by up to (w D)^2/8, 1.4e-3.
module gfb_motion_extremes
  use gfb_kinds, only: wp
  implicit none (type, external)
  private
  public :: extremes_of

contains

  !> Smallest and largest value between two times; those of the instants where there are fewer than
  !> three.
  pure function extremes_of(time, value, from, to) result(extremes)
    real(wp), intent(in) :: time(:)  !! (instants) rising [s]
    real(wp), intent(in) :: value(:) !! (instants) in its unit [SI]
    real(wp), intent(in) :: from, to !! not before the first instant, not behind the last one [s]
    real(wp) :: extremes(2)
    real(wp) :: ends(2), slope(2), curvature, vertex, seen(3)
    integer :: first, i

    if (size(time) < 3) then
      extremes = [minval(value), maxval(value)]
      return
    end if
    extremes = [huge(1.0_wp), -huge(1.0_wp)]
    do i = 2, size(time)
      if (time(i) < from .or. time(i - 1) > to) cycle
      first = max(1, i - 2)
      ends = [max(from, time(i - 1)), min(to, time(i))]
      associate (t => time(first:first + 2), y => value(first:first + 2))
        ! y_2 + (t - t_2) (s_1 + c (t - t_2)), by divided differences.
        slope = (y(2:) - y(:2))/(t(2:) - t(:2))
        curvature = (slope(2) - slope(1))/(t(3) - t(1))
        slope(1) = slope(1) + curvature*(t(2) - t(1))
        seen(:2) = y(2) + (ends - t(2))*(slope(1) + curvature*(ends - t(2)))
        seen(3) = seen(1)
        if (abs(curvature) > 0.0_wp) then
          vertex = t(2) - 0.5_wp*slope(1)/curvature
          if (vertex > ends(1) .and. vertex < ends(2)) then
            seen(3) = y(2) + 0.5_wp*(vertex - t(2))*slope(1)
          end if
        end if
      end associate
      extremes = [min(extremes(1), minval(seen)), max(extremes(2), maxval(seen))]
    end do
  end function extremes_of
end module gfb_motion_extremes
