#include "gfb_petsc.h"
!> An answer of a scene goes into the record, with all that is asked of it.
module gfb_answer_record
  use gfb_kinds, only: wp
  use gfb_units, only: micrometres
  use gfb_quantity, only: quantity_type, add_quantity
  use gfb_result_names, only: find_result
  use gfb_result_table, only: result_type
  use gfb_text, only: text
  use gfb_film_surface, only: translations
  use gfb_scene, only: scene_type
  use gfb_sweep_case, only: sweep_keys
  use gfb_bearing_system, only: bearing_system_type
  use gfb_tilt_response, only: begin_tilt, measure_tilt
  use gfb_bearing_record, only: add_row, sweep_name, sweep_unit
  use gfb_film_grid, only: add_film_grid
  use gfb_foil_grid, only: add_foil_grids
  use gfb_grid_series, only: grid_series_type
  use gfb_result_set, only: result_grid_type, add_series_step
  use gfb_answer_judgement, only: judge_and_derive
  use gfb_dynamics, only: find_dynamics
  use gfb_whirl, only: whirl_type
  use gfb_study_cases, only: derives_vibrations
  use gfb_bearing_solution, only: bearing_solution_type
  implicit none (type, external)
  private
  public :: record_answer, record_last_state, fix_shaft

contains

  !> Records the present answer: at a value of the sweep, or the one answer of a scene without a sweep.
  subroutine record_answer(solution, value, fold)
    type(bearing_solution_type), intent(inout) :: solution !! gets the row
    real(wp), intent(in), optional :: value !! of the sweep, in its unit
    logical, intent(in), optional :: fold !! of a branch that is followed: the value turns back there
    type(quantity_type), allocatable :: vibrations(:)
    type(whirl_type) :: whirl
    logical :: turns, vibrates_first

    associate (scene => solution%scene, here => solution%here, log => solution%context%log, &
               bearing => solution%bearing, newton => solution%newton, record => solution%record)
      if (present(value)) call measure_tilt(scene, value, bearing, newton, record%tilted)
      vibrates_first = present(value) .or. derives_vibrations(here%sensitivity)
      if (vibrates_first) call find_dynamics(here, log, bearing, newton, record%dynamics, vibrations, whirl)
      ! The last of the factors, for the next answer.
      call judge_and_derive(here, log, bearing, newton, record%judged, whirl, value)
      turns = record%at_fold
      if (present(fold)) turns = turns .or. fold
      if (turns) call change_signs(record%judged)
      if (allocated(vibrations)) call add_quantity(record%judged, vibrations)
      if (allocated(record%limit)) call add_quantity(record%judged, record%limit)
      call add_row(scene, bearing, newton, .true., record, value, fold)
      if (present(value)) call add_fields(scene, bearing, record%series, value)
      if (.not. vibrates_first) then
        call find_dynamics(here, log, bearing, newton, record%dynamics, vibrations, whirl)
        if (allocated(vibrations)) call add_quantity(record%judged, vibrations)
      end if
    end associate
  end subroutine record_answer

  !> At a fold some numbers change their signs: factors there give no digit of them.
  pure subroutine change_signs(judged)
    type(quantity_type), intent(inout) :: judged(:) !! of the answer at the fold
    type(result_type) :: row
    integer :: i

    do i = 1, size(judged)
      call find_result(judged(i)%name, row)
      if (row%changes_sign) judged(i)%number = 0.0_wp
    end do
  end subroutine change_signs

  !> Records the state where the search for the one answer has ended.
  subroutine record_last_state(solution)
    type(bearing_solution_type), intent(inout) :: solution !! gets the row

    associate (scene => solution%scene, log => solution%context%log)
      if (scene%sensitivity%present) call log%line('no sensitivities: they are those of an answer, and there is none')
      call add_row(scene, solution%bearing, solution%newton, .false., solution%record)
      if (scene%dynamics%present) call log%line('no stiffness and damping: they are those of an answer, and there is none')
    end associate
  end subroutine record_last_state

  !> Fixes the shaft at its equilibrium for the points of a sweep, and measures what they are compared with.
  subroutine fix_shaft(solution)
    type(bearing_solution_type), intent(inout) :: solution !! at its equilibrium; its record gets the torque without tilt

    associate (scene => solution%scene, bearing => solution%bearing)
      if (scene%sweep%friction_memory) call bearing%commit() ! the load was the first path of the foils
      associate (place => bearing%shaft_place())
        bearing%point%place(:translations) = place(:translations)
      end associate
      bearing%shaft_fixed = .true.
      call solution%context%log%line('shaft fixed at ('//text(bearing%point%place(1)*micrometres, 5)//', '// &
                                     text(bearing%point%place(2)*micrometres, 5)//') um')
      call begin_tilt(scene, bearing, solution%newton, solution%record%tilted)
    end associate
  end subroutine fix_shaft

  !> Adds film and foils of an answer to the series of the sweep, where the scene asks for fields.
  subroutine add_fields(scene, bearing, series, value)
    type(scene_type), intent(in) :: scene
    type(bearing_system_type), intent(in) :: bearing
    type(grid_series_type), intent(inout) :: series
    real(wp), intent(in) :: value !! of the sweep, in its unit
    type(result_grid_type), allocatable :: grids(:)
    character(len=:), allocatable :: name

    associate (output => scene%output, sweep => scene%sweep)
      if (.not. (output%pressure .or. output%gap .or. output%deflection)) return
      allocate (grids(0))
      call add_film_grid(bearing, output, grids)
      call add_foil_grids(bearing, grids)
      name = 'key_value'
      if (sweep%parameter /= sweep_keys) name = sweep_name(sweep)
      call add_series_step(series, name, sweep_unit(sweep), value, grids)
    end associate
  end subroutine add_fields
end module gfb_answer_record
