#include "gfb_petsc.h"
!> What a pad adds to the bearing's matrix, by local numbers.
module gfb_pad_matrix
  use petscmat
  use gfb_kinds, only: wp
  use gfb_petsc_kinds, only: pint
  use gfb_matrix_rows, only: copy_row
  use gfb_blocks, only: blocks_type
  use gfb_cost_events, only: cost_events_type
  use gfb_operating_point, only: operating_point_type
  use gfb_free_edge, only: free_edge_type
  use gfb_film_matrix, only: make_film_room, add_film_rows, add_shaft_weights
  use gfb_solid_rows, only: add_solid_rows
  use gfb_pad, only: pad_type
  implicit none (type)
  private
  public :: fill_pad_constant, fill_pad

contains

  !> Fills in what never changes, with room for everything else.
  subroutine fill_pad_constant(pad, blocks, foil_block, shaft, matrix)
    type(pad_type), intent(in) :: pad !! film and foil
    type(blocks_type), intent(in) :: blocks !! of unknowns
    integer, intent(in) :: foil_block !! the foil's among them
    integer, intent(in) :: shaft      !! local unknowns before e_x, or `no_shaft`
    Mat, intent(in) :: matrix !! of the bearing, by local numbers

    PetscInt :: first, last, row, entries, number(maxval([0, pad%foil%row_entries]))
    PetscInt, allocatable :: renumbered(:)
    PetscScalar :: value(size(number))
    PetscErrorCode :: ierr
    integer, allocatable :: kept(:)
    integer :: i

    PetscCallA(MatGetOwnershipRange(pad%foil%elastic, first, last, ierr))
    do row = first, last - 1
      call copy_row(pad%foil%elastic, row, entries, number, value)
      ! Membrane and bending of a condensed flat do not know each other either: exact zeros fill half of its block.
      kept = pack([(i, i=1, int(entries))], abs(value(:entries)) > 0.0_wp .or. number(:entries) == row)
      renumbered = [(int(blocks%global_number(foil_block, int(number(kept(i))) + 1), pint), i=1, size(kept))]
      PetscCallA(MatSetValues(matrix, 1_pint, [int(blocks%global_number(foil_block, int(row) + 1), pint)], size(kept, 1, pint), renumbered, value(kept), ADD_VALUES, ierr))
    end do
    call pad%foil%add_constant(matrix)
    call make_film_room(pad%film, pad%foil, shaft, pad%mesh%owned, matrix)
    call add_shaft_weights(pad%film, shaft, .false., 0.0_wp, matrix)
    call add_solid_rows(pad%contact, pad%film, pad%foil, shaft, .true., &
                        spread(pad%film%clearance, 1, size(pad%film%angle)), 0.0_wp, matrix)
  end subroutine fill_pad_constant

  !> Fills in the derivatives of film and foil, and of the pad's force.
  subroutine fill_pad(pad, point, unknown, gap, shaft, fixed, events, matrix)
    type(pad_type), intent(in) :: pad !! film and foil
    type(operating_point_type), intent(in) :: point !! with the shaft's position
    real(wp), intent(in) :: unknown(:) !! the pad's, in SI
    real(wp), intent(in) :: gap(:)     !! at this rank's nodes [m]
    integer, intent(in) :: shaft       !! local unknowns before e_x, or `no_shaft`
    logical, intent(in) :: fixed        !! the shaft is fixed
    type(cost_events_type), intent(in) :: events !! of PETSc's log
    Mat, intent(in) :: matrix !! of the bearing, by local numbers
    PetscErrorCode :: ierr

    PetscCallA(PetscLogEventBegin(events%film, ierr))
    call add_film_rows(pad%film, pad%foil, shaft, pad%mesh%owned, unknown(:size(gap)), gap, point, matrix)
    call add_shaft_weights(pad%film, shaft, fixed, 1.0_wp, matrix)
    call add_solid_rows(pad%contact, pad%film, pad%foil, shaft, fixed, gap, 1.0_wp, matrix)
    PetscCallA(PetscLogEventEnd(events%film, ierr))
    PetscCallA(PetscLogEventBegin(events%foil, ierr))
    call pad%foil%add_jacobian(unknown, matrix)
    if (abs(point%edge_tension(pad%number)) > 0.0_wp) call add_tension(pad%edge, point%edge_tension(pad%number), matrix)
    if (point%edge_hold(pad%number) > 0.0_wp) call add_hold(pad%edge, point%edge_hold(pad%number), matrix)
    PetscCallA(PetscLogEventEnd(events%foil, ierr))
  end subroutine fill_pad

  !> Adds the stiffness of the string along the free edge.
  subroutine add_tension(edge, tension, matrix)
    type(free_edge_type), intent(in) :: edge
    real(wp), intent(in) :: tension !! [N]
    Mat, intent(in) :: matrix
    integer :: pair, number(2)
    real(wp) :: block(2, 2)
    PetscErrorCode :: ierr

    do pair = 1, edge%pairs()
      call edge%tension_block(pair, tension, number, block)
      PetscCallA(MatSetValuesLocal(matrix, 2_pint, int(number - 1, pint), 2_pint, int(number - 1, pint), [block], ADD_VALUES, ierr))
    end do
  end subroutine add_tension

  !> Adds the stiffness of the springs that keep the free edge at a height.
  subroutine add_hold(edge, stiffness, matrix)
    type(free_edge_type), intent(in) :: edge
    real(wp), intent(in) :: stiffness !! of the whole width [N/m]
    Mat, intent(in) :: matrix
    PetscInt :: number(1)
    integer :: i
    PetscErrorCode :: ierr

    do i = 1, size(edge%unknown)
      number = int(edge%unknown(i) - 1, pint)
      PetscCallA(MatSetValuesLocal(matrix, 1_pint, number, 1_pint, number, [stiffness*edge%hold_stiffness(i)], ADD_VALUES, ierr))
    end do
  end subroutine add_hold
end module gfb_pad_matrix
