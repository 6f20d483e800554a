!> What a bearing's supply gives: flow, power, and what each orifice does, over all ranks.
module gfb_feed_answer
  use gfb_kinds, only: wp
  use gfb_bearing, only: bearing_type
  use gfb_feed_law, only: critical_ratio, orifice_flow, supply_at
  use gfb_film_feed, only: film_feed_type, mouth_state_type, mouth_state
  use gfb_operating_point, only: operating_point_type
  use gfb_petsc_session, only: sum_over_ranks
  use gfb_wall_film, only: wall_shares
  implicit none (type, external)
  private
  public :: feed_answer, line_flow

  !> The supply, and its orifices row by row; of half a width with their mirror images, of one pad
  !> that stands for all those of the first.
  type, public :: feed_answer_type
    logical :: present = .false.
    real(wp) :: flow = 0.0_wp  !! of the whole bearing [kg/s]
    real(wp) :: power = 0.0_wp !! to compress it from ambient pressure, isothermal [W]
    real(wp), allocatable :: orifice(:)  !! flow of each into the film [kg/s]
    real(wp), allocatable :: pressure(:) !! in the mouth of each [Pa]
    integer :: choked = 0, backflow = 0  !! orifices of the whole bearing
  end type feed_answer_type

contains

  !> Reads the supply off a state. All ranks ask.
  function feed_answer(bearing, point, unknown, gap) result(answer)
    class(bearing_type), intent(in) :: bearing !! that is fed
    type(operating_point_type), intent(in) :: point !! with the shaft's position
    real(wp), intent(in) :: unknown(:) !! local, in SI
    real(wp), intent(in) :: gap(:)     !! at this rank's nodes of all films [m]
    type(feed_answer_type) :: answer
    real(wp) :: total(1)
    integer :: i, j, element

    answer%present = .true.
    total = 0.0_wp
    associate (feed => bearing%feed)
      do i = 1, size(bearing%pad)
        associate (pad => bearing%pad(i), film => bearing%pad(i)%film)
          if (.not. film%wall%present) cycle
          do element = 1, size(film%element_nodes, 2)
            associate (nodes => film%element_nodes(:, element))
              total = total + film%copies*sum(wall_shares(film%geometry(element), film%law, &
                                                          film%wall_at(point), &
                                                          unknown(pad%first + nodes)))
            end associate
          end do
        end associate
      end do
      do j = 1, size(feed%line)
        total = total + bearing%pad(feed%line(j)%pad)%film%copies* &
          line_flow(bearing, j, point, unknown, gap)
      end do
      total = sum_over_ranks(total)
      if (size(feed%mouth) > 0) call read_mouths(bearing, point%supply, unknown, total(1), answer)
      answer%flow = total(1)/feed%energy
      answer%power = total(1)*feed%work*part_of_work(feed, point%supply)
    end associate
  end function feed_answer

  !> Work to compress the gas to a part of the supply's pressure over ambient, over that to all of
  !> it: of an ideal gas [1].
  pure real(wp) function part_of_work(feed, part) result(work)
    type(film_feed_type), intent(in) :: feed
    real(wp), intent(in) :: part !! of what the supply has above ambient pressure [1]

    work = 1.0_wp
    if (.not. (feed%supply > feed%ambient .and. abs(part - 1.0_wp) > 0.0_wp)) return
    associate (reached => supply_at(feed%supply, feed%ambient, part))
      work = log(reached/feed%ambient)/log(feed%supply/feed%ambient)
    end associate
  end function part_of_work

  !> What a piece of a line feeds [Pa m3/s].
  pure real(wp) function line_flow(bearing, j, point, unknown, gap) result(total)
    class(bearing_type), intent(in) :: bearing !! that is fed
    integer, intent(in) :: j !! of the pieces
    type(operating_point_type), intent(in) :: point !! with the shaft's position
    real(wp), intent(in) :: unknown(:) !! local, in SI
    real(wp), intent(in) :: gap(:)     !! at this rank's nodes of all films [m]
    real(wp) :: flow, by_pressure, by_gap
    integer :: i

    total = 0.0_wp
    associate (line => bearing%feed%line(j), pad => bearing%pad(bearing%feed%line(j)%pad))
      do i = 1, size(line%orifices)
        call orifice_flow(bearing%feed%orifice_at(point%supply), &
                          dot_product(line%shape(:, i), unknown(pad%first + line%node)), &
                          dot_product(line%shape(:, i), gap(pad%first_node + line%node)) &
                          + dot_product(line%motion_excess(:, i), point%place), &
                          flow, by_pressure, by_gap)
        total = total + line%orifices(i)*flow
      end do
    end associate
  end function line_flow

  !> What each orifice does; the same on all ranks, which know all mouths' unknowns.
  subroutine read_mouths(bearing, part, unknown, total, answer)
    class(bearing_type), intent(in) :: bearing
    real(wp), intent(in) :: part !! of the supply that counts [1]
    real(wp), intent(in) :: unknown(:)
    real(wp), intent(inout) :: total !! flow of all [Pa m3/s]
    type(feed_answer_type), intent(inout) :: answer
    type(mouth_state_type) :: here
    real(wp) :: copies
    integer :: j, all_of_them

    associate (feed => bearing%feed)
      all_of_them = max(maxval(feed%mouth%number), maxval(feed%mouth%mirror))
      allocate (answer%orifice(all_of_them), answer%pressure(all_of_them), source=0.0_wp)
      do j = 1, size(feed%mouth)
        associate (mouth => feed%mouth(j))
          here = mouth_state(feed, j, unknown, part, bearing%pad(mouth%pad)%film%flow%viscosity)
          copies = bearing%pad(mouth%pad)%film%copies*mouth%part
          total = total + copies*here%flow
          answer%orifice([mouth%number, mouth%mirror]) = here%flow/feed%energy
          answer%pressure([mouth%number, mouth%mirror]) = here%pressure
          associate (orifice => feed%orifice_at(part))
            if (here%pressure <= critical_ratio(orifice%ratio)*orifice%supply_pressure) then
              answer%choked = answer%choked + nint(copies)
            end if
          end associate
          if (here%flow < 0.0_wp) answer%backflow = answer%backflow + nint(copies)
        end associate
      end do
    end associate
  end subroutine read_mouths
end module gfb_feed_answer
