#include "gfb_petsc.h"
!> From a scene to the part of its foils whose modes are asked for.
module gfb_part_builder
  use petscsys
  use gfb_kinds, only: wp
  use gfb_errors, only: error_type
  use gfb_petsc_session, only: this_rank, rank_count
  use gfb_scene, only: scene_type
  use gfb_foil_cases, only: fixed_edge_none
  use gfb_study_cases, only: part_half_arc, part_arc, part_flat, part_strip, part_top_foil
  use gfb_film_mesh, only: axial_rows
  use gfb_quad_mesh, only: quad_mesh_type, node_set, sub_mesh
  use gfb_fixed_lines, only: fixed_line_corner
  use gfb_foil_mesh, only: strip_shape_type, bump_strip_mesh, strip_substructures, top_foil_mesh, dividing_stations
  use gfb_substructures, only: substructure_type
  use gfb_partition, only: chain_type, division_type, divide, no_chain
  use gfb_part_chains, only: strip_chain, column_chain, strip_kinds
  use gfb_mesh_dm, only: columns_window
  use gfb_shell_geometry, only: shell_section_type
  use gfb_foil_structure, only: foil_structure_type
  use gfb_foil_assembly, only: create_foil_structure
  use gfb_foil_builder, only: foil_plan_type, strip_shape, section_of, plate_section, plate_stations, plate_fixed_edge, &
                              find_symmetry_supports
  implicit none (type)
  private
  public :: build_part, foil_chain

contains

  !> The part of a scene's foils whose modes are asked for, as one full structure; each rank makes the mesh
  !> of its own columns.
  !>
  !> Fails where an element is degenerate, or when METIS does.
  subroutine build_part(scene, plan, part, error)
    type(scene_type), intent(in) :: scene !! what the case file asks for
    type(foil_plan_type), intent(in) :: plan !! what the program decided about the foil
    type(foil_structure_type), intent(out) :: part !! the structure that vibrates
    type(error_type), allocatable, intent(out) :: error !! error, if the foil cannot be cut or an element is degenerate

    type(division_type) :: division
    type(quad_mesh_type) :: mesh
    type(substructure_type), allocatable :: pieces(:)
    type(shell_section_type) :: section
    logical, allocatable :: fixed(:, :)
    real(wp), allocatable :: rows(:)

    rows = axial_rows(merge(scene%bearing%length, scene%bump_foil%width, scene%modes%part == part_top_foil), &
                      scene%mesh%axial_elements, plan%half, scene%mesh%edge_refinement)
    call divide(no_chain(), foil_chain(scene, size(rows), .false.), rank_count(), division, error)
    if (allocated(error)) return
    section = section_of(scene%bump_foil)
    allocate (pieces(0))
    select case (scene%modes%part)
    case (part_top_foil)
      section = plate_section(scene)
      call plate(scene, plan, rows, division%bumps, mesh, fixed)
    case (part_strip)
      call vibrating_strip(scene, plan, rows, division%bumps, mesh, fixed, pieces)
    case default
      call piece_of_bump(scene, plan, rows, division%bumps, mesh, fixed)
    end select
    call create_foil_structure(mesh, section, fixed, pieces, .false., part, error, division%bumps)
  end subroutine build_part

  !> What a foil without a film is cut into: a strip's pieces, or the columns of a part of the
  !> foils.
  function foil_chain(scene, rows, reduced) result(pieces)
    type(scene_type), intent(in) :: scene !! what the case file asks for
    integer, intent(in) :: rows    !! nodes of a station
    logical, intent(in) :: reduced !! substructures are condensed
    type(chain_type) :: pieces
    integer :: stretch(2), i

    if (.not. scene%general%analysis%finds_modes .or. scene%modes%part == part_strip) then
      pieces = strip_chain(strip_shape(scene), rows, reduced)
      return
    end if
    if (scene%modes%part == part_top_foil) then
      stretch = [1, size(plate_stations(scene))]
    else
      stretch = stretch_of_bump(scene)
    end if
    pieces = column_chain([(real(i, wp), i=stretch(1), stretch(2))], rows)
  end function foil_chain

  !> The strip, clamped at its fixed edge where it has one.
  !>
  !> A rank's mesh ends where the last super-element ends that begins in its columns: so every
  !> super-element is whole on one rank.
  subroutine vibrating_strip(scene, plan, rows, column_part, mesh, fixed, pieces)
    type(scene_type), intent(in) :: scene
    type(foil_plan_type), intent(in) :: plan
    real(wp), intent(in) :: rows(:)       !! z [m]
    integer, intent(in) :: column_part(:) !! rank, from 1, of every column of elements
    type(quad_mesh_type), intent(out) :: mesh
    logical, allocatable, intent(out) :: fixed(:, :)
    type(substructure_type), allocatable, intent(out) :: pieces(:)

    type(strip_shape_type) :: shape
    integer, allocatable :: divide_at(:)
    integer :: window(2), rank

    shape = strip_shape(scene)
    divide_at = dividing_stations(shape)
    rank = this_rank() + 1
    window = columns_window(column_part, rank)
    window(2) = maxval([window(2), pack(divide_at(2:), column_part(divide_at(:size(divide_at) - 1)) == rank)])
    mesh = bump_strip_mesh(shape, rows, plan%half, window)
    pieces = strip_substructures(shape, mesh)
    pieces%kind = strip_kinds(shape, rows, plan%half)
    call find_symmetry_supports(mesh, fixed)
    if (scene%bump_foil%fixed_edge /= fixed_edge_none) fixed(:, node_set(mesh, 'fixed_edge')) = .true.
  end subroutine vibrating_strip

  !> Half an arc, an arc or a flat with both end lines clamped.
  subroutine piece_of_bump(scene, plan, rows, column_part, mesh, fixed)
    type(scene_type), intent(in) :: scene
    type(foil_plan_type), intent(in) :: plan
    real(wp), intent(in) :: rows(:)       !! z [m]
    integer, intent(in) :: column_part(:) !! rank, from 1, of every column of elements
    type(quad_mesh_type), intent(out) :: mesh
    logical, allocatable, intent(out) :: fixed(:, :)
    integer :: stretch(2), window(2), node

    stretch = stretch_of_bump(scene)
    window = columns_window(column_part, this_rank() + 1)
    if (window(2) >= window(1)) window = window + stretch(1) - 1
    mesh = sub_mesh(bump_strip_mesh(single_bump(scene), rows, plan%half, window), stretch)
    call find_symmetry_supports(mesh, fixed)
    do node = lbound(fixed, 2), ubound(fixed, 2)
      if (node <= mesh%rows .or. node > mesh%nodes() - mesh%rows) fixed(:, node) = .true.
    end do
  end subroutine piece_of_bump

  !> First and last station of half an arc, an arc or a flat on the bump that it is part of.
  function stretch_of_bump(scene) result(stretch)
    type(scene_type), intent(in) :: scene
    integer :: stretch(2)
    integer, allocatable :: divide_at(:)

    divide_at = dividing_stations(single_bump(scene))
    select case (scene%modes%part)
    case (part_half_arc)
      stretch = divide_at(:2)
    case (part_arc)
      stretch = divide_at(1:3:2)
    case (part_flat)
      stretch = divide_at(size(divide_at) - 1:)
    case default
      error stop 'not a part of a bump'
    end select
  end function stretch_of_bump

  !> The first bump of a strip, alone: an arc, and its flat where there are flats.
  function single_bump(scene) result(shape)
    type(scene_type), intent(in) :: scene
    type(strip_shape_type) :: shape

    shape = strip_shape(scene)
    shape%bump = shape%bump(:1)
    shape%begins = fixed_line_corner
    shape%mirrored = .false.
  end function single_bump

  !> The top foil as a plate, clamped at its fixed edge.
  subroutine plate(scene, plan, rows, column_part, mesh, fixed)
    type(scene_type), intent(in) :: scene
    type(foil_plan_type), intent(in) :: plan
    real(wp), intent(in) :: rows(:)       !! z [m]
    integer, intent(in) :: column_part(:) !! rank, from 1, of every column of elements
    type(quad_mesh_type), intent(out) :: mesh
    logical, allocatable, intent(out) :: fixed(:, :)

    mesh = top_foil_mesh(plate_stations(scene), 0.0_wp, rows, plan%half, columns_window(column_part, this_rank() + 1))
    call find_symmetry_supports(mesh, fixed)
    fixed(:, node_set(mesh, plate_fixed_edge(scene))) = .true.
  end subroutine plate
end module gfb_part_builder
