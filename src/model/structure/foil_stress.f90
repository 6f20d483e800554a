!> Stresses of a foil's elements at their centres, as the files show them.
!>
!> Components: membrane along the axis, across it, shear; the same of bending, half of upper less
!> lower face; von Mises at the lower and at the upper face.
module gfb_foil_stress
  use gfb_kinds, only: wp
  use gfb_errors, only: error_type
  use gfb_planar_beam, only: beam_section_type, plane_strain_section, beam_resultants, beam_unknowns
  use gfb_shell_geometry, only: shell_section_type, shell_unknowns
  use gfb_shell_element, only: shell_stress_type, shell_stress, von_mises, lower_face, upper_face
  use gfb_foil_surface, only: foil_surface_type
  use gfb_foil_structure, only: element_geometry, element_section
  implicit none (type, external)
  private
  public :: shell_stresses, beam_stresses

  integer, parameter :: components = 8

contains

  !> Stresses of this rank's shells.
  function shell_stresses(foil, moved) result(value)
    class(foil_surface_type), intent(in) :: foil !! this rank's part of a surface
    real(wp), intent(in) :: moved(:, :) !! (5, local nodes) [m], [rad]
    real(wp) :: value(components, size(foil%my_elements)) !! [Pa]

    type(shell_stress_type) :: stress
    type(error_type), allocatable :: error
    real(wp) :: displacement(shell_unknowns)
    integer :: i

    do i = 1, size(foil%my_elements)
      associate (nodes => foil%mesh%element_nodes(:, foil%my_elements(i)))
        displacement = reshape(moved(:, foil%local_node(nodes)), [shell_unknowns])
      end associate
      call shell_stress(element_geometry(foil%mesh, foil%my_elements(i)), &
                        element_section(foil%mesh, foil%section, foil%my_elements(i)), &
                        displacement, 0.0_wp, 0.0_wp, stress, error)
      value(:, i) = [stress%membrane, stress%bending, stress%von_mises(lower_face), &
                     stress%von_mises(upper_face)]
    end do
  end function shell_stresses

  !> Stresses of this rank's beams. They keep their width, so there is stress along the axis too.
  pure function beam_stresses(foil, moved) result(value)
    class(foil_surface_type), intent(in) :: foil !! this rank's part of a surface
    real(wp), intent(in) :: moved(:, :) !! (5, local nodes), every node as its station [m], [rad]
    real(wp) :: value(components, size(foil%my_elements)) !! [Pa]

    integer, parameter :: in_plane(beam_unknowns) = [1, 2, 4] !! u, v and the turn about the axis
    type(shell_section_type) :: sheet
    type(beam_section_type) :: section
    real(wp) :: force(2)
    integer :: i, node, ends(2)

    do i = 1, size(foil%my_elements)
      sheet = element_section(foil%mesh, foil%section, foil%my_elements(i))
      section = plane_strain_section(sheet%thickness, sheet%youngs_modulus, sheet%poissons_ratio)
      node = minval(foil%mesh%element_nodes(:, foil%my_elements(i)))
      ends = [node, node + foil%mesh%rows]
      force = beam_resultants(section, foil%mesh%position(:2, ends), &
                              moved(in_plane, foil%local_node(ends)))
      value(1:3, i) = force(1)/sheet%thickness*[sheet%poissons_ratio, 1.0_wp, 0.0_wp]
      value(4:6, i) = 6.0_wp*force(2)/sheet%thickness**2*[sheet%poissons_ratio, 1.0_wp, 0.0_wp]
      value(7, i) = von_mises(value(1:3, i) - value(4:6, i))
      value(8, i) = von_mises(value(1:3, i) + value(4:6, i))
    end do
  end function beam_stresses
end module gfb_foil_stress
