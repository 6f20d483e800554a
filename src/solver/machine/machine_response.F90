#include "gfb_petsc.h"
!> How unbalance moves a machine.
module gfb_machine_response
  use gfb_kinds, only: wp
  use gfb_linear_solve, only: solve_general
  use gfb_machine, only: machine_type
  use gfb_moving_sleeves, only: true_motions, forces_on_motions
  use gfb_machine_linear, only: linear_bearing_type, machine_matrix
  implicit none (type)
  private
  public :: find_machine_response

contains

  !> Motions \( q e^{i \Omega t} \) of the shaft by forces that turn with it.
  subroutine find_machine_response(machine, linear, force, motion, found, all_motions)
    type(machine_type), intent(in) :: machine
    type(linear_bearing_type), intent(inout) :: linear(:)
    complex(wp), intent(in) :: force(:) !! on the shaft at t = 0 [N], [N m]
    complex(wp), allocatable, intent(out) :: motion(:) !! of the shaft [m], [1]
    logical, intent(out) :: found
    complex(wp), allocatable, intent(out), optional :: all_motions(:) !! as the machine's equations have them
    complex(wp), allocatable :: matrix(:, :), answer(:)
    integer :: i

    answer = forces_on_motions(machine%sleeve, [force, ((0.0_wp, 0.0_wp), i=size(force) + 1, size(machine%force))])
    call machine_matrix(machine, linear, cmplx(0.0_wp, machine%speed, wp), matrix, found)
    if (found) call solve_general(matrix, answer, found)
    motion = true_motions(machine%sleeve, answer)
    motion = motion(:size(force))
    if (present(all_motions)) all_motions = answer
  end subroutine find_machine_response
end module gfb_machine_response
