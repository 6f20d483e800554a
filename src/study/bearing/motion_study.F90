#include "gfb_petsc.h"
!> A bearing whose shaft moves, from its equilibrium on.
module gfb_motion_study
  use gfb_errors, only: error_type
  use gfb_scene, only: scene_type
  use gfb_case_file, only: case_array_type
  use gfb_run_context, only: run_context_type
  use gfb_motions, only: motion_type
  use gfb_bearing_study, only: bearing_study_type
  use gfb_onset, only: judge_first_point
  implicit none (type, external)
  private

  !> The bearing, and its shaft's motion.
  type, extends(bearing_study_type), public :: motion_study_type
    type(motion_type), allocatable, private :: motion !! once there is the equilibrium
  contains
    procedure :: find_answers => find_motion
    procedure :: add_arrays => add_motion
  end type motion_study_type

contains

  !> Finds where the shaft begins, and its motion from there.
  !>
  !> Fails when the mesh cannot be cut or a restart file cannot be read.
  subroutine find_motion(self, scene, context, error)
    class(motion_study_type), target, intent(inout) :: self !! the study
    type(scene_type), intent(in) :: scene !! with `&transient` or `&periodic`
    type(run_context_type), intent(in) :: context !! of the run
    type(error_type), allocatable, intent(out) :: error !! why it failed
    type(scene_type) :: first

    first = scene
    if (scene%transient%present) first%operation%load = scene%transient%start_load
    call self%bearing_study_type%find_answers(first, context, error)
    if (allocated(error) .or. self%reason%is_given()) return
    allocate (self%motion)
    associate (solution => self%solution)
      if (scene%transient%present .and. .not. context%restart%goes_on) call judge_first_point(solution)
      call self%motion%run(scene, context, solution%bearing, solution%newton, solution%record, self%reason, error)
      if (.not. allocated(error)) call solution%record%move_on(self%motion%results())
    end associate
  end subroutine find_motion

  !> Adds what was found of the motion.
  subroutine add_motion(self, arrays)
    class(motion_study_type), intent(in) :: self !! the study
    type(case_array_type), allocatable, intent(inout) :: arrays(:) !! get a dataset a name

    if (allocated(self%motion)) call self%motion%add_arrays(arrays)
  end subroutine add_motion
end module gfb_motion_study
