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
module gfb_shell_shear
  use gfb_kinds, only: wp
  use gfb_shell_geometry, only: shell_geometry_type, shell_nodes, shell_unknowns, node_unknowns
  use gfb_shell_turn, only: shell_turn_type
  implicit none (type, external)
  private
  public :: shear_rows, shear_strains, shear_forces, shear_weights

  integer, parameter, public :: shear_points = 4 !! A, C, D, B

  integer, parameter :: from(shear_points) = [4, 1, 2, 1] !! node i
  integer, parameter :: to(shear_points) = [3, 2, 3, 4]   !! node j

contains

  !> Derivatives of the four tied strains with respect to the element's unknowns.
  pure function shear_rows(geometry, thickness, turn) result(rows)
    type(shell_geometry_type), intent(in) :: geometry !! the element at its Gauss points
    real(wp), intent(in) :: thickness                !! h [m]
    type(shell_turn_type), intent(in) :: turn !! rotations of the directors
    real(wp) :: rows(shell_unknowns, shear_points)
    real(wp) :: side(3), half_thickness(3)
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
    real(wp), intent(out) :: side(3)            !! [m]
    real(wp), intent(out) :: half_thickness(3)  !! [m]

    associate (i => from(point), j => to(point))
      side = 0.5_wp*(geometry%position(:, j) - geometry%position(:, i))
      half_thickness = 0.25_wp*thickness*(geometry%director(:, i) + geometry%director(:, j))
    end associate
  end subroutine mid_side
end module gfb_shell_shear
