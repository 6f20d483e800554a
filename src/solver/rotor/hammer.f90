!> Pneumatic hammer of a bearing that is fed or has deep grooves: where the film's damping along an
!> axis is negative a heavy runner grows.
!>
!> A mass m on the film obeys \( (Z(\omega) - m \omega^2) s = 0 \) where it neither grows nor
!> decays, with \( Z = K + i \omega C \) along the axis. So C vanishes there, and
!> \( m = K/\omega^2 \): gas that pockets, orifices or grooves hold back answers late, and below
!> that frequency drives what it should damp. The smallest mass decides; below it a runner is
!> stable.
module gfb_hammer
  use gfb_kinds, only: wp
  use gfb_bearing_system, only: bearing_system_type
  use gfb_dynamic_response, only: dynamic_response_type
  use gfb_frequency_response, only: frequency_response_type, cover_part, add_sample
  use gfb_rational_response, only: rational_response_type
  use gfb_root_bracket, only: root_bracket_type
  use gfb_run_log, only: run_log_type
  implicit none (type, external)
  private
  public :: find_hammer

  integer, parameter :: points = 25            !! frequencies looked at first
  real(wp), parameter :: lowest = 10.0_wp      !! of them [rad/s]
  real(wp), parameter :: highest = 1.0e6_wp    !! [rad/s]
  real(wp), parameter :: tolerance = 1.0e-12_wp !! of the frequency, relative [1]
  real(wp), parameter :: round_off = 1.0e-9_wp !! of K: a smaller imaginary part of Z is none [1]
  integer, parameter :: most_trials = 60       !! to find one
  integer, parameter :: axial = 1              !! part of a response that holds the axis
  integer, parameter :: most_samples = 6       !! taken where it is
  real(wp), parameter :: near_sample = 1.0e-6_wp !! exact to its square from there, relative [1]

  !> The mass that grows first.
  type, public :: hammer_type
    logical :: searched = .false.      !! all frequencies could be looked at
    logical :: found = .false.         !! some mass grows
    logical :: always = .false.        !! the film drives at all frequencies that were looked at
    real(wp) :: critical_mass = 0.0_wp !! [kg]
    real(wp) :: frequency = 0.0_wp     !! at which [rad/s]
  end type hammer_type

contains

  !> Looks for hammer between 10 and 1e6 rad/s. What decides is solved where it is.
  subroutine find_hammer(bearing, response, log, model, hammer)
    type(bearing_system_type), intent(in) :: bearing !! of a runner, as the response has it
    type(dynamic_response_type), intent(inout) :: response !! of it
    type(run_log_type), intent(in) :: log !! where waiting lines go
    !> samples so far; gets those that are needed here
    type(frequency_response_type), intent(inout) :: model
    type(hammer_type), intent(out) :: hammer !! what was found
    real(wp) :: frequency(points), before
    integer :: i

    frequency = [(lowest*(highest/lowest)**(real(i - 1, wp)/real(points - 1, wp)), i=1, points)]
    call cover_part(bearing, response, axial, frequency, log, model, hammer%searched)
    do i = 1, most_samples
      if (.not. hammer%searched) return
      before = hammer%frequency
      hammer = smallest_mass(model%part(axial), frequency)
      if (.not. hammer%found) return
      if (abs(hammer%frequency - before) <= near_sample*hammer%frequency) return
      call add_sample(bearing, response, axial, hammer%frequency, model, hammer%searched)
    end do
  end subroutine find_hammer

  !> The smallest mass where the damping changes its sign from negative to positive.
  pure type(hammer_type) function smallest_mass(model, frequency) result(hammer)
    type(rational_response_type), intent(in) :: model !! of the axis
    real(wp), intent(in) :: frequency(:) !! rising, between two of which there is one change [rad/s]
    complex(wp) :: before, here
    integer :: i

    hammer%searched = .true.
    hammer%always = .true.
    before = coefficient_at(model, frequency(1))
    do i = 2, size(frequency)
      here = coefficient_at(model, frequency(i))
      hammer%always = hammer%always .and. aimag(here) < -round_off*abs(here)
      if (aimag(before) < -round_off*abs(before) .and. aimag(here) > 0.0_wp) then
        call refine(model, frequency(i - 1:i), [aimag(before), aimag(here)], hammer)
      end if
      before = here
    end do
  end function smallest_mass

  !> Z along the axis.
  pure complex(wp) function coefficient_at(model, frequency) result(z)
    type(rational_response_type), intent(in) :: model
    real(wp), intent(in) :: frequency !! [rad/s]
    complex(wp), allocatable :: coefficient(:, :)

    coefficient = model%at(frequency)
    z = coefficient(1, 1)
  end function coefficient_at

  !> Finds where the imaginary part vanishes between two frequencies, by false position with halved
  !> weights (Illinois); a smaller mass than the one found so far is kept.
  pure subroutine refine(model, frequency, imaginary, hammer)
    type(rational_response_type), intent(in) :: model
    real(wp), intent(in) :: frequency(2) !! of both ends [rad/s]
    real(wp), intent(in) :: imaginary(2) !! part of Z there [N/m]
    type(hammer_type), intent(inout) :: hammer
    type(root_bracket_type) :: bracket
    real(wp) :: trial, mass
    complex(wp) :: z
    integer :: i

    bracket = root_bracket_type(frequency(1), frequency(2), imaginary(1), imaginary(2))
    do i = 1, most_trials
      trial = bracket%trial()
      z = coefficient_at(model, trial)
      if (abs(bracket%high - bracket%low) <= tolerance*trial .or. &
          abs(aimag(z)) <= tolerance*abs(z)) exit
      call bracket%narrow(trial, aimag(z))
    end do
    mass = max(0.0_wp, real(z, wp)/trial**2)
    if (hammer%found .and. mass >= hammer%critical_mass) return
    hammer%found = .true.
    hammer%critical_mass = mass
    hammer%frequency = trial
  end subroutine refine
end module gfb_hammer
