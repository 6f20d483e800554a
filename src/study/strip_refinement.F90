#include "gfb_petsc.h"
!> A bump strip on one of several nested meshes.
module gfb_strip_refinement
  use petscsys
  use gfb_kinds, only: wp
  use gfb_errors, only: error_type
  use gfb_quantity, only: quantity_type
  use gfb_run_log, only: run_log_type
  use gfb_scene, only: scene_type
  use gfb_memory_check, only: check_memory
  use gfb_foil_builder, only: foil_plan_type
  use gfb_foil_plan, only: plan_foil
  use gfb_newton, only: newton_type, destroy_newton
  use gfb_restart, only: restart_type
  use gfb_strip_analysis, only: solve_strip, write_answer
  use gfb_strip_load_case, only: load_plates
  use gfb_strip_record, only: strip_run_type
  use gfb_strip_summary, only: answer_quantities
  use gfb_strip_system, only: strip_system_type, destroy_strip_system
  use gfb_text, only: text
  use gfb_refined_run, only: refined_run_type
  implicit none (type)
  private

  !> The strip, and what was found of it.
  type, extends(refined_run_type), public :: refined_strip_type
    private
    type(foil_plan_type) :: plan
    type(strip_system_type) :: strip
    type(newton_type) :: newton
    type(strip_run_type) :: steps
  contains
    procedure :: prepare => prepare_strip
    procedure :: solve => solve_refined_strip
    procedure :: write => write_refined_strip
    procedure :: left_out => strip_left_out
    procedure :: discard => discard_strip
  end type refined_strip_type

contains

  !> Says what the mesh needs.
  !>
  !> Fails where the machine has too little memory.
  subroutine prepare_strip(self, scene, log, error)
    class(refined_strip_type), intent(inout) :: self
    type(scene_type), intent(in) :: scene
    type(run_log_type), intent(in) :: log
    type(error_type), allocatable, intent(out) :: error

    call plan_foil(scene, log, self%plan)
    call check_memory(scene, self%plan%memory, error)
  end subroutine prepare_strip

  !> All load steps.
  !>
  !> Fails when the mesh cannot be made.
  subroutine solve_refined_strip(self, scene, log, error)
    class(refined_strip_type), target, intent(inout) :: self
    type(scene_type), intent(in) :: scene
    type(run_log_type), intent(in) :: log
    type(error_type), allocatable, intent(out) :: error
    type(restart_type) :: none

    call solve_strip(scene, self%plan, none, log, self%strip, self%newton, self%steps, error)
    if (allocated(error)) return
    self%converged = self%steps%converged
    self%unknowns = self%strip%unknowns
    self%iterations = self%newton%iterations
    self%factorizations = self%newton%factorizations
    self%found = answer_quantities(self%steps%full, self%steps%last, &
                                   scene%strip_load%kind == load_plates, self%converged)
  end subroutine solve_refined_strip

  !> Writes the result files.
  !>
  !> Fails when one cannot be written.
  subroutine write_refined_strip(self, scene, folder, command, start_time, good, more, log, summary, error)
    class(refined_strip_type), intent(inout) :: self
    type(scene_type), intent(in) :: scene
    character(len=*), intent(in) :: folder     !! where the results go
    character(len=*), intent(in) :: command    !! the whole command line
    real(wp), intent(in) :: start_time         !! of the run [s]
    logical, intent(in) :: good                !! it is the answer, as well known as asked for
    type(quantity_type), intent(in) :: more(:) !! for the summary
    type(run_log_type), intent(in) :: log
    type(quantity_type), allocatable, intent(out) :: summary(:)
    type(error_type), allocatable, intent(out) :: error

    self%steps%converged = good
    self%newton%iterations = self%iterations
    self%newton%factorizations = self%factorizations
    call write_answer(scene, folder, command, start_time, log, self%strip, self%newton, self%steps, more, summary, &
                      error)
  end subroutine write_refined_strip

  !> What the model leaves out, and why.
  function strip_left_out(self, scene) result(words)
    class(refined_strip_type), intent(in) :: self
    type(scene_type), intent(in) :: scene
    character(len=:), allocatable :: words

    words = ''
    if (self%plan%half) words = 'the other half of the width, which mirrors the one solved; '
    if (self%plan%reduced) words = words//'unknowns of '//text(scene%bump_foil%bumps)// &
                                   ' bumps between their loaded lines, condensed exactly; '
  end function strip_left_out

  !> Frees what the solvers hold.
  subroutine discard_strip(self)
    class(refined_strip_type), intent(inout) :: self

    call destroy_newton(self%newton)
    call destroy_strip_system(self%strip)
  end subroutine discard_strip
end module gfb_strip_refinement
