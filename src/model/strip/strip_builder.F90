#include "gfb_petsc.h"
!> From a scene to the equations of its bump strip: mesh, supports, contacts, loads.
module gfb_strip_builder
  use petscvec
  use gfb_kinds, only: wp
  use gfb_errors, only: error_type
  use gfb_text, only: text
  use gfb_petsc_kinds, only: pint
  use gfb_petsc_session, only: this_rank, rank_count
  use gfb_scene, only: scene_type
  use gfb_foil_cases, only: fixed_edge_none, gap_of_crest, gap_of_corner, solid_width
  use gfb_strip_load_case, only: crest_forces, typical_deflection, bump_stiffness, load_plates, &
                                 support_held
  use gfb_contact_laws, only: set_contact_laws
  use gfb_bump_contacts, only: bump_contact, touch_with_face, crest_name, corner_name, line_shares, &
                               line_length, contact_sleeve, contact_top
  use gfb_contact_point, only: contact_point_type
  use gfb_quad_mesh, only: quad_mesh_type, node_set, set_count, solid_rows, loose_rows, strip_at
  use gfb_partition, only: division_type, divide, no_chain
  use gfb_part_chains, only: strip_chain, strip_columns
  use gfb_mesh_dm, only: columns_window
  use gfb_foil_mesh, only: strip_shape_type, bump_strip_mesh, strip_substructures
  use gfb_film_mesh, only: axial_rows
  use gfb_substructures, only: substructure_type
  use gfb_foil_structure, only: foil_structure_type
  use gfb_foil_assembly, only: create_foil_structure
  use gfb_foil_builder, only: foil_plan_type, strip_shape, section_of, find_symmetry_supports, cut_strip_mesh, &
                              kinds_of_pieces
  use gfb_strip_system, only: strip_system_type, create_strip_system, plate_none, plate_forced, &
                              plate_moved
  implicit none (type)
  private
  public :: build_strip

  integer, parameter :: tangential = 1, radial = 2, axial = 3 !! components of a displacement

  !> Artificial stiffness of slaves, in the matrix alone, over a bump's: a free strip that slides everywhere
  !> at its friction limit leaves it regular.
  real(wp), parameter :: tangential_share = 1.0e-5_wp

contains

  !> The strip of a scene, unloaded.
  !>
  !> Fails where an element is degenerate.
  subroutine build_strip(scene, plan, strip, error)
    type(scene_type), intent(in) :: scene !! what the case file asks for
    type(foil_plan_type), intent(in) :: plan !! what the program decided about the foil
    type(strip_system_type), intent(out) :: strip !! unloaded
    type(error_type), allocatable, intent(out) :: error !! error, if an element is degenerate

    call build_structure(scene, plan, strip%foil, error)
    if (allocated(error)) return
    associate (foil => scene%bump_foil, load => scene%strip_load)
      if (load%kind == load_plates) then
        strip%plate = plate_moved
        if (load%maximum_force > 0.0_wp) strip%plate = plate_forced
        strip%plate_displacement = load%maximum_displacement
      end if
      strip%scale%length = typical_deflection(load, foil)
      strip%scale%angle = strip%scale%length/foil%half_length%value
      strip%scale%force = strip%scale%length*bump_stiffness(foil)*foil%pitch%value*solid_width(foil)/ &
                          scene%mesh%axial_elements
      call set_contact_laws(scene%contact, scene%bump_foil, strip%scale%length, strip%contacts)
      if (foil%fixed_edge == fixed_edge_none) then
        strip%contacts%artificial_tangential = tangential_share*bump_stiffness(foil)*foil%pitch%value
      end if
      call add_contacts(scene, strip)
      call create_strip_system(strip)
      call add_loads(scene, plan, strip)
    end associate
  end subroutine build_strip

  !> Mesh and supports.
  !>
  !> Without friction nothing keeps a strip that is fixed nowhere from gliding: one node does then,
  !> which no load asks for.
  subroutine build_structure(scene, plan, structure, error)
    type(scene_type), intent(in) :: scene
    type(foil_plan_type), intent(in) :: plan
    type(foil_structure_type), intent(out) :: structure
    type(error_type), allocatable, intent(out) :: error

    type(quad_mesh_type) :: mesh
    type(substructure_type), allocatable :: pieces(:)
    type(strip_shape_type) :: shape
    type(division_type) :: division
    logical, allocatable :: fixed(:, :)
    integer, allocatable :: line(:), column_part(:)
    real(wp), allocatable :: rows(:)

    shape = strip_shape(scene)
    associate (foil => scene%bump_foil)
      rows = axial_rows(foil%width, scene%mesh%axial_elements, plan%half, scene%mesh%edge_refinement)
      call divide(no_chain(), strip_chain(shape, size(rows), plan%reduced), rank_count(), division, error)
      if (allocated(error)) return
      column_part = strip_columns(shape, plan%reduced, division%bumps)
      if (foil%strips > 1) then
        mesh = cut_strip_mesh(scene, shape, foil%width, scene%mesh%axial_elements, plan%half, &
                              columns_window(column_part, this_rank() + 1))
      else
        mesh = bump_strip_mesh(shape, rows, plan%half, columns_window(column_part, this_rank() + 1))
      end if
      pieces = strip_substructures(shape, mesh)
      pieces%kind = kinds_of_pieces(scene, shape, mesh%row_axial, plan%half)
      call find_symmetry_supports(mesh, fixed)
      if (scene%strip_load%support == support_held) fixed(radial, node_set(mesh, 'corners')) = .true.
      line = node_set(mesh, 'fixed_edge')
      if (foil%fixed_edge /= fixed_edge_none) then
        fixed(:, line) = .true.
      else if (plan%pinned .and. size(line) > 0) then
        call pin_strips(solid_rows(mesh), line, plan%half, fixed)
      end if
      call create_foil_structure(mesh, section_of(foil), fixed, pieces, plan%reduced, structure, error, column_part)
    end associate
  end subroutine build_structure

  !> Holds a node of each strip, and the other end of its line along the motion.
  pure subroutine pin_strips(solid, line, half, fixed)
    logical, intent(in) :: solid(:)  !! rows of elements that are not cut away
    integer, intent(in) :: line(:)   !! nodes across all strips
    logical, intent(in) :: half      !! the first row is that of symmetry
    logical, allocatable, intent(inout) :: fixed(:, :)
    logical :: there(size(line) + 1) !! elements before and behind the rows
    integer :: row, first

    there = [.false., solid, .false.]
    first = 1
    do row = 1, size(line)
      if (there(row + 1) .and. .not. there(row)) then
        fixed([tangential, axial], line(row)) = .true.
        first = row
      else if (there(row) .and. .not. there(row + 1) .and. .not. (half .and. first == 1)) then
        fixed(tangential, line(row)) = .true.
      end if
    end do
  end subroutine pin_strips

  !> Contacts of this rank's corner and crest nodes.
  subroutine add_contacts(scene, strip)
    type(scene_type), intent(in) :: scene
    type(strip_system_type), intent(inout) :: strip

    real(wp), allocatable :: force(:)
    real(wp), allocatable :: gap(:, :) !! (rows, bumps) [m]
    integer :: i, row
    logical :: pressed

    strip%contacts%rows = strip%foil%mesh%rows
    allocate (strip%contacts%point(0), strip%contacts%global(0), strip%crest_press(0), strip%crest_gap(0))
    associate (mesh => strip%foil%mesh)
      if (scene%strip_load%support /= support_held) then
        do i = 1, set_count(mesh, corner_name)
          call add_line(strip, node_set(mesh, corner_name//text(i)), contact_sleeve, i, .false., 0.0_wp, &
                        spread(gap_of_corner(scene%bump_foil, i), 1, mesh%rows))
        end do
      end if
      pressed = strip%plate == plate_none
      if (pressed .and. .not. scene%contact%friction_top > 0.0_wp) return
      force = crest_forces(scene%strip_load, scene%bump_foil)
      allocate (gap(mesh%rows, size(force)), source=0.0_wp)
      do i = 1, size(force)
        if (pressed) exit ! the force acts wherever the crest is
        gap(:, i) = [(gap_of_crest(scene%bump_foil, i, strip_at(mesh, row)), row=1, mesh%rows)]
      end do
      if (strip%plate == plate_forced) then
        strip%free_travel = minval(gap, spread(.not. loose_rows(mesh), 2, size(force)))
      end if
      do i = 1, size(force)
        call add_line(strip, node_set(mesh, crest_name(i)), contact_top, i, pressed, &
                      force(i)/solid_width(scene%bump_foil), gap(:, i) - strip%free_travel)
      end do
    end associate
  end subroutine add_contacts

  !> Contacts of a line's nodes; those that are fixed everywhere touch nothing.
  subroutine add_line(strip, line, law, number, pressed, pressing, gap)
    type(strip_system_type), intent(inout) :: strip
    integer, intent(in) :: line(:)     !! nodes in order of z
    integer, intent(in) :: law         !! `contact_sleeve` or `contact_top`
    integer, intent(in) :: number      !! of the line
    logical, intent(in) :: pressed     !! the normal force is given
    real(wp), intent(in) :: pressing   !! it, per length, at the full load [N/m]
    real(wp), intent(in) :: gap(:)     !! of the line's nodes at rest [m]

    type(contact_point_type), allocatable :: point(:)
    type(contact_point_type) :: one
    integer, allocatable :: global(:)
    real(wp), allocatable :: length(:)
    integer :: i, k, found, plate, unknown(size(strip%foil%slot, 1))

    if (size(line) == 0) return
    length = line_shares(strip%foil%mesh, line)*line_length(strip%foil%mesh, line)
    allocate (point(size(line)))
    allocate (global(0))
    plate = 0
    found = 0
    do i = 1, size(line)
      if (.not. strip%foil%owns(line(i))) cycle
      if (.not. any(strip%foil%free(:axial, line(i)))) cycle
      one = bump_contact(law, line(i), number, length(i))
      one%pressed = pressed
      one%gap = gap(i)
      unknown = 0
      do k = 1, merge(size(unknown), axial, strip%contacts%at_faces)
        if (strip%foil%unknown(k, line(i)) < 0) cycle
        global = [global, strip%foil%unknown(k, line(i))]
        unknown(k) = size(strip%contacts%global) + size(global)
      end do
      one%slave = unknown(:axial)
      if (strip%contacts%at_faces) call touch_with_face(strip%foil%mesh, strip%foil%section%thickness, unknown(axial + 1:), one)
      if (law == contact_top .and. strip%plate == plate_forced) then
        if (plate == 0) then
          global = [global, strip%foil%unknowns]
          plate = size(strip%contacts%global) + size(global)
        end if
        one%master = reshape([0, plate, 0], [axial, 1])
        one%share = [1.0_wp]
      end if
      found = found + 1
      point(found) = one
    end do
    strip%contacts%global = [strip%contacts%global, global]
    strip%contacts%point = [strip%contacts%point, point(:found)]
    strip%crest_press = [strip%crest_press, pressing*point(:found)%length]
    strip%crest_gap = [strip%crest_gap, point(:found)%gap]
  end subroutine add_line

  !> The full load: forces on crests, or on the plate.
  subroutine add_loads(scene, plan, strip)
    type(scene_type), intent(in) :: scene
    type(foil_plan_type), intent(in) :: plan
    type(strip_system_type), intent(inout) :: strip

    real(wp), allocatable :: share(:), force(:)
    integer, allocatable :: line(:)
    integer :: bump, i
    real(wp) :: solved
    PetscErrorCode :: ierr

    solved = merge(0.5_wp, 1.0_wp, plan%half)/strip%scale%force ! forces in their unit
    if (strip%plate == plate_none) then
      force = crest_forces(scene%strip_load, scene%bump_foil)
      do bump = 1, size(force)
        line = node_set(strip%foil%mesh, crest_name(bump))
        share = line_shares(strip%foil%mesh, line)
        do i = 1, size(line)
          if (.not. strip%foil%owns(line(i)) .or. strip%foil%unknown(radial, line(i)) < 0) cycle
          PetscCallA(VecSetValue(strip%full_load, int(strip%foil%unknown(radial, line(i)), pint), -force(bump)*share(i)*solved, INSERT_VALUES, ierr))
        end do
      end do
    else if (strip%plate == plate_forced) then
      PetscCallA(VecSetValue(strip%full_load, int(strip%unknowns - 1, pint), -scene%strip_load%maximum_force*solved, INSERT_VALUES, ierr))
    end if
    PetscCallA(VecAssemblyBegin(strip%full_load, ierr))
    PetscCallA(VecAssemblyEnd(strip%full_load, ierr))
  end subroutine add_loads
end module gfb_strip_builder
