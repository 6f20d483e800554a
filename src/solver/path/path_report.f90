!> Limits of a path of operating points, and how far it led.
module gfb_path_report
  use gfb_kinds, only: wp
  use gfb_operating_point, only: operating_point_type
  use gfb_work_bound, only: gave_up_words
  implicit none (type, external)
  private

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
  end type path_settings_type

  !> How far a path led.
  type, public :: path_report_type
    logical :: converged = .false.
    logical :: touched = .false.              !! the shaft came too near
    character(len=:), allocatable :: reason   !! in words
    type(operating_point_type) :: reached     !! the last point with an answer
    real(wp) :: fraction = 0.0_wp             !! of the path that was gone [1]
    integer :: steps = 0
    integer :: cuts = 0                       !! steps that had to be shortened
    logical :: folded = .false.               !! the branch of answers turns back
    logical :: emptied = .false.              !! the film's pressure has fallen to nothing somewhere
    logical :: drawn = .false.                !! the film draws the free edge to the shaft
    logical :: shaft_fixed = .false.          !! the shaft was still fixed
    logical :: of_smaller = .false.           !! the reason is a smaller mesh's, not shown here
    logical :: names_cause = .false.          !! the reason has a cause that has no flag here
    logical :: gave_up = .false.              !! the search had to end before anything was shown
  contains
    procedure :: has_cause => report_has_cause
    procedure :: tells_why
    procedure :: tell_nothing
  end type path_report_type

contains

  !> Whether the path ended for a cause in the bearing, rather than in Newton's method.
  elemental function report_has_cause(self) result(has)
    class(path_report_type), intent(in) :: self !! of a path that did not reach its end
    logical :: has
    has = self%touched .or. self%folded .or. self%emptied
  end function report_has_cause

  !> Takes back what it says of the bearing: a search that gave up has shown nothing.
  pure subroutine tell_nothing(self)
    class(path_report_type), intent(inout) :: self !! of a path that did not reach its end

    self%touched = .false.
    self%folded = .false.
    self%emptied = .false.
    self%drawn = .false.
    self%names_cause = .false.
    self%gave_up = .true.
    self%reason = gave_up_words
  end subroutine tell_nothing

  !> Whether its reason names a cause in the bearing, be it one that only a smaller mesh has shown.
  elemental function tells_why(self) result(tells)
    class(path_report_type), intent(in) :: self !! of a path that did not reach its end
    logical :: tells
    tells = self%has_cause() .or. self%drawn .or. self%names_cause
  end function tells_why
end module gfb_path_report
