!> What a run is given beside its scene: where its results and its log go, when it began, and
!> whether it resumes from a restart file.
module gfb_run_context
  use gfb_kinds, only: wp
  use gfb_c_library, only: make_folder
  use gfb_case_file, only: csv_settings_type
  use gfb_errors, only: error_type
  use gfb_run_log, only: run_log_type
  use gfb_petsc_session, only: this_rank, share_failure
  use gfb_provenance, only: provenance
  use gfb_quantity, only: quantity_type
  use gfb_scene, only: scene_type
  use gfb_text_file, only: try_folder
  use gfb_file_set, only: case_lock_type, lock_case, unlock_case
  use gfb_restart_file, only: restart_type, find_restart_file => find_restart
  implicit none (type, external)
  private
  public :: prepare_folder

  !> Somebody who wants to hear how far a run is, such as a job that is made of many.
  type, abstract, public :: run_listener_type
  contains
    procedure(hear), deferred :: point_done !! a point of a sweep has its answer
  end type run_listener_type

  abstract interface
    !> Hears of an event; all ranks report it.
    subroutine hear(self, words)
      import :: run_listener_type
      implicit none (type, external)
      class(run_listener_type), intent(inout) :: self !! the listener
      character(len=*), intent(in) :: words !! which point
    end subroutine hear
  end interface

  !> One run of the program, or of one of its groups of ranks.
  type, public :: run_context_type
    character(len=:), allocatable :: folder  !! where the results go
    character(len=:), allocatable :: command !! the whole command line
    character(len=:), allocatable :: petsc_options !! that were given; not allocated: not asked
    character(len=:), allocatable :: reduction !! that the program chose, and why; empty: none
    type(csv_settings_type) :: csv           !! history, motion or orbits as a table
    logical :: resumes = .false.             !! from the scene's restart file, where there is one
    real(wp) :: start_time = 0.0_wp          !! of the run [s]
    type(run_log_type) :: log
    type(restart_type) :: restart            !! of the scene, once it has been looked for
    class(run_listener_type), pointer :: listener => null()
    type(case_lock_type), private :: lock    !! of the scene's files, on the first rank
  contains
    procedure :: take_case, give_back, find_restart, origin, point_done
  end type run_context_type

contains

  !> Takes the files of a case for this run.
  !>
  !> Fails where another run writes them, and where their names would be too long.
  subroutine take_case(self, name, error)
    class(run_context_type), intent(inout) :: self !! the context
    character(len=*), intent(in) :: name !! of the case
    type(error_type), allocatable, intent(out) :: error !! why it failed
    character(len=:), allocatable :: left

    left = ''
    if (this_rank() == 0) call lock_case(self%folder, name, self%lock, left, error)
    call share_failure(error)
    if (left /= '') call self%log%warning(left)
  end subroutine take_case

  !> Gives the files of a case back.
  subroutine give_back(self)
    class(run_context_type), intent(inout) :: self !! the context
    call unlock_case(self%lock)
  end subroutine give_back

  !> Looks for a scene's restart file.
  !>
  !> Fails where the run is to resume from a file of another scene or program, or from a damaged
  !> one.
  subroutine find_restart(self, scene, error)
    class(run_context_type), intent(inout) :: self !! the context
    type(scene_type), intent(in) :: scene !! that the run solves
    type(error_type), allocatable, intent(out) :: error !! why it failed

    call find_restart_file(scene, self%folder, self%resumes, self%command, self%log, &
                           self%restart, error)
  end subroutine find_restart

  !> What the result files say of their origin.
  function origin(self) result(list)
    class(run_context_type), intent(in) :: self !! the context
    type(quantity_type), allocatable :: list(:)
    list = provenance(self%command, self%petsc_options, self%reduction)
  end function origin

  !> A point of a sweep has its answer: for who listens.
  subroutine point_done(self, words)
    class(run_context_type), intent(in) :: self !! the context
    character(len=*), intent(in) :: words !! which point
    if (associated(self%listener)) call self%listener%point_done(words)
  end subroutine point_done

  !> Makes the folder of the results if it is not there.
  !>
  !> Fails when nothing can be written there.
  subroutine prepare_folder(folder, error)
    character(len=*), intent(in) :: folder !! its path
    type(error_type), allocatable, intent(out) :: error !! why it failed

    if (this_rank() == 0) then
      call make_folder(folder)
      call try_folder(folder, error)
    end if
    call share_failure(error)
  end subroutine prepare_folder
end module gfb_run_context
