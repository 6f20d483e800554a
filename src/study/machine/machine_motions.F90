#include "gfb_petsc.h"
!> Small motions of a machine about its equilibrium, and what is shown and written of them.
module gfb_machine_motions
  use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan
  use gfb_kinds, only: wp
  use gfb_text, only: text
  use gfb_units, only: degrees, turn, micrometres
  use gfb_run_log, only: run_log_type
  use gfb_quantity, only: quantity_type
  use gfb_result_names, only: add_result
  use gfb_scene, only: scene_type
  use gfb_case_file, only: case_array_type, add_array
  use gfb_shaft, only: shaft_motions => motions, node_at, journal_places
  use gfb_machine, only: machine_type
  use gfb_machine_linear, only: linear_bearing_type
  use gfb_machine_starts, only: machine_mode_type
  use gfb_machine_modes, only: find_machine_modes
  use gfb_machine_response, only: find_machine_response
  use gfb_rotor, only: whirl_sense
  implicit none (type)
  private
  public :: find_motions, add_motions, growth_of, frequency_of

  real(wp), parameter :: usual_highest = 1.5_wp !! frequency up to which modes are looked for, over the speed [1]

  !> What is written of each mode.
  character(len=*), parameter :: names(*) = [character(len=21) :: 'mode_frequency', 'mode_growth_rate', 'mode_damping_ratio', &
                                             'logarithmic_decrement', 'mode_sense']
  character(len=*), parameter :: units(*) = [character(len=5) :: 'rad/s', '1/s', '1', '1', '1']
  character(len=*), parameter :: meanings(*) = [character(len=70) :: &
    'circular frequency of the modes, growth falling', 'growth of the amplitude, exp(growth t)', &
    'minus the growth over the modulus of growth + i frequency', 'logarithm of an amplitude over that a period later', &
    '1: a circle with the speed where it is largest, -1: against it']

  !> Small motions about an equilibrium.
  type, public :: machine_motions_type
    type(machine_mode_type), allocatable :: mode(:) !! growth falling; not allocated: not asked for
    complex(wp), allocatable :: response(:)         !! of the shaft to its unbalance, where it has one [m], [1]
  end type machine_motions_type

contains

  !> All modes up to the highest frequency asked for, and the response to unbalance.
  subroutine find_motions(scene, machine, linear, log, motions)
    type(scene_type), intent(in) :: scene !! of the machine
    type(machine_type), intent(in) :: machine
    type(linear_bearing_type), intent(inout) :: linear(:) !! its bearings about their answers
    type(run_log_type), intent(in) :: log !! where lines go
    type(machine_motions_type), intent(out) :: motions
    character(len=:), allocatable :: reason
    real(wp) :: highest
    logical :: found

    highest = scene%dynamics%largest_frequency
    if (.not. highest > 0.0_wp) highest = usual_highest*machine%speed
    call find_machine_modes(machine, linear, highest, log, motions%mode, reason)
    if (reason /= '') call log%warning(reason)
    if (size(scene%unbalance%position) == 0) return
    call find_machine_response(machine, linear, unbalance_force(machine, scene), motions%response, found)
    if (found) return
    deallocate (motions%response)
    call log%warning('the response to unbalance was not found: a bearing cannot be solved at the frequency of the speed')
  end subroutine find_motions

  !> Forces of the unbalance, \( u \Omega^2 e^{i \alpha} \) along x, a quarter turn later along y.
  function unbalance_force(machine, scene) result(force)
    type(machine_type), intent(in) :: machine
    type(scene_type), intent(in) :: scene
    complex(wp), allocatable :: force(:) !! [N], [N m]
    complex(wp) :: one
    integer :: i, n, place

    n = 2*size(machine%shaft%z)
    allocate (force(2*n), source=(0.0_wp, 0.0_wp))
    do i = 1, size(scene%unbalance%position)
      place = 2*node_at(machine%shaft, scene%unbalance%position(i)) - 1
      one = scene%unbalance%value(i)*machine%speed**2*exp(cmplx(0.0_wp, scene%unbalance%angles(i), wp))
      force(place) = force(place) + one
      force(n + place) = force(n + place) - cmplx(0.0_wp, 1.0_wp, wp)*one
    end do
  end function unbalance_force

  !> Growth of the mode that grows most or dies out last; not a number where there is none [1/s].
  pure real(wp) function growth_of(motions) result(growth)
    type(machine_motions_type), intent(in) :: motions

    growth = ieee_value(1.0_wp, ieee_quiet_nan)
    if (size(motions%mode) > 0) growth = real(motions%mode(1)%rate, wp)
  end function growth_of

  !> Its frequency [rad/s].
  pure real(wp) function frequency_of(motions) result(frequency)
    type(machine_motions_type), intent(in) :: motions

    frequency = ieee_value(1.0_wp, ieee_quiet_nan)
    if (size(motions%mode) > 0) frequency = aimag(motions%mode(1)%rate)
  end function frequency_of

  !> Shows and writes modes and response, of a sweep those of all its points.
  subroutine add_motions(machine, motions, sweeps, log, summary, arrays)
    type(machine_type), intent(in) :: machine
    type(machine_motions_type), intent(in) :: motions(:) !! of it, one a point
    logical, intent(in) :: sweeps !! there are several points
    type(run_log_type), intent(in) :: log !! where lines go
    type(quantity_type), allocatable, intent(inout) :: summary(:) !! gets growth and frequency of the least damped mode
    type(case_array_type), allocatable, intent(inout) :: arrays(:) !! of the result file

    associate (last => motions(size(motions)))
      if (allocated(last%mode)) then
        call show_modes(machine, last%mode, log)
        if (size(last%mode) > 0) then
          call add_result(summary, 'growth_rate', growth_of(last))
          call add_result(summary, 'whirl_frequency', frequency_of(last))
        end if
        call add_modes(machine, motions, sweeps, arrays)
      end if
      if (allocated(last%response)) then
        call show_response(machine, last%response, log)
        call add_responses(machine, motions, sweeps, arrays)
      end if
    end associate
  end subroutine add_motions

  !> The modes as lines of the log.
  subroutine show_modes(machine, mode, log)
    type(machine_type), intent(in) :: machine
    type(machine_mode_type), intent(in) :: mode(:)
    type(run_log_type), intent(in) :: log
    integer :: i

    if (size(mode) == 0) then
      call log%line('modes            none up to the highest frequency asked for')
      return
    end if
    call log%line('mode   frequency [Hz]   over speed   growth [1/s]   log decrement')
    do i = 1, size(mode)
      associate (rate => mode(i)%rate)
        call log%line(right_text(text(i), 4)//right_text(text(aimag(rate)/turn, 5), 17)// &
                      right_text(text(aimag(rate)/max(machine%speed, tiny(1.0_wp)), 4), 13)// &
                      right_text(text(real(rate, wp), 4), 15)//right_text(text(-turn*real(rate, wp)/aimag(rate), 4), 16))
      end associate
    end do
  end subroutine show_modes

  !> The modes as arrays: a row each, of a sweep a row a point, which has NaN at its end where others have more.
  subroutine add_modes(machine, motions, sweeps, arrays)
    type(machine_type), intent(in) :: machine
    type(machine_motions_type), intent(in) :: motions(:)
    logical, intent(in) :: sweeps
    type(case_array_type), allocatable, intent(inout) :: arrays(:)
    real(wp), allocatable :: table(:, :, :), shape(:, :)
    real(wp) :: of_mode(size(names))
    integer :: i, k, most

    most = merge(1, 0, sweeps)
    do k = 1, size(motions)
      most = max(most, size(motions(k)%mode))
    end do
    allocate (table(most, size(motions), size(names)), source=ieee_value(1.0_wp, ieee_quiet_nan))
    do k = 1, size(motions)
      do i = 1, size(motions(k)%mode)
        associate (rate => motions(k)%mode(i)%rate)
          of_mode = [aimag(rate), real(rate, wp), -real(rate, wp)/abs(rate), -turn*real(rate, wp)/aimag(rate), &
                     sense_of(motions(k)%mode(i)%shape)]
        end associate
        table(i, k, :) = of_mode
      end do
    end do
    do i = 1, size(names)
      if (sweeps) call add_array(arrays, '/dynamics/'//trim(names(i)), trim(units(i)), trim(meanings(i)), table(:, :, i), .true.)
      if (.not. sweeps) call add_array(arrays, '/dynamics/'//trim(names(i)), trim(units(i)), trim(meanings(i)), transpose(table(:, :, i)))
    end do
    associate (last => motions(size(motions)))
      if (size(last%mode) == 0) return
      shape = reshape([(by_nodes(machine, last%mode(i)%shape), i=1, size(last%mode))], [2*size(last%mode(1)%shape), size(last%mode)])
    end associate
    call add_array(arrays, '/dynamics/mode_shape', 'mixed SI', 'of each mode, of a sweep at its last point: real and imaginary part '// &
                   'of x, y [m], rotation about x and y [rad], node by node of /shaft/line', shape)
    if (machine%along > 0) call add_axial(motions(size(motions))%mode, arrays)
  end subroutine add_modes

  !> How the shaft moves along its axis in each mode.
  subroutine add_axial(mode, arrays)
    type(machine_mode_type), intent(in) :: mode(:)
    type(case_array_type), allocatable, intent(inout) :: arrays(:)
    call add_array(arrays, '/dynamics/mode_shape_z', 'mixed SI', 'of each mode, of a sweep at its last point: real and imaginary part '// &
                   'of z of the shaft', reshape([real(mode%along, wp), aimag(mode%along)], [2, size(mode)], order=[2, 1]))
  end subroutine add_axial

  !> Text at the right of a column.
  pure function right_text(words, width) result(padded)
    character(len=*), intent(in) :: words
    integer, intent(in) :: width
    character(len=width) :: padded
    padded = words
    padded = adjustr(padded)
  end function right_text

  !> How a motion goes round where it is largest.
  pure real(wp) function sense_of(motion) result(sense)
    complex(wp), intent(in) :: motion(:) !! of the shaft
    integer :: k, n

    n = size(motion)/2
    k = maxloc(abs(motion(1:n:2))**2 + abs(motion(n + 1::2))**2, 1)
    sense = whirl_sense([motion(2*k - 1), motion(n + 2*k - 1)])
  end function sense_of

  !> A motion of the shaft, node by node: real and imaginary parts of x, y, theta_x, theta_y.
  pure function by_nodes(machine, motion) result(values)
    type(machine_type), intent(in) :: machine
    complex(wp), intent(in) :: motion(:) !! of the shaft
    real(wp) :: values(2*size(motion))
    complex(wp) :: one(shaft_motions)
    real(wp) :: sign(shaft_motions)
    integer :: k, place(shaft_motions)

    do k = 1, size(machine%shaft%z)
      call journal_places(machine%shaft, k, place, sign)
      one = sign*motion(place)
      values(8*k - 7:8*k:2) = real(one, wp)
      values(8*k - 6:8*k:2) = aimag(one)
    end do
  end function by_nodes

  !> How unbalance moves the shaft: z, amplitude and phase of x, of y, at bearings, discs and stations.
  function response_table(machine, response) result(table)
    type(machine_type), intent(in) :: machine
    complex(wp), intent(in) :: response(:) !! [m], [1]
    real(wp), allocatable :: table(:, :)
    integer, allocatable :: node(:)
    integer :: i, n

    n = 2*size(machine%shaft%z)
    node = [(node_at(machine%shaft, machine%journal(i)%position), i=1, size(machine%journal)), machine%station]
    allocate (table(5, size(node)))
    do i = 1, size(node)
      associate (x => response(2*node(i) - 1), y => response(n + 2*node(i) - 1))
        table(:, i) = [machine%shaft%z(node(i)), abs(x), phase_of(x), abs(y), phase_of(y)]
      end associate
    end do
  end function response_table

  !> The same as lines of the log.
  subroutine show_response(machine, response, log)
    type(machine_type), intent(in) :: machine
    complex(wp), intent(in) :: response(:) !! [m], [1]
    type(run_log_type), intent(in) :: log
    real(wp), allocatable :: table(:, :)
    integer :: i

    table = response_table(machine, response)
    do i = 1, size(table, 2)
      call log%line('response         at '//text(table(1, i)*1.0e3_wp, 4)//' mm: '//text(table(2, i)*micrometres, 4)//' x '// &
                    text(table(4, i)*micrometres, 4)//' um, phase '//text(table(3, i)*degrees, 4)//', '// &
                    text(table(5, i)*degrees, 4)//' deg')
    end do
  end subroutine show_response

  !> The response as an array: a row a place; of a sweep a row a point, place after place.
  subroutine add_responses(machine, motions, sweeps, arrays)
    type(machine_type), intent(in) :: machine
    type(machine_motions_type), intent(in) :: motions(:)
    logical, intent(in) :: sweeps
    type(case_array_type), allocatable, intent(inout) :: arrays(:)
    character(len=*), parameter :: path = '/dynamics/response', words = 'unbalance response of bearings, discs, stations: z [m], '// &
                                   'amplitude [m] and phase [rad] of x, of y; x = amplitude cos(speed t + phase)'
    real(wp), allocatable :: table(:, :)
    integer :: k

    table = response_table(machine, motions(1)%response)
    if (sweeps) table = reshape([(response_table(machine, motions(k)%response), k=1, size(motions))], [size(table), size(motions)])
    if (sweeps) call add_array(arrays, path, 'mixed SI', words, table, .true.)
    if (.not. sweeps) call add_array(arrays, path, 'mixed SI', words, table)
  end subroutine add_responses

  !> Angle of a complex number [rad].
  elemental real(wp) function phase_of(number) result(phase)
    complex(wp), intent(in) :: number
    phase = atan2(aimag(number), real(number, wp))
  end function phase_of
end module gfb_machine_motions
