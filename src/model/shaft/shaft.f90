!> A round shaft that bends, with discs: its nodes, its matrices, and what motions need of forces.
!>
!> Both planes through the axis have the same mass M, stiffness K and polar inertia G. With the
!> motions q of the plane of x, then those of the plane of y, it moves as
!>
!> $$ M \ddot q + \Omega \begin{pmatrix} 0 & G \\ -G & 0 \end{pmatrix} \dot q +
!>    K (q + \tau \dot q) + \Omega \tau \begin{pmatrix} 0 & K \\ -K & 0 \end{pmatrix} q = f, $$
!>
!> where the material's damping \(\tau\) acts on rates as the turning shaft sees them
!> [Friswell2010] ch. 5 and 7. At each node stand the displacement and the slope of the section:
!> \(\psi_x = \theta_y\) in the plane of x and \(\psi_y = -\theta_x\) in that of y.
module gfb_shaft
  use gfb_kinds, only: wp
  use gfb_shaft_element, only: shaft_section_type, element_matrices_type, element_size, &
                               element_matrices, section_forces, strain_product
  implicit none (type, external)
  private
  public :: build_shaft, journal_places, node_at

  integer, parameter, public :: motions = 4 !! of a node: x, y, theta_x, theta_y
  real(wp), parameter :: closest = 1.0e-9_wp !! positions that near are one, over the length [1]

  !> A length of shaft with one section.
  type, public :: segment_type
    real(wp) :: length = 0.0_wp !! [m]
    type(shaft_section_type) :: section
    integer :: elements = 4     !! at least, of equal length where nothing stands in it
  end type segment_type

  !> A rigid disc.
  type, public :: disc_type
    real(wp) :: position = 0.0_wp           !! z [m]
    real(wp) :: mass = 0.0_wp               !! [kg]
    real(wp) :: transverse_inertia = 0.0_wp !! [kg m2]
    real(wp) :: polar_inertia = 0.0_wp      !! [kg m2]
  end type disc_type

  !> What the whole body is.
  type, public :: body_type
    real(wp) :: mass = 0.0_wp               !! [kg]
    real(wp) :: centre = 0.0_wp             !! z of its centre of mass [m]
    real(wp) :: transverse_inertia = 0.0_wp !! about an axis through that [kg m2]
    real(wp) :: polar_inertia = 0.0_wp      !! [kg m2]
  end type body_type

  !> The shaft, assembled; matrices are those of one plane.
  type, public :: shaft_type
    real(wp), allocatable :: z(:)            !! of the nodes, rising [m]
    type(shaft_section_type), allocatable :: section(:) !! of the elements
    real(wp), allocatable :: mass(:, :)       !! M, with the discs
    real(wp), allocatable :: stiffness(:, :)  !! K
    real(wp), allocatable :: polar(:, :)      !! G
    real(wp), allocatable :: weight(:)        !! force of an acceleration of 1 [kg], [kg m]
    real(wp) :: material_damping = 0.0_wp     !! tau [s]
  contains
    procedure :: coordinates, body, bending, strain_products
  end type shaft_type

contains

  !> Assembles a shaft; nodes are at the ends of segments, and at each position that is asked for.
  pure function build_shaft(segment, disc, positions, material_damping) result(shaft)
    type(segment_type), intent(in) :: segment(:) !! from the first end on
    type(disc_type), intent(in) :: disc(:)
    real(wp), intent(in) :: positions(:)     !! z of bearings, loads, stations [m]
    real(wp), intent(in) :: material_damping !! tau [s]
    type(shaft_type) :: shaft
    type(element_matrices_type) :: element
    integer :: ends(element_size), i, k, n

    shaft%material_damping = material_damping
    call place_nodes(segment, [positions, disc%position], shaft%z, shaft%section)
    n = 2*size(shaft%z)
    allocate (shaft%mass(n, n), shaft%stiffness(n, n), shaft%polar(n, n), source=0.0_wp)
    allocate (shaft%weight(n), source=0.0_wp)
    do i = 1, size(shaft%section)
      element = element_matrices(shaft%section(i), shaft%z(i + 1) - shaft%z(i))
      ends = [(2*i - 2 + k, k=1, element_size)]
      shaft%mass(ends, ends) = shaft%mass(ends, ends) + element%mass
      shaft%stiffness(ends, ends) = shaft%stiffness(ends, ends) + element%stiffness
      shaft%polar(ends, ends) = shaft%polar(ends, ends) + element%gyroscopic
      shaft%weight(ends) = shaft%weight(ends) + element%weight
    end do
    do i = 1, size(disc)
      associate (w => 2*node_at(shaft, disc(i)%position) - 1)
        shaft%mass(w, w) = shaft%mass(w, w) + disc(i)%mass
        shaft%mass(w + 1, w + 1) = shaft%mass(w + 1, w + 1) + disc(i)%transverse_inertia
        shaft%polar(w + 1, w + 1) = shaft%polar(w + 1, w + 1) + disc(i)%polar_inertia
        shaft%weight(w) = shaft%weight(w) + disc(i)%mass
      end associate
    end do
  end function build_shaft

  !> Nodes at the ends of segments and at positions; between them elements of equal length, as many
  !> as keep to the segment's.
  pure subroutine place_nodes(segment, positions, z, section)
    type(segment_type), intent(in) :: segment(:)
    real(wp), intent(in) :: positions(:) !! [m]
    real(wp), allocatable, intent(out) :: z(:) !! [m]
    type(shaft_section_type), allocatable, intent(out) :: section(:) !! of each element
    real(wp), allocatable :: ends(:)
    real(wp) :: first, last, near
    integer :: i, j, k, parts

    z = [0.0_wp]
    allocate (section(0))
    near = closest*sum(segment%length)
    last = 0.0_wp
    do i = 1, size(segment)
      first = last
      last = sum(segment(:i)%length)
      ends = rising([pack(positions, positions > first + near .and. positions < last - near), &
                     last], near)
      do j = 1, size(ends)
        parts = max(1, ceiling((ends(j) - z(size(z)))/segment(i)%length*segment(i)%elements - &
                               closest))
        first = z(size(z))
        do k = 1, parts
          z = [z, first + (ends(j) - first)*k/parts]
          section = [section, segment(i)%section]
        end do
      end do
    end do
  end subroutine place_nodes

  !> Numbers in their order, each once.
  pure function rising(values, near) result(ordered)
    real(wp), intent(in) :: values(:) !! [m]
    real(wp), intent(in) :: near !! less than that apart they are one [m]
    real(wp), allocatable :: ordered(:), left(:)

    left = values
    allocate (ordered(0))
    do while (size(left) > 0)
      ordered = [ordered, minval(left)]
      left = pack(left, left > ordered(size(ordered)) + near)
    end do
  end function rising

  !> Number of the node next to a position.
  pure integer function node_at(shaft, position) result(node)
    type(shaft_type), intent(in) :: shaft
    real(wp), intent(in) :: position !! z [m]
    node = minloc(abs(shaft%z - position), 1)
  end function node_at

  !> How many motions the shaft has, in both planes.
  pure integer function coordinates(self)
    class(shaft_type), intent(in) :: self !! the shaft
    coordinates = 4*size(self%z)
  end function coordinates

  !> Where the motions x, y, theta_x, theta_y of a node stand among those of the shaft, with the
  !> sign that they have there.
  pure subroutine journal_places(shaft, node, place, sign)
    type(shaft_type), intent(in) :: shaft
    integer, intent(in) :: node
    integer, intent(out) :: place(motions)
    real(wp), intent(out) :: sign(motions) !! [1]
    integer :: n

    n = 2*size(shaft%z)
    place = [2*node - 1, n + 2*node - 1, n + 2*node, 2*node]
    sign = [1.0_wp, 1.0_wp, -1.0_wp, 1.0_wp]
  end subroutine journal_places

  !> Mass, centre and inertias, from its rigid motions.
  pure function body(self)
    class(shaft_type), intent(in) :: self !! the shaft
    type(body_type) :: body
    real(wp) :: along(2*size(self%z)), turned(2*size(self%z))

    along = 0.0_wp
    along(1::2) = 1.0_wp
    turned = 1.0_wp
    turned(1::2) = self%z
    body%mass = dot_product(along, matmul(self%mass, along))
    body%centre = dot_product(along, matmul(self%mass, turned))/body%mass
    turned(1::2) = self%z - body%centre
    body%transverse_inertia = dot_product(turned, matmul(self%mass, turned))
    body%polar_inertia = dot_product(turned, matmul(self%polar, turned))
  end function body

  !> \( U^T K V \) of motions in one plane, to the last digits of each element's strains.
  pure function strain_products(self, left, right) result(product)
    class(shaft_type), intent(in) :: self !! the shaft
    real(wp), intent(in) :: left(:, :), right(:, :) !! U, V (motion, column) [m], [1]
    real(wp) :: product(size(left, 2), size(right, 2)) !! [J] where columns are motions
    integer :: i

    product = 0.0_wp
    do i = 1, size(self%section)
      associate (first => 2*i - 1, last => 2*i - 2 + element_size)
        product = product + strain_product(self%section(i), self%z(i + 1) - self%z(i), &
                                           left(first:last, :), right(first:last, :))
      end associate
    end do
  end function strain_products

  !> Bending moment and shear force at both ends of each element, in one plane.
  pure function bending(self, motion, acceleration) result(force)
    class(shaft_type), intent(in) :: self !! the shaft
    real(wp), intent(in) :: motion(:) !! of that plane [m], [1]
    real(wp), intent(in) :: acceleration !! of free fall in it [m/s2]
    !> (moment and shear, first and second end, element) [N m], [N]
    real(wp), allocatable :: force(:, :, :)
    integer :: i

    allocate (force(2, 2, size(self%section)))
    do i = 1, size(self%section)
      associate (ends => motion(2*i - 1:2*i - 2 + element_size), &
                 length => self%z(i + 1) - self%z(i))
        force(:, :, i) = section_forces(self%section(i), length, ends, acceleration)
      end associate
    end do
  end function bending
end module gfb_shaft
