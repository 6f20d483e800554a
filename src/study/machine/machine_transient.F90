#include "gfb_petsc.h"
!> A machine over time, from its equilibrium on.
module gfb_machine_transient
  use gfb_kinds, only: wp
  use gfb_archive, only: archive_type
  use gfb_text, only: text
  use gfb_errors, only: error_type
  use gfb_units, only: micrometres
  use gfb_petsc_session, only: wall_time
  use gfb_run_log, only: run_log_type
  use gfb_run_context, only: run_context_type
  use gfb_scene, only: scene_type
  use gfb_motion_cases, only: duration_of
  use gfb_signals, only: stop_agreed
  use gfb_reasons, only: reason_type, reason_no_answer, reason_not_reached
  use gfb_quantity, only: quantity_type
  use gfb_result_names, only: add_result
  use gfb_result_set, only: result_grid_type, add_series_step
  use gfb_grid_series, only: grid_series_type, visit_series, is_whole
  use gfb_restart_file, only: restart_type, save_restart, read_restart, end_reading, refuse_restart
  use gfb_bearing_restart, only: visit_answer_and_record
  use gfb_foil_mass_choice, only: choose_momentum, resume_momentum
  use gfb_newton, only: forget_factors
  use gfb_transient, only: is_field_time, settings_of, time_lacking, place_in_time
  use gfb_held_shaft, only: free_motions
  use gfb_machine, only: machine_type
  use gfb_machine_drive, only: machine_drive_type, machine_drive
  use gfb_machine_equilibrium, only: machine_bearing_type, machine_equilibrium_type
  use gfb_march_state, only: march_settings_type
  use gfb_time_march, only: begin_rubbing, visit_past
  use gfb_machine_march, only: machine_march_type, begin_machine_march, take_machine_step, end_machine_march, visit_machine_march, &
                               resume_machine_march, forget_tangents
  use gfb_machine_history, only: machine_history_type, begin_history
  use gfb_machine_parts, only: part_type
  use gfb_machine_places, only: shown_places, nodes_of_places
  use gfb_machine_results, only: add_surfaces
  implicit none (type)
  private
  public :: part_archive

  !> The way of a machine.
  type, public :: machine_transient_type
    type(machine_march_type) :: march
    type(machine_history_type) :: history
    type(grid_series_type) :: series        !! films and foils of all bearings, where they are asked for
    character(len=:), allocatable :: ending !! why the time has ended before its end; empty: it has not
    character(len=:), allocatable :: lacking !! what was asked for and not reached; empty: nothing
    logical, private :: within = .false.    !! the end is one that was asked for
  contains
    procedure :: run => run_machine, results
    procedure, private :: keep_fields, save, restore, visit
    procedure, private :: look_for_limits, look_for_steady_orbit, change_of_orbit, judge_end
  end type machine_transient_type

contains

  !> Follows the machine from its equilibrium, or on from where a restart file has left it.
  !>
  !> Fails when that file is damaged, or belongs to other bearings.
  subroutine run_machine(self, scene, part, machine, answer, bearing, context, reason, error)
    class(machine_transient_type), intent(inout) :: self !! its way, from nothing
    type(scene_type), intent(in) :: scene !! of the machine, with `&transient`
    type(part_type), intent(inout) :: part(:) !! its bearings
    type(machine_type), intent(in) :: machine
    type(machine_equilibrium_type), intent(in) :: answer !! where it begins, unless a restart file has more
    type(machine_bearing_type), intent(inout) :: bearing(:) !! of the parts, there; left at the end
    type(run_context_type), intent(in) :: context !! of the run
    type(reason_type), intent(inout) :: reason !! why the time has no end
    type(error_type), allocatable, intent(out) :: error !! why it failed
    type(machine_drive_type) :: drive
    real(wp), allocatable :: motion(:), force(:)
    integer :: i

    call context%log%heading('time')
    self%ending = ''
    self%lacking = ''
    do i = 1, size(part)
      part(i)%scene%transient = scene%transient
      bearing(i)%newton%log%verbose = .false.
      bearing(i)%bearing%shaft_fixed = .true.
      if (.not. context%restart%continues) call choose_momentum(part(i)%scene, context%log, bearing(i)%bearing)
      call begin_rubbing(bearing(i)%bearing, context%restart%continues)
    end do
    drive = machine_drive(machine, scene%unbalance, scene%transient, scene%operation)
    allocate (motion(size(machine%force)), force(size(machine%held)), source=0.0_wp)
    if (.not. context%restart%continues) then
      motion = free_motions(answer%held, answer%motion)
      force = answer%force
    end if
    call begin_machine_march(machine, motion, force, drive, [(settings_in(scene, part(i)%scene), i=1, size(part))], bearing, self%march)
    call begin_history(machine, nodes_of_places(machine), shown_places(scene%machine), self%history)
    call self%history%see(machine, self%march, bearing)
    call self%history%add(machine, self%march, bearing)
    if (.not. context%restart%continues) then
      call self%keep_fields(scene, bearing)
    else
      call self%restore(context%restart, part, machine, bearing, error)
      if (.not. allocated(error)) call context%log%line('restart: resumed from '//place_in_time(self%march%film(1)))
    end if
    if (.not. allocated(error)) call follow_machine(self, scene, part, machine, bearing, context, reason)
    call end_machine_march(self%march, bearing)
  end subroutine run_machine

  !> How a bearing goes through time: steps are the machine's, losses its own.
  pure function settings_in(scene, part) result(settings)
    type(scene_type), intent(in) :: scene !! of the machine, with `&transient`
    type(scene_type), intent(in) :: part  !! of the bearing, with the same
    type(march_settings_type) :: settings

    settings = settings_of(part)
    settings%end_time = duration_of(scene%transient, scene%operation)
  end function settings_in

  !> Steps until the time is over, or something has happened.
  subroutine follow_machine(self, scene, part, machine, bearing, context, reason)
    class(machine_transient_type), intent(inout) :: self
    type(scene_type), intent(in) :: scene
    type(part_type), intent(inout) :: part(:)
    type(machine_type), intent(in) :: machine
    type(machine_bearing_type), intent(inout) :: bearing(:)
    type(run_context_type), intent(in) :: context
    type(reason_type), intent(inout) :: reason
    character(len=:), allocatable :: why
    type(restart_type) :: restart
    real(wp) :: from
    logical :: due

    restart = context%restart
    from = self%march%film(1)%time
    associate (clock => self%march%film(1), every => scene%transient%output_every, log => context%log)
      call log%is_within(place_in_time(self%march%film(1)), 0.0_wp)
      do while (clock%time < clock%settings%end_time)
        call take_machine_step(machine, bearing, self%march, why)
        if (why == '') then
          call self%history%see(machine, self%march, bearing)
          call self%keep_fields(scene, bearing)
          call self%look_for_limits(scene, part)
          if (self%ending == '') call self%look_for_steady_orbit(scene, bearing)
          if (modulo(clock%steps, every) == 0 .or. clock%time >= clock%settings%end_time .or. self%ending /= '') then
            call self%history%add(machine, self%march, bearing)
          end if
        else
          reason%code = reason_no_answer
          reason%detail = 'no time step converges from '//place_in_time(self%march%film(1))//': '//why
        end if
        if (self%ending /= '') exit
        if (stop_agreed()) then
          call reason%stopped(' at '//place_in_time(self%march%film(1)))
          if (restart%may_be_written() .and. clock%steps > 0) then ! before the first step there is no past to go on from
            call self%save(scene, restart, log, part, bearing)
            call restart%tell(log, reason%detail)
          end if
        end if
        if (reason%is_given()) exit
        due = restart%is_due(clock%steps)
        if (due .and. clock%time < clock%settings%end_time) call self%save(scene, restart, log, part, bearing)
        call log%is_within(place_in_time(self%march%film(1)), (clock%time - from)/(clock%settings%end_time - from))
      end do
      call log%is_within('')
      if (self%ending /= '') call log%line(self%ending//' at '//place_in_time(self%march%film(1)))
      call self%judge_end(scene, reason)
      if (reason%is_given() .and. .not. reason%is_stop()) call log%tell(reason%words())
      call log%line(text(clock%steps)//' steps, '//text(clock%rejections)//' of them taken again shorter; smallest film '// &
                    text(self%history%smallest_gap*micrometres, 4)//' um')
      if (self%history%lacks_spectrum()) call log%line('no spectrum: less than two lines a turn, with output_every = '//text(every))
    end associate
  end subroutine follow_machine

  !> Adds films and foils of all bearings to the series: at the beginning, and by the first step that reaches each chosen time.
  subroutine keep_fields(self, scene, bearing)
    class(machine_transient_type), intent(inout) :: self
    type(scene_type), intent(in) :: scene
    type(machine_bearing_type), intent(in) :: bearing(:)
    type(result_grid_type), allocatable :: grids(:)
    integer :: i

    associate (march => self%march%film(1))
      if (.not. is_field_time(scene%transient, march)) return
      allocate (grids(0))
      do i = 1, size(bearing)
        call add_surfaces(i, bearing(i)%bearing, scene%output, grids)
      end do
      if (size(grids) > 0) call add_series_step(self%series, 'time', 's', march%time, grids)
    end associate
  end subroutine keep_fields

  !> Writes the restart file after a step: bearings, their pasts, the shaft's, and the lines so far.
  subroutine save(self, scene, restart, log, part, bearing)
    class(machine_transient_type), intent(inout) :: self
    type(scene_type), intent(in) :: scene
    type(restart_type), intent(in) :: restart
    type(run_log_type), intent(in) :: log
    type(part_type), intent(inout) :: part(:)
    type(machine_bearing_type), intent(inout) :: bearing(:)
    type(archive_type) :: archive(2*size(part) + 1)
    integer :: i

    do i = 1, size(part)
      if (restart%every > 0) call forget_factors(bearing(i)%newton)
      archive(i)%name = part_archive(i)
      call visit_answer_and_record(archive(i), bearing(i)%bearing, bearing(i)%newton, part(i)%solution%record)
      associate (past => archive(size(part) + i))
        past%name = film_archive(i)
        call visit_past(past, bearing(i)%bearing, self%march%film(i))
      end associate
    end do
    if (restart%every > 0) call forget_tangents(self%march)
    associate (last => archive(size(archive)))
      last%name = 'machine'
      call self%visit(last, part, bearing)
    end associate
    call save_restart(scene, restart, log, self%march%film(1)%steps, wall_time() - part(1)%solution%record%begun, archive)
  end subroutine save

  !> Puts a march that has begun anew where the file says; bearings stand there already.
  !>
  !> Fails when the file is damaged, or belongs to other bearings.
  subroutine restore(self, restart, part, machine, bearing, error)
    class(machine_transient_type), intent(inout) :: self
    type(restart_type), intent(in) :: restart
    type(part_type), intent(inout) :: part(:)
    type(machine_type), intent(in) :: machine
    type(machine_bearing_type), intent(inout) :: bearing(:)
    type(error_type), allocatable, intent(out) :: error
    type(archive_type) :: archive, past
    character(len=:), allocatable :: why
    integer :: i

    call read_restart(restart, 'machine', archive, error)
    if (allocated(error)) return
    call self%visit(archive, part, bearing)
    call end_reading(restart, archive, error)
    do i = 1, size(part)
      if (.not. allocated(error)) call read_restart(restart, film_archive(i), past, error)
      if (allocated(error)) return
      call visit_past(past, bearing(i)%bearing, self%march%film(i))
      call end_reading(restart, past, error)
    end do
    if (allocated(error)) return
    call resume_machine_march(machine, bearing, self%march, why)
    if (why == '') why = self%history%misfit(self%march)
    if (why == '' .and. self%march%film(1)%steps /= restart%step) why = 'the number of steps'
    if (why /= '') call refuse_restart(restart, 'the file is damaged at /machine: '//why, error)
  end subroutine restore

  !> Saves or restores the march and its lines; foils get the mass that they had.
  subroutine visit(self, archive, part, bearing)
    class(machine_transient_type), intent(inout) :: self
    type(archive_type), intent(inout) :: archive
    type(part_type), intent(in) :: part(:)
    type(machine_bearing_type), intent(inout) :: bearing(:)
    character(len=:), allocatable :: file
    logical :: has_mass
    integer :: i

    do i = 1, size(part)
      file = part(i)%scene%echo
      call archive%visit('bearing_file', file)
      if (archive%failed) return
      call archive%require(file == part(i)%scene%echo, 'file of bearing '//text(i)//' as it was')
      has_mass = bearing(i)%bearing%momentum%present
      call archive%visit('foil_mass', has_mass)
      if (archive%failed) return
      if (has_mass .and. .not. archive%saves) call resume_momentum(part(i)%scene, bearing(i)%bearing)
    end do
    call visit_machine_march(archive, self%march)
    call self%history%visit(archive)
    call archive%part('series')
    call visit_series(archive, self%series)
    if (.not. archive%saves) call archive%require(is_whole(self%series), 'the series of surfaces')
  end subroutine visit

  !> Name of a bearing's archive in the restart file.
  function part_archive(number) result(name)
    integer, intent(in) :: number !! of the bearing
    character(len=:), allocatable :: name
    name = 'bearing_'//text(number)
  end function part_archive

  !> Name of the archive of a film's past.
  function film_archive(number) result(name)
    integer, intent(in) :: number !! of the bearing
    character(len=:), allocatable :: name
    name = 'film_'//text(number)
  end function film_archive

  !> Whether a film has closed, or a journal has left its place: after every step.
  subroutine look_for_limits(self, scene, part)
    class(machine_transient_type), intent(inout) :: self
    type(scene_type), intent(in) :: scene !! of the machine
    type(part_type), intent(in) :: part(:)
    integer :: i

    do i = 1, size(part)
      associate (film => self%march%film(i), one => part(i)%scene)
        if (self%history%gap(i) < one%solver%touch_down_gap .and. .not. one%shaft_contact%present) then
          self%ending = 'the shaft touches down in bearing '//text(i)
        else if (scene%transient%largest_orbit > 0.0_wp) then
          if (norm2(film%place(:2, 1) - film%first_place(:2)) <= scene%transient%largest_orbit) cycle
          self%ending = 'the orbit in bearing '//text(i)//' has grown beyond its limit'
          self%within = .true.
        end if
      end associate
      if (self%ending /= '') return
    end do
  end subroutine look_for_limits

  !> Whether the orbit stays as it is, by all steps of the last two turns, while nothing changes what drives the machine.
  subroutine look_for_steady_orbit(self, scene, bearing)
    class(machine_transient_type), intent(inout) :: self
    type(scene_type), intent(in) :: scene !! of the machine
    type(machine_bearing_type), intent(in) :: bearing(:)
    real(wp) :: clearance
    integer :: i

    if (.not. scene%transient%steady_tolerance > 0.0_wp) return
    associate (turn => self%march%film(1)%turns(), orbit => self%history%orbit)
      if (turn < 2.0_wp) return
      if (orbit%turn_began(turn - 2.0_wp) < self%march%drive%clock%settled()) return
    end associate
    clearance = minval([(bearing(i)%bearing%clearance, i=1, size(bearing))])
    if (self%change_of_orbit() > scene%transient%steady_tolerance*clearance) return
    self%ending = 'the orbit is steady'
    self%within = .true.
  end subroutine look_for_steady_orbit

  !> By how much the last two turns differ, in any place [m].
  real(wp) function change_of_orbit(self) result(change)
    class(machine_transient_type), intent(in) :: self
    real(wp), allocatable :: now(:), before(:)
    integer :: i

    associate (turn => self%march%film(1)%turns(), orbit => self%history%orbit, &
               moving => [(i, i=1, 2*size(self%history%place))])
      now = orbit%extents(turn - 1.0_wp, turn, moving)
      before = orbit%extents(turn - 2.0_wp, turn - 1.0_wp, moving)
    end associate
    change = maxval(abs(now - before))
  end function change_of_orbit

  !> Whether what was asked for is reached: the time to its end, or an end that the scene allows; and a steady orbit where it
  !> has a tolerance.
  subroutine judge_end(self, scene, reason)
    class(machine_transient_type), intent(inout) :: self
    type(scene_type), intent(in) :: scene
    type(reason_type), intent(inout) :: reason !! given where there was one before, or something is not reached
    character(len=:), allocatable :: why

    if (self%within) return
    why = self%ending
    associate (clock => self%march%film(1), transient => scene%transient)
      if (clock%time < clock%settings%end_time) then
        self%lacking = time_lacking(transient, clock)
        if (why /= '') why = why//' at '//place_in_time(self%march%film(1))
      end if
      if (transient%steady_tolerance > 0.0_wp) then
        if (self%lacking /= '') self%lacking = self%lacking//', '
        self%lacking = self%lacking//'a steady orbit'
        if (why == '') why = 'the time is over'
      end if
    end associate
    if (self%lacking == '' .or. reason%is_given()) return
    reason%code = reason_not_reached
    reason%detail = 'not reached: '//self%lacking//': '//why
  end subroutine judge_end

  !> What the summary says of the whole time.
  function results(self) result(found)
    class(machine_transient_type), intent(in) :: self !! its way
    type(quantity_type), allocatable :: found(:)

    found = self%history%results(self%march)
    if (self%ending /= '') call add_result(found, 'ending', self%ending)
    if (self%lacking /= '') call add_result(found, 'not_reached', self%lacking)
  end function results
end module gfb_machine_transient
