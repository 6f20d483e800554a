#include "gfb_petsc.h"
!> From a scene to its foils: meshes, supports, substructures, equations.
module gfb_foil_builder
  use petscsys
  use gfb_kinds, only: wp
  use gfb_errors, only: error_type
  use gfb_petsc_session, only: this_rank
  use gfb_scene, only: scene_type
  use gfb_bearing_case, only: bearing_case_type, pad_length, pad_angle, pad_rows, strip_ends, middle_radius
  use gfb_top_foil_case, only: top_foil_leading
  use gfb_foil_cases, only: bump_foil_case_type, fixed_edge_trailing, one_strip, strips_differ, &
                            strip_curved, strip_straight
  use gfb_film_mesh, only: film_mesh_type
  use gfb_quad_mesh, only: quad_mesh_type, node_set, loose_rows
  use gfb_foil_mesh, only: top_mesh, strip_shape_type, bump_strip_mesh, strip_substructures, crest_positions, strip_rows, &
                           cut_rows, strips_of_rows, put_strip, join_kinds
  use gfb_aligned_mesh, only: aligned_stations, elements_at_ends
  use gfb_substructures, only: substructure_type
  use gfb_partition, only: division_type
  use gfb_part_chains, only: strip_kinds, strip_columns
  use gfb_mesh_dm, only: columns_window
  use gfb_shell_geometry, only: shell_section_type, node_unknowns
  use gfb_foil_structure, only: foil_structure_type
  use gfb_foil_assembly, only: create_foil_structure
  implicit none (type)
  private
  public :: build_top, build_bumps, strip_shape, shape_on_pad, sector_sides, stations_follow_crests, section_of, plate_section, &
            plate_stations, keep_elements, gaps_beside, find_symmetry_supports, strip_on_pad, cut_strip_mesh, kinds_of_pieces, plate_fixed_edge, &
            middle_of_straight

  integer, parameter :: tangential = 1            !! component of a displacement
  integer, parameter, public :: axial = 3         !! another
  integer, parameter, public :: about_tangent = 5 !! rotation about the second axis

  !> What the program decided about a foil.
  type, public :: foil_plan_type
    logical :: half = .false.    !! half the width is solved
    logical :: reduced = .false. !! substructures are condensed
    logical :: pinned = .false.  !! nothing but one node keeps a strip from gliding
    real(wp) :: memory = 0.0_wp  !! that the equations take, about; 0 where it is not known [B]
  end type foil_plan_type

contains

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
    if (scene%mesh%align_crests) then
      x = aligned_stations(length, crest_positions(shape_on_pad(scene)), scene%bump_foil%pitch%value, elements_a_pitch(scene), &
                           scene%mesh%elements_at_ends)
    else
      associate (elements => scene%mesh%circumferential_elements)
        x = [(length*real(i, wp)/real(elements, wp), i=0, elements)]
      end associate
    end if
  end function plate_stations

  !> Where sides of elements lie over the bumps of a sector, from its leading edge: at crests, where those of all strips are on the
  !> same rays [rad].
  function sector_sides(scene) result(angle)
    type(scene_type), intent(in) :: scene !! what the case file asks for
    real(wp), allocatable :: angle(:)

    allocate (angle(0))
    if (scene%mesh%align_crests .and. scene%bump_foil%strip_form == strip_curved) then
      angle = crest_positions(shape_on_pad(scene))/scene%bearing%radius
    end if
  end function sector_sides

  !> Whether the stations are those of `plate_stations`, counted from crest to crest; of a sector they are moved to the crests.
  pure logical function stations_follow_crests(scene) result(follow)
    type(scene_type), intent(in) :: scene !! what the case file asks for
    follow = scene%mesh%align_crests .and. .not. scene%bearing%row%has_sectors
  end function stations_follow_crests

  !> Elements from crest to crest where stations lie above the crests.
  elemental integer function elements_a_pitch(scene) result(elements)
    type(scene_type), intent(in) :: scene !! what the case file asks for
    elements = max(1, nint(scene%mesh%circumferential_elements*scene%bump_foil%pitch%value/pad_length(scene%bearing)))
  end function elements_a_pitch

  !> What the crest gaps of a pad whose heights are random are more than those of the first one [m].
  pure function gaps_beside(foil, pad) result(change)
    type(bump_foil_case_type), intent(in) :: foil !! what `&bump_foil` asks for
    integer, intent(in) :: pad !! its number
    real(wp) :: change(foil%bumps, foil%strips)

    associate (gap => foil%random%further_gap)
      change = gap(:, (pad - 1)*foil%strips + 1:pad*foil%strips) - gap(:, :foil%strips)
    end associate
  end function gaps_beside

  !> A scene that differs in a number gets meshes with as many elements as another scene's.
  subroutine keep_elements(scene, there)
    type(scene_type), intent(in) :: scene    !! the other one
    type(scene_type), intent(inout) :: there !! that differs from it

    there%mesh%circumferential_elements = scene%mesh%circumferential_elements
    if (.not. (stations_follow_crests(scene) .and. scene%bump_foil%bumps > 0)) return
    there%mesh%elements_at_ends = elements_at_ends(pad_length(scene%bearing), crest_positions(shape_on_pad(scene)), &
                                                   scene%bump_foil%pitch%value, elements_a_pitch(scene))
  end subroutine keep_elements

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

  !> Shape of a bearing's strip, laid from its fixed edge; of strips that differ their mean.
  function shape_on_pad(scene) result(shape)
    type(scene_type), intent(in) :: scene !! what the case file asks for
    type(strip_shape_type) :: shape

    shape = strip_shape(scene)
    if (scene%bearing%row%has_sectors) then
      call lay_on_sector(scene%bearing, scene%bump_foil, middle_radius(scene%bearing), shape)
      return
    end if
    shape%edge = scene%bump_foil%offset%value
    if (shape%mirrored) shape%edge = pad_length(scene%bearing) - scene%bump_foil%offset%value
  end function shape_on_pad

  !> Lays a strip on a sector, from the end of its ramp on.
  pure subroutine lay_on_sector(bearing, foil, radius, shape)
    type(bearing_case_type), intent(in) :: bearing
    type(bump_foil_case_type), intent(in) :: foil !! its offset
    real(wp), intent(in) :: radius !! at which its bumps have their sizes [m]
    type(strip_shape_type), intent(inout) :: shape !! of the strip alone
    real(wp) :: before !! its fixed edge, there [m]

    before = foil%offset%value
    if (shape%mirrored) before = before + sum(shape%bump%pitch)
    if (foil%strip_form == strip_straight) then
      ! Tangential at its mean radius, where an angle from the pad's middle is as long as on the circle.
      shape%middle = middle_of_straight(bearing, foil)
      shape%edge = shape%middle + radius*(bearing%ramp_part - 0.5_wp)*pad_angle(bearing) + before
      return
    end if
    shape%ring_radius = bearing%radius
    shape%mean_radius = radius
    shape%edge = shape%ring_radius*(bearing%ramp_part*pad_angle(bearing) + before/radius)
  end subroutine lay_on_sector

  !> x of the ray in the middle of a sector over straight strips, its leading edge at about x = 0; 0 where there are none [m].
  pure real(wp) function middle_of_straight(bearing, foil) result(middle)
    type(bearing_case_type), intent(in) :: bearing
    type(bump_foil_case_type), intent(in) :: foil

    middle = 0.0_wp
    if (foil%strip_form == strip_straight) middle = 0.5_wp*middle_radius(bearing)*pad_angle(bearing)
  end function middle_of_straight

  !> Whether strips side by side have meshes of their own: under a sector each repeats at its own mean radius.
  pure logical function strips_are_own(scene) result(own)
    type(scene_type), intent(in) :: scene
    own = strips_differ(scene%bump_foil) .or. (scene%bearing%row%has_sectors .and. scene%bump_foil%strips > 1)
  end function strips_are_own

  !> Shape of a scene's strip, its leading end at x = 0; of strips that differ their mean.
  function strip_shape(scene) result(shape)
    type(scene_type), intent(in) :: scene !! what the case file asks for
    type(strip_shape_type) :: shape
    shape = shape_of(scene, scene%bump_foil)
  end function strip_shape

  !> Shape of one of the strips side by side, laid beside their mean.
  function shape_beside(scene, mean, strip) result(shape)
    type(scene_type), intent(in) :: scene
    type(strip_shape_type), intent(in) :: mean
    integer, intent(in) :: strip !! from the smallest z on
    type(strip_shape_type) :: shape
    type(bump_foil_case_type) :: one
    real(wp) :: ends(2) !! of the strip along the radius [m]

    one = one_strip(scene%bump_foil, strip)
    shape = shape_of(scene, one)
    if (scene%bearing%row%has_sectors) then
      ends = strip_ends(scene%bearing, scene%bump_foil%strips, scene%bump_foil%cut_width, strip)
      call lay_on_sector(scene%bearing, one, 0.5_wp*sum(ends), shape)
      return
    end if
    shape%edge = mean%edge + (one%offset%value - scene%bump_foil%offset%value)* &
                 merge(-1.0_wp, 1.0_wp, mean%mirrored)
  end function shape_beside

  !> Shape of a strip; a pitch that falls short of the arc does so in round-off.
  function shape_of(scene, foil) result(shape)
    type(scene_type), intent(in) :: scene
    type(bump_foil_case_type), intent(in) :: foil
    type(strip_shape_type) :: shape

    allocate (shape%bump(foil%bumps))
    shape%bump%half_length = foil%half_length%each(foil%bumps)
    shape%bump%height = foil%height%each(foil%bumps)
    shape%bump%pitch = max(foil%pitch%each(foil%bumps), 2.0_wp*shape%bump%half_length)
    shape%begins = foil%fixed_line
    shape%mirrored = foil%fixed_edge == fixed_edge_trailing
    if (allocated(foil%thickness%by_bump)) shape%bump%thickness = foil%thickness%each(foil%bumps)
    if (shape%mirrored) shape%bump = shape%bump(foil%bumps:1:-1)
    if (shape%mirrored) shape%edge = sum(shape%bump%pitch)
    shape%arc_elements = scene%mesh%arc_elements
    shape%flat_elements = scene%mesh%flat_elements
  end function shape_of

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
    real(wp), allocatable :: rows(:) ! from the middle of the width
    integer :: strip

    associate (foil => scene%bump_foil, strips => scene%bump_foil%strips, &
               cut => scene%bump_foil%cut_width)
      rows = strip_rows(width, axial, half, strips, cut)
      mesh = bump_strip_mesh(shape, middle_row(scene) + rows, half, window)
      mesh%cut = cut_rows(rows, width, strips, cut)
      if (.not. (strips_are_own(scene) .or. allocated(foil%random%further_gap))) return
      mesh%row_strip = strips_of_rows(rows, width, strips, cut)
      if (.not. strips_are_own(scene)) return
      do strip = minval(mesh%row_strip), strips
        call put_strip(mesh, bump_strip_mesh(shape_beside(scene, shape, strip), mesh%row_axial, &
                                             half, window), strip)
      end do
      if (.not. allocated(foil%thickness%by_strip)) return
      mesh%row_thickness = foil%thickness%by_strip(mesh%row_strip(:mesh%rows - 1))
    end associate
  end function cut_strip_mesh

  !> Where the middle of the width is: z = 0, or the mean radius of a sector [m].
  pure real(wp) function middle_row(scene)
    type(scene_type), intent(in) :: scene
    middle_row = 0.5_wp*sum(pad_rows(scene%bearing))
  end function middle_row

  !> Kinds of a bump foil's pieces: equal ones are equal on every strip.
  function kinds_of_pieces(scene, shape, rows, half) result(kind)
    type(scene_type), intent(in) :: scene !! what the case file asks for
    type(strip_shape_type), intent(in) :: shape !! of the strip, or the mean of strips that differ
    real(wp), intent(in) :: rows(:) !! z [m]
    logical, intent(in) :: half     !! rows begin at z = 0
    integer, allocatable :: kind(:)
    integer :: strip

    kind = strip_kinds(shape, rows, half)
    if (.not. strips_differ(scene%bump_foil)) return
    kind = 1
    do strip = 1, scene%bump_foil%strips
      call join_kinds(kind, strip_kinds(shape_beside(scene, shape, strip), rows, half))
    end do
  end function kinds_of_pieces

  !> What the bump foil is made of.
  pure function section_of(foil) result(section)
    type(bump_foil_case_type), intent(in) :: foil !! thickness and material
    type(shell_section_type) :: section
    section = shell_section_type(foil%thickness%value, foil%youngs_modulus, foil%poissons_ratio, foil%density)
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
  subroutine build_top(scene, film, height, division, top, error, bends_only)
    type(scene_type), intent(in) :: scene !! what the case file asks for
    type(film_mesh_type), intent(in) :: film !! the film's mesh
    real(wp), intent(in) :: height !! of the mid-surface above the flats' [m]
    type(division_type), intent(in) :: division !! of film and bumps
    type(foil_structure_type), intent(out) :: top !! with its equations
    type(error_type), allocatable, intent(out) :: error !! why it failed
    logical, intent(in), optional :: bends_only !! nothing moves it along its surface; default: it may

    type(quad_mesh_type) :: mesh
    type(substructure_type) :: none(0)
    logical, allocatable :: fixed(:, :)

    mesh = top_mesh(film, height, columns_window(division%film, this_rank() + 1), &
                    middle_of_straight(scene%bearing, scene%bump_foil))
    call find_symmetry_supports(mesh, fixed, film%opposite)
    fixed(:, node_set(mesh, plate_fixed_edge(scene))) = .true.
    if (present(bends_only)) fixed([tangential, axial], :) = fixed([tangential, axial], :) .or. bends_only
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
    piece%kind = kinds_of_pieces(scene, shape, mesh%row_axial, film%half)
    call find_symmetry_supports(mesh, fixed, film%opposite)
    fixed(:, node_set(mesh, 'fixed_edge')) = .true.
    call create_foil_structure(mesh, section_of(scene%bump_foil), fixed, piece, reduced, bumps, error, column_part)
  end subroutine build_bumps
end module gfb_foil_builder
