#include "gfb_petsc.h"
!> Factors of a complex matrix A + i B whose real and imaginary part are PETSc's, by MUMPS in complex arithmetic.
!>
!> Against the same equations in real arithmetic, of twice the order, it takes half the operations and half the
!> memory. The pattern is analysed once. Each solution is put into the equations again.
module gfb_complex_factors
  use, intrinsic :: iso_c_binding, only: c_int, c_int64_t, c_double, c_double_complex, c_ptr, c_null_ptr, c_loc, c_associated
  use petscmat
  use gfb_kinds, only: wp
  use gfb_text, only: text
  use gfb_petsc_kinds, only: pint
  use gfb_petsc_session, only: this_rank, rank_count, largest_over_ranks
  use gfb_matrix_rows, only: copy_row, row_length
  use gfb_direct_solver, only: larger_workspace, failure_in_words
  use gfb_complex_solver, only: complex_solver_type, longest_row, refined, accepted
  implicit none (type)
  private
  public :: create_complex_factors

  character(len=*), parameter :: prefix = '-dynamic_' !! of PETSc's options
  integer(c_int), parameter :: analyse = 1, factor = 2, solve = 3 !! jobs of MUMPS
  integer(c_int), parameter :: room_control = 14 !! of ICNTL: room for pivoting [%]
  integer(c_int), parameter :: transposition_control = 9 !! of ICNTL: other than 1 solves with the transposed matrix
  integer, parameter :: limit_control = 23 !! of ICNTL: largest memory of a rank [MB]
  integer, parameter :: no_memory = -13 !! as MUMPS says it
  integer, parameter :: controls = 60 !! of MUMPS, that options may set
  integer, parameter :: first_room = 60 !! [%]

  !> A matrix, its factors, and where a vector's entries of each rank stand.
  type, extends(complex_solver_type), public :: complex_factors_type
    private
    type(c_ptr) :: mumps = c_null_ptr
    logical :: analysed = .false., factored = .false.
    complex(wp) :: logarithm = 0.0_wp !! of the determinant, up to multiples of 2 pi i
    integer :: room = first_room !! for pivoting [%]
    integer :: analysed_room = first_room !! the same, of the analysis [%]
    integer, allocatable :: entries(:), before(:) !! of the vector, each rank's, and those of the ranks before it
    logical, allocatable :: kept(:) !! unknowns of this rank that the equations have
    integer :: columns = 0          !! that rows may hold, from the first
    real(wp) :: largest = 0.0_wp    !! sum of a row [1]
    integer :: filled = 0           !! entries of this rank
    integer(c_int), pointer :: row(:) => null(), column(:) => null() !! of this rank's entries, from 1, row by row
    complex(c_double_complex), pointer :: value(:) => null()
    complex(c_double_complex), pointer :: work(:) => null() !! room for factors and fronts
  contains
    procedure :: prepare => factor_complex
    procedure :: solve => solve_complex
    procedure :: release => release_factors
    procedure, nopass :: failure => factors_failure
    procedure :: destroy => destroy_complex_factors
    procedure, nopass :: has_determinant => factors_have_one
    procedure :: log_determinant => log_of_factors
  end type complex_factors_type

  interface
    function gfb_mumps_create(communicator, order, entries, row, column) result(one) bind(c)
      import :: c_int, c_int64_t, c_ptr
      integer(c_int), value :: communicator, order
      integer(c_int64_t), value :: entries
      type(c_ptr), value :: row, column
      type(c_ptr) :: one
    end function gfb_mumps_create

    subroutine gfb_mumps_take(one, value) bind(c)
      import :: c_ptr
      type(c_ptr), value :: one, value
    end subroutine gfb_mumps_take

    subroutine gfb_mumps_control(one, place, value) bind(c)
      import :: c_int, c_ptr
      type(c_ptr), value :: one
      integer(c_int), value :: place, value
    end subroutine gfb_mumps_control

    function gfb_mumps_told(one, place) result(value) bind(c)
      import :: c_int, c_ptr
      type(c_ptr), value :: one
      integer(c_int), value :: place
      integer(c_int) :: value
    end function gfb_mumps_told

    function gfb_mumps_run(one, job, sides, right) result(status) bind(c)
      import :: c_int, c_ptr
      type(c_ptr), value :: one, right
      integer(c_int), value :: job, sides
      integer(c_int) :: status
    end function gfb_mumps_run

    function gfb_mumps_entries(one) result(entries) bind(c)
      import :: c_int64_t, c_ptr
      type(c_ptr), value :: one
      integer(c_int64_t) :: entries
    end function gfb_mumps_entries

    subroutine gfb_mumps_use(one, room, entries) bind(c)
      import :: c_int64_t, c_ptr
      type(c_ptr), value :: one, room
      integer(c_int64_t), value :: entries
    end subroutine gfb_mumps_use

    subroutine gfb_mumps_determinant(one, part, exponent) bind(c)
      import :: c_int, c_double, c_ptr
      type(c_ptr), value :: one
      real(c_double), intent(out) :: part(2)
      integer(c_int), intent(out) :: exponent
    end subroutine gfb_mumps_determinant

    subroutine gfb_mumps_destroy(one) bind(c)
      import :: c_ptr
      type(c_ptr), value :: one
    end subroutine gfb_mumps_destroy
  end interface

contains

  !> A matrix with the pattern of another, still empty; an unknown that is not kept has an equation of its own,
  !> that it is zero.
  subroutine create_complex_factors(pattern, kept, columns, factors)
    Mat, intent(in) :: pattern     !! of real and imaginary part
    logical, intent(in) :: kept(:) !! one an unknown of this rank
    integer, intent(in) :: columns !! that rows may hold, from the first; the rest is left out
    type(complex_factors_type), intent(out) :: factors !! to be filled
    PetscInt :: first, last, row, all, other
    PetscErrorCode :: ierr
    integer :: i, entries

    PetscCallA(MatGetOwnershipRange(pattern, first, last, ierr))
    PetscCallA(MatGetSize(pattern, all, other, ierr))
    factors%kept = kept
    factors%columns = columns
    allocate (factors%entries(rank_count()), factors%before(rank_count()))
    call MPI_Allgather(int(last - first), 1, MPI_INTEGER, factors%entries, 1, MPI_INTEGER, PETSC_COMM_WORLD, ierr)
    factors%before = [(sum(factors%entries(:i - 1)), i=1, size(factors%entries))]
    entries = 0
    do row = first, last - 1
      entries = entries + merge(int(row_length(pattern, row)), 1, kept(row - first + 1))
    end do
    allocate (factors%row(max(1, entries)), factors%column(max(1, entries)), factors%value(max(1, entries)))
    call visit_entries(factors, pattern)
    deallocate (factors%value)
    factors%mumps = gfb_mumps_create(int(PETSC_COMM_WORLD, c_int), int(all, c_int), int(factors%filled, c_int64_t), &
                                     c_loc(factors%row), c_loc(factors%column))
    if (c_associated(factors%mumps)) call set_controls(factors%mumps)
  end subroutine create_complex_factors

  !> How MUMPS works: nested dissection takes a fourth fewer operations on shells than approximate minimum fill.
  !> PETSc's options for its own MUMPS go before.
  subroutine set_controls(mumps)
    type(c_ptr), intent(in) :: mumps
    !> Pairs: the number of a control, and its value. No other permutation of columns, no scaling (the equations are
    !> scaled), no parallel analysis, which needs other libraries; the determinant costs nothing.
    integer(c_int), parameter :: default(2, 6) = &
      reshape(int([6, 0, 7, 5, 8, 0, int(room_control), first_room, 28, 1, 33, 1], c_int), [2, 6])
    PetscInt :: value
    PetscBool :: given
    PetscErrorCode :: ierr
    integer :: i

    do i = 1, size(default, 2)
      call gfb_mumps_control(mumps, default(1, i), default(2, i))
    end do
    do i = 1, controls
      PetscCallA(PetscOptionsGetInt(PETSC_NULL_OPTIONS, PETSC_NULL_CHARACTER, prefix//'mat_mumps_icntl_'//text(i), value, given, ierr))
      if (given) call gfb_mumps_control(mumps, int(i, c_int), int(value, c_int))
    end do
  end subroutine set_controls

  !> Numbers this rank's entries, and gives them their values where these are there.
  subroutine visit_entries(factors, real_part, imaginary_part)
    type(complex_factors_type), intent(inout) :: factors
    Mat, intent(in) :: real_part
    Mat, optional, intent(in) :: imaginary_part !! of the same pattern
    PetscInt :: first, last, row, length, i
    PetscInt, allocatable :: column(:)
    PetscScalar, allocatable :: re(:), im(:)
    real(wp) :: total
    PetscErrorCode :: ierr

    PetscCallA(MatGetOwnershipRange(real_part, first, last, ierr))
    length = longest_row(real_part)
    allocate (column(length), re(length), im(length))
    im = 0.0_wp
    factors%filled = 0
    factors%largest = 0.0_wp
    do row = first, last - 1
      if (.not. factors%kept(row - first + 1)) then
        call put_entry(row, (1.0_wp, 0.0_wp))
        cycle
      end if
      if (present(imaginary_part)) call copy_row(imaginary_part, row, length, column, im)
      call copy_row(real_part, row, length, column, re)
      total = 0.0_wp
      do i = 1, length
        if (column(i) >= factors%columns) cycle
        call put_entry(column(i), cmplx(re(i), im(i), wp))
        total = total + abs(re(i)) + abs(im(i))
      end do
      factors%largest = max(factors%largest, total)
    end do
    factors%largest = maxval(largest_over_ranks([1.0_wp, factors%largest]))

  contains

    subroutine put_entry(column, value)
      PetscInt, intent(in) :: column
      complex(wp), intent(in) :: value

      factors%filled = factors%filled + 1
      factors%row(factors%filled) = int(row + 1, c_int)
      factors%column(factors%filled) = int(column + 1, c_int)
      factors%value(factors%filled) = value
    end subroutine put_entry
  end subroutine visit_entries

  !> Fills the matrix and factors it, with a larger workspace where MUMPS asks for one.
  subroutine factor_complex(self, real_part, imaginary_part, status, enlargements)
    class(complex_factors_type), intent(inout) :: self !! created before
    Mat, intent(in) :: real_part, imaginary_part !! with the pattern that it was created with, scaled
    integer, intent(out) :: status !! MUMPS' INFOG(1), negative where there are no factors
    integer, intent(inout) :: enlargements !! of the workspace, counted on
    integer :: room

    status = no_memory
    if (.not. c_associated(self%mumps)) return
    self%factored = .false.
    if (.not. associated(self%value)) allocate (self%value(size(self%row)))
    call gfb_mumps_take(self%mumps, c_loc(self%value))
    call visit_entries(self, real_part, imaginary_part)
    if (.not. self%analysed) then
      status = gfb_mumps_run(self%mumps, analyse, 0_c_int, c_null_ptr)
      self%analysed = status >= 0
      self%analysed_room = int(gfb_mumps_told(self%mumps, int(room_control, c_int)))
    end if
    if (.not. self%analysed) return
    do
      call make_room(self, status)
      if (status >= 0) status = gfb_mumps_run(self%mumps, factor, 0_c_int, c_null_ptr)
      room = larger_workspace(status, self%room)
      if (room == 0) exit
      call gfb_mumps_control(self%mumps, room_control, int(room, c_int))
      self%room = room
      enlargements = enlargements + 1
    end do
    self%factored = status >= 0
    if (self%factored) self%logarithm = logarithm_of(self)
  end subroutine factor_complex

  !> Room for factors and fronts, which is ours: MUMPS' own stays as long as its analysis. Where the user's options limit what MUMPS
  !> takes it is MUMPS' own.
  subroutine make_room(factors, status)
    type(complex_factors_type), intent(inout) :: factors !! analysed
    integer, intent(out) :: status !! 0, on all ranks, or MUMPS' word for no memory
    integer(c_int64_t) :: entries
    real(wp) :: failed(1)
    integer :: allocated_status

    status = 0
    if (gfb_mumps_told(factors%mumps, int(limit_control, c_int)) > 0) return
    entries = gfb_mumps_entries(factors%mumps)
    associate (room => int(gfb_mumps_told(factors%mumps, int(room_control, c_int))), before => max(1, 100 + factors%analysed_room))
      if (100 + room > before) entries = int(real(entries, wp)*real(100 + room, wp)/real(before, wp), c_int64_t)
    end associate
    if (associated(factors%work)) then
      if (size(factors%work, kind=c_int64_t) < entries) deallocate (factors%work)
    end if
    allocated_status = 0
    if (.not. associated(factors%work)) allocate (factors%work(max(1_c_int64_t, entries)), stat=allocated_status)
    failed = largest_over_ranks([merge(1.0_wp, 0.0_wp, allocated_status /= 0)])
    status = merge(no_memory, 0, failed(1) > 0.0_wp)
    if (status == 0) call gfb_mumps_use(factors%mumps, c_loc(factors%work), size(factors%work, kind=c_int64_t))
  end subroutine make_room

  !> Frees matrix and factors; the analysis stays.
  subroutine release_factors(self)
    class(complex_factors_type), intent(inout) :: self !! created before

    if (associated(self%work)) deallocate (self%work)
    if (associated(self%value)) deallocate (self%value)
    self%factored = .false.
  end subroutine release_factors

  !> Solves with the factors there are; improved once where the equations are not met to round-off.
  subroutine solve_complex(self, re, im, solved, transposed)
    class(complex_factors_type), intent(in) :: self !! made before
    Vec, intent(in) :: re(:), im(:) !! right sides, overwritten by their solutions
    logical, intent(out) :: solved !! all solutions meet the equations
    logical, intent(in), optional :: transposed !! those of the transposed matrix, not of its conjugate
    complex(wp), allocatable, dimension(:, :) :: right, residual, answer ! (unknowns of this rank; of all for the answer, right sides)
    complex(wp), allocatable, target :: change(:, :)
    real(wp) :: size_of(3, size(re)), error
    integer :: pass, k
    logical :: turned

    if (.not. self%factored) error stop 'a solution is asked of factors that there are not'
    turned = .false.
    if (present(transposed)) turned = transposed
    call gfb_mumps_control(self%mumps, transposition_control, merge(0_c_int, 1_c_int, turned))
    allocate (right(self%entries(this_rank() + 1), size(re)))
    do k = 1, size(re)
      right(:, k) = cmplx(values_of(re(k)), values_of(im(k)), wp)
    end do
    allocate (residual, source=right)
    allocate (change(sum(self%entries), size(re)), answer(sum(self%entries), size(re)))
    answer = 0.0_wp
    do pass = 1, 2
      call solve_once(self, residual, change, solved)
      if (.not. solved) return
      answer = answer + change
      residual = right
      do k = 1, size(re)
        call subtract_product(self, answer(:, k), turned, residual(:, k))
        size_of(:, k) = [largest_of(residual(:, k)), largest_of(right(:, k)), largest_of(answer(:, k))]
      end do
      size_of = reshape(largest_over_ranks(reshape(size_of, [size(size_of)])), shape(size_of))
      error = maxval(size_of(1, :)/max(tiny(1.0_wp), self%largest*size_of(3, :) + size_of(2, :)))
      if (error <= refined) exit
    end do
    solved = error <= accepted ! not so for NaN
    associate (before => self%before(this_rank() + 1))
      do k = 1, size(re)
        call put_values(real(answer(before + 1:before + size(right, 1), k), wp), re(k))
        call put_values(aimag(answer(before + 1:before + size(right, 1), k)), im(k))
      end do
    end associate
  end subroutine solve_complex

  !> Logarithm of the determinant of the matrix that was factored last, up to multiples of 2 pi i.
  function log_of_factors(self) result(logarithm)
    class(complex_factors_type), intent(in) :: self !! made before
    complex(wp) :: logarithm
    logarithm = self%logarithm
  end function log_of_factors

  !> The same, as MUMPS has it.
  function logarithm_of(factors) result(logarithm)
    type(complex_factors_type), intent(in) :: factors
    complex(wp) :: logarithm
    real(c_double) :: part(2)
    real(wp) :: both(2)
    integer(c_int) :: exponent
    PetscErrorCode :: ierr

    both = 0.0_wp
    if (this_rank() == 0) then
      call gfb_mumps_determinant(factors%mumps, part, exponent)
      logarithm = log(cmplx(part(1), part(2), wp)) + real(exponent, wp)*log(2.0_wp)
      both = [real(logarithm, wp), aimag(logarithm)]
    end if
    call MPI_Bcast(both, 2, MPI_DOUBLE_PRECISION, 0, PETSC_COMM_WORLD, ierr)
    logarithm = cmplx(both(1), both(2), wp)
  end function logarithm_of

  !> Solutions, whole on every rank.
  subroutine solve_once(factors, right, answer, solved)
    type(complex_factors_type), intent(in) :: factors
    complex(wp), contiguous, intent(in) :: right(:, :) !! of this rank
    complex(wp), contiguous, target, intent(out) :: answer(:, :)
    logical, intent(out) :: solved
    PetscErrorCode :: ierr
    integer :: k

    do k = 1, size(right, 2)
      call MPI_Gatherv(right(:, k), size(right, 1), MPI_DOUBLE_COMPLEX, answer(:, k), factors%entries, factors%before, MPI_DOUBLE_COMPLEX, &
                       0, PETSC_COMM_WORLD, ierr)
    end do
    solved = gfb_mumps_run(factors%mumps, solve, int(size(answer, 2), c_int), c_loc(answer)) >= 0
    call MPI_Bcast(answer, size(answer), MPI_DOUBLE_COMPLEX, 0, PETSC_COMM_WORLD, ierr)
  end subroutine solve_once

  !> Takes the matrix, or the transposed one, times a vector away from this rank's entries of another.
  subroutine subtract_product(factors, vector, transposed, rest)
    type(complex_factors_type), intent(in) :: factors
    complex(wp), intent(in) :: vector(:)  !! whole
    logical, intent(in) :: transposed
    complex(wp), intent(inout) :: rest(:) !! of this rank
    complex(wp), allocatable :: product(:)
    PetscErrorCode :: ierr
    integer :: entry, before

    before = factors%before(this_rank() + 1)
    if (transposed) then
      allocate (product(size(vector)), source=(0.0_wp, 0.0_wp))
      do entry = 1, factors%filled
        associate (one => product(factors%column(entry)))
          one = one + factors%value(entry)*vector(factors%row(entry))
        end associate
      end do
      call MPI_Allreduce(MPI_IN_PLACE, product, size(product), MPI_DOUBLE_COMPLEX, MPI_SUM, PETSC_COMM_WORLD, ierr)
      rest = rest - product(before + 1:before + size(rest))
      return
    end if
    do entry = 1, factors%filled
      associate (one => rest(factors%row(entry) - before))
        one = one - factors%value(entry)*vector(factors%column(entry))
      end associate
    end do
  end subroutine subtract_product

  !> Largest real or imaginary part.
  pure real(wp) function largest_of(values) result(largest)
    complex(wp), intent(in) :: values(:)
    largest = max(0.0_wp, maxval(abs(real(values, wp))), maxval(abs(aimag(values))))
  end function largest_of

  !> This rank's entries of a vector.
  function values_of(vector) result(values)
    Vec, intent(in) :: vector
    real(wp), allocatable :: values(:)
    PetscScalar, pointer :: own(:)
    PetscErrorCode :: ierr

    PetscCallA(GFB_VecGetArrayRead(vector, own, ierr))
    values = own
    PetscCallA(GFB_VecRestoreArrayRead(vector, own, ierr))
  end function values_of

  !> The reverse.
  subroutine put_values(values, vector)
    real(wp), intent(in) :: values(:)
    Vec, intent(in) :: vector
    PetscScalar, pointer :: own(:)
    PetscErrorCode :: ierr

    PetscCallA(GFB_VecGetArray(vector, own, ierr))
    own = values
    PetscCallA(GFB_VecRestoreArray(vector, own, ierr))
  end subroutine put_values

  !> Why nothing was solved.
  function factors_failure(status) result(words)
    integer, intent(in) :: status !! MUMPS' INFOG(1), not negative where there are factors
    character(len=:), allocatable :: words

    words = 'the solution does not meet the equations, whose matrix is next to singular'
    if (status < 0) words = failure_in_words(status)
  end function factors_failure

  !> Factors have the determinant.
  pure logical function factors_have_one() result(has)
    has = .true.
  end function factors_have_one

  !> Frees what MUMPS holds.
  subroutine destroy_complex_factors(self)
    class(complex_factors_type), intent(inout) :: self !! created before

    if (c_associated(self%mumps)) call gfb_mumps_destroy(self%mumps)
    call self%release()
    deallocate (self%row, self%column)
  end subroutine destroy_complex_factors
end module gfb_complex_factors
