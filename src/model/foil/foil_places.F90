#include "gfb_petsc.h"
!> What shells and beams under a film have in common when they are built: meshes, laws of the
!> contacts, numbers of the unknowns, pressure, sizes.
module gfb_foil_places
  use petscsys
  use gfb_petsc_session, only: rank_count
  use gfb_foil_structure, only: foil_structure_type
  use gfb_petsc_kinds, only: pint
  use gfb_kinds, only: wp
  use gfb_scene, only: scene_type
  use gfb_strip_load_case, only: bump_stiffness
  use gfb_bearing_case, only: pad_length
  use gfb_film_mesh, only: film_mesh_type
  use gfb_mesh_dm, only: local_mesh_type
  use gfb_contact_laws, only: set_contact_laws
  use gfb_shell_element, only: pressure_weights, pressure_moments
  use gfb_meshed_foil, only: meshed_foil_type
  use gfb_initial_moment, only: set_initial_moment
  implicit none (type)
  private
  public :: ranges_of, top_height, set_laws, place_unknowns, add_pressure, size_unknowns

  !> Unknowns of the ranks, and how a structure's numbers become the foil's.
  type, public :: foil_ranges_type
    integer, allocatable :: top_end(:), bump_end(:) !! (ranks) unknowns of the ranks so far
    integer :: top_shift = 0, bump_shift = 0 !! from this rank's own numbers, from 0, to the foil's, from 1
  contains
    procedure, non_overridable :: of_top => number_of_top
    procedure, non_overridable :: of_bumps => number_of_bumps
  end type foil_ranges_type

  real(wp), parameter :: soft_contact = 20.0_wp !! stiffness to begin with, over a bump's

contains

  !> Numbers of both foils' unknowns, rank by rank: top foil, then bumps.
  function ranges_of(top, bumps) result(ranges)
    type(foil_structure_type), intent(in) :: top   !! the top foil
    type(foil_structure_type), intent(in) :: bumps !! the bump foil
    type(foil_ranges_type) :: ranges
    integer, allocatable :: both(:, :)
    integer :: i
    PetscErrorCode :: ierr

    allocate (both(2, rank_count()))
    call MPI_Allgather([top%part%owned_unknowns, bumps%part%owned_unknowns], 2, MPI_INTEGER, both, 2, MPI_INTEGER, PETSC_COMM_WORLD, ierr)
    ranges%top_end = [(sum(both(1, :i)), i=1, size(both, 2))]
    ranges%bump_end = [(sum(both(2, :i)), i=1, size(both, 2))]
    ranges%top_shift = bumps%first + 1
    ranges%bump_shift = top%first + top%part%owned_unknowns + 1
  end function ranges_of

  !> Foil's number, from 1, of an unknown of the top foil, from 0; 0 where there is none.
  elemental integer function number_of_top(self, number) result(of_foil)
    class(foil_ranges_type), intent(in) :: self !! both foils' numbers
    integer, intent(in) :: number !! of the structure, from 0; negative: none
    integer :: owner

    of_foil = 0
    if (number < 0) return
    owner = findloc(self%top_end > number, .true., 1)
    of_foil = number + 1
    if (owner > 1) of_foil = of_foil + self%bump_end(owner - 1)
  end function number_of_top

  !> The same of an unknown of the bumps.
  elemental integer function number_of_bumps(self, number) result(of_foil)
    class(foil_ranges_type), intent(in) :: self !! both foils' numbers
    integer, intent(in) :: number !! of the structure, from 0; negative: none

    of_foil = 0
    if (number < 0) return
    of_foil = number + 1 + self%top_end(findloc(self%bump_end > number, .true., 1))
  end function number_of_bumps

  !> Height of the top foil's mid-surface: above the crests' by half of both thicknesses [m].
  pure real(wp) function top_height(scene) result(height)
    type(scene_type), intent(in) :: scene !! what the case file asks for
    height = scene%bump_foil%height%value + 0.5_wp*(scene%bump_foil%thickness%value + scene%top_foil%thickness)
  end function top_height

  !> Laws of the contacts, how soft they begin, and the load of the initial moment where there is one.
  subroutine set_laws(scene, foil)
    type(scene_type), intent(in) :: scene !! what the case file asks for
    class(meshed_foil_type), intent(inout) :: foil !! its contacts get their laws
    real(wp) :: stiffness !! of a bump, per length of line [N/m2]

    stiffness = bump_stiffness(scene%bump_foil)*scene%bump_foil%pitch%value
    call set_contact_laws(scene%contact, scene%bump_foil, scene%bearing%clearance, foil%contacts)
    foil%first_hardness = min(1.0_wp, soft_contact*stiffness/(scene%contact%normal_stiffness* &
                              foil%contacts%secant_penetration**(scene%contact%exponent - 1.0_wp)))
    call set_initial_moment(scene%top_foil, scene%bearing%radius, foil)
  end subroutine set_laws

  !> Numbers the unknowns that this rank needs, and gives contacts and film nodes the numbers.
  subroutine place_unknowns(foil, first, sunk)
    class(meshed_foil_type), intent(inout) :: foil !! with its contacts' unknowns in the foil's own numbers
    integer, intent(in) :: first   !! foil's unknowns of the ranks before this one
    integer, intent(in) :: sunk(:) !! (film nodes of this rank) foil's number of v there, from 1; 0: fixed

    integer, allocatable :: needed(:)
    integer :: i, k

    k = size(sunk)
    do i = 1, size(foil%contacts%point)
      k = k + size(foil%contacts%point_unknowns(i))
    end do
    allocate (needed(k))
    needed(:size(sunk)) = sunk
    k = size(sunk)
    do i = 1, size(foil%contacts%point)
      associate (unknown => foil%contacts%point_unknowns(i))
        needed(k + 1:k + size(unknown)) = unknown
        k = k + size(unknown)
      end associate
    end do
    needed = pack(needed, needed > 0 .and. (needed <= first .or. needed > first + foil%owned))
    call sort_once(needed)
    foil%global_unknown = [pack(needed, needed <= first), [(first + i, i=1, foil%owned)], pack(needed, needed > first)]
    k = count(needed <= first)
    foil%own_place = [(k + i, i=1, foil%owned)]
    foil%source = -place_of(foil%global_unknown, sunk)
    allocate (foil%rate(size(foil%source)), source=-1.0_wp)
    allocate (foil%origin(size(foil%source)), source=0.0_wp)
    do i = 1, size(foil%contacts%point)
      associate (point => foil%contacts%point(i))
        point%slave = place_of(foil%global_unknown, point%slave)
        do k = 1, size(point%share)
          point%master(:, k) = place_of(foil%global_unknown, point%master(:, k))
        end do
        if (allocated(point%turn)) point%turn = place_of(foil%global_unknown, point%turn)
      end associate
    end do
    foil%contacts%global = foil%global_unknown
  end subroutine place_unknowns

  !> Sorts numbers and keeps each once.
  subroutine sort_once(numbers)
    integer, allocatable, intent(inout) :: numbers(:)
    PetscInt :: kept, list(size(numbers))
    PetscErrorCode :: ierr

    list = int(numbers, pint)
    kept = size(list)
    PetscCallA(PetscSortRemoveDupsInt(kept, list, ierr))
    numbers = int(list(:kept))
  end subroutine sort_once

  !> Places of numbers in a rising list, 0 where they are not in it.
  pure function place_of(list, numbers) result(place)
    integer, intent(in) :: list(:), numbers(:)
    integer :: place(size(numbers))
    integer :: i, low, high, middle

    place = 0
    do i = 1, size(numbers)
      low = 1
      high = size(list)
      do while (low < high)
        middle = (low + high)/2
        if (list(middle) < numbers(i)) then
          low = middle + 1
        else
          high = middle
        end if
      end do
      if (low > size(list)) cycle
      if (list(low) == numbers(i)) place(i) = low
    end do
  end function place_of

  !> What the film's elements push, and the weights of their nodal pressures in the forces.
  subroutine add_pressure(film, mesh, element_nodes, yields, foil)
    type(film_mesh_type), intent(in) :: film !! the film's whole mesh
    type(local_mesh_type), intent(in) :: mesh !! this rank's part of it
    integer, intent(in) :: element_nodes(:, :) !! (4 or 9, elements), local nodes
    logical, intent(in) :: yields !! pressures follow the foil: film and foil in turns, or asperities
    class(meshed_foil_type), intent(inout) :: foil !! its unknowns are numbered

    integer, parameter :: corners = 4 !! of a bilinear element
    integer :: i, nodes, station(size(element_nodes, 1)), row(size(element_nodes, 1))
    real(wp) :: area, width
    real(wp), dimension(size(element_nodes, 1), size(element_nodes, 1)) :: unit, moment

    nodes = size(element_nodes, 1)
    unit = pressure_weights(nodes)
    moment = pressure_moments(nodes)
    ! Pressures that follow the foil couple its nodes; those of a cell are coupled anyway.
    foil%has_room = yields .and. nodes > corners
    foil%pressed = element_nodes
    allocate (foil%pushed(nodes, size(element_nodes, 2)))
    allocate (foil%weight(nodes, nodes, size(element_nodes, 2)))
    do i = 1, size(element_nodes, 2)
      foil%pushed(:, i) = -foil%source(element_nodes(:, i))
      station = (mesh%mesh_node(element_nodes(:, i)) - 1)/film%rows() + 1
      row = modulo(mesh%mesh_node(element_nodes(:, i)) - 1, film%rows()) + 1
      area = film%surface%radius*(maxval(film%station_angle(station)) - minval(film%station_angle(station)))* &
             (maxval(film%row_axial(row)) - minval(film%row_axial(row)))
      foil%weight(:, :, i) = area*unit
      if (.not. film%surface%is_ring()) cycle
      width = maxval(film%row_axial(row)) - minval(film%row_axial(row))
      associate (middle => 0.5_wp*(maxval(film%row_axial(row)) + minval(film%row_axial(row))))
        foil%weight(:, :, i) = area/film%surface%radius*(middle*unit + width*moment)
      end associate
    end do
  end subroutine add_pressure

  !> Sizes of displacements and forces.
  subroutine size_unknowns(scene, film, turning, arm, foil)
    type(scene_type), intent(in) :: scene !! what the case file asks for
    type(film_mesh_type), intent(in) :: film !! the film's whole mesh
    integer, intent(in) :: turning(:) !! foil's numbers of this rank's rotations; it needs no others
    real(wp), intent(in) :: arm !! of a displacement over a rotation that are alike [m]
    class(meshed_foil_type), intent(inout) :: foil !! gets the sizes of its unknowns and equations
    real(wp) :: force, scale(size(foil%global_unknown))

    scale = 1.0_wp
    scale(place_of(foil%global_unknown, turning)) = arm
    force = scene%gas%ambient_pressure*pad_length(scene%bearing)/film%circumferential()* &
            scene%bearing%length/(film%order*scene%mesh%axial_elements)
    foil%unknown_scale = scene%bearing%clearance/scale
    foil%equation_scale = force*scale
  end subroutine size_unknowns
end module gfb_foil_places
