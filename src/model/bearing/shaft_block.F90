#include "gfb_petsc.h"
!> The shaft as a block of a bearing's equations: the balance of forces on it, or its place where it is held.
!>
!> Its unknowns are those of the border, behind all others.
module gfb_shaft_block
  use petscmat
  use gfb_kinds, only: wp
  use gfb_film_load, only: acts_on, film_forces
  use gfb_operating_point, only: operating_point_type
  use gfb_pad_terms, only: shaft_unknowns_type, add_shaft_stiffness
  use gfb_bearing, only: bearing_type, bearing_block_type, bearing_state_type
  implicit none (type)
  private
  public :: shaft_block, shaft_of

contains

  !> The block of a shaft that floats.
  pure subroutine shaft_block(block)
    type(bearing_block_type), intent(out) :: block !! of a bearing whose shaft has unknowns

    block%name = 'shaft'
    block%add_residual => shaft_residual
    block%add_jacobian => shaft_jacobian
  end subroutine shaft_block

  !> The shaft's unknowns among the numbers by which a pad fills the matrix, or among the bearing's.
  pure function shaft_of(bearing, i) result(shaft)
    class(bearing_type), intent(in) :: bearing !! numbered
    integer, intent(in) :: i !! of the pad, or 0
    type(shaft_unknowns_type) :: shaft

    shaft = shaft_unknowns_type(bearing%first_shaft, bearing%coordinate)
    if (i > 0) shaft%before = bearing%pad(i)%last - bearing%pad(i)%first + bearing%first_shaft - bearing%first_scalar
  end function shaft_of

  !> All forces, or the shaft's position where it is fixed.
  subroutine shaft_residual(bearing, state, residual)
    class(bearing_type), intent(in) :: bearing
    type(bearing_state_type), intent(in) :: state
    real(wp), intent(inout) :: residual(:)
    real(wp) :: force(film_forces), value(size(bearing%coordinate))

    associate (here => state%unknown(bearing%first_shaft + 1:), asked => state%asked, coordinate => bearing%coordinate)
      value = 0.0_wp
      if (.not. state%fixed) then
        force = acts_on*bearing%local_force(state%unknown, state%gap)
        value = force(coordinate)
        if (bearing%last_rank) call asked%add_other_forces(coordinate, here, value)
      else if (bearing%last_rank) then
        value = matmul(hold_stiffness(bearing, asked, .true.), here - asked%place(coordinate))
      end if
    end associate
    residual(bearing%first_shaft + 1:) = value
  end subroutine shaft_residual

  !> What keeps the shaft where it is fixed; its inertia where it floats.
  subroutine shaft_jacobian(bearing, state, room, matrix)
    class(bearing_type), intent(in) :: bearing
    type(bearing_state_type), intent(in) :: state
    logical, intent(in) :: room
    Mat, intent(in) :: matrix

    if (.not. bearing%last_rank) return
    call add_shaft_stiffness(shaft_of(bearing, 0), merge(0.0_wp, 1.0_wp, room)*hold_stiffness(bearing, state%asked, state%fixed), matrix)
  end subroutine shaft_jacobian

  !> Forces over coordinates: those that keep a fixed shaft at its position; of one that floats those of its inertia.
  pure function hold_stiffness(bearing, point, fixed) result(stiffness)
    class(bearing_type), intent(in) :: bearing
    type(operating_point_type), intent(in) :: point !! whose load counts
    logical, intent(in) :: fixed                     !! the shaft is fixed
    real(wp) :: stiffness(size(bearing%coordinate), size(bearing%coordinate)), own(size(bearing%coordinate)) !! [N/m], [N m/rad]
    integer :: i

    stiffness = -point%inertia(bearing%coordinate, bearing%coordinate)
    if (.not. fixed) return
    own = bearing%force_scale(point)/bearing%clearance*bearing%levers()**2
    stiffness = 0.0_wp
    do i = 1, size(own)
      stiffness(i, i) = own(i)
    end do
  end function hold_stiffness
end module gfb_shaft_block
