!> A Runge-Kutta method of order 4 for what is stiff, in steps of five implicit stages.
!>
!> $$ y_i = y_n + \Delta \sum_{j=1}^{i} a_{ij} \dot y_j, \quad a_{ii} = \tfrac14 \; (i > 1),
!>    \quad y_{n+1} = y_6 $$
!>
!> The first stage is the state itself with the rate that the last step has left, the last one the
!> answer. To its equations a stage is a backward difference,
!>
!> $$ \dot y_i = a_0 (y_i - y_i^*), \quad a_0 = \frac{1}{a_{ii} \Delta}, \quad
!>    y_i^* = y_n + \Delta \sum_{j<i} a_{ij} \dot y_j, $$
!>
!> of one factor for all stages. It damps what is stiff (L-stable) and meets algebraic equations at
!> its end (stiffly accurate).
!>
!> Source: [KennedyCarpenter2003] ARK4(3)6L[2]SA, the implicit part, with the embedded method of
!> order 3.
module gfb_runge_kutta
  use gfb_kinds, only: wp
  implicit none (type, external)
  private
  public :: is_passed, interpolation_weights, cubic_weights

  integer, parameter, public :: stages = 6 !! the first one without equations

  real(wp), parameter, public :: diagonal = 0.25_wp !! a_ii of the others [1]

  !> (stages, stages) a_ij, a row for each stage [1].
  real(wp), parameter, public :: stage_weight(stages, stages) = reshape([ &
    0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, &
    diagonal, diagonal, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, &
    8611.0_wp/62500.0_wp, -1743.0_wp/31250.0_wp, diagonal, 0.0_wp, 0.0_wp, 0.0_wp, &
    5012029.0_wp/34652500.0_wp, -654441.0_wp/2922500.0_wp, 174375.0_wp/388108.0_wp, &
    diagonal, 0.0_wp, 0.0_wp, &
    15267082809.0_wp/155376265600.0_wp, -71443401.0_wp/120774400.0_wp, &
    730878875.0_wp/902184768.0_wp, 2285395.0_wp/8070912.0_wp, diagonal, 0.0_wp, &
    82889.0_wp/524892.0_wp, 0.0_wp, 15625.0_wp/83664.0_wp, 69875.0_wp/102672.0_wp, &
    -2260.0_wp/8211.0_wp, diagonal], &
    [stages, stages], order=[2, 1])

  !> Times of the stages within the step, c_i [1].
  real(wp), parameter, public :: stage_time(stages) = &
    [0.0_wp, 0.5_wp, 0.332_wp, 0.62_wp, 0.85_wp, 1.0_wp]

  !> Weights of the rates in the error of the embedded method of order 3, over the step [1].
  real(wp), parameter, public :: error_weight(stages) = stage_weight(stages, :) - [ &
    4586570599.0_wp/29645900160.0_wp, 0.0_wp, 178811875.0_wp/945068544.0_wp, &
    814220225.0_wp/1159782912.0_wp, -3700637.0_wp/11593932.0_wp, 61727.0_wp/225920.0_wp]

contains

  !> Whether all stages after one lie later in time: what has a memory may remember its state.
  pure logical function is_passed(stage)
    integer, intent(in) :: stage !! of the step
    is_passed = all(stage_time(stage + 1:) > stage_time(stage))
  end function is_passed

  !> Weights of values at given times in the polynomial through them, at another time.
  pure function interpolation_weights(time, at) result(weight)
    real(wp), intent(in) :: time  !! of the value that is asked for [s]
    real(wp), intent(in) :: at(:) !! times of the values, all different [s]
    real(wp) :: weight(size(at))  !! of the values [1]
    integer :: i, k

    weight = 1.0_wp
    do i = 1, size(at)
      do k = 1, size(at)
        if (k /= i) weight(i) = weight(i)*(time - at(k))/(at(i) - at(k))
      end do
    end do
  end function interpolation_weights

  !> Weights of the values at both ends of a step and of their rates in the cubic of them.
  pure function cubic_weights(share, step) result(weight)
    real(wp), intent(in) :: share !! of the step that is over [1]
    real(wp), intent(in) :: step  !! [s]
    real(wp) :: weight(4) !! of the values at the end and at the beginning [1], of the rates [s]

    weight(1) = share**2*(3.0_wp - 2.0_wp*share)
    weight(2) = 1.0_wp - weight(1)
    weight(3) = step*share**2*(share - 1.0_wp)
    weight(4) = step*share*(share - 1.0_wp)**2
  end function cubic_weights
end module gfb_runge_kutta
