!> The film of a bearing as a surface with fields.
module gfb_film_grid
  use gfb_kinds, only: wp
  use gfb_units, only: turn
  use gfb_study_cases, only: output_case_type
  use gfb_petsc_session, only: this_rank, rank_count, fetch_entries
  use gfb_bearing, only: bearing_type, shown_field_type
  use gfb_film_surface, only: film_surface_type
  use gfb_film_fields, only: film_block, full_rows
  use gfb_grid, only: result_grid_type, block_bounds, add_grid_field, strip_grid
  implicit none (type, external)
  private
  public :: add_film_grid

contains

  !> Adds the film with the fields the scene asks for; nothing where it asks for none. The film of the second bearing, of a
  !> rotor that tilts or on a runner's other side, has a number behind its name.
  subroutine add_film_grid(bearing, output, grids)
    class(bearing_type), intent(in) :: bearing !! at the state to be written
    type(output_case_type), intent(in) :: output !! which fields are asked for
    type(result_grid_type), allocatable, intent(inout) :: grids(:) !! to be written; gets the film
    integer :: pads
    logical :: two

    if (.not. (output%pressure .or. output%gap .or. output%deflection)) return
    pads = size(bearing%pad)*bearing%mesh%repeats
    associate (first => bearing%mesh%surface, last => bearing%pad(size(bearing%pad))%film%surface)
      two = abs(last%offset - first%offset) > 0.0_wp
    end associate
    if (two) pads = pads/2
    call add_pads(bearing, output, 0, pads, 'film', grids)
    if (two) call add_pads(bearing, output, pads, pads, 'film_2', grids)
  end subroutine add_film_grid

  !> Fields that blocks of equations have to show.
  subroutine find_shown(bearing, unknown, row, value)
    class(bearing_type), intent(in) :: bearing
    real(wp), intent(in) :: unknown(:) !! local, in SI
    type(shown_field_type), allocatable, intent(out) :: row(:)
    real(wp), allocatable, intent(out) :: value(:, :) !! (local nodes, fields)
    integer :: i, k, many

    allocate (row(0))
    do i = 1, size(bearing%block)
      if (allocated(bearing%block(i)%shown)) row = [row, bearing%block(i)%shown]
    end do
    allocate (value(bearing%film_nodes(), size(row)))
    many = 0
    do i = 1, size(bearing%block)
      if (.not. allocated(bearing%block(i)%shown)) cycle
      do k = 1, size(bearing%block(i)%shown)
        many = many + 1
        call bearing%block(i)%show(bearing, unknown, k, value(:, many))
      end do
    end do
  end subroutine find_shown

  !> Adds the film of some pads, those of one bearing.
  subroutine add_pads(bearing, output, before, pads, name, grids)
    class(bearing_type), intent(in) :: bearing
    type(output_case_type), intent(in) :: output
    integer, intent(in) :: before !! pads before them
    integer, intent(in) :: pads   !! their number
    character(len=*), intent(in) :: name !! of the surface
    type(result_grid_type), allocatable, intent(inout) :: grids(:)

    type(result_grid_type) :: film
    type(film_surface_type) :: surface
    real(wp) :: unknown(bearing%local_size())
    real(wp), allocatable :: angle(:, :)
    type(shown_field_type), allocatable :: row(:)
    real(wp), allocatable :: value(:, :)
    real(wp) :: along
    integer :: i, first, last
    logical :: ring

    call bearing%get_unknowns(unknown)
    film%name = name
    surface = bearing%pad(before/bearing%mesh%repeats + 1)%film%surface
    film%grid = strip_grid(positions_along(bearing, pads), pads, full_rows(bearing) + surface%offset*surface%cosine, this_rank(), &
                           rank_count())
    associate (point => film%grid%point)
      ring = surface%is_ring()
      angle = point(1:1, :)/surface%radius + bearing%mesh%station_angle(1)
      if (allocated(bearing%mesh%slant)) then
        do i = 1, size(angle, 2)
          along = point(3, i)
          angle(1, i) = angle(1, i) + bearing%mesh%slant_at(merge(abs(along), along, bearing%mesh%half))
        end do
      end if
      do i = 1, merge(size(point, 2), 0, ring) ! a ring is no plane when it is unrolled
        point(:, i) = surface%position(angle(1, i), point(3, i))
      end do
    end associate
    if (ring) then ! pads that are not solved have angles, too
      call add_grid_field(film%point_field, 'theta', 'rad', 'angle around the bearing', angle)
    else
      call add('theta', 'rad', 'angle around the bearing', [(bearing%pad(i)%film%angle, i=1, size(bearing%pad))])
    end if
    if (output%pressure) call add('pressure', 'Pa', 'absolute pressure', bearing%film_pressure(unknown))
    if (output%gap) call add('gap', 'm', 'film thickness', bearing%gap(unknown))
    if (output%deflection) then
      call add('deflection', 'm', 'of the foil, away from the shaft', &
               [(bearing%pad(i)%foil%deflection(unknown(bearing%pad(i)%first + 1:bearing%pad(i)%last), bearing%modulus(i, unknown)), &
                 i=1, size(bearing%pad))])
    end if
    if (bearing%asperities%present) then
      call add('solid_contact_pressure', 'Pa', 'of the shaft''s asperities', bearing%solid_pressure(unknown))
    end if
    call find_shown(bearing, unknown, row, value)
    do i = 1, size(row)
      call add(trim(row(i)%name), trim(row(i)%unit), trim(row(i)%meaning), value(:, i))
    end do
    if (pads > 1) then
      call block_bounds(film%grid%points, this_rank(), rank_count(), first, last)
      call add_grid_field(film%point_field, 'pad', '1', 'number of the pad', &
                          reshape([(real(before + (i - 1)/(film%grid%points/pads) + 1, wp), i=first, last)], [1, last - first + 1]))
    end if
    allocate (film%cell_field(0))
    call add_rank(bearing, film)
    grids = [grids, film]

  contains

    !> Adds a nodal field.
    subroutine add(name, unit, meaning, value)
      character(len=*), intent(in) :: name, unit, meaning
      real(wp), intent(in) :: value(:) !! at the local nodes
      real(wp), allocatable :: block(:)
      integer :: first, last, skipped

      skipped = before*(film%grid%points/pads)
      call block_bounds(film%grid%points, this_rank(), rank_count(), first, last)
      call film_block(bearing, value, skipped + first, skipped + last, block)
      call add_grid_field(film%point_field, name, unit, meaning, reshape(block, [1, size(block)]))
    end subroutine add
  end subroutine add_pads

  !> Where the stations of a bearing's pads lie along the motion, from the leading edge of the first one [m].
  pure function positions_along(bearing, pads) result(position)
    class(bearing_type), intent(in) :: bearing
    integer, intent(in) :: pads !! of a bearing
    real(wp), allocatable :: position(:)
    integer :: i

    associate (first => bearing%mesh)
      if (first%repeats > 1) then
        position = [(first%surface%radius*(first%station_angle - first%station_angle(1) + turn*real(i, wp)/real(pads, wp)), &
                     i=0, pads - 1)]
        return
      end if
      position = [(first%surface%radius*(bearing%pad(i)%whole%station_angle - first%station_angle(1)), i=1, pads)]
      if (first%periodic) position = [position, first%surface%radius*turn]
    end associate
  end function positions_along

  !> Adds the rank that has the elements; equal pads are divided alike.
  subroutine add_rank(bearing, film)
    class(bearing_type), intent(in) :: bearing
    type(result_grid_type), intent(inout) :: film

    integer, allocatable :: wanted(:), mine(:)
    real(wp), allocatable :: value(:, :)
    integer :: first, last, i, columns, column, half, rows

    associate (whole => bearing%mesh, mesh => bearing%pad(1)%mesh)
      half = whole%axial()
      columns = merge(2*half, half, whole%half)
      call block_bounds(film%grid%cells, this_rank(), rank_count(), first, last)
      allocate (wanted(last - first + 1))
      do i = first, last
        column = modulo(i - 1, columns) + 1
        if (whole%half) column = merge(column - half, half + 1 - column, column > half)
        wanted(i - first + 1) = modulo((i - 1)/columns, whole%circumferential())*half + column
      end do
      rows = whole%rows()
      mine = mesh%mesh_node(mesh%element_nodes(1, :)) ! the corner with the smallest station and row
      mine = (mine - 1)/rows*half + modulo(mine - 1, rows) + 1
      allocate (value(1, size(mine)), source=real(this_rank(), wp))
      call add_grid_field(film%cell_field, 'rank', '1', 'that computed the element', &
                          fetch_entries(whole%circumferential()*half, mine, value, wanted))
    end associate
  end subroutine add_rank
end module gfb_film_grid
