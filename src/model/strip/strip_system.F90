#include "gfb_petsc.h"
!> Equations of a bump strip between the sleeve and what presses on its crests.
!>
!> Unknowns: those of the foil, and after them the displacement of a plate where its force is given.
!> Displacements are in units of a typical deflection, equations in units of the energy that goes
!> with it, so that the matrix of a strip without friction stays symmetric.
module gfb_strip_system
  use petscmat
  use gfb_kinds, only: wp
  use gfb_petsc_kinds, only: pint
  use gfb_petsc_session, only: any_rank, this_rank, rank_count, largest_number
  use gfb_natural_order, only: natural_order_type
  use gfb_bump_contacts, only: contact_top
  use gfb_contact_set, only: contact_set_type
  use gfb_errors, only: error_type
  use gfb_foil_structure, only: foil_structure_type, destroy_foil_structure
  use gfb_strain_energy, only: strain_products
  use gfb_local_exchange, only: local_exchange_type, create_exchange
  use gfb_rigid_modes, only: patch_type, find_patches, create_motions
  use gfb_matrix_rows, only: copy_row
  use gfb_border_rows, only: border_type, create_border
  use gfb_nonlinear_system, only: nonlinear_system_type
  implicit none (type)
  private
  public :: create_strip_system, destroy_strip_system, strip_order

  integer, parameter, public :: plate_none = 0  !! the crests carry given forces
  integer, parameter, public :: plate_forced = 1
  integer, parameter, public :: plate_moved = 2

  !> Sizes that are of the order of the answer.
  type, public :: strip_scale_type
    real(wp) :: length = 1.0_wp !! deflection [m]
    real(wp) :: angle = 1.0_wp  !! rotation [1]
    real(wp) :: force = 1.0_wp  !! on one node [N]
  end type strip_scale_type

  !> The strip, its contacts and its load.
  type, extends(nonlinear_system_type), public :: strip_system_type
    type(foil_structure_type) :: foil
    type(contact_set_type) :: contacts
    type(strip_scale_type) :: scale
    integer :: plate = plate_none
    real(wp) :: plate_displacement = 0.0_wp          !! of a moved plate at the full load, towards the sleeve [m]
    real(wp) :: factor = 0.0_wp             !! share of the full load that acts
    integer :: unknowns = 0                 !! with the plate's
    real(wp), allocatable :: crest_gap(:)   !! of each contact at rest, beyond the smallest under a forced plate [m]
    real(wp) :: free_travel = 0.0_wp        !! of a forced plate to the highest crest [m]
    real(wp), allocatable :: crest_press(:) !! full normal force of each pressed contact [N]
    Mat :: elastic                          !! stiffness of the foil alone, scaled
    Vec :: full_load                        !! scaled
    type(border_type), private :: border    !! the displacement of a plate whose force is given
    Vec, private :: unit                    !! one scaled unknown is so much [m] or [1]
    Vec, private :: work
    Vec, private :: last, elastic_force     !! where elastic forces were last asked for, and they; scaled
    type(local_exchange_type), private :: exchange
    real(wp), allocatable, private :: local_unit(:) !! of the contacts' unknowns
    logical, private :: created = .false.
  contains
    procedure :: evaluate, linearise, find_motions, settle, begin_step, virtual_work, set_factor
    procedure, non_overridable :: commit, contact_displacements, foil_solution, plate_travel, strain_energy
    procedure, non_overridable :: stiffness_round_off
  end type strip_system_type

contains

  !> Prepares vectors and matrices; foil, contacts, plate and scale have been set.
  subroutine create_strip_system(strip)
    type(strip_system_type), intent(inout) :: strip !! with foil, contacts, plate and scale
    PetscErrorCode :: ierr

    call create_border(strip%foil%part%owned_unknowns, merge(1, 0, strip%plate == plate_forced), strip%border)
    strip%unknowns = strip%border%unknowns
    PetscCallA(VecCreateMPI(PETSC_COMM_WORLD, int(strip%border%owned, pint), PETSC_DETERMINE, strip%state, ierr))
    PetscCallA(VecDuplicate(strip%state, strip%full_load, ierr))
    PetscCallA(VecDuplicate(strip%state, strip%unit, ierr))
    PetscCallA(VecDuplicate(strip%state, strip%work, ierr))
    PetscCallA(VecDuplicate(strip%state, strip%last, ierr)) ! both are zero
    PetscCallA(VecDuplicate(strip%state, strip%elastic_force, ierr))
    PetscCallA(VecSet(strip%state, 0.0_wp, ierr))
    PetscCallA(VecSet(strip%full_load, 0.0_wp, ierr))
    call set_units(strip)
    call create_exchange(int(strip%contacts%global, pint), strip%state, strip%exchange)
    allocate (strip%local_unit(size(strip%contacts%global)))
    call strip%exchange%get(strip%unit, strip%local_unit)
    call create_matrices(strip)
    strip%symmetric = all(strip%contacts%law%friction <= 0.0_wp)
    strip%definite = strip%symmetric
    strip%dense_rows = strip%plate == plate_forced
    strip%slow_change = .true. ! contacts that change their state
    strip%created = .true.
    call strip%set_factor(0.0_wp)
  end subroutine create_strip_system

  !> Size of a scaled unit of every unknown.
  subroutine set_units(strip)
    type(strip_system_type), intent(in) :: strip
    integer, parameter :: translations = 3
    integer :: node, component
    real(wp) :: unit
    PetscErrorCode :: ierr

    PetscCallA(VecSet(strip%unit, strip%scale%length, ierr)) ! the plate's too
    associate (part => strip%foil%part)
      do node = 1, size(part%mesh_node)
        if (.not. part%owned(node)) cycle
        do component = 1, size(strip%foil%slot, 1)
          if (strip%foil%unknown(component, part%mesh_node(node)) < 0) cycle
          unit = merge(strip%scale%length, strip%scale%angle, component <= translations)
          PetscCallA(VecSetValue(strip%unit, int(strip%foil%unknown(component, part%mesh_node(node)), pint), unit, INSERT_VALUES, ierr))
        end do
      end do
    end associate
    PetscCallA(VecAssemblyBegin(strip%unit, ierr))
    PetscCallA(VecAssemblyEnd(strip%unit, ierr))
  end subroutine set_units

  !> The foil's stiffness with room for the contacts, scaled, and the matrix of the whole.
  subroutine create_matrices(strip)
    type(strip_system_type), intent(inout) :: strip

    PetscInt, parameter :: of_contact = 4 !! a node's other unknowns, where the foil does not couple them
    PetscInt, allocatable :: inside(:), outside(:), column(:)
    PetscScalar, allocatable :: value(:)
    PetscInt :: first, last, row, entries, begin, finish
    PetscErrorCode :: ierr
    integer :: i

    PetscCallA(MatGetOwnershipRange(strip%foil%stiffness, first, last, ierr))
    PetscCallA(VecGetOwnershipRange(strip%state, begin, finish, ierr))
    allocate (inside(last - first), outside(last - first))
    allocate (column(strip%foil%row_entries()), value(strip%foil%row_entries()))
    do row = first, last - 1
      call copy_row(strip%foil%stiffness, row, entries, column)
      inside(row - first + 1) = count(column(:entries) >= begin .and. column(:entries) < finish)
      outside(row - first + 1) = entries - inside(row - first + 1)
    end do
    call strip%border%create_matrix(inside + of_contact, outside, strip%elastic)
    do row = first, last - 1
      call copy_row(strip%foil%stiffness, row, entries, column, value)
      PetscCallA(MatSetValues(strip%elastic, 1_pint, [row], entries, column, value, INSERT_VALUES, ierr))
    end do
    PetscCallA(MatAssemblyBegin(strip%elastic, MAT_FLUSH_ASSEMBLY, ierr))
    PetscCallA(MatAssemblyEnd(strip%elastic, MAT_FLUSH_ASSEMBLY, ierr))
    do i = 1, size(strip%contacts%point)
      call add_block(strip, strip%elastic, i, 0.0_wp)
    end do
    PetscCallA(MatAssemblyBegin(strip%elastic, MAT_FINAL_ASSEMBLY, ierr))
    PetscCallA(MatAssemblyEnd(strip%elastic, MAT_FINAL_ASSEMBLY, ierr))
    PetscCallA(MatDiagonalScale(strip%elastic, strip%unit, strip%unit, ierr))
    PetscCallA(MatScale(strip%elastic, 1.0_wp/energy(strip), ierr))
    PetscCallA(MatSetOption(strip%elastic, MAT_SYMMETRIC, PETSC_TRUE, ierr))
    PetscCallA(MatDuplicate(strip%elastic, MAT_COPY_VALUES, strip%jacobian, ierr))
    PetscCallA(MatDestroy(strip%foil%stiffness, ierr))
  end subroutine create_matrices

  !> Unit of energy [J].
  pure real(wp) function energy(strip) result(unit)
    type(strip_system_type), intent(in) :: strip
    unit = strip%scale%force*strip%scale%length
  end function energy

  !> Adds a contact's stiffness, times a factor, to a scaled matrix.
  subroutine add_block(strip, matrix, i, factor)
    type(strip_system_type), intent(in) :: strip
    Mat, intent(in) :: matrix
    integer, intent(in) :: i         !! contact
    real(wp), intent(in) :: factor   !! 0: makes room

    integer, allocatable :: unknown(:)
    PetscInt, allocatable :: number(:)
    real(wp), allocatable :: block(:, :), unit(:)
    PetscErrorCode :: ierr
    integer :: k

    unknown = strip%contacts%point_unknowns(i)
    allocate (number(size(unknown)), source=-1_pint)
    allocate (unit(size(unknown)), source=0.0_wp)
    do k = 1, size(unknown)
      if (unknown(k) == 0) cycle
      number(k) = strip%contacts%global(unknown(k))
      unit(k) = strip%local_unit(unknown(k))
    end do
    block = strip%contacts%point_block(i)*spread(unit, 1, size(unit))*spread(unit, 2, size(unit))
    block = factor/energy(strip)*transpose(block)
    PetscCallA(MatSetValues(matrix, int(size(number), pint), number, int(size(number), pint), number, block, ADD_VALUES, ierr))
  end subroutine add_block

  !> Equilibrium: elastic forces less those of contacts and load, scaled.
  subroutine evaluate(self, state, residual, valid)
    class(strip_system_type), intent(inout) :: self !! the strip
    Vec, intent(in) :: state !! scaled
    Vec, intent(in) :: residual !! scaled
    logical, intent(out) :: valid   !! true: nothing can fail
    real(wp) :: displacement(size(self%local_unit)), force(size(self%local_unit))
    PetscErrorCode :: ierr

    call self%contact_displacements(state, displacement)
    force = 0.0_wp
    call self%contacts%add_forces(displacement, force)
    call find_elastic_forces(self, state)
    PetscCallA(VecWAXPY(residual, -self%factor, self%full_load, self%elastic_force, ierr))
    call self%exchange%add(-force*self%local_unit/energy(self), residual)
    valid = .true.
  end subroutine evaluate

  !> Elastic forces at a state; those of the last one are still there, as after contacts have moved.
  subroutine find_elastic_forces(strip, state)
    class(strip_system_type), intent(inout) :: strip
    Vec, intent(in) :: state
    PetscBool :: same
    PetscErrorCode :: ierr

    PetscCallA(VecEqual(state, strip%last, same, ierr))
    if (same) return
    PetscCallA(VecCopy(state, strip%last, ierr))
    PetscCallA(MatMult(strip%elastic, state, strip%elastic_force, ierr))
  end subroutine find_elastic_forces

  !> The matrix with the contacts as they are linearised.
  subroutine linearise(self, state)
    class(strip_system_type), intent(inout) :: self !! the strip
    Vec, intent(in) :: state !! scaled
    PetscErrorCode :: ierr
    integer :: i

    PetscCallA(MatCopy(self%elastic, self%jacobian, SAME_NONZERO_PATTERN, ierr))
    do i = 1, size(self%contacts%point)
      call add_block(self, self%jacobian, i, 1.0_wp)
    end do
    PetscCallA(MatAssemblyBegin(self%jacobian, MAT_FINAL_ASSEMBLY, ierr))
    PetscCallA(MatAssemblyEnd(self%jacobian, MAT_FINAL_ASSEMBLY, ierr))
    if (self%definite) then ! each assembly makes PETSc forget it
      PetscCallA(MatSetOption(self%jacobian, MAT_SPD, PETSC_TRUE, ierr))
    end if
  end subroutine linearise

  !> Finds the motions that an iterative solver needs.
  subroutine find_motions(self)
    class(strip_system_type), intent(inout) :: self !! the strip
    type(patch_type), allocatable :: patch(:)
    PetscScalar, pointer :: unit(:)
    PetscInt :: first, last
    PetscErrorCode :: ierr
    integer :: i

    PetscCallA(VecGetOwnershipRange(self%unit, first, last, ierr))
    PetscCallA(GFB_VecGetArrayRead(self%unit, unit, ierr))
    call find_patches(self%foil, [(first + i - 1, i=1, self%foil%part%owned_unknowns)], unit, 1, patch)
    PetscCallA(GFB_VecRestoreArrayRead(self%unit, unit, ierr))
    call create_motions(patch, self%elastic, self%motions)
    self%has_motions = .true.
  end subroutine find_motions

  !> Moves every contact's linearisation point to where the strip is now.
  subroutine settle(self, state, moved)
    class(strip_system_type), intent(inout) :: self !! the strip
    Vec, intent(in) :: state !! scaled
    logical, intent(out) :: moved !! true: contacts may have
    real(wp) :: displacement(size(self%local_unit))

    call self%contact_displacements(state, displacement)
    call self%contacts%settle(displacement)
    self%settled = .not. any_rank(.not. self%contacts%settled)
    moved = .true.
  end subroutine settle

  !> A new Newton step begins where the contacts are.
  subroutine begin_step(self)
    class(strip_system_type), intent(inout) :: self !! the strip
    call self%contacts%drop_anchor()
  end subroutine begin_step

  !> Work of the residual forces along a step, scaled.
  real(wp) function virtual_work(self, residual, step) result(work)
    class(strip_system_type), intent(in) :: self !! the strip
    Vec, intent(in) :: residual, step !! scaled
    PetscScalar :: product
    PetscErrorCode :: ierr

    PetscCallA(VecDot(residual, step, product, ierr))
    work = product
  end function virtual_work

  !> Sets the share of the full load.
  subroutine set_factor(self, factor)
    class(strip_system_type), intent(inout) :: self !! the strip
    real(wp), intent(in) :: factor !! share of the full load [1]
    integer :: i

    self%factor = factor
    do i = 1, size(self%contacts%point)
      associate (point => self%contacts%point(i))
        if (point%pressed) point%pressing = max(0.0_wp, factor*self%crest_press(i))
        if (self%plate == plate_moved .and. point%law == contact_top) then
          point%gap = -(factor*self%plate_displacement - self%crest_gap(i))
        end if
      end associate
    end do
  end subroutine set_factor

  !> Ends a load step: friction carries its slip along.
  subroutine commit(self)
    class(strip_system_type), intent(inout) :: self !! the strip
    real(wp) :: displacement(size(self%local_unit))

    call self%contact_displacements(self%state, displacement)
    call self%contacts%commit(displacement)
  end subroutine commit

  !> Displacements of the contacts' unknowns [m].
  subroutine contact_displacements(self, state, displacement)
    class(strip_system_type), intent(in) :: self !! the strip
    Vec, intent(in) :: state !! scaled
    real(wp), intent(out) :: displacement(:) !! of each of the contacts' unknowns [m]

    call self%exchange%get(state, displacement)
    displacement = displacement*self%local_unit
  end subroutine contact_displacements

  !> Displacements and rotations of the foil's unknowns [m], [1]; the caller destroys the vector.
  subroutine foil_solution(self, solution)
    class(strip_system_type), intent(in) :: self !! the strip
    Vec, intent(out) :: solution !! of each of the foil's unknowns [m], [1]
    PetscErrorCode :: ierr

    PetscCallA(VecDuplicate(self%state, solution, ierr))
    PetscCallA(VecPointwiseMult(solution, self%state, self%unit, ierr))
  end subroutine foil_solution

  !> Displacement of the plate towards the sleeve [m]; zero without one. One whose force is given lies on
  !> the highest crest at rest.
  real(wp) function plate_travel(self) result(displacement)
    class(strip_system_type), intent(in) :: self !! the strip

    displacement = 0.0_wp
    if (self%plate == plate_moved) displacement = self%factor*self%plate_displacement
    if (self%plate /= plate_forced) return
    displacement = -(self%scale%length*sum(self%border%values(self%state)) - self%free_travel)
  end function plate_travel

  !> Energy of the foil's deformation [J].
  real(wp) function strain_energy(self) result(stored)
    class(strip_system_type), intent(in) :: self !! the strip
    PetscScalar :: product
    PetscErrorCode :: ierr

    PetscCallA(MatMult(self%elastic, self%state, self%work, ierr))
    PetscCallA(VecDot(self%state, self%work, product, ierr))
    stored = 0.5_wp*product*energy(self)
  end function strain_energy

  !> Relative error of the foil's stiffness against the present displacements: how far the energy
  !> that its matrix gives is from that of the strains. It is round-off, and large in thin foils
  !> alone.
  real(wp) function stiffness_round_off(self) result(error)
    class(strip_system_type), intent(in) :: self !! the strip
    type(error_type), allocatable :: degenerate
    real(wp) :: exact(1, 1)
    Vec :: solution
    PetscErrorCode :: ierr

    call self%foil_solution(solution)
    call strain_products(self%foil, [solution], exact, degenerate)
    PetscCallA(VecDestroy(solution, ierr))
    error = 0.0_wp
    if (exact(1, 1) > 0.0_wp) error = abs(2.0_wp*self%strain_energy()/exact(1, 1) - 1.0_wp)
  end function stiffness_round_off

  !> Frees what PETSc holds; may be called twice.
  subroutine destroy_strip_system(strip)
    type(strip_system_type), intent(inout) :: strip !! its vectors and matrices are freed
    PetscErrorCode :: ierr

    if (.not. strip%created) return
    call strip%exchange%destroy()
    if (strip%has_motions) then
      PetscCallA(MatDestroy(strip%motions, ierr))
    end if
    PetscCallA(MatDestroy(strip%jacobian, ierr))
    PetscCallA(MatDestroy(strip%elastic, ierr))
    PetscCallA(VecDestroy(strip%elastic_force, ierr))
    PetscCallA(VecDestroy(strip%last, ierr))
    PetscCallA(VecDestroy(strip%work, ierr))
    PetscCallA(VecDestroy(strip%unit, ierr))
    PetscCallA(VecDestroy(strip%full_load, ierr))
    PetscCallA(VecDestroy(strip%state, ierr))
    call destroy_foil_structure(strip%foil)
    strip%created = .false.
  end subroutine destroy_strip_system

  !> Order of a strip's state: node by node, then the plate. All ranks ask.
  function strip_order(strip) result(order)
    type(strip_system_type), intent(in) :: strip !! with its numbering
    type(natural_order_type) :: order

    order%number = strip%foil%natural_numbers()
    order%total = largest_number(order%number)
    if (strip%plate /= plate_forced) return
    order%total = order%total + 1
    if (this_rank() == rank_count() - 1) order%number = [order%number, order%total]
  end function strip_order
end module gfb_strip_system
