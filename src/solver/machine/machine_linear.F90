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
  use gfb_machine_equilibrium, only: find_journal_coefficients
  use gfb_machine, only: machine_type
  use gfb_bearing_system, only: bearing_system_type
  use gfb_heat_switch, only: held_bearing_type, hold_heat, let_go
  use gfb_vibration_law, only: vibration_type
  use gfb_dynamic_response, only: dynamic_response_type, create_response, destroy_response
  use gfb_frequency_response, only: frequency_response_type, coefficients_beside
  implicit none (type)
  private
  public :: linearise_bearing, drop_linear_bearing, machine_matrix, machine_slope, add_bearing, journal_motion

  !> A bearing about its equilibrium.
  type, public :: linear_bearing_type
    type(bearing_system_type), pointer :: bearing => null()
    type(held_bearing_type), private :: still !! with temperatures as they are
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
    call hold_heat(bearing, linear%still)
    linear%bearing => linear%still%bearing
    call create_response(linear%bearing, vibration, linear%response, log=log)
  end subroutine linearise_bearing

  !> Frees it.
  subroutine drop_linear_bearing(linear)
    type(linear_bearing_type), intent(inout) :: linear
    if (associated(linear%bearing)) call destroy_response(linear%response)
    nullify (linear%bearing)
    call let_go(linear%still)
  end subroutine drop_linear_bearing

  !> The whole machine at a rate.
  subroutine machine_matrix(machine, linear, rate, matrix, found)
    type(machine_type), intent(in) :: machine
    type(linear_bearing_type), intent(inout) :: linear(:) !! keep the factors of this rate
    complex(wp), intent(in) :: rate !! lambda [1/s]
    complex(wp), allocatable, intent(out) :: matrix(:, :)
    logical, intent(out) :: found !! all bearings could be factorized
    complex(wp), allocatable :: coefficient(:, :)
    integer :: i

    matrix = machine%equations%dynamic_stiffness(rate, machine%speed)
    found = .true.
    do i = 1, size(linear)
      call find_journal_coefficients(linear(i)%bearing, linear(i)%response, machine%journal(i), rate, coefficient, found)
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

    associate (place => machine%journal(number)%place, sign => machine%journal(number)%sign)
      matrix(place, place) = matrix(place, place) + coefficient*spread(sign, 1, size(sign))*spread(sign, 2, size(sign))
    end associate
  end subroutine add_bearing

  !> How the machine's matrix follows the rate, the bearings' part of it by the function through their samples.
  subroutine machine_slope(machine, linear, rate, slope)
    type(machine_type), intent(in) :: machine
    type(linear_bearing_type), intent(in) :: linear(:) !! with samples
    complex(wp), intent(in) :: rate !! lambda [1/s]
    complex(wp), allocatable, intent(out) :: slope(:, :) !! its derivative by lambda
    complex(wp), allocatable :: coefficient(:, :), by_rate(:, :)
    integer, allocatable :: of(:)
    integer :: i, k

    associate (equations => machine%equations)
      slope = 2.0_wp*rate*equations%mass + (machine%speed*equations%gyroscopic + equations%damping)
    end associate
    do i = 1, size(linear)
      associate (motion => linear(i)%response%motion, coordinate => machine%journal(i)%coordinate)
        if (allocated(coefficient)) deallocate (coefficient, by_rate)
        allocate (coefficient(size(motion), size(motion)), by_rate(size(motion), size(motion)))
        call coefficients_beside(linear(i)%response, linear(i)%model, rate, coefficient, by_rate)
        of = [(findloc(motion, coordinate(k), 1), k=1, size(coordinate))]
      end associate
      call add_bearing(machine, i, by_rate(of, of), slope)
    end do
  end subroutine machine_slope

  !> Motions of a journal as its film's response has them.
  pure function journal_motion(machine, number, coordinate, motion) result(own)
    type(machine_type), intent(in) :: machine
    integer, intent(in) :: number !! of the journal
    integer, intent(in) :: coordinate(:) !! those of the shaft's five that the response has
    complex(wp), intent(in) :: motion(:) !! of all that moves, as the machine's equations have it [m], [1]
    complex(wp) :: own(size(coordinate)) !! 0 where its film does not feel them [m], [rad]
    integer :: k, at

    own = 0.0_wp
    associate (journal => machine%journal(number))
      do k = 1, size(coordinate)
        at = findloc(journal%coordinate, coordinate(k), 1)
        if (at > 0) own(k) = journal%sign(at)*motion(journal%place(at))
      end do
    end associate
  end function journal_motion
end module gfb_machine_linear
