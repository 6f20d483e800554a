!> From `&feed` to what feeds a bearing's films: the porous wall, mouths on the nodes of this rank, rows that are spread along sides
!> of elements.
module gfb_feed_builder
  use gfb_kinds, only: wp
  use gfb_units, only: turn
  use gfb_bearing_case, only: bearing_case_type, pad_angle
  use gfb_fed_mouth, only: mouth_type, find_mouth, find_rim
  use gfb_feed_case, only: feed_case_type, hole_type, find_holes, spread_line
  use gfb_film_feed, only: film_feed_type, fed_mouth_type, fed_line_type, mixing_type, add_mixing
  use gfb_film_mesh, only: film_mesh_type
  use gfb_pad, only: pad_type
  use gfb_scene, only: scene_type
  implicit none (type, external)
  private
  public :: find_feed

  real(wp), parameter :: near = 1.0e-6_wp !! of an element: on a side [1]

  !> Places and weights of the points of a line's element, for two nodes and for three [1].
  real(wp), parameter :: two_points(2) = 0.5_wp + 0.5_wp/sqrt(3.0_wp)*[-1.0_wp, 1.0_wp]
  real(wp), parameter :: three_points(3) = 0.5_wp + 0.5_wp*sqrt(0.6_wp)*[-1.0_wp, 0.0_wp, 1.0_wp]
  real(wp), parameter :: three_weights(3) = [5.0_wp, 8.0_wp, 5.0_wp]/18.0_wp

contains

  !> Finds where films are fed, before their equations are numbered.
  subroutine find_feed(scene, film, pads, pad, feed)
    type(scene_type), intent(in) :: scene !! what is asked for
    type(film_mesh_type), intent(in) :: film !! mesh of the first pad
    integer, intent(in) :: pads !! of the bearing, or of two of them
    type(pad_type), intent(in) :: pad !! the first one, with this rank's nodes; the others have the same
    type(film_feed_type), allocatable, intent(out) :: feed !! without numbers; none where nothing feeds them
    type(hole_type), allocatable :: hole(:)
    integer :: i, k

    if (.not. scene%feed%present) return
    allocate (feed)
    allocate (feed%mouth(0), feed%line(0))
    if (.not. scene%feed%has_orifices()) return
    do i = 1, pads
      associate (number => modulo(i - 1, scene%bearing%pads) + 1)
        if (scene%feed%spread == spread_line) then
          call add_lines(scene, film, i, pad, feed%line)
        else
          call find_holes(scene%feed, scene%bearing, number, hole)
          do k = 1, size(hole)
            if (film%half .and. hole(k)%along < -near*film%row_axial(2)) cycle ! it is another's mirror image
            feed%mouth = [feed%mouth, mouth_on_rank(scene%feed, film, i, hole(k), pad)]
          end do
        end if
      end associate
    end do
  end subroutine find_feed

  !> A mouth by the nodes of it that this rank owns.
  function mouth_on_rank(given, film, number, hole, pad) result(mouth)
    type(feed_case_type), intent(in) :: given
    type(film_mesh_type), intent(in) :: film
    integer, intent(in) :: number !! of the pad
    type(hole_type), intent(in) :: hole
    type(pad_type), intent(in) :: pad
    type(fed_mouth_type) :: mouth
    type(mouth_type) :: whole

    call find_mouth(film, hole%angle, hole%along, 0.5_wp*given%mouth_diameter, whole)
    mouth%pad = number
    mouth%number = hole%number
    mouth%mirror = hole%number
    associate (rows => size(given%row_positions), holes => given%holes_of_row())
      if (film%half) mouth%mirror = hole%number + holes*(rows + 1 - 2*hole%row)
    end associate
    mouth%angle = hole%angle
    mouth%along = hole%along
    mouth%lack = whole%lack
    mouth%part = whole%part
    ! Motions against the mirror image leave the middle as it is.
    if (film%opposite .and. whole%part < 1.0_wp) whole%weight = 0.0_wp
    if (film%opposite .and. whole%part < 1.0_wp) whole%centre_weight = 0.0_wp
    if (given%heated) call find_mixing(film, hole, 0.5_wp*given%mouth_diameter, pad, mouth%mixing)
    call own_nodes(pad, whole%node, whole%weight, mouth%node, mouth%weight)
    call own_nodes(pad, whole%centre_node, whole%centre_weight, mouth%centre_node, mouth%centre_weight)
  end function mouth_on_rank

  !> The elements of this rank on a rim.
  subroutine find_mixing(film, hole, radius, pad, mixing)
    type(film_mesh_type), intent(in) :: film
    type(hole_type), intent(in) :: hole
    real(wp), intent(in) :: radius !! of the mouth [m]
    type(pad_type), intent(in) :: pad
    type(mixing_type), allocatable, intent(out) :: mixing(:)
    integer, allocatable :: nodes(:, :), place(:)
    real(wp), allocatable :: shapes(:, :)
    type(mixing_type) :: one
    integer :: i, element, k, a

    call find_rim(film, hole%angle, hole%along, radius, nodes, shapes)
    allocate (mixing(0))
    do element = 1, size(pad%film%element_nodes, 2)
      associate (local => pad%film%element_nodes(:, element))
        one%node = local
        one%share = spread(0.0_wp*shapes(:, 1), 2, size(local))
        k = 0
        do i = 1, size(nodes, 2)
          if (nodes(1, i) /= pad%mesh%mesh_node(local(1))) cycle
          k = k + 1
          place = [(findloc(nodes(:, i), pad%mesh%mesh_node(local(a)), 1), a=1, size(local))]
          call add_mixing(shapes(place, i), 1.0_wp/real(size(nodes, 2), wp), pad%film%fixed(local), one%share)
        end do
      end associate
      if (k > 0) mixing = [mixing, one]
    end do
  end subroutine find_mixing

  !> Nodes of the whole mesh that this rank owns, by its own numbers.
  subroutine own_nodes(pad, whole, weight, node, own_weight)
    type(pad_type), intent(in) :: pad
    integer, intent(in) :: whole(:)
    real(wp), intent(in) :: weight(:)
    integer, allocatable, intent(out) :: node(:)
    real(wp), allocatable, intent(out) :: own_weight(:)
    integer :: i, here

    allocate (node(0), own_weight(0))
    do i = 1, size(whole)
      here = findloc(pad%mesh%mesh_node, whole(i), 1)
      if (here == 0) cycle
      if (.not. pad%mesh%owned(here)) cycle
      node = [node, here]
      own_weight = [own_weight, weight(i)]
    end do
  end subroutine own_nodes

  !> Rows of orifices that are spread: lower sides of this rank's elements on them.
  subroutine add_lines(scene, film, number, pad, lines)
    type(scene_type), intent(in) :: scene
    type(film_mesh_type), intent(in) :: film
    integer, intent(in) :: number !! of the pad
    type(pad_type), intent(in) :: pad
    type(fed_line_type), allocatable, intent(inout) :: lines(:)
    type(fed_line_type) :: line
    real(wp), allocatable :: weight(:)
    real(wp) :: apart
    integer :: row, element

    apart = near*minval(film%row_axial(2:) - film%row_axial(:size(film%row_axial) - 1))
    call line_rule(film%order, line%shape, weight)
    line%pad = number
    do row = 1, size(scene%feed%row_positions)
      associate (along => scene%feed%row_positions(row))
        if (film%half .and. along < -apart) cycle
        if (film%half .and. film%opposite .and. abs(along) <= apart) cycle
        do element = 1, size(pad%film%element_nodes, 2)
          line%node = lower_side(pad%film%element_nodes(:, element))
          if (any(abs(pad%film%axial(line%node) - along) > apart)) cycle
          line%orifices = orifices_of(scene%feed, scene%bearing, line_arc(pad%film%angle(line%node)))*weight
          if (film%half .and. abs(along) <= apart) line%orifices = 0.5_wp*line%orifices
          lines = [lines, line]
        end do
      end associate
    end do
  end subroutine add_lines

  !> Nodes of an element's side where its rows begin.
  pure function lower_side(nodes) result(side)
    integer, intent(in) :: nodes(:)
    integer, allocatable :: side(:)

    if (size(nodes) == 4) then
      side = nodes(1:2)
    else
      side = nodes([1, 4, 7])
    end if
  end function lower_side

  !> Angle from the first to the last node of a side; that which closes a ring reaches beyond the last station.
  pure real(wp) function line_arc(angle) result(arc)
    real(wp), intent(in) :: angle(:) !! of its nodes [rad]
    arc = modulo(angle(size(angle)) - angle(1), turn)
  end function line_arc

  !> How many orifices an arc stands for.
  pure real(wp) function orifices_of(feed, bearing, arc) result(orifices)
    type(feed_case_type), intent(in) :: feed
    type(bearing_case_type), intent(in) :: bearing
    real(wp), intent(in) :: arc !! [rad]
    orifices = real(feed%holes_of_row(), wp)*arc/merge(pad_angle(bearing), turn, bearing%row%has_sectors)
  end function orifices_of

  !> Shape functions at the points of a side, and the points' weights.
  pure subroutine line_rule(order, shape, weight)
    integer, intent(in) :: order !! of the elements
    real(wp), allocatable, intent(out) :: shape(:, :) !! (nodes, points) [1]
    real(wp), allocatable, intent(out) :: weight(:)   !! adding up to one [1]

    if (order == 1) then
      allocate (shape(2, 2))
      shape(1, :) = 1.0_wp - two_points
      shape(2, :) = two_points
      weight = [0.5_wp, 0.5_wp]
    else
      allocate (shape(3, 3))
      associate (t => three_points, rest => 1.0_wp - three_points)
        shape(1, :) = rest*(rest - t)
        shape(2, :) = 4.0_wp*rest*t
        shape(3, :) = t*(t - rest)
      end associate
      weight = three_weights
    end if
  end subroutine line_rule
end module gfb_feed_builder
