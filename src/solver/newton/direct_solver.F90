#include "gfb_petsc.h"
!> A linear solver that factors its matrix by MUMPS, and what the factors tell of it.
module gfb_direct_solver
  use petscksp
  use gfb_kinds, only: wp
  use gfb_text, only: text
  use gfb_petsc_kinds, only: pint
  use gfb_petsc_session, only: rank_count
  implicit none (type)
  private
  public :: use_factors, factor_matrix, factor_failure, keep_factors_on_disk, set_option_default

  !> Prefixes of PETSc's options of all solvers that factor.
  character(len=*), parameter :: prefixes(*) = [character(len=10) :: 'strip_', 'bearing_', 'film_', &
                                                'foil_', 'stability_']

  integer, parameter :: few_ranks = 16 !! on which right sides stay distributed

contains

  !> Makes a linear solver factor its matrix and do nothing else.
  subroutine use_factors(linear, prefix, symmetric, dense_rows, is_definite)
    KSP, intent(in) :: linear              !! without a type yet
    character(len=*), intent(in) :: prefix !! of PETSc's options, such as 'bearing_'
    logical, intent(in) :: symmetric       !! the matrix is
    logical, intent(in) :: dense_rows      !! a few of its rows are almost full
    logical, intent(in), optional :: is_definite !! the symmetric matrix is positive definite, and says so
    logical :: definite
    PC :: factors
    PetscErrorCode :: ierr

    definite = .false.
    if (present(is_definite)) definite = is_definite
    PetscCallA(KSPSetType(linear, KSPPREONLY, ierr))
    PetscCallA(KSPGetPC(linear, factors, ierr))
    PetscCallA(PCSetType(factors, trim(merge('cholesky', 'lu      ', symmetric)), ierr))
    PetscCallA(PCFactorSetMatSolverType(factors, MATSOLVERMUMPS, ierr))
    ! Room for pivoting [%]; of a matrix that is positive definite no pivot is put off.
    call set_option_default('-'//prefix//'mat_mumps_icntl_14', trim(merge('10', '60', definite)))
    call set_option_default('-'//prefix//'mat_mumps_icntl_8', '0') ! scaled already
    ! Ten times faster to find than MUMPS' own choice, with factors no larger: approximate minimum fill,
    ! or PORD where rows are dense.
    call set_option_default('-'//prefix//'mat_mumps_icntl_7', merge('4', '2', dense_rows))
    call set_option_default('-'//prefix//'mat_mumps_icntl_33', '1') ! the determinant, for its sign
    ! A distributed right side costs MUMPS a collective call for every rank in each solve; one vector on
    ! the first rank is cheaper where ranks are many.
    if (rank_count() > few_ranks) call set_option_default('-'//prefix//'mat_mumps_icntl_20', '0')
  end subroutine use_factors

  !> Makes MUMPS write the factors to files, in the folder that MUMPS_OOC_TMPDIR names, else in /tmp.
  subroutine keep_factors_on_disk()
    integer :: i

    do i = 1, size(prefixes)
      call set_option_default('-'//trim(prefixes(i))//'mat_mumps_icntl_22', '1')
    end do
  end subroutine keep_factors_on_disk

  !> Why a solver has no factors, in words; empty where it has, or they are not MUMPS'.
  function factor_failure(linear) result(words)
    KSP, intent(in) :: linear !! after its matrix was to be factored
    character(len=:), allocatable :: words

    integer, parameter :: status_place = 1 ! in MUMPS' INFOG
    character(len=80) :: package
    KSPConvergedReason :: reason
    PetscInt :: status
    Mat :: factor
    PC :: factors
    PetscErrorCode :: ierr

    words = ''
    PetscCallA(KSPGetConvergedReason(linear, reason, ierr))
    if (GFB_REASON(reason) /= GFB_REASON(KSP_DIVERGED_PC_FAILED)) return
    words = 'the matrix is singular'
    package = ''
    PetscCallA(KSPGetPC(linear, factors, ierr))
    PetscCallA(PCFactorGetMatSolverType(factors, package, ierr))
    if (package /= MATSOLVERMUMPS) return
    PetscCallA(PCFactorGetMatrix(factors, factor, ierr))
    PetscCallA(MatMumpsGetInfog(factor, int(status_place, pint), status, ierr))
    select case (int(status))
    case (-5, -7, -8, -9, -11, -13, -14, -15, -17, -18, -19, -20) ! allocations and workspaces
      words = 'MUMPS ran out of memory for the factors (INFOG(1) = '//text(int(status))// &
              "): a coarser mesh, more nodes, linear_solver = 'out_of_core', or 'iterative' for a strip"
    case (-90)
      words = 'MUMPS could not write its factors to files: MUMPS_OOC_TMPDIR names their folder'
    case default ! MUMPS found no pivot
    end select
  end function factor_failure

  !> Sets an option of PETSc's unless the user has.
  subroutine set_option_default(name, value)
    character(len=*), intent(in) :: name, value !! with its leading '-'; as the user would type it
    PetscBool :: given
    PetscErrorCode :: ierr

    PetscCallA(PetscOptionsHasName(PETSC_NULL_OPTIONS, PETSC_NULL_CHARACTER, name, given, ierr))
    if (.not. given) then
      PetscCallA(PetscOptionsSetValue(PETSC_NULL_OPTIONS, name, value, ierr))
    end if
  end subroutine set_option_default

  !> Factors a matrix now; the solver keeps the factors until the matrix is touched.
  !>
  !> The sign is that of the determinant: 1, -1, or 0 where the matrix could not be factored, or the
  !> user chose another package than MUMPS. Rows and columns that are numbered alike otherwise, as on
  !> other ranks, leave it as it is.
  subroutine factor_matrix(linear, matrix, sign_of_determinant)
    KSP, intent(in) :: linear !! prepared by `use_factors`
    Mat, intent(in) :: matrix !! to be factored, scaled
    integer, intent(out) :: sign_of_determinant !! 1, -1, or 0

    integer, parameter :: mantissa_place = 12 ! in MUMPS' RINFOG
    character(len=80) :: package
    PetscReal :: mantissa
    KSPConvergedReason :: reason
    Mat :: factor
    PC :: factors
    PetscErrorCode :: ierr

    sign_of_determinant = 0
    PetscCallA(KSPSetOperators(linear, matrix, matrix, ierr))
    PetscCallA(KSPSetReusePreconditioner(linear, PETSC_FALSE, ierr))
    PetscCallA(KSPSetUp(linear, ierr))
    PetscCallA(KSPGetConvergedReason(linear, reason, ierr))
    if (GFB_REASON(reason) == GFB_REASON(KSP_DIVERGED_PC_FAILED)) return
    PetscCallA(KSPGetPC(linear, factors, ierr))
    PetscCallA(PCFactorGetMatSolverType(factors, package, ierr))
    if (package /= MATSOLVERMUMPS) return
    PetscCallA(PCFactorGetMatrix(factors, factor, ierr))
    PetscCallA(MatMumpsGetRinfog(factor, int(mantissa_place, pint), mantissa, ierr))
    if (abs(mantissa) > 0.0_wp) sign_of_determinant = nint(sign(1.0_wp, mantissa))
  end subroutine factor_matrix
end module gfb_direct_solver
