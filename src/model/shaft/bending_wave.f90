!> How finely the elements of a shaft divide the waves in which it bends.
module gfb_bending_wave
  use gfb_kinds, only: wp
  use gfb_units, only: turn
  use gfb_shaft, only: shaft_type
  implicit none (type, external)
  private
  public :: elements_per_wave

contains

  !> Elements a wave length at a frequency, the fewest of all sections; a wave of a slender beam,
  !> \( 2 \pi (E I/(\rho A \omega^2))^{1/4} \).
  pure real(wp) function elements_per_wave(shaft, frequency) result(fewest)
    type(shaft_type), intent(in) :: shaft
    real(wp), intent(in) :: frequency !! omega, positive [rad/s]
    integer :: i

    fewest = huge(1.0_wp)
    do i = 1, size(shaft%section)
      associate (section => shaft%section(i), length => shaft%z(i + 1) - shaft%z(i))
        fewest = min(fewest, turn*(section%bending/(section%mass*frequency**2))**0.25_wp/length)
      end associate
    end do
  end function elements_per_wave
end module gfb_bending_wave
