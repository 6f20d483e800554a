!> Sides of elements where something lies: of a film's on angles where the gap has a kink, of top
!> foil and film above the crests.
module gfb_aligned_mesh
  use gfb_kinds, only: wp
  use gfb_units, only: turn
  use gfb_film_mesh, only: film_mesh_type, find_interval
  implicit none (type, external)
  private
  public :: align_stations, align_graded, kinks_inside, aligned_stations, elements_at_ends, &
            largest_change

  real(wp), parameter :: on_side = 1.0e-8_wp         !! nearer is on a side, over an element [1]
  real(wp), parameter :: rounding = 1.0e-9_wp        !! of lengths that fit exactly, relative [1]
  real(wp), parameter :: alike = 1.0e-6_wp           !! of elements, that is none [1]
  real(wp), parameter :: shortest = 0.25_wp          !! element it makes, over an equal one [1]
  real(wp), parameter :: longest = 2.0_wp            !! the same: a kink moves a side by half of one
  !> of an element over its neighbour: one and a half beside the shortest [1]
  real(wp), parameter, public :: most_change = 6.0_wp

contains

  !> Puts the nearest side of an element on each kink; between them elements are equal.
  !>
  !> A kink that would leave an element too short stays inside one. Where kinks are more than sides
  !> can follow, those of a dense run stay inside all together, and then one by one those where an
  !> element is out of proportion to its neighbour, until none is: a mesh has as many elements as
  !> before, none longer than twice an equal one.
  pure subroutine align_stations(mesh, kink)
    type(film_mesh_type), intent(inout) :: mesh !! of equal elements
    real(wp), intent(in) :: kink(:) !! angles in [0, 2 pi), rising [rad]
    real(wp), dimension(mesh%circumferential()/mesh%order + 1) :: equal, side
    real(wp), allocatable :: angle(:)
    logical, allocatable :: dense(:)
    integer :: worst

    equal = sides(mesh)
    angle = equal(1) + modulo(kink - equal(1), turn) ! a pad may reach beyond 2 pi
    if (size(kink) > 0) angle = cshift(angle, minloc(angle, 1) - 1)
    side = sides_on(equal, angle)
    worst = out_of_proportion(side, mesh%periodic)
    if (worst > 0) then
      dense = in_dense_run(angle, (equal(size(equal)) - equal(1))/real(size(equal) - 1, wp))
      angle = pack(angle, .not. dense)
      side = sides_on(equal, angle)
      worst = out_of_proportion(side, mesh%periodic)
    end if
    do while (worst > 0 .and. size(angle) > 0)
      call leave_nearest(side(worst), mesh%periodic, angle)
      side = sides_on(equal, angle)
      worst = out_of_proportion(side, mesh%periodic)
    end do
    call put_sides(mesh, side)
  end subroutine align_stations

  !> The same on a mesh whose elements differ by intent: in places counted by elements they are
  !> equal, so that none gets out of proportion to what it was.
  pure subroutine align_graded(mesh, kink)
    type(film_mesh_type), intent(inout) :: mesh !! of a pad
    real(wp), intent(in) :: kink(:) !! angles in [0, 2 pi), rising [rad]
    type(film_mesh_type) :: even
    real(wp), dimension(mesh%circumferential()/mesh%order + 1) :: before, side
    real(wp) :: angle(size(kink)), element, share
    integer :: i, k, n

    before = sides(mesh)
    n = size(before)
    element = (before(n) - before(1))/real(n - 1, wp)
    angle = before(1) + modulo(kink - before(1), turn)
    do i = 1, size(kink)
      if (angle(i) > before(n)) cycle
      call find_interval(before, angle(i), k, share)
      angle(i) = before(1) + element*(real(k - 1, wp) + share)
    end do
    even = mesh
    call put_sides(even, [(before(1) + element*real(i, wp), i=0, n - 1)])
    call align_stations(even, angle)
    side = (sides(even) - before(1))/element
    do i = 1, n
      k = min(max(int(side(i)), 0), n - 2)
      side(i) = before(k + 1) + (side(i) - real(k, wp))*(before(k + 2) - before(k + 1))
    end do
    call put_sides(mesh, side)
  end subroutine align_graded

  !> Equal sides, moved onto kinks.
  pure function sides_on(equal, angle) result(side)
    real(wp), intent(in) :: equal(:) !! [rad]
    real(wp), intent(in) :: angle(:) !! of kinks, from the first side on, rising [rad]
    real(wp) :: side(size(equal))
    real(wp) :: element
    integer :: i, last, near, n

    n = size(equal)
    side = equal
    element = (side(n) - side(1))/real(n - 1, wp)
    last = 1
    do i = 1, size(angle)
      if (angle(i) - side(last) < shortest*element) cycle
      if (side(n) - angle(i) < shortest*element) exit
      near = min(max(last + 1, 1 + nint((angle(i) - side(1))/element)), n - 1)
      if (near <= last) exit
      call spread_sides(side, last, near, angle(i))
      last = near
    end do
    if (last > 1) call spread_sides(side, last, n, side(n))
  end function sides_on

  !> Number of the side between two elements of which one is too long against the other or against
  !> an equal one, where that is worst; 0: there is none.
  pure integer function out_of_proportion(side, ring) result(worst)
    real(wp), intent(in) :: side(:) !! [rad]
    logical, intent(in) :: ring !! the last side is the first
    real(wp) :: length(size(side)) !! behind each side [rad]
    real(wp) :: before, most, here
    integer :: i, n

    n = size(side)
    length(:n - 1) = side(2:) - side(:n - 1)
    length(n) = length(merge(1, n - 1, ring)) ! of a pad nothing follows
    worst = 0
    most = 1.0_wp + rounding
    do i = 2, n
      before = length(i - 1)
      if (.not. min(before, length(i)) > 0.0_wp) then
        worst = i
        return
      end if
      here = max(max(before, length(i))/min(before, length(i))/most_change, &
                 max(before, length(i))*real(n - 1, wp)/(side(n) - side(1))/longest)
      if (here <= most) cycle
      most = here
      worst = i
    end do
  end function out_of_proportion

  !> Whether kinks belong to a run, each nearer to the next than an element, that has more of them
  !> than sides may lie there.
  pure function in_dense_run(angle, element) result(dense)
    real(wp), intent(in) :: angle(:) !! rising [rad]
    real(wp), intent(in) :: element  !! an equal one [rad]
    logical :: dense(size(angle))
    integer :: first, last

    dense = .false.
    first = 1
    do while (first <= size(angle))
      last = first
      do while (last < size(angle))
        if (angle(last + 1) - angle(last) >= element) exit
        last = last + 1
      end do
      dense(first:last) = last - first + 1 > int((angle(last) - angle(first))/element) + 2
      first = last + 1
    end do
  end function in_dense_run

  !> Leaves out the kink that is nearest to a side.
  pure subroutine leave_nearest(side, ring, angle)
    real(wp), intent(in) :: side !! [rad]
    logical, intent(in) :: ring !! a turn on it is the same
    real(wp), allocatable, intent(inout) :: angle(:) !! of the kinks, one at least [rad]
    real(wp) :: distance(size(angle))
    integer :: nearest

    distance = abs(angle - side)
    if (ring) distance = min(distance, turn - distance)
    nearest = minloc(distance, 1)
    angle = [angle(:nearest - 1), angle(nearest + 1:)]
  end subroutine leave_nearest

  !> Longest element over its neighbour along the motion, and across it, and where: angle, and place
  !> along a row.
  pure subroutine largest_change(mesh, change, place)
    type(film_mesh_type), intent(in) :: mesh !! the film's mesh
    real(wp), intent(out) :: change(2) !! [1]
    real(wp), intent(out) :: place(2)  !! of the sides between them [rad], [m]

    call find_change(sides(mesh), mesh%periodic, change(1), place(1))
    call find_change(mesh%row_axial(1::mesh%order), .false., change(2), place(2))
  end subroutine largest_change

  !> The same of one row of sides.
  pure subroutine find_change(side, ring, change, place)
    real(wp), intent(in) :: side(:) !! rising, two at least, in any unit [SI]
    logical, intent(in) :: ring !! the last is the first
    real(wp), intent(out) :: change, place !! [1], in their unit [SI]
    real(wp) :: length(size(side) - 1), here
    integer :: i, n

    n = size(length)
    length = side(2:) - side(:n)
    change = 1.0_wp
    place = side(1)
    do i = merge(1, 2, ring), n
      associate (before => length(merge(n, i - 1, i == 1)))
        here = max(before, length(i))/min(before, length(i))
      end associate
      if (here <= change) cycle
      change = here
      place = side(i)
    end do
  end subroutine find_change

  !> How many kinks lie on the pad, and how many of them inside an element.
  pure subroutine kinks_inside(mesh, kink, on_pad, inside)
    type(film_mesh_type), intent(in) :: mesh !! the film's mesh
    real(wp), intent(in) :: kink(:) !! angles in [0, 2 pi) [rad]
    integer, intent(out) :: on_pad, inside !! of them
    real(wp) :: side(mesh%circumferential()/mesh%order + 1), element, angle
    integer :: i

    side = sides(mesh)
    element = (side(size(side)) - side(1))/real(size(side) - 1, wp)
    on_pad = 0
    inside = 0
    do i = 1, size(kink)
      angle = side(1) + modulo(kink(i) - side(1) + on_side*element, turn) - on_side*element
      if (angle > side(size(side)) + on_side*element) cycle
      on_pad = on_pad + 1
      if (minval(abs(side - angle)) > on_side*element) inside = inside + 1
    end do
  end subroutine kinks_inside

  !> Angles where elements meet, those of a ring with the turn's end [rad].
  pure function sides(mesh) result(side)
    type(film_mesh_type), intent(in) :: mesh
    real(wp) :: side(mesh%circumferential()/mesh%order + 1)

    if (mesh%periodic) then
      side = [mesh%station_angle(1::mesh%order), mesh%station_angle(1) + turn]
    else
      side = mesh%station_angle(1::mesh%order)
    end if
  end function sides

  !> Puts one side at an angle, and those after the last one that stands evenly between.
  pure subroutine spread_sides(side, last, near, angle)
    real(wp), intent(inout) :: side(:) !! [rad]
    integer, intent(in) :: last, near  !! sides
    real(wp), intent(in) :: angle      !! of the second [rad]
    integer :: i

    do i = last + 1, near - 1
      side(i) = side(last) + (angle - side(last))*real(i - last, wp)/real(near - last, wp)
    end do
    side(near) = angle
  end subroutine spread_sides

  !> Stations of given sides; those of biquadratic elements have one in their middle.
  pure subroutine put_sides(mesh, side)
    type(film_mesh_type), intent(inout) :: mesh
    real(wp), intent(in) :: side(:) !! [rad]
    integer :: i

    do i = 1, size(side)
      associate (station => mesh%order*(i - 1) + 1)
        if (station <= mesh%stations()) mesh%station_angle(station) = side(i)
        if (mesh%order == 2 .and. i < size(side)) then
          mesh%station_angle(station + 1) = 0.5_wp*(side(i) + side(i + 1))
        end if
      end associate
    end do
  end subroutine put_sides

  !> Stations from x = 0 to a pad's length with one above every crest: equal elements from crest to
  !> crest, before the first and behind the last one elements of at most 1.5 times their length, or
  !> as many as are given.
  pure function aligned_stations(length, crest, pitch, elements, at_ends) result(x)
    real(wp), intent(in) :: length   !! of the pad [m]
    real(wp), intent(in) :: crest(:) !! positions on the pad, rising [m]
    real(wp), intent(in) :: pitch    !! regular [m]
    integer, intent(in) :: elements  !! of a pitch
    !> before the first crest and behind the last one; 0: as many as fit
    integer, intent(in), optional :: at_ends(2)
    real(wp), allocatable :: x(:)
    real(wp) :: bound(size(crest) + 2)
    integer :: fitting(2), i, k, n

    bound = [0.0_wp, crest, length]
    fitting = elements_at_ends(length, crest, pitch, elements)
    if (present(at_ends)) fitting = merge(at_ends, fitting, at_ends > 0)
    x = bound(:1)
    do i = 1, size(bound) - 1
      n = elements
      if (i > size(crest)) n = fitting(2)
      if (i == 1) n = fitting(1)
      if (bound(i + 1) - bound(i) <= rounding*pitch) cycle ! a crest at the pad's edge
      x = [x, (bound(i) + (bound(i + 1) - bound(i))*k/n, k=1, n - 1), bound(i + 1)]
    end do
  end function aligned_stations

  !> Elements that fit before the first crest and behind the last one; of two numbers that fit alike
  !> the smaller one, whatever rounding makes of half a pitch with an odd number of elements.
  pure function elements_at_ends(length, crest, pitch, elements) result(number)
    real(wp), intent(in) :: length   !! of the pad [m]
    real(wp), intent(in) :: crest(:) !! positions on the pad, rising [m]
    real(wp), intent(in) :: pitch    !! regular [m]
    integer, intent(in) :: elements  !! of a pitch
    integer :: number(2)
    real(wp) :: bound(size(crest) + 2)

    bound = [0.0_wp, crest, length]
    associate (last => size(bound))
      number = max(1, nint([bound(2) - bound(1), bound(last) - bound(last - 1)]/pitch*elements &
                           - alike))
    end associate
  end function elements_at_ends
end module gfb_aligned_mesh
