!> Elements, rotations, sheets and closed paths for the tests of the contacts.
module contact_samples
  use gfb_kinds, only: wp
  use sample_vectors, only: numbers, rotation, cross
  use gfb_contact_law, only: contact_law_type, contact_force, carried_slip
  implicit none (type, external)
  private
  public :: sample_corner, surface_point, surface_normal, numbers, rotation, cross, sheet, &
            dissipated_work

  integer, parameter, public :: samples = 6 !! rectangle, skew, distorted, warped, wild, slender

contains

  !> Corners of one of the sample elements, counter-clockwise about z, then turned and shifted.
  pure function sample_corner(number) result(corner)
    integer, intent(in) :: number
    real(wp) :: corner(3, 4) !! [m]

    corner = 0.0_wp
    select case (number)
    case (1)
      corner(1, :) = [0.0_wp, 2.0_wp, 2.0_wp, 0.0_wp]
      corner(2, :) = [0.0_wp, 0.0_wp, 1.0_wp, 1.0_wp]
    case (2)
      corner(1, :) = [0.0_wp, 1.0_wp, 1.7_wp, 0.7_wp]
      corner(2, :) = [0.0_wp, 0.2_wp, 1.1_wp, 0.9_wp]
    case (3) ! almost a triangle
      corner(1, :) = [0.0_wp, 1.0_wp, 0.52_wp, 0.0_wp]
      corner(2, :) = [0.0_wp, 0.0_wp, 0.5_wp, 1.0_wp]
    case (4)
      corner(1, :) = [0.0_wp, 1.1_wp, 0.9_wp, -0.1_wp]
      corner(2, :) = [0.0_wp, 0.1_wp, 1.2_wp, 0.8_wp]
      corner(3, :) = [0.0_wp, 0.1_wp, 0.4_wp, -0.1_wp]
    case (5)
      corner(1, :) = [0.0_wp, 1.5_wp, 0.8_wp, -0.1_wp]
      corner(2, :) = [0.0_wp, -0.3_wp, 0.7_wp, 0.5_wp]
      corner(3, :) = [0.0_wp, 0.5_wp, -0.3_wp, 0.4_wp]
    case default
      corner(1, :) = [0.0_wp, 9.0_wp, 9.0_wp, 0.0_wp]
      corner(2, :) = [0.0_wp, 0.0_wp, 0.3_wp, 0.4_wp]
      corner(3, :) = [0.0_wp, 0.2_wp, 0.0_wp, 0.1_wp]
    end select
    corner = matmul(rotation([0.3_wp, -0.5_wp, 0.7_wp]), corner) &
      + spread([3.0_wp, -2.0_wp, 1.0_wp], 2, 4)
  end function sample_corner

  !> Point of a bilinear element, from the shape functions.
  pure function surface_point(corner, place) result(point)
    real(wp), intent(in) :: corner(3, 4) !! [m]
    real(wp), intent(in) :: place(2)     !! xi, eta
    real(wp) :: point(3)                 !! [m]

    point = 0.25_wp*((1.0_wp - place(1))*(1.0_wp - place(2))*corner(:, 1) &
                     + (1.0_wp + place(1))*(1.0_wp - place(2))*corner(:, 2) &
                     + (1.0_wp + place(1))*(1.0_wp + place(2))*corner(:, 3) &
                     + (1.0_wp - place(1))*(1.0_wp + place(2))*corner(:, 4))
  end function surface_point

  !> Unit normal of a bilinear element, from lines drawn across it, which are straight.
  pure function surface_normal(corner, place) result(normal)
    real(wp), intent(in) :: corner(3, 4) !! [m]
    real(wp), intent(in) :: place(2)     !! xi, eta
    real(wp) :: normal(3)                !! [1]
    real(wp) :: along(3), across(3)

    along = surface_point(corner, [1.0_wp, place(2)]) - surface_point(corner, [-1.0_wp, place(2)])
    across = surface_point(corner, [place(1), 1.0_wp]) - surface_point(corner, [place(1), -1.0_wp])
    normal = cross(along, across)
    normal = normal/norm2(normal)
  end function surface_normal

  !> A sheet of n by m elements over the unit square; element and node numbers run along x first.
  pure subroutine sheet(n, m, position, element_nodes)
    integer, intent(in) :: n, m
    real(wp), allocatable, intent(out) :: position(:, :)     !! (3, nodes), z = 0 [m]
    integer, allocatable, intent(out) :: element_nodes(:, :) !! (4, elements)
    integer :: i, j, node

    allocate (position(3, (n + 1)*(m + 1)), source=0.0_wp)
    allocate (element_nodes(4, n*m))
    do j = 0, m
      do i = 0, n
        node = 1 + i + j*(n + 1)
        position(:2, node) = [real(i, wp)/n, real(j, wp)/m]
        if (i < n .and. j < m) element_nodes(:, 1 + i + j*n) = node + [0, 1, n + 2, n + 1]
      end do
    end do
  end subroutine sheet

  !> Work that friction takes on a closed path in its second round; the first forgets how it began.
  !>
  !> The history moves on after each step. `early` is the weight of the force before a step,
  !> one half for the trapezoidal rule.
  pure function dissipated_work(law, length, penetration, path, early) result(work)
    type(contact_law_type), intent(in) :: law
    real(wp), intent(in) :: length      !! of contact line [m]
    real(wp), intent(in) :: penetration !! constant [m]
    real(wp), intent(in) :: path(:, :)  !! (2, points), the last equal to the first [m]
    real(wp), intent(in) :: early       !! [1]
    real(wp) :: work                    !! [J]
    real(wp) :: slip(2), carried(2), moved(2), force(3), before(3), derivative(3, 3)
    integer :: round, i

    work = 0.0_wp
    carried = 0.0_wp
    before = 0.0_wp
    do round = 1, 2
      do i = 2, size(path, 2)
        moved = path(:, i) - path(:, i - 1)
        slip = carried + moved
        call contact_force(law, length, [slip, penetration], force, derivative)
        if (round == 2) then
          work = work - dot_product(early*before(:2) + (1.0_wp - early)*force(:2), moved)
        end if
        before = force
        carried = carried_slip(law, slip, moved, force(3))
      end do
    end do
  end function dissipated_work
end module contact_samples
