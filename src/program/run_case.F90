#include "gfb_petsc.h"
!> One case file from reading to results.
module gfb_run_case
  use petscsys
  use gfb_case_text, only: read_case_text, read_standard_input
  use gfb_errors, only: error_type, fail
  use gfb_petsc_session, only: this_rank
  use gfb_scene, only: scene_type
  use gfb_scene_reading, only: read_scene_text
  use gfb_run_log, only: run_log_type
  use gfb_quantity, only: quantity_type
  use gfb_command_line, only: command_line_type
  use gfb_run_context, only: run_context_type, prepare_folder
  use gfb_study, only: study_type
  use gfb_foil_plan, only: choose_solution
  use gfb_studies, only: create_study, run_scene
  use gfb_check_scene, only: check_scene
  implicit none (type)
  private
  public :: run_case, read_input

  character(len=*), parameter :: standard_input = '-' !! as a case file
  character(len=*), parameter :: its_name = 'stdin' !! in messages, and of the results

contains

  !> Reads the text of a case file, or of the standard input, which the first rank alone has.
  !>
  !> Fails where there is no such file, or it is none of text.
  subroutine read_input(file, words, name, error)
    character(len=*), intent(in) :: file !! name of the case file, `-` for the standard input
    character(len=:), allocatable, intent(out) :: words !! of the whole file
    character(len=:), allocatable, intent(out) :: name !! of the file, for messages
    type(error_type), allocatable, intent(out) :: error !! why it failed
    character(len=:), allocatable :: problem
    integer :: length(2), ierr

    name = file
    if (file /= standard_input) then
      call read_case_text(file, words, error)
      return
    end if
    name = its_name
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
    if (problem /= '') call fail(error, its_name//': '//problem)
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
    character(len=:), allocatable :: words, name
    type(quantity_type), allocatable :: summary(:)
    logical :: only_look

    converged = .true.
    allocate (scene)
    context = line%context(log)
    call read_input(line%case_file, words, name, error)
    if (.not. allocated(error)) call read_scene_text(words, name, scene, error, line%strict)
    only_look = line%check .or. line%shares >= 0
    if (.not. allocated(error) .and. .not. only_look) call prepare_folder(line%folder, error)
    if (allocated(error)) return
    call choose_solution(scene)
    if (only_look) then
      call create_study(scene, line%branches, study, error)
      if (.not. allocated(error)) call check_scene(scene, study, line%shares, log, error)
    else
      call run_scene(scene, line%branches, context, study, summary, error)
      if (.not. allocated(error)) converged = study%converged
    end if
  end subroutine run_case
end module gfb_run_case
