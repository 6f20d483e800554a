!> A foil as a surface with fields, over its whole width.
module gfb_foil_grid
  use gfb_kinds, only: wp
  use gfb_petsc_session, only: this_rank, rank_count, fetch_entries
  use gfb_bump_contacts, only: normal_line_force
  use gfb_contact_set, only: contact_set_type
  use gfb_foil_surface, only: foil_surface_type, surface_motion_type
  use gfb_quad_mesh, only: quad_mesh_type, solid_rows
  use gfb_grid, only: result_grid_type, block_bounds, add_grid_field
  use gfb_text, only: text
  use gfb_film_mesh, only: film_mesh_type
  use gfb_units, only: turn
  use gfb_bearing, only: bearing_type
  implicit none (type, external)
  private
  public :: create_foil_grid, add_displacement, add_contacts, add_stress, add_foil_grids

  !> sign of (u, v, w) in the other half
  real(wp), parameter :: mirror(3) = [1.0_wp, 1.0_wp, -1.0_wp]

contains

  !> Points and cells of a foil; station by station, rows of the whole width, whatever was solved.
  !> Over cuts there are no cells.
  subroutine create_foil_grid(foil, name, grid)
    class(foil_surface_type), intent(in) :: foil !! surface of shells or beams
    character(len=*), intent(in) :: name !! of the grid and its file
    type(result_grid_type), intent(out) :: grid !! with points and cells, without fields
    integer :: rows, stations, first, last, i, corner
    integer, allocatable :: node(:), kept(:)
    logical, allocatable :: mirrored(:)

    rows = full_rows(foil)
    stations = foil%mesh%stations
    grid%name = name
    grid%grid%points = stations*rows
    kept = kept_columns(foil)
    grid%grid%cells = (stations - 1)*size(kept)
    call block_bounds(grid%grid%points, this_rank(), rank_count(), first, last)
    allocate (node(last - first + 1), mirrored(last - first + 1))
    do i = first, last
      call solved_node(foil, i, node(i - first + 1), mirrored(i - first + 1))
    end do
    associate (own => pack(foil%part%mesh_node, foil%part%owned))
      grid%grid%point = fetch_entries(foil%mesh%nodes(), own, foil%mesh%position(:, own), node)
    end associate
    where (mirrored) grid%grid%point(3, :) = -grid%grid%point(3, :)
    call block_bounds(grid%grid%cells, this_rank(), rank_count(), first, last)
    allocate (grid%grid%cell(4, last - first + 1))
    do i = first, last
      corner = (i - 1)/size(kept)*rows + kept(modulo(i - 1, size(kept)) + 1)
      grid%grid%cell(:, i - first + 1) = [corner, corner + 1, corner + rows + 1, corner + rows]
    end do
    allocate (grid%point_field(0), grid%cell_field(0))
    call add_rank(foil, grid)
  end subroutine create_foil_grid

  !> Adds the rank that has the elements.
  subroutine add_rank(foil, grid)
    class(foil_surface_type), intent(in) :: foil
    type(result_grid_type), intent(inout) :: grid
    real(wp) :: mine(1, size(foil%my_elements))
    integer, allocatable :: kept(:)
    integer :: first, last, i

    mine = real(this_rank(), wp)
    kept = kept_columns(foil)
    call block_bounds(grid%grid%cells, this_rank(), rank_count(), first, last)
    call add_grid_field(grid%cell_field, 'rank', '1', 'that computed the element', &
                        fetch_entries(foil%mesh%elements(), foil%my_elements, mine, &
                                      [(solved_cell(foil, kept, i), i=first, last)]))
  end subroutine add_rank

  !> Adds the displacement vectors of this rank's nodes.
  subroutine add_displacement(foil, name, meaning, moved, grid)
    class(foil_surface_type), intent(in) :: foil !! the surface
    character(len=*), intent(in) :: name !! of the field
    character(len=*), intent(in) :: meaning !! of the field, in words
    real(wp), intent(in) :: moved(:, :) !! (5, local nodes) [m], [rad]
    type(result_grid_type), intent(inout) :: grid !! of the foil, gets the field
    call add_node_field(foil, name, 'm', meaning, moved(:3, :), grid)
  end subroutine add_displacement

  !> Adds a number, or a vector along (x, v, z), at each of this rank's nodes.
  subroutine add_node_field(foil, name, unit, meaning, value, grid)
    class(foil_surface_type), intent(in) :: foil
    character(len=*), intent(in) :: name, unit, meaning
    real(wp), intent(in) :: value(:, :) !! (1 or 3, local nodes)
    type(result_grid_type), intent(inout) :: grid

    real(wp), allocatable :: block(:, :)
    integer, allocatable :: wanted(:)
    integer :: first, last, i
    logical, allocatable :: mirrored(:)

    call block_bounds(grid%grid%points, this_rank(), rank_count(), first, last)
    allocate (wanted(last - first + 1), mirrored(last - first + 1))
    do i = first, last
      call solved_node(foil, i, wanted(i - first + 1), mirrored(i - first + 1))
    end do
    block = fetch_entries(foil%mesh%nodes(), pack(foil%part%mesh_node, foil%part%owned), &
                          own_columns(value, foil%part%owned), wanted)
    do i = 1, size(wanted)
      if (mirrored(i) .and. size(block, 1) == size(mirror)) block(:, i) = block(:, i)*mirror
    end do
    call add_grid_field(grid%point_field, name, unit, meaning, block)
  end subroutine add_node_field

  !> Adds forces and states of the contacts whose slaves are nodes of a foil.
  subroutine add_contacts(contacts, foil, grid)
    type(contact_set_type), intent(in) :: contacts !! each of one node
    class(foil_surface_type), intent(in) :: foil   !! the slaves'
    type(result_grid_type), intent(inout) :: grid !! of the foil, gets two fields
    real(wp), allocatable :: force(:, :), state(:, :)

    call contact_field(contacts, foil, force, state)
    call add_node_field(foil, 'contact_force', 'N/m', &
                        'on the foil, per length of contact line', force, grid)
    call add_node_field(foil, 'contact_state', '1', '0 open, 1 sticks, 2 slips', state, grid)
  end subroutine add_contacts

  !> Force vectors and states at this rank's nodes of the mesh.
  subroutine contact_field(contacts, foil, force, state)
    type(contact_set_type), intent(in) :: contacts
    class(foil_surface_type), intent(in) :: foil
    real(wp), allocatable, intent(out) :: force(:, :) !! (3, local nodes) along (x, v, z) [N/m]
    real(wp), allocatable, intent(out) :: state(:, :) !! (1, local nodes)
    real(wp) :: local(3)
    integer :: i, node

    allocate (force(3, size(foil%part%mesh_node)), source=0.0_wp)
    allocate (state(1, size(foil%part%mesh_node)), source=0.0_wp)
    do i = 1, size(contacts%point)
      associate (point => contacts%point(i))
        node = foil%local_node(point%node)
        local = [point%force(:2)/point%length, normal_line_force(contacts, i)]
        force(:, node) = matmul(point%frame, local)
        state(1, node) = real(contacts%state_of(i), wp)
      end associate
    end do
  end subroutine contact_field

  !> Adds the stresses at the elements' centres.
  subroutine add_stress(foil, stress, grid)
    class(foil_surface_type), intent(in) :: foil !! the surface
    real(wp), intent(in) :: stress(:, :) !! (8, elements of this rank), see `gfb_foil_stress` [Pa]
    type(result_grid_type), intent(inout) :: grid !! of the foil, gets four fields
    real(wp), allocatable :: block(:, :)
    integer, allocatable :: wanted(:), kept(:)
    integer :: first, last, i

    kept = kept_columns(foil)
    call block_bounds(grid%grid%cells, this_rank(), rank_count(), first, last)
    wanted = [(solved_cell(foil, kept, i), i=first, last)]
    block = fetch_entries(foil%mesh%elements(), foil%my_elements, stress, wanted)
    call add_grid_field(grid%cell_field, 'membrane_stress', 'Pa', &
                        'at the centre: along the axis, across it, shear', block(1:3, :))
    call add_grid_field(grid%cell_field, 'bending_stress', 'Pa', &
                        'half of upper less lower face: along the axis, across it, shear', &
                        block(4:6, :))
    call add_grid_field(grid%cell_field, 'von_mises_lower', 'Pa', 'von Mises stress, sleeve side', &
                        block(7:7, :))
    call add_grid_field(grid%cell_field, 'von_mises_upper', 'Pa', 'von Mises stress, shaft side', &
                        block(8:8, :))
  end subroutine add_stress

  !> Columns of a matrix that a mask picks.
  pure function own_columns(values, mask) result(picked)
    real(wp), intent(in) :: values(:, :)
    logical, intent(in) :: mask(:)
    real(wp) :: picked(size(values, 1), count(mask))
    integer :: i, n

    n = 0
    do i = 1, size(mask)
      if (.not. mask(i)) cycle
      n = n + 1
      picked(:, n) = values(:, i)
    end do
  end function own_columns

  !> Rows of the whole width.
  pure integer function full_rows(foil) result(rows)
    class(foil_surface_type), intent(in) :: foil
    rows = foil%mesh%rows
    if (foil%mesh%half) rows = 2*rows - 1
  end function full_rows

  !> Rows of elements of the whole width that are not cut away.
  pure function kept_columns(foil) result(kept)
    class(foil_surface_type), intent(in) :: foil
    integer, allocatable :: kept(:)
    logical :: solid(full_rows(foil) - 1)
    integer :: i

    associate (solved => solid_rows(foil%mesh))
      if (foil%mesh%half) then
        solid = [solved(size(solved):1:-1), solved]
      else
        solid = solved
      end if
    end associate
    kept = pack([(i, i=1, size(solid))], solid)
  end function kept_columns

  !> The solved node that a point of the whole width is, or mirrors.
  pure subroutine solved_node(foil, point, node, mirrored)
    class(foil_surface_type), intent(in) :: foil
    integer, intent(in) :: point !! from 1
    integer, intent(out) :: node
    logical, intent(out) :: mirrored
    integer :: rows, row

    rows = full_rows(foil)
    row = modulo(point - 1, rows) + 1
    mirrored = foil%mesh%half .and. row < foil%mesh%rows
    if (foil%mesh%half) row = abs(row - foil%mesh%rows) + 1
    node = (point - 1)/rows*foil%mesh%rows + row
  end subroutine solved_node

  !> The solved element that a cell of the whole width is, or mirrors.
  pure integer function solved_cell(foil, kept, cell) result(element)
    class(foil_surface_type), intent(in) :: foil
    integer, intent(in) :: kept(:) !! of `kept_columns`
    integer, intent(in) :: cell    !! from 1
    integer :: half, column

    half = foil%mesh%rows - 1
    column = kept(modulo(cell - 1, size(kept)) + 1)
    if (foil%mesh%half) column = merge(column - half, half + 1 - column, column > half)
    element = (cell - 1)/size(kept)*half + column
  end function solved_cell

  !> Adds the surfaces that the foil has at the present state, of several pads under names with their numbers; a foil
  !> without a mesh has none.
  subroutine add_foil_grids(bearing, grids)
    class(bearing_type), intent(in) :: bearing !! at the state to be written
    type(result_grid_type), allocatable, intent(inout) :: grids(:) !! to be written

    type(foil_surface_type), allocatable :: surface(:)
    type(surface_motion_type), allocatable :: motion(:)
    type(result_grid_type) :: grid
    real(wp) :: unknown(bearing%local_size())
    character(len=:), allocatable :: behind !! the surface's name
    real(wp) :: level !! of the top foil's mid-surface over the sleeve [m]
    integer :: i, k, copy, copies

    call bearing%get_unknowns(unknown)
    surface = bearing%foil_surfaces()
    if (size(surface) == 0) return
    behind = ''
    level = 0.0_wp ! a rank without a part of the foils writes none
    associate (top => surface(findloc(surface%lies_on_film, .true., dim=1))%mesh%position)
      if (size(top, 2) > 0) level = top(2, 1) ! it is flat
    end associate
    copies = bearing%mesh%repeats
    do k = 1, size(bearing%pad)
      associate (pad => bearing%pad(k))
        if (size(bearing%pad) > 1) behind = '_'//text(k)
        motion = pad%foil%motions(unknown(pad%first + 1:pad%last), bearing%modulus(k, unknown))
        do i = 1, size(surface)
          call create_foil_grid(surface(i), surface(i)%name//behind, grid)
          grid%grid%point(3, :) = grid%grid%point(3, :) + pad%film%surface%offset*pad%film%surface%cosine
          call add_displacement(surface(i), 'displacement', 'of the mid-surface', motion(i)%displacement, grid)
          call add_stress(surface(i), motion(i)%stress, grid)
          if (surface(i)%has_contacts) call add_contacts(pad%foil%nodal_contacts(), surface(i), grid)
          do copy = 1, merge(copies, 0, pad%whole%surface%is_ring())
            if (copies > 1) behind = '_'//text((k - 1)*copies + copy)
            grids = [grids, grid_in_space(grid, surface(i)%name//behind, surface(i)%mesh, pad%whole, level, &
                                          turn*real(copy - 1, wp)/real(copies, wp))]
          end do
          if (.not. pad%whole%surface%is_ring()) grids = [grids, grid]
        end do
      end associate
    end do
  end subroutine add_foil_grids

  !> A sector's surface where it lies in space, its upper face towards the runner and the top foil's mid-surface in the film's
  !> plane: rays and circles of its mesh rolled up, or a flat mesh laid along the ray in its middle.
  function grid_in_space(grid, name, mesh, film, level, further) result(placed)
    type(result_grid_type), intent(in) :: grid !! in the mesh's own directions
    character(len=*), intent(in) :: name !! of the grid and its file
    type(quad_mesh_type), intent(in) :: mesh !! of it
    type(film_mesh_type), intent(in) :: film !! over it
    real(wp), intent(in) :: level   !! of the top foil's mid-surface over the sleeve [m]
    real(wp), intent(in) :: further !! turn of a pad for which this one stands [rad]
    type(result_grid_type) :: placed
    real(wp) :: angle, turned(3, 3), aside !! of the ray that a point's directions follow [m]
    integer :: i, k

    placed = grid
    placed%name = name
    do i = 1, size(grid%grid%point, 2)
      if (mesh%ring_radius > 0.0_wp) then
        angle = film%station_angle(1) + grid%grid%point(1, i)/mesh%ring_radius + further
        aside = 0.0_wp
      else
        angle = 0.5_wp*(film%station_angle(1) + film%station_angle(film%stations())) + further
        aside = grid%grid%point(1, i) - mesh%middle
      end if
      turned(:, 1) = [-sin(angle), cos(angle), 0.0_wp]
      turned(:, 2) = [0.0_wp, 0.0_wp, film%surface%facing]
      turned(:, 3) = [cos(angle), sin(angle), 0.0_wp]
      placed%grid%point(:, i) = matmul(turned, [aside, grid%grid%point(2, i) - level, grid%grid%point(3, i)]) &
                                + [0.0_wp, 0.0_wp, film%surface%offset]
      do k = 1, size(placed%point_field)
        associate (block => placed%point_field(k)%block)
          if (size(block, 1) == size(turned, 1)) block(:, i) = matmul(turned, block(:, i))
        end associate
      end do
    end do
  end function grid_in_space
end module gfb_foil_grid
