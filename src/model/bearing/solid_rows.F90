#include "gfb_petsc.h"
!> What the shaft's asperities add to the matrix: their pressure follows the gap.
!>
!> The asperities' pressure \( p_c(h) \) loads shaft and foil as the film's does, so their equations
!> depend on what moves the foil, and on the shaft. The film's own equations do not know of it.
module gfb_solid_rows
  use petscmat
  use gfb_kinds, only: wp
  use gfb_petsc_kinds, only: pint
  use gfb_gas_film, only: gas_film_type
  use gfb_solid_contact, only: solid_contact_type, contact_pressure_rate
  use gfb_foil_model, only: foil_model_type
  use gfb_film_load, only: acts_on
  use gfb_shaft_motion, only: no_shaft
  implicit none (type)
  private
  public :: add_solid_rows

contains

  !> Adds their rows of shaft and foil; none where nothing touches.
  subroutine add_solid_rows(contact, film, foil, shaft, fixed, gap, factor, matrix)
    type(solid_contact_type), intent(in) :: contact !! asperities of shaft and foil
    type(gas_film_type), intent(in) :: film !! this rank's share of it
    class(foil_model_type), intent(in) :: foil !! under the film
    integer, intent(in) :: shaft    !! local unknowns before e_x, or `no_shaft`
    logical, intent(in) :: fixed     !! the shaft's equations are its position's
    real(wp), intent(in) :: gap(:)  !! at this rank's nodes [m]
    real(wp), intent(in) :: factor  !! of the derivatives; 0: makes room [1]
    Mat, intent(in) :: matrix !! of the bearing, by local numbers

    integer :: column(film%coordinates + 1, size(gap)) ! local numbers, from 0: of the foil, of the shaft
    real(wp) :: slope(film%coordinates + 1, size(gap)), rate(size(gap))
    integer :: i

    if (.not. contact%present) return
    rate = factor*contact_pressure_rate(contact, gap)
    column(1, :) = foil%source - 1
    slope(1, :) = rate*foil%rate
    column(2:, :) = -1
    do i = 1, film%coordinates
      if (shaft /= no_shaft) column(1 + i, :) = shaft + i - 1
      slope(1 + i, :) = rate*film%motion(i, :)
    end do
    if (shaft /= no_shaft) call add_to_shaft(film, shaft, fixed, column, slope, matrix)
    call foil%add_load_rates(column, slope, matrix)
  end subroutine add_solid_rows

  !> The shaft's rows: weights of the pressures in the force, times their slopes; zeros keep the
  !> pattern where the shaft is fixed.
  subroutine add_to_shaft(film, shaft, fixed, column, slope, matrix)
    type(gas_film_type), intent(in) :: film
    integer, intent(in) :: shaft        !! local unknowns before e_x
    logical, intent(in) :: fixed
    integer, intent(in) :: column(:, :) !! (3 or 5, nodes) local numbers, from 0
    real(wp), intent(in) :: slope(:, :) !! (3 or 5, nodes) of the pressure by them
    Mat, intent(in) :: matrix

    ! a row of the matrix in each column, as PETSc reads it
    real(wp) :: block(size(column, 1), film%coordinates)
    PetscInt :: row(film%coordinates)
    integer :: node, i
    PetscErrorCode :: ierr

    row = [(int(shaft + i - 1, pint), i=1, film%coordinates)]
    block = 0.0_wp
    do node = 1, size(column, 2)
      if (.not. fixed) then
        do i = 1, film%coordinates
          block(:, i) = acts_on(i)*film%force_weight(i, node)*slope(:, node)
        end do
      end if
      PetscCallA(MatSetValuesLocal(matrix, int(size(row), pint), row, int(size(column, 1), pint), int(column(:, node), pint), [block], ADD_VALUES, ierr))
    end do
  end subroutine add_to_shaft
end module gfb_solid_rows
