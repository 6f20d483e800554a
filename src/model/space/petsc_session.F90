#include "gfb_petsc.h"
!> Start and end of PETSc, SLEPc and MPI, and what they say of themselves.
module gfb_petsc_session
  use, intrinsic :: iso_c_binding, only: c_char, c_loc, c_null_char, c_ptr, c_size_t, c_int
  use petscsys
  use slepcsys
  use petscvec
  use gfb_kinds, only: wp
  use gfb_errors, only: error_type, fail
  use gfb_text, only: text
  use gfb_signals, only: catch_signals, received_signal, agree_on_signal, stop_agreed
  use gfb_petsc_kinds, only: preal, pint
  implicit none (type)
  private
  public :: given_petsc_options, solver_options, gfb_start_mpi, start_petsc, stop_petsc, this_rank, rank_count, &
            ranks_on_node, petsc_version_text, wall_time, sum_over_ranks, largest_over_ranks, largest_number, any_rank, &
            share_failure, fetch_entries, stop_is_asked

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

  interface
    !> Starts MPI where it has not started; where it cannot, a sentence and status 3. A process that no launcher has started does
    !> without Open MPI's helper daemon, and without what it does not use; settings of the current folder count for none.
    subroutine gfb_start_mpi() bind(c)
    end subroutine gfb_start_mpi

    !> Starts PETSc, SLEPc, and MPI where it has not started.
    function gfb_start_slepc(communicator, words, length) result(status) bind(c)
      import
      implicit none (type)
      integer, value :: communicator     !! of this group of ranks, where MPI has started
      type(c_ptr), value :: words        !! the program's name and options for PETSc, a zero behind each
      integer(c_size_t), value :: length !! characters of all
      PetscErrorCode :: status
    end function gfb_start_slepc

    !> Makes what a library cannot do end the program with a sentence and status 3.
    function gfb_end_with_sentences() result(status) bind(c)
      import :: c_int
      integer(c_int) :: status !! PETSc's error code, 0 for none
    end function gfb_end_with_sentences

    !> Whether PETSc's complaints may be mistakes of the program's: not while PETSc starts or ends.
    subroutine gfb_computing(now) bind(c)
      import :: c_int
      integer(c_int), value :: now
    end subroutine gfb_computing
  end interface

contains

  !> What the environment (PETSC_OPTIONS), an options file or the command line has set otherwise for PETSc; empty
  !> where nothing. To be asked before the program sets options itself.
  function given_petsc_options() result(words)
    character(len=:), allocatable :: words
    character(kind=c_char), allocatable, target :: all(:)
    character(len=:), allocatable :: line
    PetscErrorCode :: ierr
    integer :: i

    allocate (all(longest))
    ierr = gfb_all_options(c_loc(all), int(longest, c_size_t))
    if (ierr /= 0) error stop 'PETSc does not list its options'
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

  !> Starts MPI, PETSc and SLEPc.
  subroutine start_petsc(words)
    !> the program's name and options that were typed for PETSc, a zero character behind each
    character(len=*, kind=c_char), intent(in), optional :: words
    character(kind=c_char), allocatable, target :: typed(:)
    PetscBool :: given
    PetscErrorCode :: ierr
    integer :: i

    typed = [character(kind=c_char) :: 'g', 'f', 'b', c_null_char]
    if (present(words)) typed = [(words(i:i), i = 1, len(words))]
    if (gfb_end_with_sentences() /= 0) error stop 'PETSc takes no handler of errors'
    if (gfb_start_slepc(PETSC_COMM_WORLD, c_loc(typed), size(typed, kind=c_size_t)) /= 0) error stop 'PETSc could not be started'
    call gfb_computing(1_c_int)
    ! Newer versions complain at the end of every option that is not theirs, as the program's own are.
    PetscCallA(PetscOptionsHasName(PETSC_NULL_OPTIONS, PETSC_NULL_CHARACTER, '-options_left', given, ierr))
    if (.not. given) then
      PetscCallA(PetscOptionsSetValue(PETSC_NULL_OPTIONS, '-options_left', 'no', ierr))
    end if
    if (storage_size(0.0_wp) /= storage_size(0.0_preal)) then
      error stop 'this PETSc was not built for double precision'
    end if
    call catch_signals() ! PETSc's own handlers abort
  end subroutine start_petsc

  !> Ends SLEPc, PETSc and MPI.
  subroutine stop_petsc(well)
    logical, intent(out), optional :: well !! they have done what options ask them to do at the end
    PetscErrorCode :: ierr

    call gfb_computing(0_c_int)
    ierr = 0 ! SLEPc 3.18 reads it before it sets it
    call SlepcFinalize(ierr)
    if (present(well)) well = ierr == 0
  end subroutine stop_petsc

  !> This process' rank, from 0.
  integer function this_rank() result(rank)
    PetscErrorCode :: ierr
    call MPI_Comm_rank(PETSC_COMM_WORLD, rank, ierr)
  end function this_rank

  !> Ranks of the job.
  integer function rank_count() result(ranks)
    PetscErrorCode :: ierr
    call MPI_Comm_size(PETSC_COMM_WORLD, ranks, ierr)
  end function rank_count

  !> Ranks that share the memory of a machine, on the machine with most of them.
  integer function ranks_on_node() result(ranks)
    GFB_COMM :: node
    integer :: here
    PetscErrorCode :: ierr

    call MPI_Comm_split_type(PETSC_COMM_WORLD, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, node, ierr)
    call MPI_Comm_size(node, here, ierr)
    call MPI_Comm_free(node, ierr)
    ranks = nint(maxval(largest_over_ranks([real(here, wp)])))
  end function ranks_on_node

  !> Versions of PETSc and SLEPc.
  function petsc_version_text() result(words)
    character(len=:), allocatable :: words
    PetscInt :: major, minor, subminor, release
    PetscErrorCode :: ierr

    call PetscGetVersionNumber(major, minor, subminor, release, ierr)
    words = 'PETSc '//text(int(major))//'.'//text(int(minor))//'.'//text(int(subminor))
    call SlepcGetVersionNumber(major, minor, subminor, release, ierr)
    words = words//', SLEPc '//text(int(major))//'.'//text(int(minor))//'.'//text(int(subminor))
  end function petsc_version_text

  !> Wall-clock time since an arbitrary moment [s].
  real(wp) function wall_time() result(seconds)
    seconds = MPI_Wtime()
  end function wall_time

  !> Sum of each number over all ranks.
  function sum_over_ranks(numbers) result(total)
    real(wp), intent(in) :: numbers(:) !! of this rank, as many on every rank, in any unit [SI]
    real(wp) :: total(size(numbers))
    PetscErrorCode :: ierr
    call MPI_Allreduce(numbers, total, size(numbers), MPI_DOUBLE_PRECISION, MPI_SUM, PETSC_COMM_WORLD, ierr)
  end function sum_over_ranks

  !> Largest of each number over all ranks.
  function largest_over_ranks(numbers) result(largest)
    real(wp), intent(in) :: numbers(:) !! of this rank, as many on every rank, in any unit [SI]
    real(wp) :: largest(size(numbers))
    PetscErrorCode :: ierr
    call MPI_Allreduce(numbers, largest, size(numbers), MPI_DOUBLE_PRECISION, MPI_MAX, PETSC_COMM_WORLD, ierr)
  end function largest_over_ranks

  !> The largest of numbers from 1 on all ranks, 0 where there are none.
  integer function largest_number(number) result(largest)
    integer, intent(in) :: number(:) !! of this rank
    largest = nint(maxval(largest_over_ranks([real(maxval([0, number]), wp)])))
  end function largest_number

  !> Whether something is true on any rank.
  logical function any_rank(truth) result(any_true)
    logical, intent(in) :: truth !! of this rank
    PetscErrorCode :: ierr
    call MPI_Allreduce(truth, any_true, 1, MPI_LOGICAL, MPI_LOR, PETSC_COMM_WORLD, ierr)
  end function any_rank

  !> Whether a signal or the time limit asks the run to stop, on any rank; all ranks ask at the same point.
  logical function stop_is_asked() result(asked)
    PetscErrorCode :: ierr
    integer :: signal

    if (.not. stop_agreed()) then
      call MPI_Allreduce(received_signal(), signal, 1, MPI_INTEGER, MPI_MAX, PETSC_COMM_WORLD, ierr)
      call agree_on_signal(signal)
    end if
    asked = stop_agreed()
  end function stop_is_asked

  !> Makes a failure on one rank a failure on all.
  subroutine share_failure(error)
    type(error_type), allocatable, intent(inout) :: error !! of this rank; on return of all, if one failed
    integer :: status

    status = 0
    if (allocated(error)) status = error%status
    status = largest_number([status])
    if (status > 0 .and. .not. allocated(error)) call fail(error, 'another rank failed')
    if (allocated(error)) error%status = status
  end subroutine share_failure

  !> Entries of a field that is spread over the ranks, by the entries' numbers in the whole.
  function fetch_entries(total, number, value, wanted) result(fetched)
    integer, intent(in) :: total         !! entries of all ranks
    integer, intent(in) :: number(:)     !! of the entries this rank gives, from 1
    real(wp), intent(in) :: value(:, :)  !! (components, entries given) in any unit [SI]
    integer, intent(in) :: wanted(:)     !! numbers of the entries this rank gets, from 1
    real(wp) :: fetched(size(value, 1), size(wanted))

    Vec :: ordered, part
    IS :: from
    VecScatter :: fetch
    PetscScalar, pointer :: values(:)
    PetscErrorCode :: ierr
    integer :: components

    components = size(value, 1)
    if (rank_count() == 1) then
      call fetch_here(total, number, value, wanted, fetched)
      return
    end if
    PetscCallA(VecCreate(PETSC_COMM_WORLD, ordered, ierr))
    PetscCallA(VecSetSizes(ordered, PETSC_DECIDE, int(components*total, pint), ierr))
    PetscCallA(VecSetType(ordered, VECSTANDARD, ierr))
    PetscCallA(VecSetValues(ordered, int(size(value), pint), spread_numbers(number, components), reshape(value, [size(value)]), INSERT_VALUES, ierr))
    PetscCallA(VecAssemblyBegin(ordered, ierr))
    PetscCallA(VecAssemblyEnd(ordered, ierr))
    PetscCallA(VecCreateSeq(PETSC_COMM_SELF, int(size(fetched), pint), part, ierr))
    PetscCallA(ISCreateGeneral(PETSC_COMM_SELF, int(size(fetched), pint), spread_numbers(wanted, components), PETSC_COPY_VALUES, from, ierr))
    PetscCallA(VecScatterCreate(ordered, from, part, PETSC_NULL_IS, fetch, ierr))
    PetscCallA(VecScatterBegin(fetch, ordered, part, INSERT_VALUES, SCATTER_FORWARD, ierr))
    PetscCallA(VecScatterEnd(fetch, ordered, part, INSERT_VALUES, SCATTER_FORWARD, ierr))
    PetscCallA(GFB_VecGetArrayRead(part, values, ierr))
    fetched = reshape(values, shape(fetched))
    PetscCallA(GFB_VecRestoreArrayRead(part, values, ierr))
    PetscCallA(VecScatterDestroy(fetch, ierr))
    PetscCallA(ISDestroy(from, ierr))
    PetscCallA(VecDestroy(part, ierr))
    PetscCallA(VecDestroy(ordered, ierr))
  end function fetch_entries

  !> The same where all entries are this rank's: no messages, whose preparation costs more than they do.
  pure subroutine fetch_here(total, number, value, wanted, fetched)
    integer, intent(in) :: total, number(:)
    real(wp), intent(in) :: value(:, :)
    integer, intent(in) :: wanted(:)
    real(wp), intent(out) :: fetched(:, :)
    real(wp) :: ordered(size(value, 1), total)

    ordered = 0.0_wp
    ordered(:, number) = value
    fetched = ordered(:, wanted)
  end subroutine fetch_here

  !> Numbers, from 0, of the components of entries that are numbered from 1.
  pure function spread_numbers(number, components) result(list)
    integer, intent(in) :: number(:), components
    PetscInt :: list(components*size(number))
    integer :: i, k

    do i = 1, size(number)
      list((i - 1)*components + 1:i*components) = [((number(i) - 1)*components + k - 1, k=1, components)]
    end do
  end function spread_numbers
end module gfb_petsc_session
