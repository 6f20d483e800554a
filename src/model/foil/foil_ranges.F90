#include "gfb_petsc.h"
!> From the numbers of two structures, each rank by rank, to those of the foil: rank by rank, the top
!> foil's, then the bumps'.
module gfb_foil_ranges
  use petscsys
  use gfb_petsc_session, only: rank_count
  use gfb_foil_structure, only: foil_structure_type
  implicit none (type)
  private
  public :: ranges_of

  !> Unknowns of the ranks, and how a structure's numbers become the foil's.
  type, public :: foil_ranges_type
    integer, allocatable :: top_end(:), bump_end(:) !! (ranks) unknowns of the ranks so far
    integer :: top_shift = 0, bump_shift = 0 !! from this rank's own numbers, from 0, to the foil's, from 1
  contains
    procedure :: of_top => number_of_top
    procedure :: of_bumps => number_of_bumps
  end type foil_ranges_type

contains

  !> Numbers of both foils' unknowns, rank by rank: top foil, then bumps.
  function ranges_of(top, bumps) result(ranges)
    type(foil_structure_type), intent(in) :: top   !! the top foil
    type(foil_structure_type), intent(in) :: bumps !! the bump foil
    type(foil_ranges_type) :: ranges
    integer, allocatable :: both(:, :)
    integer :: i
    PetscErrorCode :: ierr

    allocate (both(2, rank_count()))
    call MPI_Allgather([top%part%owned_unknowns, bumps%part%owned_unknowns], 2, MPI_INTEGER, both, 2, MPI_INTEGER, PETSC_COMM_WORLD, ierr)
    ranges%top_end = [(sum(both(1, :i)), i=1, size(both, 2))]
    ranges%bump_end = [(sum(both(2, :i)), i=1, size(both, 2))]
    ranges%top_shift = bumps%first + 1
    ranges%bump_shift = top%first + top%part%owned_unknowns + 1
  end function ranges_of

  !> Foil's number, from 1, of an unknown of the top foil, from 0; 0 where there is none.
  elemental function number_of_top(self, number) result(of_foil)
    class(foil_ranges_type), intent(in) :: self !! both foils' numbers
    integer, intent(in) :: number !! of the structure, from 0; negative: none
    integer :: of_foil
    integer :: owner

    of_foil = 0
    if (number < 0) return
    owner = findloc(self%top_end > number, .true., 1)
    of_foil = number + 1
    if (owner > 1) of_foil = of_foil + self%bump_end(owner - 1)
  end function number_of_top

  !> The same of an unknown of the bumps.
  elemental function number_of_bumps(self, number) result(of_foil)
    class(foil_ranges_type), intent(in) :: self !! both foils' numbers
    integer, intent(in) :: number !! of the structure, from 0; negative: none
    integer :: of_foil

    of_foil = 0
    if (number < 0) return
    of_foil = number + 1 + self%top_end(findloc(self%bump_end > number, .true., 1))
  end function number_of_bumps
end module gfb_foil_ranges
