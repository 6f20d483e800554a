#include "gfb_petsc.h"
!> A linear solver that factors its matrix, and what the factors show of it.
!>
!> A film with heat is factored station by station (`layer_factors.c`), on one rank, where it is not too wide. KLU has the matrices
!> whose factors stay sparse, MUMPS all others: of films on springs or beams KLU's factors take a third
!> to two thirds of the time, since MUMPS is made for blocks that are dense. On several ranks each makes KLU's factors of the
!> whole matrix, where it is small: what MUMPS' ranks send each other takes longer than these.
!>
!> PETSc does not factor again with what MUMPS failed on once: after a zero pivot it takes the next factors
!> for made although MUMPS was not called, after any other failure it repeats the failure. So factors that
!> failed are dropped whole.
module gfb_direct_solver
  use, intrinsic :: iso_c_binding, only: c_int, c_intptr_t
  use petscksp
  use gfb_kinds, only: wp
  use gfb_text, only: text
  use gfb_petsc_kinds, only: pint
  use gfb_petsc_session, only: rank_count
  use gfb_nonlinear_system, only: few_unknowns
  implicit none (type)
  private
  public :: use_factors, make_factors, factor_matrix, sign_of_factors, factor_failure, failure_in_words, enlarge_workspace, drop_factors, &
            keep_factors_on_disk, set_option_default, larger_workspace, are_of_mumps, factors_by

  !> Prefixes of PETSc's options of all solvers that factor.
  character(len=*), parameter :: prefixes(*) = [character(len=10) :: 'strip_', 'bearing_', 'film_', &
                                                'foil_', 'stability_', 'dynamic_']

  integer, parameter :: few_ranks = 16 !! on which right sides stay distributed
  integer, parameter :: first_room = 100  !! for pivoting, of a workspace that was too small at first [%]
  integer, parameter :: most_room = 2000  !! five times more from `first_room` on, doubled each time [%]
  integer, parameter :: too_small(2) = [-9, -11] !! MUMPS' INFOG(1) where its workspace is, or one that it was given
  integer, parameter :: no_room = 2       !! instead of INFOG(1): KLU had no memory
  integer, parameter :: status_place = 1  !! in MUMPS' INFOG
  integer, parameter :: room_place = 14   !! in MUMPS' ICNTL

  interface
    function gfb_use_klu(factors, has) result(status) bind(c)
      import :: c_intptr_t, c_int
      integer(c_intptr_t), value :: factors
      integer(c_int), intent(out) :: has
      integer(c_int) :: status
    end function gfb_use_klu
    function gfb_use_layers(factors, order, layer) result(status) bind(c)
      import :: c_intptr_t, c_int
      integer(c_intptr_t), value :: factors
      integer(c_int), value :: order
      integer(c_int), intent(in) :: layer(order)
      integer(c_int) :: status
    end function gfb_use_layers
    function gfb_are_layers(factors, are) result(status) bind(c)
      import :: c_intptr_t, c_int
      integer(c_intptr_t), value :: factors
      integer(c_int), intent(out) :: are
      integer(c_int) :: status
    end function gfb_are_layers
    function gfb_layers_sign(factors, sign) result(status) bind(c)
      import :: c_intptr_t, c_int
      integer(c_intptr_t), value :: factors
      integer(c_int), intent(out) :: sign
      integer(c_int) :: status
    end function gfb_layers_sign
    function gfb_forget_klu(factors) result(status) bind(c)
      import :: c_intptr_t, c_int
      integer(c_intptr_t), value :: factors
      integer(c_int) :: status
    end function gfb_forget_klu
    function gfb_klu_sign(factors, sign) result(status) bind(c)
      import :: c_intptr_t, c_int
      integer(c_intptr_t), value :: factors
      integer(c_int), intent(out) :: sign
      integer(c_int) :: status
    end function gfb_klu_sign
  end interface

contains

  !> Makes a linear solver factor its matrix and do nothing else.
  subroutine use_factors(linear, prefix, symmetric, dense_rows, is_definite, low_fill, matrix, plane, layer)
    KSP, intent(in) :: linear              !! without a type yet
    character(len=*), intent(in) :: prefix !! of PETSc's options, such as 'bearing_'
    logical, intent(in) :: symmetric       !! the matrix is
    logical, intent(in) :: dense_rows      !! a few of its rows are almost full
    logical, intent(in), optional :: is_definite !! the symmetric matrix is positive definite, and says so
    logical, intent(in), optional :: low_fill !! its factors stay sparse
    Mat, intent(in), optional :: matrix !! then: itself, filled or not
    logical, intent(in), optional :: plane !! its unknowns stand at the nodes of a plane mesh
    integer, intent(in), optional :: layer(:) !! of each unknown on one rank, see `layer_factors.c`; empty: none
    logical :: definite, done, flat
    PC :: factors
    PetscErrorCode :: ierr

    definite = .false.
    if (present(is_definite)) definite = is_definite
    flat = .false.
    if (present(plane)) flat = plane
    PetscCallA(KSPSetType(linear, KSPPREONLY, ierr))
    PetscCallA(KSPGetPC(linear, factors, ierr))
    if (present(low_fill) .and. present(matrix)) then
      call use_klu(factors, prefix, low_fill, matrix, done)
      if (done) return
    end if
    if (present(layer)) then
      call use_layers(factors, prefix, layer, done)
      if (done) return
    end if
    PetscCallA(PCSetType(factors, trim(merge('cholesky', 'lu      ', symmetric)), ierr))
    PetscCallA(PCFactorSetMatSolverType(factors, MATSOLVERMUMPS, ierr))
    ! Room for pivoting [%]; of a matrix that is positive definite no pivot is put off.
    call set_option_default('-'//prefix//'mat_mumps_icntl_14', trim(merge('10', '60', definite)))
    call set_option_default('-'//prefix//'mat_mumps_icntl_8', '0') ! scaled already
    ! Ten times faster to find than MUMPS' own choice, with factors no larger: approximate minimum fill, or PORD where rows are
    ! dense. Of plane meshes with dense rows the order by degree that sets these aside is found five times faster than PORD's, with
    ! factors of 0.8 to 1.4 times the operations; of shells' these would be twice as many.
    call set_option_default('-'//prefix//'mat_mumps_icntl_7', merge(merge('6', '4', flat), '2', dense_rows))
    call set_option_default('-'//prefix//'mat_mumps_icntl_33', '1') ! the determinant, for its sign
    ! A distributed right side costs MUMPS a collective call for every rank in each solve; one vector on
    ! the first rank is cheaper where ranks are many.
    if (rank_count() > few_ranks) call set_option_default('-'//prefix//'mat_mumps_icntl_20', '0')
  end subroutine use_factors

  !> Makes a linear solver's factors KLU's, where these are wanted and can be had: on one rank or of a small matrix, unless an
  !> option asks for another package, or for MUMPS' factors in files.
  subroutine use_klu(factors, prefix, wanted, matrix, done)
    PC, intent(in) :: factors
    character(len=*), intent(in) :: prefix !! of PETSc's options
    logical, intent(in) :: wanted
    Mat, intent(in) :: matrix
    logical, intent(out) :: done
    PetscInt :: rows, columns
    PetscErrorCode :: ierr
    integer(c_int) :: has

    done = .false.
    if (.not. wanted) return
    PetscCallA(MatGetSize(matrix, rows, columns, ierr))
    if (rank_count() > 1 .and. rows > few_unknowns) return
    if (asks_for_package(prefix)) return
    if (gfb_use_klu(int(factors%v, c_intptr_t), has) /= 0) error stop 'PETSc does not take KLU''s factors'
    done = has /= 0
  end subroutine use_klu

  !> Makes a linear solver's factors those of layers, where there are any, unless an option asks for another package.
  subroutine use_layers(factors, prefix, layer, done)
    PC, intent(in) :: factors
    character(len=*), intent(in) :: prefix !! of PETSc's options
    integer, intent(in) :: layer(:)
    logical, intent(out) :: done

    done = size(layer) > 0
    if (done) done = .not. asks_for_package(prefix)
    if (.not. done) return
    if (gfb_use_layers(int(factors%v, c_intptr_t), size(layer), int(layer, c_int)) /= 0) error stop 'PETSc does not take factors of layers'
  end subroutine use_layers

  !> Whether an option asks for a package, or for MUMPS' factors in files.
  logical function asks_for_package(prefix) result(asks)
    character(len=*), intent(in) :: prefix !! of PETSc's options
    PetscBool :: package, on_disk
    PetscErrorCode :: ierr

    PetscCallA(PetscOptionsHasName(PETSC_NULL_OPTIONS, PETSC_NULL_CHARACTER, '-'//prefix//'pc_factor_mat_solver_type', package, ierr))
    PetscCallA(PetscOptionsHasName(PETSC_NULL_OPTIONS, PETSC_NULL_CHARACTER, '-'//prefix//'mat_mumps_icntl_22', on_disk, ierr))
    asks = package .or. on_disk
  end function asks_for_package

  !> Makes MUMPS write the factors to files, in the folder that MUMPS_OOC_TMPDIR names, else in /tmp.
  subroutine keep_factors_on_disk()
    integer :: i

    do i = 1, size(prefixes)
      call set_option_default('-'//trim(prefixes(i))//'mat_mumps_icntl_22', '1')
    end do
  end subroutine keep_factors_on_disk

  !> Why a solver has no factors, in words; empty where it has.
  function factor_failure(linear) result(words)
    KSP, intent(in) :: linear !! after its matrix was to be factored
    character(len=:), allocatable :: words
    integer :: status

    words = ''
    call find_failure(linear, status)
    if (status /= 0) words = failure_in_words(status)
  end function factor_failure

  !> What MUMPS' INFOG(1) says of factors that could not be made.
  pure function failure_in_words(status) result(words)
    integer, intent(in) :: status !! INFOG(1), not 0
    character(len=:), allocatable :: words

    select case (status)
    case (-5, -7, -8, -9, -11, -13, -14, -15, -17, -18, -19, -20) ! allocations and workspaces
      words = 'MUMPS ran out of memory for the factors (INFOG(1) = '//text(status)// &
              "): a coarser mesh, more nodes, linear_solver = 'out_of_core', or 'iterative' for a strip"
    case (no_room)
      words = 'KLU ran out of memory for the factors: a coarser mesh, more nodes'
    case (-90)
      words = 'MUMPS could not write its factors to files: MUMPS_OOC_TMPDIR names their folder'
    case (-10, -6, 1)
      words = 'the matrix is singular'
    case default
      words = 'MUMPS could not factor the matrix (INFOG(1) = '//text(status)//')'
    end select
  end function failure_in_words

  !> MUMPS' INFOG(1) where a solver has no factors, 1 or `no_room` where they are another package's; 0 where it has.
  subroutine find_failure(linear, status)
    KSP, intent(in) :: linear !! after its matrix was to be factored
    integer, intent(out) :: status
    KSPConvergedReason :: reason
    PCFailedReason :: failed
    PetscInt :: number
    Mat :: factor
    PC :: factors
    PetscErrorCode :: ierr

    status = 0
    PetscCallA(KSPGetConvergedReason(linear, reason, ierr))
    if (GFB_REASON(reason) /= GFB_REASON(KSP_DIVERGED_PC_FAILED)) return
    PetscCallA(KSPGetPC(linear, factors, ierr))
    PetscCallA(PCGetFailedReason(factors, failed, ierr))
    status = merge(no_room, 1, GFB_REASON(failed) == GFB_REASON(PC_FACTOR_OUTMEMORY))
    if (.not. are_of_mumps(factors)) return
    PetscCallA(PCFactorGetMatrix(factors, factor, ierr))
    PetscCallA(MatMumpsGetInfog(factor, int(status_place, pint), number, ierr))
    status = int(number)
  end subroutine find_failure

  !> The package that factors, in words.
  function factors_by(linear) result(words)
    KSP, intent(in) :: linear !! prepared by `use_factors`
    character(len=:), allocatable :: words
    character(len=80) :: kind, package
    PC :: factors
    PetscErrorCode :: ierr
    integer(c_int) :: layers

    PetscCallA(KSPGetPC(linear, factors, ierr))
    PetscCallA(PCGetType(factors, kind, ierr))
    if (gfb_are_layers(int(factors%v, c_intptr_t), layers) /= 0) error stop 'PETSc does not say whether the factors are of layers'
    package = 'KLU, sparse factors '//trim(merge('on each rank', 'on one rank ', rank_count() > 1))
    if (kind /= PCSHELL) then
      PetscCallA(PCFactorGetMatSolverType(factors, package, ierr))
    else if (layers /= 0) then
      package = 'station by station, dense factors on one rank'
    end if
    words = trim(package)
  end function factors_by

  !> Whether factors are MUMPS'.
  logical function are_of_mumps(factors) result(are)
    PC, intent(in) :: factors !! of a linear solver
    character(len=80) :: kind, package
    PetscErrorCode :: ierr

    PetscCallA(PCGetType(factors, kind, ierr))
    are = kind == PCLU .or. kind == PCCHOLESKY
    if (.not. are) return
    PetscCallA(PCFactorGetMatSolverType(factors, package, ierr))
    are = package == MATSOLVERMUMPS
  end function are_of_mumps

  !> Drops factors that failed, and enlarges the workspace of the next ones where MUMPS found it too small: at
  !> most five times in a run. The solver has no matrix afterwards.
  !>
  !> The size goes by PETSc's options, so that all later factors with the same prefix have it.
  subroutine enlarge_workspace(linear, room)
    KSP, intent(in) :: linear    !! after its matrix could not be factored
    integer, intent(out) :: room !! for pivoting, from now on [%]; 0 where nothing was enlarged

    character(len=80) :: prefix
    PetscInt :: given
    Mat :: factor
    PC :: factors
    PetscErrorCode :: ierr
    integer :: status

    room = 0
    call find_failure(linear, status)
    if (any(status == too_small)) then
      PetscCallA(KSPGetPC(linear, factors, ierr))
      PetscCallA(PCFactorGetMatrix(factors, factor, ierr))
      PetscCallA(MatMumpsGetIcntl(factor, int(room_place, pint), given, ierr))
      room = larger_workspace(status, int(given))
    end if
    if (room > 0) then
      PetscCallA(KSPGetOptionsPrefix(linear, prefix, ierr))
      PetscCallA(PetscOptionsSetValue(PETSC_NULL_OPTIONS, '-'//trim(prefix)//'mat_mumps_icntl_14', text(room), ierr))
    end if
    call drop_factors(linear)
  end subroutine enlarge_workspace

  !> Drops factors and how they were found, whoever made them. The solver has no matrix afterwards.
  subroutine drop_factors(linear)
    KSP, intent(in) :: linear !! with or without factors
    PC :: factors
    PetscErrorCode :: ierr

    PetscCallA(KSPReset(linear, ierr))
    PetscCallA(KSPGetPC(linear, factors, ierr))
    if (gfb_forget_klu(int(factors%v, c_intptr_t)) /= 0) error stop 'PETSc does not drop KLU''s factors'
  end subroutine drop_factors

  !> Room for pivoting to try next [%], where MUMPS found its workspace too small, at most five times; else 0.
  pure integer function larger_workspace(status, given) result(room)
    integer, intent(in) :: status !! MUMPS' INFOG(1)
    integer, intent(in) :: given  !! room that there was [%]

    room = 0
    if (any(status == too_small) .and. given < most_room/2) room = max(first_room, 2*given)
  end function larger_workspace

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

  !> Factors a matrix now, with a larger workspace where MUMPS asks for one; the solver keeps the factors
  !> until the matrix is touched.
  subroutine make_factors(linear, matrix, made, enlargements)
    KSP, intent(in) :: linear !! prepared by `use_factors`
    Mat, intent(in) :: matrix !! to be factored, scaled
    logical, intent(out) :: made !! else the solver has neither factors nor matrix
    integer, intent(inout) :: enlargements !! of the workspace, counted on
    KSPConvergedReason :: reason
    PetscErrorCode :: ierr
    integer :: room

    do
      PetscCallA(KSPSetOperators(linear, matrix, matrix, ierr))
      PetscCallA(KSPSetReusePreconditioner(linear, PETSC_FALSE, ierr))
      PetscCallA(KSPSetUp(linear, ierr))
      PetscCallA(KSPGetConvergedReason(linear, reason, ierr))
      made = GFB_REASON(reason) /= GFB_REASON(KSP_DIVERGED_PC_FAILED)
      if (made) return
      call enlarge_workspace(linear, room)
      if (room == 0) return
      enlargements = enlargements + 1
    end do
  end subroutine make_factors

  !> Factors a matrix now; the solver keeps the factors until the matrix is touched.
  !>
  !> The sign is that of the determinant: 1, -1, or 0 where the matrix could not be factored, or the
  !> user chose another package than these. Rows and columns that are numbered alike otherwise, as on
  !> other ranks, leave it as it is.
  subroutine factor_matrix(linear, matrix, sign_of_determinant, enlargements)
    KSP, intent(in) :: linear !! prepared by `use_factors`
    Mat, intent(in) :: matrix !! to be factored, scaled
    integer, intent(out) :: sign_of_determinant !! 1, -1, or 0
    integer, intent(inout) :: enlargements !! of MUMPS' workspace, counted on

    logical :: made

    sign_of_determinant = 0
    call make_factors(linear, matrix, made, enlargements)
    if (made) sign_of_determinant = sign_of_factors(linear)
  end subroutine factor_matrix

  !> Sign of the determinant of the matrix that was factored last: 1, -1, or 0 where another package than these has factored it.
  integer function sign_of_factors(linear) result(sign_of_determinant)
    KSP, intent(in) :: linear !! prepared by `use_factors`, with factors
    integer, parameter :: mantissa_place = 12 ! in MUMPS' RINFOG
    PetscReal :: mantissa
    Mat :: factor
    PC :: factors
    PetscErrorCode :: ierr
    integer(c_int) :: klus, layers

    PetscCallA(KSPGetPC(linear, factors, ierr))
    if (gfb_klu_sign(int(factors%v, c_intptr_t), klus) /= 0) error stop 'PETSc does not say whether KLU has made the factors'
    if (gfb_layers_sign(int(factors%v, c_intptr_t), layers) /= 0) error stop 'PETSc does not say whether the factors are of layers'
    sign_of_determinant = int(klus + layers) ! of one of them, if any
    if (.not. are_of_mumps(factors)) return
    PetscCallA(PCFactorGetMatrix(factors, factor, ierr))
    PetscCallA(MatMumpsGetRinfog(factor, int(mantissa_place, pint), mantissa, ierr))
    if (abs(mantissa) > 0.0_wp) sign_of_determinant = nint(sign(1.0_wp, mantissa))
  end function sign_of_factors
end module gfb_direct_solver
