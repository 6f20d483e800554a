#include "gfb_petsc.h"
!> From a scene to its foils: meshes, supports, substructures, equations.
module gfb_foil_builder
  use petscsys
  use gfb_kinds, only: wp
  use gfb_errors, only: error_type
  use gfb_scene, only: scene_type
  use gfb_bearing_case, only: pad_length
  use gfb_top_foil_case, only: top_foil_leading
  use gfb_bump_foil_case, only: bump_foil_case_type, fixed_edge_trailing, fixed_edge_none, &
                                fixed_line_flat, fixed_line_half_flat
  use gfb_modes_case, only: part_half_arc, part_arc, part_flat, part_strip, part_top_foil
  use gfb_model_case, only: reduction_guyan
  use gfb_quad_mesh, only: quad_mesh_type, node_set, sub_mesh
  use gfb_foil_mesh, only: strip_shape_type, bump_strip_mesh, strip_substructures, top_foil_mesh, &
                           axial_rows, aligned_stations, crest_positions, begins_with_corner, &
                           begins_with_flat, begins_with_half_flat
  use gfb_substructures, only: substructure_type, substructure, find_kinds
  use gfb_shell_geometry, only: shell_section_type, node_unknowns
  use gfb_foil_structure, only: foil_structure_type, create_foil_structure
  implicit none (type)
  private
  public :: build_part, strip_shape, shape_on_pad, section_of, plate_section, plate_stations, &
            plate_fixed_edge, find_symmetry_supports

  integer, parameter, public :: axial = 3         !! component of a displacement
  integer, parameter, public :: about_tangent = 5 !! rotation about the second axis

  !> What the program decided about a foil.
  type, public :: foil_plan_type
    logical :: half = .false.    !! half the width is solved
    logical :: reduced = .false. !! substructures are condensed
    logical :: pinned = .false.  !! nothing but one node keeps a strip from gliding
    real(wp) :: memory = 0.0_wp  !! that the equations take, about; 0 where it is not known [B]
  end type foil_plan_type

contains

  !> The part of a scene's foils whose modes are asked for, as one full structure.
  !>
  !> Fails where an element is degenerate.
  subroutine build_part(scene, plan, part, error)
    type(scene_type), intent(in) :: scene
    type(foil_plan_type), intent(in) :: plan
    type(foil_structure_type), intent(out) :: part
    type(error_type), allocatable, intent(out) :: error

    type(quad_mesh_type) :: mesh
    type(substructure_type), allocatable :: pieces(:)
    type(strip_shape_type) :: shape
    type(shell_section_type) :: section
    logical, allocatable :: fixed(:, :)

    if (scene%modes%part == part_top_foil) then
      call plate(scene, plan, mesh, fixed)
      section = plate_section(scene)
      pieces = [whole(mesh)]
    else if (scene%modes%part == part_strip) then
      section = section_of(scene%bump_foil)
      shape = strip_shape(scene)
      mesh = bump_strip_mesh(shape, axial_rows(scene%bump_foil%width, scene%mesh%axial_elements, plan%half), &
                             plan%half)
      pieces = strip_substructures(shape, mesh)
      call find_symmetry_supports(mesh, fixed)
      if (scene%bump_foil%fixed_edge /= fixed_edge_none) fixed(:, node_set(mesh, 'fixed_edge')) = .true.
      call find_kinds(mesh, fixed, pieces)
    else
      section = section_of(scene%bump_foil)
      call piece_of_bump(scene, plan, mesh, fixed)
      pieces = [whole(mesh)]
    end if
    call create_foil_structure(mesh, section, fixed, pieces, .false., part, error)
  end subroutine build_part

  !> Half an arc, an arc or a flat with both end lines clamped.
  subroutine piece_of_bump(scene, plan, mesh, fixed)
    type(scene_type), intent(in) :: scene
    type(foil_plan_type), intent(in) :: plan
    type(quad_mesh_type), intent(out) :: mesh
    logical, allocatable, intent(out) :: fixed(:, :)

    type(strip_shape_type) :: shape
    type(quad_mesh_type) :: bump
    type(substructure_type), allocatable :: pieces(:)
    integer :: nodes

    shape = strip_shape(scene)
    shape%bump = shape%bump(:1)
    shape%begins = begins_with_corner
    shape%mirrored = .false.
    bump = bump_strip_mesh(shape, axial_rows(scene%bump_foil%width, scene%mesh%axial_elements, plan%half), plan%half)
    pieces = strip_substructures(shape, bump)
    select case (scene%modes%part)
    case (part_half_arc)
      mesh = sub_mesh(bump, pieces(1)%elements)
    case (part_arc)
      mesh = sub_mesh(bump, [pieces(1)%elements, pieces(2)%elements])
    case (part_flat)
      mesh = sub_mesh(bump, pieces(size(pieces))%elements)
    case default
      error stop 'not a part of a bump'
    end select
    call find_symmetry_supports(mesh, fixed)
    nodes = size(mesh%position, 2)
    fixed(:, :mesh%rows) = .true.
    fixed(:, nodes - mesh%rows + 1:) = .true.
  end subroutine piece_of_bump

  !> The top foil as a plate, clamped at its fixed edge.
  subroutine plate(scene, plan, mesh, fixed)
    type(scene_type), intent(in) :: scene
    type(foil_plan_type), intent(in) :: plan
    type(quad_mesh_type), intent(out) :: mesh
    logical, allocatable, intent(out) :: fixed(:, :)

    mesh = top_foil_mesh(plate_stations(scene), 0.0_wp, &
                         axial_rows(scene%bearing%length, scene%mesh%axial_elements, plan%half), plan%half)
    call find_symmetry_supports(mesh, fixed)
    fixed(:, node_set(mesh, plate_fixed_edge(scene))) = .true.
  end subroutine plate

  !> Name of the top foil's nodes that are clamped.
  pure function plate_fixed_edge(scene) result(name)
    type(scene_type), intent(in) :: scene
    character(len=:), allocatable :: name

    name = 'trailing_edge'
    if (scene%top_foil%fixed_edge == top_foil_leading) name = 'leading_edge'
  end function plate_fixed_edge

  !> Stations of the top foil, above the crests where the case asks for that.
  function plate_stations(scene) result(x)
    type(scene_type), intent(in) :: scene
    real(wp), allocatable :: x(:)
    real(wp) :: length
    integer :: i

    length = pad_length(scene%bearing)
    associate (elements => scene%mesh%circumferential_elements, pitch => scene%bump_foil%pitch)
      if (scene%mesh%align_crests) then
        x = aligned_stations(length, crest_positions(shape_on_pad(scene)), pitch, &
                             max(1, nint(elements*pitch/length)))
      else
        x = [(length*real(i, wp)/real(elements, wp), i=0, elements)]
      end if
    end associate
  end function plate_stations

  !> All of a mesh as one piece without retained nodes.
  pure function whole(mesh) result(piece)
    type(quad_mesh_type), intent(in) :: mesh
    type(substructure_type) :: piece
    logical :: none(size(mesh%position, 2))
    integer :: i

    none = .false.
    piece = substructure(mesh, [(i, i=1, size(mesh%element_nodes, 2))], none)
    piece%kind = 1
  end function whole

  !> Supports of the symmetry at z = 0: no axial displacement, no rotation about the tangent.
  pure subroutine find_symmetry_supports(mesh, fixed)
    type(quad_mesh_type), intent(in) :: mesh
    logical, allocatable, intent(out) :: fixed(:, :) !! (5, nodes), under the mesh's numbers
    integer :: node

    allocate (fixed(node_unknowns, lbound(mesh%position, 2):ubound(mesh%position, 2)), source=.false.)
    if (.not. mesh%half) return
    do node = lbound(fixed, 2), ubound(fixed, 2)
      if (abs(mesh%position(3, node)) <= 0.0_wp) fixed([axial, about_tangent], node) = .true.
    end do
  end subroutine find_symmetry_supports

  !> Shape of a bearing's strip, laid from its fixed edge.
  function shape_on_pad(scene) result(shape)
    type(scene_type), intent(in) :: scene
    type(strip_shape_type) :: shape

    shape = strip_shape(scene)
    if (shape%mirrored) shape%edge = pad_length(scene%bearing)
  end function shape_on_pad

  !> Shape of a scene's strip, its leading end at x = 0.
  function strip_shape(scene) result(shape)
    type(scene_type), intent(in) :: scene
    type(strip_shape_type) :: shape

    associate (foil => scene%bump_foil)
      allocate (shape%bump(foil%bumps))
      shape%bump%half_length = foil%half_length
      shape%bump%height = foil%height
      shape%bump%pitch = max(foil%pitch, 2.0_wp*foil%half_length)
      if (foil%fixed_line == fixed_line_flat) shape%begins = begins_with_flat
      if (foil%fixed_line == fixed_line_half_flat) shape%begins = begins_with_half_flat
      shape%mirrored = foil%fixed_edge == fixed_edge_trailing
      if (shape%mirrored) shape%edge = sum(shape%bump%pitch)
    end associate
    shape%arc_elements = scene%mesh%arc_elements
    shape%flat_elements = scene%mesh%flat_elements
  end function strip_shape

  !> What the bump foil is made of.
  pure function section_of(foil) result(section)
    type(bump_foil_case_type), intent(in) :: foil
    type(shell_section_type) :: section
    section = shell_section_type(foil%thickness, foil%youngs_modulus, foil%poissons_ratio, foil%density)
  end function section_of

  !> What the top foil is made of.
  pure function plate_section(scene) result(section)
    type(scene_type), intent(in) :: scene
    type(shell_section_type) :: section

    associate (foil => scene%top_foil)
      section = shell_section_type(foil%thickness, foil%youngs_modulus, foil%poissons_ratio, foil%density)
    end associate
  end function plate_section
end module gfb_foil_builder
