!> A surface of quadrilaterals in space: nodes, elements, directors, named sets of nodes.
!>
!> A mesh may hold a stretch of its stations only. Nodes and elements keep the numbers they have in
!> the whole mesh: the arrays' bounds are those of the stretch.
module gfb_quad_mesh
  use gfb_kinds, only: wp
  implicit none (type, external)
  private
  public :: node_set, set_count, add_node_set, sub_mesh, own_thickness, solid_rows, &
            loose_rows, strip_at, corner_face, node_thickness

  !> Nodes that have a name, such as a line of crests.
  type, public :: node_set_type
    character(len=:), allocatable :: name
    integer, allocatable :: nodes(:)
  end type node_set_type

  !> A surface mesh. Positions are (x, v, z): along the shaft's motion, towards the shaft, along
  !> the axis.
  !>
  !> On a ring they are (R theta, v, r), R that of the ring: rays and circles unrolled. Directors,
  !> axes and displacements are along the motion, up, and along the radius at their own node.
  type, public :: quad_mesh_type
    real(wp), allocatable :: position(:, :)      !! (3, nodes) on the mid-surface [m]
    !> (4, elements), counter-clockwise seen from the shaft
    integer, allocatable :: element_nodes(:, :)
    !> (3, 4, elements) unit normals; an element's own at kinks
    real(wp), allocatable :: director(:, :, :)
    !> (3, nodes) unit rotation axis along the bearing's axis
    real(wp), allocatable :: axis_1(:, :)
    real(wp), allocatable :: axis_2(:, :)        !! (3, nodes) unit rotation axis across it
    !> (2, nodes) where the upper face is, over half the thickness: along the motion, and up [1]
    real(wp), allocatable :: face(:, :)
    type(node_set_type), allocatable :: sets(:)
    !> of every column of elements of the whole mesh; not allocated: the section's [m]
    real(wp), allocatable :: column_thickness(:)
    !> of every row of elements, where strips side by side differ; not allocated: the section's [m]
    real(wp), allocatable :: row_thickness(:)
    !> strip of every row of nodes, where strips side by side differ
    integer, allocatable :: row_strip(:)
    !> z of a station's nodes, rising [m]
    real(wp), allocatable :: row_axial(:)
    !> rows of elements that are cut away; not allocated: none
    logical, allocatable :: cut(:)
    !> nodes of a station; numbers run along stations first
    integer :: rows = 0
    integer :: stations = 0                      !! of the whole mesh
    logical :: half = .false.                    !! z >= 0 only
    real(wp) :: ring_radius = 0.0_wp             !! at which x is measured; 0: no ring [m]
    !> x where z is a radius, of a flat mesh under a sector [m]
    real(wp) :: middle = 0.0_wp
  contains
    procedure, non_overridable :: nodes => whole_nodes
    procedure, non_overridable :: elements => whole_elements
  end type quad_mesh_type

contains

  !> Nodes of the whole mesh.
  pure integer function whole_nodes(self) result(nodes)
    class(quad_mesh_type), intent(in) :: self !! the mesh
    nodes = self%stations*self%rows
  end function whole_nodes

  !> Elements of the whole mesh.
  pure integer function whole_elements(self) result(elements)
    class(quad_mesh_type), intent(in) :: self !! the mesh
    elements = max(0, self%stations - 1)*(self%rows - 1)
  end function whole_elements

  !> Thickness of an element of its own, 0 where it is the section's [m].
  pure real(wp) function own_thickness(mesh, element) result(thickness)
    type(quad_mesh_type), intent(in) :: mesh !! the foil's mesh
    integer, intent(in) :: element !! of the whole mesh

    thickness = 0.0_wp
    if (allocated(mesh%row_thickness)) then
      thickness = mesh%row_thickness(modulo(element - 1, mesh%rows - 1) + 1)
    end if
    if (.not. allocated(mesh%column_thickness)) return
    thickness = mesh%column_thickness((element - 1)/(mesh%rows - 1) + 1)
  end function own_thickness

  !> Where the upper face is at a line where plates meet, from it, over half the thickness: on both
  !> faces, and as high as a flat's. At an end it is as if a flat followed.
  pure function corner_face(normal) result(face)
    real(wp), intent(in) :: normal(2, 2) !! (component, plate) unit normals, one twice at an end [1]
    real(wp) :: face(2)

    face = normal(:, 1) + normal(:, 2)
    if (all(abs(normal(:, 1) - normal(:, 2)) <= 0.0_wp)) face = normal(:, 1) + [0.0_wp, 1.0_wp]
    face = face/face(2)
  end function corner_face

  !> Thickness at a node: the mean of the columns beside it, or of its row, or what all have [m].
  pure real(wp) function node_thickness(mesh, of_all, node) result(thickness)
    type(quad_mesh_type), intent(in) :: mesh !! the foil's mesh
    real(wp), intent(in) :: of_all           !! where the mesh has none of its own [m]
    integer, intent(in) :: node              !! of the whole mesh
    integer :: station

    thickness = of_all
    if (allocated(mesh%column_thickness)) then
      station = (node - 1)/mesh%rows + 1
      associate (before => max(1, station - 1), behind => min(station, mesh%stations - 1))
        thickness = 0.5_wp*(mesh%column_thickness(before) + mesh%column_thickness(behind))
      end associate
    else if (allocated(mesh%row_thickness)) then
      thickness = mesh%row_thickness(min(modulo(node - 1, mesh%rows) + 1, mesh%rows - 1))
    end if
  end function node_thickness

  !> Which of the strips side by side a node belongs to; 1 where they do not differ.
  pure integer function strip_at(mesh, node) result(strip)
    type(quad_mesh_type), intent(in) :: mesh !! the foil's mesh
    integer, intent(in) :: node !! of the whole mesh

    strip = 1
    if (allocated(mesh%row_strip)) strip = mesh%row_strip(modulo(node - 1, mesh%rows) + 1)
  end function strip_at

  !> Which rows of elements are there, not cut away.
  pure function solid_rows(mesh) result(solid)
    type(quad_mesh_type), intent(in) :: mesh !! the foil's mesh
    logical :: solid(max(0, mesh%rows - 1))

    solid = .true.
    if (allocated(mesh%cut)) solid = .not. mesh%cut
  end function solid_rows

  !> Which rows of nodes have no element beside them.
  pure function loose_rows(mesh) result(loose)
    type(quad_mesh_type), intent(in) :: mesh !! the foil's mesh
    logical :: loose(mesh%rows)
    loose = .not. ([.false., solid_rows(mesh)] .or. [solid_rows(mesh), .false.])
  end function loose_rows

  !> Nodes of a set, none where they lie outside the stretch; stops the program where there is no
  !> such set.
  pure function node_set(mesh, name) result(nodes)
    type(quad_mesh_type), intent(in) :: mesh !! the foil's mesh
    character(len=*), intent(in) :: name !! of the set
    integer, allocatable :: nodes(:)
    integer :: i

    do i = 1, size(mesh%sets)
      if (mesh%sets(i)%name /= name) cycle
      nodes = mesh%sets(i)%nodes
      return
    end do
    error stop 'a mesh was asked for a node set it does not have'
  end function node_set

  !> Sets whose names begin so and end with a number.
  pure integer function set_count(mesh, beginning) result(sets)
    type(quad_mesh_type), intent(in) :: mesh !! the foil's mesh
    character(len=*), intent(in) :: beginning !! of the names that are counted
    integer :: i

    sets = 0
    do i = 1, size(mesh%sets)
      if (index(mesh%sets(i)%name, beginning) == 1) sets = sets + 1
    end do
  end function set_count

  !> Adds a set of nodes.
  pure subroutine add_node_set(mesh, name, nodes)
    type(quad_mesh_type), intent(inout) :: mesh !! the foil's mesh
    character(len=*), intent(in) :: name !! of the set
    integer, intent(in) :: nodes(:) !! that belong to it
    type(node_set_type), allocatable :: longer(:)
    integer :: sets

    sets = 0
    if (allocated(mesh%sets)) sets = size(mesh%sets)
    allocate (longer(sets + 1))
    if (sets > 0) longer(:sets) = mesh%sets
    longer(sets + 1)%name = name
    longer(sets + 1)%nodes = nodes
    call move_alloc(longer, mesh%sets)
  end subroutine add_node_set

  !> The mesh of a stretch alone, numbered from 1; what is not there is not there either. It has no
  !> sets.
  pure function sub_mesh(mesh, stretch) result(part)
    type(quad_mesh_type), intent(in) :: mesh !! the foil's mesh
    integer, intent(in) :: stretch(2) !! first and last station of the whole mesh
    type(quad_mesh_type) :: part
    integer :: before, first, last

    part%rows = mesh%rows
    part%stations = stretch(2) - stretch(1) + 1
    part%half = mesh%half
    part%ring_radius = mesh%ring_radius
    part%middle = mesh%middle
    if (allocated(mesh%row_axial)) part%row_axial = mesh%row_axial
    if (allocated(mesh%cut)) part%cut = mesh%cut
    if (allocated(mesh%row_thickness)) part%row_thickness = mesh%row_thickness
    if (allocated(mesh%row_strip)) part%row_strip = mesh%row_strip
    if (allocated(mesh%column_thickness)) then
      part%column_thickness = mesh%column_thickness(stretch(1):stretch(2) - 1)
    end if
    allocate (part%sets(0))
    before = (stretch(1) - 1)*mesh%rows
    first = max(before + 1, lbound(mesh%position, 2))
    last = max(first - 1, min(stretch(2)*mesh%rows, ubound(mesh%position, 2)))
    allocate (part%position(3, first - before:last - before))
    allocate (part%axis_1(3, first - before:last - before))
    allocate (part%axis_2(3, first - before:last - before))
    allocate (part%face(2, first - before:last - before))
    part%position(:, :) = mesh%position(:, first:last)
    part%axis_1(:, :) = mesh%axis_1(:, first:last)
    part%axis_2(:, :) = mesh%axis_2(:, first:last)
    part%face(:, :) = mesh%face(:, first:last)
    associate (elements => (stretch(1) - 1)*(mesh%rows - 1))
      first = max(elements + 1, lbound(mesh%element_nodes, 2))
      last = max(first - 1, min((stretch(2) - 1)*(mesh%rows - 1), ubound(mesh%element_nodes, 2)))
      allocate (part%element_nodes(4, first - elements:last - elements))
      allocate (part%director(3, 4, first - elements:last - elements))
    end associate
    part%element_nodes(:, :) = mesh%element_nodes(:, first:last) - before
    part%director(:, :, :) = mesh%director(:, :, first:last)
  end function sub_mesh
end module gfb_quad_mesh
