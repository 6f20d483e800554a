!> Mean, deviation and quantiles of numbers.
module gfb_sample_statistics
  use gfb_kinds, only: wp
  use gfb_sorting, only: sorted
  implicit none (type, external)
  private
  public :: mean_of, deviation_of, quantile_of

contains

  !> Mean of some numbers [their unit].
  pure real(wp) function mean_of(numbers) result(mean)
    real(wp), intent(in) :: numbers(:) !! [any unit] one at least

    mean = sum(numbers)/size(numbers)
    mean = mean + sum(numbers - mean)/size(numbers) ! what the first sum rounded
  end function mean_of

  !> Standard deviation of the law from which some numbers are [their unit].
  !>
  !> $$ s^2 = \frac{1}{n - 1} \sum_i (x_i - \bar x)^2 $$
  pure real(wp) function deviation_of(numbers) result(deviation)
    real(wp), intent(in) :: numbers(:) !! [any unit] two at least
    deviation = norm2(numbers - mean_of(numbers))/sqrt(real(size(numbers) - 1, wp))
  end function deviation_of

  !> The number below which a part of some numbers lies, straight between them: the smallest for 0,
  !> the largest for 1 [their unit].
  pure real(wp) function quantile_of(numbers, part) result(quantile)
    real(wp), intent(in) :: numbers(:) !! [any unit] one at least
    real(wp), intent(in) :: part       !! between 0 and 1 [1]
    real(wp) :: rising(size(numbers)), place
    integer :: below

    rising = sorted(numbers)
    place = 1.0_wp + part*(size(numbers) - 1)
    below = min(int(place), size(numbers))
    quantile = rising(below)
    if (below == size(numbers)) return
    quantile = quantile + (place - below)*(rising(below + 1) - rising(below))
  end function quantile_of
end module gfb_sample_statistics
