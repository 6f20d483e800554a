!> Tests on several ranks, under pFUnit's names; re-exports the asserts.
module pfunit
  use mpi, only: mpi_allreduce, mpi_in_place, mpi_logical, mpi_lor
  use funit
  implicit none (type, external)
  public

  !> What a test with `npes` receives: the ranks it runs on.
  type :: MpiTestMethod
    integer, private :: communicator = -1 !! of the ranks that take part
    integer, private :: processes = 0     !! how many take part
    integer, private :: rank = -1         !! of this one, counted from 0
  contains
    procedure :: getMpiCommunicator
    procedure :: getNumProcesses
    procedure :: getProcessRank
    procedure :: set_ranks
    procedure :: any_rank_failed
  end type MpiTestMethod

contains

  !> The communicator to create everything on.
  function getMpiCommunicator(this) result(communicator)
    class(MpiTestMethod), intent(in) :: this
    integer :: communicator
    communicator = this%communicator
  end function getMpiCommunicator

  function getNumProcesses(this) result(processes)
    class(MpiTestMethod), intent(in) :: this
    integer :: processes
    processes = this%processes
  end function getNumProcesses

  !> This rank, counted from 0.
  function getProcessRank(this) result(rank)
    class(MpiTestMethod), intent(in) :: this
    integer :: rank
    rank = this%rank
  end function getProcessRank

  !> Says which ranks take part; for the driver only.
  subroutine set_ranks(this, communicator, processes, rank)
    class(MpiTestMethod), intent(inout) :: this
    integer, intent(in) :: communicator
    integer, intent(in) :: processes
    integer, intent(in) :: rank !! of this one, counted from 0

    this%communicator = communicator
    this%processes = processes
    this%rank = rank
  end subroutine set_ranks

  !> Whether an assert failed on any rank that takes part; all of them must call it.
  function any_rank_failed(this) result(failed)
    class(MpiTestMethod), intent(in) :: this
    logical :: failed
    integer :: ierr

    failed = anyExceptions()
    call mpi_allreduce(mpi_in_place, failed, 1, mpi_logical, mpi_lor, this%communicator, ierr)
  end function any_rank_failed
end module pfunit
