#include "gfb_petsc.h"
!> The equations of one side of a bearing, film and shaft or the foil, with the other side fixed.
!>
!> They are the coupled bearing's own: its residual with the other side's unknowns where they are in
!> the bearing's state, and its matrix, of both of which the side takes its share.
!>
!> Under constant pressures a foil that has lifted off flaps away by many clearances, which no film
!> would let it do. So the fixed film is the gas in the gap rather than its pressure: where the foil
!> moves, p h stays, to first order, as in a very fast bearing. Where the foil comes to rest the
!> pressures are those that were kept, so the answer of the loops is the same.
module gfb_coupling_side
  use petscmat
  use petscvec
  use gfb_kinds, only: wp
  use gfb_petsc_kinds, only: pint
  use gfb_nonlinear_system, only: nonlinear_system_type
  use gfb_bearing_system, only: bearing_system_type
  implicit none (type)
  private
  public :: create_side

  real(wp), parameter :: room = 1.0e3_wp !! clearance while the film is not asked, over its own [1]

  !> One side; keep it and the bearing where they are.
  type, extends(nonlinear_system_type), public :: coupling_side_type
    type(bearing_system_type), pointer, private :: bearing => null()
    logical, private :: of_foil = .false. !! else of film and shaft
    IS, private :: part                   !! the side's unknowns among the bearing's
    Vec, private :: whole, whole_residual !! of the bearing, at a state of the side
    Vec, private :: whole_step
    IS, private :: film_part              !! the pressures among the bearing's unknowns
    Vec, private :: kept                  !! the foil where the film was fixed
    Vec, private :: moved, pressure       !! displacement of the foil from there; pressures, scaled
    Mat, private :: yielding              !! pressures by the foil's unknowns, scaled
    Mat, private :: felt, stiffening      !! the foil's equations by the pressures; product of both
    logical, private :: multiplied = .false.
    !> of each unknown this rank knows: a pressure's among `film_part`, a displacement's in `part`, from 0 on
    integer, allocatable, private :: number(:)
  contains
    procedure :: evaluate => evaluate_side, linearise => linearise_side, settle => settle_side
    procedure :: begin_step => begin_side_step, virtual_work => work_on_side, take => take_side
    procedure :: give => give_side, fix_film, destroy => destroy_side
  end type coupling_side_type

contains

  !> One side: its unknowns among the bearing's, and a matrix for its equations.
  subroutine create_side(bearing, of_foil, side)
    type(bearing_system_type), target, intent(in) :: bearing !! with a matrix that was filled once
    logical, intent(in) :: of_foil !! the foil's side; else that of film and shaft
    type(coupling_side_type), intent(inout) :: side !! is created

    PetscInt :: first, last
    PetscInt, allocatable :: film(:), foil(:), number(:)
    PetscErrorCode :: ierr
    integer :: i, k

    side%bearing => bearing
    side%of_foil = of_foil
    side%dense_rows = bearing%dense_rows .and. .not. of_foil
    side%plane = bearing%plane
    side%low_fill = bearing%low_fill
    PetscCallA(VecGetOwnershipRange(bearing%state, first, last, ierr))
    allocate (film(0), foil(0))
    associate (block => bearing%blocks%first_owned)
      do i = 1, size(bearing%pad)
        film = [film, [(first + int(k, pint), k=block(2*i - 1), block(2*i) - 1)]]
        foil = [foil, [(first + int(k, pint), k=block(2*i), block(2*i + 1) - 1)]]
      end do
      if (of_foil) then
        number = foil
      else
        number = [film, [(first + int(k, pint), k=block(2*size(bearing%pad) + 1), int(last - first) - 1)]]
      end if
    end associate
    PetscCallA(ISCreateGeneral(PETSC_COMM_WORLD, size(number, kind=pint), number, PETSC_COPY_VALUES, side%part, ierr))
    PetscCallA(VecCreateMPI(PETSC_COMM_WORLD, size(number, kind=pint), PETSC_DETERMINE, side%state, ierr))
    PetscCallA(VecDuplicate(bearing%state, side%whole, ierr))
    PetscCallA(VecDuplicate(bearing%state, side%whole_residual, ierr))
    PetscCallA(VecDuplicate(bearing%state, side%whole_step, ierr))
    PetscCallA(MatCreateSubMatrix(bearing%jacobian, side%part, side%part, MAT_INITIAL_MATRIX, side%jacobian, ierr))
    call side%take()
    if (of_foil) call create_yielding(side, film)
  end subroutine create_side

  !> Room for how the pressures follow the foil.
  subroutine create_yielding(side, film)
    type(coupling_side_type), intent(inout) :: side
    PetscInt, intent(in) :: film(:) !! this rank's pressures among the bearing's unknowns
    PetscInt, parameter :: one = 1
    PetscInt :: pressures, unknowns
    PetscErrorCode :: ierr

    pressures = size(film, kind=pint)
    PetscCallA(ISCreateGeneral(PETSC_COMM_WORLD, pressures, film, PETSC_COPY_VALUES, side%film_part, ierr))
    PetscCallA(VecCreateMPI(PETSC_COMM_WORLD, pressures, PETSC_DETERMINE, side%pressure, ierr))
    PetscCallA(VecDuplicate(side%state, side%kept, ierr))
    PetscCallA(VecDuplicate(side%state, side%moved, ierr))
    PetscCallA(VecGetLocalSize(side%state, unknowns, ierr))
    PetscCallA(MatCreateAIJ(PETSC_COMM_WORLD, pressures, unknowns, PETSC_DETERMINE, PETSC_DETERMINE, one, PETSC_NULL_INTEGER_ARRAY, one, PETSC_NULL_INTEGER_ARRAY, side%yielding, ierr))
    PetscCallA(MatCreateSubMatrix(side%bearing%jacobian, side%part, side%film_part, MAT_INITIAL_MATRIX, side%felt, ierr))
    call number_parts(side)
  end subroutine create_yielding

  !> Numbers what this rank knows of the bearing's unknowns, those of other ranks too: pressures among the pressures, the
  !> foils' displacements among those of the side.
  subroutine number_parts(side)
    type(coupling_side_type), intent(inout) :: side
    real(wp) :: number(side%bearing%local_size())
    PetscErrorCode :: ierr

    PetscCallA(VecSet(side%whole, 0.0_wp, ierr))
    call number_part(side%part, side%moved)
    call number_part(side%film_part, side%pressure)
    call side%bearing%get_unknowns(number, side%whole)
    side%number = nint(number/side%bearing%unknown_scale)

  contains

    !> Numbers the unknowns of a part from 0 on.
    subroutine number_part(part, vector)
      IS, intent(in) :: part      !! of the bearing's unknowns
      Vec, intent(in) :: vector   !! of the part; is overwritten
      PetscInt :: first, last, i
      PetscErrorCode :: ierr

      PetscCallA(VecGetOwnershipRange(vector, first, last, ierr))
      PetscCallA(VecSetValues(vector, last - first, [(i, i=first, last - 1)], [(real(i, wp), i=first, last - 1)], INSERT_VALUES, ierr))
      PetscCallA(VecAssemblyBegin(vector, ierr))
      PetscCallA(VecAssemblyEnd(vector, ierr))
      PetscCallA(VecISCopy(side%whole, part, SCATTER_FORWARD, vector, ierr))
    end subroutine number_part
  end subroutine number_parts

  !> Fixes the film of the bearing's present state: its pressures where the foil stays, and the gas
  !> in the gap where it moves.
  subroutine fix_film(self)
    class(coupling_side_type), intent(inout) :: self !! the side

    real(wp) :: unknown(self%bearing%local_size()), gap(self%bearing%film_nodes()), rate
    PetscInt :: row(1), column(1)
    PetscErrorCode :: ierr
    integer :: i, node, source

    call self%bearing%get_unknowns(unknown)
    gap = self%bearing%gap(unknown)
    PetscCallA(VecISCopy(self%bearing%state, self%part, SCATTER_REVERSE, self%kept, ierr))
    do i = 1, size(self%bearing%pad)
      associate (pad => self%bearing%pad(i), foil => self%bearing%pad(i)%foil, film => self%bearing%pad(i)%film)
        do node = 1, size(pad%mesh%mesh_node)
          source = foil%source(node) - foil%first
          if (.not. pad%mesh%owned(node) .or. source < 1) cycle
          rate = -unknown(pad%first + node)/gap(pad%first_node + node)*foil%rate(node)* &
            foil%unknown_scale(source)/film%ambient_pressure
          if (film%fixed(node)) rate = 0.0_wp
          row = int(self%number(pad%first + node), pint)
          column = int(self%number(pad%first + foil%source(node)), pint)
          PetscCallA(MatSetValues(self%yielding, 1_pint, row, 1_pint, column, [rate], INSERT_VALUES, ierr))
        end do
      end associate
    end do
    PetscCallA(MatAssemblyBegin(self%yielding, MAT_FINAL_ASSEMBLY, ierr))
    PetscCallA(MatAssemblyEnd(self%yielding, MAT_FINAL_ASSEMBLY, ierr))
  end subroutine fix_film

  !> Takes the side's state from the bearing's.
  subroutine take_side(self)
    class(coupling_side_type), intent(inout) :: self !! the side
    PetscErrorCode :: ierr
    PetscCallA(VecISCopy(self%bearing%state, self%part, SCATTER_REVERSE, self%state, ierr))
  end subroutine take_side

  !> Puts the side's state into the bearing's.
  subroutine give_side(self)
    class(coupling_side_type), intent(inout) :: self !! the side
    PetscErrorCode :: ierr
    PetscCallA(VecISCopy(self%bearing%state, self%part, SCATTER_FORWARD, self%state, ierr))
  end subroutine give_side

  !> The bearing's state with a state of the side in it.
  subroutine complete(self, state)
    class(coupling_side_type), intent(inout) :: self !! the side
    Vec, intent(in) :: state !! of the side, scaled
    PetscErrorCode :: ierr

    PetscCallA(VecCopy(self%bearing%state, self%whole, ierr))
    PetscCallA(VecISCopy(self%whole, self%part, SCATTER_FORWARD, state, ierr))
    if (.not. self%of_foil) return
    PetscCallA(VecWAXPY(self%moved, -1.0_wp, self%kept, state, ierr))
    PetscCallA(VecISCopy(self%whole, self%film_part, SCATTER_REVERSE, self%pressure, ierr))
    PetscCallA(MatMultAdd(self%yielding, self%moved, self%pressure, self%pressure, ierr))
    PetscCallA(VecISCopy(self%whole, self%film_part, SCATTER_FORWARD, self%pressure, ierr))
  end subroutine complete

  !> Residual of the side's equations. A foil under fixed pressures may close the film before it
  !> converges, whose equations nobody asks then: they are given room.
  subroutine evaluate_side(self, state, residual, valid)
    class(coupling_side_type), intent(inout) :: self !! the side
    Vec, intent(in) :: state !! of the side, scaled
    Vec, intent(in) :: residual !! of the side, scaled; is filled
    logical, intent(out) :: valid !! the equations can be evaluated at this state
    real(wp) :: clearance
    PetscErrorCode :: ierr

    call complete(self, state)
    clearance = self%bearing%clearance
    if (self%of_foil) self%bearing%pad(:)%film%clearance = room*clearance
    call self%bearing%evaluate(self%whole, self%whole_residual, valid)
    self%bearing%pad(:)%film%clearance = clearance
    PetscCallA(VecISCopy(self%whole_residual, self%part, SCATTER_REVERSE, residual, ierr))
  end subroutine evaluate_side

  !> Derivative of the side's equations by its own unknowns.
  subroutine linearise_side(self, state)
    class(coupling_side_type), intent(inout) :: self !! the side
    Vec, intent(in) :: state !! of the side, scaled
    real(wp) :: clearance
    PetscErrorCode :: ierr

    call complete(self, state)
    clearance = self%bearing%clearance
    if (self%of_foil) self%bearing%pad(:)%film%clearance = room*clearance
    call self%bearing%linearise(self%whole)
    self%bearing%pad(:)%film%clearance = clearance
    PetscCallA(MatCreateSubMatrix(self%bearing%jacobian, self%part, self%part, MAT_REUSE_MATRIX, self%jacobian, ierr))
    if (self%of_foil) call stiffen(self)
  end subroutine linearise_side

  !> Adds to the foil's matrix that the pressures follow it.
  subroutine stiffen(self)
    type(coupling_side_type), intent(inout) :: self
    MatReuse :: reuse
    PetscErrorCode :: ierr

    PetscCallA(MatCreateSubMatrix(self%bearing%jacobian, self%part, self%film_part, MAT_REUSE_MATRIX, self%felt, ierr))
    reuse = MAT_INITIAL_MATRIX
    if (self%multiplied) reuse = MAT_REUSE_MATRIX
    PetscCallA(MatMatMult(self%felt, self%yielding, reuse, 2.0_wp, self%stiffening, ierr))
    self%multiplied = .true.
    PetscCallA(MatAXPY(self%jacobian, 1.0_wp, self%stiffening, SUBSET_NONZERO_PATTERN, ierr))
  end subroutine stiffen

  !> Contacts follow the foil; under a fixed foil they stay.
  subroutine settle_side(self, state, moved)
    class(coupling_side_type), intent(inout) :: self !! the side
    Vec, intent(in) :: state !! of the side, scaled
    logical, intent(out) :: moved !! some contact changed

    moved = .false.
    if (.not. self%of_foil) return
    call complete(self, state)
    call self%bearing%settle(self%whole, moved)
    self%settled = self%bearing%settled
  end subroutine settle_side

  !> A new Newton step begins where the foil's contacts are.
  subroutine begin_side_step(self)
    class(coupling_side_type), intent(inout) :: self !! the side
    if (self%of_foil) call self%bearing%begin_step()
  end subroutine begin_side_step

  !> Work of the residual forces on the foil along a step, scaled.
  real(wp) function work_on_side(self, residual, step) result(work)
    class(coupling_side_type), intent(in) :: self !! the side
    Vec, intent(in) :: residual !! of the side, scaled
    Vec, intent(in) :: step !! of the side, scaled
    PetscErrorCode :: ierr

    PetscCallA(VecSet(self%whole_residual, 0.0_wp, ierr))
    PetscCallA(VecSet(self%whole_step, 0.0_wp, ierr))
    PetscCallA(VecISCopy(self%whole_residual, self%part, SCATTER_FORWARD, residual, ierr))
    PetscCallA(VecISCopy(self%whole_step, self%part, SCATTER_FORWARD, step, ierr))
    work = self%bearing%virtual_work(self%whole_residual, self%whole_step)
  end function work_on_side

  !> Frees what PETSc holds.
  subroutine destroy_side(self)
    class(coupling_side_type), intent(inout) :: self !! the side
    PetscErrorCode :: ierr

    PetscCallA(ISDestroy(self%part, ierr))
    PetscCallA(VecDestroy(self%state, ierr))
    PetscCallA(VecDestroy(self%whole, ierr))
    PetscCallA(VecDestroy(self%whole_residual, ierr))
    PetscCallA(VecDestroy(self%whole_step, ierr))
    PetscCallA(MatDestroy(self%jacobian, ierr))
    if (.not. self%of_foil) return
    PetscCallA(ISDestroy(self%film_part, ierr))
    PetscCallA(VecDestroy(self%kept, ierr))
    PetscCallA(VecDestroy(self%moved, ierr))
    PetscCallA(VecDestroy(self%pressure, ierr))
    PetscCallA(MatDestroy(self%yielding, ierr))
    PetscCallA(MatDestroy(self%felt, ierr))
    if (allocated(self%number)) deallocate (self%number)
    if (self%multiplied) then
      PetscCallA(MatDestroy(self%stiffening, ierr))
    end if
  end subroutine destroy_side
end module gfb_coupling_side
