#include "gfb_petsc.h"
!> What vibrations, amplitudes and modes of a rotor ask of a solver of complex linear systems: solutions, of the transposed system, too,
!> and the determinant, where the solver has one.
module gfb_complex_solver
  use petscmat
  use gfb_kinds, only: wp
  use gfb_matrix_rows, only: row_length
  implicit none (type)
  private
  public :: keep_entries, longest_row

  real(wp), parameter, public :: refined = 1.0e-13_wp  !! backward error of a solution that is not improved any more [1]
  real(wp), parameter, public :: accepted = 1.0e-10_wp !! largest backward error of a solution [1]

  !> A matrix A + i B whose real and imaginary part are PETSc's, and what solves with it. An unknown that is not kept has an
  !> equation of its own, that it is zero.
  type, abstract, public :: complex_solver_type
  contains
    procedure(prepare), deferred :: prepare
    procedure(solve), deferred :: solve
    procedure(failure), deferred, nopass :: failure
    procedure(destroy), deferred :: destroy
    procedure(release), deferred :: release
    procedure, nopass :: has_determinant => no_determinant
    procedure :: log_determinant => logarithm_of_nothing
  end type complex_solver_type

  abstract interface
    !> Takes a matrix, and makes ready what solves with it; both parts may be overwritten afterwards. Collective.
    subroutine prepare(self, real_part, imaginary_part, status, enlargements)
      import :: complex_solver_type, tMat
      class(complex_solver_type), intent(inout) :: self !! created before
      Mat, intent(in) :: real_part, imaginary_part !! with the pattern that it was created with, scaled
      integer, intent(out) :: status !! negative where nothing can be solved; see `failure`
      integer, intent(inout) :: enlargements !! of the workspace of factors, counted on
    end subroutine prepare

    !> Solves with the matrix that was taken last, for all right sides at once. Collective.
    subroutine solve(self, re, im, solved, transposed)
      import :: complex_solver_type, tVec
      class(complex_solver_type), intent(in) :: self !! prepared before
      Vec, intent(in) :: re(:), im(:) !! right sides, overwritten by their solutions
      logical, intent(out) :: solved !! all solutions meet the equations
      logical, intent(in), optional :: transposed !! those of the transposed matrix, not of its conjugate
    end subroutine solve

    !> Frees what is made anew of the next matrix; the determinant stays known.
    subroutine release(self)
      import :: complex_solver_type
      class(complex_solver_type), intent(inout) :: self !! created before; solves nothing until it is prepared again
    end subroutine release

    !> Why nothing was solved, in words.
    function failure(status) result(words)
      integer, intent(in) :: status !! of `prepare`
      character(len=:), allocatable :: words
    end function failure

    !> Frees what it holds.
    subroutine destroy(self)
      import :: complex_solver_type
      class(complex_solver_type), intent(inout) :: self !! created before
    end subroutine destroy
  end interface

contains

  !> Whether the solver has the determinant; by itself it does not.
  pure logical function no_determinant() result(has)
    has = .false.
  end function no_determinant

  !> Logarithm of the determinant of the matrix that was taken last, up to multiples of 2 pi i.
  function logarithm_of_nothing(self) result(logarithm)
    class(complex_solver_type), intent(in) :: self !! prepared before, with a determinant
    complex(wp) :: logarithm
    logarithm = 0.0_wp
    if (.not. self%has_determinant()) error stop 'a determinant is asked of a solver that has none'
  end function logarithm_of_nothing

  !> Entries of the longest row of this rank.
  function longest_row(matrix) result(entries)
    Mat, intent(in) :: matrix !! of all ranks
    PetscInt :: entries, first, last, row
    PetscErrorCode :: ierr

    entries = 0
    PetscCallA(MatGetOwnershipRange(matrix, first, last, ierr))
    do row = first, last - 1
      entries = max(entries, row_length(matrix, row))
    end do
  end function longest_row

  !> Takes out of a vector what is not kept.
  subroutine keep_entries(vector, kept)
    Vec, intent(in) :: vector !! on the left or right of the matrix
    logical, intent(in) :: kept(:) !! one an entry of this rank
    PetscScalar, pointer :: values(:)
    PetscErrorCode :: ierr

    PetscCallA(GFB_VecGetArray(vector, values, ierr))
    where (.not. kept) values = 0.0_wp
    PetscCallA(GFB_VecRestoreArray(vector, values, ierr))
  end subroutine keep_entries
end module gfb_complex_solver
