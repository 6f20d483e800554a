!> A mode that is driven by its supports, over a step of time.
!>
!> With the relative amplitude \( \eta \), natural frequency \( \omega \) and the supports' way
!> \( d = m^T u \), its drive,
!>
!> $$ \ddot\eta + \omega^2 \eta = -\ddot d, $$
!>
!> both accelerations differenced twice with the weights of `gfb_backward_difference`, from where
!> amplitude and drive would be without any force: \( \ddot y \approx a_0^2 (y - \hat y) \).
module gfb_modal_step
  use gfb_kinds, only: wp
  implicit none (type, external)
  private
  public :: modal_amplitude, modal_acceleration, modal_inertia

contains

  !> The amplitude at the end of the step:
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
end module gfb_modal_step
