!> A table with a smooth curve through it that never overshoots: monotone piecewise cubics.
!>
!> Source: [FritschButland1984] (the PCHIP of SLATEC and SciPy). Value and slope are continuous, the
!> curvature jumps at the points.
module gfb_monotone_table
  use gfb_kinds, only: wp
  implicit none (type, external)
  private
  public :: monotone_table, table_at

  !> Points and slopes.
  type, public :: monotone_table_type
    real(wp), allocatable :: place(:) !! rising
    real(wp), allocatable :: value(:) !! there
    real(wp), allocatable :: slope(:) !! there
  end type monotone_table_type

contains

  !> The curve through points.
  pure function monotone_table(place, value) result(table)
    real(wp), intent(in) :: place(:) !! rising, two at least [any unit]
    real(wp), intent(in) :: value(:) !! there [any unit]
    type(monotone_table_type) :: table
    real(wp), dimension(size(place) - 1) :: length, rise
    integer :: i, n

    n = size(place)
    table%place = place
    table%value = value
    length = place(2:) - place(:n - 1)
    rise = (value(2:) - value(:n - 1))/length
    allocate (table%slope(n), source=rise(1))
    if (n == 2) return
    do i = 2, n - 1
      table%slope(i) = inner_slope(length(i - 1), length(i), rise(i - 1), rise(i))
    end do
    table%slope(1) = end_slope(length(1), length(2), rise(1), rise(2))
    table%slope(n) = end_slope(length(n - 1), length(n - 2), rise(n - 1), rise(n - 2))
  end function monotone_table

  !> Slope between two intervals: their harmonic mean, none at an extremum.
  elemental function inner_slope(before, after, rise_before, rise_after) result(slope)
    real(wp), intent(in) :: before, after           !! lengths of the intervals
    real(wp), intent(in) :: rise_before, rise_after !! their mean slopes
    real(wp) :: slope

    slope = 0.0_wp
    if (rise_before*rise_after <= 0.0_wp) return
    slope = 3.0_wp*(before + after)/((2.0_wp*after + before)/rise_before &
                                     + (after + 2.0_wp*before)/rise_after)
  end function inner_slope

  !> Slope at an end: that of a parabola through three points, as far as it stays monotone.
  elemental function end_slope(length, next, rise, next_rise) result(slope)
    real(wp), intent(in) :: length, next    !! of the last interval and the one beside it
    real(wp), intent(in) :: rise, next_rise !! their mean slopes
    real(wp) :: slope

    slope = ((2.0_wp*length + next)*rise - length*next_rise)/(length + next)
    if (slope*rise <= 0.0_wp) then
      slope = 0.0_wp
    else if (rise*next_rise <= 0.0_wp .and. abs(slope) > 3.0_wp*abs(rise)) then
      slope = 3.0_wp*rise
    end if
  end function end_slope

  !> Value and two derivatives.
  !>
  !> Beyond the ends, where only iterates come, it goes on with the slope there, and stays positive
  !> where the end is.
  pure subroutine table_at(table, place, value, slope, curvature)
    type(monotone_table_type), intent(in) :: table !! points and slopes
    real(wp), intent(in) :: place  !! [as the table]
    real(wp), intent(out) :: value !! [as the table]
    real(wp), intent(out) :: slope !! derivative [as the table]
    real(wp), intent(out) :: curvature !! second derivative [as the table]
    real(wp) :: t, jump, first, second !! in the interval; its rise less those of the end slopes
    integer :: i, last, middle

    i = 1
    last = size(table%place)
    if (place < table%place(1)) then
      call go_on(table%value(1), table%slope(1), place - table%place(1), value, slope, curvature)
      return
    else if (place > table%place(last)) then
      call go_on(table%value(last), table%slope(last), place - table%place(last), value, slope, &
                 curvature)
      return
    end if
    do while (last - i > 1)
      middle = (i + last)/2
      if (place >= table%place(middle)) then
        i = middle
      else
        last = middle
      end if
    end do
    associate (length => table%place(i + 1) - table%place(i))
      t = (place - table%place(i))/length
      jump = table%value(i + 1) - table%value(i)
      first = table%slope(i)*length
      second = table%slope(i + 1)*length
      value = table%value(i) + t*(first + t*(3.0_wp*jump - 2.0_wp*first - second &
                                             + t*(first + second - 2.0_wp*jump)))
      slope = (first + t*(2.0_wp*(3.0_wp*jump - 2.0_wp*first - second) &
                          + 3.0_wp*t*(first + second - 2.0_wp*jump)))/length
      curvature = (2.0_wp*(3.0_wp*jump - 2.0_wp*first - second) &
                   + 6.0_wp*t*(first + second - 2.0_wp*jump))/length**2
    end associate
  end subroutine table_at

  !> A line from an end, or where that falls an exponential.
  elemental subroutine go_on(end_value, end_slope, distance, value, slope, curvature)
    real(wp), intent(in) :: end_value, end_slope
    real(wp), intent(in) :: distance !! from the end
    real(wp), intent(out) :: value, slope, curvature

    if (end_slope*distance*end_value >= 0.0_wp) then
      value = end_value + end_slope*distance
      slope = end_slope
      curvature = 0.0_wp
    else
      value = end_value*exp(end_slope*distance/end_value)
      slope = value*end_slope/end_value
      curvature = slope*end_slope/end_value
    end if
  end subroutine go_on
end module gfb_monotone_table
