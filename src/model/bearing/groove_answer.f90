!> What grooves do to a bearing's film: how far they pump it up, and what flows out of its ends,
!> over all ranks.
module gfb_groove_answer
  use gfb_kinds, only: wp
  use gfb_bearing, only: bearing_type
  use gfb_gas_film, only: gas_film_type
  use gfb_operating_point, only: operating_point_type
  use gfb_pad, only: pad_type
  use gfb_petsc_session, only: sum_over_ranks
  implicit none (type, external)
  private
  public :: groove_answer

  !> Pressure and flows of the whole bearing; of films on both sides of a runner the sum of flows.
  type, public :: groove_answer_type
    logical :: present = .false.
    real(wp) :: pumped = 0.0_wp  !! largest mean over theta of p - p_a [Pa]
    real(wp) :: flow(2) = 0.0_wp !! out of the ends of lower and of higher z, or radius [Pa m3/s]
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
      associate (pad => bearing%pad(i), nodes => bearing%pad(i)%last_node - bearing%pad(i)%first_node)
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
