!> A critical speed: where the response to unbalance is largest, and how sharp it is there.
!>
!> It begins with responses at some speeds, one of them larger than both its neighbours, and says
!> at which speed the next one is wanted. The top is that of a parabola through 1/amplitude^2, which
!> of one resonance is nearly one; then the speeds N_1 and N_2 at which the amplitude is 0.707 of it
!> are solved for. The amplification factor is N_c/(N_2 - N_1), as API 617 has it.
module gfb_resonance
  use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan
  use gfb_kinds, only: wp
  use gfb_root_bracket, only: root_bracket_type
  implicit none (type, external)
  private
  public :: peaks_of

  integer, parameter :: at_top = 1, below = 2, above = 3, complete = 4 !! what is looked for
  integer, parameter :: most_trials = 25 !! of the top, and of each side
  integer, parameter :: fewest = 2       !! of the top
  real(wp), parameter :: top_tolerance = 1.0e-6_wp  !! of the critical speed, from step to step [1]
  real(wp), parameter :: side_tolerance = 1.0e-5_wp !! of N_1 and N_2, the same [1]
  real(wp), parameter :: half_power = sqrt(0.5_wp)  !! amplitude there over the largest [1]

  !> A resonance. Fill the first three, then ask for speeds and give amplitudes.
  type, public :: resonance_type
    real(wp), allocatable :: speed(:)     !! rising [rpm]
    real(wp), allocatable :: amplitude(:) !! there [m]
    integer :: top = 0                    !! number of the largest, neither the first nor the last
    real(wp) :: critical = 0.0_wp         !! speed [rpm]
    real(wp) :: largest = 0.0_wp          !! amplitude [m]
    real(wp) :: side(2) = 0.0_wp          !! N_1, N_2; 0 where there is none among the speeds [rpm]
    integer, private :: stage = at_top, trials = 0
    type(root_bracket_type), private :: bracket = root_bracket_type(0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp)
  contains
    procedure :: next, tell, factor
  end type resonance_type

contains

  !> Numbers of amplitudes that are larger than their neighbours.
  pure function peaks_of(amplitude) result(peak)
    real(wp), intent(in) :: amplitude(:) !! over the speed [m]
    integer, allocatable :: peak(:)
    integer :: i

    peak = pack([(i, i=2, size(amplitude) - 1)], &
                [(amplitude(i) > amplitude(i - 1) .and. amplitude(i) >= amplitude(i + 1), &
                  i=2, size(amplitude) - 1)])
  end function peaks_of

  !> The speed whose amplitude is wanted next; negative where the resonance is known.
  pure subroutine next(self, speed)
    class(resonance_type), intent(inout) :: self !! the resonance
    real(wp), intent(out) :: speed !! [rpm]
    logical :: known

    do
      speed = -1.0_wp
      if (self%stage == complete) return
      if (self%stage == at_top) then
        call look_at_top(self, speed, known)
      else
        call look_at_side(self, speed, known)
      end if
      if (.not. known) return
      self%trials = 0
      self%stage = self%stage + 1
      if (self%stage < complete) call begin_side(self)
    end do
  end subroutine next

  !> The top of the parabola through the three largest next to each other.
  pure subroutine look_at_top(self, speed, known)
    type(resonance_type), intent(inout) :: self
    real(wp), intent(out) :: speed !! [rpm]
    logical, intent(out) :: known
    real(wp) :: left, right, at_left, at_right, here

    associate (i => self%top, n => self%speed)
      left = n(i - 1) - n(i)
      right = n(i + 1) - n(i)
      here = 1.0_wp/self%amplitude(i)**2
      at_left = (1.0_wp/self%amplitude(i - 1)**2 - here)/left
      at_right = (1.0_wp/self%amplitude(i + 1)**2 - here)/right
      speed = n(i) + 0.5_wp*(left*at_right - right*at_left)/(at_right - at_left)
      self%critical = speed
      self%largest = self%amplitude(i)
      known = abs(speed - n(i)) <= top_tolerance*n(i) .or. self%trials >= most_trials
      if (.not. known .or. self%trials >= fewest) return
      known = .false. ! by chance the middle was the top of a wide parabola
      speed = n(i) + 0.5_wp*merge(right, left, right > -left)
    end associate
  end subroutine look_at_top

  !> Where the amplitude falls to 0.707 of the largest on one side, before it is larger again.
  pure subroutine begin_side(self)
    type(resonance_type), intent(inout) :: self
    real(wp) :: level
    integer :: i, step, last

    level = half_power*self%largest
    step = merge(-1, 1, self%stage == below)
    last = merge(1, size(self%speed), self%stage == below)
    self%bracket%high = 0.0_wp
    do i = self%top + step, last, step
      if (self%amplitude(i) > self%largest) return
      if (self%amplitude(i) > level) cycle
      self%bracket = root_bracket_type(self%speed(i - step), self%speed(i), &
                                       past(self, self%amplitude(i - step)), &
                                       past(self, self%amplitude(i)))
      return
    end do
  end subroutine begin_side

  !> How far an amplitude is past 0.707 of the largest: of one resonance that grows evenly with the
  !> speed.
  pure real(wp) function past(self, amplitude)
    type(resonance_type), intent(in) :: self
    real(wp), intent(in) :: amplitude !! [m]
    past = sqrt(max(0.0_wp, (self%largest/amplitude)**2 - 1.0_wp)) - 1.0_wp
  end function past

  !> False position between both ends of the bracket.
  pure subroutine look_at_side(self, speed, known)
    type(resonance_type), intent(inout) :: self
    real(wp), intent(out) :: speed !! [rpm]
    logical, intent(out) :: known

    speed = -1.0_wp
    known = .not. self%bracket%high > 0.0_wp
    if (known) return
    speed = self%bracket%trial()
    known = abs(speed - self%bracket%high) <= side_tolerance*speed
    known = known .or. self%trials >= most_trials
    if (known) self%side(self%stage - at_top) = speed
  end subroutine look_at_side

  !> Takes an amplitude.
  pure subroutine tell(self, speed, amplitude)
    class(resonance_type), intent(inout) :: self !! the resonance
    real(wp), intent(in) :: speed     !! that was wanted [rpm]
    real(wp), intent(in) :: amplitude !! there [m]
    integer :: before

    self%trials = self%trials + 1
    before = count(self%speed < speed)
    self%speed = [self%speed(:before), speed, self%speed(before + 1:)]
    self%amplitude = [self%amplitude(:before), amplitude, self%amplitude(before + 1:)]
    if (self%stage == at_top) then
      if (before < self%top) self%top = self%top + 1
      if (amplitude > self%amplitude(self%top)) self%top = before + 1
    else
      if (before < self%top) self%top = self%top + 1
      call self%bracket%narrow(speed, past(self, amplitude))
    end if
  end subroutine tell

  !> The amplification factor; not a number where the amplitude does not fall to 0.707 on each side.
  pure real(wp) function factor(self)
    class(resonance_type), intent(in) :: self !! the resonance, known

    factor = ieee_value(1.0_wp, ieee_quiet_nan)
    if (all(self%side > 0.0_wp)) factor = self%critical/(self%side(2) - self%side(1))
  end function factor
end module gfb_resonance
