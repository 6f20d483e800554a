#include "gfb_petsc.h"
!> Craig-Bampton matrices of a strip's super-elements, for a dynamic extension.
!>
!> $$ T = \begin{bmatrix} I & 0 \\ -K_{II}^{-1} K_{IB} & \Phi \end{bmatrix}, \qquad
!>    \hat{K} = T^T K T, \quad \hat{M} = T^T M T $$
!>
!> with the fixed-interface modes \( \Phi \) of the interior. Source: [CraigBampton1968]. Without
!> modes it is Guyan's reduction.
module gfb_craig_bampton
  use petscmat
  use gfb_kinds, only: wp
  use gfb_errors, only: error_type
  use gfb_petsc_kinds, only: pint
  use gfb_petsc_session, only: this_rank, rank_count, share_failure
  use gfb_substructures, only: substructure_type
  use gfb_foil_structure, only: foil_structure_type
  use gfb_foil_sharing, only: share_kinds, pass_on
  use gfb_foil_pieces, only: assemble_piece, retained_in_piece
  use gfb_super_element, only: super_element_type, condense, destroy_super_element
  use gfb_eigenmodes, only: modes_type, lowest_modes, destroy_modes
  implicit none (type)
  private
  public :: craig_bampton, reduce_matrices

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
end module gfb_craig_bampton
