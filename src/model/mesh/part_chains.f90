!> What film and bump foil are made of when they are cut into parts, and what the parts mean for
!> columns of elements.
module gfb_part_chains
  use gfb_kinds, only: wp
  use gfb_units, only: turn
  use gfb_shell_geometry, only: node_unknowns
  use gfb_film_mesh, only: film_mesh_type
  use gfb_foil_mesh, only: strip_shape_type, dividing_stations, station_positions, &
                           bump_strip_mesh, strip_substructures
  use gfb_quad_mesh, only: quad_mesh_type
  use gfb_substructures, only: substructure_type, find_kinds
  use gfb_partition, only: chain_type, chain
  implicit none (type, external)
  private
  public :: film_chain, film_columns, strip_chain, column_chain, strip_columns, strip_kinds

contains

  !> Columns of the film's elements, and of the top foil of shells below them where there is one.
  pure function film_chain(film, shells) result(columns)
    type(film_mesh_type), intent(in) :: film !! the film's mesh
    logical, intent(in) :: shells !! on a top foil of shells
    type(chain_type) :: columns
    real(wp), allocatable :: bound(:), weight(:)

    bound = film%surface%radius*(film%station_angle - film%station_angle(1))
    if (film%periodic) bound = [bound, film%surface%radius*turn]
    bound = bound(1::film%order)
    allocate (weight(size(bound) - 1))
    weight = real(film%order*film%rows()*merge(1 + node_unknowns, 1, shells), wp)
    columns = chain(bound, weight, film%periodic)
  end function film_chain

  !> Part of every column of the film's cells from the parts of its elements' columns.
  pure function film_columns(film, part) result(column_part)
    type(film_mesh_type), intent(in) :: film !! the film's mesh
    integer, intent(in) :: part(:) !! of the chain's pieces
    integer :: column_part(film%order*size(part)), i
    column_part = [(spread(part(i), 1, film%order), i=1, size(part))]
  end function film_columns

  !> Substructures of a bump foil, or its columns where it is not condensed.
  pure function strip_chain(shape, rows, reduced) result(pieces)
    type(strip_shape_type), intent(in) :: shape !! the strip's shape
    integer, intent(in) :: rows    !! nodes of a station
    logical, intent(in) :: reduced !! substructures are condensed
    type(chain_type) :: pieces
    real(wp), allocatable :: x(:)

    x = station_positions(shape)
    if (reduced) x = x(dividing_stations(shape))
    pieces = column_chain(x, rows)
  end function strip_chain

  !> Columns of shells, or what is condensed onto as many unknowns.
  pure function column_chain(bound, rows) result(columns)
    real(wp), intent(in) :: bound(:) !! of the columns, rising [m]
    integer, intent(in) :: rows      !! nodes of a station
    type(chain_type) :: columns
    columns = chain(bound, spread(real(node_unknowns*rows, wp), 1, size(bound) - 1), .false.)
  end function column_chain

  !> Part of every column of a bump foil from the parts of its chain.
  pure function strip_columns(shape, reduced, part) result(column_part)
    type(strip_shape_type), intent(in) :: shape !! the strip's shape
    logical, intent(in) :: reduced !! bumps are condensed
    integer, intent(in) :: part(:) !! of the chain's pieces
    integer, allocatable :: column_part(:), divide(:)
    integer :: i

    column_part = part
    if (.not. reduced) return
    divide = dividing_stations(shape)
    deallocate (column_part)
    allocate (column_part(divide(size(divide)) - 1))
    do i = 1, size(part)
      column_part(divide(i):divide(i + 1) - 1) = part(i)
    end do
  end function strip_columns

  !> Kinds of a strip's substructures, seen on two of its rows: along the axis all rows are alike.
  pure function strip_kinds(shape, rows, half) result(kind)
    type(strip_shape_type), intent(in) :: shape !! the strip's shape
    real(wp), intent(in) :: rows(:) !! z [m]
    logical, intent(in) :: half     !! rows begin at z = 0
    integer, allocatable :: kind(:)
    type(quad_mesh_type) :: spine
    type(substructure_type), allocatable :: piece(:)
    logical, allocatable :: fixed(:, :)

    spine = bump_strip_mesh(shape, rows(:2), half)
    piece = strip_substructures(shape, spine)
    ! Supports inside are those of the symmetry, the same for all.
    allocate (fixed(node_unknowns, spine%nodes()), source=.false.)
    call find_kinds(spine, fixed, piece)
    kind = piece%kind
  end function strip_kinds
end module gfb_part_chains
