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
  use gfb_machine, only: journal_type
  implicit none (type, external)
  private
  public :: add_rows, show_rows, is_written

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
  end subroutine add_rows

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
