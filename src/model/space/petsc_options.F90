#include "gfb_petsc.h"
!> Options of PETSc's that the user has given, which can change how a scene is solved.
module gfb_petsc_options
  use, intrinsic :: iso_c_binding, only: c_char, c_loc, c_null_char, c_ptr, c_size_t
  use petscsys
  implicit none (type)
  private
  public :: given_petsc_options, solver_options

  integer, parameter :: longest = 10000 !! characters of all options
  !> Beginnings of options that only report, or are the program's own.
  character(len=*), parameter :: harmless(*) = [character(len=13) :: '--', '-log', '-options_', '-malloc', '-memory', &
    '-info', '-help', '-on_error', '-skip_petscrc', '-display', '-petsc_ci', '-nox', '-error_output']
  !> Ends of options that only report.
  character(len=*), parameter :: reports(*) = [character(len=17) :: '_view', '_monitor', '_converged_reason']

  interface
    !> All options that PETSc knows now.
    function gfb_all_options(words, length) result(status) bind(c)
      import
      implicit none (type)
      type(c_ptr), value :: words        !! where names and values go, ended by a zero
      integer(c_size_t), value :: length !! characters there is room for
      PetscErrorCode :: status
    end function gfb_all_options
  end interface

contains

  !> What the environment (PETSC_OPTIONS), an options file or the command line has told PETSc to do otherwise; empty
  !> where nothing. To be asked before the program sets options itself.
  function given_petsc_options() result(words)
    character(len=:), allocatable :: words
    character(kind=c_char), allocatable, target :: all(:)
    character(len=:), allocatable :: line
    PetscErrorCode :: ierr
    integer :: i

    allocate (all(longest))
    ierr = gfb_all_options(c_loc(all), int(longest, c_size_t))
    if (ierr /= 0) error stop 'PETSc does not tell its options'
    line = repeat(' ', longest)
    do i = 1, longest
      if (all(i) == c_null_char) exit
      line(i:i) = all(i)
    end do
    words = solver_options(trim(line))
  end function given_petsc_options

  !> Those of a line of options that can change an answer or its cost.
  pure function solver_options(line) result(words)
    character(len=*), intent(in) :: line !! options with their values, blanks between
    character(len=:), allocatable :: words
    character(len=:), allocatable :: left, word
    integer :: blank
    logical :: counts

    words = ''
    left = trim(adjustl(line))
    counts = .false.
    do while (left /= '')
      blank = index(left//' ', ' ')
      word = left(:blank - 1)
      left = trim(adjustl(left(blank:)))
      if (is_option(word)) counts = .not. is_harmless(word)
      if (counts) words = words//' '//word
    end do
    words = trim(adjustl(words))
  end function solver_options

  !> Whether a word is an option's name: a value may be a negative number.
  pure function is_option(word)
    character(len=*), intent(in) :: word
    logical :: is_option

    is_option = .false.
    if (len(word) > 1) is_option = word(1:1) == '-' .and. verify(word(2:2), '0123456789.') > 0
  end function is_option

  !> Whether an option changes no answer.
  pure function is_harmless(name)
    character(len=*), intent(in) :: name
    logical :: is_harmless
    integer :: i, before

    is_harmless = .false.
    do i = 1, size(harmless)
      if (index(name, trim(harmless(i))) == 1) is_harmless = .true.
    end do
    do i = 1, size(reports)
      before = len(name) - len_trim(reports(i))
      if (before < 1) cycle
      if (name(before + 1:) == reports(i)) is_harmless = .true.
    end do
  end function is_harmless
end module gfb_petsc_options
