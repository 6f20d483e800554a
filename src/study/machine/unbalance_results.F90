#include "gfb_petsc.h"
!> Unbalance of a machine, and what is shown and written of the response to it.
module gfb_unbalance_results
  use gfb_kinds, only: wp
  use gfb_text, only: text
  use gfb_units, only: degrees, micrometres
  use gfb_run_log, only: run_log_type
  use gfb_scene, only: scene_type
  use gfb_case_file, only: case_array_type, add_array
  use gfb_shaft, only: node_at
  use gfb_machine, only: machine_type
  use gfb_machine_response, only: machine_response_type
  implicit none (type)
  private
  public :: unbalance_force, shown_nodes, show_response, add_responses

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

  !> The same as lines of the log.
  subroutine show_response(machine, response, log)
    type(machine_type), intent(in) :: machine
    complex(wp), intent(in) :: response(:) !! [m], [1]
    type(run_log_type), intent(in) :: log !! where lines go
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
  subroutine add_responses(machine, responses, sweeps, arrays)
    type(machine_type), intent(in) :: machine
    type(machine_response_type), intent(in) :: responses(:) !! one a point
    logical, intent(in) :: sweeps !! there are several points
    type(case_array_type), allocatable, intent(inout) :: arrays(:) !! of the result file
    character(len=*), parameter :: path = '/dynamics/response', words = 'unbalance response of bearings, discs, stations: z [m], '// &
                                   'amplitude [m] and phase [rad] of x, of y; x = amplitude cos(speed t + phase)'
    real(wp), allocatable :: table(:, :)
    integer :: k

    table = response_table(machine, responses(1)%motion)
    if (sweeps) table = reshape([(response_table(machine, responses(k)%motion), k=1, size(responses))], [size(table), size(responses)])
    if (sweeps) call add_array(arrays, path, 'mixed SI', words, table, .true.)
    if (.not. sweeps) call add_array(arrays, path, 'mixed SI', words, table)
  end subroutine add_responses

  !> Angle of a complex number [rad].
  elemental real(wp) function phase_of(number) result(phase)
    complex(wp), intent(in) :: number
    phase = atan2(aimag(number), real(number, wp))
  end function phase_of
end module gfb_unbalance_results
