!> Heights of bumps as they are made: random deviations, and the gaps that they leave at the crests.
module gfb_bump_heights
  use gfb_kinds, only: wp, long
  use gfb_units, only: turn
  implicit none (type, external)
  private
  public :: normal_deviations, even_deviations, crest_gaps

  ! Two multiplicative generators whose difference is taken, [LEcuyer1988]; products fit in 63 bits.
  integer(long), parameter :: modulus(2) = [2147483563_long, 2147483399_long]
  integer(long), parameter :: factor(2) = [40014_long, 40692_long]
  integer(long), parameter :: heights = 12345_long, values = 1234567_long !! where they start
  integer, parameter :: unused = 20 !! first numbers of near seeds are near

contains

  !> Independent numbers of the standard normal law; a seed gives the same ones everywhere.
  !>
  !> $$ x = \sqrt{-2 \ln u_1} \cos 2 \pi u_2 $$
  !>
  !> Source: [BoxMuller1958].
  pure function normal_deviations(seed, count) result(deviation)
    integer, intent(in) :: seed  !! not negative
    integer, intent(in) :: count !! of the numbers
    real(wp) :: deviation(count) !! [1]
    integer(long) :: state(2)
    real(wp) :: first, second
    integer :: i

    state = first_state(seed, heights)
    do i = 1, count
      call next_number(state, first)
      call next_number(state, second)
      deviation(i) = sqrt(-2.0_wp*log(first))*cos(turn*second)
    end do
  end function normal_deviations

  !> Independent numbers between -1 and 1, each as likely as any other; a seed gives the same ones
  !> everywhere, and none of those that `normal_deviations` takes.
  pure function even_deviations(seed, count) result(deviation)
    integer, intent(in) :: seed  !! not negative
    integer, intent(in) :: count !! of the numbers
    real(wp) :: deviation(count) !! [1]
    integer(long) :: state(2)
    integer :: i

    state = first_state(seed, values)
    do i = 1, count
      call next_number(state, deviation(i))
    end do
    deviation = 2.0_wp*deviation - 1.0_wp
  end function even_deviations

  !> Where the generators begin.
  pure function first_state(seed, start) result(state)
    integer, intent(in) :: seed         !! not negative
    integer(long), intent(in) :: start  !! of the second generator, for the seed 0
    integer(long) :: state(2)
    real(wp) :: number
    integer :: i

    state = int(seed, long)*[1_long, 69069_long] + [0_long, start]
    state = 1_long + modulo(state, modulus - 1_long)
    do i = 1, unused
      call next_number(state, number)
    end do
  end function first_state

  !> The next number between 0 and 1, both excluded.
  pure subroutine next_number(state, number)
    integer(long), intent(inout) :: state(2)
    real(wp), intent(out) :: number
    integer(long) :: difference

    state = modulo(factor*state, modulus)
    difference = modulo(state(1) - state(2), modulus(1) - 1_long)
    if (difference == 0) difference = modulus(1) - 1_long
    number = real(difference, wp)/real(modulus(1), wp)
  end subroutine next_number

  !> Gaps under a straight foil or plate that lies on the highest bump.
  pure function crest_gaps(deviation) result(gap)
    real(wp), intent(in) :: deviation(:) !! of the heights from the mean, one a bump [m]
    real(wp) :: gap(size(deviation))     !! [m]
    gap = maxval(deviation) - deviation
  end function crest_gaps
end module gfb_bump_heights
