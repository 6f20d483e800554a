!> MITC4 shell element, linear: stiffness and internal force.
!>
!> Source: [DvorkinBathe1984]. Five strains in the lamina, plane stress; membrane and bending from
!> the displacements, transverse shear tied at the sides. Rule: 2 x 2 Gauss
!> points in the plane, 2 over the thickness.
!>
!> Transverse shear of MITC4: covariant strains tied at the middles of the four sides.
!>
!> $$ 2 \tilde e_{\xi\zeta} = \frac{1 + \eta}{2} \gamma^A + \frac{1 - \eta}{2} \gamma^C, \qquad
!>    2 \tilde e_{\eta\zeta} = \frac{1 + \xi}{2} \gamma^D + \frac{1 - \xi}{2} \gamma^B $$
!> $$ \gamma = \frac{\mathbf{x}_j - \mathbf{x}_i}{2} \cdot \frac{\boldsymbol\varphi_i +
!>    \boldsymbol\varphi_j}{2} + \frac{h}{4} (\mathbf{V}_i + \mathbf{V}_j) \cdot
!>    \frac{\mathbf{u}_j - \mathbf{u}_i}{2}, \qquad
!>    \boldsymbol\varphi = \frac{h}{2} \boldsymbol\theta \times \mathbf{V} $$
!>
!> Source: [DvorkinBathe1984]; A is the middle of the side at \( \eta = 1 \), C at \( \eta = -1 \),
!> D at \( \xi = 1 \), B at \( \xi = -1 \), from node i to node j. The part of the
!> displacement-based strain that is linear in \( \zeta \) vanishes there, so the tied strains are
!> constant over the thickness.
module gfb_shell_element
  use gfb_kinds, only: wp
  use gfb_shell_geometry, only: shell_section_type, shell_lamina_type, shell_geometry_type, &
                                shell_nodes, shell_unknowns, node_unknowns, shell_abscissa, &
                                check_shell, bilinear, shell_base, shell_lamina, node_xi, node_eta
  use gfb_shell_turn, only: shell_turn_type, shell_turn, shell_motion, shell_generalized, &
                            take_directions
  use gfb_errors, only: error_type
  implicit none (type, external)
  private
  public :: pressure_weights, pressure_moments, shell_stiffness, shell_internal_force, &
            shell_stress, shell_corner_stress, von_mises, von_mises_rates

  real(wp), parameter :: shear_factor = 5.0_wp/6.0_wp !! of the transverse shear [1]

  integer, parameter :: shear_points = 4 !! A, C, D, B

  integer, parameter :: from(shear_points) = [4, 1, 2, 1] !! node i
  integer, parameter :: to(shear_points) = [3, 2, 3, 4]   !! node j

  integer, parameter :: strains = 5                !! in the lamina
  integer, parameter :: columns = 8*strains        !! strains of all Gauss points
  real(wp), parameter :: round_off = 1.0e-14_wp    !! of an entry, against the diagonal

  integer, parameter, public :: lower_face = -1, upper_face = 1 !! the directors point to the upper

  !> Stresses at one point of the mid-surface.
  !>
  !> Components 11, 22, 12 in the lamina frame: 1 along the element's xi, 3 along the director, 2
  !> across.
  type, public :: shell_stress_type
    real(wp) :: frame(3, 3)                              !! the lamina's unit vectors in columns [1]
    real(wp) :: membrane(3)                              !! mean of both faces [Pa]
    real(wp) :: bending(3)                               !! half of upper less lower face [Pa]
    real(wp) :: shear(2)                                 !! mean transverse 13, 23 [Pa]
    real(wp) :: von_mises(lower_face:upper_face)         !! lower face, mid-surface, upper face [Pa]
    real(wp) :: force(3)                                 !! membrane forces N [N/m]
    real(wp) :: moment(3)                                !! bending moments M [N]
    real(wp) :: shear_force(2)                           !! transverse forces Q [N/m]
  end type shell_stress_type

  integer, parameter :: corners = 4 !! of a bilinear film element
  ! Integrals over a line: two linear functions; those of both halves times quadratic ones.
  real(wp), parameter :: linear(2, 2) = reshape([2.0_wp, 1.0_wp, 1.0_wp, 2.0_wp], [2, 2])/6.0_wp
  real(wp), parameter :: quadratic(3, 3) = reshape( &
    [7.0_wp, 2.0_wp, -1.0_wp, 6.0_wp, 20.0_wp, 6.0_wp, -1.0_wp, 2.0_wp, 7.0_wp], [3, 3])/48.0_wp
  !> Places along and across the motion of a film element's nodes.
  integer, parameter :: along(corners) = [1, 2, 2, 1], across(corners) = [1, 1, 2, 2]
  integer, parameter :: station_of(9) = [1, 1, 1, 2, 2, 2, 3, 3, 3]
  integer, parameter :: row_of(9) = [1, 2, 3, 1, 2, 3, 1, 2, 3]

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

  !> Derivatives of the four tied strains with respect to the element's unknowns.
  pure function shear_rows(geometry, thickness, turn) result(rows)
    type(shell_geometry_type), intent(in) :: geometry !! the element at its Gauss points
    real(wp), intent(in) :: thickness                !! h [m]
    type(shell_turn_type), intent(in) :: turn !! rotations of the directors
    real(wp) :: rows(shell_unknowns, shear_points), side(3), half_thickness(3)
    integer :: point, i, j, row_i, row_j, k

    rows = 0.0_wp
    do point = 1, shear_points
      i = from(point)
      j = to(point)
      row_i = node_unknowns*(i - 1)
      row_j = node_unknowns*(j - 1)
      call mid_side(geometry, thickness, point, side, half_thickness)
      rows(row_i + 1:row_i + 3, point) = -0.5_wp*half_thickness
      rows(row_j + 1:row_j + 3, point) = 0.5_wp*half_thickness
      do k = 1, 2
        rows(row_i + 3 + k, point) = 0.5_wp*dot_product(side, turn%rate(:, k, i))
        rows(row_j + 3 + k, point) = 0.5_wp*dot_product(side, turn%rate(:, k, j))
      end do
      if (turn%kink(i)) rows(:, point) = rows(:, point) &
        + 0.5_wp*dot_product(side, turn%drill_rate(:, i))*turn%drill(:, i)
      if (turn%kink(j)) rows(:, point) = rows(:, point) &
        + 0.5_wp*dot_product(side, turn%drill_rate(:, j))*turn%drill(:, j)
    end do
  end function shear_rows

  !> The four tied strains.
  pure function shear_strains(geometry, thickness, translation, change) result(strain)
    type(shell_geometry_type), intent(in) :: geometry !! the element at its Gauss points
    real(wp), intent(in) :: thickness                   !! h [m]
    real(wp), intent(in) :: translation(3, shell_nodes) !! of the nodes [m]
    real(wp), intent(in) :: change(3, shell_nodes)      !! of half the thickness vectors [m]
    real(wp) :: strain(shear_points)                    !! covariant, doubled [m2]
    real(wp) :: side(3), half_thickness(3)
    integer :: point

    do point = 1, shear_points
      associate (i => from(point), j => to(point))
        call mid_side(geometry, thickness, point, side, half_thickness)
        strain(point) = 0.5_wp*dot_product(side, change(:, i) + change(:, j)) &
          + 0.5_wp*dot_product(half_thickness, translation(:, j) - translation(:, i))
      end associate
    end do
  end function shear_strains

  !> Adds the nodal forces of four numbers that do work on the tied strains.
  pure subroutine shear_forces(geometry, thickness, work, force, couple)
    type(shell_geometry_type), intent(in) :: geometry !! the element at its Gauss points
    real(wp), intent(in) :: thickness                  !! h [m]
    real(wp), intent(in) :: work(shear_points)         !! conjugate to the tied strains [N/m]
    real(wp), intent(inout) :: force(3, shell_nodes)   !! on the translations [N]
    real(wp), intent(inout) :: couple(3, shell_nodes)  !! on the changes of half the thickness [N]
    real(wp) :: side(3), half_thickness(3)
    integer :: point

    do point = 1, shear_points
      associate (i => from(point), j => to(point), half => 0.5_wp*work(point))
        call mid_side(geometry, thickness, point, side, half_thickness)
        force(:, i) = force(:, i) - half*half_thickness
        force(:, j) = force(:, j) + half*half_thickness
        couple(:, i) = couple(:, i) + half*side
        couple(:, j) = couple(:, j) + half*side
      end associate
    end do
  end subroutine shear_forces

  !> Weights of the four tied strains in the two shear strains (along xi, along eta) at a point.
  pure function shear_weights(xi, eta) result(weight)
    real(wp), intent(in) :: xi, eta    !! in [-1, 1]
    real(wp) :: weight(shear_points)   !! of A, C in the first, of D, B in the second [1]
    weight = 0.5_wp*[1.0_wp + eta, 1.0_wp - eta, 1.0_wp + xi, 1.0_wp - xi]
  end function shear_weights

  !> Half a side as a vector, and half the thickness vector at its middle.
  pure subroutine mid_side(geometry, thickness, point, side, half_thickness)
    type(shell_geometry_type), intent(in) :: geometry
    real(wp), intent(in) :: thickness           !! h [m]
    integer, intent(in) :: point                !! one of the four
    real(wp), intent(out) :: side(3), half_thickness(3)            !! [m]

    associate (i => from(point), j => to(point))
      side = 0.5_wp*(geometry%position(:, j) - geometry%position(:, i))
      half_thickness = 0.25_wp*thickness*(geometry%director(:, i) + geometry%director(:, j))
    end associate
  end subroutine mid_side

  !> Weights of the nodal overpressures in the nodal forces, for an element of area one.
  !>
  !> $$ f_a = - \int_{\Omega^e} N_a (p - p_a) \, \mathbf{n} \, d\Omega
  !>        = - \mathbf{n} \, \Omega^e \sum_b W_{ab} (p_b - p_a), \qquad
  !>    W_{ab} = \frac{1}{\Omega^e} \int_{\Omega^e} N_a M_b \, d\Omega $$
  !>
  !> Source: [Gu2020] eq. 2. \( M_b \) are the shape functions of the film's element, \( N_a \)
  !> those of the shells, bilinear in each of the cells between its nodes. The top foil is loaded as
  !> it was before it deformed: flat, its elements rectangles. So there are no couples, and the
  !> integral is the product of two over lines of length one.
  pure function pressure_weights(nodes) result(weight)
    integer, intent(in) :: nodes          !! of the film's element: 4, round it, or 9, row by row
    real(wp) :: weight(nodes, nodes)      !! W, (force, overpressure) [1]

    if (nodes == corners) then
      weight = linear(along, along)*linear(across, across)
    else
      weight = quadratic(station_of, station_of)*quadratic(row_of, row_of)
    end if
  end function pressure_weights

  !> First moments of these weights across the motion, about the middle of the element and over its
  !> width: the area of a sector's element grows with its radius.
  pure function pressure_moments(nodes) result(weight)
    integer, intent(in) :: nodes          !! of the film's element: 4, round it, or 9, row by row
    real(wp) :: weight(nodes, nodes)      !! (force, overpressure) [1]

    real(wp), parameter :: linear_moment(2, 2) = &
      reshape([-1.0_wp, 0.0_wp, 0.0_wp, 1.0_wp], [2, 2])/12.0_wp
    real(wp), parameter :: quadratic_moment(3, 3) = reshape( &
      [-27.0_wp, -10.0_wp, -3.0_wp, -16.0_wp, 0.0_wp, 16.0_wp, 3.0_wp, 10.0_wp, 27.0_wp], &
      [3, 3])/480.0_wp

    if (nodes == corners) then
      weight = linear(along, along)*linear_moment(across, across)
    else
      weight = quadratic(station_of, station_of)*quadratic_moment(row_of, row_of)
    end if
  end function pressure_moments

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

    real(wp) :: factor(shell_unknowns, columns), tied(shell_unknowns, shear_points)
    type(shell_turn_type) :: turn
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
    call take_directions(turn, stiffness)
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

  !> Stresses at a point; the most accurate ones are at the centre (0, 0).
  !>
  !> $$ N = \int \sigma \, dz, \quad M = \int \sigma z \, dz, \quad Q = \int \tau \, dz $$
  !>
  !> with \( \sigma \) linear between the faces (exact up to thickness over radius):
  !> \( N = h \sigma_m, M = h^2 \sigma_b / 6 \). The transverse shear is the mean one, with the
  !> factor 5/6. It vanishes at the faces and is left out of their von Mises stress; at the
  !> mid-surface it is 3/2 of the mean, the top of the parabola, and counts.
  !>
  !> Fails as `check_shell` does.
  pure subroutine shell_stress(geometry, section, displacement, xi, eta, stress, error)
    type(shell_geometry_type), intent(in) :: geometry !! the element at its Gauss points
    type(shell_section_type), intent(in) :: section !! thickness and material of the shell
    real(wp), intent(in) :: displacement(shell_unknowns) !! u, v, w [m], alpha, beta [rad] a node
    real(wp), intent(in) :: xi, eta                      !! in [-1, 1]
    type(shell_stress_type), intent(out) :: stress !! at the Gauss points
    type(error_type), allocatable, intent(out) :: error !! what went wrong, if anything did

    real(wp), dimension(3, shell_nodes) :: translation, change
    real(wp) :: tied(shear_points), tensor(3, 3, -1:1)
    type(shell_lamina_type) :: lamina
    integer :: face

    call check_shell(geometry, section, error)
    if (allocated(error)) return
    call shell_motion(shell_turn(geometry, section%thickness), displacement, translation, change)
    tied = shear_strains(geometry, section%thickness, translation, change)
    do face = lower_face, upper_face
      call find_tensor(geometry, section, translation, change, tied, xi, eta, face, &
                       tensor(:, :, face), lamina)
      if (face == 0) stress%frame = lamina%frame
    end do
    call resultants(section%thickness, tensor, stress)
  end subroutine shell_stress

  !> Stress tensor in the lamina frame at a point of a face or of the mid-surface [Pa].
  pure subroutine find_tensor(geometry, section, translation, change, tied, xi, eta, face, &
                              tensor, lamina)
    type(shell_geometry_type), intent(in) :: geometry
    type(shell_section_type), intent(in) :: section
    real(wp), intent(in) :: translation(3, shell_nodes) !! of the nodes [m]
    real(wp), intent(in) :: change(3, shell_nodes)      !! of half the thickness vectors [m]
    real(wp), intent(in) :: tied(shear_points)          !! of `shear_strains` [m2]
    real(wp), intent(in) :: xi, eta                     !! in [-1, 1]
    integer, intent(in) :: face                         !! -1, 0 or 1
    real(wp), intent(out) :: tensor(3, 3)
    type(shell_lamina_type), intent(out) :: lamina      !! there
    real(wp) :: base(3, 3), motion(3, shell_nodes)
    real(wp), dimension(shell_nodes) :: shape, by_xi, by_eta

    call bilinear(xi, eta, shape, by_xi, by_eta)
    base = shell_base(geometry, section%thickness, shape, by_xi, by_eta, real(face, wp))
    lamina = shell_lamina(base)
    motion = translation + face*change
    tensor = lamina_stress(section, &
      lamina_strain(base, lamina, matmul(motion, by_xi), matmul(motion, by_eta), tied, &
                    shear_weights(xi, eta)))
  end subroutine find_tensor

  !> Stresses at the corners: membrane ones in the mean, bending ones as equilibrium has them.
  !>
  !> A bilinear element has no change of the curvature along a line in that line's direction. Where
  !> a moment is largest, over a crest or at a weld, the middle of an element misses it by half an
  !> element times its slope. What is missing follows from the shear forces Q of the element,
  !>
  !> $$ R_i = Q_i - M_{ij,j}, \qquad \Delta M_{11} = R_1 x_1 + \nu R_2 x_2, \qquad
  !>    \Delta M_{22} = R_2 x_2 + \nu R_1 x_1 $$
  !>
  !> with x from the middle on, so that stresses are of second order; exact on rectangles.
  pure function shell_corner_stress(geometry, section, displacement) result(value)
    type(shell_geometry_type), intent(in) :: geometry !! the element, as `check_shell` demands
    type(shell_section_type), intent(in) :: section !! thickness and material of the shell
    real(wp), intent(in) :: displacement(shell_unknowns) !! u, v, w [m], alpha, beta [rad] a node
    real(wp) :: value(6, shell_nodes) !! (membrane and bending 11, 22, 12, corners) [Pa]
    real(wp), dimension(3, shell_nodes) :: translation, change
    real(wp) :: plane(3, lower_face:upper_face), tied(shear_points), tensor(3, 3)
    type(shell_lamina_type) :: lamina
    real(wp) :: moment(3, shell_nodes), membrane(3), shear(2), length(2), by(3, 2), rest(2)
    integer :: i, face

    call shell_motion(shell_turn(geometry, section%thickness), displacement, translation, change)
    tied = shear_strains(geometry, section%thickness, translation, change)
    membrane = 0.0_wp
    do i = 1, shell_nodes
      do face = lower_face, upper_face, upper_face - lower_face
        call find_tensor(geometry, section, translation, change, tied, node_xi(i), node_eta(i), &
                         face, tensor, lamina)
        plane(:, face) = [tensor(1, 1), tensor(2, 2), tensor(1, 2)]
      end do
      moment(:, i) = section%thickness**2/12.0_wp*(plane(:, upper_face) - plane(:, lower_face))
      membrane = membrane + 0.5_wp*(plane(:, upper_face) + plane(:, lower_face))/shell_nodes
    end do
    call find_tensor(geometry, section, translation, change, tied, 0.0_wp, 0.0_wp, 0, tensor, &
                     lamina)
    shear = section%thickness*tensor(1:2, 3)
    associate (x => geometry%position, nodes => real(shell_nodes, wp))
      ! from side to side
      length = [norm2(matmul(x, node_xi)), norm2(matmul(x, node_eta))]*2.0_wp/nodes
      by(:, 1) = 2.0_wp*matmul(moment, node_xi)/(nodes*length(1))
      by(:, 2) = 2.0_wp*matmul(moment, node_eta)/(nodes*length(2))
    end associate
    rest = 0.5_wp*length*(shear - [by(1, 1) + by(3, 2), by(3, 1) + by(2, 2)])
    do i = 1, shell_nodes
      associate (change_of => [node_xi(i), node_eta(i)]*rest)
        moment(:2, i) = moment(:2, i) + change_of + section%poissons_ratio*change_of(2:1:-1)
      end associate
      value(:, i) = [membrane, 6.0_wp*moment(:, i)/section%thickness**2]
    end do
  end function shell_corner_stress

  !> Stresses and resultants from the stress tensors of lower face, mid-surface and upper face.
  pure subroutine resultants(thickness, tensor, stress)
    real(wp), intent(in) :: thickness           !! h [m]
    real(wp), intent(in) :: tensor(3, 3, -1:1)  !! in the lamina frames [Pa]
    type(shell_stress_type), intent(inout) :: stress
    real(wp) :: plane(3, -1:1)
    integer :: face

    do face = lower_face, upper_face
      plane(:, face) = [tensor(1, 1, face), tensor(2, 2, face), tensor(1, 2, face)]
      stress%von_mises(face) = von_mises(plane(:, face))
    end do
    stress%membrane = 0.5_wp*(plane(:, upper_face) + plane(:, lower_face))
    stress%bending = 0.5_wp*(plane(:, upper_face) - plane(:, lower_face))
    stress%shear = tensor(1:2, 3, 0)
    stress%von_mises(0) = sqrt(stress%von_mises(0)**2 &
                               + 3.0_wp*sum((1.5_wp*stress%shear)**2))
    stress%force = thickness*stress%membrane
    stress%moment = thickness**2/6.0_wp*stress%bending
    stress%shear_force = thickness*stress%shear
  end subroutine resultants

  !> Equivalent stress of a plane state.
  !>
  !> $$ \sigma_v = \sqrt{\sigma_{11}^2 - \sigma_{11} \sigma_{22} + \sigma_{22}^2 + 3 \sigma_{12}^2}
  !> $$
  pure function von_mises(plane) result(equivalent)
    real(wp), intent(in) :: plane(3) !! components 11, 22, 12 [Pa]
    real(wp) :: equivalent           !! [Pa]
    equivalent = sqrt(plane(1)**2 - plane(1)*plane(2) + plane(2)**2 + 3.0_wp*plane(3)**2)
  end function von_mises

  !> Derivatives of `von_mises` by the components; 0 where there is no stress.
  !>
  !> $$ \sigma_v d\sigma_v = (\sigma_{11} - \tfrac{1}{2} \sigma_{22}) d\sigma_{11}
  !>    + (\sigma_{22} - \tfrac{1}{2} \sigma_{11}) d\sigma_{22} + 3 \sigma_{12} d\sigma_{12} $$
  pure function von_mises_rates(plane) result(rate)
    real(wp), intent(in) :: plane(3) !! components 11, 22, 12 [Pa]
    real(wp) :: rate(3)              !! [1]
    real(wp) :: equivalent

    rate = 0.0_wp
    equivalent = von_mises(plane)
    if (equivalent > 0.0_wp) rate = [plane(1) - 0.5_wp*plane(2), plane(2) - 0.5_wp*plane(1), &
                                     3.0_wp*plane(3)]/equivalent
  end function von_mises_rates
end module gfb_shell_element
