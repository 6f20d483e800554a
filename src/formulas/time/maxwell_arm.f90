!> A Maxwell arm, spring and dashpot in series, beside a spring that deflects by h.
!>
!> The dashpot's own way q relaxes towards h, and the arm carries what is left of it:
!>
!> $$ \tau \dot q + q = h, \quad p = k_m (h - q), \quad \tau = c_m/k_m $$
!>
!> At rest the arm is relaxed. Fast motions meet the spring \( k_m \), slow ones a viscous
!> damper \( k_m \tau \).
module gfb_maxwell_arm
  use gfb_kinds, only: wp
  implicit none (type, external)
  private
  public :: arm_stiffness, arm_stiffness_rate, arm_viscosity, arm_relaxed

  !> The arm beside each spring of an elastic foundation.
  type, public :: maxwell_arm_type
    real(wp) :: stiffness = 0.0_wp !! k_m; 0: there is none [N/m3]
    real(wp) :: time = 0.0_wp      !! tau [s]
  contains
    procedure :: is_present => arm_is_present
  end type maxwell_arm_type

contains

  !> Whether there is an arm.
  elemental logical function arm_is_present(self) result(present)
    class(maxwell_arm_type), intent(in) :: self !! the arm
    present = self%stiffness > 0.0_wp
  end function arm_is_present

  !> What the arm adds to the stiffness under motions \( e^{\lambda t} \):
  !> \( k_m \lambda\tau/(1 + \lambda\tau) \).
  elemental function arm_stiffness(arm, rate) result(stiffness)
    type(maxwell_arm_type), intent(in) :: arm !! the arm
    complex(wp), intent(in) :: rate !! lambda, not -1/tau [1/s]
    complex(wp) :: stiffness        !! [N/m3]
    stiffness = arm%stiffness*rate*arm%time/(1.0_wp + rate*arm%time)
  end function arm_stiffness

  !> Its derivative, \( k_m \tau/(1 + \lambda\tau)^2 \).
  elemental function arm_stiffness_rate(arm, rate) result(stiffness_rate)
    type(maxwell_arm_type), intent(in) :: arm !! the arm
    complex(wp), intent(in) :: rate !! lambda, not -1/tau [1/s]
    complex(wp) :: stiffness_rate   !! [N s/m3]
    stiffness_rate = arm%stiffness*arm%time/(1.0_wp + rate*arm%time)**2
  end function arm_stiffness_rate

  !> The viscous damper that a step of time sees in place of the arm.
  !>
  !> With \( \dot q = a_0 q + s \), s from earlier values of q, the step's q is eliminated:
  !>
  !> $$ p = k_m (h - q) = c (a_0 h + s), \quad c = \frac{k_m \tau}{1 + a_0 \tau} $$
  !>
  !> The derivative of p by h is \( c a_0 \), exactly.
  elemental function arm_viscosity(arm, factor) result(viscosity)
    type(maxwell_arm_type), intent(in) :: arm !! the arm
    real(wp), intent(in) :: factor !! a_0 [1/s]
    real(wp) :: viscosity          !! c [N s/m3]
    viscosity = arm%stiffness*arm%time/(1.0_wp + factor*arm%time)
  end function arm_viscosity

  !> The dashpot's way at the end of the step: \( q = (h - \tau s)/(1 + a_0 \tau) \).
  elemental function arm_relaxed(arm, factor, past, deflection) result(relaxed)
    type(maxwell_arm_type), intent(in) :: arm !! the arm
    real(wp), intent(in) :: factor     !! a_0 [1/s]
    real(wp), intent(in) :: past       !! s [m/s]
    real(wp), intent(in) :: deflection !! h there [m]
    real(wp) :: relaxed                !! q [m]
    relaxed = (deflection - arm%time*past)/(1.0_wp + factor*arm%time)
  end function arm_relaxed
end module gfb_maxwell_arm
