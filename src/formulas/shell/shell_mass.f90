!> Consistent mass of the shell element, with rotary inertia.
module gfb_shell_mass
  use gfb_kinds, only: wp
  use gfb_errors, only: error_type
  use gfb_shell_geometry, only: shell_geometry_type, shell_section_type, shell_nodes, &
                                shell_unknowns, shell_abscissa, check_shell, bilinear, &
                                shell_base, cross
  use gfb_shell_turn, only: shell_turn_type, shell_turn, shell_motion, shell_generalized
  implicit none (type, external)
  private
  public :: shell_mass

  integer, parameter :: powers = 3 !! of zeta: 0, 1, 2

contains

  !> Mass of one element.
  !>
  !> $$ M = \int \rho \, N^T N \, dV, \qquad
  !>    \mathbf{u} = \sum_a N_a \Bigl( \mathbf{u}_a + \frac{h}{2} \zeta \,
  !>    \boldsymbol\theta_a \times \mathbf{V}_a \Bigr) $$
  !>
  !> Source: the displacements of [DvorkinBathe1984]. The thickness is integrated exactly (the
  !> volume is quadratic in \( \zeta \)), the plane by 2 x 2 Gauss points, exact for total mass and,
  !> on flat elements, for every entry. The terms linear in \( \zeta \) couple translations and
  !> rotations of curved elements.
  !>
  !> Fails as `check_shell` does.
  pure subroutine shell_mass(geometry, section, mass, error)
    type(shell_geometry_type), intent(in) :: geometry !! the element at its Gauss points
    type(shell_section_type), intent(in) :: section !! thickness and material of the shell
    real(wp), intent(out) :: mass(shell_unknowns, shell_unknowns) !! [kg], [kg m], [kg m2]
    type(error_type), allocatable, intent(out) :: error !! what went wrong, if anything did

    real(wp) :: moment(shell_nodes, shell_nodes, 0:powers - 1), unit(shell_unknowns)
    real(wp), dimension(3, shell_nodes) :: translation, change
    type(shell_turn_type) :: turn
    integer :: i, j

    mass = 0.0_wp
    call check_shell(geometry, section, error)
    if (allocated(error)) return
    turn = shell_turn(geometry, section%thickness)
    moment = section%density*thickness_moments(geometry, section%thickness)
    unit = 0.0_wp
    do j = 1, shell_unknowns
      unit(j) = 1.0_wp
      call shell_motion(turn, unit, translation, change)
      mass(:, j) = shell_generalized(turn, &
        matmul(translation, moment(:, :, 0)) + matmul(change, moment(:, :, 1)), &
        matmul(translation, moment(:, :, 1)) + matmul(change, moment(:, :, 2)))
      unit(j) = 0.0_wp
    end do
    do j = 2, shell_unknowns
      do i = 1, j - 1
        mass(i, j) = mass(j, i)
      end do
    end do
  end subroutine shell_mass

  !> The integrals \( \int N_a N_b \zeta^k dV \), k = 0, 1, 2.
  !>
  !> Between the nodes of a curved element the interpolated director is shorter than one; the
  !> volume is that of a shell which has its thickness there too.
  pure function thickness_moments(geometry, thickness) result(moment)
    type(shell_geometry_type), intent(in) :: geometry
    real(wp), intent(in) :: thickness                             !! h [m]
    real(wp) :: moment(shell_nodes, shell_nodes, 0:powers - 1)    !! [m3]

    real(wp), dimension(shell_nodes) :: shape, by_xi, by_eta
    real(wp) :: base(3, 3), volume(-1:1), term(0:2), length
    integer :: i, j, k, a, b

    moment = 0.0_wp
    do j = -1, 1, 2
      do i = -1, 1, 2
        call bilinear(i*shell_abscissa, j*shell_abscissa, shape, by_xi, by_eta)
        length = norm2(matmul(geometry%director, shape))
        do k = -1, 1
          base = shell_base(geometry, thickness, shape, by_xi, by_eta, real(k, wp))
          volume(k) = dot_product(cross(base(:, 1), base(:, 2)), base(:, 3))/length
        end do
        ! The volume as a polynomial of zeta, then its moments over [-1, 1].
        term = [volume(0), 0.5_wp*(volume(1) - volume(-1)), &
                0.5_wp*(volume(1) + volume(-1)) - volume(0)]
        term = [2.0_wp*term(0) + 2.0_wp/3.0_wp*term(2), 2.0_wp/3.0_wp*term(1), &
                2.0_wp/3.0_wp*term(0) + 2.0_wp/5.0_wp*term(2)]
        do k = 0, powers - 1
          do b = 1, shell_nodes
            do a = 1, shell_nodes
              moment(a, b, k) = moment(a, b, k) + term(k)*shape(a)*shape(b)
            end do
          end do
        end do
      end do
    end do
  end function thickness_moments
end module gfb_shell_mass
