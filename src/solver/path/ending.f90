!> How far a path of states leads, and how it ends: one of eight ways. What is said of each is
!> written here alone, but for what a search that is lost says of its last step.
module gfb_ending
  use gfb_kinds, only: wp
  use gfb_units, only: micrometres
  use gfb_text, only: text
  use gfb_operating_point, only: operating_point_type
  use gfb_work_bound, only: gave_up_words
  implicit none (type, external)
  private
  public :: path_reached, path_touches, path_touches_at, path_thins, path_closes, path_folds
  public :: mover_with_heat
  public :: path_empties, path_is_drawn, path_heats_up, path_stopped, path_lost

  integer, parameter, public :: ending_lost = 0       !! nothing shows why no step converges
  integer, parameter, public :: ending_reached = 1    !! the state asked for
  integer, parameter, public :: ending_touch_down = 2 !! the shaft comes too near
  integer, parameter, public :: ending_fold = 3       !! the branch of answers turns back
  integer, parameter, public :: ending_emptied = 4    !! the film's pressure falls to nothing
  integer, parameter, public :: ending_suction = 5    !! the film draws the free edge to the shaft
  integer, parameter, public :: ending_stopped = 6    !! before anything was shown
  integer, parameter, public :: ending_heated = 7     !! more heat is made than can leave

  !> An ending.
  type, public :: ending_type
    integer :: kind = ending_lost !! one of those above
    character(len=:), allocatable, private :: sentence
  contains
    procedure :: words, add_words, has_cause
  end type ending_type

  !> Limits of a path.
  type, public :: path_settings_type
    integer :: maximum_steps = 200
    real(wp) :: smallest_step = 1.0e-4_wp !! share of the path [1]
    real(wp) :: touch_down_gap = 0.0_wp   !! a smaller gap ends the path [m]
    logical :: look_for_folds = .true.    !! beyond the end of a path
    integer :: most_cuts = huge(1)        !! of steps, after one that succeeded
    !> Of any scaled unknown, where the branch is lost; farther off lies another one [1].
    real(wp) :: longest_leap = 0.05_wp
    integer :: straight_steps = huge(1)   !! Newton's, before they are bent at contacts
    real(wp) :: smallest_share = 0.0_wp   !! of a step, over the way that is gone [1]
    integer :: trial_iterations = 20      !! Newton's, of a step that can be cut
    logical :: stands_cold = .false.      !! without heat there is an answer where the path leads
  end type path_settings_type

  !> How hot a film is at the last answers of a path.
  type, public :: heat_trail_type
    integer :: answers = 0
    real(wp) :: at(3) = 0.0_wp          !! where they are on the path, the last one last [1]
    real(wp) :: temperature(3) = 0.0_wp !! largest of the film there, as the gas feels it [K]
  contains
    procedure :: add => add_temperature, turns, is_calm
  end type heat_trail_type

  !> How far a path led.
  type, public :: path_report_type
    type(ending_type) :: ending
    type(operating_point_type) :: reached     !! the last point with an answer
    real(wp) :: fraction = 0.0_wp             !! of the path that was gone [1]
    integer :: steps = 0
    integer :: cuts = 0                       !! steps that had to be shortened
    logical :: shaft_fixed = .false.          !! the shaft was still fixed
    logical :: of_smaller = .false.           !! the ending is a smaller mesh's, not shown here
  contains
    procedure :: converged, has_cause => report_has_cause, reason
  end type path_report_type

contains

  !> What is said of it; empty where nothing is.
  pure function words(self)
    class(ending_type), intent(in) :: self !! the ending
    character(len=:), allocatable :: words

    words = ''
    if (allocated(self%sentence)) words = self%sentence
  end function words

  !> Says more: before what it says, and behind it.
  pure subroutine add_words(self, before, behind)
    class(ending_type), intent(inout) :: self !! the ending
    character(len=*), intent(in) :: before, behind !! may be empty
    self%sentence = before//self%words()//behind
  end subroutine add_words

  !> Whether the path ended for a cause in the bearing, rather than in Newton's method.
  elemental logical function has_cause(self) result(has)
    class(ending_type), intent(in) :: self !! of a path
    has = any(self%kind == [ending_touch_down, ending_fold, ending_emptied, ending_suction, &
                            ending_heated])
  end function has_cause

  !> An ending with its words. GNU Fortran 12 loses the memory of words that are put together
  !> in a structure constructor.
  pure function ending_of(kind, sentence) result(ending)
    integer, intent(in) :: kind !! one of those above
    character(len=*), intent(in) :: sentence !! what is said of it
    type(ending_type) :: ending

    ending%kind = kind
    ending%sentence = sentence
  end function ending_of

  !> The state asked for.
  pure function path_reached() result(ending)
    type(ending_type) :: ending
    ending = ending_of(ending_reached, 'converged')
  end function path_reached

  !> The film is thinner than is allowed.
  pure function path_touches(limit) result(ending)
    real(wp), intent(in) :: limit !! of the gap [m]
    type(ending_type) :: ending

    ending = ending_of(ending_touch_down, 'the shaft touches down: the film is thinner than '// &
                         text(limit*micrometres, 3)//' um')
  end function path_touches

  !> The same, where what is followed is no operating point.
  pure function path_touches_at(place) result(ending)
    character(len=*), intent(in) :: place !! in words: 'at ...', 'where ...'
    type(ending_type) :: ending
    ending = ending_of(ending_touch_down, 'the shaft touches down '//place)
  end function path_touches_at

  !> The same, where loops are tried.
  pure function path_thins() result(ending)
    type(ending_type) :: ending
    ending = ending_of(ending_touch_down, 'the film is thinner than touch_down_gap')
  end function path_thins

  !> The gap has closed, and no step converges.
  pure function path_closes(gap, lost) result(ending)
    real(wp), intent(in) :: gap !! smallest of the last state [m]
    type(ending_type), intent(in) :: lost !! how the last step ended
    type(ending_type) :: ending

    ending = ending_of(ending_touch_down, 'the shaft touches down: the gap has closed to '// &
                         text(gap*micrometres, 3)//' um, beyond that '//lost%words())
  end function path_closes

  !> What moves on by itself beyond a fold of a bearing with heat, as far as the path has shown it:
  !> where there is an answer without heat, it is the temperature; where the film does not warm ever
  !> faster towards the fold, it is not; where it does, temperature and the rest go together.
  pure function mover_with_heat(temperature, solid, stands_cold, trail) result(mover)
    character(len=*), intent(in) :: temperature, solid !! what either is called
    logical, intent(in) :: stands_cold !! there is an answer without heat where the path leads
    type(heat_trail_type), intent(in) :: trail !! of its last answers
    character(len=:), allocatable :: mover

    if (stands_cold) then
      mover = temperature
    else if (trail%is_calm()) then
      mover = solid
    else if (trail%answers >= 3) then
      mover = temperature//', which rises ever faster, and with it the '//solid
    else
      mover = temperature//' or, which the path does not tell apart, the '//solid
    end if
  end function mover_with_heat

  !> The branch of answers turns back.
  pure function path_folds(mover) result(ending)
    character(len=*), intent(in) :: mover !! what moves on by itself
    type(ending_type) :: ending

    ending = ending_of(ending_fold, 'the branch of answers ends in a fold: beyond it the '// &
                         mover//' moves on by itself')
  end function path_folds

  !> The film's pressure has fallen to nothing.
  pure function path_empties(pressure, gap, peclet) result(ending)
    real(wp), intent(in) :: pressure, gap !! smallest ones of the last state [Pa], [m]
    real(wp), intent(in) :: peclet !! largest number of its cells [1]
    type(ending_type) :: ending

    ending = ending_of(ending_emptied, 'the film is emptied: its pressure falls to '// &
                         text(pressure, 2)//' Pa behind a gap of '//text(gap*micrometres, 3)// &
                         ' um, on cells of a Peclet number up to '//text(peclet, 2)// &
                         '; a finer mesh may lead farther')
  end function path_empties

  !> The film draws a free edge to the shaft at every height at which it was fixed.
  pure function path_is_drawn(edge, heights, highest, room, least) result(ending)
    character(len=*), intent(in) :: edge !! in words
    integer, intent(in) :: heights !! at which it was fixed
    real(wp), intent(in) :: highest, room !! of them, and from there to the shaft [m]
    real(wp), intent(in) :: least !! force that fixes it [N]
    type(ending_type) :: ending

    ending = ending_of(ending_suction, 'the film draws '//edge//' to the shaft: fixed at '// &
                         text(heights)//' heights up to '//text(highest*micrometres, 3)// &
                         ' um, '//text(room*micrometres, 2)// &
                         ' um below the shaft, it has to be pressed down at each, by '// &
                         text(least, 2)//' N or more')
  end function path_is_drawn

  !> The film makes more heat than can leave at any temperature.
  pure function path_heats_up(hottest, temperature, made, out) result(ending)
    real(wp), intent(in) :: hottest     !! temperature that was looked at [K]
    real(wp), intent(in) :: temperature !! at which the most of it leaves [K]
    real(wp), intent(in) :: made, out   !! heat that is made there, and that leaves [W]
    type(ending_type) :: ending

    ending = ending_of(ending_heated, 'no steady temperature below '//text(hottest, 4)// &
                         ' K (thermal runaway): at '//text(temperature, 3)// &
                         ' K, where the most of it leaves, the film makes '//text(made, 3)// &
                         ' W of heat and gas and walls take '//text(out, 3)//' W')
  end function path_heats_up

  !> A signal asks for the end, or all work that is allowed is done: nothing has been shown.
  pure function path_stopped() result(ending)
    type(ending_type) :: ending
    ending = ending_of(ending_stopped, gave_up_words)
  end function path_stopped

  !> Nothing shows why no step converges.
  pure function path_lost(last) result(ending)
    character(len=*), intent(in) :: last !! what the last step has ended in
    type(ending_type) :: ending

    ending = ending_of(ending_lost, last)
    if (last == '') ending = ending_of(ending_lost, 'no step converges')
  end function path_lost

  !> Adds an answer.
  pure subroutine add_temperature(self, at, temperature)
    class(heat_trail_type), intent(inout) :: self !! the trail
    real(wp), intent(in) :: at          !! where it is on the path [1]
    real(wp), intent(in) :: temperature !! [K]

    self%answers = self%answers + 1
    self%at = [self%at(2:), at]
    self%temperature = [self%temperature(2:), temperature]
  end subroutine add_temperature

  !> Whether the path turns back before a place where there was no answer: the parabola through
  !> the last three answers, the path's parameter over the temperature, has its top short of it.
  pure logical function turns(self, failed)
    class(heat_trail_type), intent(in) :: self !! the trail
    real(wp), intent(in) :: failed !! that place [1]
    real(wp) :: first, second, bend, top

    turns = .false.
    associate (at => self%at, t => self%temperature)
      if (self%answers < 3 .or. min(t(2) - t(1), t(3) - t(2)) <= 0.0_wp) return
      first = (at(2) - at(1))/(t(2) - t(1))
      second = (at(3) - at(2))/(t(3) - t(2))
      bend = (second - first)/(t(3) - t(1))
      if (.not. bend < 0.0_wp) return
      second = second + bend*(t(3) - t(2)) ! the slope at the last one
      top = t(3) - 0.5_wp*second/bend      ! where it is none
      turns = at(3) + second*(top - t(3)) + bend*(top - t(3))**2 < failed
    end associate
  end function turns

  !> Whether three answers show a film that does not warm ever faster along the path.
  pure logical function is_calm(self)
    class(heat_trail_type), intent(in) :: self !! the trail

    is_calm = .false.
    if (self%answers < 3) return
    associate (way => self%at(2:) - self%at(:2), &
               rise => self%temperature(2:) - self%temperature(:2))
      is_calm = rise(2) <= 0.0_wp .or. rise(2)*way(1) <= rise(1)*way(2)
    end associate
  end function is_calm

  !> Whether the path led to the point that was asked for.
  elemental logical function converged(self)
    class(path_report_type), intent(in) :: self !! of a path
    converged = self%ending%kind == ending_reached
  end function converged

  !> Whether it ended for a cause in the bearing, rather than in Newton's method.
  elemental logical function report_has_cause(self)
    class(path_report_type), intent(in) :: self !! of a path
    report_has_cause = self%ending%has_cause()
  end function report_has_cause

  !> What is said of its end.
  pure function reason(self) result(words)
    class(path_report_type), intent(in) :: self !! of a path
    character(len=:), allocatable :: words
    words = self%ending%words()
  end function reason
end module gfb_ending
