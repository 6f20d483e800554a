!> Film thickness between a tilted shaft and an undeformed sleeve.
module gfb_film_gap
  use gfb_kinds, only: wp
  implicit none (type, external)
  private
  public :: rigid_gap, gap_towards

contains

  !> Gap at one point without foil deflection.
  !>
  !> $$ h_r = C + (e_x + z \phi_y) \cos\theta + (e_y - z \phi_x) \sin\theta $$
  !>
  !> Source: [Gu2020] eq. 12; see `gfb_shaft_motion`, which has its derivatives.
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

    gap = gap_towards(cos(angle), sin(angle), axial, clearance, eccentricity_x, eccentricity_y, &
                      tilt_x, tilt_y)
  end function rigid_gap

  !> The same where cosine and sine of the angle are known.
  elemental function gap_towards(cosine, sine, axial, clearance, eccentricity_x, eccentricity_y, &
                                 tilt_x, tilt_y) result(gap)
    real(wp), intent(in) :: cosine, sine   !! of theta [1]
    real(wp), intent(in) :: axial          !! z, zero at the midplane [m]
    real(wp), intent(in) :: clearance      !! C [m]
    real(wp), intent(in) :: eccentricity_x !! of the sleeve relative to the shaft [m]
    real(wp), intent(in) :: eccentricity_y !! of the sleeve relative to the shaft [m]
    real(wp), intent(in) :: tilt_x         !! of the sleeve relative to the shaft about x [rad]
    real(wp), intent(in) :: tilt_y         !! of the sleeve relative to the shaft about y [rad]
    real(wp) :: gap                        !! h_r [m]

    gap = clearance + (eccentricity_x + axial*tilt_y)*cosine + (eccentricity_y - axial*tilt_x)*sine
  end function gap_towards
end module gfb_film_gap
