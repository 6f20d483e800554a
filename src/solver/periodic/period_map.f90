!> A map over one period: where all that a march remembers is after a number of equal steps of time.
!>
!> A state is what films and foils remember (`gfb_film_entries`), and the shaft's motions and their
!> rates, now and one step ago. As the past is part of it, a state that the map leads back to itself
!> is an orbit whose steps wrap round: it has no first step that differs from the others. Contacts
!> that always stick stay as they began, so an orbit closes whatever they are.
!>
!> A point x holds the state, the period and one parameter, all over their sizes; every rank has its
!> own unknowns of the films and all of the rest.
module gfb_period_map
  use gfb_kinds, only: wp
  use gfb_text, only: text
  use gfb_units, only: pi
  use gfb_petsc_session, only: sum_over_ranks
  use gfb_film_entries, only: film_entries_type
  implicit none (type, external)
  private
  public :: lay_out, begin_orbit, no_step, pack_shaft, unpack_shaft, dots, length_of, &
            parameter_of, period_of, speed_of, driven_at, last_step

  !> What the parameter is.
  integer, parameter, public :: moved_speed = 1, moved_unbalance = 2, moved_mass = 3
  integer, parameter :: parameters = 3

  !> The map.
  type, abstract, public :: period_map_type
    !> Speed [rad/s], unbalance [kg m] and mass [kg], but for the parameter.
    real(wp) :: driven(parameters) = 0.0_wp
    integer :: parameter = 0         !! `moved_speed`, ...; 0: none
    logical :: free = .false.        !! the period is an unknown; else it is that of turns
    integer :: turns = 1             !! of the shaft in a period, where it is not free
    real(wp) :: stretch = 1.0_wp     !! of that period [1]
    integer :: steps = 0             !! of a period
    real(wp) :: period_scale = 1.0_wp    !! [s]
    real(wp) :: parameter_scale = 1.0_wp !! [its unit]
    real(wp), allocatable :: scale(:) !! of the shaft's motions [m], [1]
    real(wp) :: clock = 1.0_wp       !! rates over motions [1/s]
    !> (motions, rates; now, one step ago) of a disturbance that all modes are part of [1]
    real(wp), allocatable :: start(:)
    type(film_entries_type), allocatable :: film(:) !! of each bearing
    integer :: local = 0             !! entries of a point that no other rank has
    integer :: tail = 0              !! those that every rank has; the last: period, parameter
    integer :: periods = 0           !! marched so far
    character(len=32), allocatable :: place(:) !! where orbits are shown
    !> (x and y of each place, steps + 1) in the last of the periods [m]
    real(wp), allocatable :: orbit(:, :)
    real(wp) :: smallest_gap = 0.0_wp    !! in it, where the orbit was kept [m]
    character(len=:), allocatable :: problem !! why it had no end
  contains
    procedure(rest_interface), deferred :: rest
    procedure :: release => stay_at_rest
    procedure(apply_interface), deferred :: apply
    procedure(touches_interface), deferred :: touches_down
  end type period_map_type

  abstract interface
    !> The point at which all rests in its present state, with the drive's parameter and the map's
    !> own period.
    function rest_interface(self) result(x)
      import :: period_map_type, wp
      implicit none (type, external)
      class(period_map_type), intent(in) :: self !! laid out, its bearings in equilibrium
      real(wp), allocatable :: x(:) !! [1]
    end function rest_interface

    !> The point one period later, with the same period and parameter; `.false.` where a step has no
    !> answer.
    !>
    !> A step that would have to be shortened has none: all steps are equal.
    function apply_interface(self, x, y, keep) result(done)
      import :: period_map_type, wp
      implicit none (type, external)
      !> counts periods; gets the orbit; its bearings are left at the end
      class(period_map_type), intent(inout) :: self
      real(wp), intent(in) :: x(:)  !! the point [1]
      real(wp), intent(out) :: y(:) !! one period later [1]
      logical, intent(in) :: keep   !! the smallest gap of the orbit is wanted
      logical :: done
    end function apply_interface

    !> Which bearing's shaft touched down in the orbit that was kept; empty where none.
    function touches_interface(self) result(where)
      import :: period_map_type
      implicit none (type, external)
      class(period_map_type), intent(in) :: self !! after an orbit
      character(len=:), allocatable :: where
    end function touches_interface
  end interface

contains

  !> Where entries stand, once films and the scales of the shaft are there.
  subroutine lay_out(map)
    class(period_map_type), intent(inout) :: map !! with `film`, `scale`
    integer :: i

    map%local = 0
    do i = 1, size(map%film)
      map%film(i)%first = map%local
      map%local = map%local + map%film(i)%entries()
    end do
    map%tail = 4*size(map%scale) + 2
  end subroutine lay_out

  !> Gives a point of rest the past of a shaft that is released there, as a march over time has it:
  !> rest, where the march does not say more.
  subroutine stay_at_rest(self, x)
    class(period_map_type), intent(in) :: self !! laid out, its bearings in equilibrium, kept
    real(wp), intent(inout) :: x(:) !! that equilibrium [1]
  end subroutine stay_at_rest

  !> One period more, with room for its orbit.
  pure subroutine begin_orbit(map)
    class(period_map_type), intent(inout) :: map !! the map

    map%periods = map%periods + 1
    map%smallest_gap = huge(1.0_wp)
    if (allocated(map%orbit)) deallocate (map%orbit)
    allocate (map%orbit(2*size(map%place), map%steps + 1))
  end subroutine begin_orbit

  !> Why a period had no end.
  pure function no_step(map, step, reason) result(problem)
    class(period_map_type), intent(in) :: map !! the map
    integer, intent(in) :: step !! that has no answer
    character(len=*), intent(in) :: reason !! why, where that is known
    character(len=:), allocatable :: problem

    problem = 'step '//text(step)//' of '//text(map%steps)//' has no answer at its length'
    if (reason /= '') problem = problem//': '//reason
  end function no_step

  !> Motions and rates of the shaft as entries.
  pure subroutine pack_shaft(map, motion, rate, x)
    class(period_map_type), intent(in) :: map !! the map
    real(wp), intent(in) :: motion(:, :) !! (motions, 2) now and one step ago [m], [1]
    real(wp), intent(in) :: rate(:, :)   !! (motions, 2) [m/s], [1/s]
    real(wp), intent(inout) :: x(:) !! the point [1]
    integer :: k

    associate (n => size(map%scale), shaft => map%local)
      do k = 1, 2
        x(shaft + (k - 1)*n + 1:shaft + k*n) = motion(:, k)/map%scale
        x(shaft + (k + 1)*n + 1:shaft + (k + 2)*n) = rate(:, k)/(map%scale*map%clock)
      end do
    end associate
  end subroutine pack_shaft

  !> The reverse.
  pure subroutine unpack_shaft(map, x, motion, rate)
    class(period_map_type), intent(in) :: map !! the map
    real(wp), intent(in) :: x(:) !! the point [1]
    real(wp), intent(out) :: motion(:, :) !! (motions, 2) now and one step ago [m], [1]
    real(wp), intent(out) :: rate(:, :)   !! (motions, 2) [m/s], [1/s]
    integer :: k

    associate (n => size(map%scale), shaft => map%local)
      do k = 1, 2
        motion(:, k) = x(shaft + (k - 1)*n + 1:shaft + k*n)*map%scale
        rate(:, k) = x(shaft + (k + 1)*n + 1:shaft + (k + 2)*n)*map%scale*map%clock
      end do
    end associate
  end subroutine unpack_shaft

  !> By how much a point differs from what it was one step ago: films and foils, motions, rates.
  pure function last_step(map, x) result(row)
    class(period_map_type), intent(in) :: map !! the map
    real(wp), intent(in) :: x(:) !! the point [1]
    real(wp) :: row(size(x))
    integer :: i

    row = 0.0_wp
    do i = 1, size(map%film)
      associate (first => map%film(i)%first, many => map%film(i)%owned)
        row(first + 1:first + many) = x(first + 1:first + many) - x(first + many + 1:first + 2*many)
      end associate
    end do
    associate (shaft => map%local, n => size(map%scale))
      row(shaft + 1:shaft + n) = x(shaft + 1:shaft + n) - x(shaft + n + 1:shaft + 2*n)
      row(shaft + 2*n + 1:shaft + 3*n) = x(shaft + 2*n + 1:shaft + 3*n) - &
                                         x(shaft + 3*n + 1:shaft + 4*n)
    end associate
  end function last_step

  !> The parameter of a point.
  pure function parameter_of(map, x) result(value)
    class(period_map_type), intent(in) :: map !! the map
    real(wp), intent(in) :: x(:) !! the point [1]
    real(wp) :: value !! [its unit]
    value = x(size(x))*map%parameter_scale
  end function parameter_of

  !> Speed, unbalance and mass at a point.
  pure function driven_at(map, x) result(driven)
    class(period_map_type), intent(in) :: map !! the map
    real(wp), intent(in) :: x(:) !! the point [1]
    real(wp) :: driven(parameters) !! [rad/s], [kg m], [kg]

    driven = map%driven
    if (map%parameter > 0) driven(map%parameter) = parameter_of(map, x)
  end function driven_at

  !> The shaft's speed at a point.
  pure function speed_of(map, x) result(speed)
    class(period_map_type), intent(in) :: map !! the map
    real(wp), intent(in) :: x(:) !! the point [1]
    real(wp) :: speed !! [rad/s]
    real(wp) :: driven(parameters)

    driven = driven_at(map, x)
    speed = driven(moved_speed)
  end function speed_of

  !> The period of a point.
  pure function period_of(map, x) result(period)
    class(period_map_type), intent(in) :: map !! the map
    real(wp), intent(in) :: x(:) !! the point [1]
    real(wp) :: period !! [s]

    period = x(size(x) - 1)*map%period_scale
    if (map%free) return
    period = map%stretch*2.0_wp*pi*map%turns/speed_of(map, x)
  end function period_of

  !> Inner products of columns with a point, over all ranks.
  function dots(map, columns, x) result(product)
    class(period_map_type), intent(in) :: map !! the map
    real(wp), intent(in) :: columns(:, :) !! (entries, columns) [1]
    real(wp), intent(in) :: x(:) !! (entries) [1]
    real(wp) :: product(size(columns, 2))
    integer :: many

    many = map%local
    product = matmul(x(:many), columns(:many, :))
    if (size(product) > 0) product = sum_over_ranks(product)
    product = product + matmul(x(many + 1:), columns(many + 1:, :))
  end function dots

  !> Length of a point, over all ranks.
  function length_of(map, x) result(length)
    class(period_map_type), intent(in) :: map !! the map
    real(wp), intent(in) :: x(:) !! (entries) [1]
    real(wp) :: length !! [1]
    length = sqrt(sum(dots(map, reshape(x, [size(x), 1]), x)))
  end function length_of
end module gfb_period_map
