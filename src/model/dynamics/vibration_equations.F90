#include "gfb_petsc.h"
!> The linearised equations of a bearing that vibrates, and how they depend on the frequency.
!>
!> Of motions \( e^{\lambda t} \) they have the matrix
!>
!> $$ f_x + D(\lambda) + \sum_k w_k(\lambda) A_k, $$
!>
!> with f the steady equations, D the mass of the foil (`gfb_foil_inertia`), and a list of parts: matrices A, each with the law w by
!> which \( \lambda \) weights it (`gfb_vibration_law`). Films add what they store, the blocks of a bearing what dissipates in its
!> foils (`gfb_bearing_motion`). Who combines, derives, counts or frees goes through the list: no part is known by its place there.
!>
!> The mass is no part: whether it counts is decided when all parts are there, and no law weights a matrix of the modes inside
!> condensed pieces.
module gfb_vibration_equations
  use petscmat
  use gfb_kinds, only: wp
  use gfb_foil_inertia, only: foil_inertia_type, add_inertia, destroy_inertia
  use gfb_vibration_law, only: by_rate, vibration_type, weights_type, weights_at, weight_rates_at, is_linear
  implicit none (type)
  private
  public :: combine, combine_rate, add_part, release_sums, rate_at_rest, has_linear_parts, has_crowds, destroy_equations

  !> A part of the equations: a matrix, scaled as the bearing's, which \( \lambda \) weights by a law.
  type, public :: vibration_part_type
    integer :: law = by_rate
    type(tMat) :: matrix
    logical :: crowds = .false. !! it brings eigenvalues by the thousand, all at nearly one rate
  end type vibration_part_type

  !> Derivatives of the equations by the unknowns.
  type, public :: vibration_equations_type
    type(vibration_type) :: vibration !! of the foil
    type(tMat) :: steady !! f_x
    type(vibration_part_type), allocatable :: part(:) !! beside it and the mass
    type(foil_inertia_type) :: inertia !! of the foil, nothing by default
    type(tMat) :: real_part, imaginary_part !! of the matrix that was combined last
    logical, private :: has_sums = .false. !! there are these
  end type vibration_equations_type

contains

  !> Real and imaginary part of the matrix of motions \( e^{\lambda t} \).
  subroutine combine(equations, rate)
    type(vibration_equations_type), intent(inout) :: equations !! complete ones
    complex(wp), intent(in) :: rate !! lambda [1/s]
    type(weights_type) :: weights
    PetscErrorCode :: ierr

    weights = weights_at(equations%vibration, rate)
    if (.not. equations%has_sums) call create_sums(equations)
    PetscCallA(MatCopy(equations%steady, equations%real_part, SAME_NONZERO_PATTERN, ierr))
    PetscCallA(MatZeroEntries(equations%imaginary_part, ierr))
    call add_inertia(equations%inertia, rate, weights, equations%real_part, equations%imaginary_part)
    call add_parts(equations, weights)
  end subroutine combine

  !> The derivative of that matrix by \( \lambda \), in its place.
  subroutine combine_rate(equations, rate, without_mass)
    type(vibration_equations_type), intent(in) :: equations !! that were combined
    complex(wp), intent(in) :: rate !! lambda [1/s]
    logical, intent(in), optional :: without_mass !! the foil's share is left out; default: it is not
    type(weights_type) :: rates
    PetscErrorCode :: ierr
    logical :: weighs

    rates = weight_rates_at(equations%vibration, rate)
    PetscCallA(MatZeroEntries(equations%real_part, ierr))
    PetscCallA(MatZeroEntries(equations%imaginary_part, ierr))
    weighs = .true.
    if (present(without_mass)) weighs = .not. without_mass
    if (weighs) call add_inertia(equations%inertia, rate, weights_at(equations%vibration, rate), equations%real_part, &
                                 equations%imaginary_part, rates)
    call add_parts(equations, rates)
  end subroutine combine_rate

  !> Adds all parts to the matrices that are combined.
  subroutine add_parts(equations, weights)
    type(vibration_equations_type), intent(in) :: equations
    type(weights_type), intent(in) :: weights !! or their derivatives
    complex(wp) :: factor
    PetscErrorCode :: ierr
    integer :: k

    do k = 1, size(equations%part)
      factor = weights%of_law(equations%part(k)%law)
      PetscCallA(MatAXPY(equations%real_part, real(factor, wp), equations%part(k)%matrix, SAME_NONZERO_PATTERN, ierr))
      PetscCallA(MatAXPY(equations%imaginary_part, aimag(factor), equations%part(k)%matrix, SAME_NONZERO_PATTERN, ierr))
    end do
  end subroutine add_parts

  !> Adds a part to the list; the one who made its matrix fills it.
  subroutine add_part(law, equations, matrix, crowds)
    integer, intent(in) :: law !! by which it is weighted
    type(vibration_equations_type), intent(inout) :: equations !! with the steady ones
    Mat, intent(out) :: matrix !! of the list, like the steady one, without values
    logical, intent(in), optional :: crowds !! it brings eigenvalues by the thousand, all at nearly one rate; default: it does not
    type(vibration_part_type) :: part
    PetscErrorCode :: ierr

    PetscCallA(MatDuplicate(equations%steady, MAT_DO_NOT_COPY_VALUES, matrix, ierr))
    if (.not. allocated(equations%part)) allocate (equations%part(0))
    part%law = law
    part%matrix = matrix
    if (present(crowds)) part%crowds = crowds
    equations%part = [equations%part, part]
  end subroutine add_part

  !> Room for the sum.
  subroutine create_sums(equations)
    type(vibration_equations_type), intent(inout) :: equations !! get it
    PetscErrorCode :: ierr

    equations%has_sums = .true.

    PetscCallA(MatDuplicate(equations%steady, MAT_DO_NOT_COPY_VALUES, equations%real_part, ierr))
    PetscCallA(MatDuplicate(equations%steady, MAT_DO_NOT_COPY_VALUES, equations%imaginary_part, ierr))
  end subroutine create_sums

  !> Frees the sum, until it is combined again.
  subroutine release_sums(equations)
    type(vibration_equations_type), intent(inout) :: equations !! with it or without
    PetscErrorCode :: ierr

    if (.not. equations%has_sums) return
    PetscCallA(MatDestroy(equations%real_part, ierr))
    PetscCallA(MatDestroy(equations%imaginary_part, ierr))
    equations%has_sums = .false.
  end subroutine release_sums

  !> Whether all parts are linear in \( \lambda \).
  pure logical function has_linear_parts(equations) result(has)
    type(vibration_equations_type), intent(in) :: equations !! complete ones
    integer :: k
    has = all([(is_linear(equations%part(k)%law, equations%vibration), k=1, size(equations%part))])
  end function has_linear_parts

  !> Whether some part brings eigenvalues by the thousand, all at nearly one rate.
  pure logical function has_crowds(equations) result(has)
    type(vibration_equations_type), intent(in) :: equations !! complete ones
    has = equations%vibration%dissipates() .and. any(equations%part%crowds)
  end function has_crowds

  !> The derivative of all parts by \( \lambda \) at rest: of equations that are linear in it, that anywhere.
  subroutine rate_at_rest(equations, matrix)
    type(vibration_equations_type), intent(in) :: equations !! complete ones
    Mat, intent(out) :: matrix !! like the steady one
    type(weights_type) :: rates
    PetscErrorCode :: ierr
    integer :: k

    rates = weight_rates_at(equations%vibration, cmplx(0.0_wp, 0.0_wp, wp))
    PetscCallA(MatDuplicate(equations%steady, MAT_DO_NOT_COPY_VALUES, matrix, ierr))
    do k = 1, size(equations%part)
      PetscCallA(MatAXPY(matrix, real(rates%of_law(equations%part(k)%law), wp), equations%part(k)%matrix, SAME_NONZERO_PATTERN, ierr))
    end do
  end subroutine rate_at_rest

  !> Frees what PETSc holds.
  subroutine destroy_equations(equations)
    type(vibration_equations_type), intent(inout) :: equations !! complete ones
    PetscErrorCode :: ierr
    integer :: k

    PetscCallA(MatDestroy(equations%steady, ierr))
    do k = 1, size(equations%part)
      PetscCallA(MatDestroy(equations%part(k)%matrix, ierr))
    end do
    deallocate (equations%part)
    call release_sums(equations)
    call destroy_inertia(equations%inertia)
  end subroutine destroy_equations
end module gfb_vibration_equations
