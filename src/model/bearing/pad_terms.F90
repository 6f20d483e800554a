#include "gfb_petsc.h"
!> The terms of a pad's equations: film, asperities, foil, and what holds the free edge of its top foil.
!>
!> A term says what it adds to the residual, to the matrix, to what of the matrix never changes, and to the derivative by
!> one of the shaft's coordinates. Whoever assembles a bearing goes through the list: a new kind of equations is a row of
!> `pad_terms` and the procedures it names.
!>
!> The asperities' pressure \( p_c(h) \) loads shaft and foil as the film's does, so their equations depend on what moves
!> the foil, and on the shaft. The film's own equations do not know of it.
module gfb_pad_terms
  use petscmat
  use gfb_kinds, only: wp
  use gfb_petsc_kinds, only: pint
  use gfb_gas_film, only: gas_film_type
  use gfb_foil_model, only: foil_model_type
  use gfb_operating_point, only: operating_point_type
  use gfb_film_load, only: acts_on, film_forces
  use gfb_pad, only: pad_type
  implicit none (type)
  private
  public :: pad_terms, add_shaft_stiffness, element_columns, add_block

  !> The shaft's unknowns among the local numbers by which a pad fills the matrix; none where it is fixed for good.
  type, public :: shaft_unknowns_type
    integer :: before = 0                 !! numbers before theirs
    integer, allocatable :: coordinate(:) !! of the shaft, which they are
  contains
    procedure :: numbers
  end type shaft_unknowns_type

  !> Temperatures of walls that move the gap, among the numbers by which a pad fills the matrix; none where nothing grows.
  type, public :: growth_unknowns_type
    integer, allocatable :: number(:, :) !! (walls of a node, nodes) local numbers, from 0
    real(wp), allocatable :: rate(:)     !! (walls of a node) of the gap by them [m/K]
  end type growth_unknowns_type

  !> What a pad's equations depend on beside the pad.
  type, public :: pad_state_type
    type(operating_point_type) :: point  !! with the shaft's position
    real(wp), allocatable :: unknown(:)  !! the pad's, in SI
    real(wp), allocatable :: gap(:)      !! at this rank's nodes [m]
    type(shaft_unknowns_type) :: shaft   !! its unknowns
    type(growth_unknowns_type) :: growth !! of shaft and sleeve
    logical :: fixed = .false.           !! the shaft's equations are its place's
  end type pad_state_type

  !> A term; what it leaves out it does not add to.
  type, public :: term_type
    logical :: of_film = .false. !! PETSc's log counts it as the film's, else as the foil's
    procedure(residual_term), pointer, nopass :: add_residual => null()
    procedure(matrix_term), pointer, nopass :: add_jacobian => null()
    procedure(matrix_term), pointer, nopass :: add_constant => null() !! with room for all that changes; the state has no values
    procedure(column_term), pointer, nopass :: add_column => null()
  end type term_type

  abstract interface
    !> Adds to a pad's residual; its film must be open.
    subroutine residual_term(pad, state, residual)
      import :: pad_type, pad_state_type, wp
      implicit none (type, external)
      type(pad_type), intent(in) :: pad !! film and foil
      type(pad_state_type), intent(in) :: state !! unknowns and shaft
      real(wp), intent(inout) :: residual(:) !! the pad's, in SI
    end subroutine residual_term

    !> Adds to the bearing's matrix, by the pad's local numbers.
    subroutine matrix_term(pad, state, matrix)
      import :: pad_type, pad_state_type, tMat
      implicit none (type, external)
      type(pad_type), intent(in) :: pad !! film and foil
      type(pad_state_type), intent(in) :: state !! unknowns and shaft
      Mat, intent(in) :: matrix !! of the bearing
    end subroutine matrix_term

    !> Adds to the derivative by one of the shaft's coordinates, the unknowns staying.
    subroutine column_term(pad, state, coordinate, column, of_shaft)
      import :: pad_type, pad_state_type, wp
      implicit none (type, external)
      type(pad_type), intent(in) :: pad !! film and foil
      type(pad_state_type), intent(in) :: state !! unknowns and shaft
      integer, intent(in) :: coordinate !! see `shaft_coordinates`
      real(wp), intent(inout) :: column(:)   !! of the pad's equations [SI]
      real(wp), intent(inout) :: of_shaft(:) !! of the shaft's [SI]
    end subroutine column_term
  end interface

contains

  !> All terms, in the order in which they are added.
  function pad_terms(with_film) result(list)
    logical, intent(in) :: with_film !! false: another block of the bearing's equations has the films' own
    type(term_type) :: list(5)

    if (with_film) list(1) = term_type(.true., film_residual, film_jacobian, film_room, film_column)
    list(2) = term_type(.true., null(), force_jacobian, force_room, null())
    list(3) = term_type(.true., null(), asperity_jacobian, asperity_room, asperity_column)
    list(4) = term_type(.false., foil_residual, foil_jacobian, foil_constant, null())
    list(5) = term_type(.false., edge_residual, edge_jacobian, null(), null())
  end function pad_terms

  !> Their numbers, from 0.
  pure function numbers(self)
    class(shaft_unknowns_type), intent(in) :: self !! the shaft's unknowns
    PetscInt :: numbers(size(self%coordinate))
    integer :: i
    numbers = [(int(self%before + i, pint), i=0, size(numbers) - 1)]
  end function numbers

  !> The film's equations; at fixed nodes their pressure is the ambient one.
  subroutine film_residual(pad, state, residual)
    type(pad_type), intent(in) :: pad
    type(pad_state_type), intent(in) :: state
    real(wp), intent(inout) :: residual(:)

    associate (nodes => size(state%gap))
      call pad%film%add_residual(state%unknown(:nodes), state%gap, state%point, residual)
      where (pad%film%fixed .and. pad%mesh%owned)
        residual(:nodes) = state%unknown(:nodes) - pad%film%ambient_pressure
      end where
    end associate
  end subroutine film_residual

  !> Film rows: pressures, what moves the foil, and the shaft.
  subroutine film_jacobian(pad, state, matrix)
    type(pad_type), intent(in) :: pad
    type(pad_state_type), intent(in) :: state
    Mat, intent(in) :: matrix

    real(wp), dimension(size(pad%film%shape, 1), size(pad%film%shape, 1)) :: by_pressure, by_gap
    real(wp) :: by_shaft(size(pad%film%shape, 1), size(state%shaft%coordinate))
    ! a row of the matrix in each column, as PETSc reads it
    real(wp) :: block(2*size(by_gap, 1) + size(by_shaft, 2), size(by_gap, 1)), softness(size(by_gap, 1))
    PetscInt :: row(size(block, 2)), column(size(block, 1))
    integer :: element, b, node, film_nodes

    film_nodes = size(row)
    associate (film => pad%film, foil => pad%foil)
      do element = 1, size(film%element_nodes, 2)
        call element_columns(film, foil, state%shaft, element, row, column)
        associate (nodes => film%element_nodes(:, element))
          call film%element_jacobian(element, state%unknown(:size(state%gap)), state%gap, state%point, state%shaft%coordinate, &
                                     by_pressure, by_gap, by_shaft)
          block = 0.0_wp
          block(:film_nodes, :) = transpose(by_pressure)
          softness = film%softness_of(element)
          do b = 1, film_nodes
            node = merge(b, film_nodes + b, foil%source(nodes(b)) == nodes(b))
            block(node, :) = block(node, :) + (foil%rate(nodes(b)) + softness(b))*by_gap(:, b)
          end do
          block(2*film_nodes + 1:, :) = transpose(by_shaft)
        end associate
        call add_block(matrix, row, column, block)
      end do
      do node = 1, size(state%gap)
        if (.not. (film%fixed(node) .and. pad%mesh%owned(node))) cycle
        row(1) = node - 1
        call add_block(matrix, row(1:1), row(1:1), [1.0_wp])
      end do
    end associate
  end subroutine film_jacobian

  !> Room for these rows.
  subroutine film_room(pad, state, matrix)
    type(pad_type), intent(in) :: pad
    type(pad_state_type), intent(in) :: state
    Mat, intent(in) :: matrix

    PetscInt :: row(size(pad%film%shape, 1)), column(2*size(pad%film%shape, 1) + size(state%shaft%coordinate))
    real(wp) :: zero(size(column), size(row))
    integer :: element, node

    zero = 0.0_wp
    do element = 1, size(pad%film%element_nodes, 2)
      call element_columns(pad%film, pad%foil, state%shaft, element, row, column)
      call add_block(matrix, row, column, zero)
    end do
    do node = 1, size(pad%mesh%owned)
      row(1) = node - 1
      if (pad%mesh%owned(node)) call add_block(matrix, row(1:1), row(1:1), [0.0_wp])
    end do
  end subroutine film_room

  !> Shaft rows: weights of the pressures.
  subroutine force_jacobian(pad, state, matrix)
    type(pad_type), intent(in) :: pad
    type(pad_state_type), intent(in) :: state
    Mat, intent(in) :: matrix
    call add_shaft_weights(pad%film, state%shaft, state%fixed, 1.0_wp, matrix)
  end subroutine force_jacobian

  !> Room for them.
  subroutine force_room(pad, state, matrix)
    type(pad_type), intent(in) :: pad
    type(pad_state_type), intent(in) :: state
    Mat, intent(in) :: matrix
    call add_shaft_weights(pad%film, state%shaft, .false., 0.0_wp, matrix)
  end subroutine force_room

  !> The film by the rigid gap.
  subroutine film_column(pad, state, coordinate, column, of_shaft)
    type(pad_type), intent(in) :: pad
    type(pad_state_type), intent(in) :: state
    integer, intent(in) :: coordinate
    real(wp), intent(inout) :: column(:), of_shaft(:)
    call pad%film%add_shaft_column(state%unknown(:size(state%gap)), state%gap, state%point, coordinate, column)
  end subroutine film_column

  !> Shaft rows: weights of the pressures in the force; zeros keep the pattern where the shaft is fixed.
  subroutine add_shaft_weights(film, shaft, fixed, factor, matrix)
    type(gas_film_type), intent(in) :: film
    type(shaft_unknowns_type), intent(in) :: shaft
    logical, intent(in) :: fixed
    real(wp), intent(in) :: factor !! of the weights; 0: makes room [1]
    Mat, intent(in) :: matrix

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

  !> Rows of shaft and foil that follow the asperities' pressure.
  subroutine asperity_jacobian(pad, state, matrix)
    type(pad_type), intent(in) :: pad
    type(pad_state_type), intent(in) :: state
    Mat, intent(in) :: matrix
    call add_solid_rows(pad, state, state%fixed, pad%solid_rate(state%gap), matrix)
  end subroutine asperity_jacobian

  !> Room for them.
  subroutine asperity_room(pad, state, matrix)
    type(pad_type), intent(in) :: pad
    type(pad_state_type), intent(in) :: state
    Mat, intent(in) :: matrix
    call add_solid_rows(pad, state, .true., spread(0.0_wp, 1, size(pad%film%angle)), matrix)
  end subroutine asperity_room

  !> Adds their rows of shaft and foil; none where nothing touches.
  subroutine add_solid_rows(pad, state, fixed, rate, matrix)
    type(pad_type), intent(in) :: pad
    type(pad_state_type), intent(in) :: state
    logical, intent(in) :: fixed
    real(wp), intent(in) :: rate(:) !! of the pressure by the gap, at the pad's nodes [Pa/m]
    Mat, intent(in) :: matrix

    integer :: column(size(state%shaft%coordinate) + 1 + size(state%growth%rate), size(rate)) ! local numbers, from 0: foil, shaft, walls
    real(wp) :: slope(size(column, 1), size(rate)) ! of the pressure by them

    if (.not. pad%contact%present) return
    associate (shaft => state%shaft, last => size(state%shaft%coordinate) + 1)
      column(1, :) = pad%foil%source - 1
      slope(1, :) = rate*pad%foil%rate
      column(2:last, :) = spread(int(shaft%numbers()), 2, size(rate))
      slope(2:last, :) = spread(rate, 1, size(shaft%coordinate))*pad%film%motion(shaft%coordinate, :)
      column(last + 1:, :) = state%growth%number
      slope(last + 1:, :) = spread(state%growth%rate, 2, size(rate))*spread(rate, 1, size(state%growth%rate))
      call add_to_shaft(pad%film, shaft, fixed, column, slope, matrix)
    end associate
    call pad%foil%add_load_rates(column, slope, matrix)
  end subroutine add_solid_rows

  !> The shaft's rows: weights of the pressures in the force, times their slopes; zeros keep the
  !> pattern where the shaft is fixed.
  subroutine add_to_shaft(film, shaft, fixed, column, slope, matrix)
    type(gas_film_type), intent(in) :: film
    type(shaft_unknowns_type), intent(in) :: shaft
    logical, intent(in) :: fixed
    integer, intent(in) :: column(:, :) !! (unknowns of a node, nodes) local numbers, from 0
    real(wp), intent(in) :: slope(:, :) !! (unknowns of a node, nodes) of the pressure by them
    Mat, intent(in) :: matrix

    ! a row of the matrix in each column, as PETSc reads it
    real(wp) :: block(size(column, 1), size(shaft%coordinate))
    integer :: node, i

    block = 0.0_wp
    do node = 1, merge(size(column, 2), 0, size(shaft%coordinate) > 0)
      do i = 1, merge(0, size(shaft%coordinate), fixed)
        block(:, i) = acts_on(shaft%coordinate(i))*film%force_weight(shaft%coordinate(i), node)*slope(:, node)
      end do
      call add_block(matrix, shaft%numbers(), int(column(:, node), pint), block)
    end do
  end subroutine add_to_shaft

  !> The asperities' pressure follows the gap, and loads foil and shaft. The foil's equations are linear
  !> in what loads it: their difference over any step is their derivative.
  subroutine asperity_column(pad, state, coordinate, column, of_shaft)
    type(pad_type), intent(in) :: pad
    type(pad_state_type), intent(in) :: state
    integer, intent(in) :: coordinate
    real(wp), intent(inout) :: column(:), of_shaft(:)

    real(wp) :: rate(size(state%gap)), step, force(film_forces)
    real(wp), dimension(size(state%unknown)) :: loading, before, after

    if (.not. pad%contact%present) return
    associate (nodes => size(state%gap))
      rate = pad%solid_rate(state%gap)*pad%film%motion(coordinate, :)
      step = pad%film%ambient_pressure/max(maxval(abs(rate)), tiny(1.0_wp))
      loading = state%unknown
      loading(:nodes) = state%unknown(:nodes) + pad%solid_pressure(state%gap)
      before = 0.0_wp
      call pad%foil%add_residual(loading, before)
      loading(:nodes) = loading(:nodes) + step*rate
      after = 0.0_wp
      call pad%foil%add_residual(loading, after)
      column = column + (after - before)/step
    end associate
    if (state%fixed) return
    force = acts_on*pad%film%force(pad%film%ambient_pressure + rate)
    of_shaft = of_shaft + force(state%shaft%coordinate)
  end subroutine asperity_column

  !> The foil under all pressure that loads it: that of film and asperities less that of the gas below.
  subroutine foil_residual(pad, state, residual)
    type(pad_type), intent(in) :: pad
    type(pad_state_type), intent(in) :: state
    real(wp), intent(inout) :: residual(:)
    real(wp) :: loading(size(state%unknown)) ! the unknowns, with that pressure

    loading = state%unknown
    loading(:size(state%gap)) = pad%loading(state%unknown, state%gap) - state%point%supply*pad%pressure_below
    call pad%foil%add_residual(loading, residual)
  end subroutine foil_residual

  !> The foil's derivatives.
  subroutine foil_jacobian(pad, state, matrix)
    type(pad_type), intent(in) :: pad
    type(pad_state_type), intent(in) :: state
    Mat, intent(in) :: matrix
    call pad%foil%add_jacobian(state%unknown, matrix)
  end subroutine foil_jacobian

  !> What of them never changes, beside its elastic matrix.
  subroutine foil_constant(pad, state, matrix)
    type(pad_type), intent(in) :: pad
    type(pad_state_type), intent(in) :: state
    Mat, intent(in) :: matrix
    call pad%foil%add_constant(matrix)
  end subroutine foil_constant

  !> Pull, string and springs at the free edge.
  subroutine edge_residual(pad, state, residual)
    type(pad_type), intent(in) :: pad
    type(pad_state_type), intent(in) :: state
    real(wp), intent(inout) :: residual(:)

    associate (edge => pad%edge, point => state%point, number => pad%number)
      call edge%add_pull(point%edge_pull(number), residual)
      call edge%add_tension(point%edge_tension(number), state%unknown, residual)
      call edge%add_hold(point%edge_hold(number), point%edge_height(number), state%unknown, residual)
    end associate
  end subroutine edge_residual

  !> Stiffness of the string along the free edge, and of the springs that keep it at a height.
  subroutine edge_jacobian(pad, state, matrix)
    type(pad_type), intent(in) :: pad
    type(pad_state_type), intent(in) :: state
    Mat, intent(in) :: matrix
    integer :: i, number(2)
    real(wp) :: block(2, 2)

    associate (edge => pad%edge, tension => state%point%edge_tension(pad%number), hold => state%point%edge_hold(pad%number))
      do i = 1, merge(edge%pairs(), 0, abs(tension) > 0.0_wp)
        call edge%tension_block(i, tension, number, block)
        call add_block(matrix, int(number - 1, pint), int(number - 1, pint), block)
      end do
      do i = 1, merge(size(edge%unknown), 0, hold > 0.0_wp)
        call add_block(matrix, [int(edge%unknown(i) - 1, pint)], [int(edge%unknown(i) - 1, pint)], [hold*edge%hold_stiffness(i)])
      end do
    end associate
  end subroutine edge_jacobian

  !> Shaft rows: what keeps the shaft where it is fixed; 0 keeps the pattern where it floats. The rank
  !> that owns these rows asks.
  subroutine add_shaft_stiffness(shaft, stiffness, matrix)
    type(shaft_unknowns_type), intent(in) :: shaft !! its unknowns
    real(wp), intent(in) :: stiffness(:, :) !! forces over coordinates [N/m], [N m/rad]
    Mat, intent(in) :: matrix !! of the bearing, by local numbers
    call add_block(matrix, shaft%numbers(), shaft%numbers(), transpose(stiffness))
  end subroutine add_shaft_stiffness

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
end module gfb_pad_terms
