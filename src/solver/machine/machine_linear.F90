#include "gfb_petsc.h"
!> A machine about its equilibrium: what its motions need of forces.
!>
!> With the shaft's \( D(\lambda) \) and the coefficients \( Z_i(\lambda) \) of each bearing, at the
!> rate of the motion itself, a motion \( q e^{\lambda t} \) needs the forces
!>
!> $$ \Bigl( D(\lambda) + \sum_i B_i^T Z_i(\lambda) B_i \Bigr) q. $$
module gfb_machine_linear
  use gfb_kinds, only: wp
  use gfb_run_log, only: run_log_type
  use gfb_shaft, only: motions
  use gfb_machine, only: machine_type
  use gfb_bearing_system, only: bearing_system_type
  use gfb_vibration_law, only: vibration_type
  use gfb_dynamic_response, only: dynamic_response_type, create_response, find_coefficients, destroy_response
  use gfb_frequency_response, only: frequency_response_type, coefficients_beside
  implicit none (type)
  private
  public :: linearise_bearing, drop_linear_bearing, machine_matrix, machine_slope, add_bearing, journal_motion

  !> A bearing about its equilibrium.
  type, public :: linear_bearing_type
    type(bearing_system_type), pointer :: bearing => null()
    type(dynamic_response_type) :: response
    type(frequency_response_type) :: model !! of it
  end type linear_bearing_type

contains

  !> Linearises a bearing about its present answer.
  subroutine linearise_bearing(bearing, vibration, log, linear)
    type(bearing_system_type), target, intent(inout) :: bearing !! is left as it is
    type(vibration_type), intent(in) :: vibration !! of its foils
    type(run_log_type), intent(in) :: log !! where lines go
    type(linear_bearing_type), intent(inout) :: linear
    linear%bearing => bearing
    call create_response(bearing, vibration, linear%response, log=log)
  end subroutine linearise_bearing

  !> Frees it.
  subroutine drop_linear_bearing(linear)
    type(linear_bearing_type), intent(inout) :: linear
    if (associated(linear%bearing)) call destroy_response(linear%response)
    nullify (linear%bearing)
  end subroutine drop_linear_bearing

  !> The whole machine at a rate.
  subroutine machine_matrix(machine, linear, rate, matrix, found)
    type(machine_type), intent(in) :: machine
    type(linear_bearing_type), intent(inout) :: linear(:) !! keep the factors of this rate
    complex(wp), intent(in) :: rate !! lambda [1/s]
    complex(wp), allocatable, intent(out) :: matrix(:, :)
    logical, intent(out) :: found !! all bearings could be factorized
    complex(wp) :: coefficient(motions, motions)
    integer :: i

    matrix = machine%equations%dynamic_stiffness(rate, machine%speed)
    found = .true.
    do i = 1, size(linear)
      call find_coefficients(linear(i)%bearing, linear(i)%response, rate, coefficient, found, only_translations=machine%count < motions)
      if (.not. found) return
      call add_bearing(machine, i, coefficient, matrix)
    end do
  end subroutine machine_matrix

  !> Adds what a bearing's coefficients, or a derivative of them, are among the motions of the shaft.
  pure subroutine add_bearing(machine, number, coefficient, matrix)
    type(machine_type), intent(in) :: machine
    integer, intent(in) :: number !! of the bearing
    complex(wp), intent(in) :: coefficient(:, :) !! Z of its journal's motions [SI]
    complex(wp), intent(inout) :: matrix(:, :) !! (motion, motion) of the shaft [SI]

    associate (n => machine%count)
      associate (place => machine%journal(number)%place(:n), sign => machine%journal(number)%sign(:n))
        matrix(place, place) = matrix(place, place) + coefficient(:n, :n)*spread(sign, 1, n)*spread(sign, 2, n)
      end associate
    end associate
  end subroutine add_bearing

  !> How the machine's matrix follows the rate, the bearings' part of it by the function through their samples.
  subroutine machine_slope(machine, linear, rate, slope)
    type(machine_type), intent(in) :: machine
    type(linear_bearing_type), intent(in) :: linear(:) !! with samples
    complex(wp), intent(in) :: rate !! lambda [1/s]
    complex(wp), allocatable, intent(out) :: slope(:, :) !! its derivative by lambda
    complex(wp) :: coefficient(motions, motions), by_rate(motions, motions)
    integer :: i

    associate (equations => machine%equations)
      slope = 2.0_wp*rate*equations%mass + (machine%speed*equations%gyroscopic + equations%damping)
    end associate
    do i = 1, size(linear)
      call coefficients_beside(linear(i)%response, linear(i)%model, rate, coefficient, by_rate)
      call add_bearing(machine, i, by_rate, slope)
    end do
  end subroutine machine_slope

  !> Motions of a journal.
  pure function journal_motion(machine, number, motion) result(own)
    type(machine_type), intent(in) :: machine
    integer, intent(in) :: number !! of the journal
    complex(wp), intent(in) :: motion(:) !! of the shaft [m], [1]
    complex(wp) :: own(motions) !! x, y, and its rotations, 0 where its film does not feel them [m], [rad]

    own = 0.0_wp
    associate (n => machine%count, journal => machine%journal(number))
      own(:n) = journal%sign(:n)*motion(journal%place(:n))
    end associate
  end function journal_motion
end module gfb_machine_linear
