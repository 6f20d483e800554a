!> A scene on one of several nested meshes: what it must do to be refined until a number is known
!> well enough.
module gfb_refined_run
  use gfb_kinds, only: wp
  use gfb_errors, only: error_type
  use gfb_quantity, only: quantity_type
  use gfb_run_log, only: run_log_type
  use gfb_scene, only: scene_type
  implicit none (type, external)
  private

  !> An answer on one mesh, with all that is needed to write it.
  type, abstract, public :: refined_run_type
    type(quantity_type), allocatable :: found(:) !! numbers of the answer
    logical :: converged = .false.               !! there is one
    integer :: unknowns = 0
    integer :: iterations = 0                    !! of Newton, in all
    integer :: factorizations = 0                !! in all
  contains
    procedure(prepare_run), deferred :: prepare  !! says what the mesh needs
    procedure(solve_run), deferred :: solve      !! finds the answer
    procedure(write_run), deferred :: write      !! writes the result files
    procedure(describe_run), deferred :: left_out !! what the model leaves out, and why
    procedure(discard_run), deferred :: discard  !! gives the memory back
  end type refined_run_type

  abstract interface
    !> Plans the run. Fails where the machine has too little memory.
    subroutine prepare_run(self, scene, log, error)
      import :: refined_run_type, scene_type, run_log_type, error_type
      implicit none (type, external)
      class(refined_run_type), intent(inout) :: self
      type(scene_type), intent(in) :: scene
      type(run_log_type), intent(in) :: log
      type(error_type), allocatable, intent(out) :: error
    end subroutine prepare_run

    !> Finds the answer, after `prepare`. No answer is no error. Fails when the mesh cannot be made.
    subroutine solve_run(self, scene, log, error)
      import :: refined_run_type, scene_type, run_log_type, error_type
      implicit none (type, external)
      class(refined_run_type), target, intent(inout) :: self
      type(scene_type), intent(in) :: scene
      type(run_log_type), intent(in) :: log
      type(error_type), allocatable, intent(out) :: error
    end subroutine solve_run

    !> Writes everything, after `solve`. Fails when a file cannot be written.
    subroutine write_run(self, scene, folder, command, start_time, good, more, log, summary, error)
      import :: refined_run_type, scene_type, run_log_type, error_type, quantity_type, wp
      implicit none (type, external)
      class(refined_run_type), intent(inout) :: self
      type(scene_type), intent(in) :: scene
      character(len=*), intent(in) :: folder       !! where the results go
      character(len=*), intent(in) :: command      !! the whole command line
      real(wp), intent(in) :: start_time           !! of the run [s]
      logical, intent(in) :: good                  !! it is the answer, as well known as asked for
      type(quantity_type), intent(in) :: more(:)   !! for the summary
      type(run_log_type), intent(in) :: log
      type(quantity_type), allocatable, intent(out) :: summary(:)
      type(error_type), allocatable, intent(out) :: error
    end subroutine write_run

    !> What the model leaves out, and why, as parts of a sentence, each with a semicolon behind.
    function describe_run(self, scene) result(words)
      import :: refined_run_type, scene_type
      implicit none (type, external)
      class(refined_run_type), intent(in) :: self
      type(scene_type), intent(in) :: scene !! as the case has it
      character(len=:), allocatable :: words
    end function describe_run

    !> Frees what the solvers hold.
    subroutine discard_run(self)
      import :: refined_run_type
      implicit none (type, external)
      class(refined_run_type), intent(inout) :: self
    end subroutine discard_run
  end interface
end module gfb_refined_run
