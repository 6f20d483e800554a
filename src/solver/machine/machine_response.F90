#include "gfb_petsc.h"
!> How unbalance moves a machine, and what forces it makes in the bearings.
module gfb_machine_response
  use gfb_kinds, only: wp
  use gfb_linear_solve, only: solve_general
  use gfb_shaft, only: motions
  use gfb_machine, only: machine_type
  use gfb_moving_sleeves, only: true_motions, forces_on_motions
  use gfb_frequency_response, only: coefficients_at
  use gfb_machine_equilibrium, only: find_journal_coefficients
  use gfb_machine_linear, only: linear_bearing_type, add_bearing, journal_motion
  implicit none (type)
  private
  public :: find_machine_response

  integer, parameter :: across(motions) = [1, 2, 4, 5] !! coordinates of forces that are kept: x, y, about x, about y

  !> Coefficients of a journal's motions.
  type :: journal_matrix_type
    complex(wp), allocatable :: of(:, :)
  end type journal_matrix_type

  !> Motions \( q e^{i \Omega t} \).
  type, public :: machine_response_type
    real(wp) :: speed = 0.0_wp !! [rad/s]
    complex(wp), allocatable :: motion(:)   !! of the shaft [m], [1]
    complex(wp), allocatable :: all_motions(:) !! as the machine's equations have them [m], [1]
    complex(wp), allocatable :: force(:, :) !! (x, y, about x, about y; bearing) of films on the shaft [N], [N m]
  end type machine_response_type

contains

  !> Motions \( q e^{i \Omega t} \) of the shaft by forces that turn with it, and forces of the films on it.
  subroutine find_machine_response(machine, linear, force, response, found)
    type(machine_type), intent(in) :: machine
    type(linear_bearing_type), intent(inout) :: linear(:)
    complex(wp), intent(in) :: force(:) !! on the shaft at t = 0 [N], [N m]
    type(machine_response_type), intent(out) :: response
    logical, intent(out) :: found
    type(journal_matrix_type) :: coefficient(size(linear))
    complex(wp), allocatable :: matrix(:, :), true(:), of_film(:)
    complex(wp) :: rate
    integer :: i, k, row

    rate = cmplx(0.0_wp, machine%speed, wp)
    matrix = machine%equations%dynamic_stiffness(rate, machine%speed)
    do i = 1, size(linear)
      call coefficients_of(machine, i, linear(i), coefficient(i)%of, found)
      if (.not. found) return
      call add_bearing(machine, i, coefficient(i)%of, matrix)
    end do
    response%speed = machine%speed
    response%all_motions = forces_on_motions(machine%sleeve, [force, ((0.0_wp, 0.0_wp), i=size(force) + 1, size(machine%force))])
    call solve_general(matrix, response%all_motions, found)
    if (.not. found) return
    true = true_motions(machine%sleeve, response%all_motions)
    response%motion = true(:size(force))
    allocate (response%force(motions, size(linear)), source=(0.0_wp, 0.0_wp))
    do i = 1, size(linear)
      associate (coordinate => machine%journal(i)%coordinate)
        of_film = -matmul(coefficient(i)%of, journal_motion(machine, i, coordinate, response%all_motions))
        do k = 1, size(coordinate)
          row = findloc(across, coordinate(k), 1)
          if (row > 0) response%force(row, i) = of_film(k)
        end do
      end associate
    end do
  end subroutine find_machine_response

  !> Z of the motions that a journal's film feels, at the frequency of the speed; a sample is not taken again.
  subroutine coefficients_of(machine, number, linear, coefficient, found)
    type(machine_type), intent(in) :: machine
    integer, intent(in) :: number !! of the journal
    type(linear_bearing_type), intent(inout) :: linear
    complex(wp), allocatable, intent(out) :: coefficient(:, :) !! [SI]
    logical, intent(out) :: found
    complex(wp), allocatable :: whole(:, :)
    integer, allocatable :: of(:)
    integer :: k

    found = .false.
    if (allocated(linear%model%part)) then
      found = all([(linear%model%part(k)%has(machine%speed), k=1, size(linear%model%part))]) .and. .not. allocated(linear%model%opposite)
    end if
    associate (journal => machine%journal(number))
      if (found) then
        whole = coefficients_at(linear%response, linear%model, machine%speed)
        of = [(findloc(linear%response%motion, journal%coordinate(k), 1), k=1, size(journal%coordinate))]
        coefficient = whole(of, of)
      else
        call find_journal_coefficients(linear%bearing, linear%response, journal, cmplx(0.0_wp, machine%speed, wp), coefficient, found)
      end if
    end associate
  end subroutine coefficients_of
end module gfb_machine_response
