!> Solid contact of a rough shaft with the foil, or sleeve, where the film is thin.
!>
!> Asperities whose heights are spread exponentially, with mean \( \sigma \), carry
!>
!> $$ p_c(h) = p_0 e^{-h/\sigma} $$
!>
!> Source: [GreenwoodWilliamson1966]. In theirs
!> \( p_0 = \sqrt{\pi} \, \eta \beta^{1/2} \sigma^{3/2} E' \) with \( \eta \) asperities an area, of
!> tip radius \( \beta \), and the reduced modulus \( E' \). The gap stays positive as long as the
!> load is less than p_0 over the area that it presses on. Asperities rub with a constant
!> coefficient.
module gfb_solid_contact
  use gfb_kinds, only: wp
  implicit none (type, external)
  private
  public :: contact_pressure, contact_pressure_rate, contact_left

  !> The rough surfaces; without roughness they never touch.
  type, public :: solid_contact_type
    logical :: present = .false.
    real(wp) :: roughness = 0.0_wp !! sigma, mean height of both surfaces' asperities [m]
    real(wp) :: pressure = 0.0_wp  !! p_0, where the mean planes meet [Pa]
    real(wp) :: friction = 0.0_wp  !! coefficient of the asperities [1]
  end type solid_contact_type

contains

  !> Pressure of the asperities [Pa].
  elemental real(wp) function contact_pressure(contact, gap) result(pressure)
    type(solid_contact_type), intent(in) :: contact !! asperities of shaft and foil
    real(wp), intent(in) :: gap !! h [m]

    pressure = 0.0_wp
    if (contact%present) pressure = contact%pressure*exp(-gap/contact%roughness)
  end function contact_pressure

  !> Its derivative by the gap [Pa/m].
  elemental real(wp) function contact_pressure_rate(contact, gap) result(rate)
    type(solid_contact_type), intent(in) :: contact !! asperities of shaft and foil
    real(wp), intent(in) :: gap !! h [m]

    rate = 0.0_wp
    if (contact%present) rate = -contact_pressure(contact, gap)/contact%roughness
  end function contact_pressure_rate

  !> Part of the pressure that grooves of a share g and a depth d leave, \( 1 - g + g e^{-d/\sigma}
  !> \) at every gap [1].
  elemental real(wp) function contact_left(contact, share, depth) result(left)
    type(solid_contact_type), intent(in) :: contact !! asperities of shaft and foil
    real(wp), intent(in) :: share !! g, of the groove in the pattern [1]
    real(wp), intent(in) :: depth !! d [m]

    left = 1.0_wp
    if (share > 0.0_wp) left = 1.0_wp - share + share*exp(-depth/contact%roughness)
  end function contact_left
end module gfb_solid_contact
