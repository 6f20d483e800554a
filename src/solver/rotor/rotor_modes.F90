#include "gfb_petsc.h"
!> How a rigid rotor moves on its bearings: frequency and growth of its modes.
!>
!> A mode is a zero of the determinant of film, foil and rotor (`gfb_rotor_determinant`). With a shift \( \sigma \) of half
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
module gfb_rotor_modes
  use gfb_kinds, only: wp
  use gfb_film_surface, only: journal_motions
  use gfb_bearing_system, only: bearing_system_type
  use gfb_dynamic_response, only: dynamic_response_type, find_coefficients, response_failure
  use gfb_rotor, only: rotor_type, cylindrical, kinds_of, whirl_sense
  use gfb_zero_count, only: mode_count_type, most_places, circle_between
  use gfb_counted_function, only: begin_circle, count_missing
  use gfb_rotor_determinant, only: rotor_determinant_type, solve_mode, first_move, rounded, most_trials
  use gfb_mode_owner, only: of_rotor, owner_of, is_of_shaft, find_branches, least_share
  use gfb_text, only: text
  use gfb_sorting, only: sort_by
  use gfb_rotor_pencil, only: pencil_mode_type, relaxation_type, find_pencil_modes, find_moving_share, has_pencil, &
                              skip_inner_modes, relaxation_of
  use gfb_vibration_law, only: vibration_type
  implicit none (type, external)
  private
  public :: find_rotor_modes, find_axial_mode, find_all_modes

  real(wp), parameter :: shift = 0.5_wp        !! next to which modes are looked for, over the speed [1]
  real(wp), parameter :: highest = 1.5_wp      !! frequency of a mode that is reported, over the speed [1]
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
    type(bearing_system_type), target, intent(in) :: bearing
    type(dynamic_response_type), target, intent(inout) :: response
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
    type(rotor_determinant_type) :: function

    function = rotor_determinant_type(bearing, response, rotor, kind)
    known = modes%rate ! in a structure constructor GNU Fortran 12 takes wrong strides
    centre = shift*bearing%point%speed
    reach = circle_between(modes%rate, centre, radius)
    counts = response%part(1)%solver%has_determinant()
    missing = 0
    found = .true.
    if (relaxation%present .and. counts) then
      count = mode_count_type(relaxation%rate, circle_between(modes%rate, relaxation%rate, [1.0_wp, room]*relaxation%radius), known)
      call count_relaxing(function, centre - relaxation%rate < reach, count, relaxing, found)
      if (.not. found) return
      known = [known, (cmplx(relaxation%rate, 0.0_wp, wp), i=1, relaxing)]
    end if
    count = mode_count_type(centre, reach, known)
    if (counts) call count_missing(function, count, missing, found)
  end subroutine count_beside

  !> Counts the modes in a disc that are not known. The mean of the logarithm's real part along a circle grows with the logarithm
  !> of the radius by what is inside (Jensen's formula). With as many taken to lie at the centre the phase has to come back as it
  !> was; where it does not, the steps were too long. Of a disc outside the circle about how many will do.
  subroutine count_relaxing(function, inside, count, relaxing, found)
    type(rotor_determinant_type), intent(inout) :: function
    logical, intent(in) :: inside !! the circle
    type(mode_count_type), intent(inout) :: count !! along the disc's
    integer, intent(out) :: relaxing
    logical, intent(out) :: found
    type(mode_count_type) :: around
    integer :: more

    do while (count%steps < most_places)
      around = mode_count_type(count%centre, room*count%radius, count%known, count%steps)
      call begin_circle(function, around, found)
      if (found) call begin_circle(function, count, found)
      if (.not. found) return
      relaxing = nint((around%mean() - count%mean())/log(room))
      if (.not. inside) return
      call count%put_at_centre(relaxing)
      call count_missing(function, count, more, found)
      if (.not. found .or. more == 0) return
      count = mode_count_type(count%centre, count%radius, count%known, 2*count%steps)
    end do
    count%failed = .true.
    found = .false.
  end subroutine count_relaxing

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
    integer :: order(size(mode)), i

    order = [(i, i=1, size(mode))]
    call sort_by(-real(mode%rate, wp), order)
    mode = mode(order)
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
