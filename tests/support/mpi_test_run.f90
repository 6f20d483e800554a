!> Runs tests on the first ranks of all that were started, while the others wait.
module gfb_mpi_test_run
  use, intrinsic :: iso_c_binding, only: c_int
  use mpi, only: mpi_allreduce, mpi_bcast, mpi_comm_free, mpi_comm_null, mpi_comm_rank, &
                 mpi_comm_size, mpi_comm_split, mpi_comm_world, mpi_finalize, mpi_ibarrier, &
                 mpi_in_place, mpi_init, mpi_logical, mpi_lor, mpi_status_ignore, mpi_test, &
                 mpi_undefined
  use gfb_test_failures, only: begin_test, record_failure, test_failures
  use gfb_test_run, only: plain_procedure, run_plain_test, test_run_type
  use pfunit, only: MpiTestMethod
  implicit none (type, external)
  private
  public :: mpi_test_run_type, mpi_procedure, run_alone, run_on_ranks

  abstract interface
    !> A test with ranks, or what runs before or after it.
    subroutine mpi_procedure(this)
      import :: MpiTestMethod
      implicit none (type, external)
      class(MpiTestMethod), intent(inout) :: this
    end subroutine mpi_procedure
  end interface

  interface
    !> POSIX: sleeps.
    function usleep(microseconds) result(status) bind(c, name='usleep')
      import :: c_int
      implicit none (type, external)
      integer(c_int), value :: microseconds !! to sleep [us]
      integer(c_int) :: status
    end function usleep
  end interface

  !> A run on several ranks.
  type, extends(test_run_type) :: mpi_test_run_type
    integer :: rank = 0  !! of this one among all, counted from 0
    integer :: ranks = 1 !! that were started
  contains
    procedure :: open => open_run
    procedure :: finish
  end type mpi_test_run_type

contains

  !> Starts MPI and reads the command line.
  subroutine open_run(self)
    class(mpi_test_run_type), intent(inout) :: self
    integer :: ierr

    call mpi_init(ierr)
    call mpi_comm_rank(mpi_comm_world, self%rank, ierr)
    call mpi_comm_size(mpi_comm_world, self%ranks, ierr)
    self%speaks = self%rank == 0
    call self%read_command_line()
  end subroutine open_run

  !> Ends MPI and the program. The count is told before: mpiexec kills all ranks once one has ended
  !> with a status.
  subroutine finish(self)
    class(mpi_test_run_type), intent(in) :: self
    integer :: ierr

    call self%tell_count()
    call mpi_finalize(ierr)
    call self%leave()
  end subroutine finish

  !> Runs a test without arguments on the first rank.
  subroutine run_alone(run, name, test, before, after)
    class(mpi_test_run_type), intent(inout) :: run
    character(len=*), intent(in) :: name
    procedure(plain_procedure) :: test
    procedure(plain_procedure), optional :: before, after
    logical :: failed
    integer :: failed_before, ierr

    if (.not. run%is_wanted(name)) return
    failed = .false.
    if (run%rank == 0) then
      failed_before = run%failed
      call run_plain_test(run, name, test, before, after)
      failed = run%failed > failed_before
    end if
    call wait_for_all()
    call mpi_bcast(failed, 1, mpi_logical, 0, mpi_comm_world, ierr)
    if (run%rank > 0) call run%count_result(name, .not. failed)
  end subroutine run_alone

  !> Runs a test on as many ranks as it asks for; fails where one rank fails, or ranks are missing.
  subroutine run_on_ranks(run, name, ranks, test, before, after)
    class(mpi_test_run_type), intent(inout) :: run
    character(len=*), intent(in) :: name
    integer, intent(in) :: ranks !! that the test asks for
    procedure(mpi_procedure) :: test
    procedure(mpi_procedure), optional :: before, after
    type(MpiTestMethod) :: this
    character(len=40) :: place
    integer :: communicator, color, ierr
    logical :: failed

    if (.not. run%is_wanted(name)) return
    write (place, '(a, i0, a, i0, a)') ' (rank ', run%rank, ' of ', ranks, ')'
    call run%announce(name)
    call begin_test(name//trim(place))
    if (ranks > run%ranks) then
      if (run%rank == 0) call record_failure('more ranks than were started')
    else
      color = merge(0, mpi_undefined, run%rank < ranks)
      call mpi_comm_split(mpi_comm_world, color, run%rank, communicator, ierr)
      if (communicator /= mpi_comm_null) then
        call this%set_ranks(communicator, ranks, run%rank)
        call run_with_ranks(this, test, before, after)
        call mpi_comm_free(communicator, ierr)
      end if
    end if
    failed = test_failures() > 0
    call wait_for_all()
    call mpi_allreduce(mpi_in_place, failed, 1, mpi_logical, mpi_lor, mpi_comm_world, ierr)
    write (place, '(a, i0, a)') ' (', ranks, ' ranks)'
    call run%count_result(name//trim(place), .not. failed)
  end subroutine run_on_ranks

  !> Waits asleep until all ranks are here: MPI's own waiting takes a core from the test.
  subroutine wait_for_all()
    integer(c_int), parameter :: moment = 500 ! [us]
    integer :: request, ierr
    integer(c_int) :: status
    logical :: here

    call mpi_ibarrier(mpi_comm_world, request, ierr)
    do
      call mpi_test(request, here, mpi_status_ignore, ierr)
      if (here) exit
      status = usleep(moment)
    end do
  end subroutine wait_for_all

  !> One test with its `before` and `after`, on the ranks that take part.
  subroutine run_with_ranks(this, test, before, after)
    type(MpiTestMethod), intent(inout) :: this
    procedure(mpi_procedure) :: test
    procedure(mpi_procedure), optional :: before, after

    if (present(before)) call before(this)
    ! All or none: a test that runs on some of its ranks would wait for the others.
    if (.not. this%any_rank_failed()) call test(this)
    if (present(after)) call after(this)
  end subroutine run_with_ranks
end module gfb_mpi_test_run
