!> Strains and stresses at a point of the shell element.
module gfb_shell_strain
  use gfb_kinds, only: wp
  use gfb_shell_geometry, only: shell_section_type, shell_lamina_type
  use gfb_shell_shear, only: shear_points
  implicit none (type, external)
  private
  public :: lamina_strain, lamina_stress

  real(wp), parameter, public :: shear_factor = 5.0_wp/6.0_wp !! of the transverse shear [1]

contains

  !> Strain tensor in the lamina frame.
  !>
  !> $$ \varepsilon_{ij} = \sum_{kl} e_{kl} (\mathbf{g}^k \cdot \mathbf{l}_i)
  !>    (\mathbf{g}^l \cdot \mathbf{l}_j), \qquad
  !>    e_{kl} = \tfrac12 (\mathbf{g}_k \cdot \mathbf{u}_{,l} + \mathbf{g}_l \cdot \mathbf{u}_{,k})
  !> $$
  !>
  !> with the tied transverse shear strains in place of the displacement-based ones; the normal
  !> strain along the thickness is left out (plane stress).
  pure function lamina_strain(base, lamina, slope_xi, slope_eta, tied, weight) result(strain)
    real(wp), intent(in) :: base(3, 3)          !! covariant base vectors [m]
    type(shell_lamina_type), intent(in) :: lamina !! directions at a Gauss point
    real(wp), intent(in) :: slope_xi(3)         !! derivative of the displacement by xi [m]
    real(wp), intent(in) :: slope_eta(3)        !! derivative of the displacement by eta [m]
    real(wp), intent(in) :: tied(shear_points)  !! of `shear_strains` [m2]
    real(wp), intent(in) :: weight(shear_points) !! of `shear_weights` [1]
    real(wp) :: strain(3, 3)                    !! [1]
    real(wp) :: covariant(3, 3)

    covariant(1, 1) = dot_product(base(:, 1), slope_xi)
    covariant(2, 2) = dot_product(base(:, 2), slope_eta)
    covariant(3, 3) = 0.0_wp
    covariant(1, 2) = 0.5_wp*(dot_product(base(:, 1), slope_eta) + &
                              dot_product(base(:, 2), slope_xi))
    covariant(1, 3) = 0.5_wp*(weight(1)*tied(1) + weight(2)*tied(2))
    covariant(2, 3) = 0.5_wp*(weight(3)*tied(3) + weight(4)*tied(4))
    covariant(2, 1) = covariant(1, 2)
    covariant(3, 1) = covariant(1, 3)
    covariant(3, 2) = covariant(2, 3)
    strain = matmul(lamina%dual, matmul(covariant, transpose(lamina%dual)))
  end function lamina_strain

  !> Plane stress in the lamina, and transverse shear.
  !>
  !> $$ \sigma_{11} = \frac{E}{1 - \nu^2} (\varepsilon_{11} + \nu \varepsilon_{22}), \quad
  !>    \sigma_{12} = 2 G \varepsilon_{12}, \quad \sigma_{13} = 2 k G \varepsilon_{13}, \quad
  !>    \sigma_{33} = 0, \quad k = 5/6 $$
  pure function lamina_stress(section, strain) result(stress)
    type(shell_section_type), intent(in) :: section !! thickness and material of the shell
    real(wp), intent(in) :: strain(3, 3) !! in the lamina frame [1]
    real(wp) :: stress(3, 3)             !! in the lamina frame [Pa]
    real(wp) :: plane, shear

    plane = section%youngs_modulus/(1.0_wp - section%poissons_ratio**2)
    shear = section%youngs_modulus/(1.0_wp + section%poissons_ratio)
    stress = shear*shear_factor*strain
    stress(1, 1) = plane*(strain(1, 1) + section%poissons_ratio*strain(2, 2))
    stress(2, 2) = plane*(strain(2, 2) + section%poissons_ratio*strain(1, 1))
    stress(3, 3) = 0.0_wp
    stress(1, 2) = shear*strain(1, 2)
    stress(2, 1) = stress(1, 2)
  end function lamina_stress
end module gfb_shell_strain
