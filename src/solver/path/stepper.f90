!> From one state to another in steps: how long they are, when they are cut, and how it ends.
!>
!> What is followed, an operating point, a key of the case file, an interference or the stiffness of
!> contacts, extends `path_problem_type`; how its steps grow and shrink is data, `step_rules_type`.
!> Branches round folds (`arc`), load steps of strips (`strip_load_step`), branches of orbits and
!> steps of time have lengths of their own.
module gfb_stepper
  use gfb_kinds, only: wp
  implicit none (type, external)
  private
  public :: follow_steps

  integer, parameter, public :: steps_arrived = 0  !! at the end of the path
  integer, parameter, public :: steps_too_far = 1  !! where the problem says so
  integer, parameter, public :: steps_too_short = 2 !! none converges, however short
  integer, parameter, public :: steps_spent = 3    !! all are
  integer, parameter, public :: steps_given_up = 4 !! the problem gives up

  !> How steps grow and shrink, in the unit of the path's parameter, which grows from 0 to `last`.
  type, public :: step_rules_type
    real(wp) :: last = 1.0_wp            !! where the path ends
    real(wp) :: first_step = 1.0_wp
    real(wp) :: smallest_step = 0.0_wp   !! a shorter one is not tried
    real(wp) :: smallest_share = 0.0_wp  !! the same, of the way that is gone [1]
    real(wp) :: growth = 2.0_wp          !! of a step that was easy [1]
    integer :: easy_iterations = huge(1) !! a step that took no more of them was easy
    logical :: grows_at_once = .true.    !! also the first step after one that was cut
    logical :: cuts_the_trial = .false.  !! a step that the end has shortened is cut from there
    real(wp) :: leap_from = huge(1.0_wp) !! a step that comes so far goes to the end
  end type step_rules_type

  !> What is followed, at its last answer; `restore` is called after a trial that has failed.
  type, abstract, public :: path_problem_type
    real(wp) :: at = 0.0_wp !! parameter of the last answer
    integer :: steps = 0    !! that led on
    integer :: cuts = 0     !! that had to be shortened
  contains
    procedure(try_interface), deferred :: try
    procedure(accept_interface), deferred :: accept
    procedure(restore_interface), deferred :: restore
    procedure :: has_steps => always_has_steps, gives_up => never_gives_up, rescue => no_rescue
    procedure :: is_too_far => never_too_far
  end type path_problem_type

  abstract interface
    !> Predicts and solves at a parameter.
    subroutine try_interface(self, trial, may_be_cut, converged, iterations)
      import :: path_problem_type, wp
      implicit none (type, external)
      class(path_problem_type), intent(inout) :: self !! at its last answer
      real(wp), intent(in) :: trial       !! parameter
      logical, intent(in) :: may_be_cut   !! half the step is still allowed
      logical, intent(out) :: converged   !! there is an answer, and it is on the path
      integer, intent(out) :: iterations  !! that it took
    end subroutine try_interface

    !> Saves its state as the last answer.
    subroutine accept_interface(self, trial)
      import :: path_problem_type, wp
      implicit none (type, external)
      class(path_problem_type), intent(inout) :: self !! the problem
      real(wp), intent(in) :: trial !! parameter, which becomes `at`
    end subroutine accept_interface

    !> Goes back to the last answer.
    subroutine restore_interface(self)
      import :: path_problem_type
      implicit none (type, external)
      class(path_problem_type), intent(inout) :: self !! the problem
    end subroutine restore_interface
  end interface

contains

  !> Follows a path from the problem's present answer, until it ends.
  subroutine follow_steps(problem, rules, ending)
    class(path_problem_type), intent(inout) :: problem !! at an answer; left at the last one
    type(step_rules_type), intent(in) :: rules !! of its steps
    integer, intent(out) :: ending !! one of those above
    real(wp) :: step, trial, smallest
    integer :: iterations
    logical :: converged, easy, just_cut, continues

    step = rules%first_step
    just_cut = .false.
    ending = steps_arrived
    do while (problem%at < rules%last)
      ending = steps_spent
      if (.not. problem%has_steps()) exit
      trial = problem%at + step
      if (trial >= min(rules%last, rules%leap_from)) trial = rules%last
      smallest = max(rules%smallest_step, rules%smallest_share*problem%at)
      call problem%try(trial, step >= 2.0_wp*smallest, converged, iterations)
      if (converged) then
        call problem%accept(trial)
        problem%at = trial
        problem%steps = problem%steps + 1
        easy = iterations <= rules%easy_iterations .and. (rules%grows_at_once .or. .not. just_cut)
        if (easy) step = rules%growth*step
        just_cut = .false.
        ending = steps_too_far
        if (problem%is_too_far()) exit
        ending = steps_arrived
      else
        problem%cuts = problem%cuts + 1
        just_cut = .true. ! what failed need not be tried again at once
        call problem%restore()
        ending = steps_given_up
        if (problem%gives_up()) exit
        if (rules%cuts_the_trial) step = min(step, trial - problem%at)
        step = 0.5_wp*step
        if (step >= smallest) cycle
        call problem%rescue(step, continues)
        ending = steps_too_short
        if (.not. continues) exit
        ending = steps_too_far
        if (problem%is_too_far()) exit
      end if
    end do
  end subroutine follow_steps

  !> A path without a bound on its steps.
  logical function always_has_steps(self)
    class(path_problem_type), intent(inout) :: self !! the problem
    always_has_steps = .true.
  end function always_has_steps

  !> A path that is never given up before its steps are too short.
  logical function never_gives_up(self)
    class(path_problem_type), intent(inout) :: self !! the problem
    never_gives_up = .false.
  end function never_gives_up

  !> A path on which nothing is tried where steps are too short.
  subroutine no_rescue(self, step, continues)
    class(path_problem_type), intent(inout) :: self !! the problem, at its last answer
    real(wp), intent(inout) :: step !! in: too short; out: to try next
    logical, intent(out) :: continues !! there is a next one
    continues = .false.
  end subroutine no_rescue

  !> A path that ends nowhere before its end.
  logical function never_too_far(self)
    class(path_problem_type), intent(inout) :: self !! the problem, at an answer
    never_too_far = .false.
  end function never_too_far
end module gfb_stepper
