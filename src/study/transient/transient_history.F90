#include "gfb_petsc.h"
!> The lines of a shaft over time: a column each quantity (`time_columns` of `gfb_result_table`), a line each time, and their spectra.
module gfb_transient_history
  use gfb_kinds, only: wp
  use gfb_archive, only: archive_type
  use gfb_petsc_session, only: sum_over_ranks
  use gfb_text, only: text
  use gfb_bearing, only: bearing_type
  use gfb_bearing_answer, only: bearing_answer_type, bearing_answer
  use gfb_time_march, only: march_type
  use gfb_newton, only: newton_type
  use gfb_case_file, only: case_array_type, add_array
  use gfb_spectra, only: spectra_type, spectra_of, points_a_turn
  use gfb_orbit_record, only: orbit_record_type
  use gfb_result_table, only: time_columns, planar_time_columns
  implicit none (type, external)
  private

  real(wp), parameter :: rounding = 1.0e-9_wp !! of the speeds of lines that are read, over the largest [1]

  !> The lines so far.
  type, public :: transient_history_type
    integer :: lines = 0
    logical :: tilts = .false.                  !! a rotor does, on two bearings
    real(wp), allocatable :: values(:, :)       !! (columns, lines), see `time_columns`, with room for more [SI]
    real(wp) :: smallest_gap = huge(1.0_wp)     !! of all steps [m]
    type(orbit_record_type) :: orbit            !! of all steps of the last turns
  contains
    procedure :: add => add_line, see => see_step, add_arrays => add_history, lacks_spectrum, column
    procedure, private :: put, put_plane
    procedure :: visit => visit_history, misfit
  end type transient_history_type

contains

  !> Adds the present state.
  subroutine add_line(self, march, bearing, newton)
    class(transient_history_type), intent(inout) :: self !! gets the line
    type(march_type), intent(in) :: march !! at the state
    class(bearing_type), intent(in) :: bearing !! the same
    type(newton_type), intent(in) :: newton !! its solver
    type(bearing_answer_type) :: answer
    real(wp) :: gas(2)
    real(wp), allocatable :: grown(:, :)

    self%tilts = march%drive%bearing_distance > 0.0_wp
    if (.not. allocated(self%values)) allocate (self%values(merge(size(time_columns), planar_time_columns, self%tilts), 256))
    if (self%lines == size(self%values, 2)) then
      allocate (grown(size(self%values, 1), 2*self%lines))
      grown(:, :self%lines) = self%values
      call move_alloc(grown, self%values)
    end if
    answer = bearing_answer(bearing, brief=.true.)
    gas = gas_balance(bearing)
    self%lines = self%lines + 1
    self%smallest_gap = min(self%smallest_gap, answer%minimum_gap)
    call self%put('time', march%time)
    call self%put('turns', march%turns())
    call self%put('speed', bearing%point%speed)
    call self%put_plane('eccentricity', march%place(:2, 1))
    call self%put_plane('velocity', march%velocity(:2, 1))
    call self%put_plane('force', answer%force(:2))
    call self%put_plane('load', march%drive%load_at(march%time))
    call self%put('minimum_gap', answer%minimum_gap)
    call self%put('maximum_pressure', answer%maximum_pressure)
    call self%put('minimum_pressure', answer%minimum_pressure)
    call self%put('friction_torque', answer%friction_torque)
    call self%put('step', march%step)
    call self%put('stored_gas', gas(1))
    call self%put('gas_outflow', gas(2))
    call self%put('steps', real(march%steps, wp))
    call self%put('newton_iterations', real(newton%iterations, wp))
    call self%put('factorizations', real(newton%factorizations, wp))
    if (self%tilts) call add_tilts(self, march, answer)
  end subroutine add_line

  !> Adds to the present line what a rotor that tilts on two bearings has beside the others.
  subroutine add_tilts(self, march, answer)
    class(transient_history_type), intent(inout) :: self
    type(march_type), intent(in) :: march
    type(bearing_answer_type), intent(in) :: answer
    real(wp) :: way(2, 2)
    integer :: i, pads

    call self%put_plane('tilt', march%place(4:, 1))
    call self%put_plane('tilt_velocity', march%velocity(4:, 1))
    call self%put_plane('torque', answer%force(4:))
    call self%put_plane('outer_torque', march%drive%torque_at(march%time))
    way = march%way_in_bearings(march%place(:, 1))
    pads = size(answer%pad_gap)/2
    do i = 1, 2
      call self%put_plane('eccentricity', way(:, i), '_'//text(i))
      call self%put('minimum_gap_'//text(i), minval(answer%pad_gap((i - 1)*pads + 1:i*pads)))
    end do
  end subroutine add_tilts

  !> Puts a value in its column of the newest line.
  pure subroutine put(self, name, value)
    class(transient_history_type), intent(inout) :: self !! with that line
    character(len=*), intent(in) :: name !! of the column
    real(wp), intent(in) :: value !! in the column's unit
    self%values(column_of(name), self%lines) = value
  end subroutine put

  !> Puts values along x and y in their columns.
  pure subroutine put_plane(self, name, value, ending)
    class(transient_history_type), intent(inout) :: self !! with its newest line
    character(len=*), intent(in) :: name !! of the columns before `_x` and `_y`
    real(wp), intent(in) :: value(2) !! in their unit
    character(len=*), intent(in), optional :: ending !! of the names, behind these; default: none
    character(len=*), parameter :: along(2) = ['_x', '_y']
    integer :: i

    do i = 1, 2
      if (present(ending)) then
        call self%put(name//along(i)//ending, value(i))
      else
        call self%put(name//along(i), value(i))
      end if
    end do
  end subroutine put_plane

  !> Number of a column; stops where there is none of that name.
  pure integer function column_of(name) result(number)
    character(len=*), intent(in) :: name

    do number = 1, size(time_columns)
      if (time_columns(number)%name == name) return
    end do
    error stop 'no column of a shaft over time: '//name
  end function column_of

  !> A column of all lines.
  pure function column(self, name) result(values)
    class(transient_history_type), intent(in) :: self !! the lines
    character(len=*), intent(in) :: name !! of the column
    real(wp) :: values(self%lines)
    values = self%values(column_of(name), :self%lines)
  end function column

  !> Notes the smallest gap and the place of the present state, which no line need show.
  subroutine see_step(self, march, bearing)
    class(transient_history_type), intent(inout) :: self !! notes them
    type(march_type), intent(in) :: march !! after a step
    class(bearing_type), intent(in) :: bearing !! the same

    self%smallest_gap = min(self%smallest_gap, bearing%smallest_gap())
    call self%orbit%see(march)
  end subroutine see_step

  !> The gas that the films hold, and what leaves them a time.
  function gas_balance(bearing) result(gas)
    class(bearing_type), intent(in) :: bearing
    real(wp) :: gas(2) !! [Pa m3], [Pa m3/s]
    real(wp) :: unknown(bearing%local_size()), gap(bearing%film_nodes()), flows(bearing%film_nodes())
    real(wp), allocatable :: stored(:, :)
    integer :: i, element

    call bearing%get_unknowns(unknown)
    gap = bearing%gap(unknown)
    flows = 0.0_wp
    gas = 0.0_wp
    do i = 1, size(bearing%pad)
      associate (pad => bearing%pad(i), film => bearing%pad(i)%film, nodes => bearing%pad(i)%last_node - bearing%pad(i)%first_node, &
                 first => bearing%pad(i)%first_node + 1, last => bearing%pad(i)%last_node)
        stored = film%stored(unknown(pad%first + 1:pad%first + nodes), gap(first:last), bearing%position(unknown))
        do element = 1, size(stored, 2)
          gas(1) = gas(1) + film%copies*dot_product(film%geometry(element)%area(:size(stored, 1)), stored(:, element))
        end do
        call film%add_flows(unknown(pad%first + 1:pad%first + nodes), gap(first:last), bearing%position(unknown), flows(first:last))
        gas(2) = gas(2) - film%copies*sum(flows(first:last), film%fixed)
      end associate
    end do
    gas = sum_over_ranks(gas)
  end function gas_balance

  !> Adds the arrays of the result file, a dataset a name.
  subroutine add_history(self, arrays)
    class(transient_history_type), intent(in) :: self !! the lines
    type(case_array_type), allocatable, intent(inout) :: arrays(:) !! of the file
    integer :: i

    do i = 1, size(self%values, 1)
      associate (row => time_columns(i))
        call add_array(arrays, '/transient/'//trim(row%name), trim(row%unit), trim(row%meaning), self%values(i:i, :self%lines), &
                       is_column=.true.)
      end associate
    end do
    call add_spectra(self, arrays)
  end subroutine add_history

  !> Adds the spectra of the shaft's motion, a row a window of some turns; none where there are less than two turns, or less
  !> than two lines a turn.
  subroutine add_spectra(self, arrays)
    class(transient_history_type), intent(in) :: self
    type(case_array_type), allocatable, intent(inout) :: arrays(:)
    type(spectra_type) :: spectra
    character(len=:), allocatable :: place
    integer, allocatable :: moving(:) ! columns
    integer :: i

    moving = [column_of('eccentricity_x'), column_of('eccentricity_y')]
    if (self%tilts) moving = [(column_of('eccentricity_x_'//text(i)), column_of('eccentricity_y_'//text(i)), i=1, 2)]
    spectra = spectra_of(self%column('time'), self%column('turns'), self%values(moving, :self%lines))
    if (size(spectra%time) == 0) return
    call add_array(arrays, '/spectrum/time', 's', 'in the middle of the window', reshape(spectra%time, [1, size(spectra%time)]))
    call add_array(arrays, '/spectrum/speed', 'rad/s', 'mean speed of the shaft in the window', &
                   reshape(spectra%speed, [1, size(spectra%speed)]))
    call add_array(arrays, '/spectrum/frequency', 'Hz', 'of the lines: window by line', spectra%frequency)
    do i = 1, size(moving)
      place = trim(time_columns(moving(i))%name)
      call add_array(arrays, '/spectrum/amplitude'//place(len('eccentricity') + 1:), 'm', 'amplitude of '//place//': window by line', &
                     spectra%amplitude(:, :, i))
    end do
  end subroutine add_spectra

  !> Whether there are turns enough for a spectrum, but lines too far apart to show what happens once a turn.
  pure logical function lacks_spectrum(self)
    class(transient_history_type), intent(in) :: self !! the lines

    associate (turns => self%column('turns'))
      lacks_spectrum = turns(self%lines) - turns(1) >= 2.0_wp .and. points_a_turn(turns) < 2.0_wp
    end associate
  end function lacks_spectrum

  !> Saves or restores the lines.
  subroutine visit_history(self, archive)
    class(transient_history_type), intent(inout) :: self !! written where the archive restores
    type(archive_type), intent(inout) :: archive !! that saves or restores
    real(wp), allocatable :: lines(:, :)

    lines = self%values(:, :self%lines)
    call archive%visit_sized('lines', lines)
    call archive%visit('smallest_gap', self%smallest_gap)
    call self%orbit%visit(archive)
    if (archive%saves) return
    call archive%require(allocated(lines), 'the lines so far')
    if (archive%failed) return
    call archive%require(size(lines, 1) == size(self%values, 1), 'the lines so far')
    if (archive%failed) return
    self%lines = size(lines, 2)
    call move_alloc(lines, self%values)
  end subroutine visit_history

  !> What in lines and orbit that were read does not fit the march; empty where nothing does.
  function misfit(self, march, may_touch) result(what)
    class(transient_history_type), intent(in) :: self !! as read
    type(march_type), intent(in) :: march !! its own numbers do
    logical, intent(in) :: may_touch !! gaps may close: asperities carry
    character(len=:), allocatable :: what
    real(wp), allocatable :: time(:), speed(:)
    integer :: i

    what = ''
    if (self%lines < 1) then
      what = 'the lines so far'
      return
    end if
    time = self%column('time')
    speed = self%column('speed')
    associate (n => self%lines)
      if (abs(time(1)) > 0.0_wp .or. any(time(2:) <= time(:n - 1)) .or. time(n) > march%time) what = 'the times of the lines'
      if (any(abs(speed - [(march%drive%speed_at(time(i)), i=1, n)]) > rounding*maxval(abs(speed)))) what = 'the speeds of the lines'
    end associate
    if (any(self%column('minimum_pressure') <= 0.0_wp) .or. any(self%column('maximum_pressure') <= 0.0_wp)) then
      what = 'the pressures of the lines'
    end if
    if (self%smallest_gap > minval(self%column('minimum_gap')) .or. .not. (may_touch .or. self%smallest_gap > 0.0_wp)) then
      what = 'the smallest gap'
    end if
    if (.not. self%orbit%ends_at(march)) what = 'the orbit'
  end function misfit
end module gfb_transient_history
