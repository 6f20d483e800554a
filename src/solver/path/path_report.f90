!> Limits of a path of operating points, and how far it led.
module gfb_path_report
  use gfb_kinds, only: wp
  use gfb_operating_point, only: operating_point_type
  use gfb_ending, only: ending_type, ending_reached
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
    type(ending_type) :: ending
    type(operating_point_type) :: reached     !! the last point with an answer
    real(wp) :: fraction = 0.0_wp             !! of the path that was gone [1]
    integer :: steps = 0
    integer :: cuts = 0                       !! steps that had to be shortened
    logical :: shaft_fixed = .false.          !! the shaft was still fixed
    logical :: of_smaller = .false.           !! the ending is a smaller mesh's, not shown here
  contains
    procedure :: converged
    procedure :: has_cause => report_has_cause
    procedure :: reason
  end type path_report_type

contains

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
end module gfb_path_report
