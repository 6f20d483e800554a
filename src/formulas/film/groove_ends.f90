!> What the ends of bands of grooves cost: a jump of the pressure in proportion to one over their
!> number.
!>
!> Where a band of N grooves ends, the flow of ridges and grooves becomes even within a pitch. Far
!> from there the film is that of `gfb_groove_film`, but its pressure has jumped between the two
!> sides of the end,
!>
!> $$ P_{in} - P_{out} = l \frac{12 \mu}{h^2} \Bigl( c_1 U + c_2 \frac{v}{h} \Bigr) $$
!>
!> with the pitch l along the motion, the flow v into the band over P, and numbers of the pattern,
!> \( c_1 \) for a motion that pumps into the band at an open end, out of it at one with a land; for
!> the other sense it changes its sign.
!>
!> Method: the linear film of one pitch, resolved, from the end, or from a land, to where it is as
!> in an endless band; biquadratic elements along the lines, LAPACK's band solver. Lengths are over
!> l, gaps over h.
module gfb_groove_ends
  use gfb_kinds, only: wp
  use gfb_units, only: pi
  use gfb_errors, only: error_type
  use gfb_film_geometry, only: film_geometry_type, film_geometry
  implicit none (type, external)
  private
  public :: end_numbers, end_jump, fit_ends

  integer, parameter, public :: end_open = 1, end_land = 2 !! what lies outside of the band's end

  integer, parameter, public :: fitted = 12 !! polynomials of a fit
  !> largest part of a groove's gap that is its depth, in a fit [1]
  real(wp), parameter :: narrowest = 0.96_wp

  !> Of h/(h + d) in both numbers, at an open end and at a land.
  integer, parameter :: powers(2, 2) = reshape([2, 3, 2, 0], [2, 2])

  integer, parameter :: sides = 8   !! elements of a groove, and of a ridge
  integer, parameter :: rows = 14   !! elements from the end on, to either side
  integer, parameter :: nodes = 9, line = 3 !! of an element, and of one of its sides
  integer, parameter :: around = 2*2*sides  !! nodes of a row
  real(wp), parameter :: reach = 3.0_wp     !! of the pieces from the end on [1]
  real(wp), parameter :: finest = 0.01_wp   !! of their elements, about [1]
  real(wp), parameter :: growth = 1.42_wp   !! of an element over the one before it [1]
  real(wp), parameter :: simpson(line) = [1.0_wp, 4.0_wp, 1.0_wp]/6.0_wp

  !> A band without ends: slope along the axis, and the flow that leaves through a groove and a
  !> ridge.
  type :: far_type
    real(wp) :: slope = 0.0_wp      !! along z [1]
    real(wp) :: bend(2) = 0.0_wp    !! slope across groove and ridge beside it [1]
    real(wp) :: flow(2) = 0.0_wp    !! along z in groove and ridge [1]
  end type far_type

  interface
    !> LAPACK: solves a symmetric, positive definite band system.
    pure subroutine dpbsv(uplo, n, kd, nrhs, ab, ldab, b, ldb, info)
      import :: wp
      implicit none (type, external)
      character(len=1), intent(in) :: uplo
      integer, intent(in) :: n, kd, nrhs, ldab, ldb
      real(wp), intent(inout) :: ab(ldab, n), b(ldb, nrhs)
      integer, intent(out) :: info
    end subroutine dpbsv
  end interface

contains

  !> The numbers of an end at a gap of the ridges, from their fit, and their derivatives by the gap.
  pure subroutine end_jump(fit, outside, depth, gap, numbers, by_gap)
    real(wp), intent(in) :: fit(:, :) !! (fitted, 2) see `fit_ends`
    integer, intent(in) :: outside    !! `end_open`, `end_land`
    real(wp), intent(in) :: depth     !! d [m]
    real(wp), intent(in) :: gap       !! h [m]
    real(wp), intent(out) :: numbers(2) !! c_1, c_2 [1]
    real(wp), intent(out) :: by_gap(2)  !! their derivatives by h [1/m]
    real(wp) :: part, part_by_gap, x, chebyshev(3), slope(3), scale, scale_by_gap
    real(wp) :: total(2), total_by_x(2)
    integer :: k, power

    part = depth/(gap + depth)
    part_by_gap = -part/(gap + depth)
    if (part > narrowest) then
      part = narrowest
      part_by_gap = 0.0_wp
    end if
    x = 2.0_wp*part/narrowest - 1.0_wp
    chebyshev = [1.0_wp, x, 0.0_wp]
    slope = [0.0_wp, 1.0_wp, 0.0_wp]
    total = fit(1, :) + x*fit(2, :)
    total_by_x = fit(2, :)
    do k = 3, size(fit, 1)
      chebyshev(3) = 2.0_wp*x*chebyshev(2) - chebyshev(1)
      slope(3) = 2.0_wp*chebyshev(2) + 2.0_wp*x*slope(2) - slope(1)
      total = total + fit(k, :)*chebyshev(3)
      total_by_x = total_by_x + fit(k, :)*slope(3)
      chebyshev(:2) = chebyshev(2:)
      slope(:2) = slope(2:)
    end do
    scale = gap/(gap + depth)
    scale_by_gap = depth/(gap + depth)**2
    do k = 1, 2
      power = powers(k, outside)
      numbers(k) = scale**power*total(k)
      by_gap(k) = scale**power*total_by_x(k)*2.0_wp/narrowest*part_by_gap
      if (power == 0) cycle
      by_gap(k) = by_gap(k) + real(power, wp)*scale**(power - 1)*scale_by_gap*total(k)
    end do
  end subroutine end_jump

  !> Chebyshev's polynomials of both numbers over d/(h + d), from 0 to 0.96, beyond which they keep
  !> their value: of \( c_1 (1 + d/h)^2 \), and of \( c_2 (1 + d/h)^3 \) at an open end, which stay
  !> finite; over a land \( c_2 \) does.
  !>
  !> Fails where the lines are along or across the motion as far as numbers go.
  pure subroutine fit_ends(angle, ridge_part, outside, fit, error)
    real(wp), intent(in) :: angle      !! of the lines with the motion, to (0, pi/2) [rad]
    real(wp), intent(in) :: ridge_part !! of the pattern [1]
    integer, intent(in) :: outside     !! `end_open`, `end_land`
    real(wp), intent(out) :: fit(fitted, 2)
    type(error_type), allocatable, intent(out) :: error
    real(wp) :: sample(fitted, 2), part, numbers(2)
    integer :: i, k

    do i = 1, fitted
      part = 0.5_wp*narrowest*(1.0_wp + cos(pi*(real(i, wp) - 0.5_wp)/real(fitted, wp)))
      call end_numbers(angle, ridge_part, part/(1.0_wp - part), outside, numbers, error)
      if (allocated(error)) return
      sample(i, :) = numbers/(1.0_wp - part)**powers(:, outside)
    end do
    do k = 1, fitted
      fit(k, :) = 0.0_wp
      do i = 1, fitted
        fit(k, :) = fit(k, :) + 2.0_wp/real(fitted, wp)*sample(i, :)* &
                    cos(pi*real(k - 1, wp)*(real(i, wp) - 0.5_wp)/real(fitted, wp))
      end do
    end do
    fit(1, :) = 0.5_wp*fit(1, :)
  end subroutine fit_ends

  !> The numbers c_1, c_2 of a pattern, at an open end into which it pumps, or at a land towards
  !> which it pumps.
  !>
  !> Fails where an element is folded over or the matrix has no factors.
  pure subroutine end_numbers(angle, ridge_part, depth, outside, numbers, error)
    real(wp), intent(in) :: angle      !! of the lines with the motion, to (0, pi/2) [rad]
    real(wp), intent(in) :: ridge_part !! of the pattern [1]
    real(wp), intent(in) :: depth      !! d/h [1]
    integer, intent(in) :: outside     !! `end_open`, `end_land`
    real(wp), intent(out) :: numbers(2) !! c_1, c_2 [1]
    type(error_type), allocatable, intent(out) :: error
    real(wp), allocatable :: z(:), matrix(:, :), pressure(:, :)
    real(wp) :: x(around + 1), cotangent, side
    type(far_type) :: far(2)
    integer :: first, k, info

    numbers = 0.0_wp
    ! Lines that rise with x pump up, into the band, on a surface at rest; at a land they fall.
    cotangent = merge(1.0_wp, -1.0_wp, outside == end_open)/tan(angle)
    x = [graded(0.0_wp, 1.0_wp - ridge_part), graded(1.0_wp - ridge_part, 1.0_wp), 1.0_wp]
    z = growing()
    first = 1
    if (outside == end_land) then
      first = size(z)
      z = [-z(size(z):2:-1), z]
    end if
    far(1) = band_without_ends(cotangent, ridge_part, depth, 1.0_wp, 0.0_wp)
    far(2) = band_without_ends(cotangent, ridge_part, depth, 0.0_wp, 1.0_wp)
    call assemble(x, z, first, cotangent, ridge_part, depth, far, matrix, pressure, error)
    if (allocated(error)) return
    call dpbsv('U', size(pressure, 1), size(matrix, 1) - 1, 2, matrix, size(matrix, 1), &
               pressure, size(pressure, 1), info)
    if (info /= 0) then
      error = error_type('the film at the end of a band has no answer')
      return
    end if
    do k = 1, 2
      associate (last => pressure(size(pressure, 1) - around + 1:, k))
        side = mean_of(x, last) - far(k)%slope*z(size(z))
        ! there the flow 1 needs the slope -1
        if (outside == end_land .and. k == 2) side = side - z(1)
        numbers(k) = side
      end associate
    end do
  end subroutine end_numbers

  !> A band that has no ends, at a motion U and a flow v along z.
  !>
  !> With \( \xi = x - z \cot b \) the pressure is \( s z + \varphi(\xi) \), and the flow across the
  !> lines is even, which gives \( \varphi' \); its mean over a pitch is 0.
  pure type(far_type) function band_without_ends(cotangent, ridge_part, depth, motion, flow) &
    result(far)
    real(wp), intent(in) :: cotangent, ridge_part, depth, motion, flow
    real(wp) :: share(2), gap(2), sine, flows(2), across
    integer :: k

    share = [1.0_wp - ridge_part, ridge_part]
    gap = [1.0_wp + depth, 1.0_wp]
    sine = 1.0_wp/(1.0_wp + cotangent**2) ! its square
    ! The mean flow is linear in the slope.
    do k = 1, 2
      far%slope = real(k - 1, wp)
      across = (motion*sum(share/gap**2) + cotangent*far%slope)/sum(share/gap**3)
      flows(k) = sum(share*(-gap**3*far%slope &
                            + cotangent*sine*(motion*gap + cotangent*gap**3*far%slope - across)))
    end do
    far%slope = (flow - flows(1))/(flows(2) - flows(1))
    across = (motion*sum(share/gap**2) + cotangent*far%slope)/sum(share/gap**3)
    far%bend = sine*(motion/gap**2 + cotangent*far%slope - across/gap**3)
    far%flow = -gap**3*(far%slope - cotangent*far%bend)
  end function band_without_ends

  !> Matrix of the film, upper triangle of its band, and right sides: of a motion without a flow, of
  !> a flow without a motion.
  pure subroutine assemble(x, z, first, cotangent, ridge_part, depth, far, matrix, right, error)
    real(wp), intent(in) :: x(:), z(:) !! of the nodes at the band's end; along it
    integer, intent(in) :: first !! row of the band's end
    real(wp), intent(in) :: cotangent, ridge_part, depth
    type(far_type), intent(in) :: far(2)
    real(wp), allocatable, intent(out) :: matrix(:, :), right(:, :)
    type(error_type), allocatable, intent(out) :: error
    type(film_geometry_type) :: geometry
    real(wp) :: position(2, nodes), stiffness(nodes, nodes), gap
    integer :: place(nodes), column, row, i, j, a, b
    logical :: groove

    allocate (matrix(3*around, around*size(z)), right(around*size(z), 2), source=0.0_wp)
    do row = 1, size(z) - 2, 2
      do column = 1, around, 2
        do i = 0, line - 1
          do j = 0, line - 1
            a = i*line + j + 1
            position(:, a) = [x(column + i) + cotangent*max(z(row + j), 0.0_wp), z(row + j)]
            place(a) = (row + j - 1)*around + modulo(column + i - 1, around) + 1
          end do
        end do
        call film_geometry(position, geometry, error)
        if (allocated(error)) return
        groove = row >= first .and. x(column) < 1.0_wp - ridge_part
        gap = merge(1.0_wp + depth, 1.0_wp, groove)
        stiffness = 0.0_wp
        do i = 1, nodes
          associate (g => geometry%gradient(:, :, i), area => geometry%area(i))
            do a = 1, nodes
              stiffness(:, a) = stiffness(:, a) + area*gap**3*(g(1, :)*g(1, a) + g(2, :)*g(2, a))
            end do
            right(place, 1) = right(place, 1) + area*gap*g(1, :)
          end associate
        end do
        do b = 1, nodes
          do a = 1, nodes
            if (place(a) > place(b) .or. place(a) <= around) cycle
            associate (entry => matrix(3*around + place(a) - place(b), place(b)))
              entry = entry + stiffness(a, b)
            end associate
          end do
        end do
        if (row /= size(z) - 2) cycle
        do i = 0, line - 1
          a = i*line + line
          right(place(a), :) = right(place(a), :) - (x(column + 2) - x(column))*simpson(i + 1)* &
                               [far(1)%flow(merge(1, 2, groove)), far(2)%flow(merge(1, 2, groove))]
        end do
      end do
    end do
    matrix(3*around, :around) = 1.0_wp
    right(:around, :) = 0.0_wp
  end subroutine assemble

  !> Mean over a pitch of the values of a row [1].
  pure real(wp) function mean_of(x, row) result(mean)
    real(wp), intent(in) :: x(:)
    real(wp), intent(in) :: row(:)
    integer :: i, k

    mean = 0.0_wp
    do i = 1, around, 2
      do k = 0, line - 1
        mean = mean + (x(i + 2) - x(i))*simpson(k + 1)*row(modulo(i + k - 1, around) + 1)
      end do
    end do
  end function mean_of

  !> Places of nodes between two edges, without the last, elements narrower towards both.
  pure function graded(first, last) result(place)
    real(wp), intent(in) :: first, last
    real(wp) :: place(2*sides)
    real(wp), parameter :: rate = 1.8_wp
    real(wp) :: side(0:sides)
    integer :: i

    side = [(0.5_wp*(first + last) + 0.5_wp*(last - first)* &
             tanh(rate*(2.0_wp*real(i, wp)/real(sides, wp) - 1.0_wp))/tanh(rate), i=0, sides)]
    place(1::2) = side(:sides - 1)
    place(2::2) = 0.5_wp*(side(:sides - 1) + side(1:))
  end function graded

  !> Places of nodes from a band's end on, elements longer and longer.
  pure function growing() result(place)
    real(wp) :: place(2*rows + 1)
    real(wp) :: side(0:rows)
    integer :: i

    side(0) = 0.0_wp
    do i = 1, rows
      side(i) = side(i - 1) + finest*growth**(i - 1)
    end do
    side = side*(reach/side(rows))
    place(1::2) = side
    place(2::2) = 0.5_wp*(side(:rows - 1) + side(1:))
  end function growing
end module gfb_groove_ends
