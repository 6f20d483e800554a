!> Eigenvalues of the 2 x 2 coefficients of translation, and how they change.
module gfb_planar_eigenvalues
  use gfb_kinds, only: wp
  implicit none (type, external)
  private
  public :: planar_eigenvalues, whirl_rates

contains

  !> Eigenvalues of a 2 x 2 matrix.
  pure function planar_eigenvalues(matrix) result(kappa)
    complex(wp), intent(in) :: matrix(2, 2) !! in any unit [SI]
    complex(wp) :: kappa(2), mean, root

    mean = 0.5_wp*(matrix(1, 1) + matrix(2, 2))
    root = sqrt((0.5_wp*(matrix(1, 1) - matrix(2, 2)))**2 + matrix(1, 2)*matrix(2, 1))
    kappa = [mean + root, mean - root]
  end function planar_eigenvalues

  !> How an eigenvalue of a 2 x 2 matrix changes with it: from
  !> \( \kappa^2 - \kappa \, tr Z + det Z = 0 \) follows
  !> \( \kappa' = (\kappa \, tr Z' - (det Z)')/(2 \kappa - tr Z) \).
  pure complex(wp) function eigenvalue_rate(matrix, change, kappa) result(rate)
    complex(wp), intent(in) :: matrix(2, 2) !! Z [SI]
    complex(wp), intent(in) :: change(2, 2) !! Z' [SI over something's unit]
    complex(wp), intent(in) :: kappa        !! a simple eigenvalue of Z [SI]
    complex(wp) :: determinant

    determinant = change(1, 1)*matrix(2, 2) + matrix(1, 1)*change(2, 2) &
      - change(1, 2)*matrix(2, 1) - matrix(1, 2)*change(2, 1)
    rate = (kappa*(change(1, 1) + change(2, 2)) - determinant)/ &
      (2.0_wp*kappa - matrix(1, 1) - matrix(2, 2))
  end function eigenvalue_rate

  !> How critical mass and whirl frequency change where the coefficients do.
  !>
  !> The eigenvalue that is real at the whirl stays so:
  !> \( Im(\kappa_a + \kappa_\omega \omega_a) = 0 \), and with \( m = \kappa/\omega^2 \)
  !>
  !> $$ m_a = \frac{Re(\kappa_a + \kappa_\omega \omega_a)}{\omega^2} -
  !>    \frac{2 m \omega_a}{\omega}. $$
  pure function whirl_rates(matrix, by_frequency, change, frequency) result(rates)
    complex(wp), intent(in) :: matrix(2, 2)       !! Z at the whirl [N/m]
    complex(wp), intent(in) :: by_frequency(2, 2) !! its derivative there [N s/m]
    complex(wp), intent(in) :: change(2, 2) !! Z_a at that frequency [N/m over a's unit]
    real(wp), intent(in) :: frequency       !! of the whirl [rad/s]
    real(wp) :: rates(2) !! of critical mass [kg over it] and whirl frequency [rad/s over it]
    complex(wp) :: kappa(2), own, slope

    kappa = planar_eigenvalues(matrix)
    if (abs(aimag(kappa(2))) < abs(aimag(kappa(1)))) kappa = kappa(2:1:-1)
    own = eigenvalue_rate(matrix, change, kappa(1))
    slope = eigenvalue_rate(matrix, by_frequency, kappa(1))
    rates(2) = -aimag(own)/aimag(slope)
    rates(1) = (real(own + slope*rates(2), wp) - 2.0_wp*real(kappa(1), wp)*rates(2)/frequency)/ &
      frequency**2
  end function whirl_rates
end module gfb_planar_eigenvalues
