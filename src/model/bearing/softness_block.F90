#include "gfb_petsc.h"
!> What temperatures make of foils, as a block of a bearing's equations without unknowns of its own: it changes rows of the foils.
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
module gfb_softness_block
  use petscmat
  use gfb_kinds, only: wp
  use gfb_petsc_kinds, only: pint
  use gfb_blocks, only: blocks_type
  use gfb_pad, only: pad_type
  use gfb_operating_point, only: operating_point_type
  use gfb_bearing_heat, only: film_heat_type, moduli_at
  use gfb_foil_rows, only: add_of_foil
  use gfb_bearing, only: bearing_type, bearing_block_type, bearing_state_type
  implicit none (type)
  private
  public :: softness_block

contains

  !> The block of foils whose moduli follow temperatures, or stay what they were made.
  pure subroutine softness_block(block)
    type(bearing_block_type), intent(out) :: block !! of any bearing

    block%name = 'softness'
    block%take_state => soften_foils
    block%add_jacobian => add_softness
  end subroutine softness_block

  !> Gives all foils the moduli that they have at a state.
  subroutine soften_foils(bearing, point, unknown)
    class(bearing_type), intent(inout) :: bearing
    type(operating_point_type), intent(in) :: point
    real(wp), intent(in) :: unknown(:)
    real(wp) :: ratio(2), rate(2)
    integer :: i

    if (.not. bearing%heat%softens()) return
    do i = 1, size(bearing%pad)
      call moduli_at(bearing%heat, i, point%growth, unknown, ratio, rate)
      call bearing%pad(i)%foil%soften(ratio)
    end do
  end subroutine soften_foils

  !> Adds what other moduli than those of the foils as they were built change in the matrix, and the columns of temperatures.
  subroutine add_softness(bearing, state, room, matrix)
    class(bearing_type), intent(in) :: bearing
    type(bearing_state_type), intent(in) :: state
    logical, intent(in) :: room
    Mat, intent(in) :: matrix
    integer :: i

    do i = 1, size(bearing%pad)
      associate (foil => bearing%pad(i)%foil)
        if (foil%is_meshed() .and. .not. room .and. any(abs(foil%modulus - 1.0_wp) > 0.0_wp)) then
          call add_of_foil(bearing%blocks, foil, i, foil%elastic, foil%modulus - 1.0_wp, .false., matrix)
        end if
      end associate
      if (bearing%heat%softens()) then
        call add_columns(bearing%blocks, bearing%heat, bearing%pad(i), i, state%asked%growth, state%unknown, room, matrix)
      end if
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
end module gfb_softness_block
