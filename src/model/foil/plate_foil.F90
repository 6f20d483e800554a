#include "gfb_petsc.h"
!> A plate under the film: the top foil of shells, on springs along the crests of bumps.
!>
!> The sleeve holds the springs; they push the plate where it presses them, or hold it both ways. Nothing loads the plate
!> along its surface, so its nodes have three unknowns: v and two rotations.
!>
!> $$ f_c = k \, l \max(-v, 0) $$
!>
!> is a spring's force, with k the line's stiffness and l the length of line that a node stands for.
module gfb_plate_foil
  use petscmat
  use gfb_kinds, only: wp
  use gfb_errors, only: error_type
  use gfb_scene, only: scene_type
  use gfb_model_case, only: springs_two_sided
  use gfb_crest_lines, only: crest_line_type, crest_lines
  use gfb_film_mesh, only: film_mesh_type, find_film_place
  use gfb_mesh_dm, only: local_mesh_type
  use gfb_partition, only: division_type
  use gfb_shell_geometry, only: node_unknowns, shell_unknowns
  use gfb_shell_mass, only: shell_mass
  use gfb_condensed_piece, only: condensed_piece_type
  use gfb_contact_law, only: contact_law_type
  use gfb_contact_point, only: contact_point_type
  use gfb_bump_contacts, only: bump_contact, contact_top
  use gfb_foil_surface, only: foil_surface_type, nodal_values_type
  use gfb_foil_structure, only: foil_structure_type, destroy_foil_structure, element_geometry
  use gfb_foil_assembly, only: element_unknowns
  use gfb_foil_builder, only: build_top
  use gfb_foil_places, only: place_unknowns, add_pressure, size_unknowns
  use gfb_foil_stress, only: shell_stresses, shell_corner_stresses
  use gfb_meshed_foil, only: meshed_foil_type, top_surface
  use gfb_shell_foil, only: add_mass_block, count_rows, expand, gather, turning, work_of_surface
  implicit none (type)
  private
  public :: create_plate_foil

  !> The plate and its springs, which are contacts of the sleeve with it.
  type, extends(meshed_foil_type), public :: plate_foil_type
    type(foil_structure_type) :: top
    logical :: at_points = .false. !! springs do not stand at rows of nodes
    logical :: two_sided = .false. !! springs hold the plate both ways: nothing opens
  contains
    procedure :: add_springs => add_plate_springs
    procedure :: has_contacts => plate_has_contacts
    procedure :: add_mass => add_plate_mass
    procedure :: natural_numbers => plate_natural_numbers
    procedure :: surfaces => plate_surfaces
    procedure :: own_unknown => plate_own_unknown
    procedure :: split_displacements => plate_displacements
    procedure :: gather_forces => plate_forces
    procedure :: stresses => stresses_of_plate
    procedure :: corner_stresses => corner_stresses_of_plate
    procedure :: find_work => work_of_plate
    procedure :: destroy => plate_destroy
  end type plate_foil_type

  !> A spring: where it stands, and for how much of its line.
  type :: spring_type
    integer :: node(4) = 0           !! of the film's whole mesh, around it
    real(wp) :: share(4) = 0.0_wp    !! of them in its place [1]
    real(wp) :: length = 0.0_wp      !! of the line [m]
    real(wp) :: stiffness = 0.0_wp   !! of the line there [N/m2]
    integer :: line = 0, strip = 1   !! of the crest
  end type spring_type

  integer, parameter :: radial = 2, axial = 3 !! components of a displacement
  real(wp), parameter :: round_off = 1.0e-11_wp !! of a shape function [1]

contains

  !> The plate under a film.
  !>
  !> Fails where an element is degenerate.
  subroutine create_plate_foil(scene, film, mesh, element_nodes, division, foil, error)
    type(scene_type), intent(in) :: scene !! what the case file asks for
    type(film_mesh_type), intent(in) :: film !! the film's whole mesh
    type(local_mesh_type), intent(in) :: mesh   !! this rank's part of the film
    integer, intent(in) :: element_nodes(:, :)  !! (nodes, elements) its elements, local nodes
    type(division_type), intent(in) :: division !! of the film
    type(plate_foil_type), intent(out) :: foil  !! ready for the bearing
    type(error_type), allocatable, intent(out) :: error !! why it failed
    type(crest_line_type), allocatable :: lines(:)
    integer :: number(node_unknowns, size(mesh%mesh_node)), around

    foil%ambient_pressure = scene%gas%ambient_pressure
    foil%at_points = scene%model%spring_pitch > 0.0_wp
    foil%two_sided = scene%model%crest_springs == springs_two_sided
    call build_top(scene, film, 0.0_wp, division, foil%top, error, bends_only=.true.)
    if (allocated(error)) return
    call take_stiffness(foil)
    lines = crest_lines(scene)
    call add_springs_of(lines, film, scene%model%spring_pitch, scene%bearing%clearance, foil)
    number = foil%top%numbers_at(mesh%mesh_node) + 1
    call place_unknowns(foil, foil%top%first, number(radial, :))
    call add_pressure(film, mesh, element_nodes, scene%shaft_contact%present, foil)
    call size_unknowns(scene, film, turning(foil%top, 1), crest_distance(lines, film), foil)
    around = (2*film%order + 1)**2 ! a node and those of the elements around it
    foil%couplings = around
    foil%row_entries = foil%row_entries + around + merge(around, 0, foil%has_room)
  end subroutine create_plate_foil

  !> The structure's matrix becomes the foil's: both have the same numbers.
  subroutine take_stiffness(foil)
    type(plate_foil_type), intent(inout) :: foil
    PetscInt, dimension(foil%top%part%owned_unknowns) :: inside, outside
    PetscErrorCode :: ierr

    call count_rows(foil%top, inside, outside)
    foil%row_entries = int(inside + outside)
    foil%owned = foil%top%part%owned_unknowns
    foil%owned_top = foil%owned
    foil%elastic = foil%top%stiffness
    foil%top%created = .false. ! the foil frees it
    foil%elastic_loses = .false.
    PetscCallA(MatCreateVecs(foil%elastic, foil%state, foil%force, ierr))
    foil%has_matrix = .true.
  end subroutine take_stiffness

  !> The springs along all lines, this rank's as contacts.
  subroutine add_springs_of(lines, film, pitch, stick_length, foil)
    type(crest_line_type), intent(in) :: lines(:)
    type(film_mesh_type), intent(in) :: film
    real(wp), intent(in) :: pitch !! of springs at points; 0: none [m]
    real(wp), intent(in) :: stick_length !! of friction, which there is none of [m]
    type(plate_foil_type), intent(inout) :: foil
    type(spring_type), allocatable :: spring(:)
    type(contact_point_type), allocatable :: point(:)
    integer, allocatable :: number(:, :), kept(:)
    integer :: i, k, found

    allocate (spring(0))
    do i = 1, size(lines)
      if (pitch > 0.0_wp) then
        spring = [spring, springs_at_points(lines(i), film, pitch)]
      else
        spring = [spring, springs_at_rows(lines(i), film)]
      end if
    end do
    number = foil%top%numbers_at([(spring(i)%node, i=1, size(spring))]) + 1
    allocate (point(size(spring)))
    found = 0
    do i = 1, size(spring)
      associate (one => spring(i))
        kept = pack([(k, k=1, size(one%node))], one%share > round_off)
        if (.not. foil%top%owns(one%node(kept(1)))) cycle
        if (all(number(:, 4*(i - 1) + kept) == 0)) cycle ! at the fixed edge
        found = found + 1
        point(found) = bump_contact(contact_top, one%node(kept(1)), one%line, one%length)
        point(found)%strip = one%strip
        point(found)%hardness = one%stiffness/lines(1)%stiffness
        point(found)%share = one%share(kept)
        deallocate (point(found)%master)
        allocate (point(found)%master(axial, size(kept)), source=0)
        point(found)%master(radial, :) = number(radial, 4*(i - 1) + kept)
      end associate
    end do
    foil%contacts%point = point(:found)
    allocate (foil%contacts%law(contact_top))
    foil%contacts%law = contact_law_type(normal_stiffness=lines(1)%stiffness, stick_length=stick_length)
    foil%contacts%adhesion = merge(1.0_wp, 0.0_wp, foil%two_sided)
    foil%contacts%rows = film%rows()
    foil%crests = maxval(lines%number)
    call foil%contacts%linearise_again()
  end subroutine add_springs_of

  !> A line's springs at the rows of nodes, each for its share of the length, by the trapezoidal rule.
  function springs_at_rows(line, film) result(spring)
    type(crest_line_type), intent(in) :: line
    type(film_mesh_type), intent(in) :: film
    type(spring_type), allocatable :: spring(:)
    real(wp) :: length(film%rows())
    integer :: row

    length = 0.0_wp
    associate (place => film%row_axial)
      do row = 1, size(place) - 1
        associate (from => max(place(row), line%ends(1)), to => min(place(row + 1), line%ends(2)), &
                   width => place(row + 1) - place(row))
          if (to <= from) cycle
          length(row) = length(row) + (to - from)*(place(row + 1) - 0.5_wp*(from + to))/width
          length(row + 1) = length(row + 1) + (to - from)*(0.5_wp*(from + to) - place(row))/width
        end associate
      end do
      spring = [(spring_at(line, film, place(row), length(row)), row=1, size(place))]
    end associate
    spring = pack(spring, length > 0.0_wp)
  end function springs_at_rows

  !> A line's springs at points of equal distance, as far from one end as from the other.
  function springs_at_points(line, film, pitch) result(spring)
    type(crest_line_type), intent(in) :: line
    type(film_mesh_type), intent(in) :: film
    real(wp), intent(in) :: pitch !! [m]
    type(spring_type), allocatable :: spring(:)
    real(wp), parameter :: rounding = 1.0e-9_wp !! of lengths that fit exactly, relative [1]
    real(wp), allocatable :: place(:)
    integer :: n, i

    n = int((line%ends(2) - line%ends(1))/pitch*(1.0_wp + rounding))
    place = [(0.5_wp*(sum(line%ends) + real(2*i - n - 1, wp)*pitch), i=1, n)]
    spring = [(spring_at(line, film, place(i), pitch), i=1, n)]
    ! of half the width those that are there, one in its middle by half
    associate (first => film%row_axial(1))
      if (.not. film%half) return
      where (abs(place - first) <= rounding*pitch) spring%length = 0.5_wp*pitch
      spring = pack(spring, place >= first - rounding*pitch)
    end associate
  end function springs_at_points

  !> A spring at a place of its line.
  function spring_at(line, film, place, length) result(spring)
    type(crest_line_type), intent(in) :: line
    type(film_mesh_type), intent(in) :: film
    real(wp), intent(in) :: place  !! along the rows [m]
    real(wp), intent(in) :: length !! that it stands for [m]
    type(spring_type) :: spring

    call find_film_place(film, film%station_angle(1) + line%angle, place, spring%node, spring%share)
    spring%length = length
    spring%stiffness = line%stiffness
    if (abs(line%exponent) > 0.0_wp) spring%stiffness = line%stiffness*(place/line%mean_radius)**line%exponent
    spring%line = line%number
    spring%strip = line%strip
  end function spring_at

  !> About how far crests stand from each other [m].
  pure real(wp) function crest_distance(lines, film)
    type(crest_line_type), intent(in) :: lines(:)
    type(film_mesh_type), intent(in) :: film

    associate (arc => film%station_angle(film%stations()) - film%station_angle(1))
      crest_distance = film%surface%radius*arc/real(maxval(lines%number), wp)
    end associate
  end function crest_distance

  !> Stiffness of the springs, as they are linearised.
  subroutine add_plate_springs(self, matrix)
    class(plate_foil_type), intent(in) :: self !! the plate
    Mat, intent(in) :: matrix !! of the bearing, by local numbers
    call self%add_jacobian(spread(0.0_wp, 1, 0), matrix)
  end subroutine add_plate_springs

  !> Whether springs open.
  pure logical function plate_has_contacts(self) result(has)
    class(plate_foil_type), intent(in) :: self !! the plate
    has = .not. self%two_sided
  end function plate_has_contacts

  !> Mass of the plate.
  !>
  !> Fails where an element is degenerate.
  subroutine add_plate_mass(self, mass, piece, error)
    class(plate_foil_type), intent(in) :: self !! the plate
    Mat, intent(in) :: mass !! like `elastic`, not assembled yet [kg] between displacements
    type(condensed_piece_type), allocatable, intent(out) :: piece(:) !! none
    type(error_type), allocatable, intent(out) :: error !! why it failed
    real(wp) :: block(shell_unknowns, shell_unknowns)
    integer :: i

    allocate (piece(0))
    associate (top => self%top)
      do i = 1, size(top%my_elements)
        call shell_mass(element_geometry(top%mesh, top%my_elements(i)), top%section, block, error)
        if (allocated(error)) return
        call add_mass_block(mass, element_unknowns(top, top%my_elements(i)) + 1, block)
      end do
    end associate
  end subroutine add_plate_mass

  !> The numbers of the structure.
  function plate_natural_numbers(self) result(number)
    class(plate_foil_type), intent(in) :: self !! the plate
    integer, allocatable :: number(:)
    number = self%top%natural_numbers()
  end function plate_natural_numbers

  !> The plate alone. What touches it are lines of its own nodes.
  function plate_surfaces(self) result(list)
    class(plate_foil_type), intent(in) :: self !! the plate
    type(foil_surface_type), allocatable :: list(:)

    allocate (list(top_surface))
    list(top_surface) = self%top%foil_surface_type
    list(top_surface)%name = 'top_foil'
    list(top_surface)%lies_on_film = .true.
    list(top_surface)%has_contacts = self%has_contacts() .and. .not. self%at_points
  end function plate_surfaces

  !> The structure's number.
  pure integer function plate_own_unknown(self, surface, component, node) result(number)
    class(plate_foil_type), intent(in) :: self !! the plate
    integer, intent(in) :: surface !! which of `surfaces`: there is one
    integer, intent(in) :: component !! 1 to 5: u, v, w, alpha, beta
    integer, intent(in) :: node !! of the surface's whole mesh

    number = self%top%unknown(component, node) + 1
    if (number > 0) number = self%own_place(number - self%top%first)
  end function plate_own_unknown

  !> Displacements of the plate's nodes on this rank.
  subroutine plate_displacements(self, unknown, moved)
    class(plate_foil_type), intent(in) :: self !! the plate
    real(wp), intent(in) :: unknown(:) !! local unknowns of the bearing [SI]
    type(nodal_values_type), allocatable, intent(out) :: moved(:) !! of its surface

    allocate (moved(top_surface))
    call expand(self%top, unknown(self%first + self%own_place), moved(top_surface)%value)
  end subroutine plate_displacements

  !> Forces on the plate's nodes as forces on its unknowns.
  subroutine plate_forces(self, nodal, force)
    class(plate_foil_type), intent(in) :: self !! the plate
    type(nodal_values_type), intent(in) :: nodal(:) !! on its surface
    real(wp), intent(out) :: force(:) !! one a local unknown, 0 where another rank owns it [N], [N m]

    force = 0.0_wp
    call gather(self%top, nodal(top_surface)%value, self%own_place, force)
  end subroutine plate_forces

  !> Stresses of the plate.
  function stresses_of_plate(self, surface, moved) result(value)
    class(plate_foil_type), intent(in) :: self !! the plate
    type(foil_surface_type), intent(in) :: surface !! its own
    real(wp), intent(in) :: moved(:, :) !! (5, local nodes) displacements [m], [rad]
    real(wp), allocatable :: value(:, :)
    value = shell_stresses(surface, moved)
  end function stresses_of_plate

  !> Stresses at the corners of the plate.
  function corner_stresses_of_plate(self, surface, moved) result(value)
    class(plate_foil_type), intent(in) :: self !! the plate
    type(foil_surface_type), intent(in) :: surface !! one of the foil's surfaces
    real(wp), intent(in) :: moved(:, :) !! (5, local nodes) displacements [m], [rad]
    real(wp), allocatable :: value(:, :, :)
    value = shell_corner_stresses(surface, moved)
  end function corner_stresses_of_plate

  !> Work of the plate's elastic forces.
  subroutine work_of_plate(self, surface, moved, work, error)
    class(plate_foil_type), intent(in) :: self !! the plate
    type(foil_surface_type), intent(in) :: surface !! its own
    real(wp), intent(in) :: moved(:, :, 0:) !! (5, local nodes, motions) first that whose forces work [m], [rad]
    real(wp), intent(out) :: work(:) !! on each of the others [J]
    type(error_type), allocatable, intent(out) :: error !! why it failed
    call work_of_surface(surface, moved, work, error)
  end subroutine work_of_plate

  !> Frees what PETSc holds.
  subroutine plate_destroy(self)
    class(plate_foil_type), intent(inout) :: self !! the plate

    call self%free_matrix()
    call destroy_foil_structure(self%top)
  end subroutine plate_destroy
end module gfb_plate_foil
