!> A bore that is no circle: waves (lobes), shims under the foil, a measured or worn profile.
!>
!> Its height \( b(\theta) \) over the circle of the clearance is a shape of the rigid gap; foils
!> at rest lie on the bore.
!>
!> $$ b = a \cos n(\theta - \theta_w) + \sum_i t_i \min\Bigl(1, \max\Bigl(0,
!>    1 - \frac{|\theta - \theta_i| - \alpha_i/2}{\beta_i}\Bigr)\Bigr) + b_t(\theta) $$
!>
!> with shims of height t, arc \( \alpha \) of the plateau and \( \beta \) of each ramp, and the
!> table's piecewise linear \( b_t \).
module gfb_bore_profile
  use gfb_kinds, only: wp
  use gfb_units, only: turn
  use gfb_gap_shape, only: gap_shape_type, count_up_to
  implicit none (type, external)
  private
  !> Height of a bore over the circle; none where nothing is set.
  type, extends(gap_shape_type), public :: bore_profile_type
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
    procedure :: smooth => wave_height
    procedure :: add_kinked => add_shims_and_table
    procedure :: kinks => bore_kinks
  end type bore_profile_type

contains

  !> Whether the bore is not simply a circle.
  pure logical function bore_is_present(self) result(present)
    class(bore_profile_type), intent(in) :: self !! the bore
    present = self%waves > 0 .or. allocated(self%shim_angle) .or. allocated(self%table_angle)
  end function bore_is_present

  !> Height of the waves alone [m].
  pure real(wp) function wave_height(self, angle, along) result(height)
    class(bore_profile_type), intent(in) :: self !! the bore
    real(wp), intent(in) :: angle !! theta [rad]
    real(wp), intent(in) :: along !! does not count [m]

    height = 0.0_wp
    if (self%waves > 0) height = self%wave_amplitude*cos(self%waves*(angle - self%wave_angle))
  end function wave_height

  !> Adds what is straight between kinks: shims and table.
  pure subroutine add_shims_and_table(self, angle, along, height)
    class(bore_profile_type), intent(in) :: self !! the bore
    real(wp), intent(in) :: angle !! theta [rad]
    real(wp), intent(in) :: along !! does not count [m]
    real(wp), intent(inout) :: height !! b [m]
    real(wp) :: distance
    integer :: i

    if (allocated(self%shim_angle)) then
      do i = 1, size(self%shim_angle)
        distance = abs(modulo(angle - self%shim_angle(i) + 0.5_wp*turn, turn) - 0.5_wp*turn)
        distance = (distance - 0.5_wp*self%shim_arc(i))/self%shim_ramp(i)
        height = height + self%shim_height(i)*min(1.0_wp, max(0.0_wp, 1.0_wp - distance))
      end do
    end if
    if (allocated(self%table_angle)) height = height + table_value(self, angle)
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

  !> Angles from an origin on where the slope jumps, in any order [rad].
  pure function bore_kinks(self, origin, arc) result(kink)
    class(bore_profile_type), intent(in) :: self !! the bore
    real(wp), intent(in) :: origin !! [rad]
    real(wp), intent(in) :: arc !! points of the table this near to both neighbours are none [rad]
    real(wp), allocatable :: kink(:)

    allocate (kink(0))
    if (allocated(self%table_angle)) then
      kink = pack(self%table_angle, stands_alone(self%table_angle, arc))
    end if
    if (allocated(self%shim_angle)) then
      associate (middle => self%shim_angle, half => 0.5_wp*self%shim_arc, ramp => self%shim_ramp)
        kink = [kink, middle - half - ramp, middle - half, middle + half, middle + half + ramp]
      end associate
    end if
    kink = kink - origin
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
end module gfb_bore_profile
