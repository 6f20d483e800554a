#include "gfb_petsc.h"
!> What an orbit that closes is like: its size, its multipliers, whether it is stable.
module gfb_orbit_judgement
  use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan, ieee_is_nan
  use gfb_kinds, only: wp
  use gfb_text, only: text
  use gfb_shaft_drive, only: shaft_drive_type
  use gfb_period_map, only: period_map_type, drive_at, period_of
  use gfb_shooting, only: floquet_type
  use gfb_orbit_table, only: orbit_type, extent_of, leading
  implicit none (type)
  private
  public :: judge_orbit, words_of

  real(wp), parameter :: pi = acos(-1.0_wp)
  real(wp), parameter :: micro = 1.0e6_wp
  real(wp), parameter :: known = 2.0e-5_wp !! error of a multiplier: that of differences of the map [1]

contains

  !> Fills an orbit whose places are known, and says how it is unstable; empty where it is not.
  !>
  !> A free orbit always has a multiplier of 1, that of a shift along itself, and the onset of whirl two: those nearest to 1 are
  !> left out of the judgement.
  subroutine judge_orbit(map, x, gap, floquet, neutral, orbit, loss)
    type(period_map_type), intent(in) :: map !! the map
    real(wp), intent(in) :: x(:) !! the orbit's point [1]
    real(wp), intent(in) :: gap !! the smallest one of the orbit [m]
    type(floquet_type), intent(in) :: floquet !! its multipliers, none where they are not known
    integer, intent(in) :: neutral !! multipliers that are known to be 1
    type(orbit_type), intent(inout) :: orbit !! with its places
    character(len=:), allocatable, intent(out) :: loss !! of stability
    type(shaft_drive_type) :: drive
    complex(wp) :: largest
    logical :: counts(size(floquet%value))
    real(wp) :: period, size_of, stable
    integer :: many, i

    drive = drive_at(map, x)
    period = period_of(map, x)
    counts = .true.
    do i = 1, neutral
      counts(minloc(abs(floquet%value - 1.0_wp), 1, counts)) = .false.
    end do
    size_of = ieee_value(size_of, ieee_quiet_nan)
    stable = size_of
    loss = ''
    if (size(floquet%value) > 0) then
      largest = floquet%value(maxloc(abs(floquet%value), 1, counts))
      size_of = abs(largest)
      if (size_of > 1.0_wp + known) loss = kind_of(largest)
      stable = merge(1.0_wp, 0.0_wp, loss == '')
    end if
    many = min(leading, size(floquet%value))
    orbit%multiplier(:many) = floquet%value(:many)
    associate (x_places => orbit%place(1, :map%steps), y_places => orbit%place(2, :map%steps))
      orbit%value = [drive%speed, drive%unbalance, drive%mass, period, 2.0_wp*pi/(period*drive%speed), &
                     extent_of(orbit%place(1, :)), extent_of(orbit%place(2, :)), sum(x_places)/map%steps, &
                     sum(y_places)/map%steps, gap, size_of, stable, real(map%periods, wp)]
    end associate
  end subroutine judge_orbit

  !> How an orbit with a multiplier beyond 1 leaves.
  pure function kind_of(multiplier) result(words)
    complex(wp), intent(in) :: multiplier
    character(len=:), allocatable :: words

    if (abs(aimag(multiplier)) > 0.0_wp) then
      words = 'torus (Neimark-Sacker)'
    else if (real(multiplier) > 0.0_wp) then
      words = 'real multiplier above 1'
    else
      words = 'period doubling'
    end if
  end function kind_of

  !> An orbit in words.
  function words_of(orbit, clearance, loss) result(words)
    type(orbit_type), intent(in) :: orbit !! complete
    real(wp), intent(in) :: clearance !! C [m]
    character(len=*), intent(in) :: loss !! of its stability, or none
    character(len=:), allocatable :: words

    words = 'orbit '//text(extent_of(orbit%place(1, :))*micro, 4)//' x '//text(extent_of(orbit%place(2, :))*micro, 4)// &
            ' um, over C '//text(extent_of(orbit%place(1, :))/clearance, 3)//', frequency ratio ' &
            //text(orbit%frequency_ratio(), 6)//', smallest film '//text(orbit%smallest_gap()*micro, 4)// &
            ' um'
    if (.not. ieee_is_nan(orbit%largest())) words = words//', largest multiplier '//text(orbit%largest(), 5)
    if (loss /= '') words = words//': unstable, '//loss
  end function words_of
end module gfb_orbit_judgement
