#include "gfb_petsc.h"
!> Modes of a machine about its equilibrium.
!>
!> They begin at those of `gfb_machine_starts`. Each is then solved for with the whole shaft
!> and \( Z_i \) itself: f = 1/(c^T D^{-1} b) has its zeros. The first step is Newton's, with the slope of
!> the function through the samples, and mostly enough; others are those of the secant method. Modes
!> are counted (`gfb_machine_count`) where their number is another than when that was done last; where
!> one is missing, more samples are taken.
module gfb_machine_modes
  use gfb_kinds, only: wp
  use gfb_run_log, only: run_log_type
  use gfb_text, only: text
  use gfb_sorting, only: sort_by
  use gfb_linear_solve, only: solve_general, solve_both_sides
  use gfb_machine, only: machine_type
  use gfb_moving_sleeves, only: true_motions
  use gfb_frequency_response, only: cover_frequencies, add_sample
  use gfb_machine_linear, only: linear_bearing_type, machine_matrix, machine_slope
  use gfb_machine_starts, only: machine_mode_type, find_starts
  use gfb_machine_count, only: circle_limits, count_modes
  use gfb_machine_shares, only: find_shares
  implicit none (type)
  private
  public :: find_machine_modes

  integer, parameter, public :: not_counted = -1 !! number of modes where they were not counted yet

  integer, parameter :: samples = 40            !! frequencies at which the function is right
  !> of that function, whose eigenvalues are starts, at first, and where a mode is missing [1]
  real(wp), parameter :: start_tolerance(2) = [1.0e-6_wp, 1.0e-10_wp]
  !> Rates of further samples where a mode is missing, over the highest frequency: where motions die out fast, as those of films do.
  real(wp), parameter :: further(2, 4) = reshape([-0.3_wp, 0.1_wp, -0.4_wp, 0.4_wp, -0.4_wp, 0.8_wp, -0.2_wp, 1.2_wp], [2, 4])
  integer, parameter :: most_trials = 30        !! of the secant method
  real(wp), parameter :: tolerance = 1.0e-10_wp !! of a rate [1]
  real(wp), parameter :: bends = 10.0_wp        !! what a step leaves of the rate's error, over its square, at most [1]
  real(wp), parameter :: farthest = 0.1_wp      !! from its start is another mode, over the rate [1]
  real(wp), parameter :: same = 1.0e-6_wp       !! rates that near are one [1]
  real(wp), parameter :: most_damped = 0.9_wp   !! damping ratio of a mode that is looked for [1]
  !> Of one that amplifies nothing. Beside springs that relax as fast the samples show some that are none.
  real(wp), parameter :: no_resonance = 0.5_wp
  real(wp), parameter :: lowest = 0.02_wp       !! frequency of one over the highest [1]
  real(wp), parameter :: beyond = 1.01_wp       !! the same of the highest [1]

contains

  !> All modes up to a frequency, growth falling.
  subroutine find_machine_modes(machine, linear, highest, log, mode, reason, counted)
    type(machine_type), intent(in) :: machine
    type(linear_bearing_type), intent(inout) :: linear(:) !! its bearings about their answers
    real(wp), intent(in) :: highest !! frequency [rad/s]
    type(run_log_type), intent(in) :: log !! where lines go
    type(machine_mode_type), allocatable, intent(out) :: mode(:)
    character(len=:), allocatable, intent(out) :: reason !! why some may be missing; empty where none are
    integer, intent(inout) :: counted !! modes that there were when they were counted last, or `not_counted`
    type(machine_mode_type), allocatable :: start(:), others(:)
    character(len=:), allocatable :: words
    integer, allocatable :: order(:)
    real(wp) :: centre, limits(2)
    logical :: counts
    integer :: i, missing, round

    allocate (mode(0), others(0))
    reason = ''
    call circle_limits(linear, highest, centre, limits, counts)
    if (.not. counts) call log%detail('machine: modes are not counted: no determinant, a loss factor, or springs that relax within the circle')
    do round = 1, size(start_tolerance)
      reason = '' ! of the round before, which this one answers
      call take_samples(machine, linear, highest, round, log, reason)
      if (reason /= '') return
      call find_starts(machine, linear, highest, start, reason)
      do i = 1, size(start)
        if (.not. is_wanted(start(i)%rate, highest)) cycle
        call log%is_on('machine, possible mode '//text(i)//' of '//text(size(start)))
        call log%detail('machine: mode may be near '//text(aimag(start(i)%rate), 6)//' rad/s, growth '//text(real(start(i)%rate, wp), 5))
        call take_mode(machine, linear, start(i), mode)
        if (start(i)%sharp .or. abs(start(i)%rate - centre) > limits(1)) cycle
        words = 'a mode near '//text(aimag(start(i)%rate), 4)//' rad/s, growth '//text(real(start(i)%rate, wp), 3)// &
                ' 1/s, was not found with the coefficients at its own rate'
        if (.not. counts .and. -real(start(i)%rate, wp) > no_resonance*abs(start(i)%rate)) then
          call log%detail('machine: '//words//'; it would amplify nothing')
        else
          reason = words
        end if
      end do
      if (reason == '' .and. (.not. counts .or. size(mode) == counted)) exit
      if (.not. counts) cycle
      do i = 1, size(start)
        if (.not. is_wanted(start(i)%rate, highest) .and. abs(start(i)%rate - centre) < limits(2)) then
          call take_mode(machine, linear, start(i), others)
        end if
      end do
      call count_all(machine, linear, [mode%rate, others%rate], start%rate, centre, limits, log, missing, reason)
      if (missing == 0) exit
    end do
    call log%is_on('')
    counted = not_counted
    if (reason == '') counted = size(mode)
    order = [(i, i=1, size(mode))]
    call sort_by(-real(mode%rate, wp), order) ! growth falls
    mode = mode(order)
  end subroutine find_machine_modes

  !> Whether a rate is that of a mode that is looked for.
  elemental logical function is_wanted(rate, highest) result(is)
    complex(wp), intent(in) :: rate    !! [1/s]
    real(wp), intent(in) :: highest !! frequency [rad/s]
    is = aimag(rate) >= lowest*highest .and. aimag(rate) <= beyond*highest .and. abs(real(rate, wp)) <= most_damped*abs(rate)
  end function is_wanted

  !> Samples of all bearings' coefficients, one of them at the speed, where unbalance asks for it.
  subroutine take_samples(machine, linear, highest, round, log, reason)
    type(machine_type), intent(in) :: machine
    type(linear_bearing_type), intent(inout) :: linear(:)
    real(wp), intent(in) :: highest !! frequency [rad/s]
    integer, intent(in) :: round !! 2 where a mode is missing
    type(run_log_type), intent(in) :: log
    character(len=:), allocatable, intent(inout) :: reason !! why they were not taken
    logical :: found
    integer :: i, k, l

    do i = 1, size(linear)
      call log%is_on('machine, bearing '//text(i))
      associate (bearing => linear(i)%bearing, response => linear(i)%response, model => linear(i)%model)
        found = .true.
        if (.not. allocated(model%part)) allocate (model%part(size(response%part)))
        do k = 1, size(response%part)
          model%part(k)%is_real = .not. response%equations%vibration%loss_factor > 0.0_wp
          if (found .and. machine%speed <= highest .and. .not. model%part(k)%has(machine%speed)) then
            call add_sample(bearing, response, k, machine%speed, model, found)
          end if
          do l = 1, merge(size(further, 2), 0, round > 1)
            if (found) call add_sample(bearing, response, k, further(2, l)*highest, model, found, growth=further(1, l)*highest)
          end do
        end do
        if (found) call cover_frequencies(bearing, response, [(highest*real(k, wp)/samples, k=1, samples)], log, model, found, &
                                          allowed=start_tolerance(round))
        if (.not. found) reason = 'bearing '//text(i)//' cannot be solved at '//text(model%failed, 4)//' rad/s'
      end associate
      if (.not. found) return
    end do
  end subroutine take_samples

  !> Solves for a mode from a start, and puts it to those there are unless it is one of them.
  subroutine take_mode(machine, linear, start, mode)
    type(machine_type), intent(in) :: machine
    type(linear_bearing_type), intent(inout) :: linear(:)
    type(machine_mode_type), intent(inout) :: start !! says whether it was found
    type(machine_mode_type), allocatable, intent(inout) :: mode(:)
    type(machine_mode_type) :: one

    one = start
    call sharpen(machine, linear, one)
    start%sharp = one%sharp
    if (.not. one%sharp) return
    if (.not. any(abs(mode%rate - one%rate) < same*abs(one%rate))) mode = [mode, one]
  end subroutine take_mode

  !> Counts the modes in the circle, and says what is missing.
  subroutine count_all(machine, linear, known, beyond, centre, limits, log, missing, reason)
    type(machine_type), intent(in) :: machine
    type(linear_bearing_type), intent(inout) :: linear(:)
    complex(wp), intent(in) :: known(:) !! rates [1/s]
    complex(wp), intent(in) :: beyond(:) !! where others may be [1/s]
    real(wp), intent(in) :: centre, limits(2) !! of the circle [1/s]
    type(run_log_type), intent(in) :: log
    integer, intent(out) :: missing
    character(len=:), allocatable, intent(inout) :: reason !! empty where none is
    real(wp) :: radius
    logical :: found

    call log%is_on('machine, count of modes')
    call count_modes(machine, linear, centre, limits, known, beyond, missing, radius, found)
    if (.not. found) then
      missing = 1
      reason = 'modes could not be counted: the circle about '//text(centre, 4)//' 1/s runs through one that was not found'
      return
    end if
    call log%detail('machine: modes counted in the circle of '//text(radius, 5)//' 1/s about '//text(centre, 5)//' 1/s, '// &
                    text(count(abs(known - centre) < radius))//' rates known, '//text(missing)//' missing')
    reason = ''
    if (missing > 0) reason = text(missing)//' more rates of modes were counted within '//text(radius, 4)//' 1/s of '//text(centre, 4)// &
                              ' 1/s than were found'
    if (missing < 0) reason = text(-missing)//' of the rates of modes found within '//text(radius, 4)//' 1/s of '//text(centre, 4)// &
                              ' 1/s were not counted'
  end subroutine count_all

  !> Solves for a mode with the whole shaft and the coefficients at its own rate. A step leaves of the error no more than some times its
  !> square, a secant's of its own size times that of the step before.
  subroutine sharpen(machine, linear, mode)
    type(machine_type), intent(in) :: machine
    type(linear_bearing_type), intent(inout) :: linear(:)
    type(machine_mode_type), intent(inout) :: mode !! in: a start
    complex(wp), allocatable :: matrix(:, :), slope(:, :), pushed(:), motion(:), left(:)
    complex(wp) :: before, here, at_before, at_here, move
    real(wp) :: moved, moved_before
    logical :: found
    integer :: i

    pushed = matmul(machine%equations%mass, mode%motion)
    here = mode%rate
    before = here
    at_before = 0.0_wp
    moved_before = 0.0_wp
    do i = 1, most_trials
      call machine_matrix(machine, linear, here, matrix, found)
      if (.not. found) return
      motion = pushed
      left = conjg(pushed)
      call solve_both_sides(matrix, motion, left, found)
      if (.not. found) return
      at_here = 1.0_wp/sum(conjg(pushed)*motion)
      if (i == 1) then
        call machine_slope(machine, linear, here, slope)
        move = -1.0_wp/(at_here*sum(left*matmul(slope, motion)))
      else
        if (.not. abs(at_here - at_before) > 0.0_wp) return
        move = -at_here*(here - before)/(at_here - at_before)
      end if
      moved = abs(move)/abs(here)
      if (i == 1) moved_before = moved
      mode%sharp = min(1.0_wp, bends*moved_before)*moved <= tolerance
      if (mode%sharp) exit
      before = here
      at_before = at_here
      here = here + move
      moved_before = moved
      if (abs(here - mode%rate) > farthest*abs(mode%rate)) return
    end do
    if (.not. mode%sharp) return
    call find_shares(machine, linear, here, motion, mode%share, mode%sharp)
    if (.not. mode%sharp) return
    call machine_slope(machine, linear, here, slope)
    motion = matmul(slope, motion/norm2(abs(motion))) ! shape at the rate itself, to the square of the step
    call solve_general(matrix, motion, mode%sharp)
    mode%rate = here + move
    if (abs(aimag(mode%rate)) <= tolerance*abs(mode%rate)) mode%rate = real(mode%rate, wp)
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
