#include "gfb_petsc.h"
!> The linearised equations of a bearing that vibrates, and how they depend on the frequency.
!>
!> Of motions \( e^{\lambda t} \) they have the matrix
!>
!> $$ f_x + \lambda c_x + D(\lambda), $$
!>
!> with f the steady equations, c the gas that the film's elements hold, and D what dissipates in the foil
!> and what it weighs: its springs are \( k (1 + i \eta \, sgn \, \omega) + \lambda c + k_m \lambda\tau/(1 + \lambda\tau) \), the
!> last with a Maxwell arm (`gfb_maxwell_arm`), its mass is that of `gfb_foil_inertia`. This is the only place where a foil's stiffness depends on the frequency;
!> `gfb_dynamic_response` fills the matrices, `gfb_foil_weighing` the mass.
module gfb_vibration_equations
  use petscmat
  use gfb_kinds, only: wp
  use gfb_maxwell_arm, only: maxwell_arm_type, arm_stiffness
  use gfb_foil_inertia, only: foil_inertia_type, add_inertia, destroy_inertia
  implicit none (type)
  private
  public :: combine, dissipates, loss_at, destroy_equations

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
