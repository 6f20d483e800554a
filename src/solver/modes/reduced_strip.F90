#include "gfb_petsc.h"
!> A strip put together from Craig-Bampton super-elements, spread over the ranks.
!>
!> A super-element keeps its first and its last line of nodes. Each rank has the super-elements that
!> begin in its columns, and owns the unknowns of the lines where they begin and their modes.
module gfb_reduced_strip
  use petscmat
  use gfb_kinds, only: wp
  use gfb_petsc_kinds, only: pint
  use gfb_petsc_session, only: this_rank, rank_count
  use gfb_shell_geometry, only: node_unknowns
  use gfb_foil_structure, only: foil_structure_type
  use gfb_foil_pieces, only: add_symmetric_block
  use gfb_craig_bampton, only: craig_bampton_type
  use gfb_eigenmodes, only: modes_type, lowest_modes, destroy_modes
  implicit none (type)
  private
  public :: assembled_eigenvalues

  !> Where the unknowns stand: rank by rank lines, then modes.
  type :: numbering_type
    integer, allocatable :: part(:)       !! (lines) rank, from 1, of a line and of the piece it begins
    integer, allocatable :: station(:)    !! (lines)
    integer, allocatable :: on_line(:)    !! (lines) free unknowns
    integer, allocatable :: of_modes(:)   !! (pieces) unknowns
    integer, allocatable :: line_start(:) !! (lines) unknowns before them
    integer, allocatable :: mode_start(:) !! (pieces)
  end type numbering_type

contains

  !> Lowest eigenvalues of the strip put together from its super-elements [1/s2].
  function assembled_eigenvalues(foil, kinds, shift, wanted) result(eigenvalue)
    type(foil_structure_type), intent(in) :: foil !! the structure
    type(craig_bampton_type), intent(in) :: kinds(:) !! of its substructures
    real(wp), intent(in) :: shift !! of the stiffness by the mass, not negative [1/s2]
    integer, intent(in) :: wanted !! eigenvalues asked for
    real(wp), allocatable :: eigenvalue(:)

    type(numbering_type) :: numbering
    type(modes_type) :: modes
    integer, allocatable :: list(:)
    Mat :: shifted, mass
    PetscErrorCode :: ierr
    integer :: i

    call number_unknowns(foil, kinds, numbering)
    call create_matrix(numbering, shifted)
    call create_matrix(numbering, mass)
    do i = 1, size(foil%mine)
      list = numbers_of(foil, numbering, foil%mine(i))
      associate (kind => kinds(foil%substructure(foil%mine(i))%kind))
        call add_symmetric_block(shifted, list, kind%stiffness + shift*kind%mass)
        call add_symmetric_block(mass, list, kind%mass)
      end associate
    end do
    PetscCallA(MatAssemblyBegin(shifted, MAT_FINAL_ASSEMBLY, ierr))
    PetscCallA(MatAssemblyEnd(shifted, MAT_FINAL_ASSEMBLY, ierr))
    PetscCallA(MatAssemblyBegin(mass, MAT_FINAL_ASSEMBLY, ierr))
    PetscCallA(MatAssemblyEnd(mass, MAT_FINAL_ASSEMBLY, ierr))
    call lowest_modes(shifted, mass, 0.0_wp, wanted, modes)
    eigenvalue = modes%eigenvalue - shift
    call destroy_modes(modes)
    PetscCallA(MatDestroy(shifted, ierr))
    PetscCallA(MatDestroy(mass, ierr))
  end function assembled_eigenvalues

  !> Numbers lines and modes; every rank knows where all of them begin.
  subroutine number_unknowns(foil, kinds, numbering)
    type(foil_structure_type), intent(in) :: foil
    type(craig_bampton_type), intent(in) :: kinds(:)
    type(numbering_type), intent(out) :: numbering
    integer :: pieces, rank, last, i, k
    PetscErrorCode :: ierr

    pieces = size(foil%substructure)
    associate (column => foil%substructure%column)
      numbering%part = foil%column_part([column, column(pieces)])
      numbering%station = [column, foil%mesh%stations]
    end associate
    numbering%of_modes = kinds(foil%substructure%kind)%modes
    allocate (numbering%on_line(pieces + 1), source=0)
    do i = 1, size(foil%mine)
      associate (piece => foil%substructure(foil%mine(i)))
        if (count(piece%retained) /= 2*foil%mesh%rows) error stop 'a super-element keeps two lines'
      end associate
      do k = foil%mine(i), foil%mine(i) + 1
        numbering%on_line(k) = count(free_on_line(foil, numbering%station(k)))
      end do
    end do
    call MPI_Allreduce(MPI_IN_PLACE, numbering%on_line, pieces + 1, MPI_INTEGER, MPI_MAX, PETSC_COMM_WORLD, ierr)
    allocate (numbering%line_start(pieces + 1), numbering%mode_start(pieces))
    last = 0
    do rank = 1, rank_count()
      call number_those(numbering%part == rank, numbering%on_line, last, numbering%line_start)
      call number_those(numbering%part(:pieces) == rank, numbering%of_modes, last, numbering%mode_start)
    end do
  end subroutine number_unknowns

  !> Where some lines or modes begin.
  pure subroutine number_those(mask, unknowns, last, start)
    logical, intent(in) :: mask(:)
    integer, intent(in) :: unknowns(:)
    integer, intent(inout) :: last !! number in use
    integer, intent(inout) :: start(:)
    integer :: i

    do i = 1, size(mask)
      if (.not. mask(i)) cycle
      start(i) = last
      last = last + unknowns(i)
    end do
  end subroutine number_those

  !> Which unknowns of a station no support fixes.
  pure function free_on_line(foil, station) result(free)
    type(foil_structure_type), intent(in) :: foil
    integer, intent(in) :: station
    logical :: free(node_unknowns, foil%mesh%rows)

    free = foil%free(:, (station - 1)*foil%mesh%rows + 1:station*foil%mesh%rows)
  end function free_on_line

  !> Numbers, from 0, of a super-element's unknowns in its order; -1 at supports.
  pure function numbers_of(foil, numbering, piece) result(list)
    type(foil_structure_type), intent(in) :: foil
    type(numbering_type), intent(in) :: numbering
    integer, intent(in) :: piece
    integer, allocatable :: list(:)
    integer :: line, i, width

    width = node_unknowns*foil%mesh%rows
    allocate (list(2*width + numbering%of_modes(piece)))
    do line = piece, piece + 1
      associate (here => (line - piece)*width, start => numbering%line_start(line))
        list(here + 1:here + width) = reshape(unpack([(start + i - 1, i=1, numbering%on_line(line))], &
                                                     free_on_line(foil, numbering%station(line)), -1), [width])
      end associate
    end do
    list(2*width + 1:) = [(numbering%mode_start(piece) + i - 1, i=1, numbering%of_modes(piece))]
  end function numbers_of

  !> An empty symmetric matrix with room for what each row couples, from the diagonal on: a line with both
  !> super-elements beside it.
  subroutine create_matrix(numbering, matrix)
    type(numbering_type), intent(in) :: numbering
    Mat, intent(out) :: matrix
    PetscInt, allocatable :: inside(:), outside(:)
    PetscErrorCode :: ierr
    integer :: pieces, owned, i

    pieces = size(numbering%of_modes)
    owned = sum(numbering%on_line, numbering%part == this_rank() + 1) + &
            sum(numbering%of_modes, numbering%part(:pieces) == this_rank() + 1)
    allocate (inside(owned), outside(owned))
    owned = 0
    do i = 1, pieces + 1
      if (numbering%part(i) /= this_rank() + 1) cycle
      call add_rows(numbering%line_start(i), numbering%on_line(i), max(1, i - 1), min(pieces, i))
    end do
    do i = 1, pieces
      if (numbering%part(i) /= this_rank() + 1) cycle
      call add_rows(numbering%mode_start(i), numbering%of_modes(i), i, i)
    end do
    PetscCallA(MatCreate(PETSC_COMM_WORLD, matrix, ierr))
    PetscCallA(MatSetSizes(matrix, size(inside, 1, pint), size(inside, 1, pint), PETSC_DETERMINE, PETSC_DETERMINE, ierr))
    PetscCallA(MatSetType(matrix, MATSBAIJ, ierr))
    PetscCallA(MatSeqSBAIJSetPreallocation(matrix, 1_pint, 0_pint, inside, ierr))
    PetscCallA(MatMPISBAIJSetPreallocation(matrix, 1_pint, 0_pint, inside, 0_pint, outside, ierr))
    PetscCallA(MatSetOption(matrix, MAT_IGNORE_LOWER_TRIANGULAR, PETSC_TRUE, ierr))

  contains

    !> Adds rows that couple the unknowns of some super-elements.
    subroutine add_rows(start, rows, first, last)
      integer, intent(in) :: start, rows !! unknowns before them, and how many
      integer, intent(in) :: first, last !! super-elements
      logical :: own(2*(last - first) + 3)
      integer :: begin(size(own)), length(size(own)), right(size(own)), row

      begin = [numbering%line_start(first:last + 1), numbering%mode_start(first:last)]
      length = [numbering%on_line(first:last + 1), numbering%of_modes(first:last)]
      own = [numbering%part(first:last + 1), numbering%part(first:last)] == this_rank() + 1
      do row = start, start + rows - 1
        right = max(0, begin + length - max(begin, row))
        owned = owned + 1
        inside(owned) = sum(int(right, pint), own)
        outside(owned) = sum(int(right, pint), .not. own)
      end do
    end subroutine add_rows
  end subroutine create_matrix
end module gfb_reduced_strip
