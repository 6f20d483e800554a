#include "gfb_petsc.h"
!> The start of a bearing with foils in contact.
!>
!> A foil at rest lies on all its contacts with no force, so that every least film decides all of
!> them anew, and Newton's method cycles among them. A cold start uses soft two-way contact springs,
!> which leave the equations nearly linear, then releases them and raises their stiffness to the value
!> asked for: by decades of their stiffness against opening, and by decades of all of it.
module gfb_soft_contact_start
  use gfb_kinds, only: wp
  use gfb_ending, only: path_lost, ending_touch_down
  use gfb_text, only: text
  use gfb_operating_point, only: operating_point_type
  use gfb_film_load, only: film_forces
  use gfb_bearing_system, only: bearing_system_type
  use gfb_pad_contacts, only: set_hardness, set_adhesion
  use gfb_newton, only: newton_type, newton_settings_type, newton_report_type, solve_newton
  use gfb_continuation, only: path_settings_type, path_report_type, follow_path, closing_gap
  use gfb_stepper, only: path_problem_type, step_rules_type, follow_steps, steps_arrived
  use gfb_start_problem, only: start_problem_type, soft_contacts_type, by_load, before, trial_settings, usual_eccentricity
  use gfb_saved_state, only: saved_state_type
  use gfb_start_position, only: guess_position, find_position, release_shaft, solve_at, put_at_rest
  implicit none (type)
  private
  public :: try_soft_contacts, approach, hold_softly

  !> Releases contacts while the foil is pressed most: before the shaft is released where the load is larger than
  !> the film's force under the fixed shaft.
  type(soft_contacts_type), parameter, public :: usual_contacts = soft_contacts_type(by_load, usual_eccentricity, 1.5_wp, 1.0_wp)

  real(wp), parameter :: first_hard_step = 0.1_wp   !! of the rest of a path, with contacts of full stiffness [1]

  type(newton_settings_type), parameter :: rough = newton_settings_type(1.0e-3_wp, 1.0e-2_wp, 25, 8) !! with soft contacts
  integer, parameter :: releasing = 1, stiffening = 2 !! what is done to contacts
  real(wp), parameter :: shortest_decades = 0.05_wp    !! of a step, before it is given up [1]
  real(wp), parameter :: enough = 4.0_wp             !! decades of the release that are all where steps do not grow
  integer, parameter :: most_soft_cuts = 2           !! of a path with soft contacts that has begun
  real(wp), parameter :: least_adhesion = -8.0_wp    !! decades of the stiffness against opening at which it is none [1]

  !> Contacts on their way from soft two-way ones to the scene's, at one point; the parameter is in decades.
  type, extends(path_problem_type) :: contact_path_type
    type(bearing_system_type), pointer :: bearing => null()
    type(newton_type), pointer :: newton => null() !! its solver
    integer :: change = releasing
    real(wp) :: last = 0.0_wp          !! decades where they are the scene's
    type(newton_report_type) :: solved !! of the last trial
    type(saved_state_type) :: saved     !! the last answer
  contains
    procedure :: try => try_decades
    procedure :: accept => accept_decades
    procedure :: restore => restore_contacts
  end type contact_path_type

contains

  !> Soft two-way contacts first, then those of the scene.
  subroutine try_soft_contacts(problem, soft, report, ends)
    type(start_problem_type), intent(inout) :: problem !! what is to be solved
    type(soft_contacts_type), intent(in) :: soft  !! how they are released
    type(path_report_type), intent(out) :: report !! how it ended
    logical, intent(out) :: ends                  !! the shaft touches down, or the branch folds
    type(path_settings_type) :: settings

    settings = problem%settings
    if (problem%may_give_up) settings = trial_settings(settings)
    call guess_position(problem%bearing, problem%scene, problem%target, soft%eccentricity)
    call approach(problem%bearing, problem%newton, problem%target, settings, soft, report)
    if (.not. (report%converged() .or. report%shaft_fixed)) then
      call follow_path(problem%bearing, problem%newton, problem%target, first_hard_step, settings, report)
    end if
    ends = report%has_cause()
  end subroutine try_soft_contacts

  !> The path towards the target with soft two-way contacts; at the point it reached they are released and stiffened to
  !> the scene's. Where they are, but short of the target, the shaft floats.
  subroutine approach(bearing, newton, target, settings, contacts, report)
    type(bearing_system_type), target, intent(inout) :: bearing !! at a guess of its position
    type(newton_type), target, intent(inout) :: newton !! its solver
    type(operating_point_type), intent(in) :: target   !! asked for
    type(path_settings_type), intent(in) :: settings !! limits
    type(soft_contacts_type), intent(in) :: contacts !! how they are released
    type(path_report_type), intent(out) :: report !! how far it led; shaft fixed: to no state of the scene
    type(path_settings_type) :: soft
    type(newton_settings_type) :: wanted
    real(wp) :: force(film_forces)
    logical :: early, real_contacts

    soft = soft_settings(bearing, settings)
    wanted = newton%settings
    call soften(bearing, newton)
    call find_position(bearing, newton, target, soft, report)
    force = bearing%reaction()
    early = contacts%release == before .or. (contacts%release == by_load .and. norm2(target%load(:2)) > norm2(force(1:2)))
    if (report%converged() .and. early) call lead_contacts(bearing, newton, releasing, contacts, report)
    if (report%converged() .and. bearing%floats) call release_shaft(bearing, newton, target, soft, report)
    if (.not. early .and. (report%converged() .or. .not. report%shaft_fixed)) then
      call lead_contacts(bearing, newton, releasing, contacts, report)
    end if
    call harden(bearing, newton, contacts, wanted, report, real_contacts)
    if (report%converged()) then
      newton%settings%straight_steps = rough%straight_steps
      call solve_at(bearing, newton, target, .false., settings, report)
      newton%settings = wanted
      real_contacts = report%converged()
    end if
    report%shaft_fixed = .not. real_contacts ! not a state of this scene
  end subroutine approach

  !> A runner held at a point, brought from rest to speed on soft two-way contacts, which are released and stiffened there to the
  !> scene's.
  subroutine hold_softly(bearing, newton, held, settings, report)
    type(bearing_system_type), target, intent(inout) :: bearing !! pads and runner
    type(newton_type), target, intent(inout) :: newton !! its solver
    type(operating_point_type), intent(in) :: held   !! where it is held
    type(path_settings_type), intent(in) :: settings !! limits
    type(path_report_type), intent(out) :: report !! how it ended
    type(newton_settings_type) :: wanted
    logical :: real_contacts

    wanted = newton%settings
    call soften(bearing, newton)
    call put_at_rest(bearing, held)
    call follow_path(bearing, newton, held, 1.0_wp, soft_settings(bearing, settings), report)
    if (report%converged()) call lead_contacts(bearing, newton, releasing, usual_contacts, report)
    call harden(bearing, newton, usual_contacts, wanted, report, real_contacts)
    if (report%converged()) call solve_at(bearing, newton, held, .true., settings, report)
    report%shaft_fixed = .true.
  end subroutine hold_softly

  !> Limits of a path with soft contacts.
  pure function soft_settings(bearing, settings) result(soft)
    type(bearing_system_type), intent(in) :: bearing
    type(path_settings_type), intent(in) :: settings !! limits of the start
    type(path_settings_type) :: soft

    soft = settings
    soft%look_for_folds = .false. ! they would be those of soft contacts
    soft%touch_down_gap = max(settings%touch_down_gap, closing_gap*bearing%clearance) ! from where hard ones go on
    soft%most_cuts = most_soft_cuts
  end function soft_settings

  !> Makes all contacts soft two-way ones, which Newton's method need not meet closely.
  subroutine soften(bearing, newton)
    type(bearing_system_type), intent(inout) :: bearing
    type(newton_type), intent(inout) :: newton

    associate (settings => newton%settings)
      settings%straight_steps = rough%straight_steps
      settings%residual_tolerance = max(settings%residual_tolerance, rough%residual_tolerance)
      settings%step_tolerance = max(settings%step_tolerance, rough%step_tolerance)
      settings%maximum_iterations = min(settings%maximum_iterations, rough%maximum_iterations)
    end associate
    call set_hardness(bearing, bearing%pad(1)%foil%softest())
    call set_adhesion(bearing, 1.0_wp)
  end subroutine soften

  !> Stiffens contacts to the scene's, where there is an answer to do so from.
  subroutine harden(bearing, newton, contacts, wanted, report, real_contacts)
    type(bearing_system_type), target, intent(inout) :: bearing
    type(newton_type), target, intent(inout) :: newton
    type(soft_contacts_type), intent(in) :: contacts
    type(newton_settings_type), intent(in) :: wanted !! of the scene
    type(path_report_type), intent(inout) :: report !! so far; of failure where contacts do not get so far
    logical, intent(out) :: real_contacts !! the state is one of the scene

    call set_adhesion(bearing, 0.0_wp)
    real_contacts = .false.
    if (report%converged() .or. .not. report%shaft_fixed) then
      call lead_contacts(bearing, newton, stiffening, contacts, report, real_contacts)
    end if
    newton%settings = wanted
    call set_hardness(bearing, 1.0_wp)
    if (report%ending%kind == ending_touch_down) report%ending = path_lost(report%reason()) ! with soft contacts
  end subroutine harden

  !> Releases contacts, or raises their stiffness to the scene's, at the bearing's present point and by
  !> decades. A report of success becomes one of failure where that does not succeed.
  subroutine lead_contacts(bearing, newton, change, contacts, report, arrived)
    type(bearing_system_type), target, intent(inout) :: bearing
    type(newton_type), target, intent(inout) :: newton
    integer, intent(in) :: change !! `releasing` or `stiffening`
    type(soft_contacts_type), intent(in) :: contacts
    type(path_report_type), intent(inout) :: report
    logical, intent(out), optional :: arrived
    type(contact_path_type) :: path
    type(step_rules_type) :: rules
    integer :: ending

    path%bearing => bearing
    path%newton => newton
    path%change = change
    rules%last = -least_adhesion
    if (change == stiffening) rules%last = -log10(bearing%pad(1)%foil%softest())
    path%last = rules%last
    rules%first_step = contacts%first_decades
    rules%smallest_step = shortest_decades
    rules%growth = contacts%growth
    if (change == releasing .and. contacts%growth <= 1.0_wp) rules%leap_from = enough
    call path%saved%save(bearing)
    call follow_steps(path, rules, ending)
    call path%saved%destroy()
    if (present(arrived)) arrived = ending == steps_arrived
    if (ending == steps_arrived .or. .not. report%converged()) return
    report%ending = path_lost(path%solved%reason)
    report%shaft_fixed = .true. ! not a state of this scene
  end subroutine lead_contacts

  !> Contacts so many decades from where they began: Newton's method from the last answer.
  subroutine try_decades(self, trial, may_be_cut, converged, iterations)
    class(contact_path_type), intent(inout) :: self !! the path
    real(wp), intent(in) :: trial     !! decades
    logical, intent(in) :: may_be_cut !! does not matter
    logical, intent(out) :: converged !! there is an answer
    integer, intent(out) :: iterations

    call self%newton%log%is_at(text(100.0_wp*self%at/self%last, 2)//' % of the '// &
                               trim(merge('release   ', 'stiffening', self%change == releasing))//' of contacts', self%at/self%last)
    call set_contacts(self%bearing, self%newton, self%change, trial, self%last)
    call solve_newton(self%newton, self%solved)
    converged = self%solved%converged
    iterations = self%solved%iterations
  end subroutine try_decades

  !> Saves an answer.
  subroutine accept_decades(self, trial)
    class(contact_path_type), intent(inout) :: self !! the path
    real(wp), intent(in) :: trial !! decades
    call self%saved%save(self%bearing)
  end subroutine accept_decades

  !> Goes back to the last answer.
  subroutine restore_contacts(self)
    class(contact_path_type), intent(inout) :: self !! the path
    call self%saved%restore(self%bearing)
  end subroutine restore_contacts

  !> Contacts between soft two-way ones and the scene's, so many decades from where they began.
  subroutine set_contacts(bearing, newton, change, gone, total)
    type(bearing_system_type), intent(inout) :: bearing
    type(newton_type), intent(in) :: newton
    integer, intent(in) :: change      !! `releasing` or `stiffening`
    real(wp), intent(in) :: gone, total !! decades
    real(wp) :: factor

    if (change == releasing) then
      factor = merge(0.0_wp, 10.0_wp**(-gone), gone >= total)
      call set_adhesion(bearing, factor)
      call newton%log%detail('two-way contacts: '//text(factor, 3)//' of their stiffness against opening')
    else
      factor = merge(1.0_wp, 10.0_wp**(gone - total), gone >= total)
      call set_hardness(bearing, factor)
      call newton%log%detail('contacts: '//text(factor, 3)//' of their stiffness')
    end if
  end subroutine set_contacts
end module gfb_soft_contact_start
