!> A shaft over a step of time, as its bearings feel it.
!>
!> Rates and their rates are differences of second order over the present step and the one before
!> (`gfb_backward_difference`). With \( \dot q = a_0 (q - q_1) + a_2 (q_2 - q_1) \), and
!> \( \ddot q \) the same of the rates, the equations of `gfb_shaft_equations` become
!>
!> $$ H (q - q_1) = f - (K + \Omega R) q_1 -
!>    M \bigl( a_0 a_2 (q_2 - q_1) + a_1 \dot q_1 + a_2 \dot q_2 \bigr) -
!>    (\Omega G + C) \, a_2 (q_2 - q_1), $$
!>
!> $$ H = a_0^2 M + a_0 (\Omega G + C) + K + \Omega R, $$
!>
!> which keeps the digits of small ways. The motions a = B q of the journals follow the forces f of
!> their films exactly by \( a = B q_{\rm free} + B H^{-1} B^T f \).
module gfb_shaft_step
  use gfb_kinds, only: wp
  use gfb_linear_solve, only: dense_factors_type, factorize
  use gfb_shaft_equations, only: shaft_equations_type
  implicit none (type, external)
  private
  public :: prepare_shaft_step, motion_without_films

  !> What belongs to a length of a step and a speed.
  type, public :: shaft_step_type
    real(wp), private :: weight = -1.0_wp !! a_0 [1/s]
    real(wp), private :: speed = 0.0_wp   !! Omega [rad/s]
    type(dense_factors_type), private :: factors !! of H
    real(wp), allocatable :: follows(:, :)     !! H^-1 B^T, of all motions
    real(wp), allocatable :: flexibility(:, :) !! B H^-1 B^T, of the journals'
  contains
    procedure :: serves
  end type shaft_step_type

contains

  !> Whether it is that of a step.
  pure logical function serves(self, weight, speed)
    class(shaft_step_type), intent(in) :: self !! of some step
    real(wp), intent(in) :: weight !! a_0 of the step asked for [1/s]
    real(wp), intent(in) :: speed  !! at its end [rad/s]
    serves = abs(self%weight - weight) <= 0.0_wp .and. abs(self%speed - speed) <= 0.0_wp
  end function serves

  !> Factors H.
  pure subroutine prepare_shaft_step(equations, weight, speed, place, step, regular)
    type(shaft_equations_type), intent(in) :: equations !! of all that moves
    real(wp), intent(in) :: weight !! a_0 [1/s]
    real(wp), intent(in) :: speed  !! Omega at the end of the step [rad/s]
    integer, intent(in) :: place(:) !! of the motions that films feel among all
    type(shaft_step_type), intent(out) :: step
    logical, intent(out) :: regular !! else no forces hold it
    real(wp) :: unit(size(equations%mass, 1))
    integer :: k

    step%weight = weight
    step%speed = speed
    call factorize(weight**2*equations%mass + weight*(speed*equations%gyroscopic + &
                   equations%damping) + equations%stiffness + speed*equations%circulation, &
                   step%factors, regular)
    if (.not. regular) return
    allocate (step%follows(size(unit), size(place)))
    do k = 1, size(place)
      unit = 0.0_wp
      unit(place(k)) = 1.0_wp
      step%follows(:, k) = step%factors%solution(unit)
    end do
    step%flexibility = step%follows(place, :)
  end subroutine prepare_shaft_step

  !> All motions at the end of the step where films had no force.
  pure function motion_without_films(step, equations, weight, motion, rate, force) result(free)
    type(shaft_step_type), intent(in) :: step !! prepared
    type(shaft_equations_type), intent(in) :: equations !! the same
    real(wp), intent(in) :: weight(0:2)  !! a_0, a_1, a_2 [1/s]
    real(wp), intent(in) :: motion(:, :) !! (motions, times) now and one step ago [m], [1]
    real(wp), intent(in) :: rate(:, :)   !! (motions, times) of them [m/s], [1/s]
    real(wp), intent(in) :: force(:)     !! from outside at the end of the step [N], [N m]
    real(wp) :: free(size(force)), back(size(force))

    back = weight(2)*(motion(:, 2) - motion(:, 1))
    free = matmul(equations%mass, weight(0)*back + weight(1)*rate(:, 1) + weight(2)*rate(:, 2)) &
      + matmul(step%speed*equations%gyroscopic + equations%damping, back) &
      + matmul(equations%stiffness + step%speed*equations%circulation, motion(:, 1))
    free = motion(:, 1) + step%factors%solution(force - free)
  end function motion_without_films
end module gfb_shaft_step
