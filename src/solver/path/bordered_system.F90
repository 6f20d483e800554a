#include "gfb_petsc.h"
!> A bearing along a path of operating points, with the path's parameter as one more unknown.
!>
!> The bearing's equations are \( f(x, \lambda) = 0 \), where \( \lambda \) goes from 0 at the path's
!> first point to 1 at its last. A step of length \( s \) from an answer \( x_0 \) asks for
!> \( t \cdot (x - x_0) = s \), with a direction \( t \). The matrix of both stays regular where
!> \( \lambda \) turns back, as long as \( x \) moves along \( t \) ([Riks1979]).
module gfb_bordered_system
  use petscmat
  use gfb_kinds, only: wp
  use gfb_petsc_kinds, only: pint
  use gfb_operating_point, only: operating_point_type, point_between
  use gfb_bearing_system, only: bearing_system_type
  use gfb_matrix_rows, only: copy_row, row_length
  use gfb_border_rows, only: border_type, create_border
  use gfb_nonlinear_system, only: nonlinear_system_type
  implicit none (type)
  private
  public :: create_bordered_system, destroy_bordered_system

  real(wp), parameter :: shift = 1.0e-4_wp !! of lambda for its derivative; exact where f is linear in it

  !> The bearing and the path's parameter. It is handed to SNES by address: keep it where it is.
  type, extends(nonlinear_system_type), public :: bordered_system_type
    type(operating_point_type) :: first, last !! of the path
    real(wp) :: step = 0.0_wp                 !! s
    Vec :: base                               !! x_0, with its lambda
    Vec :: direction                          !! t, with 0 for lambda
    type(bearing_system_type), pointer, private :: bearing => null()
    Vec, private :: inner                     !! like the bearing's state
    Vec, private :: low, high                 !! its residuals beside a lambda
    type(border_type), private :: border      !! lambda
    logical, private :: created = .false.
  contains
    procedure :: evaluate => evaluate_path, linearise => linearise_path, settle => settle_path
    procedure :: begin_step => begin_path_step, virtual_work => path_work
    procedure :: lambda_of, set_lambda, join, split, give
    procedure, private :: point_at
  end type bordered_system_type

contains

  !> Sets the path up from the bearing's present point, at its present state. The bearing's matrix
  !> must have been filled before.
  subroutine create_bordered_system(bearing, last, path)
    type(bearing_system_type), target, intent(inout) :: bearing !! pads and shaft
    type(operating_point_type), intent(in) :: last !! end of the path
    type(bordered_system_type), intent(inout) :: path !! with its parameter
    PetscInt :: owned
    PetscErrorCode :: ierr

    path%bearing => bearing
    path%first = bearing%point
    path%last = last
    path%dense_rows = .true.
    path%plane = bearing%plane
    path%low_fill = bearing%low_fill
    PetscCallA(VecGetLocalSize(bearing%state, owned, ierr))
    call create_border(int(owned), 1, path%border)
    PetscCallA(VecCreateMPI(PETSC_COMM_WORLD, int(path%border%owned, pint), PETSC_DETERMINE, path%state, ierr))
    PetscCallA(VecDuplicate(path%state, path%base, ierr))
    PetscCallA(VecDuplicate(path%state, path%direction, ierr))
    PetscCallA(VecDuplicate(bearing%state, path%inner, ierr))
    PetscCallA(VecDuplicate(bearing%state, path%low, ierr))
    PetscCallA(VecDuplicate(bearing%state, path%high, ierr))
    call create_bordered_matrix(path)
    call path%join(bearing%state, 0.0_wp, path%state)
    path%created = .true.
  end subroutine create_bordered_system

  !> The bearing's matrix with room for one more row and column, both full.
  subroutine create_bordered_matrix(path)
    type(bordered_system_type), intent(inout) :: path
    PetscInt :: first, last, row
    PetscInt, allocatable :: room(:)
    PetscErrorCode :: ierr

    PetscCallA(MatGetOwnershipRange(path%bearing%jacobian, first, last, ierr))
    allocate (room(last - first))
    do row = first, last - 1
      room(row - first + 1) = row_length(path%bearing%jacobian, row)
    end do
    call path%border%create_matrix(room, room, path%jacobian)
  end subroutine create_bordered_matrix

  !> Puts a state's unknowns of the bearing into `inner`; returns its lambda.
  real(wp) function lambda_of(self, state) result(lambda)
    class(bordered_system_type), intent(in) :: self !! bearing and path parameter
    Vec, intent(in) :: state !! with lambda, scaled
    real(wp) :: value(1)

    call self%border%split(state, self%inner)
    value = self%border%values(state)
    lambda = value(1)
  end function lambda_of

  !> Sets a state's lambda.
  subroutine set_lambda(self, state, lambda)
    class(bordered_system_type), intent(in) :: self !! bearing and path parameter
    Vec, intent(in) :: state !! with lambda, scaled; its lambda is changed
    real(wp), intent(in) :: lambda !! path parameter [1]
    call self%border%set_values([lambda], state)
  end subroutine set_lambda

  !> The operating point at a parameter of the path.
  pure function point_at(self, lambda) result(point)
    class(bordered_system_type), intent(in) :: self !! bearing and path parameter
    real(wp), intent(in) :: lambda !! path parameter: 0 at the first point, 1 at the last [1]
    type(operating_point_type) :: point
    point = point_between(self%first, self%last, lambda)
  end function point_at

  !> Puts a vector of the bearing and a value for lambda together.
  subroutine join(self, inner, lambda, whole)
    class(bordered_system_type), intent(in) :: self !! bearing and path parameter
    Vec, intent(in) :: inner !! like the bearing's state, scaled
    real(wp), intent(in) :: lambda !! path parameter, or the residual of the step's length [1]
    Vec, intent(in) :: whole !! with lambda
    call self%border%join(inner, [lambda], whole)
  end subroutine join

  !> The bearing's part of a vector.
  subroutine split(self, whole, inner)
    class(bordered_system_type), intent(in) :: self !! bearing and path parameter
    Vec, intent(in) :: whole !! with lambda
    Vec, intent(in) :: inner !! without
    call self%border%split(whole, inner)
  end subroutine split

  !> Gives the present state to the bearing, and its operating point; returns lambda.
  real(wp) function give(self) result(lambda)
    class(bordered_system_type), intent(in) :: self !! bearing and path parameter
    PetscErrorCode :: ierr

    lambda = self%lambda_of(self%state)
    PetscCallA(VecCopy(self%inner, self%bearing%state, ierr))
    self%bearing%point = self%point_at(lambda)
  end function give

  !> Residual of the bearing and of the step's length.
  subroutine evaluate_path(self, state, residual, valid)
    class(bordered_system_type), intent(inout) :: self !! bearing and path parameter
    Vec, intent(in) :: state !! with lambda, scaled
    Vec, intent(in) :: residual !! of bearing and step length, scaled; is filled
    logical, intent(out) :: valid !! the equations can be evaluated at this state
    real(wp) :: lambda, along, along_base
    PetscErrorCode :: ierr

    lambda = self%lambda_of(state)
    call self%bearing%evaluate_at(self%point_at(lambda), self%inner, self%low, valid)
    PetscCallA(VecDot(self%direction, state, along, ierr))
    PetscCallA(VecDot(self%direction, self%base, along_base, ierr))
    call self%join(self%low, along - along_base - self%step, residual)
  end subroutine evaluate_path

  !> The bearing's matrix, bordered by the derivatives after lambda and by the direction.
  subroutine linearise_path(self, state)
    class(bordered_system_type), intent(inout) :: self !! bearing and path parameter
    Vec, intent(in) :: state !! with lambda, scaled
    real(wp) :: lambda
    logical :: valid
    PetscScalar, pointer :: column(:)
    PetscInt :: first, last, row, entries, border
    PetscInt, allocatable :: number(:)
    PetscScalar, allocatable :: value(:)
    PetscErrorCode :: ierr

    lambda = self%lambda_of(state)
    call self%bearing%linearise_at(self%point_at(lambda), self%bearing%shaft_fixed, self%inner)
    call self%bearing%evaluate_at(self%point_at(lambda + shift), self%inner, self%high, valid)
    call self%bearing%evaluate_at(self%point_at(lambda - shift), self%inner, self%low, valid)
    PetscCallA(VecAXPBY(self%high, -0.5_wp/shift, 0.5_wp/shift, self%low, ierr))
    border = self%bearing%unknowns
    allocate (number(self%bearing%unknowns), value(self%bearing%unknowns))
    PetscCallA(GFB_VecGetArrayRead(self%high, column, ierr))
    PetscCallA(MatGetOwnershipRange(self%bearing%jacobian, first, last, ierr))
    do row = first, last - 1
      call copy_row(self%bearing%jacobian, row, entries, number, value)
      PetscCallA(MatSetValues(self%jacobian, 1_pint, [row], entries, number, value, INSERT_VALUES, ierr))
      PetscCallA(MatSetValues(self%jacobian, 1_pint, [row], 1_pint, [border], [column(row - first + 1)], INSERT_VALUES, ierr))
    end do
    PetscCallA(GFB_VecRestoreArrayRead(self%high, column, ierr))
    call self%border%set_row(1, self%direction, self%jacobian)
    PetscCallA(MatAssemblyBegin(self%jacobian, MAT_FINAL_ASSEMBLY, ierr))
    PetscCallA(MatAssemblyEnd(self%jacobian, MAT_FINAL_ASSEMBLY, ierr))
  end subroutine linearise_path

  !> Moves the contacts to where the foils have gone.
  subroutine settle_path(self, state, moved)
    class(bordered_system_type), intent(inout) :: self !! bearing and path parameter
    Vec, intent(in) :: state !! with lambda, scaled
    logical, intent(out) :: moved !! some contact was
    real(wp) :: lambda

    lambda = self%lambda_of(state)
    call self%bearing%settle(self%inner, moved)
    self%settled = self%bearing%settled
  end subroutine settle_path

  !> A new Newton step begins where the contacts are.
  subroutine begin_path_step(self)
    class(bordered_system_type), intent(inout) :: self !! bearing and path parameter
    call self%bearing%begin_step()
  end subroutine begin_path_step

  !> Work of the residual forces on the foil along a step, scaled.
  real(wp) function path_work(self, residual, step) result(work)
    class(bordered_system_type), intent(in) :: self !! bearing and path parameter
    Vec, intent(in) :: residual !! with the row of lambda, scaled
    Vec, intent(in) :: step !! of the state, with lambda, scaled
    work = self%bearing%virtual_work(residual, step)
  end function path_work

  !> Frees what PETSc holds; may be called twice.
  subroutine destroy_bordered_system(path)
    type(bordered_system_type), intent(inout) :: path !! with its parameter
    PetscErrorCode :: ierr

    if (.not. path%created) return
    PetscCallA(MatDestroy(path%jacobian, ierr))
    PetscCallA(VecDestroy(path%high, ierr))
    PetscCallA(VecDestroy(path%low, ierr))
    PetscCallA(VecDestroy(path%inner, ierr))
    PetscCallA(VecDestroy(path%direction, ierr))
    PetscCallA(VecDestroy(path%base, ierr))
    PetscCallA(VecDestroy(path%state, ierr))
    path%created = .false.
  end subroutine destroy_bordered_system
end module gfb_bordered_system
