!> Geometry of a film element at its Gauss points.
!>
!> Coordinates: \( x \) along the shaft's motion, \( z \) across it. A bilinear element has
!> four nodes, counter-clockwise in the \( (x, z) \) plane. A biquadratic one has nine, three by
!> three, those of one \( x \) after the other. Both have as many Gauss points as nodes, numbered
!> as they are. Elements do not move, so this is computed once a run.
module gfb_film_geometry
  use gfb_kinds, only: wp
  use gfb_errors, only: error_type, fail
  implicit none (type, external)
  private
  public :: film_geometry, widen, film_shape, biquadratic_shape, film_shapes

  integer, parameter, public :: film_nodes = 4         !! nodes of a bilinear element
  integer, parameter, public :: film_points = 4        !! its Gauss points, 2 x 2
  integer, parameter, public :: biquadratic_nodes = 9  !! nodes of a biquadratic element
  integer, parameter :: biquadratic_points = 9 !! its Gauss points, 3 x 3
  integer, parameter, public :: most_film_nodes = 9    !! of any element

  real(wp), parameter :: abscissa = 1.0_wp/sqrt(3.0_wp) !! of two-point Gauss quadrature [1]
  real(wp), parameter :: node_xi(film_nodes) = [-1.0_wp, 1.0_wp, 1.0_wp, -1.0_wp]
  real(wp), parameter :: node_eta(film_nodes) = [-1.0_wp, -1.0_wp, 1.0_wp, 1.0_wp]

  integer, parameter :: line_nodes = 3 !! of a biquadratic element, in each direction
  !> Abscissae and weights of three-point Gauss quadrature [1].
  real(wp), parameter :: line_point(line_nodes) = sqrt(0.6_wp)*[-1.0_wp, 0.0_wp, 1.0_wp]
  real(wp), parameter :: line_weight(line_nodes) = [5.0_wp, 8.0_wp, 5.0_wp]/9.0_wp
  !> Quadratic functions (node, point) of a line and their slopes [1].
  real(wp), parameter :: line_shape(line_nodes, line_nodes) = transpose(reshape( &
    [0.5_wp*line_point*(line_point - 1.0_wp), 1.0_wp - line_point**2, &
     0.5_wp*line_point*(line_point + 1.0_wp)], [line_nodes, line_nodes]))
  real(wp), parameter :: line_slope(line_nodes, line_nodes) = transpose(reshape( &
    [line_point - 0.5_wp, -2.0_wp*line_point, line_point + 0.5_wp], [line_nodes, line_nodes]))

  !> Shape functions (node, point) of bilinear elements at the Gauss points [1].
  real(wp), parameter :: film_shape(film_nodes, film_points) = 0.25_wp* &
    (1.0_wp + spread(node_xi, 2, film_points)*spread(node_xi*abscissa, 1, film_nodes))* &
    (1.0_wp + spread(node_eta, 2, film_points)*spread(node_eta*abscissa, 1, film_nodes))

  !> Which of the line's nodes, or points, stand in those of the element along x, and along z.
  integer, parameter :: along(biquadratic_nodes) = [1, 1, 1, 2, 2, 2, 3, 3, 3]
  integer, parameter :: across(biquadratic_nodes) = [1, 2, 3, 1, 2, 3, 1, 2, 3]
  !> Shape functions (node, point) of biquadratic elements at the Gauss points [1].
  real(wp), parameter :: biquadratic_shape(biquadratic_nodes, biquadratic_points) = &
    line_shape(along, along)*line_shape(across, across)

  !> What the integrals over one element need.
  type, public :: film_geometry_type
    real(wp), allocatable :: gradient(:, :, :)  !! (2, nodes, points) of the shapes, (x, z) [1/m]
    real(wp), allocatable :: area(:)            !! weight times Jacobian determinant [m2]
    real(wp), allocatable :: stream_length(:)   !! distance of the nodes along x [m]
    real(wp), allocatable :: stretch(:)         !! see `gfb_film_surface` [1]
  end type film_geometry_type

contains

  !> Gradients, areas and lengths of one element.
  !>
  !> Fails when the element is folded over or its nodes run clockwise (determinant not positive).
  pure subroutine film_geometry(position, geometry, error)
    real(wp), intent(in) :: position(:, :) !! (2, 4 or 9) node positions (x, z) [m]
    type(film_geometry_type), intent(out) :: geometry !! the element at its points
    type(error_type), allocatable, intent(out) :: error !! why it failed

    real(wp) :: parent(2, size(position, 2)), jacobian(2, 2), inverse(2, 2), det, weight, intervals
    integer :: point

    associate (nodes => size(position, 2))
      allocate (geometry%gradient(2, nodes, nodes), geometry%area(nodes))
      allocate (geometry%stream_length(nodes))
      allocate (geometry%stretch(nodes), source=1.0_wp)
      intervals = real(merge(1, line_nodes - 1, nodes == film_nodes), wp)
    end associate
    do point = 1, size(geometry%area)
      call parent_slopes(point, parent, weight)
      jacobian = matmul(position, transpose(parent)) ! d(x, z)/d(xi, eta)
      det = jacobian(1, 1)*jacobian(2, 2) - jacobian(1, 2)*jacobian(2, 1)
      if (.not. det > 0.0_wp) then
        call fail(error, 'a film element is folded over or runs clockwise')
        return
      end if
      inverse(1, :) = [jacobian(2, 2), -jacobian(1, 2)]/det
      inverse(2, :) = [-jacobian(2, 1), jacobian(1, 1)]/det
      geometry%gradient(:, :, point) = matmul(transpose(inverse), parent)
      geometry%area(point) = det*weight
      geometry%stream_length(point) = 2.0_wp/(abs(inverse(1, 1)) + abs(inverse(2, 1)))/intervals
    end do
  end subroutine film_geometry

  !> Makes an element that was measured at one radius one of a surface whose radius changes: along x
  !> it is longer, and its surface faster, by the stretch.
  pure subroutine widen(stretch, geometry)
    real(wp), intent(in) :: stretch(:) !! at the points, see `gfb_film_surface` [1]
    type(film_geometry_type), intent(inout) :: geometry !! the element
    integer :: point

    do point = 1, size(stretch)
      geometry%gradient(1, :, point) = geometry%gradient(1, :, point)/stretch(point)
    end do
    geometry%area = geometry%area*stretch
    geometry%stream_length = geometry%stream_length*stretch
    geometry%stretch = stretch
  end subroutine widen

  !> Slopes of the shape functions on the parent square, and the weight of a Gauss point.
  pure subroutine parent_slopes(point, parent, weight)
    integer, intent(in) :: point
    real(wp), intent(out) :: parent(:, :) !! (2, nodes) along (xi, eta) [1]
    real(wp), intent(out) :: weight       !! [1]

    if (size(parent, 2) == film_nodes) then
      parent(1, :) = 0.25_wp*node_xi*(1.0_wp + node_eta*node_eta(point)*abscissa)
      parent(2, :) = 0.25_wp*node_eta*(1.0_wp + node_xi*node_xi(point)*abscissa)
      weight = 1.0_wp
    else
      parent(1, :) = line_slope(along, along(point))*line_shape(across, across(point))
      parent(2, :) = line_shape(along, along(point))*line_slope(across, across(point))
      weight = line_weight(along(point))*line_weight(across(point))
    end if
  end subroutine parent_slopes

  !> Shape functions (node, point) of elements with so many nodes [1].
  pure function film_shapes(nodes) result(shapes)
    integer, intent(in) :: nodes !! 4 or 9
    real(wp) :: shapes(nodes, nodes)

    if (nodes == film_nodes) then
      shapes = film_shape
    else
      shapes = biquadratic_shape
    end if
  end function film_shapes
end module gfb_film_geometry
