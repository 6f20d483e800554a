#include "gfb_petsc.h"
!> Directions in the space of a bearing's unknowns: of the free edge, of contacts, of the foil.
module gfb_bearing_directions
  use petscvec
  use gfb_kinds, only: wp
  use gfb_petsc_session, only: sum_over_ranks, largest_over_ranks, any_rank
  use gfb_bearing_system, only: bearing_system_type
  implicit none (type)
  private
  public :: edge_lift, edge_room, edge_force, edge_direction, contact_direction, foil_unit

contains

  !> Mean displacement of the top foil's free edge towards the shaft at the present state, over all ranks [m].
  function edge_lift(bearing) result(lift)
    class(bearing_system_type), intent(in) :: bearing !! pads and shaft
    real(wp) :: lift
    real(wp) :: unknown(bearing%local_size()), total(1)

    call bearing%get_unknowns(unknown)
    total = sum_over_ranks([bearing%pad(1)%edge%lift(unknown)])
    lift = total(1)
  end function edge_lift

  !> Smallest gap over the top foil's free edge at the present state, over all ranks [m].
  function edge_room(bearing) result(room)
    class(bearing_system_type), intent(in) :: bearing !! pads and shaft
    real(wp) :: room
    real(wp) :: unknown(bearing%local_size()), gap(size(bearing%pad(1)%mesh%mesh_node)), smallest(1)

    call bearing%get_unknowns(unknown)
    gap = bearing%gap(unknown)
    smallest = largest_over_ranks([maxval(-gap(bearing%pad(1)%edge%node))])
    room = -smallest(1)
  end function edge_room

  !> Force of the spring that fixes the top foil's free edge at the point's height, towards the shaft [N].
  function edge_force(bearing) result(force)
    class(bearing_system_type), intent(in) :: bearing !! at a point with a fixed edge
    real(wp) :: force
    force = bearing%point%edge_hold*(bearing%point%edge_height - edge_lift(bearing))
  end function edge_force

  !> The vector whose product with a state is that lift over the clearance.
  subroutine edge_direction(bearing, direction)
    class(bearing_system_type), intent(in) :: bearing !! pads and shaft
    Vec, intent(in) :: direction !! scaled
    PetscErrorCode :: ierr

    PetscCallA(VecSet(direction, 0.0_wp, ierr))
    call bearing%exchange%add(bearing%pad(1)%edge%lift_rates(bearing%local_size())*bearing%unknown_scale/bearing%pad(1)%film%clearance, direction)
  end subroutine edge_direction

  !> Which contacts open or close first on the path from the present state to another.
  subroutine contact_direction(bearing, other, direction, share, distance, closes)
    class(bearing_system_type), intent(in) :: bearing !! pads and shaft
    Vec, intent(in) :: other             !! scaled state
    Vec, intent(in) :: direction         !! its product with a state grows as they come on, over the clearance
    real(wp), intent(out) :: share       !! of the path to there; huge if there is none [1]
    real(wp), intent(out) :: distance    !! by which that product has to grow until then [1]
    logical, intent(out) :: closes       !! one of them closes
    real(wp) :: here(bearing%local_size()), ahead(bearing%local_size()), rate(bearing%local_size()), first(1), total(1)
    PetscErrorCode :: ierr

    call bearing%get_unknowns(here)
    call bearing%get_unknowns(ahead, other)
    first = -largest_over_ranks([-bearing%pad(1)%foil%next_contact_change(here, ahead)])
    share = first(1)
    rate = 0.0_wp
    distance = 0.0_wp
    closes = .false.
    if (share < huge(share)) call bearing%pad(1)%foil%add_penetration_rates(here, ahead, share, rate, distance, closes)
    closes = any_rank(closes)
    total = sum_over_ranks([distance])
    distance = total(1)/bearing%pad(1)%film%clearance
    PetscCallA(VecSet(direction, 0.0_wp, ierr))
    call bearing%exchange%add(rate*bearing%unknown_scale/bearing%pad(1)%film%clearance, direction)
  end subroutine contact_direction

  !> The unit matrix of the foil's unknowns in SI, scaled as the bearing's matrix is; a diagonal that is
  !> zero for all other unknowns.
  subroutine foil_unit(bearing, diagonal)
    class(bearing_system_type), intent(in) :: bearing !! pads and shaft
    Vec, intent(in) :: diagonal !! scaled
    real(wp) :: value(bearing%local_size())

    value = 0.0_wp
    associate (first => bearing%pad(1)%foil%first + 1, last => bearing%pad(1)%foil%first + bearing%pad(1)%foil%local_unknowns())
      value(first:last) = bearing%pad(1)%foil%unknown_scale/bearing%pad(1)%foil%equation_scale
    end associate
    call bearing%exchange%put(value, diagonal)
  end subroutine foil_unit
end module gfb_bearing_directions
