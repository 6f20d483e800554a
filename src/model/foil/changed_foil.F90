#include "gfb_petsc.h"
!> Foils of shells or beams with other numbers on the same mesh of the film.
!>
!> Their matrix stays as it is. What another thickness, material or shape of the bumps does to it follows from the work of the
!> elastic forces of a motion on others, element by element. Condensed pieces keep their constraint modes T, which gives the
!> work to first order, \( d\tilde{K} = T^T dK T \), as derivatives need it.
module gfb_changed_foil
  use gfb_kinds, only: wp
  use gfb_errors, only: error_type
  use gfb_scene, only: scene_type
  use gfb_foil_cases, only: gap_of_crest, gap_of_corner
  use gfb_film_mesh, only: film_mesh_type
  use gfb_quad_mesh, only: quad_mesh_type
  use gfb_foil_builder, only: strip_on_pad, section_of, plate_section
  use gfb_bump_contacts, only: contact_top, touch_with_face, touch_top_face
  use gfb_contact_set, only: contact_set_type
  use gfb_foil_surface, only: foil_surface_type
  use gfb_foil_model, only: foil_model_type
  use gfb_foil_places, only: set_laws
  use gfb_meshed_foil, only: meshed_foil_type
  implicit none (type, external)
  private
  public :: take_foil_numbers, elastic_work

contains

  !> Gives a foil the laws, gaps and levers of its contacts, and the pressure around, of a scene; the contacts stay
  !> linearised where they are.
  subroutine take_foil_numbers(scene, film, foil)
    type(scene_type), intent(in) :: scene !! with a foil on the same meshes
    type(film_mesh_type), intent(in) :: film !! the film's whole mesh
    class(foil_model_type), intent(inout) :: foil !! with meshes of its own
    type(foil_surface_type), allocatable :: surface(:)
    integer :: i

    select type (foil)
    class is (meshed_foil_type)
      foil%ambient_pressure = scene%gas%ambient_pressure
      call set_laws(scene, foil)
    end select
    do i = 1, size(foil%contacts%point)
      associate (point => foil%contacts%point(i))
        if (point%law == contact_top) then
          point%gap = gap_of_crest(scene%bump_foil, point%line, point%strip)
        else
          point%gap = gap_of_corner(scene%bump_foil, point%line)
        end if
      end associate
    end do
    if (foil%contacts%at_faces) then
      surface = foil%surfaces()
      associate (bumps => surface(findloc(surface%lies_on_film, .false., dim=1)))
        call take_levers(scene, strip_on_pad(scene, film, stations_of(bumps%mesh)), foil%contacts)
      end associate
    end if
    call foil%contacts%linearise_again()
  end subroutine take_foil_numbers

  !> The stretch of stations that a mesh holds on this rank.
  pure function stations_of(mesh) result(window)
    type(quad_mesh_type), intent(in) :: mesh
    integer :: window(2)
    window = [(lbound(mesh%position, 2) - 1)/mesh%rows + 1, ubound(mesh%position, 2)/mesh%rows]
  end function stations_of

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

  !> Work of the elastic forces of one of the foils, as a scene has it, in this rank's elements.
  !>
  !> Fails where an element is degenerate.
  subroutine elastic_work(foil, scene, film, number, moved, work, error)
    class(foil_model_type), intent(in) :: foil !! with meshes of its own, the same ones
    type(scene_type), intent(in) :: scene !! with a key of the foil changed
    type(film_mesh_type), intent(in) :: film !! the film's whole mesh
    integer, intent(in) :: number !! of the foil's surface
    real(wp), intent(in) :: moved(:, :, 0:) !! (5, local nodes, motions) first that whose forces work [m], [rad]
    real(wp), intent(out) :: work(:) !! on each of the others [J]
    type(error_type), allocatable, intent(out) :: error !! why it failed
    type(foil_surface_type), allocatable :: surface(:)

    surface = foil%surfaces()
    associate (one => surface(number))
      if (one%lies_on_film) then
        one%section = plate_section(scene)
      else
        one%mesh = strip_on_pad(scene, film, stations_of(one%mesh))
        one%section = section_of(scene%bump_foil)
      end if
      select type (foil)
      class is (meshed_foil_type)
        call foil%find_work(one, moved, work, error)
      end select
    end associate
  end subroutine elastic_work
end module gfb_changed_foil
