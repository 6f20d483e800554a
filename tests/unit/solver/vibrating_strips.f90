!> Strips for the tests of modes.
module vibrating_strips
  use gfb_kinds, only: wp
  use gfb_quad_mesh, only: quad_mesh_type, node_set, sub_mesh
  use gfb_film_mesh, only: axial_rows
  use gfb_fixed_lines, only: fixed_line_corner
  use gfb_foil_mesh, only: strip_shape_type, bump_type, bump_strip_mesh, strip_substructures
  use gfb_substructures, only: substructure_type, substructure, find_kinds
  use gfb_shell_geometry, only: shell_section_type
  implicit none (type, external)
  private
  public :: make_strip, make_part

  ! [Gu2020] table 1, case 1.
  real(wp), parameter, public :: half_length = 1.778e-3_wp, height = 0.508e-3_wp, &
    pitch = 4.572e-3_wp
  real(wp), parameter, public :: width = 38.1e-3_wp
  type(shell_section_type), parameter, public :: &
    section = shell_section_type(0.102e-3_wp, 214.0e9_wp, 0.29_wp, 8440.0_wp)

  integer, parameter, public :: held = 1 !! corners in v, the fixed edge clamped
  integer, parameter, public :: free = 2 !! nothing

  integer, parameter, public :: half_arc = 1, arc = 2, flat = 3

contains

  !> Mesh, supports and pieces of a strip of equal bumps.
  subroutine make_strip(bumps, elements, support, mesh, fixed, pieces)
    integer, intent(in) :: bumps
    integer, intent(in) :: elements(3)    !! of an arc, of a flat, along the axis
    integer, intent(in) :: support        !! `held`, `free`
    type(quad_mesh_type), intent(out) :: mesh
    logical, allocatable, intent(out) :: fixed(:, :)
    type(substructure_type), allocatable, intent(out) :: pieces(:)
    type(strip_shape_type) :: shape
    integer :: i

    shape%bump = [(bump_type(half_length, height, pitch), i=1, bumps)]
    shape%begins = fixed_line_corner
    shape%arc_elements = elements(1)
    shape%flat_elements = elements(2)
    mesh = bump_strip_mesh(shape, axial_rows(width, elements(3), .false., 1.0_wp), .false.)
    pieces = strip_substructures(shape, mesh)
    allocate (fixed(5, size(mesh%position, 2)), source=.false.)
    if (support == held) then
      fixed(2, node_set(mesh, 'corners')) = .true.
      fixed(:, node_set(mesh, 'fixed_edge')) = .true.
    end if
    call find_kinds(mesh, fixed, pieces)
  end subroutine make_strip

  !> A part of a bump with both end lines clamped, as one piece that keeps no node.
  subroutine make_part(part, elements, mesh, fixed, pieces)
    integer, intent(in) :: part           !! `half_arc`, `arc`, `flat`
    integer, intent(in) :: elements(3)    !! of an arc, of a flat, along the axis
    type(quad_mesh_type), intent(out) :: mesh
    logical, allocatable, intent(out) :: fixed(:, :)
    type(substructure_type), allocatable, intent(out) :: pieces(:)
    type(quad_mesh_type) :: bump
    logical, allocatable :: none(:)
    integer :: i

    call make_strip(1, elements, free, bump, fixed, pieces)
    select case (part)
    case (half_arc)
      mesh = sub_mesh(bump, pieces(:2)%column)
    case (arc)
      mesh = sub_mesh(bump, pieces(1:3:2)%column)
    case default
      mesh = sub_mesh(bump, [pieces(3)%column, bump%stations])
    end select
    deallocate (fixed, pieces)
    allocate (fixed(5, size(mesh%position, 2)), none(size(mesh%position, 2)), source=.false.)
    fixed(:, :mesh%rows) = .true.
    fixed(:, size(fixed, 2) - mesh%rows + 1:) = .true.
    pieces = [substructure(mesh, [(i, i=1, size(mesh%element_nodes, 2))], none)]
    pieces%kind = 1
  end subroutine make_part
end module vibrating_strips
