!> How many zeros of an analytic function lie in a circle about a real centre, beside those that
!> are known.
!>
!> The function is real on the real axis, so its zeros are real or come in conjugate pairs, and the
!> upper half of the circle is enough. With the known zeros \( \lambda_j \) divided out,
!>
!> $$ g(\lambda) = f(\lambda) / \prod_j (\lambda - \lambda_j), $$
!>
!> the phase of g changes by \( \pi \) times the number of zeros left inside while \( \lambda \)
!> goes along the upper half of the circle (argument principle). Thousands of zeros far outside
!> change it, too, but not between the ends of the half circle; nearly all of that is \( a \sin
!> \theta \), with the same a as in the modulus, \( a \cos \theta \), whose ends give it: it is
!> taken away. The half circle is divided until no step changes what is left by more than a fixed
!> angle; a zero that is not known and lies next to the circle makes a step of about half a turn
!> and is not passed over. Where the phase turns fast steps are compared with those beside them: one
!> that hides a whole turn is unlike them.
module gfb_zero_count
  use gfb_kinds, only: wp
  use gfb_units, only: pi
  implicit none (type, external)
  private
  public :: circle_between

  integer, parameter :: first_steps = 16 !! of the half circle
  !> Of the phase; five times as much would not be seen.
  real(wp), parameter :: largest_step = pi/3.0_wp
  !> Of the way: there the circle runs through a zero.
  real(wp), parameter :: smallest_step = 1.0e-6_wp*pi
  integer, parameter, public :: most_places = 400 !! more mean that the phase has no sense

  !> The half circle and what is known along it. Fill the first three, then ask for places and
  !> give values.
  type, public :: mode_count_type
    real(wp) :: centre = 0.0_wp           !! [1/s]
    real(wp) :: radius = 0.0_wp           !! [1/s]
    complex(wp), allocatable :: known(:)  !! zeros, one of each conjugate pair [1/s]
    integer :: steps = first_steps        !! in which the half circle is divided at first
    logical :: compares = .false.         !! steps beside each other must turn the phase alike
    integer, private :: at_centre = 0     !! zeros that are known as well
    real(wp), allocatable :: angle(:)     !! of the places so far, rising from 0 to pi [rad]
    complex(wp), allocatable :: value(:)  !! logarithm of g there [1]
    logical :: failed = .false.           !! the circle runs through a zero
  contains
    procedure :: next, tell, place, missing, put_at_centre, mean
  end type mode_count_type

contains

  !> Where the function is to be evaluated next; negative where the count is complete or has failed.
  pure function next(count) result(angle)
    class(mode_count_type), intent(in) :: count
    real(wp) :: angle !! along the half circle [rad]
    integer :: i

    angle = -1.0_wp
    if (count%failed) return
    if (.not. allocated(count%angle)) then
      angle = 0.0_wp
    else if (size(count%angle) <= count%steps) then
      angle = pi*real(size(count%angle), wp)/real(count%steps, wp)
    else
      do i = 2, size(count%angle)
        if (abs(step(count, i)) <= largest_step) cycle
        angle = 0.5_wp*(count%angle(i - 1) + count%angle(i))
        return
      end do
      if (count%compares) angle = unlike_neighbour(count)
    end if
  end function next

  !> The middle of a step that turns the phase unlike the one beside it, which may hide a whole
  !> turn; negative where there is none.
  pure function unlike_neighbour(count) result(angle)
    class(mode_count_type), intent(in) :: count
    real(wp) :: angle !! [rad]
    real(wp) :: width(2)
    integer :: i

    angle = -1.0_wp
    do i = 3, size(count%angle)
      width = count%angle(i - 1:i) - count%angle(i - 2:i - 1)
      if (abs(step(count, i - 1)/width(1) - step(count, i)/width(2))*maxval(width) <= &
          largest_step) cycle
      angle = count%angle(i - 1) + 0.5_wp*merge(width(2), -width(1), width(2) > width(1))
      return
    end do
  end function unlike_neighbour

  !> A place of the half circle.
  pure function place(count, angle) result(rate)
    class(mode_count_type), intent(in) :: count
    real(wp), intent(in) :: angle !! along the half circle [rad]
    complex(wp) :: rate !! [1/s]

    rate = count%centre + count%radius*cmplx(cos(angle), sin(angle), wp)
    if (angle <= 0.0_wp .or. angle >= pi) rate = real(rate, wp)
  end function place

  !> Takes the function's value.
  pure subroutine tell(count, angle, logarithm)
    class(mode_count_type), intent(inout) :: count
    real(wp), intent(in) :: angle !! that was asked for [rad]
    complex(wp), intent(in) :: logarithm !! of f there, up to multiples of 2 pi i [1]
    complex(wp) :: left
    integer :: i, before

    left = logarithm - count%at_centre*log(count%place(angle) - count%centre)
    do i = 1, size(count%known)
      left = left - log(count%place(angle) - count%known(i))
      if (aimag(count%known(i)) <= 0.0_wp) cycle
      left = left - log(count%place(angle) - conjg(count%known(i)))
    end do
    if (.not. allocated(count%angle)) allocate (count%angle(0), count%value(0))
    before = findloc(count%angle < angle, .true., 1, back=.true.)
    count%angle = [count%angle(:before), angle, count%angle(before + 1:)]
    count%value = [count%value(:before), left, count%value(before + 1:)]
    count%failed = size(count%angle) > most_places
    if (before > 0) count%failed = count%failed .or. angle - count%angle(before) < smallest_step
  end subroutine tell

  !> Mean of the logarithm's real part along the circle, from its first places.
  pure real(wp) function mean(count)
    class(mode_count_type), intent(in) :: count
    associate (level => real(count%value, wp), last => size(count%value))
      mean = (sum(level(2:last - 1)) + 0.5_wp*(level(1) + level(last)))/real(last - 1, wp)
    end associate
  end function mean

  !> Takes a number of zeros to lie at the centre; values that were given follow.
  pure subroutine put_at_centre(count, zeros)
    class(mode_count_type), intent(inout) :: count
    integer, intent(in) :: zeros !! all of them, those of before too
    integer :: i

    if (allocated(count%angle)) then
      do i = 1, size(count%angle)
        count%value(i) = count%value(i) &
          - (zeros - count%at_centre)*log(count%place(count%angle(i)) - count%centre)
      end do
    end if
    count%at_centre = zeros
  end subroutine put_at_centre

  !> Zeros in the circle that are not known, where the count is complete; each of a conjugate
  !> pair counts.
  pure function missing(count) result(zeros)
    class(mode_count_type), intent(in) :: count
    integer :: zeros, i
    zeros = nint(sum([(step(count, i), i=2, size(count%angle))])/pi)
  end function missing

  !> Radius of a circle in the widest gap between rates.
  pure function circle_between(rate, centre, limits) result(radius)
    complex(wp), intent(in) :: rate(:) !! that are known [1/s]
    real(wp), intent(in) :: centre     !! of the circle [1/s]
    real(wp), intent(in) :: limits(2)  !! least and largest radius [1/s]
    real(wp) :: radius !! [1/s]
    real(wp) :: widest, last, next
    integer :: i

    widest = 0.0_wp
    radius = limits(1)
    last = limits(1)
    do while (last < limits(2))
      next = limits(2)
      do i = 1, size(rate)
        associate (distance => abs(rate(i) - centre))
          if (distance > last) next = min(next, distance)
        end associate
      end do
      if (next - last > widest) then
        widest = next - last
        radius = 0.5_wp*(last + next)
      end if
      last = next
    end do
  end function circle_between

  !> How the phase changes from the place before, by less than half a turn, without the share of
  !> zeros far outside.
  pure function step(count, i) result(change)
    class(mode_count_type), intent(in) :: count
    integer, intent(in) :: i !! number of the place
    real(wp) :: change !! [rad]
    real(wp) :: outside

    associate (angle => count%angle, value => count%value)
      outside = 0.5_wp*real(value(1) - value(size(value)), wp)
      change = aimag(value(i) - value(i - 1)) - outside*(sin(angle(i)) - sin(angle(i - 1)))
    end associate
    change = modulo(change + pi, 2.0_wp*pi) - pi
  end function step
end module gfb_zero_count
