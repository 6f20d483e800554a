!> The error of a number that was computed on nested meshes.
!>
!> With values f on meshes that are each twice as fine as the one before, the last three give the
!> order \( p = \log_2 |f_2 - f_1| / |f_3 - f_2| \), and the error of the finest one is estimated by
!>
!> $$ E = F_s \frac{|f_3 - f_2|}{2^q - 1} $$
!>
!> Source: grid convergence index, [Roache1994]; F_s and q after [OberkampfRoy2010]: F_s = 1.25
!> where p is within a tenth of the elements' order, otherwise 3; q is p, but not above the
!> elements' order. On two meshes q is that order, and F_s = 3. Where the values do not approach a
!> limit like that three times the differences themselves stand for the error. The largest or
!> smallest of nodal values is not extrapolated: the place of the extreme lies between nodes, now
!> nearer to one and now farther, so that values show an order, or a small difference, by chance.
!> Twice the last difference, or what the one before lets expect, \( |f_2 - f_1| / 2^q \) with the
!> elements' order, stands for its error, whichever is larger.
!>
!> Components of one tensor, such as a 2 x 2 block of stiffness, share one order: that of their
!> differences' Frobenius norms, which no turn of the axes changes. A single component's differences
!> may pass through zero although the tensor converges, and then show any order.
module gfb_grid_convergence
  use gfb_kinds, only: wp
  implicit none (type, external)
  private
  public :: estimate_error, estimate_errors

  real(wp), parameter :: trusted_factor = 1.25_wp !! F_s where the order is as it should be [1]
  real(wp), parameter :: doubtful_factor = 3.0_wp !! where it is not, or is not known [1]
  real(wp), parameter :: nodal_factor = 2.0_wp    !! of the largest or smallest nodal value [1]
  real(wp), parameter :: tolerance = 0.1_wp       !! of an order that is as it should be, relative
  real(wp), parameter :: lowest_order = 0.5_wp    !! an order below that is not believed [1]
  real(wp), parameter :: rounding = 1.0e-12_wp    !! differences that mean nothing, relative

  !> What nested meshes say of a number.
  type, public :: convergence_type
    real(wp) :: value = 0.0_wp        !! on the finest mesh
    real(wp) :: error = huge(1.0_wp)  !! estimated, absolute; huge on one mesh
    real(wp) :: order = 0.0_wp        !! observed [1]; 0: not known
    logical :: trusted = .false.      !! the values approach a limit with that order
  end type convergence_type

contains

  !> Judges values on meshes from coarse to fine.
  pure function estimate_error(value, formal_order, nodal) result(found)
    real(wp), intent(in) :: value(:) !! [in its unit] each mesh twice as fine as the one before
    real(wp), intent(in) :: formal_order !! of the elements [1]
    logical, intent(in) :: nodal !! the values are each the largest or smallest at the nodes
    type(convergence_type) :: found
    real(wp) :: last, before
    integer :: n

    n = size(value)
    found%value = value(n)
    if (n < 2) return
    last = value(n) - value(n - 1)
    if (n == 2) then
      found%error = doubtful_factor*abs(last)/(2.0_wp**formal_order - 1.0_wp)
      return
    end if
    before = value(n - 1) - value(n - 2)
    if (max(abs(last), abs(before)) <= rounding*maxval(abs(value))) then
      found%error = max(abs(last), abs(before))
      found%trusted = .true.
      return
    end if
    if (last*before > 0.0_wp) found%order = log(before/last)/log(2.0_wp)
    found%trusted = found%order >= lowest_order
    if (found%trusted .and. nodal) then
      found%error = nodal_factor*max(abs(last), abs(before)/2.0_wp**formal_order)
    else if (found%trusted) then
      ! A number that happens to converge faster will not go on so.
      found%error = abs(last)/(2.0_wp**min(found%order, formal_order) - 1.0_wp)
      if (abs(found%order - formal_order) <= tolerance*formal_order) then
        found%error = trusted_factor*found%error
      else
        found%error = doubtful_factor*found%error
      end if
    else
      found%error = doubtful_factor*max(abs(last), abs(before))
    end if
  end function estimate_error

  !> Judges the components of a tensor on meshes from coarse to fine; they share one order.
  !>
  !> Each has \( E = F_s \max(|f_3 - f_2|, |f_2 - f_1| / 2^q) / (2^q - 1) \), so that a difference
  !> that happens to vanish does not count.
  pure function estimate_errors(value, formal_order) result(found)
    real(wp), intent(in) :: value(:, :) !! [in one unit] (component, mesh), each mesh twice as fine
    real(wp), intent(in) :: formal_order !! of the elements [1]
    type(convergence_type) :: found(size(value, 1))
    real(wp), dimension(size(value, 1)) :: last, before
    real(wp) :: rest, factor, gain
    integer :: n, i

    n = size(value, 2)
    if (n < 3) then
      found = [(estimate_error(value(i, :), formal_order, nodal=.false.), i=1, size(found))]
      return
    end if
    last = value(:, n) - value(:, n - 1)
    before = value(:, n - 1) - value(:, n - 2)
    found%value = value(:, n)
    found%trusted = .true.
    rest = rounding*maxval(abs(value))
    if (max(norm2(last), norm2(before)) <= rest) then
      found%error = max(abs(last), abs(before))
      return
    end if
    found%order = log(max(norm2(before), rest)/max(norm2(last), rest))/log(2.0_wp)
    found%trusted = found%order >= lowest_order
    if (found(1)%trusted) then
      factor = doubtful_factor
      if (abs(found(1)%order - formal_order) <= tolerance*formal_order .and. &
          dot_product(last, before) > 0.0_wp) factor = trusted_factor
      gain = 2.0_wp**min(found(1)%order, formal_order)
      found%error = factor*max(abs(last), abs(before)/gain)/(gain - 1.0_wp)
    else
      found%error = doubtful_factor*max(abs(last), abs(before))
    end if
  end function estimate_errors
end module gfb_grid_convergence
