#include "gfb_petsc.h"
!> Whether an equilibrium of the foils is stable while the shaft is fixed.
!>
!> The foil's stiffness with the film eliminated, \( K \), is not symmetric: film and sliding friction
!> see to that. How many of its eigenvalues are negative is one measure; it weighs displacements and
!> rotations of all nodes alike, in SI units. Which modes grow depends on what resists motion. Here
!> that is a damping of the top foil's motion towards the shaft, the same all over its area, as the gas
!> that has to leave the gap gives it; nothing else has any. With \( M \) the film nodes' shares of the
!> area,
!>
!> $$ K u = \lambda \frac{p_a}{C} M u, $$
!>
!> and a mode grows where the real part of \( \lambda \) is negative. \( \lambda p_a / C \) is the
!> pressure that resists a deflection, whatever mesh and units are; the film's own stiffness makes
!> \( \lambda \) of size 1, a foil's is added to it.
module gfb_stability
  use slepceps
  use petscksp
  use gfb_kinds, only: wp
  use gfb_petsc_kinds, only: pint
  use gfb_operating_point, only: operating_point_type
  use gfb_pad, only: pad_type
  use gfb_bearing_system, only: bearing_system_type
  use gfb_bearing_directions, only: foil_unit
  use gfb_direct_solver, only: use_factors, factor_matrix
  implicit none (type)
  private
  public :: find_stability, find_growth

  character(len=*), parameter :: prefix = 'stability_' !! of PETSc's options
  real(wp), parameter :: neutral = 0.01_wp      !! next to none: p_a/100 moves the mode by all of C [1]
  real(wp), parameter :: safe_share = 0.5_wp    !! of the shift, that no mode may grow beyond
  real(wp), parameter :: tolerance = 1.0e-11_wp !! of the eigenvalues, relative to the shift
  real(wp), parameter :: too_near = 1.0e-8_wp   !! a real part no larger leaves a determinant's sign open
  integer, parameter :: most_shifts = 5         !! each is four times the one before
  integer, parameter :: first_wanted = 6        !! modes looked for
  integer, parameter :: most_restarts = 50      !! of the iteration that finds them
  integer, parameter :: krylov_room = 40        !! vectors kept beyond them

  !> How the foils stand.
  type, public :: stability_type
    logical :: found = .false.          !! the modes were
    logical :: counted = .false.        !! the negative eigenvalues of K were
    integer :: negative = 0             !! them, by their real parts
    integer :: growing = 0              !! eigenvalues lambda with negative real part
    complex(wp) :: nearest = 0.0_wp     !! lambda nearest to a change, its real part the smallest [1]
    logical :: nearly_neutral = .false. !! it is next to none
    integer :: factorizations = 0       !! spent
    integer :: enlargements = 0         !! of the factors' workspace
  end type stability_type

contains

  !> Stability of the bearing's foils at its present state, which must be an answer. Where half the
  !> width is solved only modes that are symmetric about z = 0 are seen.
  !>
  !> Bearing, state and matrix are left as they were.
  subroutine find_stability(bearing, stability)
    type(bearing_system_type), intent(inout) :: bearing !! of foils with unknowns of their own
    type(stability_type), intent(out) :: stability !! what was found

    type(operating_point_type) :: fixed
    type(stability_type) :: plain
    Mat :: stiffness
    Vec :: damping
    PetscErrorCode :: ierr

    fixed = bearing%point
    fixed%place(:2) = bearing%eccentricity()
    call bearing%linearise_at(fixed, .true., bearing%state)
    PetscCallA(MatDuplicate(bearing%jacobian, MAT_COPY_VALUES, stiffness, ierr))
    call bearing%linearise(bearing%state)
    PetscCallA(VecDuplicate(bearing%state, damping, ierr))
    call measure_damping(bearing, damping)
    call find_growth(stiffness, damping, bearing%dense_rows, stability)
    call foil_unit(bearing, damping)
    call find_growth(stiffness, damping, bearing%dense_rows, plain)
    stability%counted = plain%found
    stability%negative = plain%growing
    stability%factorizations = stability%factorizations + plain%factorizations
    stability%enlargements = stability%enlargements + plain%enlargements
    PetscCallA(VecDestroy(damping, ierr))
    PetscCallA(MatDestroy(stiffness, ierr))
  end subroutine find_stability

  !> p_a/C times the area that moves with each unknown of the foil towards the shaft, scaled as the
  !> bearing's matrix is; 0 for all other unknowns.
  subroutine measure_damping(bearing, damping)
    type(bearing_system_type), intent(in) :: bearing
    Vec, intent(in) :: damping
    real(wp) :: value(bearing%local_size())
    integer :: i

    value = 0.0_wp
    do i = 1, size(bearing%pad)
      associate (pad => bearing%pad(i))
        call measure_pad(pad, value(pad%first + 1:pad%last))
      end associate
    end do
    value = value*bearing%ambient_pressure/bearing%clearance
    call bearing%add_up(value, damping)
  end subroutine measure_damping

  !> The area that moves with each unknown of a pad's foil.
  pure subroutine measure_pad(pad, value)
    type(pad_type), intent(in) :: pad
    real(wp), intent(inout) :: value(:) !! one an unknown of the pad, zero before
    real(wp) :: area(size(pad%mesh%mesh_node))
    integer :: element, node, last

    area = 0.0_wp
    associate (film => pad%film)
      do element = 1, size(film%element_nodes, 2)
        associate (nodes => film%element_nodes(:, element))
          area(nodes) = area(nodes) + matmul(film%shape, film%geometry(element)%area)
        end associate
      end do
    end associate
    associate (foil => pad%foil)
      do node = 1, size(area)
        if (foil%source(node) <= foil%first) cycle ! fixed
        associate (sum => value(foil%source(node)))
          sum = sum + foil%rate(node)**2*area(node)
        end associate
      end do
      last = foil%first + foil%local_unknowns()
      associate (mine => value(foil%first + 1:last))
        mine = mine*foil%unknown_scale**2/foil%equation_scale ! one of them is divided out again
      end associate
    end associate
  end subroutine measure_pad

  !> Eigenvalues of \( A y = \lambda B y \) next to and beyond zero, where B is a damping of some of the
  !> unknowns.
  !>
  !> With \( B = D D \) the eigenvalues of \( D (A + \tau B)^{-1} D \) on the damped unknowns are
  !> \( 1/(\lambda + \tau) \): no infinite one is among them, and those of modes that grow or hardly
  !> decay are the largest. A shift \( \tau \) that is not well beyond the fastest growth is enlarged.
  subroutine find_growth(stiffness, damping, dense_rows, stability)
    Mat, intent(in) :: stiffness      !! A
    Vec, intent(in) :: damping        !! B's diagonal, not negative
    logical, intent(in) :: dense_rows !! a few rows of A are almost full
    type(stability_type), intent(out) :: stability !! what was found

    Mat :: shifted, gather, spread, operator
    KSP :: inner
    PetscErrorCode :: ierr
    complex(wp), allocatable :: value(:)
    real(wp) :: shift
    integer :: attempt, sign_of_shifted
    logical :: safe

    call create_selection(damping, gather)
    PetscCallA(MatTranspose(gather, MAT_INITIAL_MATRIX, spread, ierr))
    PetscCallA(MatScale(spread, -1.0_wp, ierr)) ! a Schur complement is what is taken away
    PetscCallA(MatDuplicate(stiffness, MAT_COPY_VALUES, shifted, ierr))
    PetscCallA(MatCreateSchurComplement(shifted, shifted, spread, gather, PETSC_NULL_MAT, operator, ierr))
    PetscCallA(MatSchurComplementGetKSP(operator, inner, ierr))
    PetscCallA(KSPSetOptionsPrefix(inner, prefix, ierr))
    call use_factors(inner, prefix, .false., dense_rows)
    PetscCallA(KSPSetFromOptions(inner, ierr))
    shift = 1.0_wp ! their size where the film is stiff
    do attempt = 1, most_shifts
      call shift_matrix(stiffness, damping, shift, shifted)
      call factor_matrix(inner, shifted, sign_of_shifted, stability%enlargements)
      stability%factorizations = stability%factorizations + 1
      safe = sign_of_shifted /= 0
      if (safe) call leading_values(operator, shift, value)
      if (safe) safe = size(value) > 0
      if (safe) safe = all(real(value) > -safe_share*shift) ! not so for NaN
      if (safe) exit
      shift = 4.0_wp*shift
    end do
    if (safe) then
      call judge_values(value, stability)
      call shift_matrix(stiffness, damping, 0.0_wp, shifted)
      call check_parity(shifted, inner, sign_of_shifted, value, stability)
    end if
    PetscCallA(MatDestroy(operator, ierr))
    PetscCallA(MatDestroy(shifted, ierr))
    PetscCallA(MatDestroy(spread, ierr))
    PetscCallA(MatDestroy(gather, ierr))
  end subroutine find_growth

  !> Square roots of the damping, as a matrix that takes the damped unknowns from all of them.
  subroutine create_selection(damping, gather)
    Vec, intent(in) :: damping
    Mat, intent(out) :: gather
    PetscInt, parameter :: none = 0, one = 1
    PetscScalar, pointer :: values(:)
    PetscInt, allocatable :: number(:)
    PetscInt :: first, last, first_row, last_row, i
    PetscErrorCode :: ierr

    PetscCallA(VecGetOwnershipRange(damping, first, last, ierr))
    PetscCallA(GFB_VecGetArrayRead(damping, values, ierr))
    number = pack([(i, i=1, last - first)], values(:last - first) > 0.0_wp)
    PetscCallA(MatCreateAIJ(PETSC_COMM_WORLD, size(number, kind=pint), last - first, PETSC_DETERMINE, PETSC_DETERMINE, one, PETSC_NULL_INTEGER_ARRAY, none, PETSC_NULL_INTEGER_ARRAY, gather, ierr))
    PetscCallA(MatGetOwnershipRange(gather, first_row, last_row, ierr))
    do i = 1, size(number, kind=pint)
      PetscCallA(MatSetValue(gather, first_row + i - 1, first + number(i) - 1, sqrt(values(number(i))), INSERT_VALUES, ierr))
    end do
    PetscCallA(GFB_VecRestoreArrayRead(damping, values, ierr))
    PetscCallA(MatAssemblyBegin(gather, MAT_FINAL_ASSEMBLY, ierr))
    PetscCallA(MatAssemblyEnd(gather, MAT_FINAL_ASSEMBLY, ierr))
  end subroutine create_selection

  !> A + tau B.
  subroutine shift_matrix(stiffness, damping, shift, shifted)
    Mat, intent(in) :: stiffness
    Vec, intent(in) :: damping
    real(wp), intent(in) :: shift !! tau
    Mat, intent(in) :: shifted
    Vec :: diagonal
    PetscErrorCode :: ierr

    PetscCallA(VecDuplicate(damping, diagonal, ierr))
    PetscCallA(VecCopy(damping, diagonal, ierr))
    PetscCallA(VecScale(diagonal, shift, ierr))
    PetscCallA(MatCopy(stiffness, shifted, SAME_NONZERO_PATTERN, ierr))
    PetscCallA(MatDiagonalSet(shifted, diagonal, ADD_VALUES, ierr))
    PetscCallA(VecDestroy(diagonal, ierr))
  end subroutine shift_matrix

  !> Eigenvalues with the smallest real parts, in rising order: as many as are negative, and a few
  !> more. None where the iteration does not converge.
  subroutine leading_values(operator, shift, value)
    Mat, intent(in) :: operator   !! with eigenvalues 1/(lambda + tau)
    real(wp), intent(in) :: shift !! tau
    complex(wp), allocatable, intent(out) :: value(:)

    EPS :: solver
    PetscInt :: unknowns, columns, wanted, found, i
    PetscScalar :: real_part, imaginary_part
    PetscErrorCode :: ierr

    allocate (value(0))
    PetscCallA(MatGetSize(operator, unknowns, columns, ierr))
    if (unknowns == 0) return
    PetscCallA(EPSCreate(PETSC_COMM_WORLD, solver, ierr))
    PetscCallA(EPSSetOptionsPrefix(solver, prefix, ierr))
    PetscCallA(EPSSetOperators(solver, operator, PETSC_NULL_MAT, ierr))
    PetscCallA(EPSSetProblemType(solver, EPS_NHEP, ierr))
    PetscCallA(EPSSetEigenvalueComparison(solver, compare_values, operator, ierr)) ! any object, as long as a pointer
    PetscCallA(EPSSetConvergenceTest(solver, EPS_CONV_ABS, ierr)) ! the others are next to nothing
    PetscCallA(EPSSetTolerances(solver, tolerance/shift, int(most_restarts, pint), ierr))
    PetscCallA(EPSSetFromOptions(solver, ierr))
    wanted = min(int(first_wanted, pint), unknowns)
    do
      PetscCallA(EPSSetDimensions(solver, wanted, min(2*wanted + int(krylov_room, pint), unknowns), PETSC_DEFAULT_INTEGER, ierr))
      PetscCallA(EPSSolve(solver, ierr))
      PetscCallA(EPSGetConverged(solver, found, ierr))
      if (found < wanted) exit
      deallocate (value)
      allocate (value(found))
      do i = 1, found
        PetscCallA(EPSGetEigenvalue(solver, i - 1, real_part, imaginary_part, ierr))
        value(i) = inverse_of(real_part, imaginary_part) - shift
      end do
      if (any(real(value) >= 0.0_wp) .or. wanted == unknowns) exit
      wanted = min(2*wanted, unknowns)
      deallocate (value)
      allocate (value(0))
    end do
    PetscCallA(EPSDestroy(solver, ierr))
  end subroutine leading_values

  !> SLEPc callback. Which of two eigenvalues 1/(lambda + tau) has the lambda with the smaller real
  !> part.
  subroutine compare_values(first_real, first_imaginary, second_real, second_imaginary, order, context, ierr)
    PetscScalar, intent(in) :: first_real, first_imaginary, second_real, second_imaginary
    PetscInt, intent(out) :: order !! -1: the first
    Mat, intent(in) :: context !! not needed
    PetscErrorCode, intent(out) :: ierr
    real(wp) :: first, second

    first = real(inverse_of(first_real, first_imaginary))
    second = real(inverse_of(second_real, second_imaginary))
    order = 0
    if (first < second) order = -1
    if (first > second) order = 1
    ierr = 0
  end subroutine compare_values

  !> Inverse of a complex number, huge where it is nothing.
  pure function inverse_of(real_part, imaginary_part) result(inverse)
    real(wp), intent(in) :: real_part, imaginary_part
    complex(wp) :: inverse

    inverse = huge(1.0_wp)
    if (hypot(real_part, imaginary_part) <= sqrt(tiny(1.0_wp))) return
    inverse = 1.0_wp/cmplx(real_part, imaginary_part, wp)
  end function inverse_of

  !> Counts, and picks the eigenvalue whose mode is nearest to change its mind.
  pure subroutine judge_values(value, stability)
    complex(wp), intent(in) :: value(:) !! all that are negative, and at least one more if there is
    type(stability_type), intent(inout) :: stability

    stability%found = .true.
    stability%growing = count(real(value) < 0.0_wp)
    stability%nearest = value(minloc(abs(real(value)), 1))
    stability%nearest = cmplx(real(stability%nearest), abs(aimag(stability%nearest)), wp)
    stability%nearly_neutral = abs(real(stability%nearest)) <= neutral
  end subroutine judge_values

  !> Between A and A + tau B the determinant changes its sign once for every real negative
  !> eigenvalue. Where their number does not fit, nothing was found.
  subroutine check_parity(stiffness, linear, sign_of_shifted, value, stability)
    Mat, intent(in) :: stiffness
    KSP, intent(in) :: linear !! prepared for factors
    integer, intent(in) :: sign_of_shifted
    complex(wp), intent(in) :: value(:)
    type(stability_type), intent(inout) :: stability
    integer :: signs

    if (any(abs(value) <= too_near)) return
    call factor_matrix(linear, stiffness, signs, stability%enlargements)
    stability%factorizations = stability%factorizations + 1
    signs = signs*sign_of_shifted
    if (signs == 0) return
    associate (negative => count(real(value) < 0.0_wp .and. abs(aimag(value)) <= 0.0_wp))
      stability%found = modulo(negative, 2) == merge(0, 1, signs > 0)
    end associate
  end subroutine check_parity
end module gfb_stability
