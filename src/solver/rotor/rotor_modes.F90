#include "gfb_petsc.h"
!> How a rigid rotor moves on its bearings: frequency and growth of its modes.
!>
!> A mode is a zero of the determinant of \( D(\lambda) \) (`gfb_rotor`). Those next to half the speed come
!> from the eigenvalues of film, foil and rotor together; the one that decides is solved for once more with
!> \( D \), which knows nothing of the eigenvalues' method. Dampers beside springs that have no unknowns of
!> their own, and Maxwell arms, are let grow from nothing, and the modes are followed. A loss factor is defined for steady
!> vibrations alone, so with one there are no growth rates.
module gfb_rotor_modes
  use gfb_kinds, only: wp
  use gfb_shaft_motion, only: shaft_coordinates
  use gfb_bearing_system, only: bearing_system_type
  use gfb_dynamic_response, only: dynamic_response_type, find_coefficients
  use gfb_rotor, only: rotor_type, cylindrical, dynamic_matrix, determinant, kinds_of, whirl_sense
  use gfb_rotor_pencil, only: pencil_mode_type, find_pencil_modes, has_pencil
  use gfb_vibration_equations, only: vibration_type
  implicit none (type, external)
  private
  public :: find_rotor_modes, solve_mode, is_of_shaft

  real(wp), parameter :: shift = 0.5_wp        !! next to which modes are looked for, over the speed [1]
  real(wp), parameter :: highest = 1.5_wp      !! frequency of a mode that is told, over the speed [1]
  !> Of the rotor in a mode of its own: those of foils have some thousandths, the rotor's a tenth and more [1].
  real(wp), parameter :: least_share = 0.02_wp
  real(wp), parameter :: first_move = 1.0e-5_wp  !! of the secant method, over the rate [1]
  real(wp), parameter :: tolerance = 1.0e-11_wp  !! of a rate [1]
  real(wp), parameter :: farthest = 0.05_wp    !! from its start is another mode, over the rate [1]
  real(wp), parameter :: most_damped = 0.5_wp  !! damping ratio of a mode that is followed [1]
  integer, parameter :: most_trials = 30       !! of the secant method
  integer, parameter :: damper_steps = 8       !! in which dampers are let grow

  !> A mode \( e^{\lambda t} \).
  type, public :: rotor_mode_type
    integer :: kind = cylindrical
    complex(wp) :: rate = 0.0_wp  !! growth + i frequency, not negative [1/s]
    real(wp) :: share = 0.0_wp    !! of the rotor, against the film's pressure [1]
    real(wp) :: sense = 0.0_wp    !! 1: a circle with the speed, -1: against it [1]
  end type rotor_mode_type

  !> What was found.
  type, public :: rotor_answer_type
    logical :: defined = .true.  !! growth rates exist: no loss factor
    logical :: found = .false.   !! all matrices could be factorized, and the mode that decides is sure
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
    integer :: i

    allocate (answer%mode(0))
    answer%defined = .not. response%equations%vibration%loss_factor > 0.0_wp
    if (.not. answer%defined) return
    whole = response%equations%vibration
    grows = .not. has_pencil(response%equations)
    if (grows) call put_dampers(whole, 0.0_wp, response%equations%vibration)
    call collect_modes(bearing, response, rotor, answer)
    if (answer%found .and. grows) call let_dampers_grow(bearing, response, rotor, whole, answer)
    response%equations%vibration = whole
    if (.not. answer%found) return
    call sort_modes(answer%mode)
    answer%foil_grows = any(.not. is_of_shaft(answer%mode) .and. real(answer%mode%rate) > 0.0_wp)
    answer%decides = findloc(is_of_shaft(answer%mode), .true., 1)
    i = answer%decides
    if (i > 0) call solve_mode(bearing, response, rotor, answer%mode(i)%kind, answer%mode(i)%rate, answer%found)
  end subroutine find_rotor_modes

  !> Whether the rotor has a share in a mode.
  elemental function is_of_shaft(mode)
    type(rotor_mode_type), intent(in) :: mode !! that was found
    logical :: is_of_shaft
    is_of_shaft = mode%share >= least_share
  end function is_of_shaft

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
      call find_pencil_modes(bearing, response, rotor, kinds(k), shift*bearing%point%speed, found, answer%found)
      if (.not. answer%found) return
      do i = 1, size(found)
        if (aimag(found(i)%rate) > highest*bearing%point%speed) cycle
        answer%mode = [answer%mode, rotor_mode_type(kinds(k), found(i)%rate, found(i)%share, whirl_sense(found(i)%motion))]
      end do
    end do
  end subroutine collect_modes

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

    answer%mode = pack(answer%mode, is_of_shaft(answer%mode) .and. &
                       real(answer%mode%rate) > -most_damped*abs(answer%mode%rate))
    call sort_modes(answer%mode)
    allocate (kept(size(answer%mode)), source=.true.)
    do step = 1, damper_steps
      call put_dampers(whole, real(step, wp)/real(damper_steps, wp), response%equations%vibration)
      do i = 1, size(answer%mode)
        if (kept(i)) call solve_mode(bearing, response, rotor, answer%mode(i)%kind, answer%mode(i)%rate, kept(i))
      end do
    end do
    answer%found = all(kept(:1))
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

  !> Solves det D = 0 next to a rate by the secant method.
  subroutine solve_mode(bearing, response, rotor, kind, rate, found)
    type(bearing_system_type), intent(in) :: bearing !! as it was when the response was created
    type(dynamic_response_type), intent(inout) :: response !! of it
    type(rotor_type), intent(in) :: rotor !! on the bearing
    integer, intent(in) :: kind !! of the mode
    complex(wp), intent(inout) :: rate !! start, and the mode's where it is found [1/s]
    logical, intent(out) :: found !! it converged next to the start
    complex(wp) :: before, here, at_before, at_here, move
    integer :: i

    before = rate
    here = rate*(1.0_wp + first_move)
    call evaluate(bearing, response, rotor, kind, before, at_before, found)
    if (.not. found) return
    do i = 1, most_trials
      call evaluate(bearing, response, rotor, kind, here, at_here, found)
      if (.not. found) return
      if (abs(at_here - at_before) <= 0.0_wp) exit
      move = -at_here*(here - before)/(at_here - at_before)
      before = here
      at_before = at_here
      here = here + move
      found = abs(here - rate) <= farthest*abs(rate)
      if (.not. found) return
      if (abs(move) <= tolerance*abs(here)) then
        rate = here
        return
      end if
    end do
    found = .false.
  end subroutine solve_mode

  !> det D at a rate.
  subroutine evaluate(bearing, response, rotor, kind, rate, value, found)
    type(bearing_system_type), intent(in) :: bearing
    type(dynamic_response_type), intent(inout) :: response
    type(rotor_type), intent(in) :: rotor
    integer, intent(in) :: kind
    complex(wp), intent(in) :: rate   !! [1/s]
    complex(wp), intent(out) :: value !! [N^2/m^2], [N^2 m^2]
    logical, intent(out) :: found
    complex(wp) :: coefficient(shaft_coordinates, shaft_coordinates)

    call find_coefficients(bearing, response, rate, coefficient, found, only_translations=kind == cylindrical)
    value = determinant(dynamic_matrix(rotor, kind, coefficient, rate, bearing%point%speed))
  end subroutine evaluate

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
end module gfb_rotor_modes
