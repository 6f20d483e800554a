!> Mean, deviation and quantiles of numbers.
module gfb_sample_statistics
  use gfb_kinds, only: wp
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
    real(wp) :: sorted(size(numbers)), place
    integer :: below

    sorted = in_order(numbers)
    place = 1.0_wp + part*(size(numbers) - 1)
    below = min(int(place), size(numbers))
    quantile = sorted(below)
    if (below == size(numbers)) return
    quantile = quantile + (place - below)*(sorted(below + 1) - sorted(below))
  end function quantile_of

  !> The numbers, the smallest first: halves are put in order and merged.
  pure recursive function in_order(numbers) result(sorted)
    real(wp), intent(in) :: numbers(:)
    real(wp) :: sorted(size(numbers))
    real(wp), allocatable :: first(:), second(:)
    integer :: i, k, place
    logical :: from_first

    sorted = numbers
    if (size(numbers) < 2) return
    first = in_order(numbers(:size(numbers)/2))
    second = in_order(numbers(size(numbers)/2 + 1:))
    i = 1
    k = 1
    do place = 1, size(sorted)
      from_first = k > size(second)
      if (.not. from_first .and. i <= size(first)) from_first = first(i) <= second(k)
      if (from_first) then
        sorted(place) = first(i)
        i = i + 1
      else
        sorted(place) = second(k)
        k = k + 1
      end if
    end do
  end function in_order
end module gfb_sample_statistics
