#include "gfb_petsc.h"
!> Orifices as a block of a bearing's equations: three for each mouth, see `gfb_film_feed`, and what they feed into the rows of the
!> films.
!>
!> A porous wall has no unknowns: the elements of the films have it as a source (`wall` of `gfb_gas_film`). Orifices that are spread
!> along a line have none either: each point of an element's side feeds by the pressure and the gap at it.
module gfb_feed_block
  use petscmat
  use gfb_kinds, only: wp
  use gfb_petsc_kinds, only: pint
  use gfb_film_feed, only: mouth_state_type, mouth_unknowns, mouth_pressure, mouth_mean, mouth_gap
  use gfb_fed_state, only: line_point_type, line_point, state_of_mouth, is_warm, numbers_of, number
  use gfb_feed_heat, only: add_supply_heat, add_supply_heat_rates
  use gfb_film_rates, only: squeeze, flow_by_gap
  use gfb_pad, only: pad_type
  use gfb_pad_terms, only: add_block
  use gfb_wall_film, only: wall_shares
  use gfb_bearing, only: bearing_type, bearing_block_type, bearing_state_type, shown_field_type
  implicit none (type)
  private
  public :: feed_block, begin_feed

contains

  !> The block of a bearing that is fed through orifices.
  pure subroutine feed_block(bearing, block)
    class(bearing_type), intent(in) :: bearing !! with what feeds it
    type(bearing_block_type), intent(out) :: block !! not numbered yet

    block%name = 'feed'
    block%scalars = mouth_unknowns*size(bearing%feed%mouth)
    block%start = 1.0_wp
    block%positive = .true.
    block%take_numbers => take_numbers
    block%equation_sizes => sizes_of_equations
    block%add_residual => feed_residual
    block%add_jacobian => feed_jacobian
    block%add_column => feed_column
    block%add_rates => feed_rates
    block%prepare_step => prepare_feed
    block%end_step => follow_feed
    block%recall_step => recall_feed
    block%end_motion => end_feed
    block%shown = [shown_field_type('feed', 'kg/(m2 s)', 'gas that is fed in, of an area')]
    block%show => field_of_feed
  end subroutine feed_block

  !> Where mouths have their unknowns.
  pure subroutine take_numbers(bearing, block)
    class(bearing_type), intent(inout) :: bearing
    type(bearing_block_type), intent(in) :: block
    bearing%feed%first = block%first_scalar
  end subroutine take_numbers

  !> Equations are as large as their unknowns: one.
  pure subroutine sizes_of_equations(bearing, scale)
    class(bearing_type), intent(in) :: bearing
    real(wp), intent(out) :: scale(:)
    scale = 1.0_wp
  end subroutine sizes_of_equations

  !> Flows into the films, means and gaps of the mouths, laws of the orifices.
  subroutine feed_residual(bearing, state, residual)
    class(bearing_type), intent(in) :: bearing
    type(bearing_state_type), intent(in) :: state
    real(wp), intent(inout) :: residual(:)
    type(mouth_state_type) :: here
    integer :: j, pressure, mean, gap

    associate (feed => bearing%feed)
      do j = 1, size(feed%mouth)
        pressure = feed%place(j, mouth_pressure)
        mean = feed%place(j, mouth_mean)
        gap = feed%place(j, mouth_gap)
        here = state_of_mouth(bearing, j, state)
        associate (mouth => feed%mouth(j), pad => bearing%pad(feed%mouth(j)%pad))
          call add_to_film(pad%film%fixed, mouth%node, -mouth%part*here%flow*mouth%weight, residual(pad%first + 1:pad%last))
          residual(mean) = residual(mean) - dot_product(mouth%weight, state%unknown(pad%first + mouth%node))/feed%size(mouth_mean)
          residual(gap) = residual(gap) &
            - dot_product(mouth%centre_weight, state%gap(pad%first_node + mouth%centre_node))/feed%size(mouth_gap)
          call add_push(pad, mouth%centre_node, mouth%part*state%point%supply*feed%push*mouth%centre_weight, residual)
        end associate
        if (bearing%last_rank .or. is_warm(bearing)) residual(pressure) = residual(pressure) + here%balance/feed%size(mouth_pressure)**2
        if (.not. bearing%last_rank) cycle
        residual(mean) = residual(mean) + state%unknown(mean)
        residual(gap) = residual(gap) + state%unknown(gap)
      end do
    end associate
    call line_residual(bearing, state, residual)
    if (bearing%heat%present) call add_supply_heat(bearing, state, residual)
  end subroutine feed_residual

  !> Their derivatives.
  subroutine feed_jacobian(bearing, state, room, matrix)
    class(bearing_type), intent(in) :: bearing
    type(bearing_state_type), intent(in) :: state
    logical, intent(in) :: room
    Mat, intent(in) :: matrix
    type(mouth_state_type) :: here
    real(wp) :: there
    PetscInt :: own(mouth_unknowns)
    integer :: j

    there = merge(0.0_wp, 1.0_wp, room)
    associate (feed => bearing%feed)
      do j = 1, size(feed%mouth)
        own = numbers_of(feed, j)
        here = mouth_state_type()
        if (.not. room) here = state_of_mouth(bearing, j, state)
        call add_flow_columns(bearing, j, here%flow_by_pressure, here%flow_by_gap, matrix)
        associate (mouth => feed%mouth(j), pad => bearing%pad(feed%mouth(j)%pad))
          call add_block(matrix, own(mouth_mean:mouth_mean), number(pad%first + mouth%node), -there*mouth%weight/feed%size(mouth_mean))
        end associate
        call add_gap_row(bearing, j, there, matrix)
        if (bearing%last_rank .or. is_warm(bearing)) then
          call add_block(matrix, own(mouth_pressure:mouth_pressure), own, here%by*feed%size/feed%size(mouth_pressure)**2)
        end if
        if (.not. bearing%last_rank) cycle
        call add_block(matrix, own(mouth_mean:mouth_mean), own(mouth_mean:mouth_mean), [there])
        call add_block(matrix, own(mouth_gap:mouth_gap), own(mouth_gap:mouth_gap), [there])
      end do
    end associate
    call line_jacobian(bearing, state, room, matrix)
    if (bearing%heat%present) call add_supply_heat_rates(bearing, state, room, matrix)
  end subroutine feed_jacobian

  !> Film rows by the pressure in a mouth and the gap at it.
  subroutine add_flow_columns(bearing, j, by_pressure, by_gap, matrix)
    class(bearing_type), intent(in) :: bearing
    integer, intent(in) :: j !! of the mouth
    real(wp), intent(in) :: by_pressure, by_gap !! of what it feeds [m3/s], [Pa m2/s]
    Mat, intent(in) :: matrix
    real(wp) :: block(2, size(bearing%feed%mouth(j)%node)) ! a row in each column
    PetscInt :: own(mouth_unknowns)

    own = numbers_of(bearing%feed, j)
    associate (feed => bearing%feed, mouth => bearing%feed%mouth(j), pad => bearing%pad(bearing%feed%mouth(j)%pad))
      block(1, :) = -mouth%part*by_pressure*feed%size(mouth_pressure)*mouth%weight
      block(2, :) = -mouth%part*by_gap*feed%size(mouth_gap)*mouth%weight
      call add_block(matrix, merge(-1_pint, number(pad%first + mouth%node), pad%film%fixed(mouth%node)), &
                     own([mouth_pressure, mouth_gap]), block)
    end associate
  end subroutine add_flow_columns

  !> What moves the gap at a mouth's centre: foil and shaft.
  subroutine add_gap_row(bearing, j, factor, matrix)
    class(bearing_type), intent(in) :: bearing
    integer, intent(in) :: j !! of the mouth
    real(wp), intent(in) :: factor !! 0: makes room [1]
    Mat, intent(in) :: matrix
    real(wp) :: by_shaft(size(bearing%coordinate))
    PetscInt :: row(1)
    integer :: k

    row = number([bearing%feed%place(j, mouth_gap)])
    associate (feed => bearing%feed, mouth => bearing%feed%mouth(j))
      call add_foil_of_gap(bearing, j, factor, matrix)
      associate (film => bearing%pad(mouth%pad)%film)
        do k = 1, size(by_shaft)
          by_shaft(k) = -factor*dot_product(mouth%centre_weight, film%motion(bearing%coordinate(k), mouth%centre_node))/feed%size(mouth_gap)
        end do
      end associate
      call add_block(matrix, row, number([(bearing%first_shaft + k, k=1, size(by_shaft))]), by_shaft)
    end associate
  end subroutine add_gap_row

  !> The foil's part of that row.
  subroutine add_foil_of_gap(bearing, j, factor, matrix)
    class(bearing_type), intent(in) :: bearing
    integer, intent(in) :: j
    real(wp), intent(in) :: factor
    Mat, intent(in) :: matrix
    PetscInt :: row(1)
    integer :: source(size(bearing%feed%mouth(j)%centre_node))

    row = number([bearing%feed%place(j, mouth_gap)])
    associate (feed => bearing%feed, mouth => bearing%feed%mouth(j), pad => bearing%pad(bearing%feed%mouth(j)%pad))
      source = pad%foil%source(mouth%centre_node)
      call add_block(matrix, row, merge(number(pad%first + source), -1_pint, source > 0), &
                     -factor*mouth%centre_weight*pad%foil%rate(mouth%centre_node)/feed%size(mouth_gap))
    end associate
  end subroutine add_foil_of_gap

  !> The gap at the mouths follows the shaft.
  subroutine feed_column(bearing, state, coordinate, column)
    class(bearing_type), intent(in) :: bearing
    type(bearing_state_type), intent(in) :: state
    integer, intent(in) :: coordinate
    real(wp), intent(inout) :: column(:)
    type(line_point_type) :: here
    integer :: j, i, gap

    associate (feed => bearing%feed)
      do j = 1, size(feed%mouth)
        gap = feed%place(j, mouth_gap)
        associate (mouth => feed%mouth(j))
          column(gap) = column(gap) - dot_product(mouth%centre_weight, &
                                                  bearing%pad(mouth%pad)%film%motion(coordinate, mouth%centre_node))/feed%size(mouth_gap)
        end associate
      end do
      do j = 1, size(feed%line)
        associate (line => feed%line(j), pad => bearing%pad(feed%line(j)%pad))
          do i = 1, size(line%orifices)
            here = line_point(bearing, j, i, state)
            call add_to_film(pad%film%fixed, line%node, -line%shape(:, i)*line%orifices(i)*here%by_gap*line%motion(coordinate, i), &
                             column(pad%first + 1:pad%last))
          end do
        end associate
      end do
    end associate
  end subroutine feed_column

  !> Adds to the equations of film nodes, but for those of given pressure.
  pure subroutine add_to_film(fixed, node, value, residual)
    logical, intent(in) :: fixed(:)
    integer, intent(in) :: node(:)
    real(wp), intent(in) :: value(:)
    real(wp), intent(inout) :: residual(:) !! of the pad
    integer :: a

    do a = 1, size(node)
      if (.not. fixed(node(a))) residual(node(a)) = residual(node(a)) + value(a)
    end do
  end subroutine add_to_film

  !> Adds forces that push the top foil to the shaft at film nodes; where it is fixed they do nothing.
  pure subroutine add_push(pad, node, force, residual)
    type(pad_type), intent(in) :: pad
    integer, intent(in) :: node(:) !! of the pad
    real(wp), intent(in) :: force(:) !! on the solved width [N]
    real(wp), intent(inout) :: residual(:) !! of the bearing, in SI
    integer :: a

    if (.not. maxval(abs(force)) > 0.0_wp) return ! springs have no equation that is a force
    do a = 1, size(node)
      associate (source => pad%foil%source(node(a)))
        if (source > 0) residual(pad%first + source) = residual(pad%first + source) + force(a)*pad%foil%rate(node(a))
      end associate
    end do
  end subroutine add_push

  !> What lines feed.
  subroutine line_residual(bearing, state, residual)
    class(bearing_type), intent(in) :: bearing
    type(bearing_state_type), intent(in) :: state
    real(wp), intent(inout) :: residual(:)
    type(line_point_type) :: here
    integer :: j, i

    do j = 1, size(bearing%feed%line)
      associate (line => bearing%feed%line(j), pad => bearing%pad(bearing%feed%line(j)%pad))
        do i = 1, size(line%orifices)
          here = line_point(bearing, j, i, state)
          call add_to_film(pad%film%fixed, line%node, -line%shape(:, i)*line%orifices(i)*here%flow, residual(pad%first + 1:pad%last))
        end do
      end associate
    end do
  end subroutine line_residual

  !> The derivatives.
  subroutine line_jacobian(bearing, state, room, matrix)
    class(bearing_type), intent(in) :: bearing
    type(bearing_state_type), intent(in) :: state
    logical, intent(in) :: room
    Mat, intent(in) :: matrix
    type(line_point_type) :: here
    integer :: j, i

    here = line_point_type()
    do j = 1, size(bearing%feed%line)
      do i = 1, size(bearing%feed%line(j)%orifices)
        if (.not. room) here = line_point(bearing, j, i, state)
        call add_line_block(bearing, j, i, here%by_pressure, here%by_gap, here%by_gap, matrix)
      end do
    end do
  end subroutine line_jacobian

  !> Film rows by pressures, by what moves the foil, and by the shaft, at a point of a line.
  subroutine add_line_block(bearing, j, i, by_pressure, by_gap, by_shaft, matrix)
    class(bearing_type), intent(in) :: bearing
    integer, intent(in) :: j, i
    real(wp), intent(in) :: by_pressure, by_gap !! of what an orifice feeds [m3/s], [Pa m2/s]
    real(wp), intent(in) :: by_shaft !! by the gap as the shaft moves it [Pa m2/s]
    Mat, intent(in) :: matrix
    ! a row in each column
    real(wp) :: block(2*size(bearing%feed%line(j)%node) + size(bearing%coordinate), size(bearing%feed%line(j)%node))
    PetscInt :: row(size(block, 2)), column(size(block, 1))
    integer :: n, k, source(size(row))

    n = size(row)
    associate (line => bearing%feed%line(j), pad => bearing%pad(bearing%feed%line(j)%pad))
      row = merge(-1_pint, number(pad%first + line%node), pad%film%fixed(line%node))
      column(:n) = number(pad%first + line%node)
      source = pad%foil%source(line%node)
      column(n + 1:2*n) = merge(number(pad%first + source), -1_pint, source > 0)
      column(2*n + 1:) = number([(bearing%first_shaft + k, k=1, size(bearing%coordinate))])
      block(:n, :) = -line%orifices(i)*by_pressure*spread(line%shape(:, i), 2, n)*spread(line%shape(:, i), 1, n)
      block(n + 1:2*n, :) = -line%orifices(i)*by_gap*spread(line%shape(:, i)*pad%foil%rate(line%node), 2, n)*spread(line%shape(:, i), 1, n)
      block(2*n + 1:, :) = -line%orifices(i)*by_shaft*spread(line%motion(bearing%coordinate, i), 2, n)* &
        spread(line%shape(:, i), 1, size(bearing%coordinate))
      call add_block(matrix, row, column, block)
    end associate
  end subroutine add_line_block

  !> What pockets store, by the unknowns; and what of the gap at mouths and lines comes by the foil.
  subroutine feed_rates(bearing, kind, state, matrix)
    class(bearing_type), intent(in) :: bearing
    integer, intent(in) :: kind
    type(bearing_state_type), intent(in) :: state
    Mat, intent(in) :: matrix
    type(line_point_type) :: here
    type(mouth_state_type) :: of_mouth
    PetscInt :: own(mouth_unknowns)
    integer :: j, i

    associate (feed => bearing%feed)
      do j = 1, size(feed%mouth)
        if (kind == flow_by_gap) call add_foil_of_gap(bearing, j, 1.0_wp, matrix)
        if (kind /= squeeze) cycle
        call add_flow_columns(bearing, j, -feed%volume, 0.0_wp, matrix)
        if (.not. (bearing%last_rank .or. is_warm(bearing))) cycle
        own = numbers_of(feed, j)
        of_mouth = state_of_mouth(bearing, j, state)
        call add_block(matrix, own(mouth_pressure:mouth_pressure), own(mouth_pressure:mouth_pressure), &
                       [-of_mouth%by_flow*feed%volume/feed%size(mouth_pressure)])
      end do
      do j = 1, size(feed%line)
        do i = 1, size(feed%line(j)%orifices)
          if (kind == squeeze) call add_line_block(bearing, j, i, -feed%volume, 0.0_wp, 0.0_wp, matrix)
          if (kind /= flow_by_gap) cycle
          here = line_point(bearing, j, i, state)
          call add_line_block(bearing, j, i, 0.0_wp, here%by_gap, 0.0_wp, matrix)
        end do
      end do
    end associate
  end subroutine feed_rates

  !> From now on pockets store gas: what they hold now they have held before.
  subroutine begin_feed(unknown, bearing)
    real(wp), intent(in) :: unknown(:) !! of the bearing, local, in SI
    class(bearing_type), intent(inout) :: bearing !! at rest
    real(wp), allocatable :: held(:)

    if (.not. allocated(bearing%feed)) return
    if (.not. bearing%feed%volume > 0.0_wp) return
    call find_content(bearing, unknown, held)
    bearing%feed%content = spread(held, 2, 2)
  end subroutine begin_feed

  !> Gas in all pockets at a state: pressure times volume, of the mouths, then of the points of lines.
  pure subroutine find_content(bearing, unknown, held)
    class(bearing_type), intent(in) :: bearing
    real(wp), intent(in) :: unknown(:) !! local, in SI
    real(wp), allocatable, intent(out) :: held(:) !! [Pa m3]
    integer :: j

    associate (feed => bearing%feed)
      allocate (held(size(feed%mouth)))
      do j = 1, size(held)
        held(j) = feed%volume*unknown(feed%place(j, mouth_pressure))*feed%size(mouth_pressure)
      end do
      do j = 1, size(feed%line)
        associate (line => feed%line(j), before => bearing%pad(feed%line(j)%pad)%first)
          held = [held, feed%volume*matmul(unknown(before + line%node), line%shape)]
        end associate
      end do
    end associate
  end subroutine find_content

  !> What pockets held before counts in the next step.
  subroutine prepare_feed(bearing, weight, now, before)
    class(bearing_type), intent(inout) :: bearing
    real(wp), intent(in) :: weight(0:2)
    Vec, intent(in) :: now, before
    real(wp), allocatable :: past(:)
    integer :: j, at

    associate (feed => bearing%feed)
      if (.not. allocated(feed%content)) return
      feed%storage = weight(0)
      past = matmul(feed%content, weight(1:))
      feed%past = past(:size(feed%mouth))
      at = size(feed%mouth)
      do j = 1, size(feed%line)
        feed%line(j)%past = past(at + 1:at + size(feed%line(j)%orifices))
        at = at + size(feed%line(j)%orifices)
      end do
    end associate
  end subroutine prepare_feed

  !> The step has led to the present state.
  subroutine follow_feed(bearing, weight, now, before)
    class(bearing_type), intent(inout) :: bearing
    real(wp), intent(in) :: weight(0:2)
    Vec, intent(in) :: now, before
    real(wp), allocatable :: held(:)
    real(wp) :: unknown(bearing%local_size())

    if (.not. allocated(bearing%feed%content)) return
    call bearing%get_unknowns(unknown)
    call find_content(bearing, unknown, held)
    bearing%feed%content(:, 2) = bearing%feed%content(:, 1)
    bearing%feed%content(:, 1) = held
  end subroutine follow_feed

  !> Pockets as a step has left them.
  subroutine recall_feed(bearing, step, unknown)
    class(bearing_type), intent(inout) :: bearing
    integer, intent(in) :: step
    real(wp), intent(in) :: unknown(:)
    real(wp), allocatable :: held(:)

    if (.not. allocated(bearing%feed%content)) return
    call find_content(bearing, unknown, held)
    bearing%feed%content(:, step) = held
  end subroutine recall_feed

  !> A steady state again.
  subroutine end_feed(bearing)
    class(bearing_type), intent(inout) :: bearing
    integer :: j

    associate (feed => bearing%feed)
      feed%storage = 0.0_wp
      if (allocated(feed%content)) deallocate (feed%content)
      if (allocated(feed%past)) deallocate (feed%past)
      if (.not. allocated(feed%line)) return
      do j = 1, size(feed%line)
        if (allocated(feed%line(j)%past)) deallocate (feed%line(j)%past)
      end do
    end associate
  end subroutine end_feed

  !> Gas that is fed in, of an area.
  subroutine field_of_feed(bearing, unknown, which, value)
    class(bearing_type), intent(in) :: bearing
    real(wp), intent(in) :: unknown(:)
    integer, intent(in) :: which
    real(wp), intent(out) :: value(:)
    real(wp), dimension(bearing%local_size()) :: flux, area
    type(bearing_state_type) :: state
    type(line_point_type) :: here
    type(mouth_state_type) :: of_mouth
    integer :: i, j, element

    flux = 0.0_wp
    area = 0.0_wp
    state = bearing_state_type(bearing%position(unknown), bearing%point, unknown, bearing%gap(unknown))
    associate (feed => bearing%feed)
      do i = 1, size(bearing%pad)
        associate (pad => bearing%pad(i), film => bearing%pad(i)%film)
          do element = 1, size(film%element_nodes, 2)
            associate (place => pad%first + film%element_nodes(:, element))
              area(place) = area(place) + matmul(film%shape, film%geometry(element)%area)
              if (film%wall%present) then
                flux(place) = flux(place) + wall_shares(film%geometry(element), film%law, film%wall_at(state%point), unknown(place))
              end if
            end associate
          end do
        end associate
      end do
      do j = 1, size(feed%mouth)
        of_mouth = state_of_mouth(bearing, j, state)
        associate (mouth => feed%mouth(j), place => bearing%pad(feed%mouth(j)%pad)%first + feed%mouth(j)%node)
          flux(place) = flux(place) + mouth%part*of_mouth%flow*mouth%weight
        end associate
      end do
      do j = 1, size(feed%line)
        associate (line => feed%line(j), place => bearing%pad(feed%line(j)%pad)%first + feed%line(j)%node)
          do i = 1, size(line%orifices)
            here = line_point(bearing, j, i, state)
            flux(place) = flux(place) + line%shape(:, i)*line%orifices(i)*here%flow
          end do
        end associate
      end do
      value = bearing%film_pressure(bearing%summed(flux))/bearing%film_pressure(bearing%summed(area))/feed%energy
    end associate
  end subroutine field_of_feed
end module gfb_feed_block
