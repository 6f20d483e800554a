!> Exact stiffness of a single bump as a curved beam.
module gfb_curved_bump
  use gfb_kinds, only: wp
  implicit none (type, external)
  private
  public :: curved_bump_stiffness, bump_radius, bump_half_angle, bending_stiffness, &
            walowit_anno_stiffness, known_stiffness

contains

  !> Stiffness of a bump whose feet slide against friction, pressed at its crest.
  !>
  !> $$ K = \frac{2 D b}{R_b^3 (I_1 - \mu I_2)}, \quad
  !>    I_1 = \int_0^{t_0} (\sin t_0 - \sin\varphi)^2 d\varphi, \quad
  !>    I_2 = \int_0^{t_0} (\sin t_0 - \sin\varphi)(\cos\varphi - \cos t_0) d\varphi $$
  !>
  !> Derived by virtual work: with the angle \(\varphi\) from the crest, each foot carries P/2
  !> upwards and, while the bump is pressed, mu P/2 inwards, so the moment in half the arc is \( M =
  !> \tfrac{P}{2} R_b ((\sin t_0 - \sin\varphi) - \mu (\cos\varphi - \cos t_0)) \). A unit force on
  !> the crest of a bump on smooth feet gives \( m = \tfrac{1}{2} R_b (\sin t_0 - \sin\varphi) \),
  !> and the crest sinks by \( \frac{2}{D b} \int_0^{t_0} M m R_b d\varphi \). In closed form
  !>
  !> $$ I_1 = t_0 \sin^2 t_0 - 2 \sin t_0 (1 - \cos t_0) + \tfrac{1}{2} t_0
  !>    - \tfrac{1}{4} \sin 2 t_0, \quad
  !>    I_2 = \tfrac{1}{2} (1 - \cos t_0)(1 + 3 \cos t_0) - t_0 \sin t_0 \cos t_0 $$
  !>
  !> Exact for a circular arc that bends in plane strain without stretching or shearing, its feet
  !> free to turn. A flat bump's is Walowit and Anno's. Not positive where friction locks the feet
  !> (mu > I_1/I_2, about 0.8 l/h_b of a flat bump).
  elemental function curved_bump_stiffness(youngs_modulus, poissons_ratio, thickness, half_length, &
                                           height, width, friction) result(stiffness)
    real(wp), intent(in) :: youngs_modulus      !! E [Pa]
    real(wp), intent(in) :: poissons_ratio      !! nu [1]
    real(wp), intent(in) :: thickness           !! t, of the bump foil [m]
    real(wp), intent(in) :: half_length, height !! l, h_b, of the arc [m]
    real(wp), intent(in) :: width               !! b, along the axis [m]
    real(wp), intent(in) :: friction            !! mu, positive loading, negative unloading [1]
    real(wp) :: stiffness                       !! force on the crest over its deflection [N/m]
    real(wp) :: angle, sine, cosine, versine, integral_1, integral_2

    angle = bump_half_angle(half_length, height)
    sine = sin(angle)
    cosine = cos(angle)
    versine = 2.0_wp*sin(0.5_wp*angle)**2
    integral_1 = angle*sine**2 - 2.0_wp*sine*versine + 0.5_wp*angle - 0.25_wp*sin(2.0_wp*angle)
    integral_2 = 0.5_wp*versine*(1.0_wp + 3.0_wp*cosine) - angle*sine*cosine
    stiffness = 2.0_wp*bending_stiffness(youngs_modulus, poissons_ratio, thickness)*width/ &
      (bump_radius(half_length, height)**3*(integral_1 - friction*integral_2))
  end function curved_bump_stiffness

  !> Radius of the arc, \( R_b = (l^2 + h_b^2)/(2 h_b) \) [m].
  elemental real(wp) function bump_radius(half_length, height) result(radius)
    real(wp), intent(in) :: half_length, height !! l, h_b, of the arc [m]
    radius = (half_length**2 + height**2)/(2.0_wp*height)
  end function bump_radius

  !> Half the angle of the arc, \( t_0 = \arcsin(l/R_b) \) [rad].
  elemental real(wp) function bump_half_angle(half_length, height) result(angle)
    real(wp), intent(in) :: half_length, height !! l, h_b, of the arc [m]
    angle = 2.0_wp*atan2(height, half_length)
  end function bump_half_angle

  !> Bending stiffness of a foil in plane strain, \( D = E t^3 / (12 (1 - \nu^2)) \) [N m].
  elemental function bending_stiffness(youngs_modulus, poissons_ratio, thickness) result(stiffness)
    real(wp), intent(in) :: youngs_modulus, poissons_ratio !! E [Pa], nu [1]
    real(wp), intent(in) :: thickness                      !! t [m]
    real(wp) :: stiffness
    stiffness = youngs_modulus*thickness**3/(12.0_wp*(1.0_wp - poissons_ratio**2))
  end function bending_stiffness

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

  !> The same where numbers may be missing or out of all proportion: it is 0 then.
  elemental function known_stiffness(youngs_modulus, poissons_ratio, thickness, half_length, &
                                     pitch) result(stiffness)
    real(wp), intent(in) :: youngs_modulus !! E; 0: not known [Pa]
    real(wp), intent(in) :: poissons_ratio !! nu [1]
    real(wp), intent(in) :: thickness      !! t, of the bump foil; 0: not known [m]
    real(wp), intent(in) :: half_length    !! l, half the chord of the arc; 0: not known [m]
    real(wp), intent(in) :: pitch          !! s, from bump to bump; 0: not known [m]
    real(wp) :: stiffness                  !! pressure over deflection [N/m3]
    real(wp), parameter :: largest_power = 60.0_wp !! of ten; no foil comes near, and products hold
    real(wp) :: power

    stiffness = 0.0_wp
    if (.not. min(youngs_modulus, thickness) > 0.0_wp) return
    if (.not. min(half_length, pitch) > 0.0_wp) return
    power = log10(youngs_modulus) + 3.0_wp*log10(thickness/half_length) - log10(pitch)
    if (abs(power) > largest_power) return
    stiffness = walowit_anno_stiffness(youngs_modulus, poissons_ratio, thickness, half_length, &
                                       pitch)
  end function known_stiffness
end module gfb_curved_bump
