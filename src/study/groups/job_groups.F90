#include "gfb_petsc.h"
!> A job that is divided into groups of ranks, each of which is a gfb of its own.
!>
!> The world of PETSc, and of everything else here, is a group's ranks. What the groups share, which
!> member is next and how many are done, is a window of memory on the job's first rank that the groups'
!> first ranks read and change without that rank's help, so that none waits for another that computes.
module gfb_job_groups
  use petscsys
  use, intrinsic :: iso_fortran_env, only: output_unit
  use gfb_kinds, only: wp, long
  use gfb_archive, only: archive_type, open_archive
  use gfb_text, only: text
  use gfb_petsc_session, only: gfb_started, gfb_watch_start
  use gfb_division, only: block_ends, owner_of
  use gfb_run_context, only: run_listener_type
  implicit none (type)
  private
  public :: start_job, stop_job

  integer(MPI_ADDRESS_KIND), parameter :: taken = 0, done = 1 !! numbers of the window: members taken, and done
  integer(MPI_ADDRESS_KIND), parameter :: numbers = 2
  integer, parameter :: number_bytes = storage_size(0_long)/8
  real(wp), parameter :: a_minute = 60.0_wp, an_hour = 3600.0_wp !! [s]

  !> The job and this rank's number in it.
  type, extends(run_listener_type), public :: job_type
    integer :: groups = 0     !! that were asked for; 0 where the job is one gfb
    integer :: group = 1      !! this rank's, from 1
    integer :: ranks = 1      !! of the whole job
    integer :: rank = 0       !! this one's in it, from 0
    logical :: leads = .true. !! it is the first rank of its group
    logical :: split = .false. !! there are ranks enough for the groups
    integer :: total = 0      !! of what is to be done by all groups
    integer :: counted = 0    !! points of this group's sweep that are still to be counted
    real(wp) :: begun = 0.0_wp !! when the groups began [s]
    integer, private :: window = 0
  contains
    procedure :: point_done => count_point
    procedure :: report
    procedure :: next_member
    procedure :: collect
    procedure :: largest
    procedure :: total_of
  end type job_type

contains

  !> Starts MPI and divides the ranks, before PETSc is started; does nothing where no groups are asked
  !> for, and divides nothing where ranks are too few.
  subroutine start_job(groups, job)
    integer, intent(in) :: groups !! 0: none asked for
    type(job_type), intent(out) :: job !! with this rank's number in it
    GFB_COMM :: part
    integer(MPI_ADDRESS_KIND) :: bytes, base
    integer :: provided, ierr

    job%groups = groups
    if (groups == 0) return
    call gfb_watch_start()
    call MPI_Init_thread(MPI_THREAD_FUNNELED, provided, ierr)
    call gfb_started()
    call MPI_Comm_size(MPI_COMM_WORLD, job%ranks, ierr)
    call MPI_Comm_rank(MPI_COMM_WORLD, job%rank, ierr)
    job%split = job%ranks >= groups
    job%leads = job%rank == 0
    if (.not. job%split) return
    job%group = owner_of(job%rank + 1, job%ranks, groups)
    job%leads = job%rank == first_rank(job, job%group)
    call MPI_Comm_split(MPI_COMM_WORLD, job%group, job%rank, part, ierr)
    PETSC_COMM_WORLD = part
    bytes = merge(number_bytes*numbers, 0_MPI_ADDRESS_KIND, job%rank == 0)
    call MPI_Win_allocate(bytes, number_bytes, MPI_INFO_NULL, MPI_COMM_WORLD, base, job%window, ierr)
    call MPI_Win_lock_all(0, job%window, ierr)
    if (job%rank == 0) call clear(job)
    call MPI_Barrier(MPI_COMM_WORLD, ierr)
    job%begun = MPI_Wtime()
  end subroutine start_job

  !> Sets the shared numbers to zero.
  subroutine clear(job)
    type(job_type), intent(in) :: job
    integer(long) :: zeros(numbers)
    integer :: ierr

    zeros = 0
    call MPI_Accumulate(zeros, int(numbers), MPI_INTEGER8, 0, taken, int(numbers), MPI_INTEGER8, MPI_REPLACE, job%window, ierr)
    call MPI_Win_flush(0, job%window, ierr)
  end subroutine clear

  !> Ends MPI, after PETSc has ended.
  subroutine stop_job(job)
    type(job_type), intent(inout) :: job !! that has ended
    integer :: ierr

    if (job%groups == 0) return
    if (job%split) then
      call MPI_Win_unlock_all(job%window, ierr)
      call MPI_Win_free(job%window, ierr)
    end if
    call MPI_Finalize(ierr)
  end subroutine stop_job

  !> Rank, in the job, that leads a group.
  pure function first_rank(job, group) result(rank)
    type(job_type), intent(in) :: job
    integer, intent(in) :: group !! from 1
    integer :: rank
    integer :: ends(2)

    ends = block_ends(job%ranks, job%groups, group)
    rank = ends(1) - 1
  end function first_rank

  !> A point of this group's sweep is done; those it computes for comparison only are not counted.
  subroutine count_point(self, words)
    class(job_type), intent(inout) :: self !! the job
    character(len=*), intent(in) :: words !! which point

    if (self%counted < 1) return
    self%counted = self%counted - 1
    call self%report(words, 1)
  end subroutine count_point

  !> A line for the terminal: how many are done, how long it will take, what this group has done.
  subroutine report(self, words, number)
    class(job_type), intent(in) :: self !! the job
    character(len=*), intent(in) :: words !! what was done
    integer, intent(in) :: number !! of what is done with this
    character(len=:), allocatable :: line
    real(wp) :: seconds
    integer :: so_far

    if (.not. self%leads) return
    so_far = int(add_to(self, done, int(number, long))) + number
    line = text(so_far)//' of '//text(self%total)//' done, '
    if (so_far > 0 .and. so_far < self%total) then
      seconds = (MPI_Wtime() - self%begun)/real(so_far, wp)*real(self%total - so_far, wp)
      line = line//'about '//time_text(seconds)//' left, '
    end if
    write (output_unit, '(a)') line//'group '//text(self%group)//': '//words
    flush (output_unit)
  end subroutine report

  !> A time in the unit that fits it.
  pure function time_text(seconds) result(words)
    real(wp), intent(in) :: seconds
    character(len=:), allocatable :: words

    if (seconds < 1.5_wp*a_minute) then
      words = text(seconds, 2)//' s'
    else if (seconds < 1.5_wp*an_hour) then
      words = text(seconds/a_minute, 2)//' min'
    else
      words = text(seconds/an_hour, 2)//' h'
    end if
  end function time_text

  !> Adds to a shared number.
  function add_to(job, which, number) result(before)
    class(job_type), intent(in) :: job
    integer(MPI_ADDRESS_KIND), intent(in) :: which !! `taken` or `done`
    integer(long), intent(in) :: number
    integer(long) :: before !! what it was
    integer(long), volatile :: fetched ! it comes with the second call
    integer :: ierr

    call MPI_Fetch_and_op(number, fetched, MPI_INTEGER8, 0, which, MPI_SUM, job%window, ierr)
    call MPI_Win_flush(0, job%window, ierr)
    before = fetched
  end function add_to

  !> Number of the member that this group takes next, from 1; whoever is free takes the next one.
  subroutine next_member(self, member)
    class(job_type), intent(in) :: self !! the job
    integer, intent(out) :: member !! number of the member
    integer :: ierr

    member = 0
    if (self%leads) member = int(add_to(self, taken, 1_long)) + 1
    call MPI_Bcast(member, 1, MPI_INTEGER, 0, PETSC_COMM_WORLD, ierr)
  end subroutine next_member

  !> Brings what every group has packed to all ranks of one group; waits for the last of them.
  subroutine collect(self, mine, group, all)
    class(job_type), intent(in) :: self !! the job
    type(archive_type), intent(in) :: mine !! this group's
    integer, intent(in) :: group          !! that gets them
    type(archive_type), allocatable, intent(out) :: all(:) !! one a group, to unpack; none in the other groups
    real(wp), allocatable :: numbers(:)
    character(len=:), allocatable :: words
    integer :: other, length(2), ierr
    integer :: status(MPI_STATUS_SIZE)

    allocate (all(merge(self%groups, 0, self%group == group)))
    numbers = mine%numbers()
    words = mine%words()
    if (self%group /= group) then
      if (.not. self%leads) return
      call MPI_Send([size(numbers), len(words)], 2, MPI_INTEGER, first_rank(self, group), 0, MPI_COMM_WORLD, ierr)
      call MPI_Send(numbers, size(numbers), MPI_DOUBLE_PRECISION, first_rank(self, group), 1, MPI_COMM_WORLD, ierr)
      call MPI_Send(words, len(words), MPI_CHARACTER, first_rank(self, group), 2, MPI_COMM_WORLD, ierr)
      return
    end if
    call open_archive(numbers, words, all(group))
    do other = 1, self%groups
      if (other == group) cycle
      associate (source => first_rank(self, other))
        if (self%leads) call MPI_Recv(length, 2, MPI_INTEGER, source, 0, MPI_COMM_WORLD, status, ierr)
        call MPI_Bcast(length, 2, MPI_INTEGER, 0, PETSC_COMM_WORLD, ierr)
        deallocate (numbers, words)
        allocate (numbers(length(1)))
        allocate (character(len=length(2)) :: words)
        if (self%leads) then
          call MPI_Recv(numbers, length(1), MPI_DOUBLE_PRECISION, source, 1, MPI_COMM_WORLD, status, ierr)
          call MPI_Recv(words, length(2), MPI_CHARACTER, source, 2, MPI_COMM_WORLD, status, ierr)
        end if
      end associate
      call MPI_Bcast(numbers, length(1), MPI_DOUBLE_PRECISION, 0, PETSC_COMM_WORLD, ierr)
      call MPI_Bcast(words, length(2), MPI_CHARACTER, 0, PETSC_COMM_WORLD, ierr)
      call open_archive(numbers, words, all(other))
    end do
  end subroutine collect

  !> The largest of all ranks' numbers, on every rank of the job.
  function largest(self, number)
    class(job_type), intent(in) :: self !! the job
    integer, intent(in) :: number !! this rank's
    integer :: largest
    integer :: ierr
    call MPI_Allreduce(number, largest, 1, MPI_INTEGER, MPI_MAX, MPI_COMM_WORLD, ierr)
  end function largest

  !> Sum of each number over all ranks of the job.
  function total_of(self, numbers) result(total)
    class(job_type), intent(in) :: self !! the job
    real(wp), intent(in) :: numbers(:) !! this rank's, in any unit [SI]
    real(wp) :: total(size(numbers))
    integer :: ierr
    call MPI_Allreduce(numbers, total, size(numbers), MPI_DOUBLE_PRECISION, MPI_SUM, MPI_COMM_WORLD, ierr)
  end function total_of
end module gfb_job_groups
