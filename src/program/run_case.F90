#include "gfb_petsc.h"
!> One case file from reading to results.
module gfb_run_case
  use petscsys
  use gfb_case_text, only: read_standard_input
  use gfb_errors, only: error_type, fail
  use gfb_petsc_session, only: this_rank, rank_count
  use gfb_scene, only: scene_type
  use gfb_scene_reading, only: read_scene, read_scene_text
  use gfb_run_log, only: run_log_type
  use gfb_machine_memory, only: start_blas
  use gfb_text, only: text
  use gfb_quantity, only: quantity_type
  use gfb_solver_case, only: linear_solver_out_of_core
  use gfb_direct_solver, only: keep_factors_on_disk
  use gfb_command_line, only: command_line_type
  use gfb_provenance, only: version_text
  use gfb_run_context, only: run_context_type, prepare_folder
  use gfb_study, only: study_type, run_study
  use gfb_reduction_choice, only: choose_reduction
  use gfb_studies, only: create_study
  use gfb_check_scene, only: check_scene
  implicit none (type)
  private
  public :: run_case, run_scene

  character(len=*), parameter :: standard_input = '-' !! as a case file
  character(len=*), parameter :: its_name = 'stdin' !! in messages, and of the results

contains

  !> Reads the scene of a case file, or of the standard input, which the first rank alone has.
  !>
  !> Fails with all mistakes, one a line.
  subroutine read_input(file, strict, scene, error)
    character(len=*), intent(in) :: file !! name of the case file, `-` for the standard input
    logical, intent(in) :: strict !! warnings are mistakes
    type(scene_type), intent(out) :: scene !! what the case file asks for
    type(error_type), allocatable, intent(out) :: error !! why it failed
    character(len=:), allocatable :: words
    character(len=:), allocatable :: problem
    integer :: length(2), ierr

    if (file /= standard_input) then
      call read_scene(file, scene, error, strict)
      return
    end if
    words = ''
    problem = ''
    if (this_rank() == 0) call read_standard_input(words, problem)
    length = [len(words), len(problem)]
    call MPI_Bcast(length, 2, MPI_INTEGER, 0, PETSC_COMM_WORLD, ierr)
    if (this_rank() > 0) then
      words = repeat(' ', length(1))
      problem = repeat(' ', length(2))
    end if
    call MPI_Bcast(words, length(1), MPI_CHARACTER, 0, PETSC_COMM_WORLD, ierr)
    call MPI_Bcast(problem, length(2), MPI_CHARACTER, 0, PETSC_COMM_WORLD, ierr)
    if (problem /= '') then
      call fail(error, its_name//': '//problem)
    else
      call read_scene_text(words, its_name, scene, error, strict)
    end if
  end subroutine read_input

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
