!> One case file from reading to results.
module gfb_run_case
  use gfb_errors, only: error_type
  use gfb_run_log, only: run_log_type
  use gfb_petsc_session, only: rank_count
  use gfb_machine_memory, only: start_blas
  use gfb_scene, only: scene_type
  use gfb_read_input, only: read_input
  use gfb_text, only: text
  use gfb_quantity, only: quantity_type
  use gfb_solver_case, only: linear_solver_out_of_core
  use gfb_direct_solver, only: keep_factors_on_disk
  use gfb_command_line, only: command_line_type
  use gfb_provenance, only: version_text
  use gfb_run_context, only: run_context_type, prepare_folder
  use gfb_study, only: study_type
  use gfb_run_study, only: run_study
  use gfb_reduction_choice, only: choose_reduction
  use gfb_studies, only: create_study
  use gfb_check_scene, only: check_scene
  implicit none (type, external)
  private
  public :: run_case, run_scene

contains

  !> Reads, checks, computes, writes.
  !>
  !> Fails on wrong input and on files that cannot be read or written.
  subroutine run_case(line, log, converged, error)
    type(command_line_type), intent(in) :: line !! what was typed
    type(run_log_type), intent(in) :: log !! where lines go
    logical, intent(out) :: converged !! there is an answer
    type(error_type), allocatable, intent(out) :: error !! why it failed
    type(scene_type), allocatable :: scene
    type(run_context_type) :: context
    class(study_type), allocatable :: study
    type(quantity_type), allocatable :: summary(:)
    logical :: only_look

    converged = .true.
    allocate (scene)
    context = line%context(log)
    call read_input(line%case_file, line%strict, scene, error)
    only_look = line%check .or. line%shares >= 0
    if (.not. allocated(error) .and. .not. only_look) call prepare_folder(line%folder, error)
    if (allocated(error)) return
    call choose_reduction(scene)
    if (only_look) then
      call check_scene(scene, line%shares, log, error)
    else
      call run_scene(scene, line%branches, context, study, summary, error)
      if (.not. allocated(error)) converged = study%converged
    end if
  end subroutine run_case

  !> Computes and writes what a scene asks for.
  !>
  !> Fails on files that cannot be written.
  subroutine run_scene(scene, branches, context, study, summary, error)
    type(scene_type), intent(in) :: scene !! what is asked for
    logical, intent(in) :: branches !! all equilibria are looked for
    type(run_context_type), intent(inout) :: context !! of the run; the restart file is looked for
    class(study_type), allocatable, intent(out) :: study        !! that was done
    type(quantity_type), allocatable, intent(out) :: summary(:) !! what was written of the answer
    type(error_type), allocatable, intent(out) :: error !! why it failed

    call context%log%line(version_text())
    call context%log%line(scene%file//': '//scene%general%title)
    call context%log%line('results go to '//context%folder//', '//text(rank_count())//' rank(s)')
    if (context%petsc_options /= '') then
      call context%log%line('options given to PETSc: '//context%petsc_options)
    end if
    if (scene%warnings /= '') call context%log%warned(scene%warnings)
    call start_blas()
    context%reduction = ''
    if (allocated(scene%model%reduction_reason)) then
      context%reduction = 'bumps '//scene%model%reduction_reason
    end if
    if (scene%solver%linear_solver == linear_solver_out_of_core) call keep_factors_on_disk()
    call create_study(scene, branches, study, error)
    if (.not. allocated(error)) call context%take_case(scene%name, error)
    if (allocated(error)) return
    if (scene%accuracy%present .or. scene%sample%present) then
      if (context%resumes) then
        call context%log%line('restart: not with &accuracy or &sample, the run starts anew')
      end if
    else if (.not. branches) then
      call context%find_restart(scene, error)
    end if
    if (.not. allocated(error)) call run_study(study, scene, context, summary, error)
    call context%give_back()
  end subroutine run_scene
end module gfb_run_case
