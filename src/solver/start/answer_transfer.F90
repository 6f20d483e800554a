#include "gfb_petsc.h"
!> The answer of a smaller system as the start of a larger one: on a finer mesh, or on the whole width.
!>
!> Pressure and foils are interpolated. The top foil is a beam along the motion: between two stations
!> its deflection is the cubic that has their deflections and turns. All else is linear, so that what
!> is constant or tilts along the axis stays so. The bump foil has the same stations on every mesh.
!> Where its strips are cut apart, its rows are not the top foil's: what is interpolated on either would press crests
!> into the top foil between rows. Crests are moved to where they approach it as on the smaller system.
module gfb_answer_transfer
  use gfb_kinds, only: wp
  use gfb_film_surface, only: shaft_coordinates
  use gfb_petsc_session, only: fetch_entries
  use gfb_film_mesh, only: find_film_place, find_interval
  use gfb_shell_geometry, only: node_unknowns
  use gfb_contact_point, only: spatial
  use gfb_foil_surface, only: foil_surface_type
  use gfb_foil_model, only: foil_model_type
  use gfb_bump_contacts, only: contact_top
  use gfb_foil_builder, only: axial, about_tangent
  use gfb_pad, only: pad_type
  use gfb_bearing, only: bearing_block_type, scalar_group_type, places_of
  use gfb_bearing_system, only: bearing_system_type
  use gfb_film_fields, only: film_values
  implicit none (type)
  private
  public :: transfer_answer

  integer, parameter :: corners = 4                    !! of an element
  integer, parameter :: radial = 2, about_axis = 4     !! components of a displacement: v, alpha
  integer, parameter :: along_axis = 2, towards = 3    !! of an approach: second slip, penetration

  !> Where the stations or rows of one mesh lie among those of a smaller one.
  type :: places_type
    integer, allocatable :: low(:)       !! the smaller mesh's station or row before each
    real(wp), allocatable :: share(:)    !! of the way to the next [1]
    real(wp), allocatable :: distance(:) !! to the next [m]
    logical, allocatable :: mirrored(:)  !! it lies on the side that the smaller mesh has not
  end type places_type

contains

  !> Makes the answer of a smaller system the state of a bearing.
  subroutine transfer_answer(small, bearing)
    type(bearing_system_type), intent(in) :: small      !! with its answer
    type(bearing_system_type), intent(inout) :: bearing !! gets a start value
    real(wp) :: coarse(small%local_size()), unknown(bearing%local_size()), now(bearing%local_size())
    real(wp) :: share(corners, bearing%film_nodes())
    integer :: around(corners, bearing%film_nodes()), i, k
    type(foil_surface_type), allocatable :: surface(:), small_surface(:)
    real(wp) :: place(shaft_coordinates)

    call small%get_unknowns(coarse)
    place = small%shaft_place()
    unknown = 0.0_wp
    call find_film_places(small, bearing, around, share)
    surface = bearing%foil_surfaces()
    small_surface = small%foil_surfaces()
    if (size(surface) > 0 .and. size(small_surface) == size(surface)) then
      call bearing%put_pressure(merge(film_field(small, small%film_pressure(coarse), around, share), 0.0_wp, &
                                      [(bearing%pad(i)%mesh%owned, i=1, size(bearing%pad))]), unknown)
      if (bearing%floats) unknown(bearing%first_shaft + 1:) = merge(place(bearing%coordinate), 0.0_wp, bearing%last_rank)
      do k = 1, size(bearing%pad)
        associate (from => small%pad(k), to => bearing%pad(k))
          do i = 1, size(surface)
            call transfer_surface(from, small_surface(i), coarse(from%first + 1:from%last), to, surface(i), i, &
                                  unknown(to%first + 1:to%last))
          end do
        end associate
      end do
      call bearing%add_up(unknown, bearing%state)
      do i = 1, size(surface)
        if (surface(i)%lies_on_film .or. .not. allocated(small_surface(i)%mesh%cut)) cycle
        call bearing%get_unknowns(now)
        do k = 1, size(bearing%pad)
          associate (from => small%pad(k), to => bearing%pad(k))
            call keep_approach(from, small_surface(i), coarse(from%first + 1:from%last), to, surface(i), &
                               now(to%first + 1:to%last), unknown(to%first + 1:to%last))
          end associate
        end do
        call bearing%add_up(unknown, bearing%state)
      end do
    else
      call bearing%put_pressure(film_field(small, small%film_pressure(coarse) + small%solid_pressure(coarse), around, share), &
                                unknown)
      do k = 1, size(bearing%pad)
        call bearing%pad(k)%foil%estimate(unknown(bearing%pad(k)%first + 1:bearing%pad(k)%last))
      end do
      call bearing%put_pressure(film_field(small, small%film_pressure(coarse), around, share), unknown)
      if (bearing%floats) unknown(bearing%first_shaft + 1:) = place(bearing%coordinate)
      call bearing%set_unknowns(unknown)
    end if
    do i = 1, size(bearing%block)
      call transfer_block(small, coarse, around, share, i, bearing)
    end do
  end subroutine transfer_answer

  !> Fields and scalars of a block of equations from the same one of the smaller system, or what they start with where it has none.
  subroutine transfer_block(small, coarse, around, share, number, bearing)
    type(bearing_system_type), intent(in) :: small
    real(wp), intent(in) :: coarse(:)   !! its local unknowns, in SI
    integer, intent(in) :: around(:, :) !! see `film_field`
    real(wp), intent(in) :: share(:, :)
    integer, intent(in) :: number !! of the block in the bearing's list
    type(bearing_system_type), intent(inout) :: bearing !! with all but that block's unknowns
    real(wp) :: unknown(bearing%local_size())
    integer :: i, k

    associate (block => bearing%block(number), nodes => bearing%film_nodes())
      if (block%fields + block%scalars == 0) return
      call bearing%get_unknowns(unknown)
      unknown(places_of(bearing, block)) = block%start
      do k = 1, size(small%block)
        if (small%block(k)%name /= block%name) cycle
        do i = 1, block%fields
          unknown(block%first(1) + i:block%first(1) + block%fields*nodes:block%fields) = &
            film_field(small, small%field(coarse, k, i), around, share)
        end do
        if (associated(block%groups)) then
          call transfer_groups(small, coarse, small%block(k), bearing, block, unknown)
        else if (small%block(k)%scalars == block%scalars) then
          unknown(block%first_scalar + 1:block%first_scalar + block%scalars) = &
            coarse(small%block(k)%first_scalar + 1:small%block(k)%first_scalar + block%scalars)
        end if
      end do
      call bearing%set_unknowns(unknown)
    end associate
  end subroutine transfer_block

  !> Groups of scalars: those along the axis are straight between the smaller system's rows, others the same.
  pure subroutine transfer_groups(small, coarse, from, bearing, to, unknown)
    type(bearing_system_type), intent(in) :: small, bearing
    real(wp), intent(in) :: coarse(:) !! the smaller one's local unknowns, in SI
    type(bearing_block_type), intent(in) :: from, to !! a block of each
    real(wp), intent(inout) :: unknown(:) !! the bearing's, in SI
    type(scalar_group_type), allocatable :: known(:), wanted(:)
    type(places_type) :: across
    integer :: i, k

    call from%groups(small, known)
    call to%groups(bearing, wanted)
    across = find_places(small%mesh%row_axial, bearing%mesh%row_axial, small%mesh%half)
    do k = 1, size(wanted)
      associate (old => known(k), new => wanted(k))
        if (old%count == 0) cycle
        do i = 1, new%count
          if (new%is_row .and. new%count > 1) then
            unknown(new%first + i) = line_between(coarse(old%first + min(old%count, across%low(i))), &
                                                  coarse(old%first + min(old%count, across%low(i) + 1)), across%share(i))
          else
            unknown(new%first + i) = coarse(old%first + min(old%count, i))
          end if
        end do
      end associate
    end do
  end subroutine transfer_groups

  !> A value between two others.
  elemental real(wp) function line_between(first, last, share)
    real(wp), intent(in) :: first, last
    real(wp), intent(in) :: share !! of the way [1]
    line_between = first + share*(last - first)
  end function line_between

  !> Where the bearing's film nodes lie in the smaller film; mirrored where that is half.
  subroutine find_film_places(small, bearing, around, share)
    type(bearing_system_type), intent(in) :: small, bearing
    integer, intent(out) :: around(:, :) !! (4, nodes of all pads) nodes of the smaller films' whole meshes
    real(wp), intent(out) :: share(:, :) !! (4, nodes) of each [1]
    real(wp) :: z
    integer :: i, node

    do i = 1, size(bearing%pad)
      associate (to => bearing%pad(i), from => small%pad(i)%whole, before => bearing%pad(i)%first_node)
        do node = 1, size(to%film%axial)
          z = to%film%axial(node)
          if (from%half) z = abs(z)
          call find_film_place(from, to%film%angle(node), z, around(:, before + node), share(:, before + node))
          around(:, before + node) = around(:, before + node) + (i - 1)*from%nodes()
        end do
      end associate
    end do
  end subroutine find_film_places

  !> A field of the smaller film at those places.
  function film_field(small, value, around, share) result(field)
    type(bearing_system_type), intent(in) :: small
    real(wp), intent(in) :: value(:)    !! at the smaller films' local nodes
    integer, intent(in) :: around(:, :) !! (4, places) nodes of their whole meshes
    real(wp), intent(in) :: share(:, :) !! (4, places) of each [1]
    real(wp) :: field(size(share, 2)), corner(corners, size(share, 2))

    corner = reshape(film_values(small, value, [around]), shape(corner))
    ! Less one corner's value: an even field stays so to the last digit.
    field = corner(1, :) + sum(share*(corner - spread(corner(1, :), 1, corners)), 1)
  end function film_field

  !> The owned unknowns of one surface of the foils.
  subroutine transfer_surface(small, small_surface, coarse, bearing, surface, number, unknown)
    type(pad_type), intent(in) :: small, bearing !! a pad of each
    type(foil_surface_type), intent(in) :: small_surface, surface
    real(wp), intent(in) :: coarse(:)     !! the smaller pad's local unknowns, in SI
    integer, intent(in) :: number         !! which of the foils' surfaces it is
    real(wp), intent(inout) :: unknown(:) !! the pad's
    type(places_type) :: along, across
    integer, allocatable :: wanted(:), station(:), row(:)
    real(wp), allocatable :: value(:, :)
    integer :: i

    wanted = pack(surface%part%mesh_node, surface%part%owned)
    station = (wanted - 1)/surface%mesh%rows + 1
    row = modulo(wanted - 1, surface%mesh%rows) + 1
    if (surface%lies_on_film) then
      along = find_places(small%whole%surface%radius*small%whole%station_angle, &
                          bearing%whole%surface%radius*bearing%whole%station_angle(station), .false.)
    else
      along = find_places([(real(i, wp), i=1, small_surface%mesh%stations)], real(station, wp), .false.)
    end if
    if (surface%mesh%middle > 0.0_wp) then ! rotations are not about the rays
      along%distance = 0.0_wp
    else if (surface%mesh%ring_radius > 0.0_wp) then ! stations are nearer to each other inside
      along%distance = along%distance*surface%mesh%row_axial(row)/bearing%whole%surface%radius
    end if
    across = find_places(small_surface%mesh%row_axial, surface%mesh%row_axial(row), small%whole%half)
    value = interpolated(small%foil, small_surface, number, coarse, along, across)
    call put_own(bearing%foil, number, wanted, value, unknown)
  end subroutine transfer_surface

  !> Moves this rank's crests to where they approach the top foil as on the smaller system.
  subroutine keep_approach(small, small_surface, coarse, bearing, surface, now, unknown)
    type(pad_type), intent(in) :: small, bearing !! a pad of each
    type(foil_surface_type), intent(in) :: small_surface, surface !! bump foils
    real(wp), intent(in) :: coarse(:)     !! the smaller pad's local unknowns, in SI
    real(wp), intent(in) :: now(:)        !! the pad's, as they were interpolated
    real(wp), intent(inout) :: unknown(:) !! the pad's own ones
    type(places_type) :: across
    integer, allocatable :: own(:), crest(:), node(:)
    real(wp), allocatable :: known(:, :), approach(:, :)
    real(wp) :: way(spatial)
    integer :: i, k

    own = pack(small_surface%part%mesh_node, small_surface%part%owned)
    known = approaches(small%foil, own, coarse)
    associate (contacts => bearing%foil%contacts)
      crest = pack([(i, i=1, size(contacts%point))], contacts%point%law == contact_top)
      node = contacts%point(crest)%node
      across = find_places(small_surface%mesh%row_axial, surface%mesh%row_axial(modulo(node - 1, surface%mesh%rows) + 1), &
                           small%whole%half)
      approach = between_rows(small_surface, own, known, (node - 1)/surface%mesh%rows, across)
      do i = 1, size(crest)
        if (across%mirrored(i)) approach(along_axis, i) = -approach(along_axis, i)
        way = contacts%approach(crest(i), now(bearing%foil%first + 1:)) - approach(:, i)
        way(towards) = -way(towards)
        associate (point => contacts%point(crest(i)))
          way = matmul(point%frame, way)
          do k = 1, spatial
            if (point%slave(k) == 0) cycle
            associate (place => bearing%foil%first + point%slave(k))
              unknown(place) = unknown(place) - way(k)
            end associate
          end do
        end associate
      end do
    end associate
  end subroutine keep_approach

  !> Slip and penetration of this rank's crests, by its own nodes; 0 at other nodes [m].
  pure function approaches(foil, own, unknown) result(value)
    class(foil_model_type), intent(in) :: foil
    integer, intent(in) :: own(:)      !! nodes of the bump foil
    real(wp), intent(in) :: unknown(:) !! local ones of the pad, in SI
    real(wp) :: value(spatial, size(own))
    integer :: place(maxval([0, own])), i

    place = 0
    place(own) = [(i, i=1, size(own))]
    value = 0.0_wp
    do i = 1, size(foil%contacts%point)
      associate (point => foil%contacts%point(i))
        if (point%law == contact_top) value(:, place(point%node)) = foil%contacts%approach(i, unknown(foil%first + 1:))
      end associate
    end do
  end function approaches

  !> Where positions lie among rising ones; mirrored ones where only positive ones are known.
  pure function find_places(known, position, half) result(places)
    real(wp), intent(in) :: known(:)    !! rising [m]
    real(wp), intent(in) :: position(:) !! [m]
    logical, intent(in) :: half
    type(places_type) :: places
    integer :: i

    allocate (places%low(size(position)), places%share(size(position)), places%distance(size(position)))
    places%mirrored = half .and. position < 0.0_wp
    do i = 1, size(position)
      call find_interval(known, merge(-position(i), position(i), places%mirrored(i)), places%low(i), places%share(i))
      places%distance(i) = known(places%low(i) + 1) - known(places%low(i))
    end do
  end function find_places

  !> Displacements of the smaller surface at places on it.
  function interpolated(foil, surface, number, coarse, along, across) result(value)
    class(foil_model_type), intent(in) :: foil
    type(foil_surface_type), intent(in) :: surface
    integer, intent(in) :: number            !! which of the foils' surfaces it is
    real(wp), intent(in) :: coarse(:)        !! local unknowns of the smaller bearing, in SI
    type(places_type), intent(in) :: along, across
    real(wp), allocatable :: value(:, :)     !! (5, places)
    real(wp), allocatable :: first(:, :), second(:, :), own_value(:, :)
    integer, allocatable :: own(:)
    integer :: i

    own = pack(surface%part%mesh_node, surface%part%owned)
    own_value = own_values(foil, number, own, coarse)
    first = between_rows(surface, own, own_value, along%low - 1, across)
    second = between_rows(surface, own, own_value, along%low, across)
    allocate (value, mold=first)
    do i = 1, size(value, 2)
      value(:, i) = between(first(:, i), second(:, i), along%share(i), along%distance(i))
      if (across%mirrored(i)) value([axial, about_tangent], i) = -value([axial, about_tangent], i)
    end do
  end function interpolated

  !> Values on stations of a surface, linear between its rows. All ranks ask.
  function between_rows(surface, own, own_value, stations_before, across) result(there)
    type(foil_surface_type), intent(in) :: surface
    integer, intent(in) :: own(:)             !! this rank's nodes
    real(wp), intent(in) :: own_value(:, :)   !! at these [SI]
    integer, intent(in) :: stations_before(:) !! of each place
    type(places_type), intent(in) :: across
    real(wp), allocatable :: there(:, :)
    real(wp), allocatable :: upper(:, :)
    integer, allocatable :: node(:)
    integer :: i

    node = stations_before*surface%mesh%rows + across%low
    there = fetch_entries(surface%mesh%nodes(), own, own_value, node)
    upper = fetch_entries(surface%mesh%nodes(), own, own_value, node + 1)
    do i = 1, size(node)
      there(:, i) = there(:, i) + across%share(i)*(upper(:, i) - there(:, i))
    end do
  end function between_rows

  !> A displacement between two stations.
  pure function between(first, second, share, distance) result(value)
    real(wp), intent(in) :: first(:), second(:) !! displacements there [m], [rad]
    real(wp), intent(in) :: share    !! of the way from the first to the second [1]
    real(wp), intent(in) :: distance !! of the stations; 0: their rotations say nothing [m]
    real(wp) :: value(size(first))

    value = first + share*(second - first)
    if (share <= 0.0_wp .or. share >= 1.0_wp .or. .not. distance > 0.0_wp) return
    associate (t => share, rest => 1.0_wp - share)
      value(radial) = (1.0_wp + 2.0_wp*t)*rest**2*first(radial) + t**2*(1.0_wp + 2.0_wp*rest)*second(radial) + &
        distance*t*rest*(rest*first(about_axis) - t*second(about_axis))
      value(about_axis) = 6.0_wp*t*rest/distance*(second(radial) - first(radial)) + &
        rest*(1.0_wp - 3.0_wp*t)*first(about_axis) + t*(1.0_wp - 3.0_wp*rest)*second(about_axis)
    end associate
  end function between

  !> Displacements of this rank's own nodes of a surface; 0 where they are fixed or condensed.
  pure function own_values(foil, number, own, coarse) result(value)
    class(foil_model_type), intent(in) :: foil
    integer, intent(in) :: number, own(:) !! which surface, its nodes
    real(wp), intent(in) :: coarse(:)     !! local unknowns of the bearing, in SI
    real(wp) :: value(node_unknowns, size(own))
    integer :: i, k, place

    value = 0.0_wp
    do i = 1, size(own)
      do k = 1, node_unknowns
        place = foil%own_unknown(number, k, own(i))
        if (place > 0) value(k, i) = coarse(foil%first + place)
      end do
    end do
  end function own_values

  !> Gives displacements to this rank's own nodes of a surface.
  pure subroutine put_own(foil, number, own, value, unknown)
    class(foil_model_type), intent(in) :: foil
    integer, intent(in) :: number, own(:) !! which surface, its nodes
    real(wp), intent(in) :: value(:, :)   !! (5, nodes)
    real(wp), intent(inout) :: unknown(:) !! local unknowns of the bearing, in SI
    integer :: i, k, place

    do i = 1, size(own)
      do k = 1, node_unknowns
        place = foil%own_unknown(number, k, own(i))
        if (place > 0) unknown(foil%first + place) = value(k, i)
      end do
    end do
  end subroutine put_own
end module gfb_answer_transfer
