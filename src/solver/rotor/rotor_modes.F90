#include "gfb_petsc.h"
!> How a rigid rotor moves on its bearings: frequency and growth of its modes.
!>
!> A mode is a zero of the determinant of film, foil and rotor (`gfb_rotor_modes`). With a shift \( \sigma \) of half
!> the speed, all modes in the circle
!>
!> $$ |\lambda - \sigma| \le r, \qquad r \ge \sqrt{1 + 1.5^2} \, \Omega $$
!>
!> come from the eigenvalues next to the shift, and are counted along the circle by the determinant, which knows nothing of
!> the eigenvalues' method: where one is missing more eigenvalues are looked for. In the circle are all modes that lose less
!> than half the speed, up to 1.5 times the speed. The mode of the rotor that decides is solved for once more with the
!> determinant. Springs with dampers that relax by themselves (`gfb_rotor_pencil`) are left out where the circle comes near the
!> disc in which their rates lie: it goes past the disc or round it, and as many zeros as were counted in the disc are divided
!> out at its centre. Dampers beside springs that have no unknowns of their own, and Maxwell arms, are let grow from nothing,
!> and the rotor's modes are followed. A loss factor is defined for steady vibrations alone, so with one there are no
!> growth rates.
!>
!> How many zeros of an analytic function lie in a circle about a real centre, beside those that
!> are known.
!>
!> The function is real on the real axis, so its zeros are real or come in conjugate pairs, and the
!> upper half of the circle tells all. With the known zeros \( \lambda_j \) divided out,
!>
!> $$ g(\lambda) = f(\lambda) / \prod_j (\lambda - \lambda_j), $$
!>
!> the phase of g changes by \( \pi \) times the number of zeros left inside while \( \lambda \)
!> goes along the upper half of the circle (argument principle). Thousands of zeros far outside
!> change it, too, but not between the ends of the half circle; nearly all of that is \( a \sin
!> \theta \), with the same a as in the modulus, \( a \cos \theta \), whose ends tell it: it is
!> taken away. The half circle is divided until no step changes what is left by more than a fixed
!> angle; a zero that is not known and lies next to the circle makes a step of about half a turn
!> and is not passed over.
!>
!> The determinant of film, foil and rotor together, and its zeros: the rates of their modes.
!>
!> With the equations \( A(\lambda) x = 0 \) of film and foil about a shaft that is held, and the rotor's \( D(\lambda) \)
!> (`gfb_rotor`), which is what is left of them when film and foil are eliminated, it is
!>
!> $$ \det A(\lambda) \cdot \det D(\lambda). $$
!>
!> \( \det D \) alone has a pole at each mode of film and foil about a shaft that is held, often next to a zero; the
!> product has none, so its zeros can be counted, and found from starts nearby.
module gfb_rotor_modes
  use gfb_kinds, only: wp
  use gfb_units, only: pi
  use gfb_film_surface, only: journal_motions
  use gfb_bearing_system, only: bearing_system_type
  use gfb_dynamic_response, only: dynamic_response_type, find_coefficients, response_failure
  use gfb_rotor, only: rotor_type, cylindrical, dynamic_matrix, determinant, kinds_of, whirl_sense
  use gfb_mode_owner, only: of_rotor, owner_of, is_of_shaft, find_branches, least_share
  use gfb_text, only: text
  use gfb_rotor_pencil, only: pencil_mode_type, relaxation_type, find_pencil_modes, find_moving_share, has_pencil, &
                              skip_inner_modes, relaxation_of
  use gfb_vibration_equations, only: vibration_type
  implicit none (type, external)
  private
  public :: find_determinant, solve_mode, find_rotor_modes, find_axial_mode, find_all_modes

  integer, parameter :: first_steps = 16 !! of the half circle
  !> Of the phase; five times as much would not be seen.
  real(wp), parameter :: largest_step = pi/3.0_wp
  !> Of the way: there the circle runs through a zero.
  real(wp), parameter :: smallest_step = 1.0e-6_wp*pi
  integer, parameter :: most_places = 400 !! more mean that the phase has no sense

  !> The half circle and what is known along it. Fill the first three, then ask for places and
  !> tell values.
  type, public :: mode_count_type
    real(wp) :: centre = 0.0_wp           !! [1/s]
    real(wp) :: radius = 0.0_wp           !! [1/s]
    complex(wp), allocatable :: known(:)  !! zeros, one of each conjugate pair [1/s]
    integer :: steps = first_steps        !! in which the half circle is divided at first
    integer, private :: at_centre = 0     !! zeros that are known as well
    real(wp), allocatable :: angle(:)     !! of the places so far, rising from 0 to pi [rad]
    complex(wp), allocatable :: value(:)  !! logarithm of g there [1]
    logical :: failed = .false.           !! the circle runs through a zero
  contains
    procedure :: next, tell, place, missing, put_at_centre, mean
  end type mode_count_type

  real(wp), parameter :: first_move = 1.0e-5_wp !! of the secant method, over the rate [1]
  real(wp), parameter :: tolerance = 1.0e-11_wp !! of a rate [1]
  real(wp), parameter :: rounded = 1.0e-8_wp    !! change of a rate that is accepted where it becomes no smaller [1]
  real(wp), parameter :: farthest = 0.05_wp     !! from its start is another mode, over the rate [1]
  integer, parameter :: most_trials = 30        !! of the secant method

  real(wp), parameter :: shift = 0.5_wp        !! next to which modes are looked for, over the speed [1]
  real(wp), parameter :: highest = 1.5_wp      !! frequency of a mode that is told, over the speed [1]
  real(wp), parameter :: room = 1.3_wp         !! of the largest circle over the least [1]
  real(wp), parameter :: most_damped = 0.5_wp  !! damping ratio of a mode that is followed [1]
  integer, parameter :: damper_steps = 8       !! in which dampers are let grow
  integer, parameter :: first_wanted = 12      !! eigenvalues next to the shift
  integer, parameter :: most_wanted = 192      !! where more are needed their number is doubled up to this

  !> A mode \( e^{\lambda t} \).
  type, public :: rotor_mode_type
    integer :: kind = cylindrical
    complex(wp) :: rate = 0.0_wp    !! growth + i frequency, not negative [1/s]
    real(wp) :: share = 0.0_wp      !! of the rotor, against the film and the foil [1]
    real(wp) :: sense = 0.0_wp      !! 1: a circle with the speed, -1: against it [1]
    real(wp) :: foil_share = 0.0_wp !! of the foil's energy, against rotor and film [1]
    real(wp) :: moving_share = 1.0_wp !! of the rotor in what moves, rotor and foil [1]
    integer :: owner = of_rotor     !! whose it is, see `gfb_mode_owner`
  end type rotor_mode_type

  !> What was found.
  type, public :: rotor_answer_type
    logical :: defined = .true.  !! growth rates exist: no loss factor
    logical :: found = .false.   !! all modes in the circle, and the one that decides is sure
    logical :: counted = .true.  !! else there was no determinant, and one may be missing
    character(len=:), allocatable :: reason !! why not
    integer :: decides = 0       !! number of the least damped mode of the rotor; 0: there is none
    logical :: foil_grows = .false. !! a mode in which the rotor has no share grows
    type(rotor_mode_type), allocatable :: mode(:) !! growth falling
  end type rotor_answer_type

contains

  !> Where the function is to be evaluated next; negative where the count is complete or has failed.
  pure function next(count) result(angle)
    class(mode_count_type), intent(in) :: count
    real(wp) :: angle !! along the half circle [rad]
    integer :: i

    angle = -1.0_wp
    if (count%failed) return
    if (.not. allocated(count%angle)) then
      angle = 0.0_wp
    else if (size(count%angle) <= count%steps) then
      angle = pi*real(size(count%angle), wp)/real(count%steps, wp)
    else
      do i = 2, size(count%angle)
        if (abs(step(count, i)) <= largest_step) cycle
        angle = 0.5_wp*(count%angle(i - 1) + count%angle(i))
        return
      end do
    end if
  end function next

  !> A place of the half circle.
  pure function place(count, angle) result(rate)
    class(mode_count_type), intent(in) :: count
    real(wp), intent(in) :: angle !! along the half circle [rad]
    complex(wp) :: rate !! [1/s]

    rate = count%centre + count%radius*cmplx(cos(angle), sin(angle), wp)
    if (angle <= 0.0_wp .or. angle >= pi) rate = real(rate, wp)
  end function place

  !> Takes the function's value.
  pure subroutine tell(count, angle, logarithm)
    class(mode_count_type), intent(inout) :: count
    real(wp), intent(in) :: angle !! that was asked for [rad]
    complex(wp), intent(in) :: logarithm !! of f there, up to multiples of 2 pi i [1]
    complex(wp) :: left
    integer :: i, before

    left = logarithm - count%at_centre*log(count%place(angle) - count%centre)
    do i = 1, size(count%known)
      left = left - log(count%place(angle) - count%known(i))
      if (aimag(count%known(i)) <= 0.0_wp) cycle
      left = left - log(count%place(angle) - conjg(count%known(i)))
    end do
    if (.not. allocated(count%angle)) allocate (count%angle(0), count%value(0))
    before = findloc(count%angle < angle, .true., 1, back=.true.)
    count%angle = [count%angle(:before), angle, count%angle(before + 1:)]
    count%value = [count%value(:before), left, count%value(before + 1:)]
    count%failed = size(count%angle) > most_places
    if (before > 0) count%failed = count%failed .or. angle - count%angle(before) < smallest_step
  end subroutine tell

  !> Mean of the logarithm's real part along the circle, from its first places.
  pure real(wp) function mean(count)
    class(mode_count_type), intent(in) :: count
    associate (level => real(count%value, wp), last => size(count%value))
      mean = (sum(level(2:last - 1)) + 0.5_wp*(level(1) + level(last)))/real(last - 1, wp)
    end associate
  end function mean

  !> Takes a number of zeros to lie at the centre; values that were told follow.
  pure subroutine put_at_centre(count, zeros)
    class(mode_count_type), intent(inout) :: count
    integer, intent(in) :: zeros !! all of them, those of before too
    integer :: i

    if (allocated(count%angle)) then
      do i = 1, size(count%angle)
        count%value(i) = count%value(i) - (zeros - count%at_centre)*log(count%place(count%angle(i)) - count%centre)
      end do
    end if
    count%at_centre = zeros
  end subroutine put_at_centre

  !> Zeros in the circle that are not known, where the count is complete; each of a conjugate
  !> pair counts.
  pure function missing(count) result(zeros)
    class(mode_count_type), intent(in) :: count
    integer :: zeros, i
    zeros = nint(sum([(step(count, i), i=2, size(count%angle))])/pi)
  end function missing

  !> How the phase changes from the place before, by less than half a turn, without the share of
  !> zeros far outside.
  pure function step(count, i) result(change)
    class(mode_count_type), intent(in) :: count
    integer, intent(in) :: i !! number of the place
    real(wp) :: change !! [rad]
    real(wp) :: outside

    associate (angle => count%angle, value => count%value)
      outside = 0.5_wp*real(value(1) - value(size(value)), wp)
      change = aimag(value(i) - value(i - 1)) - outside*(sin(angle(i)) - sin(angle(i - 1)))
    end associate
    change = modulo(change + pi, 2.0_wp*pi) - pi
  end function step

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
    integer :: i

    call find_coefficients(bearing, response, rate, coefficient, found, only_translations=kind == cylindrical)
    if (.not. found) return
    of_rotor = safe_log(determinant(dynamic_matrix(rotor, kind, coefficient, rate, bearing%point%speed)))
    logarithm = of_rotor
    if (present(of_film)) of_film = 0.0_wp
    if (.not. response%part(1)%solver%has_determinant()) return
    do i = 1, merge(1, size(response%part), kind == cylindrical)
      logarithm = logarithm + response%part(i)%solver%log_determinant()
    end do
    if (kind /= cylindrical .and. allocated(response%opposite)) then
      logarithm = logarithm + response%opposite%part(1)%solver%log_determinant()
    end if
    if (present(of_film)) of_film = logarithm - of_rotor
  end subroutine find_determinant

  !> Visits the first places of a circle.
  subroutine begin_circle(bearing, response, rotor, kind, count, found)
    type(bearing_system_type), intent(in) :: bearing !! as it was when the response was created
    type(dynamic_response_type), intent(inout) :: response !! of it
    type(rotor_type), intent(in) :: rotor !! on the bearing
    integer, intent(in) :: kind !! of the motions
    type(mode_count_type), intent(inout) :: count !! along the circle
    logical, intent(out) :: found !! the matrices could be factorized
    complex(wp) :: logarithm
    real(wp) :: angle
    integer :: i

    do i = 0, count%steps
      angle = count%next()
      call find_determinant(bearing, response, rotor, kind, count%place(angle), logarithm, found)
      if (.not. found) return
      call count%tell(angle, logarithm)
    end do
  end subroutine begin_circle

  !> Counts the modes in a circle about a real rate that are not known.
  subroutine count_missing(bearing, response, rotor, kind, count, missing, found)
    type(bearing_system_type), intent(in) :: bearing !! as it was when the response was created
    type(dynamic_response_type), intent(inout) :: response !! of it
    type(rotor_type), intent(in) :: rotor !! on the bearing
    integer, intent(in) :: kind !! of the motions
    type(mode_count_type), intent(inout) :: count !! the circle, and the modes that are known
    integer, intent(out) :: missing !! each of a conjugate pair counts
    logical, intent(out) :: found !! the matrices could be factorized, and the circle runs through no mode
    complex(wp) :: logarithm
    real(wp) :: angle

    missing = 0
    do
      angle = count%next()
      if (angle < 0.0_wp) exit
      call find_determinant(bearing, response, rotor, kind, count%place(angle), logarithm, found)
      if (.not. found) return
      call count%tell(angle, logarithm)
    end do
    found = .not. count%failed
    if (found) missing = count%missing()
  end subroutine count_missing

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

  !> Modes of the rotor next to half the speed, where the shaft turns.
  subroutine find_rotor_modes(bearing, response, rotor, answer)
    type(bearing_system_type), intent(in) :: bearing !! as it was when the response was created
    type(dynamic_response_type), intent(inout) :: response !! of it
    type(rotor_type), intent(in) :: rotor !! on the bearing
    type(rotor_answer_type), intent(out) :: answer !! what was found
    type(vibration_type) :: whole ! with dampers and arms of their full size
    logical :: grows

    allocate (answer%mode(0))
    answer%defined = .not. response%equations%vibration%loss_factor > 0.0_wp
    if (.not. answer%defined) return
    answer%counted = response%part(1)%solver%has_determinant()
    whole = response%equations%vibration
    grows = .not. has_pencil(response%equations)
    if (grows) call put_dampers(whole, 0.0_wp, response%equations%vibration)
    call collect_modes(bearing, response, rotor, answer)
    if (answer%found .and. grows) call let_dampers_grow(bearing, response, rotor, whole, answer)
    response%equations%vibration = whole
    if (.not. answer%found) return
    call sort_modes(answer%mode)
    answer%foil_grows = any(.not. is_of_shaft(answer%mode%owner) .and. real(answer%mode%rate) > rounded*abs(answer%mode%rate))
    answer%decides = findloc(find_branches(answer%mode%owner, answer%mode%moving_share, answer%mode%kind, answer%mode%rate), .true., 1)
    if (answer%decides > 0) call sharpen(bearing, response, rotor, answer)
  end subroutine find_rotor_modes

  !> Modes of all kinds from the eigenvalues next to half the speed.
  subroutine collect_modes(bearing, response, rotor, answer)
    type(bearing_system_type), intent(in) :: bearing
    type(dynamic_response_type), intent(inout) :: response
    type(rotor_type), intent(in) :: rotor
    type(rotor_answer_type), intent(inout) :: answer
    type(pencil_mode_type), allocatable :: found(:)
    integer, allocatable :: kinds(:)
    integer :: i, k

    kinds = kinds_of(rotor)
    do k = 1, size(kinds)
      call find_all_modes(bearing, response, rotor, kinds(k), found, answer%reason)
      answer%found = .not. allocated(answer%reason)
      if (.not. answer%found) return
      do i = 1, size(found)
        if (aimag(found(i)%rate) > highest*bearing%point%speed) cycle
        associate (one => found(i))
          if (one%share >= least_share .and. real(one%rate) > -most_damped*abs(one%rate)) then
            call find_moving_share(bearing, response, rotor, kinds(k), one)
          end if
          answer%mode = [answer%mode, rotor_mode_type(kinds(k), one%rate, one%share, whirl_sense(one%motion), one%foil_share, &
                                                      one%moving_share, owner_of(one%share, one%foil_share, one%film_share, &
                                                                                 one%moving_share))]
        end associate
      end do
    end do
  end subroutine collect_modes

  !> All modes of a kind in a circle about half the speed, by as many eigenvalues as it takes; a foil's modes inside
  !> condensed pieces are left out.
  subroutine find_all_modes(bearing, response, rotor, kind, modes, reason)
    type(bearing_system_type), intent(in) :: bearing !! as it was when the response was created
    type(dynamic_response_type), intent(inout) :: response !! of it, with a pencil
    type(rotor_type), intent(in) :: rotor !! on the bearing
    integer, intent(in) :: kind !! `cylindrical` or `conical`
    type(pencil_mode_type), allocatable, intent(out) :: modes(:) !! in the circle
    character(len=:), allocatable, intent(out) :: reason !! why they were not found
    type(mode_count_type) :: count
    type(relaxation_type) :: relaxation
    real(wp) :: reach, radius(2)
    integer :: wanted, missing
    logical :: found

    wanted = first_wanted
    relaxation = relaxation_of(response)
    call pass_disc(relaxation, bearing%point%speed, radius)
    do
      call find_pencil_modes(bearing, response, rotor, kind, shift*bearing%point%speed, wanted, modes, reach, found, relaxation)
      if (.not. found) exit
      if (reach >= radius(2)) then
        call skip_inner_modes(response, .true.)
        call count_beside(bearing, response, rotor, kind, modes, radius, relaxation, count, missing, found)
        call skip_inner_modes(response, .false.)
        if (.not. (found .or. count%failed)) exit
        modes = pack(modes, abs(modes%rate - count%centre) < count%radius)
        if (found .and. missing == 0) return
        reason = 'the circle along which modes are counted runs through one that was not found'
        if (found .and. missing > 0) reason = text(missing)//' more rates than the '//text(size(modes))//' modes found next to half the speed were counted'
        if (found .and. missing < 0) reason = text(-missing)//' of the '//text(size(modes))//' modes found next to half the speed were not counted'
      else
        reason = 'the iteration for eigenvalues has found '//text(size(modes))//' modes next to half the speed and none beyond '// &
                 text(reach/bearing%point%speed, 3)//' of the speed'
      end if
      if (wanted >= most_wanted) return
      wanted = 2*wanted
      deallocate (reason)
    end do
    if (.not. allocated(reason)) reason = response_failure(response)
  end subroutine find_all_modes

  !> Least and largest radius of the circle about the shift: it holds all rates that are asked for, and runs through no rate of
  !> springs that relax, whose disc it leaves outside where half of the room is before it, and holds else.
  pure subroutine pass_disc(relaxation, speed, radius)
    type(relaxation_type), intent(inout) :: relaxation !! none where the circle does not come near it
    real(wp), intent(in) :: speed !! of the shaft [rad/s]
    real(wp), intent(out) :: radius(2) !! [1/s]
    real(wp) :: near, far ! distances of the disc from the shift

    radius = [1.0_wp, room]*sqrt(1.0_wp + highest**2)*speed ! rates of -0.5 + 1.5 i over the speed, from the shift
    near = shift*speed - relaxation%rate - room*relaxation%radius
    far = near + 2.0_wp*room*relaxation%radius
    relaxation%present = relaxation%present .and. near < room*radius(2)
    if (.not. relaxation%present .or. far <= radius(1) .or. near >= radius(2)) return
    if (near >= sqrt(room)*radius(1)) then
      radius(2) = near
    else
      radius = [1.0_wp, room]*far
    end if
  end subroutine pass_disc

  !> Counts the modes in a circle in the widest gap between those that are known, but for springs that relax.
  subroutine count_beside(bearing, response, rotor, kind, modes, radius, relaxation, count, missing, found)
    type(bearing_system_type), intent(in) :: bearing
    type(dynamic_response_type), intent(inout) :: response
    type(rotor_type), intent(in) :: rotor
    integer, intent(in) :: kind
    type(pencil_mode_type), intent(in) :: modes(:) !! nearest to the shift first
    real(wp), intent(in) :: radius(2) !! least and largest [1/s]
    type(relaxation_type), intent(in) :: relaxation
    type(mode_count_type), intent(out) :: count !! along the circle, or where that failed
    integer, intent(out) :: missing
    logical, intent(out) :: found
    complex(wp), allocatable :: known(:)
    real(wp) :: centre, reach
    integer :: relaxing, i
    logical :: counts

    known = modes%rate ! in a structure constructor GNU Fortran 12 takes wrong strides
    centre = shift*bearing%point%speed
    reach = circle_between(modes, centre, radius)
    counts = response%part(1)%solver%has_determinant()
    missing = 0
    found = .true.
    if (relaxation%present .and. counts) then
      count = mode_count_type(relaxation%rate, circle_between(modes, relaxation%rate, [1.0_wp, room]*relaxation%radius), known)
      call count_relaxing(bearing, response, rotor, kind, centre - relaxation%rate < reach, count, relaxing, found)
      if (.not. found) return
      known = [known, (cmplx(relaxation%rate, 0.0_wp, wp), i=1, relaxing)]
    end if
    count = mode_count_type(centre, reach, known)
    if (counts) call count_missing(bearing, response, rotor, kind, count, missing, found)
  end subroutine count_beside

  !> Counts the modes in a disc that are not known. The mean of the logarithm's real part along a circle grows with the logarithm
  !> of the radius by what is inside (Jensen's formula). With as many taken to lie at the centre the phase has to come back as it
  !> was; where it does not, the steps were too long. Of a disc outside the circle about how many will do.
  subroutine count_relaxing(bearing, response, rotor, kind, inside, count, relaxing, found)
    type(bearing_system_type), intent(in) :: bearing
    type(dynamic_response_type), intent(inout) :: response
    type(rotor_type), intent(in) :: rotor
    integer, intent(in) :: kind
    logical, intent(in) :: inside !! the circle
    type(mode_count_type), intent(inout) :: count !! along the disc's
    integer, intent(out) :: relaxing
    logical, intent(out) :: found
    type(mode_count_type) :: around
    integer :: more

    do while (count%steps < most_places)
      around = mode_count_type(count%centre, room*count%radius, count%known, count%steps)
      call begin_circle(bearing, response, rotor, kind, around, found)
      if (found) call begin_circle(bearing, response, rotor, kind, count, found)
      if (.not. found) return
      relaxing = nint((around%mean() - count%mean())/log(room))
      if (.not. inside) return
      call count%put_at_centre(relaxing)
      call count_missing(bearing, response, rotor, kind, count, more, found)
      if (.not. found .or. more == 0) return
      count = mode_count_type(count%centre, count%radius, count%known, 2*count%steps)
    end do
    count%failed = .true.
    found = .false.
  end subroutine count_relaxing

  !> Radius of a circle in the widest gap between modes.
  pure function circle_between(modes, centre, limits) result(radius)
    type(pencil_mode_type), intent(in) :: modes(:) !! that are known
    real(wp), intent(in) :: centre    !! of the circle [1/s]
    real(wp), intent(in) :: limits(2) !! least and largest radius [1/s]
    real(wp) :: radius !! [1/s]
    real(wp) :: widest, last, next
    integer :: i

    widest = 0.0_wp
    radius = limits(1)
    last = limits(1)
    do while (last < limits(2))
      next = limits(2)
      do i = 1, size(modes)
        associate (distance => abs(modes(i)%rate - centre))
          if (distance > last) next = min(next, distance)
        end associate
      end do
      if (next - last > widest) then
        widest = next - last
        radius = 0.5_wp*(last + next)
      end if
      last = next
    end do
  end function circle_between

  !> Solves for the mode that decides with the determinant, and with the modes inside condensed pieces.
  subroutine sharpen(bearing, response, rotor, answer)
    type(bearing_system_type), intent(in) :: bearing
    type(dynamic_response_type), intent(inout) :: response
    type(rotor_type), intent(in) :: rotor
    type(rotor_answer_type), intent(inout) :: answer
    type(relaxation_type) :: relaxation
    logical :: other(size(answer%mode))

    associate (mode => answer%mode(answer%decides))
      other = answer%mode%kind == mode%kind
      other(answer%decides) = .false.
      relaxation = relaxation_of(response)
      call solve_mode(bearing, response, rotor, mode%kind, mode%rate, answer%found, pack(answer%mode%rate, other), relaxation%present)
      if (.not. answer%found) then
        answer%reason = 'the determinant has no zero next to the rotor''s mode of '//text(aimag(mode%rate), 5)// &
                        ' rad/s that the eigenvalues have'
      end if
    end associate
  end subroutine sharpen

  !> Follows the rotor's modes that vibrate while dampers grow to their full size; all others are left out. A
  !> mode that is lost on the way is missed where it was the least damped one.
  subroutine let_dampers_grow(bearing, response, rotor, whole, answer)
    type(bearing_system_type), intent(in) :: bearing
    type(dynamic_response_type), intent(inout) :: response
    type(rotor_type), intent(in) :: rotor
    type(vibration_type), intent(in) :: whole !! with dampers and arms of their full size
    type(rotor_answer_type), intent(inout) :: answer
    logical, allocatable :: kept(:)
    integer :: step, i

    answer%mode = pack(answer%mode, is_of_shaft(answer%mode%owner) .and. &
                       real(answer%mode%rate) > -most_damped*abs(answer%mode%rate))
    call sort_modes(answer%mode)
    allocate (kept(size(answer%mode)), source=.true.)
    do step = 1, damper_steps
      call put_dampers(whole, real(step, wp)/real(damper_steps, wp), response%equations%vibration)
      do i = 1, size(answer%mode)
        if (kept(i)) call solve_mode(bearing, response, rotor, answer%mode(i)%kind, answer%mode(i)%rate, kept(i), steep=.true.)
      end do
    end do
    answer%found = all(kept(:1))
    if (.not. answer%found) answer%reason = 'the least damped mode was lost while dampers grew to their size'
    answer%mode = pack(answer%mode, kept)
  end subroutine let_dampers_grow

  !> Dampers and arms of a share of their full size.
  pure subroutine put_dampers(whole, share, vibration)
    type(vibration_type), intent(in) :: whole
    real(wp), intent(in) :: share !! 0 .. 1 [1]
    type(vibration_type), intent(inout) :: vibration

    vibration%damping_time = whole%damping_time*share
    vibration%arm%stiffness = whole%arm%stiffness*share
  end subroutine put_dampers

  !> Puts modes in the order of falling growth.
  pure subroutine sort_modes(mode)
    type(rotor_mode_type), intent(inout) :: mode(:)
    type(rotor_mode_type) :: one
    integer :: i, k

    do i = 2, size(mode)
      one = mode(i)
      do k = i - 1, 1, -1
        if (real(mode(k)%rate) >= real(one%rate)) exit
        mode(k + 1) = mode(k)
      end do
      mode(k + 1) = one
    end do
  end subroutine sort_modes

  !> A rotor's mode along its axis on a thrust bearing, next to that of the stiffness at a frequency: a zero of
  !>
  !> $$ m \lambda^2 + Z_{zz}(\lambda) $$
  !>
  !> with the coefficient at the complex rate, since film and foil answer the mode as it decays; without a loss factor.
  subroutine find_axial_mode(bearing, response, mass, frequency, rate, found)
    type(bearing_system_type), intent(in) :: bearing !! as it was when the response was created
    type(dynamic_response_type), intent(inout) :: response !! of it, a runner's
    real(wp), intent(in) :: mass      !! that the bearing carries [kg]
    real(wp), intent(in) :: frequency !! near which it is looked for [rad/s]
    complex(wp), intent(out) :: rate  !! growth + i frequency [1/s]
    logical, intent(out) :: found     !! it has converged
    complex(wp) :: before, here, at_before, at_here, stiffness, move
    integer :: trial

    call axial_coefficient(cmplx(0.0_wp, frequency, wp), stiffness, found)
    rate = cmplx(0.0_wp, sqrt(max(real(stiffness, wp), tiny(1.0_wp))/mass), wp)
    if (.not. found) return
    before = rate
    call axial_coefficient(before, stiffness, found)
    if (.not. found) return
    at_before = mass*before**2 + stiffness
    ! What the damping makes of it is the first move.
    here = before - at_before/(2.0_wp*mass*before)
    if (abs(here - before) < first_move*abs(before)) here = (1.0_wp + first_move)*before
    do trial = 1, most_trials
      call axial_coefficient(here, stiffness, found)
      if (.not. found) return
      at_here = mass*here**2 + stiffness
      found = .not. abs(at_here - at_before) <= 0.0_wp
      if (.not. found) exit
      move = -at_here*(here - before)/(at_here - at_before)
      before = here
      at_before = at_here
      here = here + move
      found = abs(move) <= rounded*abs(here)
      if (found) exit
    end do
    rate = cmplx(real(here, wp), abs(aimag(here)), wp)

  contains

    !> Z of the motion along the axis.
    subroutine axial_coefficient(at, value, made)
      complex(wp), intent(in) :: at     !! [1/s]
      complex(wp), intent(out) :: value !! [N/m]
      logical, intent(out) :: made
      complex(wp) :: coefficient(size(response%motion), size(response%motion))

      call find_coefficients(bearing, response, at, coefficient, made)
      value = coefficient(1, 1)
    end subroutine axial_coefficient
  end subroutine find_axial_mode
end module gfb_rotor_modes
