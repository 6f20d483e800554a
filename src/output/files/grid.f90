!> A surface of quadrilaterals, or a line, with fields, each rank having a part of it.
!>
!> It is written as a VTKHDF unstructured grid, which ParaView opens as it is.
!>
!> The grid is one piece with global numbers, whatever the ranks: each rank hands in consecutive
!> points and cells.
module gfb_grid
  use, intrinsic :: iso_c_binding, only: c_int8_t
  use gfb_kinds, only: wp, long
  use gfb_errors, only: error_type
  use gfb_result_file, only: result_file_type, open_result_file, close_result_file
  implicit none (type, external)
  private
  public :: block_bounds, add_grid_field, strip_grid, write_grid_file

  integer, parameter, public :: corners = 4                     !! of a cell
  integer(c_int8_t), parameter, public :: vtk_quad = 9_c_int8_t !! VTK's type of one
  integer(c_int8_t), parameter :: vtk_line = 3_c_int8_t !! and of a piece of a line
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
    integer, allocatable :: cell(:, :)   !! (4, or 2 of a line, cells of this rank), points from 1
  end type grid_type

  !> A surface with its fields, `<case>.<name>.vtkhdf`.
  type, public :: result_grid_type
    character(len=:), allocatable :: name !! film, top_foil, bump_foil or shaft
    type(grid_type) :: grid
    type(grid_field_type), allocatable :: point_field(:), cell_field(:)
  end type result_grid_type

  character(len=*), parameter :: group = grid_group
  character(len=*), parameter, public :: point_meaning = 'unrolled: x along the motion, '// &
    'y towards the shaft, z along the axis; of thrust bearings and shafts x, y, z in space'

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

  !> One rank's part of the rectangles; point (station, row) is number (station - 1)*rows + row.
  pure function strip_grid(position_x, strips, position_z, rank, ranks) result(grid)
    real(wp), intent(in) :: position_x(:) !! of the stations, strip by strip [m]
    integer, intent(in) :: strips         !! rectangles that do not touch, of as many stations
    real(wp), intent(in) :: position_z(:) !! of the rows [m]
    integer, intent(in) :: rank, ranks    !! this one, from 0, and their number
    type(grid_type) :: grid
    integer :: rows, corner, column, columns, first, last, i

    rows = size(position_z)
    grid%points = rows*size(position_x)
    columns = size(position_x)/strips - 1 ! of one
    grid%cells = (rows - 1)*strips*columns
    call block_bounds(grid%points, rank, ranks, first, last)
    allocate (grid%point(3, last - first + 1), source=0.0_wp)
    do i = first, last
      grid%point(1, i - first + 1) = position_x((i - 1)/rows + 1)
      grid%point(3, i - first + 1) = position_z(modulo(i - 1, rows) + 1)
    end do
    call block_bounds(grid%cells, rank, ranks, first, last)
    allocate (grid%cell(4, last - first + 1))
    do i = first, last
      column = (i - 1)/(rows - 1)
      corner = (column + column/columns)*rows + modulo(i - 1, rows - 1) + 1
      grid%cell(:, i - first + 1) = [corner, corner + rows, corner + rows + 1, corner + 1]
    end do
  end function strip_grid

  !> Writes a grid and its fields under the file's temporary name.
  !>
  !> Fails when the file cannot be written.
  subroutine write_grid_file(path, communicator, rank, ranks, grid, point_field, &
                             cell_field, file, error)
    character(len=*), intent(in) :: path !! of the file, or of what is in it
    integer, intent(in) :: communicator !! MPI's
    integer, intent(in) :: rank, ranks               !! this one, from 0, and their number
    type(grid_type), intent(in) :: grid              !! parts by `block_bounds`
    type(grid_field_type), intent(in) :: point_field(:), cell_field(:) !! values of elements
    type(result_file_type), intent(out) :: file !! the file being written
    type(error_type), allocatable, intent(out) :: error !! what went wrong, if anything did
    integer :: first, last

    call open_result_file(path, communicator, rank == 0, file, error)
    if (allocated(error)) return
    call file%group(group)
    call file%mark_longs(group, 'Version', [2_long, 0_long])
    call file%mark_text(group, 'Type', 'UnstructuredGrid')
    call write_grid(file, rank, ranks, grid)
    call block_bounds(grid%points, rank, ranks, first, last)
    call write_fields(file, group//'/PointData', point_field, first - 1, grid%points)
    call block_bounds(grid%cells, rank, ranks, first, last)
    call write_fields(file, group//'/CellData', cell_field, first - 1, grid%cells)
    call close_result_file(file, error)
  end subroutine write_grid_file

  !> Fields at points or cells.
  subroutine write_fields(file, group, field, offset, total)
    type(result_file_type), intent(inout) :: file
    character(len=*), intent(in) :: group
    type(grid_field_type), intent(in) :: field(:)
    integer, intent(in) :: offset, total !! entries before this rank's, and of all ranks
    integer :: i

    call file%group(group)
    do i = 1, size(field)
      call file%put_block(group//'/'//field(i)%name, field(i)%block, offset, total, field(i)%unit, &
                          field(i)%meaning)
    end do
  end subroutine write_fields

  !> Points and cells.
  subroutine write_grid(file, rank, ranks, grid)
    type(result_file_type), intent(inout) :: file
    integer, intent(in) :: rank, ranks
    type(grid_type), intent(in) :: grid

    integer(c_int8_t), allocatable :: types(:)
    integer(c_int8_t) :: type
    integer :: nodes, first, last, offsets_end, i

    nodes = size(grid%cell, 1)
    type = merge(vtk_quad, vtk_line, nodes == corners)
    call put_count(file, 'NumberOfPoints', grid%points, 'points of the only piece')
    call put_count(file, 'NumberOfCells', grid%cells, 'cells of the only piece')
    call put_count(file, 'NumberOfConnectivityIds', nodes*grid%cells, 'entries of Connectivity')
    call block_bounds(grid%points, rank, ranks, first, last)
    call file%put_block(group//'/Points', grid%point, first - 1, grid%points, 'm', &
                        point_meaning)
    call block_bounds(grid%cells, rank, ranks, first, last)
    call file%put_long_block(group//'/Connectivity', &
                             int(reshape(grid%cell, [size(grid%cell)]) - 1, long), &
                             nodes*(first - 1), nodes*grid%cells, 'points of the cells, from 0')
    allocate (types(size(grid%cell, 2)), source=type)
    call file%put_byte_block(group//'/Types', types, first - 1, grid%cells, &
                             'VTK cell types, 9: quadrilateral, 3: line')
    offsets_end = merge(last + 1, last, rank == ranks - 1)
    call file%put_long_block(group//'/Offsets', &
                             [(int(nodes, long)*(i - 1), i=first, offsets_end)], &
                             first - 1, grid%cells + 1, 'where each cell begins in Connectivity')
  end subroutine write_grid

  !> A count as a list of one, one entry a piece.
  subroutine put_count(file, name, number, meaning)
    type(result_file_type), intent(inout) :: file
    character(len=*), intent(in) :: name, meaning
    integer, intent(in) :: number

    if (file%first_rank) then
      call file%put_long_block(group//'/'//name, [int(number, long)], 0, 1, meaning)
    else
      call file%put_long_block(group//'/'//name, [integer(long) ::], 0, 1, meaning)
    end if
  end subroutine put_count
end module gfb_grid
