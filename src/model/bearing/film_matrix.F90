#include "gfb_petsc.h"
!> The film's and the shaft's rows of the bearing's matrix, by local numbers.
module gfb_film_matrix
  use petscmat
  use gfb_kinds, only: wp
  use gfb_petsc_kinds, only: pint
  use gfb_gas_film, only: gas_film_type
  use gfb_foil_model, only: foil_model_type
  use gfb_operating_point, only: operating_point_type
  use gfb_film_load, only: acts_on
  implicit none (type)
  private
  public :: add_film_rows, add_shaft_weights, add_shaft_stiffness, make_film_room, element_columns, add_block

  !> The shaft's unknowns among the local numbers by which a pad fills the matrix; none where it is fixed for good.
  type, public :: shaft_unknowns_type
    integer :: before = 0                 !! numbers before theirs
    integer, allocatable :: coordinate(:) !! of the shaft, which they are
  contains
    procedure :: numbers
  end type shaft_unknowns_type

contains

  !> Their numbers, from 0.
  pure function numbers(self)
    class(shaft_unknowns_type), intent(in) :: self !! the shaft's unknowns
    PetscInt :: numbers(size(self%coordinate))
    integer :: i
    numbers = [(int(self%before + i, pint), i=0, size(numbers) - 1)]
  end function numbers

  !> Film rows: pressures, what moves the foil, and the shaft.
  subroutine add_film_rows(film, foil, shaft, owned, pressure, gap, point, matrix)
    type(gas_film_type), intent(in) :: film !! this rank's share of it
    class(foil_model_type), intent(in) :: foil !! under the film
    type(shaft_unknowns_type), intent(in) :: shaft !! its unknowns
    logical, intent(in) :: owned(:)     !! nodes that are this rank's
    real(wp), intent(in) :: pressure(:) !! at this rank's nodes [Pa]
    real(wp), intent(in) :: gap(:)      !! at this rank's nodes [m]
    type(operating_point_type), intent(in) :: point !! operating point
    Mat, intent(in) :: matrix !! of the bearing, by local numbers

    real(wp), dimension(size(film%shape, 1), size(film%shape, 1)) :: by_pressure, by_gap
    real(wp) :: by_shaft(size(film%shape, 1), size(shaft%coordinate))
    ! a row of the matrix in each column, as PETSc reads it
    real(wp) :: block(2*size(film%shape, 1) + size(shaft%coordinate), size(film%shape, 1))
    PetscInt :: row(size(film%shape, 1)), column(2*size(film%shape, 1) + size(shaft%coordinate))
    integer :: element, b, node, film_nodes

    film_nodes = size(film%shape, 1)
    do element = 1, size(film%element_nodes, 2)
      call element_columns(film, foil, shaft, element, row, column)
      associate (nodes => film%element_nodes(:, element))
        call film%element_jacobian(element, pressure, gap, point, shaft%coordinate, by_pressure, by_gap, by_shaft)
        block = 0.0_wp
        block(:film_nodes, :) = transpose(by_pressure)
        do b = 1, film_nodes
          node = merge(b, film_nodes + b, foil%source(nodes(b)) == nodes(b))
          block(node, :) = block(node, :) + foil%rate(nodes(b))*by_gap(:, b)
        end do
        block(2*film_nodes + 1:, :) = transpose(by_shaft)
      end associate
      call add_block(matrix, row, column, block)
    end do
    do node = 1, size(gap)
      if (.not. (film%fixed(node) .and. owned(node))) cycle
      row(1) = node - 1
      call add_block(matrix, row(1:1), row(1:1), [1.0_wp])
    end do
  end subroutine add_film_rows

  !> Shaft rows: weights of the pressures in the force; zeros keep the pattern where the shaft is fixed.
  subroutine add_shaft_weights(film, shaft, fixed, factor, matrix)
    type(gas_film_type), intent(in) :: film !! this rank's share of it
    type(shaft_unknowns_type), intent(in) :: shaft !! its unknowns
    logical, intent(in) :: fixed    !! the shaft is fixed
    real(wp), intent(in) :: factor !! of the weights; 0: makes room [1]
    Mat, intent(in) :: matrix !! of the bearing, by local numbers

    PetscInt, allocatable :: column(:)
    real(wp), allocatable :: weight(:, :)
    integer :: i

    if (size(shaft%coordinate) == 0) return
    column = [(int(i - 1, pint), i=1, size(film%force_weight, 2))]
    allocate (weight(size(column), size(shaft%coordinate)), source=0.0_wp)
    do i = 1, merge(0, size(shaft%coordinate), fixed)
      weight(:, i) = acts_on(shaft%coordinate(i))*film%force_weight(shaft%coordinate(i), :)
    end do
    call add_block(matrix, shaft%numbers(), column, factor*weight)
  end subroutine add_shaft_weights

  !> Shaft rows: what keeps the shaft where it is fixed; 0 keeps the pattern where it floats. The rank
  !> that owns these rows asks.
  subroutine add_shaft_stiffness(shaft, stiffness, matrix)
    type(shaft_unknowns_type), intent(in) :: shaft !! its unknowns
    real(wp), intent(in) :: stiffness(:, :) !! forces over coordinates [N/m], [N m/rad]
    Mat, intent(in) :: matrix !! of the bearing, by local numbers

    call add_block(matrix, shaft%numbers(), shaft%numbers(), transpose(stiffness))
  end subroutine add_shaft_stiffness

  !> Makes room for what the film's rows will hold.
  subroutine make_film_room(film, foil, shaft, owned, matrix)
    type(gas_film_type), intent(in) :: film !! this rank's share of it
    class(foil_model_type), intent(in) :: foil !! under the film
    type(shaft_unknowns_type), intent(in) :: shaft !! its unknowns
    logical, intent(in) :: owned(:) !! nodes that are this rank's
    Mat, intent(in) :: matrix !! of the bearing, by local numbers

    PetscInt :: row(size(film%shape, 1)), column(2*size(film%shape, 1) + size(shaft%coordinate))
    real(wp) :: zero(size(column), size(row))
    integer :: element, node

    zero = 0.0_wp
    do element = 1, size(film%element_nodes, 2)
      call element_columns(film, foil, shaft, element, row, column)
      call add_block(matrix, row, column, zero)
    end do
    do node = 1, size(owned)
      row(1) = node - 1
      if (owned(node)) call add_block(matrix, row(1:1), row(1:1), [0.0_wp])
    end do
  end subroutine make_film_room

  !> Local numbers, from 0, of a film element's equations, and of what they depend on: pressures,
  !> what moves the foil, the shaft; -1 where there is none of its own.
  pure subroutine element_columns(film, foil, shaft, element, row, column)
    type(gas_film_type), intent(in) :: film !! this rank's share of it
    class(foil_model_type), intent(in) :: foil !! under the film
    type(shaft_unknowns_type), intent(in) :: shaft !! its unknowns
    integer, intent(in) :: element !! of this rank
    PetscInt, intent(out) :: row(:)    !! (nodes)
    PetscInt, intent(out) :: column(:) !! (2 nodes + shaft)
    integer :: b, film_nodes

    film_nodes = size(row)
    column = -1 ! PETSc skips negative numbers
    column(2*film_nodes + 1:) = shaft%numbers()
    associate (nodes => film%element_nodes(:, element))
      row = int(merge(-1, nodes - 1, film%fixed(nodes)), pint)
      column(:film_nodes) = int(nodes - 1, pint)
      do b = 1, film_nodes
        if (foil%source(nodes(b)) == nodes(b)) cycle ! the pressure itself
        column(film_nodes + b) = int(foil%source(nodes(b)) - 1, pint)
      end do
    end associate
  end subroutine element_columns

  !> Adds a block to the matrix by local numbers, from 0; negative ones are skipped.
  subroutine add_block(matrix, row, column, block)
    Mat, intent(in) :: matrix !! by local numbers
    PetscInt, intent(in) :: row(:), column(:) !! local numbers
    real(wp), intent(in) :: block(size(column)*size(row)) !! one row after the other [SI]
    PetscErrorCode :: ierr

    PetscCallA(MatSetValuesLocal(matrix, int(size(row), pint), row, int(size(column), pint), column, block, ADD_VALUES, ierr))
  end subroutine add_block
end module gfb_film_matrix
