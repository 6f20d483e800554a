!> Meshes of the bump strip and the top foil, unrolled.
!>
!> Stations follow each other along x, rows along z; node (station i, row j) is number
!> (i - 1)*rows + j, wherever the strip is fixed. A rank needs a stretch of the stations only.
!>
!> Under a sector stations are rays: at the radius r the arc is wider by r/r_m, and as high, so that
!> normals lean as much less. Everything repeats under a turn.
!>
!> Rows of strips side by side along the axis, and where they are cut apart.
!>
!> Strips side by side with bumps of their own, as one mesh.
!>
!> All strips have as many bumps, and as many stations: a station is the same place of a bump on
!> every strip, at an x of the strip's own. So what counts stations and rows alone holds for all of
!> them: node sets, substructures, and how ranks share them.
module gfb_foil_mesh
  use gfb_kinds, only: wp
  use gfb_quad_mesh, only: quad_mesh_type, add_node_set, solid_rows, corner_face
  use gfb_film_mesh, only: film_mesh_type
  use gfb_fixed_lines, only: fixed_line_corner, fixed_line_flat, fixed_line_half_flat
  use gfb_text, only: text
  use gfb_substructures, only: substructure_type
  use gfb_bump_profile, only: arc_point, arc_normal
  implicit none (type, external)
  private
  public :: strip_rows, cut_rows, strips_of_rows, put_strip, join_kinds, top_mesh, &
            bump_strip_mesh, strip_substructures, top_foil_mesh, crest_positions, &
            station_positions, dividing_stations

  real(wp), parameter :: rounding = 1.0e-9_wp !! of lengths that fit exactly, relative

  !> One bump: an arc and the flat that follows it.
  type, public :: bump_type
    real(wp) :: half_length = 0.0_wp !! half the chord of the arc [m]
    real(wp) :: height = 0.0_wp      !! of the crest above the flats' mid-surface [m]
    real(wp) :: pitch = 0.0_wp       !! arc and flat [m]
    real(wp) :: thickness = 0.0_wp   !! of arc and flat; 0: that of all [m]
  end type bump_type

  !> A strip: its bumps from the fixed edge on, how it begins there, how finely it is meshed.
  type, public :: strip_shape_type
    type(bump_type), allocatable :: bump(:)  !! in order from the fixed edge
    integer :: begins = fixed_line_corner    !! how, at its fixed edge
    logical :: mirrored = .false.            !! the fixed edge is the one at the largest x
    real(wp) :: edge = 0.0_wp                !! x of the fixed edge [m]
    real(wp) :: ring_radius = 0.0_wp         !! of a sector, where x is measured; 0: none [m]
    real(wp) :: middle = 0.0_wp              !! of a straight one: x in the sector's middle [m]
    real(wp) :: mean_radius = 0.0_wp         !! of a sector's strip: its sizes are there [m]
    integer :: arc_elements = 12             !! even, so that a node lies on the crest
    integer :: flat_elements = 3
  end type strip_shape_type

  !> What happens at a station, from the fixed edge on.
  type :: station_type
    real(wp) :: along = 0.0_wp       !! distance from the fixed edge [m]
    real(wp) :: height = 0.0_wp      !! v [m]
    real(wp) :: normal(2, 2) = 0.0_wp !! of the element before and the one after, (x, v) each [1]
    integer :: crest = 0             !! bump whose crest it is, from the fixed edge; 0: none
    integer :: corner = 0            !! bump whose corner it is; 0: none
    real(wp) :: thickness = 0.0_wp   !! of the element before it; 0: that of all [m]
    logical :: divides = .false.     !! substructures meet or end here
  end type station_type

contains

  !> Rows of equal strips side by side, symmetric about z = 0 to the last digit: equal elements on
  !> each, its share of all, none over the cuts; one row in the middle of a cut at z = 0.
  pure function strip_rows(width, axial, half, strips, cut) result(rows)
    real(wp), intent(in) :: width !! whole width, cuts included [m]
    integer, intent(in) :: axial  !! elements over the whole width, about
    logical, intent(in) :: half   !! z >= 0 only
    integer, intent(in) :: strips !! more than one
    real(wp), intent(in) :: cut   !! width of each cut [m]
    real(wp), allocatable :: rows(:)
    real(wp) :: strip !! width of each [m]
    integer :: elements, i, k

    strip = strip_width(width, strips, cut)
    elements = max(1, nint(real(axial, wp)/real(strips, wp)))
    if (modulo(strips, 2) == 1 .and. modulo(axial, 2) == 0) then ! a row lies at z = 0
      elements = 2*max(1, nint(0.5_wp*real(axial, wp)/real(strips, wp)))
    end if
    allocate (rows(0))
    do k = 1, strips
      rows = [rows, (0.5_wp*(strip + cut)*real(2*k - 1 - strips, wp) + &
                     0.5_wp*strip*real(2*i - elements, wp)/real(elements, wp), i=0, elements)]
      if (2*k == strips) rows = [rows, 0.0_wp]
    end do
    if (half) rows = pack(rows, rows >= 0.0_wp)
  end function strip_rows

  !> Which rows of elements are cut away.
  pure function cut_rows(rows, width, strips, cut) result(is_cut)
    real(wp), intent(in) :: rows(:) !! of `strip_rows` [m]
    real(wp), intent(in) :: width   !! whole width, cuts included [m]
    integer, intent(in) :: strips   !! more than one
    real(wp), intent(in) :: cut     !! width of each cut [m]
    logical :: is_cut(size(rows) - 1)
    real(wp) :: strip, middle(size(rows) - 1)

    strip = strip_width(width, strips, cut)
    middle = 0.5_wp*(rows(2:) + rows(:size(rows) - 1))
    is_cut = modulo(middle + 0.5_wp*width, strip + cut) > strip
  end function cut_rows

  !> Strip of each row of nodes, from the smallest z on; one in the middle of a cut has either.
  pure function strips_of_rows(rows, width, strips, cut) result(strip)
    real(wp), intent(in) :: rows(:) !! of `strip_rows` [m]
    real(wp), intent(in) :: width   !! whole width, cuts included [m]
    integer, intent(in) :: strips   !! more than one
    real(wp), intent(in) :: cut     !! width of each cut [m]
    integer :: strip(size(rows))

    strip = 1 + floor((rows + 0.5_wp*(width + cut))/(strip_width(width, strips, cut) + cut))
    strip = min(max(strip, 1), strips)
  end function strips_of_rows

  !> Width of one of equal strips [m].
  pure real(wp) function strip_width(width, strips, cut) result(strip)
    real(wp), intent(in) :: width, cut !! of all, of each cut [m]
    integer, intent(in) :: strips
    strip = (width - real(strips - 1, wp)*cut)/real(strips, wp)
  end function strip_width

  !> Gives the rows of a strip the shape that they have on another mesh of as many stations.
  pure subroutine put_strip(mesh, other, strip)
    type(quad_mesh_type), intent(inout) :: mesh !! of all strips, with `row_strip`
    type(quad_mesh_type), intent(in) :: other !! the same stretch, as if all rows were the strip's
    integer, intent(in) :: strip !! its number
    integer :: node, element, row

    do node = lbound(mesh%position, 2), ubound(mesh%position, 2)
      if (mesh%row_strip(modulo(node - 1, mesh%rows) + 1) /= strip) cycle
      mesh%position(:, node) = other%position(:, node)
      mesh%axis_1(:, node) = other%axis_1(:, node)
      mesh%axis_2(:, node) = other%axis_2(:, node)
      mesh%face(:, node) = other%face(:, node)
    end do
    do element = lbound(mesh%element_nodes, 2), ubound(mesh%element_nodes, 2)
      row = modulo(element - 1, mesh%rows - 1) + 1 ! over a cut nothing asks for it
      if (mesh%row_strip(row) == strip) mesh%director(:, :, element) = other%director(:, :, element)
    end do
  end subroutine put_strip

  !> Distinguishes pieces that differ on one more strip.
  pure subroutine join_kinds(kind, other)
    integer, intent(inout) :: kind(:) !! of the pieces, numbered in order of their first
    integer, intent(in) :: other(:)   !! their kinds on the other strip
    integer :: joined(size(kind)), i, k, kinds

    kinds = 0
    do i = 1, size(kind)
      do k = 1, i - 1
        if (kind(k) == kind(i) .and. other(k) == other(i)) exit
      end do
      if (k < i) then
        joined(i) = joined(k)
      else
        kinds = kinds + 1
        joined(i) = kinds
      end if
    end do
    kind = joined
  end subroutine join_kinds

  !> The top foil on the film's nodes, unrolled: x = R (theta - theta_0). Of a sector over straight
  !> strips it is flat, z along the ray in its middle, where they have their directions.
  pure function top_mesh(film, height, window, middle) result(mesh)
    type(film_mesh_type), intent(in) :: film   !! the film's mesh
    real(wp), intent(in) :: height             !! of the mid-surface above the flats' [m]
    integer, intent(in), optional :: window(2) !! first and last station; default: all
    !> x of that ray, over straight strips; 0, as by default: there are none [m]
    real(wp), intent(in), optional :: middle
    type(quad_mesh_type) :: mesh
    real(wp) :: turned !! from the pad's middle [rad]
    integer :: node

    mesh = top_foil_mesh(film%surface%radius*(film%station_angle - film%station_angle(1)), height, &
                         film%row_axial, film%half, window)
    if (film%surface%is_ring()) mesh%ring_radius = film%surface%radius
    if (present(middle)) mesh%middle = middle
    if (.not. mesh%middle > 0.0_wp) return
    mesh%ring_radius = 0.0_wp
    do node = lbound(mesh%position, 2), ubound(mesh%position, 2)
      turned = film%station_angle((node - 1)/mesh%rows + 1) &
               - 0.5_wp*(film%station_angle(1) + film%station_angle(film%stations()))
      mesh%position(1::2, node) = film%row_axial(modulo(node - 1, mesh%rows) + 1)* &
                                  [sin(turned), cos(turned)]
      mesh%position(1, node) = mesh%middle + mesh%position(1, node)
    end do
  end function top_mesh

  !> The strip's mesh with the sets crest_<n>, corner_<n>, crests, corners, leading_edge,
  !> trailing_edge, fixed_edge, free_edge, midplane; crest_1 and corner_1 lie at the smallest x.
  pure function bump_strip_mesh(shape, rows, half, window) result(mesh)
    type(strip_shape_type), intent(in) :: shape !! the strip's shape
    real(wp), intent(in) :: rows(:) !! z [m]
    logical, intent(in) :: half     !! rows begin at z = 0
    !> first and last station of the stretch; default: all
    integer, intent(in), optional :: window(2)
    type(quad_mesh_type) :: mesh
    type(station_type), allocatable :: station(:)

    station = strip_stations(shape)
    mesh = station_mesh(station, shape%edge, shape%mirrored, rows, half, window, &
                        shape%mean_radius)
    mesh%ring_radius = shape%ring_radius
    mesh%middle = shape%middle
    call name_sets(mesh, station, shape)
  end function bump_strip_mesh

  !> Stations of a strip where its substructures meet or end, rising.
  pure function dividing_stations(shape) result(divide)
    type(strip_shape_type), intent(in) :: shape !! the strip's shape
    integer, allocatable :: divide(:)
    type(station_type), allocatable :: station(:)
    integer :: i

    station = strip_stations(shape)
    divide = pack([(i, i=1, size(station))], station%divides)
    if (shape%mirrored) divide = size(station) + 1 - divide(size(divide):1:-1)
  end function dividing_stations

  !> Where the stations of a strip are, from the smallest x on [m].
  pure function station_positions(shape) result(x)
    type(strip_shape_type), intent(in) :: shape !! the strip's shape
    real(wp), allocatable :: x(:)
    type(station_type), allocatable :: station(:)

    station = strip_stations(shape)
    x = shape%edge + merge(-1.0_wp, 1.0_wp, shape%mirrored)*station%along
    if (shape%mirrored) x = x(size(x):1:-1)
  end function station_positions

  !> The strip's pieces between its corners and crests, from the smallest x on; those outside the
  !> mesh's stretch have no nodes.
  pure function strip_substructures(shape, mesh) result(pieces)
    type(strip_shape_type), intent(in) :: shape !! the strip's shape
    type(quad_mesh_type), intent(in) :: mesh !! the foil's mesh
    type(substructure_type), allocatable :: pieces(:)
    integer, allocatable :: divide(:)
    integer :: i, n, first, last

    divide = dividing_stations(shape)
    allocate (pieces(size(divide) - 1))
    do i = 1, size(pieces)
      first = (divide(i) - 1)*mesh%rows + 1
      last = divide(i + 1)*mesh%rows
      if (first < lbound(mesh%position, 2) .or. last > ubound(mesh%position, 2)) last = first - 1
      pieces(i)%column = divide(i)
      pieces(i)%nodes = numbers(first, last)
      allocate (pieces(i)%retained(size(pieces(i)%nodes)), source=.false.)
      pieces(i)%elements = numbers(1, 0)
      if (last < first) cycle
      pieces(i)%retained(:mesh%rows) = .true.
      pieces(i)%retained(size(pieces(i)%nodes) - mesh%rows + 1:) = .true.
      pieces(i)%elements = numbers((divide(i) - 1)*(mesh%rows - 1) + 1, &
        (divide(i + 1) - 1)*(mesh%rows - 1))
      if (allocated(mesh%cut)) pieces(i)%elements = &
        pack(pieces(i)%elements, [(solid_rows(mesh), n=divide(i), divide(i + 1) - 1)])
    end do
  end function strip_substructures

  !> Where the crests of a strip are, from the smallest x on [m].
  pure function crest_positions(shape) result(x)
    type(strip_shape_type), intent(in) :: shape !! the strip's shape
    real(wp), allocatable :: x(:)
    type(station_type), allocatable :: station(:)

    station = strip_stations(shape)
    x = shape%edge + merge(-1.0_wp, 1.0_wp, shape%mirrored)*pack(station%along, station%crest > 0)
    if (shape%mirrored) x = x(size(x):1:-1)
  end function crest_positions

  !> A flat plate with given stations; sets leading_edge, trailing_edge, midplane.
  pure function top_foil_mesh(position_x, height, rows, half, window) result(mesh)
    real(wp), intent(in) :: position_x(:) !! of the stations [m]
    real(wp), intent(in) :: height        !! v of the mid-surface [m]
    real(wp), intent(in) :: rows(:)       !! z [m]
    logical, intent(in) :: half           !! rows begin at z = 0
    !> first and last station of the stretch; default: all
    integer, intent(in), optional :: window(2)
    type(quad_mesh_type) :: mesh
    type(station_type) :: station(size(position_x))
    integer :: i

    do i = 1, size(station)
      station(i)%along = position_x(i) - position_x(1)
      station(i)%height = height
      station(i)%normal = reshape([0.0_wp, 1.0_wp, 0.0_wp, 1.0_wp], [2, 2])
    end do
    mesh = station_mesh(station, position_x(1), .false., rows, half, window)
    call add_node_set(mesh, 'leading_edge', line_at(mesh, 1))
    call add_node_set(mesh, 'trailing_edge', line_at(mesh, size(station)))
    call add_midplane(mesh)
  end function top_foil_mesh

  !> Stations of a strip from its fixed edge on.
  pure function strip_stations(shape) result(station)
    type(strip_shape_type), intent(in) :: shape
    type(station_type), allocatable :: station(:)
    type(station_type) :: list(2 + size(shape%bump)*(shape%arc_elements + shape%flat_elements + 2))
    real(wp) :: flat(size(shape%bump))
    integer :: n, i

    n = 1
    list(1)%divides = .true.
    list(1)%normal = reshape([0.0_wp, 1.0_wp, 0.0_wp, 1.0_wp], [2, 2])
    flat = shape%bump%pitch - 2.0_wp*shape%bump%half_length
    where (flat <= rounding*shape%bump%pitch) flat = 0.0_wp
    associate (bump => shape%bump, bumps => size(shape%bump), whole => shape%flat_elements, &
               half => (shape%flat_elements + 1)/2)
      if (shape%begins == fixed_line_half_flat) then
        call add_flat(list, n, 0.5_wp*flat(1), half, bump(1)%thickness)
      end if
      do i = 1, bumps
        if (shape%begins == fixed_line_flat) then
          call add_flat(list, n, flat(i), whole, bump(i)%thickness)
        end if
        call add_arc(list, n, bump(i), shape%arc_elements, i)
        if (shape%begins == fixed_line_corner) then
          call add_flat(list, n, flat(i), whole, bump(i)%thickness)
        else if (shape%begins == fixed_line_half_flat .and. i < bumps) then
          call add_flat(list, n, 0.5_wp*(flat(i) + flat(i + 1)), whole, &
                        0.5_wp*(bump(i)%thickness + bump(i + 1)%thickness))
        end if
      end do
      if (shape%begins == fixed_line_half_flat) then
        call add_flat(list, n, 0.5_wp*flat(bumps), half, bump(bumps)%thickness)
      end if
    end associate
    list(n)%divides = .true.
    station = list(:n)
    if (.not. shape%ring_radius > 0.0_wp) return
    station%along = shape%ring_radius/shape%mean_radius*station%along
  end function strip_stations

  !> Adds the stations of an arc.
  pure subroutine add_arc(station, n, bump, elements, number)
    type(station_type), intent(inout) :: station(:)
    integer, intent(inout) :: n          !! stations so far
    type(bump_type), intent(in) :: bump
    integer, intent(in) :: elements, number
    real(wp) :: point(2), begin, fraction
    integer :: k

    begin = station(n)%along
    station(n)%corner = number
    station(n)%divides = .true.
    station(n)%normal(:, 2) = arc_normal(bump%half_length, bump%height, 0.0_wp)
    if (n == 1) station(n)%normal(:, 1) = station(n)%normal(:, 2)
    do k = 1, elements
      n = n + 1
      fraction = real(k, wp)/real(elements, wp)
      point = arc_point(bump%half_length, bump%height, fraction)
      station(n)%along = begin + point(1)
      station(n)%height = point(2)
      station(n)%thickness = bump%thickness
      station(n)%normal = spread(arc_normal(bump%half_length, bump%height, fraction), 2, 2)
      if (2*k == elements) station(n)%crest = number
      station(n)%divides = 2*k == elements .or. k == elements
    end do
    station(n)%corner = number
  end subroutine add_arc

  !> Adds the stations of a flat; none where it has no length.
  pure subroutine add_flat(station, n, length, elements, thickness)
    type(station_type), intent(inout) :: station(:)
    integer, intent(inout) :: n       !! stations so far
    real(wp), intent(in) :: length    !! [m]
    integer, intent(in) :: elements
    real(wp), intent(in) :: thickness !! 0: that of all [m]
    real(wp), parameter :: up(2) = [0.0_wp, 1.0_wp]
    real(wp) :: begin
    integer :: k

    if (.not. length > 0.0_wp) return
    begin = station(n)%along
    station(n)%normal(:, 2) = up
    do k = 1, elements
      n = n + 1
      station(n)%along = begin + length*real(k, wp)/real(elements, wp)
      station(n)%normal = spread(up, 2, 2)
      station(n)%thickness = thickness
      station(n)%divides = k == elements
    end do
  end subroutine add_flat

  !> Nodes, elements and directors over stations and rows.
  pure function station_mesh(station, edge, mirrored, rows, half, window, mean_radius) &
    result(mesh)
    type(station_type), intent(in) :: station(:)
    real(wp), intent(in) :: edge     !! x of the first station [m]
    logical, intent(in) :: mirrored  !! stations run towards smaller x
    real(wp), intent(in) :: rows(:)  !! z [m]
    logical, intent(in) :: half
    !> first and last station of the stretch; default: all
    integer, intent(in), optional :: window(2)
    !> of a sector, at which the normals are; 0, as by default: none [m]
    real(wp), intent(in), optional :: mean_radius
    type(quad_mesh_type) :: mesh
    real(wp) :: x(size(station)), v(size(station)), normal(2, 2, size(station))
    real(wp) :: lean(size(rows)) ! of the normals on each row
    logical :: kink(size(station))
    integer :: i, j, first, last, stretch(2)

    stretch = [1, size(station)]
    if (present(window)) stretch = window
    first = stretch(1)
    last = stretch(2)
    v = station%height
    kink = station%corner > 0
    do i = 1, size(station)
      normal(:, :, i) = station(i)%normal
    end do
    x = edge + merge(-1.0_wp, 1.0_wp, mirrored)*station%along
    if (mirrored) then
      x = x(size(x):1:-1)
      v = v(size(v):1:-1)
      kink = kink(size(kink):1:-1)
      normal = normal(:, 2:1:-1, size(x):1:-1)
      normal(1, :, :) = -normal(1, :, :)
    end if
    if (any(station%thickness > 0.0_wp)) then
      mesh%column_thickness = station(2:)%thickness
      if (mirrored) mesh%column_thickness = station(size(x):2:-1)%thickness
    end if
    mesh%rows = size(rows)
    mesh%stations = size(x)
    mesh%half = half
    mesh%row_axial = rows
    associate (before => (first - 1)*mesh%rows + 1)
      allocate (mesh%position(3, before:last*mesh%rows), mesh%axis_1(3, before:last*mesh%rows))
      allocate (mesh%axis_2(3, before:last*mesh%rows), mesh%face(2, before:last*mesh%rows))
    end associate
    lean = 1.0_wp
    if (present(mean_radius)) then
      if (mean_radius > 0.0_wp) lean = mean_radius/rows
    end if
    do i = first, last
      do j = 1, size(rows)
        mesh%position(:, (i - 1)*mesh%rows + j) = [x(i), v(i), rows(j)]
        call put_axes(mesh, (i - 1)*mesh%rows + j, leaning(normal(:, :, i), lean(j)), kink(i))
      end do
    end do
    call put_elements(mesh, first, last, normal, lean)
  end function station_mesh

  !> Elements and directors of a stretch of stations.
  pure subroutine put_elements(mesh, first, last, normal, lean)
    type(quad_mesh_type), intent(inout) :: mesh
    integer, intent(in) :: first, last       !! stations
    real(wp), intent(in) :: normal(:, :, :)  !! (2, 2, stations) of elements before and after [1]
    real(wp), intent(in) :: lean(:)          !! of the rows [1]
    real(wp) :: there(2, 2)
    integer :: i, j, element, here, corner

    element = (first - 1)*(mesh%rows - 1)
    ! gfortran copies an array without elements only if its bounds are one apart.
    here = max(element, (last - 1)*(mesh%rows - 1))
    allocate (mesh%element_nodes(4, element + 1:here))
    allocate (mesh%director(3, 4, element + 1:here), source=0.0_wp)
    do i = first, last - 1
      do j = 1, mesh%rows - 1
        element = element + 1
        here = (i - 1)*mesh%rows + j
        ! Seen from the shaft, with x to the right, z points down the page.
        mesh%element_nodes(:, element) = [here, here + 1, here + mesh%rows + 1, here + mesh%rows]
        do corner = 0, 1
          there = leaning(normal(:, :, i), lean(j + corner))
          mesh%director(:2, 1 + corner, element) = there(:, 2)
          there = leaning(normal(:, :, i + 1), lean(j + corner))
          mesh%director(:2, 4 - corner, element) = there(:, 1)
        end do
      end do
    end do
  end subroutine put_elements

  !> Normals on a row: under a sector they lean less outside.
  pure function leaning(normal, lean) result(there)
    real(wp), intent(in) :: normal(2, 2) !! of the elements before and after, (x, v) each [1]
    real(wp), intent(in) :: lean         !! slope there over theirs [1]
    real(wp) :: there(2, 2)
    integer :: side

    there = normal
    if (.not. abs(lean - 1.0_wp) > 0.0_wp) return
    there(1, :) = lean*normal(1, :)
    do side = 1, 2
      there(:, side) = there(:, side)/norm2(there(:, side))
    end do
  end function leaning

  !> Rotation axes of a node, and where its upper face is.
  pure subroutine put_axes(mesh, node, normal, kink)
    type(quad_mesh_type), intent(inout) :: mesh
    integer, intent(in) :: node
    real(wp), intent(in) :: normal(2, 2) !! of the elements before and after, (x, v) each [1]
    logical, intent(in) :: kink
    real(wp) :: mean(2)

    mean = normal(:, 1)
    mesh%face(:, node) = merge(corner_face(normal), mean, kink)
    ! At corners the flat's, also at an end without a flat: pieces stay congruent.
    if (kink) mean = [0.0_wp, 1.0_wp]
    mesh%axis_1(:, node) = [0.0_wp, 0.0_wp, 1.0_wp]
    mesh%axis_2(:, node) = [mean(2), -mean(1), 0.0_wp] ! normal x axis_1
  end subroutine put_axes

  !> Names the lines of a strip.
  pure subroutine name_sets(mesh, station, shape)
    type(quad_mesh_type), intent(inout) :: mesh
    type(station_type), intent(in) :: station(:)
    type(strip_shape_type), intent(in) :: shape
    integer, allocatable :: crests(:), corners(:), line(:)
    integer :: number, i, stations, crest, corner

    stations = size(station)
    crest = 0
    corner = 0
    allocate (crests(0), corners(0))
    do number = 1, stations
      i = merge(stations + 1 - number, number, shape%mirrored)
      line = line_at(mesh, number)
      if (station(i)%crest > 0) then
        crest = crest + 1
        crests = [crests, line]
        call add_node_set(mesh, 'crest_'//text(crest), line)
      else if (station(i)%corner > 0) then
        corner = corner + 1
        corners = [corners, line]
        call add_node_set(mesh, 'corner_'//text(corner), line)
      end if
    end do
    call add_node_set(mesh, 'crests', crests)
    call add_node_set(mesh, 'corners', corners)
    call add_node_set(mesh, 'leading_edge', line_at(mesh, 1))
    call add_node_set(mesh, 'trailing_edge', line_at(mesh, stations))
    call add_node_set(mesh, 'fixed_edge', line_at(mesh, merge(stations, 1, shape%mirrored)))
    call add_node_set(mesh, 'free_edge', line_at(mesh, merge(1, stations, shape%mirrored)))
    call add_midplane(mesh)
  end subroutine name_sets

  !> Nodes of a station, counted from the smallest x, in order of z; none outside the stretch.
  pure function line_at(mesh, station) result(nodes)
    type(quad_mesh_type), intent(in) :: mesh
    integer, intent(in) :: station
    integer, allocatable :: nodes(:)

    nodes = numbers((station - 1)*mesh%rows + 1, station*mesh%rows)
    associate (first => lbound(mesh%position, 2), last => ubound(mesh%position, 2))
      if (nodes(1) < first .or. nodes(mesh%rows) > last) nodes = numbers(1, 0)
    end associate
  end function line_at

  !> Names the nodes at z = 0; none where no row lies there.
  pure subroutine add_midplane(mesh)
    type(quad_mesh_type), intent(inout) :: mesh
    integer :: i

    associate (first => lbound(mesh%position, 2), last => ubound(mesh%position, 2))
      call add_node_set(mesh, 'midplane', &
                        pack([(i, i=first, last)], abs(mesh%position(3, :)) <= 0.0_wp))
    end associate
  end subroutine add_midplane

  !> Whole numbers from one to another.
  pure function numbers(first, last) result(list)
    integer, intent(in) :: first, last
    integer :: list(max(0, last - first + 1)), i
    list = [(i, i=first, last)]
  end function numbers
end module gfb_foil_mesh
