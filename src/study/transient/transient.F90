#include "gfb_petsc.h"
!> A shaft over time, from an equilibrium or a given position on.
module gfb_transient
  use gfb_kinds, only: wp
  use gfb_archive, only: archive_type
  use gfb_errors, only: error_type
  use gfb_quantity, only: quantity_type
  use gfb_results, only: add_result
  use gfb_run_log, only: run_log_type
  use gfb_signals, only: stop_agreed, stop_words
  use gfb_text, only: text
  use gfb_scene, only: scene_type
  use gfb_bearing_system, only: bearing_system_type
  use gfb_newton, only: newton_type, newton_report_type, forget_factors
  use gfb_transient_drive, only: drive_of, settings_of
  use gfb_transient_start, only: begin_transient
  use gfb_time_march, only: march_type, take_step, end_march, visit_past, rebuild_past
  use gfb_march_state, only: largest_way
  use gfb_case_file, only: case_array_type, add_arrays
  use gfb_reasons, only: reason_type, reason_no_answer, reason_not_reached, reason_stopped
  use gfb_run_context, only: run_context_type
  use gfb_transient_history, only: transient_history_type
  use gfb_orbit_record, only: plane_motion, tilt_motion
  use gfb_bearing_record, only: bearing_record_type
  use gfb_petsc_session, only: wall_time
  use gfb_foil_mass_choice, only: resume_momentum
  use gfb_bearing_restart, only: visit_answer_and_record
  use gfb_restart, only: restart_type, save_restart, read_restart, end_reading
  use gfb_transient_fields, only: keep_fields
  implicit none (type)
  private

  !> The way of a shaft.
  type, public :: transient_type
    type(march_type) :: march
    type(transient_history_type) :: history
    character(len=:), allocatable :: ending  !! why the time has ended before its end; empty: it has not
    character(len=:), allocatable :: lacking !! what was asked for and not reached; empty: nothing
    logical, private :: within = .false. !! the end is one that was asked for
  contains
    procedure :: run => run_transient
    procedure :: results
    procedure :: add_arrays => add_transient_arrays
    procedure, private :: look_for_limits
    procedure, private :: look_for_steady_orbit
    procedure, private :: change_of_orbit
    procedure, private :: judge_end
    procedure, private :: save
    procedure, private :: restore
    procedure, private :: visit
  end type transient_type

contains

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
    call begin_transient(scene, drive_of(scene), settings_of(scene), context%restart%goes_on, context%log, bearing, newton, self%march)
    call self%history%orbit%see(self%march)
    call self%history%add(self%march, bearing, newton)
    if (.not. context%restart%goes_on) then
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
        call take_step(march, bearing, newton, report)
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
          reason%detail = 'no step of time leads on from '//place_in_time(march)//': '//report%reason
        end if
        if (self%ending /= '') exit
        if (stop_agreed()) then
          reason%code = reason_stopped
          reason%detail = stop_words()//' at '//place_in_time(march)
          if (restart%may_be_written()) then
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
      if (reason%is_given() .and. reason%code /= reason_stopped) call log%tell(reason%words())
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

    call read_restart(restart, 'march', archive, error)
    if (allocated(error)) return
    call self%visit(archive, scene, bearing)
    call end_reading(restart, archive, error)
    if (.not. allocated(error)) call rebuild_past(bearing, self%march)
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

  !> Time and turns, in words.
  function place_in_time(march) result(words)
    type(march_type), intent(in) :: march
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
  function change_of_orbit(self) result(change)
    class(transient_type), intent(in) :: self
    real(wp) :: change
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
        if (transient%turns > 0.0_wp) self%lacking = text(transient%turns)//' turns'
        if (transient%duration > 0.0_wp) self%lacking = text(transient%duration)//' s'
        if (transient%speed_changes .and. march%time < march%drive%ramp) then
          self%lacking = self%lacking//', '//text(transient%final_speed_rpm)//' rpm'
        end if
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
    call add_arrays(arrays, self%history%arrays())
  end subroutine add_transient_arrays
end module gfb_transient
