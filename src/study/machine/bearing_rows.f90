!> What is written and shown of each bearing of a machine: its place, its film's force, its losses.
module gfb_bearing_rows
  use gfb_kinds, only: wp
  use gfb_text, only: text
  use gfb_units, only: micrometres
  use gfb_run_log, only: run_log_type
  use gfb_quantity, only: quantity_type
  use gfb_result_names, only: add_result
  use gfb_film_surface, only: shaft_coordinates, axial_coordinate
  use gfb_bearing_answer, only: bearing_answer_type
  use gfb_heat_answer, only: heat_answer_type
  use gfb_case_file, only: case_array_type, add_array
  use gfb_shaft_heat, only: heat_at_ends, heat_from_surface, heat_from_discs
  use gfb_machine, only: machine_type, journal_type
  use gfb_machine_equilibrium, only: machine_equilibrium_type
  implicit none (type, external)
  private
  public :: add_rows, show_rows, is_written, add_machine_heat

  !> In the order of the shaft's coordinates.
  character(len=*), parameter, public :: places(shaft_coordinates) = [character(len=14) :: &
    'eccentricity_x', 'eccentricity_y', 'eccentricity_z', 'tilt_x', 'tilt_y']
  character(len=*), parameter, public :: forces(shaft_coordinates) = [character(len=8) :: &
    'force_x', 'force_y', 'force_z', 'torque_x', 'torque_y']
  integer, parameter :: ways = 2, first_tilt = 4
  real(wp), parameter :: microradians = 1.0e6_wp !! in a radian

contains

  !> Adds a bearing's answer; coordinates are those of its own file.
  pure subroutine add_rows(number, journal, answer, summary)
    integer, intent(in) :: number !! of the bearing
    type(journal_type), intent(in) :: journal
    type(bearing_answer_type), intent(in) :: answer
    type(quantity_type), allocatable, intent(inout) :: summary(:)
    character(len=:), allocatable :: behind
    integer :: k

    behind = '_'//text(number)
    do k = 1, shaft_coordinates
      if (is_written(journal, k)) call add_result(summary, trim(places(k))//behind, answer%place(k))
    end do
    do k = 1, shaft_coordinates
      if (is_written(journal, k)) call add_result(summary, trim(forces(k))//behind, answer%force(k))
    end do
    call add_result(summary, 'minimum_gap'//behind, answer%minimum_gap)
    call add_result(summary, 'maximum_pressure'//behind, answer%maximum_pressure)
    call add_result(summary, 'power_loss'//behind, answer%power_loss)
    if (answer%heat%present) call add_heat(behind, answer%heat, &
                                           .not. answer%ring%present, summary)
  end subroutine add_rows

  !> Adds a bearing's temperatures, and where its heat goes.
  pure subroutine add_heat(behind, heat, grows, summary)
    character(len=*), intent(in) :: behind !! names
    type(heat_answer_type), intent(in) :: heat
    logical, intent(in) :: grows !! there is a clearance, which may
    type(quantity_type), allocatable, intent(inout) :: summary(:)

    call add_result(summary, 'shaft_temperature'//behind, heat%shaft_temperature)
    call add_result(summary, 'sleeve_temperature'//behind, heat%sleeve_temperature)
    associate (whole => heat%whole)
      call add_result(summary, 'film_temperature'//behind, whole%film_temperature)
      call add_result(summary, 'maximum_film_temperature'//behind, whole%maximum_film_temperature)
      call add_result(summary, 'top_foil_temperature'//behind, whole%top_foil_temperature)
      call add_result(summary, 'heat_to_shaft'//behind, whole%to_shaft)
      call add_result(summary, 'heat_to_top_foil'//behind, whole%to_top_foil)
      call add_result(summary, 'heat_by_gas'//behind, whole%by_gas)
      if (heat%is_fed) call add_result(summary, 'heat_by_supply'//behind, whole%by_supply)
    end associate
    if (grows) call add_result(summary, 'running_clearance'//behind, heat%running_clearance)
    call add_result(summary, 'energy_imbalance'//behind, heat%imbalance)
  end subroutine add_heat

  !> Adds the shaft's temperatures, where it conducts, and where its heat leaves.
  subroutine add_machine_heat(machine, answer, bearing, log, summary, arrays)
    type(machine_type), intent(in) :: machine
    type(machine_equilibrium_type), intent(in) :: answer !! of it
    type(bearing_answer_type), intent(in) :: bearing(:) !! of its bearings
    type(run_log_type), intent(in) :: log
    type(quantity_type), allocatable, intent(inout) :: summary(:)
    type(case_array_type), allocatable, intent(inout) :: arrays(:)
    real(wp), allocatable :: line(:)
    real(wp) :: at_ends, from_surface, from_discs, power, left
    integer :: i

    if (.not. machine%heat%present) return
    line = machine%heat%line(answer%temperature)
    at_ends = heat_at_ends(machine%heat, line)
    from_surface = heat_from_surface(machine%heat, line)
    from_discs = heat_from_discs(machine%heat, line)
    call add_result(summary, 'heat_from_shaft_ends', at_ends)
    call add_result(summary, 'heat_from_shaft_surface', from_surface)
    call add_result(summary, 'heat_from_discs', from_discs)
    power = 0.0_wp
    left = -at_ends - from_surface - from_discs
    do i = 1, size(bearing)
      if (machine%heat%at(i) == 0) cycle
      associate (whole => bearing(i)%heat%whole)
        power = power + whole%power
        left = left + whole%power - whole%to_top_foil - whole%by_gas
        if (bearing(i)%heat%is_fed) left = left + whole%by_supply
      end associate
    end do
    call add_result(summary, 'energy_imbalance', left/max(power, tiny(1.0_wp)))
    call log%line('heat of the shaft '//text(at_ends, 4)//' W through its ends, '// &
                  text(from_surface, 4)//' W through its surface, '//text(from_discs, 4)// &
                  ' W from discs; temperatures '//text(minval(line), 4)//' to '// &
                  text(maxval(line), 4)//' K')
    call add_array(arrays, '/shaft/temperature', 'mixed SI', 'z [m], temperature [K] of '// &
                   'the shaft''s nodes', transpose(reshape([machine%shaft%z, line], &
                                                           [size(line), 2])))
  end subroutine add_machine_heat

  !> Whether a coordinate is one of the bearing's: tilts are, of all, though they may be held at 0.
  pure logical function is_written(journal, coordinate)
    type(journal_type), intent(in) :: journal !! in the bearing
    integer, intent(in) :: coordinate !! see `shaft_coordinates`
    is_written = coordinate >= first_tilt .or. any(journal%coordinate == coordinate)
  end function is_written

  !> The same as a line of the log.
  subroutine show_rows(number, journal, answer, log)
    integer, intent(in) :: number !! of the bearing
    type(journal_type), intent(in) :: journal
    type(bearing_answer_type), intent(in) :: answer
    type(run_log_type), intent(in) :: log
    character(len=:), allocatable :: words

    words = 'force ('//text(answer%force(1), 5)//', '//text(answer%force(ways), 5)//') N'
    if (any(journal%coordinate == axial_coordinate)) then
      words = 'axial force '//text(answer%force(axial_coordinate), 5)//' N, gap '// &
              text(-answer%place(axial_coordinate)*micrometres, 4)//' um'
    end if
    call log%line('bearing '//text(number)//'        film '// &
                  text(answer%minimum_gap*micrometres, 4)//' um, '//words//', tilt ('// &
                  text(answer%place(first_tilt)*microradians, 4)//', '// &
                  text(answer%place(first_tilt + 1)*microradians, 4)//') urad, '// &
                  text(answer%power_loss, 4)//' W')
  end subroutine show_rows
end module gfb_bearing_rows
