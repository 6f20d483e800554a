!> A series of a surface as a VTKHDF unstructured grid with `Steps`, which ParaView plays.
!>
!> Layout: docs.vtk.org, VTKHDF format specification, "Temporal Data". A step names by offsets where
!> its grid and each of its fields begin, so that steps share what does not change.
module gfb_series_file
  use, intrinsic :: iso_c_binding, only: c_int8_t
  use gfb_errors, only: error_type
  use gfb_grid, only: grid_group, corners, vtk_quad
  use gfb_grid_series, only: grid_series_type, surface_series_type, series_field_type, columns_type
  use gfb_kinds, only: wp, long
  use gfb_result_file, only: result_file_type, open_result_file, close_result_file
  implicit none (type, external)
  private
  public :: write_series_file

  character(len=*), parameter :: steps = grid_group//'/Steps'

contains

  !> Writes a surface of a series under the file's temporary name.
  !>
  !> Fails when the file cannot be written.
  subroutine write_series_file(path, communicator, first_rank, series, number, file, error)
    character(len=*), intent(in) :: path !! of the file
    integer, intent(in) :: communicator !! MPI's
    logical, intent(in) :: first_rank !! this rank has the series' numbers
    type(grid_series_type), intent(in) :: series !! with a step or more
    integer, intent(in) :: number !! of the surface
    type(result_file_type), intent(out) :: file !! the file being written
    type(error_type), allocatable, intent(out) :: error !! what went wrong, if anything did

    call open_result_file(path, communicator, first_rank, file, error)
    if (allocated(error)) return
    call file%group(grid_group)
    call file%mark_longs(grid_group, 'Version', [2_long, 0_long])
    call file%mark_text(grid_group, 'Type', 'UnstructuredGrid')
    call file%group(steps)
    call file%mark_longs(steps, 'NSteps', [size(series%value, kind=long)])
    associate (surface => series%surface(number))
      call write_grids(file, surface)
      call write_values(file, series)
      call write_places(file, surface)
      call write_fields(file, 'PointData', surface%point_field)
      call write_fields(file, 'CellData', surface%cell_field)
    end associate
    call close_result_file(file, error)
  end subroutine write_series_file

  !> Points and cells of all grids, one behind the other; the cells of each count its own points.
  subroutine write_grids(file, surface)
    type(result_file_type), intent(inout) :: file
    type(surface_series_type), intent(in) :: surface
    integer(c_int8_t), allocatable :: types(:)
    integer(long), allocatable :: begins(:)
    integer :: grids, i, k

    grids = merge(size(surface%points), 0, file%first_rank)
    associate (points => surface%points(:grids), cells => surface%cells(:grids))
      call put_list(file, 'NumberOfPoints', int(points, long), 'points of each grid')
      call put_list(file, 'NumberOfCells', int(cells, long), 'cells of each grid')
      call put_list(file, 'NumberOfConnectivityIds', int(corners*cells, long), &
                    'entries of Connectivity for each grid')
      call put_columns(file, grid_group//'/Points', surface%point, 'm', &
                       'unrolled: x along the motion, y towards the shaft, z along the axis')
      call put_list(file, 'Connectivity', &
                    int(reshape(surface%cell%number(:, :sum(cells)), [corners*sum(cells)]), &
                        long) - 1_long, 'points of the cells, from 0')
      allocate (types(sum(cells)), source=vtk_quad)
      call file%put_byte_block(grid_group//'/Types', types, 0, size(types), &
                               'VTK cell types, 9: quadrilateral')
      begins = [([(int(corners, long)*i, i=0, cells(k))], k=1, grids)]
      call put_list(file, 'Offsets', begins, 'where each cell begins in Connectivity')
    end associate
  end subroutine write_grids

  !> The values of the steps. A reader looks for a step by its value, which therefore has to grow:
  !> where it does not, the number of the step stands instead, and the value in the field data.
  subroutine write_values(file, series)
    type(result_file_type), intent(inout) :: file
    type(grid_series_type), intent(in) :: series
    character(len=*), parameter :: fields = grid_group//'/FieldData'
    integer :: i, here

    associate (value => series%value, many => size(series%value))
      if (all(value(2:) > value(:many - 1))) then
        call file%put_numbers(steps//'/Values', value, series%unit, series%name)
      else
        call file%put_numbers(steps//'/Values', [(real(i, wp), i=1, many)], '1', &
                              'number of the step')
      end if
      call file%group(fields)
      call file%group(steps//'/FieldDataOffsets')
      call file%put_numbers(fields//'/'//series%name, value, series%unit, 'at each step')
      here = merge(many, 0, file%first_rank)
      call put_list(file, 'Steps/FieldDataOffsets/'//series%name, &
                    [(int(i, long), i=0, here - 1)], 'entry of each step')
    end associate
  end subroutine write_values

  !> Where the grid of each step begins.
  subroutine write_places(file, surface)
    type(result_file_type), intent(inout) :: file
    type(surface_series_type), intent(in) :: surface
    integer(long), allocatable :: point(:), cell(:)
    integer :: many, i

    many = merge(size(surface%grid), 0, file%first_rank)
    associate (grid => surface%grid(:many))
      point = [(int(sum(surface%points(:grid(i) - 1)), long), i=1, many)]
      cell = [(int(sum(surface%cells(:grid(i) - 1)), long), i=1, many)]
      call put_list(file, 'Steps/PartOffsets', int(grid - 1, long), 'grid of each step, from 0')
      call put_list(file, 'Steps/NumberOfParts', [(1_long, i=1, many)], 'grids of each step')
      call put_list(file, 'Steps/PointOffsets', point, 'points before those of each step')
      call put_list(file, 'Steps/CellOffsets', cell, 'cells before those of each step', [1])
      call put_list(file, 'Steps/ConnectivityIdOffsets', corners*cell, &
                    'entries of Connectivity before those of each step', [1])
    end associate
  end subroutine write_places

  !> Fields at points or cells: entries of all steps, and where those of each step begin.
  subroutine write_fields(file, group, field)
    type(result_file_type), intent(inout) :: file
    character(len=*), intent(in) :: group !! PointData or CellData
    type(series_field_type), intent(in) :: field(:)
    integer :: i, many

    call file%group(grid_group//'/'//group)
    call file%group(steps//'/'//group//'Offsets')
    do i = 1, size(field)
      call put_columns(file, grid_group//'/'//group//'/'//field(i)%name, field(i)%value, &
                       field(i)%unit, field(i)%meaning)
      many = merge(size(field(i)%offset), 0, file%first_rank)
      call put_list(file, 'Steps/'//group//'Offsets/'//field(i)%name, &
                    int(field(i)%offset(:many), long), 'entries before those of each step')
    end do
  end subroutine write_fields

  !> Numbers that the first rank has.
  subroutine put_columns(file, path, columns, unit, meaning)
    type(result_file_type), intent(inout) :: file
    character(len=*), intent(in) :: path
    type(columns_type), intent(in) :: columns
    character(len=*), intent(in) :: unit, meaning
    integer :: used

    used = merge(columns%used, 0, file%first_rank)
    call file%put_block(path, columns%number(:, :used), 0, used, unit, meaning)
  end subroutine put_columns

  !> Whole numbers, none on other ranks than the first.
  subroutine put_list(file, path, list, meaning, shape)
    type(result_file_type), intent(inout) :: file
    character(len=*), intent(in) :: path !! in the group of the grid
    integer(long), intent(in) :: list(:)
    character(len=*), intent(in) :: meaning
    integer, intent(in), optional :: shape(:) !! of an entry

    call file%put_long_block(grid_group//'/'//path, list, 0, size(list), meaning, shape)
  end subroutine put_list
end module gfb_series_file
