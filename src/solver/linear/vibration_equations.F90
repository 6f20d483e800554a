#include "gfb_petsc.h"
!> The linearised equations of a bearing that vibrates, and how they depend on the frequency.
!>
!> Of motions \( e^{\lambda t} \) they have the matrix
!>
!> $$ f_x + \lambda c_x + D(\lambda), $$
!>
!> with f the steady equations, c the gas that the film's elements hold, and D what dissipates in the foil
!> and what it weighs: its springs are \( k (1 + i \eta \, sgn \, \omega) + \lambda c + k_m \lambda\tau/(1 + \lambda\tau) \), the
!> last with a Maxwell arm (`gfb_maxwell_arm`), its mass is that of `gfb_vibration_equations`. This is the only place where a foil's stiffness depends on the frequency.
!>
!> So the matrix is that of f, the mass, and a list of parts: matrices, each with a law by which \( \lambda \) weights it. Who combines,
!> derives or frees goes through the list; `gfb_dynamic_response` makes it, `gfb_foil_weighing` the mass.
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
  use gfb_inner_motion, only: inner_modes_type, inner_block, inner_block_rate, add_to_pieces
  use gfb_maxwell_arm, only: maxwell_arm_type, arm_stiffness, arm_stiffness_rate
  implicit none (type)
  private
  public :: add_inertia, destroy_inertia, combine, combine_rate, weights_at, weight_rates_at, dissipates, add_part, rate_at_rest, &
            destroy_equations

  !> Laws by which parts are weighted, see `weights_type`.
  integer, parameter, public :: by_rate = 1, by_springs = 2, by_local_springs = 3, by_rate_of_local_springs = 4

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
    real(wp) :: damping_time = 0.0_wp   !! c/k, viscous damping of its springs or of meshed foils over the stiffness [s]
    type(maxwell_arm_type) :: arm       !! beside its springs, its stiffness over theirs [1]
  end type vibration_type

  !> What the matrices are multiplied with in a motion \( e^{\lambda t} \), or the derivatives of that by \( \lambda \).
  type, public :: weights_type
    complex(wp) :: squeeze, mass   !! lambda, lambda squared [1/s], [1/s2]
    complex(wp) :: springs         !! l, what the foil adds to its stiffness, over it [1]
    complex(wp) :: flow_by_gap     !! of local springs 1/(1 + l) - 1 [1]
    complex(wp) :: squeeze_by_gap  !! the same times lambda [1/s]
  contains
    procedure :: of_law
  end type weights_type

  !> A part of the equations: a matrix, scaled as the bearing's, which \( \lambda \) weights by a law.
  type, public :: vibration_part_type
    integer :: law = by_rate
    type(tMat) :: matrix
  end type vibration_part_type

  !> Derivatives of the equations by the unknowns.
  type, public :: vibration_equations_type
    type(vibration_type) :: vibration
    logical :: local_springs = .false. !! a node's pressure moves the foil there
    logical :: meshed = .false.        !! the foil has unknowns by the thousand, which all lose
    type(tMat) :: steady !! f_x
    type(vibration_part_type), allocatable :: part(:) !! beside it and the mass
    type(foil_inertia_type) :: inertia !! of the foil, nothing by default
    type(tMat) :: real_part, imaginary_part !! of the matrix that was combined last
  end type vibration_equations_type

contains

  !> Adds what the mass does in a motion \( e^{\lambda t} \), or the derivative of that.
  subroutine add_inertia(inertia, rate, weights, real_part, imaginary_part, weight_rates)
    type(foil_inertia_type), intent(in) :: inertia !! that was created
    complex(wp), intent(in) :: rate !! lambda [1/s]
    type(weights_type), intent(in) :: weights !! there
    Mat, intent(in) :: real_part, imaginary_part !! of the bearing's matrix, scaled
    type(weights_type), intent(in), optional :: weight_rates !! the derivative is added, with these
    type(tMat) :: part(2)
    complex(wp), allocatable :: block(:, :)
    complex(wp) :: mass
    PetscErrorCode :: ierr
    integer :: i

    if (.not. inertia%present) return
    mass = weights%mass
    if (present(weight_rates)) mass = weight_rates%mass
    PetscCallA(MatAXPY(real_part, real(mass, wp), inertia%mass, SAME_NONZERO_PATTERN, ierr))
    PetscCallA(MatAXPY(imaginary_part, aimag(mass), inertia%mass, SAME_NONZERO_PATTERN, ierr))
    if (.not. inertia%has_modes .or. inertia%skips_modes) return
    do i = 1, 2
      PetscCallA(MatDuplicate(inertia%mass, MAT_DO_NOT_COPY_VALUES, part(i), ierr))
      PetscCallA(MatSetOption(part(i), MAT_NEW_NONZERO_LOCATIONS, PETSC_FALSE, ierr)) ! round-off, as the mass has
    end do
    do i = 1, size(inertia%inner)
      if (present(weight_rates)) then
        block = inner_block_rate(inertia%inner(i), rate, weights%springs, weight_rates%springs)
      else
        block = inner_block(inertia%inner(i), rate, weights%springs)
      end if
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

  !> Weights of the matrices in a motion \( e^{\lambda t} \).
  pure function weights_at(vibration, rate) result(weights)
    type(vibration_type), intent(in) :: vibration !! of the foil
    complex(wp), intent(in) :: rate !! lambda [1/s]
    type(weights_type) :: weights

    weights%squeeze = rate
    weights%mass = rate**2
    weights%springs = cmplx(0.0_wp, sign(vibration%loss_factor, aimag(rate)), wp) + rate*vibration%damping_time
    if (vibration%arm%is_present()) weights%springs = weights%springs + arm_stiffness(vibration%arm, rate)
    weights%flow_by_gap = 1.0_wp/(1.0_wp + weights%springs) - 1.0_wp
    weights%squeeze_by_gap = rate*weights%flow_by_gap
  end function weights_at

  !> That of a law.
  pure complex(wp) function of_law(self, law) result(weight)
    class(weights_type), intent(in) :: self !! the weights, or their derivatives
    integer, intent(in) :: law !! of a part
    complex(wp) :: all_weights(by_rate_of_local_springs)

    all_weights = [self%squeeze, self%springs, self%flow_by_gap, self%squeeze_by_gap]
    weight = all_weights(law)
  end function of_law

  !> Their derivatives by \( \lambda \); a loss factor stays what it is.
  pure function weight_rates_at(vibration, rate) result(rates)
    type(vibration_type), intent(in) :: vibration !! of the foil
    complex(wp), intent(in) :: rate !! lambda [1/s]
    type(weights_type) :: rates, weights

    weights = weights_at(vibration, rate)
    rates%squeeze = 1.0_wp
    rates%mass = 2.0_wp*rate
    rates%springs = vibration%damping_time
    if (vibration%arm%is_present()) rates%springs = rates%springs + arm_stiffness_rate(vibration%arm, rate)
    rates%flow_by_gap = -rates%springs/(1.0_wp + weights%springs)**2
    rates%squeeze_by_gap = weights%flow_by_gap + rate*rates%flow_by_gap
  end function weight_rates_at

  !> Real and imaginary part of the matrix of motions \( e^{\lambda t} \).
  subroutine combine(equations, rate)
    type(vibration_equations_type), intent(in) :: equations !! complete ones
    complex(wp), intent(in) :: rate !! lambda [1/s]
    type(weights_type) :: weights
    PetscErrorCode :: ierr

    weights = weights_at(equations%vibration, rate)
    PetscCallA(MatCopy(equations%steady, equations%real_part, SAME_NONZERO_PATTERN, ierr))
    PetscCallA(MatZeroEntries(equations%imaginary_part, ierr))
    call add_inertia(equations%inertia, rate, weights, equations%real_part, equations%imaginary_part)
    call add_parts(equations, weights)
  end subroutine combine

  !> The derivative of that matrix by \( \lambda \), in its place.
  subroutine combine_rate(equations, rate, without_mass)
    type(vibration_equations_type), intent(in) :: equations !! complete ones
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
  subroutine add_part(law, equations, matrix)
    integer, intent(in) :: law !! by which it is weighted
    type(vibration_equations_type), intent(inout) :: equations !! with the steady ones
    Mat, intent(out) :: matrix !! of the list, like the steady one, without values
    PetscErrorCode :: ierr

    PetscCallA(MatDuplicate(equations%steady, MAT_DO_NOT_COPY_VALUES, matrix, ierr))
    if (.not. allocated(equations%part)) allocate (equations%part(0))
    equations%part = [equations%part, vibration_part_type(law, matrix)]
  end subroutine add_part

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
    PetscCallA(MatDestroy(equations%real_part, ierr))
    PetscCallA(MatDestroy(equations%imaginary_part, ierr))
    call destroy_inertia(equations%inertia)
  end subroutine destroy_equations
end module gfb_vibration_equations
