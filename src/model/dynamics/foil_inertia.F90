#include "gfb_petsc.h"
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
module gfb_foil_inertia
  use petscmat
  use gfb_kinds, only: wp
  use gfb_inner_motion, only: inner_modes_type, inner_block, inner_block_rate, add_to_pieces
  use gfb_vibration_law, only: weights_type
  implicit none (type)
  private
  public :: add_inertia, destroy_inertia

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

contains

  !> Adds what the mass does in a motion \( e^{\lambda t} \), or the derivative of that.
  subroutine add_inertia(inertia, rate, weights, real_part, imaginary_part, weight_rates)
    type(foil_inertia_type), intent(in) :: inertia !! that was created
    complex(wp), intent(in) :: rate !! lambda [1/s]
    type(weights_type), intent(in) :: weights !! there
    Mat, intent(in) :: real_part, imaginary_part !! of the bearing's matrix, scaled
    type(weights_type), intent(in), optional :: weight_rates !! the derivative is added, with these
    type(tMat) :: part
    complex(wp), allocatable :: block(:, :)
    complex(wp) :: mass
    PetscErrorCode :: ierr
    integer :: i, k

    if (.not. inertia%present) return
    mass = weights%mass
    if (present(weight_rates)) mass = weight_rates%mass
    PetscCallA(MatAXPY(real_part, real(mass, wp), inertia%mass, SAME_NONZERO_PATTERN, ierr))
    PetscCallA(MatAXPY(imaginary_part, aimag(mass), inertia%mass, SAME_NONZERO_PATTERN, ierr))
    if (.not. inertia%has_modes .or. inertia%skips_modes) return
    ! One after the other: each is as large as the mass. Blocks are found twice: kept, those of [Gu2020]'s bearing took 45 MB.
    do k = 1, 2
      PetscCallA(MatDuplicate(inertia%mass, MAT_DO_NOT_COPY_VALUES, part, ierr))
      PetscCallA(MatSetOption(part, MAT_NEW_NONZERO_LOCATIONS, PETSC_FALSE, ierr)) ! round-off, as the mass has
      do i = 1, size(inertia%inner)
        if (present(weight_rates)) then
          block = inner_block_rate(inertia%inner(i), rate, weights%springs, weight_rates%springs)
        else
          block = inner_block(inertia%inner(i), rate, weights%springs)
        end if
        if (k == 1) call add_to_pieces(inertia%inner(i), real(block, wp), part)
        if (k == 2) call add_to_pieces(inertia%inner(i), aimag(block), part)
      end do
      PetscCallA(MatAssemblyBegin(part, MAT_FINAL_ASSEMBLY, ierr))
      PetscCallA(MatAssemblyEnd(part, MAT_FINAL_ASSEMBLY, ierr))
      PetscCallA(MatDiagonalScale(part, inertia%left, inertia%right, ierr))
      if (k == 1) then
        PetscCallA(MatAXPY(real_part, 1.0_wp, part, SAME_NONZERO_PATTERN, ierr))
      else
        PetscCallA(MatAXPY(imaginary_part, 1.0_wp, part, SAME_NONZERO_PATTERN, ierr))
      end if
      PetscCallA(MatDestroy(part, ierr))
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
end module gfb_foil_inertia
