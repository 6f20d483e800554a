!> A foil as a meshed surface: what of it this rank has, and how it moved. Equations stand elsewhere.
module gfb_foil_surface
  use gfb_kinds, only: wp
  use gfb_mesh_dm, only: local_mesh_type
  use gfb_quad_mesh, only: quad_mesh_type
  use gfb_shell_geometry, only: shell_section_type
  implicit none (type, external)
  private
  public :: named_surface

  !> A mid-surface and this rank's part of it; nodes and elements keep their numbers in the whole mesh.
  type, public :: foil_surface_type
    character(len=:), allocatable :: name    !! of its file: top_foil, bump_foil
    logical :: lies_on_film = .false.        !! its nodes are those of the film's mesh
    logical :: has_contacts = .false.        !! slaves of the contacts are nodes of this surface
    type(quad_mesh_type) :: mesh             !! the stretch that holds this rank's columns, or more
    type(shell_section_type) :: section
    type(local_mesh_type) :: part            !! this rank's elements and nodes
    integer, allocatable :: my_elements(:)   !! elements of this rank, numbers in the whole mesh
    integer, allocatable :: local_node(:)    !! this rank's number of a node, 0 where it is elsewhere
  contains
    procedure :: owns
  end type foil_surface_type

  !> What there is at a surface's nodes: displacements, or forces.
  type, public :: nodal_values_type
    real(wp), allocatable :: value(:, :) !! (5, local nodes) [m], [rad], or [N], [N m]
  end type nodal_values_type

  !> How a surface moved, and what that does to it.
  type, public :: surface_motion_type
    real(wp), allocatable :: displacement(:, :) !! (5, local nodes) [m], [rad]
    real(wp), allocatable :: stress(:, :)       !! (8, elements of this rank), see `gfb_foil_stress` [Pa]
  end type surface_motion_type

contains

  !> Number of the surface of a name, which is also that of its group in a case file; 0: there is none.
  pure integer function named_surface(surface, name) result(number)
    type(foil_surface_type), intent(in) :: surface(:) !! of a foil
    character(len=*), intent(in) :: name

    do number = size(surface), 1, -1
      if (surface(number)%name == name) exit
    end do
  end function named_surface

  !> Whether this rank owns a node.
  pure logical function owns(self, node) result(mine)
    class(foil_surface_type), intent(in) :: self !! the surface
    integer, intent(in) :: node !! of the whole mesh

    mine = .false.
    if (node < lbound(self%local_node, 1) .or. node > ubound(self%local_node, 1)) return
    if (self%local_node(node) > 0) mine = self%part%owned(self%local_node(node))
  end function owns
end module gfb_foil_surface
