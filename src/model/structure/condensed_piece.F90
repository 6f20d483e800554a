#include "gfb_petsc.h"
!> What a vibration needs to know of the pieces of a foil that are condensed: they are heavy inside too.
module gfb_condensed_piece
  use petscmat
  implicit none (type)
  private
  public :: destroy_pieces

  !> A kind of condensed pieces, its first one, and where this rank's pieces of the kind stand.
  type, public :: condensed_piece_type
    integer :: surface = 0                  !! of the foil's `surfaces`, that it is a piece of
    Mat :: stiffness, mass                  !! of all unknowns of the piece, on this rank alone
    logical, allocatable :: is_retained(:)  !! one an unknown
    integer, allocatable :: number(:, :)    !! (retained, pieces) foil's own numbers, from 1; 0: fixed
    integer, allocatable :: place(:)        !! (pieces) along the foil, from 1, whatever rank has them
  end type condensed_piece_type

contains

  !> Frees what PETSc holds.
  subroutine destroy_pieces(piece)
    type(condensed_piece_type), intent(inout) :: piece(:) !! are freed
    PetscErrorCode :: ierr
    integer :: i

    do i = 1, size(piece)
      PetscCallA(MatDestroy(piece(i)%stiffness, ierr))
      PetscCallA(MatDestroy(piece(i)%mass, ierr))
    end do
  end subroutine destroy_pieces
end module gfb_condensed_piece
