#include "gfb_petsc.h"
!> Craig-Bampton matrices of a strip's super-elements, for a dynamic extension.
!>
!> $$ T = \begin{bmatrix} I & 0 \\ -K_{II}^{-1} K_{IB} & \Phi \end{bmatrix}, \qquad
!>    \hat{K} = T^T K T, \quad \hat{M} = T^T M T $$
!>
!> with the fixed-interface modes \( \Phi \) of the interior. Source: [CraigBampton1968]. Without
!> modes it is Guyan's reduction.
!>
!> A strip put together from Craig-Bampton super-elements, spread over the ranks.
!>
!> A super-element keeps its first and its last line of nodes. Each rank has the super-elements that
!> begin in its columns, and owns the unknowns of the lines where they begin and their modes.
module gfb_craig_bampton
  use petscmat
  use gfb_kinds, only: wp
  use gfb_errors, only: error_type
  use gfb_petsc_kinds, only: pint
  use gfb_petsc_session, only: this_rank, rank_count, share_failure
  use gfb_substructures, only: substructure_type
  use gfb_foil_structure, only: foil_structure_type, assemble_piece, retained_in_piece, add_symmetric_block
  use gfb_foil_assembly, only: share_kinds, pass_on
  use gfb_super_element, only: super_element_type, condense, destroy_super_element
  use gfb_eigenmodes, only: modes_type, lowest_modes, destroy_modes
  use gfb_shell_geometry, only: node_unknowns
  implicit none (type)
  private
  public :: craig_bampton, reduce_matrices, assembled_eigenvalues

  !> One kind of super-element with its modes. Unknowns: the retained ones, then the modes. Ranks that
  !> have no super-element of the kind know its sizes only.
  type, public :: craig_bampton_type
    integer :: retained = 0 !! unknowns
    integer :: modes = 0
    logical :: mine = .false. !! this rank computed it, for all
    real(wp), allocatable :: stiffness(:, :) !! [N/m] between displacements
    real(wp), allocatable :: mass(:, :)      !! [kg] between displacements
    real(wp), allocatable :: eigenvalue(:) !! of the fixed-interface modes, where they were computed [1/s2]
  end type craig_bampton_type

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

  !> Matrices of every kind of super-element of a foil: computed once in the whole job, by the rank that
  !> has the first of the kind, and handed to the others that have one.
  !>
  !> Fails where an element is clockwise or degenerate.
  subroutine craig_bampton(foil, modes_kept, kinds, error)
    type(foil_structure_type), intent(in) :: foil !! with its substructures
    integer, intent(in) :: modes_kept !! fixed-interface modes of every super-element
    type(craig_bampton_type), allocatable, intent(out) :: kinds(:) !! one a kind of substructure
    type(error_type), allocatable, intent(out) :: error !! why it could not be done
    integer, allocatable :: maker(:)
    logical, allocatable :: has(:, :)
    integer :: i

    associate (kind => foil%substructure%kind, part => foil%column_part(foil%substructure%column))
      call share_kinds(kind, part, rank_count(), has, maker)
      ! Always the first: another copy's modes, where frequencies lie close, are others by round-off.
      maker = [(part(findloc(kind, i, 1)), i=1, size(maker))]
    end associate
    allocate (kinds(size(maker)))
    do i = 1, size(foil%mine)
      associate (piece => foil%substructure(foil%mine(i)))
        if (maker(piece%kind) /= this_rank() + 1 .or. kinds(piece%kind)%mine) cycle
        call reduce_piece(foil, piece, modes_kept, kinds(piece%kind), error)
        if (allocated(error)) exit
      end associate
    end do
    call share_failure(error)
    if (allocated(error)) return
    call share_matrices(has, maker, kinds)
  end subroutine craig_bampton

  !> Hands the matrices to the ranks that need them, and their sizes to all.
  subroutine share_matrices(has, maker, kinds)
    logical, intent(in) :: has(:, :) !! (ranks, kinds)
    integer, intent(in) :: maker(:)  !! (kinds) rank, from 1
    type(craig_bampton_type), intent(inout) :: kinds(:)
    integer :: sizes(2, size(kinds)), i, order
    PetscErrorCode :: ierr

    sizes(1, :) = kinds%retained
    sizes(2, :) = kinds%modes
    call MPI_Allreduce(MPI_IN_PLACE, sizes, size(sizes), MPI_INTEGER, MPI_MAX, PETSC_COMM_WORLD, ierr)
    kinds%retained = sizes(1, :)
    kinds%modes = sizes(2, :)
    do i = 1, size(kinds)
      if (.not. has(this_rank() + 1, i)) cycle
      order = kinds(i)%retained + kinds(i)%modes
      call pass_on(has(:, i), maker(i), order, kinds(i)%stiffness)
      call pass_on(has(:, i), maker(i), order, kinds(i)%mass)
    end do
  end subroutine share_matrices

  !> Matrices of one substructure.
  subroutine reduce_piece(foil, piece, modes_kept, reduced, error)
    type(foil_structure_type), intent(in) :: foil
    type(substructure_type), intent(in) :: piece
    integer, intent(in) :: modes_kept
    type(craig_bampton_type), intent(out) :: reduced
    type(error_type), allocatable, intent(out) :: error
    Mat :: stiffness, mass
    PetscErrorCode :: ierr

    call assemble_piece(foil%mesh, foil%section, foil%free(:, piece%nodes), piece, .false., stiffness, error)
    if (allocated(error)) return
    call assemble_piece(foil%mesh, foil%section, foil%free(:, piece%nodes), piece, .true., mass, error)
    if (allocated(error)) return
    call reduce_matrices(stiffness, mass, retained_in_piece(foil%free(:, piece%nodes), piece), modes_kept, reduced)
    PetscCallA(MatDestroy(stiffness, ierr))
    PetscCallA(MatDestroy(mass, ierr))
  end subroutine reduce_piece

  !> The same from the matrices of all its unknowns, on this rank alone.
  subroutine reduce_matrices(stiffness, mass, is_retained, modes_kept, reduced)
    Mat, intent(in) :: stiffness, mass    !! of the substructure
    logical, intent(in) :: is_retained(:) !! one an unknown
    integer, intent(in) :: modes_kept     !! fixed-interface modes, at most
    type(craig_bampton_type), intent(out) :: reduced !! its matrices
    type(super_element_type) :: super
    type(modes_type) :: modes
    real(wp), allocatable :: basis(:, :)
    integer :: i, kept

    call condense(stiffness, is_retained, 'super_', super)
    call interior_modes(super, mass, modes_kept, modes)
    kept = size(super%retained)
    allocate (basis(kept + size(super%interior), kept + size(modes%eigenvalue)), source=0.0_wp)
    do i = 1, kept
      basis(super%retained(i), i) = 1.0_wp
    end do
    basis(super%interior, :kept) = super%constraint_modes()
    do i = 1, size(modes%eigenvalue)
      basis(super%interior, kept + i) = values_of(modes%shape(i))
    end do
    reduced%mine = .true.
    reduced%retained = kept
    reduced%modes = size(modes%eigenvalue)
    reduced%eigenvalue = modes%eigenvalue
    reduced%mass = congruent(mass, basis)
    allocate (reduced%stiffness(size(basis, 2), size(basis, 2)), source=0.0_wp)
    reduced%stiffness(:kept, :kept) = super%stiffness
    do i = 1, size(modes%eigenvalue)
      reduced%stiffness(kept + i, kept + i) = modes%eigenvalue(i)
    end do
    call destroy_modes(modes)
    call destroy_super_element(super)
  end subroutine reduce_matrices

  !> Modes of the interior with all retained unknowns fixed.
  subroutine interior_modes(super, mass, wanted, modes)
    type(super_element_type), intent(in) :: super
    Mat, intent(in) :: mass
    integer, intent(in) :: wanted
    type(modes_type), intent(out) :: modes
    IS :: interior
    Mat :: interior_mass, interior_stiffness
    PetscErrorCode :: ierr

    if (wanted == 0 .or. size(super%interior) == 0) then
      allocate (modes%eigenvalue(0), modes%shape(0))
      return
    end if
    PetscCallA(ISCreateGeneral(PETSC_COMM_SELF, int(size(super%interior), pint), int(super%interior - 1, pint), PETSC_COPY_VALUES, interior, ierr))
    PetscCallA(MatCreateSubMatrix(mass, interior, interior, MAT_INITIAL_MATRIX, interior_mass, ierr))
    call super%interior_stiffness(interior_stiffness)
    call lowest_modes(interior_stiffness, interior_mass, 0.0_wp, wanted, modes)
    PetscCallA(MatDestroy(interior_mass, ierr))
    PetscCallA(ISDestroy(interior, ierr))
  end subroutine interior_modes

  !> \( T^T M T \), symmetric to the last digit.
  function congruent(matrix, basis) result(product)
    Mat, intent(in) :: matrix
    real(wp), intent(in) :: basis(:, :) !! T
    real(wp) :: product(size(basis, 2), size(basis, 2))
    Mat :: dense, moved
    PetscScalar, pointer :: values(:, :)
    PetscErrorCode :: ierr

    PetscCallA(MatCreateSeqDense(PETSC_COMM_SELF, int(size(basis, 1), pint), int(size(basis, 2), pint), PETSC_NULL_SCALAR_ARRAY, dense, ierr))
    PetscCallA(GFB_MatDenseGetArray(dense, values, ierr))
    values = basis
    PetscCallA(GFB_MatDenseRestoreArray(dense, values, ierr))
    PetscCallA(MatMatMult(matrix, dense, MAT_INITIAL_MATRIX, 1.0_wp, moved, ierr))
    PetscCallA(MatDestroy(dense, ierr))
    PetscCallA(GFB_MatDenseGetArray(moved, values, ierr))
    product = matmul(transpose(basis), values)
    PetscCallA(GFB_MatDenseRestoreArray(moved, values, ierr))
    PetscCallA(MatDestroy(moved, ierr))
    product = 0.5_wp*(product + transpose(product))
  end function congruent

  !> Entries of a sequential vector.
  function values_of(vector) result(list)
    Vec, intent(in) :: vector
    real(wp), allocatable :: list(:)
    PetscScalar, pointer :: values(:)
    PetscErrorCode :: ierr

    PetscCallA(GFB_VecGetArrayRead(vector, values, ierr))
    list = values
    PetscCallA(GFB_VecRestoreArrayRead(vector, values, ierr))
  end function values_of

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
end module gfb_craig_bampton
