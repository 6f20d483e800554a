!> How a series is packed and unpacked: for restart files, between groups.
module gfb_series_memory
  use gfb_grid_series, only: grid_series_type, series_field_type, columns_type
  use gfb_memory, only: memory_type
  implicit none (type, external)
  private
  public :: remember_series

contains

  !> Packs or unpacks a series.
  pure subroutine remember_series(memory, series)
    type(memory_type), intent(inout) :: memory !! that packs or unpacks
    type(grid_series_type), intent(inout) :: series !! written where the memory unpacks
    integer :: surfaces, i

    call memory%visit('name', series%name)
    call memory%visit('unit', series%unit)
    call memory%visit_sized('value', series%value)
    surfaces = 0
    if (allocated(series%surface)) surfaces = size(series%surface)
    call memory%visit('surfaces', surfaces)
    if (memory%failed) return
    if (.not. memory%packs) then
      if (allocated(series%surface)) deallocate (series%surface)
      allocate (series%surface(surfaces))
    end if
    do i = 1, surfaces
      associate (surface => series%surface(i))
        call memory%visit('surface', surface%name)
        call remember_columns(memory, 'point', surface%point)
        call remember_columns(memory, 'cell', surface%cell)
        call memory%visit_sized('points', surface%points)
        call memory%visit_sized('cells', surface%cells)
        call memory%visit_sized('grid', surface%grid)
        call remember_fields(memory, 'point_fields', surface%point_field)
        call remember_fields(memory, 'cell_fields', surface%cell_field)
      end associate
    end do
  end subroutine remember_series

  !> Packs or unpacks fields.
  pure subroutine remember_fields(memory, name, field)
    type(memory_type), intent(inout) :: memory
    character(len=*), intent(in) :: name
    type(series_field_type), allocatable, intent(inout) :: field(:)
    integer :: fields, i

    fields = 0
    if (allocated(field)) fields = size(field)
    call memory%visit(name, fields)
    if (memory%failed) return
    if (.not. memory%packs) then
      if (allocated(field)) deallocate (field)
      allocate (field(fields))
    end if
    do i = 1, fields
      call memory%visit('name', field(i)%name)
      call memory%visit('unit', field(i)%unit)
      call memory%visit('meaning', field(i)%meaning)
      call remember_columns(memory, 'value', field(i)%value)
      call memory%visit_sized('offset', field(i)%offset)
    end do
  end subroutine remember_fields

  !> Packs or unpacks columns, without the room for more.
  pure subroutine remember_columns(memory, name, columns)
    type(memory_type), intent(inout) :: memory
    character(len=*), intent(in) :: name
    type(columns_type), intent(inout) :: columns

    if (memory%packs) columns%number = columns%number(:, :columns%used)
    call memory%visit_sized(name, columns%number)
    if (memory%failed .or. memory%packs) return
    memory%failed = .not. allocated(columns%number)
    if (.not. memory%failed) columns%used = size(columns%number, 2)
  end subroutine remember_columns
end module gfb_series_memory
