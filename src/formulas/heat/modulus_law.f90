!> Young's modulus over the temperature, as its ratio to the one that is typed.
!>
!> Straight lines between the rows of a table; beyond its ends the ratio of the nearest row. A slope
!> about a temperature is a table of two rows.
module gfb_modulus_law
  use gfb_kinds, only: wp
  implicit none (type, external)
  private
  public :: slope_law, is_usual_modulus

  real(wp), parameter, public :: least_ratio = 0.1_wp !! at which a slope ends [1]

  !> what is left of the modulus of metals below their melting points [1]
  real(wp), parameter :: usual(2) = [0.2_wp, 1.2_wp]
  character(len=*), parameter, public :: usual_words = '0.2 to 1.2'

  !> Rows of a table; none: the modulus does not change.
  type, public :: modulus_law_type
    real(wp), allocatable :: temperature(:) !! strictly rising, two at least [K]
    real(wp), allocatable :: ratio(:)       !! there, positive [1]
  contains
    procedure, non_overridable :: is_given, at, covers
  end type modulus_law_type

contains

  !> The line \( 1 + s (T - T_0) \) between two temperatures, where it is above its least ratio.
  pure function slope_law(slope, reference, coldest, hottest) result(law)
    real(wp), intent(in) :: slope     !! s [1/K]
    real(wp), intent(in) :: reference !! T_0 [K]
    real(wp), intent(in) :: coldest, hottest !! where the line ends [K]
    type(modulus_law_type) :: law

    law%temperature = [coldest, hottest]
    if (slope > 0.0_wp) then
      law%temperature(1) = max(coldest, reference + (least_ratio - 1.0_wp)/slope)
    else if (slope < 0.0_wp) then
      law%temperature(2) = min(hottest, reference + (least_ratio - 1.0_wp)/slope)
    end if
    law%ratio = 1.0_wp + slope*(law%temperature - reference)
  end function slope_law

  !> Whether foils have such a modulus somewhere.
  elemental logical function is_usual_modulus(ratio) result(is_usual)
    real(wp), intent(in) :: ratio !! over the one that is typed [1]
    is_usual = ratio >= usual(1) .and. ratio <= usual(2)
  end function is_usual_modulus

  !> Whether the modulus changes with the temperature.
  pure logical function is_given(self)
    class(modulus_law_type), intent(in) :: self !! the law
    is_given = allocated(self%temperature)
  end function is_given

  !> The ratio at a temperature, and its derivative by it [1], [1/K].
  pure function at(self, temperature) result(ratio_and_rate)
    class(modulus_law_type), intent(in) :: self !! the law, with a table
    real(wp), intent(in) :: temperature !! T [K]
    real(wp) :: ratio_and_rate(2)
    integer :: i

    associate (t => self%temperature, ratio => self%ratio, last => size(self%temperature))
      if (temperature <= t(1)) then
        ratio_and_rate = [ratio(1), 0.0_wp]
      else if (temperature >= t(last)) then
        ratio_and_rate = [ratio(last), 0.0_wp]
      else
        i = count(t(:last - 1) <= temperature)
        associate (slope => (ratio(i + 1) - ratio(i))/(t(i + 1) - t(i)))
          ratio_and_rate = [ratio(i) + slope*(temperature - t(i)), slope]
        end associate
      end if
    end associate
  end function at

  !> Whether a temperature lies between the ends of the table.
  pure logical function covers(self, temperature)
    class(modulus_law_type), intent(in) :: self !! the law, with a table
    real(wp), intent(in) :: temperature !! [K]
    covers = temperature >= self%temperature(1) .and. &
             temperature <= self%temperature(size(self%temperature))
  end function covers
end module gfb_modulus_law
