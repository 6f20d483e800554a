!> Surfaces with fields at the steps of a series: the points of a sweep, the times of a transient.
!>
!> What a step shares with the one before, a grid that does not move or a field that does not
!> change, is kept once. The first rank has all numbers; the other ranks know surfaces, fields and
!> values.
!>
!> A series of a surface as a VTKHDF unstructured grid with `Steps`, which ParaView plays.
!>
!> Layout: docs.vtk.org, VTKHDF format specification, "Temporal Data". A step names by offsets where
!> its grid and each of its fields begin, so that steps share what does not change.
module gfb_grid_series
  use, intrinsic :: iso_c_binding, only: c_int8_t, c_f_pointer, c_loc
  use gfb_errors, only: error_type
  use gfb_grid, only: grid_group, point_meaning, corners, vtk_quad, grid_type, grid_field_type, &
                      result_grid_type, block_bounds
  use gfb_kinds, only: wp, long
  use gfb_result_file, only: result_file_type, open_result_file, close_result_file, gather_parts
  use gfb_archive, only: archive_type
  implicit none (type, external)
  private
  public :: write_series_file, begin_step, add_surface, cut_series, join_series, forget_numbers, &
            visit_series, is_whole

  character(len=*), parameter :: steps = grid_group//'/Steps'

  !> Columns of numbers, with room for more.
  type :: columns_type
    real(wp), allocatable :: number(:, :) !! (components, room)
    integer :: used = 0                   !! columns that have numbers
  end type columns_type

  !> A field of a surface over the steps.
  type :: series_field_type
    character(len=:), allocatable :: name, unit, meaning
    type(columns_type) :: value       !! entries of the steps that brought new ones, in `unit`
    integer, allocatable :: offset(:) !! entries before those of each step
  end type series_field_type

  !> A surface over the steps.
  type :: surface_series_type
    character(len=:), allocatable :: name  !! of the surface, such as film
    type(columns_type) :: point            !! of all grids, one behind the other [m]
    type(columns_type) :: cell             !! the same; four points each, from 1 in each grid
    integer, allocatable :: points(:), cells(:) !! of each grid
    integer, allocatable :: grid(:)        !! that each step has, from 1
    type(series_field_type), allocatable :: point_field(:), cell_field(:)
  end type surface_series_type

  !> The series; without a step where it has no values.
  type, public :: grid_series_type
    character(len=:), allocatable :: name, unit !! of what has a value at each step
    real(wp), allocatable :: value(:)           !! one a step, in that unit
    type(surface_series_type), allocatable :: surface(:)
  end type grid_series_type

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
                       point_meaning)
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
    character(len=*), intent(in) :: path, unit, meaning
    type(columns_type), intent(in) :: columns
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

  !> Begins a step; all its surfaces are to be added.
  subroutine begin_step(series, name, unit, value)
    type(grid_series_type), intent(inout) :: series !! gets the step
    character(len=*), intent(in) :: name !! of what has a value, such as time
    character(len=*), intent(in) :: unit !! of the value
    real(wp), intent(in) :: value        !! at this step, in that unit

    series%name = name
    series%unit = unit
    if (.not. allocated(series%value)) allocate (series%value(0))
    if (.not. allocated(series%surface)) allocate (series%surface(0))
    series%value = [series%value, value]
  end subroutine begin_step

  !> Adds a surface to the step that was begun last; all steps have the same surfaces and fields.
  subroutine add_surface(series, communicator, rank, ranks, now)
    type(grid_series_type), intent(inout) :: series !! gets the surface
    integer, intent(in) :: communicator !! MPI's
    integer, intent(in) :: rank, ranks  !! this one, from 0, and their number
    type(result_grid_type), intent(in) :: now !! the surface at this step, parts by `block_bounds`
    type(surface_series_type) :: new
    integer :: i

    if (size(series%value) == 1) then
      call begin_surface(now, new)
      series%surface = [series%surface, new]
    end if
    do i = 1, size(series%surface)
      if (series%surface(i)%name == now%name) exit
    end do
    if (i > size(series%surface)) error stop 'a step has a surface that the first one has not'
    associate (surface => series%surface(i))
      call add_grid(surface, communicator, rank, ranks, now%grid)
      call add_fields(surface%point_field, communicator, rank, ranks, now%grid%points, &
                      now%point_field)
      call add_fields(surface%cell_field, communicator, rank, ranks, now%grid%cells, now%cell_field)
    end associate
  end subroutine add_surface

  !> A surface without a step.
  pure subroutine begin_surface(now, surface)
    type(result_grid_type), intent(in) :: now
    type(surface_series_type), intent(out) :: surface

    surface%name = now%name
    allocate (surface%points(0), surface%cells(0), surface%grid(0))
    allocate (surface%point%number(3, 0), surface%cell%number(4, 0))
    call begin_fields(now%point_field, surface%point_field)
    call begin_fields(now%cell_field, surface%cell_field)
  end subroutine begin_surface

  !> Fields without a step.
  pure subroutine begin_fields(field, list)
    type(grid_field_type), intent(in) :: field(:)
    type(series_field_type), allocatable, intent(out) :: list(:)
    integer :: i

    allocate (list(size(field)))
    do i = 1, size(field)
      list(i)%name = field(i)%name
      list(i)%unit = field(i)%unit
      list(i)%meaning = field(i)%meaning
      allocate (list(i)%offset(0), list(i)%value%number(size(field(i)%block, 1), 0))
    end do
  end subroutine begin_fields

  !> Adds the grid of a step, unless it is that of the step before.
  subroutine add_grid(surface, communicator, rank, ranks, grid)
    type(surface_series_type), intent(inout) :: surface
    integer, intent(in) :: communicator, rank, ranks
    type(grid_type), intent(in) :: grid
    real(wp), allocatable :: point(:, :), cell(:, :)
    logical :: same

    point = gathered(communicator, rank, ranks, grid%point, grid%points)
    cell = gathered(communicator, rank, ranks, real(grid%cell, wp), grid%cells)
    same = ends_with(surface%point, point) .and. ends_with(surface%cell, cell)
    if (rank == 0 .and. .not. same) then
      surface%points = [surface%points, grid%points]
      surface%cells = [surface%cells, grid%cells]
      call append(surface%point, point)
      call append(surface%cell, cell)
    end if
    surface%grid = [surface%grid, size(surface%points)]
  end subroutine add_grid

  !> Adds the fields of a step; of a field that is as it was only where it stands.
  subroutine add_fields(list, communicator, rank, ranks, total, field)
    type(series_field_type), intent(inout) :: list(:)
    integer, intent(in) :: communicator, rank, ranks
    integer, intent(in) :: total !! entries of all ranks
    type(grid_field_type), intent(in) :: field(:)
    real(wp), allocatable :: value(:, :)
    integer :: i

    if (size(list) /= size(field)) error stop 'a step has other fields than the first one'
    do i = 1, size(list)
      value = gathered(communicator, rank, ranks, field(i)%block, total)
      if (rank == 0 .and. .not. ends_with(list(i)%value, value)) call append(list(i)%value, value)
      list(i)%offset = [list(i)%offset, list(i)%value%used - size(value, 2)]
    end do
  end subroutine add_fields

  !> The entries of all ranks on the first one, none on the others.
  function gathered(communicator, rank, ranks, block, total) result(all)
    integer, intent(in) :: communicator, rank, ranks
    real(wp), intent(in) :: block(:, :) !! (components, entries of this rank)
    integer, intent(in) :: total        !! entries of all ranks
    real(wp), allocatable :: all(:, :)
    real(wp), target :: buffer(max(1, size(block)))
    integer(c_int8_t), allocatable, target :: bytes(:)
    real(wp), pointer :: number(:, :)
    integer :: first, last

    call block_bounds(total, rank, ranks, first, last)
    buffer(:size(block)) = reshape(block, [size(block)])
    call gather_parts(communicator, rank == 0, size(block, 1)*storage_size(buffer)/8, &
                      c_loc(buffer), size(block, 2), first - 1, total, bytes)
    allocate (all(size(block, 1), merge(total, 0, rank == 0)))
    if (size(all) == 0) return
    call c_f_pointer(c_loc(bytes), number, shape(all))
    all = number
  end function gathered

  !> Whether the last columns are these.
  pure logical function ends_with(columns, last) result(same)
    type(columns_type), intent(in) :: columns
    real(wp), intent(in) :: last(:, :)
    integer :: before

    before = columns%used - size(last, 2)
    same = before >= 0
    if (same) same = .not. any(abs(columns%number(:, before + 1:columns%used) - last) > 0.0_wp)
  end function ends_with

  !> Adds columns.
  pure subroutine append(columns, more)
    type(columns_type), intent(inout) :: columns
    real(wp), intent(in) :: more(:, :)
    real(wp), allocatable :: wider(:, :)
    integer :: last

    last = columns%used + size(more, 2)
    if (last > size(columns%number, 2)) then
      allocate (wider(size(more, 1), last + columns%used))
      wider(:, :columns%used) = columns%number(:, :columns%used)
      call move_alloc(wider, columns%number)
    end if
    columns%number(:, columns%used + 1:last) = more
    columns%used = last
  end subroutine append

  !> Keeps the first steps only, and what these have.
  pure subroutine cut_series(series, steps)
    type(grid_series_type), intent(inout) :: series !! loses steps
    integer, intent(in) :: steps !! that stay
    type(grid_series_type) :: none
    integer :: i

    if (.not. allocated(series%value)) return
    if (size(series%value) <= steps) return
    if (steps == 0) then
      series = none
      return
    end if
    series%value = series%value(:steps)
    do i = 1, size(series%surface)
      associate (surface => series%surface(i))
        surface%grid = surface%grid(:steps)
        call cut_grids(surface, min(surface%grid(steps), size(surface%points)))
        call cut_fields(surface%point_field, steps)
        call cut_fields(surface%cell_field, steps)
      end associate
    end do
  end subroutine cut_series

  !> Keeps the first grids.
  pure subroutine cut_grids(surface, grids)
    type(surface_series_type), intent(inout) :: surface
    integer, intent(in) :: grids !! that stay

    surface%points = surface%points(:grids)
    surface%cells = surface%cells(:grids)
    surface%point%used = sum(surface%points)
    surface%cell%used = sum(surface%cells)
  end subroutine cut_grids

  !> Keeps the first steps of fields, and the entries that these have.
  pure subroutine cut_fields(list, steps)
    type(series_field_type), intent(inout) :: list(:)
    integer, intent(in) :: steps !! that stay
    integer :: i

    do i = 1, size(list)
      associate (later => list(i)%offset(steps + 1:), last => list(i)%offset(steps))
        if (any(later > last)) list(i)%value%used = minval(later, later > last)
      end associate
      list(i)%offset = list(i)%offset(:steps)
    end do
  end subroutine cut_fields

  !> Adds the steps of another series with the same surfaces and fields at the end.
  pure subroutine join_series(series, more)
    type(grid_series_type), intent(inout) :: series !! gets steps
    type(grid_series_type), intent(in) :: more !! what comes behind
    integer :: i

    if (.not. allocated(more%value)) return
    if (.not. allocated(series%value)) then
      series = more
      return
    end if
    series%value = [series%value, more%value]
    do i = 1, size(series%surface)
      associate (surface => series%surface(i), next => more%surface(i))
        call join_grids(surface, next)
        call join_fields(surface%point_field, next%point_field)
        call join_fields(surface%cell_field, next%cell_field)
      end associate
    end do
  end subroutine join_series

  !> Adds the grids of further steps, unless all of them have the last one.
  pure subroutine join_grids(surface, more)
    type(surface_series_type), intent(inout) :: surface
    type(surface_series_type), intent(in) :: more
    logical :: same

    associate (point => more%point%number(:, :more%point%used), &
               cell => more%cell%number(:, :more%cell%used))
      same = size(more%points) == 1 .and. ends_with(surface%point, point)
      same = same .and. ends_with(surface%cell, cell)
      surface%grid = [surface%grid, more%grid + (size(surface%points) - merge(1, 0, same))]
      if (same) return
      surface%points = [surface%points, more%points]
      surface%cells = [surface%cells, more%cells]
      call append(surface%point, point)
      call append(surface%cell, cell)
    end associate
  end subroutine join_grids

  !> Adds further steps to those of fields, of one that stays as it was only where it stands.
  pure subroutine join_fields(list, more)
    type(series_field_type), intent(inout) :: list(:)
    type(series_field_type), intent(in) :: more(:)
    integer :: i

    do i = 1, size(list)
      associate (value => more(i)%value%number(:, :more(i)%value%used))
        if (all(more(i)%offset == 0) .and. ends_with(list(i)%value, value)) then
          list(i)%offset = [list(i)%offset, more(i)%offset + (list(i)%value%used - size(value, 2))]
        else
          list(i)%offset = [list(i)%offset, more(i)%offset + list(i)%value%used]
          call append(list(i)%value, value)
        end if
      end associate
    end do
  end subroutine join_fields

  !> Frees what the first rank alone has to know.
  pure subroutine forget_numbers(series)
    type(grid_series_type), intent(inout) :: series !! on another rank
    integer :: i, k

    if (.not. allocated(series%surface)) return
    do i = 1, size(series%surface)
      associate (surface => series%surface(i))
        surface%points = surface%points(:0)
        surface%cells = surface%cells(:0)
        call empty(surface%point)
        call empty(surface%cell)
        do k = 1, size(surface%point_field)
          call empty(surface%point_field(k)%value)
        end do
        do k = 1, size(surface%cell_field)
          call empty(surface%cell_field(k)%value)
        end do
      end associate
    end do
  end subroutine forget_numbers

  !> No columns.
  pure subroutine empty(columns)
    type(columns_type), intent(inout) :: columns

    columns%number = columns%number(:, :0)
    columns%used = 0
  end subroutine empty

  !> Saves or restores a series.
  pure subroutine visit_series(archive, series)
    type(archive_type), intent(inout) :: archive !! that saves or restores
    type(grid_series_type), intent(inout) :: series !! written where the archive restores
    integer :: surfaces, i

    call archive%visit('name', series%name)
    call archive%visit('unit', series%unit)
    call archive%visit_sized('value', series%value)
    surfaces = 0
    if (allocated(series%surface)) surfaces = size(series%surface)
    call archive%visit_count('surfaces', surfaces)
    if (.not. archive%saves) then
      if (allocated(series%surface)) deallocate (series%surface)
      allocate (series%surface(surfaces))
    end if
    do i = 1, surfaces
      associate (surface => series%surface(i))
        call archive%visit('surface', surface%name)
        call visit_columns(archive, 'point', surface%point)
        call visit_columns(archive, 'cell', surface%cell)
        call archive%visit_sized('points', surface%points)
        call archive%visit_sized('cells', surface%cells)
        call archive%visit_sized('grid', surface%grid)
        call visit_fields(archive, 'point_fields', surface%point_field)
        call visit_fields(archive, 'cell_fields', surface%cell_field)
      end associate
    end do
  end subroutine visit_series

  !> Whether what a series has fits together, as where it was read back.
  pure logical function is_whole(series) result(whole)
    type(grid_series_type), intent(in) :: series !! with a step or without
    integer :: i

    whole = .true.
    if (.not. allocated(series%value)) return
    whole = allocated(series%name) .and. allocated(series%unit) .and. allocated(series%surface)
    if (.not. whole) return
    do i = 1, size(series%surface)
      whole = whole .and. surface_is_whole(series%surface(i), size(series%value))
    end do
  end function is_whole

  !> The same of a surface: grids with points and cells, one of them at each step, and fields on it.
  pure logical function surface_is_whole(surface, many) result(whole)
    type(surface_series_type), intent(in) :: surface
    integer, intent(in) :: many !! steps
    integer(long) :: ends(2)
    integer :: i

    whole = allocated(surface%name) .and. allocated(surface%points) .and. &
            allocated(surface%cells) .and. allocated(surface%grid)
    if (.not. whole) return
    whole = size(surface%points) == size(surface%cells) .and. size(surface%grid) == many .and. &
            all(surface%points >= 0) .and. all(surface%cells >= 0) .and. &
            all(surface%grid >= 1) .and. all(surface%grid <= size(surface%points)) .and. &
            size(surface%point%number, 1) == 3 .and. size(surface%cell%number, 1) == corners
    if (.not. whole) return
    ends = [sum(int(surface%points, long)), sum(int(surface%cells, long))]
    whole = all(ends == [surface%point%used, surface%cell%used]) .and. &
            all(surface%cell%number >= 1.0_wp) .and. &
            all(surface%cell%number <= real(maxval([surface%points, 0]), wp))
    do i = 1, size(surface%point_field)
      whole = whole .and. field_is_whole(surface%point_field(i), surface%points, surface%grid)
    end do
    do i = 1, size(surface%cell_field)
      whole = whole .and. field_is_whole(surface%cell_field(i), surface%cells, surface%grid)
    end do
  end function surface_is_whole

  !> The same of a field: each step finds as many entries as its grid has.
  pure logical function field_is_whole(field, entries, grid) result(whole)
    type(series_field_type), intent(in) :: field
    integer, intent(in) :: entries(:), grid(:) !! of each grid; of each step

    whole = allocated(field%name) .and. allocated(field%unit) .and. allocated(field%meaning) .and. &
            allocated(field%offset)
    if (.not. whole) return
    whole = size(field%offset) == size(grid)
    if (.not. whole) return
    whole = all(field%offset >= 0) .and. &
            all(int(field%offset, long) + entries(grid) <= field%value%used)
  end function field_is_whole

  !> Saves or restores fields.
  pure subroutine visit_fields(archive, name, field)
    type(archive_type), intent(inout) :: archive
    character(len=*), intent(in) :: name
    type(series_field_type), allocatable, intent(inout) :: field(:)
    integer :: fields, i

    fields = 0
    if (allocated(field)) fields = size(field)
    call archive%visit_count(name, fields)
    if (.not. archive%saves) then
      if (allocated(field)) deallocate (field)
      allocate (field(fields))
    end if
    do i = 1, fields
      call archive%visit('name', field(i)%name)
      call archive%visit('unit', field(i)%unit)
      call archive%visit('meaning', field(i)%meaning)
      call visit_columns(archive, 'value', field(i)%value)
      call archive%visit_sized('offset', field(i)%offset)
    end do
  end subroutine visit_fields

  !> Saves or restores columns, without the room for more.
  pure subroutine visit_columns(archive, name, columns)
    type(archive_type), intent(inout) :: archive
    character(len=*), intent(in) :: name
    type(columns_type), intent(inout) :: columns

    if (archive%saves) columns%number = columns%number(:, :columns%used)
    call archive%visit_sized(name, columns%number)
    if (archive%saves) return
    call archive%require(allocated(columns%number), "'"//name//"' of a series")
    if (.not. archive%failed) columns%used = size(columns%number, 2)
  end subroutine visit_columns
end module gfb_grid_series
