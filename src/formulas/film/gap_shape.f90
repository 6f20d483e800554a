!> Shapes that parts of the rigid gap have: heights over the surface that the bearing's dimensions
!> describe, towards the shaft, which are taken off the gap.
!>
!> That is of first order: the slope of a height is small. A shape is the sum of what is smooth, and
!> of what is straight along the motion between kinks, angles where the slope jumps.
!>
!> An element of the film takes heights at its Gauss points. Where kinks lie inside it, it takes
!> there the polynomial of its own degree that is nearest to what is straight between them: what a
!> table has between the points of an element counts, however many points of the table that are.
module gfb_gap_shape
  use gfb_kinds, only: wp
  use gfb_sorting, only: sorted
  use gfb_units, only: turn
  implicit none (type, external)
  private
  public :: add_shape, kinks_of, kinks_between, height_of, count_up_to

  real(wp), parameter :: same_angle = 1.0e-9_wp !! kinks that are nearer are one [rad]
  real(wp), parameter :: at_end = 1.0e-8_wp     !! nearer is at an end, over a line [1]

  !> A shape. One without procedures of its own has no height.
  type, abstract, public :: gap_shape_type
    logical :: of_each_pad = .false. !! it begins anew on every pad; else it lies around the circle
    !> it is straight between its kinks: where sides of elements lie on them shape functions have it
    logical :: on_sides = .false.
  contains
    procedure :: smooth => no_height
    procedure :: add_kinked => add_nothing
    procedure :: kinks => no_kinks
    procedure, non_overridable :: height, in_element, rising_kinks, peak
  end type gap_shape_type

  !> A shape of a list, and what the part of the gap is called.
  type, public :: gap_shape_item_type
    character(len=:), allocatable :: name
    class(gap_shape_type), allocatable :: shape
  end type gap_shape_item_type

contains

  !> Adds a shape to a list.
  pure subroutine add_shape(name, shape, list)
    character(len=*), intent(in) :: name !! of the part
    class(gap_shape_type), intent(in) :: shape !! its own
    type(gap_shape_item_type), allocatable, intent(inout) :: list(:) !! not allocated: it begins
    type(gap_shape_item_type), allocatable :: longer(:)
    integer :: i, n

    n = 0
    if (allocated(list)) n = size(list)
    allocate (longer(n + 1))
    do i = 1, n
      call move_alloc(list(i)%name, longer(i)%name)
      call move_alloc(list(i)%shape, longer(i)%shape)
    end do
    longer(n + 1)%name = name
    allocate (longer(n + 1)%shape, source=shape)
    call move_alloc(longer, list)
  end subroutine add_shape

  !> Height of what is smooth [m]: none.
  pure real(wp) function no_height(self, angle, along) result(height)
    class(gap_shape_type), intent(in) :: self !! the shape
    real(wp), intent(in) :: angle !! theta [rad]
    real(wp), intent(in) :: along !! s, see `gfb_film_surface` [m]
    height = 0.0_wp
  end function no_height

  !> Adds what is straight between kinks: nothing.
  pure subroutine add_nothing(self, angle, along, height)
    class(gap_shape_type), intent(in) :: self !! the shape
    real(wp), intent(in) :: angle !! theta [rad]
    real(wp), intent(in) :: along !! s [m]
    real(wp), intent(inout) :: height !! [m]
  end subroutine add_nothing

  !> Angles from an origin on where the slope jumps, in any order [rad]: none.
  pure function no_kinks(self, origin, arc) result(kink)
    class(gap_shape_type), intent(in) :: self !! the shape
    real(wp), intent(in) :: origin !! [rad]
    !> points of a table that are nearer to both neighbours bend as a curve does [rad]
    real(wp), intent(in) :: arc
    real(wp), allocatable :: kink(:)
    allocate (kink(0))
  end function no_kinks

  !> Height at a place, towards the shaft [m].
  pure real(wp) function height(self, angle, along)
    class(gap_shape_type), intent(in) :: self !! the shape
    real(wp), intent(in) :: angle !! theta [rad]
    real(wp), intent(in) :: along !! s [m]

    height = self%smooth(angle, along)
    call self%add_kinked(angle, along, height)
  end function height

  !> Heights of all shapes of a list together [m].
  pure real(wp) function height_of(list, angle, along) result(height)
    type(gap_shape_item_type), intent(in) :: list(:) !! shapes
    real(wp), intent(in) :: angle !! theta [rad]
    real(wp), intent(in) :: along !! s [m]
    integer :: i

    height = 0.0_wp
    do i = 1, size(list)
      height = height + list(i)%shape%height(angle, along)
    end do
  end function height_of

  !> Angles in [0, 2 pi) from an origin on where slopes jump, rising; those of several equal pads as
  !> if all were where the first one is.
  !>
  !> Points of a table that are nearer than a given arc to the one before and to the next are left
  !> out: they bend as a curve does, everywhere a little.
  pure function kinks_of(list, origin, turn_of_pad, arc) result(kink)
    type(gap_shape_item_type), intent(in) :: list(:) !! shapes, those of each pad on the first one
    real(wp), intent(in) :: origin !! [rad]
    real(wp), intent(in), optional :: turn_of_pad(:) !! from the first one to each [rad]
    real(wp), intent(in), optional :: arc !! default: 0, all points of a table [rad]
    real(wp), allocatable :: kink(:) !! [rad]
    real(wp), allocatable :: left(:), own(:)
    real(wp) :: shortest
    integer :: i, k

    shortest = 0.0_wp
    if (present(arc)) shortest = arc
    allocate (left(0))
    do k = 1, size(list)
      own = list(k)%shape%kinks(origin, shortest)
      if (present(turn_of_pad) .and. .not. list(k)%shape%of_each_pad) then
        own = [(own - turn_of_pad(i), i=1, size(turn_of_pad))]
      end if
      left = [left, own]
    end do
    kink = in_order(left)
  end function kinks_of

  !> All its angles where the slope jumps, in [0, 2 pi), rising [rad].
  pure function rising_kinks(self) result(kink)
    class(gap_shape_type), intent(in) :: self !! the shape
    real(wp), allocatable :: kink(:)
    kink = in_order(self%kinks(0.0_wp, 0.0_wp))
  end function rising_kinks

  !> Angles in [0, 2 pi), rising, each one once.
  pure function in_order(angle) result(kink)
    real(wp), intent(in) :: angle(:) !! [rad]
    real(wp), allocatable :: kink(:) !! [rad]
    real(wp) :: left(size(angle))
    integer :: i

    left = modulo(angle, turn)
    where (turn - left < same_angle) left = 0.0_wp
    left = sorted(left)
    kink = pack(left, [(i == 1 .or. left(i) > left(max(i - 1, 1)) + same_angle, i=1, size(left))])
  end function in_order

  !> Largest height at s = 0, at a kink or near one of many points around [m].
  pure real(wp) function peak(self)
    class(gap_shape_type), intent(in) :: self !! the shape
    integer, parameter :: points = 7200
    real(wp), allocatable :: angle(:)
    integer :: i

    angle = [[(turn*real(i, wp)/real(points, wp), i=0, points - 1)], self%rising_kinks()]
    peak = self%height(angle(1), 0.0_wp)
    do i = 2, size(angle)
      peak = max(peak, self%height(angle(i), 0.0_wp))
    end do
  end function peak

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

  !> Heights at places of an element, what is straight between kinks by the nearest polynomial.
  !>
  !> $$ b_w(x_i) + \sum_{k=0}^{n} \frac{2 k + 1}{2} P_k(x_i) \int_{-1}^{1} b_s P_k \, dx $$
  !>
  !> with places \( x_i \) from -1 at one end to 1 at the other, Legendre's polynomials P, \( b_w \)
  !> what is smooth, and \( b_s \) what is straight between kinks. This polynomial of least squares
  !> has the moments of \( b_s \) up to its degree; of a smooth curve it has the values at the n + 1
  !> Gauss points but for derivatives of the order n + 2. The integrals are exact: a piece between
  !> two kinks has two points of its own, enough for a straight line times a parabola.
  pure function in_element(self, ends, inside, degree, angle, along) result(height)
    class(gap_shape_type), intent(in) :: self !! the shape
    real(wp), intent(in) :: ends(2)   !! of the element along the motion, rising [rad]
    real(wp), intent(in) :: inside(:) !! kinks between them, rising [rad]
    integer, intent(in) :: degree     !! n of the polynomial, 2 at most
    real(wp), intent(in) :: angle(:)  !! theta of what is asked for [rad]
    real(wp), intent(in) :: along(:)  !! s of the same [m]
    real(wp) :: height(size(angle))   !! [m]
    real(wp), parameter :: abscissa(2) = [-1.0_wp, 1.0_wp]/sqrt(3.0_wp)
    real(wp) :: bound(size(inside) + 2), middle, half, piece, at, straight
    integer :: i, j, k, place

    bound = [ends(1), inside, ends(2)]
    middle = 0.5_wp*sum(ends)
    half = 0.5_wp*(ends(2) - ends(1))
    do place = 1, size(angle)
      height(place) = self%smooth(angle(place), along(place))
      do i = 1, size(bound) - 1
        piece = 0.5_wp*(bound(i + 1) - bound(i))
        do j = 1, size(abscissa)
          at = bound(i) + piece*(1.0_wp + abscissa(j))
          straight = 0.0_wp
          call self%add_kinked(at, along(place), straight)
          do k = 0, degree
            height(place) = height(place) + 0.5_wp*real(2*k + 1, wp)*straight*piece/half* &
              legendre(k, (at - middle)/half)*legendre(k, (angle(place) - middle)/half)
          end do
        end do
      end do
    end do
  end function in_element

  !> Legendre's polynomial of a degree up to 2 [1].
  elemental real(wp) function legendre(degree, x) result(value)
    integer, intent(in) :: degree
    real(wp), intent(in) :: x !! [1]

    value = 1.0_wp
    if (degree == 1) value = x
    if (degree == 2) value = 1.5_wp*x**2 - 0.5_wp
  end function legendre
end module gfb_gap_shape
