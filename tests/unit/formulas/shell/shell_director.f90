!> Directors and rotation axes of the nodes of a shell mesh.
!>
!> Smooth nodes have one director that all elements around share, and rotation axes at right angles
!> to it. At a kink each element keeps the mean normal of its own side, and the shared axes, at
!> right angles to the mean of all sides, turn all of these directors together.
module shell_director
  use gfb_kinds, only: wp
  use gfb_errors, only: error_type, fail
  use gfb_text, only: text
  use gfb_shell_geometry, only: shell_nodes, node_xi, node_eta, bilinear, cross
  implicit none (type, external)
  private
  public :: rotation_axes, corner_normals, shell_directors

  !> Global axes whose components along a normal differ by less count as equal, so that round-off
  !> does not choose between them.
  real(wp), parameter :: tie = 1.0e-6_wp
  !> Sum of normals, over their number, below which they point all ways.
  real(wp), parameter :: least_sum = 1.0e-3_wp

contains

  !> The two rotation axes of a node, unit vectors that form a right-handed system with its normal.
  !>
  !> \( \mathbf{V}^1 \) is the projection of the global axis that lies nearest to the tangent plane,
  !> of equal ones the last of x, y, z; \( \mathbf{V}^2 = \mathbf{n} \times \mathbf{V}^1 \). On a
  !> foil whose normals have no z component \( \mathbf{V}^1 \) is z everywhere. The projected axis
  !> is at least 54 degrees from the normal.
  pure function rotation_axes(normal) result(axis)
    real(wp), intent(in) :: normal(3) !! unit vector [1]
    real(wp) :: axis(3, 2)            !! V1, V2 [1]
    integer :: nearest, i

    nearest = 3
    do i = 2, 1, -1
      if (abs(normal(i)) < abs(normal(nearest)) - tie) nearest = i
    end do
    axis(:, 1) = -normal(nearest)*normal
    axis(nearest, 1) = axis(nearest, 1) + 1.0_wp
    axis(:, 1) = axis(:, 1)/norm2(axis(:, 1))
    axis(:, 2) = cross(normal, axis(:, 1))
  end function rotation_axes

  !> Normals of one bilinear element at its nodes, for meshes without exact ones.
  !>
  !> $$ \mathbf{n} = \mathbf{x}_{,\xi} \times \mathbf{x}_{,\eta} / |\cdot| $$
  !>
  !> Fails where an edge or the angle of a corner vanishes.
  pure subroutine corner_normals(position, normal, error)
    real(wp), intent(in) :: position(3, shell_nodes) !! of the nodes [m]
    real(wp), intent(out) :: normal(3, shell_nodes)  !! unit vectors [1]
    type(error_type), allocatable, intent(out) :: error !! what went wrong, if anything did

    real(wp), dimension(shell_nodes) :: shape, by_xi, by_eta
    real(wp) :: along(3), across(3), length
    integer :: a

    do a = 1, shell_nodes
      call bilinear(node_xi(a), node_eta(a), shape, by_xi, by_eta)
      along = matmul(position, by_xi)
      across = matmul(position, by_eta)
      normal(:, a) = cross(along, across)
      length = norm2(normal(:, a))
      if (.not. length > tie*norm2(along)*norm2(across)) then
        call fail(error, 'a shell element has no normal: an edge or the angle of a corner vanishes')
        return
      end if
      normal(:, a) = normal(:, a)/length
    end do
  end subroutine corner_normals

  !> Directors of all elements and rotation axes of all nodes.
  !>
  !> An element's director at a node is the mean of those normals at the node that are within
  !> `kink_angle` of its own; the axes follow from the mean of all. A node is a kink where any two
  !> of its normals are further apart; how directors turn there is in `gfb_shell_turn`. Nodes
  !> without elements get no axes (zero).
  !>
  !> Fails where the normals at a node cancel each other (opposite sides of a fold, or neighbours
  !> numbered in opposite senses).
  pure subroutine shell_directors(element_nodes, normal, node_count, kink_angle, director, axis, &
                                  kink, error)
    integer, intent(in) :: element_nodes(:, :) !! (4, elements), nodes from 1
    real(wp), intent(in) :: normal(:, :, :)    !! (3, 4, elements), exact or of `corner_normals` [1]
    integer, intent(in) :: node_count          !! nodes of the mesh
    real(wp), intent(in) :: kink_angle         !! normals further apart make a kink [rad]
    real(wp), intent(out) :: director(:, :, :) !! (3, 4, elements) [1]
    real(wp), intent(out) :: axis(:, :, :)     !! (3, 2, nodes), V1 and V2 [1]
    logical, intent(out) :: kink(:)            !! of each node
    type(error_type), allocatable, intent(out) :: error !! what went wrong, if anything did

    integer :: start(node_count + 1), corner(size(element_nodes))
    real(wp) :: near, mean(3)
    logical :: apart
    integer :: node, i

    call corners_of_nodes(element_nodes, start, corner)
    near = cos(kink_angle)
    kink = .false.
    axis = 0.0_wp
    do node = 1, node_count
      associate (around => corner(start(node):start(node + 1) - 1))
        if (size(around) == 0) cycle
        ! With an angle beyond half a turn all normals are near.
        call mean_normal(normal, around, -2.0_wp, around(1), mean, apart)
        if (.not. norm2(mean) > least_sum) then
          call fail(error, 'the normals of the shell elements at node '//text(node)//' cancel')
          return
        end if
        axis(:, :, node) = rotation_axes(mean/norm2(mean))
        do i = 1, size(around)
          call mean_normal(normal, around, near, around(i), mean, apart)
          director(:, place(around(i)), element(around(i))) = mean/norm2(mean)
          kink(node) = kink(node) .or. apart
        end do
      end associate
    end do
  end subroutine shell_directors

  !> Mean of the normals around a node that are near to that of one corner.
  pure subroutine mean_normal(normal, around, near, own, mean, apart)
    real(wp), intent(in) :: normal(:, :, :) !! (3, 4, elements) [1]
    integer, intent(in) :: around(:)        !! corners at the node
    real(wp), intent(in) :: near            !! least cosine of the angle to the own normal
    integer, intent(in) :: own              !! corner asked for
    real(wp), intent(out) :: mean(3)        !! not of unit length
    logical, intent(out) :: apart           !! some normals are not near
    real(wp) :: total(3), mine(3), other(3)
    integer :: i, count

    total = 0.0_wp
    count = 0
    mine = normal(:, place(own), element(own))
    do i = 1, size(around)
      other = normal(:, place(around(i)), element(around(i)))
      if (around(i) /= own .and. dot_product(mine, other) < near) cycle
      total = total + other
      count = count + 1
    end do
    mean = total/count
    apart = count < size(around)
  end subroutine mean_normal

  !> The corners of elements at each node; corner c is number `place(c)` of element `element(c)`.
  pure subroutine corners_of_nodes(element_nodes, start, corner)
    integer, intent(in) :: element_nodes(:, :)
    integer, intent(out) :: start(:)  !! first entry of a node in `corner`
    integer, intent(out) :: corner(:) !! node after node
    integer :: next(size(start)), c, node

    start = 0
    do c = 1, size(element_nodes)
      node = element_nodes(place(c), element(c))
      start(node + 1) = start(node + 1) + 1
    end do
    start(1) = 1
    do node = 2, size(start)
      start(node) = start(node) + start(node - 1)
    end do
    next = start
    do c = 1, size(element_nodes)
      node = element_nodes(place(c), element(c))
      corner(next(node)) = c
      next(node) = next(node) + 1
    end do
  end subroutine corners_of_nodes

  !> Which node of its element a corner is.
  pure function place(corner)
    integer, intent(in) :: corner
    integer :: place
    place = modulo(corner - 1, shell_nodes) + 1
  end function place

  !> Which element a corner belongs to.
  pure function element(corner)
    integer, intent(in) :: corner
    integer :: element
    element = (corner - 1)/shell_nodes + 1
  end function element
end module shell_director
