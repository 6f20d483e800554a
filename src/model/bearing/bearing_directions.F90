#include "gfb_petsc.h"
!> Directions in the space of a bearing's unknowns: of the free edge, of contacts, of the foil.
module gfb_bearing_directions
  use petscvec
  use gfb_kinds, only: wp
  use gfb_petsc_session, only: sum_over_ranks, largest_over_ranks, any_rank
  use gfb_text, only: text
  use gfb_bearing, only: bearing_type
  implicit none (type)
  private
  public :: has_free_edge, edge_words, edge_lift, edge_room, edge_force, edge_direction, contact_direction, foil_unit

contains

  !> Whether the top foil has an edge that is fixed nowhere.
  logical function has_free_edge(bearing) result(has)
    class(bearing_type), intent(in) :: bearing !! a bearing with contacts
    has = any_rank(size(bearing%pad(1)%edge%unknown) > 0)
  end function has_free_edge

  !> The free edge of a pad.
  pure function edge_words(bearing, pad) result(words)
    class(bearing_type), intent(in) :: bearing !! pads and shaft
    integer, intent(in) :: pad !! its number
    character(len=:), allocatable :: words

    words = 'the free edge of the top foil'
    if (size(bearing%pad) > 1) words = words//' of pad '//text(pad)
  end function edge_words

  !> Mean displacement of the top foil's free edge towards the shaft at the present state, of a pad or of all, over all
  !> ranks [m].
  real(wp) function edge_lift(bearing, only) result(lift)
    class(bearing_type), intent(in) :: bearing !! pads and shaft
    integer, intent(in), optional :: only !! pad
    real(wp) :: unknown(bearing%local_size()), total(1)
    integer :: first, last, i

    call bearing%get_unknowns(unknown)
    total = 0.0_wp
    call asked_pads(bearing, first, last, only)
    do i = first, last
      total = total + bearing%pad(i)%edge%lift(unknown(bearing%pad(i)%first + 1:bearing%pad(i)%last))
    end do
    total = sum_over_ranks(total)
    lift = total(1)/(last - first + 1)
  end function edge_lift

  !> The pads that are asked about: one, or all.
  pure subroutine asked_pads(bearing, first, last, only)
    class(bearing_type), intent(in) :: bearing
    integer, intent(out) :: first, last
    integer, intent(in), optional :: only

    first = 1
    last = size(bearing%pad)
    if (.not. present(only)) return
    first = only
    last = only
  end subroutine asked_pads

  !> Smallest gap over the top foil's free edge at the present state, of a pad or of all, over all ranks [m].
  real(wp) function edge_room(bearing, only) result(room)
    class(bearing_type), intent(in) :: bearing !! pads and shaft
    integer, intent(in), optional :: only !! pad
    real(wp) :: unknown(bearing%local_size()), gap(bearing%film_nodes()), smallest(1)
    integer :: first, last, i

    call bearing%get_unknowns(unknown)
    gap = bearing%gap(unknown)
    call asked_pads(bearing, first, last, only)
    smallest = largest_over_ranks([maxval([(-gap(bearing%pad(i)%first_node + bearing%pad(i)%edge%node), i=first, last)])])
    room = -smallest(1)
  end function edge_room

  !> Force of the spring that fixes the free edge of a pad's top foil at the point's height, towards the shaft [N].
  real(wp) function edge_force(bearing, pad) result(force)
    class(bearing_type), intent(in) :: bearing !! at a point with a fixed edge
    integer, intent(in) :: pad !! its number
    force = bearing%point%edge_hold(pad)*(bearing%point%edge_height(pad) - edge_lift(bearing, pad))
  end function edge_force

  !> The vector whose product with a state is that lift, of all pads or of one, over the clearance.
  subroutine edge_direction(bearing, direction, only)
    class(bearing_type), intent(in) :: bearing !! pads and shaft
    Vec, intent(in) :: direction !! scaled
    integer, intent(in), optional :: only !! pad
    real(wp) :: rate(bearing%local_size())
    PetscErrorCode :: ierr
    integer :: i

    PetscCallA(VecSet(direction, 0.0_wp, ierr))
    rate = 0.0_wp
    do i = 1, size(bearing%pad)
      associate (pad => bearing%pad(i))
        if (present(only)) then
          if (i == only) rate(pad%first + 1:pad%last) = pad%edge%lift_rates(pad%last - pad%first)
        else
          rate(pad%first + 1:pad%last) = pad%edge%lift_rates(pad%last - pad%first)/size(bearing%pad)
        end if
      end associate
    end do
    call bearing%exchange%add(rate*bearing%unknown_scale/bearing%clearance, direction)
  end subroutine edge_direction

  !> Which contacts open or close first on the path from the present state to another.
  subroutine contact_direction(bearing, other, direction, share, distance, closes)
    class(bearing_type), intent(in) :: bearing !! pads and shaft
    Vec, intent(in) :: other             !! scaled state
    Vec, intent(in) :: direction         !! its product with a state grows as they come on, over the clearance
    real(wp), intent(out) :: share       !! of the path to there; huge if there is none [1]
    real(wp), intent(out) :: distance    !! by which that product has to grow until then [1]
    logical, intent(out) :: closes       !! one of them closes
    real(wp) :: here(bearing%local_size()), ahead(bearing%local_size()), rate(bearing%local_size()), first(1), total(1)
    PetscErrorCode :: ierr
    integer :: i

    call bearing%get_unknowns(here)
    call bearing%get_unknowns(ahead, other)
    first = huge(first)
    do i = 1, size(bearing%pad)
      associate (pad => bearing%pad(i))
        first = min(first, pad%foil%next_contact_change(here(pad%first + 1:pad%last), ahead(pad%first + 1:pad%last)))
      end associate
    end do
    first = -largest_over_ranks(-first)
    share = first(1)
    rate = 0.0_wp
    distance = 0.0_wp
    closes = .false.
    do i = 1, merge(size(bearing%pad), 0, share < huge(share))
      associate (pad => bearing%pad(i))
        call pad%foil%add_penetration_rates(here(pad%first + 1:pad%last), ahead(pad%first + 1:pad%last), share, &
                                            rate(pad%first + 1:pad%last), distance, closes)
      end associate
    end do
    closes = any_rank(closes)
    total = sum_over_ranks([distance])
    distance = total(1)/bearing%clearance
    PetscCallA(VecSet(direction, 0.0_wp, ierr))
    call bearing%exchange%add(rate*bearing%unknown_scale/bearing%clearance, direction)
  end subroutine contact_direction

  !> The unit matrix of the foil's unknowns in SI, scaled as the bearing's matrix is; a diagonal that is
  !> zero for all other unknowns.
  subroutine foil_unit(bearing, diagonal)
    class(bearing_type), intent(in) :: bearing !! pads and shaft
    Vec, intent(in) :: diagonal !! scaled
    real(wp) :: value(bearing%local_size())
    integer :: i

    value = 0.0_wp
    do i = 1, size(bearing%pad)
      associate (pad => bearing%pad(i))
        value(pad%first + pad%foil%first + 1:pad%last) = pad%foil%unknown_scale/pad%foil%equation_scale
      end associate
    end do
    call bearing%exchange%put(value, diagonal)
  end subroutine foil_unit
end module gfb_bearing_directions
