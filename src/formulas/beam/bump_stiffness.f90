!> Closed forms for the stiffness of a single bump.
module gfb_bump_stiffness
  use gfb_kinds, only: wp
  implicit none (type, external)
  private
  public :: walowit_anno_stiffness

contains

  !> Stiffness of a bump foil per area of bearing, feet free to slide, no friction.
  !>
  !> $$ K = \frac{E t^3}{2 (1 - \nu^2) l^3 s} $$
  !>
  !> Source: [WalowitAnno1975], as used by [Heshmat1983].
  elemental function walowit_anno_stiffness(youngs_modulus, poissons_ratio, thickness, &
                                            half_length, pitch) result(stiffness)
    real(wp), intent(in) :: youngs_modulus !! E [Pa]
    real(wp), intent(in) :: poissons_ratio !! nu [1]
    real(wp), intent(in) :: thickness      !! t, of the bump foil [m]
    real(wp), intent(in) :: half_length    !! l, half the chord of the arc [m]
    real(wp), intent(in) :: pitch          !! s, from bump to bump [m]
    real(wp) :: stiffness                  !! pressure over deflection [N/m3]

    stiffness = youngs_modulus*thickness**3/ &
      (2.0_wp*(1.0_wp - poissons_ratio**2)*half_length**3*pitch)
  end function walowit_anno_stiffness
end module gfb_bump_stiffness
