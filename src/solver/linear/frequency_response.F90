#include "gfb_petsc.h"
!> Coefficients of small vibrations at many frequencies from few factorizations.
!>
!> Values and slopes at some of the frequencies, one factorization for each, give a rational function of the frequency
!> (`gfb_rational_response`) for motions of each symmetry about z = 0. Another sample is taken where the last one has moved the
!> function most, until it moved no entry by more than the tolerance, at its own frequency by what is solved there, at the others
!> by what the function says; what it moves next is less by orders of magnitude.
module gfb_frequency_response
  use gfb_kinds, only: wp
  use gfb_text, only: text
  use gfb_run_log, only: run_log_type
  use gfb_rational_response, only: rational_response_type
  use gfb_bearing_system, only: bearing_system_type
  use gfb_dynamic_response, only: dynamic_response_type, find_sample, take_over_counts
  implicit none (type, external)
  private
  public :: cover_frequencies, cover_part, add_sample, coefficients_at

  real(wp), parameter :: tolerance = 3.0e-7_wp !! of what the last sample moves, relative to the largest entry at a frequency [1]

  !> The function of each symmetry.
  type, public :: frequency_response_type
    type(rational_response_type), allocatable :: part(:) !! one a part of the response
    type(frequency_response_type), allocatable :: opposite !! that of tilts, where their foil is another
    real(wp) :: failed = 0.0_wp !! frequency at which nothing was solved [rad/s]
  end type frequency_response_type

contains

  !> Takes the samples that frequencies need, of all motions.
  recursive subroutine cover_frequencies(bearing, response, frequency, log, model, found)
    type(bearing_system_type), intent(in) :: bearing !! as it was when the response was created
    type(dynamic_response_type), intent(inout) :: response !! of it
    real(wp), intent(in) :: frequency(:) !! wanted, not negative [rad/s]
    type(run_log_type), intent(in) :: log !! where waiting lines go
    type(frequency_response_type), intent(inout) :: model !! gets the samples
    logical, intent(out) :: found !! else nothing is solved at `failed`
    integer :: i

    found = .true.
    do i = 1, size(response%part)
      call cover_part(bearing, response, i, frequency, log, model, found)
      if (.not. found) return
    end do
    if (.not. allocated(response%opposite)) return
    if (.not. allocated(model%opposite)) allocate (model%opposite)
    call cover_frequencies(response%opposite_bearing, response%opposite, frequency, log, model%opposite, found)
    model%failed = model%opposite%failed
    call take_over_counts(response)
  end subroutine cover_frequencies

  !> Takes the samples that frequencies need, of the motions of a part.
  subroutine cover_part(bearing, response, number, frequency, log, model, found)
    type(bearing_system_type), intent(in) :: bearing !! as it was when the response was created
    type(dynamic_response_type), intent(inout) :: response !! of it
    integer, intent(in) :: number !! of the part
    real(wp), intent(in) :: frequency(:) !! wanted, not negative [rad/s]
    type(run_log_type), intent(in) :: log !! where waiting lines go
    type(frequency_response_type), intent(inout) :: model !! gets the samples
    logical, intent(out) :: found !! else nothing is solved at `failed`
    integer :: next

    found = .true.
    if (.not. allocated(model%part)) allocate (model%part(size(response%part)))
    if (.not. model%part(number)%fits()) model%part(number) = rational_response_type() ! other frequencies may be fewer
    model%part(number)%is_real = .not. response%equations%vibration%loss_factor > 0.0_wp
    do
      next = model%part(number)%next_sample(frequency, tolerance)
      if (next == 0) exit
      call log%is_at('vibration at '//text(frequency(next), 4)//' rad/s')
      call log%waiting('')
      call add_sample(bearing, response, number, frequency(next), model, found)
      if (.not. found) exit
    end do
    call log%is_at('')
  end subroutine cover_part

  !> Takes a sample of a part at a frequency.
  subroutine add_sample(bearing, response, number, frequency, model, found)
    type(bearing_system_type), intent(in) :: bearing !! as it was when the response was created
    type(dynamic_response_type), intent(inout) :: response !! of it
    integer, intent(in) :: number !! of the part
    real(wp), intent(in) :: frequency !! [rad/s]
    type(frequency_response_type), intent(inout) :: model !! gets the sample
    logical, intent(out) :: found !! else nothing is solved at `failed`
    complex(wp), dimension(size(response%part(number)%coordinate), size(response%part(number)%coordinate)) :: value, slope

    call find_sample(bearing, response, number, cmplx(0.0_wp, frequency, wp), value, slope, found)
    if (found) call model%part(number)%add(frequency, value, slope)
    if (.not. found) model%failed = frequency
  end subroutine add_sample

  !> Z at a frequency that was covered.
  recursive function coefficients_at(response, model, frequency) result(coefficient)
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
end module gfb_frequency_response
