!> What grooves do to a bearing's film: how far they pump it up, and what flows out of its ends,
!> over all ranks.
module gfb_groove_answer
  use gfb_kinds, only: wp
  use gfb_bearing, only: bearing_type
  use gfb_gas_film, only: gas_film_type
  use gfb_groove_ends, only: end_open, end_land
  use gfb_groove_film, only: groove_type, groove_jump
  use gfb_operating_point, only: operating_point_type
  use gfb_pad, only: pad_type
  use gfb_petsc_session, only: sum_over_ranks, largest_over_ranks
  implicit none (type, external)
  private
  public :: groove_answer

  !> Pressure and flows of the whole bearing; of films on both sides of a runner the sum of flows.
  type, public :: groove_answer_type
    logical :: present = .false.
    real(wp) :: pumped = 0.0_wp  !! largest mean over theta of p - p_a [Pa]
    real(wp) :: flow(2) = 0.0_wp !! out of the ends of lower and of higher z, or radius [Pa m3/s]
    logical :: weighed = .false.   !! it is known what the ends of bands cost
    real(wp) :: end_loss = 0.0_wp !! that, over the pressure that would be pumped up without [1]
  end type groove_answer_type

  !> Shares of an element's nodes in its length along the motion: trapezoidal rule, Simpson's.
  real(wp), parameter :: corner_share(4) = 0.5_wp
  real(wp), parameter :: line_share(9) = [1.0_wp, 1.0_wp, 1.0_wp, 4.0_wp, 4.0_wp, 4.0_wp, 1.0_wp, &
                                          1.0_wp, 1.0_wp]/6.0_wp

contains

  !> Reads pressure and flows off a state. All ranks ask.
  function groove_answer(bearing, point, unknown, gap) result(answer)
    class(bearing_type), intent(in) :: bearing !! with grooves
    type(operating_point_type), intent(in) :: point !! with the shaft's position
    real(wp), intent(in) :: unknown(:) !! local, in SI
    real(wp), intent(in) :: gap(:)     !! at this rank's nodes of all films [m]
    type(groove_answer_type) :: answer
    real(wp) :: mean(bearing%mesh%rows(), 2) !! (rows, pressure and length)
    real(wp), allocatable :: flows(:)
    integer :: i

    answer%present = .true.
    mean = 0.0_wp
    do i = 1, size(bearing%pad)
      associate (pad => bearing%pad(i), nodes => bearing%pad(i)%last_node &
          - bearing%pad(i)%first_node)
        associate (pressure => unknown(pad%first + 1:pad%first + nodes))
          flows = spread(0.0_wp, 1, nodes)
          call pad%film%add_flows(pressure, gap(pad%first_node + 1:pad%last_node), point, flows)
          call add_outflows(bearing, pad%film, flows, answer%flow)
          call add_means(pad, pressure - bearing%ambient_pressure, mean)
        end associate
      end associate
    end do
    answer%flow = sum_over_ranks(answer%flow)
    mean = reshape(sum_over_ranks(pack(mean, .true.)), shape(mean))
    answer%pumped = maxval(mean(:, 1)/mean(:, 2))
    call read_end_loss(bearing, point, unknown, gap, answer)
  end function groove_answer

  !> Adds what flows out of the ends of this rank's film.
  pure subroutine add_outflows(bearing, film, flows, outflow)
    class(bearing_type), intent(in) :: bearing
    type(gas_film_type), intent(in) :: film
    real(wp), intent(in) :: flows(:) !! into the film at its nodes [Pa m3/s]
    real(wp), intent(inout) :: outflow(2)
    integer :: i

    associate (rows => bearing%mesh%row_axial)
      do i = 1, size(flows)
        if (.not. film%fixed(i)) cycle
        if (film%axial(i) >= rows(size(rows))) then
          outflow(2) = outflow(2) - film%copies*flows(i)
        else if (film%axial(i) <= rows(1)) then
          outflow(1) = outflow(1) - film%copies*flows(i)
        end if
      end do
    end associate
    if (bearing%mesh%half) outflow = 0.5_wp*sum(outflow)
  end subroutine add_outflows

  !> What the ends of a band cost it, in the mean of all bands, where that is modelled.
  !>
  !> Pressure is lost where it jumps down into the band at an open end, and down to the land.
  subroutine read_end_loss(bearing, point, unknown, gap, answer)
    class(bearing_type), intent(in) :: bearing
    type(operating_point_type), intent(in) :: point
    real(wp), intent(in) :: unknown(:), gap(:)
    type(groove_answer_type), intent(inout) :: answer
    real(wp), allocatable :: jump(:, :, :) ! (jump times area and area, end, band)
    type(groove_type) :: groove
    real(wp) :: most(1), lost
    integer :: i, k, element

    most = 0.0_wp
    do i = 1, size(bearing%pad)
      do element = 1, size(bearing%pad(i)%film%element_nodes, 2)
        groove = bearing%pad(i)%film%groove_of(element)
        most = max(most, real(groove%end%band, wp))
      end do
    end do
    most = largest_over_ranks(most)
    if (nint(most(1)) == 0) return
    allocate (jump(2, end_open:end_land, nint(most(1))), source=0.0_wp)
    do i = 1, size(bearing%pad)
      associate (pad => bearing%pad(i), film => bearing%pad(i)%film)
        do element = 1, size(film%element_nodes, 2)
          groove = film%groove_of(element)
          if (groove%end%band == 0) cycle
          associate (nodes => film%element_nodes(:, element), geometry => film%geometry(element), &
                     excess => film%excess(element, point), &
                     inside => film%element_gap(element, unknown(pad%first + 1:pad%last), &
                                                gap(pad%first_node + 1:pad%last_node)), &
                     sums => jump(:, groove%end%outside, groove%end%band))
            sums = sums + [groove_jump(geometry, film%flow_at(point), film%law, groove, &
                                       unknown(pad%first + nodes), inside, excess(:size(nodes))), &
                           sum(geometry%area)]
          end associate
        end do
      end associate
    end do
    jump = reshape(sum_over_ranks(pack(jump, .true.)), shape(jump))
    lost = 0.0_wp
    do k = 1, size(jump, 3)
      if (jump(2, end_open, k) > 0.0_wp) lost = lost - jump(1, end_open, k)/jump(2, end_open, k)
      if (jump(2, end_land, k) > 0.0_wp) lost = lost + jump(1, end_land, k)/jump(2, end_land, k)
    end do
    lost = lost/real(count(sum(jump(2, :, :), 1) > 0.0_wp), wp)
    answer%weighed = .true.
    if (abs(answer%pumped + lost) > 0.0_wp) answer%end_loss = lost/(answer%pumped + lost)
  end subroutine read_end_loss

  !> Adds to the integrals along the motion of each row, those of the pressure and of one.
  pure subroutine add_means(pad, pressure, mean)
    type(pad_type), intent(in) :: pad
    real(wp), intent(in) :: pressure(:) !! at its nodes, over ambient [Pa]
    real(wp), intent(inout) :: mean(:, :) !! (rows, 2)
    real(wp) :: share(size(pad%film%element_nodes, 1))
    integer :: element, i, row

    if (size(share) == size(corner_share)) then
      share = corner_share
    else
      share = line_share
    end if
    do element = 1, size(pad%film%element_nodes, 2)
      associate (nodes => pad%film%element_nodes(:, element))
        associate (length => maxval(pad%film%geometry(element)%stream_length))
          do i = 1, size(nodes)
            row = modulo(pad%mesh%mesh_node(nodes(i)) - 1, size(mean, 1)) + 1
            mean(row, :) = mean(row, :) + length*share(i)*[pressure(nodes(i)), 1.0_wp]
          end do
        end associate
      end associate
    end do
  end subroutine add_means
end module gfb_groove_answer
