!> Places of a mesh's sides in one direction, finer where something small lies.
!>
!> A side lies on each centre; there elements have a given size and grow from one to the next by a
!> factor, up to the size that they have elsewhere.
!>
!> Method: with the size s(x) that an element is to have at x, the number of elements from one
!> fixed side to the next is \( N = \int dx/s \), rounded up, and sides lie where that integral
!> has equal parts. Source: equidistribution, [deBoor1974].
module gfb_graded_places
  use gfb_kinds, only: wp
  implicit none (type, external)
  private
  public :: graded_places

  integer, parameter :: samples = 400 !! of an interval between fixed sides, for the integral
  real(wp), parameter :: growth = 1.3_wp !! of an element over its neighbour at most [1]
  real(wp), parameter :: same = 1.0e-9_wp !! nearer places are one, over the whole [1]

contains

  !> Sides from the first to the last of a mesh, with one on each centre and on each that is kept.
  pure function graded_places(side, kept, centre, finest) result(place)
    real(wp), intent(in) :: side(:)   !! as they would be, rising [SI]
    real(wp), intent(in) :: kept(:)   !! sides to keep, in any order [SI]
    real(wp), intent(in) :: centre(:) !! where elements are finest, in any order, any outside [SI]
    real(wp), intent(in) :: finest    !! size of an element there [SI]
    real(wp), allocatable :: place(:)
    real(wp), allocatable :: fixed(:)
    integer :: i

    fixed = fixed_sides(side([1, size(side)]), [kept, centre])
    place = fixed(:1)
    do i = 1, size(fixed) - 1
      place = [place, between(fixed(i), fixed(i + 1), side, centre, finest)]
    end do
  end function graded_places

  !> The ends and what lies between, rising, without what is as good as the same.
  pure function fixed_sides(ends, others) result(fixed)
    real(wp), intent(in) :: ends(2), others(:)
    real(wp), allocatable :: fixed(:)
    real(wp) :: next, nearest

    nearest = same*(ends(2) - ends(1))
    fixed = ends(:1)
    do
      next = minval([ends(2), pack(others, others > fixed(size(fixed)) + nearest)])
      if (next > ends(2) - nearest) exit
      fixed = [fixed, next]
    end do
    fixed = [fixed, ends(2)]
  end function fixed_sides

  !> Sides behind one that is fixed, up to the next.
  pure function between(first, last, side, centre, finest) result(place)
    real(wp), intent(in) :: first, last
    real(wp), intent(in) :: side(:), centre(:), finest
    real(wp), allocatable :: place(:)
    real(wp) :: number(0:samples), step, wanted
    integer :: i, k, n

    step = (last - first)/real(samples, wp)
    number(0) = 0.0_wp
    do k = 1, samples
      number(k) = number(k - 1) &
        + step/size_at(first + step*(real(k, wp) - 0.5_wp), side, centre, finest)
    end do
    n = max(1, ceiling(number(samples)*(1.0_wp - same)))
    allocate (place(n))
    k = 1
    do i = 1, n - 1
      wanted = number(samples)*real(i, wp)/real(n, wp)
      do while (number(k) < wanted)
        k = k + 1
      end do
      place(i) = first + step*(real(k, wp) - (number(k) - wanted)/(number(k) - number(k - 1)))
    end do
    place(n) = last
  end function between

  !> Size that an element is to have at a place.
  pure real(wp) function size_at(place, side, centre, finest) result(wanted)
    real(wp), intent(in) :: place
    real(wp), intent(in) :: side(:), centre(:), finest
    integer :: i

    i = min(max(count(side <= place), 1), size(side) - 1)
    wanted = side(i + 1) - side(i)
    if (size(centre) == 0) return
    wanted = min(wanted, finest + (growth - 1.0_wp)*minval(abs(centre - place)))
  end function size_at
end module gfb_graded_places
