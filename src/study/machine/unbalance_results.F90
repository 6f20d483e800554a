#include "gfb_petsc.h"
!> Unbalance of a machine, and what is shown and written of the response to it.
module gfb_unbalance_results
  use gfb_kinds, only: wp
  use gfb_text, only: text
  use gfb_units, only: degrees, micrometres
  use gfb_ellipse_axes, only: ellipse_axes, major_axis
  use gfb_operation_case, only: angular_speed
  use gfb_run_log, only: run_log_type
  use gfb_scene, only: scene_type
  use gfb_case_file, only: case_array_type, add_array
  use gfb_shaft, only: node_at
  use gfb_machine, only: machine_type
  use gfb_machine_response, only: machine_response_type
  implicit none (type)
  private
  public :: unbalance_force, shown_nodes, amplitude_at, speed_rpm_of, show_response, add_responses

contains

  !> Forces of the unbalance, \( u \Omega^2 e^{i \alpha} \) along x, a quarter turn later along y.
  function unbalance_force(machine, scene) result(force)
    type(machine_type), intent(in) :: machine
    type(scene_type), intent(in) :: scene !! of it
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

  !> Nodes whose motions are written: bearings, discs and stations.
  pure function shown_nodes(machine) result(node)
    type(machine_type), intent(in) :: machine
    integer, allocatable :: node(:)
    integer :: i
    node = [(node_at(machine%shaft, machine%journal(i)%position), i=1, size(machine%journal)), machine%station]
  end function shown_nodes

  !> Longer half axes of nodes' orbits.
  pure function amplitude_at(response, node) result(amplitude)
    type(machine_response_type), intent(in) :: response
    integer, intent(in) :: node(:)
    real(wp) :: amplitude(size(node)) !! [m]

    associate (motion => response%motion, n => size(response%motion)/2)
      amplitude = major_axis(motion(2*node - 1), motion(n + 2*node - 1))
    end associate
  end function amplitude_at

  !> Speeds of responses.
  elemental real(wp) function speed_rpm_of(response) result(speed)
    type(machine_response_type), intent(in) :: response
    speed = response%speed/angular_speed(1.0_wp)
  end function speed_rpm_of

  !> How unbalance moves the shaft: z, amplitude and phase of x, of y, at bearings, discs and stations.
  function response_table(machine, response) result(table)
    type(machine_type), intent(in) :: machine
    complex(wp), intent(in) :: response(:) !! [m], [1]
    real(wp), allocatable :: table(:, :)
    integer, allocatable :: node(:)
    integer :: i, n

    n = 2*size(machine%shaft%z)
    node = shown_nodes(machine)
    allocate (table(5, size(node)))
    do i = 1, size(node)
      associate (x => response(2*node(i) - 1), y => response(n + 2*node(i) - 1))
        table(:, i) = [machine%shaft%z(node(i)), abs(x), phase_of(x), abs(y), phase_of(y)]
      end associate
    end do
  end function response_table

  !> The ellipses of the same motions: z, half axes, angle of the longer one.
  function axes_table(machine, response) result(table)
    type(machine_type), intent(in) :: machine
    complex(wp), intent(in) :: response(:) !! [m], [1]
    real(wp), allocatable :: table(:, :)
    integer, allocatable :: node(:)
    integer :: i, n

    n = 2*size(machine%shaft%z)
    node = shown_nodes(machine)
    allocate (table(4, size(node)))
    do i = 1, size(node)
      table(:, i) = [machine%shaft%z(node(i)), ellipse_axes(response(2*node(i) - 1), response(n + 2*node(i) - 1))]
    end do
  end function axes_table

  !> Forces of the films on the shaft: z, amplitude and phase of that along x, along y, and its longer half axis.
  function force_table(machine, response) result(table)
    type(machine_type), intent(in) :: machine
    type(machine_response_type), intent(in) :: response
    real(wp) :: table(6, size(response%force, 2))
    integer :: i

    do i = 1, size(table, 2)
      associate (x => response%force(1, i), y => response%force(2, i))
        table(:, i) = [machine%journal(i)%position, abs(x), phase_of(x), abs(y), phase_of(y), major_axis(x, y)]
      end associate
    end do
  end function force_table

  !> The response as lines of the log.
  subroutine show_response(machine, response, log)
    type(machine_type), intent(in) :: machine
    type(machine_response_type), intent(in) :: response
    type(run_log_type), intent(in) :: log !! where lines go
    real(wp), allocatable :: table(:, :), force(:, :)
    character(len=:), allocatable :: words
    integer :: i

    table = response_table(machine, response%motion)
    force = force_table(machine, response)
    do i = 1, size(table, 2)
      words = 'response         at '//text(table(1, i)*1.0e3_wp, 4)//' mm: '//text(table(2, i)*micrometres, 4)//' x '// &
              text(table(4, i)*micrometres, 4)//' um, phase '//text(table(3, i)*degrees, 4)//', '//text(table(5, i)*degrees, 4)//' deg'
      if (i <= size(force, 2)) words = words//', force '//text(force(6, i), 4)//' N'
      call log%line(words)
    end do
  end subroutine show_response

  !> Responses as arrays: a row a place; at several speeds a row a speed, place after place.
  subroutine add_responses(machine, responses, sweeps, arrays)
    type(machine_type), intent(in) :: machine
    type(machine_response_type), intent(in) :: responses(:) !! one a speed
    logical, intent(in) :: sweeps !! there are several speeds
    type(case_array_type), allocatable, intent(inout) :: arrays(:) !! of the result file
    character(len=*), parameter :: each = 'unbalance response of bearings, discs, stations: z [m], '
    real(wp), allocatable :: table(:, :, :), axes(:, :, :), force(:, :, :)
    integer :: k, n

    n = size(responses)
    associate (nodes => size(shown_nodes(machine)))
      table = reshape([(response_table(machine, responses(k)%motion), k=1, n)], [5, nodes, n])
      axes = reshape([(axes_table(machine, responses(k)%motion), k=1, n)], [4, nodes, n])
      force = reshape([(force_table(machine, responses(k)), k=1, n)], [6, size(machine%journal), n])
    end associate
    call add_table('response', each//'amplitude [m] and phase [rad] of x, of y; x = amplitude cos(speed t + phase)', table)
    call add_table('response_axes', each//'half axes of the orbit [m], the shorter one negative against the speed, and angle of the '// &
                   'longer one from x on [rad]', axes)
    call add_table('response_force', 'force of each film on the shaft: z of the bearing [m], amplitude [N] and phase [rad] along x, along y, '// &
                   'longer half axis [N]', force)
    if (sweeps) call add_array(arrays, '/dynamics/response_speed', 'rpm', 'speeds of the response to unbalance', reshape(speed_rpm_of(responses), [1, n]))

  contains

    !> Rows of places, or of speeds.
    subroutine add_table(name, meaning, values)
      character(len=*), intent(in) :: name, meaning
      real(wp), intent(in) :: values(:, :, :) !! (value, place, speed) [SI]

      associate (m => size(values, 1)*size(values, 2))
        if (sweeps) call add_array(arrays, '/dynamics/'//name, 'mixed SI', meaning, reshape(values, [m, n]), .true.)
        if (.not. sweeps) call add_array(arrays, '/dynamics/'//name, 'mixed SI', meaning, values(:, :, 1))
      end associate
    end subroutine add_table
  end subroutine add_responses

  !> Angle of a complex number [rad].
  elemental real(wp) function phase_of(number) result(phase)
    complex(wp), intent(in) :: number
    phase = atan2(aimag(number), real(number, wp))
  end function phase_of
end module gfb_unbalance_results
