!> Elements, motions and small linear algebra for the tests of the shell.
module shell_samples
  use gfb_kinds, only: wp
  use sample_vectors, only: numbers, rotation
  use gfb_errors, only: error_type
  use gfb_shell_geometry, only: shell_geometry_type, shell_section_type, shell_nodes, &
    shell_unknowns, node_unknowns, cross
  use shell_director, only: corner_normals, rotation_axes
  implicit none (type, external)
  private
  public :: sample_section, sample_stand, sample_element, sample_name, flat_element, numbers, &
        rotation, turned, &
            rigid_motion, renumbered, eigenvalues, unknowns_of

  integer, parameter, public :: samples = 6 !! square, distorted, warped, cylinder, sphere, kink
  integer, parameter, public :: smooth_samples = 5 !! the first ones, without kinks
  integer, parameter, public :: flat_samples = 2 !! the first ones

contains

  !> A section in plain numbers.
  pure function sample_section() result(section)
    type(shell_section_type) :: section

    section = shell_section_type(thickness=0.1_wp, youngs_modulus=3.0_wp, poissons_ratio=0.3_wp, &
                                 density=2.0_wp)
  end function sample_section

  !> What a sample is, for messages.
  pure function sample_name(number) result(name)
    integer, intent(in) :: number
    character(len=9) :: name
    character(len=9), parameter :: names(samples) = &
      [character(len=9) :: 'square', 'distorted', 'warped', 'cylinder', 'sphere', 'kink']

    name = names(number)
  end function sample_name

  !> One of the sample elements, of size one, turned in space so that no axis is special.
  function sample_element(number) result(geometry)
    integer, intent(in) :: number
    type(shell_geometry_type) :: geometry
    real(wp) :: corner(2, shell_nodes), angle
    integer :: a

    corner = reshape([0.0_wp, 0.0_wp, 1.1_wp, 0.1_wp, 0.9_wp, 1.2_wp, -0.1_wp, 0.8_wp], &
                     [2, shell_nodes])
    if (number == 1) corner = reshape([0.0_wp, 0.0_wp, 1.0_wp, 0.0_wp, 1.0_wp, 1.0_wp, &
                                       0.0_wp, 1.0_wp], [2, shell_nodes])
    geometry = flat_element(corner)
    do a = 1, shell_nodes
      associate (position => geometry%position(:, a), director => geometry%director(:, a))
        select case (number)
        case (3) ! exact normals of z = x y / 4
          position(3) = 0.25_wp*position(1)*position(2)
          director = [-0.25_wp*position(2), -0.25_wp*position(1), 1.0_wp]
        case (4)
          director = [sin(0.5_wp*position(1)), 0.0_wp, cos(0.5_wp*position(1))]
          position = [0.0_wp, position(2), 0.0_wp] + 2.0_wp*director
        case (5)
          director = [sin(0.5_wp*position(1)), cos(0.5_wp*position(1))*sin(0.5_wp*position(2)), &
                      cos(0.5_wp*position(1))*cos(0.5_wp*position(2))]
          position = 2.0_wp*director
        case default ! as it is
        end select
        director = director/norm2(director)
        geometry%axis(:, :, a) = rotation_axes(director)
      end associate
    end do
    if (number == 6) then
      ! The side x = 1 is a kink: the neighbour goes down at 0.6, the axes stand on the mean normal.
      angle = 0.3_wp
      do a = 2, 3
        geometry%axis(:, :, a) = rotation_axes([sin(angle), 0.0_wp, cos(angle)])
      end do
    end if
    geometry = turned(geometry, sample_stand())
  end function sample_element

  !> How the samples stand in space.
  pure function sample_stand() result(matrix)
    real(wp) :: matrix(3, 3)

    matrix = rotation([0.3_wp, -0.5_wp, 0.7_wp])
  end function sample_stand

  !> A flat element in the plane z = 0 with its normal as directors.
  function flat_element(corner) result(geometry)
    real(wp), intent(in) :: corner(2, shell_nodes) !! x, y of the nodes
    type(shell_geometry_type) :: geometry
    type(error_type), allocatable :: error
    integer :: a

    geometry%position = 0.0_wp
    geometry%position(1:2, :) = corner
    call corner_normals(geometry%position, geometry%director, error)
    if (allocated(error)) error stop 'shell_samples: no normal'
    do a = 1, shell_nodes
      geometry%axis(:, :, a) = rotation_axes(geometry%director(:, a))
    end do
  end function flat_element

  !> An element with all its vectors turned.
  pure function turned(geometry, matrix) result(other)
    type(shell_geometry_type), intent(in) :: geometry
    real(wp), intent(in) :: matrix(3, 3)
    type(shell_geometry_type) :: other
    integer :: a

    other%position = matmul(matrix, geometry%position)
    other%director = matmul(matrix, geometry%director)
    do a = 1, shell_nodes
      other%axis(:, :, a) = matmul(matrix, geometry%axis(:, :, a))
    end do
  end function turned

  !> Unknowns of an element that is shifted and turned as a rigid body.
  pure function rigid_motion(geometry, shift, turn) result(displacement)
    type(shell_geometry_type), intent(in) :: geometry
    real(wp), intent(in) :: shift(3) !! [m]
    real(wp), intent(in) :: turn(3)  !! small rotation [rad]
    real(wp) :: displacement(shell_unknowns)
    integer :: a

    do a = 1, shell_nodes
      associate (first => node_unknowns*(a - 1))
        displacement(first + 1:first + 3) = shift + cross(turn, geometry%position(:, a))
        displacement(first + 4:first + 5) = matmul(turn, geometry%axis(:, :, a))
      end associate
    end do
  end function rigid_motion

  !> An element with its nodes in another order.
  pure function renumbered(geometry, order) result(other)
    type(shell_geometry_type), intent(in) :: geometry
    integer, intent(in) :: order(shell_nodes) !! old numbers of the nodes
    type(shell_geometry_type) :: other

    other%position = geometry%position(:, order)
    other%director = geometry%director(:, order)
    other%axis = geometry%axis(:, :, order)
  end function renumbered

  !> Unknowns of nodes.
  pure function unknowns_of(nodes) result(unknown)
    integer, intent(in) :: nodes(:)
    integer :: unknown(node_unknowns*size(nodes))
    integer :: a, i

    unknown = [((node_unknowns*(nodes(a) - 1) + i, i=1, node_unknowns), a=1, size(nodes))]
  end function unknowns_of

  !> Eigenvalues of a symmetric matrix in rising order, by Jacobi's rotations.
  pure function eigenvalues(matrix) result(value)
    real(wp), intent(in) :: matrix(:, :)
    real(wp) :: value(size(matrix, 1))
    real(wp) :: a(size(matrix, 1), size(matrix, 1)), row(size(matrix, 1)), t, c, s, theta
    integer :: sweep, p, q, i

    a = matrix
    do sweep = 1, 30
      do p = 1, size(value) - 1
        do q = p + 1, size(value)
          if (.not. abs(a(p, q)) > tiny(1.0_wp)) cycle
          theta = 0.5_wp*(a(q, q) - a(p, p))/a(p, q)
          t = 1.0_wp
          if (abs(theta) < 1.0e150_wp) t = 1.0_wp/(abs(theta) + sqrt(theta**2 + 1.0_wp))
          if (abs(theta) >= 1.0e150_wp) t = 0.5_wp/abs(theta)
          t = sign(t, theta)
          c = 1.0_wp/sqrt(t**2 + 1.0_wp)
          s = t*c
          row = a(p, :)
          a(p, :) = c*row - s*a(q, :)
          a(q, :) = s*row + c*a(q, :)
          row = a(:, p)
          a(:, p) = c*row - s*a(:, q)
          a(:, q) = s*row + c*a(:, q)
        end do
      end do
    end do
    value = [(a(i, i), i=1, size(value))]
    do p = 1, size(value) - 1
      q = p - 1 + minloc(value(p:), 1)
      t = value(p)
      value(p) = value(q)
      value(q) = t
    end do
  end function eigenvalues
end module shell_samples
