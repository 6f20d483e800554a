!> The mass above which a rigid shaft whirls, at an answer of given load and speed.
!>
!> A shaft of mass m on the film obeys \( (Z(\omega) - m \omega^2) s = 0 \) with the 2 x 2
!> coefficients of translation where it neither grows nor decays. So an eigenvalue
!> \( \kappa(\omega) \) of Z is real there, and \( m = \kappa/\omega^2 \). Both eigenvalues are
!> followed over the frequency; where the imaginary part of one changes its sign the frequency is
!> found by solving there. The smallest mass decides: below it the shaft is stable. Where it
!> is not positive, as in a concentric ring, every mass whirls (Nyquist's path encircles the origin
!> without any mass): the critical mass is zero.
module gfb_whirl
  use gfb_kinds, only: wp
  use gfb_run_log, only: run_log_type
  use gfb_root_bracket, only: root_bracket_type
  use gfb_bearing_system, only: bearing_system_type
  use gfb_dynamic_response, only: dynamic_response_type
  use gfb_frequency_response, only: frequency_response_type, cover_part, add_sample
  use gfb_rational_response, only: rational_response_type
  use gfb_planar_eigenvalues, only: planar_eigenvalues
  implicit none (type, external)
  private
  public :: find_critical_mass

  integer, parameter :: points = 20           !! frequencies looked at first
  real(wp), parameter :: lowest = 0.05_wp     !! of them, over the speed [1]
  real(wp), parameter :: highest = 1.2_wp     !! [1]
  real(wp), parameter :: tolerance = 1.0e-12_wp !! of a whirl's frequency over the speed [1]
  integer, parameter :: most_trials = 40      !! to find one
  integer, parameter :: translations = 1      !! part of a response that holds them
  integer, parameter :: most_samples = 6      !! taken where the whirl is
  !> distance from the last one over which it is exact to its square [1]
  real(wp), parameter :: near_sample = 1.0e-6_wp

  !> The whirl that sets in first.
  type, public :: whirl_type
    logical :: searched = .false.     !! all frequencies could be looked at
    logical :: found = .false.        !! some mass whirls
    real(wp) :: critical_mass = 0.0_wp !! [kg]
    real(wp) :: ratio = 0.0_wp         !! frequency over speed [1]
    logical :: weighs = .false.        !! the foil had its mass
  end type whirl_type

contains

  !> Looks for whirl between 0.05 and 1.2 times the speed. What decides is solved where the whirl
  !> is, not only interpolated.
  subroutine find_critical_mass(bearing, response, log, model, whirl)
    type(bearing_system_type), intent(in) :: bearing !! as it was when the response was created
    type(dynamic_response_type), intent(inout) :: response !! of it
    type(run_log_type), intent(in) :: log !! where waiting lines go
    !> samples so far; gets those that are needed here
    type(frequency_response_type), intent(inout) :: model
    type(whirl_type), intent(out) :: whirl !! what was found
    real(wp) :: ratio(points), before
    integer :: i

    ratio = [(lowest*(highest/lowest)**(real(i - 1, wp)/real(points - 1, wp)), i=1, points)]
    call cover_part(bearing, response, translations, ratio*bearing%point%speed, log, model, &
      whirl%searched)
    do i = 1, most_samples
      if (.not. whirl%searched) return
      before = whirl%ratio
      whirl = smallest_whirl(model%part(translations), ratio, bearing%point%speed)
      if (.not. whirl%found .or. abs(whirl%ratio - before) <= near_sample) return
      call add_sample(bearing, response, translations, whirl%ratio*bearing%point%speed, model, &
        whirl%searched)
    end do
  end subroutine find_critical_mass

  !> The smallest mass that whirls between the first and the last of some frequencies.
  pure function smallest_whirl(model, ratio, speed) result(whirl)
    type(rational_response_type), intent(in) :: model !! of the translations
    !> of frequencies to the speed, between two of which a branch has one whirl [1]
    real(wp), intent(in) :: ratio(:)
    real(wp), intent(in) :: speed    !! [rad/s]
    type(whirl_type) :: whirl
    complex(wp) :: before(2), here(2)
    integer :: i, branch

    whirl%searched = .true.
    before = eigenvalues_at(model, ratio(1)*speed)
    do i = 2, size(ratio)
      here = sorted(eigenvalues_at(model, ratio(i)*speed), before)
      do branch = 1, 2
        if (aimag(before(branch))*aimag(here(branch)) > 0.0_wp) cycle
        call refine(model, speed, ratio(i - 1:i), [before(branch), here(branch)], whirl)
      end do
      before = here
    end do
  end function smallest_whirl

  !> Eigenvalues of the translations' coefficients at a frequency.
  pure function eigenvalues_at(model, frequency) result(kappa)
    type(rational_response_type), intent(in) :: model
    real(wp), intent(in) :: frequency !! [rad/s]
    complex(wp) :: kappa(2) !! [N/m]
    complex(wp), allocatable :: coefficient(:, :)

    coefficient = model%at(frequency)
    kappa = planar_eigenvalues(coefficient(:2, :2))
  end function eigenvalues_at

  !> Two eigenvalues in the order of those of the neighbouring frequency.
  pure function sorted(kappa, neighbour) result(order)
    complex(wp), intent(in) :: kappa(2), neighbour(2)
    complex(wp) :: order(2)

    order = kappa
    if (sum(abs(kappa(2:1:-1) - neighbour)) < sum(abs(kappa - neighbour))) order = kappa(2:1:-1)
  end function sorted

  !> Finds where a branch's imaginary part vanishes between two frequencies, by false position with
  !> halved weights (Illinois); a smaller mass than the one found so far is kept.
  pure subroutine refine(model, speed, ratio, branch, whirl)
    type(rational_response_type), intent(in) :: model
    real(wp), intent(in) :: speed        !! [rad/s]
    real(wp), intent(in) :: ratio(2)     !! of both ends, over the speed [1]
    complex(wp), intent(in) :: branch(2) !! eigenvalue there [N/m]
    type(whirl_type), intent(inout) :: whirl
    type(root_bracket_type) :: bracket
    real(wp) :: trial, mass
    complex(wp) :: kappa(2), here
    integer :: i

    bracket = root_bracket_type(ratio(1), ratio(2), aimag(branch(1)), aimag(branch(2)))
    trial = ratio(1)
    here = branch(1)
    do i = 1, most_trials
      if (abs(bracket%at_low - bracket%at_high) <= 0.0_wp .or. &
          abs(bracket%high - bracket%low) <= tolerance) exit
      trial = bracket%trial()
      kappa = eigenvalues_at(model, trial*speed)
      here = near(kappa, branch(1) + (branch(2) - branch(1))* &
                     (trial - ratio(1))/(ratio(2) - ratio(1)))
      if (abs(aimag(here)) <= tolerance*maxval(abs(branch))) exit
      call bracket%narrow(trial, aimag(here))
    end do
    mass = max(0.0_wp, real(here, wp)/(trial*speed)**2)
    if (whirl%found .and. mass >= whirl%critical_mass) return
    whirl%found = .true.
    whirl%critical_mass = mass
    whirl%ratio = trial
  end subroutine refine

  !> The one of two eigenvalues that is nearest to a guess.
  pure function near(kappa, guess) result(value)
    complex(wp), intent(in) :: kappa(2), guess
    complex(wp) :: value

    value = kappa(1)
    if (abs(kappa(2) - guess) < abs(kappa(1) - guess)) value = kappa(2)
  end function near
end module gfb_whirl
