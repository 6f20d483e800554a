!> Where the shaft was at every step of the last turns, whichever become lines of the history.
module gfb_orbit_record
  use gfb_kinds, only: wp
  use gfb_archive, only: archive_type
  use gfb_units, only: turn
  use gfb_spectra, only: extremes_of
  use gfb_runge_kutta, only: cubic_weights
  use gfb_time_march, only: march_type
  implicit none (type, external)
  private

  !> What moves: e_x and e_y; tilts; e_x and e_y of both bearings.
  integer, parameter, public :: plane_motion(2) = [1, 2], tilt_motion(2) = [3, 4]
  integer, parameter :: journal_motion(4) = [5, 6, 7, 8]
  integer, parameter :: between = 3          !! places of a step by stages
  real(wp), parameter :: turns_kept = 2.0_wp !! that are compared [1]

  !> The steps of the last turns; of a shaft that does not turn all of them.
  type, public :: orbit_record_type
    private
    integer :: steps = 0                  !! that are kept
    real(wp), allocatable :: time(:)      !! (steps), with room for more [s]
    real(wp), allocatable :: turns(:)     !! (steps) of the shaft [1]
    real(wp), allocatable :: motion(:, :) !! (what moves, steps) [m], [rad]
  contains
    procedure :: see => see_step, see_motion
    procedure :: turn_began, extents, ends_at
    procedure :: visit => visit_orbit
  end type orbit_record_type

contains

  !> Adds the present state, and drops what lies more than the last turns back. Of the long steps by
  !> stages it adds places between, on the cubic of both ends with their rates.
  pure subroutine see_step(self, march)
    class(orbit_record_type), intent(inout) :: self !! the record
    type(march_type), intent(in) :: march !! at the beginning or after a step
    real(wp) :: weight(4), place(size(march%place, 1))
    integer :: i

    if (march%settings%by_stages .and. march%steps > 0) then
      do i = 1, between
        associate (share => real(i, wp)/real(between + 1, wp))
          weight = cubic_weights(share, march%step)
          place = matmul(march%place(:, :2), weight(:2)) + matmul(march%velocity(:, :2), weight(3:))
          call self%see_motion(march, motion_at(march, place), turns_kept, &
                               (1.0_wp - share)*march%step)
        end associate
      end do
    end if
    call self%see_motion(march, motion_at(march, march%place(:, 1)), turns_kept, 0.0_wp)
  end subroutine see_step

  !> What moves, of a place of the sleeve.
  pure function motion_at(march, place) result(motion)
    type(march_type), intent(in) :: march
    real(wp), intent(in) :: place(:) !! with the tilt [m], [rad]
    real(wp), allocatable :: motion(:) !! [m], [rad]

    motion = place(:2)
    if (march%drive%bearing_distance > 0.0_wp) then
      motion = [motion, place(4:), march%way_in_bearings(place)]
    end if
  end function motion_at

  !> The same of whatever moves.
  pure subroutine see_motion(self, march, motion, kept, ago)
    class(orbit_record_type), intent(inout) :: self !! the record
    type(march_type), intent(in) :: march !! its time
    real(wp), intent(in) :: motion(:) !! then, as many numbers at each step [m], [rad]
    real(wp), intent(in) :: kept !! turns at the end that are not dropped [1]
    real(wp), intent(in) :: ago !! before the march's time [s]
    integer :: old

    if (.not. allocated(self%time)) call make_room(self, size(motion), 256)
    if (self%steps == size(self%time)) then
      ! Two steps before those turns: a parabola needs them.
      old = max(0, count(self%turns(:self%steps) < march%turns() - kept) - 2)
      call shift(self, old)
      if (2*self%steps > size(self%time)) then
        call make_room(self, size(self%motion, 1), 2*size(self%time))
      end if
    end if
    self%steps = self%steps + 1
    self%time(self%steps) = march%time - ago
    self%turns(self%steps) = march%drive%angle_at(march%time - ago)/turn
    self%motion(:, self%steps) = motion
  end subroutine see_motion

  !> Drops the oldest steps.
  pure subroutine shift(self, old)
    type(orbit_record_type), intent(inout) :: self
    integer, intent(in) :: old !! steps to drop

    associate (left => self%steps - old)
      self%time(:left) = self%time(old + 1:self%steps)
      self%turns(:left) = self%turns(old + 1:self%steps)
      self%motion(:, :left) = self%motion(:, old + 1:self%steps)
    end associate
    self%steps = self%steps - old
  end subroutine shift

  !> Room for so many steps.
  pure subroutine make_room(self, moving, room)
    type(orbit_record_type), intent(inout) :: self
    integer, intent(in) :: moving, room !! numbers a step; steps
    real(wp), allocatable :: time(:), turns(:), motion(:, :)

    allocate (time(room), turns(room), motion(moving, room), source=0.0_wp)
    if (allocated(self%time)) then
      time(:self%steps) = self%time(:self%steps)
      turns(:self%steps) = self%turns(:self%steps)
      motion(:, :self%steps) = self%motion(:, :self%steps)
    end if
    call move_alloc(time, self%time)
    call move_alloc(turns, self%turns)
    call move_alloc(motion, self%motion)
  end subroutine make_room

  !> When the shaft came to a number of turns: the first time that is kept where it had more then.
  pure function turn_began(self, turn) result(time)
    class(orbit_record_type), intent(in) :: self !! the record
    real(wp), intent(in) :: turn !! of the shaft [1]
    real(wp) :: time !! [s]
    real(wp) :: share
    integer :: i

    time = self%time(1)
    i = count(self%turns(:self%steps) < turn)
    if (i == 0) return
    time = self%time(self%steps)
    if (i == self%steps) return
    share = (turn - self%turns(i))/(self%turns(i + 1) - self%turns(i))
    time = self%time(i) + share*(self%time(i + 1) - self%time(i))
  end function turn_began

  !> Smallest and largest values of the motion between two turns of the last ones.
  pure function extents(self, from, to, asked) result(box)
    class(orbit_record_type), intent(in) :: self !! the record
    real(wp), intent(in) :: from, to !! turns of the shaft [1]
    !> default: where the shaft is, in both bearings where it has two
    integer, intent(in), optional :: asked(:)
    !> smallest value of the first motion, largest, those of the next [m], [rad]
    real(wp), allocatable :: box(:)
    integer, allocatable :: moving(:)
    real(wp) :: first, last
    integer :: i

    first = self%turn_began(from)
    last = self%time(self%steps)
    if (to < self%turns(self%steps)) last = self%turn_began(to)
    moving = plane_motion
    if (size(self%motion, 1) > 2) moving = journal_motion
    if (present(asked)) moving = asked
    box = [(extremes_of(self%time(:self%steps), self%motion(moving(i), :self%steps), &
                        first, last), i=1, size(moving))]
  end function extents

  !> Whether the steps are some of a march in their order, the last one its present one.
  pure logical function ends_at(self, march)
    class(orbit_record_type), intent(in) :: self !! as read
    type(march_type), intent(in) :: march !! at its present state

    ends_at = self%steps > 0
    if (.not. ends_at) return
    associate (n => self%steps, time => self%time(:self%steps))
      ends_at = all(time(2:) > time(:n - 1)) .and. abs(time(n) - march%time) <= 0.0_wp .and. &
                all(self%turns(2:n) >= self%turns(:n - 1)) .and. time(1) >= 0.0_wp .and. &
                all(abs(self%motion(:2, n) - march%place(:2, 1)) <= 0.0_wp)
    end associate
  end function ends_at

  !> Saves or restores the steps.
  subroutine visit_orbit(self, archive)
    class(orbit_record_type), intent(inout) :: self !! written where the archive restores
    type(archive_type), intent(inout) :: archive !! that saves or restores
    real(wp), allocatable :: steps(:, :)

    allocate (steps(size(self%motion, 1) + 2, self%steps))
    steps(1, :) = self%time(:self%steps)
    steps(2, :) = self%turns(:self%steps)
    steps(3:, :) = self%motion(:, :self%steps)
    call archive%visit_sized('orbit', steps)
    if (archive%saves) return
    call archive%require(allocated(steps), 'the orbit')
    if (archive%failed) return
    call archive%require(size(steps, 1) == size(self%motion, 1) + 2, 'the orbit')
    if (archive%failed) return
    self%steps = size(steps, 2)
    self%time = steps(1, :)
    self%turns = steps(2, :)
    self%motion = steps(3:, :)
  end subroutine visit_orbit
end module gfb_orbit_record
