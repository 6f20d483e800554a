#include "gfb_petsc.h"
!> The determinant of film, foil and rotor together, and its zeros: the rates of their modes.
!>
!> With the equations \( A(\lambda) x = 0 \) of film and foil about a shaft that is held, and the rotor's \( D(\lambda) \)
!> (`gfb_rotor`), which is what is left of them when film and foil are eliminated, it is
!>
!> $$ \det A(\lambda) \cdot \det D(\lambda). $$
!>
!> \( \det D \) alone has a pole at each mode of film and foil about a shaft that is held, often next to a zero; the
!> product has none, so its zeros can be counted, and found from starts nearby.
module gfb_rotor_determinant
  use gfb_kinds, only: wp
  use gfb_film_surface, only: journal_motions
  use gfb_bearing_system, only: bearing_system_type
  use gfb_dynamic_response, only: dynamic_response_type, find_coefficients
  use gfb_rotor, only: rotor_type, cylindrical, dynamic_matrix, determinant
  use gfb_counted_function, only: counted_function_type
  implicit none (type, external)
  private
  public :: find_determinant, film_determinant, solve_mode

  real(wp), parameter, public :: first_move = 1.0e-5_wp !! of the secant method, over the rate [1]
  real(wp), parameter :: tolerance = 1.0e-11_wp !! of a rate [1]
  real(wp), parameter, public :: rounded = 1.0e-8_wp    !! change of a rate that is accepted where it becomes no smaller [1]
  real(wp), parameter :: farthest = 0.05_wp     !! from its start is another mode, over the rate [1]
  integer, parameter, public :: most_trials = 30        !! of the secant method

  !> The determinant of the motions of a kind.
  type, extends(counted_function_type), public :: rotor_determinant_type
    type(bearing_system_type), pointer :: bearing => null() !! as it was when the response was created
    type(dynamic_response_type), pointer :: response => null() !! of it
    type(rotor_type) :: rotor !! on the bearing
    integer :: kind = cylindrical !! of the motions
  contains
    procedure :: evaluate => evaluate_determinant
  end type rotor_determinant_type

contains

  !> Logarithm of the determinant at a rate, up to multiples of 2 pi i; where the solver of film and foil has none, of the rotor's own,
  !> which has the same zeros, and a pole at each mode of film and foil.
  subroutine find_determinant(bearing, response, rotor, kind, rate, logarithm, found, of_film)
    type(bearing_system_type), intent(in) :: bearing !! as it was when the response was created
    type(dynamic_response_type), intent(inout) :: response !! of it
    type(rotor_type), intent(in) :: rotor !! on the bearing
    integer, intent(in) :: kind !! of the motions
    complex(wp), intent(in) :: rate !! lambda [1/s]
    complex(wp), intent(out) :: logarithm !! of scaled equations [1]
    logical, intent(out) :: found !! the matrices could be factorized
    complex(wp), intent(out), optional :: of_film !! part of it that is film and foil about a shaft that is held [1]
    complex(wp) :: coefficient(journal_motions, journal_motions), of_rotor

    call find_coefficients(bearing, response, rate, coefficient, found, only_translations=kind == cylindrical)
    if (.not. found) return
    of_rotor = safe_log(determinant(dynamic_matrix(rotor, kind, coefficient, rate, bearing%point%speed)))
    logarithm = of_rotor
    if (present(of_film)) of_film = 0.0_wp
    if (.not. response%part(1)%solver%has_determinant()) return
    call film_determinant(response, kind == cylindrical, logarithm)
    if (present(of_film)) of_film = logarithm - of_rotor
  end subroutine find_determinant

  !> Adds the logarithm of the determinant of film and foil about a shaft that is held, at the rate of the last coefficients.
  subroutine film_determinant(response, only_translations, logarithm)
    type(dynamic_response_type), intent(in) :: response !! whose solver has determinants
    logical, intent(in) :: only_translations !! tilts were not asked for
    complex(wp), intent(inout) :: logarithm !! gets it added [1]
    integer :: i

    do i = 1, merge(1, size(response%part), only_translations)
      logarithm = logarithm + response%part(i)%solver%log_determinant()
    end do
    if (.not. only_translations .and. allocated(response%opposite)) then
      logarithm = logarithm + response%opposite%part(1)%solver%log_determinant()
    end if
  end subroutine film_determinant

  !> The same of a motion's kind, as a function whose zeros are counted.
  subroutine evaluate_determinant(self, rate, logarithm, found)
    class(rotor_determinant_type), intent(inout) :: self !! the function
    complex(wp), intent(in) :: rate !! lambda [1/s]
    complex(wp), intent(out) :: logarithm !! of scaled equations [1]
    logical, intent(out) :: found !! the matrices could be factorized
    call find_determinant(self%bearing, self%response, self%rotor, self%kind, rate, logarithm, found)
  end subroutine evaluate_determinant

  !> Solves for a zero of the determinant next to a rate by the secant method; other zeros that are known are divided
  !> out, so that the nearest of them do not lead astray. Where film and foil make the determinant so steep that no line follows
  !> it, as foils do that lose something, the exponential with their slope at the start is divided out, which has no zero.
  subroutine solve_mode(bearing, response, rotor, kind, rate, found, others, steep)
    type(bearing_system_type), intent(in) :: bearing !! as it was when the response was created
    type(dynamic_response_type), intent(inout) :: response !! of it
    type(rotor_type), intent(in) :: rotor !! on the bearing
    integer, intent(in) :: kind !! of the mode
    complex(wp), intent(inout) :: rate !! start, and the mode's where it is found [1/s]
    logical, intent(out) :: found !! it converged next to the start
    complex(wp), intent(in), optional :: others(:) !! rates of other modes of the kind, one of each conjugate pair [1/s]
    logical, intent(in), optional :: steep !! film and foil make it so
    complex(wp) :: before, here, at_before, at_here, move, reference, film, at_film, slope
    real(wp) :: last_move
    logical :: steepens
    integer :: i

    before = rate
    here = rate*(1.0_wp + first_move)
    last_move = huge(1.0_wp)
    call find_determinant(bearing, response, rotor, kind, before, reference, found, film)
    if (.not. found) return
    reference = reference - others_at(before)
    slope = 0.0_wp
    steepens = .false.
    if (present(steep)) steepens = steep
    at_before = 1.0_wp
    do i = 1, most_trials
      call find_determinant(bearing, response, rotor, kind, here, at_here, found, at_film)
      if (.not. found) return
      if (steepens .and. i == 1) slope = log(exp(at_film - film))/(here - before)
      at_here = exp(at_here - others_at(here) - reference - slope*(here - rate))
      if (abs(at_here - at_before) <= 0.0_wp) exit
      ! Next to a mode of the foil, whose determinant is divided out, round-off decides before moves do.
      if (last_move <= rounded*abs(here) .and. abs(at_here) >= abs(at_before)) then
        rate = here
        return
      end if
      move = -at_here*(here - before)/(at_here - at_before)
      before = here
      at_before = at_here
      here = here + move
      found = abs(here - rate) <= farthest*abs(rate)
      if (.not. found) return
      if (abs(move) <= tolerance*abs(here) .or. (abs(move) <= rounded*abs(here) .and. abs(move) >= last_move)) then
        rate = here
        return
      end if
      last_move = abs(move)
    end do
    found = .false.

  contains

    !> Logarithm of the product of distances to the other zeros.
    function others_at(place) result(logarithm)
      complex(wp), intent(in) :: place !! [1/s]
      complex(wp) :: logarithm
      integer :: k

      logarithm = 0.0_wp
      if (.not. present(others)) return
      do k = 1, size(others)
        logarithm = logarithm + safe_log(place - others(k))
        if (aimag(others(k)) > 0.0_wp) logarithm = logarithm + safe_log(place - conjg(others(k)))
      end do
    end function others_at
  end subroutine solve_mode

  !> Logarithm of a number, and of nothing that of next to nothing.
  elemental function safe_log(number) result(logarithm)
    complex(wp), intent(in) :: number !! in any unit [SI]
    complex(wp) :: logarithm
    logarithm = cmplx(log(max(tiny(1.0_wp), abs(number))), atan2(aimag(number), real(number, wp)), wp)
  end function safe_log
end module gfb_rotor_determinant
