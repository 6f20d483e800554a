#include "gfb_petsc.h"
!> Derivatives of a bearing's equations by the shaft's coordinates, tilts among them.
!>
!> They are the right sides of a linear response: with \( f(x, q) = 0 \) the unknowns answer a motion of
!> the shaft by \( f_x x' = -f_q \), where the shaft is fixed in that coordinate.
module gfb_shaft_columns
  use petscvec
  use gfb_kinds, only: wp
  use gfb_film_load, only: film_forces, acts_on
  use gfb_solid_contact, only: contact_pressure, contact_pressure_rate
  use gfb_pad, only: pad_type
  use gfb_bearing_system, only: bearing_system_type
  implicit none (type)
  private
  public :: shaft_column

contains

  !> Derivative of all equations by one of the shaft's coordinates at the present point and state, the
  !> unknowns staying: the film's by the rigid gap, of foil and shaft by the asperities' pressure.
  subroutine shaft_column(bearing, coordinate, column)
    type(bearing_system_type), intent(in) :: bearing !! pads and shaft
    integer, intent(in) :: coordinate !! see `shaft_coordinates`
    Vec, intent(in) :: column         !! like the residual, scaled, by that unit

    real(wp) :: unknown(bearing%local_size()), value(bearing%local_size()), force(film_forces)
    real(wp) :: gap(bearing%film_nodes())
    PetscErrorCode :: ierr
    integer :: i

    call bearing%get_unknowns(unknown)
    gap = bearing%gap(unknown)
    value = 0.0_wp
    do i = 1, size(bearing%pad)
      associate (pad => bearing%pad(i), nodes => bearing%pad(i)%last_node - bearing%pad(i)%first_node)
        call pad%film%add_shaft_column(unknown(pad%first + 1:pad%first + nodes), gap(pad%first_node + 1:pad%last_node), &
                                       bearing%position(unknown), coordinate, value(pad%first + 1:pad%last))
        if (.not. pad%contact%present) cycle
        call add_asperities(pad, coordinate, unknown(pad%first + 1:pad%last), gap(pad%first_node + 1:pad%last_node), &
                            value(pad%first + 1:pad%last), force)
        if (bearing%shaft_fixed) cycle
        force = acts_on*force
        value(bearing%first_shaft + 1:) = value(bearing%first_shaft + 1:) + force(bearing%coordinate)
      end associate
    end do
    PetscCallA(VecSet(column, 0.0_wp, ierr))
    call bearing%exchange%add(value/bearing%equation_scale(bearing%point), column)
  end subroutine shaft_column

  !> The asperities' pressure follows the gap, and loads foil and shaft. The foil's equations are linear
  !> in what loads it: their difference over any step is their derivative.
  subroutine add_asperities(pad, coordinate, unknown, gap, value, force)
    type(pad_type), intent(in) :: pad
    integer, intent(in) :: coordinate
    real(wp), intent(in) :: unknown(:)  !! the pad's, in SI
    real(wp), intent(in) :: gap(:)      !! at the pad's nodes [m]
    real(wp), intent(inout) :: value(:) !! one an unknown of the pad
    real(wp), intent(out) :: force(:)   !! of the pressure's change

    real(wp) :: rate(size(gap)), step
    real(wp), dimension(size(unknown)) :: loading, before, after

    rate = contact_pressure_rate(pad%contact, gap)*pad%film%motion(coordinate, :)
    step = pad%film%ambient_pressure/max(maxval(abs(rate)), tiny(1.0_wp))
    loading = unknown
    loading(:size(gap)) = unknown(:size(gap)) + contact_pressure(pad%contact, gap)
    before = 0.0_wp
    call pad%foil%add_residual(loading, before)
    loading(:size(gap)) = loading(:size(gap)) + step*rate
    after = 0.0_wp
    call pad%foil%add_residual(loading, after)
    value = value + (after - before)/step
    force = pad%film%force(pad%film%ambient_pressure + rate)
  end subroutine add_asperities
end module gfb_shaft_columns
