#include "gfb_petsc.h"
!> The map of a bearing and its shaft over one period: where a state is after a number of equal steps of time.
!>
!> A state is all that the march remembers: film, foil and sleeve now and one step ago, and the sleeve's velocity then and
!> now. As the past is part of it, a state that the map leads back to itself is an orbit whose steps wrap round: it has no
!> first step that differs from the others. Contacts with friction remember their slips as well, which are then part of the
!> state: those of contacts that always stick stay as they began, so an orbit closes whatever they are. So are, now and one step
!> ago, the deflections of damped springs under local pressures, which have no unknowns, and the ways of the dashpots of Maxwell arms.
!>
!> A point x holds the state, the period and one parameter, all over their sizes; every rank has its own unknowns and all of
!> the rest.
module gfb_period_map
  use petscvec
  use gfb_kinds, only: wp
  use gfb_units, only: pi
  use gfb_spring_history, only: spring_history_type, begin_springs
  use gfb_march_state, only: march_settings_type
  use gfb_bearing_system, only: bearing_system_type
  use gfb_text, only: text
  use gfb_petsc_session, only: sum_over_ranks
  use gfb_shaft_drive, only: shaft_drive_type
  use gfb_contact_memory, only: slips_of, put_slips, slip_entries
  use gfb_newton, only: newton_type, newton_report_type
  use gfb_time_march, only: march_type, begin_march, resume_march, take_step, end_march
  use gfb_map_springs, only: remembered_by, pack_springs, unpack_springs
  implicit none (type)
  private
  public :: create_map, rest_of, release, apply_map, dots, length_of, parameter_of, period_of, drive_at

  integer, parameter, public :: moved_speed = 1, moved_unbalance = 2, moved_mass = 3 !! what the parameter is
  integer, parameter :: planar = 2                      !! components of a place
  integer, parameter :: shaft_entries = 4*planar !! of a point: places, then velocities, now and one step ago
  integer, parameter, public :: tail = shaft_entries + 2 !! entries that every rank has; the last: period, parameter

  !> The map.
  type, public :: period_map_type
    type(bearing_system_type), pointer :: bearing => null() !! whose shaft is free
    type(newton_type), pointer :: newton => null()          !! its solver
    type(shaft_drive_type) :: drive  !! but for the parameter
    integer :: parameter = 0         !! `moved_speed`, ...; 0: none
    logical :: free = .false.        !! the period is an unknown; else it is that of turns
    integer :: turns = 1             !! of the shaft in a period, where it is not free
    real(wp) :: stretch = 1.0_wp     !! of that period [1]
    integer :: steps = 0             !! of a period
    type(march_settings_type) :: settings !! what dissipates in the foils; steps are the map's own
    real(wp) :: period_scale = 1.0_wp    !! [s]
    real(wp) :: parameter_scale = 1.0_wp !! [its unit]
    real(wp) :: length = 1.0_wp      !! of places [m]
    real(wp) :: clock = 1.0_wp       !! velocities over places [1/s]
    real(wp) :: share = 1.0_wp       !! weight of one unknown of film and foil [1]
    integer :: owned = 0             !! unknowns of this rank
    logical :: rubs = .false.        !! contacts have friction, whose slips are part of the state
    integer :: slips = 0             !! of this rank's contacts, where they rub
    integer, allocatable :: remembered(:) !! what springs remember beside the unknowns
    integer :: springs = 0           !! entries of that
    integer :: local = 0             !! entries of a point that no other rank has
    integer :: periods = 0           !! marched so far
    real(wp), allocatable :: orbit(:, :) !! (2, steps + 1) the sleeve's places in the last of them [m]
    real(wp) :: smallest_gap = 0.0_wp    !! in it, where the orbit was kept [m]
    character(len=:), allocatable :: problem !! why it had no end
  end type period_map_type

contains

  !> Sizes of the map's entries; the rest is given.
  subroutine create_map(bearing, newton, map)
    type(bearing_system_type), target, intent(inout) :: bearing !! whose shaft is free
    type(newton_type), target, intent(inout) :: newton !! its solver
    type(period_map_type), intent(inout) :: map !! with drive, steps and scales
    PetscInt :: owned, all
    PetscErrorCode :: ierr

    map%bearing => bearing
    map%newton => newton
    PetscCallA(VecGetLocalSize(bearing%state, owned, ierr))
    PetscCallA(VecGetSize(bearing%state, all, ierr))
    map%owned = int(owned)
    map%rubs = rubs(bearing)
    map%slips = 0
    if (map%rubs) map%slips = slip_entries*contacts_of(bearing)
    map%remembered = remembered_by(map%settings, bearing)
    map%springs = 2*map%owned*size(map%remembered)
    map%local = 2*map%owned + map%slips + map%springs
    map%share = 1.0_wp/sqrt(real(all, wp))
    map%length = bearing%clearance
    map%clock = map%drive%speed
  end subroutine create_map

  !> The point at which the bearing rests in its present state.
  function rest_of(map) result(x)
    type(period_map_type), intent(in) :: map !! created, its bearing in equilibrium
    real(wp) :: x(map%local + tail) !! with the drive's parameter and the map's own period [1]
    real(wp) :: unknown(map%bearing%local_size(), 2), speed
    type(spring_history_type) :: rest(size(map%bearing%pad))
    integer :: i

    call map%bearing%get_unknowns(unknown(:, 1))
    unknown(:, 2) = unknown(:, 1)
    do i = 1, merge(size(rest), 0, map%springs > 0)
      associate (pad => map%bearing%pad(i))
        call begin_springs(unknown(pad%first + 1:pad%last, 1), pad%foil, rest(i))
      end associate
    end do
    call pack_point(map, unknown, spread([0.0_wp, 0.0_wp], 2, 2), x, rest)
    speed = map%drive%speed
    x(size(x) - 1) = 2.0_wp*pi*map%turns/speed/map%period_scale
    select case (map%parameter)
    case (moved_speed)
      x(size(x)) = speed/map%parameter_scale
    case (moved_unbalance)
      x(size(x)) = map%drive%unbalance/map%parameter_scale
    case (moved_mass)
      x(size(x)) = map%drive%mass/map%parameter_scale
    case default
      x(size(x)) = 0.0_wp
    end select
  end function rest_of

  !> Gives a point of rest the past of a shaft that is released there, as a march over time has it.
  subroutine release(map, x)
    type(period_map_type), intent(in) :: map !! created, its bearing in equilibrium, which is kept
    real(wp), intent(inout) :: x(:) !! that equilibrium [1]
    type(march_type) :: march

    call begin_at(map, x, march)
    associate (shaft => map%local)
      x(shaft + 3:shaft + 4) = x(shaft + 1:shaft + 2) + (march%place(:2, 2) - march%place(:2, 1))/map%length
      x(shaft + 7:shaft + 8) = march%velocity(:2, 2)/(map%length*map%clock)
    end associate
    call end_march(march, map%bearing)
  end subroutine release

  !> Begins a march with what drives the shaft at a point, in the map's steps.
  subroutine begin_at(map, x, march)
    type(period_map_type), intent(in) :: map
    real(wp), intent(in) :: x(:)
    type(march_type), intent(out) :: march
    type(march_settings_type) :: settings
    type(shaft_drive_type) :: drive

    drive = drive_at(map, x)
    settings = map%settings
    settings%steps_per_turn = map%steps*2.0_wp*pi/(drive%speed*period_of(map, x))
    settings%end_time = huge(1.0_wp)
    call begin_march(drive, settings, map%bearing, march)
  end subroutine begin_at

  !> The parameter of a point.
  pure function parameter_of(map, x) result(value)
    type(period_map_type), intent(in) :: map !! the map
    real(wp), intent(in) :: x(:) !! the point [1]
    real(wp) :: value !! [its unit]
    value = x(size(x))*map%parameter_scale
  end function parameter_of

  !> What drives the shaft at a point.
  pure function drive_at(map, x) result(drive)
    type(period_map_type), intent(in) :: map !! the map
    real(wp), intent(in) :: x(:) !! the point [1]
    type(shaft_drive_type) :: drive

    drive = map%drive
    if (map%parameter == moved_speed) drive%speed = parameter_of(map, x)
    if (map%parameter == moved_unbalance) drive%unbalance = parameter_of(map, x)
    if (map%parameter == moved_mass) drive%mass = parameter_of(map, x)
  end function drive_at

  !> The period of a point.
  pure function period_of(map, x) result(period)
    type(period_map_type), intent(in) :: map !! the map
    real(wp), intent(in) :: x(:) !! the point [1]
    real(wp) :: period !! [s]
    type(shaft_drive_type) :: drive

    period = x(size(x) - 1)*map%period_scale
    if (map%free) return
    drive = drive_at(map, x)
    period = map%stretch*2.0_wp*pi*map%turns/drive%speed
  end function period_of

  !> The point one period later, with the same period and parameter; `.false.` where a step has no answer.
  !>
  !> A step that would have to be shortened has none: all steps are equal.
  logical function apply_map(map, x, y, keep) result(done)
    type(period_map_type), intent(inout) :: map !! counts periods; gets the orbit; its bearing is left at the end
    real(wp), intent(in) :: x(:)  !! the point [1]
    real(wp), intent(out) :: y(:) !! one period later [1]
    logical, intent(in) :: keep   !! the smallest gap of the orbit is wanted
    type(march_type) :: march
    type(newton_report_type) :: report
    type(shaft_drive_type) :: drive
    real(wp) :: unknown(map%bearing%local_size(), 2), velocity(2, 2)
    integer :: i

    y = x
    drive = drive_at(map, x)
    done = drive%speed > 0.0_wp .and. drive%mass > 0.0_wp .and. period_of(map, x) > 0.0_wp
    map%problem = 'speed, mass and period must be positive'
    if (.not. done) return
    associate (bearing => map%bearing)
      call unpack_point(map, x, unknown, velocity)
      bearing%point%speed = drive%speed
      call bearing%set_unknowns(unknown(:, 1))
      call begin_at(map, x, march)
      if (map%springs > 0) call unpack_springs(map%remembered, map%length/map%share, &
                                               x(map%local - map%springs + 1:map%local), unknown, bearing)
      call resume_march(unknown, velocity, bearing, march)
      map%periods = map%periods + 1
      map%smallest_gap = huge(1.0_wp)
      if (allocated(map%orbit)) deallocate (map%orbit)
      allocate (map%orbit(planar, map%steps + 1))
      map%orbit(:, 1) = march%place(:2, 1)
      do i = 1, map%steps
        call take_step(march, bearing, map%newton, report)
        done = report%converged .and. march%rejections == 0
        if (.not. done) exit
        map%orbit(:, i + 1) = march%place(:2, 1)
        if (keep) map%smallest_gap = min(map%smallest_gap, bearing%smallest_gap())
      end do
      if (done) then
        call pack_point(map, march%unknown, march%velocity(:2, :), y, bearing%dampers%springs)
      else
        map%problem = 'step '//text(i)//' of '//text(map%steps)//' has no answer at its length'
        if (.not. report%converged) map%problem = map%problem//': '//report%reason
      end if
      call end_march(march, bearing)
    end associate
  end function apply_map

  !> Inner products of columns with a point, over all ranks.
  function dots(map, columns, x) result(product)
    type(period_map_type), intent(in) :: map !! the map
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
    type(period_map_type), intent(in) :: map !! the map
    real(wp), intent(in) :: x(:) !! (entries) [1]
    real(wp) :: length !! [1]
    length = sqrt(sum(dots(map, reshape(x, [size(x), 1]), x)))
  end function length_of

  !> Unknowns and velocities, now and one step ago, and slips as entries of a point; period and parameter stay.
  subroutine pack_point(map, unknown, velocity, x, springs)
    type(period_map_type), intent(in) :: map !! its bearing is left at the newest state
    real(wp), intent(in) :: unknown(:, :) !! (local unknowns, 2) [SI]
    real(wp), intent(in) :: velocity(:, :) !! (2, 2) [m/s]
    real(wp), intent(inout) :: x(:)
    type(spring_history_type), intent(in), optional :: springs(:) !! of all pads, where they have dampers
    PetscScalar, pointer :: values(:)
    PetscErrorCode :: ierr
    integer :: k, first

    associate (shaft => map%local, bearing => map%bearing)
      do k = 2, 1, -1
        call bearing%set_unknowns(unknown(:, k))
        PetscCallA(GFB_VecGetArrayRead(bearing%state, values, ierr))
        x((k - 1)*map%owned + 1:k*map%owned) = map%share*values(:map%owned)
        PetscCallA(GFB_VecRestoreArrayRead(bearing%state, values, ierr))
        x(shaft + 2*k - 1:shaft + 2*k) = unknown(bearing%first_shaft + 1:bearing%first_shaft + 2, k)/map%length
        x(shaft + 2*k + 3:shaft + 2*k + 4) = velocity(:, k)/(map%length*map%clock)
      end do
    end associate
    if (map%springs > 0) then
      call pack_springs(map%remembered, map%share/map%length, map%bearing, springs, x(map%local - map%springs + 1:map%local))
    end if
    if (map%slips == 0) return
    first = 2*map%owned
    do k = 1, size(map%bearing%pad)
      associate (contacts => map%bearing%pad(k)%foil%contacts)
        x(first + 1:first + slip_entries*size(contacts%point)) = map%share/map%length*slips_of(contacts)
        first = first + slip_entries*size(contacts%point)
      end associate
    end do
  end subroutine pack_point

  !> The reverse. The sleeve's place is that of the last entries.
  subroutine unpack_point(map, x, unknown, velocity)
    type(period_map_type), intent(in) :: map !! its bearing's state and contacts are overwritten
    real(wp), intent(in) :: x(:)
    real(wp), intent(out) :: unknown(:, :) !! (local unknowns, 2) [SI]
    real(wp), intent(out) :: velocity(:, :) !! (2, 2) [m/s]
    PetscScalar, pointer :: values(:)
    PetscErrorCode :: ierr
    integer :: k, first

    associate (shaft => map%local, bearing => map%bearing)
      do k = 1, 2
        PetscCallA(GFB_VecGetArray(bearing%state, values, ierr))
        values(:map%owned) = x((k - 1)*map%owned + 1:k*map%owned)/map%share
        PetscCallA(GFB_VecRestoreArray(bearing%state, values, ierr))
        call bearing%get_unknowns(unknown(:, k))
        unknown(bearing%first_shaft + 1:bearing%first_shaft + 2, k) = x(shaft + 2*k - 1:shaft + 2*k)*map%length
        velocity(:, k) = x(shaft + 2*k + 3:shaft + 2*k + 4)*map%length*map%clock
      end do
    end associate
    if (map%slips == 0) return
    first = 2*map%owned
    do k = 1, size(map%bearing%pad)
      associate (pad => map%bearing%pad(k), many => slip_entries*size(map%bearing%pad(k)%foil%contacts%point))
        call put_slips(x(first + 1:first + many)*map%length/map%share, &
                       pad%foil%own_part(unknown(pad%first + 1:pad%last, 1)), pad%foil%contacts)
        first = first + many
      end associate
    end do
  end subroutine unpack_point

  !> Whether contacts rub.
  pure function rubs(bearing)
    type(bearing_system_type), intent(in) :: bearing
    logical :: rubs

    rubs = .false.
    if (bearing%has_contacts()) rubs = any(bearing%pad(1)%foil%contacts%law%friction > 0.0_wp)
  end function rubs

  !> Contacts of this rank.
  pure function contacts_of(bearing) result(many)
    type(bearing_system_type), intent(in) :: bearing
    integer :: many, i

    many = 0
    do i = 1, size(bearing%pad)
      many = many + size(bearing%pad(i)%foil%contacts%point)
    end do
  end function contacts_of
end module gfb_period_map
