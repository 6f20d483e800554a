#include "gfb_petsc.h"
!> Foils of shells or beams with other numbers on the same mesh of the film: laws, gaps and levers of their contacts.
module gfb_changed_contacts
  use gfb_kinds, only: wp
  use gfb_petsc_session, only: this_rank
  use gfb_scene, only: scene_type
  use gfb_bump_foil_case, only: gap_of_crest, gap_of_corner
  use gfb_film_mesh, only: film_mesh_type
  use gfb_quad_mesh, only: quad_mesh_type
  use gfb_mesh_dm, only: columns_window
  use gfb_foil_builder, only: strip_on_pad
  use gfb_bump_contacts, only: contact_top, touch_with_face, touch_top_face
  use gfb_contact_set, only: contact_set_type
  use gfb_foil_model, only: foil_model_type
  use gfb_foil_places, only: set_laws
  use gfb_meshed_foil, only: meshed_foil_type
  use gfb_shell_foil, only: shell_foil_type
  use gfb_beam_foil, only: beam_foil_type
  implicit none (type, external)
  private
  public :: takes_numbers, take_foil_numbers, add_contact_forces, window_of

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
end module gfb_changed_contacts
