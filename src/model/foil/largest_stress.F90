#include "gfb_petsc.h"
!> The largest von Mises stress of a foil's surfaces, and how it follows the foil's unknowns.
!>
!> Stresses are those at the corners of elements, on either face. Where one is largest stays where it is in a derivative.
module gfb_largest_stress
  use gfb_kinds, only: wp
  use gfb_shell_element, only: von_mises, von_mises_rates
  use gfb_foil_stress, only: face_stress, find_largest
  use gfb_foil_model, only: foil_model_type
  use gfb_foil_surface, only: foil_surface_type, nodal_values_type
  use gfb_meshed_foil, only: meshed_foil_type, from_rest
  implicit none (type, external)
  private
  public :: find_largest_stress, stress_at, add_stress_rates

  integer, parameter, public :: surfaces = 2 !! of a foil at most: top foil and bumps

  !> A corner of an element of a surface, and a face there.
  type, public :: stress_place_type
    integer :: pad = 0     !! of the bearing; 0: no pad has such a surface
    integer :: surface = 0 !! of its foil's `surfaces`; 0: it has none such
    integer :: element = 0 !! among this rank's; 0: another rank's
    integer :: corner = 0  !! of the element
    integer :: face = 0    !! `lower_face` or `upper_face`
  end type stress_place_type

  !> Displacements of a surface's nodes from where it is free of stress.
  type :: moved_surface_type
    type(foil_surface_type) :: surface
    real(wp), allocatable :: moved(:, :) !! (5, local nodes) [m], [rad]
  end type moved_surface_type

contains

  !> The largest von Mises stress of each surface in this rank's elements, and where it is. All ranks ask.
  subroutine find_largest_stress(foil, unknown, place, largest)
    class(foil_model_type), intent(in) :: foil !! with meshes of its own
    real(wp), intent(in) :: unknown(:) !! local ones of the pad [SI]
    type(stress_place_type), intent(out) :: place(:) !! one a surface, without the pad
    real(wp), intent(out) :: largest(:) !! one a surface, of foils as they were built; 0 where there are no elements [Pa]
    type(moved_surface_type), allocatable :: list(:)
    integer :: i

    largest = 0.0_wp
    select type (foil)
    class is (meshed_foil_type)
      list = moved_surfaces(foil, unknown)
      do i = 1, size(list)
        place(i)%surface = i
        associate (there => place(i))
          call find_largest(foil%corner_stresses(list(i)%surface, list(i)%moved), largest(i), there%element, there%corner, there%face)
        end associate
      end do
    end select
  end subroutine find_largest_stress

  !> Surfaces of a foil and how they are moved. All ranks ask.
  function moved_surfaces(foil, unknown) result(list)
    class(meshed_foil_type), intent(in) :: foil
    real(wp), intent(in) :: unknown(:) !! local ones of the pad [SI]
    type(moved_surface_type), allocatable :: list(:)
    type(foil_surface_type), allocatable :: surface(:)
    type(nodal_values_type), allocatable :: moved(:)
    integer :: i

    surface = foil%surfaces()
    allocate (list(size(surface)))
    call foil%split_displacements(unknown, moved)
    do i = 1, size(list)
      list(i)%surface = surface(i)
      list(i)%moved = from_rest(foil, surface(i), moved(i)%value)
    end do
  end function moved_surfaces

  !> Von Mises stress at some places of a foil as it was built, 0 on ranks that do not have them [Pa]. All ranks ask.
  function stress_at(foil, place, unknown) result(stress)
    class(foil_model_type), intent(in) :: foil !! with meshes of its own
    type(stress_place_type), intent(in) :: place(:) !! on this pad
    real(wp), intent(in) :: unknown(:) !! local ones of the pad [SI]
    real(wp) :: stress(size(place))
    type(moved_surface_type), allocatable :: list(:)
    integer :: i

    stress = 0.0_wp
    select type (foil)
    class is (meshed_foil_type)
      list = moved_surfaces(foil, unknown)
      do i = 1, size(place)
        if (place(i)%element > 0) stress(i) = von_mises(stress_there(foil, place(i), list(place(i)%surface)))
      end do
    end select
  end function stress_at

  !> Stress at a place: along the axis, across it, shear [Pa]. It is proportional to the displacements.
  function stress_there(foil, place, one) result(plane)
    class(meshed_foil_type), intent(in) :: foil
    type(stress_place_type), intent(in) :: place !! in an element of this rank
    type(moved_surface_type), intent(in) :: one !! that surface
    real(wp) :: plane(3)
    type(foil_surface_type) :: alone
    real(wp), allocatable :: stress(:, :, :)

    alone = one%surface
    alone%my_elements = [one%surface%my_elements(place%element)]
    stress = foil%corner_stresses(alone, one%moved)
    plane = face_stress(stress(:, place%corner, 1), place%face)
  end function stress_there

  !> Adds derivatives of `stress_at` by the unknowns of the pad. All ranks ask.
  subroutine add_stress_rates(foil, place, unknown, rate)
    class(foil_model_type), intent(in) :: foil !! with meshes of its own
    type(stress_place_type), intent(in) :: place !! on this pad
    real(wp), intent(in) :: unknown(:) !! local ones of the pad [SI]
    real(wp), intent(inout) :: rate(:) !! one an unknown of the pad, this rank's own ones [Pa/m], [Pa]
    type(moved_surface_type), allocatable :: list(:)
    type(nodal_values_type), allocatable :: slope(:)
    real(wp), allocatable :: force(:)
    integer :: i

    select type (foil)
    class is (meshed_foil_type)
      list = moved_surfaces(foil, unknown)
      allocate (slope(size(list)))
      do i = 1, size(list)
        slope(i)%value = 0.0_wp*list(i)%moved
      end do
      if (place%element > 0) call differentiate(foil, place, list(place%surface), slope(place%surface)%value)
      allocate (force(foil%local_unknowns()))
      call foil%gather_forces(slope, force)
      associate (mine => rate(foil%first + 1:foil%first + size(force)))
        mine = mine + force
      end associate
    end select
  end subroutine add_stress_rates

  !> Derivatives of the von Mises stress at a place by the displacements of its element's nodes: the stresses of unit
  !> displacements, for they are proportional.
  subroutine differentiate(foil, place, one, slope)
    class(meshed_foil_type), intent(in) :: foil
    type(stress_place_type), intent(in) :: place
    type(moved_surface_type), intent(in) :: one !! the surface of the place
    real(wp), intent(inout) :: slope(:, :) !! (5, local nodes) 0 on entry [Pa/m], [Pa]
    type(moved_surface_type) :: unit
    real(wp) :: by_component(3)
    integer :: i, k

    by_component = von_mises_rates(stress_there(foil, place, one))
    unit = one
    unit%moved = 0.0_wp
    associate (surface => one%surface)
      associate (node => surface%local_node(surface%mesh%element_nodes(:, surface%my_elements(place%element))))
        do i = 1, size(node)
          do k = 1, size(slope, 1)
            unit%moved(k, node(i)) = 1.0_wp
            slope(k, node(i)) = dot_product(by_component, stress_there(foil, place, unit))
            unit%moved(k, node(i)) = 0.0_wp
          end do
        end do
      end associate
    end associate
  end subroutine differentiate
end module gfb_largest_stress
