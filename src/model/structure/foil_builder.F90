#include "gfb_petsc.h"
!> From a scene to its foils: meshes, supports, substructures, equations.
module gfb_foil_builder
  use petscsys
  use gfb_kinds, only: wp
  use gfb_errors, only: error_type
  use gfb_petsc_session, only: this_rank, rank_count
  use gfb_scene, only: scene_type
  use gfb_scene_case, only: analysis_modes
  use gfb_bearing_case, only: pad_length
  use gfb_top_foil_case, only: top_foil_leading
  use gfb_bump_foil_case, only: bump_foil_case_type, fixed_edge_trailing, fixed_edge_none, &
                                bump_pitches, bump_half_lengths, bump_heights, bump_thicknesses
  use gfb_modes_case, only: part_half_arc, part_arc, part_flat, part_strip, part_top_foil
  use gfb_film_mesh, only: film_mesh_type, axial_rows
  use gfb_quad_mesh, only: quad_mesh_type, node_set, sub_mesh, loose_rows
  use gfb_top_mesh, only: top_mesh
  use gfb_strip_rows, only: strip_rows, cut_rows
  use gfb_foil_mesh, only: strip_shape_type, bump_strip_mesh, strip_substructures, top_foil_mesh, &
                           aligned_stations, crest_positions, dividing_stations, &
                           fixed_line_corner
  use gfb_substructures, only: substructure_type
  use gfb_partition, only: chain_type, division_type, divide, no_chain
  use gfb_part_chains, only: strip_chain, column_chain, strip_kinds, strip_columns
  use gfb_mesh_dm, only: columns_window
  use gfb_shell_geometry, only: shell_section_type, node_unknowns
  use gfb_foil_structure, only: foil_structure_type
  use gfb_foil_assembly, only: create_foil_structure
  implicit none (type)
  private
  public :: build_part, build_top, build_bumps, foil_chain, strip_shape, shape_on_pad, section_of, plate_section, plate_stations, &
            find_symmetry_supports, strip_on_pad, cut_strip_mesh

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

    if (scene%general%analysis /= analysis_modes .or. scene%modes%part == part_strip) then
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

  !> Name of the top foil's nodes that are clamped.
  pure function plate_fixed_edge(scene) result(name)
    type(scene_type), intent(in) :: scene !! what the case file asks for
    character(len=:), allocatable :: name

    name = 'trailing_edge'
    if (scene%top_foil%fixed_edge == top_foil_leading) name = 'leading_edge'
  end function plate_fixed_edge

  !> Stations of the top foil, above the crests where the case asks for that.
  function plate_stations(scene) result(x)
    type(scene_type), intent(in) :: scene !! what the case file asks for
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

  !> Supports of the symmetry at z = 0: no axial displacement, no rotation about the tangent; of the
  !> opposite motions all others. A node in the middle of a cut is part of nothing and cannot move.
  pure subroutine find_symmetry_supports(mesh, fixed, opposite)
    type(quad_mesh_type), intent(in) :: mesh !! of a foil
    logical, allocatable, intent(out) :: fixed(:, :) !! (5, nodes), under the mesh's numbers
    logical, intent(in), optional :: opposite !! the other half moves against its mirror
    logical :: held(node_unknowns), loose(mesh%rows)
    integer :: node

    allocate (fixed(node_unknowns, lbound(mesh%position, 2):ubound(mesh%position, 2)), source=.false.)
    if (allocated(mesh%cut)) then
      loose = loose_rows(mesh)
      do node = lbound(fixed, 2), ubound(fixed, 2)
        fixed(:, node) = loose(modulo(node - 1, mesh%rows) + 1)
      end do
    end if
    if (.not. mesh%half) return
    held = .false.
    held([axial, about_tangent]) = .true.
    if (present(opposite)) held = held .neqv. opposite
    do node = lbound(fixed, 2), ubound(fixed, 2)
      if (abs(mesh%position(3, node)) <= 0.0_wp) fixed(:, node) = fixed(:, node) .or. held
    end do
  end subroutine find_symmetry_supports

  !> Shape of a bearing's strip, laid from its fixed edge.
  function shape_on_pad(scene) result(shape)
    type(scene_type), intent(in) :: scene !! what the case file asks for
    type(strip_shape_type) :: shape

    shape = strip_shape(scene)
    if (shape%mirrored) shape%edge = pad_length(scene%bearing)
  end function shape_on_pad

  !> Shape of a scene's strip, its leading end at x = 0; a pitch that falls short of the arc does so in round-off.
  function strip_shape(scene) result(shape)
    type(scene_type), intent(in) :: scene !! what the case file asks for
    type(strip_shape_type) :: shape

    associate (foil => scene%bump_foil)
      allocate (shape%bump(foil%bumps))
      shape%bump%half_length = bump_half_lengths(foil)
      shape%bump%height = bump_heights(foil)
      shape%bump%pitch = max(bump_pitches(foil), 2.0_wp*shape%bump%half_length)
      shape%begins = foil%fixed_line
      shape%mirrored = foil%fixed_edge == fixed_edge_trailing
      if (allocated(foil%bump_thickness)) shape%bump%thickness = bump_thicknesses(foil)
      if (shape%mirrored) shape%bump = shape%bump(foil%bumps:1:-1)
      if (shape%mirrored) shape%edge = sum(shape%bump%pitch)
    end associate
    shape%arc_elements = scene%mesh%arc_elements
    shape%flat_elements = scene%mesh%flat_elements
  end function strip_shape

  !> Mesh of a bearing's strip on the film's rows, or of strips side by side on rows of their own.
  function strip_on_pad(scene, film, window) result(mesh)
    type(scene_type), intent(in) :: scene !! what the case file asks for
    type(film_mesh_type), intent(in) :: film !! the film's mesh
    integer, intent(in) :: window(2) !! first and last station of the stretch
    type(quad_mesh_type) :: mesh

    if (scene%bump_foil%strips > 1) then
      mesh = cut_strip_mesh(scene, shape_on_pad(scene), scene%bearing%length, &
                            film%axial()*merge(2, 1, film%half), film%half, window)
    else
      mesh = bump_strip_mesh(shape_on_pad(scene), film%row_axial, film%half, window)
    end if
  end function strip_on_pad

  !> Mesh of strips side by side: one strip without what is cut away.
  function cut_strip_mesh(scene, shape, width, axial, half, window) result(mesh)
    type(scene_type), intent(in) :: scene !! what the case file asks for
    type(strip_shape_type), intent(in) :: shape !! of each of them
    real(wp), intent(in) :: width    !! of all, cuts included [m]
    integer, intent(in) :: axial     !! elements over the whole width, about
    logical, intent(in) :: half      !! half the width is meshed
    integer, intent(in) :: window(2) !! first and last station of the stretch
    type(quad_mesh_type) :: mesh

    associate (strips => scene%bump_foil%strips, cut => scene%bump_foil%cut_width)
      mesh = bump_strip_mesh(shape, strip_rows(width, axial, half, strips, cut), half, window)
      mesh%cut = cut_rows(mesh%row_axial, width, strips, cut)
    end associate
  end function cut_strip_mesh

  !> What the bump foil is made of.
  pure function section_of(foil) result(section)
    type(bump_foil_case_type), intent(in) :: foil !! thickness and material
    type(shell_section_type) :: section
    section = shell_section_type(foil%thickness, foil%youngs_modulus, foil%poissons_ratio, foil%density)
  end function section_of

  !> What the top foil is made of.
  pure function plate_section(scene) result(section)
    type(scene_type), intent(in) :: scene !! what the case file asks for
    type(shell_section_type) :: section

    associate (foil => scene%top_foil)
      section = shell_section_type(foil%thickness, foil%youngs_modulus, foil%poissons_ratio, foil%density)
    end associate
  end function plate_section
  !> The top foil on the film's nodes.
  !>
  !> Fails where an element is degenerate.
  subroutine build_top(scene, film, height, division, top, error)
    type(scene_type), intent(in) :: scene !! what the case file asks for
    type(film_mesh_type), intent(in) :: film !! the film's mesh
    real(wp), intent(in) :: height !! of the mid-surface above the flats' [m]
    type(division_type), intent(in) :: division !! of film and bumps
    type(foil_structure_type), intent(out) :: top !! with its equations
    type(error_type), allocatable, intent(out) :: error !! why it failed

    type(quad_mesh_type) :: mesh
    type(substructure_type) :: none(0)
    logical, allocatable :: fixed(:, :)

    mesh = top_mesh(film, height, columns_window(division%film, this_rank() + 1))
    call find_symmetry_supports(mesh, fixed, film%opposite)
    fixed(:, node_set(mesh, plate_fixed_edge(scene))) = .true.
    call create_foil_structure(mesh, plate_section(scene), fixed, none, .false., top, error, division%film)
  end subroutine build_top

  !> The bump strip on the sleeve, from its fixed edge.
  !>
  !> Fails where an element is degenerate.
  subroutine build_bumps(scene, film, division, reduced, bumps, error)
    type(scene_type), intent(in) :: scene !! what the case file asks for
    type(film_mesh_type), intent(in) :: film !! the film's mesh
    type(division_type), intent(in) :: division !! of film and bumps
    logical, intent(in) :: reduced !! super-elements are condensed
    type(foil_structure_type), intent(out) :: bumps !! with its equations
    type(error_type), allocatable, intent(out) :: error !! why it failed

    type(quad_mesh_type) :: mesh
    type(strip_shape_type) :: shape
    type(substructure_type), allocatable :: piece(:)
    integer, allocatable :: column_part(:)
    logical, allocatable :: fixed(:, :)

    shape = shape_on_pad(scene)
    column_part = strip_columns(shape, reduced, division%bumps)
    mesh = strip_on_pad(scene, film, columns_window(column_part, this_rank() + 1))
    piece = strip_substructures(shape, mesh)
    piece%kind = strip_kinds(shape, mesh%row_axial, film%half)
    call find_symmetry_supports(mesh, fixed, film%opposite)
    fixed(:, node_set(mesh, 'fixed_edge')) = .true.
    call create_foil_structure(mesh, section_of(scene%bump_foil), fixed, piece, reduced, bumps, error, column_part)
  end subroutine build_bumps
end module gfb_foil_builder
