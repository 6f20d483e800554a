!> How the nodes of an element move and its directors turn with its unknowns.
!>
!> $$ \boldsymbol\varphi_a = \frac{h}{2} \, \boldsymbol\theta_a \times \mathbf{V}_a, \qquad
!>    \boldsymbol\theta_a = \alpha_a \mathbf{V}^1_a + \beta_a \mathbf{V}^2_a
!>    + \gamma_a \mathbf{n}_a, \qquad \mathbf{n}_a = \mathbf{V}^1_a \times \mathbf{V}^2_a $$
!>
!> Where the director is the nodal normal, \( \gamma \) (drilling) drops out: [DvorkinBathe1984]'s
!> form. At a kink it does not, and without it a strip with kinks would resist being turned as a
!> rigid body about the mean normals of its kinks. It is no unknown but follows the spin of the
!> element itself,
!>
!> $$ \mathbf{m} \cdot \boldsymbol\theta_a = \omega = \frac{1}{2 A} \sum_b \bigl( \mathbf{x}_{,\eta}
!>    N_{b,\xi} - \mathbf{x}_{,\xi} N_{b,\eta} \bigr) \cdot \mathbf{u}_b, \qquad
!>    A \mathbf{m} = \mathbf{x}_{,\xi} \times \mathbf{x}_{,\eta} $$
!>
!> at the element's centre, so that rigid motions are exact whatever the directors.
module gfb_shell_turn
  use gfb_kinds, only: wp
  use gfb_shell_geometry, only: shell_geometry_type, shell_nodes, shell_unknowns, node_unknowns, &
                                bilinear, cross
  implicit none (type, external)
  private
  public :: shell_turn, shell_motion, shell_generalized, take_directions

  !> Sine of the angle between director and nodal normal up to which a node is smooth; round-off.
  real(wp), parameter :: smooth_sine = 1.0e-12_wp

  !> Derivatives of half the thickness vectors of one element.
  type, public :: shell_turn_type
    real(wp) :: rate(3, 2, shell_nodes)             !! by alpha and beta of the node [m]
    logical :: kink(shell_nodes)                    !! the director is not the nodal normal
    real(wp) :: drill_rate(3, shell_nodes)          !! by gamma of the node [m]; zero if smooth
    !> gamma at kinks by displacements along the axes of the positions and by rotations [1/m], [1]
    real(wp) :: drill(shell_unknowns, shell_nodes)
    logical :: is_turned = .false.                  !! displacements are along `direction`
    real(wp) :: direction(3, 3, shell_nodes)        !! of the nodes' displacements, in columns [1]
  end type shell_turn_type

contains

  !> How the directors of one element turn.
  pure function shell_turn(geometry, thickness) result(turn)
    type(shell_geometry_type), intent(in) :: geometry !! the element at its Gauss points
    real(wp), intent(in) :: thickness !! h [m]
    type(shell_turn_type) :: turn
    real(wp) :: normal(3), rate(3)
    integer :: a, k

    turn%drill_rate = 0.0_wp
    do a = 1, shell_nodes
      do k = 1, 2
        turn%rate(:, k, a) = 0.5_wp*thickness*cross(geometry%axis(:, k, a), geometry%director(:, a))
      end do
      normal = cross(geometry%axis(:, 1, a), geometry%axis(:, 2, a))
      rate = cross(normal, geometry%director(:, a))
      turn%kink(a) = dot_product(rate, rate) > smooth_sine**2
      if (turn%kink(a)) turn%drill_rate(:, a) = 0.5_wp*thickness*rate
    end do
    if (any(turn%kink)) turn%drill = drill_rows(geometry, turn%kink)
    turn%is_turned = geometry%is_turned()
    if (.not. turn%is_turned) return
    do a = 1, shell_nodes
      turn%direction(:, :, a) = geometry%directions(a)
    end do
  end function shell_turn

  !> A matrix between displacements along the axes of the positions becomes one between unknowns.
  pure subroutine take_directions(turn, matrix)
    type(shell_turn_type), intent(in) :: turn !! with the nodes' directions
    real(wp), intent(inout) :: matrix(shell_unknowns, shell_unknowns) !! stiffness, symmetric
    integer :: a

    if (.not. turn%is_turned) return
    do a = 1, shell_nodes
      associate (first => node_unknowns*(a - 1) + 1, last => node_unknowns*(a - 1) + 3, &
                 direction => turn%direction(:, :, a))
        matrix(:, first:last) = matmul(matrix(:, first:last), direction)
        matrix(first:last, :) = matmul(transpose(direction), matrix(first:last, :))
      end associate
    end do
    matrix = 0.5_wp*(matrix + transpose(matrix))
  end subroutine take_directions

  !> The drilling rotations at kinks as rows over the unknowns.
  pure function drill_rows(geometry, kink) result(drill)
    type(shell_geometry_type), intent(in) :: geometry
    logical, intent(in) :: kink(shell_nodes)
    real(wp) :: drill(shell_unknowns, shell_nodes)
    real(wp), dimension(shell_nodes) :: shape, by_xi, by_eta
    real(wp), dimension(3) :: along, across, normal
    real(wp) :: spin(shell_unknowns), area
    integer :: a, k

    call bilinear(0.0_wp, 0.0_wp, shape, by_xi, by_eta)
    along = matmul(geometry%position, by_xi)
    across = matmul(geometry%position, by_eta)
    normal = cross(along, across)
    area = sqrt(dot_product(normal, normal))
    normal = normal/area
    spin = 0.0_wp
    do a = 1, shell_nodes
      spin(node_unknowns*(a - 1) + 1:node_unknowns*(a - 1) + 3) = &
        0.5_wp/area*(across*by_xi(a) - along*by_eta(a))
    end do
    drill = 0.0_wp
    do a = 1, shell_nodes
      if (.not. kink(a)) cycle
      associate (axis => geometry%axis(:, :, a))
        drill(:, a) = spin
        do k = 1, 2
          drill(node_unknowns*(a - 1) + 3 + k, a) = -dot_product(normal, axis(:, k))
        end do
        drill(:, a) = drill(:, a)/dot_product(normal, cross(axis(:, 1), axis(:, 2)))
      end associate
    end do
  end function drill_rows

  !> Translations and changes of half the thickness vectors of the nodes.
  pure subroutine shell_motion(turn, displacement, translation, change)
    type(shell_turn_type), intent(in) :: turn !! rotations of the directors
    real(wp), intent(in) :: displacement(shell_unknowns) !! u, v, w [m], alpha, beta [rad] a node
    real(wp), intent(out) :: translation(3, shell_nodes), change(3, shell_nodes) !! [m]
    real(wp) :: moved(shell_unknowns) !! the same, along the axes of the positions
    integer :: a

    moved = displacement
    do a = 1, merge(shell_nodes, 0, turn%is_turned)
      associate (first => node_unknowns*(a - 1))
        moved(first + 1:first + 3) = &
          matmul(turn%direction(:, :, a), displacement(first + 1:first + 3))
      end associate
    end do
    do a = 1, shell_nodes
      associate (first => node_unknowns*(a - 1))
        translation(:, a) = moved(first + 1:first + 3)
        change(:, a) = matmul(turn%rate(:, :, a), moved(first + 4:first + 5))
      end associate
      if (turn%kink(a)) change(:, a) = change(:, a) &
        + dot_product(turn%drill(:, a), moved)*turn%drill_rate(:, a)
    end do
  end subroutine shell_motion

  !> Forces on the unknowns from forces on translations and half the thickness vectors: the
  !> transpose of `shell_motion`.
  pure function shell_generalized(turn, force, couple) result(generalized)
    type(shell_turn_type), intent(in) :: turn !! rotations of the directors
    real(wp), intent(in) :: force(3, shell_nodes)   !! [N]
    real(wp), intent(in) :: couple(3, shell_nodes)  !! on the changes of half the thickness [N]
    real(wp) :: generalized(shell_unknowns)         !! forces [N], couples [N m]
    integer :: a

    generalized = 0.0_wp
    do a = 1, shell_nodes
      associate (first => node_unknowns*(a - 1))
        generalized(first + 1:first + 3) = generalized(first + 1:first + 3) + force(:, a)
        generalized(first + 4:first + 5) = generalized(first + 4:first + 5) &
          + matmul(couple(:, a), turn%rate(:, :, a))
      end associate
      if (turn%kink(a)) generalized = generalized &
        + dot_product(turn%drill_rate(:, a), couple(:, a))*turn%drill(:, a)
    end do
    do a = 1, merge(shell_nodes, 0, turn%is_turned)
      associate (first => node_unknowns*(a - 1))
        generalized(first + 1:first + 3) = &
          matmul(generalized(first + 1:first + 3), turn%direction(:, :, a))
      end associate
    end do
  end function shell_generalized
end module gfb_shell_turn
