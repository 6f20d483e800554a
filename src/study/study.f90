!> A study: what an analysis does with a scene, from what it needs to the files it writes; and its
!> run from answer to answer where there are several: points of a sweep, load steps of a strip.
module gfb_study
  use gfb_kinds, only: wp
  use gfb_errors, only: error_type
  use gfb_quantity, only: quantity_type
  use gfb_run_log, only: run_log_type
  use gfb_scene, only: scene_type
  use gfb_memory_check, only: check_memory
  use gfb_signals, only: stop_agreed
  use gfb_petsc_session, only: stop_is_asked
  use gfb_reasons, only: reason_type
  use gfb_run_context, only: run_context_type
  use gfb_cost_events, only: enter_stage, leave_stage
  use gfb_restart_file, only: drop_restart
  implicit none (type, external)
  private
  public :: run_study, run_points

  !> One analysis of one scene. It stays where it is from `solve` to `discard`: solvers point into
  !> it.
  type, abstract, public :: study_type
    character(len=24) :: heading = 'solution'    !! of the log while it solves; empty: its own
    real(wp) :: memory = 0.0_wp                  !! that its equations take, after `prepare` [B]
    logical :: converged = .false.               !! there is an answer, after `solve`
    type(reason_type) :: reason                  !! why there is none
    type(quantity_type), allocatable :: found(:) !! numbers of the answer, for a refinement
    real(wp), allocatable :: coefficients(:)     !! stiffness and damping, for a refinement [SI]
    real(wp), allocatable :: coefficient_errors(:) !! of these, to be written [SI]
    integer :: unknowns = 0
    integer :: iterations = 0                    !! of Newton, in all
    integer :: factorizations = 0                !! in all
    integer :: factorizations_finest = 0         !! of the matrix of the finest mesh
    type(quantity_type), allocatable :: more(:)  !! what the summary is to say beside the answer
  contains
    procedure(prepare_study), deferred :: prepare !! says what the scene needs
    procedure :: check => check_study             !! refuses what the machine cannot hold
    procedure(solve_study), deferred :: solve     !! finds the answer
    procedure(write_study), deferred :: write     !! writes the result files
    procedure :: left_out => nothing_left_out     !! what the model leaves out, and why
    procedure(discard_study), deferred :: discard !! gives the memory back
    procedure :: reach => reach_nothing      !! finds the answer of a point from the last point's
    procedure :: record_point => pass_point  !! records it
    procedure :: save_point => pass_point    !! for a restart, where that is due
    procedure :: save_stopped => pass_point  !! for a restart, where the run stops behind a point
  end type study_type

  abstract interface
    !> Plans the study, and logs why.
    subroutine prepare_study(self, scene, log)
      import :: study_type, scene_type, run_log_type
      implicit none (type, external)
      class(study_type), intent(inout) :: self !! the study
      type(scene_type), intent(in) :: scene !! that is asked for
      type(run_log_type), intent(in) :: log !! where lines go
    end subroutine prepare_study

    !> Finds the answer, after `prepare`. No answer is a reason and no error.
    !>
    !> Fails when the equations cannot be set up or a restart file cannot be read.
    subroutine solve_study(self, scene, context, error)
      import :: study_type, scene_type, run_context_type, error_type
      implicit none (type, external)
      class(study_type), target, intent(inout) :: self !! the study
      type(scene_type), intent(in) :: scene !! that is asked for
      type(run_context_type), intent(in) :: context !! of the run
      type(error_type), allocatable, intent(out) :: error !! why it failed
    end subroutine solve_study

    !> Writes everything, after `solve`.
    !>
    !> Fails when a file cannot be written.
    subroutine write_study(self, scene, context, summary, error)
      import :: study_type, scene_type, run_context_type, error_type, quantity_type
      implicit none (type, external)
      class(study_type), target, intent(inout) :: self !! the study
      type(scene_type), intent(in) :: scene !! that is asked for
      type(run_context_type), intent(in) :: context !! of the run
      type(quantity_type), allocatable, intent(out) :: summary(:) !! what the summary says
      type(error_type), allocatable, intent(out) :: error !! why it failed
    end subroutine write_study

    !> Frees what the solvers hold; may be called where nothing was solved.
    subroutine discard_study(self)
      import :: study_type
      implicit none (type, external)
      class(study_type), intent(inout) :: self !! the study
    end subroutine discard_study
  end interface

contains

  !> Checks, after `prepare`, whether the study can be done.
  !>
  !> Fails where the machine has too little memory.
  subroutine check_study(self, scene, error)
    class(study_type), intent(in) :: self !! the study
    type(scene_type), intent(in) :: scene !! that is asked for
    type(error_type), allocatable, intent(out) :: error !! what is lacking
    call check_memory(scene, self%memory, error)
  end subroutine check_study

  !> What the model leaves out, and why, as parts of a sentence, each with a semicolon behind.
  function nothing_left_out(self, scene) result(words)
    class(study_type), intent(in) :: self !! the study
    type(scene_type), intent(in) :: scene !! as the case has it
    character(len=:), allocatable :: words
    words = ''
  end function nothing_left_out

  !> A study of one answer has no further point. Without an answer a study is left at the last state
  !> that it has reached.
  !>
  !> Fails where the equations of the point cannot be set up.
  subroutine reach_nothing(self, point, reason, error)
    class(study_type), target, intent(inout) :: self !! the study
    integer, intent(in) :: point             !! number, from 1
    type(reason_type), intent(out) :: reason !! why there is no answer
    type(error_type), allocatable, intent(out) :: error !! why it failed
  end subroutine reach_nothing

  !> Nothing is to be done at a point that has its answer.
  subroutine pass_point(self, point)
    class(study_type), target, intent(inout) :: self !! the study
    integer, intent(in) :: point !! number, from 1
  end subroutine pass_point

  !> Runs from a point to another; the first without an answer ends the run, and so does a signal.
  !>
  !> Fails where a point does.
  subroutine run_points(study, first, last, reason, error)
    class(study_type), target, intent(inout) :: study !! left at the last answer
    integer, intent(in) :: first, last       !! points; none where the last lies before the first
    type(reason_type), intent(out) :: reason !! why it has ended before its last point
    type(error_type), allocatable, intent(out) :: error !! why it failed
    integer :: point

    do point = first, last
      if (.not. stop_is_asked()) call study%reach(point, reason, error)
      if (allocated(error)) return
      if (stop_agreed()) then
        call reason%stopped()
        call study%save_stopped(point - 1)
      end if
      if (reason%is_given()) return
      call study%record_point(point)
      call study%save_point(point)
    end do
  end subroutine run_points

  !> Plans, checks, solves, writes and discards; a restart file goes when its run has ended well.
  !>
  !> Fails where the scene cannot be computed, and when a file cannot be written.
  subroutine run_study(study, scene, context, summary, error)
    class(study_type), target, intent(inout) :: study !! which says whether it has an answer
    type(scene_type), intent(in) :: scene !! that is asked for
    type(run_context_type), intent(in) :: context !! of the run
    type(quantity_type), allocatable, intent(out) :: summary(:) !! what was written of the answer
    type(error_type), allocatable, intent(out) :: error !! why it failed

    call study%prepare(scene, context%log)
    call study%check(scene, error)
    if (.not. allocated(error)) then
      if (study%heading /= '') call context%log%heading(trim(study%heading))
      call study%solve(scene, context, error)
    end if
    if (.not. allocated(error)) then
      call enter_stage('output')
      call study%write(scene, context, summary, error)
      call leave_stage()
    end if
    if (study%reason%is_stop()) call context%log%tell(study%reason%words())
    if (study%converged .and. .not. allocated(error)) call drop_restart(context%restart)
    call study%discard()
  end subroutine run_study
end module gfb_study
