#include "gfb_petsc.h"
!> Room for a film before anything is solved: where a shaft may stand so that the gap is open everywhere while no foil is deflected.
!>
!> The gap is linear in the shaft's coordinates q, \( h_i = g_i + b_i \cdot q \) at node or Gauss point i. A thrust bearing's
!> runner is lifted until the smallest is open. A journal goes towards where the smallest is largest, which is found as the maximum of
!>
!> $$ -\frac{1}{\beta} \ln \sum_i e^{-\beta h_i} $$
!>
!> by Newton's method, with \( \beta \) growing: that is the smallest gap but for \( \ln(n)/\beta \).
module gfb_film_room
  use gfb_kinds, only: wp
  use gfb_petsc_session, only: largest_over_ranks, sum_over_ranks
  use gfb_film_surface, only: axial => axial_coordinate, translations
  use gfb_operating_point, only: operating_point_type
  use gfb_bearing, only: bearing_type
  implicit none (type)
  private
  public :: undeflected_gap, smallest_gap_at_rest, closing_gaps, open_place

  integer, parameter :: levels = 9          !! of beta, from `first_beta` on, each twice the one before
  integer, parameter :: steps_a_level = 8   !! Newton's
  real(wp), parameter :: first_beta = 4.0_wp  !! times the clearance [1]
  real(wp), parameter :: longest_step = 4.0_wp !! times beta [1]
  real(wp), parameter :: least_spread = 1.0e-3_wp !! of directions that are weighed, squared: a single one has none [1]
  real(wp), parameter :: kept_room = 0.25_wp  !! of the most there is, where a shaft is moved [1]

contains

  !> Gap at this rank's nodes, pad by pad, while no foil is deflected [m].
  pure function undeflected_gap(bearing, point) result(gap)
    class(bearing_type), intent(in) :: bearing !! pads and shaft
    type(operating_point_type), intent(in) :: point !! whose place counts
    real(wp) :: gap(bearing%film_nodes())
    integer :: i

    gap = 0.0_wp
    do i = 1, size(bearing%pad)
      associate (pad => bearing%pad(i))
        gap(pad%first_node + 1:pad%last_node) = pad%film%gap(point, gap(pad%first_node + 1:pad%last_node))
      end associate
    end do
  end function undeflected_gap

  !> Smallest gap while no foil is deflected, of the pads on one side of the runner or of all [m].
  function smallest_gap_at_rest(bearing, point, facing) result(smallest)
    class(bearing_type), intent(in) :: bearing !! pads and shaft
    type(operating_point_type), intent(in) :: point !! whose place counts
    real(wp), intent(in), optional :: facing !! 1 or -1, the side; default: both
    real(wp) :: smallest
    real(wp), allocatable :: gap(:), motion(:, :)
    real(wp) :: least(1)

    call gather_gaps(bearing, point, gap, motion, facing)
    least = largest_over_ranks([maxval([-huge(1.0_wp), -gap])])
    smallest = -least(1)
  end function smallest_gap_at_rest

  !> Axial gaps at which a tilted runner meets the pads that it faces, and, of two bearings, those behind it; where it is aligned
  !> they are none [m].
  function closing_gaps(bearing, point, play) result(closing)
    class(bearing_type), intent(in) :: bearing !! of thrust
    type(operating_point_type), intent(in) :: point !! whose tilt counts
    real(wp), intent(in) :: play !! of a runner between two bearings, else 0 [m]
    real(wp) :: closing(2)
    type(operating_point_type) :: at_middle

    closing = 0.0_wp
    if (.not. any(abs(point%place(translations + 1:)) > 0.0_wp)) return
    at_middle = point
    at_middle%place(axial) = 0.0_wp
    closing = [-smallest_gap_at_rest(bearing, at_middle, 1.0_wp), 0.0_wp]
    if (play > 0.0_wp) closing(2) = play - smallest_gap_at_rest(bearing, at_middle, -1.0_wp)
    closing = max(closing, 0.0_wp)
  end function closing_gaps

  !> The place of a journal's shaft, or one as near to it as leaves the film open; none where its tilt closes the film everywhere.
  subroutine open_place(bearing, point, place, exists)
    class(bearing_type), intent(in) :: bearing !! a journal's
    type(operating_point_type), intent(in) :: point !! whose place is wanted
    real(wp), intent(out) :: place(2) !! eccentricity [m]
    logical, intent(out) :: exists
    real(wp), allocatable :: gap(:), motion(:, :)
    real(wp) :: roomiest(2), room, share(1)

    call gather_gaps(bearing, point, gap, motion)
    place = point%place(:2)
    share = largest_over_ranks([maxval([-huge(1.0_wp), -gap])])
    exists = share(1) < 0.0_wp
    if (exists) return
    gap = gap - matmul(place, motion)
    call find_roomiest(gap, motion, bearing%clearance, roomiest, room)
    exists = room > 0.0_wp
    if (.not. exists) return
    associate (here => gap + matmul(place, motion), there => gap + matmul(roomiest, motion))
      ! From there to here each gap is linear: the first that has a part left of the room ends the way.
      share = -largest_over_ranks([maxval([-1.0_wp, -pack((there - kept_room*room)/max(there - here, tiny(1.0_wp)), here < there)])])
    end associate
    place = roomiest + share(1)*(place - roomiest)
  end subroutine open_place

  !> Gaps at this rank's nodes and Gauss points while no foil is deflected, and their derivatives by the eccentricity.
  subroutine gather_gaps(bearing, point, gap, motion, facing)
    class(bearing_type), intent(in) :: bearing
    type(operating_point_type), intent(in) :: point
    real(wp), allocatable, intent(out) :: gap(:)       !! [m]
    real(wp), allocatable, intent(out) :: motion(:, :) !! (2, places) [1]
    real(wp), intent(in), optional :: facing !! side of the runner; default: both
    real(wp), allocatable :: nodal(:), excess(:)
    integer :: i, element, n, places, first

    places = 0
    do i = 1, size(bearing%pad)
      associate (film => bearing%pad(i)%film)
        places = places + size(film%angle) + size(film%shape, 2)*size(film%element_nodes, 2)
      end associate
    end do
    allocate (gap(places), motion(2, places))
    places = 0
    do i = 1, size(bearing%pad)
      associate (film => bearing%pad(i)%film)
        if (present(facing)) then
          if (film%surface%facing*facing < 0.0_wp) cycle
        end if
        n = size(film%angle)
        nodal = film%gap(point, spread(0.0_wp, 1, n))
        gap(places + 1:places + n) = nodal
        motion(:, places + 1:places + n) = film%motion(:2, :)
        places = places + n
        n = size(film%shape, 2)
        do element = 1, size(film%element_nodes, 2)
          first = places + (element - 1)*n
          excess = film%excess(element, point)
          gap(first + 1:first + n) = matmul(nodal(film%element_nodes(:, element)), film%shape) + excess(:n)
          motion(:, first + 1:first + n) = film%point_motion(:2, :, element)
        end do
        places = places + n*size(film%element_nodes, 2)
      end associate
    end do
    gap = gap(:places)
    motion = motion(:, :places)
  end subroutine gather_gaps

  !> Where the smallest gap is largest; not beyond a place where it is the clearance.
  subroutine find_roomiest(gap, motion, clearance, place, room)
    real(wp), intent(in) :: gap(:) !! at this rank's places, of a centred shaft [m]
    real(wp), intent(in) :: motion(:, :) !! (2, places) derivatives [1]
    real(wp), intent(in) :: clearance !! [m]
    real(wp), intent(out) :: place(2) !! eccentricity [m]
    real(wp), intent(out) :: room     !! the smallest gap there [m]
    real(wp) :: here(2), beta, sums(6), mean(2), spread_by(2, 2), step(2), least(1)
    real(wp), allocatable :: there(:), weight(:)
    integer :: level, i

    here = 0.0_wp
    place = 0.0_wp
    room = -huge(1.0_wp)
    do level = 1, levels
      beta = first_beta*2.0_wp**(level - 1)/clearance
      do i = 1, steps_a_level
        there = gap + matmul(here, motion)
        least = -largest_over_ranks([maxval([-huge(1.0_wp), -there])])
        if (least(1) > room) then
          room = least(1)
          place = here
        end if
        if (room >= clearance) return
        weight = exp(-beta*(there - least(1)))
        sums = sum_over_ranks([sum(weight), matmul(motion, weight), matmul(motion**2, weight), sum(motion(1, :)*motion(2, :)*weight)])
        mean = sums(2:3)/sums(1)
        spread_by(:, 1) = [sums(4), sums(6)]/sums(1) - mean*mean(1)
        spread_by(:, 2) = [sums(6), sums(5)]/sums(1) - mean*mean(2)
        spread_by(1, 1) = spread_by(1, 1) + least_spread
        spread_by(2, 2) = spread_by(2, 2) + least_spread
        step = [spread_by(2, 2)*mean(1) - spread_by(1, 2)*mean(2), spread_by(1, 1)*mean(2) - spread_by(2, 1)*mean(1)]/ &
          ((spread_by(1, 1)*spread_by(2, 2) - spread_by(1, 2)*spread_by(2, 1))*beta)
        here = here + step*min(1.0_wp, longest_step/(beta*max(norm2(step), tiny(1.0_wp))))
      end do
    end do
  end subroutine find_roomiest
end module gfb_film_room
