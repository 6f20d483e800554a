#include "gfb_petsc.h"
!> Measures condensation on the ten-bump strip of [Gu2020].
!>
!> `gfb_bench_condensation ARC FLAT AXIAL`: elements of a bump's arc, of its flat, over the width.
!> Writes lines `name,value`; times are CPU times [s]. `tools/bench condensation` makes a table of
!> them.
program gfb_bench_condensation
  use petscksp
  use gfb_kinds, only: wp
  use gfb_errors, only: error_type
  use gfb_petsc_session, only: start_petsc, stop_petsc, rank_count
  use gfb_shell_geometry, only: shell_geometry_type, shell_unknowns
  use gfb_shell_element, only: shell_stiffness
  use gfb_substructures, only: substructure_type, find_kinds, kind_count
  use gfb_foil_structure, only: foil_structure_type, destroy_foil_structure, element_geometry, assemble_piece, retained_in_piece
  use gfb_foil_assembly, only: create_foil_structure
  use gfb_super_element, only: super_element_type, condense, destroy_super_element
  use gfb_strip_cost, only: strip_type, make_strip, strip_cost_type, strip_cost, argument, tell
  implicit none (type)

  character(len=*), parameter :: usage = 'gfb_bench_condensation ARC FLAT AXIAL'

  type(strip_type) :: strip

  call start_petsc()
  if (rank_count() > 1) error stop 'one rank measures'
  strip = make_strip(argument(1, usage), argument(2, usage), argument(3, usage))
  call measure_ways(strip)
  call measure_complements(strip)
  call measure_kernel(strip)
  call stop_petsc()

contains

  !> Ends the program with a mistake of its own.
  subroutine stop_on(error)
    type(error_type), allocatable, intent(in) :: error
    if (allocated(error)) error stop 'an element of the strip cannot be computed'
  end subroutine stop_on

  !> Full, reduced with equal pieces condensed once, reduced with each piece on its own.
  subroutine measure_ways(strip)
    type(strip_type), intent(in) :: strip
    type(strip_cost_type) :: full, reduced, single
    type(error_type), allocatable :: error

    call strip_cost(strip, .false., .true., full, error)
    call stop_on(error)
    call tell_cost('full', full)
    call strip_cost(strip, .true., .true., reduced, error)
    call stop_on(error)
    call tell_cost('congruent', reduced)
    call tell('congruent.difference', difference(full%moved, reduced%moved))
    call strip_cost(strip, .true., .false., single, error)
    call stop_on(error)
    call tell_cost('single', single)
    call tell('single.difference', difference(full%moved, single%moved))
  end subroutine measure_ways

  !> Steps of one variant.
  subroutine tell_cost(name, cost)
    character(len=*), intent(in) :: name
    type(strip_cost_type), intent(in) :: cost

    call tell(name//'.set_up', cost%set_up)
    call tell(name//'.factor', cost%factor)
    call tell(name//'.refactor', cost%refactor)
    call tell(name//'.solve', cost%solve)
    call tell(name//'.recovery', cost%recovery)
    call tell(name//'.unknowns', real(cost%unknowns, wp))
    call tell(name//'.condensed', real(cost%kinds, wp))
  end subroutine tell_cost

  !> Largest difference of displacements and of rotations, each over the largest one.
  pure real(wp) function difference(one, other) result(largest)
    real(wp), intent(in) :: one(:, :), other(:, :) !! (5, nodes) [m], [rad]

    largest = max(maxval(abs(other(:3, :) - one(:3, :)))/maxval(abs(one(:3, :))), &
                  maxval(abs(other(4:, :) - one(4:, :)))/maxval(abs(one(4:, :))))
  end function difference

  !> The complement of one piece of each kind: by MUMPS as gfb does it, and by MatSchurComplement's
  !> exact inner solver.
  subroutine measure_complements(strip)
    type(strip_type), intent(in) :: strip

    type(substructure_type), allocatable :: piece(:)
    type(foil_structure_type) :: foil
    type(super_element_type) :: super
    type(error_type), allocatable :: error
    real(wp), allocatable :: condensed(:, :)
    logical, allocatable :: is_retained(:)
    real(wp) :: start, middle, finish, ours, mumps, apart
    integer :: kind
    Mat :: stiffness
    PetscErrorCode :: ierr

    piece = strip%piece
    call find_kinds(strip%mesh, strip%fixed, piece)
    call create_foil_structure(strip%mesh, strip%section, strip%fixed, piece, .false., foil, error)
    call stop_on(error)
    ours = 0.0_wp
    mumps = 0.0_wp
    apart = 0.0_wp
    do kind = 1, kind_count(piece)
      associate (one => piece(findloc(piece%kind, kind, 1)))
        call assemble_piece(foil%mesh, foil%section, foil%free(:, one%nodes), one, .false., stiffness, error)
        call stop_on(error)
        is_retained = retained_in_piece(foil%free(:, one%nodes), one)
      end associate
      call cpu_time(start)
      call condense(stiffness, is_retained, 'super_', super)
      call cpu_time(middle)
      condensed = complement_by_solver(stiffness, super)
      call cpu_time(finish)
      mumps = mumps + middle - start
      ours = ours + finish - middle
      apart = max(apart, maxval(abs(condensed - super%stiffness))/maxval(abs(super%stiffness)))
      call destroy_super_element(super)
      PetscCallA(MatDestroy(stiffness, ierr))
    end do
    call destroy_foil_structure(foil)
    call tell('complement.matrix', ours)
    call tell('complement.mumps', mumps)
    call tell('complement.difference', apart)
    call tell('complement.kinds', real(kind_count(piece), wp))
    call tell('complement.largest', real(maxval([(piece_size(piece(kind)), kind=1, size(piece))]), wp))
  end subroutine measure_complements

  !> Retained nodes of a piece.
  pure integer function piece_size(piece) result(nodes)
    type(substructure_type), intent(in) :: piece
    nodes = count(piece%retained)
  end function piece_size

  !> Element stiffnesses a second, geometry at hand.
  subroutine measure_kernel(strip)
    type(strip_type), intent(in) :: strip

    integer, parameter :: least_elements = 50000 ! so that a clock tick does not show
    type(shell_geometry_type), allocatable :: geometry(:)
    type(error_type), allocatable :: error
    real(wp) :: stiffness(shell_unknowns, shell_unknowns), trace, start, finish
    integer :: element, elements, rounds, round, i

    elements = size(strip%mesh%element_nodes, 2)
    allocate (geometry(elements))
    do element = 1, elements
      geometry(element) = element_geometry(strip%mesh, element)
    end do
    rounds = (least_elements - 1)/elements + 1
    trace = 0.0_wp
    call cpu_time(start)
    do round = 1, rounds
      do element = 1, elements
        call shell_stiffness(geometry(element), strip%section, stiffness, error)
        trace = trace + sum([(stiffness(i, i), i=1, shell_unknowns)])
      end do
    end do
    call cpu_time(finish)
    call stop_on(error)
    if (.not. trace > 0.0_wp) error stop 'the stiffness is not positive'
    call tell('kernel.elements_per_second', real(elements*rounds, wp)/(finish - start))
  end subroutine measure_kernel

  !> The complement by a solve for every retained unknown.
  function complement_by_solver(stiffness, super) result(complement)
    Mat, intent(in) :: stiffness
    type(super_element_type), intent(in) :: super
    real(wp), allocatable :: complement(:, :)
    Mat :: dense
    PetscScalar, pointer :: values(:, :)
    PetscErrorCode :: ierr

    PetscCallA(MatConvert(stiffness, MATSEQDENSE, MAT_INITIAL_MATRIX, dense, ierr))
    PetscCallA(GFB_MatDenseGetArray(dense, values, ierr))
    complement = values(super%retained, super%retained) + &
                 matmul(values(super%retained, super%interior), super%constraint_modes())
    PetscCallA(GFB_MatDenseRestoreArray(dense, values, ierr))
    PetscCallA(MatDestroy(dense, ierr))
  end function complement_by_solver
end program gfb_bench_condensation
