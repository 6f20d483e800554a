!> A surface of quadrilaterals with fields as a VTKHDF unstructured grid, which ParaView opens as
!> it is.
!>
!> The grid is one piece with global numbers, whatever the ranks: each rank hands in consecutive
!> points and cells.
module gfb_grid_file
  use, intrinsic :: iso_c_binding, only: c_int8_t
  use gfb_kinds, only: long
  use gfb_errors, only: error_type
  use gfb_grid, only: grid_type, grid_field_type, block_bounds, corners, vtk_quad, grid_group
  use gfb_result_file, only: result_file_type, open_result_file, close_result_file
  implicit none (type, external)
  private
  public :: write_grid_file

  character(len=*), parameter :: group = grid_group

contains

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
    integer :: first, last, offsets_end, i

    call put_count(file, 'NumberOfPoints', grid%points, 'points of the only piece')
    call put_count(file, 'NumberOfCells', grid%cells, 'cells of the only piece')
    call put_count(file, 'NumberOfConnectivityIds', corners*grid%cells, 'entries of Connectivity')
    call block_bounds(grid%points, rank, ranks, first, last)
    call file%put_block(group//'/Points', grid%point, first - 1, grid%points, 'm', &
                        'unrolled: x along the motion, y towards the shaft, z along the axis')
    call block_bounds(grid%cells, rank, ranks, first, last)
    call file%put_long_block(group//'/Connectivity', &
                             int(reshape(grid%cell, [size(grid%cell)]) - 1, long), &
                             corners*(first - 1), corners*grid%cells, 'points of the cells, from 0')
    allocate (types(size(grid%cell, 2)), source=vtk_quad)
    call file%put_byte_block(group//'/Types', types, first - 1, grid%cells, &
                             'VTK cell types, 9: quadrilateral')
    offsets_end = merge(last + 1, last, rank == ranks - 1)
    call file%put_long_block(group//'/Offsets', &
                             [(int(corners, long)*(i - 1), i=first, offsets_end)], &
                             first - 1, grid%cells + 1, 'where each cell begins in Connectivity')
  end subroutine write_grid

  !> A count as a list of one, one entry a piece.
  subroutine put_count(file, name, number, meaning)
    type(result_file_type), intent(inout) :: file
    character(len=*), intent(in) :: name
    integer, intent(in) :: number
    character(len=*), intent(in) :: meaning

    if (file%first_rank) then
      call file%put_long_block(group//'/'//name, [int(number, long)], 0, 1, meaning)
    else
      call file%put_long_block(group//'/'//name, [integer(long) ::], 0, 1, meaning)
    end if
  end subroutine put_count
end module gfb_grid_file
