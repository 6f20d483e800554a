#include "gfb_petsc.h"
!> Modes of a machine about its equilibrium.
!>
!> They begin at those of `gfb_machine_starts`. Each is then solved for with the whole shaft
!> and \( Z_i \) itself: f = 1/(c^T D^{-1} b) has its zeros, and is followed by the secant method.
module gfb_machine_modes
  use gfb_kinds, only: wp
  use gfb_run_log, only: run_log_type
  use gfb_text, only: text
  use gfb_sorting, only: sort_by
  use gfb_linear_solve, only: solve_general
  use gfb_machine, only: machine_type
  use gfb_moving_sleeves, only: true_motions
  use gfb_frequency_response, only: cover_frequencies
  use gfb_machine_linear, only: linear_bearing_type, machine_matrix
  use gfb_machine_starts, only: machine_mode_type, find_starts
  implicit none (type)
  private
  public :: find_machine_modes

  integer, parameter :: samples = 40            !! frequencies at which the function is right
  real(wp), parameter :: start_tolerance = 1.0e-6_wp !! of that function, whose eigenvalues are starts [1]
  integer, parameter :: most_trials = 30        !! of the secant method
  real(wp), parameter :: first_move = 1.0e-5_wp !! of it, over the rate [1]
  real(wp), parameter :: tolerance = 1.0e-10_wp !! of a rate [1]
  real(wp), parameter :: farthest = 0.1_wp      !! from its start is another mode, over the rate [1]
  real(wp), parameter :: same = 1.0e-6_wp       !! rates that near are one [1]

contains

  !> All modes up to a frequency, growth falling.
  subroutine find_machine_modes(machine, linear, highest, log, mode, reason)
    type(machine_type), intent(in) :: machine
    type(linear_bearing_type), intent(inout) :: linear(:) !! its bearings about their answers
    real(wp), intent(in) :: highest !! frequency [rad/s]
    type(run_log_type), intent(in) :: log !! where lines go
    type(machine_mode_type), allocatable, intent(out) :: mode(:)
    character(len=:), allocatable, intent(out) :: reason !! why some were not found; empty where all were
    type(machine_mode_type), allocatable :: start(:)
    type(machine_mode_type) :: one
    integer, allocatable :: order(:)
    logical :: found
    integer :: i, k

    allocate (mode(0))
    reason = ''
    do i = 1, size(linear)
      call log%is_on('machine, bearing '//text(i))
      call cover_frequencies(linear(i)%bearing, linear(i)%response, [(highest*real(k, wp)/samples, k=1, samples)], log, &
                             linear(i)%model, found, allowed=start_tolerance)
      if (.not. found) reason = 'bearing '//text(i)//' cannot be solved at '//text(linear(i)%model%failed, 4)//' rad/s'
      if (.not. found) return
    end do
    call find_starts(machine, linear, highest, start, reason)
    do i = 1, size(start)
      call log%detail('machine: mode may be near '//text(aimag(start(i)%rate), 6)//' rad/s, growth '//text(real(start(i)%rate, wp), 5))
      call log%is_on('machine, mode '//text(i)//' of '//text(size(start)))
      one = start(i)
      call sharpen(machine, linear, one)
      if (.not. one%sharp) then
        reason = 'a mode near '//text(aimag(start(i)%rate), 4)//' rad/s, growth '//text(real(start(i)%rate, wp), 3)// &
                 ' 1/s, was not found with the coefficients at its own rate'
        cycle
      end if
      if (any(abs(mode%rate - one%rate) < same*abs(one%rate))) cycle
      mode = [mode, one]
    end do
    call log%is_on('')
    order = [(i, i=1, size(mode))]
    call sort_by(-real(mode%rate, wp), order) ! growth falls
    mode = mode(order)
  end subroutine find_machine_modes

  !> Solves for a mode with the whole shaft and the coefficients at its own rate.
  subroutine sharpen(machine, linear, mode)
    type(machine_type), intent(in) :: machine
    type(linear_bearing_type), intent(inout) :: linear(:)
    type(machine_mode_type), intent(inout) :: mode !! in: a start
    complex(wp), allocatable :: matrix(:, :), pushed(:), motion(:), row(:)
    complex(wp) :: before, here, at_before, at_here, move
    logical :: found
    integer :: i

    pushed = matmul(machine%equations%mass, mode%motion)
    row = conjg(pushed)
    here = mode%rate
    before = here*(1.0_wp + first_move)
    at_before = 0.0_wp
    do i = 1, most_trials
      call machine_matrix(machine, linear, here, matrix, found)
      if (.not. found) return
      motion = pushed
      call solve_general(matrix, motion, found)
      if (.not. found) exit
      at_here = 1.0_wp/sum(row*motion)
      if (i == 1) then
        move = here*first_move
      else
        if (.not. abs(at_here - at_before) > 0.0_wp) exit
        move = -at_here*(here - before)/(at_here - at_before)
      end if
      before = here
      at_before = at_here
      here = here + move
      if (abs(here - mode%rate) > farthest*abs(mode%rate)) return
      mode%sharp = abs(move) <= tolerance*abs(here)
      if (mode%sharp) exit
    end do
    if (.not. mode%sharp) return
    mode%rate = here
    call take_shape(machine, motion, mode)
  end subroutine sharpen

  !> The shape of a mode, in which the largest displacement is 1.
  pure subroutine take_shape(machine, motion, mode)
    type(machine_type), intent(in) :: machine
    complex(wp), intent(in) :: motion(:) !! of all that moves
    type(machine_mode_type), intent(inout) :: mode
    complex(wp) :: true(size(motion)), largest

    true = true_motions(machine%sleeve, motion)
    associate (n => machine%shaft%coordinates(), i => machine%along)
      largest = true(2*maxloc(abs(true(:n:2)), 1) - 1)
      if (i > 0) then
        if (abs(true(i)) > abs(largest)) largest = true(i)
        mode%along = true(i)/largest
      end if
      mode%shape = true(:n)/largest
    end associate
    mode%motion = motion/largest
  end subroutine take_shape

end module gfb_machine_modes
