#include "gfb_petsc.h"
!> The inertia of fixed-interface modes inside condensed pieces, over a step of time.
!>
!> Each mode follows the retained unknowns u of its piece (`gfb_backward_difference`), its amplitude is no unknown of the
!> step. With the way \( w = u - \hat u \) from where the foil would be without any force
!>
!> $$ f = \sum_i m_i \ddot\eta_i, \qquad
!>    \frac{\partial f}{\partial u} = -\sum_i \frac{a_0^4}{a_0^2 + \omega_i^2} m_i m_i^T, $$
!>
!> the block of `gfb_inner_motion` in a motion \( e^{a_0 t} \). Source: [CraigBampton1968].
!>
!> With viscous losses (`gfb_foil_momentum`) of the time \( \tau \) a mode's spring is \( \omega^2 (\eta + \tau \dot\eta) \), of a step
!>
!> $$ \omega^2 (1 + a_0 \tau) (\eta + s), \quad s = \frac{\tau (a_1 \eta_1 + a_2 \eta_2)}{1 + a_0 \tau}, $$
!>
!> a stiffer mode of the amplitude \( \eta + s \).
!>
!> Fixed-interface modes inside the condensed pieces of a foil that moves.
!>
!> Modes \( \phi_i \) of unit modal mass with the natural frequencies \( \omega_i \) couple by \( m_i \) to the
!> retained unknowns u of their piece:
!>
!> $$ \ddot\eta_i + \omega_i^2 \eta_i = -m_i^T \ddot u, \qquad f = \sum_i m_i \ddot\eta_i $$
!>
!> Source: [CraigBampton1968].
module gfb_inner_motion
  use petscmat
  use gfb_kinds, only: wp
  use gfb_petsc_kinds, only: pint
  use gfb_archive, only: archive_type
  use gfb_petsc_session, only: largest_number
  use gfb_natural_order, only: natural_order_type, visit_field
  use gfb_backward_difference, only: free_value, newest_rate
  use gfb_backward_difference, only: modal_amplitude, modal_acceleration
  implicit none (type)
  private
  public :: inner_block, inner_block_rate, add_to_pieces

  !> Modes inside the condensed pieces of one kind.
  type, public :: inner_modes_type
    integer, allocatable :: number(:, :)     !! (retained, pieces) bearing's, from 0; -1: fixed
    integer, allocatable :: place(:)         !! (pieces) from 1, pad by pad, whatever rank has them
    real(wp), allocatable :: coupling(:, :)  !! (retained, modes) m_i [sqrt(kg)], of one sign on all ranks
    real(wp), allocatable :: eigenvalue(:)   !! omega_i squared [1/s2]
  end type inner_modes_type

  !> Modes of all pieces, and what of their past a step needs; nothing where it is not begun.
  type, public :: inner_motion_type
    logical :: present = .false.
    real(wp), allocatable :: amplitude(:, :) !! (this rank's modes, 2) now and one step ago [m sqrt(kg)]
    real(wp), allocatable :: rate(:, :)      !! (this rank's modes, 2) of the amplitudes [m sqrt(kg)/s]
    real(wp), allocatable, private :: free(:)       !! amplitudes without any force in the present step, and s
    real(wp), allocatable, private :: shift(:)      !! s of them [m sqrt(kg)]
    real(wp), allocatable, private :: eigenvalue(:) !! of each mode [1/s2]
    type(inner_modes_type), allocatable :: inner(:) !! this rank's kinds
    real(wp), private :: factor = 0.0_wp     !! a_0 of the present step [1/s]
    real(wp), private :: loss = 0.0_wp       !! a_0 tau, what losses add to a stiffness, over it [1]
    logical, private :: formed = .false.     !! the stiffness is that of this a_0
    Mat, private :: coupling                 !! (modes, unknowns) m^T
    Mat, private :: stiffness                !! derivative of the force, scaled as the bearing's matrix
    Vec, private :: left, right              !! these scales
    Vec, private :: drive, force             !! work space: one a mode; one an unknown
  contains
    procedure, non_overridable :: begin, prepare, carry, add_force, add_stiffness, visit, destroy
    procedure, non_overridable, private :: driven_by
  end type inner_motion_type

contains

  !> What the modes inside a piece do to its retained unknowns in a motion \( e^{\lambda t} \):
  !> \( -\sum_i \lambda^4 m_i m_i^T/(\omega_i^2 (1 + l) + \lambda^2) \).
  pure function inner_block(inner, rate, loss) result(block)
    type(inner_modes_type), intent(in) :: inner !! of one kind
    complex(wp), intent(in) :: rate !! lambda [1/s]
    complex(wp), intent(in) :: loss !! l of the stiffness [1]
    complex(wp) :: block(size(inner%coupling, 1), size(inner%coupling, 1))
    integer :: i

    block = 0.0_wp
    do i = 1, size(inner%eigenvalue)
      associate (m => inner%coupling(:, i))
        block = block - rate**4/(inner%eigenvalue(i)*(1.0_wp + loss) + rate**2)* &
          spread(m, 2, size(m))*spread(m, 1, size(m))
      end associate
    end do
  end function inner_block

  !> Its derivative by \( \lambda \).
  pure function inner_block_rate(inner, rate, loss, loss_rate) result(block)
    type(inner_modes_type), intent(in) :: inner !! of one kind
    complex(wp), intent(in) :: rate !! lambda [1/s]
    complex(wp), intent(in) :: loss, loss_rate !! l of the stiffness, dl/d lambda [1], [s]
    complex(wp) :: block(size(inner%coupling, 1), size(inner%coupling, 1))
    complex(wp) :: divisor
    integer :: i

    block = 0.0_wp
    do i = 1, size(inner%eigenvalue)
      divisor = inner%eigenvalue(i)*(1.0_wp + loss) + rate**2
      associate (m => inner%coupling(:, i))
        block = block - (4.0_wp*rate**3/divisor - rate**4*(inner%eigenvalue(i)*loss_rate + 2.0_wp*rate)/divisor**2)* &
          spread(m, 2, size(m))*spread(m, 1, size(m))
      end associate
    end do
  end function inner_block_rate

  !> Adds a block to a matrix at the retained unknowns of every piece of a kind.
  subroutine add_to_pieces(inner, block, matrix)
    type(inner_modes_type), intent(in) :: inner !! of one kind
    real(wp), intent(in) :: block(:, :)         !! (retained, retained)
    Mat, intent(in) :: matrix                   !! not assembled yet
    PetscInt :: row(size(inner%number, 1))
    PetscErrorCode :: ierr
    integer :: k

    do k = 1, size(inner%number, 2)
      row = int(inner%number(:, k), pint)
      PetscCallA(MatSetValues(matrix, size(row, kind=pint), row, size(row, kind=pint), row, [block], ADD_VALUES, ierr))
    end do
  end subroutine add_to_pieces

  !> Begins at rest.
  subroutine begin(self, inner, mass, left, right)
    class(inner_motion_type), intent(inout) :: self !! nothing before
    type(inner_modes_type), intent(in) :: inner(:)  !! kinds of this rank's pieces
    Mat, intent(in) :: mass !! M, scaled as the bearing's matrix, has room for the pieces' blocks
    Vec, intent(in) :: left, right !! these scales
    PetscInt :: owned, first, last
    PetscErrorCode :: ierr
    integer :: i, k, n

    self%inner = inner
    allocate (self%eigenvalue(0))
    do i = 1, size(inner)
      do k = 1, size(inner(i)%number, 2)
        self%eigenvalue = [self%eigenvalue, inner(i)%eigenvalue]
      end do
    end do
    n = size(self%eigenvalue)
    allocate (self%amplitude(n, 2), self%rate(n, 2), self%free(n), self%shift(n), source=0.0_wp)
    PetscCallA(VecDuplicate(left, self%left, ierr))
    PetscCallA(VecCopy(left, self%left, ierr))
    PetscCallA(VecDuplicate(right, self%right, ierr))
    PetscCallA(VecCopy(right, self%right, ierr))
    PetscCallA(VecDuplicate(left, self%force, ierr))
    PetscCallA(VecCreateMPI(PETSC_COMM_WORLD, int(n, pint), PETSC_DETERMINE, self%drive, ierr))
    PetscCallA(MatDuplicate(mass, MAT_DO_NOT_COPY_VALUES, self%stiffness, ierr))
    PetscCallA(MatSetOption(self%stiffness, MAT_NEW_NONZERO_LOCATIONS, PETSC_FALSE, ierr)) ! round-off, as the mass has
    PetscCallA(VecGetLocalSize(left, owned, ierr))
    PetscCallA(VecGetOwnershipRange(left, first, last, ierr))
    call couple(inner, n, owned, [first, last], self%drive, self%coupling)
    self%present = .true.
  end subroutine begin

  !> Couples every mode to the retained unknowns of its piece.
  subroutine couple(inner, modes, owned, range, drive, coupling)
    type(inner_modes_type), intent(in) :: inner(:)
    integer, intent(in) :: modes    !! of this rank
    PetscInt, intent(in) :: owned   !! unknowns of this rank
    PetscInt, intent(in) :: range(2) !! of their numbers, from 0; without the second
    Vec, intent(in) :: drive        !! one a mode
    Mat, intent(out) :: coupling
    PetscInt :: row, last, room(modes), beside(modes)
    PetscErrorCode :: ierr
    integer :: i, k, mode, here

    here = 0
    do i = 1, size(inner)
      do k = 1, size(inner(i)%number, 2)
        associate (mine => inner(i)%number(:, k) >= range(1) .and. inner(i)%number(:, k) < range(2), &
                   next => here + size(inner(i)%eigenvalue))
          room(here + 1:next) = count(mine, kind=pint)
          beside(here + 1:next) = count(inner(i)%number(:, k) >= 0 .and. .not. mine, kind=pint)
          here = next
        end associate
      end do
    end do
    PetscCallA(MatCreateAIJ(PETSC_COMM_WORLD, int(modes, pint), owned, PETSC_DETERMINE, PETSC_DETERMINE, 0_pint, room, 0_pint, beside, coupling, ierr))
    PetscCallA(VecGetOwnershipRange(drive, row, last, ierr))
    do i = 1, size(inner)
      do k = 1, size(inner(i)%number, 2)
        do mode = 1, size(inner(i)%eigenvalue)
          associate (column => int(inner(i)%number(:, k), pint))
            PetscCallA(MatSetValues(coupling, 1_pint, [row], size(column, kind=pint), column, inner(i)%coupling(:, mode), INSERT_VALUES, ierr))
          end associate
          row = row + 1
        end do
      end do
    end do
    PetscCallA(MatAssemblyBegin(coupling, MAT_FINAL_ASSEMBLY, ierr))
    PetscCallA(MatAssemblyEnd(coupling, MAT_FINAL_ASSEMBLY, ierr))
  end subroutine couple

  !> From now on the equations are those of a step.
  subroutine prepare(self, weight, loss_time)
    class(inner_motion_type), intent(inout) :: self !! the modes
    real(wp), intent(in) :: weight(0:2) !! a_0, a_1, a_2 of the step [1/s]
    real(wp), intent(in) :: loss_time   !! tau, the same in all steps [s]

    if (.not. self%present) return
    self%formed = self%formed .and. .not. abs(weight(0) - self%factor) > 0.0_wp
    self%factor = weight(0)
    self%loss = weight(0)*loss_time
    self%shift = loss_time*(weight(1)*self%amplitude(:, 1) + weight(2)*self%amplitude(:, 2))/(1.0_wp + self%loss)
    self%free = free_value(weight, self%amplitude, self%rate) + self%shift
  end subroutine prepare

  !> Ends a step: its amplitudes become the newest.
  subroutine carry(self, weight, way)
    class(inner_motion_type), intent(inout) :: self !! the modes
    real(wp), intent(in) :: weight(0:2) !! as in `prepare` [1/s]
    Vec, intent(in) :: way !! from the state without any force to where the step led, scaled
    real(wp), allocatable :: newest(:)

    if (.not. self%present) return
    newest = modal_amplitude(self%factor, (1.0_wp + self%loss)*self%eigenvalue, self%free, self%driven_by(way)) - self%shift
    self%rate(:, 2) = self%rate(:, 1)
    self%rate(:, 1) = newest_rate(weight, newest, self%amplitude)
    self%amplitude(:, 2) = self%amplitude(:, 1)
    self%amplitude(:, 1) = newest
  end subroutine carry

  !> Drives of this rank's modes.
  function driven_by(self, way) result(drive)
    class(inner_motion_type), intent(in) :: self !! the modes
    Vec, intent(in) :: way !! scaled
    real(wp) :: drive(size(self%free)) !! [m sqrt(kg)]
    PetscScalar, pointer :: values(:)
    PetscErrorCode :: ierr

    PetscCallA(VecPointwiseMult(self%force, self%right, way, ierr))
    PetscCallA(MatMult(self%coupling, self%force, self%drive, ierr))
    PetscCallA(GFB_VecGetArrayRead(self%drive, values, ierr))
    drive = values
    PetscCallA(GFB_VecRestoreArrayRead(self%drive, values, ierr))
  end function driven_by

  !> Adds the inertia at a state.
  subroutine add_force(self, way, residual)
    class(inner_motion_type), intent(in) :: self !! the modes
    Vec, intent(in) :: way      !! as in `carry`
    Vec, intent(in) :: residual !! of the bearing, scaled
    real(wp), allocatable :: acceleration(:)
    PetscScalar, pointer :: values(:)
    PetscErrorCode :: ierr

    if (.not. self%present) return
    acceleration = modal_acceleration(self%factor, (1.0_wp + self%loss)*self%eigenvalue, self%free, self%driven_by(way))
    PetscCallA(GFB_VecGetArray(self%drive, values, ierr))
    values = acceleration
    PetscCallA(GFB_VecRestoreArray(self%drive, values, ierr))
    PetscCallA(MatMultTranspose(self%coupling, self%drive, self%force, ierr))
    PetscCallA(VecPointwiseMult(self%force, self%left, self%force, ierr))
    PetscCallA(VecAXPY(residual, 1.0_wp, self%force, ierr))
  end subroutine add_force

  !> Adds its derivative.
  subroutine add_stiffness(self, jacobian)
    class(inner_motion_type), intent(inout) :: self !! the modes
    Mat, intent(in) :: jacobian !! of the bearing, scaled
    PetscErrorCode :: ierr
    integer :: i

    if (.not. self%present) return
    if (.not. self%formed) then
      PetscCallA(MatZeroEntries(self%stiffness, ierr))
      do i = 1, size(self%inner)
        associate (inner => self%inner(i))
          call add_to_pieces(inner, real(inner_block(inner, cmplx(self%factor, 0.0_wp, wp), cmplx(self%loss, 0.0_wp, wp)), wp), self%stiffness)
        end associate
      end do
      PetscCallA(MatAssemblyBegin(self%stiffness, MAT_FINAL_ASSEMBLY, ierr))
      PetscCallA(MatAssemblyEnd(self%stiffness, MAT_FINAL_ASSEMBLY, ierr))
      PetscCallA(MatDiagonalScale(self%stiffness, self%left, self%right, ierr))
      self%formed = .true.
    end if
    PetscCallA(MatAXPY(jacobian, 1.0_wp, self%stiffness, SAME_NONZERO_PATTERN, ierr))
  end subroutine add_stiffness

  !> Saves or restores amplitudes, then their rates, now and one step ago: piece by piece along the foil, pad by pad.
  subroutine visit(self, archive)
    class(inner_motion_type), intent(inout) :: self !! the modes, where there are any; written where the archive restores
    type(archive_type), intent(inout) :: archive !! that saves or restores
    character(len=*), parameter :: name(2) = [character(len=12) :: 'modes', 'modes_before']
    type(natural_order_type) :: pieces
    logical, allocatable :: has(:, :) ! (modes, pieces)
    integer, allocatable :: modes(:)
    real(wp), allocatable :: value(:, :)
    integer :: step, most, i

    if (.not. self%present) return
    pieces%number = [(self%inner(i)%place, i=1, size(self%inner))]
    pieces%total = largest_number(pieces%number)
    modes = [(spread(size(self%inner(i)%eigenvalue), 1, size(self%inner(i)%place)), i=1, size(self%inner))]
    most = largest_number(modes)
    has = spread([(i, i=1, most)], 2, size(modes)) <= spread(modes, 1, most)
    allocate (value(2*most, size(modes)))
    do step = 1, 2
      value(:most, :) = unpack(self%amplitude(:, step), has, 0.0_wp)
      value(most + 1:, :) = unpack(self%rate(:, step), has, 0.0_wp)
      call visit_field(archive, trim(name(step)), pieces, value)
      self%amplitude(:, step) = pack(value(:most, :), has)
      self%rate(:, step) = pack(value(most + 1:, :), has)
    end do
  end subroutine visit

  !> Frees what PETSc holds; may be called twice.
  subroutine destroy(self)
    class(inner_motion_type), intent(inout) :: self !! no modes any longer
    PetscErrorCode :: ierr

    if (.not. self%present) return
    PetscCallA(MatDestroy(self%coupling, ierr))
    PetscCallA(MatDestroy(self%stiffness, ierr))
    PetscCallA(VecDestroy(self%left, ierr))
    PetscCallA(VecDestroy(self%right, ierr))
    PetscCallA(VecDestroy(self%drive, ierr))
    PetscCallA(VecDestroy(self%force, ierr))
    self%present = .false.
  end subroutine destroy
end module gfb_inner_motion
