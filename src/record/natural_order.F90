#include "gfb_petsc.h"
!> Numbers of unknowns and contacts that do not depend on how many ranks there are.
module gfb_natural_order
  use petscvec
  use gfb_kinds, only: wp, long
  use gfb_petsc_session, only: this_rank, rank_count, largest_number, fetch_entries
  use gfb_mesh_dm, only: local_mesh_type
  use gfb_bump_contacts, only: contact_sleeve, contact_top
  use gfb_contact_set, only: contact_set_type
  use gfb_inner_motion, only: inner_motion_type
  use gfb_bearing_system, only: bearing_system_type
  use gfb_strip_system, only: strip_system_type, plate_forced
  implicit none (type)
  private
  public :: bearing_order, path_order, strip_order, contact_order, piece_order, to_natural, from_natural, vector_values, set_vector

  !> What this rank owns, by numbers that some of which nothing may have.
  type, public :: natural_order_type
    integer, allocatable :: number(:) !! of each thing this rank owns, from 1
    integer :: total = 0              !! largest number on all ranks
  contains
    procedure :: offset => offset_of_rank
    procedure :: entries => entries_of_rank
  end type natural_order_type

contains

  !> Order of a bearing's state: of each pad film node by node, foil; shaft.
  function bearing_order(bearing) result(order)
    type(bearing_system_type), intent(in) :: bearing !! with its numbering
    type(natural_order_type) :: order
    integer, allocatable :: film(:), foil(:)
    integer :: i, k

    film = film_numbers(bearing%pad(1)%mesh)
    foil = bearing%pad(1)%foil%natural_numbers()
    order%number = [film, largest_number(film) + foil]
    order%total = largest_number(order%number)
    order%number = [((k - 1)*order%total + order%number, k=1, size(bearing%pad))] ! pad by pad
    order%total = largest_number(order%number)
    if (.not. bearing%floats) return
    associate (scalars => bearing%blocks%border%scalars)
      if (bearing%last_rank) order%number = [order%number, (order%total + i, i=1, scalars)]
      order%total = order%total + scalars
    end associate
  end function bearing_order

  !> Order of a bearing's state with its path parameter behind it.
  function path_order(bearing) result(order)
    type(bearing_system_type), intent(in) :: bearing !! with its numbering
    type(natural_order_type) :: order

    order = bearing_order(bearing)
    order%total = order%total + 1
    if (bearing%last_rank) order%number = [order%number, order%total]
  end function path_order

  !> Order of a strip's state: node by node, then the plate.
  function strip_order(strip) result(order)
    type(strip_system_type), intent(in) :: strip !! with its numbering
    type(natural_order_type) :: order

    order%number = strip%foil%natural_numbers()
    order%total = largest_number(order%number)
    if (strip%plate /= plate_forced) return
    order%total = order%total + 1
    if (this_rank() == rank_count() - 1) order%number = [order%number, order%total]
  end function strip_order

  !> Order of contacts: surface by surface, line by line, node by node.
  function contact_order(contacts, rows) result(order)
    type(contact_set_type), intent(in) :: contacts !! of all surfaces
    integer, intent(in) :: rows !! nodes of a line
    type(natural_order_type) :: order
    integer :: sleeve_lines

    associate (point => contacts%point)
      sleeve_lines = largest_number(pack(point%line, point%law == contact_sleeve))
      order%number = (point%line - 1)*rows + modulo(point%node - 1, rows) + 1
      where (point%law == contact_top) order%number = order%number + sleeve_lines*rows
    end associate
    order%total = largest_number(order%number)
  end function contact_order

  !> Order of the condensed pieces whose inner modes move: pad by pad, along the foil.
  function piece_order(motion) result(order)
    type(inner_motion_type), intent(in) :: motion !! of this rank's pieces
    type(natural_order_type) :: order
    integer :: i

    order%number = [(motion%inner(i)%place, i=1, size(motion%inner))]
    order%total = largest_number(order%number)
  end function piece_order

  !> Numbers of the film nodes this rank owns, in the order of the vectors.
  pure function film_numbers(mesh) result(number)
    type(local_mesh_type), intent(in) :: mesh
    integer, allocatable :: number(:)
    integer :: node, first

    allocate (number(mesh%owned_unknowns), source=0)
    first = minval(mesh%first_unknown, mesh%owned)
    do node = 1, size(mesh%mesh_node)
      if (mesh%owned(node)) number(mesh%first_unknown(node) - first + 1) = mesh%mesh_node(node)
    end do
  end function film_numbers

  !> Numbers before those that this rank writes and reads, an equal part.
  function offset_of_rank(self) result(offset)
    class(natural_order_type), intent(in) :: self !! the order
    integer :: offset
    offset = int(int(self%total, long)*this_rank()/rank_count())
  end function offset_of_rank

  !> Numbers that this rank writes and reads.
  function entries_of_rank(self) result(entries)
    class(natural_order_type), intent(in) :: self !! the order
    integer :: entries
    entries = int(int(self%total, long)*(this_rank() + 1)/rank_count()) - self%offset()
  end function entries_of_rank

  !> This rank's part of a field in the natural order; zero where nothing has the number.
  function to_natural(order, value) result(block)
    type(natural_order_type), intent(in) :: order !! of the things
    real(wp), intent(in) :: value(:, :) !! (components, things this rank owns), in any unit [SI]
    real(wp), allocatable :: block(:, :)
    integer :: i

    block = fetch_entries(order%total, order%number, value, [(order%offset() + i, i=1, order%entries())])
  end function to_natural

  !> A field at what this rank owns, from the ranks' parts in the natural order.
  function from_natural(order, block) result(value)
    type(natural_order_type), intent(in) :: order !! of the things
    real(wp), intent(in) :: block(:, :) !! (components, numbers of this rank's share), in any unit [SI]
    real(wp), allocatable :: value(:, :)
    integer :: i

    value = fetch_entries(order%total, [(order%offset() + i, i=1, order%entries())], block, order%number)
  end function from_natural

  !> What this rank owns of a vector, as a field of one component.
  function vector_values(vector) result(value)
    Vec, intent(in) :: vector !! of all ranks
    real(wp), allocatable :: value(:, :)
    PetscScalar, pointer :: values(:)
    PetscErrorCode :: ierr

    PetscCallA(GFB_VecGetArrayRead(vector, values, ierr))
    value = reshape(values, [1, size(values)])
    PetscCallA(GFB_VecRestoreArrayRead(vector, values, ierr))
  end function vector_values

  !> The reverse.
  subroutine set_vector(value, vector)
    real(wp), intent(in) :: value(:, :) !! (1, owned), scaled [1]
    Vec, intent(in) :: vector !! of all ranks, is filled
    PetscScalar, pointer :: values(:)
    PetscErrorCode :: ierr

    PetscCallA(GFB_VecGetArray(vector, values, ierr))
    values = value(1, :)
    PetscCallA(GFB_VecRestoreArray(vector, values, ierr))
  end subroutine set_vector
end module gfb_natural_order
