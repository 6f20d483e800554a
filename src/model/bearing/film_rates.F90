#include "gfb_petsc.h"
!> What a bearing's equations gain in time: the film's squeeze term, and what follows the gap alone.
!>
!> In time the equations are \( f(x, q) + \frac{d}{dt} c(x, q) = 0 \) with the unknowns x and the shaft's
!> coordinates q; c is the gas that the film's elements hold (`gfb_squeeze_term`), zero in all other
!> equations. Matrices are scaled as the bearing's own, and have its pattern.
module gfb_film_rates
  use petscmat
  use gfb_kinds, only: wp
  use gfb_operating_point, only: operating_point_type
  use gfb_gas_film, only: gas_film_type
  use gfb_squeeze_term, only: squeeze_weights, squeeze_jacobian
  use gfb_pad_terms, only: shaft_unknowns_type, element_columns, add_block
  use gfb_foil_model, only: foil_model_type
  use gfb_pad, only: pad_type
  use gfb_bearing, only: bearing_type, bearing_state_type
  use gfb_bearing_numbering, only: number_by
  use gfb_foil_rows, only: add_of_foil
  implicit none (type)
  private
  public :: fill_film, fill_springs, fill_from_foil, fill_friction, squeeze_column

  !> Derivatives there are: of c by the unknowns; what of it comes by the foil's deflection; the same of the steady film's.
  integer, parameter, public :: squeeze = 1, squeeze_by_gap = 2, flow_by_gap = 3

contains

  !> Fills a matrix with one of the film's derivatives, element by element.
  subroutine fill_film(bearing, kind, matrix)
    class(bearing_type), intent(in) :: bearing !! at its answer
    integer, intent(in) :: kind !! `squeeze`, `squeeze_by_gap` or `flow_by_gap`
    Mat, intent(in) :: matrix !! like the bearing's; overwritten

    real(wp) :: unknown(bearing%local_size()), gap(bearing%film_nodes())
    PetscErrorCode :: ierr
    integer :: i

    call bearing%get_unknowns(unknown)
    gap = bearing%gap(unknown)
    PetscCallA(MatZeroEntries(matrix, ierr))
    do i = 1, size(bearing%pad)
      call number_by(bearing, i, matrix)
      associate (pad => bearing%pad(i), nodes => bearing%pad(i)%last_node - bearing%pad(i)%first_node)
        call fill_pad_film(pad, kind, unknown(pad%first + 1:pad%first + nodes), gap(pad%first_node + 1:pad%last_node), &
                           bearing%position(unknown), matrix)
      end associate
    end do
    call number_by(bearing, 0, matrix)
    do i = 1, size(bearing%block)
      if (.not. associated(bearing%block(i)%add_rates)) cycle
      call bearing%block(i)%add_rates(bearing, kind, bearing_state_type(bearing%position(unknown), bearing%point, unknown, gap), matrix)
    end do
    call finish(bearing, matrix)
  end subroutine fill_film

  !> The same of one pad, by its local numbers.
  subroutine fill_pad_film(pad, kind, pressure, gap, point, matrix)
    type(pad_type), intent(in) :: pad
    integer, intent(in) :: kind
    real(wp), intent(in) :: pressure(:), gap(:) !! at the pad's nodes [Pa], [m]
    type(operating_point_type), intent(in) :: point !! with the shaft's position
    Mat, intent(in) :: matrix

    real(wp), dimension(size(pad%film%shape, 1), size(pad%film%shape, 1)) :: by_pressure, by_gap
    ! a row of the matrix in each column, as PETSc reads it
    real(wp) :: block(2*size(by_gap, 1), size(by_gap, 1)), softness(size(by_gap, 1))
    PetscInt :: row(size(by_gap, 1)), column(2*size(by_gap, 1))
    type(shaft_unknowns_type) :: none
    integer :: element, b, place, n

    n = size(row)
    allocate (none%coordinate(0))
    associate (film => pad%film, foil => pad%foil)
      do element = 1, size(film%element_nodes, 2)
        call element_columns(film, foil, none, element, row, column)
        call element_derivatives(film, kind, element, pressure, gap, point, by_pressure, by_gap)
        block = 0.0_wp
        block(:n, :) = transpose(by_pressure)
        softness = film%softness_of(element)
        associate (nodes => film%element_nodes(:, element))
          do b = 1, n
            place = merge(b, n + b, foil%source(nodes(b)) == nodes(b))
            block(place, :) = block(place, :) + (foil%rate(nodes(b)) + softness(b))*by_gap(:, b)
          end do
        end associate
        call add_block(matrix, row, column, block)
      end do
    end associate
  end subroutine fill_pad_film

  !> An element's derivatives by pressures and by gaps; zero where only gaps count.
  pure subroutine element_derivatives(film, kind, element, pressure, gap, point, by_pressure, by_gap)
    type(gas_film_type), intent(in) :: film
    integer, intent(in) :: kind, element
    real(wp), intent(in) :: pressure(:), gap(:) !! at this rank's nodes [Pa], [m]
    type(operating_point_type), intent(in) :: point
    real(wp), contiguous, intent(out) :: by_pressure(:, :), by_gap(:, :) !! (nodes, nodes)
    real(wp) :: by_excess(size(by_gap, 1), size(by_gap, 1)), by_shaft(size(by_gap, 1), 0)

    if (kind == flow_by_gap) then
      call film%element_jacobian(element, pressure, gap, point, [integer ::], by_pressure, by_gap, by_shaft)
    else
      call element_squeeze(film, element, pressure, gap, point, by_pressure, by_gap, by_excess)
    end if
    if (kind /= squeeze) by_pressure = 0.0_wp
  end subroutine element_derivatives

  !> Derivatives of the gas that one element holds.
  pure subroutine element_squeeze(film, element, pressure, gap, point, by_pressure, by_gap, by_excess)
    type(gas_film_type), intent(in) :: film
    integer, intent(in) :: element
    real(wp), intent(in) :: pressure(:), gap(:) !! at this rank's nodes [Pa], [m]
    type(operating_point_type), intent(in) :: point
    real(wp), intent(out) :: by_pressure(:, :), by_gap(:, :), by_excess(:, :) !! (nodes, nodes)
    real(wp), dimension(size(by_gap, 1)) :: p, h, excess

    associate (nodes => film%element_nodes(:, element), geometry => film%geometry(element))
      p = pressure(nodes)
      h = film%element_gap(element, pressure, gap)
      excess = reshape(film%content_excess(element, point), [size(h)])
      call squeeze_jacobian(geometry, film%law, &
                            squeeze_weights(geometry, film%flow_at(point), film%law, p, h, excess, film%factors_of(element)), &
                            p, h, excess, by_pressure, by_gap, by_excess, film%factors_of(element))
    end associate
  end subroutine element_squeeze

  !> Derivative of c by one of the shaft's coordinates, the unknowns staying.
  subroutine squeeze_column(bearing, coordinate, column)
    class(bearing_type), intent(in) :: bearing !! at its answer
    integer, intent(in) :: coordinate !! see `shaft_coordinates`
    Vec, intent(in) :: column         !! scaled as the residual, by that unit

    real(wp) :: unknown(bearing%local_size()), value(bearing%local_size()), gap(bearing%film_nodes())
    PetscErrorCode :: ierr
    integer :: i

    call bearing%get_unknowns(unknown)
    gap = bearing%gap(unknown)
    value = 0.0_wp
    do i = 1, size(bearing%pad)
      associate (pad => bearing%pad(i), nodes => bearing%pad(i)%last_node - bearing%pad(i)%first_node)
        call add_squeeze_column(pad%film, coordinate, unknown(pad%first + 1:pad%first + nodes), &
                                gap(pad%first_node + 1:pad%last_node), bearing%position(unknown), &
                                value(pad%first + 1:pad%first + nodes))
      end associate
    end do
    PetscCallA(VecSet(column, 0.0_wp, ierr))
    call bearing%exchange%add(value/bearing%equation_scale(bearing%point), column)
  end subroutine squeeze_column

  !> The same of one pad's film.
  pure subroutine add_squeeze_column(film, coordinate, pressure, gap, point, value)
    type(gas_film_type), intent(in) :: film
    integer, intent(in) :: coordinate
    real(wp), intent(in) :: pressure(:), gap(:) !! at the film's nodes [Pa], [m]
    type(operating_point_type), intent(in) :: point !! with the shaft's position
    real(wp), intent(inout) :: value(:) !! at these nodes, zero before [SI]
    real(wp), dimension(size(film%shape, 1), size(film%shape, 1)) :: by_p, by_h, by_e
    integer :: element

    do element = 1, size(film%element_nodes, 2)
      call element_squeeze(film, element, pressure, gap, point, by_p, by_h, by_e)
      associate (nodes => film%element_nodes(:, element))
        value(nodes) = value(nodes) + matmul(by_h, film%motion(coordinate, nodes)) &
          + matmul(by_e, film%motion_excess(coordinate, :, element))
      end associate
    end do
    where (film%fixed) value = 0.0_wp
  end subroutine add_squeeze_column

  !> Stiffness of the foil's own springs, or of foils that are meshed, without contacts.
  subroutine fill_springs(bearing, matrix)
    class(bearing_type), intent(in) :: bearing !! at its answer
    Mat, intent(in) :: matrix !! like the bearing's; overwritten
    PetscErrorCode :: ierr
    integer :: i

    PetscCallA(MatZeroEntries(matrix, ierr))
    do i = 1, size(bearing%pad)
      associate (foil => bearing%pad(i)%foil)
        call number_by(bearing, i, matrix)
        call foil%add_springs(matrix)
        if (foil%is_meshed() .and. foil%elastic_loses) call add_of_foil(bearing%blocks, foil, i, foil%elastic, foil%modulus, .false., matrix)
      end associate
    end do
    call finish(bearing, matrix)
  end subroutine fill_springs

  !> A matrix of a meshed foil, the same one for each pad, and nothing else.
  subroutine fill_from_foil(bearing, of_foil, matrix)
    class(bearing_type), intent(in) :: bearing !! at its answer
    Mat, intent(in) :: of_foil !! in the foil's own numbers
    Mat, intent(in) :: matrix  !! like the bearing's; overwritten
    PetscErrorCode :: ierr
    integer :: i

    PetscCallA(MatZeroEntries(matrix, ierr))
    do i = 1, size(bearing%pad)
      call add_of_foil(bearing%blocks, bearing%pad(i)%foil, i, of_foil, [1.0_wp, 1.0_wp], .false., matrix)
    end do
    call finish(bearing, matrix)
  end subroutine fill_from_foil

  !> A stiffness of the contacts along their surface, and nothing else.
  subroutine fill_friction(bearing, stiffness, matrix)
    class(bearing_type), intent(inout) :: bearing !! at its answer; left as it is
    real(wp), intent(in) :: stiffness(:) !! of this rank's contacts, pad by pad [N/m]
    Mat, intent(in) :: matrix !! like the bearing's; overwritten
    real(wp) :: unknown(bearing%local_size())
    PetscErrorCode :: ierr
    integer :: i, first

    call bearing%get_unknowns(unknown)
    PetscCallA(MatZeroEntries(matrix, ierr))
    first = 0
    do i = 1, size(bearing%pad)
      call number_by(bearing, i, matrix)
      associate (pad => bearing%pad(i), last => first + size(bearing%pad(i)%foil%contacts%point))
        call add_friction(pad%foil, unknown(pad%first + 1:pad%last), stiffness(first + 1:last), matrix)
      end associate
      first = first + size(bearing%pad(i)%foil%contacts%point)
    end do
    call finish(bearing, matrix)
  end subroutine fill_friction

  !> The same of one pad's foil, by its local numbers.
  subroutine add_friction(foil, unknown, stiffness, matrix)
    class(foil_model_type), intent(inout) :: foil !! left as it is
    real(wp), intent(in) :: unknown(:)   !! the pad's, in SI
    real(wp), intent(in) :: stiffness(:) !! of its contacts [N/m]
    Mat, intent(in) :: matrix
    real(wp) :: kept(3, 3, size(stiffness))
    integer :: i

    associate (point => foil%contacts%point, law => foil%contacts%law)
      do i = 1, size(point)
        kept(:, :, i) = point(i)%derivative
        point(i)%derivative = 0.0_wp
        point(i)%derivative(1, 1) = -stiffness(i)
        if (.not. law(point(i)%law)%one_way) point(i)%derivative(2, 2) = -stiffness(i)
      end do
      foil%contacts%artificial = .false.
      call foil%add_jacobian(unknown, matrix)
      foil%contacts%artificial = .true.
      do i = 1, size(point)
        point(i)%derivative = kept(:, :, i)
      end do
    end associate
  end subroutine add_friction

  !> Assembles a matrix and scales it as the bearing's.
  subroutine finish(bearing, matrix)
    class(bearing_type), intent(in) :: bearing
    Mat, intent(in) :: matrix
    Vec :: left, right
    PetscErrorCode :: ierr

    call number_by(bearing, 0, matrix)
    PetscCallA(MatAssemblyBegin(matrix, MAT_FINAL_ASSEMBLY, ierr))
    PetscCallA(MatAssemblyEnd(matrix, MAT_FINAL_ASSEMBLY, ierr))
    PetscCallA(VecDuplicate(bearing%state, left, ierr))
    PetscCallA(VecDuplicate(bearing%state, right, ierr))
    call bearing%exchange%put(1.0_wp/bearing%equation_scale(bearing%point), left)
    call bearing%exchange%put(bearing%unknown_scale, right)
    PetscCallA(MatDiagonalScale(matrix, left, right, ierr))
    PetscCallA(VecDestroy(left, ierr))
    PetscCallA(VecDestroy(right, ierr))
  end subroutine finish
end module gfb_film_rates
