#include "gfb_petsc.h"
!> Response of a machine to unbalance over the speed, and its critical speeds.
!>
!> Each speed has its own equilibrium, and its own coefficients. Between speeds that are asked for a critical speed is
!> one at which the longer half axis of some place's orbit is largest (`gfb_resonance`); of the places whose largest
!> responses lie next to each other, the one that moves most decides.
module gfb_critical_speeds
  use gfb_kinds, only: wp
  use gfb_text, only: text
  use gfb_units, only: micrometres
  use gfb_run_log, only: run_log_type
  use gfb_sorting, only: sort_by
  use gfb_quantity, only: quantity_type
  use gfb_result_names, only: add_result
  use gfb_case_file, only: case_array_type, add_array
  use gfb_machine, only: machine_type
  use gfb_machine_response, only: machine_response_type
  use gfb_resonance, only: resonance_type, peaks_of
  use gfb_unbalance_results, only: shown_nodes, amplitude_at, speed_rpm_of
  implicit none (type)
  private
  public :: find_responses, find_critical_speeds, add_critical_speeds

  integer, parameter :: most_critical = 12 !! that are looked for

  !> What answers unbalance at a speed.
  type, abstract, public :: responding_type
  contains
    procedure(respond), deferred :: respond
  end type responding_type

  abstract interface
    !> The response at a speed.
    subroutine respond(self, speed_rpm, response, found)
      import :: responding_type, machine_response_type, wp
      class(responding_type), intent(inout) :: self !! the machine
      real(wp), intent(in) :: speed_rpm !! [rpm]
      type(machine_response_type), intent(out) :: response !! where it was found
      logical, intent(out) :: found !! there is an equilibrium, and it could be linearised
    end subroutine respond
  end interface

  !> A critical speed.
  type, public :: critical_speed_type
    type(resonance_type) :: resonance
    real(wp) :: position = 0.0_wp !! z of what moves most [m]
  end type critical_speed_type

contains

  !> Responses at speeds, begun at the end that is nearer to where the machine is; those before one that was not found.
  subroutine find_responses(machine, speed_rpm, present_rpm, log, responses)
    class(responding_type), intent(inout) :: machine
    real(wp), intent(in) :: speed_rpm(:) !! asked for [rpm]
    real(wp), intent(in) :: present_rpm  !! of the machine [rpm]
    type(run_log_type), intent(in) :: log !! where lines go
    type(machine_response_type), allocatable, intent(out) :: responses(:) !! speed rising
    type(machine_response_type) :: response
    integer :: order(size(speed_rpm)), i
    logical :: found

    order = [(i, i=1, size(order))]
    call sort_by(speed_rpm, order)
    associate (first => speed_rpm(order(1)), last => speed_rpm(order(size(order))))
      if (abs(last - present_rpm) < abs(first - present_rpm)) order = order(size(order):1:-1)
    end associate
    allocate (responses(0))
    do i = 1, size(order)
      call log%is_within('unbalance, speed '//text(i)//' of '//text(size(order)))
      call machine%respond(speed_rpm(order(i)), response, found)
      if (.not. found) then
        call log%warning('no response to unbalance at '//text(speed_rpm(order(i)))//' rpm and beyond: there is no equilibrium')
        exit
      end if
      responses = [responses, response]
    end do
    call log%is_within('')
    call sort_responses(responses)
  end subroutine find_responses

  !> Puts responses in the order of their speeds.
  subroutine sort_responses(responses)
    type(machine_response_type), intent(inout) :: responses(:)
    integer :: order(size(responses)), i

    order = [(i, i=1, size(order))]
    call sort_by(responses%speed, order)
    responses = responses(order)
  end subroutine sort_responses

  !> Critical speeds between those of responses.
  subroutine find_critical_speeds(machine, shape, responses, log, critical)
    class(responding_type), intent(inout) :: machine
    type(machine_type), intent(in) :: shape !! of it
    type(machine_response_type), intent(in) :: responses(:) !! at any speeds
    type(run_log_type), intent(in) :: log !! where lines go
    type(critical_speed_type), allocatable, intent(out) :: critical(:) !! speed rising
    type(machine_response_type) :: sorted(size(responses))
    type(critical_speed_type) :: one
    real(wp), allocatable :: amplitude(:, :)
    integer, allocatable :: node(:), top(:), place(:)
    logical :: found
    integer :: i, k

    allocate (critical(0))
    sorted = responses
    call sort_responses(sorted)
    node = shown_nodes(shape)
    allocate (amplitude(size(node), size(sorted)))
    do k = 1, size(sorted)
      amplitude(:, k) = amplitude_at(sorted(k), node)
    end do
    call choose_tops(amplitude, top, place)
    do i = 1, min(size(top), most_critical)
      one%resonance = resonance_type(top=top(i))
      one%resonance%speed = speed_rpm_of(sorted)
      one%resonance%amplitude = amplitude(place(i), :) ! in a structure constructor GNU Fortran 12 takes wrong strides
      one%position = shape%shaft%z(node(place(i)))
      call log%is_within('critical speed '//text(i)//' of '//text(size(top)))
      call follow(machine, node(place(i)), one%resonance, found)
      if (found) critical = [critical, one]
      if (.not. found) call log%warning('no critical speed next to '//text(speed_rpm_of(sorted(top(i))))//' rpm: there is no equilibrium')
    end do
    call log%is_within('')
  end subroutine find_critical_speeds

  !> Speeds at which some place moves most, rising, and the place: of neighbours the one that moves more.
  pure subroutine choose_tops(amplitude, top, place)
    real(wp), intent(in) :: amplitude(:, :) !! (place, speed) [m]
    integer, allocatable, intent(out) :: top(:)   !! numbers of speeds
    integer, allocatable, intent(out) :: place(:) !! of places
    integer :: i, k

    allocate (top(0), place(0))
    do k = 2, size(amplitude, 2) - 1
      do i = 1, size(amplitude, 1)
        if (all(peaks_of(amplitude(i, :)) /= k)) cycle
        if (size(top) > 0) then
          associate (last => size(top))
            if (top(last) >= k - 1) then
              if (amplitude(i, k) > amplitude(place(last), top(last))) then
                top(last) = k
                place(last) = i
              end if
              cycle
            end if
          end associate
        end if
        top = [top, k]
        place = [place, i]
      end do
    end do
  end subroutine choose_tops

  !> Asks the machine until a resonance is known.
  subroutine follow(machine, node, resonance, found)
    class(responding_type), intent(inout) :: machine
    integer, intent(in) :: node !! that moves most
    type(resonance_type), intent(inout) :: resonance
    logical, intent(out) :: found
    type(machine_response_type) :: response
    real(wp) :: speed, amplitude(1)

    do
      found = .true.
      call resonance%next(speed)
      if (speed < 0.0_wp) return
      call machine%respond(speed, response, found)
      if (.not. found) return
      amplitude = amplitude_at(response, [node])
      call resonance%tell(speed, amplitude(1))
    end do
  end subroutine follow

  !> Shows and writes critical speeds.
  subroutine add_critical_speeds(critical, responses, log, summary, arrays)
    type(critical_speed_type), intent(in) :: critical(:)
    type(machine_response_type), intent(in) :: responses(:) !! between whose speeds they were looked for
    type(run_log_type), intent(in) :: log !! where lines go
    type(quantity_type), allocatable, intent(inout) :: summary(:) !! gets speeds and factors
    type(case_array_type), allocatable, intent(inout) :: arrays(:) !! of the result file
    real(wp) :: table(6, size(critical))
    character(len=:), allocatable :: words
    integer :: i

    if (size(critical) == 0) then
      if (size(responses) > 2) call log%line('critical speed   none found between '//text(minval(speed_rpm_of(responses)), 6)//' and '// &
                                             text(maxval(speed_rpm_of(responses)), 6)//' rpm')
      return
    end if
    do i = 1, size(critical)
      associate (one => critical(i)%resonance, z => critical(i)%position)
        words = 'critical speed   '//text(one%critical, 6)//' rpm: '//text(one%largest*micrometres, 4)//' um at '//text(z*1.0e3_wp, 4)//' mm'
        call add_result(summary, 'critical_speed_'//text(i), one%critical)
        if (all(one%side > 0.0_wp)) then
          call add_result(summary, 'amplification_factor_'//text(i), one%factor())
          words = words//', amplification factor '//text(one%factor(), 4)//', 0.707 of it at '//text(one%side(1), 6)//' and '// &
                  text(one%side(2), 6)//' rpm'
        end if
        call log%line(words)
        table(:, i) = [one%critical, z, one%largest, one%side, one%factor()]
      end associate
    end do
    call add_array(arrays, '/dynamics/critical_speed', 'mixed SI', 'critical speed [rpm], z of what moves most [m], half axis of it [m], '// &
                   'speeds with 0.707 of it, 0 beyond those asked for [rpm], amplification factor [1]', table)
  end subroutine add_critical_speeds
end module gfb_critical_speeds
