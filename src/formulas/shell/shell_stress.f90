!> Stresses of the shell element, recovered from its displacements.
module gfb_shell_stress
  use gfb_kinds, only: wp
  use gfb_errors, only: error_type
  use gfb_shell_geometry, only: shell_geometry_type, shell_section_type, shell_lamina_type, &
                                shell_nodes, shell_unknowns, check_shell, bilinear, shell_base, &
                                shell_lamina
  use gfb_shell_element, only: shear_points, shear_strains, shear_weights, lamina_strain, &
                               lamina_stress
  use gfb_shell_turn, only: shell_turn, shell_motion
  implicit none (type, external)
  private
  public :: shell_stress, von_mises

  integer, parameter, public :: lower_face = -1, upper_face = 1 !! the directors point to the upper

  !> Stresses at one point of the mid-surface.
  !>
  !> Components 11, 22, 12 in the lamina frame: 1 along the element's xi, 3 along the director, 2
  !> across.
  type, public :: shell_stress_type
    real(wp) :: frame(3, 3)                              !! the lamina's unit vectors in columns [1]
    real(wp) :: membrane(3)                              !! mean of both faces [Pa]
    real(wp) :: bending(3)                               !! half of upper less lower face [Pa]
    real(wp) :: shear(2)                                 !! mean transverse 13, 23 [Pa]
    real(wp) :: von_mises(lower_face:upper_face)         !! lower face, mid-surface, upper face [Pa]
    real(wp) :: force(3)                                 !! membrane forces N [N/m]
    real(wp) :: moment(3)                                !! bending moments M [N]
    real(wp) :: shear_force(2)                           !! transverse forces Q [N/m]
  end type shell_stress_type

contains

  !> Stresses at a point; the most accurate ones are at the centre (0, 0).
  !>
  !> $$ N = \int \sigma \, dz, \quad M = \int \sigma z \, dz, \quad Q = \int \tau \, dz $$
  !>
  !> with \( \sigma \) linear between the faces (exact up to thickness over radius):
  !> \( N = h \sigma_m, M = h^2 \sigma_b / 6 \). The transverse shear is the mean one, with the
  !> factor 5/6. It vanishes at the faces and is left out of their von Mises stress; at the
  !> mid-surface it is 3/2 of the mean, the top of the parabola, and counts.
  !>
  !> Fails as `check_shell` does.
  pure subroutine shell_stress(geometry, section, displacement, xi, eta, stress, error)
    type(shell_geometry_type), intent(in) :: geometry !! the element at its Gauss points
    type(shell_section_type), intent(in) :: section !! thickness and material of the shell
    real(wp), intent(in) :: displacement(shell_unknowns) !! u, v, w [m], alpha, beta [rad] a node
    real(wp), intent(in) :: xi, eta                      !! in [-1, 1]
    type(shell_stress_type), intent(out) :: stress !! at the Gauss points
    type(error_type), allocatable, intent(out) :: error !! what went wrong, if anything did

    real(wp), dimension(3, shell_nodes) :: translation, change, motion
    real(wp), dimension(shell_nodes) :: shape, by_xi, by_eta
    real(wp) :: tied(shear_points), weight(shear_points), base(3, 3), tensor(3, 3, -1:1)
    type(shell_lamina_type) :: lamina
    integer :: face

    call check_shell(geometry, section, error)
    if (allocated(error)) return
    call shell_motion(shell_turn(geometry, section%thickness), displacement, translation, change)
    tied = shear_strains(geometry, section%thickness, translation, change)
    weight = shear_weights(xi, eta)
    call bilinear(xi, eta, shape, by_xi, by_eta)
    do face = lower_face, upper_face
      base = shell_base(geometry, section%thickness, shape, by_xi, by_eta, real(face, wp))
      lamina = shell_lamina(base)
      motion = translation + face*change
      tensor(:, :, face) = lamina_stress(section, &
        lamina_strain(base, lamina, matmul(motion, by_xi), matmul(motion, by_eta), tied, weight))
      if (face == 0) stress%frame = lamina%frame
    end do
    call resultants(section%thickness, tensor, stress)
  end subroutine shell_stress

  !> All but the frame from the stress tensors of lower face, mid-surface and upper face.
  pure subroutine resultants(thickness, tensor, stress)
    real(wp), intent(in) :: thickness           !! h [m]
    real(wp), intent(in) :: tensor(3, 3, -1:1)  !! in the lamina frames [Pa]
    type(shell_stress_type), intent(inout) :: stress
    real(wp) :: plane(3, -1:1)
    integer :: face

    do face = lower_face, upper_face
      plane(:, face) = [tensor(1, 1, face), tensor(2, 2, face), tensor(1, 2, face)]
      stress%von_mises(face) = von_mises(plane(:, face))
    end do
    stress%membrane = 0.5_wp*(plane(:, upper_face) + plane(:, lower_face))
    stress%bending = 0.5_wp*(plane(:, upper_face) - plane(:, lower_face))
    stress%shear = tensor(1:2, 3, 0)
    stress%von_mises(0) = sqrt(stress%von_mises(0)**2 &
                               + 3.0_wp*sum((1.5_wp*stress%shear)**2))
    stress%force = thickness*stress%membrane
    stress%moment = thickness**2/6.0_wp*stress%bending
    stress%shear_force = thickness*stress%shear
  end subroutine resultants

  !> Equivalent stress of a plane state.
  !>
  !> $$ \sigma_v = \sqrt{\sigma_{11}^2 - \sigma_{11} \sigma_{22} + \sigma_{22}^2 + 3 \sigma_{12}^2}
  !> $$
  pure function von_mises(plane) result(equivalent)
    real(wp), intent(in) :: plane(3) !! components 11, 22, 12 [Pa]
    real(wp) :: equivalent           !! [Pa]

    equivalent = sqrt(plane(1)**2 - plane(1)*plane(2) + plane(2)**2 + 3.0_wp*plane(3)**2)
  end function von_mises
end module gfb_shell_stress
