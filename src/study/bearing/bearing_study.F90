#include "gfb_petsc.h"
!> A bearing with a given load or a given position, at one point or along a sweep.
module gfb_bearing_study
  use petscsys
  use gfb_kinds, only: wp
  use gfb_errors, only: error_type, fail, status_machine
  use gfb_quantity, only: quantity_type, add_quantity
  use gfb_run_log, only: run_log_type
  use gfb_c_library, only: peak_memory
  use gfb_scene, only: scene_type
  use gfb_model_case, only: film_scheme_auto, film_order_bilinear
  use gfb_petsc_session, only: wall_time, sum_over_ranks, rank_count
  use gfb_bearing_answer, only: bearing_answer
  use gfb_mesh_plan, only: bearing_plan_type
  use gfb_newton, only: destroy_newton
  use gfb_bearing_plan, only: plan_bearing
  use gfb_bearing_record, only: analysis_name
  use gfb_dynamics_record, only: coefficients_of
  use gfb_bearing_summary, only: cost_type, answer_quantities
  use gfb_run_context, only: run_context_type
  use gfb_study, only: study_type
  use gfb_motions, only: motion_type, moves
  use gfb_sweep, only: sweep_type
  use gfb_bearing_solution, only: solve_bearing
  use gfb_bearing_writing, only: record_arrays, write_coefficients, bearing_result_type, write_bearing
  implicit none (type)
  private

  !> The bearing, and what was found of it.
  type, extends(study_type), public :: bearing_study_type
    type(bearing_plan_type) :: plan
    type(sweep_type) :: sweep
    type(motion_type), allocatable :: motion !! of the shaft, where that is asked for
  contains
    procedure :: prepare => prepare_bearing
    procedure :: solve => solve_study
    procedure :: write => write_study
    procedure :: left_out => bearing_left_out
    procedure :: discard => discard_bearing
  end type bearing_study_type

contains

  !> Plans the bearing.
  subroutine prepare_bearing(self, scene, log)
    class(bearing_study_type), intent(inout) :: self !! the study
    type(scene_type), intent(in) :: scene !! what is asked for
    type(run_log_type), intent(in) :: log !! where lines go

    call plan_bearing(scene, log, self%plan)
    self%memory = self%plan%memory
  end subroutine prepare_bearing

  !> Finds all answers.
  !>
  !> Fails when the mesh cannot be cut or a restart file cannot be read.
  subroutine solve_study(self, scene, context, error)
    class(bearing_study_type), target, intent(inout) :: self !! the study
    type(scene_type), intent(in) :: scene !! what is asked for
    type(run_context_type), intent(in) :: context !! of the run
    type(error_type), allocatable, intent(out) :: error !! why it failed

    call find_first(self, scene, context, error)
    if (allocated(error)) return
    self%converged = .not. self%reason%is_given()
    associate (dynamics => self%sweep%record%dynamics)
      if (allocated(dynamics%problem)) call fail(error, dynamics%problem, status_machine)
      if (allocated(error)) return
    end associate
    associate (bearing => self%sweep%bearing, newton => self%sweep%newton)
      self%unknowns = bearing%unknowns
      self%iterations = newton%iterations
      self%factorizations = newton%factorizations
      self%factorizations_finest = newton%factorizations - newton%factorizations_before
      self%found = answer_quantities(analysis_name(scene), self%converged, bearing_answer(bearing), &
                                     bearing%pad(1)%film%clearance, bearing%force_scale())
      if (self%converged .and. allocated(self%sweep%record%limit)) call add_quantity(self%found, self%sweep%record%limit)
    end associate
    associate (record => self%sweep%record)
      if (.not. self%converged .or. .not. allocated(record%dynamics%point)) return
      if (size(record%dynamics%point) /= 1) return
      self%coefficients = coefficients_of(record%dynamics%point(1))
      if (allocated(record%judged)) call add_quantity(self%found, record%judged)
    end associate
  end subroutine solve_study

  !> Finds the answer, or the answers of a sweep; with `&transient` or `&periodic` where the shaft begins, and its motion from there.
  !>
  !> Fails when the mesh cannot be cut or a restart file cannot be read.
  subroutine find_first(self, scene, context, error)
    class(bearing_study_type), target, intent(inout) :: self
    type(scene_type), intent(in) :: scene
    type(run_context_type), intent(in) :: context
    type(error_type), allocatable, intent(out) :: error
    type(scene_type), allocatable :: first

    first = scene
    if (scene%transient%present) first%operation%load = scene%transient%start_load
    call solve_bearing(first, self%plan, context, self%sweep, self%reason, error)
    if (allocated(error) .or. self%reason%is_given() .or. .not. moves(scene)) return
    allocate (self%motion)
    if (scene%transient%present .and. .not. context%restart%goes_on) call self%sweep%judge_begin()
    call self%motion%run(scene, context, self%sweep%bearing, self%sweep%newton, self%sweep%record, self%reason, error)
    if (.not. allocated(error)) call self%sweep%record%move_on(self%motion%results())
  end subroutine find_first

  !> Writes the result files.
  !>
  !> Fails when one cannot be written.
  subroutine write_study(self, scene, context, summary, error)
    class(bearing_study_type), target, intent(inout) :: self !! the study
    type(scene_type), intent(in) :: scene !! what is asked for
    type(run_context_type), intent(in) :: context !! of the run
    type(quantity_type), allocatable, intent(out) :: summary(:) !! what the summary says
    type(error_type), allocatable, intent(out) :: error !! why it failed
    type(bearing_result_type) :: result
    real(wp) :: memory(1)

    memory = sum_over_ranks([peak_memory()])
    result%converged = self%converged
    result%upwind = self%plan%upwind
    result%peclet = self%plan%peclet
    result%cells = self%plan%circumferential
    result%cost = cost_type(self%unknowns, self%iterations, self%factorizations, self%factorizations_finest, &
                            wall_time() - context%start_time, memory(1))
    result%ranks = rank_count()
    result%origin = context%origin()
    associate (record => self%sweep%record)
      if (allocated(self%coefficient_errors)) record%dynamics%point(1)%error = self%coefficient_errors
      result%contacts = record_arrays(scene, self%sweep%bearing, record, size(record%history))
      if (allocated(self%motion)) call self%motion%add_arrays(result%contacts)
      if (allocated(self%more)) call add_quantity(record%judged, self%more)
      call write_bearing(scene, context, self%sweep, result, summary, error)
      if (.not. allocated(error)) call write_coefficients(record, scene, context, error)
    end associate
  end subroutine write_study

  !> What the model leaves out, and why.
  function bearing_left_out(self, scene) result(words)
    class(bearing_study_type), intent(in) :: self !! the study
    type(scene_type), intent(in) :: scene !! what is asked for
    character(len=:), allocatable :: words

    words = ''
    if (self%plan%half) words = 'the other half of the width, which mirrors the one solved; '
    if (scene%model%film_order == film_order_bilinear .and. scene%model%film_scheme == film_scheme_auto .and. &
        .not. self%plan%upwind) then
      words = words//'upwinding (SUPG), which the mesh of the case does not need; '
    end if
  end function bearing_left_out

  !> Frees what the solvers hold.
  subroutine discard_bearing(self)
    class(bearing_study_type), intent(inout) :: self !! the study

    call destroy_newton(self%sweep%newton)
    call self%sweep%bearing%destroy()
  end subroutine discard_bearing
end module gfb_bearing_study
