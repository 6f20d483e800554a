#include "gfb_petsc.h"
!> How many modes of a machine there are: zeros of the determinant of shaft, films and foils together,
!>
!> $$ \prod_i \det A_i(\lambda) \cdot \det D(\lambda), $$
!>
!> with the equations \( A_i x = 0 \) of film and foil of each bearing about a shaft that is held. It has no
!> poles. They are counted along a circle (`gfb_zero_count`) that holds all modes up to a frequency whose
!> amplitude falls by no more than a third of it.
module gfb_machine_count
  use gfb_kinds, only: wp
  use gfb_linear_solve, only: determinant_logarithm
  use gfb_dynamic_response, only: find_coefficients
  use gfb_zero_count, only: mode_count_type, circle_between
  use gfb_counted_function, only: counted_function_type, count_missing
  use gfb_rotor_determinant, only: film_determinant
  use gfb_rotor_pencil, only: has_pencil, skip_inner_modes, relaxation_type, relaxation_of
  use gfb_machine, only: machine_type
  use gfb_machine_linear, only: linear_bearing_type, machine_matrix
  implicit none (type)
  private
  public :: circle_limits, count_modes

  real(wp), parameter :: shift = 1.0_wp        !! the circle's centre, over the highest frequency [1]
  real(wp), parameter :: depth = 0.2_wp        !! loss of modes that it holds up to that frequency, over it [1]
  real(wp), parameter :: away(2) = [3.0_wp, 6.0_wp] !! from relaxing springs, over the radius in which their rates lie [1]
  integer, parameter :: ways = 2               !! translations of a journal across its axis
  integer, parameter :: first_steps = 8        !! of the half circle, before the phase asks for more
  real(wp), parameter :: room = 1.15_wp        !! of the largest circle over the least [1]

  !> The determinant.
  type, extends(counted_function_type) :: machine_determinant_type
    type(machine_type), pointer :: machine => null()
    type(linear_bearing_type), pointer :: linear(:) => null() !! its bearings about their answers
  contains
    procedure :: evaluate => evaluate_determinant
  end type machine_determinant_type

contains

  !> The circle's centre, and its least and largest radius; the latter is smaller where springs relax beyond it.
  subroutine circle_limits(linear, highest, centre, radius, counts)
    type(linear_bearing_type), intent(in) :: linear(:) !! bearings about their answers
    real(wp), intent(in) :: highest !! frequency [rad/s]
    real(wp), intent(out) :: centre !! [1/s]
    real(wp), intent(out) :: radius(2) !! [1/s]
    logical, intent(out) :: counts !! the determinant exists, and its phase can be followed
    type(relaxation_type) :: relaxation
    integer :: i

    centre = shift*highest
    radius = [1.0_wp, room]*sqrt(1.0_wp + (shift + depth)**2)*highest
    counts = .true.
    do i = 1, size(linear)
      associate (response => linear(i)%response)
        counts = counts .and. response%part(1)%solver%has_determinant() .and. has_pencil(response%equations) .and. &
          .not. response%equations%vibration%loss_factor > 0.0_wp
        relaxation = relaxation_of(response)
        if (relaxation%present) radius(2) = min(radius(2), centre - relaxation%rate - room*relaxation%radius)
      end associate
    end do
    counts = counts .and. radius(2) > radius(1)
  end subroutine circle_limits

  !> Counts modes in a circle in the widest gap between those that are known.
  subroutine count_modes(machine, linear, centre, limits, known, beyond, missing, radius, found)
    type(machine_type), target, intent(in) :: machine
    type(linear_bearing_type), target, intent(inout) :: linear(:) !! its bearings about their answers
    real(wp), intent(in) :: centre    !! of the circle [1/s]
    real(wp), intent(in) :: limits(2) !! its least and largest radius [1/s]
    complex(wp), intent(in) :: known(:) !! rates of modes, one of each conjugate pair [1/s]
    complex(wp), intent(in) :: beyond(:) !! where others may be: those outside the circle are divided out, too, for a smoother phase [1/s]
    integer, intent(out) :: missing !! modes that are not known, each of a conjugate pair counts; negative: known ones that are none
    real(wp), intent(out) :: radius !! of the circle [1/s]
    logical, intent(out) :: found !! the circle could be followed
    type(machine_determinant_type) :: determinant
    type(mode_count_type) :: count
    complex(wp), allocatable :: divided(:)
    integer :: i

    radius = circle_between(known, centre, limits)
    divided = [pack(known, abs(known - centre) < radius), pack(beyond, abs(beyond - centre) > radius)]
    missing = 0
    found = .true.
    do i = 1, size(linear)
      call skip_inner_modes(linear(i)%response, .true.)
      if (found) call add_relaxing(linear(i), moves_across(machine, i), divided, found)
    end do
    count = mode_count_type(centre, radius, divided, first_steps, compares=.true.)
    determinant = machine_determinant_type(machine, linear)
    if (found) call count_missing(determinant, count, missing, found)
    do i = 1, size(linear)
      call skip_inner_modes(linear(i)%response, .false.)
    end do
  end subroutine count_modes

  !> Puts as many rates of springs that relax beyond the circle at the middle of them as there seem to be. To divide them out does not
  !> change the count, but keeps the phase from turning fast; how many there are is what the determinant grows by away from them.
  subroutine add_relaxing(linear, only_translations, divided, found)
    type(linear_bearing_type), intent(inout) :: linear
    logical, intent(in) :: only_translations !! of its journal
    complex(wp), allocatable, intent(inout) :: divided(:) !! rates that are divided out [1/s]
    logical, intent(out) :: found !! the matrices could be factorized
    type(relaxation_type) :: relaxation
    complex(wp) :: coefficient(size(linear%response%motion), size(linear%response%motion)), logarithm(2)
    integer :: i

    found = .true.
    relaxation = relaxation_of(linear%response)
    if (.not. relaxation%present) return
    logarithm = 0.0_wp
    do i = 1, 2
      call find_coefficients(linear%bearing, linear%response, cmplx(relaxation%rate + away(i)*relaxation%radius, 0.0_wp, wp), coefficient, &
                             found, only_translations)
      if (.not. found) return
      call film_determinant(linear%response, only_translations, logarithm(i))
    end do
    divided = [divided, (cmplx(relaxation%rate, 0.0_wp, wp), i=1, nint(real(logarithm(2) - logarithm(1), wp)/log(away(2)/away(1))))]
  end subroutine add_relaxing

  !> Whether a journal's film feels how it moves across its axis alone, without tilts.
  pure logical function moves_across(machine, number)
    type(machine_type), intent(in) :: machine
    integer, intent(in) :: number !! of the journal
    moves_across = all(machine%journal(number)%coordinate <= ways)
  end function moves_across

  !> Logarithm of the determinant at a rate.
  subroutine evaluate_determinant(self, rate, logarithm, found)
    class(machine_determinant_type), intent(inout) :: self !! the function
    complex(wp), intent(in) :: rate !! lambda [1/s]
    complex(wp), intent(out) :: logarithm !! of scaled equations [1]
    logical, intent(out) :: found !! the matrices could be factorized
    complex(wp), allocatable :: matrix(:, :)
    integer :: i

    logarithm = 0.0_wp
    call machine_matrix(self%machine, self%linear, rate, matrix, found)
    if (.not. found) return
    logarithm = determinant_logarithm(matrix)
    do i = 1, size(self%linear)
      call film_determinant(self%linear(i)%response, moves_across(self%machine, i), logarithm)
    end do
  end subroutine evaluate_determinant
end module gfb_machine_count
