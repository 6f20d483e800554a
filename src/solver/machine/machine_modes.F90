#include "gfb_petsc.h"
!> Motions of a machine about its equilibrium: its modes, and how unbalance moves it.
!>
!> With the shaft's \( D(\lambda) \) and the coefficients \( Z_i(\lambda) \) of each bearing, at the
!> rate of the motion itself, a motion \( q e^{\lambda t} \) needs the forces
!>
!> $$ \Bigl( D(\lambda) + \sum_i B_i^T Z_i(\lambda) B_i \Bigr) q. $$
!>
!> A rational function goes through each \( Z_i \) over the frequencies [MayoAntoulas2007], which
!> is that of a few equations of first order; with few motions of the shaft they make one linear
!> eigenvalue problem, whose eigenvalues are all modes. Each is then solved for with the whole shaft
!> and \( Z_i \) itself: f = 1/(c^T D^{-1} b) has its zeros, and is followed by the secant method.
module gfb_machine_modes
  use gfb_kinds, only: wp
  use gfb_run_log, only: run_log_type
  use gfb_text, only: text
  use gfb_sorting, only: sort_by
  use gfb_linear_solve, only: solve_general
  use gfb_shaft, only: motions
  use gfb_shaft_basis, only: shaft_basis
  use gfb_shaft_equations, only: shaft_equations_type
  use gfb_machine, only: machine_type
  use gfb_bearing_system, only: bearing_system_type
  use gfb_vibration_law, only: vibration_type
  use gfb_dynamic_response, only: dynamic_response_type, create_response, find_coefficients, destroy_response
  use gfb_frequency_response, only: frequency_response_type, cover_frequencies
  implicit none (type)
  private
  public :: linearise_bearing, drop_linear_bearing, find_machine_modes, find_machine_response

  integer, parameter :: samples = 40            !! frequencies at which the function is right
  real(wp), parameter :: start_tolerance = 1.0e-6_wp !! of that function, whose eigenvalues are starts [1]
  integer, parameter :: most_trials = 30        !! of the secant method
  real(wp), parameter :: first_move = 1.0e-5_wp !! of it, over the rate [1]
  real(wp), parameter :: tolerance = 1.0e-10_wp !! of a rate [1]
  real(wp), parameter :: farthest = 0.1_wp      !! from its start is another mode, over the rate [1]
  real(wp), parameter :: same = 1.0e-6_wp       !! rates that near are one [1]
  real(wp), parameter :: most_damped = 0.9_wp   !! damping ratio of a mode that is looked for [1]
  real(wp), parameter :: lowest = 0.02_wp       !! frequency of one over the highest [1]

  interface
    !> LAPACK: eigenvalues of a general complex pair.
    subroutine zggev(jobvl, jobvr, n, a, lda, b, ldb, alpha, beta, vl, ldvl, vr, ldvr, work, lwork, rwork, info)
      import :: wp
      implicit none (type, external)
      character(len=1), intent(in) :: jobvl, jobvr
      integer, intent(in) :: n, lda, ldb, ldvl, ldvr, lwork
      complex(wp), intent(inout) :: a(lda, n), b(ldb, n)
      complex(wp), intent(out) :: alpha(n), beta(n), vl(ldvl, n), vr(ldvr, n), work(lwork)
      real(wp), intent(out) :: rwork(8*n)
      integer, intent(out) :: info
    end subroutine zggev
  end interface

  !> A bearing about its equilibrium.
  type, public :: linear_bearing_type
    type(bearing_system_type), pointer :: bearing => null()
    type(dynamic_response_type) :: response
    type(frequency_response_type) :: model !! of it
  end type linear_bearing_type

  !> A mode.
  type, public :: machine_mode_type
    complex(wp) :: rate = 0.0_wp !! growth + i frequency [1/s]
    complex(wp), allocatable :: shape(:) !! of the shaft, the largest displacement 1
    logical :: sharp = .false.   !! solved for with the coefficients at its own rate
  end type machine_mode_type

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
    type(linear_bearing_type), intent(inout) :: linear(:)
    complex(wp), intent(in) :: rate !! lambda [1/s]
    complex(wp), allocatable, intent(out) :: matrix(:, :)
    logical, intent(out) :: found !! all bearings could be factorized
    complex(wp) :: coefficient(motions, motions)
    integer :: i, n

    matrix = machine%equations%dynamic_stiffness(rate, machine%speed)
    n = machine%count
    found = .true.
    do i = 1, size(linear)
      call find_coefficients(linear(i)%bearing, linear(i)%response, rate, coefficient, found, only_translations=n < motions)
      if (.not. found) return
      associate (place => machine%journal(i)%place(:n), sign => machine%journal(i)%sign(:n))
        matrix(place, place) = matrix(place, place) + coefficient(:n, :n)*spread(sign, 1, n)*spread(sign, 2, n)
      end associate
    end do
  end subroutine machine_matrix

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

  !> Eigenvalues of shaft and rational functions, those that may be modes.
  subroutine find_starts(machine, linear, highest, start, reason)
    type(machine_type), intent(in) :: machine
    type(linear_bearing_type), intent(in) :: linear(:)
    real(wp), intent(in) :: highest !! frequency, which is the unit of time [rad/s]
    type(machine_mode_type), allocatable, intent(out) :: start(:)
    character(len=:), allocatable, intent(inout) :: reason
    complex(wp), allocatable :: matrix(:, :), unit(:, :), numerator(:), denominator(:), vector(:, :), work(:), none(:, :)
    real(wp), allocatable :: basis(:, :), room(:)
    complex(wp) :: rate
    integer :: info, k, m, n

    basis = machine_basis(machine, highest)
    m = size(basis, 2)
    call assemble_pair(machine, linear, basis, highest, matrix, unit)
    n = size(matrix, 1)
    allocate (numerator(n), denominator(n), vector(n, n), work(16*n), room(8*n), none(1, n), start(0))
    call zggev('N', 'V', n, matrix, n, unit, n, numerator, denominator, none, 1, vector, n, work, size(work), room, info)
    if (info /= 0) reason = 'the eigenvalues of shaft and bearings were not found'
    if (info /= 0) return
    do k = 1, n
      if (.not. abs(denominator(k)) > 1.0e-12_wp*abs(numerator(k))) cycle
      rate = highest*numerator(k)/denominator(k)
      if (aimag(rate) < lowest*highest .or. aimag(rate) > 1.01_wp*highest .or. &
          abs(real(rate)) > most_damped*abs(rate)) cycle
      start = [start, machine_mode_type(rate, matmul(basis, vector(:m, k)))]
    end do
  end subroutine find_starts

  !> Motions that modes are made of, those of the plane of x first.
  function machine_basis(machine, highest) result(basis)
    type(machine_type), intent(in) :: machine
    real(wp), intent(in) :: highest !! frequency [rad/s]
    real(wp), allocatable :: basis(:, :), plane(:, :)
    integer, allocatable :: held(:)
    integer :: i, m, n

    held = [(machine%journal(i)%place(1), i=1, size(machine%journal))]
    if (machine%count == motions) held = [held, held + 1]
    plane = shaft_basis(machine%shaft, held, highest)
    n = size(plane, 1)
    m = size(plane, 2)
    allocate (basis(2*n, 2*m), source=0.0_wp)
    basis(:n, :m) = plane
    basis(n + 1:, m + 1:) = plane
  end function machine_basis

  !> The pair A, E of \( A x = s E x \) with \( s = \lambda/\omega_0 \) and x the shaft's motions in both planes, their rates,
  !> and the states of each bearing.
  subroutine assemble_pair(machine, linear, basis, unit_of_time, matrix, unit)
    type(machine_type), intent(in) :: machine
    type(linear_bearing_type), intent(in) :: linear(:)
    real(wp), intent(in) :: basis(:, :)  !! of all motions
    real(wp), intent(in) :: unit_of_time !! omega_0 [rad/s]
    complex(wp), allocatable, intent(out) :: matrix(:, :), unit(:, :)
    complex(wp), allocatable :: value(:, :), slope(:, :), right(:, :), left(:, :), grown(:, :)
    real(wp), allocatable :: moved(:, :)
    type(shaft_equations_type) :: few
    integer :: i, k, m, first, states
    integer, allocatable :: of(:)

    m = size(basis, 2)
    few = machine%equations%reduced(basis)
    allocate (matrix(2*m, 2*m), unit(2*m, 2*m), source=(0.0_wp, 0.0_wp))
    do i = 1, m
      unit(i, i) = 1.0_wp
      matrix(i, m + i) = 1.0_wp
    end do
    unit(m + 1:, m + 1:) = few%mass
    matrix(m + 1:, :m) = -(few%stiffness + machine%speed*few%circulation)/unit_of_time**2
    matrix(m + 1:, m + 1:) = -(few%damping + machine%speed*few%gyroscopic)/unit_of_time
    do i = 1, size(linear)
      do k = 1, size(linear(i)%model%part)
        of = linear(i)%response%part(k)%coordinate
        if (any(of > machine%count)) cycle
        call linear(i)%model%part(k)%realise(value, slope, right, left)
        moved = journal_rows(machine, i, basis)
        states = size(value, 1)
        first = size(matrix, 1)
        call move_alloc(matrix, grown)
        allocate (matrix(first + states, first + states), source=(0.0_wp, 0.0_wp))
        matrix(:first, :first) = grown
        call move_alloc(unit, grown)
        allocate (unit(first + states, first + states), source=(0.0_wp, 0.0_wp))
        unit(:first, :first) = grown
        matrix(m + 1:2*m, first + 1:) = -matmul(transpose(moved(of, :)), left)/unit_of_time
        matrix(first + 1:, first + 1:) = value
        matrix(first + 1:, :m) = -matmul(right, moved(of, :))/unit_of_time
        unit(first + 1:, first + 1:) = slope*unit_of_time
      end do
    end do
  end subroutine assemble_pair

  !> Motions of a journal over those of the basis.
  function journal_rows(machine, number, basis) result(rows)
    type(machine_type), intent(in) :: machine
    integer, intent(in) :: number !! of the journal
    real(wp), intent(in) :: basis(:, :) !! of all motions
    real(wp) :: rows(motions, size(basis, 2))

    associate (place => machine%journal(number)%place, sign => machine%journal(number)%sign)
      rows = spread(sign, 2, size(basis, 2))*basis(place, :)
    end associate
  end function journal_rows

  !> Solves for a mode with the whole shaft and the coefficients at its own rate.
  subroutine sharpen(machine, linear, mode)
    type(machine_type), intent(in) :: machine
    type(linear_bearing_type), intent(inout) :: linear(:)
    type(machine_mode_type), intent(inout) :: mode !! in: a start
    complex(wp), allocatable :: matrix(:, :), pushed(:), motion(:), row(:)
    complex(wp) :: before, here, at_before, at_here, move
    logical :: found
    integer :: i

    pushed = matmul(machine%equations%mass, mode%shape)
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
    i = maxloc(abs(motion(::2)), 1)
    mode%shape = motion/motion(2*i - 1)
  end subroutine sharpen

  !> Motions \( q e^{i \Omega t} \) of the shaft by forces that turn with it.
  subroutine find_machine_response(machine, linear, force, motion, found)
    type(machine_type), intent(in) :: machine
    type(linear_bearing_type), intent(inout) :: linear(:)
    complex(wp), intent(in) :: force(:) !! at t = 0 [N], [N m]
    complex(wp), allocatable, intent(out) :: motion(:) !! of the shaft [m], [1]
    logical, intent(out) :: found
    complex(wp), allocatable :: matrix(:, :)

    motion = force
    call machine_matrix(machine, linear, cmplx(0.0_wp, machine%speed, wp), matrix, found)
    if (found) call solve_general(matrix, motion, found)
  end subroutine find_machine_response
end module gfb_machine_modes
