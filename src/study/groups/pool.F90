#include "gfb_petsc.h"
!> The ranks of a job as a pool of groups, each of which is a gfb of its own: gives tasks, gathers archives.
!>
!> The world of PETSc, and of everything else here, is a group's ranks. What the groups share, which
!> task is next and how many are done, is a window of memory on the job's first rank that the groups'
!> first ranks read and change without that rank's help, so that none waits for another that computes.
module gfb_pool
  use petscsys
  use, intrinsic :: iso_fortran_env, only: output_unit
  use gfb_kinds, only: wp, long
  use gfb_archive, only: archive_type, open_archive
  use gfb_c_library, only: remove_file
  use gfb_errors, only: error_type, fail, status_machine
  use gfb_text, only: text
  use gfb_quantity, only: quantity_type
  use gfb_run_log, only: run_log_type
  use gfb_scene, only: scene_type
  use gfb_text_file, only: table_member_type, visit_member
  use gfb_petsc_session, only: gfb_start_mpi, any_rank
  use gfb_provenance, only: version_text
  use gfb_division, only: block_ends, owner_of
  use gfb_run_context, only: run_context_type, run_listener_type
  implicit none (type)
  private
  public :: start_pool, stop_pool, visit_task, group_log_path, end_log

  integer(MPI_ADDRESS_KIND), parameter :: taken = 0, done = 1 !! numbers of the window: tasks taken, and done
  integer(MPI_ADDRESS_KIND), parameter :: numbers = 2
  integer, parameter :: number_bytes = storage_size(0_long)/8
  real(wp), parameter :: a_minute = 60.0_wp, an_hour = 3600.0_wp !! [s]

  !> The pool and this rank's number in it.
  type, extends(run_listener_type), public :: pool_type
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
    procedure :: report, next_task, gather_tasks, gather, begin_log, show, origin, largest, total_of
  end type pool_type

contains

  !> Starts MPI and divides the ranks, before PETSc is started; does nothing where no groups are asked
  !> for, and divides nothing where ranks are too few.
  subroutine start_pool(groups, pool)
    integer, intent(in) :: groups !! 0: none asked for
    type(pool_type), intent(out) :: pool !! with this rank's number in it
    GFB_COMM :: part
    integer(MPI_ADDRESS_KIND) :: bytes, base
    integer :: ierr

    pool%groups = groups
    if (groups == 0) return
    call gfb_start_mpi()
    call MPI_Comm_size(MPI_COMM_WORLD, pool%ranks, ierr)
    call MPI_Comm_rank(MPI_COMM_WORLD, pool%rank, ierr)
    pool%split = pool%ranks >= groups
    pool%leads = pool%rank == 0
    if (.not. pool%split) return
    pool%group = owner_of(pool%rank + 1, pool%ranks, groups)
    pool%leads = pool%rank == first_rank(pool, pool%group)
    call MPI_Comm_split(MPI_COMM_WORLD, pool%group, pool%rank, part, ierr)
    PETSC_COMM_WORLD = part
    bytes = merge(number_bytes*numbers, 0_MPI_ADDRESS_KIND, pool%rank == 0)
    call MPI_Win_allocate(bytes, number_bytes, MPI_INFO_NULL, MPI_COMM_WORLD, base, pool%window, ierr)
    call MPI_Win_lock_all(0, pool%window, ierr)
    if (pool%rank == 0) call clear(pool)
    call MPI_Barrier(MPI_COMM_WORLD, ierr)
    pool%begun = MPI_Wtime()
  end subroutine start_pool

  !> Sets the shared numbers to zero.
  subroutine clear(pool)
    type(pool_type), intent(in) :: pool
    integer(long) :: zeros(numbers)
    integer :: ierr

    zeros = 0
    call MPI_Accumulate(zeros, int(numbers), MPI_INTEGER8, 0, taken, int(numbers), MPI_INTEGER8, MPI_REPLACE, pool%window, ierr)
    call MPI_Win_flush(0, pool%window, ierr)
  end subroutine clear

  !> Ends MPI, after PETSc has ended.
  subroutine stop_pool(pool)
    type(pool_type), intent(inout) :: pool !! that has ended
    integer :: ierr

    if (pool%groups == 0) return
    if (pool%split) then
      call MPI_Win_unlock_all(pool%window, ierr)
      call MPI_Win_free(pool%window, ierr)
    end if
    call MPI_Finalize(ierr)
  end subroutine stop_pool

  !> Rank, in the job, that leads a group.
  pure integer function first_rank(pool, group) result(rank)
    type(pool_type), intent(in) :: pool
    integer, intent(in) :: group !! from 1
    integer :: ends(2)

    ends = block_ends(pool%ranks, pool%groups, group)
    rank = ends(1) - 1
  end function first_rank

  !> A point of this group's sweep is done; those it computes for comparison only are not counted.
  subroutine count_point(self, words)
    class(pool_type), intent(inout) :: self !! the pool
    character(len=*), intent(in) :: words !! which point

    if (self%counted < 1) return
    self%counted = self%counted - 1
    call self%report(words, 1)
  end subroutine count_point

  !> A line for the terminal: how many are done, how long it will take, what this group has done.
  subroutine report(self, words, number)
    class(pool_type), intent(in) :: self !! the pool
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
  function add_to(pool, which, number) result(before)
    class(pool_type), intent(in) :: pool
    integer(MPI_ADDRESS_KIND), intent(in) :: which !! `taken` or `done`
    integer(long), intent(in) :: number
    integer(long) :: before !! what it was
    integer(long), volatile :: fetched ! it comes with the second call
    integer :: ierr

    call MPI_Fetch_and_op(number, fetched, MPI_INTEGER8, 0, which, MPI_SUM, pool%window, ierr)
    call MPI_Win_flush(0, pool%window, ierr)
    before = fetched
  end function add_to

  !> Number of the task that this group takes next, from 1; whoever is free takes the next one.
  subroutine next_task(self, number)
    class(pool_type), intent(in) :: self !! the pool
    integer, intent(out) :: number !! of the task
    integer :: ierr

    number = 0
    if (self%leads) number = int(add_to(self, taken, 1_long)) + 1
    call MPI_Bcast(number, 1, MPI_INTEGER, 0, PETSC_COMM_WORLD, ierr)
  end subroutine next_task

  !> Saves or restores what came of a task, behind its number.
  subroutine visit_task(archive, members, number)
    type(archive_type), intent(inout) :: archive !! of a group, that saves or restores
    type(table_member_type), intent(inout) :: members(:) !! one a task
    integer, intent(inout) :: number !! of the task; written where the archive restores

    call archive%visit('number', number)
    call archive%require(number >= 1 .and. number <= size(members), 'the number of a task')
    if (.not. archive%failed) call visit_member(archive, members(number))
    if (archive%failed) error stop 'what a group of ranks has sent is no task'
  end subroutine visit_task

  !> Brings what came of all tasks to all ranks of one group.
  subroutine gather_tasks(self, mine, group, members)
    class(pool_type), intent(in) :: self !! the pool
    type(archive_type), intent(in) :: mine !! this group's tasks
    integer, intent(in) :: group           !! that gets all
    type(table_member_type), intent(inout) :: members(:) !! one a task; in the other groups as they were
    type(archive_type), allocatable :: all(:)
    integer :: i, number

    call self%gather(mine, group, all)
    do i = 1, size(all)
      do while (.not. all(i)%is_used_up())
        number = 0
        call visit_task(all(i), members, number)
      end do
    end do
  end subroutine gather_tasks

  !> Brings what every group has saved to all ranks of one group; waits for the last of them.
  subroutine gather(self, mine, group, all)
    class(pool_type), intent(in) :: self !! the pool
    type(archive_type), intent(in) :: mine !! this group's
    integer, intent(in) :: group          !! that gets them
    type(archive_type), allocatable, intent(out) :: all(:) !! one a group, to restore; none in the other groups
    real(wp), allocatable :: numbers(:)
    character(len=:), allocatable :: words
    integer :: other, length(2), ierr, status(MPI_STATUS_SIZE)

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
  end subroutine gather

  !> File of a group's log.
  pure function group_log_path(folder, name, group) result(path)
    character(len=*), intent(in) :: folder !! where results go
    character(len=*), intent(in) :: name   !! of the scene
    integer, intent(in) :: group           !! from 1
    character(len=:), allocatable :: path
    path = folder//'/'//name//'.group'//text(group)//'.log'
  end function group_log_path

  !> Begins a group's log, with the pool as listener.
  !>
  !> Fails when the file cannot be written; the log is silent then.
  subroutine begin_log(self, path, context, error)
    class(pool_type), target, intent(in) :: self !! the pool
    character(len=*), intent(in) :: path !! of the file
    type(run_context_type), intent(inout) :: context !! of the group; it stays as verbose
    type(error_type), allocatable, intent(out) :: error !! why it failed
    integer :: status, unit

    context%log%active = self%leads
    context%listener => self
    status = 0
    if (self%leads) then
      call remove_file(path) ! a link in its place is not followed
      open (newunit=unit, file=path, action='write', status='new', iostat=status)
      context%log%unit = unit
      context%log%colours = .false.
      context%log%terminal = .false.
      call context%log%remember()
    end if
    if (any_rank(status /= 0)) then
      context%log = run_log_type(active=.false.)
      call fail(error, path//': the file cannot be written', status_machine)
    end if
  end subroutine begin_log

  !> Ends a log.
  subroutine end_log(log)
    type(run_log_type), intent(in) :: log !! as it was begun

    if (.not. log%active) return
    call log%repeat_warnings()
    close (log%unit)
  end subroutine end_log

  !> The first lines of a job that computes one scene.
  subroutine show(self, scene, context, more)
    class(pool_type), intent(in) :: self !! the pool
    type(scene_type), intent(in) :: scene !! that is divided
    type(run_context_type), intent(in) :: context !! of the job; its log is the terminal
    character(len=*), intent(in) :: more !! behind the number of groups

    associate (log => context%log)
      call log%line(version_text())
      call log%line(scene%file//': '//scene%general%title)
      call log%line('results go to '//context%folder//', '//text(self%ranks)//' rank(s) in '//text(self%groups)//' group(s)'//more)
    end associate
  end subroutine show

  !> What the files say of their origin: of the whole job.
  function origin(self, context) result(list)
    class(pool_type), intent(in) :: self !! the pool
    type(run_context_type), intent(in) :: context !! of the job
    type(quantity_type), allocatable :: list(:)
    integer :: i

    list = context%origin()
    do i = 1, size(list)
      if (list(i)%name == 'ranks') list(i)%number = real(self%ranks, wp)
    end do
  end function origin

  !> The largest of all ranks' numbers, on every rank of the job.
  function largest(self, number)
    class(pool_type), intent(in) :: self !! the pool
    integer, intent(in) :: number !! this rank's
    integer :: largest, ierr
    call MPI_Allreduce(number, largest, 1, MPI_INTEGER, MPI_MAX, MPI_COMM_WORLD, ierr)
  end function largest

  !> Sum of each number over all ranks of the job.
  function total_of(self, numbers) result(total)
    class(pool_type), intent(in) :: self !! the pool
    real(wp), intent(in) :: numbers(:) !! this rank's, in any unit [SI]
    real(wp) :: total(size(numbers))
    integer :: ierr
    call MPI_Allreduce(numbers, total, size(numbers), MPI_DOUBLE_PRECISION, MPI_SUM, MPI_COMM_WORLD, ierr)
  end function total_of
end module gfb_pool
