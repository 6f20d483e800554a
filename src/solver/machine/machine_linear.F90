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
  use gfb_frequency_response, only: frequency_response_type
  implicit none (type)
  private
  public :: linearise_bearing, drop_linear_bearing, machine_matrix

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
    type(linear_bearing_type), intent(inout) :: linear(:)
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
      associate (place => machine%journal(i)%place, sign => machine%journal(i)%sign)
        matrix(place, place) = matrix(place, place) + coefficient*spread(sign, 1, size(sign))*spread(sign, 2, size(sign))
      end associate
    end do
  end subroutine machine_matrix
end module gfb_machine_linear
