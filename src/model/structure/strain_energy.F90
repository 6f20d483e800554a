#include "gfb_petsc.h"
!> Strain energy of a foil from strains, element by element.
!>
!> The stiffness matrix of a thin shell holds stretching and bending in the same numbers, and its
!> round-off is that of stretching. Energies from strains are free of it: displacements that are
!> rounded stretch an element by \( \epsilon u/l \), whose square is no matter.
module gfb_strain_energy
  use petscvec
  use gfb_kinds, only: wp
  use gfb_errors, only: error_type
  use gfb_petsc_kinds, only: pint
  use gfb_petsc_session, only: sum_over_ranks, share_failure
  use gfb_shell_geometry, only: shell_geometry_type, node_unknowns, shell_nodes, shell_unknowns
  use gfb_shell_element, only: shell_internal_force
  use gfb_foil_structure, only: foil_structure_type, element_geometry, element_section
  implicit none (type)
  private
  public :: strain_products

  integer, parameter :: space = 3

contains

  !> Work of the elastic forces of each motion on each motion.
  !>
  !> $$ a_{ij} = \sum_e \int \sigma(\phi_j) : \varepsilon(\phi_i) \, dV $$
  !>
  !> Fails where an element is clockwise or degenerate.
  subroutine strain_products(foil, motion, energy, error, force)
    type(foil_structure_type), intent(in) :: foil !! that is strained
    Vec, intent(in) :: motion(:)          !! of the numbered unknowns [m], [rad]
    real(wp), intent(out) :: energy(:, :) !! (motions, motions), symmetric [J]
    type(error_type), allocatable, intent(out) :: error !! error, if an element is degenerate
    Vec, intent(in), optional :: force(:) !! the elastic forces of each motion [N], [N m]

    real(wp), allocatable :: moved(:, :, :)
    real(wp) :: corner(shell_unknowns, size(motion)), on_corner(shell_unknowns, size(motion))
    type(shell_geometry_type) :: geometry
    integer :: i, k

    allocate (moved(node_unknowns, size(foil%part%mesh_node), size(motion)))
    do k = 1, size(motion)
      call foil%displacements(motion(k), moved(:, :, k))
    end do
    if (present(force)) call clear(force)
    energy = 0.0_wp
    do i = 1, size(foil%my_elements)
      associate (local => foil%local_node(foil%mesh%element_nodes(:, foil%my_elements(i))))
        geometry = element_geometry(foil%mesh, foil%my_elements(i))
        do k = 1, size(motion)
          corner(:, k) = without_mean(moved(:, local, k))
          call shell_internal_force(geometry, element_section(foil%mesh, foil%section, foil%my_elements(i)), &
                                    corner(:, k), on_corner(:, k), error)
          if (allocated(error)) exit
        end do
      end associate
      if (allocated(error)) exit
      energy = energy + matmul(transpose(corner), on_corner)
      if (present(force)) call add_forces(foil, foil%my_elements(i), on_corner, force)
    end do
    call share_failure(error)
    if (present(force)) call assemble(force)
    energy = reshape(sum_over_ranks(reshape(energy, [size(energy)])), shape(energy))
    energy = 0.5_wp*(energy + transpose(energy))
  end subroutine strain_products

  !> Sets vectors to zero, and makes them leave out what has no number.
  subroutine clear(force)
    Vec, intent(in) :: force(:)
    PetscErrorCode :: ierr
    integer :: k

    do k = 1, size(force)
      PetscCallA(VecSet(force(k), 0.0_wp, ierr))
      PetscCallA(VecSetOption(force(k), VEC_IGNORE_NEGATIVE_INDICES, PETSC_TRUE, ierr))
    end do
  end subroutine clear

  !> Ends what was added to vectors.
  subroutine assemble(force)
    Vec, intent(in) :: force(:)
    PetscErrorCode :: ierr
    integer :: k

    do k = 1, size(force)
      PetscCallA(VecAssemblyBegin(force(k), ierr))
      PetscCallA(VecAssemblyEnd(force(k), ierr))
    end do
  end subroutine assemble

  !> Adds an element's forces; those on supports are left out.
  subroutine add_forces(foil, element, on_corner, force)
    type(foil_structure_type), intent(in) :: foil
    integer, intent(in) :: element            !! of the whole mesh
    real(wp), intent(in) :: on_corner(:, :)   !! (20, motions) [N], [N m]
    Vec, intent(in) :: force(:)
    PetscInt :: number(shell_unknowns)
    PetscErrorCode :: ierr
    integer :: corner, component, k

    do corner = 1, shell_nodes
      do component = 1, node_unknowns
        number((corner - 1)*node_unknowns + component) = &
          int(foil%unknown(component, foil%mesh%element_nodes(corner, element)), pint)
      end do
    end do
    do k = 1, size(force)
      PetscCallA(VecSetValues(force(k), size(number, 1, pint), number, on_corner(:, k), ADD_VALUES, ierr))
    end do
  end subroutine add_forces

  !> An element's displacements without the displacement of all its nodes, which strains nothing but
  !> costs digits.
  pure function without_mean(moved) result(displacement)
    real(wp), intent(in) :: moved(node_unknowns, shell_nodes) !! [m], [rad]
    real(wp) :: displacement(shell_unknowns)
    real(wp) :: local(node_unknowns, shell_nodes)

    local = moved
    local(:space, :) = local(:space, :) - spread(sum(local(:space, :), 2)/shell_nodes, 2, shell_nodes)
    displacement = reshape(local, [shell_unknowns])
  end function without_mean
end module gfb_strain_energy
