#include "gfb_petsc.h"
!> The load steps of a bump strip, up and down again.
module gfb_load_steps
  use petscvec
  use gfb_kinds, only: wp
  use gfb_archive, only: archive_type
  use gfb_errors, only: error_type
  use gfb_text, only: text
  use gfb_signals, only: stop_agreed, stop_words
  use gfb_scene, only: scene_type
  use gfb_bump_foil_case, only: fixed_edge_none
  use gfb_strip_load_case, only: crest_forces, load_plates, support_contact
  use gfb_foil_mesh, only: crest_positions
  use gfb_foil_builder, only: strip_shape
  use gfb_strip_system, only: strip_system_type
  use gfb_strip_answer, only: strip_recorder_type, start_recorder, resume_recorder, read_answer, destroy_recorder
  use gfb_newton, only: newton_type, newton_report_type, forget_factors, visit_counts
  use gfb_load_step, only: load_path_type, create_load_path, take_load_step, destroy_load_path, visit_strip
  use gfb_case_file, only: history_row_type
  use gfb_contact_record, only: record_contacts, visit_contact_record
  use gfb_strip_summary, only: step_quantities, show_step, show_step_header
  use gfb_strip_record, only: strip_run_type, visit_run
  use gfb_restart, only: save_restart, read_restart, end_reading
  use gfb_reasons, only: reason_type, reason_load_step
  use gfb_run_context, only: run_context_type
  use gfb_walk, only: walk_type, take_walk
  implicit none (type)
  private
  public :: load_and_unload

  real(wp), parameter :: rounding = 1.0e-9_wp !! of a balance of forces, relative

  !> The strip, its solver, and what was recorded. Keep it where it is.
  type, extends(walk_type), public :: load_steps_type
    type(scene_type) :: scene
    type(run_context_type) :: context
    type(strip_system_type) :: strip
    type(newton_type) :: newton
    type(strip_run_type) :: run
    type(load_path_type), private :: path
    type(strip_recorder_type), private :: recorder
    integer, private :: before(2) = 0 !! iterations and factorizations before the present step
  contains
    procedure :: reach => reach_step
    procedure :: record_point => record_step
    procedure :: keep_point => keep_step
    procedure :: keep_stopped
    procedure, private :: save
    procedure, private :: restore
    procedure, private :: visit
    procedure, private :: explain
  end type load_steps_type

contains

  !> All load steps, after strip and solver have been made.
  !>
  !> Fails when a restart file cannot be read.
  subroutine load_and_unload(steps, reason, error)
    class(load_steps_type), target, intent(inout) :: steps !! with strip and solver made
    type(reason_type), intent(out) :: reason !! why a step has no answer
    type(error_type), allocatable, intent(out) :: error !! why it failed
    character(len=:), allocatable :: lifted
    integer :: last

    associate (scene => steps%scene, log => steps%context%log, run => steps%run)
      last = scene%strip_load%steps_up + scene%strip_load%steps_down
      allocate (run%history(0))
      call start_recorder(steps%strip, scene%bump_foil%bumps, steps%recorder)
      call create_load_path(steps%strip, steps%path)
      run%full = steps%recorder%last
      run%last = steps%recorder%last
      if (steps%context%restart%goes_on) then
        call steps%restore(last, error)
        if (allocated(error)) return
      end if
      call show_step_header(log)
      lifted = what_lifts(scene)
      if (lifted /= '' .and. run%steps == 0) then
        call steps%explain(1, lifted, reason)
      else
        call take_walk(steps, run%steps + 1, last, reason)
      end if
      run%converged = .not. reason%is_given()
      associate (path => steps%path)
        if (path%at_round_off > 0) then
          call log%line(text(path%at_round_off)//' steps ended at round-off, where Newton''s moved by up to '// &
                        text(path%round_off, 2)//' of the deflection')
        end if
        if (path%homotopies + path%cuts > 0) then
          call log%line(text(path%homotopies)//' steps by a longer stick length, '//text(path%cuts)//' cuts')
        end if
      end associate
    end associate
    call destroy_load_path(steps%path)
    call destroy_recorder(steps%recorder)
  end subroutine load_and_unload

  !> Brings the strip to the load of a step.
  subroutine reach_step(self, point, reason)
    class(load_steps_type), target, intent(inout) :: self !! the load steps
    integer, intent(in) :: point             !! number of the step
    type(reason_type), intent(out) :: reason !! why there is no answer
    type(newton_report_type) :: report

    self%before = [self%newton%iterations, self%newton%factorizations]
    associate (load => self%scene%strip_load)
      call take_load_step(self%strip, self%newton, load_factor(point, load%steps_up, load%steps_down), self%path, report)
    end associate
    if (.not. (stop_agreed() .or. report%converged)) call self%explain(point, report%reason, reason)
  end subroutine reach_step

  !> Records a step's answer, from which the next one starts.
  subroutine record_step(self, point)
    class(load_steps_type), target, intent(inout) :: self !! the load steps
    integer, intent(in) :: point !! number of the step
    type(history_row_type) :: row
    integer :: iterations, factorizations

    associate (load => self%scene%strip_load, run => self%run)
      call read_answer(self%strip, full_force(self%scene), self%recorder, run%last)
      call record_contacts(self%strip%contacts, point, load%steps_up + load%steps_down, run%contacts)
      call self%strip%commit()
      if (point == load%steps_up) run%last%round_off = max(self%strip%stiffness_round_off(), self%path%round_off)
      if (point <= load%steps_up) run%full = run%last
      run%steps = point
      iterations = self%newton%iterations - self%before(1)
      factorizations = self%newton%factorizations - self%before(2)
      row%quantity = step_quantities(run%last, point, load%kind == load_plates, iterations, factorizations)
      run%history = [run%history, row]
      call show_step(self%context%log, run%last, point, iterations, factorizations)
    end associate
  end subroutine record_step

  !> Writes the restart file, where one is due.
  subroutine keep_step(self, point)
    class(load_steps_type), target, intent(inout) :: self !! the load steps
    integer, intent(in) :: point !! number of the step

    if (self%context%restart%is_due(point)) call self%save()
  end subroutine keep_step

  !> Writes the restart file of load steps that are stopped after one of them.
  subroutine keep_stopped(self, point)
    class(load_steps_type), target, intent(inout) :: self !! the load steps
    integer, intent(in) :: point !! number of the last one that has an answer

    if (point < 1 .or. .not. self%context%restart%may_be_written()) return
    call self%save()
    call self%context%restart%tell(self%context%log, stop_words()//' after step '//text(point)//' of '// &
                                   text(self%scene%strip_load%steps_up + self%scene%strip_load%steps_down))
  end subroutine keep_stopped

  !> Writes the restart file after a step; where files are asked for the solver loses its factors.
  subroutine save(self)
    class(load_steps_type), intent(inout) :: self !! the load steps
    type(archive_type) :: archive(1)

    if (self%context%restart%every > 0) call forget_factors(self%newton)
    archive(1)%name = 'strip'
    call self%visit(archive(1))
    call save_restart(self%scene, self%context%restart, self%context%log, self%run%steps, 0.0_wp, archive)
  end subroutine save

  !> Puts the strip where the restart file says.
  !>
  !> Fails when the file is damaged.
  subroutine restore(self, steps, error)
    class(load_steps_type), intent(inout) :: self !! the load steps, as they begin
    integer, intent(in) :: steps !! that there will be
    type(error_type), allocatable, intent(out) :: error !! why it failed
    type(archive_type) :: archive

    call read_restart(self%context%restart, 'strip', archive, error)
    if (allocated(error)) return
    call self%visit(archive)
    call end_reading(self%context%restart, archive, error)
    if (allocated(error)) return
    call resume_recorder(self%strip, self%run%last, self%recorder)
    call self%context%log%line('restart: resumed from step '//text(self%run%steps)//' of '//text(steps))
  end subroutine restore

  !> Saves or restores strip, counters, and all that was recorded.
  subroutine visit(self, archive)
    class(load_steps_type), intent(inout) :: self !! the load steps
    type(archive_type), intent(inout) :: archive !! that saves or restores

    call visit_strip(archive, self%strip, self%path)
    call visit_counts(archive, self%newton)
    call visit_run(archive, self%run)
    if (archive%failed) return
    call visit_contact_record(archive, self%strip%contacts, self%strip%foil%mesh%rows, self%run%steps, self%run%contacts)
  end subroutine visit

  !> Says why a step has no answer.
  subroutine explain(self, step, detail, reason)
    class(load_steps_type), intent(in) :: self !! the load steps
    integer, intent(in) :: step !! number of the step
    character(len=*), intent(in) :: detail !! what hinders
    type(reason_type), intent(out) :: reason !! why there is none

    associate (load => self%scene%strip_load)
      reason%code = reason_load_step
      reason%at = step
      reason%of = load%steps_up + load%steps_down
      reason%detail = detail
    end associate
    call self%context%log%tell(reason%words())
  end subroutine explain

  !> Share of the full load at a step.
  pure function load_factor(step, up, down) result(factor)
    integer, intent(in) :: step, up, down
    real(wp) :: factor

    if (step <= up) then
      factor = real(step, wp)/real(up, wp)
    else
      factor = real(up + down - step, wp)/real(down, wp)
    end if
  end function load_factor

  !> Full force on all crests where it is given [N].
  function full_force(scene) result(force)
    type(scene_type), intent(in) :: scene
    real(wp) :: force

    associate (foil => scene%bump_foil, load => scene%strip_load)
      if (load%kind == load_plates) then
        force = load%maximum_force
      else
        force = sum(crest_forces(load, foil))
      end if
    end associate
  end function full_force

  !> What moves a strip that nothing but the sleeve holds, in words; empty where the sleeve can hold
  !> it.
  function what_lifts(scene) result(words)
    type(scene_type), intent(in) :: scene
    character(len=:), allocatable :: words
    real(wp), allocatable :: force(:), crest(:), half_length(:)
    real(wp) :: corner(2) !! the outermost ones [m]
    real(wp) :: total, size_of_load, centre, reach

    words = ''
    associate (foil => scene%bump_foil, load => scene%strip_load)
      if (foil%fixed_edge /= fixed_edge_none .or. load%kind == load_plates .or. &
          load%support /= support_contact) return
      force = crest_forces(load, foil)
      crest = crest_positions(strip_shape(scene))
      total = sum(force)
      size_of_load = sum(abs(force))
      half_length = foil%half_length%each(foil%bumps)
      corner = [minval(crest) - half_length(1), maxval(crest) + half_length(foil%bumps)]
      reach = maxval(crest) - minval(crest) + half_length(1) + half_length(foil%bumps)
      if (.not. size_of_load > 0.0_wp) return
      if (total <= rounding*size_of_load) then
        words = 'the load lifts the strip off the sleeve: the forces on the crests add up to '//text(total, 4)// &
                ' N towards the sleeve, and the strip is fixed nowhere'
        return
      end if
      centre = (dot_product(force, crest)/total - 0.5_wp*(corner(1) + corner(2)))/reach
      if (abs(centre) > 0.5_wp) then
        words = 'the load tips the strip over: it acts beyond the last corner line, and the strip is fixed nowhere'
      end if
    end associate
  end function what_lifts
end module gfb_load_steps
