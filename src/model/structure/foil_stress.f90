!> Stresses of a foil's elements: at their centres, as the files show them, and at their corners,
!> where they are largest.
!>
!> Components: membrane along the axis, across it, shear; the same of bending, half of upper less
!> lower face; at centres also von Mises at the lower and at the upper face.
module gfb_foil_stress
  use gfb_kinds, only: wp
  use gfb_errors, only: error_type
  use gfb_planar_beam, only: beam_section_type, plane_strain_section, beam_resultants, &
                             beam_unknowns, beam_end_moments, linear_beam_stiffness, &
                             bent_beam_stiffness
  use gfb_shell_geometry, only: shell_section_type, shell_unknowns, shell_nodes
  use gfb_shell_element, only: shell_stress_type, shell_stress, shell_corner_stress, von_mises, &
                               lower_face, upper_face
  use gfb_foil_surface, only: foil_surface_type
  use gfb_foil_structure, only: element_geometry, element_section
  implicit none (type, external)
  private
  public :: shell_stresses, beam_stresses, shell_corner_stresses, beam_end_stresses, face_stress, &
            find_largest

  integer, parameter :: components = 8, at_corners = 6
  integer, parameter :: in_plane(beam_unknowns) = [1, 2, 4] !! u, v and the turn about the axis

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
      value(7, i) = von_mises(face_stress(value(:, i), lower_face))
      value(8, i) = von_mises(face_stress(value(:, i), upper_face))
    end do
  end function beam_stresses

  !> Stresses of this rank's shells at their corners.
  function shell_corner_stresses(foil, moved) result(value)
    class(foil_surface_type), intent(in) :: foil !! this rank's part of a surface
    real(wp), intent(in) :: moved(:, :) !! (5, local nodes) [m], [rad]
    real(wp) :: value(at_corners, shell_nodes, size(foil%my_elements)) !! [Pa]
    integer :: i

    do i = 1, size(foil%my_elements)
      associate (nodes => foil%mesh%element_nodes(:, foil%my_elements(i)))
        value(:, :, i) = shell_corner_stress(element_geometry(foil%mesh, foil%my_elements(i)), &
                                             element_section(foil%mesh, foil%section, &
                                                             foil%my_elements(i)), &
                                             [moved(:, foil%local_node(nodes))])
      end associate
    end do
  end function shell_corner_stresses

  !> Stresses of this rank's beams at their ends. Those of bump foils are bent elements.
  pure function beam_end_stresses(foil, moved) result(value)
    class(foil_surface_type), intent(in) :: foil !! this rank's part of a surface
    real(wp), intent(in) :: moved(:, :) !! (5, local nodes), every node as its station [m], [rad]
    real(wp) :: value(at_corners, 2, size(foil%my_elements)) !! [Pa]
    type(shell_section_type) :: sheet
    type(beam_section_type) :: section
    real(wp) :: force(2), moment(2), stiffness(2*beam_unknowns, 2*beam_unknowns)
    integer :: i, k, node, ends(2)

    do i = 1, size(foil%my_elements)
      sheet = element_section(foil%mesh, foil%section, foil%my_elements(i))
      section = plane_strain_section(sheet%thickness, sheet%youngs_modulus, sheet%poissons_ratio)
      node = minval(foil%mesh%element_nodes(:, foil%my_elements(i)))
      ends = [node, node + foil%mesh%rows]
      associate (places => foil%mesh%position(:2, ends), &
                 displacement => moved(in_plane, foil%local_node(ends)))
        if (foil%has_contacts) then
          stiffness = bent_beam_stiffness(section, places)
        else
          stiffness = linear_beam_stiffness(section, places)
        end if
        force = beam_resultants(section, places, displacement)
        moment = beam_end_moments(stiffness, displacement)
      end associate
      associate (kept_width => [sheet%poissons_ratio, 1.0_wp, 0.0_wp])
        do k = 1, size(moment)
          value(:, k, i) = [force(1)/sheet%thickness*kept_width, &
                            6.0_wp*moment(k)/sheet%thickness**2*kept_width]
        end do
      end associate
    end do
  end function beam_end_stresses

  !> The largest von Mises stress at corners, and where it is; 0 where there are none.
  pure subroutine find_largest(at_corners, largest, element, corner, face)
    real(wp), intent(in) :: at_corners(:, :, :) !! (components, corners, elements) [Pa]
    real(wp), intent(out) :: largest            !! [Pa]
    integer, intent(out) :: element, corner, face !! place, `lower_face` or `upper_face`
    real(wp) :: here
    integer :: i, k, side

    largest = 0.0_wp
    element = 0
    corner = 0
    face = 0
    do i = 1, size(at_corners, 3)
      do k = 1, size(at_corners, 2)
        do side = lower_face, upper_face, 2
          here = von_mises(face_stress(at_corners(:, k, i), side))
          if (here <= largest) cycle
          largest = here
          element = i
          corner = k
          face = side
        end do
      end do
    end do
  end subroutine find_largest

  !> Stress at a face, of which the von Mises stress is taken: along the axis, across it, shear.
  pure function face_stress(value, face) result(plane)
    real(wp), intent(in) :: value(:) !! components of a point [Pa]
    integer, intent(in) :: face      !! `lower_face` or `upper_face`
    real(wp) :: plane(3)             !! [Pa]
    plane = value(1:3) + face*value(4:6)
  end function face_stress
end module gfb_foil_stress
