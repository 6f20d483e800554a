!> A shell mesh of rows and columns with supports and loads, solved by band Cholesky: for tests.
module shell_model
  use gfb_kinds, only: wp
  use gfb_errors, only: error_type
  use gfb_shell_geometry, only: shell_geometry_type, shell_section_type, shell_nodes, &
    shell_unknowns, node_unknowns, shell_abscissa, bilinear, cross
  use shell_director, only: shell_directors
  use gfb_shell_element, only: shell_stiffness
  implicit none (type, external)
  private
  public :: new_model, surface_type, element_geometry, model_stiffness, solve_model, clamp_node, &
            hold_symmetry, hold_unknown, add_area_load, factor_band, solve_band

  !> Where a surface is and which way it looks, for two parameters in [0, 1].
  type, abstract :: surface_type
  contains
    procedure(surface_point), deferred :: point
  end type surface_type

  abstract interface
    !> Position and unit normal.
    pure subroutine surface_point(self, s, t, position, normal)
      import :: surface_type, wp
      implicit none (type, external)
      class(surface_type), intent(in) :: self
      real(wp), intent(in) :: s, t         !! in [0, 1]
      real(wp), intent(out) :: position(3) !! [m]
      real(wp), intent(out) :: normal(3)   !! towards the derivative by s times that by t
    end subroutine surface_point
  end interface

  !> The mesh, what holds it, what loads it, and how it moves.
  type, public :: model_type
    type(shell_section_type) :: section
    integer :: columns = 0, rows = 0              !! elements along s and t
    integer, allocatable :: node(:, :)            !! number of a node, both from 0
    integer, allocatable :: element_nodes(:, :)   !! (4, elements)
    real(wp), allocatable :: position(:, :)       !! (3, nodes) [m]
    real(wp), allocatable :: director(:, :, :)    !! (3, 4, elements)
    real(wp), allocatable :: axis(:, :, :)        !! (3, 2, nodes)
    logical, allocatable :: held(:, :)            !! (5, nodes)
    real(wp), allocatable :: load(:, :)           !! (5, nodes) [N], [N m]
    real(wp), allocatable :: displacement(:, :)   !! (5, nodes) [m], [rad]
  end type model_type

contains

  !> A free, unloaded mesh; few columns and many rows make a narrow band.
  subroutine new_model(surface, columns, rows, section, model)
    class(surface_type), intent(in) :: surface
    integer, intent(in) :: columns, rows
    type(shell_section_type), intent(in) :: section
    type(model_type), intent(out) :: model
    type(error_type), allocatable :: error
    real(wp), allocatable :: normal(:, :), at_corner(:, :, :)
    logical, allocatable :: kink(:)
    integer :: i, j, count, number

    count = (columns + 1)*(rows + 1)
    model%section = section
    model%columns = columns
    model%rows = rows
    allocate (model%node(0:columns, 0:rows), model%position(3, count), normal(3, count))
    number = 0
    do j = 0, rows
      do i = 0, columns
        number = number + 1
        model%node(i, j) = number
        call surface%point(real(i, wp)/columns, real(j, wp)/rows, model%position(:, number), &
                           normal(:, number))
      end do
    end do
    allocate (model%element_nodes(shell_nodes, columns*rows))
    number = 0
    do j = 1, rows
      do i = 1, columns
        number = number + 1
        model%element_nodes(:, number) = [model%node(i - 1, j - 1), model%node(i, j - 1), &
                                          model%node(i, j), model%node(i - 1, j)]
      end do
    end do
    allocate (at_corner(3, shell_nodes, number), model%director(3, shell_nodes, number))
    allocate (model%axis(3, 2, count), kink(count), model%held(node_unknowns, count))
    allocate (model%load(node_unknowns, count), source=0.0_wp)
    allocate (model%displacement(node_unknowns, count), source=0.0_wp)
    do i = 1, number
      at_corner(:, :, i) = normal(:, model%element_nodes(:, i))
    end do
    call shell_directors(model%element_nodes, at_corner, count, 0.1_wp, model%director, &
                         model%axis, kink, error)
    if (allocated(error)) error stop 'shell_model: directors cancel'
    if (any(kink)) error stop 'shell_model: a smooth surface has a kink'
    model%held = .false.
  end subroutine new_model

  !> One element of the mesh.
  pure function element_geometry(model, element) result(geometry)
    type(model_type), intent(in) :: model
    integer, intent(in) :: element
    type(shell_geometry_type) :: geometry

    associate (nodes => model%element_nodes(:, element))
      geometry%position = model%position(:, nodes)
      geometry%director = model%director(:, :, element)
      geometry%axis = model%axis(:, :, nodes)
    end associate
  end function element_geometry

  !> Holds all five unknowns of a node.
  pure subroutine clamp_node(model, node)
    type(model_type), intent(inout) :: model
    integer, intent(in) :: node

    model%held(:, node) = .true.
  end subroutine clamp_node

  !> Holds one unknown of a node.
  pure subroutine hold_unknown(model, node, unknown)
    type(model_type), intent(inout) :: model
    integer, intent(in) :: node
    integer, intent(in) :: unknown !! 1 to 5

    model%held(unknown, node) = .true.
  end subroutine hold_unknown

  !> Holds a node in a plane of symmetry: no displacement along, rotation only about, its normal.
  pure subroutine hold_symmetry(model, node, direction)
    type(model_type), intent(inout) :: model
    integer, intent(in) :: node
    integer, intent(in) :: direction !! global axis normal to the plane
    integer :: k

    model%held(direction, node) = .true.
    do k = 1, 2
      if (abs(model%axis(direction, k, node)) < 0.5_wp) model%held(3 + k, node) = .true.
    end do
  end subroutine hold_symmetry

  !> Consistent nodal forces of a load on the area of the mid-surface.
  pure subroutine add_area_load(model, traction)
    type(model_type), intent(inout) :: model
    real(wp), intent(in) :: traction(3) !! [N/m2]
    real(wp), dimension(shell_nodes) :: shape, by_xi, by_eta
    real(wp) :: area(3)
    integer :: element, i, j, a

    do element = 1, size(model%element_nodes, 2)
      associate (nodes => model%element_nodes(:, element))
        do j = -1, 1, 2
          do i = -1, 1, 2
            call bilinear(i*shell_abscissa, j*shell_abscissa, shape, by_xi, by_eta)
            area = cross(matmul(model%position(:, nodes), by_xi), &
                         matmul(model%position(:, nodes), by_eta))
            do a = 1, shell_nodes
              model%load(1:3, nodes(a)) = model%load(1:3, nodes(a)) &
                + shape(a)*norm2(area)*traction
            end do
          end do
        end do
      end associate
    end do
  end subroutine add_area_load

  !> Stiffness in band form: `band(1 + i - j, j)` is row i, column j, i >= j.
  subroutine model_stiffness(model, band)
    type(model_type), intent(in) :: model
    real(wp), allocatable, intent(out) :: band(:, :)
    type(error_type), allocatable :: error
    real(wp) :: stiffness(shell_unknowns, shell_unknowns)
    integer :: unknown(shell_unknowns), element, i, j, a

    allocate (band(node_unknowns*(model%columns + 3), node_unknowns*size(model%position, 2)), &
              source=0.0_wp)
    do element = 1, size(model%element_nodes, 2)
      call shell_stiffness(element_geometry(model, element), model%section, stiffness, error)
      if (allocated(error)) error stop 'shell_model: bad element'
      do a = 1, shell_nodes
        unknown(node_unknowns*(a - 1) + 1:node_unknowns*a) = &
          node_unknowns*(model%element_nodes(a, element) - 1) + [1, 2, 3, 4, 5]
      end do
      do j = 1, shell_unknowns
        do i = 1, shell_unknowns
          if (unknown(i) < unknown(j)) cycle
          associate (entry => band(1 + unknown(i) - unknown(j), unknown(j)))
            entry = entry + stiffness(i, j)
          end associate
        end do
      end do
    end do
  end subroutine model_stiffness

  !> Displacements under the loads.
  subroutine solve_model(model)
    type(model_type), intent(inout) :: model
    real(wp), allocatable :: band(:, :), values(:)
    logical, allocatable :: held(:)
    integer :: j, below

    call model_stiffness(model, band)
    held = reshape(model%held, [size(model%held)])
    values = reshape(model%load, [size(model%load)])
    do j = 1, size(band, 2)
      if (held(j)) then
        band(:, j) = 0.0_wp
        band(1, j) = 1.0_wp
        values(j) = 0.0_wp
      else
        do below = 1, min(size(band, 1) - 1, size(band, 2) - j)
          if (held(j + below)) band(1 + below, j) = 0.0_wp
        end do
      end if
    end do
    call factor_band(band)
    call solve_band(band, values)
    model%displacement = reshape(values, shape(model%load))
  end subroutine solve_model

  !> Cholesky factor of a positive definite band matrix, in its place.
  pure subroutine factor_band(band)
    real(wp), intent(inout) :: band(:, :) !! diagonal in the first row, lower ones below
    real(wp) :: multiplier
    integer :: j, k, last, height

    height = size(band, 1)
    do j = 1, size(band, 2)
      if (.not. band(1, j) > 0.0_wp) error stop 'shell_model: the stiffness is singular'
      last = min(height, size(band, 2) - j + 1)
      band(1, j) = sqrt(band(1, j))
      band(2:last, j) = band(2:last, j)/band(1, j)
      do k = 2, last
        multiplier = band(k, j)
        if (.not. abs(multiplier) > 0.0_wp) cycle
        band(1:last - k + 1, j + k - 1) = band(1:last - k + 1, &
              j + k - 1) - multiplier*band(k:last, j)
      end do
    end do
  end subroutine factor_band

  !> Solves with the factor of `factor_band`.
  pure subroutine solve_band(band, values)
    real(wp), intent(in) :: band(:, :)
    real(wp), intent(inout) :: values(:) !! right-hand side, then the solution
    integer :: j, last

    do j = 1, size(band, 2)
      last = min(size(band, 1), size(band, 2) - j + 1)
      values(j) = values(j)/band(1, j)
      values(j + 1:j + last - 1) = values(j + 1:j + last - 1) - values(j)*band(2:last, j)
    end do
    do j = size(band, 2), 1, -1
      last = min(size(band, 1), size(band, 2) - j + 1)
      values(j) = (values(j) - dot_product(band(2:last, j), values(j + 1:j + last - 1)))/band(1, j)
    end do
  end subroutine solve_band
end module shell_model
