!> Parts of a field that the ranks have, brought to the first of them.
module gfb_rank_parts
  use, intrinsic :: iso_c_binding, only: c_f_pointer, c_int8_t, c_ptr
  use mpi, only: MPI_BYTE, MPI_INTEGER, MPI_LOGICAL, MPI_LOR, MPI_Allreduce, MPI_Comm_size, &
                 MPI_Gather, MPI_Gatherv, MPI_Type_contiguous, MPI_Type_commit, MPI_Type_free
  use gfb_kinds, only: long
  implicit none (type, external)
  private
  public :: gather_parts, share_truth

contains

  !> Puts consecutive entries of every rank where they stand among all; zeros where no rank has any.
  subroutine gather_parts(communicator, first_rank, bytes, buffer, entries, offset, total, all)
    integer, intent(in) :: communicator !! MPI's
    logical, intent(in) :: first_rank !! this is the rank that gets them
    integer, intent(in) :: bytes !! of an entry
    type(c_ptr), intent(in) :: buffer !! this rank's entries
    integer, intent(in) :: entries, offset, total !! here, before this rank's, in all
    !> on the first rank; next to nothing elsewhere
    integer(c_int8_t), allocatable, intent(out) :: all(:)
    integer(c_int8_t), pointer :: mine(:)
    integer, allocatable :: counts(:), places(:)
    integer :: ranks, one_entry, ignored

    call MPI_Comm_size(communicator, ranks, ignored)
    allocate (counts(ranks), places(ranks))
    call MPI_Gather([entries], 1, MPI_INTEGER, counts, 1, MPI_INTEGER, 0, communicator, ignored)
    call MPI_Gather([offset], 1, MPI_INTEGER, places, 1, MPI_INTEGER, 0, communicator, ignored)
    allocate (all(merge(max(1_long, int(total, long)*bytes), 1_long, first_rank)))
    all = 0_c_int8_t
    call c_f_pointer(buffer, mine, [max(1_long, int(entries, long)*bytes)])
    call MPI_Type_contiguous(bytes, MPI_BYTE, one_entry, ignored)
    call MPI_Type_commit(one_entry, ignored)
    call MPI_Gatherv(mine, entries, one_entry, all, counts, places, one_entry, 0, communicator, &
                     ignored)
    call MPI_Type_free(one_entry, ignored)
  end subroutine gather_parts

  !> Makes what is true on one rank true on all.
  subroutine share_truth(truth, communicator)
    logical, intent(inout) :: truth !! of this rank; on return of all
    integer, intent(in) :: communicator !! MPI's
    logical :: mine
    integer :: ignored

    mine = truth
    call MPI_Allreduce(mine, truth, 1, MPI_LOGICAL, MPI_LOR, communicator, ignored)
  end subroutine share_truth
end module gfb_rank_parts
