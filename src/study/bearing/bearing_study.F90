#include "gfb_petsc.h"
!> A bearing with a given load or a given position, at one point; studies of further answers go on from there.
module gfb_bearing_study
  use petscsys
  use gfb_kinds, only: wp
  use gfb_errors, only: error_type, fail, status_machine
  use gfb_scene, only: scene_type
  use gfb_model_case, only: film_scheme_auto, film_order_bilinear
  use gfb_cost_events, only: enter_stage, leave_stage
  use gfb_mesh_plan, only: bearing_plan_type
  use gfb_continuation, only: path_report_type
  use gfb_run_context, only: run_context_type
  use gfb_case_file, only: case_array_type
  use gfb_quantity, only: quantity_type, add_quantity
  use gfb_run_log, only: run_log_type
  use gfb_c_library, only: peak_memory
  use gfb_petsc_session, only: wall_time, sum_over_ranks, rank_count
  use gfb_bearing_answer, only: bearing_answer_type, bearing_answer
  use gfb_bearing_plan, only: plan_bearing
  use gfb_memory_check, only: check_memory
  use gfb_bearing_builder, only: check_meshes
  use gfb_dynamics_record, only: coefficients_of
  use gfb_bearing_summary, only: cost_type, answer_quantities
  use gfb_study, only: study_type
  use gfb_bearing_solution, only: bearing_solution_type
  use gfb_answer_record, only: record_answer, record_last_state
  use gfb_bearing_writing, only: record_arrays, bearing_result_type, write_bearing
  implicit none (type)
  private

  !> The bearing, and what was found of it.
  type, extends(study_type), public :: bearing_study_type
    type(bearing_plan_type) :: plan
    type(bearing_solution_type) :: solution
    type(bearing_answer_type), allocatable :: answer !! of its last state
  contains
    procedure :: prepare => prepare_bearing, check => check_bearing, solve => solve_study, find_answers
    procedure :: first_point   !! number of the sweep's value with which it begins; 0: the scene's own point
    procedure :: record_first  !! what follows the search for the first answer
    procedure :: continue => end_at_first !! the answers that follow
    procedure :: add_arrays    !! what the result file gets beside the record
    procedure :: write => write_study, left_out => bearing_left_out, discard => discard_bearing
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

  !> Checks, after `prepare`, whether the study can be done.
  !>
  !> Fails where the machine has too little memory, and where an element of its meshes cannot be.
  subroutine check_bearing(self, scene, error)
    class(bearing_study_type), intent(in) :: self !! the study
    type(scene_type), intent(in) :: scene !! that is asked for
    type(error_type), allocatable, intent(out) :: error !! what is lacking

    call check_memory(scene, self%memory, error)
    if (.not. allocated(error)) call check_meshes(scene, self%plan, error)
  end subroutine check_bearing

  !> Finds all answers.
  !>
  !> Fails when the mesh cannot be cut or a restart file cannot be read.
  subroutine solve_study(self, scene, context, error)
    class(bearing_study_type), target, intent(inout) :: self !! the study
    type(scene_type), intent(in) :: scene !! what is asked for
    type(run_context_type), intent(in) :: context !! of the run
    type(error_type), allocatable, intent(out) :: error !! why it failed

    call self%find_answers(scene, context, error)
    if (allocated(error)) return
    self%converged = .not. self%reason%is_given()
    associate (bearing => self%solution%bearing, newton => self%solution%newton, record => self%solution%record)
      if (allocated(record%dynamics%problem)) call fail(error, record%dynamics%problem, status_machine)
      if (allocated(error)) return
      self%unknowns = bearing%unknowns
      self%iterations = newton%iterations
      self%factorizations = newton%factorizations
      self%factorizations_finest = newton%factorizations - newton%factorizations_before
      call read_last_state(self)
      self%found = answer_quantities(trim(scene%general%asked%word), self%converged, self%answer, bearing%clearance, bearing%force_scale())
      if (self%converged .and. allocated(record%limit)) call add_quantity(self%found, record%limit)
      if (.not. self%converged .or. .not. allocated(record%dynamics%point)) return
      if (size(record%dynamics%point) /= 1) return
      self%coefficients = coefficients_of(record%dynamics%point(1))
      if (allocated(record%judged)) call add_quantity(self%found, record%judged)
    end associate
  end subroutine solve_study

  !> Reads the answer off the last state. Where nothing follows the first one it is that of the only row.
  subroutine read_last_state(self)
    class(bearing_study_type), intent(inout) :: self !! the study

    associate (solution => self%solution)
      select type (self)
      type is (bearing_study_type)
        call move_alloc(solution%record%answer, self%answer)
      end select
      if (.not. allocated(self%answer)) self%answer = bearing_answer(solution%bearing, stresses=.true.)
    end associate
  end subroutine read_last_state

  !> Finds the first answer, or takes it from a restart file, and those that follow.
  !>
  !> Fails when the mesh cannot be cut or a restart file cannot be read.
  subroutine find_answers(self, scene, context, error)
    class(bearing_study_type), target, intent(inout) :: self !! the study
    type(scene_type), intent(in) :: scene !! what is asked for
    type(run_context_type), intent(in) :: context !! of the run
    type(error_type), allocatable, intent(out) :: error !! why it failed
    type(path_report_type) :: report
    integer :: last !! point of the sweep that has an answer

    associate (solution => self%solution)
      call solution%set_up(scene, self%plan, context)
      if (context%restart%continues) then
        last = context%restart%step
        call solution%resume(error)
        if (allocated(error)) return
      else
        last = self%first_point()
        call solution%start(last, report, error)
        if (allocated(error)) return
        if (.not. report%converged()) call solution%explain(report, .false., self%reason)
        solution%record%begun = wall_time()
        call self%record_first(report%converged())
      end if
      call enter_stage('sweep')
      if (.not. self%reason%is_given()) call self%continue(last + 1, error)
      call leave_stage()
      call solution%drop_helpers()
    end associate
  end subroutine find_answers

  !> The scene's own point.
  integer function first_point(self) result(point)
    class(bearing_study_type), intent(in) :: self !! the study, with its scene
    point = 0
  end function first_point

  !> Records the answer, or the last state.
  subroutine record_first(self, converged)
    class(bearing_study_type), target, intent(inout) :: self !! the study
    logical, intent(in) :: converged !! there is an answer

    if (converged) then
      call record_answer(self%solution)
    else
      call record_last_state(self%solution)
    end if
  end subroutine record_first

  !> Nothing follows one answer.
  subroutine end_at_first(self, next, error)
    class(bearing_study_type), target, intent(inout) :: self !! the study
    integer, intent(in) :: next !! point of a sweep
    type(error_type), allocatable, intent(out) :: error !! why it failed
  end subroutine end_at_first

  !> Nothing beside the record.
  subroutine add_arrays(self, arrays)
    class(bearing_study_type), intent(in) :: self !! the study
    type(case_array_type), allocatable, intent(inout) :: arrays(:) !! get a dataset a name
  end subroutine add_arrays

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
    result%reason = self%reason
    result%plan = self%plan
    result%cost = cost_type(self%unknowns, self%iterations, self%factorizations, self%factorizations_finest, &
                            wall_time() - context%start_time, memory(1))
    result%ranks = rank_count()
    result%origin = context%origin()
    associate (record => self%solution%record)
      if (allocated(self%coefficient_errors)) record%dynamics%point(1)%error = self%coefficient_errors
      result%contacts = record_arrays(scene, self%solution%bearing, record, size(record%history))
      call self%add_arrays(result%contacts)
      if (allocated(self%more)) call add_quantity(record%judged, self%more)
    end associate
    call write_bearing(scene, context, self%solution, self%answer, result, summary, error)
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
    call self%solution%destroy()
  end subroutine discard_bearing
end module gfb_bearing_study
