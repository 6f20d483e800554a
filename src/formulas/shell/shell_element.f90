!> MITC4 shell element, linear: stiffness and internal force.
!>
!> Source: [DvorkinBathe1984]. Five strains in the lamina, plane stress; membrane and bending from
!> the displacements, transverse shear tied at the sides (`gfb_shell_shear`). Rule: 2 x 2 Gauss
!> points in the plane, 2 over the thickness.
module gfb_shell_element
  use gfb_kinds, only: wp
  use gfb_errors, only: error_type
  use gfb_shell_geometry, only: shell_geometry_type, shell_section_type, shell_lamina_type, &
                                shell_nodes, shell_unknowns, node_unknowns, shell_abscissa, &
                                check_shell, bilinear, shell_base, shell_lamina
  use gfb_shell_shear, only: shear_points, shear_rows, shear_strains, shear_forces, shear_weights
  use gfb_shell_strain, only: shear_factor, lamina_strain, lamina_stress
  use gfb_shell_turn, only: shell_turn_type, shell_turn, shell_motion, shell_generalized
  implicit none (type, external)
  private
  public :: shell_stiffness, shell_internal_force

  integer, parameter :: strains = 5                !! in the lamina
  integer, parameter :: columns = 8*strains        !! strains of all Gauss points
  real(wp), parameter :: round_off = 1.0e-14_wp    !! of an entry, against the diagonal

contains

  !> Stiffness of one element.
  !>
  !> $$ K = \int B^T D B \, dV = \sum_p S_p^T S_p, \qquad S_p = \sqrt{w_p D} \, B_p $$
  !>
  !> D is diagonal in \( \varepsilon_{11} \pm \varepsilon_{22} \) and the three shears, so its root
  !> is at hand and the sum is one product of a matrix with its transpose, exactly symmetric.
  !>
  !> Fails as `check_shell` does.
  pure subroutine shell_stiffness(geometry, section, stiffness, error)
    type(shell_geometry_type), intent(in) :: geometry !! the element at its Gauss points
    type(shell_section_type), intent(in) :: section !! thickness and material of the shell
    real(wp), intent(out) :: stiffness(shell_unknowns, shell_unknowns) !! [N/m], [N], [N m]
    type(error_type), allocatable, intent(out) :: error !! what went wrong, if anything did

    real(wp) :: factor(shell_unknowns, columns)
    type(shell_turn_type) :: turn
    real(wp) :: tied(shell_unknowns, shear_points)
    real(wp), dimension(shell_nodes) :: shape, by_xi, by_eta
    real(wp), dimension(shell_unknowns) :: shear_xi, shear_eta
    real(wp) :: xi, eta, zeta, weight(shear_points), root(strains)
    integer :: i, j, k, first

    stiffness = 0.0_wp
    call check_shell(geometry, section, error)
    if (allocated(error)) return
    turn = shell_turn(geometry, section%thickness)
    tied = shear_rows(geometry, section%thickness, turn)
    root = material_root(section)
    first = 0
    do j = -1, 1, 2
      do i = -1, 1, 2
        xi = i*shell_abscissa
        eta = j*shell_abscissa
        call bilinear(xi, eta, shape, by_xi, by_eta)
        weight = shear_weights(xi, eta)
        shear_xi = weight(1)*tied(:, 1) + weight(2)*tied(:, 2)
        shear_eta = weight(3)*tied(:, 3) + weight(4)*tied(:, 4)
        do k = -1, 1, 2
          zeta = k*shell_abscissa
          call strain_rows(shell_base(geometry, section%thickness, shape, by_xi, by_eta, zeta), &
                           turn, by_xi, by_eta, zeta, root, shear_xi, shear_eta, &
                           factor(:, first + 1:first + strains))
          first = first + strains
        end do
      end do
    end do
    call square(factor, stiffness)
    call drop_round_off(stiffness)
  end subroutine shell_stiffness

  !> Makes zero what is round-off: in a flat element half of the entries, between membrane and
  !> bending. Matrices without them have factors that cost less.
  pure subroutine drop_round_off(stiffness)
    real(wp), intent(inout) :: stiffness(shell_unknowns, shell_unknowns)
    real(wp) :: least(shell_unknowns)
    integer :: i

    least = [(round_off*sqrt(stiffness(i, i)), i=1, shell_unknowns)]
    do i = 1, shell_unknowns
      where (abs(stiffness(:, i)) <= least*sqrt(stiffness(i, i))) stiffness(:, i) = 0.0_wp
    end do
  end subroutine drop_round_off

  !> Roots of the elastic moduli of the five strains \( \varepsilon_{11} + \varepsilon_{22},
  !> \varepsilon_{11} - \varepsilon_{22}, \gamma_{12}, \gamma_{13}, \gamma_{23} \).
  pure function material_root(section) result(root)
    type(shell_section_type), intent(in) :: section
    real(wp) :: root(strains) !! [Pa^(1/2)]
    real(wp) :: shear

    shear = 0.5_wp*section%youngs_modulus/(1.0_wp + section%poissons_ratio)
    root(1) = sqrt(0.5_wp*section%youngs_modulus/(1.0_wp - section%poissons_ratio))
    root(2:3) = sqrt(shear)
    root(4:5) = sqrt(shear_factor*shear)
  end function material_root

  !> The five strains at a Gauss point as rows over the unknowns, times the root of modulus and
  !> volume.
  pure subroutine strain_rows(base, turn, by_xi, by_eta, zeta, root, shear_xi, shear_eta, rows)
    real(wp), intent(in) :: base(3, 3)                                !! [m]
    type(shell_turn_type), intent(in) :: turn
    real(wp), intent(in), dimension(shell_nodes) :: by_xi, by_eta     !! [1]
    real(wp), intent(in) :: zeta                                      !! [1]
    real(wp), intent(in) :: root(strains)                             !! of the moduli
    real(wp), intent(in), dimension(shell_unknowns) :: shear_xi, shear_eta !! tied strains
    real(wp), intent(out) :: rows(shell_unknowns, strains)

    real(wp), dimension(shell_unknowns) :: e_11, e_22, e_12, in_11, in_22
    type(shell_lamina_type) :: lamina
    real(wp) :: scale(strains), on_xi, on_eta
    integer :: a

    do a = 1, shell_nodes
      associate (first => node_unknowns*(a - 1))
        call node_columns(base, turn%rate(:, :, a), by_xi(a), by_eta(a), zeta, &
                          e_11(first + 1:first + node_unknowns), &
                          e_22(first + 1:first + node_unknowns), &
                          e_12(first + 1:first + node_unknowns))
      end associate
    end do
    do a = 1, shell_nodes
      if (.not. turn%kink(a)) cycle
      on_xi = zeta*dot_product(base(:, 1), turn%drill_rate(:, a))
      on_eta = zeta*dot_product(base(:, 2), turn%drill_rate(:, a))
      e_11 = e_11 + by_xi(a)*on_xi*turn%drill(:, a)
      e_22 = e_22 + by_eta(a)*on_eta*turn%drill(:, a)
      e_12 = e_12 + (by_eta(a)*on_xi + by_xi(a)*on_eta)*turn%drill(:, a)
    end do
    lamina = shell_lamina(base)
    scale = root*sqrt(lamina%volume)
    ! dual(1, 2), dual(3, 1) and dual(3, 2) are zero; e_12 and both shears are doubled strains.
    associate (d => lamina%dual)
      in_11 = d(1, 1)**2*e_11 + d(1, 1)*d(1, 3)*shear_xi
      in_22 = d(2, 1)**2*e_11 + d(2, 2)**2*e_22 + d(2, 1)*d(2, 2)*e_12 &
        + d(2, 1)*d(2, 3)*shear_xi + d(2, 2)*d(2, 3)*shear_eta
      rows(:, 1) = scale(1)*(in_11 + in_22)
      rows(:, 2) = scale(2)*(in_11 - in_22)
      rows(:, 3) = scale(3)*(2.0_wp*d(1, 1)*d(2, 1)*e_11 + d(1, 1)*d(2, 2)*e_12 &
                             + (d(1, 1)*d(2, 3) + d(1, 3)*d(2, 1))*shear_xi &
                             + d(1, 3)*d(2, 2)*shear_eta)
      rows(:, 4) = scale(4)*d(1, 1)*d(3, 3)*shear_xi
      rows(:, 5) = scale(5)*d(3, 3)*(d(2, 1)*shear_xi + d(2, 2)*shear_eta)
    end associate
  end subroutine strain_rows

  !> Covariant strains in the lamina (the last one doubled) for unit unknowns of one node.
  pure subroutine node_columns(base, rate, by_xi, by_eta, zeta, e_11, e_22, e_12)
    real(wp), intent(in) :: base(3, 3)                !! [m]
    real(wp), intent(in) :: rate(3, 2)                !! of the node [m]
    real(wp), intent(in) :: by_xi, by_eta             !! of the node's shape function [1]
    real(wp), intent(in) :: zeta                      !! [1]
    real(wp), intent(out), dimension(node_unknowns) :: e_11, e_22, e_12
    real(wp), dimension(node_unknowns) :: on_xi, on_eta
    integer :: k

    on_xi(1:3) = base(:, 1)
    on_eta(1:3) = base(:, 2)
    do k = 1, 2
      on_xi(3 + k) = zeta*dot_product(base(:, 1), rate(:, k))
      on_eta(3 + k) = zeta*dot_product(base(:, 2), rate(:, k))
    end do
    e_11 = by_xi*on_xi
    e_22 = by_eta*on_eta
    e_12 = by_eta*on_xi + by_xi*on_eta
  end subroutine node_columns

  !> A matrix times its transpose, whole.
  pure subroutine square(factor, product)
    real(wp), intent(in) :: factor(shell_unknowns, columns)
    real(wp), intent(out) :: product(shell_unknowns, shell_unknowns)
    real(wp) :: column(shell_unknowns)
    integer :: i, j, k

    do j = 1, shell_unknowns
      column = 0.0_wp
      do k = 1, columns, 4
        do i = 1, shell_unknowns
          column(i) = column(i) + factor(i, k)*factor(j, k) + factor(i, k + 1)*factor(j, k + 1) &
            + factor(i, k + 2)*factor(j, k + 2) + factor(i, k + 3)*factor(j, k + 3)
        end do
      end do
      product(:, j) = column
    end do
  end subroutine square

  !> Internal force of one element.
  !>
  !> $$ f_a = \int \sigma_{ij} \frac{\partial \varepsilon_{ij}}{\partial q_a} dV $$
  !>
  !> From strains and stresses as tensors; its derivative is `shell_stiffness`.
  !>
  !> Fails as `check_shell` does.
  pure subroutine shell_internal_force(geometry, section, displacement, internal_force, error)
    type(shell_geometry_type), intent(in) :: geometry !! the element at its Gauss points
    type(shell_section_type), intent(in) :: section !! thickness and material of the shell
    real(wp), intent(in) :: displacement(shell_unknowns)    !! u, v, w [m], alpha, beta [rad] a node
    real(wp), intent(out) :: internal_force(shell_unknowns) !! forces [N], couples [N m]
    type(error_type), allocatable, intent(out) :: error !! what went wrong, if anything did

    real(wp), dimension(3, shell_nodes) :: translation, change, force, couple
    real(wp), dimension(shear_points) :: tied, work
    type(shell_turn_type) :: turn
    integer :: i, j, k

    internal_force = 0.0_wp
    call check_shell(geometry, section, error)
    if (allocated(error)) return
    turn = shell_turn(geometry, section%thickness)
    call shell_motion(turn, displacement, translation, change)
    tied = shear_strains(geometry, section%thickness, translation, change)
    force = 0.0_wp
    couple = 0.0_wp
    work = 0.0_wp
    do k = -1, 1, 2
      do j = -1, 1, 2
        do i = -1, 1, 2
          call add_point_forces(geometry, section, shell_abscissa*[i, j, k], translation, change, &
                                tied, force, couple, work)
        end do
      end do
    end do
    call shear_forces(geometry, section%thickness, work, force, couple)
    internal_force = shell_generalized(turn, force, couple)
  end subroutine shell_internal_force

  !> Adds a Gauss point's forces on translations and thickness vectors, and the work on tied
  !> strains.
  pure subroutine add_point_forces(geometry, section, point, translation, change, tied, force, &
                                   couple, work)
    type(shell_geometry_type), intent(in) :: geometry
    type(shell_section_type), intent(in) :: section
    real(wp), intent(in) :: point(3)                                    !! xi, eta, zeta
    real(wp), intent(in), dimension(3, shell_nodes) :: translation, change !! [m]
    real(wp), intent(in) :: tied(shear_points)                          !! tied strains [m2]
    real(wp), intent(inout), dimension(3, shell_nodes) :: force, couple !! [N]
    real(wp), intent(inout) :: work(shear_points)                       !! on the tied strains [N/m]

    real(wp), dimension(shell_nodes) :: shape, by_xi, by_eta
    real(wp) :: base(3, 3), stress(3, 3), weight(shear_points), share(3), motion(3, shell_nodes)
    type(shell_lamina_type) :: lamina
    integer :: a

    call bilinear(point(1), point(2), shape, by_xi, by_eta)
    weight = shear_weights(point(1), point(2))
    base = shell_base(geometry, section%thickness, shape, by_xi, by_eta, point(3))
    lamina = shell_lamina(base)
    motion = translation + point(3)*change
    stress = lamina_stress(section, lamina_strain(base, lamina, matmul(motion, by_xi), &
                                                  matmul(motion, by_eta), tied, weight))
    ! Contravariant, times the volume.
    stress = lamina%volume*matmul(transpose(lamina%dual), matmul(stress, lamina%dual))
    do a = 1, shell_nodes
      share = (stress(1, 1)*by_xi(a) + stress(1, 2)*by_eta(a))*base(:, 1) &
        + (stress(2, 2)*by_eta(a) + stress(1, 2)*by_xi(a))*base(:, 2)
      force(:, a) = force(:, a) + share
      couple(:, a) = couple(:, a) + point(3)*share
    end do
    work(1:2) = work(1:2) + stress(1, 3)*weight(1:2)
    work(3:4) = work(3:4) + stress(2, 3)*weight(3:4)
  end subroutine add_point_forces
end module gfb_shell_element
