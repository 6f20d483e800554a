#include "gfb_petsc.h"
!> Elastic forces of foils of shells or beams with other numbers on the same mesh of the film.
!>
!> What is linear in the unknowns is not assembled: elastic forces with another thickness, material or shape of the bumps
!> are those of the elements, or of the super-elements, one by one; these to first order, as derivatives need them.
module gfb_changed_foil
  use petscvec
  use gfb_kinds, only: wp
  use gfb_petsc_session, only: this_rank, share_failure
  use gfb_scene, only: scene_type
  use gfb_bump_foil_case, only: gap_of_crest, gap_of_corner
  use gfb_film_mesh, only: film_mesh_type
  use gfb_quad_mesh, only: quad_mesh_type
  use gfb_mesh_dm, only: columns_window
  use gfb_foil_builder, only: strip_on_pad, shape_on_pad, section_of, plate_section
  use gfb_bump_contacts, only: contact_top, touch_with_face, touch_top_face
  use gfb_contact_set, only: contact_set_type
  use gfb_foil_model, only: foil_model_type
  use gfb_foil_places, only: set_laws, foil_ranges_type, ranges_of
  use gfb_meshed_foil, only: meshed_foil_type
  use gfb_shell_foil, only: shell_foil_type
  use gfb_beam_foil, only: beam_foil_type, stiffness_behind, width_of, of_beam
  use gfb_errors, only: error_type
  use gfb_local_exchange, only: local_exchange_type, create_exchange
  use gfb_shell_geometry, only: shell_geometry_type, shell_section_type, node_unknowns, shell_unknowns
  use gfb_shell_element, only: shell_stiffness
  use gfb_foil_mesh, only: bump_strip_mesh
  use gfb_foil_structure, only: foil_structure_type, piece_numbers, element_geometry, element_section
  use gfb_foil_assembly, only: element_unknowns, retained_unknowns
  use gfb_substructures, only: substructure_type, places_in
  use gfb_super_element, only: super_element_type
  implicit none (type)
  private
  public :: takes_numbers, take_foil_numbers, add_contact_forces, add_changed_force

  real(wp), parameter :: round_off = 1.0e-12_wp !! of an element's shape, over its size

  !> Elements of a substructure.
  type :: piece_elements_type
    integer, allocatable :: number(:, :)       !! (20, elements) of their unknowns in it, from 1; 0: fixed
    real(wp), allocatable :: stiffness(:, :, :) !! (20, 20, elements) [SI]
    real(wp), allocatable :: modes(:, :)        !! constraint modes of the foil's super-element, once they were found
  end type piece_elements_type

  !> Substructures of another bump foil, by kind, for all pads: these are equal.
  type, public :: changed_pieces_type
    type(piece_elements_type), allocatable, private :: kind(:)
  end type changed_pieces_type

contains

  !> Whether a foil can take other numbers.
  pure function takes_numbers(foil) result(takes)
    class(foil_model_type), intent(in) :: foil !! any
    logical :: takes

    takes = .false.
    select type (foil)
    class is (meshed_foil_type)
      takes = .true.
    end select
  end function takes_numbers

  !> Gives a foil the laws, gaps and levers of its contacts, and the pressure around, of a scene; the contacts stay
  !> linearised where they are.
  subroutine take_foil_numbers(scene, film, foil)
    type(scene_type), intent(in) :: scene !! with a foil on the same meshes
    type(film_mesh_type), intent(in) :: film !! the film's whole mesh
    class(foil_model_type), intent(inout) :: foil !! that can take them

    select type (foil)
    class is (meshed_foil_type)
      foil%ambient_pressure = scene%gas%ambient_pressure
      call set_laws(scene, foil)
    end select
    select type (foil)
    type is (shell_foil_type)
      call take_gaps(scene, foil%contacts)
      if (foil%contacts%at_faces) call take_levers(scene, strip_on_pad(scene, film, window_of(foil)), foil%contacts)
      call foil%contacts%linearise_again()
    type is (beam_foil_type)
      call take_gaps(scene, foil%contacts)
      if (foil%contacts%at_faces) call take_levers(scene, strip_on_pad(scene, film, window_of(foil)), foil%contacts)
      call foil%contacts%linearise_again()
    end select
  end subroutine take_foil_numbers

  !> The stretch of the bump foil's stations that a foil meshes on this rank.
  function window_of(foil) result(window)
    class(meshed_foil_type), intent(in) :: foil !! of shells or beams
    integer :: window(2)

    window = [1, 0]
    select type (foil)
    type is (shell_foil_type)
      window = columns_window(foil%bumps%column_part, this_rank() + 1)
    type is (beam_foil_type)
      if (foil%owned > 0) window(2) = foil%bumps%mesh%stations
    end select
  end function window_of

  !> Gaps of the contacts at rest.
  pure subroutine take_gaps(scene, contacts)
    type(scene_type), intent(in) :: scene
    type(contact_set_type), intent(inout) :: contacts
    integer :: i

    do i = 1, size(contacts%point)
      associate (point => contacts%point(i))
        if (point%law == contact_top) then
          point%gap = gap_of_crest(scene%bump_foil, point%line, point%strip)
        else
          point%gap = gap_of_corner(scene%bump_foil, point%line)
        end if
      end associate
    end do
  end subroutine take_gaps

  !> Levers of contacts at faces: thickness and shape of the bumps move the faces.
  pure subroutine take_levers(scene, mesh, contacts)
    type(scene_type), intent(in) :: scene
    type(quad_mesh_type), intent(in) :: mesh !! of the bump foil as the scene has it
    type(contact_set_type), intent(inout) :: contacts
    integer, allocatable :: turn(:)
    integer, parameter :: turns = 2 !! of a node
    integer :: i

    do i = 1, size(contacts%point)
      associate (point => contacts%point(i))
        turn = point%turn
        call touch_with_face(mesh, scene%bump_foil%thickness%value, turn(:turns), point)
        if (size(turn) == turns) cycle
        call touch_top_face(scene%top_foil%thickness, reshape(turn(turns + 1:), [turns, size(turn)/turns - 1]), point)
      end associate
    end do
  end subroutine take_levers

  !> Adds the forces of a foil's contacts, and of its initial moment.
  subroutine add_contact_forces(foil, unknown, residual)
    class(foil_model_type), intent(in) :: foil !! that can take other numbers
    real(wp), intent(in) :: unknown(:) !! local ones of the pad, in SI
    real(wp), intent(inout) :: residual(:) !! of the pad, one a local unknown [SI]

    select type (foil)
    class is (meshed_foil_type)
      call foil%add_contact_forces(unknown, residual)
    end select
  end subroutine add_contact_forces

  !> Adds the elastic forces of one of the foils as a scene has it. All ranks ask.
  !>
  !> Fails where an element is degenerate.
  subroutine add_changed_force(foil, scene, film, of_bumps, unknown, residual, pieces, error)
    class(foil_model_type), intent(inout) :: foil !! that can take other numbers
    type(scene_type), intent(in) :: scene !! with a foil on the same mesh of the film
    type(film_mesh_type), intent(in) :: film !! the film's whole mesh
    logical, intent(in) :: of_bumps !! of the bump foil, else of the top foil
    real(wp), intent(in) :: unknown(:) !! local ones of the pad, in SI
    real(wp), intent(inout) :: residual(:) !! of the pad, one a local unknown [SI]
    type(changed_pieces_type), intent(inout) :: pieces !! of the scene, so far
    type(error_type), allocatable, intent(out) :: error !! why it failed
    PetscScalar, pointer :: values(:)
    PetscErrorCode :: ierr

    select type (foil)
    class is (meshed_foil_type)
      PetscCallA(GFB_VecGetArray(foil%state, values, ierr))
      values = unknown(foil%first + foil%own_place)
      PetscCallA(GFB_VecRestoreArray(foil%state, values, ierr))
      PetscCallA(VecSet(foil%force, 0.0_wp, ierr))
    end select
    select type (foil)
    type is (shell_foil_type)
      if (.not. of_bumps) then
        call add_elements(foil, foil%top, foil%top%mesh, plate_section(scene), of_bumps, error)
      else if (foil%bumps%reduced) then
        call add_pieces(foil, scene, film, pieces, error)
      else
        call add_elements(foil, foil%bumps, strip_on_pad(scene, film, window_of(foil)), section_of(scene%bump_foil), &
                          of_bumps, error)
      end if
    type is (beam_foil_type)
      if (.not. of_bumps) then
        call add_beam(foil, foil%top%mesh, width_of(foil%top%mesh), plate_section(scene), foil%top_number, of_bumps)
      else
        ! all rows are alike
        call add_beam(foil, bump_strip_mesh(shape_on_pad(scene), film%row_axial(:2), film%half, window_of(foil)), &
                      width_of(foil%bumps%mesh), section_of(scene%bump_foil), foil%bump_number, of_bumps)
      end if
    end select
    if (allocated(error)) return
    select type (foil)
    class is (meshed_foil_type)
      PetscCallA(GFB_VecGetArrayRead(foil%force, values, ierr))
      residual(foil%first + foil%own_place) = residual(foil%first + foil%own_place) + values
      PetscCallA(GFB_VecRestoreArrayRead(foil%force, values, ierr))
    end select
  end subroutine add_changed_force

  !> Forces of a beam's elements, all of them on the rank that has the foil.
  subroutine add_beam(foil, mesh, width, section, number, bent)
    type(beam_foil_type), intent(in) :: foil !! with the unknowns in `state`; gets the forces in `force`
    type(quad_mesh_type), intent(in) :: mesh !! of one of its beams
    real(wp), intent(in) :: width !! that is solved [m]
    type(shell_section_type), intent(in) :: section
    integer, intent(in) :: number(:, :) !! (5, stations) the foil's own, 0: fixed
    logical, intent(in) :: bent !! elements bend between their ends
    PetscScalar, pointer :: state(:), values(:)
    real(wp) :: moved(0:foil%owned), force(0:foil%owned), element(2*size(of_beam))
    PetscErrorCode :: ierr
    integer :: station, i

    if (foil%owned == 0) return
    PetscCallA(GFB_VecGetArrayRead(foil%state, state, ierr))
    moved(0) = 0.0_wp
    moved(1:) = state
    PetscCallA(GFB_VecRestoreArrayRead(foil%state, state, ierr))
    force = 0.0_wp
    do station = 1, mesh%stations - 1
      associate (own => [number(of_beam, station), number(of_beam, station + 1)])
        element = width*matmul(stiffness_behind(mesh, section, station, bent), moved(own))
        do i = 1, size(own)
          force(own(i)) = force(own(i)) + element(i) ! several may be fixed
        end do
      end associate
    end do
    PetscCallA(GFB_VecGetArray(foil%force, values, ierr))
    values = force(1:)
    PetscCallA(GFB_VecRestoreArray(foil%force, values, ierr))
  end subroutine add_beam

  !> Forces of this rank's super-elements, to first order in what is changed: with the constraint modes T that
  !> they have, \( d\tilde{K} = T^T dK T \).
  subroutine add_pieces(foil, scene, film, pieces, error)
    type(shell_foil_type), intent(inout) :: foil !! with the unknowns in `state`; gets the forces in `force`
    type(scene_type), intent(in) :: scene
    type(film_mesh_type), intent(in) :: film
    type(changed_pieces_type), intent(inout) :: pieces !! gets the kinds that this rank needs and has not yet
    type(error_type), allocatable, intent(out) :: error
    integer, allocatable :: number(:), alike(:)
    real(wp), allocatable :: moved(:), force(:)
    type(quad_mesh_type), allocatable :: mesh
    type(foil_ranges_type) :: ranges
    integer :: kind, i, first

    if (.not. allocated(pieces%kind)) allocate (pieces%kind(size(foil%bumps%super)))
    ranges = ranges_of(foil%top, foil%bumps)
    allocate (number(0))
    do kind = 1, size(pieces%kind)
      alike = of_kind(foil%bumps, kind)
      do i = 1, size(alike)
        number = [number, ranges%of_bumps(retained_unknowns(foil%bumps, foil%bumps%substructure(alike(i))))]
      end do
    end do
    allocate (force(size(number)))
    call fetch(foil, number, moved)
    first = 0
    do kind = 1, size(pieces%kind)
      alike = of_kind(foil%bumps, kind)
      if (size(alike) == 0) cycle
      if (.not. allocated(pieces%kind(kind)%number)) then
        if (.not. allocated(mesh)) mesh = strip_on_pad(scene, film, window_of(foil))
        associate (one => foil%bumps%substructure(alike(1)))
          call form_elements(mesh, section_of(scene%bump_foil), foil%bumps%free(:, one%nodes), one, pieces%kind(kind), error)
        end associate
        if (allocated(error)) exit
      end if
      associate (super => foil%bumps%super(kind), n => size(alike)*size(foil%bumps%super(kind)%retained))
        call share_modes(super, pieces%kind(kind)%modes)
        force(first + 1:first + n) = [piece_forces(super, pieces%kind(kind), &
                                                   reshape(moved(first + 1:first + n), [size(super%retained), size(alike)]))]
        first = first + n
      end associate
    end do
    call share_failure(error)
    if (.not. allocated(error)) call add_up(foil, number, force)
  end subroutine add_pieces

  !> This rank's substructures of a kind.
  pure function of_kind(structure, kind) result(alike)
    type(foil_structure_type), intent(in) :: structure
    integer, intent(in) :: kind
    integer, allocatable :: alike(:)

    alike = pack(structure%mine, structure%substructure(structure%mine)%kind == kind)
  end function of_kind

  !> The elements of a substructure.
  subroutine form_elements(mesh, section, free, substructure, elements, error)
    type(quad_mesh_type), intent(in) :: mesh
    type(shell_section_type), intent(in) :: section
    logical, intent(in) :: free(:, :) !! (5, the piece's nodes) not fixed by a support
    type(substructure_type), intent(in) :: substructure
    type(piece_elements_type), intent(out) :: elements !! of its kind
    type(error_type), allocatable, intent(out) :: error
    integer :: number(node_unknowns, size(substructure%nodes))
    integer :: i

    number = piece_numbers(free, substructure)
    allocate (elements%number(shell_unknowns, size(substructure%elements)))
    allocate (elements%stiffness(shell_unknowns, shell_unknowns, size(substructure%elements)))
    do i = 1, size(substructure%elements)
      associate (element => substructure%elements(i))
        elements%number(:, i) = reshape(number(:, places_in(substructure, mesh%element_nodes(:, element))), [shell_unknowns])
        call shell_stiffness(element_geometry(mesh, element), element_section(mesh, section, element), &
                             elements%stiffness(:, :, i), error)
      end associate
      if (allocated(error)) return
    end do
  end subroutine form_elements

  !> A super-element takes its constraint modes from another pad's, or finds them for all.
  subroutine share_modes(super, modes)
    type(super_element_type), intent(inout) :: super
    real(wp), allocatable, intent(inout) :: modes(:, :) !! of another pad; absent if not found yet

    if (allocated(super%modes)) return
    if (allocated(modes)) then
      super%modes = modes
    else
      super%modes = super%constraint_modes()
      modes = super%modes
    end if
  end subroutine share_modes

  !> Forces \( T^T K T q_B \) of super-elements of a kind with the modes T and with other elements' stiffness K.
  pure function piece_forces(super, elements, moved) result(force)
    type(super_element_type), intent(in) :: super
    type(piece_elements_type), intent(in) :: elements
    real(wp), intent(in) :: moved(:, :) !! (retained unknowns, super-elements) q_B [m], [rad]
    real(wp) :: force(size(moved, 1), size(moved, 2)) !! on these [N], [N m]
    ! 0: fixed
    real(wp), dimension(0:size(super%retained) + size(super%interior), size(moved, 2)) :: state, forces
    real(wp) :: part(shell_unknowns, size(moved, 2))
    integer :: i, k

    state = 0.0_wp
    state(super%retained, :) = moved
    state(super%interior, :) = matmul(super%modes, moved)
    forces = 0.0_wp
    do i = 1, size(elements%number, 2)
      associate (number => elements%number(:, i))
        part = matmul(elements%stiffness(:, :, i), state(number, :))
        do k = 1, shell_unknowns
          forces(number(k), :) = forces(number(k), :) + part(k, :)
        end do
      end associate
    end do
    force = forces(super%retained, :) + matmul(transpose(super%modes), forces(super%interior, :))
  end function piece_forces

  !> Forces of a structure's elements on this rank. Neighbours of the same shape share a stiffness.
  subroutine add_elements(foil, structure, mesh, section, of_bumps, error)
    type(shell_foil_type), intent(in) :: foil !! with the unknowns in `state`; gets the forces in `force`
    type(foil_structure_type), intent(in) :: structure !! one of the foil's
    type(quad_mesh_type), intent(in) :: mesh
    type(shell_section_type), intent(in) :: section
    logical, intent(in) :: of_bumps !! the structure is that
    type(error_type), allocatable, intent(out) :: error
    integer :: number(shell_unknowns, size(structure%my_elements))
    real(wp) :: force(shell_unknowns, size(structure%my_elements)), stiffness(shell_unknowns, shell_unknowns)
    real(wp), allocatable :: moved(:)
    type(foil_ranges_type) :: ranges
    type(shell_geometry_type) :: here, before
    type(shell_section_type) :: own
    real(wp) :: thickness !! of the neighbour [m]
    integer :: i
    logical :: known

    ranges = ranges_of(foil%top, foil%bumps)
    do i = 1, size(structure%my_elements)
      number(:, i) = element_unknowns(structure, structure%my_elements(i))
      if (of_bumps) then
        number(:, i) = ranges%of_bumps(number(:, i))
      else
        number(:, i) = ranges%of_top(number(:, i))
      end if
    end do
    call fetch(foil, [number], moved)
    known = .false.
    do i = 1, size(structure%my_elements)
      here = element_geometry(mesh, structure%my_elements(i))
      own = element_section(mesh, section, structure%my_elements(i))
      if (known) known = is_same(here, before) .and. abs(own%thickness - thickness) <= 0.0_wp
      if (.not. known) then
        call shell_stiffness(here, own, stiffness, error)
        if (allocated(error)) exit
        before = here
        thickness = own%thickness
        known = .true.
      end if
      force(:, i) = matmul(stiffness, moved((i - 1)*shell_unknowns + 1:i*shell_unknowns))
    end do
    call share_failure(error)
    if (.not. allocated(error)) call add_up(foil, [number], [force])
  end subroutine add_elements

  !> Whether an element is another one, moved.
  pure function is_same(here, other) result(same)
    type(shell_geometry_type), intent(in) :: here, other
    logical :: same

    associate (p => here%position - spread(here%position(:, 1), 2, size(here%position, 2)), &
               q => other%position - spread(other%position(:, 1), 2, size(other%position, 2)))
      same = all(abs(p - q) <= round_off*maxval(abs(q)))
    end associate
    same = same .and. all(abs(here%director - other%director) <= round_off) .and. all(abs(here%axis - other%axis) <= round_off)
  end function is_same

  !> The foil's unknowns of some numbers, from 1; zero where the number is 0.
  subroutine fetch(foil, number, moved)
    type(shell_foil_type), intent(in) :: foil
    integer, intent(in) :: number(:)
    real(wp), allocatable, intent(out) :: moved(:) !! [m], [rad]
    type(local_exchange_type) :: exchange
    real(wp) :: there(count(number > 0))
    PetscInt, allocatable :: global(:)

    global = pack(number, number > 0) - 1
    call create_exchange(global, foil%state, exchange)
    call exchange%get(foil%state, there)
    call exchange%destroy()
    moved = unpack(there, number > 0, 0.0_wp)
  end subroutine fetch

  !> Adds forces on unknowns of some numbers, from 1; none where the number is 0.
  subroutine add_up(foil, number, force)
    type(shell_foil_type), intent(in) :: foil
    integer, intent(in) :: number(:)
    real(wp), intent(in) :: force(:) !! [N], [N m]
    type(local_exchange_type) :: exchange
    PetscInt, allocatable :: global(:)

    global = pack(number, number > 0) - 1
    call create_exchange(global, foil%force, exchange)
    call exchange%add(pack(force, number > 0), foil%force)
    call exchange%destroy()
  end subroutine add_up
end module gfb_changed_foil
