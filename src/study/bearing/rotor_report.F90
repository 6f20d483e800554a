#include "gfb_petsc.h"
!> What the log, the summary and the result file say of a rotor's modes.
module gfb_rotor_report
  use gfb_kinds, only: wp
  use gfb_text, only: text
  use gfb_quantity, only: quantity_type
  use gfb_results, only: add_result
  use gfb_run_log, only: run_log_type
  use gfb_rotor, only: conical
  use gfb_rotor_modes, only: rotor_answer_type, rotor_mode_type, is_of_shaft, is_of_foil
  use gfb_dynamics_record, only: mode_numbers
  implicit none (type, external)
  private
  public :: report_rotor

  integer, parameter :: digits = 5
  real(wp), parameter :: dead = 0.9_wp !! a mode with a larger damping ratio is not shown [1]
  real(wp), parameter :: circular = 0.05_wp !! a smaller sense goes to and fro [1]

contains

  !> Says how the rotor moves, in the log and as results, and gives the numbers that are kept.
  subroutine report_rotor(log, speed, briefly, mass, answer, found, mode)
    type(run_log_type), intent(in) :: log !! where lines go
    real(wp), intent(in) :: speed !! of the shaft [rad/s]
    logical, intent(in) :: briefly !! without the table of modes
    real(wp), intent(in) :: mass !! of the rotor on this bearing [kg]
    type(rotor_answer_type), intent(in) :: answer !! its modes
    type(quantity_type), allocatable, intent(inout) :: found(:) !! has the critical mass, if there is one; gets growth, ...
    real(wp), allocatable, intent(inout) :: mode(:, :) !! (number, mode) of the record [SI]

    call show_rotor(log, speed, briefly, found, mass, answer)
    call add_rotor(answer, found)
    if (answer%defined) mode = mode_matrix(answer)
  end subroutine report_rotor

  !> Says how the rotor moves.
  subroutine show_rotor(log, speed, briefly, known, mass, answer)
    type(run_log_type), intent(in) :: log !! where lines go
    real(wp), intent(in) :: speed !! of the shaft [rad/s]
    logical, intent(in) :: briefly !! without the table of modes
    type(quantity_type), intent(in) :: known(:) !! critical mass, where one was found
    real(wp), intent(in) :: mass !! of the rotor on this bearing [kg]
    type(rotor_answer_type), intent(in) :: answer !! its modes
    logical, allocatable :: listed(:)
    integer :: i

    if (.not. answer%defined) then
      call log%line('rotor: no growth rates, for a loss factor is defined for steady vibrations alone; '//by_mass(known, mass))
    else if (.not. answer%found) then
      call log%line('rotor: its modes were not found: '//answer%reason)
    else
      if (.not. briefly) then
        call log%line('modes: frequency [rad/s] (over speed), growth [1/s], damping ratio, rotor''s share')
        listed = damping_ratio(answer%mode) < dead .or. .not. is_of_shaft(answer%mode) .and. real(answer%mode%rate) > 0.0_wp
        do i = 1, size(answer%mode)
          if (listed(i)) call log%line(mode_words(speed, answer%mode(i)))
        end do
        call log%line(text(count(.not. listed))//' more die out in less than a turn of their own')
      end if
      if (answer%decides > 0) call log%line('rotor: '//state_words(speed, answer%mode(answer%decides)))
      if (answer%decides == 0) call log%line('rotor: none of the modes found is the rotor''s')
      if (answer%decides > 1) call log%line('less damped: '//other_words(speed, answer%mode(1)))
      if (answer%foil_grows) then
        call log%warning('film or foil move by themselves: a mode grows in which the rotor has no share, so this '// &
                         'equilibrium does not stay, and the rotor''s growth rate means nothing')
      end if
    end if
  end subroutine show_rotor

  !> What the critical mass says of a rotor.
  pure function by_mass(known, mass) result(words)
    type(quantity_type), intent(in) :: known(:)
    real(wp), intent(in) :: mass !! [kg]
    character(len=:), allocatable :: words
    integer :: i

    words = 'no mass whirls in x and y'
    do i = 1, size(known)
      if (known(i)%name /= 'critical_mass') cycle
      words = 'it is lighter than the critical mass: stable in x and y'
      if (mass > known(i)%number) words = 'it is heavier than the critical mass: it whirls'
    end do
  end function by_mass

  !> A mode as a line of the table.
  function mode_words(speed, mode) result(words)
    real(wp), intent(in) :: speed !! [rad/s]
    type(rotor_mode_type), intent(in) :: mode
    character(len=:), allocatable :: words

    words = text(aimag(mode%rate), digits)//' ('//text(aimag(mode%rate)/speed, digits)//'), '// &
            text(real(mode%rate, wp), digits)//', '//text(damping_ratio(mode), digits)//', '//text(mode%share, 3)//', '
    if (.not. is_of_shaft(mode)) then
      words = words//trim(merge('foil', 'film', is_of_foil(mode)))
    else
      words = words//trim(merge('conical    ', 'cylindrical', mode%kind == conical))//sense_words(mode)
    end if
  end function mode_words

  !> Which way a mode goes round.
  pure function sense_words(mode) result(words)
    type(rotor_mode_type), intent(in) :: mode
    character(len=:), allocatable :: words

    words = ''
    if (.not. aimag(mode%rate) > 0.0_wp) return
    words = ' to and fro'
    if (mode%sense > circular) words = ' forward'
    if (mode%sense < -circular) words = ' backward'
  end function sense_words

  !> A mode of foil or film that is damped less than all of the rotor.
  function other_words(speed, mode) result(words)
    real(wp), intent(in) :: speed !! [rad/s]
    type(rotor_mode_type), intent(in) :: mode
    character(len=:), allocatable :: words

    words = 'a mode of the '//trim(merge('foil', 'film', is_of_foil(mode)))//' at '//text(aimag(mode%rate)/speed, digits)// &
            ' of the speed that changes as exp('//text(real(mode%rate, wp), digits)//' t)'
  end function other_words

  !> What the mode that decides says.
  function state_words(speed, mode) result(words)
    real(wp), intent(in) :: speed !! [rad/s]
    type(rotor_mode_type), intent(in) :: mode
    character(len=:), allocatable :: words

    words = 'stable, its'
    if (real(mode%rate, wp) > 0.0_wp) words = 'unstable, its'
    words = words//' least damped mode ('//trim(merge('conical    ', 'cylindrical', mode%kind == conical))// &
            sense_words(mode)//') is at '//text(aimag(mode%rate)/speed, digits)//' of the speed and changes as exp('// &
            text(real(mode%rate, wp), digits)//' t), damping ratio '//text(damping_ratio(mode), digits)
  end function state_words

  !> Damping over critical damping.
  elemental function damping_ratio(mode) result(ratio)
    type(rotor_mode_type), intent(in) :: mode
    real(wp) :: ratio
    ratio = -real(mode%rate, wp)/abs(mode%rate)
  end function damping_ratio

  !> Adds the least damped mode of the rotor, and of any kind, to results, where there is one.
  subroutine add_rotor(answer, found)
    type(rotor_answer_type), intent(in) :: answer
    type(quantity_type), allocatable, intent(inout) :: found(:)

    if (.not. answer%found) return
    if (size(answer%mode) > 0) then
      call add_result(found, 'largest_growth_rate', real(answer%mode(1)%rate, wp))
      call add_result(found, 'largest_growth_frequency', aimag(answer%mode(1)%rate))
    end if
    if (answer%decides == 0) return
    associate (mode => answer%mode(answer%decides))
      call add_result(found, 'growth_rate', real(mode%rate, wp))
      call add_result(found, 'whirl_frequency', aimag(mode%rate))
      call add_result(found, 'damping_ratio', damping_ratio(mode))
    end associate
  end subroutine add_rotor

  !> The modes as numbers that are kept.
  pure function mode_matrix(answer) result(matrix)
    type(rotor_answer_type), intent(in) :: answer !! its modes
    real(wp), allocatable :: matrix(:, :) !! (number, mode) as `gfb_dynamics_record` has them [SI]
    integer :: i

    allocate (matrix(mode_numbers, merge(size(answer%mode), 0, answer%found)))
    do i = 1, size(matrix, 2)
      associate (mode => answer%mode(i))
        matrix(:, i) = [aimag(mode%rate), real(mode%rate, wp), damping_ratio(mode), mode%share, real(mode%kind, wp), mode%sense, &
                        mode%foil_share]
      end associate
    end do
  end function mode_matrix
end module gfb_rotor_report
