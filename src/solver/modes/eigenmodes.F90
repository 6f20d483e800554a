#include "gfb_petsc.h"
!> Lowest natural modes of a structure.
!>
!> $$ K \phi = \omega^2 M \phi, \qquad \phi_i^T M \phi_j = \delta_{ij} $$
!>
!> Lanczos' method on the shifted inverse \( (K + s M)^{-1} M \), which MUMPS factorizes once. A
!> positive s makes it definite for a structure that moves freely.
!>
!> Ritz's method over a few vectors: their products in the mass, the small eigenvalue problem, their sums.
!>
!> $$ A q = \omega^2 B q, \qquad \phi = \sum_i q_i v_i $$
!>
!> Lanczos' method for the lowest modes: the largest eigenvalues of a stiffness' inverse over a mass.
!>
!> $$ K^{-1} M V_m = V_m T_m + \beta_m v_{m+1} e_m^T, \qquad V_m^T M V_m = I $$
!>
!> The products \( M v \) are kept beside the vectors, so a step costs one solve and one product: with them each new
!> vector is put at right angles to all before it, twice, without another product. Of equal eigenvalues one is sure to
!> be found, the others by round-off. Source: [Parlett1980].
!>
!> SLEPc's Krylov-Schur method with shift and invert finds the same frequencies (to 4e-14), but takes three times as long:
!> `inputs/strip_modes.nml` as a whole 1.5 times. It takes more solves, and a product with the mass costs it more.
module gfb_eigenmodes
  use petscmat
  use petscksp
  use gfb_kinds, only: wp
  use gfb_petsc_kinds, only: pint
  implicit none (type)
  private
  public :: mass_products, solve_symmetric, combine, lowest_modes, factor_shifted, destroy_modes

  interface
    !> LAPACK: eigenvalues and vectors of a symmetric matrix over a positive definite one.
    subroutine dsygv(itype, jobz, uplo, n, a, lda, b, ldb, w, work, lwork, info)
      import :: wp
      implicit none (type, external)
      integer, intent(in) :: itype, n, lda, ldb, lwork
      character(len=1), intent(in) :: jobz, uplo
      real(wp), intent(inout) :: a(lda, n), b(ldb, n)
      real(wp), intent(out) :: w(n), work(lwork)
      integer, intent(out) :: info
    end subroutine dsygv
  end interface

  integer, parameter :: steps_a_check = 4 !! after which convergence is asked for again
  integer, parameter :: passes = 2        !! after which a vector is at right angles to working accuracy
  integer, parameter :: steps_a_mode = 20, steps_more = 200 !! at most
  real(wp), parameter :: none_left = 1.0e-13_wp !! of a step's vector, relative: an invariant space is complete [1]

  !> Vectors at right angles in the mass, and their products with it.
  type :: basis_type
    integer :: used = 0
    Vec, allocatable :: vector(:), momentum(:)
  end type basis_type

  interface
    !> LAPACK: eigenvalues, in rising order, and vectors of a symmetric tridiagonal matrix.
    subroutine dstev(jobz, n, d, e, z, ldz, work, info)
      import :: wp
      implicit none (type, external)
      character(len=1), intent(in) :: jobz
      integer, intent(in) :: n, ldz
      real(wp), intent(inout) :: d(n), e(n)
      real(wp), intent(out) :: z(ldz, n), work(2*n)
      integer, intent(out) :: info
    end subroutine dstev
  end interface

  real(wp), parameter :: tolerance = 1.0e-10_wp !! of the eigenvalues, relative [1]

  !> Modes in rising order.
  type, public :: modes_type
    Vec, allocatable, public :: shape(:)   !! normalised by the mass
    real(wp), allocatable :: eigenvalue(:) !! omega squared [1/s2]
  end type modes_type

contains

  !> Products of vectors in the mass.
  function mass_products(shape, mass) result(modal_mass)
    Vec, intent(in) :: shape(:) !! n vectors
    Mat, intent(in) :: mass !! M
    real(wp) :: modal_mass(size(shape), size(shape))
    PetscScalar :: product
    Vec :: momentum
    PetscErrorCode :: ierr
    integer :: i, k

    PetscCallA(VecDuplicate(shape(1), momentum, ierr))
    do k = 1, size(shape)
      PetscCallA(MatMult(mass, shape(k), momentum, ierr))
      do i = 1, k
        PetscCallA(VecDot(shape(i), momentum, product, ierr))
        modal_mass(i, k) = product
        modal_mass(k, i) = product
      end do
    end do
    PetscCallA(VecDestroy(momentum, ierr))
  end function mass_products

  !> Eigenvalues, in rising order, and vectors of a symmetric matrix over a positive definite one.
  subroutine solve_symmetric(matrix, over, eigenvalue)
    !> (n, n) upper triangle is read, in any unit [SI]; out: the vectors, scaled to 1 over the other matrix
    real(wp), intent(inout) :: matrix(:, :)
    real(wp), intent(inout) :: over(:, :) !! (n, n), positive definite, in any unit [SI]; unchanged
    real(wp), intent(out) :: eigenvalue(:) !! (n), rising, in the unit of `matrix` over that of `over` [SI]
    real(wp) :: vectors(size(eigenvalue), size(eigenvalue)), below(size(eigenvalue), size(eigenvalue))
    real(wp) :: work(8*size(eigenvalue))
    integer :: info, n

    n = size(eigenvalue)
    vectors = matrix
    below = over
    call dsygv(1, 'V', 'U', n, vectors, n, below, n, eigenvalue, work, size(work), info)
    if (info /= 0) error stop 'modes that are not independent'
    matrix = vectors
  end subroutine solve_symmetric

  !> Sums of vectors.
  subroutine combine(weight, old, new)
    real(wp), intent(in) :: weight(:, :) !! (old, new) [1]
    Vec, intent(in) :: old(:) !! vectors that are summed
    Vec, intent(in) :: new(:)            !! others than the old
    PetscErrorCode :: ierr
    integer :: i, k

    do k = 1, size(new)
      PetscCallA(VecSet(new(k), 0.0_wp, ierr))
      do i = 1, size(old)
        PetscCallA(VecAXPY(new(k), weight(i, k), old(i), ierr))
      end do
    end do
  end subroutine combine

  !> The largest eigenvalues \( K^{-1} M \phi = \theta \phi \), falling, and their vectors of unit modal mass.
  !>
  !> Fewer than asked for where the space or the steps have no more.
  subroutine find_largest(solver, mass, locked, wanted, tolerance, eigenvalue, shape)
    KSP, intent(in) :: solver  !! of the definite stiffness K
    Mat, intent(in) :: mass    !! M
    Vec, intent(in) :: locked(:) !! vectors of unit modal mass to which all others are at right angles
    integer, intent(in) :: wanted !! eigenvalues asked for, not more than the unknowns that `locked` leaves
    real(wp), intent(in) :: tolerance !! residual over eigenvalue [1]
    real(wp), allocatable, intent(out) :: eigenvalue(:) !! theta, of the inverse stiffness times the mass [SI]
    Vec, allocatable, intent(out) :: shape(:) !! their vectors

    type(basis_type) :: basis
    real(wp), allocatable :: diagonal(:), beside(:), vectors(:, :)
    PetscRandom :: random
    PetscInt :: unknowns, columns
    PetscErrorCode :: ierr
    integer :: communicator, most, step, found, i

    PetscCallA(MatGetSize(mass, unknowns, columns, ierr))
    most = min(int(unknowns) - size(locked), steps_a_mode*wanted + steps_more)
    allocate (basis%vector(size(locked) + most + 1), basis%momentum(size(locked) + most + 1))
    allocate (diagonal(most), beside(most), eigenvalue(0), vectors(0, 0))
    found = 0
    PetscCallA(PetscObjectGetComm(mass, communicator, ierr))
    PetscCallA(PetscRandomCreate(communicator, random, ierr)) ! other numbers on each rank
    PetscCallA(PetscRandomSetFromOptions(random, ierr))
    do i = 1, size(locked)
      call add_vector(mass, locked(i), basis)
    end do
    call add_start(solver, mass, random, basis)
    do step = 1, most
      call take_step(solver, mass, basis, diagonal(step), beside(step))
      if (step == int(unknowns) - size(locked) .or. beside(step) <= none_left*maxval(diagonal(:step))) beside(step) = 0.0_wp
      if (step >= wanted .and. (mod(step, steps_a_check) == 0 .or. step == most .or. beside(step) <= 0.0_wp)) then
        call solve_projected(diagonal(:step), beside(:step), tolerance, eigenvalue, vectors, found)
        if (found >= wanted .or. step == most) exit
      end if
      if (beside(step) <= 0.0_wp) call replace_last(solver, mass, random, basis)
    end do
    found = min(found, wanted)
    eigenvalue = eigenvalue(:found)
    allocate (shape(found))
    do i = 1, found
      PetscCallA(VecDuplicate(basis%vector(1), shape(i), ierr))
    end do
    associate (first => size(locked))
      call combine(vectors(:, :found), basis%vector(first + 1:first + size(vectors, 1)), shape)
    end associate
    call destroy_basis(basis)
    PetscCallA(PetscRandomDestroy(random, ierr))
  end subroutine find_largest

  !> A step from the last vector of a basis: its entries of the tridiagonal matrix, and the next vector.
  subroutine take_step(solver, mass, basis, diagonal, beside)
    KSP, intent(in) :: solver
    Mat, intent(in) :: mass
    type(basis_type), intent(inout) :: basis
    real(wp), intent(out) :: diagonal, beside !! entries in the step's column, on and below the diagonal
    Vec :: next
    PetscErrorCode :: ierr

    PetscCallA(VecDuplicate(basis%vector(1), next, ierr))
    PetscCallA(KSPSolve(solver, basis%momentum(basis%used), next, ierr))
    call straighten(basis, next, diagonal)
    call add_vector(mass, next, basis, beside)
    PetscCallA(VecDestroy(next, ierr))
  end subroutine take_step

  !> Puts a vector at right angles to a basis.
  subroutine straighten(basis, vector, last)
    type(basis_type), intent(in) :: basis
    Vec, intent(in) :: vector
    real(wp), intent(out) :: last !! share of the basis' last vector that it had
    PetscScalar :: product(basis%used)
    PetscErrorCode :: ierr
    integer :: pass

    last = 0.0_wp
    do pass = 1, passes
      PetscCallA(VecMDot(vector, int(basis%used, pint), basis%momentum(:basis%used), product, ierr))
      PetscCallA(VecMAXPY(vector, int(basis%used, pint), -product, basis%vector(:basis%used), ierr))
      last = last + product(basis%used)
    end do
  end subroutine straighten

  !> Adds a vector to a basis, scaled to unit modal mass.
  subroutine add_vector(mass, vector, basis, length)
    Mat, intent(in) :: mass
    Vec, intent(in) :: vector
    type(basis_type), intent(inout) :: basis
    real(wp), intent(out), optional :: length !! it had before, in the mass
    PetscScalar :: square
    PetscErrorCode :: ierr
    real(wp) :: scale

    basis%used = basis%used + 1
    associate (new => basis%vector(basis%used), momentum => basis%momentum(basis%used))
      PetscCallA(VecDuplicate(vector, new, ierr))
      PetscCallA(VecDuplicate(vector, momentum, ierr))
      PetscCallA(VecCopy(vector, new, ierr))
      PetscCallA(MatMult(mass, new, momentum, ierr))
      PetscCallA(VecDot(new, momentum, square, ierr))
      scale = sqrt(max(real(square, wp), tiny(1.0_wp)))
      PetscCallA(VecScale(new, 1.0_wp/scale, ierr))
      PetscCallA(VecScale(momentum, 1.0_wp/scale, ierr))
    end associate
    if (present(length)) length = scale
  end subroutine add_vector

  !> Adds a random vector of the operator's range, at right angles to a basis.
  subroutine add_start(solver, mass, random, basis)
    KSP, intent(in) :: solver
    Mat, intent(in) :: mass
    PetscRandom, intent(in) :: random
    type(basis_type), intent(inout) :: basis
    Vec :: start, momentum
    PetscErrorCode :: ierr
    real(wp) :: share

    PetscCallA(MatCreateVecs(mass, start, momentum, ierr))
    PetscCallA(VecSetRandom(start, random, ierr))
    PetscCallA(MatMult(mass, start, momentum, ierr))
    PetscCallA(KSPSolve(solver, momentum, start, ierr))
    if (basis%used > 0) call straighten(basis, start, share)
    call add_vector(mass, start, basis)
    PetscCallA(VecDestroy(start, ierr))
    PetscCallA(VecDestroy(momentum, ierr))
  end subroutine add_start

  !> Puts a random vector where a step left nothing.
  subroutine replace_last(solver, mass, random, basis)
    KSP, intent(in) :: solver
    Mat, intent(in) :: mass
    PetscRandom, intent(in) :: random
    type(basis_type), intent(inout) :: basis
    PetscErrorCode :: ierr

    PetscCallA(VecDestroy(basis%vector(basis%used), ierr))
    PetscCallA(VecDestroy(basis%momentum(basis%used), ierr))
    basis%used = basis%used - 1
    call add_start(solver, mass, random, basis)
  end subroutine replace_last

  !> Eigenvalues, falling, and vectors of the tridiagonal matrix, and how many of the first have converged.
  subroutine solve_projected(diagonal, beside, tolerance, eigenvalue, vectors, found)
    real(wp), intent(in) :: diagonal(:), beside(:) !! (steps) on the diagonal and below it
    real(wp), intent(in) :: tolerance
    real(wp), allocatable, intent(out) :: eigenvalue(:), vectors(:, :)
    integer, intent(out) :: found
    real(wp) :: below(size(diagonal)), work(2*size(diagonal))
    integer :: info, steps

    steps = size(diagonal)
    allocate (vectors(steps, steps))
    eigenvalue = diagonal
    below = beside
    call dstev('V', steps, eigenvalue, below, vectors, steps, work, info)
    if (info /= 0) error stop 'eigenvalues of a tridiagonal matrix were not found'
    eigenvalue = eigenvalue(steps:1:-1)
    vectors = vectors(:, steps:1:-1)
    do found = 0, steps - 1
      if (beside(steps)*abs(vectors(steps, found + 1)) > tolerance*eigenvalue(found + 1)) exit
    end do
  end subroutine solve_projected

  !> Frees what PETSc holds.
  subroutine destroy_basis(basis)
    type(basis_type), intent(inout) :: basis
    PetscErrorCode :: ierr
    integer :: i

    do i = 1, basis%used
      PetscCallA(VecDestroy(basis%vector(i), ierr))
      PetscCallA(VecDestroy(basis%momentum(i), ierr))
    end do
  end subroutine destroy_basis

  !> The lowest modes; fewer where the structure or the iteration has no more.
  !>
  !> Motions without strain that are known are taken as they are, and come first; the iteration looks
  !> for what is at right angles to them.
  subroutine lowest_modes(stiffness, mass, shift, wanted, modes, known)
    Mat, intent(in) :: stiffness, mass  !! K and M
    real(wp), intent(in) :: shift       !! s, not negative [1/s2]
    integer, intent(in) :: wanted       !! modes asked for
    type(modes_type), intent(out) :: modes !! of unit modal mass, in rising order
    type(modes_type), intent(in), optional :: known !! motions without strain, of unit modal mass

    real(wp), allocatable :: inverse(:)
    Vec, allocatable :: shape(:)
    KSP :: solver
    PetscInt :: unknowns, columns
    PetscErrorCode :: ierr
    integer :: elastic

    modes%eigenvalue = [real(wp) ::]
    allocate (modes%shape(0))
    if (present(known)) call copy_modes(known, wanted, modes)
    PetscCallA(MatGetSize(stiffness, unknowns, columns, ierr))
    elastic = min(wanted, int(unknowns)) - size(modes%shape)
    if (elastic <= 0) return
    call factor_shifted(stiffness, mass, shift, 'modes_', solver)
    call find_largest(solver, mass, modes%shape, elastic, tolerance, inverse, shape)
    PetscCallA(KSPDestroy(solver, ierr))
    modes%eigenvalue = [modes%eigenvalue, 1.0_wp/inverse - shift]
    modes%shape = [modes%shape, shape]
  end subroutine lowest_modes

  !> Copies of the first modes.
  subroutine copy_modes(modes, wanted, copies)
    type(modes_type), intent(in) :: modes
    integer, intent(in) :: wanted !! of them at most
    type(modes_type), intent(out) :: copies
    PetscErrorCode :: ierr
    integer :: i

    copies%eigenvalue = modes%eigenvalue(:min(wanted, size(modes%eigenvalue)))
    allocate (copies%shape(size(copies%eigenvalue)))
    do i = 1, size(copies%shape)
      PetscCallA(VecDuplicate(modes%shape(i), copies%shape(i), ierr))
      PetscCallA(VecCopy(modes%shape(i), copies%shape(i), ierr))
    end do
  end subroutine copy_modes

  !> Factors of the stiffness with a shift.
  subroutine factor_shifted(stiffness, mass, shift, prefix, solver)
    Mat, intent(in) :: stiffness, mass !! K and M
    real(wp), intent(in) :: shift !! s, not negative [1/s2]
    character(len=*), intent(in) :: prefix !! of PETSc's options
    KSP, intent(out) :: solver !! of K + s M
    integer :: communicator
    Mat :: shifted
    PC :: factors
    PetscErrorCode :: ierr

    PetscCallA(PetscObjectGetComm(stiffness, communicator, ierr))
    PetscCallA(KSPCreate(communicator, solver, ierr))
    PetscCallA(KSPSetOptionsPrefix(solver, prefix, ierr))
    if (shift > 0.0_wp) then
      PetscCallA(MatDuplicate(stiffness, MAT_COPY_VALUES, shifted, ierr))
      PetscCallA(MatAXPY(shifted, shift, mass, UNKNOWN_NONZERO_PATTERN, ierr))
      PetscCallA(KSPSetOperators(solver, shifted, shifted, ierr))
      PetscCallA(MatDestroy(shifted, ierr)) ! the solver holds it
    else
      PetscCallA(KSPSetOperators(solver, stiffness, stiffness, ierr))
    end if
    PetscCallA(KSPSetType(solver, KSPPREONLY, ierr))
    PetscCallA(KSPGetPC(solver, factors, ierr))
    PetscCallA(PCSetType(factors, PCCHOLESKY, ierr))
    PetscCallA(PCFactorSetMatSolverType(factors, MATSOLVERMUMPS, ierr))
    PetscCallA(KSPSetFromOptions(solver, ierr))
  end subroutine factor_shifted

  !> Frees what PETSc holds; may be called twice.
  subroutine destroy_modes(modes)
    type(modes_type), intent(inout) :: modes !! are freed
    PetscErrorCode :: ierr
    integer :: i

    if (.not. allocated(modes%shape)) return
    do i = 1, size(modes%shape)
      PetscCallA(VecDestroy(modes%shape(i), ierr))
    end do
    deallocate (modes%shape)
  end subroutine destroy_modes
end module gfb_eigenmodes
