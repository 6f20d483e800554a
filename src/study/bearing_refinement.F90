#include "gfb_petsc.h"
!> A bearing on one of several nested meshes.
module gfb_bearing_refinement
  use petscsys
  use gfb_kinds, only: wp
  use gfb_errors, only: error_type
  use gfb_quantity, only: quantity_type
  use gfb_run_log, only: run_log_type
  use gfb_scene, only: scene_type
  use gfb_memory_check, only: check_memory
  use gfb_bearing_system, only: bearing_system_type
  use gfb_bearing_answer, only: bearing_answer
  use gfb_bearing_builder, only: bearing_plan_type
  use gfb_bearing_plan, only: plan_bearing
  use gfb_bearing_record, only: bearing_record_type, analysis_name
  use gfb_bearing_summary, only: cost_type, answer_quantities
  use gfb_bearing_analysis, only: solve_scene, write_bearing, cost_of
  use gfb_newton, only: newton_type, destroy_newton
  use gfb_restart, only: restart_type
  use gfb_contact_record, only: foil_contact_arrays
  use gfb_petsc_session, only: rank_count
  use gfb_provenance, only: provenance
  use gfb_cost_events, only: enter_stage, leave_stage
  use gfb_model_case, only: film_scheme_auto, film_scheme_galerkin, film_scheme_supg, film_order_bilinear
  use gfb_refined_run, only: refined_run_type
  implicit none (type)
  private
  public :: keep_scheme

  !> The bearing, and what was found of it.
  type, extends(refined_run_type), public :: refined_bearing_type
    private
    type(bearing_plan_type) :: plan
    type(bearing_system_type) :: bearing
    type(newton_type) :: newton
    type(bearing_record_type) :: record
  contains
    procedure :: prepare => prepare_bearing
    procedure :: solve => solve_bearing
    procedure :: write => write_refined_bearing
    procedure :: left_out => bearing_left_out
    procedure :: discard => discard_bearing
  end type refined_bearing_type

contains

  !> Says what the mesh needs.
  !>
  !> Fails where the machine has too little memory.
  subroutine prepare_bearing(self, scene, log, error)
    class(refined_bearing_type), intent(inout) :: self
    type(scene_type), intent(in) :: scene
    type(run_log_type), intent(in) :: log
    type(error_type), allocatable, intent(out) :: error

    call plan_bearing(scene, log, self%plan)
    call check_memory(scene, self%plan%memory, error)
  end subroutine prepare_bearing

  !> Finds the answer.
  !>
  !> Fails when the mesh cannot be cut.
  subroutine solve_bearing(self, scene, log, error)
    class(refined_bearing_type), target, intent(inout) :: self
    type(scene_type), intent(in) :: scene
    type(run_log_type), intent(in) :: log
    type(error_type), allocatable, intent(out) :: error
    type(restart_type) :: none

    call solve_scene(scene, self%plan, none, log, self%bearing, self%newton, self%record, self%converged, error)
    if (allocated(error)) return
    self%unknowns = self%bearing%unknowns
    self%iterations = self%newton%iterations
    self%factorizations = self%newton%factorizations
    self%found = answer_quantities(analysis_name(scene), self%converged, bearing_answer(self%bearing), &
                                   self%bearing%film%clearance, self%bearing%force_scale())
  end subroutine solve_bearing

  !> Writes the result files.
  !>
  !> Fails when one cannot be written.
  subroutine write_refined_bearing(self, scene, folder, command, start_time, good, more, log, summary, error)
    class(refined_bearing_type), intent(inout) :: self
    type(scene_type), intent(in) :: scene
    character(len=*), intent(in) :: folder     !! where the results go
    character(len=*), intent(in) :: command    !! the whole command line
    real(wp), intent(in) :: start_time         !! of the run [s]
    logical, intent(in) :: good                !! it is the answer, as well known as asked for
    type(quantity_type), intent(in) :: more(:) !! for the summary
    type(run_log_type), intent(in) :: log
    type(quantity_type), allocatable, intent(out) :: summary(:)
    type(error_type), allocatable, intent(out) :: error
    type(cost_type) :: cost

    call enter_stage('output')
    cost = cost_of(self%bearing, self%newton, start_time)
    cost%newton_iterations = self%iterations
    cost%factorizations = self%factorizations
    self%record%judged = [self%record%judged, more]
    call write_bearing(scene, self%plan, folder, provenance(command), log, self%bearing, good, self%record, cost, &
                       rank_count(), foil_contact_arrays(self%bearing%foil, self%record%contacts, &
                       size(self%record%history)), summary, error)
    call leave_stage()
  end subroutine write_refined_bearing

  !> What the model leaves out, and why.
  function bearing_left_out(self, scene) result(words)
    class(refined_bearing_type), intent(in) :: self
    type(scene_type), intent(in) :: scene
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
    class(refined_bearing_type), intent(inout) :: self

    call destroy_newton(self%newton)
    call self%bearing%destroy()
  end subroutine discard_bearing

  !> Takes for all meshes the weighting that the mesh of the case would have: values of two schemes do
  !> not approach their limit in one way.
  subroutine keep_scheme(scene)
    type(scene_type), intent(inout) :: scene
    type(bearing_plan_type) :: plan
    type(run_log_type) :: quiet

    if (scene%model%film_scheme /= film_scheme_auto .or. scene%model%film_order /= film_order_bilinear) return
    quiet%active = .false.
    call plan_bearing(scene, quiet, plan)
    scene%model%film_scheme = merge(film_scheme_supg, film_scheme_galerkin, plan%upwind)
  end subroutine keep_scheme
end module gfb_bearing_refinement
