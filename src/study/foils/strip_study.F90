#include "gfb_petsc.h"
!> A bump strip under crest loads or between plates, up and down in load steps.
module gfb_strip_study
  use petscsys
  use gfb_errors, only: error_type
  use gfb_text, only: text
  use gfb_quantity, only: quantity_type
  use gfb_run_log, only: run_log_type
  use gfb_scene, only: scene_type
  use gfb_strip_load_case, only: load_plates
  use gfb_solver_case, only: linear_solver_iterative
  use gfb_substructures, only: kind_count
  use gfb_foil_builder, only: foil_plan_type
  use gfb_strip_builder, only: build_strip
  use gfb_strip_system, only: destroy_strip_system
  use gfb_newton, only: newton_settings_type, create_newton, destroy_newton
  use gfb_foil_plan, only: plan_foil
  use gfb_cost_events, only: enter_stage, leave_stage
  use gfb_strip_summary, only: answer_quantities
  use gfb_run_context, only: run_context_type
  use gfb_study, only: study_type
  use gfb_load_steps, only: load_steps_type, load_and_unload
  use gfb_strip_writing, only: write_strip
  implicit none (type)
  private

  !> The strip, and what was found of it.
  type, extends(study_type), public :: strip_study_type
    private
    type(foil_plan_type) :: plan
    type(load_steps_type) :: steps
  contains
    procedure :: prepare => prepare_strip
    procedure :: solve => solve_strip
    procedure :: write => write_study
    procedure :: left_out => strip_left_out
    procedure :: discard => discard_strip
  end type strip_study_type

contains

  !> Plans the strip.
  subroutine prepare_strip(self, scene, log)
    class(strip_study_type), intent(inout) :: self !! the study
    type(scene_type), intent(in) :: scene !! what is asked for
    type(run_log_type), intent(in) :: log !! where lines go

    call plan_foil(scene, log, self%plan)
    self%memory = self%plan%memory
  end subroutine prepare_strip

  !> Builds the strip and takes all load steps.
  !>
  !> Fails when the mesh cannot be made or a restart file cannot be read.
  subroutine solve_strip(self, scene, context, error)
    class(strip_study_type), target, intent(inout) :: self !! the study
    type(scene_type), intent(in) :: scene !! what is asked for
    type(run_context_type), intent(in) :: context !! of the run
    type(error_type), allocatable, intent(out) :: error !! why it failed

    self%steps%scene = scene
    self%steps%context = context
    associate (strip => self%steps%strip, newton => self%steps%newton, run => self%steps%run, solver => scene%solver)
      call enter_stage('set-up')
      call build_strip(scene, self%plan, strip, error)
      call leave_stage()
      if (allocated(error)) return
      call context%log%line('super-elements: '//text(kind_count(strip%foil%substructure))//' distinct of '// &
                            text(size(strip%foil%substructure))//', '//text(strip%unknowns)//' unknowns')
      if (solver%linear_solver == linear_solver_iterative) call strip%find_motions()
      call create_newton(newton, strip, 'strip_', &
                         newton_settings_type(solver%residual_tolerance, solver%step_tolerance, &
                                              solver%maximum_iterations), context%log)
      call load_and_unload(self%steps, self%reason, error)
      if (allocated(error)) return
      self%converged = run%converged
      self%unknowns = strip%unknowns
      self%iterations = newton%iterations
      self%factorizations = newton%factorizations
      self%found = answer_quantities(run%full, run%last, scene%strip_load%kind == load_plates, self%converged)
    end associate
  end subroutine solve_strip

  !> Writes the result files.
  !>
  !> Fails when one cannot be written.
  subroutine write_study(self, scene, context, summary, error)
    class(strip_study_type), target, intent(inout) :: self !! the study
    type(scene_type), intent(in) :: scene !! what is asked for
    type(run_context_type), intent(in) :: context !! of the run
    type(quantity_type), allocatable, intent(out) :: summary(:) !! what the summary says
    type(error_type), allocatable, intent(out) :: error !! why it failed

    self%steps%run%converged = self%converged
    self%steps%newton%iterations = self%iterations
    self%steps%newton%factorizations = self%factorizations
    if (.not. allocated(self%more)) allocate (self%more(0))
    call write_strip(scene, context, self%steps, self%more, summary, error)
  end subroutine write_study

  !> What the model leaves out, and why.
  function strip_left_out(self, scene) result(words)
    class(strip_study_type), intent(in) :: self !! the study
    type(scene_type), intent(in) :: scene !! what is asked for
    character(len=:), allocatable :: words

    words = ''
    if (self%plan%half) words = 'the other half of the width, which mirrors the one solved; '
    if (self%plan%reduced) words = words//'unknowns of '//text(scene%bump_foil%bumps)// &
                                   ' bumps between their loaded lines, condensed exactly; '
  end function strip_left_out

  !> Frees what the solvers hold.
  subroutine discard_strip(self)
    class(strip_study_type), intent(inout) :: self !! the study

    call destroy_newton(self%steps%newton)
    call destroy_strip_system(self%steps%strip)
  end subroutine discard_strip
end module gfb_strip_study
