#include "gfb_petsc.h"
!> Small motions of a machine about its equilibrium, and what is shown and written of them.
module gfb_machine_motions
  use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan
  use gfb_kinds, only: wp
  use gfb_text, only: text
  use gfb_units, only: turn
  use gfb_run_log, only: run_log_type
  use gfb_quantity, only: quantity_type
  use gfb_result_names, only: add_result
  use gfb_scene, only: scene_type
  use gfb_case_file, only: case_array_type, add_array
  use gfb_shaft, only: shaft_motions => motions, journal_places
  use gfb_bending_wave, only: elements_per_wave
  use gfb_operation_case, only: angular_speed
  use gfb_machine, only: machine_type
  use gfb_machine_linear, only: linear_bearing_type
  use gfb_machine_starts, only: machine_mode_type
  use gfb_machine_modes, only: find_machine_modes
  use gfb_machine_response, only: machine_response_type, find_machine_response
  use gfb_unbalance_results, only: unbalance_force, shown_nodes
  use gfb_rotor, only: whirl_sense, words_of_sense
  implicit none (type)
  private
  public :: find_motions, check_waves, add_motions, growth_of, frequency_of

  real(wp), parameter :: fewest_elements = 4.0_wp !! of a wave of the shaft [1]
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
    type(machine_response_type), allocatable :: response !! to unbalance, where there is one
  end type machine_motions_type

contains

  !> All modes up to the highest frequency asked for, and the response to unbalance unless that has speeds of its own.
  subroutine find_motions(scene, machine, linear, log, counted, motions)
    type(scene_type), intent(in) :: scene !! of the machine
    type(machine_type), intent(in) :: machine
    type(linear_bearing_type), intent(inout) :: linear(:) !! its bearings about their answers
    type(run_log_type), intent(in) :: log !! where lines go
    integer, intent(inout) :: counted !! modes that there were when they were counted last, or `not_counted`
    type(machine_motions_type), intent(out) :: motions
    character(len=:), allocatable :: reason
    real(wp) :: highest
    logical :: found

    highest = highest_frequency(scene, machine%speed)
    call find_machine_modes(machine, linear, highest, log, motions%mode, reason, counted)
    if (reason /= '') call log%warning(reason)
    if (size(scene%unbalance%position) == 0 .or. size(scene%dynamics%response_speeds) > 0) return
    allocate (motions%response)
    call find_machine_response(machine, linear, unbalance_force(machine, scene), motions%response, found)
    if (found) return
    deallocate (motions%response)
    call log%warning('the response to unbalance was not found: a bearing cannot be solved at the frequency of the speed')
  end subroutine find_motions

  !> Frequency up to which modes are looked for.
  pure real(wp) function highest_frequency(scene, speed) result(highest)
    type(scene_type), intent(in) :: scene !! of the machine
    real(wp), intent(in) :: speed !! of it [rad/s]

    highest = scene%dynamics%largest_frequency
    if (.not. highest > 0.0_wp) highest = usual_highest*speed
  end function highest_frequency

  !> Warns of a shaft whose elements are long against the waves of the modes that are looked for.
  subroutine check_waves(scene, machine, log)
    type(scene_type), intent(in) :: scene !! of the machine
    type(machine_type), intent(in) :: machine
    type(run_log_type), intent(in) :: log !! gets the warning
    real(wp) :: highest, elements

    highest = highest_frequency(scene, machine%speed)
    if (scene%sweep%present) highest = highest_frequency(scene, angular_speed(maxval(scene%sweep%values)))
    if (.not. highest > 0.0_wp) return
    elements = elements_per_wave(machine%shaft, highest)
    if (elements >= fewest_elements) return
    call log%warning('a wave of the shaft at '//text(highest, 4)//' rad/s has '//text(elements, 2)//' elements, '// &
                     text(nint(fewest_elements))//' are needed: more elements in &shaft, or a smaller largest_frequency in &dynamics')
  end subroutine check_waves

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

  !> Shows and writes modes, of a sweep those of all its points.
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
    call log%line('mode   frequency [Hz]   over speed   growth [1/s]   log decrement   sense')
    do i = 1, size(mode)
      associate (rate => mode(i)%rate)
        call log%line(right_text(text(i), 4)//right_text(text(aimag(rate)/turn, 5), 17)// &
                      right_text(text(aimag(rate)/max(machine%speed, tiny(1.0_wp)), 4), 13)// &
                      right_text(text(real(rate, wp), 4), 15)//right_text(text(-turn*real(rate, wp)/aimag(rate), 4), 16)//'   '//words_of_sense(sense_of(mode(i)%shape)))
      end associate
    end do
  end subroutine show_modes

  !> The modes as arrays: a row each, of a sweep a row a point, which has NaN at its end where others have more.
  subroutine add_modes(machine, motions, sweeps, arrays)
    type(machine_type), intent(in) :: machine
    type(machine_motions_type), intent(in) :: motions(:)
    logical, intent(in) :: sweeps
    type(case_array_type), allocatable, intent(inout) :: arrays(:)
    real(wp), allocatable :: table(:, :, :), shape(:, :), share(:, :, :)
    integer, allocatable :: node(:)
    real(wp) :: of_mode(size(names))
    integer :: i, k, most, bearings

    bearings = size(machine%journal)
    most = merge(1, 0, sweeps)
    do k = 1, size(motions)
      most = max(most, size(motions(k)%mode))
    end do
    allocate (table(most, size(motions), size(names)), source=ieee_value(1.0_wp, ieee_quiet_nan))
    allocate (share(most, size(motions), 0:bearings), source=ieee_value(1.0_wp, ieee_quiet_nan))
    do k = 1, size(motions)
      do i = 1, size(motions(k)%mode)
        associate (mode => motions(k)%mode(i), rate => motions(k)%mode(i)%rate)
          of_mode = [aimag(rate), real(rate, wp), -real(rate, wp)/abs(rate), -turn*real(rate, wp)/aimag(rate), sense_of(mode%shape)]
          share(i, k, :) = [1.0_wp - sum(mode%share), mode%share]
        end associate
        table(i, k, :) = of_mode
      end do
    end do
    do i = 1, size(names)
      call add_rows(trim(names(i)), trim(units(i)), trim(meanings(i)), table(:, :, i))
    end do
    call add_rows('mode_shaft_share', '1', 'share of the shaft in the energy of each mode', share(:, :, 0))
    do i = 1, bearings
      call add_rows('mode_share_'//text(i), '1', 'share of film and foil of bearing '//text(i)//' in the energy of each mode', share(:, :, i))
    end do
    associate (last => motions(size(motions)))
      if (size(last%mode) == 0) return
      shape = reshape([(by_nodes(machine, last%mode(i)%shape), i=1, size(last%mode))], [2*size(last%mode(1)%shape), size(last%mode)])
    end associate
    call add_array(arrays, '/dynamics/mode_shape', 'mixed SI', 'of each mode, of a sweep at its last point: real and imaginary part '// &
                   'of x, y [m], rotation about x and y [rad], node by node of /shaft/line', shape)
    node = shown_nodes(machine)
    associate (last => motions(size(motions)))
      shape = reshape([((sense_at(last%mode(i)%shape, node(k)), k=1, size(node)), i=1, size(last%mode))], [size(node), size(last%mode)])
    end associate
    call add_array(arrays, '/dynamics/mode_station_sense', '1', 'of each mode, of a sweep at its last point, at bearings, discs, '// &
                   'stations: 1: a circle with the speed, -1: against it', shape)
    if (machine%along > 0) call add_axial(motions(size(motions))%mode, arrays)

  contains

    !> A value a mode; of a sweep a row a point.
    subroutine add_rows(name, unit, meaning, values)
      character(len=*), intent(in) :: name, unit, meaning
      real(wp), intent(in) :: values(:, :) !! (mode, point), in that unit [SI]

      if (sweeps) call add_array(arrays, '/dynamics/'//name, unit, meaning, values, .true.)
      if (.not. sweeps) call add_array(arrays, '/dynamics/'//name, unit, meaning, transpose(values))
    end subroutine add_rows
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
    integer :: n

    n = size(motion)/2
    sense = sense_at(motion, maxloc(abs(motion(1:n:2))**2 + abs(motion(n + 1::2))**2, 1))
  end function sense_of

  !> How it goes round at a node.
  pure real(wp) function sense_at(motion, node) result(sense)
    complex(wp), intent(in) :: motion(:) !! of the shaft
    integer, intent(in) :: node
    sense = whirl_sense([motion(2*node - 1), motion(size(motion)/2 + 2*node - 1)])
  end function sense_at

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

end module gfb_machine_motions
