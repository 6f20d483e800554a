#include "gfb_petsc.h"
!> Where the modes of a machine may be.
!>
!> A rational function goes through each \( Z_i \) over the frequencies [MayoAntoulas2007], which
!> is that of a few equations of first order; with few motions of the shaft they make one linear
!> eigenvalue problem, whose eigenvalues are all modes.
module gfb_machine_starts
  use gfb_kinds, only: wp
  use gfb_shaft_basis, only: shaft_basis
  use gfb_shaft_equations, only: shaft_equations_type
  use gfb_machine, only: machine_type
  use gfb_moving_sleeves, only: relative_motions
  use gfb_machine_linear, only: linear_bearing_type
  implicit none (type)
  private
  public :: find_starts

  real(wp), parameter :: farthest = 3.0_wp       !! rates that are kept, over the highest frequency [1]
  real(wp), parameter :: no_frequency = 1.0e-7_wp !! of a rate that is real, over the highest frequency [1]

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

  !> A mode.
  type, public :: machine_mode_type
    complex(wp) :: rate = 0.0_wp !! growth + i frequency [1/s]
    complex(wp), allocatable :: shape(:) !! of the shaft, the largest displacement 1
    logical :: sharp = .false.   !! solved for with the coefficients at its own rate
    complex(wp), allocatable :: motion(:) !! of all that moves, as the machine's equations have it
    complex(wp) :: along = 0.0_wp !! displacement of the shaft along z
    real(wp), allocatable :: share(:) !! of each bearing's film and foil in its energy [1]
  end type machine_mode_type

contains

  !> Eigenvalues of shaft and rational functions, one of each pair, where the function may still be right.
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
      if (abs(aimag(rate)) < no_frequency*highest) rate = real(rate, wp)
      if (aimag(rate) < 0.0_wp .or. abs(rate) > farthest*highest) cycle
      start = [start, machine_mode_type(rate, motion=matmul(basis, vector(:m, k)))]
    end do
  end subroutine find_starts

  !> Motions that modes are made of, those of the plane of x first, behind those of the plane of y what else moves.
  function machine_basis(machine, highest) result(basis)
    type(machine_type), intent(in) :: machine
    real(wp), intent(in) :: highest !! frequency [rad/s]
    real(wp), allocatable :: basis(:, :), plane(:, :)
    integer, allocatable :: held(:)
    integer :: i, m, n

    n = 2*size(machine%shaft%z)
    held = held_in_plane(machine, n)
    plane = shaft_basis(machine%shaft, held, highest)
    m = size(plane, 2)
    associate (others => size(machine%force) - 2*n)
      allocate (basis(2*n + others, 2*m + others), source=0.0_wp)
      do i = 1, others
        basis(2*n + i, 2*m + i) = 1.0_wp
      end do
    end associate
    basis(:n, :m) = plane
    basis(n + 1:2*n, m + 1:2*m) = plane
    basis = relative_motions(machine%sleeve, basis)
  end function machine_basis

  !> Motions of a plane of which one, or that of the other plane, is felt by a film: displacements, then slopes.
  pure function held_in_plane(machine, n) result(held)
    type(machine_type), intent(in) :: machine
    integer, intent(in) :: n !! motions of a plane
    integer, allocatable :: held(:)
    integer :: i, k, of

    allocate (held(0))
    do k = 1, 0, -1
      do i = 1, size(machine%held)
        if (machine%held(i) > 2*n) cycle
        of = modulo(machine%held(i) - 1, n) + 1
        if (modulo(of, 2) == k .and. all(held /= of)) held = [held, of]
      end do
    end do
  end function held_in_plane

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
    integer :: i, j, k, m, first, states
    integer, allocatable :: of(:), felt(:)

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
        of = felt_by(machine, i, linear(i)%response%motion(linear(i)%response%part(k)%coordinate))
        if (all(of == 0)) cycle
        call linear(i)%model%part(k)%realise(value, slope, right, left)
        felt = pack([(j, j=1, size(of))], of > 0)
        of = of(felt)
        moved = journal_rows(machine, i, basis)
        states = size(value, 1)
        first = size(matrix, 1)
        call move_alloc(matrix, grown)
        allocate (matrix(first + states, first + states), source=(0.0_wp, 0.0_wp))
        matrix(:first, :first) = grown
        call move_alloc(unit, grown)
        allocate (unit(first + states, first + states), source=(0.0_wp, 0.0_wp))
        unit(:first, :first) = grown
        matrix(m + 1:2*m, first + 1:) = -matmul(transpose(moved(of, :)), left(felt, :))/unit_of_time
        matrix(first + 1:, first + 1:) = value
        matrix(first + 1:, :m) = -matmul(right(:, felt), moved(of, :))/unit_of_time
        unit(first + 1:, first + 1:) = slope*unit_of_time
      end do
    end do
  end subroutine assemble_pair

  !> Coordinates of the shaft as places among those that a journal's film feels; 0 where it does not.
  pure function felt_by(machine, number, coordinate) result(of)
    type(machine_type), intent(in) :: machine
    integer, intent(in) :: number !! of the journal
    integer, intent(in) :: coordinate(:)
    integer :: of(size(coordinate)), k
    of = [(findloc(machine%journal(number)%coordinate, coordinate(k), 1), k=1, size(coordinate))]
  end function felt_by

  !> Motions of a journal over those of the basis.
  pure function journal_rows(machine, number, basis) result(rows)
    type(machine_type), intent(in) :: machine
    integer, intent(in) :: number !! of the journal
    real(wp), intent(in) :: basis(:, :) !! of all motions
    real(wp), allocatable :: rows(:, :)

    associate (place => machine%journal(number)%place, sign => machine%journal(number)%sign)
      rows = spread(sign, 2, size(basis, 2))*basis(place, :)
    end associate
  end function journal_rows
end module gfb_machine_starts
