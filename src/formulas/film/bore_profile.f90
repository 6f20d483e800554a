!> A bore that is no circle: waves (lobes), shims under the foil, a measured or worn profile.
!>
!> Its height \( b(\theta) \) over the circle of the clearance, towards the shaft, is subtracted
!> from the rigid gap. That is of first order: the slope of b is small, and foils at rest lie on the
!> bore.
module gfb_bore_profile
  use gfb_kinds, only: wp
  use gfb_units, only: turn
  implicit none (type, external)
  private
  public :: bore_height, bore_kinks, bore_peak

  real(wp), parameter :: same_angle = 1.0e-9_wp      !! kinks that are nearer are one [rad]

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
    real(wp) :: distance
    integer :: i

    height = 0.0_wp
    if (profile%waves > 0) then
      height = profile%wave_amplitude*cos(profile%waves*(angle - profile%wave_angle))
    end if
    if (allocated(profile%shim_angle)) then
      do i = 1, size(profile%shim_angle)
        distance = abs(modulo(angle - profile%shim_angle(i) + 0.5_wp*turn, turn) - 0.5_wp*turn)
        distance = (distance - 0.5_wp*profile%shim_arc(i))/profile%shim_ramp(i)
        height = height + profile%shim_height(i)*min(1.0_wp, max(0.0_wp, 1.0_wp - distance))
      end do
    end if
    if (allocated(profile%table_angle)) height = height + table_value(profile, angle)
  end function bore_height

  !> Height of the table, which is periodic.
  pure function table_value(profile, angle) result(height)
    type(bore_profile_type), intent(in) :: profile
    real(wp), intent(in) :: angle !! [rad]
    real(wp) :: height            !! [m]
    real(wp) :: beyond, width     !! of the interval's beginning; of the interval [rad]
    integer :: last, next

    associate (angles => profile%table_angle, heights => profile%table_height)
      beyond = modulo(angle - angles(1), turn)
      last = max(1, count(angles - angles(1) <= beyond))
      next = modulo(last, size(angles)) + 1
      width = modulo(angles(next) - angles(last), turn)
      if (.not. width > 0.0_wp) width = turn
      beyond = (beyond - (angles(last) - angles(1)))/width
      height = heights(last) + beyond*(heights(next) - heights(last))
    end associate
  end function table_value

  !> Angles in [0, 2 pi) where the slope jumps, rising; those of several equal pads as if all were
  !> where the first one is.
  pure function bore_kinks(profile, turn_of_pad) result(kink)
    type(bore_profile_type), intent(in) :: profile !! the bore
    real(wp), intent(in), optional :: turn_of_pad(:) !! from the first one to each [rad]
    real(wp), allocatable :: kink(:) !! [rad]
    real(wp), allocatable :: left(:)
    real(wp) :: smallest
    integer :: i

    allocate (left(0), kink(0))
    if (allocated(profile%table_angle)) left = profile%table_angle
    if (allocated(profile%shim_angle)) then
      associate (middle => profile%shim_angle, half => 0.5_wp*profile%shim_arc, &
                 ramp => profile%shim_ramp)
        left = [left, middle - half - ramp, middle - half, middle + half, middle + half + ramp]
      end associate
    end if
    if (present(turn_of_pad)) left = [(left - turn_of_pad(i), i=1, size(turn_of_pad))]
    left = modulo(left, turn)
    where (turn - left < same_angle) left = 0.0_wp
    do while (size(left) > 0)
      smallest = minval(left)
      kink = [kink, smallest]
      left = pack(left, left > smallest + same_angle)
    end do
  end function bore_kinks

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
