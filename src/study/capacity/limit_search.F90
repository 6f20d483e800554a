#include "gfb_petsc.h"
!> The load, speed or tilt at which film or asperities reach a limit: along the branch of equilibria from a given one, every trial
!> an equilibrium on that branch.
!>
!> At an answer \( x \) at the value \( v \) one solution by the factors at hand gives the branch's tangent,
!> \( x' = -f_x^{-1} f_v \). The reserve \( r \) falls along it by \( r' = r_x x' + r_v \): where \( r + r' \Delta v = 0 \) the limit
!> is tried next, from \( x + x' \Delta v \), which is Newton's method for the limit. No step more than doubles or halves a load or a
!> speed; once the limit lies between two answers, a step that would leave them is one of false position.
module gfb_limit_search
  use petscvec
  use gfb_kinds, only: wp
  use gfb_units, only: rpm, micrometres
  use gfb_ending, only: path_reached, path_stopped, path_lost, ending_fold
  use gfb_quantity, only: quantity_type
  use gfb_result_names, only: add_result
  use gfb_text, only: text
  use gfb_bearing_case, only: pad_angle
  use gfb_film_surface, only: translations
  use gfb_scene, only: scene_type
  use gfb_analysis_row, only: limit_load, limit_speed
  use gfb_operating_point, only: operating_point_type
  use gfb_bearing_system, only: bearing_system_type
  use gfb_bearing_answer, only: bearing_answer_type, bearing_answer
  use gfb_run_log, only: run_log_type
  use gfb_signals, only: stop_agreed
  use gfb_newton, only: newton_type, has_factors, solve_with_factors
  use gfb_continuation, only: path_settings_type, path_report_type, follow_path
  use gfb_saved_state, only: saved_state_type
  use gfb_root_bracket, only: root_bracket_type
  implicit none (type, external)
  private
  public :: limit_type, limit_of, find_limit, leave_limit

  real(wp), parameter :: milliradians = 1.0e3_wp             !! in a radian
  real(wp), parameter :: kilopascals = 1.0e-3_wp             !! in a pascal
  real(wp), parameter :: pound_force = 4.4482216152605_wp    !! [N]
  real(wp), parameter :: inch = 0.0254_wp                    !! [m]
  real(wp), parameter :: growth = 2.0_wp                     !! of load, speed or tilt in a step [1]
  real(wp), parameter :: pounds = inch**3*1000.0_wp*rpm/pound_force !! lbf/(in^3 krpm) in a N s/m^3

  !> The limit of a scene.
  type :: limit_type
    integer :: kind = 0               !! `limit_load`, ...
    integer :: axis = 1               !! of the tilt
    real(wp) :: smallest_gap = 0.0_wp !! [m]
    real(wp) :: contact_part = 0.0_wp !! of the load [1]
    real(wp) :: direction(translations) = 0.0_wp !! of the load [1]
    real(wp) :: length = 0.0_wp       !! of the bearing [m]
    real(wp) :: diameter = 0.0_wp     !! [m]
    real(wp) :: arm = 0.0_wp          !! by which a tilt moves the film's edge [m]
    real(wp) :: area = 0.0_wp         !! of the pads of a thrust bearing; 0: it is a journal's [m2]
  contains
    procedure :: value_at, point_with, reserve, next_value, aimed_value, is_of_film, results, words, never_within
    procedure, private :: coefficient, course
  end type limit_type

  integer, parameter :: most_steps = 30           !! before the limit is passed
  integer, parameter :: most_steps_back = 15      !! from beyond the limit: to a 33,000th of the load
  integer, parameter :: most_trials = 40          !! between two values on both sides
  real(wp), parameter :: tolerance = 1.0e-9_wp    !! of load, speed or tilt, relative [1]
  real(wp), parameter :: settled = 1.0e-10_wp     !! reserve that needs no other trial [1]
  real(wp), parameter :: at_limit = 1.0e-6_wp     !! reserve that is none [1]
  real(wp), parameter :: shift = 1.0e-4_wp        !! of what is looked for, for derivatives, over the longest step [1]
  !> Newton's steps before they are bent at contacts that change: where crests open and close as the film thins, straight ones go
  !> to and fro among them, and steps of the path are cut for it.
  integer, parameter, public :: limit_straight_steps = 3

  !> Two values on both sides of the limit, the last answer on its near side, and how the branch goes on from the present one.
  type :: sides_type
    type(root_bracket_type) :: bracket !! the bearing is at its `high`
    type(saved_state_type) :: within    !! with reserve; not created where none was met
    Vec :: rate                         !! of the state at the bearing's answer, by what is looked for
    real(wp) :: slope = 0.0_wp          !! of the reserve along it; 0: not known [1/unit]
  end type sides_type

contains

  !> The limit that a scene asks for, from the point where its answer is.
  pure function limit_of(scene, point) result(limit)
    type(scene_type), intent(in) :: scene !! that asks for a limit
    type(operating_point_type), intent(in) :: point !! whose load has the direction
    type(limit_type) :: limit

    limit%kind = scene%capacity%limit
    limit%axis = scene%capacity%tilt_axis
    limit%smallest_gap = scene%capacity%smallest_gap
    limit%contact_part = scene%capacity%contact_part
    associate (load => point%load(:translations))
      if (any(abs(load) > 0.0_wp)) limit%direction = load/norm2(load)
    end associate
    limit%length = scene%bearing%length
    limit%diameter = 2.0_wp*scene%bearing%radius
    limit%arm = 0.5_wp*limit%length
    if (.not. scene%bearing%is_thrust()) return
    limit%arm = scene%bearing%radius
    limit%area = 0.5_wp*real(scene%bearing%pads, wp)*pad_angle(scene%bearing)* &
                 (scene%bearing%radius**2 - scene%bearing%inner_radius**2)
  end function limit_of

  !> Whether it is the film that tells, and not the asperities.
  elemental logical function is_of_film(self) result(is)
    class(limit_type), intent(in) :: self !! the limit
    is = self%kind /= limit_speed
  end function is_of_film

  !> Value of what is looked for, at a point.
  pure function value_at(self, point) result(value)
    class(limit_type), intent(in) :: self !! the limit
    type(operating_point_type), intent(in) :: point !! of the bearing
    real(wp) :: value !! load [N], speed [rad/s] or tilt [rad]

    select case (self%kind)
    case (limit_load)
      value = dot_product(point%load(:translations), self%direction)
    case (limit_speed)
      value = point%speed
    case default
      value = point%place(3 + self%axis)
    end select
  end function value_at

  !> A point with another load, speed or tilt.
  pure function point_with(self, point, value) result(changed)
    class(limit_type), intent(in) :: self !! the limit
    type(operating_point_type), intent(in) :: point !! of the bearing
    real(wp), intent(in) :: value !! load [N], speed [rad/s] or tilt [rad]
    type(operating_point_type) :: changed

    changed = point
    select case (self%kind)
    case (limit_load)
      changed%load(:translations) = value*self%direction
    case (limit_speed)
      changed%speed = value
    case default
      changed%place(3 + self%axis) = value
    end select
  end function point_with

  !> What is left at the bearing's answer; 0 at the limit, negative beyond it: the film over the
  !> smallest one, less 1; the logarithm of the part allowed over that of the asperities, nearly
  !> straight over the film: they carry exp(-h/s).
  function reserve(self, bearing) result(left)
    class(limit_type), intent(in) :: self !! the limit
    type(bearing_system_type), intent(in) :: bearing !! at an answer
    real(wp) :: left !! [1]
    type(bearing_answer_type) :: answer
    real(wp) :: part

    answer = bearing_answer(bearing)
    if (self%is_of_film()) then
      left = answer%minimum_gap/self%smallest_gap - 1.0_wp
    else
      part = contact_part(answer, bearing%point)
      left = log(self%contact_part/max(part, tiny(part)))
    end if
  end function reserve

  !> The value to try next: a larger load or tilt or a lower speed while there is reserve; from
  !> beyond the limit a smaller load, a higher speed, no tilt.
  pure real(wp) function next_value(self, value, left) result(next)
    class(limit_type), intent(in) :: self !! the limit
    real(wp), intent(in) :: value !! load [N], speed [rad/s] or tilt [rad]
    real(wp), intent(in) :: left  !! reserve there [1]
    real(wp) :: tilt

    select case (self%kind)
    case (limit_load)
      next = value*merge(growth, 1.0_wp/growth, left > 0.0_wp)
    case (limit_speed)
      next = value*merge(1.0_wp/growth, growth, left > 0.0_wp)
    case default
      next = 0.0_wp
      if (.not. left > 0.0_wp) return
      ! At least one by which the ends of the shaft come down as much as the film may lose.
      tilt = left*self%smallest_gap/self%arm
      next = sign(max(growth*abs(value), tilt), value)
    end select
  end function next_value

  !> Where the reserve would be none if it went on as its tangent does: over the logarithm of a load or speed, as the film is next
  !> to a power of either; the value itself where the slope tells nothing.
  pure real(wp) function aimed_value(self, value, left, slope) result(aim)
    class(limit_type), intent(in) :: self !! the limit
    real(wp), intent(in) :: value !! load [N], speed [rad/s] or tilt [rad]
    real(wp), intent(in) :: left  !! reserve there [1]
    real(wp), intent(in) :: slope !! of the reserve [1/unit]
    real(wp), parameter :: longest = 3.0_wp !! logarithm of a step [1]

    aim = value
    if (.not. abs(slope) > 0.0_wp) return
    if (self%kind == limit_speed .or. self%kind == limit_load) then
      aim = value*exp(max(-longest, min(longest, -left/(slope*value))))
    else
      aim = value - left/slope
    end if
  end function aimed_value

  !> What summary and history say of the limit.
  function results(self, point, reached) result(list)
    class(limit_type), intent(in) :: self !! the limit
    type(operating_point_type), intent(in) :: point !! where it is
    logical, intent(in) :: reached !! film or asperities are at the limit asked for
    type(quantity_type), allocatable :: list(:)

    associate (value => self%value_at(point))
      select case (self%kind)
      case (limit_load)
        call add_result(list, 'load_capacity', value)
        if (.not. self%area > 0.0_wp) then
          call add_result(list, 'load_capacity_coefficient', pounds*self%coefficient(point))
          call add_result(list, 'load_capacity_coefficient_si', self%coefficient(point))
        end if
      case (limit_speed)
        call add_result(list, 'lift_off_speed_rpm', value/rpm)
      case default
        call add_result(list, 'misalignment_allowance', value)
      end select
    end associate
    call add_result(list, 'limit_reached', reached)
  end function results

  !> Designers' coefficient of a load, W/(L D D Omega). Source: [DellaCorteValco2000].
  pure function coefficient(self, point) result(value)
    class(limit_type), intent(in) :: self !! the limit
    type(operating_point_type), intent(in) :: point !! with load and speed
    real(wp) :: value !! [N s/m^3]
    value = self%value_at(point)/(self%length*self%diameter**2*point%speed)
  end function coefficient

  !> Part of the load that the asperities carry [1].
  pure real(wp) function contact_part(answer, point) result(part)
    type(bearing_answer_type), intent(in) :: answer
    type(operating_point_type), intent(in) :: point !! with the load
    part = norm2(answer%solid_force(:translations))/norm2(point%load(:translations))
  end function contact_part

  !> From where to where a step leads, for the lines that tell how far a long run is.
  pure function course(self, from, to) result(words)
    class(limit_type), intent(in) :: self !! the limit
    real(wp), intent(in) :: from, to !! loads [N], speeds [rad/s] or tilts [rad]
    character(len=:), allocatable :: words

    select case (self%kind)
    case (limit_load)
      words = ' from '//text(from, 4)//' to '//text(to, 4)//' N'
    case (limit_speed)
      words = ' from '//text(from/rpm, 4)//' to '//text(to/rpm, 4)//' rpm'
    case default
      words = ' from '//text(from*milliradians, 4)//' to '//text(to*milliradians, 4)//' mrad'
    end select
  end function course

  !> The limit as a sentence without its end.
  function words(self, bearing) result(sentence)
    class(limit_type), intent(in) :: self !! the limit
    type(bearing_system_type), intent(in) :: bearing !! at it
    character(len=:), allocatable :: sentence
    type(bearing_answer_type) :: answer

    answer = bearing_answer(bearing)
    associate (value => self%value_at(bearing%point))
      select case (self%kind)
      case (limit_load)
        sentence = 'load capacity: '//text(value, 6)//' N, '
        if (self%area > 0.0_wp) then ! the speed of a ring's tip is what designers tell beside it
          sentence = sentence//text(kilopascals*value/self%area, 4)//' kPa on the pads at '// &
                     text(0.5_wp*self%diameter*bearing%point%speed, 4)//' m/s at the tip'
        else
          sentence = sentence//'coefficient '//text(pounds*self%coefficient(bearing%point), 3)//' lbf/(in^3 krpm)'
        end if
      case (limit_speed)
        sentence = 'lift-off speed: '//text(value/rpm, 6)//' rpm'
      case default
        sentence = 'misalignment allowance: '//text(value*milliradians, 6)//' mrad about '// &
                   merge('x', 'y', self%axis == 1)
      end select
    end associate
    sentence = sentence//', smallest film '//text(answer%minimum_gap*micrometres, 4)//' um'
    if (.not. self%is_of_film()) then
      sentence = sentence//', asperities carry '// &
                 text(100.0_wp*contact_part(answer, bearing%point), 4)//' % of the load'
    end if
  end function words

  !> Says that no value tried had any reserve, the last of which the bearing is at.
  function never_within(self, bearing) result(sentence)
    class(limit_type), intent(in) :: self !! the limit
    !> at the lightest load, the highest speed or without tilt
    type(bearing_system_type), intent(in) :: bearing
    character(len=:), allocatable :: sentence

    associate (value => self%value_at(bearing%point))
      select case (self%kind)
      case (limit_load)
        sentence = 'the smallest film is thinner than smallest_gap at every load tried, '// &
                   'down to '//text(value, 3)//' N'
      case (limit_speed)
        sentence = 'the asperities carry more than contact_part of the load at every speed '// &
                   'tried, up to '//text(value/rpm, 3)//' rpm'
      case default
        sentence = 'the smallest film is thinner than smallest_gap without any tilt about '// &
                   merge('x', 'y', self%axis == 1)
      end select
    end associate
  end function never_within

  !> Leads the bearing from an equilibrium to the limit that the scene asks for, or to the end of the branch before it.
  !>
  !> Without an answer the bearing is at the last state that was reached.
  subroutine find_limit(scene, log, path, bearing, newton, found, at_fold, report)
    type(scene_type), intent(in) :: scene !! that asks for a limit
    type(run_log_type), intent(in) :: log !! where lines go
    type(path_settings_type), intent(in) :: path !! limits of paths
    type(bearing_system_type), target, intent(inout) :: bearing !! at an equilibrium
    type(newton_type), target, intent(inout) :: newton !! its solver
    type(quantity_type), allocatable, intent(out) :: found(:) !! what summary and history say of the limit
    logical, intent(out) :: at_fold !! the answer is a branch's end in a fold
    type(path_report_type), intent(out) :: report !! whether there is an answer
    type(limit_type) :: limit
    type(sides_type) :: sides
    type(path_settings_type) :: settings
    PetscErrorCode :: ierr
    logical :: passed

    limit = limit_of(scene, bearing%point)
    settings = path
    settings%straight_steps = limit_straight_steps
    PetscCallA(VecDuplicate(bearing%state, sides%rate, ierr))
    call pass_limit(limit, settings, bearing, newton, sides, passed, report)
    if (passed) call close_in(limit, settings, bearing, newton, sides, report)
    PetscCallA(VecDestroy(sides%rate, ierr))
    at_fold = report%ending%kind == ending_fold
    if (stop_agreed()) then
      report%ending = path_stopped() ! the caller knows why
    else if (passed .or. sides%within%created) then
      call conclude(limit, log, bearing, sides, found, at_fold, report)
    end if
    call sides%within%destroy()
  end subroutine find_limit

  !> From a limit back to the answer from which it was found, so that the next path begins where the bearing has its reserve.
  subroutine leave_limit(target, path, bearing, newton)
    type(operating_point_type), intent(in) :: target !! of that answer
    type(path_settings_type), intent(in) :: path !! limits of paths
    type(bearing_system_type), intent(inout) :: bearing !! at the limit; where no path leads back, at its last answer
    type(newton_type), intent(inout) :: newton !! its solver
    type(path_report_type) :: report
    call follow_path(bearing, newton, target, 1.0_wp, path, report)
  end subroutine leave_limit

  !> Goes on, or back, until the limit is met or lies between two answers, or the branch ends.
  subroutine pass_limit(limit, path, bearing, newton, sides, passed, report)
    type(limit_type), intent(in) :: limit
    type(path_settings_type), intent(in) :: path
    type(bearing_system_type), target, intent(inout) :: bearing
    type(newton_type), target, intent(inout) :: newton
    type(sides_type), intent(inout) :: sides
    logical, intent(out) :: passed
    type(path_report_type), intent(out) :: report !! why not
    type(path_settings_type) :: settings
    real(wp) :: value, left, next, first, aim
    logical :: starts_within, stops
    integer :: step

    value = limit%value_at(bearing%point)
    left = limit%reserve(bearing)
    first = left
    starts_within = first > 0.0_wp
    passed = .false.
    settings = path
    ! The path ends where the limit is passed, so that nothing is looked for beyond.
    if (limit%is_of_film() .and. starts_within) settings%touch_down_gap = limit%smallest_gap
    do step = 1, merge(most_steps, most_steps_back, starts_within)
      call newton%log%detail('limit: '//limit%words(bearing))
      if (.not. left < 0.0_wp) call sides%within%save(bearing)
      sides%bracket%low = value
      sides%bracket%at_low = left
      next = limit%next_value(value, left)
      if (abs(next - value) <= 0.0_wp) exit ! there is no way farther back
      call find_rate(limit, bearing, newton, abs(next - value), left, sides)
      aim = limit%aimed_value(value, left, sides%slope)
      if ((aim - value)*(next - aim) > 0.0_wp) next = aim
      call follow_branch(limit, next, settings, bearing, newton, sides, report)
      value = limit%value_at(bearing%point)
      left = limit%reserve(bearing)
      if (.not. left < 0.0_wp) call sides%within%save(bearing)
      sides%bracket%high = value
      sides%bracket%at_high = left
      passed = left*first <= 0.0_wp .or. abs(left) <= settled .or. abs(value - sides%bracket%low) <= tolerance*abs(value)
      stops = stop_agreed()
      if (passed .or. stops) return
      if (.not. report%converged()) then
        if (.not. starts_within) call report%ending%add_words('beyond the limit at first, and on the way back ', '')
        return
      end if
    end do
    report%ending = path_lost('not met after '//text(most_steps)//' steps')
    if (.not. starts_within) report%ending = path_lost(limit%never_within(bearing))
  end subroutine pass_limit

  !> From both sides to the limit, where the tangent of the last answer has it or by false position; where no path leads back from
  !> the second side, from the last answer on the near side.
  subroutine close_in(limit, path, bearing, newton, sides, report)
    type(limit_type), intent(in) :: limit
    type(path_settings_type), intent(in) :: path
    type(bearing_system_type), target, intent(inout) :: bearing !! at the last trial on return
    type(newton_type), target, intent(inout) :: newton
    type(sides_type), intent(inout) :: sides
    type(path_report_type), intent(out) :: report !! of the last trial
    real(wp) :: trial, last, left, aim
    integer :: i

    report%ending = path_reached()
    do i = 1, most_trials
      if (abs(sides%bracket%at_high) <= settled) return
      if (stop_agreed()) return
      last = sides%bracket%high
      trial = sides%bracket%trial()
      left = limit%reserve(bearing)
      call find_rate(limit, bearing, newton, abs(trial - last), left, sides)
      aim = limit%aimed_value(last, left, sides%slope)
      if ((aim - last)*(sides%bracket%low - aim) > 0.0_wp) trial = aim
      call follow_branch(limit, trial, path, bearing, newton, sides, report)
      if (.not. report%converged() .and. sides%within%created) then
        call sides%within%restore(bearing)
        sides%slope = 0.0_wp
        call follow_branch(limit, trial, path, bearing, newton, sides, report)
      end if
      left = limit%reserve(bearing)
      if (.not. left < 0.0_wp) call sides%within%save(bearing)
      if (.not. report%converged()) return
      call newton%log%detail('limit: '//limit%words(bearing))
      if (abs(trial - last) <= tolerance*abs(trial)) return
      call sides%bracket%narrow(trial, left)
    end do
  end subroutine close_in

  !> The branch's tangent at the bearing's answer, and how the reserve falls along it, by differences of residual and reserve over a
  !> small part of a step. The factors are those of the last iteration before the answer: near enough for a start value.
  subroutine find_rate(limit, bearing, newton, step, left, sides)
    type(limit_type), intent(in) :: limit
    type(bearing_system_type), intent(inout) :: bearing
    type(newton_type), intent(in) :: newton
    real(wp), intent(in) :: step !! of what is looked for [its unit]
    real(wp), intent(in) :: left !! reserve at the answer [1]
    type(sides_type), intent(inout) :: sides
    type(operating_point_type) :: here
    real(wp) :: value, part
    logical :: valid
    Vec :: change, answer
    PetscErrorCode :: ierr

    sides%slope = 0.0_wp
    part = shift*step
    if (.not. (has_factors(newton) .and. part > 0.0_wp)) return
    PetscCallA(VecDuplicate(bearing%state, change, ierr))
    PetscCallA(VecDuplicate(bearing%state, answer, ierr))
    PetscCallA(VecCopy(bearing%state, answer, ierr))
    here = bearing%point
    value = limit%value_at(here)
    call bearing%evaluate_at(limit%point_with(here, value - part), answer, change, valid)
    if (valid) call bearing%evaluate_at(limit%point_with(here, value + part), answer, sides%rate, valid)
    if (valid) then
      PetscCallA(VecAXPBY(change, -0.5_wp/part, 0.5_wp/part, sides%rate, ierr))
      call solve_with_factors(newton, change, sides%rate)
      bearing%point = limit%point_with(here, value + part)
      PetscCallA(VecAXPY(bearing%state, part, sides%rate, ierr))
      if (bearing_is_open(bearing)) sides%slope = (limit%reserve(bearing) - left)/part
      PetscCallA(VecCopy(answer, bearing%state, ierr))
      bearing%point = here
    end if
    PetscCallA(VecDestroy(change, ierr))
    PetscCallA(VecDestroy(answer, ierr))
  end subroutine find_rate

  !> Whether the bearing's present state can be evaluated.
  logical function bearing_is_open(bearing) result(open)
    type(bearing_system_type), intent(in) :: bearing
    real(wp) :: unknown(bearing%local_size())

    call bearing%get_unknowns(unknown)
    open = bearing%is_open_at(unknown)
  end function bearing_is_open

  !> A path to another value, from the tangent where that is known.
  subroutine follow_branch(limit, next, path, bearing, newton, sides, report)
    type(limit_type), intent(in) :: limit
    real(wp), intent(in) :: next !! value [its unit]
    type(path_settings_type), intent(in) :: path
    type(bearing_system_type), target, intent(inout) :: bearing
    type(newton_type), target, intent(inout) :: newton
    type(sides_type), intent(inout) :: sides !! the tangent is used up
    type(path_report_type), intent(out) :: report
    type(operating_point_type) :: target
    character(len=:), allocatable :: course
    real(wp) :: value
    PetscErrorCode :: ierr

    value = limit%value_at(bearing%point)
    target = limit%point_with(bearing%point, next)
    course = limit%course(value, next)
    if (abs(sides%slope) > 0.0_wp) then
      PetscCallA(VecScale(sides%rate, next - value, ierr))
      call follow_path(bearing, newton, target, 1.0_wp, path, report, sides%rate, course)
    else
      call follow_path(bearing, newton, target, 1.0_wp, path, report, course=course)
    end if
    sides%slope = 0.0_wp
  end subroutine follow_branch

  !> Says what was found: the limit, or the last answer on its near side and why the limit is not met.
  subroutine conclude(limit, log, bearing, sides, found, at_fold, report)
    type(limit_type), intent(in) :: limit
    type(run_log_type), intent(in) :: log
    type(bearing_system_type), intent(inout) :: bearing !! at the answer on return
    type(sides_type), intent(in) :: sides
    type(quantity_type), allocatable, intent(out) :: found(:)
    logical, intent(out) :: at_fold !! it is a branch's end in a fold
    type(path_report_type), intent(inout) :: report !! in: of the last path; out: there is an answer
    character(len=:), allocatable :: ends
    real(wp) :: left
    logical :: reached

    left = limit%reserve(bearing)
    reached = abs(left) <= at_limit
    if (.not. reached .and. left < 0.0_wp) call sides%within%restore(bearing)
    found = limit%results(bearing%point, reached)
    if (reached) then
      call log%line(limit%words(bearing))
    else if (report%converged()) then
      call log%warning(limit%words(bearing)//', not at the limit: answers jump across it')
    else
      ends = limit%words(bearing)//', not at the limit: '//report%reason()
      if (report%has_cause()) then
        call log%line(ends)
      else
        call log%warning(ends//'; the branch may go on')
      end if
    end if
    at_fold = report%ending%kind == ending_fold .and. .not. reached
    report%ending = path_reached()
  end subroutine conclude
end module gfb_limit_search
