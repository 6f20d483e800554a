#include "gfb_petsc.h"
!> Rows that foils have in a bearing's matrix, and what their temperature makes of them.
!>
!> Where the modulus of foils follows their temperature, their elastic forces are those of the foils as they were built, times
!> a factor e of the top foil and one of the bumps. So a derivative by a temperature is a multiple of these forces,
!>
!> $$ f = e_t(T_m) f_t + e_b(T_m, T_b) f_b, \quad
!>    \frac{\partial f}{\partial T_m} = e_t' f_t + \frac{\partial e_b}{\partial T_m} f_b, \quad
!>    \frac{\partial f}{\partial T_b} = \frac{\partial e_b}{\partial T_b} f_b $$
!>
!> with the mean temperature of the pad's top foil and that of the sleeve, which are unknowns of the bearing. Springs under local
!> pressure have no equations: the gap follows them at once, see `gfb_film_heat`.
module gfb_foil_rows
  use petscmat
  use gfb_kinds, only: wp
  use gfb_petsc_kinds, only: pint
  use gfb_matrix_rows, only: copy_row
  use gfb_blocks, only: blocks_type, block_type, create_blocks
  use gfb_foil_model, only: foil_model_type
  use gfb_pad, only: pad_type
  use gfb_bearing_heat, only: film_heat_type, moduli_at
  implicit none (type)
  private
  public :: add_of_foil, create_bearing_motions, soften_foils, add_softness

contains

  !> Adds a matrix of a pad's foil, in its own numbers.
  subroutine add_of_foil(blocks, foil, pad, of_foil, factor, keeps_diagonal, matrix)
    type(blocks_type), intent(in) :: blocks !! of the bearing's unknowns
    class(foil_model_type), intent(in) :: foil !! of the pad
    integer, intent(in) :: pad !! its number
    Mat, intent(in) :: of_foil !! the same one for each pad
    real(wp), intent(in) :: factor(2) !! of the rows of top foil and bumps [1]
    logical, intent(in) :: keeps_diagonal !! also where it is zero
    Mat, intent(in) :: matrix !! like the bearing's
    PetscInt :: first, last, row, entries, number(maxval([0, foil%row_entries]))
    PetscInt, allocatable :: renumbered(:)
    PetscScalar :: value(size(number))
    PetscErrorCode :: ierr
    integer, allocatable :: kept(:)
    integer :: i

    associate (foil_block => 2*pad)
      PetscCallA(MatGetOwnershipRange(of_foil, first, last, ierr))
      do row = first, last - 1
        call copy_row(of_foil, row, entries, number, value)
        ! Membrane and bending of a condensed flat do not know each other either: exact zeros fill half of its block.
        kept = pack([(i, i=1, int(entries))], abs(value(:entries)) > 0.0_wp .or. (keeps_diagonal .and. number(:entries) == row))
        renumbered = [(int(blocks%global_number(foil_block, int(number(kept(i))) + 1), pint), i=1, size(kept))]
        PetscCallA(MatSetValues(matrix, 1_pint, [int(blocks%global_number(foil_block, int(row) + 1), pint)], size(kept, 1, pint), renumbered, merge(factor(1), factor(2), int(row - first) < foil%owned_top)*value(kept), ADD_VALUES, ierr))
      end do
    end associate
  end subroutine add_of_foil

  !> The coarse space of an iterative solver: foils move in patches, all else of a bearing on its own.
  subroutine create_bearing_motions(blocks, pads, matrix, motions, has)
    type(blocks_type), intent(in) :: blocks !! of the bearing's unknowns
    type(pad_type), intent(in) :: pads(:) !! equal ones
    Mat, intent(in) :: matrix !! the bearing's
    Mat, intent(out) :: motions !! (unknowns, motions)
    logical, intent(out) :: has !! there is one for such foils
    integer, parameter :: most = 64 !! entries of a row
    type(block_type) :: block(size(blocks%first) - 1)
    type(blocks_type) :: coarse
    Mat :: of_foil
    PetscInt :: first, last, before, row, entries, number(most), own_first, own_last
    PetscInt, allocatable :: room(:)
    PetscScalar :: value(most)
    PetscErrorCode :: ierr
    integer :: b, i

    call pads(1)%foil%create_coarse_motions(of_foil, has)
    if (.not. has) return
    PetscCallA(MatGetOwnershipRange(matrix, first, last, ierr))
    PetscCallA(MatGetOwnershipRange(of_foil, own_first, own_last, ierr))
    do b = 1, size(block)
      block(b)%owned = blocks%first_owned(b + 1) - blocks%first_owned(b)
      if (is_foil(b)) then
        PetscCallA(MatGetOwnershipRangeColumn(of_foil, before, row, ierr))
        block(b)%owned = int(row - before)
      end if
      allocate (block(b)%number(0))
    end do
    call create_blocks(block, blocks%border%scalars, coarse)
    PetscCallA(MatCreate(PETSC_COMM_WORLD, motions, ierr))
    PetscCallA(MatSetSizes(motions, last - first, int(coarse%border%owned, pint), PETSC_DETERMINE, PETSC_DETERMINE, ierr))
    PetscCallA(MatSetType(motions, MATAIJ, ierr))
    allocate (room(blocks%border%owned), source=1_pint)
    do b = 2, 2*size(pads), 2
      do row = own_first, own_last - 1
        call copy_row(of_foil, row, entries, number)
        room(blocks%first_owned(b) + row - own_first + 1) = entries
      end do
    end do
    PetscCallA(MatSeqAIJSetPreallocation(motions, 0_pint, room, ierr))
    PetscCallA(MatMPIAIJSetPreallocation(motions, 0_pint, room, 0_pint, room, ierr))
    PetscCallA(MatGetOwnershipRangeColumn(motions, before, row, ierr))
    do b = 1, size(blocks%first_owned)
      if (b <= size(block)) then
        if (is_foil(b)) cycle
      end if
      associate (begin => blocks%first_owned(b), shift => before + coarse%first_owned(b))
        do i = 1, merge(blocks%border%owned, blocks%first_owned(min(b + 1, size(blocks%first_owned))), b > size(block)) - begin
          PetscCallA(MatSetValue(motions, first + int(begin + i - 1, pint), shift + int(i - 1, pint), 1.0_wp, INSERT_VALUES, ierr))
        end do
      end associate
    end do
    do b = 2, 2*size(pads), 2
      do row = own_first, own_last - 1
        call copy_row(of_foil, row, entries, number, value)
        number(:entries) = [(int(coarse%global_number(b, int(number(i)) + 1), pint), i=1, int(entries))]
        PetscCallA(MatSetValues(motions, 1_pint, [first + int(blocks%first_owned(b), pint) + row - own_first], entries, number, value, INSERT_VALUES, ierr))
      end do
    end do
    PetscCallA(MatAssemblyBegin(motions, MAT_FINAL_ASSEMBLY, ierr))
    PetscCallA(MatAssemblyEnd(motions, MAT_FINAL_ASSEMBLY, ierr))
    PetscCallA(MatDestroy(of_foil, ierr))

  contains

    !> Whether a block is that of a pad's foil.
    pure logical function is_foil(number) result(is)
      integer, intent(in) :: number
      is = modulo(number, 2) == 0 .and. number <= 2*size(pads)
    end function is_foil
  end subroutine create_bearing_motions

  !> Gives all foils the moduli that they have at a state.
  subroutine soften_foils(heat, part, unknown, pads)
    type(film_heat_type), intent(in) :: heat !! of the bearing, or none
    real(wp), intent(in) :: part !! of what temperatures do [1]
    real(wp), intent(in) :: unknown(:) !! the bearing's local ones [SI]
    type(pad_type), intent(inout) :: pads(:) !! of the bearing
    real(wp) :: ratio(2), rate(2)
    integer :: i

    if (.not. heat%softens()) return
    do i = 1, size(pads)
      call moduli_at(heat, i, part, unknown, ratio, rate)
      call pads(i)%foil%soften(ratio)
    end do
  end subroutine soften_foils

  !> Adds what other moduli than those of the foils as they were built change in the matrix, and the columns of temperatures.
  subroutine add_softness(blocks, heat, pads, part, unknown, room, matrix)
    type(blocks_type), intent(in) :: blocks !! of the bearing's unknowns
    type(film_heat_type), intent(in) :: heat !! of the bearing, or none
    type(pad_type), intent(in) :: pads(:) !! whose foils have the moduli of this state
    real(wp), intent(in) :: part !! of what temperatures do [1]
    real(wp), intent(in) :: unknown(:) !! the bearing's local ones [SI]
    logical, intent(in) :: room !! zeros alone, where they stand; the state has no values then
    Mat, intent(in) :: matrix !! the bearing's, not scaled yet
    integer :: i

    do i = 1, size(pads)
      associate (foil => pads(i)%foil)
        if (foil%is_meshed() .and. .not. room .and. any(abs(foil%modulus - 1.0_wp) > 0.0_wp)) then
          call add_of_foil(blocks, foil, i, foil%elastic, foil%modulus - 1.0_wp, .false., matrix)
        end if
      end associate
      if (heat%softens()) call add_columns(blocks, heat, pads(i), i, part, unknown, room, matrix)
    end do
  end subroutine add_softness

  !> Columns of the temperatures that a pad's foils follow: of their own mean, and of the sleeve's for the bumps.
  subroutine add_columns(blocks, heat, pad, i, part, unknown, room, matrix)
    type(blocks_type), intent(in) :: blocks
    type(film_heat_type), intent(in) :: heat
    type(pad_type), intent(in) :: pad
    integer, intent(in) :: i !! its number
    real(wp), intent(in) :: part, unknown(:)
    logical, intent(in) :: room
    Mat, intent(in) :: matrix
    real(wp) :: rate(pad%last - pad%first, 2), ratio(2), by(2)
    PetscInt :: first, last, column(2)
    PetscErrorCode :: ierr
    integer :: k, own

    rate = 0.0_wp
    associate (global => blocks%global)
      if (.not. room) then
        call moduli_at(heat, i, part, unknown, ratio, by)
        call pad%foil%add_modulus_rates(unknown(pad%first + 1:pad%last), rate)
        rate = rate*spread(by, 1, size(rate, 1))
      end if
      column = int(global([heat%place_of_mean(i), heat%place_of_sleeve()]), pint)
      PetscCallA(MatGetOwnershipRange(matrix, first, last, ierr))
      own = 0
      do k = pad%foil%first + 1, size(rate, 1)
        associate (row => int(global(pad%first + k:pad%first + k), pint))
          if (row(1) < first .or. row(1) >= last) cycle
          own = own + 1
          ! the top foil does not follow the sleeve
          PetscCallA(MatSetValues(matrix, 1_pint, row, merge(1_pint, 2_pint, own <= pad%foil%owned_top), column, [sum(rate(k, :)), rate(k, 2)], ADD_VALUES, ierr))
        end associate
      end do
    end associate
  end subroutine add_columns
end module gfb_foil_rows
