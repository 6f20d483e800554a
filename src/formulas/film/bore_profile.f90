!> A bore that is no circle: waves (lobes), shims under the foil, a measured or worn profile.
!>
!> Its height \( b(\theta) \) over the circle of the clearance, towards the shaft, is subtracted
!> from the rigid gap. That is of first order: the slope of b is small, and foils at rest lie on the
!> bore.
!>
!> An element of the film takes b at its Gauss points. Where kinks of shims or table lie inside it,
!> it takes there the polynomial of its own degree that is nearest to them: what a table has between
!> the points of an element counts, however many points of the table that are.
module gfb_bore_profile
  use gfb_kinds, only: wp
  use gfb_units, only: turn
  implicit none (type, external)
  private
  public :: bore_height, bore_kinks, kinks_between, bore_peak, nearest_bore

  real(wp), parameter :: same_angle = 1.0e-9_wp      !! kinks that are nearer are one [rad]
  real(wp), parameter :: at_end = 1.0e-8_wp          !! nearer is at an end, over a line [1]

  !> Height of a bore over the circle; none where nothing is set.
  type, public :: bore_profile_type
    integer :: waves = 0                    !! around the circle
    real(wp) :: wave_amplitude = 0.0_wp     !! [m]
    real(wp) :: wave_angle = 0.0_wp         !! of a crest [rad]
    real(wp), allocatable :: shim_angle(:)  !! middle of each shim [rad]
    real(wp), allocatable :: shim_height(:) !! of its plateau [m]
    real(wp), allocatable :: shim_arc(:)    !! whole arc of its plateau [rad]
    real(wp), allocatable :: shim_ramp(:)   !! arc of the ramp on each side [rad]
    real(wp), allocatable :: table_angle(:)  !! rising, less than a turn in all [rad]
    real(wp), allocatable :: table_height(:) !! there, linear between and around [m]
  contains
    procedure :: present => bore_is_present
  end type bore_profile_type

contains

  !> Whether the bore is not simply a circle.
  pure logical function bore_is_present(self) result(present)
    class(bore_profile_type), intent(in) :: self !! the bore
    present = self%waves > 0 .or. allocated(self%shim_angle) .or. allocated(self%table_angle)
  end function bore_is_present

  !> Height at an angle, towards the shaft.
  !>
  !> $$ b = a \cos n(\theta - \theta_w) + \sum_i t_i \min\Bigl(1, \max\Bigl(0,
  !>    1 - \frac{|\theta - \theta_i| - \alpha_i/2}{\beta_i}\Bigr)\Bigr) + b_t(\theta) $$
  !>
  !> with shims of height t, arc \( \alpha \) of the plateau and \( \beta \) of each ramp, and the
  !> table's piecewise linear \( b_t \).
  pure function bore_height(profile, angle) result(height)
    type(bore_profile_type), intent(in) :: profile !! the bore
    real(wp), intent(in) :: angle !! theta [rad]
    real(wp) :: height            !! b [m]

    height = wave_height(profile, angle)
    call add_shims_and_table(profile, angle, height)
  end function bore_height

  !> Height of the waves alone [m].
  pure real(wp) function wave_height(profile, angle) result(height)
    type(bore_profile_type), intent(in) :: profile
    real(wp), intent(in) :: angle !! [rad]

    height = 0.0_wp
    if (profile%waves > 0) then
      height = profile%wave_amplitude*cos(profile%waves*(angle - profile%wave_angle))
    end if
  end function wave_height

  !> Adds what is straight between kinks: shims and table.
  pure subroutine add_shims_and_table(profile, angle, height)
    type(bore_profile_type), intent(in) :: profile
    real(wp), intent(in) :: angle !! [rad]
    real(wp), intent(inout) :: height !! [m]
    real(wp) :: distance
    integer :: i

    if (allocated(profile%shim_angle)) then
      do i = 1, size(profile%shim_angle)
        distance = abs(modulo(angle - profile%shim_angle(i) + 0.5_wp*turn, turn) - 0.5_wp*turn)
        distance = (distance - 0.5_wp*profile%shim_arc(i))/profile%shim_ramp(i)
        height = height + profile%shim_height(i)*min(1.0_wp, max(0.0_wp, 1.0_wp - distance))
      end do
    end if
    if (allocated(profile%table_angle)) height = height + table_value(profile, angle)
  end subroutine add_shims_and_table

  !> Height of the table, which is periodic.
  pure function table_value(profile, angle) result(height)
    type(bore_profile_type), intent(in) :: profile
    real(wp), intent(in) :: angle !! [rad]
    real(wp) :: height            !! [m]
    real(wp) :: beyond, width     !! of the interval's beginning; of the interval [rad]
    integer :: last, next

    associate (angles => profile%table_angle, heights => profile%table_height)
      beyond = modulo(angle - angles(1), turn)
      last = max(1, count_up_to(angles, beyond, angles(1)))
      next = modulo(last, size(angles)) + 1
      width = modulo(angles(next) - angles(last), turn)
      if (.not. width > 0.0_wp) width = turn
      beyond = (beyond - (angles(last) - angles(1)))/width
      height = heights(last) + beyond*(heights(next) - heights(last))
    end associate
  end function table_value

  !> How many of rising numbers, counted from an origin, are not larger than another.
  pure integer function count_up_to(rising, number, origin) result(count)
    real(wp), intent(in) :: rising(:) !! in any unit [SI]
    real(wp), intent(in) :: number, origin !! in their unit [SI]
    integer :: beyond, middle

    count = 0
    beyond = size(rising) + 1
    do while (beyond - count > 1)
      middle = (count + beyond)/2
      if (rising(middle) - origin <= number) then
        count = middle
      else
        beyond = middle
      end if
    end do
  end function count_up_to

  !> Angles in [0, 2 pi) where the slope jumps, rising; those of several equal pads as if all were
  !> where the first one is.
  !>
  !> Points of the table that are nearer than a given arc to the one before and to the next are left
  !> out: they bend as a curve does, everywhere a little.
  pure function bore_kinks(profile, turn_of_pad, arc) result(kink)
    type(bore_profile_type), intent(in) :: profile !! the bore
    real(wp), intent(in), optional :: turn_of_pad(:) !! from the first one to each [rad]
    real(wp), intent(in), optional :: arc !! default: 0, all points of the table [rad]
    real(wp), allocatable :: kink(:) !! [rad]
    real(wp), allocatable :: left(:)
    integer :: i

    allocate (left(0))
    if (allocated(profile%table_angle)) then
      left = profile%table_angle
      if (present(arc)) left = pack(left, stands_alone(left, arc))
    end if
    if (allocated(profile%shim_angle)) then
      associate (middle => profile%shim_angle, half => 0.5_wp*profile%shim_arc, &
                 ramp => profile%shim_ramp)
        left = [left, middle - half - ramp, middle - half, middle + half, middle + half + ramp]
      end associate
    end if
    if (present(turn_of_pad)) left = [(left - turn_of_pad(i), i=1, size(turn_of_pad))]
    left = modulo(left, turn)
    where (turn - left < same_angle) left = 0.0_wp
    call sort(left)
    kink = pack(left, [(i == 1 .or. left(i) > left(max(i - 1, 1)) + same_angle, i=1, size(left))])
  end function bore_kinks

  !> Whether points of a table are at least an arc from the one before or from the next.
  pure function stands_alone(angle, arc) result(alone)
    real(wp), intent(in) :: angle(:) !! rising, less than a turn in all [rad]
    real(wp), intent(in) :: arc      !! [rad]
    logical :: alone(size(angle))
    real(wp) :: further(size(angle)) !! from each to the next [rad]

    further = modulo(cshift(angle, 1) - angle, turn)
    alone = further >= arc .or. cshift(further, -1) >= arc .or. size(angle) == 1
  end function stands_alone

  !> Puts numbers into rising order, by runs of 1, 2, 4, ... that are merged.
  pure subroutine sort(number)
    real(wp), intent(inout) :: number(:) !! in any unit [SI]
    real(wp) :: merged(size(number))
    integer :: width, first, middle, last, left, right, i
    logical :: take_left

    width = 1
    do while (width < size(number))
      do first = 1, size(number), 2*width
        middle = min(first + width, size(number) + 1)
        last = min(first + 2*width - 1, size(number))
        left = first
        right = middle
        do i = first, last
          take_left = right > last
          if (.not. take_left .and. left < middle) take_left = number(left) <= number(right)
          merged(i) = number(merge(left, right, take_left))
          left = left + merge(1, 0, take_left)
          right = right + merge(0, 1, take_left)
        end do
      end do
      number = merged
      width = 2*width
    end do
  end subroutine sort

  !> Kinks inside a line of an element along the motion, unwound to where it is.
  pure function kinks_between(kink, ends) result(inside)
    real(wp), intent(in) :: kink(:) !! in [0, 2 pi), rising [rad]
    real(wp), intent(in) :: ends(2) !! of the line, rising, less than a turn apart [rad]
    real(wp), allocatable :: inside(:) !! rising [rad]
    real(wp) :: first, width

    first = modulo(ends(1), turn)
    width = ends(2) - ends(1)
    associate (before => count_up_to(kink, first, 0.0_wp), &
               last => count_up_to(kink, first + width, 0.0_wp), &
               wound => count_up_to(kink, first + width - turn, 0.0_wp))
      inside = [kink(before + 1:last), kink(:wound) + turn] - first
    end associate
    inside = ends(1) + pack(inside, inside > at_end*width .and. inside < (1.0_wp - at_end)*width)
  end function kinks_between

  !> Heights of the bore at places on a line, its shims and table by the nearest polynomial.
  !>
  !> $$ b_w(x_i) + \sum_{k=0}^{n} \frac{2 k + 1}{2} P_k(x_i) \int_{-1}^{1} b_s P_k \, dx $$
  !>
  !> with places \( x_i \) from -1 at one end to 1 at the other, Legendre's polynomials P, the waves
  !> \( b_w \), and \( b_s \) what shims and table add to them. This polynomial of least squares has
  !> the moments of \( b_s \) up to its degree; of a smooth curve it has the values at the n + 1
  !> Gauss points but for derivatives of the order n + 2. The integrals are exact: a piece between
  !> two kinks has two points of its own, enough for a straight line times a parabola.
  pure function nearest_bore(profile, ends, inside, degree, place) result(height)
    type(bore_profile_type), intent(in) :: profile !! the bore
    real(wp), intent(in) :: ends(2)   !! of the line, rising [rad]
    real(wp), intent(in) :: inside(:) !! kinks between them, rising [rad]
    integer, intent(in) :: degree     !! n of the polynomial, 2 at most
    real(wp), intent(in) :: place(:)  !! of what is asked for [rad]
    real(wp) :: height(size(place))   !! [m]
    real(wp), parameter :: abscissa(2) = [-1.0_wp, 1.0_wp]/sqrt(3.0_wp)
    real(wp) :: bound(size(inside) + 2), middle, half, piece, angle, straight
    integer :: i, j, k

    bound = [ends(1), inside, ends(2)]
    middle = 0.5_wp*sum(ends)
    half = 0.5_wp*(ends(2) - ends(1))
    height = [(wave_height(profile, place(i)), i=1, size(place))]
    do i = 1, size(bound) - 1
      piece = 0.5_wp*(bound(i + 1) - bound(i))
      do j = 1, size(abscissa)
        angle = bound(i) + piece*(1.0_wp + abscissa(j))
        straight = 0.0_wp
        call add_shims_and_table(profile, angle, straight)
        do k = 0, degree
          height = height + 0.5_wp*real(2*k + 1, wp)*straight*piece/half* &
            legendre(k, (angle - middle)/half)*legendre(k, (place - middle)/half)
        end do
      end do
    end do
  end function nearest_bore

  !> Legendre's polynomial of a degree up to 2 [1].
  elemental real(wp) function legendre(degree, x) result(value)
    integer, intent(in) :: degree
    real(wp), intent(in) :: x !! [1]

    value = 1.0_wp
    if (degree == 1) value = x
    if (degree == 2) value = 1.5_wp*x**2 - 0.5_wp
  end function legendre

  !> Largest height, at a kink or near one of many points around [m].
  pure real(wp) function bore_peak(profile) result(peak)
    type(bore_profile_type), intent(in) :: profile !! the bore
    integer, parameter :: points = 7200
    real(wp), allocatable :: angle(:)
    integer :: i

    angle = [[(turn*real(i, wp)/real(points, wp), i=0, points - 1)], bore_kinks(profile)]
    peak = bore_height(profile, angle(1))
    do i = 2, size(angle)
      peak = max(peak, bore_height(profile, angle(i)))
    end do
  end function bore_peak
end module gfb_bore_profile
