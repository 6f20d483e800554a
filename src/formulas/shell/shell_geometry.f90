!> Geometry of the four-node shell element: nodes, directors, base vectors, lamina frame.
!>
!> $$ \mathbf{x}(\xi, \eta, \zeta) = \sum_a N_a(\xi, \eta) \Bigl( \mathbf{x}_a
!>    + \frac{h}{2} \zeta \mathbf{V}_a \Bigr), \qquad
!>    \mathbf{u} = \sum_a N_a \Bigl( \mathbf{u}_a + \frac{h}{2} \zeta \,
!>    \boldsymbol{\theta}_a \times \mathbf{V}_a \Bigr), \qquad
!>    \boldsymbol{\theta}_a = \alpha_a \mathbf{V}^1_a + \beta_a \mathbf{V}^2_a $$
!>
!> Source: [DvorkinBathe1984]. The director \( \mathbf{V}_a \) belongs to the element, the rotation
!> axes \( \mathbf{V}^1_a, \mathbf{V}^2_a \) to the node. Where the director is the third of the
!> axes, its change is the usual \( -\alpha \mathbf{V}^2 + \beta \mathbf{V}^1 \). Rotation about the
!> nodal normal (drilling) has no unknown and no stiffness; at a smooth node it does not turn the
!> director anyway, at a kink it follows the element's translations (`gfb_shell_turn`).
!>
!> Nodes run counter-clockwise seen from the tips of the directors. Unknowns of an element, node by
!> node: three displacements [m], \( \alpha, \beta \) [rad]. Displacements are along the axes of the
!> positions, or, on a ring, along these turned about the second one by an angle of each node.
module gfb_shell_geometry
  use gfb_kinds, only: wp
  use gfb_errors, only: error_type, fail
  implicit none (type, external)
  private
  public :: check_shell, bilinear, shell_base, shell_lamina, cross

  integer, parameter, public :: shell_nodes = 4    !! nodes of an element
  integer, parameter, public :: node_unknowns = 5  !! u, v, w, alpha, beta
  integer, parameter, public :: shell_unknowns = shell_nodes*node_unknowns
  real(wp), parameter, public :: shell_abscissa = 1.0_wp/sqrt(3.0_wp) !! of two Gauss points [1]

  real(wp), parameter, public :: node_xi(shell_nodes) = [-1.0_wp, 1.0_wp, 1.0_wp, -1.0_wp]
  real(wp), parameter, public :: node_eta(shell_nodes) = [-1.0_wp, -1.0_wp, 1.0_wp, 1.0_wp]
  !> Sine of a corner's angle below which an element is useless: its stiffness has lost six digits.
  real(wp), parameter :: least_sine = 1.0e-6_wp

  !> Cosine of the angle between director and nodal normal below which a node is folded back.
  real(wp), parameter :: least_cosine = 0.1_wp

  !> Where an element is.
  type, public :: shell_geometry_type
    real(wp) :: position(3, shell_nodes) !! of the nodes on the mid-surface [m]
    real(wp) :: director(3, shell_nodes) !! unit thickness directions of this element [1]
    real(wp) :: axis(3, 2, shell_nodes)  !! unit rotation axes V1, V2 of the nodes [1]
    !> of the displacements' directions at the nodes, about the second axis of the positions [rad]
    real(wp) :: angle(shell_nodes) = 0.0_wp
  contains
    procedure, non_overridable :: is_turned, directions
  end type shell_geometry_type

  !> What an element is made of.
  type, public :: shell_section_type
    real(wp) :: thickness = 0.0_wp      !! h [m]
    real(wp) :: youngs_modulus = 0.0_wp !! E [Pa]
    real(wp) :: poissons_ratio = 0.0_wp !! nu [1]
    real(wp) :: density = 0.0_wp        !! [kg/m3]
  end type shell_section_type

  !> The frame of plane stress at a point, and the contravariant base vectors in it.
  type, public :: shell_lamina_type
    real(wp) :: frame(3, 3) !! unit vectors in columns: along xi, across, director [1]
    real(wp) :: dual(3, 3)  !! components (frame's vector, base vector) [1/m]
    real(wp) :: volume      !! Jacobian determinant [m3]
  end type shell_lamina_type

contains

  !> Refuses elements that have no positive volume or no positive stiffness.
  !>
  !> Fails when thickness or material cannot be, when an edge or a corner's angle vanishes, when the
  !> nodes run clockwise about the directors, when the element is folded or too thick for its
  !> curvature, and when a director lies in the plane of its rotation axes.
  pure subroutine check_shell(geometry, section, error)
    type(shell_geometry_type), intent(in) :: geometry !! the element at its Gauss points
    type(shell_section_type), intent(in) :: section !! thickness and material of the shell
    type(error_type), allocatable, intent(out) :: error !! what went wrong, if anything did
    real(wp) :: sine(shell_nodes)

    sine = corner_sines(geometry)
    if (.not. section%thickness > 0.0_wp) then
      call fail(error, 'the thickness of a shell must be positive')
    else if (.not. section%youngs_modulus > 0.0_wp) then
      call fail(error, 'the Young''s modulus of a shell must be positive')
    else if (.not. (section%poissons_ratio > -1.0_wp .and. section%poissons_ratio < 0.5_wp)) then
      call fail(error, 'the Poisson''s ratio of a shell must be between -1 and 0.5')
    else if (all(sine < -least_sine)) then
      call fail(error, 'the nodes of a shell element run clockwise about its directors')
    else if (any(sine < -least_sine)) then
      call fail(error, 'a shell element is folded over')
    else if (.not. all(sine > least_sine)) then
      call fail(error, 'a shell element is degenerate: an edge or the angle of a corner vanishes')
    else if (.not. has_volume(geometry, section%thickness)) then
      call fail(error, 'a shell element is too thick for its curvature')
    else if (.not. least_turn(geometry) > least_cosine) then
      call fail(error, 'a director of a shell element lies in the plane of its rotation axes')
    end if
  end subroutine check_shell

  !> Whether displacements have directions of their own at the nodes.
  pure logical function is_turned(self) result(turned)
    class(shell_geometry_type), intent(in) :: self !! the element
    turned = any(abs(self%angle) > 0.0_wp)
  end function is_turned

  !> Directions of a node's three displacements, in columns along the axes of the positions [1].
  pure function directions(self, node) result(direction)
    class(shell_geometry_type), intent(in) :: self !! the element
    integer, intent(in) :: node !! of the element
    real(wp) :: direction(3, 3)

    associate (c => cos(self%angle(node)), s => sin(self%angle(node)))
      direction(:, 1) = [c, 0.0_wp, -s]
      direction(:, 2) = [0.0_wp, 1.0_wp, 0.0_wp]
      direction(:, 3) = [s, 0.0_wp, c]
    end associate
  end function directions

  !> Sines of the corners' angles, positive where they run counter-clockwise about the director.
  pure function corner_sines(geometry) result(sine)
    type(shell_geometry_type), intent(in) :: geometry
    real(wp) :: sine(shell_nodes), edge(3, shell_nodes), length(shell_nodes)
    integer, parameter :: after(shell_nodes) = [2, 3, 4, 1], before(shell_nodes) = [4, 1, 2, 3]
    integer :: a

    do a = 1, shell_nodes
      edge(:, a) = geometry%position(:, after(a)) - geometry%position(:, a)
      length(a) = sqrt(dot_product(edge(:, a), edge(:, a)))
    end do
    sine = 0.0_wp
    do a = 1, shell_nodes
      associate (scale => length(a)*length(before(a)))
        if (scale > 0.0_wp) sine(a) = &
          dot_product(cross(edge(:, before(a)), edge(:, a)), geometry%director(:, a))/scale
      end associate
    end do
  end function corner_sines

  !> Whether the Jacobian determinant is positive at the corners of both faces.
  pure logical function has_volume(geometry, thickness) result(positive)
    type(shell_geometry_type), intent(in) :: geometry
    real(wp), intent(in) :: thickness !! h [m]
    real(wp) :: base(3, 3)
    integer :: corner, face

    positive = .true.
    do corner = 1, shell_nodes
      do face = -1, 1, 2
        base = corner_base(geometry, thickness, corner, face)
        positive = positive .and. dot_product(cross(base(:, 1), base(:, 2)), base(:, 3)) > 0.0_wp
      end do
    end do
  end function has_volume

  !> Least cosine of the angles between the directors and the normals of their rotation axes.
  pure real(wp) function least_turn(geometry) result(least)
    type(shell_geometry_type), intent(in) :: geometry
    integer :: a

    least = 1.0_wp
    do a = 1, shell_nodes
      least = min(least, abs(dot_product(geometry%director(:, a), &
                                         cross(geometry%axis(:, 1, a), geometry%axis(:, 2, a)))))
    end do
  end function least_turn

  !> Base vectors at a corner of the upper or lower face.
  pure function corner_base(geometry, thickness, corner, face) result(base)
    type(shell_geometry_type), intent(in) :: geometry
    real(wp), intent(in) :: thickness !! h [m]
    integer, intent(in) :: corner     !! node
    integer, intent(in) :: face       !! 1 or -1
    real(wp) :: base(3, 3), shape(shell_nodes), by_xi(shell_nodes), by_eta(shell_nodes)

    call bilinear(node_xi(corner), node_eta(corner), shape, by_xi, by_eta)
    base = shell_base(geometry, thickness, shape, by_xi, by_eta, real(face, wp))
  end function corner_base

  !> Bilinear shape functions and their derivatives.
  pure subroutine bilinear(xi, eta, shape, by_xi, by_eta)
    real(wp), intent(in) :: xi, eta              !! in [-1, 1]
    real(wp), intent(out) :: shape(shell_nodes), by_xi(shell_nodes), by_eta(shell_nodes)  !! [1]

    shape = 0.25_wp*(1.0_wp + node_xi*xi)*(1.0_wp + node_eta*eta)
    by_xi = 0.25_wp*node_xi*(1.0_wp + node_eta*eta)
    by_eta = 0.25_wp*node_eta*(1.0_wp + node_xi*xi)
  end subroutine bilinear

  !> Covariant base vectors: derivatives of the position by xi, eta, zeta in columns.
  pure function shell_base(geometry, thickness, shape, by_xi, by_eta, zeta) result(base)
    type(shell_geometry_type), intent(in) :: geometry !! the element at its Gauss points
    real(wp), intent(in) :: thickness                              !! h [m]
    real(wp), intent(in), dimension(shell_nodes) :: shape, by_xi, by_eta !! [1]
    real(wp), intent(in) :: zeta                                   !! in [-1, 1]
    real(wp) :: base(3, 3)                                         !! [m]
    real(wp) :: half, point(3)
    integer :: a

    half = 0.5_wp*thickness
    base = 0.0_wp
    do a = 1, shell_nodes
      point = geometry%position(:, a) + half*zeta*geometry%director(:, a)
      base(:, 1) = base(:, 1) + by_xi(a)*point
      base(:, 2) = base(:, 2) + by_eta(a)*point
      base(:, 3) = base(:, 3) + half*shape(a)*geometry%director(:, a)
    end do
  end function shell_base

  !> Lamina frame, contravariant components and volume from the base vectors.
  !>
  !> The frame's third vector is the interpolated director, its first the part of \( \mathbf{g}_\xi
  !> \) at right angles to it. Stress along the director is zero, [DvorkinBathe1984]. With a
  !> director that is not normal to the surface the transverse strains have a share in the strains
  !> of the lamina. The base vectors must be independent (`check_shell`).
  pure function shell_lamina(base) result(lamina)
    real(wp), intent(in) :: base(3, 3) !! [m]
    type(shell_lamina_type) :: lamina
    real(wp) :: half, lean, along, slant, rise

    half = sqrt(dot_product(base(:, 3), base(:, 3)))
    associate (frame => lamina%frame, dual => lamina%dual)
      frame(:, 3) = base(:, 3)/half
      lean = dot_product(base(:, 1), frame(:, 3))
      frame(:, 1) = base(:, 1) - lean*frame(:, 3)
      along = sqrt(dot_product(frame(:, 1), frame(:, 1)))
      frame(:, 1) = frame(:, 1)/along
      frame(:, 2) = cross(frame(:, 3), frame(:, 1))
      slant = dot_product(base(:, 2), frame(:, 1))
      rise = dot_product(base(:, 2), frame(:, 2))
      dual(:, 1) = [1.0_wp/along, -slant/(along*rise), 0.0_wp]
      dual(:, 2) = [0.0_wp, 1.0_wp/rise, 0.0_wp]
      dual(3, 3) = 1.0_wp/half
      dual(1, 3) = -dual(3, 3)*lean/along
      dual(2, 3) = -(dual(3, 3)*dot_product(base(:, 2), frame(:, 3)) + dual(1, 3)*slant)/rise
    end associate
    lamina%volume = along*rise*half
  end function shell_lamina

  !> Vector product.
  pure function cross(first, second) result(product)
    real(wp), intent(in) :: first(3), second(3) !! another [1]
    real(wp) :: product(3)

    product = [first(2)*second(3) - first(3)*second(2), first(3)*second(1) - first(1)*second(3), &
               first(1)*second(2) - first(2)*second(1)]
  end function cross
end module gfb_shell_geometry
