#include "gfb_petsc.h"
!> Coefficients of small vibrations at many frequencies from few factorizations.
!>
!> Values and slopes at some of the frequencies, one factorization for each, give a rational function of the frequency
!> (`gfb_rational_response`) for motions of each symmetry about z = 0. Another sample is taken where the last one has moved the
!> function most, until it moved no entry by more than the tolerance, at its own frequency by what is solved there, at the others
!> by what the function says; what it moves next is less by orders of magnitude.
!>
!> The function also shows where frequencies must stand so that straight lines from one to the next are the coefficients. Lines
!> between two neighbours are compared with it at quarters of their way and next to each rate \( -\delta + i \omega \) of a motion
!> that film and foil have by themselves while the shaft is held: at \( \omega \), where its peak is, and at
!> \( \omega \pm \delta \), where its sides are steepest. A line that misses anywhere is halved, so that frequencies do not hang on
!> the last digits of a rate. By itself a frequency costs no factorization.
module gfb_frequency_response
  use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan
  use gfb_kinds, only: wp
  use gfb_text, only: text
  use gfb_run_log, only: run_log_type
  use gfb_rational_response, only: rational_response_type
  use gfb_bearing_system, only: bearing_system_type
  use gfb_dynamic_response, only: dynamic_response_type, find_sample, release_parts, take_over_counts
  implicit none (type, external)
  private
  public :: cover_frequencies, cover_part, add_sample, coefficients_at, coefficients_beside, join_frequencies, places_to_look, miss_of_line

  !> of what the last sample moves, relative to the largest entry at a frequency [1]
  real(wp), parameter :: function_tolerance = 3.0e-7_wp
  integer, parameter :: looked_at = 20 !! steps from end to end at which the function is known before it is asked for peaks
  !> that the function is known better than lines where these are looked at: samples next to a peak carry its round-off
  integer, parameter :: times_better = 100
  integer, parameter :: tilts = 2 !! of the shaft's motions, the last ones
  integer, parameter, public :: most_joined = 2000 !! frequencies; each is a row of the table

  !> The function of each symmetry.
  type, public :: frequency_response_type
    type(rational_response_type), allocatable :: part(:) !! one a part of the response
    type(frequency_response_type), allocatable :: opposite !! that of tilts, where their foil is another
    real(wp) :: failed = 0.0_wp !! frequency at which nothing was solved [rad/s]
  end type frequency_response_type

  !> What came of frequencies that were put between others.
  type, public :: joined_type
    logical :: found = .false.       !! all that was asked for could be solved
    logical :: by_function = .true.  !! else no function goes through the samples, and nothing was added
    real(wp) :: largest_miss = 0.0_wp !! of a line, over the largest entry of like coordinates; NaN without a function [1]
  end type joined_type

contains

  !> Takes the samples that frequencies need, of all motions.
  recursive subroutine cover_frequencies(bearing, response, frequency, log, model, found, allowed)
    type(bearing_system_type), intent(in) :: bearing !! as it was when the response was created
    type(dynamic_response_type), intent(inout) :: response !! of it
    real(wp), intent(in) :: frequency(:) !! wanted, not negative [rad/s]
    type(run_log_type), intent(in) :: log !! where waiting lines go
    type(frequency_response_type), intent(inout) :: model !! gets the samples
    logical, intent(out) :: found !! else nothing is solved at `failed`
    real(wp), intent(in), optional :: allowed !! error of the function [1]; then no more samples than one goes through
    integer :: i

    found = .true.
    do i = 1, size(response%part)
      call cover_part(bearing, response, i, frequency, log, model, found, allowed)
      if (.not. found) return
    end do
    if (.not. allocated(response%opposite)) return
    call release_parts(response)
    if (.not. allocated(model%opposite)) allocate (model%opposite)
    call cover_frequencies(response%opposite_bearing, response%opposite, frequency, log, model%opposite, found, allowed)
    model%failed = model%opposite%failed
    call take_over_counts(response)
  end subroutine cover_frequencies

  !> Takes the samples that frequencies need, of the motions of a part.
  subroutine cover_part(bearing, response, number, frequency, log, model, found, allowed)
    type(bearing_system_type), intent(in) :: bearing !! as it was when the response was created
    type(dynamic_response_type), intent(inout) :: response !! of it
    integer, intent(in) :: number !! of the part
    real(wp), intent(in) :: frequency(:) !! wanted, not negative [rad/s]
    type(run_log_type), intent(in) :: log !! where waiting lines go
    type(frequency_response_type), intent(inout) :: model !! gets the samples
    logical, intent(out) :: found !! else nothing is solved at `failed`
    real(wp), intent(in), optional :: allowed !! error of the function [1]; then no more samples than one goes through
    real(wp) :: error
    integer :: next

    found = .true.
    error = function_tolerance
    if (present(allowed)) error = allowed
    if (.not. allocated(model%part)) allocate (model%part(size(response%part)))
    if (.not. model%part(number)%fits()) model%part(number) = rational_response_type() ! other frequencies may be fewer
    model%part(number)%is_real = .not. response%equations%vibration%loss_factor > 0.0_wp
    do
      if (present(allowed) .and. .not. model%part(number)%fits()) exit
      next = model%part(number)%next_sample(frequency, error)
      if (next == 0) exit
      call log%is_at('vibration at '//text(frequency(next), 4)//' rad/s')
      call add_sample(bearing, response, number, frequency(next), model, found)
      if (.not. found) exit
    end do
    call log%is_at('')
  end subroutine cover_part

  !> Takes a sample of a part at a frequency.
  subroutine add_sample(bearing, response, number, frequency, model, found, growth)
    type(bearing_system_type), intent(in) :: bearing !! as it was when the response was created
    type(dynamic_response_type), intent(inout) :: response !! of it
    integer, intent(in) :: number !! of the part
    real(wp), intent(in) :: frequency !! [rad/s]
    type(frequency_response_type), intent(inout) :: model !! gets the sample
    logical, intent(out) :: found !! else nothing is solved at `failed`
    real(wp), intent(in), optional :: growth !! delta of a sample at the rate delta + i omega [1/s]; default: 0
    complex(wp), dimension(size(response%part(number)%coordinate), size(response%part(number)%coordinate)) :: value, slope
    complex(wp) :: rate

    rate = cmplx(0.0_wp, frequency, wp)
    if (present(growth)) rate = rate + growth
    call find_sample(bearing, response, number, rate, value, slope, found)
    if (found) call model%part(number)%add(frequency, value, slope, growth)
    if (.not. found) model%failed = frequency
  end subroutine add_sample

  !> Z at a frequency that was covered.
  pure recursive function coefficients_at(response, model, frequency) result(coefficient)
    type(dynamic_response_type), intent(in) :: response !! whose motions they are
    type(frequency_response_type), intent(in) :: model  !! of it
    real(wp), intent(in) :: frequency !! [rad/s]
    complex(wp) :: coefficient(size(response%motion), size(response%motion)) !! (force, motion), 0 by symmetry [SI]
    integer :: i

    coefficient = 0.0_wp
    do i = 1, size(response%part)
      associate (k => response%part(i)%coordinate)
        coefficient(k, k) = model%part(i)%at(frequency)
      end associate
    end do
    if (allocated(response%opposite)) coefficient = coefficient + coefficients_at(response%opposite, model%opposite, frequency)
  end function coefficients_at

  !> Z of motions \( e^{\lambda t} \) as the function has it beside the frequencies that were covered, and its derivative.
  pure recursive subroutine coefficients_beside(response, model, rate, coefficient, slope)
    type(dynamic_response_type), intent(in) :: response !! whose motions they are
    type(frequency_response_type), intent(in) :: model  !! of it
    complex(wp), intent(in) :: rate !! lambda [1/s]
    complex(wp), intent(out) :: coefficient(:, :), slope(:, :) !! (force, motion), 0 by symmetry [SI]
    complex(wp), dimension(size(coefficient, 1), size(coefficient, 1)) :: other, other_slope
    integer :: i

    coefficient = 0.0_wp
    slope = 0.0_wp
    do i = 1, size(response%part)
      associate (k => response%part(i)%coordinate)
        call model%part(i)%beside(rate, other(:size(k), :size(k)), other_slope(:size(k), :size(k)))
        coefficient(k, k) = other(:size(k), :size(k))
        slope(k, k) = other_slope(:size(k), :size(k))
      end associate
    end do
    if (.not. allocated(response%opposite)) return
    call coefficients_beside(response%opposite, model%opposite, rate, other, other_slope)
    coefficient = coefficient + other
    slope = slope + other_slope
  end subroutine coefficients_beside

  !> Whether a function of the frequency goes through the samples, of all motions.
  pure recursive function is_function(model) result(is)
    type(frequency_response_type), intent(in) :: model !! with samples
    logical :: is
    integer :: i

    is = all([(model%part(i)%fits(), i=1, size(model%part))])
    if (allocated(model%opposite)) is = is_function(model%opposite) .and. is
  end function is_function

  !> Rates of the motions that film and foil have by themselves while the shaft is held, of all that the samples show.
  pure recursive function poles_of(model) result(rate)
    type(frequency_response_type), intent(in) :: model !! with a function through its samples
    complex(wp), allocatable :: rate(:) !! [rad/s]
    integer :: i

    allocate (rate(0))
    do i = 1, size(model%part)
      rate = [rate, model%part(i)%poles()]
    end do
    if (allocated(model%opposite)) rate = [rate, poles_of(model%opposite)]
  end function poles_of

  !> Adds frequencies until lines between neighbours are K and C.
  subroutine join_frequencies(bearing, response, tolerance, log, model, frequency, joined)
    type(bearing_system_type), intent(in) :: bearing !! as it was when the response was created
    type(dynamic_response_type), intent(inout) :: response !! of it
    real(wp), intent(in) :: tolerance !! of a line's miss, over the largest entry of like coordinates [1]
    type(run_log_type), intent(in) :: log !! where waiting lines go
    type(frequency_response_type), intent(inout) :: model !! gets the samples
    real(wp), allocatable, intent(inout) :: frequency(:) !! two or more, rising; gets those between them [rad/s]
    type(joined_type), intent(out) :: joined !! what came of it
    real(wp), allocatable :: asked(:), place(:), closer(:)
    real(wp) :: allowed
    integer :: samples, i

    asked = frequency
    allowed = function_tolerance
    associate (first => asked(1), last => asked(size(asked)))
      place = [(first + (last - first)*real(i, wp)/real(looked_at, wp), i=1, looked_at - 1)]
    end associate
    do
      samples = response%factorizations
      call cover_frequencies(bearing, response, [frequency, place], log, model, joined%found, allowed)
      if (.not. joined%found) return
      joined%by_function = is_function(model)
      if (.not. joined%by_function) exit
      if (response%factorizations == samples) then
        call halve_lines(response, model, frequency, place, tolerance, closer, joined%largest_miss)
        if (size(closer) == size(frequency) .or. size(closer) > most_joined) return
        call move_alloc(closer, frequency)
      end if
      place = places_to_look(frequency, poles_of(model))
      allowed = max(function_tolerance, tolerance/times_better)
    end do
    frequency = asked
    joined%largest_miss = ieee_value(1.0_wp, ieee_quiet_nan)
    call cover_frequencies(bearing, response, frequency, log, model, joined%found)
  end subroutine join_frequencies

  !> Where lines are compared with K and C.
  pure function places_to_look(frequency, pole) result(place)
    real(wp), intent(in) :: frequency(:) !! rising [rad/s]
    complex(wp), intent(in) :: pole(:)   !! of K and C, as rates [rad/s]
    real(wp), allocatable :: place(:)    !! [rad/s]

    associate (n => size(frequency), peak => aimag(pole), width => abs(real(pole, wp)))
      place = [0.75_wp*frequency(:n - 1) + 0.25_wp*frequency(2:), 0.5_wp*(frequency(:n - 1) + frequency(2:)), &
               0.25_wp*frequency(:n - 1) + 0.75_wp*frequency(2:), peak - width, peak, peak + width]
      place = pack(place, place > frequency(1) .and. place < frequency(n))
    end associate
  end function places_to_look

  !> Puts a frequency in the middle of each line that misses.
  pure subroutine halve_lines(response, model, frequency, place, tolerance, closer, largest_miss)
    type(dynamic_response_type), intent(in) :: response !! whose coefficients they are
    type(frequency_response_type), intent(in) :: model !! of it
    real(wp), intent(in) :: frequency(:) !! rising [rad/s]
    real(wp), intent(in) :: place(:) !! where lines are looked at, in any order [rad/s]
    real(wp), intent(in) :: tolerance !! of a miss [1]
    real(wp), allocatable, intent(out) :: closer(:) !! the frequencies with those that were put between them [rad/s]
    real(wp), intent(out) :: largest_miss !! of all lines [1]
    complex(wp), allocatable, dimension(:, :) :: below, above
    real(wp) :: miss
    integer :: i, k

    closer = frequency(:1)
    largest_miss = 0.0_wp
    above = coefficients_at(response, model, frequency(1))
    do i = 2, size(frequency)
      below = above
      above = coefficients_at(response, model, frequency(i))
      miss = 0.0_wp
      do k = 1, size(place)
        if (place(k) <= frequency(i - 1) .or. place(k) >= frequency(i)) cycle
        miss = max(miss, miss_of_line(frequency(i - 1:i), place(k), below, above, coefficients_at(response, model, place(k))))
      end do
      if (miss > tolerance) closer = [closer, 0.5_wp*(frequency(i - 1) + frequency(i))]
      closer = [closer, frequency(i)]
      largest_miss = max(largest_miss, miss)
    end do
  end subroutine halve_lines

  !> How far lines between two frequencies miss K and C, over their largest entry of like coordinates.
  pure function miss_of_line(ends, place, below, above, here) result(miss)
    real(wp), intent(in) :: ends(2) !! of the lines [rad/s]
    real(wp), intent(in) :: place   !! between them [rad/s]
    complex(wp), dimension(:, :), intent(in) :: below, above !! Z at the ends [SI]
    complex(wp), intent(in) :: here(:, :) !! Z at the place [SI]
    real(wp) :: miss !! [1]
    real(wp) :: share

    share = (place - ends(1))/(ends(2) - ends(1))
    miss = max(off_line(real(below, wp), real(above, wp), real(here, wp)), &
               off_line(aimag(below)/ends(1), aimag(above)/ends(2), aimag(here)/place))

  contains

    !> The same of one of them. Entries between a displacement and a tilt are measured by the mean of both, the geometric one.
    pure function off_line(below, above, here) result(off)
      real(wp), dimension(:, :), intent(in) :: below, above, here !! [SI]
      real(wp) :: off !! [1]
      real(wp), dimension(size(here, 1)) :: largest
      real(wp), dimension(size(here, 1), size(here, 1)) :: entry

      entry = max(abs(below), abs(above), abs(here))
      associate (n => size(here, 1), first => size(here, 1) - tilts)
        largest(:first) = maxval(entry(:first, :first))
        largest(first + 1:) = maxval(entry(first + 1:, first + 1:))
        off = maxval(abs(here - below - share*(above - below))/ &
                     max(tiny(1.0_wp), sqrt(spread(largest, 1, n)*spread(largest, 2, n))))
      end associate
    end function off_line
  end function miss_of_line
end module gfb_frequency_response
