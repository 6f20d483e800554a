#include "gfb_petsc.h"
!> The linearised equations of a bearing that vibrates, and how they depend on the frequency.
!>
!> Of motions \( e^{\lambda t} \) they have the matrix
!>
!> $$ f_x + \lambda c_x + D(\lambda), $$
!>
!> with f the steady equations, c the gas that the film's elements hold, and D what dissipates in the foil
!> and what it weighs: its springs are \( k (1 + i \eta \, sgn \, \omega) + \lambda c + k_m \lambda\tau/(1 + \lambda\tau) \), the
!> last with a Maxwell arm (`gfb_maxwell_arm`), its mass is that of `gfb_vibration_equations`. This is the only place where a foil's stiffness depends on the frequency;
!> `gfb_dynamic_response` fills the matrices, `gfb_foil_weighing` the mass.
!>
!> What the mass of a foil does in its equations.
!>
!> Foils that are not condensed have their consistent mass M. A condensed piece with retained unknowns
!> u has its condensed mass, and fixed-interface modes \( \phi_i \) of unit modal mass with the
!> coupling \( m_i \) to u. In a motion \( e^{\lambda t} \) each mode follows u, and is eliminated:
!>
!> $$ \eta_i = -\frac{\lambda^2 m_i^T u}{\omega_i^2 (1 + l) + \lambda^2}, \qquad
!>    D = K (1 + l) + \lambda^2 M - \sum_i \frac{\lambda^4 m_i m_i^T}{\omega_i^2 (1 + l) + \lambda^2} $$
!>
!> with the loss l of the stiffness. That is exact where all modes are kept, and has no unknowns but u.
!> Source: [CraigBampton1968].
module gfb_vibration_equations
  use petscmat
  use gfb_kinds, only: wp
  use gfb_inner_motion, only: inner_modes_type, inner_block, add_to_pieces
  use gfb_maxwell_arm, only: maxwell_arm_type, arm_stiffness
  implicit none (type)
  private
  public :: add_inertia, destroy_inertia, combine, dissipates, destroy_equations

  !> The mass, or why there is none.
  type, public :: foil_inertia_type
    logical :: present = .false.         !! the foil has its mass
    logical :: judged = .false.          !! by the next two
    real(wp) :: highest = 0.0_wp         !! frequency that is asked for [rad/s]
    real(wp) :: lowest = 0.0_wp          !! natural frequency of the foil alone; 0: not found [rad/s]
    real(wp) :: left_out = huge(1.0_wp)  !! lowest fixed-interface frequency that is left out [rad/s]
    logical :: skips_modes = .false.     !! for the time being those kept are left out as well
    type(tMat) :: mass                   !! M, scaled as the bearing's matrix
    type(tVec) :: left, right            !! these scales
    logical :: has_modes = .false.       !! on whatever rank
    type(inner_modes_type), allocatable :: inner(:) !! this rank's kinds
  end type foil_inertia_type

  !> What a foil does under vibration.
  type, public :: vibration_type
    logical :: stick = .true.           !! contacts that rub stick; else they slide on as they did
    real(wp) :: loss_factor = 0.0_wp    !! eta of the foil's stiffness [1]
    real(wp) :: damping_time = 0.0_wp   !! c/k, viscous damping of its springs over their stiffness [s]
    type(maxwell_arm_type) :: arm       !! beside its springs, its stiffness over theirs [1]
  end type vibration_type

  !> Derivatives of the equations by the unknowns.
  type, public :: vibration_equations_type
    type(vibration_type) :: vibration
    logical :: local_springs = .false. !! a node's pressure moves the foil there
    type(tMat) :: steady, squeeze !! f_x and c_x
    type(tMat) :: flow_by_gap, squeeze_by_gap, springs !! shares of them that springs with losses turn
    type(foil_inertia_type) :: inertia !! of the foil, nothing by default
    type(tMat) :: real_part, imaginary_part !! of the matrix that was combined last
  end type vibration_equations_type

contains

  !> Adds what the mass does in a motion \( e^{\lambda t} \).
  subroutine add_inertia(inertia, rate, loss, real_part, imaginary_part)
    type(foil_inertia_type), intent(in) :: inertia !! that was created
    complex(wp), intent(in) :: rate !! lambda [1/s]
    complex(wp), intent(in) :: loss !! l of the stiffness [1]
    Mat, intent(in) :: real_part, imaginary_part !! of the bearing's matrix, scaled
    type(tMat) :: part(2)
    complex(wp), allocatable :: block(:, :)
    PetscErrorCode :: ierr
    integer :: i

    if (.not. inertia%present) return
    PetscCallA(MatAXPY(real_part, real(rate**2, wp), inertia%mass, SAME_NONZERO_PATTERN, ierr))
    PetscCallA(MatAXPY(imaginary_part, aimag(rate**2), inertia%mass, SAME_NONZERO_PATTERN, ierr))
    if (.not. inertia%has_modes .or. inertia%skips_modes) return
    do i = 1, 2
      PetscCallA(MatDuplicate(inertia%mass, MAT_DO_NOT_COPY_VALUES, part(i), ierr))
      PetscCallA(MatSetOption(part(i), MAT_NEW_NONZERO_LOCATIONS, PETSC_FALSE, ierr)) ! round-off, as the mass has
    end do
    do i = 1, size(inertia%inner)
      block = inner_block(inertia%inner(i), rate, loss)
      call add_to_pieces(inertia%inner(i), real(block, wp), part(1))
      call add_to_pieces(inertia%inner(i), aimag(block), part(2))
    end do
    do i = 1, 2
      PetscCallA(MatAssemblyBegin(part(i), MAT_FINAL_ASSEMBLY, ierr))
      PetscCallA(MatAssemblyEnd(part(i), MAT_FINAL_ASSEMBLY, ierr))
      PetscCallA(MatDiagonalScale(part(i), inertia%left, inertia%right, ierr))
    end do
    PetscCallA(MatAXPY(real_part, 1.0_wp, part(1), SAME_NONZERO_PATTERN, ierr))
    PetscCallA(MatAXPY(imaginary_part, 1.0_wp, part(2), SAME_NONZERO_PATTERN, ierr))
    do i = 1, 2
      PetscCallA(MatDestroy(part(i), ierr))
    end do
  end subroutine add_inertia

  !> Frees what PETSc holds.
  subroutine destroy_inertia(inertia)
    type(foil_inertia_type), intent(inout) :: inertia !! is freed
    PetscErrorCode :: ierr

    if (.not. inertia%present) return
    PetscCallA(MatDestroy(inertia%mass, ierr))
    PetscCallA(VecDestroy(inertia%left, ierr))
    PetscCallA(VecDestroy(inertia%right, ierr))
    inertia%present = .false.
  end subroutine destroy_inertia

  !> Whether the foil's stiffness is complex.
  pure function dissipates(equations)
    type(vibration_equations_type), intent(in) :: equations !! complete ones
    logical :: dissipates
    associate (vibration => equations%vibration)
      dissipates = vibration%loss_factor > 0.0_wp .or. vibration%damping_time > 0.0_wp .or. vibration%arm%is_present()
    end associate
  end function dissipates

  !> What a foil adds to its stiffness under motions \( e^{\lambda t} \), over the stiffness.
  pure function loss_at(vibration, rate) result(loss)
    type(vibration_type), intent(in) :: vibration !! of the foil
    complex(wp), intent(in) :: rate !! lambda [1/s]
    complex(wp) :: loss             !! [1]

    loss = cmplx(0.0_wp, sign(vibration%loss_factor, aimag(rate)), wp) + rate*vibration%damping_time
    if (vibration%arm%is_present()) loss = loss + arm_stiffness(vibration%arm, rate)
  end function loss_at

  !> Real and imaginary part of the matrix of motions \( e^{\lambda t} \).
  subroutine combine(equations, rate)
    type(vibration_equations_type), intent(in) :: equations !! complete ones
    complex(wp), intent(in) :: rate !! lambda [1/s]
    complex(wp) :: loss, softening
    PetscErrorCode :: ierr

    PetscCallA(MatCopy(equations%steady, equations%real_part, SAME_NONZERO_PATTERN, ierr))
    PetscCallA(MatZeroEntries(equations%imaginary_part, ierr))
    call add_multiple(rate, equations%squeeze)
    loss = loss_at(equations%vibration, rate)
    call add_inertia(equations%inertia, rate, loss, equations%real_part, equations%imaginary_part)
    if (.not. dissipates(equations)) return
    if (equations%local_springs) then
      softening = 1.0_wp/(1.0_wp + loss) - 1.0_wp
      call add_multiple(softening, equations%flow_by_gap)
      call add_multiple(rate*softening, equations%squeeze_by_gap)
    else
      call add_multiple(loss, equations%springs)
    end if

  contains

    subroutine add_multiple(factor, matrix)
      complex(wp), intent(in) :: factor
      Mat, intent(in) :: matrix

      PetscCallA(MatAXPY(equations%real_part, real(factor, wp), matrix, SAME_NONZERO_PATTERN, ierr))
      PetscCallA(MatAXPY(equations%imaginary_part, aimag(factor), matrix, SAME_NONZERO_PATTERN, ierr))
    end subroutine add_multiple
  end subroutine combine

  !> Frees what PETSc holds.
  subroutine destroy_equations(equations)
    type(vibration_equations_type), intent(inout) :: equations !! complete ones
    PetscErrorCode :: ierr

    PetscCallA(MatDestroy(equations%steady, ierr))
    PetscCallA(MatDestroy(equations%squeeze, ierr))
    PetscCallA(MatDestroy(equations%real_part, ierr))
    PetscCallA(MatDestroy(equations%imaginary_part, ierr))
    call destroy_inertia(equations%inertia)
    if (.not. dissipates(equations)) return
    if (equations%local_springs) then
      PetscCallA(MatDestroy(equations%flow_by_gap, ierr))
      PetscCallA(MatDestroy(equations%squeeze_by_gap, ierr))
    else
      PetscCallA(MatDestroy(equations%springs, ierr))
    end if
  end subroutine destroy_equations
end module gfb_vibration_equations
