#include "gfb_petsc.h"
!> The case file, which may come from the standard input.
module gfb_read_input
  use petscsys
  use gfb_case_text, only: read_standard_input
  use gfb_errors, only: error_type, fail
  use gfb_petsc_session, only: this_rank
  use gfb_scene, only: scene_type
  use gfb_scene_reading, only: read_scene, read_scene_text
  implicit none (type)
  private
  public :: read_input

  character(len=*), parameter, public :: standard_input = '-' !! as a case file
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
end module gfb_read_input
