!> What is kept of a bearing's answers: a row of the history and the contacts, for each.
module gfb_bearing_record
  use gfb_kinds, only: wp
  use gfb_archive, only: archive_type
  use gfb_quantity, only: quantity_type, add_quantity, number_quantity
  use gfb_result_names, only: add_result, result_unit, result_meaning, is_of_heat
  use gfb_sweep_case, only: sweep_case_type, sweep_eccentricity_x, sweep_eccentricity_y, &
                            sweep_keys, parameter_words
  use gfb_bearing_system, only: bearing_system_type
  use gfb_bearing_answer, only: bearing_answer_type, bearing_answer
  use gfb_newton, only: newton_type
  use gfb_case_file, only: history_row_type, visit_rows
  use gfb_grid_series, only: grid_series_type, visit_series, is_whole
  use gfb_bearing_summary, only: answer_quantities, add_counts
  use gfb_contact_record, only: contact_record_type, record_foil_contacts
  use gfb_dynamics_record, only: dynamics_record_type, visit_dynamics
  use gfb_tilt_response, only: tilt_response_type, row_quantities, visit_response
  use gfb_scene, only: scene_type ! here: before others GNU Fortran 12 falls over it
  implicit none (type, external)
  private
  public :: add_row, sweep_name, sweep_unit
  public :: visit_record

  !> Answers of a scene, in the order in which they were found.
  type, public :: bearing_record_type
    type(history_row_type), allocatable :: history(:)
    type(contact_record_type) :: contacts
    type(quantity_type), allocatable :: judged(:) !! what else is known of the last answer
    type(quantity_type), allocatable :: limit(:) !! where it is the limit that was asked for
    logical :: at_fold = .false. !! that answer is the end of a branch in a fold, before a limit
    type(tilt_response_type) :: tilted
    type(dynamics_record_type) :: dynamics !! stiffness, damping, rotor
    type(grid_series_type) :: series !! film and foils at the points of a sweep
    type(bearing_answer_type), allocatable :: answer !! of the last row
    real(wp) :: begun = 0.0_wp !! when the first point was there [s]
  contains
    procedure :: move_on
  end type bearing_record_type

  !> What is known of the point where a motion begins, and still of interest at its end.
  character(len=*), parameter :: of_first_point(2) = [character(len=13) :: 'critical_mass', &
                                                      'whirl_ratio']

contains

  !> Adds the present state to the record.
  subroutine add_row(scene, bearing, newton, converged, record, value, fold, branch)
    type(scene_type), intent(in) :: scene !! what is asked for
    type(bearing_system_type), intent(in) :: bearing !! at the state
    type(newton_type), intent(in) :: newton !! its solver, with the counts so far
    logical, intent(in) :: converged !! the state is an answer
    type(bearing_record_type), intent(inout) :: record !! gets a row, and the contacts
    real(wp), intent(in), optional :: value !! of the sweep's parameter, in its unit
    logical, intent(in), optional :: fold   !! the sweep's parameter turns back there
    integer, intent(in), optional :: branch !! number of the equilibrium among several
    type(history_row_type) :: row

    if (present(value)) then
      select case (scene%sweep%parameter)
      case (sweep_eccentricity_x, sweep_eccentricity_y)
        continue ! the answer has them anyway
      case (sweep_keys)
        call add_quantity(row%quantity, number_quantity( &
                          'key_value', value, scene%sweep%unit, &
                          result_meaning('key_value', scene%sweep%keys)))
      case default
        call add_result(row%quantity, sweep_name(scene%sweep), value)
      end select
    end if
    if (present(fold)) call add_result(row%quantity, 'fold', fold)
    if (present(branch)) call add_result(row%quantity, 'branch', branch)
    record%answer = bearing_answer(bearing, stresses=.true.)
    call add_quantity(row%quantity, answer_quantities( &
                      trim(scene%general%asked%word), converged, record%answer, bearing%clearance, &
                      bearing%force_scale()))
    call add_quantity(row%quantity, row_quantities(record%tilted))
    if (allocated(record%judged)) call add_quantity(row%quantity, record%judged)
    call add_counts(newton%iterations, newton%factorizations, row%quantity)
    if (.not. allocated(record%history)) allocate (record%history(0))
    record%history = [record%history, row]
    call record_foil_contacts(bearing, size(record%history), &
                              max(1, size(scene%sweep%values)), record%contacts)
  end subroutine add_row

  !> The word for what a sweep changes.
  pure function sweep_name(sweep) result(name)
    type(sweep_case_type), intent(in) :: sweep !! with its parameter
    character(len=:), allocatable :: name

    if (sweep%parameter == sweep_keys) then
      name = sweep%keys
    else
      name = trim(parameter_words(sweep%parameter))
    end if
  end function sweep_name

  !> Its unit.
  pure function sweep_unit(sweep) result(unit)
    type(sweep_case_type), intent(in) :: sweep !! with its parameter
    character(len=:), allocatable :: unit

    if (sweep%parameter == sweep_keys) then
      unit = sweep%unit
    else
      unit = result_unit(sweep_name(sweep))
    end if
  end function sweep_unit

  !> The shaft has moved on from the one answer: what is known of its motion stands in the place
  !> of what was known of that.
  subroutine move_on(self, found)
    class(bearing_record_type), intent(inout) :: self !! of the answer
    type(quantity_type), intent(in) :: found(:) !! of the motion
    type(quantity_type), allocatable :: first(:)
    integer :: i

    call move_alloc(self%judged, first)
    self%judged = found
    do i = 1, size(first)
      if (any(of_first_point == first(i)%name)) call add_quantity(self%judged, first(i))
    end do
    if (size(self%history) == 0) return
    associate (begin => self%history(1)%quantity)
      do i = 1, size(begin)
        if (is_of_heat(begin(i)%name)) call add_quantity(self%judged, begin(i))
      end do
    end associate
  end subroutine move_on

  !> Saves or restores a record but for the contacts and the clock.
  pure subroutine visit_record(archive, record)
    type(archive_type), intent(inout) :: archive !! that saves or restores
    type(bearing_record_type), intent(inout) :: record !! written where the archive restores
    type(history_row_type), allocatable :: judged(:)

    call archive%part('history')
    call visit_rows(archive, record%history)
    allocate (judged(1))
    if (allocated(record%judged)) judged(1)%quantity = record%judged
    call archive%part('judged')
    call visit_rows(archive, judged)
    call archive%part('tilted')
    call visit_response(archive, record%tilted)
    call archive%part('dynamics')
    call visit_dynamics(archive, record%dynamics)
    call archive%part('series')
    call visit_series(archive, record%series)
    if (archive%saves) return
    call archive%require(size(judged) == 1, 'the row of what else is known')
    if (archive%failed) return
    call archive%require(is_whole(record%series), 'the series of surfaces')
    record%judged = judged(1)%quantity
  end subroutine visit_record
end module gfb_bearing_record
