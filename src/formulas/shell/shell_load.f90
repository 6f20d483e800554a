!> Pressure on the mid-surface of the shell element.
module gfb_shell_load
  use gfb_kinds, only: wp
  use gfb_shell_geometry, only: shell_geometry_type, shell_nodes, shell_unknowns, node_unknowns, &
    shell_abscissa, bilinear, cross
  implicit none (type, external)
  private
  public :: shell_pressure_load, shell_pressure_derivative

contains

  !> Nodal forces of a pressure on the upper face (the one the directors point to).
  !>
  !> $$ f = - \int_{\Omega^e} N^T (p - p_a) \, \mathbf{n} \, d\Omega, \qquad
  !>    \mathbf{n} \, d\Omega = \mathbf{x}_{,\xi} \times \mathbf{x}_{,\eta} \, d\xi \, d\eta $$
  !>
  !> Source: [Gu2020] eq. 2; the nodal pressures are interpolated bilinearly and the mid-surface as
  !> it was before deformation is loaded, so there are no couples. 2 x 2 Gauss, exact on any
  !> element.
  pure subroutine shell_pressure_load(geometry, overpressure, force)
    type(shell_geometry_type), intent(in) :: geometry !! the element at its Gauss points
    real(wp), intent(in) :: overpressure(shell_nodes) !! p - p_a at the nodes [Pa]
    real(wp), intent(out) :: force(shell_unknowns)    !! forces [N], couples (zero) [N m]

    real(wp), dimension(shell_nodes) :: shape, by_xi, by_eta
    real(wp) :: push(3)
    integer :: i, j, a

    force = 0.0_wp
    do j = -1, 1, 2
      do i = -1, 1, 2
        call bilinear(i*shell_abscissa, j*shell_abscissa, shape, by_xi, by_eta)
        push = -dot_product(shape, overpressure)* &
          cross(matmul(geometry%position, by_xi), matmul(geometry%position, by_eta))
        do a = 1, shell_nodes
          associate (first => node_unknowns*(a - 1))
            force(first + 1:first + 3) = force(first + 1:first + 3) + shape(a)*push
          end associate
        end do
      end do
    end do
  end subroutine shell_pressure_load

  !> Exact derivative of `shell_pressure_load` with respect to the nodal pressures.
  pure subroutine shell_pressure_derivative(geometry, by_pressure)
    type(shell_geometry_type), intent(in) :: geometry !! the element at its Gauss points
    real(wp), intent(out) :: by_pressure(shell_unknowns, shell_nodes) !! [m2]

    real(wp), dimension(shell_nodes) :: shape, by_xi, by_eta
    real(wp) :: area(3)
    integer :: i, j, a, b

    by_pressure = 0.0_wp
    do j = -1, 1, 2
      do i = -1, 1, 2
        call bilinear(i*shell_abscissa, j*shell_abscissa, shape, by_xi, by_eta)
        area = cross(matmul(geometry%position, by_xi), matmul(geometry%position, by_eta))
        do b = 1, shell_nodes
          do a = 1, shell_nodes
            associate (first => node_unknowns*(a - 1))
              by_pressure(first + 1:first + 3, b) = by_pressure(first + 1:first + 3, b) &
                - shape(a)*shape(b)*area
            end associate
          end do
        end do
      end do
    end do
  end subroutine shell_pressure_derivative
end module gfb_shell_load
