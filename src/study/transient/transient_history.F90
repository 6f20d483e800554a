#include "gfb_petsc.h"
!> What is kept of a shaft over time: a line a step, or every few steps.
module gfb_transient_history
  use gfb_kinds, only: wp
  use gfb_archive, only: archive_type
  use gfb_petsc_session, only: sum_over_ranks
  use gfb_bearing_system, only: bearing_system_type
  use gfb_bearing_answer, only: bearing_answer_type, bearing_answer
  use gfb_time_march, only: march_type
  use gfb_newton, only: newton_type
  use gfb_case_file, only: case_array_type, fill_array, add_arrays
  use gfb_spectra, only: spectra_type, spectra_of, points_a_turn
  use gfb_orbit_record, only: orbit_record_type
  implicit none (type)
  private

  integer, parameter :: planar = 21, columns = 35 !! of a shaft that does not tilt, of a rotor that does
  integer, parameter :: plane_columns(2) = [4, 5] !! e_x and e_y
  integer, parameter :: journal_columns(4) = [30, 31, 32, 33] !! the same of both bearings
  character(len=*), parameter :: names(columns) = [character(len=17) :: &
    'time', 'turns', 'speed', 'eccentricity_x', 'eccentricity_y', 'velocity_x', 'velocity_y', &
    'force_x', 'force_y', 'load_x', 'load_y', 'minimum_gap', 'maximum_pressure', 'minimum_pressure', &
    'friction_torque', 'step', 'stored_gas', 'gas_outflow', 'steps', 'newton_iterations', 'factorizations', &
    'tilt_x', 'tilt_y', 'tilt_velocity_x', 'tilt_velocity_y', 'torque_x', 'torque_y', 'outer_torque_x', 'outer_torque_y', &
    'eccentricity_x_1', 'eccentricity_y_1', 'eccentricity_x_2', 'eccentricity_y_2', 'minimum_gap_1', 'minimum_gap_2']
  character(len=*), parameter :: units(columns) = [character(len=8) :: &
    's', '1', 'rad/s', 'm', 'm', 'm/s', 'm/s', 'N', 'N', 'N', 'N', 'm', 'Pa', 'Pa', 'N m', 's', &
    'Pa m^3', 'Pa m^3/s', '1', '1', '1', &
    'rad', 'rad', 'rad/s', 'rad/s', 'N m', 'N m', 'N m', 'N m', 'm', 'm', 'm', 'm', 'm', 'm']
  character(len=*), parameter :: meanings(columns) = [character(len=96) :: &
    'time from the beginning', 'turns of the shaft so far', 'speed of the shaft', &
    'e_x, of the sleeve relative to the shaft', 'e_y, of the sleeve relative to the shaft', &
    'rate of e_x', 'rate of e_y', &
    'film force on the sleeve, x', 'film force on the sleeve, y', &
    'outer force on the shaft, x: load, unbalance, pulse, base', &
    'outer force on the shaft, y: load, unbalance, pulse, base', &
    'smallest film thickness', 'largest absolute pressure', 'smallest absolute pressure', &
    'torque with which the film brakes the shaft', 'step of time that led here', &
    'p h integrated over the film (in a real gas density times p_a over that at p_a, times h)', &
    'that leaves the film through its edges, a time', 'steps so far', &
    'Newton iterations so far, with those of the start', &
    'factorizations so far, with those of the start', &
    'tilt of the sleeves relative to the rotor about x', 'tilt of the sleeves relative to the rotor about y', &
    'rate of tilt_x', 'rate of tilt_y', &
    'torque of the films on the rotor about its centre of mass, x', &
    'torque of the films on the rotor about its centre of mass, y', &
    'outer torque on the rotor, x: couple unbalance, pulse', 'outer torque on the rotor, y: couple unbalance, pulse', &
    'e_x in a bearing: 1 at +z, 2 at -z', 'e_y in a bearing: 1 at +z, 2 at -z', &
    'e_x in a bearing: 1 at +z, 2 at -z', 'e_y in a bearing: 1 at +z, 2 at -z', &
    'smallest film thickness of a bearing: 1 at +z, 2 at -z', 'smallest film thickness of a bearing: 1 at +z, 2 at -z']

  !> The lines so far.
  type, public :: transient_history_type
    integer :: lines = 0
    logical :: tilts = .false.                  !! a rotor does, on two bearings
    real(wp), allocatable :: values(:, :)       !! (columns, lines), with room for more [SI]
    real(wp) :: smallest_gap = huge(1.0_wp)     !! of all steps [m]
    type(orbit_record_type) :: orbit            !! of all steps of the last turns
  contains
    procedure :: add => add_line
    procedure :: see => see_step
    procedure :: arrays => history_arrays
    procedure :: lacks_spectrum
    procedure :: visit => visit_history
  end type transient_history_type

contains

  !> Adds the present state.
  subroutine add_line(self, march, bearing, newton)
    class(transient_history_type), intent(inout) :: self !! gets the line
    type(march_type), intent(in) :: march !! at the state
    type(bearing_system_type), intent(in) :: bearing !! the same
    type(newton_type), intent(in) :: newton !! its solver
    type(bearing_answer_type) :: answer
    real(wp) :: gas(2)
    real(wp), allocatable :: grown(:, :)
    integer :: pads

    self%tilts = march%drive%bearing_distance > 0.0_wp
    if (.not. allocated(self%values)) allocate (self%values(merge(columns, planar, self%tilts), 256))
    if (self%lines == size(self%values, 2)) then
      allocate (grown(size(self%values, 1), 2*self%lines))
      grown(:, :self%lines) = self%values
      call move_alloc(grown, self%values)
    end if
    answer = bearing_answer(bearing, brief=.true.)
    gas = gas_balance(bearing)
    self%lines = self%lines + 1
    self%smallest_gap = min(self%smallest_gap, answer%minimum_gap)
    self%values(:planar, self%lines) = [march%time, march%turns(), bearing%point%speed, march%place(:2, 1), march%velocity(:2, 1), &
                                  answer%force(:2), march%outer_load(), answer%minimum_gap, answer%maximum_pressure, &
                                  answer%minimum_pressure, answer%friction_torque, march%step, gas, &
                                  real([march%steps, newton%iterations, newton%factorizations], wp)]
    if (.not. self%tilts) return
    pads = size(bearing%pad)/2
    self%values(planar + 1:, self%lines) = [march%place(3:, 1), march%velocity(3:, 1), answer%force(3:), march%outer_torque(), &
                                            pack(march%way_in_bearings(march%place(:, 1)), .true.), &
                                            minval(answer%pad_gap(:pads)), minval(answer%pad_gap(pads + 1:))]
  end subroutine add_line

  !> Notes the smallest gap and the place of the present state, which no line need show.
  subroutine see_step(self, march, bearing)
    class(transient_history_type), intent(inout) :: self !! notes them
    type(march_type), intent(in) :: march !! after a step
    type(bearing_system_type), intent(in) :: bearing !! the same

    self%smallest_gap = min(self%smallest_gap, bearing%smallest_gap())
    call self%orbit%see(march)
  end subroutine see_step

  !> The gas that the films hold, and what leaves them a time.
  function gas_balance(bearing) result(gas)
    type(bearing_system_type), intent(in) :: bearing
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

  !> The arrays of the result file, a dataset a name.
  function history_arrays(self) result(arrays)
    class(transient_history_type), intent(in) :: self !! the lines
    type(case_array_type), allocatable :: arrays(:)
    type(case_array_type) :: one(1)
    integer :: i

    allocate (arrays(0))
    do i = 1, size(self%values, 1)
      call fill_array('/transient/'//trim(names(i)), trim(units(i)), trim(meanings(i)), self%values(i:i, :self%lines), one(1))
      call add_arrays(arrays, one)
    end do
    call add_spectra(self, arrays)
  end function history_arrays

  !> Adds the spectra of the shaft's motion, a row a window of some turns; none where there are less than two turns, or less
  !> than two lines a turn.
  subroutine add_spectra(self, arrays)
    class(transient_history_type), intent(in) :: self
    type(case_array_type), allocatable, intent(inout) :: arrays(:)
    type(case_array_type) :: one(1)
    type(spectra_type) :: spectra
    character(len=:), allocatable :: place
    integer, allocatable :: column(:)
    integer :: i

    column = plane_columns
    if (self%tilts) column = journal_columns
    spectra = spectra_of(self%values(1, :self%lines), self%values(2, :self%lines), self%values(column, :self%lines))
    if (size(spectra%time) == 0) return
    call fill_array('/spectrum/time', 's', 'in the middle of the window', reshape(spectra%time, [1, size(spectra%time)]), one(1))
    call add_arrays(arrays, one)
    call fill_array('/spectrum/speed', 'rad/s', 'mean speed of the shaft in the window', &
                    reshape(spectra%speed, [1, size(spectra%speed)]), one(1))
    call add_arrays(arrays, one)
    call fill_array('/spectrum/frequency', 'Hz', 'of the lines: window by line', spectra%frequency, one(1))
    call add_arrays(arrays, one)
    do i = 1, size(column)
      place = trim(names(column(i)))
      call fill_array('/spectrum/amplitude'//place(len('eccentricity') + 1:), 'm', 'amplitude of '//place//': window by line', &
                      spectra%amplitude(:, :, i), one(1))
      call add_arrays(arrays, one)
    end do
  end subroutine add_spectra

  !> Whether there are turns enough for a spectrum, but lines too far apart to show what happens once a turn.
  pure logical function lacks_spectrum(self)
    class(transient_history_type), intent(in) :: self !! the lines

    associate (turns => self%values(2, :self%lines))
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
end module gfb_transient_history
