#include "gfb_petsc.h"
!> Rigid motions that the supports of a structure leave free.
module gfb_free_motions
  use petscksp
  use gfb_kinds, only: wp
  use gfb_foil_structure, only: foil_structure_type
  use gfb_eigenmodes, only: modes_type, mass_products, solve_symmetric, combine
  use gfb_petsc_kinds, only: pint
  use gfb_petsc_session, only: sum_over_ranks, largest_over_ranks
  use gfb_shell_geometry, only: node_unknowns
  use gfb_rigid_modes, only: node_motions, rigid_motion_count
  implicit none (type)
  private
  public :: free_motions

  integer, parameter :: space = 3
  !> Squared part of a motion that supports prevent, over the largest, that is none: round-off [1].
  real(wp), parameter :: free_share = 1.0e-12_wp

contains

  !> Rigid motions of a structure that its supports leave free, at right angles in the mass and of
  !> unit modal mass; their eigenvalues are zero.
  subroutine free_motions(foil, mass, motions)
    type(foil_structure_type), intent(in) :: foil !! the structure
    Mat, intent(in) :: mass                 !! of the structure's free unknowns
    type(modes_type), intent(out) :: motions !! none where the supports leave none

    real(wp) :: fixed(rigid_motion_count, rigid_motion_count), unit(rigid_motion_count, rigid_motion_count)
    real(wp) :: size_of(rigid_motion_count), middle(space), length
    Vec :: plain(rigid_motion_count)
    PetscErrorCode :: ierr
    integer :: i, free

    call find_extent(foil, middle, length)
    fixed = supports_against(foil, middle, length)
    unit = 0.0_wp
    do i = 1, rigid_motion_count
      unit(i, i) = 1.0_wp
    end do
    call solve_symmetric(fixed, unit, size_of)
    free = count(size_of <= free_share*max(1.0_wp, maxval(size_of)))
    allocate (motions%shape(free))
    allocate (motions%eigenvalue(free), source=0.0_wp)
    do i = 1, free
      PetscCallA(MatCreateVecs(mass, motions%shape(i), PETSC_NULL_VEC, ierr))
      call fill_motion(foil, middle, length, fixed(:, i), motions%shape(i))
    end do
    if (free == 0) return
    unit(:free, :free) = mass_products(motions%shape, mass)
    fixed = 0.0_wp
    do i = 1, free
      fixed(i, i) = 1.0_wp
    end do
    call solve_symmetric(fixed(:free, :free), unit(:free, :free), size_of(:free))
    do i = 1, free
      PetscCallA(VecDuplicate(motions%shape(1), plain(i), ierr))
      PetscCallA(VecCopy(motions%shape(i), plain(i), ierr))
    end do
    call combine(fixed(:free, :free), plain(:free), motions%shape)
    do i = 1, free
      PetscCallA(VecDestroy(plain(i), ierr))
    end do
  end subroutine free_motions

  !> Middle and length of a structure.
  subroutine find_extent(foil, middle, length)
    type(foil_structure_type), intent(in) :: foil
    real(wp), intent(out) :: middle(space), length !! [m]
    real(wp) :: ends(2*space)

    associate (mine => foil%mesh%position(:, foil%part%mesh_node))
      ends(:space) = maxval(mine, 2)
      ends(space + 1:) = maxval(-mine, 2)
    end associate
    ends = largest_over_ranks(ends)
    middle = 0.5_wp*(ends(:space) - ends(space + 1:))
    length = maxval(ends(:space) + ends(space + 1:))
  end subroutine find_extent

  !> Sum over all supports of the products of the rigid motions that they prevent, without unit: turns
  !> are those that move the structure's end by a unit.
  function supports_against(foil, middle, length) result(fixed)
    type(foil_structure_type), intent(in) :: foil
    real(wp), intent(in) :: middle(space), length !! [m]
    real(wp) :: fixed(rigid_motion_count, rigid_motion_count)
    real(wp) :: motion(node_unknowns, rigid_motion_count)
    integer :: i, component

    fixed = 0.0_wp
    do i = 1, size(foil%part%mesh_node)
      if (.not. foil%part%owned(i)) cycle
      motion = node_motions(foil%mesh, foil%part%mesh_node(i), middle)
      motion(:, space + 1:) = motion(:, space + 1:)/length
      motion(space + 1:, :) = motion(space + 1:, :)*length
      do component = 1, node_unknowns
        if (foil%free(component, foil%part%mesh_node(i))) cycle
        fixed = fixed + spread(motion(component, :), 1, rigid_motion_count)* &
          spread(motion(component, :), 2, rigid_motion_count)
      end do
    end do
    fixed = reshape(sum_over_ranks(reshape(fixed, [size(fixed)])), shape(fixed))
  end function supports_against

  !> Unknowns of a rigid motion.
  subroutine fill_motion(foil, middle, length, weight, shape)
    type(foil_structure_type), intent(in) :: foil
    real(wp), intent(in) :: middle(space), length      !! [m]
    real(wp), intent(in) :: weight(rigid_motion_count) !! of displacements, and of turns over the length
    Vec, intent(in) :: shape
    real(wp) :: value(node_unknowns)
    PetscErrorCode :: ierr
    integer :: i, component, number

    PetscCallA(VecSet(shape, 0.0_wp, ierr))
    do i = 1, size(foil%part%mesh_node)
      if (.not. foil%part%owned(i)) cycle
      value = matmul(node_motions(foil%mesh, foil%part%mesh_node(i), middle), &
                     [weight(:space), weight(space + 1:)/length])
      do component = 1, node_unknowns
        number = foil%unknown(component, foil%part%mesh_node(i))
        if (number < 0) cycle
        PetscCallA(VecSetValue(shape, int(number, pint), value(component), INSERT_VALUES, ierr))
      end do
    end do
    PetscCallA(VecAssemblyBegin(shape, ierr))
    PetscCallA(VecAssemblyEnd(shape, ierr))
  end subroutine fill_motion
end module gfb_free_motions
