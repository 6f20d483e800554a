!> How a motion of the shaft opens the gap: the one place that knows the journal's kinematics.
!>
!> The gap of a rigid sleeve is \( h_r = C + b(\theta, z) \cdot q \) with the sleeve's coordinates
!> relative to the shaft, \( q = (e_x, e_y, e_z, \phi_x, \phi_y) \), and
!>
!> $$ b = \frac{\partial h}{\partial q} =
!>    [\cos\theta, \sin\theta, 0, -z \sin\theta, z \cos\theta] $$
!>
!> Source: [Gu2020] eq. 12. As printed there \( \phi_x \) stands with the cosine; the text of its
!> section 4.3 fits only with the two exchanged, as here. Forces and torques on the sleeve are
!> conjugate to q: a pressure p has the power \( p \, b \cdot \dot q \) an area. Another bearing, a
!> thrust bearing say, is another b.
module gfb_shaft_motion
  use gfb_kinds, only: wp
  use gfb_film_geometry, only: film_shapes
  implicit none (type, external)
  private
  public :: shaft_motion, point_motions, motion_excess, entraining_speed

  integer, parameter, public :: shaft_coordinates = 5 !! e_x, e_y, e_z [m], phi_x, phi_y [rad]
  integer, parameter, public :: translations = 3      !! those of them before the tilts
  integer, parameter, public :: journal_motions = 4   !! that change the gap of a journal
  integer, parameter, public :: journal_coordinates(journal_motions) = [1, 2, 4, 5] !! which these are

contains

  !> The gap's derivatives by the shaft's coordinates at one place.
  pure function shaft_motion(angle, axial) result(motion)
    real(wp), intent(in) :: angle !! theta [rad]
    real(wp), intent(in) :: axial !! z, zero at the midplane [m]
    real(wp) :: motion(shaft_coordinates) !! b [1], [m]

    motion = [cos(angle), sin(angle), 0.0_wp, -axial*sin(angle), axial*cos(angle)]
  end function shaft_motion

  !> The same at the Gauss points of an element.
  pure function point_motions(angle, axial) result(motion)
    real(wp), intent(in) :: angle(:)           !! theta of the nodes, unwound [rad]
    real(wp), intent(in) :: axial(size(angle)) !! z of the nodes [m]
    real(wp) :: motion(shaft_coordinates, size(angle)) !! (coordinates, points) [1], [m]
    real(wp) :: shapes(size(angle), size(angle))
    integer :: point

    shapes = film_shapes(size(angle))
    do point = 1, size(angle)
      associate (shape => shapes(:, point))
        motion(:, point) = shaft_motion(dot_product(shape, angle), dot_product(shape, axial))
      end associate
    end do
  end function point_motions

  !> What these have beyond those that the shape functions make of the nodes' values: a rigid gap is
  !> taken where it is, at the points.
  pure function motion_excess(angle, axial) result(excess)
    real(wp), intent(in) :: angle(:)           !! theta of the nodes, unwound [rad]
    real(wp), intent(in) :: axial(size(angle)) !! z of the nodes [m]
    real(wp) :: excess(shaft_coordinates, size(angle)) !! (coordinates, points) [1], [m]
    real(wp) :: nodal(shaft_coordinates, size(angle)), shapes(size(angle), size(angle))
    integer :: i

    shapes = film_shapes(size(angle))
    do i = 1, size(angle)
      nodal(:, i) = shaft_motion(angle(i), axial(i))
    end do
    excess = point_motions(angle, axial)
    do i = 1, size(angle)
      excess(:, i) = excess(:, i) - matmul(nodal, shapes(:, i))
    end do
  end function motion_excess

  !> Mean speed U of the shaft's surface and the sleeve's, which rests: it drags the gas along.
  elemental function entraining_speed(speed, radius) result(entraining)
    real(wp), intent(in) :: speed  !! of the shaft [rad/s]
    real(wp), intent(in) :: radius !! of the bearing [m]
    real(wp) :: entraining         !! U [m/s]

    entraining = 0.5_wp*speed*radius
  end function entraining_speed
end module gfb_shaft_motion
