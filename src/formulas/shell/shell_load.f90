!> Film pressure on a foil of shells: forces on the nodes that film and foil share.
module gfb_shell_load
  use gfb_kinds, only: wp
  implicit none (type, external)
  private
  public :: pressure_weights

contains

  !> Weights of the nodal overpressures in the nodal forces, for an element of area one.
  !>
  !> $$ f_a = - \int_{\Omega^e} N_a (p - p_a) \, \mathbf{n} \, d\Omega
  !>        = - \mathbf{n} \, \Omega^e \sum_b W_{ab} (p_b - p_a), \qquad
  !>    W_{ab} = \frac{1}{\Omega^e} \int_{\Omega^e} N_a M_b \, d\Omega $$
  !>
  !> Source: [Gu2020] eq. 2. \( M_b \) are the shape functions of the film's element, \( N_a \)
  !> those of the shells, bilinear in each of the cells between its nodes. The top foil is loaded as
  !> it was before it deformed: flat, its elements rectangles. So there are no couples, and the
  !> integral is the product of two over lines of length one.
  pure function pressure_weights(nodes) result(weight)
    integer, intent(in) :: nodes          !! of the film's element: 4, round it, or 9, row by row
    real(wp) :: weight(nodes, nodes)      !! W, (force, overpressure) [1]

    integer, parameter :: corners = 4
    ! Over a line: two linear functions; linear functions on both halves times quadratic ones.
    real(wp), parameter :: linear(2, 2) = reshape([2.0_wp, 1.0_wp, 1.0_wp, 2.0_wp], [2, 2])/6.0_wp
    real(wp), parameter :: quadratic(3, 3) = reshape( &
      [7.0_wp, 2.0_wp, -1.0_wp, 6.0_wp, 20.0_wp, 6.0_wp, -1.0_wp, 2.0_wp, 7.0_wp], [3, 3])/48.0_wp
    integer, parameter :: along(corners) = [1, 2, 2, 1], across(corners) = [1, 1, 2, 2]
    integer, parameter :: station_of(9) = [1, 1, 1, 2, 2, 2, 3, 3, 3]
    integer, parameter :: row_of(9) = [1, 2, 3, 1, 2, 3, 1, 2, 3]

    if (nodes == corners) then
      weight = linear(along, along)*linear(across, across)
    else
      weight = quadratic(station_of, station_of)*quadratic(row_of, row_of)
    end if
  end function pressure_weights
end module gfb_shell_load
