#include "gfb_petsc.h"
!> An answer of a scene goes into the record, with all that is asked of it.
module gfb_answer_record
  use petscmat
  use gfb_kinds, only: wp
  use gfb_quantity, only: quantity_type, add_quantity
  use gfb_text, only: text
  use gfb_run_log, only: run_log_type
  use gfb_scene, only: scene_type
  use gfb_bearing_system, only: bearing_system_type
  use gfb_newton, only: newton_type
  use gfb_tilt_response, only: begin_tilt, measure_tilt
  use gfb_bearing_record, only: bearing_record_type, add_row, sweep_name, sweep_unit
  use gfb_film_grid, only: add_film_grid
  use gfb_foil_output, only: add_foil_grids
  use gfb_grid_series, only: grid_series_type
  use gfb_result_set, only: result_grid_type, add_series_step
  use gfb_sweep_case, only: sweep_keys
  use gfb_answer_judgement, only: judge_answer
  use gfb_rotor_modes, only: rotor_answer_type
  use gfb_dynamics_record, only: dynamics_record_type
  use gfb_dynamics, only: find_dynamics, opposite_builder
  use gfb_rotor_report, only: report_rotor
  use gfb_sensitivity, only: keep_tangent, changed_evaluation
  use gfb_sensitivity_report, only: add_sensitivities
  implicit none (type)
  private
  public :: record_single, record_swept, fix_shaft, builders_type

  !> What makes further bearings of an answer's scene.
  type :: builders_type
    procedure(opposite_builder), pointer, nopass :: opposite => null() !! that of tilts, for vibrations
    procedure(changed_evaluation), pointer, nopass :: changed => null() !! its equations with another value of a key
  end type builders_type

contains

  !> Records the one answer of a scene without a sweep, or the state where the search for it has ended.
  subroutine record_single(scene, log, bearing, newton, build, converged, record)
    type(scene_type), intent(in) :: scene !! what is asked for
    type(run_log_type), intent(in) :: log !! where lines go
    type(bearing_system_type), intent(inout) :: bearing !! at the state
    type(newton_type), intent(inout) :: newton !! its solver
    type(builders_type), intent(in) :: build !! of bearings like it
    logical, intent(in) :: converged !! the state is an answer
    type(bearing_record_type), intent(inout) :: record !! gets the row
    type(quantity_type), allocatable :: vibrations(:)

    if (converged) call judge_and_derive(scene, log, bearing, newton, build, record%judged)
    if (record%at_fold) call forget_sign(record%judged)
    if (converged .and. allocated(record%limit)) call add_quantity(record%judged, record%limit)
    if (scene%sensitivity%present .and. .not. converged) then
      call log%line('no sensitivities: they are those of an answer, and there is none')
    end if
    call add_row(scene, bearing, newton, converged, record)
    if (.not. scene%dynamics%present) return
    if (converged) then
      call vibrate(scene, log, bearing, newton, build%opposite, record%dynamics, vibrations)
      call add_quantity(record%judged, vibrations)
    else
      call log%line('no stiffness and damping: they are those of an answer, and there is none')
    end if
  end subroutine record_single

  !> Records the answer at a value of the sweep.
  subroutine record_swept(scene, here, log, bearing, newton, build, record, value, fold)
    type(scene_type), intent(in) :: scene !! what is asked for
    type(scene_type), intent(in) :: here  !! the same with the value in its keys, where the sweep changes keys
    type(run_log_type), intent(in) :: log !! where lines go
    type(bearing_system_type), intent(inout) :: bearing !! at the answer
    type(newton_type), intent(inout) :: newton !! its solver
    type(builders_type), intent(in) :: build !! of bearings like it
    type(bearing_record_type), intent(inout) :: record !! gets the row
    real(wp), intent(in) :: value !! of the sweep, in its unit
    logical, intent(in), optional :: fold !! of a branch that is followed: the value turns back there
    type(quantity_type), allocatable :: vibrations(:)
    logical :: turns

    call measure_tilt(scene, value, bearing, newton, record%tilted)
    if (scene%dynamics%present) call vibrate(here, log, bearing, newton, build%opposite, record%dynamics, vibrations)
    ! The last of the factors, for the next answer.
    call judge_and_derive(here, log, bearing, newton, build, record%judged, value)
    turns = record%at_fold
    if (present(fold)) turns = turns .or. fold
    if (turns) call forget_sign(record%judged)
    if (allocated(vibrations)) call add_quantity(record%judged, vibrations)
    if (allocated(record%limit)) call add_quantity(record%judged, record%limit)
    call add_row(scene, bearing, newton, .true., record, value, fold)
    call add_fields(scene, bearing, record%series, value)
  end subroutine record_swept

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

  !> Judges an answer and, where that is asked for, derives its numbers by keys, with the factors of the judgement.
  subroutine judge_and_derive(scene, log, bearing, newton, build, judged, value)
    type(scene_type), intent(in) :: scene
    type(run_log_type), intent(in) :: log
    type(bearing_system_type), intent(inout) :: bearing
    type(newton_type), intent(inout) :: newton
    type(builders_type), intent(in) :: build
    type(quantity_type), allocatable, intent(out) :: judged(:) !! what is known of the answer
    real(wp), intent(in), optional :: value !! of the sweep, in its unit
    Mat :: tangent

    if (scene%sensitivity%present) call keep_tangent(bearing, tangent)
    call judge_answer(scene, log, bearing, newton, judged)
    if (.not. scene%sensitivity%present) return
    call add_sensitivities(scene, log, bearing, newton, tangent, build%changed, judged, value)
  end subroutine judge_and_derive

  !> At a fold the determinant of the equations has no sign: it changes there.
  pure subroutine forget_sign(judged)
    type(quantity_type), intent(inout) :: judged(:)
    integer :: i

    do i = 1, size(judged)
      if (judged(i)%name == 'determinant_sign') judged(i)%number = 0.0_wp
    end do
  end subroutine forget_sign

  !> Small vibrations about an answer.
  subroutine vibrate(scene, log, bearing, newton, build, record, found)
    type(scene_type), intent(in) :: scene
    type(run_log_type), intent(in) :: log
    type(bearing_system_type), intent(inout) :: bearing
    type(newton_type), intent(inout) :: newton
    procedure(opposite_builder) :: build
    type(dynamics_record_type), intent(inout) :: record
    type(quantity_type), allocatable, intent(out) :: found(:) !! what the summary and the history say of them
    type(rotor_answer_type) :: rotor

    call find_dynamics(scene, log, bearing, newton, build, record, found, rotor)
    if (.not. allocated(rotor%mode)) return
    call report_rotor(log, bearing%point%speed, scene%sweep%present, scene%rotor%mass, rotor, found, &
                      record%point(size(record%point))%mode)
  end subroutine vibrate

  !> Fixes the shaft at its equilibrium for the points of a sweep, and measures what they are compared with.
  subroutine fix_shaft(scene, log, bearing, newton, record)
    type(scene_type), intent(in) :: scene !! whose sweep asks for it
    type(run_log_type), intent(in) :: log !! where lines go
    type(bearing_system_type), intent(inout) :: bearing !! at its equilibrium
    type(newton_type), intent(inout) :: newton !! its solver
    type(bearing_record_type), intent(inout) :: record !! gets the torque without tilt
    real(wp), parameter :: micrometres = 1.0e6_wp ! in a metre

    if (scene%sweep%friction_memory) call bearing%commit() ! the load was the first path of the foils
    bearing%point%eccentricity = bearing%eccentricity()
    bearing%shaft_fixed = .true.
    call log%line('shaft fixed at ('//text(bearing%point%eccentricity(1)*micrometres, 5)//', '// &
                  text(bearing%point%eccentricity(2)*micrometres, 5)//') um')
    call begin_tilt(scene, bearing, newton, record%tilted)
  end subroutine fix_shaft
end module gfb_answer_record
