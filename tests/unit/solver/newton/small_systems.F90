#include "gfb_petsc.h"
!> Equations that Newton's method is tried on, each unknown alone.
module small_systems
  use, intrinsic :: ieee_exceptions, only: ieee_usual, ieee_get_halting_mode
  use petscmat
  use gfb_kinds, only: wp
  use gfb_petsc_kinds, only: pint
  use gfb_nonlinear_system, only: nonlinear_system_type
  use gfb_newton, only: newton_type, newton_settings_type, newton_report_type, create_newton, solve_newton, destroy_newton
  use gfb_run_log, only: run_log_type
  implicit none (type)
  private
  public :: create_small, solve_small, error_of

  integer, parameter, public :: unknowns = 12, longest = 60

  integer, parameter, public :: squares = 1   !! x_i^2 = i, where x > 0
  integer, parameter, public :: no_root = 2   !! x_i^2 = -i
  integer, parameter, public :: singular = 3  !! x_1 = 2, and all others x_i - x_i = 1
  integer, parameter, public :: bounded = 4   !! atan(x_i - 3) = 0, which full steps overshoot, where x > 0
  integer, parameter, public :: outside = 5   !! x_i = -1, where x > 0
  integer, parameter, public :: uphill = 6    !! x_i = 1, with a matrix of the wrong sign
  integer, parameter, public :: stopped = 7   !! x_i = 1 with a stop at 0.1, which is `hard`
  integer, parameter, public :: fold = 8      !! x_1^2 = 1e-4, and all others x_i = 2

  real(wp), parameter, public :: stop_at = 0.1_wp !! where that begins

  !> Equations that are solved for each unknown alone.
  type, extends(nonlinear_system_type), public :: small_type
    integer :: law = squares
    real(wp) :: error(longest) = 0.0_wp !! largest error of the states at which it was linearised
    real(wp) :: place(longest) = 0.0_wp !! the largest unknown there
    integer :: linearised = 0
    real(wp) :: hard = 0.0_wp !! stiffness of stops, over that of the springs
    logical :: closed = .false. !! they were at the last state at which contacts were looked at
    real(wp) :: turning = 0.0_wp !! norm of the residual below which forces have turned against a step
    logical :: traps = .true. !! overflow, zero and invalid stopped the program wherever it was evaluated
  contains
    procedure :: evaluate => evaluate_small
    procedure :: linearise => linearise_small
    procedure :: settle => settle_small
    procedure :: virtual_work => work_of_small
  end type small_type

contains

  !> Residual of an equation, and its derivative.
  pure subroutine law_at(law, i, x, hard, f, slope)
    integer, intent(in) :: law, i
    real(wp), intent(in) :: x, hard
    real(wp), intent(out) :: f, slope

    slope = 2.0_wp*x
    select case (law)
    case (squares)
      f = x**2 - real(i, wp)
    case (no_root)
      f = x**2 + real(i, wp)
    case (bounded)
      f = atan(x - 3.0_wp)
      slope = 1.0_wp/(1.0_wp + (x - 3.0_wp)**2)
    case (outside)
      f = x + 1.0_wp
      slope = 1.0_wp
    case (uphill)
      f = x - 1.0_wp
      slope = -1.0_wp
    case (stopped)
      f = x - 1.0_wp + hard*(x - stop_at)
      slope = 1.0_wp + hard
    case (fold)
      f = merge(x**2 - 1.0e-4_wp, x - 2.0_wp, i == 1)
      slope = merge(2.0_wp*x, 1.0_wp, i == 1)
    case default
      f = merge(x - 2.0_wp, -1.0_wp, i == 1)
      slope = merge(1.0_wp, 0.0_wp, i == 1)
    end select
  end subroutine law_at

  !> Residual of all of them.
  subroutine evaluate_small(self, state, residual, valid)
    class(small_type), intent(inout) :: self
    Vec, intent(in) :: state, residual
    logical, intent(out) :: valid
    PetscScalar, pointer :: x(:)
    PetscInt :: first, last
    PetscErrorCode :: ierr
    real(wp) :: f, slope
    logical :: halts(size(ieee_usual))
    integer :: i

    call ieee_get_halting_mode(ieee_usual, halts)
    self%traps = self%traps .and. all(halts)
    PetscCallA(VecGetOwnershipRange(state, first, last, ierr))
    PetscCallA(GFB_VecGetArrayRead(state, x, ierr))
    valid = any(self%law == [no_root, uphill, stopped, fold]) .or. all(x(:last - first) > 0.0_wp)
    do i = 1, int(last - first)
      call law_at(self%law, int(first) + i, x(i), merge(self%hard, 0.0_wp, self%closed), f, slope)
      PetscCallA(VecSetValue(residual, first + i - 1_pint, f, INSERT_VALUES, ierr))
    end do
    PetscCallA(GFB_VecRestoreArrayRead(state, x, ierr))
    PetscCallA(VecAssemblyBegin(residual, ierr))
    PetscCallA(VecAssemblyEnd(residual, ierr))
  end subroutine evaluate_small

  !> Matrix of all of them, and how far from the roots it is made.
  subroutine linearise_small(self, state)
    class(small_type), intent(inout) :: self
    Vec, intent(in) :: state
    PetscScalar, pointer :: x(:)
    PetscInt :: first, last, row
    PetscErrorCode :: ierr
    real(wp) :: f, slope
    logical :: halts(size(ieee_usual))
    integer :: i

    call ieee_get_halting_mode(ieee_usual, halts)
    self%traps = self%traps .and. all(halts)
    self%linearised = self%linearised + 1
    self%error(min(self%linearised, longest)) = error_of(state)
    PetscCallA(VecMax(state, PETSC_NULL_INTEGER, self%place(min(self%linearised, longest)), ierr))
    PetscCallA(VecGetOwnershipRange(state, first, last, ierr))
    PetscCallA(GFB_VecGetArrayRead(state, x, ierr))
    do i = 1, int(last - first)
      call law_at(self%law, int(first) + i, x(i), merge(self%hard, 0.0_wp, self%closed), f, slope)
      row = first + i - 1
      PetscCallA(MatSetValue(self%jacobian, row, row, slope, INSERT_VALUES, ierr))
    end do
    PetscCallA(GFB_VecRestoreArrayRead(state, x, ierr))
    PetscCallA(MatAssemblyBegin(self%jacobian, MAT_FINAL_ASSEMBLY, ierr))
    PetscCallA(MatAssemblyEnd(self%jacobian, MAT_FINAL_ASSEMBLY, ierr))
  end subroutine linearise_small

  !> Contacts have moved wherever forces may turn, and where there are stops.
  subroutine settle_small(self, state, moved)
    class(small_type), intent(inout) :: self
    Vec, intent(in) :: state
    logical, intent(out) :: moved
    PetscReal :: largest
    PetscErrorCode :: ierr

    moved = self%turning > 0.0_wp
    if (self%law /= stopped) return
    PetscCallA(VecNorm(state, NORM_INFINITY, largest, ierr))
    moved = self%closed .neqv. largest > stop_at
    self%closed = largest > stop_at
  end subroutine settle_small

  !> Work along a step: of springs and stops their own; else one that asks for a far shorter step where forces have turned.
  real(wp) function work_of_small(self, residual, step) result(work)
    class(small_type), intent(in) :: self
    Vec, intent(in) :: residual, step
    PetscReal :: norm
    PetscErrorCode :: ierr

    if (self%law == stopped) then
      PetscCallA(VecDot(residual, step, work, ierr))
      return
    end if
    PetscCallA(VecNorm(residual, NORM_2, norm, ierr))
    work = merge(1.0_wp, -20.0_wp, norm > self%turning)
  end function work_of_small

  !> Largest distance of a state from the roots of `squares`.
  function error_of(state) result(error)
    Vec, intent(in) :: state
    real(wp) :: error
    Vec :: difference
    PetscInt :: first, last, i
    PetscErrorCode :: ierr

    PetscCallA(VecDuplicate(state, difference, ierr))
    PetscCallA(VecGetOwnershipRange(state, first, last, ierr))
    do i = first, last - 1
      PetscCallA(VecSetValue(difference, i, sqrt(real(i + 1, wp)), INSERT_VALUES, ierr))
    end do
    PetscCallA(VecAssemblyBegin(difference, ierr))
    PetscCallA(VecAssemblyEnd(difference, ierr))
    PetscCallA(VecAXPY(difference, -1.0_wp, state, ierr))
    PetscCallA(VecNorm(difference, NORM_INFINITY, error, ierr))
    PetscCallA(VecDestroy(difference, ierr))
  end function error_of

  !> A system with all unknowns at one value.
  subroutine create_small(law, value, system)
    integer, intent(in) :: law
    real(wp), intent(in) :: value
    type(small_type), intent(inout) :: system
    PetscInt, parameter :: total = unknowns
    PetscErrorCode :: ierr

    system%law = law
    PetscCallA(VecCreateMPI(PETSC_COMM_WORLD, PETSC_DECIDE, total, system%state, ierr))
    PetscCallA(VecSet(system%state, value, ierr))
    PetscCallA(MatCreate(PETSC_COMM_WORLD, system%jacobian, ierr))
    PetscCallA(MatSetSizes(system%jacobian, PETSC_DECIDE, PETSC_DECIDE, total, total, ierr))
    PetscCallA(MatSetType(system%jacobian, MATAIJ, ierr))
    PetscCallA(MatSetUp(system%jacobian, ierr))
  end subroutine create_small

  !> Solves a system and frees it; its record stays.
  subroutine solve_small(law, value, settings, system, report, error, factorizations)
    integer, intent(in) :: law
    real(wp), intent(in) :: value
    type(newton_settings_type), intent(in) :: settings
    type(small_type), target, intent(inout) :: system
    type(newton_report_type), intent(out) :: report
    real(wp), intent(out) :: error
    integer, intent(out) :: factorizations
    type(newton_type), target :: newton
    PetscErrorCode :: ierr

    call create_small(law, value, system)
    call create_newton(newton, system, 'small_', settings, run_log_type(.false., .false.))
    call solve_newton(newton, report)
    error = error_of(system%state)
    factorizations = newton%factorizations
    call destroy_newton(newton)
    call destroy_newton(newton) ! may be called twice
    PetscCallA(VecDestroy(system%state, ierr))
    PetscCallA(MatDestroy(system%jacobian, ierr))
  end subroutine solve_small
end module small_systems
