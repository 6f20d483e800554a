#include "gfb_petsc.h"
!> Complex linear systems of shells by iterations, without a determinant: GMRES on two levels of multigrid (`gfb_linear_solver`).
!>
!> In real arithmetic, as PETSc has it, \( (A + i B)(x + i y) = r + i s \) has twice the unknowns,
!>
!> $$ \begin{pmatrix} A & -B \\ B & A \end{pmatrix} \begin{pmatrix} x \\ y \end{pmatrix} =
!>    \begin{pmatrix} r \\ s \end{pmatrix}, $$
!>
!> with the real and the imaginary part of each unknown side by side: Jacobi's method divides by the complex diagonal, in blocks of
!> two, and the coarse space moves both parts alike. The transposed of this matrix is that of the conjugate transposed one. Its
!> equations are solved on levels of their own, made for the solve: the smoother and the coarse space serve them as well. Each
!> solution is put into the equations again, and improved until it meets them to round-off.
module gfb_complex_iterations
  use petscksp
  use gfb_kinds, only: wp
  use gfb_petsc_kinds, only: pint
  use gfb_matrix_rows, only: copy_row
  use gfb_direct_solver, only: set_option_default
  use gfb_linear_solver, only: use_multigrid
  use gfb_complex_solver, only: complex_solver_type, longest_row, accepted
  implicit none (type)
  private
  public :: create_complex_iterations

  character(len=*), parameter :: prefix = 'dynamic_' !! of PETSc's options
  integer, parameter :: parts = 2          !! of an unknown: real and imaginary
  integer, parameter :: longest = 1000     !! iterations of a pass at most
  integer, parameter :: most_passes = 4    !! of a solve
  real(wp), parameter :: tolerance = 1.0e-8_wp !! of a pass' residual, over what it began with [1]
  !> residual over the right side that is not improved any more: where stiff contacts have most of the matrix' norm a backward error
  !> of round-off leaves little to films [1]
  real(wp), parameter :: enough = 1.0e-14_wp
  real(wp), parameter :: useful = 0.1_wp       !! share of the residual that a pass leaves where another is worth while [1]

  !> A matrix in real arithmetic, and the iterations that solve with it.
  type, extends(complex_solver_type), public :: complex_iterations_type
    private
    logical, allocatable :: kept(:) !! unknowns of this rank that the equations have
    integer :: columns = 0          !! that rows may hold, from the first
    logical :: prepared = .false.   !! there is a matrix
    type(tMat) :: motions           !! coarse space, twice the unknowns
    type(tMat) :: matrix            !! twice the unknowns
    type(tKSP) :: linear            !! solves with it
  contains
    procedure :: prepare => prepare_iterations
    procedure :: solve => solve_by_iterations
    procedure :: release => drop_matrix
    procedure, nopass :: failure => iterations_failure
    procedure :: destroy => destroy_iterations
  end type complex_iterations_type

contains

  !> Iterations for matrices of real unknowns with a coarse space; an unknown that is not kept has an equation of its own, that it
  !> is zero.
  subroutine create_complex_iterations(motions, kept, columns, iterations)
    Mat, intent(in) :: motions     !! (unknowns, motions), of a real matrix of the system
    logical, intent(in) :: kept(:) !! one an unknown of this rank
    integer, intent(in) :: columns !! that rows may hold, from the first; the rest is left out
    type(complex_iterations_type), intent(out) :: iterations !! without a matrix yet
    Mat :: doubled
    PetscErrorCode :: ierr

    iterations%kept = kept
    iterations%columns = columns
    PetscCallA(MatCreateMAIJ(motions, int(parts, pint), doubled, ierr))
    PetscCallA(MatConvert(doubled, MATAIJ, MAT_INITIAL_MATRIX, iterations%motions, ierr))
    PetscCallA(MatDestroy(doubled, ierr))
  end subroutine create_complex_iterations

  !> Copies a matrix, and makes both levels.
  subroutine prepare_iterations(self, real_part, imaginary_part, status, enlargements)
    class(complex_iterations_type), intent(inout) :: self !! created before
    Mat, intent(in) :: real_part, imaginary_part !! of one pattern, scaled
    integer, intent(out) :: status !! 0
    integer, intent(inout) :: enlargements !! stays: the coarse level's factors are small

    status = 0
    call drop_matrix(self)
    call copy_matrix(self, real_part, imaginary_part)
    call create_linear(self%matrix, self%motions, self%linear)
    self%prepared = .true.
  end subroutine prepare_iterations

  !> The matrix of real and imaginary parts, without zeros.
  subroutine copy_matrix(self, real_part, imaginary_part)
    class(complex_iterations_type), intent(inout) :: self
    Mat, intent(in) :: real_part, imaginary_part
    PetscInt :: first, last, row, length
    PetscInt, allocatable :: column(:), own(:), others(:)
    PetscScalar, allocatable :: value(:)
    PetscErrorCode :: ierr
    integer :: part, entries

    PetscCallA(MatGetOwnershipRange(real_part, first, last, ierr))
    length = parts*max(1_pint, longest_row(real_part))
    allocate (column(length), value(length), own(parts*(last - first)), others(parts*(last - first)))
    do row = first, last - 1
      do part = 1, parts
        call take_row(row, part)
        associate (mine => column(:entries) >= parts*first .and. column(:entries) < parts*last, &
                   place => parts*(row - first) + part)
          own(place) = count(mine)
          others(place) = count(.not. mine)
        end associate
      end do
    end do
    PetscCallA(MatCreate(PETSC_COMM_WORLD, self%matrix, ierr))
    PetscCallA(MatSetSizes(self%matrix, parts*(last - first), parts*(last - first), PETSC_DETERMINE, PETSC_DETERMINE, ierr))
    PetscCallA(MatSetType(self%matrix, MATAIJ, ierr))
    PetscCallA(MatSetBlockSize(self%matrix, int(parts, pint), ierr))
    PetscCallA(MatSeqAIJSetPreallocation(self%matrix, 0_pint, own, ierr))
    PetscCallA(MatMPIAIJSetPreallocation(self%matrix, 0_pint, own, 0_pint, others, ierr))
    do row = first, last - 1
      do part = 1, parts
        call take_row(row, part)
        PetscCallA(MatSetValues(self%matrix, 1_pint, [parts*row + part - 1], int(entries, pint), column, value, INSERT_VALUES, ierr))
      end do
    end do
    PetscCallA(MatAssemblyBegin(self%matrix, MAT_FINAL_ASSEMBLY, ierr))
    PetscCallA(MatAssemblyEnd(self%matrix, MAT_FINAL_ASSEMBLY, ierr))

  contains

    !> The real or the imaginary part of an equation; the diagonal is always there.
    subroutine take_row(row, part)
      PetscInt, intent(in) :: row !! of the complex matrix, from 0
      integer, intent(in) :: part
      PetscInt :: one(length), number, i
      PetscScalar :: re(length), im(length)

      entries = 0
      if (.not. self%kept(row - first + 1)) then
        call put(parts*row + part - 1, 1.0_wp, .true.)
        return
      end if
      call copy_row(imaginary_part, row, number, one, im)
      call copy_row(real_part, row, number, one, re)
      do i = 1, number
        if (one(i) >= self%columns) cycle
        if (part == 1) then
          call put(parts*one(i), re(i), one(i) == row)
          call put(parts*one(i) + 1, -im(i), .false.)
        else
          call put(parts*one(i), im(i), .false.)
          call put(parts*one(i) + 1, re(i), one(i) == row)
        end if
      end do
    end subroutine take_row

    subroutine put(place, entry, keeps)
      PetscInt, intent(in) :: place
      real(wp), intent(in) :: entry
      logical, intent(in) :: keeps !! also a zero

      if (.not. (keeps .or. abs(entry) > 0.0_wp)) return
      entries = entries + 1
      column(entries) = place
      value(entries) = entry
    end subroutine put
  end subroutine copy_matrix

  !> GMRES on two levels for a matrix of real and imaginary parts.
  subroutine create_linear(matrix, motions, linear)
    Mat, intent(in) :: matrix, motions !! twice the unknowns
    KSP, intent(out) :: linear
    PetscErrorCode :: ierr

    PetscCallA(KSPCreate(PETSC_COMM_WORLD, linear, ierr))
    PetscCallA(KSPSetOptionsPrefix(linear, prefix, ierr))
    PetscCallA(KSPSetOperators(linear, matrix, matrix, ierr))
    call set_option_default('-'//prefix//'mg_levels_pc_type', PCPBJACOBI)
    call use_multigrid(linear, prefix, .false., motions)
    PetscCallA(KSPSetTolerances(linear, tolerance, 0.0_wp, PETSC_DEFAULT_REAL, int(longest, pint), ierr))
    PetscCallA(KSPSetFromOptions(linear, ierr))
  end subroutine create_linear

  !> Solves until the equations are met to round-off, or no pass comes nearer.
  subroutine solve_by_iterations(self, re, im, solved, transposed)
    class(complex_iterations_type), intent(in) :: self !! prepared before
    Vec, intent(in) :: re(:), im(:) !! right sides, overwritten by their solutions
    logical, intent(out) :: solved !! all solutions meet the equations
    logical, intent(in), optional :: transposed !! those of the transposed matrix, not of its conjugate
    Mat :: matrix
    KSP :: linear
    Vec :: answer, right
    PetscErrorCode :: ierr
    logical :: turned, found
    integer :: k

    turned = .false.
    if (present(transposed)) turned = transposed
    matrix = self%matrix
    linear = self%linear
    if (turned) then
      PetscCallA(MatTranspose(self%matrix, MAT_INITIAL_MATRIX, matrix, ierr))
      PetscCallA(MatSetBlockSize(matrix, int(parts, pint), ierr))
      call create_linear(matrix, self%motions, linear)
    end if
    PetscCallA(MatCreateVecs(matrix, answer, right, ierr))
    solved = .true.
    do k = 1, size(re)
      PetscCallA(VecStrideScatter(re(k), 0_pint, right, INSERT_VALUES, ierr))
      PetscCallA(VecStrideScatter(im(k), 1_pint, right, INSERT_VALUES, ierr))
      ! The transposed matrix is the conjugate of the one whose equations are solved.
      if (turned) then
        PetscCallA(VecStrideScale(right, 1_pint, -1.0_wp, ierr))
      end if
      call improve(linear, matrix, right, answer, found)
      solved = solved .and. found
      if (turned) then
        PetscCallA(VecStrideScale(answer, 1_pint, -1.0_wp, ierr))
      end if
      PetscCallA(VecStrideGather(answer, 0_pint, re(k), INSERT_VALUES, ierr))
      PetscCallA(VecStrideGather(answer, 1_pint, im(k), INSERT_VALUES, ierr))
    end do
    if (turned) then
      PetscCallA(KSPDestroy(linear, ierr))
      PetscCallA(MatDestroy(matrix, ierr))
    end if
    PetscCallA(VecDestroy(answer, ierr))
    PetscCallA(VecDestroy(right, ierr))
  end subroutine solve_by_iterations

  !> Passes of GMRES, each for what the passes before have left.
  subroutine improve(linear, matrix, right, answer, solved)
    KSP, intent(in) :: linear
    Mat, intent(in) :: matrix !! its
    Vec, intent(in) :: right, answer
    logical, intent(out) :: solved
    Vec :: rest, change
    PetscReal :: largest, asked, left, size
    KSPConvergedReason :: reason
    PetscErrorCode :: ierr
    real(wp) :: error, before
    integer :: pass

    PetscCallA(VecDuplicate(right, rest, ierr))
    PetscCallA(VecDuplicate(right, change, ierr))
    PetscCallA(MatNorm(matrix, NORM_INFINITY, largest, ierr))
    PetscCallA(VecNorm(right, NORM_INFINITY, asked, ierr))
    PetscCallA(VecCopy(right, rest, ierr))
    PetscCallA(VecSet(answer, 0.0_wp, ierr))
    solved = asked <= 0.0_wp
    before = asked
    do pass = 1, merge(0, most_passes, solved)
      PetscCallA(KSPSolve(linear, rest, change, ierr))
      PetscCallA(KSPGetConvergedReason(linear, reason, ierr))
      solved = GFB_REASON(reason) > 0
      if (.not. solved) exit
      PetscCallA(VecAXPY(answer, 1.0_wp, change, ierr))
      PetscCallA(MatMult(matrix, answer, rest, ierr))
      PetscCallA(VecAYPX(rest, -1.0_wp, right, ierr))
      PetscCallA(VecNorm(rest, NORM_INFINITY, left, ierr))
      PetscCallA(VecNorm(answer, NORM_INFINITY, size, ierr))
      error = left/max(tiny(1.0_wp), max(1.0_wp, largest)*size + asked)
      solved = error <= accepted ! not so for NaN
      if (left <= enough*asked .or. .not. left <= useful*before) exit
      before = left
    end do
    PetscCallA(VecDestroy(rest, ierr))
    PetscCallA(VecDestroy(change, ierr))
  end subroutine improve

  !> Why nothing was solved.
  function iterations_failure(status) result(words)
    integer, intent(in) :: status !! 0
    character(len=:), allocatable :: words
    words = "the linear iterations did not converge; linear_solver = 'direct' or 'out_of_core' has factors"
    if (status < 0) words = 'its coarse level cannot be factored; '//words
  end function iterations_failure

  !> Frees matrix and levels.
  subroutine drop_matrix(self)
    class(complex_iterations_type), intent(inout) :: self !! created before
    PetscErrorCode :: ierr

    if (.not. self%prepared) return
    PetscCallA(KSPDestroy(self%linear, ierr))
    PetscCallA(MatDestroy(self%matrix, ierr))
    self%prepared = .false.
  end subroutine drop_matrix

  !> Frees what PETSc holds.
  subroutine destroy_iterations(self)
    class(complex_iterations_type), intent(inout) :: self !! created before
    PetscErrorCode :: ierr

    call drop_matrix(self)
    PetscCallA(MatDestroy(self%motions, ierr))
  end subroutine destroy_iterations
end module gfb_complex_iterations
