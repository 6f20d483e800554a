#include "gfb_petsc.h"
!> Natural modes put right by the energies of their strains.
!>
!> A stiffness matrix of a thin shell holds stretching and bending in the same numbers, and its
!> round-off is that of stretching: \( \epsilon E t \) against \( E t^3/L^2 \). The work of forces
!> that come from strains, element by element, has no such error. So Ritz's method over modes that
!> the matrix gave,
!>
!> $$ a_{ij} = \sum_e \int \sigma(\phi_j) : \varepsilon(\phi_i) \, dV, \qquad
!>    b_{ij} = \phi_i^T M \phi_j, \qquad A q = \omega^2 B q, $$
!>
!> leaves of a frequency's relative error what is of its square. Motions without strain are known
!> beforehand: the rigid ones that the supports leave free.
module gfb_mode_energies
  use petscksp
  use gfb_kinds, only: wp
  use gfb_errors, only: error_type
  use gfb_foil_structure, only: foil_structure_type
  use gfb_strain_energy, only: strain_products
  use gfb_eigenmodes, only: modes_type, factor_shifted, mass_products, solve_symmetric, combine
  implicit none (type)
  private
  public :: sharpen_modes

  real(wp), parameter, public :: exact = 1.0e-5_wp !! round-off of eigenvalues whose square is no matter
  real(wp), parameter :: settled = 1.0e-7_wp       !! change of an eigenvalue in a round that ends the corrections
  integer, parameter :: rounds = 8                 !! of corrections, at most
  real(wp), parameter :: dependent = 1.0e-3_wp     !! what is left of a correction that others make up, relative

contains

  !> Replaces modes by Ritz's, whose stiffness comes from strains.
  !>
  !> Where the matrix had lost digits, what the modes' own forces leave unbalanced leads to
  !> better ones: \( (K + s M)^{-1} (f(\phi) - \omega^2 M \phi) \) joins them, and what the round before
  !> has changed (Davidson's method with the memory of LOBPCG), until that changes no eigenvalue. Fails
  !> where an element is clockwise or degenerate.
  subroutine sharpen_modes(foil, mass, rigid, modes, lost, left, error)
    type(foil_structure_type), intent(in) :: foil !! the structure
    Mat, intent(in) :: mass                 !! of its free unknowns
    real(wp), intent(in) :: rigid           !! eigenvalues below it are those of motions without strain [1/s2]
    type(modes_type), intent(inout) :: modes !! in rising order
    real(wp), intent(out) :: lost           !! largest relative error of the matrix' eigenvalues [1]
    real(wp), intent(out) :: left           !! largest relative change of an eigenvalue in the last round [1]
    type(error_type), allocatable, intent(out) :: error !! why it could not be done
    Vec :: force(size(modes%shape)), moved(size(modes%shape))
    KSP :: solver
    PetscErrorCode :: ierr
    integer :: i, round

    lost = 0.0_wp
    left = 0.0_wp
    if (size(modes%shape) == 0) return
    do i = 1, size(force)
      PetscCallA(VecDuplicate(modes%shape(i), force(i), ierr))
      PetscCallA(VecDuplicate(modes%shape(i), moved(i), ierr))
    end do
    call take_ritz(foil, mass, rigid, 0, modes, force, moved, lost, error)
    left = lost
    do round = 1, rounds
      if (allocated(error) .or. lost <= exact .or. left <= settled) exit
      if (round == 1) then
        call factor_shifted(foil%stiffness, mass, minval(modes%eigenvalue, modes%eigenvalue > rigid), 'mode_corrections_', &
                            solver)
      end if
      call take_ritz(foil, mass, rigid, round, modes, force, moved, left, error, solver)
    end do
    if (lost > exact) then
      PetscCallA(KSPDestroy(solver, ierr))
    end if
    do i = 1, size(force)
      PetscCallA(VecDestroy(force(i), ierr))
      PetscCallA(VecDestroy(moved(i), ierr))
    end do
  end subroutine sharpen_modes

  !> One round of Ritz's method: over the modes, and over their corrections where there is a solver.
  subroutine take_ritz(foil, mass, rigid, round, modes, force, moved, change, error, solver)
    type(foil_structure_type), intent(in) :: foil
    Mat, intent(in) :: mass
    real(wp), intent(in) :: rigid         !! [1/s2]
    integer, intent(in) :: round          !! 0: forces of the modes are not known yet
    type(modes_type), intent(inout) :: modes
    Vec, intent(in) :: force(:)           !! elastic ones of the modes
    Vec, intent(in) :: moved(:)           !! by which the modes changed in the last round
    real(wp), intent(out) :: change       !! of an eigenvalue, relative, largest [1]
    type(error_type), allocatable, intent(out) :: error
    KSP, intent(in), optional :: solver   !! of the shifted stiffness
    Vec :: basis(3*size(force)), image(3*size(force))
    real(wp), allocatable :: energy(:, :), modal_mass(:, :), eigenvalue(:)
    PetscErrorCode :: ierr
    integer :: i, modes_found, used

    change = 0.0_wp
    modes_found = size(force)
    used = modes_found
    do i = 1, modes_found
      PetscCallA(VecDuplicate(force(i), basis(i), ierr))
      PetscCallA(VecCopy(modes%shape(i), basis(i), ierr))
    end do
    if (round > 0) call add_corrections(solver, mass, rigid, modes, force, basis, used)
    if (round > 1) call add_changes(mass, modes%eigenvalue > rigid, moved, basis, used)
    do i = 1, used
      PetscCallA(VecDuplicate(force(1), image(i), ierr))
    end do
    allocate (energy(used, used), modal_mass(used, used), eigenvalue(used))
    call strain_products(foil, basis(:used), energy, error, image(:used))
    if (.not. allocated(error)) then
      modal_mass = mass_products(basis(:used), mass)
      call solve_symmetric(energy, modal_mass, eigenvalue)
      associate (now => eigenvalue(:modes_found))
        change = maxval(abs(modes%eigenvalue - now)/max(now, rigid), mask=now > rigid)
        change = max(change, 0.0_wp) ! nothing is elastic
        modes%eigenvalue = now
      end associate
      call combine(energy(:, :modes_found), basis(:used), modes%shape)
      call combine(energy(:, :modes_found), image(:used), force)
      if (used > modes_found) call combine(energy(modes_found + 1:, :modes_found), basis(modes_found + 1:used), moved)
    end if
    do i = 1, used
      PetscCallA(VecDestroy(basis(i), ierr))
      PetscCallA(VecDestroy(image(i), ierr))
    end do
  end subroutine take_ritz

  !> Adds corrections of the elastic modes to a basis, each at right angles to all before it.
  subroutine add_corrections(solver, mass, rigid, modes, force, basis, used)
    KSP, intent(in) :: solver
    Mat, intent(in) :: mass
    real(wp), intent(in) :: rigid
    type(modes_type), intent(in) :: modes
    Vec, intent(in) :: force(:)
    Vec, intent(inout) :: basis(:)
    integer, intent(inout) :: used !! of the basis
    Vec :: work
    PetscErrorCode :: ierr
    integer :: i

    PetscCallA(VecDuplicate(force(1), work, ierr))
    do i = 1, size(force)
      if (.not. modes%eigenvalue(i) > rigid) cycle
      used = used + 1
      PetscCallA(VecDuplicate(work, basis(used), ierr))
      PetscCallA(MatMult(mass, modes%shape(i), work, ierr))
      PetscCallA(VecAYPX(work, -modes%eigenvalue(i), force(i), ierr))
      PetscCallA(KSPSolve(solver, work, basis(used), ierr))
      call keep_new(mass, basis, used)
    end do
    PetscCallA(VecDestroy(work, ierr))
  end subroutine add_corrections

  !> Adds to a basis what the last round changed of the elastic modes.
  subroutine add_changes(mass, elastic, moved, basis, used)
    Mat, intent(in) :: mass
    logical, intent(in) :: elastic(:) !! mode by mode
    Vec, intent(in) :: moved(:)
    Vec, intent(inout) :: basis(:)
    integer, intent(inout) :: used !! of the basis
    PetscErrorCode :: ierr
    integer :: i

    do i = 1, size(moved)
      if (.not. elastic(i)) cycle
      used = used + 1
      PetscCallA(VecDuplicate(moved(i), basis(used), ierr))
      PetscCallA(VecCopy(moved(i), basis(used), ierr))
      call keep_new(mass, basis, used)
    end do
  end subroutine add_changes

  !> Keeps of a basis' last vector what is at right angles to all before it, or drops it.
  subroutine keep_new(mass, basis, used)
    Mat, intent(in) :: mass
    Vec, intent(inout) :: basis(:)
    integer, intent(inout) :: used !! of the basis
    Vec :: work
    PetscScalar :: before, after, product
    PetscErrorCode :: ierr
    integer :: k, pass

    PetscCallA(VecDuplicate(basis(used), work, ierr))
    before = modal_mass_of(basis(used))
    do pass = 1, 2
      do k = 1, used - 1
        PetscCallA(MatMult(mass, basis(used), work, ierr))
        PetscCallA(VecDot(work, basis(k), product, ierr))
        PetscCallA(VecAXPY(basis(used), -product, basis(k), ierr))
      end do
    end do
    after = modal_mass_of(basis(used))
    if (after > dependent**2*before) then
      PetscCallA(VecScale(basis(used), 1.0_wp/sqrt(after), ierr))
    else
      PetscCallA(VecDestroy(basis(used), ierr))
      used = used - 1
    end if
    PetscCallA(VecDestroy(work, ierr))

  contains

    !> Product of a vector with itself in the mass.
    function modal_mass_of(vector) result(square)
      Vec, intent(in) :: vector
      PetscScalar :: square
      PetscCallA(MatMult(mass, vector, work, ierr))
      PetscCallA(VecDot(work, vector, square, ierr))
    end function modal_mass_of
  end subroutine keep_new

end module gfb_mode_energies
