#include "gfb_petsc.h"
!> The lines of a machine over time: a column each quantity, a line each time, and spectra of the shaft's motion.
module gfb_machine_history
  use gfb_kinds, only: wp
  use gfb_archive, only: archive_type
  use gfb_text, only: text
  use gfb_case_file, only: case_array_type, add_array
  use gfb_spectra, only: spectra_type, spectra_of, points_a_turn
  use gfb_orbit_record, only: orbit_record_type
  use gfb_bearing_answer, only: bearing_answer_type, bearing_answer
  use gfb_orbit_table, only: words_of_place
  use gfb_quantity, only: quantity_type
  use gfb_result_names, only: add_result
  use gfb_machine, only: machine_type, places_along
  use gfb_film_surface, only: shaft_coordinates, translations
  use gfb_bearing_rows, only: places, forces, is_written
  use gfb_machine_equilibrium, only: machine_bearing_type
  use gfb_machine_march, only: machine_march_type
  implicit none (type, external)
  private
  public :: begin_history

  real(wp), parameter, public :: orbit_turns = 5.0_wp !! of an orbit: two whirls of less than half the speed fit in [1]
  character(len=*), parameter :: axes(2) = ['x', 'y']

  !> What stands in a column.
  type :: column_type
    character(len=:), allocatable :: name, unit, meaning
  end type column_type

  !> The lines so far.
  type, public :: machine_history_type
    type(column_type), allocatable :: column(:)
    character(len=32), allocatable :: place(:) !! where the shaft's motion is shown: `bearing_1`, ...
    integer, allocatable :: node(:)            !! of each
    real(wp), allocatable :: values(:, :)      !! (columns, lines), with room for more [SI]
    integer :: lines = 0
    real(wp), allocatable :: gap(:)            !! smallest one of each bearing now [m]
    real(wp) :: smallest_gap = huge(1.0_wp)    !! of all steps and bearings [m]
    type(orbit_record_type) :: orbit           !! of all places, every step of the last turns
  contains
    procedure :: add => add_line, see => see_step, add_arrays, results, lacks_spectrum, visit => visit_history, misfit
    procedure, private :: times
  end type machine_history_type

contains

  !> Names the columns.
  subroutine begin_history(machine, node, place, history)
    type(machine_type), intent(in) :: machine
    integer, intent(in) :: node(:) !! where the shaft's motion is shown
    character(len=*), intent(in) :: place(:) !! what is there
    type(machine_history_type), intent(out) :: history
    integer :: i, k

    history%node = node
    allocate (history%place(size(place)))
    history%place = place
    allocate (history%column(0))
    call put('time', 's', 'time from the beginning')
    call put('turns', '1', 'turns of the shaft so far')
    call put('speed', 'rad/s', 'speed of the shaft')
    do i = 1, size(place)
      do k = 1, 2
        call put(axes(k)//'_'//trim(place(i)), 'm', 'place of the shaft''s axis along '//axes(k)//' at '//words_of_place(place(i)))
      end do
    end do
    do i = 1, size(machine%journal)
      associate (behind => '_'//text(i), of => ' of bearing '//text(i))
        do k = 1, shaft_coordinates
          if (is_written(machine%journal(i), k)) call put(trim(places(k))//behind, merge('m  ', 'rad', k <= translations), &
                                                          trim(places(k))//of//', of its sleeve relative to the shaft')
        end do
        do k = 1, shaft_coordinates
          if (is_written(machine%journal(i), k)) call put(trim(forces(k))//behind, merge('N  ', 'N m', k <= translations), &
                                                          trim(forces(k))//' of the film on the sleeve'//of)
        end do
        call put('minimum_gap'//behind, 'm', 'smallest film thickness'//of)
        call put('maximum_pressure'//behind, 'Pa', 'largest absolute pressure'//of)
        call put('friction_torque'//behind, 'N m', 'torque with which the film'//of//' brakes the shaft')
      end associate
    end do
    call put('step', 's', 'step of time that led here')
    call put('steps', '1', 'steps so far')
    call put('newton_iterations', '1', 'Newton iterations of all bearings so far, with those of the start')
    call put('factorizations', '1', 'factorizations so far, with those of the start')
    call put('coupling_iterations', '1', 'iterations between shaft and films so far')

  contains

    !> A column more.
    subroutine put(name, unit, meaning)
      character(len=*), intent(in) :: name, unit, meaning
      type(column_type) :: column

      column%name = name
      column%unit = trim(unit) ! gfortran's constructor would keep the length of before, and what stands behind
      column%meaning = meaning
      history%column = [history%column, column]
    end subroutine put
  end subroutine begin_history

  !> Notes the smallest gap and the places of the present state, which no line need show.
  subroutine see_step(self, machine, march, bearing)
    class(machine_history_type), intent(inout) :: self !! notes them
    type(machine_type), intent(in) :: machine
    type(machine_march_type), intent(in) :: march !! at the beginning or after a step
    type(machine_bearing_type), intent(in) :: bearing(:) !! the same
    integer :: i

    self%gap = [(bearing(i)%bearing%smallest_gap(), i=1, size(bearing))]
    self%smallest_gap = min(self%smallest_gap, minval(self%gap))
    call self%orbit%see_motion(march%film(1), places_along(machine, march%motion(:, 1), self%node), orbit_turns, 0.0_wp)
  end subroutine see_step

  !> Adds the present state.
  subroutine add_line(self, machine, march, bearing)
    class(machine_history_type), intent(inout) :: self !! gets the line
    type(machine_type), intent(in) :: machine
    type(machine_march_type), intent(in) :: march !! at the state
    type(machine_bearing_type), intent(in) :: bearing(:) !! the same
    type(bearing_answer_type) :: answer
    real(wp), allocatable :: line(:), grown(:, :)
    integer, allocatable :: written(:) ! coordinates
    integer :: i, k, iterations, factorizations

    associate (clock => march%film(1))
      line = [clock%time, clock%turns(), bearing(1)%bearing%point%speed, places_along(machine, march%motion(:, 1), self%node)]
      iterations = 0
      factorizations = 0
      do i = 1, size(bearing)
        answer = bearing_answer(bearing(i)%bearing, brief=.true.)
        written = pack([(k, k=1, shaft_coordinates)], [(is_written(machine%journal(i), k), k=1, shaft_coordinates)])
        line = [line, march%film(i)%place(written, 1), answer%force(written), answer%minimum_gap, answer%maximum_pressure, &
                answer%friction_torque]
        iterations = iterations + bearing(i)%newton%iterations
        factorizations = factorizations + bearing(i)%newton%factorizations
      end do
      line = [line, clock%step, real([clock%steps, iterations, factorizations, march%solves], wp)]
    end associate
    if (.not. allocated(self%values)) allocate (self%values(size(line), 256))
    if (self%lines == size(self%values, 2)) then
      allocate (grown(size(line), 2*self%lines))
      grown(:, :self%lines) = self%values
      call move_alloc(grown, self%values)
    end if
    self%lines = self%lines + 1
    self%values(:, self%lines) = line
  end subroutine add_line

  !> The arrays of the result file, a dataset a column, and spectra.
  subroutine add_arrays(self, arrays)
    class(machine_history_type), intent(in) :: self !! the lines
    type(case_array_type), allocatable, intent(inout) :: arrays(:) !! of the file
    type(spectra_type) :: spectra
    integer :: i, k

    do i = 1, size(self%column)
      associate (column => self%column(i))
        call add_array(arrays, '/transient/'//column%name, column%unit, column%meaning, self%values(i:i, :self%lines), is_column=.true.)
      end associate
    end do
    associate (first => 4, last => 3 + 2*size(self%place))
      spectra = spectra_of(self%values(1, :self%lines), self%times(), self%values(first:last, :self%lines))
      if (size(spectra%time) == 0) return
      call add_array(arrays, '/spectrum/time', 's', 'in the middle of the window', reshape(spectra%time, [1, size(spectra%time)]))
      call add_array(arrays, '/spectrum/speed', 'rad/s', 'mean speed of the shaft in the window', &
                     reshape(spectra%speed, [1, size(spectra%speed)]))
      call add_array(arrays, '/spectrum/frequency', 'Hz', 'of the lines: window by line', spectra%frequency)
      do k = first, last
        call add_array(arrays, '/spectrum/amplitude_'//self%column(k)%name, 'm', 'amplitude of '//self%column(k)%name// &
                       ': window by line', spectra%amplitude(:, :, k - first + 1))
      end do
    end associate
  end subroutine add_arrays

  !> Turns of the lines.
  pure function times(self)
    class(machine_history_type), intent(in) :: self
    real(wp) :: times(self%lines)
    times = self%values(2, :self%lines)
  end function times

  !> Whether there are turns enough for a spectrum, but lines too far apart to show what happens once a turn.
  pure logical function lacks_spectrum(self)
    class(machine_history_type), intent(in) :: self !! the lines

    associate (turns => self%times())
      lacks_spectrum = turns(self%lines) - turns(1) >= 2.0_wp .and. points_a_turn(turns) < 2.0_wp
    end associate
  end function lacks_spectrum

  !> What the summary says of the whole time.
  function results(self, march) result(found)
    class(machine_history_type), intent(in) :: self !! the lines
    type(machine_march_type), intent(in) :: march !! at its end
    type(quantity_type), allocatable :: found(:)
    real(wp), allocatable :: box(:)
    integer :: i, k

    associate (clock => march%film(1))
      call add_result(found, 'time', clock%time)
      call add_result(found, 'turns', clock%turns())
      call add_result(found, 'time_steps', clock%steps)
      box = self%orbit%extents(clock%turns() - orbit_turns, clock%turns(), [(i, i=1, 2*size(self%place))])
    end associate
    do i = 1, size(self%place)
      do k = 1, 2
        associate (of => 2*(2*i - 2 + k))
          call add_result(found, 'orbit_'//axes(k)//'_'//trim(self%place(i)), box(of) - box(of - 1))
        end associate
      end do
    end do
    call add_result(found, 'minimum_gap_over_time', self%smallest_gap)
  end function results

  !> Saves or restores the lines.
  subroutine visit_history(self, archive)
    class(machine_history_type), intent(inout) :: self !! written where the archive restores
    type(archive_type), intent(inout) :: archive !! that saves or restores
    real(wp), allocatable :: lines(:, :)

    lines = self%values(:, :self%lines)
    call archive%visit_sized('lines', lines)
    call archive%visit('smallest_gap', self%smallest_gap)
    call self%orbit%visit(archive)
    if (archive%saves) return
    call archive%require(allocated(lines), 'the lines so far')
    if (archive%failed) return
    call archive%require(size(lines, 1) == size(self%column) .and. size(lines, 2) > 0, 'the lines so far')
    if (archive%failed) return
    self%lines = size(lines, 2)
    call move_alloc(lines, self%values)
  end subroutine visit_history

  !> What in lines and orbit that were read does not fit the march; empty where nothing does.
  function misfit(self, march) result(what)
    class(machine_history_type), intent(in) :: self !! as read
    type(machine_march_type), intent(in) :: march !! its own numbers do
    character(len=:), allocatable :: what

    what = ''
    associate (time => self%values(1, :self%lines), turns => self%values(2, :self%lines), n => self%lines)
      if (abs(time(1)) > 0.0_wp .or. any(time(2:) <= time(:n - 1)) .or. time(n) > march%film(1)%time) what = 'the times of the lines'
      if (any(turns(2:) < turns(:n - 1))) what = 'the turns of the lines'
    end associate
    if (.not. abs(self%smallest_gap) < huge(1.0_wp)) what = 'the smallest gap'
  end function misfit
end module gfb_machine_history
