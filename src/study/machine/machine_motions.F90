#include "gfb_petsc.h"
!> Small motions of a machine about its equilibrium, and what is shown and written of them.
module gfb_machine_motions
  use gfb_kinds, only: wp
  use gfb_text, only: text
  use gfb_units, only: degrees, turn, micrometres
  use gfb_run_log, only: run_log_type
  use gfb_quantity, only: quantity_type
  use gfb_result_names, only: add_result
  use gfb_scene, only: scene_type
  use gfb_case_file, only: case_array_type, add_array
  use gfb_shaft, only: shaft_motions => motions, node_at
  use gfb_machine, only: machine_type
  use gfb_machine_modes, only: linear_bearing_type, machine_mode_type, find_machine_modes, find_machine_response
  use gfb_rotor, only: whirl_sense
  implicit none (type)
  private
  public :: find_motions, add_motions

  real(wp), parameter :: usual_highest = 1.5_wp !! frequency up to which modes are looked for, over the speed [1]

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

  !> Shows and writes modes and response.
  subroutine add_motions(machine, motions, log, summary, arrays)
    type(machine_type), intent(in) :: machine
    type(machine_motions_type), intent(in) :: motions !! of it
    type(run_log_type), intent(in) :: log !! where lines go
    type(quantity_type), allocatable, intent(inout) :: summary(:) !! gets growth and frequency of the least damped mode
    type(case_array_type), allocatable, intent(inout) :: arrays(:) !! of the result file
    if (allocated(motions%mode)) call add_modes(machine, motions%mode, log, summary, arrays)
    if (allocated(motions%response)) call add_response(machine, motions%response, log, arrays)
  end subroutine add_motions

  !> The modes, in the log and as arrays; the least damped one in the summary.
  subroutine add_modes(machine, mode, log, summary, arrays)
    type(machine_type), intent(in) :: machine
    type(machine_mode_type), intent(in) :: mode(:)
    type(run_log_type), intent(in) :: log
    type(quantity_type), allocatable, intent(inout) :: summary(:)
    type(case_array_type), allocatable, intent(inout) :: arrays(:)
    real(wp), allocatable :: table(:, :), shape(:, :)
    integer :: i, n, nodes

    n = size(mode)
    if (n == 0) then
      call log%line('modes            none up to the highest frequency asked for')
      return
    end if
    call add_result(summary, 'growth_rate', real(mode(1)%rate, wp))
    call add_result(summary, 'whirl_frequency', aimag(mode(1)%rate))
    nodes = size(machine%shaft%z)
    allocate (table(5, n), shape(8*nodes, n))
    call log%line('mode   frequency [Hz]   over speed   growth [1/s]   log decrement')
    do i = 1, n
      associate (rate => mode(i)%rate)
        table(:, i) = [aimag(rate), real(rate, wp), -real(rate, wp)/abs(rate), -turn*real(rate, wp)/aimag(rate), &
                       sense_of(mode(i)%shape)]
        shape(:, i) = by_nodes(mode(i)%shape)
        call log%line(right_text(text(i), 4)//right_text(text(aimag(rate)/turn, 5), 17)// &
                      right_text(text(aimag(rate)/max(machine%speed, tiny(1.0_wp)), 4), 13)// &
                      right_text(text(real(rate, wp), 4), 15)//right_text(text(table(4, i), 4), 16))
      end associate
    end do
    call add_array(arrays, '/dynamics/mode_frequency', 'rad/s', 'circular frequency of the modes, growth falling', table(1:1, :))
    call add_array(arrays, '/dynamics/mode_growth_rate', '1/s', 'growth of the amplitude, exp(growth t)', table(2:2, :))
    call add_array(arrays, '/dynamics/mode_damping_ratio', '1', 'minus the growth over the modulus of growth + i frequency', table(3:3, :))
    call add_array(arrays, '/dynamics/logarithmic_decrement', '1', 'logarithm of an amplitude over that a period later', table(4:4, :))
    call add_array(arrays, '/dynamics/mode_sense', '1', '1: a circle with the speed where it is largest, -1: against it', table(5:5, :))
    call add_array(arrays, '/dynamics/mode_shape', 'mixed SI', 'of each mode, real and imaginary part of x, y [m], rotation about x and y '// &
                   '[rad], node by node of /shaft/line', shape)
  end subroutine add_modes

  !> Text at the right of a column.
  pure function right_text(words, width) result(padded)
    character(len=*), intent(in) :: words
    integer, intent(in) :: width
    character(len=width) :: padded
    padded = adjustr(padded_to(words, width))
  end function right_text

  !> Text at the left of a column.
  pure function padded_to(words, width) result(padded)
    character(len=*), intent(in) :: words
    integer, intent(in) :: width
    character(len=width) :: padded
    padded = words
  end function padded_to

  !> How a motion goes round where it is largest.
  pure real(wp) function sense_of(motion) result(sense)
    complex(wp), intent(in) :: motion(:) !! of the shaft
    integer :: k, n

    n = size(motion)/2
    k = maxloc(abs(motion(1:n:2))**2 + abs(motion(n + 1::2))**2, 1)
    sense = whirl_sense([motion(2*k - 1), motion(n + 2*k - 1)])
  end function sense_of

  !> A motion of the shaft, node by node: real and imaginary parts of x, y, theta_x, theta_y.
  pure function by_nodes(motion) result(values)
    complex(wp), intent(in) :: motion(:) !! of the shaft
    real(wp) :: values(4*size(motion)/2)
    complex(wp) :: one(shaft_motions)
    integer :: k, n

    n = size(motion)/2
    do k = 1, n/2
      one = [motion(2*k - 1), motion(n + 2*k - 1), -motion(n + 2*k), motion(2*k)]
      values(8*k - 7:8*k:2) = real(one, wp)
      values(8*k - 6:8*k:2) = aimag(one)
    end do
  end function by_nodes

  !> How unbalance moves the shaft at bearings, discs and stations.
  subroutine add_response(machine, response, log, arrays)
    type(machine_type), intent(in) :: machine
    complex(wp), intent(in) :: response(:) !! [m], [1]
    type(run_log_type), intent(in) :: log
    type(case_array_type), allocatable, intent(inout) :: arrays(:)
    integer, allocatable :: node(:)
    real(wp), allocatable :: table(:, :)
    integer :: i, n

    n = 2*size(machine%shaft%z)
    node = [(node_at(machine%shaft, machine%journal(i)%position), i=1, size(machine%journal)), machine%station]
    allocate (table(5, size(node)))
    do i = 1, size(node)
      associate (x => response(2*node(i) - 1), y => response(n + 2*node(i) - 1), z => machine%shaft%z(node(i)))
        table(:, i) = [z, abs(x), phase_of(x), abs(y), phase_of(y)]
        call log%line('response         at '//text(z*1.0e3_wp, 4)//' mm: '//text(abs(x)*micrometres, 4)//' x '// &
                      text(abs(y)*micrometres, 4)//' um, phase '//text(phase_of(x)*degrees, 4)//', '//text(phase_of(y)*degrees, 4)//' deg')
      end associate
    end do
    call add_array(arrays, '/dynamics/response', 'mixed SI', 'unbalance response of bearings, discs, stations: z [m], amplitude [m] and '// &
                   'phase [rad] of x, of y; x = amplitude cos(Omega t + phase)', table)
  end subroutine add_response

  !> Angle of a complex number [rad].
  elemental real(wp) function phase_of(number) result(phase)
    complex(wp), intent(in) :: number
    phase = atan2(aimag(number), real(number, wp))
  end function phase_of

end module gfb_machine_motions
