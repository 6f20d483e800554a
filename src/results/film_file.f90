!> The film as a VTKHDF unstructured grid of quadrilaterals, which ParaView opens as it is.
!>
!> Points are the unrolled pad: x along the shaft's motion, y = 0, z along the axis. The grid is one
!> piece; node (station, row) is number (station - 1)*rows + row, whatever the ranks.
module gfb_film_file
  use, intrinsic :: iso_c_binding, only: c_int8_t
  use gfb_kinds, only: wp, long
  use gfb_errors, only: error_type
  use gfb_result_file, only: result_file_type, open_result_file, close_result_file
  implicit none (type, external)
  private
  public :: write_film_file, block_bounds

  integer(c_int8_t), parameter :: vtk_quad = 9_c_int8_t
  character(len=*), parameter :: group = '/VTKHDF'

  !> A nodal field, of which each rank has consecutive nodes.
  type, public :: film_field_type
    character(len=:), allocatable :: name, unit, meaning
    real(wp), allocatable :: block(:) !! this rank's part
  end type film_field_type

contains

  !> First and last of the entries, from 1, that a rank of several holds.
  pure subroutine block_bounds(total, rank, ranks, first, last)
    integer, intent(in) :: total       !! entries in all
    integer, intent(in) :: rank, ranks !! this one, from 0, and their number
    integer, intent(out) :: first, last

    first = int(int(rank, long)*total/ranks) + 1
    last = int(int(rank + 1, long)*total/ranks)
  end subroutine block_bounds

  !> Writes the film's grid and fields, under the file's temporary name.
  !>
  !> Fails when the file cannot be written.
  subroutine write_film_file(path, communicator, information, rank, ranks, position_x, position_z, &
                             field, file, error)
    character(len=*), intent(in) :: path
    integer, intent(in) :: communicator, information !! MPI's
    integer, intent(in) :: rank, ranks               !! this one, from 0, and their number
    real(wp), intent(in) :: position_x(:)            !! x of the stations [m]
    real(wp), intent(in) :: position_z(:)            !! z of the rows [m]
    type(film_field_type), intent(in) :: field(:)
    type(result_file_type), intent(out) :: file
    type(error_type), allocatable, intent(out) :: error
    integer :: nodes, first, last, i

    nodes = size(position_x)*size(position_z)
    call open_result_file(path, communicator, information, rank == 0, file, error)
    if (allocated(error)) return
    call file%group(group)
    call file%mark_longs(group, 'Version', [2_long, 0_long])
    call file%mark_text(group, 'Type', 'UnstructuredGrid')
    call write_grid(file, rank, ranks, position_x, position_z)
    call block_bounds(nodes, rank, ranks, first, last)
    call file%group(group//'/PointData')
    do i = 1, size(field)
      call file%put_block(group//'/PointData/'//field(i)%name, &
                          reshape(field(i)%block, [1, size(field(i)%block)]), first - 1, nodes, &
                          field(i)%unit, field(i)%meaning)
    end do
    call close_result_file(file, error)
  end subroutine write_film_file

  !> Points and cells.
  subroutine write_grid(file, rank, ranks, position_x, position_z)
    type(result_file_type), intent(inout) :: file
    integer, intent(in) :: rank, ranks
    real(wp), intent(in) :: position_x(:), position_z(:)

    real(wp), allocatable :: point(:, :)
    integer(long), allocatable :: connectivity(:)
    integer(c_int8_t), allocatable :: types(:)
    integer(long) :: corner
    integer :: rows, nodes, cells, first, last, offsets_end, i

    rows = size(position_z)
    nodes = rows*size(position_x)
    cells = (rows - 1)*(size(position_x) - 1)
    call put_count(file, 'NumberOfPoints', nodes, 'points of the only piece')
    call put_count(file, 'NumberOfCells', cells, 'cells of the only piece')
    call put_count(file, 'NumberOfConnectivityIds', 4*cells, 'entries of Connectivity')

    call block_bounds(nodes, rank, ranks, first, last)
    allocate (point(3, last - first + 1), source=0.0_wp)
    do i = first, last
      point(1, i - first + 1) = position_x((i - 1)/rows + 1)
      point(3, i - first + 1) = position_z(modulo(i - 1, rows) + 1)
    end do
    call file%put_block(group//'/Points', point, first - 1, nodes, 'm', &
                        'unrolled pad: x along the motion, y radial, z along the axis')

    call block_bounds(cells, rank, ranks, first, last)
    allocate (connectivity(4*(last - first + 1)), types(last - first + 1))
    types = vtk_quad
    do i = first, last
      corner = int((i - 1)/(rows - 1)*rows + modulo(i - 1, rows - 1), long)
      connectivity(4*(i - first) + 1:4*(i - first) + 4) = [corner, corner + rows, corner + rows + 1, corner + 1]
    end do
    call file%put_long_block(group//'/Connectivity', connectivity, 4*(first - 1), 4*cells, &
                             'points of the cells, from 0')
    call file%put_byte_block(group//'/Types', types, first - 1, cells, 'VTK cell types, 9: quadrilateral')
    offsets_end = merge(last + 1, last, rank == ranks - 1)
    call file%put_long_block(group//'/Offsets', [(4_long*(i - 1), i=first, offsets_end)], first - 1, &
                             cells + 1, 'where each cell begins in Connectivity')
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
end module gfb_film_file
