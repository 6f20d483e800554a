!> Film thickness between a tilted shaft and an undeformed sleeve.
module gfb_film_gap
  use gfb_kinds, only: wp
  use gfb_film_geometry, only: film_shapes
  implicit none (type, external)
  private
  public :: rigid_gap, rigid_gap_excess

contains

  !> Gap at one place without foil deflection.
  !>
  !> $$ h_r = C + (e_x + z \phi_y) \cos\theta + (e_y - z \phi_x) \sin\theta $$
  !>
  !> Source: [Gu2020] eq. 12. As printed there \( \phi_x \) stands with the cosine; the text of its
  !> section 4.3 fits only with the two exchanged, as here. Its derivatives with respect to
  !> \( (e_x, e_y) \) are \( (\cos\theta, \sin\theta) \).
  elemental function rigid_gap(angle, axial, clearance, eccentricity_x, eccentricity_y, &
                               tilt_x, tilt_y) result(gap)
    real(wp), intent(in) :: angle          !! theta [rad]
    real(wp), intent(in) :: axial          !! z, zero at the midplane [m]
    real(wp), intent(in) :: clearance      !! C [m]
    real(wp), intent(in) :: eccentricity_x !! of the sleeve relative to the shaft [m]
    real(wp), intent(in) :: eccentricity_y !! of the sleeve relative to the shaft [m]
    real(wp), intent(in) :: tilt_x         !! of the sleeve relative to the shaft about x [rad]
    real(wp), intent(in) :: tilt_y         !! of the sleeve relative to the shaft about y [rad]
    real(wp) :: gap                        !! h_r [m]

    gap = clearance + (eccentricity_x + axial*tilt_y)*cos(angle) &
      + (eccentricity_y - axial*tilt_x)*sin(angle)
  end function rigid_gap

  !> What the rigid gap at an element's Gauss points has beyond the one that its nodal values give.
  !>
  !> The gap is linear in eccentricity and tilt, so this gives the excess of
  !> \( \cos\theta, \sin\theta, z\cos\theta, z\sin\theta \), to be multiplied with
  !> \( e_x, e_y, \phi_y, -\phi_x \).
  pure function rigid_gap_excess(angle, axial) result(excess)
    real(wp), intent(in) :: angle(:)          !! theta of the nodes [rad]
    real(wp), intent(in) :: axial(size(angle)) !! z of the nodes [m]
    real(wp) :: excess(4, size(angle))        !! (4, points) [1], [1], [m], [m]
    real(wp) :: nodal(4, size(angle)), shapes(size(angle), size(angle))
    integer :: i

    shapes = film_shapes(size(angle))
    do i = 1, size(angle)
      nodal(:, i) = terms(angle(i), axial(i))
    end do
    do i = 1, size(angle)
      associate (shape => shapes(:, i))
        excess(:, i) = terms(dot_product(shape, angle), dot_product(shape, axial)) &
          - matmul(nodal, shape)
      end associate
    end do
  end function rigid_gap_excess

  !> What eccentricity and tilt are multiplied with in the gap.
  pure function terms(angle, axial) result(term)
    real(wp), intent(in) :: angle !! theta [rad]
    real(wp), intent(in) :: axial !! z [m]
    real(wp) :: term(4)
    term = [cos(angle), sin(angle), axial*cos(angle), axial*sin(angle)]
  end function terms
end module gfb_film_gap
