#include "gfb_petsc.h"
!> A shaft over time, from an equilibrium or a given position on.
module gfb_transient
  use gfb_kinds, only: wp
  use gfb_archive, only: archive_type
  use gfb_petsc_session, only: wall_time
  use gfb_bearing_system, only: bearing_system_type
  use gfb_time_march, only: march_type, march_settings_type, begin_march, begin_rubbing, take_step, end_march, visit_past, rebuild_past, find_misfit
  use gfb_stage_march, only: take_step_by_stages
  use gfb_newton, only: newton_type, newton_report_type, forget_factors
  use gfb_case_file, only: case_array_type
  use gfb_transient_history, only: transient_history_type
  use gfb_orbit_record, only: plane_motion, tilt_motion
  use gfb_scene, only: scene_type
  use gfb_operation_case, only: angular_speed
  use gfb_motion_cases, only: duration_of, transient_case_type, method_esdirk4, chosen_steps
  use gfb_shaft_drive, only: shaft_drive_type
  use gfb_run_log, only: run_log_type
  use gfb_operating_point, only: operating_point_type
  use gfb_continuation, only: path_settings_type, path_report_type, follow_path
  use gfb_foil_mass_choice, only: choose_momentum, resume_momentum
  use gfb_grid_series, only: grid_series_type
  use gfb_result_set, only: result_grid_type, add_series_step
  use gfb_film_grid, only: add_film_grid
  use gfb_foil_grid, only: add_foil_grids
  use gfb_errors, only: error_type
  use gfb_quantity, only: quantity_type
  use gfb_result_names, only: add_result
  use gfb_signals, only: stop_agreed
  use gfb_text, only: text
  use gfb_march_state, only: largest_way
  use gfb_reasons, only: reason_type, reason_no_answer, reason_not_reached
  use gfb_run_context, only: run_context_type
  use gfb_bearing_record, only: bearing_record_type
  use gfb_bearing_restart, only: visit_answer_and_record
  use gfb_restart_file, only: restart_type, save_restart, read_restart, end_reading, refuse_restart
  implicit none (type)
  private
  public :: is_field_time, settings_of, time_lacking, place_in_time

  real(wp), parameter :: shortest = 0.01_wp !! step of the way there [1]

  real(wp), parameter :: round_off = 1.0e-9_wp !! of times over the interval [1]

  !> The way of a shaft.
  type, public :: transient_type
    type(march_type) :: march
    type(transient_history_type) :: history
    character(len=:), allocatable :: ending  !! why the time has ended before its end; empty: it has not
    character(len=:), allocatable :: lacking !! what was asked for and not reached; empty: nothing
    logical, private :: within = .false. !! the end is one that was asked for
  contains
    procedure :: run => run_transient, results, add_arrays => add_transient_arrays
    procedure, private :: look_for_limits, look_for_steady_orbit, change_of_orbit, judge_end, save
    procedure, private :: restore, visit
  end type transient_type

contains

  !> How the steps of a scene are chosen.
  pure function settings_of(scene) result(settings)
    type(scene_type), intent(in) :: scene !! of the bearing, with `&transient`
    type(march_settings_type) :: settings

    settings%steps_per_turn = scene%transient%steps_per_turn
    settings%by_stages = scene%transient%time_method == method_esdirk4
    settings%least_steps = chosen_steps(scene%transient%time_method)
    settings%tolerance = scene%transient%time_tolerance
    settings%unsolved = scene%transient%unsolved_part
    settings%damping = scene%foil_damping%foundation_damping
    settings%arm = scene%foil_damping%arm
    settings%loss_time = scene%foil_damping%loss_time()
    settings%end_time = duration_of(scene%transient, scene%operation)
  end function settings_of

  !> What drives the shaft of a scene: of a rotor that tilts what each of two bearings carries
  !> counts twice.
  pure function drive_of(scene) result(drive)
    type(scene_type), intent(in) :: scene !! with `&transient`
    type(shaft_drive_type) :: drive
    real(wp) :: bearings

    drive%bearing_distance = scene%rotor%distance_in_time
    bearings = merge(2.0_wp, 1.0_wp, drive%bearing_distance > 0.0_wp)
    associate (transient => scene%transient)
      drive%mass = bearings*scene%rotor%mass
      drive%transverse_inertia = scene%rotor%transverse_inertia
      drive%polar_inertia = scene%rotor%polar_inertia
      drive%load = bearings*scene%operation%load
      drive%speed = angular_speed(scene%operation%speed_rpm)
      drive%ramp = duration_of(transient, scene%operation)
      if (transient%ramp_time > 0.0_wp) drive%ramp = transient%ramp_time
      drive%acceleration = (angular_speed(transient%final_speed_rpm) - drive%speed)/drive%ramp
      drive%unbalance = bearings*scene%unbalance%static
      drive%unbalance_angle = scene%unbalance%angle
      drive%couple_unbalance = scene%unbalance%couple
      drive%couple_unbalance_angle = scene%unbalance%couple_angle
      drive%pulse = bearings*transient%pulse
      drive%couple_pulse = transient%couple_pulse
      drive%pulse_start = transient%pulse_start
      drive%pulse_length = transient%pulse_length
      drive%orbit_radius = transient%orbit_radius
      drive%orbit_frequency = transient%orbit_frequency
      if (size(transient%base_time) == 0) return
      drive%base_time = transient%base_time
      allocate (drive%base_acceleration(2, size(drive%base_time)), source=0.0_wp)
      if (size(transient%base_acceleration_x) > 0) then
        drive%base_acceleration(1, :) = transient%base_acceleration_x
      end if
      if (size(transient%base_acceleration_y) > 0) then
        drive%base_acceleration(2, :) = transient%base_acceleration_y
      end if
    end associate
  end function drive_of

  !> Begins at rest, or with what a restart file will overwrite.
  subroutine begin_transient(scene, drive, settings, continues, log, bearing, newton, march)
    type(scene_type), intent(in) :: scene !! with `&transient`
    type(shaft_drive_type), intent(in) :: drive !! what drives the shaft
    type(march_settings_type), intent(in) :: settings !! how steps are chosen
    logical, intent(in) :: continues !! a restart file has the rest
    type(run_log_type), intent(in) :: log !! shows what was chosen
    type(bearing_system_type), target, intent(inout) :: bearing !! at its steady state
    type(newton_type), target, intent(inout) :: newton !! its solver
    type(march_type), intent(out) :: march !! ready for its first step

    if (.not. continues) then
      call go_to_orbit(scene, log, bearing, newton)
      call choose_momentum(scene, log, bearing)
    end if
    call begin_rubbing(bearing, continues)
    call begin_march(drive, settings, bearing, march)
    if (scene%transient%orbit_radius > 0.0_wp) march%start%place(:2) = scene%operation%eccentricity
  end subroutine begin_transient

  !> Moves the sleeve and its steady film from the centre of the circle to the circle, along x.
  !>
  !> Where that has an end before, the first step of time is a jump from there.
  subroutine go_to_orbit(scene, log, bearing, newton)
    type(scene_type), intent(in) :: scene !! with `&transient`
    type(run_log_type), intent(in) :: log !! says where it cannot
    type(bearing_system_type), target, intent(inout) :: bearing !! at the centre
    type(newton_type), target, intent(inout) :: newton !! its solver
    type(operating_point_type) :: first
    type(path_report_type) :: report

    if (.not. scene%transient%orbit_radius > 0.0_wp) return
    first = bearing%point
    first%place(1) = first%place(1) + scene%transient%orbit_radius
    associate (solver => scene%solver)
      call follow_path(bearing, newton, first, 1.0_wp, &
                       path_settings_type(solver%maximum_load_steps, max(shortest, solver%smallest_load_step), solver%touch_down_gap), &
                       report)
    end associate
    if (.not. report%converged()) call log%line('the sleeve jumps to its orbit: no steady film was found on the way ('//report%reason()//')')
  end subroutine go_to_orbit

  !> Adds the present film and foils to the series: at the beginning, and by the first step that
  !> reaches each chosen time.
  subroutine keep_fields(scene, march, bearing, series)
    type(scene_type), intent(in) :: scene !! with `&transient`
    type(march_type), intent(in) :: march !! at the beginning or after a step
    type(bearing_system_type), intent(in) :: bearing !! at the same state
    type(grid_series_type), intent(inout) :: series !! may get a step
    type(result_grid_type), allocatable :: grids(:)

    if (.not. is_field_time(scene%transient, march)) return
    allocate (grids(0))
    call add_film_grid(bearing, scene%output, grids)
    if (size(grids) == 0) return ! no field is asked for
    call add_foil_grids(bearing, grids)
    call add_series_step(series, 'time', 's', march%time, grids)
  end subroutine keep_fields

  !> Whether fields are kept at the present state: at the beginning, and by the first step that reaches each chosen time.
  pure logical function is_field_time(transient, march) result(is)
    type(transient_case_type), intent(in) :: transient !! what `&transient` asks for
    type(march_type), intent(in) :: march !! at the beginning or after a step

    is = transient%field_interval > 0.0_wp
    if (.not. is) return
    is = march%steps == 0 .and. .not. transient%field_start > 0.0_wp
    if (march%steps > 0) is = passed(march%time) /= passed(march%time - march%step)

  contains

    !> Chosen times until this one.
    pure integer function passed(time) result(times)
      real(wp), intent(in) :: time !! [s]
      real(wp) :: intervals

      intervals = (time - transient%field_start)/transient%field_interval
      times = max(0, floor(intervals + round_off) + 1)
    end function passed
  end function is_field_time

  !> Follows the shaft from an equilibrium, or a given position; or on from where a restart file has left it.
  !>
  !> Fails when that file is damaged.
  subroutine run_transient(self, scene, context, bearing, newton, record, reason, error)
    class(transient_type), intent(inout) :: self !! its way, from nothing
    type(scene_type), intent(in) :: scene !! with `&transient`
    type(run_context_type), intent(in) :: context !! of the run
    type(bearing_system_type), target, intent(inout) :: bearing !! where the shaft begins; left at its end
    type(newton_type), target, intent(inout) :: newton !! its solver
    type(bearing_record_type), intent(inout) :: record !! of where the shaft begins, for restart files; gets fields
    type(reason_type), intent(inout) :: reason !! why the time has no end
    type(error_type), allocatable, intent(out) :: error !! why it failed

    call context%log%heading('time')
    newton%log%verbose = .false.
    call begin_transient(scene, drive_of(scene), settings_of(scene), context%restart%continues, context%log, bearing, newton, self%march)
    call self%history%orbit%see(self%march)
    call self%history%add(self%march, bearing, newton)
    if (.not. context%restart%continues) then
      call keep_fields(scene, self%march, bearing, record%series)
    else
      call self%restore(scene, context%restart, bearing, error)
      if (.not. allocated(error)) call context%log%line('restart: resumed from '//place_in_time(self%march))
    end if
    if (.not. allocated(error)) call follow_shaft(self, scene, context, bearing, newton, record, reason)
    call end_march(self%march, bearing)
  end subroutine run_transient

  !> Steps until the time is over, or something has happened.
  subroutine follow_shaft(self, scene, context, bearing, newton, record, reason)
    type(transient_type), intent(inout) :: self
    type(scene_type), intent(in) :: scene
    type(run_context_type), intent(in) :: context
    type(bearing_system_type), target, intent(inout) :: bearing
    type(newton_type), target, intent(inout) :: newton
    type(bearing_record_type), intent(inout) :: record
    type(reason_type), intent(inout) :: reason
    type(newton_report_type) :: report
    type(restart_type) :: restart
    real(wp) :: from
    logical :: due

    self%ending = ''
    self%lacking = ''
    restart = context%restart
    from = self%march%time
    call context%log%is_within(place_in_time(self%march), 0.0_wp)
    associate (march => self%march, every => scene%transient%output_every, log => context%log)
      do while (march%time < march%settings%end_time)
        if (march%settings%by_stages) then
          call take_step_by_stages(march, bearing, newton, report)
        else
          call take_step(march, bearing, newton, report)
        end if
        if (report%converged) then
          call self%history%see(march, bearing)
          call keep_fields(scene, march, bearing, record%series)
          call self%look_for_limits(scene)
          if (self%ending == '') call self%look_for_steady_orbit(scene)
          if (modulo(march%steps, every) == 0 .or. march%time >= march%settings%end_time .or. self%ending /= '') then
            call self%history%add(march, bearing, newton)
          end if
        else
          reason%code = reason_no_answer
          reason%detail = 'no time step converges from '//place_in_time(march)//': '//report%reason
        end if
        if (self%ending /= '') exit
        if (stop_agreed()) then
          call reason%stopped(' at '//place_in_time(march))
          if (restart%may_be_written() .and. march%steps > 0) then ! before the first step there is no past to go on from
            call self%save(scene, restart, log, bearing, newton, record)
            call restart%tell(log, reason%detail)
          end if
        end if
        if (reason%is_given()) exit
        due = restart%is_due(march%steps)
        if (due .and. march%time < march%settings%end_time) then
          call self%save(scene, restart, log, bearing, newton, record)
        end if
        call log%is_within(place_in_time(march), (march%time - from)/(march%settings%end_time - from))
      end do
      call log%is_within('')
      if (self%ending /= '') call log%line(self%ending//' at '//place_in_time(march))
      call self%judge_end(scene, reason)
      if (reason%is_given() .and. .not. reason%is_stop()) call log%tell(reason%words())
      call log%line(text(march%steps)//' steps, '//text(march%rejections)//' of them taken again shorter; smallest film '// &
                    text(self%history%smallest_gap*1.0e6_wp, 4)//' um')
      if (self%history%lacks_spectrum()) then
        call log%line('no spectrum: less than two lines a turn, with output_every = '//text(every))
      end if
      if (allocated(record%series%value)) then
        call log%line('film and foils are stored at '//text(size(record%series%value))//' times')
      end if
    end associate
  end subroutine follow_shaft

  !> Writes the restart file after a step: the steady state before, the last three states, and the lines so far.
  subroutine save(self, scene, restart, log, bearing, newton, record)
    class(transient_type), intent(inout) :: self !! its way
    type(scene_type), intent(in) :: scene !! what is asked for
    type(restart_type), intent(in) :: restart !! name and origin of the file
    type(run_log_type), intent(in) :: log !! where lines go
    type(bearing_system_type), intent(inout) :: bearing !! at the newest state
    type(newton_type), intent(inout) :: newton !! its solver; loses its factors where files are asked for
    type(bearing_record_type), intent(inout) :: record !! of the steady state before
    type(archive_type) :: archive(2)

    if (restart%every > 0) call forget_factors(newton)
    archive(1)%name = 'bearing'
    call visit_answer_and_record(archive(1), bearing, newton, record)
    archive(2)%name = 'march'
    call self%visit(archive(2), scene, bearing)
    call save_restart(scene, restart, log, self%march%steps, wall_time() - record%begun, archive)
  end subroutine save

  !> Puts a march that has begun anew where the file says; the bearing stands there already (`restore_bearing`).
  !>
  !> Fails when the file is damaged.
  subroutine restore(self, scene, restart, bearing, error)
    class(transient_type), intent(inout) :: self !! its way; gets its past and the lines so far
    type(scene_type), intent(in) :: scene !! what is asked for
    type(restart_type), intent(in) :: restart !! the file to resume from
    type(bearing_system_type), intent(inout) :: bearing !! at the newest state
    type(error_type), allocatable, intent(out) :: error !! why it failed
    type(archive_type) :: archive
    character(len=:), allocatable :: why

    call read_restart(restart, 'march', archive, error)
    if (allocated(error)) return
    call self%visit(archive, scene, bearing)
    call end_reading(restart, archive, error)
    if (allocated(error)) return
    call find_misfit(bearing, self%march, why)
    if (why == '') why = self%history%misfit(self%march, may_touch=scene%shaft_contact%present)
    if (why == '' .and. self%march%steps /= restart%step) why = 'the number of steps'
    if (why /= '') then
      call refuse_restart(restart, 'the file is damaged at /march: '//why, error)
    else
      call rebuild_past(bearing, self%march)
    end if
  end subroutine restore

  !> Saves or restores the march and its lines; foils get the mass that they had.
  subroutine visit(self, archive, scene, bearing)
    class(transient_type), intent(inout) :: self !! its way
    type(archive_type), intent(inout) :: archive !! that saves or restores
    type(scene_type), intent(in) :: scene !! with `&transient`
    type(bearing_system_type), intent(inout) :: bearing !! at the newest state
    logical :: has_mass

    has_mass = bearing%momentum%present
    call archive%visit('foil_mass', has_mass)
    if (has_mass .and. .not. archive%saves) call resume_momentum(scene, bearing)
    call visit_past(archive, bearing, self%march)
    call self%history%visit(archive)
  end subroutine visit

  !> What was asked for of a time that has ended before its end, in words.
  function time_lacking(transient, march) result(words)
    type(transient_case_type), intent(in) :: transient !! what `&transient` asks for
    type(march_type), intent(in) :: march !! where it has ended
    character(len=:), allocatable :: words

    words = ''
    if (transient%turns > 0.0_wp) words = text(transient%turns)//' turns'
    if (transient%duration > 0.0_wp) words = text(transient%duration)//' s'
    if (transient%speed_changes .and. march%time < march%drive%ramp) words = words//', '//text(transient%final_speed_rpm)//' rpm'
  end function time_lacking

  !> Time and turns, in words.
  function place_in_time(march) result(words)
    type(march_type), intent(in) :: march !! that is there
    character(len=:), allocatable :: words
    words = 'time '//text(march%time, 6)//' s, turn '//text(march%turns(), 5)
  end function place_in_time

  !> Whether the film has closed, or the shaft has left its place: after every step.
  subroutine look_for_limits(self, scene)
    class(transient_type), intent(inout) :: self
    type(scene_type), intent(in) :: scene

    associate (march => self%march, history => self%history, transient => scene%transient)
      if (history%smallest_gap < scene%solver%touch_down_gap .and. .not. scene%shaft_contact%present) then
        self%ending = 'the shaft touches down'
      else if (transient%largest_orbit > 0.0_wp) then
        if (largest_way(march, march%place(:, 1) - march%first_place) > transient%largest_orbit) then
          self%ending = 'the orbit has grown beyond its limit'
          self%within = .true.
        end if
      end if
    end associate
  end subroutine look_for_limits

  !> Whether the orbit stays as it is, by all steps of the last two turns, while nothing changes what drives the shaft.
  subroutine look_for_steady_orbit(self, scene)
    class(transient_type), intent(inout) :: self
    type(scene_type), intent(in) :: scene

    if (.not. scene%transient%steady_tolerance > 0.0_wp) return
    associate (turn => self%march%turns(), orbit => self%history%orbit)
      if (turn < 2.0_wp) return
      if (orbit%turn_began(turn - 2.0_wp) < self%march%drive%settled()) return
    end associate
    if (self%change_of_orbit() > scene%transient%steady_tolerance*scene%bearing%clearance) return
    self%ending = 'the orbit is steady'
    self%within = .true.
  end subroutine look_for_steady_orbit

  !> By how much the last two turns differ [m].
  real(wp) function change_of_orbit(self) result(change)
    class(transient_type), intent(in) :: self
    real(wp), allocatable :: now(:), before(:)

    associate (turn => self%march%turns(), orbit => self%history%orbit)
      now = orbit%extents(turn - 1.0_wp, turn)
      before = orbit%extents(turn - 2.0_wp, turn - 1.0_wp)
    end associate
    change = maxval(abs(now - before))
  end function change_of_orbit

  !> Whether what was asked for is reached: the time to its end, or an end that the scene allows; and a steady orbit where it
  !> has a tolerance.
  subroutine judge_end(self, scene, reason)
    class(transient_type), intent(inout) :: self
    type(scene_type), intent(in) :: scene
    type(reason_type), intent(inout) :: reason !! given where there was one before, or something is not reached
    character(len=:), allocatable :: why

    if (self%within) return
    why = self%ending
    associate (march => self%march, transient => scene%transient)
      if (march%time < march%settings%end_time) then
        self%lacking = time_lacking(transient, march)
        if (why /= '') then
          why = why//' at '//place_in_time(march)//', where the smallest film is below touch_down_gap = '// &
                text(scene%solver%touch_down_gap, 3)//' m'
        end if
      end if
      if (transient%steady_tolerance > 0.0_wp) then
        if (self%lacking /= '') self%lacking = self%lacking//', '
        self%lacking = self%lacking//'a steady orbit'
        if (why == '') why = 'the time is over'
        if (march%turns() >= 2.0_wp) then
          why = why//'; the last two turns differ by '//text(self%change_of_orbit()/scene%bearing%clearance, 3)//' of the clearance'
        end if
      end if
    end associate
    if (self%lacking == '' .or. reason%is_given()) return
    reason%code = reason_not_reached
    reason%detail = 'not reached: '//self%lacking//': '//why
  end subroutine judge_end

  !> What the summary says of the whole time.
  function results(self) result(found)
    class(transient_type), intent(in) :: self !! its way
    type(quantity_type), allocatable :: found(:)
    real(wp), allocatable :: box(:)
    integer :: i

    associate (march => self%march, orbit => self%history%orbit)
      box = orbit%extents(march%turns() - 1.0_wp, march%turns(), plane_motion)
      call add_result(found, 'time', march%time)
      call add_result(found, 'turns', march%turns())
      call add_result(found, 'time_steps', march%steps)
      call add_result(found, 'orbit_x', box(2) - box(1))
      call add_result(found, 'orbit_y', box(4) - box(3))
      if (self%history%tilts) then
        box = orbit%extents(march%turns() - 1.0_wp, march%turns())
        do i = 1, 2
          call add_result(found, 'orbit_x_'//text(i), box(4*i - 2) - box(4*i - 3))
          call add_result(found, 'orbit_y_'//text(i), box(4*i) - box(4*i - 1))
        end do
        box = orbit%extents(march%turns() - 1.0_wp, march%turns(), tilt_motion)
        call add_result(found, 'orbit_tilt_x', box(2) - box(1))
        call add_result(found, 'orbit_tilt_y', box(4) - box(3))
      end if
      call add_result(found, 'minimum_gap_over_time', self%history%smallest_gap)
      if (self%ending /= '') call add_result(found, 'ending', self%ending)
      if (self%lacking /= '') call add_result(found, 'not_reached', self%lacking)
    end associate
  end function results

  !> Adds the history of the time to what the result file gets.
  subroutine add_transient_arrays(self, arrays)
    class(transient_type), intent(in) :: self !! its way
    type(case_array_type), allocatable, intent(inout) :: arrays(:) !! get a dataset a name
    call self%history%add_arrays(arrays)
  end subroutine add_transient_arrays
end module gfb_transient
