!> Geometry of a four-node film element at its Gauss points.
!>
!> Coordinates: \( x \) along the shaft's motion, \( z \) along its axis. Nodes run
!> counter-clockwise in the \( (x, z) \) plane. Elements do not move, so this is computed once a
!> run.
module gfb_film_geometry
  use gfb_kinds, only: wp
  use gfb_errors, only: error_type, fail
  implicit none (type, external)
  private
  public :: film_geometry, film_shape

  integer, parameter, public :: film_nodes = 4  !! nodes of an element
  integer, parameter, public :: film_points = 4 !! Gauss points of an element, 2 x 2

  real(wp), parameter :: abscissa = 1.0_wp/sqrt(3.0_wp) !! of two-point Gauss quadrature [1]
  real(wp), parameter :: node_xi(film_nodes) = [-1.0_wp, 1.0_wp, 1.0_wp, -1.0_wp]
  real(wp), parameter :: node_eta(film_nodes) = [-1.0_wp, -1.0_wp, 1.0_wp, 1.0_wp]

  !> Shape functions (node, point) at the Gauss points, the same for every element [1].
  real(wp), parameter :: film_shape(film_nodes, film_points) = 0.25_wp* &
    (1.0_wp + spread(node_xi, 2, film_points)*spread(node_xi*abscissa, 1, film_nodes))* &
    (1.0_wp + spread(node_eta, 2, film_points)*spread(node_eta*abscissa, 1, film_nodes))

  !> What the integrals over one element need.
  type, public :: film_geometry_type
    real(wp) :: gradient(2, film_nodes, film_points) !! of the shape functions in (x, z) [1/m]
    real(wp) :: area(film_points)                    !! weight times Jacobian determinant [m2]
    real(wp) :: stream_length(film_points)           !! the element's length along x [m]
  end type film_geometry_type

contains

  !> Gradients, areas and lengths of one element.
  !>
  !> Fails when the element is folded over or its nodes run clockwise (determinant not positive).
  pure subroutine film_geometry(position, geometry, error)
    real(wp), intent(in) :: position(2, film_nodes) !! node positions (x, z) [m]
    type(film_geometry_type), intent(out) :: geometry
    type(error_type), allocatable, intent(out) :: error

    real(wp) :: parent(2, film_nodes), jacobian(2, 2), inverse(2, 2), det
    integer :: point

    do point = 1, film_points
      parent(1, :) = 0.25_wp*node_xi*(1.0_wp + node_eta*node_eta(point)*abscissa)
      parent(2, :) = 0.25_wp*node_eta*(1.0_wp + node_xi*node_xi(point)*abscissa)
      jacobian = matmul(position, transpose(parent)) ! d(x, z)/d(xi, eta)
      det = jacobian(1, 1)*jacobian(2, 2) - jacobian(1, 2)*jacobian(2, 1)
      if (.not. det > 0.0_wp) then
        call fail(error, 'a film element is folded over or runs clockwise')
        return
      end if
      inverse(1, :) = [jacobian(2, 2), -jacobian(1, 2)]/det
      inverse(2, :) = [-jacobian(2, 1), jacobian(1, 1)]/det
      geometry%gradient(:, :, point) = matmul(transpose(inverse), parent)
      geometry%area(point) = det
      geometry%stream_length(point) = 2.0_wp/(abs(inverse(1, 1)) + abs(inverse(2, 1)))
    end do
  end subroutine film_geometry
end module gfb_film_geometry
