!> A surface of quadrilaterals with fields, each rank having a part of it.
module gfb_grid
  use, intrinsic :: iso_c_binding, only: c_int8_t
  use gfb_kinds, only: wp, long
  implicit none (type, external)
  private
  public :: block_bounds, add_grid_field

  integer, parameter, public :: corners = 4                     !! of a cell
  integer(c_int8_t), parameter, public :: vtk_quad = 9_c_int8_t !! VTK's type of one
  character(len=*), parameter, public :: grid_group = '/VTKHDF' !! of a file that VTK reads

  !> A field, of which each rank has consecutive entries.
  type, public :: grid_field_type
    character(len=:), allocatable :: name, unit, meaning
    real(wp), allocatable :: block(:, :) !! (components, entries of this rank)
  end type grid_field_type

  !> A surface, of which each rank has consecutive points and cells.
  type, public :: grid_type
    integer :: points = 0                !! of all ranks
    integer :: cells = 0                 !! of all ranks
    real(wp), allocatable :: point(:, :) !! (3, points of this rank) [m]
    integer, allocatable :: cell(:, :)   !! (4, cells of this rank), points from 1
  end type grid_type

  !> A surface with its fields, `<case>.<name>.vtkhdf`.
  type, public :: result_grid_type
    character(len=:), allocatable :: name !! film, top_foil or bump_foil
    type(grid_type) :: grid
    type(grid_field_type), allocatable :: point_field(:), cell_field(:)
  end type result_grid_type

contains

  !> First and last of the entries, from 1, that a rank of several holds.
  pure subroutine block_bounds(total, rank, ranks, first, last)
    integer, intent(in) :: total       !! entries in all
    integer, intent(in) :: rank, ranks !! this one, from 0, and their number
    integer, intent(out) :: first, last !! first and last of this rank's entries

    first = int(int(rank, long)*total/ranks) + 1
    last = int(int(rank + 1, long)*total/ranks)
  end subroutine block_bounds

  !> Puts a field at the end of a list.
  subroutine add_grid_field(list, name, unit, meaning, block)
    type(grid_field_type), allocatable, intent(inout) :: list(:) !! gets the field
    character(len=*), intent(in) :: name !! of the field
    character(len=*), intent(in) :: unit !! of its numbers
    character(len=*), intent(in) :: meaning !! of the field, in words
    real(wp), intent(in) :: block(:, :) !! (components, entries of this rank), in its unit
    type(grid_field_type) :: one

    one%name = name
    one%unit = unit
    one%meaning = meaning
    one%block = block
    if (.not. allocated(list)) allocate (list(0))
    list = [list, one]
  end subroutine add_grid_field
end module gfb_grid
