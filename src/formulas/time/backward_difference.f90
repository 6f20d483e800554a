!> The backward difference formula of second order, BDF2, over steps of different length.
!>
!> $$ \dot y(t_n) \approx a_0 y_n + a_1 y_{n-1} + a_2 y_{n-2}, \quad
!>    a_0 = \frac{1 + 2 \omega}{(1 + \omega) \Delta_n}, \;
!>    a_1 = -\frac{1 + \omega}{\Delta_n}, \;
!>    a_2 = \frac{\omega^2}{(1 + \omega) \Delta_n}, \quad
!>    \omega = \frac{\Delta_n}{\Delta_{n-1}} $$
!>
!> Source: [HairerWanner1996] III.5. It damps what is stiff, and is stable for steps that grow by
!> less than \( 1 + \sqrt 2 \).
!>
!> By it, a mode that is driven by its supports: with the relative amplitude \( \eta \), natural
!> frequency \( \omega \) and the supports' way \( d = m^T u \), its drive,
!>
!> $$ \ddot\eta + \omega^2 \eta = -\ddot d, $$
!>
!> both accelerations differenced twice, from where amplitude and drive would be without any force:
!> \( \ddot y \approx a_0^2 (y - \hat y) \).
module gfb_backward_difference
  use gfb_kinds, only: wp
  implicit none (type, external)
  private
  public :: difference_weights, free_value, newest_rate, extrapolation_weights, error_share, &
            next_step, modal_amplitude, modal_acceleration, modal_inertia

  integer, parameter, public :: kept_times = 3 !! before the new one: what the prediction needs

  real(wp), parameter :: safety = 0.85_wp   !! of a step that the error allows [1]
  real(wp), parameter :: most_growth = 1.6_wp !! of a step [1]
  real(wp), parameter :: least_growth = 0.3_wp !! the same [1]
  real(wp), parameter :: dead_band(2) = [0.9_wp, 1.2_wp] !! changes not worth new factors [1]

contains

  !> Weights of the newest value and of the two before in the derivative by time.
  pure function difference_weights(step, before) result(weight)
    real(wp), intent(in) :: step   !! to the newest value [s]
    real(wp), intent(in) :: before !! the step before it [s]
    real(wp) :: weight(0:2)        !! a_0, a_1, a_2 [1/s]
    real(wp) :: ratio

    ratio = step/before
    weight(0) = (1.0_wp + 2.0_wp*ratio)/((1.0_wp + ratio)*step)
    weight(2) = ratio**2/((1.0_wp + ratio)*step)
    weight(1) = -(weight(0) + weight(2)) ! of what stays there is no rate, to the last digit
  end function difference_weights

  !> Values at the end of a step that nothing forces: the difference of their rates' differences is
  !> \( a_0^2 (y - \hat y) \) with
  !>
  !> $$ \hat y = y_1 - \frac{1}{a_0}
  !>    \left( a_2 (y_2 - y_1) + \frac{a_1 \dot y_1 + a_2 \dot y_2}{a_0} \right) $$
  pure function free_value(weight, value, rate) result(free)
    real(wp), intent(in) :: weight(0:2)  !! a_0, a_1, a_2 of the step [1/s]
    real(wp), intent(in) :: value(:, :)  !! (values, times) now and one step ago, in any unit
    real(wp), intent(in) :: rate(:, :)   !! (values, times) of them
    real(wp) :: free(size(value, 1)), drift(size(value, 1))

    ! Differences of values and of rates keep their digits.
    drift = weight(2)*(value(:, 2) - value(:, 1)) &
      + (weight(1)*rate(:, 1) + weight(2)*rate(:, 2))/weight(0)
    free = value(:, 1) - drift/weight(0)
  end function free_value

  !> Rates at the end of a step, \( a_0 (y - y_1) + a_2 (y_2 - y_1) \).
  pure function newest_rate(weight, newest, value) result(rate)
    real(wp), intent(in) :: weight(0:2) !! as in `free_value` [1/s]
    real(wp), intent(in) :: newest(:)   !! y that the step led to, in any unit
    real(wp), intent(in) :: value(:, :) !! (values, times) now and one step ago
    real(wp) :: rate(size(newest))
    rate = weight(0)*(newest - value(:, 1)) + weight(2)*(value(:, 2) - value(:, 1))
  end function newest_rate

  !> Weights of the last three values in the parabola through them, one step ahead.
  pure function extrapolation_weights(steps) result(weight)
    real(wp), intent(in) :: steps(:) !! (3) the new one, those between the values, newest first [s]
    real(wp) :: weight(kept_times)   !! of the values, the last one first [1]
    real(wp) :: x, back(kept_times)
    integer :: i, k

    x = steps(1)
    back = [0.0_wp, -steps(2), -steps(2) - steps(3)]
    weight = 1.0_wp
    do i = 1, kept_times
      do k = 1, kept_times
        if (k /= i) weight(i) = weight(i)*(x - back(k))/(back(i) - back(k))
      end do
    end do
  end function extrapolation_weights

  !> Error that a step makes, over the distance of its result from the parabola ahead.
  !>
  !> Both are in proportion to the third derivative: Milne's device.
  pure function error_share(steps) result(share)
    real(wp), intent(in) :: steps(:) !! (3) as in `extrapolation_weights` [s]
    real(wp) :: share                !! [1]
    real(wp) :: ratio

    ratio = steps(1)/steps(2)
    share = steps(1)*(1.0_wp + ratio)/(1.0_wp + 2.0_wp*ratio)/sum(steps)
  end function error_share

  !> The step that the error of the last one allows.
  pure function next_step(step, error) result(next)
    real(wp), intent(in) :: step  !! the last one [s]
    real(wp), intent(in) :: error !! of it, over the largest one allowed [1]
    real(wp) :: next              !! [s]
    real(wp) :: growth

    growth = most_growth
    if (error > 0.0_wp) growth = min(most_growth, safety/error**(1.0_wp/3.0_wp))
    growth = max(growth, least_growth)
    if (growth > dead_band(1) .and. growth < dead_band(2)) growth = 1.0_wp
    next = growth*step
  end function next_step

  !> The amplitude of a mode at the end of the step:
  !> \( \eta = a_0^2 (\hat\eta - (d - \hat d))/(a_0^2 + \omega^2) \).
  elemental function modal_amplitude(factor, eigenvalue, free, drive) result(amplitude)
    real(wp), intent(in) :: factor     !! a_0 [1/s]
    real(wp), intent(in) :: eigenvalue !! omega squared [1/s2]
    real(wp), intent(in) :: free       !! amplitude without any force [m sqrt(kg)]
    real(wp), intent(in) :: drive      !! d, from where it would be without one [m sqrt(kg)]
    real(wp) :: amplitude              !! [m sqrt(kg)]
    amplitude = factor**2*(free - drive)/(factor**2 + eigenvalue)
  end function modal_amplitude

  !> Its acceleration there, without a difference of large numbers:
  !> \( \ddot\eta = -a_0^2 (\omega^2 \hat\eta + a_0^2 (d - \hat d))/(a_0^2 + \omega^2) \).
  elemental function modal_acceleration(factor, eigenvalue, free, drive) result(acceleration)
    real(wp), intent(in) :: factor, eigenvalue, free, drive !! as in `modal_amplitude`
    real(wp) :: acceleration !! [m sqrt(kg)/s2]

    acceleration = modal_inertia(factor, eigenvalue)*drive &
      - factor**2*eigenvalue*free/(factor**2 + eigenvalue)
  end function modal_acceleration

  !> The derivative of the acceleration by the drive, \( -a_0^4/(a_0^2 + \omega^2) \).
  elemental function modal_inertia(factor, eigenvalue) result(inertia)
    real(wp), intent(in) :: factor, eigenvalue !! as in `modal_amplitude`
    real(wp) :: inertia !! [1/s2]
    inertia = -factor**4/(factor**2 + eigenvalue)
  end function modal_inertia
end module gfb_backward_difference
