#include "gfb_petsc.h"
!> How unbalance moves a machine, and what forces it makes in the bearings.
module gfb_machine_response
  use gfb_kinds, only: wp
  use gfb_linear_solve, only: solve_general
  use gfb_shaft, only: motions
  use gfb_machine, only: machine_type
  use gfb_dynamic_response, only: find_coefficients
  use gfb_frequency_response, only: coefficients_at
  use gfb_machine_linear, only: linear_bearing_type, add_bearing, journal_motion
  implicit none (type)
  private
  public :: find_machine_response

  !> Motions \( q e^{i \Omega t} \).
  type, public :: machine_response_type
    real(wp) :: speed = 0.0_wp !! [rad/s]
    complex(wp), allocatable :: motion(:)   !! of the shaft [m], [1]
    complex(wp), allocatable :: force(:, :) !! (x, y, about x, about y; bearing) of films on the shaft [N], [N m]
  end type machine_response_type

contains

  !> Motions \( q e^{i \Omega t} \) of the shaft by forces that turn with it, and forces of the films on it.
  subroutine find_machine_response(machine, linear, force, response, found)
    type(machine_type), intent(in) :: machine
    type(linear_bearing_type), intent(inout) :: linear(:)
    complex(wp), intent(in) :: force(:) !! at t = 0 [N], [N m]
    type(machine_response_type), intent(out) :: response
    logical, intent(out) :: found
    complex(wp), allocatable :: matrix(:, :)
    complex(wp) :: coefficient(motions, motions, size(linear)), rate
    integer :: i

    rate = cmplx(0.0_wp, machine%speed, wp)
    matrix = machine%equations%dynamic_stiffness(rate, machine%speed)
    do i = 1, size(linear)
      call coefficients_of(machine, linear(i), coefficient(:, :, i), found)
      if (.not. found) return
      call add_bearing(machine, i, coefficient(:, :, i), matrix)
    end do
    response%speed = machine%speed
    response%motion = force
    call solve_general(matrix, response%motion, found)
    if (.not. found) return
    allocate (response%force(motions, size(linear)))
    do i = 1, size(linear)
      response%force(:, i) = -matmul(coefficient(:, :, i), journal_motion(machine, i, response%motion))
    end do
  end subroutine find_machine_response

  !> Z of a bearing at the frequency of the speed; a sample is not taken again.
  subroutine coefficients_of(machine, linear, coefficient, found)
    type(machine_type), intent(in) :: machine
    type(linear_bearing_type), intent(inout) :: linear
    complex(wp), intent(out) :: coefficient(:, :) !! [SI]
    logical, intent(out) :: found
    integer :: k

    found = .false.
    if (allocated(linear%model%part)) then
      found = all([(linear%model%part(k)%has(machine%speed), k=1, size(linear%model%part))]) .and. .not. allocated(linear%model%opposite)
    end if
    if (found) then
      coefficient = coefficients_at(linear%response, linear%model, machine%speed)
    else
      call find_coefficients(linear%bearing, linear%response, cmplx(0.0_wp, machine%speed, wp), coefficient, found, &
                             only_translations=machine%count < motions)
    end if
  end subroutine coefficients_of
end module gfb_machine_response
