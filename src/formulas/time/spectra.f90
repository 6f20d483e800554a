!> Spectra of what was kept over time, of windows of whole turns.
!>
!> A window of T seconds is sampled evenly at t_j on cubics through the instants that were kept, and
!> weighted by Hann's window:
!>
!> $$ A_k = \frac{2}{\sum w_j} \left| \sum_{j=0}^{n-1} w_j (y(t_j) - \bar y)
!>    e^{-2 \pi i j k/n} \right|, \quad w_j = \sin^2 \frac{\pi j}{n}, \quad f_k = \frac{k}{T} $$
!>
!> so that an oscillation with whole periods in the window has its amplitude in its line. There are
!> lines up to eight times the speed, or to half the frequency of the instants where that is less.
!>
!> Extremes of a motion that is known at some instants, wherever these lie.
!>
!> Between two instants the motion is the parabola through them and the one before (for the first
!> two the one behind). At an extreme of an oscillation of frequency w in steps D it errs by about
!> (w D)^4/30 of the amplitude, 4e-6 with 60 steps a period; the largest of the instants
!> themselves by up to (w D)^2/8, 1.4e-3.
module gfb_spectra
  use gfb_kinds, only: wp
  use gfb_units, only: pi
  implicit none (type, external)
  private
  public :: extremes_of, spectra_of, points_a_turn

  integer, parameter :: most_turns = 8     !! of a window
  integer, parameter :: least_turns = 2    !! below which there is none
  integer, parameter :: most_windows = 40  !! they overlap by half or less
  integer, parameter :: turn_samples = 64  !! in a turn
  integer, parameter :: highest = 8        !! frequency over that of the turns
  integer, parameter :: points = 4         !! of a cubic

  !> Spectra of windows one after the other.
  type, public :: spectra_type
    real(wp), allocatable :: time(:)            !! (windows) in the middle of each [s]
    real(wp), allocatable :: speed(:)           !! (windows) mean one [rad/s]
    real(wp), allocatable :: frequency(:, :)    !! (lines, windows) [Hz]
    real(wp), allocatable :: amplitude(:, :, :) !! (lines, windows, values) in the values' unit [SI]
  end type spectra_type

contains

  !> Smallest and largest value between two times; those of the instants where there are fewer than
  !> three.
  pure function extremes_of(time, value, from, to) result(extremes)
    real(wp), intent(in) :: time(:)  !! (instants) rising [s]
    real(wp), intent(in) :: value(:) !! (instants) in its unit [SI]
    real(wp), intent(in) :: from, to !! not before the first instant, not behind the last one [s]
    real(wp) :: extremes(2), ends(2), slope(2), curvature, vertex, seen(3)
    integer :: first, i

    if (size(time) < 3) then
      extremes = [minval(value), maxval(value)]
      return
    end if
    extremes = [huge(1.0_wp), -huge(1.0_wp)]
    do i = 2, size(time)
      if (time(i) < from .or. time(i - 1) > to) cycle
      first = max(1, i - 2)
      ends = [max(from, time(i - 1)), min(to, time(i))]
      associate (t => time(first:first + 2), y => value(first:first + 2))
        ! y_2 + (t - t_2) (s_1 + c (t - t_2)), by divided differences.
        slope = (y(2:) - y(:2))/(t(2:) - t(:2))
        curvature = (slope(2) - slope(1))/(t(3) - t(1))
        slope(1) = slope(1) + curvature*(t(2) - t(1))
        seen(:2) = y(2) + (ends - t(2))*(slope(1) + curvature*(ends - t(2)))
        seen(3) = seen(1)
        if (abs(curvature) > 0.0_wp) then
          vertex = t(2) - 0.5_wp*slope(1)/curvature
          if (vertex > ends(1) .and. vertex < ends(2)) then
            seen(3) = y(2) + 0.5_wp*(vertex - t(2))*slope(1)
          end if
        end if
      end associate
      extremes = [min(extremes(1), minval(seen)), max(extremes(2), maxval(seen))]
    end do
  end function extremes_of

  !> The spectra of values; none where there are less than two turns, or less than two instants in
  !> one of them.
  pure function spectra_of(time, turns, values) result(spectra)
    real(wp), intent(in) :: time(:)      !! (instants) that does not fall [s]
    real(wp), intent(in) :: turns(:)     !! (instants) so far [1]
    real(wp), intent(in) :: values(:, :) !! (values, instants) [SI]
    type(spectra_type) :: spectra
    integer, allocatable :: kept(:)
    real(wp), allocatable :: sample(:)
    real(wp) :: first, span, resolved, ends(2)
    integer :: windows, length, lines, i, k

    kept = [(i, i=1, size(time))]
    kept = pack(kept, [(i == 1 .or. time(i) > time(max(1, i - 1)), i=1, size(time))])
    span = 0.0_wp
    resolved = 0.0_wp
    if (size(kept) >= points) then
      span = turns(kept(size(kept))) - turns(kept(1))
      resolved = 0.5_wp*points_a_turn(turns(kept))
    end if
    if (.not. (span >= real(least_turns, wp) .and. resolved >= 1.0_wp)) then
      allocate (spectra%time(0), spectra%speed(0), spectra%frequency(0, 0), &
                spectra%amplitude(0, 0, 0))
      return
    end if
    length = min(most_turns, int(span))
    windows = max(1, min(most_windows, int(2.0_wp*span/real(length, wp)) - 1))
    lines = int(min(real(highest, wp), resolved)*real(length, wp))
    allocate (spectra%time(windows), spectra%speed(windows), spectra%frequency(0:lines, windows), &
              spectra%amplitude(0:lines, windows, size(values, 1)))
    do i = 1, windows
      first = turns(kept(1)) + (span - length)*real(i - 1, wp)/real(max(1, windows - 1), wp)
      ends = interpolated(turns(kept), time(kept), [first, first + real(length, wp)])
      spectra%time(i) = 0.5_wp*sum(ends)
      spectra%speed(i) = 2.0_wp*pi*real(length, wp)/(ends(2) - ends(1))
      spectra%frequency(:, i) = [(real(k, wp), k=0, lines)]/(ends(2) - ends(1))
      do k = 1, size(values, 1)
        sample = samples_of(time(kept), values(k, kept), ends, turn_samples*length)
        spectra%amplitude(:, i, k) = amplitudes(sample, lines)
      end do
    end do
  end function spectra_of

  !> Instants in a turn, where they are farthest apart.
  pure function points_a_turn(turns) result(instants)
    real(wp), intent(in) :: turns(:) !! (instants) so far [1]
    real(wp) :: instants !! [1]
    real(wp), parameter :: rounding = 1.0e-9_wp !! of turns
    real(wp) :: farthest

    farthest = maxval(turns(2:) - turns(:size(turns) - 1))
    instants = (1.0_wp + rounding)/max(farthest, tiny(farthest))
  end function points_a_turn

  !> Values at even times between two, the second one left out.
  pure function samples_of(time, value, ends, samples) result(sample)
    real(wp), intent(in) :: time(:), value(:) !! (instants) [s], [SI]
    real(wp), intent(in) :: ends(2) !! [s]
    integer, intent(in) :: samples
    real(wp) :: sample(samples), share(samples)
    integer :: j

    share = [(real(j, wp), j=0, samples - 1)]/real(samples, wp)
    sample = interpolated(time, value, ends(1) + (ends(2) - ends(1))*share)
  end function samples_of

  !> Amplitudes of the first lines of samples.
  pure function amplitudes(sample, lines) result(amplitude)
    real(wp), intent(in) :: sample(0:)
    integer, intent(in) :: lines !! from 0 on
    real(wp) :: amplitude(0:lines)
    real(wp), dimension(0:size(sample) - 1) :: weighted, angle, weight
    integer :: j, k

    angle = pi*[(real(j, wp), j=0, size(sample) - 1)]/real(size(sample), wp)
    weight = sin(angle)**2
    weighted = weight*(sample - sum(sample)/real(size(sample), wp))
    do k = 0, lines
      amplitude(k) = hypot(sum(weighted*cos(2.0_wp*k*angle)), sum(weighted*sin(2.0_wp*k*angle)))
    end do
    amplitude = 2.0_wp*amplitude/sum(weight)
  end function amplitudes

  !> Values of a table on cubics through the four places around each place asked for.
  pure function interpolated(place, value, asked) result(found)
    real(wp), intent(in) :: place(:), value(:) !! (four or more) rising; [SI]
    real(wp), intent(in) :: asked(:) !! rising
    real(wp) :: found(size(asked)), weight
    integer :: first, i, j, k

    first = 1
    do i = 1, size(asked)
      do while (first < size(place) - points + 1 .and. asked(i) > place(first + 2))
        first = first + 1
      end do
      found(i) = 0.0_wp
      do j = first, first + points - 1
        weight = 1.0_wp
        do k = first, first + points - 1
          if (k /= j) weight = weight*(asked(i) - place(k))/(place(j) - place(k))
        end do
        found(i) = found(i) + weight*value(j)
      end do
    end do
  end function interpolated
end module gfb_spectra
